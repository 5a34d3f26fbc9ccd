//! Solids and set operations against the definition of what lies inside, and against closed forms.

use std::f64::consts::PI;

use glam::{DAffine3, DQuat, DVec3, Vec3};
use keikan_raytrace::solid::{Body, Crossing, Node, Plane, Shape, Solids, reference::outside};
use light::{Bodies, Nearest, Occlude, Ray, check};
use proptest::prelude::*;

fn solid(shape: Shape, world_from_solid: DAffine3) -> Node {
    Node::Solid { shape, world_from_solid, material: 0 }
}

fn bodies(nodes: Vec<Node>) -> Solids {
    let bodies = nodes.into_iter().map(|node| Body { node, medium: None }).collect();
    Solids::new(bodies, 0).expect("a body")
}

/// The box from `low` to `high`.
fn cuboid(low: DVec3, high: DVec3) -> Node {
    let (centre, half) = ((low + high) / 2.0, (high - low) / 2.0);
    solid(Shape::cube(), DAffine3::from_scale_rotation_translation(half, DQuat::IDENTITY, centre))
}

fn minus(whole: Node, cuts: Vec<Node>) -> Node {
    Node::Difference(Box::new(whole), cuts)
}

/// Numbers in [0, 1), the same in every run (SplitMix64).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / 9_007_199_254_740_992.0
    }

    fn within(&mut self, half: f64) -> DVec3 {
        DVec3::new(self.roll() - 0.5, self.roll() - 0.5, self.roll() - 0.5) * 2.0 * half
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.within(1.0);
            if v.length_squared() > 1e-4 && v.length_squared() <= 1.0 {
                return v.normalize();
            }
        }
    }

    fn placement(&mut self) -> DAffine3 {
        let turn = DQuat::from_axis_angle(self.direction(), self.roll() * 6.3);
        let scale = DVec3::new(0.3 + self.roll(), 0.3 + self.roll(), 0.3 + self.roll());
        let shear = DAffine3::from_mat3(glam::DMat3::from_cols(
            DVec3::X,
            DVec3::new(self.roll(), 1.0, 0.0),
            DVec3::Z,
        ));
        let mirror = if self.roll() < 0.3 { DVec3::new(1.0, -1.0, 1.0) } else { DVec3::ONE };
        DAffine3::from_scale_rotation_translation(scale * mirror, turn, self.within(0.7)) * shear
    }

    fn shape(&mut self) -> Shape {
        match (self.roll() * 5.0) as u32 {
            0 => Shape::Sphere,
            1 => Shape::Cylinder,
            2 => Shape::Cone,
            3 => Shape::Frustum { top: self.roll() * 2.0 },
            _ => Shape::cube(),
        }
    }

    fn node(&mut self, depth: u32) -> Node {
        if depth == 0 || self.roll() < 0.15 {
            return solid(self.shape(), self.placement());
        }
        let count = 1 + (self.roll() * 3.0) as usize;
        let nodes: Vec<Node> = (0..count).map(|_| self.node(depth - 1)).collect();
        match (self.roll() * 3.0) as u32 {
            0 => Node::Union(nodes),
            1 if depth < 4 => Node::Intersection(nodes),
            _ => minus(self.node(depth - 1), nodes),
        }
    }
}

/// Distance from its surface, in [`outside`]'s measure, within which a point of a scene of size 1 may be said
/// to be on either side: the reference inverts each placement and rounds some tens of times, 2⁻⁵³ each, and
/// placements here stretch by up to 10.
const ON: f64 = 1e-12;

/// Thinnest body or gap [m] that is one: chords are known to some 1e-15, and a hundred times more where they
/// end on steep faces. What coincides must leave nothing of this kind.
const SKIN: f64 = 1e-13;

