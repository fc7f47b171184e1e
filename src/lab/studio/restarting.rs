//! Restarts, and taking back what a person did.

use std::sync::Arc;

use super::Studio;
use crate::lab::race::{Author, Mode};
use crate::lab::session::{Exchanged, Timeline};

impl Studio {
    /// Begins the run again with the present settings. The run so far is lost unless it was [kept](Self::keep_run).
    pub(super) fn restart(&mut self) {
        self.running = self.runs_or_rests();
        self.timeline.restart(self.start.session());
        self.record_chosen_coordinates();
        self.viewer.selected =
            self.picked(self.start.entry).unwrap_or(self.race().entrants()[0].id);
        (self.viewer.notice, self.viewer.parting) = (None, None);
        self.viewer.live.jump();
        self.viewer.held = None;
        self.clock.set_tick_hz(self.start.tick_hz);
        self.clock.restart();
        self.dropped = 0;
    }

    /// Restarts. A run in which a person has done something, or that began with other settings, is kept for an undo; any
    /// other would only repeat itself. Returns whether it was kept.
    pub(super) fn restart_keeping_run(&mut self) -> bool {
        let is_edited = !Arc::ptr_eq(self.timeline.session().scene(), &self.start.scene);
        let keeps = is_by_hand(&self.timeline) || is_edited;
        if keeps {
            self.keep_run("the restart");
        }
        self.restart();
        keeps
    }

    /// Keeps a copy of the settings and the run itself for an undo of the restart that has to follow.
    pub(super) fn keep_run(&mut self, what: &str) {
        self.running = self.runs_or_rests();
        self.timeline.keep_run(what, self.start.clone());
    }

    /// Makes what was done so far part of the start, so that none of it can be undone: for a driver that has set up the studio
    /// by commands.
    pub fn forget_changes(&mut self) {
        self.timeline.forget_changes();
        self.note_saved();
    }

    /// Takes back the last change.
    pub(super) fn undo(&mut self) {
        let rested = self.comes_to_rest();
        match self.timeline.undo_with(self.start.clone()) {
            Some(undone) => {
                let notice = format!("undid {}: Ctrl Shift Z redoes it", undone.what);
                self.after_exchange(undone, notice, rested);
            }
            None => self.viewer.set_notice("nothing to undo"),
        }
    }

    /// Makes the change again that was undone last.
    pub(super) fn redo(&mut self) {
        let rested = self.comes_to_rest();
        match self.timeline.redo_with(self.start.clone()) {
            Some(redone) => {
                let notice = format!("redid {}: Ctrl Z takes it back", redone.what);
                self.after_exchange(redone, notice, rested);
            }
            None => self.viewer.set_notice("nothing to redo"),
        }
    }

    /// Shows the run that was exchanged for another, which `rested` where nobody had paused it.
    fn after_exchange(&mut self, exchanged: Exchanged, notice: String, rested: bool) {
        let Exchanged { settings, is_restart, .. } = exchanged;
        let entry = self.start.entry;
        self.start = settings;
        // Selecting a lane is not a change: the one that is selected stays so.
        let is_there = self.race().entrant(self.viewer.selected).is_some();
        if self.mode() == Mode::Race && is_there {
            self.start.entry = entry;
        } else {
            self.viewer.selected =
                self.picked(self.start.entry).unwrap_or(self.race().entrants()[0].id);
        }
        if is_restart {
            self.viewer.findings = None;
        }
        self.viewer.held = None;
        self.viewer.live.jump();
        self.record_chosen_coordinates();
        self.timeline.show_present();
        self.clock.set_tick_hz(self.race().tick_hz());
        self.running |= rested && !self.comes_to_rest();
        self.viewer.set_notice(notice);
    }
}

/// Whether a person has acted on a run.
pub(super) fn is_by_hand(timeline: &Timeline) -> bool {
    timeline.session().journal().rows().iter().any(|row| row.author == Author::Person)
}
