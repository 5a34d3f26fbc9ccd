//! Form factors of polygons of any size, near and far.

use glam::DVec3;
use radiosity::point_form_factor;

use crate::ledger::{Ledger, drawn, power};

/// By projection: even points on the triangle.
fn by_points(normal: DVec3, corners: &[DVec3; 3]) -> f64 {
    let [a, b, c] = *corners;
    let side = 200;
    let area = 0.5 * (b - a).cross(c - a);
    let mut sum = 0.0;
    for i in 0..side {
        for k in 0..side {
            let (u, v) = ((f64::from(i) + 0.5) / f64::from(side), (f64::from(k) + 0.5) / f64::from(side));
            // The square folded onto the triangle, evenly.
            let root = u.sqrt();
            let point = a * (1.0 - root) + b * (root * (1.0 - v)) + c * (root * v);
            let square = point.length_squared();
            sum += normal.dot(point).max(0.0) * area.dot(point).abs() / (square * square);
        }
    }
    sum / f64::from(side * side) / std::f64::consts::PI
}

#[test]
fn form_factors_of_points() {
    let ledger = Ledger::new("form factor");
    let corner = || proptest::array::uniform3(-1.0f64..1.0);
    let cases = (proptest::array::uniform3(corner()), -9.0f64..9.0);
    for (corners, exponent) in drawn(&cases, 400) {
        let corners = corners.map(DVec3::from);
        let found = point_form_factor(DVec3::ZERO, DVec3::Y, &corners);
        ledger.holds("within 0 and 1", (0.0..=1.0).contains(&found), corners);
        let scaled = corners.map(|corner| corner * power(exponent));
        let again = point_form_factor(DVec3::ZERO, DVec3::Y, &scaled);
        ledger.note("no matter how large and far", (again - found).abs(), 1e-12, (corners, exponent));
        let turned = point_form_factor(DVec3::ZERO, DVec3::NEG_Y, &corners);
        let [a, b, c] = corners;
        let distance = (b - a).cross(c - a).normalize_or_zero().dot(a).abs();
        if distance > 0.3 {
            // 40,000 even points of a smooth integrand; its kink at the horizon is first order in their distance.
            let truth = by_points(DVec3::Y, &corners);
            ledger.note("against points on the triangle", (found - truth).abs(), 2e-3, corners);
        }
        ledger.holds("both hemispheres see no more than one", found + turned <= 1.0 + 1e-12, corners);
    }
    ledger.close();
}