/// Every stretch between walls is inside or outside as the definition says, at its middle and all along.
fn agrees(node: &Node, solids: &Solids, line: (DVec3, DVec3)) -> Result<usize, String> {
    let walls = solids.crossings(0, line);
    let mut ends: Vec<f64> = walls.iter().map(|wall| wall.t).collect();
    let mut after = f64::NEG_INFINITY;
    let one_by_one = std::iter::from_fn(|| {
        after = solids.meet(0, line, after)?;
        Some(after)
    });
    if !one_by_one.eq(ends.iter().copied()) {
        return Err(format!("met otherwise one by one on {line:?}: {walls:?}"));
    }
    ends.insert(0, -20.0);
    ends.push(20.0);
    for (index, pair) in ends.windows(2).enumerate() {
        let within = index % 2 == 1;
        if pair[1] - pair[0] <= SKIN {
            return Err(format!("skin of {:e} on {line:?}: {walls:?}", pair[1] - pair[0]));
        }
        for step in 0..=24 {
            let t = pair[0] + (pair[1] - pair[0]) * (0.5 + f64::from(step)) / 25.0;
            let depth = outside(node, line.0 + line.1 * t);
            if depth.abs() > ON && (depth < 0.0) != within {
                return Err(format!("{depth:e} at {t} of {line:?}: {walls:?}"));
            }
        }
    }
    for (index, Crossing { entering, normal, .. }) in walls.iter().enumerate() {
        let looks = normal.dot(line.1);
        // Seen edge-on the sign is rounding's.
        if *entering != (index % 2 == 0) || (looks < 0.0) != *entering && looks.abs() > 1e-6 {
            return Err(format!("turned wall on {line:?}: {walls:?}"));
        }
    }
    Ok(walls.len())
}

/// Lines of all kinds through a node; the number of walls met.
fn torture(node: &Node, seed: u64) -> usize {
    let solids = bodies(vec![node.clone()]);
    let mut dice = Dice(seed);
    let mut met = 0;
    for index in 0..400 {
        let direction = match index % 4 {
            0 => [DVec3::X, DVec3::NEG_Y, DVec3::Z][index / 4 % 3],
            _ => dice.direction(),
        };
        // Every other aim is on a lattice, where edges and faces of the solids below are.
        let aim = dice.within(1.2);
        let aim = if index % 2 == 0 { (aim * 4.0).round() / 4.0 } else { aim };
        met += agrees(node, &solids, (aim - direction * 5.0, direction))
            .unwrap_or_else(|wrong| panic!("{wrong}"));
    }
    met
}

#[test]
fn single_solids_are_where_they_are() {
    for shape in [
        Shape::Sphere,
        Shape::Cylinder,
        Shape::Cone,
        Shape::Frustum { top: 0.4 },
        Shape::Frustum { top: 1.7 },
        Shape::cube(),
    ] {
        assert!(torture(&solid(shape.clone(), DAffine3::IDENTITY), 1) > 100, "{shape:?}");
        let mut dice = Dice(2);
        for seed in 0..10 {
            torture(&solid(shape.clone(), dice.placement()), seed);
        }
    }
}

#[test]
fn faces_in_common_leave_no_skin() {
    let unit = cuboid(DVec3::ZERO, DVec3::ONE);
    let beside = cuboid(DVec3::X, DVec3::new(2.0, 1.0, 1.0));
    let half = cuboid(DVec3::ZERO, DVec3::new(0.5, 1.0, 1.0));
    let turn = DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let scale = DAffine3::from_scale(DVec3::new(0.5, 1.0, 0.5));
    let rod = |placement: DAffine3| solid(Shape::Cylinder, turn * placement);
    let cases = [
        minus(unit.clone(), vec![half.clone()]),
        minus(unit.clone(), vec![beside.clone()]),
        Node::Union(vec![unit.clone(), beside.clone()]),
        Node::Union(vec![unit.clone(), half.clone()]),
        Node::Intersection(vec![unit.clone(), half]),
        minus(rod(scale), vec![rod(scale * DAffine3::from_translation(DVec3::Y * 0.3))]),
        Node::Union(vec![rod(scale), rod(scale * DAffine3::from_translation(DVec3::Y))]),
        minus(rod(scale), vec![rod(scale * DAffine3::from_scale(DVec3::new(0.7, 1.0, 0.7)))]),
        Node::Intersection(vec![rod(scale), rod(scale * DAffine3::from_rotation_y(0.3))]),
    ];
    for (index, case) in cases.iter().enumerate() {
        assert!(torture(case, index as u64) > 50, "{index}");
    }
}

