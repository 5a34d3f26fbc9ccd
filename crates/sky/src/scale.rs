//! How bright a sky is made, whatever it would be by itself.

use std::sync::Arc;

use glam::Vec3;
use light::Spectrum;

use crate::open_sky::horizontal;
use crate::{Sky, bouguer};

/// How bright a sky is made, whatever it would be by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scale {
    /// As its own model says.
    #[default]
    Own,
    /// By its luminance at the zenith \[cd/m²\].
    Zenith(f32),
    /// By the illuminance that it gives the horizontal \[lx\].
    Horizontal(f32),
    /// By the formula of Nagata for air of this transmittance at the zenith, 0 to 1; see [`bouguer`].
    Nagata(f64),
}

/// A sky multiplied by a number.
#[derive(Clone)]
pub struct Scaled {
    sky: Arc<dyn Sky>,
    factor: f32,
}

impl Scaled {
    /// `sky` made as bright as `scale` says, for a sun at `sun_altitude_deg`. A sky without any light stays so.
    pub fn new(sky: Arc<dyn Sky>, scale: Scale, sun_altitude_deg: f64) -> Self {
        let whole = || horizontal_illuminance(&*sky);
        let per = |wanted: f64, own: f64| if own > 0.0 { (wanted.max(0.0) / own) as f32 } else { 1.0 };
        let factor = match scale {
            Scale::Own => 1.0,
            Scale::Zenith(luminance) => {
                per(f64::from(luminance), f64::from(sky.radiance(Vec3::Y).luminance()))
            }
            Scale::Horizontal(lux) => per(f64::from(lux), whole()),
            Scale::Nagata(transmittance) => {
                per(bouguer::sky_illuminance(transmittance, sun_altitude_deg), whole())
            }
        };
        Self { sky, factor: if factor.is_finite() { factor } else { 1.0 } }
    }
}

impl Sky for Scaled {
    fn radiance(&self, direction: Vec3) -> Spectrum {
        self.sky.radiance(direction) * self.factor
    }

    fn brightest(&self) -> Vec3 {
        self.sky.brightest()
    }
}

/// Illuminance that the open sky gives the horizontal \[lx\]: the midpoint rule on patches of 1.5°.
pub fn horizontal_illuminance(sky: &dyn Sky) -> f64 {
    horizontal(|direction| f64::from(sky.radiance(direction).luminance()))
}
