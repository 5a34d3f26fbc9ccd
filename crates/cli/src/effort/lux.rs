//! Illuminances with no more than so much error.

use scene::{Scene, Sensor};

use super::group::Effort;
use super::level::Level;
use super::sample::{Purpose, numbers};
use super::strata::Part;
use super::{Base, Subject, Verdict, Wanted, honoured};
use crate::Error;
use crate::args::View;
use crate::assemble::Measuring;
use crate::lux::{self, Table};
use crate::plan::Plan;

/// Points to choose by, and as many to check by.
const POINTS: usize = 24;

/// A table with no more than `wanted` error against much more effort, with what it was measured with, and what that took.
///
/// # Errors
/// As [`Measuring::new`].
pub(crate) fn table(
    scene: &Scene,
    view: &View,
    wanted: Wanted,
) -> Result<(Table, Measuring, Verdict), Error> {
    let mut subject = Measured(Base::new(scene, view, Plan::new(scene, view)?, true));
    let ((table, measuring), verdict) = honoured(&mut subject, wanted)?;
    Ok((table, measuring, verdict))
}

struct Measured<'a>(Base<'a>);

impl Measured<'_> {
    fn points(&self) -> usize {
        self.0.scene.sensors.iter().map(|sensor| sensor.points.len()).sum()
    }

    /// The scene with some of its sensor points alone, in rising order.
    fn with(&self, wanted: &[usize]) -> Scene {
        let mut before = 0;
        let sensor = |sensor: &Sensor| {
            let first = before;
            before += sensor.points.len();
            let own = wanted.iter().filter(|i| (first..first + sensor.points.len()).contains(*i));
            Sensor { points: own.map(|i| sensor.points[i - first]).collect(), ..sensor.clone() }
        };
        let sensors = self.0.scene.sensors.iter().map(sensor).collect();
        let mut scene = self.0.scene.clone();
        scene.sensors = sensors;
        scene
    }

    fn measured(&self, scene: &Scene, effort: &Effort) -> Result<(Table, Measuring), Error> {
        let plan = Plan::new(scene, &self.0.view(effort))?.at_sensors();
        let measuring = Measuring::new(&plan, scene)?;
        Ok((lux::measure(scene, &measuring), measuring))
    }
}

impl Subject for Measured<'_> {
    type Whole = (Table, Measuring);
    type Place = usize;
    const WHAT: &'static str = "sensor points";
    /// Sensors have many rays as it is.
    const TOP: Level = Level(5);

    fn base(&self) -> &Base<'_> {
        &self.0
    }

    fn sample(&self, purpose: Purpose) -> Vec<usize> {
        numbers(self.points(), POINTS, purpose)
    }

    fn some(&mut self, effort: &Effort, places: &[usize]) -> Result<Vec<[f64; 3]>, Error> {
        let (table, _) = self.measured(&self.with(places), effort)?;
        Ok(table.rows.iter().map(|row| [row.total; 3]).collect())
    }

    fn whole(&mut self, effort: &Effort) -> Result<(Table, Measuring), Error> {
        self.measured(self.0.scene, effort)
    }

    fn of(&self, (table, _): &(Table, Measuring), places: &[usize]) -> Vec<[f64; 3]> {
        places.iter().filter_map(|i| table.rows.get(*i)).map(|row| [row.total; 3]).collect()
    }

    /// Of points is not known which are neighbours.
    fn parts(&self, _: &(Table, Measuring), purpose: Purpose) -> Vec<Part<usize>> {
        let few = self.sample(purpose);
        vec![
            Part { share: 0.0, all: true, places: Vec::new() },
            Part { share: 1.0, all: few.len() == self.points(), places: few },
        ]
    }
}
