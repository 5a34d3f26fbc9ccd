//! The scene once more, for the judge: random walks that share no stage with the pipeline.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};
use light::{AreaShape, Film, Illuminate, Ray, rounding};
use reference::{Bands, Convex, Effort, Image, Lamp, Parts, Phase, Sky, Solid, Surface, World};
use scene::{Material, Scene, SolidNode, SolidShape, UvTransform};
use sky::{Description, Dome};

use super::qualities::of_scene as quality;
use super::{heavens, interreflection, lights, materials, solids};
use crate::Error;
use crate::plan::Plan;

/// How many walks, and which.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Walks {
    /// For each sensor point or pixel, ≥ 1.
    pub samples: u32,
    /// Decides every random number.
    pub seed: u64,
}

/// What the judge finds, and its standard error: \[lx\] or \[cd/m²\].
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Judged {
    /// The mean of all walks.
    pub value: f64,
    /// Standard error of that.
    pub error: f64,
}

/// A scene as the judge sees it.
pub struct Judge {
    world: World,
    /// What it does not see as the scene has it, in words; empty = it sees all of it.
    pub omitted: Vec<String>,
    /// How many faces send light on between source and sensor: where the plan has no interreflection, none.
    faces: Option<u32>,
}

impl Judge {
    /// Of the scene, lit as `plan` has it; how stages find that light (rays, maps, patches) means nothing here.
    ///
    /// # Errors
    /// A water that there is not.
    pub fn new(plan: &Plan, scene: &Scene) -> Result<Self, Error> {
        let settings = &plan.settings;
        let mut surfaces: Vec<Surface> = scene.materials.iter().map(surface).collect();
        for lamp in &scene.area_lights {
            let face = lamp.face.and_then(|face| surfaces.get_mut(face as usize));
            face.into_iter().for_each(|face| face.shown_only = true);
        }
        let parts = Parts {
            geometry: Arc::clone(&scene.geometry),
            solids: bodies(scene, &mut surfaces),
            surfaces,
            lamps: lamps(plan, scene),
            sky: sky(plan, scene),
            waters: scene.waters.iter().map(water).collect::<Result<_, Error>>()?,
        };
        let faces = (!interreflection::asked(settings)).then_some(0);
        Ok(Self { world: World::new(parts), omitted: omitted(plan, scene), faces })
    }

    /// Illuminance at every sensor point of the scene, in order: by light that faces reflect only if the plan has it.
    pub fn lux(&self, scene: &Scene, walks: &Walks) -> Vec<Judged> {
        let mut answers = Vec::new();
        for sensor in &scene.sensors {
            for point in &sensor.points {
                // Every point has numbers of its own.
                let seed = walks.seed.wrapping_mul(0x9E37_79B9).wrapping_add(answers.len() as u64);
                let effort = Effort { samples: walks.samples, faces: self.faces, seed };
                let found =
                    reference::irradiance(&self.world, off(*point, sensor.normal), sensor.normal, &effort);
                answers.push(Judged { value: found.luminance, error: found.luminance_error });
            }
        }
        answers
    }

    /// The picture of the plan's camera in the plan's size, and the standard error of each pixel's luminance \[cd/m²\].
    ///
    /// # Errors
    /// A camera that the scene does not have.
    pub fn picture(&self, plan: &Plan, scene: &Scene, walks: &Walks) -> Result<(Film, Vec<f64>), Error> {
        let view = super::view(plan, scene)?;
        // The face that is seen sends it on, too.
        let faces = self.faces.map(|faces| faces + 1);
        let effort = Effort { samples: walks.samples, faces, seed: walks.seed };
        let picture = reference::picture(&self.world, &view, &effort);
        Ok((picture.film, picture.errors))
    }
}

/// A sensor's point, as far off a surface that it may lie on as coordinates are rounded.
fn off(point: DVec3, normal: DVec3) -> DVec3 {
    let rounded = point.as_vec3();
    let error = f64::from(4.0 * rounding::UNIT * rounded.abs().max_element());
    rounded.as_dvec3() + normal * (error * normal.abs().element_sum()).max(1e-9)
}

fn surface(material: &Material) -> Surface {
    Surface {
        base_colour: material.base_colour,
        base_texture: material.base_texture.as_ref().map(image),
        metallic: material.metallic,
        roughness: material.roughness,
        metallic_roughness_texture: material.metallic_roughness_texture.as_ref().map(image),
        emission: material.emission,
        emission_texture: material.emission_texture.as_ref().map(image),
        index: f64::from(materials::index(material.normal_reflectance().element_sum() / 3.0)),
        diffuse_transmission: f64::from(material.diffuse_transmission),
        diffuse_transmission_colour: material.diffuse_transmission_colour,
        body: material.medium(),
        shown_only: false,
    }
}

/// The solids of the scene; what they wear is added to `surfaces`: of transparent bodies a material of its own for each filling.
fn bodies(scene: &Scene, surfaces: &mut Vec<Surface>) -> Vec<Solid> {
    let body = |solid: &scene::Solid| body(scene, &solid.node, solids::filling(&solid.node), surfaces);
    scene.solids.iter().map(body).collect()
}

