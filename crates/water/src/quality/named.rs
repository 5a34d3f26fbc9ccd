//! The waters that there are, by name.

use light::Spectrum;

use super::chlorophyll::{fresh_molecules, pure_absorption, sea_molecules, uniform};
use super::tables::jerlov::{Jerlov, TYPES};
use super::tables::pure;
use super::{FRESH, QualityError, SEA, Scatterer, Water};
use crate::Phase;

/// Scattering by what filters leave in a swimming pool, at 550 nm \[1/m\].
const POOL_PARTICLES: f64 = 0.05;

/// Wavelengths at which the thesis' red, green and blue are read \[nm\]: there b of its water (a) is 0.033 1/m and pure
/// sea water by Morel.
const THESIS_NM: [f64; 3] = [650.0, 548.0, 460.0];

/// b and c of the thesis' three waters (its table 3.1), red, green, blue \[1/m\].
const THESIS: [(&str, [f64; 3], [f64; 3]); 3] = [
    ("thesis-a", [0.03399, 0.03500, 0.03719], [0.718, 0.159, 0.133]),
    ("thesis-b", [0.06798, 0.17500, 0.07438], [0.808, 0.379, 0.283]),
    ("thesis-c", [1.41015, 0.84100, 0.13119], [1.632, 1.281, 0.730]),
];

/// c \[1/m\] and β(90°) \[1/(m sr)\] of the thesis' pool (its table 3.2), and its index in green.
const THESIS_POOL: ([f64; 3], [f64; 3], f64) = ([0.718, 0.159, 0.133], [1.8e-4, 2.3e-4, 3.63e-4], 1.3345);

/// Names of all waters.
pub fn names() -> impl Iterator<Item = &'static str> {
    let thesis = THESIS.iter().map(|water| water.0);
    ["pool", "distilled", "sea"]
        .into_iter()
        .chain(TYPES.iter().map(|water| water.name))
        .chain(thesis)
        .chain(["thesis-pool"])
}

impl Water {
    /// The water of that name, capital letters or not; an error lists the names.
    ///
    /// | name | water |
    /// | --- | --- |
    /// | `distilled` | pure fresh water at 20 °C: WOPP v3 absorption, Zhang 2009 scattering |
    /// | `pool` | the same with particles of b = 0.05 1/m at 550 nm, ∝ 1/λ, by Petzold: an assumption for filtered water, in which 25 m leave a wall about a tenth of its contrast |
    /// | `sea` | pure sea water, 35 psu |
    /// | `jerlov-I`, `-IA`, `-IB`, `-II`, `-III` | open ocean, clear to turbid |
    /// | `jerlov-1C`, `-3C`, `-5C`, `-7C`, `-9C` | coasts, clear to turbid |
    /// | `thesis-a`, `-b`, `-c` | the thesis' waters of figure 3.11 |
    /// | `thesis-pool` | its pool of figure 3.15 |
    ///
    /// Of Jerlov's types, molecules scatter what they do in pure sea water (at most b) and particles, by Petzold, the rest.
    ///
    /// The thesis' numbers are for red, green and blue, here read at 650, 548 and 460 nm, linear in between. Of its waters a, b
    /// and c the coefficients are kept and β(90°) follows from b = β(90°) · 3030 sr. Its pool has no b, and its β(90°)
    /// are those of molecules: with the phase function of sea water (A.2) they would scatter more than c. So c and β(90°) are kept and
    /// the phase function is made that of molecules, b = 16.06 sr · β(90°).
    pub fn named(name: &str) -> Result<Self, QualityError> {
        let is = |known: &str| known.eq_ignore_ascii_case(name);
        let particles = |b550: f64| Scatterer {
            scattering: Spectrum::from_fn(|nm| b550 * 550.0 / nm),
            phase: Phase::petzold(),
        };
        let pure = Spectrum::from_fn(pure_absorption);
        if let Some(kind) = TYPES.iter().find(|kind| is(kind.name)) {
            return jerlov(kind);
        }
        if let Some((_, b, c)) = THESIS.iter().find(|water| is(water.0)) {
            return thesis(*c, *b, Phase::thesis(), FRESH);
        }
        match () {
            () if is("distilled") => Self::new(pure, vec![fresh_molecules()], FRESH),
            () if is("pool") => Self::new(pure, vec![fresh_molecules(), particles(POOL_PARTICLES)], FRESH),
            () if is("sea") => Self::new(pure, vec![sea_molecules()], SEA),
            () if is("thesis-pool") => {
                let (c, sideways, index) = THESIS_POOL;
                let molecules = Phase::morel();
                let scattering = sideways.map(|beta| beta / molecules.value(0.0));
                thesis(c, scattering, molecules, index)
            }
            () => Err(QualityError::Unknown(name.to_owned())),
        }
    }
}

fn jerlov(kind: &Jerlov) -> Result<Water, QualityError> {
    // Steps of 25 nm cut off the edge of pure water's absorption at 600 nm: what is linear is the rest.
    let knots: Vec<f64> = (0..kind.absorption.len())
        .map(|i| kind.absorption[i] - pure_absorption(pure::FIRST_NM + kind.step_nm * i as f64))
        .collect();
    let absorption =
        Spectrum::from_fn(|nm| (pure_absorption(nm) + uniform(&knots, kind.step_nm, nm)).max(0.0));
    let scattering = Spectrum::from_fn(|nm| uniform(kind.scattering, kind.step_nm, nm));
    let molecules = sea_molecules();
    let own = Spectrum(std::array::from_fn(|b| molecules.scattering[b].min(scattering[b])));
    let scatterers = vec![
        Scatterer { scattering: own, ..molecules },
        Scatterer { scattering: scattering - own, phase: Phase::petzold() },
    ];
    Water::new(absorption, scatterers, SEA)
}

fn thesis(
    extinction: [f64; 3],
    scattering: [f64; 3],
    phase: Phase,
    index: f64,
) -> Result<Water, QualityError> {
    // From blue to red: wavelengths rise.
    let rows = |values: [f64; 3]| [2, 1, 0].map(|i| (THESIS_NM[i], values[i]));
    let absorbed = std::array::from_fn(|i| extinction[i] - scattering[i]);
    let scatterer = Scatterer { scattering: Spectrum::from_table(&rows(scattering)), phase };
    Water::new(Spectrum::from_table(&rows(absorbed)), vec![scatterer], index)
}
