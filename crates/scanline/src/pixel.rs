//! One pixel: which faces show in it, how much of each, and where.

use crate::area::Area;
use crate::known::Table;
use crate::segment::Segment;

/// A face's visible part of a pixel, or of one span in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cover {
    pub(crate) face: u32,
    /// What is known of the light on it, as [`Segment::known`].
    pub(crate) known: u32,
    /// Visible area, as if nothing transparent lay in front \[pixel\].
    pub(crate) area: f64,
    /// Area times x and area times y.
    pub(crate) moment: [f64; 2],
    /// Share of the pixel: the area times what veils in front let through (times its own opacity).
    pub(crate) share: f64,
    /// Own opacity, once asked for; none = opaque or not yet asked.
    pub(crate) opacity: Option<f64>,
    /// Its hit, once made for the opacity: index into what the asker keeps, or [`NO_HIT`].
    pub(crate) hit: u32,
}

/// No hit has been made yet.
pub(crate) const NO_HIT: u32 = u32::MAX;

/// An interval of a line in which no face begins or ends: where veils lie one behind the other.
#[derive(Clone, Copy, Debug)]
struct Stack {
    area: f64,
    /// Range of veils in `order`, from the front.
    veils: (u32, u32),
    opaque: Option<u32>,
}

/// Where veils let less than this through, the last of them is taken for opaque: what lies behind (which
/// may be a far brighter sky) is not let in, and no share is lost. An eighth of a step of an 8-bit display.
pub(crate) const NEGLIGIBLE: f64 = 1.0 / 2048.0;

/// Areas below this are rounding errors of differences of areas up to 1, or show nothing: 2⁻⁴⁰ of a pixel.
const TINY: f64 = 1.0 / (1u64 << 40) as f64;

/// What is known of the pixel so far. Emptied by [`Pixel::clear`], memory kept.
#[derive(Default)]
pub(crate) struct Pixel {
    pub(crate) covers: Vec<Cover>,
    stacks: Vec<Stack>,
    order: Vec<u32>,
    cuts: Vec<f64>,
    veils: Vec<u32>,
    /// What the numbers mean that covers have; kept by [`Pixel::clear`].
    pub(crate) table: Table,
}

/// What an area is added to: those of one face and one light are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Whose {
    face: u32,
    known: u32,
}

impl From<u32> for Whose {
    /// Of this face, nothing known.
    fn from(face: u32) -> Self {
        Self { face, known: 0 }
    }
}

impl From<&Segment> for Whose {
    fn from(span: &Segment) -> Self {
        Self { face: span.face, known: span.known }
    }
}

impl Pixel {
    pub(crate) fn clear(&mut self) {
        self.covers.clear();
        self.stacks.clear();
        self.order.clear();
    }

    /// Adds the interval \[l, r\] of an opaque span. `merge` = into what is known of its face.
    pub(crate) fn opaque(
        &mut self,
        whose: impl Into<Whose>,
        (l, r): (f64, f64),
        y: f64,
        weight: f64,
        merge: bool,
    ) {
        let area = (r - l) * weight;
        let index = self.cover(whose.into(), 0.5 * (l + r), y, area, merge);
        self.covers[index].share += area;
    }

    /// Adds an area of an opaque span with its moments about (`x`, `y`).
    pub(crate) fn leaning(&mut self, whose: impl Into<Whose>, part: Area, (x, y): (f64, f64), merge: bool) {
        // What rounding left of nothing is nothing.
        if part.area > TINY {
            let index = self.cover(whose.into(), x, y, part.area, merge);
            let cover = &mut self.covers[index];
            cover.moment[0] += part.x;
            cover.moment[1] += part.y;
            cover.share += part.area;
        }
    }

