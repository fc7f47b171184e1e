//! The directory that a capture fills with numbered pictures and a manifest, each of which appears whole
//! or not at all.

use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::manifest;

/// The most frames in a folder: as many as six digits number.
pub(super) const MOST_FRAMES: u32 = 1_000_000;

/// What may become of the frames that a folder holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Existing {
    /// The folder has to be empty or new.
    Refuse,
    /// Frames make way for the new ones; other entries stay.
    Replace,
    /// Frames from the first on, without a gap, stay, and so does a manifest; whatever else a capture
    /// left makes way.
    Continue,
}

/// Why frames could not be kept in a folder.
#[derive(Debug, thiserror::Error)]
pub enum FrameFolderError {
    /// The path is taken by something else.
    #[error("{} is not a directory; give another --out", .path.display())]
    NotADirectory {
        /// The path.
        path: PathBuf,
    },
    /// The folder is in use.
    #[error(
        "{} is not empty; give another --out, or --force to replace the frames in it, or --resume \
         to add those that are missing",
        .path.display()
    )]
    NotEmpty {
        /// The folder.
        path: PathBuf,
    },
    /// A frame that is there already is none of this capture.
    #[error(
        "{} is not what this command draws here; give the command that drew it, or --force to draw \
         all anew",
        .path.display()
    )]
    Foreign {
        /// The frame.
        path: PathBuf,
    },
    /// The system refused.
    #[error("cannot {doing} {}: {source}{}", .path.display(), remedy(.source))]
    Io {
        /// What was tried.
        doing: &'static str,
        /// On what.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}

/// A folder of frames.
#[derive(Debug)]
pub(super) struct FrameFolder {
    path: PathBuf,
    /// What an earlier capture left, whole or not, and is to go.
    old: Vec<OsString>,
    /// Names of the entries that are none of ours.
    others: Vec<OsString>,
    /// Frames of an earlier capture that stay.
    kept: u32,
    frames: u32,
}

impl FrameFolder {
    /// Looks at the folder at `path`, which need not exist yet, and changes nothing.
    pub(super) fn inspect(path: &Path, existing: Existing) -> Result<Self, FrameFolderError> {
        let fail = failure("read", path);
        let mut folder = Self::empty(path);
        match fs::read_dir(path) {
            Ok(entries) => {
                for entry in entries {
                    let entry = entry.map_err(&fail)?;
                    let is_directory = entry.file_type().map_err(&fail)?.is_dir();
                    let name = entry.file_name();
                    let list = if is_ours(&name) && !is_directory {
                        &mut folder.old
                    } else {
                        &mut folder.others
                    };
                    list.push(name);
                }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
                return Err(FrameFolderError::NotADirectory { path: path.to_owned() });
            }
            Err(error) => return Err(fail(error)),
        }
        folder.others.sort();
        let is_empty = folder.old.is_empty() && folder.others.is_empty();
        if existing == Existing::Refuse && !is_empty {
            return Err(FrameFolderError::NotEmpty { path: path.to_owned() });
        }
        if existing == Existing::Continue {
            // The manifest of what is there holds until another is whole.
            folder.old.retain(|name| name != manifest::FILE_NAME);
            folder.kept = (0..MOST_FRAMES)
                .find(|&frame| !folder.old.contains(&frame_name(frame).into()))
                .unwrap_or(MOST_FRAMES);
        }
        Ok(folder)
    }

    /// The first of `name`, `name-2`, `name-3` … that is new or an empty directory.
    pub(super) fn beside(name: &str) -> Result<Self, FrameFolderError> {
        let siblings = (2..).map(|n: u32| format!("{name}-{n}"));
        for sibling in std::iter::once(name.to_owned()).chain(siblings) {
            match Self::inspect(Path::new(&sibling), Existing::Refuse) {
                Err(FrameFolderError::NotEmpty { .. } | FrameFolderError::NotADirectory { .. }) => {
                }
                found => return found,
            }
        }
        unreachable!("no file system holds as many directories")
    }

    fn empty(path: &Path) -> Self {
        Self { path: path.to_owned(), old: Vec::new(), others: Vec::new(), kept: 0, frames: 0 }
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Makes the folder where there is none, and removes what an earlier capture left but for the
    /// first `frames` of the frames to be kept, so that it never holds frames of two.
    pub(super) fn clear(&mut self, frames: u32) -> Result<(), FrameFolderError> {
        fs::create_dir_all(&self.path).map_err(failure("make the directory", &self.path))?;
        self.kept = self.kept.min(frames);
        let kept: BTreeSet<OsString> =
            (0..self.kept).map(|frame| frame_name(frame).into()).collect();
        for name in self.old.drain(..).filter(|name| !kept.contains(name)) {
            let path = self.path.join(name);
            fs::remove_file(&path).map_err(failure("replace", &path))?;
        }
        Ok(())
    }

    /// Adds the next frame; one that stays has to be the same to the byte.
    pub(super) fn push(&mut self, picture: &[u8]) -> Result<(), FrameFolderError> {
        let path = self.path.join(frame_name(self.frames));
        if self.frames < self.kept {
            if fs::read(&path).map_err(failure("read", &path))? != picture {
                return Err(FrameFolderError::Foreign { path });
            }
        } else {
            write_whole(&path, picture)?;
        }
        self.frames += 1;
        Ok(())
    }

    /// Writes the manifest.
    pub(super) fn write_manifest(&self, text: &str) -> Result<(), FrameFolderError> {
        write_whole(&self.path.join(manifest::FILE_NAME), text.as_bytes())
    }

    /// The frames written, by the names of the first and the last.
    pub(super) fn range(&self) -> String {
        let name = |frame| self.path.join(frame_name(frame)).display().to_string();
        match self.frames {
            0 => "none".into(),
            1 => name(0),
            frames => format!("{} … {}", name(0), frame_name(frames - 1)),
        }
    }

    /// Names of the entries that are none of our frames and have been left alone.
    pub(super) fn others(&self) -> &[OsString] {
        &self.others
    }
}

/// Writes a file that appears whole or not at all: under a name of its own until it is.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), FrameFolderError> {
    let part = part_of(path);
    fs::write(&part, bytes).and_then(|()| fs::rename(&part, path)).map_err(|error| {
        // It may never have come to be; then there is nothing to remove.
        let _ = fs::remove_file(&part);
        failure("write", path)(error)
    })
}

/// What a file is called until it is whole.
pub(super) fn part_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".part");
    name.into()
}

