//! Into which directions water scatters: phase functions.
//!
//! p(θ) \[1/sr\] with ∫ p dω = 1 over the sphere, so that β(θ) = b p(θ) and b and β(90°) cannot contradict each other
//! (appendix A of the thesis gives them apart, and its pool would scatter more than it attenuates).

mod angles;
mod fournier_forand;
mod petzold;
#[cfg(test)]
mod tests;

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;
use std::sync::{Arc, LazyLock};

use angles::Angles;

use crate::quadrature::{Tolerance, integrate};

/// Depolarisation ratio of water's molecules (Farinato and Rowell 1976, as Zhang, Hu and He 2009 take it).
pub const DEPOLARISATION: f64 = 0.039;
/// Depolarisation ratio that makes the molecular phase function 1 + 0.835 cos² θ (Morel 1974).
pub const DEPOLARISATION_MOREL: f64 = 0.09;
/// (e_f, e_b) that the thesis gives for sea water (A.2): 0.2 % of the light is scattered backwards, a ninth of what is measured.
pub const THESIS_SEA: [f64; 2] = [0.95, 0.57];
/// (e_f, e_b) of A.2 whose backscattered share is near measured ones.
pub const SEA: [f64; 2] = [0.9, 0.57];

/// Below this angle \[rad\] the measured and the Fournier–Forand function, which grow without bound, keep their value.
const PEAK: f64 = 1e-6;

/// How directions share the light that is scattered: p(θ) \[1/sr\], ≥ 0, ∫ p dω = 1.
///
/// The norm, the backscattered share and the mean cosine are computed when it is made, to 1e-9.
///
/// ```
/// use keikan_water::Phase;
/// let measured = Phase::petzold();
/// assert!((measured.backscattered() - 0.0183).abs() < 1e-4); // Mobley 1994
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Phase {
    shape: Shape,
    scale: f64,
    backscattered: f64,
    mean_cosine: f64,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Molecular { depolarisation: f64 },
    Petzold,
    BeardsleyZaneveld { forward: f64, backward: f64 },
    FournierForand { index: f64, slope: f64 },
    HenyeyGreenstein { mean_cosine: f64 },
    Table(Arc<Angles>),
    Mixture(Vec<(f64, Phase)>),
}

/// Why there is no such phase function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PhaseError {
    /// A parameter is outside its range: name, value, least, largest.
    Range(&'static str, f64, f64, f64),
    /// The shares of a mixture are negative, not finite, or all zero.
    Shares,
    /// A table has fewer than two rows.
    Rows(usize),
    /// Angles of a table do not rise within 0 to 180° at this row (counted from 1): the angle \[degrees\].
    Angle(usize, f64),
    /// A value of a table is not a number above 0: row (counted from 1) and value.
    Value(usize, f64),
}

impl fmt::Display for PhaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range(name, value, least, largest) => {
                write!(f, "{name} of a phase function is {value}, but must lie within {least} to {largest}")
            }
            Self::Shares => {
                write!(f, "the shares of a mixture must be 0 or more, and one of them more than 0")
            }
            Self::Rows(rows) => write!(f, "a table of scattering needs two rows or more, but has {rows}"),
            Self::Angle(row, angle) => {
                write!(
                    f,
                    "angles of a table of scattering must rise within 0 and 180°, but row {row} has {angle}°"
                )
            }
            Self::Value(row, value) => {
                write!(f, "scattering in row {row} is {value}, but must be a number above 0")
            }
        }
    }
}

impl std::error::Error for PhaseError {}

fn within(name: &'static str, value: f64, [least, largest]: [f64; 2]) -> Result<f64, PhaseError> {
    let inside = value >= least && value <= largest;
    if inside { Ok(value) } else { Err(PhaseError::Range(name, value, least, largest)) }
}

impl Phase {
    /// Scattering by molecules: 1 + p cos² θ with p = (1 − δ)/(1 + δ), δ the depolarisation ratio within \[0, 1\].
    pub fn molecular(depolarisation: f64) -> Result<Self, PhaseError> {
        let depolarisation = within("the depolarisation ratio", depolarisation, [0.0, 1.0])?;
        Ok(Self::normalised(Shape::Molecular { depolarisation }))
    }

    /// That of pure water, with [`DEPOLARISATION`].
    pub fn water() -> Self {
        Self::normalised(Shape::Molecular { depolarisation: DEPOLARISATION })
    }

    /// 1 + 0.835 cos² θ, that of pure water by Morel 1974.
    pub fn morel() -> Self {
        Self::normalised(Shape::Molecular { depolarisation: DEPOLARISATION_MOREL })
    }

