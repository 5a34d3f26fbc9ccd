//! Where models go and how they are turned.

use glam::{DAffine3, DMat3, DVec3};

use crate::Error;
use crate::document::Spot;
use crate::file::OneOrThree;

/// From the own coordinates of a model or solid to the file's: scale, then turn, then move.
pub(crate) fn affine(
    spot: &Spot<'_>,
    position: Option<[f64; 3]>,
    rotation_given: Option<OneOrThree>,
    scale: Option<OneOrThree>,
) -> Result<DAffine3, Error> {
    let position = spot.key("position").point(position.unwrap_or_default())?;
    let turn = match rotation_given {
        None => DMat3::IDENTITY,
        Some(given) => {
            let spot = spot.key("rotation");
            let degrees = match given {
                OneOrThree::One(y) => [0.0, y, 0.0],
                OneOrThree::Three(xyz) => xyz,
            };
            for angle in degrees {
                spot.within(angle, -1e6, 1e6, "degrees")?;
            }
            rotation(degrees)
        }
    };
    let scale = match scale {
        None => DVec3::ONE,
        Some(OneOrThree::One(s)) => DVec3::splat(s),
        Some(OneOrThree::Three(xyz)) => DVec3::from_array(xyz),
    };
    // Below 1e-6 or above 1e6 the f32 coordinates of meshes and inverses lose their digits.
    if !scale.abs().to_array().iter().all(|s| (1e-6..=1e6).contains(s)) {
        let what = format!("{} is not possible: each factor must be within ±[1e-6, 1e6], not 0", show(scale));
        return Err(spot.key("scale").error(what));
    }
    Ok(DAffine3 { matrix3: turn * DMat3::from_diagonal(scale), translation: position })
}

fn show(v: DVec3) -> String {
    if v.x.to_bits() == v.y.to_bits() && v.y.to_bits() == v.z.to_bits() {
        format!("{}", v.x)
    } else {
        format!("[{}, {}, {}]", v.x, v.y, v.z)
    }
}

/// R = R_y R_x R_z, angles in degrees about the world's axes, counter-clockwise for who looks against the
/// axis: first about z (roll), then about x (pitch), last about the vertical y (heading).
pub(crate) fn rotation(degrees: [f64; 3]) -> DMat3 {
    // Quarter turns come out exact: boxes stay axis-aligned.
    let about = |degrees: f64| -> (f64, f64) {
        match degrees.rem_euclid(360.0) {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            other => other.to_radians().sin_cos(),
        }
    };
    let [(sx, cx), (sy, cy), (sz, cz)] = degrees.map(about);
    let x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cx, sx), DVec3::new(0.0, -sx, cx));
    let y = DMat3::from_cols(DVec3::new(cy, 0.0, -sy), DVec3::Y, DVec3::new(sy, 0.0, cy));
    let z = DMat3::from_cols(DVec3::new(cz, sz, 0.0), DVec3::new(-sz, cz, 0.0), DVec3::Z);
    y * x * z
}

/// A rotation whose −Z is the unit vector `axis`, and whose +Y is as near `up` as can be; where the axis is
/// parallel to `up`, +Y is as near −Z as can be (or +Z for a horizontal `up` along −Z).
///
/// Columns: right (+X), up (+Y), backward (+Z): a camera, or a lamp with its C = 0 at +X.
pub(crate) fn look_along(axis: DVec3, up: DVec3) -> DMat3 {
    let back = -axis;
    // Within a hundred-millionth of parallel the cross product is rounding.
    let aside = |up: DVec3| Some(up.cross(back)).filter(|right| right.length() > 1e-8)?.try_normalize();
    let right = aside(up).or_else(|| aside(DVec3::NEG_Z)).or_else(|| aside(DVec3::Y)).unwrap_or(DVec3::X);
    DMat3::from_cols(right, back.cross(right), back)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_order_of_rotations_is_z_then_x_then_y() {
        // A beam along +X: 90° about z stands it up (+Y), 90° about x lays it along +Z, 90° about y turns
        // it to +X again.
        let v = DVec3::X;
        assert_eq!(rotation([0.0, 0.0, 90.0]) * v, DVec3::Y);
        assert_eq!(rotation([90.0, 0.0, 90.0]) * v, DVec3::Z);
        assert_eq!(rotation([90.0, 90.0, 90.0]) * v, DVec3::X);
    }

    #[test]
    fn turning_about_the_vertical_is_counter_clockwise_seen_from_above() {
        // North (−Z) goes west (−X).
        assert_eq!(rotation([0.0, 90.0, 0.0]) * DVec3::NEG_Z, DVec3::NEG_X);
    }

    #[test]
    fn looking_straight_down_has_north_up() {
        let frame = look_along(DVec3::NEG_Y, DVec3::Y);
        assert_eq!(frame, DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y));
    }

    proptest! {
        #[test]
        fn frames_are_rotations(x in -1.0..1.0f64, y in -1.0..1.0f64, z in -1.0..1.0f64, turn in [-720.0..720.0f64, -720.0..720.0, -720.0..720.0]) {
            // Each entry is a sum of three products of numbers ≤ 1, each off by a few roundings; the cross
            // product of look_along is divided by at least 1e-8.
            let axis = DVec3::new(x, y, z).try_normalize().unwrap_or(DVec3::X);
            for (frame, bound) in [(rotation(turn), 16.0 * f64::EPSILON), (look_along(axis, DVec3::Y), 1e-7)] {
                let off = frame * frame.transpose() - DMat3::IDENTITY;
                prop_assert!(off.to_cols_array().iter().all(|e| e.abs() < bound));
                prop_assert!((frame.determinant() - 1.0).abs() < bound);
            }
            prop_assert!((look_along(axis, DVec3::Y) * DVec3::NEG_Z - axis).length() < 4.0 * f64::EPSILON);
        }
    }
}
