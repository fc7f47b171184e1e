//! The destination of one stream of bytes. It is standard output, a device, a pipe, or a file that appears whole or not
//! at all.
//!
//! A file is replaced only when the new one is whole, so that a program that watches it never reads half a table. A
//! pipe or a device cannot be replaced, and is written to. A link stays, and its target is replaced.

use std::fs::{self, File};
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::atomic_file::{AtomicFile, IfExists};
use crate::commands::argument::brief;
use crate::commands::error::Error;
use crate::commands::interrupt;
use crate::commands::terminal::print_status;
use crate::commands::visible::{visible, visible_json};

/// The path that stands for standard output.
pub(crate) const STDOUT: &str = "-";

/// Links to files that the process has open, such as standard error. Their targets are in use, so they are not
/// replaced.
const OPEN_ALREADY: [&str; 4] = ["/dev/fd", "/dev/stdout", "/dev/stderr", "/proc/self/fd"];

/// Maximum length of a chain of links. On every system, a longer chain is a ring.
const MAX_LINKS: usize = 40;

/// Begins a file that appears whole or not at all. Watches for interrupts first, because an unhandled one would leave
/// the temporary name behind.
pub(crate) fn begin_file(path: &Path) -> io::Result<AtomicFile> {
    interrupt::watch_for_interrupt();
    AtomicFile::create(path)
}

/// The path of an output, and the option that errors name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Destination<'a> {
    /// Path of a file, of a link to one or of a device, or [`STDOUT`].
    pub(crate) path: &'a Path,
    /// Option with which the user gives the path, such as `--out`.
    pub(crate) option: &'static str,
    /// Policy for an existing file.
    pub(crate) if_exists: IfExists,
    /// Files that the command reads. They are never replaced.
    pub(crate) inputs: &'a [Input<'a>],
}

/// A file that a command reads, and its role, such as `the scene that is run`.
pub(crate) type Input<'a> = (&'a Path, &'static str);

impl Destination<'_> {
    /// Opens the destination for binary data, which may not go to a terminal.
    pub(crate) fn open(self) -> Result<Output, Error> {
        if self.path == Path::new(STDOUT) && io::stdout().is_terminal() {
            return Err(Error::mistake(format!(
                "pictures do not go to a terminal; give {} FILE, or send standard output elsewhere",
                self.option
            )));
        }
        self.open_for_text()
    }

    /// Opens the destination for text, which may go to a terminal.
    pub(crate) fn open_for_text(self) -> Result<Output, Error> {
        let Self { path, option, if_exists, inputs } = self;
        if path == Path::new(STDOUT) {
            return Ok(self.output(Target::Stdout));
        }
        let place = same_file_path(path);
        if let Some((_, input)) = inputs.iter().find(|(input, _)| same_file_path(input) == place) {
            let path = brief(path);
            return Err(Error::mistake(format!("{path} is {input}; give another {option}")));
        }
        match fs::metadata(path) {
            Ok(entry) if entry.is_dir() => {
                let path = brief(path);
                Err(Error::mistake(format!("{path} is a directory; give {option} a file")))
            }
            _ if path.to_string_lossy().ends_with(std::path::is_separator) => {
                let path = brief(path);
                Err(Error::mistake(format!("{path} ends like a directory; give {option} a file")))
            }
            Ok(_) if self.replaces().is_none() => {
                // Opening a pipe blocks until a program reads from it.
                let (name, device) = (brief(path), path.to_owned());
                let open = move || File::options().append(true).open(device);
                let device = interrupt::wait_for(&name, open)
                    .map_err(explain(Error::of_file("write", path, option)))?;
                Ok(self.output(Target::Device(Arc::new(device))))
            }
            // A link whose target does not exist counts as existing too.
            _ if if_exists != IfExists::Replace && fs::symlink_metadata(path).is_ok() => {
                Err(taken(path, option))
            }
            _ => self.begin(),
        }
    }

    /// Returns the file that the output would replace. Standard output, devices, pipes and files that the process has
    /// open are never replaced.
    pub(crate) fn replaces(&self) -> Option<&Path> {
        let is_open = OPEN_ALREADY.iter().any(|open| self.path.starts_with(open));
        let is_replaced = self.path != Path::new(STDOUT) && !is_open && self.path.is_file();
        is_replaced.then_some(self.path)
    }

    /// Begins a file, even if a file with its name exists. If the name is a link, the target is written and the link
    /// stays.
    pub(crate) fn begin(self) -> Result<Output, Error> {
        let begin = || {
            let mut file = begin_file(&end_of_links(self.path)?)?;
            if let Ok(older) = fs::metadata(self.path) {
                file.set_permissions_of(&older)?;
            }
            Ok(file)
        };
        let file = begin().map_err(Error::of_file("write", self.path, self.option))?;
        Ok(self.output(Target::File(file, self.if_exists)))
    }

    /// Opens the destination, writes text to it and closes it.
    pub(crate) fn write(self, text: &str) -> Result<(), Error> {
        let mut output = self.open_for_text()?;
        output.write_all(text.as_bytes())?;
        output.close().map(drop)
    }

    fn output(self, target: Target) -> Output {
        let sink =
            Sink { target, path: self.path.to_owned(), option: self.option, is_stuck: false };
        Output(BufWriter::new(sink))
    }
}

