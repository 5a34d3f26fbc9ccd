//! The square between the towers: a raised terrace with steps, a basin, lawns, beds, benches, a grove, a pavilion.

use super::palette::Stuff;
use super::site::{Lot, Site};

/// Height of the pavement \[m\].
const PAVED: f64 = 0.15;
const WHOLE: Lot = Lot::WHOLE;

/// All of it.
pub(crate) fn lay(site: &mut Site) {
    site.group("terrace");
    terrace(site);
    site.group("square");
    floor(site);
    basin(site);
    lawns(site);
    benches(site);
    site.group("pavilion");
    pavilion(site);
    site.group("grove");
    for row in 0..3 {
        for column in 0..4 {
            let at = [17.0 + 8.0 * f64::from(row), 16.0 + 11.0 * f64::from(column)];
            let height = site.between(8.0, 9.5);
            site.tree(at, height);
        }
    }
    for at in [[-34.0, 22.0], [-27.0, 36.0], [-33.0, 52.0], [-18.0, 56.0]] {
        let height = site.between(10.0, 14.0);
        site.tree(at, height);
    }
}

/// Six steps up to a terrace in front of tower B.
fn terrace(site: &mut Site) {
    for i in 0..6 {
        let step = f64::from(i);
        let rise = [0.02, PAVED + 0.15 * (step + 1.0)];
        // Each sits a little within the one below on all other sides.
        let (north, south) = (-28.0 + 0.06 * step, 0.4 - 0.4 * step);
        let size = [56.0 - 0.12 * step, south - north];
        WHOLE.block(site, Stuff::Granite, [0.0, 0.5 * (north + south)], rise, size);
    }
    let top = PAVED + 0.9;
    for x in [-20.0, -7.0, 7.0, 20.0] {
        WHOLE.block(site, Stuff::Sandstone, [x, -14.0], [top - 0.1, top + 0.55], [9.0, 3.4]);
        WHOLE.block(site, Stuff::Hedge, [x, -14.0], [top, top + 0.95], [8.2, 2.6]);
    }
}

/// Pale stripes in the pavement that lead to the steps.
fn floor(site: &mut Site) {
    WHOLE.block(site, Stuff::Slabs, [0.0, 37.0], [0.0, PAVED + 0.03], [22.0, 66.0]);
    for i in 0..8 {
        let z = 9.0 + 8.0 * f64::from(i);
        WHOLE.block(site, Stuff::Granite, [0.0, z], [0.05, PAVED + 0.055], [80.0, 0.7]);
    }
}

fn basin(site: &mut Site) {
    WHOLE.block(site, Stuff::Granite, [0.0, 33.0], [0.02, PAVED + 0.5], [9.0, 34.0]);
    WHOLE.block(site, Stuff::Water, [0.0, 33.0], [0.1, PAVED + 0.53], [8.0, 33.0]);
}

fn lawns(site: &mut Site) {
    for (z, deep) in [(24.6, 20.0), (50.0, 24.0)] {
        WHOLE.block(site, Stuff::Granite, [-26.0, z], [0.03, PAVED + 0.3], [25.0, deep]);
        WHOLE.block(site, Stuff::Lawn, [-26.0, z], [0.1, PAVED + 0.38], [24.2, deep - 0.8]);
    }
    for z in [10.0, 61.5] {
        WHOLE.block(site, Stuff::Sandstone, [25.0, z], [0.04, PAVED + 0.5], [24.0, 2.6]);
        WHOLE.block(site, Stuff::Hedge, [25.0, z], [0.1, PAVED + 0.95], [23.2, 1.8]);
    }
}

fn benches(site: &mut Site) {
    for i in 0..5 {
        let z = 19.0 + 7.0 * f64::from(i);
        for x in [-8.2, 8.2] {
            WHOLE.block(site, Stuff::Timber, [x, z], [PAVED, PAVED + 0.47], [0.55, 2.6]);
        }
    }
    for column in 0..3 {
        let z = 21.5 + 11.0 * f64::from(column);
        WHOLE.block(site, Stuff::Timber, [21.0, z], [PAVED, PAVED + 0.47], [2.6, 0.55]);
    }
}

fn pavilion(site: &mut Site) {
    let lot = Lot { at: [-26.0, 67.6], turn: 0.0 };
    for x in [-8.0, 0.0, 8.0] {
        for z in [-2.4, 2.4] {
            lot.block(site, Stuff::Steel, [x, z], [0.1, 3.6], [0.22, 0.22]);
        }
    }
    lot.block(site, Stuff::WhiteConcrete, [0.0, 0.0], [3.5, 3.8], [20.0, 7.0]);
    lot.block(site, Stuff::Glass, [2.5, 0.0], [0.1, 3.55], [9.0, 3.8]);
}
