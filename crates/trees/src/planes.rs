//! The planes of one tree, set for an eye or for a light (thesis 5.2).
//!
//! Everything here is in the tree's own metres: its foot at the origin, +Y up, as high as its species was made.

use glam::{Vec2, Vec3};

use crate::species::Species;
use crate::stand::Placed;

/// How planes fade with the angle θ between their normal and the direction to the viewer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fade {
    /// Opacity cos θ (thesis 5.1: t = 1 − cos θ): planes seen under 45° have 0.71 each, and crowns turn translucent.
    Thesis,
    /// Opacity min(1, cos θ / sin θ): the plane that faces the viewer best is wholly there, the other fades out with the
    /// tangent. At 45° both are whole: right for crowns that let nothing through, too dark for others.
    Opaque,
    /// Opacity (1 − (1 − ᾱ)^cos θ) / ᾱ with the mean alpha ᾱ of the species' crown: cos θ shares the crown's optical depth between the
    /// planes. Thin crowns get the thesis' cosines, of which cos² + sin² = 1 hides as much from everywhere; dense ones
    /// stay opaque at 45°. Continuous in θ. Seen from 30° and 60° the trees of `examples/planes_against_mesh` hide 0.98 to 1.05 of what
    /// their meshes hide, with the thesis' fade 0.90 to 1.00, with [`Fade::Opaque`] 0.98 to 1.10.
    #[default]
    Density,
}

/// Crowns count as at most so opaque: the opacity of a plane still begins at 0, steeply.
const DENSEST: f32 = 0.98;

impl Fade {
    /// Opacity of a plane whose normal has |cosine| `cos` to the viewer, within \[0, 1\], for a crown of mean alpha `mean`.
    pub fn opacity(self, cos: f32, mean: f32) -> f32 {
        let cos = cos.clamp(0.0, 1.0);
        match self {
            Self::Thesis => cos,
            Self::Opaque => cos / cos.max((1.0 - cos * cos).sqrt()),
            Self::Density => {
                let mean = mean.clamp(1e-3, DENSEST);
                ((1.0 - (1.0 - mean).powf(cos)) / mean).min(1.0)
            }
        }
    }
}

/// Which way the pictures on the horizontal planes lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Turn {
    /// They turn in step with the vertical plane (thesis 5.2.1).
    WithEye,
    /// They stay, each tree's turned as it was planted: nothing spins where one looks straight down.
    #[default]
    Fixed,
}

/// How planes are set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Setting {
    /// How they fade with the angle.
    pub fade: Fade,
    /// Whether horizontal planes turn.
    pub turn: Turn,
}

/// What planes are set for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Aim {
    /// An eye at a point.
    Eye(Vec3),
    /// Rays along a unit vector between two points, either of which may be the lamp: both senses of it set the same planes.
    Along(Vec3),
    /// Parallel rays towards a sun, or an orthographic eye, along a unit vector: nothing turns over as it goes round.
    Toward(Vec3),
}

/// The planes of a tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planes {
    aim: Aim,
    setting: Setting,
    /// Mean alpha of the crown.
    mean: f32,
    /// Horizontal unit vector, the vertical plane's normal.
    pub(crate) facing: Vec3,
    /// How the tree is turned \[rad\].
    rotation: f32,
    /// +1, or −1 where the side view is mirrored.
    hand: f32,
}

/// Where a line crosses a plane that is there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cross {
    /// Along the line \[m\].
    pub(crate) t: f32,
    /// Which slice; none = the vertical plane.
    pub(crate) slice: Option<u32>,
    /// On the picture, within \[0, 1\]².
    pub(crate) uv: Vec2,
    /// On the plane \[m\].
    pub(crate) at: Vec2,
    /// What the plane leaves of its picture's alpha, > 0.
    pub(crate) opacity: f32,
    /// |cos| between the line and the plane's normal.
    pub(crate) cos: f32,
}

impl Planes {
    pub(crate) fn new(species: &Species, placed: &Placed, aim: Aim, setting: Setting) -> Self {
        let middle = Vec3::Y * (0.5 * species.description().height);
        let toward = match aim {
            Aim::Eye(eye) => eye - middle,
            Aim::Along(direction) | Aim::Toward(direction) => direction,
        };
        let level = Vec3::new(toward.x, 0.0, toward.z).try_normalize().unwrap_or(Vec3::Z);
        // The two senses of a direction set the same plane and picture: whatever light does not care about.
        let backward = matches!(aim, Aim::Along(_)) && (level.z < 0.0 || (level.z == 0.0 && level.x < 0.0));
        let facing = if backward { -level } else { level };
        Self {
            aim,
            setting,
            mean: species.mean_alpha,
            facing,
            rotation: placed.rotation,
            hand: if placed.rotation < 0.0 { -1.0 } else { 1.0 },
        }
    }

