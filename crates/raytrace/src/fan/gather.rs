//! All faces in a fan, by way of the hierarchies.

use glam::DVec3;
use light::{PointSource, Stretch};

use super::{
    MOST,
    frame::Fan,
    sieve::Sieve,
    union::{Cover, union},
};
use crate::{
    collapse::WIDTH,
    tree::{DEEPEST, Faces, LEAF, Tree},
    world::World,
};

/// Places on the stack: every level leaves at most seven siblings behind.
const STACK: usize = (WIDTH - 1) * DEEPEST + 1;

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Told {
    /// Every face in the fan has been looked at.
    All,
    /// The whole segment is dark already.
    Dark,
    /// More than [`MOST`] faces lie in the fan.
    TooMany,
}

/// What has been found so far.
pub(crate) struct Gather<'a> {
    world: &'a World,
    fan: &'a Fan,
    /// Hidden by solid faces, and by faces that rays have to look at.
    dark: Vec<(f64, f64)>,
    asked: Vec<(f64, f64)>,
    cover: Cover,
    seen: usize,
}

impl<'a> Gather<'a> {
    pub(crate) fn new(world: &'a World, fan: &'a Fan) -> Self {
        Self { world, fan, dark: Vec::new(), asked: Vec::new(), cover: Cover::default(), seen: 0 }
    }

    /// Looks at everything.
    pub(crate) fn all(&mut self, source: &PointSource) -> Told {
        let world = self.world;
        let toward = |source: &PointSource| match *source {
            PointSource::At(_) => DVec3::ZERO,
            PointSource::Toward(toward) | PointSource::Below { toward, .. } => toward,
        };
        let sieve = Sieve::new(self.fan, toward(source), world.standing.tree.reach);
        let told = self.faces(&world.standing, None, &sieve);
        if told != Told::All || world.placements.is_empty() {
            return told;
        }
        let sieve = Sieve::new(self.fan, toward(source), world.tops.reach);
        descend(&world.tops, &sieve, |leaf| {
            let placement = &world.placements[leaf as usize];
            let faces = &world.models[placement.model as usize];
            let into = &placement.model_from_world;
            // Shares along a segment and a fan are the same in all affine coordinates.
            let source = match *source {
                PointSource::At(at) => PointSource::At(into.transform_point3(at)),
                PointSource::Toward(toward) | PointSource::Below { toward, .. } => {
                    PointSource::Toward(into.transform_vector3(toward))
                }
            };
            let (a, b) = (self.fan.a, self.fan.a + self.fan.d);
            let (a, b) = (into.transform_point3(a), into.transform_point3(b));
            // Flattened beyond f32 by a placement: nothing can be sifted.
            let Some(fan) = Fan::new(&source, a, b) else { return Told::TooMany };
            let sieve = Sieve::new(&fan, toward(&source), faces.tree.reach);
            self.faces(faces, Some(placement.instance), &sieve)
        })
    }

    /// Looks at the faces of one hierarchy.
    fn faces(&mut self, faces: &Faces, instance: Option<u32>, sieve: &Sieve) -> Told {
        descend(&faces.tree, sieve, |leaf| {
            let mut mask = sieve.triangles(&faces.packets[leaf as usize]);
            self.seen += mask.count_ones() as usize;
            if self.seen > MOST {
                return Told::TooMany;
            }
            while mask != 0 {
                let lane = mask.trailing_zeros() as usize;
                mask &= mask - 1;
                let name = faces.names[leaf as usize * WIDTH + lane];
                let face = self.world.geometry.triangle(instance.unwrap_or(name.instance), name.triangle);
                let Some(hidden) = self.fan.hidden(&face) else { continue };
                if name.alpha {
                    self.asked.push(hidden);
                    continue;
                }
                self.dark.push(hidden);
                if self.cover.take(hidden) {
                    return Told::Dark;
                }
            }
            Told::All
        })
    }

    /// Appends the stretches.
    pub(crate) fn report(mut self, out: &mut Vec<Stretch>) {
        union(&mut self.dark, true, out);
        union(&mut self.asked, false, out);
    }
}

/// Visits the leaves that may meet the fan until a visit does not end with [`Told::All`].
fn descend(tree: &Tree, sieve: &Sieve, mut leaf: impl FnMut(u32) -> Told) -> Told {
    let Some(root) = tree.root else { return Told::All };
    let mut stack = [0u32; STACK];
    stack[0] = root;
    let mut height = 1;
    while height > 0 {
        height -= 1;
        let current = stack[height];
        if current & LEAF != 0 {
            let told = leaf(current & !LEAF);
            if told != Told::All {
                return told;
            }
            continue;
        }
        let node = &tree.nodes[current as usize];
        let mut mask = sieve.boxes(node);
        while mask != 0 {
            stack[height] = node.children[mask.trailing_zeros() as usize & (WIDTH - 1)];
            height += 1;
            mask &= mask - 1;
        }
    }
    Told::All
}
