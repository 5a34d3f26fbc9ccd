//! What faces are made of, and what a point of one does to light.

use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

use glam::{Affine2, DVec3, Vec3};
use light::colour::LUMINANCE;
use light::{Medium, Spectrum, Texture};

use crate::bands::Bands;
use crate::boundary::Boundary;
use crate::dice::Dice;
use crate::facets::{self, LEAST_WIDTH};
use crate::shape::Point;

/// A texture and how the mesh's texture coordinates become its own.
#[derive(Clone, Debug)]
pub struct Image {
    /// The image.
    pub texture: Arc<Texture>,
    /// From the mesh's coordinates to the image's.
    pub transform: Affine2,
}

impl Image {
    fn colour(&self, point: &Point) -> Vec3 {
        self.texture.sample(self.transform.transform_point2(point.uv.as_vec2()), 0.0).0
    }
}

/// What a face is made of: the terms of glTF, as numbers of a file.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Linear sRGB: reflectance below the boundary of a dielectric, or head on of a metal.
    pub base_colour: Vec3,
    /// Factor on it over the surface.
    pub base_texture: Option<Image>,
    /// Share of the area that is metal.
    pub metallic: f32,
    /// Perceptual roughness within \[0, 1\]: √ of the facets' width α.
    pub roughness: f32,
    /// Factors over the surface: green on roughness, blue on metallic.
    pub metallic_roughness_texture: Option<Image>,
    /// Emitted luminance per linear sRGB channel \[cd/m²\], on both sides.
    pub emission: Vec3,
    /// Factor on it over the surface.
    pub emission_texture: Option<Image>,
    /// Index of the dielectric's boundary, ≥ 1; 1 = no gloss.
    pub index: f64,
    /// Share of the light below the boundary that leaves, matt, on the other side.
    pub diffuse_transmission: f64,
    /// Its colour, linear sRGB.
    pub diffuse_transmission_colour: Vec3,
    /// What fills the body behind the face, if light passes it; its boundary is smooth then, whatever the roughness.
    pub body: Option<Medium>,
    /// Its emission is what the eye sees straight of a lamp at the same place: it lights nothing besides.
    pub shown_only: bool,
}

impl Default for Surface {
    /// Matt, white, opaque.
    fn default() -> Self {
        Self {
            base_colour: Vec3::ONE,
            base_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            emission: Vec3::ZERO,
            emission_texture: None,
            index: 1.0,
            diffuse_transmission: 0.0,
            diffuse_transmission_colour: Vec3::ONE,
            body: None,
            shown_only: false,
        }
    }
}

impl Surface {
    /// Matt, of one reflectance in all bands.
    pub fn grey(reflectance: f32) -> Self {
        Self { base_colour: Vec3::splat(reflectance), ..Self::default() }
    }

    /// Emitted radiance \[W m⁻² sr⁻¹ nm⁻¹\].
    pub(crate) fn emitted(&self, point: &Point) -> Bands {
        if self.emission == Vec3::ZERO {
            return Bands::ZERO;
        }
        let texture = self.emission_texture.as_ref().map_or(Vec3::ONE, |image| image.colour(point));
        let rgb = (self.emission * texture).max(Vec3::ZERO);
        let largest = rgb.max_element();
        match largest > 0.0 {
            true => Bands::from(Spectrum::light_of_colour(rgb / largest)) * f64::from(rgb.dot(LUMINANCE)),
            false => Bands::ZERO,
        }
    }

    /// Luminance that it emits at most, whatever its texture says \[cd/m²\].
    pub(crate) fn brightness(&self) -> f64 {
        if self.shown_only {
            return 0.0;
        }
        f64::from(self.emission.max(Vec3::ZERO).dot(LUMINANCE))
    }

    /// Its colour as a reflectance.
    pub(crate) fn colour(&self, point: &Point) -> Bands {
        let texture = self.base_texture.as_ref().map_or(Vec3::ONE, |image| image.colour(point));
        reflectance(self.base_colour * point.colour * texture)
    }
}

fn reflectance(rgb: Vec3) -> Bands {
    Bands::from(Spectrum::reflectance(rgb)).map(|band| band.clamp(0.0, 1.0))
}

/// A direction to look into.
pub(crate) struct Look {
    pub(crate) toward: DVec3,
    /// What of its radiance is added.
    pub(crate) weight: Bands,
    /// Density of the direction \[1/sr\]; none for the one direction of a mirror.
    pub(crate) density: Option<f64>,
}

/// A surface at one point, its textures read, as the side of `normal` sees it.
pub(crate) struct Local<'a> {
    normal: DVec3,
    smooth: DVec3,
    boundary: &'a Boundary,
    /// Factor on the cosine-weighed matt parts, front and through.
    body: Bands,
    through: Bands,
    /// Share of the area that is metal, and its reflectance head on.
    metallic: f64,
    metal: Bands,
    /// Of the light that facets pass among themselves, what leaves.
    among: Bands,
    width: f64,
    /// Share of facets, not of a perfect mirror, in what is mirrored.
    rough: f64,
    pub(crate) glossy: bool,
}

