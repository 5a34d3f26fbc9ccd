use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use light::Vacuum;
use proptest::prelude::*;

use super::division::Patch;
use super::*;
use crate::Dome;
use crate::luminous::tests::standard;

fn described(name: &str, altitude: f32) -> Description {
    Description::new(Arc::new(standard(name, altitude)))
}

fn place(normal: Vec3) -> Place {
    Place { position: Vec3::new(3.0, 2.0, 1.0), error: 1e-6, normal, seed: 0 }
}

/// A wall all around as high as this altitude's sine, but for a gate between two azimuths from +X \[rad\] where it lets `through` pass.
struct Wall {
    sin: f32,
    gate: [f32; 2],
    through: f32,
}

impl Wall {
    fn passes(&self, direction: Vec3) -> f32 {
        let azimuth = direction.z.atan2(direction.x);
        match direction.y > self.sin {
            true => 1.0,
            _ if azimuth > self.gate[0] && azimuth < self.gate[1] => self.through,
            _ => 0.0,
        }
    }
}

impl Occlude for Wall {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        Spectrum::splat(self.passes(segment.direction))
    }
}

/// What the slow way says: both hemispheres in 0.5° steps, f64. Luminance.
fn integral(description: &Description, normal: Vec3, wall: &Wall) -> f64 {
    let ground = f64::from(Dome::new(description).ground_radiance().luminance());
    let step = PI / 360.0;
    let mut sum = 0.0;
    for row in -180..180 {
        let altitude = (f64::from(row) + 0.5) * step;
        for column in 0..720 {
            let azimuth = (f64::from(column) + 0.5) * step;
            let (level, y) = (altitude.cos(), altitude.sin());
            let direction =
                Vec3::new((level * azimuth.cos()) as f32, y as f32, (level * azimuth.sin()) as f32);
            let radiance = match row < 0 {
                true => ground,
                false => f64::from(description.sky.radiance(direction).luminance()),
            };
            let cosine = f64::from(direction.dot(normal)).max(0.0);
            sum += radiance * cosine * level * f64::from(wall.passes(direction));
        }
    }
    sum * step * step
}

const NORMALS: [Vec3; 4] = [Vec3::Y, Vec3::X, Vec3::NEG_Y, Vec3::new(0.36, 0.48, -0.8)];

#[test]
fn open_places_are_exact() {
    for (name, altitude) in [("uniform", 20.0), ("overcast", 20.0), ("clear", 20.0)] {
        let patches = PatchSky::new(&described(name, altitude), 8);
        let dome = Dome::new(&described(name, altitude));
        for normal in NORMALS {
            assert_eq!(patches.irradiance(&place(normal), &Vacuum), dome.open_irradiance(normal));
        }
    }
}

#[test]
fn half_hidden_places_have_what_the_integral_says() {
    let mut worst = [0.0f64; 2];
    for (i, rows) in [PATCH_ROWS, 3 * PATCH_ROWS].into_iter().enumerate() {
        let patch = Division::new(rows).patches()[0].solid_angle();
        for (name, altitude) in [("uniform", 30.0), ("overcast", 30.0), ("clear", 20.0), ("clear", 60.0)] {
            let description = described(name, altitude);
            let sky = PatchSky::new(&description, rows);
            for (sin, gate) in [(0.5, [0.0, 0.0]), (0.17, [-0.4, 1.1]), (0.8, [1.0, 2.9]), (-2.0, [0.0, 0.0])]
            {
                let wall = Wall { sin, gate, through: 0.6 };
                for normal in NORMALS {
                    let e = f64::from(sky.irradiance(&place(normal), &wall).luminance());
                    let open = f64::from(sky.open_irradiance(normal).luminance());
                    let error = (e - integral(&description, normal, &wall)).abs() / open;
                    worst[i] = worst[i].max(error);
                }
            }
        }
        // Edges cross some 2π/√Ω patches, each off by a half of what it gives at random; of what an open plane receives
        // a patch gives Ω/π, and five times that in the sun's surroundings, which a few patches are. 2.5 deviations among 64 cases.
        let crossed = TAU / f64::from(patch).sqrt();
        let bound = 2.5 * (crossed.sqrt() * 0.5 / 3f64.sqrt() + 0.5 * 5.0) * f64::from(patch) / PI;
        println!("{rows} rows: {:.4} of an open place's light at most; allowed {bound:.4}", worst[i]);
        assert!(worst[i] <= bound, "{rows}: {} > {bound}", worst[i]);
    }
    assert!(worst[1] < 0.5 * worst[0], "{worst:?}");
}

