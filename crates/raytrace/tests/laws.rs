//! Laws of light in transparent bodies: what their shadows let through, and how much of it is seen.

use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec3, Vec3};
use keikan_raytrace::solid::{Body, Node, Shape, Solids};
use keikan_raytrace::surface::{Finish, Glass, Surface};
use keikan_raytrace::{Crossing, through};
use light::{
    Arrival, Hit, Medium, Nearest, Occlude, Path, Place, Ray, Shade, Spectrum, Surroundings, Vacuum,
};
use proptest::prelude::*;

fn unit() -> impl Strategy<Value = DVec3> {
    (-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0)
        .prop_map(|(x, y, z)| DVec3::new(x, y, z))
        .prop_filter_map("a direction", DVec3::try_normalize)
}

/// A shape of about a metre near the origin.
fn placed() -> impl Strategy<Value = Node> {
    let shape = prop_oneof![
        Just(Shape::Sphere),
        Just(Shape::Cylinder),
        Just(Shape::Cone),
        (0.2f64..2.0).prop_map(|top| Shape::Frustum { top }),
        Just(Shape::cube()),
    ];
    (shape, unit(), 0.0f64..6.3, prop::array::uniform3(0.4f64..1.2), unit()).prop_map(
        |(shape, axis, turn, scale, at)| Node::Solid {
            shape,
            world_from_solid: DAffine3::from_scale_rotation_translation(
                scale.into(),
                DQuat::from_axis_angle(axis, turn),
                0.6 * at,
            ),
            material: 0,
        },
    )
}

/// A shape, or an operation on two.
fn node() -> impl Strategy<Value = Node> {
    (placed(), placed(), 0..4).prop_map(|(a, b, how)| match how {
        0 => a,
        1 => Node::Union(vec![a, b]),
        2 => Node::Intersection(vec![a, b]),
        _ => Node::Difference(Box::new(a), vec![b]),
    })
}

fn medium() -> impl Strategy<Value = Medium> {
    (0.5f32..2.5, 0.0f32..2.0, 0.0f32..=1.0, 0.0f32..=1.0).prop_map(
        |(index, absorption, transmission, tint)| Medium {
            index,
            absorption: Spectrum::splat(absorption),
            transmission,
            tint: Spectrum::splat(tint),
            thin: false,
        },
    )
}

fn solids(node: Node, medium: Medium) -> Solids {
    Solids::new(vec![Body { node, medium: Some(Arc::new(medium)) }], 0).expect("a body")
}

/// How fast t_p may change with the line: Fresnel's shares rise as √ from grazing and from the critical angle, so a
/// line that is off by δ in bodies of size s changes each of them by about √(δ/s). End points are f32: δ is some ε of 8 m.
fn off_by_rounding() -> f32 {
    4.0 * (8.0 * 4.0 * f32::EPSILON / 0.4).sqrt()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// t_p of set operations is a share, and the same from either end.
    #[test]
    fn shadows_of_bodies_are_symmetric_shares(
        node in node(), medium in medium(), aim in unit(), from in unit(), far in 2.0f64..4.0, inside in any::<bool>()
    ) {
        let solids = solids(node, medium);
        let (a, b) = ((0.5 * aim + far * from).as_vec3(), if inside { 0.5 * aim } else { 0.5 * aim - far * from }.as_vec3());
        let (there, back) = (Ray::between(a, b), Ray::between(b, a));
        let (t, u) = (solids.transmittance(&there)[0], solids.transmittance(&back)[0]);
        prop_assert!((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u), "{t} {u}");
        // A line that only just meets a body, or passes an edge, may miss it when it is rounded otherwise.
        let walls = |ray: &Ray| {
            let mut walls = solids.crossings(0, (ray.origin.as_dvec3(), ray.direction.as_dvec3()));
            walls.retain(|wall| wall.t > 0.0 && wall.t < f64::from(ray.length));
            walls
        };
        let (mut ours, theirs) = (walls(&there), walls(&back));
        ours.reverse();
        prop_assume!(ours.len() == theirs.len());
        prop_assume!(ours.iter().zip(&theirs).all(|(x, y)| (x.normal - y.normal).length() < 1e-3));
        prop_assert!((t - u).abs() <= off_by_rounding(), "{t} {u}");
    }

    /// Whatever the two faces: light that Snell's law does not let out does not pass, and what it lets out does.
    #[test]
    fn nothing_passes_beyond_the_critical_angle(
        direction in unit(), enter in unit(), leave in unit(), index in 0.5f64..2.5, way in 0.1f64..2.0
    ) {
        // Turned so that the line enters by the first and leaves by the second.
        let enter = if direction.dot(enter) > 0.0 { -enter } else { enter };
        let leave = if direction.dot(leave) < 0.0 { -leave } else { leave };
        let clear = Medium { index: index as f32, ..Medium::default() };
        let index = f64::from(clear.index);
        let mut crossings = [Crossing { t: 1.0, outward: enter }, Crossing { t: 1.0 + way, outward: leave }];
        let passed = through(direction, &mut crossings, 9.0, 0.0, &clear)[0];
        // The tangential part inside is 1/n of that outside; at the other face it grows n-fold again.
        let least = |direction: DVec3, enter: DVec3, leave: DVec3| {
            let tangential = (direction - enter * direction.dot(enter)) / index;
            let along = 1.0 - tangential.length_squared();
            let inside = tangential - enter * along.max(0.0).sqrt();
            let outside = 1.0 - (index * inside.cross(leave).length()).powi(2);
            // All three must be above 0 for a ray to come in, meet the other face, and come out.
            along.min(outside).min(inside.dot(leave))
        };
        let margin = least(direction, enter, leave).min(least(-direction, leave, enter));
        // Sums of squares of f64 below 10.
        if margin < -1e-13 {
            prop_assert_eq!(passed, 0.0);
        } else if margin > 1e-13 {
            prop_assert!(passed > 0.0 && passed <= 1.0, "{passed} {margin}");
        }
    }
}

