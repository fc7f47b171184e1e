//! The plots: the value of every lane over the exact curve, and one instrument below it.
//!
//! Axes follow the truth and the lanes near it. A lane beyond them is cut off at the edge, where an
//! arrow in its colour says so.

use egui::{ComboBox, FontId, Label, RichText, Sense, Ui, Vec2, vec2};
use egui_plot::PlotBounds;

use super::axes::{AxisText, MARKS_APART, axes, units};
use super::tracks::{self, Look, Track};
use super::{QUIET, advice, colour, ranges};
use crate::lab::picture::palette;
use crate::lab::{
    Command, Instrument, Lab, LaneBody, METRICS, Mode, Scale, TruthCurve, TruthSample,
};
use crate::view::curves::{Curve, Dots};
use crate::view::plot::{CURVE, SwitchMark, draw};
use crate::view::ticks;

/// A lane this many times further out than the truth no longer stretches the axes; and where it is alone,
/// squeezes nothing but the truth, and is looked at for how it grows.
const HEALTHY: f64 = 1.6;
const HEALTHY_ALONE: f64 = 4.0;
/// Room for the half of a number under the right end of an axis, in points.
const RIGHT: f32 = 14.0;
/// Said where every error is zero, which has no logarithm.
const NO_ERROR: &str = "No error: every method shown is on the exact curve to the last bit.";
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
    let (width, height) = ((ui.available_width() - RIGHT).max(10.0), ui.available_height());
    if height >= ROOM_FOR_BOTH {
        ui.horizontal(|ui| {
            body_choice(ui, lab, commands);
            ui.add_space(6.0);
            ui.add(Label::new(quiet(title(body(lab)))).truncate());
        });
        value(ui, lab, vec2(width, height * 0.5 - 26.0));
        ui.horizontal_wrapped(|ui| instrument_choice(ui, lab, ROOM_FOR_TABS, commands));
    } else {
        ui.horizontal(|ui| {
            body_choice(ui, lab, commands);
            instrument_choice(ui, lab, ROOM_FOR_ONE_ROW, commands);
        });
    }
    let room = vec2(width, (ui.available_height() - 2.0).max(10.0));
    match lab.display().instrument {
        Instrument::Metric(index) => metric(ui, lab, room, index),
        Instrument::Phase => phase(ui, lab, room),
        Instrument::Advice => advice::show(ui, lab, commands),
    }
}