#[test]
fn what_is_seen_serves_any_sky() {
    let wall = Wall { sin: 0.3, gate: [0.0, 1.0], through: 0.4 };
    let asked = AtomicUsize::new(0);
    let counted = Counted { wall, asked: &asked };
    let [morning, noon] =
        [10.0, 60.0].map(|altitude| PatchSky::new(&described("clear", altitude), PATCH_ROWS));
    for normal in NORMALS {
        let sight = morning.sight(&place(normal), &counted);
        let rays = asked.load(Ordering::Relaxed);
        let through = noon.through(normal, &sight);
        assert_eq!(asked.load(Ordering::Relaxed), rays);
        assert_eq!(through, noon.irradiance(&place(normal), &counted));
        assert_ne!(through, morning.through(normal, &sight));
    }
}

struct Counted<'a> {
    wall: Wall,
    asked: &'a AtomicUsize,
}

impl Occlude for Counted<'_> {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        self.asked.fetch_add(1, Ordering::Relaxed);
        self.wall.transmittance(segment)
    }
}

impl Patch {
    /// Whether a direction lies in it, within rounding of f32 azimuths of its own direction alone.
    fn holds(&self, direction: Vec3) -> bool {
        let azimuth = direction.z.atan2(direction.x).rem_euclid(std::f32::consts::TAU);
        let [a, b] = self.heights;
        (a.min(b)..a.max(b)).contains(&direction.y) && (self.azimuths[0]..self.azimuths[1]).contains(&azimuth)
    }
}

#[test]
fn patches_tile_the_sphere() {
    for rows in [1, 2, 5, 14, 20] {
        let division = Division::new(rows);
        let sum: f64 = division.patches().iter().map(|patch| f64::from(patch.solid_angle())).sum();
        // Rounding of as many f32.
        assert!((sum / (4.0 * PI) - 1.0).abs() < 1e-6, "{rows}: {sum}");
        for (i, patch) in division.patches().iter().enumerate() {
            assert_eq!(division.is_sky(i), patch.direction.y > 0.0, "{rows}: {i}");
            assert!(patch.holds(patch.direction), "{rows}: {i}");
            let others = division.patches().iter().filter(|other| other.holds(patch.direction));
            assert_eq!(others.count(), 1, "{rows}: {i}");
        }
    }
}

proptest! {
    #[test]
    fn light_is_between_nothing_and_all_and_grows_with_what_is_open(
        [x, y, z] in [-1.0f32..1.0, -1.0..1.0, -1.0..1.0],
        low in 0.0f32..1.0,
        rise in 0.0f32..1.0,
        gate in 0.0f32..3.0,
        [less, more] in [0.0f32..1.0, 0.0..1.0],
    ) {
        prop_assume!(x * x + y * y + z * z > 0.01);
        let normal = Vec3::new(x, y, z).normalize();
        let sky = PatchSky::new(&described("clear", 30.0), 4);
        let at = |sin, through| {
            let wall = Wall { sin, gate: [0.0, gate], through };
            sky.irradiance(&place(normal), &wall)
        };
        let (less, more) = (less.min(more), less.max(more));
        let [closed, open] = [at(low + rise, less), at(low, more)];
        let whole = sky.open_irradiance(normal);
        for band in 0..BANDS {
            // Sums of a hundred terms in another order.
            prop_assert!(closed[band] >= 0.0 && closed[band] <= open[band] * (1.0 + 1e-5));
            prop_assert!(open[band] <= whole[band]);
        }
    }
}
