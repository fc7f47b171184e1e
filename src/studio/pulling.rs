//! A body pulled by hand: a damped spring joins one of its handles to the pointer while time runs. Each tick changes
//! the body's velocities by an [`Action::Push`], so that a pull is part of the run and of its truth.

use glam::DVec2;

use super::deck::{Deck, PulledBody};
use crate::look::{Look, Pull};
use crate::scene::Action;

/// Angular frequency of the spring between hand and body, in radians per second. It is critically damped.
const PULL_RAD_PER_S: f64 = 8.0;

/// Pushes the body that the person pulls, before the next tick.
pub(super) fn pull(deck: &mut Deck) {
    let Some(action) = deck.pulled.as_ref().and_then(|pulled| push(deck, pulled)) else { return };
    // The notice of each push would hide all others.
    let (done, _) = deck.with_notices(|run, notices| run.act_within(action, notices));
    deck.edits += u64::from(done.is_some());
}

/// The impulse of the spring in the next tick. `None` for a halted body.
fn push(deck: &Deck, pulled: &PulledBody) -> Option<Action> {
    let lane = deck.race().entrant(pulled.lane)?;
    let body = lane.lane.bodies().get(pulled.body).filter(|body| body.halted().is_none())?;
    let (q, v) = (body.stepper.q(), body.stepper.v());
    let (mut target, mut still) = (q.to_vec(), v.to_vec());
    let pull = Pull { handle: pulled.handle, to: pulled.to, velocity: DVec2::ZERO };
    Look::of(body).pull(&mut target, &mut still, pull);
    let h = deck.race().tick_hz().step_s();
    // At a low tick rate a stiffer spring would throw the body away.
    let rad_per_s = PULL_RAD_PER_S.min(1.0 / h);
    let (stiffness, damping) = (rad_per_s * rad_per_s, 2.0 * rad_per_s);
    let by = (0..q.len()).map(|i| match target[i] == q[i] && still[i] == v[i] {
        // A coordinate that the handle does not move is free.
        true => 0.0,
        false => h * stiffness * (target[i] - q[i]) - damping * h / (1.0 + damping * h) * v[i],
    });
    Some(Action::Push { body: pulled.body, by: by.collect() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::{RunCommand, Studio, ViewCommand};

    const FRAME_NS: i64 = 16_666_667;

    fn pulled(studio: &Studio, to: f64) -> RunCommand {
        let to = DVec2::new(to, 0.0);
        let lane = studio.selected().id;
        RunCommand::Pull(PulledBody { lane, body: 0, handle: 0, to, hand: to })
    }

    #[test]
    fn a_pull_holds_a_spring_between_its_rest_and_the_hand() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(crate::StageCommand::Pick(3));
        studio.apply(ViewCommand::PointerDown(true));
        studio.apply(pulled(&studio, 3.0));
        (0..600).for_each(|_| _ = studio.advance(FRAME_NS));
        let at = |studio: &Studio| studio.selected().lane.bodies()[0].stepper.q()[0];
        // Both springs balance at k / (k + K) of the distance.
        let (hand, own) = (64.0, 4.0 * std::f64::consts::PI * std::f64::consts::PI);
        let balance = 3.0 * hand / (hand + own);
        // A push per tick is within a tick's share of a steady pull.
        assert!((at(&studio) - balance).abs() < 0.1, "{} for {balance}", at(&studio));
        let truth = studio.race().truth().bodies()[0].stepper.q()[0];
        assert!((truth - balance).abs() < 0.1, "the truth is pulled too: {truth}");
        let ticks = studio.race().tick();
        assert!(ticks > 590, "time runs: {ticks}");
        studio.apply(ViewCommand::LetGo);
        studio.apply(ViewCommand::PointerDown(false));
        let text = studio.deck.recording().unwrap();
        assert_eq!(text.matches("push = {").count(), 1, "{text}");
        let replayed = Scene::parse("run.toml", &text).unwrap();
        assert!(!replayed.checks.is_empty() && replayed.script.len() > 500);
        studio.apply(RunCommand::Undo);
        assert!(!studio.deck.recording().unwrap().contains("push"), "it is one edit");
    }

    #[test]
    fn a_pull_is_stable_at_every_rate() {
        for hz in [1, 2, 5, 10, 1000] {
            let mut studio = Studio::new(Scene::built_in("ship").unwrap());
            studio.apply(crate::StageCommand::TickHz(hz.into()));
            studio.apply(pulled(&studio, 50.0));
            (0..1200).for_each(|_| _ = studio.advance(FRAME_NS));
            let [x, v] = {
                let body = &studio.selected().lane.bodies()[0].stepper;
                [body.q()[0], body.v()[0]]
            };
            assert!((45.0..60.0).contains(&x) && v.abs() < 5.0, "{hz} Hz: {x} m, {v} m/s");
        }
    }
}
