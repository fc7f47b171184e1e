//! Where one stream of bytes goes: standard output, a device or a pipe, or a file that appears whole or
//! not at all.

use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};

use super::atomic_file::{AtomicFile, Older};
use super::file_error::FileError;
use crate::commands::error::{Cause, Error};
use crate::commands::terminal::tell;

/// The path that means standard output.
pub(crate) const STDOUT: &str = "-";

/// Links to what the process has open, such as standard error. Their targets are in use and not replaced.
const OPEN_ALREADY: [&str; 4] = ["/dev/fd", "/dev/stdout", "/dev/stderr", "/proc/self/fd"];

/// A longer chain of links is a ring, on every system.
const MAX_LINKS: usize = 40;

/// Where an output goes, and the option to name in its errors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<'a> {
    /// A file, a link to one, a device, or [`STDOUT`].
    pub(crate) path: &'a Path,
    /// The option that names the path, such as `--out`.
    pub(crate) option: &'static str,
    /// What happens to an existing file.
    pub(crate) older: Older,
}

/// A stream being written.
pub(crate) enum AtomicOutput {
    Stdout(BufWriter<io::Stdout>),
    /// A device or a pipe, which is written to and not replaced.
    Device {
        device: BufWriter<File>,
        path: PathBuf,
        option: &'static str,
    },
    File {
        part: BufWriter<AtomicFile>,
        path: PathBuf,
        option: &'static str,
        older: Older,
    },
}

/// Why a stream could not be written.
#[derive(Debug, thiserror::Error)]
pub(crate) enum OutputError {
    /// The file exists, and may not be replaced.
    #[error("{} already exists; give another {option}, or --force to replace it", .path.display())]
    Taken {
        /// The path.
        path: PathBuf,
        /// The option that names it.
        option: &'static str,
    },
    /// The path is a directory.
    #[error("{} is a directory; give {option} a file", .path.display())]
    Directory {
        /// The path.
        path: PathBuf,
        /// The option that names it.
        option: &'static str,
    },
    /// Binary data would go to a terminal.
    #[error(
        "pictures do not go to a terminal; give {option} FILE, or send standard output elsewhere"
    )]
    Terminal {
        /// The option that names standard output.
        option: &'static str,
    },
    /// The file could not be made or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file could not be written to its end, and nothing of it is left.
    #[error("{0}; nothing is left of it, and the same command writes all of it")]
    Unfinished(FileError),
    /// Standard output could not be written.
    #[error("cannot write to standard output: {0}")]
    Stdout(io::Error),
}

impl Cause for OutputError {
    fn exit_code(&self) -> u8 {
        match self {
            OutputError::Taken { .. }
            | OutputError::Directory { .. }
            | OutputError::Terminal { .. } => 2,
            OutputError::File(_) | OutputError::Unfinished(_) | OutputError::Stdout(_) => 1,
        }
    }

    fn is_closed_pipe(&self) -> bool {
        let source = match self {
            OutputError::File(error) | OutputError::Unfinished(error) => &error.source,
            OutputError::Stdout(error) => error,
            _ => return false,
        };
        source.kind() == io::ErrorKind::BrokenPipe
    }
}

/// An error of a command that writes to standard output itself.
impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        OutputError::Stdout(error).into()
    }
}

impl AtomicOutput {
    /// Opens a place for binary data, which may not go to a terminal.
    pub(crate) fn open(place: Place<'_>) -> Result<Self, OutputError> {
        if place.path == Path::new(STDOUT) && io::stdout().is_terminal() {
            return Err(OutputError::Terminal { option: place.option });
        }
        Self::open_for_text(place)
    }

    /// Opens a place for text, which may go to a terminal.
    pub(crate) fn open_for_text(place: Place<'_>) -> Result<Self, OutputError> {
        let Place { path, option, older } = place;
        if path == Path::new(STDOUT) {
            return Ok(AtomicOutput::Stdout(BufWriter::new(io::stdout())));
        }
        let fail = FileError::of("write", path, option);
        let path = path.to_owned();
        match fs::metadata(&path) {
            Ok(entry) if entry.is_dir() => Err(OutputError::Directory { path, option }),
            Ok(entry) if !entry.is_file() || OPEN_ALREADY.iter().any(|o| path.starts_with(o)) => {
                let device = File::options().append(true).open(&path).map_err(fail)?;
                Ok(AtomicOutput::Device { device: BufWriter::new(device), path, option })
            }
            // A link that leads nowhere yet is taken too.
            _ if older == Older::Keep && fs::symlink_metadata(&path).is_ok() => {
                Err(OutputError::Taken { path, option })
            }
            _ => Self::begin(place),
        }
    }

    /// Begins a file, whether or not there is one of its name.
    pub(crate) fn begin(Place { path, option, older }: Place<'_>) -> Result<Self, OutputError> {
        let path = path.to_owned();
        let part = begin(&path, fs::metadata(&path).ok().as_ref());
        let part = BufWriter::new(part.map_err(FileError::of("write", &path, option))?);
        Ok(AtomicOutput::File { part, path, option, older })
    }

