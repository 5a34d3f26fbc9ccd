//! Views, hits and textures: what projects comes back, what is hit lies on its triangle.

use std::f64::consts::PI;

use glam::{DAffine3, DVec2, DVec3, Vec2, Vec3};
use keikan_light::{Geometry, Hit, Instance, Mesh, Path, Place, Projection, Ray, Texture, View, Wrap};
use proptest::prelude::*;

fn view(projection: Projection) -> View {
    View { projection, ..View::look_at(DVec3::new(3.0, 2.0, 5.0), DVec3::ZERO, 50.0, 640, 480) }
}

proptest! {
    #[test]
    fn lines_pass_through_what_projects_there(x in -2.0f64..2.0, y in -2.0f64..2.0, z in -2.0f64..2.0) {
        for projection in [Projection::Perspective { tan_half_height: 0.5 }, Projection::Orthographic { half_height: 3.0 }] {
            let view = view(projection);
            let point = DVec3::new(x, y, z);
            let screen = view.screen_from_view(view.view_from_world(point));
            let (origin, direction) = view.line(screen.truncate());
            let off = (point - origin).reject_from_normalized(direction).length();
            // A dozen f64 operations on numbers below 10.
            prop_assert!(off < 100.0 * 10.0 * f64::EPSILON, "{off}");
        }
    }

    #[test]
    fn nearness_is_linear_along_straight_lines_on_the_screen(t in 0.0f64..1.0) {
        let view = view(Projection::Perspective { tan_half_height: 0.5 });
        let (a, b) = (DVec3::new(-1.0, -1.0, -2.0), DVec3::new(1.5, 0.5, 1.0));
        let on_screen = |p: DVec3| view.screen_from_view(view.view_from_world(p));
        let (sa, sb, s) = (on_screen(a), on_screen(b), on_screen(a.lerp(b, t)));
        let share = (s.truncate() - sa.truncate()).length() / (sb.truncate() - sa.truncate()).length();
        prop_assert!((sa.z + share * (sb.z - sa.z) - s.z).abs() < 1e-12); // pixels of 10³ in f64: 10³ · 2⁻⁵² · some
    }

    #[test]
    fn rays_leave_to_the_side_they_go(
        (px, py, pz) in (-1e4f32..1e4, -1e4f32..1e4, -1e4f32..1e4),
        (dx, dy, dz) in (-1f32..1.0, -1f32..1.0, -1f32..1.0),
        error in 0f32..1e-2,
    ) {
        let direction = Vec3::new(dx, dy, dz);
        prop_assume!(direction.length() > 0.1);
        let direction = direction.normalize();
        let place = Place { position: Vec3::new(px, py, pz), error, normal: Vec3::new(0.48, 0.6, 0.64), seed: 0 };
        let ray = place.leave(direction, f32::INFINITY);
        let moved = (ray.origin.as_dvec3() - place.position.as_dvec3()).dot(place.normal.as_dvec3());
        let side = f64::from(direction.dot(place.normal).signum());
        // At least the error; the normal is a unit vector to f32 rounding only.
        prop_assert!(moved * side >= f64::from(error) * (1.0 - 1e-6), "{moved} {error}");
        // And no more than it takes: Σ|n| ≤ √3 times the error, plus two roundings of the coordinates.
        let ulp = f64::from(place.position.abs().max_element() * f32::EPSILON);
        prop_assert!(moved * side <= 1.7321 * f64::from(error) + 4.0 * ulp, "{moved} {error}");
    }
}

/// One right triangle, (0,0,0), (4,0,0), (0,3,0), with uv = xy and smooth normals along +Z.
fn triangle(world_from_mesh: DAffine3) -> Geometry {
    let mesh = Mesh {
        positions: vec![Vec3::ZERO, Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 3.0, 0.0)],
        normals: vec![Vec3::Z; 3],
        uvs: vec![Vec2::ZERO, Vec2::new(4.0, 0.0), Vec2::new(0.0, 3.0)],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    };
    Geometry { meshes: vec![mesh], instances: vec![Instance { mesh: 0, world_from_mesh }] }
}

#[test]
fn a_hit_knows_all_about_its_point() {
    let geometry = triangle(DAffine3::from_translation(DVec3::new(10.0, 0.0, -2.0)));
    let ray = Ray::new(Vec3::new(11.0, 1.0, 8.0), Vec3::NEG_Z);
    let at = geometry.triangle(0, 0).meet(ray.origin.as_dvec3(), ray.direction.as_dvec3()).unwrap();
    let hit = geometry.hit(0, 0, at, &ray, 0.25);
    assert_eq!(hit.place.position, Vec3::new(11.0, 1.0, -2.0));
    assert_eq!((hit.place.normal, hit.shading_normal, hit.front), (Vec3::Z, Vec3::Z, true));
    assert_eq!(hit.distance, 10.0);
    // u = 4 · ¼, v = 3 · ⅓ (⅓ rounds).
    assert!((hit.uv - Vec2::new(1.0, 1.0)).length() < 4.0 * f32::EPSILON);
    assert_eq!(hit.tangent, Vec3::X);
    assert_eq!(hit.uv_width(), 0.25);
}

