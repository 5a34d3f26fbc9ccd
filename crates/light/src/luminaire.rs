//! A point source with a distribution of its own.

use glam::{Mat3, Vec3};

use crate::{Arrival, Illuminate, Occlude, Place, Spectrum};

/// Luminous intensity over direction: half-planes C (about the axis) by angles γ from the axis.
///
/// In the luminaire's own frame the axis γ = 0 is −Z (where a glTF light looks; the nadir of a lamp that
/// hangs), C = 0 lies in the half-plane of +X, and C grows from +X towards +Y... seen *against* the axis,
/// i.e. counter-clockwise for who looks along +Z from below. Linear between the tabulated angles.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    c: Vec<f32>,
    gamma: Vec<f32>,
    candela: Vec<f32>,
}

impl Distribution {
    /// From C angles (degrees, rising within \[0, 360\]), γ angles (degrees, rising within \[0, 180\]) and
    /// intensities \[cd\], γ running fastest. One C angle means rotational symmetry; otherwise the
    /// table must go all the way round (a plane at 360° or a wrap from the last plane to the first).
    /// None if the sizes do not fit, an angle is out of order or an intensity is negative or not finite.
    pub fn new(c: Vec<f32>, gamma: Vec<f32>, candela: Vec<f32>) -> Option<Self> {
        let rising = |angles: &[f32], limit: f32| {
            !angles.is_empty()
                && angles.iter().all(|a| (0.0..=limit).contains(a))
                && angles.windows(2).all(|w| w[0] < w[1])
        };
        let fits = c.len().checked_mul(gamma.len()) == Some(candela.len());
        let sound = candela.iter().all(|i| i.is_finite() && *i >= 0.0);
        (rising(&c, 360.0) && rising(&gamma, 180.0) && fits && sound).then_some(Self { c, gamma, candela })
    }

    /// The same intensity \[cd\] in every direction.
    pub fn isotropic(candela: f32) -> Self {
        Self { c: vec![0.0], gamma: vec![0.0, 180.0], candela: vec![candela; 2] }
    }

    /// Intensity \[cd\] along the unit vector `direction` in the luminaire's frame; 0 outside the γ range.
    pub fn intensity(&self, direction: Vec3) -> f32 {
        // atan2 keeps its digits at the poles, where acos(−z) loses half of them.
        let gamma = direction.truncate().length().atan2(-direction.z).to_degrees();
        let slack = 1e-3; // degrees: rounding of the angle must not switch off the last tabulated one
        if gamma < self.gamma[0] - slack || gamma > self.gamma[self.gamma.len() - 1] + slack {
            return 0.0;
        }
        let (g0, g1, share) = bracket(&self.gamma, gamma);
        let along = |plane: usize| {
            let row = &self.candela[plane * self.gamma.len()..][..self.gamma.len()];
            row[g0] + share * (row[g1] - row[g0])
        };
        if self.c.len() == 1 {
            return along(0);
        }
        let angle = direction.y.atan2(direction.x).to_degrees().rem_euclid(360.0);
        let last = self.c.len() - 1;
        if angle < self.c[0] || angle > self.c[last] {
            // Between the last plane and the first, across 360°.
            let gap = self.c[0] + 360.0 - self.c[last];
            let into = (angle - self.c[last]).rem_euclid(360.0);
            let share = if gap > 0.0 { (into / gap).clamp(0.0, 1.0) } else { 0.0 };
            return along(last) + share * (along(0) - along(last));
        }
        let (c0, c1, share) = bracket(&self.c, angle);
        along(c0) + share * (along(c1) - along(c0))
    }

    /// Luminous flux \[lm\]: ∫ I dω of the very interpolation that [`Self::intensity`] makes, by the
    /// midpoint rule with `steps` angles γ over 180° and twice as many C over 360°.
    pub fn flux(&self, steps: usize) -> f64 {
        use std::f64::consts::PI;
        let h = PI / steps as f64;
        let mut sum = 0.0;
        for i in 0..steps {
            let gamma = (i as f64 + 0.5) * h;
            for j in 0..2 * steps {
                let c = (j as f64 + 0.5) * h;
                let direction =
                    Vec3::new((gamma.sin() * c.cos()) as f32, (gamma.sin() * c.sin()) as f32, -gamma.cos() as f32);
                sum += f64::from(self.intensity(direction)) * gamma.sin() * h * h;
            }
        }
        sum
    }

    /// The largest tabulated intensity \[cd\].
    pub fn peak(&self) -> f32 {
        self.candela.iter().fold(0.0, |peak, &i| peak.max(i))
    }

    /// The same distribution, every intensity times `factor` (≥ 0).
    pub fn scaled(mut self, factor: f32) -> Self {
        self.candela.iter_mut().for_each(|i| *i *= factor);
        self
    }
}

/// Indices around `x` in the rising `table` and the share of the second; clamped at the ends.
fn bracket(table: &[f32], x: f32) -> (usize, usize, f32) {
    let after = table.partition_point(|&t| t <= x);
    if after == 0 {
        return (0, 0, 0.0);
    }
    if after == table.len() {
        return (after - 1, after - 1, 0.0);
    }
    (after - 1, after, (x - table[after - 1]) / (table[after] - table[after - 1]))
}

/// A point source: where, how turned, how strong in which direction, of what spectrum.
#[derive(Clone, Debug)]
pub struct Luminaire {
    /// Where \[m\].
    pub position: Vec3,
    /// Rotation from the luminaire's frame (axis −Z, C = 0 at +X) to the world.
    pub world_from_luminaire: Mat3,
    /// Intensity over direction \[cd\].
    pub distribution: Distribution,
    /// Spectral intensity per candela \[W sr⁻¹ nm⁻¹ cd⁻¹\]: a spectrum whose luminance is 1.
    pub spectrum: Spectrum,
}

impl Luminaire {
    /// Spectral intensity along the unit vector `direction` in the world \[W sr⁻¹ nm⁻¹\].
    pub fn intensity(&self, direction: Vec3) -> Spectrum {
        self.spectrum * self.distribution.intensity(self.world_from_luminaire.transpose() * direction)
    }
}

impl Illuminate for Luminaire {
    /// E = I / r² facing the lamp (thesis eq. 3.9 without its cosine). At the lamp itself: nothing.
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        let segment = place.toward(self.position);
        let distance2 = place.position.distance_squared(self.position);
        let intensity = self.intensity(-segment.direction);
        if distance2 <= 0.0 || intensity.is_zero() || segment.direction.dot(place.normal) <= 0.0 {
            return;
        }
        let transmittance = occlude.transmittance(&segment);
        if !transmittance.is_zero() {
            receive(Arrival::Beam {
                toward: segment.direction,
                irradiance: intensity * transmittance * (1.0 / distance2),
            });
        }
    }
}
