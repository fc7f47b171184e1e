use super::*;
use crate::sim::integrators::{GENERAL_METHODS, method};

const H: f64 = 1.0 / 60.0;

fn bits(stepper: &dyn Stepper) -> Vec<u64> {
    stepper.q().iter().chain(stepper.v()).map(|x| x.to_bits()).collect()
}

#[test]
fn a_tick_takes_one_equal_step_per_substep() {
    let scene = Scene::built_in("spring").unwrap();
    let body = &scene.bodies[0];
    for method in GENERAL_METHODS {
        let solver = Solver::Method(method);
        let mut lane = Lane::new(&scene, solver, 4);
        let mut by_hand = (body.kind.build)(&body.values, solver);
        for tick in 0..30 {
            let t = tick as f64 * H;
            lane.tick(tick, t, H);
            by_hand.advance(t, H, 4).unwrap();
        }
        let stepper = &*lane.bodies()[0].stepper;
        assert_eq!(bits(stepper), bits(&*by_hand), "{}", method.id);
        if let Some(evaluations) = method.evaluations {
            let steps = lane.evaluations().abs_diff(u64::from(evaluations) * 4 * 30);
            // Methods that carry values between steps need one more evaluation to begin.
            assert!(steps <= 4, "{}: {}", method.id, lane.evaluations());
        }
    }
}

#[test]
fn a_switched_lane_takes_the_substeps_of_its_new_spec() {
    let scene = Scene::built_in("spring").unwrap();
    let euler = Solver::Method(method("explicit-euler").unwrap());
    let truth = Lane::new(&scene, Solver::Truth, 1);
    let mut lane = Lane::new(&scene, euler, 1);
    lane.tick(0, 0.0, H);
    lane.switch(euler, 5, H, &truth);
    lane.tick(1, H, H);
    assert_eq!((lane.substeps(), lane.evaluations()), (5, 1 + 5));
}

#[test]
fn a_body_without_truth_has_no_extent_and_the_truth_has_one_from_its_start() {
    let scene = Scene::built_in("ship").unwrap();
    let mut truth = Lane::new(&scene, Solver::Truth, 1);
    let largest = |lane: &Lane| lane.bodies()[0].extent().unwrap().largest_speed();
    assert_eq!(largest(&truth), 0.0);
    truth.input(0, 0.0, Input::Kick(2.0));
    assert_eq!(largest(&truth), 4.0);
    truth.input(0, 0.0, Input::Throttle(-1.0));
    (0..60).for_each(|tick| truth.tick(tick, tick as f64 * H, H));
    assert!(truth.bodies()[0].speed() < 4.0 && largest(&truth) == 4.0);
    let lane = Lane::new(&scene, Solver::Method(&GENERAL_METHODS[0]), 1);
    assert!(lane.bodies()[0].extent().is_none());
}

fn ranges(scene: &Scene) -> Vec<(f64, f64)> {
    let lane = Lane::new(scene, Solver::Truth, 1);
    lane.bodies()[0].preview().ranges.clone()
}

#[test]
fn the_extent_of_a_built_in_scene_is_computed_once_for_all_copies() {
    for name in ["rope", "jump"] {
        let preview = || {
            let scene = Scene::built_in(name).unwrap();
            Lane::new(&scene, Solver::Truth, 1).bodies()[0].preview()
        };
        assert!(Arc::ptr_eq(&preview(), &preview()), "{name}");
    }
}

#[test]
fn the_range_of_a_coordinate_is_found_before_the_motion_is_drawn() {
    let law = "title = 'Mine'\ntick_hz = 60\nseconds = 5\n\
        [[law]]\n[law.coordinates.x]\nstart = 2\nacceleration = '-9*x'";
    let &[(least, most)] = &ranges(&Scene::parse("mine.toml", law).unwrap())[..] else { panic!() };
    assert!((least + 2.0).abs() < 0.01 && (most - 2.0).abs() < 0.01, "{least} to {most}");
}
