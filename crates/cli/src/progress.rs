//! Progress on a terminal, and Ctrl-C.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::Error;
use crate::pipeline::Monitor;

/// The process's monitor, which Ctrl-C reaches, as new: several commands of one process have it one after the other.
pub(crate) fn monitor() -> Arc<Monitor> {
    static ONLY: OnceLock<Arc<Monitor>> = OnceLock::new();
    let monitor = Arc::clone(ONLY.get_or_init(listening));
    monitor.rendering.store(false, Ordering::Relaxed);
    monitor.rows.store(0, Ordering::Relaxed);
    monitor.pieces.store(0, Ordering::Relaxed);
    monitor
}

fn listening() -> Arc<Monitor> {
    let monitor = Arc::new(Monitor::default());
    let heard = Arc::clone(&monitor);
    // Only one handler can be set; a library user may have their own, then theirs counts.
    let _ = ctrlc::set_handler(move || {
        heard.interrupted.store(true, Ordering::Relaxed);
        // Before rendering there is nothing to clean up, and whoever asks twice does not want to wait.
        if !heard.rendering.load(Ordering::Relaxed) || heard.asked.swap(true, Ordering::Relaxed) {
            // Not "nothing was written": of several frames some may have been.
            eprintln!("keikan: interrupted");
            std::process::exit(i32::from(Error::Interrupted.exit_code()));
        }
    });
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
    /// Ends the bar also when the work ends in a panic.
    struct Done<'a>(&'a AtomicBool);
    impl Drop for Done<'_> {
        fn drop(&mut self) {
            self.0.store(true, Ordering::Relaxed);
        }
    }
    thread::scope(|scope| {
        let ended = Done(&done);
        scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                bar.set_position(monitor.rows.load(Ordering::Relaxed));
                thread::sleep(Duration::from_millis(50));
            }
            bar.finish_and_clear();
        });
        let result = work();
        drop(ended);
        result
    })
}