    /// Its name in messages.
    pub(crate) fn name(&self) -> String {
        match self {
            AtomicOutput::Stdout(_) => "standard output".into(),
            AtomicOutput::Device { path, .. } | AtomicOutput::File { path, .. } => {
                path.display().to_string()
            }
        }
    }

    /// The path of the file, if it is one.
    pub(crate) fn file(&self) -> Option<&Path> {
        match self {
            AtomicOutput::File { path, .. } => Some(path),
            AtomicOutput::Stdout(_) | AtomicOutput::Device { .. } => None,
        }
    }

    /// The error for a failed write.
    pub(crate) fn failed(&self, error: io::Error) -> OutputError {
        match self {
            AtomicOutput::Stdout(_) => OutputError::Stdout(error),
            AtomicOutput::Device { path, option, .. } => {
                FileError::of("write", path, option)(error).into()
            }
            AtomicOutput::File { path, option, .. } => unfinished(path, option)(error),
        }
    }

    /// Flushes the stream, and gives a file its name.
    pub(crate) fn close(mut self) -> Result<(), OutputError> {
        self.flush().map_err(|error| self.failed(error))?;
        let AtomicOutput::File { part, path, option, older } = self else { return Ok(()) };
        let whole = part.into_inner().map_err(io::IntoInnerError::into_error);
        whole.and_then(|part| part.commit(older)).map_err(|error| {
            // Somebody else made a file of that name in the meantime.
            if older == Older::Keep && error.kind() == io::ErrorKind::AlreadyExists {
                return OutputError::Taken { path: path.clone(), option };
            }
            unfinished(&path, option)(error)
        })
    }

    /// Like [`AtomicOutput::close`], but where somebody else has made a file of that name in the meantime, gives the file
    /// a free name beside it. Returns the name in messages.
    pub(crate) fn close_beside(mut self) -> Result<String, OutputError> {
        self.flush().map_err(|error| self.failed(error))?;
        let name = self.name();
        match self {
            AtomicOutput::File { part, path, option, older: Older::Keep } => {
                let whole = part.into_inner().map_err(io::IntoInnerError::into_error);
                let written = whole.and_then(AtomicFile::commit_beside);
                let written = written.map_err(unfinished(&path, option))?;
                // A link's own name stays the one to tell, unless the file is another.
                Ok(if written == end_of_links(&path).unwrap_or(path) {
                    name
                } else {
                    written.display().to_string()
                })
            }
            other => other.close().map(|()| name),
        }
    }
}

/// Writes text to standard output.
pub(crate) fn print(text: &str) -> Result<(), OutputError> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(OutputError::Stdout)
}

/// Writes text to a place, as one file or to a stream.
pub(crate) fn write_text(place: Place<'_>, text: &str) -> Result<(), OutputError> {
    let mut output = AtomicOutput::open_for_text(place)?;
    output.write_all(text.as_bytes()).map_err(|error| output.failed(error))?;
    output.close()
}

/// Writes the bytes and reports on standard error what a file now holds.
pub(crate) fn finish(
    mut output: AtomicOutput,
    bytes: &[u8],
    what: &str,
) -> Result<(), OutputError> {
    let written = output.write_all(bytes).map_err(|error| output.failed(error));
    let (name, is_file) = (output.name(), matches!(output, AtomicOutput::File { .. }));
    written.and_then(|()| output.close())?;
    if is_file {
        tell(&format!("wrote {what}: {name}"));
    }
    Ok(())
}

/// A conversion of the system's errors about a file that was begun at `path`, which `option` names.
fn unfinished(path: &Path, option: &'static str) -> impl Fn(io::Error) -> OutputError + use<> {
    let fail = FileError::of("write", path, option);
    move |error| OutputError::Unfinished(fail(error))
}

/// Begins a file at `path`. If that is a link, the file it leads to is written and the link stays.
fn begin(path: &Path, older: Option<&Metadata>) -> io::Result<AtomicFile> {
    let part = AtomicFile::create(&end_of_links(path)?)?;
    if let Some(older) = older {
        part.set_permissions_of(older)?;
    }
    Ok(part)
}

/// The end of the chain of links at `path`, whether a file exists there or not.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&path) {
            Ok(target) => path = path.parent().unwrap_or(Path::new("")).join(target),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("its links lead in a ring"))
}

impl Write for AtomicOutput {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            AtomicOutput::Stdout(out) => out.write(bytes),
            AtomicOutput::Device { device, .. } => device.write(bytes),
            AtomicOutput::File { part, .. } => part.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            AtomicOutput::Stdout(out) => out.flush(),
            AtomicOutput::Device { device, .. } => device.flush(),
            AtomicOutput::File { part, .. } => part.flush(),
        }
    }
}
