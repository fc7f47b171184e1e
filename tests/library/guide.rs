//! The guide: exactly its keys complete every stop, and its claims are true.

use regatta::loops::loop_lab::{LoopCommand, LoopLab};
use regatta::measure::cloud::{CloudChoice, CloudShape, CloudWorker};
use regatta::measure::{Judge, OneStep, Outcome, Verdict};
use regatta::run::past::Quantity;
use regatta::run::{METRICS, Race};
use regatta::scene::{LaneSpec, SCENES, Scene};
use regatta::sim::integrators::method;
use regatta::studio::guide::{Goal, STOPS};
use regatta::studio::{
    Command, Instrument, KEYS, Key, RunCommand, StageCommand, Step, Studio, ViewCommand,
    command_for, complete_clouds, one_step, run_loops, shown_cloud,
};
use regatta::tools::port;
use regatta::tools::port::{Wish, setups};

pub(crate) fn lab_at(stop: usize) -> Studio {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.apply(ViewCommand::GoToStop(stop));
    studio
}

/// A studio at a stop whose prediction is given.
pub(crate) fn lab_after_prediction(stop: usize) -> Studio {
    let mut studio = lab_at(stop);
    studio.apply(ViewCommand::Predict(0));
    studio
}

pub(crate) fn is_done(studio: &Studio) -> bool {
    studio.viewer.tour().expect("the guide is open").is_done()
}

#[test]
fn every_stop_opens_as_described_and_its_keys_complete_it() {
    for (index, stop) in STOPS.iter().enumerate() {
        let mut studio = lab_at(index);
        let tour = studio.viewer.tour().unwrap();
        assert_eq!((tour.index(), tour.guess(), tour.is_done()), (index, None, false));
        assert_eq!(studio.scene().name, stop.scene, "{}", stop.title);
        assert_eq!(studio.entries()[studio.active()].method.id, stop.method, "{}", stop.title);
        assert_eq!((studio.clock().tick_hz(), studio.mode()), (stop.tick_hz.into(), stop.mode));
        assert_eq!(studio.display().instrument, stop.instrument, "{}", stop.title);
        assert_eq!(studio.display().quantity, Some(stop.quantity), "{}", stop.title);
        let shown = METRICS[studio.display().metric].name;
        assert!(shown.starts_with(stop.quantity.name()), "{}: {shown}", stop.title);
        if stop.question.contains("speed") && stop.instrument == Instrument::Motion {
            assert_eq!(stop.quantity, Quantity::Velocity, "{}", stop.title);
        }
        let is_stepped = matches!(stop.goal, Goal::SteppedTo(_));
        assert_eq!((studio.race().tick(), studio.running()), (0, false));
        studio.apply(ViewCommand::Predict(stop.right));
        assert_eq!((studio.race().tick(), studio.running()), (0, !is_stepped));
        if !is_stepped {
            (0..5).for_each(|_| studio.tick());
        }
        assert!(!is_done(&studio), "{} is done before it begins", stop.title);
        assert!(!stop.keys.is_empty());
        for key in stop.keys {
            let (command, _) = command_for(*key).expect("a key of the table");
            studio.apply(command);
        }
        assert!(is_done(&studio), "{} is not done by its keys", stop.title);
        assert_eq!(studio.viewer.tour().unwrap().guess(), Some(stop.right));
        // The prediction was one.
        studio.apply(ViewCommand::Predict(0));
        assert_eq!(studio.viewer.tour().unwrap().guess(), Some(stop.right));
    }
}

