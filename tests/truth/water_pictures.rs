//! Light that water scatters towards the eye, with shadows in it, through the whole pipeline and against plain sums; and lamps with an
//! extent beside water.

use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};
use keikan_tests::{lux, render};
use light::{
    Arrival, Distribution, Geometry, Illuminate, Instance, Luminaire, Mesh, Occlude, Place, Ray, Spectrum,
    fresnel,
};
use raytrace::{Quality, World};
use water::flat::{FlatWater, Lit, Rules, Scattered, Source};
use water::{Loss, Paths, Water};

const WATER: &str = "[[water]]\nquality = 'jerlov-7C'\n\
    polygon = { points = [[-200, 0, -200], [-200, 0, 200], [200, 0, 200], [200, 0, -200]] }\n";

/// What is straight below the origin, seen from `height`, by a sun alone that stands 30° high in the east.
fn nadir(height: f64, more: &str, set: &[(&str, &str)]) -> Spectrum {
    let text = format!(
        "[sky]\noff = true\n[sun]\naltitude = 30\nazimuth = 90\nilluminance = 100000\ndiameter = 0\n\
        [[camera]]\nposition = [0, {height}, 0]\ndirection = [0, -1, 0]\nfield_of_view = 0.2\n{more}"
    );
    let film = render(&text, (4, 4), set);
    film.layers[0].pixels.iter().copied().sum::<Spectrum>() * (1.0 / 16.0)
}

#[test]
fn the_sun_in_deep_water_and_a_shadow_in_it() {
    let single = [("water.scattering", "single")];
    // What a white plane at 0 sends back is E cos θ/π.
    let white = "[[material]]\nname = 'white'\ncolour = 1\n[[model]]\nplane = { size = [4, 4] }\nmaterial = 'white'\n";
    let horizontal = nadir(0.5, white, &[]) * std::f32::consts::PI;
    let open = nadir(0.5, WATER, &single);
    let water = Water::named("jerlov-7C").unwrap();
    let n = water.index();
    let sin = f64::to_radians(60.0).sin() / n;
    let cos = (1.0 - sin * sin).sqrt();
    let k = water.loss(Loss::Diffuse);
    // C.1, through the surface: T² E₀ β/(K (1 + cos θ'))/n².
    let through = (1.0 - fresnel(n, 0.5)) * (1.0 - ((n - 1.0) / (n + 1.0)).powi(2)) / (n * n * (1.0 + cos));
    let expected = horizontal * water.volume_scattering(-cos) / k * through as f32;
    for b in 0..8 {
        // A field of 0.2° and sums in f32.
        assert!((open[b] / expected[b] - 1.0).abs() < 1e-4, "{b}: {} {}", open[b], expected[b]);
    }
    // A roof 1 m above the water, to x = h/tan 30° + 0.4: the surface is dark to x = 0.4, the ray below the eye to where its light comes in there. The roof is black, as it is mirrored.
    let edge = 1.0 / f64::to_radians(30.0).tan() + 0.4 - 50.0;
    let roof = format!(
        "[[material]]\nname = 'black'\ncolour = 0\n\
        [[model]]\nplane = {{ size = [100, 100] }}\nmaterial = 'black'\nposition = [{edge}, 1, 0]\n"
    );
    let shaded = nadir(0.5, &format!("{WATER}{roof}"), &single);
    let dark_to = 0.4 * cos / sin;
    for b in 0..8 {
        let left = (-f64::from(k[b]) * dark_to * (1.0 + 1.0 / cos)).exp();
        // The field of 0.2° moves the shadow's end by 1e-3 m either way: second order of 1e-3 K.
        assert!(
            (f64::from(shaded[b] / open[b]) / left - 1.0).abs() < 1e-3,
            "{b}: {} {left}",
            shaded[b] / open[b]
        );
    }
}

/// Boxes above, under and through the water, one of them turned.
fn garden() -> World {
    let cuboid = |low: [f32; 3], high: [f32; 3]| {
        let corner = |i: u32| {
            let pick = |axis: usize| if i >> axis & 1 == 1 { high[axis] } else { low[axis] };
            Vec3::new(pick(0), pick(1), pick(2))
        };
        let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        Mesh {
            positions: (0..8).map(corner).collect(),
            triangles: sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect(),
            ..Mesh::default()
        }
    };
    let meshes = vec![
        cuboid([-0.4, 0.5, -0.6], [0.5, 0.7, 0.9]),
        cuboid([0.9, -0.6, -0.5], [1.3, -0.4, 0.6]),
        cuboid([-1.3, -3.0, -0.2], [-1.1, 1.5, 0.2]),
    ];
    let turn = |i: u32| DAffine3::from_rotation_y(0.3 * f64::from(i));
    let instances = (0..3).map(|mesh| Instance { mesh, world_from_mesh: turn(mesh) }).collect();
    World::build(Arc::new(Geometry { meshes, instances }), Quality::Medium)
}

