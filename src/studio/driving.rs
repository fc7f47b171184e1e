//! Time in a studio: the ticks due in a frame, and the displayed moment between two ticks. Time slows down while a lane
//! outgrows the stage too fast to see.
//!
//! A blow-up grows by powers of ten within a few frames, before a person sees its cause. In slow motion no landmark
//! passes in less than [`LANDMARK_S`]. It applies to a single lane that a person watches, and only at the usual speed,
//! so that a chosen speed stays. It scales the time that the clock receives, and changes no bit of the run.

use super::Motion;
use super::Studio;
use super::pace::LiveFrame;
use super::pulling::pull;
use crate::look::landmarks::decades_to_next;
use crate::look::{Framing, Look};
use crate::loops::Due;
use crate::run::past::History;
use crate::run::race::{Interpolation, LaneBody, Mode, Observer};
use crate::sim::number::{round, significant};

/// Fastest zoom that people can follow, in powers of ten per second of real time.
const MAX_ZOOM: f64 = 6.0;
/// Slowest speed of slow motion, in thousandths of the set speed.
const MIN_THOUSANDTHS: u32 = 10;
/// Width of a stage on which a landmark stands out, relative to the landmark's size.
const STANDS_OUT: f64 = 4.0;
/// Least time (s) from one landmark to the next, and fastest zoom beyond the last, in powers of ten per second.
const LANDMARK_S: f64 = 1.6;
const MAX_ZOOM_BEYOND: f64 = 3.0;
/// Number of newest samples over which a motion's growth is measured, and time (s) for which its past reach counts. The
/// time is longer than any swing that people wait for.
const MEASURED: usize = 4;
const REMEMBERED_S: f64 = 2.0;
/// Time over which slow growth is measured, in seconds.
const SWING_S: f64 = 1.0;

/// Adds a frame of `frame_ns` nanoseconds of real time to a run, as described at
/// [`Studio::advance_in_time`](super::Studio::advance_in_time).
pub(super) fn advance(
    studio: &mut Studio,
    last: u64,
    frame_ns: i64,
    is_time_left: &mut dyn FnMut() -> bool,
    observer: &mut dyn Observer,
) -> Due {
    // A tick rate that the script sets at this tick already applies to the time after it.
    let ((), told) =
        studio.deck.with_notices(|run, notices| run.catch_up(&mut (notices, &mut *observer)));
    studio.viewer.set_notice_parts(told);
    let thousandths = slow_motion(studio);
    let mut due = studio.deck.clock.advance(frame_ns.saturating_mul(i64::from(thousandths)) / 1000);
    for made in 1..=due.ticks {
        if studio.race().tick() >= last {
            break;
        }
        pull(&mut studio.deck);
        make_tick(studio, observer);
        if last == u64::MAX && studio.deck.comes_to_rest(studio.viewer.motion()) {
            due.ticks = made;
            studio.deck.running = false;
            // A hint replaces the notice and suggests the next step.
            studio.viewer.notice = None;
            break;
        }
        if !is_time_left() {
            due.dropped += u64::from(due.ticks - made);
            due.ticks = made;
            break;
        }
    }
    if due.ticks > 0 {
        studio.deck.run.show_present();
    }
    let shown_s = shown_s(studio);
    studio.deck.follow_with_compared(shown_s);
    studio.deck.dropped += due.dropped;
    note_frame(studio, frame_ns, due);
    due
}

/// Performs the actions at this tick, and steps to the next tick.
pub(super) fn make_tick(studio: &mut Studio, observer: &mut dyn Observer) {
    studio.viewer.notice.take_if(|notice| notice.is_of_tick());
    let ((), told) = studio.deck.with_notices(|run, notices| run.tick(&mut (notices, observer)));
    studio.viewer.set_notice_parts(told);
}

fn note_frame(studio: &mut Studio, duration_ns: i64, due: Due) {
    let shown_s = shown_s(studio);
    let slowed = f64::from(slow_motion(studio)) / 1e3;
    let speed = slowed * f64::from(studio.deck.clock.speed_percent()) / 100.0;
    let Due { ticks, dropped } = due;
    let frame = LiveFrame { duration_ns, ticks, dropped, animation_error_ms: 0.0 };
    studio.viewer.live.add(frame, shown_s, speed);
}

/// Returns the interpolation at present. It is raw while time stands still, so that bodies appear at their tick.
fn drawn_interpolation(studio: &Studio) -> Interpolation {
    if studio.deck.time_runs() { studio.display().interpolation } else { Interpolation::Raw }
}

/// Returns the displayed moment, in ticks after the last tick. It is negative before that tick.
fn shown_ticks(studio: &Studio) -> f64 {
    drawn_interpolation(studio).shown(studio.deck.clock.alpha())
}

