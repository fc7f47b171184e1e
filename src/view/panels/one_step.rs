//! One step: the next tick of the selected method, in the phase plane of the displayed body.

use std::sync::Arc;

use egui::{
    Align2, Color32, FontId, Galley, Grid, Label, Pos2, Rect, RichText, ScrollArea, Sense, Stroke,
    Ui, Vec2, pos2, vec2,
};

use super::annotations::{arrow, label};
use super::breakpoints;
use super::parts::formula;
use crate::chart::{self, AxisScale, Curve, Drawing, LineStyle, PlotArea};
use crate::measure::{OneStep, Slope};
use crate::run::Unit;
use crate::stage::Coordinate;
use crate::stage::number::{round, significant};
use crate::studio::{Studio, one_step, orbit};
use crate::theme::{PanelPalette, TYPE, colour, palette, strong_font};

mod loupe;

/// Width of the numbers at the left of the plot, height of those below it, and height of the name of an axis, in
/// points.
const LEFT: f32 = 62.0;
const BELOW: f32 = 20.0;
const NAME: f32 = 21.0;
/// Minimum width of the instrument for a table beside the plot, and the table's width there, in points.
const ROOM_BESIDE: f32 = 700.0;
const TABLE: f32 = 380.0;
/// Minimum share of the height for the plot if the table is below it, and the plot's minimum height in points.
const PLOT: f32 = 0.42;
const MIN_PLOT: f32 = 108.0;
/// Height of a row of the table, and of a line of the formula, in points.
const ROW: f32 = 20.0;
const FORMULA: f32 = 20.0;
/// Font size of a formula beside numbers, and width of the numbers and the badge, in points.
const BESIDE_NUMBERS: f32 = 14.0;
const NUMBERS: f32 = 185.0;
/// Radius of a state, and of the badge of an evaluation, in points.
const STATE: f32 = 5.0;
const BADGE: f32 = 8.0;
/// Length of the longest slope, relative to the plot's diagonal.
const SLOPE: f32 = 0.13;
/// Opacity of an orbit of constant energy.
const ORBIT: f32 = 0.7;
/// Maximum number of evaluations that are drawn. An implicit or an adaptive method may take hundreds.
const MAX_DRAWN: usize = 12;
/// Margin of the plot on each side, relative to the size of the plot's contents.
const MARGIN: f64 = 0.16;

pub(super) fn show(ui: &mut Ui, studio: &Studio, room: Vec2) {
    let Some(step) = one_step(studio) else {
        let why = "No next step: the body has halted under this method.";
        ui.label(RichText::new(why).color(palette(ui).dim));
        return;
    };
    let top = ui.cursor().top();
    head(ui, &step);
    let height = (top + room.y - ui.cursor().top()).max(60.0);
    if room.x >= ROOM_BESIDE {
        ui.horizontal_top(|ui| {
            plot(ui, studio, &step, vec2(room.x - TABLE, height));
            ui.vertical(|ui| {
                ui.label(lay_out_words(ui, studio, &step, TABLE));
                table(ui, studio, &step, None);
            });
        });
    } else {
        // The words about the step's effect are visible in full. The table scrolls if necessary.
        let said = lay_out_words(ui, studio, &step, room.x);
        let left = height - said.size().y - ui.spacing().item_spacing.y;
        let plot_height = (left - table_height(ui, &step, room.x)).max(PLOT * left);
        plot(ui, studio, &step, vec2(room.x, plot_height.max(MIN_PLOT.min(0.58 * height))));
        // The words scroll too if there is hardly any room for the plot.
        let scrolled = if plot_height < MIN_PLOT {
            Some(said)
        } else {
            ui.label(said);
            None
        };
        table(ui, studio, &step, scrolled);
    }
}