#[test]
fn nothing_is_left_of_what_is_cut_away() {
    let turn = DAffine3::from_axis_angle(DVec3::new(3.0, 2.0, 1.0).normalize(), 1.1);
    for shape in [Shape::Sphere, Shape::Cylinder, Shape::Cone, Shape::Frustum { top: 0.3 }, Shape::cube()] {
        let a = solid(shape.clone(), turn);
        // The same solid by other numbers: turned back and forth.
        let again = turn * DAffine3::from_rotation_y(0.9) * DAffine3::from_rotation_y(-0.9);
        let b = solid(shape.clone(), again);
        let far = solid(shape.clone(), DAffine3::from_translation(DVec3::splat(9.0)));
        let cases = [
            minus(a.clone(), vec![a.clone()]),
            minus(a.clone(), vec![b.clone()]),
            minus(Node::Union(vec![a.clone(), b.clone()]), vec![b.clone(), far.clone()]),
            Node::Intersection(vec![a.clone(), far.clone()]),
            Node::Intersection(vec![a.clone(), minus(far, vec![a.clone()])]),
            Node::Union(Vec::new()),
        ];
        for (index, case) in cases.iter().enumerate() {
            assert_eq!(torture(case, 5), 0, "{shape:?} {index}");
        }
    }
}

#[test]
fn tangent_solids_and_slivers() {
    let at = |x: f64| solid(Shape::Sphere, DAffine3::from_translation(DVec3::X * x));
    let thin = |by: f64| minus(at(0.0), vec![at(by)]);
    let touch = cuboid(DVec3::new(-1.0, 1.0, -1.0), DVec3::new(1.0, 1.5, 1.0));
    let cases = [
        Node::Union(vec![at(-1.0), at(1.0)]),
        Node::Intersection(vec![at(-1.0), at(1.0)]),
        minus(at(0.0), vec![at(2.0)]),
        Node::Union(vec![at(0.0), touch.clone()]),
        minus(touch, vec![at(0.0)]),
        thin(1e-3),
        thin(1e-6),
        thin(1e-9),
        Node::Intersection(vec![at(-1.0 + 1e-7), at(1.0 - 1e-7)]),
        solid(Shape::Sphere, DAffine3::from_scale(DVec3::new(1e-6, 1.0, 1.0))),
        solid(Shape::Cone, DAffine3::from_scale(DVec3::new(1e-6, 1.0, 1.0))),
    ];
    for (index, case) in cases.iter().enumerate() {
        let met = torture(case, index as u64);
        // A point of two balls is no room, and lines on a lattice miss a lens that is 0.9 mm wide.
        let expected = if [1, 8].contains(&index) { 0..=0 } else { 50..=usize::MAX };
        assert!(expected.contains(&met), "{index}: {met}");
    }
    let lens = bodies(vec![cases[8].clone()]);
    assert_eq!(agrees(&cases[8], &lens, (DVec3::X * -5.0, DVec3::X)), Ok(2));
}

/// 1/r on balls and on the sides of cylinders, 0 on what is flat, as far away as may be.
#[test]
fn faces_are_as_curved_as_their_radius_says() {
    for (radius, far) in [(1.0, 0.0), (0.1, 0.0), (20.0, 0.0), (0.5, 1e6)] {
        let place = DVec3::new(1.0, -0.4, 0.7) * far;
        let scaled = |shape, scale| {
            let of = DAffine3::from_translation(place) * DAffine3::from_scale(scale);
            bodies(vec![solid(shape, of)])
        };
        let curvature = |solids: &Solids, aim: DVec3, from: DVec3| {
            let from = (place + aim + from * 3.0 * radius).as_vec3();
            let way = (place + aim - from.as_dvec3()).normalize().as_vec3();
            let hit = solids.nearest(&Ray::new(from, way)).expect("a hit");
            f64::from(hit.curvature) * radius
        };
        let ball = scaled(Shape::Sphere, DVec3::splat(radius));
        let rod = scaled(Shape::Cylinder, DVec3::new(radius, 2.0 * radius, radius));
        let cube = scaled(Shape::cube(), DVec3::splat(radius));
        // By differences over δ = 1e-3 of the radius along the tangent: of order δ², some 1e-6; places at 1e6 m round by
        // 1e-10 m, 2e-7 of the step.
        let round = |found: f64| (found - 1.0).abs() < 1e-5;
        for from in [DVec3::X, DVec3::new(0.6, 0.0, -0.8), DVec3::new(-0.36, 0.48, 0.8)] {
            let (ball, rod) = (
                curvature(&ball, DVec3::ZERO, from),
                curvature(&rod, DVec3::Y * radius, from * DVec3::new(1.0, 0.0, 1.0)),
            );
            assert!(round(ball) && round(rod), "{radius} {far}: {ball} {rod}");
        }
        assert_eq!(curvature(&rod, DVec3::new(0.3, 1.0, 0.2) * radius, DVec3::Y), 0.0);
        assert_eq!(curvature(&cube, DVec3::ZERO, DVec3::X), 0.0);
    }
}

