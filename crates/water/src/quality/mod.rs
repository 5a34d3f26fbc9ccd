//! What a water does to light: absorption, scattering, index.

mod chlorophyll;
mod downward;
mod error;
mod index;
mod measured;
mod named;
mod secchi;
pub(crate) mod tables;
#[cfg(test)]
mod tests;

use light::Spectrum;
use light::bands::WAVELENGTHS_NM;

pub use chlorophyll::CHLOROPHYLL_RANGE;
pub use error::QualityError;
pub use index::{FRESH, SEA, refractive_index};
pub use measured::Measured;
pub use named::names;
pub use secchi::SECCHI_CONSTANT;

use crate::Phase;

/// One kind of thing that scatters light in the water.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatterer {
    /// Scattering coefficient b \[1/m\], ≥ 0 per band.
    pub scattering: Spectrum,
    /// Where the scattered light goes.
    pub phase: Phase,
}

/// Which light is lost along its way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Loss {
    /// All that is absorbed or scattered, c = a + b: of light that forms an image, along view rays.
    Beam,
    /// What is absorbed or scattered backwards, K = a + b_b (quasi-single scattering, Gordon 1973): of light that
    /// lights things, since what is scattered a little forwards still arrives somewhere near.
    #[default]
    Diffuse,
}

/// A homogeneous water: what it does to light, per band.
///
/// Absorption a ≥ 0 and scattering b ≥ 0 \[1/m\] are kept, extinction is their sum; so b ≤ c always.
///
/// ```
/// use keikan_water::Water;
/// let pool = Water::named("pool").unwrap();
/// let [red, blue] = [7, 0].map(|band| pool.diffuse()[band]);
/// assert!(red > 10.0 * blue); // 1/m: blue-green is left
/// assert!((pool.critical_angle().to_degrees() - 48.5).abs() < 0.1);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Water {
    absorption: Spectrum,
    scatterers: Vec<Scatterer>,
    index: f64,
}

/// Mean cosine of daylight under water: sun at 45°, or a sky.
const DAYLIGHT: f64 = 0.86;

/// Indices of refraction that a water may have, relative to air.
const INDEX_RANGE: [f64; 2] = [1.0, 2.0];

impl Water {
    /// A water of absorption \[1/m\], things that scatter, and index of refraction relative to air (1 to 2).
    pub fn new(absorption: Spectrum, scatterers: Vec<Scatterer>, index: f64) -> Result<Self, QualityError> {
        sound("absorption", absorption)?;
        for scatterer in &scatterers {
            sound("scattering", scatterer.scattering)?;
        }
        within("the index of refraction", "", index, INDEX_RANGE)?;
        Ok(Self { absorption, scatterers, index })
    }

    /// Absorption coefficient a \[1/m\].
    pub fn absorption(&self) -> Spectrum {
        self.absorption
    }

    /// Scattering coefficient b \[1/m\].
    pub fn scattering(&self) -> Spectrum {
        self.scatterers.iter().map(|s| s.scattering).sum()
    }

    /// Backscattering coefficient b_b \[1/m\]: what is scattered by more than 90°.
    pub fn backscattering(&self) -> Spectrum {
        self.scatterers.iter().map(|s| s.scattering * s.phase.backscattered() as f32).sum()
    }

    /// Extinction (beam attenuation) c = a + b \[1/m\].
    pub fn extinction(&self) -> Spectrum {
        self.absorption + self.scattering()
    }

    /// Attenuation of diffuse light, K = a + b_b \[1/m\].
    ///
    /// That of a beam straight down; what arrives from all the sky goes 1.2 times as far for each metre of depth.
    pub fn diffuse(&self) -> Spectrum {
        self.absorption + self.backscattering()
    }

    /// The coefficient of this kind of loss \[1/m\].
    pub fn loss(&self, loss: Loss) -> Spectrum {
        match loss {
            Loss::Beam => self.extinction(),
            Loss::Diffuse => self.diffuse(),
        }
    }

