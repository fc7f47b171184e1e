//! The recording of a run in progress, which is a scene file beside the final one. Every few seconds a longer recording
//! replaces it. It is removed when the final recording is whole. If a program is killed, the next start reports the
//! recording that was left behind.
//!
//! A note beside the settings names the path of the recording, and is locked as long as the program runs. Files there
//! are removed only if they have both the name and the text of a note.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::preferences;
use crate::atomic_file::{IfExists, RANDOM_CHARS, is_random};
use crate::commands::output::begin_file;
use crate::regular_file;
use crate::window::KeepRecording;

/// Text between the stem and the number in the name of an unfinished recording, and the ending of the name.
const UNFINISHED: &str = ".unfinished";
const ENDING: &str = ".toml";

/// The folder of notes beside the settings. It is hidden, so that nobody mistakes it for a store of recordings.
const NOTES_FOLDER: &str = ".unfinished-notes";

/// Text before and after the random characters in the name of a note.
const NOTE_NAME: [&str; 2] = ["recording-", ".note"];

/// The first line of a note. The path of the recording follows.
const HEADING: &str = "regatta has an unfinished recording in\n";

/// Maximum number of bytes of a note, which is more than a path has.
const MAX_NOTE_BYTES: usize = 1 << 16;

/// A recording in progress.
pub(super) struct UnfinishedRecording {
    state: Arc<Mutex<RecordingState>>,
}

enum RecordingState {
    /// Nothing is written yet. The file will have this path, or a free one beside it.
    Wanted(PathBuf),
    /// The file is growing. A note has its path, unless the note could not be written.
    Growing { path: PathBuf, note: Option<Note> },
    /// The recording is whole, so nothing more is written.
    Finished,
}

impl UnfinishedRecording {
    /// Creates an unfinished recording beside the file `recording`, which will contain the whole one.
    pub(super) fn for_recording(recording: &Path) -> Self {
        let stem = match recording.extension() {
            Some(ending) if ending == "toml" => recording.file_stem(),
            _ => recording.file_name(),
        };
        let mut name = stem.unwrap_or(OsStr::new("regatta")).to_owned();
        name.push(UNFINISHED);
        name.push(ENDING);
        let state = RecordingState::Wanted(recording.with_file_name(name));
        Self { state: Arc::new(Mutex::new(state)) }
    }

    /// Returns the callback that saves the recording so far.
    pub(super) fn keeper(&self) -> KeepRecording {
        let state = Arc::clone(&self.state);
        Box::new(move |text| {
            let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
            state.save(text).map_err(|error| format!("cannot write it yet: {error}"))
        })
    }

    /// Removes the file, because the recording is whole.
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
    fn save(&mut self, text: &str) -> io::Result<()> {
        match self {
            RecordingState::Wanted(path) => {
                let path = begin_file(path)?.write_whole(text.as_bytes(), IfExists::Beside)?;
                let note = notes_folder().and_then(|folder| Note::new(&folder, &path));
                let note = note.inspect_err(|error| log::info!("no note of it: {error}")).ok();
                *self = RecordingState::Growing { path, note };
                Ok(())
            }
            RecordingState::Growing { path, .. } => {
                begin_file(path)?.write_whole(text.as_bytes(), IfExists::Replace).map(drop)
            }
            RecordingState::Finished => Ok(()),
        }
    }
}

/// A file that has the path of an unfinished recording.
struct Note {
    path: PathBuf,
    _locked: File,
}

impl Note {
    fn new(folder: &Path, recording: &Path) -> io::Result<Self> {
        let recording = std::path::absolute(recording)?;
        let text = note_text(&recording).ok_or(io::ErrorKind::InvalidFilename)?;
        fs::create_dir_all(folder)?;
        let mut builder = tempfile::Builder::new();
        let [before, behind] = NOTE_NAME;
        builder.prefix(before).suffix(behind).rand_bytes(RANDOM_CHARS);
        let mut file = builder.tempfile_in(folder)?;
        file.as_file().lock()?;
        file.write_all(text.as_bytes())?;
        let (file, path) = file.keep()?;
        Ok(Self { path, _locked: file })
    }

    fn remove(self) -> io::Result<()> {
        fs::remove_file(self.path)
    }
}

fn notes_folder() -> io::Result<PathBuf> {
    let settings = preferences::folder().ok_or(io::ErrorKind::NotFound)?;
    Ok(settings.join(NOTES_FOLDER))
}

/// Returns the text of the note on a recording, or `None` if the path of the recording does not fit into a line.
fn note_text(recording: &Path) -> Option<String> {
    let path = recording.to_str().filter(|path| !path.contains(char::is_control))?;
    Some(format!("{HEADING}{path}"))
}

