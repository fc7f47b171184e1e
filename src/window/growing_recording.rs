//! Saves the recording of a run as it grows, so that little of it is lost if the program dies.

use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;

use super::Event;
use super::opening::KeepRecording;
use super::work_thread::WorkThread;
use crate::run::race::Journal;
use crate::run::recording_text;
use crate::scene::Scene;
use crate::studio::{Studio, Work};

/// Time between two recordings, and the most that can be lost.
const EVERY: Duration = Duration::from_secs(2);

/// Keeps the saved recording of a studio's run up to date.
pub(super) struct GrowingRecording {
    thread: WorkThread<Keeper>,
    asked: Option<Instant>,
}

/// A recording, with the scene, journal and end of its run. If these are equal, so are the texts.
#[derive(Clone)]
pub(super) struct Grown {
    scene: Arc<Scene>,
    journal: Journal,
    end: u64,
    recording: Box<Scene>,
}

impl Grown {
    /// The recording of a studio's run so far.
    fn of(studio: &Studio) -> Self {
        let (timeline, session) = (studio.run(), studio.run().session());
        Self {
            scene: Arc::clone(session.scene()),
            journal: session.journal().clone(),
            end: timeline.end(),
            recording: studio.deck.recorded().into(),
        }
    }

    fn is_of(&self, scene: &Arc<Scene>, journal: &Journal, end: u64) -> bool {
        Arc::ptr_eq(&self.scene, scene) && self.end == end && self.journal == *journal
    }
}

impl GrowingRecording {
    pub(super) fn new(keep: KeepRecording, events: EventLoopProxy<Event>) -> Self {
        let keeper = Keeper { run: None, keep: Some(keep) };
        Self { thread: WorkThread::new(keeper, None, events), asked: None }
    }

    /// Saves the run so far, if that is due and the run has grown.
    pub(super) fn update(&mut self, studio: &Studio, now: Instant) {
        if self.time_to_next_save(studio, now) == Some(Duration::ZERO) {
            self.asked = Some(now);
            self.thread.set_request(Some(Grown::of(studio)));
        }
    }

    /// Time until the next save; `None` if everything is saved.
    pub(super) fn time_to_next_save(&self, studio: &Studio, now: Instant) -> Option<Duration> {
        let passed = self.asked.map_or(EVERY, |asked| now.duration_since(asked));
        let (end, session) = (studio.run().end(), studio.run().session());
        let is_known = |grown: &Grown| grown.is_of(session.scene(), session.journal(), end);
        let is_new = !self.thread.request().as_ref().is_some_and(is_known);
        is_new.then(|| EVERY.saturating_sub(passed))
    }
}

/// Writes on a separate thread: a long text takes longer than a frame, and so may a disk.
struct Keeper {
    run: Option<Grown>,
    keep: Option<KeepRecording>,
}

impl Work for Keeper {
    type Request = Option<Grown>;
    type Found = Event;

    fn is_same(one: &Self::Request, other: &Self::Request) -> bool {
        match (one, other) {
            (Some(one), Some(other)) => one.is_of(&other.scene, &other.journal, other.end),
            (one, other) => one.is_none() && other.is_none(),
        }
    }

    fn set_request(&mut self, run: Self::Request) {
        self.run = run;
    }

    fn step(&mut self, _: &dyn Fn() -> bool) -> (Option<Event>, bool) {
        let (Some(keep), Some(run)) = (&mut self.keep, &self.run) else { return (None, false) };
        let text = recording_text(&run.recording).map_err(|error| error.to_string());
        if let Err(reason) = text.and_then(|text| keep(&text)) {
            // Report it once. The window may still save the run when it is closed.
            self.keep = None;
            return (Some(Event::NotRecorded(reason)), false);
        }
        (None, false)
    }
}
