//! Keeps the recording of a run as it grows, so that little of it is lost with the program.

use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;

use super::Event;
use super::opening::KeepRecording;
use super::work_thread::{Work, WorkThread};
use crate::lab::Studio;
use crate::lab::session::{Recorder, RunToRecord};

/// The time between two recordings: what is lost at most.
const EVERY: Duration = Duration::from_secs(2);

/// Keeps the recording of a studio's run up to date.
pub(super) struct GrowingRecording {
    thread: WorkThread<Keeper>,
    asked: Option<Instant>,
}

impl GrowingRecording {
    pub(super) fn new(keep: KeepRecording, events: EventLoopProxy<Event>) -> Self {
        let keeper = Keeper { recorder: Recorder::default(), run: None, keep: Some(keep) };
        Self { thread: WorkThread::new(keeper, None, events), asked: None }
    }

    /// Records the run so far, if that is due.
    pub(super) fn update(&mut self, studio: &Studio, now: Instant) {
        if self.asked.is_none_or(|asked| now.duration_since(asked) >= EVERY) {
            self.asked = Some(now);
            self.thread.ask(Some(studio.to_record()));
        }
    }

    /// The time until it is due again; `None` if all that was done is recorded.
    pub(super) fn left(&self, studio: &Studio, now: Instant) -> Option<Duration> {
        let passed = self.asked.map_or(EVERY, |asked| now.duration_since(asked));
        let is_new = self.thread.request().as_ref() != Some(&studio.to_record());
        is_new.then(|| EVERY.saturating_sub(passed))
    }
}

struct Keeper {
    recorder: Recorder,
    run: Option<RunToRecord>,
    keep: Option<KeepRecording>,
}

impl Work for Keeper {
    type Request = Option<RunToRecord>;

    fn is_same(one: &Self::Request, other: &Self::Request) -> bool {
        one == other
    }

    fn set_request(&mut self, run: Self::Request) {
        self.run = run;
    }

    fn work(&mut self, stop: &dyn Fn() -> bool) -> (Option<Event>, bool) {
        let (Some(keep), Some(run)) = (&mut self.keep, &self.run) else { return (None, false) };
        let text = self.recorder.text(run, stop).map_err(|error| error.to_string());
        let kept = text.and_then(|text| keep(&text));
        if let Err(reason) = kept {
            // Said once. The window may still save the run when it is closed.
            self.keep = None;
            return (Some(Event::NotRecorded(reason)), false);
        }
        (None, false)
    }
}