#[test]
fn stops_name_existing_scenes_methods_and_keys() {
    for stop in STOPS {
        assert!(SCENES.iter().any(|scene| scene.name == stop.scene), "{}", stop.scene);
        assert!(method(stop.method).is_some(), "{}", stop.method);
        assert!(stop.right < stop.choices.len() && stop.choices.len() > 1, "{}", stop.title);
        if let Goal::Method(id) = stop.goal {
            assert!(method(id).is_some(), "{id}");
        }
        for text in [stop.question, stop.task, stop.answer] {
            assert_eq!(text.matches('`').count() % 2, 0, "{text}");
        }
        let asked: Vec<&str> = stop.task.split('`').skip(1).step_by(2).collect();
        let mut keys: Vec<String> = stop.keys.iter().map(ToString::to_string).collect();
        keys.dedup();
        assert_eq!(asked, keys, "{}: the keys of the task do it", stop.title);
        for key in stop.answer.split('`').skip(1).step_by(2) {
            let mut all = KEYS.iter().flat_map(|binding| binding.keys);
            assert!(all.any(|(known, _)| known.to_string() == key), "no key {key}");
        }
    }
}

#[test]
fn the_guide_closes_with_escape_and_reopens_at_the_same_stop() {
    let mut studio = lab_at(3);
    assert_eq!(studio.apply(ViewCommand::Escape), None);
    assert!(studio.viewer.tour().is_none());
    studio.apply(ViewCommand::ToggleGuide);
    assert_eq!(studio.viewer.tour().unwrap().index(), 3);
    assert_eq!(studio.scene().name, STOPS[3].scene);
    studio.apply(ViewCommand::GoToStop(usize::MAX));
    assert_eq!(studio.viewer.tour().unwrap().index(), STOPS.len() - 1);
}

pub(crate) fn place_of(goal: Goal) -> usize {
    STOPS.iter().position(|stop| stop.goal == goal).expect("a stop of this goal")
}

#[test]
fn the_text_of_a_stop_closes_with_its_scene_and_mode() {
    let index = place_of(Goal::Race);
    for elsewhere in [
        Command::Stage(StageCommand::SceneBeside(Step::Next)),
        Command::Stage(StageCommand::SceneBeside(Step::Previous)),
        Command::Stage(StageCommand::Scene(0)),
        Command::Loop(LoopCommand::ToggleLab),
    ] {
        let mut studio = lab_at(index);
        studio.apply(elsewhere.clone());
        assert!(studio.viewer.tour().is_none(), "{elsewhere:?}");
        let notice = studio.viewer.notice.as_deref().expect("the way back");
        assert!(notice.contains("F2"), "{notice}");
        studio.apply(ViewCommand::ToggleGuide);
        assert_eq!(studio.viewer.tour().map(|tour| tour.index()), Some(index));
        assert_eq!(studio.scene().name, STOPS[index].scene);
        assert!(studio.loop_lab().is_none());
    }
    // This stop is about the loop lab, and another scene in the loop lab does not leave it.
    let mut studio = lab_after_prediction(place_of(Goal::LoopLab));
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    assert!(is_done(&studio));
    studio.apply(StageCommand::SceneBeside(Step::Next));
    assert!(studio.loop_lab().is_some() && studio.viewer.tour().is_none());
}

#[test]
fn the_guide_visits_the_explaining_instruments_and_the_loop_lab() {
    let visits = |instrument: Instrument| {
        let mut stops = STOPS.iter();
        stops.any(|stop| stop.instrument == instrument || stop.goal == Goal::Instrument(instrument))
    };
    for instrument in [
        Instrument::OneStep,
        Instrument::StabilityMap,
        Instrument::Cloud,
        Instrument::Energy,
        Instrument::Phase,
        Instrument::Polhode,
        Instrument::Cost,
        Instrument::Error,
    ] {
        assert!(visits(instrument), "{}", instrument.name());
    }
    assert!(STOPS.iter().any(|stop| stop.goal == Goal::LoopLab));
}

#[test]
fn the_area_of_the_pendulum_cloud_matches_the_guide() {
    let mut studio =
        lab_after_prediction(STOPS.iter().position(|s| s.instrument == Instrument::Cloud).unwrap());
    studio.apply(StageCommand::ToggleRace);
    let shape = CloudShape::default();
    studio.apply(RunCommand::Cloud(CloudChoice { shape, points: 10_000 }));
    // 1.25 s.
    (0..15).for_each(|_| studio.tick());
    complete_clouds(&mut studio, &mut CloudWorker::default(), || false);
    let lanes = &shown_cloud(&studio).unwrap().picture.as_ref().unwrap().lanes;
    let areas: Vec<f64> = lanes.iter().map(|lane| lane.area_ratio.unwrap()).collect();
    assert!((1.4..1.7).contains(&areas[0]), "{areas:?}");
    assert!(areas[1] < 0.6, "{areas:?}");
    assert!((areas[2] - 1.0).abs() < 0.05, "{areas:?}");
}