/// Returns the displayed moment (s). Everything on the stage belongs to this moment, including the numbers.
pub fn shown_s(studio: &Studio) -> f64 {
    studio.race().t() + studio.race().last_step_s() * shown_ticks(studio)
}

/// Returns the last tick at or before the displayed moment.
pub fn shown_tick(studio: &Studio) -> u64 {
    let is_before = shown_ticks(studio) < 0.0;
    studio.race().tick().saturating_sub(u64::from(is_before))
}

/// Returns the coordinates and velocities of a lane's body at the displayed moment.
pub fn shown_state(studio: &Studio, body: &LaneBody) -> (Vec<f64>, Vec<f64>) {
    let (drawn, alpha, h) =
        (drawn_interpolation(studio), studio.deck.clock.alpha(), studio.race().last_step_s());
    (drawn.coordinates(body, alpha, h), drawn.velocities(body, alpha))
}

/// Returns the true coordinates and velocities, at the displayed moment, of the body with this index in the scene.
pub fn shown_truth(studio: &Studio, body: usize) -> (Vec<f64>, Vec<f64>) {
    studio.past().truth_between(studio.race(), body, 1.0 + shown_ticks(studio))
}

/// Returns the speed at which a person can follow a lane that outgrows the stage, in thousandths of real time. At this
/// speed no landmark passes in less than [`LANDMARK_S`]. A speed that the person has set stays as it is.
pub(super) fn slow_motion(studio: &Studio) -> u32 {
    let is_watched = studio.display().motion == Motion::Live && studio.deck.time_runs();
    if !is_watched || studio.mode() != Mode::Solo || studio.clock().speed_percent() != 100 {
        return 1000;
    }
    let selected = studio.selected();
    let zooms = studio.past().histories(selected.id).iter().zip(selected.lane.bodies());
    let zooms = zooms.map(|(history, body)| {
        let (base_m, has_landmarks) = match Look::of(body).framing() {
            Framing::Recorder { half_width_m } => (half_width_m, true),
            Framing::Fixed { half_m, .. } => (half_m.max_element(), false),
            Framing::Follow { width_m, .. } => (width_m, false),
        };
        if body.halted().is_some() {
            return 0.0;
        }
        let (decades_per_s, reach_m) = growth(history, base_m);
        let most = match has_landmarks {
            true => (decades_to_next(2.0 * reach_m / STANDS_OUT) / LANDMARK_S).min(MAX_ZOOM_BEYOND),
            false => MAX_ZOOM,
        };
        decades_per_s / most
    });
    let fastest = zooms.fold(0.0, f64::max);
    match fastest <= 1.0 {
        true => 1000,
        false => ((1000.0 / fastest) as u32).max(MIN_THOUSANDTHS),
    }
}

/// Describes the slow motion, or returns `None` if there is none.
pub fn slowed_in_words(studio: &Studio) -> Option<String> {
    let thousandths = slow_motion(studio);
    let times = significant(f64::from(thousandths) / 1e3, 1);
    (thousandths < 1000).then(|| format!("slowed ×{times}"))
}

/// Describes the speed at which time runs, or returns `None` if it is that of real time.
pub fn pace_in_words(studio: &Studio) -> Option<String> {
    let percent = studio.clock().speed_percent();
    let set = (percent != 100).then(|| match percent {
        25 => "at ¼× speed".into(),
        50 => "at ½× speed".into(),
        _ => format!("at {}× speed", round(f64::from(percent) / 100.0, 3)),
    });
    set.or_else(|| slowed_in_words(studio))
}

/// Returns the rate at which a body exceeds both this distance and its own past reach, in powers of ten per simulated
/// second. Also returns the distance (m) that the body has reached.
fn growth(history: &History, base_m: f64) -> (f64, f64) {
    let newest = history.samples().rev();
    let Some(now) = newest.clone().next() else { return (0.0, base_m) };
    let reach = |from: usize| {
        let lately = newest.clone().skip(from).take_while(|sample| now.t - sample.t < REMEMBERED_S);
        lately.map(|sample| sample.at.length()).fold(base_m, f64::max)
    };
    let reach_m = reach(0);
    let since = |count: usize| {
        let then = newest.clone().nth(count).filter(|then| then.t < now.t);
        then.map_or(0.0, |then| libm::log10(reach_m / reach(count)) / (now.t - then.t))
    };
    let known = newest.clone().take(MEASURED + 1).count() - 1;
    let sudden = since(known);
    if sudden > MAX_ZOOM {
        return (sudden, reach_m);
    }
    // Slow growth is measured over a swing or more, because a swing grows only on its way out.
    let lately = newest.clone().take_while(|sample| now.t - sample.t <= SWING_S);
    (since(lately.count().max(known + 1) - 1), reach_m)
}
