//! The stability map, which shows the regions of tick rate and a parameter in which each method is stable, and the
//! place of the run.

use std::sync::Arc;

use egui::{
    Align2, ComboBox, EventFilter, FontId, Galley, Id, Key, Label, Pos2, Rect, RichText, Sense,
    Stroke, Ui, Vec2, pos2, vec2,
};

use super::annotations::{label, mixed, polygon};
use super::breakpoints;
use super::parts::{is_picture, numbered};
use crate::chart::{self, AxisScale, LineStyle, PlotArea, Primitive, ScreenCurve};
use crate::measure::{Coverage, DampingLine, MapRequest, StabilityMap};
use crate::run::MenuIndex;
use crate::scene::TickRate;
use crate::scene::{Action, edited_values};
use crate::stage::Parameter;
use crate::stage::number::round;
use crate::studio::{
    Command, RunCommand, StageCommand, Step, Studio, mappable_parameters, mapped_parameter,
};
use crate::theme::{colour, palette, strong_font};
use words::{full_name, point_in_words, sentence, short_sentence};

mod words;

/// Width of the numbers at the left, in points.
const LEFT: f32 = 58.0;
/// Height of the numbers below, and height of the name of an axis, in points.
const BELOW: f32 = 18.0;
const NAME: f32 = 19.0;
/// Opacity of the tint where every method is stable.
const DEEPEST: f32 = 0.7;
/// Id of the widget that is the cross at the place of the run.
const CROSS_ID: &str = "cross of the stability map";
/// Size of the cross, in points.
const CROSS: f32 = 13.0;
/// Number of presses of an arrow key that multiply the parameter by ten.
const STEPS_OF_DECADE: f64 = 20.0;
/// Minimum distance of a label from its boundary, and from the middle of any other label or boundary, in points.
const BESIDE: f32 = 10.0;
const APART: f32 = 13.0;
/// Half the height of the letters of a label, in points.
const HALF_LETTER: f32 = 6.0;
/// Height of a row of the key to the boundaries, and width of the piece of line in a row, in points.
const ROW: f32 = 16.0;
const KEY_LINE: f32 = 32.0;

pub(super) fn show(ui: &mut Ui, studio: &Studio, room: Vec2, commands: &mut Vec<Command>) {
    let top = ui.cursor().top();
    let Some(index) = mapped_parameter(studio) else {
        ui.label(
            RichText::new("This body has no parameter that a map could show.")
                .color(palette(ui).dim),
        );
        return;
    };
    head(ui, studio, index, commands);
    let map = studio.viewer.stability_map();
    let wanted = (studio.view().body, index);
    let map = map.filter(|map| (map.request.body, map.request.parameter) == wanted);
    let Some(map) = map else {
        ui.label(RichText::new("Working out the map …").color(palette(ui).dim));
        return;
    };
    if let Some(why) = map.refused {
        let why = format!(
            "No stability map: {why}. The table below judges each method on the motion itself."
        );
        ui.add(Label::new(RichText::new(why).color(palette(ui).dim)).wrap());
        return;
    }
    let left = top + room.y - ui.cursor().top();
    let (words, height) = match room.y >= breakpoints::WORDS_OF_MAP {
        true => sentence(ui, studio, map, room.x),
        false => short_sentence(ui, studio, map, room.x),
    };
    let size = vec2(room.x, (left - height - 6.0).max(40.0));
    plot(ui, studio, map, size, commands);
    ui.add(Label::new(words)).on_hover_text(map.each_here());
}

fn parameter(studio: &Studio, index: usize) -> &Parameter {
    &studio.scene().bodies[studio.view().body].kind.parameters[index]
}

/// Shows the title and the menu of parameters.
fn head(ui: &mut Ui, studio: &Studio, index: usize, commands: &mut Vec<Command>) {
    let body = &studio.scene().bodies[studio.view().body];
    ui.horizontal(|ui| {
        let title = RichText::new(format!("Stability of the {}, by", body.name));
        ui.add(Label::new(title.font(strong_font(13.0))).truncate());
        let name = |index: usize| full_name(parameter(studio, index));
        if is_picture(ui) {
            ui.label(name(index));
            return;
        }
        let menu = ComboBox::from_id_salt("mapped parameter").selected_text(name(index));
        let menu = menu.show_ui(ui, |ui| {
            for other in mappable_parameters(studio) {
                if ui.selectable_label(other == index, name(other)).clicked() {
                    commands.push(Command::Run(RunCommand::MapParameter(other)));
                }
            }
        });
        let about = format!("parameter of the stability map: {}", name(index));
        menu.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, &about));
    });
}

