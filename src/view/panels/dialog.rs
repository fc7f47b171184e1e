//! What dialogs share: their window, and a field that is typed over.

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Context, Id, Order, Window};

pub(super) fn window(title: &str) -> Window<'_> {
    Window::new(title)
        .id(Id::unique(title))
        .order(Order::Foreground)
        .collapsible(false)
        .resizable(false)
}

/// Selects what is typed from this character on.
pub(super) fn select(ctx: &Context, id: Id, from: usize) {
    let mut state = TextEditState::load(ctx, id).unwrap_or_default();
    let range = CCursorRange::two(CCursor::new(from), CCursor::new(usize::MAX));
    state.cursor.set_char_range(Some(range));
    state.store(ctx, id);
}
