//! A species from photographs without background.

use glam::Vec2;
use light::Spectrum;

use crate::bake::TRANSMITTANCE;
use crate::envelope::Envelope;
use crate::region::{patch, random};
use crate::sheet::Sheet;
use crate::species::{Description, Leaf, Slice, Species, SpeciesError};

/// A picture with alpha: sRGB, straight alpha, rows from the top.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// Texels in a row.
    pub width: u32,
    /// Row by row.
    pub texels: &'a [[u8; 4]],
}

/// What photographs do not say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photo {
    /// Height of the tree \[m\], from the lowest to the highest row with alpha.
    pub height: f32,
    /// Length of a leaf \[m\].
    pub leaf: f32,
    /// Mean reflectance of leaves: a photograph shows them under its own light. None = as it shows them.
    pub reflectance: Option<Spectrum>,
    /// Horizontal planes.
    pub planes: u32,
    /// Decides what is random.
    pub seed: u32,
}

/// Alpha from which on a texel belongs to the tree.
const THERE: u8 = 96;

/// Length of the pieces that level pictures are made up of, as a share of the side view's breadth.
const PIECE: f32 = 0.12;

/// Texels along a side of a level picture, at most.
const LEVEL: usize = 512;

/// Knots of the outline.
const BINS: usize = 24;

/// A species from a side view and, where there is one, a view from above (its middle on the axis, as wide as the crown); else
/// the horizontal planes are made up of pieces of the side view from around the plane's height, as far from the axis, turned
/// anyhow. The axis goes through the middle of what the lowest rows show; all that is green counts as leaves.
///
/// Outline, density and size are fitted to the alpha; leaves lean to the sky as broad leaves mostly do.
pub fn from_photo(side: Picture, top: Option<Picture>, photo: &Photo) -> Result<Species, SpeciesError> {
    if !(photo.height.is_finite() && photo.height > 0.0) {
        return Err(SpeciesError::NotPositive("height"));
    }
    let cut = cut_out(side)?;
    let texel = photo.height / cut.rows as f32;
    let half_width = 0.5 * cut.columns as f32 * texel;
    let envelope = cut.envelope(texel).ok_or(SpeciesError::Invisible)?;
    let sheet = cut.sheet().ok_or(SpeciesError::Invisible)?;
    let [low, high] = envelope.heights();
    let mut slices = Vec::new();
    for i in 0..photo.planes.min(64) {
        let height = low + (high - low) * (i as f32 + 0.5) / photo.planes as f32;
        let made = match top {
            Some(top) => scaled(top, envelope.radius(height) / half_width, cut.columns.min(LEVEL)),
            None => cut.made_up(height / texel, envelope.radius(height) / texel, photo.seed ^ i),
        };
        slices.extend(made.map(|sheet| Slice { height, sheet }));
    }
    let mean = sheet.mean_leaf().map_or(Spectrum::ZERO, Spectrum::reflectance);
    Species::new(Description {
        height: photo.height,
        half_width,
        side: sheet,
        slices,
        envelope,
        leaf: Leaf {
            size: photo.leaf,
            reflectance: photo.reflectance,
            transmittance: photo.reflectance.unwrap_or(mean) * TRANSMITTANCE,
            scatter: 1.0,
            lean: 1.0,
        },
        extinction: None,
        // Baked trees of the three broadleaf forms have 1.4 to 1.9.
        shelter: 1.5,
        seed: photo.seed,
    })
}

/// The part of a side view that shows something, as wide on both sides of the axis.
struct CutOut {
    columns: usize,
    rows: usize,
    texels: Vec<[u8; 4]>,
}

