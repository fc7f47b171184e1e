//! Widths of words, by the mean width of their letters.

/// Width of words in letters of this mean width, in points.
pub(super) fn width(letter: f32, words: &str) -> f32 {
    letter * words.chars().count() as f32
}

/// The first of ever shorter wordings that fits this room, in letters of this mean width.
pub(super) fn fitting(
    wordings: impl IntoIterator<Item = String>,
    letter: f32,
    room: f32,
) -> Option<String> {
    wordings.into_iter().find(|words| width(letter, words) <= room)
}
