//! The recorded past of a race for drawing, which has recent samples of every body in every lane, and the truth as a
//! curve.
//!
//! The past follows a race without being part of it, so that a copy of the race has no past. A race that returns to an
//! earlier tick shows the same past as it did at that time. Samples name a lane's method by its index on the [`Menu`].

use super::Menu;
use super::race::{Entrant, PerformedAction, Race, Resumed, ResumedFrom, Switch};
use crate::scene::{Action, LaneId};
use crate::sim::bodies::Coordinate;
use history::HistoryMark;

mod history;
mod quantity;
mod sample;
mod truth_curve;
mod windowed_log;

pub use history::{History, Peaks, Samples};
pub use quantity::Quantity;
pub use sample::{CAPACITY, Energies, Sample, Summary, SweptRange};
use truth_curve::TruthMark;
pub use truth_curve::{TruthCurve, TruthSample};

/// Share of the displayed duration during which a motion counts as just begun, which is two swings of the harbour's 1
/// Hz spring. Axes that fit only the first samples of a motion would be too narrow.
const BEGUN: f64 = 0.1;

/// Maximum memory of the histories in bytes, which has room for 130 with [`CAPACITY`] samples each. With more lanes and
/// bodies, histories are coarser.
const MAX_BYTES: usize = 64 << 20;

/// Returns the capacity at which this number of histories fits into [`MAX_BYTES`].
fn capacity_of(histories: usize) -> usize {
    // The product needs 64 bits, but `usize` has only 32 in a browser.
    let all = CAPACITY as u64 * (MAX_BYTES / histories.max(1)) as u64;
    CAPACITY.min((all / History::heap_bytes(CAPACITY) as u64) as usize)
}

/// The recent past of a race.
pub struct Past {
    /// One history per body for each lane, in the order of the race.
    histories: Vec<(LaneId, Vec<History>)>,
    /// The curves of the truth, one per body.
    truth_curves: Vec<TruthCurve>,
    /// Duration of the histories in seconds.
    span_s: f64,
    /// Maximum number of samples of a history.
    capacity: usize,
    /// Time (s) of the last placement or parameter change; before the start if there was none.
    changed_s: f64,
    /// Time (s) of the last kick, placement or parameter change.
    swings_since_s: f64,
}

/// The end of the recorded past at some tick, for [rewinding](Past::rewind).
#[derive(Clone, Debug)]
pub(super) struct PastMark {
    /// Marks of the histories, by lane and body.
    histories: Box<[(LaneId, Box<[HistoryMark]>)]>,
    truth_curves: Box<[TruthMark]>,
    changed_s: f64,
    swings_since_s: f64,
}

impl PastMark {
    /// Returns the heap memory in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        let row = |(_, marks): &(LaneId, Box<[HistoryMark]>)| size_of_val(&marks[..]);
        size_of_val(&self.histories[..])
            + self.histories.iter().map(row).sum::<usize>()
            + size_of_val(&self.truth_curves[..])
    }
}

impl Past {
    /// Creates a past of `span_s` seconds that begins at the present of `race`. For each body it records the coordinate
    /// that plots show by default.
    pub(super) fn new(race: &Race, span_s: f64, menu: &Menu) -> Self {
        let bodies = race.truth().bodies().iter();
        Self::of_coordinates(race, span_s, menu, bodies.map(|body| body.plotted_coordinate()))
    }

    /// Like [`Past::new`], with the coordinate to record for each body.
    pub(super) fn of_coordinates(
        race: &Race,
        span_s: f64,
        menu: &Menu,
        coordinates: impl Iterator<Item = usize>,
    ) -> Self {
        let bodies = race.truth().bodies();
        let curves = bodies.iter().zip(coordinates);
        let capacity = capacity_of(race.entrants().len() * bodies.len());
        let histories = || bodies.iter().map(|_| History::new(capacity)).collect();
        let mut past = Self {
            histories: race.entrants().iter().map(|entrant| (entrant.id, histories())).collect(),
            truth_curves: curves.map(|(body, of)| TruthCurve::new(body, of, span_s)).collect(),
            span_s,
            capacity,
            changed_s: f64::NEG_INFINITY,
            swings_since_s: f64::NEG_INFINITY,
        };
        past.sample(race, menu);
        past.note_most(race);
        past
    }

