//! How much a microfacet surface reflects in all, by direction and roughness: tables.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use super::lobe::{LEAST_WIDTH, reflected};

/// Intervals of √cos, and of roughness.
const COSINES: usize = 32;
const ROUGHNESSES: usize = 16;

/// Directional albedo of a microfacet lobe for one Fresnel curve, by cosine and roughness.
///
/// Linear between 33 values of √cos (which spreads out the grazing angles, where Fresnel rises) and 17 of
/// roughness: within 0.5 % of full reflection.
#[derive(Debug)]
pub(crate) struct Albedo {
    /// By √cos, then roughness.
    cells: Vec<[f32; ROUGHNESSES + 1]>,
    /// Mean over the hemisphere weighted by the cosine, 2 ∫ E(μ) μ dμ, by roughness: exact for the table's own interpolation.
    means: [f32; ROUGHNESSES + 1],
}

impl Albedo {
    fn new(fresnel: impl Fn(f64) -> f64) -> Self {
        let cell = |i: usize, j: usize| {
            let cos = (i as f64 / COSINES as f64).powi(2).max(1e-6);
            let width = (j as f64 / ROUGHNESSES as f64).powi(2).max(LEAST_WIDTH);
            reflected(cos, width, &fresnel) as f32
        };
        let cells: Vec<_> = (0..=COSINES).map(|i| std::array::from_fn(|j| cell(i, j))).collect();
        let means = std::array::from_fn(|j| mean(|i| f64::from(cells[i][j])) as f32);
        Self { cells, means }
    }

    /// Facets that reflect everything.
    pub(crate) fn white() -> &'static Self {
        static WHITE: LazyLock<Albedo> = LazyLock::new(|| Albedo::new(|_| 1.0));
        &WHITE
    }

    /// Facets that reflect (1 − cos)⁵: Schlick's part that rises from 0 to 1.
    pub(crate) fn rise() -> &'static Self {
        static RISE: LazyLock<Albedo> = LazyLock::new(|| Albedo::new(|cos| (1.0 - cos).powi(5)));
        &RISE
    }

    /// A dielectric of index `ior` ≥ 1, rounded to hundredths: head on that is 0.08 % of reflection at most.
    ///
    /// Made once per index (about 40 ms), so that no file can ask for more than 400 of them.
    pub(crate) fn dielectric(ior: f32) -> Arc<Self> {
        static MADE: Mutex<BTreeMap<u32, Arc<Albedo>>> = Mutex::new(BTreeMap::new());
        let hundredths = (ior.clamp(1.0, MOST_REFRACTIVE) * 100.0).round() as u32;
        // A panic elsewhere cannot leave the map half changed: it only ever grows by whole tables.
        let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
        let eta = f64::from(hundredths) / 100.0;
        let make = || Arc::new(Self::new(|cos| light::fresnel(eta, cos)));
        made.entry(hundredths).or_insert_with(make).clone()
    }

    /// At `cos` within \[0, 1\] and a place of the roughness axis.
    pub(crate) fn at(&self, cos: f32, roughness: Fraction) -> f32 {
        let Fraction { first, share } = Fraction::new(cos.clamp(0.0, 1.0).sqrt(), COSINES);
        let along = |i: usize| roughness.of(&self.cells[i]);
        along(first) + share * (along(first + 1) - along(first))
    }

    /// Mean over the hemisphere.
    pub(crate) fn mean(&self, roughness: Fraction) -> f32 {
        roughness.of(&self.means)
    }
}

/// Largest index of refraction that is told from greater ones (diamond has 2.4, germanium 4).
pub(crate) const MOST_REFRACTIVE: f32 = 5.0;

/// A place between two entries of a table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fraction {
    first: usize,
    share: f32,
}

impl Fraction {
    /// Where `at` within \[0, 1\] lies on an axis of `steps` intervals.
    fn new(at: f32, steps: usize) -> Self {
        let at = at * steps as f32;
        let first = (at as usize).min(steps - 1);
        Self { first, share: at - first as f32 }
    }

    /// Where a roughness within \[0, 1\] lies on the tables' axis.
    pub(crate) fn of_roughness(roughness: f32) -> Self {
        Self::new(roughness, ROUGHNESSES)
    }

    fn of(self, row: &[f32; ROUGHNESSES + 1]) -> f32 {
        row[self.first] + self.share * (row[self.first + 1] - row[self.first])
    }
}

/// 2 ∫ E μ dμ = ∫ E(x) 4 x³ dx with x = √μ, for E linear between its values at the grid of x.
fn mean(value: impl Fn(usize) -> f64) -> f64 {
    // Three points of Gauss in every interval: exact up to the fifth power, and this is the fourth.
    const GAUSS: [(f64, f64); 3] =
        [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
    let mut sum = 0.0;
    for i in 0..COSINES {
        for (t, weight) in GAUSS {
            let x = (i as f64 + t) / COSINES as f64;
            sum += weight * (value(i) + t * (value(i + 1) - value(i))) * 4.0 * x * x * x;
        }
    }
    sum / COSINES as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_within_their_stated_error() {
        let glass = Albedo::dielectric(1.5);
        for roughness in [0.03f32, 0.33, 0.55, 0.91, 1.0] {
            for cos in [0.01f32, 0.07, 0.3, 0.77, 1.0] {
                let width = f64::from(super::super::lobe::width(roughness));
                let at = Fraction::of_roughness(roughness);
                let (cos64, eta) = (f64::from(cos), 1.5);
                let glass_error =
                    glass.at(cos, at) - reflected(cos64, width, |c| light::fresnel(eta, c)) as f32;
                let white_error = Albedo::white().at(cos, at) - reflected(cos64, width, |_| 1.0) as f32;
                assert!(glass_error.abs() < 0.005, "{roughness} {cos}: {glass_error}");
                assert!(white_error.abs() < 0.005, "{roughness} {cos}: {white_error}");
            }
        }
    }

    #[test]
    fn means_are_those_of_simple_curves() {
        assert!((mean(|_| 0.7) - 0.7).abs() < 1e-15);
        // E = x = √μ, linear on the grid: 2 ∫ μ^1.5 dμ = 4/5.
        assert!((mean(|i| i as f64 / COSINES as f64) - 0.8).abs() < 1e-15);
        // A smooth dielectric of 1.5 reflects 9.18 % of diffuse light (Walsh's formula); the table's
        // interpolation is within 0.5 %, and its facets' width adds less than α.
        let diffuse = Albedo::dielectric(1.5).mean(Fraction::of_roughness(0.0));
        assert!((diffuse - 0.0918).abs() < 0.005 + LEAST_WIDTH as f32, "{diffuse}");
    }

    #[test]
    fn nothing_reflects_without_a_change_of_index() {
        let none = Albedo::dielectric(1.0);
        assert!(none.cells.iter().flatten().chain(&none.means).all(|&e| e == 0.0));
    }

    #[test]
    fn no_lobe_reflects_more_than_everything() {
        for table in [Albedo::white(), Albedo::rise(), &Albedo::dielectric(1.33), &Albedo::dielectric(9.0)] {
            assert!(table.cells.iter().flatten().all(|&e| (0.0..=1.0).contains(&e)));
        }
    }
}
