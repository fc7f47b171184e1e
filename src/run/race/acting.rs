//! The actions on a race, from its journal and by hand.

use super::journal::{Author, Journal};
use super::lane::{LaneBody, Resumed};
use super::observer::Observer;
use super::{Mode, Race};
use crate::scene::{Action, Control, LaneId, LaneSpec, edited_values};
use crate::sim::bodies::{Acts, incompatibility};

/// The effect of an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ActionResult {
    /// None: the action is not in the journal.
    Nothing,
    /// It was performed. `released` is the control that it took from the script, if it took one.
    Done { released: Option<Control> },
}

impl Race {
    /// Performs the journal's pending actions at the present tick.
    pub(crate) fn catch_up(&mut self, observer: &mut impl Observer) {
        if self.journal.rows().get(self.done).is_none_or(|row| row.tick > self.tick) {
            return;
        }
        let journal = self.journal.clone();
        while let Some(row) = journal.rows().get(self.done).filter(|row| row.tick <= self.tick) {
            self.done += 1;
            self.perform(&row.action, observer);
            observer.acted(self, &row.action, row.author);
        }
    }

    /// This race, at its start, after the actions of `journal` up to tick `end`, without a tick between them. Its lanes, rate
    /// and parameters are those of that tick; its bodies are not, so that a placing is passed to the observer and not made.
    pub(crate) fn after_actions(
        mut self,
        journal: &Journal,
        end: u64,
        observer: &mut impl Observer,
    ) -> Self {
        for row in journal.rows().iter().take_while(|row| row.tick <= end) {
            self.tick = row.tick;
            match row.action {
                Action::Place { .. } => observer.before(&self, &row.action),
                _ => drop(self.perform(&row.action, observer)),
            }
        }
        self.tick = end;
        self
    }

    /// Performs a person's action at the present tick, after the journal's actions at it, and adds it to the journal, from
    /// which the person's later actions are removed. An action that changes neither the present nor the script's pending
    /// actions is ignored, and so is one that the run cannot take: see [`Action::checked`].
    pub(crate) fn act(&mut self, action: Action, observer: &mut impl Observer) -> ActionResult {
        self.catch_up(observer);
        let Some(action) = action.checked().filter(|action| self.can_take(action)) else {
            return ActionResult::Nothing;
        };
        let control = action.control();
        if !self.changes(&action) && !self.journal.script_acts_on(control, self.done) {
            return ActionResult::Nothing;
        }
        let (done, released) =
            self.journal.insert(self.done, (self.tick, self.t()), action.clone());
        self.done = done;
        self.perform(&action, observer);
        // The rate is another now, or a change of it that was to come is none.
        self.journal.put_on_ticks(self.done, self.piece);
        observer.acted(self, &action, Author::Person);
        ActionResult::Done { released }
    }

    /// Whether the race has what an action is on, with such values: no body is there of a hand that still held it when
    /// another scene was opened.
    fn can_take(&self, action: &Action) -> bool {
        match action {
            Action::Set { body, parameter, value } => {
                let Some(LaneBody { kind, .. }) = self.truth.bodies().get(*body) else {
                    return false;
                };
                let acts = kind.parameters.get(*parameter).map(|parameter| parameter.acts);
                acts == Some(Acts::AtOnce)
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
        if !self.can_take(action) {
            return false;
        }
        match action {
            Action::Throttle(part) => {
                self.takes("throttle") && self.throttle != part.clamp(-1.0, 1.0)
            }
            Action::Rudder(part) => self.takes("rudder") && self.rudder != part.clamp(-1.0, 1.0),
            Action::Kick(times) => self.takes("kick") && *times != 0.0,
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
            Action::Solo { lane } => {
                self.entrant(*lane).is_some()
                    && (self.mode == Mode::Race || self.entrants.len() > 1)
            }
            Action::Method(_)
            | Action::Lane { .. }
            | Action::Substeps { .. }
            | Action::Tolerance { .. } => self
                .switch_asked(action)
                .is_some_and(|(index, spec)| self.entrants[index].spec != spec),
        }
    }

    /// Whether any body takes an input, by its name on the body's [card](crate::sim::bodies::Kind).
    pub fn takes(&self, input: &str) -> bool {
        self.truth.bodies().iter().any(|body| body.kind.inputs.contains(&input))
    }

    /// The index of the lane whose method, substeps or tolerance an action sets.
    pub(crate) fn switched_by(&self, action: &Action) -> Option<usize> {
        Some(self.switch_asked(action)?.0)
    }

    /// The index of the lane that an action switches, and its new method, substeps and tolerance.
    pub(crate) fn switch_asked(&self, action: &Action) -> Option<(usize, LaneSpec)> {
        let of_id = |lane: LaneId| self.entrants.iter().position(|e| e.id == lane);
        let present = |index: usize| self.entrants[index].spec;
        match *action {
            Action::Method(method) => {
                let spec = self.methods.iter().find(|spec| spec.method == method)?;
                (self.mode == Mode::Solo).then_some((0, *spec))
            }
            Action::Lane { lane, spec } => Some((of_id(lane)?, spec)),
            Action::Substeps { lane, substeps } => {
                let index = of_id(lane)?;
                Some((index, LaneSpec { substeps, ..present(index) }))
            }
            Action::Tolerance { lane, tolerance } => {
                let index = of_id(lane)?;
                let takes_one = present(index).method.tolerance.is_some();
                let spec = LaneSpec { tolerance: Some(tolerance), ..present(index) };
                takes_one.then_some((index, spec))
            }
            _ => None,
        }
    }

    /// Performs an action at the present tick, without adding it to the journal. Throttle and rudder are clamped to -1 to 1.
    /// Returns the halted bodies that resume. An action that [changes](Self::changes) nothing does nothing.
    pub fn perform(&mut self, action: &Action, observer: &mut impl Observer) -> Vec<Resumed> {
        if !self.changes(action) {
            return Vec::new();
        }
        observer.before(self, action);
        let (tick, t) = (self.tick, self.t());
        let mut resumed = Vec::new();
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
            Action::Method(_)
            | Action::Lane { .. }
            | Action::Substeps { .. }
            | Action::Tolerance { .. } => {
                let (index, spec) = self.switch_asked(action).expect("it changes something");
                let entrant = &mut self.entrants[index];
                entrant.spec = spec;
                resumed = entrant.lane.switch(spec.solver(), spec.substeps, t, &self.truth);
            }
            Action::Place { .. } | Action::Kick(_) => {}
        }
        self.truth.act(tick, t, action);
        self.entrants.iter_mut().for_each(|entrant| entrant.lane.act(tick, t, action));
        observer.after(self, action, &resumed);
        resumed
    }
}
