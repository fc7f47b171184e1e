//! A tick of a physics engine, or a frame of an interface's spring, for one body.
//!
//! Each engine's file has its formula, read from the engine's source and checked against logs of the engine itself
//! (`tests/library/engines`). All engines read the spring's stiffness and damping as settings of a joint and the drag
//! as a setting of the body. They read any other force once a tick and hold it for all substeps; see
//! [`EngineSettings::of`].
//!
//! The letters are those of the formulas. `H` is a tick, `n` is the number of its substeps, and `h = H/n`. `K` is the
//! stiffness, `c` the damping and `C` the drag, each per unit of mass. `f` is the held force per unit of mass, and `D =
//! 1 + h c + h² K`.

use std::marker::PhantomData;

use super::card::Carded;
use super::failure::{StepFailure, Stepped};
use super::gyro::{moments_of, turn_state};
use super::integrator::{Integrator, Override};
use super::only::{NO_FREE_SPIN, Needs};
use crate::state::{State, Vector};
use crate::system::{EngineSettings, StateOf, System};

/// A tick of an engine, with its length, substeps, settings and force.
#[derive(Debug)]
pub struct EngineTick<'a, V> {
    /// H, the length of the tick, in seconds.
    pub(super) length: f64,
    /// n, the number of substeps.
    pub(super) substeps: u32,
    /// K, c and C, the settings of the joint and of the body.
    pub(super) settings: EngineSettings,
    /// f, the force per unit of mass, which is constant through the tick.
    pub(super) force: &'a V,
    /// The two memories from tick to tick, which are 0 at the start; `None` if the engine's card has no
    /// [restart](Method::restart).
    pub(super) carried: Option<&'a mut [V; 2]>,
}

impl<V> EngineTick<'_, V> {
    /// Returns h, the length of a substep, in seconds.
    pub(super) fn substep(&self) -> f64 {
        self.length / f64::from(self.substeps)
    }
}

/// The reason why an engine by its id does not step a system that answers no engine query.
const NO_JOINT: &str = "the engine asks for the joint, and the system does not tell it; let `System::query` answer \
    `Query::Engine`: write stiffness, damping and drag per unit mass into `settings` (0 without a joint), and the rest \
    of the acceleration into `force`, and return true";

/// The tick of an engine.
pub trait EngineRule: Carded + Clone + Send + Sync + 'static {
    /// Advances the coordinates `q` and the velocities `v` by a tick.
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V);
}

/// An engine as a method, which reads the force at the start of a tick and applies the engine's rule.
#[derive(Clone)]
pub struct EngineMethod<V, R> {
    force: V,
    carried: Option<[V; 2]>,
    /// K and c of the joint, if they override the body's.
    joint: Option<[f64; 2]>,
    /// Whether a system must answer the engine query.
    asks: bool,
    rule: PhantomData<R>,
}

impl<S: System<Vector: Vector>, R: EngineRule> Integrator<S> for EngineMethod<S::Vector, R> {
    fn new(like: &S::Vector) -> Self {
        let mut zero = like.clone();
        zero.components_mut().fill(0.0);
        let carried = R::CARD.restart.map(|_| [zero.clone(), zero.clone()]);
        Self { force: zero, carried, joint: None, asks: false, rule: PhantomData }
    }

    #[inline]
    fn step(&mut self, system: &S, t: f64, h: f64, state: &mut StateOf<S>) -> Stepped {
        self.tick(system, t, h, 1, state)
    }

    #[inline]
    fn steps(&mut self, system: &S, t: f64, h: f64, n: u32, state: &mut StateOf<S>) -> Stepped {
        if R::CARD.engine.is_some_and(|engine| engine.has_substeps()) {
            return self.tick(system, t, h, n, state);
        }
        let part = h / f64::from(n);
        (0..n).try_for_each(|i| self.tick(system, t + part * f64::from(i), part, 1, state))
    }

    fn set(&mut self, with: Override) {
        match with {
            Override::Joint(joint) => self.joint = Some(joint),
            Override::EngineQuery => self.asks = true,
            Override::Tolerance(_) => {}
        }
    }

    fn reset(&mut self) {
        self.carried.iter_mut().flatten().for_each(|carried| carried.components_mut().fill(0.0));
    }
}

impl<V: Vector, R: EngineRule> EngineMethod<V, R> {
    #[inline]
    fn tick<S: System<Vector = V>>(
        &mut self,
        system: &S,
        t: f64,
        length: f64,
        substeps: u32,
        state: &mut State<V>,
    ) -> Stepped {
        if let Some(moments) = moments_of(system, t) {
            let free_spin = R::CARD.engine.and_then(|engine| engine.free_spin);
            let spin = free_spin.ok_or(StepFailure::Refused { reason: NO_FREE_SPIN })?;
            let steps = if spin.is_once_a_tick { 1 } else { substeps };
            let h = length / f64::from(steps);
            let turn = |omega| Ok(spin.default.turn(moments, omega, h));
            return (0..steps).try_for_each(|_| turn_state(state, turn));
        }
        let Self { force, carried, joint, .. } = self;
        let only = R::CARD.only.expect("an engine's card says what it steps");
        let mut settings = EngineSettings::NONE;
        match only.needs {
            Needs::Force => system.acceleration(t, &state.q, &state.v, force),
            _ if settings.ask(system, t, state, force) => {}
            Needs::Engine if self.asks => return Err(StepFailure::Refused { reason: NO_JOINT }),
            _ => system.acceleration(t, &state.q, &state.v, force),
        }
        if let (Some([stiffness, damping]), true) = (*joint, settings.has_spring()) {
            settings = EngineSettings { stiffness, damping, ..settings };
        }
        let is_refused = match only.needs {
            Needs::EngineWithoutJoint => settings.has_spring(),
            Needs::Joint => settings.stiffness <= 0.0,
            _ => false,
        };
        if is_refused {
            return Err(StepFailure::Refused { reason: only.reason });
        }
        let carried = carried.as_mut();
        let tick = EngineTick { length, substeps, settings, force, carried };
        R::tick(tick, &mut state.q, &mut state.v);
        Ok(())
    }
}

/// Calls `change` with each component's coordinate, velocity and force.
#[inline]
pub(super) fn each<V: Vector>(
    force: &V,
    q: &mut V,
    v: &mut V,
    change: impl Fn(&mut f64, &mut f64, f64),
) {
    let moved = q.components_mut().iter_mut().zip(v.components_mut());
    for ((x, v), f) in moved.zip(force.components()) {
        change(x, v, *f);
    }
}

/// Shortens a velocity longer than `max_speed`, in metres per second.
#[inline]
pub(super) fn cap<V: Vector>(v: &mut V, max_speed: f64) {
    let part = part_below(max_speed, v.components().iter().copied());
    if part < 1.0 {
        v.components_mut().iter_mut().for_each(|v| *v *= part);
    }
}

/// Returns the factor that shortens a velocity with these components to `max_speed`, in metres per second. The factor
/// is at most 1.
#[inline]
pub(super) fn part_below(max_speed: f64, v: impl Iterator<Item = f64>) -> f64 {
    let square: f64 = v.map(|v| v * v).sum();
    if square > max_speed * max_speed { max_speed / square.sqrt() } else { 1.0 }
}
