//! Parts of a picture of which the errors differ, so that few pixels say much of all: what stands out, edges, and the rest.

use super::sample::{Purpose, numbers};

/// A part of a whole, and some of its places.
pub(super) struct Part<P> {
    /// Of all places.
    pub(super) share: f64,
    /// Whether it has only these; else they are a random few.
    pub(super) all: bool,
    pub(super) places: Vec<P>,
}

/// Pixels that stand out most from the median of the three by three around them, such as glints: all are asked, because a sample may
/// meet none of them.
const OUTSTANDING: usize = 24;

/// One in so many pixels is an edge: those with the largest differences within three by three.
const EDGES: usize = 8;

/// Pixels that are asked of the edges, and as many of the rest: few of them have most of the error.
const FEW: usize = 144;

/// Parts of a picture by its luminances, row by row; of each the numbers of some pixels.
pub(super) fn strata(luminance: &[f32], width: usize, purpose: Purpose) -> Vec<Part<usize>> {
    let looks: Vec<[f32; 2]> = (0..luminance.len()).map(|i| look(luminance, width, i)).collect();
    let mut order: Vec<usize> = (0..luminance.len()).collect();
    // Stable: of equals the first.
    order.sort_by(|a, b| looks[*b][0].total_cmp(&looks[*a][0]));
    let mut others = order.split_off(OUTSTANDING.min(order.len()));
    others.sort_by(|a, b| looks[*b][1].total_cmp(&looks[*a][1]));
    let rest = others.split_off(others.len() / EDGES);
    let share = |part: &[usize]| part.len() as f64 / luminance.len().max(1) as f64;
    // One from each of even stretches from strong to weak edges.
    let few = |part: Vec<usize>| {
        let places = numbers(part.len(), FEW, purpose).into_iter().map(|i| part[i]).collect::<Vec<_>>();
        Part { share: share(&part), all: places.len() == part.len(), places }
    };
    vec![Part { share: share(&order), all: true, places: order }, few(others), few(rest)]
}

/// How far a pixel is from the median of what is around it, and how far that is apart.
fn look(luminance: &[f32], width: usize, i: usize) -> [f32; 2] {
    let (x, y, height) = (i % width, i / width, luminance.len() / width);
    let rows = y.saturating_sub(1)..(y + 2).min(height);
    let row = |y: usize| &luminance[y * width..][x.saturating_sub(1)..(x + 2).min(width)];
    let mut around: Vec<f32> = rows.flat_map(row).copied().collect();
    around.sort_unstable_by(f32::total_cmp);
    let range = around.last().zip(around.first()).map_or(0.0, |(most, least)| most - least);
    [(luminance[i] - around[around.len() / 2]).abs(), range]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step from 1 to 2 between columns 19 and 20, and one pixel that shines.
    fn picture() -> Vec<f32> {
        let mut picture: Vec<f32> = (0..40 * 30).map(|i| if i % 40 < 20 { 1.0 } else { 2.0 }).collect();
        picture[7 * 40 + 33] = 500.0;
        picture
    }

    #[test]
    fn what_shines_stands_out_and_steps_are_edges() {
        let parts = strata(&picture(), 40, Purpose::Pilot);
        assert_eq!(parts[0].places[0], 7 * 40 + 33);
        assert!(parts[0].all && !parts[2].all);
        let step = |place: &&usize| [19, 20].contains(&(*place % 40));
        let [edges, rest] = [1, 2].map(|part: usize| parts[part].places.iter().filter(step).count());
        assert!(edges > FEW / 4 && rest == 0, "{edges} {rest}");
    }

    #[test]
    fn shares_are_of_the_whole_and_places_in_one_part() {
        for (picture, width) in [(picture(), 40), (vec![1.0; 24], 6), (vec![3.0], 1), (vec![1.0; 100], 100)] {
            let parts = strata(&picture, width, Purpose::Check(2));
            let whole: f64 = parts.iter().map(|part| part.share).sum();
            assert!((whole - 1.0).abs() < 1e-12);
            let mut places: Vec<usize> = parts.iter().flat_map(|part| part.places.iter().copied()).collect();
            places.sort_unstable();
            let before = places.len();
            places.dedup();
            assert_eq!(places.len(), before);
        }
    }
}
