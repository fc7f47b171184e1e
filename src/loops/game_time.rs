//! Game time over real time, around the longest frame of a trace.

use std::iter;

use super::loop_run::LoopRun;
use super::metrics::FrameRecord;
use super::trace::FrameTrace;

/// Number of frames before a long one.
const BEFORE: usize = 8;
/// Real time after a long frame, relative to its duration, and the range of that time in nanoseconds.
const AFTER: i64 = 10;
const AFTER_NS: [i64; 2] = [1_000_000_000, 3_000_000_000];
/// Minimum duration of a long frame, in refreshes of the display.
const LONG: f64 = 2.5;
/// Maximum number of frames that are searched for a long one.
const MAX_SEARCHED: usize = 100_000;

/// The frames of a loop around the longest one, or the first ones if none is long. Over real time, slow motion is
/// flatter than the diagonal, fast-forward is steeper, and a jump is a step.
#[derive(Clone, Default)]
pub struct GameTime {
    from_ns: i64,
    until_ns: i64,
    has_long: bool,
    points: Vec<[f64; 2]>,
}

impl GameTime {
    /// Finds the longest frame of a trace that begins before `until_ns`.
    pub fn around_longest(trace: &FrameTrace, until_ns: i64) -> Self {
        let mut frames = trace.frames();
        let displayed: Vec<i64> = iter::from_fn(|| frames.next(0))
            .take_while(|frame| frame.began_ns < until_ns)
            .take(MAX_SEARCHED)
            .filter_map(|frame| Some(frame.displayed_ns? + trace.lead_ns().unwrap_or_default()))
            .collect();
        let gaps = displayed.windows(2).map(|pair| pair[1] - pair[0]).enumerate();
        let long_ns = LONG * 1e9 / trace.refresh().hz();
        // The first of several equally long frames counts.
        let longest = gaps.filter(|(_, gap)| *gap as f64 > long_ns).min_by_key(|(_, gap)| -gap);
        let (index, gap) = longest.unwrap_or_default();
        let from_ns = longest.map_or(0, |_| displayed[index.saturating_sub(BEFORE)]);
        let after_ns = gap.saturating_mul(AFTER).clamp(AFTER_NS[0], AFTER_NS[1]);
        let until_ns = from_ns.saturating_add(gap).saturating_add(after_ns);
        Self { from_ns, until_ns, has_long: longest.is_some(), points: Vec::new() }
    }

    /// Returns the time of display of the first frame, in nanoseconds.
    pub fn from_ns(&self) -> i64 {
        self.from_ns
    }

    /// Whether one of the frames is long.
    pub fn has_long(&self) -> bool {
        self.has_long
    }

    /// Adds a frame, if it is one of those around the longest.
    pub fn frame(&mut self, run: &LoopRun, record: &FrameRecord) {
        let began_ns = record.frame.began_ns;
        if (self.from_ns..=self.until_ns).contains(&began_ns) {
            let pacer = run.lane().pacer();
            self.points.push([began_ns as f64 / 1e6, pacer.base().milliseconds(pacer.simulated())]);
        }
    }

    /// Returns the real time and the game time of each frame, in milliseconds.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }
}
