//! A number with a unit that can be dragged and typed in. What cannot be is said under it.

use std::cell::RefCell;

use egui::{DragValue, Id, Response, RichText, Ui, Vec2};

use crate::view::theme::palette;

/// What one point of a drag changes, as a part of the number.
const SPEED: f64 = 0.004;
/// And what it changes at least, so that a drag gets away from 0.
const MIN_SPEED: f64 = 1e-4;

/// What was wrong with what was typed last in a field.
#[derive(Clone)]
struct Fault {
    text: String,
    /// The number that the field had then, and kept.
    value: f64,
}

/// A number as a field shows it.
pub(in crate::view::panels) struct NumberField<'a> {
    /// Tells it from all others.
    pub(in crate::view::panels) id: Id,
    pub(in crate::view::panels) value: f64,
    /// After the number.
    pub(in crate::view::panels) unit: &'a str,
    /// What a screen reader calls it.
    pub(in crate::view::panels) name: &'a str,
    pub(in crate::view::panels) is_whole: bool,
}

impl NumberField<'_> {
    /// Shows the field. Returns what was entered, if `check` finds nothing wrong with it.
    pub(in crate::view::panels) fn show(
        &self,
        ui: &mut Ui,
        size: Vec2,
        check: impl Fn(f64) -> Result<(), String>,
    ) -> (Response, Option<f64>) {
        let fault = RefCell::new(None);
        let mut value = self.value;
        let speed = match self.is_whole {
            true => 0.1,
            false => (SPEED * self.value.abs()).max(MIN_SPEED),
        };
        let suffix = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let is_left = is_left_by_escape(ui, self.id);
        let drag = DragValue::new(&mut value)
            .speed(speed)
            .suffix(suffix)
            .update_while_editing(false)
            .custom_formatter(|value, _| plain(value))
            .custom_parser(|text| {
                if is_left {
                    return None;
                }
                // What was not touched stays what it is, to the last digit.
                if text.trim() == plain(self.value) {
                    return Some(self.value);
                }
                let typed = parsed(text, self.unit);
                if typed.is_none() {
                    *fault.borrow_mut() = Some(format!("`{}` is not a number", text.trim()));
                }
                typed
            });
        let response = ui.add_sized(size, drag);
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(self.name));
        let dragged = response.dragged() && self.is_whole;
        let entered = if dragged { value.round() } else { value };
        let mut taken = None;
        if entered != self.value {
            match check(entered) {
                Ok(()) => taken = Some(entered),
                Err(wrong) => *fault.borrow_mut() = Some(wrong),
            }
        }
        if let Some(text) = fault.into_inner() {
            let fault = Fault { text, value: self.value };
            ui.data_mut(|data| data.insert_temp(self.id, fault));
        } else {
            let known = ui.data(|data| data.get_temp::<Fault>(self.id));
            let is_over = known.is_some_and(|fault| fault.value != self.value);
            if taken.is_some() || response.gained_focus() || is_over {
                ui.data_mut(|data| data.remove::<Fault>(self.id));
            }
        }
        (response, taken)
    }

    /// The width of the number with its unit, in points.
    pub(super) fn width(&self, ui: &Ui) -> f32 {
        let font = egui::TextStyle::Button.resolve(ui.style());
        let text = format!("{} {}", plain(self.value), self.unit);
        let size = ui.painter().layout_no_wrap(text, font, palette(ui).text).size();
        size.x + 2.0 * ui.spacing().button_padding.x
    }

    /// Says under the field with this id what was wrong with what was typed last.
    pub(in crate::view::panels) fn show_fault(id: Id, ui: &mut Ui) {
        if let Some(fault) = ui.data(|data| data.get_temp::<Fault>(id)) {
            ui.label(RichText::new(fault.text).size(11.0).color(palette(ui).bad));
        }
    }

    /// Whether something is wrong in any field.
    pub(super) fn has_faults(ui: &Ui) -> bool {
        ui.data(|data| data.count::<Fault>()) > 0
    }

    /// Forgets what was wrong in all fields.
    pub(super) fn forget_faults(ui: &Ui) {
        ui.data_mut(|data| data.remove_by_type::<Fault>());
    }
}

/// Whether Escape was pressed in the frame before: egui takes what was typed for entered in the frame after, by which
/// it has forgotten why the field lost the focus.
fn is_left_by_escape(ui: &Ui, field: Id) -> bool {
    let id = field.with("escape");
    let is_pressed = ui.input(|input| input.key_pressed(egui::Key::Escape));
    ui.data_mut(|data| {
        let was_pressed = data.get_temp::<bool>(id).unwrap_or_default();
        data.insert_temp(id, is_pressed);
        was_pressed
    })
}

/// The shortest text of a number that can be typed back in.
fn plain(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    match rounded.abs() {
        size if size == 0.0 || (1e-4..1e7).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// The number that was typed, with its unit or without.
fn parsed(text: &str, unit: &str) -> Option<f64> {
    let text = text.trim();
    let number = text.strip_suffix(unit).unwrap_or(text).trim();
    number.replace('\u{2212}', "-").parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::testing::TestWindow;

    #[test]
    fn numbers_are_short_and_can_be_typed_in_again() {
        for (value, shown) in [
            (0.0, "0"),
            (39.478_417_604_357_43, "39.4784"),
            (-2.5, "-2.5"),
            (1e15, "1e15"),
            (123_456.0, "123456"),
            (1.25e-6, "1.25e-6"),
        ] {
            assert_eq!(plain(value), shown);
            let typed = parsed(shown, "N/m").expect("a number");
            assert!((typed - value).abs() <= 1e-5 * value.abs(), "{typed}");
        }
    }

    #[test]
    fn a_fault_is_over_when_the_number_changes_or_all_are_forgotten() {
        let mut window = TestWindow::new([400.0, 300.0]);
        let context = window.context.clone();
        let id = Id::unique("field");
        let mut told = |value: f64, then: fn(&Ui)| {
            window.show(Vec::new(), |ui| {
                then(ui);
                let field = NumberField { id, value, unit: "", name: "number", is_whole: false };
                field.show(ui, Vec2::splat(50.0), |_| Ok(()));
            });
            context.data(|data| data.get_temp::<Fault>(id)).is_some()
        };
        let fail = || {
            let fault = Fault { text: "`x` is not a number".into(), value: 1.0 };
            context.data_mut(|data| data.insert_temp(id, fault));
        };
        fail();
        assert!(told(1.0, |_| ()));
        assert!(!told(2.0, |_| ()), "it was restored");
        fail();
        assert!(!told(1.0, NumberField::forget_faults));
    }

    #[test]
    fn a_number_may_be_typed_with_its_unit_and_nothing_else() {
        assert_eq!(parsed(" 90 N/m ", "N/m"), Some(90.0));
        assert_eq!(parsed("\u{2212}1e3", ""), Some(-1000.0));
        assert_eq!(parsed("90 kg", "N/m"), None);
        assert_eq!(parsed("", "kg"), None);
    }
}