/// Lays out the text of [`words`].
fn lay_out_words(ui: &Ui, studio: &Studio, step: &OneStep, width: f32) -> Arc<Galley> {
    let words = match studio.viewer.is_asked() {
        true => "The end of this tick is shown after your prediction.".into(),
        false => words(step, &shown_coordinate(studio)),
    };
    ui.painter().layout(words, FontId::proportional(TYPE), palette(ui).text, width)
}

fn shown_coordinate(studio: &Studio) -> Coordinate {
    studio.race().truth().bodies()[studio.view().body].coordinates().at(0)
}

fn head(ui: &mut Ui, step: &OneStep) {
    let (name, from) = (step.spec.method.name, step.tick);
    let title = format!("{name}: tick {from} to {}", from + 1);
    let substeps = match step.spec.substeps {
        1 => String::new(),
        n => format!(", in {n} substeps"),
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(title).font(strong_font(TYPE)));
        let length = format!("h = {} s{substeps}", significant(step.h, 4));
        ui.label(RichText::new(length).color(palette(ui).dim));
    });
}

/// Returns the evaluations to draw, each with its number and its colour.
fn evaluations_to_draw<'s>(ui: &Ui, step: &'s OneStep) -> Vec<(usize, Color32, &'s Slope)> {
    let theme = palette(ui).theme;
    let numbered = step.evaluations.iter().enumerate().take(MAX_DRAWN);
    numbered.map(|(i, slope)| (i + 1, colour(theme.evaluation(i)), slope)).collect()
}

/// Returns the range along an axis of everything that is drawn.
fn range(step: &OneStep, axis: usize) -> [f64; 2] {
    let evaluated = step.evaluations.iter().take(MAX_DRAWN).map(|slope| &slope.at);
    let ends = std::iter::once(&step.from).chain(&step.landing);
    let all = ends.chain(&step.exact).chain(&step.chain).chain(evaluated);
    let values = all.map(|point| point[axis]).filter(|value| value.is_finite());
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    let size = (high - low).max(1e-4 * low.abs().max(high.abs())).max(1e-30);
    [low - MARGIN * size, high + MARGIN * size]
}