/// Of a surface that is 3 times as long per u as per v, and of any other.
#[test]
fn textures_are_as_wide_in_a_mirror_as_before_the_eye() {
    for (stretch, density) in [(DVec3::ONE, 1.0f32), (DVec3::new(3.0, 1.0, 1.0), 3f32.sqrt().recip())] {
        let geometry = triangle(DAffine3::from_scale(stretch));
        let ray = Ray::new(Vec3::new(1.0, 1.0, 8.0), Vec3::NEG_Z);
        let at = geometry.triangle(0, 0).meet(ray.origin.as_dvec3(), ray.direction.as_dvec3()).unwrap();
        let eye = geometry.hit(0, 0, at, &ray, 0.25);
        // 8 m behind a mirror in which the bundle was 0.05 wide: 0.05 + 8 · 0.025.
        let path = Path { depth: 1, share: 0.5, width: 0.05, spread: 0.025 };
        let mirrored = geometry.hit(0, 0, at, &ray, 0.0).on(path);
        assert!((mirrored.width - eye.width).abs() <= f32::EPSILON, "{}", mirrored.width);
        for hit in [eye, mirrored] {
            // A root, a quotient, a sum and two products.
            assert!(
                (hit.uv_width() / (0.25 * density) - 1.0).abs() <= 5.0 * f32::EPSILON,
                "{}",
                hit.uv_width()
            );
        }
    }
}

#[test]
fn a_mirror_widens_a_bundle_by_twice_its_width_over_its_radius() {
    let geometry = triangle(DAffine3::IDENTITY);
    let ray = Ray::new(Vec3::new(1.0, 1.0, 8.0), Vec3::NEG_Z);
    let flat = geometry.hit(0, 0, DVec2::splat(0.25), &ray, 0.02);
    let head_on = Hit { curvature: 4.0, ..flat };
    assert_eq!((flat.turn(), head_on.turn()), (0.0, 0.08)); // w/r
    let path = Path { spread: 0.001, ..Path::EYE };
    let next = path.then(0.5, &head_on, 2.0);
    assert_eq!((next.depth, next.share, next.width), (1, 0.5, 0.02));
    assert!((next.spread - (0.001 + 2.0 * 0.02 / 0.25)).abs() <= f32::EPSILON, "{}", next.spread);
    assert!((next.width_at(10.0) - (0.02 + 10.0 * next.spread)).abs() <= f32::EPSILON);
    // A flat mirror passes the spread on, and the width on it is where the next ray begins.
    assert_eq!(path.then(1.0, &flat, 2.0), Path { depth: 1, share: 1.0, width: 0.02, spread: 0.001 });
    // At 60° the geometric mean of 1 and 1/cos: √2; and where it grazes there is an end.
    let turned = |cos: f32| Hit { toward_eye: Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos), ..head_on };
    assert!((turned(0.5).turn() / head_on.turn() - 2f32.sqrt()).abs() <= 4.0 * f32::EPSILON);
    assert_eq!(turned(0.0).turn(), turned(0.01).turn());
    let widest = Hit { curvature: 1e9, ..head_on };
    assert!(widest.turn() < 1.6 && path.then(1.0, &widest, 2.0).spread < 1.6, "{}", widest.turn());
    assert_eq!(Path { depth: u8::MAX, ..path }.then(1.0, &flat, 2.0).depth, u8::MAX);
}

