//! Restarts, and the run before the last one, which an undo brings back.

use super::{BeforeDiscard, Lab};
use crate::lab::journal::Source;
use crate::lab::lane_spec::LaneSpec;
use crate::lab::session::Timeline;
use crate::lab::start::StartSettings;

/// A run that a restart has put aside, with its settings.
pub(super) struct RunBefore {
    start: StartSettings,
    timeline: Timeline,
    before_discard: Option<BeforeDiscard>,
    before_equal_cost: Option<Vec<LaneSpec>>,
    /// The number of the selected lane.
    selected: usize,
}

impl Lab {
    /// Begins the run again with the present settings. The run so far is lost unless it was [kept](Self::keep_run).
    pub(super) fn restart(&mut self) {
        self.timeline = Timeline::with_limit(self.start.session(), self.timeline.limit());
        self.record_chosen_coordinates();
        self.before_discard = None;
        self.viewer.selected = self.picked(self.start.entry).unwrap_or_default();
        self.viewer.notice = None;
        self.viewer.live.jump();
        self.viewer.held = None;
        self.clock.set_tick_hz(self.start.tick_hz);
        self.clock.restart();
        self.dropped = 0;
    }

    /// Restarts and keeps the run for an undo. Returns whether a person had done anything in it.
    pub(super) fn restart_keeping_run(&mut self) -> bool {
        let is_by_hand = is_by_hand(&self.timeline);
        self.keep_run();
        self.restart();
        is_by_hand
    }

    /// Keeps a copy of the settings and the run itself for an undo of the restart that has to follow. A run in which a
    /// person has done nothing does not replace one in which something was done.
    pub(super) fn keep_run(&mut self) {
        let kept = self.run_before.as_deref().is_some_and(|run| is_by_hand(&run.timeline));
        if self.timeline.end() == 0 && !is_by_hand(&self.timeline)
            || kept && !is_by_hand(&self.timeline)
        {
            return;
        }
        let timeline = Timeline::with_limit(self.start.session(), self.timeline.limit());
        self.run_before = Some(Box::new(RunBefore {
            start: self.start.clone(),
            timeline: std::mem::replace(&mut self.timeline, timeline),
            before_discard: self.before_discard.take(),
            before_equal_cost: self.viewer.before_equal_cost.clone(),
            selected: self.viewer.selected,
        }));
    }

    /// What an undo brings back now, for people; `None` if there is nothing.
    pub fn undoes(&self) -> Option<&'static str> {
        if self.timeline.can_undo() {
            return Some("bring back the future that an action in the past discarded");
        }
        self.run_before.is_some().then_some("bring back the run before a restart")
    }

    /// Exchanges the run with the one before the restart, if there is one: another undo exchanges them again.
    pub(super) fn bring_back_run(&mut self) {
        let Some(mut run) = self.run_before.take() else { return };
        std::mem::swap(&mut self.start, &mut run.start);
        std::mem::swap(&mut self.timeline, &mut run.timeline);
        std::mem::swap(&mut self.before_discard, &mut run.before_discard);
        std::mem::swap(&mut self.viewer.before_equal_cost, &mut run.before_equal_cost);
        std::mem::swap(&mut self.viewer.selected, &mut run.selected);
        self.run_before = Some(run);
        self.viewer.held = None;
        self.viewer.findings = None;
        self.record_chosen_coordinates();
        self.timeline.show_present();
        self.clock.set_tick_hz(self.race().tick_hz());
        self.set_notice("the run before the restart is back: Ctrl Z goes to the new one again");
    }
}

/// Whether a person has acted on a run.
pub(super) fn is_by_hand(timeline: &Timeline) -> bool {
    timeline.session().journal().rows().iter().any(|row| row.source == Source::Hand)
}
