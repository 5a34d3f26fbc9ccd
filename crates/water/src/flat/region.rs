//! Where flat water is.

use glam::{DAffine3, DVec2, DVec3};
use light::Mesh;

use crate::{Surface, Water};

/// Water below a level surface with an outline, down to whatever its bottom is.
#[derive(Clone, Debug)]
pub struct FlatWater {
    /// What it does to light.
    pub water: Water,
    /// Height and index.
    pub surface: Surface,
    /// The surface in triangles, x and z in the world \[m\].
    triangles: Vec<[DVec2; 3]>,
    low: DVec2,
    high: DVec2,
}

impl FlatWater {
    /// `water` below `mesh`, which lies about y = 0 and which `place` moves to its level.
    pub fn new(water: Water, mesh: &Mesh, place: &DAffine3) -> Self {
        let at = |i: u32| {
            let p = place.transform_point3(mesh.positions[i as usize].as_dvec3());
            DVec2::new(p.x, p.z)
        };
        let triangles: Vec<[DVec2; 3]> = mesh.triangles.iter().map(|t| t.map(at)).collect();
        let corners = || triangles.iter().flatten().copied();
        Self {
            low: corners().reduce(DVec2::min).unwrap_or(DVec2::INFINITY),
            high: corners().reduce(DVec2::max).unwrap_or(DVec2::NEG_INFINITY),
            surface: Surface::of(&water, place.translation.y),
            water,
            triangles,
        }
    }

    /// The rectangle about the outline: its corners of least and largest x and z \[m\].
    pub fn extent(&self) -> [DVec2; 2] {
        [self.low, self.high]
    }

    /// Whether the vertical through x, z meets the surface; its rim belongs to it.
    pub fn covers(&self, at: DVec2) -> bool {
        let boxed = at.cmpge(self.low).all() && at.cmple(self.high).all();
        boxed && self.triangles.iter().any(|triangle| holds(triangle, at))
    }

    /// How deep below the surface a point lies \[m\], negative above it; none beside the water.
    pub fn depth(&self, point: DVec3) -> Option<f64> {
        self.covers(DVec2::new(point.x, point.z)).then_some(self.surface.level - point.y)
    }
}

/// Whether a point lies in a triangle of either orientation.
fn holds(&[a, b, c]: &[DVec2; 3], p: DVec2) -> bool {
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(p - from));
    sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
}
