//! Leaves on twigs, needles on branches.

use glam::Vec3;
use light::Mesh;

use super::{Dice, Growth, Node};
use crate::envelope::Envelope;

/// Leaves on a twig.
const ON_TWIG: u32 = 9;

/// Branches no thicker than this, in a tree 10 m high, bear twigs \[m\].
const TWIGGY: f32 = 0.016;

/// Leaves as folded diamonds of two triangles each.
#[derive(Default)]
pub(super) struct Foliage {
    pub(super) mesh: Mesh,
}

impl Foliage {
    /// Twigs on all thin branches, as evenly as their lengths, with leaves on both sides; twigs become joints.
    pub(super) fn twigs(
        &mut self,
        growth: &Growth,
        envelope: &Envelope,
        nodes: &mut Vec<Node>,
        dice: &mut Dice,
    ) {
        let size = (growth.height / 10.0).sqrt();
        let thin: Vec<u32> = (0..nodes.len() as u32)
            .filter(|i| {
                let node = &nodes[*i as usize];
                node.parent.is_some() && node.radius < TWIGGY * size && node.position.y > growth.clear
            })
            .collect();
        if thin.is_empty() {
            return;
        }
        let [low, high] = envelope.heights();
        let heart = Vec3::Y * (low + 0.4 * (high - low));
        let count = growth.leaves.div_ceil(ON_TWIG);
        for i in 0..count {
            // Evenly through the list, which is in the order of growth.
            let pick = ((u64::from(i) * thin.len() as u64) / u64::from(count)) as usize;
            let joint = thin[pick];
            let node = nodes[joint as usize];
            let below = nodes[node.parent.unwrap_or(0) as usize].position;
            let base = node.position.lerp(below, dice.share());
            let along = (node.position - below).normalize_or(Vec3::Y);
            let outward = (base - heart).normalize_or(Vec3::Y);
            let way = along * 0.5 + outward * 0.5 + dice.direction() * 0.9 + Vec3::Y * 0.15;
            let length = dice.between(0.22, 0.45) * size;
            let tip = base + way.normalize_or(along) * length;
            nodes.push(Node { position: tip, parent: Some(joint), radius: 0.0018 });
            self.twig(growth, [base, tip], outward, dice);
        }
    }

    fn twig(&mut self, growth: &Growth, [base, tip]: [Vec3; 2], outward: Vec3, dice: &mut Dice) {
        let along = (tip - base).normalize_or(Vec3::Y);
        // Leaves turn their faces up and outward, to the light, more or less.
        let face = (Vec3::Y + outward * 0.6 + dice.ball() * 0.7).normalize_or(Vec3::Y);
        let side = along.cross(face).normalize_or(Vec3::X);
        let shade = dice.between(0.85, 1.15);
        for i in 0..ON_TWIG {
            let share = (i as f32 + 1.0) / ON_TWIG as f32;
            let hand = if i % 2 == 0 { 1.0 } else { -1.0 };
            let end = i + 1 == ON_TWIG;
            let aside = if end { 0.2 } else { hand };
            let way = along * 0.6 + side * aside + Vec3::NEG_Y * 0.25 + dice.ball() * 0.45;
            let way = way.normalize_or(along);
            let normal = (face + dice.ball() * 0.75).normalize_or(face);
            let length = growth.leaf * dice.between(0.75, 1.2);
            self.leaf(base.lerp(tip, share), way, normal, [length, 0.62 * length], shade, dice);
        }
    }

    /// Tufts along all thin wood, as many as asked for, pointing forward and to all sides.
    pub(super) fn needles(&mut self, growth: &Growth, nodes: &[Node], dice: &mut Dice) {
        let bearing = |node: &Node| node.parent.is_some() && node.radius < 0.012;
        let length = |node: &Node| {
            node.parent.map_or(0.0, |parent| node.position.distance(nodes[parent as usize].position))
        };
        let total: f32 = nodes.iter().filter(|node| bearing(node)).map(length).sum();
        let spacing = total / growth.leaves.max(1) as f32;
        let mut left = 0.0;
        for node in nodes.iter().filter(|node| bearing(node)) {
            let Some(parent) = node.parent else { continue };
            let below = nodes[parent as usize].position;
            let (long, along) = (length(node), (node.position - below).normalize_or(Vec3::Y));
            let shade = dice.between(0.85, 1.15);
            while left < long {
                let around = (dice.direction() + Vec3::Y * 0.2).reject_from(along).normalize_or(Vec3::Y);
                let way = (along * dice.between(0.7, 1.3) + around).normalize_or(along);
                let normal = dice.direction().reject_from(way).normalize_or(Vec3::Y);
                let tuft = growth.leaf * dice.between(0.75, 1.2);
                self.leaf(below + along * left, way, normal, [tuft, 0.4 * tuft], shade, dice);
                left += spacing;
            }
            left -= long;
        }
    }

    /// A leaf from its stalk along `way`, [long, wide] \[m\], folded a little along its rib, `normal` about on its upper side.
    fn leaf(
        &mut self,
        stalk: Vec3,
        way: Vec3,
        normal: Vec3,
        [long, wide]: [f32; 2],
        shade: f32,
        dice: &mut Dice,
    ) {
        let side = way.cross(normal).try_normalize().unwrap_or_else(|| way.any_orthonormal_vector());
        let up = side.cross(way);
        let middle = stalk + way * (0.45 * long) + up * (0.12 * wide);
        let first = self.mesh.positions.len() as u32;
        let corners = [stalk, middle + side * (0.5 * wide), stalk + way * long, middle - side * (0.5 * wide)];
        self.mesh.positions.extend(corners);
        // Lighter leaves are also a little yellower.
        let tint = shade * dice.between(0.85, 1.15);
        let colour = Vec3::new(tint * tint.sqrt(), tint, tint * 0.9);
        self.mesh.colours.extend([colour; 4]);
        self.mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
}
