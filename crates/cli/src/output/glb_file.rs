//! Triangles as binary glTF 2.0 (GLB): a JSON chunk that describes, and a chunk of numbers.

use glam::Vec3;
use light::Mesh;
use serde_json::{Value, json};

/// Triangles of one matt colour.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    /// Of the material and the mesh.
    pub(crate) name: &'static str,
    /// Positions, normals, vertex colours and triangles count.
    pub(crate) mesh: Mesh,
    /// Linear base colour.
    pub(crate) colour: Vec3,
}

/// glTF's numbers for kinds of components and of buffers.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The numbers so far, and what they are.
#[derive(Default)]
struct Numbers {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Numbers {
    /// Adds a run of numbers of 4 bytes and gives the index of its accessor.
    fn add(&mut self, words: impl Iterator<Item = [u8; 4]>, accessor: Value, target: u32) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(words.flatten());
        let length = self.bytes.len() - start;
        let mut accessor = accessor;
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": length, "target": target }));
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds vectors; `bounded` states their extent, as positions must.
    fn vectors(&mut self, vectors: &[Vec3], bounded: bool) -> usize {
        let mut accessor = json!({ "componentType": FLOAT, "count": vectors.len(), "type": "VEC3" });
        if bounded {
            let low = vectors.iter().copied().fold(Vec3::INFINITY, Vec3::min);
            let high = vectors.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
            accessor["min"] = json!(low.to_array());
            accessor["max"] = json!(high.to_array());
        }
        self.add(vectors.iter().flat_map(|v| v.to_array().map(f32::to_le_bytes)), accessor, ARRAY_BUFFER)
    }

    fn primitive(&mut self, mesh: &Mesh, material: usize) -> Value {
        let mut attributes = json!({ "POSITION": self.vectors(&mesh.positions, true) });
        if !mesh.normals.is_empty() {
            attributes["NORMAL"] = json!(self.vectors(&mesh.normals, false));
        }
        if !mesh.colours.is_empty() {
            attributes["COLOR_0"] = json!(self.vectors(&mesh.colours, false));
        }
        let count = 3 * mesh.triangles.len();
        let accessor = json!({ "componentType": UNSIGNED_INT, "count": count, "type": "SCALAR" });
        let words = mesh.triangles.iter().flatten().map(|i| i.to_le_bytes());
        let indices = self.add(words, accessor, ELEMENT_ARRAY_BUFFER);
        json!({ "attributes": attributes, "indices": indices, "material": material })
    }
}

/// A file of all pieces that have triangles, each a mesh, a node and a material of its own.
pub(crate) fn encode(pieces: &[Piece]) -> Vec<u8> {
    let pieces: Vec<&Piece> = pieces.iter().filter(|piece| !piece.mesh.triangles.is_empty()).collect();
    let mut numbers = Numbers::default();
    let (mut meshes, mut nodes, mut materials) = (Vec::new(), Vec::new(), Vec::new());
    for (i, piece) in pieces.iter().enumerate() {
        meshes.push(json!({ "name": piece.name, "primitives": [numbers.primitive(&piece.mesh, i)] }));
        nodes.push(json!({ "name": piece.name, "mesh": i }));
        let colour = piece.colour.extend(1.0).to_array();
        let matt = json!({ "baseColorFactor": colour, "metallicFactor": 0.0, "roughnessFactor": 1.0 });
        materials.push(json!({ "name": piece.name, "doubleSided": true, "pbrMetallicRoughness": matt }));
    }
    let text = json!({
        "asset": { "version": "2.0", "generator": "keikan" },
        "scene": 0,
        "scenes": [{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "accessors": numbers.accessors,
        "bufferViews": numbers.views,
        "buffers": [{ "byteLength": numbers.bytes.len() }],
    });
    container(text.to_string().into_bytes(), numbers.bytes)
}

/// Header and both chunks, each filled up to whole words.
fn container(mut text: Vec<u8>, bytes: Vec<u8>) -> Vec<u8> {
    text.resize(text.len().next_multiple_of(4), b' ');
    let whole = 12 + 8 + text.len() + 8 + bytes.len();
    let mut file = Vec::with_capacity(whole);
    file.extend(b"glTF");
    file.extend([2, whole as u32, text.len() as u32].map(u32::to_le_bytes).concat());
    file.extend(b"JSON");
    file.extend(text);
    file.extend((bytes.len() as u32).to_le_bytes());
    file.extend(b"BIN\0");
    // Numbers are whole words already.
    file.extend(bytes);
    file
}
