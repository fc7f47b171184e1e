//! A batch on its way through the ticks of a run. It goes back too, from states that it keeps.

use super::lozenges::Lozenges;
use super::{CloudBody, NoCloud};
use crate::sim::batch::{Batch, InstructionSet, NewBatch, Ticks};
use crate::sim::{Solver, State};

/// Ticks between two states that are kept at first; they are repeated within a frame or two.
const SPACING: u64 = 32;

/// The memory of the states that a course keeps, in bytes.
const KEPT_BYTES: usize = 12 << 20;

/// What a method carries from step to step, where a course keeps a state.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Memory {
    /// Nothing: it goes on from a state as if it had never stopped.
    Absent,
    /// Something, which is dropped at each place where a state may be kept.
    Dropped,
    /// Something that is part of its bits: the way back leads over the start.
    Carried,
}

/// What a cloud is of.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    /// Its name, for people.
    name: &'a str,
    /// Copies from these starts; `None` if there can be none.
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

/// Copies of a body of a scene.
pub(super) fn copies_of(
    CloudBody { kind, body, .. }: CloudBody<'_>,
) -> impl Fn(Solver, Vec<State<f64>>) -> Option<NewBatch> + '_ {
    |solver, starts| (kind.batch)(body.body(), InstructionSet::widest(), solver, starts)
}

/// All copies at a tick.
struct Kept {
    tick: u64,
    q: Vec<f64>,
    v: Vec<f64>,
    /// Of a course with lozenges.
    factors: Vec<f64>,
}

/// A batch at a tick of a run.
pub(super) struct Course {
    batch: Batch,
    /// The last ticks that were stepped.
    ticks: Ticks,
    memory: Memory,
    /// By tick, the start first; none of a course that never goes back.
    kept: Vec<Kept>,
    spacing: u64,
    /// The small areas whose corners its copies are.
    lozenges: Option<Lozenges>,
}

impl Course {
    /// Copies of the subject from the starts, which are made only if there is memory for them. `ticks` are none, at the start
    /// of the run.
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

    /// The same course, which keeps states to go back to.
    pub(super) fn rewindable(mut self) -> Self {
        self.keep();
        self
    }

    /// The same course, whose copies are the corners of lozenges.
    pub(super) fn around(self, lozenges: Lozenges) -> Self {
        Self { lozenges: Some(lozenges), ..self }
    }

    /// The area of each lozenge over that at the start; `None` where it is lost.
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

    /// The tick reached.
    pub(super) fn tick(&self) -> u64 {
        self.ticks.first + self.ticks.count
    }

    /// The time of the tick reached, in seconds.
    pub(super) fn t(&self) -> f64 {
        self.ticks.t(self.tick())
    }

    /// Goes to a tick; back only if it is [rewindable](Self::rewindable).
    pub(super) fn go_to(&mut self, tick: u64) {
        if tick < self.tick() {
            self.go_back(tick);
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
                self.mark();
            }
        }
    }

    /// Goes to the last state that is kept no later than a tick.
    fn go_back(&mut self, tick: u64) {
        let nearest = self.kept.iter().rfind(|kept| kept.tick <= tick);
        let Kept { tick, q, v, factors } =
            nearest.expect("a course that goes back has kept its start");
        place(&mut self.batch, q, v);
        if let Some(lozenges) = &mut self.lozenges {
            lozenges.factors.clone_from(factors);
        }
        self.ticks = Ticks { first: *tick, count: 0, ..self.ticks };
    }

    /// At a place where states may be kept.
    fn mark(&mut self) {
        if self.memory == Memory::Dropped {
            self.batch.change(|_, _| ());
        }
        let is_new = self.kept.last().is_some_and(|last| last.tick < self.tick());
        if is_new && self.memory != Memory::Carried && self.tick().is_multiple_of(self.spacing) {
            self.keep();
        }
        let bytes = size_of_val(self.q()) * 2;
        if self.kept.len() > 2 && self.kept.len() * bytes > KEPT_BYTES {
            self.spacing *= 2;
            self.kept.retain(|kept| kept.tick.is_multiple_of(self.spacing));
        }
    }

    fn keep(&mut self) {
        let [q, v] = [self.q(), self.v()].map(<[f64]>::to_vec);
        let factors = self.lozenges.as_ref().map_or(Vec::new(), |it| it.factors.clone());
        self.kept.push(Kept { tick: self.tick(), q, v, factors });
    }
}

/// Sets the states of all copies. Those that fill the last block are like the last.
fn place(batch: &mut Batch, q: &[f64], v: &[f64]) {
    let mut states = q.iter().zip(v);
    let mut last = (f64::NAN, f64::NAN);
    batch.change(|q, v| {
        last = states.next().map_or(last, |(q, v)| (*q, *v));
        (*q, *v) = last;
    });
}
