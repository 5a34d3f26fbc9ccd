//! Maps as bytes, and what they belong to.

use super::super::key::Fnv;
use super::*;

fn with(described: &Described, settings: Settings, geometry: &Arc<Geometry>) -> Mapped {
    Mapped::new(Fake::new(wild), Arc::clone(geometry), settings, described)
}

fn full() -> Mapped {
    let map = with(&Described::default(), EXACT, &still(lawn(4.0)));
    map.prepare(&Vacuum, &[Side::Front]);
    ask(&map, [0, 1], Vec3::X, Vec3::NEG_Y);
    map
}

#[test]
fn fnv_is_the_one_that_is_published() {
    // From the authors' own list of test vectors: the empty string, "a", "foobar".
    assert_eq!(Fnv::new().number(), 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
    assert_eq!(Fnv::new().bytes(b"a").number(), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
    assert_eq!(Fnv::new().bytes(b"foobar").number(), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
}

#[test]
fn what_is_kept_comes_back_whole_and_nothing_is_asked_again() {
    let map = full();
    let bytes = map.to_bytes();
    let fake = Fake::new(wild);
    let mut again = mapped(fake.clone(), &still(lawn(4.0)), EXACT);
    assert_eq!(again.recall(&bytes), Ok(3));
    assert!(again.to_bytes() == bytes);
    for (face, normal) in [([0, 0], Vec3::Y), ([0, 1], Vec3::Y), ([0, 1], Vec3::NEG_Y)] {
        for i in 0..100 {
            let [x, z] = light::sampling::lattice(i, 100, [0, 0]).map(|x| 4.0 * x - 2.0);
            let p = Vec3::new(x, 0.0, z);
            assert_eq!(ask(&again, face, p, normal), ask(&map, face, p, normal));
        }
    }
    assert_eq!(fake.asked.load(Ordering::Relaxed), 0);
}

#[test]
fn maps_of_another_sky_are_not_taken_over() {
    let other = Described { sky: b"dimmer", ..Described::default() };
    let mut again = with(&other, EXACT, &still(lawn(4.0)));
    assert_eq!(again.recall(&full().to_bytes()), Err(KeptError::OtherSky));
    assert_eq!(again.size()[0], 0);
}

#[test]
fn keys_tell_places_and_skies_apart() {
    let plain = Described::default();
    let base = with(&plain, EXACT, &still(lawn(4.0))).key();
    assert_eq!(base, with(&plain, EXACT, &still(lawn(4.0))).key());
    let mut moved = lawn(4.0);
    moved.positions[2].x = moved.positions[2].x.next_up();
    let turned = Mesh { triangles: vec![[1, 2, 0], [0, 2, 3]], ..lawn(4.0) };
    let bent = Mesh { normals: vec![Vec3::Y; 4], ..lawn(4.0) };
    let glass = Mesh { medium: Some(Arc::default()), ..lawn(4.0) };
    let sheer = |texture| light::Opacity { texture, factor: 0.5, cutoff: None };
    let leaf = |alpha| light::Texture::new(1, 1, &[[0.2, 0.4, 0.1, alpha]], Default::default()).map(Arc::new);
    let [half, thin, thick] = [None, leaf(0.3), leaf(0.7)]
        .map(|texture| Mesh { opacity: Some(Arc::new(sheer(texture))), ..lawn(4.0) });
    let mut others: Vec<Key> = [moved, turned, bent, glass, half, thin, thick]
        .into_iter()
        .map(|mesh| with(&plain, EXACT, &still(mesh)).key())
        .collect();
    let away = DAffine3::from_translation(DVec3::new(0.0, 1e-9, 0.0));
    others.push(with(&plain, EXACT, &placed(lawn(4.0), away)).key());
    others.push(with(&Described { hiding: b"tree", sky: b"" }, EXACT, &still(lawn(4.0))).key());
    for settings in [
        Settings { least: 0.11, ..EXACT },
        Settings { coarse: 3.0, ..EXACT },
        Settings { tolerance: 0.03, ..EXACT },
        Settings { inset: 0.01, ..EXACT },
        Settings { seed: 1, ..EXACT },
    ] {
        others.push(with(&plain, settings, &still(lawn(4.0))).key());
    }
    others.push(base);
    let sky = with(&Described { hiding: b"", sky: b"clear" }, EXACT, &still(lawn(4.0))).key();
    assert!(sky.places == base.places && sky.sky != base.sky);
    for (i, a) in others.iter().enumerate() {
        assert!(others[..i].iter().all(|b| b.places != a.places), "{i}");
        assert_eq!(a.sky, base.sky);
    }
}

#[test]
fn strange_bytes_are_told_by_what_they_are() {
    let bytes = full().to_bytes();
    let recall = |bytes: &[u8]| with(&Described::default(), EXACT, &still(lawn(4.0))).recall(bytes);
    assert_eq!(recall(b""), Err(KeptError::Foreign));
    assert_eq!(recall(b"not a map of ours, but long enough to be one"), Err(KeptError::Foreign));
    assert_eq!(recall(&bytes[..8]), Err(KeptError::Damaged));
    assert_eq!(recall(&bytes[..bytes.len() - 1]), Err(KeptError::Damaged));
    assert_eq!(recall(&[&bytes[..], &[0]].concat()), Err(KeptError::Damaged));
    let mut newer = bytes.clone();
    newer[8] = 9;
    assert_eq!(recall(&newer), Err(KeptError::Version(9)));
    let mut other = with(&Described::default(), EXACT, &still(lawn(5.0)));
    assert_eq!(other.recall(&bytes), Err(KeptError::OtherPlaces));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn one_wrong_byte_is_an_error(at: prop::sample::Index, flip in 1u8..) {
        let mut bytes = full().to_bytes();
        let at = at.index(bytes.len());
        bytes[at] ^= flip;
        prop_assert!(full().recall(&bytes).is_err());
    }

    /// Whoever seals nonsense gets an error or something within bounds, at no cost that the bytes do not have.
    #[test]
    fn sealed_nonsense_does_no_harm(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8), sky: bool) {
        let mut bytes = full().to_bytes();
        bytes.truncate(bytes.len() - 16);
        // Beyond magic, version, bands and places, which would end it early.
        let from = 32;
        for (at, byte) in changes {
            let at = from + at.index(if sky { bytes.len() - from } else { 200 });
            bytes[at] = byte;
        }
        let seal = Fnv::new().bytes(&bytes).number();
        bytes.extend(seal.to_le_bytes());
        let mut map = with(&Described::default(), EXACT, &still(lawn(4.0)));
        if map.recall(&bytes).is_ok() {
            for i in 0..50 {
                let [x, z] = light::sampling::lattice(i, 50, [0, 0]).map(|x| 4.0 * x - 2.0);
                for (face, normal) in [([0, 0], Vec3::Y), ([0, 1], Vec3::Y), ([0, 1], Vec3::NEG_Y)] {
                    let e = ask(&map, face, Vec3::new(x, 0.0, z), normal);
                    prop_assert!(e.0.iter().zip(open(normal).0).all(|(e, open)| (0.0..=open).contains(e)));
                }
            }
        }
    }
}
