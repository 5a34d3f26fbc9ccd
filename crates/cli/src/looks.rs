//! How many samples of one thing are looked at: all, or the first ones where they look alike.

use light::{Piece, Spectrum};

/// How many samples of each group of a row are looked at: decided once, so that all layers look at the same ones and
/// add up to the picture.
#[derive(Default)]
pub(crate) struct Looks {
    decided: Vec<usize>,
    next: usize,
}

/// Samples that are looked at in any case: a fourth of them, and no fewer than this.
const FIRST: usize = 4;

impl Looks {
    /// Back to the first group.
    pub(crate) fn rewind(&mut self) {
        self.next = 0;
    }

    /// Σ share · radiance of a group: where its first samples are alike, they stand for the others. `radiance` is
    /// that of a piece times its share.
    pub(crate) fn sum(
        &mut self,
        group: &[Piece],
        alike: f32,
        radiance: impl Fn(&Piece) -> Spectrum,
    ) -> Spectrum {
        if let [only] = group {
            return radiance(only);
        }
        let few = (group.len() / 4).max(FIRST).min(group.len());
        let decided = self.decided.get(self.next).copied();
        self.next += 1;
        let (mut sum, mut share) = (Spectrum::ZERO, 0.0);
        let mut extremes = Extremes::default();
        let mut count = 0;
        for piece in &group[..decided.unwrap_or(group.len())] {
            if count == few && decided.is_none() && extremes.is_within(alike) {
                break;
            }
            let part = radiance(piece);
            extremes.add(part * piece.share.max(f32::MIN_POSITIVE).recip());
            sum += part;
            share += piece.share;
            count += 1;
        }
        if decided.is_none() {
            self.decided.push(count);
        }
        let all: f32 = group.iter().map(|piece| piece.share).sum();
        if count < group.len() && share > 0.0 { sum * (all / share) } else { sum }
    }
}

/// The least and the largest of some spectra, band by band.
#[derive(Default)]
struct Extremes(Option<[Spectrum; 2]>);

impl Extremes {
    fn add(&mut self, spectrum: Spectrum) {
        let [least, most] = self.0.unwrap_or([spectrum; 2]);
        let each = |pick: fn(f32, f32) -> f32, a: Spectrum| {
            Spectrum(std::array::from_fn(|band| pick(a[band], spectrum[band])))
        };
        self.0 = Some([each(f32::min, least), each(f32::max, most)]);
    }

    /// Whether no band differs by more than a share of the largest; never for a share of 0.
    fn is_within(&self, share: f32) -> bool {
        share > 0.0 && self.0.is_none_or(|[least, most]| (most - least).max() <= share * most.max())
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use glam::Vec3;
    use light::{Hit, Known, Place};

    use super::*;

    /// Pieces of the given shares; of each the number is its hit's triangle.
    fn group(shares: &[f32]) -> Vec<Piece> {
        let place = Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 0 };
        let hit = Hit::plain(place, Vec3::Y, 1.0);
        let piece = |(&share, triangle)| Piece {
            column: 0,
            share,
            hit: Hit { triangle, ..hit },
            known: Known::default(),
            samples: 1,
        };
        shares.iter().zip(0..).map(piece).collect()
    }

    /// The sum over pieces of a radiance by number, and how many were looked at.
    fn sum(looks: &mut Looks, pieces: &[Piece], alike: f32, radiance: impl Fn(u32) -> f32) -> (f32, u32) {
        let asked = Cell::new(0);
        let seen = looks.sum(pieces, alike, |piece| {
            asked.set(asked.get() + 1);
            Spectrum::splat(radiance(piece.hit.triangle) * piece.share)
        });
        (seen[0], asked.get())
    }

    /// Sums of 32 products.
    const ROUNDING: f32 = 64.0 * f32::EPSILON;

    #[test]
    fn what_is_alike_is_looked_at_by_a_fourth_and_keeps_its_light() {
        // Shares differ: pieces in front took some of them.
        let shares: Vec<f32> = (0..32).map(|i| if i % 3 == 0 { 0.01 } else { 0.03 }).collect();
        let all: f32 = shares.iter().sum();
        let (seen, asked) = sum(&mut Looks::default(), &group(&shares), 0.03, |_| 5.0);
        assert!(asked == 8 && (seen - 5.0 * all).abs() <= ROUNDING * seen, "{seen} {asked}");
        // Just alike, and no longer.
        let differing = |by: f32| {
            sum(&mut Looks::default(), &group(&shares), 0.03, |i| if i == 1 { 1.0 - by } else { 1.0 })
        };
        assert_eq!([differing(0.029).1, differing(0.031).1], [8, 32]);
        // No fewer than four, nor more than there are.
        for (count, expected) in [(2, 2), (4, 4), (5, 4), (16, 4), (20, 5)] {
            let asked = sum(&mut Looks::default(), &group(&vec![0.02; count]), 0.03, |_| 1.0).1;
            assert_eq!(asked, expected, "of {count}");
        }
    }

    #[test]
    fn what_is_not_alike_or_must_be_exact_is_looked_at_all_over() {
        let pieces = group(&[1.0 / 32.0; 32]);
        // 0 + 1 + … + 31 = 496.
        let (seen, asked) = sum(&mut Looks::default(), &pieces, 0.03, |i| i as f32);
        assert!(asked == 32 && (seen - 15.5).abs() <= ROUNDING * seen, "{seen}");
        assert_eq!(sum(&mut Looks::default(), &pieces, 0.0, |_| 1.0).1, 32);
    }

    #[test]
    fn black_is_alike_and_stays_black() {
        let pieces = group(&[1.0 / 16.0; 16]);
        assert_eq!(sum(&mut Looks::default(), &pieces, 0.03, |_| 0.0), (0.0, 4));
        // Nothing shows of any of them.
        assert_eq!(sum(&mut Looks::default(), &group(&[0.0; 16]), 0.03, |_| 1.0).0, 0.0);
    }

    #[test]
    fn every_layer_looks_at_what_the_first_one_did() {
        let pieces = [group(&[1.0 / 16.0; 16]), group(&[1.0 / 16.0; 16])];
        let mut looks = Looks::default();
        // The picture: the first group differs, the second does not; single pieces between them decide nothing.
        let single = group(&[0.5]);
        assert_eq!(sum(&mut looks, &pieces[0], 0.03, |i| i as f32).1, 16);
        assert_eq!(sum(&mut looks, &single, 0.03, |_| 1.0), (0.5, 1));
        assert_eq!(sum(&mut looks, &pieces[1], 0.03, |_| 1.0).1, 4);
        // Layers in which it is the other way round.
        for _ in 0..2 {
            looks.rewind();
            assert_eq!(sum(&mut looks, &pieces[0], 0.03, |_| 1.0).1, 16);
            assert_eq!(sum(&mut looks, &single, 0.03, |_| 1.0), (0.5, 1));
            assert_eq!(sum(&mut looks, &pieces[1], 0.03, |i| i as f32).1, 4);
        }
    }
}