fn plot(ui: &mut Ui, studio: &Studio, map: &StabilityMap, size: Vec2, commands: &mut Vec<Command>) {
    let (whole, _) = ui.allocate_exact_size(size, Sense::hover());
    let (palette, painter) = (palette(ui), ui.painter_at(whole));
    let has_names = size.y >= 150.0;
    let names = if has_names { NAME } else { 4.0 };
    let rect = Rect::from_min_max(
        pos2(whole.left() + LEFT, whole.top() + names),
        pos2(whole.right() - 18.0, whole.bottom() - BELOW - names),
    );
    let MapRequest { rates_hz, range, .. } = &map.request;
    let area = PlotArea { rect, bounds: [rates_hz, range].map(|ends| ends.map(libm::log10)) };

    painter.rect_filled(rect, 0.0, mixed(palette.plot, palette.accent, 0.14));
    water(ui, map, &area);
    let marks = [0, 1].map(|axis| area.marks(axis, AxisScale::Log, [28.0, 22.0][axis]));
    chart::paint(&painter, &chart::axes(&area, marks, palette, whole.right()));
    if has_names {
        let parameter = parameter(studio, map.request.parameter);
        let unit =
            if parameter.unit.is_empty() { String::new() } else { format!(", {}", parameter.unit) };
        let name = format!("{}{unit}", full_name(parameter));
        let small = FontId::proportional(11.5);
        painter.text(whole.left_top(), Align2::LEFT_TOP, name, small.clone(), palette.dim);
        let below = pos2(rect.center().x, whole.bottom());
        painter.text(below, Align2::CENTER_BOTTOM, "tick rate, Hz", small, palette.dim);
    }
    boundaries(ui, studio, map, &area);
    cross(ui, studio, map, &area, commands);
}

/// Tints the map. The more methods are stable at a point, the deeper is the tint. A method that is stable everywhere
/// adds no tint.
fn water(ui: &Ui, map: &StabilityMap, area: &PlotArea) {
    let painter = ui.painter().with_clip_rect(area.rect);
    let part: Vec<_> =
        map.regions.iter().filter(|region| region.coverage == Coverage::Part).collect();
    // All layers together leave the share `1 - DEEPEST` of the background visible.
    let layer = 1.0 - libm::powf(1.0 - DEEPEST, 1.0 / part.len().max(1) as f32);
    let theme = palette(ui).theme;
    let [sea, blue] = [theme.palette().sea[0], theme.evaluation(1)].map(colour);
    let water = mixed(sea, blue, 0.3).gamma_multiply(layer);
    for region in part {
        for piece in &region.pieces {
            painter.add(polygon(piece.iter().map(|point| area.at(*point)), water));
        }
    }
    if !map.regions.is_empty() && map.regions.iter().all(|region| region.coverage != Coverage::Part)
    {
        let is_water = map.regions.iter().any(|region| region.coverage == Coverage::Everywhere);
        if is_water {
            painter.rect_filled(area.rect, 0.0, water);
        }
    }
}

