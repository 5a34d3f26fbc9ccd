//! Light over mirrors.

use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};
use keikan_radiosity::{
    Absorbing, Attenuate, Between, Clear, Cut, Linking, Links, Mirror, Orders, Patch, Patches, Side, Source,
    Surfaces, solve,
};
use light::{Geometry, Instance, Mesh, Spectrum, Vacuum};

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
        let doubled = means(
            &patches(4.0, 0.5),
            &Between { occlude: &Vacuum, attenuate, mirrors: &[], passages: &[], obstacles: None },
        );
        let pane: [Arc<dyn Mirror>; 1] = [Arc::new(Pane { above: 0.0, below: 1.0 })];
        let half = means(
            &patches(2.0, 0.5),
            &Between { occlude: &Vacuum, attenuate, mirrors: &pane, passages: &[], obstacles: None },
        );
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

/// The underside of still water at y = 1: what light beyond the critical angle sees.
struct Total {
    cos: f64,
}

impl Mirror for Total {
    fn plane(&self) -> (DVec3, DVec3) {
        (DVec3::Y, DVec3::Y)
    }

    fn reflectance(&self, at: DVec3, from_above: bool, cos: f64) -> Spectrum {
        assert!((at.y - 1.0).abs() < 1e-5 && !from_above);
        if cos < self.cos { Spectrum::ONE } else { Spectrum::ZERO }
    }
}

#[test]
fn a_floor_sees_itself_by_total_reflection() {
    let half = 12.0;
    let corners = [[-half, -half], [-half, half], [half, half], [half, -half]];
    let mesh = Mesh {
        positions: corners.map(|[x, z]| Vec3::new(x, 0.0, z)).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    };
    let placed = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
    let geometry = Geometry { meshes: vec![mesh], instances: vec![placed] };
    let patches = Patches::new(&geometry, &|_: &Patch| Spectrum::ONE, &Cut { edge: 2.2, ..Cut::default() });
    // The sine of the critical angle is 1/n: a share 1 − 1/n² of diffuse light is beyond it.
    let beyond = 1.0 - 1.0 / (1.34f32 * 1.34);
    let extinction = 0.2;
    for absorbs in [false, true] {
        let water: [Arc<dyn Mirror>; 1] = [Arc::new(Total { cos: f64::from(beyond).sqrt() })];
        let medium = Absorbing { extinction: Spectrum::splat(if absorbs { extinction } else { 0.0 }) };
        let between =
            Between { occlude: &Vacuum, attenuate: &medium, mirrors: &water, passages: &[], obstacles: None };
        let links = Links::new(&patches, &between, &Linking { share: 0.01, rays: 32, ..Linking::default() });
        let nearest = |k: &usize| patches.patch(*k).centre().length();
        let middle = (0..patches.len())
            .filter(|&k| patches.patch(k).normal().y > 0.0)
            .min_by(|a, b| nearest(a).total_cmp(&nearest(b)))
            .expect("a patch");
        let found = links.closure(&patches)[middle][0];
        // Over the folded way of 2/cos θ metres: ∫ 2 cos e^(−2K/cos) d cos below the critical cosine.
        let steps = 10_000;
        let limit = f64::from(beyond).sqrt();
        let integrand = |i: i32| {
            let cos = (f64::from(i) + 0.5) / f64::from(steps) * limit;
            let k = if absorbs { f64::from(extinction) } else { 0.0 };
            2.0 * cos * (-2.0 * k / cos).exp() * limit / f64::from(steps)
        };
        let truth = (0..steps).map(integrand).sum::<f64>() as f32;
        // What lies beyond the floor: 1/(1 + 6²) of a hemisphere at most; the critical angle is found to a few ways of 32 in each of
        // the links it crosses.
        let missing = 1.0 / 37.0;
        assert!(found < truth + 0.01 && found > truth - missing - 0.01, "{absorbs}: {found} {truth}");
    }
}
