//! Branches that grow towards free space (Runions, Lane & Prusinkiewicz 2007, "Modeling trees with a space colonization
//! algorithm").

use glam::Vec3;

use super::{Dice, Form, Growth, Node, thicken};
use crate::envelope::Envelope;

/// What distinguishes the forms.
struct Habit {
    /// Free places for branches to grow to.
    places: usize,
    /// Of them in clusters, a share: foliage in masses with gaps between.
    clustered: f32,
    /// Upward pull on every step, beside the unit pull of free places.
    rise: f32,
    /// Height at which the first branch leaves the stem and how far the stem goes on, as shares of the height.
    stem: f32,
}

fn habit(form: Form) -> Habit {
    match form {
        Form::Vase => Habit { places: 1300, clustered: 0.7, rise: 0.3, stem: 0.24 },
        Form::Columnar => Habit { places: 1500, clustered: 0.2, rise: 0.8, stem: 0.92 },
        Form::Spreading | Form::Conifer => Habit { places: 1500, clustered: 0.65, rise: 0.12, stem: 0.5 },
    }
}

/// Growth stops after so many rounds.
const ROUNDS: usize = 400;

/// Branches from one joint, at most: a place that a steep habit cannot reach pulls in vain.
const SPROUTS: u8 = 3;

/// The most joints.
const MOST: usize = 20_000;

/// Free places, the nearest joint of each, and how far it is.
struct Place {
    at: Vec3,
    nearest: u32,
    distance: f32,
}

pub(super) fn skeleton(growth: &Growth, envelope: &Envelope, dice: &mut Dice) -> Vec<Node> {
    let habit = habit(growth.form);
    let step = growth.height / 70.0;
    let mut nodes = stem(growth, habit.stem, step, dice);
    let mut places: Vec<Place> = free_places(&habit, envelope, dice)
        .into_iter()
        .map(|at| Place { at, nearest: 0, distance: f32::INFINITY })
        .collect();
    let (mut known, mut sprouts) = (0, Vec::new());
    for _ in 0..ROUNDS {
        look(&mut places, &nodes, &mut known, 1.8 * step);
        let pulls = pulls(&places, &nodes);
        let before = nodes.len();
        sprouts.resize(before, 0);
        for (parent, pull) in pulls.into_iter().enumerate() {
            let Some(pull) = pull.try_normalize() else { continue };
            // Branches do not leave the stem below the crown.
            if nodes[parent].position.y < growth.clear || sprouts[parent] == SPROUTS || nodes.len() >= MOST {
                continue;
            }
            sprouts[parent] += 1;
            let way = pull + Vec3::Y * habit.rise + dice.ball() * 0.35;
            let Some(way) = way.try_normalize() else { continue };
            nodes.push(Node {
                position: nodes[parent].position + way * step,
                parent: Some(parent as u32),
                radius: 0.0,
            });
        }
        if nodes.len() == before {
            break;
        }
    }
    thicken(&mut nodes, 0.005 * (growth.height / 10.0).sqrt(), 2.2);
    nodes
}

/// The trunk, up to `share` of the height, a little crooked.
fn stem(growth: &Growth, share: f32, step: f32, dice: &mut Dice) -> Vec<Node> {
    let mut nodes = vec![Node { position: Vec3::ZERO, parent: None, radius: 0.0 }];
    let mut way = Vec3::Y;
    let top = (share * growth.height).max(growth.clear + step);
    while nodes[nodes.len() - 1].position.y < top && nodes.len() < 200 {
        let last = nodes[nodes.len() - 1].position;
        // Back to the axis, so that tall stems stay under their crowns.
        let home = Vec3::new(-last.x, 0.0, -last.z) * (0.4 / growth.height);
        way = (way + dice.ball() * 0.09 + home + Vec3::Y * 0.15).normalize_or(Vec3::Y);
        let parent = Some(nodes.len() as u32 - 1);
        nodes.push(Node { position: last + way * step, parent, radius: 0.0 });
    }
    nodes
}

/// Places in the envelope, most of them in the outer half of its radius.
fn free_places(habit: &Habit, envelope: &Envelope, dice: &mut Dice) -> Vec<Vec3> {
    let ([low, high], widest) = (envelope.heights(), envelope.widest());
    let inside = |dice: &mut Dice| -> Vec3 {
        for _ in 0..1000 {
            let ball = dice.ball();
            let height = dice.between(low, high);
            let point = Vec3::new(ball.x * widest, height, ball.z * widest);
            let share = point.with_y(0.0).length() / envelope.radius(height).max(1e-3);
            if share < 0.97 && dice.share() < 0.25 + 0.75 * share * share {
                return point;
            }
        }
        Vec3::Y * (0.5 * (low + high))
    };
    let centres: Vec<Vec3> = (0..habit.places / 18).map(|_| inside(dice)).collect();
    let reach = 0.2 * widest.min(high - low);
    (0..habit.places)
        .map(|i| {
            if dice.share() < habit.clustered {
                let near = centres[i % centres.len()] + dice.ball() * reach;
                if envelope.holds(near) {
                    return near;
                }
            }
            inside(dice)
        })
        .collect()
}

/// Finds each place's nearest joint among those not `known` yet, and takes away places that are reached.
fn look(places: &mut Vec<Place>, nodes: &[Node], known: &mut usize, reached: f32) {
    for place in places.iter_mut() {
        for (i, node) in nodes.iter().enumerate().skip(*known) {
            let distance = place.at.distance(node.position);
            if distance < place.distance {
                (place.nearest, place.distance) = (i as u32, distance);
            }
        }
    }
    *known = nodes.len();
    places.retain(|place| place.distance > reached);
}

/// Sum of unit vectors to the places that each joint is nearest to.
fn pulls(places: &[Place], nodes: &[Node]) -> Vec<Vec3> {
    let mut pulls = vec![Vec3::ZERO; nodes.len()];
    for place in places {
        let joint = place.nearest as usize;
        pulls[joint] += (place.at - nodes[joint].position).normalize_or_zero();
    }
    pulls
}
