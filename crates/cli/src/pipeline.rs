//! The assembled stages, and the two things they do together: a picture, and lux.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use glam::DVec2;
use light::{
    Arrival, Film, Hit, Illuminate, Known, Layer, Nearest, Occlude, Path, Piece, Place, PointSource,
    Projection, Ray, See, Shade, Spectrum, Surroundings, Traverse, Vacuum, View, Way,
};
use rayon::prelude::*;

use crate::Error;
use crate::looks::Looks;
use crate::shadows::NUMBERED;

/// A named light.
pub struct Source {
    /// The name that layers and lux tables show.
    pub name: String,
    /// What arrives from it.
    pub light: Box<dyn Illuminate>,
    /// True for lights that reach surfaces as beams (sun, lamps): shaders make their highlights, so mirrored
    /// rays must not meet them once more.
    pub beam: bool,
    /// Where a source is that casts sharp shadows; none for extended ones.
    pub point: Option<PointSource>,
    /// The same found with less work, for what fills the space (crowns of trees); none = `light` there as well.
    pub among_leaves: Option<Box<dyn Illuminate>>,
}

/// A number that grows while a picture is made.
pub type Count = Box<dyn Fn() -> u64 + Send + Sync>;

/// How far mirrored and refracted rays are followed, and samples looked at.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Turns.
    pub depth: u8,
    /// Share in the eye's radiance below which a ray is not followed.
    pub share: f32,
    /// Samples of one thing look alike that differ by no more than this share of their radiance.
    pub alike: f32,
}

/// The stages of one scene and view. Knows no chapter: only the questions.
pub struct Pipeline {
    /// From the world to the picture.
    pub view: View,
    /// Which pieces of surface show.
    pub see: Box<dyn See>,
    /// How many pixels have needed a ray to see what shows in them, so far; none where no body asks for one.
    pub needed_rays: Option<Count>,
    /// What a further ray meets.
    pub nearest: Arc<dyn Nearest>,
    /// By material index.
    pub shade: Arc<[Box<dyn Shade>]>,
    /// Every light.
    pub sources: Arc<[Source]>,
    /// What stands in light's way.
    pub occlude: Arc<dyn Occlude>,
    /// What fills the space between things; empty = clear air.
    pub between: Vec<Arc<dyn Traverse>>,
    /// When to stop.
    pub limits: Limits,
}

/// A part of the picture, in pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Region {
    /// Columns.
    pub columns: Range<u32>,
    /// Rows, from the top.
    pub rows: Range<u32>,
}

/// What the outside wants to know and say while a picture is made.
#[derive(Debug, Default)]
pub struct Monitor {
    /// Set to end early.
    pub interrupted: AtomicBool,
    /// True from the first pixel to the last byte: then an interruption is looked at and ends tidily.
    pub rendering: AtomicBool,
    /// True when it has been asked for before.
    pub asked: AtomicBool,
    /// Rows done.
    pub rows: AtomicU64,
    /// Pieces of surface shaded.
    pub pieces: AtomicU64,
}

/// Rows per task: enough that neighbouring scanlines share their work, few enough that threads stay busy.
const BAND: u32 = 8;

impl Pipeline {
    /// Renders `region` into a film of the region's size.
    ///
    /// With `parts`, the film has a further layer for each source (what the picture would be with that
    /// source alone) and one named `emission`; their sum is the picture, because light adds.
    ///
    /// # Errors
    /// [`Error::Interrupted`] when the monitor says so.
    pub fn render(&self, region: &Region, parts: bool, monitor: &Monitor) -> Result<Film, Error> {
        let (width, height) = (region.columns.len(), region.rows.len());
        let everything: Vec<usize> = (0..self.sources.len()).collect();
        let mut lit_by = vec![(String::new(), everything)];
        if parts {
            lit_by.extend(self.sources.iter().enumerate().map(|(i, source)| (source.name.clone(), vec![i])));
            lit_by.push(("emission".to_owned(), Vec::new()));
        }
        let mut pixels = vec![Spectrum::ZERO; width * height * lit_by.len()];
        // A band's rows of all layers lie together, so that bands are disjoint slices.
        let band_len = BAND as usize * width * lit_by.len();
        pixels.par_chunks_mut(band_len.max(1)).enumerate().for_each(|(band, pixels)| {
            if monitor.interrupted.load(Ordering::Relaxed) {
                return;
            }
            let first = region.rows.start + band as u32 * BAND;
            let rows = first..(first + BAND).min(region.rows.end);
            let done = rows.len() as u64;
            self.band(rows, region.columns.clone(), &lit_by, pixels, monitor);
            monitor.rows.fetch_add(done, Ordering::Relaxed);
        });
        if monitor.interrupted.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        Ok(film(width, height, lit_by.into_iter().map(|(name, _)| name), pixels))
    }

