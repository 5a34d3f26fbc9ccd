//! Where shadows of solids begin and end, against closed forms and against the walls on every way.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use keikan_raytrace::solid::{Acceleration, Body, Node, Shape, Solids};
use light::{Bodies, Occlude, PointSource, Stretch};
use proptest::prelude::*;

fn solid(shape: Shape, world_from_solid: DAffine3) -> Node {
    Node::Solid { shape, world_from_solid, material: 0 }
}

fn at(shape: Shape, scale: DVec3, place: DVec3) -> Node {
    solid(shape, DAffine3::from_scale_rotation_translation(scale, DQuat::IDENTITY, place))
}

fn opaque(nodes: Vec<Node>) -> Solids {
    let bodies = nodes.into_iter().map(|node| Body { node, medium: None }).collect();
    Solids::new(bodies, 0).expect("a body")
}

/// The stretches in order, neighbours joined.
fn shadows(solids: &Solids, source: PointSource, a: DVec3, b: DVec3) -> Vec<Stretch> {
    let mut stretches = Vec::new();
    assert!(solids.shadows(&source, a, b, &mut stretches));
    stretches.sort_by(|p, q| p.from.total_cmp(&q.from));
    stretches.dedup_by(|next, last| {
        let joined = next.from <= last.to;
        last.to = if joined { last.to.max(next.to) } else { last.to };
        joined
    });
    stretches
}

/// Whether a wall of a body stands between a place and the source, farther than `touch` from both.
fn blocked(solids: &Solids, source: PointSource, from: DVec3, touch: f64) -> bool {
    let (way, end) = match source {
        PointSource::At(lamp) => (lamp - from, lamp.distance(from) - touch),
        PointSource::Toward(way) | PointSource::Below { toward: way, .. } => (way, f64::INFINITY),
    };
    let line = (from, way.normalize());
    (0..solids.len() as u32).any(|body| solids.meet(body, line, touch).is_some_and(|t| t < end))
}

/// Whether the way is blocked; none where what decides is as near to an end of the way as the surface that
/// the segment lies on may be, 1e-9 of the coordinates.
fn surely(solids: &Solids, source: PointSource, from: DVec3, size: f64) -> Option<bool> {
    let with = |touch: f64| blocked(solids, source, from, touch * size);
    let answer = with(1e-9);
    (with(1e-14) == answer && with(1e-8) == answer).then_some(answer)
}

/// Which of 100 places, and of those just beside the stretches' ends, tell otherwise than the stretches.
fn faults(solids: &Solids, source: PointSource, [a, b]: [DVec3; 2], tips: bool) -> Vec<f64> {
    let stretches = shadows(solids, source, a, b);
    let size = a.abs().max(b.abs()).max_element().max(1.0);
    // Places are told apart to 2⁻⁴⁰ of the segment, and walls are known to 24 √3 · 2⁻⁵³ = 5e-15 of the coordinates,
    // twice that between two of them: times the skewness of a placement, up to 10 here, and times up to 100 where
    // a lamp within a body is so much nearer to its walls than to the segment. At the tip of a cone
    // F = x² + z² − r² is as small as the square of how far it is: a ray passes it within the root of all that.
    let known = 1e-11 * size;
    let near = 4e-12 + if tips { known.sqrt() } else { known } / a.distance(b);
    let ends = || stretches.iter().flat_map(|stretch| [stretch.from, stretch.to]);
    let wrong = |s: &f64| {
        let told = stretches.iter().any(|stretch| stretch.from < *s && *s < stretch.to);
        let end = ends().any(|end| (end - s).abs() < near);
        !end && surely(solids, source, a + (b - a) * *s, size).is_some_and(|blocked| blocked != told)
    };
    let places = (0..100).map(|i| (f64::from(i) + 0.5) / 100.0);
    let beside = ends().flat_map(|end| [end - 1.1 * near, end + 1.1 * near]);
    places.chain(beside).filter(|s| *s > 0.0 && *s < 1.0).filter(wrong).collect()
}

/// The shadow of a ball at c of radius r from a lamp at l: p = a + s (b − a) is dark behind it where the distance of c
/// from the way is below r, ((c − l) · d)² > (|c − l|² − r²) d² with d = p − l: quadratic in s.
fn conic(centre: DVec3, radius: f64, lamp: DVec3, a: DVec3, b: DVec3) -> Option<[f64; 2]> {
    let (to, first, way) = (centre - lamp, a - lamp, b - a);
    let k = to.length_squared() - radius * radius;
    let c = to.dot(first).powi(2) - k * first.length_squared();
    let h = to.dot(first) * to.dot(way) - k * first.dot(way);
    let q = to.dot(way).powi(2) - k * way.length_squared();
    let root = (h * h - q * c).sqrt();
    let ends = [(-h + root) / q, (-h - root) / q];
    (root >= 0.0).then_some(if q > 0.0 { [f64::NAN; 2] } else { ends })
}

