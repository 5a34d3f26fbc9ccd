//! Water from the depth at which a white disc disappears.

use light::bands::XYZ_WEIGHTS;
use light::colour::D65;

use super::{CHLOROPHYLL_RANGE, QualityError, Water, within};

/// How often the disc's contrast is divided by e before it is lost: ln (C₀/C_T) of Tyler 1968 (Limnology and Oceanography
/// 13:1); others have 8 to 9.6.
pub const SECCHI_CONSTANT: f64 = 8.69;

impl Water {
    /// Depth z at which a white disc of 30 cm, seen from above, disappears \[m\]; infinite if the water takes nothing.
    ///
    /// Light reaches the disc with a loss of K, its image the eye with one of c (Preisendorfer 1986), and the eye weighs bands
    /// of daylight by V(λ):
    ///
    ///   Σ V D65 e^(−(c + K) z) = e^(−8.69) Σ V D65
    pub fn secchi_depth(&self) -> f64 {
        let lost = (self.extinction() + self.diffuse()).0.map(f64::from);
        let weights = XYZ_WEIGHTS[1].map(f64::from);
        let left = |depth: f64| {
            let bands = lost.iter().zip(weights).zip(D65.0);
            bands.map(|((k, weight), light)| weight * f64::from(light) * (-k * depth).exp()).sum::<f64>()
        };
        let wanted = (-SECCHI_CONSTANT).exp() * left(0.0);
        let smallest = lost.into_iter().fold(f64::INFINITY, f64::min);
        // In the clearest band alone it would be 8.69/k: the depth lies below.
        let (mut above, mut below) = (0.0, SECCHI_CONSTANT / smallest);
        if !below.is_finite() {
            return f64::INFINITY;
        }
        for _ in 0..60 {
            let middle = 0.5 * (above + below);
            if left(middle) > wanted {
                above = middle;
            } else {
                below = middle;
            }
        }
        0.5 * (above + below)
    }

    /// The Case 1 water ([`Water::of_chlorophyll`]) in which a Secchi disc disappears at `depth` \[m\].
    ///
    /// ```
    /// use keikan_water::Water;
    /// let lake = Water::of_secchi_depth(4.0).unwrap();
    /// assert!((lake.secchi_depth() - 4.0).abs() < 1e-4); // rounding of f32
    /// ```
    pub fn of_secchi_depth(depth: f64) -> Result<Self, QualityError> {
        let [least, most] = CHLOROPHYLL_RANGE;
        let range = [Self::of_chlorophyll(most)?.secchi_depth(), Self::of_chlorophyll(least)?.secchi_depth()];
        within("the Secchi depth", "m", depth, range)?;
        // More chlorophyll absorbs and scatters more in every band: one root. 60 halvings of 100 are below 1e-16.
        let (mut clear, mut turbid) = (least, most);
        for _ in 0..60 {
            let middle = 0.5 * (clear + turbid);
            if Self::of_chlorophyll(middle)?.secchi_depth() > depth {
                clear = middle;
            } else {
                turbid = middle;
            }
        }
        Self::of_chlorophyll(0.5 * (clear + turbid))
    }
}
