//! Measures whether a method carries data from step to step.

use super::problems::{Problem, fresh, problem, spring};
use super::{Claim, Measured, yes_or_no};
use crate::integrators::{Integrator, Method, StepFailure, Stepped};
use crate::state::State;

/// Makes one step of a lively damped spring.
fn step(integrator: &mut dyn Integrator<Problem<f64>>, state: &mut State<f64>) -> Stepped {
    integrator.step(&problem(spring(20.0, 0.1)), 0.0, 0.03, state)
}

/// Whether resetting a method before every step changes its motion.
fn has_effective_memory(method: &Method) -> Result<bool, StepFailure> {
    let mut left_alone = State { q: -0.3, v: 11.0 };
    let mut interrupted = left_alone;
    let [mut continued, mut restarted] = [fresh(method), fresh(method)];
    for _ in 0..20 {
        step(&mut *continued, &mut left_alone)?;
        restarted.reset();
        step(&mut *restarted, &mut interrupted)?;
    }
    Ok(left_alone != interrupted)
}

/// Whether [`Integrator::reset`] makes a used method equal to a fresh one.
fn reset_clears_memory(method: &Method) -> Result<bool, StepFailure> {
    let (mut used, mut elsewhere) = (fresh(method), State { q: 100.0, v: 3.0 });
    for _ in 0..57 {
        step(&mut *used, &mut elsewhere)?;
    }
    used.reset();
    let mut reset = State { q: -0.3, v: 11.0 };
    let mut new = reset;
    let mut fresh = fresh(method);
    for _ in 0..20 {
        step(&mut *used, &mut reset)?;
        step(&mut *fresh, &mut new)?;
    }
    Ok(reset == new)
}

/// Measures whether the method has a memory, and whether a reset clears it.
pub(super) fn restart(method: &Method) -> Claim {
    yes_or_no("restart", method.restart.is_some(), has_memory(method))
}

pub(super) fn has_memory(method: &Method) -> Measured {
    let carries = has_effective_memory(method)?;
    let words = if carries { "its steps depend on earlier ones" } else { "it has no memory" };
    if !reset_clears_memory(method)? {
        return Err("a reset leaves some of its memory".into());
    }
    Ok((carries, words.to_owned()))
}
