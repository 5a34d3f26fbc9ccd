//! A camera for models that bring none: three-quarter view from a little above, fitted to what counts.

use glam::DVec3;
use light::{Geometry, Projection};

use super::placement::look_along;
use super::recentre::all_boxes;
use crate::{Camera, Solid};

/// Heading of the eye from the front of the model (+Z, as glTF has it) towards +X, and its height, degrees: low
/// enough that the horizon of a level ground lies behind the model, with a third of the picture above it, as a
/// person sees things that stand there.
const HEADING: f64 = 35.0;
const ABOVE: f64 = 7.0;

/// Vertical field of view, degrees, and half of it as the frame is filled: a margin of 8 %.
const FIELD: f64 = 36.0;
const FILL: f64 = 0.92;

/// Pictures are expected to be at least this wide for their height; the camera itself states no aspect.
const ASPECT: f64 = 4.0 / 3.0;

/// Most corners that are looked at.
const SAMPLES: usize = 200_000;

/// A camera that shows the geometry well, in the geometry's coordinates.
///
/// Grounds and domes that dwarf everything else do not count, nor does what lies far outside the bulk of the
/// corners.
pub(crate) fn frame(geometry: &Geometry, solids: &[Solid]) -> Camera {
    let points = bulk(sample(geometry, solids));
    let (heading, above) = (HEADING.to_radians(), ABOVE.to_radians());
    let toward_eye = DVec3::new(heading.sin() * above.cos(), above.sin(), heading.cos() * above.cos());
    let frame = look_along(-toward_eye, DVec3::Y);
    let tan_half_height = (0.5 * FIELD.to_radians()).tan();
    let (tan_x, tan_y) = (FILL * ASPECT * tan_half_height, FILL * tan_half_height);
    let seen: Vec<DVec3> = points.iter().map(|p| frame.transpose() * p).collect();
    let eye = frame * fit(&seen, tan_x, tan_y);
    let distance = seen.iter().map(|p| (frame.transpose() * eye).z - p.z).fold(0.0, f64::max);
    Camera {
        name: "automatic".to_owned(),
        position: eye,
        world_from_camera: frame,
        projection: Projection::Perspective { tan_half_height },
        aspect: None,
        near: (1e-3 * distance).clamp(1e-4, 1.0),
        path: None,
    }
}

/// Where an eye that looks along −z must be to see all `points`: for each side of the picture the plane
/// through the eye touches the points, |x − x₀| ≤ tan (z₀ − z); the sides that are tightest together decide.
fn fit(points: &[DVec3], tan_x: f64, tan_y: f64) -> DVec3 {
    let largest = |value: &dyn Fn(&DVec3) -> f64| points.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
    if points.is_empty() {
        return DVec3::new(0.0, 0.0, 10.0);
    }
    // x₀ + tan z₀ ≥ max(x + tan z) and −x₀ + tan z₀ ≥ max(−x + tan z): both are equal at the best x₀.
    let (right, left) = (largest(&|p| p.x + tan_x * p.z), largest(&|p| -p.x + tan_x * p.z));
    let (top, bottom) = (largest(&|p| p.y + tan_y * p.z), largest(&|p| -p.y + tan_y * p.z));
    let (wide, high) = ((right + left) / (2.0 * tan_x), (top + bottom) / (2.0 * tan_y));
    // A single point would be met by the eye itself.
    let nearest = largest(&|p| p.z) + 0.1;
    DVec3::new(0.5 * (right - left), 0.5 * (top - bottom), wide.max(high).max(nearest))
}

/// Corners of what counts, evenly picked; for solids those of their boxes.
fn sample(geometry: &Geometry, solids: &[Solid]) -> Vec<DVec3> {
    let boxes = all_boxes(geometry, solids);
    let mut order: Vec<usize> = (0..boxes.len()).filter(|i| boxes[*i].is_some()).collect();
    let size = |i: usize| boxes[i].map_or(0.0, |(low, high)| (high - low).length());
    order.sort_by(|a, b| size(*a).total_cmp(&size(*b)).then(a.cmp(b)));
    // The box of all smaller things, for each.
    let mut around: Vec<f64> = Vec::with_capacity(order.len());
    let mut union: Option<(DVec3, DVec3)> = None;
    for &i in &order {
        around.push(union.map_or(0.0, |(low, high)| (high - low).length()));
        union = match (union, boxes[i]) {
            (Some((low, high)), Some(own)) => Some((low.min(own.0), high.max(own.1))),
            (old, new) => old.or(new),
        };
    }
    // A ground or dome is at least four times as large as all the rest together.
    while let (Some(&largest), Some(&rest)) = (order.last(), around.last()) {
        if order.len() < 2 || rest <= 0.0 || size(largest) < 4.0 * rest {
            break;
        }
        order.pop();
        around.pop();
    }
    let instances = &geometry.instances;
    let of_solids: Vec<DVec3> = order
        .iter()
        .filter(|i| **i >= instances.len())
        .filter_map(|i| boxes[*i])
        .flat_map(box_corners)
        .collect();
    order.retain(|i| *i < instances.len());
    let corners = |i: &usize| geometry.meshes[instances[*i].mesh as usize].positions.len();
    let total: usize = order.iter().map(corners).sum();
    let stride = total.div_ceil(SAMPLES).max(1);
    let mut points = Vec::with_capacity(total.min(SAMPLES) + 1);
    let mut skip = 0;
    for &i in &order {
        let instance = &instances[i];
        let positions = &geometry.meshes[instance.mesh as usize].positions;
        while skip < positions.len() {
            points.push(instance.world_from_mesh.transform_point3(positions[skip].as_dvec3()));
            skip += stride;
        }
        skip -= positions.len();
    }
    points.extend(of_solids);
    points
}

