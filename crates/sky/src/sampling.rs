//! Occlusion of directions asked for in batches.

pub(crate) use light::sampling::{disc, lattice, shift};
use light::{Occlude, Ray, Spectrum};

/// Rays asked for in one call to an occluder.
const BATCH: usize = 64;

/// Asks `occlude` for every ray, in batches, and hands each answer on with what came along with the ray.
pub(crate) fn transmit<T: Copy>(
    occlude: &dyn Occlude,
    rays: impl Iterator<Item = (Ray, T)>,
    mut receive: impl FnMut(T, Spectrum),
) {
    let mut rays = rays.peekable();
    let Some(&(ray, tag)) = rays.peek() else { return };
    let (mut segments, mut tags, mut answers) = ([ray; BATCH], [tag; BATCH], [Spectrum::ZERO; BATCH]);
    while rays.peek().is_some() {
        let mut count = 0;
        for (slot, (ray, tag)) in rays.by_ref().take(BATCH).enumerate() {
            (segments[slot], tags[slot]) = (ray, tag);
            count = slot + 1;
        }
        occlude.transmittances(&segments[..count], &mut answers[..count]);
        tags[..count].iter().zip(&answers).for_each(|(&tag, &answer)| receive(tag, answer));
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use light::Vacuum;

    use super::*;

    #[test]
    fn a_lattice_has_one_point_in_each_column() {
        for count in [1, 7, 64, 1000] {
            let mut seen = vec![0; count as usize];
            let offset = shift(5, 1);
            for i in 0..count {
                // Half a column inwards, so that rounding at the edges of columns decides nothing.
                let at = lattice(i, count, [offset[0], offset[1]]);
                let start = (offset[0] >> 8) as f32 / 16_777_216.0;
                let column = ((at[0] - start + 1.0 + 0.5 / count as f32) * count as f32) as u32 % count;
                seen[column as usize] += 1;
                assert!(at.iter().all(|x| (0.0..1.0).contains(x)));
            }
            assert!(seen.iter().all(|&n| n == 1), "{count}");
        }
    }

    #[test]
    fn every_ray_is_answered_once_in_order() {
        for count in [0u32, 1, 63, 64, 65, 200] {
            let rays = (0..count).map(|i| (Ray::new(Vec3::ZERO, Vec3::Y), i));
            let mut tags = Vec::new();
            transmit(&Vacuum, rays, |tag, answer| {
                assert_eq!(answer, Spectrum::ONE);
                tags.push(tag);
            });
            assert_eq!(tags, (0..count).collect::<Vec<_>>());
        }
    }
}
