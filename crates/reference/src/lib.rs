//! The judge: light by random walks, slow and unbiased, in f64.
//!
//! **Answers.** What arrives at a sensor ([`irradiance`]), along a line ([`radiance`]) and in every pixel ([`picture`]) of a [`World`] of
//! triangles, curved solids, lamps, a sky and flat waters, each number with its standard error. It is there to judge what everyone else calculates: there is no
//! patch, table of visibility, map, model of shadows or limit of reflections in it, and nothing that can be wrong but by chance, which the error
//! says, and by what stands below.
//!
//! **How.** Walks go backwards from the receiver (Kajiya 1986) and end by chance. At each point where light is scattered, lamps are also looked for,
//! straight, through partly transparent faces and panes, and along the one way that a level water surface mirrors or bends to them; where
//! a walk can meet the same light by chance, both share it by the balance heuristic (Veach 1997). Under water light flies freely
//! and is scattered as often as it is; bands fly together, and share what each would have done. Samples have seeds of their own: the same bits on any number of threads.
//!
//! **Shares with those it judges:** what things are (triangles, textures and their colours as bands, tables of luminaires), the sky's radiance by
//! direction and phase functions, which whoever makes the world hands over as functions, the formulas of Fresnel and Snell ([`light::interface`]), and
//! the definition of glossy materials (facets of Trowbridge and Reitz over a matt body), which it integrates by itself. Not
//! shared: rays and their hierarchy, set operations of solids, normals, shadows, sampling, the ways past water, all sums.
//!
//! **Leaves out.** Waves, trees that are not meshes, normal maps, bodies in bodies. Roughness of what light passes: glass is smooth.
//!
//! **Known to be wrong.** Light of *points* that comes off smooth mirrors, through bodies of glass, or past two water surfaces is never met,
//! and missing; that of the sun and of lamps with an extent is met there by chance, and noisy. Solids that shine are met by chance alone. Lamps hide
//! nothing. The matt share of glass counts its boundary only on the way in. Lines leave triangles 1e-12 of the scene's size off them, and solids
//! 1e-7 m: what is thinner is not there. A line along a common edge may pass between two triangles by rounding. Where one walk in thousands meets most of the light, a small number of
//! walks finds neither that nor its error: standard errors are as long as they say for many walks (`tests/all/honest.rs`), and too short for few.
//!
//! **Costs.** Between interreflecting faces 10⁴ walks leave 0.5 to 1 % under sun and sky, 1 to 3 % far from lamps (`scenes/courtyard.toml`, `lamps.toml`);
//! errors fall with the root of the number. Solids are tried one after the other.
//!
//! ```
//! use glam::DVec3;
//! use keikan_reference::{Effort, Lamp, Bands, Parts, World, irradiance};
//!
//! // A sun straight above, nothing else.
//! let sun = Lamp::Sun { toward: DVec3::Y, radius: 0.00465, irradiance: Bands::ONE };
//! let world = World::new(Parts { lamps: vec![sun], ..Parts::default() });
//! let effort = Effort { samples: 1000, faces: None, seed: 1 };
//! let tilted = DVec3::new(0.6, 0.8, 0.0);
//! let found = irradiance(&world, DVec3::ZERO, tilted, &effort);
//! assert!((found.mean[0] - 0.8).abs() <= 4.0 * found.error[0]);
//! ```

mod bands;
mod boundary;
mod dice;
mod estimate;
mod facets;
mod glass;
mod glow;
mod heaven;
mod lamp;
mod look;
mod phase;
mod shape;
mod solid;
mod surface;
mod tree;
mod walk;
mod water;
mod ways;
mod world;

pub use bands::Bands;
pub use estimate::{Effort, Estimate, Picture, irradiance, picture, radiance};
pub use lamp::Lamp;
pub use phase::Phase;
pub use solid::{Convex, Solid};
pub use surface::{Image, Surface};
pub use water::Water;
pub use world::{Parts, Sky, World};
