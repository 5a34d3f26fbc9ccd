//! Shadow intervals of solids against rays, and the two ways of searching against each other.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3, Vec3};
use keikan_raytrace::solid::{Acceleration, Body, Node, Shape, Solids};
use light::{Bodies, Medium, Nearest, Occlude, PointSource, Ray, Spectrum, Stretch, check, fresnel};

fn at(shape: Shape, scale: f64, place: DVec3) -> Node {
    let world_from_solid = DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(scale)), place);
    Node::Solid { shape, world_from_solid, material: 0 }
}

/// A number in [0, 1) for each index: the fractional parts of multiples of an irrational.
fn spread(index: u32, by: f64) -> f64 {
    (f64::from(index) * by + 0.37).fract()
}

fn place(index: u32) -> DVec3 {
    DVec3::new(spread(index, 0.819_172_51), spread(index, 0.671_043_61), spread(index, 0.549_700_48)) * 6.0
        - 3.0
}

fn garden() -> Vec<Body> {
    let mut nodes: Vec<Node> = (0..40u32)
        .map(|i| {
            let shape = match i % 5 {
                0 => Shape::Sphere,
                1 => Shape::Cylinder,
                2 => Shape::Cone,
                3 => Shape::Frustum { top: 1.5 },
                _ => Shape::cube(),
            };
            at(shape, 0.1 + 0.3 * spread(i, 0.41), place(i))
        })
        .collect();
    let ring = Node::Difference(
        Box::new(at(Shape::Sphere, 0.8, DVec3::ZERO)),
        vec![at(Shape::cube(), 0.5, DVec3::ZERO)],
    );
    nodes.push(ring);
    nodes.into_iter().map(|node| Body { node, medium: None }).collect()
}

#[test]
fn boxes_change_no_answer() {
    let fast = Solids::new(garden(), 3).expect("bodies");
    let plain = fast.clone().with(Acceleration::None);
    let mut met = 0;
    for index in 0..20_000 {
        let segment = Ray::between(place(index).as_vec3() * 1.5, place(index + 7).as_vec3());
        let segment = if index % 2 == 0 { segment } else { Ray::new(segment.origin, segment.direction) };
        let hit = fast.nearest(&segment);
        assert_eq!(hit, plain.nearest(&segment));
        assert_eq!(fast.transmittance(&segment), plain.transmittance(&segment));
        // What is in the way is what is met first.
        assert_eq!(fast.transmittance(&segment).is_zero(), hit.is_some());
        met += u32::from(hit.is_some());
    }
    assert!(met > 5000, "{met}");
}

/// Suns of all heights, suns along the axes, lamps.
fn source(index: u32) -> PointSource {
    match index % 3 {
        0 => PointSource::Toward((place(index + 2) * DVec3::new(1.0, 0.0, 1.0) + DVec3::Y).normalize()),
        1 => PointSource::Toward([DVec3::X, DVec3::NEG_Z, DVec3::Y][index as usize / 3 % 3]),
        _ => PointSource::At(place(index + 2)),
    }
}

#[test]
fn of_light_from_a_plane_bodies_tell_only_that_they_are_not_below_it() {
    let ball = Body { node: at(Shape::Sphere, 1.0, DVec3::new(0.0, 3.0, 0.0)), medium: None };
    let solids = Solids::new(vec![ball], 0).expect("a ball");
    let (a, b) = (DVec3::new(-2.0, 0.0, 0.0), DVec3::new(2.0, 0.0, 0.0));
    let told = |level: f64| {
        let mut out = Vec::new();
        let told = solids.shadows(&PointSource::Below { toward: DVec3::Y, level }, a, b, &mut out);
        assert!(out.is_empty());
        told
    };
    assert!(told(1.9) && !told(2.1) && !told(9.0));
}

