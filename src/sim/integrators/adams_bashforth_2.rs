//! Adams-Bashforth 2, which extrapolates the slopes here and one step ago to the middle of the step.

use super::prelude::*;
use super::shared::LastStep;

pub(super) const CARD: Method = Method {
    id: "adams-bashforth-2",
    name: "Adams-Bashforth 2",
    about: "second order for one evaluation a step; an undamped spring gains energy, twice as fast as under improved Euler",
    caveat: SLOW_GROWTH,
    order: 2,
    order_with_drag: 2,
    evaluations: Some(1),
    restart: Some("by a step of improved Euler"),
    damped_limits: Some([0.8, 1.394, 2.0]),
    source: "Bashforth & Adams, An Attempt to Test the Theories of Capillary Action (1883)",
    formula: &["k = f(t, y), k₋₁ = f(t − h, y₋₁)", "y′ = y + ½h (3 k − k₋₁)"],
    ..EXPLICIT
};

/// Adams-Bashforth 2, by the [formula](Method::formula) on its card. `f` is the slope here, and `g` is the slope one
/// step ago.
#[derive(Clone)]
pub struct AdamsBashforth2<V> {
    f: State<V>,
    g: State<V>,
    /// The predicted end of the first step.
    end: State<V>,
    last_step: LastStep,
}

impl<S: System> Integrator<S> for AdamsBashforth2<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        Self { f: zero.clone(), g: zero.clone(), end: zero, last_step: LastStep::NONE }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { f, g, end, last_step } = self;
        system.derivative(t, y, f);
        if last_step.is_continued_by(h) {
            y.add_terms([(h * 1.5, f), (h * -0.5, g)]);
        } else {
            end.assign_sum(y, h, f);
            system.derivative(t + h, end, g);
            y.add_terms([(h / 2.0, f), (h / 2.0, g)]);
        }
        std::mem::swap(f, g);
        last_step.end(h);
        Ok(())
    }

    fn reset(&mut self) {
        self.last_step = LastStep::NONE;
    }
}
