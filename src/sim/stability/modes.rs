//! The normal modes of a linear body, the stability of a method on each, and the long-term drift of its energy.
//!
//! The modes come from the body's acceleration. A method acts on each mode of a linear body separately, so that its map
//! is found mode by mode from the stepper. The map of a method without memory then has size 2, instead of twice the
//! number of coordinates.

use nalgebra::{DMatrix, SymmetricEigen};

use super::Tick;
use super::comparison::{LinearMotion, Mode, Stability};
use super::spectrum::{self, NEUTRAL_WITH_MEMORY};
use crate::bodies::Input;
use crate::integrators::StepFailure;
use crate::{Solver, Stepper};

/// A normal mode of a linear body, `x″ = -ω² x - c x′`.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalMode {
    /// The displacement of each coordinate. The shape is normalised to length 1.
    pub shape: Vec<f64>,
    /// ω², the square of the undamped angular frequency, per second squared; not negative.
    pub omega_squared: f64,
    /// c, the damping, per second; not negative.
    pub damping_per_s: f64,
}

impl NormalMode {
    /// Returns the damped angular frequency in radians per second; `None` if the mode is overdamped.
    pub fn swing(&self) -> Option<f64> {
        let squared = self.omega_squared - self.damping_per_s * self.damping_per_s / 4.0;
        (squared > 0.0).then(|| squared.sqrt())
    }

    /// Returns the asymptotic decay rate of the mode's amplitude, per second.
    pub fn decay_per_s(&self) -> f64 {
        -self.true_modes()[0].growth_per_s
    }

    /// Whether the energy of the mode is conserved.
    pub fn is_conserved(&self) -> bool {
        self.damping_per_s == 0.0
    }

    /// Returns the projection of `values`, one per coordinate, onto this mode.
    pub fn part(&self, values: &[f64]) -> f64 {
        spectrum::part(&self.shape, values)
    }

    fn true_modes(&self) -> [Mode; 2] {
        let decay = self.damping_per_s / 2.0;
        match self.swing() {
            Some(frequency) => [Mode { growth_per_s: -decay, frequency }; 2],
            None => {
                let fast = decay + (decay * decay - self.omega_squared).max(0.0).sqrt();
                let slow = if fast > 0.0 { self.omega_squared / fast } else { 0.0 };
                [slow, fast].map(|rate| Mode { growth_per_s: -rate, frequency: 0.0 })
            }
        }
    }

    /// Returns the stability of a method with equal steps on this mode of `body`, which must be [`unforced`]. The
    /// frequency is compared if the mode makes less than half a turn in a step.
    ///
    /// # Errors
    /// The failure of the method in the first ticks.
    pub fn stability(
        &self,
        body: &dyn Stepper,
        solver: Solver,
        tick: Tick,
    ) -> Result<Stability, StepFailure> {
        let mut stepper = body.with_solver(solver, tick.t);
        let (step, times) = tick.repeated(solver.method());
        let (mut stability, has_memory) =
            self.motion().stability(&mut *stepper, (step, times), 1.0)?;
        let is_blurred = (stability.growth_per_s * step.h).abs() <= NEUTRAL_WITH_MEMORY;
        if has_memory && is_blurred && self.is_conserved() && self.omega_squared > 0.0 {
            // If the method has memory, the map is not accurate enough to show a small growth, but the energy over many
            // ticks is.
            stepper.set(step.t, &self.shape, &vec![0.0; self.shape.len()]);
            let scale = stepper.energy().unwrap_or(0.0);
            if scale > 0.0 && scale.is_finite() {
                let growth = growth_of_energy(&mut *stepper, step, FOLLOWED_TICKS, scale)?;
                stability.growth_per_s = growth;
                stability.loss_per_s = (-growth).max(0.0);
            }
        }
        Ok(stability)
    }

    /// Returns the same as [`NormalMode::stability`], but only from the map of a small motion. This is quick, but if
    /// the method has memory, a growth of less than 1e-9 per step counts as zero.
    ///
    /// # Errors
    /// The same as for [`NormalMode::stability`].
    pub fn stability_of_small(
        &self,
        body: &dyn Stepper,
        solver: Solver,
        tick: Tick,
    ) -> Result<Stability, StepFailure> {
        let mut stepper = body.with_solver(solver, tick.t);
        let steps = tick.repeated(solver.method());
        Ok(self.motion().stability(&mut *stepper, steps, SMALL)?.0)
    }

