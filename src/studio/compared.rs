//! A recording to compare with the run. It is a run of its own beside the person's run, and the stage shows it as a
//! ghost.

use crate::run::diff::Difference;
use crate::run::race::{LaneBody, Mode};
use crate::run::{Run, StartSettings};
use crate::scene::{LaneSpec, Scene};

/// Maximum number of ticks by which the recording advances at a time. It is an hour at 60 Hz, which takes about a
/// second to compute.
const MAX_TICKS: u64 = 60 * 3600;

/// A recording that differs from the run beside it.
pub struct Compared {
    name: String,
    first: Difference,
    run: Run,
}

impl Compared {
    /// Creates the comparison with the recording of this name, at the recording's start. `first` is its first
    /// difference from the run.
    pub(super) fn new(name: &str, recording: Scene, first: Difference) -> Self {
        let mut start = StartSettings::of(recording);
        start.mode = Mode::opening(&start.scene);
        Self { name: name.to_owned(), first, run: Run::starting_with(start) }
    }

    /// Returns the name of the recording.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the tick of the first difference.
    pub fn tick(&self) -> u64 {
        self.first.tick
    }

    /// Describes the place and the size of the first difference, on one line each.
    pub fn lines(&self) -> [String; 2] {
        // Lane 0 of a trace is the exact solution.
        let place = self.first.place(|lane| match lane {
            "0" => "exact solution".into(),
            lane => format!("lane {lane}"),
        });
        [format!("first difference: {place}"), self.first.size()]
    }

    /// Returns the recording's body with this index, at the tick of the run. The lane is the one with the method of
    /// `lane`, or else the first. Returns `None` if the body has halted, or if its kind differs from that in `scene`.
    pub fn body(&self, scene: &Scene, lane: &LaneSpec, index: usize) -> Option<&LaneBody> {
        let own = self.run.session().scene().bodies.get(index)?;
        let lanes = self.run.race().entrants();
        let alike = lanes.iter().find(|other| other.spec.method == lane.method);
        let body = alike.unwrap_or(&lanes[0]).lane.bodies().get(index)?;
        (own.kind.id == scene.bodies[index].kind.id && body.halted().is_none()).then_some(body)
    }

    /// Moves the recording to a tick of the run, forward by at most an hour of ticks.
    pub(super) fn go_to(&mut self, tick: u64) {
        self.run.seek(tick);
        let ahead = tick.saturating_sub(self.run.race().tick()).min(MAX_TICKS);
        (0..ahead).for_each(|_| self.run.tick(&mut ()));
    }
}
