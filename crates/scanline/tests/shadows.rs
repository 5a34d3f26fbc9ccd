//! Visible spans cut where shadows begin and end.

mod common;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use common::{picture, placed, soup, stage};
use glam::{DVec2, DVec3, Vec3};
use keikan_scanline::{Knobs, Rule, Scanline, Shading, reference};
use light::{Geometry, Known, Occlude, Piece, PointSource, Projection, Ray, Spectrum, Stretch, View};
use proptest::prelude::*;

/// Flat convex screens that face up and hang in the air, told about in closed form.
#[derive(Clone)]
struct Screens {
    screens: Vec<Vec<DVec3>>,
    /// What is said instead of dark.
    dark: bool,
    tells: bool,
}

impl Screens {
    fn new(screens: Vec<Vec<DVec3>>) -> Self {
        Self { screens, dark: true, tells: true }
    }

    /// Where a screen is on the segment from `p` to the source, if it is: its shadow on the plane y = `height` is
    /// a convex polygon, by projection from the source.
    fn shadow(screen: &[DVec3], source: &PointSource, p: DVec3) -> Vec<DVec3> {
        let onto = |corner: &DVec3| {
            let along = match *source {
                PointSource::At(at) => *corner - at,
                PointSource::Toward(toward) | PointSource::Below { toward, .. } => -toward,
            };
            *corner + along * ((p.y - corner.y) / along.y)
        };
        screen.iter().map(onto).collect()
    }
}

/// Part of the line a + t (b − a), t within 0..=1, inside of a convex polygon, seen from above.
fn inside(polygon: &[DVec3], a: DVec3, b: DVec3) -> Option<(f64, f64)> {
    let flat = |p: DVec3| DVec2::new(p.x, p.z);
    let middle = polygon.iter().copied().map(flat).sum::<DVec2>() / polygon.len() as f64;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (i, &p) in polygon.iter().enumerate() {
        let (p, q) = (flat(p), flat(polygon[(i + 1) % polygon.len()]));
        let normal = (q - p).perp();
        let normal = if normal.dot(middle - p) < 0.0 { -normal } else { normal };
        let (da, db) = (normal.dot(flat(a) - p), normal.dot(flat(b) - p));
        if da < 0.0 && db < 0.0 {
            return None;
        }
        let t = da / (da - db);
        if da < 0.0 {
            from = from.max(t);
        } else if db < 0.0 {
            to = to.min(t);
        }
    }
    (from < to).then_some((from, to))
}

impl Occlude for Screens {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let (a, d) = (segment.origin.as_dvec3(), segment.direction.as_dvec3());
        let hit = self.screens.iter().any(|screen| {
            let t = (screen[0].y - a.y) / d.y;
            let at = a + d * t;
            t > 0.0 && t < f64::from(segment.length) && inside(screen, at, at + 1e-9 * DVec3::X).is_some()
        });
        if hit { Spectrum::ZERO } else { Spectrum::ONE }
    }

    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        // Only for level floors below all screens and sources above them.
        let shadow = |screen: &Vec<DVec3>| inside(&Self::shadow(screen, source, a), a, b);
        let stretches = self.screens.iter().filter_map(shadow);
        if self.tells {
            out.extend(stretches.map(|(from, to)| Stretch { from, to, dark: self.dark }));
        }
        self.tells
    }
}

const SIZE: u32 = 24;

/// From straight above, parallel, one pixel a metre.
fn above() -> View {
    View { projection: Projection::Orthographic { half_height: 12.0 }, ..oblique(DVec3::new(0.0, 30.0, 0.0)) }
}

fn oblique(eye: DVec3) -> View {
    View::look_at(eye, DVec3::ZERO, 40.0, SIZE, SIZE)
}

/// A floor wider than the picture: one triangle, or many.
fn floor(triangles: u32) -> Geometry {
    if triangles == 1 {
        let corners = [(-900.0, 900.0), (900.0, 900.0), (0.0, -900.0)];
        return placed(soup(&[corners.map(|(x, z)| Vec3::new(x, 0.0, z))]));
    }
    placed(common::terrain(triangles, 60.0, |_, _| 0.0))
}

fn knobs(rule: Rule, sub_scanlines: u32) -> Knobs {
    Knobs { rule, sub_scanlines, shading: Shading::PerPixel }
}

