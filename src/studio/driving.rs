//! Time in a studio: for each frame it makes the ticks that are due.

use super::deck::Deck;
use super::live_loop::LiveFrame;
use super::showing::shown_s;
use super::slow_motion::slow_motion_percent;
use super::viewer::Viewer;
use crate::loops::Due;
use crate::run::race::Observer;

fn note_frame(deck: &mut Deck, viewer: &mut Viewer, duration_ns: i64, due: Due) {
    let shown_s = shown_s(deck, viewer);
    let percent = deck.clock.speed_percent() * slow_motion_percent(deck, viewer);
    let speed = f64::from(percent) / 1e4;
    let Due { ticks, dropped } = due;
    let frame = LiveFrame { duration_ns, ticks, dropped, animation_error_ms: 0.0 };
    viewer.live.add(frame, shown_s, speed);
}

/// Performs the actions at this tick, and steps to the next.
pub(super) fn make_tick(deck: &mut Deck, viewer: &mut Viewer, observer: &mut dyn Observer) {
    let ((), told) = deck.watched(|run, notices| run.tick(&mut (notices, observer)));
    viewer.tell(told);
}

/// Adds a frame of `frame_ns` nanoseconds of real time to a run: see [`Studio::advance_in_time`](super::Studio::advance_in_time).
pub(super) fn advance(
    deck: &mut Deck,
    viewer: &mut Viewer,
    last: u64,
    frame_ns: i64,
    is_time_left: &mut dyn FnMut() -> bool,
    observer: &mut dyn Observer,
) -> Due {
    // A tick rate that the script sets at this tick applies to the time from here on.
    let ((), told) = deck.watched(|run, notices| run.catch_up(&mut (notices, &mut *observer)));
    viewer.tell(told);
    let percent = slow_motion_percent(deck, viewer);
    let mut due = deck.clock.advance(frame_ns.saturating_mul(i64::from(percent)) / 100);
    for made in 1..=due.ticks {
        if deck.race().tick() >= last {
            break;
        }
        make_tick(deck, viewer, observer);
        if last == u64::MAX && deck.comes_to_rest(viewer.motion()) {
            due.ticks = made;
            deck.running = false;
            // What to do next is told as a hint.
            viewer.notice = None;
            break;
        }
        if !is_time_left() {
            due.dropped += u64::from(due.ticks - made);
            due.ticks = made;
            break;
        }
    }
    if due.ticks > 0 {
        deck.run.show_present();
    }
    deck.dropped += due.dropped;
    note_frame(deck, viewer, frame_ns, due);
    due
}
