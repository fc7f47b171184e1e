//! The panels round the stage: they read the lab and return commands, and touch nothing.

use std::sync::Arc;

use egui::text::{LayoutJob, TextWrapping};
use egui::{Color32, FontId, Frame, Galley, Margin, Rect, TextFormat, Ui};

use super::theme::{Ink, colour, ink, ink_of, strong_font};
use crate::lab::{Command, Lab, Outcome, Severity};

mod advice;
mod cost;
mod footer;
mod formula;
mod guide;
mod help;
mod inspector;
mod instruments;
mod keycap;
mod lanes;
mod loops;
mod one_step;
mod opening;
mod plot_area;
mod ranges;
mod roster;
mod sorting;
mod stability_map;
mod timeline;
mod top_bar;
mod tracks;

pub(super) use instruments::{csv, svg};

/// What a frame shows beside the stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Panels {
    /// Every panel that fits.
    #[default]
    Shown,
    /// Nothing: the stage fills the frame.
    Off,
    /// The instrument alone, which fills the frame.
    Instrument,
}

/// Below these sizes, in points, a panel gives its room to the stage.
const WIDTH_FOR_INSTRUMENTS: f32 = 420.0;
const HEIGHT_FOR_TOP_BAR: f32 = 120.0;
const HEIGHT_FOR_LANES: f32 = 260.0;
const HEIGHT_FOR_FOOTER: f32 = 200.0;
const HEIGHT_FOR_TIMELINE: f32 = 420.0;
const HEIGHT_FOR_TIMES: f32 = 560.0;

/// The part of the width that the instruments take.
const INSTRUMENTS: f32 = 0.38;

/// The part of their height that the inspector takes at first, the height in points from which on it leaves them some,
/// and the least that either has.
const INSPECTOR: f32 = 0.62;
const HEIGHT_FOR_INSPECTOR_BELOW: f32 = 330.0;
const LEAST_BESIDE: f32 = 110.0;

/// Shows all panels. Returns what was asked for and the rectangle left for the stage, in points.
pub(super) fn show(ui: &mut Ui, lab: &Lab) -> (Vec<Command>, Rect) {
    let mut commands = Vec::new();
    let size = ui.max_rect().size();
    if size.y >= HEIGHT_FOR_TOP_BAR {
        let panel =
            egui::Panel::top("top bar").exact_size(top_bar::HEIGHT).frame(frame(ink(ui).panel));
        panel.show(ui, |ui| top_bar::show(ui, lab, &mut commands));
    }
    if size.y >= HEIGHT_FOR_FOOTER {
        let panel =
            egui::Panel::bottom("footer").exact_size(footer::HEIGHT).frame(frame(ink(ui).panel));
        panel.show(ui, |ui| footer::show(ui, lab, &mut commands));
    }
    let mut pointed = None;
    if size.y >= HEIGHT_FOR_LANES {
        let height = lab.loop_lab().map_or_else(|| lanes::height(lab), loops::table::height);
        let height = height.min(size.y * 0.4);
        // Without a margin: a row reaches from edge to edge.
        let frame = Frame::new().fill(ink(ui).panel);
        let panel = egui::Panel::bottom("lanes").exact_size(height).frame(frame);
        panel.show(ui, |ui| match lab.loop_lab() {
            Some(loops) => loops::table::show(ui, loops, &mut commands),
            None => pointed = lanes::show(ui, lab, &mut commands),
        });
    }
    if pointed != lab.viewer().pointed_lane() {
        commands.push(Command::PointAt(pointed));
    }
    if size.y >= HEIGHT_FOR_TIMELINE {
        let height = match size.y >= HEIGHT_FOR_TIMES {
            true => timeline::HEIGHT,
            false => timeline::HEIGHT_OF_TRACK,
        };
        let frame = frame(ink(ui).panel).inner_margin(Margin::symmetric(8, 1));
        let panel = egui::Panel::bottom("timeline").exact_size(height).frame(frame);
        panel.show(ui, |ui| match lab.loop_lab() {
            Some(loops) => loops::slider::show(ui, loops, &mut commands),
            None => timeline::show(ui, lab, &mut commands),
        });
    }
    if size.x >= WIDTH_FOR_INSTRUMENTS {
        let width = if lab.display().enlarged { size.x } else { size.x * INSTRUMENTS };
        let panel =
            egui::Panel::right("instruments").exact_size(width).frame(frame(ink(ui).background));
        panel.show(ui, |ui| {
            // The panel is as wide as what is in it.
            ui.set_min_size(ui.available_size());
            beside_the_stage(ui, lab, &mut commands);
        });
    }
    if let Some(tour) = lab.viewer().tour() {
        let height = guide::HEIGHT.min(ui.available_height() * 0.6);
        let frame = Frame::new().fill(ink(ui).panel).inner_margin(Margin::symmetric(14, 8));
        let panel = egui::Panel::bottom("guide").exact_size(height).frame(frame);
        panel.show(ui, |ui| guide::show(ui, tour, &mut commands));
    }
    let stage = ui.available_rect_before_wrap();
    if lab.display().help {
        help::show(ui, &mut commands);
    }
    if let Some(dialog) = lab.viewer().dialog() {
        opening::show(ui, lab, dialog, &mut commands);
    }
    (commands, stage)
}

/// Shows the instrument alone.
pub(super) fn show_instrument(ui: &mut Ui, lab: &Lab) {
    let frame = Frame::new().fill(ink(ui).background).inner_margin(Margin::symmetric(8, 4));
    let panel = egui::CentralPanel::default_margins().frame(frame);
    panel.show(ui, |ui| instruments::show(ui, lab, &mut Vec::new()));
}

/// The instruments; with the inspector open they keep the upper part, where there is room for both.
fn beside_the_stage(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let height = ui.available_height();
    if !lab.display().inspector || lab.display().enlarged {
        instruments::show(ui, lab, commands);
    } else if height < HEIGHT_FOR_INSPECTOR_BELOW {
        inspector::show(ui, lab, commands);
    } else {
        let panel = egui::Panel::bottom("inspector").default_size(height * INSPECTOR);
        let panel = panel.size_range(LEAST_BESIDE..=height - LEAST_BESIDE).resizable(true);
        let frame = Frame::new().inner_margin(Margin { top: 6, ..Margin::ZERO });
        panel.frame(frame).show(ui, |ui| inspector::show(ui, lab, commands));
        instruments::show(ui, lab, commands);
    }
}

fn frame(fill: Color32) -> Frame {
    Frame::new().fill(fill).inner_margin(Margin::symmetric(8, 4))
}

/// Words in one line of this width, with an ellipsis where they do not fit, and whether they fit.
fn short(ui: &Ui, words: &str, font: FontId, room: f32, colour: Color32) -> (Arc<Galley>, bool) {
    let mut job = LayoutJob::single_section(words.to_owned(), TextFormat::simple(font, colour));
    job.wrap = TextWrapping::truncate_at_width(room.max(0.0));
    let galley = ui.painter().layout_job(job);
    let is_whole = !galley.elided;
    (galley, is_whole)
}

/// The colour of a verdict.
fn tone(ui: &Ui, word: Outcome) -> Color32 {
    severity_tone(ui, word.severity())
}

/// The colour of a severity.
fn severity_tone(ui: &Ui, severity: Severity) -> Color32 {
    match severity {
        Severity::Fine => ink(ui).good,
        Severity::Doubtful => ink(ui).warn,
        Severity::Bad => ink(ui).bad,
        Severity::Unknown => ink(ui).dim,
    }
}
