//! Spectra to colours and back: XYZ, linear sRGB, chromaticity, and spectra for colours and temperatures.
//!
//! XYZ are those of the CIE 1931 2° observer with Y in cd/m² (lx, cd); linear sRGB has the primaries and white of
//! IEC 61966-2-1 and the scale of its XYZ: white of luminance L is (L, L, L).

use glam::{Mat3, Vec2, Vec3};

use crate::Spectrum;
use crate::bands::{BANDS, XYZ_WEIGHTS, read};
use crate::data::observer::{X_BAR, Y_BAR, Z_BAR};
use crate::data::{SAMPLES, STEP_NM, daylight, interpolate, wavelength};

/// Luminous efficacy of radiation at 555 nm (540 THz) \[lm/W\], CIE 018:2019.
pub const LUMENS_PER_WATT: f64 = 683.0;

/// CIE illuminant D65 of luminance 1 cd/m² \[W m⁻² sr⁻¹ nm⁻¹\], by `docs/bands/fit.py`; the white of sRGB.
pub const D65: Spectrum = Spectrum([
    1.397_244_6e-5,
    1.609_668_3e-5,
    1.508_691e-5,
    1.459_250_9e-5,
    1.345_022e-5,
    1.239_466e-5,
    1.161_573_9e-5,
    1.093_181_9e-5,
]);

/// The range of colour temperatures that `light_of_temperature` distinguishes \[K\].
pub const TEMPERATURES: std::ops::RangeInclusive<f64> = 1000.0..=25_000.0;

/// Reflectances of the sRGB primaries, by `docs/bands/fit.py`: of least curvature among those that lie within \[0, 1\],
/// sum to 1 in every band and have exactly the primaries' colours under D65 (the idea of Mallett & Yuksel 2019,
/// "Spectral primary decomposition for rendering with sRGB reflectance", in our bands).
///
/// All are multiples of 2⁻²⁰, so the three sum to exactly 1 in f32, and since rounding is monotonic no
/// colour within \[0, 1\]³ reflects more.
const PRIMARIES: [Spectrum; 3] = [
    Spectrum([0.0, 0.041_919_71, 0.0, 0.0, 0.047_022_82, 0.817_005_16, 1.0, 1.0]),
    Spectrum([0.0, 0.073_226_93, 0.697_333_34, 1.0, 0.912_980_1, 0.181_840_9, 0.0, 0.0]),
    Spectrum([1.0, 0.884_853_36, 0.302_666_66, 0.0, 0.039_997_1, 0.001_153_945_9, 0.0, 0.0]),
];

/// x̄, ȳ, z̄.
const OBSERVER: [&[f64; SAMPLES]; 3] = [&X_BAR, &Y_BAR, &Z_BAR];

/// Linear sRGB of X, Y and Z: inverse of [`XYZ_FROM_SRGB`].
const SRGB_FROM_XYZ: Mat3 = Mat3::from_cols(
    Vec3::new(3.240_97, -0.969_243_64, 0.055_630_08),
    Vec3::new(-1.537_383_2, 1.875_967_5, -0.203_976_96),
    Vec3::new(-0.498_610_76, 0.041_555_06, 1.056_971_5),
);

/// XYZ of the sRGB primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) that sum to white (0.3127, 0.3290), Y = 1.
const XYZ_FROM_SRGB: Mat3 = Mat3::from_cols(
    Vec3::new(0.412_390_8, 0.212_639, 0.019_330_818),
    Vec3::new(0.357_584_34, 0.715_168_7, 0.119_194_78),
    Vec3::new(0.180_480_8, 0.072_192_32, 0.950_532_14),
);

/// Luminance of linear sRGB: Y of red, green and blue whose white has Y = 1.
///
/// The middle row of linear sRGB → XYZ as multiples of 2⁻²⁴, so that the three sum to exactly 1.
///
/// ```
/// use keikan_light::colour::{LUMINANCE, xyz_from_srgb};
/// assert_eq!(LUMINANCE.element_sum(), 1.0);
/// for rgb in glam::Vec3::AXES {
///     assert!((LUMINANCE.dot(rgb) - xyz_from_srgb(rgb).y).abs() <= f32::EPSILON); // rounded to 2⁻²⁴ twice
/// }
/// ```
pub const LUMINANCE: Vec3 = Vec3::new(0.212_639_03, 0.715_168_65, 0.072_192_31);

