//! The note by which a PNG file is known as made by this program.

/// What each file says of where it comes from, under the keyword that PNG has for it.
pub(crate) const SOFTWARE: (&str, &str) = ("Software", "regatta");

/// Signature, header and note stand in as many bytes at the start of a file.
#[cfg(feature = "cli")]
pub(crate) const NOTED_WITHIN: usize = 128;

/// Whether the file that begins with these bytes, [`NOTED_WITHIN`] of them if it has as many, says that
/// this program made it.
#[cfg(feature = "cli")]
pub(crate) fn is_encoded_here(start: &[u8]) -> bool {
    let (keyword, text) = SOFTWARE;
    let note = format!("tEXt{keyword}\0{text}");
    start.starts_with(b"\x89PNG\r\n\x1a\n")
        && start.windows(note.len()).any(|window| window == note.as_bytes())
}
