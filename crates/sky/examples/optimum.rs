//! The most even divisions of the receiving cuboid, with the data of the thesis' figures 4.7 and 4.8 as CSV.
//!
//! `cargo run --release -p keikan-sky --example optimum -- docs/pictures` (a minute); with a folder, both figures are drawn there
//! as `fig-4-7.svg` and `fig-4-8.svg`. The rows of *figure 4.8* are the table in
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

use std::error::Error;
use std::ops::Range;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use keikan_sky::{Distribution, Layout};
use plotters::prelude::*;

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

fn main() -> Result<(), Box<dyn Error>> {
    let overcast = Case { sky: Distribution::MoonSpencer, sun: Vec3::Y };
    println!("# figure 4.7: g of the overcast sky");
    println!("m,phi_deg,g");
    let openings = (50..=100).step_by(5).map(f64::from);
    let by_ratio: Vec<Curve> = [0.8, 0.9, 1.0, 1.15, 1.3]
        .iter()
        .map(|&ratio| {
            let points =
                openings.clone().map(|opening| (opening, overcast.evenness(ratio, opening))).collect();
            (format!("m = {ratio}"), points)
        })
        .collect();
    for (name, points) in &by_ratio {
        points.iter().for_each(|(opening, g)| println!("{},{opening},{g:.2}", &name[4..]));
    }
    let [g, ratio, opening] = overcast.optimum();
    println!("# optimum (thesis: 1.15, 75, 3)");
    println!("{ratio:.2},{opening:.0},{g:.2}");

    println!("# figure 4.8: the clear sky");
    println!("sun_altitude_deg,m,phi_deg,g,g_with_overcast_division");
    let mut clear: [Vec<(f64, f64)>; 3] = Default::default();
    for altitude in (0..=90).step_by(5).map(f64::from) {
        let case = Case::clear(altitude);
        let [g, m, phi] = case.optimum();
        println!("{altitude},{m:.2},{phi:.0},{g:.2},{:.2}", case.evenness(ratio, opening));
        [10.0 * m, phi, g].into_iter().zip(&mut clear).for_each(|(y, curve)| curve.push((altitude, y)));
    }
    let Some(folder) = std::env::args().nth(1).map(PathBuf::from) else { return Ok(()) };
    let marks = [
        (format!("our least: m = {ratio:.2}, {opening:.0}°, g = {g:.1}"), (opening, g)),
        ("the thesis': m = 1.15, 75°, g = 3".to_owned(), (75.0, 3.0)),
    ];
    let title = "Figure 4.7: g = C_max/C_min of the overcast sky";
    draw(
        &folder.join("fig-4-7.svg"),
        title,
        "opening angle of the top, degrees",
        (50.0..100.0, 0.0..16.0),
        &by_ratio,
        &marks,
    )?;
    let names = ["10 m (ratio of widths)", "opening angle, degrees", "g"];
    let curves: Vec<Curve> = names.iter().map(|name| (*name).to_owned()).zip(clear).collect();
    let title = "Figure 4.8: the most even division under the CIE's clear sky";
    draw(
        &folder.join("fig-4-8.svg"),
        title,
        "altitude of the sun, degrees",
        (0.0..90.0, 0.0..80.0),
        &curves,
        &[],
    )
}

/// A name and points.
type Curve = (String, Vec<(f64, f64)>);

fn draw(
    file: &Path,
    title: &str,
    along: &str,
    (x, y): (Range<f64>, Range<f64>),
    curves: &[Curve],
    marks: &[(String, (f64, f64))],
) -> Result<(), Box<dyn Error>> {
    let area = SVGBackend::new(file, (720, 440)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(title, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(40)
        .build_cartesian_2d(x, y)?;
    chart.configure_mesh().x_desc(along).draw()?;
    for (i, (name, points)) in curves.iter().enumerate() {
        let colour = Palette99::pick(i).to_rgba();
        let line = chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))?;
        line.label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], colour.stroke_width(2)));
    }
    for (i, (name, point)) in marks.iter().enumerate() {
        let style = if i == 0 { BLACK.filled() } else { BLACK.stroke_width(2) };
        let mark = chart.draw_series([Circle::new(*point, 5, style)])?;
        mark.label(name).legend(move |(x, y)| Circle::new((x + 10, y), 5, style));
    }
    chart.configure_series_labels().background_style(WHITE.mix(0.8)).border_style(BLACK).draw()?;
    area.present()?;
    Ok(())
}
