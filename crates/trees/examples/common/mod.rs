//! What the examples share: three species, light, and pictures of a tree as triangles and as planes.

use glam::{DVec3, Vec3};
use keikan_trees::{
    Bake, Form, Growth, Placed, Setting, Shading, Species, Stand, TreeMesh, bake, grow, reference::Reference,
};
use light::sampling::{lattice, shift};
use light::{Arrival, Illuminate, Occlude, Path, Place, Ray, Spectrum, Surroundings, Traverse, View};

/// A sun and a sky that is as bright everywhere above the horizon, over ground of even radiance.
pub struct Daylight {
    pub toward_sun: Vec3,
    /// Irradiance of the sun, facing it.
    pub sun: Spectrum,
    /// Radiance of the sky.
    pub sky: Spectrum,
    /// Radiance of the ground.
    pub ground: Spectrum,
    /// Directions of sky and ground that are asked for.
    pub samples: u32,
}

impl Daylight {
    /// About a clear day's: sun 4/5 of the light on level ground of reflectance 0.2, in units of the whole.
    pub fn clear(toward_sun: Vec3, samples: u32) -> Self {
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
pub struct Around<'a>(pub &'a Daylight, pub &'a dyn Occlude);

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
pub fn growths() -> [(&'static str, Growth); 4] {
    [
        ("poplar", Growth::usual(Form::Columnar, 14.0, 5)),
        ("lime", Growth::usual(Form::Spreading, 10.0, 2)),
        ("zelkova", Growth::usual(Form::Vase, 11.0, 3)),
        ("spruce", Growth::usual(Form::Conifer, 14.0, 4)),
    ]
}

pub fn mesh(growth: &Growth) -> TreeMesh {
    grow(growth).expect("growths of the examples are sound")
}

pub fn species(mesh: &TreeMesh, planes: u32, rows: u32) -> Species {
    bake(mesh, &Bake { planes, rows, ..Bake::default() }).expect("what grows can be baked")
}

/// One tree at the origin.
pub fn alone(species: Species, setting: Setting) -> Stand {
    let height = species.description().height;
    let tree = Placed { species: 0, position: Vec3::ZERO, height, rotation: 0.0 };
    Stand::new(vec![species], vec![tree]).expect("a tree").with(setting, Shading::Leaves)
}

/// Radiance of the mesh where a line meets it, with share of light let through `passed`.
pub fn mesh_radiance(
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

/// A picture of ground, sky and a tree; `tree` answers a viewing ray that ends at the ground with what it adds and lets
/// through.
pub fn picture(
    view: &View,
    light: &Daylight,
    occlude: &dyn Occlude,
    aa: u32,
    tree: impl Fn(&Ray, Path) -> (Spectrum, f32),
) -> image::RgbImage {
    let around = Around(light, occlude);
    image::RgbImage::from_fn(view.width, view.height, |column, row| {
        let mut sum = Vec3::ZERO;
        for i in 0..aa * aa {
            let at = glam::DVec2::new(
                f64::from(column) + (f64::from(i % aa) + 0.5) / f64::from(aa),
                f64::from(row) + (f64::from(i / aa) + 0.5) / f64::from(aa),
            );
            let mut ray = view.ray(at);
            if ray.direction.y < 0.0 {
                ray.length = -ray.origin.y / ray.direction.y;
            }
            let behind = if ray.length.is_finite() {
                let seed = column.wrapping_mul(7919) ^ row;
                let place = Place { position: ray.at(ray.length), error: 1e-5, normal: Vec3::Y, seed };
                let mut irradiance = light.sky * std::f32::consts::PI;
                around.beams(&place, &mut |arrival| irradiance += arrival.on_plane(Vec3::Y));
                Spectrum::reflectance(Vec3::new(0.16, 0.17, 0.1)) * irradiance * std::f32::consts::FRAC_1_PI
            } else {
                Spectrum::reflectance(Vec3::new(0.55, 0.7, 1.0)) * light.sky * 3.0
            };
            let spread = (view.pixel_width(1.0) / f64::from(aa)) as f32;
            let (added, left) = tree(&ray, Path { spread, ..Path::EYE });
            let colour = (added + behind * left) * light::colour::D65;
            sum += light::colour::srgb_from_xyz(colour.xyz());
        }
        // White: a perfect white surface on level ground would be 1/π.
        let linear = sum / (aa * aa) as f32 * std::f32::consts::PI * 1.7;
        image::Rgb(
            linear.to_array().map(|c| (light::colour::encode_srgb(c.clamp(0.0, 1.0)) * 255.0 + 0.5) as u8),
        )
    })
}

/// What a mesh adds to a viewing ray and lets through.
pub fn through_mesh(mesh: &Reference, light: &Daylight, passed: f32, ray: &Ray) -> (Spectrum, f32) {
    let line = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let seed = ray.direction.x.to_bits() ^ ray.direction.y.to_bits().rotate_left(13);
    match mesh_radiance(mesh, light, line, passed, seed) {
        Some(radiance) => (radiance, 0.0),
        None => (Spectrum::ZERO, 1.0),
    }
}

/// The same for planes.
pub fn through_planes(stand: &Stand, light: &Daylight, ray: &Ray, path: Path) -> (Spectrum, f32) {
    let way = stand.way(ray, path, &Around(light, stand));
    (way.added, way.transmittance[0])
}