/// Draws the boundary of each method in its colour, with the method's name and limit beside it. The selected method
/// comes last.
fn boundaries(ui: &Ui, studio: &Studio, map: &StabilityMap, area: &PlotArea) {
    let painter = ui.painter().with_clip_rect(area.rect);
    let lines: Vec<(usize, Vec<Pos2>)> = map
        .regions
        .iter()
        .zip(&map.request.specs)
        .flat_map(|(region, (entry, _))| {
            let line = |line: &Vec<[f64; 2]>| line.iter().map(|point| area.at(*point)).collect();
            region.boundary.iter().map(move |points| (*entry, line(points)))
        })
        .collect();
    let is_selected = |entry: MenuIndex| entry == studio.active();
    let style = |entry: MenuIndex| palette(ui).style(studio.entries(), &studio.entries()[entry]);
    let mut order: Vec<&(usize, Vec<Pos2>)> = lines.iter().collect();
    order.sort_by_key(|(entry, _)| is_selected(*entry));
    let seen = seen_lines(studio, map, area);
    let seen_colour = mixed(palette(ui).dim, style(studio.active()).0, 0.6);
    let curve = |style: LineStyle, points: &[Pos2]| ScreenCurve::new(style, points.to_vec());
    let thin = LineStyle::solid(seen_colour, 1.2);
    let mut curves: Vec<_> = seen.iter().map(|(_, points)| curve(thin, points)).collect();
    for (entry, points) in &order {
        let (colour, dash) = style(*entry);
        if is_selected(*entry) {
            let glow = LineStyle::solid(colour.gamma_multiply(0.25), 7.0);
            curves.push(curve(glow, points));
        }
        let width = if is_selected(*entry) { 3.4 } else { 2.2 };
        curves.push(curve(LineStyle { dash, ..LineStyle::solid(colour, width) }, points));
    }
    chart::paint(&painter, &[Primitive::Curves(curves)]);
    let mut taken: Vec<Pos2> = Vec::new();
    if let Some(at) = cross_at(studio, map, area) {
        let (chip, _) = you_are_here(ui, at, area.rect);
        let edge = |y| points_along(pos2(chip.center().x, y), 0.0, chip.width());
        taken.extend(edge(chip.top() + HALF_LETTER).chain(edge(chip.bottom() - HALF_LETTER)));
        taken.push(at);
    }
    taken.extend(only_everywhere(ui, studio, map, area));
    let (mut named, mut keyed): (Vec<usize>, Vec<usize>) = Default::default();
    for (entry, points) in order.iter().rev() {
        if named.contains(entry) {
            continue;
        }
        let name = numbered(*entry, &studio.lane_name(*entry));
        let with_limit = limit(map, *entry).map(|limit| format!("{name}: {limit}"));
        let others =
            lines.iter().filter(|(other, _)| other != entry).flat_map(|(_, points)| points);
        let others: Vec<Pos2> = others.copied().collect();
        // Only the name is shown if there is no room for the name with its limit.
        let texts: Vec<String> = with_limit.into_iter().chain([name]).collect();
        let placed = |text: &String, is_at_all: bool| {
            let width = 7.0 * text.chars().count() as f32;
            let places = label_places(points, width, area.rect, &taken);
            let place =
                places.into_iter().find(|place| is_at_all || is_clear(place, width, &others));
            place.map(|place| (place, width, text.clone()))
        };
        // A label may lie near another boundary if the two boundaries coincide.
        let found = texts.iter().find_map(|text| placed(text, false));
        let found = found.or_else(|| texts.last().and_then(|text| placed(text, true)));
        if let Some(((at, angle), width, text)) = found {
            let land = palette(ui).plot.gamma_multiply(0.8);
            label(&painter, (at, angle), &text, [style(*entry).0, land]);
            taken.extend(points_along(at, angle, width));
            named.push(*entry);
        } else if area.rect.intersects(Rect::from_points(points)) && !keyed.contains(entry) {
            keyed.push(*entry);
        }
    }
    keyed.retain(|entry| !named.contains(entry));
    let key = key(ui, studio, &keyed, area, &taken);
    taken.extend(key);
    let land = palette(ui).plot.gamma_multiply(0.8);
    for (ratio, points) in &seen {
        let others = seen.iter().filter(|(other, _)| other != ratio).map(|(_, points)| points);
        let others = others.chain(lines.iter().map(|(_, points)| points)).flatten();
        let others: Vec<Pos2> = others.copied().collect();
        for text in [format!("damping {ratio}"), ratio.to_string()] {
            let width = 7.0 * text.chars().count() as f32;
            let places = label_places(points, width, area.rect, &taken);
            let clear = places.iter().find(|place| is_clear(place, width, &others));
            if let Some(&(at, angle)) = clear.or(places.first()) {
                label(&painter, (at, angle), &text, [seen_colour, land]);
                taken.extend(points_along(at, angle, width));
                break;
            }
        }
    }
}

