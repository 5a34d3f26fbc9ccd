//! C planes: from the part that a symmetric file tabulates to the whole sphere.

use super::{Fault, Notes};

/// What the planes of a table leave unsaid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Symmetry {
    /// Nothing: the planes go all the way round.
    None,
    /// One plane holds for every C.
    Axial,
    /// The plane C0–C180 is a mirror: I(C) = I(−C).
    AcrossC0,
    /// The plane C90–C270 is a mirror: I(C) = I(180° − C).
    AcrossC90,
    /// Both are.
    Quadrants,
}

impl Symmetry {
    /// Where the values of the plane at `c` hold.
    fn images(self, c: f32) -> impl Iterator<Item = f32> {
        let (all, count) = match self {
            Self::None | Self::Axial => ([c, 0.0, 0.0, 0.0], 1),
            Self::AcrossC0 => ([c, -c, 0.0, 0.0], 2),
            Self::AcrossC90 => ([c, 180.0 - c, 0.0, 0.0], 2),
            Self::Quadrants => ([c, -c, 180.0 - c, 180.0 + c], 4),
        };
        all.into_iter().take(count)
    }
}

/// Intensities over C planes by γ, γ running fastest.
pub(super) struct Table {
    /// C angles \[degrees\].
    pub(super) c: Vec<f32>,
    /// γ angles \[degrees\].
    pub(super) gamma: Vec<f32>,
    /// Intensities, unit as in the file.
    pub(super) intensity: Vec<f32>,
}

impl Table {
    /// The whole sphere: every plane at all its images under `symmetry`, turned by `turn` \[degrees\], in
    /// rising order, closed at 360° by the plane at 0 if there is one.
    pub(super) fn completed(self, symmetry: Symmetry, turn: f32) -> Self {
        if self.c.len() == 1 || symmetry == Symmetry::Axial {
            let row = self.intensity[..self.gamma.len()].to_vec();
            return Self { c: vec![0.0], gamma: self.gamma, intensity: row };
        }
        if symmetry == Symmetry::None && turn == 0.0 {
            return self;
        }
        let images = self
            .c
            .iter()
            .enumerate()
            .flat_map(|(plane, &c)| symmetry.images(c).map(move |image| (folded(image + turn), plane)));
        let mut planes: Vec<(f32, usize)> = images.collect();
        // The sort is stable, so of two planes at one angle (0 and 360) the earlier stays.
        planes.sort_by(|a, b| a.0.total_cmp(&b.0));
        planes.dedup_by(|later, earlier| later.0 - earlier.0 < NEAR);
        if planes[0].0 == 0.0 {
            planes.push((360.0, planes[0].1));
        }
        let row = |plane: usize| &self.intensity[plane * self.gamma.len()..][..self.gamma.len()];
        let intensity = planes.iter().flat_map(|&(_, plane)| row(plane)).copied().collect();
        Self { c: planes.iter().map(|plane| plane.0).collect(), gamma: self.gamma, intensity }
    }

    /// Absolute candela: every intensity times `factor`. Negative ones (noise of a goniophotometer) become 0,
    /// with a warning.
    pub(super) fn distribution(
        mut self,
        factor: f64,
        line: usize,
        notes: &mut Notes,
    ) -> Result<light::Distribution, Fault> {
        if !(factor.is_finite() && factor >= 0.0) {
            return Err(Fault::new(
                line,
                format!("the intensities' factor is {factor}; it cannot be negative"),
            ));
        }
        let negative = self.intensity.iter().filter(|&&i| i < 0.0).count();
        if negative > 0 {
            notes.add(line, format!("{negative} negative intensities were taken as 0"));
        }
        for intensity in &mut self.intensity {
            *intensity = (f64::from(*intensity) * factor).max(0.0) as f32;
        }
        if self.intensity.iter().all(|&i| i == 0.0) {
            notes.add(line, "every intensity is 0: this luminaire is dark");
        }
        light::Distribution::new(self.c, self.gamma, self.intensity).ok_or_else(|| {
            Fault::new(line, "an intensity is too large, or two angles are too close to tell apart")
        })
    }
}

/// Planes nearer than this \[degrees\] are one: a file's four decimals, and the rounding of a mirrored angle.
const NEAR: f32 = 1e-3;

/// The same angle within 0 to 360°, 0 for what is within rounding of either end.
fn folded(angle: f32) -> f32 {
    let angle = angle.rem_euclid(360.0);
    if !(NEAR..=360.0 - NEAR).contains(&angle) { 0.0 } else { angle }
}
