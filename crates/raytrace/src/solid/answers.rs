//! What the rest of the house asks of bodies.

use glam::DVec3;
use light::{
    Bodies, Hit, Hull, Nearest, Occlude, Place, PointSource, Ray, Spectrum, Stretch, rounding::UNIT,
};

use crate::transmit;

use super::{
    Acceleration, Crossing, Solids,
    boxes::Bounds,
    csg::{Compound, Wall},
    fan::Fan,
    member::U,
    shadow::Work,
};

impl Compound {
    /// Where, and with which outward normal, the line meets a wall.
    pub(crate) fn crossing(&self, wall: &Wall, line: (DVec3, DVec3)) -> Crossing {
        let member = &self.members[wall.member as usize];
        let normal = member.normal(wall.end.face, line.0 + line.1 * wall.end.t);
        let normal = if member.positive { normal } else { -normal };
        // At the very tip of a cone there is no normal: the face is looked at head on.
        let normal = if normal == DVec3::ZERO {
            line.1.normalize_or_zero() * if wall.entering { -1.0 } else { 1.0 }
        } else {
            normal
        };
        Crossing { t: wall.end.t, normal, entering: wall.entering, material: member.material }
    }
}

impl Solids {
    /// Visits bodies that may be met between 0 and what `visit` returns: how far is still of interest.
    fn search(&self, line: (DVec3, DVec3), mut reach: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        match self.acceleration {
            Acceleration::Boxes => self.boxes.along(line, reach, visit),
            Acceleration::None => {
                for body in 0..self.bodies.len() as u32 {
                    reach = visit(body, reach);
                }
            }
        }
    }

    /// The first wall between `after` and `before`, both excluded.
    fn first(&self, body: u32, line: (DVec3, DVec3), after: f64, before: f64) -> Option<Wall> {
        let mut found = None;
        self.bodies.get(body as usize)?.compound.walls(line, |wall| {
            if wall.end.t > after && wall.end.t < before {
                found = Some(wall);
            }
            wall.end.t > after
        });
        found
    }

    fn hit_at(&self, body: u32, wall: &Wall, line: (DVec3, DVec3), ray: &Ray, width: f32) -> Hit {
        let compound = &self.bodies[body as usize].compound;
        let crossing = compound.crossing(wall, line);
        let position = line.0 + line.1 * crossing.t;
        // Along the line the place is off by end.error, across the surface by that much times the cosine; the
        // sum o + t d rounds twice; all that is far below the rounding to f32, ½ ulp a coordinate.
        let rounding = 2.0 * U * (line.0.abs() + position.abs()).max_element();
        let exact = wall.end.error * line.1.dot(crossing.normal).abs() + rounding;
        let error = f64::from(UNIT) * position.abs().max_element() + 2.0 * exact;
        let normal = if crossing.entering { crossing.normal } else { -crossing.normal }.as_vec3();
        let place = Place {
            position: position.as_vec3(),
            // Rounded up, and never 0: f32 has no less than its smallest number.
            error: (error as f32).next_up().max(f32::MIN_POSITIVE),
            normal,
            seed: 0,
        };
        Hit {
            width,
            curvature: compound.members[wall.member as usize].curvature(wall.end.face, position) as f32,
            instance: self.first_instance + body,
            triangle: wall.member,
            material: crossing.material,
            front: crossing.entering,
            ..Hit::plain(place, -ray.direction, crossing.t as f32)
        }
    }
}

/// A ray's line in f64.
fn line(ray: &Ray) -> (DVec3, DVec3) {
    (ray.origin.as_dvec3(), ray.direction.as_dvec3())
}

impl Bodies for Solids {
    fn hulls(&self) -> &[Hull] {
        &self.hulls
    }

    fn meet(&self, body: u32, line: (DVec3, DVec3), after: f64) -> Option<f64> {
        Some(self.first(body, line, after, f64::INFINITY)?.end.t)
    }

