//! Restarts, and taking back what a person did.

use std::sync::Arc;

use super::Studio;
use crate::run::race::{Author, Mode};
use crate::run::{Run, StartSettings};

impl Studio {
    /// Begins the run again, with its settings as `set` sets them. The run so far is kept for an undo of the change `kept`,
    /// and lost if there is none.
    pub(super) fn restart(&mut self, kept: Option<&str>, set: impl FnOnce(&mut StartSettings)) {
        self.running = self.runs_or_rests();
        self.run.restart(kept, set);
        self.record_chosen_coordinates();
        self.select_entry_of_start();
        (self.viewer.notice, self.viewer.parting) = (None, None);
        self.viewer.live.jump();
        self.viewer.held = None;
        self.clock.set_tick_hz(self.race().tick_hz());
        self.clock.restart();
        self.dropped = 0;
    }

    /// Selects the lane under the method with which a solo run starts.
    pub(super) fn select_entry_of_start(&mut self) {
        let picked = self.picked(self.run.next().entry);
        self.viewer.selected = picked.unwrap_or(self.race().entrants()[0].id);
    }

    /// Restarts. A run in which a person has done something, or that began with other settings, is kept for an undo; any
    /// other would only repeat itself. Returns whether it was kept.
    pub(super) fn restart_keeping_run(&mut self) -> bool {
        let is_edited = !Arc::ptr_eq(self.run.session().scene(), &self.run.next().scene);
        let keeps = is_by_hand(&self.run) || is_edited;
        self.restart(keeps.then_some("the restart"), |_| ());
        keeps
    }

    /// Makes what was done so far part of the start, so that none of it can be undone: for a driver that has set up the studio
    /// by commands.
    pub fn forget_changes(&mut self) {
        self.run.forget_changes();
        self.note_saved();
    }

    /// Takes back the last change.
    pub(super) fn undo(&mut self) {
        let what = self.run.undoes().map(str::to_owned);
        let undone = what.map(|what| format!("undid {what}: Ctrl Shift Z redoes it"));
        self.exchange(Run::undo, undone.as_deref().unwrap_or("nothing to undo"));
    }

    /// Makes the change again that was undone last.
    pub(super) fn redo(&mut self) {
        let what = self.run.redoes().map(str::to_owned);
        let redone = what.map(|what| format!("redid {what}: Ctrl Z takes it back"));
        self.exchange(Run::redo, redone.as_deref().unwrap_or("nothing to redo"));
    }

    /// Goes to the other side of a change, if `exchange` does, and tells this.
    fn exchange(&mut self, exchange: fn(&mut Run) -> bool, notice: &str) {
        let rested = self.comes_to_rest();
        let StartSettings { entry, ref opened, .. } = *self.run.next();
        let opened = Arc::clone(opened);
        if !exchange(&mut self.run) {
            return self.viewer.set_notice(notice);
        }
        // Selecting a lane is not a change: the one that is selected stays so.
        let is_there = self.race().entrant(self.viewer.selected).is_some();
        if self.mode() == Mode::Race && is_there {
            self.run.next_mut().entry = entry;
        } else {
            self.select_entry_of_start();
        }
        if !Arc::ptr_eq(&opened, &self.run.next().opened) {
            self.viewer.findings = None;
        }
        self.viewer.held = None;
        self.viewer.live.jump();
        self.record_chosen_coordinates();
        self.run.show_present();
        self.clock.set_tick_hz(self.race().tick_hz());
        self.running |= rested && !self.comes_to_rest();
        self.viewer.set_notice(notice);
    }
}

/// Whether a person has acted on a run.
pub(super) fn is_by_hand(run: &Run) -> bool {
    run.session().journal().rows().iter().any(|row| row.author == Author::Person)
}
