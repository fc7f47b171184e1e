//! The recent past of one body in one lane, for trails and plots. It is bounded, and allocated once.
//!
//! At a switch of method, the run of samples under the old method ends and one under the new method begins. Both have
//! a sample at the moment of the switch.

use std::collections::vec_deque;
use std::{iter, option};

use super::sample::{Sample, Summary, SweptRange};
use super::windowed_log::WindowedLog;
use crate::race::LaneBody;
use crate::{METRICS, Metric};

/// Maximum number of samples per summary. A summary's range covers all motion between the summary's ends.
const MAX_SUMMED: usize = 4;

/// The recent past of one body in one lane, with the oldest sample first.
#[derive(Clone, Debug)]
pub struct History {
    samples: WindowedLog<Sample>,
    /// The present, if no sample is due at this moment.
    present: Option<Sample>,
    /// Range of the recorded coordinate since the newest sample.
    since: SweptRange,
    most: Peaks,
}

/// Largest values since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peaks {
    /// Largest position error, in the unit of the first coordinate.
    pub error: f64,
    /// Largest magnitude of a coordinate in the same unit, in the lane or in truth.
    pub size: f64,
}

impl Peaks {
    /// Returns the values at this moment.
    pub(super) fn of(body: &LaneBody, truth: &LaneBody) -> Self {
        let error = (METRICS[Metric::POSITION_ERROR].measure)(body, truth).unwrap_or_default();
        let all = [body, truth].into_iter().flat_map(|body| body.like_first(body.stepper.q()));
        Self { error, size: all.map(f64::abs).fold(0.0, f64::max) }
    }

    fn max(self, other: Self) -> Self {
        Self { error: self.error.max(other.error), size: self.size.max(other.size) }
    }
}

/// The end of a [`History`] at some tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct HistoryMark {
    /// Number of samples since the start.
    samples: u64,
    since: SweptRange,
    most: Peaks,
}

/// Samples of a [`History`], oldest first.
pub type Samples<'h> = iter::Chain<vec_deque::Iter<'h, Sample>, option::Iter<'h, Sample>>;

impl History {
    /// Creates an empty history that shows `capacity` samples, and keeps half of that number in addition for rewinding
    /// without repetition. With [`CAPACITY`](super::CAPACITY), these further samples cover 17 s at 60 Hz.
    pub(super) fn new(capacity: usize) -> Self {
        let spare = capacity / 2;
        Self {
            samples: WindowedLog::new(capacity, spare),
            present: None,
            since: SweptRange::NOTHING,
            most: Peaks::default(),
        }
    }

    /// Returns the heap memory in bytes of a history of this capacity.
    pub(super) fn heap_bytes(capacity: usize) -> usize {
        (capacity + capacity / 2) * size_of::<Sample>()
    }

