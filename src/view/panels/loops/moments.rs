//! The moment that each loop shows over time. The curve is a staircase, because a display holds each frame until the
//! next.

use std::iter;

use egui::{Align2, Color32, Painter, Pos2, Rect, Response, Sense, Stroke, Ui, pos2, vec2};

use super::counts::BELOW;
use super::row::Row;
use crate::chart::{self, AxisScale, LineStyle, NUMBER, PlotArea, Primitive, ScreenCurve, Text};
use crate::loops::loop_lab::{LoopFrame, LoopLab, LoopLane};
use crate::panels::table::TableRow;
use crate::stage::number::round;
use crate::theme::{PanelPalette, palette, strong_font};

/// Number of the display's refreshes that the plot shows.
const FRAMES: f64 = 12.0;
/// Maximum distance of a lane that is still on the plot, relative to the plot's length.
const MAX_OFF: f64 = 1.0;
/// The range ends at a multiple of this step, in milliseconds, so that the range seldom changes.
const RANGE_STEP_MS: f64 = 20.0;
/// Height of the names of the axes, and width of the numbers at the left, in points.
const NAMES: f32 = 16.0;
const LEFT: f32 = 44.0;
/// Length of the mark of a tick or a frame, in points.
const MARK: f32 = 6.0;
/// Radii of the dots of neighbouring lanes. They differ because the dots may coincide.
const DOTS: [f32; 2] = [2.6, 4.4];

/// Number of ticks that the plot shows at low tick rates, and the maximum of its length for them, in milliseconds.
const TICKS: f64 = 2.0;
const MAX_LENGTH_MS: f64 = 2000.0;

/// Returns the length of the plot in milliseconds. A loop is behind by one or two ticks, and has to be on the plot.
fn length_ms(loops: &LoopLab) -> f64 {
    let frames_ms = FRAMES * 1000.0 / loops.chosen_trace().refresh().hz();
    let ticks_ms = TICKS * 1000.0 / f64::from(loops.scene().tick_hz);
    frames_ms.max(ticks_ms.min(MAX_LENGTH_MS))
}

/// Returns the frames of a lane in the plot, from the frame that was on display at the plot's left edge to the present
/// one.
fn frames<'a>(loops: &LoopLab, lane: &'a LoopLane) -> &'a [LoopFrame] {
    let Some(present) = lane.frame_at(loops.now_ns()) else { return &[] };
    let from_ns = loops.now_ns() - (length_ms(loops) * 1e6) as i64;
    &lane.frames()[lane.frame_at(from_ns).unwrap_or(0)..=present]
}

/// Describes how far a lane is off the plot, if it is.
pub(super) fn off_the_plot(loops: &LoopLab, lane: &LoopLane) -> Option<String> {
    let frame = &lane.frames()[lane.frame_at(loops.now_ns())?];
    let late_ms = loops.late_ms(frame);
    let is_off = late_ms.abs() > MAX_OFF * length_ms(loops);
    let side = if late_ms > 0.0 { "behind" } else { "ahead" };
    is_off.then(|| format!("{} s {side}", round(late_ms.abs() / 1000.0, 2)))
}

/// Returns the range of the plotted moments, in milliseconds from now, for frames whose moments are late by `late_ms`.
fn range_ms(length_ms: f64, late_ms: impl Iterator<Item = f64>) -> [f64; 2] {
    let on_plot = late_ms.filter(|late| late.abs() <= MAX_OFF * length_ms);
    let [behind, ahead] = on_plot
        .fold([0.0; 2], |[behind, ahead]: [f64; 2], late| [behind.max(late), ahead.max(-late)]);
    // A rounding error must not extend the range.
    let up = |ms: f64| ((ms - 1e-6) / RANGE_STEP_MS).ceil().max(0.0) * RANGE_STEP_MS;
    [-length_ms - up(behind), up(ahead)]
}

