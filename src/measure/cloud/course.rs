//! A batch that steps through the ticks of a run, and back by means of stored states.

use super::lozenges::Lozenges;
use super::{CloudBody, NoCloud};
use crate::sim::batch::{Batch, InstructionSet, NewBatch, Ticks};
use crate::sim::{Solver, State};

/// Initial number of ticks between two stored states. Repeating these ticks takes a frame or two.
const SPACING: u64 = 32;

/// Memory limit for the stored states of a course, in bytes.
const KEPT_BYTES: usize = 12 << 20;

/// A method's memory across steps, and how a course stores it.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Memory {
    /// The method has no memory, and continues from a stored state as if it had never stopped.
    Absent,
    /// The method's memory is dropped at each point where a state may be stored.
    Dropped,
    /// The method's memory cannot be dropped, so that rewinding replays the course from the start.
    Carried,
}

/// The body from which a cloud is made.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    name: &'a str,
    /// Makes copies of the body with these starts; `None` if that is not possible.
    copies: &'a dyn Fn(Solver, Vec<State<f64>>) -> Option<NewBatch>,
}

impl<'a> Subject<'a> {
    pub(super) fn new(
        name: &'a str,
        copies: &'a dyn Fn(Solver, Vec<State<f64>>) -> Option<NewBatch>,
    ) -> Self {
        Self { name, copies }
    }
}

/// Returns a function that copies a body of a scene.
pub(super) fn copies_of(
    CloudBody { kind, body, .. }: CloudBody<'_>,
) -> impl Fn(Solver, Vec<State<f64>>) -> Option<NewBatch> + '_ {
    |solver, starts| (kind.batch)(body.body(), InstructionSet::widest(), solver, starts)
}

/// Stored states of all copies at a tick.
struct StoredState {
    tick: u64,
    q: Vec<f64>,
    v: Vec<f64>,
    /// Factors of the lozenges, if there are any.
    factors: Vec<f64>,
}

/// A batch at a tick of a run.
pub(super) struct Course {
    batch: Batch,
    /// The ticks of the last step.
    ticks: Ticks,
    memory: Memory,
    /// Stored states by tick, with the start first; empty if the course never goes back.
    kept: Vec<StoredState>,
    spacing: u64,
    /// The small areas, if the copies are the corners of such areas.
    lozenges: Option<Lozenges>,
}

impl Course {
    /// Copies the subject to the starts if there is memory for the copies. `ticks` is empty, at the start of the run.
    pub(super) fn new(
        subject: Subject<'_>,
        (solver, memory): (Solver, Memory),
        ticks: Ticks,
        points: usize,
        starts: impl FnOnce() -> Vec<State<f64>>,
    ) -> Result<Self, NoCloud> {
        let too_many = |_| NoCloud::TooMany { points };
        Batch::find_room(points, [solver]).map_err(too_many)?;
        let batch = (subject.copies)(solver, starts());
        let batch = batch.ok_or_else(|| NoCloud::Custom { body: subject.name.into() })?;
        let batch = batch.map_err(too_many)?;
        Ok(Self { batch, ticks, memory, kept: Vec::new(), spacing: SPACING, lozenges: None })
    }

    /// Returns the same course, which from now on stores states so that it can go back.
    pub(super) fn rewindable(mut self) -> Self {
        self.store_state();
        self
    }

    /// Returns the same course, with copies that are the corners of lozenges.
    pub(super) fn around(self, lozenges: Lozenges) -> Self {
        Self { lozenges: Some(lozenges), ..self }
    }

    /// Returns the area of each lozenge relative to the start; `None` if the lozenge is lost.
    pub(super) fn areas(&self) -> Vec<Option<f64>> {
        let areas = |lozenges: &Lozenges| lozenges.areas(self.tick(), self.q(), self.v());
        self.lozenges.as_ref().map_or(Vec::new(), areas)
    }

    pub(super) fn q(&self) -> &[f64] {
        self.batch.q()
    }

    pub(super) fn v(&self) -> &[f64] {
        self.batch.v()
    }

    pub(super) fn tick(&self) -> u64 {
        self.ticks.first + self.ticks.count
    }

    /// Returns the time of the current tick, in seconds.
    pub(super) fn t(&self) -> f64 {
        self.ticks.t(self.tick())
    }

    /// Steps to a tick. The tick may be an earlier one only if the course is [rewindable](Self::rewindable).
    pub(super) fn go_to(&mut self, tick: u64) {
        if tick < self.tick() {
            self.rewind_to(tick);
        }
        while self.tick() < tick {
            let mark = (self.tick() / SPACING + 1) * SPACING;
            let renewal = self.lozenges.as_ref().map_or(mark, |it| it.renewal_after(self.tick()));
            self.ticks = self.ticks.next(mark.min(renewal).min(tick) - self.tick());
            self.batch.run(self.ticks);
            if self.tick() == renewal
                && let Some(lozenges) = &mut self.lozenges
            {
                let [q, v] = lozenges.renew(self.batch.q(), self.batch.v());
                place(&mut self.batch, &q, &v);
            }
            if self.tick() == mark {
                self.store_if_due();
            }
        }
    }

    /// Returns to the last stored state at or before a tick.
    fn rewind_to(&mut self, tick: u64) {
        let nearest = self.kept.iter().rfind(|kept| kept.tick <= tick);
        let StoredState { tick, q, v, factors } =
            nearest.expect("a course that goes back has kept its start");
        place(&mut self.batch, q, v);
        if let Some(lozenges) = &mut self.lozenges {
            lozenges.factors.clone_from(factors);
        }
        self.ticks = Ticks { first: *tick, count: 0, ..self.ticks };
    }

    /// Drops the method's memory if necessary, and stores the state if it is due. This is called wherever a state may
    /// be stored.
    fn store_if_due(&mut self) {
        if self.memory == Memory::Dropped {
            self.batch.change(|_, _| ());
        }
        let is_new = self.kept.last().is_some_and(|last| last.tick < self.tick());
        if is_new && self.memory != Memory::Carried && self.tick().is_multiple_of(self.spacing) {
            self.store_state();
        }
        let bytes = size_of_val(self.q()) * 2;
        if self.kept.len() > 2 && self.kept.len() * bytes > KEPT_BYTES {
            self.spacing *= 2;
            self.kept.retain(|kept| kept.tick.is_multiple_of(self.spacing));
        }
    }

    fn store_state(&mut self) {
        let [q, v] = [self.q(), self.v()].map(<[f64]>::to_vec);
        let factors = self.lozenges.as_ref().map_or(Vec::new(), |it| it.factors.clone());
        self.kept.push(StoredState { tick: self.tick(), q, v, factors });
    }
}

/// Sets the states of all copies. The copies that fill the last block repeat the last state.
fn place(batch: &mut Batch, q: &[f64], v: &[f64]) {
    let mut states = q.iter().zip(v);
    let mut last = (f64::NAN, f64::NAN);
    batch.change(|q, v| {
        last = states.next().map_or(last, |(q, v)| (*q, *v));
        (*q, *v) = last;
    });
}
