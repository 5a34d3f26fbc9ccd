//! Dusk is continuous, and night is dark.

use keikan_tests::lux;

/// Lux on an open horizontal place at 35° N, 139° E on 21 March 2026, `minutes` after 17:00 local time.
fn at(minutes: u32, sky: &str) -> f64 {
    let text = format!(
        r#"
        [site]
        latitude = 35
        longitude = 139
        time = "2026-03-21T{:02}:{:02}:00+09:00"
        [sky]
        {sky}
        [[camera]]
        position = [0, 2, 5]
        target = [0, 0, 0]
        [[sensor]]
        points = [[0, 0, 0]]
        "#,
        17 + minutes / 60,
        minutes % 60
    );
    lux(&text, &[])[0]
}

#[test]
fn illuminance_falls_through_sunset_without_a_step() {
    for sky in ["model = \"clear\"", "model = \"overcast\""] {
        let mut before = at(0, sky);
        assert!(before > 1000.0, "the sun is still up: {before}");
        for minute in 1..=100 {
            let now = at(minute, sky);
            assert!(now <= before, "{sky}, minute {minute}: {before} lx, then {now} lx");
            // Twilight falls by 0.41 decades a degree and the sun by 0.2° a minute: a factor 0.83 a minute.
            // The direct sun's last minutes are steeper; halving within a minute would be a step.
            assert!(now >= 0.5 * before || now < 0.05, "{sky}, minute {minute}: {before} lx, then {now} lx");
            before = now;
        }
        assert!(before < 1.0, "an hour after sunset: {before} lx");
    }
}

#[test]
fn a_lamp_in_a_ceiling_lights_the_floor() {
    // Exactly in the plane of the ceiling, as recessed lamps are drawn.
    for height in [2.7, 0.1, 3.0001, 123.456] {
        let text = format!(
            r#"
            [sky]
            off = true
            [sun]
            off = true
            [[model]]
            polygon = {{ points = [[-5, {height}, -5], [5, {height}, -5], [5, {height}, 5], [-5, {height}, 5]] }}
            [[light]]
            intensity = 100
            position = [0.3, {height}, 0.7]
            [[camera]]
            position = [0, 0.05, 5]
            target = [0, 0, 0]
            [[sensor]]
            grid = {{ origin = [-2, 0, -2], u = [4, 0, 0], v = [0, 0, 4], counts = [9, 9] }}
            "#
        );
        for lux in lux(&text, &[]) {
            assert!(lux > 0.0, "a sensor below a ceiling at {height} m is dark");
        }
    }
}
