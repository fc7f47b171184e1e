//! All lanes and the truth, tick by tick, in integer time.

use super::command::Command;
use super::history::{CAPACITY, History, Sample};
use super::lane::{Lane, Origin, TakenUp};
use super::scene::{LaneSpec, Scene};
use super::script::Script;
use super::truth_curve::{LastTick, TruthCurve};
use crate::sim::bodies::Input;
use crate::sim::{Solver, Stepper};

/// A lane in a race, with its recent past.
pub struct Entrant {
    /// Its place on the list of methods.
    pub entry: usize,
    /// The lane.
    pub lane: Lane,
    /// One history for each body.
    pub histories: Vec<History>,
}

/// Lanes against the truth. In solo mode there is one.
pub struct Race {
    truth: Lane,
    /// One for each body.
    truth_curves: Vec<TruthCurve>,
    entrants: Vec<Entrant>,
    script: Script,
    throttle: f64,
    rudder: f64,
    tick: u64,
    tick_hz: u32,
    /// The tick and the time (s) at which the present tick rate was set: time is counted from there,
    /// and never summed up.
    origin: (u64, f64),
    /// The length of the last tick, in seconds.
    last_step_s: f64,
    /// Ticks between recorded samples.
    stride: u64,
    /// The stretch of time, in seconds, that histories are to reach back.
    span_s: f64,
}

impl Race {
    /// The race of all the scene's lanes from its start. Each [`step`](Self::step) plays what the scene's script
    /// has for it; a method that the script names is left out, as each lane keeps its own. It is the race that
    /// `regatta capture --race` draws:
    ///
    /// ```
    /// use regatta::lab::{Race, Scene};
    ///
    /// let scene = Scene::built_in("stiff").expect("a built-in scene");
    /// let mut race = Race::of(&scene);
    /// race.run(600);
    /// for (method, hash) in race.hashes_by_method() {
    ///     println!("{method} {hash:016x}");
    /// }
    /// ```
    pub fn of(scene: &Scene) -> Self {
        let mut race = Self::new(scene, scene.lanes.iter().copied().enumerate());
        race.script = Script::new(&scene.script);
        race
    }

    /// The scene at its start, with one lane for each `(entry, spec)`, and without its script.
    pub fn new(scene: &Scene, lanes: impl IntoIterator<Item = (usize, LaneSpec)>) -> Self {
        let entrants = lanes.into_iter().map(|(entry, spec)| Entrant {
            entry,
            lane: Lane::new(scene, spec.solver(), spec.substeps),
            histories: scene.bodies.iter().map(|_| History::new()).collect(),
        });
        let truth = Lane::new(scene, Solver::Truth, 1);
        let curve = |body| TruthCurve::new(body, scene.seconds);
        let mut race = Self {
            truth_curves: truth.bodies().iter().map(curve).collect(),
            truth,
            entrants: entrants.collect(),
            script: Script::default(),
            throttle: 1.0,
            rudder: 0.0,
            tick: 0,
            tick_hz: scene.tick_hz,
            origin: (0, 0.0),
            last_step_s: 0.0,
            stride: 1,
            span_s: scene.seconds,
        };
        race.set_stride();
        race
    }

    /// The tick reached.
    pub fn tick(&self) -> u64 {
        self.tick
    }
    /// The tick rate in Hz.
    pub fn tick_hz(&self) -> u32 {
        self.tick_hz
    }
    /// The time reached, in seconds.
    pub fn t(&self) -> f64 {
        self.origin.1 + (self.tick - self.origin.0) as f64 / f64::from(self.tick_hz)
    }
    /// The length of the last tick in seconds, at whatever rate it was; 0 at the start.
    pub fn last_step_s(&self) -> f64 {
        self.last_step_s
    }
    /// The throttle, -1 to 1.
    pub fn throttle(&self) -> f64 {
        self.throttle
    }
    /// The rudder, from -1, hard right, to 1, hard left.
    pub fn rudder(&self) -> f64 {
        self.rudder
    }
    /// The truth: the exact solution, or a reference where a body has no closed form.
    pub fn truth(&self) -> &Lane {
        &self.truth
    }
    /// The recent past of the truth, one curve for each body.
    pub fn truth_curves(&self) -> &[TruthCurve] {
        &self.truth_curves
    }
    /// The true coordinates and velocities of the body at this place of the scene, at the part `part`, 0
    /// to 1, of the last tick.
    pub fn truth_between(&self, body: usize, part: f64) -> (Vec<f64>, Vec<f64>) {
        self.truth_curves[body].state(&self.truth.bodies()[body], self.last_tick(), part)
    }
    /// The lanes, in list order.
    pub fn entrants(&self) -> &[Entrant] {
        &self.entrants
    }

    /// Keeps only the lane that flies the method on this place of the list.
    pub(super) fn keep_only(&mut self, entry: usize) {
        self.entrants.retain(|entrant| entrant.entry == entry);
    }

