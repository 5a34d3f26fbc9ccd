//! Photometric files: what is written is read back, symmetric files equal their expansion, fluxes are those
//! of closed forms, and no input breaks the readers.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

use glam::Vec3;
use keikan_scene::photometry::{self, Photometry, Shape};
use proptest::prelude::*;

/// A lamp by the angles of its file.
#[derive(Clone, Debug)]
struct Lamp {
    /// 1 is type C, 2 B, 3 A.
    kind: u8,
    horizontal: Vec<f32>,
    vertical: Vec<f32>,
    /// Vertical angles running fastest.
    candela: Vec<f32>,
}

impl Lamp {
    fn new(kind: u8, horizontal: Vec<f32>, vertical: Vec<f32>, candela: impl Fn(f32, f32) -> f32) -> Self {
        let nodes = horizontal.iter().flat_map(|&h| vertical.iter().map(move |&v| (h, v)));
        let candela = nodes.map(|(h, v)| candela(h, v)).collect();
        Self { kind, horizontal, vertical, candela }
    }

    /// The smallest LM-63 file of it, ten numbers a line.
    fn ies(&self, first_line: &str, factors: [f64; 3]) -> String {
        let [multiplier, ballast, second] = factors;
        let (verticals, horizontals) = (self.vertical.len(), self.horizontal.len());
        let mut text = format!("{first_line}\n[LUMINAIRE] Lamp\nTILT=NONE\n");
        let _ = writeln!(text, "1 -1 {multiplier} {verticals} {horizontals} {} 2 0.2 0.4 0", self.kind);
        let _ = writeln!(text, "{ballast} {second} 15");
        for list in [&self.vertical, &self.horizontal, &self.candela] {
            for line in list.chunks(10) {
                let line: Vec<String> = line.iter().map(f32::to_string).collect();
                let _ = writeln!(text, "{}", line.join(" "));
            }
        }
        text
    }

    /// The EULUMDAT file of it: `all` C planes are named, those of the lamp tabulated.
    fn ldt(&self, isym: u8, all: &[f32], lamps: i32, lumens: f64, conversion: f64) -> String {
        let mut text = format!("Company\n1\n{isym}\n{}\n0\n{}\n0\n", all.len(), self.vertical.len());
        text += "report\nLamp\nnumber\nfile\ndate\n1200\n300\n80\n1100\n200\n10\n20\n0\n0\n100\n100\n";
        let _ = write!(text, "{conversion}\n0\n1\n{lamps}\nLED\n{lumens}\n3000 K\n80\n25,5\n");
        text += &"0.5\n".repeat(10);
        for number in all.iter().chain(&self.vertical).chain(&self.candela) {
            let _ = writeln!(text, "{number}");
        }
        text
    }
}

