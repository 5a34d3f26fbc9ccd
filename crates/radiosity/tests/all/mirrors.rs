//! Light over mirrors.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use keikan_radiosity::{
    Absorbing, Attenuate, Between, Clear, Cut, Linking, Links, Mirror, Orders, Patch, Patches, Side, Source,
    Surfaces, solve,
};
use light::{Spectrum, Vacuum};

use crate::rooms::Room;

/// The plane x = 2, one reflectance from either side.
struct Pane {
    above: f32,
    below: f32,
}

impl Mirror for Pane {
    fn plane(&self) -> (DVec3, DVec3) {
        (DVec3::X * 2.0, DVec3::X)
    }

    fn reflectance(&self, _: DVec3, from_above: bool, cos: f64) -> Spectrum {
        assert!((0.0..=1.0).contains(&cos));
        Spectrum::splat(if from_above { self.above } else { self.below })
    }
}

/// All of a room but its wall at the mirror, x = `wall`.
struct Half {
    wall: f64,
}

impl Surfaces for Half {
    fn takes_part(&self, face: [u32; 2], side: Side) -> bool {
        // The fourth pair of triangles is the wall at the larger x.
        side == Side::Back && (face[1] / 2 != 3 || self.wall > 3.0)
    }

    fn reflectance(&self, _: &Patch) -> Spectrum {
        Spectrum::splat(0.6)
    }
}

fn patches(width: f32, edge: f64) -> Patches {
    let room = Room::empty(Vec3::new(width, 2.0, 2.0));
    Patches::new(&room.geometry, &Half { wall: f64::from(width) }, &Cut { edge, ..Cut::default() })
}

fn floor_lit(patches: &Patches) -> Vec<Spectrum> {
    patches.iter().map(|patch| Spectrum::splat(if patch.centre().y < 1e-3 { 10.0 } else { 1.0 })).collect()
}

/// Mean irradiance of the floor at x < 2 and of the far wall.
fn means(patches: &Patches, between: &Between<'_>) -> [f64; 2] {
    let links = Links::new(patches, between, &Linking { share: 0.01, ..Linking::default() });
    let direct = floor_lit(patches);
    let solution = solve(patches, &links, &Source { emitted: &[], direct: &direct }, Orders::Count(4));
    let mean = |on: &dyn Fn(DVec3) -> bool| {
        let (mut sum, mut area) = (0.0, 0.0);
        for (patch, irradiance) in patches.iter().zip(&solution.irradiance) {
            if on(patch.centre()) {
                sum += patch.area() * f64::from(irradiance[0]);
                area += patch.area();
            }
        }
        sum / area
    };
    [mean(&|at| at.y < 1e-3 && at.x < 2.0), mean(&|at| at.x < 1e-3)]
}

#[test]
fn a_perfect_mirror_doubles_the_room() {
    let media: [&dyn Attenuate; 2] = [&Clear, &Absorbing { extinction: Spectrum::splat(0.3) }];
    for attenuate in media {
        let doubled = means(&patches(4.0, 0.5), &Between { occlude: &Vacuum, attenuate, mirrors: &[] });
        let pane: [Arc<dyn Mirror>; 1] = [Arc::new(Pane { above: 0.0, below: 1.0 })];
        let half = means(&patches(2.0, 0.5), &Between { occlude: &Vacuum, attenuate, mirrors: &pane });
        for (half, doubled) in half.into_iter().zip(doubled) {
            // Patches differ (the doubled room's are not cut at the mirror), and so do their links: each is off by what its links of 0.01
            // leave, 0.3 % here.
            assert!((half / doubled - 1.0).abs() < 0.005, "{half} {doubled}");
        }
    }
}

#[test]
fn a_mirror_closes_a_room_and_a_weak_one_does_in_part() {
    let patches = patches(2.0, 0.5);
    for (below, above) in [(1.0f32, 0.0), (0.25, 1.0)] {
        let pane: [Arc<dyn Mirror>; 1] = [Arc::new(Pane { above, below })];
        let open = Links::new(&patches, &Between::dry(&Vacuum), &Linking::default()).closure(&patches);
        let between = Between { mirrors: &pane, ..Between::dry(&Vacuum) };
        let links = Links::new(&patches, &between, &Linking::default());
        for (seen, open) in links.closure(&patches).iter().zip(&open) {
            // All that leaves by the opening comes back by the mirror, to the share that it reflects.
            let truth = open[0] + below * (1.0 - open[0]);
            assert!((seen[0] - truth).abs() < 2e-3, "{} {truth}", seen[0]);
        }
    }
}
