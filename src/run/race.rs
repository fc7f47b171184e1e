//! All lanes and the truth, stepped tick by tick in integer time, and the actions on them.
//!
//! A [`Race`] ticks its [`Entrant`]s and performs the actions of its [`Journal`], and notifies an [`Observer`] of
//! both. A [`Lane`] is one method on its own copy of the scene's bodies. A [`Ticker`] ticks a single lane outside a
//! run. An [`Interpolation`] draws a body between two ticks.

use std::sync::Arc;

use crate::scene::custom::{self, Options};
use crate::scene::{LaneId, LaneSpec, Piece, Scene, Scripted};
use crate::sim::Fnv;
use crate::sim::{Solver, State, Stepper, System, TickRate, Vector};

pub use crate::scene::TimeScale;
pub use chase::Chase;
pub use equal_cost::{equal_cost, lanes_that_race};
pub use extent::Extent;
pub use interpolation::Interpolation;
pub use interpolation::{hermite, slope};
pub use intervention::Interventions;
pub(crate) use journal::JournalTail;
pub use journal::{Author, Journal, JournalRow};
pub use lane::advance_checked;
pub use lane::{ESCAPE, Halt, Lane, LaneBody, Resumed, ResumedFrom};
pub use ticker::{StopReason, Ticked, Ticker};

mod acting;
mod chase;
mod equal_cost;
mod extent;
mod interpolation;
mod intervention;
mod journal;
mod lane;
mod observer;
mod run_start;
mod ticker;

pub use observer::{Observer, PerformedAction, Switch};
pub use run_start::Checkpoints;

/// Whether one method runs at a time, or all of them at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// One lane, whose method can be switched in flight.
    Solo,
    /// A lane for every method that the scene lists, and one for the method last used solo.
    Race,
}

impl Mode {
    /// Returns the mode in which a scene opens.
    pub fn opening(scene: &Scene) -> Self {
        if scene.opens_as_race { Mode::Race } else { Mode::Solo }
    }
}

/// The last tick of a race.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LastTick {
    /// Time (s) at which the tick began.
    pub(crate) from_s: f64,
    /// Time (s) at which the tick ended.
    pub(crate) to_s: f64,
}

/// A lane in a race, with its identity and its method.
#[derive(Clone)]
pub struct Entrant {
    /// Number of the lane, fixed at the race's start.
    pub id: LaneId,
    /// Method, substeps and tolerance of the lane.
    pub spec: LaneSpec,
    /// The lane with its bodies.
    pub lane: Lane,
}

/// Lanes against the truth; in solo mode, only one lane.
#[derive(Clone)]
pub struct Race {
    mode: Mode,
    truth: Lane,
    entrants: Vec<Entrant>,
    /// Lane settings for actions that name only a method.
    methods: Arc<[LaneSpec]>,
    /// Present parameters of each body.
    values: Vec<Vec<f64>>,
    throttle: f64,
    rudder: f64,
    tick: u64,
    /// Ticks since the last change of the tick rate. Time counts from that change, and is never a running sum.
    piece: Piece,
    /// Length of the last tick (s).
    last_step_s: f64,
    journal: Journal,
    /// Number of journal rows already performed.
    done: usize,
}

impl Race {
    /// Creates the race of a body that moves as `system` does, from `start`. It has the truth, and a lane for each
    /// method in the options.
    ///
    /// ```
    /// use regatta_run::Race;
    /// use regatta_scene::Options;
    /// use regatta_sim::prelude::*;
    ///
    /// #[derive(Clone)]
    /// struct Spring;
    ///
    /// impl System for Spring {
    ///     type Vector = f64;
    ///     fn acceleration(&self, _t: f64, q: &f64, _v: &f64, a: &mut f64) {
    ///         *a = -40.0 * q;
    ///     }
    /// }
    ///
    /// let mut race = Race::of(&Spring, State { q: 1.0, v: 0.0 }, Options::default());
    /// race.run(600);
    /// assert!(race.hashes_by_method().any(|(method, _)| method == "rk4"));
    /// ```
    ///
    /// # Panics
    /// If an option is invalid; [`Scene::of`] returns an error instead.
    #[track_caller]
    pub fn of<S>(system: &S, start: State<S::Vector>, options: Options<S>) -> Self
    where
        S: System<Vector: Vector> + Clone + Send + 'static,
    {
        Self::of_scene(&custom::scene(system, start, options))
    }

