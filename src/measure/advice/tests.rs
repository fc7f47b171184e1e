use super::*;
use crate::scene::SCENES;
use crate::sim::integrators::method;

fn met(slowest_hz: Option<u32>, stiffness_factor: Option<f64>) -> CriterionMet {
    let limited_by = stiffness_factor.map(|_| "stiffness".into());
    CriterionMet {
        tick_hz: 60.into(),
        substeps: 1,
        evaluations_per_s: 60.0,
        cost_per_s: 60.0,
        are_margins_searched: true,
        slowest_hz,
        stiffness_factor,
        limited_by,
    }
}

#[test]
fn margins_name_each_known_limit_and_each_unknown_one() {
    for (slowest_hz, stiffness_factor, told) in [
        (Some(50), Some(1.4), "holds down to 50 Hz, or 1.4 × stiffness"),
        (Some(50), Some(1e4), "holds down to 50 Hz, or more than 10000 × stiffness"),
        (Some(59), Some(1.0), "holds down to 59 Hz, or 1 × stiffness (no reserve)"),
        (Some(60), Some(1.1), "holds down to 60 Hz (no reserve), or 1.1 × stiffness"),
        (Some(60), None, "holds down to 60 Hz (no reserve); with stiffer bodies not known"),
        (Some(50), None, "holds down to 50 Hz; with stiffer bodies not known"),
        (None, Some(1.4), "holds up to 1.4 × stiffness; with slower ticks not known"),
        (None, None, "the reserve is not known"),
    ] {
        let met = met(slowest_hz, stiffness_factor);
        assert_eq!(met.margins(), told);
        assert_eq!(met.has_no_reserve(), told.contains("no reserve"));
    }
}

#[test]
fn cost_ranks_before_a_symplectic_method_and_that_before_table_order() {
    let judge = Judge::new(&Scene::built_in("ship").unwrap());
    let advised = |(id, substeps, evaluations_per_s): (&str, u32, f64)| {
        let spec = LaneSpec::plain(method(id).unwrap());
        let cost_per_s = evaluations_per_s * f64::from(spec.method.evaluation_cost);
        let met =
            CriterionMet { substeps, evaluations_per_s, cost_per_s, ..met(Some(60), Some(1.0)) };
        let met = [CriterionResult::With(met), CriterionResult::No, CriterionResult::Unknown];
        MethodAdvice { spec, verdict: judge.verdict(spec, 60), met }
    };
    // The first name is that of the recommended method, in every order.
    for all in [
        [("velocity-verlet", 1, 60.0), ("rk4", 1, 240.0), ("rk4-as-printed", 1, 30.0)],
        [("pefrl", 3, 720.0), ("exponential-rosenbrock-euler", 1, 360.0), ("rk4", 8, 1920.0)],
        [("rk4", 1, 240.0), ("implicit-midpoint", 1, 180.0), ("pefrl", 2, 480.0)],
        [("velocity-verlet", 1, 120.0), ("explicit-euler", 2, 120.0), ("midpoint", 2, 120.0)],
        [("pefrl", 2, 240.0), ("improved-euler", 2, 240.0), ("rk4", 2, 240.0)],
        [("improved-euler", 2, 240.0), ("ssp-rk3", 2, 240.0), ("rk4", 4, 240.0)],
    ] {
        for turn in 0..3 {
            let mut advised = all.map(advised);
            advised.rotate_left(turn);
            let taken = recommended(&advised, 0).map(|row| advised[row].spec.method.id);
            assert_eq!(taken, Some(all[0].0), "{turn}");
            assert!((1..3).all(|criterion| recommended(&advised, criterion).is_none()));
        }
    }
}

#[test]
fn a_step_under_which_a_coin_tips_over_after_the_scene_is_not_bounded() {
    let judge = Judge::new(&Scene::built_in("coin").unwrap());
    let is_bounded = |id: &str, substeps: u32| {
        let spec = LaneSpec { substeps, ..LaneSpec::plain(method(id).unwrap()) };
        let pace = Pace { spec, tick_hz: 60.into() };
        block_on(judge.meets(Criterion::Bounded, pace)).holds()
    };
    // In the five seconds of the scene none of these gains 5 %; at 15 s each has at least 1.7 times its energy.
    for (id, substeps) in [("gyro-explicit", 23), ("gyro-rescaled", 19), ("momentum-euler", 38)] {
        assert!(!is_bounded(id, substeps), "{id}");
    }
    assert!(is_bounded("split-3", 1) && is_bounded("gyro-rotated", 1));
}

#[test]
fn the_stiffness_search_stays_within_the_limits_of_a_scene() {
    let text = |stiffness: f64| {
        let head = "title = 't'\ntick_hz = 60\nseconds = 1\n[[spring]]\nmass_kg = 1";
        format!("{head}\nstiffness_n_per_m = {stiffness}\n")
    };
    let spring = |stiffness: f64| Scene::parse("t", &text(stiffness));
    let most = (0..40).map(|i| libm::exp10(f64::from(i))).rfind(|&most| spring(most).is_ok());
    let most = most.unwrap();
    let adviser = Adviser::new(&spring(most / 2.0).unwrap(), 60);
    assert!(adviser.stiffen(1.9).is_some());
    assert!(adviser.stiffen(2.1).is_none());
}

