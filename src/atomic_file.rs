//! A file that appears whole under its name or not at all, even after a loss of power. It is written under a
//! temporary name beside its place, synced, and renamed.
//!
//! The temporary name is in the same directory, because a rename is atomic only within a file system. The sync comes
//! before the rename, or after a loss of power the name could lead to an empty file.

use std::fs::{File, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// Text before and after the random characters of a temporary name.
const MARK: &str = ".regatta-";
const ENDING: &str = ".part";

/// Random characters in a temporary name.
pub(crate) const RANDOM_CHARS: usize = 6;

/// Longest name that a temporary name repeats. File systems take names of 255 bytes, and a longer one leaves no room
/// for the random characters.
const MAX_STEM: usize = 200;

/// A file being written. Dropping it before it is committed leaves nothing.
#[derive(Debug)]
pub(crate) struct AtomicFile {
    part: NamedTempFile,
    path: PathBuf,
    /// Whether Windows is to mark the final file as read-only.
    is_read_only: bool,
}

/// Policy for an existing file of the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum IfExists {
    /// The new file replaces it.
    Replace,
    /// It stays, and the new file is discarded.
    Keep,
    /// It stays, and the new file gets the first free name of `name-2`, `name-3` …
    Beside,
}

impl AtomicFile {
    /// Creates a file with a temporary name beside `path`.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        let name = path.file_name().filter(|name| name.len() <= MAX_STEM).unwrap_or_default();
        let mut prefix = name.to_owned();
        prefix.push(MARK);
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(ENDING).rand_bytes(RANDOM_CHARS);
        // Open it like any new file: only their owner may read the crate's own files.
        let create = |part: &Path| File::options().write(true).create_new(true).open(part);
        let part = builder.make_in(directory_of(path), create)?;
        Ok(Self { part, path: path.to_owned(), is_read_only: false })
    }

    /// The final name of the file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Copies the permissions of the file to be replaced.
    pub(crate) fn set_permissions_of(&mut self, older: &Metadata) -> io::Result<()> {
        if cfg!(windows) {
            self.is_read_only = older.permissions().readonly();
            return Ok(());
        }
        self.part.as_file().set_permissions(older.permissions())
    }

    /// Syncs the file, gives it its final name, and returns that. Only [`sync_directory`] makes the name survive a
    /// loss of power.
    pub(crate) fn rename(self, if_exists: IfExists) -> io::Result<PathBuf> {
        let Self { mut part, path, is_read_only } = self;
        part.as_file().sync_all()?;
        if if_exists == IfExists::Replace {
            if is_read_only {
                mark_read_only(&path, false)?;
            }
            let renamed = part.persist(&path);
            if is_read_only {
                mark_read_only(&path, true)?;
            }
            renamed.map_err(|failed| failed.error)?;
            return Ok(path);
        }
        for number in 1.. {
            let free = numbered(&path, number);
            match part.persist_noclobber(&free) {
                Ok(_) => return Ok(free),
                Err(taken)
                    if if_exists == IfExists::Beside
                        && taken.error.kind() == io::ErrorKind::AlreadyExists =>
                {
                    part = taken.file;
                }
                Err(failed) => return Err(failed.error),
            }
        }
        unreachable!("no folder holds as many files")
    }

    /// Writes the whole file and commits it. Returns its final name.
    pub(crate) fn write_whole(mut self, bytes: &[u8], if_exists: IfExists) -> io::Result<PathBuf> {
        self.write_all(bytes)?;
        self.commit(if_exists)
    }

    /// Syncs the file, renames it, and syncs the directory. Returns its final name.
    pub(crate) fn commit(self, if_exists: IfExists) -> io::Result<PathBuf> {
        let path = self.rename(if_exists)?;
        sync_directory(directory_of(&path)).map(|()| path)
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Do not write through the crate, which names the temporary file in its errors.
        self.part.as_file_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.part.as_file_mut().flush()
    }
}

/// Writes a whole file and returns its final name.
pub(crate) fn write_file(path: &Path, bytes: &[u8], if_exists: IfExists) -> io::Result<PathBuf> {
    AtomicFile::create(path)?.write_whole(bytes, if_exists)
}

/// Final name of the file with this temporary name; `None` if it is not a temporary name.
pub(crate) fn final_name(name: &str) -> Option<&str> {
    let (whole, random) = name.strip_suffix(ENDING)?.rsplit_once(MARK)?;
    is_random(random).then_some(whole)
}

/// Whether these may be the random characters of a temporary name.
pub(crate) fn is_random(characters: &str) -> bool {
    characters.len() == RANDOM_CHARS && characters.bytes().all(|b| b.is_ascii_alphanumeric())
}