fn lit_by(geometry: Geometry, view: View, knobs: Knobs, source: PointSource, screens: &Screens) -> Scanline {
    stage(geometry, view, knobs).with_shadows(vec![(5, source)], Arc::new(screens.clone()))
}

fn all(stage: &Scanline) -> Vec<(u32, Piece)> {
    picture(stage, 0..SIZE, 0..SIZE)
}

/// What share of each pixel is dark: as known, and asked about at the hit where it is not.
fn dark(pieces: &[(u32, Piece)], source: &PointSource, occlude: &dyn Occlude) -> Vec<f64> {
    let mut dark = vec![0.0; (SIZE * SIZE) as usize];
    for (row, piece) in pieces {
        let is_dark = match (piece.known.lit >> 5 & 1, piece.known.dark >> 5 & 1) {
            (0, 0) => arrives(piece, source, occlude) == 0.0,
            (0, 1) => true,
            (1, 0) => false,
            _ => panic!("both lit and dark"),
        };
        if is_dark {
            dark[(row * SIZE + piece.column) as usize] += f64::from(piece.share);
        }
    }
    dark
}

/// Transmittance from the hit of a piece to a source.
fn arrives(piece: &Piece, source: &PointSource, occlude: &dyn Occlude) -> f32 {
    let place = piece.hit.place;
    let segment = match *source {
        PointSource::At(at) => place.toward(at.as_vec3()),
        PointSource::Toward(toward) | PointSource::Below { toward, .. } => {
            place.leave(toward.as_vec3(), f32::INFINITY)
        }
    };
    occlude.transmittance(&segment).0[0]
}

/// The shadow of a screen on the floor, on the screen of the picture.
fn outline(screen: &[DVec3], source: &PointSource, view: &View) -> Vec<DVec2> {
    let shadow = Screens::shadow(screen, source, DVec3::ZERO);
    shadow.iter().map(|p| view.screen_from_view(view.view_from_world(*p)).truncate()).collect()
}

/// Root of the mean squared error over the pixels that the outline passes through.
fn rmse(found: &[f64], outline: &[DVec2]) -> f64 {
    let (mut sum, mut count) = (0.0, 0u32);
    for (i, dark) in (0..).zip(found) {
        let area = reference::area(outline, i % SIZE, i / SIZE);
        if area > 1e-9 && area < 1.0 - 1e-9 {
            sum += (dark - area).powi(2);
            count += 1;
        }
    }
    (sum / f64::from(count.max(1))).sqrt()
}

/// A lamp and a sun.
fn sources() -> [PointSource; 2] {
    [PointSource::At(DVec3::new(1.3, 9.0, -0.7)), PointSource::Toward(DVec3::new(0.3, 0.8, -0.2).normalize())]
}

/// Corners from the R₂ sequence (Roberts 2018), at the height of 2 m.
fn corner(i: u32) -> DVec3 {
    let phi = 1.324_717_957_244_746_f64;
    let at = |step: f64| ((f64::from(i) * step).fract() - 0.5) * 14.0;
    DVec3::new(at(1.0 / phi), 2.0, at(1.0 / (phi * phi)))
}

/// A half plane whose edge goes through (0, 2, 0) in the direction of `angle`.
fn half_plane(angle: f64) -> Vec<DVec3> {
    let along = DVec3::new(angle.cos(), 0.0, angle.sin()) * 40.0;
    let out = DVec3::new(-along.z, 0.0, along.x);
    [-along, along, along + out, out - along].map(|p| p + 2.0 * DVec3::Y).into()
}

#[test]
fn straight_edges_are_exact() {
    for source in sources() {
        for i in 0..24 {
            // From −80° to 80° to the upright. Flatter ones come into the picture beside the lines.
            let angle = (90.0 - 80.0 + 160.0 * f64::from(i) / 23.0f64).to_radians();
            let screen = half_plane(angle);
            for view in [above(), oblique(DVec3::new(0.0, 30.0, 9.0))] {
                for strips in [1, 4] {
                    let screens = Screens::new(vec![screen.clone()]);
                    let stage = lit_by(floor(1), view, knobs(Rule::Exact, strips), source, &screens);
                    let found = dark(&all(&stage), &source, &screens);
                    // Two shares are rounded to f32 in a pixel, and the triangle's corners are exact; the corners of
                    // the screen are 40 m away: 2⁻⁵³ of that, some roundings, is far less.
                    let error = rmse(&found, &outline(&screen, &source, &view));
                    assert!(error < f64::from(f32::EPSILON), "{i} {strips} {error}");
                }
            }
        }
    }
}