#[test]
fn shadow_intervals_agree_with_rays() {
    let glass = Arc::new(Medium { index: 1.5, ..Medium::default() });
    for medium in [None, Some(glass)] {
        let clear = medium.is_some();
        let bodies = garden().into_iter().map(|body| Body { medium: medium.clone(), ..body }).collect();
        let fast = Solids::new(bodies, 0).expect("bodies");
        let plain = fast.clone().with(Acceleration::None);
        let (mut lit, mut shaded) = (0, 0);
        for index in 0..3000 {
            let (a, b, source) = (place(index), place(index + 1), source(index));
            let (mut stretches, mut others) = (Vec::new(), Vec::new());
            assert!(fast.shadows(&source, a, b, &mut stretches) && plain.shadows(&source, a, b, &mut others));
            // Behind an opaque body nothing is left to ask for; what passes a clear one, a ray must tell.
            assert!(stretches.iter().all(|stretch| stretch.dark != clear));
            let order = |list: &mut Vec<Stretch>| {
                list.sort_by(|p, q| p.from.total_cmp(&q.from).then(p.to.total_cmp(&q.to)));
            };
            order(&mut stretches);
            order(&mut others);
            assert_eq!(stretches, others);
            for step in 0..20 {
                let s = (f64::from(step) + 0.5) / 20.0;
                let p = a + (b - a) * s;
                let ray = match source {
                    PointSource::At(lamp) => Ray::between(p.as_vec3(), lamp.as_vec3()),
                    PointSource::Toward(way) | PointSource::Below { toward: way, .. } => {
                        Ray::new(p.as_vec3(), way.as_vec3())
                    }
                };
                // Positions and directions round to f32: up to 6e-8 of 3 m at either end, and twice that across
                // the shadow of something half way. Points this near to a stretch's end may be on either side.
                let near = 1e-6 / (b - a).length();
                let covers = |by: f64| stretches.iter().any(|x| x.from - by <= s && s <= x.to + by);
                if covers(near) != covers(-near) {
                    continue;
                }
                // An interface mirrors 4 % at least.
                let reached = fast.transmittance(&ray).max() == 1.0;
                assert_eq!(reached, !covers(0.0), "{index} {s} {source:?}");
                *(if reached { &mut lit } else { &mut shaded }) += 1;
            }
        }
        // Of 60 000 places those near an end are left out: a few.
        assert!(lit + shaded > 59_900 && shaded > 12_000, "{lit} lit, {shaded} not");
    }
}

#[test]
fn the_lit_side_of_a_body_is_known_to_be_lit() {
    let block = Body { node: at(Shape::cube(), 1.0, DVec3::ZERO), medium: None };
    let solids = Solids::new(vec![block], 0).expect("a block");
    let (a, b) = (DVec3::new(-0.9, 1.0, 0.3), DVec3::new(0.9, 1.0, -0.2));
    let shadows = |source, a, b| {
        let mut stretches = Vec::new();
        solids.shadows(&source, a, b, &mut stretches);
        stretches
    };
    let sun = DVec3::new(0.3, 0.8, 0.1).normalize();
    assert_eq!(shadows(PointSource::Toward(sun), a, b), []);
    assert_eq!(shadows(PointSource::At(sun * 9.0), a, b), []);
    for source in [PointSource::Toward(-sun), PointSource::At(sun * -9.0)] {
        let whole = |stretch: &&Stretch| stretch.dark && stretch.from < 1e-9 && stretch.to > 1.0 - 1e-9;
        assert_eq!(shadows(source, a, b).iter().filter(whole).count(), 1, "{source:?}");
    }
}

#[test]
fn hulls_waste_what_they_are_said_to() {
    // Mean outline over all directions: a quarter of the surface (Cauchy); that of the solid beside it.
    let outline = |shape: Shape| {
        let solids =
            Solids::new(vec![Body { node: at(shape, 1.0, DVec3::ZERO), medium: None }], 0).expect("one");
        let hull = &solids.hulls()[0];
        let area = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|i| hull.corners[i as usize]);
            (b - a).cross(c - a).length() / 2.0
        };
        hull.faces.iter().map(area).sum::<f64>() / 4.0
    };
    let pi = std::f64::consts::PI;
    // Icosahedron of inradius 1: edge 12/(√3 (3 + √5)), surface 5 √3 edge². Hulls are 1e-9 larger than that.
    let edge = 12.0 / (3f64.sqrt() * (3.0 + 5f64.sqrt()));
    assert!((outline(Shape::Sphere) - 5.0 * 3f64.sqrt() * edge * edge / 4.0).abs() < 1e-7);
    assert!((outline(Shape::Sphere) / pi - 1.207).abs() < 5e-4);
    // Squares about circles: 4/π = 1.273 for caps and sides alike.
    assert!((outline(Shape::Cylinder) / pi - 4.0 / pi).abs() < 1e-7);
    assert!((outline(Shape::Cone) / (pi * (1.0 + 2f64.sqrt()) / 4.0) - 4.0 / pi).abs() < 1e-7);
}

