//! Scenes for tests, and an occluder that looks at every triangle.

use glam::{DAffine3, DVec3, Vec3};
use light::{Geometry, Instance, Mesh, Occlude, Ray, Spectrum, Triangle};

/// The unit cube around the origin.
fn cube() -> Mesh {
    let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) - 0.5;
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        ..Mesh::default()
    }
}

/// Boxes by their middles, sizes and turns about y \[rad\].
pub(crate) fn boxes(placed: impl IntoIterator<Item = (DVec3, DVec3, f64)>) -> Geometry {
    let instance = |(middle, size, turn)| Instance {
        mesh: 0,
        world_from_mesh: DAffine3::from_translation(middle)
            * DAffine3::from_rotation_y(turn)
            * DAffine3::from_scale(size),
    };
    Geometry { meshes: vec![cube()], instances: placed.into_iter().map(instance).collect() }
}

/// Boxes that stand on y = 0 in a square of `width`, but for a clearing in its middle, and the ground.
pub(crate) fn town(count: u32, width: f64, seed: u32) -> Geometry {
    let random = |i: u32, k: u32| {
        f64::from(light::sampling::scramble(seed ^ (i * 8 + k).wrapping_mul(0x9E37_79B9)))
            / f64::from(u32::MAX)
    };
    let house = |i: u32| {
        let [x, z] = [0, 1].map(|k| (random(i, k) - 0.5) * width);
        let size = DVec3::new(1.0 + 5.0 * random(i, 2), 1.0 + 9.0 * random(i, 3), 1.0 + 5.0 * random(i, 4));
        (DVec3::new(x, 0.5 * size.y, z), size, 3.0 * random(i, 5))
    };
    let ground = (DVec3::new(0.0, -0.5, 0.0), DVec3::new(2.0 * width, 1.0, 2.0 * width), 0.0);
    let clear = |(middle, ..): &(DVec3, DVec3, f64)| middle.x.hypot(middle.z) > 5.0;
    boxes((0..count).map(house).filter(clear).chain([ground]))
}

/// A street along x, 12 m wide, between houses of 9 and 15 m, on y = 0.
pub(crate) fn canyon() -> Geometry {
    boxes([
        (DVec3::new(0.0, 4.5, -11.0), DVec3::new(80.0, 9.0, 10.0), 0.0),
        (DVec3::new(0.0, 7.5, 11.0), DVec3::new(80.0, 15.0, 10.0), 0.0),
        (DVec3::new(0.0, -0.5, 0.0), DVec3::new(400.0, 1.0, 400.0), 0.0),
    ])
}

/// Whether a half-line meets a triangle: 1 or −1 clearly, 0 within `unsure` (weights, and share of the length) of
/// either answer. Triangles whose plane is within `error` \[m\] of the origin are not met.
pub(crate) fn meets(
    geometry: &Geometry,
    (origin, error): (DVec3, f64),
    direction: DVec3,
    least_height: f64,
    unsure: f64,
) -> i32 {
    let mut best = -1;
    for (i, instance) in geometry.instances.iter().enumerate() {
        for t in 0..geometry.meshes[instance.mesh as usize].triangles.len() {
            let triangle = geometry.triangle(i as u32, t as u32);
            let Some(at) = triangle.meet(origin, direction) else { continue };
            let [a, b, c] = triangle.0;
            if (origin - b).dot(triangle.cross().normalize_or_zero()).abs() <= error {
                continue;
            }
            let met = a + (b - a) * at.x + (c - a) * at.y;
            let ahead = (met - origin).dot(direction) / (a - origin).length().max(b.distance(a));
            let above = (met.y - least_height) / met.distance(origin).max(1.0);
            let inside = at.x.min(at.y).min(1.0 - at.x - at.y).min(ahead).min(above);
            best = best.max(if inside > unsure {
                1
            } else if inside >= -unsure {
                0
            } else {
                -1
            });
        }
    }
    best
}

/// Looks at every triangle; nothing passes. What is met within a micrometre is what the ray leaves: a face that the
/// place lies on, though it is not its own.
pub(crate) struct Plain(Vec<Triangle>);

impl Plain {
    pub(crate) fn new(geometry: &Geometry) -> Self {
        let of = |i: usize| {
            let mesh = &geometry.meshes[geometry.instances[i].mesh as usize];
            (0..mesh.triangles.len()).map(move |t| geometry.triangle(i as u32, t as u32))
        };
        Self((0..geometry.instances.len()).flat_map(of).collect())
    }
}

impl Occlude for Plain {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let (origin, direction) = (segment.origin.as_dvec3(), segment.direction.as_dvec3());
        let blocks = |triangle: &Triangle| {
            let [a, b, c] = triangle.0;
            triangle.meet(origin, direction).is_some_and(|at| {
                let met = a + (b - a) * at.x + (c - a) * at.y;
                let distance = (met - origin).dot(direction);
                let within = distance > 1e-6 && distance < f64::from(segment.length);
                at.min_element() >= 0.0 && at.element_sum() <= 1.0 && within
            })
        };
        if self.0.iter().any(blocks) { Spectrum::ZERO } else { Spectrum::ONE }
    }
}
