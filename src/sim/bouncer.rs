//! The steps of a body that meets walls: a method, and the rule for impacts after or within its steps.
//!
//! Rules differ in the place of the impact: within the step, after it, or before the next one. A rule within the step
//! looks for the time by trial steps of a copy, because the method's memory must not contain trials. After each impact
//! the method starts afresh, since its memory is of a motion without the jump. A body that bounces within too short a
//! time rests, or one step would have infinitely many impacts.

use super::body::Body;
use super::contact::Contact;
use super::impact::{Bounces, Locating, Rule, Turn, comes_to_rest};
use super::integrators::{EngineBounce, Method, Problem, StepFailure, Stepped};
use super::near_wall::NearWall;
use super::propagator::Propagator;
use super::state::{State, Vector};
use super::stepper::{Change, Solver};
use super::system::{Counted, StateOf};

/// The largest number of impacts within a step. A body that falls back on its wall so often in a step rests.
const MAX_IMPACTS: u32 = 1000;

/// The height in metres above which a body that rested on a wall flies again.
const LIFTED: f64 = 1e-9;

/// The largest number of trials for the time of an impact.
const MAX_TRIALS: u32 = 60;

/// A method with a rule for impacts. Bodies without walls are stepped by the method itself.
#[derive(Clone)]
pub(super) struct Bouncer<P, V> {
    inner: P,
    /// Makes trial steps, so that the memory of `inner` stays.
    probe: P,
    rule: Rule,
    /// The rule of an engine, with its impulses of the last tick and whether the wall pushed in it.
    engine: Option<EngineBounce>,
    kept: ([f64; 2], bool),
    bounces: Bounces,
    /// The wall on which the body came to rest at an impact within a step, and which it has not left.
    rests_on: Option<usize>,
    /// The length of the last tick in seconds.
    last_h: f64,
    from: State<V>,
    trial: State<V>,
    /// Room for an acceleration.
    a: V,
}

impl<P: Clone, V: Vector> Bouncer<P, V> {
    /// Creates a body's steps by `inner`, which is the method of `solver`.
    pub(super) fn new(inner: P, solver: Solver, bounces: Bounces, like: &State<V>) -> Self {
        let probe = inner.clone();
        let (from, trial, a) = (like.clone(), like.clone(), like.v.clone());
        let rule = solver.impact().rule;
        let engine = match rule {
            Rule::EngineP2 => Some(EngineBounce::P2),
            _ => solver.method().and_then(Method::bounce),
        };
        let kept = Default::default();
        let rests_on = None;
        Self { inner, probe, rule, engine, kept, bounces, rests_on, last_h: 0.0, from, trial, a }
    }

    /// Makes one tick of `n` substeps by an engine's rule for the wall that is nearer.
    #[cold]
    fn engine_tick<B: Body<Vector = V>>(
        &mut self,
        engine: EngineBounce,
        body: &Counted<B>,
        ([t, h], n): ([f64; 2], u32),
        y: &mut State<V>,
    ) {
        let nearer = |a: &Contact, b: &Contact| a.height(y).total_cmp(&b.height(y));
        let Some(contact) = Contact::all(&body.system, t).min_by(nearer) else { return };
        let (kept, touches) = self.kept;
        let mut ball = NearWall {
            height: contact.height(y),
            speed: contact.speed(y),
            push: contact.push(body, t, y, &mut self.a),
            restitution: contact.wall.restitution,
            kept,
            touches,
        };
        let before = ball;
        ball.tick(engine, h, n);
        self.kept = (ball.kept, ball.touches);
        contact.set_height(ball.height, y);
        contact.set_speed(ball.speed, y);
        if ball.touches && !touches && before.speed < 0.0 {
            // An engine may turn the ball above the wall, where it expects an impact within the tick.
            let part = (before.height / (-h * before.speed)).clamp(0.0, 1.0);
            self.bounces.land(t + h * part, [before.speed, ball.speed]);
            self.bounces.beyond = before.height.abs();
        }
    }

