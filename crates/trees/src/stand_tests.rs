//! Laws of many trees, against asking every one of them.

use std::f32::consts::TAU;
use std::sync::LazyLock;

use glam::{DVec3, Vec3};
use light::{
    Arrival, Illuminate, Occlude, Path, Place, PointSource, Ray, Spectrum, Surroundings, Traverse, Uniform,
    Vacuum, check,
};
use proptest::prelude::*;

use crate::region::random;
use crate::species::tests::plain;
use crate::{Fade, Placed, Setting, Shading, Species, Stand, StandError, Turn};

/// A light and what is in its way.
struct Around<'a>(&'a dyn Illuminate, &'a dyn Occlude);

impl Surroundings for Around<'_> {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        self.0.arrivals(place, self.1, receive);
    }

    fn radiance(&self, ray: &Ray, _: Path) -> Spectrum {
        self.0.radiance(ray)
    }
}

/// A sun without a disc.
struct Beam(Vec3);

impl Illuminate for Beam {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        if self.0.dot(place.normal) > 0.0 {
            let irradiance = occlude.transmittance(&place.leave(self.0, f32::INFINITY));
            receive(Arrival::Beam { toward: self.0, irradiance, radius: None });
        }
    }
}

/// `count` trees anywhere in a square of `side` metres.
fn stand(count: u32, side: f32) -> Stand {
    let tree = |i: u32| Placed {
        species: i % 2,
        position: Vec3::new((random(i, 1) - 0.5) * side, random(i, 2), (random(i, 3) - 0.5) * side),
        height: 5.0 + 5.0 * random(i, 4),
        rotation: TAU * random(i, 5),
    };
    static SPECIES: LazyLock<Vec<Species>> =
        LazyLock::new(|| [120, 255].map(|alpha| Species::new(plain(alpha)).unwrap()).to_vec());
    Stand::new(SPECIES.clone(), (0..count).map(tree).collect()).unwrap()
}

fn settings() -> [Setting; 4] {
    let [a, b, c] = [Fade::Thesis, Fade::Opaque, Fade::Density];
    let set = |(fade, turn)| Setting { fade, turn };
    [(a, Turn::WithEye), (b, Turn::Fixed), (c, Turn::WithEye), (c, Turn::Fixed)].map(set)
}

fn ray(from: [f32; 3], to: [f32; 3]) -> Ray {
    Ray::between(Vec3::from(from), Vec3::from(to))
}

#[test]
fn placements_that_are_none_are_refused() {
    let species = || vec![Species::new(plain(120)).unwrap()];
    let tree = Placed { species: 0, position: Vec3::ZERO, height: 5.0, rotation: 0.0 };
    let error = |tree| Stand::new(species(), vec![tree]).err();
    assert_eq!(error(tree), None);
    assert_eq!(error(Placed { species: 1, ..tree }), Some(StandError::NoSpecies(0)));
    assert_eq!(error(Placed { height: 0.0, ..tree }), Some(StandError::NotANumber(0)));
    assert_eq!(error(Placed { position: Vec3::NAN, ..tree }), Some(StandError::NotANumber(0)));
    let none = Stand::new(species(), Vec::new()).unwrap();
    assert!(none.bounds().is_none());
    assert_eq!(none.transmittance(&Ray::new(Vec3::ZERO, Vec3::X)), Spectrum::ONE);
}

/// As many trees as one likes at one point: dark, and no endless descent.
#[test]
fn many_trees_at_one_point_are_one_dark_tree() {
    let tree = Placed { species: 0, position: Vec3::ZERO, height: 10.0, rotation: 0.0 };
    let stand = Stand::new(vec![Species::new(plain(120)).unwrap()], vec![tree; 100_000]).unwrap();
    let through = ray([20.0, 6.0, 0.0], [-20.0, 6.0, 0.5]);
    assert_eq!(stand.transmittance(&through), Spectrum::ZERO);
    let way = stand.way(&through, Path::EYE, &Around(&Uniform { radiance: Spectrum::ONE }, &Vacuum));
    assert!(way.transmittance.is_zero() && way.added.max() <= 1.0);
    // Beside it is clear.
    assert_eq!(stand.transmittance(&ray([20.0, 6.0, 5.0], [-20.0, 6.0, 5.0])), Spectrum::ONE);
    let [trees, _] = stand.bytes();
    assert!(trees <= 48 * 100_000, "{trees}");
}

