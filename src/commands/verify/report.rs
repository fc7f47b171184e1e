//! The result of `regatta verify` for a capture or a recording, as text, as JSON or as JUnit XML.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde_json::{Map, Value, json};

use crate::atomic_file::IfExists;
use crate::commands::error::{Error, PlaceOf};
use crate::commands::frame_names::not_ours;
use crate::commands::output::table::TableFormat;
use crate::commands::output::{Destination, Input, Output, print, print_json};
use crate::commands::scene_file::name_in_messages;
use crate::commands::visible::shortened;
use crate::regular_file;

/// The format of a file that holds the result.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum ReportFormat {
    Junit,
    Json,
}

/// A file into which the result is written.
pub(super) struct ReportFile {
    format: ReportFormat,
    output: Output,
}

impl ReportFile {
    /// Opens the file before the work, so that a refusal does not come after it.
    pub(super) fn open(
        format: ReportFormat,
        path: &Path,
        inputs: &[Input<'_>],
    ) -> Result<Self, Error> {
        let to = Destination { path, option: "--report", if_exists: IfExists::Replace, inputs };
        let output = to.open_for_text()?;
        match to.replaces().is_some_and(|older| !is_report(older)) {
            true => Err(not_ours(path, PlaceOf::Option("--report"))),
            false => Ok(Self { format, output }),
        }
    }

    pub(super) fn write(mut self, report: &Report) -> Result<(), Error> {
        let text = match self.format {
            ReportFormat::Junit => report.to_junit(),
            ReportFormat::Json => report.to_json(),
        };
        self.output.write_all(text.as_bytes())?;
        self.output.close().map(drop)
    }
}

/// The start of a JUnit report.
const JUNIT_BEGINS: &str =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"regatta verify ";

/// JSON keys for the path of a capture, and for that of a recording.
pub(super) const DIRECTORY: &str = "dir";
pub(super) const FILE: &str = "file";

/// Number of bytes within which a report is recognised. It is more than a path has with its escapes.
const KNOWN_WITHIN: usize = 1 << 16;

/// Whether the file at `path` is empty, or begins like a report in one of the formats.
fn is_report(path: &Path) -> bool {
    let Ok(start) = regular_file::read_start(path, KNOWN_WITHIN) else { return false };
    let start = String::from_utf8_lossy(&start);
    let is_json = || {
        let mut lines = start.lines().map(str::trim_start);
        let begins = |line: Option<&str>, key: &str| {
            line.is_some_and(|line| line.starts_with(&format!("\"{key}\": ")))
        };
        let (brace, path, same) = (lines.next(), lines.next(), lines.next());
        let is_of_a_path = [DIRECTORY, FILE].iter().any(|key| begins(path, key));
        brace == Some("{") && is_of_a_path && begins(same, "same")
    };
    start.is_empty() || start.starts_with(JUNIT_BEGINS) || is_json()
}

/// The result of a command. Its lines go to standard output at once, unless the format is JSON.
#[derive(Debug)]
pub(super) struct Report {
    pub(super) path: PathBuf,
    /// Name of each judged case, and the difference in it, if there is one.
    cases: Vec<(String, Option<String>)>,
    /// JSON fields besides those that all reports have.
    fields: Map<String, Value>,
    /// JSON key for the path.
    key: &'static str,
    /// The message for the case that something differs.
    differs: String,
    format: TableFormat,
}

impl Report {
    /// Creates an empty report for standard output in this format. `key` is the JSON key for the path.
    pub(super) fn new(key: &'static str, path: &Path, format: TableFormat) -> Self {
        let (cases, fields) = (Vec::new(), Map::new());
        Self { path: path.to_owned(), cases, fields, key, differs: String::new(), format }
    }

    /// Prints a line to standard output.
    pub(super) fn say(&self, line: &str) -> Result<(), Error> {
        match self.format {
            TableFormat::Text => unless_closed(print(format!("{}\n", shortened(line)))),
            TableFormat::Json => Ok(()),
        }
    }

    /// Adds a case, with the difference in it, if there is one.
    pub(super) fn judged(&mut self, name: impl Into<String>, difference: Option<String>) {
        self.cases.push((name.into(), difference));
    }

    /// Adds a JSON field.
    pub(super) fn field(&mut self, key: &str, value: Value) {
        self.fields.insert(key.to_owned(), value);
    }

    /// Sets the message with which the command ends if something differs. It states the difference and the remedy.
    pub(super) fn if_different(&mut self, message: String) {
        self.differs = message;
    }

    /// Returns the number of cases that differ.
    pub(super) fn differing(&self) -> usize {
        self.cases.iter().filter(|(_, difference)| difference.is_some()).count()
    }

    /// Returns the result with which the command ends.
    pub(super) fn outcome(self) -> Result<(), Error> {
        if let TableFormat::Json = self.format {
            unless_closed(print_json(self.to_json()))?;
        }
        match self.differing() {
            0 => Ok(()),
            _ => Err(Error::failed(self.differs)),
        }
    }

    fn to_json(&self) -> String {
        let path = name_in_messages(&self.path);
        let mut object = json!({ self.key: path, "same": self.differing() == 0 });
        for (key, value) in &self.fields {
            object[key] = value.clone();
        }
        format!("{object:#}\n")
    }

    /// Returns the report as JUnit XML, with a test for each case.
    fn to_junit(&self) -> String {
        let mut text = format!(
            "{JUNIT_BEGINS}{}\" tests=\"{}\" failures=\"{}\" errors=\"0\">\n",
            escaped(&name_in_messages(&self.path)),
            self.cases.len(),
            self.differing(),
        );
        for (name, difference) in &self.cases {
            let name = escaped(name);
            text += &match difference {
                None => format!("  <testcase classname=\"regatta\" name=\"{name}\"/>\n"),
                Some(difference) => format!(
                    "  <testcase classname=\"regatta\" name=\"{name}\">\
                     <failure message=\"{}\"/></testcase>\n",
                    escaped(difference)
                ),
            };
        }
        text + "</testsuite>\n"
    }
}

/// Leaves out that the reader has closed the pipe, so that the command still ends with its exit code.
fn unless_closed(printed: Result<(), Error>) -> Result<(), Error> {
    printed.or_else(|error| if error.is_closed_pipe() { Ok(()) } else { Err(error) })
}

/// Escapes a text for the value of an attribute in XML.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}