#[test]
fn deep_trees_of_anything() {
    let mut met = 0;
    for seed in 0..60 {
        let node = Dice(seed).node(6);
        met += torture(&node, seed + 100);
    }
    assert!(met > 5000, "{met}");
}

#[test]
fn more_members_than_fit_on_the_stack() {
    let mut dice = Dice(11);
    let some = |dice: &mut Dice| (0..20).map(|_| solid(dice.shape(), dice.placement())).collect::<Vec<_>>();
    let node = minus(Node::Union(some(&mut dice)), some(&mut dice));
    assert!(torture(&node, 1) > 100);
}

#[test]
fn polyhedra_of_any_half_spaces() {
    let mut dice = Dice(13);
    for seed in 0..40 {
        let count = 1 + (dice.roll() * 12.0) as usize;
        let Shape::Polyhedron(mut planes) = Shape::cube() else { unreachable!() };
        planes
            .extend((0..count).map(|_| Plane { normal: dice.direction() * 3.0, offset: 3.0 * dice.roll() }));
        // Some twice, some that touch nothing.
        planes.push(planes[0]);
        planes.push(Plane { normal: DVec3::ONE, offset: 9.0 });
        let node = solid(Shape::Polyhedron(planes), dice.placement());
        torture(&node, seed);
        let solids = bodies(vec![node.clone()]);
        let hull = &solids.hulls()[0];
        // Its own faces: corners lie on it (rounding of corners of nearly parallel planes: 1e-10 of its size),
        // edges join two faces each (Euler: V − E + F = 2 with 3 F = 2 E).
        assert!(hull.corners.iter().all(|&corner| outside(&node, corner).abs() < 1e-9));
        assert_eq!(2 * hull.corners.len(), hull.faces.len() + 4);
    }
}

#[test]
fn far_from_the_origin_nothing_changes_but_rounding() {
    // Moved by multiples of 2^-10 the placements are the same numbers there, rounded to 2^-33 m.
    let far = DAffine3::from_translation(DVec3::new(1_048_576.0, -524_288.0, 1_048_576.0));
    let mut dice = Dice(17);
    let mut compared = 0;
    for _ in 0..20 {
        let (shape, cutter) = (dice.shape(), dice.shape());
        let (a, b) = (dice.placement(), dice.placement());
        let make = |by: DAffine3| {
            bodies(vec![minus(solid(shape.clone(), by * a), vec![solid(cutter.clone(), by * b)])])
        };
        let (here, there) = (make(DAffine3::IDENTITY), make(far));
        for _ in 0..200 {
            let direction = dice.direction();
            let origin =
                (dice.within(1.0) * 1024.0).round() / 1024.0 - (direction * 5.0 * 1024.0).round() / 1024.0;
            let (near, moved) = (
                here.crossings(0, (origin, direction)),
                there.crossings(0, (origin + far.translation, direction)),
            );
            // 2^-33 m across a surface is so much more along the line as it is seen edge-on; rims may appear.
            if near.iter().any(|wall| wall.normal.dot(direction).abs() < 1e-3) || near.len() != moved.len() {
                continue;
            }
            for (p, q) in near.iter().zip(&moved) {
                let across = (p.t - q.t).abs() * p.normal.dot(direction).abs();
                // Three placements' coordinates round, and points do: 8 of these steps bound it.
                assert!(across <= 8.0 * 2f64.powi(-33), "{p:?} {q:?}");
                compared += 1;
            }
        }
    }
    assert!(compared > 1000, "{compared}");
}

