//! A numerical solution in double-double precision, and the control of its step size.

use super::extrapolation::Extrapolation;
use super::walls;
use crate::body::{Body, Distances, MAX_SWITCHES, NO_BOUNDARIES, Piece};
use crate::double_double::{DoubleDouble, TWO_PI};
use crate::state::{State, Vector};

/// If a step is accepted with at most this number of columns, it was too short, and the next step is twice as long.
const FEW_COLUMNS: usize = 6;

/// The factor that shortens a rejected step.
const REJECTED_FACTOR: f64 = 0.25;

/// The largest magnitude of an angle before full turns are removed. It is slightly more than half a turn, so that a
/// motion about half a turn does not alternate.
const MAX_ANGLE: f64 = 3.3;

/// The largest distance from the boundary of a piece at which a step may end, relative to the distances at both ends.
/// The error of the state is of second order in this distance.
const BOUNDARY_TOLERANCE: f64 = 1e-9;

/// The same as [`BOUNDARY_TOLERANCE`], but if the force jumps. The error of the state is then of first order in this
/// distance.
const JUMP_TOLERANCE: f64 = 2e-15;

/// If the force can jump, a crossing of a boundary by less than this fraction of the switch's extent counts as
/// rounding. A motion that comes to rest at a corner would otherwise cross it for ever.
const CROSSING_ROUNDING: f64 = 1e-13;

/// The maximum number of boundaries crossed one after another without a step. A motion that is pushed back to a jump of
/// the force from both sides would cross it for ever, for example at rest under dry friction.
const MAX_STANDS: usize = 4 * MAX_SWITCHES;

/// The maximum number of attempts to end a step at a boundary. The search converges superlinearly.
const MAX_SEARCH_STEPS: u32 = 60;

/// A step may cross a boundary by less than this distance and cross back. The error is far smaller, because the two
/// forces agree at the corner.
const IGNORED_CROSSING: f64 = 1e-9;

/// The maximum number of halvings of a step that leaves its piece and comes back to it.
const MAX_HALVINGS: u32 = 8;

/// Number of evaluations within one call after which the progress is checked. A hopelessly stiff body, such as a ship
/// that turns in 10⁻¹⁴⁰ s, would otherwise spend all saved evaluations on each run, which is seconds of work.
const STRETCH: u64 = 200_000;

/// The factor by which steps may still grow after a stretch of evaluations, for example after a near collision.
const MAX_LATER_STEP_GROWTH: f64 = 1e3;

/// The step size strategy of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StepControl {
    /// Each step is as long as the tolerance allows.
    Long,
    /// Each call makes at least two steps of unequal length, with a larger tolerance. The errors of rounding and of
    /// truncation then differ from those of the other solution.
    Uneven,
}

impl StepControl {
    /// Returns the tolerance of a step, as in [`Extrapolation::attempt`].
    fn tolerance(self) -> f64 {
        match self {
            StepControl::Long => 1e-14,
            StepControl::Uneven => 4e-14,
        }
    }
}

/// The length of an uneven first step is at most this fraction of the remaining time.
const FIRST_UNEVEN_STEP: f64 = 0.57;

/// A boundary that a step crosses.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    /// The switch whose mode changes.
    switch: usize,
    /// The side of the boundary, which is 0 for the mode below and 1 for the mode above.
    side: usize,
    /// The distance to the boundary at the start of the step and at its end.
    begun: f64,
    ended: f64,
}

/// The outcome of a trial step.
enum StepOutcome {
    /// The step was too long for the tolerance.
    Rejected,
    /// The step left its piece of the force law and came back.
    LeftPiece,
    /// The step ended after this fraction of its length, at the boundary of its piece, and the piece changed.
    AtBoundary { part: f64 },
    /// The step succeeded with this number of columns.
    Accepted { columns: usize },
}

/// The reason why a trajectory ends.
#[derive(Debug)]
pub(super) enum TrajectoryEnd {
    /// The budget of evaluations is exhausted, or would be exhausted long before the end of the call.
    Budget,
    /// The motion is pushed back to a jump of the force from both sides.
    Sticks,
}

