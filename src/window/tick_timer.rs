//! Times the lanes on a thread of its own, so that measuring never delays a frame. The window's own loop only copies the
//! lanes, once per second and while the cost is shown.

use std::ops::ControlFlow;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;

use super::Event;
use crate::lab::studio::{Instrument, Studio};
use crate::lab::{Follow, Lane, LaneSpec};

/// The time between two measurements.
const PERIOD: Duration = Duration::from_secs(1);
/// Ticks that are timed together, because reading the clock takes as long as a tick of a small body, and runs of them.
/// Few enough that a lane that blows up is still timed before it does.
const TICKS: u64 = 64;
const RUNS: u32 = 8;

/// Lanes to time, with the time in seconds at which they stand, and the tick rate in Hz.
struct Lanes {
    lanes: Vec<(LaneSpec, Lane)>,
    t: f64,
    tick_hz: u32,
}

/// A handle to the thread that times. The thread ends when this is dropped.
pub(super) struct TickTimer {
    lanes: Sender<Lanes>,
    last: Option<Instant>,
}

impl TickTimer {
    /// Starts the thread. It sends an event whenever it has measured.
    pub(super) fn new(events: EventLoopProxy<Event>) -> Self {
        let (sender, receiver) = channel::<Lanes>();
        thread::spawn(move || {
            while let Ok(lanes) = receiver.recv() {
                let latest = receiver.try_iter().last().unwrap_or(lanes);
                if events.send_event(Event::TicksTimed(timed(&latest))).is_err() {
                    return;
                }
            }
        });
        Self { lanes: sender, last: None }
    }

    /// Has the lanes timed, if their cost is shown and was not measured within the last second.
    pub(super) fn ask(&mut self, studio: &Studio, now: Instant) {
        let is_due = self.last.is_none_or(|last| now.duration_since(last) >= PERIOD);
        if studio.display().instrument != Instrument::Cost || !is_due {
            return;
        }
        self.last = Some(now);
        let race = studio.race();
        let entrants = race.entrants().iter();
        let lanes = entrants.map(|lane| (lane.spec, lane.lane.clone())).collect();
        // If the thread has ended, nothing more is measured; the window stays open.
        _ = self.lanes.send(Lanes { lanes, t: race.t(), tick_hz: race.tick_hz() });
    }
}

fn timed(Lanes { lanes, t, tick_hz }: &Lanes) -> Vec<(LaneSpec, Option<f64>)> {
    let begin = Instant::now();
    let clock = || u64::try_from(begin.elapsed().as_nanos()).unwrap_or(u64::MAX);
    let follow = |lane: &Lane| Follow::new(lane.clone(), *tick_hz).from_time(*t);
    let time = |lane| ns_per_tick(&follow(lane), TICKS, RUNS, clock);
    lanes.iter().map(|(spec, lane)| (*spec, time(lane))).collect()
}

/// The time in nanoseconds of a tick, by a clock that says how many have passed: the least over `runs` runs of `ticks`
/// ticks each, on copies. `None` if a body halts.
fn ns_per_tick(
    follow: &Follow<Lane>,
    ticks: u64,
    runs: u32,
    clock: impl Fn() -> u64,
) -> Option<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..runs {
        let mut run = follow.clone();
        let start = clock();
        run.run(ticks, |_, _| ControlFlow::Continue(()));
        let passed = clock().saturating_sub(start);
        if run.body.halted().is_some() {
            return None;
        }
        least = least.min(passed as f64 / ticks as f64);
    }
    least.is_finite().then_some(least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    use crate::lab::Scene;
    use crate::lab::studio::StageCommand;
    use crate::sim::Solver;
    use crate::sim::integrators::method;

    fn lane(scene: &str, id: &str) -> Follow<'static, Lane> {
        let scene = Scene::built_in(scene).unwrap();
        Follow::new(Lane::new(&scene, Solver::Method(method(id).unwrap()), 1), scene.tick_hz)
    }

    #[test]
    fn the_time_of_a_tick_is_the_least_of_its_runs_and_a_halted_lane_has_none() {
        let (reading, step) = (Cell::new(0), Cell::new(900));
        // Each run takes 100 ns less than the one before.
        let clock = || {
            reading.set(reading.get() + step.get());
            step.set(step.get() - 50);
            reading.get()
        };
        assert_eq!(ns_per_tick(&lane("spring", "rk4"), 10, 3, clock), Some(65.0));
        assert_eq!(ns_per_tick(&lane("stiff", "explicit-euler"), 700, 1, || 0), None);
    }

    #[test]
    fn every_lane_of_a_race_takes_some_time() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.apply(StageCommand::ToggleRace);
        let lanes = studio.race().entrants().iter();
        let lanes = lanes.map(|lane| (lane.spec, lane.lane.clone())).collect();
        let timed = timed(&Lanes { lanes, t: 0.0, tick_hz: 60 });
        assert_eq!(timed.len(), 5);
        for (spec, ns) in timed {
            assert!(ns.is_some_and(|ns| ns > 1.0 && ns < 1e8), "{}: {ns:?} ns", spec.method.id);
        }
    }
}
