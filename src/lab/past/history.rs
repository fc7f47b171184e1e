//! The recent past of one body in one lane: what trails and plots are drawn from. Bounded, and
//! allocated once.
//!
//! A switch of method leaves a mark: the run of samples under the old method ends, and that under the new
//! one begins, with a sample at the moment of the switch.

use std::collections::vec_deque;
use std::{iter, option};

use glam::DVec2;

use super::log::Log;
use super::swept::Swept;
use crate::lab::lane::LaneBody;
use crate::lab::metrics::METRICS;

/// Samples shown: enough for every tick of 30 s at 60 Hz, and more than a plot has pixels.
pub const CAPACITY: usize = 2048;

/// Samples kept beside, to go back to at once: as many as 17 s at 60 Hz.
const SPARE: usize = 1024;

/// One moment of a body.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Time in seconds.
    pub t: f64,
    /// The first coordinate.
    pub q: f64,
    /// What the first coordinate passed over since the sample before.
    pub swept: Swept,
    /// Its velocity.
    pub v: f64,
    /// Where the body was, in metres.
    pub at: DVec2,
    /// The lane's place on the list of methods at that moment: a trail changes colour at a switch.
    pub entry: usize,
    /// One value for each of [`METRICS`]; NaN where it has no meaning.
    pub metrics: [f64; METRICS.len()],
    /// Whether the body was put here: no path leads from the samples before.
    pub jumped: bool,
}

/// To the bit.
impl PartialEq for Sample {
    fn eq(&self, other: &Self) -> bool {
        let numbers = |s: &Self| [s.t, s.q, s.v, s.at.x, s.at.y].map(f64::to_bits);
        let metrics = |s: &Self| s.metrics.map(f64::to_bits);
        numbers(self) == numbers(other)
            && metrics(self) == metrics(other)
            && (self.entry, self.jumped, self.swept) == (other.entry, other.jumped, other.swept)
    }
}

impl Sample {
    /// The present of `body`, in a lane whose method has place `entry`.
    pub(in crate::lab) fn new(t: f64, entry: usize, body: &LaneBody, truth: &LaneBody) -> Self {
        let (q, v) = (body.stepper.q()[0], body.stepper.v()[0]);
        let metrics =
            std::array::from_fn(|i| (METRICS[i].measure)(body, truth).unwrap_or(f64::NAN));
        let (swept, at) = (Swept::at(q), body.stepper.place());
        Self { t, q, swept, v, at, entry, metrics, jumped: false }
    }
}

/// The recent past of one body in one lane, oldest first.
#[derive(Debug)]
pub struct History {
    samples: Log<Sample>,
    /// The present, where it is no sample that stays.
    present: Option<Sample>,
    /// What the first coordinate passed over since the newest sample.
    since: Swept,
}

/// Where a [`History`] was at some tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct HistoryMark {
    /// How much was recorded since the start.
    samples: u64,
    since: Swept,
}

/// Samples of a [`History`], oldest first.
pub type Samples<'h> = iter::Chain<vec_deque::Iter<'h, Sample>, option::Iter<'h, Sample>>;

/// Samples that follow each other under one method.
#[derive(Clone, Debug)]
pub struct Run<'h> {
    /// The method's place on the list: what gives this stretch of the past its colour.
    pub entry: usize,
    /// The samples, oldest first; at least one.
    pub samples: iter::Take<Samples<'h>>,
}

impl History {
    /// An empty history with room for [`CAPACITY`] samples.
    pub fn new() -> Self {
        Self { samples: Log::new(CAPACITY, SPARE), present: None, since: Swept::NOTHING }
    }

