//! Verdicts are of the run on the stage: of the scene as it is edited, and from the last change on.

use regatta::measure::{Judge, VISIBLE};
use regatta::scene::{Action, Scene, Scripted};
use regatta::studio::{RunCommand, StageCommand, Step, Studio};

use crate::scenes::edited;

use crate::words::everything;

/// A studio on a scene in which every method has a lane, so that all are judged.
fn opened(scene: &Scene) -> Studio {
    Studio::new(edited(scene, |scene| scene.lanes = scene.method_list()))
}

/// The studio's verdict on each method of its list, with times that count from where the run is judged.
fn verdicts(studio: &mut Studio) -> Vec<String> {
    studio.analyse();
    let of = |entry| {
        let mut verdict = studio.viewer.verdict(entry).unwrap().clone();
        verdict.starts_at_s = 0.0;
        everything(&verdict)
    };
    (0..studio.entries().len()).map(of).collect()
}

/// The time of the run at which the judged part begins, by the first verdict.
fn starts_at_s(studio: &mut Studio) -> f64 {
    studio.analyse();
    studio.viewer.verdict(0).unwrap().starts_at_s
}

/// The judge's verdict on each method of the scene's list.
fn verdicts_on(scene: &Scene) -> Vec<String> {
    let judge = Judge::new(scene);
    let specs = scene.method_list();
    specs.iter().map(|spec| everything(&judge.verdict(*spec, scene.tick_hz))).collect()
}

/// The place of the parameter with this key, of the first body.
fn parameter(scene: &Scene, key: &str) -> usize {
    scene.bodies[0].kind.parameter(key).unwrap().0
}

/// The scene with these parameters of its first body.
fn with(mut scene: Scene, values: &[(&str, f64)]) -> Scene {
    for (key, value) in values {
        let place = parameter(&scene, key);
        scene.bodies[0].values[place] = *value;
    }
    scene
}

/// The state of the first body in truth.
fn truth(studio: &Studio) -> (f64, f64) {
    let stepper = &studio.race().truth().bodies()[0].stepper;
    (stepper.q()[0], stepper.v()[0])
}

#[test]
fn an_edited_parameter_gives_the_verdicts_of_the_edited_body() {
    let mut studio = opened(&Scene::built_in("spring").unwrap());
    let before = verdicts(&mut studio);
    (0..100).for_each(|_| studio.tick());
    // The lane is in the true state, from which all are judged then.
    studio.apply(RunCommand::Act(Action::Place { body: 0, q: [0.5].into(), v: [0.1].into() }));
    let stiffness = parameter(studio.scene(), "stiffness_n_per_m");
    studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: stiffness, value: 10_000.0 }));
    let (x, v) = truth(&studio);
    let stiff = [("stiffness_n_per_m", 10_000.0), ("x0_m", x), ("v0_m_per_s", v)];
    let stiff = with(Scene::built_in("spring").unwrap(), &stiff);
    let after = verdicts(&mut studio);
    assert_eq!(after, verdicts_on(&stiff));
    assert_eq!(starts_at_s(&mut studio), 100.0 / 60.0);
    assert_ne!(after, before);
}

#[test]
fn a_parameter_set_by_hand_is_judged_without_the_scripts_changes_to_it() {
    let mut scene = Scene::built_in("spring").unwrap();
    let parameter = parameter(&scene, "stiffness_n_per_m");
    let set = |value| Action::Set { body: 0, parameter, value };
    scene.script.push(Scripted { at_s: 5.0, action: set(4.0) });
    let mut studio = opened(&scene);
    studio.apply(RunCommand::Act(set(90.0)));
    scene.script.clear();
    let edited = with(scene, &[("stiffness_n_per_m", 90.0)]);
    assert_eq!(verdicts(&mut studio), verdicts_on(&edited));
}

/// A spring whose damping the script sets from 4 to 60 after a second.
fn damped_by_script() -> Scene {
    let mut scene = with(Scene::built_in("spring").unwrap(), &[("damping_n_s_per_m", 4.0)]);
    let parameter = parameter(&scene, "damping_n_s_per_m");
    let action = Action::Set { body: 0, parameter, value: 60.0 };
    scene.script = vec![Scripted { at_s: 1.0, action }];
    scene
}

#[test]
fn a_parameter_set_by_the_script_is_judged_like_one_set_by_hand() {
    let scene = damped_by_script();
    let mut scripted = opened(&scene);
    let mut by_hand = opened(&edited(&scene, |scene| scene.script.clear()));
    let before = verdicts(&mut scripted);
    assert_ne!(before, verdicts(&mut by_hand), "the script is part of what is judged");
    (0..61).for_each(|_| scripted.tick());
    (0..60).for_each(|_| by_hand.tick());
    by_hand.apply(RunCommand::Act(scene.script[0].action.clone()));
    let after = verdicts(&mut scripted);
    assert_eq!(after, verdicts(&mut by_hand));
    assert_ne!(after, before);
    scripted.apply(RunCommand::Seek(59));
    assert_eq!(verdicts(&mut scripted), before);
}

#[test]
fn growth_uses_the_parameters_left_by_the_script() {
    let damped = with(damped_by_script(), &[("damping_n_s_per_m", 60.0)]);
    let edited = edited(&damped, |scene| scene.script.clear());
    let grows = |scene: &Scene| {
        let verdicts = verdicts_on(scene).into_iter();
        verdicts.map(|verdict| verdict.contains("deviation ×2 in")).collect::<Vec<_>>()
    };
    let grown = grows(&edited);
    assert_eq!(grows(&damped_by_script()), grown);
    assert!(grown.contains(&true) && grown.contains(&false));
}

