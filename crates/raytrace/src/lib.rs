//! Watertight rays over triangles: what is nearest, what is in the way, what shows in a pixel.
//!
//! **Answers.** [`World`] is a scene made ready for rays. It answers [`light::Nearest`] (the first hit of a
//! ray) and [`light::Occlude`] (what of the light along a segment arrives: 0 behind a solid face, 1 − opacity
//! through each face with an alpha texture, [`through`] for a transparent body). [`Rays`] answers [`light::See`] with jittered rays through each
//! pixel. [`BruteForce`] answers the first two without any hierarchy, slowly, in f64.
//!
//! **Promises.** No ray passes between two triangles that share an edge or a corner, axis-parallel rays and
//! grazing ones included. No ray that has left a surface by [`light::Place::leave`] meets that surface again.
//! Answers do not depend on threads, on [`Quality`], nor on which vector instructions the machine has.
//!
//! **Leaves out.** Curves, motion, refraction on the way of a shadow ray.
//!
//! **Where it is wrong.** A ray exactly through the edge between two faces with alpha meets both. Two
//! faces that lie within each other's rounding (2⁻²⁴ of their coordinates) may be met in either order. A mesh
//! whose neighbours meet edge against part of an edge (T-junctions) has the gaps it was given.
//!
//! ```
//! use std::sync::Arc;
//! use glam::{DAffine3, Vec3};
//! use light::{Geometry, Instance, Mesh, Nearest, Occlude, Ray};
//! use keikan_raytrace::{Quality, World};
//!
//! let roof = Mesh {
//!     positions: vec![Vec3::new(-9.0, 3.0, -9.0), Vec3::new(0.0, 3.0, 9.0), Vec3::new(9.0, 3.0, -9.0)],
//!     triangles: vec![[0, 1, 2]],
//!     ..Mesh::default()
//! };
//! let once = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
//! let geometry = Arc::new(Geometry { meshes: vec![roof], instances: vec![once] });
//! let world = World::build(geometry, Quality::Medium);
//!
//! let up = Ray::new(Vec3::ZERO, Vec3::Y);
//! assert_eq!(world.nearest(&up).map(|hit| hit.distance), Some(3.0));
//! assert_eq!(world.transmittance(&up).max(), 0.0);
//! assert_eq!(world.transmittance(&Ray { length: 3.0, ..up }).max(), 1.0); // the end is excluded
//! ```

mod binary;
mod collapse;
mod fan;
mod lanes;
mod quality;
mod query;
mod rays;
mod reference;
mod shadow;
mod shot;
pub mod solid;
mod supersample;
pub mod surface;
mod transmit;
mod tree;
mod triangle;
mod walk;
mod world;

pub use quality::Quality;
pub use query::Met;
pub use rays::Rays;
pub use reference::BruteForce;
pub use supersample::Supersample;
pub use transmit::{Crossing, pane, through};
pub use world::{Stats, World};
