//! All lanes and the truth, tick by tick, in integer time.

use super::history::{CAPACITY, History};
use super::lane::Lane;
use super::scene::{LaneSpec, Scene};
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
    /// The scene at its start, with one lane for each `(entry, spec)`.
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

    /// Steps every lane and the truth by one tick. Never allocates.
    pub fn step(&mut self) {
        let (t, h) = (self.t(), 1.0 / f64::from(self.tick_hz));
        self.truth.tick(self.tick, t, h);
        for entrant in &mut self.entrants {
            entrant.lane.tick(self.tick, t, h);
        }
        self.tick += 1;
        self.last_step_s = h;
    }

    fn last_tick(&self) -> LastTick {
        let to_s = self.t();
        LastTick { from_s: to_s - self.last_step_s, to_s }
    }

    /// Adds the last tick to the curves of the truth, and the present to the histories if it is time for a
    /// sample. Never allocates.
    pub fn record(&mut self) {
        if self.truth.halted().is_none() {
            let tick = self.last_tick();
            for (body, curve) in self.truth.bodies().iter().zip(&mut self.truth_curves) {
                curve.extend(body, tick);
            }
        }
        if self.tick.is_multiple_of(self.stride) {
            let t = self.t();
            for Entrant { entry, lane, histories } in &mut self.entrants {
                if lane.halted().is_some() {
                    continue;
                }
                let bodies = lane.bodies().iter().zip(self.truth.bodies()).zip(histories);
                for ((body, truth), history) in bodies {
                    history.record(t, *entry, body, truth);
                }
            }
        }
    }

    /// Gives an input to every lane and the truth, at the present tick.
    pub fn input(&mut self, input: Input) {
        let t = self.t();
        self.keep_corner(t);
        self.truth.input(t, input);
        self.keep_corner(t);
        self.truth_curves.iter_mut().for_each(|curve| curve.bend(input));
        for entrant in &mut self.entrants {
            entrant.lane.input(t, input);
        }
    }

    fn keep_corner(&mut self, t: f64) {
        for (body, curve) in self.truth.bodies().iter().zip(&mut self.truth_curves) {
            curve.keep(t, body);
        }
    }

    /// Switches the lane at `index` to another method, its state carried exactly.
    pub fn switch(&mut self, index: usize, entry: usize, spec: LaneSpec) {
        let t = self.t();
        let entrant = &mut self.entrants[index];
        entrant.entry = entry;
        entrant.lane.switch(spec.solver(), spec.substeps, t);
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
}

struct Fnv(u64);

impl Fnv {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn lane(&mut self, lane: &Lane) {
        self.word(u64::from(lane.substeps()));
        self.word(lane.halted().map_or(u64::MAX, |halt| halt.tick));
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