    /// The samples, oldest first. The newest is the present, but for a body that has halted.
    pub fn samples(&self) -> Samples<'_> {
        self.after(0)
    }

    fn after(&self, skipped: usize) -> Samples<'_> {
        let of_present = skipped.saturating_sub(self.samples.len());
        let present = if of_present == 0 { &self.present } else { &None };
        self.samples.range(skipped.min(self.samples.len())).chain(present)
    }

    /// The samples cut where the method was switched, oldest run first. A run ends at the moment of the switch
    /// and the next one begins there; if it begins later, the body had halted and was taken up again.
    pub fn runs(&self) -> impl Iterator<Item = Run<'_>> {
        let mut from = 0;
        iter::from_fn(move || {
            let rest = self.after(from);
            let entry = rest.clone().next()?.entry;
            let count = rest.clone().take_while(|sample| sample.entry == entry).count();
            from += count;
            Some(Run { entry, samples: rest.take(count) })
        })
    }

    /// The time (s) since which the samples are one motion: a body that was put where it did not go has no path
    /// from the samples before to those after.
    pub fn unbroken_since(&self) -> f64 {
        let jump = self.samples().rev().find(|sample| sample.jumped);
        jump.map_or(f64::NEG_INFINITY, |sample| sample.t)
    }

    /// Takes in a tick at which no sample is due.
    pub(super) fn pass(&mut self, q: f64) {
        self.since = self.since.and(q);
    }

    /// Adds the present, and forgets the oldest sample if full.
    pub(super) fn record(&mut self, now: Sample) {
        let swept = self.since.and(now.q);
        self.begin_at(Sample { swept, ..now });
    }

    /// Adds a sample to which nothing leads from the one before.
    fn begin_at(&mut self, now: Sample) {
        self.present = None;
        self.since = Swept::NOTHING;
        self.samples.push(now);
    }

    /// Shows the present until the next sample comes.
    pub(super) fn record_passing(&mut self, now: Sample) {
        let is_there = self.samples.newest().is_some_and(|newest| newest.t == now.t);
        let swept = self.since.and(now.q);
        self.present = (!is_there).then_some(Sample { swept, ..now });
    }

    /// Ends the run of the present method now.
    pub(super) fn end_run(&mut self, now: Sample) {
        self.present = None;
        if self.samples.newest().is_none_or(|newest| newest.t != now.t) {
            self.record(now);
        }
    }

    /// Begins the run of the method that `now` is under. One that began at this very moment leaves no trace:
    /// nothing was flown under it.
    pub(super) fn begin_run(&mut self, mut now: Sample) {
        let mut newest_first = self.samples.shown().rev();
        let newest = newest_first.next().filter(|newest| newest.t == now.t);
        if let Some(newest) = newest
            && newest_first.next().is_none_or(|before| before.entry != newest.entry)
        {
            now.jumped |= newest.jumped;
            self.samples.pop();
        }
        let newest = self.samples.newest();
        let is_new = |newest: &Sample| {
            newest.t != now.t || newest.entry != now.entry || now.jumped && !newest.jumped
        };
        if newest.is_none_or(is_new) {
            self.begin_at(now);
        }
    }

    /// Goes on from `now`, where the body was put.
    pub(super) fn jump(&mut self, now: Sample) {
        self.begin_at(Sample { jumped: true, ..now });
    }

    /// Where it is now.
    pub(super) fn mark(&self) -> HistoryMark {
        HistoryMark { samples: self.samples.mark(), since: self.since }
    }

    /// Whether a run begun again at the mark `from` will show at `mark` what it showed then.
    pub(super) fn fills(&self, from: HistoryMark, mark: HistoryMark) -> bool {
        self.samples.fills(from.samples, mark.samples)
    }

    /// Goes back to a mark, or forward to one of the future that is kept.
    pub(super) fn rewind(&mut self, mark: HistoryMark) {
        self.present = None;
        self.since = mark.since;
        self.samples.rewind(mark.samples);
    }

    /// Forgets the future: another one begins.
    pub(super) fn forget_future(&mut self) {
        self.samples.forget_future();
    }
}

impl Default for History {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(t: f64, entry: usize) -> Sample {
        Sample {
            t,
            q: 0.0,
            swept: Swept::at(0.0),
            v: 0.0,
            at: DVec2::ZERO,
            entry,
            metrics: [0.0; METRICS.len()],
            jumped: false,
        }
    }

    /// The entry and the times of each run.
    fn runs(history: &History) -> Vec<(usize, Vec<f64>)> {
        history.runs().map(|run| (run.entry, run.samples.map(|s| s.t).collect())).collect()
    }