#[test]
fn closed_forms() {
    let ball = bodies(vec![solid(Shape::Sphere, DAffine3::IDENTITY)]);
    let t: Vec<f64> =
        ball.crossings(0, (DVec3::new(0.6, 0.0, 5.0), DVec3::NEG_Z)).iter().map(|c| c.t).collect();
    // √(1 − 0.6²) = 0.8; 0.6² rounds, and so do the sum with 5 and the root: 4 u · 5.
    assert!((t[0] - 4.2).abs() <= 4.0 * 5.0 * f64::EPSILON && (t[1] - 5.8).abs() <= 4.0 * 5.0 * f64::EPSILON);
    let cone = bodies(vec![solid(Shape::Cone, DAffine3::IDENTITY)]);
    let t: Vec<f64> =
        cone.crossings(0, (DVec3::new(-3.0, 0.25, 0.0), DVec3::X)).iter().map(|c| c.t).collect();
    assert_eq!(t, [2.25, 3.75]); // every step is exact in binary
}

#[test]
fn a_ball_seen_along_parallel_rays_has_the_area_of_its_circle() {
    let radius = 0.37;
    let ball = bodies(vec![solid(Shape::Sphere, DAffine3::from_scale(DVec3::splat(radius)))]);
    // Rows of a scan; on each the ends of what the ball covers are found by bisection, as on a scanline.
    let covered = |y: f64| {
        let hit = |x: f64| ball.meet(0, (DVec3::new(x, y, 9.0), DVec3::NEG_Z), 0.0).is_some();
        let (mut inside, mut out) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (inside + out);
            if hit(middle) { inside = middle } else { out = middle }
        }
        2.0 * inside
    };
    // With y = r sin θ the integral of the widths is ∫ 2 r² cos² θ dθ, periodic: the trapezoid rule is exact
    // from 3 steps on. What is left is bisection (2⁻⁶⁰), rays that graze by less than their error (below
    // 1e-13 m), and rounding.
    let steps = 32;
    let area: f64 = (0..steps)
        .map(|i| {
            let theta = -PI / 2.0 + PI * f64::from(i) / f64::from(steps);
            covered(radius * theta.sin()) * radius * theta.cos() * PI / f64::from(steps)
        })
        .sum();
    assert!((area - PI * radius * radius).abs() < 1e-12, "{area}");
}

#[test]
fn a_million_metres_away_the_error_is_stated() {
    let mut dice = Dice(7);
    for centre in [DVec3::ZERO, DVec3::new(1e6, -1e6, 1e6)] {
        let ball = bodies(vec![solid(Shape::Sphere, DAffine3::from_translation(centre))]);
        for _ in 0..2000 {
            let toward = dice.direction();
            let ray_origin = (centre + dice.direction() * 1e6).as_vec3();
            let target = centre + toward * 0.9;
            let direction = (target - ray_origin.as_dvec3()).normalize().as_vec3();
            let Some(hit) = ball.nearest(&Ray::new(ray_origin, direction)) else { continue };
            let off = (hit.place.position.as_dvec3() - centre).length() - 1.0;
            // The place's error is per coordinate: across the surface up to √3 of it.
            assert!(off.abs() <= 3f64.sqrt() * f64::from(hit.place.error), "{off} {hit:?}");
            // Neither is it much more than the rounding of the position to f32 and what the distance of 10⁶ m
            // costs in f64: 2 · 24 √3 · 2⁻⁵³ · |o − c|, which is up to √3 · 10⁶ m and as much again for |c|.
            let reach = f64::from(hit.place.position.abs().max_element());
            assert!(
                f64::from(hit.place.error) <= 6.0e-8 * reach + 2.0 * 24.0 * 3f64.sqrt() * 1.11e-16 * 3.5e6,
                "{hit:?}"
            );
        }
    }
}

