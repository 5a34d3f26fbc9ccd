//! The most even divisions of the receiving cuboid, with the data of the thesis' figures 4.7 and 4.8 as CSV.
//!
//! `cargo run --release -p keikan-sky --example optimum` (a minute). The rows of *figure 4.8* are the table in
//! `src/cuboid/optimum.rs`. n = 40 throughout; g = C_max/C_min over the elements whose middle is above the horizon.
//!
//! *Where we differ from the thesis, and why.* Its m ≈ 1.15 and φ ≈ 75° for the overcast sky are found exactly, with φ between
//! the middles of opposite edges, m the ratio of the widths, and square elements. But g is 4.0, not about 3: already on
//! the top, contributions in the middle and at the corners are as r³ · 3/(1 + 2/r), r² = 1 + 2 tan² (φ/2), which is 4.1 for
//! 75° (less for whole elements), and at other angles the sides are worse. Under the clear sky the brightest element is at the sun's
//! cusp and the darkest some 90° from it, of which no division makes less than g = 10 to 17, though it halves to quarters what
//! the overcast sky's division leaves. With the sun at 20° and below the horizon cuts through the top itself, and
//! elements at the far edge of the sides become the darkest: m rises to 1.9. Whole numbers of elements make g jagged in m and φ, so
//! that the least of a finer search lies a few per cent aside for other n.

use glam::{DVec3, Vec3};
use keikan_sky::{Distribution, Layout};

const DIVISIONS: u32 = 40;

struct Case {
    sky: Distribution,
    sun: Vec3,
}

impl Case {
    fn clear(altitude: f64) -> Self {
        let (sin, cos) = altitude.to_radians().sin_cos();
        Self { sky: Distribution::CIE_CLEAR, sun: Vec3::new(0.0, sin as f32, -cos as f32) }
    }

    fn evenness(&self, ratio: f64, opening: f64) -> f64 {
        let luminance = |d: DVec3| f64::from(self.sky.relative_luminance(d.as_vec3().normalize(), self.sun));
        Layout::new(self.sun, DIVISIONS, ratio, opening).evenness(luminance)
    }

    /// g, m and φ of the least g on a grid.
    fn least(
        &self,
        ratios: impl Iterator<Item = f64>,
        openings: impl Iterator<Item = f64> + Clone,
    ) -> [f64; 3] {
        let pairs = ratios.flat_map(|ratio| openings.clone().map(move |opening| [ratio, opening]));
        let all = pairs.map(|[ratio, opening]| [self.evenness(ratio, opening), ratio, opening]);
        all.fold([f64::INFINITY, 0.0, 0.0], |best, next| if next[0] < best[0] { next } else { best })
    }

    /// The least g: coarsely, then finely around the best.
    fn optimum(&self) -> [f64; 3] {
        let [_, ratio, opening] =
            self.least((6..=40).map(|i| 0.1 * f64::from(i)), (6..=32).map(|i| 5.0 * f64::from(i)));
        let mut best = [f64::INFINITY, ratio, opening];
        // Again until no step aside from the best is better.
        loop {
            let [_, ratio, opening] = best;
            let around = |middle: f64, step: f64| (-5..=5).map(move |i| middle + step * f64::from(i));
            let next = self.least(around(ratio, 0.02), around(opening, 1.0));
            if next[0] >= best[0] {
                return best;
            }
            best = next;
        }
    }
}

fn main() {
    let overcast = Case { sky: Distribution::MoonSpencer, sun: Vec3::Y };
    println!("# figure 4.7: g of the overcast sky");
    println!("m,phi_deg,g");
    for ratio in [0.8, 0.9, 1.0, 1.1, 1.15, 1.2, 1.3, 1.4] {
        for opening in (50..=100).step_by(5).map(f64::from) {
            println!("{ratio},{opening},{:.2}", overcast.evenness(ratio, opening));
        }
    }
    let [g, ratio, opening] = overcast.optimum();
    println!("# optimum (thesis: 1.15, 75, 3)");
    println!("{ratio:.2},{opening:.0},{g:.2}");

    println!("# figure 4.8: the clear sky");
    println!("sun_altitude_deg,m,phi_deg,g,g_with_overcast_division");
    for altitude in (0..=90).step_by(5).map(f64::from) {
        let case = Case::clear(altitude);
        let [g, m, phi] = case.optimum();
        println!("{altitude},{m:.2},{phi:.0},{g:.2},{:.2}", case.evenness(ratio, opening));
    }
}
