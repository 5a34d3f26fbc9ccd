//! Shadow planes: what a stand lets through of light (thesis 5.3.3).

use glam::{DVec3, Vec2, Vec3};
use light::{Occlude, PointSource, Ray, Spectrum, Stretch};

use crate::hierarchy::{self, Probe};
use crate::planes::{Aim, Planes};
use crate::stand::Stand;

/// How a bundle widens that goes to the sky \[rad\]: half the sun's disc, in which its penumbra lies and which no direction of the sky resolves.
const PENUMBRA: f32 = 0.0047;

/// Less than this counts as nothing.
const DARK: f64 = 1e-5;

impl Stand {
    /// Share of light that one tree lets through along a segment.
    ///
    /// Planes are set for the segment's own direction, which is the sun's; a lamp's differ over a tree as its rays do. Where
    /// an end lies in the tree itself (a leaf, its trunk, a bench under its branches), no plane can tell what is
    /// between: there the crown is a cloud of leaves (Lambert-Beer in the envelope).
    pub(crate) fn through(&self, tree: u32, segment: &Ray) -> f32 {
        let (species, placed, line, scale) = self.local(tree, segment);
        let reach = segment.length / scale;
        // Boxes have corners; planes turn in a cylinder.
        let tree = species.description();
        if !meets_cylinder(line, reach, [tree.half_width * WIDER, tree.height * WIDER]) {
            return 1.0;
        }
        let ends_inside = reach.is_finite() && species.holds(line.0 + line.1 * reach);
        if ends_inside || species.holds(line.0) {
            return species.through_crown(line.0, line.1, reach);
        }
        let spread = if reach.is_finite() { 0.0 } else { PENUMBRA };
        let aim = if reach.is_finite() { Aim::Along(line.1) } else { Aim::Toward(line.1) };
        Planes::new(species, placed, aim, self.setting).transmittance(species, line, (reach, spread))
    }
}

/// Cylinders are taken as so much larger, for roundings.
const WIDER: f32 = 1.0001;

/// Whether a stretch of a line meets an upright cylinder on the origin, of a radius and a height \[m\].
fn meets_cylinder((origin, direction): (Vec3, Vec3), reach: f32, [radius, height]: [f32; 2]) -> bool {
    // Where it is between the ground and the top; NaN of 0/0, along a border, is passed over by min and max.
    let [a, b] = [-(WIDER - 1.0) * height, height].map(|y| (y - origin.y) / direction.y);
    let (from, to) = (a.min(b).max(0.0), a.max(b).min(reach));
    // Where it is within the radius.
    let (at, level) = (Vec2::new(origin.x, origin.z), Vec2::new(direction.x, direction.z));
    let square = level.length_squared();
    let room = radius * radius * square - at.perp_dot(level).powi(2);
    if room < 0.0 || (square == 0.0 && at.length_squared() > radius * radius) {
        return false;
    }
    let (middle, half) =
        if square > 0.0 { (-at.dot(level) / square, room.sqrt() / square) } else { (0.0, f32::INFINITY) };
    from.max(middle - half) <= to.min(middle + half) * WIDER
}

impl Occlude for Stand {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        // f64, so that the order of the product does not show in f32.
        let mut left = 1.0f64;
        hierarchy::walk(&self.nodes, &Probe::new(segment), |tree| {
            left *= f64::from(self.through(tree, segment));
            left > DARK
        });
        Spectrum::splat(if left > DARK { left as f32 } else { 0.0 })
    }

    /// No stretch is wholly dark behind leaves: those that a tree may shade are reported as such, around the sphere
    /// that holds it.
    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        let meets = |low: Vec3, high: Vec3| shade(source, a, b, low.as_dvec3(), high.as_dvec3());
        let mut found: Vec<[f64; 2]> = Vec::new();
        hierarchy::select(
            &self.nodes,
            |low, high| meets(low, high).is_some(),
            |tree| {
                let placed = &self.trees[tree as usize];
                let [low, high] = hierarchy::bounds(placed, &self.species[placed.species as usize]);
                found.extend(meets(low, high));
                true
            },
        );
        found.sort_by(|p, q| p[0].total_cmp(&q[0]));
        let mut joined: Option<[f64; 2]> = None;
        let mut stretch = |[from, to]: [f64; 2]| out.push(Stretch { from, to, dark: false });
        for next in found {
            match &mut joined {
                Some(so_far) if next[0] <= so_far[1] => so_far[1] = so_far[1].max(next[1]),
                _ => joined.replace(next).into_iter().for_each(&mut stretch),
            }
        }
        joined.into_iter().for_each(&mut stretch);
        true
    }
}