    fn band(
        &self,
        rows: Range<u32>,
        columns: Range<u32>,
        lit_by: &[(String, Vec<usize>)],
        pixels: &mut [Spectrum],
        monitor: &Monitor,
    ) {
        let first = rows.start;
        let width = columns.len();
        self.see.see(rows, columns.clone(), &mut |row, pieces| {
            monitor.pieces.fetch_add(pieces.len() as u64, Ordering::Relaxed);
            let start = (row - first) as usize * width * lit_by.len();
            let mut looks = Looks::default();
            for (layer, (_, sources)) in lit_by.iter().enumerate() {
                let around = Around {
                    pipeline: self,
                    sources,
                    known: Known::default(),
                    face: [u32::MAX; 2],
                    among_leaves: false,
                };
                let line = &mut pixels[start + layer * width..][..width];
                looks.rewind();
                self.shade_row((row, columns.start), pieces, &around, &mut looks, line, monitor);
            }
            if lit_by.len() > 1 {
                separate_emission(&mut pixels[start..][..width * lit_by.len()], width);
            }
        });
    }

    fn shade_row(
        &self,
        (row, first): (u32, u32),
        pieces: &[Piece],
        around: &Around,
        looks: &mut Looks,
        line: &mut [Spectrum],
        monitor: &Monitor,
    ) {
        let mut covered = vec![0.0f32; line.len()];
        let mut rest = pieces;
        while let Some(piece) = rest.first() {
            // A row may take long at the highest settings, and Ctrl-C should not.
            if monitor.interrupted.load(Ordering::Relaxed) {
                return;
            }
            let (group, others) = rest.split_at(usize::from(piece.samples).clamp(1, rest.len()));
            rest = others;
            let column = (piece.column - first) as usize;
            let radiance = |piece: &Piece| {
                let around = Around { known: piece.known, ..*around };
                around.eye_sees(&self.seen(&piece.hit)) * piece.share
            };
            line[column] += looks.sum(group, self.limits.alike, radiance);
            covered[column] += group.iter().map(|piece| piece.share).sum::<f32>();
        }
        for (column, (pixel, covered)) in line.iter_mut().zip(covered).enumerate() {
            // Shares are sums of f32 areas: what is missing by rounding alone is no background.
            let open = 1.0 - covered;
            if open > 1e-5 {
                let at = DVec2::new(f64::from(first) + column as f64 + 0.5, f64::from(row) + 0.5);
                let ray = self.view.ray(at);
                let path = Path { spread: self.spread(), ..Path::EYE };
                *pixel += around.way(&ray, path).bring(around.background(&ray, path)) * open;
            }
        }
    }

    /// A hit as the eye sees it: its bundle comes from a point in a perspective, and spreads on its way.
    fn seen(&self, hit: &Hit) -> Hit {
        let spread = match self.view.projection {
            Projection::Perspective { .. } if hit.distance > 0.0 => hit.width / hit.distance,
            _ => 0.0,
        };
        Hit { path: Path { spread, ..Path::EYE }, ..*hit }
    }

    /// By how much the bundle of a pixel widens on its way, per metre.
    fn spread(&self) -> f32 {
        match self.view.projection {
            Projection::Perspective { .. } => self.view.pixel_width(1.0) as f32,
            Projection::Orthographic { .. } => 0.0,
        }
    }

    /// Looks at the whole picture without shading it: the share of its pixels that need a ray to see what shows
    /// in them, within \[0, 1\].
    pub fn share_of_rays(&self) -> f64 {
        let Some(count) = &self.needed_rays else { return 0.0 };
        let before = count();
        let bands = self.view.height.div_ceil(BAND);
        (0..bands).into_par_iter().for_each(|band| {
            let rows = band * BAND..((band + 1) * BAND).min(self.view.height);
            self.see.see(rows, 0..self.view.width, &mut |_, _| {});
        });
        (count() - before) as f64 / (f64::from(self.view.width) * f64::from(self.view.height))
    }

    /// Irradiance on the plane of `place` by each source \[W m⁻² nm⁻¹\], in the order of `sources`.
    pub fn irradiances(&self, place: &Place) -> Vec<Spectrum> {
        self.sources.iter().map(|source| source.light.irradiance(place, &*self.occlude)).collect()
    }
}

/// The pipeline as one shader sees it: all sources, or those of one layer.
#[derive(Clone, Copy)]
struct Around<'a> {
    pipeline: &'a Pipeline,
    sources: &'a [usize],
    /// Of the hit that is being shaded; nothing is known of what its further rays meet.
    known: Known,
    /// Instance and triangle of that hit.
    face: [u32; 2],
    /// Whether what fills the space asks.
    among_leaves: bool,
}

