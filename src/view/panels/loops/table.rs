//! The table of loops: key, line, name and verdict, then numbers. A click selects a loop, a click on the eye takes it off
//! the stage or brings it on, and a click on a head sorts.

use egui::{
    Align2, FontId, Id, Rect, Response, RichText, ScrollArea, Sense, Shape, Stroke, Ui, Vec2, pos2,
    vec2,
};

use super::columns::{COLUMNS, Cell, Column, fitting};
use crate::lab::{Command, LoopCommand, LoopLab, LoopVerdict, Severity};
use crate::view::chart::legend::swatch;
use crate::view::panels::annotations::polygon;
use crate::view::panels::lanes::{self, BAR, HEAD, MARGIN, ROW};
use crate::view::panels::sorting::{self, Order};
use crate::view::panels::{focus_ring, ink, keycap, severity_tone, short, strong_font};
use crate::view::theme::{TYPE, colour};

/// Rows in sight: the stage and the instrument need the room. The rest is scrolled to.
const MAX_ROWS: usize = 6;
/// Half the size of the sign of a verdict, and the room that it takes, in points.
const SIGN: f32 = 4.5;
const SIGN_ROOM: f32 = 17.0;

pub(in crate::view::panels) fn height(loops: &LoopLab) -> f32 {
    lanes::height_of(loops.lanes().len().min(MAX_ROWS))
}

pub(in crate::view::panels) fn show(ui: &mut Ui, loops: &LoopLab, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing = Vec2::ZERO;
    let width = ui.available_width();
    let columns = fitting(width - 2.0 * MARGIN);
    let order = head(ui, loops, &columns, width);
    let places = sorted(loops, order);
    // The last row in sight is as clear as the others.
    ui.spacing_mut().scroll.fade.strength = 0.0;
    let mut list = ScrollArea::vertical().id_salt("loops").auto_shrink(false);
    let selected = places.iter().position(|&place| place == loops.selected()).unwrap_or_default();
    let id = Id::unique("selected loop");
    if let Some(offset) = lanes::offset_to_follow(ui, id, selected, places.len()) {
        list = list.vertical_scroll_offset(offset);
    }
    list.show(ui, |ui| {
        places.iter().for_each(|&place| row(ui, loops, place, &columns, width, commands));
    });
}

/// Shows the heads, and returns the order that a person has chosen with them.
fn head(
    ui: &mut Ui,
    loops: &LoopLab,
    columns: &[(&'static Column, f32, f32)],
    width: f32,
) -> Order {
    let id = Id::unique("order of the loops");
    let mut order = ui.data(|data| data.get_temp::<Order>(id)).flatten();
    let (line, _) = ui.allocate_exact_size(vec2(width, HEAD), Sense::hover());
    for &(column, left, own) in columns {
        let place = COLUMNS.iter().position(|known| std::ptr::eq(known, column)).unwrap_or(0);
        let at = pos2(line.left() + MARGIN + left, line.top());
        let rect = Rect::from_min_size(at, vec2(own, line.height()));
        let name = match column.cell {
            Cell::Swatch => "line",
            Cell::OnStage => "on the stage",
            _ => column.head,
        };
        let response = ui.interact(rect, Id::unique(("loops head", place)), Sense::click());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Button, true, format!("sort by {name}"))
        });
        let sign = sorting::sign(order, place);
        let words = match column.cell {
            Cell::Verdict => {
                let display = loops.traces()[loops.trace()].name();
                format!("Verdict at {} Hz, trace {display}", loops.scene().tick_hz)
            }
            _ => column.head.to_owned(),
        };
        let is_lit = response.hovered() || response.has_focus();
        let inked = if is_lit { ink(ui).accent } else { ink(ui).dim };
        let is_number = column.cell.metric().is_some();
        let side = if is_number { Align2::RIGHT_CENTER } else { Align2::LEFT_CENTER };
        let (text, _) =
            short(ui, &format!("{words}{sign}"), FontId::proportional(TYPE), own, inked);
        let text_rect = side.align_size_within_rect(text.size(), rect);
        ui.painter().galley(text_rect.min, text, inked);
        if response.on_hover_text(column.cell.about()).clicked() {
            order = sorting::clicked(order, place);
            ui.data_mut(|data| data.insert_temp(id, order));
        }
    }
    order
}

/// The places of all loops in this order.
fn sorted(loops: &LoopLab, order: Order) -> Vec<usize> {
    let mut places: Vec<usize> = (0..loops.lanes().len()).collect();
    if let Some((by, is_reversed)) = order {
        let rank = |place: usize| COLUMNS[by].cell.rank(loops, place);
        places.sort_by(|&a, &b| match (rank(a), rank(b)) {
            (Some(a), Some(b)) if is_reversed => b.total_cmp(&a),
            (Some(a), Some(b)) => a.total_cmp(&b),
            // Those without a value stay last.
            (a, b) => a.is_none().cmp(&b.is_none()),
        });
    }
    places
}