/// A stream that is being written. Its errors contain the message of the command.
pub(crate) struct Output(BufWriter<Sink>);

struct Sink {
    target: Target,
    path: PathBuf,
    option: &'static str,
    /// Whether an interrupt ended a wait for this stream. If so, dropping the stream must not wait again.
    is_stuck: bool,
}

enum Target {
    Stdout,
    /// A device or a pipe, which is written to but never replaced.
    Device(Arc<File>),
    File(AtomicFile, IfExists),
}

impl Output {
    pub(crate) fn stdout() -> Self {
        let (path, if_exists) = (Path::new(STDOUT), IfExists::Keep);
        let place = Destination { path, option: "--out", if_exists, inputs: &[] };
        place.output(Target::Stdout)
    }

    /// Returns the name of the output in messages.
    pub(crate) fn name(&self) -> String {
        self.0.get_ref().name()
    }

    /// Returns the path of the file, if the output is a file.
    pub(crate) fn file(&self) -> Option<&Path> {
        let Sink { target, path, .. } = self.0.get_ref();
        matches!(target, Target::File(..)).then_some(path)
    }

    /// Flushes the stream, and gives a file its final name. Returns the name of the output for messages.
    pub(crate) fn close(mut self) -> Result<String, Error> {
        self.flush()?;
        let name = self.name();
        let sink = self.0.into_inner().map_err(io::IntoInnerError::into_error)?;
        let Sink { target: Target::File(file, if_exists), path, option, .. } = sink else {
            return Ok(name);
        };
        let asked = file.path().to_owned();
        match file.commit(if_exists) {
            // A link is reported by its own name, unless the data went to another file than its target.
            Ok(written) if written == asked => Ok(name),
            Ok(written) => Ok(written.display().to_string()),
            // Another program has made a file with that name in the meantime.
            Err(error)
                if if_exists == IfExists::Keep && error.kind() == io::ErrorKind::AlreadyExists =>
            {
                Err(taken(&path, option))
            }
            Err(error) => Err(unfinished(&path, option, error)),
        }
    }

