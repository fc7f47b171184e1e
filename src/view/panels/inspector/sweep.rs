//! A sweep moves a parameter up its slider and back by itself.

use egui::{Button, Id, RichText, Ui};

use super::rows::{SliderRange, Spacing, Values};
use super::{LINE, named_button};
use crate::theme::palette;

/// The width of the button, in points.
pub(super) const BUTTON: f32 = 18.0;
/// Duration of a sweep, up and back, in seconds.
const SECONDS: f64 = 8.0;
/// Factor by which the value rises, which is enough to see a change.
const FACTOR: f64 = 10.0;
/// A sweep from zero covers this share of the slider.
const PART_FROM_ZERO: f64 = 0.1;

/// Id under which the active sweep is stored.
const ID: &str = "sweep of a parameter";
/// Maximum time since a sweep was last shown for it to count as active, in seconds.
const FRESH_S: f64 = 0.5;

/// The active sweep. There is at most one at a time.
#[derive(Clone, Copy)]
struct Sweep {
    of: Id,
    began_s: f64,
    shown_s: f64,
    from: f64,
    to: f64,
    is_logarithmic: bool,
    is_whole: bool,
}

impl Sweep {
    fn of(of: Id, began_s: f64, reach: SliderRange, Values { present: from, .. }: Values) -> Self {
        let is_logarithmic = matches!(reach.spacing, Spacing::Logarithmic(_)) && from > 0.0;
        let far = if from == 0.0 { PART_FROM_ZERO * reach.high } else { FACTOR * from };
        // A sweep that starts at the end of its slider goes towards zero instead. This also holds for negative values.
        let to = far.clamp(reach.low.min(from), reach.high.max(from));
        let to = if to == from { from / FACTOR } else { to };
        let is_whole = matches!(reach.spacing, Spacing::Whole);
        Self { of, began_s, shown_s: began_s, from, to, is_logarithmic, is_whole }
    }

    /// Returns the value at this moment, rounded to three digits, or `None` after the end of the sweep. The sweep ends
    /// at its first value.
    fn value_at(&self, now_s: f64) -> Option<f64> {
        let part = (now_s - self.began_s) / SECONDS;
        if part >= 1.0 {
            return None;
        }
        let way = 1.0 - (1.0 - 2.0 * part).abs();
        let value = match self.is_logarithmic {
            true => self.from * libm::pow(self.to / self.from, way),
            false => self.from + (self.to - self.from) * way,
        };
        match self.is_whole {
            true => Some(value.round()),
            false => format!("{value:.2e}").parse().ok(),
        }
    }
}

/// Whether a sweep is active. A whole sweep counts as one change, like a drag.
pub(crate) fn is_sweep_active(ui: &Ui) -> bool {
    let sweep = ui.data(|data| data.get_temp::<Sweep>(Id::unique(ID)));
    sweep.is_some_and(|sweep| ui.input(|input| input.time) - sweep.shown_s < FRESH_S)
}

/// Shows the button that starts the sweep of the parameter with this id, or stops it at the present value. Returns the
/// new value of the parameter.
pub(super) fn show(
    ui: &mut Ui,
    of: Id,
    reach: Option<SliderRange>,
    values: Values,
    name: &str,
) -> Option<f64> {
    let Some(reach) = reach else {
        ui.allocate_exact_size(egui::vec2(BUTTON, LINE), egui::Sense::hover());
        return None;
    };
    let id = Id::unique(ID);
    let now_s = ui.input(|input| input.time);
    let under_way = ui.data(|data| data.get_temp::<Sweep>(id)).filter(|sweep| sweep.of == of);
    let (sign, about) = match under_way {
        Some(_) => ("⏸", format!("stop {name} where it is")),
        None => ("▶", format!("sweep {name} there and back")),
    };
    let text = RichText::new(sign).size(10.0).color(palette(ui).dim);
    let button = Button::new(text).frame(false).min_size(egui::vec2(BUTTON, LINE));
    let is_clicked = named_button(ui, button, &about).clicked();
    match under_way {
        None if is_clicked => {
            ui.data_mut(|data| data.insert_temp(id, Sweep::of(of, now_s, reach, values)));
            ui.request_repaint();
            None
        }
        None => None,
        Some(sweep) => {
            let value = sweep.value_at(now_s).filter(|_| !is_clicked);
            ui.data_mut(|data| match value {
                Some(_) => drop(data.insert_temp(id, Sweep { shown_s: now_s, ..sweep })),
                None => data.remove::<Sweep>(id),
            });
            ui.request_repaint();
            // The parameter gets its old value with all digits, unless the user stopped the sweep.
            let value = value.unwrap_or(if is_clicked { values.present } else { sweep.from });
            (value != values.present).then_some(value)
        }
    }
}
