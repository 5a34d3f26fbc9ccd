//! Makes the mesh of a face: fine where values bend, coarse where they do not.

use std::collections::HashMap;

use glam::DVec2;
use light::{Spectrum, Triangle};

use super::Settings;
use super::tree::{FaceMap, LEAF, MOST_POINTS, Node, cut, parts};

/// Halvings of an edge for its length alone: 64 pieces.
const BASE_HALVINGS: u8 = 6;
/// Halvings of an edge in all: 4096 pieces.
const MOST_HALVINGS: u8 = 12;

/// An edge of a cell.
#[derive(Clone, Copy)]
struct Edge {
    /// \[m\]
    length: f64,
    /// How often halving has led here.
    halvings: u8,
    /// Whether what it is half of, or lies across, was seen to bend.
    suspect: bool,
    middle: Middle,
}

#[derive(Clone, Copy)]
enum Middle {
    Unknown,
    /// The edge stays whole.
    None,
    /// The point in the middle, and whether the value bends there by more than is allowed.
    At(u32, bool),
}

/// Makes the mesh of a face with corners `world`; `value` tells what to store at weights of its second and third
/// corner.
///
/// *Which edges are halved* is decided by each edge alone: those that are longer than `coarse`, and as long as
/// the halves are not below `least`, those whose parent's middle is more than `tolerance` off the mean of its
/// ends. Every face's own edges are suspect. Of an edge that two faces share both have the same length and values,
/// hence the same halves, and no crack.
///
/// *Cells* are cut along their longest halved edge until none of their edges is; a cut is suspect when an edge of
/// the cell bends. No value is found out in vain: what was asked to decide is kept.
pub(crate) fn refine(
    world: &Triangle,
    settings: &Settings,
    value: &mut dyn FnMut(DVec2) -> Spectrum,
) -> FaceMap {
    let points = vec![DVec2::ZERO, DVec2::X, DVec2::Y];
    let values = points.iter().map(|&at| value(at)).collect();
    let mut refine =
        Refine { world, settings, value, points, values, edges: HashMap::new(), nodes: Vec::new() };
    for [a, b] in [[0, 1], [1, 2], [2, 0]] {
        let length = world.0[a as usize].distance(world.0[b as usize]);
        refine.add([a, b], length, 0, true);
    }
    refine.cell([0, 1, 2]);
    FaceMap { values: refine.values.into(), nodes: refine.nodes.into() }
}

struct Refine<'a> {
    world: &'a Triangle,
    settings: &'a Settings,
    value: &'a mut dyn FnMut(DVec2) -> Spectrum,
    /// Weights of the second and third corner.
    points: Vec<DVec2>,
    values: Vec<Spectrum>,
    edges: HashMap<[u32; 2], Edge>,
    nodes: Vec<Node>,
}

fn key([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

impl Refine<'_> {
    fn add(&mut self, ends: [u32; 2], length: f64, halvings: u8, suspect: bool) {
        self.edges.entry(key(ends)).or_insert(Edge { length, halvings, suspect, middle: Middle::Unknown });
    }

    /// Cuts a cell as far as needed. No deeper than the halvings of its three edges allow, some 40 calls.
    fn cell(&mut self, corners: [u32; 3]) {
        let sides = [0, 1, 2].map(|k| [corners[k], corners[(k + 1) % 3]]);
        let edges = sides.map(|side| self.settled(side));
        let halved = |k: usize| match edges[k].middle {
            Middle::At(middle, _) => Some((k, middle)),
            _ => None,
        };
        let longest = (0..3)
            .filter_map(halved)
            .reduce(|best, next| if edges[next.0].length > edges[best.0].length { next } else { best });
        let here = self.nodes.len();
        self.nodes.push(Node { cut: LEAF, second: 0 });
        let Some((k, middle)) = longest else { return };

        let apex = (k + 2) % 3;
        let ends = [corners[apex], middle];
        let bends = edges.iter().any(|edge| matches!(edge.middle, Middle::At(_, true)));
        let length = self.length(ends);
        self.add(ends, length, edges[k].halvings + 1, bends);
        let [one, other] = parts(corners, apex, middle);
        self.cell(one);
        self.nodes[here] = Node { cut: cut(apex, middle), second: self.nodes.len() as u32 };
        self.cell(other);
    }

    /// The edge between two points, its middle known.
    fn settled(&mut self, ends: [u32; 2]) -> Edge {
        let key = key(ends);
        let mut edge = self.edges[&key];
        if matches!(edge.middle, Middle::Unknown) {
            edge.middle = self.middle(key, &edge);
            self.edges.insert(key, edge);
        }
        edge
    }

    fn middle(&mut self, ends: [u32; 2], edge: &Edge) -> Middle {
        let Settings { coarse, least, tolerance, .. } = *self.settings;
        let long = edge.length > f64::from(coarse) && edge.halvings < BASE_HALVINGS;
        let fine = edge.length >= 2.0 * f64::from(least) && edge.halvings < MOST_HALVINGS;
        if !(long || (edge.suspect && fine)) || self.points.len() as u32 >= MOST_POINTS {
            return Middle::None;
        }
        let [a, b] = ends.map(|end| end as usize);
        let at = (self.points[a] + self.points[b]) * 0.5;
        let value = (self.value)(at);
        let off = value - (self.values[a] + self.values[b]) * 0.5;
        let bends = off.map(f32::abs).max() > tolerance;
        let middle = self.points.len() as u32;
        self.points.push(at);
        self.values.push(value);
        for end in ends {
            self.add([end, middle], 0.5 * edge.length, edge.halvings + 1, bends);
        }
        Middle::At(middle, bends)
    }

    fn length(&self, ends: [u32; 2]) -> f64 {
        let [a, b] = ends.map(|end| self.points[end as usize]);
        let [p, q, r] = self.world.0;
        let way = b - a;
        ((q - p) * way.x + (r - p) * way.y).length()
    }
}
