//! A body of one type with its state and its propagator.

use std::any::Any;
use std::rc::Rc;

use glam::DVec2;

use super::body::Body;
use super::bouncer::Bouncer;
use super::exact_flow::ExactFlow;
use super::impact::Bounces;
use super::integrators::{
    Construct, Integrator, Method, MethodOf, Problem, StepFailure, Stepped, any_integrator,
    construct, problem,
};
use super::propagator::{AnyMethod, MethodPropagator, Propagator};
use super::reference::{Reference, is_beyond_reference};
use super::state::{State, Vector, bytes_with_vectors};
use super::stepper::{Change, PlacedBody, RecordedTick, Solver, Stepper};
use super::system::{
    BodyClass, Counted, Coupling, EngineSettings, Logged, Pursuit, StateOf, System,
};

/// Returns a stepper of `body` under `solver`, at the start of the body and at time 0.
pub fn stepper<B: Body>(body: B, solver: Solver) -> Box<dyn Stepper> {
    let state = body.start();
    let (body, bounces) = (Counted::new(body), Bounces::default());
    BodyAtState { body, state, solver, lost_before: 0.0, lost_time: 0.0, bounces }.begin(0.0)
}

impl<B: Body> BodyAtState<B> {
    /// Builds the stepper, which starts under the solver at time `t` (s).
    fn begin(mut self, t: f64) -> Box<dyn Stepper> {
        if const { B::HAS_WALLS } {
            self.body.system.soften(self.solver.impact().is_soft());
        }
        if let Some(method) = self.solver.method() {
            let coupling = self.body.coupling();
            if const { <B::Vector as Vector>::IS_SMALL } {
                return construct(method, coupling, self);
            }
            let mut integrator = any_integrator(method, B::CLASS, coupling, &self.state.q);
            if let Some(other) = self.solver.setting() {
                integrator.set(other);
            }
            let method = AnyMethod(integrator);
            if self.has_walls() {
                let propagator = Bouncer::new(method, self.solver, self.bounces, &self.state);
                return Box::new(BodyStepper { placed: self, propagator });
            }
            Box::new(BodyStepper { placed: self, propagator: method })
        } else if self.body.system.has_exact() {
            let propagator = ExactFlow::new(&self.state, t);
            Box::new(BodyStepper { placed: self, propagator })
        } else {
            let propagator = Reference::new(&self.body.system, &self.state, t);
            Box::new(BodyStepper { placed: self, propagator })
        }
    }

    fn has_walls(&self) -> bool {
        B::HAS_WALLS && self.body.system.wall(0, 0.0).is_some()
    }

    /// Returns the recorded tick of `step`, made on a copy of the body; `None` if the solver is no method.
    fn recorded(&self, step: &TryStep<'_, B::Vector>) -> Option<RecordedTick> {
        let log = Rc::default();
        let system = problem(Logged { system: self.body.system.clone(), log: Rc::clone(&log) });
        let mut state = self.state.clone();
        let stepped = step(&system, &mut state)?;
        let State { q, v } = state;
        let landing = stepped.map(|()| [q, v].map(|vector| vector.components().to_vec()));
        Some(RecordedTick { evaluations: log.take(), landing })
    }
}

/// A function that steps a problem from a state; it returns `None` if the solver is the truth.
type TryStep<'a, V> = dyn Fn(&Problem<V>, &mut State<V>) -> Option<Stepped> + 'a;

impl<B: Body> Construct<Counted<B>> for BodyAtState<B> {
    type Output = Box<dyn Stepper>;

    const CLASS: Option<BodyClass> = Some(B::CLASS);

    #[inline(always)]
    fn of<I: MethodOf<Counted<B>>>(self, new: impl FnOnce(&B::Vector) -> I) -> Self::Output {
        let mut integrator = new(&self.state.q);
        if let Some(other) = self.solver.setting() {
            Integrator::<Counted<B>>::set(&mut integrator, other);
        }
        let method = MethodPropagator(integrator);
        if const { B::HAS_WALLS } {
            let propagator = Bouncer::new(method, self.solver, self.bounces, &self.state);
            return Box::new(BodyStepper { placed: self, propagator });
        }
        Box::new(BodyStepper { placed: self, propagator: method })
    }
}

/// The stepper of a body. It is monomorphic, so that force law and method compile into one loop.
#[derive(Clone)]
struct BodyStepper<B: Body, D> {
    placed: BodyAtState<B>,
    propagator: D,
}

impl<B: Body, D: Propagator<B> + Clone> Stepper for BodyStepper<B, D> {
    fn advance(&mut self, t: f64, h: f64, substeps: u32) -> Stepped {
        StepFailure::check_step(t, h, substeps)?;
        let Self { placed, propagator } = self;
        let BodyAtState { body, state, lost_before, lost_time, bounces, .. } = placed;
        let stepped = propagator.step(body, t, h, substeps, state);
        let lost = propagator.lost_time();
        if lost > 0.0 {
            *lost_time = *lost_before + lost;
        }
        if const { B::HAS_WALLS }
            && let Some(now) = propagator.bounces()
        {
            bounces.follow(now);
        }
        stepped
    }

