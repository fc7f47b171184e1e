//! A recording to compare with the run. It plays as a run beside the person's, and the stage shows it as a ghost.

use crate::run::diff::Difference;
use crate::run::race::{LaneBody, Mode};
use crate::run::{Run, StartSettings};
use crate::scene::{LaneSpec, Scene};

/// Most ticks that the recording advances at a time: an hour at 60 Hz, which takes about a second.
const MAX_TICKS: u64 = 60 * 3600;

/// A recording next to the run from which it differs.
pub struct Compared {
    name: String,
    first: Difference,
    run: Run,
}

impl Compared {
    /// The recording of this name at its start, and its first difference from the run.
    pub(super) fn new(name: &str, recording: Scene, first: Difference) -> Self {
        let mut start = StartSettings::of(recording);
        start.mode = Mode::opening(&start.scene);
        Self { name: name.to_owned(), first, run: Run::starting_with(start) }
    }

    /// Name of the recording.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Tick of the first difference.
    pub fn tick(&self) -> u64 {
        self.first.tick
    }

    /// The place and the size of the first difference, on one line each.
    pub fn lines(&self) -> [String; 2] {
        // Lane 0 of a trace is the truth.
        let place = self.first.place(|lane| match lane {
            "0" => "exact solution".into(),
            lane => format!("lane {lane}"),
        });
        [format!("first difference: {place}"), self.first.size()]
    }

    /// The recording's body with this index, at the tick of the run. Takes the lane with the method of `lane`, or
    /// else the first. `None` if the body has halted, or differs in kind from the one in `scene`.
    pub fn body(&self, scene: &Scene, lane: &LaneSpec, index: usize) -> Option<&LaneBody> {
        let own = self.run.session().scene().bodies.get(index)?;
        let lanes = self.run.race().entrants();
        let alike = lanes.iter().find(|other| other.spec.method == lane.method);
        let body = alike.unwrap_or(&lanes[0]).lane.bodies().get(index)?;
        (own.kind.id == scene.bodies[index].kind.id && body.halted().is_none()).then_some(body)
    }

    /// Moves to a tick of the run, forward by at most an hour of ticks.
    pub(super) fn go_to(&mut self, tick: u64) {
        self.run.seek(tick);
        let ahead = tick.saturating_sub(self.run.race().tick()).min(MAX_TICKS);
        (0..ahead).for_each(|_| self.run.tick(&mut ()));
    }
}
