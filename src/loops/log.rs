//! The loop that a log shows: a column with the moment of each picture, replayed beside the loops.

use std::sync::Arc;

use super::engines::ENGINES;
use super::pacer::Pacer;
use super::policies::POLICIES;
use super::policy::{Build, PolicyCard};
use super::time_base::TimeBase;
use super::trace::FrameTrace;
use crate::sim::TickRate;
use crate::sim::number::significant;
use crate::table::median;

/// Id of the row of a log.
pub const LOG: &str = "log";
/// Units of a column of times per second, and the largest part by which the clock of such a column is fast or slow.
const UNITS: [(f64, &str); 4] = [(1.0, "s"), (1e3, "ms"), (1e6, "µs"), (1e9, "ns")];
const CLOCK_OFF: f64 = 0.25;
/// Frames of a window over which the speed of a column is fitted.
const WINDOW: usize = 60;
/// Two differences from a log are equal within this, in milliseconds.
const ALIKE_MS: f64 = 1e-4;
/// Tick rates at which an ideal loop may resemble a log, in Hz.
const RATES: [u32; 6] = [30, 50, 60, 64, 100, 120];

/// The moments that a log shows.
pub struct ShownLog {
    /// The card of the replay.
    pub card: Arc<PolicyCard>,
    /// How the column was taken, in words.
    pub taken: String,
    moments_ms: Arc<[f64]>,
}

/// The loop that comes nearest to a log.
pub struct NearestLoop {
    /// Card of the loop.
    pub card: &'static Arc<PolicyCard>,
    /// Its tick rate, if it has ticks.
    pub tick_hz: Option<TickRate>,
    /// RMS difference of the moments shown, up to a constant, in milliseconds.
    pub rms_ms: f64,
}

impl ShownLog {
    /// Takes the column of a trace that shows moments, or positions that move at `speed` per second. Without a speed, a
    /// column that keeps pace with the frames is a clock in a known unit, and another one moves at its mean speed.
    /// Returns `None` without such a column.
    pub fn of(trace: &FrameTrace, speed: Option<f64>) -> Option<Self> {
        let values = trace.shown();
        values.first()?;
        let began: Vec<f64> = began_ms(trace);
        let last_frame = values.len().min(began.len()) - 1;
        let slope =
            |from: usize, to: usize| 1e3 * (values[to] - values[from]) / (began[to] - began[from]);
        // The median of the mean speeds of windows is free of hitches.
        let windows = (0..last_frame.saturating_sub(WINDOW)).map(|from| slope(from, from + WINDOW));
        let windows: Vec<f64> = windows.filter(|speed| speed.is_finite()).collect();
        let mean = median(&windows).unwrap_or_else(|| slope(0, last_frame));
        let unit = UNITS.iter().find(|(unit, _)| (mean / unit - 1.0).abs() <= CLOCK_OFF);
        let (per_s, taken) = match (speed, unit) {
            (Some(speed), _) => (speed, format!("shown at {} a second", significant(speed, 6))),
            (None, Some((unit, name))) => (*unit, format!("shown is a clock in {name}")),
            (None, None) => {
                (mean, format!("shown moves at {} a second, as fitted", significant(mean, 6)))
            }
        };
        let moments_ms: Arc<[f64]> = values.iter().map(|value| 1e3 * value / per_s).collect();
        let card = Arc::new(PolicyCard {
            id: LOG.into(),
            name: "The log".into(),
            formula: "the moment that the log shows".into(),
            odd_frames: "as the log".into(),
            users: "the game of the log".into(),
            source: "a column of the log".into(),
            build: Build::Replay(moments_ms.clone()),
            is_usual: false,
            ..PolicyCard::clone(&POLICIES[0])
        });
        Some(Self { card, taken, moments_ms })
    }

    /// Returns the loop whose moments differ least from those of the log, up to a constant.
    pub fn nearest(&self, trace: &FrameTrace, tick_hz: TickRate) -> Option<NearestLoop> {
        let rates = || {
            [tick_hz]
                .into_iter()
                .chain(RATES.map(TickRate::from).into_iter().filter(move |hz| *hz != tick_hz))
        };
        let ideal = POLICIES.iter().flat_map(|card| {
            let has_rate = card.has_fixed_tick || card.has_max_ticks;
            rates()
                .take(if has_rate { RATES.len() + 1 } else { 1 })
                .map(move |hz| (card, Some(hz).filter(|_| has_rate)))
        });
        let engines = ENGINES.iter().map(|card| (card, None));
        let candidates = ideal.chain(engines).map(|(card, hz)| {
            let base = TimeBase::new(hz.unwrap_or(tick_hz), trace.refresh());
            let (rms_ms, own_hz) = self.difference_ms(trace, card, base);
            NearestLoop { card, tick_hz: hz.or(own_hz), rms_ms }
        });
        let candidates: Vec<_> = candidates.filter(|it| it.rms_ms.is_finite()).collect();
        let least_ms = candidates.iter().map(|it| it.rms_ms).reduce(f64::min)?;
        candidates.into_iter().find(|it| it.rms_ms <= least_ms + ALIKE_MS)
    }

    /// Returns the RMS difference of a loop's moments from those of the log, without their mean. Beside it is the tick
    /// rate of an engine with fixed ticks.
    fn difference_ms(
        &self,
        trace: &FrameTrace,
        card: &Arc<PolicyCard>,
        base: TimeBase,
    ) -> (f64, Option<TickRate>) {
        let mut pacer = Pacer::new(card, base);
        let mut frames = trace.frames();
        let (mut before_ns, mut off) = (trace.lead_ns().map(|lead_ns| -lead_ns), Vec::new());
        if trace.lead_ns().is_some() && card.is_from_outside() {
            pacer.frame_in_ms(0, 0.0);
        }
        for shown_ms in &*self.moments_ms {
            let Some(frame) = frames.next(0) else { break };
            let ms = frames.duration_ms(frame);
            if before_ns.is_some() || card.is_from_outside() {
                pacer.frame_in_ms(frame.began_ns - before_ns.unwrap_or(frame.began_ns), ms);
            }
            before_ns = Some(frame.began_ns);
            off.push(base.milliseconds(pacer.drawn_moment()) - shown_ms);
        }
        let count = off.len() as f64;
        let mean = off.iter().sum::<f64>() / count;
        let squares: f64 = off.iter().map(|off| (off - mean) * (off - mean)).sum();
        let hz = 1e3 / base.milliseconds(pacer.tick());
        let own = (card.is_from_outside() && card.has_fixed_tick)
            .then(|| format!("{}", hz.round()).parse().ok());
        ((squares / count).sqrt(), own.flatten())
    }
}

/// Returns when each frame began, in milliseconds.
fn began_ms(trace: &FrameTrace) -> Vec<f64> {
    let mut frames = trace.frames();
    std::iter::from_fn(|| frames.next(0)).map(|frame| frame.began_ns as f64 / 1e6).collect()
}
