//! The built-in scenes behave as their texts describe.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use regatta::measure::Judge;
use regatta::scene::{Action, LaneSpec, SCENES, Scene, SceneBody};
use regatta::sim::bodies::{Body, Chain};
use regatta::sim::integrators::{GENERAL_METHODS, method};
use regatta::sim::{Solver, Stepper};
use regatta::studio::{StageCommand, Studio, TICK_LADDER};

use super::built_in;

/// The body's state after `ticks` ticks at `tick_hz`, and the largest |q| on the way.
fn run(body: &SceneBody, solver: Solver, tick_hz: u32, ticks: u32) -> (Box<dyn Stepper>, f64) {
    let mut stepper = (body.kind.build)(&body.values, solver);
    let mut largest = stepper.q()[0].abs();
    for tick in 0..ticks {
        let hz = f64::from(tick_hz);
        stepper.advance(f64::from(tick) / hz, 1.0 / hz, 1).unwrap();
        largest = largest.max(stepper.q()[0].abs());
    }
    (stepper, largest)
}

fn with(id: &str) -> Solver {
    Solver::Method(method(id).unwrap())
}

#[test]
fn every_built_in_scene_parses_and_has_methods_and_a_hint() {
    for scene in SCENES {
        let parsed = built_in(scene.name);
        assert_eq!(parsed.name, scene.name);
        let has_texts = !parsed.about.is_empty() && parsed.hint.is_some();
        assert!(has_texts, "{}: write an `about` and a `hint`", scene.name);
        // Few enough to distinguish, and each with a digit key.
        assert!((2..=9).contains(&parsed.lanes.len()), "{}", scene.name);
        // By name, so that a new method changes no scene.
        let is_named =
            ["\nmethods = [", "\n[[lane]]\n"].iter().any(|list| scene.text.contains(list));
        assert!(is_named, "{}", scene.name);
        let is_of_engines = parsed.lanes.iter().all(|lane| lane.method.is_engine());
        let has_first = parsed.lanes.iter().any(|lane| lane.method == &GENERAL_METHODS[0]);
        // The methods of a free rotation are compared with engines.
        let is_of_spin = parsed.lanes.iter().any(|lane| lane.method.is_for_spin());
        assert!(is_of_engines || has_first || is_of_spin, "{}", scene.name);
    }
    assert!(Scene::built_in("no-such-scene").is_none());
}

#[test]
fn the_digit_keys_of_the_chapters_scenes_match_their_hints() {
    let ids = ["explicit-euler", "semi-implicit-euler", "improved-euler", "rk4", "adaptive-euler"];
    for name in ["harbour", "ship", "spring", "damped", "stiff"] {
        let lanes: Vec<_> = built_in(name).lanes.iter().map(|lane| lane.method.id).collect();
        assert_eq!(lanes, ids, "{name}");
    }
}

#[test]
fn the_built_in_scenes_are_the_files_of_their_folder() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut files: Vec<_> = names.map(|name| name.into_string().unwrap()).collect();
    files.sort();
    let mut listed: Vec<_> = SCENES.iter().map(|scene| format!("{}.toml", scene.name)).collect();
    listed.sort();
    assert_eq!(files, listed);
    listed.dedup();
    assert_eq!(listed.len(), SCENES.len(), "a name twice");
}

#[test]
fn the_ship_is_the_chapters_with_the_error_its_scene_states() {
    for name in ["ship", "harbour"] {
        let bodies = built_in(name).bodies;
        let ship = bodies.iter().find(|body| body.kind.id == "ship").unwrap();
        assert_eq!(ship.values[..3], [20_000.0, 1_000.0, 10_000.0]);
    }
    let scene = built_in("ship");
    assert_eq!(scene.tick_hz, 2);
    let body = &scene.bodies[0];
    let speed = |solver, ticks| run(body, solver, 2, ticks).0.v()[0];
    let exact = speed(Solver::Truth, 17);
    assert!((speed(with("explicit-euler"), 17) / exact - 1.016).abs() < 5e-4);
    assert!((speed(with("rk4"), 17) / exact - 1.0).abs() < 1e-6);
    let ticks = (scene.seconds * f64::from(scene.tick_hz)) as u32;
    for lane in &scene.lanes {
        let reached = speed(Solver::Method(lane.method), ticks);
        assert!((reached - 20.0).abs() < 0.1, "{}: {reached} m/s", lane.method.id);
    }
}

#[test]
fn the_1_hz_spring_doubles_under_explicit_euler_as_described() {
    let scene = built_in("spring");
    let body = &scene.bodies[0];
    assert_eq!(body.values[..5], [1.0, 4.0 * PI * PI, 0.0, 1.0, 0.0]);
    let hz = scene.tick_hz.whole_hz().unwrap();
    let largest = |id, ticks| run(body, with(id), hz, ticks).1;
    let seconds = 20 * hz;
    let doublings = largest("explicit-euler", seconds).log2();
    assert!((20.0 / doublings - 2.1).abs() < 0.1, "doubles every {} s", 20.0 / doublings);
    assert!(largest("semi-implicit-euler", seconds) < 1.01);
}

