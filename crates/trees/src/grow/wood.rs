//! Round wood around a skeleton.

use std::f32::consts::TAU;

use glam::Vec3;
use light::Mesh;

use super::Node;

/// Corners around a branch of a radius \[m\].
fn sides(radius: f32) -> u32 {
    match radius {
        r if r > 0.06 => 10,
        r if r > 0.02 => 6,
        r if r > 0.008 => 4,
        _ => 3,
    }
}

/// A tube for every joint from its parent to it, thicker at the trunk's foot.
pub(super) fn mesh(nodes: &[Node]) -> Mesh {
    let mut mesh = Mesh::default();
    let foot = nodes.first().map_or(0.0, |node| node.radius);
    let flared = |node: &Node| {
        // Roots: half as wide again, gone at a height of three radii.
        let flare = 0.5 * (-node.position.y / (1.5 * foot).max(1e-6)).exp();
        node.radius * (1.0 + if node.radius > 0.5 * foot { flare } else { 0.0 })
    };
    let continued = continuations(nodes);
    for (i, node) in nodes.iter().enumerate() {
        let Some(parent) = node.parent else { continue };
        let below = &nodes[parent as usize];
        let Some(axis) = (node.position - below.position).try_normalize() else { continue };
        let main = continued[parent as usize] == Some(i as u32);
        // A side branch begins in the middle of what bears it, hardly thicker than itself.
        let from = if main { flared(below).min(1.6 * flared(node)) } else { flared(node) * 1.15 };
        let start = if main { bend(nodes, parent, axis) } else { axis };
        let end = continued[i].map_or(axis, |next| {
            (axis + (nodes[next as usize].position - node.position).normalize_or(axis)).normalize_or(axis)
        });
        tube(&mut mesh, [below.position, node.position], [start, end], [from, flared(node)], sides(from));
    }
    mesh
}

/// The thickest child of each joint: what goes on.
fn continuations(nodes: &[Node]) -> Vec<Option<u32>> {
    let mut next: Vec<Option<u32>> = vec![None; nodes.len()];
    for (i, node) in nodes.iter().enumerate() {
        if let Some(parent) = node.parent {
            let best = &mut next[parent as usize];
            if best.is_none_or(|other| nodes[other as usize].radius < node.radius) {
                *best = Some(i as u32);
            }
        }
    }
    next
}

/// Direction of the ring where a joint goes on along `axis`: between what comes and what goes.
fn bend(nodes: &[Node], joint: u32, axis: Vec3) -> Vec3 {
    let node = &nodes[joint as usize];
    let before = node
        .parent
        .map_or(axis, |parent| (node.position - nodes[parent as usize].position).normalize_or(axis));
    (before + axis).normalize_or(axis)
}

fn tube(mesh: &mut Mesh, ends: [Vec3; 2], axes: [Vec3; 2], radii: [f32; 2], sides: u32) {
    let first = mesh.positions.len() as u32;
    for ring in 0..2 {
        let (x, y) = axes[ring].any_orthonormal_pair();
        // Frames that turn little from ring to ring: both from one fixed direction.
        let x = (Vec3::X - axes[ring] * axes[ring].x).try_normalize().unwrap_or(x);
        let y = if axes[ring].x.abs() > 0.999 { y } else { axes[ring].cross(x) };
        for i in 0..sides {
            let (sin, cos) = (TAU * i as f32 / sides as f32).sin_cos();
            let out = x * cos + y * sin;
            mesh.positions.push(ends[ring] + out * radii[ring]);
            mesh.normals.push(out);
        }
    }
    for i in 0..sides {
        let next = (i + 1) % sides;
        let [a, b, c, d] = [i, next, sides + i, sides + next].map(|k| first + k);
        mesh.triangles.extend([[a, b, d], [a, d, c]]);
    }
}
