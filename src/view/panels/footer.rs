//! The status line at the bottom of the window: the last notice or a hint, and a few keys.

use egui::{Align, Layout, Sense, Ui, vec2};

use super::parts::short;
use super::{breakpoints, keycap, lanes, loops};
use crate::loops::loop_lab::LoopCommand;
use crate::run::race::Mode;
use crate::stage::number::round;
use crate::studio::{Command, RunCommand, StageCommand, Studio, ViewCommand};
use crate::theme::{TYPE, palette};

pub(super) const HEIGHT: f32 = 32.0;

/// The room between two hints, in points.
const GAP: f32 = 16.0;

/// A key, the name of its effect, and its command.
type KeyHint = (&'static str, String, Option<Command>);

pub(super) fn show(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let width = ui.available_width();
    let (parts, is_hint) = status_parts(studio);
    let sentence = fitting_text(ui, &parts, width);
    let room_for_hint = keycap::line_width(ui, &sentence) + GAP;
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        if width >= breakpoints::KEYS_BESIDE_HINT {
            // The hints are laid out from the right, and the last ones are left out if there is no room.
            for hint in key_hints(studio) {
                if ui.available_width() - width_of(ui, &hint) < room_for_hint {
                    break;
                }
                show_hint(ui, hint, commands);
            }
        }
        let room = ui.available_width();
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let colour = if is_hint { palette(ui).text } else { palette(ui).dim };
            keycap::line(ui, &sentence, room, colour, Some(commands));
        });
    });
}

/// Returns the parts of the notice, or else of the hint, or else the scene's description. Also returns whether the
/// parts are a notice or a hint.
fn status_parts(studio: &Studio) -> (Vec<String>, bool) {
    if let Some(notice) = &studio.viewer.notice {
        return (notice.parts().to_vec(), true);
    }
    if let Some(loops) = studio.loop_lab()
        && studio.viewer.tour().is_none()
    {
        return (loops::hints::parts(loops), true);
    }
    match studio.hint() {
        Some(hint) => (vec![hint], true),
        None => (vec![studio.scene().about.clone()], false),
    }
}

/// Returns the verdict on the active method, and the text of the status line, as sentences for a screen reader.
pub(crate) fn spoken(studio: &Studio) -> String {
    let verdict = lanes::verdict_on(studio, studio.active());
    let is_known = studio.loop_lab().is_none() && verdict.sign.is_some();
    let name = studio.lane_name(studio.active());
    let verdict = is_known.then(|| format!("{name}: {}.", verdict.whole()));
    let line = keycap::without_backticks(&status_parts(studio).0.join("; "));
    verdict.into_iter().chain([line]).collect::<Vec<_>>().join(" ")
}

/// Joins as many parts as fit this width, but at least the first one.
fn fitting_text(ui: &Ui, parts: &[String], width: f32) -> String {
    let mut sentences = (1..=parts.len()).rev().map(|count| parts[..count].join("; "));
    let fits = |sentence: &String| keycap::line_width(ui, sentence) <= width;
    sentences.find(fits).unwrap_or_else(|| parts[0].clone())
}

/// Returns two hints from right to left: the help and the next step.
fn key_hints(studio: &Studio) -> [KeyHint; 2] {
    let hint = |key, what: &str, command| (key, what.to_owned(), Some(command));
    let next = if let Some(input) = input_in_use(studio) {
        input
    } else if studio.loop_lab().is_some() {
        hint("L", "leave the lab", Command::Loop(LoopCommand::ToggleLab))
    } else if studio.deck.lost_at().is_some() {
        hint("W", "watch again", Command::Run(RunCommand::WatchAgain))
    } else if !studio.bands().is_empty() {
        hint("Shift G", "figures", Command::View(ViewCommand::ToggleFigures))
    } else if !studio.display().measure {
        hint("T", "measure", Command::View(ViewCommand::ToggleMeasure))
    } else {
        let what = if studio.mode() == Mode::Solo { "race" } else { "solo" };
        hint("C", what, Command::Stage(StageCommand::ToggleRace))
    };
    [hint("H", "all keys", Command::View(ViewCommand::ToggleHelp)), next]
}

/// Returns the first input that the displayed body has or that is in use.
fn input_in_use(studio: &Studio) -> Option<KeyHint> {
    let inputs = [
        ("throttle", "↑ ↓", studio.race().throttle(), 1.0),
        ("rudder", "← →", studio.race().rudder(), 0.0),
    ];
    let shown = &studio.scene().bodies[studio.view().body].kind;
    let mut told = inputs.into_iter().filter(|(input, _, part, at_start)| {
        let is_in_use = shown.inputs.contains(input) || part != at_start;
        studio.loop_lab().is_none() && studio.race().takes_input(input) && is_in_use
    });
    told.next()
        .map(|(input, key, part, _)| (key, format!("{input} {} %", round(part * 100.0, 3)), None))
}