/// Sets the mark of a file that Windows neither replaces nor removes. Other systems replace such a file.
#[cfg(not(windows))]
fn mark_read_only(_: &Path, _: bool) -> io::Result<()> {
    Ok(())
}

#[cfg(windows)]
fn mark_read_only(path: &Path, is_read_only: bool) -> io::Result<()> {
    let mut permissions = std::fs::metadata(path)?.permissions();
    permissions.set_readonly(is_read_only);
    std::fs::set_permissions(path, permissions)
}

/// Makes the names in a directory survive a loss of power, if the system offers a way.
pub(crate) fn sync_directory(path: &Path) -> io::Result<()> {
    if !cfg!(unix) {
        return Ok(());
    }
    match File::open(path)?.sync_all() {
        // Some file systems sync directories by themselves and offer no call for it.
        Err(error)
            if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) =>
        {
            Ok(())
        }
        synced => synced,
    }
}

/// The path with this number after the stem of its name. With 1 it is the path itself.
fn numbered(path: &Path, number: u32) -> PathBuf {
    if number == 1 {
        return path.to_owned();
    }
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number}"));
    if let Some(ending) = path.extension() {
        name.push(".");
        name.push(ending);
    }
    path.with_file_name(name)
}

fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_gets_its_final_name_only_when_complete() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.gif");
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"new").unwrap();
        let [under_way] = &names(folder.path())[..] else { panic!("one file") };
        assert_eq!(final_name(under_way), Some("run.gif"));
        file.commit(IfExists::Replace).unwrap();
        assert_eq!(names(folder.path()), ["run.gif"]);
        assert_eq!(fs::read(path).unwrap(), b"new");
    }

    #[test]
    fn an_abandoned_file_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut file = AtomicFile::create(&folder.path().join("run.gif")).unwrap();
        file.write_all(b"half").unwrap();
        drop(file);
        assert!(names(folder.path()).is_empty());
    }

    #[test]
    fn two_writers_of_one_name_do_not_conflict() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x");
        let [mut a, mut b] = [0, 1].map(|_| AtomicFile::create(&path).unwrap());
        a.write_all(b"a whole").unwrap();
        b.write_all(b"b whole").unwrap();
        a.commit(IfExists::Keep).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"a whole");
        let error = b.commit(IfExists::Keep).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::AlreadyExists);
        assert_eq!(names(folder.path()), ["x"]);
        assert_eq!(fs::read(&path).unwrap(), b"a whole");
    }

    #[test]
    fn a_file_whose_name_was_taken_meanwhile_gets_the_next_free_name() {
        let folder = tempfile::tempdir().unwrap();
        for (name, taken) in [("run.toml", "run-2.toml"), ("bare", "bare-2")] {
            let path = folder.path().join(name);
            let mut file = AtomicFile::create(&path).unwrap();
            file.write_all(b"ours").unwrap();
            fs::write(&path, "theirs").unwrap();
            let written = file.commit(IfExists::Beside).unwrap();
            assert_eq!(written, folder.path().join(taken));
            assert_eq!(fs::read(written).unwrap(), b"ours");
            assert_eq!(fs::read(path).unwrap(), b"theirs");
        }
        assert_eq!(names(folder.path()), ["bare", "bare-2", "run-2.toml", "run.toml"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_new_file_has_the_usual_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let [ours, plain] = ["ours", "plain"].map(|name| folder.path().join(name));
        write_file(&ours, b"", IfExists::Replace).unwrap();
        fs::write(&plain, b"").unwrap();
        let [ours, plain] = [ours, plain].map(|p| fs::metadata(p).unwrap().permissions().mode());
        assert_eq!(ours, plain);
    }

    #[test]
    fn only_our_temporary_names_have_a_final_name() {
        assert_eq!(final_name("frame-000001.png.regatta-aB3dE6.part"), Some("frame-000001.png"));
        for other in ["frame-000001.png.part", "x.part", "x.aB3dE6", "x.aB3d_6.part", "x.aB3.part"]
        {
            assert_eq!(final_name(other), None, "{other}");
        }
    }

    #[test]
    fn a_missing_directory_gives_the_error_of_the_system() {
        let folder = tempfile::tempdir().unwrap();
        let error = AtomicFile::create(&folder.path().join("no/x")).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
        assert!(!error.to_string().contains(ENDING), "{error}");
    }

    #[test]
    fn the_longest_valid_file_name_can_be_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x".repeat(255));
        write_file(&path, b"new", IfExists::Replace).unwrap();
        assert_eq!(fs::read(path).unwrap(), b"new");
    }
}
