//! `[[tree]]`: where trees stand, what species they are, and what errors say.

use std::path::{Path, PathBuf};

use glam::DVec3;
use keikan_scene::{Error, PicturedTree, PlacedTree, Scene, TreePicture, TreeSpecies, parse, species_folder};

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
        envelope: vec![[2.0, 1.0], [8.0, 0.5]],
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
