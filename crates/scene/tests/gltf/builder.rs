//! Writes small models: numbers into a buffer, JSON around it.

use std::path::Path;

use keikan_scene::gltf::{Model, parse};
use serde_json::{Value, json};

/// A model in the making.
#[derive(Clone)]
pub(crate) struct Builder {
    pub(crate) json: Value,
    pub(crate) binary: Vec<u8>,
}

impl Builder {
    /// Nothing but `asset` and one buffer.
    pub(crate) fn new() -> Self {
        let json = json!({
            "asset": { "version": "2.0" }, "buffers": [{ "byteLength": 0 }],
            "bufferViews": [], "accessors": [], "meshes": [], "nodes": []
        });
        Self { json, binary: Vec::new() }
    }

    /// One triangle (0,0,0) (1,0,0) (0,1,0), indexed by u16, worn by one node.
    pub(crate) fn triangle() -> Self {
        let mut builder = Self::new();
        let positions = builder.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let indices = builder.data(&[0, 0, 1, 0, 2, 0], 5123, "SCALAR", 3);
        builder.json["meshes"] =
            json!([{ "primitives": [{ "attributes": { "POSITION": positions }, "indices": indices }] }]);
        builder.json["nodes"] = json!([{ "mesh": 0, "name": "first" }]);
        builder
    }

    /// A buffer view of these bytes.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() }));
        self.binary.extend_from_slice(bytes);
        self.json["buffers"][0]["byteLength"] = json!(self.binary.len());
        self.json["bufferViews"].as_array().unwrap().len() - 1
    }

    /// An accessor on these bytes.
    pub(crate) fn data(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        let accessor =
            json!({ "bufferView": view, "componentType": component, "type": kind, "count": count });
        self.json["accessors"].as_array_mut().unwrap().push(accessor);
        self.json["accessors"].as_array().unwrap().len() - 1
    }

    /// An accessor on these floats.
    pub(crate) fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = values.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
        self.data(&bytes, 5126, ["", "SCALAR", "VEC2", "VEC3", "VEC4"][N], values.len())
    }

    /// Sets an attribute of the first primitive.
    pub(crate) fn attribute(&mut self, name: &str, accessor: usize) {
        self.json["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
    }

    /// A PNG of 8-bit RGBA as image, with a texture.
    pub(crate) fn texture(&mut self, width: u32, height: u32, rgba: &[u8]) -> usize {
        let view = self.view(&png(width, height, rgba));
        let image = push(&mut self.json, "images", json!({ "bufferView": view, "mimeType": "image/png" }));
        push(&mut self.json, "textures", json!({ "source": image }))
    }

    /// The file.
    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut text = serde_json::to_vec(&self.json).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.binary.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let mut file = b"glTF".to_vec();
        let word = |n: usize| (n as u32).to_le_bytes();
        file.extend(word(2));
        file.extend(word(12 + 8 + text.len() + 8 + binary.len()));
        file.extend(word(text.len()));
        file.extend(b"JSON");
        file.extend(text);
        file.extend(word(binary.len()));
        file.extend(b"BIN\0");
        file.extend(binary);
        file
    }

    /// Reads it.
    pub(crate) fn read(&self) -> Result<Model, String> {
        read(&self.glb())
    }

    /// Reads it, with `pointer` set to `value` first.
    pub(crate) fn with(&self, pointer: &str, value: Value) -> Result<Model, String> {
        let mut changed = self.clone();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        let parent = changed.json.pointer_mut(parent).expect("parent exists");
        match parent {
            Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
            parent => parent[key] = value,
        }
        changed.read()
    }
}

/// Reads a model from memory, with errors as text.
pub(crate) fn read(bytes: &[u8]) -> Result<Model, String> {
    parse(bytes, Path::new("/nonexistent-folder"), Path::new("test.glb")).map_err(|error| error.to_string())
}

/// Appends to a list at the root, which is made if it is not there.
pub(crate) fn push(json: &mut Value, list: &str, item: Value) -> usize {
    if json[list].is_null() {
        json[list] = json!([]);
    }
    let list = json[list].as_array_mut().unwrap();
    list.push(item);
    list.len() - 1
}

/// A PNG of 8-bit RGBA.
pub(crate) fn png(width: u32, height: u32, rgba: &[u8]) -> Vec<u8> {
    let image = image::RgbaImage::from_raw(width, height, rgba.to_vec()).unwrap();
    encode(&image.into())
}

/// A PNG of any kind.
pub(crate) fn encode(image: &image::DynamicImage) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}
