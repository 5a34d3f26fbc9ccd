//! The cases of the thesis' table 2.1 make one picture: II, III and IV to the bit, and rays alone (case I) what
//! the default makes, wherever both look at the same points of the same faces.

use std::ops::Range;
use std::path::Path;

use glam::Vec3;
use keikan::pipeline::{Monitor, Pipeline, Region};
use keikan_tests::{build, luminances};
use light::{Known, Piece, Ray, See};

/// A small picture, and the middle of it, where groups and their shadows are.
const SIZE: (u32, u32) = (160, 120);
const MIDDLE: Region = Region { columns: 40..120, rows: 30..90 };

const CASE_1: [(&str, &str); 4] =
    [("visibility", "rays"), ("shading", "span"), ("accelerate", "none"), ("shadows", "rays")];

fn scene() -> scene::Scene {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/thesis");
    scene::load(&root.join("fig-2-8d-3.toml")).unwrap()
}

fn picture(pipeline: &Pipeline) -> Vec<f32> {
    luminances(&pipeline.render(&MIDDLE, false, &Monitor::default()).unwrap())
}

#[test]
fn cases_2_to_4_are_one_picture() {
    let scene = scene();
    let of = |accelerate| {
        let (_, pipeline) = build(&scene, SIZE, &[("accelerate", accelerate), ("shadows", "rays")]);
        let film = pipeline.render(&MIDDLE, false, &Monitor::default()).unwrap();
        let bits = film.layers[0].pixels.iter().flat_map(|pixel| pixel.0.map(f32::to_bits));
        bits.collect::<Vec<u32>>()
    };
    let second = of("none");
    assert!(second == of("view"), "III is not II");
    assert!(second == of("bvh"), "IV is not II");
}

/// Shows pieces that have been found before.
struct Given {
    first: (u32, u32),
    width: u32,
    pixels: Vec<Vec<Piece>>,
}

impl See for Given {
    fn see(&self, rows: Range<u32>, columns: Range<u32>, receive: &mut dyn FnMut(u32, &mut Vec<Piece>)) {
        for row in rows {
            let start = (row - self.first.1) * self.width;
            let at = |column: u32| &self.pixels[(start + column - self.first.0) as usize];
            receive(row, &mut columns.clone().flat_map(at).copied().collect());
        }
    }
}

/// The pieces of every pixel of the middle.
fn pieces(pipeline: &Pipeline) -> Vec<Vec<Piece>> {
    let mut pixels = vec![Vec::new(); MIDDLE.columns.len() * MIDDLE.rows.len()];
    pipeline.see.see(MIDDLE.rows.clone(), MIDDLE.columns.clone(), &mut |row, pieces| {
        let start = (row - MIDDLE.rows.start) as usize * MIDDLE.columns.len();
        for piece in pieces {
            pixels[start + (piece.column - MIDDLE.columns.start) as usize].push(*piece);
        }
    });
    pixels
}

/// What a ray of case I through the same point meets; nothing is known of its light.
fn by_ray(pipeline: &Pipeline, piece: &Piece) -> Option<Piece> {
    let ray = Ray::new(
        pipeline.view.eye.as_vec3(),
        (piece.hit.place.position.as_dvec3() - pipeline.view.eye).normalize().as_vec3(),
    );
    let mut hit = pipeline.nearest.nearest(&ray)?;
    hit.place.seed = piece.hit.place.seed;
    Some(Piece { hit, known: Known::default(), ..*piece })
}

/// What a pixel shows.
#[derive(Clone, Copy, PartialEq)]
enum Shows {
    /// One face, and of all lamps it is known whether they reach it.
    Face,
    /// The same, but shadows end within the pixel.
    ShadowEdge,
    /// One body.
    Body,
    Edges,
}

fn shows(pieces: &[Piece], bodies_from: u32) -> Shows {
    let Some(first) = pieces.first() else { return Shows::Edges };
    let share: f32 = pieces.iter().map(|piece| piece.share).sum();
    let face = |piece: &Piece| (piece.hit.instance, piece.hit.triangle);
    if pieces.iter().any(|piece| face(piece) != face(first)) || share < 1.0 - 1e-5 {
        return Shows::Edges;
    }
    if first.hit.instance >= bodies_from {
        return Shows::Body;
    }
    match pieces.iter().all(|piece| piece.known.lit | piece.known.dark == 0b111) {
        true if pieces.iter().all(|piece| piece.known == first.known) => Shows::Face,
        true => Shows::ShadowEdge,
        false => Shows::Edges,
    }
}

