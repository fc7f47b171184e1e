//! Advice on the method for the scene at its tick rate: one recommendation, its source code, and a table of the
//! findings on every method.

use std::sync::Arc;

use egui::{
    Align, Color32, ComboBox, FontId, Id, Label, Layout, Rect, Response, RichText, ScrollArea, Ui,
    UiBuilder, vec2,
};

use super::breakpoints;
use super::parts::{is_picture, tone};
use super::table::{Column, GAP, MARGIN, SortKey, Table, TableRow, show_name};
use crate::measure::{
    Advice, AdvisedBodies, CRITERIA, Criterion, CriterionMet, CriterionResult,
    MAX_ADVISED_SUBSTEPS, MethodAdvice, PassedOver, Recommendation,
};
use crate::scene::LaneSpec;
use crate::stage::number::{counted, significant};
use crate::studio::{Command, RunCommand, Studio, ViewCommand};
use crate::theme::{PanelPalette, TYPE, palette, strong_font};
use crate::tools::source_code::{Language, Precision, function_code};

/// Notes above the table, with and without room for evaluations in its cells.
const CELLS: [&str; 2] = [
    "click a cell to use it: substeps per tick · force evaluations per second",
    "click a cell to use it: substeps per tick",
];
/// Font size of the table, in points.
const SMALL: f32 = 11.5;
/// Height of a line, gap between two columns, and minimum width of the column of method names, in points.
const LINE: f32 = 20.0;
const APART: f32 = 6.0;
const MIN_NAME: f32 = 120.0;
/// Share of the height below the recommendation for the source code.
const CODE_PART: f32 = 0.5;
/// Width of the name of the criterion beside the recommendation, in points.
const CRITERION: f32 = 76.0;

pub(super) fn show(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing.y = 2.0;
    which_bodies(ui, studio, commands);
    let Some(advice) = studio.viewer.advice() else {
        cut_line(ui, RichText::new("judging every method …").color(palette(ui).dim));
        return;
    };
    let best = advice.to_take();
    show_recommendation(ui, studio, advice, commands);
    ui.separator();
    if advice.is_decided && ui.available_height() >= breakpoints::CODE && !is_picture(ui) {
        let taken = best.and_then(|(row, criterion)| {
            let MethodAdvice { spec, met, .. } = &advice.advised[row];
            Some(LaneSpec { substeps: met[criterion].met()?.substeps, ..*spec })
        });
        code(ui, studio, taken.unwrap_or(studio.selected().spec));
        ui.separator();
    }
    let whose = match advice.bodies {
        AdvisedBodies::All if studio.scene().bodies.len() > 1 => ", all bodies",
        _ => "",
    };
    table(ui, advice, whose, best, commands);
}

/// Shows the choice between all bodies and the selected one, if the scene has several bodies.
fn which_bodies(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let bodies = &studio.scene().bodies;
    if bodies.len() < 2 || is_picture(ui) {
        return;
    }
    let display = studio.display();
    ui.horizontal(|ui| {
        for (is_one, name) in [
            (true, format!("{} alone", bodies[studio.view().body].name)),
            (false, format!("all {} bodies", bodies.len())),
        ] {
            let is_chosen = display.advises_on_one_body == is_one;
            let choice = ui.selectable_label(is_chosen, RichText::new(name).size(SMALL));
            if choice.on_hover_text("the bodies to advise on").clicked() {
                commands.push(Command::View(ViewCommand::AdviseOnOneBody(is_one)));
            }
        }
    });
}

/// Shows a line of text, truncated where it would widen the panel.
fn cut_line(ui: &mut Ui, text: RichText) -> Response {
    ui.add(Label::new(text).truncate())
}

/// Lays out content at the left of a slot of this width, and clips it at the right.
fn in_slot<R>(ui: &mut Ui, width: f32, content: impl FnOnce(&mut Ui) -> R) -> R {
    let layout = Layout::left_to_right(Align::Center);
    let place = ui.allocate_ui_with_layout(vec2(width, LINE), layout, |ui| {
        ui.set_min_width(width);
        content(ui)
    });
    place.inner
}

