//! Names of frames, and the test whether a capture made a file. The test depends on the content of the file, not only
//! on its name.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::atomic_file::final_name;
use crate::commands::argument::brief;
use crate::commands::error::{Error, PlaceOf};
use crate::commands::manifest;
use crate::commands::output::same_file_path;
use crate::regular_file;
use crate::studio::picture_note::{NOTED_WITHIN, is_encoded_here};

/// Maximum number of frames in a folder, because their numbers have six digits.
pub(crate) const MAX_FRAMES: u32 = 1_000_000;

/// Name of the directory of a complete set of new frames. Once the directory has this name, its frames will replace the
/// old ones.
pub(crate) const READY: &str = ".regatta-blessed";

/// Returns the file name of the frame with this number, from 0.
pub(crate) fn frame_name(frame: u32) -> String {
    format!("frame-{frame:06}.png")
}

/// Returns the number of the frame with this file name, or `None` if the name is not that of a frame.
pub(crate) fn frame_number(name: &str) -> Option<u32> {
    frame_digits(name).filter(|digits| digits.len() == 6)?.parse().ok()
}

/// Returns the digits of a name that is like that of a frame, however many there are.
pub(crate) fn frame_digits(name: &str) -> Option<&str> {
    let digits = name.strip_prefix("frame-")?.strip_suffix(".png")?;
    digits.bytes().all(|b| b.is_ascii_digit()).then_some(digits)
}

/// Whether the picture at `path` carries this program's mark.
pub(crate) fn is_marked(path: &Path) -> bool {
    let start = regular_file::read_start(path, NOTED_WITHIN);
    start.is_ok_and(|start| is_encoded_here(&start))
}

/// Whether this is the name of a frame or a manifest.
pub(crate) fn is_a_captures(name: &str) -> bool {
    name == manifest::FILE_NAME || frame_number(name).is_some()
}

/// Whether the file at `path` is a frame or a manifest of a capture. The file's name and its content must both match.
pub(crate) fn is_ours(path: &Path) -> bool {
    name_of(path).is_some_and(is_a_captures) && is_of_ours(path)
}

/// Whether a capture that was killed left the file at `path`. The file's name must match, and so must its content
/// unless it is empty.
pub(crate) fn is_left_over(path: &Path) -> bool {
    name_of(path).and_then(final_name).is_some_and(is_a_captures)
        && (fs::symlink_metadata(path).is_ok_and(|entry| entry.is_file() && entry.len() == 0)
            || is_of_ours(path))
}

fn name_of(path: &Path) -> Option<&str> {
    path.file_name()?.to_str()
}

fn is_of_ours(path: &Path) -> bool {
    is_marked(path) || frames_claimed(path).is_some()
}

/// Returns the files that the manifest at `path` lists, whatever its schema, or `None` if no capture wrote it.
pub(crate) fn frames_claimed(path: &Path) -> Option<BTreeSet<String>> {
    let bytes = regular_file::read(path, manifest::MAX_BYTES).ok()?;
    let manifest: Value = serde_json::from_slice(&bytes).ok()?;
    let is_ours = manifest["schema"].is_u64()
        && manifest["regatta"].is_string()
        && manifest["settings_hash"].is_string();
    let files = |frames: &Vec<Value>| {
        let files = frames.iter().filter_map(|frame| frame["file"].as_str());
        files.map(String::from).collect()
    };
    is_ours.then(|| manifest["frames"].as_array().map(files).unwrap_or_default())
}

/// Whether the swap of a `--bless` was interrupted before its last step, in which the manifest is moved.
pub(crate) fn is_pending(clip: &Path) -> bool {
    let ready = clip.join(READY);
    fs::symlink_metadata(&ready).is_ok_and(|entry| entry.is_dir())
        && frames_claimed(&ready.join(manifest::FILE_NAME)).is_some()
}

/// Returns an entry that no `--bless` made, at the place of the new frames of `clip`. Such an entry prevents a
/// `--bless` from replacing the old frames.
pub(crate) fn in_the_way(clip: &Path) -> Option<PathBuf> {
    let ready = clip.join(READY);
    if !fs::symlink_metadata(&ready).ok()?.is_dir() {
        return Some(ready);
    }
    let claimed = frames_claimed(&ready.join(manifest::FILE_NAME));
    let is_listed = |name: &str| {
        claimed.as_ref().is_some_and(|files| name == manifest::FILE_NAME || files.contains(name))
    };
    let Ok(mut entries) = fs::read_dir(&ready) else { return Some(ready) };
    entries.find_map(|entry| {
        let path = entry.ok()?.path();
        (!name_of(&path).is_some_and(is_listed)).then_some(path)
    })
}

/// Returns the error for a file that has one of our names, although no command made it.
pub(crate) fn not_ours(path: &Path, place: PlaceOf) -> Error {
    let (path, remedy) = (brief(path), place.or_another("move it away"));
    Error::mistake(format!("{path} was not made by regatta and is not replaced; {remedy}"))
}

/// Whether `path` is the place of the manifest or of a frame in `clip`, whether existing or not. Files that any capture
/// made count too.
pub(crate) fn is_of_a_capture(path: &Path, clip: &Path) -> bool {
    let resolved = same_file_path(path);
    let name = name_of(&resolved).unwrap_or_default();
    let is_in_clip = resolved
        .parent()
        .is_some_and(|parent| fs::canonicalize(clip).is_ok_and(|clip| clip == parent));
    is_in_clip && is_a_captures(name) || is_of_ours(&resolved)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_have_six_digits() {
        for frame in [0, 12, 999_999] {
            assert_eq!(frame_number(&frame_name(frame)), Some(frame));
        }
        for name in ["frame-00000.png", "frame-0000000.png", "frame-+00001.png", "frame-000001.gif"]
        {
            assert_eq!(frame_number(name), None, "{name}");
        }
    }

    #[test]
    fn a_file_is_recognised_by_its_content() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str, bytes: &[u8]| {
            let path = folder.path().join(name);
            fs::write(&path, bytes).unwrap();
            path
        };
        let encoded = b"\x89PNG\r\n\x1a\n....IHDR.................tEXtSoftware\0regatta....";
        assert!(is_marked(&file("frame-000000.png", encoded)));
        assert!(!is_marked(&file("frame-000000.png", b"my own")));
        let text = r#"{"schema":9,"regatta":"0.1.0","settings_hash":"x","frames":[{"file":"a"}]}"#;
        let ours = file("manifest.json", text.as_bytes());
        assert_eq!(frames_claimed(&ours), Some(BTreeSet::from(["a".to_owned()])));
        for other in ["", "{}", r#"{"name":"web app","schema":1}"#, "[1]"] {
            assert_eq!(frames_claimed(&file("manifest.json", other.as_bytes())), None, "{other}");
        }
    }
}
