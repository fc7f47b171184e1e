//! A line of text to type or paste into. Its length is bounded, because every frame lays out all of it, and each step
//! of undo keeps a copy.

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Context, Id, TextEdit};

/// The most letters of a number with its unit: an `f64` has at most 24.
pub(super) const MAX_NUMBER: usize = 40;

/// An editor for a line of at most `max` letters. A longer paste is cut.
pub(super) fn text_field(text: &mut String, id: Id, max: usize) -> TextEdit<'_> {
    TextEdit::singleline(text).id(id).char_limit(max)
}

/// Selects the text from this character on.
pub(super) fn select(ctx: &Context, id: Id, from: usize) {
    let mut state = TextEditState::load(ctx, id).unwrap_or_default();
    let range = CCursorRange::two(CCursor::new(from), CCursor::new(usize::MAX));
    state.cursor.set_char_range(Some(range));
    state.store(ctx, id);
}