#[test]
fn cutting_beats_one_ray_for_a_piece() {
    println!(
        "RMSE of the dark share at edges of shadows: strips, one ray a piece, cut by midpoint, cut by exact"
    );
    let source = sources()[0];
    for (name, corners, faces) in [("triangles", 3, 1), ("quadrangles", 4, 1), ("triangles on 8 × 8", 3, 8)]
    {
        let mut before = f64::INFINITY;
        for strips in [1, 2, 4, 8] {
            let mut errors = [0.0; 3];
            for i in 0..40 {
                // Every other corner of a rising sequence turns around the middle: convex for four corners too.
                let mut screen: Vec<DVec3> = (0..corners).map(|k| corner(corners * i + k)).collect();
                if corners == 4 {
                    let (a, b) = (screen[0], screen[1]);
                    let out = 0.4 * DVec3::new(a.z - b.z, 0.0, b.x - a.x);
                    screen = vec![a, b, b + out, a + out];
                }
                let screens = Screens::new(vec![screen.clone()]);
                let outline = outline(&screen, &source, &above());
                let rays = all(&stage(floor(faces), above(), knobs(Rule::Exact, strips)));
                errors[0] += rmse(&dark(&rays, &source, &screens), &outline).powi(2) / 40.0;
                for (k, rule) in [(1, Rule::Midpoint), (2, Rule::Exact)] {
                    let cut = lit_by(floor(faces), above(), knobs(rule, strips), source, &screens);
                    errors[k] += rmse(&dark(&all(&cut), &source, &screens), &outline).powi(2) / 40.0;
                }
            }
            let [rays, midpoint, exact] = errors.map(f64::sqrt);
            println!("{name:<20} {strips:>2}  {rays:.4}  {midpoint:.4}  {exact:.4}");
            assert!(exact < midpoint && midpoint < rays && exact < before);
            before = exact;
        }
    }
}

/// Counts the questions.
struct Counted(Screens, AtomicU64);

impl Occlude for Counted {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        self.0.transmittance(segment)
    }

    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.shadows(source, a, b, out)
    }
}

#[test]
fn narrower_spans_cost_more_and_leave_less() {
    println!("Spans cut from, questions for each of the rays that shade all, RMSE of the dark share");
    let source = sources()[0];
    let mut last = (f64::INFINITY, 0.0);
    for least in [0.0, 0.25, 0.5, 1.0, 3.0, 6.0, 99.0] {
        let (mut error, mut asked, mut rays) = (0.0, 0, 0);
        for i in 0..40 {
            let screen: Vec<DVec3> = (3 * i..3 * i + 3).map(corner).collect();
            let counted = Arc::new(Counted(Screens::new(vec![screen.clone()]), AtomicU64::new(0)));
            let stage = stage(floor(8), above(), Knobs::default());
            rays += all(&stage).len();
            let stage = stage.with_shadows(vec![(5, source)], counted.clone()).cut_from(least);
            let found = dark(&all(&stage), &source, &*counted);
            error += rmse(&found, &outline(&screen, &source, &above())).powi(2) / 40.0;
            asked += counted.1.load(Ordering::Relaxed);
        }
        let (error, asked) = (error.sqrt(), asked as f64 / rays as f64);
        println!("{least:>4}  {asked:.3}  {error:.4}");
        assert!(asked < last.0 && error > last.1);
        last = (asked, error);
    }
}

