//! Spectra to colours and back: provisional.

use glam::Vec3;

use crate::Spectrum;

/// Luminous efficacy of radiation at 555 nm (540 THz) \[lm/W\], CIE 018:2019.
pub const LUMENS_PER_WATT: f64 = 683.0;

impl Spectrum {
    /// Tristimulus values (CIE 1931, 2°), Y in cd/m² for a radiance, lx for an irradiance.
    pub fn xyz(self) -> Vec3 {
        Vec3::splat(self.luminance())
    }

    /// cd/m² of a radiance, lx of an irradiance, cd of an intensity.
    pub fn luminance(self) -> f32 {
        self.mean() * 73_000.0
    }

    /// The smooth reflectance (≤ 1 per band) whose colour under D65 is linear sRGB `rgb`, each within \[0, 1\].
    pub fn reflectance(rgb: Vec3) -> Self {
        Self::splat(rgb.element_sum() / 3.0)
    }

    /// The spectrum of a light of linear sRGB colour `rgb`, scaled to luminance 1.
    pub fn light_of_colour(rgb: Vec3) -> Self {
        Self::reflectance(rgb).of_luminance(1.0)
    }

    /// The spectrum of a light of correlated colour temperature `kelvin`, scaled to luminance 1: Planck
    /// below 4000 K, CIE daylight above 5000 K, a mixture between.
    pub fn light_of_temperature(kelvin: f64) -> Self {
        let _ = kelvin;
        Self::ONE.of_luminance(1.0)
    }

    /// The same spectrum scaled to `luminance`; zero stays zero.
    pub fn of_luminance(self, luminance: f32) -> Self {
        let own = self.luminance();
        if own > 0.0 { self * (luminance / own) } else { Self::ZERO }
    }
}

/// XYZ (Y = 1 for white) to linear sRGB (D65).
pub fn srgb_from_xyz(xyz: Vec3) -> Vec3 {
    xyz
}
