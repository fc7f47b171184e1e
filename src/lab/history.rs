//! The recent past of one body in one lane: what trails and plots are drawn from. Bounded, and
//! allocated once.
//!
//! A switch of method leaves a mark: the run of samples under the old method ends, and that under the new
//! one begins, with a sample at the moment of the switch.

use std::collections::{VecDeque, vec_deque};

use glam::DVec2;

use super::lane::LaneBody;
use super::metrics::METRICS;

/// Samples kept: enough for every tick of 30 s at 60 Hz, and more than a plot has pixels.
pub const CAPACITY: usize = 2048;

/// One moment of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Time in seconds.
    pub t: f64,
    /// The first coordinate.
    pub q: f64,
    /// Its velocity.
    pub v: f64,
    /// Where the body was, in metres.
    pub at: DVec2,
    /// The lane's place on the list of methods at that moment: a trail changes colour at a switch.
    pub entry: usize,
    /// One value for each of [`METRICS`]; NaN where it has no meaning.
    pub metrics: [f64; METRICS.len()],
}

impl Sample {
    /// The present of `body`, in a lane whose method has place `entry`.
    pub(super) fn new(t: f64, entry: usize, body: &LaneBody, truth: &LaneBody) -> Self {
        let (q, v) = (body.stepper.q()[0], body.stepper.v()[0]);
        let metrics =
            std::array::from_fn(|i| (METRICS[i].measure)(body, truth).unwrap_or(f64::NAN));
        Self { t, q, v, at: body.stepper.place(), entry, metrics }
    }
}

/// The recent past of one body in one lane, oldest first.
#[derive(Debug)]
pub struct History {
    samples: VecDeque<Sample>,
    /// Whether the newest sample is to give way to the next one.
    newest_passes: bool,
    unbroken_since: f64,
}

/// Samples that follow each other under one method.
#[derive(Clone, Debug)]
pub struct Run<'h> {
    /// The method's place on the list: what gives this stretch of the past its colour.
    pub entry: usize,
    /// The samples, oldest first; at least one.
    pub samples: vec_deque::Iter<'h, Sample>,
}

impl History {
    /// An empty history with room for [`CAPACITY`] samples.
    pub fn new() -> Self {
        let samples = VecDeque::with_capacity(CAPACITY);
        Self { samples, newest_passes: false, unbroken_since: f64::NEG_INFINITY }
    }

    /// The samples, oldest first. The newest is the present, but for a body that has halted.
    pub fn samples(&self) -> impl DoubleEndedIterator<Item = &Sample> + ExactSizeIterator + Clone {
        self.samples.iter()
    }

    /// The samples cut where the method was switched, oldest run first. A run ends at the moment of the switch
    /// and the next one begins there; if it begins later, the body had halted and was taken up again.
    pub fn runs(&self) -> impl Iterator<Item = Run<'_>> {
        let mut from = 0;
        std::iter::from_fn(move || {
            let entry = self.samples.get(from)?.entry;
            let rest = self.samples.range(from..);
            let to = from + rest.take_while(|sample| sample.entry == entry).count();
            let samples = self.samples.range(from..to);
            from = to;
            Some(Run { entry, samples })
        })
    }

    /// The time (s) since which the samples are one motion: a body that had blown up and was taken up again
    /// from the truth did not go there, so that no path leads from the samples before to those after.
    pub fn unbroken_since(&self) -> f64 {
        self.unbroken_since
    }

    /// Adds the present, and forgets the oldest sample if full.
    pub(super) fn record(&mut self, now: Sample) {
        if std::mem::take(&mut self.newest_passes) {
            self.samples.pop_back();
        }
        if self.samples.len() == CAPACITY {
            self.samples.pop_front();
        }
        self.samples.push_back(now);
    }

    /// Adds the present until the next sample comes.
    pub(super) fn record_passing(&mut self, now: Sample) {
        if self.samples.back().is_some_and(|newest| newest.t == now.t && !self.newest_passes) {
            return;
        }
        self.record(now);
        self.newest_passes = true;
    }

    /// Ends the run of the present method now.
    pub(super) fn end_run(&mut self, now: Sample) {
        if self.samples.back().is_none_or(|newest| newest.t != now.t) {
            self.record(now);
        }
        self.newest_passes = false;
    }

    /// Begins the run of the method that `now` is under. One that began at this very moment leaves no trace:
    /// nothing was flown under it.
    pub(super) fn begin_run(&mut self, now: Sample) {
        let mut newest_first = self.samples.iter().rev();
        let newest = newest_first.next().filter(|newest| newest.t == now.t);
        let is_alone =
            |newest: &Sample| newest_first.next().is_none_or(|s| s.entry != newest.entry);
        if newest.is_some_and(is_alone) {
            self.samples.pop_back();
        }
        let newest = self.samples.back();
        if newest.is_none_or(|newest| newest.t != now.t || newest.entry != now.entry) {
            self.record(now);
        }
    }

    /// Notes that the body was set into another state at time `t` (s).
    pub(super) fn break_off(&mut self, t: f64) {
        self.unbroken_since = t;
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
        Sample { t, q: 0.0, v: 0.0, at: DVec2::ZERO, entry, metrics: [0.0; METRICS.len()] }
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
        assert_eq!(history.samples().len(), 3, "it is there already");
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
    fn a_full_history_forgets_its_oldest_sample() {
        let mut history = History::new();
        (0..=CAPACITY).for_each(|t| history.record(sample(t as f64, 0)));
        history.record_passing(sample(1e9, 0));
        assert_eq!(history.samples().len(), CAPACITY);
        assert_eq!(history.samples().next().unwrap().t, 2.0);
    }
}
