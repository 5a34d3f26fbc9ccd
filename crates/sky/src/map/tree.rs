//! The mesh of one face: a tree of bisected triangles, and values between its points.

use glam::DVec2;
use light::Spectrum;

/// Marks a cell that is not cut.
pub(crate) const LEAF: u32 = u32::MAX;

/// One cell of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Node {
    /// [`LEAF`], or which corner the cut comes from (upper 2 bits) and the point it goes to, in the middle of the
    /// edge across from that corner.
    pub(crate) cut: u32,
    /// Where the second part's node is; the first part's is the next.
    pub(crate) second: u32,
}

/// Corner, 0 to 2, and middle point of a cut.
pub(crate) fn cut(apex: usize, middle: u32) -> u32 {
    (apex as u32) << 30 | middle
}

/// The reverse of [`cut`].
pub(crate) fn uncut(cut: u32) -> (usize, u32) {
    ((cut >> 30) as usize, cut & MOST_POINTS)
}

/// No mesh has more points than this.
pub(crate) const MOST_POINTS: u32 = (1 << 30) - 1;

/// Corners of the two parts of a cell that is cut from corner `apex` to the point `middle`.
pub(crate) fn parts<T: Copy>(corners: [T; 3], apex: usize, middle: T) -> [[T; 3]; 2] {
    let [a, b, c] = [apex, apex + 1, apex + 2].map(|k| corners[k % 3]);
    [[a, b, middle], [a, middle, c]]
}

/// Where the `count` points of a tree in preorder are (weights of the face's second and third corner), and the corners
/// of its cells that are not cut.
pub(crate) fn layout(nodes: &[Node], count: usize) -> (Vec<DVec2>, Vec<[u32; 3]>) {
    let mut points = vec![DVec2::ZERO; count];
    points[..3].copy_from_slice(&[DVec2::ZERO, DVec2::X, DVec2::Y]);
    let (mut cells, mut leaves) = (vec![[0, 1, 2]], Vec::new());
    for node in nodes {
        let Some(corners) = cells.pop() else { break };
        if node.cut == LEAF {
            leaves.push(corners);
            continue;
        }
        let (apex, middle) = uncut(node.cut);
        let [b, c] = [1, 2].map(|k| points[corners[(apex + k) % 3] as usize]);
        points[middle as usize] = (b + c) * 0.5;
        let [one, other] = parts(corners, apex, middle);
        cells.extend([other, one]);
    }
    (points, leaves)
}

/// The mesh of one side of a face with its values: shares of the open sky's irradiance, within \[0, 1\].
///
/// Every edge between two cells is the same for both, so that values have no step (eq. 4.24, for triangles).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FaceMap {
    /// The three corners first.
    pub(crate) values: Box<[Spectrum]>,
    /// In preorder.
    pub(crate) nodes: Box<[Node]>,
}

impl FaceMap {
    /// The value at the weights of the three corners (≥ 0, sum 1): linear within every cell.
    pub(crate) fn value(&self, weights: [f64; 3]) -> Spectrum {
        let (mut corners, mut weights, mut at) = ([0, 1, 2], weights, 0);
        while let Some(&Node { cut, second }) = self.nodes.get(at).filter(|node| node.cut != LEAF) {
            let (apex, middle) = uncut(cut);
            let [a, b, c] = [apex, apex + 1, apex + 2].map(|k| weights[k % 3]);
            let [one, other] = parts(corners, apex, middle);
            // With M = (B + C)/2:  b B + c C = (b − c) B + 2c M = 2b M + (c − b) C.
            (corners, weights, at) = if b >= c {
                (one, [a, b - c, 2.0 * c], at + 1)
            } else {
                (other, [a, 2.0 * b, c - b], second as usize)
            };
        }
        let mut sum = Spectrum::ZERO;
        for (corner, weight) in corners.into_iter().zip(weights) {
            sum = self.values[corner as usize].mul_add(Spectrum::splat(weight as f32), sum);
        }
        // The weights' rounding must not make more than there is.
        sum.map(|share| share.clamp(0.0, 1.0))
    }

    /// Every point's value and every cell's node \[bytes\].
    pub(crate) fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&*self.values) + size_of_val(&*self.nodes)
    }
}
