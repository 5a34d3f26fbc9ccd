//! The least effort that is good enough, sought on a few numbers of the result.

use super::error::{Stratum, mean_square};
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
    /// The last check.
    check: u32,
}

/// Checks in turn, each after one that failed.
const CHECKS: u32 = 3;

impl<'a, S: Subject> Search<'a, S> {
    pub(super) fn new(subject: &'a mut S) -> Self {
        Self { subject, kept: Vec::new(), chosen_by: vec![Purpose::Pilot], check: 0 }
    }

    /// Raises the effort until a sample passes that nothing was chosen by, a few times at most; false where nothing more can be raised.
    /// One that fails joins those that are chosen by.
    pub(super) fn passed(&mut self, effort: &mut Effort, wanted: f64) -> Result<bool, Error> {
        for _ in 0..CHECKS {
            let helps = self.least(effort, wanted)?;
            self.check += 1;
            let last = [Purpose::Check(self.check)];
            if !helps || self.off(effort, &last)?.most() <= wanted {
                return Ok(helps);
            }
            self.chosen_by.extend(last);
        }
        Ok(true)
    }

    /// What is known of the whole that was made with this effort, and the share of the squared error that few places have which stand
    /// out: by places of each of its parts, or by those that the effort was chosen by if they say more. The last check joins these.
    pub(super) fn verdict(&mut self, whole: &S::Whole, effort: &Effort) -> Result<(Off, f64), Error> {
        let (parts, standing_out) = self.by_parts(whole, effort)?;
        let samples = self.chosen_by.clone();
        let truths = self.some(&effort.judge(), &samples)?;
        let chosen = Off::new(&self.of(whole, &samples), &truths);
        self.chosen_by.push(Purpose::Check(self.check));
        Ok(if parts.sampled && chosen.most() > parts.most() { (chosen, 0.0) } else { (parts, standing_out) })
    }

    fn of(&self, whole: &S::Whole, samples: &[Purpose]) -> Vec<[f64; 3]> {
        let places: Vec<_> = samples.iter().flat_map(|sample| self.subject.sample(*sample)).collect();
        self.subject.of(whole, &places)
    }

    /// How far the whole is off by places of each of its parts, and the share of the first in the squared error.
    fn by_parts(&mut self, whole: &S::Whole, effort: &Effort) -> Result<(Off, f64), Error> {
        let parts = self.subject.parts(whole, Purpose::Check(self.check));
        let places: Vec<_> = parts.iter().flat_map(|part| part.places.iter().copied()).collect();
        let [answers, truths] =
            [self.subject.of(whole, &places), self.subject.some(&effort.judge(), &places)?];
        let mut begin = 0;
        let mut strata: Vec<Stratum> = parts
            .iter()
            .map(|part| {
                let own = begin..begin + part.places.len();
                begin = own.end;
                let (share, all) = (part.share, part.all);
                Stratum { share, all, answers: &answers[own.clone()], truths: &truths[own] }
            })
            .collect();
        let off = Off::stratified(&strata);
        if let Some(first) = strata.first_mut() {
            first.answers = first.truths;
        }
        let others = Off::stratified(&strata).relative_rmse;
        let standing_out =
            if others < off.relative_rmse { 1.0 - (others / off.relative_rmse).powi(2) } else { 0.0 };
        Ok((off, standing_out))
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
    fn off(&mut self, effort: &Effort, samples: &[Purpose]) -> Result<Off, Error> {
        let truths = self.some(&effort.judge(), samples)?;
        Ok(Off::new(&self.some(effort, samples)?, &truths))
    }

    /// How far what is chosen by is off with this effort, at most.
    pub(super) fn found(&mut self, effort: &Effort) -> Result<f64, Error> {
        let samples = self.chosen_by.clone();
        Ok(self.off(effort, &samples)?.most())
    }

    /// Raises the effort until it is good enough by what is chosen by; false where nothing more can be raised that helps.
    ///
    /// Each round asks what judges, and where that says no, each group of knobs by itself: by how much answers change when it alone
    /// has the judge's effort is its part of the error.
    fn least(&mut self, effort: &mut Effort, wanted: f64) -> Result<bool, Error> {
        loop {
            let found = self.found(effort)?;
            if found <= wanted {
                return Ok(true);
            }
            let causes = self.causes(effort)?;
            match effort.raised(&causes, S::TOP, [found, wanted]) {
                Some(higher) => *effort = higher,
                None => return Ok(false),
            }
        }
    }

    /// What part of the squared error each group has that decides anything here.
    fn causes(&mut self, effort: &Effort) -> Result<Vec<(Group, f64)>, Error> {
        let samples = self.chosen_by.clone();
        let (answers, judge) = (self.some(effort, &samples)?, effort.judge());
        let mut causes = Vec::new();
        for group in Group::ALL {
            let alone = effort.with(group, judge.level(group));
            if self.subject.base().anew([effort, &alone]).is_some() {
                let changed = self.some(&alone, &samples)?;
                causes.push((group, mean_square(&changed, &answers)));
            }
        }
        Ok(causes)
    }
}
