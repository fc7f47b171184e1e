//! The table of lanes: key, line, method and verdict, then numbers. In solo mode the table has only the active lane,
//! with a row for each body.

use egui::{Color32, RichText, Ui};

use super::parts::formula;
use super::table::{Table, TableRow};
use super::verdict::VerdictText;
use crate::run::MenuIndex;
use crate::run::race::{LaneBody, Mode};
use crate::studio::{
    Command, DriverRequest, StageCommand, Studio, ViewCommand, joint_code, shown_truth,
};
use crate::theme::{PanelPalette, TYPE, palette, strong_font};
use crate::tools::source_code::Language;
use row::Row;

mod columns;
mod row;
mod verdict;

/// The height of a row, in points.
pub(super) const ROW: f32 = 26.0;

/// Maximum number of rows in sight. The list scrolls to further rows.
const ROWS: usize = 8;

pub(super) fn height(studio: &Studio) -> f32 {
    height_of(match studio.mode() {
        Mode::Solo => studio.scene().bodies.len(),
        Mode::Race => studio.race().entrants().len(),
    })
}

/// Returns the height of a table of `rows` rows, of which at most `ROWS` are in sight.
pub(super) fn height_of(rows: usize) -> f32 {
    ROW * (rows.clamp(1, ROWS) + 1) as f32
}

/// Shows the table. Returns the index of the lane whose row has the pointer or the keyboard focus.
pub(super) fn show(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) -> Option<usize> {
    let mut pointed = None;
    table(studio).show(ui, groups(studio), commands, |row, response, commands| {
        response.context_menu(|ui| menu(ui, studio, row.entry, commands));
        if response.hovered() || response.has_focus() {
            pointed = Some(row.entry);
        }
    });
    pointed
}

/// Returns the verdict on the method at this index of the list.
pub(super) fn verdict_on(studio: &Studio, entry: MenuIndex) -> VerdictText {
    verdict::text_of(studio, entry, studio.deck.lane_of(entry), (None, None))
}

/// Shows the card of the method at this index of the list, and the whole verdict on it.
pub(super) fn tooltip(ui: &mut Ui, studio: &Studio, entry: MenuIndex) {
    let exact = vec![None; studio.scene().bodies.len()];
    let mut rows = Row::of_method(studio, (entry, &studio.entries()[entry]), &exact, None);
    rows[0].is_of_body = false;
    rows[0].tooltip(ui);
}

fn table(studio: &Studio) -> Table<Row<'_>> {
    let (columns, min_rest) = (columns::of(studio), columns::min_verdict);
    Table { id: "lanes", columns, min_rest, row_height: ROW, head_type: TYPE }
}

/// Returns the rows of the table, grouped by method.
fn groups(studio: &Studio) -> Vec<Vec<Row<'_>>> {
    let truth = studio.race().truth().bodies().iter().enumerate();
    let exact = |(body, truth): (usize, &LaneBody)| {
        let (q, _) = truth.halted().is_none().then(|| shown_truth(studio, body))?;
        q.first().copied()
    };
    let exact: Vec<Option<f64>> = truth.map(exact).collect();
    let judged = row::judged_body(studio);
    let is_shown = |entry: MenuIndex| studio.mode() == Mode::Race || entry == studio.active();
    studio
        .entries()
        .iter()
        .enumerate()
        .filter(|(entry, _)| is_shown(*entry))
        .map(|method| Row::of_method(studio, method, &exact, judged))
        .collect()
}

/// Shows the context menu of a row. The menu copies a spring's settings for its engine, or the method as code in each
/// language.
pub(super) fn menu(ui: &mut Ui, studio: &Studio, entry: MenuIndex, commands: &mut Vec<Command>) {
    let has_joint = joint_code(studio, entry).is_some();
    if has_joint && ui.button("Copy the spring's settings (Ctrl C)").clicked() {
        commands.push(Command::Ask(DriverRequest::CopyJoint(entry)));
        ui.close();
    }
    for language in Language::ALL {
        let is_by_key = language == studio.viewer.language() && !has_joint;
        let key = if is_by_key { " (Ctrl C)" } else { "" };
        if ui.button(format!("Copy as {language}{key}")).clicked() {
            commands.push(Command::View(ViewCommand::CopyMethod { entry, language }));
            ui.close();
        }
    }
}

impl TableRow for Row<'_> {
    fn spoken(&self) -> String {
        let name = [
            Some(format!("{} {}", self.entry + 1, self.method_name())),
            self.is_of_body.then(|| self.body_name().to_owned()),
            Some(self.verdict_text().whole().to_owned()),
        ];
        name.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    fn is_selected(&self) -> bool {
        self.is_selected
    }

    fn style(&self, palette: &PanelPalette) -> (Color32, [f32; 2]) {
        palette.style(self.studio.entries(), self.spec)
    }

    fn is_dim(&self) -> bool {
        self.entrant.is_none()
    }

    fn command(&self) -> Option<Command> {
        Some(match self.is_of_body {
            true => Command::Stage(StageCommand::Body(self.body)),
            false => Command::Stage(StageCommand::Pick(self.entry)),
        })
    }

    /// Shows the method's card and the whole verdict.
    fn tooltip(&self, ui: &mut Ui) {
        ui.set_max_width(420.0);
        let method = self.spec.method;
        ui.label(RichText::new(self.method_name()).font(strong_font(TYPE)));
        ui.label(method.about);
        if !method.also.is_empty() {
            ui.label(format!("Other ids: {}.", method.also.join(", ")));
        }
        for line in method.formula {
            ui.label(formula(line, 16.0, palette(ui).text));
        }
        let verdict = self.verdict_text();
        ui.label(format!("At {:.3} Hz: {}.", self.studio.clock().tick_hz(), verdict.whole()));
        for detail in self.details().into_iter().filter(|it| !verdict.whole().contains(&**it)) {
            ui.label(RichText::new(detail).color(palette(ui).dim));
        }
        let order = match method.order == method.order_with_drag {
            true => format!("Order {}", method.order),
            false => format!("Order {}, {} with drag", method.order, method.order_with_drag),
        };
        let has_walls = self.studio.scene().bodies.iter().any(|body| body.kind.has_walls);
        let impact = self.spec.impact;
        let bounced = impact.order(method).filter(|_| has_walls);
        let order = match bounced {
            Some(found) => format!("{order}; with this impact ({}): {found}", impact.id),
            None => order,
        };
        let cost = match method.evaluations {
            Some(1) if method.engine.is_some_and(|engine| engine.has_substeps()) => {
                "1 evaluation per tick, whatever the substeps".into()
            }
            Some(1) => "1 evaluation per step".into(),
            Some(count) => format!("{count} evaluations per step"),
            None => "as many evaluations per step as it needs".into(),
        };
        ui.label(format!("{order} · {} · {cost}", method.family.id()));
        let held = method.engine.and_then(|engine| engine.checked_against());
        for said in [Some(method.source.to_owned()), held].into_iter().flatten() {
            ui.label(RichText::new(said).color(palette(ui).dim));
        }
    }
}

#[cfg(test)]
mod tests;
