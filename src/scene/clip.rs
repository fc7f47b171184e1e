//! Shortens the text of a file or of an argument for messages.

/// Maximum number of characters of a file's text in one message, so that the message stays a line.
const MAX_QUOTED_CHARS: usize = 40;

/// Maximum number of characters of a list of names from a file, such as a header.
const MAX_LISTED_CHARS: usize = 200;

/// Shortens a text for a message, and escapes its control characters.
pub fn clip(text: &str) -> String {
    clip_to(MAX_QUOTED_CHARS, text)
}

/// Joins names from a file with commas, for a message.
pub fn clip_list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    // No more of a file's text is read than a message can show.
    let shown = names.take(MAX_LISTED_CHARS).map(clip).collect::<Vec<_>>().join(", ");
    clip_to(MAX_LISTED_CHARS, &shown)
}

/// Returns the first characters of a text, with an ellipsis if more follow.
pub fn truncate(max_chars: usize, text: &str) -> String {
    match text.char_indices().nth(max_chars) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

fn clip_to(max_chars: usize, text: &str) -> String {
    let mut shown = String::new();
    for character in truncate(max_chars, text).chars() {
        match character {
            '"' | '\'' | '\\' => shown.push(character),
            _ => shown.extend(character.escape_debug()),
        }
    }
    shown
}