#[test]
fn light_through_glass_is_coloured_and_less() {
    let absorption = Spectrum::splat(0.7);
    let glass = Medium { index: 1.5, absorption, ..Medium::default() };
    let bodies = |medium: Medium| {
        let ball = at(Shape::Sphere, 1.0, DVec3::ZERO);
        // Of two parts that touch: the face between them is none.
        let block = |x: f64| at(Shape::cube(), 0.5, DVec3::new(x, 0.0, 4.0));
        let pair = Node::Union(vec![block(-0.5), block(0.5)]);
        let body = |node| Body { node, medium: Some(Arc::new(medium)) };
        Solids::new(vec![body(ball), body(pair)], 0).expect("glass")
    };
    let solids = bodies(glass);
    let through = |ray: Ray| solids.transmittance(&ray).max();
    let expected = ((1.0 - fresnel(1.5, 1.0)).powi(2) * (-0.7f64 * 2.0).exp()) as f32;
    // Head on: two interfaces and 2 m, in either body. A few roundings of f32.
    let near = |value: f32| (value - expected).abs() <= 4.0 * f32::EPSILON;
    assert!(near(through(Ray::between(Vec3::new(-3.0, 0.0, 0.0), Vec3::new(3.0, 0.0, 0.0)))));
    assert!(near(through(Ray::between(Vec3::new(-3.0, 0.0, 4.0), Vec3::new(3.0, 0.0, 4.0)))));
    assert_eq!(through(Ray::between(Vec3::new(-3.0, 0.0, 2.0), Vec3::new(3.0, 0.0, 2.0))), 1.0);
    // A shadow that may be coloured is never said to be dark.
    let mut stretches = Vec::new();
    solids.shadows(
        &PointSource::Toward(DVec3::Y),
        DVec3::new(-2.0, -1.5, 0.0),
        DVec3::new(2.0, -1.5, 0.0),
        &mut stretches,
    );
    assert!(stretches.len() == 1 && !stretches[0].dark);
    let clear = bodies(Medium::default());
    for index in 0..500 {
        let segment = Ray::between(place(index).as_vec3(), place(index + 3).as_vec3());
        assert_eq!(clear.transmittance(&segment), Spectrum::ONE);
        // The end walked back from is rounded by δ = 2⁻²³ · 9 m. The share changes fastest at grazing, as a root:
        // a ray that passes a ball at a depth h below its rim meets it at cos = √(2h), and 4 · √(2δ) < 6e-3
        // bounds what both interfaces let through there (1 − F ≤ 4 cos each, one of them being at most 1).
        assert!(check::reciprocity(&solids, &segment) <= 6e-3, "{segment:?}");
        assert!(solids.transmittance(&segment).max() <= 1.0);
    }
}

#[test]
fn nothing_and_nonsense_are_met_by_nothing() {
    let none = Solids::new(Vec::new(), 0).expect("no bodies");
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let mut stretches = Vec::new();
    assert!(none.is_empty() && none.hulls().is_empty() && none.nearest(&ray).is_none());
    assert_eq!(none.transmittance(&ray), Spectrum::ONE);
    assert!(none.shadows(&PointSource::Toward(DVec3::Y), DVec3::ZERO, DVec3::X, &mut stretches));
    // Bodies without points, and lines that are none.
    let empty =
        Node::Intersection(vec![at(Shape::Sphere, 1.0, DVec3::ZERO), at(Shape::Cone, 1.0, DVec3::X * 9.0)]);
    let mut bodies = garden();
    let full = Solids::new(bodies.clone(), 0).expect("a garden");
    bodies.push(Body { node: empty, medium: None });
    let more = Solids::new(bodies, 0).expect("a garden and nothing");
    assert_eq!(more.hulls(), full.hulls());
    for direction in [Vec3::ZERO, Vec3::NAN, Vec3::new(f32::INFINITY, 0.0, 0.0)] {
        for solids in [more.clone(), more.clone().with(Acceleration::None)] {
            assert!(solids.nearest(&Ray::new(Vec3::ONE, direction)).is_none());
            assert_eq!(solids.transmittance(&Ray::new(Vec3::ONE, direction)), Spectrum::ONE);
        }
    }
    assert_eq!(more.meet(99, (DVec3::ZERO, DVec3::X), 0.0), None);
}