fn body(scene: &Scene, node: &SolidNode, filling: u32, surfaces: &mut Vec<Surface>) -> Solid {
    let mut all = |members: &[SolidNode]| -> Vec<Solid> {
        members.iter().map(|member| body(scene, member, filling, surfaces)).collect()
    };
    match node {
        SolidNode::Shape { shape, world_from_solid, material } => {
            let [face, inside] = [*material, filling].map(|index| &scene.materials[index as usize]);
            let number = surfaces.len() as u32;
            surfaces.push(Surface { body: solids::medium(face, inside), ..surface(face) });
            Solid::Shape { shape: convex(shape), world_from_solid: *world_from_solid, surface: number }
        }
        SolidNode::Union(members) => Solid::Union(all(members)),
        SolidNode::Intersection(members) => Solid::Intersection(all(members)),
        SolidNode::Difference(whole, cutters) => {
            let cutters = all(cutters);
            Solid::Difference(Box::new(body(scene, whole, filling, surfaces)), cutters)
        }
    }
}

fn convex(shape: &SolidShape) -> Convex {
    match shape {
        SolidShape::Sphere => Convex::Sphere,
        SolidShape::Cylinder => Convex::Frustum { top: 1.0 },
        SolidShape::Cone => Convex::Frustum { top: 0.0 },
        SolidShape::Frustum { top } => Convex::Frustum { top: *top },
        SolidShape::Polyhedron { planes, .. } => Convex::Polyhedron(planes.clone()),
    }
}

fn image((texture, transform): &(Arc<light::Texture>, UvTransform)) -> Image {
    Image { texture: Arc::clone(texture), transform: *transform }
}

fn lamps(plan: &Plan, scene: &Scene) -> Vec<Lamp> {
    let settings = &plan.settings;
    let sun = scene.sun.as_ref().filter(|sun| lights::risen(sun)).map(|sun| Lamp::Sun {
        toward: sun.toward,
        radius: 0.5 * sun.diameter.to_radians(),
        irradiance: lights::beam(scene, settings, sun).into(),
    });
    let points = scene.lights.iter().map(|light| Lamp::Point {
        position: light.position.as_vec3().as_dvec3(),
        world_from_lamp: light.world_from_light,
        distribution: (*light.distribution).clone(),
        spectrum: lights::colour(&light.spectrum).into(),
    });
    let areas = scene.area_lights.iter().map(|lamp| {
        let lamp = lights::area(lamp, settings);
        let (centre, radiance) = (lamp.centre.as_dvec3(), Bands::from(lamp.radiance));
        match lamp.shape {
            AreaShape::Rectangle { half_u, half_v } => {
                Lamp::Rectangle { centre, half_u: half_u.as_dvec3(), half_v: half_v.as_dvec3(), radiance }
            }
            AreaShape::Sphere { radius } => Lamp::Sphere { centre, radius: f64::from(radius), radiance },
        }
    });
    sun.into_iter().chain(points).chain(areas).collect()
}

/// The sky, and below the horizon the ground that lies far below everything.
fn sky(plan: &Plan, scene: &Scene) -> Option<Sky> {
    let settings = &plan.settings;
    let asked = heavens::asked(scene, settings)?;
    let described = heavens::describe(scene, settings, asked);
    let dome = Dome::new(&Description { ground_height: None, ..described });
    Some(Box::new(move |toward: DVec3| dome.radiance(&Ray::new(Vec3::ZERO, toward.as_vec3())).into()))
}

fn water(asked: &scene::Water) -> Result<reference::Water, Error> {
    let water = quality(asked)?;
    let place = |i: &u32| {
        let at = asked.place.transform_point3(asked.surface.positions[*i as usize].as_dvec3());
        DVec2::new(at.x, at.z)
    };
    let scatterers = water.scatterers().iter().filter(|part| !part.scattering.is_zero());
    let scatterers = scatterers.map(|part| {
        let phase = part.phase.clone();
        (Bands::from(part.scattering), Phase::new(move |cos| phase.value(cos)))
    });
    Ok(reference::Water {
        level: asked.level(),
        triangles: asked.surface.triangles.iter().map(|corners| corners.each_ref().map(place)).collect(),
        index: water.index(),
        absorption: water.absorption().into(),
        scatterers: scatterers.collect(),
    })
}

/// What the judge cannot have as the scene has it.
fn omitted(plan: &Plan, scene: &Scene) -> Vec<String> {
    let settings = &plan.settings;
    let mut omitted = Vec::new();
    let mut say = |count: usize, what: &str| {
        if count > 0 {
            omitted.push(format!("{count} {what}"));
        }
    };
    let materials = || scene.materials.iter();
    let bodies = || materials().filter(|material| material.medium().is_some());
    let trees: usize = scene.trees.iter().map(|trees| trees.placed.len()).sum();
    let trees = if settings.choice("trees") == "off" { 0 } else { trees };
    say(trees, "trees: not there");
    let wavy = |water: &&scene::Water| !water.waves.each.is_empty() || water.waves.wind.is_some();
    say(scene.waters.iter().filter(wavy).count(), "waters with waves: level");
    say(
        materials().filter(|material| material.normal_map.is_some()).count(),
        "materials with normal maps: smooth",
    );
    let rough = |material: &&Material| material.roughness > 0.07 || material.metallic > 0.0;
    say(bodies().filter(rough).count(), "transparent materials that are rough or partly metal: smooth glass");
    let mirrors = |material: &&Material| materials::mirrors(material) && material.roughness < 0.07;
    let lost =
        bodies().filter(|material| material.volume.is_some()).count() + materials().filter(mirrors).count();
    let lost = if scene.lights.is_empty() { 0 } else { lost };
    say(lost, "materials of glass or mirrors: light of lamps that are points is not met through or in them");
    if settings.choice("shadows") == "off" {
        omitted.push("shadows = off: there are shadows".to_owned());
    }
    if !interreflection::asked(settings) && settings.choice("sky.ground") == "open" {
        omitted.push("sky.ground = open: the scene's own ground hides that of the sky and, with interreflection = off, is dark".to_owned());
    }
    omitted
}
