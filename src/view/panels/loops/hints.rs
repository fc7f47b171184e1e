//! Hints on the next step in the loop lab.

use crate::loops::loop_lab::{LoopLab, RAW};
use crate::loops::{NoLoop, POLICIES};
use crate::stage::number::round;

/// Id of the loop that interpolates between ticks.
const SMOOTH: &str = "fixed-linear";
/// Id of the trace in which frames and ticks nearly coincide.
const EDGE: &str = "edge";
/// Minimum share of frames that gives a hint, in percent.
const MANY_PERCENT: f64 = 1.0;
/// Two shares of frames count as alike if they differ by less than this factor.
const MUCH_MORE: f64 = 2.0;

/// Returns the parts of the hint, the most important first. A part is an observation or the next step, and has its keys
/// between backticks.
pub(in crate::panels) fn parts(loops: &LoopLab) -> Vec<String> {
    if let Some((none, mut reasons)) = loops.none_advised() {
        reasons[0].insert_str(0, "None is recommended: ");
        if none == NoLoop::MotionLost {
            reasons.push("`]` raises the tick rate, `M` changes the method.".into());
        }
        return reasons;
    }
    let index = |id: &str| POLICIES.iter().position(|card| card.id == id).unwrap_or_default();
    let hz = |trace: usize| round(loops.traces()[trace].refresh().hz(), 4);
    let next = (loops.trace() + 1) % loops.traces().len();
    let (raw, smooth) = (index(RAW), index(SMOOTH));
    let is_new = loops.selected() == raw;
    let many = |percent: Option<f64>| percent.filter(|percent| *percent > MANY_PERCENT);
    let report = loops.lanes()[raw].report().filter(|_| is_new);
    let doubled = report.and_then(|report| many(report.double_percent));
    let repeated = report.and_then(|report| many(report.repeated_percent));
    // Frames without a tick are about as frequent as those with two. In other traces most frames have no tick.
    let flips = doubled.zip(repeated).is_some_and(|(two, none)| none < MUCH_MORE * two);
    if flips && loops.chosen_trace().name() == EDGE {
        let next = hz(next);
        return vec![
            "Raw ticks flip between none and two a frame".into(),
            format!("press `D` for a {next} Hz display."),
        ];
    }
    if let Some(repeated) = repeated {
        let (hz, percent) = (hz(loops.trace()), round(repeated, 2));
        let key = (smooth + 1) % 10;
        return vec![
            format!("At {hz} Hz, {percent} % of raw frames repeat the one before"),
            format!("press `{key}` to draw between ticks."),
        ];
    }
    vec![
        "The same motion under different loops".into(),
        "`D` next display · `1` … `9`, `0` a loop · `L` leave".into(),
    ]
}