    /// Closes the stream. If it is a file, reports its content on standard error.
    pub(crate) fn finish(self, what: &str) -> Result<(), Error> {
        let is_file = self.file().is_some();
        let name = self.close()?;
        if is_file {
            print_status(&format!("wrote {what}: {name}"));
        }
        Ok(())
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl Sink {
    fn name(&self) -> String {
        match self.target {
            Target::Stdout => "standard output".into(),
            Target::Device(_) | Target::File(..) => brief(&self.path),
        }
    }

    /// Calls `act` on the stream. A full pipe blocks until its reader continues.
    fn with_stream<T: Send + 'static>(
        &mut self,
        bytes: &[u8],
        act: impl FnOnce(&mut dyn Write, &[u8]) -> io::Result<T> + Send + 'static,
    ) -> io::Result<T> {
        let name = self.name();
        if self.is_stuck {
            return Err(io::Error::other(Error::interrupted_while_waiting_for(&name)));
        }
        let done = match &mut self.target {
            Target::File(file, _) => act(file, bytes),
            Target::Stdout => {
                let bytes = bytes.to_owned();
                interrupt::wait_for(&name, move || act(&mut io::stdout(), &bytes))
            }
            Target::Device(device) => {
                let (device, bytes) = (Arc::clone(device), bytes.to_owned());
                interrupt::wait_for(&name, move || act(&mut &*device, &bytes))
            }
        };
        let is_ours = |error: &io::Error| error.get_ref().is_some_and(|inner| inner.is::<Error>());
        self.is_stuck = done.as_ref().err().is_some_and(is_ours);
        self.explained(done)
    }

    /// Puts the command's message into an I/O error. The error keeps its kind, because writers decide by the kind
    /// whether to retry.
    fn explained<T>(&self, result: io::Result<T>) -> io::Result<T> {
        result.map_err(|error| {
            let kind = error.kind();
            let explained = match self.target {
                Target::Stdout => error.into(),
                Target::Device(_) => {
                    explain(Error::of_file("write", &self.path, self.option))(error)
                }
                Target::File(..) => unfinished(&self.path, self.option, error),
            };
            io::Error::new(kind, explained)
        })
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.with_stream(bytes, |stream, bytes| stream.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.with_stream(&[], |stream, _| stream.flush())
    }
}

/// Keeps an error that is the command's own, such as an interrupt. Converts any other I/O error with `explain`.
fn explain(explain: impl Fn(io::Error) -> Error) -> impl Fn(io::Error) -> Error {
    move |error| error.downcast::<Error>().unwrap_or_else(&explain)
}

/// Writes text to standard output. Control characters become visible signs.
pub(crate) fn print(text: impl AsRef<str>) -> Result<(), Error> {
    print_bytes(visible(text.as_ref()).as_bytes())
}

/// Writes JSON to standard output. Control characters become escapes.
pub(crate) fn print_json(text: impl AsRef<str>) -> Result<(), Error> {
    print_bytes(visible_json(text.as_ref()).as_bytes())
}

fn print_bytes(bytes: &[u8]) -> Result<(), Error> {
    let mut out = Output::stdout();
    out.write_all(bytes)?;
    out.close().map(drop)
}

/// Returns the error for a file that could not be written to its end.
fn unfinished(path: &Path, option: &'static str, error: io::Error) -> Error {
    let is_there = !matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory);
    let error = Error::of_file("write", path, option)(error);
    match is_there {
        true => error.and("nothing is left of it, and the same command writes all of it"),
        false => error,
    }
}

fn taken(path: &Path, option: &str) -> Error {
    let path = brief(path);
    Error::mistake(format!(
        "{path} already exists; give another {option}, or --force to replace it"
    ))
}

/// Returns a path that identifies a file, however the file is spelled or linked, and whether it exists or not.
pub(crate) fn same_file_path(path: &Path) -> PathBuf {
    let of_new = |_| {
        let end = end_of_links(path)?;
        let folder = end.parent().filter(|folder| *folder != Path::new(""));
        let folder = folder.unwrap_or(Path::new(".")).canonicalize()?;
        Ok(folder.join(end.file_name().unwrap_or_default()))
    };
    let found: io::Result<PathBuf> = path.canonicalize().or_else(of_new);
    found.unwrap_or_else(|_| path.to_owned())
}

/// Returns the path at the end of the chain of links at `path`, whether a file exists there or not.
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
