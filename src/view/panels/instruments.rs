//! The plots: the value of every lane over the exact curve, and one instrument below it.
//!
//! Axes follow the truth and the lanes near it. A lane beyond them is cut off at the edge, where an
//! arrow in its colour says so.

use egui::{ComboBox, FontId, Label, RichText, Ui};
use egui_plot::PlotBounds;

use super::{QUIET, advice, colour};
use crate::lab::number::superscript;
use crate::lab::picture::palette;
use crate::lab::{Command, History, Instrument, Lab, METRICS, Sample, Scale};
use crate::view::plot::{CURVE, Curve, draw, plot, tick_text};

/// A lane this many times further out than the truth no longer stretches the axes.
const HEALTHY: f64 = 1.6;
/// Errors below this are round-off: the plot's floor, as a power of ten.
const FLOOR: f64 = -17.0;
/// From this width on, in points, bodies and instruments are tabs.
const ROOM_FOR_TABS: f32 = 430.0;
/// And from this width on all instruments fit in one row.
const ROOM_FOR_ONE_ROW: f32 = 620.0;
/// The height of an instrument's name, in points.
const TAB_TEXT: f32 = 11.0;
/// From this height on, in points, both plots can be read; below, the stage has to show the value.
const ROOM_FOR_BOTH: f32 = 200.0;
/// The width in points of the truth's curve, and of a lane's that it is drawn over: a lane that keeps to
/// the truth is seen on both sides of it.
const TRUTH_CURVE: f32 = 1.0;
const UNDER_TRUTH: f32 = 2.4;
/// Samples in a phase portrait: a few turns, and each still to be told from the next.
const PHASE_SAMPLES: usize = 360;

pub(super) fn show(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let height = ui.available_height();
    if height >= ROOM_FOR_BOTH {
        ui.horizontal(|ui| {
            body_choice(ui, lab, commands);
            let truth = &lab.race().truth().bodies()[lab.display().body];
            let (coordinate, words) = (&truth.coordinates[0], truth.truth_in_words());
            let title = format!("{} ({}), {words} in white", coordinate.name, coordinate.unit);
            ui.add_space(6.0);
            ui.add(Label::new(RichText::new(title).color(QUIET)).truncate());
        });
        value(ui, lab, height * 0.5 - 26.0);
        ui.horizontal_wrapped(|ui| instrument_choice(ui, lab, ROOM_FOR_TABS, commands));
    } else {
        ui.horizontal(|ui| {
            body_choice(ui, lab, commands);
            instrument_choice(ui, lab, ROOM_FOR_ONE_ROW, commands);
        });
    }
    let room = (ui.available_height() - 2.0).max(10.0);
    match lab.display().instrument {
        Instrument::Metric(index) => metric(ui, lab, room, index),
        Instrument::Phase => phase(ui, lab, room),
        Instrument::Advice => advice::show(ui, lab, commands),
    }
}

fn body_choice(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let names = lab.scene().bodies.iter().map(|body| body.name.as_str());
    let options: Vec<_> = (0..).map(Command::Body).zip(names).collect();
    let chosen = Command::Body(lab.display().body);
    choice(ui, "body", &options, chosen, ROOM_FOR_TABS, commands);
}

fn instrument_choice(ui: &mut Ui, lab: &Lab, room: f32, commands: &mut Vec<Command>) {
    let option = |instrument: Instrument| (Command::Instrument(instrument), instrument.name());
    let options: Vec<_> = Instrument::all().map(option).collect();
    // Small enough for all of them to stand in one row of a window as it opens.
    ui.spacing_mut().button_padding.x = 2.5;
    ui.style_mut().override_font_id = Some(FontId::proportional(TAB_TEXT));
    let chosen = Command::Instrument(lab.display().instrument);
    choice(ui, "instrument", &options, chosen, room, commands);
}

/// Offers commands by name: as tabs from `room` points on, else as a menu.
fn choice(
    ui: &mut Ui,
    id: &str,
    options: &[(Command, &str)],
    chosen: Command,
    room: f32,
    commands: &mut Vec<Command>,
) {
    let mut offer = |ui: &mut Ui| {
        for &(command, name) in options {
            if ui.selectable_label(command == chosen, name).clicked() {
                commands.push(command);
            }
        }
    };
    if ui.available_width() >= room || options.len() == 1 {
        let spacing = std::mem::replace(&mut ui.spacing_mut().item_spacing.x, 0.0);
        offer(ui);
        ui.spacing_mut().item_spacing.x = spacing;
    } else {
        let name = options.iter().find(|(command, _)| *command == chosen).map(|(_, name)| *name);
        ComboBox::from_id_salt(id).selected_text(name.unwrap_or_default()).show_ui(ui, offer);
    }
}

/// One curve for each lane, of what `y` makes of its samples.
fn curves(
    lab: &Lab,
    width: f32,
    x: impl Fn(&Sample) -> f64,
    y: impl Fn(&Sample) -> f64,
) -> Vec<Curve> {
    let curve = |(entry, history): (usize, &History)| {
        let (rgba, dash) = palette::style(lab.entries()[entry].method);
        let points = history.samples().map(|s| [x(s), y(s)]);
        let points = points.filter(|[x, y]| x.is_finite() && y.is_finite()).collect();
        Curve { colour: colour(rgba), width, dash, dots: 0.0, points }
    };
    lab.plotted().map(curve).collect()
}

/// The curve of the truth, to be drawn over the others.
fn white(points: Vec<[f64; 2]>) -> Curve {
    let colour = colour(palette::TRUTH);
    Curve { colour, width: TRUTH_CURVE, dash: [1.0, 0.0], dots: 0.0, points }
}

