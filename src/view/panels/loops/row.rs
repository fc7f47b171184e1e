//! A row of the table of loops.

use egui::{Color32, Rect, RichText, Sense, Shape, Stroke, Ui, vec2};

use crate::loops::loop_lab::{LoopCommand, LoopLab, LoopLane};
use crate::measure::Severity;
use crate::panels::table::TableRow;
use crate::panels::verdict::VerdictText;
use crate::studio::Command;
use crate::theme::{PanelPalette, TYPE, palette, strong_font};

/// A loop of the lab, in the table and in the charts.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    pub(super) loops: &'a LoopLab,
    pub(super) index: usize,
}

impl<'a> Row<'a> {
    pub(super) fn lane(&self) -> &'a LoopLane {
        &self.loops.lanes()[self.index]
    }

    pub(super) fn name(&self) -> &'a str {
        &self.lane().card().name
    }

    pub(super) fn is_on_stage(&self) -> bool {
        self.loops.on_stage().contains(&self.index)
    }

    pub(super) fn verdict_text(&self) -> VerdictText {
        let verdict = self.loops.verdict(self.index);
        let rank = match verdict.severity {
            Severity::Fine | Severity::Fair => Some(0.0),
            Severity::Doubtful => Some(1.0),
            Severity::Bad => Some(2.0),
            Severity::Unknown => None,
        };
        let sign = Some((verdict.severity.sign(), verdict.severity));
        VerdictText { sign, is_current: true, wordings: verdict.wordings(), rank }
    }

    /// Shows an eye that is open if the loop is on the stage. A click on the eye takes the loop off the stage or brings
    /// it on.
    pub(super) fn eye(&self, ui: &Ui, rect: Rect, commands: &mut Vec<Command>) {
        let id = egui::Id::unique(("loop on the stage", self.index));
        let response = ui.interact(rect, id, Sense::click());
        let name = format!("{} on the stage", self.name());
        let is_on = self.is_on_stage();
        response
            .widget_info(|| egui::WidgetInfo::selected(egui::Role::CheckBox, true, is_on, &name));
        let is_lit = response.hovered() || response.has_focus();
        let inked = match (is_lit, is_on) {
            (true, _) => palette(ui).accent,
            (false, true) => self.style(palette(ui)).0,
            (false, false) => palette(ui).dim.gamma_multiply(0.55),
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
            commands.push(Command::Loop(LoopCommand::ToggleOnStage(self.index)));
        }
    }
}

impl TableRow for Row<'_> {
    fn spoken(&self) -> String {
        format!("{} {}, {}", self.index + 1, self.name(), self.verdict_text().whole())
    }

    fn is_selected(&self) -> bool {
        self.index == self.loops.selected()
    }

    fn style(&self, palette: &PanelPalette) -> (Color32, [f32; 2]) {
        palette.loop_style(self.index)
    }

    fn is_dim(&self) -> bool {
        !self.is_on_stage()
    }

    fn command(&self) -> Option<Command> {
        Some(Command::Loop(LoopCommand::Select(self.index)))
    }

    /// Shows the loop's card and its verdict.
    fn tooltip(&self, ui: &mut Ui) {
        ui.set_max_width(440.0);
        let card = self.lane().card();
        ui.label(RichText::new(&card.name).font(strong_font(TYPE)));
        ui.label(&card.formula);
        if !card.constants.is_empty() {
            ui.label(format!("Constants: {}.", card.constants));
        }
        ui.label(format!("Odd frames: {}.", card.odd_frames));
        let display = self.loops.chosen_trace().name();
        let tick_hz = self.loops.scene().tick_hz;
        ui.label(format!("At {tick_hz:.3} Hz, trace {display}: {}.", self.verdict_text().whole()));
        let advised = self.loops.advised().filter(|advised| advised.index == self.index);
        if let Some(why) = advised.and_then(|advised| advised.why) {
            ui.label(format!("Recommended: {why}."));
        }
        ui.label(format!("Used by {}.", card.users));
        ui.label(RichText::new(&card.source).color(palette(ui).dim));
    }
}
