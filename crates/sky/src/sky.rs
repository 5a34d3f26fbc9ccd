//! How bright is the sky, and of what colour, in this direction?

use glam::Vec3;
use light::{Spectrum, Uniform};

/// How bright is the sky, and of what colour, in this direction?
///
/// Every sky answers this one question: standard distributions of luminance, measured tables, scattering in the
/// air. The sun's disc is never part of it. Skies do not turn with the asker: where the sun stands belongs to the
/// sky.
pub trait Sky: Send + Sync {
    /// Radiance from the unit vector `direction` \[W m⁻² sr⁻¹ nm⁻¹\], finite and never negative; a direction
    /// below the horizon (y < 0) has what the horizon beneath it has, the nadir that of any bearing.
    fn radiance(&self, direction: Vec3) -> Spectrum;

    /// Unit vector towards the brightest part: the sun where the sky has one, else the zenith; never below
    /// the horizon.
    fn brightest(&self) -> Vec3;
}

/// The same radiance from everywhere: the simplest sky.
///
/// ```
/// use glam::Vec3;
/// use keikan_sky::Sky;
/// let sky = light::Uniform { radiance: light::Spectrum::ONE };
/// assert_eq!(Sky::radiance(&sky, Vec3::X), light::Spectrum::ONE);
/// ```
impl Sky for Uniform {
    fn radiance(&self, _: Vec3) -> Spectrum {
        self.radiance
    }

    fn brightest(&self) -> Vec3 {
        Vec3::Y
    }
}

/// The direction itself, or where it is below the horizon, the horizon beneath it; −Z for the nadir.
pub(crate) fn lifted(direction: Vec3) -> Vec3 {
    if direction.y >= 0.0 {
        direction
    } else {
        Vec3::new(direction.x, 0.0, direction.z).try_normalize().unwrap_or(Vec3::NEG_Z)
    }
}
