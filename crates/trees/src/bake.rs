//! A species from any tree mesh.

mod fit;
mod raster;
mod shelter;

use std::fmt;

use glam::{Vec2, Vec3};
use light::Spectrum;

use crate::region::scatter_of;
use crate::sheet::Sheet;
use crate::species::{Description, Leaf, Slice, Species, SpeciesError};
use crate::tree_mesh::TreeMesh;
use fit::Leaves;
use raster::{Frame, raster};

/// How a mesh becomes pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bake {
    /// Rows of the side view, from 2 to 4096; all pictures have its resolution. Memory grows with the square: no more than
    /// [`MOST_BYTES`] are taken for pictures.
    pub rows: u32,
    /// Horizontal planes, at most 64; 0 vanishes from above.
    pub planes: u32,
    /// Samples along each side of a texel, from 1 to 8: alpha is known to 1/samples².
    pub samples: u32,
    /// Length of a leaf \[m\]; none = as the leaves' triangles say, two to a leaf.
    pub leaf: Option<f32>,
    /// Transmittance of leaves; none = [`TRANSMITTANCE`] of their mean reflectance.
    pub transmittance: Option<Spectrum>,
    /// Decides what is random of the species.
    pub seed: u32,
}

/// Transmittance of a leaf as a share of its reflectance, where nothing is known: in the visible, PROSPECT's leaves pass 0.5 to
/// 0.9 of what they reflect.
pub const TRANSMITTANCE: f32 = 0.7;

impl Default for Bake {
    fn default() -> Self {
        Self { rows: 512, planes: 4, samples: 4, leaf: None, transmittance: None, seed: 1 }
    }
}

/// Why a mesh becomes no species.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BakeError {
    /// It has no triangle with an area, or none above the ground.
    Empty,
    /// Rows, planes or samples out of range.
    Size,
    /// Pictures would take so many bytes, more than [`MOST_BYTES`].
    Memory(u64),
    /// A coordinate is no finite number.
    NotFinite,
    /// What was baked is no species.
    Species(SpeciesError),
}

impl fmt::Display for BakeError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => out.write_str("the mesh has nothing above the ground (y = 0)"),
            Self::Size => out.write_str("2 to 4096 rows, up to 64 planes, 1 to 8 samples"),
            Self::Memory(bytes) => write!(
                out,
                "pictures of so many rows and planes take {:.1} GB: at most {:.1} GB are possible, with fewer rows or planes",
                *bytes as f64 / 1e9,
                MOST_BYTES as f64 / 1e9
            ),
            Self::NotFinite => out.write_str("the mesh has a corner that is nowhere"),
            Self::Species(error) => error.fmt(out),
        }
    }
}

impl std::error::Error for BakeError {}

/// What the pictures of a species may take \[bytes\]: 4096 rows with four planes are possible, for a tree as wide as it is high.
pub const MOST_BYTES: u64 = 2 << 30;

/// Of each texel: 8 bytes, a third more for coarser ones, a mask, and 5 while it is made.
const BYTES_A_TEXEL: u64 = 17;

/// Pictures of this many texels in a row, at most, however wide the tree.
const WIDEST: u32 = 4096;

/// Renders a tree mesh from the side (along −Z) and, for each horizontal plane, what is nearest to it from above, fits the
/// envelope to its leaves (to all of it where there are none), and measures size and scatter of leaves.
pub fn bake(tree: &TreeMesh, bake: &Bake) -> Result<Species, BakeError> {
    if !(2..=4096).contains(&bake.rows) || bake.planes > 64 || !(1..=8).contains(&bake.samples) {
        return Err(BakeError::Size);
    }
    let positions = || tree.parts.iter().flat_map(|part| &part.mesh.positions);
    if !positions().all(|p| p.is_finite()) {
        return Err(BakeError::NotFinite);
    }
    let leaves = Leaves::of(tree).ok_or(BakeError::Empty)?;
    let (height, _) = leaves.reach;
    let (half_width, frame, from_above) = frames(leaves.reach, bake)?;
    let everything = [f32::NEG_INFINITY, f32::INFINITY];
    let side = raster(tree, &frame, bake.samples, everything).ok_or(BakeError::Size)?;
    let slices = leaves
        .layers(bake.planes)
        .into_iter()
        .map(|(height, range)| {
            raster(tree, &from_above, bake.samples, range).map(|sheet| Slice { height, sheet })
        })
        .collect::<Option<Vec<_>>>()
        .ok_or(BakeError::Size)?;
    let envelope = leaves.envelope().ok_or(BakeError::Empty)?;
    let (lean, straight) = leaves.facing(&envelope);
    let mean = mean_reflectance(&side);
    let leaf = Leaf {
        size: bake.leaf.unwrap_or(leaves.size),
        reflectance: None,
        transmittance: bake.transmittance.unwrap_or(mean * TRANSMITTANCE),
        scatter: scatter_of(straight),
        lean,
    };
    let species = Species::new(Description {
        height,
        half_width,
        side,
        slices,
        envelope,
        leaf,
        extinction: None,
        shelter: 1.0,
        seed: bake.seed,
    })
    .map_err(BakeError::Species)?;
    let shelter = shelter::fitted(tree, &species);
    Ok(species.sheltered(shelter))
}

/// Half the width of all pictures \[m\], and the planes of the side view and of those from above, for a tree of that height and radius.
fn frames((height, radius): (f32, f32), bake: &Bake) -> Result<(f32, Frame, Frame), BakeError> {
    let texel = height / bake.rows as f32;
    // A whole number of texels on each side of the axis, and one that stays clear.
    let columns = (2 * ((radius / texel).ceil() as u32 + 1)).min(WIDEST);
    let texels = u64::from(columns) * (u64::from(bake.rows) + u64::from(columns) * u64::from(bake.planes));
    if texels * BYTES_A_TEXEL > MOST_BYTES {
        return Err(BakeError::Memory(texels * BYTES_A_TEXEL));
    }
    let half_width = (0.5 * columns as f32 * texel).max(1.02 * radius);
    let side = Frame {
        right: Vec3::X,
        down: Vec3::NEG_Y,
        corner: Vec2::new(-half_width, -height),
        texel: Vec2::new(2.0 * half_width / columns as f32, texel),
        size: [columns, bake.rows],
    };
    let from_above = Frame {
        down: Vec3::Z,
        corner: Vec2::splat(-half_width),
        texel: Vec2::splat(2.0 * half_width / columns as f32),
        size: [columns; 2],
        ..side
    };
    Ok((half_width, side, from_above))
}

fn mean_reflectance(side: &Sheet) -> Spectrum {
    side.mean_leaf().map_or(Spectrum::ZERO, Spectrum::reflectance)
}
