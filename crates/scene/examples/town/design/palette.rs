//! What things are made of.

/// A material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Stuff {
    Earth,
    Asphalt,
    Marking,
    Pavement,
    Slabs,
    Granite,
    Lawn,
    Hedge,
    Leaves,
    DarkLeaves,
    Bark,
    Glass,
    Water,
    WhiteConcrete,
    Sandstone,
    Terracotta,
    GreyPanel,
    CreamRender,
    OchreRender,
    Brick,
    Slate,
    RedTile,
    BrownTile,
    Timber,
    Steel,
}

impl Stuff {
    /// Its name in the file.
    pub(crate) fn name(self) -> &'static str {
        self.look().0
    }

    /// Reflectance in linear sRGB.
    pub(crate) fn colour(self) -> [f64; 3] {
        self.look().1
    }

    /// Whether it is polished: a dielectric of index 1.5. All others reflect their colour and nothing else.
    pub(crate) fn polished(self) -> bool {
        matches!(self, Self::Glass | Self::Water)
    }

    fn look(self) -> (&'static str, [f64; 3]) {
        match self {
            Self::Earth => ("earth", [0.2, 0.2, 0.2]),
            Self::Asphalt => ("asphalt", [0.13, 0.13, 0.135]),
            Self::Marking => ("road marking", [0.6, 0.6, 0.58]),
            Self::Pavement => ("pavement", [0.33, 0.32, 0.3]),
            Self::Slabs => ("pale slabs", [0.5, 0.47, 0.42]),
            Self::Granite => ("granite", [0.4, 0.385, 0.37]),
            Self::Lawn => ("lawn", [0.1, 0.17, 0.05]),
            Self::Hedge => ("hedge", [0.07, 0.125, 0.04]),
            Self::Leaves => ("leaves", [0.11, 0.175, 0.055]),
            Self::DarkLeaves => ("dark leaves", [0.08, 0.13, 0.05]),
            Self::Bark => ("bark", [0.14, 0.11, 0.085]),
            Self::Glass => ("window glass", [0.055, 0.068, 0.075]),
            Self::Water => ("water", [0.03, 0.045, 0.045]),
            Self::WhiteConcrete => ("white concrete", [0.62, 0.61, 0.58]),
            Self::Sandstone => ("sandstone", [0.52, 0.44, 0.34]),
            Self::Terracotta => ("terracotta", [0.4, 0.235, 0.16]),
            Self::GreyPanel => ("grey panel", [0.36, 0.38, 0.4]),
            Self::CreamRender => ("cream render", [0.66, 0.6, 0.49]),
            Self::OchreRender => ("ochre render", [0.55, 0.4, 0.23]),
            Self::Brick => ("brick", [0.29, 0.155, 0.11]),
            Self::Slate => ("slate", [0.13, 0.14, 0.16]),
            Self::RedTile => ("red tile", [0.3, 0.125, 0.08]),
            Self::BrownTile => ("brown tile", [0.19, 0.125, 0.095]),
            Self::Timber => ("timber", [0.3, 0.2, 0.12]),
            Self::Steel => ("steel", [0.2, 0.2, 0.21]),
        }
    }
}