#[test]
fn free_and_damped_springs_grow_only_under_explicit_euler() {
    let scenes = ["harbour", "damped"].map(built_in);
    for scene in &scenes {
        let spring = &scene.bodies[0];
        let hz = scene.tick_hz.whole_hz().unwrap();
        let largest = |solver| run(spring, solver, hz, 10 * hz).1;
        let grown = largest(with("explicit-euler"));
        assert!((5.0..50.0).contains(&grown), "{}: {grown} m", scene.name);
        assert!(largest(with("semi-implicit-euler")) < 1.1);
        assert!(largest(Solver::Truth) < 1.0 + 1e-9);
    }
    let [free, damped] =
        scenes.map(|scene| run(&scene.bodies[0], Solver::Truth, 1, 20).0.q()[0].abs());
    assert!((free - 1.0).abs() < 1e-6, "the free spring is back after 20 periods");
    assert!(damped < 1e-3, "the damped spring has come to rest");
}

#[test]
fn the_harbour_is_the_chapters_two_bodies() {
    let kinds: Vec<&str> = built_in("harbour").bodies.iter().map(|body| body.kind.id).collect();
    assert_eq!(kinds, ["spring", "ship"]);
}

#[test]
fn the_stiff_spring_is_bounded_at_60_hz_and_explodes_at_49() {
    let scene = built_in("stiff");
    let index = TICK_LADDER.iter().position(|hz| scene.tick_hz == *hz).unwrap();
    assert_eq!((TICK_LADDER[index], TICK_LADDER[index - 2]), (60, 49));
    let largest = |hz| run(&scene.bodies[0], with("semi-implicit-euler"), hz, 5 * hz).1;
    assert!(largest(60) < 2.0);
    assert!(largest(49) > 1e6);
}

#[test]
fn the_chapters_ships_settle_swing_or_diverge_under_explicit_euler() {
    let scene = built_in("surge");
    assert_eq!(scene.tick_hz, 1);
    let speeds = |body: usize, solver, hz: u32| {
        [1, 2, 3, 4, 29, 30].map(|n| run(&scene.bodies[body], solver, hz, n * hz).0.v()[0])
    };
    let euler = |body| speeds(body, with("explicit-euler"), 1);
    let near = |found: [f64; 6], wanted: [f64; 4], within: f64| {
        let pairs = found.iter().zip(wanted);
        assert!(pairs.clone().all(|(a, b)| (a - b).abs() < within), "{found:?}, {wanted:?}");
    };
    let [settles, swings, diverges] = [euler(0), euler(1), euler(2)];
    near(settles, [30.0, 15.0, 22.5, 18.75], 1e-9);
    assert!(settles[4..].iter().all(|v| (v - 20.0).abs() < 1e-3), "{settles:?}");
    near(swings, [40.0, 0.0, 40.0, 0.0], 1e-9);
    assert!(swings[4] > 39.99 && swings[5] < 0.01, "{swings:?}");
    near(diverges, [42.0, -4.2, 46.62, -9.282], 1e-9);
    assert!(diverges[4] > 300.0 && diverges[5] < -300.0, "{diverges:?}");
    for body in 0..3 {
        let at_2_hz = speeds(body, with("explicit-euler"), 2);
        assert!(at_2_hz.iter().all(|v| (v - 20.0).abs() < 5.01), "{at_2_hz:?}");
        assert!((at_2_hz[5] - 20.0).abs() < 1e-9);
        let exact = speeds(body, Solver::Truth, 1);
        assert!((exact[5] - 20.0).abs() < 1e-9);
    }
}

#[test]
fn the_chain_diverges_as_described() {
    let scene = built_in("chain");
    let body = &scene.bodies[0];
    let chain = Chain::default().with_parameters(&body.values);
    let hz = |n| chain.angular_frequency(n) / (2.0 * PI);
    assert!((hz(1) - 0.83).abs() < 0.01 && (hz(16) - 8.97).abs() < 0.01, "{} {}", hz(1), hz(16));
    let largest = |id, hz: u32, seconds: u32| run(body, with(id), hz, seconds * hz).1;
    assert!(largest("explicit-euler", 60, 3) > 1e6);
    assert!(largest("improved-euler", 60, 4) > 1e3);
    assert!(largest("semi-implicit-euler", 60, 20) < 1.0);
    // 2 / ω of the fastest mode is between these two rates.
    assert!(largest("semi-implicit-euler", 30, 20) < 2.0);
    assert!(largest("semi-implicit-euler", 20, 5) > 1e3);
    let index = |hz| TICK_LADDER.iter().position(|rung| *rung == hz).unwrap();
    assert_eq!(index(60) - index(20), 4, "four presses");
}

#[test]
fn the_pendulum_goes_over_the_top_as_described() {
    let scene = built_in("pendulum");
    let body = &scene.bodies[0];
    let largest = |solver| run(body, solver, 60, 20 * 60).1;
    assert!((PI - body.values[4] - 20f64.to_radians()).abs() < 0.01);
    assert!(run(body, with("explicit-euler"), 60, 3 * 60).1 > PI, "within seconds");
    for id in ["semi-implicit-euler", "rk4"] {
        assert!(largest(with(id)) < 2.9, "{id}");
    }
    assert!((largest(Solver::Truth) - 2.8).abs() < 1e-3);
}

