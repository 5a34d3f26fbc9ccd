//! Blocks of flats of five to eight storeys around green yards.

use super::palette::Stuff;
use super::site::{Lot, Site};
use super::streets::{FLATS, extent};

const STOREY: f64 = 3.1;

/// All of them: two rows in each block, along its north and south side.
pub(crate) fn build(site: &mut Site) {
    for (i, rectangle) in FLATS.iter().enumerate() {
        site.group(format!("flats {}", i + 1));
        let ([x, z], [wide, deep]) = extent(*rectangle);
        for side in [-1.0, 1.0] {
            let lot = Lot { at: [x, z + side * (0.5 * deep - 13.0)], turn: 0.0 };
            building(site, lot, [wide - 16.0 - site_less(side), 14.0]);
        }
        for _ in 0..2 {
            let at = [x + site.between(-0.35, 0.35) * wide, z + site.between(-6.0, 6.0)];
            let height = site.between(9.0, 13.0);
            site.tree(at, height);
        }
    }
}

/// The northern row is shorter \[m\].
fn site_less(side: f64) -> f64 {
    if side < 0.0 { 18.0 } else { 0.0 }
}

fn building(site: &mut Site, lot: Lot, [wide, deep]: [f64; 2]) {
    let storeys = site.between(5.0, 8.99) as u32;
    let stuff = site.one_of(&[
        Stuff::CreamRender,
        Stuff::OchreRender,
        Stuff::Brick,
        Stuff::WhiteConcrete,
        Stuff::GreyPanel,
    ]);
    let top = 0.2 + STOREY * f64::from(storeys);
    lot.block(site, Stuff::Glass, [0.0, 0.0], [0.0, top], [wide, deep]);
    for i in 0..storeys {
        let y = 0.2 + STOREY * f64::from(i);
        let low = if i == 0 { 0.05 } else { y - 0.5 };
        lot.block(site, stuff, [0.0, 0.0], [low, y + 0.95], [wide + 0.3, deep + 0.3]);
    }
    lot.block(site, stuff, [0.0, 0.0], [top - 0.6, top + 0.7], [wide + 0.36, deep + 0.36]);
    for x in [-0.5, 0.0, 0.5] {
        // Walls between the flats, through the building.
        lot.block(site, stuff, [x * (wide - 1.5), 0.0], [0.02, top + 0.5], [2.4, deep + 0.44]);
    }
    lot.block(site, Stuff::Slate, [0.0, 0.0], [top, top + 0.74], [wide - 0.6, deep - 0.6]);
}
