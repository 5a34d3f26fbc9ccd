//! Low houses with gabled roofs, in gardens.

use super::palette::Stuff;
use super::shapes::Shape;
use super::site::{Lot, Site};
use super::streets::{HOUSES, extent};

/// All of them: two rows in each block, towards its streets, and trees behind.
pub(crate) fn build(site: &mut Site) {
    for (i, rectangle) in HOUSES.iter().enumerate() {
        site.group(format!("houses {}", i + 1));
        let ([x, z], [wide, deep]) = extent(*rectangle);
        let count = ((wide - 8.0) / 16.5) as u32;
        let pitch = (wide - 8.0) / f64::from(count);
        for side in [-1.0, 1.0] {
            for k in 0..count {
                let along = (f64::from(k) + 0.5) * pitch - 0.5 * (wide - 8.0);
                let set_back = site.between(11.5, 14.0);
                let at = [x + along + site.between(-1.0, 1.0), z + side * (0.5 * deep - set_back)];
                let quarter = site.one_of(&[0.0, 0.0, 90.0]);
                let turn = quarter + if side < 0.0 { 180.0 } else { 0.0 } + site.between(-3.0, 3.0);
                house(site, Lot { at, turn });
            }
        }
        for k in 0..2 {
            let along = (f64::from(k) - 0.5) * 0.4 * wide + site.between(-5.0, 5.0);
            let height = site.between(6.0, 11.0);
            let behind = site.between(-0.12, 0.12) * deep;
            site.tree([x + along, z + behind], height);
        }
    }
}

fn house(site: &mut Site, lot: Lot) {
    let size = [site.between(9.5, 12.0), site.between(7.0, 8.6), site.between(8.0, 9.8)];
    let walls = site.one_of(&[
        Stuff::CreamRender,
        Stuff::WhiteConcrete,
        Stuff::OchreRender,
        Stuff::Brick,
        Stuff::CreamRender,
    ]);
    let tiles = site.one_of(&[Stuff::Slate, Stuff::RedTile, Stuff::BrownTile, Stuff::BrownTile]);
    let base = [0.0, 0.1, 0.0];
    lot.put(site, (Shape::House, walls), base, size);
    lot.put(site, (Shape::Roof, tiles), base, size);
    lot.put(site, (Shape::Windows, Stuff::Glass), base, size);
}