fn verdict(scene: &str, id: &str, tick_hz: u32) -> Verdict {
    let judge = Judge::new(&Scene::built_in(scene).unwrap());
    judge.verdict(LaneSpec::plain(method(id).unwrap()), tick_hz)
}

/// The ship's speed after 8.5 s under this method, its exact speed, and the evaluations made.
fn ship(id: &str, tick_hz: u32) -> (f64, f64, u64) {
    let mut scene = Scene::built_in("ship").unwrap();
    scene.tick_hz = tick_hz.into();
    let lane = LaneSpec::plain(method(id).unwrap());
    let mut race = Race::new(&scene, [lane]);
    race.run(u64::from(tick_hz) * 17 / 2);
    let body = &race.entrants()[0].lane.bodies()[0];
    let exact = race.truth().bodies()[0].stepper.v()[0];
    (body.stepper.v()[0], exact, body.stepper.evaluations())
}

/// The error of the ship's speed after 8.5 s, in percent.
fn error_percent(id: &str, tick_hz: u32) -> f64 {
    let (speed, exact, _) = ship(id, tick_hz);
    100.0 * (speed - exact) / exact
}

#[test]
fn the_ship_reaches_20_m_per_s() {
    let mut race = Race::of_scene(&Scene::built_in("ship").unwrap());
    race.run(120);
    let speed = race.truth().bodies()[0].stepper.v()[0];
    assert!((19.9..20.0).contains(&speed), "{speed}");
}

#[test]
fn the_errors_on_the_ship_match_the_guide() {
    let (speed, exact, _) = ship("explicit-euler", 2);
    assert_eq!((format!("{speed:.2}"), format!("{exact:.2}")), ("11.64".into(), "11.45".into()));
    let euler = error_percent("explicit-euler", 2);
    assert!((1.55..1.65).contains(&euler), "{euler}");
    // 8.4 s are whole ticks at 5 Hz, and 8.5 s at 2 Hz: nearly the same time.
    let ratio = euler / error_percent("explicit-euler", 5);
    assert!((2.3..2.8).contains(&ratio), "{ratio}");
    let improved = error_percent("improved-euler", 2).abs();
    assert!((0.025..0.035).contains(&improved), "{improved}");
    assert!((50.0..70.0).contains(&(euler / improved)), "{}", euler / improved);
    let mut scene = Scene::built_in("ship").unwrap();
    scene.tick_hz = 2.into();
    let mut race = Race::new(&scene, [LaneSpec::plain(method("explicit-euler").unwrap())]);
    race.run(17);
    let position = |lane: &regatta::run::Lane| lane.bodies()[0].stepper.q()[0];
    assert!(position(&race.entrants()[0].lane) < position(race.truth()), "it is behind");
    let rk4 = error_percent("rk4", 2).abs();
    assert!((3e-6..5e-6).contains(&rk4), "{rk4}");
}

#[test]
fn adaptive_euler_costs_more_on_the_ship_and_is_more_accurate() {
    let (plain, adaptive) = (ship("explicit-euler", 2), ship("adaptive-euler", 2));
    assert!(adaptive.2 > 2 * plain.2, "{} {}", adaptive.2, plain.2);
    assert!((adaptive.0 - adaptive.1).abs() < 0.1 * (plain.0 - plain.1).abs());
}

