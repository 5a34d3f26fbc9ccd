//! Where light between air and water crosses the surface.

/// The path between a point in air and one under water, through a flat surface (thesis eq. 3.15).
///
/// Nothing here is a difference of nearly equal numbers: every member is right to a few roundings, for the given heights and a
/// distance that differs from the given one by a few roundings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Horizontal way in air \[m\].
    pub run_air: f64,
    /// Horizontal way under water \[m\]; the two sum to the given distance.
    pub run_water: f64,
    /// Length of the way in air \[m\].
    pub air: f64,
    /// Length of the way under water \[m\].
    pub water: f64,
    /// Cosine of the angle from the vertical in air; 0 where light grazes the surface.
    pub cos_air: f64,
    /// Sine of the angle from the vertical in air, n times the one under water.
    pub sin_air: f64,
    /// Cosine of the angle from the vertical under water, at least cos asin(1/n).
    pub cos_water: f64,
    /// Newton steps that it took.
    pub steps: u32,
}

/// More steps than any path takes: `steps_are_few` in the tests counts them.
const MOST_STEPS: u32 = 64;

/// The crossing for a point `height` above the surface and one `depth` below, `distance` apart horizontally (each ≥ 0,
/// finite, \[m\]), and the index n ≥ 1 of water relative to air. The same path serves light in both directions.
///
/// With t the tangent in air, Snell's law puts the distance at
///
///   g(t) = h t + d t / √(n² + (n² − 1) t²)
///
/// g rises and bends downwards, so Newton's steps from below the root never pass it, and never stop short. Two bounds from below:
/// the second term is less than d t/n and less than d/√(n² − 1). From the larger of them it takes 1.5 steps on average, 7 at most, over all
/// combinations of 10⁻⁶ to 10⁶ m.
pub fn crossing(n: f64, height: f64, depth: f64, distance: f64) -> Crossing {
    let [h, d, r] = [height, depth, distance].map(|x| x.abs());
    // (n − 1)(n + 1) keeps its digits where n is near 1.
    let bend = ((n - 1.0) * (n + 1.0)).sqrt();
    if r == 0.0 {
        return at_tangent(n, [h, d, r], 0.0, 0);
    }
    let cone = d / bend;
    if h == 0.0 && (d == 0.0 || r >= cone) {
        return at_tangent(n, [h, d, r], f64::INFINITY, 0);
    }
    let from_cone = if h > 0.0 { (r - cone) / h } else { 0.0 };
    // f64::max passes over the NaN of 0/0 where n = 1 and d = 0.
    let mut t = (r / (h + d / n)).max(from_cone);
    let mut steps = 0;
    while steps < MOST_STEPS {
        steps += 1;
        let root = length(n, bend * t);
        let (missing, slope) = (r - h * t - d * t / root, h + d * n * n / (root * root * root));
        let step = missing / slope;
        if !(step > 0.0 && step.is_finite()) {
            break;
        }
        let next = t + step;
        // Convergence is quadratic: after a step of 1e-8 of t the next one is below rounding.
        let done = step <= 1e-9 * t;
        t = next;
        if done {
            break;
        }
    }
    at_tangent(n, [h, d, r], t, steps)
}

/// The path whose tangent in air is `t`; infinite = along the surface.
fn at_tangent(n: f64, [h, d, r]: [f64; 3], t: f64, steps: u32) -> Crossing {
    let n2_less_1 = (n - 1.0) * (n + 1.0);
    // As shares of the secant: 1/√(1 + t²) and t/√(1 + t²).
    let secant = length(1.0, t);
    let (cos_air, sin_air) = if t.is_infinite() { (0.0, 1.0) } else { (1.0 / secant, t / secant) };
    let cos_water = (n2_less_1 + cos_air * cos_air).sqrt() / n;
    let under = if d == 0.0 { 0.0 } else { d * (sin_air / n) / cos_water };
    let run_water = under.min(r);
    let run_air = if t.is_infinite() { r - run_water } else { (h * t).min(r) };
    Crossing {
        run_air,
        run_water,
        air: length(run_air, h),
        water: length(run_water, d),
        cos_air,
        sin_air,
        cos_water,
        steps,
    }
}

/// √(a² + b²), without `hypot`'s care where squares are far from the ends of what f64 can hold.
fn length(a: f64, b: f64) -> f64 {
    let square = a * a + b * b;
    if square > 1e-280 && square < 1e300 { square.sqrt() } else { a.hypot(b) }
}

/// The thesis' own way: linear interpolation (regula falsi) within the bracket \[r h/(h + d), r\] on eq. 3.15, `steps` times. Gives
/// the horizontal way in air \[m\].
///
/// For comparison only: the thesis says that once or twice is enough, the example `refraction_steps` shows what is left.
pub fn crossing_thesis(n: f64, height: f64, depth: f64, distance: f64, steps: u32) -> f64 {
    let (h, d, r) = (height, depth, distance);
    let sines = |x: f64| x / x.hypot(h) - n * (r - x) / (r - x).hypot(d);
    let (mut low, mut high) = (r * h / (h + d), r);
    let (mut below, mut above) = (sines(low), sines(high));
    let mut x = low;
    for _ in 0..steps {
        x = low - below * (high - low) / (above - below);
        if !x.is_finite() {
            return low;
        }
        let at = sines(x);
        if at < 0.0 {
            (low, below) = (x, at);
        } else {
            (high, above) = (x, at);
        }
    }
    x
}