#[test]
fn rays_that_leave_a_body_do_not_meet_it_again() {
    for offset in [DVec3::ZERO, DVec3::new(1e6, 2e5, -3e5)] {
        let ball = bodies(vec![solid(Shape::Sphere, DAffine3::from_translation(offset))]);
        let mut dice = Dice(3);
        let mut left = 0;
        for _ in 0..20_000 {
            let aim = offset + dice.within(0.8);
            let origin = (aim + dice.direction() * 4.0).as_vec3();
            let direction = (aim - origin.as_dvec3()).normalize().as_vec3();
            let Some(hit) = ball.nearest(&Ray::new(origin, direction)) else { continue };
            let away = dice.direction().as_vec3();
            let away = if away.dot(hit.place.normal) < 0.0 { -away } else { away };
            // The ball's own curve falls away from the plane, so nothing of it is ahead.
            assert!(ball.nearest(&hit.place.leave(away, f32::INFINITY)).is_none(), "{hit:?} {away}");
            // And inside there is one wall, ahead, seen from within.
            if let Some(back) = ball.nearest(&hit.place.leave(-away, f32::INFINITY)) {
                assert!(!back.front);
            }
            left += 1;
        }
        assert!(left > 10_000);
    }
}

#[test]
fn cut_faces_have_the_cutters_material_and_face_out() {
    let cutter = Node::Solid {
        shape: Shape::Sphere,
        world_from_solid: DAffine3::from_translation(DVec3::X),
        material: 7,
    };
    let block = Node::Solid { shape: Shape::cube(), world_from_solid: DAffine3::IDENTITY, material: 3 };
    let solids = bodies(vec![minus(block, vec![cutter])]);
    let hit = solids.nearest(&Ray::new(Vec3::new(5.0, 0.0, 0.0), Vec3::NEG_X)).expect("the hollow");
    assert_eq!((hit.material, hit.front, hit.place.normal), (7, true, Vec3::X));
    assert_eq!(hit.distance, 5.0);
    let back = solids.nearest(&Ray::new(Vec3::new(-0.5, 0.0, 0.0), Vec3::X)).expect("from within");
    assert_eq!((back.material, back.front, back.place.normal), (7, false, Vec3::NEG_X));
}

#[test]
fn faults_name_the_body_and_the_way_to_it() {
    let flat = solid(Shape::Sphere, DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0)));
    let node = minus(solid(Shape::Sphere, DAffine3::IDENTITY), vec![Node::Union(vec![flat])]);
    let good = Body { node: solid(Shape::Cone, DAffine3::IDENTITY), medium: None };
    let fault = Solids::new(vec![good, Body { node, medium: None }], 0).expect_err("a flat ball");
    assert_eq!(fault.to_string(), "body 1, member 1.0: the placement cannot be inverted");
    let wrong = |shape| {
        let node = solid(shape, DAffine3::IDENTITY);
        Solids::new(vec![Body { node, medium: None }], 0).expect_err("wrong").to_string()
    };
    let side = |normal, offset| Plane { normal, offset };
    assert!(wrong(Shape::Frustum { top: -1.0 }).contains("ratio"));
    assert!(wrong(Shape::Polyhedron(vec![side(DVec3::ZERO, 1.0)])).contains("normal"));
    assert!(wrong(Shape::Polyhedron(vec![side(DVec3::X, 1.0), side(DVec3::NEG_X, 1.0)])).contains("close"));
    let mut none = vec![side(DVec3::X, -1.0), side(DVec3::NEG_X, -1.0)];
    none.extend([DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z].map(|n| side(n, 1.0)));
    assert!(wrong(Shape::Polyhedron(none)).contains("common"));
}

proptest! {
    #[test]
    fn hulls_contain_their_bodies(seed in any::<u64>()) {
        let mut dice = Dice(seed);
        let node = dice.node(2);
        let solids = bodies(vec![node.clone()]);
        for _ in 0..200 {
            let p = dice.within(2.0);
            if outside(&node, p) < -ON {
                let within = |hull: &light::Hull| hull.faces.iter().all(|f| {
                    let [a, b, c] = f.map(|i| hull.corners[i as usize]);
                    (b - a).cross(c - a).dot(p - a) <= 0.0
                });
                prop_assert!(solids.hulls().iter().any(within), "{p} {node:?}");
            }
        }
    }

    #[test]
    fn light_goes_both_ways(seed in any::<u64>()) {
        let mut dice = Dice(seed);
        let solids = bodies((0..5).map(|_| dice.node(2)).collect());
        for _ in 0..50 {
            let segment = Ray::between(dice.within(2.0).as_vec3(), dice.within(2.0).as_vec3());
            prop_assert_eq!(check::reciprocity(&solids, &segment), 0.0);
            prop_assert_eq!(solids.transmittance(&segment).max() == 0.0, solids.nearest(&segment).is_some());
        }
    }
}
