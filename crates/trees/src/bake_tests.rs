//! Baked pictures against what is known of simple meshes, and against rays through a grown one.

use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3};
use light::{Mesh, Occlude, Opacity, Ray, Texture, Wrap};

use crate::reference::Reference;
use crate::{
    Bake, BakeError, Description, Form, Growth, Part, Placed, Sheet, Species, Stand, TreeMesh, bake, grow,
};

/// A rectangle about `centre` with half sides `x` and `y`.
fn card(centre: Vec3, x: Vec3, y: Vec3, colour: Vec3, leaf: bool) -> Part {
    let positions = vec![centre - x - y, centre + x - y, centre + x + y, centre - x + y];
    let uvs = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    let triangles = vec![[0, 1, 2], [0, 2, 3]];
    Part { mesh: Mesh { positions, uvs, triangles, ..Mesh::default() }, colour, texture: None, leaf }
}

/// Two level leaves, 2 m and 2.1 m in half width, one over the other, on a thin upright stem.
fn two_leaves() -> TreeMesh {
    let green = Vec3::new(0.0, 0.5, 0.0);
    // The stem is wood: leaves alone decide where planes are, each half of their area.
    let low = card(Vec3::Y * 2.0, Vec3::X * 2.0, Vec3::Z * 2.0, green, true);
    let high = card(Vec3::Y * 6.0, Vec3::X * 2.1, Vec3::Z * 2.1, Vec3::new(0.5, 0.0, 0.0), true);
    let stem = card(Vec3::Y * 4.0, Vec3::X * 0.25, Vec3::Y * 4.0, Vec3::splat(0.2), false);
    TreeMesh { parts: vec![low, high, stem] }
}

fn small() -> TreeMesh {
    grow(&Growth { leaves: 1500, leaf: 0.3, ..Growth::usual(Form::Spreading, 8.0, 9) }).unwrap()
}

fn area(sheet: &Sheet, d: &Description, height: f32) -> f32 {
    let [columns, rows] = sheet.size();
    let texel = 2.0 * d.half_width / columns as f32 * height / rows as f32;
    sheet.texels().iter().map(|t| f32::from(t[3]) / 255.0).sum::<f32>() * texel
}

#[test]
fn each_plane_shows_what_is_nearest_to_it() {
    let species = bake(&two_leaves(), &Bake { planes: 2, rows: 160, ..Bake::default() }).unwrap();
    let d = species.description();
    assert_eq!(d.height, 8.0);
    assert_eq!([d.slices[0].height, d.slices[1].height], [2.0, 6.0]);
    for (slice, side, channel) in [(&d.slices[0], 4.0f32, 1), (&d.slices[1], 4.2, 0)] {
        // Sample points within a border are counted or not: at most one of them along each edge, of 1/4 of a texel's width.
        let slack = 4.0 * side * 2.0 * d.half_width / slice.sheet.size()[0] as f32 / 4.0 + 0.01;
        let found = area(&slice.sheet, d, 2.0 * d.half_width);
        assert!((found - side * side).abs() < slack, "{found}");
        let texels = slice.sheet.texels();
        // Off the middle, where the stem is seen from above as a line.
        let [columns, rows] = slice.sheet.size();
        let near = texels[((rows / 2 + 8) * columns + columns / 2 + 8) as usize];
        assert!(near[channel] > 180 && near[1 - channel] == 0 && near[3] == 255);
    }
    // From the side leaves are lines; the stem is 0.5 × 8 m of wood.
    assert!((area(&d.side, d, 8.0) - 4.0).abs() < 0.6);
    assert!(d.side.leaves().contains(&0));
    // Level leaves face up whatever the outline.
    assert!(d.leaf.lean >= 5.0 && d.leaf.scatter < 0.2);
}

#[test]
fn half_a_leaf_is_half_of_its_samples() {
    let mut tree = two_leaves();
    tree.parts.truncate(1);
    tree.parts[0].mesh.opacity = Some(Arc::new(Opacity { texture: None, factor: 0.25, cutoff: None }));
    let [x, y] = [Wrap::Clamp; 2];
    let texture = Texture::new(2, 1, &[[1.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0]], [x, y]).unwrap();
    tree.parts[0].texture = Some(Arc::new(texture));
    // From the side a level card would be nothing at all: stand it up.
    let stand = card(Vec3::Y * 2.0, Vec3::X * 2.0, Vec3::Y * 2.0, Vec3::Y * 0.5, true);
    tree.parts[0].mesh.positions = stand.mesh.positions;
    let species = bake(&tree, &Bake { planes: 1, rows: 64, ..Bake::default() }).unwrap();
    let d = species.description();
    // 64 × 64 texels of 16 samples: the mean of 65536 of them spreads by √(1/4 · 3/4/65536) = 0.0017; four times that.
    assert!((area(&d.side, d, 4.0) / 16.0 - 0.25).abs() < 0.007);
    let [columns, rows] = d.side.size();
    let texel = |x: f32| d.side.texels()[((rows / 2) * columns + (x * columns as f32) as u32) as usize];
    assert!(texel(0.2)[1] > 150 && texel(0.75)[1] < 10);
}

