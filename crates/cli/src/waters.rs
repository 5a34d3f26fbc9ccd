//! `keikan water`: what a water does to light, in numbers and colours.

use std::fmt;
use std::path::Path;

use light::Spectrum;
use light::bands::{BANDS, WAVELENGTHS_NM};
use light::colour::{D65, encode_srgb, srgb_from_xyz};
use scene::WaterQuality;

use crate::Error;
use crate::args;
use crate::assemble::{Optics, water_names};
use crate::command::{load, pretty, say, warn};

/// Depths of a white bottom whose colours are shown \[m\].
const DEPTHS: [f64; 6] = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0];

/// Bands that a list of waters shows: blue, green, red.
const LISTED: [usize; 3] = [1, 3, 6];

/// Shows waters.
///
/// # Errors
/// A water that there is not.
pub(crate) fn run(args: &args::Water, json: bool) -> Result<(), Error> {
    let reports = reports(args)?;
    let text = match (json, args.water.is_some() || reports.len() == 1) {
        (true, _) => pretty(&reports),
        (_, true) => reports.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n"),
        _ => list(&reports),
    };
    say(&text)
}

fn reports(args: &args::Water) -> Result<Vec<Report>, Error> {
    let one = |name: String, quality| Ok(vec![Report::new(name, &Optics::of(&quality)?)]);
    match (&args.water, args.secchi, args.chlorophyll) {
        (Some(file), ..) if file.ends_with(".toml") => {
            let scene = load(Some(Path::new(file)))?;
            warn(&scene);
            if scene.waters.is_empty() {
                return Err(Error::Usage(format!("{file} has no [[water]]")));
            }
            let report =
                |water: &scene::Water| Ok(Report::new(water.name.clone(), &Optics::of_scene(water)?));
            scene.waters.iter().map(report).collect()
        }
        (Some(name), ..) => one(name.clone(), WaterQuality::Named(name.clone())),
        (_, Some(depth), _) => one(format!("Secchi depth {depth} m"), WaterQuality::Secchi(depth)),
        (.., Some(mg)) => one(format!("chlorophyll {mg} mg/m³"), WaterQuality::Chlorophyll(mg)),
        _ => water_names()
            .map(|name| Ok(Report::new(name.to_owned(), &Optics::of(&WaterQuality::Named(name.to_owned()))?)))
            .collect(),
    }
}

/// The answer for one water. Lengths are infinite, and null in JSON, where nothing is lost.
#[derive(Clone, Debug, serde::Serialize)]
struct Report {
    name: String,
    index: f64,
    critical_angle_deg: f64,
    secchi_depth_m: f64,
    /// Middles of the bands.
    wavelengths_nm: [f64; BANDS],
    rows: Vec<Row>,
    colours: Vec<Colour>,
    /// Of the rows, those that a list of many waters shows: b/c, and 1/e of daylight \[m\].
    #[serde(skip)]
    listed: [Spectrum; 2],
}

/// A number for each band.
#[derive(Clone, Debug, serde::Serialize)]
struct Row {
    what: &'static str,
    unit: &'static str,
    values: [f32; BANDS],
}

/// The colour of the water under daylight (D65) over a white bottom, as just under the surface.
#[derive(Clone, Debug, serde::Serialize)]
struct Colour {
    /// None = no bottom.
    depth_m: Option<f64>,
    /// Luminous reflectance, 0 to 1.
    reflectance: f32,
    /// `#rrggbb` of a perfect white being #ffffff.
    srgb: String,
    /// The same as bright as sRGB can show it.
    bright: String,
}

impl Report {
    fn new(name: String, optics: &Optics) -> Self {
        let (albedo, [image, daylight]) = (optics.albedo(), optics.reaches());
        let coefficients = optics.coefficients().map(|(what, k)| (what, "1/m", k));
        let rows = coefficients.into_iter().chain([
            ("albedo b/c", "", albedo),
            ("1/e of an image (c)", "m", image),
            ("1/e of daylight (Kd)", "m", daylight),
        ]);
        let depths = DEPTHS.into_iter().map(Some).chain([None]);
        Self {
            name,
            index: optics.index(),
            critical_angle_deg: optics.critical_angle().to_degrees(),
            secchi_depth_m: optics.secchi_depth(),
            wavelengths_nm: WAVELENGTHS_NM,
            rows: rows.map(|(what, unit, values)| Row { what, unit, values: values.0 }).collect(),
            colours: depths.map(|depth| Colour::new(optics, depth)).collect(),
            listed: [albedo, daylight],
        }
    }
}

