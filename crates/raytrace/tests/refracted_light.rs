//! What a straight shadow ray through a transparent body is off by, against light that is refracted.
//!
//! The reference sends photons of a sun (parallel light) through convex bodies in f64: Snell, Fresnel as a chance,
//! all inner reflections; counted where they land on the floor. Run with `--nocapture` for the table.

use glam::DVec3;
use keikan_raytrace::{Crossing, through};
use light::{Medium, fresnel, interface::reflect, refract};

const INDEX: f64 = 1.52;
/// Cells of the floor \[m\].
const CELL: f64 = 0.005;
const CELLS: usize = 160;
const PHOTONS: u64 = 8_000_000;

/// A convex body.
enum Shape {
    Ball {
        centre: DVec3,
        radius: f64,
    },
    /// Outward normals and distances from the origin.
    Planes(Vec<(DVec3, f64)>),
}

impl Shape {
    /// Where a line enters and leaves.
    fn meet(&self, origin: DVec3, direction: DVec3) -> Option<[Crossing; 2]> {
        match self {
            Self::Ball { centre, radius } => {
                let to = *centre - origin;
                let (along, off) = (to.dot(direction), to.length_squared());
                let half2 = radius * radius - (off - along * along);
                (half2 > 0.0).then(|| {
                    [-half2.sqrt(), half2.sqrt()].map(|h| {
                        let t = along + h;
                        Crossing { t, outward: (origin + direction * t - *centre).normalize() }
                    })
                })
            }
            Self::Planes(planes) => {
                let mut enter = Crossing { t: f64::NEG_INFINITY, outward: DVec3::ZERO };
                let mut leave = Crossing { t: f64::INFINITY, outward: DVec3::ZERO };
                for &(outward, distance) in planes {
                    let speed = outward.dot(direction);
                    let t = (distance - outward.dot(origin)) / speed;
                    if speed < 0.0 && t > enter.t {
                        enter = Crossing { t, outward };
                    } else if speed > 0.0 && t < leave.t {
                        leave = Crossing { t, outward };
                    } else if speed == 0.0 && outward.dot(origin) > distance {
                        return None;
                    }
                }
                (enter.t < leave.t).then_some([enter, leave])
            }
        }
    }
}

fn slab() -> Shape {
    let axis = |v: DVec3, h: f64| [(v, h), (-v, h)];
    let mut planes = vec![(DVec3::Y, 0.12), (-DVec3::Y, -0.10)];
    planes.extend(axis(DVec3::X, 0.15).into_iter().chain(axis(DVec3::Z, 0.15)));
    Shape::Planes(planes)
}

/// A prism on ten sides, 5 cm high, a millimetre above the floor.
fn stand() -> Shape {
    let mut planes = vec![(DVec3::Y, 0.051), (-DVec3::Y, -0.001)];
    planes.extend((0..10).map(|i| {
        let turn = (f64::from(i) + 0.3) * std::f64::consts::TAU / 10.0;
        (DVec3::new(turn.cos(), 0.0, turn.sin()), 0.1)
    }));
    Shape::Planes(planes)
}

/// xorshift64*, seeded.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Where a photon that goes towards the body leaves it for good: origin and direction.
fn travel(shape: &Shape, mut origin: DVec3, mut direction: DVec3, chance: &mut Chance) -> (DVec3, DVec3) {
    let Some([enter, _]) = shape.meet(origin, direction) else { return (origin, direction) };
    origin += direction * enter.t;
    if chance.next() < fresnel(INDEX, -direction.dot(enter.outward)) {
        return (origin, reflect(direction, enter.outward));
    }
    direction = refract(direction, enter.outward, INDEX).unwrap_or(direction);
    for _ in 0..200 {
        let Some([_, leave]) = shape.meet(origin, direction) else { break };
        origin += direction * leave.t;
        let cos = direction.dot(leave.outward);
        if chance.next() >= fresnel(1.0 / INDEX, cos) {
            let out = refract(direction, -leave.outward, 1.0 / INDEX).unwrap_or(direction);
            return (origin, out);
        }
        direction = reflect(direction, leave.outward);
    }
    // Caught by total reflection: such light never leaves a body without flaws.
    (origin, DVec3::Y)
}

/// Irradiance of the floor as a share of that without the body, by cell.
fn lit(shape: &Shape, sun: DVec3) -> Vec<f64> {
    let mut chance = Chance(0x9E37_79B9_7F4A_7C15);
    let size = CELLS as f64 * CELL;
    let mut counts = vec![0u32; CELLS * CELLS];
    for _ in 0..PHOTONS {
        // Even over the floor as it would be lit without the body: all light that meets the body aims there.
        let aim = DVec3::new(chance.next() - 0.5, 0.0, chance.next() - 0.5) * size;
        let (origin, direction) = travel(shape, aim - sun * 10.0, sun, &mut chance);
        let t = -origin.y / direction.y;
        let at = (origin + direction * t) / size + DVec3::splat(0.5);
        if t > 0.0 && (0.0..1.0).contains(&at.x) && (0.0..1.0).contains(&at.z) {
            counts[(at.z * CELLS as f64) as usize * CELLS + (at.x * CELLS as f64) as usize] += 1;
        }
    }
    let even = PHOTONS as f64 / (CELLS * CELLS) as f64;
    counts.into_iter().map(|count| f64::from(count) / even).collect()
}

