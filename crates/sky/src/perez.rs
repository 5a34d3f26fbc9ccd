//! The all-weather sky of Perez, Seals and Michalsky: a distribution from two irradiances.

use crate::Gradation;
use crate::atmosphere::air_mass;

/// Irradiance of the sun outside the atmosphere, all wavelengths, at its mean distance \[W/m²\] (WMO 1981, as the
/// coefficients were fitted with).
pub const SOLAR_CONSTANT: f64 = 1367.0;

/// Upper bounds of the clearness ε of the first seven categories.
const CLEARNESS: [f64; 7] = [1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2];

/// x₁ to x₄ of a, b, c, d and e for each category of clearness.
///
/// Source: Perez, Seals and Michalsky 1993 (Solar Energy 50(3), 235), table 1.
#[rustfmt::skip]
const COEFFICIENTS: [[[f64; 4]; 5]; 8] = [
    [[1.3525, -0.2576, -0.2690, -1.4366], [-0.7670, 0.0007, 1.2734, -0.1233], [2.8000, 0.6004, 1.2375, 1.0000],
     [1.8734, 0.6297, 0.9738, 0.2809], [0.0356, -0.1246, -0.5718, 0.9938]],
    [[-1.2219, -0.7730, 1.4148, 1.1016], [-0.2054, 0.0367, -3.9128, 0.9156], [6.9750, 0.1774, 6.4477, -0.1239],
     [-1.5798, -0.5081, -1.7812, 0.1080], [0.2624, 0.0672, -0.2190, -0.4285]],
    [[-1.1000, -0.2515, 0.8952, 0.0156], [0.2782, -0.1812, -4.5000, 1.1766], [24.7219, -13.0812, -37.7000, 34.8438],
     [-5.0000, 1.5218, 3.9229, -2.6204], [-0.0156, 0.1597, 0.4199, -0.5562]],
    [[-0.5484, -0.6654, -0.2672, 0.7117], [0.7234, -0.6219, -5.6812, 2.6297], [33.3389, -18.3000, -62.2500, 52.0781],
     [-3.5000, 0.0016, 1.1477, 0.1062], [0.4659, -0.3296, -0.0876, -0.0329]],
    [[-0.6000, -0.3566, -2.5000, 2.3250], [0.2937, 0.0496, -5.6812, 1.8415], [21.0000, -4.7656, -21.5906, 7.2492],
     [-3.5000, -0.1554, 1.4062, 0.3988], [0.0032, 0.0766, -0.0656, -0.1294]],
    [[-1.0156, -0.3670, 1.0078, 1.4051], [0.2875, -0.5328, -3.8500, 3.3750], [14.0000, -0.9999, -7.1406, 7.5469],
     [-3.4000, -0.1078, -1.0750, 1.5702], [-0.0672, 0.4016, 0.3017, -0.4844]],
    [[-1.0000, 0.0211, 0.5025, -0.5119], [-0.3000, 0.1922, 0.7023, -1.6317], [19.0000, -5.0000, 1.2438, -1.9094],
     [-4.0000, 0.0250, 0.3844, 0.2656], [1.0468, -0.3788, -2.4517, 1.4656]],
    [[-1.0500, 0.0289, 0.4260, 0.3590], [-0.3250, 0.1156, 0.7781, 0.0025], [31.0625, -14.5000, -46.1148, 55.3750],
     [-7.2312, 0.4050, 13.3500, 0.6234], [1.5000, -0.6426, 1.8564, 0.5636]],
];

/// Luminous efficacy of the diffuse and of the direct irradiance: a, b, c, d of each.
///
/// Source: Perez, Ineichen, Seals, Michalsky and Stewart 1990 (Solar Energy 44(5), 271), table 4.
#[rustfmt::skip]
const EFFICACIES: [[[f64; 4]; 2]; 8] = [
    [[ 97.24, -0.46, 12.00,  -8.91], [ 57.20, -4.55, -2.98, 117.12]],
    [[107.22,  1.15,  0.59,  -3.95], [ 98.99, -3.46, -1.21,  12.38]],
    [[104.97,  2.96, -5.53,  -8.77], [109.83, -4.90, -1.71,  -8.81]],
    [[102.39,  5.59, -13.95, -13.90], [110.34, -5.84, -1.99, -4.56]],
    [[100.71,  5.94, -22.75, -23.74], [106.36, -3.97, -1.75, -6.16]],
    [[106.42,  3.83, -36.15, -28.83], [107.19, -1.25, -1.51, -26.73]],
    [[141.88,  1.90, -53.24, -14.03], [105.75,  0.77, -1.26, -34.44]],
    [[152.23,  0.35, -45.27,  -7.98], [101.18,  1.58, -1.10,  -8.29]],
];

/// A state of the sky by the two numbers that Perez' model has, and where the sun stands.
///
///   ε = ((E_dh + E_bn)/E_dh + 1.041 Z³) / (1 + 1.041 Z³)          clearness
///   Δ = m E_dh / E_0                                               brightness
///
/// Z is the sun's angle from the zenith \[rad\], m the relative air mass of Kasten and Young, E_0 the irradiance
/// outside the atmosphere. ε is kept within \[1, 12\] and Δ within \[0.01, 0.6\], for which the model was
/// fitted (as Radiance' `gendaylit` does, which also keeps Δ above 0.2 where 1.065 < ε < 2.8).
///
/// The categories of ε have steps between them: the model is not continuous in the irradiances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Perez {
    clearness: f64,
    brightness: f64,
    /// Angle of the sun from the zenith \[rad\], within \[0, π/2\].
    zenith_angle: f64,
    /// \[W/m²\]
    irradiances: [f64; 2],
}