fn cut_out(side: Picture) -> Result<CutOut, SpeciesError> {
    let width = side.width as usize;
    if width == 0 || side.texels.len() < width {
        return Err(SpeciesError::Invisible);
    }
    if side.texels.iter().all(|texel| texel[3] == 255) {
        return Err(SpeciesError::NoAlpha);
    }
    let rows: Vec<&[[u8; 4]]> = side.texels.chunks_exact(width).collect();
    let there = |row: &[[u8; 4]]| row.iter().any(|texel| texel[3] >= THERE);
    let first = rows.iter().position(|row| there(row)).ok_or(SpeciesError::Invisible)?;
    let last = rows.iter().rposition(|row| there(row)).ok_or(SpeciesError::Invisible)?;
    // The stem: what the lowest twentieth shows.
    let foot = &rows[last - (last - first) / 20..=last];
    let (mut sum, mut count) = (0, 0);
    for (x, _) in foot.iter().flat_map(|row| row.iter().enumerate()).filter(|(_, t)| t[3] >= THERE) {
        sum += x;
        count += 1;
    }
    let axis = sum as f32 / count.max(1) as f32 + 0.5;
    let far = |x: usize| (x as f32 + 0.5 - axis).abs();
    let all = rows[first..=last].iter().flat_map(|row| row.iter().enumerate());
    let reach = all.filter(|(_, t)| t[3] > 0).map(|(x, _)| far(x)).fold(0.5, f32::max);
    let half = reach.ceil() as usize + 1;
    let start = axis.round() as isize - half as isize;
    let texels = rows[first..=last].iter().flat_map(|row| {
        (0..2 * half).map(move |x| {
            usize::try_from(start + x as isize).ok().and_then(|x| row.get(x)).copied().unwrap_or([0; 4])
        })
    });
    Ok(CutOut { columns: 2 * half, rows: last - first + 1, texels: texels.collect() })
}

/// Green is what leaves are: more of it than of red and blue together by half.
fn leafy([r, g, b, a]: [u8; 4]) -> bool {
    a >= THERE && 4 * u32::from(g) > 2 * u32::from(r) + 2 * u32::from(b)
}

impl CutOut {
    fn row(&self, y: usize) -> &[[u8; 4]] {
        &self.texels[y * self.columns..][..self.columns]
    }

    fn sheet(&self) -> Option<Sheet> {
        let leaves: Vec<u8> = self.texels.iter().map(|t| if leafy(*t) { 255 } else { 0 }).collect();
        // Autumn, blossom: where hardly anything is green, everything is leaves.
        let green = leaves.iter().filter(|mask| **mask > 0).count();
        let there = self.texels.iter().filter(|t| t[3] >= THERE).count();
        let mask = if 10 * green < there { &[][..] } else { &leaves };
        Sheet::new(self.columns as u32, self.rows as u32, &self.texels, mask)
    }

    /// Half the breadth of the tree that a row shows \[texels\].
    fn breadth(&self, y: usize) -> f32 {
        let row = self.row(y);
        let there = |t: &[u8; 4]| t[3] >= THERE;
        let (first, last) = (row.iter().position(there), row.iter().rposition(there));
        first.zip(last).map_or(0.0, |(first, last)| 0.5 * (last - first + 1) as f32)
    }

    /// The breadths of rows, means over bins, without the bare stem: rows at the foot narrower than a quarter of the widest.
    fn envelope(&self, texel: f32) -> Option<Envelope> {
        let breadths: Vec<f32> = (0..self.rows).rev().map(|y| self.breadth(y)).collect();
        let widest = breadths.iter().copied().fold(0.0, f32::max);
        let base = breadths.iter().position(|b| *b > 0.25 * widest)?;
        let crown = &breadths[base..];
        let size = crown.len().div_ceil(BINS);
        let mut knots = vec![Vec2::new(base as f32, 0.5 * crown[0])];
        for (i, bin) in crown.chunks(size).enumerate() {
            let middle = base as f32 + i as f32 * size as f32 + 0.5 * bin.len() as f32;
            knots.push(Vec2::new(middle, bin.iter().sum::<f32>() / bin.len() as f32));
        }
        knots.push(Vec2::new(self.rows as f32, 0.0));
        Envelope::fitted(&knots.iter().map(|knot| *knot * texel).collect::<Vec<_>>())
    }

