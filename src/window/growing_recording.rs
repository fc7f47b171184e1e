//! Keeps the recording of a run as it grows, so that little of it is lost with the program.

use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;

use super::Event;
use super::opening::KeepRecording;
use super::work_thread::{Work, WorkThread};
use crate::lab::race::Journal;
use crate::lab::session::recording_text;
use crate::lab::{Scene, Studio};

/// The time between two recordings: what is lost at most.
const EVERY: Duration = Duration::from_secs(2);

/// Keeps the recording of a studio's run up to date.
pub(super) struct GrowingRecording {
    thread: WorkThread<Keeper>,
    asked: Option<Instant>,
}

/// What a recording is of: two that are alike have the same text.
#[derive(Clone)]
pub(super) struct Grown {
    scene: Arc<Scene>,
    journal: Journal,
    end: u64,
    recording: Option<Box<Scene>>,
}

impl Grown {
    /// What the recording of a studio's run would be of, without that.
    fn of(studio: &Studio) -> Self {
        let session = studio.timeline().session();
        let (scene, journal) = (Arc::clone(session.scene()), session.journal().clone());
        Self { scene, journal, end: studio.timeline().end(), recording: None }
    }
}

impl GrowingRecording {
    pub(super) fn new(keep: KeepRecording, events: EventLoopProxy<Event>) -> Self {
        let keeper = Keeper { run: None, keep: Some(keep) };
        Self { thread: WorkThread::new(keeper, None, events), asked: None }
    }

    /// Records the run so far, if that is due.
    pub(super) fn update(&mut self, studio: &Studio, now: Instant) {
        if self.asked.is_none_or(|asked| now.duration_since(asked) >= EVERY) {
            self.asked = Some(now);
            let recording = Some(studio.timeline().recording().into());
            self.thread.ask(Some(Grown { recording, ..Grown::of(studio) }));
        }
    }

    /// The time until it is due again; `None` if all that was done is recorded.
    pub(super) fn left(&self, studio: &Studio, now: Instant) -> Option<Duration> {
        let passed = self.asked.map_or(EVERY, |asked| now.duration_since(asked));
        let is_new = !Keeper::is_same(self.thread.request(), &Some(Grown::of(studio)));
        is_new.then(|| EVERY.saturating_sub(passed))
    }
}

/// Writes on a thread of its own: a long text takes longer than a frame, and a disk can.
struct Keeper {
    run: Option<Grown>,
    keep: Option<KeepRecording>,
}

impl Work for Keeper {
    type Request = Option<Grown>;

    fn is_same(one: &Self::Request, other: &Self::Request) -> bool {
        match (one, other) {
            (Some(one), Some(other)) => {
                Arc::ptr_eq(&one.scene, &other.scene)
                    && one.end == other.end
                    && one.journal == other.journal
            }
            (one, other) => one.is_none() && other.is_none(),
        }
    }

    fn set_request(&mut self, run: Self::Request) {
        self.run = run;
    }

    fn work(&mut self, _: &dyn Fn() -> bool) -> (Option<Event>, bool) {
        let recording = self.run.as_ref().and_then(|run| run.recording.as_ref());
        let (Some(keep), Some(recording)) = (&mut self.keep, recording) else {
            return (None, false);
        };
        let text = recording_text(recording).map_err(|error| error.to_string());
        if let Err(reason) = text.and_then(|text| keep(&text)) {
            // Said once. The window may still save the run when it is closed.
            self.keep = None;
            return (Some(Event::NotRecorded(reason)), false);
        }
        (None, false)
    }
}
