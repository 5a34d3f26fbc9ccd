//! Where flat water is.

use glam::{DAffine3, DVec2, DVec3};
use light::{Mesh, Spectrum};

/// Water below a level surface with an outline, down to whatever its bottom is.
#[derive(Clone, Debug)]
pub struct FlatWater {
    /// Height y of the surface in the world \[m\].
    pub level: f64,
    /// Index of refraction relative to air, > 1.
    pub index: f64,
    /// Absorption a and scattering b \[1/m\].
    pub absorption: Spectrum,
    /// See [`Self::absorption`].
    pub scattering: Spectrum,
    /// The surface in triangles, x and z in the world \[m\].
    triangles: Vec<[DVec2; 3]>,
    low: DVec2,
    high: DVec2,
}

impl FlatWater {
    /// Clear water below `surface`, a mesh about y = 0 that `place` moves to its level.
    pub fn new(surface: &Mesh, place: &DAffine3, index: f64) -> Self {
        let at = |i: u32| {
            let p = place.transform_point3(surface.positions[i as usize].as_dvec3());
            DVec2::new(p.x, p.z)
        };
        let triangles: Vec<[DVec2; 3]> = surface.triangles.iter().map(|t| t.map(at)).collect();
        let corners = || triangles.iter().flatten().copied();
        Self {
            low: corners().reduce(DVec2::min).unwrap_or(DVec2::INFINITY),
            high: corners().reduce(DVec2::max).unwrap_or(DVec2::NEG_INFINITY),
            level: place.translation.y,
            index,
            absorption: Spectrum::ZERO,
            scattering: Spectrum::ZERO,
            triangles,
        }
    }

    /// What image-forming light loses: c = a + b \[1/m\].
    pub fn extinction(&self) -> Spectrum {
        self.absorption + self.scattering
    }

    /// Whether the vertical through x, z meets the surface; its rim belongs to it.
    pub fn covers(&self, at: DVec2) -> bool {
        let boxed = at.cmpge(self.low).all() && at.cmple(self.high).all();
        boxed && self.triangles.iter().any(|triangle| holds(triangle, at))
    }

    /// How deep below the surface a point lies \[m\], negative above it; none beside the water.
    pub fn depth(&self, point: DVec3) -> Option<f64> {
        self.covers(DVec2::new(point.x, point.z)).then_some(self.level - point.y)
    }
}

/// Whether a point lies in a triangle of either orientation.
fn holds(&[a, b, c]: &[DVec2; 3], p: DVec2) -> bool {
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(p - from));
    sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
}