impl Spectrum {
    /// Tristimulus values (CIE 1931, 2°), Y in cd/m² for a radiance, lx for an irradiance.
    ///
    /// X, Y, Z = 683 lm/W · Σ_b w_b L_b, none negative for a light that is not.
    ///
    /// ```
    /// use keikan_light::Spectrum;
    /// // ∫ȳ = 106.856635 nm in steps of 5 nm; eight products and sums of f32 err by less than 20 units of round-off.
    /// let expected = 683.0 * 106.856_635;
    /// assert!((Spectrum::ONE.xyz().y / expected - 1.0).abs() < 20.0 * f32::EPSILON);
    /// ```
    pub fn xyz(self) -> Vec3 {
        Vec3::from(XYZ_WEIGHTS.map(|weights| weigh(&weights, self)))
    }

    /// cd/m² of a radiance, lx of an irradiance, cd of an intensity: the Y of [`Spectrum::xyz`].
    pub fn luminance(self) -> f32 {
        weigh(&XYZ_WEIGHTS[1], self)
    }

    /// The smooth reflectance (≤ 1 per band) whose colour under D65 is linear sRGB `rgb`, each within \[0, 1\]
    /// (clamped to it; NaN counts as 0).
    ///
    /// Linear in `rgb`: filtering a texture and then asking is the same as asking and then filtering. White is 1 in
    /// every band.
    pub fn reflectance(rgb: Vec3) -> Self {
        mix_primaries(rgb.to_array().map(share))
    }

    /// The spectrum of a light of linear sRGB colour `rgb` (negative parts count as 0), scaled to luminance 1;
    /// black stays zero.
    ///
    /// D65 filtered by the smooth reflectance of that colour: never negative, its chromaticity exact.
    pub fn light_of_colour(rgb: Vec3) -> Self {
        let rgb = rgb.to_array().map(|part| part.max(0.0));
        let largest = rgb[0].max(rgb[1]).max(rgb[2]);
        if largest.is_normal() {
            (mix_primaries(rgb.map(|part| part / largest)) * D65).of_luminance(1.0)
        } else {
            Self::ZERO
        }
    }

    /// The spectrum of a light of correlated colour temperature `kelvin`, scaled to luminance 1: Planck
    /// below 4000 K, CIE daylight above 5000 K, a mixture between; clamped to [`TEMPERATURES`].
    ///
    /// CIE D65 is 6504 K, illuminant A 2856 K. NaN counts as 6504 K.
    pub fn light_of_temperature(kelvin: f64) -> Self {
        let kelvin =
            if kelvin.is_nan() { 6504.0 } else { kelvin.clamp(*TEMPERATURES.start(), *TEMPERATURES.end()) };
        let t = ((kelvin - 4000.0) / 1000.0).clamp(0.0, 1.0);
        let part = (t * t * (3.0 - 2.0 * t)) as f32;
        if part == 0.0 {
            return planck(kelvin);
        }
        // The CIE's daylight locus begins at 4000 K.
        let day = daylight_of(kelvin);
        if part == 1.0 { day } else { (planck(kelvin) * (1.0 - part) + day * part).of_luminance(1.0) }
    }

    /// A light measured as a table of (wavelength \[nm\], power), read as [`Spectrum::from_table`] reads it, but with the
    /// table's own luminance and colour, both summed in steps of 5 nm.
    ///
    /// The bands are multiplied by c₁ S_r + c₂ S_g + c₃ S_b, the mixture of smooth primaries that restores XYZ: near 1 for
    /// smooth lights, a real correction for lamps of spectral lines. Where no such mixture exists (a laser), only
    /// luminance is restored.
    pub fn light_of_table(table: &[(f64, f64)]) -> Self {
        let bands = Self::from_table(table);
        let target = exact_xyz(table);
        let mixed = Mat3::from_cols(
            (bands * PRIMARIES[0]).xyz(),
            (bands * PRIMARIES[1]).xyz(),
            (bands * PRIMARIES[2]).xyz(),
        );
        // Scaled, so that the determinant of dim lamps does not underflow.
        let scale = target.max_element();
        if !(scale > 0.0 && scale.is_finite()) {
            return Self::ZERO;
        }
        let shares = (mixed * scale.recip()).inverse() * (target / scale);
        let corrected = bands * mix_primaries(shares.to_array());
        if corrected.is_finite() && corrected.0.iter().all(|&band| band >= 0.0) {
            corrected
        } else {
            bands.of_luminance(target.y)
        }
    }

    /// The same spectrum scaled to `luminance`; zero stays zero.
    pub fn of_luminance(self, luminance: f32) -> Self {
        let own = self.luminance();
        if own > 0.0 { self * (luminance / own) } else { Self::ZERO }
    }
}

