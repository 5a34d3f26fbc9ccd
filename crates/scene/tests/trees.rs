//! `[[tree]]`: where trees stand, what species they are, and what errors say.

use std::path::{Path, PathBuf};

use glam::DVec3;
use keikan_scene::{
    CrownShape, Error, PicturedTree, PlacedTree, Scene, ShapedEnvelope, TreeEnvelope, TreePicture,
    TreeSpecies, parse, species_folder,
};

/// One table, read in a folder of the test's own.
fn read_in(folder: &Path, table: &str) -> Result<Scene, Error> {
    parse(&format!("[[tree]]\n{table}\n"), folder, Path::new("a.toml"))
}

fn read(table: &str) -> Result<Scene, Error> {
    read_in(Path::new(""), table)
}

/// Its trees, in the file's coordinates.
fn placed(table: &str) -> Vec<PlacedTree> {
    let scene = read(&format!("species = 'spruce'\n{table}")).unwrap_or_else(|error| panic!("{error}"));
    let trees = &scene.trees[0];
    let moved = |tree: &PlacedTree| PlacedTree { position: tree.position + scene.origin, ..*tree };
    trees.placed.iter().map(moved).collect()
}

fn message(result: Result<Scene, Error>) -> String {
    result.err().map(|error| error.to_string()).unwrap_or_default()
}

/// An empty folder of this test's own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("trees").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn a_tree_stands_where_it_is_put() {
    let one = placed("position = [3, 1, -2]\nrotation = 90");
    assert_eq!((one.len(), one[0].position, one[0].scale), (1, DVec3::new(3.0, 1.0, -2.0), 1.0));
    // π/2 as the nearest f32.
    assert_eq!(one[0].rotation, std::f32::consts::FRAC_PI_2);
    let many = placed("positions = [[0, 0, 0], [5, 0.5, 1]]");
    assert_eq!(
        many.iter().map(|tree| tree.position).collect::<Vec<_>>(),
        [DVec3::ZERO, DVec3::new(5.0, 0.5, 1.0)]
    );
    // Each is turned by its own.
    assert!(many[0].rotation != many[1].rotation);
}

#[test]
fn a_tree_is_as_high_as_stated() {
    let scene = read("species = 'poplar'\nposition = [0, 0, 0]\nheight = 20").unwrap();
    assert!(matches!(&scene.trees[0].species, TreeSpecies::Named(name) if name == "poplar"));
    assert_eq!((scene.trees[0].height, scene.trees[0].on_ground), (Some(20.0), false));
    assert_eq!(scene.warnings, []);
    let scales = placed("positions = [[0, 0, 0], [5, 0, 0], [9, 0, 0]]\nvariation = 0.5");
    assert!(scales.iter().all(|tree| (0.5..=1.5).contains(&tree.scale)));
    assert!(scales[0].scale != scales[1].scale && scales[1].scale != scales[2].scale);
}

#[test]
fn positions_come_from_a_file() {
    let folder = folder("points");
    std::fs::write(folder.join("trees.csv"), "10,20,1.5\n12,24,1.75\n").unwrap();
    let scene = read_in(&folder, "species = 'spruce'\nfile = 'trees.csv'").unwrap();
    let at: Vec<DVec3> = scene.trees[0].placed.iter().map(|tree| tree.position + scene.origin).collect();
    // East is +X, north −Z.
    assert_eq!(at, [DVec3::new(10.0, 1.5, -20.0), DVec3::new(12.0, 1.75, -24.0)]);
    let missing = message(read_in(&folder, "species = 'spruce'\nfile = 'none.csv'"));
    assert!(missing.contains("none.csv"), "{missing}");
}

/// A list of trees beside a scene, read with `more` in its table.
fn list(name: &str, json: &str, (before, more): (&str, &str)) -> Result<Scene, Error> {
    let folder = folder(name);
    std::fs::write(folder.join("trees.geojson"), json).unwrap();
    let text = format!("{before}\n[[tree]]\npoints = 'trees.geojson'\n{more}\n");
    parse(&text, &folder, Path::new("a.toml"))
}