/// Recommends one method once the search has ended. Until then no name and no button is shown, because another method
/// may take its place.
fn show_recommendation(ui: &mut Ui, studio: &Studio, advice: &Advice, commands: &mut Vec<Command>) {
    let (done, wanted, hz) = (advice.advised.len(), advice.wanted, advice.tick_hz);
    let told = match advice.is_decided {
        true => format!("At {hz:.3} Hz, take:"),
        false if done < wanted => format!("At {hz:.3} Hz: {done} of {wanted} methods judged …"),
        false => format!("At {hz:.3} Hz: searching reserves …"),
    };
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            language_menu(ui, studio, commands);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                cut_line(ui, RichText::new(told).color(palette(ui).dim));
            });
        });
    });
    if !advice.is_decided {
        return;
    }
    let taken = advice.to_take().and_then(|(row, criterion)| {
        let advised = &advice.advised[row];
        Some((advised, criterion, advised.met[criterion].met()?))
    });
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = APART;
        let Some((advised, criterion, met)) = taken else {
            let is_missed = |row: &MethodAdvice| row.met.contains(&CriterionResult::No);
            let none = match advice.advised.iter().all(is_missed) {
                true => format!("none with up to {MAX_ADVISED_SUBSTEPS} substeps"),
                false => "not known".into(),
            };
            cut_line(ui, RichText::new(none).color(palette(ui).text));
            return;
        };
        let name = RichText::new(CRITERIA[criterion].name()).color(palette(ui).dim);
        in_slot(ui, CRITERION, |ui| cut_line(ui, name)).on_hover_text(CRITERIA[criterion].about());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            copy_button(ui, studio, advised.spec, commands);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let recommendation = Recommendation::of(&advice.advised, criterion);
                let instead_of = recommendation.and_then(|it| it.instead_of);
                let colour = tone(ui, advised.outcome_with(met.substeps));
                taken_line(ui, (advised.spec.method.name, colour), met, instead_of.as_ref());
            });
        });
    });
}

/// Shows a method and its substeps in this colour, with a mark if the substeps leave no reserve. The name is truncated
/// to leave room for the substeps and the mark. The tooltip names a cheaper method that was passed over.
fn taken_line(
    ui: &mut Ui,
    (name, colour): (&str, Color32),
    met: &CriterionMet,
    instead_of: Option<&PassedOver>,
) {
    let font = strong_font(TYPE);
    let strong = |words: &str| RichText::new(words).font(font.clone()).color(colour);
    let width =
        |words: &str| ui.painter().layout_no_wrap(words.to_owned(), font.clone(), colour).size().x;
    let room =
        |substeps: &str| ui.available_width() - width(substeps) - ui.spacing().item_spacing.x;
    let marks: &[&str] = if met.has_no_reserve() { &[" (only just)", " !"] } else { &[""] };
    let marked = |mark: &&str| format!("×{}{mark}", met.substeps);
    let mut substeps = marks.iter().map(marked);
    let fits = substeps.clone().find(|substeps| width(name) <= room(substeps));
    let substeps = fits.or_else(|| substeps.next_back()).expect("there is a mark");
    let room = room(&substeps);
    let (name_width, name, substeps) = (width(name).min(room), strong(name), strong(&substeps));
    let reason = instead_of.map_or(String::new(), |passed_over| format!("; {passed_over}"));
    let about = cell_tooltip(met) + &reason;
    in_slot(ui, name_width, |ui| cut_line(ui, name)).on_hover_text(&about);
    cut_line(ui, substeps).on_hover_text(about);
}

/// Shows the menu of programming languages in which methods are copied.
fn language_menu(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let chosen = studio.viewer.language();
    let text = RichText::new(format!("code: {chosen}")).size(SMALL);
    let menu = ComboBox::from_id_salt("language").selected_text(text).width(92.0);
    let response = menu.show_ui(ui, |ui| {
        for language in Language::ALL {
            if ui.selectable_label(language == chosen, language.name()).clicked() {
                commands.push(Command::View(ViewCommand::Language(language)));
            }
        }
    });
    response.response.on_hover_text("the language in which methods are copied");
}

