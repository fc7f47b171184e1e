//! The directory that a capture fills with numbered pictures, each of which appears whole or not at all.

use std::ffi::OsString;
use std::path::Path;

use super::folder::{Existing, Folder, FolderError, Ours};

/// The most frames in a folder: as many as six digits number.
pub(super) const MOST_FRAMES: u32 = 1_000_000;

/// A folder of frames.
#[derive(Debug)]
pub(super) struct FrameFolder {
    folder: Folder,
    frames: u32,
}

impl FrameFolder {
    /// Looks at the folder at `path`, which need not exist yet, and changes nothing.
    pub(super) fn inspect(path: &Path, existing: Existing) -> Result<Self, FolderError> {
        let ours = Ours { what: "frames", is_ours: is_frame };
        Ok(Self { folder: Folder::inspect(path, ours, existing)?, frames: 0 })
    }

    /// The first of `name`, `name-2`, `name-3` … that is new or an empty directory.
    pub(super) fn beside(name: &str) -> Result<Self, FolderError> {
        let siblings = (2..).map(|n: u32| format!("{name}-{n}"));
        for sibling in std::iter::once(name.to_owned()).chain(siblings) {
            match Self::inspect(Path::new(&sibling), Existing::Refuse) {
                Err(FolderError::NotEmpty { .. } | FolderError::NotADirectory { .. }) => {}
                found => return found,
            }
        }
        unreachable!("no file system holds as many directories")
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Makes the folder where there is none, and removes the frames of an earlier capture, so that
    /// it never holds frames of two.
    pub(super) fn clear(&mut self) -> Result<(), FolderError> {
        self.folder.clear()
    }

    /// Adds the next frame.
    pub(super) fn push(&mut self, picture: &[u8]) -> Result<(), FolderError> {
        self.folder.write(&frame_name(self.frames), picture)?;
        self.frames += 1;
        Ok(())
    }

    /// The frames written, by the names of the first and the last.
    pub(super) fn range(&self) -> String {
        let name = |frame| self.path().join(frame_name(frame)).display().to_string();
        match self.frames {
            0 => "none".into(),
            1 => name(0),
            frames => format!("{} … {}", name(0), frame_name(frames - 1)),
        }
    }

    /// Names of the entries that are none of our frames and have been left alone.
    pub(super) fn others(&self) -> &[OsString] {
        self.folder.others()
    }
}

fn frame_name(frame: u32) -> String {
    format!("frame-{frame:06}.png")
}

/// Whether a capture gives files this name.
fn is_frame(name: &str) -> bool {
    let digits = name.strip_prefix("frame-").and_then(|name| name.strip_suffix(".png"));
    digits.is_some_and(|digits| digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn only_numbered_pictures_are_frames() {
        for name in ["frame-000000.png", "frame-999999.png", "frame-000012.png"] {
            assert!(is_frame(name), "{name}");
        }
        for name in ["frame-00000.png", "frame-0000000.png", "frame-+00001.png", "frame-000001.gif"]
        {
            assert!(!is_frame(name), "{name}");
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
        assert!(matches!(error, FolderError::NotEmpty { .. }), "{error}");
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
        frames.clear().unwrap();
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
    fn a_frame_that_cannot_be_written_leaves_nothing_behind() {
        let parent = tempfile::tempdir().unwrap();
        let mut frames = FrameFolder::inspect(parent.path(), Existing::Refuse).unwrap();
        frames.clear().unwrap();
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
        assert!(matches!(error, FolderError::NotADirectory { .. }), "{error}");
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
