//! Actions on a race, from the race's journal and by hand.
//!
//! An action by hand is performed at once, before the next tick, and the journal has it at this tick for every
//! repetition. An action without any effect leaves no row, or undo would have a step that does nothing.

use super::journal::{Author, Journal};
use super::lane::LaneBody;
use super::observer::{Observer, PerformedAction, Switch};
use super::{Mode, Race};
use crate::scene::{Action, LaneId, LaneSpec, edited_values};
use crate::sim::bodies::{TakesEffect, incompatibility};

impl Race {
    /// Performs the journal's pending actions at the present tick.
    pub fn catch_up(&mut self, observer: &mut dyn Observer) {
        if self.journal.rows().get(self.done).is_none_or(|row| row.tick > self.tick) {
            return;
        }
        let journal = self.journal.clone();
        while let Some(row) = journal.rows().get(self.done).filter(|row| row.tick <= self.tick) {
            self.done += 1;
            self.perform_by(&row.action, row.author, observer);
        }
    }

    /// Returns this race at its start, after the actions of `journal` up to tick `end`, without any ticks in between.
    /// Lanes, rate and parameters are those of that tick, but the bodies are not, so placements only notify the
    /// observer.
    pub(crate) fn after_actions(
        mut self,
        journal: &Journal,
        end: u64,
        observer: &mut dyn Observer,
    ) -> Self {
        for row in journal.rows().iter().take_while(|row| row.tick <= end) {
            self.tick = row.tick;
            if let Action::Place { .. } = row.action {
                observer.before(&self, &PerformedAction::new(row.action.clone(), row.author, None));
            } else {
                self.perform_by(&row.action, row.author, observer);
            }
        }
        self.tick = end;
        self
    }

    /// Performs a person's action at the present tick, after the journal's actions there. Adds it to the journal, and
    /// removes the person's later actions. Returns `None`, and leaves the journal alone, if the run cannot take the
    /// action (see [`Action::clamped_in_range`]). The same holds if the action changes neither the present nor the
    /// script's pending actions.
    pub fn act(&mut self, action: Action, observer: &mut dyn Observer) -> Option<PerformedAction> {
        self.catch_up(observer);
        let action = action.clamped_in_range()?;
        let planned = self.action_to_perform(&action, Author::Person);
        let control = action.control();
        let takes_over = self.can_take(&action) && self.journal.script_acts_on(control, self.done);
        if planned.is_none() && !takes_over {
            return None;
        }
        let (done, released) =
            self.journal.insert(self.done, (self.tick, self.t()), action.clone());
        self.done = done;
        let done = match planned {
            Some(planned) => self.carry_out(planned, observer),
            None => {
                let switch = self.switch(&action);
                PerformedAction::new(action, Author::Person, switch)
            }
        };
        // The action may have changed the rate, or cancelled a pending change of the rate.
        self.journal.put_on_ticks(self.done, self.piece);
        Some(PerformedAction { released, ..done })
    }

    /// Whether the race has the target of an action, and accepts the action's values. A hand may still hold a body of
    /// the scene before this one.
    fn can_take(&self, action: &Action) -> bool {
        match action {
            Action::Set { body, parameter, value } => {
                let Some(LaneBody { kind, .. }) = self.truth.bodies().get(*body) else {
                    return false;
                };
                let acts = kind.parameters.get(*parameter).map(|parameter| parameter.acts);
                acts == Some(TakesEffect::AtOnce)
                    && edited_values(kind, &self.values[*body], *parameter, *value).is_ok()
            }
            Action::Place { body, q, v } => self.truth.bodies().get(*body).is_some_and(|body| {
                let coordinates = body.coordinates().len();
                [q, v].iter().all(|values| {
                    values.len() == coordinates && values.iter().all(|value| value.is_finite())
                })
            }),
            Action::Lane { spec: LaneSpec { method, .. }, .. } => {
                let mut bodies = self.truth.bodies().iter().zip(&self.values);
                bodies.all(|(body, values)| incompatibility(method, &body.kind, values).is_none())
            }
            _ => true,
        }
    }

    /// Whether an action would change anything.
    pub fn changes(&self, action: &Action) -> bool {
        self.action_to_perform(action, Author::Person).is_some()
    }

