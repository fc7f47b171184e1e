//! A spring that swings while its numbers change: the same step exactly and at two tick rates, with its curves.

use egui::{Align2, Color32, Rect, RichText, Sense, Slider, Ui, WidgetInfo, pos2, vec2};

use crate::chart::{
    self, AxisScale, Curve, Dots, Drawing, LineStyle, NUMBER, PlotArea, Primitive, Text,
};
use crate::scene::TickRate;
use crate::studio::{Command, MySpring, SpringField, StepResponse, StepResponses};
use crate::theme::{PanelPalette, colour, palette};

/// Height of the line of a mass, and half the side of a mass, in points.
const TRACK: f32 = 37.0;
const HALF: f32 = 9.0;
/// Width of the numbers beside the curves, in points.
const LEFT: f32 = 30.0;
/// Width of this part, and height of all but its curves, in points.
pub(super) const WIDTH: f32 = 276.0;
pub(super) const BESIDES_CURVES: f32 = 156.0;
/// Time for which the masses rest before they are let go again, in seconds.
const PAUSE_S: f64 = 0.6;
/// Damping ratio at the end of the slider.
const MOST_RATIO: f64 = 1.5;
/// Lowest and highest place that is always in view.
const VIEW: [f64; 2] = [-0.05, 1.15];
const MOST: f64 = 2.2;

/// Shows the spring's answer to a step, with curves of this height in points, and a slider for its damping ratio.
pub(super) fn show(
    ui: &mut Ui,
    spring: MySpring,
    tick_hz: TickRate,
    curves: f32,
    commands: &mut Vec<Command>,
) {
    let Some(seen) = spring.step_responses(tick_hz) else { return };
    let now_s = ui.input(|input| input.time) % (seen.seconds + PAUSE_S);
    ui.set_width(WIDTH);
    let palette = palette(ui);
    ui.label(RichText::new("one step under semi-implicit Euler").color(palette.dim));
    let (rect, response) =
        ui.allocate_exact_size(vec2(WIDTH, 2.0 * TRACK + curves), Sense::hover());
    let told = seen.at_rates.each_ref().map(|(hz, it)| format!("{hz:.3} Hz {}", it.in_words()));
    let told = format!("One step of the spring: {}", told.join(", "));
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &told));
    chart::paint(&ui.painter_at(rect), &layout(rect, &seen, now_s.min(seen.seconds), palette));
    let [_, field] = SpringField::motion_fields(spring);
    let mut ratio = field.value;
    let name = "damping ratio";
    ui.horizontal(|ui| {
        ui.label(name);
        ui.spacing_mut().slider_width = ui.available_width() - HALF;
        let slider = Slider::new(&mut ratio, 0.0..=MOST_RATIO.max(field.value)).show_value(false);
        let slid = ui.add(slider);
        slid.widget_info(|| WidgetInfo::slider(true, field.value, name));
    });
    if ratio != field.value {
        commands.extend((field.set)(ratio).ok().map(Command::View));
    }
    ui.request_repaint();
}

/// Lays out a line with a mass for each tick rate, and the curves of all at this moment.
fn layout(rect: Rect, seen: &StepResponses, now_s: f64, palette: &PanelPalette) -> Vec<Primitive> {
    let furthest = seen.at_rates.iter().flat_map(|(_, it)| &it.places);
    let [low, high] = furthest.fold(VIEW, |[low, high], place| {
        [low.min(place.max(1.0 - MOST)), high.max(1.05 * place.min(MOST))]
    });
    let mut all = Vec::new();
    let mut curves = Vec::new();
    for (row, (rate, response)) in seen.at_rates.iter().enumerate() {
        let style = colour(palette.theme.loop_style(2 * row).0);
        let track = Rect::from_min_size(rect.min + vec2(0.0, row as f32 * TRACK), vec2(0.0, TRACK));
        let track = track.with_max_x(rect.right()).shrink2(vec2(HALF, 0.0));
        let across = PlotArea { rect: track, bounds: [[low, high], [0.0, 1.0]] };
        all.extend(mass(&across, [response.at(now_s), seen.exact.at(now_s)], style, palette));
        let words = format!("{rate:.3} Hz: {}", response.in_words());
        let at = pos2(rect.left(), track.top());
        all.push(Text::new(at, Align2::LEFT_TOP, words, NUMBER, style).into());
        curves.push(Curve::new(
            LineStyle { dots: Dots::SparseAlongX, ..LineStyle::solid(style, 1.5) },
            points(response),
        ));
    }
    let room = rect.with_min_y(rect.top() + 2.0 * TRACK);
    let area = PlotArea {
        rect: chart::inside(room, LEFT, HALF),
        bounds: [[0.0, seen.seconds], [low, high]],
    };
    let marks = [0, 1].map(|axis| area.marks(axis, AxisScale::Linear, [48.0, 26.0][axis]));
    let truth = vec![Curve::new(LineStyle::solid(palette.exact, 1.5), points(&seen.exact))];
    all.push(Primitive::Area(area.rect, palette.plot));
    all.extend(chart::plot(
        &area,
        marks,
        &Drawing { curves, truth, ..Drawing::default() },
        palette,
        rect.right(),
    ));
    let x = area.at([now_s, 0.0]).x;
    let ends = [pos2(x, area.rect.top()), pos2(x, area.rect.bottom())];
    all.push(Primitive::Line(ends, egui::Stroke::new(1.0, palette.dim)));
    let names = chart::names(&area, rect.left(), ["time, s", "place, in steps"], palette);
    all.extend(names.map(Primitive::from));
    all
}

/// Lays out a mass at one place on its line, with the exact one's outline.
fn mass(
    across: &PlotArea,
    [place, exact]: [f64; 2],
    fill: Color32,
    palette: &PanelPalette,
) -> Vec<Primitive> {
    let foot = across.rect.bottom() - 2.0;
    let side = |place: f64| {
        let x = across.at([place, 0.0]).x;
        Rect::from_min_max(pos2(x - HALF, foot - 2.0 * HALF), pos2(x + HALF, foot))
    };
    let line = [pos2(across.rect.left(), foot), pos2(across.rect.right(), foot)];
    vec![
        Primitive::Line(line, egui::Stroke::new(1.0, palette.line)),
        Primitive::Area(side(place), fill),
        Primitive::Edge(side(exact), egui::Stroke::new(1.5, palette.exact)),
    ]
}

fn points(response: &StepResponse) -> Vec<[f64; 2]> {
    let places = response.places.iter().enumerate();
    places.map(|(step, place)| [step as f64 * response.step_s, *place]).collect()
}
