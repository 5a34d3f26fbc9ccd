//! The picture, row by row.

use std::ops::Range;

use light::{Piece, See};

use crate::cut::Cutter;
use crate::pixel::Pixel;
use crate::scanline::{Line, Scratch};
use crate::{Rule, Scanline};

impl See for Scanline {
    fn see(&self, rows: Range<u32>, columns: Range<u32>, receive: &mut dyn FnMut(u32, &mut Vec<Piece>)) {
        let rows = rows.start..rows.end.min(self.view.height);
        let columns = columns.start..columns.end.min(self.view.width - 2 * self.margin);
        let (mut scratch, mut pixel) = (Scratch::default(), Pixel::default());
        let (mut lines, mut below): (Vec<Line>, Vec<Line>) = (Vec::new(), Vec::new());
        let (mut pieces, mut cutter) = (Vec::new(), Cutter::default());
        // The trapezoid rule ends a row on the first line of the next: groups are found one row ahead.
        let ahead = self.grid.rule == Rule::Trapezoid;
        if ahead && !rows.is_empty() {
            self.group(rows.start, u32::MAX, &mut scratch, &mut below);
            self.cut(rows.start, &columns, &mut below, &mut cutter, &mut pixel.table);
        }
        for row in rows.clone() {
            if ahead {
                std::mem::swap(&mut lines, &mut below);
                let count = if row + 1 < rows.end { u32::MAX } else { 1 };
                self.group(row + 1, count, &mut scratch, &mut below);
                self.cut(row + 1, &columns, &mut below, &mut cutter, &mut pixel.table);
            } else {
                self.group(row, u32::MAX, &mut scratch, &mut lines);
                self.cut(row, &columns, &mut lines, &mut cutter, &mut pixel.table);
            }
            let last = below.iter().take(usize::from(ahead));
            pieces.clear();
            self.resolve(row, columns.clone(), lines.iter().chain(last), &mut pixel, &mut pieces);
            receive(row, &mut pieces);
        }
    }
}
