//! The least effort that is good enough, sought on a few numbers of the result.

use super::error::Stratum;
use super::group::{Effort, Group};
use super::sample::Purpose;
use super::{Off, Subject};
use crate::Error;

/// What is known of the sampled numbers by now: each effort is asked for each sample once.
pub(super) struct Search<'a, S> {
    pub(super) subject: &'a mut S,
    kept: Vec<(Effort, Purpose, Vec<[f64; 3]>)>,
    /// By which samples is chosen: that of the pilot, and those whose check failed.
    chosen_by: Vec<Purpose>,
}

impl<'a, S: Subject> Search<'a, S> {
    pub(super) fn new(subject: &'a mut S) -> Self {
        Self { subject, kept: Vec::new(), chosen_by: vec![Purpose::Pilot] }
    }

    /// By which samples is chosen.
    pub(super) fn samples(&self) -> &[Purpose] {
        &self.chosen_by
    }

    /// From now on is chosen by this sample too.
    pub(super) fn learn_from(&mut self, sample: Purpose) {
        self.chosen_by.push(sample);
    }

    /// The numbers of samples with this effort.
    fn some(&mut self, effort: &Effort, samples: &[Purpose]) -> Result<Vec<[f64; 3]>, Error> {
        let mut all = Vec::new();
        for sample in samples {
            let known = self.kept.iter().find(|(e, s, _)| (e, s) == (effort, sample));
            if let Some((.., numbers)) = known {
                all.extend_from_slice(numbers);
            } else {
                let places = self.subject.sample(*sample);
                let numbers = self.subject.some(effort, &places)?;
                all.extend_from_slice(&numbers);
                self.kept.push((*effort, *sample, numbers));
            }
        }
        Ok(all)
    }

    /// How far samples with this effort are off, by what judges it.
    pub(super) fn off(&mut self, effort: &Effort, samples: &[Purpose]) -> Result<Off, Error> {
        let truths = self.some(&effort.judge(), samples)?;
        Ok(Off::new(&self.some(effort, samples)?, &truths))
    }

    /// The same of the whole that was made with this effort, and the share of the squared error that few places have which stand out.
    ///
    /// These are asked all, because a sample may have met none of them.
    pub(super) fn off_whole(
        &mut self,
        (whole, effort): (&S::Whole, &Effort),
        samples: &[Purpose],
    ) -> Result<(Off, f64), Error> {
        let judge = effort.judge();
        let outstanding = self.subject.outstanding(whole);
        let [answers, truths] =
            [self.subject.of(whole, &outstanding), self.subject.some(&judge, &outstanding)?];
        let share = outstanding.len() as f64 / self.subject.count().max(1) as f64;
        let few = Stratum { share, all: true, answers: &answers, truths: &truths };
        let places: Vec<_> = samples.iter().flat_map(|sample| self.subject.sample(*sample)).collect();
        let (answers, truths) = (self.subject.of(whole, &places), self.some(&judge, samples)?);
        let others = places.iter().map(|place| !outstanding.contains(place));
        let [answers, truths] = [answers, truths].map(|numbers| -> Vec<_> {
            numbers.into_iter().zip(others.clone()).filter_map(|(n, other)| other.then_some(n)).collect()
        });
        let rest = Stratum { share: 1.0 - share, all: false, answers: &answers, truths: &truths };
        let off = Off::stratified(&[rest, few]);
        let without = Off::stratified(&[Stratum { answers: few.truths, ..few }, rest]);
        let of_few = 1.0 - (without.relative_rmse / off.relative_rmse.max(f64::MIN_POSITIVE)).powi(2);
        Ok((off, of_few))
    }

    /// The least effort from `first` on that is good enough by what is chosen by; where none is the highest that helps, and `Err` of it.
    ///
    /// Each round asks what judges, and where that says no, each group of knobs by itself: by how much answers change when it alone
    /// has the judge's effort is its part of the error.
    pub(super) fn least(&mut self, first: Effort, wanted: f64) -> Result<Result<Effort, Effort>, Error> {
        let samples = self.chosen_by.clone();
        let mut effort = first;
        loop {
            let found = self.off(&effort, &samples)?.most();
            if found <= wanted {
                return Ok(Ok(effort));
            }
            let parts = self.parts(&effort, &samples)?;
            match effort.raised(&parts, S::TOP, [found, wanted]) {
                Some(higher) => effort = higher,
                None => return Ok(Err(effort)),
            }
        }
    }

    /// What part of the squared error each group has that decides anything here.
    fn parts(&mut self, effort: &Effort, samples: &[Purpose]) -> Result<Vec<(Group, f64)>, Error> {
        let (answers, judge) = (self.some(effort, samples)?, effort.judge());
        let mut parts = Vec::new();
        for group in Group::ALL {
            let alone = effort.with(group, judge.level(group));
            if self.subject.base().set(&alone) != self.subject.base().set(effort) {
                let changed = self.some(&alone, samples)?;
                parts.push((group, Off::new(&changed, &answers).relative_rmse.powi(2)));
            }
        }
        Ok(parts)
    }
}
