//! A recording to compare with the run. It is a run of its own beside the person's run, and the stage shows it as a
//! ghost at the same moment.

use crate::run::diff::Difference;
use crate::run::race::{Interpolation, LaneBody, Mode, Race};
use crate::run::trace::last_tick;
use crate::run::{Run, StartSettings};
use crate::scene::{LaneSpec, Scene};
use crate::sim::number::{counted, significant};

/// Maximum number of ticks by which a run beside the person's advances at a time. It is an hour at 60 Hz, which takes
/// about a second to compute.
pub(super) const MAX_TICKS: u64 = 60 * 3600;

/// Largest distance that is described in ulps. A larger one is described as a number.
const FEW_ULPS: u64 = 1000;

/// Rounding error of a tick's time, in seconds.
const ROUNDING_S: f64 = 1e-9;

/// A recording that differs from the run beside it.
pub struct Compared {
    name: String,
    tick: u64,
    lines: [String; 2],
    run: Run,
    /// The displayed moment (s) to which the recording was moved.
    at_s: f64,
}

impl Compared {
    /// Creates the comparison of `own` with the recording of this name, at the recording's start. `first` is their
    /// first difference by ticks. Returns `None` if nothing differs. Ticks of different rates are different moments, so
    /// another tick rate precedes all differences after it.
    pub(super) fn new(
        name: &str,
        recording: Scene,
        first: Option<&Difference>,
        own: &Run,
    ) -> Option<Self> {
        let end = last_tick(&recording).min(own.end());
        let mut start = StartSettings::of(recording);
        start.mode = Mode::opening(&start.scene);
        let run = Run::starting_with(start);
        let other_rate = own.times().first_other_rate(&run.times());
        let other_rate = other_rate
            .filter(|(tick, _)| *tick < end && first.is_none_or(|first| first.tick > *tick));
        let (tick, lines) = match (other_rate, first) {
            (Some((tick, [here, there])), _) => {
                let from = match tick {
                    0 => String::new(),
                    _ => format!(" from {:.3} s on", own.times().t(tick)),
                };
                let rates = format!("other tick rate{from}: {there} Hz there, {here} Hz here");
                (tick, [rates, "both are shown at the same moment".into()])
            }
            (None, Some(first)) => (first.tick, lines(first, own)),
            (None, None) => return None,
        };
        Some(Self { name: name.to_owned(), tick, lines, run, at_s: 0.0 })
    }

    /// Returns the name of the recording.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the tick of the first difference.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// Describes the moment and the place of the first difference, and its size, on one line each. If the tick rates
    /// differ first, describes these.
    pub fn lines(&self) -> [String; 2] {
        self.lines.clone()
    }

    /// Returns the recording's body with this index, and its coordinates at the displayed moment of the run. The lane
    /// is the one with the method of `lane`, or else the first. Returns `None` if the body has halted, or if its kind
    /// differs from that in `scene`.
    pub fn body(
        &self,
        scene: &Scene,
        lane: &LaneSpec,
        index: usize,
    ) -> Option<(&LaneBody, Vec<f64>)> {
        let own = self.run.session().scene().bodies.get(index)?;
        let race = self.run.race();
        let alike = race.entrants().iter().find(|other| other.spec.method == lane.method);
        let body = alike.unwrap_or(&race.entrants()[0]).lane.bodies().get(index)?;
        if own.kind.id != scene.bodies[index].kind.id || body.halted().is_some() {
            return None;
        }
        Some((body, placed_at(race, body, self.at_s)))
    }

    /// Moves the recording to its first tick at or after the moment `at_s` (s) that the run displays, forward by at
    /// most an hour of ticks.
    pub(super) fn go_to(&mut self, at_s: f64) {
        let tick = (self.run.times().tick_at(at_s) - ROUNDING_S).ceil().max(0.0) as u64;
        self.at_s = at_s;
        self.run.seek(tick);
        let ahead = tick.saturating_sub(self.run.race().tick()).min(MAX_TICKS);
        (0..ahead).for_each(|_| self.run.tick(&mut ()));
    }
}

/// Returns the coordinates of a race's body at the moment `at_s` (s), which is within its last tick.
pub(super) fn placed_at(race: &Race, body: &LaneBody, at_s: f64) -> Vec<f64> {
    let h = race.last_step_s();
    let before_s = race.t() - at_s;
    match (ROUNDING_S..h).contains(&before_s) {
        true => Interpolation::Monotone.coordinates(body, 1.0 - before_s / h, h),
        false => body.stepper.q().to_vec(),
    }
}

/// Describes the first difference of a recording from `own`, in the words of the bodies.
fn lines(first: &Difference, own: &Run) -> [String; 2] {
    let race = own.race();
    let body = first.cell("body").and_then(|name| {
        let index = own.session().scene().bodies.iter().position(|body| body.name == name)?;
        race.truth().bodies().get(index)
    });
    let column = &*first.column;
    let coordinate = first.cell("coordinate").and_then(|name| {
        let own = body?.coordinates().iter().find(|coordinate| *coordinate.name == *name)?;
        Some(if column == "v" { own.velocity.to_string() } else { own.name.to_string() })
    });
    let is_motion = column == "q" || column == "v";
    let (quantity, unit) = match (body, coordinate) {
        (Some(body), Some(name)) if is_motion => body.quantity(&name),
        _ => (column.replace('_', " "), String::new()),
    };
    // Lane 0 of a trace is the exact solution.
    let lane = first.cell("lane").map(|lane| match lane {
        "0" => "exact solution".into(),
        lane => format!("lane {lane}"),
    });
    let whose = first.cell("body").map(|name| format!("{quantity} of {name}"));
    let place: Vec<String> = [whose.or(Some(quantity)), lane].into_iter().flatten().collect();
    let at_s = own.times().t(first.tick);
    let [there, here] = first.values.each_ref().map(|value| value.as_deref().unwrap_or("absent"));
    let size = match (there.parse::<f64>(), here.parse::<f64>(), first.ulps) {
        (Ok(_), Ok(_), Some(ulps)) if ulps <= FEW_ULPS => format!("{} apart", counted(ulps, "ulp")),
        (Ok(there), Ok(here), _) => {
            let part = first.relative.map(|part| format!(", {} %", significant(100.0 * part, 2)));
            format!(
                "{}{unit} apart{}",
                significant((there - here).abs(), 2),
                part.unwrap_or_default()
            )
        }
        _ => format!("{there} there, {here} here"),
    };
    [format!("differs from {at_s:.3} s on: {}", place.join(", ")), size]
}