    fn cover(&mut self, whose: Whose, x: f64, y: f64, area: f64, merge: bool) -> usize {
        let Whose { face, known } = whose;
        let same = |cover: &Cover| cover.face == face && cover.known == known;
        let before = if merge { self.covers.iter().rposition(same) } else { None };
        let index = before.unwrap_or_else(|| {
            self.covers.push(Cover {
                face,
                known,
                area: 0.0,
                moment: [0.0; 2],
                share: 0.0,
                opacity: None,
                hit: NO_HIT,
            });
            self.covers.len() - 1
        });
        let cover = &mut self.covers[index];
        cover.area += area;
        cover.moment[0] += area * x;
        cover.moment[1] += area * y;
        index
    }

    /// Adds what a line shows of \[left, right\] where veils are among it.
    pub(crate) fn layered(
        &mut self,
        opaque: &[Segment],
        veils: &[Segment],
        (left, right): (f64, f64),
        (y, weight): (f64, f64),
        merge: bool,
    ) {
        self.cuts.clear();
        self.cuts.extend([left, right]);
        let ends = opaque.iter().chain(veils).flat_map(|s| [s.x0, s.x1]);
        self.cuts.extend(ends.filter(|&x| left < x && x < right));
        self.cuts.sort_unstable_by(f64::total_cmp);
        self.cuts.dedup();
        let centre = |i: u32| veils[i as usize].nearness(0.5 * (left + right));
        self.veils.clear();
        self.veils.extend(0..veils.len() as u32);
        self.veils.sort_unstable_by(|&a, &b| centre(b).total_cmp(&centre(a)).then(a.cmp(&b)));
        let mut first = 0;
        for i in 1..self.cuts.len() {
            let (l, r) = (self.cuts[i - 1], self.cuts[i]);
            let (middle, area) = (0.5 * (l + r), (r - l) * weight);
            while first < opaque.len() && opaque[first].x1 <= l {
                first += 1;
            }
            let behind = opaque.get(first).filter(|span| span.x0 <= l);
            let begin = self.order.len();
            // Indices of the line's veils first, of their covers once they are in order. Taken in their order
            // at the middle of the pixel they are nearly sorted already, which the sort makes use of.
            for &i in &self.veils {
                let veil = &veils[i as usize];
                if veil.x0 <= l && veil.x1 >= r {
                    self.order.push(i);
                }
            }
            let nearness = |i: u32| veils[i as usize].nearness(middle);
            self.order[begin..].sort_by(|&a, &b| {
                let faces = || veils[a as usize].face.cmp(&veils[b as usize].face);
                nearness(b).total_cmp(&nearness(a)).then_with(faces)
            });
            for k in begin..self.order.len() {
                let face = veils[self.order[k] as usize].face;
                self.order[k] = self.cover(face.into(), middle, y, area, true) as u32;
            }
            let opaque = behind.map(|span| self.cover(span.into(), middle, y, area, merge) as u32);
            let veils = (begin as u32, self.order.len() as u32);
            self.stacks.push(Stack { area, veils, opaque });
        }
    }

    /// Shares out what the veils leave, from the front; `opacity` is asked once for each veil that is
    /// reached by light worth asking for.
    pub(crate) fn share_out(&mut self, mut opacity: impl FnMut(&mut Cover) -> f64) {
        for stack in &self.stacks {
            let mut left = 1.0;
            for &index in &self.order[stack.veils.0 as usize..stack.veils.1 as usize] {
                let cover = &mut self.covers[index as usize];
                let own = match cover.opacity {
                    Some(own) => own,
                    None => opacity(cover).clamp(0.0, 1.0),
                };
                cover.opacity = Some(own);
                let through = left * (1.0 - own);
                if through < NEGLIGIBLE {
                    cover.share += stack.area * left;
                    left = 0.0;
                    break;
                }
                cover.share += stack.area * left * own;
                left = through;
            }
            if left > 0.0
                && let Some(index) = stack.opaque
            {
                self.covers[index as usize].share += stack.area * left;
            }
        }
    }
}