#[test]
fn improved_euler_is_the_cheapest_within_a_hundredth_on_the_ship() {
    let lanes = Scene::built_in("ship").unwrap().lanes;
    let accurate = lanes
        .iter()
        .map(|lane| lane.method)
        .filter(|method| verdict("ship", method.id, 2).outcome() <= Outcome::Accurate);
    let cheapest = accurate.min_by_key(|m| m.evaluations.unwrap_or(u32::MAX)).unwrap();
    assert_eq!((cheapest.id, cheapest.evaluations), ("improved-euler", Some(2)));
}

#[test]
fn the_ships_settle_only_at_half_the_step() {
    let run = |tick_hz: u32, seconds: u64| -> Vec<f64> {
        let mut scene = Scene::built_in("surge").unwrap();
        scene.tick_hz = tick_hz.into();
        let mut race = Race::of_scene(&scene);
        race.run(u64::from(tick_hz) * seconds);
        let bodies = race.entrants()[0].lane.bodies().iter();
        bodies.map(|body| (body.stepper.v()[0] - 20.0).abs()).collect()
    };
    let coarse = run(1, 30);
    assert!(coarse[0] < 0.1 && (19.0..21.0).contains(&coarse[1]) && coarse[2] > 80.0, "{coarse:?}");
    assert!(run(2, 30).iter().all(|off| *off < 1e-3));
}

#[test]
fn the_verdicts_on_the_springs_match_the_guide() {
    let outcome = |scene: &str, id: &str, hz: u32| verdict(scene, id, hz).outcome();
    for hz in [60, 100, 1000] {
        assert_eq!(outcome("spring", "explicit-euler", hz), Outcome::Grows, "{hz}");
    }
    let (at_60, at_100) =
        (verdict("spring", "explicit-euler", 60), verdict("spring", "explicit-euler", 100));
    assert!(at_100.long_term.doubles_in_s > at_60.long_term.doubles_in_s);
    let held = verdict("spring", "semi-implicit-euler", 60);
    assert_eq!(held.long_term.is_bounded, Some(true));
    assert!(
        held.comparison().unwrap().frequency_error.is_some_and(|error| error > 0.0),
        "a little too fast"
    );
    assert_eq!(verdict("stiff", "semi-implicit-euler", 60).long_term.is_bounded, Some(true));
    assert_eq!(verdict("stiff", "semi-implicit-euler", 50).long_term.is_bounded, Some(true));
    for hz in [49, 30] {
        assert_eq!(outcome("stiff", "semi-implicit-euler", hz), Outcome::BlewUp);
    }
    for hz in [60, 30, 2] {
        let implicit = verdict("stiff", "implicit-euler", hz);
        assert_eq!(implicit.long_term.is_bounded, Some(true), "{hz}");
    }
    let implicit = verdict("stiff", "implicit-euler", 30);
    assert_eq!(implicit.outcome(), Outcome::DiesAway);
    assert!(
        implicit.long_term.halves_in_s.is_some_and(|s| s < 0.2),
        "{:?}",
        implicit.long_term.halves_in_s
    );
}

#[test]
fn runge_kutta_reaches_rounding_on_the_ship_where_more_ticks_stop_helping() {
    assert_eq!(verdict("ship", "rk4", 2).outcome(), Outcome::Accurate);
    assert_eq!(verdict("ship", "rk4", 30).outcome(), Outcome::Rounding);
    let [fine, finest] = [240, 10_000].map(|hz| error_percent("rk4", hz).abs());
    // Truncation alone would be three million times smaller.
    assert!(finest > 0.1 * fine, "{fine} {finest}");
}

#[test]
fn each_step_of_explicit_euler_makes_the_swing_18_percent_wider_at_10_hz() {
    let mut studio = lab_after_prediction(place_of(Goal::SteppedTo(3)));
    let omega = std::f64::consts::TAU;
    let swing = |[q, v]: [f64; 2]| q.hypot(v / omega);
    for _ in 0..4 {
        let OneStep { from, landing, .. } = one_step(&studio).expect("a next step");
        let wider = swing(landing.expect("it lands")) / swing(from);
        assert!((1.175..1.185).contains(&wider), "{wider}");
        studio.apply(StageCommand::Tick(Step::Next));
    }
}