#[test]
fn cutting_moves_no_share() {
    let screens = Screens::new((0..5).map(|i| [3 * i, 3 * i + 1, 3 * i + 2].map(corner).into()).collect());
    for rule in [Rule::Trapezoid, Rule::Midpoint, Rule::Exact] {
        for shading in [Shading::PerPixel, Shading::PerSpan] {
            let knobs = Knobs { rule, shading, sub_scanlines: 3 };
            let of = |stage: &Scanline| common::totals(stage, SIZE, SIZE);
            let plain = of(&stage(floor(7), above(), knobs));
            let cut = of(&lit_by(floor(7), above(), knobs, sources()[0], &screens));
            for (a, b) in plain.iter().zip(cut) {
                // Up to 60 pieces, each rounded to f32.
                assert!((a - b).abs() <= 60.0 * f64::from(f32::EPSILON), "{rule:?} {a} {b}");
            }
        }
    }
}

#[test]
fn what_is_not_told_stays_unknown() {
    let mut screens = Screens::new(vec![half_plane(1.0)]);
    screens.tells = false;
    let known = |screens: &Screens| {
        let stage = lit_by(floor(1), above(), Knobs::default(), sources()[0], screens);
        let mut all: Vec<Known> = all(&stage).iter().map(|(_, piece)| piece.known).collect();
        all.sort_unstable();
        all.dedup();
        all
    };
    assert_eq!(known(&screens), [Known::default()]);
    (screens.tells, screens.dark) = (true, false);
    assert_eq!(known(&screens), [Known::default(), Known { lit: 1 << 5, dark: 0 }]);
    screens.dark = true;
    assert_eq!(known(&screens), [Known { lit: 0, dark: 1 << 5 }, Known { lit: 1 << 5, dark: 0 }]);
}

#[test]
fn veils_stay_unknown_and_what_lies_behind_is_known() {
    let veil = |y: f32| {
        let corners = [(-900.0, 900.0), (900.0, 900.0), (0.0, -900.0)];
        let opacity = Some(Arc::new(light::Opacity { texture: None, factor: 0.25, cutoff: None }));
        light::Mesh { opacity, ..soup(&[corners.map(|(x, z)| Vec3::new(x, y, z))]) }
    };
    let Geometry { mut meshes, mut instances } = floor(1);
    meshes.push(veil(1.0));
    instances.push(light::Instance { mesh: 1, ..instances[0] });
    let screens = Screens::new(vec![half_plane(1.0)]);
    let sun = sources()[1];
    let stage = stage(Geometry { meshes, instances }, above(), Knobs::default())
        .with_shadows(vec![(5, sun), (63, sun), (64, sun), (u32::MAX, sun)], Arc::new(screens));
    let both = 1 << 5 | 1 << 63;
    let (mut lit, mut dark) = (0.0, 0.0);
    for (_, piece) in all(&stage) {
        match (piece.hit.instance, piece.known) {
            (1, Known { lit: 0, dark: 0 }) => {}
            (0, Known { lit: bits, dark: 0 }) if bits == both => lit += piece.share,
            (0, Known { lit: 0, dark: bits }) if bits == both => dark += piece.share,
            other => panic!("{other:?}"),
        }
    }
    // Behind the veil three quarters are left of all 24 × 24 pixels, each share rounded to f32.
    let whole = 0.75 * (SIZE * SIZE) as f32;
    assert!(
        lit > 0.0
            && dark > 0.0
            && (lit + dark - whole).abs() < whole * (2 * SIZE * SIZE) as f32 * f32::EPSILON
    );
}

#[test]
fn the_way_the_picture_is_cut_does_not_matter() {
    let screens = Screens::new((0..5).map(|i| [3 * i, 3 * i + 1, 3 * i + 2].map(corner).into()).collect());
    let lamps = (0..7).map(|i| (9 * i, PointSource::At(corner(i + 50) + 7.0 * DVec3::Y))).collect::<Vec<_>>();
    for rule in [Rule::Trapezoid, Rule::Midpoint, Rule::Exact] {
        for shading in [Shading::PerPixel, Shading::PerSpan] {
            let knobs = Knobs { rule, shading, sub_scanlines: 3 };
            let stage = stage(floor(5), oblique(DVec3::new(3.0, 20.0, 15.0)), knobs)
                .with_shadows(lamps.clone(), Arc::new(screens.clone()));
            let whole = all(&stage);
            assert!(whole.iter().any(|(_, piece)| piece.known.dark.count_ones() > 2));
            let mut rows = Vec::new();
            for start in (0..SIZE).step_by(7) {
                rows.extend(picture(&stage, start..(start + 7).min(SIZE), 0..SIZE));
            }
            assert_eq!(whole, rows);
            let here = |(r, p): &&(u32, Piece)| (5..19).contains(r) && (11..16).contains(&p.column);
            let expected: Vec<_> = whole.iter().filter(here).copied().collect();
            assert_eq!(picture(&stage, 5..19, 11..16), expected);
        }
    }
}

