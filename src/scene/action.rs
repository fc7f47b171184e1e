//! The actions on a run, shared by people, scripts, recordings and tests.

use super::Scene;
use super::lane_spec::{LaneId, LaneSpec};
use crate::sim::bodies::Input;
use crate::sim::integrators::Method;
use crate::sim::number::round;
use crate::sim::{Stepper, TickRate};

/// An action on a run at a tick. It states the new value rather than a change, so that performing it twice has the same
/// effect as once; only a kick adds up.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// In solo, puts the bodies under this method, with the substeps and the tolerance that the method has at the
    /// start. In a race it does nothing, because each lane keeps its method.
    Method(&'static Method),
    /// Puts a lane under this method, with these substeps and this tolerance.
    Lane {
        /// Number of the lane.
        lane: LaneId,
        /// The new method, substeps and tolerance.
        spec: LaneSpec,
    },
    /// Sets the substeps of a lane.
    Substeps {
        /// Number of the lane.
        lane: LaneId,
        /// Number of steps per tick, 1 to [`MAX_SUBSTEPS`](super::MAX_SUBSTEPS).
        substeps: u32,
    },
    /// Sets the tolerance of a lane under an adaptive method.
    Tolerance {
        /// Number of the lane.
        lane: LaneId,
        /// The tolerance, within [`TOLERANCES`](super::TOLERANCES).
        tolerance: f64,
    },
    /// Sets the tick rate.
    TickHz(TickRate),
    /// Sets the throttle of every body that has one, -1 to 1.
    Throttle(f64),
    /// Sets the rudder of every body that has one, from -1 (hard right) to 1 (hard left).
    Rudder(f64),
    /// Gives every body an impulse, as a multiple of the body's own kick.
    Kick(f64),
    /// Sets a parameter of a body.
    Set {
        /// The body's index in the scene.
        body: usize,
        /// The parameter's index among those of the body's kind.
        parameter: usize,
        /// The new value.
        value: f64,
    },
    /// Puts a body into a state, in every lane and in truth.
    Place {
        /// The body's index in the scene.
        body: usize,
        /// The body's coordinates.
        q: Box<[f64]>,
        /// The body's velocities.
        v: Box<[f64]>,
    },
    /// Changes the velocities of a body by an impulse, in every lane and in truth.
    Push {
        /// The body's index in the scene.
        body: usize,
        /// The change of each velocity, in the coordinate's unit per second.
        by: Box<[f64]>,
    },
    /// Removes all lanes but this one from the race.
    Solo {
        /// Number of the lane.
        lane: LaneId,
    },
}

impl Action {
    /// Returns the tick rate that the action sets, if it sets one.
    pub fn tick_hz(&self) -> Option<TickRate> {
        match *self {
            Action::TickHz(tick_hz) => Some(tick_hz),
            _ => None,
        }
    }

    /// Whether the action changes the body at this index of the scene, provided that the body accepts the action.
    pub fn acts_on(&self, body: usize) -> bool {
        match self {
            Action::Set { body: changed, .. }
            | Action::Place { body: changed, .. }
            | Action::Push { body: changed, .. } => *changed == body,
            other => other.input().is_some(),
        }
    }

    /// Applies the action to the `stepper` of a body that it [acts on](Self::acts_on), at time `t` (s).
    pub fn apply_to(&self, stepper: &mut dyn Stepper, t: f64) {
        match self {
            Action::Set { parameter, value, .. } => {
                stepper.set_parameter(t, *parameter, *value);
            }
            Action::Place { q, v, .. } => stepper.set(t, q, v),
            Action::Push { by, .. } => {
                let q: Vec<f64> = stepper.q().into();
                let v: Vec<f64> = stepper.v().iter().zip(by).map(|(v, by)| v + by).collect();
                stepper.set(t, &q, &v);
            }
            other => {
                if let Some(input) = other.input() {
                    stepper.input(t, input);
                }
            }
        }
    }

    /// Returns the input that the action gives to the bodies, if it gives one.
    pub fn input(&self) -> Option<Input> {
        match *self {
            Action::Throttle(part) => Some(Input::Throttle(part.clamp(-1.0, 1.0))),
            Action::Rudder(part) => Some(Input::Rudder(part.clamp(-1.0, 1.0))),
            Action::Kick(times) => Some(Input::Kick(times)),
            _ => None,
        }
    }

    /// Names the quantity of `scene` that the action changes, for people. For a parameter, the text includes the new
    /// value.
    pub fn in_words(&self, scene: &Scene) -> String {
        let &Action::Set { body, parameter, value } = self else { return self.noun().into() };
        let parameter = &scene.bodies[body].kind.parameters[parameter];
        let words = format!("{} {} {}", parameter.quantity(), round(value, 6), parameter.unit);
        words.trim_end().to_owned()
    }

    /// Returns a noun for the action, for people.
    pub fn noun(&self) -> &'static str {
        match self {
            Action::Method(_) | Action::Lane { .. } => "the switch",
            Action::Substeps { .. } => "the substeps",
            Action::Tolerance { .. } => "the tolerance",
            Action::TickHz(_) => "the tick rate",
            Action::Throttle(_) => "the throttle",
            Action::Rudder(_) => "the rudder",
            Action::Kick(_) => "the kick",
            Action::Set { .. } => "the parameter",
            Action::Place { .. } => "the placement",
            Action::Push { .. } => "the pull",
            Action::Solo { .. } => "the end of the race",
        }
    }

    /// Returns the control that the action sets, if it sets one.
    pub fn control(&self) -> Option<Control> {
        match *self {
            Action::Method(_)
            | Action::Lane { .. }
            | Action::Substeps { .. }
            | Action::Tolerance { .. } => Some(Control::Method),
            Action::TickHz(_) => Some(Control::TickRate),
            Action::Throttle(_) => Some(Control::Throttle),
            Action::Rudder(_) => Some(Control::Rudder),
            Action::Set { body, parameter, .. } => Some(Control::Parameter { body, parameter }),
            Action::Kick(_) | Action::Place { .. } | Action::Push { .. } | Action::Solo { .. } => {
                None
            }
        }
    }

    /// Whether both actions set the same quantity. In one drag, the later of them then replaces the earlier one.
    pub fn sets_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Action::Place { body, .. }, Action::Place { body: other, .. }) => body == other,
            (Action::Lane { lane, .. }, Action::Lane { lane: other, .. })
            | (Action::Substeps { lane, .. }, Action::Substeps { lane: other, .. })
            | (Action::Tolerance { lane, .. }, Action::Tolerance { lane: other, .. }) => {
                lane == other
            }
            _ => {
                let control = self.control().filter(|control| *control != Control::Method);
                control.is_some() && control == other.control()
            }
        }
    }
}

/// A value that scripts and people can set. Once a person has set it, the script leaves it alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// The method in solo.
    Method,
    /// The tick rate.
    TickRate,
    /// The throttle of the steered bodies.
    Throttle,
    /// The rudder of the steered bodies.
    Rudder,
    /// A parameter of a body.
    Parameter {
        /// Index of the body.
        body: usize,
        /// Index of the parameter.
        parameter: usize,
    },
}

impl Control {
    /// Returns the control's name for people.
    pub fn name(self) -> &'static str {
        match self {
            Control::Method => "method",
            Control::TickRate => "tick rate",
            Control::Throttle => "throttle",
            Control::Rudder => "rudder",
            Control::Parameter { .. } => "parameter",
        }
    }
}