fn row(
    ui: &mut Ui,
    loops: &LoopLab,
    place: usize,
    columns: &[(&'static Column, f32, f32)],
    width: f32,
    commands: &mut Vec<Command>,
) {
    let (rect, response) = ui.allocate_exact_size(vec2(width, ROW), Sense::click());
    let lane = &loops.lanes()[place];
    let verdict = lane.verdict(loops.scene().tick_hz);
    let is_selected = place == loops.selected();
    let numbers = columns.iter().filter_map(|(column, ..)| {
        Some(format!(", {} {}", column.head, column.cell.written(loops, place)?))
    });
    let numbers: String = numbers.collect();
    let spoken = format!("{} {}, {}{numbers}", place + 1, lane.card().name, verdict.text);
    response
        .widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, is_selected, &spoken));
    if is_selected || response.hovered() {
        let fill = ink(ui).raised.gamma_multiply(if is_selected { 1.0 } else { 0.6 });
        ui.painter().rect_filled(rect, 3.0, fill);
    }
    focus_ring(ui, &response);
    if is_selected {
        let bar = Rect::from_min_size(rect.min + vec2(0.0, 1.0), vec2(BAR, ROW - 2.0));
        let own = colour(ink(ui).theme.loop_style(place).0);
        ui.painter().rect_filled(bar, 2.0, own);
    }
    if tooltip(response, loops, place, &verdict).clicked() {
        commands.push(Command::Loop(LoopCommand::Select(place)));
    }
    for &(column, left, own) in columns {
        let from = pos2(rect.left() + MARGIN + left, rect.top());
        let cell = Rect::from_min_size(from, vec2(own, ROW));
        match column.cell {
            // Over the row: it takes the click.
            Cell::OnStage => eye(ui, loops, place, cell, commands),
            _ => paint(ui, loops, place, column.cell, cell, &verdict),
        }
    }
}

/// Whether the loop is on the stage. A click changes it.
fn eye(ui: &Ui, loops: &LoopLab, place: usize, rect: Rect, commands: &mut Vec<Command>) {
    let is_on = loops.on_stage().contains(&place);
    let response = ui.interact(rect, Id::unique(("loop on the stage", place)), Sense::click());
    let name = format!("{} on the stage", loops.lanes()[place].card().name);
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::CheckBox, true, is_on, &name));
    let is_lit = response.hovered() || response.has_focus();
    let own = colour(ink(ui).theme.loop_style(place).0);
    let inked = match (is_lit, is_on) {
        (true, _) => ink(ui).accent,
        (false, true) => own,
        (false, false) => ink(ui).dim.gamma_multiply(0.55),
    };
    let centre = rect.left_center() + vec2(9.0, 0.0);
    let lid = |side: f32| {
        let part = |i: i32| i as f32 / 8.0;
        let at = move |x: f32| centre + vec2(8.0 * x, side * 4.6 * (1.0 - x * x));
        Shape::line((-8..=8).map(part).map(at).collect(), Stroke::new(1.4, inked))
    };
    ui.painter().extend([lid(1.0), lid(-1.0)]);
    if is_on {
        ui.painter().circle_filled(centre, 2.6, inked);
    }
    let about = if is_on { "take it off the stage" } else { "bring it on the stage" };
    if response.on_hover_text(about).clicked() {
        commands.push(Command::Loop(LoopCommand::ToggleOnStage(place)));
    }
}

