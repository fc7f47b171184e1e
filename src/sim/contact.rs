//! A wall of a body, as the line after a step and the truth meet it.
//!
//! In a reference solution each wall is a switch of the force law. In flight it ends a step where the body meets the
//! wall, and at rest where the wall lets the body go.

use super::body::{Body, Distances, Piece};
use super::impact::{Wall, comes_to_rest};
use super::state::{State, Vector};
use super::system::{Counted, StateOf, System};

/// The mode of a wall on which the body rests.
const RESTS: i64 = 1;

/// A wall met by a body, with its index.
#[derive(Clone, Copy)]
pub(super) struct Contact {
    pub(super) index: usize,
    pub(super) wall: Wall,
}

impl Contact {
    /// Returns the wall beyond which a body is at time `t` (s).
    pub(super) fn beyond<B: Body>(body: &B, t: f64, y: &StateOf<B>) -> Option<Self> {
        Self::all(body, t).find(|contact| contact.height(y) < 0.0)
    }

    pub(super) fn all<B: Body>(body: &B, t: f64) -> impl Iterator<Item = Self> {
        (0..).map_while(move |index| Some(Self { index, wall: body.wall(index, t)? }))
    }

    /// Returns the same wall at another time.
    pub(super) fn at<B: Body>(self, body: &B, t: f64) -> Self {
        body.wall(self.index, t).map_or(self, |wall| Self { wall, ..self })
    }

    /// Returns the distance from the wall, negative beyond it.
    pub(super) fn height<V: Vector>(self, y: &State<V>) -> f64 {
        self.wall.height(y.q.components())
    }

    /// Returns the velocity away from the wall.
    pub(super) fn speed<V: Vector>(self, y: &State<V>) -> f64 {
        self.wall.speed(y.v.components())
    }

    pub(super) fn set_height<V: Vector>(self, height: f64, y: &mut State<V>) {
        y.q.components_mut()[self.wall.coordinate] = self.wall.at + self.wall.side * height;
    }

    pub(super) fn set_speed<V: Vector>(self, speed: f64, y: &mut State<V>) {
        y.v.components_mut()[self.wall.coordinate] = self.wall.velocity + self.wall.side * speed;
    }

    /// Turns a body at time `t` (s). Returns the velocities away from the wall before and after.
    pub(super) fn turn<B: Body>(self, body: &B, t: f64, y: &mut StateOf<B>) -> [f64; 2] {
        let speed = self.speed(y);
        if !body.turn(self.index, t, y) {
            self.set_speed(-self.wall.restitution * speed, y);
        }
        [speed, self.speed(y)]
    }

    /// Returns the acceleration away from the wall, for which `a` is room.
    pub(super) fn push<B: Body>(self, body: &Counted<B>, t: f64, y: &StateOf<B>, a: &mut B::Vector) -> f64 {
        body.acceleration(t, &y.q, &y.v, a);
        self.wall.side * (a.components()[self.wall.coordinate] - self.wall.acceleration)
    }
    /// Returns the same, uncounted, for the truth.
    fn true_push<B: Body>(self, body: &B, t: f64, y: &StateOf<B>) -> f64 {
        let a = body.acceleration_of(t, y, self.wall.coordinate);
        self.wall.side * (a - self.wall.acceleration)
    }
}

/// Meets or leaves a wall at time `t` (s), whose mode is `mode`. Returns whether the state has jumped.
pub(super) fn meet<B: Body>(
    body: &B,
    index: usize,
    mode: &mut i64,
    t: f64,
    y: &mut StateOf<B>,
) -> bool {
    let Some(wall) = body.wall(index, t) else { return false };
    if *mode == RESTS {
        *mode = 0;
        return false;
    }
    let contact = Contact { index, wall };
    contact.set_height(0.0, y);
    if contact.speed(y) < 0.0 {
        contact.turn(body, t, y);
    }
    let (push, speed) = (contact.true_push(body, t, y), contact.speed(y));
    // A flight that is lower than the rounding of the place is none.
    let is_low = speed * speed < -push * 8.0 * f64::EPSILON * wall.at.abs();
    if push < 0.0 && is_low || comes_to_rest(speed, push) {
        contact.set_speed(0.0, y);
        *mode = RESTS;
    }
    true
}

/// Writes the modes of the walls on which a body rests.
pub(super) fn write_rests<B: Body>(body: &B, t: f64, y: &StateOf<B>, piece: &mut Piece) {
    for contact in Contact::all(body, t) {
        let is_still = contact.height(y) == 0.0 && contact.speed(y) == 0.0;
        let rests = is_still && contact.true_push(body, t, y) < 0.0;
        piece.modes[body.first_wall() + contact.index] = if rests { RESTS } else { 0 };
    }
}

/// Writes the heights above the walls, and for walls on which a body rests how far it is from leaving.
pub(super) fn write_heights<B: Body>(
    body: &B,
    piece: &Piece,
    t: f64,
    y: &StateOf<B>,
    distances: &mut Distances,
) {
    for contact in Contact::all(body, t) {
        let switch = body.first_wall() + contact.index;
        distances[switch] = match piece.modes[switch] {
            RESTS => [f64::INFINITY, -contact.true_push(body, t, y)],
            _ => [contact.height(y), f64::INFINITY],
        };
    }
}

/// Overwrites the accelerations of coordinates that rest on walls.
pub(super) fn hold<B: Body>(body: &B, piece: &Piece, t: f64, a: &mut B::Vector) {
    let first = body.first_wall();
    let resting = (first..body.switches()).filter(|switch| piece.modes[*switch] == RESTS);
    for wall in resting.filter_map(|switch| body.wall(switch - first, t)) {
        a.components_mut()[wall.coordinate] = wall.acceleration;
    }
}
