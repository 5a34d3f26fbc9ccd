//! Progress on a terminal, and Ctrl-C.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::pipeline::Monitor;

/// A monitor that Ctrl-C reaches. A second call in one process shares the first one's signal handler.
pub(crate) fn monitor() -> Arc<Monitor> {
    let monitor = Arc::new(Monitor::default());
    let heard = Arc::clone(&monitor);
    // Only one handler can be set; a library user may have their own, then theirs counts.
    let _ = ctrlc::set_handler(move || heard.interrupted.store(true, Ordering::Relaxed));
    monitor
}

/// Runs `work` on this thread (which may belong to a pool) while a bar on stderr shows the monitor's rows;
/// no bar unless stderr is a terminal.
pub(crate) fn shown<T>(monitor: &Monitor, rows: u64, work: impl FnOnce() -> T) -> T {
    let bar = ProgressBar::new(rows);
    if bar.is_hidden() {
        return work();
    }
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed} gone, {eta} to go") {
        bar.set_style(style);
    }
    let done = AtomicBool::new(false);
    thread::scope(|scope| {
        scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                bar.set_position(monitor.rows.load(Ordering::Relaxed));
                thread::sleep(Duration::from_millis(50));
            }
            bar.finish_and_clear();
        });
        let result = work();
        done.store(true, Ordering::Relaxed);
        result
    })
}
