//! What was done, how long it took and how much memory: the summary.

use std::fmt;
use std::path::PathBuf;
use std::time::Instant;

use crate::effort::Verdict;
use crate::plan::Plan;

/// Seconds per stage, in the order they ran.
#[derive(Clone, Debug, Default, serde::Serialize)]
pub struct Timings(pub Vec<(&'static str, f64)>);

impl Timings {
    /// Runs `work` and remembers how long it took.
    pub fn time<T>(&mut self, stage: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let done = work();
        self.0.push((stage, start.elapsed().as_secs_f64()));
        done
    }
}

/// The summary of one `render`.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Summary {
    /// What was decided.
    pub plan: Plan,
    /// Place, time and sun, in words.
    pub site: String,
    /// Seconds per stage.
    pub seconds: Timings,
    /// Pieces of surface shaded.
    pub pieces: u64,
    /// Largest resident memory of the process so far \[MiB\], where the system tells.
    pub peak_memory_mib: Option<f64>,
    /// Mean and largest luminance \[cd/m²\].
    pub luminance: [f32; 2],
    /// How the PNG was exposed, in words.
    pub exposure: Option<String>,
    /// What error was asked for and what came of it; none where none was.
    pub(crate) error: Option<Verdict>,
    /// What was repaired in the input, and what is less exact than one may think.
    pub warnings: Vec<String>,
    /// Files written.
    pub written: Vec<PathBuf>,
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for warning in &self.warnings {
            writeln!(f, "warning: {warning}")?;
        }
        writeln!(f, "{}", self.site)?;
        writeln!(
            f,
            "{} x {} pixels, {} triangles, {} pieces shaded, mean {:.4} cd/m², largest {:.4} cd/m²",
            self.plan.width,
            self.plan.height,
            self.plan.contents.triangles,
            self.pieces,
            self.luminance[0],
            self.luminance[1]
        )?;
        if let Some(exposure) = &self.exposure {
            writeln!(f, "{exposure}")?;
        }
        if let Some(verdict) = &self.error {
            writeln!(f, "{verdict}")?;
        }
        let seconds: Vec<String> =
            self.seconds.0.iter().map(|(stage, s)| format!("{stage} {s:.3} s")).collect();
        write!(f, "{}", seconds.join(", "))?;
        if let Some(mib) = self.peak_memory_mib {
            write!(f, "; {mib:.0} MiB at most")?;
        }
        for path in &self.written {
            write!(f, "\nwrote {}", path.display())?;
        }
        Ok(())
    }
}

/// Largest resident memory of this process \[MiB\]; none where the system does not tell.
pub fn peak_memory_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}

/// Makes [`peak_memory_mib`] begin anew; false where the system cannot.
pub fn forget_peak_memory() -> bool {
    std::fs::write("/proc/self/clear_refs", "5").is_ok()
}
