mod lamps;
mod parts;
mod scattered;
mod shadows;
mod stable;
mod window;

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3, Vec3};
use light::{
    Arrival, Distribution, Illuminate, Luminaire, Mesh, Occlude, Path, Place, Ray, Spectrum, Surroundings,
};

use super::*;
use crate::{Loss, Phase, Scatterer, Water};

/// The index of the tests' water.
const N: f64 = 1.34;

fn square(water: Water, half: f32, level: f64) -> FlatWater {
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let positions = corners.map(|(x, z)| Vec3::new(x * half, 0.0, z * half)).to_vec();
    let mesh = Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    FlatWater::new(water, &mesh, &DAffine3::from_translation(DVec3::new(0.0, level, 0.0)))
}

/// A water of one extinction c \[1/m\] and albedo in all bands.
fn grey(c: f32, albedo: f32, phase: Phase) -> Water {
    let scatterer = Scatterer { scattering: Spectrum::splat(c * albedo), phase };
    Water::new(Spectrum::splat(c * (1.0 - albedo)), vec![scatterer], N).unwrap()
}

/// Endless for the tests' purposes, its surface at 0.
fn sea(water: Water) -> Arc<[FlatWater]> {
    Arc::new([square(water, 1e4, 0.0)])
}

/// A sun of E = 1, without a disc.
struct Sun(Vec3);

impl Illuminate for Sun {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        let irradiance = occlude.transmittance(&place.leave(self.0, f32::INFINITY));
        receive(Arrival::Beam { toward: self.0, irradiance, radius: Some(0.0) });
    }
}

/// A sky by unit vector; to places in air it is dark.
struct Sky(fn(Vec3) -> f32);

impl Illuminate for Sky {
    fn arrivals(&self, _: &Place, _: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        receive(Arrival::Field { irradiance: Spectrum::ONE });
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        if ray.direction.y > 0.0 { Spectrum::splat(self.0(ray.direction)) } else { Spectrum::ZERO }
    }
}

fn luminaire(position: DVec3) -> Luminaire {
    Luminaire {
        position: position.as_vec3(),
        world_from_luminaire: glam::Mat3::IDENTITY,
        distribution: Distribution::isotropic(1.0),
        spectrum: Spectrum::ONE,
        glints: true,
    }
}

/// A level board that hides all: y, and its corners in x and z.
#[derive(Clone, Copy)]
struct Board {
    y: f32,
    low: [f32; 2],
    high: [f32; 2],
}

impl Occlude for Board {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let t = (self.y - segment.origin.y) / segment.direction.y;
        let at = segment.at(t);
        let on = t > 0.0 && t < segment.length;
        let inside =
            (self.low[0]..=self.high[0]).contains(&at.x) && (self.low[1]..=self.high[1]).contains(&at.z);
        if on && inside { Spectrum::ZERO } else { Spectrum::ONE }
    }
}

/// Asks one source.
struct Around<'a>(&'a Lit, &'a dyn Occlude);

impl Surroundings for Around<'_> {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        self.0.arrivals(place, self.1, receive);
    }

    fn scattered(&self, ray: &Ray) -> Spectrum {
        self.0.scattered(ray, self.1)
    }

    fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
        Spectrum::ZERO
    }
}

#[test]
fn depth_is_below_the_outline_only() {
    let pool = square(Water::named("pool").unwrap(), 2.0, 1.5);
    assert_eq!(pool.depth(DVec3::new(1.0, 0.5, -1.9)), Some(1.0));
    assert_eq!(pool.depth(DVec3::new(1.0, 2.0, 0.0)), Some(-0.5));
    assert_eq!(pool.depth(DVec3::new(2.5, 0.5, 0.0)), None);
    assert!(pool.covers(DVec2::new(2.0, 2.0)));
}

#[test]
fn a_way_leaves_the_outline_where_it_crosses_it() {
    // An L of three squares: the way along z = 0.5 passes one arm, a gap and nothing else.
    let at = |x: f32, z: f32| Vec3::new(x, 0.0, z);
    let square = |x: f32, z: f32| [at(x, z), at(x + 1.0, z), at(x + 1.0, z + 1.0), at(x, z + 1.0)];
    let positions: Vec<Vec3> = [square(0.0, 0.0), square(1.0, 0.0), square(3.0, 0.0)].concat();
    let triangles =
        (0..3).flat_map(|i| [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]]).collect();
    let mesh = Mesh { positions, triangles, ..Mesh::default() };
    let water = FlatWater::new(Water::named("pool").unwrap(), &mesh, &DAffine3::IDENTITY);
    let ways = water.stretches(DVec2::new(-1.0, 0.3), DVec2::new(4.0, 0.3));
    let covered: f64 = ways.iter().map(|[from, to]| 5.0 * (to - from)).sum();
    // x from 0 to 2 and from 3 to 4; the squares' common side is no end.
    assert!((covered - 3.0).abs() < 1e-12 && (ways[0][0] - 0.2).abs() < 1e-12, "{ways:?}");
    assert_eq!(water.stretches(DVec2::new(0.2, 0.3), DVec2::new(0.8, 0.4)), [[0.0, 1.0]]);
    assert!(water.stretches(DVec2::new(2.2, 0.3), DVec2::new(2.8, 0.4)).is_empty());
    assert_eq!(water.stretches(DVec2::splat(0.5), DVec2::splat(0.5)), [[0.0, 1.0]]);
}
