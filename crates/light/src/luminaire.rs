//! A point source with a distribution of its own.

use glam::{Mat3, Vec3};

use crate::{Arrival, Illuminate, Occlude, Place, Spectrum};

/// Luminous intensity over direction: half-planes C (about the axis) by angles γ from the axis.
///
/// The luminaire's own frame, right-handed:
///
/// | direction | axis | of a lamp that hangs |
/// | --- | --- | --- |
/// | γ = 0 | −Z, where a glTF light looks | nadir |
/// | γ = 90°, C = 0 | +X, along the luminaire's length | IES LM-63: photometric horizontal, street side |
/// | γ = 90°, C = 90° | +Y, along its width | |
/// | γ = 180° | +Z | zenith |
///
/// So C grows counter-clockwise for who looks down on the lamp (against +Z), clockwise for who looks up into
/// it: d = (sin γ cos C, sin γ sin C, −cos γ). This is type C of IES LM-63 ("counterclockwise in a horizontal
/// plane", the 0–180° plane along the length; Radiance's `ies2rad` lays it out alike) and the (C, γ) system
/// of CIE 121 with its C = 0 turned to the length. Readers of other conventions turn their tables into this
/// one. Linear in γ, then in C, between the tabulated angles; dark outside the tabulated γ.
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
    /// midpoint rule with `steps` angles γ over 180° and twice as many C over 360°. The slow reference of
    /// [`Self::total_flux`].
    pub fn flux(&self, steps: usize) -> f64 {
        use std::f64::consts::PI;
        let h = PI / steps as f64;
        let mut sum = 0.0;
        for i in 0..steps {
            let gamma = (i as f64 + 0.5) * h;
            for j in 0..2 * steps {
                let c = (j as f64 + 0.5) * h;
                let direction = Vec3::new(
                    (gamma.sin() * c.cos()) as f32,
                    (gamma.sin() * c.sin()) as f32,
                    -gamma.cos() as f32,
                );
                sum += f64::from(self.intensity(direction)) * gamma.sin() * h * h;
            }
        }
        sum
    }

    /// Luminous flux \[lm\] in closed form: ∫ I dω of the interpolation that [`Self::intensity`] makes.
    ///
    /// Linear in C, so the integral over C at each tabulated γ is the trapezoidal sum M(γ) = Σ w I. Linear in
    /// γ between a and b, so each zone gives
    /// M(a) (cos a − cos b) + (M(b) − M(a)) ((sin b − sin a) / (b − a) − cos b).
    ///
    /// ```
    /// let lamp = keikan_light::Distribution::isotropic(100.0);
    /// assert!((lamp.total_flux() - 400.0 * std::f64::consts::PI).abs() < 1e-9); // 4π I
    /// ```
    pub fn total_flux(&self) -> f64 {
        let weights = self.plane_weights();
        let around = |g: usize| -> f64 {
            let rows = self.candela.chunks_exact(self.gamma.len());
            rows.zip(&weights).map(|(row, w)| f64::from(row[g]) * w).sum()
        };
        let mut sum = 0.0;
        let mut below = around(0);
        for (g, pair) in self.gamma.windows(2).enumerate() {
            let (a, b) = (f64::from(pair[0]).to_radians(), f64::from(pair[1]).to_radians());
            let above = around(g + 1);
            sum += below * (a.cos() - b.cos()) + (above - below) * ((b.sin() - a.sin()) / (b - a) - b.cos());
            below = above;
        }
        sum
    }

    /// What each C plane counts for in an integral over C \[rad\]: half the way to either neighbour, across
    /// 360° too; the sum is 2π.
    fn plane_weights(&self) -> Vec<f64> {
        let count = self.c.len();
        let after = |i: usize| {
            let here = f64::from(self.c[i]);
            if i + 1 < count { f64::from(self.c[i + 1]) - here } else { f64::from(self.c[0]) + 360.0 - here }
        };
        (0..count).map(|i| (0.5 * (after(i) + after((i + count - 1) % count))).to_radians()).collect()
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
                radius: 0.0,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// A table in the frame of the type, from `candela(C, γ)` in degrees.
    fn tabulated(c_step: f32, gamma_step: f32, candela: impl Fn(f32, f32) -> f32) -> Distribution {
        let angles = |limit: f32, step: f32| -> Vec<f32> {
            (0..=(limit / step).round() as usize).map(|i| i as f32 * step).collect()
        };
        let (c, gamma) = (angles(360.0, c_step), angles(180.0, gamma_step));
        let table = c.iter().flat_map(|&c| gamma.iter().map(move |&g| (c, g)));
        let table = table.map(|(c, g)| candela(c, g)).collect();
        Distribution::new(c, gamma, table).expect("the table is sound")
    }

    #[test]
    fn frame_is_as_written() {
        // Intensity = C + 1000 γ/90 tells every direction from every other.
        let lamp = tabulated(30.0, 15.0, |c, gamma| if c < 360.0 { c } else { 0.0 } + gamma * 1000.0 / 90.0);
        for (direction, c, gamma) in [
            (Vec3::NEG_Z, 0.0, 0.0),
            (Vec3::X, 0.0, 90.0),
            (Vec3::Y, 90.0, 90.0),
            (Vec3::NEG_X, 180.0, 90.0),
            (Vec3::NEG_Y, 270.0, 90.0),
        ] {
            // The nodes of a table are returned exactly but for the angle's rounding: 1e-5 ° × 12 cd per °.
            let expected = c + gamma * 1000.0 / 90.0;
            assert!((lamp.intensity(direction) - expected).abs() < 1e-3, "{direction}");
        }
    }

    #[test]
    fn closed_flux_of_known_lamps() {
        // Isotropic: 4π I, exactly but for the f64 sum.
        assert!((Distribution::isotropic(1.0).total_flux() - 4.0 * PI).abs() < 1e-12);
        // Lambert: I0 cos γ below: π I0. Linear interpolation of a concave function errs by at most h²/8
        // inwards, over 2π ∫ sin γ dγ = 2π; f32 candela add 2⁻²⁴ of it.
        for step in [1.0_f32, 2.5, 5.0, 10.0] {
            let lamp = tabulated(90.0, step, |_, gamma| gamma.to_radians().cos().max(0.0));
            let h = f64::from(step).to_radians();
            assert!((lamp.total_flux() - PI).abs() <= 2.0 * PI * h * h / 8.0 + 1e-6, "{step}");
        }
    }

    #[test]
    fn closed_flux_is_that_of_the_reference() {
        // A lopsided lamp whose planes do not close at 360° and whose γ end early.
        let (c, gamma) = (vec![20.0, 100.0, 110.0, 300.0], vec![30.0, 60.0, 120.0, 160.0]);
        let candela = (0..16).map(|i| ((i * 7) % 13) as f32).collect();
        let lamp = Distribution::new(c, gamma, candela).expect("the table is sound");
        // Midpoint rule with h = π/400: smooth part h²/24 · area · |f″| is below 1e-3; the two cliffs (at
        // 30° and 160°) lie on cell edges only by chance, each costs at most h/2 · 2π · peak · sin γ.
        let steps = 400;
        let bound = 2.0 * PI * PI / steps as f64 * f64::from(lamp.peak()) / 2.0 + 1e-3;
        assert!((lamp.total_flux() - lamp.flux(steps)).abs() <= bound);
    }

    #[test]
    fn unsound_tables_are_refused() {
        let new = |c: &[f32], g: &[f32], i: &[f32]| Distribution::new(c.to_vec(), g.to_vec(), i.to_vec());
        assert!(new(&[0.0], &[0.0, 90.0], &[1.0]).is_none());
        assert!(new(&[0.0], &[90.0, 0.0], &[1.0, 1.0]).is_none());
        assert!(new(&[0.0], &[0.0, f32::NAN], &[1.0, 1.0]).is_none());
        assert!(new(&[0.0], &[0.0, 181.0], &[1.0, 1.0]).is_none());
        assert!(new(&[0.0], &[0.0, 90.0], &[1.0, -1.0]).is_none());
        assert!(new(&[0.0], &[0.0, 90.0], &[1.0, f32::INFINITY]).is_none());
        assert!(new(&[], &[], &[]).is_none());
    }
}
