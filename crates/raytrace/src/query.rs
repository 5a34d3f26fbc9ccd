//! The questions that are asked of a world: what is nearest, and is anything in the way?

use glam::{DVec2, DVec3};
use light::{Geometry, Hit, Mesh, Nearest, Occlude, PointSource, Ray, Spectrum, Stretch, rounding::UNIT};

use crate::{
    collapse::WIDTH,
    lanes::Lanes,
    shadow::Shadow,
    shot::Shot,
    tree::{Faces, Name},
    triangle::{self, Crossing, candidates, cross},
    walk::{Visit, fetch, walk},
    world::World,
};

/// A triangle on the way of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// Distance along the ray \[m\].
    pub t: f64,
    /// Index into [`Geometry::instances`].
    pub instance: u32,
    /// Index within the mesh.
    pub triangle: u32,
    /// Weights of the second and third corner, to f32 accuracy.
    pub weights: DVec2,
    /// Whether light may pass: the mesh has an opacity or a medium of its own.
    pub alpha: bool,
}

impl Met {
    /// What makes an order of all triangles on a ray, equal distances included.
    pub(crate) fn key(&self) -> (f64, u32, u32) {
        (self.t, self.instance, self.triangle)
    }
}

/// Opacity of a mesh's triangle at the weights of its second and third corner; 1 for a solid one.
pub(crate) fn opacity(mesh: &Mesh, triangle: u32, weights: DVec2) -> f32 {
    let Some(opacity) = &mesh.opacity else { return 1.0 };
    let [a, b, c] = mesh.triangles[triangle as usize].map(|i| i as usize);
    let uv = match mesh.uvs.is_empty() {
        true => DVec2::ZERO,
        false => {
            let [a, b, c] = [a, b, c].map(|i| mesh.uvs[i].as_dvec2());
            a + (b - a) * weights.x + (c - a) * weights.y
        }
    };
    opacity.at(uv.as_vec2(), 0.0)
}

/// Takes the triangles that a ray meets, in no particular order.
pub(crate) trait Ask {
    /// Whether nearer ones are better taken first.
    const ORDERED: bool;

    /// One triangle within the ray's ends. `reach`, how far anything is still of interest, may be lowered.
    /// True ends the search.
    fn meet(&mut self, met: Met, geometry: &Geometry, reach: &mut f32) -> bool;
}

/// The least f32 that is no less than `t`.
fn rounded_up(t: f64) -> f32 {
    let near = t as f32;
    if f64::from(near) < t { near.next_up() } else { near }
}

impl World {
    /// Reports the triangles that `origin + t direction`, 0 < t < `length`, meets; none nearer than `floor` need
    /// be reported. True when `ask` ended it.
    pub(crate) fn ask(&self, line: (DVec3, DVec3), floor: f32, length: f32, ask: &mut impl Ask) -> bool {
        let (origin, direction) = line;
        let mut within = Within { world: self, instance: None, faces: &self.standing, length, ask };
        let Some(shot) = Shot::new(origin, direction, self.standing.tree.reach) else { return false };
        let reach = match within.walk(shot, floor, length) {
            Some(reach) => reach,
            None => return true,
        };
        if self.placements.is_empty() {
            return false;
        }
        let Some(shot) = Shot::new(origin, direction, self.tops.reach) else { return false };
        let (mut reach, mut through) = (reach, Through { world: self, line, floor, length, ask });
        walk(&self.tops, &shot, floor, &mut reach, &mut through)
    }
}

/// Looks at the triangles of one hierarchy.
struct Within<'a, A> {
    world: &'a World,
    /// Which placement, or none for what stands in the world's own coordinates.
    instance: Option<u32>,
    faces: &'a Faces,
    length: f32,
    ask: &'a mut A,
}

impl<A: Ask> Within<'_, A> {
    /// How far anything is of interest afterwards; none when the search is over.
    #[inline(always)]
    fn walk(&mut self, shot: Shot, floor: f32, reach: f32) -> Option<f32> {
        let tree = &self.faces.tree;
        let mut reach = reach;
        let over = if shot.origin_low == [0.0; 3] {
            walk(tree, &shot, floor, &mut reach, &mut Looking::<_, false> { within: self, shot: &shot })
        } else {
            walk(tree, &shot, floor, &mut reach, &mut Looking::<_, true> { within: self, shot: &shot })
        };
        if over { None } else { Some(reach) }
    }

    /// Where the line crosses, if it does so between the ray's ends.
    ///
    /// Corners in world coordinates have been rounded to f32, each coordinate by up to u of itself, and that
    /// moves the plane by up to u · reach · Σ|normal| (in units of normal · displacement). Where an end of the ray
    /// is that close to the plane, the triangle itself decides, in f64: a ray that has left a surface
    /// ([`light::Place::leave`]) is beyond it, never before.
    #[inline(always)]
    fn between_ends(&self, crossing: &Crossing, leaf: u32, lane: usize, shot: &Shot) -> Option<f64> {
        let length = f64::from(self.length);
        let mut t = crossing.t;
        // 1 % more for the rounding of this very bound.
        let unit = 1.01 * f64::from(UNIT) * crossing.sway;
        let end =
            if self.length.is_finite() { crossing.start - crossing.speed * length } else { f64::INFINITY };
        let nearest = crossing.start.abs().min(end.abs());
        if self.instance.is_none() && nearest <= unit * f64::from(self.faces.tree.reach) {
            let reach = triangle::reach(&self.faces.packets[leaf as usize], lane);
            if nearest <= unit * reach {
                t = self.exact(self.faces.names[leaf as usize * WIDTH + lane], shot).unwrap_or(t);
            }
        }
        (t > 0.0 && t < length).then_some(t)
    }

    /// Where the line crosses the plane of the triangle before it was rounded; none for a ray within it.
    #[cold]
    fn exact(&self, name: Name, shot: &Shot) -> Option<f64> {
        let face = self.world.geometry.triangle(name.instance, name.triangle);
        let normal = face.cross();
        let t = normal.dot(face.0[0] - shot.origin) / normal.dot(shot.direction);
        t.is_finite().then_some(t)
    }
}

