//! Error against time, printed: `cargo bench -p keikan-tests`.
//!
//! Four tables, all or those named (`-- edges`, `-- scaling`, `-- table-2-1`, `-- table-4-1`). *Edges*: what the scanline's sub-scanlines and the rays' samples leave of error, against a
//! picture of 4096 rays a pixel, and what each costs. *Scaling*: time and memory of the whole main job for
//! terrains of 10⁴ to 10⁷ triangles (the last only with `KEIKAN_BENCH_LARGE=1`: it wants 4 GiB). *Table 2.1*:
//! the thesis' four cases, our defaults, and rays at equal error. *Table 4.1*: sky light of a town
//! by bands, cuboid, patches and rays, and what maps save.

mod clock;
mod edges;
mod scaling;
mod table_2_1;
mod table_4_1;

fn main() {
    let tables: [(&str, fn()); 4] = [
        ("edges", edges::table),
        ("scaling", scaling::table),
        ("table-2-1", table_2_1::table),
        ("table-4-1", table_4_1::table),
    ];
    // Cargo adds `--bench`.
    let wanted: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    for (name, table) in tables {
        if wanted.is_empty() || wanted.iter().any(|word| word == name) {
            table();
        }
    }
}
