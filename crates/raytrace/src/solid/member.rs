//! One placed convex solid, made ready for lines.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::{DAffine3, DMat3, DVec3};

use super::{
    chord::{Chord, Surface},
    hull::{self, Solid},
    node::{Plane, Shape, Wrong},
};

/// Unit round-off of f64.
pub(crate) const U: f64 = f64::EPSILON * 0.5;

/// Which side of a surface a line takes that runs within it: that of the line moved by next to nothing this
/// way. One direction for all solids, so that faces in common are decided alike: of two solids that touch
/// exactly one has the line, and a face cut away stays cut away. No scene has faces parallel to it.
const NUDGE: DVec3 = DVec3::new(0.618_033_988_749_894_9, 0.324_717_957_244_746, 0.715_460_321_2);

/// A placed solid.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub(crate) surface: Surface,
    /// Around the shape, in its own coordinates.
    pub(crate) hull: Solid,
    /// Centre and radius of a ball around the shape, in its own coordinates.
    pub(crate) ball: (DVec3, f64),
    pub(crate) world_from_solid: DAffine3,
    solid_from_world: DMat3,
    /// 1 / length of the placement's columns: how errors in metres show along the shape's axes.
    per_metre: DVec3,
    /// Norm of the inverse of the placement with columns of length 1.
    skew: f64,
    /// Error in metres that is there for a line from nearby.
    standing_error: f64,
    /// [`NUDGE`] in the shape's coordinates.
    pub(crate) nudge: DVec3,
    pub(crate) material: u32,
    /// False for what is subtracted (an odd number of times).
    pub(crate) positive: bool,
}

/// A line in a solid's coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// Its point nearest to the shape's centre.
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    /// Where `origin` is along the line in the world.
    pub(crate) start: f64,
    /// Bound on the error of points along it within the shape, per coordinate.
    pub(crate) error: DVec3,
    /// Where, from `origin`, it is certainly beyond the shape.
    pub(crate) reach: f64,
}

impl Member {
    /// Prepares a solid.
    pub(crate) fn new(
        shape: &Shape,
        world_from_solid: DAffine3,
        material: u32,
        positive: bool,
    ) -> Result<Self, Wrong> {
        let (surface, hull) = prepare(shape)?;
        let ball = match surface {
            Surface::Ball => (DVec3::ZERO, 1.0),
            _ => hull.ball(),
        };
        let m = world_from_solid.matrix3;
        // The columns are scaled to length 1 before the inverse, so that thin and long placements lose no
        // digits; what is left is how skew the axes are.
        let lengths = DVec3::new(m.x_axis.length(), m.y_axis.length(), m.z_axis.length());
        let per_metre = lengths.recip();
        let unit = DMat3::from_cols(m.x_axis / lengths.x, m.y_axis / lengths.y, m.z_axis / lengths.z);
        let (inverse, determinant) = (unit.inverse(), unit.determinant());
        // A column within 2^-40 of the plane of the others: nothing of a coordinate would be left.
        let usable = world_from_solid.is_finite() && inverse.is_finite() && per_metre.is_finite();
        if !usable || determinant.abs() < 1e-12 {
            return Err(Wrong::Placement);
        }
        let rows = inverse.transpose();
        let solid_from_world =
            DMat3::from_cols(rows.x_axis * per_metre.x, rows.y_axis * per_metre.y, rows.z_axis * per_metre.z)
                .transpose();
        let skew = frobenius(&inverse);
        let size = lengths.element_sum() * (ball.1 + ball.0.length());
        // Cofactors of unit columns are off by 2u each, the determinant by 6u, and both are divided by it; the
        // placement itself was rounded when it was made.
        let inverse_error = (6.0 + 6.0 * skew) * U / determinant.abs();
        let given = 4.0 * U * (world_from_solid.translation.abs().max_element() + size);
        let standing_error = inverse_error * size + skew * given;
        let nudge = solid_from_world * NUDGE;
        Ok(Self {
            surface,
            hull,
            ball,
            world_from_solid,
            solid_from_world,
            per_metre,
            skew,
            standing_error,
            nudge,
            material,
            positive,
        })
    }

    /// A point in the shape's coordinates.
    pub(crate) fn local(&self, point: DVec3) -> DVec3 {
        self.solid_from_world * (point - self.world_from_solid.translation)
    }

    /// A direction in the shape's coordinates.
    pub(crate) fn local_vector(&self, way: DVec3) -> DVec3 {
        self.solid_from_world * way
    }

    /// A point and two directions in the shape's coordinates.
    pub(crate) fn local_frame(&self, [origin, x, y]: [DVec3; 3]) -> [DVec3; 3] {
        [self.local(origin), self.local_vector(x), self.local_vector(y)]
    }

