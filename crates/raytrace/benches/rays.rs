//! Rays per second on a terrain of a million triangles, beside obvhs' own traversals in the same run.
//!
//! `cargo bench -p keikan-raytrace`. The scene: 4 × 4 km of ridged fractal terrain, 708 × 708 cells. Primary rays
//! of a picture of 1280 × 800 in tiles of 16 × 16; from its hits a cosine-weighted bounce in the order of the tiles
//! (*diff*) and in random order (*shuf*), the way to a sun 32° high (*sun*) and to the sky (*sky*). One thread;
//! each figure is the median of five passes of thread time after one to warm up, ray set-up included.
//! `-- quick` measures [`Quality::Medium`] alone. `-- leaks` shoots four million rays at corners, edges and insides of the terrain instead: each must hit.

use std::{
    f64::consts::PI,
    hint::black_box,
    sync::Arc,
    time::{Duration, Instant},
};

use glam::{DAffine3, DVec3, Vec2, Vec3, Vec3A};
use keikan_raytrace::{Quality, World};
use light::{Geometry, Instance, Mesh, Occlude, Ray, View};
use obvhs::{
    BvhBuildParams, bvh2::builder::build_bvh2_from_tris, cwbvh::builder::build_cwbvh_from_tris, ray::RayHit,
    rt_triangle::RtTriangle, triangle::Triangle,
};

const CELLS: usize = 708;
const SIDE: f32 = 4000.0;

/// A reproducible number in [0, 1) (splitmix64).
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Smooth noise in [-1, 1] over the unit lattice.
fn noise(at: Vec2, octave: u64) -> f32 {
    let cell = at.floor();
    let f = at - cell;
    let f = f * f * (Vec2::splat(3.0) - 2.0 * f);
    let corner = |dx: f32, dy: f32| {
        let mut seed = (((cell.x + dx) as i64 as u64) << 32)
            ^ ((cell.y + dy) as i64 as u64 & 0xffff_ffff)
            ^ (octave << 60);
        random(&mut seed) as f32 * 2.0 - 1.0
    };
    let (a, b) = (corner(0.0, 0.0), corner(1.0, 0.0));
    let (c, d) = (corner(0.0, 1.0), corner(1.0, 1.0));
    let (low, high) = (a + (b - a) * f.x, c + (d - c) * f.x);
    low + (high - low) * f.y
}

/// Height of ridged fractal noise [m].
fn height(at: Vec2) -> f32 {
    let (mut sum, mut size, mut scale) = (0.0, 300.0, 1.0 / 1200.0);
    for octave in 0..9 {
        sum += size * (1.0 - noise(at * scale, octave).abs());
        size *= 0.5;
        scale *= 2.0;
    }
    sum - 200.0
}

fn terrain() -> Mesh {
    let step = SIDE / CELLS as f32;
    let row = CELLS as u32 + 1;
    let position = |i: u32| {
        let at = Vec2::new((i % row) as f32, (i / row) as f32) * step - SIDE / 2.0;
        Vec3::new(at.x, height(at), at.y)
    };
    let cell = |i: u32| {
        let a = i / CELLS as u32 * row + i % CELLS as u32;
        [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]
    };
    Mesh {
        positions: (0..row * row).map(position).collect(),
        triangles: (0..(CELLS * CELLS) as u32).flat_map(cell).collect(),
        ..Mesh::default()
    }
}

/// Primary rays in tiles of 16 × 16.
fn primary() -> Vec<Ray> {
    let view =
        View::look_at(DVec3::new(-1900.0, 750.0, -1900.0), DVec3::new(0.0, 300.0, 0.0), 45.0, 1280, 800);
    let tile = |t: u32| (0..256).map(move |i| (t % 80 * 16 + i % 16, t / 80 * 16 + i / 16));
    (0..80 * 50)
        .flat_map(tile)
        .map(|(x, y)| view.ray(glam::DVec2::new(x as f64 + 0.5, y as f64 + 0.5)))
        .collect()
}

