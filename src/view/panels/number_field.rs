//! A number with a unit, which can be dragged or typed. Its error message appears over the field.

use egui::accesskit::Action;
use egui::class::HasClasses as _;
use egui::emath::round_to_decimals;
use egui::{
    Align2, Area, DragValue, Frame, Id, Key, Modifiers, Order, Rect, Response, RichText, Ui, Vec2,
    WidgetInfo,
};

use crate::panels::text_field::{MAX_NUMBER, select, text_field};
use crate::theme::palette;

/// Maximum width of an error message, in points.
const FAULT: f32 = 260.0;
/// Relative change of the number per point of a drag.
const SPEED: f64 = 0.004;
/// Minimum change of the number per point of a drag, so that a drag can leave 0.
const MIN_SPEED: f64 = 1e-4;
const MIN_SPEED_OF_WHOLE: f64 = 0.1;

/// Error of the last entry in a field.
#[derive(Clone)]
struct Fault {
    text: String,
    /// The number of the field at the time of the error. The field kept it.
    value: f64,
}

/// The text of a field that has the focus.
#[derive(Clone, Default)]
struct Typed {
    text: String,
    /// The number of the field when the typing began. If the number changes otherwise, the text is discarded.
    value: f64,
    /// Number of the frame that showed the text.
    frame: u64,
}

/// A field for a number.
pub(super) struct NumberField<'a> {
    /// Unique id of the field.
    pub(super) id: Id,
    pub(super) value: f64,
    /// Text after the number.
    pub(super) unit: &'a str,
    /// Name for a screen reader.
    pub(super) name: &'a str,
    pub(super) is_whole: bool,
}