    /// A history of `entry` at 0, 1 and 2 s.
    fn flown(entry: usize) -> History {
        let mut history = History::new();
        (0..3).for_each(|t| history.record(sample(f64::from(t), entry)));
        history
    }

    fn switch(history: &mut History, t: f64, from: usize, to: usize) {
        history.end_run(sample(t, from));
        history.begin_run(sample(t, to));
    }

    #[test]
    fn runs_meet_at_the_moment_of_the_switch() {
        let mut history = flown(0);
        switch(&mut history, 2.5, 0, 3);
        history.record(sample(3.0, 3));
        let first = (0, vec![0.0, 1.0, 2.0, 2.5]);
        assert_eq!(runs(&history), [first.clone(), (3, vec![2.5, 3.0])]);
        switch(&mut history, 3.0, 3, 0);
        assert_eq!(runs(&history), [first, (3, vec![2.5, 3.0]), (0, vec![3.0])]);
        assert_eq!(runs(&History::new()), []);
    }

    #[test]
    fn a_method_that_flew_no_tick_leaves_no_run() {
        let mut history = flown(0);
        switch(&mut history, 2.0, 0, 1);
        switch(&mut history, 2.0, 1, 2);
        assert_eq!(runs(&history), [(0, vec![0.0, 1.0, 2.0]), (2, vec![2.0])]);
        switch(&mut history, 2.0, 2, 0);
        assert_eq!(runs(&history), [(0, vec![0.0, 1.0, 2.0])]);
        let mut history = History::new();
        history.record(sample(0.0, 0));
        switch(&mut history, 0.0, 0, 1);
        assert_eq!(runs(&history), [(1, vec![0.0])]);
    }

    #[test]
    fn the_present_shows_until_the_next_moment_comes() {
        let mut history = flown(0);
        history.record_passing(sample(2.0, 0));
        assert_eq!(history.samples().count(), 3, "it is there already");
        history.record_passing(sample(2.2, 0));
        history.record_passing(sample(2.4, 0));
        assert_eq!(runs(&history), [(0, vec![0.0, 1.0, 2.0, 2.4])]);
        history.record(sample(3.0, 0));
        assert_eq!(runs(&history), [(0, vec![0.0, 1.0, 2.0, 3.0])]);
        history.record_passing(sample(3.5, 0));
        switch(&mut history, 3.5, 0, 1);
        history.record(sample(4.0, 1));
        assert_eq!(runs(&history), [(0, vec![0.0, 1.0, 2.0, 3.0, 3.5]), (1, vec![3.5, 4.0])]);
    }

    #[test]
    fn a_sample_has_what_was_passed_over_since_the_one_before() {
        let swept = |history: &History| -> Vec<[f64; 2]> {
            history.samples().map(|sample| sample.swept.ends()).collect()
        };
        let mut history = flown(0);
        history.pass(-2.0);
        history.pass(1.0);
        let mark = history.mark();
        history.record_passing(sample(2.5, 0));
        assert_eq!(swept(&history), [[0.0; 2], [0.0; 2], [0.0; 2], [-2.0, 1.0]]);
        history.pass(3.0);
        history.record(sample(3.0, 0));
        history.record(sample(4.0, 0));
        assert_eq!(swept(&history)[3..], [[-2.0, 3.0], [0.0; 2]]);
        history.rewind(mark);
        switch(&mut history, 2.5, 0, 1);
        assert_eq!(swept(&history)[2..], [[0.0; 2], [-2.0, 1.0], [0.0; 2]]);
        history.pass(9.0);
        history.jump(sample(3.0, 1));
        assert_eq!(swept(&history)[5], [0.0; 2], "nothing leads to where it was put");
    }

    #[test]
    fn a_full_history_forgets_its_oldest_sample() {
        let mut history = History::new();
        (0..=CAPACITY).for_each(|t| history.record(sample(t as f64, 0)));
        history.record_passing(sample(1e9, 0));
        assert_eq!(history.samples().count(), CAPACITY + 1, "the present is beside them");
        assert_eq!(history.samples().next().unwrap().t, 1.0);
    }
}
