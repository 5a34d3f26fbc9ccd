//! What is answered, against what is known.

use super::*;
use crate::{Description, Distribution, Dome, Luminous};

#[test]
fn linear_light_is_exact_and_needs_no_cells() {
    let gradient = Vec3::new(0.03, 0.01, -0.02);
    let linear = move |p: Vec3, _: Vec3| 0.5 + gradient.dot(p);
    let corners = [Vec3::new(-3.0, 0.2, 1.0), Vec3::new(2.0, 1.0, 4.0), Vec3::new(5.0, -1.0, -4.0)];
    let geometry = still(mesh(&corners, &[[0, 1, 2]]));
    let fake = Fake::new(linear);
    let loose = mapped(fake.clone(), &geometry, Settings { coarse: 20.0, ..EXACT });
    let inset = mapped(Fake::new(linear), &geometry, Settings { inset: 0.01, ..EXACT });
    for i in 0..1000 {
        let [v, w] = light::sampling::lattice(i, 1000, [0, 0]);
        let (v, w) = if v + w > 1.0 { (1.0 - v, 1.0 - w) } else { (v, w) };
        let p = corners[0] + (corners[1] - corners[0]) * v + (corners[2] - corners[0]) * w;
        let at = |map| share(map, [0, 0], p, Vec3::Y);
        // Six roundings of numbers up to 1, and of positions up to 5 m times the gradient.
        assert!((at(&loose) - linear(p, Vec3::Y)).abs() <= 8.0 * f32::EPSILON);
        // Points are moved by 4 × inset at most.
        assert!((at(&inset) - linear(p, Vec3::Y)).abs() <= 0.04 * gradient.length() + 8.0 * f32::EPSILON);
    }
    // Three corners, and each edge's middle to see that it is straight.
    assert_eq!(fake.asked.load(Ordering::Relaxed), 6);
}

/// Root mean square of a map's error over a lawn of 20 m, share of points that are off by more than the tolerance,
/// points of the map.
fn error(map: &Mapped, truth: impl Fn(Vec3, Vec3) -> f32, mut off: impl FnMut(Vec3)) -> (f64, f64, usize) {
    let (mut square, mut beyond) = (0.0, 0.0);
    let count = 20_000;
    for i in 0..count {
        let [x, z] = light::sampling::lattice(i, count, [0, 0]).map(|x| 20.0 * x - 10.0);
        let p = Vec3::new(x, 0.0, z);
        let e = share(map, [0, u32::from(x > z)], p, Vec3::Y) - truth(p, Vec3::Y);
        square += f64::from(e * e);
        if e.abs() > EXACT.tolerance {
            beyond += 1.0;
            off(p);
        }
    }
    ((square / f64::from(count)).sqrt(), beyond / f64::from(count), map.size()[1])
}

#[test]
fn beside_an_edge_of_shadow_only_the_finest_cells_are_off() {
    let step = |p: Vec3, _: Vec3| if p.x + 0.3 * p.z > 1.0 { 1.0 } else { 0.1 };
    let map = mapped(Fake::new(step), &still(lawn(20.0)), EXACT);
    let (rms, beyond, points) = error(&map, step, |p| {
        let distance = (p.x + 0.3 * p.z - 1.0).abs() / 1.0f32.hypot(0.3);
        // Two edges that cross the step meet at each point of such a cell; both are shorter than 2 × least.
        assert!(distance <= 2.0 * EXACT.least, "{p}: {distance} m");
    });
    println!("step: rms {rms:.4}, {:.2} % of points off, {points} points", 100.0 * beyond);
    // A band of ± 2 × least along 20.9 m of edge in 400 m².
    assert!(beyond <= 20.9 * 4.0 * 0.1 / 400.0);
    assert!(rms <= beyond.sqrt());
}

#[test]
fn soft_edges_and_spots_stay_within_the_tolerance_nearly_everywhere() {
    let edge = |p: Vec3, _: Vec3| ((p.x + 0.3 * p.z - 1.0) / 1.5).clamp(0.0, 1.0);
    let spot = |p: Vec3, _: Vec3| 1.0 - 0.8 * (-(p - Vec3::new(2.0, 0.0, -3.0)).length_squared() / 4.0).exp();
    for (name, field) in [("soft edge", edge as fn(Vec3, Vec3) -> f32), ("spot", spot)] {
        let map = mapped(Fake::new(field), &still(lawn(20.0)), EXACT);
        let (rms, beyond, points) = error(&map, field, |_| {});
        println!("{name}: rms {rms:.4}, {:.2} % of points off, {points} points", 100.0 * beyond);
        // The middle of an edge is where an even bend shows most; a kink may hide from it.
        assert!(rms <= f64::from(EXACT.tolerance) / 2.0 && beyond <= 0.02, "{name}: {rms} {beyond}");
    }
}

#[test]
fn both_sides_are_themselves() {
    let sided = |_: Vec3, n: Vec3| if n.y > 0.0 { 0.75 } else { 0.25 };
    let mirrored = DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)));
    for world_from_mesh in [DAffine3::IDENTITY, mirrored] {
        let fake = Fake::new(sided);
        let map = mapped(fake.clone(), &placed(lawn(4.0), world_from_mesh), EXACT);
        let p = Vec3::new(0.5, 0.0, 0.7);
        assert_eq!(ask(&map, [0, 0], p, Vec3::Y), open(Vec3::Y) * 0.75);
        let asked = fake.asked.load(Ordering::Relaxed);
        assert_eq!(ask(&map, [0, 0], p, Vec3::NEG_Y), open(Vec3::NEG_Y) * 0.25);
        assert!(fake.asked.load(Ordering::Relaxed) > asked, "the back is made by itself");
        // Normals that lean get their own open sky.
        let leaning = Vec3::new(0.6, 0.8, 0.0);
        assert_eq!(ask(&map, [0, 0], p, leaning), open(leaning) * 0.75);
    }
}