/// A collection of features.
fn collection(features: &str) -> String {
    format!("{{\"type\": \"FeatureCollection\", \"features\": [{features}]}}")
}

fn feature(geometry: &str, properties: &str) -> String {
    format!("{{\"type\": \"Feature\", \"geometry\": {geometry}, \"properties\": {properties}}}")
}

fn point(coordinates: &str, properties: &str) -> String {
    feature(&format!("{{\"type\": \"Point\", \"coordinates\": {coordinates}}}"), properties)
}

const SITE: &str = "[site]\nlatitude = 35\nlongitude = 139\nelevation = 40\n";

#[test]
fn a_list_of_trees_has_heights_species_and_rotations() {
    let features = [
        point("[10, 20, 1.5]", "{\"height\": 6, \"species\": \"poplar\", \"rotation\": 90, \"age\": [7]}"),
        point("[12, 24]", "null"),
        feature(
            "{\"type\": \"MultiPoint\", \"coordinates\": [[1, 2], [3, 4, 5]]}",
            "{\"species\": \"poplar\"}",
        ),
        feature("null", "{}"),
    ];
    let json = collection(&features.join(","));
    let scene = list("list", &json, ("", "species = 'spruce'\nheight = 8\nground = true\nseed = 3")).unwrap();
    assert_eq!(scene.trees.len(), 2);
    let [poplars, spruces] = [&scene.trees[0], &scene.trees[1]];
    assert!(matches!(&poplars.species, TreeSpecies::Named(name) if name == "poplar"));
    assert!(matches!(&spruces.species, TreeSpecies::Named(name) if name == "spruce"));
    assert!(poplars.on_ground && poplars.height == Some(8.0) && spruces.height == Some(8.0));
    let at = |trees: &keikan_scene::Trees| trees.placed.iter().map(|tree| tree.position).collect::<Vec<_>>();
    assert_eq!(
        at(poplars),
        [DVec3::new(10.0, 1.5, -20.0), DVec3::new(1.0, 0.0, -2.0), DVec3::new(3.0, 5.0, -4.0)]
    );
    assert_eq!(at(spruces), [DVec3::new(12.0, 0.0, -24.0)]);
    assert_eq!((poplars.placed[0].scale, poplars.placed[1].scale), (0.75, 1.0));
    assert_eq!(poplars.placed[0].rotation, std::f32::consts::FRAC_PI_2);
    // Each of the others by its own.
    assert!(poplars.placed[1].rotation != poplars.placed[2].rotation);
    assert_eq!(scene.warnings.len(), 1);
    assert!(scene.warnings[0].to_string().contains("1 features have no geometry"), "{}", scene.warnings[0]);
    // A stated height is what it says, whatever is usual.
    let scene = list("usual", &json, ("", "species = 'spruce'")).unwrap();
    let first = &scene.trees[0];
    assert_eq!(first.height.unwrap() * f64::from(first.placed[0].scale), 6.0);
}

#[test]
fn coordinates_are_degrees_about_the_site_or_metres() {
    let json = collection(&point("[139.001, 35.002, 52]", "{}"));
    let at = |name: &str, json: &str, before: &str, more: &str| {
        let scene = list(name, json, (before, &format!("species = 'spruce'\n{more}"))).unwrap();
        scene.trees[0].placed[0].position + scene.origin
    };
    // 91.28 m and 110.94 m a thousandth of a degree at 35°; 40 m of elevation make 6 · 10⁻⁶ of it.
    let found = at("degrees", &json, SITE, "");
    assert!((found - DVec3::new(91.29, 12.0, -221.88)).length() < 0.02, "{found}");
    assert_eq!(at("said", &json, SITE, "coordinates = 'degrees'"), found);
    let metres = DVec3::new(139.001, 52.0, -35.002);
    assert_eq!(at("no-site", &json, "", ""), metres);
    assert_eq!(at("metres", &json, SITE, "coordinates = 'metres'"), metres);
    let named = |name: &str| {
        let crs = format!(
            "\"crs\": {{\"type\": \"name\", \"properties\": {{\"name\": \"{name}\"}}}}, \"features\""
        );
        json.replace("\"features\"", &crs)
    };
    assert_eq!(at("projected", &named("urn:ogc:def:crs:EPSG::6677"), SITE, ""), metres);
    assert_eq!(at("crs84", &named("urn:ogc:def:crs:OGC:1.3:CRS84"), SITE, ""), found);
}

