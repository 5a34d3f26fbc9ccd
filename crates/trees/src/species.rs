//! A kind of tree: pictures, planes, outline, leaves.

use std::fmt;

use glam::{Vec2, Vec3};
use light::Spectrum;

use crate::envelope::Envelope;
use crate::region::Crowd;
use crate::sheet::Sheet;

/// What a leaf does to light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    /// Length of a leaf, or of what shows as one (a tuft of needles) \[m\], > 0.
    pub size: f32,
    /// Mean reflectance of leaves, within \[0, 1\] per band; pictures say only how it varies. None = as the pictures have it.
    pub reflectance: Option<Spectrum>,
    /// Share of light that a leaf lets through, scattered, within \[0, 1\] per band; reflectance and this together count
    /// as at most 1.
    pub transmittance: Spectrum,
    /// How irregularly leaves face: a of thesis eq. 5.6, > 0.
    pub scatter: f32,
    /// How much leaves turn their faces to the sky instead of outwards, ≥ 0: they scatter about n + lean · Y, n the crown's
    /// outward normal. 0 as in the thesis; for most broad leaves 1 to 8.
    pub lean: f32,
}

impl Leaf {
    /// Unit vector that leaves scatter about where the crown faces `outward`.
    pub(crate) fn axis(&self, outward: Vec3) -> Vec3 {
        (outward + Vec3::Y * self.lean).try_normalize().unwrap_or(Vec3::Y)
    }
}

/// A view from above of the part of a crown around one height, on its horizontal plane.
#[derive(Clone, Debug)]
pub struct Slice {
    /// Height of the plane \[m\].
    pub height: f32,
    /// The picture, \[−half_width, half_width\]² of the tree.
    pub sheet: Sheet,
}

/// All that makes a species, in metres of a tree as it was baked or photographed; placements scale it.
#[derive(Clone, Debug)]
pub struct Description {
    /// Height of the tree, and of the side view \[m\], > 0.
    pub height: f32,
    /// Half the width of the side view and of every slice \[m\], > 0.
    pub half_width: f32,
    /// The side view, \[−half_width, half_width\] × \[0, height\].
    pub side: Sheet,
    /// Horizontal planes, in any order; none at all is allowed (and vanishes from above).
    pub slices: Vec<Slice>,
    /// Outline of the crown \[m\].
    pub envelope: Envelope,
    /// What leaves do to light.
    pub leaf: Leaf,
    /// Share of light that leaves stop, per metre of crown \[1/m\]; none = fitted to the side view's alpha.
    pub extinction: Option<f32>,
    /// How many times the crown's extinction light meets on its way to leaves that show, > 0: more than 1 where leaves stand
    /// in clumps.
    pub shelter: f32,
    /// Decides everything random.
    pub seed: u32,
}

/// Why a description is no species.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeciesError {
    /// A length, scatter or extinction is not a positive finite number, as the word names it.
    NotPositive(&'static str),
    /// The side view has no texel with alpha.
    Invisible,
    /// The side view has no texel without alpha: its background has not been removed.
    NoAlpha,
    /// A slice's height is outside the tree.
    SliceOutside,
    /// The envelope is outside the tree.
    EnvelopeOutside,
    /// Reflectance or transmittance of leaves is not within \[0, 1\].
    NotAShare,
}

impl fmt::Display for SpeciesError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPositive(what) => write!(out, "{what} must be a number above 0"),
            Self::Invisible => out.write_str("the side view is wholly transparent"),
            Self::NoAlpha => {
                out.write_str("the side view is wholly opaque: a tree needs its background removed (alpha)")
            }
            Self::SliceOutside => out.write_str("a horizontal plane lies below the ground or above the top"),
            Self::EnvelopeOutside => out.write_str("the envelope reaches below the ground or above the top"),
            Self::NotAShare => {
                out.write_str("reflectance and transmittance of leaves must be within 0 and 1")
            }
        }
    }
}

impl std::error::Error for SpeciesError {}

