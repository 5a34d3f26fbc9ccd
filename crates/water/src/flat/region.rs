//! Where flat water is.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use light::{Mesh, Spectrum};

use super::cover::Cover;
use crate::scatter::Bed;
use crate::{Loss, Scattering, Surface, Water};

/// Water below a level surface with an outline, down to whatever its bottom is.
#[derive(Clone, Debug)]
pub struct FlatWater {
    /// What it does to light.
    pub water: Water,
    /// Height and index.
    pub surface: Surface,
    /// The surface, x and z in the world \[m\].
    cover: Cover,
    /// Edges of one triangle only: the outline.
    outline: Vec<[DVec2; 2]>,
    /// How deep it is; none = deeper than light comes.
    bed: Option<Arc<Bed>>,
}

impl FlatWater {
    /// `water` below `mesh`, which lies about y = 0 and which `place` moves to its level.
    pub fn new(water: Water, mesh: &Mesh, place: &DAffine3) -> Self {
        let at = |i: u32| {
            let p = place.transform_point3(mesh.positions[i as usize].as_dvec3());
            DVec2::new(p.x, p.z)
        };
        Self {
            surface: Surface::of(&water, place.translation.y),
            water,
            cover: Cover::new(mesh.triangles.iter().map(|t| t.map(at))),
            bed: None,
            outline: outline(mesh).into_iter().map(|edge| edge.map(at)).collect(),
        }
    }

    /// The same over a bed, which limits how often light is scattered ([`crate::Scattering::over`]).
    pub fn over(self, bed: Bed) -> Self {
        Self { bed: Some(Arc::new(bed)), ..self }
    }

    /// How light is scattered in it.
    pub(super) fn scattering(&self) -> Scattering {
        let deep = Scattering::new(self.water.clone(), self.surface.level, Loss::Diffuse);
        match &self.bed {
            Some(bed) => deep.over(Arc::clone(bed)),
            None => deep,
        }
    }

    /// The rectangle about the outline: its corners of least and largest x and z \[m\].
    pub fn extent(&self) -> [DVec2; 2] {
        self.cover.extent()
    }

    /// Whether the vertical through x, z meets the surface; its rim belongs to it.
    pub fn covers(&self, at: DVec2) -> bool {
        self.cover.holds(at)
    }

    /// How deep below the surface a point lies \[m\], negative above it; none beside the water.
    pub fn depth(&self, point: DVec3) -> Option<f64> {
        self.covers(DVec2::new(point.x, point.z)).then_some(self.surface.level - point.y)
    }

    /// What is left of light that lights things at `to`, in this water, of its way from `from` straight through the water and its sides.
    pub(super) fn left(&self, from: DVec3, to: DVec3) -> Spectrum {
        let [a, b] = [from, to].map(|p| DVec2::new(p.x, p.z));
        // Above the level there is no water.
        let under = |p: DVec3| p.y < self.surface.level;
        let share = match (under(from), under(to)) {
            (true, true) => self.stretches(a, b).iter().map(|[from, to]| to - from).sum(),
            _ => 1.0,
        };
        self.water.loss(Loss::Diffuse).attenuate((from.distance(to) * share) as f32)
    }

    /// The edges of the surface, x and z in the world \[m\], in no order.
    pub fn outline(&self) -> &[[DVec2; 2]] {
        &self.outline
    }

    /// A point of the surface's height in the middle of all of it.
    pub(super) fn middle(&self) -> DVec3 {
        let [low, high] = self.extent();
        let at = low.midpoint(high);
        DVec3::new(at.x, self.surface.level, at.y)
    }

    /// The stretches of the way from `a` to `b` (x, z) over which there is a surface, as rising shares of the way.
    pub(super) fn stretches(&self, a: DVec2, b: DVec2) -> Vec<[f64; 2]> {
        let mut ends: Vec<f64> = self.outline.iter().filter_map(|edge| crossing(edge, a, b - a)).collect();
        if ends.is_empty() {
            return if self.covers(a.midpoint(b)) { vec![[0.0, 1.0]] } else { Vec::new() };
        }
        ends.extend([0.0, 1.0]);
        ends.sort_by(f64::total_cmp);
        let stretches = ends.windows(2).map(|ends| [ends[0], ends[1]]);
        stretches.filter(|[from, to]| from < to && self.covers(a.lerp(b, 0.5 * (from + to)))).collect()
    }
}

/// Edges that no two triangles share.
fn outline(mesh: &Mesh) -> Vec<[u32; 2]> {
    let mut count = BTreeMap::new();
    for [a, b, c] in &mesh.triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *count.entry([*from.min(to), *from.max(to)]).or_insert(0u32) += 1;
        }
    }
    count.into_iter().filter(|(_, count)| *count == 1).map(|(edge, _)| edge).collect()
}

/// Where on its way from `a` by `way` a point crosses an edge, as a share within 0 and 1.
fn crossing([from, to]: &[DVec2; 2], a: DVec2, way: DVec2) -> Option<f64> {
    let (edge, start) = (*to - *from, *from - a);
    let across = way.perp_dot(edge);
    let (along, on_edge) = (start.perp_dot(edge) / across, start.perp_dot(way) / across);
    // Parallel ones give no number.
    (along > 0.0 && along < 1.0 && (0.0..=1.0).contains(&on_edge)).then_some(along)
}
