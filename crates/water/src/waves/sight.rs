//! Where a straight way first meets waves.

use glam::DVec2;

use super::{Covariance, Facet, Stokes, Waves};

/// Pieces of a way are no shorter than this share of the shortest wave along it that matters. A crest that the way touches over less may be
/// passed by: it is no higher over the way than a k² (λ/64)²/8, 0.1 % of its amplitude.
const PIECES: f64 = 64.0;

/// Nor shorter than this share of the whole way: what bounds the work.
const MOST: f64 = 4096.0;

/// Waves below this share of all heights are too low to matter for how finely one looks.
const LOW: f64 = 1e-3;

/// Waves that reach no higher than this \[m\] are none.
const CALM: f64 = 1e-9;

/// Halvings of the piece in which the way meets the waves: to 2⁻²⁰ of it.
const HALVINGS: u32 = 20;

/// A straight way: `back` metres from where it meets the level, it is at x, z = `at` + `run` · back, `rise` · back over the level (under it
/// when seen from below).
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) at: DVec2,
    pub(super) run: DVec2,
    /// > 0.
    pub(super) rise: f64,
    /// 1 above the waves, −1 below them.
    pub(super) side: f64,
}

/// A way over waves that a footprint has evened out.
pub(super) struct Sight<'a> {
    waves: &'a Waves,
    footprint: Covariance,
    way: Way,
    /// Of each wave, within the footprint: the most that it rises, and its steepest slope along the way \[m/m\].
    bounds: Vec<[f64; 2]>,
    /// Σ of what they rise \[m\].
    highest: f64,
    /// The shortest piece worth looking at \[m\].
    fine: f64,
}

impl<'a> Sight<'a> {
    pub(super) fn new(waves: &'a Waves, footprint: Covariance, way: Way) -> Self {
        let bound = |wave: &Stokes| {
            let kept = wave.kept(footprint);
            [kept * wave.highest(), kept * wave.steepest() * wave.along(way.run) / wave.wavenumber()]
        };
        let bounds: Vec<[f64; 2]> = waves.each().iter().map(bound).collect();
        let highest: f64 = bounds.iter().map(|[high, _]| high).sum();
        let matter = waves.each().iter().zip(&bounds).filter(|(_, [high, _])| *high > LOW * highest);
        let shortest = matter.map(|(wave, _)| std::f64::consts::TAU / wave.along(way.run));
        let fine = shortest.fold(f64::INFINITY, f64::min) / PIECES;
        Self { waves, footprint, way, bounds, highest, fine }
    }

    /// The facet that the way meets first, coming from `distance` \[m\] before the level.
    ///
    /// Pieces of the way that pass above the waves by the bound of [`Self::is_clear`] are skipped whole, others are halved; where
    /// the way is below the waves at the end of a shortest piece, it meets them in it, and halving finds where. At most some 3 · 4096 looks.
    pub(super) fn met(&self, distance: f64) -> Facet {
        self.facet(self.meets(distance))
    }

    fn meets(&self, distance: f64) -> f64 {
        let reach = self.highest / self.way.rise;
        let (mut back, end) = (reach.min(distance), -reach);
        if self.highest <= CALM || self.over(back) <= 0.0 {
            return back;
        }
        let mut piece = (back - end) / 8.0;
        let fine = self.fine.max((back - end) / MOST);
        while back > end {
            let next = (back - piece).max(end);
            if self.is_clear(next, back) {
                (back, piece) = (next, 2.0 * piece);
            } else if piece > fine {
                piece *= 0.5;
            } else if self.over(next) <= 0.0 {
                return self.between(next, back);
            } else {
                back = next;
            }
        }
        end
    }