fn truth(lab: &Lab) -> &History {
    &lab.race().truth_histories()[lab.display().body]
}

fn value(ui: &mut Ui, lab: &Lab, height: f32) {
    let exact: Vec<[f64; 2]> = truth(lab).samples().map(|s| [s.t, s.q]).collect();
    let mut all = curves(lab, UNDER_TRUTH, |s| s.t, |s| s.q);
    let y = healthy_range(1, &exact, &all);
    all.push(white(exact));
    draw(ui, plot("value", height), bounds(lab, y), &all);
}

fn metric(ui: &mut Ui, lab: &Lab, height: f32, index: usize) {
    let metric = &METRICS[index];
    let body = &lab.race().truth().bodies()[lab.display().body];
    let unit = metric.unit.on(&body.coordinates[0]);
    match metric.scale {
        Scale::Log => {
            let log = |s: &Sample| match s.metrics[index] {
                0.0 => FLOOR,
                value => libm::log10(value).max(FLOOR),
            };
            let lanes = curves(lab, CURVE, |s| s.t, log);
            let y = log_range(lab, &lanes);
            let plot = plot("log metric", height).y_axis_formatter(|mark, _| {
                let exponent = mark.value.round();
                if (mark.value - exponent).abs() > 1e-6 {
                    return String::new();
                }
                format!("10{} {unit}", superscript(exponent as i32))
            });
            draw(ui, plot.y_grid_spacer(decades), bounds(lab, y), &lanes);
        }
        Scale::Linear => {
            let lanes = curves(lab, CURVE, |s| s.t, |s| s.metrics[index]);
            let y = spread(&lanes, 300.0);
            let plot = plot("metric", height);
            let plot =
                plot.y_axis_formatter(move |mark, _| format!("{} {unit}", tick_text(mark.value)));
            draw(ui, plot, bounds(lab, y), &lanes);
        }
    }
}

fn phase(ui: &mut Ui, lab: &Lab, height: f32) {
    let latest =
        |points: Vec<[f64; 2]>| points[points.len().saturating_sub(PHASE_SAMPLES)..].to_vec();
    let exact = latest(truth(lab).samples().map(|s| [s.q, s.v]).collect());
    let mut all = curves(lab, UNDER_TRUTH, |s| s.q, |s| s.v);
    for lane in &mut all {
        lane.points = latest(std::mem::take(&mut lane.points));
    }
    let [x, y] = [0, 1].map(|axis| healthy_range(axis, &exact, &all));
    all.push(white(exact));
    let plot = plot("phase", height).x_axis_formatter(|mark, _| tick_text(mark.value));
    draw(ui, plot, PlotBounds::from_min_max([x.0, y.0], [x.1, y.1]), &all);
}

/// The window of time in view, and the given range of values.
fn bounds(lab: &Lab, (low, high): (f64, f64)) -> PlotBounds {
    let span = lab.scene().seconds;
    let now = lab.race().t();
    PlotBounds::from_min_max([(now - span).max(0.0), low], [now.max(span), high])
}

/// The range of the truth along an axis, stretched to take in what is not far outside it.
fn healthy_range(axis: usize, exact: &[[f64; 2]], lanes: &[Curve]) -> (f64, f64) {
    let along = |point: &[f64; 2]| point[axis];
    let (low, high) = range(exact.iter().map(along)).unwrap_or((-1.0, 1.0));
    let half = ((high - low) / 2.0).max(1e-3 * high.abs()).max(1e-9);
    let middle = (low + high) / 2.0;
    let near = |value: &f64| (value - middle).abs() <= HEALTHY * half;
    let all = lanes.iter().flat_map(|lane| lane.points.iter().map(along)).filter(near);
    let (low, high) = range(all.chain([low, high])).unwrap_or((low, high));
    let pad = 0.12 * (high - low).max(half);
    (low - pad, high + pad)
}

/// The decades that hold the errors, up to ten times the truth's own range: beyond that a lane is lost.
fn log_range(lab: &Lab, lanes: &[Curve]) -> (f64, f64) {
    let size = truth(lab).samples().map(|s| s.q.abs().max(s.v.abs())).fold(1e-300, f64::max);
    let lost = libm::log10(size).ceil() + 1.0;
    let all = lanes.iter().flat_map(|lane| lane.points.iter().map(|p| p[1]));
    let (low, high) = range(all.filter(|&y| y > FLOOR && y <= lost)).unwrap_or((-3.0, 0.0));
    (low.floor() - 0.2, high.ceil().max(low.floor() + 2.0) + 0.2)
}

/// The range of all lanes within `most` of zero.
fn spread(lanes: &[Curve], most: f64) -> (f64, f64) {
    let all = lanes.iter().flat_map(|lane| lane.points.iter().map(|p| p[1]));
    let (low, high) = range(all.filter(|y| y.abs() <= most)).unwrap_or((-1.0, 1.0));
    let pad = 0.08 * (high - low).max(1e-9);
    (low - pad, high + pad)
}

fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, y| {
        let (low, high) = range.unwrap_or((y, y));
        Some((low.min(y), high.max(y)))
    })
}

/// A line for every whole power of ten, or every few where they crowd.
fn decades(input: egui_plot::GridInput) -> Vec<egui_plot::GridMark> {
    let (low, high) = input.bounds;
    let step = ((high - low) / 6.0).ceil().max(1.0);
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    let mark = |i: i64| egui_plot::GridMark { value: i as f64 * step, step_size: step };
    (first..=last).map(mark).collect()
}
