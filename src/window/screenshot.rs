//! A picture of the lab in the size of the window, drawn to a texture of our own: a surface need not
//! let itself be read.

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::lab::{Lab, Mode};
use crate::view::{Artist, Gpu, png};

/// Saves a picture beside nothing that exists, and says in a line for people what became of it.
pub(super) fn save(gpu: &Gpu, size_px: [u32; 2], scale: f32, lab: &Lab) -> String {
    match try_save(gpu, size_px, scale, lab) {
        Ok(path) => format!("saved {}", path.display()),
        Err(reason) => format!("no screenshot: {reason}"),
    }
}

fn try_save(gpu: &Gpu, size_px: [u32; 2], scale: f32, lab: &Lab) -> Result<PathBuf, String> {
    let mut rgba = Vec::new();
    Artist::new(gpu.clone(), size_px, scale)
        .map_err(|error| error.to_string())?
        .draw(lab, &mut rgba)
        .map_err(|error| error.to_string())?;
    write_new(Path::new(""), &name(lab), &png::encode(size_px, &rgba))
        .map_err(|error| format!("cannot write {}.png here: {error}", name(lab)))
}

/// What the picture shows, as a file name without its ending.
fn name(lab: &Lab) -> String {
    let method = match lab.mode() {
        Mode::Solo => lab.entries()[lab.active()].method.id,
        Mode::Race => "race",
    };
    format!("regatta-{}-{method}-tick-{}", lab.scene().name, lab.race().tick())
}

/// Writes to `name.png`, or to the first of `name-2.png`, `name-3.png` … that does not exist.
fn write_new(folder: &Path, name: &str, bytes: &[u8]) -> io::Result<PathBuf> {
    let siblings = (2..).map(|n: u32| format!("{name}-{n}.png"));
    for sibling in std::iter::once(format!("{name}.png")).chain(siblings) {
        let path = folder.join(sibling);
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(mut file) => {
                return match file.write_all(bytes) {
                    Ok(()) => Ok(path),
                    Err(error) => {
                        // Half a picture is none.
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
    fn a_screenshot_never_replaces_another() {
        let folder = tempfile::tempdir().unwrap();
        let names = ["shot.png", "shot-2.png", "shot-3.png"];
        for (i, name) in names.iter().enumerate() {
            let path = write_new(folder.path(), "shot", &[i as u8]).unwrap();
            assert_eq!(path, folder.path().join(name));
        }
        for (i, name) in names.iter().enumerate() {
            assert_eq!(std::fs::read(folder.path().join(name)).unwrap(), [i as u8]);
        }
    }
}
