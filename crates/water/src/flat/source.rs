//! Sources of light, and parts of it.

use glam::DVec3;
use light::AreaLight;

/// What kind of source it is, which says how its light finds its way through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Far away in the direction of this unit vector: the sun.
    Toward(DVec3),
    /// A luminaire at this point \[m\].
    At(DVec3),
    /// A lamp with an extent: as it says itself where its light meets no surface; elsewhere as many points as it has samples.
    Area(AreaLight),
    /// All around: sky and ground.
    Around,
}

impl Source {
    /// Where a lamp is; none for what is far away.
    pub(crate) fn lamp(&self) -> Option<DVec3> {
        match self {
            Self::At(at) => Some(*at),
            Self::Area(lamp) => Some(lamp.centre.as_dvec3()),
            Self::Toward(_) | Self::Around => None,
        }
    }
}

/// Which part of a source's light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Part {
    /// All of it.
    #[default]
    All,
    /// What meets no water surface.
    Direct,
    /// What a water surface reflects, from above or from below.
    Reflected,
    /// What passes a water surface.
    Through,
}

impl Part {
    /// Whether this part belongs to what is asked for.
    pub(crate) fn has(self, part: Self) -> bool {
        self == Self::All || self == part
    }
}
