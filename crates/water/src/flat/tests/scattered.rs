//! What view rays gain, through [`Lit`] and [`Fill`] as pictures ask for it.

use light::{Traverse, Vacuum};

use super::*;

/// Problems 1 and 2 of Mobley et al. 1993: sun at 60°, E = 1 facing it, n = 1.34, c = 1 1/m, no bottom. Molecules, albedo, optical depth,
/// nadir radiance upwards of the published models on average (none: not published), by Monte Carlo, by quasi-single
/// scattering as computed elsewhere, all \[1/sr\].
#[rustfmt::skip]
const PROBLEMS: [(bool, f32, f32, f64, f64, f64); 16] = [
    (true, 0.2, 0.0, f64::NAN, 5.6885e-3, 5.4748e-3), (true, 0.2, 1.0, 0.00172, 1.6768e-3, 1.6833e-3),
    (true, 0.2, 5.0, 1.37e-5, 1.2673e-5, 1.5042e-5), (true, 0.2, 10.0, 3.39e-8, 3.4542e-8, 4.1330e-8),
    (true, 0.9, 0.0, f64::NAN, 8.2570e-2, 4.0315e-2), (true, 0.9, 1.0, 0.0485, 4.8687e-2, 1.9609e-2),
    (true, 0.9, 5.0, 0.00559, 5.7575e-3, 1.0974e-3), (true, 0.9, 10.0, 0.000437, 4.1753e-4, 2.9873e-5),
    (false, 0.2, 0.0, f64::NAN, 1.5972e-4, 1.5497e-4), (false, 0.2, 1.0, 5.47e-5, 5.4980e-5, 5.4057e-5),
    (false, 0.2, 5.0, 6.24e-7, 7.8051e-7, 8.0044e-7), (false, 0.2, 10.0, 4.02e-9, 4.5158e-9, 4.1345e-9),
    (false, 0.9, 0.0, f64::NAN, 8.0790e-3, 4.8118e-3), (false, 0.9, 1.0, f64::NAN, 7.0708e-3, 4.1307e-3),
    (false, 0.9, 5.0, f64::NAN, 3.2563e-3, 2.2432e-3), (false, 0.9, 10.0, f64::NAN, 1.0976e-3, 1.0458e-3),
];

/// What [`Fill`] adds to a ray straight down from `depth`.
fn nadir(molecules: bool, albedo: f32, depth: f32, scattered: Scattered) -> f64 {
    let phase = if molecules { Phase::morel() } else { Phase::petzold() };
    let waters = sea(grey(1.0, albedo, phase));
    let toward = DVec3::new(0.75f64.sqrt(), 0.5, 0.0);
    let rules = Rules { scattered, ..Rules::default() };
    let lit = Lit::new(Box::new(Sun(toward.as_vec3())), Source::Toward(toward), Arc::clone(&waters), rules);
    let ray = Ray::new(Vec3::new(0.0, -depth, 0.0), Vec3::NEG_Y);
    f64::from(Fill::new(waters).way(&ray, Path::EYE, &Around(&lit, &Vacuum)).added[0])
}

#[test]
fn pictures_of_deep_water_against_monte_carlo_and_mobley() {
    for (name, scattered, just_below, down_to_5) in
        [("single", Scattered::Once, 0.33, 0.41), ("multiple", Scattered::Often, 0.04, 0.26)]
    {
        let (mut squares, mut counts) = ([0.0f64; 2], [0.0; 2]);
        for (molecules, albedo, depth, published, truth, quasi) in PROBLEMS {
            let found = nadir(molecules, albedo, depth, scattered);
            println!(
                "{name}: molecules {molecules}, albedo {albedo}, depth {depth}: {:.3} of Monte Carlo, {:.3} of the models",
                found / truth,
                found / published
            );
            if scattered == Scattered::Once {
                // Five digits of it; Petzold's printed table is 0.994 of one.
                let slack = if molecules { 2e-4 } else { 8e-3 };
                assert!((found / quasi - 1.0).abs() < slack, "{found} {quasi}");
            }
            if depth <= 5.0 {
                let i = usize::from(depth > 0.0);
                squares[i] += (found / truth - 1.0).powi(2);
                counts[i] += 1.0;
            }
        }
        let rms: Vec<f64> = squares.iter().zip(counts).map(|(s, n): (&f64, f64)| (s / n).sqrt()).collect();
        println!("{name}: rms {:.3} just below the surface, {:.3} at optical depths 1 and 5", rms[0], rms[1]);
        // As measured, in figures that the documentation repeats.
        assert!(rms[0] < just_below && rms[1] < down_to_5, "{rms:?}");
    }
}

#[test]
fn the_choice_of_what_is_scattered_is_kept_to() {
    for albedo in [0.2, 0.9] {
        let [off, once, often] =
            [Scattered::Off, Scattered::Once, Scattered::Often].map(|s| nadir(false, albedo, 0.0, s));
        assert!(off == 0.0 && once > 0.0 && often > once);
    }
}

#[test]
fn lamps_scatter_as_much_by_steps_as_by_quadrature() {
    let waters = sea(Water::named("jerlov-3C").unwrap());
    let board = Board { y: -0.8, low: [-0.3; 2], high: [0.6; 2] };
    for at in [DVec3::new(0.4, -0.5, 0.3), DVec3::new(0.4, 1.0, 0.3)] {
        let lit = |along| {
            Lit::new(
                Box::new(luminaire(at)),
                Source::At(at),
                Arc::clone(&waters),
                Rules { along, ..Rules::default() },
            )
        };
        let ray =
            Ray { origin: Vec3::new(-0.6, -0.01, 0.0), direction: Vec3::new(0.6, -0.8, 0.0), length: 4.0 };
        for occlude in [&Vacuum as &dyn Occlude, &board] {
            let [steps, fine] = [Along::Steps(0.002), Rules::default().along]
                .map(|along| lit(along).scattered(&ray, occlude)[2]);
            // A hundredth asked of each way, and steps of 2 mm into and out of the shadow: 2 · 2e-3 · a brightest metre.
            assert!(fine > 0.0 && (steps / fine - 1.0).abs() < 0.02, "{at}: {steps} {fine}");
        }
    }
}
