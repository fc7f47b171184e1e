//! A recording that the run is compared with: its own run, which goes to each tick with the run, as a ghost on the stage.

use crate::run::diff::Difference;
use crate::run::race::{LaneBody, Mode};
use crate::run::{Run, StartSettings};
use crate::scene::{LaneSpec, Scene};

/// The most ticks in one go of the recording's run: an hour at 60 Hz, which takes about a second.
const MAX_TICKS: u64 = 60 * 3600;

/// A recording beside the run that it differs from.
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

    /// The recording's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The tick of the first difference.
    pub fn tick(&self) -> u64 {
        self.first.tick
    }

    /// The answer in two lines: where the first difference is, and how large.
    pub fn lines(&self) -> [String; 2] {
        // Lane 0 of a trace is the truth.
        let place = self.first.place(|lane| match lane {
            "0" => "exact solution".into(),
            lane => format!("lane {lane}"),
        });
        [format!("first difference: {place}"), self.first.size()]
    }

    /// The recording's body at this index, at the tick of the run: in the lane of the same method as `lane`, or else in the
    /// first. `None` if it is of another kind than in the scene of the run.
    pub fn body(&self, scene: &Scene, lane: &LaneSpec, index: usize) -> Option<&LaneBody> {
        let own = self.run.session().scene().bodies.get(index)?;
        let lanes = self.run.race().entrants();
        let alike = lanes.iter().find(|other| other.spec.method == lane.method);
        let body = alike.unwrap_or(&lanes[0]).lane.bodies().get(index)?;
        (own.kind.id == scene.bodies[index].kind.id && body.halted().is_none()).then_some(body)
    }

    /// Goes to a tick of the run, forward for at most an hour of ticks.
    pub(super) fn go_to(&mut self, tick: u64) {
        self.run.seek(tick);
        let ahead = tick.saturating_sub(self.run.race().tick()).min(MAX_TICKS);
        (0..ahead).for_each(|_| self.run.tick(&mut ()));
    }
}
