//! The motion that a player sees, with its frequency, its damping and its change of energy.

use super::candidates::Candidate;
use super::logged::{Log, LoggedBody};
use super::motion::{SLOW, run};
use crate::sim::least_squares;

/// The visible motion, as that of a damped spring or of a coasting body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effective {
    /// Angular frequency of an undamped spring with the same stiffness, in rad/s; 0 if there is no spring.
    pub omega: f64,
    /// Half the rate of energy loss, per second; negative if energy is gained. If there is no spring, it is the rate at
    /// which the speed approaches its final value.
    pub decay: f64,
}

/// Length of the run from which the motion is read, in ticks, which is just long enough for a slow spring to turn.
const TICKS: u64 = 400;
/// Minimum number of ticks that are read, even if the body is soon fast.
const MIN_TICKS: usize = 6;
/// Reading stops at this distance or speed. Engines limit a body only at far higher speeds.
const FAST: f64 = 1e-2;
/// A swing is invisible if its squared frequency is below this share of the squared angular frequency.
const NO_SWING: f64 = 1e-9;
/// The pull of a spring is rounding if it is below this share of the squared decay; then the body coasts to a stop.
const NO_SPRING: f64 = 1e-8;

impl Effective {
    /// Returns the visible frequency in hertz; `None` if the motion does not swing.
    pub fn frequency_hz(&self) -> Option<f64> {
        let square = self.omega * self.omega - self.decay * self.decay;
        (square > NO_SWING * self.omega * self.omega).then(|| square.sqrt() / std::f64::consts::TAU)
    }

    /// Returns the frequency without damping, in hertz; 0 if there is no spring.
    pub fn undamped_hz(&self) -> f64 {
        self.omega / std::f64::consts::TAU
    }

    /// Returns the damping ratio, which is negative if energy is gained; `None` if there is no spring.
    pub fn damping_ratio(&self) -> Option<f64> {
        // Adding 0 turns a negative zero into 0.
        (self.omega > 0.0).then(|| self.decay / self.omega + 0.0)
    }

    /// Returns the stiffness in 1/s² and damping in 1/s, each per unit of mass, of a spring with this motion.
    pub fn spring(&self) -> Option<[f64; 2]> {
        (self.omega > 0.0).then_some([self.omega * self.omega, 2.0 * self.decay])
    }

    /// Returns the stiffness per unit of mass, in 1/s², of a spring with this motion.
    pub fn spring_stiffness(&self) -> Option<f64> {
        Some(self.spring()?[0])
    }

    /// Returns the half-life of a spring's energy in the long run, in seconds; negative if the energy doubles instead.
    /// `None` if the energy stays, or if there is no spring.
    pub fn energy_halves_s(&self) -> Option<f64> {
        let square = self.decay * self.decay - self.omega * self.omega;
        // If there are two decays without a swing, the slower one lasts.
        let rate = if square > 0.0 { self.decay - square.sqrt() } else { self.decay };
        (self.omega > 0.0).then(|| halves_s(2.0 * rate))?
    }

    /// Returns the time in which a body without a spring gets halfway to its last speed, in seconds; negative if the
    /// difference doubles instead. `None` if the speed stays, or if there is a spring.
    pub fn speed_halves_s(&self) -> Option<f64> {
        (self.omega == 0.0).then(|| halves_s(self.decay))?
    }

    /// Returns the body's exact motion, by the body's equation of motion.
    pub(super) fn exact(body: &LoggedBody) -> Option<Self> {
        let [stiffness, damping] = body.spring?;
        let loss = damping + body.drag;
        let decay = if stiffness > 0.0 { loss / 2.0 } else { loss };
        Some(Self { omega: stiffness.sqrt(), decay })
    }