#[derive(Clone, Debug)]
pub(super) struct Trajectory<V> {
    /// The current state, with angles reduced by full turns.
    pub(super) at: State<V>,
    /// The low half of `at` in double-double precision.
    low: State<V>,
    /// The number of full turns removed from each coordinate; a whole number.
    turns: V,
    /// The length of the step to try next; `None` if it is all the remaining time.
    step: Option<f64>,
    /// The current piece of the force law.
    piece: Piece,
    /// The largest distance of each switch to a boundary so far; 0 if the force cannot jump.
    extents: [f64; MAX_SWITCHES],
    control: StepControl,
    /// The times (s) of jumps of the state, if somebody reads them.
    pub(super) landings: Option<Vec<f64>>,
}

impl<V: Vector> Trajectory<V> {
    pub(super) fn new(like: &State<V>, control: StepControl) -> Self {
        let state = like.clone();
        Self {
            at: state.clone(),
            low: state.clone(),
            turns: state.q,
            step: None,
            piece: Piece::FIRST,
            extents: [0.0; MAX_SWITCHES],
            control,
            landings: None,
        }
    }

    /// Starts at `state` at time `t` (s). The state is taken as exact.
    pub(super) fn begin<B: Body<Vector = V>>(&mut self, body: &B, t: f64, state: &State<V>) {
        self.at.assign(state);
        for half in [&mut self.low.q, &mut self.low.v, &mut self.turns] {
            half.components_mut().fill(0.0);
        }
        self.step = None;
        self.extents = [0.0; MAX_SWITCHES];
        self.unwind(body);
        self.piece = walls::piece(body, t, &self.at);
    }

    /// Goes to where `other` is, as it steps. The landings stay.
    pub(super) fn assign(&mut self, other: &Self) {
        self.at.assign(&other.at);
        self.low.assign(&other.low);
        self.turns.assign(&other.turns);
        let Self { step, piece, extents, control, .. } = other;
        self.piece.clone_from(piece);
        (self.step, self.extents, self.control) = (*step, *extents, *control);
    }

    /// Whether the body rests on a wall, in the mode other than 0.
    pub(super) fn rests<B: Body<Vector = V>>(&self, body: &B) -> bool {
        self.piece.modes[..body.switches()].iter().skip(body.first_wall()).any(|mode| *mode != 0)
    }