/// Names the boundaries that have no room for a label, each name beside a piece of the boundary's line. The list is in
/// the upper left corner, clear of the `taken` places. Returns places along the names.
fn key(ui: &Ui, studio: &Studio, entries: &[usize], area: &PlotArea, taken: &[Pos2]) -> Vec<Pos2> {
    let painter = ui.painter().with_clip_rect(area.rect);
    let mut rows = (0..).map(|row| area.rect.left_top() + vec2(8.0, 30.0 + ROW * row as f32));
    let mut places = Vec::new();
    for entry in entries {
        let (colour, dash) = palette(ui).style(studio.entries(), &studio.entries()[*entry]);
        let name = numbered(*entry, &studio.lane_name(*entry));
        let name = painter.layout_no_wrap(name, FontId::proportional(12.0), colour);
        let size = vec2(KEY_LINE + name.size().x, ROW);
        let is_free = |from: &Pos2| {
            let place = Rect::from_min_size(*from - vec2(0.0, ROW / 2.0), size).expand(HALF_LETTER);
            !taken.iter().any(|at| place.contains(*at))
        };
        let Some(from) = rows.find(|from| is_free(from) || from.y > area.rect.bottom()) else {
            break;
        };
        let line = LineStyle { dash, ..LineStyle::solid(colour, 2.2) };
        let piece = ScreenCurve::new(line, vec![from, from + vec2(KEY_LINE - 6.0, 0.0)]);
        chart::paint(&painter, &[Primitive::Curves(vec![piece])]);
        let at = Align2::LEFT_CENTER.anchor_size(from + vec2(KEY_LINE, 0.0), name.size());
        painter.galley(at.min, name, colour);
        places.extend(points_along(at.center(), 0.0, at.width()));
    }
    places
}

/// Returns the lines of the selected engine along which a player sees the same damping ratio.
fn seen_lines(studio: &Studio, map: &StabilityMap, area: &PlotArea) -> Vec<(f64, Vec<Pos2>)> {
    let found = map.regions.iter().zip(&map.request.specs);
    let selected = found.filter(|(_, (entry, _))| *entry == studio.active());
    let has_room = area.rect.height() >= breakpoints::ALL_LINES_OF_MAP;
    let is_decade = |ratio: f64| libm::log10(ratio).fract().abs() < 1e-9;
    let lines = selected.flat_map(|(region, _)| &region.seen);
    let lines = lines.filter(|line| has_room || is_decade(line.damping_ratio));
    let line = |line: &DampingLine| {
        (line.damping_ratio, line.points.iter().map(|point| area.at(*point)).collect())
    };
    lines.map(line).collect()
}

/// Returns the stability limit of a method on the map as a formula: `ω h < 2`.
fn limit(map: &StabilityMap, entry: MenuIndex) -> Option<String> {
    let index = map.request.specs.iter().position(|(listed, _)| *listed == entry)?;
    Some(format!("ω h < {}", round(map.regions.get(index)?.limit?, 4)))
}

/// Returns the points along a label, at most [`APART`] from each other.
fn points_along(at: Pos2, angle: f32, width: f32) -> impl Iterator<Item = Pos2> {
    let steps = (width / APART).ceil().max(1.0);
    let ends = at - Vec2::angled(angle) * (width / 2.0);
    (0..=steps as u32).map(move |i| ends + Vec2::angled(angle) * (width * i as f32 / steps))
}

/// Returns places and angles for the label of a boundary. They are beside the boundary, within `rect`, and clear of the
/// `taken` places.
fn label_places(points: &[Pos2], width: f32, rect: Rect, taken: &[Pos2]) -> Vec<(Pos2, f32)> {
    let inside: Vec<Pos2> = points.iter().copied().filter(|at| rect.contains(*at)).collect();
    let candidates = [0.5, 0.62, 0.38, 0.74, 0.26, 0.85, 0.15].into_iter().flat_map(|part| {
        let middle = (part * inside.len() as f32) as usize;
        let reach = (inside.len() / 12).max(1);
        let from = inside.get(middle.saturating_sub(reach)).copied();
        let to = inside.get((middle + reach).min(inside.len().saturating_sub(1))).copied();
        let place = from.zip(to).filter(|(from, to)| from != to).map(|(from, to)| {
            let [from, to] = if from.x <= to.x { [from, to] } else { [to, from] };
            let angle = (to - from).angle();
            (from + (to - from) / 2.0, angle)
        });
        place.into_iter().flat_map(|(at, angle)| {
            [-1.0, 1.0].map(|side| (at + Vec2::angled(angle).rot90() * (side * BESIDE), angle))
        })
    });
    candidates
        .filter(|(at, angle)| {
            points_along(*at, *angle, width).all(|at| {
                rect.shrink(7.0).contains(at)
                    && taken.iter().all(|other| other.distance(at) >= APART)
            })
        })
        .collect()
}