/// Shows a button that copies a method as source code.
fn copy_button(ui: &mut Ui, studio: &Studio, spec: LaneSpec, commands: &mut Vec<Command>) {
    let place = studio.entries().iter().position(|entry| entry.method == spec.method);
    let Some(entry) = place.filter(|_| !is_picture(ui)) else { return };
    let language = studio.viewer.language();
    let about = format!("copy {} as {language}", spec.method.name);
    let word = match ui.available_width() < breakpoints::COPY_CODE {
        true => "Copy".to_owned(),
        false => format!("Copy {language}"),
    };
    let response = ui.button(RichText::new(word).size(SMALL)).on_hover_text(&about);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &about));
    if response.clicked() {
        commands.push(Command::View(ViewCommand::CopyMethod { entry, language }));
    }
    response.context_menu(|ui| super::lanes::menu(ui, studio, entry, commands));
}

/// Shows a method as source code, and the number of its calls at this tick rate.
fn code(ui: &mut Ui, studio: &Studio, spec: LaneSpec) {
    let language = studio.viewer.language();
    let id = Id::unique(("code", spec.method.id, language.id()));
    let known = ui.data(|data| data.get_temp::<Arc<str>>(id));
    let text = known.unwrap_or_else(|| {
        let code = function_code(spec.method, language, Precision::Double);
        let text: Arc<str> = code.unwrap_or_else(|refused| refused.to_string()).into();
        ui.data_mut(|data| data.insert_temp(id, Arc::clone(&text)));
        text
    });
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let hz = studio.clock().tick_hz().scaled(spec.substeps, 1);
            let calls = counted(spec.substeps, "call");
            let called = format!("{}: {calls} a tick, h = 1/{hz:.3} s", spec.method.name);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                cut_line(ui, RichText::new(called).color(palette(ui).text));
            });
        });
    });
    let height = CODE_PART * ui.available_height();
    let scrolled = ScrollArea::both().id_salt("code").max_height(height).auto_shrink([false, true]);
    scrolled.show(ui, |ui| {
        ui.add(Label::new(RichText::new(text.trim_start()).monospace().size(SMALL)).extend());
    });
}

/// Returns the width of a criterion's column, in points, which is that of its widest cell. Also returns whether the
/// cells can show evaluations and still leave room for the names of the methods.
fn cell_width(ui: &Ui, advice: &Advice, room: f32) -> (f32, bool) {
    let width = |words: &str| {
        let font = FontId::proportional(SMALL);
        ui.painter().layout_no_wrap(words.to_owned(), font, palette(ui).text).size().x
    };
    let padding = 2.0 * ui.spacing().button_padding.x + 2.0;
    let head = CRITERIA.iter().map(|criterion| width(criterion.name())).fold(0.0, f32::max);
    let met = || advice.advised.iter().flat_map(|row| &row.met).filter_map(CriterionResult::met);
    let widest = |has_rates: bool| {
        let cells = met().map(|met| width(&cell_text(met, has_rates)) + padding);
        cells.fold(head, f32::max)
    };
    let with_rates = widest(true);
    let beside = room - 2.0 * MARGIN - GAP - CRITERIA.len() as f32 * (with_rates + GAP);
    let has_rates = beside >= MIN_NAME;
    (if has_rates { with_rates } else { widest(false) }, has_rates)
}

/// Shows the table of findings on each method. `whose` names the bodies whose evaluations are counted.
fn table(
    ui: &mut Ui,
    advice: &Advice,
    whose: &str,
    best: Option<(usize, usize)>,
    commands: &mut Vec<Command>,
) {
    let (width, has_rates) = cell_width(ui, advice, ui.available_width());
    let (cells, whose) = if has_rates { (CELLS[0], whose) } else { (CELLS[1], "") };
    cut_line(ui, RichText::new(format!("{cells}{whose}")).size(SMALL).color(palette(ui).dim));
    let name = Column::shown(
        "method",
        0.0,
        "the row's verdict is in its tooltip",
        |ui, row: &Row<'_>, rect, _| {
            let MethodAdvice { spec, verdict, .. } = row.advised;
            show_name(ui, rect, spec.method.name, tone(ui, verdict.outcome()));
        },
        |row| SortKey::Words(row.advised.spec.method.name.into()),
    );
    let criterion = |(i, criterion): (usize, &Criterion)| {
        Column::shown(
            criterion.name(),
            width,
            criterion.about(),
            move |ui, row: &Row<'_>, rect, commands| row.cell(ui, i, rect, commands),
            move |row| row.advised.met[i].met().map(|met| met.evaluations_per_s).into(),
        )
    };
    let criteria = CRITERIA.iter().enumerate().map(criterion);
    let columns = [name].into_iter().chain(criteria).collect();
    let row = |(index, advised)| vec![Row { advised, index, best, has_rates }];
    let rows = advice.advised.iter().enumerate().map(row).collect();
    let min_rest = |_| 0.0;
    let table = Table { id: "advice", columns, min_rest, row_height: LINE, head_type: SMALL };
    ui.spacing_mut().button_padding.y = 1.0;
    ui.spacing_mut().interact_size.y = LINE;
    table.show(ui, rows, commands, |_, _, _| {});
}

