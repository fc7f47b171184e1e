//! What a method makes of a body in one tick: the map about the present state, how it grows, and how
//! fast it turns, against the exact flow.
//!
//! The map is found by differencing the stepper itself, never from a formula, so that it holds for any
//! method on any body: two-sided, at distances scaled to the state. The input stays as it is.
//!
//! - A method that carries something from step to step is followed over three ticks, and the map is that
//!   of state and memory together; on a nonlinear body, under the forces of here and now, straightened.
//! - A method that chooses its substeps steps the differenced copies as one, with the same substeps for
//!   all: the map is that of the steps it takes here, its control frozen.
//! - On a nonlinear body the map is that of small deviations here and now. What grows in truth, such as
//!   a pendulum's fall from the top, is not held against a method. No such map says what
//!   becomes of the motion in the long run.

use super::integrators::StepFailure;
use super::{Solver, Stepper};

mod flock;
mod modes;
mod probe;
mod search;
mod spectrum;
mod trend;
mod true_modes;

use flock::Flock;
pub use modes::{NormalMode, normal_modes, undriven};
use probe::{COPIES, Carrier, Probe, rates, scale, state_of};
pub use search::{RATES_HZ, RateSearch};
use spectrum::{Derivatives, Eigenvalue};
use true_modes::true_modes;

/// One tick of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// When it begins, in seconds.
    pub t: f64,
    /// How long it is, in seconds.
    pub h: f64,
    /// Equal steps in it.
    pub substeps: u32,
}

/// How a method treats small deviations of a body from its present state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stability {
    /// The largest modulus of an eigenvalue of the one-tick map; infinite where the map overflows.
    pub spectral_radius: f64,
    /// By how much the worst mode grows in a second beyond what it does in truth or, where it decays in
    /// truth, beyond standing still: the natural logarithm of the factor. Negative where all decays.
    pub growth_per_s: f64,
    /// By how much the method damps the mode that it damps most of those that truth conserves: the
    /// natural logarithm in a second, 0 without such a mode.
    pub loss_per_s: f64,
    /// How much too fast the mode turns that is furthest off, as a part of its frequency; `None` where
    /// nothing swings, where the method no longer does, or where a mode makes half a turn or more in the
    /// tick: the map of a tick does not tell one turn and a bit from a bit of a turn.
    pub frequency_error: Option<f64>,
}

/// An amplitude that takes longer than this to double is bounded: a year, in seconds. No game runs as
/// long, and at 10 000 Hz less growth could not be told from rounding.
pub const FOREVER_S: f64 = 365.0 * 86_400.0;

impl Stability {
    /// Of a map that overflows.
    const OVERFLOW: Self = Self {
        spectral_radius: f64::INFINITY,
        growth_per_s: f64::INFINITY,
        loss_per_s: 0.0,
        frequency_error: None,
    };

    /// Of `body` as it is, under `solver`.
    ///
    /// What it says of growth and loss holds at any length of tick. Frequencies it compares only where every mode makes less
    /// than half a turn in the tick. How often a mode turns in truth is known at any length of tick on a linear body; on
    /// a nonlinear one only where it turns no more than one and a half times in a tick, or no faster than the forces at
    /// its start would have it.
    ///
    /// # Errors
    /// The failure of the method, or of the exact flow, in the first ticks from here.
    pub fn of(body: &dyn Stepper, solver: Solver, tick: Tick) -> Result<Self, StepFailure> {
        let truth = true_modes(body, tick)?;
        let Some(values) = eigenvalues(body, solver, tick)? else {
            return Ok(Self::OVERFLOW);
        };
        Ok(against(&truth, &values, tick.h))
    }

    /// Whether deviations stay as small as they are in truth, for as long as anybody looks.
    pub fn is_bounded(&self) -> bool {
        self.growth_per_s * FOREVER_S < std::f64::consts::LN_2
    }

    /// The seconds in which the amplitude doubles that in truth does not; `None` where it is bounded.
    pub fn doubling_s(&self) -> Option<f64> {
        (!self.is_bounded()).then(|| std::f64::consts::LN_2 / self.growth_per_s)
    }

    /// The seconds in which the amplitude halves that in truth does not; `None` where none does within
    /// [`FOREVER_S`].
    pub fn halving_s(&self) -> Option<f64> {
        let halving = std::f64::consts::LN_2 / self.loss_per_s;
        (halving > 0.0 && halving < FOREVER_S).then_some(halving)
    }
}

/// How fast a mode grows and turns.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mode {
    /// Natural logarithm of the factor in a second.
    growth_per_s: f64,
    /// Radians per second, not negative.
    frequency: f64,
}

impl Mode {
    fn new(value: Eigenvalue, h: f64) -> Self {
        Self { growth_per_s: libm::log(value.modulus) / h, frequency: value.angle / h }
    }
}

/// What grows less than this in a second, as a part of a turn in a tick, stands still: the rounding of
/// the differences.
const STILL: f64 = 1e-9;

/// What grows in truth may grow by this part faster: neither rate says much of the long run.
const OWN_GROWTH: f64 = 0.1;