impl Perez {
    /// `direct_normal` and `diffuse_horizontal` are irradiances \[W/m²\] over all wavelengths; `sun_altitude_deg`
    /// within \[−90, 90\], below the horizon as on it; `day_of_year` 1 to 366, for the sun's distance, none = the
    /// mean. Negative irradiances and NaN count as 0.
    pub fn new(
        direct_normal: f64,
        diffuse_horizontal: f64,
        sun_altitude_deg: f64,
        day_of_year: Option<u16>,
    ) -> Self {
        let [direct, diffuse] = [direct_normal, diffuse_horizontal].map(|e| if e > 0.0 { e } else { 0.0 });
        let altitude = sun_altitude_deg.clamp(0.0, 90.0);
        let zenith_angle = (90.0 - altitude).to_radians();
        // 1/r² to 0.1 %.
        let turn = |day: u16| (std::f64::consts::TAU * (f64::from(day) - 2.0) / 365.0).cos();
        let outside = SOLAR_CONSTANT * day_of_year.map_or(1.0, |day| 1.0 + 0.034 * turn(day));
        let cube = 1.041 * zenith_angle.powi(3);
        let clearness =
            if diffuse > 0.0 { ((diffuse + direct) / diffuse + cube) / (1.0 + cube) } else { 12.0 };
        Self {
            clearness: clearness.clamp(1.0, 12.0),
            brightness: (air_mass(altitude) * diffuse / outside).clamp(0.01, 0.6),
            zenith_angle,
            irradiances: [diffuse, direct],
        }
    }

    /// ε, within \[1, 12\].
    pub fn clearness(&self) -> f64 {
        self.clearness
    }

    /// Δ, within \[0.01, 0.6\].
    pub fn brightness(&self) -> f64 {
        self.brightness
    }

    /// Which of the eight categories of clearness, from 0.
    fn category(&self) -> usize {
        CLEARNESS.partition_point(|&bound| bound <= self.clearness)
    }

    /// How much of it is clear sky: 0 in the first category of clearness, 1 in the last, linear in ln ε between.
    ///
    /// Our own measure, for what the model does not have: colour.
    pub fn clear_share(&self) -> f64 {
        let [low, high] = [CLEARNESS[0], CLEARNESS[6]].map(f64::ln);
        ((self.clearness.ln() - low) / (high - low)).clamp(0.0, 1.0)
    }

    /// The five parameters:
    ///
    ///   x = x₁ + x₂ Z + Δ (x₃ + x₄ Z)
    ///
    /// but in the first category c = exp((Δ (c₁ + c₂ Z))^c₃) − c₄ and d = −exp(Δ (d₁ + d₂ Z)) + d₃ + Δ d₄. The
    /// gradation's b is kept below 0, where it has a value at the horizon.
    pub(crate) fn gradation(&self) -> Gradation {
        let (category, z) = (self.category(), self.zenith_angle);
        let darkest = if (1..=4).contains(&category) { 0.2 } else { 0.01 };
        let delta = self.brightness.max(darkest);
        let rows = &COEFFICIENTS[category];
        let linear = rows.map(|[x1, x2, x3, x4]| x1 + x2 * z + delta * (x3 + x4 * z));
        let [a, b, mut c, mut d, e] = linear;
        if category == 0 {
            let ([c1, c2, c3, c4], [d1, d2, d3, d4]) = (rows[2], rows[3]);
            c = (delta * (c1 + c2 * z)).powf(c3).exp() - c4;
            d = -(delta * (d1 + d2 * z)).exp() + d3 + delta * d4;
        }
        Gradation { a, b: b.min(-1e-3), f0: 1.0, c, d, e }
    }

    /// Illuminance of the sky on the horizontal, and of the sun on a plane that faces it \[lx\].
    ///
    ///   E_v,dh = E_dh (a + b W + c cos Z + d ln Δ)
    ///   E_v,bn = E_bn (a + b W + c e^(5.73 Z − 5) + d Δ), at least 0
    ///
    /// `precipitable_water_cm` is W, within 0.1 to 6; exp(0.07 T_d − 0.075) by the dew point T_d \[°C\], and 2 cm
    /// where nothing is known.
    pub fn illuminances(&self, precipitable_water_cm: f64) -> [f64; 2] {
        let [[a, b, c, d], [a2, b2, c2, d2]] = EFFICACIES[self.category()];
        let (z, w) = (self.zenith_angle, precipitable_water_cm);
        let diffuse = a + b * w + c * z.cos() + d * self.brightness.ln();
        let direct = a2 + b2 * w + c2 * (5.73 * z - 5.0).exp() + d2 * self.brightness;
        [self.irradiances[0] * diffuse.max(0.0), self.irradiances[1] * direct.max(0.0)]
    }
}

#[cfg(test)]
mod tests;
