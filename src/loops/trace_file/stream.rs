//! Assembles the frames of one window, row by row.

use super::Fault;
use super::columns::{Cells, Span};
use crate::time_base::RefreshRate;
use crate::trace::{ClockConflict, Frame, FrameTrace};

const YEAR_NS: i64 = 365 * 86_400_000_000_000;

/// A stream of frames, with the rows read so far.
pub(super) struct Stream {
    application: String,
    process: String,
    /// Line number of the stream's first row.
    line: u64,
    frames: Vec<Frame>,
    /// Duration of each frame before it began, in milliseconds and never rounded.
    exact_ms: Vec<f64>,
    /// The moment that each frame shows, if the log has it.
    shown_as: Vec<f64>,
    /// Time when the last displayed frame appeared, in nanoseconds.
    last_shown_ns: Option<i64>,
    /// Times when the next frame begins and appears, in logs whose rows record how long their own frame lasted and
    /// stayed.
    next_began_ns: Result<i64, Fault>,
    next_shown_ns: i64,
    /// Time that the generated frames after the last frame have lasted up to now, in nanoseconds.
    generated_ns: i64,
    /// First and last frame that have the log's own time, each with that time in nanoseconds. Below, the same for the
    /// time until display.
    timed: Option<[(Frame, f64); 2]>,
    shown: Option<[(Frame, f64); 2]>,
    /// Duration of the first frame before it began, in nanoseconds.
    lead_ns: i64,
}

/// Replaces control characters, because names appear in messages and on screens.
fn printable(name: &str) -> String {
    name.replace(char::is_control, "\u{fffd}")
}

impl Stream {
    /// Creates an empty stream for the program, process and line of its first row. The row itself is not added.
    pub(super) fn new(first: &Cells, line: u64) -> Self {
        Self {
            application: printable(first.application),
            process: printable(first.process),
            line,
            frames: Vec::new(),
            exact_ms: Vec::new(),
            shown_as: Vec::new(),
            last_shown_ns: None,
            next_began_ns: Ok(0),
            next_shown_ns: 0,
            generated_ns: 0,
            timed: None,
            shown: None,
            lead_ns: 0,
        }
    }

    /// Returns the name of the program; empty if the log has none.
    pub(super) fn application(&self) -> &str {
        &self.application
    }
    /// Returns the process; empty if the log has none.
    pub(super) fn process(&self) -> &str {
        &self.process
    }

    pub(super) fn line(&self) -> u64 {
        self.line
    }

    /// Returns the number of the stream's frames.
    pub(super) fn frames(&self) -> usize {
        self.frames.len()
    }

    /// Whether the stream has several frames with no time between them.
    pub(super) fn stands_still(&self) -> bool {
        let ends = self.frames.first().zip(self.frames.last());
        self.frames.len() > 1 && ends.is_some_and(|(first, last)| first.began_ns == last.began_ns)
    }

    /// Whether the stream has no frame of the program.
    pub(super) fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Adds the frame of a row. A generated frame only lets time pass, because the program's loop has no part in it.
    pub(super) fn push(&mut self, cells: &Cells) -> Result<(), Fault> {
        if cells.is_generated {
            return self.skip_generated_frame(cells);
        }
        let frame = match cells.span {
            Span::Before => self.after_the_last(cells)?,
            Span::After => self.at_the_next(cells)?,
        };
        if frame.began_ns.max(frame.displayed_ns.unwrap_or(0)) > YEAR_NS {
            return Err(Fault::TooLong);
        }
        self.last_shown_ns = frame.displayed_ns.or(self.last_shown_ns);
        if self.frames.is_empty() {
            self.lead_ns = cells.began_ns.as_ref().copied().unwrap_or_default();
        }
        let until = cells.until_ns.filter(|_| frame.displayed_ns.is_some());
        for (ends, beside) in [(&mut self.timed, cells.time_ns), (&mut self.shown, until)] {
            if let Some(beside) = beside {
                let first = ends.map_or((frame, beside), |[first, _]| first);
                *ends = Some([first, (frame, beside)]);
            }
        }
        let before_ns = self.frames.last().map_or(0, |last| last.began_ns);
        let rounded_ms = (frame.began_ns - before_ns) as f64 / 1e6;
        self.exact_ms.push(cells.began_ms.unwrap_or(rounded_ms));
        self.shown_as.extend(cells.shown_as);
        self.frames.push(frame);
        self.generated_ns = 0;
        Ok(())
    }

    /// Lets the times of a generated frame pass. The beginning of such a frame may be unknown.
    fn skip_generated_frame(&mut self, cells: &Cells) -> Result<(), Fault> {
        let began = cells.began_ns.as_ref().copied().unwrap_or(0);
        let shown = cells.displayed_ns.unwrap_or(0);
        let latest_ns = match cells.span {
            Span::Before => {
                self.generated_ns += began;
                self.last_shown_ns = self.last_shown_ns.map(|last| last + shown);
                self.generated_ns.max(self.last_shown_ns.unwrap_or(0))
            }
            Span::After => {
                self.next_began_ns = self.next_began_ns.clone().map(|next| next + began);
                self.next_shown_ns += shown;
                self.next_shown_ns.max(self.next_began_ns.as_ref().copied().unwrap_or(0))
            }
        };
        if latest_ns > YEAR_NS { Err(Fault::TooLong) } else { Ok(()) }
    }