impl<'a> Local<'a> {
    pub(crate) fn new(surface: &Surface, boundary: &'a Boundary, point: &Point) -> Self {
        let texture =
            surface.metallic_roughness_texture.as_ref().map_or(Vec3::ONE, |image| image.colour(point));
        let metallic = f64::from(surface.metallic * texture.z).clamp(0.0, 1.0);
        let roughness = f64::from(surface.roughness * texture.y).clamp(0.0, 1.0);
        let base = surface.colour(point);
        let matt = 1.0 - metallic;
        let passed = surface.diffuse_transmission;
        Self {
            normal: point.normal,
            smooth: point.smooth,
            boundary,
            body: base * (matt * (1.0 - passed)),
            through: match passed > 0.0 {
                true => reflectance(surface.diffuse_transmission_colour) * (matt * passed),
                false => Bands::ZERO,
            },
            metallic,
            metal: base,
            among: boundary.among(base, roughness) * metallic,
            width: (roughness * roughness).max(LEAST_WIDTH),
            rough: (roughness * roughness / LEAST_WIDTH).min(1.0),
            glossy: metallic > 0.0 || surface.index > 1.0,
        }
    }

    /// Of all light, the share of direction `cos` that does not get below the dielectric's boundary.
    fn kept(&self, cos: f64) -> f64 {
        if self.glossy { self.boundary.dielectric(cos, self.width) } else { 0.0 }
    }

    /// F of the mixture, for a facet that light meets under this cosine.
    fn fresnel(&self, cos: f64) -> Bands {
        let glass = (1.0 - self.metallic) * self.boundary.fresnel(cos);
        let rise = (1.0 - cos).powi(5);
        self.metal.map(|metal| self.metallic * (metal + (1.0 - metal) * rise) + glass)
    }

    /// Cosine of a direction at the normal for shading, where it is on the same side of the face as of that.
    fn cosine(&self, toward: DVec3) -> Option<f64> {
        let (face, smooth) = (toward.dot(self.normal), toward.dot(self.smooth));
        (face * smooth > 0.0).then_some(smooth)
    }

    /// f cos \[1/sr\] for light from `toward` that leaves along `out`, and the density with which [`Self::look`] finds it.
    pub(crate) fn evaluate(&self, out: DVec3, toward: DVec3) -> (Bands, f64) {
        let Some(cos) = self.cosine(toward) else { return (Bands::ZERO, 0.0) };
        let cos_out = out.dot(self.smooth).max(1e-6);
        let below = match self.glossy {
            true => {
                let mean = self.boundary.dielectric_mean(self.width);
                (1.0 - self.kept(cos.abs())) * (1.0 - self.kept(cos_out)) / (1.0 - mean).max(1e-12)
            }
            false => 1.0,
        };
        let [front, back, facets] = self.choices(cos_out);
        if cos < 0.0 {
            let cos = -cos;
            return (self.through * (below * FRAC_1_PI * cos), back * cos * FRAC_1_PI);
        }
        let mut f = self.body * (below * FRAC_1_PI);
        let mut density = front * cos * FRAC_1_PI;
        if self.glossy {
            f += self.among * (self.boundary.left_among(cos, cos_out, self.width) * FRAC_1_PI);
            let half = (out + toward).normalize_or(self.smooth);
            let (cos_facet, cos_half) = (half.dot(toward).clamp(0.0, 1.0), half.dot(self.smooth));
            let slopes = facets::density(cos_half, self.width);
            f += self.fresnel(cos_facet) * (self.rough * slopes * facets::masking(cos, cos_out, self.width));
            density += facets * self.rough * facets::seen(cos_half, cos_facet, cos_out, self.width)
                / (4.0 * cos_facet.max(1e-12));
        }
        (f * cos, density)
    }

    /// With which probabilities one looks for matt light in front, from behind, and for mirrored light.
    fn choices(&self, cos_out: f64) -> [f64; 3] {
        let (front, back) = ((self.body + self.among).largest(), self.through.largest());
        let mirrored = match self.glossy {
            true => (1.0 - self.metallic) * self.kept(cos_out) + self.metallic * self.metal.largest(),
            false => 0.0,
        };
        let whole = front + back + mirrored;
        if whole <= 0.0 { [1.0, 0.0, 0.0] } else { [front, back, mirrored].map(|share| share / whole) }
    }

    /// A direction from where light may come that leaves along `out`; none where what was drawn leads nowhere.
    pub(crate) fn look(&self, out: DVec3, dice: &mut Dice) -> Option<Look> {
        let cos_out = out.dot(self.smooth).max(1e-6);
        let [front, back, mirrored] = self.choices(cos_out);
        let choice = dice.roll();
        let toward = if choice < front {
            dice.cosine(self.smooth)
        } else if choice < front + back {
            dice.cosine(-self.smooth)
        } else if dice.roll() < self.rough {
            let half = facets::draw(out, self.smooth, self.width, dice.pair());
            half * (2.0 * half.dot(out)) - out
        } else {
            let toward = self.smooth * (2.0 * self.smooth.dot(out)) - out;
            let weight = self.fresnel(cos_out) * (1.0 / mirrored);
            return (toward.dot(self.normal) > 0.0).then_some(Look { toward, weight, density: None });
        };
        let (f, density) = self.evaluate(out, toward);
        (density > 0.0 && !f.is_zero()).then(|| Look {
            toward,
            weight: f * (1.0 / density),
            density: Some(density),
        })
    }
}
