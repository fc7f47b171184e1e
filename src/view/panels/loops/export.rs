//! The instrument as text.

use std::iter;

use crate::loops::loop_lab::LoopLab;
use crate::run::csv_row;
use crate::studio::Studio;

/// All frames of the loops on the stage, or the last frames of the window's own loop, as comma-separated text.
pub(in crate::view::panels) fn csv(studio: &Studio) -> Vec<String> {
    match studio.loop_lab() {
        Some(loops) => of_lab(loops),
        None => of_window(studio),
    }
}

fn of_lab(loops: &LoopLab) -> Vec<String> {
    let lanes = loops.on_stage().iter().map(|&index| &loops.lanes()[index]);
    let frames = lanes.flat_map(|lane| {
        lane.frames().iter().enumerate().map(move |(number, frame)| {
            let displayed_ms = frame.displayed_ns as f64 / 1e6;
            csv_row(&[
                &lane.card().id,
                &number,
                &displayed_ms,
                &frame.shown_ms,
                &frame.ticks,
                &frame.animation_error_ms,
            ])
        })
    });
    let head = "loop,frame,displayed_ms,shown_ms,ticks,animation_error_ms\n".to_owned();
    iter::once(head).chain(frames).collect()
}

fn of_window(studio: &Studio) -> Vec<String> {
    let frames = studio.viewer().live.frames().enumerate().map(|(number, frame)| {
        let time_ms = frame.duration_ns as f64 / 1e6;
        csv_row(&[&number, &time_ms, &frame.ticks, &frame.dropped, &frame.animation_error_ms])
    });
    let head = "frame,frame_time_ms,ticks,dropped,animation_error_ms\n".to_owned();
    iter::once(head).chain(frames).collect()
}