/// The same without intervals.
struct RaysOnly<'a>(&'a World);

impl Occlude for RaysOnly<'_> {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        self.0.transmittance(segment)
    }
}

/// A sun of E = 1.
struct Sun(Vec3);

impl Illuminate for Sun {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        let irradiance = occlude.transmittance(&place.leave(self.0, f32::INFINITY));
        receive(Arrival::Beam { toward: self.0, irradiance, radius: None });
    }
}

fn sea() -> Arc<[FlatWater]> {
    let positions = [(-9.0, -9.0), (-9.0, 9.0), (9.0, 9.0), (9.0, -9.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
    let mesh =
        Mesh { positions: positions.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    Arc::new([FlatWater::new(Water::named("jerlov-7C").unwrap(), &mesh, &DAffine3::IDENTITY)])
}

/// View rays into the garden's water, 2.5 m long.
fn rays() -> impl Iterator<Item = Ray> {
    (0..60u32).map(|i| {
        let [u, v, w] = [0.618_034, 0.754_878, 0.569_84].map(|step: f32| (i as f32 * step).fract());
        let origin = Vec3::new(5.0 * u - 2.5, -0.001, 2.0 * v - 1.0);
        let direction = Vec3::new(1.2 * w - 0.6, -0.7, 0.8 * u - 0.4).normalize();
        Ray { origin, direction, length: 2.5 }
    })
}

/// ∫ per metre, by midpoints.
fn sum(length: f32, steps: u32, per_metre: impl Fn(f32) -> f64) -> f64 {
    let step = length / steps as f32;
    (0..steps).map(|i| per_metre(step * (i as f32 + 0.5))).sum::<f64>() * f64::from(step)
}

fn segment(world: &World, from: Vec3, to: Vec3) -> f64 {
    f64::from(world.transmittance(&Ray::between(from, to))[2])
}

#[test]
fn shadows_of_a_garden_in_the_suns_light() {
    let (world, waters) = (garden(), sea());
    let water = &waters[0].water;
    let (n, k) = (water.index(), f64::from(water.loss(Loss::Diffuse)[2]));
    for toward in [DVec3::new(0.48, 0.8, 0.36), DVec3::new(-0.9, 0.3, 0.1).normalize()] {
        let rules = Rules { scattered: Scattered::Once, ..Rules::default() };
        let lit =
            Lit::new(Box::new(Sun(toward.as_vec3())), Source::Toward(toward), Arc::clone(&waters), rules);
        // Snell by hand; (1 − α) cos θ of E goes down.
        let below =
            DVec3::new(toward.x / n, (1.0 - (1.0 - toward.y * toward.y) / (n * n)).sqrt(), toward.z / n);
        let facing = (1.0 - fresnel(n, toward.y)) * toward.y / below.y;
        let (mut shaded, mut worst) = (0, [0.0f64; 2]);
        for ray in rays() {
            let scattered = f64::from(water.volume_scattering(below.dot(ray.direction.as_dvec3()))[2]);
            let gained = |r: f32, seen: f64| {
                let depth = -f64::from(ray.at(r).y);
                scattered * facing * (-k * (depth / below.y + f64::from(r))).exp() * seen
            };
            let seen = |r: f32| {
                let point = ray.at(r);
                let foot = point + (below * (-f64::from(point.y) / below.y)).as_vec3();
                let air = world.transmittance(&Ray::new(foot, toward.as_vec3()))[2];
                segment(&world, point, foot) * f64::from(air)
            };
            let open = sum(ray.length, 2000, |r| gained(r, 1.0));
            let truth = sum(ray.length, 2000, |r| gained(r, seen(r)));
            let found =
                [&world as &dyn Occlude, &RaysOnly(&world)].map(|o| f64::from(lit.scattered(&ray, o)[2]));
            shaded += usize::from(truth < 0.99 * open);
            for (worst, found) in worst.iter_mut().zip(found) {
                *worst = worst.max((found - truth).abs() / open);
            }
        }
        println!(
            "shafts: worst error {:.4} exact, {:.4} by probes, of the open ray's light",
            worst[0], worst[1]
        );
        assert!(shaded > 10, "{shaded}: nothing was tested");
        // Four ends within a midpoint's half step, at a brightness of up to K L/(1 − e^(−K L)) ≈ 3 times the mean.
        assert!(worst[0] < 3e-3, "{}", worst[0]);
        // What covers less than 1/32 of a ray may be missed, at that brightness.
        assert!(worst[1] < 0.1, "{}", worst[1]);
    }
}

#[test]
fn shadows_of_a_garden_in_the_light_of_lamps() {
    let (world, waters) = (garden(), sea());
    let water = &waters[0].water;
    let (surface, k) = (waters[0].surface, water.loss(Loss::Diffuse));
    for at in [DVec3::new(0.1, 1.4, 0.2), DVec3::new(0.2, -0.9, -0.4)] {
        let lamp = Luminaire {
            position: at.as_vec3(),
            world_from_luminaire: glam::Mat3::IDENTITY,
            distribution: Distribution::isotropic(1.0),
            spectrum: Spectrum::ONE,
            glints: false,
        };
        let lit = Lit::new(Box::new(lamp), Source::At(at), Arc::clone(&waters), Rules::default());
        let (mut shaded, mut worst) = (0, [0.0f64; 2]);
        for ray in rays() {
            // Every way of light to a point, and whether it is free.
            let per_metre = |r: f32, blocked: bool| -> f64 {
                let point = ray.at(r);
                let legs = surface.legs(at, point.as_dvec3(), Paths::Exact);
                let one = |leg: &water::Leg| {
                    let seen = match leg.at_surface {
                        _ if !blocked => 1.0,
                        None => segment(&world, point, at.as_vec3()),
                        Some(p) => {
                            segment(&world, point, p.as_vec3()) * segment(&world, p.as_vec3(), at.as_vec3())
                        }
                    };
                    let scattered = water.volume_scattering(leg.toward.dot(ray.direction.as_dvec3()))[2];
                    let light = leg.irradiance(Spectrum::ONE, k)[2] * k.attenuate(r)[2];
                    f64::from(light * scattered) * seen
                };
                legs.iter().flatten().map(one).sum()
            };
            let open = sum(ray.length, 4000, |r| per_metre(r, false));
            let truth = sum(ray.length, 4000, |r| per_metre(r, true));
            let found =
                [&world as &dyn Occlude, &RaysOnly(&world)].map(|o| f64::from(lit.scattered(&ray, o)[2]));
            shaded += usize::from(truth < 0.99 * open);
            for (worst, found) in worst.iter_mut().zip(found) {
                *worst = worst.max((found - truth).abs() / open);
            }
        }
        println!("lamp at {at}: worst error {:.4} with intervals, {:.4} by probes", worst[0], worst[1]);
        assert!(shaded > 10, "{shaded}: nothing was tested");
        // A hundredth asked for, and what covers less than 1/32 of a ray may be missed, near the lamp at twice its mean brightness.
        assert!(worst.iter().all(|error| *error < 0.075), "{worst:?}");
    }
}

#[test]
fn lamps_with_an_extent_light_through_water_and_off_it() {
    let lamp = |at: &str, what: &str| {
        let sensors = "[[sensor]]\npoints = [[0.4, -1.5, 0.1]]\n[[sensor]]\nnormal = [-1, 0, 0]\npoints = [[1.4, 0.6, 0.3]]\n\
            [[sensor]]\nnormal = [0, -1, 0]\npoints = [[-0.4, 0.5, 0.2]]\n";
        let text = format!("[sky]\noff = true\n[[light]]\nposition = {at}\n{what}\n{sensors}{WATER}");
        lux(&text, &[])
    };
    for at in ["[0.2, 1.5, 0.0]", "[0.2, -0.8, 0.0]"] {
        let point = lamp(at, "intensity = 1000");
        let ball = lamp(at, "sphere = { radius = 0.03 }\nflux = 12566.3706");
        assert!(point.iter().all(|lux| *lux > 0.0), "{point:?}");
        for (point, ball) in point.iter().zip(&ball) {
            // (radius/distance)², at half a metre.
            assert!((ball / point - 1.0).abs() < 4e-3, "{at}: {point} {ball}");
        }
    }
}