#[test]
fn a_ball_casts_a_conic() {
    let (centre, radius) = (DVec3::new(-0.78, 0.28, -0.8), 0.28);
    let lamp = DVec3::new(-2.4, 3.2, 2.6);
    for far in [0.0, 1e3, 1e6] {
        let by = DVec3::new(far, far * 0.5, -far);
        let solids = opaque(vec![at(Shape::Sphere, DVec3::splat(radius), centre + by)]);
        // Points far away round by 2⁻⁵³ of their coordinates; the border of a shadow that is just grazed moves by
        // the root of what moves the way, so chords through less than 1 % of it are left out.
        let bound = 1e-12 + 1e-14 * far;
        let (mut beside, mut compared) = (0, 0);
        for line in 0..400 {
            let z = -2.5 + 0.01 * f64::from(line);
            let (a, b) = (DVec3::new(-3.0, 0.0, z), DVec3::new(2.0, 0.0, z + 0.3));
            let told = shadows(&solids, PointSource::At(lamp + by), a + by, b + by);
            match conic(centre, radius, lamp, a, b) {
                None => {
                    assert_eq!(told, [], "{z}");
                    beside += 1;
                }
                Some([from, to]) if to - from < 0.01 => {}
                Some([from, to]) => {
                    assert_eq!(told.len(), 1, "{z} {far}");
                    compared += 1;
                    let Stretch { from: f, to: t, dark } = told[0];
                    assert!(
                        dark && (f - from).abs() < bound && (t - to).abs() < bound,
                        "{z} {far}: {told:?} {from} {to}"
                    );
                }
            }
        }
        println!("{compared} chords, {beside} lines beside the shadow");
        assert!(compared > 40 && beside > 200, "{compared} {beside}");
    }
}

#[test]
fn a_box_and_a_cylinder_cast_what_they_measure() {
    let sun = PointSource::Toward(DVec3::new(-1.0, 1.0, 0.0).normalize());
    let (a, b) = (DVec3::new(-4.0, 0.0, 0.3), DVec3::new(6.0, 0.0, 0.3));
    let one = |node: Node| {
        let told = shadows(&opaque(vec![node]), sun, a, b);
        assert!(told.len() == 1 && told[0].dark, "{told:?}");
        [told[0].from * 10.0 - 4.0, told[0].to * 10.0 - 4.0]
    };
    let near = |found: [f64; 2], expected: [f64; 2]| {
        // EXACT of 10 m.
        assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 2e-11), "{found:?} {expected:?}");
    };
    // At 45° what is h high casts as far. On the ground, and held above it.
    let block = |y: f64| at(Shape::cube(), DVec3::new(0.5, 1.0, 1.0), DVec3::new(0.0, 1.0 + y, 0.0));
    near(one(block(0.0)), [-0.5, 2.5]);
    near(one(block(0.5)), [0.0, 3.0]);
    // A circle of radius 1 is cut at z = 0.3 to ±√(1 − 0.09).
    let half = 0.91f64.sqrt();
    near(one(at(Shape::Cylinder, DVec3::new(1.0, 2.0, 1.0), DVec3::ZERO)), [-half, 2.0 + half]);
    // A knob on a block, on the plane of the block's top: what lies in the segment's own plane casts nothing on it.
    let block = at(Shape::cube(), DVec3::new(3.0, 1.0, 3.0), DVec3::NEG_Y);
    let knob = at(Shape::cube(), DVec3::new(0.25, 0.5, 1.0), DVec3::Y * 0.25);
    near(one(Node::Union(vec![block, knob])), [-0.25, 1.0]);
}

/// A rod of radius 0.3 ρ and height 2 ρ without what a ball of radius 0.5 ρ around 0.8 ρ takes out of it, and what
/// else is in the body; on the floor beside its axis, by z ρ, in light at 45° along the segment.
fn notched_rod(rho: f64, z: f64, turn: f64, others: Vec<Node>) -> Vec<[f64; 2]> {
    let turn = DQuat::from_rotation_y(turn);
    let rod = at(Shape::Cylinder, DVec3::new(0.3, 2.0, 0.3) * rho, DVec3::ZERO);
    let ball = at(Shape::Sphere, DVec3::splat(0.5 * rho), DVec3::Y * 0.8 * rho);
    let mut all = vec![Node::Difference(Box::new(rod), vec![ball])];
    all.extend(others);
    let sun = PointSource::Toward(turn * DVec3::new(-1.0, 1.0, 0.0).normalize());
    let [a, b] = [-1.0, 3.0].map(|x| turn * DVec3::new(x, 0.0, z) * rho);
    let told = shadows(&opaque(vec![Node::Union(all)]), sun, a, b);
    told.iter().map(|s| [s.from * 4.0 - 1.0, s.to * 4.0 - 1.0]).collect()
}