    /// Columns of slices' pictures run along this horizontal unit vector (x, z), their rows down along its perpendicular.
    fn lying(&self) -> Vec2 {
        let turned = match self.setting.turn {
            Turn::WithEye => Vec2::new(self.facing.z, -self.facing.x),
            Turn::Fixed => Vec2::X,
        };
        Vec2::from_angle(self.rotation).rotate(turned)
    }

    /// Opacity of a plane of unit normal `normal` about `centre`.
    fn opacity(&self, normal: Vec3, centre: Vec3) -> f32 {
        let toward = match self.aim {
            Aim::Eye(eye) => (eye - centre).normalize_or(normal),
            Aim::Along(direction) | Aim::Toward(direction) => direction,
        };
        self.setting.fade.opacity(toward.dot(normal).abs(), self.mean)
    }

    /// Every crossing of `origin` + t `direction` with a plane that is there, 0 < t < `reach`, in any order.
    pub(crate) fn cross(
        &self,
        species: &Species,
        (origin, direction): (Vec3, Vec3),
        reach: f32,
        mut receive: impl FnMut(Cross),
    ) {
        let tree = species.description();
        let (width, height) = (2.0 * tree.half_width, tree.height);
        let ahead = |t: f32| t > 0.0 && t < reach;

        let cos = direction.dot(self.facing);
        let t = -origin.dot(self.facing) / cos;
        if ahead(t) {
            let point = origin + direction * t;
            let at = Vec2::new((point.x * self.facing.z - point.z * self.facing.x) * self.hand, point.y);
            let uv = Vec2::new(0.5 + at.x / width, 1.0 - at.y / height);
            if within(uv) {
                let opacity = self.opacity(self.facing, Vec3::Y * (0.5 * height));
                if opacity > 0.0 {
                    receive(Cross { t, slice: None, uv, at, opacity, cos: cos.abs() });
                }
            }
        }
        // Found where the first slice is met: most lines meet none. Parallel rays have one opacity for all slices.
        let mut met: Option<(Vec2, f32)> = None;
        for (i, slice) in tree.slices.iter().enumerate() {
            let t = (slice.height - origin.y) / direction.y;
            if !ahead(t) {
                continue;
            }
            let point = origin + direction * t;
            let level = Vec2::new(point.x, point.z);
            // Their corners are beyond what any direction's side view shows.
            if level.length_squared() >= tree.half_width * tree.half_width {
                continue;
            }
            let here = || self.opacity(Vec3::Y, Vec3::Y * slice.height);
            let (lying, first) = *met.get_or_insert_with(|| (self.lying(), here()));
            let opacity = if matches!(self.aim, Aim::Eye(_)) { here() } else { first };
            let at = Vec2::new(level.dot(lying), level.dot(lying.perp()));
            let uv = at / width + 0.5;
            if opacity > 0.0 {
                receive(Cross { t, slice: Some(i as u32), uv, at, opacity, cos: direction.y.abs() });
            }
        }
    }

    /// Share of light that all planes let pass along a stretch, whose bundle widens by `spread` for every metre.
    pub(crate) fn transmittance(
        &self,
        species: &Species,
        line: (Vec3, Vec3),
        (reach, spread): (f32, f32),
    ) -> f32 {
        let mut left = 1.0;
        self.cross(species, line, reach, |cross| {
            let texels = if spread > 0.0 { cross.texels(species, cross.t * spread) } else { 0.0 };
            left *= 1.0 - cross.opacity * cross.sheet(species).alpha(cross.uv, texels);
        });
        left
    }
}

impl Cross {
    pub(crate) fn sheet<'a>(&self, species: &'a Species) -> &'a crate::Sheet {
        let tree = species.description();
        self.slice.map_or(&tree.side, |i| &tree.slices[i as usize].sheet)
    }

    /// Texels that a bundle `width` \[m\] wide covers: the mean of its two axes on a plane that it meets at a slant.
    pub(crate) fn texels(&self, species: &Species, width: f32) -> f32 {
        let tree = species.description();
        let per_metre = match self.slice {
            None => species.texels_per_metre,
            Some(i) => tree.slices[i as usize].sheet.size()[0] as f32 / (2.0 * tree.half_width),
        };
        // Flatter than 6° a plane has faded anyway.
        width * per_metre / self.cos.max(0.1).sqrt()
    }
}