/// 683 lm/W · Σ_b w_b s_b.
fn weigh(weights: &[f32; BANDS], spectrum: Spectrum) -> f32 {
    let sum: f32 = weights.iter().zip(spectrum.0).map(|(weight, band)| weight * band).sum();
    LUMENS_PER_WATT as f32 * sum
}

/// 683 lm/W · 5 nm · Σ s x̄, ȳ, z̄.
fn exact_xyz(table: &[(f64, f64)]) -> Vec3 {
    let sum = |bar: &[f64; SAMPLES]| -> f64 {
        bar.iter().enumerate().map(|(i, bar)| bar * read(table, wavelength(i))).sum()
    };
    Vec3::from(OBSERVER.map(|bar| (LUMENS_PER_WATT * STEP_NM * sum(bar)) as f32))
}

/// `value` within \[0, 1\]; NaN becomes 0.
fn share(value: f32) -> f32 {
    if value > 0.0 { value.min(1.0) } else { 0.0 }
}

/// r S_r + g S_g + b S_b.
fn mix_primaries(rgb: [f32; 3]) -> Spectrum {
    PRIMARIES[0] * rgb[0] + PRIMARIES[1] * rgb[1] + PRIMARIES[2] * rgb[2]
}

/// A black body at luminance 1: M ∝ λ⁻⁵ / (exp(c₂ / λT) − 1), c₂ = 1.438 776 877 cm K (CODATA 2018).
fn planck(kelvin: f64) -> Spectrum {
    let exitance = |nm: f64| (560.0 / nm).powi(5) / (1.438_776_877e7 / (nm * kelvin)).exp_m1();
    // Relative to its own value at 560 nm: 1000 K radiates too little for f32.
    let scale = exitance(560.0);
    Spectrum::from_fn(|nm| exitance(nm) / scale).of_luminance(1.0)
}

/// A CIE D-series daylight at luminance 1: S₀ + M₁ S₁ + M₂ S₂ (CIE 015:2018, 4.1.2).
fn daylight_of(kelvin: f64) -> Spectrum {
    let Vec2 { x, y } = daylight_chromaticity(kelvin);
    let (x, y) = (f64::from(x), f64::from(y));
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    let m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
    let power = |nm: f64| {
        interpolate(&daylight::S0, nm)
            + m1 * interpolate(&daylight::S1, nm)
            + m2 * interpolate(&daylight::S2, nm)
    };
    Spectrum::from_fn(power).of_luminance(1.0)
}

/// Chromaticity of CIE daylight of correlated colour temperature `kelvin`, 4000 to 25000 K.
fn daylight_chromaticity(kelvin: f64) -> Vec2 {
    let t = 1e3 / kelvin;
    let x = if kelvin <= 7000.0 {
        ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244_063
    } else {
        ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237_040
    };
    Vec2::new(x as f32, (-3.0 * x * x + 2.870 * x - 0.275) as f32)
}

/// XYZ to linear sRGB of the same scale (white of Y = 1 is (1, 1, 1)); parts are negative or beyond white for colours
/// outside the gamut.
pub fn srgb_from_xyz(xyz: Vec3) -> Vec3 {
    SRGB_FROM_XYZ * xyz
}

/// Linear sRGB to XYZ of the same scale.
pub fn xyz_from_srgb(rgb: Vec3) -> Vec3 {
    XYZ_FROM_SRGB * rgb
}

/// CIE 1931 chromaticity (x, y) of tristimulus values; that of equal energy (1/3, 1/3) for black.
pub fn chromaticity(xyz: Vec3) -> Vec2 {
    let sum = xyz.element_sum();
    if sum > 0.0 { Vec2::new(xyz.x, xyz.y) / sum } else { Vec2::splat(1.0 / 3.0) }
}

/// The transfer function of sRGB (IEC 61966-2-1): linear to encoded, each \[0, 1\]; clamps, NaN becomes 0.
pub fn encode_srgb(linear: f32) -> f32 {
    let linear = share(linear);
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Inverse of [`encode_srgb`]: encoded to linear, each \[0, 1\]; clamps, NaN becomes 0.
///
/// ```
/// use keikan_light::colour::{decode_srgb, encode_srgb};
/// assert_eq!((decode_srgb(0.0), decode_srgb(1.0)), (0.0, 1.0));
/// // Middle grey of photographers, 18 %, is byte 118 of 255.
/// assert_eq!((encode_srgb(0.18) * 255.0).round(), 118.0);
/// ```
pub fn decode_srgb(encoded: f32) -> f32 {
    let encoded = share(encoded);
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}