/// Radiance 1 all around one body.
struct Room<'a> {
    solids: &'a Solids,
    shade: &'a dyn Shade,
    depth: u8,
}

impl Surroundings for Room<'_> {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        use light::Illuminate;
        light::Uniform { radiance: Spectrum::ONE }.arrivals(place, &Vacuum, receive);
    }

    fn radiance(&self, ray: &Ray, path: Path) -> Spectrum {
        if path.depth > self.depth {
            return Spectrum::ZERO;
        }
        match self.solids.nearest(ray) {
            Some(hit) => self.shade.radiance(&Hit { path, ..hit }, self),
            None => Spectrum::ONE,
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    /// A turn more adds light, and all together is never more than there is.
    #[test]
    fn energy_grows_with_depth_to_what_is_there_at_most(
        node in node(), medium in medium(), aim in unit(), from in unit(), metal in any::<bool>(), colour in 0.0f32..=1.0
    ) {
        // What scatters at the face of a bubble is not kept from the light that is totally reflected there: such
        // surfaces send back too much, and scenes cannot state them (ior ≥ 1). Clear bubbles are right.
        let transmission = if medium.index < 1.0 { 1.0 } else { medium.transmission };
        let medium = Medium { transmission, ..medium };
        let solids = solids(node, medium);
        let finish = Finish {
            base_colour: Vec3::splat(colour),
            roughness: 0.0,
            metallic: f32::from(u8::from(metal)),
            ..Finish::default()
        };
        let shade: Box<dyn Shade> =
            if metal { Box::new(Surface::new(finish)) } else { Box::new(Glass::new(finish, medium)) };
        let direction = (0.7 * aim - 4.0 * from).normalize().as_vec3();
        let ray = Ray::new((4.0 * from).as_vec3(), direction);
        // What scatters below a boundary knows its reflectance from a table that is good to 0.005.
        let table = if metal || transmission == 1.0 { 0.0 } else { 0.005 };
        let mut before = 0.0;
        for depth in 0..8u8 {
            let seen = Room { solids: &solids, shade: &*shade, depth }.radiance(&ray, Path::EYE)[0];
            // The same terms in the same order, and more: sums of what is not negative are monotone in f32 too.
            prop_assert!(seen >= before, "depth {depth}: {before} {seen}");
            // Some ten roundings a turn.
            let turn = 1.0 + table + 10.0 * f32::EPSILON;
            prop_assert!(seen <= turn.powi(i32::from(depth) + 1), "depth {depth}: {seen}");
            before = seen;
        }
    }
}