    /// Length over which 1/e is left \[m\]; infinite where nothing is lost.
    pub fn reach(&self, loss: Loss) -> Spectrum {
        self.loss(loss).map(|coefficient| 1.0 / coefficient)
    }

    /// Single-scattering albedo ω0 = b/c, within \[0, 1\]; 0 where nothing is lost.
    pub fn albedo(&self) -> Spectrum {
        share(self.scattering(), self.extinction())
    }

    /// b_b/(a + b_b), within \[0, 1\]: how much of the light that turns back or ends turns back.
    pub fn turned_back(&self) -> Spectrum {
        share(self.backscattering(), self.diffuse())
    }

    /// Irradiance reflectance just under the surface of water without a bottom, R∞ ≈ 0.33 b_b/(a + b_b).
    ///
    /// Gordon, Brown and Jacobs 1975, Morel and Prieur 1977, for b_b ≪ a; the factor varies from 0.3 to 0.5 with the sun.
    /// What R∞ makes of daylight is the colour of the water itself.
    pub fn deep_reflectance(&self) -> Spectrum {
        self.turned_back() * 0.33
    }

    /// The same over a diffuse bottom of reflectance `bottom`, `depth` ≥ 0 \[m\] below: R∞ + (ρ − R∞) e^(−2 K_d z) (Maritorena, Morel and
    /// Gentili 1994), K_d that of daylight ([`Water::downward`] at 0.86); of light that crosses it once down, once up.
    pub fn reflectance_over(&self, bottom: Spectrum, depth: f64) -> Spectrum {
        let deep = self.deep_reflectance();
        let there_and_back = (self.daylight() * 2.0).attenuate(depth.max(0.0) as f32);
        deep + (bottom - deep) * there_and_back
    }

    /// K_d \[1/m\]: attenuation of daylight by depth, with a mean cosine of 0.86.
    pub fn daylight(&self) -> Spectrum {
        self.downward(DAYLIGHT) * (1.0 / DAYLIGHT) as f32
    }

    /// Volume scattering function β = Σ b p(θ) at the cosine of the scattering angle \[1/(m sr)\].
    pub fn volume_scattering(&self, cos: f64) -> Spectrum {
        self.scatterers.iter().map(|s| s.scattering * s.phase.value(cos) as f32).sum()
    }

    /// The things that scatter.
    pub fn scatterers(&self) -> &[Scatterer] {
        &self.scatterers
    }

    /// Index of refraction relative to air, one for all bands.
    pub fn index(&self) -> f64 {
        self.index
    }

    /// Angle from the vertical beyond which the surface mirrors all light from below \[rad\], asin(1/n).
    pub fn critical_angle(&self) -> f64 {
        (1.0 / self.index).asin()
    }

    /// The same water with `factor` (≥ 0) times the scattering and as much absorption (thesis figure 3.15 d: 200 times).
    pub fn with_scattering_times(mut self, factor: f64) -> Result<Self, QualityError> {
        within("the factor of the scattering", "", factor, [0.0, 1e6])?;
        for scatterer in &mut self.scatterers {
            scatterer.scattering *= factor as f32;
        }
        Self::new(self.absorption, self.scatterers, self.index)
    }
}

fn share(part: Spectrum, whole: Spectrum) -> Spectrum {
    Spectrum(std::array::from_fn(|b| if whole[b] > 0.0 { (part[b] / whole[b]).min(1.0) } else { 0.0 }))
}

fn sound(what: &'static str, coefficient: Spectrum) -> Result<(), QualityError> {
    let bad = (0..WAVELENGTHS_NM.len()).find(|&b| !(coefficient[b] >= 0.0 && coefficient[b].is_finite()));
    bad.map_or(Ok(()), |b| Err(QualityError::Coefficient(what, WAVELENGTHS_NM[b], f64::from(coefficient[b]))))
}

fn within(
    what: &'static str,
    unit: &'static str,
    value: f64,
    [least, largest]: [f64; 2],
) -> Result<(), QualityError> {
    let inside = value >= least && value <= largest;
    if inside { Ok(()) } else { Err(QualityError::Range(what, unit, value, least, largest)) }
}
