//! Things that only rays can tell of.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DAffine3;
use light::{Hit, Hull, Instance, Opacity};

use super::*;

/// Lets half through, and counts how often it is asked.
#[derive(Default)]
struct Half(AtomicUsize);

impl Occlude for Half {
    fn transmittance(&self, _: &Ray) -> Spectrum {
        self.0.fetch_add(1, Ordering::Relaxed);
        Spectrum::splat(0.5)
    }
}

/// A box of a veil around the place, and a solid one beyond it at x > 2.
fn veiled() -> Geometry {
    let mut geometry = boxes([(DVec3::ZERO, DVec3::splat(2.0), 0.3), (DVec3::ZERO, DVec3::ONE, 0.0)]);
    let solid = geometry.meshes[0].clone();
    geometry.meshes[0].opacity = Some(Arc::new(Opacity { texture: None, factor: 0.5, cutoff: None }));
    geometry.meshes.push(solid);
    let beyond =
        DAffine3::from_translation(DVec3::new(52.0, 0.0, 0.0)) * DAffine3::from_scale(DVec3::splat(100.0));
    geometry.instances[1] = Instance { mesh: 1, world_from_mesh: beyond };
    geometry
}

#[test]
fn veils_are_asked_about_only_where_nothing_solid_is() {
    let description = luminous(Distribution::CIE_CLEAR, 50.0);
    let geometry = veiled();
    let solid = Geometry { instances: geometry.instances[1..].to_vec(), ..geometry.clone() };
    for parts in [1, 2] {
        let [both, alone] = [&geometry, &solid].map(|scene| cuboid(&description, scene, 16, parts));
        for normal in [Vec3::Y, Vec3::new(0.6, 0.8, 0.0), Vec3::NEG_Z] {
            let at = place(Vec3::new(0.1, 0.2, 0.3), normal);
            let half = Half::default();
            let through = both.irradiance(&at, &half);
            let open = alone.irradiance(&at, &Vacuum);
            // All that the solid box leaves passes the veil. One rounding for each ray.
            let asked = half.0.load(Ordering::Relaxed);
            let bound = asked as f32 * f32::EPSILON * open.max();
            assert!((through - open * 0.5).map(f32::abs).max() <= bound, "{parts} {normal}");
            let bits = parts as usize * parts as usize;
            let elements = both.layout().elements().count() * bits;
            assert!(asked > elements / 8 && asked < elements / 2, "{asked} of {elements}");
        }
    }
}

/// A body known by its hull: a tetrahedron over the place.
struct Tent([Hull; 1]);

impl Bodies for Tent {
    fn hulls(&self) -> &[Hull] {
        &self.0
    }
    fn meet(&self, _: u32, _: (DVec3, DVec3), _: f64) -> Option<f64> {
        None
    }
    fn hit(&self, _: u32, _: (DVec3, DVec3), _: f64, ray: &Ray, _: f32) -> Hit {
        Geometry::hit(&canyon(), 0, 0, glam::DVec2::ZERO, ray, 0.0)
    }
}

#[test]
fn hulls_of_bodies_are_asked_about_by_rays() {
    let corners = [(-1.0, 2.0, -1.0), (1.0, 2.0, -1.0), (0.0, 2.0, 1.5), (0.0, 3.0, 0.0)];
    let hull = Hull {
        body: 0,
        corners: corners.map(|(x, y, z)| DVec3::new(x, y, z)).to_vec(),
        faces: vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]],
    };
    let tent = Tent([hull]);
    let sky = CuboidSky::new(&uniform(), &Geometry::default(), Some(&tent), Division::default());
    let at = place(Vec3::ZERO, Vec3::Y);
    let [clear, half] = [&Vacuum as &dyn Occlude, &Half::default()].map(|o| sky.irradiance(&at, o)[0]);
    let open = sky.open_irradiance(Vec3::Y)[0];
    assert!((clear / open - 1.0).abs() < 1e-5, "rounding of some hundred sums: {clear} {open}");
    assert!(half < 0.95 * open && half > 0.6 * open, "{half} {open}");
}
