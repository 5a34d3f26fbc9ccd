//! Bodies of still water: where they are, and what they do to light.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::bands::Bands;
use crate::phase::Phase;

/// Water below a level surface with an outline, down to whatever its bottom is.
pub struct Water {
    /// Height y of the surface \[m\].
    pub level: f64,
    /// Triangles of the surface, x and z \[m\], of any orientation.
    pub triangles: Vec<[DVec2; 3]>,
    /// Index of refraction relative to air, > 0.
    pub index: f64,
    /// Absorption coefficient \[1/m\].
    pub absorption: Bands,
    /// What scatters: coefficient \[1/m\], and where to.
    pub scatterers: Vec<(Bands, Phase)>,
}

impl Water {
    /// The point of the surface at x, z.
    pub(crate) fn at(&self, at: DVec2) -> DVec3 {
        DVec3::new(at.x, self.level, at.y)
    }

    /// Whether the vertical through x, z meets the surface.
    pub(crate) fn covers(&self, at: DVec2) -> bool {
        self.triangles.iter().any(|&[a, b, c]| {
            let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(at - from));
            sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
        })
    }

    /// Whether a point is in it.
    pub(crate) fn holds(&self, point: DVec3) -> bool {
        point.y < self.level && self.covers(DVec2::new(point.x, point.z))
    }

    /// All that is scattered \[1/m\].
    pub(crate) fn scattering(&self) -> Bands {
        self.scatterers.iter().fold(Bands::ZERO, |sum, (scattering, _)| sum + *scattering)
    }

    /// All that is absorbed or scattered \[1/m\].
    pub(crate) fn extinction(&self) -> Bands {
        self.absorption + self.scattering()
    }

    /// Edges of one triangle only.
    pub(crate) fn outline(&self) -> Vec<[DVec2; 2]> {
        let key = |at: DVec2| [at.x.to_bits(), at.y.to_bits()];
        let mut edges: BTreeMap<[[u64; 2]; 2], (u32, [DVec2; 2])> = BTreeMap::new();
        for &[a, b, c] in &self.triangles {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let (k, l) = (key(from), key(to));
                edges.entry([k.min(l), k.max(l)]).or_insert((0, [from, to])).0 += 1;
            }
        }
        edges.into_values().filter(|(count, _)| *count == 1).map(|(_, edge)| edge).collect()
    }
}
