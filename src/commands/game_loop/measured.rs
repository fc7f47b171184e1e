//! A loop measured over a trace.

use std::fmt::Write;

use crate::commands::output::table::csv_cell;
use crate::lab::pacing::{FrameRecord, FrameTrace, LoopRun, PacingReport, PolicyCard, RefreshRate};
use crate::lab::{LaneSpec, Scene};

/// How many frames the picture of a run shows.
const DRAWN: usize = 30;

/// A row of the table.
pub(super) struct Measured {
    pub(super) card: &'static PolicyCard,
    pub(super) trace: String,
    pub(super) refresh: RefreshRate,
    pub(super) tick_hz: u32,
    pub(super) report: PacingReport,
    /// The moments of display and the moments shown of the first frames, in milliseconds.
    pub(super) first: Vec<[f64; 2]>,
}

/// Measures a policy on a trace until `stop` says so, and writes a line for each frame to `lines`.
pub(super) fn measure(
    scene: &Scene,
    spec: LaneSpec,
    card: &'static PolicyCard,
    trace: &FrameTrace,
    until_ns: i64,
    stop: &dyn Fn() -> bool,
    mut lines: Option<&mut String>,
) -> Measured {
    let mut first = Vec::new();
    let name = csv_cell(trace.name());
    let report = LoopRun::new(scene, spec, card, trace).measure(until_ns, stop, |run, record| {
        if let Some(displayed_ns) = record.frame.displayed_ns.filter(|_| first.len() <= DRAWN) {
            first.push([displayed_ns as f64 / 1e6, record.shown_ms]);
        }
        if let Some(lines) = &mut lines {
            write_frame(lines, &format!("{name},{}", card.id), run, record);
        }
    });
    let (trace, refresh, tick_hz) = (trace.name().to_owned(), trace.refresh(), scene.tick_hz);
    Measured { card, trace, refresh, tick_hz, report, first }
}

fn write_frame(lines: &mut String, of: &str, run: &LoopRun, record: &FrameRecord) {
    let ms = |ns: i64| ns as f64 / 1e6;
    let FrameRecord { number, frame, shown_ms, steps, dropped_ms, .. } = record;
    let displayed = frame.displayed_ns.map(|ns| ms(ns).to_string()).unwrap_or_default();
    let q = run.lane().drawn(0)[0];
    let (began, ticks) = (ms(frame.began_ns), steps.count);
    let written =
        writeln!(lines, "{of},{number},{began},{displayed},{shown_ms},{ticks},{dropped_ms},{q}");
    written.expect("a string takes any text");
}
