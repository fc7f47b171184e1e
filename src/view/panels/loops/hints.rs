//! What to try next in the loop lab.

use crate::lab::loop_lab::LoopLab;
use crate::lab::number::round;
use crate::lab::pacing::POLICIES;

/// The raw loop, and the one that draws between ticks.
const RAW: &str = "fixed";
const SMOOTH: &str = "fixed-linear";
/// The trace in which frames and ticks nearly coincide.
const EDGE: &str = "edge";
/// A share of repeated frames that is worth a word, in percent.
const MANY_PERCENT: f64 = 1.0;

/// What is to be seen, and what to do next. Keys stand between backticks.
pub(in crate::view::panels) fn parts(loops: &LoopLab) -> [String; 2] {
    let index = |id: &str| POLICIES.iter().position(|card| card.id == id).unwrap_or_default();
    let hz = |trace: usize| round(loops.traces()[trace].refresh().hz(), 4);
    let next = (loops.trace() + 1) % loops.traces().len();
    let (raw, smooth) = (index(RAW), index(SMOOTH));
    let is_new = loops.selected() == raw;
    if is_new && loops.traces()[loops.trace()].name() == EDGE {
        let next = hz(next);
        return [
            "Raw ticks flip between none and two a frame".into(),
            format!("press `D` for a {next} Hz display."),
        ];
    }
    let repeated = loops.lanes()[raw].report().and_then(|report| report.repeated_percent);
    let repeated = repeated.unwrap_or_default();
    if is_new && repeated > MANY_PERCENT {
        let (hz, percent) = (hz(loops.trace()), round(repeated, 2));
        let key = (smooth + 1) % 10;
        return [
            format!("At {hz} Hz, {percent} % of raw frames repeat the one before"),
            format!("press `{key}` to draw between ticks."),
        ];
    }
    [
        "The same motion in different loops".into(),
        "`D`: the next display, `1` … `9`: a loop, `L`: leave.".into(),
    ]
}
