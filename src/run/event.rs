//! Events of a run, as data and in words.

use super::race::Author;
use crate::scene::{Action, LaneId, Scene};
use crate::sim::number::{counted, round};

/// An event in a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Tick of the event.
    pub tick: u64,
    /// Kind of the event.
    pub kind: EventKind,
}

/// Kinds of events in a run.
#[derive(Clone, Debug, PartialEq)]
pub enum EventKind {
    /// Someone performed an action.
    Done {
        /// The action.
        action: Action,
        /// The author of the action.
        author: Author,
        /// The only lane of the run; `None` in a race.
        solo: Option<LaneId>,
    },
    /// A body halted.
    Halted {
        /// Lane of the body; `None` for the truth.
        lane: Option<LaneId>,
        /// Index of the body in the scene.
        body: usize,
        /// Whether a value left its range; if not, the solver failed.
        is_blow_up: bool,
    },
}

impl EventKind {
    /// Describes the event and its author for people: `stiffness of buoy = 90 N/m, by hand`.
    pub fn words(&self, scene: &Scene) -> String {
        match self {
            Self::Done { action, author, solo } => {
                let whose = match author {
                    Author::Script => "by the script",
                    Author::Person => "by hand",
                };
                format!("{}, {whose}", what_was_done(action, *solo, scene))
            }
            Self::Halted { lane, body, is_blow_up } => {
                let name = &scene.bodies[*body].name;
                let fate = if *is_blow_up { "blew up" } else { "halted: its solver gave up" };
                match lane {
                    None => format!("the exact solution of {name} {fate}"),
                    Some(lane) => format!("{name} in lane {lane} {fate}"),
                }
            }
        }
    }
}

fn what_was_done(action: &Action, solo: Option<LaneId>, scene: &Scene) -> String {
    let percent = |part: f64| format!("{} %", round(100.0 * part, 3));
    match *action {
        Action::Method(method) => match solo {
            Some(lane) => format!("{} in lane {lane}", method.id),
            None => format!("{} is selected", method.id),
        },
        Action::Lane { lane, spec } => {
            let mut what = spec.method.id.to_owned();
            if spec.substeps > 1 {
                what += &format!(" ×{}", spec.substeps);
            }
            if let Some(tolerance) = spec.tolerance {
                what += &format!(" within {}", round(tolerance, 3));
            }
            format!("{what} in lane {lane}")
        }
        Action::Solo { lane } => format!("lane {lane} continues alone"),
        Action::Substeps { lane, substeps } => {
            format!("{} in lane {lane}", counted(substeps, "substep"))
        }
        Action::Tolerance { lane, tolerance } => {
            format!("tolerance {} in lane {lane}", round(tolerance, 3))
        }
        Action::Set { body, parameter, value } => {
            let body = &scene.bodies[body];
            let parameter = &body.kind.parameters[parameter];
            let value = format!("{} {}", round(value, 5), parameter.unit);
            format!("{} of {} = {}", parameter.quantity(), body.name, value.trim_end())
        }
        Action::TickHz(tick_hz) => format!("{tick_hz:.3} Hz"),
        Action::Throttle(part) => format!("throttle {}", percent(part)),
        Action::Rudder(part) => format!("rudder {}", percent(part)),
        Action::Kick(1.0) => "kick".into(),
        Action::Kick(times) => format!("kick ×{}", round(times, 3)),
        Action::Place { body, .. } => format!("{} is moved by hand", scene.bodies[body].name),
        Action::Push { body, .. } => format!("{} is pulled by hand", scene.bodies[body].name),
    }
}
