//! Sensors that seem to lie inside of things.

use glam::Vec3;
use light::{Nearest, Place, Ray};
use scene::Scene;

use super::table::by_sensor;
use super::{Row, Table, place};

/// Directions that are looked into.
const DIRECTIONS: u32 = 32;

/// A warning for each sensor with dark points around which there is nothing but the backs of faces: they seem to lie inside
/// of a wall. `nearest` knows no water surfaces, whose backs bury nobody.
pub fn buried(scene: &Scene, nearest: &dyn Nearest, table: &Table) -> Vec<String> {
    let of = |(sensor, rows): (&scene::Sensor, &[Row])| {
        let dark = rows.iter().filter(|row| row.total == 0.0).map(|row| row.point);
        let normal = sensor.normal.as_vec3();
        let inside: Vec<usize> = dark
            .filter(|&point| is_inside(nearest, &place(sensor.points[point], normal, point as u32)))
            .collect();
        let first = inside.first()?;
        let at = (sensor.points[*first] + scene.origin).to_array();
        Some(format!(
            "[[sensor]] {:?}: {} of its {} points (the first: number {first} at {at:?}) receive no light and see nothing but the \
             backs of faces: they seem to lie inside a wall or a body",
            sensor.name,
            inside.len(),
            sensor.points.len()
        ))
    };
    by_sensor(scene, &table.rows).filter_map(of).collect()
}

fn is_inside(nearest: &dyn Nearest, place: &Place) -> bool {
    (0..DIRECTIONS).all(|i| {
        // The golden spiral: even over the sphere.
        let y = 1.0 - (2.0 * i as f32 + 1.0) / DIRECTIONS as f32;
        let (sin, cos) = (i as f32 * 2.399_963_2).sin_cos();
        let level = (1.0 - y * y).max(0.0).sqrt();
        let ray = Ray::new(place.position, Vec3::new(level * cos, y, level * sin));
        nearest.nearest(&ray).is_some_and(|hit| !hit.front)
    })
}
