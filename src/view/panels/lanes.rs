//! The table of lanes: key, colour, method and verdict, then numbers. Solo, the flown lane has a row for each body.
//! A click on a head sorts it.

use egui::{Align2, FontId, Id, Pos2, Rect, Response, ScrollArea, Sense, Ui, Vec2, pos2, vec2};

use super::sorting::{self, Order};
use super::{focus_ring, formula, ink, keycap, short};
use crate::lab::{Command, Lab, LaneBody, Language, Mode};
use crate::view::chart::legend::swatch;
use crate::view::theme::{TYPE, strong_font};

use columns::{COLUMNS, Cell, Column, Rank, fitting};
use row::Row;

mod columns;
mod row;
mod verdict;

pub(super) const ROW: f32 = 26.0;
pub(super) const HEAD: f32 = 24.0;
/// The width of the bar at the left of the selected row, and of the margin that it stands in, in points.
pub(super) const BAR: f32 = 4.0;
pub(super) const MARGIN: f32 = 8.0;

/// Rows in sight, where the window is high enough: the lanes of a usual race. The rest is scrolled to.
const ROWS: std::ops::RangeInclusive<usize> = 5..=8;

pub(super) fn height(lab: &Lab) -> f32 {
    height_of(lab.scene().lanes.len())
}

/// The height of a table of `rows` rows, as far as they are in sight.
pub(super) fn height_of(rows: usize) -> f32 {
    HEAD + ROW * rows.clamp(*ROWS.start(), *ROWS.end()) as f32 + 2.0
}

/// Shows the table. Returns the place of the lane whose row the pointer or the keyboard's focus is on.
pub(super) fn show(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) -> Option<usize> {
    ui.spacing_mut().item_spacing = Vec2::ZERO;
    let width = ui.available_width();
    let columns = fitting(lab, width - 2.0 * MARGIN);
    let order = head(ui, lab, &columns, width);
    let rows = sorted(lab, order);
    // The last row in sight is as clear as the others.
    ui.spacing_mut().scroll.fade.strength = 0.0;
    let mut list = ScrollArea::vertical().auto_shrink(false);
    let selected = rows.iter().position(|row| row.is_selected).unwrap_or_default();
    if let Some(offset) = offset_to_follow(ui, Id::unique("active lane"), selected, rows.len()) {
        list = list.vertical_scroll_offset(offset);
    }
    let mut pointed = None;
    list.show(ui, |ui| {
        for row in &rows {
            if show_row(ui, lab, row, &columns, width, commands) {
                pointed = Some(row.entry);
            }
        }
    });
    pointed
}

/// Shows the heads, and returns the order that a person has chosen with them.
fn head(ui: &mut Ui, lab: &Lab, columns: &[(&Column, f32, f32)], width: f32) -> Order {
    let id = Id::unique("order of the lanes");
    let mut order = ui.data(|data| data.get_temp::<Order>(id)).flatten();
    let (line, _) = ui.allocate_exact_size(vec2(width, HEAD), Sense::hover());
    for &(column, left, own) in columns {
        let place = COLUMNS.iter().position(|known| std::ptr::eq(known, column)).unwrap_or(0);
        let rect = Rect::from_min_size(
            pos2(line.left() + MARGIN + left, line.top()),
            vec2(own, line.height()),
        );
        let name = if column.head.is_empty() { "line" } else { column.head };
        let response = ui.interact(rect, Id::unique(("head", place)), Sense::click());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Button, true, format!("sort by {name}"))
        });
        let sign = sorting::sign(order, place);
        let words = match column.cell {
            Cell::Verdict => {
                let whose = row::judged_body(lab).map(|body| &lab.scene().bodies[body].name);
                let whose = whose.map(|name| format!(" ({name})")).unwrap_or_default();
                format!("{} at {} Hz{whose}", column.head, lab.clock().tick_hz())
            }
            _ => column.head.to_owned(),
        };
        let colour =
            if response.hovered() || response.has_focus() { ink(ui).accent } else { ink(ui).dim };
        let side = match column.cell {
            Cell::Number(_) => Align2::RIGHT_CENTER,
            _ => Align2::LEFT_CENTER,
        };
        let at = side.pos_in_rect(&rect);
        ui.painter().text(at, side, format!("{words}{sign}"), FontId::proportional(TYPE), colour);
        if matches!(column.cell, Cell::Verdict) && lab.mode() == Mode::Race {
            whose_numbers(ui, lab, rect, &words);
        }
        let response = response.on_hover_text(column.about);
        if response.clicked() {
            order = sorting::clicked(order, place);
            ui.data_mut(|data| data.insert_temp(id, order));
        }
    }
    order
}

