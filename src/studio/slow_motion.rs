//! How much slower time runs while a lane outgrows the stage too fast to see. It follows from the run and the moment shown:
//! what is gone back to looks the same again.

use super::Motion;
use super::deck::Deck;
use super::viewer::Viewer;
use crate::look::{Framing, Look};
use crate::run::past::History;
use crate::run::race::Mode;

/// The fastest zoom that can be watched, in powers of ten per second of real time.
const MAX_ZOOM: f64 = 6.0;
/// The least part of its speed to which time slows down, in percent.
const MIN_PERCENT: u32 = 6;
/// The newest samples of a motion, by which its growth is measured, and the time in seconds for which it is remembered where
/// the body has been: longer than a swing that anybody waits for.
const MEASURED: usize = 4;
const REMEMBERED_S: f64 = 2.0;

/// How fast a body goes beyond this distance and beyond where it has been, in powers of ten per simulated second.
fn decades_per_s(history: &History, base_m: f64) -> f64 {
    let newest = history.samples().rev();
    let Some(now) = newest.clone().next() else { return 0.0 };
    let Some(then) = newest.clone().nth(MEASURED) else { return 0.0 };
    let reach = |from: usize| {
        let lately = newest.clone().skip(from).take_while(|sample| now.t - sample.t < REMEMBERED_S);
        lately.map(|sample| sample.at.length()).fold(base_m, f64::max)
    };
    libm::log10(reach(0) / reach(MEASURED)) / (now.t - then.t)
}

/// How fast time runs so that a lane which outgrows the stage can be watched, in percent of the speed that is set.
pub(super) fn slow_motion_percent(deck: &Deck, viewer: &Viewer) -> u32 {
    if viewer.display().motion == Motion::Recorded || deck.mode() != Mode::Solo {
        return 100;
    }
    let selected = deck.selected();
    let decades = deck.past().histories(selected.id).iter().zip(selected.lane.bodies());
    let decades = decades.map(|(history, body)| {
        let base_m = match Look::of(body).framing() {
            Framing::Recorder { half_width_m } => half_width_m,
            Framing::Fixed { half_m, .. } => half_m.max_element(),
            Framing::Follow { width_m, .. } => width_m,
        };
        if body.halted().is_some() { 0.0 } else { decades_per_s(history, base_m) }
    });
    let speed = f64::from(deck.clock().speed_percent()) / 100.0;
    let fastest = speed * decades.fold(0.0, f64::max);
    match fastest <= MAX_ZOOM {
        true => 100,
        false => ((100.0 * MAX_ZOOM / fastest) as u32).max(MIN_PERCENT),
    }
}