#[test]
fn meshes_that_are_no_trees_are_refused() {
    let refused = |tree: &TreeMesh, settings: Bake| bake(tree, &settings).err();
    let rows = |rows| Bake { rows, ..Bake::default() };
    assert_eq!(refused(&TreeMesh::default(), rows(64)), Some(BakeError::Empty));
    assert_eq!(refused(&two_leaves(), rows(1)), Some(BakeError::Size));
    assert_eq!(refused(&two_leaves(), rows(1 << 20)), Some(BakeError::Size));
    let mut below = two_leaves();
    below.parts.iter_mut().flat_map(|part| &mut part.mesh.positions).for_each(|p| p.y -= 20.0);
    assert_eq!(refused(&below, rows(64)), Some(BakeError::Empty));
    let mut nowhere = two_leaves();
    nowhere.parts[0].mesh.positions[0].x = f32::NAN;
    assert_eq!(refused(&nowhere, rows(64)), Some(BakeError::NotFinite));
    // 4096 rows of two square metres and 64 planes of them: 18 GB.
    let large = refused(&small(), Bake { rows: 4096, planes: 64, ..Bake::default() });
    let Some(BakeError::Memory(bytes)) = large else { panic!("{large:?}") };
    assert!(bytes > crate::MOST_BYTES && BakeError::Memory(bytes).to_string().contains("at most 2.1 GB"));
    // A tree in winter is a tree.
    let mut bare = small();
    bare.parts.retain(|part| !part.leaf);
    assert!(bake(&bare, &rows(64)).is_ok());
}

/// Every sample of the side view is what a ray through its centre meets.
#[test]
fn side_views_are_what_parallel_rays_meet() {
    let tree = small();
    let settings = Bake { rows: 48, samples: 2, planes: 0, ..Bake::default() };
    let species = bake(&tree, &settings).unwrap();
    let (d, mesh) = (species.description(), Reference::new(&tree));
    let [columns, rows] = d.side.size();
    let mut wrong = 0;
    for (i, texel) in d.side.texels().iter().enumerate() {
        let (column, row) = (i as u32 % columns, i as u32 / columns);
        let hidden = (0..4)
            .filter(|k| {
                let x = (column * 2 + k % 2) as f32 + 0.5;
                let y = (row * 2 + k / 2) as f32 + 0.5;
                let at = DVec3::new(
                    f64::from(x / (2 * columns) as f32 * 2.0 * d.half_width - d.half_width),
                    f64::from(d.height - y / (2 * rows) as f32 * d.height),
                    50.0,
                );
                mesh.first(at, DVec3::NEG_Z, 0.0).is_some()
            })
            .count();
        wrong += (f32::from(texel[3]) / 255.0 * 4.0 - hidden as f32).abs().round() as u32;
    }
    // Where an edge passes within a rounding (1e-6 m of 17 cm) of a sample, either answer is right.
    assert!(wrong <= 4, "{wrong}");
}

#[test]
fn rays_forget_no_triangle() {
    let tree = small();
    let mesh = Reference::new(&tree);
    for i in 0..200u32 {
        let share = |k| f64::from(crate::region::random(i, k));
        let origin = DVec3::new(share(1) * 16.0 - 8.0, share(2) * 10.0, share(3) * 16.0 - 8.0);
        let target = DVec3::new(share(4) * 4.0 - 2.0, 2.0 + share(5) * 5.0, share(6) * 4.0 - 2.0);
        let direction = (target - origin).normalize();
        let mut nearest = f64::INFINITY;
        for part in &tree.parts {
            for corners in &part.mesh.triangles {
                let world = light::Triangle(corners.map(|c| part.mesh.positions[c as usize].as_dvec3()));
                let normal = world.cross();
                let t = (world.0[0] - origin).dot(normal) / direction.dot(normal);
                let inside = world
                    .meet(origin, direction)
                    .is_some_and(|at| at.min_element() >= 0.0 && at.element_sum() <= 1.0);
                if t > 0.0 && inside {
                    nearest = nearest.min(t);
                }
            }
        }
        let met = mesh.first(origin, direction, 0.0).map_or(f64::INFINITY, |met| met.distance);
        // Two ways to the same f64: a few roundings of distances of 20 m.
        assert!(met == nearest || (met - nearest).abs() < 1e-9, "{met} {nearest}");
        let open = mesh.through(origin, direction, 0.0, f64::INFINITY);
        assert_eq!(open, if nearest.is_finite() { 0.0 } else { 1.0 });
    }
}

/// The light that a tree takes from the ground, by its planes and by its mesh.
#[test]
fn planes_take_as_much_sun_as_the_mesh() {
    let tree = small();
    let species: Species = bake(&tree, &Bake { rows: 128, ..Bake::default() }).unwrap();
    let height = species.description().height;
    let placed = Placed { species: 0, position: Vec3::ZERO, height, rotation: 0.0 };
    let stand = Stand::new(vec![species], vec![placed]).unwrap();
    let mesh = Reference::new(&tree);
    for altitude in [30f32, 45.0, 60.0, 90.0] {
        let (up, level) = altitude.to_radians().sin_cos();
        let toward = Vec3::new(0.6 * level, up, 0.8 * level);
        let taken = |occlude: &dyn Occlude| -> f32 {
            let point = |i: u32| Vec3::new((i % 80) as f32 - 39.5, 0.0, (i / 80) as f32 - 39.5) * 0.15;
            let aim = toward * (4.0 / toward.y);
            (0..6400)
                .map(|i| point(i) - aim.with_y(0.0))
                .map(|p| 1.0 - occlude.transmittance(&Ray::new(p, toward))[0])
                .sum()
        };
        let ratio = taken(&stand) / taken(&mesh);
        // Not a law but the claim of the crate's first page: within a tenth, and what 6400 points are off by (1/√ of those
        // in shadow, some 1000).
        assert!((ratio - 1.0).abs() < 0.1 + 0.03, "{altitude}: {ratio}");
    }
}
