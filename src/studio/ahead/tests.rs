use super::*;
use crate::measure::FutureMoment;
use crate::scene::{Action, LaneId, LaneSpec, Scene};
use crate::sim::integrators::{GENERAL_METHODS, METHODS, Method};
use crate::{RunCommand, StageCommand, Step, ViewCommand};

/// Returns a studio whose scene has run for some ticks under a method.
fn studio(scene: &str, method: &str, ticks: u64) -> Studio {
    let mut scene = Scene::built_in(scene).unwrap();
    let method = METHODS.iter().find(|known| known.id == method).unwrap();
    if method.is_of_library() {
        scene.lanes.push(LaneSpec::plain(method));
    }
    let mut studio = Studio::new(scene);
    let entry = studio.entries().iter().position(|spec| spec.method == method).unwrap();
    studio.apply(StageCommand::Pick(entry));
    (0..ticks).for_each(|_| studio.tick());
    studio
}

/// Returns the anatomy of the next tick of the selected lane.
fn step_of(studio: &Studio) -> Option<OneStep> {
    one_step(studio)
}

/// Returns the name of a scene that the method can step.
fn scene_for(method: &Method) -> &'static str {
    let fits = |name: &&str| Scene::built_in(name).unwrap().refusal(method).is_none();
    ["spring", "ship", "follow", "lerp", "coin"].into_iter().find(fits).expect("one of them")
}

fn near(found: [f64; 2], wanted: [f64; 2]) -> bool {
    found.iter().zip(wanted).all(|(a, b)| (a - b).abs() <= 1e-12 * (1.0 + b.abs()))
}

#[test]
fn rk4_evaluates_at_the_textbook_points() {
    let step = step_of(&studio("spring", "rk4", 7)).unwrap();
    let h = 1.0 / 60.0;
    let omega_squared = std::f64::consts::TAU * std::f64::consts::TAU;
    let f = |[x, v]: [f64; 2]| [v, -omega_squared * x];
    let along = |h: f64, k: [f64; 2]| [step.from[0] + h * k[0], step.from[1] + h * k[1]];
    let k1 = f(step.from);
    let k2 = f(along(h / 2.0, k1));
    let k3 = f(along(h / 2.0, k2));
    let at = [step.from, along(h / 2.0, k1), along(h / 2.0, k2), along(h, k3)];
    assert_eq!(step.evaluations.len(), 4);
    for (i, evaluation) in step.evaluations.iter().enumerate() {
        assert!((evaluation.when - [0.0, 0.5, 0.5, 1.0][i]).abs() < 1e-12, "{evaluation:?}");
        assert!(near(evaluation.at, at[i]), "{i}: {evaluation:?}");
        assert!(near(evaluation.slope, f(at[i])), "{i}: {evaluation:?}");
    }
    assert_eq!((step.tick, step.h), (7, h));
    let exact = step.exact_landing().unwrap();
    let turn = std::f64::consts::TAU * h;
    let wanted =
        step.from[0] * libm::cos(turn) + step.from[1] / std::f64::consts::TAU * libm::sin(turn);
    assert!((exact[0] - wanted).abs() < 1e-9, "{exact:?}, not {wanted}");
}

#[test]
fn every_predicted_landing_matches_the_run_to_the_bit() {
    for scene in ["spring", "chain", "pendulum", "orbit"] {
        for method in GENERAL_METHODS {
            let mut studio = studio(scene, method.id, 5);
            let before: Vec<u64> = studio.race().lane_hashes().collect();
            let evaluations = studio.race().entrants()[0].lane.evaluations();
            let step = one_step(&studio).unwrap();
            let counted = studio.deck.evaluations_of_next_tick(studio.active());
            assert_eq!(studio.race().lane_hashes().collect::<Vec<_>>(), before, "{}", method.id);
            studio.tick();
            let lane = &studio.race().entrants()[0].lane;
            let stepper = &lane.bodies()[0].stepper;
            let bits = |at: [f64; 2]| at.map(f64::to_bits);
            let landed = [stepper.q()[0], stepper.v()[0]];
            assert_eq!(step.landing.map(bits), Some(bits(landed)), "{} on {scene}", method.id);
            assert_eq!(step.evaluations.len() as u64, lane.evaluations() - evaluations);
            assert_eq!(step.evaluations.len() as u64, counted, "{} on {scene}", method.id);
        }
    }
}

