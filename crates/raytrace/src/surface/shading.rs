//! From what arrives to what leaves: the shading of a [`Surface`].

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;
use light::colour::LUMINANCE;
use light::{Arrival, Hit, Place, Shade, Spectrum, Surroundings};

use super::albedo::{Albedo, Fraction};
use super::finish::Surface;
use super::lobe::{Facets, lobe};
use super::normals::{facing, shading_normal, terminator};

/// Roughness up to which the specular share of extended light is that of the mirror ray alone.
const ALL_MIRROR: f32 = 0.25;
/// Roughness from which no mirror ray is sent.
pub const NO_MIRROR: f32 = 0.4;

/// A surface at one hit, its textures read.
pub(super) struct Local<'a> {
    normal: Vec3,
    out: Vec3,
    face: Vec3,
    /// cos between `normal` and `face`.
    agreement: f32,
    pub(super) roughness: f32,
    facets: Facets,
    pub(super) at: Fraction,
    ior: f32,
    /// Share of the area that is metal.
    pub(super) metallic: f32,
    /// Head-on reflectance of the metal.
    pub(super) metal: Spectrum,
    /// Reflectance below the boundary of the dielectric, share of the area and of transmission included.
    pub(super) body: Spectrum,
    pub(super) boundary: &'a Albedo,
    /// Factor on (1 − E(i)) for a matt scattering of reflectance 1 below the boundary: (1 − E(o))/(1 − Ē).
    below: f32,
    /// Factor on (1 − A(i)) for light passed among the metal's facets, per band: F_ms (1 − A(o))/(1 − Ā).
    among: Spectrum,
}

impl<'a> Local<'a> {
    pub(super) fn new(surface: &'a Surface, hit: &Hit) -> Self {
        let finish = &surface.finish;
        let normal = shading_normal(hit, finish.normal_map.as_ref());
        let (metallic, roughness) = finish.metal_and_roughness_at(hit).into();
        let colour = Spectrum::reflectance(finish.base_at(hit)).map(|band| band.clamp(0.0, 1.0));
        let at = Fraction::of_roughness(roughness);
        let cos_out = normal.dot(hit.toward_eye);
        let boundary = &*surface.boundary;
        let matt = (1.0 - metallic) * (1.0 - finish.transmission);
        Self {
            normal,
            out: hit.toward_eye,
            face: hit.place.normal,
            agreement: normal.dot(hit.place.normal),
            roughness,
            // Half of what the bundle itself spreads turns the half vector as well.
            facets: Facets::new(roughness, hit.turn() + 0.5 * hit.path.spread),
            at,
            ior: finish.ior,
            metallic,
            metal: colour,
            body: colour * (matt * (1.0 - finish.diffuse_transmission)),
            boundary,
            below: shared(boundary.at(cos_out, at), boundary.mean(at)),
            among: if metallic > 0.0 {
                passed_among(colour, Albedo::white().mean(at))
                    * (metallic * shared(Albedo::white().at(cos_out, at), Albedo::white().mean(at)))
            } else {
                Spectrum::ZERO
            },
        }
    }

    /// [`Self::among`] for the mean over the eye's directions, that of (1 − A(o))/(1 − Ā) being 1.
    pub(super) fn among_mean(&self) -> Spectrum {
        passed_among(self.metal, Albedo::white().mean(self.at)) * self.metallic
    }

    /// Share of even light all around that is mirrored to the eye, E(o).
    fn specular_share(&self) -> Spectrum {
        let cos = self.normal.dot(self.out);
        let mut share = Spectrum::splat((1.0 - self.metallic) * self.boundary.at(cos, self.at));
        if self.metallic > 0.0 {
            let (white, rise) = (Albedo::white().at(cos, self.at), Albedo::rise().at(cos, self.at));
            share += (self.metal * (white - rise) + Spectrum::splat(rise)) * self.metallic;
        }
        share
    }

