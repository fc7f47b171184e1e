//! Messages and progress on standard error.

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::Path;

use annotate_snippets::Renderer;
use anstream::{AutoStream, ColorChoice};
use indicatif::{ProgressBar, ProgressStyle};

use super::error::Error;
use super::visible::{shortened, visible};

/// Writes a line to standard error. If standard error is closed, does nothing.
pub fn print_status(line: &str) {
    let _ = writeln!(io::stderr(), "{}", visible(&shortened(line)));
}

/// Writes the report of an error to standard error. It is in colour on a terminal, unless `NO_COLOR` is set or `TERM`
/// is `dumb`.
pub fn print_error(error: &Error) {
    let renderer = match AutoStream::choice(&io::stderr()) {
        ColorChoice::Never => Renderer::plain(),
        _ => Renderer::styled(),
    };
    let _ = writeln!(anstream::stderr(), "{}", error.report(&renderer));
}

/// Reports the entries of a folder that no command made and that are left alone.
pub(super) fn report_left_alone(folder: &Path, others: &[OsString]) {
    if !others.is_empty() {
        let others: Vec<_> = others.iter().map(|name| name.display().to_string()).collect();
        print_status(&format!("left alone in {}: {}", folder.display(), others.join(", ")));
    }
}

/// Returns a progress bar over `number` frames or other `things`, which only a terminal shows.
pub(super) fn progress(number: u32, things: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} {msg}, {eta} left")
        .expect("the template is a constant");
    ProgressBar::new(u64::from(number)).with_style(style).with_message(things)
}
