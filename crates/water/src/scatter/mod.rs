//! Light that water scatters towards the eye (thesis 3.5).
//!
//! Along a view ray from P to Q under water, r metres from P, light that faces S(r) with irradiance E(r) adds
//!
//!   L = ∫ β(Θ) E(r) e^(−κ r) dr,   cos Θ = V · u
//!
//! V towards the light, u the view ray's own direction away from the eye. κ is c for light scattered once and nothing else
//! ([`Loss::Beam`]), K = a + b_b where scattering a little forwards counts as none ([`Loss::Diffuse`], quasi-single
//! scattering: the default, nearer the truth). What it misses [`Scattering::often`] makes good for deep
//! water.

mod bed;
mod fade;
mod lamp;
pub mod multiple;
mod sky;
mod steps;
mod sun;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use glam::{DVec2, DVec3};
use light::Spectrum;

pub use bed::Bed;
pub use lamp::{LAMP_TOLERANCE, Light};
pub use sky::ScatteredSky;
pub use steps::{MOST_STEPS, Stepped, Steps};

use crate::{Loss, Surface, Water};

/// A stretch of a view ray under water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewRay {
    /// Its end towards the eye, P \[m\].
    pub from: DVec3,
    /// Unit vector away from the eye.
    pub direction: DVec3,
    /// Its length PQ \[m\]; infinite where there is no bottom.
    pub length: f64,
}

impl ViewRay {
    /// The point `distance` \[m\] along it.
    pub fn at(&self, distance: f64) -> DVec3 {
        self.from + self.direction * distance
    }
}

/// Water that scatters, below its surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Scattering {
    water: Water,
    surface: Surface,
    coefficient: Spectrum,
    /// What is scattered more than once, as if it were even volume scattering \[1/(m sr)\]; 0 for scattering once.
    evenly: Spectrum,
    /// How deep it is; none = deeper than light comes.
    bed: Option<Arc<Bed>>,
}

impl Scattering {
    /// `water` below a surface at height `level` \[m\], with the loss that its light is to have.
    pub fn new(water: Water, level: f64, loss: Loss) -> Self {
        let (surface, coefficient) = (Surface::of(&water, level), water.loss(loss));
        Self { water, surface, coefficient, evenly: Spectrum::ZERO, bed: None }
    }

    /// The same, with the light of sun and sky that is scattered more than once, with [`Loss::Diffuse`], by the factor of
    /// [`multiple`]: in deep water, unless there is a bed ([`Self::over`]).
    pub fn often(mut self) -> Self {
        self.evenly = multiple::evenly(&self.water);
        self
    }

    /// The same over a bed, where there is less room for being scattered more than once ([`multiple::room`]).
    pub fn over(self, bed: Arc<Bed>) -> Self {
        Self { bed: Some(bed), ..self }
    }

    /// The water.
    pub fn water(&self) -> &Water {
        &self.water
    }

    /// Its surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// What is lost of light on its way \[1/m\].
    pub fn coefficient(&self) -> Spectrum {
        self.coefficient
    }

    /// β(Θ) for light of sun or sky from unit vector `toward` seen along `direction`.
    fn scattered(&self, toward: DVec3, direction: DVec3) -> Spectrum {
        self.water.volume_scattering(toward.dot(direction))
    }

    /// What [`multiple`] adds to that along a view ray, if it is wanted.
    ///
    /// Its room is that of the water where the ray runs: from the surface down to the bed below the middle of what is seen of it (its
    /// length, or the 1/κ from which most of its light comes), whatever its direction is and wherever it ends.
    fn evenly(&self, ray: &ViewRay) -> Spectrum {
        let Some(bed) = self.bed.as_ref().filter(|_| !self.evenly.is_zero()) else { return self.evenly };
        let lost = f64::from(self.coefficient.0.iter().sum::<f32>()) / self.coefficient.0.len() as f64;
        let middle = ray.at(0.5 * ray.length.min(1.0 / lost.max(1e-9)));
        let depth = bed.depth(DVec2::new(middle.x, middle.z)).max(self.depth(middle));
        self.evenly * self.water.extinction().map(|c| multiple::room(f64::from(c), depth) as f32)
    }

    fn depth(&self, point: DVec3) -> f64 {
        (self.surface.level - point.y).max(0.0)
    }
}