    /// Makes one step of the method, with its impacts.
    #[inline]
    fn part<B>(&mut self, body: &Counted<B>, t: f64, h: f64, y: &mut StateOf<B>) -> Stepped
    where
        B: Body<Vector = V>,
        P: Propagator<B>,
    {
        if self.rule == Rule::BeforeTick
            && let Some(contact) = Contact::beyond(&body.system, t, y)
            && contact.speed(y) < 0.0
        {
            let gained = contact.push(body, t, y, &mut self.a) * h;
            let [speed, back] = contact.turn(&body.system, t, y);
            contact.set_speed(back - gained, y);
            self.land(body, t, y, [speed, back]);
            self.bounces.beyond = -contact.height(y);
            self.add_height(&body.system, contact, y);
        }
        // One copy of both would wait until both have been written.
        self.from.q.assign(&y.q);
        let is_within = matches!(self.rule, Rule::Within(_) | Rule::Swept);
        if is_within
            && Contact::all(&body.system, t).any(|it| it.is_at_rest(y))
            && let Some(contact) = self.rest(body, t, y)
        {
            // Other coordinates go on.
            if y.q.components().len() > 1 {
                self.inner.step(body, t, h, 1, y)?;
            }
            let contact = contact.at(&body.system, t + h);
            contact.set_height(0.0, y);
            contact.set_speed(0.0, y);
            // A body that lies has no flight, though its wall may swing.
            self.bounces.part();
            return Ok(());
        }
        self.from.v.assign(&y.v);
        self.inner.step(body, t, h, 1, y)?;
        if self.rule == Rule::OwnLines {
            self.notice(body, [t, h], y);
            return Ok(());
        }
        match Contact::beyond(&body.system, t + h, y) {
            Some(contact) => self.meet(contact, body, [t, h], y),
            None => Ok(()),
        }
    }

    /// Handles the impact of a step from `self.from` that ended at `y`, beyond a wall.
    #[cold]
    fn meet<B>(
        &mut self,
        contact: Contact,
        body: &Counted<B>,
        [t, h]: [f64; 2],
        y: &mut StateOf<B>,
    ) -> Stepped
    where
        B: Body<Vector = V>,
        P: Propagator<B>,
    {
        match self.rule {
            Rule::Within(locating) => return self.locate(locating, body, [t, h], y),
            Rule::Swept => self.sweep(contact, body, [t, h], y),
            Rule::After(turn) => {
                let speed = contact.speed(y);
                if turn == Turn::Velocity && speed >= 0.0 {
                    return Ok(());
                }
                let height = contact.height(y);
                match turn {
                    Turn::Velocity | Turn::VelocityBlind => {}
                    Turn::Clamp => contact.set_height(0.0, y),
                    Turn::Mirror => contact.set_height(-height, y),
                    Turn::Energy => {
                        let gained = 2.0 * contact.push(body, t + h, y, &mut self.a) * height;
                        let at_wall = (speed * speed - gained).max(0.0).sqrt();
                        contact.set_speed(-at_wall, y);
                        contact.set_height(0.0, y);
                    }
                }
                let [_, back] = contact.turn(&body.system, t + h, y);
                self.land(body, t + h, y, [speed, back]);
                self.bounces.beyond = -height;
            }
            // A soft floor is entered at the end of the step.
            Rule::Penalty if contact.height(&self.from) >= 0.0 => {
                self.bounces.land(t + h, [contact.speed(y), f64::NAN]);
                self.bounces.beyond = -contact.height(y);
            }
            Rule::BeforeTick | Rule::Penalty => {}
            Rule::Engine | Rule::EngineP2 | Rule::OwnLines => {}
        }
        Ok(())
    }

    /// Adds the height of the flight at the end of a tick or before its first step.
    #[inline]
    fn add_height<B: Body<Vector = V>>(&mut self, body: &B, contact: Contact, y: &State<V>) {
        let distance = contact.height(y);
        let still = body.wall(contact.index, 0.0).unwrap_or(contact.wall).at_rest();
        self.bounces.add(still.height(y.q.components()), distance);
    }

    /// Records an impact if the method itself has turned the body in the step from `self.from` to `y`.
    fn notice<B: Body<Vector = V>>(&mut self, body: &Counted<B>, [t, h]: [f64; 2], y: &State<V>) {
        let is_turned = |it: &Contact| it.speed(&self.from) < 0.0 && it.speed(y) >= 0.0;
        if let Some(contact) = Contact::all(&body.system, t + h).find(is_turned) {
            let before = contact.speed(&self.from);
            self.bounces.land(t + h, [before, contact.speed(y)]);
            self.bounces.beyond = (contact.height(&self.from) + h * before).abs();
        }
    }

    /// Records an impact at time `t` (s), after which the method starts afresh.
    fn land<B>(&mut self, body: &Counted<B>, t: f64, y: &StateOf<B>, speeds: [f64; 2])
    where
        B: Body<Vector = V>,
        P: Propagator<B>,
    {
        self.bounces.land(t, speeds);
        self.inner.restart(t, false, &body.system, y);
    }