    /// That of the thesis for sea water, with [`THESIS_SEA`].
    pub fn thesis() -> Self {
        let [forward, backward] = THESIS_SEA;
        Self::normalised(Shape::BeardsleyZaneveld { forward, backward })
    }

    /// Petzold's measurements (1972) of three waters, less molecular scattering, on average (Mobley, *Light and Water*,
    /// table 3.10): cubic in the logarithms between the measured angles, ∝ θ^−1.346 below 0.1°. The table's integral is
    /// 0.995 (0.994 if linear in the logarithms); here it is made 1.
    pub fn petzold() -> Self {
        static KEPT: LazyLock<Phase> = LazyLock::new(|| Phase::normalised(Shape::Petzold));
        KEPT.clone()
    }

    /// f = 1/((1 − e_f cos θ)⁴ (1 + e_b cos θ)⁴) (thesis A.2, Beardsley and Zaneveld 1969), divided by its integral;
    /// both within \[0, 0.9999\].
    ///
    /// ```
    /// use keikan_water::{Phase, phase};
    /// let [forward, backward] = phase::THESIS_SEA;
    /// let thesis = Phase::beardsley_zaneveld(forward, backward).unwrap();
    /// assert!((1.0 / thesis.value(0.0) - 3030.34).abs() < 0.01); // sr, f(90°) = 1
    /// ```
    pub fn beardsley_zaneveld(forward: f64, backward: f64) -> Result<Self, PhaseError> {
        let forward = within("e_f", forward, [0.0, 0.9999])?;
        let backward = within("e_b", backward, [0.0, 0.9999])?;
        Ok(Self::normalised(Shape::BeardsleyZaneveld { forward, backward }))
    }

    /// Spheres of relative index `index` (1.01 to 1.35) with diameters distributed as d^−slope (3.3 to 4.9): Fournier and Forand 1994,
    /// in the form of Fournier and Jonasz 1999. Of slopes near 3 a part of the light goes on within less than 1e-6 rad
    /// (4 % at 3.3 and 1.02) and counts as not scattered.
    pub fn fournier_forand(index: f64, slope: f64) -> Result<Self, PhaseError> {
        let index = within("the index of the particles", index, [1.01, 1.35])?;
        let slope = within("the slope of their sizes", slope, [3.3, 4.9])?;
        Ok(Self::normalised(Shape::FournierForand { index, slope }))
    }

    /// (1 − g²)/(4π (1 + g² − 2 g cos θ)^1.5), g the mean cosine within \[−0.9999, 0.9999\] (Henyey and Greenstein 1941).
    pub fn henyey_greenstein(mean_cosine: f64) -> Result<Self, PhaseError> {
        let mean_cosine = within("the mean cosine", mean_cosine, [-0.9999, 0.9999])?;
        Ok(Self::normalised(Shape::HenyeyGreenstein { mean_cosine }))
    }

    /// Measured: rows of scattering angle \[degrees\], rising within 0 to 180, and p or β in any unit, above 0. Cubic in the
    /// logarithms between the rows; below the first a power law that goes on as between the first two (no steeper than
    /// θ^−1.9, which still has an integral), above the last constant.
    ///
    /// ```
    /// use keikan_water::Phase;
    /// let even = Phase::table(&[(0.0, 7.0), (180.0, 7.0)]).unwrap();
    /// assert!((even.value(0.3) * 4.0 * std::f64::consts::PI - 1.0).abs() < 1e-9);
    /// ```
    pub fn table(rows: &[(f64, f64)]) -> Result<Self, PhaseError> {
        let mut before = None;
        for (row, &(angle, value)) in rows.iter().enumerate() {
            // What is nearer to 0 than the peak's width is 0.
            let rises = before.is_none_or(|before: f64| angle > before.max(2.0 * PEAK.to_degrees()));
            if !(rises && (0.0..=180.0).contains(&angle)) {
                return Err(PhaseError::Angle(row + 1, angle));
            }
            if !(value > 0.0 && value.is_finite()) {
                return Err(PhaseError::Value(row + 1, value));
            }
            before = Some(angle);
        }
        let [first, second, ..] = rows else { return Err(PhaseError::Rows(rows.len())) };
        let ratio = |a: f64, b: f64| (b / a).ln();
        let slope = match first.0 > 0.0 {
            true => (ratio(first.1, second.1) / ratio(first.0, second.0)).clamp(-1.9, 1.9),
            false => 0.0,
        };
        Ok(Self::normalised(Shape::Table(Arc::new(Angles::new(rows, slope)))))
    }