#[test]
fn weights_on_a_card_lead_to_the_landing() {
    let mut chains = 0;
    for method in METHODS {
        let step = step_of(&studio(scene_for(method), method.id, 3)).unwrap();
        assert_eq!(step.chain.is_empty(), method.weights.is_empty(), "{}", method.id);
        if let Some(&end) = step.chain.last() {
            assert!(near(end, step.landing.unwrap()), "{}: {end:?}", method.id);
            chains += 1;
        }
    }
    assert_eq!(chains, 5);
}

#[test]
fn a_halted_body_has_no_next_step() {
    let studio = studio("stiff", "explicit-euler", 400);
    assert!(studio.race().entrants()[0].lane.halted().is_some());
    assert_eq!(one_step(&studio), None);
}

#[test]
fn rk4_loses_a_fixed_part_per_tick_and_a_32nd_of_it_in_half_ticks() {
    for ticks in [0, 1, 5] {
        let mut studio = studio("spring", "rk4", 0);
        studio.apply(StageCommand::TickHz(5.into()));
        studio.apply(StageCommand::Restart);
        (0..ticks).for_each(|_| studio.tick());
        let [whole, halves] = one_step(&studio).unwrap().growth.unwrap();
        // |R(iz)|² = 1 - z⁶/72 + z⁸/576 with z = 2π/5.
        let z = std::f64::consts::TAU / 5.0;
        let wanted = (1.0 - z.powi(6) / 72.0 + z.powi(8) / 576.0).sqrt() - 1.0;
        assert!((whole - wanted).abs() < 1e-6, "{whole}, not {wanted}");
        assert!((25.0..40.0).contains(&(whole / halves)), "{}", whole / halves);
    }
    assert_eq!(step_of(&studio("ship", "rk4", 3)).unwrap().growth, None, "a ship does not swing");
    assert_eq!(step_of(&studio("chain", "rk4", 3)).unwrap().growth, None);
}

#[test]
fn an_undamped_orbit_has_the_energy_of_its_state_and_turns_at_zero_speed() {
    let studio = studio("spring", "rk4", 7);
    let tau = std::f64::consts::TAU;
    let size = |[q, v]: [f64; 2]| libm::hypot(q, v / tau);
    let from = one_step(&studio).unwrap().from;
    let lines = orbit(&studio, from, [-0.2, 2.0]);
    assert_eq!(lines.len(), 2, "above and below");
    for line in &lines {
        assert!(line.len() > 40);
        for at in line {
            assert!((size(*at) - size(from)).abs() < 1e-6, "{at:?}");
        }
        let last = line[line.len() - 1];
        assert!(last[1] == 0.0 && (last[0] - size(from)).abs() < 1e-9, "{last:?}");
    }
}

#[test]
fn each_predicted_future_matches_the_run_under_its_method() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..7).for_each(|_| studio.tick());
    studio.apply(StageCommand::TickHz(12.into()));
    let futures = futures(&studio.deck, 0);
    assert_eq!(futures.len(), studio.scene().lanes.len() + 1);
    for FutureCurve { entry, moments } in futures {
        let Some(entry) = entry else {
            let FutureMoment { t, state: [x, _], .. } = moments[moments.len() - 1];
            let from = studio.race().entrants()[0].lane.bodies()[0].stepper.clone();
            let [q, v] = [from.q()[0], from.v()[0]];
            // The future is a second long, which is a period.
            assert!(
                (t - studio.race().t() - 1.0).abs() < 1e-9 && (x - q).abs() < 1e-9,
                "{x} {q} {v}"
            );
            continue;
        };
        assert_eq!(moments.len(), 13, "a dot a tick, and the present");
        let mut run = Studio::new(Scene::built_in("spring").unwrap());
        (0..7).for_each(|_| run.tick());
        run.apply(StageCommand::TickHz(12.into()));
        run.apply(StageCommand::Pick(entry));
        for FutureMoment { state, .. } in &moments[1..] {
            run.tick();
            let stepper = &run.race().entrants()[0].lane.bodies()[0].stepper;
            assert_eq!(state[0], stepper.q()[0], "{}", run.entries()[entry].method.id);
        }
    }
}