proptest! {
    #[test]
    fn the_hierarchy_forgets_no_tree_and_the_way_back_is_as_clear(
        from in prop::array::uniform3(-30.0f32..30.0), to in prop::array::uniform3(-5.0f32..30.0), which in 0usize..4,
    ) {
        let stand = stand(60, 50.0).with(settings()[which], Shading::default());
        let segment = ray(from, to);
        let all: f32 = (0..60).map(|tree| stand.through(tree, &segment)).product();
        let found = stand.transmittance(&segment)[0];
        prop_assert!((0.0..=1.0).contains(&found));
        // 60 factors rounded once each, and what counts as dark.
        prop_assert!((found - all).abs() < 1e-5, "{found} {all}");
        // Roundings of ends at 100 m move points by 1e-5 m; texels are 12 cm wide, and an end may cross a border of a crown.
        let edge = [segment.origin, segment.at(segment.length)].iter().any(|end| {
            (0..60).any(|tree| {
                let inside = |by: f32| {
                    let (species, _, line, _) = stand.local(tree, &Ray::new(*end + Vec3::splat(by), Vec3::X));
                    species.holds(line.0)
                };
                inside(1e-3) != inside(-1e-3)
            })
        });
        prop_assume!(!edge);
        prop_assert!(check::reciprocity(&stand, &segment) < 2e-3);
    }

    #[test]
    fn crossings_come_in_order_and_all_of_them(
        from in prop::array::uniform3(-30.0f32..30.0), to in prop::array::uniform3(-5.0f32..30.0), which in 0usize..4,
    ) {
        let stand = stand(60, 50.0).with(settings()[which], Shading::default());
        let ray = ray(from, to);
        let path = Path { spread: if which % 2 == 0 { 0.001 } else { 0.0 }, ..Path::EYE };
        let mut met = Vec::new();
        stand.crossings(&ray, &path, |crossing| {
            met.push((crossing.distance, crossing.opacity));
            true
        });
        prop_assert!(met.windows(2).all(|pair| pair[0].0 <= pair[1].0));
        prop_assert!(met.iter().all(|(at, opacity)| *at <= ray.length && *opacity > 0.0 && *opacity <= 1.0));
        let mut each = Vec::new();
        for tree in 0..60 {
            each.extend(stand.alone(tree, &ray, &path).iter().map(|crossing| (crossing.distance, crossing.opacity)));
        }
        met.sort_by(|a, b| a.partial_cmp(b).unwrap());
        each.sort_by(|a, b| a.partial_cmp(b).unwrap());
        prop_assert_eq!(met, each);
    }

    /// A tree gives back no more than arrives: in a white furnace it is never brighter than that.
    #[test]
    fn in_a_furnace_no_tree_shines(
        from in prop::array::uniform3(-30.0f32..30.0), to in prop::array::uniform3(-5.0f32..10.0), which in 0usize..4,
    ) {
        let stand = stand(60, 50.0).with(settings()[which], Shading::default());
        let white = Uniform { radiance: Spectrum::ONE };
        let way = stand.way(&ray(from, to), Path { spread: 0.001, ..Path::EYE }, &Around(&white, &Vacuum));
        let seen = way.bring(Spectrum::ONE);
        // A dozen f32 sums of parts of 1.
        prop_assert!(seen.max() <= 1.0 + 20.0 * f32::EPSILON, "{seen:?}");
        prop_assert!(way.added.0.iter().all(|band| *band >= 0.0));
    }

    /// Leaves that take nothing give back all that falls on them: in a white furnace they cannot be told from it; those that take a part
    /// give back the rest, neither more nor less.
    #[test]
    fn in_a_furnace_white_leaves_vanish(
        from in prop::array::uniform3(-30.0f32..30.0), to in prop::array::uniform3(-5.0f32..10.0), which in 0usize..4,
        reflectance in 0.1f32..0.6, transmittance in 0.0f32..0.4,
    ) {
        let mut description = plain(200);
        description.leaf.reflectance = Some(Spectrum::splat(reflectance));
        description.leaf.transmittance = Spectrum::splat(transmittance);
        let tree = Placed { species: 0, position: Vec3::ZERO, height: 10.0, rotation: 0.4 };
        let stand = Stand::new(vec![Species::new(description).unwrap()], vec![tree]).unwrap();
        let stand = stand.with(settings()[which], Shading::default());
        let white = Uniform { radiance: Spectrum::ONE };
        let way = stand.way(&ray(from, to), Path { spread: 0.001, ..Path::EYE }, &Around(&white, &Vacuum));
        let hidden = 1.0 - way.transmittance[3];
        // What counts as opaque leaves out up to 1/512; colours of texels are 16-bit codes of a tenth: 2e-4 of them.
        let truth = (reflectance + transmittance) * hidden;
        prop_assert!((way.added[3] - truth).abs() <= 1.0 / 512.0 + 1e-3 * truth, "{} {truth}", way.added[3]);
    }

    /// Of a beam, a leaf scatters no more than it catches: E/π at most towards any eye.
    #[test]
    fn no_leaf_is_brighter_than_white_paper(
        from in prop::array::uniform3(-30.0f32..30.0), sun in prop::array::uniform3(-1.0f32..1.0), which in 0usize..4,
        ambient in 0.0f32..1.0, near in any::<bool>(),
    ) {
        let Some(toward) = Vec3::from(sun).try_normalize() else { return Ok(()) };
        let shading = if which == 0 { Shading::Thesis { ambient } } else { Shading::Leaves };
        let stand = stand(60, 50.0).with(settings()[which], shading);
        let path = Path { spread: if near { 1e-4 } else { 0.02 }, ..Path::EYE };
        let way = stand.way(&ray(from, [0.0, 5.0, 0.0]), path, &Around(&Beam(toward), &stand));
        let white = std::f32::consts::FRAC_1_PI * (Spectrum::ONE - way.transmittance).max();
        // Sums of a few dozen f32 parts; below the limit of what counts as opaque 1/512 may be missing in the share.
        prop_assert!(way.added.max() <= white * (1.0 + 50.0 * f32::EPSILON) + 1.0 / 512.0);
    }

    /// Where no stretch is, light arrives whole.
    #[test]
    fn shadows_are_where_stretches_say(
        a in prop::array::uniform3(-30.0f64..30.0), b in prop::array::uniform3(-30.0f64..30.0),
        toward in prop::array::uniform3(-1.0f64..1.0), lamp in any::<bool>(),
    ) {
        let stand = stand(6, 60.0);
        let (a, b) = (DVec3::from(a), DVec3::from(b));
        let toward = (DVec3::from(toward) + DVec3::Y * 1.1).normalize();
        let source = if lamp { PointSource::At(toward * 25.0) } else { PointSource::Toward(toward) };
        let mut stretches = Vec::new();
        prop_assert!(stand.shadows(&source, a, b, &mut stretches));
        for i in 0..100 {
            let share = (f64::from(i) + 0.5) / 100.0;
            if stretches.iter().any(|stretch| stretch.from <= share && share <= stretch.to) {
                continue;
            }
            let here = a.lerp(b, share).as_vec3();
            let segment = if lamp {
                Ray::between(here, (toward * 25.0).as_vec3())
            } else {
                Ray::new(here, toward.as_vec3())
            };
            prop_assert_eq!(stand.transmittance(&segment), Spectrum::ONE);
        }
    }
}