fn plot(ui: &mut Ui, studio: &Studio, step: &OneStep, size: Vec2) {
    let (whole, response) = ui.allocate_exact_size(size, Sense::hover());
    let palette = palette(ui);
    let rect = Rect::from_min_max(
        pos2(whole.left() + LEFT, whole.top() + NAME),
        pos2(whole.right() - 12.0, whole.bottom() - BELOW),
    );
    let area = PlotArea { rect, bounds: [0, 1].map(|axis| range(step, axis)) };
    let painter = ui.painter_at(whole);
    painter.rect_filled(rect, 0.0, palette.plot);
    let coordinate = &shown_coordinate(studio);
    let small = FontId::proportional(11.5);
    let up = format!("velocity {}, {}", coordinate.velocity, Unit::Velocity.on(coordinate));
    painter.text(whole.left_top(), Align2::LEFT_TOP, up, small.clone(), palette.dim);
    let along = with_unit(&coordinate.name, coordinate.shown_unit());
    painter.text(rect.right_top(), Align2::RIGHT_BOTTOM, along, small, palette.dim);

    let own = palette.style(studio.entries(), &step.spec).0;
    // The curves are the states that have the same energy as the present state, and as the landing.
    let mut curves = Vec::new();
    for (through, colour) in [(Some(step.from), palette.exact), (step.landing, own)] {
        let lines =
            through.map(|through| orbit(studio, through, area.bounds[0])).unwrap_or_default();
        let style = LineStyle::solid(colour.gamma_multiply(ORBIT), 1.0);
        let thin = LineStyle { dash: [6.0, 4.0], ..style };
        curves.extend(lines.into_iter().map(|line| Curve::new(thin, line)));
    }
    curves.push(Curve::new(LineStyle::solid(palette.exact, 2.4), step.exact.clone()));
    let from = area.at(step.from);
    let evaluations = evaluations_to_draw(ui, step);
    for (_, colour, slope) in
        evaluations.iter().filter(|(.., slope)| slope.at.iter().all(|at| at.is_finite()))
    {
        let style = LineStyle::solid(colour.gamma_multiply(0.8), 1.4);
        let dotted = LineStyle { dash: [2.0, 3.0], ..style };
        curves.push(Curve::new(dotted, vec![step.from, slope.at]));
    }
    let marks = [0, 1].map(|axis| area.marks(axis, AxisScale::Linear, [64.0, 26.0][axis]));
    let drawing = Drawing { curves, ..Drawing::default() };
    chart::paint(&painter, &chart::plot(&area, marks, &drawing, palette, whole.right()));
    let painter = painter.with_clip_rect(rect);
    chain(&painter, step, &area, &evaluations, own);
    let reach = SLOPE * rect.size().length();
    let longest = evaluations.iter().map(|(_, _, slope)| direction(&area, slope).length());
    let longest = longest.filter(|length| length.is_finite()).fold(1e-30, f32::max);
    for (_, colour, slope) in &evaluations {
        let at = area.at(slope.at);
        arrow(&painter, [at, at + direction(&area, slope) * (reach / longest)], 1.8, *colour);
        painter.circle(at, 3.6, *colour, Stroke::new(1.2, palette.plot));
    }
    painter.circle(from, STATE, own, Stroke::new(1.6, palette.plot));
    let mut taken = vec![from];
    if let Some(exact) = step.exact_landing() {
        painter.circle_stroke(area.at(exact), STATE + 2.0, Stroke::new(2.2, palette.exact));
        taken.push(area.at(exact));
    }
    if let Some(landing) = step.landing {
        painter.circle(area.at(landing), STATE, own, Stroke::new(1.6, palette.plot));
        taken.push(area.at(landing));
    }
    for (number, colour, slope) in &evaluations {
        let at = badge_place(area.at(slope.at), rect, &taken);
        taken.push(at);
        painter.line_segment([area.at(slope.at), at], Stroke::new(1.0, *colour));
        badge(&painter, at, *number, [*colour, palette.background]);
    }
    let named = name_points(&painter, step, &area, &taken, (palette, own));
    let states = evaluations.iter().map(|(_, _, slope)| area.at(slope.at));
    let taken: Vec<Pos2> = taken.into_iter().chain(named).chain(states).collect();
    loupe::show(&painter, &area, step, &taken, (palette, own));
    let about = format!("one step of {}", step.spec.method.name);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &about));
}

/// Names the state and the landings beside the places that are taken. Returns the places of the names.
fn name_points(
    painter: &egui::Painter,
    step: &OneStep,
    area: &PlotArea,
    taken: &[Pos2],
    (palette, own): (&PanelPalette, Color32),
) -> Vec<Pos2> {
    let mut named: Vec<(Pos2, f32)> = Vec::new();
    let words = [
        (Some(step.from), "state", palette.text),
        (step.exact_landing(), "exact", palette.exact),
        (step.landing, "lands here", own),
    ];
    for (point, text, colour) in words {
        let Some(point) = point.map(|point| area.at(point)) else { continue };
        let half = 3.5 * text.len() as f32;
        let beside = half + 14.0;
        let offsets = [
            vec2(0.0, 17.0),
            vec2(0.0, -17.0),
            vec2(0.0, 33.0),
            vec2(0.0, -33.0),
            vec2(beside, 0.0),
            vec2(-beside, 0.0),
        ];
        let places = offsets.map(|offset| {
            let inner = area.rect.shrink2(vec2(half + 4.0, 9.0));
            if inner.is_positive() { inner.clamp(point + offset) } else { point + offset }
        });
        let is_free = |at: &&Pos2| {
            let near = |other: &Pos2| {
                (other.y - at.y).abs() < 14.0 && (other.x - at.x).abs() < half + 12.0
            };
            !taken.iter().any(near)
                && !named.iter().any(|(other, own)| {
                    (other.y - at.y).abs() < 14.0 && (other.x - at.x).abs() < half + own + 12.0
                })
        };
        // The colour has to suffice if there is no room for a label.
        let Some(&at) = places.iter().find(is_free) else { continue };
        label(painter, (at, 0.0), text, [colour, palette.plot]);
        named.push((at, half));
    }
    named.into_iter().map(|(at, _)| at).collect()
}