/// A walk through one hierarchy.
struct Looking<'a, 'b, A, const SPLIT: bool> {
    within: &'b mut Within<'a, A>,
    shot: &'b Shot,
}

impl<A: Ask, const SPLIT: bool> Visit for Looking<'_, '_, A, SPLIT> {
    const ORDERED: bool = A::ORDERED;

    #[inline(always)]
    fn announce(&self, leaf: u32) {
        fetch(&self.within.faces.packets, leaf);
    }

    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, leaf: u32, reach: &mut f32) -> bool {
        let packet = &self.within.faces.packets[leaf as usize];
        let (mut mask, undecided) = candidates::<L, SPLIT>(packet, self.shot);
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            let Some(crossing) = cross(packet, lane, undecided >> lane & 1 == 1, self.shot) else { continue };
            let Some(t) = self.within.between_ends(&crossing, leaf, lane, self.shot) else { continue };
            if t > f64::from(*reach) {
                continue;
            }
            let name = self.within.faces.names[leaf as usize * WIDTH + lane];
            let met = Met {
                t,
                instance: self.within.instance.unwrap_or(name.instance),
                triangle: name.triangle,
                weights: DVec2::from(triangle::weights(packet, lane, self.shot)),
                alpha: name.alpha,
            };
            if self.within.ask.meet(met, &self.within.world.geometry, reach) {
                return true;
            }
        }
        false
    }
}

/// A walk through the placements.
struct Through<'a, A> {
    world: &'a World,
    line: (DVec3, DVec3),
    floor: f32,
    length: f32,
    ask: &'a mut A,
}

impl<A: Ask> Visit for Through<'_, A> {
    const ORDERED: bool = A::ORDERED;

    fn leaf<L: Lanes>(&mut self, leaf: u32, reach: &mut f32) -> bool {
        let placement = &self.world.placements[leaf as usize];
        let faces = &self.world.models[placement.model as usize];
        let (origin, direction) = self.line;
        let origin = placement.model_from_world.transform_point3(origin);
        let direction = placement.model_from_world.transform_vector3(direction);
        let Some(shot) = Shot::new(origin, direction, faces.tree.reach) else { return false };
        let instance = Some(placement.instance);
        let mut within = Within { world: self.world, instance, faces, length: self.length, ask: self.ask };
        match within.walk(shot, self.floor, *reach) {
            Some(left) => {
                *reach = left;
                false
            }
            None => true,
        }
    }
}

/// The nearest triangle after some place on the ray.
pub(crate) struct First {
    /// Only what comes after this in the order of [`Met::key`].
    pub(crate) after: (f64, u32, u32),
    /// Faces with an opacity of their own below this are passed.
    pub(crate) least: f32,
    pub(crate) found: Option<Met>,
}

impl First {
    /// From the start of the ray, where faces are there if their opacity is at least `least`.
    pub(crate) fn new(least: f32) -> Self {
        Self { after: (0.0, 0, 0), least, found: None }
    }
}

impl Ask for First {
    const ORDERED: bool = true;

    #[inline(always)]
    fn meet(&mut self, met: Met, geometry: &Geometry, reach: &mut f32) -> bool {
        let first = self.found.is_none_or(|found| met.key() < found.key());
        if !first || met.key() <= self.after {
            return false;
        }
        if met.alpha && self.least > 0.0 {
            let mesh = &geometry.meshes[geometry.instances[met.instance as usize].mesh as usize];
            if opacity(mesh, met.triangle, met.weights) < self.least {
                return false;
            }
        }
        self.found = Some(met);
        *reach = reach.min(rounded_up(met.t));
        false
    }
}

/// A ray's line in f64.
pub(crate) fn line(ray: &Ray) -> (DVec3, DVec3) {
    (ray.origin.as_dvec3(), ray.direction.as_dvec3())
}

/// The weights at which `line` meets the very triangle, where they agree with those that f32 has found
/// (`met.weights`); else those: a triangle seen edge-on leaves the line's crossing undecided.
pub(crate) fn weights(geometry: &Geometry, met: &Met, line: (DVec3, DVec3)) -> DVec2 {
    let exact = geometry.triangle(met.instance, met.triangle).meet(line.0, line.1);
    // Two corners' worth of doubt in either weight: anything nearer is better than the f32 weights.
    let near = |at: &DVec2| at.min_element() >= -1e-2 && at.element_sum() <= 1.01;
    exact.filter(near).unwrap_or(met.weights)
}

impl World {
    /// Which triangle `ray` meets first, as [`Nearest`] has it, without all that shading wants to know.
    pub fn first(&self, ray: &Ray) -> Option<Met> {
        let mut first = First::new(0.5);
        self.ask(line(ray), 0.0, ray.length, &mut first);
        first.found
    }
}

impl Nearest for World {
    fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let met = self.first(ray)?;
        let at = weights(&self.geometry, &met, line(ray));
        Some(self.geometry.hit(met.instance, met.triangle, at, ray, 0.0))
    }
}

impl Occlude for World {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let mut shadow = Shadow::new(line(segment).1);
        self.ask(line(segment), 0.0, segment.length, &mut shadow);
        shadow.through(&self.geometry, segment)
    }

    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        self.cut(source, a, b, out)
    }
}