    fn change(&mut self, t: f64, change: Change<'_>) -> bool {
        let Self { placed: BodyAtState { body, state, bounces, .. }, propagator } = self;
        let is_changed = propagator.jump(t, change, &mut body.system, state);
        *bounces = *propagator.bounces().unwrap_or(bounces);
        is_changed
    }

    fn placed(&self) -> &(dyn PlacedBody + 'static) {
        &self.placed
    }

    fn recorded(&self, method: &Method, t: f64, h: f64, substeps: u32) -> Option<RecordedTick> {
        self.placed.solver.method().filter(|own| *own == method)?;
        self.placed.recorded(&|of, y| self.propagator.try_step(of, [t, h], substeps, y))
    }

    fn is_closed_form(&self) -> bool {
        self.propagator.is_closed_form()
    }

    fn truth_error(&self) -> Option<[f64; 2]> {
        self.propagator.truth_error(&self.placed.body, &self.placed.state)
    }

    fn true_bounce(&self, impact: u64) -> Option<[f64; 2]> {
        self.propagator.true_bounce(&self.placed.body.system, impact)
    }

    fn bytes(&self, solver: Solver) -> usize {
        let (body, q) = (&self.placed.body, self.placed.q());
        let kept =
            solver.method().map_or(0, |method| method.numbers_kept(q.len(), body.coupling()));
        // All fields but the solver and the bounces may contain vectors.
        let plain = size_of::<Solver>() + size_of::<Bounces>();
        let others = size_of::<Self>() - plain + self.propagator.heap_bytes();
        plain + bytes_with_vectors(others, q) + body.system.heap_bytes() + size_of::<f64>() * kept
    }

    fn boxed_clone(&self) -> Box<dyn Stepper> {
        Box::new(self.clone())
    }
}

/// A body and its state.
struct BodyAtState<B: Body> {
    body: Counted<B>,
    state: StateOf<B>,
    solver: Solver,
    /// The time in seconds that methods left out of their steps, first only before the present solver, then in all.
    lost_before: f64,
    lost_time: f64,
    bounces: Bounces,
}

impl<B: Body> Clone for BodyAtState<B> {
    /// Not inlined, because each method would otherwise contain a copy of this function.
    #[inline(never)]
    fn clone(&self) -> Self {
        Self { body: self.body.clone(), state: self.state.clone(), ..*self }
    }
}

impl<B: Body> PlacedBody for BodyAtState<B> {
    fn q(&self) -> &[f64] {
        self.state.q.components()
    }
    fn v(&self) -> &[f64] {
        self.state.v.components()
    }

    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        let mut at = self.state.clone();
        at.q.components_mut().copy_from_slice(q);
        at.v.components_mut().copy_from_slice(v);
        let mut acceleration = self.state.q.clone();
        self.body.system.acceleration(t, &at.q, &at.v, &mut acceleration);
        a.copy_from_slice(acceleration.components());
    }

    fn evaluations(&self) -> u64 {
        self.body.evaluations()
    }
    fn lost_time(&self) -> f64 {
        self.lost_time
    }
    fn bounces(&self) -> Option<&Bounces> {
        self.has_walls().then_some(&self.bounces)
    }
    fn is_linear(&self) -> bool {
        self.body.system.is_linear()
    }
    fn is_angle(&self, coordinate: usize) -> bool {
        self.body.system.is_angle(coordinate)
    }
    fn is_beyond_reference(&self) -> bool {
        is_beyond_reference(&self.body.system)
    }
    fn coupling(&self) -> Coupling {
        self.body.coupling()
    }

    fn energy(&self) -> Option<f64> {
        self.body.system.energy(&self.state)
    }
    fn kinetic_energy(&self) -> Option<f64> {
        self.body.system.kinetic_energy(&self.state)
    }
    fn mechanical_energy(&self) -> Option<[f64; 2]> {
        self.body.system.mechanical_energy(&self.state)
    }

    fn pursuit(&self, t: f64) -> Option<Pursuit<f64>> {
        let Pursuit { target, rate, order, is_still } = Pursuit::of(&self.body.system, t)?;
        Some(Pursuit { target: target.components()[0], rate, order, is_still })
    }
    fn engine_settings(&self, t: f64) -> EngineSettings {
        EngineSettings::of(&self.body.system, t, &self.state, &mut self.state.q.clone())
    }

    fn place(&self) -> DVec2 {
        self.body.system.place(&self.state.q)
    }
    fn body(&self) -> &dyn Any {
        &self.body.system
    }

    fn with_solver(&self, solver: Solver, t: f64) -> Box<dyn Stepper> {
        Self { solver, lost_before: self.lost_time, ..self.clone() }.begin(t)
    }
}