/// Draws the weighted slopes head to tail. If the landing is not the sum of the slopes, draws one arrow to the landing.
fn chain(
    painter: &egui::Painter,
    step: &OneStep,
    area: &PlotArea,
    evaluations: &[(usize, Color32, &Slope)],
    own: Color32,
) {
    let Some(landing) = step.landing else { return };
    if step.chain.is_empty() {
        return arrow(
            painter,
            [area.at(step.from), area.at(landing)],
            2.6,
            own.gamma_multiply(0.7),
        );
    }
    let weights = step.spec.method.weights;
    let links = evaluations.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
    for (ends, ((_, colour, _), _)) in step.chain.windows(2).zip(links) {
        arrow(painter, [area.at(ends[0]), area.at(ends[1])], 4.5, *colour);
    }
}

/// Returns the direction of a slope on the screen, per second.
fn direction(area: &PlotArea, slope: &Slope) -> Vec2 {
    let [[x0, x1], [y0, y1]] = area.bounds;
    let size = area.rect.size();
    let [along, up] = slope.slope;
    vec2((along / (x1 - x0)) as f32 * size.x, -(up / (y1 - y0)) as f32 * size.y)
}

/// Returns a place for a badge beside a point, clear of all other badges and of the states.
fn badge_place(at: Pos2, rect: Rect, taken: &[Pos2]) -> Pos2 {
    let around = (0..48).map(|i| {
        let (turn, ring) = ((i % 8) as f32, (i / 8) as f32);
        let angle = (turn * 0.125 - 0.125) * std::f32::consts::TAU;
        at + Vec2::angled(angle) * (19.0 + 12.0 * ring)
    });
    let is_free = |place: &Pos2| {
        rect.shrink(BADGE + 1.0).contains(*place)
            && taken.iter().all(|other| other.distance(*place) > 2.0 * BADGE + 1.0)
    };
    around.into_iter().find(is_free).unwrap_or(at + vec2(19.0, -19.0))
}

fn badge(painter: &egui::Painter, at: Pos2, number: usize, [colour, text]: [Color32; 2]) {
    painter.circle_filled(at, BADGE, colour);
    painter.text(at, Align2::CENTER_CENTER, number.to_string(), strong_font(11.0), text);
}

/// Returns the height of a table of this width, in points.
fn table_height(ui: &Ui, step: &OneStep, width: f32) -> f32 {
    let evaluated = step.evaluations.len().min(MAX_DRAWN);
    match rows_of_formula(ui, step, width) {
        Some(rows) => {
            ROW * rows.iter().map(|lines| lines.len().max(1)).sum::<usize>() as f32 + 2.0 * ROW
        }
        None => FORMULA * step.spec.method.formula.len() as f32 + ROW * (evaluated + 3) as f32,
    }
}

/// Returns the lines of a formula in groups. Each group ends with the line of an evaluation, and the last group has the
/// remaining lines. Returns `None` if the formula does not list every evaluation, for example in a solve of unknown
/// length.
fn formula_by_evaluation<'f>(formula: &[&'f str], evaluations: usize) -> Option<Vec<Vec<&'f str>>> {
    let mut rows = vec![Vec::new()];
    for line in formula {
        let before = |at: usize| line[..at].chars().next_back().is_some_and(char::is_alphabetic);
        let count = ["f(", "a("]
            .iter()
            .flat_map(|sign| line.match_indices(sign))
            .filter(|(at, _)| !before(*at))
            .count();
        rows.last_mut()?.push(*line);
        rows.extend((0..count).map(|_| Vec::new()));
    }
    (rows.len() == evaluations + 1 && evaluations <= MAX_DRAWN).then_some(rows)
}

