//! Error against time, printed: `cargo bench -p keikan-tests`.
//!
//! Two tables. *Edges*: what the scanline's sub-scanlines and the rays' samples leave of error, against a
//! picture of 4096 rays a pixel, and what each costs. *Scaling*: time and memory of the whole main job for
//! terrains of 10⁴ to 10⁷ triangles (the last only with `KEIKAN_BENCH_LARGE=1`: it wants 8 GiB).

mod edges;
mod scaling;

fn main() {
    edges::table();
    scaling::table();
}