/// A cosine-weighted direction about `normal`.
fn cosine(normal: Vec3, state: &mut u64) -> Vec3 {
    let (u, v) = (random(state), random(state));
    let (x, z) = normal.any_orthonormal_pair();
    let (sin, cos) = (2.0 * PI * v).sin_cos();
    let r = u.sqrt();
    (x * (r * cos) as f32 + z * (r * sin) as f32 + normal * (1.0 - u).sqrt() as f32).normalize()
}

/// Time this thread has been running, where the system tells; else time on the wall.
fn clock() -> Duration {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let told = told.and_then(|text| text.split(' ').next().and_then(|ns| ns.parse().ok()));
    told.map_or_else(|| std::time::SystemTime::UNIX_EPOCH.elapsed().unwrap_or_default(), Duration::from_nanos)
}

/// Median of five passes, Mrays/s, and how many rays `meets` was true for.
fn rate(rays: &[Ray], meets: impl Fn(&Ray) -> bool) -> (f64, usize) {
    let mut hits = 0;
    let mut seconds: Vec<f64> = (0..6)
        .map(|_| {
            let start = clock();
            hits = rays.iter().filter(|ray| meets(black_box(ray))).count();
            (clock() - start).as_secs_f64()
        })
        .skip(1)
        .collect();
    seconds.sort_by(f64::total_cmp);
    (rays.len() as f64 / seconds[2] * 1e-6, hits)
}

struct Sets {
    names: [&'static str; 5],
    rays: [Vec<Ray>; 5],
}

fn sets(world: &World) -> Sets {
    use light::Nearest;
    let primary = primary();
    let hits: Vec<_> = primary.iter().filter_map(|ray| world.nearest(ray)).collect();
    let mut state = 1;
    let mut bounce = || -> Vec<Ray> {
        let leave = |hit: &light::Hit| hit.place.leave(cosine(hit.place.normal, &mut state), f32::INFINITY);
        hits.iter().map(leave).collect()
    };
    let (diff, sky) = (bounce(), bounce());
    let mut shuf = diff.clone();
    for i in (1..shuf.len()).rev() {
        shuf.swap(i, (random(&mut state) * (i + 1) as f64) as usize);
    }
    let (sin, cos) = 32f32.to_radians().sin_cos();
    let toward = Vec3::new(cos * 0.6, sin, cos * 0.8);
    let sun = hits.iter().map(|hit| hit.place.leave(toward, f32::INFINITY)).collect();
    Sets { names: ["primary", "diff", "shuf", "sun", "sky"], rays: [primary, diff, shuf, sun, sky] }
}

fn theirs(ray: &Ray) -> obvhs::ray::Ray {
    obvhs::ray::Ray::new(ray.origin.into(), ray.direction.into(), 0.0, ray.length)
}

fn row(name: &str, figures: [(f64, usize); 5]) {
    let rates: String = figures.iter().map(|(rate, _)| format!(" {rate:8.2}")).collect();
    let hits: Vec<usize> = figures.iter().map(|figure| figure.1).collect();
    println!("{name:34}{rates}   hits {hits:?}");
}

fn stock(mesh: &Mesh, sets: &Sets) {
    let corners = |t: &[u32; 3]| t.map(|i| Vec3A::from(mesh.positions[i as usize]));
    let triangles: Vec<Triangle> =
        mesh.triangles.iter().map(corners).map(|[v0, v1, v2]| Triangle { v0, v1, v2 }).collect();
    let mut took = Duration::ZERO;
    let cw = build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), &mut took);
    let ordered = |indices: &[u32]| -> Vec<RtTriangle> {
        indices.iter().map(|&i| (&triangles[i as usize]).into()).collect()
    };
    let own = ordered(&cw.primitive_indices);
    let closest =
        |ray: &Ray| cw.ray_traverse(theirs(ray), &mut RayHit::none(), |ray, i| own[i].intersect(ray));
    let any = |ray: &Ray| !cw.ray_traverse_miss(theirs(ray), |ray, i| own[i].intersect(ray));
    let rates = |i: usize| if i < 3 { rate(&sets.rays[i], closest) } else { rate(&sets.rays[i], any) };
    row("obvhs CWBVH, its own triangles", std::array::from_fn(rates));
    let two = build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), &mut took);
    let own = ordered(&two.primitive_indices);
    let closest =
        |ray: &Ray| two.ray_traverse(theirs(ray), &mut RayHit::none(), |ray, i| own[i].intersect(ray));
    let any = |ray: &Ray| !two.ray_traverse_miss(theirs(ray), |ray, i| own[i].intersect(ray));
    let rates = |i: usize| if i < 3 { rate(&sets.rays[i], closest) } else { rate(&sets.rays[i], any) };
    row("obvhs BVH2, its own triangles", std::array::from_fn(rates));
}

