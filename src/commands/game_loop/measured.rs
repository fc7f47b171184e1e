//! A loop measured over a trace.

use std::{io, iter};

use serde_json::{Value, json};

use crate::commands::output::Output;
use crate::commands::output::table::RowWriter;
use crate::loops::{
    FrameLimits, FrameRecord, FrameTrace, LoopRun, PacingReport, PolicyCard, RefreshRate,
};
use crate::scene::{LaneSpec, Scene};
use crate::sim::TickRate;

/// How many frames the picture of a run shows, and how many of them are before a long one.
const DRAWN: usize = 30;
const BEFORE: usize = 8;
/// A frame is long from this number of refreshes on.
const LONG: f64 = 2.5;
/// The most frames that are searched for a long one.
const MAX_SEARCHED: usize = 100_000;

/// A row of the table.
pub(super) struct Measured {
    pub(super) card: &'static PolicyCard,
    pub(super) trace: String,
    pub(super) refresh: RefreshRate,
    pub(super) tick_hz: TickRate,
    /// Whether frames begin and are displayed by one clock. In the logs of tools they do not.
    pub(super) has_one_clock: bool,
    /// What to say of a log that has no times of display.
    pub(super) missing_display: Option<&'static str>,
    pub(super) report: PacingReport,
    /// The moments of display and the moments shown of the frames that are drawn, in milliseconds.
    pub(super) drawn: Vec<[f64; 2]>,
}

/// What of a trace is measured.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    /// Where it ends.
    pub(super) until_ns: i64,
    /// From where on frames are kept for a picture, if there is to be one.
    pub(super) drawn_from_ns: Option<i64>,
}

/// Measures a policy on a trace until `stop` says so, and writes a row for each frame to `frames`.
pub(super) fn measure(
    scene: &Scene,
    spec: LaneSpec,
    (card, limits): (&'static PolicyCard, FrameLimits),
    trace: &FrameTrace,
    Stretch { until_ns, drawn_from_ns }: Stretch,
    stop: &dyn Fn() -> bool,
    mut frames: Option<&mut RowWriter<Output>>,
) -> io::Result<Measured> {
    let (mut drawn, mut written) = (Vec::new(), Ok(()));
    let name = trace.name();
    let run = LoopRun::limited(scene, spec, card, trace, limits);
    let report = run.measure(until_ns, stop, |run, record| {
        if let Some(displayed_ns) = record.frame.displayed_ns
            && drawn_from_ns.is_some_and(|from_ns| displayed_ns >= from_ns)
            && drawn.len() <= DRAWN
        {
            drawn.push([displayed_ns as f64 / 1e6, record.shown_ms]);
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
    })
}

/// The row of a frame.
fn row(trace: &str, card: &PolicyCard, run: &LoopRun, record: &FrameRecord) -> [Value; 9] {
    let ms = |ns: i64| ns as f64 / 1e6;
    let FrameRecord { number, frame, shown_ms, steps, dropped_ms, .. } = record;
    [
        json!(trace),
        json!(card.id),
        json!(number),
        json!(ms(frame.began_ns)),
        json!(frame.displayed_ns.map(ms)),
        json!(shown_ms),
        json!(steps.count),
        json!(dropped_ms),
        json!(run.lane().drawn(0)[0]),
    ]
}

/// When the frames that are drawn begin to be displayed: at the start, or shortly before the longest frame if one is long.
pub(super) fn drawn_from_ns(trace: &FrameTrace, until_ns: i64) -> i64 {
    let mut frames = trace.frames();
    let displayed: Vec<i64> = iter::from_fn(|| frames.next(0))
        .take_while(|frame| frame.began_ns < until_ns)
        .take(MAX_SEARCHED)
        .filter_map(|frame| frame.displayed_ns)
        .collect();
    let gaps = displayed.windows(2).map(|pair| pair[1] - pair[0]).enumerate();
    let refresh_ns = 1e9 / trace.refresh().hz();
    let long = gaps.filter(|(_, gap)| *gap as f64 > LONG * refresh_ns);
    // The first of those that are as long.
    let longest = long.min_by_key(|(_, gap)| -gap);
    longest.map_or(0, |(index, _)| displayed[index.saturating_sub(BEFORE)])
}
