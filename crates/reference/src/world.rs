//! A world to be judged: what stands in it, what shines, and what arrives along straight ways.

use std::sync::Arc;

use glam::DVec3;
use light::Geometry;

use crate::bands::Bands;
use crate::boundary::Boundary;
use crate::glass;
use crate::glow::Glow;
use crate::heaven::Heaven;
use crate::lamp::Lamp;
use crate::shape::{Face, Shape};
use crate::solid::Solid;
use crate::surface::Surface;
use crate::tree::Line;
use crate::water::Water;

/// Radiance from everything beyond the world by the unit vector towards it \[W m⁻² sr⁻¹ nm⁻¹\], finite, ≥ 0.
pub type Sky = Box<dyn Fn(DVec3) -> Bands + Send + Sync>;

/// What a world is made of.
#[derive(Default)]
pub struct Parts {
    /// All triangles.
    pub geometry: Arc<Geometry>,
    /// Curved bodies.
    pub solids: Vec<Solid>,
    /// By the numbers that meshes and solids carry; what has none is black.
    pub surfaces: Vec<Surface>,
    /// Everything that is not found by looking into all directions.
    pub lamps: Vec<Lamp>,
    /// What lies beyond, if it shines.
    pub sky: Option<Sky>,
    /// They do not overlap.
    pub waters: Vec<Water>,
}

/// A world ready for rays.
pub struct World {
    pub(crate) shape: Shape,
    pub(crate) surfaces: Vec<(Surface, Boundary)>,
    pub(crate) lamps: Vec<Lamp>,
    pub(crate) sky: Option<Heaven>,
    pub(crate) glow: Option<Glow>,
    pub(crate) waters: Vec<Water>,
}

/// What is met beyond what is described: black.
const BLACK: f32 = 0.0;

impl World {
    /// Of these parts.
    pub fn new(parts: Parts) -> Self {
        let shape = Shape::new(parts.geometry, parts.solids, &parts.waters);
        let surfaces = parts.surfaces.into_iter().chain([Surface::grey(BLACK)]);
        let surfaces = surfaces.map(|surface| {
            let boundary = boundary(&surface);
            (surface, boundary)
        });
        let (surfaces, sky) = (surfaces.collect(), parts.sky.map(Heaven::new));
        let mut world = Self { shape, surfaces, lamps: parts.lamps, sky, glow: None, waters: parts.waters };
        world.glow = Glow::new(&world.shape, |number| world.surface(number).0.brightness());
        world
    }

    /// The surface of that number.
    pub(crate) fn surface(&self, number: u32) -> &(Surface, Boundary) {
        &self.surfaces[(number as usize).min(self.surfaces.len() - 1)]
    }

    /// The water that a point is in: of several above each other the one that it is least deep in.
    pub(crate) fn water_at(&self, point: DVec3) -> Option<&Water> {
        let holding = self.waters.iter().filter(|water| water.holds(point));
        holding.min_by(|a, b| a.level.total_cmp(&b.level))
    }

    /// What fills the stretch of a line up to `length`, which meets nothing.
    pub(crate) fn water_along(&self, line: &Line, length: f64) -> Option<&Water> {
        if self.waters.is_empty() {
            return None;
        }
        self.water_at(line.at(if length.is_finite() { 0.5 * length } else { self.shape.before }))
    }

    /// Share of the light that arrives straight, up to `length`: through what is partly there, panes and water; not through the surface
    /// of a water, where ways bend.
    pub(crate) fn transmittance(&self, line: Line, length: f64) -> Bands {
        let (mut share, mut line, mut left) = (Bands::ONE, line, length);
        loop {
            let meeting = self.shape.nearest(&line, left);
            let far = meeting.map_or(left, |met| met.distance());
            if let Some(water) = self.water_along(&line, far) {
                share *= water.extinction().attenuate(far);
            }
            let Some(met) = meeting else { return share };
            let point = self.shape.point(&line, &met);
            match point.face {
                Face::Surface(_) => return Bands::ZERO,
                Face::Side => {}
                Face::Thing { .. } | Face::Solid => {
                    let opacity = self.shape.opacity(&met);
                    let surface = &self.surface(point.surface).0;
                    let there = match &surface.body {
                        Some(body) if body.thin => glass::pane(surface, body, &point, line.direction),
                        _ => Bands::ZERO,
                    };
                    share *= there * opacity + Bands::splat(1.0 - opacity);
                    if share.is_zero() {
                        return share;
                    }
                }
            }
            line = self.shape.leave(&point, line.direction);
            left -= far;
        }
    }
}

fn boundary(surface: &Surface) -> Boundary {
    if surface.body.is_some() || (surface.metallic <= 0.0 && surface.index <= 1.0) {
        return Boundary::none();
    }
    let varies = surface.metallic_roughness_texture.is_some();
    Boundary::new(surface.index, f64::from(surface.roughness), varies, surface.metallic > 0.0)
}