/// Rays from above, aimed at corners, middles of edges and random places: how many find no triangle.
fn leaks(mesh: &Mesh, world: &World) {
    let mut state = 7;
    let inner = |p: &Vec3| p.x.abs().max(p.z.abs()) < SIDE / 2.0 - 10.0;
    let mut missed = [0usize; 4];
    let mut shot = [0usize; 4];
    let mut shoot = |kind: usize, target: Vec3, state: &mut u64| {
        let straight = kind == 3;
        let up = Vec3::new(random(state) as f32 - 0.5, 1.0, random(state) as f32 - 0.5);
        let from = if straight { Vec3::Y } else { up } * 1500.0 + target;
        shot[kind] += 1;
        let ray =
            if straight { Ray::new(from, Vec3::NEG_Y) } else { Ray::new(from, (target - from).normalize()) };
        missed[kind] += usize::from(world.first(&ray).is_none());
    };
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
        if ![a, b, c].iter().all(inner) {
            continue;
        }
        shoot(0, a, &mut state);
        shoot(1, (a + b) * 0.5, &mut state);
        let (u, v) = (random(&mut state) as f32, random(&mut state) as f32);
        let inside = a + (b - a) * u.min(v) + (c - a) * (1.0 - u.max(v));
        shoot(2, inside, &mut state);
        shoot(3, if u < 0.5 { a } else { inside }, &mut state);
    }
    for (kind, name) in ["corners", "edges", "inside", "straight down"].into_iter().enumerate() {
        println!("{name:14} {:9} rays, {} missed", shot[kind], missed[kind]);
    }
}

fn main() {
    let mesh = terrain();
    let once = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
    let geometry = Arc::new(Geometry { meshes: vec![mesh.clone()], instances: vec![once] });
    let world = World::build(geometry.clone(), Quality::Medium);
    println!("{:?}", world.stats());
    if std::env::args().any(|arg| arg == "leaks") {
        return leaks(&mesh, &world);
    }
    let sets = sets(&world);
    println!(
        "{:34} {:>8} {:>8} {:>8} {:>8} {:>8}",
        "Mrays/s, one thread", sets.names[0], sets.names[1], sets.names[2], sets.names[3], sets.names[4]
    );
    let quick = std::env::args().any(|arg| arg == "quick");
    for quality in Quality::ALL.into_iter().skip(usize::from(quick)).take(if quick { 1 } else { 3 }) {
        let start = Instant::now();
        let world = World::build(geometry.clone(), quality);
        let built = start.elapsed().as_secs_f64();
        let closest = |ray: &Ray| world.first(ray).is_some();
        let any = |ray: &Ray| world.transmittance(ray).is_zero();
        let rates = |i: usize| if i < 3 { rate(&sets.rays[i], closest) } else { rate(&sets.rays[i], any) };
        row(&format!("ours, {quality:?} ({built:.2} s)"), std::array::from_fn(rates));
    }
    stock(&mesh, &sets);
    println!(
        "Embree 4.4 robust, Sapphire Rapids     6.12     3.72     2.86     4.92     3.76   (another machine)"
    );
}
