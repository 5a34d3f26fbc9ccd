//! How much of sun and sky reaches the leaves that show, in the mesh and in a crown of even density.

use glam::{DVec3, Vec3};
use light::sampling::lattice;

use crate::reference::Reference;
use crate::species::Species;
use crate::tree_mesh::TreeMesh;

/// View rays, and directions of light for each.
const RAYS: u32 = 600;
const LIGHTS: u32 = 6;

/// The range of what is fitted.
const RANGE: [f32; 2] = [0.25, 8.0];

/// A leaf that shows: where its view ray enters the crown and how long it stays, and where light comes from.
struct Sight {
    entry: Vec3,
    direction: Vec3,
    length: f32,
    share: f32,
    light: [Vec3; LIGHTS as usize],
}

/// The factor on the crown's extinction with which as much light reaches leaves that show, on the mean over views from all around
/// and above and over directions of a uniform sky, as in the mesh. 1 for a mesh that shows no leaves.
pub(super) fn fitted(tree: &TreeMesh, species: &Species) -> f32 {
    let mesh = Reference::new(tree);
    let (mut sights, mut open) = (Vec::new(), 0.0);
    for i in 0..RAYS {
        let Some((sight, origin)) = sight(species, i) else { continue };
        let Some(met) = mesh.first(origin, sight.direction.as_dvec3(), 0.0) else { continue };
        if !met.leaf {
            continue;
        }
        let point = origin + sight.direction.as_dvec3() * met.distance;
        for toward in sight.light {
            // f64: a micrometre off the leaf is off it.
            open += mesh.through(point, toward.as_dvec3(), 1e-6, f64::INFINITY) as f32;
        }
        sights.push(sight);
    }
    if sights.is_empty() {
        return 1.0;
    }
    let modelled = |shelter: f32| {
        let one = |sight: &Sight| {
            let point = sight.entry + sight.direction * species.depth(sight.share, sight.length);
            let chord = |toward: &Vec3| species.description().envelope.chord(point, *toward, f32::INFINITY);
            sight.light.iter().map(|l| (-species.extinction() * shelter * chord(l)).exp()).sum::<f32>()
        };
        sights.iter().map(one).sum::<f32>()
    };
    let [mut low, mut high] = RANGE;
    for _ in 0..12 {
        let middle = (low * high).sqrt();
        if modelled(middle) > open { low = middle } else { high = middle }
    }
    (low * high).sqrt()
}

/// View ray `i` through the envelope, from outside, and its origin; none where it misses.
fn sight(species: &Species, i: u32) -> Option<(Sight, DVec3)> {
    let envelope = &species.description().envelope;
    let ([low, high], widest) = (envelope.heights(), envelope.widest());
    let [a, b] = lattice(i, RAYS, [0x1234_5678, 0]);
    let [c, d] = lattice(i, RAYS, [0, 0x9ABC_DEF0]);
    let turn = std::f32::consts::TAU * b;
    // Views from level to straight down, equally many for each height of the eye on a sphere.
    let up = a;
    let level = (1.0 - up * up).sqrt();
    let direction = -Vec3::new(level * turn.cos(), up, level * turn.sin());
    let (x, y) = direction.any_orthonormal_pair();
    let reach = widest.max(0.5 * (high - low));
    let aim = Vec3::Y * (0.5 * (low + high)) + (x * (2.0 * c - 1.0) + y * (2.0 * d - 1.0)) * reach;
    let origin = aim - direction * (4.0 * reach);
    let [from, to] = envelope.meet(origin, direction)?;
    let light = std::array::from_fn(|k| {
        let [u, v] = lattice(k as u32, LIGHTS, light::sampling::shift(i, 3));
        let (sin, cos) = (std::f32::consts::TAU * v).sin_cos();
        // Cosine-weighted about the zenith, as what falls on level ground.
        Vec3::new(u.sqrt() * cos, (1.0 - u).sqrt(), u.sqrt() * sin)
    });
    let [share, _] = lattice(i, RAYS, light::sampling::shift(i, 5));
    let entry = origin + direction * from;
    Some((Sight { entry, direction, length: to - from, share, light }, origin.as_dvec3()))
}
