//! Messages and progress on standard error.

#[cfg(feature = "view")]
use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
#[cfg(feature = "view")]
use std::path::Path;

use annotate_snippets::Renderer;
use indicatif::{ProgressBar, ProgressStyle};

use super::error::Error;
use super::visible::visible;

/// Writes a line to standard error. If standard error is closed, does nothing.
pub fn print_status(line: &str) {
    let _ = writeln!(io::stderr(), "{}", visible(line));
}

/// Writes the report of an error to standard error. It is in colour if the renderer is [styled](stderr_renderer).
pub fn print_error(error: &Error) {
    let _ = writeln!(io::stderr(), "{}", error.report(&stderr_renderer()));
}

/// Reports the entries of a folder that no command made and that are left alone.
#[cfg(feature = "view")]
pub(super) fn report_left_alone(folder: &Path, others: &[OsString]) {
    if !others.is_empty() {
        let others: Vec<_> = others.iter().map(|name| name.display().to_string()).collect();
        print_status(&format!("left alone in {}: {}", folder.display(), others.join(", ")));
    }
}

/// Returns the renderer of messages for standard error. It uses colours on a terminal, unless `NO_COLOR` is set or
/// `TERM` is `dumb`.
pub fn stderr_renderer() -> Renderer {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    if io::stderr().is_terminal() && !is_set("NO_COLOR") && !is_dumb {
        Renderer::styled()
    } else {
        Renderer::plain()
    }
}

/// Returns a progress bar over `number` frames or other `things`, which only a terminal shows.
pub(super) fn progress(number: u32, things: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} {msg}, {eta} left")
        .expect("the template is a constant");
    ProgressBar::new(u64::from(number)).with_style(style).with_message(things)
}