    /// Several at once, each with its share of b; the shares need not sum to 1.
    pub fn mixture(parts: Vec<(f64, Self)>) -> Result<Self, PhaseError> {
        let whole: f64 = parts.iter().map(|part| part.0).sum();
        let sound = parts.iter().all(|part| part.0 >= 0.0) && whole > 0.0 && whole.is_finite();
        if !sound {
            return Err(PhaseError::Shares);
        }
        let parts: Vec<_> = parts.into_iter().map(|(share, phase)| (share / whole, phase)).collect();
        let mean = |of: fn(&Self) -> f64| parts.iter().map(|(share, phase)| share * of(phase)).sum();
        let (backscattered, mean_cosine) = (mean(Self::backscattered), mean(Self::mean_cosine));
        Ok(Self { shape: Shape::Mixture(parts), scale: 1.0, backscattered, mean_cosine })
    }

    /// p at the cosine of the scattering angle (1 = straight on) \[1/sr\]; cosines beyond ±1 count as ±1.
    pub fn value(&self, cos: f64) -> f64 {
        self.at((0.5 - 0.5 * cos).clamp(0.0, 1.0))
    }

    /// Share of the scattered light that goes backwards, θ > 90°: b_b/b.
    pub fn backscattered(&self) -> f64 {
        self.backscattered
    }

    /// ∫ p cos θ dω.
    pub fn mean_cosine(&self) -> f64 {
        self.mean_cosine
    }

    /// p at sin²(θ/2), which keeps the digits of small angles that cos θ loses.
    fn at(&self, half_sine2: f64) -> f64 {
        self.scale * self.shape.at(half_sine2)
    }

    fn normalised(shape: Shape) -> Self {
        let ([front, front_cosine], [back, back_cosine]) = shape.moments();
        let whole = front + back;
        Self {
            shape,
            scale: 1.0 / whole,
            backscattered: back / whole,
            mean_cosine: (front_cosine + back_cosine) / whole,
        }
    }
}

impl Shape {
    /// The function before it is made to integrate to 1, at s = sin²(θ/2).
    fn at(&self, s: f64) -> f64 {
        match *self {
            Self::Molecular { depolarisation } => {
                let cos = 1.0 - 2.0 * s;
                1.0 + (1.0 - depolarisation) / (1.0 + depolarisation) * cos * cos
            }
            Self::Petzold => petzold::PETZOLD.at(s),
            Self::BeardsleyZaneveld { forward, backward } => {
                let ahead = (1.0 - forward) + 2.0 * forward * s;
                let behind = (1.0 + backward) - 2.0 * backward * s;
                (ahead * behind).powi(-4)
            }
            Self::FournierForand { index, slope } => fournier_forand::at(index, slope, s),
            Self::HenyeyGreenstein { mean_cosine: g } => {
                let distance2 = (1.0 - g) * (1.0 - g) + 4.0 * g * s;
                (1.0 - g) * (1.0 + g) / (4.0 * PI * distance2 * distance2.sqrt())
            }
            Self::Table(ref table) => table.at(s),
            Self::Mixture(ref parts) => parts.iter().map(|(share, phase)| share * phase.at(s)).sum(),
        }
    }

    /// ∫ f dω and ∫ f cos θ dω over the front and the back hemisphere, with dω = 2π θ sin θ d(ln θ): peaks are wide in ln θ.
    fn moments(&self) -> ([f64; 2], [f64; 2]) {
        let tolerance = Tolerance { absolute: 0.0, relative: 1e-10, evaluations: 20_000 };
        let over = |angles: &[f64]| {
            let breaks: Vec<f64> = angles.iter().map(|angle| angle.ln()).collect();
            let integrand = |log: f64| {
                let angle = log.exp();
                let s = (0.5 * angle).sin().powi(2);
                let ring = 2.0 * PI * angle * angle.sin() * self.at(s);
                [ring, ring * (1.0 - 2.0 * s)]
            };
            integrate(&breaks, tolerance, integrand).value
        };
        // Within 1e-10 rad lie 3e-20 sr, and p < 1e9 for every function here.
        let mut front = vec![1e-10, PEAK, 1e-4];
        let mut back = vec![FRAC_PI_2];
        let table = match self {
            Self::Petzold => Some(&*petzold::PETZOLD),
            Self::Table(table) => Some(&**table),
            _ => None,
        };
        match table {
            Some(table) => {
                let angles = || table.angles().filter(|angle| *angle > PEAK * 1.01);
                front.extend(angles().filter(|angle| *angle < FRAC_PI_2 - 1e-9));
                back.extend(angles().filter(|angle| *angle > FRAC_PI_2 + 1e-9 && *angle < PI - 1e-9));
                front.sort_by(f64::total_cmp);
            }
            None => front.extend([1e-3, 1e-2, 0.1, 0.5]),
        }
        front.push(FRAC_PI_2);
        back.push(PI);
        (over(&front), over(&back))
    }
}
