//! What an eye sees of a stand (thesis 5.1 to 5.3).

use light::{Path, Ray, Spectrum, Surroundings, Traverse, Way};

use crate::leaf::{self, Fields, Shading};
use crate::stand::Stand;

/// What lets less than this through is opaque: half a step of 8 bits.
const OPAQUE: f32 = 1.0 / 512.0;

/// Crossings of a smaller share look as those in front of them do on average: asking for light is dear.
const SLIGHT: f32 = 1.0 / 128.0;

impl Traverse for Stand {
    /// Planes from near to far, which gives what far to near does and may stop (thesis eq. 5.1 to 5.3):
    ///
    ///   added = Σ_k o_k C_k Π_(nearer j) (1 − o_j),   transmittance = Π (1 − o_k),   o = alpha × opacity of the plane
    fn way(&self, ray: &Ray, path: Path, around: &dyn Surroundings) -> Way {
        let (mut left, mut added, mut shaded) = (1.0f32, Spectrum::ZERO, 0.0f32);
        let mut fields: Vec<(u32, Fields)> = Vec::new();
        self.crossings(ray, &path, |crossing| {
            let share = left * crossing.opacity;
            if share >= SLIGHT || shaded == 0.0 {
                let known = fields.iter().find(|(tree, _)| *tree == crossing.tree);
                let fields = known.map(|(_, fields)| *fields).unwrap_or_else(|| {
                    let asked = match self.shading {
                        Shading::Leaves => Fields::new(&crossing.place, around),
                        Shading::Thesis { .. } => Fields::NONE,
                    };
                    fields.push((crossing.tree, asked));
                    asked
                });
                let species = &self.species[self.trees[crossing.tree as usize].species as usize];
                let lit = (&fields, -ray.direction);
                added += leaf::radiance(crossing, species, self.shading, lit, around) * share;
                shaded += share;
            } else {
                added += added * (share / shaded);
                shaded += share;
            }
            left *= 1.0 - crossing.opacity;
            left > OPAQUE
        });
        let left = if left > OPAQUE { left } else { 0.0 };
        Way { transmittance: Spectrum::splat(left), added }
    }
}
