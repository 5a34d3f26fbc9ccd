//! The beams of one source by one surface.

use glam::{DVec2, DVec3};
use light::{fresnel, reflect, refract};
use rayon::prelude::*;

use super::clip::share_in_square;
use super::grid::Grid;
use super::tree::{self, Target, Tree};
use crate::flat::{FlatWater, Source};
use crate::path::transmitted;
use crate::waves::{Covariance, Waves};
use crate::{Surface, Way};

/// Rays that lean more than this (run sideways per drop: 87° from the vertical) are lost, and beams that they bound.
const LEANEST: f64 = 20.0;

/// A square of side 2 r has the second moment of a disc of this many times r less: √3/2.
const SQUARE_OF_DISC: f64 = 0.866_025_403_784_438_6;

/// What is known of the light that leaves a corner.
#[derive(Clone, Copy, Debug)]
struct Ray {
    /// Above the level \[m\].
    height: f32,
    /// Sideways run per drop.
    lean: [f32; 2],
    /// Let through or mirrored; negative for rays that are lost.
    share: f32,
}

/// Light that arrives at a receiver by a part of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Where it leaves the surface \[m\].
    pub from: DVec3,
    /// Unit vector at the receiver towards where it comes from.
    pub toward: DVec3,
    /// Irradiance on a level receiver over what the source gives a plane that faces it at `from`; nothing lost in the water.
    pub level: f64,
}

/// All beams of one source by one surface.
#[derive(Clone, Debug)]
pub struct BeamMap {
    surface: Surface,
    source: Source,
    grid: Grid,
    rays: Vec<Ray>,
    /// Which of a cell's two triangles send light: bits.
    lit: Vec<u8>,
    tree: Tree,
    /// Where beams go.
    down: bool,
    /// By what angle they are blurred \[rad\]: half of the side of a square 1 m away.
    blur: f64,
}

impl BeamMap {
    /// Of a source above the surface that is seen from it within `disc` \[rad\] of its middle, by a `way` that is no direct one, in cells of `step` \[m\].
    pub fn new(water: &FlatWater, waves: &Waves, source: Source, way: Way, (step, disc): (f64, f64)) -> Self {
        let [low, high] = water.extent();
        let grid = Grid::new(low, high, step);
        let turn = Turn { surface: water.surface, source, way };
        let footprint = Covariance::even(grid.step.max_element());
        let [across, along] = grid.corners();
        let row = |j| (0..across).map(move |i| [i, j]);
        let ray = |corner| turn.ray(grid.at(corner), waves, footprint);
        let rays: Vec<Ray> = (0..along).into_par_iter().flat_map_iter(|j| row(j).map(ray)).collect();
        let lit = |cell| {
            let bits = grid.triangles(cell).map(|corners| {
                let sends = corners.iter().all(|&corner| rays[grid.index(corner)].share >= 0.0);
                u8::from(sends && water.covers(middle(corners.map(|corner| grid.at(corner)))))
            });
            bits[0] | bits[1] << 1
        };
        let [columns, rows] = grid.cells;
        let lit: Vec<u8> = (0..rows).flat_map(|j| (0..columns).map(move |i| [i, j])).map(lit).collect();
        let bounded = |n: usize| {
            let Ray { height, lean: [x, z], .. } = rays[n];
            [height, x, z]
        };
        let tree = Tree::new(&grid, bounded, |[i, j]| lit[j * columns + i] != 0);
        let bend = if turn.is_down() { 1.0 / water.surface.index } else { 1.0 };
        Self {
            surface: water.surface,
            source,
            tree,
            down: turn.is_down(),
            blur: SQUARE_OF_DISC * disc * bend,
            lit,
            rays,
            grid,
        }
    }

    /// The greatest |height| of its corners \[m\]: no beam begins farther from the level.
    pub fn reach(&self) -> f64 {
        f64::from(self.rays.iter().fold(0.0f32, |most, ray| most.max(ray.height.abs())))
    }

    /// Half of the side of the square that stands for a receiver \[m\], `least` at least: as the source's disc is blurred, but a quarter of a step at least.
    pub fn half_width(&self, at: DVec3, least: f64) -> f64 {
        let blurred = self.blur * (self.surface.level - at.y).abs();
        blurred.max(0.25 * self.grid.step.max_element()).max(least)
    }

    /// Calls `receive` with what arrives in the level square about `at` of side 2 `half` \[m\]; of each part of the surface (some cells
    /// across) once.
    pub fn beams(&self, at: DVec3, half: f64, receive: &mut dyn FnMut(Beam)) {
        let down = if self.down { 1.0 } else { -1.0 };
        let target = Target { at, half, level: self.surface.level, down };
        self.tree.visit(&self.grid, &target, &mut |leaf| {
            let mut part = Part::default();
            for cell in tree::cells(&self.grid, leaf) {
                let bits = self.lit[cell[1] * self.grid.cells[0] + cell[0]];
                for (n, corners) in self.grid.triangles(cell).into_iter().enumerate() {
                    if bits & 1 << n != 0 {
                        self.add(&mut part, corners, &target);
                    }
                }
            }
            if part.flux > 0.0 {
                receive(part.beam(&target));
            }
        });
    }