    /// The line in the shape's coordinates; none when it passes the shape's ball.
    ///
    /// With o' = M (o − c), d' = M d and t₀ = (b − o') · d' / d'², b the ball's centre, the new origin is
    /// o' + t₀ d'. Each of the products rounds with 3u ‖M‖ of its operand, the sum with u: 12 u covers all.
    pub(crate) fn line(&self, line: (DVec3, DVec3)) -> Option<Line> {
        let (centre, radius) = self.ball;
        let away = line.0 - self.world_from_solid.translation;
        let origin = self.solid_from_world * away;
        let direction = self.solid_from_world * line.1;
        let length2 = direction.length_squared();
        let start = (centre - origin).dot(direction) / length2;
        let nearest = origin + direction * start;
        let metres = 12.0 * U * self.skew * (away.length() + line.1.length() * start.abs());
        let error = self.per_metre * (metres + self.standing_error);
        let near = radius + error.length();
        let passes = (nearest - centre).length_squared() <= near * near * (1.0 + 8.0 * U);
        // A line that is not finite or goes nowhere is compared false here.
        passes.then(|| Line {
            origin: nearest,
            direction,
            start,
            error,
            reach: 2.0 * radius / length2.sqrt(),
        })
    }

    /// Whether it holds a point; none for points near its surface, to 1e-6 of its size.
    pub(crate) fn holds(&self, point: DVec3) -> Option<bool> {
        let beyond = self.surface.beyond(self.local(point)) / self.ball.1;
        // Said so that what is not a number is near.
        (beyond.abs() > 1e-6).then_some(beyond < 0.0)
    }

    /// Where the line is inside.
    pub(crate) fn chord(&self, line: (DVec3, DVec3)) -> Option<Chord> {
        let local = self.line(line)?;
        let mut chord = self.surface.chord(&local, self.nudge)?;
        for end in [&mut chord.enter, &mut chord.leave] {
            end.error += 2.0 * U * (local.start.abs() + end.t.abs());
            end.t += local.start;
        }
        Some(chord)
    }

    /// Outward unit normal of a face at a point of it \[world\].
    pub(crate) fn normal(&self, face: u32, point: DVec3) -> DVec3 {
        let gradient = self.surface.gradient(face, self.local(point));
        // Normals transform by the inverse transpose.
        (self.solid_from_world.transpose() * gradient).normalize_or_zero()
    }

    /// How fast the normal of a face turns along it at a point of it, at most \[rad/m\]; 0 for flat ones.
    ///
    /// By differences over a thousandth of the solid's size, in two directions along the face and between them.
    pub(crate) fn curvature(&self, face: u32, point: DVec3) -> f64 {
        if self.surface.is_flat(face) {
            return 0.0;
        }
        let normal = self.normal(face, point);
        let step = 1e-3 / self.per_metre.max_element();
        let (u, v) = normal.any_orthonormal_pair();
        let turned = |way: DVec3| {
            let turned = self.normal(face, point + way * step).distance(normal) / step;
            if turned.is_finite() { turned } else { 0.0 }
        };
        [u, v, (u + v) * FRAC_1_SQRT_2, (u - v) * FRAC_1_SQRT_2].into_iter().map(turned).fold(0.0, f64::max)
    }
}

fn frobenius(m: &DMat3) -> f64 {
    (m.x_axis.length_squared() + m.y_axis.length_squared() + m.z_axis.length_squared()).sqrt()
}

/// Its surface, and a polyhedron around it.
fn prepare(shape: &Shape) -> Result<(Surface, Solid), Wrong> {
    let frustum = |top: f64| {
        let surface = Surface::Frustum { taper: 1.0 - top };
        Ok((surface, hull::around_frustum(top)))
    };
    match shape {
        Shape::Sphere => Ok((Surface::Ball, hull::around_ball())),
        Shape::Cylinder => frustum(1.0),
        Shape::Cone => frustum(0.0),
        Shape::Frustum { top } if top.is_finite() && *top >= 0.0 => frustum(*top),
        Shape::Frustum { .. } => Err(Wrong::Top),
        Shape::Polyhedron(planes) => {
            let unit = |plane: &Plane| {
                let length = plane.normal.length();
                let normal = plane.normal / length;
                let offset = plane.offset / length;
                (normal.is_finite() && offset.is_finite()).then_some(Plane { normal, offset })
            };
            let planes: Option<Vec<Plane>> = planes.iter().map(unit).collect();
            let planes = planes.ok_or(Wrong::Plane)?;
            let hull = hull::polyhedron(&planes)?;
            Ok((Surface::Planes(planes.into()), hull))
        }
    }
}
