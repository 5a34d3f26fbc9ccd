//! What kept maps belong to: a number for all that they depend on.

use light::{Geometry, Mesh};

use super::Settings;
use super::kept::VERSION;

/// FNV-1a of 128 bits: two contents that differ by chance have one number with a likelihood of 2⁻¹²⁸ (nobody who
/// wants them to is kept out). What is written to it as text counts as its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fnv(u128);

impl Default for Fnv {
    fn default() -> Self {
        Self::new()
    }
}

impl std::fmt::Write for Fnv {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.bytes(text.as_bytes());
        Ok(())
    }
}

impl Fnv {
    /// Of nothing.
    pub fn new() -> Self {
        Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }

    /// Of what there was with these after it.
    pub fn bytes(&mut self, bytes: &[u8]) -> &mut Self {
        for &byte in bytes {
            self.0 = (self.0 ^ u128::from(byte)).wrapping_mul((1 << 88) | 0x13b);
        }
        self
    }

    /// A list: its length is part of it, so that what ends one does not begin the next.
    fn list<B: AsRef<[u8]>>(&mut self, items: impl ExactSizeIterator<Item = B>) -> &mut Self {
        self.bytes(&(items.len() as u64).to_le_bytes());
        items.for_each(|item| {
            self.bytes(item.as_ref());
        });
        self
    }

    /// A list of vectors.
    fn vectors<const N: usize>(&mut self, vectors: impl ExactSizeIterator<Item = [f32; N]>) -> &mut Self {
        self.bytes(&(vectors.len() as u64).to_le_bytes());
        vectors.flatten().for_each(|x| {
            self.bytes(&x.to_le_bytes());
        });
        self
    }

    /// The number, the same on every machine.
    pub fn number(&self) -> u128 {
        self.0
    }
}

/// What a map depends on besides the geometry's positions and the settings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Described<'a> {
    /// What else hides the sky, as far as it is not in the geometry: solids, trees, water, textures of opacity.
    pub hiding: &'a [u8],
    /// The inner stage: model, sun, ground, scale, number of directions.
    pub sky: &'a [u8],
}

/// What kept values belong to: where they are, and under which sky.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Geometry, what else hides the sky, and settings.
    pub places: u128,
    /// The inner stage.
    pub sky: u128,
}

impl Key {
    pub(crate) fn new(geometry: &Geometry, settings: &Settings, described: &Described) -> Self {
        let mut places = Fnv::new();
        let Settings { coarse, least, tolerance, inset, seed } = *settings;
        places.bytes(&VERSION.to_le_bytes());
        places.vectors([[coarse, least, tolerance, inset]].into_iter());
        places.bytes(&seed.to_le_bytes());
        places.list(geometry.meshes.iter().map(|mesh| mesh_number(mesh).to_le_bytes()));
        places.list(geometry.instances.iter().map(|instance| instance.mesh.to_le_bytes()));
        for instance in &geometry.instances {
            places.list(instance.world_from_mesh.to_cols_array().iter().map(|x| x.to_le_bytes()));
        }
        places.list(described.hiding.iter().map(|&byte| [byte]));
        Self { places: places.number(), sky: Fnv::new().bytes(described.sky).number() }
    }
}

/// Shape, and what lets light pass. Texture coordinates count where opacity needs them, colours never.
fn mesh_number(mesh: &Mesh) -> u128 {
    let mut fnv = Fnv::new();
    fnv.vectors(mesh.positions.iter().map(|p| p.to_array()));
    fnv.vectors(mesh.normals.iter().map(|n| n.to_array()));
    fnv.list(mesh.triangles.as_flattened().iter().map(|i| i.to_le_bytes()));
    fnv.bytes(&[u8::from(mesh.opacity.is_some()), u8::from(mesh.medium.is_some())]);
    if let Some(opacity) = &mesh.opacity {
        fnv.vectors(mesh.uvs.iter().map(|uv| uv.to_array()));
        fnv.vectors([[opacity.factor, opacity.cutoff.unwrap_or(-1.0)]].into_iter());
        let [width, height] = opacity.texture.as_ref().map_or([0; 2], |texture| texture.size());
        fnv.bytes(&width.to_le_bytes()).bytes(&height.to_le_bytes());
        let wrap = opacity.texture.as_ref().map(|texture| texture.wrap());
        fnv.bytes(format!("{wrap:?}").as_bytes());
        for alpha in opacity.texture.iter().flat_map(|texture| texture.alphas()) {
            fnv.bytes(&alpha.to_le_bytes());
        }
    }
    if let Some(medium) = &mesh.medium {
        fnv.vectors([[medium.index, medium.transmission, f32::from(medium.thin)]].into_iter());
        fnv.vectors([medium.absorption.0, medium.tint.0].into_iter());
    }
    fnv.number()
}