    fn after_the_last(&self, cells: &Cells) -> Result<Frame, Fault> {
        let began_ns = match self.frames.last() {
            Some(last) => last.began_ns + self.generated_ns + cells.began_ns.clone()?,
            None => 0,
        };
        let displayed_ns = match (cells.displayed_ns, self.last_shown_ns) {
            (None, _) => None,
            (Some(until), _) if cells.is_until => Some(began_ns + until),
            // The previous display came before the recording.
            (Some(_), None) => Some(began_ns),
            // Logs without NA write 0 for a frame that was not displayed.
            (Some(0), Some(_)) if !cells.surely_displayed => None,
            (Some(change), Some(last)) => Some(last + change),
        };
        Ok(Frame { began_ns, displayed_ns })
    }

    fn at_the_next(&mut self, cells: &Cells) -> Result<Frame, Fault> {
        let began_ns = self.next_began_ns.clone()?;
        let displayed_ns =
            cells.displayed_ns.filter(|&ns| ns > 0 || cells.surely_displayed).map(|stays| {
                let shown =
                    if self.last_shown_ns.is_some() { self.next_shown_ns } else { began_ns };
                self.next_shown_ns = shown + stays;
                shown
            });
        self.next_began_ns = cells.began_ns.clone().map(|lasts| began_ns + lasts);
        Ok(Frame { began_ns, displayed_ns })
    }

    /// Returns the ratio of the log's own time to the frame times; `None` if the log has no time of its own.
    pub(super) fn time_ratio(&self) -> Option<f64> {
        let [(first, from), (last, to)] = self.timed?;
        let frames_ns = (last.began_ns - first.began_ns) as f64;
        Some((to - from) / frames_ns).filter(|ratio| ratio.is_finite() && *ratio > 0.0)
    }

    /// Returns which times contradict the frame times: the log's own time or the display times. If the unit of the
    /// log's own time is not certain, a factor of a power of 1000 is ignored.
    fn parting(&self, is_sure: bool) -> Option<ClockConflict> {
        let ratio = self.time_ratio().map(|ratio| match is_sure {
            true => ratio,
            false => ratio / libm::pow(1e3, (libm::log10(ratio) / 3.0).round()),
        });
        // A row may be written a few frames late.
        let few = 3.0 / self.frames.len() as f64;
        let is_late = ratio.is_some_and(|ratio| (ratio - 1.0).abs() > PARTED.max(few));
        let are_parted = are_parted(&self.frames, self.shown);
        is_late.then_some(ClockConflict::Time).or(are_parted.then_some(ClockConflict::Display))
    }

    /// Returns the trace of all frames of the stream. If times contradict each other, or `known` is a contradiction,
    /// frames count as displayed when they begin. `is_sure` is whether the unit of the log's own time is certain.
    pub(super) fn into_trace(
        mut self,
        name: String,
        is_sure: bool,
        known: Option<ClockConflict>,
    ) -> FrameTrace {
        let parting = self.parting(is_sure).or(known);
        if parting.is_some() {
            for frame in &mut self.frames {
                frame.displayed_ns = frame.displayed_ns.map(|_| frame.began_ns);
            }
        }
        let trace = FrameTrace::recorded(name, nominal_refresh(&self.frames), self.frames);
        let trace = trace.with_shown(self.shown_as);
        match parting {
            Some(parting) => trace.with_conflicting_clocks(parting),
            None => trace,
        }
    }

    /// Returns the duration of the first frame before it began in nanoseconds, and of all frames in milliseconds.
    pub(super) fn counted(&self) -> (i64, Vec<f64>) {
        (self.lead_ns, self.exact_ms.clone())
    }
}

/// Largest relative difference between a log's two clocks, and the longest queue before the display in refreshes.
const PARTED: f64 = 0.01;
const MAX_QUEUE: f64 = 6.0;

/// Whether the sum of the times between displays differs from the sum of the times between beginnings.
fn are_parted(frames: &[Frame], until: Option<[(Frame, f64); 2]>) -> bool {
    let mut shown = frames.iter().filter(|frame| frame.displayed_ns.is_some());
    let (Some(first), Some(last)) = (shown.next(), shown.next_back()) else { return false };
    let span = |of: fn(&Frame) -> i64| (of(last) - of(first)) as f64;
    let began_ns = span(|frame| frame.began_ns);
    let apart_ns = (span(|frame| frame.displayed_ns.unwrap_or_default()) - began_ns).abs();
    let queue_ns = MAX_QUEUE * 1e9 / nominal_refresh(frames).hz();
    // This is the change of latency by the two clocks, compared with the times until display.
    let against_ns = until.map_or(0.0, |[(first, from), (last, to)]| {
        let late = |frame: Frame| (frame.displayed_ns.unwrap_or_default() - frame.began_ns) as f64;
        ((late(last) - late(first)) - (to - from)).abs()
    });
    let most_ns = (PARTED * began_ns).max(queue_ns);
    apart_ns > most_ns || against_ns > most_ns
}

/// Returns the refresh rate whose period is the mean of the times between displayed frames within a quarter of the
/// median, because most frames last one refresh. With fewer than two displayed frames it is 60 Hz.
fn nominal_refresh(frames: &[Frame]) -> RefreshRate {
    let shown: Vec<i64> = frames.iter().filter_map(|frame| frame.displayed_ns).collect();
    let changes = shown.windows(2).map(|pair| pair[1] - pair[0]);
    let mut changes: Vec<i64> = changes.filter(|&ns| ns > 0).collect();
    if changes.is_empty() {
        return RefreshRate::new(60, 1);
    }
    let middle = changes.len() / 2;
    let median = *changes.select_nth_unstable(middle).1;
    // A clock with a coarse grain has the period in its mean.
    let usual = changes.iter().copied().filter(|ns| (ns - median).abs() <= median / 4);
    let (sum, count) = usual.fold((0, 0), |(sum, count), ns| (sum + i128::from(ns), count + 1));
    RefreshRate::of_period((sum / count.max(1)) as i64)
}
