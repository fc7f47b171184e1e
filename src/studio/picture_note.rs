//! The notes in a PNG file: that this program made it, and the recording of the run that it shows. A picture with a
//! recording is a report, which opens as the scene of the recording.

use std::env;

/// PNG's keyword for the origin of a file, and our text for it.
pub const SOFTWARE: (&str, &str) = ("Software", "regatta");

/// PNG's keyword for the recording in a report.
pub const RECORDING: &str = "regatta recording";

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Length of a file's start that contains signature, header and note, in bytes.
pub const NOTED_WITHIN: usize = 128;

/// Whether a file with this start was made by this program. The start should have [`NOTED_WITHIN`] bytes, or be the
/// whole file.
pub fn is_encoded_here(start: &[u8]) -> bool {
    let (keyword, text) = SOFTWARE;
    let note = format!("tEXt{keyword}\0{text}");
    is_picture(start) && start.windows(note.len()).any(|window| window == note.as_bytes())
}

/// Whether a file with this start is a PNG file.
pub fn is_picture(start: &[u8]) -> bool {
    start.starts_with(SIGNATURE)
}

/// Returns the recording in a PNG file, the text of a scene file; `None` if the file has none.
pub fn recording_in(file: &[u8]) -> Option<&str> {
    let mut rest = file.strip_prefix(SIGNATURE)?;
    loop {
        // A chunk has a length, a kind, that many bytes and a checksum.
        let (&[a, b, c, d, ref kind @ ..], after) = rest.split_first_chunk::<8>()?;
        let (chunk, next) = after.split_at_checked(u32::from_be_bytes([a, b, c, d]) as usize)?;
        // After the keyword: not compressed, in no language, no translated keyword.
        let text = chunk.strip_prefix(RECORDING.as_bytes()).and_then(|it| it.strip_prefix(&[0; 5]));
        if let (b"iTXt", Some(text)) = (kind, text) {
            return str::from_utf8(text).ok();
        }
        rest = next.get(4..)?;
    }
}

/// Returns the text of the recording in a report, which begins with the program's version and system.
pub fn reported(recording: &str) -> String {
    let (version, os, arch) = (env!("CARGO_PKG_VERSION"), env::consts::OS, env::consts::ARCH);
    format!(
        "# A report of regatta {version} on {os} {arch}. `regatta play` opens the picture, `regatta verify` checks it.\n\
         {recording}"
    )
}
