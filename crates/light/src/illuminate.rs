//! What arrives at this place, from where?

use std::f32::consts::PI;
use std::sync::Arc;

use glam::Vec3;

use crate::{Occlude, Place, Ray, Spectrum};

/// Light that arrives at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arrival {
    /// From one direction.
    Beam {
        /// Unit vector towards where the light comes from.
        toward: Vec3,
        /// Irradiance on a plane that *faces* the source \[W m⁻² nm⁻¹\].
        irradiance: Spectrum,
        /// Angular radius of the source \[rad\], which mirrors show as a disc; 0 = a point, of which they show a glint as
        /// wide as the bundle of rays that meets it; none = not to be seen in mirrors.
        radius: Option<f32>,
    },
    /// From many directions, already weighed with the cosine at the place's own normal.
    Field {
        /// Irradiance on the place's plane \[W m⁻² nm⁻¹\].
        irradiance: Spectrum,
    },
}

impl Arrival {
    /// Irradiance on a plane of unit normal `normal` \[W m⁻² nm⁻¹\]; 0 from behind it.
    pub fn on_plane(&self, normal: Vec3) -> Spectrum {
        match *self {
            Self::Beam { toward, irradiance, .. } => irradiance * toward.dot(normal).max(0.0),
            Self::Field { irradiance } => irradiance,
        }
    }

    /// Irradiance on the place's plane by extended light, 0 of a beam \[W m⁻² nm⁻¹\].
    pub fn extended(&self) -> Spectrum {
        match *self {
            Self::Beam { .. } => Spectrum::ZERO,
            Self::Field { irradiance } => irradiance,
        }
    }
}

/// What arrives at this place, from where?
///
/// Irradiance facing the source with its direction, or on the place's plane for extended sources
/// \[W m⁻² nm⁻¹\], never negative; calling `receive` never means no light. Light from behind the place's
/// plane need not be reported. Asks `occlude` itself, once per segment that light travels.
pub trait Illuminate: Send + Sync {
    /// Reports everything that arrives at `place`.
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival));

    /// The same for a place on triangle \[instance, triangle\] of the geometry, where that is known: for sources that
    /// keep by faces what they have found before.
    fn arrivals_on(
        &self,
        face: [u32; 2],
        place: &Place,
        occlude: &dyn Occlude,
        receive: &mut dyn FnMut(Arrival),
    ) {
        let _ = face;
        self.arrivals(place, occlude, receive);
    }

    /// Of extended light alone, irradiance on the place's plane and on its other side \[W m⁻² nm⁻¹\]: for leaves, which both light.
    fn both_sides(&self, place: &Place, occlude: &dyn Occlude) -> [Spectrum; 2] {
        [*place, place.flipped()].map(|place| {
            let mut sum = Spectrum::ZERO;
            self.arrivals(&place, occlude, &mut |arrival| sum += arrival.extended());
            sum
        })
    }

    /// Radiance of the source itself where `ray` leaves the scene unhindered \[W m⁻² sr⁻¹ nm⁻¹\]; 0 for
    /// sources too small to be seen.
    fn radiance(&self, ray: &Ray) -> Spectrum {
        let _ = ray;
        Spectrum::ZERO
    }

    /// Radiance of this source's light that what fills the space scatters into `ray`, up to its length, as it arrives at
    /// its origin \[W m⁻² sr⁻¹ nm⁻¹\], ≥ 0; 0 in clear air.
    fn scattered(&self, ray: &Ray, occlude: &dyn Occlude) -> Spectrum {
        let _ = (ray, occlude);
        Spectrum::ZERO
    }

    /// Irradiance on the place's own plane \[W m⁻² nm⁻¹\]: all arrivals together.
    fn irradiance(&self, place: &Place, occlude: &dyn Occlude) -> Spectrum {
        let mut sum = Spectrum::ZERO;
        self.arrivals(place, occlude, &mut |arrival| sum += arrival.on_plane(place.normal));
        sum
    }
}

/// A shared source is a source.
impl<T: Illuminate + ?Sized> Illuminate for Arc<T> {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        (**self).arrivals(place, occlude, receive);
    }

    fn arrivals_on(
        &self,
        face: [u32; 2],
        place: &Place,
        occlude: &dyn Occlude,
        receive: &mut dyn FnMut(Arrival),
    ) {
        (**self).arrivals_on(face, place, occlude, receive);
    }

    fn both_sides(&self, place: &Place, occlude: &dyn Occlude) -> [Spectrum; 2] {
        (**self).both_sides(place, occlude)
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        (**self).radiance(ray)
    }

    fn scattered(&self, ray: &Ray, occlude: &dyn Occlude) -> Spectrum {
        (**self).scattered(ray, occlude)
    }
}

/// The same radiance from everywhere, nothing in the way: the null answer, and the furnace of tests.
#[derive(Clone, Copy, Debug, Default)]
pub struct Uniform {
    /// Radiance \[W m⁻² sr⁻¹ nm⁻¹\].
    pub radiance: Spectrum,
}

impl Illuminate for Uniform {
    fn arrivals(&self, _: &Place, _: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        receive(Arrival::Field { irradiance: self.radiance * PI });
    }

    fn radiance(&self, _: &Ray) -> Spectrum {
        self.radiance
    }
}