pub(super) fn frame_name(frame: u32) -> String {
    format!("frame-{frame:06}.png")
}

/// Whether a capture gives files this name, for whole ones or for those under way.
fn is_ours(name: &OsStr) -> bool {
    let Some(name) = name.to_str() else { return false };
    let name = name.strip_suffix(".part").unwrap_or(name);
    let digits = name.strip_prefix("frame-").and_then(|name| name.strip_suffix(".png"));
    let is_frame = |digits: &str| digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_digit());
    name == manifest::FILE_NAME || digits.is_some_and(is_frame)
}

pub(super) fn failure(doing: &'static str, path: &Path) -> impl Fn(io::Error) -> FrameFolderError {
    let path = path.to_owned();
    move |source| FrameFolderError::Io { doing, path: path.clone(), source }
}

fn remedy(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "; free some space, or give another --out"
        }
        _ => "; give an --out that you may write to",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_numbered_pictures_and_the_manifest_are_ours() {
        for name in
            ["frame-000000.png", "frame-999999.png", "frame-000012.png.part", "manifest.json"]
        {
            assert!(is_ours(OsStr::new(name)), "{name}");
        }
        for name in ["frame-00000.png", "frame-0000000.png", "frame-+00001.png", "frame-000001.gif"]
        {
            assert!(!is_ours(OsStr::new(name)), "{name}");
        }
    }

    #[test]
    fn a_folder_in_use_is_refused_and_left_as_it_is() {
        let parent = tempfile::tempdir().unwrap();
        let path = parent.path().join("clip");
        fs::create_dir(&path).unwrap();
        assert!(FrameFolder::inspect(&path, Existing::Refuse).is_ok());
        fs::write(path.join("frame-000000.png"), "old").unwrap();
        let error = FrameFolder::inspect(&path, Existing::Refuse).unwrap_err();
        assert!(matches!(error, FrameFolderError::NotEmpty { .. }), "{error}");
        assert_eq!(fs::read(path.join("frame-000000.png")).unwrap(), b"old");
    }

    #[test]
    fn frames_replace_frames_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        for name in ["frame-000000.png", "frame-000001.png", "frame-000001.png.part", "notes.txt"] {
            fs::write(file(name), "old").unwrap();
        }
        let mut frames = FrameFolder::inspect(folder.path(), Existing::Replace).unwrap();
        frames.clear(9).unwrap();
        frames.push(b"new").unwrap();
        let mut names: Vec<_> =
            fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["frame-000000.png", "notes.txt"]);
        assert_eq!(fs::read(file("frame-000000.png")).unwrap(), b"new");
        assert_eq!(frames.others(), ["notes.txt"]);
        assert!(frames.range().ends_with("frame-000000.png"), "{}", frames.range());
    }

    #[test]
    fn frames_up_to_the_first_gap_are_kept_and_have_to_be_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        for name in
            ["frame-000000.png", "frame-000001.png", "frame-000002.png.part", "frame-000003.png"]
        {
            fs::write(file(name), "old").unwrap();
        }
        let mut frames = FrameFolder::inspect(folder.path(), Existing::Continue).unwrap();
        frames.clear(9).unwrap();
        assert_eq!((frames.kept, fs::read_dir(folder.path()).unwrap().count()), (2, 2));
        frames.push(b"old").unwrap();
        let error = frames.push(b"new").unwrap_err();
        assert!(matches!(error, FrameFolderError::Foreign { .. }), "{error}");
        frames.push(b"old").unwrap();
        frames.push(b"new").unwrap();
        assert_eq!(fs::read(file("frame-000002.png")).unwrap(), b"new");
    }

    #[test]
    fn a_frame_that_cannot_be_written_leaves_nothing_behind() {
        let parent = tempfile::tempdir().unwrap();
        let mut frames = FrameFolder::inspect(parent.path(), Existing::Refuse).unwrap();
        frames.clear(9).unwrap();
        // A directory of that name cannot be replaced by a file.
        fs::create_dir_all(parent.path().join("frame-000000.png/in the way")).unwrap();
        let error = frames.push(b"new").unwrap_err().to_string();
        assert!(error.starts_with("cannot write "), "{error}");
        assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 1);
        assert_eq!(frames.range(), "none");
    }

    #[test]
    fn a_file_in_the_way_is_no_folder() {
        let parent = tempfile::tempdir().unwrap();
        let path = parent.path().join("clip");
        fs::write(&path, "mine").unwrap();
        let error = FrameFolder::inspect(&path, Existing::Replace).unwrap_err();
        assert!(matches!(error, FrameFolderError::NotADirectory { .. }), "{error}");
    }

    #[test]
    fn a_free_folder_is_found_beside_those_in_use() {
        let parent = tempfile::tempdir().unwrap();
        let name = parent.path().join("frames").display().to_string();
        assert_eq!(FrameFolder::beside(&name).unwrap().path(), Path::new(&name));
        fs::create_dir(&name).unwrap();
        fs::write(Path::new(&name).join("mine"), "").unwrap();
        fs::write(format!("{name}-2"), "a file").unwrap();
        let third = format!("{name}-3");
        assert_eq!(FrameFolder::beside(&name).unwrap().path(), Path::new(&third));
    }
}
