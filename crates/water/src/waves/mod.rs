//! Waves on a water surface: a sum of third-order Stokes waves, given one by one or by a wind.
//!
//! The surface is a height field over x, z. That it is a plain sum (thesis reference 10) leaves out what waves do to each other; a
//! single wave is within 0.5 % of its height of the exact solution up to ka = 0.2, within 2 % up to 0.3.

mod error;
mod shade;
mod sight;
mod stokes;
#[cfg(test)]
mod tests;
mod wind;

use glam::{DVec2, DVec3};

pub use error::WaveError;
pub use shade::WavyShade;
pub use stokes::{BREAKS_AT, Stokes};
pub use wind::Wind;

/// Free fall \[m/s²\].
const G: f64 = 9.806_65;

/// A footprint that is a point.
pub const POINT: Covariance = Covariance { xx: 0.0, xz: 0.0, zz: 0.0 };

/// Variances and covariance of two numbers over x and z: of positions in a footprint \[m²\], or of slopes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Covariance {
    /// Variance along x.
    pub xx: f64,
    /// Covariance.
    pub xz: f64,
    /// Variance along z.
    pub zz: f64,
}

impl Covariance {
    /// vᵀ C v.
    pub fn along(&self, v: DVec2) -> f64 {
        self.xx * v.x * v.x + 2.0 * self.xz * v.x * v.y + self.zz * v.y * v.y
    }

    /// With `variance` along `direction` (of any length ℓ: ℓ² times as much) more.
    #[must_use]
    pub fn and(self, direction: DVec2, variance: f64) -> Self {
        let v = direction;
        Self {
            xx: self.xx + variance * v.x * v.x,
            xz: self.xz + variance * v.x * v.y,
            zz: self.zz + variance * v.y * v.y,
        }
    }

    /// Of a width \[m\] of even weight, the same in every direction.
    pub fn even(width: f64) -> Self {
        let variance = width * width / 12.0;
        Self { xx: variance, xz: 0.0, zz: variance }
    }
}

/// The surface at a point, or on average over a footprint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Facet {
    /// Above the level of rest \[m\].
    pub height: f64,
    /// ∂height/∂x and ∂height/∂z.
    pub slope: DVec2,
    /// How slopes vary within the footprint.
    pub spread: Covariance,
}

impl Facet {
    /// Unit normal, upwards.
    pub fn normal(&self) -> DVec3 {
        DVec3::new(-self.slope.x, 1.0, -self.slope.y).normalize()
    }
}

/// Waves at one moment.
///
/// ```
/// use glam::DVec2;
/// use keikan_water::waves::{Stokes, Waves};
/// let wave = Stokes::new(0.025, 1.0, DVec2::X, 0.0).unwrap();
/// let waves = Waves::new(vec![wave], DVec2::ZERO);
/// let crest = waves.height(DVec2::ZERO);
/// assert!(crest > 0.025 && crest < 0.028 && waves.height(DVec2::new(0.5, 7.0)) > -0.025); // sharp crests, flat troughs
/// assert!((waves.normal(DVec2::ZERO).y - 1.0).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Waves {
    waves: Vec<Stokes>,
    origin: DVec2,
    moment: f64,
}

impl Waves {
    /// These, whose phases count from the point `origin` (x and z, \[m\]), at the moment 0.
    pub fn new(waves: Vec<Stokes>, origin: DVec2) -> Self {
        Self { waves, origin, moment: 0.0 }
    }

    /// The same at another moment \[s\].
    #[must_use]
    pub fn at_moment(self, moment: f64) -> Self {
        Self { moment, ..self }
    }

    /// One by one.
    pub fn each(&self) -> &[Stokes] {
        &self.waves
    }

    /// True where the water is at rest.
    pub fn is_calm(&self) -> bool {
        self.waves.iter().all(|wave| wave.amplitude() == 0.0)
    }

    /// Height above the level of rest at x, z \[m\].
    pub fn height(&self, at: DVec2) -> f64 {
        self.facet(at, POINT).height
    }

    /// Unit normal at x, z, upwards.
    pub fn normal(&self, at: DVec2) -> DVec3 {
        self.facet(at, POINT).normal()
    }

    /// What a footprint about x, z (a normal distribution with this covariance \[m²\]) has on average.
    pub fn facet(&self, at: DVec2, footprint: Covariance) -> Facet {
        let mut sum = Facet::default();
        self.waves.iter().for_each(|wave| wave.add_to(&mut sum, at - self.origin, self.moment, footprint));
        sum
    }

    /// The height of wave number `i` alone, over a footprint.
    fn height_of(&self, i: usize, at: DVec2, footprint: Covariance) -> f64 {
        let mut facet = Facet::default();
        self.waves[i].add_to(&mut facet, at - self.origin, self.moment, footprint);
        facet.height
    }

    /// A bound on |height| \[m\].
    pub fn highest(&self) -> f64 {
        self.waves.iter().map(Stokes::highest).sum()
    }

    /// A bound on the slope in any direction.
    pub fn steepest(&self) -> f64 {
        self.waves.iter().map(Stokes::steepest).sum()
    }

    /// Variance of the height \[m²\]: Σ a²/2, harmonics of Stokes waves with it. Four times its root is the significant height.
    pub fn variance(&self) -> f64 {
        self.waves.iter().map(Stokes::variance).sum()
    }

    /// Wavelength \[m\] of the shortest wave; none in calm water.
    pub fn shortest(&self) -> Option<f64> {
        let lengths = self.waves.iter().filter(|wave| wave.amplitude() > 0.0).map(Stokes::wavelength);
        lengths.reduce(f64::min)
    }
}