#[test]
fn places_on_no_face_ask_the_sky_itself() {
    let fake = Fake::new(|_: Vec3, _: Vec3| 0.5);
    let flat = mesh(&[Vec3::ZERO, Vec3::X, Vec3::X * 2.0], &[[0, 1, 2], [1, 1, 1]]);
    let map = mapped(fake.clone(), &still(flat), EXACT);
    map.prepare(&Vacuum, &[Side::Front, Side::Back]);
    assert_eq!(map.size()[0], 0, "nothing has an area");
    for (i, face) in [[0, 0], [0, 1], [0, 2], [1, 0], [u32::MAX; 2]].into_iter().enumerate() {
        assert_eq!(ask(&map, face, Vec3::X, Vec3::Y), open(Vec3::Y) * 0.5);
        assert_eq!(fake.asked.load(Ordering::Relaxed), i + 1);
    }
    let place = Place { position: Vec3::X, error: 0.0, normal: Vec3::Y, seed: 0 };
    assert_eq!(map.irradiance(&place, &Vacuum), open(Vec3::Y) * 0.5);
}

#[test]
fn a_million_metres_away_light_is_the_same_to_the_positions_rounding() {
    let far = Vec3::new(1e6, 0.0, -1e6);
    let field = |p: Vec3, _: Vec3| 0.5 + 0.3 * (0.2 * p.x).sin();
    let near = mapped(Fake::new(field), &still(lawn(40.0)), EXACT);
    let away = Fake::new(move |p: Vec3, n: Vec3| field(p - far, n));
    let away = mapped(away, &placed(lawn(40.0), DAffine3::from_translation(far.as_dvec3())), EXACT);
    for i in 0..200 {
        let [x, z] = light::sampling::lattice(i, 200, [0, 0]).map(|x| (38.0 * x - 19.0).round());
        let p = Vec3::new(x, 0.0, z);
        let face = [0, u32::from(x > z)];
        let [here, there] = [share(&near, face, p, Vec3::Y), share(&away, face, p + far, Vec3::Y)];
        // 1/32 m of rounding of mesh points times the steepest slope, 0.06/m, and both meshes' tolerance.
        assert!((here - there).abs() <= 0.06 / 32.0 + 2.0 * EXACT.tolerance, "{here} {there}");
    }
}

/// A solid that fills x ≤ 0: what starts within it sees next to nothing.
struct Wall;

impl Occlude for Wall {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        if segment.origin.x <= 0.0 {
            return Spectrum::splat(0.01);
        }
        if segment.direction.x < 0.0 { Spectrum::ZERO } else { Spectrum::ONE }
    }
}

#[test]
fn points_at_the_foot_of_a_wall_see_its_half_of_the_sky() {
    let overcast = Arc::new(Luminous::new(Distribution::MoonSpencer, Vec3::Y));
    let dome = Dome::new(&Description { samples: 1024, ..Description::new(overcast) });
    let corners = [Vec3::ZERO, Vec3::Z * 6.0, Vec3::X * 6.0];
    let place = Place { position: Vec3::new(0.0, 0.0, 2.0), error: 1e-6, normal: Vec3::Y, seed: 0 };
    let dome: Arc<Dome> = Arc::new(dome);
    let lit = |inset: f32| {
        let map =
            mapped(Arc::clone(&dome) as _, &still(mesh(&corners, &[[0, 1, 2]])), Settings { inset, ..EXACT });
        let mut sum = Spectrum::ZERO;
        map.arrivals_on([0, 0], &place, &Wall, &mut |arrival| sum += arrival.on_plane(Vec3::Y));
        sum[0] / dome.open_irradiance(Vec3::Y)[0]
    };
    assert!(lit(0.0) < 0.02);
    // Half of an overcast sky; evenly spread directions do better than independent ones, 1/√1024.
    assert!((lit(0.01) - 0.5).abs() < 0.5 / 32.0, "{}", lit(0.01));
}

#[test]
fn a_box_on_a_lawn_has_no_dark_rim() {
    let inside = |p: Vec3| (p.x - 1.3).abs() < 1.57 && (p.z + 2.1).abs() < 2.33;
    let near = move |p: Vec3, _: Vec3| {
        let gap = ((p.x - 1.3).abs() - 1.57).max((p.z + 2.1).abs() - 2.33);
        if inside(p) { 0.0 } else { 1.0 - 0.5 * (-gap).exp() }
    };
    let map = mapped(Fake::new(near), &still(lawn(20.0)), EXACT);
    let mut worst = 0.0f32;
    error(&map, near, |p| {
        // Of the seam between both faces only points on the seam help each other.
        if !inside(p) && (p.x - p.z).abs() > 0.4 {
            worst = worst.max((share(&map, [0, u32::from(p.x > p.z)], p, Vec3::Y) - near(p, Vec3::Y)).abs());
        }
    });
    // The field falls by 0.5 a metre beside the box; neighbours are at most 2 × least away on either side.
    assert!(worst <= 0.5 * 4.0 * EXACT.least + EXACT.tolerance, "{worst}");
    // Without any lit neighbour what is dark stays so.
    assert_eq!(share(&map, [0, 1], Vec3::new(1.3, 0.0, -2.1), Vec3::Y), 0.0);
}
