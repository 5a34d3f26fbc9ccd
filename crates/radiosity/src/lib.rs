//! Diffuse interreflection between the faces of a scene (thesis 3.3.3).
//!
//! **Answers.** What share of one patch's light meets another ([`form_factor()`], [`attenuated_form_factor`], from a point
//! [`point_form_factor`])? What does every [`Patch`] of a scene receive from all others, over so many reflections ([`Links`],
//! [`solve`])? And what arrives so at any place, as a [`light::Illuminate`] ([`Interreflected`])? A medium between patches
//! ([`Attenuate`]) and ways over flat mirrors ([`Mirror`]: still water, from above or below) or bent through them ([`Passage`]) may be part of it.
//!
//! **How.** Faces are halved into patches no larger than asked for ([`Cut`]). Every patch gathers from parts of the scene that
//! are as large as they may be ([`Linking`]): halves of faces by exact form factors, groups of small faces far away as points.
//! What is in the way is tried along some ways that belong to the pair, unless surely nothing is ([`Obstacles`]). The shares are then balanced, so that light is neither
//! made nor lost on the way ([`Links`]). Light goes round as often as [`Orders`] says.
//!
//! *One convention:* F_ij = 1/(π A_i) ∫∫ cos θ_i cos θ_j / r² V dA_j dA_i is the share of what leaves i that arrives at j.
//!
//! **Costs and leaves,** as measured (example `scaling`: a room of 8 by 6 m with eight boxes, ρ = 0.6, [`Linking::default`], on two
//! cores): 1 152, 7 840 and 103 808 patches have 0.24, 1.8 and 24 million links (2, 21 and 272 MB), found in 0.6, 3.6 and 39 s; three orders
//! then take 0.001, 0.013 and 0.12 s. In a room of 4 by 5 m, a part of whose ceiling is lit, irradiances are
//! off by 0.6 % of their mean (root mean square, 224 patches) from the dense [`reference`](mod@reference), by 0.2 % with `share` 0.001;
//! with two boxes and 16 ways a link by 0.5 and 0.4 %. Interpolated light is off by 2.3 % of the mean near edges, 0.7 % elsewhere
//! (patches of 0.4 m, `share` 0.02).
//!
//! **Leaves out.** Reflection that is not diffuse; ways over two mirrors or through two surfaces, or one and the other; which lights there are ([`direct`]
//! asks them). Patches are cut evenly, not where light changes.
//!
//! **Known to be wrong.** Contact shadows are as soft as patches are large. A wall that stands on a face without an edge there lets
//! light through for the width of a patch. Where [`Linking::closed`] is not set, tried ways lose 0.2 to 0.4 % of the light of
//! a furnished room. Groups of faces with different normals send their mean to all sides.
//!
//! ```
//! use std::sync::Arc;
//! use glam::{DAffine3, Vec3};
//! use light::{Geometry, Illuminate, Instance, Mesh, Place, Spectrum, Vacuum};
//! use keikan_radiosity::*;
//!
//! // A luminous square of 2 m, 1 m above a floor of 2 m that it lights.
//! let square = |y: f32| [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, z]| Vec3::new(x, y, z));
//! let mesh = Mesh {
//!     positions: [square(0.0), square(1.0)].concat(),
//!     triangles: vec![[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]],
//!     ..Mesh::default()
//! };
//! let placed = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
//! let geometry = Geometry { meshes: vec![mesh], instances: vec![placed] };
//!
//! let patches = Arc::new(Patches::new(&geometry, &|_: &Patch| Spectrum::splat(0.5), &Cut::default()));
//! let links = Links::new(&patches, &Between::dry(&Vacuum), &Linking::default());
//! let shines = |patch: Patch| if patch.face[1] >= 2 && patch.side == Side::Front { 1.0 } else { 0.0 };
//! let emitted: Vec<_> = patches.iter().map(|patch| Spectrum::splat(shines(patch))).collect();
//! let solution = solve(&patches, &links, &Source { emitted: &emitted, direct: &[] }, Orders::Count(1));
//! let stage = Interreflected::new(&geometry, patches, &links, &solution, &Linking::default());
//!
//! let middle = Place { position: Vec3::ZERO, error: 1e-6, normal: Vec3::Y, seed: 0 };
//! let found = stage.irradiance(&middle, &Vacuum)[0];
//! assert!((found - 4.0 * 0.1385316).abs() < 0.01); // four times Howell's corner of a unit square
//! ```

mod balance;
mod between;
mod direct;
mod form_factor;
mod gather;
mod lambert;
mod links;
mod obstacles;
mod passage;
mod patch;
pub mod reference;
mod sight;
mod solve;
mod stage;
mod tree;
mod triangle;
mod vertices;

pub use between::{Absorbing, Attenuate, Between, Clear, Mirror};
pub use direct::direct;
pub use form_factor::{FormFactor, attenuated_form_factor, form_factor};
pub use lambert::point_form_factor;
pub use links::{Linking, Links};
pub use obstacles::Obstacles;
pub use passage::{Bent, Passage};
pub use patch::{Cut, Patch, Patches, Side, Surfaces};
pub use solve::{MOST_ORDERS, Orders, Solution, Source, solve};
pub use stage::Interreflected;
