//! How fast daylight fades with depth.

use light::Spectrum;

use super::Water;

/// Backscattered share of the particles that Kirk followed photons through (Petzold's San Diego harbour), about that of all natural ones.
const PARTICLES: f64 = 0.0183;
/// G of molecules (B = ½), for which Kirk has none: Monte Carlo of Mobley's problem 1 has 1.45 at ω0 = 0.2 and 1.73 at 0.9.
const MOLECULES: f64 = 1.5;

impl Water {
    /// Attenuation of downward irradiance per metre of the refracted beam's way, in daylight that entered at `cos` = μ₀ from the vertical
    /// under water \[1/m\]:
    ///
    ///   K_d μ₀ = √(a² + a Σ G b),   G = 0.425 μ₀ − 0.19 for particles      (Kirk 1984, Limnology and Oceanography 29:350)
    ///
    /// Unlike K = a + b_b ([`Water::diffuse`]) it knows of the detours of light that is scattered often. G of other phase functions is
    /// taken linear in their backscattered share, to 1.5 of molecules. Give it to [`crate::SunBelow`] with its own cosine, to
    /// [`crate::SkyBelow`] with about 0.86. Against Monte Carlo (Mobley et al. 1993, sun at 60°) irradiance down to five optical depths is 0.77 to 1.0 of
    /// the truth, where K = a + b_b gives 0.3 to 1.2; what the surface sends back down is most of the rest.
    ///
    /// ```
    /// use keikan_water::Water;
    /// let coast = Water::named("jerlov-9C").unwrap();
    /// let measured = 0.63; // 1/m at 550 nm, Jerlov 1976
    /// let kirk = coast.downward(0.86) * (1.0 / 0.86);
    /// assert!((f64::from(0.6 * kirk[3] + 0.4 * kirk[4]) / measured - 1.0).abs() < 0.1);
    /// ```
    pub fn downward(&self, cos: f64) -> Spectrum {
        let particles = 0.425 * cos.clamp(0.5, 1.0) - 0.19;
        let detour = |share: f64| {
            if share < PARTICLES {
                particles * share / PARTICLES
            } else {
                particles + (MOLECULES - particles) * (share - PARTICLES) / (0.5 - PARTICLES)
            }
        };
        let weighed = |s: &super::Scatterer| s.scattering * detour(s.phase.backscattered()) as f32;
        let longer: Spectrum = self.scatterers.iter().map(weighed).sum();
        let (a, c) = (self.absorption, self.extinction());
        Spectrum(std::array::from_fn(|b| (a[b] * (a[b] + longer[b])).sqrt().min(c[b])))
    }
}
