//! A solution on its way: where it is, to twice the digits, and how it steps.

use super::extrapolation::Extrapolation;
use crate::sim::bodies::Body;
use crate::sim::double_double::{DoubleDouble, TURN};
use crate::sim::system::{State, Vector};

/// A step that passes with this many columns was too short: the next is twice as long.
const EASY: usize = 6;

/// What a step that does not pass is cut to.
const CUT: f64 = 0.25;

/// An angle is kept within this of 0, a little more than half a turn, so that what swings about a half is
/// not turned to and fro.
const WIDEST: f64 = 3.3;

/// How near a step ends to the end of a piece of the force law, as a part of the room that it had. What is
/// left is of second order in the state.
const NEAR: f64 = 1e-9;

/// The most attempts to end a step there; the search converges faster than linearly.
const MOST_SEARCHES: u32 = 60;

/// A piece left by less than this, and come back to within a step, is not left: what that makes is far
/// below this, as the corner's two forces are alike there.
const TOUCHED: f64 = 1e-9;

/// How often a step is halved that leaves its piece on the way and comes back to it.
const MOST_HALVINGS: u32 = 8;

/// How a track chooses its steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pace {
    /// As long as they may be.
    Long,
    /// At least two in each call, of unequal length, and each with a larger error: rounding and truncation
    /// are others, and the latter more.
    Uneven,
}

impl Pace {
    /// The error allowed in a step, as [`Extrapolation::attempt`] has it.
    fn tolerance(self) -> f64 {
        match self {
            Pace::Long => 1e-14,
            Pace::Uneven => 4e-14,
        }
    }
}

/// The part of what is left that an uneven first step takes at most.
const UNEVEN: f64 = 0.57;

/// The work that was granted is done.
#[derive(Debug)]
pub(super) struct Spent;

#[derive(Clone, Debug)]
pub(super) struct Track<V> {
    /// Where it is, angles without full turns.
    at: State<V>,
    /// What is to be added to `at`, below its last digit.
    low: State<V>,
    /// The full turns of each coordinate, whole numbers.
    turns: V,
    /// The step to try next; `None` tries all that is left.
    step: Option<f64>,
    /// The piece of the force law that it is on.
    piece: usize,
    pace: Pace,
}

impl<V: Vector> Track<V> {
    pub(super) fn new(like: &State<V>, pace: Pace) -> Self {
        let state = like.clone();
        Self { at: state.clone(), low: state.clone(), turns: state.q, step: None, piece: 0, pace }
    }

    /// Begins at `state`, which is taken as exact.
    pub(super) fn begin<B: Body<Vector = V>>(&mut self, body: &B, state: &State<V>) {
        self.at.assign(state);
        for half in [&mut self.low.q, &mut self.low.v, &mut self.turns] {
            half.components_mut().fill(0.0);
        }
        self.step = None;
        self.unwind(body);
        self.piece = body.piece(&self.at);
    }