    fn motion(&self) -> LinearMotion {
        let (shapes, truth) = (vec![self.shape.clone()], self.true_modes().into());
        LinearMotion { shapes, truth, rate: self.omega_squared.sqrt() }
    }
}

/// The amplitude of a small motion, far below the speed limits of engines. It is a power of 2, so that the map of a
/// linear method has the same bits as at amplitude 1.
const SMALL: f64 = 1.0 / (1 << 20) as f64;

/// Number of ticks over which the energy of a mode is followed.
const FOLLOWED_TICKS: u64 = 1 << 14;

/// Returns a copy of `body` with throttle 0. The equation of the copy is homogeneous except for a target, so that
/// deviations obey the same equation.
pub fn unforced(body: &dyn Stepper) -> Box<dyn Stepper> {
    let mut free = body.with_solver(Solver::Truth, 0.0);
    free.input(0.0, Input::Throttle(0.0));
    free
}

/// Returns the modes of `x″ = A x + B x′`, where `jacobian` is A with B to its right. Returns `None` if damping couples
/// the modes or if a mode grows.
pub(super) fn modes_of(jacobian: &DMatrix<f64>) -> Option<Vec<NormalMode>> {
    let n = jacobian.nrows();
    let [stiffness, damping] = [0, n].map(|first| -jacobian.columns(first, n).into_owned());
    let is_near_nought =
        |rest: DMatrix<f64>, whole: &DMatrix<f64>| rest.amax() <= COUPLING * whole.amax();
    if !is_near_nought(&stiffness - stiffness.transpose(), &stiffness) {
        return None;
    }
    let eigen = SymmetricEigen::new(stiffness);
    let shapes = eigen.eigenvectors;
    let by_mode = shapes.transpose() * &damping * &shapes;
    let own = DMatrix::from_diagonal(&by_mode.diagonal());
    if !is_near_nought(&by_mode - own, &damping) {
        return None;
    }
    let grows = |i: usize| {
        eigen.eigenvalues[i] < -COUPLING * eigen.eigenvalues.amax()
            || by_mode[(i, i)] < -COUPLING * damping.amax()
    };
    if (0..n).any(grows) {
        return None;
    }
    let mode = |i: usize| NormalMode {
        shape: shapes.column(i).iter().copied().collect(),
        omega_squared: eigen.eigenvalues[i].max(0.0),
        damping_per_s: by_mode[(i, i)].max(0.0),
    };
    Some((0..n).map(mode).collect())
}

/// A coupling below this fraction of the largest entry is rounding.
const COUPLING: f64 = 1e-10;

/// Measures the growth rate of the amplitude of `body`, as the natural logarithm of the factor per second. The
/// measurement follows the energy of `body` over `ticks` ticks like `tick`. `scale` is that energy in joules, minus the
/// energy at rest.
///
/// The rate is half the trend of the energy, from the mean energy over the second half of the ticks minus the mean over
/// the first half. Both means are weighted by a bump function. Such means of quasiperiodic functions converge faster
/// than any power of the time (Das, Saiki, Sander & Yorke, Quantitative quasiperiodicity, 2017). The result is valid if
/// the growth over all ticks is small.
///
/// # Errors
/// The failure of the method; [`StepFailure::NotFinite`] if the energy is not finite.
///
/// # Panics
/// If the body conserves no energy.
fn growth_of_energy(
    body: &mut dyn Stepper,
    tick: Tick,
    ticks: u64,
    scale: f64,
) -> Result<f64, StepFailure> {
    let half = (ticks / 2).max(1);
    let seconds = tick.h * half as f64;
    let first = mean_energy(body, tick, half)?;
    let last = mean_energy(body, Tick { t: tick.t + seconds, ..tick }, half)?;
    Ok((last - first) / seconds / scale / 2.0)
}

