//! The window's own loop, with the duration of its last frames and the number of ticks in each.

use egui::{Color32, Label, Rect, RichText, Sense, Ui, Vec2, vec2};

use super::counts::{self, LEFT, Series};
use super::errors::round_up;
use super::table::metric_text;
use crate::chart::{self, Arrow, AxisScale, Curve, Drawing, LineStyle, PlotArea, Primitive};
use crate::panels::breakpoints;
use crate::run::Unit;
use crate::studio::{LiveFrame, Pace, Studio};
use crate::theme::{PanelPalette, colour, palette, strong_font};

pub(super) const TITLE: &str = "This window's own loop";
/// The length of the plot in seconds.
const LENGTH_S: f64 = 10.0;
/// Height of the plot, relative to the frame time that 99 in 100 frames do not exceed.
const REACH: f64 = 1.6;
/// Share of the height for the histogram.
const COUNTS: f32 = 0.4;

/// Statistics of the durations of frames, in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Summary {
    mean_ms: f64,
    /// Duration that 99 in 100 frames do not exceed.
    usual_ms: f64,
    worst_ms: f64,
    error_rms_ms: f64,
}

impl Summary {
    /// Computes the statistics, or returns `None` if there are no frames.
    fn of<'a>(frames: impl ExactSizeIterator<Item = &'a LiveFrame> + Clone) -> Option<Self> {
        let count = frames.len();
        let mut times: Vec<f64> = frames.clone().map(time_ms).collect();
        times.sort_by(f64::total_cmp);
        let worst_ms = *times.last()?;
        let squares =
            frames.map(|frame| frame.animation_error_ms * frame.animation_error_ms).sum::<f64>();
        Some(Self {
            mean_ms: times.iter().sum::<f64>() / count as f64,
            usual_ms: times[(99 * count).div_ceil(100) - 1],
            worst_ms,
            error_rms_ms: (squares / count as f64).sqrt(),
        })
    }
}

fn own_colour(palette: &PanelPalette) -> Color32 {
    colour(palette.theme.evaluation(1))
}

fn time_ms(frame: &LiveFrame) -> f64 {
    frame.duration_ns as f64 / 1e6
}

pub(super) fn show(ui: &mut Ui, studio: &Studio, room: Vec2) {
    let top = ui.cursor().top();
    if let Some(Pace::Measured { frames_per_second, real_time_factor }) = studio.viewer.pace {
        let pace =
            format!("{frames_per_second:.0} frames per second, {real_time_factor:.2}× real time");
        ui.label(RichText::new(pace).color(palette(ui).text));
    }
    let frames = studio.viewer.live.frames();
    ui.label(RichText::new(TITLE).font(strong_font(15.0)).color(palette(ui).text));
    let Some(summary) = Summary::of(frames) else {
        let words = "No frame yet: run it with Space, and its frames show here. \
                     L opens the loop lab, where one motion runs in many loops.";
        ui.add(Label::new(RichText::new(words).color(palette(ui).dim)).wrap());
        return;
    };
    let Summary { mean_ms, usual_ms, worst_ms, error_rms_ms } = summary;
    let [mean, usual, worst] =
        [mean_ms, usual_ms, worst_ms].map(|time_ms| metric_text(time_ms, Unit::Milliseconds));
    let times = format!("Frame time: mean {mean}, 99 % within {usual}, worst {worst}.");
    let (lost, colour) = match studio.deck.dropped_ticks() {
        0 => ("No tick dropped since the start.".into(), palette(ui).dim),
        1 => ("1 tick dropped since the start.".into(), palette(ui).bad),
        many => (format!("{many} ticks dropped since the start."), palette(ui).bad),
    };
    ui.add(Label::new(RichText::new(times).color(palette(ui).dim)).wrap());
    let lost = ui.add(Label::new(RichText::new(lost).color(colour)).wrap());
    lost.on_hover_text("the simulation fell behind real time");
    let error = format!("Animation error {} RMS.", metric_text(error_rms_ms, Unit::Milliseconds));
    let error = ui.add(Label::new(RichText::new(error).color(palette(ui).dim)).wrap());
    error.on_hover_text(
        "change of the moment shown minus change of real time; a frame counts as displayed when it begins",
    );
    let height = (top + room.y - ui.cursor().top()).max(50.0);
    let (room, response) = ui.allocate_exact_size(vec2(room.x, height), Sense::hover());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Image, true, "frame times of this window")
    });
    let (upper, below) = parts(room);
    chart::paint(&ui.painter_at(upper), &frame_times(studio, upper, &summary, palette(ui)));
    if let Some(below) = below {
        counts::show(ui, below, &[series(studio, palette(ui))]);
    }
}