/// Names the body of the numbers beside the head of the verdict, if there are several and there is room.
fn whose_numbers(ui: &Ui, lab: &Lab, rect: Rect, beside: &str) {
    let bodies = &lab.scene().bodies;
    if bodies.len() < 2 {
        return;
    }
    let font = || FontId::proportional(TYPE);
    let of = format!("{}:", bodies[lab.view().body].name);
    let room =
        |words: &str| ui.painter().layout_no_wrap(words.to_owned(), font(), ink(ui).dim).size().x;
    if room(beside) + room(&of) + 30.0 < rect.width() {
        let at = rect.right_center();
        ui.painter().text(at, Align2::RIGHT_CENTER, of, font(), ink(ui).dim);
    }
}

/// All rows in this order. The rows of a method stay together.
fn sorted(lab: &Lab, order: Order) -> Vec<Row<'_>> {
    let truth = lab.race().truth().bodies().iter().enumerate();
    let exact = |(body, truth): (usize, &LaneBody)| {
        let (q, _) = truth.halted().is_none().then(|| lab.shown_truth(body))?;
        q.first().copied()
    };
    let exact: Vec<Option<f64>> = truth.map(exact).collect();
    let methods = lab.entries().iter().enumerate();
    let mut methods: Vec<Vec<Row<'_>>> =
        methods.map(|method| Row::of_method(lab, method, &exact)).collect();
    if let Some((by, is_reversed)) = order {
        let rank = |rows: &Vec<Row<'_>>| (COLUMNS[by].rank)(&rows[0]);
        methods.sort_by(|a, b| {
            let (a, b) = (rank(a), rank(b));
            let by_rank = a.partial_cmp(&b).unwrap_or(std::cmp::Ordering::Equal);
            // Those without a value stay last.
            let is_last = [&a, &b].contains(&&Rank::Nothing);
            if is_reversed && !is_last { by_rank.reverse() } else { by_rank }
        });
    }
    methods.into_iter().flatten().collect()
}

/// Shows a row. Returns whether the pointer or the keyboard's focus is on it.
fn show_row(
    ui: &mut Ui,
    lab: &Lab,
    row: &Row<'_>,
    columns: &[(&Column, f32, f32)],
    width: f32,
    commands: &mut Vec<Command>,
) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(width, ROW), Sense::click());
    let said = row.said();
    let name = [
        Some(format!("{} {}", row.entry + 1, row.method_name())),
        row.is_of_body.then(|| lab.scene().bodies[row.body].name.clone()),
        Some(said.whole().to_owned()),
    ];
    let numbers = columns.iter().map(|(column, ..)| match column.cell {
        Cell::Number(show) => show(row).map(|words| format!("{} {words}", column.head)),
        _ => None,
    });
    let name = name.into_iter().chain(numbers).flatten().collect::<Vec<_>>().join(", ");
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::Button, true, row.is_selected, &name)
    });
    let (colour, _) = ink(ui).style(row.lab.entries(), row.spec);
    if row.is_selected || response.hovered() {
        let fill = ink(ui).raised.gamma_multiply(if row.is_selected { 1.0 } else { 0.6 });
        ui.painter().rect_filled(rect, 3.0, fill);
    }
    focus_ring(ui, &response);
    if row.is_selected {
        let bar = Rect::from_min_size(rect.min + vec2(0.0, 1.0), vec2(BAR, ROW - 2.0));
        ui.painter().rect_filled(bar, 2.0, colour);
    }
    for &(column, left, own) in columns {
        let from = pos2(rect.left() + MARGIN + left, rect.center().y);
        cell(ui, row, column, from, own, &said);
    }
    response.context_menu(|ui| menu(ui, lab, row.entry, commands));
    let is_pointed_at = response.hovered() || response.has_focus();
    if tooltip(response, row, said.whole()).clicked() {
        commands.push(match row.is_of_body {
            true => Command::Body(row.body),
            false => Command::Pick(row.entry),
        });
    }
    is_pointed_at
}

/// The menu of a row: a spring's settings in its engine, and its method as code, in each language.
pub(super) fn menu(ui: &mut Ui, lab: &Lab, entry: usize, commands: &mut Vec<Command>) {
    let has_joint = lab.joint_code(entry).is_some();
    if has_joint && ui.button("Copy the spring's settings (Ctrl C)").clicked() {
        commands.push(Command::CopyJoint(entry));
        ui.close();
    }
    for language in Language::ALL {
        let is_by_key = language == lab.viewer().language() && !has_joint;
        let key = if is_by_key { " (Ctrl C)" } else { "" };
        if ui.button(format!("Copy as {language}{key}")).clicked() {
            commands.push(Command::CopyMethod { entry, language });
            ui.close();
        }
    }
}