/// Shows the chart of the moments, and the moments of all lanes under the pointer.
pub(super) fn show(ui: &Ui, room: Rect, loops: &LoopLab, lanes: &[Row<'_>]) {
    let Some(area) = area(room, loops, lanes) else { return };
    let painter = ui.painter_at(room.expand(1.0));
    chart::paint(&painter, &layout(room, &area, loops, lanes, palette(ui)));
    let response = ui.interact(room, ui.scope_id().with("moments"), Sense::hover());
    hover(&painter, loops, lanes, &area, response, palette(ui));
}

/// Returns the area of the moments, or `None` if the room is too small.
pub(super) fn area(room: Rect, loops: &LoopLab, lanes: &[Row<'_>]) -> Option<PlotArea> {
    let rect =
        Rect::from_min_max(room.min + vec2(LEFT, NAMES + 2.0), room.max - vec2(6.0, BELOW + NAMES));
    let length_ms = length_ms(loops);
    let late = lanes.iter().flat_map(|row| frames(loops, row.lane())).map(LoopFrame::latency_ms);
    let bounds = [[-length_ms, 0.0], range_ms(length_ms, late)];
    rect.is_positive().then_some(PlotArea { rect, bounds })
}

/// Lays out the chart of the moments: its axes with marks of ticks and frames, and a staircase for each lane.
pub(super) fn layout(
    room: Rect,
    area: &PlotArea,
    loops: &LoopLab,
    lanes: &[Row<'_>],
    palette: &PanelPalette,
) -> Vec<Primitive> {
    let rect = area.rect;
    let mut all = vec![Primitive::Area(rect, palette.plot)];
    let numbers = [0, 1].map(|axis| area.marks(axis, AxisScale::Linear, [56.0, 26.0][axis]));
    all.extend(chart::axes(area, numbers, palette, room.right()));
    // The name of an axis is followed by the meaning of the marks along the axis.
    let name = |at: Pos2, anchor: Align2, name: &str, marks: (String, Color32)| Text {
        tail: Some(marks),
        ..Text::new(at, anchor, name, NUMBER, palette.dim)
    };
    let ticks = (format!("{:.3} Hz ticks", loops.scene().tick_hz), palette.accent);
    let above = pos2(rect.left(), room.top());
    let upright = name(above, Align2::LEFT_TOP, "moment shown, ms from now", ticks);
    all.push(Text { right: room.right(), ..upright }.into());
    let hz = round(loops.chosen_trace().refresh().hz(), 4);
    let frames = (format!("{hz} Hz frames"), palette.text);
    let below = pos2(rect.center().x, room.bottom());
    let along = name(below, Align2::CENTER_BOTTOM, "displayed, ms from now", frames);
    all.push(Text { right: rect.right(), ..along }.into());
    all.extend(marks(loops, area, palette));
    let ideal = [area.bounds[0][0], 0.0].map(|at_ms| area.at([at_ms; 2]));
    let mut inside = vec![Primitive::Line(ideal, Stroke::new(1.4, palette.exact))];
    // The selected lane lies in front.
    let (front, others): (Vec<_>, Vec<_>) =
        lanes.iter().enumerate().partition(|(_, row)| row.is_selected());
    for (i, row) in others.into_iter().chain(front) {
        inside.extend(staircase(area, row, DOTS[i % 2], palette));
    }
    all.push(Primitive::Clip(rect, inside));
    all
}

fn staircase(
    area: &PlotArea,
    row: &Row<'_>,
    radius: f32,
    palette: &PanelPalette,
) -> Vec<Primitive> {
    let (loops, (colour, dash)) = (row.loops, row.style(palette));
    let frames = frames(loops, row.lane());
    let now_ms = loops.now_ns() as f64 / 1e6;
    let at = |displayed_ns: i64, frame: &LoopFrame| {
        area.at([displayed_ns as f64 / 1e6 - now_ms, frame.shown_ms - now_ms])
    };
    let mut points: Vec<Pos2> = Vec::new();
    for (i, frame) in frames.iter().enumerate() {
        let until_ns = frames.get(i + 1).map_or(loops.now_ns(), |next| next.displayed_ns);
        points.extend([at(frame.displayed_ns, frame), at(until_ns, frame)]);
    }
    let width = if row.is_selected() { 2.4 } else { 1.8 };
    let style = LineStyle { dash, ..LineStyle::solid(colour, width) };
    let line = Primitive::Curves(vec![ScreenCurve::new(style, points)]);
    let dot = |frame: &LoopFrame| match at(frame.displayed_ns, frame) {
        at if radius > DOTS[0] => Primitive::Ring(at, radius, Stroke::new(1.4, colour)),
        at => Primitive::Dot(at, radius, colour),
    };
    iter::once(line).chain(frames.iter().map(dot)).collect()
}

/// Returns the marks of the fixed ticks along the top, and those of the frames along the bottom.
fn marks(loops: &LoopLab, area: &PlotArea, palette: &PanelPalette) -> Vec<Primitive> {
    let (rect, now_ms) = (area.rect, loops.now_ns() as f64 / 1e6);
    let mark = |at_ms: f64, [from, to]: [f32; 2], stroke: (f32, Color32)| {
        let x = area.at([at_ms - now_ms, 0.0]).x;
        Primitive::Line([pos2(x, from), pos2(x, to)], stroke.into())
    };
    let tick_ms = 1000.0 / f64::from(loops.scene().tick_hz);
    let first = ((now_ms + area.bounds[0][0]).max(0.0) / tick_ms).ceil() as u64;
    let ticks = (first..).map(|tick| tick as f64 * tick_ms).take_while(|at_ms| *at_ms <= now_ms);
    let top = [rect.top(), rect.top() + MARK];
    let ticks = ticks.map(|at_ms| mark(at_ms, top, (1.6, palette.accent)));
    let shown = frames(loops, &loops.lanes()[loops.selected()]).iter();
    let shown = shown.map(|frame| frame.displayed_ns as f64 / 1e6);
    let in_view = shown.filter(|at_ms| at_ms - now_ms >= area.bounds[0][0]);
    let bottom = [rect.bottom() - MARK, rect.bottom()];
    ticks.chain(in_view.map(|at_ms| mark(at_ms, bottom, (1.2, palette.text)))).collect()
}

/// Draws a line under the pointer, and the moment that each lane shows there.
fn hover(
    painter: &Painter,
    loops: &LoopLab,
    lanes: &[Row<'_>],
    area: &PlotArea,
    response: Response,
    palette: &'static PanelPalette,
) {
    response.widget_info(|| {
        egui::WidgetInfo::labeled(
            egui::Role::Image,
            true,
            "moments shown against moments of display",
        )
    });
    let Some(pointer) = response.hover_pos().filter(|at| area.rect.contains(*at)) else { return };
    painter.vline(pointer.x, area.rect.y_range(), Stroke::new(1.0, palette.accent));
    let at_ns = loops.now_ns() + (area.point(pointer)[0] * 1e6) as i64;
    response.on_hover_ui_at_pointer(|ui| {
        let when = format!("At {:.1} ms the display shows", at_ns as f64 / 1e6);
        ui.label(egui::RichText::new(when).font(strong_font(12.5)));
        for row in lanes {
            let frame = row.lane().frame_at(at_ns).map(|index| &row.lane().frames()[index]);
            let Some(frame) = frame else { continue };
            let late_ms = at_ns as f64 / 1e6 - frame.shown_ms;
            let side = if late_ms < 0.0 { "ahead" } else { "behind" };
            let words = [frame.shown_ms, late_ms.abs()].map(|ms| format!("{ms:.1} ms"));
            let words = format!("{}: {}, {} {side}", row.name(), words[0], words[1]);
            ui.label(egui::RichText::new(words).color(row.style(palette).0));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loops::loop_lab::LoopCommand;
    use crate::scene::Scene;
    use crate::stage::TickRate;
    use crate::studio::{Command, Studio, open_loop_lab_on, run_loops};

    #[test]
    fn the_loops_of_a_ship_at_two_ticks_per_second_are_on_the_plot() {
        let mut studio = Studio::new(Scene::built_in("ship").unwrap());
        open_loop_lab_on(&mut studio, "edge");
        run_loops(&mut studio);
        studio.apply(Command::Loop(LoopCommand::Seek(3_000_000_000)));
        let loops = studio.loop_lab().unwrap();
        assert_eq!(loops.scene().tick_hz, TickRate::from(2));
        for &place in loops.on_stage() {
            let lane = &loops.lanes()[place];
            assert_eq!(off_the_plot(loops, lane), None, "{}", lane.card().name);
        }
    }

    #[test]
    fn the_range_covers_nearby_lanes_but_no_runaway() {
        assert_eq!(range_ms(100.0, [0.0, 16.7].into_iter()), [-120.0, 0.0]);
        assert_eq!(range_ms(100.0, [-3.0, 21.0].into_iter()), [-140.0, 20.0]);
        assert_eq!(range_ms(100.0, [-3000.0, 5000.0].into_iter()), [-100.0, 0.0]);
    }
}