    /// Changes the tick rate from here on. Methods begin anew, from the states as they are; to set the rate
    /// that is set already changes nothing.
    pub fn set_tick_hz(&mut self, tick_hz: u32) {
        if tick_hz == self.tick_hz {
            return;
        }
        self.origin = (self.tick, self.t());
        self.tick_hz = tick_hz;
        self.set_stride();
        for entrant in &mut self.entrants {
            entrant.lane.reset();
        }
    }

    fn set_stride(&mut self) {
        let samples = self.span_s * f64::from(self.tick_hz);
        self.stride = ((samples / CAPACITY as f64).ceil() as u64).max(1);
    }

    /// Plays what the script has for this tick, and steps every lane and the truth by it. Never allocates.
    pub fn step(&mut self) {
        while let Some(command) = self.script.due(self.tick) {
            self.act(command);
        }
        let (t, h) = (self.t(), 1.0 / f64::from(self.tick_hz));
        self.truth.tick(self.tick, t, h);
        for entrant in &mut self.entrants {
            entrant.lane.tick(self.tick, t, h);
        }
        self.tick += 1;
        self.last_step_s = h;
    }

    /// Steps so many ticks.
    pub fn run(&mut self, ticks: u64) {
        (0..ticks).for_each(|_| self.step());
    }

    fn last_tick(&self) -> LastTick {
        let to_s = self.t();
        LastTick { from_s: to_s - self.last_step_s, to_s }
    }

    /// Adds the last tick to the curves of the truth, and the present to the histories if it is time for a
    /// sample. Never allocates.
    pub fn record(&mut self) {
        let tick = self.last_tick();
        for (body, curve) in self.truth.bodies().iter().zip(&mut self.truth_curves) {
            if body.halted().is_none() {
                curve.extend(body, tick);
            }
        }
        if self.tick.is_multiple_of(self.stride) {
            self.each_present(History::record);
        }
    }

    /// Adds the present to the histories until the next sample comes, so that what is drawn from them reaches
    /// the present. Never allocates.
    pub(super) fn record_present(&mut self) {
        self.each_present(History::record_passing);
    }

    fn each_present(&mut self, add: fn(&mut History, Sample)) {
        let t = self.t();
        for Entrant { entry, lane, histories } in &mut self.entrants {
            let bodies = lane.bodies().iter().zip(self.truth.bodies()).zip(histories);
            for ((body, truth), history) in bodies.filter(|((b, _), _)| b.halted().is_none()) {
                add(history, Sample::new(t, *entry, body, truth));
            }
        }
    }

    /// Does what a command does to the bodies, at the present tick; nothing, where it is about something else.
    pub fn act(&mut self, command: Command) {
        match command {
            Command::ThrottleUp => self.input(Input::Throttle(tenths(self.throttle, 1.0))),
            Command::ThrottleDown => self.input(Input::Throttle(tenths(self.throttle, -1.0))),
            Command::RudderLeft => self.input(Input::Rudder(tenths(self.rudder, 1.0))),
            Command::RudderRight => self.input(Input::Rudder(tenths(self.rudder, -1.0))),
            Command::TickHz(tick_hz) => self.set_tick_hz(tick_hz),
            command => command.input().into_iter().for_each(|input| self.input(input)),
        }
    }

    /// Gives an input to every lane and the truth, at the present tick; throttle and rudder are brought into -1
    /// to 1. What is set to what it is, and a kick of nothing, changes nothing.
    pub fn input(&mut self, input: Input) {
        let set = |present: &mut f64, part: f64| std::mem::replace(present, part) != part;
        let (input, changes) = match input {
            Input::Throttle(part) => {
                let part = part.clamp(-1.0, 1.0);
                (Input::Throttle(part), set(&mut self.throttle, part))
            }
            Input::Rudder(part) => {
                let part = part.clamp(-1.0, 1.0);
                (Input::Rudder(part), set(&mut self.rudder, part))
            }
            Input::Kick(times) => (input, times != 0.0),
        };
        if changes {
            let t = self.t();
            self.keep_corner(t);
            self.truth.input(self.tick, t, input);
            self.keep_corner(t);
            self.truth_curves.iter_mut().for_each(|curve| curve.bend(input));
            for entrant in &mut self.entrants {
                entrant.lane.input(self.tick, t, input);
            }
        }
    }

    fn keep_corner(&mut self, t: f64) {
        for (body, curve) in self.truth.bodies().iter().zip(&mut self.truth_curves) {
            curve.keep(t, body);
        }
    }