    /// Share of even light all around that is scattered to the eye: ∫ of the matt parts, (1 − Ē) back again.
    fn diffuse_share(&self) -> Spectrum {
        let below = self.below * (1.0 - self.boundary.mean(self.at));
        self.body * below + self.among * (1.0 - Albedo::white().mean(self.at))
    }

    /// f cos for a beam from `toward` \[1/sr\]: what of irradiance facing it leaves towards the eye.
    /// `radius` is that of the source \[rad\].
    fn reflect(&self, toward: Vec3, radius: Option<f32>) -> Spectrum {
        let cos = toward.dot(self.normal);
        let fade = terminator(toward.dot(self.face), cos, self.agreement);
        if fade <= 0.0 {
            return Spectrum::ZERO;
        }
        let mut f = self.body * (FRAC_1_PI * self.below * (1.0 - self.boundary.at(cos, self.at)));
        let lobe = lobe(self.normal, self.out, toward, &self.facets, radius);
        let glass = light::fresnel(f64::from(self.ior), f64::from(lobe.cos_facet)) as f32;
        f += Spectrum::splat((1.0 - self.metallic) * glass * lobe.density);
        if self.metallic > 0.0 {
            f += self.among * (FRAC_1_PI * (1.0 - Albedo::white().at(cos, self.at)));
            let rise = (1.0 - lobe.cos_facet).powi(5);
            f += (self.metal * (1.0 - rise) + Spectrum::splat(rise)) * (self.metallic * lobe.density);
        }
        f * (cos * fade)
    }

    /// The same for a beam that comes through from behind, per reflectance of the body: matt.
    fn pass(&self, toward: Vec3) -> f32 {
        let cos = -toward.dot(self.normal);
        let fade = terminator(-toward.dot(self.face), cos, self.agreement);
        FRAC_1_PI * self.below * (1.0 - self.boundary.at(cos.max(0.0), self.at)) * cos.max(0.0) * fade
    }
}

/// (1 − E)/(1 − Ē); 0 where nothing gets below at all.
fn shared(albedo: f32, mean: f32) -> f32 {
    if mean < 1.0 { ((1.0 - albedo) / (1.0 - mean)).max(0.0) } else { 0.0 }
}

/// Share of light that leaves a metal after more than one facet (Kulla and Conty 2017).
///
///   F_ms = F̄ ² Ā / (1 − F̄ (1 − Ā)),   F̄ = (20 F₀ + 1)/21
fn passed_among(head_on: Spectrum, mean: f32) -> Spectrum {
    head_on.map(|f0| {
        let f = (20.0 * f0 + 1.0) / 21.0;
        f * f * mean / (1.0 - f * (1.0 - mean)).max(f32::MIN_POSITIVE)
    })
}