/// A kind of tree that can be placed.
#[derive(Clone, Debug)]
pub struct Species {
    description: Description,
    pub(crate) crowd: Crowd,
    /// What colours of leaves are multiplied with, so that their mean is the leaf's.
    gain: Spectrum,
    /// Transmittance over reflectance of leaves.
    through: Spectrum,
    extinction: f32,
    /// Of the side view within the envelope.
    pub(crate) mean_alpha: f32,
    /// Of the side view \[1/m\].
    pub(crate) texels_per_metre: f32,
}

/// Crowns are at most so dense that this many mean free paths fit into their radius.
const DENSEST: f32 = 20.0;

impl Species {
    /// Checks and prepares; slices come out sorted by height.
    pub fn new(mut description: Description) -> Result<Self, SpeciesError> {
        check(&description)?;
        description.slices.sort_by(|a, b| a.height.total_cmp(&b.height));
        let leaf = description.leaf;
        let mean = description.side.mean_leaf().map_or(Spectrum::ZERO, Spectrum::reflectance);
        let gain = leaf.reflectance.map_or(Spectrum::ONE, |wanted| ratio(wanted, mean));
        let through = ratio(leaf.transmittance, leaf.reflectance.unwrap_or(mean));
        let (fitted, mean_alpha) = fitted_extinction(&description);
        let extinction = description.extinction.unwrap_or(fitted);
        let texels_per_metre = description.side.size()[1] as f32 / description.height;
        Ok(Self {
            crowd: Crowd::new(leaf.scatter),
            gain,
            through,
            extinction,
            mean_alpha,
            texels_per_metre,
            description,
        })
    }

    /// What it was made from, slices sorted by height.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Share of light that leaves stop, per metre of crown \[1/m\].
    pub fn extinction(&self) -> f32 {
        self.extinction
    }

    /// Bytes of its pictures in memory.
    pub fn bytes(&self) -> usize {
        let slices = self.description.slices.iter().map(|slice| slice.sheet.bytes()).sum::<usize>();
        self.description.side.bytes() + slices
    }

    /// Reflectance and transmittance of a leaf that shows as linear colour `rgb`; together at most 1.
    pub(crate) fn leaf(&self, rgb: Vec3) -> (Spectrum, Spectrum) {
        let reflected = (Spectrum::reflectance(rgb) * self.gain).map(|share| share.min(1.0));
        let passed = reflected * self.through;
        let whole = reflected + passed;
        let scale = whole.map(|sum| if sum > 1.0 { 1.0 / sum } else { 1.0 });
        (reflected * scale, passed * scale)
    }

    /// Share of light that the crown's leaves let through along the first `reach` metres of a line that ends in the crown
    /// (Lambert-Beer).
    pub(crate) fn through_crown(&self, origin: Vec3, direction: Vec3, reach: f32) -> f32 {
        let extinction = self.extinction * self.description.shelter;
        (-extinction * self.description.envelope.chord(origin, direction, reach)).exp()
    }

    /// Depth in the crown \[m\] of the leaf that a line shows after entering it, for a share `u` within \[0, 1) of leaves that lie
    /// less deep, where the line stays in it for `length` metres.
    ///
    ///   s = −ln(1 − u (1 − exp(−k length)))/k
    pub(crate) fn depth(&self, u: f32, length: f32) -> f32 {
        let k = self.extinction;
        (-(1.0 - u * (1.0 - (-k * length).exp())).ln() / k).min(length)
    }

    /// The same species with another shelter.
    pub(crate) fn sheltered(mut self, shelter: f32) -> Self {
        self.description.shelter = shelter;
        self
    }

    /// True in the crown and around the trunk below it: where a plane of the tree cannot say what is in the way, because
    /// the place is in the tree.
    pub(crate) fn holds(&self, point: Vec3) -> bool {
        let top = self.description.envelope.heights()[1];
        let trunk = TRUNK * self.description.height;
        let stem = (0.0..top).contains(&point.y) && point.x * point.x + point.z * point.z < trunk * trunk;
        stem || self.description.envelope.holds(point)
    }
}

/// Radius around the axis that counts as the tree itself, as a share of its height: thicker than trunks are.
const TRUNK: f32 = 0.04;

