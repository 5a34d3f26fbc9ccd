//! What flat water does to light between patches: its surface mirrors it and lets it through, the water takes.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use light::{Occlude, Ray, Spectrum, fresnel};
use radiosity::{Attenuate, Bent, Mirror, Passage};
use water::Loss;
use water::flat::FlatWater;
use water::path::{Leg, Paths};

/// Ends of ways nearer to a surface than this \[m\] lie on it.
const ON: f64 = 1e-4;

/// The waters of a scene; most often none.
#[derive(Clone)]
pub(super) struct Still(pub(super) Arc<[FlatWater]>);

impl Still {
    /// Their surfaces as mirrors.
    pub(super) fn mirrors(&self) -> Vec<Arc<dyn Mirror>> {
        (0..self.0.len()).map(|index| Arc::new(Face(self.clone(), index)) as Arc<dyn Mirror>).collect()
    }

    /// Their surfaces as what light passes.
    pub(super) fn passages(&self) -> Vec<Arc<dyn Passage>> {
        (0..self.0.len()).map(|index| Arc::new(Face(self.clone(), index)) as Arc<dyn Passage>).collect()
    }

    /// The number of the water that a point is in: of several above each other the one that it is least deep in.
    pub(super) fn holds(&self, point: DVec3) -> Option<usize> {
        let depths = self.0.iter().map(|water| water.depth(point).filter(|depth| *depth > 0.0));
        let depths = depths.enumerate().filter_map(|(i, depth)| Some((i, depth?)));
        depths.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
    }

    /// Whether a straight way crosses a surface.
    fn part(&self, from: DVec3, to: DVec3) -> bool {
        self.0.iter().any(|water| {
            let [a, b] = [from, to].map(|end| end.y - water.surface.level);
            let crosses = a.min(b) < -ON && a.max(b) > ON;
            crosses && {
                let at = from.lerp(to, a / (a - b));
                water.covers(DVec2::new(at.x, at.z))
            }
        })
    }
}

/// Light for diffuse surfaces is lost with K = a + b_b under water (3.20 has c: too much by far), not at all in air.
impl Attenuate for Still {
    fn factor(&self, from: DVec3, to: DVec3) -> Spectrum {
        // No way crosses a surface: its middle tells where all of it is.
        let Some(water) = self.holds(0.5 * (from + to)) else { return Spectrum::ONE };
        self.0[water].water.loss(Loss::Diffuse).attenuate(from.distance(to) as f32)
    }

    fn is_clear(&self, low: DVec3, _: DVec3) -> bool {
        self.0.iter().all(|water| low.y >= water.surface.level || water.water.loss(Loss::Diffuse).is_zero())
    }
}

/// One surface, from above and from below (3.19), with total reflection.
struct Face(Still, usize);

impl Mirror for Face {
    fn plane(&self) -> (DVec3, DVec3) {
        (DVec3::Y * self.0.0[self.1].surface.level, DVec3::Y)
    }

    fn reflectance(&self, at: DVec3, from_above: bool, cos: f64) -> Spectrum {
        let water = &self.0.0[self.1];
        if !water.covers(DVec2::new(at.x, at.z)) {
            return Spectrum::ZERO;
        }
        let n = water.surface.index;
        Spectrum::splat(fresnel(if from_above { n } else { 1.0 / n }, cos) as f32)
    }
}

/// Light that passes the surface: above and below patches light each other (the thesis' assumption 8 leaves that out).
impl Passage for Face {
    fn plane(&self) -> (DVec3, DVec3) {
        Mirror::plane(self)
    }

    fn holds(&self, point: DVec3) -> bool {
        self.0.holds(point) == Some(self.1)
    }

    fn covers(&self, at: DVec3) -> bool {
        self.0.0[self.1].covers(DVec2::new(at.x, at.z))
    }

    fn index(&self) -> f64 {
        self.0.0[self.1].surface.index
    }

