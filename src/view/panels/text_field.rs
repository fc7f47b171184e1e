//! A line of text that can be typed or pasted. Its length is limited, because every frame lays out the whole text, and
//! each step of undo keeps a copy of it.

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Context, Id, TextEdit};

/// Maximum number of letters of a number with its unit. An `f64` alone has at most 24.
pub(super) const MAX_NUMBER: usize = 40;

/// Returns an editor for a line of at most `max` letters. A longer paste is truncated.
pub(super) fn text_field(text: &mut String, id: Id, max: usize) -> TextEdit<'_> {
    TextEdit::singleline(text).id(id).char_limit(max)
}

/// Returns an editor for lines of code of at most `max` letters together.
pub(super) fn text_area(text: &mut String, id: Id, max: usize) -> TextEdit<'_> {
    TextEdit::multiline(text).id(id).char_limit(max).code_editor()
}

/// Selects the text from this character on.
pub(super) fn select(ctx: &Context, id: Id, from: usize) {
    let mut state = TextEditState::load(ctx, id).unwrap_or_default();
    let range = CCursorRange::two(CCursor::new(from), CCursor::new(usize::MAX));
    state.cursor.set_char_range(Some(range));
    state.store(ctx, id);
}
