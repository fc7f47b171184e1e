//! The error that ends a command.
//!
//! The exit code follows from the reason, so that a script can tell a request to correct (2) from a run that failed (1)
//! and from an interrupt (130). A closed pipe ends the command quietly: its reader has enough. A mistake comes with its
//! remedy.

use std::fmt::Display;
use std::io;
use std::ops::Range;
use std::path::Path;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::argument::brief;
use super::visible::{shortened, visible};
use crate::scene::{SceneErrors, ShownError};
use crate::view::{FrameSizeError, GpuError, ReadbackError};

/// Maximum number of bytes of the quoted lines of a fault. Longer ones give way to an excerpt around the fault, with
/// this many bytes before and after it.
const MAX_QUOTED_BYTES: usize = 8000;
const EXCERPT_BYTES: usize = 60;

/// Reason for an error. The exit code follows from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ExitReason {
    /// The run has failed.
    Failed,
    /// The request cannot be met in the form in which it was made.
    Mistake,
    /// Ctrl-C was pressed, or the system asked the process to end.
    Interrupted,
    /// The reader of the command's output closed the pipe.
    ClosedPipe,
}

/// How the user named the place of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PlaceOf {
    /// By an option, which could name another place.
    Option(&'static str),
    /// As the clip to bless, which cannot be replaced by another place.
    Blessed,
}

impl PlaceOf {
    /// Returns the remedy. If an option names the place, another place is offered too.
    pub(super) fn or_another(self, remedy: &str) -> String {
        match self {
            Self::Option(option) => format!("{remedy}, or give another {option}"),
            Self::Blessed => remedy.to_owned(),
        }
    }

    /// Returns the remedy for an I/O error.
    fn remedy(self, error: &io::Error) -> String {
        match (error.kind(), self) {
            (io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded, _) => {
                self.or_another("free some space")
            }
            (io::ErrorKind::FileTooLarge, _) => {
                "raise the limit of a file's size (ulimit -f)".into()
            }
            // Windows finds nothing below a file, where other systems find no directory.
            (io::ErrorKind::NotFound | io::ErrorKind::NotADirectory, Self::Option(option)) => {
                format!("give another {option}, in a directory that is there")
            }
            (_, Self::Option(option)) => format!("give another {option} that you may write to"),
            (_, Self::Blessed) => "make it one that you may write to".into(),
        }
    }
}

/// The error that ends a command, with its exit code and its message.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct Error {
    kind: ExitReason,
    message: String,
    /// The mistakes in a scene file, which are reported with the lines of the file.
    scene: Option<SceneErrors>,
}

impl Error {
    fn new(kind: ExitReason, message: impl Display) -> Self {
        Self { kind, message: message.to_string(), scene: None }
    }

    /// Creates the error of a run that failed.
    pub(super) fn failed(message: impl Display) -> Self {
        Self::new(ExitReason::Failed, message)
    }

    /// Creates the error of a mistake in the request. The message ends with a remedy.
    pub(super) fn mistake(message: impl Display) -> Self {
        Self::new(ExitReason::Mistake, message)
    }

    /// Turns the error of a failed run into a mistake, for commands in which exit code 1 has another meaning.
    pub(super) fn into_mistake(self) -> Self {
        match self.kind {
            ExitReason::Failed => Self { kind: ExitReason::Mistake, ..self },
            _ => self,
        }
    }

    /// Creates the error of an interrupt after part of the work, such as `3 of 10 frames`.
    pub(super) fn interrupted_after(done: impl Display) -> Self {
        Self::new(ExitReason::Interrupted, format!("interrupted after {done}"))
    }

    /// Creates the error of an interrupt, for work whose result is written whole or not at all.
    pub(super) fn nothing_written() -> Self {
        Self::new(ExitReason::Interrupted, "interrupted; nothing was written")
    }

    /// Creates the error of an interrupt while nothing was reading the stream `name`.
    pub(super) fn interrupted_while_waiting_for(name: &str) -> Self {
        let message = format!("interrupted while nothing was reading {name}");
        Self::new(ExitReason::Interrupted, message)
    }

    /// Creates the error of a failed write. If the pipe is broken, its reader has closed it.
    pub(super) fn unwritten(error: &io::Error, message: impl Display) -> Self {
        let is_closed = error.kind() == io::ErrorKind::BrokenPipe;
        Self::new(if is_closed { ExitReason::ClosedPipe } else { ExitReason::Failed }, message)
    }

    /// Returns a converter of I/O errors that occur while `doing` something with the file or directory at `path`, for
    /// example `write`. `option` names the path on the command line.
    pub(super) fn of_file(
        doing: &'static str,
        path: &Path,
        option: &'static str,
    ) -> impl Fn(io::Error) -> Self + use<> {
        Self::of_place(doing, path, PlaceOf::Option(option))
    }

    /// Like `of_file`, but for a place that is named by an option or is a clip.
    pub(super) fn of_place(
        doing: &'static str,
        path: &Path,
        place: PlaceOf,
    ) -> impl Fn(io::Error) -> Self + use<> {
        let path = brief(path);
        move |error| {
            let remedy = place.remedy(&error);
            Self::unwritten(&error, format!("cannot {doing} {path}: {error}; {remedy}"))
        }
    }

    /// Puts words before the message.
    pub(super) fn within(self, words: &str) -> Self {
        Self { message: format!("{words}: {}", self.message), ..self }
    }