    /// Returns the tick nearest to `seconds` of simulated time, given the pending changes of the tick rate; the present
    /// tick if that time has passed.
    pub fn nearest_tick(&self, seconds: f64) -> u64 {
        TimeScale::new((self.tick(), self.t()), self.tick_hz(), self.rates_to_come())
            .nearest_tick(seconds)
    }

    /// Creates the race of all the scene's lanes at its start. Each [`step`](Self::step) performs the script's actions
    /// at its tick. Each lane keeps its method, so actions that name a method without a lane have no effect.
    /// `regatta capture --race` draws this race:
    ///
    /// ```
    /// use regatta_run::Race;
    /// use regatta_scene::Scene;
    ///
    /// let scene = Scene::built_in("stiff").expect("a built-in scene");
    /// let mut race = Race::of_scene(&scene);
    /// race.run(600);
    /// for (method, hash) in race.hashes_by_method() {
    ///     println!("{method} {hash:016x}");
    /// }
    /// ```
    pub fn of_scene(scene: &Scene) -> Self {
        let lanes = lanes_that_race(scene);
        Self::new(scene, lanes).with_script(&scene.script)
    }

    /// Returns the same race at its start, with this script at the present tick rate.
    pub fn with_script(self, script: &[Scripted]) -> Self {
        Self { journal: Journal::of_script(script, self.tick_hz()), ..self }
    }

    /// Creates the race of these lanes at the scene's start, without the scene's script.
    pub fn new(scene: &Scene, lanes: impl IntoIterator<Item = LaneSpec>) -> Self {
        Self::with_methods(scene, scene.method_list(), lanes)
    }

    /// Like [`Race::new`], with `methods` as the settings for actions that name only a method.
    pub(crate) fn with_methods(
        scene: &Scene,
        methods: Vec<LaneSpec>,
        lanes: impl IntoIterator<Item = LaneSpec>,
    ) -> Self {
        let entrants = lanes.into_iter().enumerate().map(|(index, spec)| Entrant {
            id: LaneId::of_index(index),
            spec,
            lane: Lane::new(scene, spec.solver(), spec.substeps),
        });
        Self {
            mode: Mode::Race,
            truth: Lane::new(scene, Solver::Truth, 1),
            entrants: entrants.collect(),
            methods: methods.into(),
            values: scene.bodies.iter().map(|body| body.values.clone()).collect(),
            throttle: 1.0,
            rudder: 0.0,
            tick: 0,
            piece: Piece::first(scene.tick_hz),
            last_step_s: 0.0,
            journal: Journal::default(),
            done: 0,
        }
    }

    /// Creates the race of one lane at the scene's start, without the scene's script. `index` is the lane's index in
    /// `methods`, which begin with the scene's lanes.
    pub(crate) fn solo(scene: &Scene, methods: Vec<LaneSpec>, index: usize) -> Self {
        let spec = methods[index];
        let mut race = Self::with_methods(scene, methods, [spec]);
        race.mode = Mode::Solo;
        // The lane keeps the number that it would have in a race.
        if index < scene.lanes.len() {
            race.entrants[0].id = LaneId::of_index(index);
        }
        race
    }

    /// Returns the same race at its start, at this tick rate and without its script.
    pub fn at_rate(self, tick_hz: TickRate) -> Self {
        Self { piece: Piece::first(tick_hz), journal: Journal::default(), ..self }
    }

