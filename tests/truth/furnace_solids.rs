//! White furnaces around exact bodies: mirrors and clear glass cannot be told from a sky of one luminance, but for the
//! rays that the limits cut off, which are counted, and for what metal scatters, which hollows hide.

use std::sync::{Arc, Mutex};

use glam::Vec3;
use keikan::pipeline::{Limits, Monitor, Pipeline, Region};
use keikan_tests::{luminances, pipeline};
use light::{Arrival, Hit, Illuminate, Path, Place, Ray, Shade, Spectrum, Surroundings, Uniform, Vacuum};

const SIZE: (u32, u32) = (24, 18);

/// Rounding of one turn: some ten operations in f32, each off by half an ε.
const TURN: f64 = 10.0 * f32::EPSILON as f64;

/// Bodies of the material `m`, by name.
const BODIES: [(&str, &str); 3] = [
    ("ball", "sphere = { radius = 1.2 }\nposition = [0, 1, 0]"),
    ("cylinder", "cylinder = { radius = 0.8, height = 2 }\nrotation = [20, 30, 0]"),
    (
        "bored ball",
        "difference = ['whole', 'bore', 'bite']\nrotation = [20, 30, 0]\n\
         [[solid]]\nname = 'whole'\nsphere = { radius = 1.2 }\nposition = [0, 1, 0]\n\
         [[solid]]\nname = 'bore'\ncylinder = { radius = 0.4, height = 4 }\nposition = [0, -1, 0]\n\
         [[solid]]\nname = 'bite'\nbox = { size = [1, 1, 1] }\nposition = [0.9, 1, 0.9]",
    ),
];

const GLASS: &str = "transmission = 1\nior = 1.52";
const MIRROR: &str = "metallic = 1";

/// A sky of 10 000 cd/m² above and below, and one body in the middle.
fn furnace(material: &str, body: &str) -> String {
    format!(
        r#"
        [sky]
        model = "uniform"
        albedo = 1
        illuminance = 31415.926535
        [[material]]
        name = "m"
        colour = 1
        roughness = 0
        {material}
        [[solid]]
        material = "m"
        {body}
        [[camera]]
        position = [3, 4, 5]
        target = [0, 1, 0]
        "#
    )
}

/// Shares of a pixel that need not be seen.
#[derive(Clone, Copy, Default)]
struct Missing {
    /// What the limits keep from being followed.
    cut_off: f64,
    /// What surfaces scatter: where the body itself hides a part of the sky, some of it is dark.
    scattered: f64,
}

/// A shader that counts what is missing.
struct Counted {
    shaders: Arc<[Box<dyn Shade>]>,
    index: usize,
    limits: Limits,
    missing: Arc<Mutex<Missing>>,
}

/// Light of radiance 1 from all around that is scattered only, never mirrored.
struct Scattered;

impl Surroundings for Scattered {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        Uniform { radiance: Spectrum::ONE }.arrivals(place, &Vacuum, receive);
    }

    fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
        Spectrum::ZERO
    }
}

struct Counting<'a> {
    around: &'a dyn Surroundings,
    by: &'a Counted,
}

impl Shade for Counted {
    fn radiance(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum {
        let scattered = self.shaders[self.index].radiance(hit, &Scattered).max();
        self.missing.lock().unwrap().scattered += f64::from(hit.path.share * scattered);
        self.shaders[self.index].radiance(hit, &Counting { around, by: self })
    }
}

impl Surroundings for Counting<'_> {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        self.around.arrivals(place, receive);
    }

    fn beams(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        self.around.beams(place, receive);
    }

    fn radiance(&self, ray: &Ray, path: Path) -> Spectrum {
        if path.depth > self.by.limits.depth || path.share < self.by.limits.share {
            self.by.missing.lock().unwrap().cut_off += f64::from(path.share);
        }
        self.around.radiance(ray, path)
    }
}

/// The pipeline with all its shaders counted.
fn counted(text: &str, set: &[(&str, &str)]) -> (Pipeline, Arc<Mutex<Missing>>) {
    let (_, mut pipeline) = pipeline(text, SIZE, set);
    let (limits, missing) = (pipeline.limits, Arc::new(Mutex::new(Missing::default())));
    let shaders = Arc::clone(&pipeline.shade);
    let wrap = |index| -> Box<dyn Shade> {
        Box::new(Counted { shaders: Arc::clone(&shaders), index, limits, missing: Arc::clone(&missing) })
    };
    pipeline.shade = (0..shaders.len()).map(wrap).collect();
    (pipeline, missing)
}

/// The least and the largest luminance around. The ground's is the sky's, but for the table that its illuminance is from.
fn around(pipeline: &Pipeline) -> (f64, f64) {
    let toward = |direction| {
        let of = |source: &keikan::pipeline::Source| source.light.radiance(&Ray::new(Vec3::ZERO, direction));
        f64::from(pipeline.sources.iter().map(of).sum::<Spectrum>().luminance())
    };
    let (sky, ground) = (toward(Vec3::Y), toward(Vec3::NEG_Y));
    assert!(
        (sky / 10_000.0 - 1.0).abs() < 1e-4 && (ground / sky - 1.0).abs() < 1e-4,
        "π L = E: {sky} {ground}"
    );
    (sky.min(ground), sky.max(ground))
}

