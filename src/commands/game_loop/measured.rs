//! Measurement of a loop over a trace.

use std::{io, iter};

use serde_json::{Value, json};

use crate::commands::output::Output;
use crate::commands::output::table::RowWriter;
use crate::loops::{
    FrameLimits, FrameRecord, FrameTrace, LoopRun, PacingReport, PolicyCard, RefreshRate,
};
use crate::scene::{LaneSpec, Scene};
use crate::sim::TickRate;

/// Number of frames in the picture of a run, and number of frames before a long one.
const DRAWN: usize = 30;
const BEFORE: usize = 8;
/// Real time of the picture of game time, in milliseconds.
const PACED_MS: f64 = 3000.0;
/// Minimum duration of a long frame, in refreshes of the display.
const LONG: f64 = 2.5;
/// Maximum number of frames that are searched for a long one.
const MAX_SEARCHED: usize = 100_000;

/// A row of the table, which is the measurement of a policy.
pub(super) struct Measured {
    pub(super) card: &'static PolicyCard,
    pub(super) trace: String,
    pub(super) refresh: RefreshRate,
    pub(super) tick_hz: TickRate,
    /// Whether one clock times both the start and the display of frames. In the logs of some tools they have two
    /// clocks.
    pub(super) has_one_clock: bool,
    /// A remark on a log that has no times of display.
    pub(super) missing_display: Option<&'static str>,
    pub(super) report: PacingReport,
    /// Moment of display, and displayed moment, of each drawn frame, in milliseconds.
    pub(super) drawn: Vec<[f64; 2]>,
    /// Real time and game time of each frame around the drawn ones, in milliseconds.
    pub(super) paced: Vec<[f64; 2]>,
}

/// The part of a trace that is measured.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    /// Time at which the measurement ends.
    pub(super) until_ns: i64,
    /// Time at which the drawn frames start, if there is a picture.
    pub(super) drawn_from_ns: Option<i64>,
}

/// Measures a policy on a trace, until the end of the measured part or until `stop` returns true. Writes a row for each
/// frame to `frames`.
pub(super) fn measure(
    scene: &Scene,
    spec: LaneSpec,
    (card, limits): (&'static PolicyCard, FrameLimits),
    trace: &FrameTrace,
    Stretch { until_ns, drawn_from_ns }: Stretch,
    stop: &dyn Fn() -> bool,
    mut frames: Option<&mut RowWriter<Output>>,
) -> io::Result<Measured> {
    let (mut drawn, mut paced, mut written) = (Vec::new(), Vec::<[f64; 2]>::new(), Ok(()));
    let name = trace.name();
    let run = LoopRun::limited(scene, spec, card, trace, limits);
    let report = run.measure(until_ns, stop, |run, record| {
        if let Some(displayed_ns) = record.frame.displayed_ns
            && drawn_from_ns.is_some_and(|from_ns| displayed_ns >= from_ns)
            && drawn.len() <= DRAWN
        {
            drawn.push([displayed_ns as f64 / 1e6, record.shown_ms]);
        }
        if drawn_from_ns.is_some_and(|from_ns| record.frame.began_ns >= from_ns)
            && paced.first().is_none_or(|[first, _]| began_ms(record) - first <= PACED_MS)
        {
            let pacer = run.lane().pacer();
            paced.push([began_ms(record), pacer.base().milliseconds(pacer.simulated())]);
        }
        if let (Some(frames), Ok(())) = (&mut frames, &written) {
            written = frames.row(&row(name, card, run, record));
        }
    });
    written?;
    let (trace_name, refresh, tick_hz) = (name.to_owned(), trace.refresh(), scene.tick_hz);
    let (has_one_clock, missing_display) = (trace.has_one_clock(), trace.missing_display());
    Ok(Measured {
        card,
        trace: trace_name,
        refresh,
        tick_hz,
        has_one_clock,
        missing_display,
        report,
        drawn,
        paced,
    })
}

fn began_ms(record: &FrameRecord) -> f64 {
    record.frame.began_ns as f64 / 1e6
}

fn row(trace: &str, card: &PolicyCard, run: &LoopRun, record: &FrameRecord) -> [Value; 12] {
    let ms = |ns: i64| ns as f64 / 1e6;
    let FrameRecord { number, frame, shown_ms, steps, dropped_ms, .. } = record;
    let FrameRecord { step_ms, owed_ms, alpha, .. } = record;
    [
        json!(trace),
        json!(card.id),
        json!(number),
        json!(ms(frame.began_ns)),
        json!(frame.displayed_ns.map(ms)),
        json!(shown_ms),
        json!(steps.returned.unwrap_or(steps.count)),
        json!(dropped_ms),
        json!(run.lane().drawn_coordinates(0)[0]),
        json!(step_ms),
        json!(owed_ms),
        json!(alpha),
    ]
}

/// Returns the display time of the first frame to draw. If a frame is long, it is shortly before the longest one, and
/// otherwise at the start.
pub(super) fn drawn_from_ns(trace: &FrameTrace, until_ns: i64) -> i64 {
    let mut frames = trace.frames();
    let displayed: Vec<i64> = iter::from_fn(|| frames.next(0))
        .take_while(|frame| frame.began_ns < until_ns)
        .take(MAX_SEARCHED)
        .filter_map(|frame| Some(frame.displayed_ns? + trace.lead_ns().unwrap_or_default()))
        .collect();
    let gaps = displayed.windows(2).map(|pair| pair[1] - pair[0]).enumerate();
    let refresh_ns = 1e9 / trace.refresh().hz();
    let long = gaps.filter(|(_, gap)| *gap as f64 > LONG * refresh_ns);
    // The first of several equally long frames counts.
    let longest = long.min_by_key(|(_, gap)| -gap);
    longest.map_or(0, |(index, _)| displayed[index.saturating_sub(BEFORE)])
}