/// Lays out the charts in a room for a file. Returns `None` before the first frame.
pub(super) fn layout(
    studio: &Studio,
    room: Rect,
    palette: &PanelPalette,
) -> Option<Vec<Primitive>> {
    let summary = Summary::of(studio.viewer.live.frames())?;
    let (upper, below) = parts(room);
    let mut all = frame_times(studio, upper, &summary, palette);
    all.extend(
        below
            .into_iter()
            .flat_map(|below| counts::layout(below, &[series(studio, palette)], palette)),
    );
    Some(all)
}

/// Returns the rectangle of the frame times, and that of a histogram if `room` is high enough.
fn parts(room: Rect) -> (Rect, Option<Rect>) {
    if room.height() < breakpoints::HISTOGRAM {
        return (room, None);
    }
    let (upper, below) = room.split_top_bottom_at_fraction(1.0 - COUNTS);
    (upper, Some(below.with_min_y(below.top() + 6.0)))
}

fn series(studio: &Studio, palette: &PanelPalette) -> Series {
    Series::new(own_colour(palette), studio.viewer.live.frames().map(|frame| frame.ticks))
}

/// Lays out the chart of the frame times over real time, up to the last frame.
fn frame_times(
    studio: &Studio,
    room: Rect,
    summary: &Summary,
    palette: &PanelPalette,
) -> Vec<Primitive> {
    let rect = chart::inside(room, LEFT, 6.0);
    if !rect.is_positive() {
        return Vec::new();
    }
    let reach = round_up((REACH * summary.usual_ms).max(1.0));
    let area = PlotArea { rect, bounds: [[-LENGTH_S, 0.0], [0.0, reach]] };
    let marks = [0, 1].map(|axis| area.marks(axis, AxisScale::Linear, [56.0, 24.0][axis]));
    let mut all = vec![Primitive::Area(rect, palette.plot)];
    let times_ms = studio.viewer.live.frames().map(time_ms);
    let mut ago_s = times_ms.clone().sum::<f64>() / 1000.0;
    let moment = |time_ms: f64| {
        ago_s -= time_ms / 1000.0;
        [-ago_s, time_ms]
    };
    let points: Vec<[f64; 2]> = times_ms.map(moment).collect();
    let beyond = points.iter().filter(|[at_s, time_ms]| *at_s >= -LENGTH_S && *time_ms > reach);
    let arrows = beyond.map(|&at| Arrow { from: at, to: at, colour: palette.warn }).collect();
    let mean = LineStyle { dash: [6.0, 4.0], ..LineStyle::solid(palette.accent, 1.0) };
    let curves = vec![
        Curve::new(LineStyle::solid(own_colour(palette), 1.2), points),
        Curve::new(mean, [-LENGTH_S, 0.0].map(|at_s| [at_s, summary.mean_ms]).into()),
    ];
    let drawing = Drawing { curves, arrows, ..Drawing::default() };
    all.extend(chart::plot(&area, marks, &drawing, palette, room.right()));
    let names = ["seconds before now", "frame time, ms"];
    all.extend(chart::names(&area, rect.left(), names, palette).map(Into::into));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_summary_has_the_mean_the_usual_and_the_worst_frame() {
        let frame = |ms: i64| LiveFrame {
            duration_ns: ms * 1_000_000,
            ticks: 1,
            dropped: u64::from(ms > 50),
            animation_error_ms: 3.0,
        };
        let mut frames = vec![frame(10); 99];
        frames.push(frame(110));
        let summary = Summary::of(frames.iter()).unwrap();
        let expected =
            Summary { mean_ms: 11.0, usual_ms: 10.0, worst_ms: 110.0, error_rms_ms: 3.0 };
        assert_eq!(summary, expected);
        assert_eq!(Summary::of([].iter()), None);
    }
}
