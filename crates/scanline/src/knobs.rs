//! What can be chosen, with what it costs and leaves.

/// How finely and by which rule coverage is measured. [`Knobs::default`] is the measured best buy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Knobs {
    /// Strips that a pixel row is cut into, 1..=64 (values outside are brought inside). Finding spans
    /// takes time in proportion, shading (once per pixel) does not. RMSE of coverage over the pixels at
    /// edges of 150 triangles of all directions, 100 level rectangles, and at the outlines of terrain with faces
    /// about as wide as a pixel (`tests/coverage.rs`):
    ///
    /// | strips | trapezoid | midpoint | exact | level: midpoint | exact | terrain: midpoint | exact |
    /// | --- | --- | --- | --- | --- | --- | --- | --- |
    /// | 1 | 0.133 | 0.105 | 10⁻⁸ | 0.186 | 10⁻⁸ | 0.222 | 0.197 |
    /// | 2 | 0.0404 | 0.0310 | 10⁻⁸ | 0.093 | 10⁻⁸ | 0.097 | 0.074 |
    /// | 4 | 0.0085 | 0.0059 | 10⁻⁸ | 0.046 | 10⁻⁸ | 0.035 | 0.033 |
    /// | 8 | 0.0023 | 0.0017 | 10⁻⁸ | 0.023 | 10⁻⁸ | 0.0118 | 0.0102 |
    /// | 16 | 0.00062 | 0.00048 | 10⁻⁸ | 0.012 | 10⁻⁸ | | |
    pub sub_scanlines: u32,
    /// How areas are summed from the lengths on the sub-scanlines.
    pub rule: Rule,
    /// How often a face is shaded.
    pub shading: Shading,
}

impl Default for Knobs {
    fn default() -> Self {
        Self { sub_scanlines: 4, rule: Rule::Exact, shading: Shading::PerPixel }
    }
}

/// Where the sub-scanlines of a row lie and what they weigh (h = 1/`sub_scanlines`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// On the borders of the strips, weights h/2, h, …, h, h/2 (thesis 2.3.3); neighbouring rows share a
    /// line, so that a row costs as many lines as it has strips.
    Trapezoid,
    /// In the middle of each strip, weights h.
    Midpoint,
    /// As the midpoint rule, but every border leans as its edge does, and areas are those between leaning
    /// borders. Strips end where corners are, as far as that takes at most an eighth more lines (and 16). Exact
    /// where corners are so few and borders do not cross within a strip. Takes 1.0 to 1.4 times as long as the
    /// midpoint rule. Veils are measured by the midpoint rule.
    Exact,
}

/// How often a face is shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// Once per visible face and pixel, at the centroid of what shows of it.
    PerPixel,
    /// Once per visible span and pixel on each sub-scanline, at the middle: about `sub_scanlines` times
    /// the shading, for surfaces that vary within a pixel. Faces with an opacity stay at once per pixel.
    PerSpan,
}
