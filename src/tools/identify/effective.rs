//! What a player sees: the frequency, the damping and the change of energy of a motion.

use super::candidates::Candidate;
use super::logged::{Log, LoggedBody};
use super::motion::run;
use crate::sim::least_squares;

/// The motion that a player sees, as that of a damped spring or of a body that coasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effective {
    /// The angular frequency of an undamped spring with the same stiffness in rad/s; 0 without a spring.
    pub omega: f64,
    /// Half the rate at which the energy is lost, per second; negative if it is gained. Without a spring, the
    /// rate at which the speed approaches its end.
    pub decay: f64,
}

/// How long a run is from which the motion is read, in ticks: the fewest that show a slow spring turn.
const TICKS: u64 = 400;
/// The fewest of these that are read.
const MIN_TICKS: usize = 6;
/// Where such a run starts, in metres and in metres per second.
pub(crate) const SLOW: f64 = 1e-6;
/// How far it is read, in the same units: engines limit a body only at far higher speeds.
const FAST: f64 = 1e-2;
/// The part of the square of the angular frequency below which nothing is seen to swing.
const NO_SWING: f64 = 1e-9;

impl Effective {
    /// The frequency that is seen, in hertz; `None` if the motion does not swing.
    pub fn frequency_hz(&self) -> Option<f64> {
        let square = self.omega * self.omega - self.decay * self.decay;
        (square > NO_SWING * self.omega * self.omega).then(|| square.sqrt() / std::f64::consts::TAU)
    }

    /// The frequency at which it would swing without its damping, in hertz; 0 without a spring.
    pub fn undamped_hz(&self) -> f64 {
        self.omega / std::f64::consts::TAU
    }

    /// The damping ratio; negative if energy is gained; `None` without a spring.
    pub fn damping_ratio(&self) -> Option<f64> {
        // A negative zero is 0.
        (self.omega > 0.0).then(|| self.decay / self.omega + 0.0)
    }

    /// The stiffness and the damping of a spring with this motion, for each kilogram.
    pub fn spring(&self) -> Option<[f64; 2]> {
        (self.omega > 0.0).then_some([self.omega * self.omega, 2.0 * self.decay])
    }

    /// The stiffness of a spring with this motion, for each kilogram.
    pub fn spring_stiffness(&self) -> Option<f64> {
        Some(self.spring()?[0])
    }

    /// The time in which the energy of a spring halves in the long run, in seconds; negative if it doubles instead.
    /// `None` if it stays, and without a spring.
    pub fn energy_halves_s(&self) -> Option<f64> {
        let square = self.decay * self.decay - self.omega * self.omega;
        // Of two motions without a swing, the one that lasts.
        let rate = if square > 0.0 { self.decay - square.sqrt() } else { self.decay };
        (self.omega > 0.0).then(|| halves_s(2.0 * rate))?
    }

    /// The time in which a body without a spring gets half the way to its last speed, in seconds; negative if it gets
    /// twice as far from it. `None` if the speed stays, and with a spring.
    pub fn speed_halves_s(&self) -> Option<f64> {
        (self.omega == 0.0).then(|| halves_s(self.decay))?
    }

    /// What the equation of motion says.
    pub(super) fn exact(body: &LoggedBody) -> Option<Self> {
        let [stiffness, damping] = body.spring?;
        let loss = damping + body.drag;
        let decay = if stiffness > 0.0 { loss / 2.0 } else { loss };
        Some(Self { omega: stiffness.sqrt(), decay })
    }

    /// Whether frequency and damping are those of `exact` to within 1 %, and half a percent of critical damping, and no
    /// energy is gained.
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

    /// What is seen of a body under a candidate, where it is slow enough for all engines.
    pub(super) fn of(candidate: Candidate, body: &LoggedBody, tick_s: f64) -> Option<Self> {
        let body = LoggedBody { push: 0.0, rest: None, ..body.clone() };
        let states = run(candidate, &body, [SLOW; 2], tick_s, 0..TICKS)?;
        let is_slow = |state: &[f64; 2]| state.iter().all(|x| x.abs() < FAST);
        let slow = states.iter().take_while(|state| is_slow(state)).count();
        let states: Vec<(u64, [f64; 2])> = (0..).zip(states).take(slow.max(MIN_TICKS)).collect();
        Self::of_states(&states, &body, tick_s)
    }

    /// What is seen in a log.
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

    /// From the linear recurrence that states at successive ticks obey, or else from the slopes of the velocity.
    fn of_states(states: &[(u64, [f64; 2])], body: &LoggedBody, tick_s: f64) -> Option<Self> {
        let recurrence = Self::of_recurrence(states, body, tick_s);
        let is_number = |seen: &Self| seen.omega.is_finite() && seen.decay.is_finite();
        recurrence.filter(is_number).or_else(|| Self::of_slopes(states, body, tick_s))
    }

    /// The spring that gives velocities their slopes.
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
            // v′ = a v + b.
            let pairs = states.windows(2).filter(|pair| pair[1].0 == pair[0].0 + 1);
            let rows: Vec<([f64; 2], f64)> =
                pairs.map(|pair| ([pair[0].1[1], 1.0], pair[1].1[1])).collect();
            let driven = body.push != 0.0;
            let kept = solve(&rows, if driven { 2 } else { 1 })?[0];
            return (kept > 0.0).then(|| Self { omega: 0.0, decay: -libm::log(kept) / tick_s });
        }
        // x″ = a x′ + b x + c, after three ticks in a row.
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
            // It jumps to the other side at every tick.
            let turned = std::f64::consts::PI / tick_s;
            return Some(Self { omega: libm::hypot(rates[0], turned), decay: rates[0] });
        }
        let (product, sum) = (rates[0] * rates[1], rates[0] + rates[1]);
        (product > 0.0).then(|| Self { omega: product.sqrt(), decay: sum / 2.0 })
    }
}

/// The time in which something halves that is lost at this rate, in seconds.
fn halves_s(rate: f64) -> Option<f64> {
    let seconds = std::f64::consts::LN_2 / rate;
    seconds.is_finite().then_some(seconds)
}

/// The least squares solution of equations in the first `unknowns` unknowns.
fn solve<const N: usize>(rows: &[([f64; N], f64)], unknowns: usize) -> Option<Vec<f64>> {
    let column = |index: usize| rows.iter().map(|(row, _)| row[index]).collect();
    let columns: Vec<Vec<f64>> = (0..unknowns).map(column).collect();
    let right: Vec<f64> = rows.iter().map(|(_, right)| *right).collect();
    least_squares(&columns, &right)
}
