//! Times the lanes on a separate thread, so that measuring never delays a frame. The window's own loop only copies
//! the lanes, once per second and while the cost is shown.

use std::ops::ControlFlow;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;

use super::Event;
use crate::run::{Lane, Ticker};
use crate::scene::LaneSpec;
use crate::scene::TickRate;
use crate::stopwatch;
use crate::studio::{Instrument, Studio};

/// Time between two measurements.
const PERIOD: Duration = Duration::from_secs(1);
/// Ticks timed together. They are few enough that a lane that blows up is still timed before it does.
const TICKS: u64 = 64;
/// Time to spend on a lane.
const EFFORT: Duration = Duration::from_micros(200);

/// Lanes to time, with their current time in seconds and their tick rate.
struct Lanes {
    lanes: Vec<(LaneSpec, Lane)>,
    t: f64,
    tick_hz: TickRate,
}

/// A handle to the timing thread, which ends when this is dropped.
pub(super) struct TickTimer {
    lanes: Sender<Lanes>,
    last: Option<Instant>,
}

impl TickTimer {
    /// Starts the thread. It sends an event after each measurement.
    pub(super) fn new(events: EventLoopProxy<Event>) -> Self {
        let (sender, receiver) = channel::<Lanes>();
        thread::spawn(move || {
            while let Ok(lanes) = receiver.recv() {
                let latest = receiver.try_iter().last().unwrap_or(lanes);
                if events.send_event(Event::TicksTimed(time_lanes(&latest))).is_err() {
                    return;
                }
            }
        });
        Self { lanes: sender, last: None }
    }

    /// Sends the lanes to be timed, if their cost is shown and was not measured within the last second.
    pub(super) fn request_timing(&mut self, studio: &Studio, now: Instant) {
        let is_due = self.last.is_none_or(|last| now.duration_since(last) >= PERIOD);
        if studio.display().instrument != Instrument::Cost || !is_due {
            return;
        }
        self.last = Some(now);
        let race = studio.race();
        let entrants = race.entrants().iter();
        let lanes = entrants.map(|lane| (lane.spec, lane.lane.clone())).collect();
        // If the thread has ended, nothing more is measured, but the window stays open.
        _ = self.lanes.send(Lanes { lanes, t: race.t(), tick_hz: race.tick_hz() });
    }
}

/// Nanoseconds per tick of each lane; `None` for one that halts.
fn time_lanes(Lanes { lanes, t, tick_hz }: &Lanes) -> Vec<(LaneSpec, Option<f64>)> {
    let time = |lane: &Lane| {
        let made = || Ticker::new(lane.clone(), *tick_hz).from_time(*t);
        let mut run = made();
        run.run(TICKS, |_, _| ControlFlow::Continue(()));
        let is_halted = run.body.halted().is_some();
        let least = || stopwatch::ns_per_tick(made, TICKS, EFFORT).first().copied();
        if is_halted { None } else { least() }
    };
    lanes.iter().map(|(spec, lane)| (*spec, time(lane))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::sim::integrators::method;
    use crate::studio::StageCommand;

    #[test]
    fn a_lane_that_halts_while_timed_has_no_cost() {
        let scene = Scene::built_in("stiff").unwrap();
        let spec = LaneSpec::plain(method("explicit-euler").unwrap());
        let mut run = Ticker::new(Lane::new(&scene, spec.solver(), spec.substeps), scene.tick_hz);
        // On the lane's last ticks.
        for end in (1..100).map(|i| i * TICKS / 2) {
            let before = run.clone();
            run.run(end, |_, _| ControlFlow::Continue(()));
            if run.body.halted().is_some() {
                let lanes = vec![(spec, before.body)];
                assert_eq!(
                    time_lanes(&Lanes { lanes, t: 0.0, tick_hz: scene.tick_hz }),
                    [(spec, None)]
                );
                return;
            }
        }
        panic!("it blows up");
    }

    #[test]
    fn every_lane_of_a_race_has_a_time() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.apply(StageCommand::ToggleRace);
        let lanes = studio.race().entrants().iter();
        let lanes = lanes.map(|lane| (lane.spec, lane.lane.clone())).collect();
        let timed = time_lanes(&Lanes { lanes, t: 0.0, tick_hz: 60.into() });
        assert_eq!(timed.len(), 5);
        for (spec, ns) in timed {
            assert!(ns.is_some_and(|ns| ns > 1.0 && ns < 1e8), "{}: {ns:?} ns", spec.method.id);
        }
    }
}