#[test]
fn the_orbit_is_an_ellipse_of_6_s_and_strays_as_described() {
    let scene = built_in("orbit");
    let body = &scene.bodies[0];
    let after = |solver, seconds: u32| run(body, solver, 30, 30 * seconds).0;
    let start = after(Solver::Truth, 0);
    assert!((after(Solver::Truth, 6).place() - start.place()).length() < 1e-9);
    assert!((after(Solver::Truth, 3).place().x + 16.0).abs() < 1e-9, "farthest at a (1 + e)");
    let drift = |id, seconds| {
        let drift = after(with(id), seconds).energy().unwrap() - start.energy().unwrap();
        drift / start.energy().unwrap().abs()
    };
    // How far the axis has turned, in degrees.
    let turned = |id, seconds| {
        let stepper = after(with(id), seconds);
        let (&[x, y], &[vx, vy]) = (stepper.q(), stepper.v()) else { panic!("two coordinates") };
        let (r, momentum) = (libm::hypot(x, y), (x * vy - y * vx) / body.values[0]);
        libm::atan2(-vx * momentum - y / r, vy * momentum - x / r).to_degrees()
    };
    assert!(drift("explicit-euler", 12) > 0.5);
    assert!(drift("improved-euler", 30) > 0.05 && drift("improved-euler", 12) > 0.02);
    for seconds in [12, 18, 24, 30] {
        assert!(drift("semi-implicit-euler", seconds).abs() < 0.1);
        assert!((turned("semi-implicit-euler", seconds) - 7.3).abs() < 0.6);
        assert!(drift("rk4", seconds).abs() < 1e-4 && turned("rk4", seconds).abs() < 0.01);
    }
}

#[test]
fn the_helm_follows_its_script_and_methods_diverge_as_described() {
    let scene = built_in("helm");
    let rudder: Vec<_> = scene.script.iter().map(|scripted| scripted.action.clone()).collect();
    assert_eq!(rudder, [Action::Rudder(1.0), Action::Rudder(-1.0), Action::Rudder(0.0)]);
    let mut studio = Studio::new(scene.clone());
    studio.apply(StageCommand::ToggleRace);
    let heading = |studio: &Studio| studio.race().truth().bodies()[0].stepper.q()[2];
    let error = |studio: &Studio| {
        let [lane, truth] = [&studio.race().entrants()[0].lane, studio.race().truth()];
        (lane.bodies()[0].stepper.place() - truth.bodies()[0].stepper.place()).length()
    };
    let run_to = |studio: &mut Studio, tick| {
        while studio.race().tick() < tick {
            studio.tick();
        }
    };
    run_to(&mut studio, 15);
    assert!(heading(&studio) == 0.0 && error(&studio) < 0.5, "{}", error(&studio));
    run_to(&mut studio, 90);
    let left = heading(&studio);
    assert!(left > PI, "to the left");
    run_to(&mut studio, 170);
    assert!(heading(&studio) < left - PI / 2.0, "to the right");
    assert!(error(&studio) > 2.0, "{}", error(&studio));
}

/// The half-life in milliseconds under a method at a rate, by the verdict.
fn half_life_ms(scene: &Scene, id: &str, tick_hz: u32) -> f64 {
    let verdict = Judge::new(scene).verdict(LaneSpec::plain(method(id).unwrap()), tick_hz);
    1e3 * verdict.chase.expect("a target that stays").half_life_s.expect("it comes half-way")
}

#[test]
fn the_cameras_are_as_early_and_late_as_described() {
    let scene = built_in("follow");
    let wanted = 1e3 * 1.678_347 / 5.0;
    assert!((wanted - 336.0_f64).abs() < 0.5);
    let mut before = (f64::INFINITY, 0.0);
    for tick_hz in [15, 30, 60, 144] {
        for id in ["critically-damped-spring", "smooth-damp"] {
            let off = half_life_ms(&scene, id, tick_hz) - wanted;
            assert!(off.abs() < 1.0, "{id} at {tick_hz} Hz is off by {off} ms");
        }
        let [late, early] =
            ["implicit-spring", "explicit-euler"].map(|id| half_life_ms(&scene, id, tick_hz));
        assert!(wanted < late && late < before.0, "{late} ms at {tick_hz} Hz");
        assert!(before.1 < early && early < wanted, "{early} ms at {tick_hz} Hz");
        before = (late, early);
    }
    let scene = built_in("lerp");
    for tick_hz in [30, 60, 144] {
        let [lerp, euler] =
            ["lerp-dt", "explicit-euler"].map(|id| half_life_ms(&scene, id, tick_hz));
        assert!((lerp - euler).abs() < 1e-9, "{lerp} ms, {euler} ms");
    }
    let index = |hz| TICK_LADDER.iter().position(|rung| hz == *rung).unwrap();
    assert_eq!(index(60.into()) - index(scene.tick_hz), 3, "three presses");
}
