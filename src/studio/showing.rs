//! The moment that is shown: at rest that of the tick reached, and while time runs one between ticks.

use super::deck::Deck;
use super::viewer::Viewer;
use crate::run::race::{Interpolation, LaneBody};

/// How bodies are drawn now: at rest as they are at the tick, however they are drawn between ticks.
fn drawn(deck: &Deck, viewer: &Viewer) -> Interpolation {
    if deck.time_runs() { viewer.display().interpolation } else { Interpolation::Raw }
}

/// The moment shown, in ticks from the one reached.
fn shown_ticks(deck: &Deck, viewer: &Viewer) -> f64 {
    drawn(deck, viewer).shown(deck.clock.alpha())
}

/// The moment shown, in seconds. Everything on the stage, and what is said of it, is of this moment.
pub fn shown_s(deck: &Deck, viewer: &Viewer) -> f64 {
    deck.race().t() + deck.race().last_step_s() * shown_ticks(deck, viewer)
}

/// The coordinates and the velocities of a lane's body at the moment shown.
pub fn shown_state(deck: &Deck, viewer: &Viewer, body: &LaneBody) -> (Vec<f64>, Vec<f64>) {
    let (drawn, alpha, h) = (drawn(deck, viewer), deck.clock.alpha(), deck.race().last_step_s());
    (drawn.coordinates(body, alpha, h), drawn.velocities(body, alpha, h))
}

/// The true coordinates and velocities of the body at this index of the scene at the moment shown.
pub fn shown_truth(deck: &Deck, viewer: &Viewer, body: usize) -> (Vec<f64>, Vec<f64>) {
    deck.past().truth_between(deck.race(), body, 1.0 + shown_ticks(deck, viewer))
}
