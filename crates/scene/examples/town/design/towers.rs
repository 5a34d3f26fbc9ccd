//! Five towers on podiums around the square.

use super::palette::Stuff;
use super::shapes::Shape;
use super::site::{Lot, Site};

/// Height of a storey \[m\].
const STOREY: f64 = 3.9;

/// What the walls are made of besides glass.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Skin {
    /// A slab around every storey, piers at the corners.
    Bands,
    /// Fins from foot to top.
    Fins,
    /// Slabs around every other storey, and fins.
    Grid,
}

struct Tower {
    name: &'static str,
    lot: Lot,
    /// Width and depth of the lowest part \[m\].
    size: [f64; 2],
    /// How much the podium is wider and deeper, and its height \[m\].
    podium: [f64; 3],
    /// Each part's top \[m\], and how much narrower and less deep it is than the lowest.
    parts: &'static [(f64, [f64; 2])],
    skin: Skin,
    stuff: Stuff,
    podium_stuff: Stuff,
}

const TOWERS: [Tower; 5] = [
    Tower {
        name: "tower A",
        lot: lot(-66.0, -44.0, 0.0),
        size: [32.0, 28.0],
        podium: [24.0, 22.0, 12.0],
        parts: &[(62.0, [0.0, 0.0]), (93.0, [6.0, 5.0]), (118.0, [13.0, 10.0])],
        skin: Skin::Bands,
        stuff: Stuff::WhiteConcrete,
        podium_stuff: Stuff::Sandstone,
    },
    Tower {
        name: "tower B",
        lot: lot(0.0, -54.0, 0.0),
        size: [46.0, 22.0],
        podium: [12.0, 12.0, 9.0],
        parts: &[(74.0, [0.0, 0.0]), (92.0, [10.0, 4.0])],
        skin: Skin::Fins,
        stuff: Stuff::Sandstone,
        podium_stuff: Stuff::Granite,
    },
    Tower {
        name: "tower C",
        lot: lot(64.0, -42.0, 0.0),
        size: [30.0, 32.0],
        podium: [22.0, 22.0, 12.0],
        parts: &[(70.0, [0.0, 0.0]), (104.0, [8.0, 8.0])],
        skin: Skin::Bands,
        stuff: Stuff::GreyPanel,
        podium_stuff: Stuff::Granite,
    },
    Tower {
        name: "tower D",
        lot: lot(-70.0, 38.0, 0.0),
        size: [26.0, 40.0],
        podium: [18.0, 20.0, 9.0],
        parts: &[(64.0, [0.0, 0.0])],
        skin: Skin::Grid,
        stuff: Stuff::Terracotta,
        podium_stuff: Stuff::Brick,
    },
    Tower {
        name: "tower E",
        lot: lot(69.0, 41.0, 14.0),
        size: [28.0, 28.0],
        podium: [14.0, 14.0, 9.0],
        parts: &[(58.0, [0.0, 0.0]), (78.0, [7.0, 7.0])],
        skin: Skin::Bands,
        stuff: Stuff::CreamRender,
        podium_stuff: Stuff::Sandstone,
    },
];

const fn lot(x: f64, z: f64, turn: f64) -> Lot {
    Lot { at: [x, z], turn }
}

/// All of them.
pub(crate) fn build(site: &mut Site) {
    for tower in &TOWERS {
        site.group(tower.name);
        podium(site, tower);
        let mut low = tower.podium[2];
        for &(top, less) in tower.parts {
            let size = [tower.size[0] - less[0], tower.size[1] - less[1]];
            part(site, tower, [low, top], size);
            low = top;
        }
        crown(site, tower, low);
    }
}

