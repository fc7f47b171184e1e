//! Translates events of mouse, pen and fingers on the canvas for the panels.

use regatta::view::egui;
use web_sys::{PointerEvent, WheelEvent};

/// The fingers that touch the screen.
#[derive(Debug, Default)]
pub(crate) struct Fingers {
    down: Vec<i32>,
    /// Whether the first finger presses like a mouse button. Two fingers zoom instead.
    is_pressing: bool,
}

/// Kind of event of a pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PointerAction {
    Down,
    Move,
    Up,
    Cancel,
}

/// Translates an event of a pointer at a place of the frame, in points.
pub(crate) fn events(
    fingers: &mut Fingers,
    event: &PointerEvent,
    action: PointerAction,
    pos: egui::Pos2,
    modifiers: egui::Modifiers,
) -> Vec<egui::Event> {
    if event.pointer_type() == "touch" {
        return fingers.events(event.pointer_id(), action, pos);
    }
    let button = match event.button() {
        1 => egui::PointerButton::Middle,
        2 => egui::PointerButton::Secondary,
        _ => egui::PointerButton::Primary,
    };
    let pressed = action == PointerAction::Down;
    match action {
        PointerAction::Down | PointerAction::Up => {
            vec![egui::Event::PointerButton { pos, button, pressed, modifiers }]
        }
        PointerAction::Move => vec![egui::Event::PointerMoved(pos)],
        PointerAction::Cancel => vec![egui::Event::PointerGone],
    }
}

impl Fingers {
    fn events(&mut self, finger: i32, action: PointerAction, pos: egui::Pos2) -> Vec<egui::Event> {
        let press = |pressed| egui::Event::PointerButton {
            pos,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: egui::Modifiers::default(),
        };
        let phase = match action {
            PointerAction::Down => egui::TouchPhase::Start,
            PointerAction::Move => egui::TouchPhase::Move,
            PointerAction::Up => egui::TouchPhase::End,
            PointerAction::Cancel => egui::TouchPhase::Cancel,
        };
        let mut events = vec![egui::Event::Touch {
            device_id: egui::TouchDeviceId(0),
            id: egui::TouchId(finger as u64),
            phase,
            pos,
            force: None,
        }];
        match action {
            PointerAction::Down => {
                self.down.push(finger);
                let is_first = self.down.len() == 1;
                if is_first {
                    events.extend([egui::Event::PointerMoved(pos), press(true)]);
                } else if self.is_pressing {
                    events.push(press(false));
                }
                self.is_pressing = is_first;
            }
            PointerAction::Move if self.is_pressing => events.push(egui::Event::PointerMoved(pos)),
            PointerAction::Move => {}
            PointerAction::Up | PointerAction::Cancel => {
                self.down.retain(|down| *down != finger);
                if std::mem::take(&mut self.is_pressing) {
                    events.push(press(false));
                }
                if self.down.is_empty() {
                    events.push(egui::Event::PointerGone);
                }
            }
        }
        events
    }
}

/// Translates a turn of the wheel, or a pinch on a touchpad. Returns `None` if the browser handles it.
pub(crate) fn wheel_event(event: &WheelEvent, modifiers: egui::Modifiers) -> Option<egui::Event> {
    let delta = -egui::vec2(event.delta_x() as f32, event.delta_y() as f32);
    // Browsers report a pinch as a wheel with Control. If the key itself is held, the browser enlarges the page.
    if event.ctrl_key() {
        return (!modifiers.ctrl).then(|| egui::Event::Zoom((delta.y / 200.0).exp()));
    }
    let unit = match event.delta_mode() {
        WheelEvent::DOM_DELTA_LINE => egui::MouseWheelUnit::Line,
        WheelEvent::DOM_DELTA_PAGE => egui::MouseWheelUnit::Page,
        _ => egui::MouseWheelUnit::Point,
    };
    let (phase, source) = (egui::TouchPhase::Move, egui::MouseWheelSource::Unknown);
    Some(egui::Event::MouseWheel { unit, delta, phase, source, modifiers })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn presses(events: &[egui::Event]) -> Vec<bool> {
        let pressed = |event: &egui::Event| match event {
            egui::Event::PointerButton { pressed, .. } => Some(*pressed),
            _ => None,
        };
        events.iter().filter_map(pressed).collect()
    }

    #[test]
    fn one_finger_presses_and_two_fingers_only_zoom() {
        let mut fingers = Fingers::default();
        let mut did = |finger, action| fingers.events(finger, action, egui::pos2(1.0, 2.0));
        assert_eq!(presses(&did(7, PointerAction::Down)), [true]);
        assert_eq!(presses(&did(8, PointerAction::Down)), [false]);
        assert_eq!(did(7, PointerAction::Move).len(), 1);
        assert_eq!(did(7, PointerAction::Up).len(), 1);
        assert!(did(8, PointerAction::Up).contains(&egui::Event::PointerGone));
        assert_eq!(presses(&did(9, PointerAction::Down)), [true]);
        assert_eq!(presses(&did(9, PointerAction::Up)), [false]);
    }
}