/// Returns the weighted mean energy over the next `ticks` ticks.
fn mean_energy(
    body: &mut dyn Stepper,
    Tick { t, h, substeps }: Tick,
    ticks: u64,
) -> Result<f64, StepFailure> {
    let (mut sum, mut weights) = (0.0, 0.0);
    for k in 0..ticks {
        body.advance(t + h * k as f64, h, substeps)?;
        let energy = body.energy().expect("it conserves its energy");
        if !energy.is_finite() {
            return Err(StepFailure::NotFinite { coordinate: "energy".into(), value: energy });
        }
        let weight = bump((k as f64 + 0.5) / ticks as f64);
        sum += weight * energy;
        weights += weight;
    }
    Ok(sum / weights)
}

/// Computes a bump function on 0 to 1, all of whose derivatives vanish at both ends.
fn bump(part: f64) -> f64 {
    libm::exp(-1.0 / (part * (1.0 - part)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::Spring;
    use crate::integrators::method;
    use crate::{Solver, stepper};

    fn near(found: f64, wanted: f64) -> bool {
        (found - wanted).abs() <= 1e-12 * wanted.abs()
    }

    #[test]
    fn a_mode_oscillates_below_critical_damping_and_decays_at_two_rates_above() {
        for (omega_squared, damping, swing, rates) in [
            (25.0, 0.0, Some(5.0), [0.0, 0.0]),
            (25.0, 6.0, Some(4.0), [-3.0, -3.0]),
            (4.0, 4.0, None, [-2.0, -2.0]),
            (6.0, 5.0, None, [-2.0, -3.0]),
            (0.0, 5.0, None, [0.0, -5.0]),
            (0.0, 0.0, None, [0.0, 0.0]),
        ] {
            let mode = NormalMode { shape: vec![1.0], omega_squared, damping_per_s: damping };
            assert_eq!(mode.swing(), swing, "{mode:?}");
            assert_eq!(mode.is_conserved(), damping == 0.0);
            let found = mode.true_modes();
            assert_eq!(found.map(|mode| mode.frequency), [swing.unwrap_or(0.0); 2]);
            let grow = found.map(|mode| mode.growth_per_s);
            assert!((0..2).all(|i| near(grow[i], rates[i])), "{mode:?}: {grow:?}");
        }
    }

    /// Measures the growth rate of an undamped spring of 1 kg and ω = 6 rad/s, which is released at 1 m, with an energy
    /// of 18 J.
    fn growth(id: &str, h: f64, seconds: f64) -> Result<f64, StepFailure> {
        let spring =
            Spring { mass: 1.0, stiffness: 36.0, damping: 0.0, x0: 1.0, v0: 0.0, kick: 1.0 };
        let mut spring = stepper(spring, Solver::Method(method(id).unwrap()));
        let tick = Tick { t: 0.0, h, substeps: 1 };
        growth_of_energy(&mut *spring, tick, (4.0 * seconds / h) as u64, 18.0)
    }

    #[test]
    fn the_trend_is_the_growth_rate_of_the_map() {
        // Each step multiplies the amplitude by √(1 + (h ω)⁴ / 4) under improved Euler.
        for h in [0.001_f64, 0.003] {
            let rate = libm::log(1.0 + (6.0 * h).powi(4) / 4.0) / h / 2.0;
            let found = growth("improved-euler", h, 10.0).unwrap();
            assert!((found / rate - 1.0).abs() < 0.01, "by {h} s: {found}, of {rate}");
        }
        let found = growth("rk4", 0.05, 10.0).unwrap();
        let rate = libm::log(1.0 - 0.3_f64.powi(6) / 72.0 + 0.3_f64.powi(8) / 576.0) / 0.05 / 2.0;
        assert!((found / rate - 1.0).abs() < 0.01, "{found}, of {rate}");
    }

    #[test]
    fn an_oscillating_energy_has_no_trend() {
        for id in ["semi-implicit-euler", "velocity-verlet", "yoshida4", "newmark"] {
            let found = growth(id, 0.02, 10.0).unwrap();
            assert!(found.abs() < 1e-9, "{id}: {found}");
        }
    }
}