    /// Returns the heap memory in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        let histories: usize = self.histories.iter().map(|(_, histories)| histories.len()).sum();
        histories * History::heap_bytes(self.capacity)
            + self.truth_curves.iter().map(TruthCurve::heap_bytes).sum::<usize>()
    }

    /// Returns the histories of the bodies of a lane in the race.
    ///
    /// # Panics
    /// If the lane is not in the race.
    pub fn histories(&self, lane: LaneId) -> &[History] {
        &self.histories[self.index(lane).expect("it is in the race")].1
    }

    fn index(&self, lane: LaneId) -> Option<usize> {
        self.histories.iter().position(|(id, _)| *id == lane)
    }

    /// Returns the recent past of the truth, one curve for each body.
    pub fn truth_curves(&self) -> &[TruthCurve] {
        &self.truth_curves
    }

    /// Returns the indices of the recorded coordinates, one for each body.
    pub fn coordinates(&self) -> impl Iterator<Item = usize> {
        self.truth_curves.iter().map(TruthCurve::coordinate)
    }

    /// Returns the recorded coordinate of the body with this index in the scene, and the coordinate's index.
    pub fn coordinate(&self, race: &Race, body: usize) -> (Coordinate, usize) {
        let index = self.truth_curves[body].coordinate();
        (race.truth().bodies()[body].coordinates().at(index), index)
    }

    /// Returns the time (s) of the last placement or parameter change; before the start if there was none.
    pub fn changed_s(&self) -> f64 {
        self.changed_s
    }

    /// Returns the time (s) of the last kick or [change](Self::changed_s). Since then, bodies swing as they do now.
    pub fn swings_since_s(&self) -> f64 {
        self.swings_since_s
    }

    /// Returns the start (s) of the samples that show at `t` how far bodies swing. It is the last
    /// [change](Self::changed_s), or before the start while the motion after that change has just begun.
    pub fn swing_since_s(&self, t: f64) -> f64 {
        let has_just_begun = t - self.changed_s < BEGUN * self.span_s;
        if has_just_begun { f64::NEG_INFINITY } else { self.changed_s }
    }

    /// Returns the true coordinates and velocities of the body with this index in the scene, within or beyond the last
    /// tick of `race`. During the tick, `part` runs from 0 to 1.
    pub fn truth_between(&self, race: &Race, body: usize, part: f64) -> (Vec<f64>, Vec<f64>) {
        self.truth_curves[body].state(&race.truth().bodies()[body], race.last_tick(), part)
    }

    /// Shows the present of `race` until the next sample, so that the drawn past ends at the present. Never allocates.
    pub(super) fn show_present(&mut self, race: &Race, menu: &Menu) {
        self.add_samples(race, menu, History::record_passing);
    }

    /// Returns the number of ticks from one sample to the next.
    fn stride(&self, race: &Race) -> u64 {
        let samples = self.span_s * f64::from(race.tick_hz());
        ((samples / self.capacity as f64).ceil() as u64).max(1)
    }

    /// Adds the present to the histories if a sample is due. Otherwise extends the range that belongs to the next
    /// sample.
    fn sample(&mut self, race: &Race, menu: &Menu) {
        if race.tick().is_multiple_of(self.stride(race)) {
            return self.add_samples(race, menu, History::push_present);
        }
        for (entrant, (_, histories)) in race.entrants().iter().zip(&mut self.histories) {
            let curves = histories.iter_mut().zip(&self.truth_curves);
            let bodies = entrant.lane.bodies().iter().zip(curves);
            for (body, (history, curve)) in bodies.filter(|(body, _)| body.halted().is_none()) {
                history.extend_swept(body.stepper.q()[curve.coordinate()]);
            }
        }
    }

    fn add_samples(&mut self, race: &Race, menu: &Menu, add: fn(&mut History, Sample)) {
        let t = race.t();
        for (Entrant { id, lane, .. }, (_, histories)) in
            race.entrants().iter().zip(&mut self.histories)
        {
            let entry = menu.entry(*id);
            let curves = histories.iter_mut().zip(&self.truth_curves);
            let bodies = lane.bodies().iter().zip(race.truth().bodies()).zip(curves);
            for ((body, truth), (history, curve)) in
                bodies.filter(|((b, _), _)| b.halted().is_none())
            {
                add(history, Sample::new(t, entry, curve.coordinate(), [body, truth]));
            }
        }
    }

    fn keep_corner(&mut self, race: &Race) {
        for (body, curve) in race.truth().bodies().iter().zip(&mut self.truth_curves) {
            curve.push_present(race.t(), body);
        }
    }

    /// Drops the histories of lanes that have left the race.
    fn leave_with(&mut self, race: &Race) {
        self.histories.retain(|(lane, _)| race.entrant(*lane).is_some());
    }

    /// Returns a mark of the end of the recorded past.
    pub(super) fn mark(&self) -> PastMark {
        let marks = |(lane, histories): &(LaneId, Vec<History>)| {
            (*lane, histories.iter().map(History::mark).collect())
        };
        PastMark {
            histories: self.histories.iter().map(marks).collect(),
            truth_curves: self.truth_curves.iter().map(TruthCurve::mark).collect(),
            changed_s: self.changed_s,
            swings_since_s: self.swings_since_s,
        }
    }

    /// Whether a repetition from the mark `from` restores the drawn past at `mark`.
    pub(super) fn fills(&self, from: &PastMark, mark: &PastMark) -> bool {
        let histories = mark.histories.iter().all(|(lane, marks)| {
            let begun = from.histories.iter().find(|(other, _)| other == lane);
            let (Some((_, begun)), Some(kept)) = (begun, self.index(*lane)) else { return false };
            let mut bodies = self.histories[kept].1.iter().zip(begun.iter().zip(marks));
            bodies.all(|(history, (&begun, &mark))| history.fills(begun, mark))
        });
        let mut curves =
            self.truth_curves.iter().zip(from.truth_curves.iter().zip(&mark.truth_curves));
        histories && curves.all(|(curve, (&begun, &mark))| curve.fills(begun, mark))
    }

    /// Rewinds to a mark of the present of `race`. The mark may also lie in the recorded future.
    pub(super) fn rewind(&mut self, mark: &PastMark, race: &Race) {
        (self.changed_s, self.swings_since_s) = (mark.changed_s, mark.swings_since_s);
        self.leave_with(race);
        for (lane, marks) in &mark.histories {
            let index = self.index(*lane).unwrap_or_else(|| {
                // A lane that had left the race returns.
                let index = race.entrants().iter().position(|entrant| entrant.id == *lane);
                let index = index.expect("a mark is of the lanes that the race then had");
                let histories = marks.iter().map(|_| History::new(self.capacity));
                self.histories.insert(index, (*lane, histories.collect()));
                index
            });
            for (history, &mark) in self.histories[index].1.iter_mut().zip(marks) {
                history.rewind(mark);
            }
        }
        for (curve, &mark) in self.truth_curves.iter_mut().zip(&mark.truth_curves) {
            curve.rewind(mark);
        }
    }

    /// Drops the recorded future.
    pub(super) fn forget_future(&mut self) {
        let lanes = self.histories.iter_mut().flat_map(|(_, histories)| histories);
        lanes.for_each(History::forget_future);
        self.truth_curves.iter_mut().for_each(TruthCurve::forget_future);
    }

    /// Prepares for an action that is about to change the race.
    pub(super) fn before(&mut self, race: &Race, menu: &Menu, done: &PerformedAction) {
        for (body, curve) in race.truth().bodies().iter().zip(&mut self.truth_curves) {
            curve.refresh(body, race.t());
        }
        match done.action {
            Action::Throttle(_)
            | Action::Rudder(_)
            | Action::Kick(_)
            | Action::Set { .. }
            | Action::Place { .. } => {
                self.keep_corner(race);
            }
            _ => {}
        }
        if let Action::Place { body, .. } = done.action {
            let (t, truth) = (race.t(), &race.truth().bodies()[body]);
            let coordinate = self.truth_curves[body].coordinate();
            for (entrant, (_, histories)) in race.entrants().iter().zip(&mut self.histories) {
                let placed = &entrant.lane.bodies()[body];
                if placed.halted().is_none() {
                    let entry = menu.entry(entrant.id);
                    histories[body].end_run(Sample::new(t, entry, coordinate, [placed, truth]));
                }
            }
        }
        if let Some(Switch { index, lane, .. }) = done.switch {
            let (t, entry) = (race.t(), menu.entry(lane));
            let bodies = race.entrants()[index].lane.bodies().iter();
            let curves = self.histories[index].1.iter_mut().zip(&self.truth_curves);
            for ((body, truth), (history, curve)) in bodies.zip(race.truth().bodies()).zip(curves) {
                if body.halted().is_none() {
                    history.end_run(Sample::new(t, entry, curve.coordinate(), [body, truth]));
                }
            }
        }
    }

    /// Follows an action after it has changed the race and `menu`.
    pub(super) fn after(&mut self, race: &Race, menu: &Menu, done: &PerformedAction) {
        match &done.action {
            Action::Throttle(_) | Action::Rudder(_) | Action::Kick(_) => {
                if let Action::Kick(_) = done.action {
                    self.swings_since_s = race.t();
                }
                self.keep_corner(race);
                let input = done.action.input().expect("it is one");
                self.truth_curves.iter_mut().for_each(|curve| curve.note_input(input));
            }
            Action::Set { .. } => {
                (self.changed_s, self.swings_since_s) = (race.t(), race.t());
                self.keep_corner(race);
                self.truth_curves.iter_mut().for_each(TruthCurve::invalidate_copy);
            }
            Action::Place { body, .. } => {
                (self.changed_s, self.swings_since_s) = (race.t(), race.t());
                let (t, truth) = (race.t(), &race.truth().bodies()[*body]);
                self.truth_curves[*body].jump(t, truth);
                let coordinate = self.truth_curves[*body].coordinate();
                for (entrant, (_, histories)) in race.entrants().iter().zip(&mut self.histories) {
                    let (placed, entry) = (&entrant.lane.bodies()[*body], menu.entry(entrant.id));
                    let sample = Sample::new(t, entry, coordinate, [placed, truth]);
                    histories[*body].jump(sample, Peaks::of(placed, truth));
                }
            }
            Action::Solo { .. } => self.leave_with(race),
            _ => {}
        }
        let Some(Switch { index, lane, .. }) = done.switch else { return };
        let entry = menu.entry(lane);
        let bodies = race.entrants()[index].lane.bodies().iter().zip(race.truth().bodies());
        let curves = self.histories[index].1.iter_mut().zip(&self.truth_curves);
        for ((body, (own, truth)), (history, curve)) in bodies.enumerate().zip(curves) {
            let from_truth = |it: &Resumed| it.halt.body == body && it.from == ResumedFrom::Truth;
            let jumped = done.resumed.iter().any(from_truth);
            let sample = Sample::new(race.t(), entry, curve.coordinate(), [own, truth]);
            history.begin_run(Sample { jumped, ..sample });
        }
    }

    /// Records a completed tick.
    pub(super) fn ticked(&mut self, race: &Race, menu: &Menu) {
        let tick = race.last_tick();
        for (body, curve) in race.truth().bodies().iter().zip(&mut self.truth_curves) {
            if body.halted().is_none() {
                curve.extend(body, tick);
            }
        }
        self.sample(race, menu);
        self.note_most(race);
    }

    /// Updates the largest values of each history with the present.
    fn note_most(&mut self, race: &Race) {
        for (entrant, (_, histories)) in race.entrants().iter().zip(&mut self.histories) {
            let bodies = entrant.lane.bodies().iter().zip(race.truth().bodies()).zip(histories);
            for ((body, truth), history) in bodies.filter(|((b, _), _)| b.halted().is_none()) {
                history.note_peaks(Peaks::of(body, truth));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Observations;
    use crate::scene::{LaneSpec, Scene};
    use crate::sim::integrators::method;

    fn race(seconds: f64, tick_hz: u32) -> (Race, Observations) {
        let tick_hz = tick_hz.into();
        let scene = Scene { seconds, tick_hz, ..Scene::built_in("spring").unwrap() };
        let race = Race::new(&scene, [LaneSpec::plain(method("rk4").unwrap())]);
        let seen = Observations::new(&race, seconds);
        (race, seen)
    }

    /// Runs the race for this duration, and returns the times of the samples.
    fn sampled((race, seen): &mut (Race, Observations), seconds: f64) -> Vec<f64> {
        let end = race.t() + seconds - 1e-9;
        while race.t() < end {
            race.step(seen);
        }
        seen.past().histories(LaneId(1))[0].samples().map(|sample| sample.t).collect()
    }

    #[test]
    fn histories_cover_the_scene_with_enough_samples() {
        // The run has one tick less than the capacity, the same number, and one tick more.
        for (ticks, stride) in
            [(CAPACITY as u32 - 1, 1), (CAPACITY as u32, 1), (CAPACITY as u32 + 1, 2)]
        {
            let times = sampled(&mut race(f64::from(ticks), 1), f64::from(ticks));
            assert_eq!(
                times[times.len() - 1] - times[times.len() - 2],
                f64::from(stride),
                "{ticks}"
            );
            assert!(times[0] <= f64::from(stride), "{ticks} ticks: from {} s on", times[0]);
        }
        let mut race = race(20.0, 10);
        assert_eq!(sampled(&mut race, 10.0).len(), 101);
        race.0.perform(&Action::TickHz(1000.into()), &mut race.1);
        let times = sampled(&mut race, 10.0);
        // 20 s at 1000 Hz are ten times the capacity.
        assert!((times[times.len() - 1] - times[times.len() - 2] - 0.01).abs() < 1e-9);
        assert!(times[0] == 0.0 && (times[times.len() - 1] - 20.0).abs() < 1e-9);
    }

    #[test]
    fn many_histories_thin_their_samples_and_fit_into_the_memory() {
        for (histories, is_full) in [(1, true), (32, true), (80, true), (160, false), (2048, false)]
        {
            let capacity = capacity_of(histories);
            assert_eq!(capacity == CAPACITY, is_full, "{histories}");
            let bytes = histories * History::heap_bytes(capacity);
            assert!(bytes <= MAX_BYTES + histories * History::heap_bytes(1), "{bytes} bytes");
            assert!(is_full || bytes > MAX_BYTES * 9 / 10, "{bytes} bytes");
        }
        let spring =
            |n: usize| format!("[[spring]]\nname = 'b{n}'\nmass_kg = 1\nstiffness_n_per_m = 9\n");
        let head = "title = 't'\ntick_hz = 60\nseconds = 20\nmethods = ['rk4']\n".to_owned();
        let text = (0..64).fold(head, |text, n| text + &spring(n));
        let scene = Scene::parse("t", &text).unwrap();
        let rk4 = LaneSpec::plain(method("rk4").unwrap());
        let race = Race::new(&scene, [rk4; 32]);
        let past = Past::new(&race, scene.seconds, &Menu::new(&race));
        assert_eq!(past.capacity, capacity_of(2048));
        assert_eq!(past.stride(&race), (1200.0 / past.capacity as f64).ceil() as u64);
    }
}