fn paint(ui: &Ui, loops: &LoopLab, place: usize, cell: Cell, rect: Rect, verdict: &LoopVerdict) {
    let lane = &loops.lanes()[place];
    let (is_selected, is_on) = (place == loops.selected(), loops.on_stage().contains(&place));
    let text = if is_on { ink(ui).text } else { ink(ui).dim };
    let left = rect.left_center();
    let write = |words: &str, at: egui::Pos2, font: FontId| {
        let (galley, _) = short(ui, words, font, rect.right() - at.x, text);
        ui.painter().galley(at - vec2(0.0, galley.size().y / 2.0), galley, text);
    };
    match cell {
        Cell::Key if place < 10 => {
            let inked = if is_selected { ink(ui).accent } else { text };
            keycap::paint(ui, left.x, left.y, &format!("{}", (place + 1) % 10), inked);
        }
        Cell::Key | Cell::OnStage => {}
        Cell::Swatch => {
            let (rgba, dash) = ink(ui).theme.loop_style(place);
            let strong = colour(rgba);
            let inked = if is_on { strong } else { strong.gamma_multiply(0.7) };
            swatch(ui.painter(), left, rect.width() - 4.0, dash, inked);
        }
        Cell::Name => {
            let font = if is_selected { strong_font(TYPE) } else { FontId::proportional(TYPE) };
            write(lane.card().name, left, font);
        }
        Cell::Verdict => {
            sign(ui, pos2(left.x + SIGN, left.y), verdict.severity);
            let at = left + vec2(SIGN_ROOM, 0.0);
            let fits = |words: &&str| {
                short(ui, words, FontId::proportional(TYPE), rect.right() - at.x, text).1
            };
            let wordings = wordings(&verdict.text);
            let words = wordings.iter().copied().find(fits);
            write(words.unwrap_or(wordings[wordings.len() - 1]), at, FontId::proportional(TYPE));
        }
        Cell::Metric(_) | Cell::Latency => {
            let Some(words) = cell.written(loops, place) else { return };
            let font = FontId::proportional(TYPE);
            ui.painter().text(rect.right_center(), Align2::RIGHT_CENTER, words, font, text);
        }
    }
}

/// A verdict, and what is left of it without its last parts.
fn wordings(verdict: &str) -> Vec<&str> {
    let shorter = verdict.rmatch_indices(", ").map(|(end, _)| &verdict[..end]);
    std::iter::once(verdict).chain(shorter).collect()
}

/// Draws the sign of a severity: ● is right, ◆ is doubtful, ▲ is bad, a ring is not known.
fn sign(ui: &Ui, at: egui::Pos2, severity: Severity) {
    let colour = severity_tone(ui, severity);
    let corners = |corners: &[(f32, f32)]| {
        let corners = corners.iter().map(|(x, y)| at + SIGN * vec2(*x, *y));
        ui.painter().add(polygon(corners, colour));
    };
    match severity {
        Severity::Fine => drop(ui.painter().circle_filled(at, SIGN, colour)),
        Severity::Doubtful => corners(&[(0.0, -1.15), (1.15, 0.0), (0.0, 1.15), (-1.15, 0.0)]),
        Severity::Bad => corners(&[(0.0, -1.0), (1.1, 0.9), (-1.1, 0.9)]),
        Severity::Unknown => {
            ui.painter().circle_stroke(at, SIGN - 1.0, Stroke::new(1.5, colour));
        }
    }
}

/// The loop's card and its verdict.
fn tooltip(response: Response, loops: &LoopLab, place: usize, verdict: &LoopVerdict) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(440.0);
        let card = loops.lanes()[place].card();
        ui.label(RichText::new(card.name).font(strong_font(TYPE)));
        ui.label(card.formula);
        if !card.constants.is_empty() {
            ui.label(format!("Constants: {}.", card.constants));
        }
        ui.label(format!("Odd frames: {}.", card.odd_frames));
        let display = loops.traces()[loops.trace()].name();
        let tick_hz = loops.scene().tick_hz;
        ui.label(format!("At {tick_hz} Hz, trace {display}: {}.", verdict.text));
        ui.label(format!("Used by {}.", card.users));
        ui.label(RichText::new(card.source).color(ink(ui).dim));
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Lab, Scene};

    #[test]
    fn a_verdict_is_shortened_from_its_end() {
        assert_eq!(
            wordings("smooth, loses 3 ms, late"),
            ["smooth, loses 3 ms, late", "smooth, loses 3 ms", "smooth"]
        );
        assert_eq!(wordings("smooth"), ["smooth"]);
    }

    #[test]
    fn rows_are_sorted_by_what_was_clicked_and_back() {
        let mut lab = Lab::new(Scene::built_in("spring").unwrap());
        lab.apply(Command::Loop(LoopCommand::ToggleLab));
        lab.run_loops();
        let loops = lab.loop_lab().unwrap();
        let by_keys: Vec<usize> = (0..loops.lanes().len()).collect();
        assert_eq!(sorted(loops, None), by_keys);
        let verdict = COLUMNS.iter().position(|column| column.cell == Cell::Verdict).unwrap();
        let best_first = sorted(loops, Some((verdict, false)));
        let severities = |places: &[usize]| -> Vec<Option<f64>> {
            places.iter().map(|&place| Cell::Verdict.rank(loops, place)).collect()
        };
        assert!(severities(&best_first).is_sorted());
        let worst_first = sorted(loops, Some((verdict, true)));
        assert!(severities(&worst_first).iter().rev().is_sorted());
        assert_eq!(best_first.len(), by_keys.len());
    }
}
