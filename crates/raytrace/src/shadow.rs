//! What stands between light and a place: opaque faces, veils of alpha, transparent bodies.

use glam::DVec3;
use light::{Geometry, Ray, Spectrum, rounding::UNIT};

use crate::{
    query::{Ask, Met, opacity},
    transmit::{Crossing, through},
};

/// The share of light that is let through.
pub(crate) struct Shadow {
    /// By what has been met so far, transparent bodies left out; f64, so that the order of the product does
    /// not show in f32.
    veils: f64,
    /// Direction of the light's way.
    direction: DVec3,
    /// Where transparent bodies were met, with the placement that stands for the body.
    bodies: Vec<(u32, Crossing)>,
}

impl Shadow {
    /// Nothing met yet on a way along the unit vector `direction`.
    pub(crate) fn new(direction: DVec3) -> Self {
        Self { veils: 1.0, direction, bodies: Vec::new() }
    }

    /// The whole answer, once everything on the way of `segment` has been met.
    ///
    /// A body is one placement of one mesh. Two of them that overlap count one after the other.
    pub(crate) fn through(mut self, geometry: &Geometry, segment: &Ray) -> Spectrum {
        let mut left = Spectrum::splat(self.veils as f32);
        if self.bodies.is_empty() || self.veils == 0.0 {
            return left;
        }
        // By placement, then by a total order, so that the walk's own order does not show.
        self.bodies.sort_by(|(a, at), (b, bt)| {
            let key = |c: &Crossing| c.outward.to_array();
            a.cmp(b)
                .then(at.t.total_cmp(&bt.t))
                .then_with(|| key(at).partial_cmp(&key(bt)).unwrap_or(a.cmp(b)))
        });
        for body in self.bodies.chunk_by(|a, b| a.0 == b.0) {
            let mesh = &geometry.meshes[geometry.instances[body[0].0 as usize].mesh as usize];
            let Some(medium) = &mesh.medium else { continue };
            let mut crossings: Vec<Crossing> = body.iter().map(|(_, crossing)| *crossing).collect();
            // Corners in the world are rounded to f32: two faces of one edge may be met this far apart.
            let reach = segment.origin.abs().max_element() + crossings.last().map_or(0.0, |c| c.t as f32);
            let same = 4.0 * f64::from(UNIT * reach);
            left *= through(self.direction, &mut crossings, f64::from(segment.length), same, medium);
        }
        left
    }
}

impl Ask for Shadow {
    const ORDERED: bool = false;

    #[inline(always)]
    fn meet(&mut self, met: Met, geometry: &Geometry, _: &mut f32) -> bool {
        if met.alpha {
            self.pass(&met, geometry);
        } else {
            self.veils = 0.0;
        }
        self.veils == 0.0
    }
}

impl Shadow {
    /// A face that lets light pass. One with a medium and an opacity is taken for its medium.
    #[cold]
    fn pass(&mut self, met: &Met, geometry: &Geometry) {
        let instance = &geometry.instances[met.instance as usize];
        let mesh = &geometry.meshes[instance.mesh as usize];
        if mesh.medium.is_none() {
            self.veils *= 1.0 - f64::from(opacity(mesh, met.triangle, met.weights));
            return;
        }
        let wound = geometry.triangle(met.instance, met.triangle).cross().normalize_or_zero();
        let outward = if instance.world_from_mesh.matrix3.determinant() < 0.0 { -wound } else { wound };
        self.bodies.push((met.instance, Crossing { t: met.t, outward }));
    }
}
