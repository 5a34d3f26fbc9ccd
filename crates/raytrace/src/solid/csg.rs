//! Where a line meets the surface of a set operation.
//!
//! Each member, being convex, has at most one chord. All ends of chords are sorted along the line; between two
//! of them no member changes, so the whole expression is evaluated there, and where it changes the line meets
//! the surface. Two such walls nearer to each other than their errors are no body and no gap, but faces in
//! common that rounding has parted: both are dropped. So A − B has no skin where A and B share a face, and A ∪ B
//! no wall within.

use glam::DVec3;

use super::{
    chord::{Chord, End},
    member::Member,
};

/// Which points belong, by which members they lie in.
#[derive(Clone, Debug)]
pub(crate) enum Expression {
    /// Within this member.
    Member(usize),
    /// Within any.
    Any(Vec<Expression>),
    /// Within all.
    All(Vec<Expression>),
    /// Within the first, in none of the others.
    Without(Box<Expression>, Vec<Expression>),
}

impl Expression {
    fn holds(&self, inside: &[bool]) -> bool {
        match self {
            Self::Member(index) => inside[*index],
            Self::Any(parts) => parts.iter().any(|part| part.holds(inside)),
            Self::All(parts) => parts.iter().all(|part| part.holds(inside)),
            Self::Without(whole, cuts) => whole.holds(inside) && !cuts.iter().any(|cut| cut.holds(inside)),
        }
    }
}

/// Members and what is made of them.
#[derive(Clone, Debug)]
pub(crate) struct Compound {
    pub(crate) members: Vec<Member>,
    pub(crate) expression: Expression,
}

/// Where a line enters or leaves a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    /// Where on the line, how exactly, on which face of the member.
    pub(crate) end: End,
    /// Whose face it is.
    pub(crate) member: u32,
    /// Into the body.
    pub(crate) entering: bool,
}

/// An end of a member's chord.
#[derive(Clone, Copy, Debug)]
struct Event {
    end: End,
    member: u32,
    /// Into the member.
    into: bool,
}

const NONE: Event = Event { end: End { t: 0.0, error: 0.0, face: 0 }, member: 0, into: false };

/// Members that fit on the stack.
const FEW: usize = 16;

fn tied(a: &End, b: &End) -> bool {
    (a.t - b.t).abs() <= a.error + b.error
}

impl Compound {
    /// Calls `receive` with the walls along the line, in order, entering and leaving in turn, until it
    /// returns true.
    pub(crate) fn walls(&self, line: (DVec3, DVec3), mut receive: impl FnMut(Wall) -> bool) {
        if let Expression::Member(index) = self.expression {
            if let Some(Chord { enter, leave }) = self.members[index].chord(line) {
                let wall = |end, entering| Wall { end, member: index as u32, entering };
                if !receive(wall(enter, true)) {
                    receive(wall(leave, false));
                }
            }
            return;
        }
        let count = self.members.len();
        if count <= FEW {
            self.sweep(line, &mut [NONE; 2 * FEW], &mut [false; FEW], receive);
        } else {
            self.sweep(line, &mut vec![NONE; 2 * count], &mut vec![false; count], receive);
        }
    }

    /// Whether the surface of either member (or of the one, given twice) may be the body's at a point of it.
    ///
    /// It is if the body around the point depends on which side of them one is, the others being as they are.
    pub(crate) fn shows(&self, point: DVec3, [one, two]: [u32; 2]) -> bool {
        let count = self.members.len();
        match count {
            1 => true,
            2..=FEW => self.depends(point, [one, two], &mut [false; FEW]),
            _ => self.depends(point, [one, two], &mut vec![false; count]),
        }
    }

    /// The same, with room for which members hold the point.
    fn depends(&self, point: DVec3, [one, two]: [u32; 2], inside: &mut [bool]) -> bool {
        for (member, index) in self.members.iter().zip(0..) {
            if index == one || index == two {
                continue;
            }
            match member.holds(point) {
                Some(within) => inside[index as usize] = within,
                None => return true,
            }
        }
        let mut with = |first, second| {
            (inside[one as usize], inside[two as usize]) = (first, second);
            self.expression.holds(inside)
        };
        let outside = with(false, false);
        [(true, true), (true, false), (false, true)].into_iter().any(|(a, b)| with(a, b) != outside)
    }

    fn sweep(
        &self,
        line: (DVec3, DVec3),
        events: &mut [Event],
        inside: &mut [bool],
        mut receive: impl FnMut(Wall) -> bool,
    ) {
        let mut count = 0;
        for (member, index) in self.members.iter().zip(0..) {
            let Some(chord) = member.chord(line) else { continue };
            events[count] = Event { end: chord.enter, member: index, into: true };
            events[count + 1] = Event { end: chord.leave, member: index, into: false };
            count += 2;
        }
        let events = &mut events[..count];
        // Members leave before others enter at the very same place, and keep their order: an order of all.
        events.sort_unstable_by(|a, b| {
            a.end.t.total_cmp(&b.end.t).then(a.into.cmp(&b.into)).then(a.member.cmp(&b.member))
        });
        let mut within = false;
        // A wall is given out when the next one has turned out not to undo it.
        let mut waiting: Option<Wall> = None;
        for index in 0..count {
            let event = events[index];
            inside[event.member as usize] = event.into;
            let now = self.expression.holds(inside);
            if now == within {
                continue;
            }
            within = now;
            let wall = self.wall(events, index, inside, now);
            match waiting.take() {
                Some(before) if tied(&before.end, &event.end) => {}
                Some(before) => {
                    if receive(before) {
                        return;
                    }
                    waiting = Some(wall);
                }
                None => waiting = Some(wall),
            }
        }
        if let Some(wall) = waiting {
            receive(wall);
        }
    }

    /// The wall at an event that changed the whole: whose face shows?
    ///
    /// Of faces in common the first member's that would make the wall alone, or without which it would not be:
    /// members come in the scene's order, what is cut before what cuts it.
    fn wall(&self, events: &[Event], index: usize, inside: &[bool], entering: bool) -> Wall {
        let event = events[index];
        let alone = Wall { end: event.end, member: event.member, entering };
        let tie = |other: &Event| tied(&other.end, &event.end);
        let low = index - events[..index].iter().rev().take_while(|other| tie(other)).count();
        let high = index + 1 + events[index + 1..].iter().take_while(|other| tie(other)).count();
        if high - low == 1 {
            return alone;
        }
        let mut before = inside[..].to_vec();
        for other in &events[low..=index] {
            before[other.member as usize] = !other.into;
        }
        let mut after = before.clone();
        for other in &events[low..high] {
            after[other.member as usize] = other.into;
        }
        let makes = |other: &Event| {
            // Into the body one comes by entering what is added or leaving what is subtracted.
            if (other.into == self.members[other.member as usize].positive) != entering {
                return false;
            }
            let with = |state: &[bool], there: bool| {
                let mut state = state.to_vec();
                state[other.member as usize] = there;
                self.expression.holds(&state)
            };
            with(&before, other.into) == entering || with(&after, !other.into) != entering
        };
        let ties = events[low..high].iter().filter(|other| makes(other));
        ties.min_by_key(|other| other.member).map_or(alone, |first| Wall {
            end: End { face: first.end.face, ..event.end },
            member: first.member,
            entering,
        })
    }
}
