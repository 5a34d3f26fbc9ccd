//! What a body is filled with is said by what it was cut from; the cutter's material is only on the faces of the cut.

use keikan_tests::render;
use light::Spectrum;

/// A ball in front of a striped wall, a bite of the material `bite` taken out of it towards the eye.
fn bitten(ball: &str, bite: &str) -> Vec<Spectrum> {
    let stripes: String = (-3..=3)
        .map(|i| {
            let x = 0.4 * f64::from(i);
            format!(
                "[[model]]\nbox = {{ size = [0.2, 3, 0.1] }}\nposition = [{x}, 0, -2]\nmaterial = 'stripe'\n"
            )
        })
        .collect();
    let text = format!(
        r#"
        [sky]
        model = "uniform"
        [[material]]
        name = "stripe"
        colour = [0.8, 0.2, 0.1]
        [[material]]
        name = "ball"
        colour = 0.9
        roughness = 0
        {ball}
        [[material]]
        name = "bite"
        colour = 0.9
        roughness = 0
        {bite}
        [[solid]]
        name = "whole"
        sphere = {{ radius = 1 }}
        position = [0, 1.2, 0]
        material = "ball"
        [[solid]]
        name = "cutter"
        sphere = {{ radius = 0.8 }}
        position = [0.2, 1.4, 1.1]
        material = "bite"
        [[solid]]
        difference = ["whole", "cutter"]
        [[light]]
        position = [2, 4, 3]
        intensity = 500
        [[camera]]
        position = [0, 1.5, 5]
        target = [0, 1.2, 0]
        field_of_view = 30
        {stripes}
        "#
    );
    render(&text, (48, 36), &[]).layers.remove(0).pixels
}

#[test]
fn a_cut_face_is_looked_through_into_what_is_behind_it() {
    let glass = "transmission = 1\nior = 1.5\nattenuation_colour = [0.6, 0.9, 0.7]\nattenuation_distance = 1";
    let same = bitten(glass, glass);
    let denser =
        "transmission = 1\nior = 2\nattenuation_colour = [0.1, 0.1, 0.9]\nattenuation_distance = 0.1";
    assert_eq!(bitten(glass, denser), same, "nothing of the cutter's inside is left");
    let paint = "ior = 1.5";
    assert_ne!(bitten(glass, paint), same, "its surface is");
}

#[test]
fn a_cut_face_of_an_opaque_body_is_opaque() {
    assert_eq!(bitten("ior = 1.5", "transmission = 1\nior = 1.5"), bitten("ior = 1.5", "ior = 1.5"));
}