#[test]
fn a_list_that_cannot_be_meant_is_named_with_file_and_place() {
    for (json, before, more, expected) in [
        ("[1, 2", "", "", "trees.geojson: "),
        ("{\"type\": \"Feature\"}", "", "", "trees.geojson: /type: \"Feature\" is no list"),
        ("{\"features\": [7], \"type\": \"FeatureCollection\"}", "", "", "line 1 column"),
        (&collection(&point("[1]", "{}")), "", "", "/features/0/geometry/coordinates: [1] is no point"),
        (&collection(&point("[1, \"2\"]", "{}")), "", "", "coordinates: [1,\"2\"] is no point: two or three"),
        (&collection(&point("[1, 1e99]", "{}")), "", "", "must be within"),
        (
            &collection(&feature("{\"type\": \"LineString\", \"coordinates\": [[1, 2], [3, 4]]}", "{}")),
            "",
            "",
            "/features/0/geometry/type: \"LineString\" is not possible: a tree is a \"Point\"",
        ),
        (
            &collection(&feature("{\"type\": \"MultiPoint\", \"coordinates\": [[1, 2], 3]}", "{}")),
            "",
            "",
            "/features/0/geometry/coordinates/1: 3 is no point",
        ),
        (
            &collection(&format!("{},{}", point("[1, 2]", "{}"), point("[1, 2]", "{\"height\": -3}"))),
            "",
            "",
            "/features/1/properties/height: -3 is not possible: a number of metres within (0, 300]",
        ),
        (&collection(&point("[1, 2]", "{\"height\": \"tall\"}")), "", "", "height: \"tall\" is not possible"),
        (&collection(&point("[1, 2]", "{\"rotation\": 1e9}")), "", "", "properties/rotation"),
        (&collection(&point("[1, 2]", "{\"species\": 7}")), "", "", "species: 7 is not possible"),
        (&collection(&point("[500, 2]", "{}")), SITE, "", "metres are possible with coordinates"),
        (&collection(&point("[13, 52]", "{}")), SITE, "", "km from the [site]"),
        (&collection(&point("[1, 2]", "{}")), "", "coordinates = 'degrees'", "need a [site]"),
        (&collection(&point("[1, 2]", "{}")), "", "coordinates = 'feet'", "coordinates"),
        (&collection(&point("[1, 2]", "{}")), "", "positions = [[1, 2, 3]]", "points"),
    ] {
        let said = message(list("bad", json, (before, &format!("species = 'spruce'\n{more}"))));
        assert!(said.contains(expected), "{json} {more}: {said}");
    }
    let said = message(list("bad", &collection(&point("[1, 2]", "{}")), ("", "")));
    assert!(said.contains("species"), "{said}");
    let said = message(read("species = 'spruce'\nposition = [0, 0, 0]\ncoordinates = 'metres'"));
    assert!(said.contains("GeoJSON"), "{said}");
}

const FIELD: &str = "polygon = { points = [[0, 2, 0], [40, 2, 0], [40, 2, 30], [0, 2, 30]], \
                     holes = [[[10, 2, 10], [20, 2, 10], [20, 2, 20], [10, 2, 20]]] }";

