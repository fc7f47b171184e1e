//! Runs of the built-in scenes from which the chapter's numbers and figures are taken.

use std::ops::ControlFlow;

use crate::run::{Follow, Lane};
use crate::scene::Scene;
use crate::sim::Solver;
use crate::sim::integrators::{Method, method};

/// The state of a body at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moment {
    pub(super) t: f64,
    pub(super) q: f64,
    pub(super) v: f64,
}

/// The built-in scene of this name.
pub(super) fn scene(name: &str) -> Scene {
    Scene::built_in(name).expect("the chapter's scenes are built in")
}

/// The method with this id.
pub(super) fn method_of(id: &str) -> &'static Method {
    method(id).expect("the chapter's methods are in the table")
}

/// The scene's first body at every tick up to `seconds`, the start included, at the scene's tick rate.
pub(super) fn by_method(scene: &Scene, id: &str, seconds: f64) -> Vec<Moment> {
    run(scene, Solver::Method(method_of(id)), seconds, f64::from(scene.tick_hz))
}

/// The exact motion of the scene's first body, with `per_second` states per second.
pub(super) fn exactly(scene: &Scene, seconds: f64, per_second: f64) -> Vec<Moment> {
    run(scene, Solver::Truth, seconds, per_second)
}

fn run(scene: &Scene, solver: Solver, seconds: f64, hz: f64) -> Vec<Moment> {
    let at = |lane: &Lane, tick: u64| {
        let stepper = &lane.bodies()[0].stepper;
        Moment { t: tick as f64 / hz, q: stepper.q()[0], v: stepper.v()[0] }
    };
    let mut follow = Follow::new(Lane::new(scene, solver, 1), hz);
    let mut moments = vec![at(&follow.body, 0)];
    follow.run((seconds * hz).round() as u64, |lane, tick| {
        moments.push(at(lane, tick));
        ControlFlow::Continue(())
    });
    moments
}
