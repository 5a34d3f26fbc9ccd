//! The shadow of bodies on a segment, exactly.
//!
//! A way from the segment to the source is blocked if it meets a wall of the compound, as a ray would. That can only
//! change at places that [`super::section`] knows; between neighbouring ones a single way tells for all. A place
//! where it does change is where a stretch ends, once ways just before and just behind it have confirmed it;
//! otherwise halving finds it. So what is dark is what rays say; what cuts the members only says where to look.
//!
//! *How exactly.* A stretch ends where the shadow does, to [`EXACT`] of the segment, to what walls are known to
//! (see [`crate::solid`]) and to a dozen 2⁻⁵³ of the body's size, as a lamp projects it. Where the body stands on the
//! segment or pierces it, rays themselves cannot tell nearer than 1e-9 of the coordinates ([`TOUCH`]); a lamp that near
//! to a surface is on either side of it. A piece of shadow, or of light between two, may be missed where it is shorter
//! than [`EXACT`], or where both its ends come from one pair of curved members whose surfaces touch there, but for 1e-8
//! of the body's size; and where they come from an edge on a curved member that is smaller than 1e-7 of the body.

use glam::DVec3;
use light::Stretch;

use super::{
    Ready,
    fan::{Fan, TOUCH},
    member::U,
    section::{Section, crossings},
    sheet::Sheet,
};

/// Share of the segment to which its places are told apart.
const EXACT: f64 = 1.0 / (1u64 << 40) as f64;

/// Working memory.
#[derive(Default)]
pub(crate) struct Work {
    places: Vec<f64>,
    sections: Vec<Option<Section>>,
}

impl Fan {
    /// Appends the body's shadow.
    pub(crate) fn stretches(&self, body: &Ready, work: &mut Work, out: &mut Vec<Stretch>) {
        if body.bounds.is_empty() || self.misses(&body.bounds) || !self.places(body, work) {
            return;
        }
        let places = &mut work.places;
        places.sort_unstable_by(f64::total_cmp);
        // Nearer than this points of the segment are the same in f64.
        let exact = EXACT.max(8.0 * U * self.size / (self.b - self.a).length());
        let touch = 4.0 * TOUCH * self.size / (self.b - self.a).length();
        let blocked = |s: f64| self.blocked(&body.compound, s);
        let (mut last, mut middle, mut from) = (0.0, 0.0, None);
        for i in 0..=places.len() {
            let next = places.get(i).copied().unwrap_or(1.0);
            if next - last < exact && i < places.len() {
                continue;
            }
            let here = 0.5 * (last + next);
            let dark = blocked(here);
            if dark != from.is_some() {
                let place = match last {
                    0.0 => 0.0,
                    _ => border(blocked, !dark, [middle, here], last, [exact, touch]),
                };
                match from.take() {
                    Some(from) => out.push(Stretch { from, to: place, dark: body.medium.is_none() }),
                    None => from = Some(place),
                }
            }
            (last, middle) = (next, here);
        }
        if let Some(from) = from {
            out.push(Stretch { from, to: 1.0, dark: body.medium.is_none() });
        }
    }

    /// Collects where the body's shadow may begin or end, between 0 and 1; false when it is nowhere near.
    fn places(&self, body: &Ready, work: &mut Work) -> bool {
        let Work { places, sections } = work;
        places.clear();
        sections.clear();
        let compound = &body.compound;
        let mut see = |s: f64, at: DVec3, members: [u32; 2]| {
            if s > 0.0 && s < 1.0 && compound.shows(at, members) {
                places.push(s);
            }
        };
        let sheet = Sheet::new(self, &body.bounds);
        let mut any = false;
        for ((member, bounds), i) in body.compound.members.iter().zip(&body.boxes).zip(0..) {
            let near = !self.misses(bounds) && Self::reaches(self.local_pencil(member), member.ball);
            any |= near;
            let sheet = sheet.as_ref().filter(|_| near);
            let see = |s, at| see(s, at, [i; 2]);
            sections.push(sheet.map(|sheet| Section::new(member, self, sheet, see)));
        }
        if !any {
            return false;
        }
        if let Some(sheet) = &sheet {
            for &(i, j, common) in &body.pairs {
                if let (Some(one), Some(two)) = (&sections[i as usize], &sections[j as usize])
                    && self.passes(&common)
                {
                    let mut see = |s, at| see(s, at, [i, j]);
                    one.corners(two, sheet, &mut see);
                    let members = [i, j].map(|member| &compound.members[member as usize]);
                    crossings(members, &common, sheet, see);
                }
            }
        }
        body.compound.walls((self.a, self.b - self.a), |wall| {
            if wall.end.t > 0.0 && wall.end.t < 1.0 {
                places.push(wall.end.t);
            }
            wall.end.t >= 1.0
        });
        true
    }
}

/// Where, near `at` and within a bracket, ways cease to be `before`, blocked or not.
///
/// `at` itself if ways around it, as near as the first or at least the second of `sure`, say so.
fn border(
    blocked: impl Fn(f64) -> bool,
    before: bool,
    [mut low, mut high]: [f64; 2],
    at: f64,
    sure: [f64; 2],
) -> f64 {
    for by in sure {
        for s in [at - by, at + by] {
            if low < s && s < high {
                if blocked(s) == before { low = s } else { high = s }
            }
        }
        // Half as much again for the rounding of at ± by.
        if at - low <= 1.5 * by && high - at <= 1.5 * by {
            return at;
        }
    }
    while high - low > sure[0] {
        let s = 0.5 * (low + high);
        if s <= low || s >= high {
            break;
        }
        if blocked(s) == before { low = s } else { high = s }
    }
    0.5 * (low + high)
}
