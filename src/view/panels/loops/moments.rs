//! What moment each loop shows when: a staircase, because a display holds a frame until the next.

use std::sync::Arc;

use egui::text::{LayoutJob, TextFormat};
use egui::{
    Color32, FontId, Galley, Painter, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2, pos2, vec2,
};

use super::ShownLane;
use super::counts::BELOW;
use crate::lab::LoopLab;
use crate::lab::loop_lab::{LoopFrame, LoopLane};
use crate::lab::number::round;
use crate::view::chart::{self, AxisScale, LineStyle, PlotArea, curves};
use crate::view::panels::{ink, strong_font};
use crate::view::theme::Ink;

/// The number of the display's frames that are shown.
const FRAMES: f64 = 12.0;
/// Where a lane is further off, in lengths of the plot, it is off the plot.
const FURTHEST: f64 = 1.0;
/// The range ends at multiples of this, in milliseconds, so that it seldom changes.
const RANGE_STEP_MS: f64 = 20.0;
/// Room for the names of the axes and the numbers at the left, in points.
const NAMES: f32 = 16.0;
const LEFT: f32 = 44.0;
/// The length of the mark of a tick or a frame, in points.
const MARK: f32 = 6.0;
/// The radii of the dots of neighbours, which may lie on each other.
const DOTS: [f32; 2] = [2.6, 4.4];
/// Between the name of an axis and that of its marks, in points.
const APART: f32 = 14.0;

/// The length of the plot in milliseconds.
fn length_ms(loops: &LoopLab) -> f64 {
    FRAMES * 1000.0 / loops.traces()[loops.trace()].refresh().hz()
}

/// The frames of a lane in the plot, from the one that is held at its left edge to the present one.
fn frames<'a>(loops: &LoopLab, lane: &'a LoopLane) -> &'a [LoopFrame] {
    let Some(present) = lane.frame_at(loops.now_ns()) else { return &[] };
    let from_ns = loops.now_ns() - (length_ms(loops) * 1e6) as i64;
    &lane.frames()[lane.frame_at(from_ns).unwrap_or(0)..=present]
}

/// How far a lane is off the plot, in words, if it is.
pub(super) fn off_the_plot(loops: &LoopLab, lane: &LoopLane) -> Option<String> {
    let frame = &lane.frames()[lane.frame_at(loops.now_ns())?];
    let late_ms = loops.late_ms(frame);
    let is_off = late_ms.abs() > FURTHEST * length_ms(loops);
    let side = if late_ms > 0.0 { "behind" } else { "ahead" };
    is_off.then(|| format!("{} s {side}", round(late_ms.abs() / 1000.0, 2)))
}

/// The range of moments shown, in milliseconds from now, for frames that are so late.
fn range_ms(length_ms: f64, late_ms: impl Iterator<Item = f64>) -> [f64; 2] {
    let on_plot = late_ms.filter(|late| late.abs() <= FURTHEST * length_ms);
    let [behind, ahead] = on_plot
        .fold([0.0; 2], |[behind, ahead]: [f64; 2], late| [behind.max(late), ahead.max(-late)]);
    // Rounding is no reason for more room.
    let up = |ms: f64| ((ms - 1e-6) / RANGE_STEP_MS).ceil().max(0.0) * RANGE_STEP_MS;
    [-length_ms - up(behind), up(ahead)]
}