    /// Returns the wall against which the force presses the body at rest.
    #[cold]
    fn rest<B: Body<Vector = V>>(
        &mut self,
        body: &Counted<B>,
        t: f64,
        y: &State<V>,
    ) -> Option<Contact> {
        let contact = Contact::all(&body.system, t).find(|it| it.is_at_rest(y))?;
        (contact.push(body, t, y, &mut self.a) < 0.0).then_some(contact)
    }

    /// Handles the impact of a step on the straight line, and goes straight on.
    #[cold]
    fn sweep<B>(&mut self, contact: Contact, body: &Counted<B>, [t, h]: [f64; 2], y: &mut State<V>)
    where
        B: Body<Vector = V>,
        P: Propagator<B>,
    {
        let beyond = -contact.height(y);
        let part = chord(contact.at(&body.system, t).height(&self.from), -beyond);
        let [speed, back] = contact.turn(&body.system, t + part * h, y);
        contact.set_height((back * (h - part * h)).max(0.0), y);
        self.land(body, t + part * h, y, [speed, back]);
        self.bounces.beyond = beyond;
    }

    /// Finds the impacts of a step from `self.from` that ended at `y`, beyond a wall.
    fn locate<B>(
        &mut self,
        locating: Locating,
        body: &Counted<B>,
        [mut t, mut left]: [f64; 2],
        y: &mut State<V>,
    ) -> Stepped
    where
        B: Body<Vector = V>,
        P: Propagator<B>,
    {
        for impacts in 1.. {
            let Some(end) = Contact::beyond(&body.system, t + left, y) else { break };
            let begin = end.at(&body.system, t);
            let part = self.hit(locating, body, [t, left], [begin, end], y)?;
            let (hit_at, rest) = (t + part * left, left - part * left);
            let contact = end.at(&body.system, hit_at);
            let before = contact.speed(y);
            contact.set_height(0.0, y);
            contact.set_speed(-before.abs(), y);
            let [_, speed] = contact.turn(&body.system, hit_at, y);
            let push = contact.push(body, hit_at, y, &mut self.a);
            let rests = comes_to_rest(speed, push) || push < 0.0 && impacts == MAX_IMPACTS;
            // On a wall that moves, a body at rest meets it again by the rounding of the time.
            if self.rests_on == Some(end.index) {
                self.inner.restart(hit_at, false, &body.system, y);
            } else {
                self.land(body, hit_at, y, [before, speed]);
            }
            if rests {
                self.rests_on = Some(end.index);
                self.bounces.part();
                if y.q.components().len() > 1 {
                    self.inner.step(body, hit_at, rest, 1, y)?;
                }
                let contact = contact.at(&body.system, hit_at + rest);
                contact.set_height(0.0, y);
                contact.set_speed(0.0, y);
                break;
            }
            if impacts == MAX_IMPACTS {
                return Err(StepFailure::TooManyImpacts { limit: MAX_IMPACTS });
            }
            if rest <= 0.0 {
                break;
            }
            (t, left) = (hit_at, rest);
            self.from.assign(y);
            self.inner.step(body, t, left, 1, y)?;
        }
        Ok(())
    }

    /// Finds the part of a step at which the body meets the wall, and puts `y` into the state there.
    fn hit<B>(
        &mut self,
        locating: Locating,
        body: &Counted<B>,
        [t, h]: [f64; 2],
        [begin, end]: [Contact; 2],
        y: &mut State<V>,
    ) -> Result<f64, StepFailure>
    where
        B: Body<Vector = V>,
        P: Propagator<B>,
    {
        let [start, last] = [begin.height(&self.from), end.height(y)];
        let [v0, v1] = [begin.speed(&self.from), end.speed(y)];
        if start < 0.0 || start == 0.0 && v0 <= 0.0 {
            y.assign(&self.from);
            return Ok(0.0);
        }
        // After an impact the body leaves the wall, and its way up is no impact.
        let push = if start == 0.0 { begin.push(body, t, &self.from, &mut self.a) } else { 0.0 };
        let up = if push < 0.0 { (v0 / -push / h).min(0.5) } else { 0.0 };
        match locating {
            Locating::Chord | Locating::SpeedAtEnd => {
                let part = if start == 0.0 { 1.0 } else { chord(start, last) };
                if locating == Locating::Chord {
                    end.set_speed(v0 + part * (v1 - v0), y);
                }
                Ok(part)
            }
            Locating::Cubic => {
                let slopes = [h * v0, h * v1];
                let part = root([start, last], up, |s| Ok(cubic([start, last], slopes, s)))?;
                // Its slope would be less accurate than a cubic of the speeds.
                let pushes = [
                    begin.push(body, t, &self.from, &mut self.a),
                    end.push(body, t + h, y, &mut self.a),
                ];
                end.set_speed(cubic([v0, v1], pushes.map(|a| h * a), part), y);
                Ok(part)
            }
            Locating::Method => {
                let Self { probe, from, trial, .. } = self;
                let part = root([start, last], up, |s| {
                    trial.assign(from);
                    probe.restart(t, false, &body.system, from);
                    probe.step(body, t, s * h, 1, trial)?;
                    Ok(end.at(&body.system, t + s * h).height(trial))
                })?;
                y.assign(trial);
                Ok(part)
            }
        }
    }
}

