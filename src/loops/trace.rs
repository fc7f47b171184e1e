//! Frame traces, which record when a game begins each frame and when its picture is displayed.

use crate::table::Taken;
use std::sync::Arc;

use super::time_base::RefreshRate;
use crate::sim::number::{counted, grouped, significant};

/// A frame of a game, with the times when it began and when its picture was displayed, in nanoseconds from the start of
/// its trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Time when the game began the frame and read the time, in nanoseconds.
    pub began_ns: i64,
    /// Time when the frame's picture appeared on the display, in nanoseconds; `None` if another picture replaced it
    /// before.
    pub displayed_ns: Option<i64>,
}

/// A named sequence of frames on a display.
#[derive(Clone)]
pub struct FrameTrace {
    name: String,
    refresh: RefreshRate,
    source: Source,
    clocks: Clocks,
    /// Name of the tool that wrote the log, and the unit of its times if that was inferred; empty for a pattern.
    format: String,
    /// Duration of the first frame before it began, in nanoseconds, if the log counts it.
    lead_ns: Option<i64>,
    /// Duration of each frame in milliseconds as the log prints it, if the log counts the first.
    exact_ms: Arc<[f64]>,
    /// The moment that each frame shows, as the log prints it; empty if it has none.
    shown: Arc<[f64]>,
    /// The rows of the log that were taken; empty for a pattern.
    taken: Taken,
}

/// The clocks of a trace.
#[derive(Clone, Copy, PartialEq)]
enum Clocks {
    /// Frames begin and are displayed by the same clock.
    One,
    /// Frames begin by one clock and are displayed by another, without a common origin.
    Two,
    /// The log has only the times when frames begin, which count as times of display too.
    OfFrames,
    /// Like `OfFrames`, because times in the log contradict each other.
    Conflicting(ClockConflict),
}

/// Two contradictory kinds of times in a log. They differ by more than 1 %, or, for the averaged frames per second, by
/// more than a quarter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ClockConflict {
    /// The display times contradict the frame times.
    Display,
    /// The log's own time contradicts the frame times.
    Time,
    /// The frames per second contradict the frame times.
    Rate,
}

#[derive(Clone)]
enum Source {
    /// A finite list of frames.
    Recorded(Arc<[Frame]>),
    /// An endless pattern.
    Pattern(Box<dyn Pattern>),
}

/// An endless pattern of frames.
pub(super) trait Pattern: Send + Sync {
    /// Returns the next frame. `steps` is the number of steps that the game made in the previous frame.
    fn next(&mut self, steps: u32) -> Frame;

    /// Returns a copy of the pattern with its memory.
    fn boxed_clone(&self) -> Box<dyn Pattern>;
}

impl Clone for Box<dyn Pattern> {
    fn clone(&self) -> Self {
        self.boxed_clone()
    }
}

impl FrameTrace {
    /// Creates a trace of these frames, in order, on a display of this nominal rate.
    pub fn recorded(name: impl Into<String>, refresh: RefreshRate, frames: Vec<Frame>) -> Self {
        Self {
            name: name.into(),
            refresh,
            source: Source::Recorded(frames.into()),
            clocks: Clocks::Two,
            format: String::new(),
            lead_ns: None,
            exact_ms: Arc::new([]),
            shown: Arc::new([]),
            taken: Taken::default(),
        }
    }

    /// Creates a trace of a pattern from its start.
    pub(super) fn of_pattern(
        name: impl Into<String>,
        refresh: RefreshRate,
        pattern: impl Pattern + 'static,
    ) -> Self {
        let source = Source::Pattern(Box::new(pattern));
        let (clocks, format) = (Clocks::One, String::new());
        let taken = Taken::default();
        let [exact_ms, shown]: [Arc<[f64]>; 2] = [Arc::new([]), Arc::new([])];
        Self {
            name: name.into(),
            refresh,
            source,
            clocks,
            format,
            lead_ns: None,
            exact_ms,
            shown,
            taken,
        }
    }

