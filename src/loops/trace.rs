//! The frames that a game has to make: when each begins, and when its picture is displayed.

use std::sync::Arc;

use super::time_base::RefreshRate;
use crate::sim::number::{counted, grouped, significant};

/// A frame of a game on a display: when it began and when its picture was displayed, in nanoseconds from the start of its trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// When the game began it, which is when it reads the time.
    pub began_ns: i64,
    /// When its picture appeared on the display; `None` if another replaced it before.
    pub displayed_ns: Option<i64>,
}

/// The frames of a game on a display, by name.
#[derive(Clone)]
pub struct FrameTrace {
    name: String,
    refresh: RefreshRate,
    source: Source,
    clocks: Clocks,
    /// What wrote it, and in what unit where that had to be found; empty of a pattern.
    format: String,
    /// How long the first frame took until it began, in nanoseconds, where a log counts it; else 0.
    lead_ns: i64,
}

/// By what clocks frames begin and are displayed.
#[derive(Clone, Copy, PartialEq)]
enum Clocks {
    /// One.
    One,
    /// Two without a common origin.
    Two,
    /// Only when they begin is known, and taken as when they are displayed.
    OfFrames,
    /// The same, since times of the log contradict each other.
    Parted(Parting),
}

/// Which times of a log contradict each other: by more than 1 %, or a quarter of frames a second, which are averages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Parting {
    /// Those of display and those of frames.
    Display,
    /// The log's own time and those of frames.
    Time,
    /// The frames a second and those of frames.
    Rate,
}

/// Where frames come from.
#[derive(Clone)]
enum Source {
    /// A list, which ends.
    Recorded(Arc<[Frame]>),
    /// A pattern without end.
    Pattern(Box<dyn Pattern>),
}

/// A pattern of frames without end.
pub(super) trait Pattern: Send + Sync {
    /// The next frame. `steps` is the number of steps that the game made in the one before.
    fn next(&mut self, steps: u32) -> Frame;

    /// A copy with its memory.
    fn boxed_clone(&self) -> Box<dyn Pattern>;
}

impl Clone for Box<dyn Pattern> {
    fn clone(&self) -> Self {
        self.boxed_clone()
    }
}

impl FrameTrace {
    /// The trace that these frames make, in order, on a display of this nominal rate.
    pub fn recorded(name: impl Into<String>, refresh: RefreshRate, frames: Vec<Frame>) -> Self {
        Self {
            name: name.into(),
            refresh,
            source: Source::Recorded(frames.into()),
            clocks: Clocks::Two,
            format: String::new(),
            lead_ns: 0,
        }
    }

    /// The trace of a pattern at its start.
    pub(super) fn of_pattern(
        name: impl Into<String>,
        refresh: RefreshRate,
        pattern: impl Pattern + 'static,
    ) -> Self {
        let source = Source::Pattern(Box::new(pattern));
        let (clocks, format) = (Clocks::One, String::new());
        Self { name: name.into(), refresh, source, clocks, format, lead_ns: 0 }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }
    /// The nominal rate of its display.
    pub fn refresh(&self) -> RefreshRate {
        self.refresh
    }
    /// The same frames, which begin and are displayed by one clock.
    pub(super) fn by_one_clock(self) -> Self {
        Self { clocks: Clocks::One, ..self }
    }
    /// The same frames as written by this tool.
    pub(super) fn written_by(self, format: String) -> Self {
        Self { format, ..self }
    }
    /// What was read of a log: its frames, how long they last, and what wrote it; `None` of a pattern.
    pub fn summary(&self) -> Option<String> {
        let Source::Recorded(frames) = &self.source else { return None };
        let began: Vec<i64> = frames.iter().map(|frame| frame.began_ns).collect();
        let seconds = |ns: i64| ns as f64 / 1e9;
        let lasted_s = seconds(began.last()? - began.first()? + self.lead_ns);
        let lasted = began.windows(2).map(|pair| pair[1] - pair[0]).chain([self.lead_ns]);
        let longest = lasted.max().unwrap_or_default();
        let never = frames.iter().filter(|frame| frame.displayed_ns.is_none()).count();
        let never = match never {
            0 => String::new(),
            never => format!(", {} never displayed", grouped(never as u64)),
        };
        let rate = (frames.len() - usize::from(self.lead_ns == 0)) as f64 / lasted_s;
        Some(format!(
            "read {} in {} s: {} a second, longest {} ms{never} ({})",
            counted(frames.len(), "frame"),
            significant(lasted_s, 3),
            significant(rate, 3),
            significant(1e3 * seconds(longest), 3),
            self.format
        ))
    }
    /// The same frames, of which only the beginnings were logged.
    pub(super) fn without_display(self) -> Self {
        Self { clocks: Clocks::OfFrames, ..self }
    }
    /// Whether its frames begin and are displayed by one clock. In the logs of tools they do not.
    pub fn has_one_clock(&self) -> bool {
        self.clocks != Clocks::Two
    }
    /// The same frames, whose times of display were taken for those of their beginnings, as times of the log part.
    pub(super) fn with_parted_clocks(self, parting: Parting) -> Self {
        Self { clocks: Clocks::Parted(parting), ..self }
    }
    /// The same frames, of which the first took so many nanoseconds until it began.
    pub(super) fn with_lead(self, lead_ns: i64) -> Self {
        Self { lead_ns, ..self }
    }
    /// What to say of a log whose times of display are missing or not used; `None` of any other trace.
    pub fn missing_display(&self) -> Option<&'static str> {
        match self.clocks {
            Clocks::One | Clocks::Two => None,
            Clocks::OfFrames => {
                Some("the log has no display times; each frame counts as shown when it begins")
            }
            Clocks::Parted(Parting::Display) => Some(
                "the log's clocks of frames and of display part by more than 1 %, so that its display times are not used; each frame counts as shown when it begins",
            ),
            Clocks::Parted(Parting::Time) => Some(
                "the log's own time and the sum of its frames part by more than 1 %, so that one of them is wrong; each frame counts as shown when it begins",
            ),
            Clocks::Parted(Parting::Rate) => Some(
                "the log's frames a second contradict its times of frames, so that one of them is wrong; each frame counts as shown when it begins",
            ),
        }
    }
    /// Whether it ends.
    pub fn ends(&self) -> bool {
        matches!(self.source, Source::Recorded(_))
    }
    /// The same frames on a display of another nominal rate.
    pub fn on(self, refresh: RefreshRate) -> Self {
        Self { refresh, ..self }
    }
    /// Its frames from the first on.
    pub fn frames(&self) -> Frames {
        Frames { source: self.source.clone(), next: 0 }
    }
}

/// The frames of a trace, one after the other.
#[derive(Clone)]
pub struct Frames {
    source: Source,
    next: usize,
}

impl Frames {
    /// The next frame; `None` at the end of a recording. `steps` is the number of steps that the game made in the frame
    /// before, on which it depends where a step takes long.
    pub fn next(&mut self, steps: u32) -> Option<Frame> {
        match &mut self.source {
            Source::Recorded(frames) => {
                let frame = frames.get(self.next).copied();
                self.next += 1;
                frame
            }
            Source::Pattern(pattern) => Some(pattern.next(steps)),
        }
    }
}
