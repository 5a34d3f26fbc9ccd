//! What a mesh's leaves say about a crown: its outline, its layers, how large leaves are and where they face.

use glam::{Vec2, Vec3};

use crate::envelope::Envelope;
use crate::tree_mesh::TreeMesh;

/// Bins over the crown's height.
const BINS: usize = 16;

/// Share of a bin's leaves within the envelope; the rest sticks out.
const WITHIN: f32 = 0.92;

/// One triangle.
struct Face {
    centre: Vec3,
    normal: Vec3,
    area: f32,
}

impl Face {
    fn radius(&self) -> f32 {
        self.centre.with_y(0.0).length()
    }
}

/// The leaves of a mesh; all of it where it has none.
pub(super) struct Leaves {
    /// By height.
    faces: Vec<Face>,
    /// Highest corner and largest distance from the axis of the whole tree \[m\].
    pub(super) reach: (f32, f32),
    /// Length of a leaf \[m\].
    pub(super) size: f32,
}

impl Leaves {
    /// None where nothing with an area is above the ground.
    pub(super) fn of(tree: &TreeMesh) -> Option<Self> {
        let (mut faces, mut wood, mut reach) = (Vec::new(), Vec::new(), (0.0f32, 0.0f32));
        for part in &tree.parts {
            for corners in &part.mesh.triangles {
                let [a, b, c] = corners.map(|i| part.mesh.positions.get(i as usize).copied());
                let (Some(a), Some(b), Some(c)) = (a, b, c) else { continue };
                for corner in [a, b, c] {
                    reach = (reach.0.max(corner.y), reach.1.max(corner.with_y(0.0).length()));
                }
                let cross = (b - a).cross(c - a);
                let face = Face {
                    centre: (a + b + c) / 3.0,
                    normal: cross.normalize_or_zero(),
                    area: 0.5 * cross.length(),
                };
                if face.area > 0.0 && face.centre.y > 0.0 {
                    if part.leaf { &mut faces } else { &mut wood }.push(face);
                }
            }
        }
        if faces.is_empty() {
            faces = wood;
        }
        if faces.is_empty() || reach.0 <= 0.0 || reach.1 <= 0.0 {
            return None;
        }
        faces.sort_by(|a, b| a.centre.y.total_cmp(&b.centre.y));
        // Two triangles to a leaf, whose ellipse has the area π size²/8 (see `region`).
        let mean = faces.iter().map(|face| face.area).sum::<f32>() / faces.len() as f32;
        let size = (8.0 * 2.0 * mean / std::f32::consts::PI).sqrt();
        Some(Self { faces, reach, size: size.min(0.2 * reach.0) })
    }

    /// The lowest leaf with which a share of the leaves' area is reached.
    fn reached(&self, share: f32) -> usize {
        let total: f32 = self.faces.iter().map(|face| face.area).sum();
        let mut left = share * total;
        let found = self.faces.iter().position(|face| {
            left -= face.area;
            left <= 0.0
        });
        found.unwrap_or(self.faces.len() - 1)
    }

    /// Height below which a share of the leaves' area lies.
    fn quantile(&self, share: f32) -> f32 {
        self.faces[self.reached(share)].centre.y
    }

    /// The same between two leaves, where it cuts none that lie level.
    fn between(&self, share: f32) -> f32 {
        let at = self.reached(share);
        0.5 * (self.faces[at.saturating_sub(1)].centre.y + self.faces[at].centre.y)
    }

    /// Planes that share the leaves equally, each with the range of heights \[m\] that it shows.
    pub(super) fn layers(&self, planes: u32) -> Vec<(f32, [f32; 2])> {
        let border = |i: u32| match i {
            0 => f32::NEG_INFINITY,
            i if i == planes => f32::INFINITY,
            i => self.between(i as f32 / planes as f32),
        };
        let plane = |i: u32| self.quantile((i as f32 + 0.5) / planes as f32);
        (0..planes).map(|i| (plane(i), [border(i), border(i + 1)])).collect()
    }

    /// Radius that holds [`WITHIN`] of the leaves at each height, of the crown without its lowest hundredth.
    pub(super) fn envelope(&self) -> Option<Envelope> {
        let base = self.quantile(0.01);
        let top = self.faces.last()?.centre.y.max(base + 0.01 * self.reach.0).min(self.reach.0);
        let step = (top - base) / BINS as f32;
        let mut radii: Vec<f32> = (0..BINS).map(|bin| self.radius(base + bin as f32 * step, step)).collect();
        // Bins without leaves take after those below them.
        for bin in 1..BINS {
            if radii[bin] == 0.0 {
                radii[bin] = 0.5 * radii[bin - 1];
            }
        }
        // Ends are as blunt as half their bin.
        let mut knots = vec![Vec2::new(base, 0.5 * radii[0])];
        knots
            .extend(radii.iter().enumerate().map(|(bin, r)| Vec2::new(base + (bin as f32 + 0.5) * step, *r)));
        knots.push(Vec2::new(top, 0.3 * radii[BINS - 1]));
        Envelope::fitted(&knots)
    }

    fn radius(&self, from: f32, step: f32) -> f32 {
        let first = self.faces.partition_point(|face| face.centre.y < from);
        let last = self.faces.partition_point(|face| face.centre.y < from + step);
        let mut within: Vec<(f32, f32)> =
            self.faces[first..last].iter().map(|face| (face.radius(), face.area)).collect();
        within.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut left = WITHIN * within.iter().map(|(_, area)| area).sum::<f32>();
        let found = within.iter().find(|(_, area)| {
            left -= area;
            left <= 0.0
        });
        found.map_or(0.0, |(radius, _)| *radius)
    }

    /// The lean (see [`crate::Leaf`]) whose axes leaves' normals keep closest to, and their mean |cosine| to these.
    pub(super) fn facing(&self, envelope: &Envelope) -> (f32, f32) {
        let total: f32 = self.faces.iter().map(|face| face.area).sum();
        let outward: Vec<Vec3> = self.faces.iter().map(|face| envelope.normal(face.centre)).collect();
        let straight = |lean: f32| {
            let cos = |(face, outward): (&Face, &Vec3)| {
                face.area * face.normal.dot((*outward + Vec3::Y * lean).normalize_or(Vec3::Y)).abs()
            };
            self.faces.iter().zip(&outward).map(cos).sum::<f32>() / total
        };
        let tried = LEANS.map(|lean| (lean, straight(lean)));
        tried.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0.0, 0.5))
    }
}

/// Leans that are tried: from outwards to straight up.
const LEANS: [f32; 9] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.5, 5.0, 10.0];
