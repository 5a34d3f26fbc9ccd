//! Folders, devices, links and missing files in the place of those that a scene names.
#![cfg(unix)]

use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use keikan_scene::{Error, gltf, load, parse, photometry, triangulate};

/// A folder of this test's own, gone when it ends.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("keikan-strange-{}-{test}", std::process::id()));
        std::fs::create_dir_all(path.join("model")).unwrap();
        Self(path)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        std::fs::write(self.0.join(name), text).unwrap();
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

const LAMP: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 -0.1 -0.1 0\n1 1 15\n0 45 90\n0\n100 80 0\n";

/// A lamp with the profile `lamp.ies`, in a file that stands in `model/`.
const WITH_LAMP: &str = r#"{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }],
  "extensions": { "EXT_lights_ies": { "lights": [{ "uri": "lamp.ies" }] } },
  "nodes": [{ "name": "pole", "extensions": { "EXT_lights_ies": { "light": 0 } } }] }"#;

/// A triangle whose buffer and image are files.
const WITH_FILES: &str = r#"{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }],
  "nodes": [{ "mesh": 0 }], "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
  "materials": [{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }],
  "textures": [{ "source": 0 }], "images": [{ "uri": "bark.png" }],
  "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
  "bufferViews": [{ "buffer": 0, "byteLength": 36 }], "buffers": [{ "byteLength": 36, "uri": "points.bin" }] }"#;

/// Reading `/dev/zero` would never end, and opening a pipe never begin.
#[test]
fn only_plain_files_are_read() {
    let folder = Folder::new("device");
    let device = |name: &str| {
        symlink("/dev/zero", folder.0.join(name)).unwrap();
        folder.0.join(name)
    };
    let refused = |error: Error| {
        assert!(matches!(error, Error::Io { .. }), "{error}");
        assert!(error.to_string().contains("not a regular file"), "{error}");
    };
    refused(load(&device("a.toml")).unwrap_err());
    refused(load(&device("a.glb")).unwrap_err());
    refused(photometry::read(&device("a.ies")).unwrap_err());
    refused(triangulate::read_points(&device("a.csv")).unwrap_err());
    let text = "[[light]]\nposition = [0, 0, 0]\nfile = 'a.ies'\n";
    refused(parse(text, &folder.0, Path::new("a.toml")).unwrap_err());
    let error = load(&{
        std::fs::create_dir(folder.0.join("folder.toml")).unwrap();
        folder.0.join("folder.toml")
    });
    assert!(error.unwrap_err().to_string().contains("is a folder"));
}

#[test]
fn a_profile_may_not_lead_out_of_the_models_folder() {
    let folder = Folder::new("link");
    let model = folder.write("model/pole.gltf", WITH_LAMP);
    let lamp = folder.write("outside.ies", LAMP);
    symlink(&lamp, folder.0.join("model/lamp.ies")).unwrap();
    let error = load(&model).unwrap_err().to_string();
    assert!(error.contains("/extensions/EXT_lights_ies/lights/0/uri: "), "{error}");
    assert!(error.ends_with("leads out of the model's folder"), "{error}");
    std::fs::remove_file(folder.0.join("model/lamp.ies")).unwrap();
    let error = load(&model).unwrap_err().to_string();
    assert!(error.contains("lamp.ies: ") && error.contains("pole.gltf: light \"pole\")"), "{error}");
    folder.write("model/lamp.ies", LAMP);
    assert_eq!(load(&model).unwrap().lights[0].distribution.peak(), 100.0);
}

#[test]
fn missing_files_of_a_model_name_the_model_and_the_place() {
    let folder = Folder::new("missing");
    let model = folder.write("model/tree.gltf", WITH_FILES);
    for (name, place) in [("points.bin", "/buffers/0/uri"), ("bark.png", "/images/0/uri")] {
        let error = gltf::read(&model).unwrap_err();
        assert!(matches!(error, Error::Io { .. }));
        let error = error.to_string();
        assert!(error.starts_with(&folder.0.join("model").join(name).display().to_string()), "{error}");
        assert!(error.ends_with(&format!("tree.gltf: {place})")), "{error}");
        // 36 bytes of zeros will do for the buffer.
        folder.write(&format!("model/{name}"), &"\0".repeat(36));
    }
}
