//! What shows in a pixel, by rays: areas, layers of alpha, and the same to the bit however it is cut.

use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec2, Vec3};
use keikan_raytrace::{Quality, Rays, World};
use light::{Geometry, Instance, Mesh, Opacity, Piece, Projection, See, View};

/// An upright square of side 2 at height z, facing +z.
fn square(z: f32, opacity: Option<f32>) -> Mesh {
    let at = |x: f32, y: f32| Vec3::new(x, y, z);
    Mesh {
        positions: vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)],
        uvs: vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        opacity: opacity.map(|factor| Arc::new(Opacity { texture: None, factor, cutoff: None })),
        ..Mesh::default()
    }
}

fn world(meshes: Vec<Mesh>) -> Arc<World> {
    let place = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
    let instances = (0..meshes.len() as u32).map(place).collect();
    Arc::new(World::build(Arc::new(Geometry { meshes, instances }), Quality::Medium))
}

/// A parallel view from +z of a square of side `side`.
fn view(side: f64, pixels: u32) -> View {
    let look = View::look_at(DVec3::Z * 5.0, DVec3::ZERO, 45.0, pixels, pixels);
    View { projection: Projection::Orthographic { half_height: side / 2.0 }, ..look }
}

fn pieces(rays: &Rays, rows: std::ops::Range<u32>, columns: std::ops::Range<u32>) -> Vec<(u32, Piece)> {
    let mut out = Vec::new();
    rays.see(rows, columns, &mut |row, pieces| out.extend(pieces.drain(..).map(|piece| (row, piece))));
    out
}

#[test]
fn a_square_covers_its_area() {
    // Side 2 in a picture of side 3.3 in 10 pixels: the edges cut through pixels.
    let (side, pixels, samples) = (3.3, 10, 64);
    let rays = Rays::new(world(vec![square(0.0, None)]), view(side, pixels), samples);
    let seen: f64 = pieces(&rays, 0..pixels, 0..pixels).iter().map(|(_, piece)| f64::from(piece.share)).sum();
    let exact = (2.0 / side * f64::from(pixels)).powi(2);
    // Only strata that the rim passes through can be wrong, each by its whole area: the rim of 4 · 2/3.3 · 10
    // pixels crosses at most 8 strata a pixel and a corner or two more.
    let strata = 4.0 * 2.0 / side * f64::from(pixels) * 8.0 + 8.0;
    // Each is in or out at random, odds of at worst ½: six standard deviations.
    let bound = 6.0 * 0.5 * strata.sqrt() / f64::from(samples);
    assert!((seen - exact).abs() <= bound, "{seen} for {exact} ± {bound}");
}

#[test]
fn layers_of_alpha_share_a_pixel_front_to_back() {
    let meshes = vec![square(0.0, None), square(1.0, Some(0.25)), square(2.0, Some(0.5))];
    let rays = Rays::new(world(meshes), view(1.0, 4), 16);
    let of = |instance: u32, pieces: &[(u32, Piece)]| -> f32 {
        pieces.iter().filter(|(_, piece)| piece.hit.instance == instance).map(|(_, piece)| piece.share).sum()
    };
    for (row, column) in (0..4).flat_map(|row| (0..4).map(move |column| (row, column))) {
        let pieces = pieces(&rays, row..row + 1, column..column + 1);
        // ½, then ¼ of the half that is left, then all of the rest: sixteenths, exact in f32 (up to the sums of
        // the two triangles' shares, multiples of 1/128 of a pixel).
        assert_eq!([2, 1, 0].map(|i| of(i, &pieces)), [0.5, 0.125, 0.375]);
    }
}

#[test]
fn a_picture_is_the_same_however_it_is_cut() {
    let rays = Rays::new(world(vec![square(0.0, None), square(1.0, Some(0.3))]), view(2.5, 12), 5);
    let whole = pieces(&rays, 0..12, 0..12);
    let mut cut = Vec::new();
    for row in 0..12 {
        cut.extend(pieces(&rays, row..row + 1, 0..5));
        cut.extend(pieces(&rays, row..row + 1, 5..12));
    }
    assert_eq!(whole, cut);
    assert!(whole.is_sorted_by_key(|(row, piece)| (*row, piece.column)));
}

#[test]
fn nothing_nearer_than_the_near_plane_is_seen() {
    let near = View { near: 3.5, ..view(1.0, 2) };
    let rays = Rays::new(world(vec![square(0.0, None), square(2.0, None)]), near, 1);
    // The eye is at z = 5: the square at z = 2 is 3 m away, the one at 0 is 5 m away.
    assert!(pieces(&rays, 0..2, 0..2).iter().all(|(_, piece)| piece.hit.instance == 0 && piece.share == 1.0));
}
