//! Shortens a file's text for messages.

/// The most characters of a file's text in one message, so that it stays a line.
const MOST_QUOTED_CHARS: usize = 40;

/// Text of a file for a message: shortened, and without control characters.
pub(super) fn clip(text: &str) -> String {
    let mut shown = String::new();
    for character in text.chars().take(MOST_QUOTED_CHARS) {
        match character {
            '"' | '\'' | '\\' => shown.push(character),
            _ => shown.extend(character.escape_debug()),
        }
    }
    if text.chars().nth(MOST_QUOTED_CHARS).is_some() {
        shown.push('…');
    }
    shown
}
