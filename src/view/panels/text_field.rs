//! A line of text to type or paste into. Its length is bounded: every frame lays out all of it, and each step of undo keeps
//! a copy.

use egui::{Id, TextEdit};

/// The most letters of a number with its unit: an `f64` has at most 24.
pub(super) const MAX_NUMBER: usize = 40;

/// An editor of a line of at most `max` letters. A paste is cut there.
pub(super) fn text_field(text: &mut String, id: Id, max: usize) -> TextEdit<'_> {
    TextEdit::singleline(text).id(id).char_limit(max)
}