/// Whether a label is clear of the boundaries in `others`, so that it is not mistaken for the label of one of them.
fn is_clear((at, angle): &(Pos2, f32), width: f32, others: &[Pos2]) -> bool {
    points_along(*at, *angle, width)
        .all(|at| others.iter().all(|other| other.distance(at) >= BESIDE))
}

/// Names the methods that are stable everywhere, in a corner that usually has no other name. Returns places along the
/// text.
fn only_everywhere(ui: &Ui, studio: &Studio, map: &StabilityMap, area: &PlotArea) -> Vec<Pos2> {
    let found = map.regions.iter().zip(&map.request.specs);
    let mut everywhere = found.filter(|(region, _)| region.coverage == Coverage::Everywhere);
    let Some((_, (entry, _))) = everywhere.next() else { return Vec::new() };
    let more = everywhere.count();
    let others = if more > 0 { format!(" and {more} more") } else { String::new() };
    let verb = if more > 0 { "are" } else { "is" };
    let name = numbered(*entry, &studio.lane_name(*entry));
    let (colour, _) = palette(ui).style(studio.entries(), &studio.entries()[*entry]);
    let painter = ui.painter().with_clip_rect(area.rect);
    let at = area.rect.left_top() + vec2(8.0, 6.0);
    let laid_out = |text| painter.layout_no_wrap(text, strong_font(12.0), colour);
    let only_here = laid_out(format!("only {name}{others} {verb} bounded here"));
    let mut partly = map.regions.iter().filter(|region| region.coverage == Coverage::Part);
    let is_shared = partly.any(|region| {
        points_along(at + only_here.size() / 2.0, 0.0, only_here.size().x)
            .any(|at| region.contains(area.point(at)))
    });
    let words = match is_shared {
        true => laid_out(format!("{name}{others} {verb} bounded everywhere")),
        false => only_here,
    };
    let rect = Rect::from_min_size(at, words.size());
    painter.galley(at, words, colour);
    points_along(rect.center(), 0.0, rect.width()).collect()
}

/// Returns the place of the run on the map. A run beyond the map is at its edge.
fn cross_at(studio: &Studio, map: &StabilityMap, area: &PlotArea) -> Option<Pos2> {
    let value = studio.race().values(map.request.body).get(map.request.parameter)?;
    let hz = f64::from(studio.clock().tick_hz());
    Some(area.rect.clamp(area.at([hz, value.max(f64::MIN_POSITIVE)].map(libm::log10))))
}