#[test]
fn trees_are_scattered_over_a_polygon() {
    let trees = placed(&format!("{FIELD}\nspacing = 2"));
    // 15 × 20 squares less those of the hole, 25; jitter decides about none, for squares lie on its edges.
    assert_eq!(trees.len(), 275);
    for tree in &trees {
        let [x, y, z] = tree.position.to_array();
        assert!((0.0..=40.0).contains(&x) && y == 2.0 && (0.0..=30.0).contains(&z), "{x} {y} {z}");
        assert!(!((10.0..20.0).contains(&x) && (10.0..20.0).contains(&z)), "{x} {z} is in the hole");
        assert!((0.8..=1.2).contains(&tree.scale));
    }
    // Within 0.7 of a square each: 0.3 of the spacing is left between neighbours, but for a rounding.
    let apart = |a: &PlacedTree, b: &PlacedTree| a.position.distance(b.position);
    let least = trees.iter().enumerate().flat_map(|(i, a)| trees[..i].iter().map(move |b| apart(a, b)));
    assert!(least.fold(f64::INFINITY, f64::min) >= 0.6 - 1e-9);
}

#[test]
fn the_same_seed_scatters_the_same_trees() {
    let of = |seed: u32| placed(&format!("{FIELD}\nspacing = 3\nseed = {seed}"));
    assert_eq!(of(1), of(1));
    assert_eq!(of(1), placed(&format!("{FIELD}\nspacing = 3")));
    assert_ne!(of(1), of(2));
    // The default: two thirds of the height.
    assert_eq!(
        placed(&format!("{FIELD}\nheight = 6")).len(),
        placed(&format!("{FIELD}\nheight = 6\nspacing = 4")).len()
    );
}

#[test]
fn what_cannot_be_meant_is_named() {
    for (table, expected) in [
        ("position = [0, 0, 0]", "species"),
        ("species = 'spruce'", "position"),
        ("species = 'spruce'\nposition = [0, 0, 0]\npositions = [[1, 0, 0]]", "position"),
        ("species = 'spruce'\nposition = [0, 0, 0]\nheight = 0", "height"),
        ("species = 'spruce'\nposition = [0, 0, 0]\nheight = nan", "height"),
        ("species = 'spruce'\nposition = [0, 0, 0]\nvariation = 1", "variation"),
        ("species = 'spruce'\nposition = [0, 0, 0]\nspacing = 3", "scattered"),
        ("species = 'spruce'\nposition = [0, 0, 0]\ncolour = 1", "colour"),
        ("species = 'spruce'\npolygon = { points = [[0, 0, 0], [1, 0, 0]] }", "three corners"),
        (
            "species = 'spruce'\npolygon = { points = [[0, 0, 0], [1, 0, 0], [0, 0, 1]] }\nspacing = 0",
            "spacing",
        ),
        (
            "species = 'spruce'\npolygon = { points = [[0, 0, 0], [9999, 0, 0], [9999, 0, 9999]] }\nspacing = 0.1",
            "more trees than are possible",
        ),
    ] {
        let said = message(read(table));
        assert!(said.starts_with("a.toml: line ") && said.contains(expected), "{table}: {said}");
    }
}

/// A green square on nothing, 4 by 8 texels.
fn species() -> PicturedTree {
    let texel = |i: usize| if (1..3).contains(&(i % 4)) { [60, 90, 40, 255] } else { [0; 4] };
    let picture = |rows: usize, leaves: Vec<u8>| TreePicture {
        size: [4, rows as u32],
        texels: (0..4 * rows).map(texel).collect(),
        leaves,
    };
    PicturedTree {
        name: String::new(),
        height: 8.0,
        half_width: 2.0,
        pictures: vec![(None, picture(8, vec![255; 32])), (Some(5.25), picture(4, Vec::new()))],
        envelope: TreeEnvelope::Knots(vec![[2.0, 1.0], [8.0, 0.5]]),
        leaf: 0.1,
        reflectance: Some([0.05; 8]),
        transmittance: [0.04; 8],
        scatter: 1.0,
        lean: 0.5,
        extinction: None,
        shelter: 1.25,
        seed: 7,
    }
}

fn write(folder: &Path, tree: &PicturedTree) {
    for (name, bytes) in species_folder::files(tree).unwrap() {
        std::fs::write(folder.join(name), bytes).unwrap();
    }
}