/// Share of the mirror ray in the specular reflection of extended light, by roughness.
pub(super) fn mirrored(roughness: f32) -> f32 {
    let t = ((NO_MIRROR - roughness) / (NO_MIRROR - ALL_MIRROR)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Mirror direction of the eye at the normal for shading, kept above the true face.
fn mirror_direction(local: &Local) -> Vec3 {
    let mirror = local.normal * (2.0 * local.normal.dot(local.out)) - local.out;
    // A degree above the face, where the normal for shading would send it into the surface.
    let lift = 0.02 - mirror.dot(local.face);
    if lift > 0.0 { (mirror + local.face * lift).normalize() } else { mirror }
}

impl Surface {
    /// Radiance that comes through from light behind: leaves against the sun.
    fn through(&self, local: &Local, place: &Place, around: &dyn Surroundings) -> Spectrum {
        let share =
            self.finish.diffuse_transmission * (1.0 - local.metallic) * (1.0 - self.finish.transmission);
        if share <= 0.0 {
            return Spectrum::ZERO;
        }
        let even = FRAC_1_PI * local.below * (1.0 - local.boundary.mean(local.at));
        let mut light = Spectrum::ZERO;
        around.arrivals(&place.flipped(), &mut |arrival| match arrival {
            Arrival::Beam { toward, irradiance, .. } => light += irradiance * local.pass(toward),
            Arrival::Field { irradiance } => light += irradiance * even,
        });
        let colour =
            Spectrum::reflectance(self.finish.diffuse_transmission_colour.clamp(Vec3::ZERO, Vec3::ONE));
        light * colour.map(|band| band.clamp(0.0, 1.0)) * share
    }

    /// Emitted radiance \[W m⁻² sr⁻¹ nm⁻¹\], the same in every direction.
    pub fn emitted(&self, hit: &Hit) -> Spectrum {
        let rgb = self.finish.emission_at(hit);
        let largest = rgb.max_element();
        if largest > 0.0 && largest.is_finite() {
            Spectrum::light_of_colour(rgb / largest) * rgb.dot(LUMINANCE)
        } else {
            Spectrum::ZERO
        }
    }
}

/// What a surface leaves to a mirror ray.
pub(crate) struct Mirrored {
    /// Where it goes: above the face, unit.
    pub(crate) direction: Vec3,
    /// Share of its radiance that is added.
    pub(crate) share: Spectrum,
    /// Share that the boundary of the dielectric reflects for even light all around, without the metal.
    pub(crate) boundary: f32,
    /// Share of the area that is metal.
    pub(crate) metallic: f32,
    /// Whether the whole of the specular share is the mirror ray's.
    pub(crate) whole: bool,
    /// Normal for shading.
    pub(crate) normal: Vec3,
}

impl Surface {
    /// All that leaves `hit` but for the mirror ray, and what that would add.
    pub(crate) fn without_mirror(&self, hit: &Hit, around: &dyn Surroundings) -> (Spectrum, Mirrored) {
        let local = Local::new(self, hit);
        let place = facing(&hit.place, local.normal);
        let mut field = Spectrum::ZERO;
        let mut radiance = self.emitted(hit);
        let specular = local.specular_share();
        let mirror = mirrored(local.roughness);
        let even = local.diffuse_share() + specular * (1.0 - mirror);
        let mut receive = |arrival| match arrival {
            Arrival::Beam { toward, irradiance, radius } => {
                radiance = irradiance.mul_add(local.reflect(toward, radius), radiance);
            }
            Arrival::Field { irradiance } => field += irradiance,
        };
        if even.is_zero() {
            around.beams(&place, &mut receive);
        } else {
            around.arrivals(&place, &mut receive);
        }
        radiance += field * even * FRAC_1_PI;
        let mirrored = Mirrored {
            direction: mirror_direction(&local),
            share: specular * mirror,
            boundary: local.boundary.at(local.normal.dot(local.out), local.at),
            metallic: local.metallic,
            whole: mirror == 1.0,
            normal: local.normal,
        };
        (radiance + self.through(&local, &place, around), mirrored)
    }
}

impl Shade for Surface {
    fn radiance(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum {
        let (radiance, mirrored) = self.without_mirror(hit, around);
        radiance + follow(hit, mirrored.direction, mirrored.share, MIRROR, around)
    }
}

/// How many times the turn of the normal a mirrored ray turns.
pub(crate) const MIRROR: f32 = 2.0;

/// What a further ray from `hit` adds, `share` of its radiance; `bend` as in [`light::Path::then`].
pub(crate) fn follow(
    hit: &Hit,
    direction: Vec3,
    share: Spectrum,
    bend: f32,
    around: &dyn Surroundings,
) -> Spectrum {
    let largest = share.max();
    if largest <= 0.0 {
        return Spectrum::ZERO;
    }
    let ray = hit.place.leave(direction, f32::INFINITY);
    around.radiance(&ray, hit.path.then(largest.min(1.0), hit, bend)) * share
}

#[cfg(test)]
#[path = "shading_tests.rs"]
mod tests;
