//! Conifers: one stem, whorls of branches, branchlets on both sides.

use std::f32::consts::TAU;

use glam::Vec3;

use super::{Dice, Growth, Node};

pub(super) fn skeleton(growth: &Growth, dice: &mut Dice) -> Vec<Node> {
    let height = growth.height;
    let foot = 0.014 * height;
    let mut nodes = vec![Node { position: Vec3::ZERO, parent: None, radius: foot }];
    let whorl = (height / 46.0).max(0.12);
    let (mut at, mut stem) = (0.0, 0);
    while at < height {
        at = (at + whorl * dice.between(0.8, 1.2)).min(height);
        let aside = dice.ball() * Vec3::new(1.0, 0.0, 1.0) * (0.003 * height);
        let radius = foot * (1.0 - at / height) + 0.004;
        nodes.push(Node { position: Vec3::Y * at + aside, parent: Some(stem), radius });
        stem = nodes.len() as u32 - 1;
        if at >= growth.clear && at < 0.985 * height {
            let count = 5 + (dice.share() * 4.0) as u32;
            let turn = dice.share() * TAU;
            for i in 0..count {
                let azimuth = turn + TAU * (i as f32 + dice.between(-0.25, 0.25)) / count as f32;
                branch(growth, &mut nodes, stem, azimuth, dice);
            }
        }
    }
    nodes
}

/// One branch from joint `stem`: lower ones hang and lift their tips, upper ones rise.
fn branch(growth: &Growth, nodes: &mut Vec<Node>, stem: u32, azimuth: f32, dice: &mut Dice) {
    let base = nodes[stem as usize].position;
    let up = ((base.y - growth.clear) / (growth.height - growth.clear)).clamp(0.0, 1.0);
    // A cone with a slightly bulging side, drawn in at the very bottom.
    let full = growth.spread * (1.0 - up).powf(0.85) * (0.75 + 0.25 * (up * 8.0).min(1.0));
    let length = full * dice.between(0.68, 1.1);
    let out = Vec3::new(azimuth.cos(), 0.0, azimuth.sin());
    let start = -0.22 + 0.75 * up;
    let joints = (length / (0.022 * growth.height).max(0.08)).ceil().clamp(3.0, 16.0) as u32;
    let step = length / joints as f32;
    let thick = 0.0045 * length + 0.003;
    let (mut parent, mut position) = (stem, base);
    for i in 0..joints {
        let share = (i as f32 + 0.5) / joints as f32;
        let tilt = start - 0.25 * (share * TAU * 0.5).sin() * (1.0 - up) + 0.3 * share * share;
        position += (out + Vec3::Y * tilt + dice.ball() * 0.07).normalize_or(out) * step;
        nodes.push(Node { position, parent: Some(parent), radius: thick * (1.0 - share) + 0.002 });
        parent = nodes.len() as u32 - 1;
        let longest = 0.5 * length * (1.0 - 0.7 * share) * (0.35 + share).min(1.0);
        branchlets(nodes, parent, out, longest, dice);
    }
}

/// One on each side of a joint, forward and hanging a little.
fn branchlets(nodes: &mut Vec<Node>, joint: u32, out: Vec3, longest: f32, dice: &mut Dice) {
    let across = Vec3::new(-out.z, 0.0, out.x);
    for side in [-1.0, 1.0] {
        let way = out * dice.between(0.5, 0.9) + across * side + Vec3::Y * dice.between(-0.5, 0.05);
        let tip = nodes[joint as usize].position + way.normalize_or(out) * longest * dice.between(0.7, 1.1);
        nodes.push(Node { position: tip, parent: Some(joint), radius: 0.0015 });
    }
}
