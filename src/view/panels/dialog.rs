//! What dialogs share: their window, and a field that is typed over.

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Align2, Context, Id, Order, Rect, Window};

/// A dialog over this part of the window.
pub(super) fn window(title: &str, over: Rect) -> Window<'_> {
    Window::new(title)
        .id(Id::unique(title))
        .order(Order::Foreground)
        .collapsible(false)
        .resizable(false)
        .constrain_to(over)
        .anchor(Align2::CENTER_TOP, [0.0, 80.0_f32.min(over.height() / 8.0)])
}

/// Selects what is typed from this character on.
pub(super) fn select(ctx: &Context, id: Id, from: usize) {
    let mut state = TextEditState::load(ctx, id).unwrap_or_default();
    let range = CCursorRange::two(CCursor::new(from), CCursor::new(usize::MAX));
    state.cursor.set_char_range(Some(range));
    state.store(ctx, id);
}
