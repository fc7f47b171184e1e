//! Shows control characters as visible signs, so that printed text cannot steer a terminal.

use std::borrow::Cow;
use std::fmt::Write;

use crate::sim::text::hides_or_breaks;

/// Whether a sign is hidden, except line ends and tabs.
fn is_hidden(sign: char) -> bool {
    hides_or_breaks(sign) && !matches!(sign, '\n' | '\t')
}

/// Replaces control characters, separators of lines, and characters that set the direction of writing, by visible
/// signs. A control character becomes its picture in Unicode, if it has one. CRLF line ends stay.
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return text.into();
    }
    let next = text.chars().skip(1).map(Some).chain([None]);
    let shown = text.chars().zip(next).map(|(sign, next)| match sign {
        '\r' if next == Some('\n') => sign,
        '\0'..='\u{1f}' if is_hidden(sign) => picture(u32::from(sign)),
        '\u{7f}' => '\u{2421}',
        sign if is_hidden(sign) => char::REPLACEMENT_CHARACTER,
        sign => sign,
    });
    shown.collect()
}

/// Most characters of a message at its start and at its end, where the remedy is.
const MAX_HEAD_CHARS: usize = 2000;
const MAX_TAIL_CHARS: usize = 500;

/// Returns a message without the middle part if it is too long to read.
pub(super) fn shortened(message: &str) -> Cow<'_, str> {
    let head = message.char_indices().nth(MAX_HEAD_CHARS).map(|(at, _)| at);
    let tail = message.char_indices().nth_back(MAX_TAIL_CHARS).map(|(at, _)| at);
    match head.zip(tail) {
        Some((head, tail)) if head < tail => {
            format!("{} … {}", &message[..head], &message[tail..]).into()
        }
        _ => message.into(),
    }
}

/// Returns the text in a form for use within a line, in which line ends become signs too.
pub(super) fn visible_in_a_line(text: &str) -> String {
    visible(text).replace('\r', "\u{240d}").replace('\n', "\u{240a}")
}

fn picture(code: u32) -> char {
    char::from_u32(0x2400 + code).unwrap_or(char::REPLACEMENT_CHARACTER)
}

/// Returns JSON with the same value, but with escapes for the hidden characters in its strings.
pub(super) fn visible_json(text: &str) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return text.into();
    }
    let mut shown = String::with_capacity(text.len());
    for sign in text.chars() {
        if is_hidden(sign) {
            write!(shown, "\\u{:04x}", u32::from(sign)).expect("a text takes all");
        } else {
            shown.push(sign);
        }
    }
    shown.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_become_visible_and_lines_are_kept() {
        assert_eq!(visible("a\tb\r\nc\n"), "a\tb\r\nc\n");
        assert_eq!(visible("\u{1b}[31m\u{7}\0\r\u{7f}"), "␛[31m␇␀␍␡");
        assert_eq!(visible("\u{88}\u{9b}2J\u{202e}\u{2066}\u{2028}\u{2029}"), "��2J����");
        assert_eq!(visible_in_a_line("a\nthe same\r\n"), "a␊the same␍␊");
        assert!(matches!(visible("ü → ␛ e\u{301}"), Cow::Borrowed(_)));
    }

    #[test]
    fn json_keeps_its_value() {
        let text = "\u{9b}\u{7f}\u{202e}\u{1b}\n\"";
        let json = serde_json::to_string(text).unwrap();
        let shown = visible_json(&json);
        assert!(shown.is_ascii() && !shown.contains(is_hidden), "{shown}");
        assert_eq!(serde_json::from_str::<String>(&shown).unwrap(), text);
    }
}
