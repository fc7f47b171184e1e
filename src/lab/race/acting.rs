//! What is done to a race: by its journal, and by hand.

use super::observer::Observer;
use super::{Mode, Race};
use crate::lab::action::{Action, Control};
use crate::lab::lane::{Lane, TakenUp};
use crate::lab::lane_spec::LaneSpec;
use crate::lab::scene::edited_values;
use crate::sim::bodies::Input;

/// What became of an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::lab) enum Acted {
    /// It would have changed nothing: it is not in the journal.
    Nothing,
    /// It was done. A control that it takes from the script is `released`.
    Done { released: Option<Control> },
}

impl Race {
    /// Plays what the journal has for the present tick and was not played yet.
    pub(in crate::lab) fn catch_up(&mut self, observer: &mut impl Observer) {
        if self.journal.rows().get(self.done).is_none_or(|row| row.tick > self.tick) {
            return;
        }
        let journal = self.journal.clone();
        while let Some(row) = journal.rows().get(self.done).filter(|row| row.tick <= self.tick) {
            self.done += 1;
            self.perform(&row.action, observer);
        }
    }

    /// Does what a person asks for at the present tick, after what the journal has for it, and notes it in the
    /// journal, where what the person did later is taken back. What would change nothing, neither now nor what the
    /// script has to come, is neither done nor noted.
    pub(in crate::lab) fn act(&mut self, action: Action, observer: &mut impl Observer) -> Acted {
        self.catch_up(observer);
        let control = action.control();
        if !self.changes(&action) && !self.journal.script_works(control, self.done) {
            return Acted::Nothing;
        }
        let (done, released) = self.journal.insert(self.done, self.tick, action.clone());
        self.done = done;
        self.perform(&action, observer);
        Acted::Done { released }
    }

    /// Whether an action would change anything.
    pub fn changes(&self, action: &Action) -> bool {
        match action {
            Action::Throttle(part) => {
                self.takes("throttle") && self.throttle != part.clamp(-1.0, 1.0)
            }
            Action::Rudder(part) => self.takes("rudder") && self.rudder != part.clamp(-1.0, 1.0),
            Action::Kick(times) => self.takes("kick") && *times != 0.0,
            Action::TickHz(tick_hz) => self.tick_hz != *tick_hz,
            Action::Set { body, parameter, value } => {
                let present = &self.values[*body];
                let is_new = present.get(*parameter).is_some_and(|present| present != value);
                let kind = self.truth.bodies()[*body].kind;
                is_new && edited_values(kind, present, *parameter, *value).is_ok()
            }
            Action::Place { body, q, v } => {
                let bodies = self.entrants.iter().map(|e| &e.lane).chain([&self.truth]);
                let mut bodies = bodies.map(|lane| &lane.bodies()[*body]);
                let coordinates = self.truth.bodies()[*body].coordinates.len();
                let fits = [q, v].iter().all(|values| {
                    values.len() == coordinates && values.iter().all(|value| value.is_finite())
                });
                fits && bodies.any(|at| {
                    let is_there = at.stepper.q() == &q[..] && at.stepper.v() == &v[..];
                    !is_there || at.halted().is_some()
                })
            }
            Action::Solo { lane } => {
                let stays = self.entrants.iter().any(|entrant| entrant.lane_number == *lane);
                stays && (self.mode == Mode::Race || self.entrants.len() > 1)
            }
            Action::Method(_)
            | Action::Lane { .. }
            | Action::Substeps { .. }
            | Action::Tolerance { .. } => self.switch_asked(action).is_some_and(|(place, spec)| {
                let lane = &self.entrants[place].lane;
                (lane.solver(), lane.substeps()) != (spec.solver(), spec.substeps)
            }),
        }
    }

    /// Whether any body takes an input, by its name on the body's [card](crate::sim::bodies::Kind).
    pub fn takes(&self, input: &str) -> bool {
        self.truth.bodies().iter().any(|body| body.kind.inputs.contains(&input))
    }

    /// The place of the lane that an action puts under a method, with substeps and a tolerance.
    pub(in crate::lab) fn switched_by(&self, action: &Action) -> Option<usize> {
        Some(self.switch_asked(action)?.0)
    }

