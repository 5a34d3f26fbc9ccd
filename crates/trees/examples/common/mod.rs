//! What the examples share: three species, light, and pictures of a tree as triangles and as planes.

use glam::{DVec3, Vec3};
use keikan_trees::{
    Bake, Form, Growth, Placed, Setting, Shading, Species, Stand, TreeMesh, bake, grow, reference::Reference,
};
use light::sampling::{lattice, shift};
use light::{Arrival, Illuminate, Occlude, Path, Place, Ray, Spectrum, Surroundings};

/// A sun and a sky that is as bright everywhere above the horizon, over ground of even radiance.
pub(crate) struct Daylight {
    pub(crate) toward_sun: Vec3,
    /// Irradiance of the sun, facing it.
    pub(crate) sun: Spectrum,
    /// Radiance of the sky.
    pub(crate) sky: Spectrum,
    /// Radiance of the ground.
    pub(crate) ground: Spectrum,
    /// Directions of sky and ground that are asked for.
    pub(crate) samples: u32,
}

impl Daylight {
    /// About a clear day's: sun 4/5 of the light on level ground of reflectance 0.2, in units of the whole.
    pub(crate) fn clear(toward_sun: Vec3, samples: u32) -> Self {
        Self {
            toward_sun,
            sun: Spectrum::splat(0.8 / toward_sun.y),
            sky: Spectrum::splat(0.2 / std::f32::consts::PI),
            ground: Spectrum::splat(0.2 / std::f32::consts::PI),
            samples,
        }
    }

    fn from(&self, direction: Vec3) -> Spectrum {
        if direction.y > 0.0 { self.sky } else { self.ground }
    }
}

impl Illuminate for Daylight {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        if self.toward_sun.dot(place.normal) > 0.0 {
            let irradiance = self.sun * occlude.transmittance(&place.leave(self.toward_sun, f32::INFINITY));
            receive(Arrival::Beam { toward: self.toward_sun, irradiance, radius: None });
        }
        let (x, y) = place.normal.any_orthonormal_pair();
        let mut sum = Spectrum::ZERO;
        for i in 0..self.samples {
            let [u, v] = lattice(i, self.samples, shift(place.seed, 1));
            let (sin, cos) = (std::f32::consts::TAU * v).sin_cos();
            let direction = (x * cos + y * sin) * u.sqrt() + place.normal * (1.0 - u).sqrt();
            sum += self.from(direction) * occlude.transmittance(&place.leave(direction, f32::INFINITY));
        }
        receive(Arrival::Field { irradiance: sum * (std::f32::consts::PI / self.samples.max(1) as f32) });
    }
}

/// A light and what is in its way.
pub(crate) struct Around<'a>(pub(crate) &'a Daylight, pub(crate) &'a dyn Occlude);

impl Surroundings for Around<'_> {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        self.0.arrivals(place, self.1, receive);
    }

    fn beams(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        let beams = Daylight { samples: 0, ..*self.0 };
        beams.arrivals(place, self.1, &mut |arrival| {
            if matches!(arrival, Arrival::Beam { .. }) {
                receive(arrival);
            }
        });
    }

    fn radiance(&self, ray: &Ray, _: Path) -> Spectrum {
        self.0.from(ray.direction)
    }
}

/// The species of the figures: a dense pencil, a dense ellipsoid, a sparse inverted cone, and a conifer.
pub(crate) fn growths() -> [(&'static str, Growth); 4] {
    [
        ("poplar", Growth::usual(Form::Columnar, 14.0, 5)),
        ("lime", Growth::usual(Form::Spreading, 10.0, 2)),
        ("zelkova", Growth::usual(Form::Vase, 11.0, 3)),
        ("spruce", Growth::usual(Form::Conifer, 14.0, 4)),
    ]
}

pub(crate) fn mesh(growth: &Growth) -> TreeMesh {
    grow(growth).expect("growths of the examples are sound")
}

pub(crate) fn species(mesh: &TreeMesh, planes: u32, rows: u32) -> Species {
    bake(mesh, &Bake { planes, rows, ..Bake::default() }).expect("what grows can be baked")
}

/// One tree at the origin.
pub(crate) fn alone(species: Species, setting: Setting) -> Stand {
    let height = species.description().height;
    let tree = Placed { species: 0, position: Vec3::ZERO, height, rotation: 0.0 };
    Stand::new(vec![species], vec![tree]).expect("a tree").with(setting, Shading::Leaves)
}

/// Radiance of the mesh where a line meets it, with share of light let through `passed`.
pub(crate) fn mesh_radiance(
    mesh: &Reference,
    light: &Daylight,
    (origin, direction): (DVec3, DVec3),
    passed: f32,
    seed: u32,
) -> Option<Spectrum> {
    let met = mesh.first(origin, direction, 0.0)?;
    let position = (origin + direction * met.distance).as_vec3();
    let error = position.abs().max_element() * 8.0 * f32::EPSILON;
    let place = Place { position, error, normal: met.normal.as_vec3(), seed };
    let reflectance = Spectrum::reflectance(met.colour);
    let mut sum = reflectance * light.irradiance(&place, mesh);
    if met.leaf {
        sum += reflectance * passed * light.irradiance(&place.flipped(), mesh);
    }
    Some(sum * std::f32::consts::FRAC_1_PI)
}
