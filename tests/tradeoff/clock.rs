//! How long a picture takes.

use std::time::Instant;

use keikan::pipeline::{Monitor, Pipeline, Region};
use light::Film;

/// What a picture took \[s\].
#[derive(Clone, Copy)]
pub(crate) struct Took {
    /// Of all threads together: on a busy machine this says more than a clock.
    pub(crate) processor: f64,
    /// By the clock.
    pub(crate) wall: f64,
}

/// The whole picture.
pub(crate) fn shot(pipeline: &Pipeline, (width, height): (u32, u32)) -> (Film, Took) {
    let whole = Region { columns: 0..width, rows: 0..height };
    let (start, processor) = (Instant::now(), processor_seconds());
    let film = pipeline.render(&whole, false, &Monitor::default()).expect("nobody interrupts");
    let took = Took { processor: processor_seconds() - processor, wall: start.elapsed().as_secs_f64() };
    (film, took)
}

/// Processor time of this process so far \[s\], all threads together, where the system tells it (`utime` and `stime` of
/// Linux, 100 a second); else the time of day.
fn processor_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(") ").next().unwrap_or("").split(' ').collect();
    let ticks = |i: usize| fields.get(i).and_then(|field| field.parse::<f64>().ok());
    let of_day = || std::time::UNIX_EPOCH.elapsed().map_or(0.0, |since| since.as_secs_f64());
    ticks(11).zip(ticks(12)).map_or_else(of_day, |(user, system)| (user + system) / 100.0)
}
