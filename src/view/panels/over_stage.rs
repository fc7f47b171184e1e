//! Small things over the stage: the button that fits its view, and the question before the program quits.

use egui::{Align2, Area, Button, Id, LayerId, Order, Rect, Stroke, Ui, UiBuilder, pos2, vec2};

use super::{breakpoints, keycap};
use crate::studio::{Command, Studio, ViewCommand, ZoomPan};
use crate::theme::palette;

/// Distance (points) of the button from the right and bottom edges of the stage: beside the sign of a pause, and above
/// the scale bar.
const ASIDE: [f32; 2] = [58.0, 36.0];
/// Padding of the question, the gap between its lines, and its least distance from the sides of the stage, in points.
const PADDING: f32 = 18.0;
const GAP: f32 = 6.0;
const BESIDE: f32 = 12.0;

/// Shows a button that fits the view, unless every body's view is the automatic one.
pub(super) fn fit(ui: &Ui, studio: &Studio, stage: Rect, commands: &mut Vec<Command>) {
    let is_small = stage.width() < breakpoints::FIT[0] || stage.height() < breakpoints::FIT[1];
    if is_small || studio.loop_lab().is_some() {
        return;
    }
    let zoom_pans = studio.view().zoom_pans.iter().enumerate();
    let chosen: Vec<usize> = zoom_pans
        .filter(|(_, zoom_pan)| **zoom_pan != ZoomPan::default())
        .map(|(body, _)| body)
        .collect();
    if chosen.is_empty() {
        return;
    }
    let area = Area::new(Id::unique("fit")).constrain(false).pivot(Align2::RIGHT_BOTTOM);
    area.fixed_pos(stage.max - vec2(ASIDE[0], ASIDE[1])).show(ui.ctx(), |ui| {
        let about = "fit the view (double click)";
        let response = ui.add(Button::new("fit")).on_hover_text(about);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, about));
        if response.clicked() {
            let fit = |body| ViewCommand::ZoomPan { body, zoom_pan: ZoomPan::default() };
            commands.extend(chosen.into_iter().map(|body| Command::View(fit(body))));
        }
    });
}

/// Shows the question whether to quit, in the middle of a darker stage.
pub(super) fn quit_question(ui: &Ui, studio: &Studio, stage: Rect) {
    let Some(question) = studio.viewer.quit_question() else { return };
    let palette = palette(ui);
    // Over the words of the stage too.
    let layer = LayerId::new(Order::Middle, Id::unique("behind the question"));
    let shade = palette.background.gamma_multiply(0.6);
    ui.ctx().layer_painter(layer).rect_filled(stage, 0.0, shade);
    let widths = question.parts().iter().map(|line| keycap::line_width(ui, line));
    let most = stage.width() - 2.0 * (BESIDE + PADDING);
    let width = widths.clone().fold(0.0, f32::max).min(most).max(0.0);
    let lines = question.parts().len() as f32;
    let size = vec2(width, lines * (keycap::HEIGHT + GAP) - GAP);
    let inside = Rect::from_center_size(stage.center(), size);
    // An area would be invisible in its first frame, which may be the only one of a pause.
    let id = Id::unique("quit");
    let builder = UiBuilder::new().layer_id(LayerId::new(Order::Foreground, id)).max_rect(inside);
    let mut ui = Ui::new(ui.ctx().clone(), id, builder);
    // By itself the room of the lines, which would cut their plate.
    ui.set_clip_rect(stage);
    let stroke = Stroke::new(2.0, palette.accent);
    let plate = inside.expand(PADDING);
    ui.painter().rect(plate, 8.0, palette.panel, stroke, egui::StrokeKind::Inside);
    for (row, (line, of)) in question.parts().iter().zip(widths).enumerate() {
        let of = of.min(width);
        let top = inside.top() + row as f32 * (keycap::HEIGHT + GAP);
        let at = pos2(inside.center().x - of / 2.0, top);
        let row = UiBuilder::new().max_rect(Rect::from_min_size(at, vec2(of, keycap::HEIGHT)));
        keycap::line(&mut ui.new_child(row), line, of + 1.0, palette.text, None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::tests::testing::TestWindow;

    #[test]
    fn the_button_to_fit_is_there_only_for_a_chosen_view_and_fits_it() {
        for scene in ["harbour", "pendulum", "ship"] {
            let mut studio = Studio::new(Scene::built_in(scene).unwrap());
            let mut window = TestWindow::new([1280.0, 720.0]);
            let mut place = |studio: &Studio| {
                (0..2).for_each(|_| drop(window.panels(studio, Vec::new())));
                let all = window.panels(studio, Vec::new()).1.all();
                all.into_iter().find(|(_, words)| words == "fit").map(|(rect, _)| rect.center())
            };
            assert_eq!(place(&studio), None, "{scene}");
            let zoom_pan = ZoomPan::default().zoomed(2.0, [0.1, 0.1]);
            studio.apply(ViewCommand::ZoomPan { body: 0, zoom_pan });
            let at = place(&studio).expect("a button");
            let asked = window.click(&studio, at);
            asked.into_iter().for_each(|command| _ = studio.apply(command));
            assert_eq!(studio.view().zoom_pan(0), ZoomPan::default(), "{scene}");
        }
    }

    #[test]
    fn the_question_is_whole_on_the_stage_of_any_window() {
        for size in [[1280.0, 720.0], [800.0, 520.0], [360.0, 480.0], [300.0, 140.0]] {
            for measure in [false, true] {
                let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
                studio.viewer.preferences.display.measure = measure;
                studio.tick();
                studio.apply(crate::studio::StageCommand::Pick(1));
                let mut window = TestWindow::new(size);
                window.panels(&studio, Vec::new());
                studio.apply(ViewCommand::Escape);
                let shown = window.panels(&studio, Vec::new()).1;
                let screen = Rect::from_min_size(pos2(0.0, 0.0), window.size);
                for words in ["Quit Regatta?", "This run is not saved", "Enter", "Esc", "stays"] {
                    let is_there = |(rect, text): &(Rect, String)| {
                        text.contains(words) && screen.contains_rect(*rect)
                    };
                    let whole = shown.whole();
                    assert!(whole.iter().any(is_there), "{words} at {size:?}: {whole:?}");
                }
            }
        }
    }
}
