use crate::luminous::tests::standard;
use crate::{Description, PATCH_ROWS, PatchSky};

use super::*;

/// Blocks what goes to the side x > 0, half of what goes to z > 0, and counts.
#[derive(Default)]
struct Screens(AtomicUsize);

impl Occlude for Screens {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        self.0.fetch_add(1, Ordering::Relaxed);
        match segment.direction {
            direction if direction.x > 0.0 => Spectrum::ZERO,
            direction if direction.z > 0.0 => Spectrum::splat(0.5),
            _ => Spectrum::ONE,
        }
    }
}

fn map(altitude: f32) -> Mapped {
    let sky = PatchSky::new(&Description::new(Arc::new(standard("clear", altitude))), PATCH_ROWS);
    let sun = altitude.to_le_bytes();
    Mapped::new(Arc::new(sky), still(lawn(20.0)), Settings::default(), &Described { hiding: &[], sky: &sun })
}

fn middle(map: &Mapped, occlude: &dyn Occlude) -> Spectrum {
    let place = Place { position: Vec3::new(1.0, 0.0, -2.0), error: 1e-6, normal: Vec3::Y, seed: 7 };
    let mut sum = Spectrum::ZERO;
    map.arrivals_on([0, 1], &place, occlude, &mut |arrival| sum += arrival.on_plane(Vec3::Y));
    sum
}

#[test]
fn a_moved_sun_asks_nothing_again() {
    let screens = Screens::default();
    let morning = map(10.0);
    let sights = Arc::new(Sights::new(morning.key()));
    let morning = morning.with_sights(Arc::clone(&sights));
    let first = middle(&morning, &screens);
    let asked = screens.0.load(Ordering::Relaxed);
    let noon = map(50.0).with_sights(Arc::clone(&sights));
    let second = middle(&noon, &screens);
    assert!(asked > 0 && sights.count() > 0);
    assert_eq!(screens.0.load(Ordering::Relaxed), asked);
    assert_eq!(second, middle(&map(50.0), &screens));
    assert_ne!(first, second);
}

#[test]
fn what_is_seen_comes_back_from_bytes() {
    let screens = Screens::default();
    let first = map(10.0);
    let sights = Arc::new(Sights::new(first.key()));
    let value = middle(&first.with_sights(Arc::clone(&sights)), &screens);
    let bytes = sights.to_bytes();
    let again = Sights::from_bytes(map(10.0).key(), &bytes).unwrap();
    assert_eq!(again.count(), sights.count());
    assert_eq!(again.to_bytes(), bytes);
    let asked = screens.0.load(Ordering::Relaxed);
    assert_eq!(middle(&map(10.0).with_sights(Arc::new(again)), &screens), value);
    assert_eq!(screens.0.load(Ordering::Relaxed), asked);
}

#[test]
fn what_is_damaged_or_of_other_places_is_refused() {
    let key = map(10.0).key();
    let sights = Arc::new(Sights::new(key));
    middle(&map(10.0).with_sights(Arc::clone(&sights)), &Screens::default());
    let bytes = sights.to_bytes();
    for at in [0, 9, 20, 60, bytes.len() / 2, bytes.len() - 1] {
        let mut damaged = bytes.clone();
        damaged[at] ^= 1;
        assert!(Sights::from_bytes(key, &damaged).is_err(), "{at}");
    }
    for length in [0, 8, 40, bytes.len() - 1] {
        assert!(Sights::from_bytes(key, &bytes[..length]).is_err(), "{length}");
    }
    let settings = Settings { inset: 0.02, ..Settings::default() };
    let sky = PatchSky::new(&Description::new(Arc::new(standard("clear", 10.0))), PATCH_ROWS);
    let other = Mapped::new(Arc::new(sky), still(lawn(20.0)), settings, &Described::default());
    assert_eq!(Sights::from_bytes(other.key(), &bytes).err(), Some(KeptError::OtherPlaces));
    assert!(!sights.belong_to(other.key()));
}