    /// Where between `under` and `over` the waves it crosses them.
    fn between(&self, mut under: f64, mut over: f64) -> f64 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (under + over);
            *if self.over(middle) <= 0.0 { &mut under } else { &mut over } = middle;
        }
        over
    }

    fn point(&self, back: f64) -> DVec2 {
        self.way.at + self.way.run * back
    }

    fn facet(&self, back: f64) -> Facet {
        self.waves.facet(self.point(back), self.footprint)
    }

    /// By how much the way passes the waves \[m\].
    fn over(&self, back: f64) -> f64 {
        self.way.rise * back - self.way.side * self.facet(back).height
    }

    /// Whether no wave can reach the way between two distances: each rises over what it has in the middle no faster than its steepest slope,
    /// and no higher than its crest.
    fn is_clear(&self, low: f64, high: f64) -> bool {
        let (middle, half) = (self.point(0.5 * (low + high)), 0.5 * (high - low));
        let mut left = self.way.rise * low;
        for (i, [crest, steep]) in self.bounds.iter().enumerate() {
            let here = self.way.side * self.waves.height_of(i, middle, self.footprint);
            left -= crest.min(here + steep * half);
        }
        left > 0.0
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

    use super::*;
    use crate::waves::{POINT, Wind};

    fn sea(seed: u32) -> Waves {
        let wind = Wind { speed: 8.0, fetch: 10_000.0, toward: DVec2::X, depth: None, waves: 48 };
        Waves::new(wind.raise(seed).unwrap(), DVec2::ZERO)
    }

    fn way(rise: f64, angle: f64, at: DVec2, side: f64) -> Way {
        Way { at, run: DVec2::from_angle(angle) * (1.0 - rise * rise).sqrt(), rise, side }
    }

    /// By even steps of `step` from where no wave reaches.
    fn by_steps(waves: &Waves, way: &Way, step: f64) -> f64 {
        let mut back = waves.highest() / way.rise;
        let over = |back: f64| way.rise * back - way.side * waves.height(way.at + way.run * back);
        while over(back) > 0.0 {
            back -= step;
        }
        back
    }

    #[test]
    fn the_first_facet_of_a_wind_is_found_at_any_elevation() {
        let waves = sea(5);
        for rise in [0.5, 0.2, 0.1, 0.05, 0.02, 0.01] {
            for i in 0..6 {
                let at = DVec2::new(f64::from(i) * 3.7, f64::from(i * i) * 1.9);
                let way = way(rise, f64::from(i), at, if i == 5 { -1.0 } else { 1.0 });
                let sight = Sight::new(&waves, POINT, way);
                let step = 2e-3;
                let (got, expected) = (sight.meets(f64::INFINITY), by_steps(&waves, &way, step));
                // The first step under the waves is up to one behind where they are met.
                assert!(
                    got >= expected - 1e-9 && got <= expected + step + 1e-9,
                    "{rise} {i}: {got} {expected}"
                );
                assert!(sight.over(got).abs() < 1e-4, "{rise} {i}: over by {}", sight.over(got));
            }
        }
    }

    #[test]
    fn an_eye_among_the_waves_looks_from_where_it_is() {
        let waves = sea(2);
        let way = way(0.02, 1.0, DVec2::ZERO, 1.0);
        let sight = Sight::new(&waves, POINT, way);
        let open = sight.meets(f64::INFINITY);
        assert_eq!(sight.meets(open - 1e-3), open - 1e-3);
        assert!((sight.meets(open + 0.5) - open).abs() < 1e-3);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// It ends on the waves, with bounded work, whatever the way and however wide it is.
        #[test]
        fn it_ends_on_the_waves(
            rise in 1e-3..1.0f64, angle in 0.0..TAU, x in -50.0..50.0f64, below in any::<bool>(), width in 0.0..3.0f64, seed in 0u32..4,
        ) {
            let waves = sea(seed);
            let way = way(rise, angle, DVec2::new(x, 0.3), if below { -1.0 } else { 1.0 });
            let footprint = Covariance::even(width);
            let sight = Sight::new(&waves, footprint, way);
            let back = sight.meets(f64::INFINITY);
            // A shortest piece is no longer than 2 reach/4096, of which 2⁻²⁰ is left: 1e-9 of the height, times slopes below 1 over the rise.
            prop_assert!(sight.over(back).abs() < 1e-5, "{}", sight.over(back));
            let under = (1..200).filter(|i| sight.over(back + f64::from(*i) * 0.05) < 0.0).count();
            // A crest may be touched over less than a piece.
            prop_assert!(rise < 0.01 || under == 0, "{under} of 200 places before it lie under the waves");
        }
    }
}
