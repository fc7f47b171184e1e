//! The loop that ticks bodies outside a run, from their start, at one tick rate, with the inputs of a script.

use std::borrow::Cow;
use std::ops::ControlFlow;

use crate::scene::{Action, Scripted, nearest_tick};
use crate::sim::TickRate;
use crate::sim::integrators::StepFailure;

/// A system that a [`Ticker`] ticks.
pub trait Ticked {
    /// Applies an action at time `t` (s), before tick `tick`.
    fn act(&mut self, tick: u64, t: f64, action: &Action);

    /// Steps from `t` by `h` (s), from tick `tick` to the next.
    ///
    /// # Errors
    /// If the step fails. A [`Lane`](super::Lane) never fails, because its bodies halt one by one.
    fn tick(&mut self, tick: u64, t: f64, h: f64) -> Result<(), StepFailure>;

    /// Whether the first `ticks` ticks exceeded this work. An implementation may check only at some ticks.
    fn has_worked_more(&self, than: u64, ticks: u64) -> bool;
}

/// Bodies that advance tick by tick. A caller may stop after any tick, and resume from there.
///
/// ```
/// use std::ops::ControlFlow;
/// use regatta_run::race::{Ticker, Lane, StopReason};
/// use regatta_scene::Scene;
/// use regatta_sim::{Solver, integrators::method};
///
/// let scene = Scene::built_in("spring").expect("a built-in scene");
/// let lane = Lane::new(&scene, Solver::Method(method("rk4").expect("a method")), 1);
/// let mut follow = Ticker::new(lane, scene.tick_hz).with_script(&scene.script);
/// // Until the spring is past its place of rest.
/// let stop = follow.run(600, |lane, _| match lane.bodies()[0].stepper.q()[0] > 0.0 {
///     true => ControlFlow::Continue(()),
///     false => ControlFlow::Break(()),
/// });
/// assert_eq!((stop, follow.ticks()), (StopReason::Seen, 16));
/// assert_eq!(follow.run(600, |_, _| ControlFlow::Continue(())), StopReason::End);
/// ```
#[derive(Clone, Debug)]
pub struct Ticker<'a, B> {
    /// The system in its present state.
    pub body: B,
    script: Cow<'a, [Scripted]>,
    /// Number of script rows already performed.
    done: usize,
    start_s: f64,
    tick_hz: TickRate,
    ticks: u64,
    max_work: u64,
}

/// The reason why a [`Ticker`] stopped.
#[derive(Clone, Debug, PartialEq)]
pub enum StopReason {
    /// The ticker reached the requested tick.
    End,
    /// The ticker's caller stopped it.
    Seen,
    /// The ticker exceeded its work limit.
    TooMuchWork,
    /// The next tick failed.
    Failed(StepFailure),
}

impl<'a, B: Ticked> Ticker<'a, B> {
    /// Creates a ticker of `body` at its start, at a tick rate, without a script.
    pub fn new(body: B, tick_hz: impl Into<TickRate>) -> Self {
        Self {
            body,
            script: Cow::Borrowed(&[]),
            done: 0,
            start_s: 0.0,
            tick_hz: tick_hz.into(),
            ticks: 0,
            max_work: u64::MAX,
        }
    }

    /// Adds a script, in order. Each action precedes the tick nearest to its time.
    pub fn with_script(self, script: impl Into<Cow<'a, [Scripted]>>) -> Self {
        Self { script: script.into(), ..self }
    }

    /// Starts at this time (s) instead of 0.
    pub fn from_time(self, start_s: f64) -> Self {
        Self { start_s, ..self }
    }

    /// Limits the work, in the unit of [`Ticked::has_worked_more`].
    pub fn with_max_work(self, max_work: u64) -> Self {
        Self { max_work, ..self }
    }

    /// Returns the number of ticks made.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Returns the time reached, in seconds.
    pub fn t(&self) -> f64 {
        self.start_s + self.tick_hz.seconds(self.ticks)
    }