impl NumberField<'_> {
    /// Shows the field. Returns the entered number if it passes `check`.
    pub(super) fn show(
        &self,
        ui: &mut Ui,
        size: Vec2,
        check: impl Fn(f64) -> Result<(), String>,
    ) -> (Response, Option<f64>) {
        let mut entered = Ok(self.value);
        let response = ui.add_sized(size, |ui: &mut Ui| {
            let id = ui.next_auto_id();
            let has_focus = ui.is_enabled()
                && ui.memory_mut(|memory| {
                    memory.interested_in_focus(id, ui.layer_id());
                    memory.has_focus(id)
                });
            let typed = self.typed(ui, id);
            match has_focus {
                true => self.edit(ui, id, typed, &mut entered),
                false => self.drag(ui, typed, &mut entered),
            }
        });
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(self.name));
        self.show_fault(ui, response.rect);
        let mut taken = None;
        let entered = entered.and_then(|value| {
            if value != self.value {
                check(value)?;
                taken = Some(value);
            }
            Ok(())
        });
        if let Err(text) = entered {
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

    /// Takes the text that the editor showed in the previous frame out of its storage.
    fn typed(&self, ui: &Ui, id: Id) -> Option<String> {
        let typed = ui.data_mut(|data| data.remove_temp::<Typed>(id))?;
        let is_of_last_frame = typed.frame + 1 >= ui.ctx().cumulative_frame_nr();
        (is_of_last_frame && typed.value == self.value).then_some(typed.text)
    }

    /// Shows an editor. The editor of egui's [`DragValue`] would accept text of any length.
    fn edit(
        &self,
        ui: &mut Ui,
        id: Id,
        typed: Option<String>,
        entered: &mut Result<f64, String>,
    ) -> Response {
        let steps = ui.input_mut(|input| {
            let mut count = |key, action| {
                let asked = input.num_accesskit_action_requests(id, action);
                (input.count_and_consume_key(Modifiers::NONE, key) + asked) as f64
            };
            count(Key::ArrowUp, Action::Increment) - count(Key::ArrowDown, Action::Decrement)
        });
        if steps != 0.0 {
            let decimals = libm::log10(1.0 / self.speed()).ceil().clamp(0.0, 15.0) as usize;
            *entered = Ok(round_to_decimals(self.value + self.speed() * steps, decimals));
        }
        let is_new = typed.is_none();
        let mut text = typed.unwrap_or_else(|| plain(self.value));
        if is_new {
            select(ui.ctx(), id, 0);
        }
        let style = ui.style().drag_value_text_style.clone();
        let field = text_field(&mut text, id, MAX_NUMBER)
            .with_class(DragValue::CLASS)
            .clip_text(false)
            .align(ui.layout().align2())
            .min_size(ui.spacing().interact_size)
            .desired_width(0.0)
            .font(style);
        let response = ui.add(field);
        response.widget_info(|| WidgetInfo::drag_value(ui.is_enabled(), self.value));
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.add_action(Action::Increment);
            node.add_action(Action::Decrement);
        });
        // The Enter key takes the focus from the field in this frame.
        if response.lost_focus() {
            *entered = self.parsed(&text);
        } else {
            let frame = ui.ctx().cumulative_frame_nr();
            let typed = Typed { text, value: self.value, frame };
            ui.data_mut(|data| data.insert_temp(id, typed));
        }
        response
    }

    /// Shows the number. If the focus left while text was typed, enters the text, unless Escape discarded it.
    fn drag(
        &self,
        ui: &mut Ui,
        typed: Option<String>,
        entered: &mut Result<f64, String>,
    ) -> Response {
        let typed = typed.filter(|_| !ui.input(|input| input.key_pressed(Key::Escape)));
        if let Some(text) = typed {
            *entered = self.parsed(&text);
        }
        let mut value = self.value;
        let suffix = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let drag = DragValue::new(&mut value)
            .speed(self.speed())
            .suffix(suffix)
            .custom_formatter(|value, _| plain(value));
        let response = ui.add(drag);
        if value != self.value {
            let is_rounded = response.dragged() && self.is_whole;
            *entered = Ok(if is_rounded { value.round() } else { value });
        }
        response
    }

    /// Returns the change of the number per point of a drag.
    fn speed(&self) -> f64 {
        let least = if self.is_whole { MIN_SPEED_OF_WHOLE } else { MIN_SPEED };
        (SPEED * self.value.abs()).max(least)
    }

    /// Parses the typed text. Unchanged text keeps all digits of the number.
    fn parsed(&self, text: &str) -> Result<f64, String> {
        if text.trim() == plain(self.value) {
            return Ok(self.value);
        }
        let is = match parsed(text, self.unit) {
            Some(value) if value.is_finite() => return Ok(value),
            Some(_) if text.contains(|sign: char| sign.is_ascii_digit()) => {
                "too large for a number"
            }
            _ => "not a number",
        };
        Err(format!("`{}` is {is}", text.trim()))
    }

    /// Returns the width of the number with its unit, in points.
    pub(super) fn width(&self, ui: &Ui) -> f32 {
        let font = egui::TextStyle::Button.resolve(ui.style());
        let text = format!("{} {}", plain(self.value), self.unit);
        let size = ui.painter().layout_no_wrap(text, font, palette(ui).text).size();
        size.x + 2.0 * ui.spacing().button_padding.x
    }

    /// Shows the error of the last entry over the field. The message takes no room, so that no other field moves and
    /// the next field stays visible.
    fn show_fault(&self, ui: &Ui, field: Rect) {
        let Some(fault) = ui.data(|data| data.get_temp::<Fault>(self.id)) else { return };
        if ui.input(|input| input.key_pressed(Key::Escape)) {
            ui.data_mut(|data| data.remove::<Fault>(self.id));
        }
        if !ui.is_rect_visible(field) {
            return;
        }
        let plate = Area::new(self.id.with("fault")).order(Order::Tooltip).interactable(false);
        let plate = plate.fixed_pos(field.right_top()).pivot(Align2::RIGHT_BOTTOM);
        plate.show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).inner_margin(4.0).show(ui, |ui| {
                ui.set_max_width(FAULT);
                ui.label(RichText::new(fault.text).size(11.0).color(palette(ui).bad));
            });
        });
    }

    /// Whether any field has an error.
    pub(super) fn has_faults(context: &egui::Context) -> bool {
        context.data(|data| data.count::<Fault>()) > 0
    }

    /// Clears the errors of all fields.
    pub(super) fn forget_faults(ui: &Ui) {
        ui.data_mut(|data| data.remove_by_type::<Fault>());
    }
}