pub(super) fn show(ui: &mut Ui, loops: &LoopLab, lanes: &[ShownLane<'_>], size: Vec2) {
    let (room, response) = ui.allocate_exact_size(size, Sense::hover());
    let ink = ink(ui);
    let rect =
        Rect::from_min_max(room.min + vec2(LEFT, NAMES + 2.0), room.max - vec2(6.0, BELOW + NAMES));
    if !rect.is_positive() {
        return;
    }
    let length_ms = length_ms(loops);
    let late = lanes.iter().flat_map(|lane| frames(loops, lane.lane)).map(LoopFrame::latency_ms);
    let bounds = [[-length_ms, 0.0], range_ms(length_ms, late)];
    let area = PlotArea { rect, bounds };
    let painter = ui.painter_at(room.expand(1.0));
    painter.rect_filled(rect, 0.0, ink.plot);
    let numbers = [0, 1].map(|axis| area.marks(axis, AxisScale::Linear, [56.0, 26.0][axis]));
    chart::paint(&painter, &chart::axes(&area, numbers, ink, room.right()));
    let ticks = format!("{} Hz ticks", loops.scene().tick_hz);
    let words = named(&painter, ink, "moment shown, ms from now", (ticks, ink.accent));
    painter.galley(pos2(rect.left(), room.top()), words, ink.dim);
    let hz = round(loops.traces()[loops.trace()].refresh().hz(), 4);
    let frames = (format!("{hz} Hz frames"), ink.text);
    let words = named(&painter, ink, "displayed, ms from now", frames);
    let half = words.size().x / 2.0;
    let middle = rect.center().x.min(rect.right() - half);
    painter.galley(pos2(middle - half, room.bottom() - words.size().y), words, ink.dim);

    marks(&painter, loops, &area, ink);
    let inner = painter.with_clip_rect(rect);
    let ideal = [[-length_ms; 2], [0.0; 2]].map(|at| area.at(at));
    inner.line_segment(ideal, Stroke::new(1.4, ink.exact));
    // The selected lane in front.
    let (front, others): (Vec<_>, Vec<_>) =
        lanes.iter().enumerate().partition(|(_, lane)| lane.is_selected);
    for (i, lane) in others.into_iter().chain(front) {
        staircase(&inner, loops, &area, lane, DOTS[i % 2]);
    }
    hover(&painter, loops, lanes, &area, response, ink);
}

/// The staircase of a lane.
fn staircase(
    painter: &Painter,
    loops: &LoopLab,
    area: &PlotArea,
    lane: &ShownLane<'_>,
    radius: f32,
) {
    let frames = frames(loops, lane.lane);
    let now_ms = loops.now_ns() as f64 / 1e6;
    let at = |displayed_ns: i64, frame: &LoopFrame| {
        area.at([displayed_ns as f64 / 1e6 - now_ms, frame.shown_ms - now_ms])
    };
    let mut points: Vec<Pos2> = Vec::new();
    for (i, frame) in frames.iter().enumerate() {
        let until_ns = frames.get(i + 1).map_or(loops.now_ns(), |next| next.displayed_ns);
        points.extend([at(frame.displayed_ns, frame), at(until_ns, frame)]);
    }
    let width = if lane.is_selected { 2.4 } else { 1.8 };
    let style = LineStyle { dash: lane.dash, ..LineStyle::solid(lane.colour, width) };
    curves::paint(painter, &points, &[], style);
    for frame in frames {
        let at = at(frame.displayed_ns, frame);
        if radius > DOTS[0] {
            painter.circle_stroke(at, radius, Stroke::new(1.4, lane.colour));
        } else {
            painter.circle_filled(at, radius, lane.colour);
        }
    }
}

/// Marks of the fixed ticks along the top and of the frames along the bottom.
fn marks(painter: &Painter, loops: &LoopLab, area: &PlotArea, ink: &Ink) {
    let (rect, now_ms) = (area.rect, loops.now_ns() as f64 / 1e6);
    let tick_hz = loops.scene().tick_hz;
    let tick_ms = 1000.0 / f64::from(tick_hz);
    let from_ms = (now_ms + area.bounds[0][0]).max(0.0);
    let first = (from_ms / tick_ms).ceil() as u64;
    let mut tick = first;
    while tick as f64 * tick_ms <= now_ms {
        let x = area.at([tick as f64 * tick_ms - now_ms, 0.0]).x;
        painter.vline(x, rect.top()..=rect.top() + MARK, Stroke::new(1.6, ink.accent));
        tick += 1;
    }
    for frame in frames(loops, &loops.lanes()[loops.selected()]) {
        let x = area.at([frame.displayed_ns as f64 / 1e6 - now_ms, 0.0]).x;
        if rect.x_range().contains(x) {
            painter.vline(x, rect.bottom() - MARK..=rect.bottom(), Stroke::new(1.2, ink.text));
        }
    }
}

/// The name of an axis, and behind it what the marks along it are.
fn named(
    painter: &Painter,
    ink: &Ink,
    axis: &str,
    (marks, colour): (String, Color32),
) -> Arc<Galley> {
    let format = |colour| TextFormat::simple(FontId::proportional(11.5), colour);
    let mut job = LayoutJob::single_section(axis.into(), format(ink.dim));
    job.append(&marks, APART, format(colour));
    painter.layout_job(job)
}

/// A line under the pointer, and what each lane shows there.
fn hover(
    painter: &Painter,
    loops: &LoopLab,
    lanes: &[ShownLane<'_>],
    area: &PlotArea,
    response: Response,
    ink: &'static Ink,
) {
    response.widget_info(|| {
        egui::WidgetInfo::labeled(
            egui::Role::Image,
            true,
            "moments shown against moments of display",
        )
    });
    let Some(pointer) = response.hover_pos().filter(|at| area.rect.contains(*at)) else { return };
    painter.vline(pointer.x, area.rect.y_range(), Stroke::new(1.0, ink.accent));
    let at_ns = loops.now_ns() + (area.point(pointer)[0] * 1e6) as i64;
    response.on_hover_ui_at_pointer(|ui| {
        let when = format!("At {:.1} ms the display shows", at_ns as f64 / 1e6);
        ui.label(egui::RichText::new(when).font(strong_font(12.5)));
        for lane in lanes {
            let frames = lane.lane.frames();
            let Some(frame) = lane.lane.frame_at(at_ns).map(|place| &frames[place]) else {
                continue;
            };
            let late_ms = at_ns as f64 / 1e6 - frame.shown_ms;
            let side = if late_ms < 0.0 { "ahead" } else { "behind" };
            let name = lane.lane.card().name;
            let words = format!("{name}: {:.1} ms, {:.1} ms {side}", frame.shown_ms, late_ms.abs());
            ui.label(egui::RichText::new(words).color(lane.colour));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_has_every_lane_that_is_near_and_none_that_has_run_away() {
        assert_eq!(range_ms(100.0, [0.0, 16.7].into_iter()), [-120.0, 0.0]);
        assert_eq!(range_ms(100.0, [-3.0, 21.0].into_iter()), [-140.0, 20.0]);
        assert_eq!(range_ms(100.0, [-3000.0, 5000.0].into_iter()), [-100.0, 0.0]);
    }
}
