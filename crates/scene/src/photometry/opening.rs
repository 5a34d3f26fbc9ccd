//! The luminous opening: what of a luminaire shines.

/// Shape of a luminous opening. A flat one looks along the axis γ = 0 unless it says otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Too small to matter; all sizes are 0.
    Point,
    /// Rectangle; a box with luminous sides if its height is not 0.
    Rectangle,
    /// Ellipse, or circle; an upright cylinder if its height is not 0.
    Ellipse,
    /// Ellipsoid, or sphere.
    Ellipsoid,
    /// Cylinder that lies along the length (X); its diameter is the width.
    CylinderAlongLength,
    /// Cylinder that lies along the width (Y); its diameter is the length.
    CylinderAlongWidth,
    /// Upright ellipse, or circle, that looks along C = 0 (X); its sizes are width and height.
    UprightEllipse,
}

/// Shape and size of a luminous opening, in the frame of [`light::Distribution`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// Its shape.
    pub shape: Shape,
    /// Along X, C0–C180 \[m\], ≥ 0.
    pub length: f64,
    /// Along Y, C90–C270 \[m\], ≥ 0.
    pub width: f64,
    /// Along the axis \[m\], ≥ 0; 0 for a flat one.
    pub height: f64,
}

impl Opening {
    /// No size.
    pub const POINT: Self = Self { shape: Shape::Point, length: 0.0, width: 0.0, height: 0.0 };

    /// As LM-63 writes it: sizes \[m\] whose signs and zeros tell the shape.
    ///
    /// Up to 1995 a circle is (−d, 0, 0), upright cylinder (−d, 0, h), sphere (−d, 0, −d), lying cylinder
    /// (0, l, −d) or (w, 0, −d), ellipse (−w, l, 0) or (w, −l, 0), ellipsoid (−w, l, −h). Since 2002 every
    /// round direction is negative: circle (−d, −d, 0), sphere (−d, −d, −d), lying cylinder (−d, l, −d),
    /// upright circle (−d, 0, −d). Both are read; `since_2002` settles the two that clash.
    pub(super) fn from_lm63(width: f64, length: f64, height: f64, since_2002: bool) -> Self {
        let sign = |size: f64| if size == 0.0 { 0 } else { size.signum() as i8 };
        let (mut w, mut l, h) = (width.abs(), length.abs(), height.abs());
        let shape = match (sign(width), sign(length), sign(height)) {
            (0, 0, 0) => Shape::Point,
            (-1, 0, -1) if since_2002 => Shape::UprightEllipse,
            (-1, 1, -1) if since_2002 => Shape::CylinderAlongLength,
            (1, -1, -1) if since_2002 => Shape::CylinderAlongWidth,
            (-1, 0, height) => {
                l = w;
                if height < 0 { Shape::Ellipsoid } else { Shape::Ellipse }
            }
            (0, 1, -1) => {
                w = h;
                Shape::CylinderAlongLength
            }
            (1, 0, -1) => {
                l = h;
                Shape::CylinderAlongWidth
            }
            (-1, _, -1) | (_, -1, -1) => Shape::Ellipsoid,
            (-1, _, _) | (_, -1, _) => Shape::Ellipse,
            _ => Shape::Rectangle,
        };
        Self { shape, length: l, width: w, height: h }
    }

    /// As EULUMDAT writes it: length or diameter, width (0 for a circle), height; all \[m\].
    pub(super) fn from_eulumdat(length: f64, width: f64, height: f64) -> Self {
        let (length, width, height) = (length.max(0.0), width.max(0.0), height.max(0.0));
        match (length > 0.0, width > 0.0) {
            (false, false) if height == 0.0 => Self::POINT,
            (true, false) => Self { shape: Shape::Ellipse, length, width: length, height },
            _ => Self { shape: Shape::Rectangle, length, width, height },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_tell_the_shape() {
        let of = |w, l, h, since_2002| {
            let o = Opening::from_lm63(w, l, h, since_2002);
            (o.shape, o.length, o.width, o.height)
        };
        assert_eq!(of(0.0, -0.0, 0.0, false), (Shape::Point, 0.0, 0.0, 0.0));
        assert_eq!(of(0.2, 1.2, 0.1, true), (Shape::Rectangle, 1.2, 0.2, 0.1));
        assert_eq!(of(-0.2, 0.0, 0.0, false), (Shape::Ellipse, 0.2, 0.2, 0.0));
        assert_eq!(of(-0.2, -0.2, 0.3, true), (Shape::Ellipse, 0.2, 0.2, 0.3));
        assert_eq!(of(-0.2, 0.0, -0.2, false), (Shape::Ellipsoid, 0.2, 0.2, 0.2));
        assert_eq!(of(-0.2, 0.0, -0.2, true), (Shape::UprightEllipse, 0.0, 0.2, 0.2));
        assert_eq!(of(-0.2, -0.2, -0.2, true), (Shape::Ellipsoid, 0.2, 0.2, 0.2));
        assert_eq!(of(0.0, 1.2, -0.1, false), (Shape::CylinderAlongLength, 1.2, 0.1, 0.1));
        assert_eq!(of(1.2, 0.0, -0.1, false), (Shape::CylinderAlongWidth, 0.1, 1.2, 0.1));
        assert_eq!(of(-0.1, 1.2, -0.1, true), (Shape::CylinderAlongLength, 1.2, 0.1, 0.1));
        assert_eq!(of(-0.1, 1.2, -0.1, false), (Shape::Ellipsoid, 1.2, 0.1, 0.1));
    }
}
