//! Seconds, links and memory for ever more patches in a room with boxes, and what the links leave.
//!
//! `cargo run --release -p keikan-radiosity --example scaling [LEAST EDGE, default 0.12 m]`

use std::time::Instant;

use glam::{DAffine3, DVec3, Vec3};
use keikan_radiosity::{
    Between, Cut, Linking, Links, Obstacles, Orders, Patch, Patches, Side, Source, Surfaces, solve,
};
use light::{Geometry, Instance, Mesh, Occlude, Ray, Spectrum};

const SIZE: Vec3 = Vec3::new(8.0, 3.0, 6.0);
const REFLECTANCE: f32 = 0.6;

fn main() {
    let boxes = Boxes((0..8).map(Boxes::one).collect());
    let mut meshes = vec![cuboid(Vec3::ZERO, SIZE)];
    meshes.extend(boxes.0.iter().map(|[low, high]| cuboid(*low, *high)));
    let placed = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
    let instances = (0..meshes.len() as u32).map(placed).collect();
    let geometry = Geometry { meshes, instances };
    let obstacles = Obstacles::new(&geometry);
    let between = Between { obstacles: Some(&obstacles), ..Between::dry(&boxes) };
    println!(
        "patches  share rays | links  MB | link s  solve s (3 orders) | closure mean, least | E/(Φ/S(1−ρ)) converged"
    );
    let least = std::env::args().nth(1).and_then(|edge| edge.parse().ok()).unwrap_or(0.0);
    for edge in [1.1, 0.38, 0.12].into_iter().filter(|edge| *edge >= least) {
        let patches = Patches::new(&geometry, &Inside, &Cut { edge, ..Cut::default() });
        for share in [0.1, 0.05, 0.02] {
            if edge < 0.2 && share < 0.05 {
                continue; // minutes
            }
            let linking = Linking { share, ..Linking::default() };
            let start = Instant::now();
            let links = Links::new(&patches, &between, &linking);
            let linked = start.elapsed().as_secs_f64();
            let lit = |patch: Patch| {
                patch.centre().y > 2.999 && patch.centre().distance(DVec3::new(2.0, 3.0, 2.0)) < 1.0
            };
            let direct: Vec<_> =
                patches.iter().map(|patch| if lit(patch) { Spectrum::ONE } else { Spectrum::ZERO }).collect();
            let source = Source { emitted: &[], direct: &direct };
            let start = Instant::now();
            let _ = solve(&patches, &links, &source, Orders::Count(3));
            let solved = start.elapsed().as_secs_f64();
            let all = solve(&patches, &links, &source, Orders::Until(1e-6));
            let surface: f64 = patches.iter().map(|patch| patch.area()).sum();
            let primary = patches.integral(&direct)[0];
            let mean = (primary + patches.integral(&all.irradiance)[0]) / surface;
            let closed = primary / (surface * f64::from(1.0 - REFLECTANCE));
            let closure: Vec<f32> = links.closure(&patches).iter().map(|seen| seen[0]).collect();
            println!(
                "{:7} {share:5} {:4} | {:9} {:5} | {linked:7.2} {solved:7.3} | {:.4} {:.4} | {:.4}",
                patches.len(),
                linking.rays,
                links.len(),
                links.bytes() >> 20,
                closure.iter().sum::<f32>() / closure.len() as f32,
                closure.iter().fold(1.0f32, |least, &seen| least.min(seen)),
                mean / closed,
            );
        }
    }
}

/// The room's inside and the boxes' outside.
struct Inside;

impl Surfaces for Inside {
    fn takes_part(&self, face: [u32; 2], side: Side) -> bool {
        (face[0] == 0) == (side == Side::Back)
    }

    fn reflectance(&self, _: &Patch) -> Spectrum {
        Spectrum::splat(REFLECTANCE)
    }
}

struct Boxes(Vec<[Vec3; 2]>);

impl Boxes {
    fn one(i: u32) -> [Vec3; 2] {
        let low = Vec3::new(0.5 + 1.9 * (i % 4) as f32, 0.05, 1.0 + 2.5 * (i / 4) as f32);
        [low, low + Vec3::new(0.9, 0.7 + 0.2 * (i % 3) as f32, 1.2)]
    }
}

impl Occlude for Boxes {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let inverse = segment.direction.recip();
        let meets = |[low, high]: &[Vec3; 2]| {
            let [a, b] = [*low, *high].map(|corner| (corner - segment.origin) * inverse);
            a.min(b).max_element().max(0.0) < a.max(b).min_element().min(segment.length)
        };
        if self.0.iter().any(meets) { Spectrum::ZERO } else { Spectrum::ONE }
    }
}

/// Counter-clockwise seen from outside.
fn cuboid(low: Vec3, high: Vec3) -> Mesh {
    let corner = |i: u32| {
        let share = Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32);
        low + share * (high - low)
    };
    let faces = [[0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh { positions: (0..8).map(corner).collect(), triangles, ..Mesh::default() }
}
