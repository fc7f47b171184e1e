//! Findings on a body that turns in space, beside its truth: its attitude, its energy, its flips, and whether it tips
//! over. Near the middle axis a small error shifts the time of a flip, so that there the flips are judged.

use std::fmt;

use super::criterion::{TOLERANCE, VISIBLE};
use super::outcome::Outcome;
use crate::sim::number::{counted, duration, significant};

/// Half a turn, in radians: attitudes cannot be farther apart.
const HALF_TURN: f64 = std::f64::consts::PI;

/// The largest error that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// The rotation of a lane beside that of the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct SpinFinding {
    /// The largest angle between the two attitudes, in radians, and its time in seconds.
    pub attitude: (f64, f64),
    /// The largest difference of the angular velocities in the frame of the body, in parts of the fastest true one.
    pub omega: f64,
    /// The energy at the end, in parts of the true one.
    pub energy: f64,
    /// The largest angle in space between the two angular momenta, in radians.
    pub momentum_turn: f64,
    /// The time in seconds at which the body tips over. The axis about which it began to turn is then more than
    /// 45° from L, and half as far again as it ever is in truth.
    pub tips_at_s: Option<f64>,
    /// Flips of that axis, of the lane and of the truth.
    pub flips: [u32; 2],
    /// By how many seconds the flip that is most off is late, and the same in parts of the time between two.
    pub late: Option<(f64, f64)>,
    /// Length of the run in seconds.
    pub seconds: f64,
}

impl SpinFinding {
    /// Returns the largest error of the attitude in half turns, or of the angular velocity.
    pub fn error(&self) -> f64 {
        (self.attitude.0 / HALF_TURN).max(self.omega)
    }

    fn keeps_energy(&self) -> bool {
        (self.energy - 1.0).abs() <= VISIBLE
    }

    fn looks_right(&self) -> bool {
        let [own, truth] = self.flips;
        let flips_alike = truth > 0
            && own.abs_diff(truth) <= 1
            && self.late.is_some_and(|(_, part)| part.abs() <= VISIBLE)
            && self.keeps_energy()
            && self.momentum_turn <= VISIBLE * HALF_TURN;
        self.attitude.0 <= VISIBLE * HALF_TURN || flips_alike
    }

    pub(super) fn outcome(&self) -> Outcome {
        match self.error() {
            error if error <= ROUNDING => Outcome::Rounding,
            error if error <= TOLERANCE => Outcome::Accurate,
            _ if self.looks_right() => Outcome::LooksRight,
            _ if self.energy > 1.0 + VISIBLE => Outcome::Grows,
            _ if self.energy < 1.0 - VISIBLE => Outcome::DiesAway,
            _ => Outcome::Bounded,
        }
    }

    /// Adds the angle (rad) between a lane and the truth where its verdict begins, and the ratio of their energies.
    pub(super) fn beside(self, apart: f64, energy: f64) -> Self {
        let (own, at_s) = self.attitude;
        Self { attitude: (own + apart, at_s), energy: self.energy * energy, ..self }
    }

    /// Returns the same finding on a run in which the judged part begins at this time (s).
    pub(super) fn starting_at(self, starts_at_s: f64) -> Self {
        let attitude = (self.attitude.0, self.attitude.1 + starts_at_s);
        Self { attitude, tips_at_s: self.tips_at_s.map(|at_s| at_s + starts_at_s), ..self }
    }

    /// Returns the quantity that the words are about, its value and its unit.
    pub(super) fn number(&self) -> (&'static str, f64, &'static str) {
        let degrees = self.attitude.0.to_degrees();
        match self.tips_at_s {
            _ if self.outcome() <= Outcome::Accurate => ("attitude error", degrees, "°"),
            Some(at_s) => ("tips over at", at_s, "s"),
            None if !self.keeps_energy() => ("energy", self.energy, "×"),
            None if self.flips[1] > 0 && self.flips[0] != self.flips[1] => {
                ("flips", f64::from(self.flips[0]), "")
            }
            None if let Some((late_s, _)) = self.late => ("delay of a flip", late_s, "s"),
            None if self.momentum_turn > VISIBLE => {
                ("turn of L", self.momentum_turn.to_degrees(), "°")
            }
            None => ("attitude error", degrees, "°"),
        }
    }
}

impl fmt::Display for SpinFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (quantity, value, unit) = self.number();
        let span = duration(self.seconds);
        match quantity {
            "tips over at" => {
                write!(f, "tips over at {}", duration(value))?;
                match self.keeps_energy() {
                    true => Ok(()),
                    false => write!(f, ", energy ×{} in {span}", significant(self.energy, 3)),
                }
            }
            "energy" if value > 1.0 => {
                write!(f, "energy ×{} in {span}", significant(value, 3))
            }
            "energy" => {
                let lost = significant(100.0 * (1.0 - value), 2);
                write!(f, "loses {lost} % of its energy in {span}")
            }
            "flips" if value == 0.0 => f.write_str("never flips"),
            "flips" => {
                let [own, truth] = self.flips;
                write!(f, "flips {} instead of {truth}", counted(u64::from(own), "time"))
            }
            "delay of a flip" => {
                let way = if value > 0.0 { "late" } else { "early" };
                write!(f, "flips up to {} ms too {way}", significant(1e3 * value.abs(), 2))
            }
            "turn of L" => write!(f, "its L turns {}{unit} in space", significant(value, 2)),
            _ if self.outcome() <= Outcome::Accurate => {
                write!(f, "within {}{unit}", significant(value, 2))
            }
            _ => {
                let at = duration(self.attitude.1);
                write!(f, "off by {}{unit} at {at}", significant(value, 2))
            }
        }
    }
}