/// Shops behind columns below a solid storey or two, a garden on the roof.
fn podium(site: &mut Site, tower: &Tower) {
    let (lot, [more_wide, more_deep, height]) = (tower.lot, tower.podium);
    let [wide, deep] = [tower.size[0] + more_wide, tower.size[1] + more_deep];
    lot.block(site, Stuff::Glass, [0.0, 0.0], [0.0, 5.2], [wide - 4.0, deep - 4.0]);
    lot.block(site, tower.podium_stuff, [0.0, 0.0], [4.8, height], [wide, deep]);
    let columns = (wide / 9.0).round();
    for i in 0..=columns as u32 {
        // Through the whole building: a column at either end.
        let x = (wide - 2.2) * (f64::from(i) / columns - 0.5);
        lot.block(site, tower.podium_stuff, [x, 0.0], [0.05, 4.9], [0.9, deep - 1.2]);
    }
    if height > 10.0 {
        lot.block(site, Stuff::Glass, [0.0, 0.0], [7.2, 9.6], [wide + 0.1, deep + 0.1]);
    }
    lot.block(site, Stuff::Granite, [0.0, 0.0], [height - 0.3, height + 0.9], [wide + 0.3, deep + 0.3]);
    lot.block(site, Stuff::Lawn, [0.0, 0.0], [height, height + 0.95], [wide - 1.2, deep - 1.2]);
}

/// One part between two setbacks.
fn part(site: &mut Site, tower: &Tower, [low, top]: [f64; 2], [wide, deep]: [f64; 2]) {
    let lot = tower.lot;
    lot.block(site, Stuff::Glass, [0.0, 0.0], [low, top], [wide, deep]);
    if tower.skin != Skin::Bands {
        fins(site, tower, [low, top], [wide, deep]);
    }
    if tower.skin != Skin::Fins {
        bands(site, tower, [low, top], [wide, deep]);
    }
    // The parapet stands out a little more than the bands and less than piers and fins.
    lot.block(site, tower.stuff, [0.0, 0.0], [top - 1.3, top + 0.9], [wide + 0.7, deep + 0.7]);
    lot.block(site, Stuff::Granite, [0.0, 0.0], [top, top + 0.94], [wide - 0.6, deep - 0.6]);
}

fn bands(site: &mut Site, tower: &Tower, [low, top]: [f64; 2], [wide, deep]: [f64; 2]) {
    let storeys = if tower.skin == Skin::Grid { 2.0 } else { 1.0 };
    let count = ((top - low - 2.5) / (storeys * STOREY)) as u32;
    for i in 1..=count {
        let y = low + storeys * STOREY * f64::from(i);
        tower.lot.block(site, tower.stuff, [0.0, 0.0], [y - 0.9, y + 0.35], [wide + 0.5, deep + 0.5]);
    }
    if tower.skin == Skin::Bands {
        let [x, z] = [0.5 * wide - 0.4, 0.5 * deep - 0.4];
        for [x, z] in [[x, z], [-x, z], [x, -z], [-x, -z]] {
            tower.lot.block(site, tower.stuff, [x, z], [low, top + 0.3], [1.8, 1.8]);
        }
    }
}

/// Each goes through the whole building: a fin on either side.
fn fins(site: &mut Site, tower: &Tower, [low, top]: [f64; 2], [wide, deep]: [f64; 2]) {
    let mut along = |length: f64, across_x: bool| {
        let count = (length / 4.6).round();
        for i in 0..=count as u32 {
            let at = (length - 0.5) * (f64::from(i) / count - 0.5);
            // Fins that cross do not end in one plane.
            let (middle, size, over) = if across_x {
                ([0.0, at], [wide + 1.2, 0.42], 0.26)
            } else {
                ([at, 0.0], [0.42, deep + 1.2], 0.2)
            };
            tower.lot.block(site, tower.stuff, middle, [low, top + over], size);
        }
    };
    along(wide, false);
    along(deep, true);
}

/// What stands on the roof.
fn crown(site: &mut Site, tower: &Tower, top: f64) {
    let [wide, deep] = tower.size;
    let lot = tower.lot;
    lot.block(site, Stuff::GreyPanel, [0.0, 0.0], [top, top + 4.2], [0.3 * wide, 0.3 * deep]);
    lot.block(site, Stuff::Steel, [0.07 * wide, 0.0], [top, top + 5.6], [0.1 * wide, 0.16 * deep]);
    if top > 110.0 {
        lot.put(site, (Shape::Prism, Stuff::Steel), [0.0, top + 4.0, 0.0], [0.5, 14.0, 0.5]);
    }
}