/// Returns the value at `s`, 0 to 1, of the cubic with these ends and these slopes there.
fn cubic([start, last]: [f64; 2], [a, b]: [f64; 2], s: f64) -> f64 {
    let (c, d) = (3.0 * (last - start) - 2.0 * a - b, 2.0 * (start - last) + a + b);
    start + s * (a + s * (c + s * d))
}

/// Returns the zero of the straight line from `start`, 0 or more, to `last`, which is negative.
fn chord(start: f64, last: f64) -> f64 {
    (start / (start - last)).clamp(0.0, 1.0)
}

/// Returns the part of a step at which a height that is `start` at 0 and `last` at 1 falls through 0, by the method of
/// Illinois. The last call of `height` is at the result. A start at 0 has a positive height at `up` or earlier.
fn root(
    [start, last]: [f64; 2],
    up: f64,
    mut height: impl FnMut(f64) -> Result<f64, StepFailure>,
) -> Result<f64, StepFailure> {
    let (mut low, mut above) = (0.0, start);
    let (mut high, mut below) = (1.0, last);
    let mut trials = 0;
    if start == 0.0 {
        low = up;
        above = height(low)?;
        while above <= 0.0 && trials < MAX_TRIALS {
            (high, below) = (low, above);
            low /= 2.0;
            above = height(low)?;
            trials += 1;
        }
    }
    let enough = f64::EPSILON * (above - below);
    let mut before = 0.0;
    let mut part = low;
    while trials < MAX_TRIALS {
        trials += 1;
        part = (low * below - high * above) / (below - above);
        if !(low < part && part < high) {
            part = low + (high - low) / 2.0;
        }
        let found = height(part)?;
        if found.abs() <= enough || part == low || part == high {
            break;
        }
        if found > 0.0 {
            (low, above) = (part, found);
            below = if before > 0.0 { below / 2.0 } else { below };
        } else {
            (high, below) = (part, found);
            above = if before < 0.0 { above / 2.0 } else { above };
        }
        before = found;
    }
    Ok(part)
}

impl<B, P> Propagator<B> for Bouncer<P, B::Vector>
where
    B: Body,
    P: Propagator<B> + Clone,
{
    fn step(&mut self, body: &Counted<B>, t: f64, h: f64, n: u32, y: &mut StateOf<B>) -> Stepped {
        if self.last_h != h {
            self.bounces.part();
        }
        self.last_h = h;
        // A division would take longer than a step.
        let part = if n == 1 { h } else { h / f64::from(n) };
        match self.engine {
            Some(engine) => self.engine_tick(engine, body, ([t, h], n), y),
            None => (0..n).try_for_each(|i| self.part(body, t + part * f64::from(i), part, y))?,
        }
        if let Some(contact) = Contact::all(&body.system, t + h).next() {
            self.bounces.coordinate = contact.wall.coordinate;
            self.add_height(&body.system, contact, y);
            self.rests_on = self.rests_on.filter(|index| {
                let wall = Contact::all(&body.system, t + h).nth(*index);
                wall.is_some_and(|it| it.height(y) < LIFTED)
            });
        }
        Ok(())
    }

    fn jump(&mut self, t: f64, change: Change<'_>, body: &mut B, state: &mut StateOf<B>) -> bool {
        let is_changed = self.inner.jump(t, change, body, state);
        if is_changed {
            self.bounces.restart();
            (self.kept, self.rests_on) = Default::default();
        }
        is_changed
    }

    fn restart(&mut self, t: f64, is_placing: bool, body: &B, state: &StateOf<B>) {
        self.inner.restart(t, is_placing, body, state);
    }

    fn try_step(
        &self,
        of: &Problem<B::Vector>,
        step: [f64; 2],
        n: u32,
        y: &mut StateOf<B>,
    ) -> Option<Stepped> {
        self.inner.try_step(of, step, n, y)
    }

    fn lost_time(&self) -> f64 {
        self.inner.lost_time()
    }

    fn bounces(&self) -> Option<&Bounces> {
        Some(&self.bounces)
    }
}