    /// Returns the action to perform; `None` if the action would change nothing.
    fn action_to_perform(&self, action: &Action, author: Author) -> Option<PerformedAction> {
        if !self.can_take(action) {
            return None;
        }
        let switch = self.switch(action);
        let changes = match action {
            Action::Throttle(part) => {
                self.takes_input("throttle") && self.throttle != part.clamp(-1.0, 1.0)
            }
            Action::Rudder(part) => {
                self.takes_input("rudder") && self.rudder != part.clamp(-1.0, 1.0)
            }
            Action::Kick(times) => self.takes_input("kick") && *times != 0.0,
            Action::TickHz(tick_hz) => self.tick_hz() != *tick_hz,
            Action::Set { body, parameter, value } => self.values[*body][*parameter] != *value,
            Action::Place { body, q, v } => {
                let bodies = self.entrants.iter().map(|e| &e.lane).chain([&self.truth]);
                let mut bodies = bodies.map(|lane| &lane.bodies()[*body]);
                bodies.any(|at| {
                    let is_there = at.stepper.q() == &q[..] && at.stepper.v() == &v[..];
                    !is_there || at.halted().is_some()
                })
            }
            Action::Push { body, by } => {
                let bodies = self.entrants.iter().map(|e| &e.lane).chain([&self.truth]);
                let mut bodies = bodies.map(|lane| &lane.bodies()[*body]);
                bodies.any(|at| at.halted().is_none()) && by.iter().any(|by| *by != 0.0)
            }
            Action::Solo { lane } => {
                self.entrant(*lane).is_some()
                    && (self.mode == Mode::Race || self.entrants.len() > 1)
            }
            Action::Method(_)
            | Action::Lane { .. }
            | Action::Substeps { .. }
            | Action::Tolerance { .. } => {
                switch.is_some_and(|Switch { index, spec, .. }| self.entrants[index].spec != spec)
            }
        };
        changes.then(|| PerformedAction::new(action.clone(), author, switch))
    }

    /// Whether any body takes an input, given by its name on the body's [card](crate::sim::bodies::Kind).
    pub fn takes_input(&self, input: &str) -> bool {
        self.truth.bodies().iter().any(|body| body.kind.inputs.contains(&input))
    }

    /// Returns the switch that an action asks for, even if the lane has the same settings already.
    fn switch(&self, action: &Action) -> Option<Switch> {
        let of_id = |lane: LaneId| self.entrants.iter().position(|e| e.id == lane);
        let present = |index: usize| self.entrants[index].spec;
        let (index, spec) = match *action {
            Action::Method(method) => {
                let spec = self.methods.iter().find(|spec| spec.method == method)?;
                (self.mode == Mode::Solo).then_some((0, *spec))?
            }
            Action::Lane { lane, spec } => (of_id(lane)?, spec),
            Action::Substeps { lane, substeps } => {
                let index = of_id(lane)?;
                (index, LaneSpec { substeps, ..present(index) })
            }
            Action::Tolerance { lane, tolerance } => {
                let index = of_id(lane)?;
                present(index).method.tolerance?;
                (index, LaneSpec { tolerance: Some(tolerance), ..present(index) })
            }
            _ => return None,
        };
        Some(Switch { index, lane: self.entrants[index].id, spec })
    }

    /// Performs a person's action at the present tick, without adding the action to the journal. Throttle and rudder
    /// are clamped to -1 to 1. Returns `None` if the action [changes](Self::changes) nothing.
    pub fn perform(
        &mut self,
        action: &Action,
        observer: &mut dyn Observer,
    ) -> Option<PerformedAction> {
        self.perform_by(action, Author::Person, observer)
    }

    fn perform_by(
        &mut self,
        action: &Action,
        author: Author,
        observer: &mut dyn Observer,
    ) -> Option<PerformedAction> {
        let planned = self.action_to_perform(action, author)?;
        Some(self.carry_out(planned, observer))
    }

    fn carry_out(
        &mut self,
        mut done: PerformedAction,
        observer: &mut dyn Observer,
    ) -> PerformedAction {
        observer.before(self, &done);
        let (tick, t, action) = (self.tick, self.t(), &done.action);
        match action {
            Action::Throttle(part) => self.throttle = part.clamp(-1.0, 1.0),
            Action::Rudder(part) => self.rudder = part.clamp(-1.0, 1.0),
            &Action::TickHz(tick_hz) => {
                self.piece = self.piece.then(self.tick, tick_hz);
            }
            Action::Set { body, parameter, value } => {
                self.values[*body][*parameter] = *value;
            }
            Action::Solo { lane } => {
                self.entrants.retain(|entrant| entrant.id == *lane);
                self.mode = Mode::Solo;
            }
            _ => {}
        }
        if let Some(Switch { index, spec, .. }) = done.switch {
            let entrant = &mut self.entrants[index];
            entrant.spec = spec;
            done.resumed = entrant.lane.switch(spec.solver(), spec.substeps, t, &self.truth);
        }
        self.truth.act(tick, t, action);
        self.entrants.iter_mut().for_each(|entrant| entrant.lane.act(tick, t, action));
        observer.after(self, &done);
        done
    }
}