    /// Returns the samples, with the oldest first. The newest one is the present, unless the body has halted.
    pub fn samples(&self) -> Samples<'_> {
        self.after(0)
    }

    /// Groups the samples to summaries, at least `least` of them if there are enough samples. In a full history, a
    /// sample stays in the same group as time passes.
    pub fn summaries(&self, least: usize) -> Vec<Summary> {
        let together = (self.samples.len() / least.max(1)).clamp(1, MAX_SUMMED) as u64;
        let mut summaries: Vec<Summary> = Vec::with_capacity(self.samples.len() + 1);
        for (number, sample) in self.samples.numbered() {
            let next = Summary::of(sample);
            let last = summaries.last_mut().filter(|_| !number.is_multiple_of(together));
            match last.and_then(|last| Some((last.joined_with(next)?, last))) {
                Some((both, last)) => *last = both,
                None => summaries.push(next),
            }
        }
        summaries.extend(self.present.as_ref().map(Summary::of));
        summaries
    }

    fn after(&self, skipped: usize) -> Samples<'_> {
        let of_present = skipped.saturating_sub(self.samples.len());
        let present = if of_present == 0 { &self.present } else { &None };
        self.samples.range(skipped.min(self.samples.len())).chain(present)
    }

    /// Returns the samples from time `t` (s) on, with the oldest first. If the body was placed at `t`, they begin with
    /// the placement.
    pub fn since(&self, t: f64) -> Samples<'_> {
        let skipped = self.samples.count_before(t, |sample| (sample.t, sample.jumped));
        let is_over = self.present.as_ref().is_some_and(|present| present.t < t);
        self.after(skipped + usize::from(is_over))
    }

    /// Returns the largest values since the start.
    pub fn peaks(&self) -> Peaks {
        self.most
    }

    /// Updates the largest values with those of a tick.
    pub(super) fn note_peaks(&mut self, now: Peaks) {
        self.most = self.most.max(now);
    }

    /// Adds a tick at which no sample is due.
    pub(super) fn extend_swept(&mut self, q: f64) {
        self.since = self.since.extended_by(q);
    }

    /// Adds the present, and drops the oldest sample if the history is full.
    pub(super) fn push_present(&mut self, now: Sample) {
        let swept = self.since.extended_by(now.q);
        self.begin_at(Sample { swept, ..now });
    }

    /// Adds a sample that no path connects with its predecessor.
    fn begin_at(&mut self, now: Sample) {
        self.present = None;
        self.since = SweptRange::NOTHING;
        self.samples.push(now);
    }

    /// Shows the present until the next sample.
    pub(super) fn record_passing(&mut self, now: Sample) {
        let is_there = self.samples.newest().is_some_and(|newest| newest.t == now.t);
        let swept = self.since.extended_by(now.q);
        self.present = (!is_there).then_some(Sample { swept, ..now });
    }

    /// Ends the run of the present method at this moment.
    pub(super) fn end_run(&mut self, now: Sample) {
        self.present = None;
        if self.samples.newest().is_none_or(|newest| newest.t != now.t) {
            self.push_present(now);
        }
    }

    /// Begins a run under the method of `now`. The new run replaces a run that began at the same moment and has no
    /// motion.
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

    /// Continues from `now`, where the body was placed.
    pub(super) fn jump(&mut self, now: Sample, most: Peaks) {
        self.note_peaks(most);
        self.begin_at(Sample { jumped: true, ..now });
    }

    /// Marks the present, for rewinding.
    pub(super) fn mark(&self) -> HistoryMark {
        HistoryMark { samples: self.samples.mark(), since: self.since, most: self.most }
    }

    /// Whether a repetition from the mark `from` restores the samples shown at `mark`.
    pub(super) fn fills(&self, from: HistoryMark, mark: HistoryMark) -> bool {
        self.samples.fills(from.samples, mark.samples)
    }

    /// Rewinds to a mark. The mark may also lie in the recorded future.
    pub(super) fn rewind(&mut self, mark: HistoryMark) {
        self.present = None;
        (self.since, self.most) = (mark.since, mark.most);
        self.samples.rewind(mark.samples);
    }

    /// Drops the recorded future.
    pub(super) fn forget_future(&mut self) {
        self.samples.forget_future();
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::past::sample::CAPACITY;

    fn sample(t: f64, entry: usize) -> Sample {
        Sample {
            t,
            q: 0.0,
            swept: SweptRange::at(0.0),
            v: 0.0,
            at: DVec2::ZERO,
            energies: None,
            entry,
            pole: [f64::NAN; 2],
            metrics: [0.0; METRICS.len()],
            jumped: false,
        }
    }

    /// Returns the menu index and the times of each run.
    fn runs(history: &History) -> Vec<(usize, Vec<f64>)> {
        let samples: Vec<&Sample> = history.samples().collect();
        let runs = samples.chunk_by(|one, next| one.entry == next.entry);
        runs.map(|run| (run[0].entry, run.iter().map(|s| s.t).collect())).collect()
    }

    /// Returns a history of `entry` at 0, 1 and 2 s.
    fn flown(entry: usize) -> History {
        let mut history = History::new(CAPACITY);
        (0..3).for_each(|t| history.push_present(sample(f64::from(t), entry)));
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
        history.push_present(sample(3.0, 3));
        let first = (0, vec![0.0, 1.0, 2.0, 2.5]);
        assert_eq!(runs(&history), [first.clone(), (3, vec![2.5, 3.0])]);
        switch(&mut history, 3.0, 3, 0);
        assert_eq!(runs(&history), [first, (3, vec![2.5, 3.0]), (0, vec![3.0])]);
        assert_eq!(runs(&History::new(CAPACITY)), []);
    }

    #[test]
    fn a_method_without_a_tick_leaves_no_segment() {
        let mut history = flown(0);
        switch(&mut history, 2.0, 0, 1);
        switch(&mut history, 2.0, 1, 2);
        assert_eq!(runs(&history), [(0, vec![0.0, 1.0, 2.0]), (2, vec![2.0])]);
        switch(&mut history, 2.0, 2, 0);
        assert_eq!(runs(&history), [(0, vec![0.0, 1.0, 2.0])]);
        let mut history = History::new(CAPACITY);
        history.push_present(sample(0.0, 0));
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
        history.push_present(sample(3.0, 0));
        assert_eq!(runs(&history), [(0, vec![0.0, 1.0, 2.0, 3.0])]);
        history.record_passing(sample(3.5, 0));
        switch(&mut history, 3.5, 0, 1);
        history.push_present(sample(4.0, 1));
        assert_eq!(runs(&history), [(0, vec![0.0, 1.0, 2.0, 3.0, 3.5]), (1, vec![3.5, 4.0])]);
    }

    #[test]
    fn a_sample_has_the_range_swept_since_its_predecessor() {
        let swept = |history: &History| -> Vec<[f64; 2]> {
            history.samples().map(|sample| sample.swept.ends()).collect()
        };
        let mut history = flown(0);
        history.extend_swept(-2.0);
        history.extend_swept(1.0);
        let mark = history.mark();
        history.record_passing(sample(2.5, 0));
        assert_eq!(swept(&history), [[0.0; 2], [0.0; 2], [0.0; 2], [-2.0, 1.0]]);
        history.extend_swept(3.0);
        history.push_present(sample(3.0, 0));
        history.push_present(sample(4.0, 0));
        assert_eq!(swept(&history)[3..], [[-2.0, 3.0], [0.0; 2]]);
        history.rewind(mark);
        switch(&mut history, 2.5, 0, 1);
        assert_eq!(swept(&history)[2..], [[0.0; 2], [-2.0, 1.0], [0.0; 2]]);
        history.extend_swept(9.0);
        history.jump(sample(3.0, 1), Peaks::default());
        assert_eq!(swept(&history)[5], [0.0; 2], "nothing leads to where it was put");
    }

    #[test]
    fn samples_since_a_placement_begin_at_the_placed_position() {
        let mut history = flown(0);
        history.end_run(Sample { q: 5.0, ..sample(2.5, 0) });
        history.jump(Sample { q: 1.0, ..sample(2.5, 0) }, Peaks::default());
        history.push_present(sample(3.0, 0));
        history.record_passing(sample(3.5, 0));
        let since = |t: f64| history.since(t).map(|sample| sample.q).collect::<Vec<_>>();
        assert_eq!(since(2.5), [1.0, 0.0, 0.0]);
        assert_eq!(since(2.0), [0.0, 5.0, 1.0, 0.0, 0.0]);
        assert_eq!((since(3.5).len(), since(9.0).len(), since(-1.0).len()), (1, 0, 7));
    }

    #[test]
    fn a_full_history_forgets_its_oldest_sample() {
        let mut history = History::new(CAPACITY);
        (0..=CAPACITY).for_each(|t| history.push_present(sample(t as f64, 0)));
        history.record_passing(sample(1e9, 0));
        assert_eq!(history.samples().count(), CAPACITY + 1, "the present is beside them");
        assert_eq!(history.samples().next().unwrap().t, 1.0);
    }

    #[test]
    fn a_summary_covers_four_samples_of_one_motion_with_their_swept_range() {
        let at = |t: u32, q: f64| Sample { q, swept: SweptRange::at(q), ..sample(f64::from(t), 0) };
        let mut history = History::new(CAPACITY);
        (0..6).for_each(|t| history.push_present(at(t, f64::from(t))));
        switch(&mut history, 5.5, 0, 1);
        history.jump(Sample { entry: 1, ..at(6, 9.0) }, Peaks::default());
        history.push_present(Sample { entry: 1, ..at(7, f64::INFINITY) });
        history.record_passing(Sample { entry: 1, ..at(8, 7.0) });
        let summaries = |least: usize| -> Vec<(f64, usize, [f64; 2], bool)> {
            let all = history.summaries(least).into_iter();
            all.map(|s| (s.t, s.entry, s.swept.ends(), s.jumped)).collect()
        };
        let all = summaries(0);
        assert_eq!(all[..2], [(3.0, 0, [0.0, 3.0], false), (5.5, 0, [0.0, 5.0], false)]);
        let rest: Vec<_> = all[2..].iter().map(|s| (s.0, s.1, s.3)).collect();
        assert_eq!(rest, [(5.5, 1, false), (6.0, 1, true), (7.0, 1, false), (8.0, 1, false)]);
        assert_eq!(summaries(usize::MAX).len(), history.samples().count());
    }

    #[test]
    fn summaries_of_a_full_history_have_the_requested_count_and_stay_stable() {
        let mut history = History::new(CAPACITY);
        let record = |history: &mut History, t: usize| history.push_present(sample(t as f64, 0));
        (0..3 * CAPACITY).for_each(|t| record(&mut history, t));
        for (least, together) in [(0, 4), (400, 4), (CAPACITY / 2, 2), (CAPACITY, 1)] {
            let times = |history: &History| -> Vec<f64> {
                history.summaries(least).iter().map(|summary| summary.t).collect()
            };
            let (before, whole) = (times(&history), CAPACITY / together);
            assert!((whole..=whole + 1).contains(&before.len()), "{least}: {}", before.len());
            (0..together).for_each(|n| record(&mut history, 3 * CAPACITY + n));
            assert_eq!(times(&history)[..whole - 1], before[1..whole]);
            let mark = HistoryMark { samples: 3 * CAPACITY as u64, ..history.mark() };
            history.rewind(mark);
            assert_eq!(times(&history), before);
        }
    }
}
