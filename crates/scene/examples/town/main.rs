//! A town of some 800 objects under redevelopment, for the figures of the thesis' section 4.5.
//!
//! `cargo run -p keikan-scene --example town > scenes/thesis/town.gltf`. Always the same: chance is decided by a seed
//! ([`design::SEED`]). `crates/scene/tests/town.rs` sees to it that the file in `scenes/` is what this prints.

mod design;

fn main() {
    print!("{}", design::gltf());
}