    /// Whether the run is solo or a race.
    pub fn mode(&self) -> Mode {
        self.mode
    }
    /// Returns the tick reached.
    pub fn tick(&self) -> u64 {
        self.tick
    }
    /// Returns the tick rate in Hz.
    pub fn tick_hz(&self) -> TickRate {
        self.piece.tick_hz
    }
    /// Returns the time reached, in seconds.
    pub fn t(&self) -> f64 {
        self.piece.t(self.tick)
    }
    /// Returns the length of the last tick in seconds, at the rate of that tick; 0 at the start.
    pub fn last_step_s(&self) -> f64 {
        self.last_step_s
    }
    /// Returns the throttle, from -1 to 1.
    pub fn throttle(&self) -> f64 {
        self.throttle
    }
    /// Returns the rudder, from -1 (hard right) to 1 (hard left).
    pub fn rudder(&self) -> f64 {
        self.rudder
    }
    /// Returns the truth, which is the exact solution, or a reference if a body has no closed form.
    pub fn truth(&self) -> &Lane {
        &self.truth
    }
    /// Returns the lanes, in list order.
    pub fn entrants(&self) -> &[Entrant] {
        &self.entrants
    }
    /// Returns the scene's lanes at the start, then all other methods that fit the scene's bodies.
    /// [`Action::Method`](crate::scene::Action::Method) gets the lane's settings from here.
    pub fn methods(&self) -> &[LaneSpec] {
        &self.methods
    }
    /// Returns the present parameters of the body with this index in the scene, in the order of
    /// [`Kind::build`](crate::sim::bodies::Kind::build).
    pub fn values(&self, body: usize) -> &[f64] {
        &self.values[body]
    }
    /// Returns the bodies that halted in the last tick, each with its entrant. The truth's bodies come first, with
    /// `None`.
    pub fn just_halted(&self) -> impl Iterator<Item = (Option<&Entrant>, &Halt)> {
        let lanes = self.entrants.iter().map(|entrant| (Some(entrant), &entrant.lane));
        std::iter::once((None, &self.truth)).chain(lanes).flat_map(|(entrant, lane)| {
            let halts = lane.halts().filter(|halt| halt.tick + 1 == self.tick);
            halts.map(move |halt| (entrant, halt))
        })
    }
    /// Returns the entrant in this lane; `None` if the lane has left the race.
    pub fn entrant(&self, lane: LaneId) -> Option<&Entrant> {
        self.entrants.iter().find(|entrant| entrant.id == lane)
    }
    /// Returns the [hash](Self::lane_hashes) of this lane; `None` if the lane has left the race.
    pub fn lane_hash(&self, lane: LaneId) -> Option<u64> {
        let index = self.entrants.iter().position(|entrant| entrant.id == lane)?;
        self.lane_hashes().nth(index)
    }
    /// Returns the performed and the pending actions.
    pub fn journal(&self) -> &Journal {
        &self.journal
    }
    /// Returns the number of journal rows already performed.
    pub fn done(&self) -> usize {
        self.done
    }

    /// Returns the pending changes of the tick rate, each with its tick.
    pub fn rates_to_come(&self) -> impl Iterator<Item = (u64, TickRate)> {
        let pending = self.journal.rows()[self.done..].iter();
        pending.filter_map(|row| Some((row.tick, row.action.tick_hz()?)))
    }

    /// Replaces the journal. The new journal must begin with the rows that are already performed.
    pub(crate) fn set_journal(&mut self, journal: Journal) {
        self.journal = journal;
    }

    pub(crate) fn last_tick(&self) -> LastTick {
        let to_s = self.t();
        LastTick { from_s: to_s - self.last_step_s, to_s }
    }

    /// Returns an upper limit of the memory in bytes, without the journal and the methods, which copies share.
    pub(crate) fn bytes(&self) -> usize {
        let lanes = self.entrants.iter().map(|entrant| &entrant.lane).chain([&self.truth]);
        let values =
            self.values.iter().map(|values| size_of_val(values) + size_of_val(&values[..]));
        size_of::<Self>()
            + self.entrants.len() * size_of::<Entrant>()
            + values.sum::<usize>()
            + lanes.map(Lane::heap_bytes).sum::<usize>()
    }

    /// Performs the journal's actions at this tick, steps every lane and the truth to the next tick, and notifies the
    /// observer. Allocates for actions only.
    pub fn step(&mut self, observer: &mut dyn Observer) {
        self.catch_up(observer);
        let (t, h) = (self.t(), self.tick_hz().step_s());
        self.truth.tick(self.tick, t, h);
        for entrant in &mut self.entrants {
            entrant.lane.tick(self.tick, t, h);
        }
        self.tick += 1;
        self.last_step_s = h;
        observer.ticked(self);
    }

    /// Makes `ticks` ticks.
    pub fn run(&mut self, ticks: u64) {
        (0..ticks).for_each(|_| self.step(&mut ()));
    }

    /// Returns a hash of the tick and of the state bits in every lane, without the truth. Equal physics has equal
    /// hashes on every platform and in every build. The hash is 64-bit FNV-1a over little-endian words, with -0 as 0.
    pub fn state_hash(&self) -> u64 {
        let mut hash = Fnv::default();
        hash.word(self.tick);
        self.entrants.iter().for_each(|entrant| hash_lane(&mut hash, &entrant.lane));
        hash.0
    }

