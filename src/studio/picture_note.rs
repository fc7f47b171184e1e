//! The note that marks a PNG file as made by this program.

/// PNG's keyword for the origin of a file, and our text for it.
pub const SOFTWARE: (&str, &str) = ("Software", "regatta");

/// Length of a file's start that contains signature, header and note, in bytes.
pub const NOTED_WITHIN: usize = 128;

/// Whether a file with this start was made by this program. The start should have [`NOTED_WITHIN`] bytes, or be the
/// whole file.
pub fn is_encoded_here(start: &[u8]) -> bool {
    let (keyword, text) = SOFTWARE;
    let note = format!("tEXt{keyword}\0{text}");
    start.starts_with(b"\x89PNG\r\n\x1a\n")
        && start.windows(note.len()).any(|window| window == note.as_bytes())
}