/// In the rod's cut, |x| ≤ h = √(0.09 − z²), the way from x to the sun is (x − t, t): it enters and leaves at t = x ± h, and
/// all of that is in the ball if h² + (x ± h − 0.8)² ≤ 0.25 − z², or |x − 0.8| ≤ 0.4 − h. At z = 0.1 the rod is cut in two
/// lines, which are upright as the sheet's y is.
#[test]
fn corners_of_a_line_along_the_sheet() {
    let check = |found: Vec<[f64; 2]>, z: f64, rho: f64, what: &str| {
        let half = (0.09 - z * z).sqrt();
        let expected = [[-half, 0.4 + half], [1.2 - half, 2.0 + half]];
        // EXACT of the segment's 4 ρ, and a dozen roundings of the body's 6 m, in whose coordinates places are.
        let bound = 1e-11 + 12.0 * 2f64.powi(-53) * 6.0 / rho;
        let near = |(f, e): (&[f64; 2], &[f64; 2])| f.iter().zip(e).all(|(f, e)| (f - e).abs() < bound);
        assert!(found.len() == 2 && found.iter().zip(&expected).all(near), "{what}: {found:?} {expected:?}");
    };
    for turn in [0.0, 0.3, 1.1] {
        for z in [0.0, 0.05, 0.1, 0.2] {
            check(notched_rod(1.0, z, turn, Vec::new()), z, 1.0, &format!("turned by {turn}, {z}"));
            // The same, as a small part of a body that reaches under the floor.
            for rho in [1e-3, 1e-4, 1e-5, 1e-6] {
                let below = at(Shape::cube(), DVec3::ONE, DVec3::Y * -5.0);
                check(
                    notched_rod(rho, z, turn, vec![below]),
                    z,
                    rho,
                    &format!("turned by {turn}, {z}, {rho}"),
                );
            }
        }
    }
}

#[test]
fn light_through_a_slit_is_as_wide_as_the_slit() {
    let sun = PointSource::Toward(DVec3::new(-1.0, 1.0, 0.0).normalize());
    let (a, b) = (DVec3::new(1.5, 0.0, -4.0), DVec3::new(1.5, 0.0, 4.0));
    for half in [0.25, 1e-3, 1e-6, 1e-9] {
        let wall = at(Shape::cube(), DVec3::new(0.5, 1.0, 2.0), DVec3::Y);
        let slit = at(Shape::cube(), DVec3::new(1.0, 1.0, half), DVec3::new(0.0, 1.5, 0.3));
        let told = shadows(&opaque(vec![Node::Difference(Box::new(wall), vec![slit])]), sun, a, b);
        let ends: Vec<f64> = told.iter().flat_map(|s| [s.from * 8.0 - 4.0, s.to * 8.0 - 4.0]).collect();
        let expected = [-2.0, 0.3 - half, 0.3 + half, 2.0];
        // EXACT of 8 m.
        let near = ends.iter().zip(expected).all(|(end, e)| (end - e).abs() < 2e-11);
        assert!(ends.len() == 4 && near, "{half}: {ends:?}");
    }
    // A bore through a ball, along the light: an ellipse of light in the middle of the shadow, √2 as long as wide.
    let bore = DAffine3::from_rotation_z(std::f64::consts::FRAC_PI_4)
        * DAffine3::from_scale(DVec3::new(0.1, 4.0, 0.1))
        * DAffine3::from_translation(DVec3::Y * -0.5);
    let ball = Node::Difference(
        Box::new(solid(Shape::Sphere, DAffine3::IDENTITY)),
        vec![solid(Shape::Cylinder, bore)],
    );
    let (a, b) = (DVec3::new(-4.0, -1.0, 0.06), DVec3::new(6.0, -1.0, 0.06));
    let told = shadows(&opaque(vec![ball]), sun, a, b);
    let half = |radius: f64| (2.0 * (radius * radius - 0.0036)).sqrt();
    let ends: Vec<f64> = told.iter().flat_map(|s| [s.from * 10.0 - 5.0, s.to * 10.0 - 5.0]).collect();
    let expected = [-half(1.0), -half(0.1), half(0.1), half(1.0)];
    // EXACT of 10 m, and some roundings more since ways run along the wall of the bore.
    assert!(ends.len() == 4 && ends.iter().zip(expected).all(|(end, e)| (end - e).abs() < 1e-10), "{ends:?}");
}