#[test]
fn a_body_placed_by_hand_is_judged_from_where_it_was_placed() {
    let mut studio = opened(&Scene::built_in("pendulum").unwrap());
    let before = verdicts(&mut studio);
    (0..77).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Place { body: 0, q: [0.1].into(), v: [0.5].into() }));
    let (theta, omega) = ("theta0_rad", "omega0_rad_per_s");
    let placed = with(Scene::built_in("pendulum").unwrap(), &[(theta, 0.1), (omega, 0.5)]);
    let after = verdicts(&mut studio);
    assert_eq!(after, verdicts_on(&placed));
    assert_ne!(after, before);
    // Time that passes changes nothing; going back before the placement does, and forward again.
    let question = studio.analysis_request();
    studio.apply(StageCommand::Tick(Step::Next));
    assert!(studio.analysis_request() == question);
    studio.apply(RunCommand::Seek(50));
    assert_eq!(verdicts(&mut studio), before);
    studio.apply(RunCommand::Seek(78));
    assert!(studio.analysis_request() == question);
    studio.apply(StageCommand::Restart);
    assert_eq!(verdicts(&mut studio), before);
}

#[test]
fn a_body_placed_at_rest_is_judged_at_rest() {
    let mut studio = opened(&Scene::built_in("spring").unwrap());
    studio.tick();
    studio.apply(RunCommand::Act(Action::Place { body: 0, q: [0.0].into(), v: [0.0].into() }));
    for verdict in verdicts(&mut studio) {
        assert!(verdict.starts_with("accurate · within 10⁻"), "{verdict}");
    }
}

#[test]
fn a_kicked_body_is_judged_from_its_state_after_the_kick() {
    let mut studio = opened(&Scene::built_in("spring").unwrap());
    (0..130).for_each(|_| studio.tick());
    assert_eq!(starts_at_s(&mut studio), 0.0);
    let before = truth(&studio).1;
    studio.apply(RunCommand::Act(Action::Kick(3.0)));
    assert_ne!(truth(&studio).1, before);
    // Explicit Euler is off by now, so that any method that a key picks goes on too wide.
    let off = verdicts(&mut studio);
    assert!(off[0].contains("1.5 × too wide at "), "{}", off[0]);
    for other in [1, 3] {
        let said = &off[other];
        assert!(said.starts_with("stays ±1.1") && said.contains("(exact ±0.755)"), "{said}");
    }
    assert_eq!(starts_at_s(&mut studio), 130.0 / 60.0);
    studio.apply(RunCommand::Act(Action::Place { body: 0, q: [0.5].into(), v: [0.1].into() }));
    studio.apply(RunCommand::Act(Action::Kick(3.0)));
    let (x, v) = truth(&studio);
    let kicked = Scene::built_in("spring").unwrap();
    let kicked = with(kicked, &[("x0_m", x), ("v0_m_per_s", v)]);
    assert_eq!(verdicts(&mut studio), verdicts_on(&kicked));
}

#[test]
fn a_run_judged_from_a_placement_keeps_throttle_and_remaining_script() {
    let scripted = |times: &[(f64, f64)]| {
        let row = |&(at_s, part)| Scripted { at_s, action: Action::Throttle(part) };
        let script = times.iter().map(row).collect();
        edited(&Scene::built_in("ship").unwrap(), |scene| scene.script = script)
    };
    let hz = u64::from(scripted(&[]).tick_hz.whole_hz().unwrap());
    let mut studio = opened(&scripted(&[(1.0, 0.5), (9.0, -0.25)]));
    (0..2 * hz).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Place { body: 0, q: [10.0].into(), v: [3.0].into() }));
    let rest = scripted(&[(0.0, 0.5), (7.0, -0.25)]);
    let rest = with(rest, &[("s0_m", 10.0), ("v0_m_per_s", 3.0)]);
    assert_eq!(verdicts(&mut studio), verdicts_on(&rest));
    // A throttle by hand stays, and cancels the script's later throttles.
    studio.apply(RunCommand::Act(Action::Throttle(0.8)));
    let by_hand = with(scripted(&[(0.0, 0.8)]), &[("s0_m", 10.0), ("v0_m_per_s", 3.0)]);
    assert_eq!(verdicts(&mut studio), verdicts_on(&by_hand));
}

#[test]
fn a_pulled_body_that_is_far_off_for_no_shift_in_time_does_not_look_right() {
    // Already on the kerb, since a motion that a clock drives is judged from the start alone.
    let text = Scene::built_in("quarter-car").unwrap().to_toml();
    let on_kerb = text.replace("kerb*clamp((t-1)/0.05, 0, 1)", "kerb");
    assert_ne!(text, on_kerb);
    let mut scene = Scene::parse("on the kerb", &on_kerb).unwrap();
    for hz in [100, 200] {
        scene.tick_hz = hz.into();
        let mut studio = Studio::new(scene.clone());
        (0..244).for_each(|_| studio.tick());
        for left in (1..=60).rev() {
            let by = [0.02 * f64::from(left) / 60.0, 0.0].into();
            studio.apply(RunCommand::Act(Action::Push { body: 0, by }));
            studio.tick();
        }
        studio.analyse();
        let mut far = 0;
        for entry in 0..studio.entries().len() {
            let Some(verdict) = studio.viewer.verdict(entry) else { continue };
            let Some(found) = verdict.comparison() else { continue };
            let is_far = found.early_s.is_none() && found.error > 2.0 * VISIBLE;
            far += usize::from(is_far);
            assert!(!is_far || found.looks_right == Some(false), "{hz} Hz: {verdict}");
            let is_early = verdict.to_string().contains(" after 5 s");
            assert!(!is_early || found.error < 0.1, "{hz} Hz: {verdict}");
        }
        assert!((1..=4).contains(&far), "{hz} Hz: {far}");
    }
}