#[test]
fn rays_alone_show_what_the_default_shows() {
    let scene = scene();
    // Rays here are lines, not bundles: glints of lamps, which are as wide as bundles, are left out.
    let hidden = ("lamp.glints", "hidden");
    let default = build(&scene, SIZE, &[hidden]).1;
    let mut rays = build(&scene, SIZE, &[&CASE_1[..], &[hidden]].concat()).1;
    let found = pieces(&default);
    let again: Vec<Vec<Piece>> =
        found.iter().map(|pixel| pixel.iter().filter_map(|piece| by_ray(&rays, piece)).collect()).collect();
    let (width, first) = (MIDDLE.columns.len() as u32, (MIDDLE.columns.start, MIDDLE.rows.start));
    rays.see = Box::new(Given { first, width, pixels: again.clone() });
    let (ours, theirs) = (picture(&default), picture(&rays));
    // E = I (n·v)/v³ changes by at most 4 I/v³ a metre.
    let slope = |p: Vec3| -> f64 {
        let lamp = |l: &scene::Light| {
            4.0 * f64::from(l.distribution.peak()) / (l.position - p.as_dvec3()).length().powi(3)
        };
        scene.lights.iter().map(lamp).sum::<f64>() / std::f64::consts::PI
    };
    let (mut faces, mut bodies, mut worst, mut mirrored) = (0, 0, 0.0f64, 0.0f64);
    let (mut shadow_edges, mut apart, mut most) = (0, 0, 0.0f64);
    for (i, (here, there)) in found.iter().zip(&again).enumerate() {
        let what = shows(here, scene.geometry.instances.len() as u32);
        if what == Shows::Edges {
            continue;
        }
        assert_eq!(here.len(), there.len(), "pixel {i}");
        let mut bound = 0.0f64;
        for (a, b) in here.iter().zip(there) {
            assert_eq!((a.hit.instance, a.hit.triangle), (b.hit.instance, b.hit.triangle), "pixel {i}");
            let moved = f64::from((a.hit.place.position - b.hit.place.position).length());
            // The ray's origin and direction are f32: ε of 6 m at its end, more where it grazes; and the places' own errors.
            let across = f64::from(a.hit.toward_eye.dot(a.hit.place.normal));
            let own = 2.0 * f64::from(a.hit.place.error + b.hit.place.error);
            let distance = f64::from(a.hit.distance);
            assert!(moved <= (2.0 * f64::from(f32::EPSILON) * distance + own) / across, "pixel {i}: {moved}");
            bound = bound.max(slope(a.hit.place.position) * moved);
        }
        let (a, b) = (f64::from(ours[i]), f64::from(theirs[i]));
        if what == Shows::Body {
            bodies += 1;
            // What is mirrored lies farther apart than its mirror images.
            mirrored = mirrored.max((a - b).abs() / a.max(b));
            continue;
        }
        // Three lamps, eight bands, some ten operations each.
        bound += 32.0 * f64::from(f32::EPSILON) * a.max(b);
        if what == Shows::ShadowEdge {
            // Where borders of shadows cross within a strip there are slivers beside the light that they are said to have.
            shadow_edges += 1;
            apart += i32::from((a - b).abs() > bound);
            most = most.max((a - b).abs() / a.max(b));
            continue;
        }
        faces += 1;
        worst = worst.max((a - b).abs() / a.max(b));
        assert!((a - b).abs() <= bound, "pixel {i}: {a} {b}, {bound} allowed");
    }
    println!(
        "of {} pixels, {faces} of one face and one light agree to {worst:.1e}, {bodies} of one ball to its place \
         (mirrored light to {mirrored:.1e}); {apart} of {shadow_edges} with an edge of shadow alone differ by more than rounding, {most:.1e} at most",
        found.len()
    );
    println!("{} pixels with edges of faces are left out", found.len() - faces - bodies - shadow_edges);
    assert!(faces > 1000 && bodies > 200 && shadow_edges > 500, "{faces} {bodies} {shadow_edges}");
    // Mirrored places may fall to the other side of an edge of light, a sliver lies within one strip of eight: neither has a
    // bound by reasoning, so these are thrice what is measured (6.8e-3; 4 pixels of 777, 4.7e-3 at most).
    assert!(mirrored < 0.02, "{mirrored}");
    assert!(apart <= 12 && most < 0.015, "{apart} {most}");
}