/// Corners of a ball of radius r have the normals position/r: |Δn|/|Δx| is 1/r, whatever the placement.
#[test]
fn curvature_of_smooth_meshes_is_that_of_what_they_stand_for() {
    let corners = [Vec3::X, Vec3::new(0.6, 0.8, 0.0), Vec3::new(0.6, 0.0, 0.8)];
    for (radius, scale, far) in [(1.0, 1.0, 0.0), (0.25, 1.0, 0.0), (0.25, 3.0, 1e6)] {
        let mesh = Mesh {
            positions: corners.map(|corner| corner * radius).to_vec(),
            normals: corners.to_vec(),
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        let world_from_mesh =
            DAffine3::from_translation(DVec3::splat(far)) * DAffine3::from_scale(DVec3::splat(scale));
        let instance = Instance { mesh: 0, world_from_mesh };
        let ray = Ray::new(Vec3::X * 9.0, Vec3::NEG_X);
        let hit = |mesh| {
            Geometry { meshes: vec![mesh], instances: vec![instance] }.hit(0, 0, DVec2::splat(0.3), &ray, 0.0)
        };
        let expected = 1.0 / (radius * scale as f32);
        let found = hit(mesh.clone()).curvature;
        // Two distances of numbers that were rounded, their quotient, a cube root.
        assert!((found / expected - 1.0).abs() <= 8.0 * f32::EPSILON, "{found} {expected}");
        assert_eq!(hit(Mesh { normals: Vec::new(), ..mesh.clone() }).curvature, 0.0);
        assert_eq!(hit(Mesh { normals: vec![Vec3::X; 3], ..mesh }).curvature, 0.0);
    }
}

#[test]
fn normals_turn_to_the_viewer_and_survive_mirroring() {
    for (scale, from) in [(DVec3::ONE, 1.0), (DVec3::ONE, -1.0), (DVec3::new(-1.0, 2.0, 1.0), 1.0)] {
        let geometry = triangle(DAffine3::from_scale(scale));
        let ray = Ray::new(Vec3::new(0.5 * scale.x as f32, 0.5, 8.0 * from), Vec3::Z * -from);
        let at = geometry.triangle(0, 0).meet(ray.origin.as_dvec3(), ray.direction.as_dvec3()).unwrap();
        let hit = geometry.hit(0, 0, at, &ray, 0.0);
        assert_eq!((hit.place.normal, hit.shading_normal), (Vec3::Z * from, Vec3::Z * from));
        // Outside is where the triangle was wound counter-clockwise, also after a mirror image.
        assert_eq!(hit.front, from > 0.0);
    }
}

#[test]
fn degenerate_triangles_are_never_met() {
    let mesh = Mesh { positions: vec![Vec3::ONE; 3], triangles: vec![[0, 1, 2]], ..Mesh::default() };
    let instance = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
    let geometry = Geometry { meshes: vec![mesh], instances: vec![instance] };
    assert_eq!(geometry.triangle(0, 0).meet(DVec3::ZERO, DVec3::ONE), None);
}

fn checker() -> Texture {
    let texels: Vec<[f32; 4]> =
        (0..64).map(|i| if (i % 8 + i / 8) % 2 == 0 { [1.0; 4] } else { [0.0, 0.0, 0.0, 1.0] }).collect();
    Texture::new(8, 8, &texels, [Wrap::Repeat; 2]).unwrap()
}

#[test]
fn a_wide_footprint_sees_the_mean() {
    let (rgb, alpha) = checker().sample(Vec2::new(0.3, 0.7), 1.0);
    // Half of 65535 rounds to one part in 131070.
    assert!((rgb.x - 0.5).abs() < 1.0 / 65535.0 && alpha == 1.0);
}

#[test]
fn transparent_texels_lend_no_colour_to_their_neighbours() {
    // Red leaf beside a fully transparent green background: half-way between, still red.
    let texels = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0]];
    let texture = Texture::new(2, 1, &texels, [Wrap::Clamp; 2]).unwrap();
    let (rgb, alpha) = texture.sample(Vec2::new(0.5, 0.5), 0.0);
    assert_eq!((rgb, alpha), (Vec3::X, 0.5));
}

#[test]
fn wrapping_reaches_everywhere() {
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        let texture = Texture::new(3, 5, &[[0.25; 4]; 15], [wrap; 2]).unwrap();
        for at in [-1e9, -1.0, -0.1, 0.0, 0.999_999_9, 1.0, 7.5, 1e9, f32::NAN, f32::INFINITY] {
            // 0.25 is stored premultiplied: two roundings to 1/65535.
            let alpha = texture.alpha(Vec2::new(at, -at), 0.3);
            assert!((alpha - 0.25).abs() < 1.0 / 65535.0, "{wrap:?} at {at}: {alpha}");
        }
    }
    assert!(Texture::new(0, 4, &[], [Wrap::Clamp; 2]).is_none());
    assert!(Texture::new(2, 2, &[[0.0; 4]; 3], [Wrap::Clamp; 2]).is_none());
}

#[test]
fn looking_straight_down_has_an_up() {
    let view = View::look_at(DVec3::new(0.0, 10.0, 0.0), DVec3::ZERO, 90.0, 100, 100);
    let (_, direction) = view.line(DVec2::new(50.0, 50.0));
    assert!((direction + DVec3::Y).length() < 1e-15); // one normalisation
    assert!((view.world_from_view.determinant() - 1.0).abs() < 1e-15);
    assert!((view.scale() - 50.0 / (PI / 4.0).tan()).abs() < 1e-12);
}
