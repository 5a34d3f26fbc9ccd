//! What light loses and gains along a ray under water.

use std::sync::Arc;

use light::{Path, Ray, Spectrum, Surroundings, Traverse, Way};

use super::FlatWater;
use crate::Loss;

/// Water between things: what the eye sees through it is dimmed by e^(−c r), and the light that it scatters towards the eye is
/// added (3.28), of which every source knows its own share ([`super::Lit`]).
pub struct Fill {
    waters: Arc<[FlatWater]>,
}

impl Fill {
    /// All of these waters.
    pub fn new(waters: Arc<[FlatWater]>) -> Self {
        Self { waters }
    }

    /// The one that a ray runs in; none in air.
    pub fn around(&self, ray: &Ray) -> Option<&FlatWater> {
        filling(&self.waters, ray).map(|i| &self.waters[i])
    }
}

impl Traverse for Fill {
    fn way(&self, ray: &Ray, path: Path, around: &dyn Surroundings) -> Way {
        let Some(i) = filling(&self.waters, ray) else { return Way::CLEAR };
        let water = &self.waters[i].water;
        let transmittance = water.loss(Loss::Beam).attenuate(ray.length.min(f32::MAX));
        let added = match water.scattering().is_zero() || path.share <= 0.0 {
            true => Spectrum::ZERO,
            false => around.scattered(ray),
        };
        Way { transmittance, added }
    }
}

/// Which of the waters a ray runs in. Rays end at surfaces: where one begins tells where all of it is.
pub(super) fn filling(waters: &[FlatWater], ray: &Ray) -> Option<usize> {
    let step = 1e-3f32.min(0.5 * ray.length);
    let begins = ray.at(step).as_dvec3();
    waters.iter().position(|water| water.depth(begins).is_some_and(|depth| depth > 0.0))
}
