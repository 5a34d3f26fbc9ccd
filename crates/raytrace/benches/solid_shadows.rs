//! What a segment costs that is cut into the shadows of solids, in shadow rays of the same place.
//!
//! `cargo bench -p keikan-raytrace --bench solid_shadows`. *Balls* are the four of figure 2.8 (d) on its floor, seen by
//! its first lamp; *garden*, 400 solids of all kinds in a square of 20 m; *notched*, 100 set operations of six members
//! each. The segments lie on the floor, 4 cm to 5 m long, anywhere or (*far*) where no shadow is. One thread; the
//! median of five passes. On two idle cores a segment among the balls costs 0.3 to 0.9 µs, one far from them 0.02 µs, one
//! in the garden 1.2 to 8 µs, and beside the notched ones 2.5 to 29 µs, a long one for all that it passes.

use std::{f64::consts::TAU, hint::black_box, time::Instant};

use glam::{DAffine3, DQuat, DVec3, Vec3};
use keikan_raytrace::solid::{Body, Node, Shape, Solids};
use light::{Occlude, Place, PointSource, Stretch};

/// A reproducible number in [0, 1) (splitmix64).
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

fn at(shape: Shape, scale: DVec3, place: DVec3) -> Node {
    let world_from_solid = DAffine3::from_scale_rotation_translation(scale, DQuat::IDENTITY, place);
    Node::Solid { shape, world_from_solid, material: 0 }
}

fn balls() -> Vec<Node> {
    let ball = |x: f64, z: f64| at(Shape::Sphere, DVec3::splat(0.28), DVec3::new(x, 0.28, z));
    vec![ball(-0.78, -0.8), ball(0.78, -0.8), ball(-0.78, 0.8), ball(0.78, 0.8)]
}

fn garden() -> Vec<Node> {
    let mut state = 5;
    let node = |n: usize| {
        let shape = match n % 5 {
            0 => Shape::Sphere,
            1 => Shape::Cylinder,
            2 => Shape::Cone,
            3 => Shape::Frustum { top: 0.6 },
            _ => Shape::cube(),
        };
        let mut next = || random(&mut state);
        let scale = DVec3::new(0.1, 0.1, 0.1) + DVec3::new(next(), next(), next()) * 0.2;
        at(shape, scale, DVec3::new(next() - 0.5, 0.02, next() - 0.5) * 20.0)
    };
    (0..400).map(node).collect()
}

/// Pots: a truncated cone, hollow, with four notches in its rim.
fn notched() -> Vec<Node> {
    let pot = |n: u32| {
        let place = DVec3::new(f64::from(n % 10) * 2.0 - 9.0, 0.0, f64::from(n / 10) * 2.0 - 9.0);
        let outer = at(Shape::Frustum { top: 1.4 }, DVec3::new(0.4, 0.6, 0.4), place);
        let mut cuts = vec![at(Shape::Cylinder, DVec3::new(0.35, 0.6, 0.35), place + DVec3::Y * 0.05)];
        for i in 0..4 {
            let (sin, cos) = (TAU * (f64::from(i) + 0.1) / 4.0).sin_cos();
            let side = place + DVec3::new(0.5 * cos, 0.6, 0.5 * sin);
            cuts.push(at(Shape::cube(), DVec3::splat(0.12), side));
        }
        Node::Difference(Box::new(outer), cuts)
    };
    (0..100).map(pot).collect()
}

/// Median seconds of five passes, and what the last one counted.
fn seconds(mut pass: impl FnMut() -> usize) -> (f64, usize) {
    let mut took = [0.0; 5];
    let mut count = 0;
    for took in &mut took {
        let start = Instant::now();
        count = black_box(pass());
        *took = start.elapsed().as_secs_f64();
    }
    took.sort_by(f64::total_cmp);
    (took[2], count)
}

fn row(name: &str, solids: &Solids, (middle, side): (f64, f64), long: f64, source: PointSource) {
    let mut state = 3;
    let mut next = || random(&mut state) - 0.5;
    let segments: Vec<[DVec3; 2]> = (0..20_000)
        .map(|_| {
            let at = DVec3::new(middle + next() * side, 0.0, next() * side);
            let half = DVec3::new(next(), 0.0, next()).normalize_or_zero() * long * 0.5;
            [at - half, at + half]
        })
        .collect();
    let mut out: Vec<Stretch> = Vec::new();
    let (cut, stretches) = seconds(|| {
        let count = |&[a, b]: &[DVec3; 2]| {
            out.clear();
            solids.shadows(&source, a, b, &mut out);
            out.len()
        };
        segments.iter().map(count).sum()
    });
    let (rays, blocked) = seconds(|| {
        let blocked = |&&[a, b]: &&[DVec3; 2]| {
            let position = ((a + b) * 0.5).as_vec3();
            let place = Place { position, error: 1e-6, normal: Vec3::Y, seed: 0 };
            let ray = match source {
                PointSource::At(at) => place.toward(at.as_vec3()),
                PointSource::Toward(toward) | PointSource::Below { toward, .. } => {
                    place.leave(toward.as_vec3(), f32::INFINITY)
                }
            };
            solids.transmittance(&ray).is_zero()
        };
        segments.iter().filter(blocked).count()
    });
    let each = 1e6 / segments.len() as f64;
    println!(
        "{name:16}{long:7.2} m{:9.3} µs{:9.3} µs{:8.1}{stretches:10}{blocked:9}",
        cut * each,
        rays * each,
        cut / rays
    );
}

fn main() {
    println!(
        "{:16}{:>9}{:>12}{:>12}{:>8}{:>10}{:>9}",
        "", "segment", "cut", "ray", "rays", "stretches", "blocked"
    );
    let solids = |nodes: Vec<Node>| {
        let bodies = nodes.into_iter().map(|node| Body { node, medium: None }).collect();
        Solids::new(bodies, 0).unwrap_or_else(|fault| panic!("{fault}"))
    };
    let toward = PointSource::Toward(DVec3::new(0.6, 0.5, 0.62).normalize());
    let (balls, garden, notched) = (solids(balls()), solids(garden()), solids(notched()));
    for long in [0.04, 1.0, 5.0] {
        let lamp = PointSource::At(DVec3::new(-2.4, 3.2, 2.6));
        row("balls, lamp", &balls, (0.0, 3.0), long, lamp);
        row("balls, sun", &balls, (0.0, 3.0), long, toward);
        row("balls far, lamp", &balls, (-9.0, 3.0), long, lamp);
        let lamp = PointSource::At(DVec3::new(1.3, 6.0, -2.1));
        row("garden, lamp", &garden, (0.0, 18.0), long, lamp);
        row("garden, sun", &garden, (0.0, 18.0), long, toward);
        row("notched, lamp", &notched, (0.0, 18.0), long, lamp);
        row("notched, sun", &notched, (0.0, 18.0), long, toward);
    }
}