/// Triangles anywhere, in closed form, asked one by one.
struct Faces(Vec<[DVec3; 3]>);

impl Faces {
    fn of(geometry: &Geometry) -> Self {
        let opaque = (0u32..).zip(&geometry.instances).flat_map(|(instance, placed)| {
            let count = geometry.meshes[placed.mesh as usize].triangles.len() as u32;
            (0..count).map(move |triangle| geometry.triangle(instance, triangle).0)
        });
        Self(opaque.collect())
    }

    /// The way from p to the source meets a face if p and the source are on both sides of its plane, and p within
    /// the three planes through the source and its edges: four conditions linear in p.
    fn stretch(face: &[DVec3; 3], source: &PointSource, a: DVec3, b: DVec3) -> Option<(f64, f64)> {
        let toward = |from: DVec3| match *source {
            PointSource::At(at) => at - from,
            PointSource::Toward(toward) | PointSource::Below { toward, .. } => toward,
        };
        let plane = (face[1] - face[0]).cross(face[2] - face[0]).normalize();
        let side = plane.dot(toward(face[0])).signum();
        let behind = |p: DVec3| -side * plane.dot(p - face[0]);
        // A segment that lies in the plane casts nothing on itself, and what a source lies in hides nothing of it.
        let coplanar = behind(a).abs().max(behind(b).abs()) < 1e-9;
        if coplanar || plane.dot(toward(face[0])).abs() < 1e-9 {
            return None;
        }
        let (mut from, mut to) = (0.0f64, 1.0f64);
        let mut keep = |da: f64, db: f64| {
            let t = da / (da - db);
            match (da > 0.0, db > 0.0) {
                (true, true) => {}
                (false, true) => from = from.max(t),
                (true, false) => to = to.min(t),
                (false, false) => to = -1.0,
            }
        };
        keep(behind(a), behind(b));
        for i in 0..3 {
            let (v, edge) = (face[i], face[(i + 1) % 3] - face[i]);
            let within = |p: DVec3| side * edge.cross(p - v).dot(toward(v));
            keep(within(a), within(b));
        }
        (from < to).then_some((from, to))
    }
}

impl Occlude for Faces {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let (a, d) = (segment.origin.as_dvec3(), segment.direction.as_dvec3());
        let meets = |face: &[DVec3; 3]| {
            let triangle = light::Triangle(*face);
            let Some(weights) = triangle.meet(a, d) else { return false };
            let normal = triangle.cross();
            let t = normal.dot(face[0] - a) / normal.dot(d);
            weights.min_element() >= 0.0
                && weights.element_sum() <= 1.0
                && 0.0 < t
                && t < f64::from(segment.length)
        };
        if self.0.iter().any(meets) { Spectrum::ZERO } else { Spectrum::ONE }
    }

    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        let stretches = self.0.iter().filter_map(|face| Self::stretch(face, source, a, b));
        out.extend(stretches.map(|(from, to)| Stretch { from, to, dark: true }));
        true
    }
}

