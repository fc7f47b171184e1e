//! Writes the files that are saved in the window, under names that do not exist yet.

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes to `name.ending`, or to the first of `name-2.ending`, `name-3.ending` … that does not exist, and returns its
/// path.
pub(super) fn write_new(
    folder: &Path,
    name: &str,
    ending: &str,
    bytes: &[u8],
) -> io::Result<PathBuf> {
    let siblings = (2..).map(|n: u32| format!("{name}-{n}.{ending}"));
    for sibling in std::iter::once(format!("{name}.{ending}")).chain(siblings) {
        let path = folder.join(sibling);
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(mut file) => {
                return match file.write_all(bytes) {
                    Ok(()) => Ok(path),
                    Err(error) => {
                        // An incomplete file is useless.
                        let _ = std::fs::remove_file(&path);
                        Err(error)
                    }
                };
            }
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    unreachable!("no folder holds as many files")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_file_never_replaces_another() {
        let folder = tempfile::tempdir().unwrap();
        let names = ["shot.png", "shot-2.png", "shot-3.png"];
        for (i, name) in names.iter().enumerate() {
            let path = write_new(folder.path(), "shot", "png", &[i as u8]).unwrap();
            assert_eq!(path, folder.path().join(name));
        }
        for (i, name) in names.iter().enumerate() {
            assert_eq!(std::fs::read(folder.path().join(name)).unwrap(), [i as u8]);
        }
    }
}