/// What the plot of the value shows, of this body's truth.
fn title(truth: &LaneBody) -> String {
    let (name, unit) = (truth.coordinates[0].name, truth.coordinates[0].unit);
    match truth.halted() {
        Some(_) => format!("{name} ({unit}), no truth"),
        None => format!("{name} ({unit}), {} in white", truth.truth_in_words()),
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
        for (command, name) in options {
            if ui.selectable_label(*command == chosen, *name).clicked() {
                commands.push(command.clone());
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

fn truth(lab: &Lab) -> &TruthCurve {
    &lab.past().truth_curves()[lab.display().body]
}

/// The exact curve as far as the present, to be drawn over the lanes.
fn white(lab: &Lab, since_s: f64, place: impl Fn(&TruthSample) -> [f64; 2]) -> Curve {
    let samples = truth(lab).samples().skip_while(|sample| sample.t < since_s);
    Curve {
        colour: colour(palette::TRUTH),
        width: TRUTH_CURVE,
        dash: [1.0, 0.0],
        dots: Dots::None,
        points: samples.map(place).collect(),
        swept: Vec::new(),
    }
}

fn value(ui: &mut Ui, lab: &Lab, room: Vec2) {
    let lanes = Track::of_coordinate(lab);
    let swept = || truth(lab).samples().map(|sample| sample.swept.ends());
    let y = ranges::around_truth(swept().flatten(), &lanes, 1, healthy(lab));
    let bounds = over_time(lab, y);
    let look = Look { width: UNDER_TRUTH, dots: Dots::SparseAlongX, bounded: [false, true] };
    let mut drawing = tracks::drawing(lab, &lanes, &bounds, look);
    let exact = white(lab, f64::NEG_INFINITY, |s| [s.t, s.q]);
    drawing.truth = Some(Curve { swept: swept().collect(), ..exact });
    let unit = body(lab).coordinates[0].unit;
    draw(ui, axes("value", room, units(["s", unit])), bounds, &drawing);
}

fn metric(ui: &mut Ui, lab: &Lab, room: Vec2, index: usize) {
    let metric = &METRICS[index];
    let unit = metric.unit.on(&body(lab).coordinates[0]);
    let lanes = Track::of(lab, |s| {
        let value = s.metrics[index];
        [s.t, if metric.scale == Scale::Log { libm::log10(value) } else { value }]
    });
    if lanes.iter().all(Track::is_empty) {
        let has_values = lab
            .plotted()
            .any(|(_, history)| history.samples().any(|sample| sample.metrics[index].is_finite()));
        return nothing(ui, room, if has_values { NO_ERROR } else { metric.absent });
    }
    let look = Look { width: CURVE, dots: Dots::SparseAlongX, bounded: [false, true] };
    let y = match (metric.scale, &*unit) {
        (Scale::Log, _) => {
            let size = truth(lab).samples().map(|s| s.q.abs().max(s.v.abs()));
            ranges::of_decades(&lanes, size.fold(0.0, f64::max))
        }
        (Scale::Linear, "%") => ranges::of_shares(&lanes),
        (Scale::Linear, _) => ranges::from_zero(&lanes),
    };
    let bounds = over_time(lab, y);
    let drawing = tracks::drawing(lab, &lanes, &bounds, look);
    let plot = axes(metric.id, room, units(["s", &unit]));
    let plot = match metric.scale {
        Scale::Log => plot
            .y_grid_spacer(|input| ticks::decades(input, MARKS_APART[1]))
            .y_axis_formatter(|mark, _| ticks::decade_label(mark, &unit)),
        Scale::Linear => plot,
    };
    draw(ui, plot, bounds, &drawing);
}

fn phase(ui: &mut Ui, lab: &Lab, room: Vec2) {
    let mut lanes = Track::of(lab, |s| [s.q, s.v]);
    lanes.iter_mut().for_each(|lane| lane.keep_latest(PHASE_SAMPLES));
    // As much of the truth as of the lanes that still move.
    let newest = lanes.iter().filter_map(Track::times).max_by(|a, b| a.1.total_cmp(&b.1));
    let exact = white(lab, newest.map_or(f64::NEG_INFINITY, |(first, _)| first), |s| [s.q, s.v]);
    let [x, y] = [0, 1].map(|axis| {
        let truth = exact.points.iter().map(|point| point[axis]);
        ranges::around_truth(truth, &lanes, axis, healthy(lab))
    });
    let bounds = PlotBounds::from_min_max([x.0, y.0], [x.1, y.1]);
    let look = Look { width: UNDER_TRUTH, dots: Dots::Sparse, bounded: [true; 2] };
    let mut drawing = tracks::drawing(lab, &lanes, &bounds, look);
    drawing.switch_mark = SwitchMark::Ring;
    drawing.truth = Some(exact);
    let coordinate = &body(lab).coordinates[0];
    let text =
        |letter: &str, unit: String| AxisText { name: format!("{letter} in {unit}"), unit: "" };
    let along = text(coordinate.name, coordinate.unit.into());
    let up = text(coordinate.velocity, format!("{}/s", coordinate.unit));
    let plot = axes("phase", room, [along, up]);
    draw(ui, plot, bounds, &drawing);
}

/// Says why a plot has nothing to show, in its place.
fn nothing(ui: &mut Ui, room: Vec2, why: &str) {
    let (rect, _) = ui.allocate_exact_size(room, Sense::hover());
    let words = quiet(why.to_owned());
    ui.put(rect.shrink2(vec2(0.1 * rect.width(), 0.0)), Label::new(words).wrap());
}

fn quiet(text: String) -> RichText {
    RichText::new(text).color(QUIET)
}

fn body(lab: &Lab) -> &LaneBody {
    &lab.race().truth().bodies()[lab.display().body]
}

/// How many times further out than the truth a lane still stretches the axes.
fn healthy(lab: &Lab) -> f64 {
    match lab.mode() {
        Mode::Solo => HEALTHY_ALONE,
        Mode::Race => HEALTHY,
    }
}

/// The window of time in view, and the given range of values.
fn over_time(lab: &Lab, (low, high): (f64, f64)) -> PlotBounds {
    let span = lab.scene().seconds;
    let now = lab.race().t();
    PlotBounds::from_min_max([(now - span).max(0.0), low], [now.max(span), high])
}

#[cfg(test)]
mod tests {
    use egui::{Context, Pos2, RawInput, Rect, Shape, pos2};

    use super::*;
    use crate::lab::{SCENES, Scene};
    use crate::view::panels;

    /// Every text that can be seen in a frame of this size, with its place.
    fn texts(lab: &Lab, size: Vec2) -> Vec<(Rect, String)> {
        let context = Context::default();
        panels::dress(&context);
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, size));
        let input = RawInput { screen_rect, ..RawInput::default() };
        let mut output = context.run_ui(input, |ui| drop(panels::show(ui, lab)));
        output.textures_delta.clear();
        let mut texts = Vec::new();
        for clipped in output.shapes {
            collect(&clipped.shape, clipped.clip_rect, &mut texts);
        }
        texts
    }

    fn collect(shape: &Shape, clip: Rect, texts: &mut Vec<(Rect, String)>) {
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, clip, texts)),
            Shape::Text(text) => {
                let rect = text.visual_bounding_rect();
                if clip.expand(0.5).contains_rect(rect) {
                    texts.push((rect, text.galley.text().to_owned()));
                }
            }
            _ => {}
        }
    }

    /// The number of a mark on an axis and its unit.
    fn mark(text: &str) -> Option<(&str, &str)> {
        let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
        number
            .trim_start_matches('\u{2212}')
            .starts_with(|c: char| c.is_ascii_digit())
            .then_some((number, unit))
    }

    /// That both axes of the plot in `room` are marked.
    fn assert_marked(texts: &[(Rect, String)], room: Rect, units: [&str; 2], what: &str) {
        let here = texts.iter().filter(|(rect, _)| room.contains(rect.center()));
        let marks: Vec<(Pos2, (&str, &str))> =
            here.filter_map(|(rect, text)| Some((rect.center(), mark(text)?))).collect();
        let lowest = marks.iter().map(|(at, _)| at.y).fold(f32::MIN, f32::max);
        let (along, up): (Vec<_>, Vec<_>) =
            marks.into_iter().partition(|(at, _)| at.y > lowest - 3.0);
        for (mut axis, unit, name) in [(along, units[0], "along"), (up, units[1], "up")] {
            assert!(axis.len() >= 3, "{what}, {name}: {axis:?}");
            assert!(axis.iter().all(|(_, (_, of))| *of == unit), "{what}, {name}: {axis:?}");
            let numbers = axis.len();
            axis.sort_by_key(|(_, mark)| *mark);
            axis.dedup_by_key(|(_, mark)| *mark);
            assert_eq!(axis.len(), numbers, "{what}, {name}: {axis:?}");
        }
    }

    fn assert_legible(lab: &Lab, what: &str) {
        const SIZE: Vec2 = vec2(1280.0, 720.0);
        let texts = texts(lab, SIZE);
        let place =
            |wanted: &str| texts.iter().find(|(_, text)| text == wanted).map(|(rect, _)| *rect);
        let tabs = place(Instrument::Advice.name()).expect("the last tab");
        let title = texts.iter().find(|(_, text)| text.contains(" in white")).expect("a title").0;
        let timeline = place("Timeline").expect("the timeline's name");
        let left = (1.0 - panels::INSTRUMENTS) * SIZE.x;
        let room = |top: Rect, bottom: Rect| {
            Rect::from_min_max(pos2(left, top.max.y), pos2(SIZE.x, bottom.min.y))
        };
        let coordinate = &body(lab).coordinates[0];
        assert_marked(&texts, room(title, tabs), ["s", coordinate.unit], what);
        // The name stands beside the track, and the panel begins above both.
        let lower = room(tabs, timeline.translate(vec2(0.0, -8.0)));
        let within = |text: &str| {
            let mut here = texts.iter().filter(|(rect, _)| lower.contains(rect.center()));
            here.any(|(_, shown)| shown == text)
        };
        match lab.display().instrument {
            Instrument::Metric(index) if within(METRICS[index].absent) || within(NO_ERROR) => {}
            Instrument::Metric(index) => {
                assert_marked(&texts, lower, ["s", &METRICS[index].unit.on(coordinate)], what);
            }
            Instrument::Phase => {
                assert_marked(&texts, lower, ["", ""], what);
                let (unit, velocity) = (coordinate.unit, coordinate.velocity);
                assert!(within(&format!("{} in {unit}", coordinate.name)), "{what}");
                assert!(within(&format!("{velocity} in {unit}/s")), "{what}");
            }
            Instrument::Advice => {
                let mut here = texts.iter().filter(|(rect, _)| lower.contains(rect.center()));
                assert!(here.any(|(_, text)| text.len() > 10), "{what}: {texts:?}");
            }
        }
    }

    #[test]
    fn a_truth_that_halted_is_not_said_to_be_in_white() {
        let text = "title = 'x'\ntick_hz = 60\nseconds = 1\nmethods = ['rk4']\n\
                    [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\nkick_n_s = 1e15\n";
        let mut lab = Lab::new(Scene::parse("kicked.toml", text).unwrap());
        let says = |lab: &Lab, title: &str| {
            texts(lab, vec2(1280.0, 720.0)).iter().any(|(_, text)| text == title)
        };
        assert!(says(&lab, "x (m), exact in white"));
        lab.apply(Command::Kick(1e30));
        assert!(says(&lab, "x (m), no truth"));
    }

    #[test]
    fn every_axis_of_every_instrument_has_three_marks_and_no_instrument_is_an_empty_box() {
        for scene in SCENES {
            let mut lab = Lab::new(Scene::built_in(scene.name).unwrap());
            for mode in ["solo", "race"] {
                for seconds in [0, 3] {
                    for _ in 0..60 * seconds {
                        lab.advance(16_666_667);
                    }
                    for instrument in Instrument::all() {
                        lab.apply(Command::Instrument(instrument));
                        for index in 0..lab.scene().bodies.len() {
                            lab.apply(Command::Body(index));
                            let name = instrument.name();
                            let scene = scene.name;
                            let what = format!("{scene}, {mode}, {name}, {index}, {seconds} s");
                            assert_legible(&lab, &what);
                        }
                    }
                }
                lab.apply(Command::ToggleRace);
            }
        }
    }
}
