//! How much of the light facets reflect in all: what couples gloss to what lies below it (Kelemen and Szirmay-Kalos 2001) and gives metals
//! back what facets pass among themselves (Kulla and Conty 2017).

use std::f64::consts::TAU;

use light::fresnel;

use crate::bands::Bands;
use crate::facets::{LEAST_WIDTH, masking};

/// Intervals of √cos, and of roughness where textures vary it.
const COSINES: usize = 48;
const ROUGHNESSES: usize = 24;
/// Points along each axis of an integral.
const POINTS: usize = 96;

/// Tables for one index, over one roughness or all.
pub(crate) struct Boundary {
    index: f64,
    /// Widths α that there are rows of, rising.
    widths: Vec<f64>,
    dielectric: Vec<Row>,
    white: Vec<Row>,
}

/// By √cos, and the mean over the hemisphere.
struct Row {
    values: Vec<f64>,
    mean: f64,
}

impl Boundary {
    /// None of it is asked for where there is neither gloss nor metal.
    pub(crate) fn none() -> Self {
        Self { index: 1.0, widths: Vec::new(), dielectric: Vec::new(), white: Vec::new() }
    }

    /// For an index and a roughness, or all up to it.
    pub(crate) fn new(index: f64, roughness: f64, varies: bool, metal: bool) -> Self {
        let width = |roughness: f64| (roughness * roughness).max(LEAST_WIDTH);
        let widths: Vec<f64> = match varies {
            false => vec![width(roughness)],
            true => {
                let mut widths: Vec<f64> =
                    (0..=ROUGHNESSES).map(|i| width(i as f64 / ROUGHNESSES as f64)).collect();
                widths.dedup();
                widths
            }
        };
        let rows = |f: &dyn Fn(f64) -> f64| widths.iter().map(|width| Row::new(*width, f)).collect();
        Self {
            dielectric: rows(&|cos| fresnel(index, cos)),
            white: if metal { rows(&|_| 1.0) } else { Vec::new() },
            index,
            widths,
        }
    }

    pub(crate) fn fresnel(&self, cos: f64) -> f64 {
        if self.index > 1.0 { fresnel(self.index, cos) } else { 0.0 }
    }

    /// E of the dielectric at a cosine.
    pub(crate) fn dielectric(&self, cos: f64, width: f64) -> f64 {
        if self.index > 1.0 { self.of(&self.dielectric, width, |row| row.at(cos)) } else { 0.0 }
    }

    /// Its mean over the hemisphere, 2 ∫ E cos d cos.
    pub(crate) fn dielectric_mean(&self, width: f64) -> f64 {
        if self.index > 1.0 { self.of(&self.dielectric, width, |row| row.mean) } else { 0.0 }
    }

    /// Share of light that leaves a metal after more than one facet: F̄² Ā/(1 − F̄ (1 − Ā)), F̄ = (20 F₀ + 1)/21.
    pub(crate) fn among(&self, head_on: Bands, roughness: f64) -> Bands {
        if self.white.is_empty() {
            return Bands::ZERO;
        }
        let white = self.of(&self.white, (roughness * roughness).max(LEAST_WIDTH), |row| row.mean);
        head_on.map(|f0| {
            let f = (20.0 * f0 + 1.0) / 21.0;
            f * f * white / (1.0 - f * (1.0 - white))
        })
    }

    /// (1 − A(i)) (1 − A(o))/(1 − Ā).
    pub(crate) fn left_among(&self, cos: f64, cos_out: f64, width: f64) -> f64 {
        if self.white.is_empty() {
            return 0.0;
        }
        let at = |cos: f64| 1.0 - self.of(&self.white, width, |row| row.at(cos));
        let left = 1.0 - self.of(&self.white, width, |row| row.mean);
        at(cos) * at(cos_out) / left.max(1e-12)
    }

    fn of(&self, rows: &[Row], width: f64, value: impl Fn(&Row) -> f64) -> f64 {
        let after = self.widths.partition_point(|&w| w <= width).min(self.widths.len() - 1);
        let before = after.saturating_sub(1);
        let (a, b) = (self.widths[before], self.widths[after]);
        // Even in roughness, √α.
        let share =
            if b > a { ((width.sqrt() - a.sqrt()) / (b.sqrt() - a.sqrt())).clamp(0.0, 1.0) } else { 0.0 };
        let (from, to) = (value(&rows[before]), value(&rows[after]));
        from + share * (to - from)
    }
}

impl Row {
    fn new(width: f64, fresnel: &dyn Fn(f64) -> f64) -> Self {
        let cos = |i: usize| (i as f64 / COSINES as f64).powi(2).max(1e-6);
        let values: Vec<f64> = (0..=COSINES).map(|i| reflected(cos(i), width, fresnel)).collect();
        let mut row = Self { values, mean: 0.0 };
        let steps = 1000;
        let mean = |i: usize| {
            let cos = (i as f64 + 0.5) / f64::from(steps);
            2.0 * cos * row.at(cos) / f64::from(steps)
        };
        row.mean = (0..steps as usize).map(mean).sum();
        row
    }

    fn at(&self, cos: f64) -> f64 {
        let x = cos.clamp(0.0, 1.0).sqrt() * COSINES as f64;
        let i = (x as usize).min(COSINES - 1);
        self.values[i] + (x - i as f64) * (self.values[i + 1] - self.values[i])
    }
}

/// E(o) = ∫ F D G/(4 cos_i cos_o) cos_i dω_i by facets: with tan² θ_h = α² u/(1 − u), D cos θ_h dω_h = du dφ/2π, dω_i = 4 (o·h) dω_h,
///
///   E = ∫∫ F(o·h) 4 (o·h) cos_i M(i, o)/cos_h du dφ/2π,   M = G/(4 cos_i cos_o)
fn reflected(cos_out: f64, width: f64, fresnel: &dyn Fn(f64) -> f64) -> f64 {
    let sin_out = (1.0 - cos_out * cos_out).max(0.0).sqrt();
    let mut sum = 0.0;
    for i in 0..POINTS {
        // u = 1 − (1 − x)²: more points where facets are steep, where grazing light finds those that face it.
        let x = (i as f64 + 0.5) / POINTS as f64;
        let u = 1.0 - (1.0 - x) * (1.0 - x);
        let cos_half = 1.0 / (1.0 + width * width * u / (1.0 - u)).sqrt();
        let sin_half = (1.0 - cos_half * cos_half).max(0.0).sqrt();
        for j in 0..POINTS {
            let turn = TAU * (j as f64 + 0.5) / POINTS as f64;
            let facing = cos_out * cos_half + sin_out * sin_half * turn.cos();
            let cos = 2.0 * facing * cos_half - cos_out;
            if facing > 0.0 && cos > 0.0 {
                sum += fresnel(facing.min(1.0)) * 4.0 * facing * cos * masking(cos, cos_out, width)
                    / cos_half
                    * 2.0
                    * (1.0 - x);
            }
        }
    }
    sum / (POINTS * POINTS) as f64
}
