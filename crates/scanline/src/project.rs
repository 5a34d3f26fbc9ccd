//! From the world to the screen, corner by corner, and the cut at the near plane.

use glam::DVec3;
use light::{Geometry, View};
use rayon::prelude::*;

/// Screen positions (x, y, nearness) of every corner of every instance.
///
/// A corner is computed once, so that faces which share it share its bits. Corners that cannot be
/// projected (before the near plane) are NaN.
pub(crate) struct Corners {
    screen: Vec<DVec3>,
    /// Where the corners of each instance begin.
    starts: Vec<usize>,
}

impl Corners {
    pub(crate) fn project(geometry: &Geometry, view: &View) -> Self {
        let mut screen = Vec::new();
        let mut starts = Vec::with_capacity(geometry.instances.len());
        let mut total = 0;
        for instance in &geometry.instances {
            starts.push(total);
            total += geometry.meshes[instance.mesh as usize].positions.len();
        }
        screen.reserve_exact(total);
        screen.resize(total, DVec3::NAN);
        let mut rest = screen.as_mut_slice();
        let mut parts = Vec::with_capacity(geometry.instances.len());
        for instance in &geometry.instances {
            let positions = &geometry.meshes[instance.mesh as usize].positions;
            let (part, after) = rest.split_at_mut(positions.len());
            parts.push((instance, positions, part));
            rest = after;
        }
        parts.into_par_iter().for_each(|(instance, positions, part)| {
            part.par_iter_mut().zip(positions).with_min_len(4096).for_each(|(out, position)| {
                let world = instance.world_from_mesh.transform_point3(position.as_dvec3());
                let seen = view.view_from_world(world);
                *out = if seen.z <= -view.near { screen_of(view, seen) } else { DVec3::NAN };
            });
        });
        Self { screen, starts }
    }

    /// The corners of a face on the screen; none where one of them could not be projected.
    pub(crate) fn face(&self, instance: u32, corners: [u32; 3]) -> Option<[DVec3; 3]> {
        let start = self.starts[instance as usize];
        let face = corners.map(|i| self.screen[start + i as usize]);
        // The sum is NaN where any of them is: one test in place of nine.
        (!(face[0].x + face[1].x + face[2].x).is_nan()).then_some(face)
    }
}

/// NaN where the position is not finite on the screen.
fn screen_of(view: &View, seen: DVec3) -> DVec3 {
    let screen = view.screen_from_view(seen);
    // Also keeps differences of screen coordinates finite.
    if screen.abs().max_element() < 1e150 { screen } else { DVec3::NAN }
}

/// Cuts a face, given in view coordinates, at the near plane: none, one or two triangles on the screen.
///
/// A cut edge is always walked from its visible end, so that two faces which share an edge are cut at the
/// same point to the bit.
pub(crate) fn clip(view: &View, seen: [DVec3; 3], mut receive: impl FnMut([DVec3; 3])) {
    let mut polygon = [DVec3::ZERO; 4];
    let mut count = 0;
    let mut push = |point: DVec3| {
        polygon[count] = screen_of(view, point);
        count += 1;
    };
    for i in 0..3 {
        let (p, q) = (seen[i], seen[(i + 1) % 3]);
        let (p_in, q_in) = (p.z <= -view.near, q.z <= -view.near);
        if p_in {
            push(p);
        }
        match (p_in, q_in) {
            (true, false) => push(cut(p, q, view.near)),
            (false, true) => push(cut(q, p, view.near)),
            _ => {}
        }
    }
    for i in 2..count {
        let triangle = [polygon[0], polygon[i - 1], polygon[i]];
        if triangle.iter().all(|corner| corner.is_finite()) {
            receive(triangle);
        }
    }
}

/// Where the edge from the visible point `p` to the hidden point `q` meets the near plane.
fn cut(p: DVec3, q: DVec3, near: f64) -> DVec3 {
    let t = (-near - p.z) / (q.z - p.z);
    DVec3::new(p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, -near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_cut_at_the_same_points() {
        let view = View::look_at(DVec3::ZERO, -DVec3::Z, 60.0, 64, 64);
        let (a, b) = (DVec3::new(0.3, -0.7, -5.1), DVec3::new(-0.2, 0.1, 3.7));
        let (c, d) = (DVec3::new(2.0, 1.0, -1.0), DVec3::new(-3.0, 1.0, -2.0));
        let near_points = |face: [DVec3; 3]| {
            let mut points = Vec::new();
            clip(&view, face, |t| {
                points.extend(t.iter().filter(|p| p.z == 1.0 / view.near).map(|p| p.to_array()))
            });
            points
        };
        let (left, right) = (near_points([a, b, c]), near_points([b, a, d]));
        assert!(left.iter().any(|p| right.contains(p)));
    }

    #[test]
    fn a_face_wholly_behind_leaves_nothing() {
        let view = View::look_at(DVec3::ZERO, -DVec3::Z, 60.0, 64, 64);
        clip(&view, [DVec3::Z, DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 1.0, 0.0)], |_| panic!("seen"));
    }
}
