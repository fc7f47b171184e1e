//! Recommends a game loop, for the command line and the loop lab.
//!
//! A fixed tick comes first, because without one the physics depends on the frame rate. Then a loop must keep its speed
//! and the motion, and must not flutter. Among those that are left, smoothness comes before latency, up to a limit of
//! the latency that a person sets.

use super::metrics::PacingReport;
use super::policy::PolicyCard;
use super::time_base::RefreshRate;
use super::verdict::LoopVerdict;
use crate::measure::Severity;
use crate::run::race::Interpolation;
use crate::sim::TickRate;
use crate::sim::number::round;

/// Two animation errors that differ by less than this are equal, in milliseconds, because no display shows the
/// difference.
const ALIKE_MS: f64 = 1e-3;
/// Two position errors that differ by less than this are equal, in amplitudes.
const AS_NEAR: f64 = 0.01;

/// Default limit on the mean latency of a recommended loop, in milliseconds.
pub const USUAL_LATENCY_MS: f64 = 20.0;

/// Largest difference between the tick rate and the refresh rate at which noise decides on the ticks of a frame.
const SAME_RATE: f64 = 0.01;

/// Whether ticks are about as frequent as refreshes, so that noise decides on the ticks of a frame.
pub(super) fn is_same_rate(tick_hz: TickRate, refresh: RefreshRate) -> bool {
    (f64::from(tick_hz) / refresh.hz() - 1.0).abs() <= SAME_RATE
}

/// Reason to prefer a loop that draws between two ticks to one that is equally smooth but draws beyond the last tick.
const NOT_AHEAD: &str = "extrapolation or a render tick would be as smooth and no tick late, but overshoots at each kick";

/// The recommended loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AdvisedLoop {
    /// Index of the loop among the measured loops.
    pub index: usize,
    /// Why the loop beats another one that is equally smooth, if this needs an explanation.
    pub why: Option<&'static str>,
}

/// The reason why no loop is recommended. Indices refer to the measured loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoLoop {
    /// Fewer than two frames were displayed.
    TooFewFrames,
    /// No loop has a fixed tick, so the physics of every loop depends on the frame rate.
    NoFixedTick,
    /// The speed of every loop with a fixed tick depends on the frame rate.
    OtherSpeed,
    /// Every loop with a fixed tick loses the motion.
    MotionLost,
    /// Every loop with a fixed tick shows no tick in some frames and two in others, unless the clock is exact.
    Flutter,
    /// No loop with a fixed tick is both smooth and within the latency.
    Unfit {
        /// The smooth loop with the lowest latency.
        late: Option<usize>,
        /// The smoothest uneven loop within the latency. If there is none and no loop is smooth, the smoothest uneven
        /// loop of all.
        uneven: Option<usize>,
    },
}

impl NoLoop {
    /// Returns the loop that comes closest to a recommendation.
    pub fn nearest(self) -> Option<usize> {
        match self {
            Self::Unfit { late, uneven } => late.or(uneven),
            _ => None,
        }
    }
}

/// Loops that were measured on the same trace.
pub struct MeasuredLoops<'a> {
    loops: Vec<(&'a PolicyCard, &'a PacingReport)>,
    tick_hz: TickRate,
    refresh: RefreshRate,
    origin_ms: f64,
}

impl<'a> MeasuredLoops<'a> {
    /// Collects loops at a tick rate, measured on one trace. If its frames begin and are displayed by clocks without
    /// a common origin, only differences of latencies have a meaning. Latencies then count from the smallest one.
    pub fn new(
        loops: impl IntoIterator<Item = (&'a PolicyCard, &'a PacingReport)>,
        tick_hz: impl Into<TickRate>,
        refresh: RefreshRate,
        has_one_clock: bool,
    ) -> Self {
        let loops: Vec<_> = loops.into_iter().collect();
        let latencies = loops.iter().filter_map(|(_, report)| report.latency_mean_ms());
        let least = latencies.reduce(f64::min).filter(|_| !has_one_clock);
        Self { loops, tick_hz: tick_hz.into(), refresh, origin_ms: least.unwrap_or(0.0) }
    }

    /// Returns the mean latency of the loop with this index, in milliseconds.
    pub fn latency_ms(&self, index: usize) -> Option<f64> {
        self.loops[index].1.latency_mean_ms().map(|latency| latency - self.origin_ms)
    }

