//! The keyboard focus. The focused widget has a ring around it, and lists scroll to it.

use egui::style::ScrollAnimation;
use egui::{Id, Response, Stroke, StrokeKind, Ui};

use crate::theme::palette;

/// The width of the ring, in points.
pub(crate) const RING: f32 = 1.6;

/// Draws a ring around the focused widget, on top of the widget.
pub(super) fn show(ui: &Ui) {
    let Some(focused) = widget(ui) else { return };
    let painter = ui.ctx().layer_painter(focused.layer_id);
    let stroke = Stroke::new(RING, palette(ui).accent);
    painter.rect_stroke(focused.interact_rect, 3.0, stroke, StrokeKind::Inside);
}

/// Scrolls the list with the content `ui` to a widget of the list that has just got the focus.
pub(super) fn follow(ui: &Ui) {
    let known = ui.scope_id().with("focus");
    let focused = widget(ui).filter(|focused| {
        focused.layer_id == ui.layer_id() && ui.min_rect().contains(focused.rect.center())
    });
    let id = focused.as_ref().map(|focused| focused.id);
    let before = ui.data_mut(|data| {
        let before = data.get_temp::<Option<Id>>(known).flatten();
        data.insert_temp(known, id);
        before
    });
    if let Some(focused) = focused.filter(|focused| Some(focused.id) != before) {
        ui.scroll_to_rect_animation(focused.rect, None, ScrollAnimation::none());
    }
}

/// Returns the widget with the keyboard focus.
fn widget(ui: &Ui) -> Option<Response> {
    let id = ui.memory(|memory| memory.focused())?;
    ui.ctx().read_response(id)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use egui::{Event, Key, Modifiers, Rect};

    use crate::scene::Scene;
    use crate::studio::{StageCommand, Studio};
    use crate::tests::testing::TestWindow;

    fn tab() -> Event {
        let (key, modifiers) = (Key::Tab, Modifiers::NONE);
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
    }

    #[test]
    fn each_press_of_tab_puts_a_visible_ring_on_the_focused_widget() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(StageCommand::ToggleRace);
        let mut window = TestWindow::new([1280.0, 720.0]);
        let screen = Rect::from_min_size(egui::Pos2::ZERO, window.size);
        window.panels(&studio, Vec::new());
        let mut found = BTreeSet::new();
        for press in 0..80 {
            window.panels(&studio, vec![tab()]);
            // Lists scroll one frame later.
            window.panels(&studio, Vec::new());
            let shown = window.panels(&studio, Vec::new()).1;
            let id = window.context.memory(|memory| memory.focused());
            let id = id.unwrap_or_else(|| panic!("press {press}: nothing has the focus"));
            let focused = window.context.read_response(id).unwrap();
            let [ring] = shown.rings[..] else {
                panic!("press {press}: {:?} around {:?}", shown.rings, focused.rect)
            };
            let of = focused.rect;
            assert!(screen.contains_rect(ring) && ring.width() > 4.0, "press {press}: {ring:?}");
            let seen = ring.area() / of.area();
            assert!((0.8..=1.01).contains(&seen), "press {press}: {ring:?} of {of:?}");
            found.insert(format!("{id:?}"));
        }
        assert!(found.len() > 60, "{} widgets have had the focus", found.len());
    }

    #[test]
    fn tab_reaches_the_tick_rate_first_then_the_methods_and_last_the_footer() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.viewer.preferences.display.measure = false;
        let mut window = TestWindow::new([1280.0, 720.0]);
        window.panels(&studio, Vec::new());
        let mut middles = Vec::new();
        for _ in 0..9 {
            window.panels(&studio, vec![tab()]);
            window.panels(&studio, Vec::new());
            let focused = window.context.memory(|memory| memory.focused()).unwrap();
            middles.push(window.context.read_response(focused).unwrap().rect.center());
        }
        let scale = middles[0];
        assert!(scale.x == 640.0 && (590.0..640.0).contains(&scale.y), "the rate: {middles:?}");
        assert!(middles[1].x > 1200.0 && middles[1].y < 600.0, "the edge: {middles:?}");
        let chips = &middles[2..7];
        let are_in_row =
            chips.windows(2).all(|pair| pair[0].x < pair[1].x && pair[0].y == pair[1].y);
        assert!(
            are_in_row && middles[7].y > chips[0].y && middles[8].y > chips[0].y,
            "{middles:?}"
        );
    }
}
