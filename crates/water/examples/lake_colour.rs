//! One page: what every named water does to light, and the colour it has by itself under daylight.
//!
//! `cargo run --release -p keikan-water --example lake_colour -- [--secchi M] [--chlorophyll MG_M3]`. Colours are sRGB of
//! R∞ (see `Water::deep_reflectance`) lit by D65, once as dark as it is, once with the largest component made 1.

use keikan_water::quality::names;
use keikan_water::{Loss, Water};
use light::Spectrum;
use light::colour::{D65, encode_srgb, srgb_from_xyz};

/// `#rrggbb` of linear sRGB; what lies outside the gamut is cut off.
fn hex(rgb: [f32; 3]) -> String {
    let byte = |x: f32| (255.0 * encode_srgb(x.clamp(0.0, 1.0))).round() as u8;
    rgb.iter().fold("#".to_owned(), |text, x| text + &format!("{:02x}", byte(*x)))
}

fn print(name: &str, water: &Water) {
    let at = |spectrum: Spectrum| [1, 3, 6].map(|band| spectrum[band]);
    let [blue, green, red] = at(water.reach(Loss::Diffuse));
    let [albedo_blue, albedo_green, albedo_red] = at(water.albedo());
    let xyz = (water.deep_reflectance() * D65).xyz();
    let rgb = srgb_from_xyz(xyz).to_array();
    let largest = rgb.into_iter().fold(f32::MIN_POSITIVE, f32::max);
    println!(
        "{name:14} {blue:7.2} {green:7.2} {red:6.2} | {albedo_blue:.2} {albedo_green:.2} {albedo_red:.2} | {:6.1} | {:6.2} | {} {}",
        water.secchi_depth(),
        100.0 * xyz.y,
        hex(rgb),
        hex(rgb.map(|x| x / largest)),
    );
}

fn main() -> Result<(), keikan_water::QualityError> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    println!(
        "               1/e of diffuse light [m]| albedo b/c     | Secchi |  R∞    | colour, the same made bright"
    );
    println!("water             464 nm  536 nm 633 nm | 464  536  633  |   [m]  |  [%]   |");
    for name in names() {
        print(name, &Water::named(name)?);
    }
    for pair in arguments.windows(2) {
        let number = pair[1].parse().unwrap_or(f64::NAN);
        match pair[0].as_str() {
            "--secchi" => print(&format!("{number} m"), &Water::of_secchi_depth(number)?),
            "--chlorophyll" => print(&format!("{number} mg/m³"), &Water::of_chlorophyll(number)?),
            _ => {}
        }
    }
    Ok(())
}
