//! The flights of a reference solution between its impacts, which run ahead of it.

use super::extrapolation::Extrapolation;
use super::trajectory::{StepControl, Trajectory};
use crate::body::Body;
use crate::contact::Contact;
use crate::impact::Wall;
use crate::state::{State, Vector, largest};

/// The seconds by which the flights are followed at once. Of flights within one stretch, only the last has a height.
const STRETCH_S: f64 = 1.0 / 64.0;

/// The largest number of evaluations by which the flights of one start are followed.
const MAX_EVALUATIONS: u64 = 300_000;

/// The difference of two solutions with other steps, in parts of the largest coordinate, at which a chaotic motion is
/// no longer known.
const MAX_DIFFERENCE: f64 = 1e-4;

/// The largest number of impacts of one start that are known. Room for them is there from the first, so that no tick
/// allocates.
const MAX_IMPACTS: usize = 4096;

/// The number of impacts of one stretch for which there is room from the first.
const MAX_LANDINGS: usize = 64;

/// The impacts of a body from a start, as far as they have been asked for.
#[derive(Clone, Debug)]
pub(super) struct Flights<V> {
    start: (f64, State<V>),
    /// Whether the flights from the start have been asked for.
    has_begun: bool,
    ahead: Box<Ahead<V>>,
}

#[derive(Clone, Debug)]
struct Ahead<V> {
    trajectory: Trajectory<V>,
    /// The trajectory before the last stretch.
    before: Trajectory<V>,
    /// The same with other steps.
    check: Trajectory<V>,
    difference: State<V>,
    largest: f64,
    has_ended: bool,
    work: Extrapolation<V>,
    stretches: u32,
    /// The time (s) of each impact, first the start, with the height of the flight after it above the first wall.
    found: Vec<[f64; 2]>,
}

impl<V: Vector> Flights<V> {
    pub(super) fn new(t: f64, state: &State<V>) -> Self {
        let mut trajectory = Trajectory::new(state, StepControl::Long);
        trajectory.landings = Some(Vec::with_capacity(MAX_LANDINGS));
        let ahead = Ahead {
            trajectory,
            before: Trajectory::new(state, StepControl::Long),
            check: Trajectory::new(state, StepControl::Uneven),
            difference: state.clone(),
            largest: 0.0,
            has_ended: false,
            work: Extrapolation::new(state),
            stretches: 0,
            found: Vec::with_capacity(MAX_IMPACTS),
        };
        Self { start: (t, state.clone()), has_begun: false, ahead: Box::new(ahead) }
    }

    /// Begins again from another state at time `t` (s).
    pub(super) fn begin(&mut self, t: f64, state: &State<V>) {
        self.start.0 = t;
        self.start.1.assign(state);
        self.has_begun = false;
    }

    /// Returns the time (s) of an impact, and the height of the flight after it, NaN if that is not known.
    pub(super) fn bounce<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        impact: u64,
    ) -> Option<[f64; 2]> {
        let Self { start: (t, ref state), ref mut has_begun, ref mut ahead } = *self;
        if !std::mem::replace(has_begun, true) {
            ahead.begin(body, t, state);
        }
        let wanted = usize::try_from(impact).ok()?;
        let has = |ahead: &Ahead<V>| {
            let is_flown = ahead.found.get(wanted).is_some_and(|[_, height]| !height.is_nan());
            is_flown || ahead.found.len() > wanted + 1
        };
        let rests = |ahead: &Ahead<V>| ahead.trajectory.rests(body) && !has_moving_wall(body, t);
        while !has(ahead) && !ahead.has_ended && !rests(ahead) {
            ahead.has_ended = ahead.go_on(body, t).is_none() || ahead.found.len() >= MAX_IMPACTS;
        }
        ahead.found.get(wanted).copied()
    }

    /// Returns the memory on the heap in bytes, without coordinate vectors.
    pub(super) fn heap_bytes(&self) -> usize {
        let Ahead { trajectory, found, .. } = &*self.ahead;
        let landings = trajectory.landings.as_ref().map_or(0, Vec::capacity);
        size_of_val(&*self.ahead)
            + size_of::<[f64; 2]>() * found.capacity()
            + size_of::<f64>() * landings
    }
}