    /// Adds the part of one triangle's beam that falls into the target.
    fn add(&self, part: &mut Part, corners: [[usize; 2]; 3], target: &Target) {
        let rays = corners.map(|corner| self.rays[self.grid.index(corner)]);
        let heights = rays.map(|ray| self.surface.level + f64::from(ray.height));
        let drops = heights.map(|height| (height - target.at.y) * target.down);
        if drops.iter().any(|&drop| drop <= 0.0) {
            return;
        }
        let leans = rays.map(|ray| DVec2::new(f64::from(ray.lean[0]), f64::from(ray.lean[1])));
        let foot = DVec2::new(target.at.x, target.at.z);
        let places = corners.map(|corner| self.grid.at(corner));
        let met = std::array::from_fn(|k| places[k] + leans[k] * drops[k] - foot);
        let share = share_in_square(met, target.half);
        if share > 0.0 {
            let solid = std::array::from_fn(|k| DVec3::new(places[k].x, heights[k], places[k].y));
            let passes = rays.iter().map(|ray| f64::from(ray.share)).sum::<f64>() / 3.0;
            let flux = share * passes * self.facing(solid);
            part.flux += flux;
            part.lean += (leans[0] + leans[1] + leans[2]) * (flux / 3.0);
            part.drop += (drops[0] + drops[1] + drops[2]) * (flux / 3.0);
        }
    }

    /// The area that a triangle of the surface turns to the source \[m²\]; 0 when it is turned away.
    fn facing(&self, corners: [DVec3; 3]) -> f64 {
        let [a, b, c] = corners;
        let area = 0.5 * (b - a).cross(c - a);
        let toward = match self.source {
            Source::At(lamp) => (lamp - (a + b + c) / 3.0).normalize_or_zero(),
            Source::Toward(toward) => toward,
            Source::Around | Source::Area(_) => DVec3::ZERO,
        };
        (area.dot(toward) * area.y.signum()).max(0.0)
    }
}

/// Sums over the triangles of a leaf, weighed by flux.
#[derive(Default)]
struct Part {
    flux: f64,
    lean: DVec2,
    drop: f64,
}

impl Part {
    fn beam(&self, target: &Target) -> Beam {
        let (lean, drop) = (self.lean / self.flux, self.drop / self.flux);
        let back = DVec3::new(-lean.x, target.down, -lean.y);
        let area = 4.0 * target.half * target.half;
        Beam { from: target.at + back * drop, toward: back.normalize(), level: self.flux / area }
    }
}

/// What the surface does to the source's light.
struct Turn {
    surface: Surface,
    source: Source,
    way: Way,
}

impl Turn {
    /// Whether light goes on downwards.
    fn is_down(&self) -> bool {
        self.way == Way::Refracted
    }

    /// The ray that leaves the surface at x, z.
    fn ray(&self, at: DVec2, waves: &Waves, footprint: Covariance) -> Ray {
        let facet = waves.facet(at, footprint);
        let point = DVec3::new(at.x, self.surface.level + facet.height, at.y);
        let toward = match self.source {
            Source::Toward(toward) => toward,
            Source::At(lamp) => (lamp - point).normalize_or_zero(),
            Source::Around | Source::Area(_) => DVec3::Y,
        };
        let (left, share) = self.leaves(toward, facet.normal());
        let lost = Ray { height: facet.height as f32, lean: [0.0; 2], share: -1.0 };
        let drop = if self.is_down() { -left.y } else { left.y };
        let steep_enough = drop * LEANEST > DVec2::new(left.x, left.z).length();
        if !steep_enough {
            return lost;
        }
        Ray { lean: [(left.x / drop) as f32, (left.z / drop) as f32], share: share as f32, ..lost }
    }

    /// Where light goes that comes from unit vector `toward`, and what share of it.
    fn leaves(&self, toward: DVec3, normal: DVec3) -> (DVec3, f64) {
        let n = self.surface.index;
        // What comes from behind a wave's crest does not arrive: `facing` has none of it.
        let cos = toward.dot(normal).clamp(0.0, 1.0);
        match self.way {
            Way::Refracted => match refract(-toward, normal, n) {
                Some(direction) => {
                    let inside = -direction.dot(normal);
                    (direction, transmitted(n, cos, inside))
                }
                None => (DVec3::ZERO, 0.0),
            },
            _ => (reflect(-toward, normal), fresnel(n, cos)),
        }
    }
}

/// The middle of three points.
fn middle([a, b, c]: [DVec2; 3]) -> DVec2 {
    (a + b + c) / 3.0
}