#[test]
fn futures_are_shown_on_request_at_rest_and_while_the_rate_is_dragged() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    assert!(!shows_futures(&studio));
    studio.apply(ViewCommand::PointerDown(true));
    assert!(!shows_futures(&studio));
    studio.apply(StageCommand::TickHz(12.into()));
    assert!(shows_futures(&studio), "it is dragged");
    studio.apply(ViewCommand::PointerDown(false));
    assert!(!shows_futures(&studio));
    studio.apply(ViewCommand::ToggleFutures);
    assert!(shows_futures(&studio) && !studio.running(), "it stands still to be looked at");
    studio.apply(ViewCommand::TogglePause);
    assert!(!shows_futures(&studio));
    studio.apply(ViewCommand::TogglePause);
    assert!(shows_futures(&studio));
    studio.apply(ViewCommand::ToggleFutures);
    assert!(!shows_futures(&studio));
}

#[test]
fn a_held_tick_rate_stops_time_and_shows_futures_until_its_release() {
    const FRAME_NS: i64 = 16_666_667;
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..60).for_each(|_| _ = studio.advance(FRAME_NS));
    let tick = studio.race().tick();
    studio.apply(ViewCommand::PointerDown(true));
    studio.apply(ViewCommand::HoldTickRate);
    for hz in [30, 10, 500] {
        studio.apply(StageCommand::TickHz(hz.into()));
        (0..30).for_each(|_| _ = studio.advance(FRAME_NS));
        assert!(shows_futures(&studio) && studio.running() && !studio.deck.time_runs());
    }
    assert_eq!(studio.race().tick(), tick);
    studio.apply(ViewCommand::PointerDown(false));
    (0..30).for_each(|_| _ = studio.advance(FRAME_NS));
    assert!(!shows_futures(&studio) && studio.race().tick() > tick);
    let rates = |studio: &Studio| studio.deck.recorded().script.len();
    assert_eq!(rates(&studio), 1, "the drag is one action");
    studio.apply(RunCommand::Undo);
    assert_eq!((studio.race().tick_hz(), rates(&studio)), (60.into(), 0), "and one edit");
}

#[test]
fn a_drag_out_and_back_changes_nothing_and_leaves_nothing_to_undo() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    (0..47).for_each(|_| studio.tick());
    let (stiffness, _) = studio.scene().bodies[0].kind.parameter("stiffness_n_per_m").unwrap();
    let present = studio.race().values(0)[stiffness];
    let set = |value| Action::Set { body: 0, parameter: stiffness, value };
    let substeps = |substeps| Action::Substeps { lane: LaneId(1), substeps };
    let hz = |hz: u32| Action::TickHz(hz.into());
    for (away, back) in [
        ([set(80.0), set(3.0)], set(present)),
        ([substeps(2), substeps(9)], substeps(1)),
        ([hz(5), hz(500)], hz(60)),
    ] {
        let hash = studio.race().state_hash();
        let edits = studio.deck.edits;
        studio.apply(ViewCommand::PointerDown(true));
        studio.apply(ViewCommand::HoldTickRate);
        for action in away {
            studio.apply(RunCommand::Act(action));
            assert!(studio.run().undoes().is_some());
        }
        assert_eq!(studio.deck.recorded().script.len(), 1, "{back:?}");
        studio.apply(RunCommand::Act(back.clone()));
        studio.apply(ViewCommand::PointerDown(false));
        assert_eq!(studio.run().undoes(), None, "{back:?}");
        assert_eq!((studio.race().state_hash(), studio.deck.edits), (hash, edits), "{back:?}");
        assert_eq!(studio.deck.recorded().script.len(), 0, "{back:?}");
    }
}

#[test]
fn a_key_that_changes_the_tick_rate_shows_futures_for_a_second() {
    const FRAME_NS: i64 = 16_666_667;
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.advance(FRAME_NS);
    studio.apply(StageCommand::TickRate(Step::Previous));
    let frames = (0..200).take_while(|_| {
        studio.advance(FRAME_NS);
        shows_futures(&studio)
    });
    assert!((57..=61).contains(&frames.count()), "time runs, and they leave");
    let mut paused = Studio::new(Scene::built_in("spring").unwrap());
    paused.apply(StageCommand::Speed(Step::Next));
    assert!(!shows_futures(&paused), "another key shows none");
}
