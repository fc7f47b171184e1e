//! The recording of a run while it goes on: a scene file beside the final one. It is replaced by a longer one every few
//! seconds, and removed when the recording is whole. The next start tells of one that a killed program left behind.
//!
//! Where it is stands in a note of its own beside the settings, which is locked as long as the program runs.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::preferences;
use crate::atomic_file::{IfExists, write_file};
use crate::lab::scene::MAX_FILE_BYTES;
use crate::regular_file;
use crate::window::KeepRecording;

/// The folder of the notes.
const NOTES: &str = "recordings";

/// A recording that grows.
pub(super) struct UnfinishedRecording {
    state: Arc<Mutex<RecordingState>>,
}

enum RecordingState {
    /// Nothing was written yet. The file will be at this path, or at a free one beside it.
    Wanted(PathBuf),
    /// It is in this file, of which a note says where it is, where one can be made.
    Growing { path: PathBuf, note: Option<Note> },
    /// The recording is whole: no more is written.
    Finished,
}

impl UnfinishedRecording {
    /// One beside the file that the recording will be written to.
    pub(super) fn beside(recording: &Path) -> Self {
        let stem = match recording.extension() {
            Some(ending) if ending == "toml" => recording.file_stem(),
            _ => recording.file_name(),
        };
        let mut name = stem.unwrap_or(OsStr::new("regatta")).to_owned();
        name.push(".unfinished.toml");
        let state = RecordingState::Wanted(recording.with_file_name(name));
        Self { state: Arc::new(Mutex::new(state)) }
    }

    /// What keeps the recording so far.
    pub(super) fn keeper(&self) -> KeepRecording {
        let state = Arc::clone(&self.state);
        Box::new(move |text| {
            let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
            state.keep(text).map_err(|error| format!("cannot write it yet: {error}"))
        })
    }

    /// Removes the file: the recording is whole.
    pub(super) fn finish(self) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if let RecordingState::Growing { path, note } =
            std::mem::replace(&mut *state, RecordingState::Finished)
        {
            let gone = fs::remove_file(&path).and_then(|()| note.map_or(Ok(()), Note::remove));
            if let Err(error) = gone {
                log::info!("cannot remove {}: {error}", path.display());
            }
        }
    }
}

impl RecordingState {
    fn keep(&mut self, text: &str) -> io::Result<()> {
        match self {
            RecordingState::Wanted(path) => {
                let path = write_file(path, text.as_bytes(), IfExists::Beside)?;
                let note = notes().and_then(|folder| Note::new(&folder, &path));
                let note = note.inspect_err(|error| log::info!("no note of it: {error}")).ok();
                *self = RecordingState::Growing { path, note };
                Ok(())
            }
            RecordingState::Growing { path, .. } => {
                write_file(path, text.as_bytes(), IfExists::Replace).map(drop)
            }
            RecordingState::Finished => Ok(()),
        }
    }
}

/// A file that says where an unfinished recording is.
struct Note {
    path: PathBuf,
    _locked: File,
}

impl Note {
    fn new(folder: &Path, recording: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let (mut file, path) = tempfile::NamedTempFile::new_in(folder)?.keep()?;
        file.lock()?;
        file.write_all(recording.canonicalize()?.as_os_str().as_encoded_bytes())?;
        Ok(Self { path, _locked: file })
    }

    fn remove(self) -> io::Result<()> {
        fs::remove_file(self.path)
    }
}

fn notes() -> io::Result<PathBuf> {
    preferences::folder().map(|folder| folder.join(NOTES)).ok_or(io::ErrorKind::NotFound.into())
}

/// What to say, once, of the recordings that programs have left behind.
pub(super) fn left_behind() -> Vec<String> {
    let Ok(notes) = notes().and_then(fs::read_dir) else { return Vec::new() };
    let notes = notes.filter_map(|entry| Some(entry.ok()?.path()));
    notes.filter_map(|note| left_behind_in(&note)).collect()
}

fn left_behind_in(note: &Path) -> Option<String> {
    // The program that has written it would hold the lock.
    let is_free = File::open(note).is_ok_and(|file| file.try_lock().is_ok());
    let text = is_free.then(|| regular_file::read(note, MAX_FILE_BYTES).ok())??;
    let recording = PathBuf::from(String::from_utf8(text).ok()?);
    fs::remove_file(note).ok()?;
    let name = recording.display();
    let told = format!(
        "a recording was not finished when its window ended; what there is of it is in {name}"
    );
    recording.is_file().then_some(told)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_grows_beside_the_recording_replaces_nothing_and_is_removed_at_the_end() {
        let folder = tempfile::tempdir().unwrap();
        let [older, file] =
            ["run.unfinished.toml", "run.unfinished-2.toml"].map(|name| folder.path().join(name));
        fs::write(&older, "kept").unwrap();
        let mut state = RecordingState::Wanted(older.clone());
        for text in ["some", "some more"] {
            state.keep(text).unwrap();
            assert_eq!(fs::read_to_string(&file).unwrap(), text);
        }
        let unfinished = UnfinishedRecording { state: Arc::new(Mutex::new(state)) };
        let mut late = unfinished.keeper();
        unfinished.finish();
        late("even more").unwrap();
        assert!(!file.exists());
        assert_eq!(fs::read_to_string(&older).unwrap(), "kept");
    }

    #[test]
    fn a_note_is_told_of_once_when_its_program_is_gone() {
        let folder = tempfile::tempdir().unwrap();
        let recording = folder.path().join("run.unfinished.toml");
        fs::write(&recording, "").unwrap();
        let note = Note::new(&folder.path().join(NOTES), &recording).unwrap();
        let path = note.path.clone();
        assert_eq!(left_behind_in(&path), None, "its program runs");
        drop(note);
        let told = left_behind_in(&path).unwrap();
        assert!(told.ends_with("run.unfinished.toml"), "{told}");
        assert_eq!(left_behind_in(&path), None, "it was told");
    }

    #[test]
    fn its_name_is_that_of_the_recording() {
        for (recording, name) in [
            ("a/run.toml", "a/run.unfinished.toml"),
            ("run", "run.unfinished.toml"),
            ("run.v1", "run.v1.unfinished.toml"),
        ] {
            let unfinished = UnfinishedRecording::beside(Path::new(recording));
            let state = unfinished.state.lock().unwrap();
            assert!(matches!(&*state, RecordingState::Wanted(path) if path == Path::new(name)));
        }
    }
}