    /// Whether the frequency is within 1 % of `exact`, the damping ratio within 0.005, and no energy is gained. If
    /// there is no spring, whether the decay is within 1 %.
    pub(super) fn is_near(&self, exact: &Self) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= 0.01 * b.abs() + 1e-12;
        match (self.damping_ratio(), exact.damping_ratio()) {
            (Some(ratio), Some(wanted)) => {
                let gains = ratio < wanted - 1e-6;
                near(self.omega, exact.omega) && (ratio - wanted).abs() <= 0.005 && !gains
            }
            (None, None) => near(self.decay, exact.decay),
            _ => false,
        }
    }

    /// Returns the visible motion of a body under a candidate, read while the body is slow enough for all engines.
    pub(super) fn of(candidate: Candidate, body: &LoggedBody, tick_s: f64) -> Option<Self> {
        let body = LoggedBody { push: 0.0, rest: None, ..body.clone() };
        let states = run(candidate, &body, [SLOW; 2], tick_s, 0..TICKS)?;
        let is_slow = |state: &[f64; 2]| state.iter().all(|x| x.abs() < FAST);
        let slow = states.iter().take_while(|state| is_slow(state)).count();
        let states: Vec<(u64, [f64; 2])> = (0..).zip(states).take(slow.max(MIN_TICKS)).collect();
        Self::of_states(&states, &body, tick_s)
    }

    /// Returns the motion visible in a log.
    pub(super) fn of_log(log: &Log, body: &LoggedBody, tick_s: f64) -> Option<Self> {
        let rows = log.rows();
        let mut states: Vec<(u64, [f64; 2])> =
            rows.iter().map(|row| (row.tick, [row.x, row.v.unwrap_or(0.0)])).collect();
        if rows[0].v.is_none() {
            for index in 1..states.len() {
                let (before, now) = (states[index - 1], states[index]);
                states[index].1[1] =
                    (now.1[0] - before.1[0]) / ((now.0 - before.0) as f64 * tick_s);
            }
        }
        Self::of_states(&states, body, tick_s)
    }

    /// Reads the motion from the linear recurrence of successive states or, if this fails, from the slopes of the
    /// velocity.
    fn of_states(states: &[(u64, [f64; 2])], body: &LoggedBody, tick_s: f64) -> Option<Self> {
        let recurrence = Self::of_recurrence(states, body, tick_s);
        let is_number = |seen: &Self| seen.omega.is_finite() && seen.decay.is_finite();
        let found =
            recurrence.filter(is_number).or_else(|| Self::of_slopes(states, body, tick_s))?;
        let coasts = found.omega * found.omega < NO_SPRING * found.decay * found.decay;
        Some(if coasts && found.omega > 0.0 { found.coasting() } else { found })
    }

    /// Returns the same motion without its spring.
    fn coasting(self) -> Self {
        Self { omega: 0.0, decay: 2.0 * self.decay }
    }

    /// Fits a spring to the slopes of the velocity.
    fn of_slopes(states: &[(u64, [f64; 2])], body: &LoggedBody, tick_s: f64) -> Option<Self> {
        if !body.has_spring() {
            return None;
        }
        let pairs = states.windows(2).filter(|pair| pair[1].0 == pair[0].0 + 1);
        let slope = |pair: &[(u64, [f64; 2])]| {
            let [(_, [x, v]), (_, [_, next])] = [pair[0], pair[1]];
            ([-x, -v], (next - v) / tick_s - body.push)
        };
        let rows: Vec<([f64; 2], f64)> = pairs.map(slope).collect();
        let found = solve(&rows, 2)?;
        let stiffness = Some(found[0]).filter(|stiffness| *stiffness > 0.0)?;
        Some(Self { omega: stiffness.sqrt(), decay: found[1] / 2.0 })
    }

    fn of_recurrence(states: &[(u64, [f64; 2])], body: &LoggedBody, tick_s: f64) -> Option<Self> {
        if !body.has_spring() {
            // v₁ = a v₀ + b for two ticks in a row.
            let pairs = states.windows(2).filter(|pair| pair[1].0 == pair[0].0 + 1);
            let rows: Vec<([f64; 2], f64)> =
                pairs.map(|pair| ([pair[0].1[1], 1.0], pair[1].1[1])).collect();
            let driven = body.push != 0.0;
            let kept = solve(&rows, if driven { 2 } else { 1 })?[0];
            return (kept > 0.0).then(|| Self { omega: 0.0, decay: -libm::log(kept) / tick_s });
        }
        // x₂ = a x₁ + b x₀ + c for three ticks in a row.
        let triples = states.windows(3).filter(|all| all[2].0 == all[0].0 + 2);
        let rows: Vec<([f64; 3], f64)> =
            triples.map(|all| ([all[1].1[0], all[0].1[0], 1.0], all[2].1[0])).collect();
        let found = solve(&rows, if body.push == 0.0 { 2 } else { 3 })?;
        let (half, product) = (found[0] / 2.0, -found[1]);
        let square = half * half - product;
        if square < 0.0 {
            let decay = -libm::log(product) / 2.0 / tick_s;
            let turned = libm::atan2((-square).sqrt(), half) / tick_s;
            return Some(Self { omega: libm::hypot(decay, turned), decay });
        }
        let mut kept = [half + square.sqrt(), half - square.sqrt()];
        kept.sort_by(|a, b| b.abs().total_cmp(&a.abs()));
        let rates = kept.map(|kept| -libm::log(kept.abs()) / tick_s);
        if kept[0] < 0.0 {
            // The motion changes sides at every tick.
            let turned = std::f64::consts::PI / tick_s;
            return Some(Self { omega: libm::hypot(rates[0], turned), decay: rates[0] });
        }
        let (product, sum) = (rates[0] * rates[1], rates[0] + rates[1]);
        (product > 0.0).then(|| Self { omega: product.sqrt(), decay: sum / 2.0 })
    }
}

/// Returns the half-life in seconds at this rate of loss per second; `None` if nothing is lost.
fn halves_s(rate: f64) -> Option<f64> {
    let seconds = std::f64::consts::LN_2 / rate;
    seconds.is_finite().then_some(seconds)
}

/// Returns the least-squares solution of equations in the first `unknowns` unknowns.
fn solve<const N: usize>(rows: &[([f64; N], f64)], unknowns: usize) -> Option<Vec<f64>> {
    let column = |index: usize| rows.iter().map(|(row, _)| row[index]).collect();
    let columns: Vec<Vec<f64>> = (0..unknowns).map(column).collect();
    let right: Vec<f64> = rows.iter().map(|(_, right)| *right).collect();
    least_squares(&columns, &right)
}