impl<V: Vector> Ahead<V> {
    fn begin<B: Body<Vector = V>>(&mut self, body: &B, t: f64, state: &State<V>) {
        self.trajectory.begin(body, t, state);
        self.check.begin(body, t, state);
        (self.largest, self.has_ended, self.stretches) = (0.0, false, 0);
        self.work.evaluations = 0;
        self.found.clear();
        // A copy of a race has no room.
        self.found.reserve_exact(MAX_IMPACTS);
        self.take_off(body, t);
    }

    /// Adds an impact at time `t` (s), whose flight begins at its top if it does not rise.
    fn take_off<B: Body<Vector = V>>(&mut self, body: &B, t: f64) {
        let State { q, v } = &self.trajectory.at;
        let height = match still_wall(body) {
            Some(wall) if wall.speed(v.components()) <= 0.0 => wall.height(q.components()),
            _ => f64::NAN,
        };
        self.found.push([t, height]);
    }

    /// Follows one stretch. Returns `None` if it takes too much work, or the motion is no longer known.
    fn go_on<B: Body<Vector = V>>(&mut self, body: &B, start_s: f64) -> Option<()> {
        let t = start_s + STRETCH_S * f64::from(self.stretches);
        let wall = still_wall(body)?;
        self.stretches += 1;
        let Self { trajectory, before, check, difference, work, .. } = self;
        before.assign(trajectory);
        trajectory.advance(body, t, STRETCH_S, work, MAX_EVALUATIONS).ok()?;
        check.advance(body, t, STRETCH_S, work, MAX_EVALUATIONS).ok()?;
        trajectory.subtract(check, difference);
        self.largest = self.largest.max(largest(trajectory.at.q.components()));
        if largest(difference.q.components()) > MAX_DIFFERENCE * self.largest {
            return None;
        }
        let landed = trajectory.landings.as_mut()?;
        let has_peaked = wall.speed(before.at.v.components()) > 0.0
            && wall.speed(trajectory.at.v.components()) <= 0.0;
        if let Some(last) = self.found.last_mut()
            && last[1].is_nan()
            && (has_peaked || !landed.is_empty() && wall.speed(before.at.v.components()) > 0.0)
        {
            let until_s = landed.first().copied().unwrap_or(f64::INFINITY);
            let found = top(body, before, [t, until_s], (work, &mut difference.v));
            last[1] = found.unwrap_or(f64::NAN);
        }
        self.found.extend(landed.drain(..).map(|at_s| [at_s, f64::NAN]));
        Some(())
    }
}

/// Returns the height of a flight near its top, where the body of the trajectory is at time `t` (s); `None` if another
/// wall ends the flight before. `a` is room for an acceleration.
fn top<B: Body>(
    body: &B,
    trajectory: &mut Trajectory<B::Vector>,
    [mut t, until_s]: [f64; 2],
    (work, a): (&mut Extrapolation<B::Vector>, &mut B::Vector),
) -> Option<f64> {
    let wall = still_wall(body)?;
    for _ in 0..8 {
        let State { q, v } = &trajectory.at;
        body.acceleration(t, q, v, a);
        let push = wall.side * a.components()[wall.coordinate];
        let left = -wall.speed(v.components()) / push;
        if left.abs() < 1e-12 {
            break;
        }
        // Without a push the way up has no end.
        if !left.is_finite() || t + left >= until_s {
            return None;
        }
        trajectory.advance(body, t, left, work, MAX_EVALUATIONS).ok()?;
        t += left;
    }
    Some(wall.height(trajectory.at.q.components()))
}

/// Whether a wall moves, so that it may throw a body that rests on it.
fn has_moving_wall<B: Body>(body: &B, t: f64) -> bool {
    let moves = |it: Contact| it.wall.velocity != 0.0 || it.wall.acceleration != 0.0;
    [t, t + STRETCH_S].into_iter().any(|t| Contact::all(body, t).any(moves))
}

/// Returns the wall above which heights of flights are.
fn still_wall<B: Body>(body: &B) -> Option<Wall> {
    body.wall(0, 0.0).map(Wall::at_rest)
}