/// A row of the table: the findings on a method.
struct Row<'a> {
    advised: &'a MethodAdvice,
    index: usize,
    /// The recommended method and the criterion that it meets.
    best: Option<(usize, usize)>,
    has_rates: bool,
}

impl Row<'_> {
    /// Shows the substeps that the method needs to meet a criterion. A click applies them.
    fn cell(&self, ui: &mut Ui, criterion: usize, rect: Rect, commands: &mut Vec<Command>) {
        let MethodAdvice { spec, met, .. } = self.advised;
        let mut ui = ui.new_child(
            UiBuilder::new().max_rect(rect).layout(Layout::left_to_right(Align::Center)),
        );
        let dim = |words: &str| RichText::new(words).color(palette(&ui).dim);
        let met = match &met[criterion] {
            CriterionResult::With(met) => met,
            CriterionResult::No => {
                let missed = format!("not with {MAX_ADVISED_SUBSTEPS} substeps");
                ui.label(dim("-")).on_hover_text(missed);
                return;
            }
            CriterionResult::Unknown => {
                ui.label(dim("?"))
                    .on_hover_text("not known: no exact motion to compare with, or too much work");
                return;
            }
        };
        let is_best = self.best == Some((self.index, criterion));
        let of_lane = tone(&ui, self.advised.outcome_with(met.substeps));
        let colour = if is_best { of_lane } else { palette(&ui).text };
        let text = cell_text(met, self.has_rates);
        let used = ui.button(RichText::new(text).color(colour).size(SMALL));
        let name = format!("{}: {}", CRITERIA[criterion].name(), spec.method.name);
        used.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        if used.on_hover_text(format!("use this: {}", cell_tooltip(met))).clicked() {
            commands.push(Command::Run(RunCommand::SetLane(LaneSpec {
                substeps: met.substeps,
                ..*spec
            })));
        }
    }
}

impl TableRow for Row<'_> {
    fn spoken(&self) -> String {
        format!("{}, {}", self.advised.spec.method.name, self.advised.verdict)
    }

    fn is_selected(&self) -> bool {
        false
    }

    fn style(&self, palette: &PanelPalette) -> (Color32, [f32; 2]) {
        (palette.accent, [1.0, 0.0])
    }

    fn command(&self) -> Option<Command> {
        None
    }

    fn tooltip(&self, ui: &mut Ui) {
        ui.label(self.advised.verdict.to_string());
    }
}

/// Returns the text in the cell of a method that meets a criterion.
fn cell_text(met: &CriterionMet, has_rates: bool) -> String {
    let substeps = met.substeps;
    match has_rates {
        true => format!("×{substeps} · {}/s", whole(met.evaluations_per_s)),
        false => format!("×{substeps}"),
    }
}

/// Returns the tooltip of a cell.
fn cell_tooltip(met: &CriterionMet) -> String {
    format!(
        "{} a tick, {} evaluations per simulated second; {}",
        counted(met.substeps, "substep"),
        whole(met.evaluations_per_s),
        met.margins(),
    )
}

/// Formats a count. A large count is rounded to three digits.
fn whole(count: f64) -> String {
    if count < 1e5 { format!("{}", count.round()) } else { significant(count, 3) }
}

#[cfg(test)]
mod tests;