/// Shows the cross. A drag of the cross sets the tick rate and the parameter.
fn cross(
    ui: &Ui,
    studio: &Studio,
    map: &StabilityMap,
    area: &PlotArea,
    commands: &mut Vec<Command>,
) {
    let Some(at) = cross_at(studio, map, area) else { return };
    let response = ui.interact(area.rect, Id::unique(CROSS_ID), Sense::click_and_drag());
    let (palette, painter) = (palette(ui), ui.painter().with_clip_rect(area.rect));
    let index = map.request.parameter;
    let value = studio.race().values(map.request.body)[index];
    let here = format!(
        "you are here, arrow keys move it: {}",
        point_in_words(studio, index, studio.clock().tick_hz(), value)
    );
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Slider, true, &here));
    // The release may be the only event of a drag.
    let is_moved = response.dragged() || response.drag_stopped() || response.clicked();
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| is_moved) {
        go_to(studio, map, area.point(pointer), commands);
    }
    if response.has_focus() {
        let filter = EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        step(ui, studio, map, commands);
    }
    let is_lit = response.hovered() || response.dragged();
    response.on_hover_cursor(egui::CursorIcon::Crosshair);
    let thin = Stroke::new(1.0, palette.accent.gamma_multiply(0.45));
    for ends in [
        [pos2(area.rect.left(), at.y), pos2(area.rect.right(), at.y)],
        [pos2(at.x, area.rect.top()), pos2(at.x, area.rect.bottom())],
    ] {
        painter.extend(egui::Shape::dashed_line(&ends, thin, 2.0, 3.0));
    }
    let under = Stroke::new(5.0, palette.plot.gamma_multiply(0.8));
    let over = Stroke::new(if is_lit { 2.6 } else { 2.0 }, palette.accent);
    for stroke in [under, over] {
        painter.circle_stroke(at, 0.7 * CROSS, stroke);
        painter.line_segment([at - vec2(CROSS, 0.0), at + vec2(CROSS, 0.0)], stroke);
        painter.line_segment([at - vec2(0.0, CROSS), at + vec2(0.0, CROSS)], stroke);
    }
    let (chip, galley) = you_are_here(ui, at, area.rect);
    painter.rect_filled(chip, 4.0, palette.accent);
    painter.galley(chip.min + vec2(6.0, 3.0), galley, palette.on_accent);
}

/// Lays out the words beside a cross at this place of a map. Also returns their rectangle.
fn you_are_here(ui: &Ui, at: Pos2, map: Rect) -> (Rect, Arc<Galley>) {
    let colour = palette(ui).on_accent;
    let words = ui.painter().layout_no_wrap("you are here".into(), strong_font(12.0), colour);
    let size = words.size() + vec2(12.0, 6.0);
    let is_left = at.x + CROSS + 6.0 + size.x > map.right();
    let left = if is_left { at.x - CROSS - 6.0 - size.x } else { at.x + CROSS + 6.0 };
    let top = (at.y - size.y / 2.0).clamp(map.top(), map.bottom() - size.y);
    (Rect::from_min_size(pos2(left, top), size), words)
}

/// Moves the cross by the arrow keys. A key steps along the ladder of tick rates, or multiplies the parameter by a
/// constant factor.
fn step(ui: &Ui, studio: &Studio, map: &StabilityMap, commands: &mut Vec<Command>) {
    let pressed = |key| ui.input(|input| input.num_presses(key));
    commands.extend(
        (0..pressed(Key::ArrowLeft))
            .map(|_| Command::Stage(StageCommand::TickRate(Step::Previous))),
    );
    commands.extend(
        (0..pressed(Key::ArrowRight)).map(|_| Command::Stage(StageCommand::TickRate(Step::Next))),
    );
    let up = pressed(Key::ArrowUp) as f64 - pressed(Key::ArrowDown) as f64;
    if up != 0.0 {
        let [low, high] = map.request.range;
        let present = studio.race().values(map.request.body)[map.request.parameter];
        let value = present.max(low) * libm::pow(10.0, up / STEPS_OF_DECADE);
        set(studio, map, value.clamp(low, high), commands);
    }
}

/// Sets the tick rate and the parameter to a point of the map.
fn go_to(studio: &Studio, map: &StabilityMap, [x, y]: [f64; 2], commands: &mut Vec<Command>) {
    // A pixel of the map is coarser than a hertz.
    let tick_hz = TickRate::whole(libm::pow(10.0, x).round().max(1.0) as u32);
    if tick_hz != studio.clock().tick_hz() {
        commands.push(Command::Stage(StageCommand::TickHz(tick_hz)));
    }
    set(studio, map, libm::pow(10.0, y), commands);
}

/// Sets the parameter to a value, rounded to three digits.
fn set(studio: &Studio, map: &StabilityMap, value: f64, commands: &mut Vec<Command>) {
    let (body, parameter) = (map.request.body, map.request.parameter);
    let value = to_three_digits(value);
    let values = studio.race().values(body);
    let kind = &studio.scene().bodies[body].kind;
    if value != values[parameter] && edited_values(kind, values, parameter, value).is_ok() {
        commands.push(Command::Run(RunCommand::Act(Action::Set { body, parameter, value })));
    }
}

fn to_three_digits(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests;
