//! Luminous areas: rectangles and spheres of one radiance, so that shadows of lamps have penumbrae.

mod rectangle;
mod sphere;

use glam::{DVec3, Vec3};

use crate::sampling::{scramble, share, shift};
use crate::{Arrival, Illuminate, Occlude, Place, Ray, Spectrum};

/// What shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AreaShape {
    /// A parallelogram, centre ± u ± v, that shines to the side of u × v only.
    Rectangle {
        /// From its centre to the middle of one side \[m\].
        half_u: Vec3,
        /// From its centre to the middle of a neighbouring side \[m\].
        half_v: Vec3,
    },
    /// A sphere that shines outwards. Inside it there is no light.
    Sphere {
        /// Radius \[m\].
        radius: f32,
    },
}

/// A Lambertian source with an extent: the same radiance from every point of it in every direction.
///
/// What would arrive with nothing in the way is known in closed form, with what lies below the receiver's
/// horizon left out: the *vector irradiance* V = ∫ L ω dω over the visible part of the source. It arrives as one
/// beam along V, of |V| on a plane that faces it, so that a plane of the place's own normal receives V · n,
/// exactly; planes turned a little away (shading normals) do as well while the whole source stays above them.
/// Of that the share arrives that `samples` rays find, each weighed with what its point of the source would
/// contribute; where all of the source is seen, or nothing, there is no noise. The beam's direction is that of
/// the unhidden source.
///
/// It has no [`Illuminate::radiance`]: a lamp stands within the scene, and whoever wants to see its
/// luminous face puts an emitting surface there. Segments end at the source, so that such a surface does not
/// hide it.
///
/// ```
/// use glam::Vec3;
/// use keikan_light::{AreaLight, AreaShape, Illuminate, Place, Spectrum, Vacuum};
/// let ball = AreaShape::Sphere { radius: 1.0 };
/// let lamp = AreaLight { shape: ball, centre: Vec3::Y * 2.0, radiance: Spectrum::ONE, samples: 16 };
/// let floor = Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 1 };
/// let expected = std::f32::consts::PI / 4.0; // π L (r/d)²
/// assert!((lamp.irradiance(&floor, &Vacuum)[0] - expected).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaLight {
    /// What shines.
    pub shape: AreaShape,
    /// Where its middle is \[m\].
    pub centre: Vec3,
    /// Radiance of its surface \[W m⁻² sr⁻¹ nm⁻¹\].
    pub radiance: Spectrum,
    /// Rays towards it for each place: 1 goes to its middle, i.e. sharp shadows as of a point; the noise within
    /// penumbrae falls with the number and cost grows with it.
    pub samples: u32,
}

impl AreaLight {
    /// Area that shines \[m²\].
    pub fn area(&self) -> f32 {
        match self.shape {
            AreaShape::Rectangle { half_u, half_v } => 4.0 * half_u.cross(half_v).length(),
            AreaShape::Sphere { radius } => 4.0 * std::f32::consts::PI * radius * radius,
        }
    }

    /// ∫ ω dω \[sr\] over the part of the source above the plane through `position` with normal `normal`;
    /// zero where nothing is, or where numbers end.
    fn vector(&self, position: DVec3, normal: DVec3) -> DVec3 {
        let to_centre = self.centre.as_dvec3() - position;
        let vector = match self.shape {
            AreaShape::Rectangle { half_u, half_v } => {
                rectangle::vector(to_centre, [half_u.as_dvec3(), half_v.as_dvec3()], normal)
            }
            AreaShape::Sphere { radius } => sphere::vector(to_centre, f64::from(radius), normal),
        };
        if vector.is_finite() && vector.dot(normal) > 0.0 { vector } else { DVec3::ZERO }
    }

    /// Point `i` of the source as `place` samples it, relative to the place \[m\], and what it counts for.
    fn point(&self, i: u32, place: &Place, shift: [u32; 2]) -> (Vec3, f32) {
        let to_centre = self.centre - place.position;
        let count = self.samples.max(1);
        match self.shape {
            AreaShape::Rectangle { half_u, half_v } => {
                rectangle::sample(to_centre, [half_u, half_v], place.normal, (i, count, shift))
            }
            AreaShape::Sphere { radius } => {
                sphere::sample(to_centre, radius, place.normal, (i, count, shift))
            }
        }
    }

    /// The point of the source that `place` sees along the unit vector `toward`, which meets it, relative to the place.
    fn along(&self, place: &Place, toward: Vec3) -> Vec3 {
        let to_centre = self.centre - place.position;
        match self.shape {
            AreaShape::Rectangle { half_u, half_v } => {
                let across = half_u.cross(half_v);
                toward * (to_centre.dot(across) / toward.dot(across))
            }
            AreaShape::Sphere { radius } => sphere::front(to_centre, radius, toward),
        }
    }

    /// Keeps apart the random choices of lamps that stand at different points.
    fn purpose(&self) -> u32 {
        let bits = self.centre.to_array().map(f32::to_bits);
        scramble(scramble(scramble(bits[0]) ^ bits[1]) ^ bits[2])
    }
}

impl Illuminate for AreaLight {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        let vector = self.vector(place.position.as_dvec3(), place.normal.as_dvec3());
        let Some(toward) = vector.try_normalize() else { return };
        let toward = toward.as_vec3();
        let shift = shift(place.seed, self.purpose());
        let segments = (0..self.samples.max(1)).filter_map(|i| {
            let (way, weight) = self.point(i, place, shift);
            (weight > 0.0).then(|| (place.toward(place.position + way), weight))
        });
        // Where no sample is above the horizon the middle of the part that is stands for it.
        let visible = share(occlude, segments).unwrap_or_else(|| {
            let ray: Ray = place.toward(place.position + self.along(place, toward));
            occlude.transmittance(&ray)
        });
        let irradiance = self.radiance * visible * vector.length() as f32;
        if irradiance.is_finite() && !irradiance.is_zero() {
            // As wide as a disc that sends as much: one of radius ρ has |V| = π sin² ρ.
            let radius = (vector.length() / std::f64::consts::PI).sqrt().min(1.0).asin() as f32;
            receive(Arrival::Beam { toward, irradiance, radius: Some(radius) });
        }
    }
}
