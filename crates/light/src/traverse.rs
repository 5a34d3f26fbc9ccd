//! What does light lose and gain between two points?

use crate::{Path, Ray, Spectrum, Surroundings};

/// What becomes of light on its way along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Share of the radiance at the far end that arrives at the origin, per band, within \[0, 1\].
    pub transmittance: Spectrum,
    /// Radiance scattered into the ray on the way, as it arrives at the origin \[W m⁻² sr⁻¹ nm⁻¹\], ≥ 0.
    pub added: Spectrum,
}

impl Way {
    /// Through nothing.
    pub const CLEAR: Self = Self { transmittance: Spectrum::ONE, added: Spectrum::ZERO };

    /// First this, then, beyond it, `far`.
    #[must_use]
    pub fn then(self, far: Self) -> Self {
        Self {
            transmittance: self.transmittance * far.transmittance,
            added: self.added + self.transmittance * far.added,
        }
    }

    /// What arrives of `radiance` at the far end, with what is added.
    pub fn bring(&self, radiance: Spectrum) -> Spectrum {
        radiance * self.transmittance + self.added
    }
}

/// What does light lose and gain on its way towards the origin of a ray, through what fills the space there?
///
/// For what the eye sees along straight rays (the eye's own, mirrored and refracted ones). What sources lose on their way to a
/// place, they say themselves ([`crate::Illuminate`]).
pub trait Traverse: Send + Sync {
    /// Along `ray`, up to its length; `around` tells what arrives at places on the way.
    fn way(&self, ray: &Ray, path: Path, around: &dyn Surroundings) -> Way;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_add_up_in_the_order_that_light_takes() {
        let way =
            |t: f32, added: f32| Way { transmittance: Spectrum::splat(t), added: Spectrum::splat(added) };
        let (near, far) = (way(0.5, 1.0), way(0.25, 2.0));
        // From 8 at the end: 8/4 + 2 = 4, 4/2 + 1 = 3.
        assert_eq!(far.bring(Spectrum::splat(8.0)), Spectrum::splat(4.0));
        assert_eq!(near.then(far).bring(Spectrum::splat(8.0)), Spectrum::splat(3.0));
        assert_eq!(Way::CLEAR.then(near), near);
        assert_eq!(near.then(Way::CLEAR), near);
    }
}
