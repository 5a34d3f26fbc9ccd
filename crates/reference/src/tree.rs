//! Rays and triangles in f64: a hierarchy of boxes cut at medians, and Möller and Trumbore's test (1997).

use glam::DVec3;

/// Triangles in a leaf at most.
const LEAF: usize = 4;

/// By how much boxes are larger than what they hold, as a share of its coordinates: more than slabs are off by rounding.
const MARGIN: f64 = 1e-12;

/// A straight way: origin and unit direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
}

impl Line {
    pub(crate) fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }
}

/// Where a line meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Meeting {
    /// Distance along it \[m\], > 0.
    pub(crate) distance: f64,
    /// Which triangle.
    pub(crate) triangle: u32,
    /// Barycentric weights of the second and third corner.
    pub(crate) weights: [f64; 2],
}

/// A box, and what is in it: triangles `first..first + count` of the order, or, with a count of 0, the node after this one and node `first`.
struct Node {
    low: DVec3,
    high: DVec3,
    first: u32,
    count: u32,
}

/// Triangles made ready for lines.
pub(crate) struct Tree {
    triangles: Vec<[DVec3; 3]>,
    order: Vec<u32>,
    nodes: Vec<Node>,
}

impl Tree {
    pub(crate) fn new(triangles: Vec<[DVec3; 3]>) -> Self {
        let order = (0..triangles.len() as u32).collect();
        let mut tree = Self { triangles, order, nodes: Vec::new() };
        if !tree.order.is_empty() {
            tree.build(0, tree.order.len());
        }
        tree
    }

    /// How many triangles.
    pub(crate) fn len(&self) -> usize {
        self.triangles.len()
    }

    pub(crate) fn triangle(&self, index: u32) -> [DVec3; 3] {
        self.triangles[index as usize]
    }

    /// The corners of least and largest coordinates; none without triangles.
    pub(crate) fn bounds(&self) -> Option<(DVec3, DVec3)> {
        self.nodes.first().map(|node| (node.low, node.high))
    }

    fn build(&mut self, from: usize, to: usize) {
        let corners = || self.order[from..to].iter().flat_map(|&t| self.triangles[t as usize]);
        let low = corners().fold(DVec3::INFINITY, DVec3::min);
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        let margin = MARGIN * low.abs().max(high.abs()).max_element();
        let node = self.nodes.len();
        let [low, high] = [low - margin, high + margin];
        self.nodes.push(Node { low, high, first: from as u32, count: (to - from) as u32 });
        if to - from <= LEAF {
            return;
        }
        let size = high - low;
        let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
        let triangles = &self.triangles;
        let middle = |t: &u32| triangles[*t as usize].iter().map(|corner| corner[axis]).sum::<f64>();
        let half = (to - from) / 2;
        self.order[from..to].select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
        self.build(from, from + half);
        let second = self.nodes.len() as u32;
        self.build(from + half, to);
        (self.nodes[node].first, self.nodes[node].count) = (second, 0);
    }

    /// What a line meets first, before `length`.
    pub(crate) fn nearest(&self, line: &Line, length: f64) -> Option<Meeting> {
        if self.nodes.is_empty() {
            return None;
        }
        let inverse = line.direction.recip();
        let mut best: Option<Meeting> = None;
        let mut reach = length;
        let mut stack = vec![0u32];
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !enters(node, line, inverse, reach) {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.first, index + 1]);
                continue;
            }
            for &triangle in &self.order[node.first as usize..][..node.count as usize] {
                if let Some(meeting) = meet(&self.triangles[triangle as usize], triangle, line)
                    && (meeting.distance < reach
                        || best.is_some_and(|b| b.distance == meeting.distance && triangle < b.triangle))
                {
                    (reach, best) = (meeting.distance, Some(meeting));
                }
            }
        }
        best
    }
}

/// Whether a line meets a box within `reach`.
fn enters(node: &Node, line: &Line, inverse: DVec3, reach: f64) -> bool {
    let (a, b) = ((node.low - line.origin) * inverse, (node.high - line.origin) * inverse);
    let (mut enter, mut leave) = (0.0f64, reach);
    for axis in 0..3 {
        if line.direction[axis] == 0.0 {
            // It runs along the slab.
            if line.origin[axis] < node.low[axis] || line.origin[axis] > node.high[axis] {
                return false;
            }
            continue;
        }
        let (near, far) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
        enter = enter.max(near);
        leave = leave.min(far);
    }
    enter <= leave
}

fn meet(corners: &[DVec3; 3], triangle: u32, line: &Line) -> Option<Meeting> {
    let [a, b, c] = *corners;
    let (e1, e2) = (b - a, c - a);
    let p = line.direction.cross(e2);
    let determinant = e1.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let s = line.origin - a;
    let u = s.dot(p) / determinant;
    let q = s.cross(e1);
    let v = line.direction.dot(q) / determinant;
    let distance = e2.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(Meeting {
        distance,
        triangle,
        weights: [u, v],
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn point() -> impl Strategy<Value = DVec3> {
        prop_oneof![
            (-3.0..3.0f64, -3.0..3.0f64, -3.0..3.0f64).prop_map(|(x, y, z)| DVec3::new(x, y, z)),
            // Shared edges, corners and axis-parallel lines.
            (-2i32..=2, -2i32..=2, -2i32..=2).prop_map(|(x, y, z)| DVec3::new(x.into(), y.into(), z.into())),
        ]
    }

    proptest! {
        #[test]
        fn it_meets_what_trying_all_meets(
            triangles in prop::collection::vec([point(), point(), point()], 0..60),
            lines in prop::collection::vec((point(), point()), 20),
        ) {
            let tree = Tree::new(triangles.clone());
            for (origin, to) in lines {
                let Some(direction) = (to - origin).try_normalize() else { continue };
                let line = Line { origin, direction };
                let all = triangles.iter().enumerate().filter_map(|(i, t)| meet(t, i as u32, &line));
                let first = all.map(|meeting| meeting.distance).reduce(f64::min);
                let found = tree.nearest(&line, f64::INFINITY).map(|meeting| meeting.distance);
                prop_assert_eq!(found, first);
            }
        }
    }
}
