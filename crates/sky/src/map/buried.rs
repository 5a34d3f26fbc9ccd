//! Points inside of what stands on a face.

use glam::DVec2;
use light::{Spectrum, Triangle};

use super::tree::{FaceMap, layout};

/// Light that ends within one cell is less than this where it fades by itself: cells are cut where it bends, and to fall
/// from a tenth of the open sky to nothing within the finest takes an edge a few cells above the face at most.
const SUDDEN: f32 = 0.1;

/// Gives points at which nothing at all arrives the mean of their lit neighbours.
///
/// Light falls from what it is at the foot of a wall to nothing within a finest cell only where something touches the
/// face: the dark points are inside, where nobody looks, but would darken the whole rim. Their neighbours are the
/// other ends of the finest cells' edges; across longer ones light fades by itself. Faces so large that no cell is
/// as fine (longer than 4096 × `least` \[m\]) keep their dark rims.
///
/// `shared` tells which of the face's edges (edge k from corner k to the next) and corners other faces have too: points
/// of such an edge only look along it, as they do from the other face, and such corners stay dark.
pub(crate) fn fill(map: &mut FaceMap, world: &Triangle, least: f32, shared: Shared) {
    let dark = |value: &Spectrum| value.is_zero();
    if !map.values.iter().any(dark) || map.values.iter().all(dark) {
        return;
    }
    let (points, leaves) = layout(&map.nodes, map.values.len());
    // Edges are cut down to below twice `least`. A little more, so that two faces' rounding decides the same.
    let finest = 2.0 * f64::from(least) * (1.0 + 1e-6);
    let [p, q, r] = world.0;
    let mut sums = vec![(Spectrum::ZERO, 0u32); points.len()];
    for [a, b, c] in leaves {
        for [from, to] in [[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]] {
            let [from, to] = [from as usize, to as usize];
            if !dark(&map.values[from]) || map.values[to].max() <= SUDDEN {
                continue;
            }
            let way = points[to] - points[from];
            let length = ((q - p) * way.x + (r - p) * way.y).length();
            if length < finest && shared.may_look(points[from], points[to]) {
                sums[from].0 += map.values[to];
                sums[from].1 += 1;
            }
        }
    }
    for (value, (sum, count)) in map.values.iter_mut().zip(sums).filter(|(_, (_, count))| *count > 0) {
        *value = sum * (1.0 / count as f32);
    }
}

/// What of a face other faces have too.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shared {
    pub(crate) edges: [bool; 3],
    pub(crate) corners: [bool; 3],
}

impl Shared {
    fn may_look(&self, from: DVec2, to: DVec2) -> bool {
        let [here, there] = [from, to].map(|at| [1.0 - at.x - at.y, at.x, at.y]);
        if let Some(corner) = here.iter().position(|&weight| weight == 1.0) {
            return !self.corners[corner];
        }
        // On edge k the weight of the corner across from it is 0.
        (0..3).all(|k| !self.edges[k] || here[(k + 2) % 3] != 0.0 || there[(k + 2) % 3] == 0.0)
    }
}
