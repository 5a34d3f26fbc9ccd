//! Exact visible spans of triangle meshes, scanline by scanline.
//!
//! **Answers.** [`light::See`]: which pieces of surface show in these pixels, and how much of each?
//! Every pixel row is cut by a few sub-scanlines (thesis 2.3.3). On each, what is visible is found
//! *exactly*, as an upper envelope of segments in (x, nearness): faces may pass through each other and overlap
//! cyclically, and faces that share an edge leave no gap. Around its line each border goes on as the edge does that
//! makes it, so that what is summed are areas; strips between lines end at corners where these are few. A pixel's
//! pieces are summed over its lines, one for each visible face, to be shaded once at their centroid. Before that,
//! [`Scanline::with_shadows`] cuts spans where the light of point sources begins and ends (thesis 2.3.2): borders of
//! shadows have exact coverage too, and pieces come with what is known of their light. [`Scanline::spans`] tells
//! what shows on a line, uncut.
//!
//! [`Localised`] sees curved solids and set operations among the faces, and asks rays where their border is.
//!
//! Both sides of faces are seen. Faces with a [`light::Opacity`] let what lies behind through.
//!
//! **Cost.** O(n log n) for n faces, however deep they lie. Memory: 24 B a corner and 8 B a face that crosses a line,
//! beside the scene itself; working memory is that of one row. Processor seconds for one picture of 1920 × 1080,
//! four sub-scanlines, hits included (`cargo bench`, AMD EPYC of family 26 without wider instructions than
//! SSE2, 2026-11, both rules in one run on a machine busy with other work; idle, the midpoint rule took
//! 12.0 s for 10⁷ faces at 8192 × 8192 and three quarters of what is said of leaves):
//!
//! | scene | faces | set-up | midpoint rule | exact rule | memory beside the scene |
//! | --- | --- | --- | --- | --- | --- |
//! | terrain | 10⁴ | 0.00 | 0.18 | 0.22 | 2 MiB |
//! | terrain | 10⁵ | 0.01 | 0.29 | 0.39 | 4 MiB |
//! | terrain | 10⁶ | 0.09 | 0.67 | 0.88 | 27 MiB |
//! | terrain | 10⁷ | 0.6 | 2.1 | 2.8 | 195 MiB |
//! | houses | 1.2 · 10³ | 0.00 | 0.15 | 0.18 | |
//! | houses | 1.2 · 10⁴ | 0.00 | 0.28 | 0.34 | |
//! | crossing faces as large as the picture | 3 · 10² | 0.00 | 0.29 | 0.32 | |
//! | crossing faces as large as the picture | 3 · 10⁴ | 0.01 | 6.4 | 7.4 | |
//! | leaves with cut-out textures, some 12 deep | 10⁶ | 0.12 | 9.5 | 9.8 | |
//!
//! Cutting at shadows takes a tenth more for one source as for three (town of 600 faces, 512 × 384: 0.0215 s without,
//! 0.0238 s and 0.0241 s), beside what the occluder takes for its answers ([`Scanline::cut_from`]).
//!
//! **Leaves out.** Shading, finding shadows (a [`light::Occlude`] is asked), lens and motion blur.
//!
//! **Where it is wrong.** Visibility is found on the lines only: where corners are too many to end strips there,
//! or borders cross within a strip, coverage is off by up to the area between the border and its tangent, and what
//! fits between two lines is not seen at all. So corners of finely meshed planes are less sharp than
//! those of coarse ones (by a strip's height at most). Outlines so level that they come more than 8 pixels
//! into the picture within half a strip are cut off at its sides. Shadows are cut by the same rule, but strips do
//! not end at their corners: straight borders are exact, a corner is off within its strip. Veils are sampled on the lines, and so is what
//! shows through them; those that pass through each other are ordered by their nearness at the middle of each
//! interval between face borders within a pixel.
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
mod bodies;
mod borders;
mod buckets;
mod cull;
mod cut;
mod envelope;
mod grid;
mod knobs;
mod known;
mod pixel;
mod place;
mod project;
pub mod reference;
mod resolve;
mod scanline;
mod see;
mod segment;
mod shadows;
mod slabs;
mod spans;
mod veil;

pub use bodies::Localised;
pub use knobs::{Knobs, Rule, Shading};
pub use scanline::Scanline;
pub use spans::{Span, Spans};
