//! Rays at triangles from tenths of a millimetre to continents.

use std::sync::Arc;

use glam::{DAffine3, Vec3};
use light::{Geometry, Instance, Mesh, Nearest, Occlude, Ray};
use raytrace::{BruteForce, Quality, World};

use crate::ledger::{Ledger, drawn, power};

#[test]
fn rays_of_all_sizes() {
    let ledger = Ledger::new("ray");
    let mut differ = 0;
    let corner = || proptest::array::uniform3(-1.0f32..1.0);
    let cases = (
        proptest::collection::vec(proptest::array::uniform3(corner()), 1..60),
        -4.0f64..6.0,
        corner(),
        corner(),
    );
    for (soup, exponent, from, to) in drawn(&cases, 400) {
        let scale = power(exponent) as f32;
        let positions: Vec<Vec3> = soup.iter().flatten().map(|corner| Vec3::from(*corner) * scale).collect();
        let triangles = (0..soup.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Mesh { positions, triangles, ..Mesh::default() };
        let placed = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
        let geometry = Arc::new(Geometry { meshes: vec![mesh], instances: vec![placed] });
        let (fast, slow) =
            (World::build(Arc::clone(&geometry), Quality::default()), BruteForce::new(geometry));
        let origin = Vec3::from(from) * 3.0 * scale;
        let Some(direction) = (Vec3::from(to) * scale - origin).try_normalize() else { continue };
        let ray = Ray::new(origin, direction);
        let at = (scale, from, to);
        let (near, truth) = (fast.nearest(&ray), slow.nearest(&ray));
        if let (Some(near), Some(truth)) = (near, truth) {
            if near.triangle == truth.triangle {
                let apart = f64::from(near.place.position.distance(truth.place.position));
                let allowed = f64::from(near.place.error + truth.place.error);
                ledger.note("hits within their stated errors", apart / allowed, 1.0, at);
            }
            // A ray that leaves a hit does not meet the face that it leaves.
            let away = near.place.leave(near.place.normal, f32::INFINITY);
            let again = fast.nearest(&away).is_some_and(|hit| hit.triangle == near.triangle);
            ledger.holds("no face shades itself", !again, at);
        }
        // At an edge the two may disagree by rounding: then neither is far from it.
        let same = near.map(|hit| hit.triangle) == truth.map(|hit| hit.triangle);
        differ += u32::from(!same);
        ledger.holds(
            "blocked where something is met",
            fast.transmittance(&ray).is_zero() == near.is_some(),
            at,
        );
    }
    // Of 400 rays none is within rounding of an edge by chance but one in thousands.
    ledger.note("as every face in turn: share of rays that differ", f64::from(differ) / 400.0, 0.005, "all");
    ledger.close();
}
