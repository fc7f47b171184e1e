//! Time in a studio: for each frame it makes the ticks that are due.

use std::sync::Arc;

use super::Studio;
use super::live_loop::LiveFrame;
use super::looping::Activity;
use super::notices::Notices;
use crate::loops::Due;
use crate::run::Run;
use crate::run::race::{Mode, Observer};
use crate::scene::Action;

impl Studio {
    /// Adds a frame of `frame_ns` nanoseconds of real time, and makes the ticks that are due.
    pub fn advance(&mut self, frame_ns: i64) -> Due {
        self.advance_in_time(u64::MAX, frame_ns, &mut || true, &mut ())
    }

    /// Like [`Studio::advance`], but stops at tick `last`, and before the eyes of an observer. After each tick it asks whether
    /// there is time for another; if there is not, it drops those that are still due.
    pub fn advance_in_time(
        &mut self,
        last: u64,
        frame_ns: i64,
        is_time_left: &mut dyn FnMut() -> bool,
        observer: &mut dyn Observer,
    ) -> Due {
        if !self.time_runs() {
            self.viewer.live.jump();
            return Due::default();
        }
        self.viewer.pass(frame_ns);
        if let Activity::Loops(loops) = &mut self.activity {
            loops.advance(frame_ns);
            return Due::default();
        }
        // A tick rate that the script sets at this tick applies to the time from here on.
        let ((), told) = self.watched(|run, notices| run.catch_up(&mut (notices, &mut *observer)));
        self.tell(told);
        let percent = self.slow_motion_percent();
        let mut due = self.clock.advance(frame_ns.saturating_mul(i64::from(percent)) / 100);
        for made in 1..=due.ticks {
            if self.race().tick() >= last {
                break;
            }
            self.make_tick(observer);
            if last == u64::MAX && self.comes_to_rest() {
                due.ticks = made;
                self.running = false;
                // What to do next is told as a hint.
                self.viewer.notice = None;
                break;
            }
            if !is_time_left() {
                due.dropped += u64::from(due.ticks - made);
                due.ticks = made;
                break;
            }
        }
        if due.ticks > 0 {
            self.run.show_present();
        }
        self.dropped += due.dropped;
        self.note_frame(frame_ns, due);
        due
    }

    fn note_frame(&mut self, duration_ns: i64, due: Due) {
        let shown_s = self.shown_s();
        let percent = self.clock.speed_percent() * self.slow_motion_percent();
        let speed = f64::from(percent) / 1e4;
        let Due { ticks, dropped } = due;
        let frame = LiveFrame { duration_ns, ticks, dropped, animation_error_ms: 0.0 };
        self.viewer.live.add(frame, shown_s, speed);
    }

    /// Performs the actions at this tick, and steps to the next.
    pub fn tick(&mut self) {
        self.make_tick(&mut ());
    }

    fn make_tick(&mut self, observer: &mut dyn Observer) {
        let ((), told) = self.watched(|run, notices| run.tick(&mut (notices, observer)));
        self.tell(told);
    }

    pub(super) fn tell(&mut self, told: Vec<String>) {
        if !told.is_empty() {
            self.viewer.set_notice(told);
        }
    }

    /// Applies `change` to the run, and returns its result with the parts of a notice about it, if there is one.
    pub(super) fn watched<T>(
        &mut self,
        change: impl FnOnce(&mut Run, &mut Notices<'_>) -> T,
    ) -> (T, Vec<String>) {
        let scene = Arc::clone(&self.run.next().scene);
        let mut notices = Notices::new(&scene);
        let done = self.run.race().done();
        let changed = change(&mut self.run, &mut notices);
        let told = notices.told;
        self.clock.set_tick_hz(self.race().tick_hz());
        self.select_as_scripted(done);
        (changed, told)
    }

    /// In a race, selects the lane of the method that the script named after the first `done` rows of the journal.
    fn select_as_scripted(&mut self, done: usize) {
        let race = self.run.race();
        if race.mode() == Mode::Solo || race.done() <= done {
            return;
        }
        for row in &race.journal().rows()[done..race.done()] {
            let Action::Method(method) = row.action else { continue };
            let lane = race.entrants().iter().find(|e| e.spec.method == method);
            if let Some(lane) = lane {
                self.viewer.selected = lane.id;
                self.viewer.is_selected = true;
            }
        }
    }
}
