//! The near future of the selected lane: the anatomy of its next tick, and the futures under each method.

use super::Studio;
use super::deck::Deck;
use crate::look::{Framing, Look};
use crate::measure;
use crate::measure::{FutureCurve, OneStep};
use crate::run::race::Entrant;
use crate::scene::LaneSpec;
use crate::sim::stability::Tick;

/// Returns the anatomy of the next tick of the displayed body in the selected lane, or `None` if the body has halted.
/// While a person is [asked](crate::Viewer::is_asked) for a prediction, the anatomy omits the end of the tick.
pub fn one_step(studio: &Studio) -> Option<OneStep> {
    let (entrant, race) = (studio.selected(), studio.race());
    let spec = entrant.spec;
    let h = race.tick_hz().step_s();
    let tick = Tick { t: race.t(), h, substeps: spec.substeps };
    let of = &entrant.lane.bodies()[studio.viewer.view.body];
    let step = measure::one_step(of, spec, race.tick(), tick)?;
    Some(match studio.viewer.is_asked() {
        true => OneStep { landing: None, chain: Vec::new(), growth: None, ..step },
        false => step,
    })
}

/// Returns the lines of constant energy through the state `through` in the displayed body's phase plane, for
/// coordinates in `range`. There are none if the body has several coordinates, or if it conserves no energy.
pub fn orbit(studio: &Studio, through: [f64; 2], range: [f64; 2]) -> Vec<Vec<[f64; 2]>> {
    let body = &studio.selected().lane.bodies()[studio.viewer.view.body];
    measure::orbit(body, studio.race().t(), through, range)
}

/// Whether the stage shows futures. It shows them while a person holds or drags the tick rate, for a second after a key
/// has changed the rate, or on request while time stands still. None are shown before a prediction.
pub fn shows_futures(studio: &Studio) -> bool {
    let is_dragged = studio.viewer.hz_at_press.is_some_and(|hz| hz != studio.race().tick_hz());
    studio.loop_lab().is_none()
        && !studio.viewer.is_asked()
        && (studio.deck.is_tick_rate_held()
            || is_dragged
            || studio.viewer.futures_left_ns > 0
            || studio.display().futures && !studio.deck.time_runs())
}

/// Returns why the stage draws no futures of a body of the selected lane, if it draws none.
pub fn without_futures(deck: &Deck, body: usize) -> Option<&'static str> {
    let of = &deck.selected().lane.bodies()[body];
    if matches!(Look::of(of).framing(), Framing::Follow { .. }) {
        return Some("The stage moves with this body, so that it has no threads.");
    }
    measure::has_no_futures(of).then_some("A body of so many coordinates has no threads.")
}

/// Returns the next second of the body with this index in the scene, from its state in the selected lane, under each
/// method. The truth comes last. There is none if the body has halted, or has too many coordinates.
pub fn futures(deck: &Deck, body: usize) -> Vec<FutureCurve> {
    futures_under(deck, deck.selected(), body, &deck.entries()[..deck.offered()])
}

/// Like [`futures`], from the state in this lane, under its own method and in truth.
pub fn future_of_lane(deck: &Deck, lane: &Entrant, body: usize) -> Vec<FutureCurve> {
    let mut futures = futures_under(deck, lane, body, &[lane.spec]);
    let own = futures.iter_mut().filter_map(|future| future.entry.as_mut());
    own.for_each(|entry| *entry = deck.entry(lane));
    futures
}

/// Like [`futures`], in truth alone, from the state in this lane.
pub fn exact_future(deck: &Deck, lane: &Entrant, body: usize) -> Option<FutureCurve> {
    futures_under(deck, lane, body, &[]).pop()
}

fn futures_under(
    deck: &Deck,
    lane: &Entrant,
    body: usize,
    methods: &[LaneSpec],
) -> Vec<FutureCurve> {
    let of = &lane.lane.bodies()[body];
    let held = deck.held().filter(|held| held.body == body);
    let held = held.map(|held| (&*held.q, &*held.v));
    let plotted = deck.past().coordinate(deck.race(), body).1;
    let (t, tick_hz) = (deck.race().t(), deck.race().tick_hz());
    measure::futures(of, t, tick_hz, held, plotted, methods)
}

#[cfg(test)]
mod tests;
