//! New frames for an existing clip. They are drawn into a directory inside the clip, and swapped in once all of them
//! are written. The clip itself may be a link, a mount point or the working directory, which cannot be renamed.
//!
//! A process that is killed leaves either the old clip whole, or the new one whole in the directory `.regatta-blessed`.
//! In the second case, [`complete`] finishes the swap.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::atomic_file::{is_random, sync_directory};
use crate::commands::frame_names::{self, READY, frame_number, frames_claimed, is_marked};
use crate::commands::manifest;

/// Prefix of the directory into which the new frames are written.
const UNDER_WAY: &str = ".regatta-bless-";

/// New frames for a clip. They are removed if the value is dropped before [`swap`](Self::swap).
#[derive(Debug)]
pub(crate) struct Blessing {
    clip: PathBuf,
    place: TempDir,
}

impl Blessing {
    /// Creates a directory for the new frames inside that of the clip.
    pub(crate) fn begin(clip: &Path) -> io::Result<Self> {
        let place = tempfile::Builder::new().prefix(UNDER_WAY).tempdir_in(clip)?;
        Ok(Self { clip: clip.to_owned(), place })
    }

    /// Returns the directory for the new frames and their manifest.
    pub(crate) fn place(&self) -> &Path {
        self.place.path()
    }

    /// Replaces the clip's frames and manifest by the new ones, which must already be synced.
    pub(crate) fn swap(self) -> io::Result<()> {
        let ready = self.clip.join(READY);
        // An earlier swap leaves an empty directory, which blocks the rename on some systems.
        _ = fs::remove_dir(&ready);
        fs::rename(self.place.path(), ready)?;
        // The directory now has its final name and must not be removed.
        let _ = self.place.keep();
        sync_directory(&self.clip)?;
        complete(&self.clip)
    }
}

/// Whether an interrupted blessing left the directory at `path`. The directory's name and all its entries must match.
pub(crate) fn is_left_over(path: &Path) -> io::Result<bool> {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    if !name.strip_prefix(UNDER_WAY).is_some_and(is_random) {
        return Ok(false);
    }
    let mut entries = fs::read_dir(path)?;
    entries.try_fold(true, |all, entry| {
        let path = entry?.path();
        Ok(all && (frame_names::is_ours(&path) || frame_names::is_left_over(&path)))
    })
}

/// Finishes a [pending](crate::commands::frame_names::is_pending) swap. Moves only the frames that the new manifest
/// lists. Every step can be repeated, and the manifest is moved last.
pub(crate) fn complete(clip: &Path) -> io::Result<()> {
    let ready = clip.join(READY);
    let [older, newer] = [clip, &ready]
        .map(|folder| frames_claimed(&folder.join(manifest::FILE_NAME)).unwrap_or_default());
    for name in newer.iter().filter(|name| frame_number(name).is_some()) {
        match fs::rename(ready.join(name), clip.join(name)) {
            // The frame was moved before the interruption.
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            moved => moved?,
        }
    }
    for entry in fs::read_dir(clip)? {
        let entry = entry?;
        let Some(name) = entry.file_name().to_str().map(String::from) else { continue };
        let is_of_the_old = frame_number(&name).is_some()
            && !newer.contains(&name)
            && (older.contains(&name) || is_marked(&entry.path()));
        if is_of_the_old {
            fs::remove_file(entry.path())?;
        }
    }
    sync_directory(clip)?;
    fs::rename(ready.join(manifest::FILE_NAME), clip.join(manifest::FILE_NAME))?;
    // The removal fails if the directory contains another file, which is not ours to remove.
    _ = fs::remove_dir(&ready);
    sync_directory(clip)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::frame_names::{in_the_way, is_pending};

    const FRAMES: [&str; 3] = ["frame-000000.png", "frame-000001.png", "frame-000002.png"];

    fn manifest_of(frames: &[&str]) -> String {
        let frames: Vec<_> =
            frames.iter().map(|file| serde_json::json!({ "file": file })).collect();
        let ours = serde_json::json!({
            "schema": 1, "regatta": "0", "settings_hash": "0", "frames": frames
        });
        ours.to_string()
    }

    fn write(folder: &Path, names: &[&str], bytes: &str) {
        for name in names {
            fs::write(folder.join(name), bytes).unwrap();
        }
        fs::write(folder.join(manifest::FILE_NAME), manifest_of(names)).unwrap();
    }

    fn content(folder: &Path) -> Vec<(String, String)> {
        let mut content: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap())
            .map(|entry| {
                let name = entry.file_name().into_string().unwrap();
                (name, fs::read_to_string(entry.path()).unwrap())
            })
            .collect();
        content.sort();
        content
    }

    #[test]
    fn an_abandoned_blessing_keeps_the_old_clip() {
        let clip = tempfile::tempdir().unwrap();
        write(clip.path(), &FRAMES, "old");
        let before = content(clip.path());
        let blessing = Blessing::begin(clip.path()).unwrap();
        write(blessing.place(), &FRAMES[..1], "new");
        drop(blessing);
        assert_eq!(content(clip.path()), before);
    }

    #[test]
    fn a_swap_interrupted_at_any_step_can_be_completed() {
        for moved in 0..=FRAMES.len() + 1 {
            let clip = tempfile::tempdir().unwrap();
            write(clip.path(), &FRAMES, "old");
            fs::write(clip.path().join("frame-000007.png"), "a picture of somebody else's")
                .unwrap();
            let ready = clip.path().join(READY);
            fs::create_dir(&ready).unwrap();
            write(&ready, &FRAMES[..2], "new");
            let steps = FRAMES[..2].iter().copied().map(String::from);
            for name in steps.chain([manifest::FILE_NAME.to_owned()]).take(moved) {
                if name == manifest::FILE_NAME {
                    fs::remove_file(clip.path().join(FRAMES[2])).unwrap();
                }
                fs::rename(ready.join(&name), clip.path().join(&name)).unwrap();
            }
            // After the manifest has been moved, only an empty directory remains.
            assert_eq!(is_pending(clip.path()), moved < 3);
            if moved < 3 {
                complete(clip.path()).unwrap();
            }
            assert_eq!(in_the_way(clip.path()), None);
            _ = fs::remove_dir(&ready);
            let expected = [
                (FRAMES[0], "new".to_owned()),
                (FRAMES[1], "new".to_owned()),
                ("frame-000007.png", "a picture of somebody else's".to_owned()),
                (manifest::FILE_NAME, manifest_of(&FRAMES[..2])),
            ];
            let expected = expected.map(|(name, text)| (name.to_owned(), text));
            assert_eq!(content(clip.path()), expected, "after {moved} steps");
        }
    }
}
