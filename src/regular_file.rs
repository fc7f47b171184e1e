//! Reads the regular files that a person names, up to a given size. Reading a pipe or a device could block for ever.

use std::fs::{File, Metadata};
use std::io::{self, Read};
use std::path::Path;

use crate::run::link;

/// Most bytes of a table, such as a log of a motion or of frames: half an hour of frames at 144 Hz.
pub(crate) const MAX_TABLE_BYTES: usize = 64 << 20;

/// Whether a path from a person is a link to a run instead of a file.
pub(crate) fn is_link(path: &Path) -> bool {
    path.to_str().is_some_and(link::is_link) && !path.exists()
}

/// The reason why a file is not read, with the remedy.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Unreadable {
    /// The system refuses, or there is no such file.
    #[error("{0}; give one that you may read")]
    System(#[from] io::Error),
    /// There is no such file: the path is a link to a run.
    #[error("it is a link to a run; give a file")]
    Link,
    /// The path is a directory.
    #[error("it is a directory; give a file in it")]
    Directory,
    /// The path is a pipe, a device or a socket.
    #[error(
        "it is no regular file but a pipe or a device, which may never end; write it to a file"
    )]
    NotRegular,
    /// The file is larger than allowed.
    #[error("it holds more than {max_bytes} bytes; give a shorter one")]
    TooLarge {
        /// Most bytes allowed.
        max_bytes: usize,
    },
}

impl Unreadable {
    /// Whether there is no such file.
    pub(crate) fn is_missing(&self) -> bool {
        matches!(self, Unreadable::System(error) if error.kind() == io::ErrorKind::NotFound)
    }
}

/// Reads a regular file of at most `max_bytes`. A file that reports a length of 0 gives no bytes.
pub(crate) fn read(path: &Path, max_bytes: usize) -> Result<Vec<u8>, Unreadable> {
    let bytes = read_start(path, max_bytes.saturating_add(1))?;
    if bytes.len() > max_bytes {
        return Err(Unreadable::TooLarge { max_bytes });
    }
    Ok(bytes)
}

/// Reads a table from a regular file, or from standard input if the path is `-`.
pub(crate) fn read_table(path: &Path) -> Result<Vec<u8>, Unreadable> {
    if path.as_os_str() != "-" {
        return read(path, MAX_TABLE_BYTES);
    }
    let mut bytes = Vec::new();
    io::stdin().lock().take(MAX_TABLE_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    match bytes.len() > MAX_TABLE_BYTES {
        true => Err(Unreadable::TooLarge { max_bytes: MAX_TABLE_BYTES }),
        false => Ok(bytes),
    }
}

/// Name of the table at this path, for messages.
pub(crate) fn table_name(path: &Path) -> String {
    match path.as_os_str() == "-" {
        true => "standard input".into(),
        false => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
    }
}

/// Reads the first bytes of a regular file, at most `max_bytes`.
pub(crate) fn read_start(path: &Path, max_bytes: usize) -> Result<Vec<u8>, Unreadable> {
    let mut bytes = Vec::new();
    open(path)?.take(max_bytes as u64).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Opens a regular file of any size. A file that reports a length of 0 gives no bytes.
pub(crate) fn open(path: &Path) -> Result<io::Take<File>, Unreadable> {
    if is_link(path) {
        return Err(Unreadable::Link);
    }
    // Check before opening: opening a pipe waits for its other end.
    check(&path.metadata()?)?;
    let file = File::open(path)?;
    let found = file.metadata()?;
    check(&found)?;
    // A file with a length of 0 may be the kernel's, such as /proc/kmsg. Reading that could block for ever, too.
    let most = if found.len() == 0 { 0 } else { u64::MAX };
    Ok(file.take(most))
}

fn check(found: &Metadata) -> Result<(), Unreadable> {
    match found {
        found if found.is_file() => Ok(()),
        found if found.is_dir() => Err(Unreadable::Directory),
        _ => Err(Unreadable::NotRegular),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "four").unwrap();
        assert_eq!(read(&path, 4).unwrap(), b"four");
        assert_eq!(read_start(&path, 3).unwrap(), b"fou");
        assert!(matches!(read(&path, 3), Err(Unreadable::TooLarge { max_bytes: 3 })));
        assert!(matches!(read(folder.path(), 4), Err(Unreadable::Directory)));
        assert!(read(&folder.path().join("b"), 4).unwrap_err().is_missing());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_without_a_length_reads_as_empty() {
        let path = Path::new("/proc/version");
        assert!(path.is_file() && !std::fs::read(path).unwrap().is_empty());
        assert_eq!(read(path, 4).unwrap(), b"");
    }

    #[cfg(unix)]
    #[test]
    fn pipes_and_devices_are_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
        assert!(made.success());
        for endless in [pipe.as_path(), Path::new("/dev/zero")] {
            let error = read(endless, 4).unwrap_err();
            assert!(matches!(error, Unreadable::NotRegular), "{}: {error}", endless.display());
        }
    }
}