    /// Returns for each lane the [`Race::state_hash`] of a race of this lane alone.
    pub fn lane_hashes(&self) -> impl Iterator<Item = u64> {
        self.entrants.iter().map(|entrant| {
            let mut hash = Fnv::default();
            hash.word(self.tick);
            hash_lane(&mut hash, &entrant.lane);
            hash.0
        })
    }

    /// Returns [`Race::lane_hashes`] with the id of each lane's method, in list order.
    pub fn hashes_by_method(&self) -> impl Iterator<Item = (&'static str, u64)> {
        let methods = self.entrants.iter().map(|entrant| {
            let method = entrant.lane.solver().method();
            method.expect("lanes are under methods, and only the truth is under none").id
        });
        methods.zip(self.lane_hashes())
    }
}

/// Adds the substeps, the halts and the states of a lane to `hash`.
fn hash_lane(hash: &mut Fnv, lane: &Lane) {
    hash.word(u64::from(lane.substeps()));
    if lane.halted().is_none() {
        hash.word(u64::MAX);
    }
    for halt in lane.halts() {
        hash.word(halt.tick);
        // A single body needs no index.
        if lane.bodies().len() > 1 {
            hash.word(halt.body as u64);
        }
    }
    for body in lane.bodies() {
        let stepper: &dyn Stepper = &*body.stepper;
        stepper.q().iter().chain(stepper.v()).for_each(|&value| hash.number(value));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Action;
    use crate::sim::integrators::method;

    fn race(seconds: f64, tick_hz: u32) -> Race {
        let tick_hz = tick_hz.into();
        let scene = Scene { seconds, tick_hz, ..Scene::built_in("spring").unwrap() };
        Race::new(&scene, [LaneSpec::plain(method("rk4").unwrap())])
    }

    #[test]
    fn time_is_counted_from_the_last_of_several_changes_of_rate() {
        let mut race = race(20.0, 60);
        let mut t = 0.0;
        for (tick_hz, ticks) in [(60_u32, 11), (49, 7), (120, 5), (1, 3), (1000, 1)] {
            race.perform(&Action::TickHz(tick_hz.into()), &mut ());
            for tick in 1..=ticks {
                race.step(&mut ());
                let now = t + f64::from(tick) / f64::from(tick_hz);
                assert!((race.t() - now).abs() < 1e-14, "{tick_hz} Hz: {} s, not {now}", race.t());
            }
            assert_eq!(race.last_step_s(), 1.0 / f64::from(tick_hz));
            t = race.t();
        }
        assert_eq!(race.tick(), 27);
        // The truth matches the time at any sequence of rates.
        let swing = libm::cos(std::f64::consts::TAU * race.t());
        let truth = race.truth().bodies()[0].stepper.q()[0];
        assert!((truth - swing).abs() < 1e-11, "{truth}, {swing}");
    }

    /// Returns a scene at 1 Hz, at 100 Hz from tick 5 on, and at 2 Hz from tick 45 on.
    fn scene_of_three_rates() -> Scene {
        let text = "title = 'x'\ntick_hz = 1\nseconds = 9\n[[spring]]\nmass_kg = 1\n\
                    stiffness_n_per_m = 1\n[[command]]\nat_s = 5\ntick_hz = 100\n\
                    [[command]]\nat_s = 5.4\ntick_hz = 2\n[[command]]\nat_s = 5.9\nkick = 1\n";
        Scene::parse("x.toml", text).unwrap()
    }

    #[test]
    fn seconds_are_counted_across_the_rates_of_a_script() {
        let race = Race::of_scene(&scene_of_three_rates());
        for (seconds, tick) in [
            (0.0, 0),
            (0.4, 0),
            (4.4, 4),
            (4.5, 5),
            (5.0, 5),
            (5.2, 25),
            (5.254, 30),
            (5.4, 45),
            (5.6, 45),
            (5.65, 46),
            (9.4, 53),
        ] {
            assert_eq!(race.nearest_tick(seconds), tick, "{seconds} s");
        }
    }

    #[test]
    fn the_tick_is_the_same_seen_from_any_tick_before_it() {
        let mut race = Race::of_scene(&scene_of_three_rates());
        for tick in 0..60 {
            assert_eq!(race.tick(), tick);
            assert_eq!(race.nearest_tick(9.4), 53.max(tick));
            assert_eq!(race.nearest_tick(race.t()), tick);
            race.step(&mut ());
        }
    }
}
