//! The ground: carriageways, raised blocks, markings; and what stands along the streets.

use super::palette::Stuff;
use super::shapes::Shape;
use super::site::{Lot, Site};

/// A rectangle of the plan: x from, x to, z from, z to \[m\].
pub(crate) type Rectangle = [f64; 4];

/// The block of the towers.
const CENTRE: Rectangle = [-100.0, 100.0, -80.0, 80.0];
/// Blocks of flats, north, and at the north ends of west and east.
pub(crate) const FLATS: [Rectangle; 6] = [
    [-198.0, -118.0, -190.0, -98.0],
    [-100.0, -6.0, -190.0, -98.0],
    [6.0, 100.0, -190.0, -98.0],
    [118.0, 198.0, -190.0, -98.0],
    [-198.0, -118.0, -80.0, -6.0],
    [118.0, 198.0, -80.0, -6.0],
];
/// Blocks of low houses, south, and at the south ends of west and east.
pub(crate) const HOUSES: [Rectangle; 6] = [
    [-198.0, -118.0, 98.0, 190.0],
    [-100.0, -6.0, 98.0, 190.0],
    [6.0, 100.0, 98.0, 190.0],
    [118.0, 198.0, 98.0, 190.0],
    [-198.0, -118.0, 6.0, 80.0],
    [118.0, 198.0, 6.0, 80.0],
];

/// Middle and size of a rectangle.
pub(crate) fn extent([west, east, north, south]: Rectangle) -> ([f64; 2], [f64; 2]) {
    ([0.5 * (west + east), 0.5 * (north + south)], [east - west, south - north])
}

/// Ground and markings.
pub(crate) fn lay(site: &mut Site) {
    let whole = Lot::WHOLE;
    site.group("ground");
    // Of the albedo that `sky.albedo` gives the endless ground by default, so that the border does not show.
    whole.block(site, Stuff::Earth, [0.0, 0.0], [-3.0, -0.12], [1000.0, 1000.0]);
    whole.block(site, Stuff::Asphalt, [0.0, 0.0], [-1.0, 0.0], [416.0, 400.0]);
    for rectangle in [CENTRE].iter().chain(&FLATS).chain(&HOUSES) {
        let (middle, size) = extent(*rectangle);
        whole.block(site, Stuff::Pavement, middle, [-0.5, 0.15], size);
    }
    for rectangle in FLATS.iter().chain(&HOUSES) {
        let (middle, [wide, deep]) = extent(*rectangle);
        whole.block(site, Stuff::Lawn, middle, [-0.4, 0.22], [wide - 6.0, deep - 6.0]);
    }
    woods(site);
    site.group("markings");
    markings(site);
}

/// Woods around the town but for the west-southwest, from where a low sun shines in.
fn woods(site: &mut Site) {
    site.group("woods");
    for i in 0..28 {
        let around = site.between(0.0, 6.0) + 360.0 / 28.0 * f64::from(i);
        if (262.0..342.0).contains(&around) {
            continue;
        }
        let (sin, cos) = around.to_radians().sin_cos();
        let away = site.between(425.0, 465.0);
        let lot = Lot { at: [away * sin, away * cos], turn: around };
        let size = [site.between(130.0, 180.0), site.between(48.0, 64.0), site.between(40.0, 60.0)];
        lot.put(site, (Shape::Crown, Stuff::DarkLeaves), [0.0, -14.0, 0.0], size);
    }
}

fn markings(site: &mut Site) {
    let whole = Lot::WHOLE;
    let upright = Lot { at: [0.0, 0.0], turn: 90.0 };
    for side in [-1.0, 1.0] {
        // Along the streets of the middle, up to the crossings.
        whole.put(site, (Shape::Dashes, Stuff::Marking), [0.0, -0.02, 89.0 * side], [186.0, 0.05, 0.18]);
        upright.put(site, (Shape::Dashes, Stuff::Marking), [0.0, -0.02, 109.0 * side], [146.0, 0.05, 0.18]);
        for end in [-1.0, 1.0] {
            whole.put(
                site,
                (Shape::Zebra, Stuff::Marking),
                [109.0 * side, -0.02, 76.0 * end],
                [16.0, 0.045, 4.0],
            );
            upright.put(
                site,
                (Shape::Zebra, Stuff::Marking),
                [89.0 * end, -0.02, 96.0 * side],
                [16.0, 0.045, 4.0],
            );
        }
    }
}

/// Trees and lamp posts along the block of the towers.
pub(crate) fn plant(site: &mut Site) {
    site.group("street trees");
    for (along, across, half) in [(true, 76.5, 88.0), (false, 96.5, 64.0)] {
        for side in [-1.0, 1.0] {
            let count = (half / 8.0) as i32;
            for i in (-count..=count).step_by(2) {
                let t = f64::from(i) * 8.0;
                // The square stays open to the south.
                if along && side > 0.0 && t.abs() < 20.0 {
                    continue;
                }
                let at = if along { [t, across * side] } else { [across * side, t] };
                let height = site.between(7.5, 10.0);
                site.tree(at, height);
            }
        }
    }
    site.group("lamp posts");
    for side in [-1.0, 1.0] {
        for i in -2..=2 {
            post(site, Lot { at: [40.0 * f64::from(i), 99.2 * side], turn: 90.0 * side });
        }
        for i in -1..=1 {
            post(site, Lot { at: [119.2 * side, 50.0 * f64::from(i)], turn: 90.0 + 90.0 * side });
        }
    }
}

/// A post with an arm over the carriageway, which lies along +x.
fn post(site: &mut Site, lot: Lot) {
    lot.put(site, (Shape::Prism, Stuff::Steel), [0.0, 0.0, 0.0], [0.2, 8.0, 0.2]);
    lot.block(site, Stuff::Steel, [1.1, 0.0], [7.8, 7.95], [2.5, 0.14]);
}