/// Numbers in [0, 1), the same in every run (SplitMix64).
struct Dice {
    state: u64,
    /// Where everything is.
    about: DVec3,
    /// Whether any cones have been made.
    tips: bool,
}

impl Dice {
    fn roll(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.state ^ (self.state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / 9_007_199_254_740_992.0
    }

    fn within(&mut self, half: f64) -> DVec3 {
        DVec3::new(self.roll() - 0.5, self.roll() - 0.5, self.roll() - 0.5) * 2.0 * half
    }

    fn placement(&mut self) -> DAffine3 {
        let upright = self.roll() < 0.4;
        let turn =
            DQuat::from_axis_angle((self.within(1.0) + DVec3::Y * 1e-3).normalize(), self.roll() * 6.3);
        let turn = if upright { DQuat::IDENTITY } else { turn };
        let scale = DVec3::new(0.3 + self.roll(), 0.3 + self.roll(), 0.3 + self.roll());
        let skew = if upright { 0.0 } else { self.roll() };
        let shear = DMat3::from_cols(DVec3::X, DVec3::new(skew, 1.0, 0.0), DVec3::Z);
        // Half of the upright ones on one axis: symmetric cuts and faces in common.
        let place = if upright && self.roll() < 0.5 { DVec3::Y * self.roll() } else { self.within(0.7) };
        DAffine3::from_scale_rotation_translation(scale, turn, self.about + place)
            * DAffine3::from_mat3(shear)
    }

    fn shape(&mut self) -> Shape {
        match (self.roll() * 5.0) as u32 {
            0 => Shape::Sphere,
            1 => Shape::Cylinder,
            2 => {
                self.tips = true;
                Shape::Cone
            }
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
            1 => Node::Intersection(nodes),
            _ => Node::Difference(Box::new(self.node(depth - 1)), nodes),
        }
    }

    /// Lamps outside and within, suns, and suns along the axes.
    fn source(&mut self) -> PointSource {
        match (self.roll() * 4.0) as u32 {
            0 => PointSource::At(self.about + self.within(1.0)),
            1 => PointSource::At(self.about + self.within(5.0)),
            2 => PointSource::Toward((self.within(1.0) + DVec3::Y * 1e-3).normalize()),
            _ => PointSource::Toward([DVec3::X, DVec3::Y, DVec3::NEG_Z][(self.roll() * 3.0) as usize]),
        }
    }

    /// Beside the body, through it, below the light, on planes on which its members may stand, and almost along the light.
    fn segment(&mut self, source: PointSource) -> [DVec3; 2] {
        let (mut a, mut b) = (self.within(3.0), self.within(3.0));
        match (self.roll() * 7.0) as u32 {
            0 => (a.y, b.y) = (0.0, 0.0),
            2 => {
                // In an upright plane with the light, in which upright cylinders are lines.
                let way = match source {
                    PointSource::At(lamp) => lamp - self.about - a,
                    PointSource::Toward(way) | PointSource::Below { toward: way, .. } => way * 3.0,
                };
                b = a - DVec3::new(way.x, 0.0, way.z) * (self.roll() + 0.2);
            }
            1 => {
                let way = match source {
                    PointSource::At(lamp) => lamp - self.about - a,
                    PointSource::Toward(way) | PointSource::Below { toward: way, .. } => way * 3.0,
                };
                let aside = 0.1f64.powf(self.roll() * 14.0);
                b = a + way * (self.roll() - 1.2) + self.within(aside);
            }
            _ => {}
        }
        [self.about + a, self.about + b]
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    /// Every way tells what the stretches say, whatever the body.
    #[test]
    fn stretches_are_what_the_ways_say(seed in 0u64..1 << 40) {
        let about = DVec3::new(1e6, -4e5, 7e5) * f64::from(u8::from(seed % 5 == 0));
        let mut dice = Dice { state: seed, about, tips: false };
        let nodes = (0..1 + seed % 2).map(|_| dice.node(3)).collect();
        let solids = opaque(nodes);
        for _ in 0..8 {
            let source = dice.source();
            let segment = dice.segment(source);
            let wrong = faults(&solids, source, segment, dice.tips);
            prop_assert!(wrong.is_empty(), "{wrong:?} {source:?} {segment:?}");
            let plain = solids.clone().with(Acceleration::None);
            let told = |solids| shadows(solids, source, segment[0], segment[1]);
            prop_assert_eq!(told(&solids), told(&plain));
        }
    }
}
