//! The timeline of the loop lab, which reaches from the first frame to the last. A click or a drag seeks to a moment.

use egui::{Align2, Ui};

use crate::loops::loop_lab::{LoopCommand, LoopLab};
use crate::panels::timeline::{Groove, Span, THICKNESS};
use crate::studio::Command;
use crate::theme::palette;

pub(in crate::panels) fn show(ui: &mut Ui, loops: &LoopLab, commands: &mut Vec<Command>) {
    let span = Span { from_s: 0.0, to_s: loops.end_ns() as f64 / 1e9 };
    let groove = Groove::new(ui.available_rect_before_wrap(), 0.0);
    let Some(groove) = groove.filter(|_| span.to_s > 0.0) else { return };
    let response = groove.interact(ui);
    let (along, now_s) = (groove.along, loops.now_ns() as f64 / 1e9);
    let now = (now_s, format!("timeline, at {now_s:.3} s"));
    groove.seek(ui, &response, now, commands, |x| {
        let moment_ns = (span.t(x, along) * 1e9).round() as i64;
        Some(Command::Loop(LoopCommand::Seek(moment_ns)))
    });

    let (palette, painter) = (palette(ui), ui.painter());
    groove.write(painter, span, palette);
    let text = format!("{now_s:.2} of {:.0} s", span.to_s);
    groove.write_at(painter, Align2::RIGHT_CENTER, &text, palette);
    let x = span.x(now_s, along);
    for (to, colour) in [(along.max, palette.raised), (x, palette.dim.gamma_multiply(0.8))] {
        painter.rect_filled(groove.piece(along.min, to), 0.5 * THICKNESS, colour);
    }
    groove.handle(painter, x, response.has_focus(), palette);
}

#[cfg(test)]
mod tests {
    use egui::{Rangef, Vec2, pos2, vec2};

    use super::*;
    use crate::panels;
    use crate::panels::timeline::{HEIGHT, MARGIN, MEMORY, TRACK_Y};
    use crate::scene::Scene;
    use crate::studio::{Studio, run_loops};
    use crate::tests::testing::TestWindow;

    const SIZE: Vec2 = vec2(1280.0, 720.0);

    #[test]
    fn a_click_on_the_track_seeks_and_a_click_on_a_row_selects_or_shows_a_loop() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(Command::Loop(LoopCommand::ToggleLab));
        run_loops(&mut studio);
        let mut window = TestWindow::new(SIZE);
        let loops = studio.loop_lab().unwrap();
        let bottom = SIZE.y - panels::footer::HEIGHT;
        let table = bottom - panels::loops::table::height(loops);
        let along = Rangef::new(8.0 + MARGIN, SIZE.x - 8.0 - MEMORY - MARGIN);
        let middle = pos2(along.center(), table - HEIGHT + TRACK_Y);
        let half_ns = loops.end_ns() / 2;
        window.panels(&studio, Vec::new());
        let sought = window.click(&studio, middle);
        let is_half = |command: &Command| match command {
            Command::Loop(LoopCommand::Seek(ns)) => (ns - half_ns).abs() < 10_000_000,
            _ => false,
        };
        assert!(!sought.is_empty() && sought.iter().all(is_half), "{sought:?}, not {half_ns}");
        let third = table + 3.5 * panels::lanes::ROW;
        let index = loops.listed()[2];
        let commands = window.click(&studio, pos2(300.0, third));
        assert_eq!(commands, [Command::Loop(LoopCommand::Select(index))]);
        let commands = window.click(&studio, pos2(50.0, third));
        assert_eq!(commands, [Command::Loop(LoopCommand::ToggleOnStage(index))]);
    }
}
