//! What the selected lane is about to do: the anatomy of its next tick, and a fan of futures.

use super::Studio;
use crate::measure;
use crate::measure::{Future, OneStep};
use crate::sim::stability::Tick;

impl Studio {
    /// What the selected lane is about to do with the displayed body. `None` if the body has halted.
    pub fn one_step(&self) -> Option<OneStep> {
        let (entrant, race) = (self.selected(), self.race());
        let spec = entrant.spec;
        let h = 1.0 / f64::from(race.tick_hz());
        let tick = Tick { t: race.t(), h, substeps: spec.substeps };
        measure::one_step(&entrant.lane.bodies()[self.view().body], spec, race.tick(), tick)
    }

    /// Lines through the states of the displayed body that have the energy of the state `through`, with coordinates in
    /// `range`. Empty if the body has several coordinates, or conserves no energy.
    pub fn orbit(&self, through: [f64; 2], range: [f64; 2]) -> Vec<Vec<[f64; 2]>> {
        let body = &self.selected().lane.bodies()[self.view().body];
        measure::orbit(body, self.race().t(), through, range)
    }

    /// The evaluations in the next tick of the lane with this index among the entrants.
    pub fn evaluations_of_next_tick(&self, index: usize) -> u64 {
        let (race, mut lane) = (self.race(), self.race().entrants()[index].lane.clone());
        let before = lane.evaluations();
        lane.tick(race.tick(), race.t(), 1.0 / f64::from(race.tick_hz()));
        lane.evaluations() - before
    }

    /// Whether futures are shown: while a person drags the tick rate, and if they are asked for while time stands still.
    pub fn shows_futures(&self) -> bool {
        let is_dragged = self.viewer.hz_at_press.is_some_and(|hz| hz != self.race().tick_hz());
        self.loop_lab().is_none() && (is_dragged || self.display().futures && !self.time_runs())
    }

    /// The next second of the body at this index of the scene in the selected lane, the truth last; empty if it has halted, or
    /// has too many coordinates.
    pub fn futures(&self, body: usize) -> Vec<Future> {
        let of = &self.selected().lane.bodies()[body];
        let held = self.viewer.held().filter(|held| held.body == body);
        let held = held.map(|held| (&*held.q, &*held.v));
        let plotted = self.past().coordinate(self.race(), body).1;
        let (t, tick_hz) = (self.race().t(), self.race().tick_hz());
        let offered = &self.entries()[..self.offered().min(self.entries().len())];
        measure::futures(of, t, tick_hz, held, plotted, offered)
    }
}

#[cfg(test)]
mod tests;
