//! glTF models written by hand, byte for byte, and read back.

#[path = "gltf/builder.rs"]
mod builder;
#[path = "gltf/hostile.rs"]
mod hostile;
#[path = "gltf/looks.rs"]
mod looks;
#[path = "gltf/real_files.rs"]
mod real_files;
#[path = "gltf/shapes.rs"]
mod shapes;
