//! The result of `regatta verify` as text, as JSON and as JUnit's XML.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::commands::output::OutputError;

/// The first mark that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct PhysicsChange {
    pub(super) tick: u64,
    /// Its number, from 1, and its method.
    pub(super) lane: Option<(usize, &'static str)>,
    pub(super) what: String,
}

/// A frame that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FrameChange {
    pub(super) file: String,
    pub(super) what: String,
}

/// The result for a capture.
#[derive(Debug)]
pub(super) struct Report {
    pub(super) dir: PathBuf,
    pub(super) lanes: usize,
    pub(super) last_tick: u64,
    pub(super) mark_every: u64,
    pub(super) physics: Option<PhysicsChange>,
    /// The frames that were judged; `None` if only the physics was.
    pub(super) frames: Option<Vec<String>>,
    /// Whether frames have to be the same to the byte.
    pub(super) is_exact: bool,
    pub(super) pixels: Vec<FrameChange>,
}

impl Report {
    /// A report in which nothing is judged yet.
    pub(super) fn new(dir: &Path) -> Self {
        Self {
            dir: dir.to_owned(),
            lanes: 0,
            last_tick: 0,
            mark_every: 1,
            physics: None,
            frames: None,
            is_exact: true,
            pixels: Vec::new(),
        }
    }

    /// Names what differs: physics, pixels or both.
    pub(super) fn what_differs(&self) -> Option<&'static str> {
        match (&self.physics, self.pixels.is_empty()) {
            (Some(_), true) => Some("physics"),
            (None, false) => Some("pixels"),
            (Some(_), false) => Some("physics and pixels"),
            (None, true) => None,
        }
    }

    fn physics_line(&self) -> String {
        let Self { lanes, last_tick, mark_every, .. } = self;
        let Some(PhysicsChange { tick, lane, what }) = &self.physics else {
            let plural = if *lanes == 1 { "" } else { "s" };
            return format!("same to the bit: {lanes} lane{plural} to tick {last_tick}");
        };
        let marks = match mark_every {
            1 => String::new(),
            every => format!(" (looked at every {every} ticks)"),
        };
        let lane = lane.map_or(String::new(), |(n, method)| format!("lane {n}, {method}, "));
        format!("differs first at tick {tick}{marks}: {lane}{what}")
    }

    fn pixels_line(&self, frames: usize) -> String {
        let plural = if frames == 1 { "" } else { "s" };
        match (self.pixels.len(), self.is_exact) {
            (0, true) => format!("same: {frames} frame{plural}, every pixel"),
            (0, false) => format!("same within the limits: {frames} frame{plural}"),
            (changed, _) => format!("{changed} of {frames} frame{plural} differ"),
        }
    }

    /// Prints the result of the physics.
    pub(super) fn say_physics(&self) -> Result<(), OutputError> {
        say(&format!("physics: {}", self.physics_line()))
    }

    /// Prints the result of the pixels.
    pub(super) fn say_pixels(&self) -> Result<(), OutputError> {
        for FrameChange { file, what } in &self.pixels {
            say(&format!("pixels: {file}: {what}"))?;
        }
        match &self.frames {
            Some(frames) => say(&format!("pixels: {}", self.pixels_line(frames.len()))),
            None => Ok(()),
        }
    }

    /// As JSON, for programs.
    pub(super) fn to_json(&self) -> String {
        let physics = self.physics.as_ref().map(|change| {
            json!({
                "tick": change.tick,
                "lane": change.lane.map(|(n, _)| n),
                "method": change.lane.map(|(_, method)| method),
                "what": change.what,
            })
        });
        let changes =
            self.pixels.iter().map(|change| json!({ "file": change.file, "what": change.what }));
        let report = json!({
            "dir": self.dir.display().to_string(),
            "same": self.what_differs().is_none(),
            "physics": { "same": physics.is_none(), "first_difference": physics },
            "pixels": self.frames.as_ref().map(|frames| json!({
                "same": self.pixels.is_empty(),
                "frames": frames.len(),
                "differences": changes.collect::<Vec<_>>(),
            })),
        });
        format!("{report:#}\n")
    }

    /// As JUnit's XML, a test for the physics and one for each frame.
    pub(super) fn to_junit(&self) -> String {
        let frames = self.frames.iter().flatten();
        let change = |file: &String| self.pixels.iter().find(|change| change.file == *file);
        let cases = frames.map(|file| JunitCase {
            name: file.clone(),
            failure: change(file).map(|change| change.what.clone()),
        });
        let failure = self.physics.is_some().then(|| self.physics_line());
        let physics = JunitCase { name: "physics".into(), failure };
        let cases: Vec<_> = std::iter::once(physics).chain(cases).collect();
        junit(&format!("regatta verify {}", self.dir.display()), &cases)
    }
}

/// A test case of JUnit's XML.
pub(super) struct JunitCase {
    pub(super) name: String,
    pub(super) failure: Option<String>,
}

/// These tests as JUnit's XML.
pub(super) fn junit(suite: &str, cases: &[JunitCase]) -> String {
    let failures = cases.iter().filter(|case| case.failure.is_some()).count();
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <testsuite name=\"{}\" tests=\"{}\" failures=\"{failures}\" errors=\"0\">\n",
        escaped(suite),
        cases.len()
    );
    for JunitCase { name, failure } in cases {
        let name = escaped(name);
        text += &match failure {
            None => format!("  <testcase classname=\"regatta\" name=\"{name}\"/>\n"),
            Some(failure) => format!(
                "  <testcase classname=\"regatta\" name=\"{name}\">\
                 <failure message=\"{}\"/></testcase>\n",
                escaped(failure)
            ),
        };
    }
    text + "</testsuite>\n"
}

/// Prints a line to standard output.
pub(super) fn say(line: &str) -> Result<(), OutputError> {
    match writeln!(io::stdout(), "{line}") {
        // Whoever listens no more still gets the exit code.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(OutputError::Stdout(error)),
        _ => Ok(()),
    }
}

/// Escapes text for an attribute's value in XML.
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
