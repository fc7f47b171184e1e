//! What the wheel and a pinch ask of what is under the pointer.

use egui::Ui;

/// How far a wheel turns to enlarge by the factor e, in points; a notch is some 40.
const WHEEL: f64 = 200.0;

/// How many times larger it is to be, and how far it is to move to the right, in points.
pub(super) fn turned(ui: &Ui) -> (f64, f32) {
    let (scrolled, pinched) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
    (libm::exp(f64::from(scrolled.y) / WHEEL) * f64::from(pinched), scrolled.x)
}
