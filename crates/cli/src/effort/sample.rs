//! Which pixels or sensor points are asked again.

use light::sampling::scramble;

use crate::pipeline::Region;

/// A share of a whole, spread over it at random; two samples of different purpose have nothing to do with each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// To choose an effort.
    Pilot,
    /// To judge what it has led to: the first, and further ones where that says no.
    Check(u32),
}

impl Purpose {
    fn seed(self) -> u32 {
        match self {
            Self::Pilot => 0x51,
            Self::Check(number) => 0xC4 ^ scramble(number),
        }
    }
}

/// `count` of `whole` numbers in rising order, one at random from each of as many even stretches; all where there are no more.
pub(super) fn numbers(whole: usize, count: usize, purpose: Purpose) -> Vec<usize> {
    if whole <= count { (0..whole).collect() } else { on_line(whole, count, purpose, 0) }
}

/// About `count` pixels of a region as columns and rows of the picture, one at random from each of as many blocks; all where there
/// are no more.
pub(super) fn pixels(region: &Region, count: usize, purpose: Purpose) -> Vec<[u32; 2]> {
    let (width, height) = (region.columns.len(), region.rows.len());
    let pixel = |x: usize, y: usize| [region.columns.start + x as u32, region.rows.start + y as u32];
    if width * height <= count {
        return (0..width * height).map(|i| pixel(i % width, i / width)).collect();
    }
    // Blocks about as wide as high.
    let across = (count as f64 * width as f64 / height as f64).sqrt().round() as usize;
    let across = across.clamp(1, width.min(count));
    let down = (count / across).clamp(1, height);
    let columns: Vec<_> = (0..down).map(|row| on_line(width, across, purpose, row as u32)).collect();
    let rows: Vec<_> = (0..across).map(|column| on_line(height, down, purpose, !(column as u32))).collect();
    (0..across * down)
        .map(|i| (i % across, i / across))
        .map(|(x, y)| pixel(columns[y][x], rows[x][y]))
        .collect()
}

/// One at random from each of `count` ≤ `whole` even stretches of a line of numbers, differently for every line.
fn on_line(whole: usize, count: usize, purpose: Purpose, line: u32) -> Vec<usize> {
    let start = |i: usize| (i as u128 * whole as u128 / count as u128) as usize;
    let at = |i: usize| {
        let random = scramble(purpose.seed() ^ scramble(line).wrapping_add(i as u32));
        start(i) + ((u64::from(random) * (start(i + 1) - start(i)) as u64) >> 32) as usize
    };
    (0..count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn pixels_are_within_their_region_and_each_but_once() {
        for (width, height, count) in
            [(640, 400, 512), (3, 700, 100), (10, 10, 100), (2, 2, 50), (1, 1, 1), (65536, 1, 64)]
        {
            let region = Region { columns: 5..5 + width, rows: 7..7 + height };
            let pixels = pixels(&region, count, Purpose::Pilot);
            assert!(pixels.iter().all(|[x, y]| region.columns.contains(x) && region.rows.contains(y)));
            let distinct: BTreeSet<_> = pixels.iter().copied().collect();
            assert_eq!(distinct.len(), pixels.len());
            let whole = (width as usize) * (height as usize);
            assert!(pixels.len() >= count.min(whole) / 2, "{} of {count}", pixels.len());
        }
    }

    #[test]
    fn purposes_have_samples_of_their_own() {
        let region = Region { columns: 0..640, rows: 0..400 };
        let [pilot, check] = [Purpose::Pilot, Purpose::Check(0)].map(|purpose| pixels(&region, 512, purpose));
        let pilot: BTreeSet<_> = pilot.into_iter().collect();
        assert!(check.iter().filter(|pixel| pilot.contains(*pixel)).count() < 10);
    }

    #[test]
    fn numbers_rise() {
        let some = numbers(1000, 32, Purpose::Check(0));
        assert!(some.len() == 32 && some.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(numbers(5, 32, Purpose::Check(0)), [0, 1, 2, 3, 4]);
    }
}
