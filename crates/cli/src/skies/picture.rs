//! The whole sky on a disc: north up, east left, as it is seen looking up.

use std::f64::consts::FRAC_PI_2;

use light::{Film, Layer, Spectrum};
use rayon::prelude::*;
use scene::Scene;

use super::direction;
use crate::args::{Projection, Sky};
use crate::assemble::OpenSky;
use crate::output::{self, Picture};
use crate::publish::{Content, Unit};

/// The picture and what it is; black outside the disc. `largest` is what relative luminances are shares of \[cd/m²\].
pub(super) fn draw(args: &Sky, scene: &Scene, sky: &OpenSky, largest: f32) -> (Vec<Picture>, Content) {
    let size = args.size;
    let (unit, factor) = match args.relative && largest > 0.0 {
        true => (Unit::Share(largest), 1.0 / largest),
        false => (Unit::Luminance, 1.0),
    };
    let pixel = |at: u32| {
        let centre = |index: u32| (f64::from(index) + 0.5) * 2.0 / f64::from(size) - 1.0;
        match altitude_azimuth(args.projection, centre(at % size), -centre(at / size)) {
            Some([altitude, azimuth]) => sky.radiance(direction(scene, altitude, azimuth)) * factor,
            None => Spectrum::ZERO,
        }
    };
    let pixels: Vec<Spectrum> = (0..size * size).into_par_iter().map(pixel).collect();
    let film = Film { width: size, height: size, layers: vec![Layer { name: String::new(), pixels }] };
    let projection = match args.projection {
        Projection::Angular => "equidistant fisheye, radius proportional to the angle from the zenith",
        Projection::Horizontal => "orthographic, projected straight down onto the ground plane",
    };
    let what = format!(
        "the sky looking up, without the sun's disc: {projection}; the disc of the horizon touches the frame; north up, east left"
    );
    (output::develop(&film), Content { what, unit })
}

/// Altitude and azimuth in degrees of a point `right` and `up` of the middle, where the horizon is at 1; none beyond it.
fn altitude_azimuth(projection: Projection, right: f64, up: f64) -> Option<[f64; 2]> {
    let radius = right.hypot(up);
    if radius > 1.0 {
        return None;
    }
    let altitude = match projection {
        Projection::Angular => FRAC_PI_2 * (1.0 - radius),
        Projection::Horizontal => radius.acos(),
    };
    // Looking up with north above, east is on the left.
    let azimuth = (-right).atan2(up);
    Some([altitude, azimuth].map(f64::to_degrees))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn north_is_up_and_east_is_left() {
        let near = |found: Option<[f64; 2]>, [altitude, azimuth]: [f64; 2]| {
            // Functions of f64, and radians to degrees: a few units of 1e-14.
            found.is_some_and(|[h, a]| (h - altitude).abs() < 1e-12 && (a - azimuth).abs() < 1e-12)
        };
        let angular = |right, up| altitude_azimuth(Projection::Angular, right, up);
        assert!(near(angular(0.0, 0.5), [45.0, 0.0]));
        assert!(near(angular(-0.5, 0.0), [45.0, 90.0]));
        assert!(near(angular(0.25, 0.0), [67.5, -90.0]));
        assert!(near(angular(-0.6, -0.8), [0.0, 90.0 + 0.8_f64.atan2(0.6).to_degrees()]));
        let horizontal = |right, up| altitude_azimuth(Projection::Horizontal, right, up);
        assert!(near(horizontal(-0.5, 0.0), [60.0, 90.0]));
        assert_eq!([angular(0.8, 0.8), horizontal(1.0, 0.1)], [None, None]);
    }
}
