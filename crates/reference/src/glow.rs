//! Faces that shine, and points drawn on them by how much they send.

use glam::DVec3;

use crate::bands::Bands;
use crate::dice::Dice;
use crate::shape::{Met, Point, Shape};
use crate::surface::Surface;
use crate::tree::{Line, Meeting};

/// Which faces shine.
pub(crate) struct Glow {
    /// Triangles and cumulated products of area and brightness.
    triangles: Vec<(u32, f64)>,
}

/// A point of a face that shines, as a place sees it.
pub(crate) struct Shining {
    pub(crate) toward: DVec3,
    pub(crate) length: f64,
    /// Radiance, times how much of the face is there.
    pub(crate) radiance: Bands,
    /// Density with which it was drawn \[1/sr\].
    pub(crate) density: f64,
}

impl Glow {
    /// None where no face shines.
    pub(crate) fn new(shape: &Shape, surface: impl Fn(u32) -> f64) -> Option<Self> {
        let mut sum = 0.0;
        let shining = shape.things().filter_map(|(triangle, number)| {
            let own = surface(number) * 0.5 * shape.cross(triangle).length();
            (own > 0.0).then(|| {
                sum += own;
                (triangle, sum)
            })
        });
        let triangles: Vec<_> = shining.collect();
        (!triangles.is_empty()).then_some(Self { triangles })
    }

    fn whole(&self) -> f64 {
        self.triangles.last().map_or(1.0, |last| last.1)
    }

    /// A point of some face that `from` sees the front or the back of.
    pub(crate) fn draw<'a>(
        &self,
        shape: &Shape,
        surface: impl Fn(u32) -> &'a Surface,
        from: DVec3,
        dice: &mut Dice,
    ) -> Option<Shining> {
        let choice = dice.roll() * self.whole();
        let chosen = self.triangles.partition_point(|(_, end)| *end <= choice).min(self.triangles.len() - 1);
        let (triangle, _) = self.triangles[chosen];
        let [u, v] = dice.pair();
        let meeting = Meeting { distance: 0.0, triangle, weights: [u.sqrt() * (1.0 - v), u.sqrt() * v] };
        let to = shape.position(&meeting) - from;
        let length = to.length();
        let toward = to.try_normalize()?;
        let met = Met::Triangle(meeting);
        let point = shape.point(&Line { origin: from, direction: toward }, &met);
        let surface = surface(point.surface);
        let density = self.density(surface, &point, toward, length);
        let radiance = surface.emitted(&point) * shape.opacity(&met);
        (density.is_finite()).then_some(Shining { toward, length, radiance, density })
    }

    /// Density with which a point of a face is drawn from `length` away \[1/sr\].
    pub(crate) fn density(&self, surface: &Surface, point: &Point, toward: DVec3, length: f64) -> f64 {
        surface.brightness() / self.whole() * length * length / toward.dot(point.normal).abs()
    }
}
