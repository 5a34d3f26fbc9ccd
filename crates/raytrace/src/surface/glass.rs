//! The surface of a transparent body, seen from outside and from inside.

use glam::Vec3;
use light::{Hit, Medium, Shade, Spectrum, Surroundings, fresnel, fresnel_polarised, interface, refract};

use super::finish::{Finish, Surface};
use super::normals::shading_normal;
use super::shading::{MIRROR, Mirrored, follow};

/// The surface of a transparent body: local ray tracing (thesis 2.2), one mirrored and one refracted ray a hit.
///
/// *From outside* (`hit.front`), with F Fresnel's reflectance for the eye's direction and τ the transmission:
///
///   L = L_surface + F S + (1 − F) τ c T
///
/// S is the radiance along the mirror direction, T along Snell's, c the tint; L_surface is what a [`Surface`] sends
/// back by itself: highlights of beams (2.1), emission, and the matt part that is left, 1 − τ.
///
/// *From inside* the way here is known, d = `hit.distance`, and so Lambert and Beer's law (2.3) holds here and only here:
///
///   L = e^(−q d) (F' S + (1 − F') τ c T),   F' = F for 1/n; 1 beyond the critical angle
///
/// The scattering part 1 − τ is dark from inside: it would need the light inside the body.
///
/// *A thin pane* is two parallel interfaces at once, with all reflections between them, straight through:
/// it mirrors R = ½ Σ 2r/(1 + r) and passes (1 − R) τ c (per polarisation r), from either side.
///
/// *Radiance and n².* What is carried is L/n², which no interface changes but by its transmittance; outside bodies
/// (n = 1) it is the radiance itself. So air-glass-air comes out right, and an eye inside a body sees L/n², as one
/// with a window of air before it would.
///
/// **Leaves out.** Roughness spreads the mirror image and highlights, never the refracted one. Bodies in bodies
/// (ink in a bottle) each refract as if they lay in air. Light that a body gathers (caustics) is not in L_surface's beams:
/// shadows of transparent bodies are [`crate::through`]'s.
#[derive(Clone, Debug)]
pub struct Glass {
    surface: Surface,
    medium: Medium,
}

impl Glass {
    /// The surface of a body of `medium`. Of the finish, transmission and index give way to the medium's.
    pub fn new(finish: Finish, medium: Medium) -> Self {
        let metal = finish.metallic.clamp(0.0, 1.0);
        // The medium's share counts the whole surface, the finish's its dielectric part.
        let transmission = if metal < 1.0 { medium.transmission / (1.0 - metal) } else { 0.0 };
        let ior = if medium.index >= 1.0 { medium.index } else { 1.0 / medium.index };
        let finish = Finish { transmission: transmission.clamp(0.0, 1.0), ior, ..finish };
        Self { surface: Surface::new(finish), medium }
    }

    /// The surface seen from outside, or a pane from either side.
    fn outside(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum {
        let (radiance, mirrored) = self.surface.without_mirror(hit, around);
        let (mirror, boundary) = self.mirror_and_boundary(hit, &mirrored);
        let radiance = radiance + follow(hit, mirrored.direction, mirror, MIRROR, around);
        let passing =
            (1.0 - mirrored.metallic) * (1.0 - boundary).max(0.0) * self.surface.finish.transmission;
        let colour = Spectrum::reflectance(self.surface.finish.base_at(hit)).map(|band| band.clamp(0.0, 1.0));
        let (onwards, bend) = if self.medium.thin {
            (Some(-hit.toward_eye), 0.0)
        } else {
            (self.refracted(hit, mirrored.normal), bend(1.0 / self.medium.index))
        };
        match onwards {
            Some(direction) => radiance + follow(hit, direction, colour * passing, bend, around),
            None => radiance,
        }
    }

    /// Share of the mirror ray, and of all that does not get below the dielectric.
    fn mirror_and_boundary(&self, hit: &Hit, mirrored: &Mirrored) -> (Spectrum, f32) {
        let cos = f64::from(mirrored.normal.dot(hit.toward_eye));
        let index = f64::from(self.medium.index);
        // A smooth surface mirrors by Fresnel's law itself, a rough one by its facets' mean.
        let once = if mirrored.whole { fresnel(index, cos) as f32 } else { mirrored.boundary };
        let boundary = if self.medium.thin {
            let twice: f64 = fresnel_polarised(index, cos).iter().map(|r| r / (1.0 + r)).sum();
            // The far face adds what two faces mirror beyond one.
            (once + (twice - fresnel(index, cos)) as f32).min(1.0)
        } else {
            once
        };
        let more = (1.0 - mirrored.metallic) * (boundary - mirrored.boundary);
        (mirrored.share.map(|share| (share + more).max(0.0)), boundary)
    }

    /// Seen from inside.
    fn inside(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum {
        let normal = shading_normal(hit, self.surface.finish.normal_map.as_ref());
        let left = self.medium.absorption.attenuate(hit.distance);
        let index = 1.0 / f64::from(self.medium.index);
        let reflected = fresnel(index, f64::from(normal.dot(hit.toward_eye))) as f32;
        let mirror = interface::reflect(-hit.toward_eye.as_dvec3(), normal.as_dvec3()).as_vec3();
        let mirror = kept(mirror, hit.place.normal);
        let mut radiance = follow(hit, mirror, left * reflected, MIRROR, around);
        if let Some(direction) = refract(-hit.toward_eye.as_dvec3(), normal.as_dvec3(), index) {
            let colour =
                Spectrum::reflectance(self.surface.finish.base_at(hit)).map(|band| band.clamp(0.0, 1.0));
            let share = left * colour * ((1.0 - reflected) * self.medium.transmission);
            let direction = -kept(-direction.as_vec3(), hit.place.normal);
            radiance += follow(hit, direction, share, bend(self.medium.index), around);
        }
        radiance
    }

    /// Where the eye's ray goes on inside, below the true face; none where it is totally reflected (bubbles).
    fn refracted(&self, hit: &Hit, normal: Vec3) -> Option<Vec3> {
        let index = f64::from(self.medium.index);
        let direction = refract(-hit.toward_eye.as_dvec3(), normal.as_dvec3(), index)?.as_vec3();
        Some(-kept(-direction, hit.place.normal))
    }
}

/// How many times the turn of the normal a refracted ray turns, near the normal: Snell's law for small angles.
fn bend(index_from_over_into: f32) -> f32 {
    (1.0 - index_from_over_into).abs()
}

/// `direction`, lifted above the plane of `face` where the normal for shading has sent it below.
fn kept(direction: Vec3, face: Vec3) -> Vec3 {
    let lift = 1e-3 - direction.dot(face);
    if lift > 0.0 { (direction + face * lift).normalize() } else { direction }
}

impl Shade for Glass {
    fn radiance(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum {
        if hit.front || self.medium.thin { self.outside(hit, around) } else { self.inside(hit, around) }
    }
}
