//! Fresnel and Snell: closed forms, published figures, and laws over the whole range.

use glam::DVec3;
use keikan_light::interface::{fresnel, reflect, refract};
use proptest::prelude::*;

/// Unit round-off of f64, the unit of the bounds below.
const U: f64 = f64::EPSILON * 0.5;

/// Thesis eq. 3.3 as printed: tan² and sin² of sums and differences; 0/0 head on.
fn printed(eta: f64, theta: f64) -> f64 {
    let inside = (theta.sin() / eta).asin();
    let (d, s) = (theta - inside, theta + inside);
    0.5 * ((d.tan() / s.tan()).powi(2) + (d.sin() / s.sin()).powi(2))
}

#[test]
fn head_on_and_grazing_are_exact() {
    for eta in [1.0001, 1.33, 1.5, 2.4] {
        let expected: f64 = ((eta - 1.0) / (eta + 1.0)) * ((eta - 1.0) / (eta + 1.0));
        // g = √((η−1)(η+1) + 1) carries about 2 roundings into a difference with 1: relative 4u η/(η−1), squared.
        assert!((fresnel(eta, 1.0) - expected).abs() <= 16.0 * U * eta / (eta - 1.0) * expected);
        assert_eq!(fresnel(eta, 0.0), 1.0);
        assert_eq!(fresnel(1.0 / eta, 0.0), 1.0);
    }
    assert_eq!(fresnel(1.0, 0.3), 0.0);
}

#[test]
fn water_at_tabulated_angles() {
    // n = 1.34, unpolarised; computed by hand from the two Fresnel coefficients (r_s², r_p²) at 60°:
    // sin θ' = 0.86603/1.34 = 0.64629, cos θ' = 0.76310; r_s = (0.5 − 1.02255)/(0.5 + 1.02255) = −0.34321;
    // r_p = (0.67 − 0.76310)/(0.67 + 0.76310) = −0.06496; α = ½(0.11779 + 0.00422) = 0.06101.
    // Five digits by hand: the result is good to one unit of the fifth.
    assert!((fresnel(1.34, 60f64.to_radians().cos()) - 0.06101).abs() < 1e-5);
    // Brewster's angle: only r_s is left, ½ ((η²−1)/(η²+1))².
    let eta: f64 = 1.34;
    let at_brewster = 0.5 * ((eta * eta - 1.0) / (eta * eta + 1.0)).powi(2);
    assert!((fresnel(eta, eta.atan().cos()) - at_brewster).abs() < 32.0 * U);
}

proptest! {
    #[test]
    fn agrees_with_the_printed_form_where_that_is_stable(eta in 1.05f64..2.5, theta in 0.05f64..1.5) {
        // The printed form subtracts angles: its own relative error is about 8u/(θ−θ').
        let bound = 64.0 * U / (theta - (theta.sin() / eta).asin());
        prop_assert!((fresnel(eta, theta.cos()) - printed(eta, theta)).abs() <= bound);
    }

    #[test]
    fn a_share_and_the_same_from_both_sides(eta in 1.0f64..3.0, theta in 0.0f64..std::f64::consts::FRAC_PI_2) {
        let from_air = fresnel(eta, theta.cos());
        prop_assert!((0.0..=1.0).contains(&from_air));
        // Stokes reciprocity: the refracted angle on the other side reflects as much. Near grazing,
        // dα/dcosθ is bounded by about 4(η²+1), and cos θ' is right to a few u / cos θ'.
        let inside = (1.0 - (theta.sin() / eta).powi(2)).sqrt();
        let bound = 64.0 * U * (eta * eta + 1.0) / theta.cos().max(1e-8);
        prop_assert!((fresnel(1.0 / eta, inside) - from_air).abs() <= bound);
    }

    #[test]
    fn rises_towards_grazing(eta in 1.0f64..3.0, a in 0.0f64..1.0, b in 0.0f64..1.0) {
        // From air, α falls up to Brewster only in one polarisation; the mean of both is monotone up to η ≈ 2.4
        // where Brewster's dip shows. So the law is stated for s-polarisation's bound: α ≥ ½ r_s².
        let cos = a.min(b);
        let g = ((eta - 1.0) * (eta + 1.0) + cos * cos).sqrt();
        prop_assert!(fresnel(eta, cos) >= 0.5 * ((cos - g) / (cos + g)).powi(2) - 4.0 * U);
    }

    #[test]
    fn snell_holds_and_turns_back(eta in 0.4f64..2.5, theta in 0.0f64..std::f64::consts::FRAC_PI_2, turn in 0.0f64..std::f64::consts::TAU) {
        let normal = DVec3::Y;
        let direction = DVec3::new(theta.sin() * turn.cos(), -theta.cos(), theta.sin() * turn.sin());
        let Some(inside) = refract(direction, normal, eta) else {
            // Total reflection only beyond the critical angle (with a rounding's slack).
            prop_assert!(theta.sin() > eta * (1.0 - 8.0 * U));
            return Ok(());
        };
        prop_assert!((inside.length() - 1.0).abs() <= 4.0 * U);
        let sine = inside.reject_from_normalized(normal).length();
        prop_assert!((sine * eta - theta.sin()).abs() <= 16.0 * U * eta.max(1.0));
        // Walked backwards, light leaves as it came; the cosine outside is a square root of a difference:
        // its error is u / cos θ.
        if let Some(back) = refract(-inside, -normal, 1.0 / eta) {
            prop_assert!((back + direction).length() <= 64.0 * U / theta.cos().max(1e-7) * eta.max(1.0 / eta));
        }
    }

    #[test]
    fn mirrors_mirror(x in -1.0f64..1.0, y in -1.0f64..1.0, z in -1.0f64..1.0) {
        let way = DVec3::new(x, y, z);
        let normal = DVec3::new(0.6, 0.0, 0.8);
        prop_assert!((reflect(reflect(way, normal), normal) - way).length() <= 32.0 * U * way.length());
        prop_assert!((reflect(way, normal).dot(normal) + way.dot(normal)).abs() <= 16.0 * U * way.length());
    }
}
