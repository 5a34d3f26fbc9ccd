//! Objects → the text of a glTF file, one line an object.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use super::palette::Stuff;
use super::shapes::{Mesh, Shape};
use super::site::{Object, Site};

/// The file.
pub(crate) fn text(site: &Site) -> String {
    let objects = || site.groups.iter().flat_map(|(_, objects)| objects);
    let kinds: BTreeSet<(Shape, Stuff)> = objects().map(|object| (object.shape, object.stuff)).collect();
    let shapes: BTreeSet<Shape> = kinds.iter().map(|kind| kind.0).collect();
    let stuffs: BTreeSet<Stuff> = kinds.iter().map(|kind| kind.1).collect();
    let buffer = Buffer::of(&shapes);
    let mesh = |&(shape, stuff): &(Shape, Stuff)| {
        let positions = 2 * rank(&shapes, shape);
        json!({
            "name": format!("{}, {}", shape.name(), stuff.name()),
            "primitives": [{
                "attributes": { "POSITION": positions }, "indices": positions + 1, "material": rank(&stuffs, stuff)
            }]
        })
    };
    let (roots, nodes) = nodes(site, &kinds);
    let arrays: [(&str, Vec<Value>); 7] = [
        ("scenes", vec![json!({ "name": "town", "nodes": (0..roots).collect::<Vec<_>>() })]),
        ("materials", stuffs.iter().map(|&stuff| material(stuff)).collect()),
        ("meshes", kinds.iter().map(mesh).collect()),
        ("accessors", buffer.accessors),
        ("bufferViews", buffer.views),
        ("buffers", vec![json!({ "byteLength": buffer.bytes.len(), "uri": data_uri(&buffer.bytes) })]),
        ("nodes", nodes),
    ];
    let mut text = String::from(
        "{\n\"asset\": {\"version\": \"2.0\", \"generator\": \"keikan, example town\"},\n\
         \"extensionsUsed\": [\"KHR_materials_specular\"],\n\"scene\": 0",
    );
    for (name, values) in arrays {
        let lines: Vec<String> = values.iter().map(Value::to_string).collect();
        text += &format!(",\n\"{name}\": [\n{}\n]", lines.join(",\n"));
    }
    text + "\n}\n"
}

fn rank<T: Ord + Copy>(set: &BTreeSet<T>, wanted: T) -> usize {
    set.iter().position(|&item| item == wanted).unwrap_or(0)
}

/// How many groups there are, and all nodes: groups first, then objects.
fn nodes(site: &Site, kinds: &BTreeSet<(Shape, Stuff)>) -> (usize, Vec<Value>) {
    let mesh: BTreeMap<_, _> = kinds.iter().enumerate().map(|(i, kind)| (*kind, i)).collect();
    let mut first = site.groups.len();
    let mut nodes = Vec::new();
    for (name, objects) in &site.groups {
        let children: Vec<usize> = (first..first + objects.len()).collect();
        nodes.push(json!({ "name": name, "children": children }));
        first += objects.len();
    }
    for object in site.groups.iter().flat_map(|(_, objects)| objects) {
        nodes.push(node(object, mesh[&(object.shape, object.stuff)]));
    }
    (site.groups.len(), nodes)
}

fn node(object: &Object, mesh: usize) -> Value {
    // Millimetres.
    let round = |x: f64| (x * 1e3).round() / 1e3;
    let mut node = json!({
        "mesh": mesh, "translation": object.at.map(round), "scale": object.size.map(round)
    });
    if object.turn != 0.0 {
        let (sin, cos) = (0.5 * object.turn.to_radians()).sin_cos();
        node["rotation"] = json!([0.0, sin, 0.0, cos].map(|x: f64| (x * 1e6).round() / 1e6));
    }
    node
}

fn material(stuff: Stuff) -> Value {
    let [r, g, b] = stuff.colour();
    let roughness = if stuff.polished() { 0.0 } else { 1.0 };
    let mut material = json!({
        "name": stuff.name(),
        "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": roughness
        }
    });
    if !stuff.polished() {
        material["extensions"] = json!({ "KHR_materials_specular": { "specularFactor": 0.0 } });
    }
    material
}

/// Positions and indices of every shape.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    fn of(shapes: &BTreeSet<Shape>) -> Self {
        let mut buffer = Self::default();
        for shape in shapes {
            buffer.add(&shape.mesh());
        }
        buffer
    }

    /// An accessor on the positions, and the next on the indices.
    fn add(&mut self, mesh: &Mesh) {
        let positions: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.map(|x| x as f32)).collect();
        let bounds = |pick: fn(f32, f32) -> f32| {
            [0, 1, 2].map(|k| positions.iter().map(|p| p[k]).reduce(pick).unwrap_or(0.0))
        };
        let (low, high) = (bounds(f32::min), bounds(f32::max));
        let bytes = positions.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        self.view(bytes, 34962);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1, "componentType": 5126, "type": "VEC3", "count": positions.len(),
            "min": low, "max": high
        }));
        let indices = mesh.triangles.as_flattened();
        self.view(indices.iter().flat_map(|i| i.to_le_bytes()).collect(), 34963);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1, "componentType": 5123, "type": "SCALAR", "count": indices.len()
        }));
    }

    fn view(&mut self, bytes: Vec<u8>, target: u32) {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(), "target": target
        }));
        self.bytes.extend(bytes);
    }
}

/// RFC 2397 with base 64 (RFC 4648).
fn data_uri(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::from("data:application/octet-stream;base64,");
    for three in bytes.chunks(3) {
        let at = |i: usize| u32::from(three.get(i).copied().unwrap_or(0));
        let word = at(0) << 16 | at(1) << 8 | at(2);
        for digit in 0..4 {
            let pad = digit > three.len();
            text.push(if pad { '=' } else { char::from(DIGITS[(word >> (18 - 6 * digit) & 63) as usize]) });
        }
    }
    text
}
