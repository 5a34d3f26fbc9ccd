//! Trees as turning planes, with shade and shadow.
//!
//! **Answers.** What an eye sees of many trees along a ray ([`Stand`], a [`light::Traverse`]) and what they let through of light
//! (the same, a [`light::Occlude`]): a vertical plane that turns to the viewer or the light and a few horizontal ones, with pictures
//! that fade by the angle ([`Setting`]); leaves that face as the crown does, more or less, fixed by seeds, lit by
//! sun, lamps and sky and shining through ([`Shading`]). Pictures, outline and leaves are a [`Species`], made from any tree mesh
//! ([`bake`]), for instance one grown from a few numbers ([`grow`]), or put together by hand ([`Description`]). A tree more is 24 bytes and its share of a hierarchy,
//! 40 to 50 in all. [`reference`](mod@reference) answers for the mesh itself, to measure the difference.
//!
//! **Leaves out.** Files; wind; seasons; light that leaves scatter to each other and to the ground; the sun's disc; flowers and gloss.
//!
//! **Known to be wrong.** Figures are those of `examples/planes_against_mesh` with four planes: planes against the mesh that they were
//! baked from. Within a crown light fades as in a cloud of even density, sheltered by clumps on the mean of all
//! directions: leaves are up to a third too dark where the sun stands behind the viewer (all that one sees is then lit), a
//! dense round crown seen from the level is up to two fifths too bright; in between, luminance is within a sixth. Silhouettes are those of one view,
//! all around: the share that is hidden is within a tenth of the mesh's from twice the tree's height on, of a thin column seen from straight above a
//! quarter too much; alpha of single pixels is off by 0.07 to 0.2 (root mean square) there and by 0.16 to 0.37 at one height. The sun's light
//! that is taken from the ground in the mesh's shadow is within a ninth, the sky's within a
//! sixth. Three planes are within 0.03 of four on the mean; without any, a fifth to half is left at 60° and nothing from above. Nearer than a tree's own height, above
//! all from below, horizontal planes show as veils at the crown's border, and from within its crown a tree is flat.
//! Planes are set for each ray to a lamp, so that the way back is as dark: they differ slightly over a shadow. Extended light is asked for once per tree and ray. A vertical plane turns at once where the eye passes over its
//! axis. Shadows of distant light are read 4.7 mm wide for each metre of their way, half of what the sun's disc makes, whatever the
//! source's diameter: a sun that is a point leaves soft shadows, and where its disc is asked for with several rays, its
//! penumbra is a sixth too wide (√(2.33² + 1.36²) in place of 2.33 mrad, root mean square). Bark has no texture but its picture's, and round stems are lit as if seen from the level.
//!
//! ```
//! use glam::Vec3;
//! use light::{Occlude, Ray};
//! use keikan_trees::{Bake, Form, Growth, Placed, Stand, bake, grow};
//!
//! let mesh = grow(&Growth { leaves: 1000, ..Growth::usual(Form::Spreading, 9.0, 1) }).unwrap();
//! let lime = bake(&mesh, &Bake { rows: 128, ..Bake::default() }).unwrap();
//! let row = |i: u32| Placed { species: 0, position: Vec3::X * (7.0 * i as f32), height: 8.0, rotation: i as f32 };
//! let avenue = Stand::new(vec![lime], (0..20).map(row).collect()).unwrap();
//!
//! // Some of the sun's light gets through the first tree, all of it beside the avenue.
//! let toward_sun = Vec3::new(0.0, 0.6, 0.8);
//! let [under, beside] = [Vec3::new(0.0, 0.0, -6.0), Vec3::new(0.0, 0.0, 6.0)];
//! assert!(avenue.transmittance(&Ray::new(under, toward_sun)).max() < 1.0);
//! assert_eq!(avenue.transmittance(&Ray::new(beside, toward_sun)).max(), 1.0);
//! ```

mod bake;
mod cover;
mod envelope;
mod grow;
mod hierarchy;
mod leaf;
mod photo;
mod planes;
pub mod reference;
mod region;
mod seen;
mod shadow;
mod sheet;
mod species;
mod stand;
mod tree_mesh;

pub use bake::{Bake, BakeError, MOST_BYTES, TRANSMITTANCE, bake};
pub use envelope::Envelope;
pub use grow::{Form, Growth, grow};
pub use leaf::{Crossing, Shading};
pub use photo::{Photo, Picture, from_photo};
pub use planes::{Fade, Setting, Turn};
pub use sheet::Sheet;
pub use species::{Description, Leaf, Slice, Species, SpeciesError};
pub use stand::{Placed, Stand, StandError};
pub use tree_mesh::{Part, TreeMesh};

#[cfg(test)]
mod bake_tests;
#[cfg(test)]
mod stand_tests;
