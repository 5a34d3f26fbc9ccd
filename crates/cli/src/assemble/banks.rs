//! Whether waters are closed: a bank all around.

use glam::{DVec2, DVec3};
use light::{Nearest, Ray};
use scene::Scene;
use water::flat::FlatWater;

/// Places looked at along each outline, at least one for every edge.
const PLACES: f64 = 64.0;

/// How far inside the outline and below the level one looks from \[m\].
const INSIDE: f64 = 0.01;

/// A bank is no farther off than this \[m\].
const FARTHEST: f32 = 100.0;

/// A warning for each water that is open at places along its edge: neither does the outline lie in the ground there, nor is there
/// a face or a solid beside it. `nearest` knows no water surfaces. Water without any bed at all is a sea, and none is missed there.
pub(super) fn warnings(scene: &Scene, waters: &[FlatWater], nearest: &dyn Nearest) -> Vec<String> {
    let of = |(water, flat): (&scene::Water, &FlatWater)| {
        let places = places(flat);
        let met = |from: DVec3, way: DVec3, length: f32| {
            nearest.nearest(&Ray { length, ..Ray::new(from.as_vec3(), way.as_vec3()) })
        };
        let bed = |&(at, _): &(DVec3, DVec3)| met(at, DVec3::NEG_Y, f32::INFINITY).is_some();
        if !places.iter().any(bed) {
            return None;
        }
        // Below a bank that the outline is drawn into, the back of its top is above; a roof shows its underside.
        let under = |at: DVec3| met(at, DVec3::Y, FARTHEST).is_some_and(|hit| !hit.front);
        let open: Vec<DVec3> = places
            .iter()
            .filter(|(at, out)| met(*at, *out, FARTHEST).is_none() && !under(*at))
            .map(|(at, _)| *at + scene.origin)
            .collect();
        let first = open.first()?;
        Some(format!(
            "[[water]] {:?} is not closed: at {} of {} places along its edge there is no bank, the first at [{:.2}, {:.2}, {:.2}]; light \
             leaves the water there through its side, unseen",
            water.name,
            open.len(),
            places.len(),
            first.x,
            first.y,
            first.z
        ))
    };
    scene.waters.iter().zip(waters).filter_map(of).collect()
}

/// Places just inside the outline and below the surface, each with the way out.
fn places(water: &FlatWater) -> Vec<(DVec3, DVec3)> {
    let edges = water.outline();
    let around: f64 = edges.iter().map(|[a, b]| a.distance(*b)).sum();
    let of = |&[a, b]: &[DVec2; 2]| {
        let along = (b - a).normalize_or_zero();
        // Out is on one side for all edges of one turn; which one, the surface itself tells.
        let aside = along.perp();
        let inside = |at: DVec2| [aside, -aside].into_iter().find(|aside| water.covers(at - *aside * INSIDE));
        let count = (PLACES * a.distance(b) / around.max(f64::MIN_POSITIVE)).ceil().clamp(1.0, PLACES) as u32;
        let place = move |i: u32| {
            let at = a.lerp(b, (f64::from(i) + 0.5) / f64::from(count));
            let out = inside(at)?;
            let from = at - out * INSIDE;
            Some((DVec3::new(from.x, water.surface.level - INSIDE, from.y), DVec3::new(out.x, 0.0, out.y)))
        };
        (0..count).filter_map(place).collect::<Vec<_>>()
    };
    edges.iter().flat_map(of).collect()
}