    fn bent(&self, source: DVec3, receiver: DVec3, down: bool) -> Option<Bent> {
        let surface = &self.0.0[self.1].surface;
        let [above, below] = if down { [source, receiver] } else { [receiver, source] };
        let above = above.with_y(above.y.max(surface.level));
        let below = below.with_y(below.y.min(surface.level - TOUCHING));
        let [source, receiver] = if down { [above, below] } else { [below, above] };
        let Leg { at_surface, leaving, toward, share, spread, .. } =
            surface.refracted(source, receiver, Paths::Exact)?;
        Some(Bent { at: at_surface?, leaving, toward, share, spread })
    }
}

/// What is under water is at least this far below the surface \[m\].
const TOUCHING: f64 = 1e-9;

/// Things in the way, and water surfaces, which straight ways do not cross.
pub(super) struct Apart<'a> {
    pub(super) things: &'a dyn Occlude,
    pub(super) still: &'a Still,
}

impl Occlude for Apart<'_> {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let [from, to] = [segment.origin, segment.at(segment.length)].map(|end| end.as_dvec3());
        if self.still.part(from, to) { Spectrum::ZERO } else { self.things.transmittance(segment) }
    }
}

#[cfg(test)]
mod tests {
    use glam::{DAffine3, Vec3};
    use light::{Mesh, Vacuum};
    use water::Water;

    use super::*;

    /// A pond of 10 by 10 m at y = 2.
    fn pond() -> Still {
        let corners = [[-5.0, -5.0], [-5.0, 5.0], [5.0, 5.0], [5.0, -5.0]];
        let mesh = Mesh {
            positions: corners.map(|[x, z]| Vec3::new(x, 0.0, z)).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        };
        let water = Water::named("pool").expect("a water that there is");
        Still([FlatWater::new(water, &mesh, &DAffine3::from_translation(DVec3::Y * 2.0))].into())
    }

    #[test]
    fn the_surface_parts_what_is_above_and_below() {
        let still = pond();
        let left = |from: Vec3, to: Vec3| {
            Apart { things: &Vacuum, still: &still }.transmittance(&Ray::between(from, to)).max()
        };
        let (above, below) = (Vec3::new(1.0, 3.0, 0.0), Vec3::new(0.0, 1.0, 1.0));
        assert_eq!([left(above, below), left(below, above)], [0.0; 2]);
        assert_eq!([left(above, above + Vec3::X), left(below, below + Vec3::X)], [1.0; 2]);
        // Ways end at the surface on either side, and pass beside it.
        assert_eq!([left(above, above.with_y(2.0)), left(below, below.with_y(2.0))], [1.0; 2]);
        assert_eq!(left(above + Vec3::X * 9.0, below + Vec3::X * 9.0), 1.0);
    }

    #[test]
    fn only_ways_under_water_lose_light() {
        let still = pond();
        let pool = Water::named("pool").expect("a water that there is");
        let under = still.factor(DVec3::new(0.0, 1.0, 0.0), DVec3::new(3.0, 1.0, 0.0));
        assert_eq!(under, pool.diffuse().attenuate(3.0));
        assert_eq!(still.factor(DVec3::new(0.0, 2.5, 0.0), DVec3::new(3.0, 2.5, 0.0)), Spectrum::ONE);
    }

    #[test]
    fn mirrors_reflect_wholly_beyond_the_critical_angle_and_nowhere_else() {
        let still = pond();
        let mirror = &still.mirrors()[0];
        let critical = still.0[0].water.critical_angle().cos();
        let share = |above: bool, cos: f64| mirror.reflectance(DVec3::ZERO, above, cos)[0];
        assert_eq!(share(false, critical - 1e-6), 1.0);
        assert!(share(false, critical + 0.01) < 0.7 && share(true, 0.1) < 0.7);
        // Head on the same from both sides; f32.
        assert!((share(false, 1.0) - share(true, 1.0)).abs() < 1e-7);
        assert_eq!(mirror.reflectance(DVec3::X * 6.0, false, 0.1), Spectrum::ZERO);
    }
}
