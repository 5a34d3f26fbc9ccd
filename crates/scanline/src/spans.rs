//! Visible spans, before anything is made of them.

use glam::DVec2;

use crate::Scanline;
use crate::scanline::{Line, Scratch};
use crate::segment::Segment;

/// A part of a face that shows on a line.
///
/// All its points lie in the scan plane (through the eye and the line) and in the face: whatever cuts the
/// face along a line there, such as a shadow volume, cuts the span at a point, and nearness is linear in x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Left and right end on the screen \[pixel\], left < right, within the picture.
    pub x: [f64; 2],
    /// Nearness at both ends ([`light::View::screen_from_view`]).
    pub nearness: [f64; 2],
    /// Index into [`light::Geometry::instances`].
    pub instance: u32,
    /// Index of the triangle within its mesh.
    pub triangle: u32,
}

/// What shows on one line, from the left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spans {
    /// Faces without an opacity: nothing is in front of them but `veils`. They do not overlap.
    pub opaque: Vec<Span>,
    /// Parts of faces with an opacity that no opaque face hides. They may overlap.
    pub veils: Vec<Span>,
}

impl Scanline {
    /// How many sub-scanlines the picture has.
    pub fn line_count(&self) -> u32 {
        self.grid.lines()
    }

    /// Screen y of a sub-scanline \[pixel\], and the area of the picture it speaks for, as the
    /// rule weighs it, in rows.
    pub fn line(&self, line: u32) -> (f64, f64) {
        let row = self.grid.group_of(line);
        let mut weight = 0.0;
        for row in row.saturating_sub(1)..(row + 1).min(self.grid.rows) {
            if self.grid.of_row(row).contains(&line) {
                weight += self.grid.weight(row, line);
            }
        }
        (self.grid.y(line), weight)
    }

    /// What shows on sub-scanline `line`; nothing beyond the last.
    pub fn spans(&self, line: u32) -> Spans {
        if line >= self.grid.lines() {
            return Spans::default();
        }
        let group = self.grid.group_of(line);
        let place = line - self.grid.group(group).start;
        let mut lines = Vec::new();
        self.group(group, place + 1, &mut Scratch::default(), &mut lines);
        let Line { opaque, veils, .. } = std::mem::take(&mut lines[place as usize]);
        let name =
            |segments: Vec<Segment>| segments.iter().filter_map(|segment| self.name(segment)).collect();
        Spans { opaque: name(opaque), veils: name(veils) }
    }

    /// None for what lies in the margin.
    fn name(&self, segment: &Segment) -> Option<Span> {
        let margin = f64::from(self.margin);
        let x = [segment.x0.max(margin), segment.x1.min(f64::from(self.view.width) - margin)];
        let (instance, triangle) = self.face(segment.face);
        let nearness = x.map(|x| segment.nearness(x));
        (x[0] < x[1]).then(|| Span { x: x.map(|x| x - margin), nearness, instance, triangle })
    }

    /// The point of a span at screen x `x` on a line, in the world \[m\].
    pub fn point(&self, line: u32, span: &Span, x: f64) -> glam::DVec3 {
        let share = (x - span.x[0]) / (span.x[1] - span.x[0]);
        let nearness = span.nearness[0] + (span.nearness[1] - span.nearness[0]) * share;
        let (origin, direction) = self.view.line(DVec2::new(x + f64::from(self.margin), self.grid.y(line)));
        let forward = -self.view.world_from_view.z_axis;
        let depth = self.depth(nearness);
        origin + direction * (depth / direction.dot(forward))
    }

    /// Depth along the line of sight \[m\] of a nearness.
    pub(crate) fn depth(&self, nearness: f64) -> f64 {
        match self.view.projection {
            light::Projection::Perspective { .. } => 1.0 / nearness,
            light::Projection::Orthographic { .. } => -nearness,
        }
    }
}
