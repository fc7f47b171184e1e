//! The run before the last restart, which the plots keep beside the present run for comparison.

use super::run_beside::RunBeside;
use crate::run::Run;
use crate::run::past::History;
use crate::run::race::{Author, Entrant, Mode, Race};
use crate::scene::{Action, LaneSpec};
use crate::sim::TickRate;

/// The run before the last restart, under another tick rate, another method or other equations.
pub struct RunBefore {
    /// The past of each body in the lane that was selected.
    pub histories: Vec<History>,
    /// Time in seconds from which that run is drawn; before its start, unless a change of its file came before.
    pub from_s: f64,
    /// Time in seconds at which a person first changed the tick rate or the method of that run; infinity without a
    /// change. Later samples belong to neither run.
    pub until_s: f64,
    /// What that run had instead, such as `2 Hz` or `Explicit Euler`.
    pub name: String,
    /// Whether the present run goes on from the end of that run, after a change of its file.
    pub is_continued: bool,
}

/// A run that is about to restart.
pub(super) struct EndingRun {
    histories: Vec<History>,
    until_s: f64,
    began: (TickRate, LaneSpec),
}

/// The tick rate and the method with which a run begins, with all changes before its first tick, and the time of the
/// first later change.
fn beginning(run: &Run, selected: &Entrant) -> ((TickRate, LaneSpec), f64) {
    let start = run.start();
    let spec = start.entrant(selected.id).map_or(selected.spec, |entrant| entrant.spec);
    let mut began = (start.tick_hz(), spec);
    for row in run.session().journal().rows() {
        let is_by_hand = row.author == Author::Person;
        match &row.action {
            Action::TickHz(tick_hz) if is_by_hand && row.tick == 0 => began.0 = *tick_hz,
            Action::Lane { spec, .. } if is_by_hand && row.tick == 0 => began.1 = *spec,
            Action::TickHz(_) | Action::Lane { .. } if is_by_hand => return (began, row.at_s),
            _ => {}
        }
    }
    (began, f64::INFINITY)
}

impl EndingRun {
    /// The run that a restart is about to replace, if it has made a tick.
    pub(super) fn of(run: &Run, selected: &Entrant) -> Option<Self> {
        let (began, until_s) = beginning(run, selected);
        let histories = run.past().histories(selected.id).to_vec();
        (run.end() > 0).then_some(Self { histories, until_s, began })
    }

    /// Returns the solo run from its start at its tick rate, without the person's later actions. Returns `None` unless
    /// the run that has begun now differs from it in the tick rate alone.
    pub(super) fn beside(&self, from: Race, run: &Run, selected: &Entrant) -> Option<RunBeside> {
        let ((tick_hz, spec), now) = (self.began, beginning(run, selected).0);
        let is_beside = from.mode() == Mode::Solo && now.0 != tick_hz && now.1 == spec;
        let script = &run.session().scene().script;
        is_beside.then(|| RunBeside::new(from.at_rate(tick_hz).with_script(script)))
    }

    /// The run for comparison with the one that has begun now, if the two differ.
    pub(super) fn before(self, run: &Run, selected: &Entrant) -> Option<Box<RunBefore>> {
        let ((tick_hz, spec), now) = (self.began, beginning(run, selected).0);
        let name = match now {
            (now_hz, _) if now_hz != tick_hz => format!("{tick_hz:.3} Hz"),
            (_, now_spec) if now_spec != spec => spec.method.name.to_owned(),
            _ => return None,
        };
        let (Self { histories, until_s, .. }, from_s) = (self, f64::NEG_INFINITY);
        Some(Box::new(RunBefore { histories, from_s, until_s, name, is_continued: false }))
    }
}