fn against(truth: &[Mode], values: &[Eigenvalue], h: f64) -> Stability {
    let (swinging, creeping): (Vec<Mode>, Vec<Mode>) =
        truth.iter().partition(|m| m.frequency > 0.0);
    // Beyond as many as truth has, the faintest are what the method remembers.
    let mut by_modulus = values.to_vec();
    by_modulus.sort_by(|a, b| b.modulus.total_cmp(&a.modulus));
    let memory = by_modulus.split_off(truth.len().min(by_modulus.len()));
    let (mut turning, mut rest): (Vec<Eigenvalue>, Vec<Eigenvalue>) =
        by_modulus.into_iter().partition(|value| value.turns());

    let mut pairs: Vec<(Option<Mode>, Mode)> = Vec::new();
    let mut frequency_error = None;
    if turning.len() == swinging.len() {
        turning.sort_by(|a, b| a.angle.total_cmp(&b.angle));
        let mut swinging = swinging;
        swinging.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        let turning = turning.iter().map(|&value| Mode::new(value, h));
        pairs.extend(swinging.into_iter().map(Some).zip(turning));
        let errors = pairs.iter().filter_map(|(truth, found)| {
            truth.map(|truth| found.frequency / truth.frequency - 1.0)
        });
        frequency_error = errors.max_by(|a, b| a.abs().total_cmp(&b.abs())).filter(|_| {
            let fastest = truth.iter().map(|mode| mode.frequency).fold(0.0, f64::max);
            fastest * h < std::f64::consts::PI
        });
    } else {
        rest.append(&mut turning);
    }
    for mode in creeping {
        let expected = libm::exp(mode.growth_per_s * h);
        let distance = |value: &Eigenvalue| {
            let re = value.modulus * libm::cos(value.angle);
            let im = value.modulus * libm::sin(value.angle);
            libm::hypot(re - expected, im)
        };
        let nearest =
            (0..rest.len()).min_by(|&a, &b| distance(&rest[a]).total_cmp(&distance(&rest[b])));
        if let Some(nearest) = nearest {
            pairs.push((Some(mode), Mode::new(rest.swap_remove(nearest), h)));
        }
    }
    let unpaired = rest.iter().chain(&memory).map(|&value| (None, Mode::new(value, h)));
    pairs.extend(unpaired);

    let excess = pairs.iter().map(|&(truth, found)| match truth {
        Some(Mode { growth_per_s: own, .. }) if own * h > STILL => {
            let excess = found.growth_per_s - own;
            if excess.abs() < OWN_GROWTH * own { 0.0 } else { excess }
        }
        _ => found.growth_per_s,
    });
    let conserved = |mode: Mode| (mode.growth_per_s * h).abs() < STILL;
    let losses = pairs.iter().filter(|(truth, _)| truth.is_some_and(conserved));
    Stability {
        spectral_radius: values.iter().map(|value| value.modulus).fold(0.0, f64::max),
        growth_per_s: excess.fold(f64::NEG_INFINITY, f64::max),
        loss_per_s: losses.map(|(_, found)| -found.growth_per_s).fold(0.0, f64::max),
        frequency_error,
    }
}