    /// Switches the lane at `index` to another method, its state carried exactly, but of a body that had halted:
    /// that is taken up again from the truth, and returned. To switch a method to itself changes nothing.
    pub fn switch(&mut self, index: usize, entry: usize, spec: LaneSpec) -> Vec<TakenUp> {
        let (t, truth) = (self.t(), &self.truth);
        let entrant = &mut self.entrants[index];
        let left = std::mem::replace(&mut entrant.entry, entry);
        let Entrant { lane, histories, .. } = entrant;
        if (lane.solver(), lane.substeps()) == (spec.solver(), spec.substeps) {
            return Vec::new();
        }
        for ((body, truth), history) in
            lane.bodies().iter().zip(truth.bodies()).zip(&mut *histories)
        {
            if body.halted().is_none() {
                history.end_run(Sample::new(t, left, body, truth));
            }
        }
        let taken_up = lane.switch(spec.solver(), spec.substeps, t, truth);
        for TakenUp { halt, from } in &taken_up {
            if *from == Origin::Truth {
                histories[halt.body].break_off(t);
            }
        }
        for ((body, truth), history) in lane.bodies().iter().zip(truth.bodies()).zip(histories) {
            history.begin_run(Sample::new(t, entry, body, truth));
        }
        taken_up
    }

    /// A hash of the tick and of every lane's state to the bit, the truth left out: equal for equal
    /// physics on every platform and in every build. It is 64-bit FNV-1a over little-endian words, with
    /// -0 as 0.
    pub fn state_hash(&self) -> u64 {
        let mut hash = Fnv::new();
        hash.word(self.tick);
        self.entrants.iter().for_each(|entrant| hash.lane(&entrant.lane));
        hash.0
    }

    /// [`Race::state_hash`] as it would be for a race of this lane alone, for each lane.
    pub fn lane_hashes(&self) -> impl Iterator<Item = u64> {
        self.entrants.iter().map(|entrant| {
            let mut hash = Fnv::new();
            hash.word(self.tick);
            hash.lane(&entrant.lane);
            hash.0
        })
    }

    /// [`Race::lane_hashes`] with the id of each lane's method, in list order.
    pub fn hashes_by_method(&self) -> impl Iterator<Item = (&'static str, u64)> {
        let methods = self.entrants.iter().map(|entrant| {
            let method = entrant.lane.solver().method();
            method.expect("lanes are under methods, and only the truth is under none").id
        });
        methods.zip(self.lane_hashes())
    }
}

/// `part` and so many tenths more, in whole tenths, so that ten steps up and down end where they began.
fn tenths(part: f64, more: f64) -> f64 {
    ((part * 10.0).round() + more) / 10.0
}

struct Fnv(u64);

impl Fnv {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn lane(&mut self, lane: &Lane) {
        self.word(u64::from(lane.substeps()));
        if lane.halted().is_none() {
            self.word(u64::MAX);
        }
        for halt in lane.halts() {
            self.word(halt.tick);
            // Where there is one body, it is that one.
            if lane.bodies().len() > 1 {
                self.word(halt.body as u64);
            }
        }
        for body in lane.bodies() {
            let stepper: &dyn Stepper = &*body.stepper;
            for &value in stepper.q().iter().chain(stepper.v()) {
                self.word(if value == 0.0 { 0 } else { value.to_bits() });
            }
        }
    }

    fn word(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::integrators::method;

    fn race(seconds: f64, tick_hz: u32) -> Race {
        let scene = Scene { seconds, tick_hz, ..Scene::built_in("spring").unwrap() };
        Race::new(&scene, [(0, LaneSpec::plain(method("rk4").unwrap()))])
    }

    #[test]
    fn time_is_counted_from_the_last_of_several_changes_of_rate() {
        let mut race = race(20.0, 60);
        let mut t = 0.0;
        for (tick_hz, ticks) in [(60, 11), (49, 7), (120, 5), (1, 3), (1000, 1)] {
            race.set_tick_hz(tick_hz);
            for tick in 1..=ticks {
                race.step();
                let now = t + f64::from(tick) / f64::from(tick_hz);
                assert!((race.t() - now).abs() < 1e-14, "{tick_hz} Hz: {} s, not {now}", race.t());
            }
            assert_eq!(race.last_step_s(), 1.0 / f64::from(tick_hz));
            t = race.t();
        }
        assert_eq!(race.tick(), 27);
        // The truth is where the time is, whatever the rates were.
        let swing = libm::cos(std::f64::consts::TAU * race.t());
        let truth = race.truth().bodies()[0].stepper.q()[0];
        assert!((truth - swing).abs() < 1e-11, "{truth}, {swing}");
    }

    /// Runs the race through so many seconds, and returns the times of the samples.
    fn sampled(race: &mut Race, seconds: f64) -> Vec<f64> {
        race.record();
        let end = race.t() + seconds - 1e-9;
        while race.t() < end {
            race.step();
            race.record();
        }
        race.entrants()[0].histories[0].samples().map(|sample| sample.t).collect()
    }

    #[test]
    fn histories_reach_over_the_scene_with_no_fewer_samples_than_they_must() {
        // Just as many ticks as there is room for, and one more.
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
        race.set_tick_hz(1000);
        let times = sampled(&mut race, 10.0);
        // 20 s at 1000 Hz are ten times the room.
        assert!((times[times.len() - 1] - times[times.len() - 2] - 0.01).abs() < 1e-9);
        assert!(times[0] == 0.0 && (times[times.len() - 1] - 20.0).abs() < 1e-9);
    }
}