/// Of every pixel the luminance by the largest around, and what is missing; and the least luminance around.
fn pixels(text: &str, set: &[(&str, &str)]) -> (Vec<(f64, Missing)>, f64) {
    let (pipeline, missing) = counted(text, set);
    let (least, most) = around(&pipeline);
    let one = |column, row| {
        *missing.lock().unwrap() = Missing::default();
        let region = Region { columns: column..column + 1, rows: row..row + 1 };
        let film = pipeline.render(&region, false, &Monitor::default()).unwrap();
        (f64::from(luminances(&film)[0]) / most, *missing.lock().unwrap())
    };
    let places = (0..SIZE.1).flat_map(|row| (0..SIZE.0).map(move |column| (column, row)));
    (places.map(|(column, row)| one(column, row)).collect(), least / most)
}

#[test]
fn what_is_seen_and_what_is_cut_off_are_all() {
    let limits = [("ray-depth", "24"), ("ray-share", "0.0001")];
    let rounding = 24.0 * TURN;
    for material in [MIRROR, GLASS] {
        for (name, body) in BODIES {
            let text = furnace(material, body);
            // One ray a pixel: exactly what is cut off is missing.
            let (rays, least) =
                pixels(&text, &[("visibility", "rays"), ("samples", "1"), limits[0], limits[1]]);
            let (mut low, mut high, mut most) = (1.0f64, 0.0f64, Missing::default());
            for (i, (seen, missing)) in rays.iter().enumerate() {
                let all = seen + missing.cut_off;
                assert!(all <= 1.0 + rounding, "{material} {name}, {i}: {all}");
                assert!(all >= least * (1.0 - missing.scattered) - rounding, "{material} {name}, {i}: {all}");
                (low, high) = (low.min(all), high.max(all));
                most.cut_off = most.cut_off.max(missing.cut_off);
                most.scattered = most.scattered.max(missing.scattered);
            }
            println!(
                "{material} {name}: seen and cut off {low:.6} to {high:.6} of the sky (ground {least:.6}); cut off {:.1e}, \
                 scattered {:.1e} at most",
                most.cut_off, most.scattered
            );
            // Pieces are parts of a pixel: of each at most what it lacks is missing.
            for (i, (seen, missing)) in pixels(&text, &limits).0.iter().enumerate() {
                let low = least * (1.0 - missing.cut_off - missing.scattered) - rounding;
                assert!(*seen >= low && *seen <= 1.0 + rounding, "{material} {name}, {i}: {seen}");
            }
        }
    }
}

/// Fresnel's reflectance for unpolarised light from air, straight from the sines and tangents.
fn fresnel(index: f64, cos: f64) -> f64 {
    let outside = cos.acos();
    let inside = (outside.sin() / index).asin();
    if outside < 1e-6 {
        return ((index - 1.0) / (index + 1.0)).powi(2);
    }
    let s = (outside - inside).sin() / (outside + inside).sin();
    let p = (outside - inside).tan() / (outside + inside).tan();
    0.5 * (s * s + p * p)
}

/// In a ball every ray meets the surface at one angle: of the share (1 − r) that enters, r stays at each turn. Followed
/// to depth k ≥ 1, all is seen but what is inside then, (1 − r) rᵏ⁻¹.
#[test]
fn a_ball_of_glass_lacks_what_is_still_inside() {
    let text = furnace(GLASS, BODIES[0].1);
    let mut compared = 0;
    for depth in [1, 2, 3, 5, 8] {
        let depth_knob = depth.to_string();
        let set = [("visibility", "rays"), ("samples", "1"), ("ray-depth", &depth_knob), ("ray-share", "0")];
        let (_, pipeline) = pipeline(&text, SIZE, &set);
        let (seen, least) = pixels(&text, &set);
        pipeline.see.see(0..SIZE.1, 0..SIZE.0, &mut |row, pieces| {
            for piece in pieces {
                let (here, _) = seen[(row * SIZE.0 + piece.column) as usize];
                let cos = f64::from(piece.hit.toward_eye.dot(piece.hit.place.normal));
                let r = fresnel(1.52, cos);
                let expected = 1.0 - (1.0 - r) * r.powi(depth - 1);
                let rounding = f64::from(depth + 1) * TURN;
                let (low, high) = (least * expected - rounding, expected + rounding);
                assert!((low..=high).contains(&here), "depth {depth}: {here} {expected}, r = {r}");
                compared += 1;
            }
        });
    }
    println!("{compared} pixels of a ball");
    assert!(compared > 300, "{compared}");
}

#[test]
fn light_grows_with_depth_and_is_never_more_than_there_is() {
    for material in [GLASS, MIRROR] {
        for (name, body) in BODIES {
            let mut before = vec![0.0; (SIZE.0 * SIZE.1) as usize];
            for depth in 0..=8 {
                let knob = depth.to_string();
                // Looking at all places: how many look alike would change with the depth.
                let set = [("ray-depth", knob.as_str()), ("ray-share", "0"), ("body.tolerance", "0")];
                let (plan, pipeline) = pipeline(&furnace(material, body), SIZE, &set);
                let most = around(&pipeline).1;
                let seen = luminances(&pipeline.render(&plan.region, false, &Monitor::default()).unwrap());
                // A turn more only adds light, and f32 sums of it in one order are monotone.
                for (i, (now, before)) in seen.iter().zip(&before).enumerate() {
                    assert!(now >= before, "{material} {name}, depth {depth}, pixel {i}: {before} {now}");
                    let all = f64::from(*now) / most;
                    assert!(
                        all <= 1.0 + f64::from(depth + 1) * TURN,
                        "{name}, depth {depth}, pixel {i}: {all}"
                    );
                }
                before = seen;
            }
        }
    }
}