    fn hit(&self, body: u32, line: (DVec3, DVec3), distance: f64, ray: &Ray, pixel_width: f32) -> Hit {
        let mut nearest: Option<Wall> = None;
        if let Some(ready) = self.bodies.get(body as usize) {
            let gap = |wall: &Wall| (wall.end.t - distance).abs();
            ready.compound.walls(line, |wall| {
                if nearest.as_ref().is_none_or(|best| gap(&wall) < gap(best)) {
                    nearest = Some(wall);
                }
                wall.end.t >= distance
            });
        }
        match nearest {
            Some(wall) => self.hit_at(body, &wall, line, ray, pixel_width),
            None => self.nowhere(body, line, distance, ray),
        }
    }
}

impl Solids {
    /// The hit for a distance that [`Bodies::meet`] never gave: there, head on, of the body's first material.
    fn nowhere(&self, body: u32, line: (DVec3, DVec3), distance: f64, ray: &Ray) -> Hit {
        let members = self.bodies.get(body as usize).map(|ready| &ready.compound.members);
        let position = (line.0 + line.1 * distance).as_vec3();
        let normal = -ray.direction;
        let place = Place { position, error: UNIT * position.abs().max_element(), normal, seed: 0 };
        Hit {
            instance: self.first_instance.saturating_add(body),
            material: members.and_then(|members| members.first()).map_or(0, |member| member.material),
            ..Hit::plain(place, normal, distance as f32)
        }
    }
}

impl Nearest for Solids {
    fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let line = line(ray);
        let mut found: Option<(u32, Wall)> = None;
        self.search(line, ray.length.into(), |body, reach| {
            // A body at the same distance as another comes first if it is named first, in whatever order
            // they are visited.
            let Some(wall) = self.first(body, line, 0.0, reach.next_up()) else { return reach };
            let before = match &found {
                Some((other, best)) => (wall.end.t, body) < (best.end.t, *other),
                None => wall.end.t < f64::from(ray.length),
            };
            if !before {
                return reach;
            }
            found = Some((body, wall));
            wall.end.t
        });
        let (body, wall) = found?;
        Some(self.hit_at(body, &wall, line, ray, 0.0))
    }
}

impl Solids {
    /// The share of light that one body lets through between 0 and `length`.
    fn lets_through(&self, body: u32, line: (DVec3, DVec3), length: f64) -> Spectrum {
        let ready = &self.bodies[body as usize];
        let Some(medium) = &ready.medium else {
            return match self.first(body, line, 0.0, length) {
                Some(_) => Spectrum::ZERO,
                None => Spectrum::ONE,
            };
        };
        let mut crossings = Vec::new();
        ready.compound.walls(line, |wall| {
            if wall.end.t > 0.0 && wall.end.t < length {
                let Crossing { t, normal: outward, .. } = ready.compound.crossing(&wall, line);
                crossings.push(transmit::Crossing { t, outward });
            }
            wall.end.t >= length
        });
        if crossings.is_empty() {
            return Spectrum::ONE;
        }
        // Walls that are one have been joined already: none are the same by being near.
        transmit::through(line.1.normalize(), &mut crossings, length, 0.0, medium)
    }
}

impl Solids {
    /// Whether the box around any body has something in common with `region`.
    fn meets(&self, region: Bounds) -> bool {
        let mut meets = false;
        self.boxes.within(region, |_| meets = true);
        meets
    }
}

impl Occlude for Solids {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let line = line(segment);
        let length = f64::from(segment.length);
        let mut left = Spectrum::ONE;
        self.search(line, length, |body, reach| {
            left *= self.lets_through(body, line, length);
            if left.is_zero() { f64::NEG_INFINITY } else { reach }
        });
        left
    }

    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        let fan = Fan::new(source, a, b);
        // Where bodies pass through the plane is not known: rays must look.
        if matches!(source, PointSource::Below { .. }) {
            return !self.meets(fan.bounds());
        }
        let mut work = Work::default();
        let mut visit = |body: u32| fan.stretches(&self.bodies[body as usize], &mut work, out);
        match self.acceleration {
            Acceleration::Boxes => self.boxes.within(fan.bounds(), visit),
            Acceleration::None => (0..self.bodies.len() as u32).for_each(&mut visit),
        }
        true
    }
}