/// Formats a number with at most six digits, in a form that can be typed.
fn plain(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    match rounded.abs() {
        size if size == 0.0 || (1e-4..1e7).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// Parses a typed number with or without its unit.
fn parsed(text: &str, unit: &str) -> Option<f64> {
    let text = text.trim();
    let number = text.strip_suffix(unit).unwrap_or(text).trim();
    number.replace('\u{2212}', "-").parse().ok()
}

#[cfg(test)]
mod tests {
    use egui::{Event, vec2};

    use super::*;
    use crate::tests::testing::TestWindow;

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
    fn a_fault_disappears_when_its_number_changes_or_all_are_cleared() {
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

    /// Shows a field of this value and feeds it these frames of events. Returns the words of the last frame, and the
    /// entered numbers.
    fn typed(value: f64, frames: Vec<Vec<Event>>) -> (Vec<String>, Vec<f64>) {
        let mut window = TestWindow::new([400.0, 300.0]);
        let (mut words, mut taken) = (Vec::new(), Vec::new());
        let first = vec![vec![], vec![pressed(Key::Tab)]];
        for events in first.into_iter().chain(frames).chain([vec![]]) {
            let id = Id::unique("field");
            let (entered, shown) = window.show(events, |ui| {
                let field = NumberField { id, value, unit: "kg", name: "mass", is_whole: false };
                let (_, entered) = field.show(ui, vec2(150.0, 22.0), |_| Ok(()));
                entered
            });
            taken.extend(entered);
            words = shown.words();
        }
        (words, taken)
    }

    fn pressed(key: Key) -> Event {
        let modifiers = Modifiers::NONE;
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
    }

    #[test]
    fn a_number_is_entered_by_enter_or_loss_of_focus_but_not_by_escape() {
        let text = || vec![Event::Text("2.5".into())];
        for (key, entered) in [(Key::Enter, &[2.5][..]), (Key::Tab, &[2.5]), (Key::Escape, &[])] {
            let (words, taken) = typed(1.0, vec![text(), vec![pressed(key)], vec![]]);
            assert_eq!(taken, entered, "{key:?}");
            // The Tab key returns to the only field, which then shows the number without its unit.
            let shown = if key == Key::Tab { "1" } else { "1 kg" };
            assert_eq!(words.concat(), shown, "{key:?}");
        }
        assert_eq!(typed(1.0, vec![text()]), (vec!["2.5".into()], vec![]));
        let (_, taken) = typed(40.0, vec![vec![pressed(Key::ArrowUp)]]);
        assert!(taken.len() == 1 && taken[0] > 40.0 && taken[0] < 41.0, "{taken:?}");
    }

    #[test]
    fn a_long_paste_is_truncated_and_still_refused() {
        let paste = || vec![Event::Paste("tick,x,v\n1,2.5,3\n".repeat(5000))];
        let (words, taken) = typed(1.0, (0..30).map(|_| paste()).collect());
        assert_eq!((words[0].chars().count(), taken.len()), (MAX_NUMBER, 0), "{words:?}");
        let (words, taken) = typed(1.0, vec![paste(), vec![pressed(Key::Enter)], vec![]]);
        assert_eq!((words[..2].concat(), taken.len()), ("1 kg".into(), 0));
        assert!(words[2].starts_with("`tick,x,v 1,2.5") && words[2].ends_with("is not a number"));
        assert!(words[2].chars().count() < 2 * MAX_NUMBER, "{words:?}");
    }

    #[test]
    fn a_non_finite_number_is_refused_with_a_sentence() {
        for (text, sentence) in [
            ("1e400", "`1e400` is too large for a number"),
            ("-1e400 kg", "`-1e400 kg` is too large for a number"),
            ("nan", "`nan` is not a number"),
            ("inf", "`inf` is not a number"),
            ("x", "`x` is not a number"),
        ] {
            let frames = vec![vec![Event::Text(text.into())], vec![pressed(Key::Enter)], vec![]];
            let (words, taken) = typed(1.0, frames);
            assert_eq!((words.last().map(|it| &**it), taken.len()), (Some(sentence), 0));
        }
    }

    #[test]
    fn a_typed_number_may_be_followed_only_by_its_own_unit() {
        assert_eq!(parsed(" 90 N/m ", "N/m"), Some(90.0));
        assert_eq!(parsed("\u{2212}1e3", ""), Some(-1000.0));
        assert_eq!(parsed("90 kg", "N/m"), None);
        assert_eq!(parsed("", "kg"), None);
    }
}
