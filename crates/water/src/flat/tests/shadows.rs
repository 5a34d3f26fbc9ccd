//! Shadows in the water, along view rays.

use light::{PointSource, Stretch};

use super::*;
use crate::{Loss, SunBelow};

/// A board that tells intervals: only those of parallel light.
struct Told(Board);

impl Occlude for Told {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        self.0.transmittance(segment)
    }

    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        let (toward, end) = match *source {
            PointSource::At(_) => return false,
            PointSource::Toward(toward) => (toward, f64::INFINITY),
            PointSource::Below { toward, level } => (toward, level),
        };
        let board = &self.0;
        // Where the way from a + s (b − a) meets the board's plane, linear in s.
        let meets = |p: DVec3| p + toward * ((f64::from(board.y) - p.y) / toward.y);
        let [p, q] = [meets(a), meets(b)];
        let bounds = [(p.x, q.x, board.low[0], board.high[0]), (p.z, q.z, board.low[1], board.high[1])];
        let (mut from, mut to) = (0.0f64, 1.0f64);
        let mut clip = |at_p: f64, at_q: f64| match (at_p >= 0.0, at_q >= 0.0) {
            (true, true) => {}
            (false, false) => to = -1.0,
            (true, false) => to = to.min(at_p / (at_p - at_q)),
            (false, true) => from = from.max(at_p / (at_p - at_q)),
        };
        for (p, q, low, high) in bounds {
            clip(p - f64::from(low), q - f64::from(low));
            clip(f64::from(high) - p, f64::from(high) - q);
        }
        // Only what the board is above of, and light that begins above the board.
        clip(f64::from(board.y) - a.y, f64::from(board.y) - b.y);
        if from < to && end > f64::from(board.y) {
            out.push(Stretch { from, to, dark: true });
        }
        true
    }
}

/// β E e^(−K …) by midpoints, with two rays each: the slow reference.
fn by_midpoints(water: &FlatWater, toward: DVec3, ray: &Ray, occlude: &dyn Occlude, steps: u32) -> f64 {
    let sun = SunBelow::new(&water.surface, toward, Spectrum::ONE).unwrap();
    let k = water.water.loss(Loss::Diffuse);
    let mut sum = 0.0;
    for i in 0..steps {
        let r = f64::from(ray.length) * (f64::from(i) + 0.5) / f64::from(steps);
        let point = ray.origin.as_dvec3() + ray.direction.as_dvec3() * r;
        let foot = point + sun.toward * (-point.y / sun.toward.y);
        let seen = occlude.transmittance(&Ray::between(point.as_vec3(), foot.as_vec3()))[2]
            * occlude.transmittance(&Ray::new(foot.as_vec3(), toward.as_vec3()))[2];
        let on = water.covers(DVec2::new(foot.x, foot.z));
        let lit = f64::from(seen) * f64::from(u8::from(on));
        sum += lit * f64::from(sun.facing(-point.y, k)[2]) * f64::from(k.attenuate(r as f32)[2]);
    }
    let scattered = water.water.volume_scattering(sun.toward.dot(ray.direction.as_dvec3()))[2];
    sum * f64::from(scattered) * f64::from(ray.length) / f64::from(steps)
}

#[test]
fn shadows_of_what_is_above_and_under_water_cut_the_suns_light() {
    let waters: Arc<[FlatWater]> = Arc::new([square(Water::named("jerlov-7C").unwrap(), 3.0, 0.0)]);
    let toward = DVec3::new(0.48, 0.8, 0.36);
    let lit = Lit::new(
        Box::new(Sun(toward.as_vec3())),
        Source::Toward(toward),
        Arc::clone(&waters),
        Rules { scattered: Scattered::Once, ..Rules::default() },
    );
    let direction = Vec3::new(0.6, -0.7, -0.2).normalize();
    for y in [1.5, 0.3, -0.2, -0.9] {
        let board = Board { y, low: [-0.2, -1.0], high: [0.7, 0.8] };
        let mut shaded = 0;
        for i in 0..12 {
            let origin = Vec3::new(-2.4 + 0.4 * i as f32, -0.001, 0.1);
            let ray = Ray { origin, direction, length: 2.5 };
            let truth = by_midpoints(&waters[0], toward, &ray, &board, 20_000);
            let open = by_midpoints(&waters[0], toward, &ray, &light::Vacuum, 20_000);
            let [told, probed] =
                [&Told(board) as &dyn Occlude, &board].map(|o| f64::from(lit.scattered(&ray, o)[2]));
            // Ends within a midpoint's step, 1e-4 of a ray, twice; f32 sums.
            assert!((told - truth).abs() < 5e-4 * open, "{y} {i}: {told} {truth} {open}");
            // A stretch below 1/32 of a ray may be missed, at a brightness of at most three times the mean.
            assert!((probed - truth).abs() < 0.1 * open, "{y} {i}: {probed} {truth} {open}");
            shaded += usize::from(truth < 0.99 * open);
        }
        assert!(shaded >= 3, "{y}: nothing was tested");
    }
}

#[test]
fn a_shadow_falls_into_the_water_along_the_refracted_sun() {
    // A roof over half of the world: the boundary on the surface is carried down by tan θ'.
    let waters = sea(grey(1.0, 0.5, Phase::petzold()));
    let toward = DVec3::new(0.6, 0.8, 0.0);
    let lit = Lit::new(Box::new(Sun(toward.as_vec3())), Source::Toward(toward), waters, Rules::default());
    let roof = Board { y: 2.0, low: [-1e5, -1e5], high: [1.5, 1e5] };
    // Shadow on the surface up to x = 1.5 − 2 · 0.75 = 0; at 1 m depth up to −tan θ'.
    let tan = (0.6 / N) / (1.0 - (0.6 / N) * (0.6 / N)).sqrt();
    let at = |x: f64| {
        let position = Vec3::new(x as f32, -1.0, 0.0);
        lit.irradiance(&Place { position, error: 0.0, normal: Vec3::Y, seed: 0 }, &roof)[2]
    };
    assert!(at(-tan - 1e-4) == 0.0 && at(-tan + 1e-4) > 0.0);
}
