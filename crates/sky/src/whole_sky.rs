//! What would a plane of this tilt receive from the whole sky?

use std::f32::consts::PI;

use glam::Vec3;
use light::{Illuminate, Spectrum, Uniform};

use crate::{BandSky, CuboidSky, Dome, PatchSky};

/// What would a plane of this tilt receive from the whole sky?
///
/// Irradiance with nothing in the way, of every stage that answers for sky and ground together; the most that
/// [`Illuminate::irradiance`] of a place with that normal may be. It depends on nothing but the normal.
pub trait WholeSky: Illuminate {
    /// Irradiance on the plane of unit `normal` with nothing in the way \[W m⁻² nm⁻¹\], never negative.
    fn open_irradiance(&self, normal: Vec3) -> Spectrum;

    /// The stage itself, if it finds what a place sees apart from how bright that is; else none.
    fn patches(&self) -> Option<&PatchSky> {
        None
    }
}

impl WholeSky for PatchSky {
    fn open_irradiance(&self, normal: Vec3) -> Spectrum {
        Self::open_irradiance(self, normal)
    }

    fn patches(&self) -> Option<&PatchSky> {
        Some(self)
    }
}

/// The simplest: π times the radiance, for every plane.
impl WholeSky for Uniform {
    fn open_irradiance(&self, _: Vec3) -> Spectrum {
        self.radiance * PI
    }
}

impl WholeSky for Dome {
    fn open_irradiance(&self, normal: Vec3) -> Spectrum {
        Self::open_irradiance(self, normal)
    }
}

impl WholeSky for CuboidSky {
    fn open_irradiance(&self, normal: Vec3) -> Spectrum {
        Self::open_irradiance(self, normal)
    }
}

impl WholeSky for BandSky {
    fn open_irradiance(&self, normal: Vec3) -> Spectrum {
        Self::open_irradiance(self, normal)
    }
}
