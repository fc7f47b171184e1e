//! Reads the sources for their tables, names, circles and lengths.
//!
//! Each rule is a function from a file's text to complaints. A bad text proves that each rule detects its fault.

mod circles;
mod paths;
mod prose;
mod rooms;
mod rules;
mod tables;

use std::path::{Path, PathBuf};

/// A file of the package: its path from the root, with `/`, and its text.
struct Source {
    path: String,
    text: String,
}

pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every file with one of these endings under `folder`, in order of path.
fn sources(folder: &str, endings: &[&str]) -> Vec<Source> {
    let mut folders = vec![root().join(folder)];
    let mut files: Vec<PathBuf> = Vec::new();
    while let Some(folder) = folders.pop() {
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        for entry in entries {
            let path = entry.expect("a folder can be read").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| endings.iter().any(|ending| e == *ending)) {
                files.push(path);
            }
        }
    }
    files.sort();
    let read = |path: PathBuf| {
        let name = path.strip_prefix(root()).expect("found under the root");
        let name = name.components().map(|part| part.as_os_str().to_string_lossy());
        Source {
            path: name.collect::<Vec<_>>().join("/"),
            text: std::fs::read_to_string(&path).expect("sources are text"),
        }
    };
    files.into_iter().map(read).collect()
}

fn none(complaints: Vec<String>) {
    assert!(complaints.is_empty(), "\n{}\n", complaints.join("\n"));
}
