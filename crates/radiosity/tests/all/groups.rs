//! Many small faces, seen in groups.

use std::f64::consts::PI;

use glam::{DAffine3, DVec3, Vec3};
use keikan_radiosity::{Between, Cut, Linking, Links, Patch, Patches, Side, Surfaces};
use light::{Geometry, Instance, Mesh, Spectrum, Vacuum};

/// A ball of n × 2n faces about, wound to be seen from outside.
fn ball(n: u32, radius: f32) -> Mesh {
    let at = |i: u32, j: u32| {
        let (theta, phi) = (PI * f64::from(i) / f64::from(n), PI * f64::from(j % (2 * n)) / f64::from(n));
        let out = DVec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
        out.as_vec3() * radius
    };
    let mut mesh = Mesh::default();
    for (i, j) in (0..n).flat_map(|i| (0..2 * n).map(move |j| (i, j))) {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)]);
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    mesh
}

/// The fronts alone.
struct Fronts;

impl Surfaces for Fronts {
    fn takes_part(&self, _: [u32; 2], side: Side) -> bool {
        side == Side::Front
    }

    fn reflectance(&self, _: &Patch) -> Spectrum {
        Spectrum::splat(0.5)
    }
}

#[test]
fn a_ball_of_small_faces_is_a_ball() {
    let (radius, distance) = (0.5f32, 3.0f32);
    // A small leaf that looks at it, inclined.
    let normal = Vec3::new(0.6, -0.8, 0.0);
    let (u, v) = (Vec3::Z * 0.01, normal.cross(Vec3::Z) * 0.01);
    let at = Vec3::Y * distance;
    let leaf = Mesh { positions: vec![at, at + u, at + v], triangles: vec![[0, 1, 2]], ..Mesh::default() };
    let placed = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
    let mut before = usize::MAX;
    for n in [24, 48] {
        let geometry =
            Geometry { meshes: vec![leaf.clone(), ball(n, radius)], instances: vec![placed(0), placed(1)] };
        let patches = Patches::new(&geometry, &Fronts, &Cut { edge: 1.0, ..Cut::default() });
        let links =
            Links::new(&patches, &Between::dry(&Vacuum), &Linking { share: 0.01, ..Linking::default() });
        // An element sees cos θ R²/d² of a ball wholly above its horizon.
        let truth = 0.8 * f64::from(radius / distance).powi(2);
        let found = f64::from(links.closure(&patches)[0][0]);
        // Inscribed faces are smaller by (π/n)²/3 about, 0.6 % for n = 24; groups seen as points from four radii on are off by up to
        // (1/4)² of themselves, either way: 0.2 % of the sum as measured.
        assert!((found / truth - 1.0).abs() < 0.01, "{n}: {found} {truth}");
        // A ball's own faces never see each other; the leaf sees it in groups, however many faces there are.
        let leafs = links.len();
        assert!(leafs / 2 < patches.len() / 2, "{leafs} of {}", patches.len());
        assert!(before == usize::MAX || leafs < 5 * before);
        before = leafs;
    }
}