/// a / b per band; 0 where b is 0.
fn ratio(a: Spectrum, b: Spectrum) -> Spectrum {
    Spectrum(std::array::from_fn(|i| if b[i] > 0.0 { a[i] / b[i] } else { 0.0 }))
}

fn check(d: &Description) -> Result<(), SpeciesError> {
    let lengths = [
        (d.height, "height"),
        (d.half_width, "half_width"),
        (d.leaf.size, "leaf size"),
        (d.leaf.scatter, "scatter"),
        (d.extinction.unwrap_or(1.0), "extinction"),
        (d.shelter, "shelter"),
    ];
    if let Some((_, name)) = lengths.into_iter().find(|(value, _)| !(value.is_finite() && *value > 0.0)) {
        return Err(SpeciesError::NotPositive(name));
    }
    let share = |s: Spectrum| s.0.iter().all(|band| (0.0..=1.0).contains(band));
    if !share(d.leaf.transmittance) || !d.leaf.reflectance.is_none_or(share) {
        return Err(SpeciesError::NotAShare);
    }
    // A hundredth of the height for the roundings of fits.
    let inside = |height: f32| height >= -0.01 * d.height && height <= 1.01 * d.height;
    if !(d.leaf.lean.is_finite() && d.leaf.lean >= 0.0) {
        return Err(SpeciesError::NotPositive("lean"));
    }
    if !d.slices.iter().all(|slice| inside(slice.height)) {
        return Err(SpeciesError::SliceOutside);
    }
    if !d.envelope.heights().into_iter().all(inside) {
        return Err(SpeciesError::EnvelopeOutside);
    }
    let (mut some, mut all) = (false, true);
    d.side.texels().iter().for_each(|texel| {
        some |= texel[3] > 0;
        all &= texel[3] == 255;
    });
    match (some, all) {
        (false, _) => Err(SpeciesError::Invisible),
        (_, true) => Err(SpeciesError::NoAlpha),
        _ => Ok(()),
    }
}