#[test]
fn a_folder_holds_a_species() {
    let folder = folder("species");
    std::fs::create_dir(folder.join("oak")).unwrap();
    write(&folder.join("oak"), &species());
    for name in ["oak", "./oak"] {
        let scene = read_in(&folder, &format!("species = '{name}'\nposition = [0, 0, 0]")).unwrap();
        let TreeSpecies::Pictured(found) = &scene.trees[0].species else { panic!("{name} is no folder") };
        assert!(found.name.ends_with("oak"));
        assert_eq!(PicturedTree { name: String::new(), ..(**found).clone() }, species());
    }
}

#[test]
fn a_crown_has_knots_or_the_name_of_a_shape() {
    let folder = folder("shapes");
    std::fs::create_dir(folder.join("oak")).unwrap();
    let table = folder.join("oak").join("tree.toml");
    let read = || read_in(&folder, "species = 'oak'\nposition = [0, 0, 0]");
    for (text, shape) in [
        ("{ shape = 'ellipsoid', base = 2, top = 7.5, radius = 1.5 }", CrownShape::Ellipsoid),
        ("{ shape = 'pencil', base = 2, top = 7.5, radius = 1.5 }", CrownShape::Pencil),
        ("{ shape = 'inverted-cone', base = 2, top = 7.5, radius = 1.5 }", CrownShape::InvertedCone),
    ] {
        let shaped = ShapedEnvelope { shape, base: 2.0, top: Some(7.5), radius: 1.5 };
        write(&folder.join("oak"), &species());
        let written = std::fs::read_to_string(&table).unwrap();
        let line = written.lines().find(|line| line.starts_with("envelope")).unwrap();
        std::fs::write(&table, written.replace(line, &format!("envelope = {text}"))).unwrap();
        let scene = read().unwrap();
        let TreeSpecies::Pictured(found) = &scene.trees[0].species else { panic!("no folder") };
        assert_eq!(found.envelope, TreeEnvelope::Shape(shaped));
        // And back.
        write(&folder.join("oak"), found);
        let scene = read().unwrap();
        let TreeSpecies::Pictured(again) = &scene.trees[0].species else { panic!("no folder") };
        assert_eq!(again.envelope, found.envelope);
    }
    let written = std::fs::read_to_string(&table).unwrap();
    for (from, to) in [("inverted-cone", "cube"), ("radius = 1.5", "radius = 1.5\ncolour = 7")] {
        std::fs::write(&table, written.replace(from, to)).unwrap();
        let said = message(read());
        assert!(said.contains("tree.toml") && said.contains("\"ellipsoid\", \"pencil\""), "{to}: {said}");
    }
}

#[test]
fn a_folder_that_is_no_species_is_named_by_its_path() {
    let folder = folder("broken");
    std::fs::create_dir(folder.join("oak")).unwrap();
    let said = || message(read_in(&folder, "species = 'oak'\nposition = [0, 0, 0]"));
    let table = folder.join("oak").join("tree.toml");
    assert!(said().contains("tree.toml") && said().contains("oak"), "{}", said());
    let path = table.display().to_string();
    std::fs::write(&table, "height = 3\nage = 100\n").unwrap();
    assert!(said().contains(&path) && said().contains("age"), "{}", said());
    write(&folder.join("oak"), &PicturedTree { height: 0.0, ..species() });
    assert!(said().contains(&path) && said().contains("above 0"), "{}", said());
    // A mask of another size.
    let mut tree = species();
    write(&folder.join("oak"), &tree);
    let mask = std::fs::read(folder.join("oak/side-leaves.png")).unwrap();
    tree.pictures[0].1 = TreePicture { size: [4, 6], texels: vec![[9; 4]; 24], leaves: vec![255; 24] };
    write(&folder.join("oak"), &tree);
    std::fs::write(folder.join("oak/side-leaves.png"), mask).unwrap();
    assert!(said().contains("side-leaves.png") && said().contains("4 × 8"), "{}", said());
    std::fs::write(folder.join("oak/side.png"), "no picture").unwrap();
    assert!(said().contains("side.png"), "{}", said());
    std::fs::remove_file(folder.join("oak/side.png")).unwrap();
    assert!(said().contains("side.png"), "{}", said());
}
