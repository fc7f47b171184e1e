//! The walls of a body in its reference solution. Each is a switch of the force law, after the others. In flight it
//! ends a step where the body meets the wall, and at rest where the wall lets the body go.

use crate::body::{Body, Distances, Piece};
use crate::contact::Contact;
use crate::impact::comes_to_rest;
use crate::state::{State, Vector};
use crate::system::{StateOf, System};

/// The mode of a wall on which the body rests.
const RESTS: i64 = 1;

/// One smooth piece of the force law of a body, continued beyond its boundaries. A coordinate that rests on a wall goes
/// with it.
pub(super) struct SmoothPiece<'a, B> {
    pub(super) body: &'a B,
    pub(super) piece: &'a Piece,
}

impl<B: Body> System for SmoothPiece<'_, B> {
    type Vector = B::Vector;

    #[inline]
    fn acceleration(&self, t: f64, q: &B::Vector, v: &B::Vector, a: &mut B::Vector) {
        let Self { body, piece } = self;
        body.acceleration_on(piece, t, q, v, a);
        let first = body.first_wall();
        let resting = (first..body.switches()).filter(|switch| piece.modes[*switch] == RESTS);
        for wall in resting.filter_map(|switch| body.wall(switch - first, t)) {
            a.components_mut()[wall.coordinate] = wall.acceleration;
        }
    }
}

/// Returns the walls that are switches, each with its switch.
fn walls<B: Body>(body: &B, t: f64) -> impl Iterator<Item = (usize, Contact)> {
    (body.first_wall()..body.switches()).zip(Contact::all(body, t))
}

/// Returns the smooth piece at this time and state.
pub(super) fn piece<B: Body>(body: &B, t: f64, y: &StateOf<B>) -> Piece {
    let mut piece = body.piece(t, y);
    for (switch, contact) in walls(body, t) {
        let is_still = contact.height(y) == 0.0 && contact.speed(y) == 0.0;
        let rests = is_still && contact.true_push(body, t, y) < 0.0;
        piece.modes[switch] = if rests { RESTS } else { 0 };
    }
    piece
}

/// Returns the distances to the boundaries of a piece. Of a wall on which the body rests, it is how far the body is
/// from leaving.
pub(super) fn distances_to_ends<B: Body>(
    body: &B,
    piece: &Piece,
    t: f64,
    y: &StateOf<B>,
) -> Distances {
    let mut distances = body.distances_to_ends(piece, t, y);
    for (switch, contact) in walls(body, t) {
        distances[switch] = match piece.modes[switch] {
            RESTS => [f64::INFINITY, -contact.true_push(body, t, y)],
            _ => [contact.height(y), f64::INFINITY],
        };
    }
    distances
}

/// Enters the piece beyond a boundary of a switch on this side. Returns whether the state has jumped.
pub(super) fn cross<B: Body>(
    body: &B,
    piece: &mut Piece,
    [switch, side]: [usize; 2],
    t: f64,
    y: &mut State<B::Vector>,
) -> bool {
    let mode = &mut piece.modes[switch];
    let Some(index) = switch.checked_sub(body.first_wall()) else {
        *mode = body.neighbour(switch, *mode, side);
        return false;
    };
    let Some(contact) = Contact::all(body, t).nth(index) else { return false };
    if *mode == RESTS {
        *mode = 0;
        return false;
    }
    contact.set_height(0.0, y);
    if contact.speed(y) < 0.0 {
        contact.turn(body, t, y);
    }
    // The turned velocity may lie in another piece of the force law, as that of a drag by v |v|.
    let others = body.first_wall();
    piece.modes[..others].copy_from_slice(&body.piece(t, y).modes[..others]);
    let (push, speed) = (contact.true_push(body, t, y), contact.speed(y));
    // A flight that is lower than the rounding of the place, or of the time at which the wall is there, is none.
    let size = contact.wall.at.abs() + (contact.wall.velocity * t).abs();
    let is_low = speed * speed < -push * 8.0 * f64::EPSILON * size;
    if push < 0.0 && is_low || comes_to_rest(speed, push) {
        contact.set_speed(0.0, y);
        piece.modes[switch] = RESTS;
    }
    true
}