/// The eigenvalues of `body` under `solver`, from its present state; `None` where the map overflows.
fn eigenvalues(
    body: &dyn Stepper,
    solver: Solver,
    tick: Tick,
) -> Result<Option<Vec<Eigenvalue>>, StepFailure> {
    let mut first = body.with_solver(solver, tick.t);
    first.set(tick.t, body.q(), body.v());
    let here = state_of(&*first);
    first.advance(tick.t, tick.h, tick.substeps)?;
    let there = state_of(&*first);

    let mut probe = Probe::new(body, solver, tick);
    let scale = scale(&here, &there, tick.h);
    // What such a method carries is the length of its steps, and that is frozen.
    if solver.method().is_some_and(|method| method.tolerance.is_some()) {
        let [map] = probe.derivatives(&here, &scale)?;
        return Ok(spectrum::of_map(&map));
    }
    let derivatives = Derivatives {
        now: probe.derivatives(&here, &scale)?,
        later: probe.derivatives(&there, &scale)?,
    };
    if let Some(method) = solver.method()
        && derivatives.has_memory()
        && derivatives.bends()
    {
        // Over three ticks the forces change more than the memory does: only a body with the forces of
        // here and now can tell it.
        let rates = rates(body, &here, &scale, tick.t);
        let flock = Flock::straightened(body, rates, tick.t, method, COPIES.len());
        let mut probe = Probe { carrier: Carrier::Together(flock), tick };
        let derivatives = Derivatives {
            now: probe.derivatives(&here, &scale)?,
            later: probe.derivatives(&here, &scale)?,
        };
        return Ok(spectrum::eigenvalues(&derivatives));
    }
    Ok(spectrum::eigenvalues(&derivatives))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::kind;
    use crate::sim::integrators::method;
    use std::f64::consts::PI;

    /// Modes that grow by these rates per second and do not swing.
    fn creeping<const N: usize>(rates: [f64; N]) -> [Mode; N] {
        rates.map(|growth_per_s| Mode { growth_per_s, frequency: 0.0 })
    }

    fn values<const N: usize>(values: [(f64, f64); N]) -> [Eigenvalue; N] {
        values.map(|(modulus, angle)| Eigenvalue { modulus, angle })
    }

    fn near(found: f64, wanted: f64) -> bool {
        (found - wanted).abs() <= 1e-9 * wanted.abs()
    }

    #[test]
    fn what_creeps_in_truth_is_held_against_the_nearest_eigenvalue() {
        let h = 0.1;
        for (case, nearest) in [
            // Nearer than what turns a sixth of a turn, whose real part is a quarter.
            ([(0.5, PI / 3.0), (0.5, PI / 3.0), (0.4, 0.0)], 0.4),
            // Further off than what hardly turns.
            ([(0.9, 0.2), (0.9, 0.2), (0.7, 0.0)], 0.9),
            // What flips is far off, however near in modulus.
            ([(0.99, PI), (0.99, PI), (0.8, 0.0)], 0.8),
        ] {
            let found = against(&creeping([0.0, -1.0, -1.0]), &values(case), h);
            assert!(near(found.loss_per_s, -libm::log(nearest) / h), "{case:?}: {found:?}");
        }
        // The nearest to e^0.2 and to e³.
        let found = against(&creeping([2.0, 30.0]), &values([(19.0, 0.0), (1.2, 0.0)]), h);
        assert_eq!(found.growth_per_s, 0.0);
    }

    #[test]
    fn growth_is_counted_beyond_that_of_the_truth_and_from_a_tenth_of_it() {
        for h in [0.1, 4.0] {
            for (own, grows, counted) in [
                (2.0, 2.15, 0.0),
                (2.0, 1.85, 0.0),
                (2.0, 2.3, 0.3),
                (2.0, 1.5, -0.5),
                (-2.0, 0.5, 0.5),
                (-2.0, -0.5, -0.5),
                (0.0, 0.1, 0.1),
            ] {
                let value = (libm::exp(grows * h), 0.0);
                let found = against(&creeping([own]), &values([value]), h).growth_per_s;
                assert!((found - counted).abs() < 1e-9, "{own}, {grows}: {found}");
            }
        }
        // Truth that seems to grow by 1e-10 in a tick stands still.
        let found = against(&creeping([1e-6]), &values([(1.0 + 1e-10, 0.0)]), 1e-4);
        assert!((found.growth_per_s / 1e-6 - 1.0).abs() < 1e-3, "{found:?}");
        let found = against(&creeping([1e-6]), &values([(0.5, 0.0)]), 1e-4);
        assert!(near(found.loss_per_s, libm::log(2.0) / 1e-4), "{found:?}");
        // A loss of what decays in truth is none.
        let found = against(&creeping([-1.0]), &values([(0.5, 0.0)]), 1.0);
        assert_eq!(found.loss_per_s, 0.0);
    }

    #[test]
    fn of_all_frequencies_the_one_furthest_off_is_told() {
        let swing = |frequency: f64| Mode { growth_per_s: 0.0, frequency };
        let truth = [swing(40.0), swing(10.0), swing(40.0), swing(10.0)];
        let turning = |of: [f64; 2]| values([of[0], of[0], of[1], of[1]].map(|a| (1.0, a * 0.01)));
        let error = |of| against(&truth, &turning(of), 0.01).frequency_error.unwrap();
        assert!(near(error([10.1, 38.8]), -0.03));
        assert!(near(error([40.4, 10.3]), 0.03));
        // One that flips swings no more, and then nothing is told of the other.
        let flipped = values([(1.0, 0.1), (1.0, 0.1), (1.0, PI), (1.0, PI)]);
        assert_eq!(against(&truth, &flipped, 0.01).frequency_error, None);
    }

    #[test]
    fn what_a_method_remembers_counts_where_it_grows() {
        let h = 0.1;
        let found = against(&creeping([-1.0]), &values([(1.1, PI), (0.9, 0.0)]), h);
        assert!(near(found.growth_per_s, libm::log(1.1) / h), "{found:?}");
        assert_eq!(found.spectral_radius, 1.1);
    }

    #[test]
    fn a_frequency_error_is_told_up_to_half_a_turn_in_a_tick_and_not_beyond() {
        let midpoint = Solver::Method(method("implicit-midpoint").unwrap());
        for (turned, told) in
            [(3.1, true), (3.2, false), (8.0, false), (13.0, false), (30.0, false)]
        {
            let spring = (kind("spring").unwrap().build)(
                &[1.0, turned * turned, 0.0, 1.0, 0.0, 1.0],
                Solver::Truth,
            );
            let found = Stability::of(&*spring, midpoint, Tick { t: 0.0, h: 1.0, substeps: 1 });
            let error = found.unwrap().frequency_error;
            let wanted = 2.0 * libm::atan(turned / 2.0) / turned - 1.0;
            assert_eq!(error.is_some(), told, "{turned} rad");
            assert!(
                error.is_none_or(|error| near(error, wanted)),
                "{turned} rad: {error:?}, not {wanted}"
            );
        }
    }
}
