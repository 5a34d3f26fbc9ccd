//! Paths in scene files.

use std::path::Path;

use glam::DVec3;
use keikan_scene::{Camera, parse};
use light::Projection;

/// Map coordinates: the path moves with the scene; a picture without a time shows its beginning.
#[test]
fn cameras_go_their_ways() {
    let text = "[[model]]\nbox = { size = [2, 3, 4] }\nposition = [500000, 0, -4000000]\n[[camera]]\nname = 'walk'\n\
         target = [500000, 1, -4000000]\nfield_of_view = 90\npath = [\n{ time = 1, position = [500010, 2, -4000000] },\n\
         { time = 3, position = [500000, 2, -3999990], field_of_view = 40, target = [500000, 2, -4000000] }]\n";
    let scene = parse(text, Path::new(""), Path::new("a.toml")).unwrap();
    let walk = &scene.cameras[0];
    let origin = DVec3::new(500_000.0, 0.0, -4_000_000.0);
    // The middle of the box is 1.5 m high, in whole metres 2.
    assert_eq!(scene.origin, origin + DVec3::Y * 2.0);
    assert_eq!(walk.path.as_ref().map(|path| path.seconds()), Some([1.0, 3.0]));
    assert_eq!(walk.position, DVec3::new(10.0, 0.0, 0.0));
    assert_eq!(walk.at(1.0), *walk);
    assert_eq!(walk.at(9.0).position, DVec3::new(0.0, 0.0, 10.0));
    assert!((walk.at(9.0).world_from_camera * DVec3::NEG_Z - DVec3::NEG_Z).length() < 1e-12);
    let tan = |camera: &Camera| match camera.projection {
        Projection::Perspective { tan_half_height } => tan_half_height,
        Projection::Orthographic { half_height } => half_height,
    };
    // tan 45° = 1 and tan 20° = 0.36397, and half-way between them by symmetry.
    assert!((tan(walk) - 1.0).abs() < 1e-12 && (tan(&walk.at(3.0)) - 0.363_970_234).abs() < 1e-8);
    assert!((tan(&walk.at(2.0)) - 0.5 * (1.0 + 0.363_970_234)).abs() < 1e-8);
}
