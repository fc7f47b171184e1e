//! The instrument as text.

use crate::lab::{Lab, LoopLab};

/// All frames of the loops on the stage, or the last frames of the window's own loop, as comma-separated text.
pub(in crate::view::panels) fn csv(lab: &Lab) -> Vec<String> {
    match lab.loop_lab() {
        Some(loops) => of_lab(loops),
        None => of_window(lab),
    }
}

fn of_lab(loops: &LoopLab) -> Vec<String> {
    let mut lines = vec!["loop,frame,displayed_ms,shown_ms,ticks,animation_error_ms\n".to_owned()];
    for lane in loops.on_stage().iter().map(|&place| &loops.lanes()[place]) {
        for (number, frame) in lane.frames().iter().enumerate() {
            let (id, displayed_ms) = (lane.card().id, frame.displayed_ns as f64 / 1e6);
            let (shown_ms, ticks) = (frame.shown_ms, frame.ticks);
            let error_ms = frame.animation_error_ms;
            lines.push(format!("{id},{number},{displayed_ms},{shown_ms},{ticks},{error_ms}\n"));
        }
    }
    lines
}

fn of_window(lab: &Lab) -> Vec<String> {
    let mut lines = vec!["frame,frame_time_ms,ticks,dropped,animation_error_ms\n".to_owned()];
    for (number, frame) in lab.viewer().live.frames().enumerate() {
        let time_ms = frame.duration_ns as f64 / 1e6;
        let (ticks, dropped, error_ms) = (frame.ticks, frame.dropped, frame.animation_error_ms);
        lines.push(format!("{number},{time_ms},{ticks},{dropped},{error_ms}\n"));
    }
    lines
}
