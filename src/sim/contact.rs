//! A wall of a body, as the line after a step and the truth meet it.

use super::body::Body;
use super::impact::Wall;
use super::state::{State, Vector};
use super::system::{Counted, StateOf, System};

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

    pub(super) fn is_at_rest<V: Vector>(self, y: &State<V>) -> bool {
        self.height(y) == 0.0 && self.speed(y) == 0.0
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
    pub(super) fn push<B: Body>(
        self,
        body: &Counted<B>,
        t: f64,
        y: &StateOf<B>,
        a: &mut B::Vector,
    ) -> f64 {
        body.acceleration(t, &y.q, &y.v, a);
        self.wall.side * (a.components()[self.wall.coordinate] - self.wall.acceleration)
    }

    /// Returns the same, uncounted, for the truth.
    pub(super) fn true_push<B: Body>(self, body: &B, t: f64, y: &StateOf<B>) -> f64 {
        let a = body.acceleration_of(t, y, self.wall.coordinate);
        self.wall.side * (a - self.wall.acceleration)
    }
}
