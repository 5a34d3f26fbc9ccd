//! Light in rooms: furnaces, energy, orders, mirrors, and the slow reference.

use glam::{DVec3, Vec3};
use keikan_radiosity::{
    Between, Clear, Linking, Links, Mirror, Orders, Patches, Solution, Source, reference::Dense, solve,
};
use light::{Occlude, Spectrum, Vacuum};
use proptest::prelude::*;

use crate::rooms::{Room, surface};

fn linked(patches: &Patches, occlude: &dyn Occlude, share: f64) -> Links {
    Links::new(patches, &Between::dry(occlude), &Linking { share, ..Linking::default() })
}

/// The primary light of a lamp that lights the back half of the ceiling alone.
fn one_corner(patches: &Patches, height: f32) -> Vec<Spectrum> {
    let lit = |at: DVec3| at.y > f64::from(height) - 1e-3 && at.z < 2.0;
    patches.iter().map(|patch| Spectrum::splat(if lit(patch.centre()) { 100.0 } else { 0.0 })).collect()
}

fn spread(values: &[f32]) -> (f32, f32) {
    values.iter().fold((f32::MAX, f32::MIN), |(low, high), &value| (low.min(value), high.max(value)))
}

#[test]
fn an_empty_room_is_closed() {
    let room = Room::empty(Vec3::new(4.0, 3.0, 5.0));
    let patches = room.patches(0.5, 0.5);
    for share in [0.05, 0.02] {
        let links = linked(&patches, &Vacuum, share);
        let closure: Vec<f32> = links.closure(&patches).iter().map(|seen| seen.max()).collect();
        let mean = closure.iter().sum::<f32>() / closure.len() as f32;
        println!("{} patches, share {share}: {} links, mean {mean}, {:?} imbalance {}", patches.len(), links.len(), spread(&closure), links.imbalance());
    }
}

fn solved(patches: &Patches, links: &Links, direct: &[Spectrum], orders: Orders) -> Solution {
    solve(patches, links, &Source { emitted: &[], direct }, orders)
}

#[test]
fn links_agree_with_the_slow_reference() {
    for (room, occluded) in [(Room::empty(Vec3::new(4.0, 3.0, 5.0)), false), (Room::furnished(), true)] {
        let patches = room.patches(1.1, 0.6);
        let direct = one_corner(&patches, room.size.y);
        let between = Between::dry(&room.boxes);
        let truth = Dense::new(&patches, &between, 2).irradiance(&Source { emitted: &[], direct: &direct }, 3);
        let largest = truth.iter().map(|e| e[0]).fold(0.0, f64::max);
        let mean = truth.iter().map(|e| e[0]).sum::<f64>() / truth.len() as f64;
        for share in [0.05, 0.02, 0.005] {
            let links = linked(&patches, &room.boxes, share);
            let found = solved(&patches, &links, &direct, Orders::Count(3)).irradiance;
            let square: f64 = found.iter().zip(&truth).map(|(a, b)| (f64::from(a[0]) - b[0]).powi(2)).sum();
            let worst = found.iter().zip(&truth).map(|(a, b)| (f64::from(a[0]) - b[0]).abs()).fold(0.0, f64::max);
            println!("{occluded} {} patches share {share}: {} links; rms {:.4}, worst {:.4} of mean {mean:.2}, largest {largest:.2}", patches.len(), links.len(),
                (square / truth.len() as f64).sqrt() / mean, worst / mean);
        }
    }
}