/// Work of the advice on all methods of a scene and on the scene's truths, in millions of evaluations of one
/// coordinate. This work does not depend on the machine, and results from modes are not counted.
///
/// For most nets, this work is hundreds of runs over twenty times the scene's length, on which the claim *bounded*
/// rests.
const MILLIONS: [(&str, f64); 38] = [
    ("ball", 517.0),
    ("perpetual", 25.5),
    ("drop", 493.0),
    ("pong", 37.8),
    ("landing", 379.0),
    ("paddle", 74.1),
    ("ship", 4.2),
    ("spring", 136.0),
    ("two-springs", 136.0),
    ("damped", 49.0),
    ("stiff", 97.0),
    ("chain", 932.0),
    ("pendulum", 366.0),
    ("liouville", 41.0),
    ("kicked-rotor", 99.0),
    ("orbit", 317.0),
    ("helm", 160.0),
    ("surge", 9.2),
    ("harbour", 179.0),
    ("duffing", 163.0),
    ("bouncing-bungee", 220.0),
    ("quarter-car", 356.0),
    ("lift", 160.0),
    ("jump", 11.4),
    ("rope", 8248.0),
    ("cloth", 1398.0),
    ("bridge", 3467.0),
    ("follow", 5.5),
    ("lerp", 10.0),
    ("held-force", 96.0),
    ("alike", 12.5),
    ("engines", 135.0),
    ("stiff-in-engines", 71.0),
    ("coin", 1130.0),
    ("t-handle", 3367.0),
    ("phone", 1760.0),
    ("long-box", 894.0),
    ("gyro", 1846.0),
];

/// Limit in an unoptimised build, in which all scenes would take half an hour.
const MAX_MILLIONS: f64 = if cfg!(debug_assertions) { 12.0 } else { f64::INFINITY };

#[test]
fn advice_on_each_built_in_scene_takes_the_recorded_work() {
    let mut off = Vec::new();
    for scene in SCENES {
        let known = MILLIONS.iter().find(|(name, _)| *name == scene.name);
        let (name, wanted) = *known.unwrap_or_else(|| panic!("{} has no bound", scene.name));
        if wanted > MAX_MILLIONS {
            continue;
        }
        let scene = Scene::built_in(name).unwrap();
        let adviser = Adviser::new(&scene, scene.tick_hz);
        let specs = scene.methods_for_games().map(LaneSpec::plain);
        let mut advised: Vec<_> = specs.map(|spec| adviser.judged(spec)).collect();
        for (row, criterion) in adviser.worth_margins(&advised) {
            advised[row].search_margins(&adviser, criterion);
        }
        let found = adviser.judge().meter().counted() as f64 / 1e6;
        if !(0.8..1.2).contains(&(found / wanted)) {
            off.push(format!("{name}: {found} million, not {wanted}"));
        }
    }
    assert!(off.is_empty(), "{off:#?}");
}

/// An undamped swing grows under explicit Euler at any step, and a damped one from hω = 2ζ on.
#[test]
fn forty_springs_get_the_largest_reserve_of_equal_cost_and_no_explicit_euler() {
    let mut compared = 0;
    for frequency_hz in [0.5, 0.8, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0] {
        for damping_ratio in [0.0, 0.1, 0.3, 0.6, 1.0] {
            let omega = std::f64::consts::TAU * frequency_hz;
            let text = format!(
                "title = 't'\ntick_hz = 60\nseconds = 4\n[[spring]]\nmass_kg = 1\nstiffness_n_per_m = {}\n\
                 damping_n_s_per_m = {}\nx0_m = 1",
                omega * omega,
                2.0 * damping_ratio * omega
            );
            let scene = Scene::parse("t", &text).unwrap();
            let adviser = Adviser::new(&scene, 60);
            // A more expensive method cannot come before one of these at equal cost.
            let methods = scene.methods_for_games().filter(|it| it.evaluations == Some(1));
            let mut advised: Vec<_> =
                methods.map(|it| adviser.judged(LaneSpec::plain(it))).collect();
            adviser.search_until_decided(&mut advised);
            for criterion in 0..CRITERIA.len() {
                let Some(best) = recommended(&advised, criterion) else { continue };
                let of = |row: usize| {
                    let met = advised[row].met[criterion].met()?;
                    Some((advised[row].spec.method.id, met.cost_per_s, met.reserve()))
                };
                let (id, cost, reserve) = of(best).unwrap();
                for (other, other_cost, other_reserve) in (0..advised.len()).filter_map(of) {
                    let told = format!("{frequency_hz} Hz, {damping_ratio}: {id} before {other}");
                    assert!(id != "explicit-euler" || other == id || other_cost > cost, "{told}");
                    if other_cost == cost && other != "explicit-euler" && other != id {
                        compared += 1;
                        assert!(reserve >= other_reserve, "{told}: {reserve:?}, {other_reserve:?}");
                    }
                }
            }
            let euler = advised.iter().find(|row| row.spec.method.id == "explicit-euler").unwrap();
            let is_stable = omega / 60.0 < 2.0 * damping_ratio;
            let with_one = euler.met[0].met().is_some_and(|met| met.substeps == 1);
            assert_eq!(with_one, is_stable, "{frequency_hz} Hz, {damping_ratio}");
        }
    }
    assert!(compared > 100, "{compared}");
}
