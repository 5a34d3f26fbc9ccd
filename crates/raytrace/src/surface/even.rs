//! What a surface does to light in all directions at once: for those who follow diffuse light from face to face.

use light::{Hit, Spectrum};

use super::albedo::Albedo;
use super::finish::Surface;
use super::shading::{Local, mirrored};

impl Surface {
    /// Share of even light all around that leaves without a mirror ray, over all directions of the eye: its diffuse reflectance and
    /// what rough facets spread, within \[0, 1\]. Of matt surfaces it is the colour at `hit`, whose eye does not count.
    ///
    /// Light from one direction leaves a glossy surface in another share: this is the mean over all of them.
    pub fn even_reflectance(&self, hit: &Hit) -> Spectrum {
        let local = Local::new(self, hit);
        let [boundary, white, rise] =
            [local.boundary, Albedo::white(), Albedo::rise()].map(|albedo| albedo.mean(local.at));
        // Means over the eye's directions of the shares that the shading has.
        let diffuse = local.body * (1.0 - boundary) + local.among_mean() * (1.0 - white);
        let metal = (local.metal * (white - rise) + Spectrum::splat(rise)) * local.metallic;
        let facets = Spectrum::splat((1.0 - local.metallic) * boundary) + metal;
        (diffuse + facets * (1.0 - mirrored(local.roughness))).map(|band| band.clamp(0.0, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::TAU;

    use glam::Vec3;
    use light::{Arrival, Path, Place, Ray, Shade, Surroundings};

    use super::*;
    use crate::surface::Finish;

    /// Even light, and mirrors that show nothing.
    struct Even;

    impl Surroundings for Even {
        fn arrivals(&self, _: &Place, receive: &mut dyn FnMut(Arrival)) {
            receive(Arrival::Field { irradiance: Spectrum::ONE });
        }

        fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
            Spectrum::ZERO
        }
    }

    fn seen_from(toward_eye: Vec3) -> Hit {
        Hit::plain(Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 0 }, toward_eye, 1.0)
    }

    #[test]
    fn it_is_the_mean_of_what_eyes_all_around_see() {
        let finishes = [
            [0.0, 1.0, 1.0],
            [0.0, 1.0, 1.5],
            [0.0, 0.3, 1.5],
            [0.0, 0.1, 1.5],
            [1.0, 0.6, 1.5],
            [0.4, 0.35, 1.8],
        ];
        for [metallic, roughness, ior] in finishes {
            let surface = Surface::new(Finish {
                base_colour: Vec3::splat(0.6),
                metallic,
                roughness,
                ior,
                ..Finish::default()
            });
            // ∫ L cos dω = 2π ∫ L c dc, by midpoints; turning about the normal changes nothing.
            let steps = 4000;
            let sum = (0..steps).fold(0.0, |sum, i| {
                let cos = (i as f32 + 0.5) / steps as f32;
                let eye = Vec3::new((1.0 - cos * cos).sqrt(), cos, 0.0);
                sum + surface.radiance(&seen_from(eye), &Even)[3] * cos * TAU / steps as f32
            });
            let found = surface.even_reflectance(&seen_from(Vec3::Y))[3];
            // The means are exact for tables linear in √cos, midpoints of which 4000 are off by h² f″/24 < 1e-6; sums of 4000 f32.
            assert!((found - sum).abs() < 1e-4, "{metallic} {roughness} {ior}: {found} {sum}");
        }
        let matt = Surface::new(Finish { base_colour: Vec3::splat(0.6), ior: 1.0, ..Finish::default() });
        // Spectra of grey are grey to 1e-3.
        assert!((matt.even_reflectance(&seen_from(Vec3::Y))[3] - 0.6).abs() < 1e-3);
    }
}