    /// Puts words after the message.
    pub(super) fn and(self, words: impl Display) -> Self {
        Self { message: format!("{}; {words}", self.message), ..self }
    }

    /// Turns the error into a mistake, unless it is an interrupt.
    pub(super) fn or_mistake(self) -> Self {
        let kind =
            if self.kind == ExitReason::Interrupted { self.kind } else { ExitReason::Mistake };
        Self { kind, ..self }
    }

    pub(super) fn is_mistake(&self) -> bool {
        self.kind == ExitReason::Mistake
    }

    /// Whether the reader of the command's output closed the pipe.
    pub(super) fn is_closed_pipe(&self) -> bool {
        self.kind == ExitReason::ClosedPipe
    }

    /// Returns the exit code of the process: 1 for a failed run, 2 for a mistake in the request, 130 for an interrupt.
    pub fn exit_code(&self) -> u8 {
        match self.kind {
            ExitReason::Failed | ExitReason::ClosedPipe => 1,
            ExitReason::Mistake => 2,
            ExitReason::Interrupted => 130,
        }
    }

    /// Returns the message, with the lines of the scene file to which it refers.
    pub fn report(&self, renderer: &Renderer) -> String {
        let mistakes = self.mistakes(renderer).into_iter();
        let parts = mistakes.flat_map(|ShownError { message, quoted }| [message, quoted]);
        parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n")
    }

    /// Returns the messages, each with the lines of the scene file to which it refers. Control characters appear as
    /// visible signs, except those of the renderer's colours.
    pub(super) fn mistakes(&self, renderer: &Renderer) -> Vec<ShownError> {
        let Some(errors) = &self.scene else {
            let message = shortened(&self.message);
            let title = Level::ERROR.primary_title(visible(&message));
            return vec![renderer.render(&[Group::with_title(title)]).into()];
        };
        let text = visible(&errors.text);
        let place = |at: usize| errors.text.get(..at).map_or(at, |before| visible(before).len());
        let spans = errors.errors.iter().map(|error| error.span.clone());
        let mut spans = spans.map(|span| place(span.start)..place(span.end));
        let mistake = |message: String| {
            let message = visible(&shortened(&message)).into_owned();
            let span = spans.next().filter(|_| !errors.text.is_empty());
            let quoted = span.map(|span| {
                let render = |text: &str, line, span| {
                    let annotation = AnnotationKind::Primary.span(span);
                    let snippet = Snippet::source(text).line_start(line).annotation(annotation);
                    renderer.render(&[Group::with_level(Level::ERROR).element(snippet)])
                };
                let whole = render(&text, 1, span.clone());
                if whole.len() <= MAX_QUOTED_BYTES {
                    return whole;
                }
                let (line, around) = around(&text, span.start);
                let end = span.end.clamp(span.start.min(around.end), around.end) - around.start;
                render(&text[around.clone()], line, span.start - around.start..end)
            });
            ShownError { message, quoted: quoted.unwrap_or_default() }
        };
        errors.messages().map(mistake).collect()
    }
}

/// Returns the number of the line at a byte, and the part of that line around the byte.
fn around(text: &str, at: usize) -> (usize, Range<usize>) {
    let line = text[..at].rfind('\n').map_or(0, |before| before + 1);
    let end = text[at..].find('\n').map_or(text.len(), |length| at + length);
    let from = text.ceil_char_boundary(line.max(at.saturating_sub(EXCERPT_BYTES)));
    let to = text.floor_char_boundary(end.min(at + EXCERPT_BYTES));
    (1 + text[..at].matches('\n').count(), from.min(at)..to.max(at))
}

impl From<SceneErrors> for Error {
    fn from(errors: SceneErrors) -> Self {
        Self { kind: ExitReason::Mistake, message: errors.to_string(), scene: Some(errors) }
    }
}

/// Recovers the command's own error from an I/O error. An I/O error that no `Output` has explained is about standard
/// output.
impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        error.downcast().unwrap_or_else(|error| {
            Self::unwritten(&error, format!("cannot write to standard output: {error}"))
        })
    }
}

impl From<GpuError> for Error {
    fn from(error: GpuError) -> Self {
        Self::failed(error)
    }
}

impl From<FrameSizeError> for Error {
    fn from(error: FrameSizeError) -> Self {
        match error {
            FrameSizeError::OutOfMemory { .. } => Self::failed(error),
            FrameSizeError::TooLarge { .. } | FrameSizeError::Empty { .. } => Self::mistake(error),
        }
    }
}

impl From<ReadbackError> for Error {
    fn from(error: ReadbackError) -> Self {
        Self::failed(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn long_texts_of_a_file_are_cut_around_their_fault() {
        let report = |error: Error| error.report(&Renderer::plain());
        let long = "é".repeat(20_000);
        let text = format!("title = 'x'\n# {long}\nseconds = \"{long}\" # {long}\n");
        let found = report(Scene::parse("x.toml", &text).unwrap_err().into());
        assert!(found.len() < 8000 && found.contains("x.toml:3:"), "{} {found}", found.len());
        assert!(found.contains("3 | ... = \"é") && found.contains('^'), "{found}");
        let found = report(Error::mistake(format!("begin {long} remedy")));
        assert!(found.len() < 8000 && found.contains("begin é") && found.ends_with("é remedy"));
    }
}