/// Seen against the sun, leaves that let nothing through are dark and others are not.
#[test]
fn light_from_behind_comes_through_leaves() {
    let seen = |transmittance: f32, sun: Vec3| {
        let mut description = plain(120);
        description.leaf.transmittance = Spectrum::splat(transmittance);
        let tree = Placed { species: 0, position: Vec3::ZERO, height: 10.0, rotation: 0.0 };
        let stand = Stand::new(vec![Species::new(description).unwrap()], vec![tree]).unwrap();
        let eye = Ray::new(Vec3::new(0.0, 6.0, 40.0), Vec3::NEG_Z);
        let path = Path { spread: 0.01, ..Path::EYE };
        stand.way(&eye, path, &Around(&Beam(sun), &stand)).added[3]
    };
    let (front, back) = (Vec3::new(0.0, 0.6, 0.8), Vec3::new(0.0, 0.6, -0.8));
    assert!(seen(0.0, front) > 0.0);
    assert!(seen(0.1, back) > 2.0 * seen(0.0, back));
    assert!(seen(0.1, back) < seen(0.1, front));
}

/// The thesis' cheap variant: α of the light arrives whichever way leaves face.
#[test]
fn the_ambient_share_of_the_thesis_is_reflected_from_anywhere() {
    let stand = |ambient| stand(1, 0.0).with(Setting::default(), Shading::Thesis { ambient });
    let eye = Ray::new(Vec3::new(0.0, 4.0, 40.0), Vec3::NEG_Z);
    let seen = |ambient: f32, sun: Vec3| stand(ambient).way(&eye, Path::EYE, &Around(&Beam(sun), &Vacuum));
    let (front, back) = (Vec3::Z, Vec3::NEG_Z);
    let [whole, other] = [front, back].map(|sun| seen(1.0, sun).added[3]);
    assert!(whole > 0.0 && (whole - other).abs() <= 4.0 * f32::EPSILON * whole);
    assert!(seen(0.5, back).added[3] < seen(0.5, front).added[3]);
}