    /// Starts at the state of `other` plus `offset`, at time `t` (s).
    pub(super) fn begin_beside<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        t: f64,
        other: &Self,
        offset: &State<V>,
    ) {
        self.at.assign(&other.at);
        self.low.assign(&other.low);
        self.turns.assign(&other.turns);
        self.add(offset);
        self.step = None;
        self.piece = walls::piece(body, t, &self.at);
    }

    /// Overwrites `to` with the current state, rounded once.
    pub(super) fn write(&self, to: &mut State<V>) {
        to.assign(&self.at);
        let rows = self.at.q.components().iter().zip(self.low.q.components());
        let rows = rows.zip(self.turns.components()).zip(to.q.components_mut());
        for (((high, low), turns), to) in rows.filter(|((_, turns), _)| **turns != 0.0) {
            *to = (DoubleDouble { high: *high, low: *low } + TWO_PI * *turns).high;
        }
    }

    /// Overwrites `to` with the state of this trajectory minus that of `other`.
    pub(super) fn subtract(&self, other: &Self, to: &mut State<V>) {
        to.assign(&self.at);
        to.add_scaled(-1.0, &other.at);
        to.add_scaled(1.0, &self.low);
        to.add_scaled(-1.0, &other.low);
        to.q.add_scaled(TWO_PI.high, &self.turns);
        to.q.add_scaled(-TWO_PI.high, &other.turns);
    }

    /// Advances from `t` to exactly `t + h` (s) while `work` has used fewer than `budget` evaluations.
    pub(super) fn advance<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        t: f64,
        h: f64,
        work: &mut Extrapolation<V>,
        budget: u64,
    ) -> Result<(), TrajectoryEnd> {
        self.unwind(body);
        let mut carried = self.step.map_or(h, |step| step.copysign(h));
        let mut left = h;
        let (mut halvings, mut stands) = (0, 0);
        work.begin(body, &self.piece, t, &self.at);
        let mut seen = (work.evaluations, left);
        while work.evaluations < budget {
            if work.evaluations >= seen.0 + STRETCH {
                let come = (seen.1 - left).abs();
                let stretches = (budget - work.evaluations) as f64 / STRETCH as f64;
                if MAX_LATER_STEP_GROWTH * stretches * come < left.abs() {
                    return Err(TrajectoryEnd::Budget);
                }
                seen = (work.evaluations, left);
            }
            let is_first = left.abs() > 0.5 * h.abs();
            let most = if self.control == StepControl::Uneven && is_first {
                FIRST_UNEVEN_STEP * left
            } else {
                left
            };
            let trial = if carried.abs() < most.abs() { carried } else { most };
            let stepped = match self.try_step(body, t + (h - left), trial, halvings, work) {
                StepOutcome::Rejected => {
                    carried = REJECTED_FACTOR * trial;
                    continue;
                }
                StepOutcome::LeftPiece => {
                    halvings += 1;
                    carried = trial / 2.0;
                    continue;
                }
                StepOutcome::AtBoundary { part } => {
                    stands = if part > 0.0 { 0 } else { stands + 1 };
                    if stands > MAX_STANDS {
                        return Err(TrajectoryEnd::Sticks);
                    }
                    part * trial
                }
                StepOutcome::Accepted { columns } => {
                    // A step cut short by the end of the call gives no information about the next one.
                    if trial == carried && columns <= FEW_COLUMNS {
                        carried *= 2.0;
                    }
                    if trial == left {
                        self.step = Some(carried);
                        return Ok(());
                    }
                    trial
                }
            };
            halvings = 0;
            left -= stepped;
            work.begin(body, &self.piece, t + (h - left), &self.at);
        }
        Err(TrajectoryEnd::Budget)
    }

    /// Tries one step of `h` from `t`, after this number of halvings of steps that left the piece. Moves the state if
    /// the step is accepted, and changes the piece at a boundary.
    fn try_step<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        t: f64,
        h: f64,
        halvings: u32,
        work: &mut Extrapolation<V>,
    ) -> StepOutcome {
        let tolerance = self.control.tolerance();
        let Some(columns) = work.attempt(body, &self.piece, t, h, &self.at, tolerance) else {
            return StepOutcome::Rejected;
        };
        let switches = body.switches();
        let counts = [switches, body.first_wall()];
        let (mut begun, mut ended) = (NO_BOUNDARIES, NO_BOUNDARIES);
        if switches > 0 {
            begun = walls::distances_to_ends(body, &self.piece, t, &self.at);
            ended = walls::distances_to_ends(body, &self.piece, t + h, work.end(&self.at));
            self.extend(body, &ended);
        }
        if let Some(crossing) = self.first_crossing(counts, &begun, &ended) {
            let found = self.find_first_boundary(body, work, t, h, &begun, crossing);
            let Some((part, Crossing { switch, side, .. })) = found else {
                return StepOutcome::Rejected;
            };
            if part > 0.0 {
                self.add(work.added());
            }
            let at_s = t + part * h;
            if walls::cross(body, &mut self.piece, [switch, side], at_s, &mut self.at) {
                self.low.q.components_mut().fill(0.0);
                self.low.v.components_mut().fill(0.0);
                if let Some(landings) = &mut self.landings {
                    landings.push(at_s);
                }
            }
            return StepOutcome::AtBoundary { part };
        }
        if halvings < MAX_HALVINGS && self.leaves_piece(body, &work.min_distances) {
            return StepOutcome::LeftPiece;
        }
        self.add(work.added());
        StepOutcome::Accepted { columns }
    }

    /// Extends the extents to the finite distances of a state.
    fn extend<B: Body<Vector = V>>(&mut self, body: &B, distances: &Distances) {
        if !body.has_jumps() {
            return;
        }
        for (extent, distances) in self.extents.iter_mut().zip(distances) {
            let finite = distances.iter().filter(|distance| distance.is_finite());
            *extent = finite.fold(*extent, |most, distance| most.max(distance.abs()));
        }
    }

    /// Returns the first crossing of a step, as estimated from the distances at both ends. A boundary counts only if
    /// the step ends beyond it and did not start further beyond it.
    fn first_crossing(
        &self,
        [switches, first_wall]: [usize; 2],
        begun: &Distances,
        ended: &Distances,
    ) -> Option<Crossing> {
        let mut first: Option<(f64, Crossing)> = None;
        for switch in 0..switches {
            let is_wall = switch >= first_wall;
            let noise = if is_wall { 0.0 } else { CROSSING_ROUNDING * self.extents[switch] };
            for side in 0..2 {
                let (begun, ended) = (begun[switch][side], ended[switch][side]);
                if ended < -noise && ended < begun {
                    let part = if begun > 0.0 { begun / (begun - ended) } else { 0.0 };
                    if first.is_none_or(|(earliest, _)| part < earliest) {
                        first = Some((part, Crossing { switch, side, begun, ended }));
                    }
                }
            }
        }
        first.map(|(_, crossing)| crossing)
    }

    /// Whether a step that ends in its piece left the piece in between, according to these smallest distances.
    fn leaves_piece<B: Body<Vector = V>>(&self, body: &B, least: &Distances) -> bool {
        least.iter().zip(self.extents).take(body.switches()).any(|(least, extent)| {
            let ignored =
                if body.has_jumps() { CROSSING_ROUNDING * extent } else { IGNORED_CROSSING };
            least.iter().any(|&distance| distance < -ignored)
        })
    }

    /// Finds the first boundary within the step `h`, given the distances at the start and the crossing that seems
    /// first. Returns the fraction of the step at the boundary, and the boundary; `None` if an attempt fails. The last
    /// attempt is then the step to that boundary, unless the fraction is 0.
    fn find_first_boundary<B: Body<Vector = V>>(
        &self,
        body: &B,
        work: &mut Extrapolation<V>,
        t: f64,
        h: f64,
        begun: &Distances,
        mut crossing: Crossing,
    ) -> Option<(f64, Crossing)> {
        let mut whole = 1.0;
        for _ in 0..MAX_SWITCHES {
            // If the state is already beyond the boundary and moves away from it, the piece changes without a step.
            if crossing.begun < 0.0 {
                return Some((0.0, crossing));
            }
            // After an impact the way up is no impact, and a shorter step ends above the wall.
            if crossing.begun == 0.0
                && let Some(index) = crossing.switch.checked_sub(body.first_wall())
            {
                let speed = body.wall(index, t)?.speed(self.at.v.components());
                return (speed <= 0.0).then_some((0.0, crossing));
            }
            whole *= self.find_boundary(body, work, t, whole * h, crossing)?;
            let mut ended =
                walls::distances_to_ends(body, &self.piece, t + whole * h, work.end(&self.at));
            ended[crossing.switch][crossing.side] = f64::INFINITY;
            match self.first_crossing([body.switches(), body.first_wall()], begun, &ended) {
                Some(earlier) => crossing = earlier,
                None => return Some((whole, crossing)),
            }
        }
        None
    }

    /// Returns the fraction of the step `h` at which the step reaches a boundary that it crosses. The search is the
    /// Illinois variant of regula falsi. The last attempt is then the step to the boundary.
    fn find_boundary<B: Body<Vector = V>>(
        &self,
        body: &B,
        work: &mut Extrapolation<V>,
        t: f64,
        h: f64,
        Crossing { switch, side, begun, ended }: Crossing,
    ) -> Option<f64> {
        let near = match body.has_jumps() {
            true => JUMP_TOLERANCE * (begun + ended.abs() + self.extents[switch]),
            false => BOUNDARY_TOLERANCE * (begun + ended.abs()),
        };
        let (mut inner, mut outer) = ((0.0, begun), (1.0, ended));
        let mut part = 1.0;
        for _ in 0..MAX_SEARCH_STEPS {
            part = inner.0 + (outer.0 - inner.0) * (inner.1 / (inner.1 - outer.1));
            work.attempt(body, &self.piece, t, part * h, &self.at, self.control.tolerance())?;
            let ended = work.end(&self.at);
            let distance =
                walls::distances_to_ends(body, &self.piece, t + part * h, ended)[switch][side];
            if distance.abs() <= near || part == inner.0 || part == outer.0 {
                break;
            }
            if distance < 0.0 {
                outer = (part, distance);
                inner.1 /= 2.0;
            } else {
                inner = (part, distance);
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

    /// Removes full turns from angles.
    fn unwind<B: Body<Vector = V>>(&mut self, body: &B) {
        let rows = self.at.q.components_mut().iter_mut().zip(self.low.q.components_mut());
        let rows = rows.zip(self.turns.components_mut()).enumerate();
        for (i, ((at, low), turns)) in rows {
            if body.is_angle(i) && at.abs() > MAX_ANGLE {
                let more = libm::rint(*at / TWO_PI.high);
                let left = DoubleDouble { high: *at, low: *low } - TWO_PI * more;
                (*at, *low) = (left.high, left.low);
                *turns += more;
            }
        }
    }
}