/// The thesis' (2.3): the exit face is met at the angle of the straight ray.
fn thesis(direction: DVec3, [enter, leave]: &[Crossing; 2]) -> f64 {
    (1.0 - fresnel(INDEX, -direction.dot(enter.outward)))
        * (1.0 - fresnel(1.0 / INDEX, direction.dot(leave.outward)))
}

/// Both faces as seen from outside: never totally reflected.
fn outer(direction: DVec3, [enter, leave]: &[Crossing; 2]) -> f64 {
    (1.0 - fresnel(INDEX, -direction.dot(enter.outward)))
        * (1.0 - fresnel(INDEX, direction.dot(leave.outward)))
}

fn ours(direction: DVec3, crossings: &[Crossing; 2]) -> f64 {
    let glass = Medium { index: INDEX as f32, ..Medium::default() };
    f64::from(through(direction, &mut crossings.clone(), f64::INFINITY, 1e-9, &glass)[0])
}

/// Over the cells in the body's geometric shadow: mean light, and mean absolute difference to the reference.
fn compare(
    shape: &Shape,
    sun: DVec3,
    truth: &[f64],
    rule: impl Fn(DVec3, &[Crossing; 2]) -> f64,
) -> [f64; 3] {
    let (mut cells, mut light, mut mean, mut off) = (0.0, 0.0, 0.0, 0.0);
    for (i, truth) in truth.iter().enumerate() {
        let at = DVec3::new((i % CELLS) as f64 + 0.5, 0.0, (i / CELLS) as f64 + 0.5) * CELL;
        let at = at - DVec3::new(0.5, 0.0, 0.5) * (CELLS as f64 * CELL);
        let Some(crossings) = shape.meet(at - sun * 10.0, sun) else { continue };
        let share = rule(sun, &crossings);
        cells += 1.0;
        light += truth;
        mean += share;
        off += (share - truth).abs();
    }
    [light / cells, mean / cells, off / cells]
}

fn sun(incidence: f64) -> DVec3 {
    let (sin, cos) = incidence.to_radians().sin_cos();
    DVec3::new(sin, -cos, 0.0)
}

#[test]
fn straight_shadows_against_refracted_light() {
    let ball = Shape::Ball { centre: DVec3::Y * 0.1, radius: 0.05 };
    let high_ball = Shape::Ball { centre: DVec3::Y * 0.3, radius: 0.05 };
    let cases = [
        ("slab 2 cm, 30°", slab(), 30.0),
        ("slab 2 cm, 60°", slab(), 60.0),
        ("ball of 5 cm, 10 cm up, 30°", ball, 30.0),
        ("ball of 5 cm, 30 cm up, 30°", high_ball, 30.0),
        ("ten-faced stand, 30°", stand(), 30.0),
        ("ten-faced stand, 55°", stand(), 55.0),
    ];
    println!(
        "mean light in the geometric shadow, n = {INDEX}; in brackets the mean local error\n{:<30}{:>10}{:>18}{:>18}{:>18}",
        "", "refracted", "here", "thesis (2.3)", "outer angles"
    );
    let mut errors = Vec::new();
    for (name, shape, incidence) in cases {
        let sun = sun(incidence);
        let truth = lit(&shape, sun);
        let [light, mean, off] = compare(&shape, sun, &truth, ours);
        let [_, old, old_off] = compare(&shape, sun, &truth, thesis);
        let [_, out, out_off] = compare(&shape, sun, &truth, outer);
        println!(
            "{name:<30}{light:>10.3}{mean:>10.3} ({off:.3}){old:>10.3} ({old_off:.3}){out:>10.3} ({out_off:.3})"
        );
        errors.push((light, mean, old, off));
    }
    // A slab: the straight rays that pass a side face (2 cm · tan 30° at either end of 31 cm) are dark in the rule
    // and lit in truth, where light is turned at the side and goes on; inner reflections add r² < 0.01.
    let (light, mean, ..) = errors[0];
    assert!((light - mean).abs() < 2.0 * 0.02 * 30f64.to_radians().tan() / 0.31 + 0.01, "{light} {mean}");
    // Beyond 41° the thesis' slab is black, but for its sides, and ours is not.
    let (light, mean, old, _) = errors[1];
    assert!(old < 0.1 && (light - mean).abs() < (light - old).abs(), "{light} {mean} {old}");
}