    /// Returns the name of the trace.
    pub fn name(&self) -> &str {
        &self.name
    }
    /// Returns the nominal refresh rate of the trace's display.
    pub fn refresh(&self) -> RefreshRate {
        self.refresh
    }
    /// Returns the same frames, now with one clock by which they begin and are displayed.
    pub(super) fn by_one_clock(self) -> Self {
        Self { clocks: Clocks::One, ..self }
    }
    /// Returns the same frames, with the name of the tool that wrote them.
    pub(super) fn written_by(self, format: String) -> Self {
        Self { format, ..self }
    }
    /// Summarizes a log by its frames, their durations and the tool that wrote it; `None` for a pattern.
    pub fn summary(&self) -> Option<String> {
        let Source::Recorded(frames) = &self.source else { return None };
        let began: Vec<i64> = frames.iter().map(|frame| frame.began_ns).collect();
        let seconds = |ns: i64| ns as f64 / 1e9;
        let lead_ns = self.lead_ns.unwrap_or_default();
        let lasted_s = seconds(began.last()? - began.first()? + lead_ns);
        let lasted = began.windows(2).map(|pair| pair[1] - pair[0]).chain([lead_ns]);
        let longest = lasted.max().unwrap_or_default();
        let never = frames.iter().filter(|frame| frame.displayed_ns.is_none()).count();
        let never = match never {
            0 => String::new(),
            never => format!(", {} never displayed", grouped(never as u64)),
        };
        let rate = (frames.len() - usize::from(self.lead_ns.is_none())) as f64 / lasted_s;
        Some(format!(
            "read {} in {} s: {} a second, longest {} ms{never} ({}){}",
            counted(frames.len(), "frame"),
            significant(lasted_s, 3),
            significant(rate, 3),
            significant(1e3 * seconds(longest), 3),
            self.format,
            self.taken().map_or(String::new(), |taken| {
                let unit = taken.unit_in_words();
                format!("; {}; times {unit}{}", taken.rows_in_words(), taken.rest_in_words())
            })
        ))
    }
    /// Returns the same frames, marked as from a log without display times.
    pub(super) fn without_display(self) -> Self {
        Self { clocks: Clocks::OfFrames, ..self }
    }
    /// Whether frames begin and are displayed by one clock. In the logs of most tools there are two clocks.
    pub fn has_one_clock(&self) -> bool {
        self.clocks != Clocks::Two
    }
    /// Returns the same frames, with the rows of the log that were taken.
    pub(super) fn with_taken(self, taken: Taken) -> Self {
        Self { taken, ..self }
    }
    /// Returns the rows of the log that were taken; `None` for a pattern.
    pub fn taken(&self) -> Option<&Taken> {
        Some(&self.taken).filter(|taken| taken.of > 0)
    }
    /// Returns the same frames, without display times because the log contradicts itself.
    pub(super) fn with_conflicting_clocks(self, parting: ClockConflict) -> Self {
        Self { clocks: Clocks::Conflicting(parting), ..self }
    }
    /// Returns the same frames. If the first is counted, these are its nanoseconds from the start of the clock, and the
    /// milliseconds of all frames as the log prints them.
    pub(super) fn with_lead(self, counted: Option<(i64, Vec<f64>)>) -> Self {
        let Some((lead_ns, exact_ms)) = counted else { return self };
        Self { lead_ns: Some(lead_ns), exact_ms: exact_ms.into(), ..self }
    }
    /// Returns the same frames, with the moments that they show.
    pub(super) fn with_shown(self, shown: Vec<f64>) -> Self {
        Self { shown: shown.into(), ..self }
    }
    /// Returns the moments that the frames show, as the log prints them; empty if no column of them was named.
    pub fn shown(&self) -> &[f64] {
        &self.shown
    }
    /// Returns the duration of the first frame before it began, in nanoseconds, if the log counts it: a list of five
    /// times is five frames.
    pub fn lead_ns(&self) -> Option<i64> {
        self.lead_ns
    }
    /// Returns a notice about a log whose display times are missing or not used; `None` for any other trace.
    pub fn missing_display(&self) -> Option<&'static str> {
        match self.clocks {
            Clocks::One | Clocks::Two => None,
            Clocks::OfFrames => {
                Some("the log has no display times; each frame counts as shown when it begins")
            }
            Clocks::Conflicting(ClockConflict::Display) => Some(
                "the log's frame and display clocks part by more than 1 %, so its display times are ignored; each \
                 frame counts as shown when it begins",
            ),
            Clocks::Conflicting(ClockConflict::Time) => Some(
                "the log's own time and the sum of its frames part by more than 1 %, so one of them is wrong; each \
                 frame counts as shown when it begins",
            ),
            Clocks::Conflicting(ClockConflict::Rate) => Some(
                "the log's frame rates contradict its frame times, so one of them is wrong; each frame counts as \
                 shown when it begins",
            ),
        }
    }
    /// Whether the trace ends.
    pub fn ends(&self) -> bool {
        matches!(self.source, Source::Recorded(_))
    }
    /// Returns the same frames on a display with another nominal rate.
    pub fn on(self, refresh: RefreshRate) -> Self {
        Self { refresh, ..self }
    }
    /// Returns the frames of the trace, from the first.
    pub fn frames(&self) -> Frames {
        Frames {
            source: self.source.clone(),
            next: 0,
            refresh: self.refresh,
            exact_ms: self.exact_ms.clone(),
            last_ms: 0.0,
        }
    }
}

/// Iterates over the frames of a trace.
#[derive(Clone)]
pub struct Frames {
    source: Source,
    next: usize,
    refresh: RefreshRate,
    exact_ms: Arc<[f64]>,
    /// Time when the last frame began, which is exact if it began at a refresh.
    last_ms: f64,
}

impl Frames {
    /// Returns the next frame; `None` at the end of a recording. `steps` is the number of steps in the previous frame,
    /// because the duration depends on it if steps take long.
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

    /// Returns the duration of a frame that [`next`](Self::next) just gave, in milliseconds, as a clock in double
    /// precision reads it. It is not rounded to nanoseconds if the log prints it, or if frames begin at refreshes.
    pub fn duration_ms(&mut self, frame: Frame) -> f64 {
        let now_ms = CLOCK_MS + self.refresh.exact_ms(frame.began_ns);
        let before_ms = std::mem::replace(&mut self.last_ms, now_ms);
        match self.exact_ms.get(self.next.wrapping_sub(1)) {
            Some(ms) => *ms,
            None if before_ms == 0.0 => 0.0,
            None => now_ms - before_ms,
        }
    }
}

/// Time of the clock at the start of a trace, in milliseconds.
const CLOCK_MS: f64 = 1000.0;
