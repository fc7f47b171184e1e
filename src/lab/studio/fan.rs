//! A fan of futures: the next second of a body under each method of the scene, and in truth, from where it is now. It is
//! taken on copies, so that the run is not disturbed.

use glam::DVec2;

use super::Studio;
use crate::sim::{Solver, Stepper};

/// How long it is, in seconds, and the most ticks that it has.
const LENGTH_S: f64 = 1.0;
const MAX_TICKS: u32 = 1000;
/// Steps of the truth between two ticks at least, and in all: enough for it to look smooth.
const EXACT_STEPS: u32 = 120;
/// The most methods, and the most coordinates of a body: each frame steps all of them.
const MAX_METHODS: usize = 9;
const MAX_COORDINATES: usize = 8;

/// A moment of a future.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FutureMoment {
    /// When, in seconds of the run.
    pub t: f64,
    /// Where the body is, in metres.
    pub at: DVec2,
    /// The plotted coordinate and its velocity.
    pub state: [f64; 2],
}

/// What becomes of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Future {
    /// The method, by its index on the menu; `None` in truth.
    pub entry: Option<usize>,
    /// A moment for each tick, and more in truth; up to where the method fails.
    pub moments: Vec<FutureMoment>,
}

impl Studio {
    /// Whether futures are shown: while a person drags the tick rate, and if they are asked for while time stands still.
    pub fn shows_futures(&self) -> bool {
        let is_dragged = self.viewer.hz_at_press.is_some_and(|hz| hz != self.race().tick_hz());
        self.loop_lab().is_none() && (is_dragged || self.display().futures && !self.time_runs())
    }

    /// The next second of the body at this index of the scene in the selected lane, the truth last; empty if it has halted, or
    /// has too many coordinates.
    pub fn futures(&self, body: usize) -> Vec<Future> {
        let of = &self.selected().lane.bodies()[body];
        let is_dear = of.coordinates().len() > MAX_COORDINATES || of.stepper.is_beyond_reference();
        if of.halted().is_some() || is_dear {
            return Vec::new();
        }
        let held = self.viewer.held().filter(|held| held.body == body);
        let mut from = of.stepper.clone();
        held.into_iter().for_each(|held| from.set(self.race().t(), &held.q, &held.v));
        let plotted = self.past().coordinate(self.race(), body).1;
        let t = self.race().t();
        let follow = |solver: Solver, h: f64, substeps: u32| {
            let mut stepper = from.with_solver(solver, t);
            let moment = |t: f64, stepper: &dyn Stepper| FutureMoment {
                t,
                at: stepper.place(),
                state: [stepper.q()[plotted], stepper.v()[plotted]],
            };
            let mut moments = vec![moment(t, &*stepper)];
            let steps = libm::round(LENGTH_S / h) as u32;
            for step in 0..steps.min(MAX_TICKS) {
                let before = t + f64::from(step) * h;
                if stepper.advance(before, h, substeps).is_err() {
                    break;
                }
                let now = moment(before + h, &*stepper);
                if !now.state.iter().all(|value| value.is_finite()) {
                    break;
                }
                moments.push(now);
            }
            moments
        };
        let h = 1.0 / f64::from(self.race().tick_hz());
        let listed = self.entries().iter().take(self.offered().min(MAX_METHODS)).enumerate();
        let of_methods = listed.map(|(entry, spec)| Future {
            entry: Some(entry),
            moments: follow(spec.solver(), h, spec.substeps),
        });
        let finer = h / f64::from(EXACT_STEPS.div_ceil(self.race().tick_hz()));
        let exact = Future { entry: None, moments: follow(Solver::Truth, finer, 1) };
        of_methods.chain([exact]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Scene;
    use crate::lab::studio::{StageCommand, ViewCommand};

    #[test]
    fn each_future_is_what_the_run_comes_to_under_its_method() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        (0..7).for_each(|_| studio.tick());
        studio.apply(StageCommand::TickHz(12));
        let futures = studio.futures(0);
        assert_eq!(futures.len(), studio.scene().lanes.len() + 1);
        for Future { entry, moments } in futures {
            let Some(entry) = entry else {
                let FutureMoment { t, state: [x, _], .. } = moments[moments.len() - 1];
                let from = studio.race().entrants()[0].lane.bodies()[0].stepper.clone();
                let [q, v] = [from.q()[0], from.v()[0]];
                // A period is a second.
                assert!(
                    (t - studio.race().t() - 1.0).abs() < 1e-9 && (x - q).abs() < 1e-9,
                    "{x} {q} {v}"
                );
                continue;
            };
            assert_eq!(moments.len(), 13, "a dot a tick, and the present");
            let mut run = Studio::new(Scene::built_in("spring").unwrap());
            (0..7).for_each(|_| run.tick());
            run.apply(StageCommand::TickHz(12));
            run.apply(StageCommand::Pick(entry));
            for FutureMoment { state, .. } in &moments[1..] {
                run.tick();
                let stepper = &run.race().entrants()[0].lane.bodies()[0].stepper;
                assert_eq!(state[0], stepper.q()[0], "{}", run.entries()[entry].method.id);
            }
        }
    }

    #[test]
    fn futures_are_shown_at_rest_if_asked_for_and_while_the_rate_is_dragged() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        assert!(!studio.shows_futures());
        studio.apply(ViewCommand::PointerDown(true));
        assert!(!studio.shows_futures());
        studio.apply(StageCommand::TickHz(12));
        assert!(studio.shows_futures(), "it is dragged");
        studio.apply(ViewCommand::PointerDown(false));
        assert!(!studio.shows_futures());
        studio.apply(ViewCommand::ToggleFutures);
        assert!(studio.shows_futures() && !studio.running(), "it stands still to be looked at");
        studio.apply(ViewCommand::TogglePause);
        assert!(!studio.shows_futures());
        studio.apply(ViewCommand::TogglePause);
        assert!(studio.shows_futures());
        studio.apply(ViewCommand::ToggleFutures);
        assert!(!studio.shows_futures());
    }
}
