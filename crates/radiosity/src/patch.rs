//! Patches: the faces of a scene cut into pieces that are lit evenly.

use glam::DVec3;
use light::{Geometry, Place, Spectrum};

use crate::tree::{Node, Tree, common};
use crate::triangle::{self, Corners};

/// One of the two sides of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// The one it is wound for (of a mirrored placement: the one it would be wound for without the mirror).
    Front,
    /// The other.
    Back,
}

/// A piece of one side of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Instance and triangle of the geometry.
    pub face: [u32; 2],
    /// Which side.
    pub side: Side,
    /// Counter-clockwise seen from the side that is meant \[m\].
    pub corners: [DVec3; 3],
}

impl Patch {
    /// \[m²\]
    pub fn area(&self) -> f64 {
        0.5 * triangle::cross(&self.corners).length()
    }

    /// Centre of gravity \[m\].
    pub fn centre(&self) -> DVec3 {
        triangle::centre(&self.corners)
    }

    /// Unit normal on the side that is meant.
    pub fn normal(&self) -> DVec3 {
        triangle::cross(&self.corners).normalize_or_zero()
    }

    /// The place in its middle, where light is asked for.
    pub fn place(&self, seed: u32) -> Place {
        place(self.centre(), self.normal(), reach(&self.corners), seed)
    }
}

/// Largest coordinate \[m\].
pub(crate) fn reach(corners: &Corners) -> f64 {
    corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max)
}

/// A place on a face whose coordinates are at most `reach` \[m\]: off by ½ ulp a coordinate, and by as much again where others
/// round the corners (as [`Geometry::hit`] has it).
pub(crate) fn place(at: DVec3, normal: DVec3, reach: f64, seed: u32) -> Place {
    let error = 4.0 * light::rounding::UNIT * reach as f32;
    Place { position: at.as_vec3(), error, normal: normal.as_vec3(), seed }
}

/// Which sides of faces take part, and what they reflect.
pub trait Surfaces: Sync {
    /// Whether this side of face \[instance, triangle\] takes part at all; the inside of a solid need not.
    fn takes_part(&self, face: [u32; 2], side: Side) -> bool {
        let _ = (face, side);
        true
    }

    /// Diffuse reflectance of a patch per band; brought to within \[0, 1\].
    fn reflectance(&self, patch: &Patch) -> Spectrum;

    /// Which part of space the patch is lit in, such as air or water: from one part to another light on a face does not go on
    /// smoothly. Between part 0 and part k + 1 there may be [`Passage`](crate::Passage) number k.
    fn part(&self, patch: &Patch) -> u32 {
        let _ = patch;
        0
    }
}

/// Everything takes part.
impl<F: Fn(&Patch) -> Spectrum + Sync> Surfaces for F {
    fn reflectance(&self, patch: &Patch) -> Spectrum {
        self(patch)
    }
}

/// How finely faces are cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// Edges of patches are no longer \[m\], unless that makes too many.
    pub edge: f64,
    /// No more patches than this of faces that are cut: `edge` grows until they fit. One for every side that stays whole comes on top,
    /// so that many small things never leave large faces uncut. A patch takes about 450 bytes, and its links some kilobytes (see
    /// [`crate::Links`]).
    pub most: usize,
}

impl Default for Cut {
    /// As fine as the light in a furnished room needs it.
    fn default() -> Self {
        Self { edge: 0.5, most: 200_000 }
    }
}

/// The faces of a scene cut into patches, with a tree over them.
///
/// *Halving.* A triangle with an edge longer than allowed is cut from its longest edge's middle to the corner across. Whether an
/// edge is halved depends on its length alone: faces that share an edge share its points, and there are no cracks.
///
/// *Order.* By face, front before back, half by half: the same for the same geometry and settings. Faces without an area, or with
/// numbers that are not finite, have no patches.
pub struct Patches {
    pub(crate) tree: Tree,
    /// By patch: its node.
    pub(crate) leaves: Vec<u32>,
    /// By node: its patch, or none.
    pub(crate) patch_of: Vec<u32>,
    reflectances: Vec<Spectrum>,
    /// By patch, as [`Surfaces::part`].
    pub(crate) parts: Vec<u32>,
    /// By triangle of all placements, front and back: its node, or none.
    roots: Vec<[u32; 2]>,
    /// Triangles of all placements before each.
    before: Vec<usize>,
    owners: Vec<([u32; 2], Side)>,
    edge: f64,
}

/// No node, no patch.
pub(crate) const NONE: u32 = u32::MAX;

