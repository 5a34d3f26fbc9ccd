//! Integrals to a stated error: adaptive Gauss–Kronrod.

/// When an integral is good enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Error that is always good enough, in the unit of the integral.
    pub absolute: f64,
    /// Error that is good enough as a share of the largest component.
    pub relative: f64,
    /// The integrand is asked no more often than this, rounded up to whole intervals of 15.
    pub evaluations: usize,
}

/// An integral with what is known of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integral<const N: usize> {
    /// One value per component.
    pub value: [f64; N],
    /// Estimated error of the worst component; beyond the tolerance where `evaluations` ran out.
    pub error: f64,
    /// How often the integrand was asked.
    pub evaluations: usize,
}

/// Nodes of Kronrod's 15 points within \[0, 1\]; every second one is a node of Gauss' 7 (Piessens et al., QUADPACK 1983).
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
/// Kronrod's weights of [`NODES`].
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_82,
];
/// Gauss' weights of the nodes 1, 3, 5 and 7.
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_7, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

/// Kronrod's 15 points on \[0, 1\] with weights of sum 1, for smooth integrands that are asked once: exact to degree 22.
pub(crate) fn points() -> [(f64, f64); 15] {
    std::array::from_fn(|i| {
        let node = NODES[i.min(14 - i)];
        (0.5 + if i < 7 { -0.5 * node } else { 0.5 * node }, 0.5 * KRONROD[i.min(14 - i)])
    })
}

struct Piece<const N: usize> {
    from: f64,
    to: f64,
    value: [f64; N],
    error: [f64; N],
}

/// ∫ f over the pieces between `breaks` (rising; kinks of f belong here), halving the worst until `tolerance` is met.
///
/// The error of each piece is QUADPACK's: s · min(1, (200 |K − G| / s)^1.5) with s = ∫ |f − mean|.
pub(crate) fn integrate<const N: usize>(
    breaks: &[f64],
    tolerance: Tolerance,
    f: impl Fn(f64) -> [f64; N],
) -> Integral<N> {
    let mut pieces: Vec<Piece<N>> =
        breaks.windows(2).filter(|w| w[0] < w[1]).map(|w| piece(w[0], w[1], &f)).collect();
    let mut evaluations = 15 * pieces.len();
    loop {
        let sum = |part: fn(&Piece<N>) -> &[f64; N]| {
            pieces.iter().fold([0.0; N], |sum, piece| std::array::from_fn(|i| sum[i] + part(piece)[i]))
        };
        let (value, errors) = (sum(|piece| &piece.value), sum(|piece| &piece.error));
        let error = largest(&errors);
        let enough = tolerance.absolute.max(tolerance.relative * largest(&value));
        let worst = (0..pieces.len())
            .max_by(|&a, &b| largest(&pieces[a].error).total_cmp(&largest(&pieces[b].error)));
        // A piece without a double inside cannot be halved.
        let halves = worst.map(|i| (i, pieces[i].from, 0.5 * (pieces[i].from + pieces[i].to), pieces[i].to));
        match halves {
            Some((i, from, middle, to))
                if error > enough && evaluations < tolerance.evaluations && from < middle && middle < to =>
            {
                pieces[i] = piece(from, middle, &f);
                pieces.push(piece(middle, to, &f));
                evaluations += 30;
            }
            _ => return Integral { value, error, evaluations },
        }
    }
}

fn largest<const N: usize>(values: &[f64; N]) -> f64 {
    values.iter().fold(0.0, |largest, value| f64::max(largest, value.abs()))
}

fn piece<const N: usize>(from: f64, to: f64, f: impl Fn(f64) -> [f64; N]) -> Piece<N> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let at: [[f64; N]; 15] = std::array::from_fn(|i| match i {
        0..7 => f(middle - half * NODES[i]),
        7 => f(middle),
        _ => f(middle + half * NODES[14 - i]),
    });
    let (mut value, mut error) = ([0.0; N], [0.0; N]);
    for component in 0..N {
        let weighed = |g: &dyn Fn(usize) -> f64| (0..15).map(|i| KRONROD[i.min(14 - i)] * g(i)).sum::<f64>();
        let kronrod = weighed(&|i| at[i][component]);
        let gauss: f64 = (0..7).map(|i| GAUSS[i.min(6 - i)] * at[2 * i + 1][component]).sum();
        let spread = weighed(&|i| (at[i][component] - 0.5 * kronrod).abs());
        let difference = (kronrod - gauss).abs();
        let scaled =
            if spread > 0.0 { spread * (200.0 * difference / spread).powf(1.5).min(1.0) } else { 0.0 };
        value[component] = half * kronrod;
        error[component] = half * scaled;
    }
    Piece { from, to, value, error }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FINE: Tolerance = Tolerance { absolute: 0.0, relative: 1e-12, evaluations: 10_000 };

    #[test]
    fn known_integrals_come_out_and_errors_are_true() {
        let exact = [1.0f64.exp() - 1.0, 2.0 / 3.0, 0.25f64.atan() + 0.75f64.atan()];
        let found =
            integrate(&[0.0, 1.0], FINE, |x| [x.exp(), x.sqrt(), 1.0 / (1.0 + (x - 0.25) * (x - 0.25))]);
        for (value, exact) in found.value.iter().zip(exact) {
            // The tolerance asked for, of the largest component, and rounding of as many terms.
            assert!((value - exact).abs() < 4e-12, "{value} {exact}");
        }
        assert!(found.error < 1e-12 * 2.0 && found.evaluations < 2000, "{found:?}");
    }

    #[test]
    fn it_stops_when_told_to() {
        let rough = Tolerance { absolute: 0.0, relative: 0.0, evaluations: 60 };
        let found = integrate(&[0.0, 1.0], rough, |x| [(1.0 / x).sin()]);
        assert_eq!(found.evaluations, 75);
        assert!(found.error > 1e-3, "and says so: {}", found.error);
        assert_eq!(integrate(&[1.0], FINE, |_| [1.0]).value, [0.0]);
    }
}
