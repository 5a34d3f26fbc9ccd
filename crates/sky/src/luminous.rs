//! A sky made of a distribution of luminance and of a colour.

use std::sync::Arc;

use glam::Vec3;
use light::Spectrum;

use crate::sky::lifted;
use crate::{Distribution, Sky};

/// Correlated colour temperature of an overcast sky's light \[K\] (CIE D65).
pub const OVERCAST_TEMPERATURE: f64 = 6_500.0;

/// A sky whose luminance is exactly that of a distribution, and whose colour is borrowed.
///
///   L(ω) = L_v(ω) (s · clear(ω)/|clear(ω)|_v + (1 − s) · D)
///
/// L_v is the luminance; s the share of clear sky; |·|_v luminance, so that both spectra have a luminance of 1.
/// clear(ω) is another sky that has a spectrum of its own in each direction, such as the light scattered by
/// clear air ([`crate::AirSky`]); D is daylight of [`OVERCAST_TEMPERATURE`], the colour of clouds. So a clear
/// standard sky is as blue away from the sun, and as white around it and along the horizon, as the air would
/// make it. The rule is our own: measured relations between luminance and colour temperature scatter as widely
/// as it is off.
#[derive(Clone)]
pub struct Luminous {
    distribution: Distribution,
    /// Not below the horizon.
    toward_sun: Vec3,
    brightest: Vec3,
    /// What the distribution's shape is multiplied by \[cd/m²\].
    scale: f64,
    clear: Option<Arc<dyn Sky>>,
    share: f32,
    cloud: Spectrum,
}

impl Luminous {
    /// The distribution with luminance 1 cd/m² at the zenith (measured ones as measured), of daylight's colour.
    pub fn new(distribution: Distribution, toward_sun: Vec3) -> Self {
        let toward_sun = lifted(toward_sun);
        let brightest = match &distribution {
            Distribution::Measured(table) => table.brightest(),
            round if round.is_round() => Vec3::Y,
            _ => toward_sun,
        };
        Self {
            scale: distribution.per_zenith(toward_sun),
            distribution,
            toward_sun,
            brightest,
            clear: None,
            share: 0.0,
            cloud: Spectrum::light_of_temperature(OVERCAST_TEMPERATURE),
        }
    }

    /// With the colour of `clear` for `share` of its light, 0 to 1.
    #[must_use]
    pub fn coloured(self, clear: Arc<dyn Sky>, share: f32) -> Self {
        Self { clear: Some(clear), share: share.clamp(0.0, 1.0), ..self }
    }

    /// Luminance from the unit vector `direction` \[cd/m²\].
    pub fn luminance(&self, direction: Vec3) -> f32 {
        (self.scale * self.distribution.shape(lifted(direction), self.toward_sun)) as f32
    }
}

impl Sky for Luminous {
    fn radiance(&self, direction: Vec3) -> Spectrum {
        let direction = lifted(direction);
        let clear =
            self.clear.as_ref().map_or(Spectrum::ZERO, |sky| sky.radiance(direction).of_luminance(1.0));
        // A night without any light to take the colour of has that of clouds.
        let share = if clear.is_zero() || !clear.is_finite() { 0.0 } else { self.share };
        let colour = if share > 0.0 {
            clear.mul_add(Spectrum::splat(share), self.cloud * (1.0 - share))
        } else {
            self.cloud
        };
        colour * self.luminance(direction)
    }

    fn brightest(&self) -> Vec3 {
        self.brightest
    }
}

#[cfg(test)]
pub(crate) mod tests;