    /// The lane that an action is about, by its place, and what it asks for it.
    pub(in crate::lab) fn switch_asked(&self, action: &Action) -> Option<(usize, LaneSpec)> {
        let numbered = |lane: usize| self.entrants.iter().position(|e| e.lane_number == lane);
        let present = |place: usize| self.list[self.entrants[place].entry];
        match *action {
            Action::Method(method) => {
                let listed = self.list.iter().find(|spec| spec.method == method)?;
                (self.mode == Mode::Solo).then_some((0, *listed))
            }
            Action::Lane { lane, spec } => Some((numbered(lane)?, spec)),
            Action::Substeps { lane, substeps } => {
                let place = numbered(lane)?;
                Some((place, LaneSpec { substeps, ..present(place) }))
            }
            Action::Tolerance { lane, tolerance } => {
                let place = numbered(lane)?;
                let takes_one = present(place).method.tolerance.is_some();
                let spec = LaneSpec { tolerance: Some(tolerance), ..present(place) };
                takes_one.then_some((place, spec))
            }
            _ => None,
        }
    }

    /// Does something at the present tick, before the eyes of an observer, and leaves it out of the journal. Bodies that
    /// had halted and go on for it are returned.
    pub fn perform(&mut self, action: &Action, observer: &mut impl Observer) -> Vec<TakenUp> {
        if !self.changes(action) {
            return Vec::new();
        }
        observer.before(self, action);
        let t = self.t();
        let mut taken_up = Vec::new();
        match action {
            Action::Throttle(part) => self.throttle = part.clamp(-1.0, 1.0),
            Action::Rudder(part) => self.rudder = part.clamp(-1.0, 1.0),
            Action::TickHz(tick_hz) => self.set_rate(*tick_hz),
            Action::Set { body, parameter, value } => {
                self.values[*body][*parameter] = *value;
                self.each_lane(|lane| lane.set_parameter(*body, t, *parameter, *value));
            }
            Action::Place { body, q, v } => {
                let tick = self.tick;
                self.each_lane(|lane| lane.place(*body, tick, t, [q, v]));
            }
            Action::Solo { lane } => {
                self.entrants.retain(|entrant| entrant.lane_number == *lane);
                self.mode = Mode::Solo;
            }
            Action::Method(_)
            | Action::Lane { .. }
            | Action::Substeps { .. }
            | Action::Tolerance { .. } => {
                let (place, spec) = self.switch_asked(action).expect("it changes something");
                taken_up = self.switch(place, spec);
            }
            Action::Kick(_) => {}
        }
        if let Some(input) = action.input() {
            let tick = self.tick;
            self.each_lane(|lane| lane.input(tick, t, input));
        }
        observer.after(self, action, &taken_up);
        taken_up
    }

    /// The truth is the first.
    fn each_lane(&mut self, mut change: impl FnMut(&mut Lane)) {
        change(&mut self.truth);
        self.entrants.iter_mut().for_each(|entrant| change(&mut entrant.lane));
    }

    fn set_rate(&mut self, tick_hz: u32) {
        self.origin = (self.tick, self.t());
        self.tick_hz = tick_hz;
    }

    /// Puts the lane at this place under another method, its state carried exactly, but of a body that had halted:
    /// that is taken up again from the truth, and returned. To switch a lane to what it is under changes nothing.
    pub fn switch(&mut self, place: usize, spec: LaneSpec) -> Vec<TakenUp> {
        let entry = self.entry_for(self.entrants[place].entry, spec);
        self.list[entry] = spec;
        let (t, truth) = (self.t(), &self.truth);
        let entrant = &mut self.entrants[place];
        entrant.entry = entry;
        entrant.lane.switch(spec.solver(), spec.substeps, t, truth)
    }

    /// The place on the list for a lane that has the one at `present` and goes on under `spec`.
    fn entry_for(&self, present: usize, spec: LaneSpec) -> usize {
        let listed = self.list.iter().position(|known| *known == spec);
        let own = (self.list[present].method == spec.method).then_some(present);
        let of_method = || self.list.iter().position(|known| known.method == spec.method);
        listed.or(own).or_else(of_method).expect("every method is on the list")
    }

    /// Changes the tick rate from here on. Methods begin anew, from the states as they are; to set the rate
    /// that is set already changes nothing.
    pub fn set_tick_hz(&mut self, tick_hz: u32) {
        self.perform(&Action::TickHz(tick_hz), &mut ());
    }

    /// Gives an input to every lane and the truth, at the present tick; throttle and rudder are brought into -1
    /// to 1. What is set to what it is, and a kick of nothing, changes nothing.
    pub fn input(&mut self, input: Input) {
        let action = match input {
            Input::Throttle(part) => Action::Throttle(part),
            Input::Rudder(part) => Action::Rudder(part),
            Input::Kick(times) => Action::Kick(times),
        };
        self.perform(&action, &mut ());
    }
}