/// Returns the recording that the note at `path` names, or `None` if the file does not have both the name and the
/// text of a note.
fn recording_in(path: &Path) -> Option<PathBuf> {
    let [before, behind] = NOTE_NAME;
    let name = path.file_name()?.to_str()?;
    let random = name.strip_prefix(before)?.strip_suffix(behind)?;
    if !is_random(random) || !fs::symlink_metadata(path).is_ok_and(|entry| entry.is_file()) {
        return None;
    }
    let text = String::from_utf8(regular_file::read(path, MAX_NOTE_BYTES).ok()?).ok()?;
    let recording = PathBuf::from(text.strip_prefix(HEADING)?);
    let is_noted = note_text(&recording).is_some_and(|noted| noted == text);
    (is_noted && recording.is_absolute() && is_unfinished(&recording)).then_some(recording)
}

/// Removes the note at `path` if the program that wrote it no longer runs. Returns a message about the recording,
/// if that still exists.
fn left_behind_in(path: &Path) -> Option<String> {
    let recording = recording_in(path)?;
    // A program that still runs would have the lock.
    File::open(path).ok()?.try_lock().ok()?;
    fs::remove_file(path).ok()?;
    let name = recording.display();
    let message =
        format!("a recording was not finished when its window ended; {name} has it so far");
    recording.is_file().then_some(message)
}

/// Whether the name may be that of an [unfinished](UnfinishedRecording::for_recording) recording. Such a name is
/// `x.unfinished.toml`, or `x.unfinished-2.toml` if that was taken.
fn is_unfinished(recording: &Path) -> bool {
    let name = recording.file_name().and_then(OsStr::to_str).unwrap_or_default();
    let stem = name.strip_suffix(ENDING).unwrap_or_default();
    stem.rsplit_once(UNFINISHED).is_some_and(|(_, number)| {
        number.is_empty() || number.strip_prefix('-').is_some_and(|n| n.parse::<u32>().is_ok())
    })
}

/// Returns the messages about recordings that programs have left behind. Each recording appears once.
pub(super) fn left_behind() -> Vec<String> {
    let Ok(notes) = notes_folder().and_then(fs::read_dir) else { return Vec::new() };
    let notes = notes.filter_map(|entry| Some(entry.ok()?.path()));
    notes.filter_map(|note| left_behind_in(&note)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_autosave_replaces_no_file_and_is_removed_at_the_end() {
        let folder = tempfile::tempdir().unwrap();
        let [older, file] =
            ["run.unfinished.toml", "run.unfinished-2.toml"].map(|name| folder.path().join(name));
        fs::write(&older, "kept").unwrap();
        let mut state = RecordingState::Wanted(older.clone());
        for text in ["some", "some more"] {
            state.save(text).unwrap();
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
    fn a_note_of_a_dead_program_is_reported_once() {
        let folder = tempfile::tempdir().unwrap();
        let recording = folder.path().canonicalize().unwrap().join("run.unfinished.toml");
        fs::write(&recording, "").unwrap();
        let note = Note::new(&folder.path().join(NOTES_FOLDER), &recording).unwrap();
        let path = note.path.clone();
        assert_eq!(left_behind_in(&path), None, "its program runs");
        assert!(path.exists());
        drop(note);
        let message = left_behind_in(&path).unwrap();
        assert!(message.contains("run.unfinished.toml has it so far"), "{message}");
        assert!(!path.exists());
    }

    #[test]
    fn only_a_file_with_the_name_and_text_of_a_note_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().canonicalize().unwrap();
        let path = |name: &str| folder.join(name).display().to_string();
        let recording = path("run.unfinished.toml");
        let note = format!("{HEADING}{recording}");
        for (name, text) in [
            ("run.toml", note.clone()),
            ("recording-aB3dE6.note.toml", note.clone()),
            ("recording-aB3dE.note", note.clone()),
            ("recording-aB3dE7.note", recording.clone()),
            ("recording-aB3dE8.note", format!("{note}\n")),
            ("recording-aB3dE9.note", format!("{HEADING}run.unfinished.toml")),
            ("recording-aB3d10.note", format!("{}{}", HEADING, path("run.toml"))),
            ("recording-aB3d11.note", format!("my notes\n{note}")),
            ("recording-aB3d13.note", String::new()),
            ("run.unfinished.toml", recording.clone()),
        ] {
            fs::write(folder.join(name), &text).unwrap();
            assert_eq!(left_behind_in(&folder.join(name)), None, "{name}");
            assert_eq!(fs::read_to_string(folder.join(name)).unwrap(), text, "{name}");
        }
        // The note is removed too if its recording no longer exists.
        let path = folder.join("recording-aB3d12.note");
        let gone = folder.join("x.unfinished-12.toml");
        fs::write(&path, format!("{HEADING}{}", gone.display())).unwrap();
        assert_eq!(left_behind_in(&path), None);
        assert!(!path.exists());
    }

    #[test]
    fn the_autosave_is_named_after_the_recording() {
        for (recording, name) in [
            ("a/run.toml", "a/run.unfinished.toml"),
            ("run", "run.unfinished.toml"),
            ("run.v1", "run.v1.unfinished.toml"),
        ] {
            let unfinished = UnfinishedRecording::for_recording(Path::new(recording));
            let state = unfinished.state.lock().unwrap();
            assert!(matches!(&*state, RecordingState::Wanted(path) if path == Path::new(name)));
        }
    }
}
