//! What leaves this hit towards the eye?

use std::f32::consts::FRAC_1_PI;

use crate::{Arrival, Hit, Path, Place, Ray, Spectrum};

/// What a shader may ask of everything around its hit. The pipeline answers.
pub trait Surroundings {
    /// All light that arrives at `place`, from every source, each already past what occludes it.
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival));

    /// Of that, only what arrives as beams, for surfaces that extended light does nothing to: clear glass and
    /// mirrors, which see it along their rays. Extended light is the costly part.
    fn beams(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        self.arrivals(place, &mut |arrival| {
            if matches!(arrival, Arrival::Beam { .. }) {
                receive(arrival);
            }
        });
    }

    /// Of that, what is extended, on the place's plane and on its other side \[W m⁻² nm⁻¹\]: [`crate::Illuminate::both_sides`] of all.
    fn both_sides(&self, place: &Place) -> [Spectrum; 2] {
        [*place, place.flipped()].map(|place| {
            let mut sum = Spectrum::ZERO;
            self.arrivals(&place, &mut |arrival| sum += arrival.extended());
            sum
        })
    }

    /// Radiance that what fills the space scatters into `ray`, of the light of every source, as it arrives at its origin
    /// \[W m⁻² sr⁻¹ nm⁻¹\]: [`crate::Illuminate::scattered`] of all.
    fn scattered(&self, ray: &Ray) -> Spectrum {
        let _ = ray;
        Spectrum::ZERO
    }

    /// Radiance that comes back along a further ray (mirrored, refracted) \[W m⁻² sr⁻¹ nm⁻¹\]. `path` is
    /// the further ray's own: the pipeline answers 0 where its share or depth is past the limit.
    fn radiance(&self, ray: &Ray, path: Path) -> Spectrum;
}

/// What leaves this hit towards the eye?
///
/// Radiance along `hit.toward_eye` \[W m⁻² sr⁻¹ nm⁻¹\], never negative; 0 means black.
pub trait Shade: Send + Sync {
    /// The radiance of one hit.
    fn radiance(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum;

    /// The same for many hits: `out[i]` answers `hits[i]`. Both slices have one length.
    fn radiances(&self, hits: &[Hit], around: &dyn Surroundings, out: &mut [Spectrum]) {
        for (hit, out) in hits.iter().zip(out) {
            *out = self.radiance(hit, around);
        }
    }
}

/// A perfectly diffuse surface of one reflectance: the null answer.
///
/// L = ρ E / π.
#[derive(Clone, Copy, Debug)]
pub struct Lambert {
    /// Reflectance ρ per band, within \[0, 1\].
    pub reflectance: Spectrum,
}

impl Shade for Lambert {
    fn radiance(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum {
        let mut irradiance = Spectrum::ZERO;
        around.arrivals(&hit.place, &mut |arrival| irradiance += arrival.on_plane(hit.shading_normal));
        self.reflectance * irradiance * FRAC_1_PI
    }
}

/// Surroundings without any light.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dark;

impl Surroundings for Dark {
    fn arrivals(&self, _: &Place, _: &mut dyn FnMut(Arrival)) {}

    fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
        Spectrum::ZERO
    }
}
