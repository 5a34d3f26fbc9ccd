//! Exact visible spans of triangle meshes, scanline by scanline.
//!
//! **Answers.** [`light::See`]: which pieces of surface show in these pixels, and how much of each?
//! Every pixel row is cut by a few sub-scanlines (thesis 2.3.3). On each, what is visible is found
//! *exactly*, as an upper envelope of segments in (x, nearness): horizontal coverage is no sample but a length, faces may
//! pass through each other and overlap cyclically, and faces that share an edge leave no gap. A pixel's
//! pieces are summed over its lines, one for each visible face, to be shaded once at their centroid. Before that,
//! [`Scanline::spans`] tells what shows on a line, so that others (shadow volumes) may cut it first.
//!
//! Both sides of faces are seen. Faces with a [`light::Opacity`] let what lies behind through.
//!
//! **Cost.** O(n log n) for n faces, however deep they lie. Memory: 24 B a corner and 8 B a face that crosses a line,
//! beside the scene itself; working memory is that of one row. Processor seconds for one picture of 1920 × 1080,
//! four sub-scanlines, hits included (`cargo bench`, AMD EPYC of family 26 without wider instructions than
//! SSE2, 2026-11; two threads halve them while the machine is otherwise idle):
//!
//! | scene | faces | set-up | picture | memory beside the scene |
//! | --- | --- | --- | --- | --- |
//! | terrain | 10⁴ | 0.00 | 0.19 | 2 MiB |
//! | terrain | 10⁵ | 0.00 | 0.30 | 2 MiB |
//! | terrain | 10⁶ | 0.07 | 0.67 | 21 MiB |
//! | terrain | 10⁷ | 0.6 | 2.2 | 195 MiB |
//! | terrain, 8192 × 8192 | 10⁷ | 0.6 | 12.0 | 186 MiB |
//! | crossing faces as large as the picture | 3 · 10⁴ | 0.01 | 4.1 | |
//! | leaves with cut-out textures, some 12 deep | 10⁶ | 0.11 | 7.4 | |
//!
//! **Leaves out.** Shading, shadows, curved solids, lens and motion blur.
//!
//! **Where it is wrong.** Vertically, coverage is sampled at the sub-scanlines: a horizontal edge is off by
//! up to half a strip, and what fits between two lines is not seen at all. Veils that pass through each
//! other are ordered by their nearness at the middle of each interval between face borders within a pixel.
//! A veil that, with those before it, lets less than 1/2048 through is taken for opaque. A veil's opacity is
//! read once for a pixel, at the centroid of what shows of it. Faces that lie in one
//! plane, as far as f64 can tell, show the first of them in the order of (instance, triangle).
//!
//! ```
//! use std::sync::Arc;
//! use glam::{DAffine3, DVec3, Vec3};
//! use keikan_scanline::{Knobs, Scanline};
//! use light::{Geometry, Instance, Mesh, See, View};
//!
//! // A triangle that covers the left half of what the eye sees.
//! let mesh = Mesh {
//!     positions: vec![Vec3::new(0.0, -9.0, -1.0), Vec3::new(0.0, 9.0, -1.0), Vec3::new(-9.0, 0.0, -1.0)],
//!     triangles: vec![[0, 1, 2]],
//!     ..Mesh::default()
//! };
//! let instances = vec![Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY }];
//! let view = View::look_at(DVec3::ZERO, -DVec3::Z, 60.0, 3, 3);
//! let stage = Scanline::new(Arc::new(Geometry { meshes: vec![mesh], instances }), view, Knobs::default());
//! stage.see(0..3, 0..3, &mut |_row, pieces| {
//!     let shares: Vec<f32> = pieces.iter().map(|piece| piece.share).collect();
//!     assert_eq!(shares, [1.0, 0.5]); // columns 0 and 1; background shows in the rest
//! });
//! ```

mod area;
mod borders;
mod buckets;
mod cull;
mod envelope;
mod grid;
mod knobs;
mod pixel;
mod project;
pub mod reference;
mod resolve;
mod scanline;
mod see;
mod segment;
mod slabs;
mod spans;
mod veil;

pub use knobs::{Knobs, Rule, Shading};
pub use scanline::Scanline;
pub use spans::{Span, Spans};
