//! A law at the walls of its events.

use super::Law;
use crate::body::{Body, Distances, Piece};
use crate::impact::{Wall, comes_to_rest};
use crate::law::{At, Registers};
use crate::state::State;

/// The mode of a wall on which the law rests.
const RESTS: i64 = 1;

impl Law {
    /// Returns the wall with the restitution that the event has at 1 unit per second.
    pub(super) fn with_restitution(&self, wall: Wall, index: usize, t: f64) -> Wall {
        let mut state = self.start();
        state.v[wall.coordinate] = wall.velocity - wall.side;
        self.turn(index, t, &mut state);
        Wall { restitution: wall.speed(&state.v), ..wall }
    }

    /// Adds the accelerations by soft walls.
    pub(super) fn soft_pushes(&self, t: f64, [q, v]: [&[f64]; 2], a: &mut [f64]) {
        for wall in (0..).map_while(|index| self.wall(index, t)) {
            a[wall.coordinate] += wall.soft_push(q, v);
        }
    }

    /// Meets or leaves a wall at time `t` (s), whose mode is `mode`. Returns whether the state has jumped.
    pub(super) fn meet(
        &self,
        index: usize,
        mode: &mut i64,
        t: f64,
        state: &mut State<Vec<f64>>,
    ) -> bool {
        let Some(wall) = self.wall(index, t) else { return false };
        if *mode == RESTS {
            *mode = 0;
            return false;
        }
        state.q[wall.coordinate] = wall.at;
        if wall.speed(&state.v) < 0.0 {
            self.turn(index, t, state);
        }
        let push =
            self.push(wall, &mut self.registers.borrow_mut(), self.at(t, &state.q, &state.v));
        let speed = wall.speed(&state.v);
        // A flight that is lower than the rounding of the place is none.
        let is_low = speed * speed < -push * 8.0 * f64::EPSILON * wall.at.abs();
        if push < 0.0 && is_low || comes_to_rest(speed, push) {
            state.v[wall.coordinate] = wall.velocity;
            *mode = RESTS;
        }
        true
    }

    /// Returns the acceleration away from a wall.
    fn push(&self, wall: Wall, registers: &mut Registers, at: At<'_>) -> f64 {
        let a = self.equations.acceleration_of(registers, at, wall.coordinate);
        wall.side * (a - wall.acceleration)
    }

    /// Writes the modes of the walls on which the law rests.
    pub(super) fn write_rests(&self, t: f64, state: &State<Vec<f64>>, piece: &mut Piece) {
        let registers = &mut self.registers.borrow_mut();
        let first = self.first_wall();
        for index in 0..self.equations.events() {
            let Some(wall) = self.equations.wall(registers, index, t) else { return };
            let is_still = wall.height(&state.q) == 0.0 && wall.speed(&state.v) == 0.0;
            let rests =
                is_still && self.push(wall, registers, self.at(t, &state.q, &state.v)) < 0.0;
            piece.modes[first + index] = if rests { RESTS } else { 0 };
        }
    }

    /// Writes the heights above the walls, and for walls on which the law rests how far it is from leaving.
    pub(super) fn write_heights(
        &self,
        registers: &mut Registers,
        piece: &Piece,
        at: At<'_>,
        distances: &mut Distances,
    ) {
        let first = self.first_wall();
        for index in 0..self.equations.events() {
            let Some(wall) = self.equations.wall(registers, index, at.t) else { return };
            distances[first + index] = match piece.modes[first + index] {
                RESTS => [f64::INFINITY, -self.push(wall, registers, at)],
                _ => [wall.height(at.q), f64::INFINITY],
            };
        }
    }

    /// Overwrites the accelerations of coordinates that rest on walls.
    pub(super) fn hold(&self, registers: &mut Registers, piece: &Piece, t: f64, a: &mut [f64]) {
        let first = self.first_wall();
        for index in (0..self.equations.events()).filter(|i| piece.modes[first + i] == RESTS) {
            if let Some(wall) = self.equations.wall(registers, index, t) {
                a[wall.coordinate] = wall.acceleration;
            }
        }
    }
}
