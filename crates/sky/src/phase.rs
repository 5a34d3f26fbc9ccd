//! Into which directions air scatters: phase functions.

/// (1 + cos² θ) 3/(16π), of molecules \[1/sr\] (thesis 4.2; Rayleigh). Unit integral over the sphere.
pub(crate) fn rayleigh(cos: f32) -> f32 {
    3.0 / (16.0 * std::f32::consts::PI) * (1.0 + cos * cos)
}

/// A phase function made of even scattering and two lobes forwards \[1/sr\]:
///
///   P(θ) = (w₀ + w₁ cos^(2m)(θ/2) + w₂ cos^(2n)(θ/2)) / 4π (w₀ + w₁/(m+1) + w₂/(n+1))
///
/// of unit integral over the sphere, since ∫ cos^(2n)(θ/2) dω = 4π/(n+1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobes {
    weights: [f64; 3],
    powers: [i32; 2],
}

impl Lobes {
    /// Haze and mist as Gibbons measured them, 1 + 9 cos¹⁶(θ/2) (thesis 4.10 and 4.16). Fits badly beyond 95°.
    pub const HAZE: Self = Self { weights: [1.0, 9.0, 0.0], powers: [8, 0] };
    /// Fog, 1 + 50 cos⁶⁴(θ/2) (thesis 4.11).
    pub const FOG: Self = Self { weights: [1.0, 50.0, 0.0], powers: [32, 0] };
    /// The thesis' haze repaired: with B = 0.09 and nothing absorbed, single scattering has the CIE clear sky's
    /// luminances within 11 % of its maximum, above 10° and more than 2.5° from the sun.
    pub const REPAIRED: Self = Self { weights: [0.0446, 0.263, 0.373], powers: [8, 64] };

    /// P at the cosine of the scattering angle \[1/sr\].
    pub fn value(&self, cos: f32) -> f32 {
        // cos²(θ/2)
        let q = (0.5 + 0.5 * cos).clamp(0.0, 1.0);
        let [even, first, second] = self.normalised();
        let lobe = |weight: f32, power: i32| if weight > 0.0 { weight * q.powi(power) } else { 0.0 };
        even + lobe(first, self.powers[0]) + lobe(second, self.powers[1])
    }

    /// ∫ P cos θ dω and ∫ P (3 cos² θ − 1)/2 dω.
    ///
    /// With q = cos²(θ/2), cos θ = 2q − 1, of a lobe qⁿ they are n/(n+2) and n (n−1)/((n+2)(n+3)) of its integral.
    pub(crate) fn legendre(&self) -> [f64; 2] {
        let [even, first, second] = self.weights;
        let [m, n] = self.powers.map(f64::from);
        let lobes = [(first / (m + 1.0), m), (second / (n + 1.0), n)];
        let whole = even + lobes[0].0 + lobes[1].0;
        let sum = |f: fn(f64) -> f64| lobes.iter().map(|&(weight, n)| weight * f(n)).sum::<f64>() / whole;
        [sum(|n| n / (n + 2.0)), sum(|n| n * (n - 1.0) / ((n + 2.0) * (n + 3.0)))]
    }

    fn normalised(&self) -> [f32; 3] {
        let [even, first, second] = self.weights;
        let [m, n] = self.powers.map(|power| f64::from(power) + 1.0);
        let whole = 4.0 * std::f64::consts::PI * (even + first / m + second / n);
        self.weights.map(|weight| (weight / whole) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_is_scattered_goes_somewhere() {
        let steps = 20_000;
        let functions: [(&str, &dyn Fn(f32) -> f32); 4] = [
            ("molecules", &rayleigh),
            ("haze", &|c| Lobes::HAZE.value(c)),
            ("fog", &|c| Lobes::FOG.value(c)),
            ("repaired", &|c| Lobes::REPAIRED.value(c)),
        ];
        for (name, phase) in functions {
            let step = 2.0 / f64::from(steps);
            let cosines = (0..steps).map(|i| -1.0 + (f64::from(i) + 0.5) * step);
            let sum: f64 =
                cosines.map(|c| f64::from(phase(c as f32))).sum::<f64>() * step * std::f64::consts::TAU;
            // Midpoint rule, h²/24 · P′ at the ends (≤ 32 · 0.4 · 2π), and f32 values, of which each rounds.
            assert!((sum - 1.0).abs() < 1e-5, "{name}: {sum}");
        }
    }

    #[test]
    fn the_thesis_haze_has_its_printed_form() {
        // a (1 + 9 cos¹⁶(θ/2)) with a = 1/8π for a unit integral.
        for degrees in [0.0f64, 20.0, 60.0, 90.0, 180.0] {
            let expected =
                (1.0 + 9.0 * (0.5 * degrees.to_radians()).cos().powi(16)) / (8.0 * std::f64::consts::PI);
            let value = f64::from(Lobes::HAZE.value(degrees.to_radians().cos() as f32));
            // q carries an ulp of f32, its eighth power eight.
            assert!((value / expected - 1.0).abs() < 16.0 * f64::from(f32::EPSILON), "{degrees}: {value}");
        }
        // The printed constants of the repaired one are rounded to a third digit.
        assert!((Lobes::REPAIRED.value(1.0) - 0.6806).abs() < 5e-4);
    }
}
