//! The output directory of the figures. Each file in it appears whole or not at all.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::figures::CSV_BEGINS;
use crate::atomic_file::{IfExists, final_name};
use crate::commands::argument::brief;
use crate::commands::error::Error;
use crate::commands::frame_names::is_marked;
use crate::commands::output::begin_file;
use crate::regular_file;

pub(super) struct FigureFolder {
    path: PathBuf,
    /// Figures of an earlier run, whether complete or partial.
    old: Vec<OsString>,
    /// Names of entries that this command did not make.
    others: Vec<OsString>,
}

impl FigureFolder {
    /// Inspects the folder at `path`, which need not exist yet, without changing anything.
    pub(super) fn inspect(path: &Path) -> Result<Self, Error> {
        let fail = Error::of_file("read", path, "--out");
        let mut folder = Self { path: path.to_owned(), old: Vec::new(), others: Vec::new() };
        // Systems differ in the error of listing a file, so that its kind is asked for first.
        let no_directory = match fs::metadata(path) {
            Ok(entry) => !entry.is_dir(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(folder),
            Err(error) => error.kind() == io::ErrorKind::NotADirectory,
        };
        if no_directory {
            let path = brief(path);
            return Err(Error::mistake(format!("{path} is not a directory; give another --out")));
        }
        let entries = fs::read_dir(path).map_err(&fail)?;
        for entry in entries {
            let entry = entry.map_err(&fail)?;
            let is_file = !entry.file_type().map_err(&fail)?.is_dir();
            let name = entry.file_name();
            let text = name.to_str().unwrap_or_default();
            let is_old = is_file && (is_a_figures(text) || is_left_over(&entry.path()));
            let list = if is_old { &mut folder.old } else { &mut folder.others };
            list.push(name);
        }
        folder.others.sort();
        Ok(folder)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.old.is_empty() && self.others.is_empty()
    }

    /// Creates the folder if necessary, and removes the figures of an earlier run.
    pub(super) fn clear(&mut self) -> Result<(), Error> {
        fs::create_dir_all(&self.path).map_err(Error::of_file(
            "make the directory",
            &self.path,
            "--out",
        ))?;
        for name in self.old.drain(..) {
            let path = self.path.join(name);
            fs::remove_file(&path).map_err(Error::of_file("replace", &path, "--out"))?;
        }
        Ok(())
    }

    /// Writes a file under a temporary name, and renames it when it is whole.
    pub(super) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        let path = self.path.join(name);
        let written = begin_file(&path).and_then(|file| file.write_whole(bytes, IfExists::Replace));
        written.map(drop).map_err(Error::of_file("write", &path, "--out"))
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the names of the entries that this command did not make and has left alone.
    pub(super) fn others(&self) -> &[OsString] {
        &self.others
    }
}

/// Whether `name` is the file name of a figure or of its data.
fn is_a_figures(name: &str) -> bool {
    let stem = name.strip_suffix(".png").or_else(|| name.strip_suffix(".csv"));
    let number = stem.and_then(|stem| stem.strip_prefix("figure-7-"));
    number.is_some_and(|n| n.len() == 1 && n.bytes().all(|b| (b'2'..=b'8').contains(&b)))
}

/// Whether a run that was killed left the file at `path`. The file's name must match, and so must its content unless it
/// is empty.
fn is_left_over(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let begins = || regular_file::read_start(path, CSV_BEGINS.len());
    final_name(name).is_some_and(is_a_figures)
        && (is_marked(path)
            || begins().is_ok_and(|it| it.is_empty() || it == CSV_BEGINS.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::chapter::figures;
    use crate::view::png;

    #[test]
    fn only_leftovers_of_a_killed_run_are_removed() {
        let folder = tempfile::tempdir().unwrap();
        let picture = png::encode([1, 1], &[0; 4]);
        let csv = figures::csv(&figures::all()[0].figure).unwrap();
        let left = [
            ("figure-7-2.png.regatta-aB3dE6.part", picture.clone()),
            ("figure-7-3.csv.regatta-aB3dE6.part", csv),
            ("figure-7-4.csv.regatta-aB3dE6.part", Vec::new()),
        ];
        let kept = [
            ("figure-7-3.png.backup.part", picture.clone()),
            ("figure-7-3.png.regatta-aB3dE7.part", b"mine".to_vec()),
            ("figure-7-9.png.regatta-aB3dE7.part", picture),
        ];
        for (name, bytes) in left.iter().chain(&kept) {
            fs::write(folder.path().join(name), bytes).unwrap();
        }
        let mut figures = FigureFolder::inspect(folder.path()).unwrap();
        figures.clear().unwrap();
        let others: Vec<_> = kept.iter().map(|(name, _)| OsString::from(name)).collect();
        assert_eq!(figures.others(), others);
        for (name, bytes) in &kept {
            assert_eq!(&fs::read(folder.path().join(name)).unwrap(), bytes, "{name}");
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), kept.len());
    }
}
