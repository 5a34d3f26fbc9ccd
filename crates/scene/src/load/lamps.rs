//! Lamps from `[[light]]` tables.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DMat3, DVec3, Vec3};
use light::Distribution;

use super::placement::{look_along, rotation};
use crate::document::Spot;
use crate::file::{ConeTable, LightTable};
use crate::photometry::{self, Photometry};
use crate::{Error, Light, LightSpectrum, Warning};

/// Strongest intensity, flux, multiplier that is possible.
pub(crate) const STRONGEST: f64 = 1e12;

/// Photometric files that were read: a street has hundreds of lamps of one kind.
pub(crate) type Files = BTreeMap<PathBuf, Photometry>;

/// The lamp of one table.
pub(crate) fn lamp(
    spot: &Spot<'_>,
    number: usize,
    table: &LightTable,
    files: &mut Files,
    warnings: &mut Vec<Warning>,
) -> Result<Light, Error> {
    if table.luminance.is_some() {
        return Err(spot.key("luminance").error("is for lamps with a rectangle or sphere: a point has none"));
    }
    let name = name(table, number);
    let (position, world_from_light) = placed(spot, table)?;
    let (distribution, own_temperature) = distribution(spot, table, files, warnings)?;
    let given = spot.spectrum(table.temperature, table.rgb, table.spectrum.as_deref())?;
    let own =
        own_temperature.filter(|kelvin| (1000.0..=25000.0).contains(kelvin)).map(LightSpectrum::Temperature);
    let spectrum = given.or(own).unwrap_or(LightSpectrum::Rgb(Vec3::ONE));
    Ok(Light { name, position, world_from_light, distribution: Arc::new(distribution), spectrum })
}

/// Its name, given or made.
pub(crate) fn name(table: &LightTable, number: usize) -> String {
    table.name.clone().unwrap_or_else(|| format!("light-{number}"))
}

/// Where the lamp is, and how it is turned: from its frame (axis −Z) to the world.
pub(crate) fn placed(spot: &Spot<'_>, table: &LightTable) -> Result<(DVec3, DMat3), Error> {
    let at = spot.key("position");
    let position = at.point(at.required(table.position)?)?;
    let axis = axis(spot, table, position)?;
    let roll = spot.key("roll").within(table.roll.unwrap_or(0.0), -1e6, 1e6, "degrees")?;
    // Clockwise for who looks along −Z is clockwise about +Z as well: against the mathematical sense.
    Ok((position, look_along(axis, DVec3::Y) * rotation([0.0, 0.0, -roll])))
}

/// Where the lamp's axis (γ = 0) goes.
fn axis(spot: &Spot<'_>, table: &LightTable, position: DVec3) -> Result<DVec3, Error> {
    match (table.aim, table.direction) {
        (None, None) => Ok(DVec3::NEG_Y),
        (None, Some(direction)) => spot.key("direction").direction(direction),
        (Some(aim), None) => {
            let spot = spot.key("aim");
            let way = spot.point(aim)? - position;
            way.try_normalize().ok_or_else(|| spot.error("is the lamp's own position: aim at another point"))
        }
        (Some(_), Some(_)) => {
            Err(spot.error("has aim and direction at once, but only one of them is possible"))
        }
    }
}

/// Intensity over direction with everything applied, and the colour temperature that a file states.
fn distribution(
    spot: &Spot<'_>,
    table: &LightTable,
    files: &mut Files,
    warnings: &mut Vec<Warning>,
) -> Result<(Distribution, Option<f64>), Error> {
    let multiplier = spot.key("multiplier").within(table.multiplier.unwrap_or(1.0), 0.0, STRONGEST, "")?;
    let flux = table.flux.map(|lm| spot.key("flux").within(lm, 0.0, STRONGEST, "lm")).transpose()?;
    let (shape, own_flux, temperature) = match &table.file {
        Some(_) if table.intensity.is_some() || table.cone.is_some() => {
            return Err(spot
                .key("file")
                .error("brings its own intensities: intensity and cone are not possible beside it"));
        }
        Some(name) => {
            let photometry = read(&spot.key("file"), name, files, warnings)?;
            (photometry.distribution.clone(), photometry.flux, photometry.colour_temperature)
        }
        None => {
            spot.exactly_one(&[
                ("intensity", table.intensity.is_some()),
                ("flux", flux.is_some()),
                ("file", false),
            ])?;
            let candela = table.intensity.unwrap_or(1.0);
            let candela = spot.key("intensity").within(candela, 0.0, STRONGEST, "cd")?;
            let shape = match &table.cone {
                None => Distribution::isotropic(candela as f32),
                Some(cone) => cone_of(&spot.key("cone"), cone, candela)?,
            };
            let own_flux = shape.total_flux();
            (shape, own_flux, None)
        }
    };
    let factor = match flux {
        None => multiplier,
        Some(_) if own_flux <= 0.0 => {
            return Err(spot.key("flux").error("cannot be reached: the file is dark"));
        }
        Some(flux) => multiplier * flux / own_flux,
    };
    let factor = factor as f32;
    if !(shape.peak() * factor).is_finite() {
        return Err(spot.error("is brighter than numbers go"));
    }
    Ok((shape.scaled(factor), temperature))
}