/// Returns the number of digits in a table of this width, and the gap between its columns in points.
fn figures_and_gap(width: f32) -> (usize, f32) {
    if width < breakpoints::FOUR_FIGURES { (3, 5.0) } else { (4, 14.0) }
}

/// Returns the lines of the step's formula as in [`formula_by_evaluation`], if a table of this width has room for them.
fn rows_of_formula(ui: &Ui, step: &OneStep, width: f32) -> Option<Vec<Vec<&'static str>>> {
    let rows = formula_by_evaluation(step.spec.method.formula, step.evaluations.len())?;
    let line_width = |line: &&str| {
        let job = formula(line, BESIDE_NUMBERS, Color32::WHITE);
        ui.painter().layout_job(job).size().x
    };
    let widest = rows.iter().flatten().map(line_width).fold(0.0, f32::max);
    (widest + NUMBERS + 4.0 * figures_and_gap(width).1 <= width).then_some(rows)
}

/// Shows the numbers of every evaluation, beside its line of the formula, and those of the end of the tick.
fn table(ui: &mut Ui, studio: &Studio, step: &OneStep, said: Option<Arc<Galley>>) {
    let coordinate = &shown_coordinate(studio);
    let (q, v) = (&coordinate.name, &coordinate.velocity);
    ui.spacing_mut().item_spacing.y = 1.0;
    let (figures, gap) = figures_and_gap(ui.available_width());
    let line = |ui: &mut Ui, line: &str| {
        let job = formula(line, BESIDE_NUMBERS, palette(ui).text);
        drop(ui.add(Label::new(job).extend()));
    };
    let rows = rows_of_formula(ui, step, ui.available_width());
    ScrollArea::vertical().id_salt("one step").auto_shrink(false).show(ui, |ui| {
        if let Some(said) = said {
            ui.label(said);
        }
        if rows.is_none() {
            for text in step.spec.method.formula {
                ui.label(formula(text, 16.0, palette(ui).text));
            }
        }
        let beside = |ui: &mut Ui, row: usize, otherwise: RichText| match &rows {
            Some(rows) => {
                ui.vertical(|ui| rows[row].iter().for_each(|text| line(ui, text)));
            }
            None => drop(ui.label(otherwise)),
        };
        let grid = Grid::new("evaluations").num_columns(5).spacing([gap, 1.0]).striped(true);
        grid.min_row_height(ROW - 2.0).show(ui, |ui| {
            for head in [
                String::new(),
                if rows.is_some() { String::new() } else { "at".into() },
                with_unit(q, coordinate.shown_unit()),
                with_unit(v, &Unit::Velocity.on(coordinate)),
                format!("a, {}/s²", coordinate.unit),
            ] {
                ui.label(RichText::new(head).size(11.0).color(palette(ui).dim));
            }
            ui.end_row();
            for (number, colour, slope) in evaluations_to_draw(ui, step) {
                let (rect, _) = ui.allocate_exact_size(vec2(20.0, 18.0), Sense::hover());
                badge(ui.painter(), rect.center(), number, [colour, palette(ui).background]);
                beside(ui, number - 1, RichText::new(moment_in_words(slope.when)).color(colour));
                for value in [slope.at[0], slope.at[1], slope.slope[1]] {
                    ui.label(RichText::new(signed_text(value, figures)).color(colour));
                }
                ui.end_row();
            }
            let own = palette(ui).style(studio.entries(), &step.spec).0;
            let exact = palette(ui).exact;
            for (name, point, colour) in
                [("lands at", step.landing, own), ("exact", step.exact_landing(), exact)]
            {
                let name = RichText::new(name).color(colour);
                ui.label("");
                if colour == own {
                    beside(ui, step.evaluations.len(), name);
                } else {
                    ui.label(name);
                }
                for value in point.unwrap_or([f64::NAN; 2]) {
                    ui.label(RichText::new(signed_text(value, figures)).color(colour));
                }
                ui.label("");
                ui.end_row();
            }
        });
    });
}

