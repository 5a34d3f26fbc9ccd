//! White furnaces through the whole pipeline: what neither absorbs nor emits cannot be told from the sky.

use keikan_tests::{luminances, render};

/// Blocks of reflectance `colour` under a sky of the same luminance everywhere.
fn blocks(colour: f64) -> String {
    format!(
        r#"
        [sky]
        model = "uniform"
        albedo = 1
        illuminance = 31415.926535
        [[material]]
        name = "m"
        colour = {colour}
        [[model]]
        box = {{ size = [2, 2, 2] }}
        material = "m"
        rotation = [20, 30, 0]
        [[camera]]
        position = [3, 4, 5]
        target = [0, 1, 0]
        "#
    )
}

#[test]
fn an_unoccluded_convex_body_shows_its_reflectance() {
    for visibility in ["scanline", "rays"] {
        let film = render(&blocks(1.0), (64, 48), &[("visibility", visibility)]);
        let seen = luminances(&film);
        let sky = seen[0];
        assert!((sky / 10_000.0 - 1.0).abs() < 1e-4, "π L = E: {sky}");
        for (i, luminance) in seen.iter().enumerate() {
            // A convex white body sees nothing but the sky: it must vanish, to the table of open planes that
            // the sky interpolates (0.06 % of its brightest, tested there; for a uniform sky far less), and
            // the rounding of sums of up to 2⁶ shares in f32.
            assert!((luminance / sky - 1.0).abs() < 1e-4, "{visibility}, pixel {i}: {luminance} {sky}");
        }
    }
}

#[test]
fn grey_is_grey() {
    let seen = luminances(&render(&blocks(0.25), (64, 48), &[]));
    let (sky, body) = (seen[0], seen[24 * 64 + 32]);
    assert!((body / sky - 0.25).abs() < 1e-4, "{body} {sky}");
}
