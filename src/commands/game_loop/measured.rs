//! Measurement of a loop over a trace.

use std::io;
use std::sync::Arc;

use serde_json::{Value, json};

use crate::commands::output::Output;
use crate::commands::output::table::RowWriter;
use crate::loops::{
    Camera, FrameLimits, FrameRecord, FrameTrace, GameTime, LoopRun, PacingReport, PolicyCard,
    RefreshRate,
};
use crate::scene::{LaneSpec, Scene};
use crate::sim::TickRate;

/// Number of frames in the picture of a run.
const DRAWN: usize = 30;

/// A row of the table, which is the measurement of a policy.
pub(super) struct Measured {
    pub(super) card: Arc<PolicyCard>,
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
    /// Game time over real time, if there is a picture.
    pub(super) game_time: Option<GameTime>,
    /// The camera, if one follows the body.
    pub(super) camera: Option<Camera>,
}

/// What is measured of a trace.
#[derive(Clone)]
pub(super) struct Stretch {
    /// Time at which the measurement ends.
    pub(super) until_ns: i64,
    /// The game time before the first frame, if there is a picture.
    pub(super) game_time: Option<GameTime>,
    /// The camera before the first frame, if one follows the body.
    pub(super) camera: Option<Camera>,
}

/// Measures a policy on a trace, until the end of the measured part or until `stop` returns true. Writes a row for each
/// frame to `frames`.
pub(super) fn measure(
    scene: &Scene,
    spec: LaneSpec,
    (card, limits): (Arc<PolicyCard>, FrameLimits),
    trace: &FrameTrace,
    Stretch { until_ns, mut game_time, mut camera }: Stretch,
    stop: &dyn Fn() -> bool,
    mut frames: Option<&mut RowWriter<Output>>,
) -> io::Result<Measured> {
    let (mut drawn, mut written) = (Vec::new(), Ok(()));
    let name = trace.name();
    let run = LoopRun::limited(scene, spec, &card, trace, limits);
    let report = run.measure(until_ns, stop, |run, record| {
        if let Some(game_time) = &mut game_time {
            game_time.frame(run, record);
            if let Some(displayed_ns) = record.frame.displayed_ns
                && displayed_ns >= game_time.from_ns()
                && drawn.len() <= DRAWN
            {
                drawn.push([displayed_ns as f64 / 1e6, record.shown_ms]);
            }
        }
        if let Some(camera) = &mut camera {
            camera.frame(record);
        }
        if let (Some(frames), Ok(())) = (&mut frames, &written) {
            let place = camera.as_ref().map(|camera| json!(camera.place()));
            let cells: Vec<Value> =
                row(name, &card, run, record).into_iter().chain(place).collect();
            written = frames.row(&cells);
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
        game_time,
        camera,
    })
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