impl Colour {
    fn new(optics: &Optics, depth_m: Option<f64>) -> Self {
        let reflected = optics.reflectance(Spectrum::ONE, depth_m.unwrap_or(f64::INFINITY));
        let xyz = (reflected * D65).xyz() / D65.xyz().y;
        let rgb = srgb_from_xyz(xyz).to_array();
        let largest = rgb.into_iter().fold(f32::MIN_POSITIVE, f32::max);
        let bright = hex(rgb.map(|x| x / largest));
        Self { depth_m, reflectance: xyz.y, srgb: hex(rgb), bright }
    }
}

/// `#rrggbb` of linear sRGB; what lies outside the gamut is cut off.
fn hex(rgb: [f32; 3]) -> String {
    let byte = |x: f32| (255.0 * encode_srgb(x.clamp(0.0, 1.0))).round() as u8;
    rgb.iter().fold("#".to_owned(), |text, x| text + &format!("{:02x}", byte(*x)))
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: index {:.4}, critical angle {:.2}°, Secchi depth {}",
            self.name,
            self.index,
            self.critical_angle_deg,
            length(self.secchi_depth_m)
        )?;
        write!(f, "{:28}", "")?;
        self.wavelengths_nm.iter().try_for_each(|nm| write!(f, "{:>9}", format!("{nm:.0} nm")))?;
        for row in &self.rows {
            let unit = if row.unit.is_empty() { String::new() } else { format!(" [{}]", row.unit) };
            write!(f, "\n{:28}", format!("{}{unit}", row.what))?;
            row.values.iter().try_for_each(|value| write!(f, "{:>9}", number(*value)))?;
        }
        write!(
            f,
            "\nunder daylight (D65), as just under the surface: reflectance, colour, the same made bright"
        )?;
        for colour in &self.colours {
            let over =
                colour.depth_m.map_or("no bottom".to_owned(), |depth| format!("white bottom at {depth} m"));
            write!(
                f,
                "\n  {over:24} {:6.2} %  {}  {}",
                100.0 * colour.reflectance,
                colour.srgb,
                colour.bright
            )?;
        }
        Ok(())
    }
}

/// Four digits, whatever the size.
fn number(value: f32) -> String {
    match value.abs() {
        _ if !value.is_finite() => "inf".to_owned(),
        0.0 => "0".to_owned(),
        size if size < 1e-3 => format!("{value:.1e}"),
        size if size < 10.0 => format!("{value:.4}"),
        size if size < 1e4 => format!("{value:.1}"),
        _ => format!("{value:.1e}"),
    }
}

fn length(metres: f64) -> String {
    if metres.is_finite() { format!("{metres:.1} m") } else { "infinite".to_owned() }
}

/// A line for each water.
fn list(reports: &[Report]) -> String {
    let mut text = format!(
        "{:13} {:>6} {:>9}  {:^23}  {:^17}  {:>6}  {:7}  {:7}",
        "", "index", "Secchi", "1/e of daylight [m]", "b/c", "R∞", "colour", "bright"
    );
    let [blue, green, red] = LISTED.map(|band| format!("{:.0} nm", WAVELENGTHS_NM[band]));
    let [b, g, r] = LISTED.map(|band| format!("{:.0}", WAVELENGTHS_NM[band]));
    text += &format!("\n{:30}  {blue:>7} {green:>7} {red:>7}  {b:>5} {g:>5} {r:>5}", "");
    for report in reports {
        let [albedo, daylight] = report.listed;
        let [blue, green, red] = LISTED.map(|band| number(daylight[band]));
        let [b, g, r] = LISTED.map(|band| albedo[band]);
        let deep = report.colours.last();
        let (reflectance, srgb, bright) =
            deep.map_or((0.0, "", ""), |deep| (deep.reflectance, deep.srgb.as_str(), deep.bright.as_str()));
        text += &format!(
            "\n{:13} {:6.4} {:>9}  {blue:>7} {green:>7} {red:>7}  {b:5.2} {g:5.2} {r:5.2}  {:5.2}%  {srgb}  {bright}",
            report.name,
            report.index,
            length(report.secchi_depth_m),
            100.0 * reflectance,
        );
    }
    text
}