/// The extinction with which a crown of even density inside the envelope has the side view's mean alpha, and that.
fn fitted_extinction(d: &Description) -> (f32, f32) {
    const GRID: usize = 48;
    let ([low, high], widest) = (d.envelope.heights(), d.envelope.widest());
    let mut chords = Vec::with_capacity(GRID * GRID);
    let mut opaque = 0.0;
    for i in 0..GRID * GRID {
        let share = Vec2::new((i % GRID) as f32 + 0.5, (i / GRID) as f32 + 0.5) / GRID as f32;
        let at = Vec2::new((2.0 * share.x - 1.0) * widest, low + share.y * (high - low));
        let chord = d.envelope.chord(Vec3::new(at.x, at.y, 2.0 * widest), Vec3::NEG_Z, f32::INFINITY);
        if chord > 0.0 {
            chords.push(chord);
            let uv = Vec2::new(0.5 + 0.5 * at.x / d.half_width, 1.0 - at.y / d.height);
            let texels = 2.0 * widest / GRID as f32 * d.side.size()[1] as f32 / d.height;
            opaque += d.side.alpha(uv, texels);
        }
    }
    let stopped = |k: f32| chords.iter().map(|chord| 1.0 - (-k * chord).exp()).sum::<f32>();
    let (mut none, mut most) = (0.0, DENSEST / widest);
    for _ in 0..32 {
        let k = 0.5 * (none + most);
        if stopped(k) < opaque { none = k } else { most = k }
    }
    (0.5 * (none + most), opaque / chords.len().max(1) as f32)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A crown between 2 and 10 m, 3 m wide, of even alpha, with a trunk and three slices.
    pub(crate) fn plain(alpha: u8) -> Description {
        let envelope = Envelope::ellipsoid(2.0, 10.0, 3.0).unwrap();
        let side = picture(64, 80, |x, y| {
            let (x, y) = ((x - 0.5) * 8.0, (1.0 - y) * 10.0);
            if x.abs() < envelope.radius(y) { Some(alpha) } else { (x.abs() < 0.2 && y < 3.0).then_some(255) }
        });
        let slice = |height: f32| Slice {
            height,
            sheet: picture(64, 64, |x, z| {
                let radius = Vec2::new(x - 0.5, z - 0.5).length() * 8.0;
                (radius < envelope.radius(height)).then_some(alpha)
            }),
        };
        Description {
            height: 10.0,
            half_width: 4.0,
            side,
            slices: [8.0, 4.0, 6.0].map(slice).to_vec(),
            leaf: Leaf {
                size: 0.1,
                reflectance: None,
                transmittance: Spectrum::splat(0.05),
                scatter: 1.0,
                lean: 0.5,
            },
            extinction: None,
            shelter: 1.0,
            seed: 1,
            envelope,
        }
    }

    fn picture(width: u32, height: u32, alpha: impl Fn(f32, f32) -> Option<u8>) -> Sheet {
        let texel = |i: u32| {
            let at = [(i % width) as f32 + 0.5, (i / width) as f32 + 0.5];
            alpha(at[0] / width as f32, at[1] / height as f32).map_or([0; 4], |a| [60, 90, 40, a])
        };
        let texels: Vec<_> = (0..width * height).map(texel).collect();
        Sheet::new(width, height, &texels, &[]).unwrap()
    }

    #[test]
    fn descriptions_that_are_no_trees_are_refused() {
        let refused = |change: fn(&mut Description), error: SpeciesError| {
            let mut description = plain(200);
            change(&mut description);
            assert_eq!(Species::new(description).err(), Some(error));
        };
        assert!(Species::new(plain(200)).is_ok());
        refused(|d| d.height = 0.0, SpeciesError::NotPositive("height"));
        refused(|d| d.half_width = f32::NAN, SpeciesError::NotPositive("half_width"));
        refused(|d| d.side = picture(4, 4, |_, _| None), SpeciesError::Invisible);
        refused(|d| d.side = picture(4, 4, |_, _| Some(255)), SpeciesError::NoAlpha);
        refused(|d| d.slices[0].height = 11.0, SpeciesError::SliceOutside);
        refused(|d| d.leaf.transmittance = Spectrum::splat(1.5), SpeciesError::NotAShare);
        refused(|d| d.envelope = Envelope::pencil(1.0, 20.0, 1.0).unwrap(), SpeciesError::EnvelopeOutside);
    }

    #[test]
    fn slices_are_sorted() {
        let species = Species::new(plain(200)).unwrap();
        assert!(species.description().slices.windows(2).all(|pair| pair[0].height < pair[1].height));
    }

    #[test]
    fn a_crown_is_as_dense_as_its_picture() {
        let of = |alpha: u8| Species::new(plain(alpha)).unwrap().extinction();
        let (thin, dense) = (of(40), of(250));
        // Thin: 1 − exp(−k c) ≈ k c; the mean chord of an ellipsoid seen from the side is 4/3 of its radius.
        let expected = 40.0 / 255.0 / (4.0 / 3.0 * 3.0);
        // Second order: k c/2 with chords up to 6 m and some more by the spread of chords, and texels at the border.
        assert!((thin / expected - 1.0).abs() < 0.2, "{thin} {expected}");
        assert!(dense > 10.0 * thin && dense <= DENSEST / 3.0);
    }

    #[test]
    fn leaves_have_the_mean_they_are_given() {
        let mut description = plain(200);
        let wanted = Spectrum([0.05, 0.05, 0.08, 0.12, 0.1, 0.08, 0.07, 0.06]);
        description.leaf.reflectance = Some(wanted);
        let species = Species::new(description).unwrap();
        let colour = species.description().side.mean_leaf().unwrap();
        let (reflected, passed) = species.leaf(colour);
        for band in 0..8 {
            assert!((reflected[band] / wanted[band] - 1.0).abs() < 1e-4);
            assert!((passed[band] - 0.05).abs() < 1e-4);
        }
        let (reflected, passed) = species.leaf(Vec3::ONE);
        assert!((reflected + passed).max() <= 1.0 + f32::EPSILON);
    }
}