/// The eight corners of a box.
fn box_corners((low, high): (DVec3, DVec3)) -> impl Iterator<Item = DVec3> {
    (0..8).map(move |i| {
        let side = |bit: i32, axis: usize| if i >> bit & 1 == 0 { low[axis] } else { high[axis] };
        DVec3::new(side(0, 0), side(1, 1), side(2, 2))
    })
}

/// The points without the few that lie far outside: along each axis the middle 98 % and half their extent
/// beyond on either side.
fn bulk(mut points: Vec<DVec3>) -> Vec<DVec3> {
    if points.len() < 50 {
        return points;
    }
    for axis in 0..3 {
        let mut values: Vec<f64> = points.iter().map(|p| p[axis]).collect();
        values.sort_by(f64::total_cmp);
        let cut = values.len() / 100;
        let (low, high) = (values[cut], values[values.len() - 1 - cut]);
        let margin = 0.5 * (high - low);
        points.retain(|p| p[axis] >= low - margin && p[axis] <= high + margin);
    }
    points
}

#[cfg(test)]
mod tests {
    use glam::{DAffine3, Vec3};
    use light::{Instance, Mesh};

    use super::*;

    fn quad(size: f32) -> Mesh {
        let corner = |x, z| Vec3::new(x * size, 0.0, z * size);
        let positions = vec![corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)];
        Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() }
    }

    fn placed(meshes: Vec<Mesh>) -> Geometry {
        let instance = |mesh| Instance { mesh: mesh as u32, world_from_mesh: DAffine3::IDENTITY };
        Geometry { instances: (0..meshes.len()).map(instance).collect(), meshes }
    }

    /// Every corner is in the picture, and the tightest side is at the margin exactly.
    #[test]
    fn what_counts_fills_the_frame() {
        let geometry = placed(vec![quad(3.0)]);
        let camera = frame(&geometry, &[]);
        let Projection::Perspective { tan_half_height } = camera.projection else { panic!() };
        let mut fullest = 0.0f64;
        for p in &geometry.meshes[0].positions {
            let p = camera.world_from_camera.transpose() * (p.as_dvec3() - camera.position);
            let (x, y) = (p.x / -p.z / tan_half_height / ASPECT, p.y / -p.z / tan_half_height);
            fullest = fullest.max(x.abs()).max(y.abs());
        }
        // A dozen roundings of numbers below 10.
        assert!((fullest - FILL).abs() < 1e-13, "{fullest}");
    }

    /// Height of the horizon in the picture, from its bottom: (1 + tan 7° / tan 18°) / 2 = 0.689; and a thing as high
    /// as wide reaches above it.
    #[test]
    fn the_horizon_lies_behind_the_model() {
        let wall = Mesh {
            positions: quad(3.0).positions.iter().map(|p| Vec3::new(p.x, p.z, 0.0)).collect(),
            ..quad(3.0)
        };
        let camera = frame(&placed(vec![wall, quad(3.0)]), &[]);
        let Projection::Perspective { tan_half_height } = camera.projection else { panic!() };
        let height = |way: DVec3| {
            let seen = camera.world_from_camera.transpose() * way;
            0.5 + 0.5 * seen.y / -seen.z / tan_half_height
        };
        let ahead = camera.world_from_camera * DVec3::NEG_Z;
        let horizon = height(DVec3::new(ahead.x, 0.0, ahead.z));
        assert!((0.6..0.7).contains(&horizon), "{horizon}");
        let (foot, top) = (DVec3::new(0.0, -3.0, 0.0), DVec3::new(0.0, 3.0, 0.0));
        assert!(height(foot - camera.position) < horizon && height(top - camera.position) > horizon);
    }

    #[test]
    fn a_huge_ground_does_not_count() {
        let alone = frame(&placed(vec![quad(3.0)]), &[]);
        assert_eq!(frame(&placed(vec![quad(3.0), quad(500.0)]), &[]), alone);
        assert_ne!(frame(&placed(vec![quad(3.0), quad(6.0)]), &[]), alone);
    }

    #[test]
    fn nothing_and_a_point_are_framed_too() {
        let point = Mesh { positions: vec![Vec3::ZERO; 3], triangles: vec![[0, 1, 2]], ..Mesh::default() };
        for geometry in [Geometry::default(), placed(vec![Mesh::default()]), placed(vec![point])] {
            let camera = frame(&geometry, &[]);
            assert!(camera.position.is_finite() && camera.near > 0.0);
        }
    }
}
