//! Signs of a text that change how a reader, a terminal or a compiler sees it.

/// Whether a sign hides itself, ends a line or reorders its neighbours: control characters, the separators of lines and
/// paragraphs, and signs that set the direction of writing.
pub fn hides_or_breaks(sign: char) -> bool {
    sign.is_control() || matches!(sign, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}