impl<'a> Around<'a> {
    fn light_of(&self, source: &'a Source) -> &'a dyn Illuminate {
        &**source.among_leaves.as_ref().filter(|_| self.among_leaves).unwrap_or(&source.light)
    }

    /// Asks these sources for what arrives at `place`; of what is known nobody needs to be asked.
    fn ask(&self, sources: impl Iterator<Item = usize>, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        for i in sources {
            let source = self.light_of(&self.pipeline.sources[i]);
            let bit = if i < NUMBERED { 1u64 << i } else { 0 };
            if self.known.lit & bit != 0 {
                source.arrivals_on(self.face, place, &Vacuum, receive);
            } else if self.known.dark & bit == 0 {
                source.arrivals_on(self.face, place, &*self.pipeline.occlude, receive);
            }
        }
    }

    fn leaves(&self, hit: &light::Hit) -> Spectrum {
        let around = Self { face: [hit.instance, hit.triangle], ..*self };
        match self.pipeline.shade.get(hit.material as usize) {
            Some(shade) => shade.radiance(hit, &around),
            None => Spectrum::ZERO,
        }
    }

    /// What of a hit's light reaches the eye.
    fn eye_sees(&self, hit: &Hit) -> Spectrum {
        let leaves = self.leaves(hit);
        if self.pipeline.between.is_empty() {
            return leaves;
        }
        let (toward, length) = (hit.toward_eye, hit.distance);
        let ray = Ray { origin: hit.place.position + toward * length, direction: -toward, length };
        self.way(&ray, hit.path).bring(leaves)
    }

    /// What light loses and gains along a ray: where it passes several things that fill the space, nearly clear each, in any
    /// order; they do not overlap.
    fn way(&self, ray: &Ray, path: Path) -> Way {
        let around = Self { known: Known::default(), face: [u32::MAX; 2], among_leaves: true, ..*self };
        let ways = self.pipeline.between.iter().map(|fill| fill.way(ray, path, &around));
        ways.fold(Way::CLEAR, Way::then)
    }

    /// What is behind everything: for the eye all sources, for mirrored rays only those without highlights.
    fn background(&self, ray: &Ray, path: Path) -> Spectrum {
        let sources = self.sources.iter().map(|&i| &self.pipeline.sources[i]);
        sources
            .filter(|source| path.depth == 0 || !source.beam)
            .map(|source| source.light.radiance(ray))
            .sum()
    }
}

impl Surroundings for Around<'_> {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        self.ask(self.sources.iter().copied(), place, receive);
    }

    fn beams(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        let beams = self.sources.iter().copied().filter(|&i| self.pipeline.sources[i].beam);
        self.ask(beams, place, receive);
    }

    /// Only what fills the space asks, so nothing is known of the place.
    fn both_sides(&self, place: &Place) -> [Spectrum; 2] {
        let mut sides = [Spectrum::ZERO; 2];
        for source in self.sources.iter().map(|&i| &self.pipeline.sources[i]).filter(|source| !source.beam) {
            let found = self.light_of(source).both_sides(place, &*self.pipeline.occlude);
            sides.iter_mut().zip(found).for_each(|(side, found)| *side += found);
        }
        sides
    }

    fn scattered(&self, ray: &Ray) -> Spectrum {
        let sources = self.sources.iter().map(|&i| &self.pipeline.sources[i]);
        sources.map(|source| source.light.scattered(ray, &*self.pipeline.occlude)).sum()
    }

    fn radiance(&self, ray: &Ray, path: Path) -> Spectrum {
        if path.depth > self.pipeline.limits.depth || path.share < self.pipeline.limits.share {
            return Spectrum::ZERO;
        }
        let hit = self.pipeline.nearest.nearest(ray);
        let way = |length: f32| self.way(&Ray { length: ray.length.min(length), ..*ray }, path);
        match hit {
            Some(hit) => {
                let leaves = Around { known: Known::default(), ..*self }.leaves(&hit.on(path));
                way(hit.distance).bring(leaves)
            }
            None => way(f32::INFINITY).bring(self.background(ray, path)),
        }
    }
}

/// Layers of single sources hold what surfaces emit as well; it belongs to the last layer alone.
fn separate_emission(rows: &mut [Spectrum], width: usize) {
    let (parts, emission) = rows.split_at_mut(rows.len() - width);
    for part in parts[width..].chunks_mut(width) {
        // Rounding must not make light negative.
        part.iter_mut()
            .zip(emission.iter())
            .for_each(|(part, own)| *part = (*part - *own).map(|band| band.max(0.0)));
    }
}

/// From rows with all layers side by side to one picture per layer.
fn film(
    width: usize,
    height: usize,
    names: impl ExactSizeIterator<Item = String>,
    rows: Vec<Spectrum>,
) -> Film {
    let count = names.len();
    let pick = |layer: usize| -> Vec<Spectrum> {
        (0..height).flat_map(|row| rows[(row * count + layer) * width..][..width].iter().copied()).collect()
    };
    let (width32, height32) = (width as u32, height as u32);
    let pictures = if count == 1 { vec![rows] } else { (0..count).map(pick).collect() };
    let layers = names.zip(pictures).map(|(name, pixels)| Layer { name, pixels }).collect();
    Film { width: width32, height: height32, layers }
}