fn width_of(ui: &Ui, (key, what, _): &KeyHint) -> f32 {
    keycap::line_width(ui, &format!("`{key}` {what}")) + GAP
}

/// Shows a hint. A click on the hint has the same effect as its key.
fn show_hint(ui: &mut Ui, hint: KeyHint, commands: &mut Vec<Command>) {
    let size = vec2(width_of(ui, &hint), keycap::HEIGHT);
    let (key, what, command) = hint;
    let sense = if command.is_some() { Sense::click() } else { Sense::hover() };
    let (rect, response) = ui.allocate_exact_size(size, sense);
    response.widget_info(|| {
        let role = if command.is_some() { egui::Role::Button } else { egui::Role::Label };
        egui::WidgetInfo::labeled(role, true, format!("{what} ({key})"))
    });
    let lit = response.hovered() && command.is_some() || response.has_focus();
    let (box_colour, colour) = if lit {
        (palette(ui).accent, palette(ui).text)
    } else {
        (palette(ui).text, palette(ui).dim)
    };
    let left = rect.left() + GAP;
    let used = keycap::paint(ui, left, rect.center().y, key, box_colour);
    let (text, _) = short(ui, &what, egui::FontId::proportional(TYPE), f32::INFINITY, colour);
    let at = egui::pos2(left + used + 6.0, rect.center().y - text.size().y / 2.0);
    ui.painter().galley(at, text, colour);
    if response.clicked() {
        commands.extend(command);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn verdict_and_hint_are_spoken_and_repeated_only_when_they_change() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        assert!(!spoken(&studio).contains("judging"), "{}", spoken(&studio));
        studio.analyse();
        let at_first = spoken(&studio);
        let verdict = studio.viewer.verdict(studio.active()).unwrap().to_string();
        assert!(at_first.starts_with("Explicit Euler: ") && at_first.ends_with('.'), "{at_first}");
        assert!(at_first.contains(verdict.split(' ').next().unwrap()), "{at_first}: {verdict}");
        assert!(at_first.contains("Press 2: ") && !at_first.contains('`'), "{at_first}");
        (0..20).for_each(|_| studio.tick());
        assert_eq!(spoken(&studio), at_first);
        studio.apply(StageCommand::Pick(1));
        assert_ne!(spoken(&studio), at_first);
    }

    #[test]
    fn a_click_on_a_key_of_a_hint_does_what_the_key_does() {
        use crate::tests::testing::TestWindow;
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let mut window = TestWindow::new([390.0, 700.0]);
        let clicked = |studio: &Studio, window: &mut TestWindow, key: &str| {
            let (_, shown) = window.panels(studio, Vec::new());
            let words = shown.whole();
            // The digits of the chips stand above the line of the hint.
            let cap = words.iter().filter(|(rect, text)| text == key && rect.top() > 660.0);
            let at: Vec<_> = cap.map(|(rect, _)| rect.center()).collect();
            assert_eq!(at.len(), 1, "{key} in {words:?}");
            window.click(studio, at[0])
        };
        let hint = studio.hint().expect("a hint");
        assert!(hint.contains("`2`"), "{hint}");
        assert_eq!(clicked(&studio, &mut window, "2"), [Command::Stage(StageCommand::Pick(1))]);
        studio.viewer.notice = None;
        (0..90).for_each(|_| studio.tick());
        studio.apply(StageCommand::Pick(1));
        studio.apply(StageCommand::TickHz(60.into()));
        let hint = studio.hint().expect("a hint");
        assert!(hint.contains("`Home`"), "{hint}");
        assert_eq!(clicked(&studio, &mut window, "Home"), [Command::Stage(StageCommand::Restart)]);
    }

    #[test]
    fn the_throttle_keys_show_for_a_selected_ship_or_a_reduced_throttle() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        let is_told = |studio: &Studio| {
            key_hints(studio).iter().any(|(_, what, _)| what.starts_with("throttle"))
        };
        let kinds = studio.scene().bodies.iter().map(|body| body.kind.id);
        let ship = kinds.clone().position(|id| id == "ship").unwrap();
        let spring = kinds.clone().position(|id| id == "spring").unwrap();
        studio.apply(StageCommand::Body(spring));
        assert!(!is_told(&studio));
        studio.apply(StageCommand::Body(ship));
        assert!(is_told(&studio));
        studio.apply(StageCommand::Body(spring));
        studio.apply(RunCommand::ThrottleDown);
        assert!(is_told(&studio));
    }
}
