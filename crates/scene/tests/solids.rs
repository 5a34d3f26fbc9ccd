//! `[[solid]]` tables: what they become, and what errors say.

use std::path::Path;

use glam::{DAffine3, DVec3};
use keikan_scene::{Error, Scene, SolidNode, SolidShape, parse};
use light::Projection;
use proptest::prelude::*;

fn read(text: &str) -> Result<Scene, Error> {
    parse(text, Path::new(""), Path::new("a.toml"))
}

fn scene(text: &str) -> Scene {
    let scene = read(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(scene.warnings, [], "{text}");
    scene
}

/// The only solid of a scene.
fn only(text: &str) -> SolidNode {
    let mut scene = scene(text);
    assert_eq!(scene.solids.len(), 1, "{text}");
    scene.solids.remove(0).node
}

/// Shape, placement and material of a solid that is no operation.
fn shape(text: &str) -> (SolidShape, DAffine3, u32) {
    match only(text) {
        SolidNode::Shape { shape, world_from_solid, material } => (shape, world_from_solid, material),
        operation => panic!("{operation:?}"),
    }
}

#[test]
fn round_solids_are_unit_shapes_stretched() {
    let cases = [
        ("sphere = { radius = 2 }", SolidShape::Sphere, DVec3::splat(2.0)),
        ("cylinder = { radius = 2, height = 3 }", SolidShape::Cylinder, DVec3::new(2.0, 3.0, 2.0)),
        ("cone = { radius = 2, height = 3 }", SolidShape::Cone, DVec3::new(2.0, 3.0, 2.0)),
        (
            "frustum = { bottom = 2, top = 1, height = 3 }",
            SolidShape::Frustum { top: 0.5 },
            DVec3::new(2.0, 3.0, 2.0),
        ),
    ];
    for (keys, expected, stretch) in cases {
        let (shape, placement, _) = shape(&format!("[[solid]]\n{keys}\nposition = [10, 20, 30]\n"));
        assert_eq!(shape, expected);
        let position = DVec3::new(10.0, 20.0, 30.0);
        assert_eq!(
            placement,
            DAffine3::from_scale_rotation_translation(stretch, glam::DQuat::IDENTITY, position)
        );
    }
}

#[test]
fn flat_solids_have_planes_and_corners() {
    let parts = |keys: &str| match shape(&format!("[[solid]]\n{keys}\n")).0 {
        SolidShape::Polyhedron { planes, corners } => (planes, corners),
        other => panic!("{other:?}"),
    };
    let (planes, corners) = parts("box = { size = [2, 3, 4] }");
    assert_eq!((planes.len(), corners.len()), (6, 8));
    for plane in [(DVec3::X, 1.0), (DVec3::NEG_X, 1.0), (DVec3::Y, 3.0), (DVec3::NEG_Y, 0.0), (DVec3::Z, 2.0)]
    {
        assert!(planes.contains(&plane), "{plane:?}");
    }
    let (planes, corners) = parts("prism = { sides = 6, radius = 2, height = 5 }");
    assert_eq!((planes.len(), corners.len()), (8, 12));
    // A regular hexagon's sides are √3/2 of its radius away; two roundings each of numbers below 4.
    assert!(
        planes[..6].iter().all(|(n, offset)| n.y == 0.0 && (offset - 3f64.sqrt()).abs() < 4.0 * f64::EPSILON)
    );
    assert_eq!(planes[6..], [(DVec3::NEG_Y, 0.0), (DVec3::Y, 5.0)]);
    assert_eq!(corners[0], DVec3::X * 2.0);
    let (planes, corners) = parts("polyhedron = { points = [[0,0,0], [1,0,0], [0,1,0], [0,0,1]] }");
    assert_eq!((planes.len(), corners.len()), (4, 4));
}

/// A tetrahedron at map coordinates keeps its planes: they are about its own middle.
#[test]
fn solids_far_away_keep_their_size() {
    let [x, y, z] = [1_234_567.0, 41.0, -3_912_345.0];
    let text = format!(
        "[[solid]]\npolyhedron = {{ points = [[{x}, {y}, {z}], [{}, {y}, {z}], [{x}, {}, {z}], [{x}, {y}, {}]] }}\n\
         [[solid]]\nsphere = {{ radius = 0.5 }}\nposition = [{x}, {y}, {}]\n",
        x + 2.0,
        y + 2.0,
        z + 2.0,
        z + 4.0
    );
    let scene = scene(&text);
    // Median of the two middles: the polyhedron's along z, both the same within a metre along x and y.
    assert!((scene.origin - DVec3::new(x, y, z)).abs().max_element() <= 1.0, "{}", scene.origin);
    let (low, high) = scene.solids[0].bounds().unwrap();
    assert_eq!((low + scene.origin, high - low), (DVec3::new(x, y, z), DVec3::splat(2.0)));
    let (low, high) = scene.solids[1].bounds().unwrap();
    assert_eq!(high - low, DVec3::ONE);
    assert_eq!(low + scene.origin, DVec3::new(x - 0.5, y - 0.5, z + 3.5));
}

const BOTTLE: &str = "[[material]]\nname = 'glass'\ntransmission = 1\n[[material]]\nname = 'ink'\n\
    [[solid]]\nname = 'outside'\ncylinder = { radius = 2, height = 4 }\n\
    [[solid]]\nname = 'inside'\ncylinder = { radius = 1, height = 3 }\nposition = [0, 1, 0]\nmaterial = 'ink'\n\
    [[solid]]\nname = 'bottle'\ndifference = ['outside', 'inside']\nmaterial = 'glass'\nposition = [5, 0, 0]\n";

#[test]
fn operations_use_solids_by_name_and_place_them_together() {
    let SolidNode::Difference(whole, others) = only(BOTTLE) else { panic!() };
    let placed = |node: &SolidNode| match node {
        SolidNode::Shape { world_from_solid, material, .. } => (world_from_solid.translation, *material),
        other => panic!("{other:?}"),
    };
    // What names no material takes the operation's.
    assert_eq!(placed(&whole), (DVec3::new(5.0, 0.0, 0.0), 0));
    assert_eq!(others.iter().map(placed).collect::<Vec<_>>(), [(DVec3::new(5.0, 1.0, 0.0), 1)]);
    let bounds = scene(BOTTLE).solids[0].bounds();
    assert_eq!(bounds, Some((DVec3::new(3.0, 0.0, -2.0), DVec3::new(7.0, 4.0, 2.0))));
}

#[test]
fn a_solid_may_be_used_more_than_once_and_before_its_table() {
    let text = "[[solid]]\nname = 'pair'\nunion = ['left', 'right']\nrotation = 90\n\
        [[solid]]\nname = 'left'\nunion = ['ball', 'rod']\n[[solid]]\nname = 'right'\nintersection = ['ball', 'rod']\nposition = [3, 0, 0]\n\
        [[solid]]\nname = 'ball'\nsphere = { radius = 1 }\n[[solid]]\nname = 'rod'\ncylinder = { radius = 0.5, height = 2 }\n\
        [[solid]]\nname = 'template'\nsphere = { radius = 1 }\nhidden = true\n";
    let scene = scene(text);
    assert_eq!(scene.solids.len(), 1);
    let SolidNode::Union(members) = &scene.solids[0].node else { panic!() };
    assert!(matches!(&members[0], SolidNode::Union(two) if two.len() == 2));
    let SolidNode::Intersection(two) = &members[1] else { panic!() };
    let SolidNode::Shape { world_from_solid, .. } = &two[0] else { panic!() };
    // A quarter turn about the vertical takes +x to −z.
    assert_eq!(world_from_solid.translation, DVec3::new(0.0, 0.0, -3.0));
}

#[test]
fn solids_are_framed() {
    let scene = scene("[[solid]]\nbox = { size = [2, 2, 2] }\n[[model]]\nplane = { size = [100, 100] }\n");
    let camera = &scene.cameras[0];
    let Projection::Perspective { tan_half_height } = camera.projection else { panic!() };
    let mut fullest = 0.0f64;
    for i in 0..8 {
        let side = |bit: i32| f64::from(i >> bit & 1);
        let corner = DVec3::new(2.0 * side(0) - 1.0, 2.0 * side(1), 2.0 * side(2) - 1.0);
        let seen = camera.world_from_camera.transpose() * (corner - camera.position);
        fullest = fullest.max(seen.y.abs() / -seen.z / tan_half_height);
    }
    // The box, not the plane, fills the frame but for its margin of 8 %.
    assert!((0.5..=0.92 + 1e-12).contains(&fullest), "{fullest}");
}

#[test]
fn models_may_be_prisms() {
    let scene = scene("[[model]]\nprism = { sides = 4, radius = 2, height = 3 }\nposition = [0, 1, 0]\n");
    assert_eq!(scene.geometry.bounds(), Some((DVec3::new(-2.0, 1.0, -2.0), DVec3::new(2.0, 4.0, 2.0))));
    assert_eq!(scene.geometry.triangle_count(), 12);
}

/// Wrong tables, and what must be in the message.
const WRONG: &[(&str, &str)] = &[
    (
        "[[solid]]",
        "[[solid]] 1: needs one of sphere, cylinder, cone, frustum, prism, box, polyhedron, union, intersection, difference",
    ),
    ("[[solid]]\nsphere = { radius = 1 }\ncone = { radius = 1, height = 1 }", "has sphere and cone at once"),
    (
        "[[solid]]\nsphere = { radius = 0 }",
        "line 2, column 21, [[solid]] 1, key \"sphere.radius\": 0 is not within [",
    ),
    ("[[solid]]\nsphere = { radius = nan }", "key \"sphere.radius\": NaN is not within"),
    ("[[solid]]\nsphere = { radius = -1 }", "-1 is not within ["),
    ("[[solid]]\nsphere = { diameter = 1 }", "unknown field `diameter`, expected `radius`"),
    (
        "[[solid]]\ncylinder = { radius = 1, height = 0 }",
        "[[solid]] 1, key \"cylinder.height\": 0 is not within [",
    ),
    ("[[solid]]\ncone = { radius = 0, height = 1 }", "[[solid]] 1, key \"cone.radius\": 0 is not within ["),
    ("[[solid]]\nbox = { size = [1, 0, 1] }", "[[solid]] 1, key \"box.size\": 0 is not within ["),
    (
        "[[solid]]\nprism = { sides = 3, radius = 1, height = 0 }",
        "[[solid]] 1, key \"prism.height\": 0 is not within [",
    ),
    ("[[solid]]\nfrustum = { bottom = 0, top = 1, height = 1 }", "key \"frustum.bottom\": 0 is not within"),
    ("[[solid]]\nfrustum = { bottom = 1, top = 0, height = 1 }", "key \"frustum.top\": 0 is not within"),
    (
        "[[solid]]\nfrustum = { bottom = 1, top = -0.5, height = 1 }",
        "key \"frustum.top\": -0.5 is not within",
    ),
    ("[[solid]]\nfrustum = { bottom = 1, top = nan, height = 1 }", "key \"frustum.top\": NaN is not within"),
    ("[[solid]]\nfrustum = { bottom = 1e7, top = 1e-3, height = 1 }", "from 1e-6 to 1e6 are possible"),
    (
        "[[solid]]\nprism = { sides = 2, radius = 1, height = 1 }",
        "key \"prism.sides\": 2 is not within [3, 64]",
    ),
    ("[[solid]]\nbox = { size = [1, inf, 1] }", "key \"box.size\": inf is not within"),
    (
        "[[solid]]\nsphere = { radius = 1 }\nscale = [1, 0, 1]",
        "key \"scale\": [1, 0, 1] is not possible: each factor must be within",
    ),
    (
        "[[solid]]\nsphere = { radius = 1 }\nscale = nan",
        "[[solid]] 1, key \"scale\": NaN is not possible: each factor must be within",
    ),
    ("[[solid]]\nsphere = { radius = 1 }\nrotation = nan", "key \"rotation\": NaN"),
    ("[[solid]]\nsphere = { radius = 1 }\nrotation = [0, inf, 0]", "key \"rotation\": inf"),
    (
        "[[solid]]\nsphere = { radius = 1 }\nposition = [0, -inf, 0]",
        "[[solid]] 1, key \"position\": [0.0, -inf, 0.0] is not a point",
    ),
    (
        "[[solid]]\nsphere = { radius = 1 }\nmaterial = 'x'",
        "[[solid]] 1, key \"material\": \"x\" is unknown; [[material]] tables define none",
    ),
    (
        "[[solid]]\nname = 'a'\nsphere = { radius = 1 }\n[[solid]]\nname = 'a'\nsphere = { radius = 1 }",
        "line 5, column 8, [[solid]] 2, key \"name\": \"a\" is empty or taken",
    ),
    ("[[solid]]\nunion = []", "[[solid]] 1, key \"union\": has 0 names: two or more are possible"),
    (
        "[[solid]]\nintersection = []",
        "[[solid]] 1, key \"intersection\": has 0 names: two or more are possible",
    ),
    ("[[solid]]\ndifference = []", "[[solid]] 1, key \"difference\": has 0 names: two or more are possible"),
    (
        "[[solid]]\nname = 'a'\nsphere = { radius = 1 }\n[[solid]]\ndifference = ['a']",
        "key \"difference\": has 1 names",
    ),
    (
        "[[solid]]\nname = 'a'\nsphere = { radius = 1 }\n[[solid]]\nunion = ['a', 'b']",
        "line 5, column 15, [[solid]] 2, key \"union.2\": \"b\" is unknown; named [[solid]] tables are \"a\"",
    ),
    (
        "[[solid]]\nname = 'a'\nunion = ['a', 'a']",
        "line 3, column 10, [[solid]] 1, key \"union.1\": \"a\" refers to itself",
    ),
    (
        "[[solid]]\nname = 'a'\nunion = ['b', 's']\n[[solid]]\nname = 'b'\nintersection = ['s', 'c']\n\
         [[solid]]\nname = 'c'\ndifference = ['s', 'a']\n[[solid]]\nname = 's'\nsphere = { radius = 1 }",
        "[[solid]] 3, key \"difference.2\": \"a\" refers to itself",
    ),
    (
        "[[solid]]\npolyhedron = { points = [[0,0,0], [1,0,0], [0,1,0]] }",
        "key \"polyhedron.points\": 3 points: from 4 to 128 are possible",
    ),
    (
        "[[solid]]\npolyhedron = { points = [[0,0,0], [1,0,0], [0,1,0], [1,1,0]] }",
        "key \"polyhedron.points\": all points lie in one plane",
    ),
    (
        "[[solid]]\npolyhedron = { points = [[0,0,0], [1,0,0], [0,1,0], [0,0,nan]] }",
        "key \"polyhedron.points.4\": ",
    ),
    (
        "[[solid]]\npolyhedron = { points = [[0,0,0], [4,0,0], [0,4,0], [0,0,4], [1,1,1]] }",
        "key \"polyhedron.points.5\": this point lies inside",
    ),
    (
        "[[material]]\nname = 'a'\nattenuation_colour = [1, 1.1, 1]\nattenuation_distance = 1",
        "[[material]] 1, key \"attenuation_colour\": 1.1 is not within [0, 1]",
    ),
    (
        "[[material]]\nname = 'a'\nattenuation_colour = 0\nattenuation_distance = 1",
        "[[material]] 1, key \"attenuation_colour\": each channel must be above 0",
    ),
    (
        "[[material]]\nname = 'a'\nattenuation_colour = 0.5\nattenuation_distance = -1",
        "key \"attenuation_distance\": -1 is not within (0, ",
    ),
    (
        "[[material]]\nname = 'a'\nattenuation_colour = 0.5\nattenuation_distance = nan",
        "key \"attenuation_distance\": NaN is not within (0, ",
    ),
    ("[[material]]\nname = 'a'\nior = 0.99", "[[material]] 1, key \"ior\": 0.99 is not within [1, 10]"),
    ("[[material]]\nname = 'a'\nior = nan", "[[material]] 1, key \"ior\": NaN is not within [1, 10]"),
    (
        "[[material]]\nname = 'a'\ntransmission = inf",
        "[[material]] 1, key \"transmission\": inf is not within [0, 1]",
    ),
    (
        "[[model]]\nprism = { sides = 65, radius = 1, height = 1 }",
        "[[model]] 1, key \"prism.sides\": 65 is not within [3, 64]",
    ),
];

#[test]
fn errors_name_place_and_choices() {
    for (text, expected) in WRONG {
        let message = match read(text) {
            Ok(_) => panic!("accepted:\n{text}"),
            Err(error) => error.to_string(),
        };
        assert!(message.contains(expected), "{text}\n  gave     {message}\n  expected {expected}");
    }
}

/// A ball and a rod of the materials `a` and `b`, and `last`.
fn pair(a: &str, b: &str, last: &str) -> String {
    let table = |name, shape, material: &str| {
        let material = if material.is_empty() { String::new() } else { format!("material = '{material}'\n") };
        format!("[[solid]]\nname = '{name}'\n{shape}\n{material}")
    };
    let clear = |name, more| format!("[[material]]\nname = '{name}'\ntransmission = 1\n{more}\n");
    format!(
        "{}{}{}{}[[material]]\nname = 'paint'\n{}{}[[solid]]\nname = 'both'\n{last}",
        clear("crown", "ior = 1.52\ncolour = 1\nroughness = 0"),
        clear("frosted", "ior = 1.52\ncolour = 1\nroughness = 0.5"),
        clear("flint", "ior = 1.62\ncolour = 1"),
        clear(
            "green",
            "ior = 1.52\ncolour = 1\nattenuation_colour = [0.5, 1, 0.5]\nattenuation_distance = 1"
        ),
        table("ball", "sphere = { radius = 1 }", a),
        table("rod", "cylinder = { radius = 0.5, height = 2 }", b)
    )
}

#[test]
fn one_body_has_one_medium() {
    let refused = |text: &str| read(text).err().map(|error| error.to_string()).unwrap_or_default();
    for operation in ["union", "intersection"] {
        let set = format!("{operation} = ['ball', 'rod']");
        for (a, b, what) in [
            (
                "crown",
                "flint",
                "is of \"flint\" (clear, ior 1.62), but the first is of \"crown\" (clear, ior 1.52)",
            ),
            ("crown", "green", "is of \"green\" (clear, ior 1.52), but the first is of \"crown\""),
            ("paint", "crown", "is of \"crown\" (clear, ior 1.52), but the first is of \"paint\" (opaque)"),
            ("crown", "", "is of the default grey (opaque), but the first is of \"crown\""),
        ] {
            let message = refused(&pair(a, b, &set));
            let place = format!("[[solid]] 3, key \"{operation}.2\": ");
            assert!(message.contains(&place) && message.contains(what), "{message}");
            assert!(message.contains("several [[solid]] tables"), "{message}");
        }
        // Opaque is opaque; roughness is the surface's alone; what names no material has that of the whole.
        for (a, b) in [("paint", ""), ("crown", "crown"), ("crown", "frosted")] {
            assert_eq!(refused(&pair(a, b, &set)), "");
        }
        assert_eq!(refused(&pair("", "crown", &format!("{set}\nmaterial = 'crown'"))), "");
    }
}

/// What is cut out leaves no medium: its materials dress faces.
#[test]
fn cutters_may_be_of_anything() {
    assert!(read(&pair("crown", "paint", "difference = ['ball', 'rod']")).is_ok());
    assert!(read(&pair("paint", "crown", "difference = ['ball', 'rod']")).is_ok());
    let block = "[[solid]]\nname = 'block'\nbox = { size = [9, 9, 9] }\nmaterial = 'flint'\n";
    let both = "union = ['ball', 'rod']\n";
    let cut = format!("{both}{block}[[solid]]\ndifference = ['block', 'both']");
    assert!(read(&pair("crown", "paint", &cut)).is_ok());
    // But the whole is looked through.
    let whole = format!("{both}{block}[[solid]]\ndifference = ['both', 'block']");
    let message =
        read(&pair("crown", "paint", &whole)).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(message.contains("[[solid]] 3, key \"union.2\": is of \"paint\""), "{message}");
}

/// Each level uses the one below twice: 2ⁿ shapes from n tables, and n levels.
fn doubled(levels: usize) -> String {
    let mut text = "[[solid]]\nname = 's0'\nsphere = { radius = 1 }\n".to_owned();
    for level in 1..=levels {
        let below = level - 1;
        text += &format!("[[solid]]\nname = 's{level}'\nunion = ['s{below}', 's{below}']\n");
    }
    text
}

#[test]
fn a_few_lines_cannot_ask_for_everything() {
    assert_eq!(scene(&doubled(10)).solids.len(), 1);
    let refused = |text: &str| read(text).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(refused(&doubled(40)).contains("more than 1000000 shapes"));
    assert!(refused(&doubled(64)).contains("to 64 levels"));
    // In the other order, where the deepest is met first.
    let backwards: String =
        doubled(500).split_inclusive("[[solid]]\n").skip(1).fold(String::new(), |all, table| {
            format!("[[solid]]\n{}\n{all}", table.trim_end_matches("[[solid]]\n"))
        });
    assert!(refused(&backwards).contains("to 64 levels"));
    // Scales multiply through operations, and f64 ends at some point.
    let mut shrunk = "[[solid]]\nname = 's0'\nsphere = { radius = 1 }\nscale = 1e-6\n".to_owned();
    for level in 1..60 {
        let below = level - 1;
        shrunk += &format!("[[solid]]\nname = 's{level}'\nunion = ['s{below}', 't']\nscale = 1e-6\n");
    }
    shrunk += "[[solid]]\nname = 't'\nsphere = { radius = 1 }\n";
    assert!(refused(&shrunk).contains("make [[solid]] 1 flat"), "{}", refused(&shrunk));
}

const WHOLE: &str = "[[material]]\nname = 'glass'\ntransmission = 1\nior = 1.5\nattenuation_colour = [0.5, 0.9, 0.5]\nattenuation_distance = 0.1\n\
    [[solid]]\nname = 'a'\nsphere = { radius = 2 }\nscale = [1, 2, 1]\n[[solid]]\nname = 'b'\nfrustum = { bottom = 1, top = 2, height = 3 }\nrotation = [1, 2, 3]\n\
    [[solid]]\nname = 'c'\ndifference = ['a', 'b']\nmaterial = 'glass'\nposition = [1, 2, 3]\n[[solid]]\nname = 'd'\nunion = ['c', 'e']\n\
    [[solid]]\nname = 'e'\nprism = { sides = 5, radius = 1, height = 1 }\n\
    [[solid]]\npolyhedron = { points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]] }\nhidden = false\n";

/// Whether all numbers of a solid are finite and its lists are as promised.
fn sound(node: &SolidNode) -> bool {
    match node {
        SolidNode::Shape { shape, world_from_solid, .. } => {
            let placed = world_from_solid.is_finite() && world_from_solid.inverse().is_finite();
            placed
                && match shape {
                    SolidShape::Frustum { top } => *top > 0.0 && top.is_finite(),
                    SolidShape::Polyhedron { planes, corners } => {
                        let inside = |c: &DVec3| planes.iter().all(|(n, offset)| n.dot(*c) <= *offset);
                        planes.len() >= 4
                            && corners.len() >= 4
                            && corners.iter().all(|c| c.is_finite() && inside(c))
                    }
                    _ => true,
                }
        }
        SolidNode::Union(members) | SolidNode::Intersection(members) => {
            members.len() >= 2 && members.iter().all(sound)
        }
        SolidNode::Difference(whole, others) => {
            sound(whole) && !others.is_empty() && others.iter().all(sound)
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// Mutated files are read or refused, never a panic; what is read is sound.
    #[test]
    fn mutations_never_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0usize..6, "[-0-9a-e\\[\\]{}=.,'#\n ]{0,6}"), 1..5)
    ) {
        let mut text: Vec<char> = WHOLE.chars().collect();
        for (at, cut, insert) in edits {
            let at = at.index(text.len());
            let end = (at + cut).min(text.len());
            text.splice(at..end, insert.chars());
        }
        if let Ok(scene) = read(&text.into_iter().collect::<String>()) {
            prop_assert!(scene.solids.iter().all(|solid| sound(&solid.node)));
            prop_assert!(scene.cameras.iter().all(|camera| camera.position.is_finite()));
        }
    }

    /// A number or name anywhere may be anything that TOML can write.
    #[test]
    fn absurd_values_never_panic(
        which in any::<prop::sample::Index>(),
        value in prop::sample::select(vec!["nan", "-inf", "1e308", "-1e308", "1e-308", "0", "-1", "9223372036854775807", "true", "'a'", "['a', 'd']", "[]", "{}"])
    ) {
        let spots: Vec<usize> = WHOLE.match_indices("= ").map(|m| m.0 + 2).collect();
        let at = spots[which.index(spots.len())];
        let end = WHOLE[at..].find([',', '}', '\n']).map_or(WHOLE.len(), |n| at + n);
        if let Ok(scene) = read(&format!("{}{value}{}", &WHOLE[..at], &WHOLE[end..])) {
            prop_assert!(scene.solids.iter().all(|solid| sound(&solid.node)));
        }
    }
}