    /// Returns the best smooth loop with a fixed tick and a mean latency of at most `latency_ms`. The best one has the
    /// smallest animation error. Among equals it is one that never draws beyond its last tick, then the one with the
    /// smaller position error, then the first. A loop that [needs an exact clock](PolicyCard::needs_exact_clock) is
    /// not advised at the rate of the display.
    ///
    /// # Errors
    /// Returns the reason if no loop qualifies.
    pub fn advised(&self, latency_ms: f64) -> Result<AdvisedLoop, NoLoop> {
        if self.loops.iter().all(|(_, report)| report.animation_error_rms_ms.is_none()) {
            return Err(NoLoop::TooFewFrames);
        }
        let mut fitting: Vec<usize> = (0..self.loops.len()).collect();
        fitting.retain(|&index| self.loops[index].0.has_fixed_tick);
        if fitting.is_empty() {
            return Err(NoLoop::NoFixedTick);
        }
        fitting.retain(|&index| self.loops[index].1.keeps_speed() == Some(true));
        if fitting.is_empty() {
            return Err(NoLoop::OtherSpeed);
        }
        fitting.retain(|&index| !self.loops[index].1.loses_motion());
        if fitting.is_empty() {
            return Err(NoLoop::MotionLost);
        }
        let is_same_rate = is_same_rate(self.tick_hz, self.refresh);
        let (fluttering, mut fitting): (Vec<usize>, Vec<usize>) = fitting
            .into_iter()
            .partition(|&index| is_same_rate && self.loops[index].0.needs_exact_clock);
        if fitting.is_empty() && !fluttering.is_empty() {
            return Err(NoLoop::Flutter);
        }
        fitting.sort_by(|&one, &other| {
            self.rank(one).partial_cmp(&self.rank(other)).expect("numbers")
        });
        let late = |index: &usize| self.latency_ms(*index).unwrap_or(f64::INFINITY);
        let (smooth, uneven): (Vec<usize>, Vec<usize>) =
            fitting.into_iter().partition(|&index| self.is_smooth(index));
        let is_in_time = |index: &usize| late(index) <= latency_ms + ALIKE_MS;
        let Some(index) = smooth.iter().copied().find(is_in_time) else {
            let in_time = uneven.iter().find(|index| is_in_time(index));
            return Err(NoLoop::Unfit {
                late: smooth.iter().copied().min_by(|one, other| late(one).total_cmp(&late(other))),
                uneven: in_time.or(uneven.first().filter(|_| smooth.is_empty())).copied(),
            });
        };
        let draws_between =
            matches!(self.loops[index].0.drawing, Interpolation::Linear | Interpolation::Hermite);
        let is_rival = |other: &usize| {
            is_in_time(other)
                && self.loops[*other].0.draws_ahead()
                && self.rank(*other).0 == self.rank(index).0
        };
        let why = (draws_between && smooth.iter().any(is_rival)).then_some(NOT_AHEAD);
        Ok(AdvisedLoop { index, why })
    }

    /// Returns the reasons why no loop is recommended within this latency, clause by clause. `name` names a loop.
    pub fn reasons(
        &self,
        none: NoLoop,
        latency_ms: f64,
        name: fn(&PolicyCard) -> &str,
    ) -> Vec<String> {
        let of_all = |what: &str| vec![format!("in every loop with a fixed tick {what}")];
        let (late, uneven) = match none {
            NoLoop::TooFewFrames => {
                return vec!["fewer than two frames were displayed, too few to measure".into()];
            }
            NoLoop::NoFixedTick => {
                return vec!["without a fixed tick the physics varies with the rate".into()];
            }
            NoLoop::OtherSpeed => return of_all("the speed depends on the frame rate"),
            NoLoop::MotionLost => return of_all("the motion is lost"),
            NoLoop::Flutter => {
                return of_all(
                    "a clock that rounds decides between no tick and two, since ticks are as frequent as refreshes",
                );
            }
            NoLoop::Unfit { late, uneven } => (late, uneven),
        };
        let first =
            format!("no loop with a fixed tick is smooth within {} ms", round(latency_ms, 3));
        let late = late.map(|index| {
            let ms = self.latency_ms(index).unwrap_or(f64::INFINITY);
            format!("{} is smooth and {} ms late", name(self.loops[index].0), round(ms, 3))
        });
        let uneven = uneven.map(|index| {
            let (card, report) = self.loops[index];
            let verdict = LoopVerdict::of(card, report, self.tick_hz);
            let is_in_time = self.latency_ms(index).is_some_and(|ms| ms <= latency_ms + ALIKE_MS);
            let within = if is_in_time { "in time " } else { "" };
            format!("{within}{} is the smoothest: {verdict}", name(card))
        });
        [Some(first), late, uneven].into_iter().flatten().collect()
    }

    fn is_smooth(&self, index: usize) -> bool {
        let (card, report) = self.loops[index];
        LoopVerdict::of(card, report, self.tick_hz).severity == Severity::Fine
    }

    /// Returns the sort key of a loop. The smallest key is the best.
    fn rank(&self, index: usize) -> (f64, bool, f64) {
        let (card, report) = self.loops[index];
        let steps = |value: Option<f64>, step: f64| {
            value
                .filter(|value| !value.is_nan())
                .map_or(f64::INFINITY, |value| (value / step).round())
        };
        let error = steps(report.animation_error_rms_ms, ALIKE_MS);
        (error, card.draws_ahead(), steps(report.position_error_rms, AS_NEAR))
    }
}
