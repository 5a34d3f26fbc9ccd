//! The eye: from the world to the picture and back.

use glam::{DMat3, DVec2, DVec3};

use crate::Ray;

/// How the world is brought onto the picture plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Central projection; tangent of half the vertical field of view.
    Perspective {
        /// tan(½ vertical field of view), > 0.
        tan_half_height: f64,
    },
    /// Parallel projection (elevations, plans).
    Orthographic {
        /// Half the height of the picture in the world \[m\], > 0.
        half_height: f64,
    },
}

/// An eye with a picture of `width` × `height` square pixels.
///
/// Screen coordinates: x to the right, y *down*, the picture spans \[0, width\] × \[0, height\], pixel
/// (i, j) covers \[i, i+1\] × \[j, j+1\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the eye is \[m\].
    pub eye: DVec3,
    /// Columns: right, up, and *backward* (the eye looks along −Z), a rotation.
    pub world_from_view: DMat3,
    /// How it projects.
    pub projection: Projection,
    /// Pixels in a row, ≥ 1.
    pub width: u32,
    /// Rows, ≥ 1.
    pub height: u32,
    /// Nothing nearer than this is seen \[m\], > 0 for a perspective.
    pub near: f64,
}

impl View {
    /// A perspective from `eye` to `target` with +Y up, `vertical_field` in degrees.
    ///
    /// Where the line of sight is vertical, −Z is up in the picture.
    pub fn look_at(eye: DVec3, target: DVec3, vertical_field: f64, width: u32, height: u32) -> Self {
        let back = (eye - target).try_normalize().unwrap_or(DVec3::Z);
        let right = DVec3::Y.cross(back).try_normalize().unwrap_or(DVec3::X);
        let tan_half_height = (vertical_field.to_radians() * 0.5).tan();
        Self {
            eye,
            world_from_view: DMat3::from_cols(right, back.cross(right), back),
            projection: Projection::Perspective { tan_half_height },
            width,
            height,
            near: 1e-3,
        }
    }

    /// World point to view coordinates \[m\]: x right, y up, z backward (visible points have z < 0).
    pub fn view_from_world(&self, point: DVec3) -> DVec3 {
        self.world_from_view.transpose() * (point - self.eye)
    }

    /// Pixels per unit of (view x, view y) at depth 1 (perspective) or anywhere (orthographic).
    pub fn scale(&self) -> f64 {
        0.5 * self.height as f64
            / match self.projection {
                Projection::Perspective { tan_half_height } => tan_half_height,
                Projection::Orthographic { half_height } => half_height,
            }
    }

    /// View coordinates to screen x, y and *nearness*: a number that is linear along straight lines on
    /// the screen and greater for what is nearer (1/depth for a perspective, −depth otherwise).
    /// The point must lie beyond `near`.
    pub fn screen_from_view(&self, point: DVec3) -> DVec3 {
        let scale = self.scale();
        let (x0, y0) = (0.5 * self.width as f64, 0.5 * self.height as f64);
        match self.projection {
            Projection::Perspective { .. } => {
                let nearness = -1.0 / point.z;
                DVec3::new(x0 + point.x * nearness * scale, y0 - point.y * nearness * scale, nearness)
            }
            Projection::Orthographic { .. } => {
                DVec3::new(x0 + point.x * scale, y0 - point.y * scale, point.z)
            }
        }
    }

    /// Origin and unit direction, in f64, of the viewing ray through screen point `at`.
    pub fn line(&self, at: DVec2) -> (DVec3, DVec3) {
        let scale = self.scale();
        let x = (at.x - 0.5 * self.width as f64) / scale;
        let y = (0.5 * self.height as f64 - at.y) / scale;
        match self.projection {
            Projection::Perspective { .. } => {
                (self.eye, (self.world_from_view * DVec3::new(x, y, -1.0)).normalize())
            }
            Projection::Orthographic { .. } => {
                (self.eye + self.world_from_view * DVec3::new(x, y, 0.0), -self.world_from_view.z_axis)
            }
        }
    }

    /// The viewing ray through screen point `at`, from the eye (not from the near plane).
    pub fn ray(&self, at: DVec2) -> Ray {
        let (origin, direction) = self.line(at);
        Ray::new(origin.as_vec3(), direction.as_vec3())
    }

    /// Width of a pixel \[m\] at `depth` metres along the line of sight.
    pub fn pixel_width(&self, depth: f64) -> f64 {
        match self.projection {
            Projection::Perspective { .. } => depth / self.scale(),
            Projection::Orthographic { .. } => 1.0 / self.scale(),
        }
    }
}