    /// Makes ticks until their total number is `end`. After each tick, passes the system and the number of ticks to
    /// `see`.
    pub fn run(
        &mut self,
        end: u64,
        mut see: impl FnMut(&mut B, u64) -> ControlFlow<()>,
    ) -> StopReason {
        while self.ticks < end {
            if self.ticks > 0 && self.body.has_worked_more(self.max_work, self.ticks) {
                return StopReason::TooMuchWork;
            }
            if let Err(failure) = self.tick() {
                return StopReason::Failed(failure);
            }
            if see(&mut self.body, self.ticks).is_break() {
                return StopReason::Seen;
            }
        }
        StopReason::End
    }

    /// Makes a tick, after the script's actions that are due.
    fn tick(&mut self) -> Result<(), StepFailure> {
        let (tick, t) = (self.ticks, self.t());
        let is_due = |row: &&Scripted| nearest_tick(row.at_s - self.start_s, self.tick_hz) <= tick;
        while let Some(row) = self.script.get(self.done).filter(is_due) {
            self.body.act(tick, t, &row.action);
            self.done += 1;
        }
        self.body.tick(tick, t, self.tick_hz.step_s())?;
        self.ticks += 1;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A log of the calls in words. The fourth tick fails.
    #[derive(Clone, Default)]
    struct Log(Vec<String>);

    impl Ticked for Log {
        fn act(&mut self, tick: u64, t: f64, action: &Action) {
            self.0.push(format!("{tick} at {t}: {action:?}"));
        }

        fn tick(&mut self, tick: u64, t: f64, h: f64) -> Result<(), StepFailure> {
            let failure = || StepFailure::Escaped { coordinate: "x".into(), value: 1e39 };
            self.0.push(format!("{tick} at {t} by {h}"));
            if tick == 3 { Err(failure()) } else { Ok(()) }
        }

        fn has_worked_more(&self, than: u64, ticks: u64) -> bool {
            ticks > than
        }
    }

    fn script() -> [Scripted; 2] {
        let row = |(at_s, part)| Scripted { at_s, action: Action::Throttle(part) };
        [(10.0, 0.5), (10.4, 1.0)].map(row)
    }

    #[test]
    fn stopping_after_each_tick_does_not_change_a_ticker() {
        let script = script();
        let ticker = || Ticker::new(Log::default(), 4).from_time(10.0).with_script(&script);
        let mut whole = ticker();
        let failed = whole.run(9, |_, _| ControlFlow::Continue(()));
        assert!(
            matches!(failed, StopReason::Failed(_)) && whole.ticks() == 3 && whole.t() == 10.75
        );
        let mut sliced = ticker();
        for ticks in 1..=3 {
            let stop = match ticks {
                2 => sliced.run(ticks, |_, _| ControlFlow::Continue(())),
                _ => sliced.run(9, |_, made| {
                    assert_eq!(made, ticks);
                    ControlFlow::Break(())
                }),
            };
            assert_eq!(stop, if ticks == 2 { StopReason::End } else { StopReason::Seen });
        }
        assert_eq!(sliced.run(9, |_, _| ControlFlow::Continue(())), failed);
        assert_eq!(sliced.body.0, whole.body.0);
        let wanted = [
            "0 at 10: Throttle(0.5)",
            "0 at 10 by 0.25",
            "1 at 10.25 by 0.25",
            "2 at 10.5: Throttle(1.0)",
            "2 at 10.5 by 0.25",
            "3 at 10.75 by 0.25",
        ];
        assert_eq!(whole.body.0, wanted);
    }

    #[test]
    fn a_ticker_stops_after_the_tick_that_exceeds_its_work() {
        let ticker = || Ticker::new(Log::default(), 4).with_max_work(1);
        let mut stopped = ticker();
        assert_eq!(stopped.run(3, |_, _| ControlFlow::Continue(())), StopReason::TooMuchWork);
        assert_eq!(stopped.ticks(), 2);
        let mut whole = ticker();
        assert_eq!(whole.run(2, |_, _| ControlFlow::Continue(())), StopReason::End);
    }
}
