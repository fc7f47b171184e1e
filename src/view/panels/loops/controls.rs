//! Controls of the loop lab in the top bar. They set the trace, and show the moment and the simulated display.

use egui::{ComboBox, RichText, TextWrapMode, Ui};

use crate::loops::loop_lab::{LoopCommand, LoopLab};
use crate::loops::{ENGINES, FrameTrace, TRACES};
use crate::panels::breakpoints;
use crate::stage::number::round;
use crate::studio::Command;
use crate::theme::palette;

/// Maximum number of characters of a trace's name in the closed menu.
const MAX_CHARS: usize = 18;
/// Length of a trace's name from which there is no room for the number of the frame, in characters.
const LONG_NAME: usize = 14;

/// Whether the top bar has the menu of traces.
pub(in crate::panels) fn has_trace_menu_above(ui: &Ui) -> bool {
    ui.ctx().content_rect().width() >= breakpoints::MENU_OF_TRACES
}

/// Formats the speed of a slow motion.
pub(in crate::panels) fn speed(slowness: u32) -> String {
    match slowness {
        1 => "1×".into(),
        2 => "½×".into(),
        4 => "¼×".into(),
        8 => "⅛×".into(),
        slower => format!("1/{slower}×"),
    }
}

/// Shortens a trace's name for the closed menu.
fn short_name(name: &str) -> String {
    match name.chars().count() {
        0..=MAX_CHARS => name.into(),
        _ => name.chars().take(MAX_CHARS - 1).chain(['…']).collect(),
    }
}

/// Returns the description of a trace.
fn about_trace(trace: &FrameTrace) -> String {
    let built_in = TRACES.iter().find(|card| card.id == trace.name());
    let about = built_in.map_or("frames from a file", |card| card.about);
    let missing = trace.missing_display();
    about.to_owned() + &missing.map_or(String::new(), |missing| format!("; {missing}"))
}

pub(in crate::panels) fn trace_menu(ui: &mut Ui, loops: &LoopLab, commands: &mut Vec<Command>) {
    let trace = loops.chosen_trace();
    let chosen = trace.name();
    let menu = ComboBox::from_id_salt("trace").selected_text(short_name(chosen)).width(112.0);
    let menu = menu.height(480.0);
    let response = menu.show_ui(ui, |ui| {
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        for (index, trace) in loops.traces().iter().enumerate() {
            let is_chosen = index == loops.trace();
            let label = ui.selectable_label(is_chosen, trace.name());
            if label.on_hover_text(about_trace(trace)).clicked() {
                commands.push(Command::Loop(LoopCommand::Trace(index)));
            }
        }
    });
    let about = format!("{chosen}, frames of the display (T for the next): {}", about_trace(trace));
    response.response.on_hover_text(about);
}

/// Shows the menu of engines, each with its version and what to beware of.
pub(in crate::panels) fn engine_menu(ui: &mut Ui, loops: &LoopLab, commands: &mut Vec<Command>) {
    let chosen = loops.engine().map_or("your engine", |card| &card.id);
    let menu = ComboBox::from_id_salt("engine").selected_text(short_name(chosen)).width(112.0);
    let response = menu.height(480.0).show_ui(ui, |ui| {
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        for (index, card) in ENGINES.iter().enumerate() {
            let (Some(engine), is_chosen) = (&card.engine, card.id == chosen) else { continue };
            let text = format!("{} {}", card.name, engine.version);
            let label = ui.selectable_label(is_chosen, text);
            if label.on_hover_text(format!("{}; set: {}", engine.caveat, engine.advice)).clicked() {
                commands.push(Command::Loop(LoopCommand::Engine(index)));
            }
        }
    });
    response.response.on_hover_text("the loop of your engine beside the others, to the tick");
}

/// Formats the moment of display, in full or short enough for a narrow bar.
pub(in crate::panels) fn moment(loops: &LoopLab, is_wide: bool) -> String {
    let t_s = loops.now_ns() as f64 / 1e9;
    let frame = loops.lanes()[loops.selected()].frame_at(loops.now_ns()).unwrap_or_default();
    let is_long = loops.chosen_trace().name().chars().count() > LONG_NAME;
    match (is_wide, is_long) {
        (true, false) => format!("t = {t_s:.3} s · frame {frame}"),
        (true, true) => format!("t = {t_s:.3} s"),
        (false, _) => format!("{t_s:.3} s"),
    }
}

/// Shows the refresh rate of the simulated display.
pub(in crate::panels) fn display(ui: &mut Ui, loops: &LoopLab) {
    let hz = round(loops.chosen_trace().refresh().hz(), 4);
    let text = RichText::new(format!("{hz} Hz display, simulated")).color(palette(ui).dim);
    ui.label(text).on_hover_text("nothing here depends on the display of this computer");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loops::loop_lab::SLOWNESS;
    use crate::loops::{RefreshRate, trace_file};

    #[test]
    fn slow_motions_are_named_by_their_fraction() {
        let names: Vec<String> = SLOWNESS.into_iter().map(speed).collect();
        assert_eq!(names, ["1×", "½×", "¼×", "⅛×", "1/16×", "1/32×"]);
    }

    #[test]
    fn a_long_trace_name_takes_no_extra_room() {
        assert!(TRACES.iter().all(|card| short_name(card.id) == card.id));
        assert_eq!(short_name("log.csv:PresentBench.exe-24892"), "log.csv:PresentBe…");
    }

    #[test]
    fn every_trace_has_a_description() {
        let display = RefreshRate::new(60, 1);
        assert!(TRACES.iter().all(|card| about_trace(&card.trace(display)) == card.about));
        let list = trace_file::read("times.txt", "16.7\n16.6\n").unwrap();
        assert!(about_trace(&list[0]).contains("counts as shown when it begins"));
    }
}