impl Patches {
    /// Cuts all faces of `geometry`.
    pub fn new(geometry: &Geometry, surfaces: &dyn Surfaces, cut: &Cut) -> Self {
        let mut before = vec![0];
        let mut sides = Vec::new();
        for (i, instance) in geometry.instances.iter().enumerate() {
            let count = geometry.meshes[instance.mesh as usize].triangles.len();
            before.push(before[i] + count);
            let flipped = instance.world_from_mesh.matrix3.determinant() < 0.0;
            for face in (0..count as u32).map(|triangle| [i as u32, triangle]) {
                let [a, b, c] = geometry.triangle(face[0], face[1]).0;
                for side in [Side::Front, Side::Back] {
                    let wound = (side == Side::Front) != flipped;
                    let corners = if wound { [a, b, c] } else { [a, c, b] };
                    if has_area(&corners) && surfaces.takes_part(face, side) {
                        sides.push((face, side, corners));
                    }
                }
            }
        }
        let edge = fitting(&sides, cut);
        let faces = sides
            .iter()
            .map(|&(face, side, corners)| {
                let mut nodes = halved(corners, edge);
                part(&mut nodes, &|corners| surfaces.part(&Patch { face, side, corners }));
                nodes
            })
            .collect();
        let (tree, starts) = Tree::new(faces);
        let total = before[before.len() - 1];
        let mut roots = vec![[NONE; 2]; total];
        let mut patches = Self {
            leaves: Vec::new(),
            patch_of: vec![NONE; tree.nodes.len()],
            reflectances: Vec::new(),
            parts: Vec::new(),
            owners: Vec::new(),
            roots: Vec::new(),
            before,
            tree,
            edge,
        };
        for (k, (face, side, _)) in sides.iter().enumerate() {
            roots[patches.before[face[0] as usize] + face[1] as usize][*side as usize] = starts[k];
            let end = starts.get(k + 1).map_or(patches.tree.nodes.len(), |&end| end as usize);
            for node in starts[k] as usize..end {
                if patches.tree.nodes[node].children.is_none() {
                    patches.patch_of[node] = patches.leaves.len() as u32;
                    patches.leaves.push(node as u32);
                    patches.owners.push((*face, *side));
                }
            }
        }
        patches.roots = roots;
        patches.reflectances = patches.iter().map(|patch| share(surfaces.reflectance(&patch))).collect();
        patches.parts = (0..patches.len()).map(|index| patches.node(index).part).collect();
        patches
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.leaves.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.leaves.is_empty()
    }

    /// Patch `index`, below [`Self::len`].
    pub fn patch(&self, index: usize) -> Patch {
        let (face, side) = self.owners[index];
        Patch { face, side, corners: self.node(index).corners }
    }

    /// All of them in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Patch> + '_ {
        (0..self.len()).map(|index| self.patch(index))
    }

    /// Diffuse reflectance of a patch, within \[0, 1\] per band.
    pub fn reflectance(&self, index: usize) -> Spectrum {
        self.reflectances[index]
    }

    /// The longest edge that was allowed in the end \[m\]: [`Cut::edge`], or what [`Cut::most`] made of it.
    pub fn edge(&self) -> f64 {
        self.edge
    }

    /// Sum of `values` (per patch, per m²) over all patches' areas.
    pub fn integral(&self, values: &[Spectrum]) -> [f64; light::bands::BANDS] {
        let mut sums = [0.0; light::bands::BANDS];
        for (index, value) in values.iter().enumerate().take(self.len()) {
            let area = self.node(index).area;
            for (sum, band) in sums.iter_mut().zip(value.0) {
                *sum += area * f64::from(band);
            }
        }
        sums
    }

    pub(crate) fn node(&self, patch: usize) -> &Node {
        &self.tree.nodes[self.leaves[patch] as usize]
    }

    /// The side of a face that `normal` is on.
    pub(crate) fn side(&self, face: [u32; 2], normal: DVec3) -> Option<Side> {
        let first = *self.before.get(face[0] as usize)?;
        let roots = *self.roots.get(first + face[1] as usize)?;
        let along = |root: u32| self.tree.nodes.get(root as usize).map(|node| node.normal.dot(normal) >= 0.0);
        let front = along(roots[0]).or_else(|| along(roots[1]).map(|back| !back))?;
        Some(if front { Side::Front } else { Side::Back })
    }

    /// The patch that `at` (a point of the face, or near it) is on, and the weights of its corners there; none where that side
    /// of the face takes no part.
    pub(crate) fn locate(&self, face: [u32; 2], side: Side, at: DVec3) -> Option<(usize, [f64; 3])> {
        let first = *self.before.get(face[0] as usize)?;
        let index = first + face[1] as usize;
        if index >= *self.before.get(face[0] as usize + 1)? {
            return None;
        }
        let root = self.roots[index][side as usize];
        let mut node = self.tree.nodes.get(root as usize)?;
        let mut number = root;
        let mut weights = weights(&node.corners, at)?;
        while let Some(children) = node.children {
            let apex = usize::from(node.apex);
            let [a, b, c] = [0, 1, 2].map(|k| weights[(apex + k) % 3]);
            // The middle of the edge takes twice the smaller weight of its ends.
            let second = usize::from(c > b);
            weights = if second == 0 { [a, b - c, 2.0 * c] } else { [a, 2.0 * b, c - b] };
            number = children[second];
            node = &self.tree.nodes[number as usize];
        }
        Some((self.patch_of[number as usize] as usize, weights))
    }
}

