//! A method made of a person's own lines, which are read at run time.

use std::sync::Arc;

use super::failure::StepFailure;
use super::integrator::Override;
use super::prelude::*;
use super::shared::newton::Newton;
use super::shared::slopes::Slopes;
use super::shared::stages::Stages;
use super::step_rule::room;
use crate::law::{General, Input, Request, StepRegisters, StepText};
use crate::system::{Coupling, EngineSettings, Pursuit, Query};

/// A method made of lines that call the acceleration, or take the target or the settings of their body.
#[derive(Clone)]
pub(crate) struct StepMethod {
    /// The lines, and the numbers that they carry. If `None`, the method refuses every step.
    lines: Option<(Arc<StepText>, StepRegisters)>,
    /// K and c of a joint, if they override the body's.
    joint: Option<[f64; 2]>,
    pursuit: Option<Pursuit<Vec<f64>>>,
    at: State<Vec<f64>>,
    along: State<Vec<f64>>,
    a: Vec<f64>,
    newton: Option<Box<Newton<Vec<f64>, 1>>>,
    slopes: Slopes<Vec<f64>>,
}

impl StepMethod {
    /// Returns the method of these lines for this number of coordinates, with this coupling.
    pub(crate) fn of(lines: Arc<StepText>, coordinates: usize, coupling: Coupling) -> Self {
        let registers = lines.method_registers(coordinates);
        let like = vec![0.0; coordinates];
        let (pursuit, solves) = (room(coordinates), lines.uses(General::Solve));
        let newton = solves.then(|| Box::new(Newton::new(&like, coupling)));
        Self { lines: Some((lines, registers)), newton, pursuit, ..Self::without_lines(&like) }
    }

    fn without_lines(like: &Vec<f64>) -> Self {
        let at = State { q: like.clone(), v: like.clone() };
        Self {
            lines: None,
            joint: None,
            pursuit: None,
            along: at.clone(),
            at,
            a: like.clone(),
            newton: None,
            slopes: Slopes::new(like),
        }
    }

    fn advance<S: System<Vector = Vec<f64>>>(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        substeps: u32,
        state: &mut StateOf<S>,
    ) -> Stepped {
        let refused = |reason| Err(StepFailure::Refused { reason });
        let Self { lines, joint, pursuit, at, along, a, newton, slopes } = self;
        let Some((lines, registers)) = lines else {
            return refused("it was built without its card");
        };
        let size = state.q.components().len();
        if size > 1 && lines.is_for_one_coordinate() {
            return refused(
                "its lines solve or divide the step of one coordinate, and the body has several",
            );
        }
        if let Some(order) = lines.law_order() {
            let is_found = system.query(t + h, Query::Target(pursuit));
            let found = pursuit.as_ref().filter(|found| is_found && found.order == order);
            let Some(Pursuit { target, rate, .. }) = found else {
                return refused(
                    "its lines take the target and the rate of a body that follows one",
                );
            };
            for (i, target) in target.iter().enumerate() {
                lines.set_target(registers, i, *target);
                lines.set_input(registers, Input::Rate, i, *rate);
            }
        }
        if lines.takes(Input::Force) {
            let mut settings = EngineSettings::of(system, t, state, a);
            if !lines.takes(Input::Stiffness) && settings.has_spring() {
                return refused("its lines take no stiffness, and the body has a spring");
            }
            if let (Some([stiffness, damping]), true) = (*joint, settings.has_spring()) {
                settings = EngineSettings { stiffness, damping, ..settings };
            }
            for (i, force) in a.components().iter().enumerate() {
                for (input, value) in [
                    (Input::Stiffness, settings.stiffness),
                    (Input::Damping, settings.damping),
                    (Input::Drag, settings.drag),
                    (Input::Force, *force),
                ] {
                    lines.set_input(registers, input, i, value);
                }
            }
        }
        (0..size).for_each(|i| {
            lines.set_input(registers, Input::Substeps, i, f64::from(substeps));
        });
        let moved = [state.q.components_mut(), state.v.components_mut()];
        let mut solved = Ok(());
        let has_ended = lines.step_method(registers, h, moved, |since, request, [q, v], found| {
            let t = t + since;
            at.q.components_mut().copy_from_slice(q);
            at.v.components_mut().copy_from_slice(v);
            match (request, &mut *newton) {
                (Request::Solution { alpha, beta }, Some(newton)) if beta != 0.0 => {
                    newton.base[0].assign(at);
                    let stages = Stages { t: [t], alpha: [[alpha]], beta: [[beta]] };
                    let done = newton.solve(system, &stages);
                    if done.is_err() {
                        solved = done;
                    }
                    found.copy_from_slice(newton.a[0].components());
                }
                (Request::Slope { along: [q, v], h, found: known }, _) => {
                    along.q.components_mut().copy_from_slice(q);
                    along.v.components_mut().copy_from_slice(v);
                    a.components_mut().copy_from_slice(known);
                    slopes.reach_for(h, at, a);
                    slopes.differentiate(system, t, at, along, None, a);
                    found.copy_from_slice(a.components());
                }
                _ => {
                    system.acceleration(t, &at.q, &at.v, a);
                    found.copy_from_slice(a.components());
                }
            }
        });
        solved?;
        if has_ended { Ok(()) } else { refused("a loop of its lines has 65 536 turns in a step") }
    }
}

impl<S: System<Vector = Vec<f64>>> Integrator<S> for StepMethod {
    /// Refuses every step, because only the card knows the lines.
    fn new(like: &S::Vector) -> Self {
        Self::without_lines(like)
    }

    fn step(&mut self, system: &S, t: f64, h: f64, state: &mut StateOf<S>) -> Stepped {
        self.advance(system, t, h, 1, state)
    }

    fn steps(&mut self, system: &S, t: f64, h: f64, n: u32, state: &mut StateOf<S>) -> Stepped {
        if self.lines.as_ref().is_some_and(|(lines, _)| lines.takes(Input::Substeps)) {
            return self.advance(system, t, h, n, state);
        }
        let part = h / f64::from(n);
        (0..n).try_for_each(|i| self.advance(system, t + part * f64::from(i), part, 1, state))
    }

    fn set(&mut self, with: Override) {
        if let Override::Joint(joint) = with {
            self.joint = Some(joint);
        }
    }

    fn reset(&mut self) {
        if let Some((lines, registers)) = &mut self.lines {
            lines.forget(registers);
        }
    }
}