#[test]
fn only_semi_implicit_euler_keeps_the_energy_to_5_percent() {
    let drifts = |id: &str, seconds: u64| {
        let scene = Scene::built_in("spring").unwrap();
        let mut race = Race::new(&scene, [LaneSpec::plain(method(id).unwrap())]);
        let energy = |race: &Race| race.entrants()[0].lane.bodies()[0].stepper.energy().unwrap();
        let start = energy(&race);
        (0..60 * seconds).fold(0.0_f64, |most, _| {
            race.run(1);
            most.max((energy(&race) / start - 1.0).abs())
        })
    };
    let [second, minute] = [1, 60].map(|seconds| drifts("semi-implicit-euler", seconds));
    assert!(
        (0.045..0.056).contains(&second) && (0.045..0.056).contains(&minute),
        "{second} {minute}"
    );
    assert!(drifts("explicit-euler", 1) > 0.5);
}

#[test]
fn a_spring_4_times_as_stiff_needs_2_times_the_tick_rate() {
    let is_bounded = |stiffness: f64, hz: u32| {
        let mut scene = Scene::built_in("stiff").unwrap();
        let body = &mut scene.bodies[0];
        let key = "stiffness_n_per_m";
        let index = body.kind.parameters.iter().position(|it| it.key == key).unwrap();
        body.values[index] *= stiffness;
        let spec = LaneSpec::plain(method("semi-implicit-euler").unwrap());
        Judge::new(&scene).verdict(spec, hz).long_term.is_bounded
    };
    assert_eq!([49, 50].map(|hz| is_bounded(1.0, hz)), [Some(false), Some(true)]);
    assert_eq!([99, 100].map(|hz| is_bounded(4.0, hz)), [Some(false), Some(true)]);
}

#[test]
fn the_fixed_loop_judders_by_12_ms_and_whole_refreshes_do_not() {
    let mut studio = lab_after_prediction(place_of(Goal::LoopLab));
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    run_loops(&mut studio);
    let loops: &LoopLab = studio.loop_lab().expect("it opens");
    assert_eq!(loops.slowness(), 8);
    let shown: Vec<(&str, f64)> = loops
        .on_stage()
        .iter()
        .map(|&index| &loops.lanes()[index])
        .map(|lane| (&*lane.card().id, lane.report().unwrap().animation_error_rms_ms.unwrap()))
        .collect();
    let [("fixed", fixed), ("whole-refresh", whole)] = shown[..] else { panic!("{shown:?}") };
    assert!((11.5..12.5).contains(&fixed) && whole < 1e-6, "{shown:?}");
}

#[test]
fn only_engines_with_ported_settings_swing_alike() {
    let scene = Scene::built_in("alike").unwrap();
    let [mass_kg, stiffness, damping, ..] = scene.bodies[0].values[..] else { panic!() };
    let omega = (stiffness / mass_kg).sqrt();
    let frequency_hz = omega / std::f64::consts::TAU;
    let wish = Wish { frequency_hz, damping_ratio: damping / mass_kg / 2.0 / omega, mass_kg };
    let mut race = Race::of_scene(&scene);
    let mut off = vec![0.0_f64; scene.lanes.len()];
    for _ in 0..180 {
        race.run(1);
        let truth = race.truth().bodies()[0].stepper.q()[0];
        for (off, entrant) in off.iter_mut().zip(race.entrants()) {
            *off = off.max((entrant.lane.bodies()[0].stepper.q()[0] - truth).abs());
        }
    }
    for (spec, off) in scene.lanes.iter().zip(off) {
        let Some(told) = spec.joint else {
            // MuJoCo has the requested damping, but its swing is a little fast.
            let most = if spec.method.id == "engine-mujoco" { 0.02..0.08 } else { 0.08..0.4 };
            assert!(most.contains(&off), "{} is off by {off}", spec.method.id);
            continue;
        };
        assert!(off < 0.07, "{} is off by {off}", spec.method.id);
        let setup = setups(Some(&[spec.method]), 60.0, None)[0];
        let found = port(&wish, setup).unwrap();
        let [stiffness, damping] = setup.mode.joint(found.values, mass_kg);
        let omega = stiffness.sqrt();
        let [hz, ratio] = [omega / std::f64::consts::TAU, damping / 2.0 / omega];
        assert!((told.frequency_hz - hz).abs() < 1e-9, "{found:?}");
        assert!((told.damping_ratio - ratio).abs() < 1e-9, "{found:?}");
    }
}

