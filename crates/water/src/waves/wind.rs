//! The waves that a wind raises.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, TAU};

use glam::DVec2;
use light::sampling::{scramble, shift};

use super::{G, Stokes, WaveError};

/// Waves shorter than this \[m\] are held by surface tension more than by weight: left out.
const SHORTEST: f64 = 0.017;

/// Waves of frequencies ω_p times this. Below lies 1e-9 of the variance, above it 0.13 % in deep water.
const RANGE: [f64; 2] = [0.5, 5.0];

/// Points of the quadrature over each wave's share of the spectrum.
const POINTS: usize = 16;

/// A steady wind over open water: the spectrum of JONSWAP (Hasselmann et al. 1973), with the factor of TMA for shallow water.
///
///   S(ω) = α g² ω⁻⁵ e^(−5/4 (ω_p/ω)⁴) 3.3^r Φ,   r = e^(−(ω − ω_p)²/(2 σ² ω_p²)),   σ = 0.07 for ω ≤ ω_p, else 0.09
///   α = 0.076 (U²/(F g))^0.22,   ω_p = 22 (g²/(U F))^(1/3)
///
/// with Kitaigorodskii's Φ of ω_h = ω √(h/g): ½ ω_h² up to 1, 1 − ½ (2 − ω_h)² up to 2, then 1. About the wind's direction energy
/// spreads as (2/π) cos² θ. A fetch beyond 17,036 U²/g counts as that: from there waves grow no more (ω_p = 0.855 g/U, Pierson and Moskowitz).
///
/// *Where it is known to be wrong.* It was measured over kilometres; over the metres of a pool it is a guess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    /// U, at 10 m above the water \[m/s\], > 0.
    pub speed: f64,
    /// F, how far it has blown over water \[m\], > 0.
    pub fetch: f64,
    /// Where it blows to: x and z.
    pub toward: DVec2,
    /// h, of the water \[m\], > 0; none = deep.
    pub depth: Option<f64>,
    /// How many waves stand for the spectrum.
    pub waves: usize,
}

impl Wind {
    /// ω_p, where the spectrum has its peak \[rad/s\].
    pub fn peak(&self) -> f64 {
        22.0 * (G * G / (self.speed * self.grown())).cbrt()
    }

    /// The fetch that counts.
    fn grown(&self) -> f64 {
        self.fetch.min((22.0f64 / 0.855).powi(3) * self.speed * self.speed / G)
    }

    /// S(ω): variance of the height per angular frequency \[m² s/rad\].
    pub fn density(&self, omega: f64) -> f64 {
        let peak = self.peak();
        let alpha = 0.076 * (self.speed * self.speed / (self.grown() * G)).powf(0.22);
        let sigma = if omega <= peak { 0.07 } else { 0.09 };
        let r = (-0.5 * ((omega - peak) / (sigma * peak)).powi(2)).exp();
        let deep = alpha * G * G * omega.powi(-5) * (-1.25 * (peak / omega).powi(4)).exp() * 3.3f64.powf(r);
        deep * self.depth.map_or(1.0, |depth| match omega * (depth / G).sqrt() {
            low if low <= 1.0 => 0.5 * low * low,
            low if low <= 2.0 => 1.0 - 0.5 * (2.0 - low).powi(2),
            _ => 1.0,
        })
    }

    /// The frequencies between which waves are made \[rad/s\].
    pub fn range(&self) -> [f64; 2] {
        let peak = self.peak();
        [RANGE[0] * peak, (RANGE[1] * peak).min((G * TAU / SHORTEST).sqrt())]
    }

    /// Waves that stand for the spectrum, another set for each seed.
    ///
    /// Each has the whole variance of its own share of the frequencies (shares grow as ω does), so that the sum has that of
    /// the spectrum within [`Self::range`]; within its share its frequency is chosen by chance, as are direction and phase.
    ///
    /// # Errors
    /// Numbers that are none; a wind too weak, and one whose spectrum has waves that break (of few waves each is high).
    pub fn raise(&self, seed: u32) -> Result<Vec<Stokes>, WaveError> {
        let numbers = [
            ("the speed of the wind", self.speed),
            ("the fetch of the wind", self.fetch),
            ("the depth of the water", self.depth.unwrap_or(1.0)),
            ("the number of waves", self.waves as f64),
        ];
        if let Some((what, value)) =
            numbers.into_iter().find(|(_, value)| !(value.is_finite() && *value > 0.0))
        {
            return Err(WaveError::Number(what, value));
        }
        let [low, high] = self.range();
        if high < 1.5 * self.peak() {
            return Err(WaveError::Ripples(self.speed, self.fetch));
        }
        let ratio = (high / low).powf(1.0 / self.waves as f64);
        (0..self.waves).map(|i| self.wave(seed, i as u32, low * ratio.powi(i as i32), ratio)).collect()
    }

    /// Number `i`, of the frequencies from `first` to `first` times `ratio`.
    fn wave(&self, seed: u32, i: u32, first: f64, ratio: f64) -> Result<Stokes, WaveError> {
        // ∫ S dω = ∫ S ω d(ln ω), by midpoints.
        let step = ratio.ln() / POINTS as f64;
        let at = |j: usize| first * ((j as f64 + 0.5) * step).exp();
        let variance: f64 = (0..POINTS).map(|j| self.density(at(j)) * at(j) * step).sum();
        let chance = |purpose: u32| {
            let [bits, _] = shift(scramble(seed).wrapping_add(i), purpose);
            (f64::from(bits) + 0.5) / 4_294_967_296.0
        };
        let omega = first * ratio.powf(chance(1));
        let wavenumber = wavenumber(omega, self.depth);
        let (sin, cos) = turned(chance(2)).sin_cos();
        let toward = DVec2::new(cos, sin).rotate(self.toward.normalize_or(DVec2::X));
        let wave = Stokes::new((2.0 * variance).sqrt(), TAU / wavenumber, toward, TAU * chance(3))?;
        Ok(if self.depth.is_some() { wave.with_frequency(omega) } else { wave })
    }
}

/// k \[rad/m\] of ω² = g k tanh(k h).
fn wavenumber(omega: f64, depth: Option<f64>) -> f64 {
    let deep = omega * omega / G;
    let Some(depth) = depth else { return deep };
    // With x = k h: x tanh x = y, which is nearly x² below 1 and x above: Newton's steps settle within ten from either side.
    let y = deep * depth;
    let mut x = y.max(y.sqrt());
    for _ in 0..20 {
        let tanh = x.tanh();
        x -= (x * tanh - y) / (tanh + x * (1.0 - tanh * tanh));
    }
    x / depth
}

/// The angle up to which (2/π) cos² θ has this share of its energy: ½ + (θ + sin θ cos θ)/π = share, by bisection.
fn turned(share: f64) -> f64 {
    let (mut low, mut high) = (-FRAC_PI_2, FRAC_PI_2);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        match 0.5 + (middle + middle.sin() * middle.cos()) * FRAC_1_PI < share {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}
