//! The sky and the endless ground that lies under it.

use std::f32::consts::{FRAC_1_PI, PI};
use std::sync::Arc;

use glam::Vec3;
use light::{Place, Ray, Spectrum};

use crate::open_sky::OpenSky;
use crate::{Description, Sky};

/// The sky above and a matt ground below the horizon, everywhere of the same radiance
/// L_g = albedo · (E_sky + E_sun)/π, as [`Description`] says.
#[derive(Clone)]
pub(crate) struct Surround {
    pub(crate) sky: Arc<dyn Sky>,
    /// Radiance of the ground \[W m⁻² sr⁻¹ nm⁻¹\].
    pub(crate) ground: Spectrum,
    /// Its height y \[m\]; −∞ = far below.
    height: f32,
}

impl Surround {
    /// `open` is the table of the description's sky.
    pub(crate) fn new(description: &Description, open: &OpenSky) -> Self {
        let arriving = open.horizontal() + description.sun_horizontal;
        Self {
            sky: Arc::clone(&description.sky),
            ground: arriving * (description.albedo.clamp(0.0, 1.0) * FRAC_1_PI),
            height: description.ground_height.unwrap_or(f32::NEG_INFINITY),
        }
    }

    /// Radiance from the unit vector `direction` \[W m⁻² sr⁻¹ nm⁻¹\].
    pub(crate) fn radiance(&self, direction: Vec3) -> Spectrum {
        if direction.y < 0.0 { self.ground } else { self.sky.radiance(direction) }
    }

    /// Irradiance of the ground on the open plane of unit `normal`: π L_g (1 − cos tilt)/2.
    pub(crate) fn ground_irradiance(&self, normal: Vec3) -> Spectrum {
        self.ground * (PI * (0.5 - 0.5 * normal.y).clamp(0.0, 1.0))
    }

    /// How far `place` lies above the ground \[m\], ∞ where that is far below; none for a place beneath it, which
    /// everything lower hides the ground from.
    pub(crate) fn fall(&self, place: &Place) -> Option<f32> {
        let fall = place.position.y - self.height;
        (fall >= 0.0).then_some(fall)
    }

    /// The ray from `place` to where light comes from: the sky, or the ground.
    pub(crate) fn ray(&self, place: &Place, direction: Vec3) -> Ray {
        let length = match self.fall(place) {
            Some(fall) if direction.y < 0.0 => fall / -direction.y,
            _ => f32::INFINITY,
        };
        place.leave(direction, length)
    }
}
