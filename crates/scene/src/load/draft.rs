//! A scene while it is put together, in the coordinates of the file.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DAffine3, DVec3};
use light::{Geometry, Instance, Mesh};

use super::names::{LAYERS, make_unique};
use super::{framing, materials, recentre};
use crate::{
    AreaLight, Camera, Daylight, Light, Material, Scene, Sensor, Site, Sky, Solid, Sun, Trees, Warning, Water,
};

/// Beyond this distance from the middle f32 positions are off by more than a millimetre \[m\]: half an ulp of
/// 16384 is 0.98 mm.
const FAR: f64 = 16_384.0;

/// Everything but the origin.
#[derive(Default)]
pub(crate) struct Draft {
    pub(crate) site: Site,
    pub(crate) geometry: Geometry,
    pub(crate) solids: Vec<Solid>,
    pub(crate) waters: Vec<Water>,
    pub(crate) trees: Vec<Trees>,
    pub(crate) materials: Vec<Material>,
    pub(crate) lights: Vec<Light>,
    pub(crate) area_lights: Vec<AreaLight>,
    pub(crate) sun: Option<Sun>,
    /// False where the file decides about the sun itself, so that a model's does not count.
    pub(crate) sun_is_open: bool,
    pub(crate) sky: Option<Sky>,
    pub(crate) daylight: Daylight,
    pub(crate) cameras: Vec<Camera>,
    pub(crate) sensors: Vec<Sensor>,
    pub(crate) settings: BTreeMap<String, String>,
    pub(crate) warnings: Vec<Warning>,
    pub(crate) grey: Option<u32>,
    pub(crate) lost: usize,
}

impl Draft {
    /// Index of the material of inline geometry that names none.
    pub(crate) fn grey(&mut self) -> u32 {
        if self.grey.is_none() {
            self.grey = Some(self.materials.len() as u32);
            self.materials.push(materials::grey());
        }
        self.grey.unwrap_or_default()
    }

    pub(crate) fn add_mesh(&mut self, mesh: Mesh, world_from_mesh: DAffine3) {
        let index = self.geometry.meshes.len() as u32;
        self.geometry.meshes.push(mesh);
        self.add_instance(index, world_from_mesh);
    }

    /// A placement that f64 cannot hold (scales multiplied through a hierarchy) is left out and counted.
    pub(crate) fn add_instance(&mut self, mesh: u32, world_from_mesh: DAffine3) {
        let volume = world_from_mesh.matrix3.determinant().abs();
        if world_from_mesh.is_finite()
            && volume > 0.0
            && world_from_mesh.translation.abs().max_element() < 1e9
        {
            self.geometry.instances.push(Instance { mesh, world_from_mesh });
        } else {
            self.lost += 1;
        }
    }

    /// A model's own sun: the first one counts, if the file leaves that open.
    pub(crate) fn add_sun(&mut self, sun: Sun, place: &str, name: &str) {
        if self.sun_is_open && self.sun.is_none() {
            self.sun = Some(sun);
            return;
        }
        let place = format!("{place}: light {name:?}");
        let what =
            "a directional light is a sun, and the scene has its own or another one already; it is left out";
        self.warnings.push(Warning { place, what: what.to_owned() });
    }

    /// Recentred and complete: at least one camera.
    pub(crate) fn finish(mut self, name: &str) -> Scene {
        if self.cameras.is_empty() {
            self.cameras.push(framing::frame(&self.geometry, &self.solids));
        }
        self.name_apart(name);
        let others: Vec<DVec3> = self
            .lights
            .iter()
            .map(|light| light.position)
            .chain(self.area_lights.iter().map(|light| light.position))
            .chain(self.sensors.iter().filter_map(|sensor| sensor.points.first().copied()))
            .chain(self.cameras.iter().map(|camera| camera.position))
            .chain(self.trees.iter().filter_map(|trees| trees.placed.first()).map(|tree| tree.position))
            .collect();
        let origin = recentre::origin(&self.geometry, &self.solids, &others);
        self.geometry
            .instances
            .iter_mut()
            .for_each(|instance| instance.world_from_mesh.translation -= origin);
        self.solids.iter_mut().for_each(|solid| {
            solid.node.placements_mut(&mut |placement| placement.translation -= origin);
        });
        self.waters.iter_mut().for_each(|water| water.place.translation -= origin);
        let trees = self.trees.iter_mut().flat_map(|trees| &mut trees.placed);
        trees.for_each(|tree| tree.position -= origin);
        self.lights.iter_mut().for_each(|light| light.position -= origin);
        self.area_lights.iter_mut().for_each(|light| light.position -= origin);
        self.cameras.iter_mut().for_each(|camera| camera.shift(-origin));
        self.sensors.iter_mut().flat_map(|sensor| &mut sensor.points).for_each(|point| *point -= origin);
        self.fill();
        self.warn(name);
        Scene {
            site: self.site,
            origin,
            geometry: Arc::new(self.geometry),
            solids: self.solids,
            waters: self.waters,
            trees: self.trees,
            materials: self.materials,
            lights: self.lights,
            area_lights: self.area_lights,
            sun: self.sun,
            sky: self.sky,
            cameras: self.cameras,
            sensors: self.sensors,
            settings: self.settings,
            warnings: self.warnings,
            daylight: self.daylight,
        }
    }

    /// Makes the names of cameras, lights and sensors differ.
    fn name_apart(&mut self, place: &str) {
        let cameras = self.cameras.iter_mut().map(|camera| &mut camera.name);
        let areas = self.area_lights.iter_mut().map(|light| &mut light.name);
        let lights = self.lights.iter_mut().map(|light| &mut light.name).chain(areas);
        let sensors = self.sensors.iter_mut().map(|sensor| &mut sensor.name);
        self.warnings.extend(make_unique(cameras, &[], ("cameras", place)));
        self.warnings.extend(make_unique(lights, &LAYERS, ("lights", place)));
        self.warnings.extend(make_unique(sensors, &[], ("sensors", place)));
    }

    /// Tells every mesh what its body is filled with.
    fn fill(&mut self) {
        let media: Vec<_> = self.materials.iter().map(|material| material.medium().map(Arc::new)).collect();
        for mesh in &mut self.geometry.meshes {
            mesh.medium = media.get(mesh.material as usize).cloned().flatten();
        }
    }

    /// What the user should know about the whole.
    fn warn(&mut self, name: &str) {
        let mut warn = |what: String| self.warnings.push(Warning { place: name.to_owned(), what });
        if self.lost > 0 {
            warn(format!("{} placements are flat or beyond 10⁹ m; they are left out", self.lost));
        }
        if self.geometry.instances.is_empty() && self.solids.is_empty() && self.trees.is_empty() {
            warn(
                "there is nothing to see: no model has a face, and there is no solid and no tree".to_owned(),
            );
        }
        let boxes = recentre::all_boxes(&self.geometry, &self.solids);
        let reach = boxes
            .iter()
            .flatten()
            .map(|(low, high)| low.abs().max(high.abs()).max_element())
            .fold(0.0, f64::max);
        if reach > FAR {
            // Half an ulp of f32 at that distance.
            let off = 0.5 * f64::from(f32::EPSILON) * reach * 1000.0;
            warn(format!(
                "geometry reaches {:.0} km from the middle; out there positions are good to {off:.0} mm",
                reach / 1000.0
            ));
        }
    }
}