/// The smallest type of a cell, in points.
const MIN_TYPE: f32 = 9.0;

fn cell(ui: &Ui, row: &Row<'_>, column: &Column, from: Pos2, width: f32, said: &verdict::Said) {
    let text = if row.flown.is_some() { ink(ui).text } else { ink(ui).dim };
    let write = |words: &str, font: FontId| {
        // The longest names are written smaller rather than cut.
        let mut size = TYPE;
        let galley = loop {
            let font = FontId::new(size, font.family.clone());
            let (galley, is_whole) = short(ui, words, font, width, text);
            if is_whole || size <= MIN_TYPE {
                break galley;
            }
            size -= 0.5;
        };
        ui.painter().galley(from - vec2(0.0, galley.size().y / 2.0), galley, text);
    };
    match column.cell {
        Cell::Key if row.is_first && row.entry < 10 => {
            let colour = if row.is_selected { ink(ui).accent } else { text };
            keycap::paint(ui, from.x, from.y, &format!("{}", (row.entry + 1) % 10), colour);
        }
        Cell::Swatch if row.is_first => {
            let (strong, dash) = ink(ui).style(row.lab.entries(), row.spec);
            let colour = if row.flown.is_some() { strong } else { strong.gamma_multiply(0.7) };
            swatch(ui.painter(), from, width - 4.0, dash, colour);
        }
        Cell::Method if row.is_first => {
            let is_strong = row.entry == row.lab.active();
            let font = if is_strong { strong_font(TYPE) } else { FontId::proportional(TYPE) };
            write(&row.method_name(), font);
        }
        Cell::Key | Cell::Swatch | Cell::Method => {}
        Cell::Body => write(row.body_name().unwrap_or_default(), FontId::proportional(TYPE)),
        Cell::Verdict => {
            said.paint(ui, from, from.x + width, text);
        }
        Cell::Number(show) => {
            if let Some(words) = show(row) {
                let at = pos2(from.x + width, from.y);
                let font = FontId::proportional(TYPE);
                ui.painter().text(at, Align2::RIGHT_CENTER, words, font, text);
            }
        }
    }
}

/// The method's card and the whole verdict.
fn tooltip(response: Response, row: &Row<'_>, said: &str) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(420.0);
        let method = row.spec.method;
        ui.label(egui::RichText::new(row.method_name()).font(strong_font(TYPE)));
        ui.label(method.about);
        if !method.also.is_empty() {
            ui.label(format!("Also asked for as {}.", method.also.join(", ")));
        }
        for line in method.formula {
            ui.label(formula::job(line, 16.0, ink(ui).text));
        }
        ui.label(format!("At {} Hz: {said}.", row.lab.clock().tick_hz()));
        let order = match method.order == method.order_with_drag {
            true => format!("Order {}", method.order),
            false => format!("Order {}, {} with drag", method.order, method.order_with_drag),
        };
        let cost = match method.evaluations {
            Some(1) if method.engine.is_some_and(|engine| engine.has_substeps) => {
                "1 evaluation per tick, whatever the substeps".into()
            }
            Some(1) => "1 evaluation per step".into(),
            Some(count) => format!("{count} evaluations per step"),
            None => "as many evaluations per step as it needs".into(),
        };
        ui.label(format!("{order} · {} · {cost}", method.family.id()));
        ui.label(egui::RichText::new(method.source).color(ink(ui).dim));
    })
}

/// How far to scroll for the selected of so many rows to be seen when it becomes so, in this very frame; `None` at all
/// other times: a person may scroll away. `id` is that of the table.
pub(super) fn offset_to_follow(ui: &Ui, id: Id, selected: usize, rows: usize) -> Option<f32> {
    let known = ui.data_mut(|data| {
        let known = data.get_temp::<usize>(id);
        data.insert_temp(id, selected);
        known
    });
    let room = ui.available_height();
    let bottom = ROW * (selected + 1) as f32;
    let hidden = (ROW * rows as f32 - room).max(0.0);
    // From the top, as long as the row is in sight there: a race shows its lanes.
    let offset = if bottom <= room { 0.0 } else { bottom - (ROW + room) / 2.0 };
    (known != Some(selected)).then(|| offset.clamp(0.0, hidden))
}

#[cfg(test)]
mod tests;