fn within(uv: Vec2) -> bool {
    uv.cmpge(Vec2::ZERO).all() && uv.cmple(Vec2::ONE).all()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::species::tests::plain;

    const HERE: Placed = Placed { species: 0, position: Vec3::ZERO, height: 10.0, rotation: 0.0 };

    fn opacities(eye: Vec3, fade: Fade) -> (Vec<Cross>, Planes) {
        let species = Species::new(plain(200)).unwrap();
        let setting = Setting { fade, turn: Turn::WithEye };
        let planes = Planes::new(&species, &HERE, Aim::Eye(eye), setting);
        let mut met = Vec::new();
        let direction = (Vec3::new(0.0, 6.0, 0.0) - eye).normalize();
        planes.cross(&species, (eye, direction), f32::INFINITY, |cross| met.push(cross));
        (met, planes)
    }

    #[test]
    fn from_the_side_only_the_vertical_plane_shows_and_from_above_only_the_others() {
        // The plane's centre is 5 m high.
        let (side, planes) = opacities(Vec3::new(30.0, 5.0, 40.0), Fade::Thesis);
        assert!((planes.facing - Vec3::new(0.6, 0.0, 0.8)).length() < 1e-6);
        let vertical = side.iter().find(|cross| cross.slice.is_none()).unwrap();
        assert!((vertical.opacity - 1.0).abs() < 1e-6 && (vertical.t - 50.0).abs() < 0.1);
        assert!(side.iter().all(|cross| cross.slice.is_none() || cross.opacity < 0.1));
        let (above, _) = opacities(Vec3::new(0.0, 100.0, 0.0), Fade::Thesis);
        assert_eq!(above.len(), 3);
        assert!(above.iter().all(|cross| cross.slice.is_some() && (cross.opacity - 1.0).abs() < 1e-6));
    }

    #[test]
    fn opacities_are_the_cosines_of_the_thesis() {
        let cos = std::f32::consts::FRAC_1_SQRT_2;
        assert_eq!(Fade::Thesis.opacity(cos, 0.5), cos);
        assert_eq!([0.0, 1.0].map(|cos| Fade::Opaque.opacity(cos, 0.5)), [0.0, 1.0]);
        // tan 45° = 1 up to the rounding of its sine.
        assert!((Fade::Opaque.opacity(cos, 0.5) - 1.0).abs() < 1e-6);
        assert!((Fade::Opaque.opacity(0.5, 0.5) - 0.5 / 0.75f32.sqrt()).abs() < 1e-6);
        // 1 − (1/4)^½ = 1/2.
        assert!((Fade::Density.opacity(0.5, 0.75) - 0.5 / 0.75).abs() < 1e-6);
        assert_eq!([0.0, 1.0].map(|cos| Fade::Density.opacity(cos, 0.75)), [0.0, 1.0]);
        // Thin crowns: the thesis', to the first order of alpha.
        assert!((Fade::Density.opacity(cos, 0.01) - cos).abs() < 0.01);
    }

    #[test]
    fn shadows_do_not_turn_over_as_the_sun_goes_round() {
        let species = Species::new(plain(200)).unwrap();
        let planes = |z: f32| {
            let sun = Vec3::new(1.0, 0.6, z).normalize();
            Planes::new(&species, &HERE, Aim::Toward(sun), Setting::default()).facing
        };
        // Due east, from a little north to a little south of it.
        assert!((planes(1e-3) - planes(-1e-3)).length() < 3e-3);
    }

    #[test]
    fn light_that_goes_the_other_way_meets_the_same_planes() {
        let species = Species::new(plain(200)).unwrap();
        for direction in [Vec3::new(0.48, -0.6, 0.64), Vec3::new(-0.8, 0.0, 0.6), Vec3::X, Vec3::NEG_Y] {
            for turn in [Turn::WithEye, Turn::Fixed] {
                let setting = Setting { fade: Fade::Thesis, turn };
                let (from, to) = (Vec3::Y * 6.3 - direction * 20.0, Vec3::Y * 6.3 + direction * 20.0);
                let one = Planes::new(&species, &HERE, Aim::Along(direction), setting);
                let two = Planes::new(&species, &HERE, Aim::Along(-direction), setting);
                let there = one.transmittance(&species, (from, direction), (40.0, 0.0));
                let back = two.transmittance(&species, (to, -direction), (40.0, 0.0));
                // Points at distances of 20 m are a few 1e-6 m off, on pictures of 12 cm a texel.
                assert!(there < 0.9 && (there - back).abs() < 1e-4, "{there} {back}");
            }
        }
    }
}