/// A photometric file, read when it is named first.
fn read<'f>(
    spot: &Spot<'_>,
    name: &Path,
    files: &'f mut Files,
    warnings: &mut Vec<Warning>,
) -> Result<&'f Photometry, Error> {
    let path = spot.file(name);
    match files.entry(path) {
        Entry::Occupied(known) => Ok(known.into_mut()),
        Entry::Vacant(new) => {
            let mut photometry = photometry::read(new.key()).map_err(|error| super::missing(spot, error))?;
            warnings.append(&mut photometry.warnings);
            Ok(new.insert(photometry))
        }
    }
}

fn cone_of(spot: &Spot<'_>, cone: &ConeTable, candela: f64) -> Result<Distribution, Error> {
    let outer = spot.key("outer").positive(cone.outer, 90.0, "degrees")?;
    let inner = spot.key("inner").within(cone.inner, 0.0, outer, "degrees")?;
    if inner >= outer {
        return Err(spot.key("inner").error(format!("{inner} must be below outer, {outer}")));
    }
    let dark = || spot.error("is too narrow to be told from nothing");
    cone_distribution(candela, inner.to_radians(), outer.to_radians()).ok_or_else(dark)
}

/// KHR_lights_punctual's cone: t² with t = (cos γ − cos outer) / (cos inner − cos outer) within \[0, 1\],
/// half angles in radians, tabulated in 256 steps between inner and outer.
///
/// Linear interpolation is off by at most h²/8 · max|d²I/dγ²|, about I · (1/256)² · 2/8 < 4e-6 I for narrow
/// cones and, as cos bends at most like γ²/2, less than ten times that for wide ones.
pub(crate) fn cone_distribution(candela: f64, inner: f64, outer: f64) -> Option<Distribution> {
    const STEPS: u32 = 256;
    let (full, none) = (inner.cos(), outer.cos());
    let mut table: Vec<(f32, f32)> = vec![(0.0, candela as f32)];
    for step in 0..=STEPS {
        let gamma = inner + (outer - inner) * f64::from(step) / f64::from(STEPS);
        let t = ((gamma.cos() - none) / (full - none).max(1e-12)).clamp(0.0, 1.0);
        let row = (gamma.to_degrees() as f32, (candela * t * t) as f32);
        match table.last_mut() {
            // Steps of a very narrow cone may coincide in f32: the darker counts.
            Some(last) if last.0 >= row.0 => last.1 = row.1,
            _ => table.push(row),
        }
    }
    let (gamma, candela) = table.into_iter().unzip();
    Distribution::new(vec![0.0], gamma, candela)
}

/// Flux of a source of equal intensity all round \[lm\].
pub(crate) fn isotropic_flux(candela: f64) -> f64 {
    4.0 * PI * candela
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Φ = 2π I ∫ t² sin γ dγ = 2π I ((1 − cos inner) + (cos inner − cos outer)/3), as t is linear in cos γ.
    #[test]
    fn a_cone_has_the_flux_of_its_formula() {
        for (inner, outer) in [(0.0, 0.5), (0.3, 0.6), (0.0, PI / 2.0), (0.7, 0.71)] {
            let cone = cone_distribution(100.0, inner, outer).unwrap();
            let exact =
                2.0 * PI * 100.0 * ((1.0 - f64::cos(inner)) + (f64::cos(inner) - f64::cos(outer)) / 3.0);
            // Interpolation, 4e-5 of the peak at worst, plus f32 angles: 6e-8 of up to 90° against a width of
            // at least 0.6°, i.e. 1e-5 of the flux of the border.
            assert!((cone.total_flux() / exact - 1.0).abs() < 5e-5, "{inner} {outer}");
        }
    }

    #[test]
    fn a_narrow_cone_is_still_a_table() {
        let cone = cone_distribution(1.0, 1.0, 1.0 + 1e-9).unwrap();
        assert_eq!(cone.intensity(glam::Vec3::X), 0.0);
        assert_eq!(cone.intensity(glam::Vec3::NEG_Z), 1.0);
    }
}
