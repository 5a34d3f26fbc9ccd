//! The sun through and off a horizontal surface.

use glam::DVec3;
use light::{Spectrum, fresnel};

use crate::Surface;
use crate::path::transmitted;

/// The sun as it shines under water (thesis 3.6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunBelow {
    /// Unit vector under water towards the sun: within the critical angle of the zenith.
    pub toward: DVec3,
    /// Irradiance just under the surface on a horizontal plane, E₀ = (1 − α) cos θ I_sun \[W m⁻² nm⁻¹\].
    pub horizontal: Spectrum,
}

impl SunBelow {
    /// A sun in the direction of unit vector `toward_sun` that gives a plane facing it `irradiance` \[W m⁻² nm⁻¹\] in air. None below the horizon.
    ///
    /// ```
    /// use glam::DVec3;
    /// use keikan_water::{Surface, SunBelow};
    /// use light::Spectrum;
    /// let surface = Surface { level: 0.0, index: 1.34 };
    /// let sun = SunBelow::new(&surface, DVec3::new(3f64.sqrt() / 2.0, 0.5, 0.0), Spectrum::ONE).unwrap();
    /// assert!((sun.horizontal[0] - 0.469498).abs() < 1e-6); // of 0.5 in air at 60° from the zenith
    /// ```
    pub fn new(surface: &Surface, toward_sun: DVec3, irradiance: Spectrum) -> Option<Self> {
        let toward_sun = toward_sun.normalize_or_zero();
        let cos = toward_sun.y;
        if cos <= 0.0 {
            return None;
        }
        let n = surface.index;
        let below = ((n - 1.0) * (n + 1.0) + cos * cos).sqrt() / n;
        let share = transmitted(n, cos, below);
        let toward = DVec3::new(toward_sun.x / n, below, toward_sun.z / n).normalize();
        Some(Self { toward, horizontal: irradiance * (share * cos) as f32 })
    }

    /// Irradiance on a plane that faces the sun, `depth` \[m\] below the surface, with a loss of `coefficient` \[1/m\]:
    /// E₀ sec θ' e^(−K z sec θ') \[W m⁻² nm⁻¹\].
    pub fn facing(&self, depth: f64, coefficient: Spectrum) -> Spectrum {
        let sec = 1.0 / self.toward.y;
        self.horizontal * coefficient.attenuate((depth.max(0.0) * sec) as f32) * sec as f32
    }

    /// The same on a plane of unit normal `normal`; 0 from behind it.
    pub fn on_plane(&self, depth: f64, normal: DVec3, coefficient: Spectrum) -> Spectrum {
        self.facing(depth, coefficient) * normal.dot(self.toward).max(0.0) as f32
    }
}

/// The sun's mirror image (3.2): unit vector towards it, and irradiance on a plane in air that faces it, α I_sun \[W m⁻² nm⁻¹\].
/// None below the horizon.
pub fn mirrored_sun(surface: &Surface, toward_sun: DVec3, irradiance: Spectrum) -> Option<(DVec3, Spectrum)> {
    let toward_sun = toward_sun.normalize_or_zero();
    (toward_sun.y > 0.0).then(|| {
        let image = DVec3::new(toward_sun.x, -toward_sun.y, toward_sun.z);
        (image, irradiance * fresnel(surface.index, toward_sun.y) as f32)
    })
}