/// Hills and blades that stand and hang about.
fn hills() -> Geometry {
    let hills = common::terrain(12, 30.0, |x, z| (0.9 * x).sin() * (0.7 * z).cos());
    let at = |i: u32| (corner(i) * DVec3::new(1.0, 1.5, 1.0)).as_vec3();
    let blades: Vec<_> = (0..6).map(|i| [at(3 * i), at(3 * i + 1), at(3 * i + 2) + 2.0 * Vec3::Y]).collect();
    let instance = |mesh| light::Instance { mesh, world_from_mesh: glam::DAffine3::IDENTITY };
    Geometry { meshes: vec![hills, soup(&blades)], instances: vec![instance(0), instance(1)] }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Spans by the midpoint rule, one piece for each: what is known is exact where each is shaded, in its middle.
    /// The lamp may be above or below all, or inside a hill.
    #[test]
    fn among_hills_what_is_known_is_true(
        lamp in (-9f64..9.0, -3f64..9.0, -9f64..9.0),
        sun in prop::bool::ANY,
        eye in (-20f64..20.0, 3f64..30.0, 1f64..20.0),
    ) {
        let source = match (DVec3::from(lamp), sun) {
            (at, false) => PointSource::At(at),
            (at, true) => PointSource::Toward(at.normalize()),
        };
        let faces = Arc::new(Faces::of(&hills()));
        let knobs = Knobs { rule: Rule::Midpoint, shading: Shading::PerSpan, sub_scanlines: 2 };
        let stage = stage(hills(), oblique(eye.into()), knobs);
        let stage = stage.with_shadows(vec![(5, source)], faces.clone()).cut_from(0.0);
        for (_, piece) in all(&stage) {
            let place = piece.hit.place;
            let to = match source {
                PointSource::At(at) => at - place.position.as_dvec3(),
                PointSource::Toward(toward) | PointSource::Below { toward, .. } => toward,
            };
            let slant = place.normal.as_dvec3().dot(to.normalize()).abs();
            // Positions are wrong by 4 · 2⁻²⁴ · 15 m, and where light grazes that shifts shadows by 1/slant as much. A
            // pixel is at least 3 mm wide at 0.1 m from the eye and more beyond: parts wider than 1/8 of one, of
            // a strip that is half a row high, have their middle far from their borders.
            if piece.share < 0.5 / 8.0 || slant < 0.1 {
                continue;
            }
            let (lit, dark) = (piece.known.lit >> 5, piece.known.dark >> 5);
            prop_assert_eq!(lit + dark, 1);
            let arrives = arrives(&piece, &source, &*faces);
            prop_assert!((lit == 1) == (arrives > 0.0), "{:?}", piece);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// What is said to be dark is dark at the place that is shaded, and what is lit is lit.
    #[test]
    fn what_is_known_is_true_where_it_is_shaded(
        first in 0u32..1000,
        count in 1u32..6,
        lamp in (-6f64..6.0, 5f64..20.0, -6f64..6.0),
        sun in prop::bool::ANY,
        eye in (-20f64..20.0, 10f64..30.0, 1f64..20.0),
        rule in prop::sample::select(vec![Rule::Trapezoid, Rule::Midpoint, Rule::Exact]),
        strips in 1u32..6,
        faces in 1u32..5,
        per_span in prop::bool::ANY,
    ) {
        let screens: Vec<Vec<DVec3>> =
            (0..count).map(|i| [0, 1, 2].map(|k| corner(first + 3 * i + k)).into()).collect();
        // What is inside of a sliver is more than rounding of the test's own sums can tell.
        prop_assume!(screens.iter().all(|s| (s[1] - s[0]).cross(s[2] - s[0]).length() > 1.0));
        let screens = Screens::new(screens);
        let source = match (DVec3::from(lamp), sun) {
            (at, false) => PointSource::At(at),
            (at, true) => PointSource::Toward(at.normalize()),
        };
        let view = oblique(eye.into());
        let shading = if per_span { Shading::PerSpan } else { Shading::PerPixel };
        let knobs = Knobs { rule, shading, sub_scanlines: strips };
        let stage = lit_by(floor(faces), view, knobs, source, &screens);
        let (mut wrong, mut known) = (0, 0);
        for (_, piece) in all(&stage) {
            let (lit, dark) = (piece.known.lit >> 5, piece.known.dark >> 5);
            prop_assert!(piece.known.lit & piece.known.dark == 0 && (lit | dark) <= 1);
            known += lit + dark;
            let arrives = arrives(&piece, &source, &screens);
            wrong += u64::from((lit == 1 && arrives == 0.0) || (dark == 1 && arrives > 0.0));
        }
        // Between the lines a shadow may end, or two may cross: at 3 corners each and 6 crossings of any two at
        // most. By the exact rule a nearly level edge goes on from there within its strip, along the row.
        let count = screens.screens.len() as u64;
        let corners = 3 * count + 3 * count * (count - 1);
        let each = if rule == Rule::Exact { u64::from(SIZE / 2) } else { 2 };
        prop_assert!(wrong <= each * corners, "{} of {}", wrong, known);
    }
}