/// Returns the name of a quantity with its unit, if it has one.
fn with_unit(quantity: &str, unit: &str) -> String {
    if unit.is_empty() { quantity.into() } else { format!("{quantity}, {unit}") }
}

/// Describes a moment of the tick.
fn moment_in_words(part: f64) -> String {
    let is = |wanted: f64| (part - wanted).abs() < 1e-9;
    match part {
        _ if is(0.0) => "the start".into(),
        _ if is(0.5) => "half-way".into(),
        _ if is(1.0) => "the end".into(),
        part => format!("{} h", round(part, 3)),
    }
}

fn signed_text(value: f64, figures: usize) -> String {
    if !value.is_finite() {
        return "-".into();
    }
    let sign = if value >= 0.0 { "+" } else { "" };
    format!("{sign}{}", significant(value, figures))
}

/// A relative change of the swing below this value is only rounding.
const ROUNDING: f64 = 1e-13;

/// Describes the effect of the tick on the swing, and the effect of a tick half as long.
fn swing([whole, halves]: [f64; 2]) -> String {
    if whole.abs() < ROUNDING {
        return "One tick keeps the swing.".into();
    }
    let does = if whole < 0.0 { "narrows" } else { "widens" };
    let percent = significant(100.0 * whole.abs(), 2);
    let ratio = (whole / halves).round();
    let part = match ratio {
        2.0 => "half".to_owned(),
        4.0 => "a quarter".into(),
        ratio => format!("1/{ratio}"),
    };
    let half = match ratio >= 2.0 && halves.abs() >= ROUNDING {
        true => format!("; a tick half as long by {part} of that"),
        false => String::new(),
    };
    format!("One tick {does} the swing by {percent} %{half}.")
}

/// Describes the effect of the tick on the swing, the error of the tick, and anything that is not drawn.
fn words(step: &OneStep, coordinate: &Coordinate) -> String {
    let mut words = match (step.landing, step.exact_landing()) {
        (None, _) => "The method fails in this tick.".into(),
        (_, None) => "The exact motion from this state is not known.".into(),
        (Some(landing), Some(exact)) => {
            let units = [Unit::Coordinate, Unit::Velocity].map(|unit| unit.on(coordinate));
            let [q, v] = std::array::from_fn(|i| {
                let missed = significant((landing[i] - exact[i]).abs(), 2);
                format!("{missed} {}", units[i]).trim_end().to_owned()
            });
            format!("This tick alone misses the exact motion by {q} and {v}.")
        }
    };
    if let Some(growth) = step.growth {
        words = format!("{} {words}", swing(growth));
    }
    let more = step.evaluations.len().saturating_sub(MAX_DRAWN);
    if more > 0 {
        words += &format!(" {more} more evaluations are not drawn.");
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use regatta_sim::integrators::METHODS;

    #[test]
    fn each_formula_line_is_beside_its_evaluation() {
        let of = |id, evaluations| {
            let method = METHODS.iter().find(|method| method.id == id).unwrap();
            formula_by_evaluation(method.formula, evaluations)
        };
        let midpoint = of("midpoint", 2).unwrap();
        assert_eq!(midpoint[1], ["k₂ = f(t + ½h, y + ½h k₁)"]);
        assert_eq!(midpoint[2], ["y′ = y + h k₂"]);
        let verlet = of("velocity-verlet", 1).unwrap();
        assert_eq!((verlet[0].len(), verlet[1].len()), (3, 1));
        // A solve takes a varying number of evaluations, and the formula of PEFRL lists drifts and kicks.
        assert_eq!(of("implicit-midpoint", 5), None);
        assert_eq!(of("pefrl", 4), None);
    }
}