fn parse(text: &str) -> Photometry {
    photometry::parse(text.as_bytes(), Path::new("test")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn error(text: &str) -> String {
    let result = photometry::parse(text.as_bytes(), Path::new("test.ies"));
    result.map_or_else(|error| error.to_string(), |lamp| panic!("read: {lamp:?}"))
}

/// `from`, `from` + `step`, … up to `to`.
fn angles(from: f32, to: f32, step: f32) -> Vec<f32> {
    (0..=((to - from) / step).round() as usize).map(|i| from + i as f32 * step).collect()
}

/// The direction at C and γ \[degrees\] in a luminaire's frame.
fn direction(c: f64, gamma: f64) -> Vec3 {
    let ((sin_c, cos_c), (sin, cos)) = (c.to_radians().sin_cos(), gamma.to_radians().sin_cos());
    Vec3::new((sin * cos_c) as f32, (sin * sin_c) as f32, -cos as f32)
}

/// What reading back may change at a direction: an f32 direction and its atan2 lose at most 4 roundings of
/// 2⁻²⁴ rad in each angle, over which I changes by peak per `step` \[degrees\]; the products by the
/// multipliers lose 3 roundings more.
fn read_back_bound(peak: f32, step: f32) -> f32 {
    let rounding = 2.0_f32.powi(-24);
    peak * (3.0 * rounding + 2.0 * (4.0 * rounding).to_degrees() / step + 4.0 * 360.0 * rounding / step)
}

const OLD: &str = "IESNA91";
const NEW: &str = "IESNA:LM-63-2002";

#[test]
fn real_files() {
    let Some(assets) = std::env::var_os("KEIKAN_ASSETS") else {
        println!("skipped: KEIKAN_ASSETS names no folder with photometry/ies and photometry/ldt");
        return;
    };
    let mut count = 0;
    for folder in ["ies", "ldt"] {
        for file in std::fs::read_dir(Path::new(&assets).join("photometry").join(folder)).expect("the folder")
        {
            let path = file.expect("an entry").path();
            let lamp = photometry::read(&path).unwrap_or_else(|error| panic!("{error}"));
            println!("{}: {:.1} lm, {:?}, {:?}", path.display(), lamp.flux, lamp.opening, lamp.warnings);
            // All are made-up lamps of the same middling beam; the lopsided ones add up to 1000 cd to it.
            assert!(lamp.flux > 400.0 && lamp.flux < 4000.0, "{}", lamp.flux);
            assert_eq!(lamp.watts, Some(15.0));
            // Midpoint rule, h = π/200, of I sin γ, linear in I between corners: h²/24 · π · max|2 I′ + I|
            // per unit of C, I′ ≤ 372 cd in 2.5° × their scale peak/2200, and I ≤ peak; over 2π of C. A cliff
            // at γ = 90° lies on a zone's edge.
            let (h, peak) = (PI / 200.0, f64::from(lamp.distribution.peak()));
            let slope = 372.0 / 2200.0 * peak / 2.5_f64.to_radians();
            let bound = 2.0 * PI * PI * h * h / 24.0 * (2.0 * slope + peak);
            assert!((lamp.distribution.flux(200) - lamp.flux).abs() < bound, "{} ± {bound}", lamp.flux);
            count += 1;
        }
    }
    assert!(count > 0);
}

proptest! {
    #[test]
    fn lm63_is_read_back(
        planes in 1_usize..9, zones in 1_usize..12, seed in any::<u32>(),
        multiplier in 0.01_f64..100.0, ballast in 0.5_f64..1.5, second in 0.5_f64..1.5,
    ) {
        let noise = |c: f32, g: f32| ((c * 12.9 + g * 78.2 + seed as f32 * 1e-4).sin() * 43_758.5).fract().abs();
        let c = if planes == 1 { vec![0.0] } else { angles(0.0, 360.0, 360.0 / planes as f32) };
        let lamp = Lamp::new(1, c, angles(0.0, 180.0, 180.0 / zones as f32), |c, g| noise(c % 360.0, g));
        for (edition, factor) in [(OLD, multiplier * ballast * second), (NEW, multiplier * ballast)] {
            let read = parse(&lamp.ies(edition, [multiplier, ballast, second]));
            let step = (180.0 / zones as f32).min(360.0 / planes as f32);
            let bound = read_back_bound(read.distribution.peak(), step);
            for (p, &c) in lamp.horizontal.iter().enumerate() {
                for (z, &g) in lamp.vertical.iter().enumerate().filter(|(_, g)| **g > 0.0 && **g < 180.0) {
                    let expected = (f64::from(lamp.candela[p * lamp.vertical.len() + z]) * factor) as f32;
                    let found = read.distribution.intensity(direction(c.into(), g.into()));
                    prop_assert!((found - expected).abs() <= bound, "C {c}, γ {g}: {found}, not {expected}");
                }
            }
        }
    }

    #[test]
    fn eulumdat_is_read_back(
        planes in 2_usize..9, zones in 1_usize..12, seed in any::<u32>(),
        lumens in 10.0_f64..1e5, conversion in 0.5_f64..2.0,
    ) {
        let noise = |c: f32, g: f32| ((c * 12.9 + g * 78.2 + seed as f32 * 1e-4).sin() * 43_758.5).fract().abs();
        let step = 360.0 / planes as f32;
        let lamp = Lamp::new(1, angles(0.0, 360.0 - step, step), angles(0.0, 180.0, 180.0 / zones as f32), noise);
        let text = lamp.ldt(0, &lamp.horizontal, 1, lumens, conversion);
        let comma = text.replace('.', ",");
        prop_assert_eq!(&parse(&text).distribution, &parse(&comma).distribution);
        let read = parse(&text);
        let bound = read_back_bound(read.distribution.peak(), step.min(180.0 / zones as f32));
        for (p, &c) in lamp.horizontal.iter().enumerate() {
            for (z, &g) in lamp.vertical.iter().enumerate().filter(|(_, g)| **g > 0.0 && **g < 180.0) {
                let table = f64::from(lamp.candela[p * lamp.vertical.len() + z]);
                let expected = (table * conversion * lumens / 1000.0) as f32;
                // The file's C90 is the length, our C = 0.
                let found = read.distribution.intensity(direction(f64::from(c) - 90.0, g.into()));
                prop_assert!((found - expected).abs() <= bound, "C {c}, γ {g}: {found}, not {expected}");
            }
        }
    }

    #[test]
    fn broken_files_never_panic(
        which in 0_usize..5, cut in 0.0_f64..1.0,
        edits in prop::collection::vec((0.0_f64..1.0, any::<u8>()), 0..8),
        splice in prop::option::of((0.0_f64..1.0, prop::sample::select(vec![
            "nan", "inf", "-1", "1e999", "99999999999", "", "\n\n", ",,,", "\u{0}", "\u{fe}\u{ff}", "TILT=", "1e38", "-1e-9",
        ]))),
    ) {
        let square = Lamp::new(1, angles(0.0, 360.0, 90.0), angles(0.0, 180.0, 30.0), |c, g| c + g);
        let side = Lamp::new(2, angles(-90.0, 90.0, 45.0), angles(-90.0, 90.0, 45.0), |h, v| 200.0 - h - v);
        let tilted = square.ies(NEW, [1.0; 3]).replace("TILT=NONE", "TILT=INCLUDE\n1\n3\n0 90 180\n1 0.9 0.8");
        let ring = Lamp { horizontal: angles(0.0, 270.0, 90.0), ..square.clone() };
        let files = [
            square.ies(NEW, [1.0; 3]), side.ies(OLD, [1.0; 3]), Lamp { kind: 3, ..side }.ies(NEW, [1.0; 3]),
            tilted, ring.ldt(0, &ring.horizontal, -1, 1000.0, 1.0),
        ];
        let mut bytes = files[which].clone().into_bytes();
        for (place, byte) in edits {
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] = byte;
        }
        if let Some((place, word)) = splice {
            let at = (place * bytes.len() as f64) as usize;
            bytes.splice(at..at, word.bytes());
        }
        if cut < 0.9 {
            bytes.truncate((cut / 0.9 * bytes.len() as f64) as usize);
        }
        for name in ["x.ies", "x.ldt", "x"] {
            if let Ok(lamp) = photometry::parse(&bytes, Path::new(name)) {
                prop_assert!(lamp.flux.is_finite() && lamp.flux >= 0.0);
                prop_assert!(lamp.distribution.intensity(Vec3::NEG_Z).is_finite());
            }
        }
    }

    #[test]
    fn mirrored_lamps_are_mirrors(c in 0.0_f64..360.0, gamma in 0.0_f64..180.0) {
        let part = |from, to| Lamp::new(1, angles(from, to, 11.25), angles(0.0, 180.0, 7.5), |c, g| c * 3.0 + g);
        let quadrants = parse(&part(0.0, 90.0).ies(NEW, [1.0; 3])).distribution;
        let (along, across) = (part(0.0, 180.0), part(90.0, 270.0));
        let along = parse(&along.ies(NEW, [1.0; 3])).distribution;
        let across = parse(&across.ies(NEW, [1.0; 3])).distribution;
        let d = direction(c, gamma);
        let (flip_y, flip_x) = (Vec3::new(d.x, -d.y, d.z), Vec3::new(-d.x, d.y, d.z));
        for (lamp, mirror) in [(&quadrants, flip_x), (&quadrants, flip_y), (&along, flip_y), (&across, flip_x)] {
            let bound = 2.0 * read_back_bound(lamp.peak(), 7.5);
            prop_assert!((lamp.intensity(d) - lamp.intensity(mirror)).abs() <= bound);
        }
    }
}

#[test]
fn symmetric_files_equal_their_expansion() {
    // Angles that are exact in f32, so that the mirrored tables are the same to the bit.
    let gamma = angles(0.0, 180.0, 22.5);
    let whole = |candela: fn(f32) -> f32| {
        let lamp = Lamp::new(1, angles(0.0, 360.0, 22.5), gamma.clone(), move |c, g| candela(c) + g);
        parse(&lamp.ies(NEW, [1.0; 3])).distribution
    };
    let part = |from, to, candela: fn(f32) -> f32| {
        let lamp = Lamp::new(1, angles(from, to, 22.5), gamma.clone(), move |c, g| candela(c) + g);
        parse(&lamp.ies(NEW, [1.0; 3])).distribution
    };
    let quadrant: fn(f32) -> f32 = |c| (c % 180.0).min(180.0 - c % 180.0);
    let along: fn(f32) -> f32 = |c| c.min(360.0 - c).powi(2);
    let across: fn(f32) -> f32 = |c| (c - 90.0).abs().min(450.0 - c).min(c + 270.0) + 1.0;
    assert_eq!(whole(quadrant), part(0.0, 90.0, quadrant));
    assert_eq!(whole(along), part(0.0, 180.0, along));
    assert_eq!(whole(across), part(90.0, 270.0, across));
}

#[test]
fn symmetric_eulumdat_equals_its_expansion() {
    let all = angles(0.0, 345.0, 15.0);
    let gamma = angles(0.0, 90.0, 10.0);
    let read = |isym, c: Vec<f32>, candela: fn(f32) -> f32| {
        let lamp = Lamp::new(1, c, gamma.clone(), move |c, g| candela(c) + g);
        parse(&lamp.ldt(isym, &all, 1, 1000.0, 1.0)).distribution
    };
    let quadrant: fn(f32) -> f32 = |c| (c % 180.0).min(180.0 - c % 180.0);
    let along: fn(f32) -> f32 = |c| c.min(360.0 - c).powi(2);
    let across: fn(f32) -> f32 = |c| (c - 90.0).abs().min(450.0 - c);
    let half_turn: Vec<f32> = (0..=12).map(|i| (270.0 + 15.0 * i as f32) % 360.0).collect();
    assert_eq!(read(4, angles(0.0, 90.0, 15.0), quadrant), read(0, all.clone(), quadrant));
    assert_eq!(read(2, angles(0.0, 180.0, 15.0), along), read(0, all.clone(), along));
    assert_eq!(read(3, half_turn, across), read(0, all.clone(), across));
    // Isym 1 names all planes and tabulates one.
    let round = read(1, vec![0.0], |_| 0.0);
    let bound = read_back_bound(round.peak(), 10.0);
    assert!((round.intensity(direction(77.0, 35.0)) - 35.0).abs() <= bound);
}

#[test]
fn fluxes_of_closed_forms() {
    for step in [1.0_f32, 5.0, 15.0] {
        let isotropic = Lamp::new(1, vec![0.0], angles(0.0, 180.0, step), |_, _| 100.0);
        // Linear interpolation of a constant is exact; 2⁻²⁴ for each f32, and as much again.
        assert!(
            (parse(&isotropic.ies(NEW, [1.0; 3])).flux - 400.0 * PI).abs() < 400.0 * PI * 2.0_f64.powi(-22)
        );
        // Lambert, π I0: interpolation errs by at most h²/8 · |I″|, over 2π sr.
        let lambert = |_, g: f32| 100.0 * g.to_radians().cos().max(0.0);
        let bound = 2.0 * PI * 100.0 * f64::from(step).to_radians().powi(2) / 8.0 + 1e-3;
        let below = Lamp::new(1, vec![0.0], angles(0.0, 90.0, step), lambert);
        assert!((parse(&below.ies(NEW, [1.0; 3])).flux - 100.0 * PI).abs() < bound);
        let ldt = parse(&below.ldt(1, &[0.0], 1, 2000.0, 1.0));
        assert!((ldt.flux - 200.0 * PI).abs() < 2.0 * bound);
    }
}

/// A round lamp about nadir in types B and A: max(0, −z), whose angles are cos H cos V and −sin V.
#[test]
fn round_lamps_of_all_types_agree() {
    for step in [2.5_f32, 5.0, 10.0] {
        let cos = |angle: f32| angle.to_radians().cos();
        let c = Lamp::new(1, vec![0.0], angles(0.0, 180.0, step), |_, g| cos(g).max(0.0));
        let b = |from| {
            Lamp::new(2, angles(from, 90.0, step), angles(-90.0, 90.0, step), |h, v| {
                (cos(h) * cos(v)).max(0.0)
            })
        };
        let a = Lamp::new(3, angles(-180.0, 180.0, step), angles(-90.0, 90.0, step), |_, v| {
            (-v.to_radians().sin()).max(0.0)
        });
        let c = parse(&c.ies(NEW, [1.0; 3])).distribution;
        // Bilinear in the file: h²/8 in each of two angles with |I″| ≤ 1; the grid of h/2 again a quarter of
        // it; type C its own h²/8. The fold at the horizon lies on nodes of all. Roundings: 1e-5.
        let h = step.to_radians();
        let bound = (2.0 + 0.5 + 1.0) * h * h / 8.0 + 1e-5;
        for lamp in [b(-90.0), b(0.0), a] {
            let lamp = parse(&lamp.ies(NEW, [1.0; 3])).distribution;
            for (turn, gamma) in
                (0..360).step_by(7).flat_map(|turn| (0..180).step_by(3).map(move |g| (turn, g)))
            {
                let d = direction(turn.into(), gamma.into());
                let off = (lamp.intensity(d) - c.intensity(d)).abs();
                assert!(off <= bound, "step {step}, C {turn}, γ {gamma}: {off} > {bound}");
            }
        }
    }
}

/// Where the angles of types B and A point (LM-63-2002: clockwise, B's V = 90° is C = 0, A's V = −90° nadir).
#[test]
fn types_b_and_a_point_as_lm63_says() {
    let at = |kind, h: f32, v: f32| {
        let spot = |x: f32, y: f32| if (x - h).abs() < 0.1 && (y - v).abs() < 0.1 { 1.0 } else { 0.0 };
        let lamp = Lamp::new(kind, angles(-90.0, 90.0, 10.0), angles(-90.0, 90.0, 10.0), spot);
        let lamp = parse(&lamp.ies(NEW, [1.0; 3])).distribution;
        move |d: Vec3| lamp.intensity(d.normalize())
    };
    let (sin, cos) = 30.0_f32.to_radians().sin_cos();
    // The node lies on the new grid (5° or finer and a divisor of 10°) or within one step of 2.5°.
    for (kind, h, v, d) in [
        (2, 0.0, 0.0, Vec3::NEG_Z),
        (2, 0.0, 30.0, Vec3::new(sin, 0.0, -cos)),
        (2, 30.0, 0.0, Vec3::new(0.0, -sin, -cos)),
        (2, 0.0, 90.0, Vec3::X),
        (3, 0.0, 0.0, Vec3::X),
        (3, 30.0, 0.0, Vec3::new(cos, -sin, 0.0)),
        (3, 0.0, 30.0, Vec3::new(cos, 0.0, sin)),
        (3, 0.0, -90.0, Vec3::NEG_Z),
    ] {
        let lamp = at(kind, h, v);
        // Half a step of the spot's own slope at worst, were the node missed.
        assert!(lamp(d) > 0.99, "type {kind}, H {h}, V {v}: {}", lamp(d));
        assert!(lamp(-d) == 0.0);
    }
}

const MINIMAL: &str = "IESNA:LM-63-1995\n[LUMINAIRE] Spot\n[LAMP] LED 2700K\nTILT=NONE\n\
    2 500 2 3 1 1 1 -1 0 0\n0.9 1 20\n0 45 90\n0\n100 80 60\n";

#[test]
fn ways_to_write_the_same() {
    let plain = parse(MINIMAL);
    assert_eq!(plain.name, "Spot");
    assert_eq!(plain.rated_lumens, Some(1000.0));
    assert_eq!(plain.colour_temperature, Some(2700.0));
    assert_eq!(plain.distribution.peak(), 180.0);
    assert_eq!(plain.opening.shape, Shape::Ellipse);
    assert!((plain.opening.width - 0.3048).abs() < 1e-15); // feet
    assert_eq!(plain.warnings, []);
    for other in [
        MINIMAL.replace('\n', "\r\n"),
        MINIMAL.replace('\n', "\r"),
        MINIMAL.replace("100 80 60", "100\n80,\n\n60"),
        MINIMAL.replace("0 45 90", "0, 45,90"),
        MINIMAL.replace("TILT=NONE", "tilt = none"),
        format!("\u{feff}{MINIMAL}"),
        format!("{MINIMAL}\u{1a}"),
    ] {
        assert_eq!(parse(&other), plain, "{other:?}");
    }
    let junk = parse(&format!("{MINIMAL}END 5"));
    assert_eq!((junk.warnings.len(), &junk.distribution), (1, &plain.distribution));
    assert!(junk.warnings[0].place.ends_with("line 10"));
    let latin: Vec<u8> =
        MINIMAL.replace("Spot", "Str#er").bytes().map(|b| if b == b'#' { 0xE4 } else { b }).collect();
    assert_eq!(photometry::parse(&latin, Path::new("x.ies")).expect("Latin-1").name, "Sträer");
    assert_eq!(
        parse(&MINIMAL.replace("IESNA:LM-63-1995\n[LUMINAIRE] Spot\n[LAMP] LED 2700K\n", "")).flux,
        plain.flux
    );
}

#[test]
fn second_factor_and_tilt() {
    let second = MINIMAL.replace("0.9 1 20", "0.9 0.5 20");
    assert_eq!(parse(&second).distribution.peak(), 180.0);
    assert_eq!(parse(&second).warnings.len(), 1);
    assert_eq!(parse(&second.replace("IESNA:LM-63-1995", "IESNA91")).distribution.peak(), 90.0);
    let new = second.replace("IESNA:LM-63-1995", "IES:LM-63-2019").replace("0.5", "1.10010");
    assert_eq!((parse(&new).distribution.peak(), parse(&new).warnings.len()), (180.0, 0));
    let include = parse(&MINIMAL.replace("TILT=NONE", "TILT=INCLUDE\n2\n3\n0 45 90\n1 0.95 0.9"));
    assert_eq!(include.tilt.expect("tilt").factors, [(0.0, 1.0), (45.0, 0.95), (90.0, 0.9)]);
    assert_eq!(include.warnings.len(), 1);
    let file = parse(&MINIMAL.replace("TILT=NONE", "TILT=lamp.tlt"));
    assert!(file.warnings[0].what.contains("lamp.tlt") && file.warnings[0].place.ends_with("line 4"));
}

#[test]
fn eulumdat_says_more() {
    let lamp = Lamp::new(1, vec![0.0], angles(0.0, 90.0, 10.0), |_, g| 318.3 * g.to_radians().cos().max(0.0));
    let text = lamp.ldt(1, &[0.0], 1, 2000.0, 1.0);
    let read = parse(&text);
    assert_eq!((read.name.as_str(), read.manufacturer.as_str()), ("Lamp", "Company"));
    assert_eq!(
        (read.rated_lumens, read.watts, read.colour_temperature),
        (Some(2000.0), Some(25.5), Some(3000.0))
    );
    let opening = read.opening;
    assert_eq!(opening.shape, Shape::Rectangle);
    // Millimetres times 1e-3: one rounding.
    assert!(
        (opening.length - 1.1).abs() + (opening.width - 0.2).abs() + (opening.height - 0.02).abs() < 1e-15
    );
    assert_eq!(read.warnings, []);
    // Absolute: cd/klm that make 1000 lm, or candela that make the stated flux.
    let absolute = parse(&lamp.ldt(1, &[0.0], -1, 2000.0, 1.0));
    assert_eq!((absolute.rated_lumens, &absolute.distribution), (None, &read.distribution));
    let candela = Lamp { candela: lamp.candela.iter().map(|i| i * 2.0).collect(), ..lamp };
    let candela = parse(&candela.ldt(1, &[0.0], -1, 2000.0, 1.0));
    assert_eq!((candela.warnings.len(), &candela.distribution), (1, &read.distribution));
    // Alternatives: the first counts.
    let set = "1\nLED\n2000\n3000 K\n80\n25,5\n";
    let sets = text.replace(&format!("1\n{set}"), &format!("2\n{set}{}", set.replace("2000", "9000")));
    assert_eq!(parse(&sets).flux, read.flux);
    assert!(parse(&sets).warnings[0].what.contains("9000"));
}

#[test]
fn errors_name_the_line_and_what_is_possible() {
    let bad = |from: &str, to: &str| error(&MINIMAL.replacen(from, to, 1));
    for (message, parts) in [
        (bad("TILT=NONE", "TITL=NONE"), &["TILT=NONE", "TILT=INCLUDE"][..]),
        (bad("100 80 60", "100 80"), &["line 9", "ends", "number 3 of 3"]),
        (bad("80 60", "x 60"), &["line 9", "\"x\" is no number"]),
        (bad("80 60", "inf 60"), &["line 9", "\"inf\" is no number"]),
        (bad("80 60", "1e300 60"), &["line 9", "1e300"]),
        (bad("0 45 90", "0 95 90"), &["line 7", "90 follows 95", "rise"]),
        (bad("0 45 90", "0 45 190"), &["line 7", "190 lies outside 0 to 180"]),
        (bad("3 1 1 1", "3 1 4 1"), &["line 5", "type", "3 is A", "is 4"]),
        (bad("3 1 1 1", "3 1 1 3"), &["line 5", "unit", "2 is metres"]),
        (bad("3 1 1 1", "4000000 4000000 1 1"), &["line 5", "at most 4194304"]),
        (bad("3 1 1 1", "1e18 1 1 1"), &["line 5", "whole number from 2 to 4194304"]),
        (bad("3 1 1 1", "2.5 1 1 1"), &["line 5", "2.5"]),
        (bad("500 2", "500 -2"), &["factor is -1.8"]),
        (
            bad("1 1 1 -1 0 0\n0.9 1 20\n0 45 90\n0\n", "2 1 1 -1 0 0\n0.9 1 20\n0 45 90\n0 70\n1 2 3\n"),
            &["0 to 70", "90 to 270"],
        ),
        (error("hello\nworld\n"), &["TILT="]),
    ] {
        assert!(parts.iter().all(|part| message.contains(part)), "{message} lacks one of {parts:?}");
    }
    let lamp = Lamp::new(1, vec![0.0], angles(0.0, 90.0, 10.0), |_, _| 1.0);
    assert!(error(&lamp.ldt(1, &[0.0], 1, 0.0, 1.0)).contains("flux is 0 lm"));
    assert!(error(&lamp.ldt(2, &[0.0], 1, 9.0, 1.0)).contains("line 4: 1 C planes with symmetry 2"));
    let unknown = photometry::parse(b"hello", Path::new("lamp.txt")).expect_err("not photometry").to_string();
    assert!(unknown.contains("neither IES LM-63") && unknown.contains("EULUMDAT"));
    assert!(photometry::parse(b"", Path::new("x.ldt")).is_err());
    assert!(photometry::read(Path::new("/nowhere/lamp.ies")).is_err());
}

#[test]
fn negative_noise_is_taken_as_nothing() {
    let noisy = parse(&MINIMAL.replace("80 60", "80 -0.1"));
    assert_eq!(noisy.distribution.intensity(direction(0.0, 90.0)), 0.0);
    assert!(noisy.warnings[0].what.contains("1 negative"));
}
