//! To which sides of faces light can get: the inside of a closed body needs no patches.

use std::f64::consts::TAU;

use glam::DVec3;
use light::{Nearest, sampling};
use radiosity::{Patch, Patches, Side};
use rayon::prelude::*;

use super::parted::Parted;

/// Rays from each patch.
const RAYS: u32 = 8;

/// Faces that a ray passes because light does.
const MOST_PASSED: u32 = 8;

/// Sides of faces that light can reach.
pub(super) struct Sides {
    /// In order, with whether light gets there.
    all: Vec<([u32; 2], Side, bool)>,
    /// Whether rays from all of these sides met nothing but faces that no light passes.
    pub(super) sealed: bool,
}

/// What rays meet.
pub(super) struct Sight<'a> {
    pub(super) nearest: &'a dyn Nearest,
    pub(super) parted: &'a Parted,
    /// Whether light passes a hit of this material.
    pub(super) passes: &'a (dyn Fn(u32) -> bool + Sync),
    /// Whether there is light beyond everything.
    pub(super) open: bool,
}

/// What a ray from a patch has come to.
#[derive(Clone, Copy)]
enum End {
    Side([u32; 2], Side),
    Beyond,
    Else,
}

impl Sides {
    /// Sides of `patches` that are `lit` in some patch, from which a ray leaves everything that stands there (if there is light
    /// beyond), or that see one of these, by any number of looks.
    pub(super) fn new(patches: &Patches, lit: &[bool], sight: &Sight<'_>) -> Self {
        let mut all: Vec<_> = patches.iter().map(|patch| (patch.face, patch.side)).collect();
        all.dedup();
        let ends: Vec<[End; RAYS as usize]> =
            (0..patches.len()).into_par_iter().map(|i| sight.from(&patches.patch(i), i as u32)).collect();
        let find = |face: [u32; 2], side: Side| all.binary_search(&(face, side)).ok();
        let mut groups = Groups::new(all.len());
        let (mut begins, mut leaks) = (vec![false; all.len()], vec![false; all.len()]);
        for ((patch, ends), lit) in patches.iter().zip(&ends).zip(lit) {
            let Some(mine) = find(patch.face, patch.side) else { continue };
            begins[mine] |= lit;
            for end in ends {
                match end {
                    End::Side(face, side) => match find(*face, *side) {
                        Some(other) => groups.join(mine, other),
                        None => leaks[mine] = true,
                    },
                    End::Beyond => {
                        begins[mine] |= sight.open;
                        leaks[mine] = true;
                    }
                    End::Else => leaks[mine] = true,
                }
            }
        }
        let mut reached = vec![false; all.len()];
        for (side, begins) in begins.iter().enumerate() {
            reached[groups.first(side)] |= begins;
        }
        let is_lit: Vec<bool> = (0..all.len()).map(|side| reached[groups.first(side)]).collect();
        let sealed = is_lit.iter().zip(&leaks).all(|(lit, leaks)| !lit || !leaks);
        let all = all.into_iter().zip(is_lit).map(|((face, side), lit)| (face, side, lit)).collect();
        Self { all, sealed }
    }

    pub(super) fn lit(&self, face: [u32; 2], side: Side) -> bool {
        let found = self.all.binary_search_by_key(&(face, side), |&(face, side, _)| (face, side));
        found.is_ok_and(|at| self.all[at].2)
    }
}

impl Sight<'_> {
    /// What rays from places all over a patch meet, in directions as diffuse light takes them.
    fn from(&self, patch: &Patch, number: u32) -> [End; RAYS as usize] {
        let normal = patch.normal();
        let across = normal.any_orthonormal_vector();
        let up = normal.cross(across);
        let shifts = [1, 2].map(|purpose| sampling::shift(number, purpose));
        std::array::from_fn(|k| {
            let [u, v] = sampling::sobol(k as u32, shifts[0]);
            let [a, b, c] = patch.corners;
            let at = a * (1.0 - u.sqrt()) + b * (u.sqrt() * (1.0 - v)) + c * (u.sqrt() * v);
            let [r, turn] = sampling::sobol(k as u32, shifts[1]);
            let (sin, cos) = (TAU * turn).sin_cos();
            let direction = (across * cos + up * sin) * r.sqrt() + normal * (1.0 - r).sqrt();
            self.end(patch, at, direction)
        })
    }

    fn end(&self, patch: &Patch, at: DVec3, direction: DVec3) -> End {
        let direction = direction.normalize().as_vec3();
        let from = light::Place { position: at.as_vec3(), ..patch.place(0) };
        let mut ray = from.leave(direction, f32::INFINITY);
        for _ in 0..MOST_PASSED {
            let Some(hit) = self.nearest.nearest(&ray) else { return End::Beyond };
            if (self.passes)(hit.material) {
                ray = hit.place.leave(direction, f32::INFINITY);
                continue;
            }
            let side = if hit.front { Side::Front } else { Side::Back };
            let face = self.parted.piece([hit.instance, hit.triangle], hit.place.position.as_dvec3());
            return End::Side(face, side);
        }
        End::Else
    }
}

/// Sides that see each other, by any number of looks.
struct Groups(Vec<usize>);

impl Groups {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn first(&mut self, mut of: usize) -> usize {
        while self.0[of] != of {
            self.0[of] = self.0[self.0[of]];
            of = self.0[of];
        }
        of
    }

    fn join(&mut self, a: usize, b: usize) {
        let [a, b] = [self.first(a), self.first(b)];
        self.0[a.max(b)] = a.min(b);
    }
}