    /// Begins at the place where `other` is, moved by `offset`.
    pub(super) fn begin_beside<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        other: &Self,
        offset: &State<V>,
    ) {
        self.at.assign(&other.at);
        self.low.assign(&other.low);
        self.turns.assign(&other.turns);
        self.add(offset);
        self.step = None;
        self.piece = body.piece(&self.at);
    }

    /// Writes the place, rounded once.
    pub(super) fn write(&self, to: &mut State<V>) {
        to.assign(&self.at);
        let rows = self.at.q.components().iter().zip(self.low.q.components());
        let rows = rows.zip(self.turns.components()).zip(to.q.components_mut());
        for (((high, low), turns), to) in rows.filter(|((_, turns), _)| **turns != 0.0) {
            *to = (DoubleDouble { high: *high, low: *low } + TURN * *turns).high;
        }
    }

    /// Writes how far this is from `other`.
    pub(super) fn apart(&self, other: &Self, to: &mut State<V>) {
        to.assign(&self.at);
        to.add_scaled(-1.0, &other.at);
        to.add_scaled(1.0, &self.low);
        to.add_scaled(-1.0, &other.low);
        to.q.add_scaled(TURN.high, &self.turns);
        to.q.add_scaled(-TURN.high, &other.turns);
    }

    /// Advances from `t` to exactly `t + h` (s), by no more than `granted` evaluations in all of `work`.
    pub(super) fn advance<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        t: f64,
        h: f64,
        work: &mut Extrapolation<V>,
        granted: u64,
    ) -> Result<(), Spent> {
        self.unwind(body);
        let mut carried = self.step.map_or(h, |step| step.copysign(h));
        let mut left = h;
        let mut halvings = 0;
        let tolerance = self.pace.tolerance();
        work.begin(body, self.piece, t, &self.at);
        while work.evaluations < granted {
            let is_first = left.abs() > 0.5 * h.abs();
            let most = if self.pace == Pace::Uneven && is_first { UNEVEN * left } else { left };
            let trial = if carried.abs() < most.abs() { carried } else { most };
            let from = t + (h - left);
            let Some(columns) = work.attempt(body, self.piece, from, trial, &self.at, tolerance)
            else {
                carried = CUT * trial;
                continue;
            };
            let mut stepped = trial;
            if let Some(side) = self.leaves(body, work) {
                let begun = body.room(self.piece, &self.at)[side];
                let ended = body.room(self.piece, work.end(&self.at))[side];
                // Beyond already, and on its way further: nothing to be stepped here.
                let part = if begun < 0.0 {
                    0.0
                } else {
                    let Some(part) = self.search(body, work, from, trial, side, [begun, ended])
                    else {
                        carried = CUT * trial;
                        continue;
                    };
                    part
                };
                stepped = part * trial;
                if part > 0.0 {
                    self.add(work.added());
                }
                self.piece = if side == 0 { self.piece - 1 } else { self.piece + 1 };
            } else if work.least_room.iter().any(|&room| room < -TOUCHED)
                && halvings < MOST_HALVINGS
            {
                halvings += 1;
                carried = trial / 2.0;
                continue;
            } else {
                self.add(work.added());
                // A step cut short by the end of the call says nothing about the next one.
                if trial == carried && columns <= EASY {
                    carried *= 2.0;
                }
                if trial == left {
                    self.step = Some(carried);
                    return Ok(());
                }
            }
            halvings = 0;
            left -= stepped;
            work.begin(body, self.piece, t + (h - left), &self.at);
        }
        Err(Spent)
    }

    /// The side on which the last attempt ends beyond the piece, unless it began further beyond.
    fn leaves<B: Body<Vector = V>>(&self, body: &B, work: &mut Extrapolation<V>) -> Option<usize> {
        let begun = body.room(self.piece, &self.at);
        let ended = body.room(self.piece, work.end(&self.at));
        (0..2).find(|&side| ended[side] < 0.0 && ended[side] < begun[side])
    }

    /// The part of the step `h` at which the room on `side` ends, given what it is at both ends: the
    /// Illinois variant of regula falsi. The last attempt is then the step to there.
    fn search<B: Body<Vector = V>>(
        &self,
        body: &B,
        work: &mut Extrapolation<V>,
        t: f64,
        h: f64,
        side: usize,
        [begun, ended]: [f64; 2],
    ) -> Option<f64> {
        let near = NEAR * (begun + ended.abs());
        let (mut inner, mut outer) = ((0.0, begun), (1.0, ended));
        let mut part = 1.0;
        for _ in 0..MOST_SEARCHES {
            part = inner.0 + (outer.0 - inner.0) * (inner.1 / (inner.1 - outer.1));
            work.attempt(body, self.piece, t, part * h, &self.at, self.pace.tolerance())?;
            let room = body.room(self.piece, work.end(&self.at))[side];
            if room.abs() <= near || part == inner.0 || part == outer.0 {
                break;
            }
            if room < 0.0 {
                outer = (part, room);
                inner.1 /= 2.0;
            } else {
                inner = (part, room);
                outer.1 /= 2.0;
            }
        }
        Some(part)
    }

    fn add(&mut self, what: &State<V>) {
        let each = |at: &mut V, low: &mut V, what: &V| {
            let rows = at.components_mut().iter_mut().zip(low.components_mut());
            for ((at, low), what) in rows.zip(what.components()) {
                let sum = DoubleDouble::sum(*at, *what);
                let sum = DoubleDouble::sum(sum.high, sum.low + *low);
                (*at, *low) = (sum.high, sum.low);
            }
        };
        each(&mut self.at.q, &mut self.low.q, &what.q);
        each(&mut self.at.v, &mut self.low.v, &what.v);
    }

    /// Takes full turns out of angles.
    fn unwind<B: Body<Vector = V>>(&mut self, body: &B) {
        let rows = self.at.q.components_mut().iter_mut().zip(self.low.q.components_mut());
        let rows = rows.zip(self.turns.components_mut()).enumerate();
        for (i, ((at, low), turns)) in rows {
            if body.is_angle(i) && at.abs() > WIDEST {
                let more = libm::rint(*at / TURN.high);
                let left = DoubleDouble { high: *at, low: *low } - TURN * more;
                (*at, *low) = (left.high, left.low);
                *turns += more;
            }
        }
    }
}