#[test]
fn engines_damp_a_spring_as_the_guide_says() {
    let kept = |id: &str, substeps: u32, seconds: u64, scene: &str| {
        let mut scene = Scene::built_in(scene).unwrap();
        scene.bodies.truncate(1);
        let spec = LaneSpec { substeps, ..LaneSpec::plain(method(id).unwrap()) };
        let mut race = Race::new(&scene, [spec]);
        race.run(60 * seconds);
        let stepper = &race.entrants()[0].lane.bodies()[0].stepper;
        let omega = std::f64::consts::TAU;
        stepper.q()[0].hypot(stepper.v()[0] / omega)
    };
    let engine = |id: &str| kept(id, method(id).unwrap().default_substeps, 4, "engines");
    assert!((0.45..0.55).contains(&engine("engine-box2d")));
    let said = verdict("engines", "engine-box2d", 60).to_string();
    let stop = STOPS.iter().find(|stop| stop.scene == "engines").unwrap();
    assert!(said.contains("swing ½ in 4.2 s"), "{said}");
    assert!(stop.answer.contains("the swing is halved in 4.2 s"), "{}", stop.answer);
    for id in ["engine-jolt", "engine-physx"] {
        assert!(engine(id) < 0.3, "{id}");
    }
    for id in ["engine-bullet", "engine-chipmunk", "engine-mujoco"] {
        assert!((0.98..1.02).contains(&engine(id)), "{id}");
    }
    let held = [1, 4, 8].map(|substeps| kept("held-force", substeps, 6, "held-force"));
    assert!((0.98..1.02).contains(&held[0]) && (1.9..2.3).contains(&held[1]), "{held:?}");
    assert!(held[2] > held[1], "{held:?}");
}

/// The studio at a stop, a tick into it, after its keys.
fn after_its_keys(title: &str) -> Studio {
    let at = STOPS.iter().position(|stop| stop.title == title).expect("a stop");
    let mut studio = lab_after_prediction(at);
    studio.tick();
    for key in STOPS[at].keys {
        let (command, _) = command_for(*key).expect("a key of the table");
        studio.apply(command);
    }
    studio
}

#[test]
fn the_answer_of_a_stop_matches_its_verdict() {
    use Outcome::{Accurate, BlewUp, Bounded, DiesAway, Grows, LooksRight, Rounding};
    for (title, outcome) in [
        ("The spring that Euler blows up", Grows),
        ("The same lines in another order", LooksRight),
        ("A stiff spring", BlewUp),
        ("The stability map", Bounded),
        ("Implicit methods", DiesAway),
        ("Round-off", Rounding),
        ("Runge-Kutta", Accurate),
    ] {
        let studio = after_its_keys(title);
        assert!(is_done(&studio), "{title}");
        let spec = studio.entries()[studio.active()];
        let judge = Judge::new(studio.scene());
        let found = judge.verdict(spec, studio.clock().tick_hz());
        assert_eq!(found.outcome(), outcome, "{title}: {found}");
    }
}

#[test]
fn of_the_steps_of_the_coin_one_tips_it_over_and_two_follow_the_truth() {
    let found = |id: &str| verdict("coin", id, 60);
    let rescaled = found("gyro-rescaled");
    assert_eq!(rescaled.outcome(), Outcome::Grows);
    let words = rescaled.to_string();
    assert!(words.contains("tips over at 0.6 s, energy ×1.96 in 5 s"), "{words}");
    assert!(!found("engine-bullet").to_string().contains("tips over"));
    for id in ["gyro-rotated", "split-3"] {
        let outcome = found(id).outcome();
        assert!(matches!(outcome, Outcome::Accurate | Outcome::Rounding), "{id}: {outcome:?}");
    }
}

