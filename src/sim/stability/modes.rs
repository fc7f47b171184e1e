//! The normal modes of a linear body, and what a method makes of each in a tick.
//!
//! The modes come from the body's own acceleration. A method treats each mode of a linear body by itself, so that
//! its map is found mode by mode from the stepper: of two rows without memory, where the map of the whole body would
//! have as many rows as a chain has coordinates and velocities.

use nalgebra::{DMatrix, SymmetricEigen};

use super::probe::state_of;
use super::spectrum::{self, Derivatives, NEUTRAL_WITH_MEMORY};
use super::trend::growth_of_energy;
use super::{Mode, Stability, Tick, against};
use crate::sim::bodies::Input;
use crate::sim::integrators::StepFailure;
use crate::sim::{Solver, Stepper};

/// A normal mode of a linear body, `x″ = -ω² x - c x′`.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalMode {
    /// How far each coordinate moves in it; of length 1.
    pub shape: Vec<f64>,
    /// ω², per second squared; not negative.
    pub omega_squared: f64,
    /// c, per second; not negative.
    pub damping_per_s: f64,
}

impl NormalMode {
    /// The angular frequency at which it swings, in radians per second; `None` where it only creeps.
    pub fn swing(&self) -> Option<f64> {
        let squared = self.omega_squared - self.damping_per_s * self.damping_per_s / 4.0;
        (squared > 0.0).then(|| squared.sqrt())
    }

    /// Whether it keeps its energy.
    pub fn is_conserved(&self) -> bool {
        self.damping_per_s == 0.0
    }

    /// What of `values`, one for each coordinate, is in this mode.
    pub fn part(&self, values: &[f64]) -> f64 {
        self.shape.iter().zip(values).map(|(shape, value)| shape * value).sum()
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

    /// What a method makes of this mode of `body`, which stands free as [`undriven`] leaves it.
    ///
    /// # Errors
    /// The failure of the method in its first ticks.
    pub fn stability(
        &self,
        body: &dyn Stepper,
        solver: Solver,
        tick: Tick,
    ) -> Result<Stability, StepFailure> {
        let mut stepper = body.with_solver(solver, tick.t);
        let n = self.shape.len();
        // The unit of velocity in which the mode's orbit is a circle, or in which a tick's way is 1.
        let rate = if self.omega_squared > 0.0 { self.omega_squared.sqrt() } else { 1.0 / tick.h };
        let mut maps: [DMatrix<f64>; 3] = std::array::from_fn(|_| DMatrix::zeros(2, 2));
        for column in 0..2 {
            let mut state = vec![0.0; 2 * n];
            let unit = if column == 0 { 1.0 } else { rate };
            for (x, shape) in state[column * n..(column + 1) * n].iter_mut().zip(&self.shape) {
                *x = unit * shape;
            }
            stepper.set(tick.t, &state[..n], &state[n..]);
            for (k, map) in maps.iter_mut().enumerate() {
                stepper.advance(tick.t + tick.h * k as f64, tick.h, tick.substeps)?;
                map[(0, column)] = self.part(stepper.q());
                map[(1, column)] = self.part(stepper.v()) / rate;
            }
        }
        let later = [maps[0].clone(), maps[1].clone()];
        let derivatives = Derivatives { now: maps, later };
        let has_memory = derivatives.has_memory();
        let Some(values) = spectrum::eigenvalues(&derivatives) else {
            return Ok(Stability::OVERFLOW);
        };
        let mut stability = against(&self.true_modes(), &values, tick.h);
        let is_blurred = (stability.growth_per_s * tick.h).abs() <= NEUTRAL_WITH_MEMORY;
        if has_memory && is_blurred && self.is_conserved() && self.omega_squared > 0.0 {
            // What a map cannot tell that had to be found out, many ticks can.
            stepper.set(tick.t, &self.shape, &vec![0.0; n]);
            let scale = stepper.energy().unwrap_or(0.0);
            if scale > 0.0 && scale.is_finite() {
                let growth = growth_of_energy(&mut *stepper, tick, FOLLOWED_TICKS, scale)?;
                stability.growth_per_s = growth;
                stability.loss_per_s = (-growth).max(0.0);
            }
        }
        Ok(stability)
    }
}

/// Ticks over which the energy of a mode is followed: a growth of 1e-15 a tick shows.
const FOLLOWED_TICKS: u64 = 1 << 14;

/// A copy of `body` without what drives it: its equation is then homogeneous, and deviations move as the body does.
pub fn undriven(body: &dyn Stepper) -> Box<dyn Stepper> {
    let mut free = body.with_solver(Solver::Truth, 0.0);
    free.input(0.0, Input::Throttle(0.0));
    free
}

/// The normal modes of `body`; `None` if it is not [linear](Stepper::is_linear), or if its damping couples its modes.
pub fn normal_modes(body: &dyn Stepper) -> Option<Vec<NormalMode>> {
    if !body.is_linear() {
        return None;
    }
    let free = undriven(body);
    let n = state_of(&*free).len() / 2;
    let column = |j: usize, moves: bool| {
        let mut state = vec![0.0; 2 * n];
        state[if moves { n + j } else { j }] = 1.0;
        let mut a = vec![0.0; n];
        free.acceleration(0.0, &state[..n], &state[n..], &mut a);
        a
    };
    let matrix = |moves: bool| {
        let columns: Vec<f64> = (0..n).flat_map(|j| column(j, moves)).collect();
        -DMatrix::from_vec(n, n, columns)
    };
    let (stiffness, damping) = (matrix(false), matrix(true));
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
    let mode = |i: usize| NormalMode {
        shape: shapes.column(i).iter().copied().collect(),
        omega_squared: eigen.eigenvalues[i].max(0.0),
        damping_per_s: by_mode[(i, i)].max(0.0),
    };
    Some((0..n).map(mode).collect())
}

/// Modes that feel each other by less than this, as a part of the largest entry, do not: rounding.
const COUPLING: f64 = 1e-10;