/// The part of the segment from `a` to `b` that the sphere around a box may shade, as shares of the way; none = no part.
///
/// A point p is in the shadow of a sphere (c, r) where the way from it to the source comes nearer to c than r:
///
///   sun:  |w − (w·d) d| < r and w·d > −r,   w = c − p;   lamp at l: p in the cone from l around the sphere
fn shade(source: &PointSource, a: DVec3, b: DVec3, low: DVec3, high: DVec3) -> Option<[f64; 2]> {
    let centre = 0.5 * (low + high);
    // A thousandth for roundings here and of the trees' own f32.
    let radius = 0.5 * (high - low).length() * 1.001;
    let (from, way) = (a - centre, b - a);
    match *source {
        PointSource::Toward(toward) | PointSource::Below { toward, .. } => {
            let flat = |v: DVec3| v - toward * v.dot(toward);
            let [start, end] = disc(flat(from), flat(way), radius)?;
            // Beyond the sphere, seen from the sun: −w·d < r along the whole part means it is lit.
            let beyond = |t: f64| (from + way * t).dot(toward) < radius;
            (beyond(start) || beyond(end)).then_some([start, end])
        }
        PointSource::At(lamp) => cone(from, way, lamp - centre, radius),
    }
}

/// Where |start + t way| < radius, t within \[0, 1\].
fn disc(start: DVec3, way: DVec3, radius: f64) -> Option<[f64; 2]> {
    let (a, b, c) = (way.length_squared(), start.dot(way), start.length_squared() - radius * radius);
    if a == 0.0 {
        return (c < 0.0).then_some([0.0, 1.0]);
    }
    let discriminant = b * b - a * c;
    if discriminant <= 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let (from, to) = (((-b - root) / a).max(0.0), ((-b + root) / a).min(1.0));
    (from < to).then_some([from, to])
}

/// A part of the segment that holds all of it that a sphere about the origin shades from `lamp`: where the segment comes
/// near the plane's triangle with the lamp, all of it.
fn cone(from: DVec3, way: DVec3, lamp: DVec3, radius: f64) -> Option<[f64; 2]> {
    let normal = (from - lamp).cross(way).try_normalize();
    let apart = normal.is_some_and(|normal| lamp.dot(normal).abs() > radius);
    // Beyond the sphere as seen from the lamp, or beside it: the sphere in front of the lamp's half-space towards it.
    let reaches = [from, from + way].iter().any(|p| (*p - lamp).length() + radius > lamp.length());
    (!apart && reaches).then_some([0.0, 1.0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planes::Setting;
    use crate::region::random;
    use crate::species::tests::plain;
    use crate::{Placed, Species};

    #[test]
    fn lines_that_miss_the_cylinder_meet_no_plane() {
        let species = Species::new(plain(200)).unwrap();
        let here = Placed { species: 0, position: Vec3::ZERO, height: 10.0, rotation: 0.3 };
        let size = [species.description().half_width * WIDER, species.description().height * WIDER];
        let (mut missed, mut shaded) = (0, 0);
        for i in 0..4000 {
            let at = |k: u32, low: f32, high: f32| low + (high - low) * random(i, k);
            let origin = Vec3::new(at(1, -12.0, 12.0), at(2, -3.0, 14.0), at(3, -12.0, 12.0));
            let direction = Vec3::new(at(4, -1.0, 1.0), at(5, -1.0, 1.0), at(6, -1.0, 1.0)).normalize();
            let reach = at(7, 0.0, 30.0);
            let planes = Planes::new(&species, &here, Aim::Toward(direction), Setting::default());
            let left = planes.transmittance(&species, (origin, direction), (reach, 0.0));
            let meets = meets_cylinder((origin, direction), reach, size);
            assert!(meets || left == 1.0, "{origin} {direction} {reach}: {left}");
            missed += u32::from(!meets);
            shaded += u32::from(left < 1.0);
        }
        assert!(missed > 1000 && shaded > 100, "{missed} {shaded}");
    }
}
