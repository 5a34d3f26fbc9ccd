//! The slow reference of multiple scattering: single paths of light followed backwards, in f64, with every phase
//! function as it is and nothing tabulated.

use glam::DVec3;

/// One wavelength's air, given by plain numbers.
pub(super) struct Gas {
    /// Scattering of molecules, extinction of aerosol, absorption of ozone within its layer, at sea level \[1/m\].
    pub(super) coefficients: [f64; 3],
    /// Scale heights of molecules and aerosol \[m\].
    pub(super) scales: [f64; 2],
    pub(super) aerosol_albedo: f64,
    pub(super) aerosol_phase: fn(f64) -> f64,
    pub(super) ground_albedo: f64,
}

const CENTRE: DVec3 = DVec3::new(0.0, -6_371_000.0, 0.0);
const TOP: f64 = 80_000.0;

fn height(p: DVec3) -> f64 {
    (p - CENTRE).length() - 6_371_000.0
}

/// Numbers within \[0, 1): Vigna's splitmix64.
pub(super) struct Random(pub(super) u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A direction around `axis` with the density cos/π (on one side) or even over the sphere.
    fn direction(&mut self, axis: DVec3, cosine: bool) -> DVec3 {
        let (a, b) = axis.any_orthonormal_pair();
        let cos = if cosine { self.next().sqrt() } else { 2.0 * self.next() - 1.0 };
        let (s, c) = (std::f64::consts::TAU * self.next()).sin_cos();
        (a * c + b * s) * (1.0 - cos * cos).sqrt() + axis * cos
    }
}

impl Gas {
    /// Extinction by molecules, by aerosol and by ozone at a height \[1/m\].
    fn at(&self, h: f64) -> [f64; 3] {
        let [m, a, o] = self.coefficients;
        let layer = f64::from(u8::from((12_000.0..32_000.0).contains(&h)));
        [m * (-h / self.scales[0]).exp(), a * (-h / self.scales[1]).exp(), o * layer]
    }

    /// Walks on until the optical depth `limit` of scattering and aerosol, or out of the air, or into the ground;
    /// where that is, how high, and the depth of everything on the way.
    fn walk(&self, start: DVec3, direction: DVec3, limit: f64) -> (DVec3, f64, f64) {
        let (mut p, mut scattered, mut depth) = (start, 0.0, 0.0);
        loop {
            let h = height(p);
            if !(-1.0..=TOP).contains(&h) {
                return (p, h, depth);
            }
            let steep = (p - CENTRE).normalize().dot(direction).abs().max(0.02);
            // A tenth of the height over which things change.
            let ds = ((100.0 + 0.08 * h) / steep).min(20_000.0);
            let [m, a, o] = self.at(height(p + direction * (0.5 * ds)));
            let step = (m + a) * ds;
            if scattered + step >= limit {
                let part = (limit - scattered) / step;
                return (p + direction * (ds * part), h, depth + (m + a + o) * ds * part);
            }
            scattered += step;
            depth += step + o * ds;
            p += direction * ds;
        }
    }

    /// What comes through from the sun.
    fn sunlight(&self, p: DVec3, sun: DVec3) -> f64 {
        let (_, h, depth) = self.walk(p, sun, f64::INFINITY);
        if h > TOP { (-depth).exp() } else { 0.0 }
    }

    /// Irradiance of the sky on the horizontal at sea level, for a sun of 1 facing it, and its standard error: with
    /// `paths` paths, up to twelve scatterings each.
    pub(super) fn sky(&self, sun: DVec3, paths: u32, random: &mut Random) -> [f64; 2] {
        let (mut sum, mut square) = (0.0, 0.0);
        for _ in 0..paths {
            let light = std::f64::consts::PI * self.path(sun, random);
            sum += light;
            square += light * light;
        }
        let n = f64::from(paths);
        let mean = sum / n;
        [mean, ((square / n - mean * mean).max(0.0) / n).sqrt()]
    }

    fn path(&self, sun: DVec3, random: &mut Random) -> f64 {
        let mut p = DVec3::ZERO;
        let mut direction = random.direction(DVec3::Y, true);
        let (mut weight, mut light) = (1.0, 0.0);
        for _ in 0..12 {
            let limit = -(1.0 - random.next()).ln();
            let (end, h, depth) = self.walk(p, direction, limit);
            if h > TOP {
                break;
            }
            let up = (end - CENTRE).normalize();
            if h < -1.0 {
                // Ozone is the only thing that takes light without being a place of scattering.
                weight *= self.ground_albedo * (-(depth - self.scattering(p, end))).exp();
                p = CENTRE + up * 6_371_000.5;
                light += weight * up.dot(sun).max(0.0) / std::f64::consts::PI * self.sunlight(p, sun);
                direction = random.direction(up, true);
                continue;
            }
            let [m, a, _] = self.at(height(end));
            weight *= (-(depth - limit)).exp();
            let scattered = a * self.aerosol_albedo;
            weight *= (m + scattered) / (m + a);
            p = end;
            let phase = |cos: f64| {
                let molecules = 3.0 / (16.0 * std::f64::consts::PI) * (1.0 + cos * cos);
                (m * molecules + scattered * (self.aerosol_phase)(cos)) / (m + scattered)
            };
            light += weight * phase(direction.dot(sun)) * self.sunlight(p, sun);
            let next = random.direction(up, false);
            weight *= phase(direction.dot(next)) * 4.0 * std::f64::consts::PI;
            direction = next;
        }
        light
    }

    /// Depth of molecules and aerosol between two points.
    fn scattering(&self, from: DVec3, to: DVec3) -> f64 {
        let steps = 400;
        let whole = to - from;
        let at = |i: i32| self.at(height(from + whole * ((f64::from(i) + 0.5) / f64::from(steps))));
        (0..steps).map(at).map(|[m, a, _]| m + a).sum::<f64>() * whole.length() / f64::from(steps)
    }
}