#[test]
fn a_stop_asking_for_home_is_done_only_by_a_restarted_run() {
    let asks = |stop: &&regatta::studio::guide::Stop| stop.keys.last() == Some(&Key::Home);
    let count = STOPS.iter().filter(asks).count();
    assert!(count >= 9, "{count}");
    for (index, stop) in STOPS.iter().enumerate().filter(|(_, stop)| asks(stop)) {
        let mut studio = lab_after_prediction(index);
        studio.tick();
        let (home, keys) = stop.keys.split_last().unwrap();
        for key in keys {
            studio.apply(command_for(*key).unwrap().0);
        }
        assert!(!is_done(&studio), "{}: its verdict is of another run", stop.title);
        studio.apply(command_for(*home).unwrap().0);
        assert!(is_done(&studio) && studio.race().tick() == 0, "{}", stop.title);
    }
}

#[test]
fn the_pendulum_of_the_guide_goes_over_the_top_in_its_fourth_half_swing() {
    let mut studio =
        lab_after_prediction(STOPS.iter().position(|s| s.instrument == Instrument::Phase).unwrap());
    let state = |studio: &Studio| {
        let stepper = &studio.race().entrants()[0].lane.bodies()[0].stepper;
        (stepper.q()[0], stepper.v()[0])
    };
    let (mut before, mut ends) = (state(&studio), Vec::new());
    while before.0.abs() < std::f64::consts::PI && studio.race().t() < 20.0 {
        studio.tick();
        let now = state(&studio);
        if before.1 * now.1 < 0.0 {
            ends.push(now.0.abs());
        }
        before = now;
    }
    assert!(ends.len() == 3 && ends.is_sorted() && ends[0] > 2.8, "{ends:?}");
    assert!((9.2..9.8).contains(&studio.race().t()), "{} s", studio.race().t());
    studio.apply(StageCommand::TickHz(60.into()));
    studio.apply(StageCommand::Restart);
    while state(&studio).0.abs() < std::f64::consts::PI && studio.race().t() < 3.0 {
        studio.tick();
        assert!(studio.race().tick() < 2 || state(&studio).1 < 0.0, "the first half swing");
    }
    assert!(state(&studio).0.abs() > std::f64::consts::PI);
}

#[test]
fn lanes_with_ported_settings_stay_within_8_percent_of_the_ghost() {
    let scene = Scene::built_in("alike").unwrap();
    let mut race = Race::of_scene(&scene);
    let mut most = 0.0_f64;
    while race.t() < scene.seconds {
        race.run(1);
        let truth = race.truth().bodies()[0].stepper.q()[0];
        for entrant in &race.entrants()[3..6] {
            most = most.max((entrant.lane.bodies()[0].stepper.q()[0] - truth).abs());
        }
    }
    assert!((0.03..0.08).contains(&most), "{most} of a swing of 1 m");
}

#[test]
fn explicit_euler_never_shrinks_the_cloud_of_the_guide_below_its_start() {
    let mut studio =
        lab_after_prediction(STOPS.iter().position(|s| s.instrument == Instrument::Cloud).unwrap());
    studio.apply(RunCommand::Cloud(CloudChoice { shape: CloudShape::default(), points: 10_000 }));
    let mut worker = CloudWorker::default();
    let mut areas = Vec::new();
    for _ in 0..6 {
        (0..12).for_each(|_| studio.tick());
        complete_clouds(&mut studio, &mut worker, || false);
        let lanes = &shown_cloud(&studio).unwrap().picture.as_ref().unwrap().lanes;
        areas.push(lanes[0].area_ratio.unwrap());
    }
    let most = areas.iter().copied().fold(0.0, f64::max);
    // It is down again after it was up, where pendulums are over the top.
    assert!(areas.iter().all(|area| *area > 1.0) && (1.8..2.2).contains(&most), "{areas:?}");
    assert!(areas[5] < most, "{areas:?}");
}
