//! Times the lanes on a thread of its own, so that measuring never delays a frame. The window's own loop only copies the
//! lanes, once per second and while the cost is shown.

use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;

use super::Event;
use crate::lab::{Instrument, Lab, Lane, LaneSpec};

/// The time between two measurements.
const PERIOD: Duration = Duration::from_secs(1);
/// Ticks that are timed together, because reading the clock takes as long as a tick of a small body, and runs of them.
/// Few enough that a lane that blows up is still timed before it does.
const TICKS: u32 = 64;
const RUNS: u32 = 8;

/// Lanes to time, with the tick, the time and the length of a tick in seconds at which they stand.
struct Lanes {
    lanes: Vec<(LaneSpec, Lane)>,
    start: (u64, f64, f64),
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
    pub(super) fn ask(&mut self, lab: &Lab, now: Instant) {
        let is_due = self.last.is_none_or(|last| now.duration_since(last) >= PERIOD);
        if lab.display().instrument != Instrument::Cost || !is_due {
            return;
        }
        self.last = Some(now);
        let race = lab.race();
        let entrants = race.entrants().iter();
        let lanes = entrants.map(|lane| (lab.entries()[lane.entry], lane.lane.clone())).collect();
        let start = (race.tick(), race.t(), 1.0 / f64::from(race.tick_hz()));
        // If the thread has ended, nothing more is measured; the window stays open.
        _ = self.lanes.send(Lanes { lanes, start });
    }
}

fn timed(Lanes { lanes, start }: &Lanes) -> Vec<(LaneSpec, Option<f64>)> {
    let begin = Instant::now();
    let clock = || u64::try_from(begin.elapsed().as_nanos()).unwrap_or(u64::MAX);
    let time = |lane: &Lane| lane.ns_per_tick(*start, TICKS, RUNS, clock);
    lanes.iter().map(|(spec, lane)| (*spec, time(lane))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Command, Scene};

    #[test]
    fn every_lane_of_a_race_takes_some_time() {
        let mut lab = Lab::new(Scene::built_in("harbour").unwrap());
        lab.apply(Command::ToggleRace);
        let lanes = lab.race().entrants().iter();
        let lanes = lanes.map(|lane| (lab.entries()[lane.entry], lane.lane.clone())).collect();
        let timed = timed(&Lanes { lanes, start: (0, 0.0, 1.0 / 60.0) });
        assert_eq!(timed.len(), 5);
        for (spec, ns) in timed {
            assert!(ns.is_some_and(|ns| ns > 1.0 && ns < 1e8), "{}: {ns:?} ns", spec.method.id);
        }
    }
}