/// Within \[0, 1\], and 0 in place of what is no number.
fn share(reflectance: Spectrum) -> Spectrum {
    reflectance.map(|band| if band > 0.0 { band.min(1.0) } else { 0.0 })
}

/// Weights of the corners at a point, brought inside.
pub(crate) fn weights(corners: &Corners, at: DVec3) -> Option<[f64; 3]> {
    let cross = triangle::cross(corners);
    let [a, b, c] = *corners;
    let p = at - a;
    let v = p.cross(c - a).dot(cross) / cross.length_squared();
    let w = (b - a).cross(p).dot(cross) / cross.length_squared();
    if !(v + w).is_finite() {
        return None;
    }
    let v = v.clamp(0.0, 1.0);
    let w = w.clamp(0.0, 1.0 - v);
    Some([1.0 - v - w, v, w])
}

/// Whether a face is higher than what its corners' f32 coordinates may be off by: below that its normal means nothing.
fn has_area(corners: &Corners) -> bool {
    let longest = (0..3).map(|k| corners[k].distance(corners[(k + 1) % 3])).fold(0.0, f64::max);
    let height = triangle::cross(corners).length() / longest;
    height.is_finite() && height > 4.0 * f64::from(light::rounding::UNIT) * reach(corners)
}

fn is_long(corners: &Corners, edge: f64) -> bool {
    (0..3).any(|k| corners[k].distance_squared(corners[(k + 1) % 3]) > edge * edge)
}

/// The edge length with which there are no more patches than allowed.
fn fitting(sides: &[([u32; 2], Side, Corners)], cut: &Cut) -> f64 {
    let corners = || sides.iter().map(|side| &side.2);
    let longest = 2.0 * corners().map(triangle::radius).fold(0.0, f64::max);
    // Not below 2⁻¹⁶ of the largest face: that alone would be 10⁹ patches.
    let mut edge = if cut.edge.is_finite() { cut.edge.max(longest / 65_536.0) } else { longest };
    loop {
        let mut left = cut.most;
        let mut cut = corners().filter(|corners| is_long(corners, edge));
        if cut.all(|corners| fits(corners, edge, &mut left)) || edge > longest {
            return edge;
        }
        edge *= std::f64::consts::SQRT_2;
    }
}

/// Takes the patches of a triangle off what is left; false when that is not enough.
fn fits(corners: &Corners, edge: f64, left: &mut usize) -> bool {
    if is_long(corners, edge) {
        return triangle::halves(corners, triangle::apex(corners)).iter().all(|half| fits(half, edge, left));
    }
    let enough = *left > 0;
    *left = left.saturating_sub(1);
    enough
}

/// Writes down which part of space the nodes of a face are in.
fn part(nodes: &mut [Node], of: &dyn Fn(Corners) -> u32) {
    for k in (0..nodes.len()).rev() {
        nodes[k].part = match nodes[k].children {
            Some(children) => common(children.map(|child| nodes[child as usize].part)),
            None => of(nodes[k].corners),
        };
    }
}

/// The tree of one face: every node before its children.
fn halved(corners: Corners, edge: f64) -> Vec<Node> {
    fn add(nodes: &mut Vec<Node>, corners: Corners, edge: f64) -> u32 {
        let mine = nodes.len();
        nodes.push(Node::piece(corners));
        if is_long(&corners, edge) {
            let children = triangle::halves(&corners, usize::from(nodes[mine].apex));
            nodes[mine].children = Some(children.map(|half| add(nodes, half, edge)));
        }
        mine as u32
    }
    let mut nodes = Vec::new();
    add(&mut nodes, corners, edge);
    nodes
}