    /// A level picture at `height` above the foot, of `radius` \[texels\].
    fn made_up(&self, height: f32, radius: f32, seed: u32) -> Option<Sheet> {
        let size = self.columns.min(LEVEL);
        let (half, step) = (0.5 * self.columns as f32, self.columns as f32 / size as f32);
        let row = self.rows as f32 - height;
        // Rows from a tenth of the tree above to a tenth below.
        let spread = 0.1 * self.rows as f32;
        let piece = PIECE * self.columns as f32;
        let texel = |i: usize| {
            let at = Vec2::new((i % size) as f32 + 0.5, (i / size) as f32 + 0.5) * step - half;
            let (number, way) = patch(at, piece, seed);
            let middle = (at - way).length();
            if middle >= radius {
                return [0; 4];
            }
            let hand = if random(number, 5) < 0.5 { -1.0 } else { 1.0 };
            let from = Vec2::new(half + hand * middle, row + (2.0 * random(number, 6) - 1.0) * spread);
            let from = from + Vec2::from_angle(std::f32::consts::TAU * random(number, 7)).rotate(way);
            let inside =
                from.cmpge(Vec2::ZERO).all() && from.x < self.columns as f32 && from.y < self.rows as f32;
            if !inside {
                return [0; 4];
            }
            let found = self.row(from.y as usize)[from.x as usize];
            if leafy(found) { found } else { [0; 4] }
        };
        let texels: Vec<[u8; 4]> = (0..size * size).map(texel).collect();
        Sheet::new(size as u32, size as u32, &texels, &[])
    }
}

/// A view from above, its crown made `share` of the half width of a picture of `size`².
fn scaled(top: Picture, share: f32, size: usize) -> Option<Sheet> {
    let width = top.width as usize;
    let height = top.texels.len().checked_div(width)?;
    if height == 0 || share <= 0.0 {
        return None;
    }
    let texel = |i: usize| {
        let at = Vec2::new((i % size) as f32 + 0.5, (i / size) as f32 + 0.5) / size as f32 * 2.0 - 1.0;
        let from = (at / share * 0.5 + 0.5) * Vec2::new(width as f32, height as f32);
        let inside = from.cmpge(Vec2::ZERO).all() && from.x < width as f32 && from.y < height as f32;
        if inside { top.texels[from.y as usize * width + from.x as usize] } else { [0; 4] }
    };
    let texels: Vec<[u8; 4]> = (0..size * size).map(texel).collect();
    Sheet::new(size as u32, size as u32, &texels, &[])
}

#[cfg(test)]
mod tests {
    use super::*;

    const PHOTO: Photo = Photo { height: 8.0, leaf: 0.08, reflectance: None, planes: 3, seed: 1 };

    /// A green disc on a brown stem, off the middle of the picture.
    fn tree(alpha: u8) -> Vec<[u8; 4]> {
        let texel = |i: usize| {
            let (x, y) = ((i % 80) as f32 + 0.5 - 50.0, (i / 80) as f32 + 0.5);
            if x * x + (y - 40.0) * (y - 40.0) < 24.0 * 24.0 {
                [40, 110, 30, alpha]
            } else if x.abs() < 2.0 && (60.0..96.0).contains(&y) {
                [90, 70, 50, 255]
            } else {
                [0; 4]
            }
        };
        (0..80 * 100).map(texel).collect()
    }

    #[test]
    fn the_tree_in_a_photograph_is_found() {
        let texels = tree(230);
        let side = Picture { width: 80, texels: &texels };
        for top in [None, Some(side)] {
            let species = from_photo(side, top, &PHOTO).unwrap();
            let d = species.description();
            // Rows 16 to 95 are 8 m: a texel is 0.1 m, the disc 2.4 m in radius about a height of 5.6 m.
            assert_eq!(d.side.size(), [50, 80]);
            // The outline is a mean over bins of three rows.
            assert!((d.envelope.widest() - 2.4).abs() < 0.1, "{}", d.envelope.widest());
            assert!((d.envelope.radius(5.6) - 2.4).abs() < 0.1);
            assert_eq!(d.slices.len(), 3);
            assert!(d.slices.iter().all(|slice| slice.sheet.texels().iter().any(|t| t[3] > 0)));
            assert!(d.side.leaves().contains(&0) && d.side.leaves().contains(&255));
        }
    }

    #[test]
    fn photographs_of_no_tree_are_refused() {
        let error =
            |texels: &[[u8; 4]], photo: Photo| from_photo(Picture { width: 80, texels }, None, &photo).err();
        assert_eq!(error(&[[0; 4]; 6400], PHOTO), Some(SpeciesError::Invisible));
        assert_eq!(error(&[[9, 9, 9, 255]; 6400], PHOTO), Some(SpeciesError::NoAlpha));
        assert_eq!(error(&[], PHOTO), Some(SpeciesError::Invisible));
        let flat = Photo { height: 0.0, ..PHOTO };
        assert_eq!(error(&tree(200), flat), Some(SpeciesError::NotPositive("height")));
    }
}
