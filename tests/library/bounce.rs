//! Bounces of a ball: the truth against states of sixty digits, and the rules for impacts against closed forms.

use crate::dice::Dice;
use regatta::measure::Judge;
use regatta::run::{Lane, METRICS, Race};
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::bodies::{Ball, Body, kind};
use regatta::sim::integrators::{METHODS, method};
use regatta::sim::law::StepText;
use regatta::sim::{Bounces, IMPACTS, Impact, Solver, State, impact, own_method, stepper};
use regatta::studio::{RunCommand, StageCommand, Studio};

const G: f64 = 9.81;
const H: f64 = 1.0 / 60.0;

pub(crate) fn ball([height, speed]: [f64; 2], restitution: f64) -> Ball {
    Ball { height, speed, restitution, gravity: G, penalty_hz: 4.77, ..Ball::default() }
}

fn under(id: &str, rule: &str) -> Solver {
    Solver::Bouncing(method(id).unwrap(), None, impact(rule).unwrap())
}

/// Returns the heights of the flights of `ball` under a method and a rule at 60 Hz, and the ticks of its impacts.
fn flights(ball: Ball, id: &str, rule: &str, seconds: f64) -> (Vec<f64>, Vec<u64>) {
    let mut lane = stepper(ball, under(id, rule));
    let (mut apexes, mut ticks, mut before) = (Vec::new(), Vec::new(), Bounces::default());
    for tick in 0..(seconds / H) as u64 {
        lane.advance(tick as f64 * H, H, 1).unwrap();
        let now = *lane.bounces().unwrap();
        if now.apex_after != before.apex_after {
            apexes.push(now.apex.unwrap());
        }
        ticks.extend((now.impacts > before.impacts).then_some(tick + 1));
        before = now;
    }
    (apexes, ticks)
}

fn near(found: f64, wanted: f64, within: f64, what: &str) {
    assert!((found - wanted).abs() <= within, "{what}: {found:?}, not {wanted:?}");
}

#[test]
fn the_truth_has_the_states_of_sixty_digits() {
    let of = |height, speed, restitution, drag| Ball { drag, ..ball([height, speed], restitution) };
    let walls = Ball { gravity: 0.0, ceiling: 3.0, ..ball([0.5, 7.3], 1.0) };
    for (ball, t, [y, v], within) in [
        (of(1.0, 0.0, 1.0, 0.0), 0.4, [0.21519999999999987, -3.9240000000000004], 1e-12),
        (of(1.0, 0.0, 1.0, 0.0), 10.0, [0.978_321_975_404_437_8, -0.6521678024595587], 1e-12),
        (of(10.0, 0.0, 1.0, 0.0), 1000.0, [8.725_140_151_694_537, -5.001_274_859_848_555], 2e-12),
        (of(10.0, 0.0, 0.8, 0.0), 5.0, [3.4106847818149405, -3.666_863_043_637_011], 1e-12),
        (of(1.0, 0.0, 0.5, 0.0), 1.25, [0.0019618213399146757, 0.19531945707193143], 1e-12),
        (of(1.0, 0.0, 0.8, 0.0), 4.0, [7.767_499_142_784_655e-5, 0.050506744527476647], 1e-12),
        (of(0.0, 4.905, 0.6, 0.0), 1.35, [0.42918749999999994, -0.490_500_000_000_001], 1e-12),
        (of(10.0, 0.0, 0.8, 0.1), 5.0, [1.0198423469751812, -6.203_821_600_789_726], 1e-12),
        (of(1.0, 0.0, 1.0, 0.5), 10.0, [0.010899401813355423, -0.702_996_931_984_617_4], 1e-11),
        (of(100.0, 0.0, 0.9, 1.0), 15.0, [0.046913813298707476, 1.0967212333660911], 1e-12),
        (of(1e-6, 0.0, 1.0, 0.5), 3.0, [3.001_146_181_883_59e-7, -0.00115315938588074], 1e-12),
        (walls, 100.0, [1.5000000000000178, -7.3], 1e-12),
    ] {
        let found = ball.exact(t, &ball.start()).unwrap();
        near(found.q, y, within, &format!("y of {ball:?}"));
        near(found.v, v, within, &format!("v of {ball:?}"));
    }
}

#[test]
fn the_truth_on_a_floor_that_moves_has_the_states_of_sixty_digits_and_rests_on_it() {
    let shaken = |height, restitution, size, per_s: f64| Ball {
        floor_amplitude: size,
        floor_frequency: per_s / std::f64::consts::TAU,
        ..ball([height, 0.0], restitution)
    };
    let run = |ball: Ball, solver, t: f64| {
        let mut lane = stepper(ball, solver);
        (0..(60.0 * t) as u64).for_each(|tick| lane.advance(tick as f64 * H, H, 1).unwrap());
        lane
    };
    for (ball, t, [y, v]) in [
        (shaken(0.3, 0.8, 0.02, 20.0), 3.0, [0.14880881022552925, 0.49034552235131185]),
        (shaken(1.0, 0.9, 0.01, 31.4159), 5.0, [0.0733436137829591, 2.724_057_655_941_789]),
    ] {
        let truth = run(ball.clone(), Solver::Truth, t);
        near(truth.q()[0], y, 1e-11, "y");
        near(truth.v()[0], v, 1e-10, "v");
        let error = truth.truth_error().unwrap()[0];
        assert!((truth.q()[0] - y).abs() <= error && error < 1e-9, "{error:e}");
        assert!(!truth.is_closed_form() && ball.exact(1.0, &ball.start()).is_none());
        let lane = run(ball, under("rk4", "locate"), t);
        near(lane.q()[0], y, 1e-9, "by rk4");
    }
    // A slow floor is lain upon, and a fast one is left again.
    for (size, lies) in [(0.01, true), (0.03, false)] {
        let mut truth = run(shaken(0.01, 0.2, size, 20.0), Solver::Truth, 3.0);
        let highest = (180..240).fold(0.0_f64, |highest, tick| {
            truth.advance(tick as f64 * H, H, 1).unwrap();
            highest.max(truth.q()[0] - size * (20.0 * H * (tick + 1) as f64).sin())
        });
        assert!(if lies { highest < 1e-9 } else { highest > 1e-3 }, "{size}: {highest}");
    }
    let [exact, reference] = [0.0, 0.01].map(|size| {
        let text = format!("height_m = 1\nfloor_amplitude_m = {size}\nfloor_frequency_hz = 9");
        let body = Scene::parse("x.toml", &format!("{}{text}", head("[[ball]]"))).unwrap();
        body.bodies[0].kind.truth_of(&body.bodies[0].values).id()
    });
    assert_eq!([exact, reference], ["exact", "reference"]);
}

#[test]
fn a_ball_on_a_paddle_is_known_only_for_some_seconds() {
    let scene = Scene::built_in("paddle").unwrap();
    let truth = Race::of_scene(&scene).truth().bodies()[0].stepper.boxed_clone();
    let known = (1..200).take_while(|n| truth.true_bounce(*n).is_some()).count() as u64;
    let [last_s, _] = truth.true_bounce(known).unwrap();
    assert!((10..30).contains(&known) && (4.0..12.0).contains(&last_s), "{known}: {last_s} s");
}

#[test]
fn the_truth_rests_when_its_impacts_end_and_knows_each_of_them() {
    for (height, rests) in [(1.0, 4.063_712_768_871_578), (10.0, 12.85058810634358)] {
        let ball = ball([height, 0.0], 0.8);
        let at = |t| ball.exact(t, &ball.start()).unwrap();
        assert_eq!(at(rests + 1e-12), State { q: 0.0, v: 0.0 });
        assert!(at(rests - 1e-9).v != 0.0);
        assert_eq!(at(1e9), State { q: 0.0, v: 0.0 });
    }
    let ball = ball([1.0, 0.0], 1.0);
    let [t, apex] = ball.bounce(&ball.start(), 10_000).unwrap();
    near(t, 9030.021296073632, 2e-12, "the impact 10 000");
    near(apex, 1.0, 1e-12, "its apex");
}

#[test]
fn impacts_between_two_walls_are_known_while_each_takes_speed() {
    for (speed, e) in [(-4.3, 0.9), (4.3, 0.999), (1.0, 0.5), (-2.0, 1.0)] {
        let ball = Ball { gravity: 0.0, ceiling: 2.5, ..ball([0.7, speed], e) };
        let to_wall = if speed > 0.0 { 1.8 } else { 0.7 };
        let truth = stepper(ball, Solver::Truth);
        let (mut at_s, mut fast) = (to_wall / speed.abs(), speed.abs());
        assert_eq!(truth.true_bounce(0).unwrap()[0], 0.0);
        for n in 1..20 {
            near(truth.true_bounce(n).unwrap()[0], at_s, 1e-11 * at_s, "impact");
            fast *= e;
            at_s += 2.5 / fast;
        }
    }
}

#[test]
fn no_truth_falls_through_its_walls() {
    let mut dice = Dice::new(8200);
    for n in 0..10_000 {
        let has_ceiling = n % 5 == 0;
        let ball = Ball {
            drag: if n % 3 == 0 && !has_ceiling { dice.between(0.0, 2.0) } else { 0.0 },
            gravity: if has_ceiling { 0.0 } else { G },
            ceiling: if has_ceiling { 3.0 } else { 0.0 },
            ..ball([dice.between(0.0, 3.0), dice.between(-9.0, 9.0)], dice.between(0.0, 1.0))
        };
        let y = ball.exact(dice.between(0.0, 20.0), &ball.start()).unwrap().q;
        assert!(y >= 0.0 && (!has_ceiling || y <= 3.0), "{y} of {ball:?}");
    }
}

#[test]
fn a_clamp_gains_height_with_verlet_by_the_numbers() {
    for id in ["velocity-verlet", "rk4", "midpoint"] {
        let (apexes, ticks) = flights(ball([1.0, 0.1], 1.0), id, "clamp", 12.0);
        for (n, wanted) in [(1, 1.022043017), (5, 1.176759684), (10, 1.361538851)] {
            near(apexes[n - 1], wanted, 1e-9, id);
        }
        assert_eq!(ticks[..3], [28, 83, 139]);
        let (apexes, _) = flights(ball([1.0, 0.1], 0.8), id, "clamp", 12.0);
        for (n, wanted) in [(1, 0.654107531), (5, 0.141316348), (10, 0.035875140)] {
            near(apexes[n - 1], wanted, 1e-9, id);
        }
    }
}

#[test]
fn every_pair_of_method_and_rule_has_its_numbers() {
    let truth = 1.0005096839959224;
    for (id, rule, wanted) in [
        ("semi-implicit-euler", "clamp", [0.985066976, 0.843975309, 0.666158642]),
        ("semi-implicit-euler", "velocity", [0.925383642, 0.658333642, 0.386891976]),
        ("semi-implicit-euler", "before-tick", [1.000016976; 3]),
        ("explicit-euler", "clamp", [1.137058642, 1.658433642, 2.416241976]),
        ("velocity-verlet", "mirror", [1.043576351, 1.464701351, 2.107176351]),
        ("velocity-verlet", "locate", [1.000509684; 3]),
        ("rk4", "locate", [1.000509684; 3]),
        ("rk4", "locate-cubic", [truth; 3]),
        ("velocity-verlet", "energy", [truth; 3]),
    ] {
        let (apexes, _) = flights(ball([1.0, 0.1], 1.0), id, rule, 15.0);
        for (n, wanted) in [1, 5, 10].into_iter().zip(wanted) {
            near(apexes[n - 1], wanted, 1e-9, &format!("apex {n} of {id}, {rule}"));
        }
    }
    let (apexes, _) = flights(ball([1.0, 0.1], 0.8), "velocity-verlet", "locate", 12.0);
    near(apexes[4], 0.107428909, 1e-9, "five bounces at e = 0.8");
    let ball = ball([1.0, 0.1], 1.0);
    near(ball.bounce(&ball.start(), 1).unwrap()[0], 0.4618323734327363, 1e-15, "first impact");
}

#[test]
fn a_ball_hops_rests_or_sinks_by_method_and_rule() {
    for (id, rule, lowest, highest) in [
        ("velocity-verlet", "clamp", 0.0, 6.661e-3),
        ("explicit-euler", "clamp", 0.0, 61.464e-3),
        ("semi-implicit-euler", "clamp", 0.0, 0.0),
        ("velocity-verlet", "locate", 0.0, 0.0),
        ("velocity-verlet", "velocity", -0.147750, f64::NAN),
        ("semi-implicit-euler", "velocity", -1.573199, f64::NAN),
    ] {
        let mut lane = stepper(ball([1.0, 0.1], 0.8), under(id, rule));
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for tick in 0..1200 {
            lane.advance(tick as f64 * H, H, 1).unwrap();
            let y = lane.q()[0];
            if tick >= 1140 {
                range = [range[0].min(y), range[1].max(y)];
            }
        }
        near(range[0], lowest, 1e-6, &format!("lowest of {id}, {rule}"));
        if highest.is_finite() {
            near(range[1], highest, 1e-6, &format!("highest of {id}, {rule}"));
        }
    }
}

/// The height after one impact, by the closed forms: of the depth p below the floor and the true speed U there.
fn closed(rule: &str, s: f64, e: f64, [p, u]: [f64; 2]) -> f64 {
    let turned = e * u + (1.0 + e) * s * G * H / 2.0;
    match rule {
        "velocity" => -p + turned * turned / (2.0 * G),
        "clamp" => turned * turned / (2.0 * G),
        "mirror" => p + turned * turned / (2.0 * G),
        "before-tick" => -p + (turned + G * H) * (turned + G * H) / (2.0 * G),
        _ => unreachable!("no closed form of {rule}"),
    }
}

#[test]
fn random_bounces_reach_the_heights_of_the_closed_forms() {
    let mut dice = Dice::new(8201);
    for n in 0..10_000 {
        let rule = ["velocity", "clamp", "mirror", "before-tick"][n % 4];
        let (id, s) =
            [("semi-implicit-euler", -1.0), ("velocity-verlet", 0.0), ("explicit-euler", 1.0)]
                [n / 4 % 3];
        let e = dice.between(0.5, 1.0);
        let [mut y, mut v] = [dice.between(0.5, 2.0), dice.between(-1.0, 3.0)];
        let (apexes, ticks) = flights(ball([y, v], e), id, rule, 3.0);
        // The same fall, on the parabola of the method: its true speed is v + s g h/2.
        let mut tick = 0;
        while y >= 0.0 {
            y += H * (v - G * H * (1.0 - s) / 2.0);
            v -= G * H;
            tick += 1;
        }
        let late = u64::from(rule == "before-tick");
        assert_eq!(ticks[0], tick + late, "{id}, {rule}");
        let wanted = closed(rule, s, e, [-y, -v - s * G * H / 2.0]);
        near(apexes[0], wanted, 1e-12, &format!("{id}, {rule}, e = {e}"));
    }
}

#[test]
fn no_ball_is_drawn_below_its_floor_by_a_rule_that_places_it() {
    let mut dice = Dice::new(8202);
    let methods: Vec<_> =
        METHODS.iter().filter(|it| !it.is_engine() && it.only.is_none()).collect();
    for n in 0..2000 {
        let rule = ["clamp", "mirror", "energy", "locate"][n % 4];
        let method = methods[dice.below(methods.len())];
        let start = [dice.between(0.0, 2.0), dice.between(-3.0, 3.0)];
        let body = Ball { drag: dice.between(0.0, 0.5), ..ball(start, dice.between(0.0, 1.0)) };
        let mut lane = stepper(body, under(method.id, rule));
        for tick in 0..300 {
            lane.advance(tick as f64 * H, H, 1).unwrap();
            assert!(lane.q()[0] >= 0.0, "{} m: {}, {rule}, tick {tick}", lane.q()[0], method.id);
        }
    }
}

#[test]
fn a_ball_reverses_in_time_where_method_and_rule_do() {
    let mut dice = Dice::new(8203);
    for _ in 0..10_000 {
        let start = [dice.between(0.5, 2.0), dice.between(-1.0, 1.0)];
        let mut lane = stepper(ball(start, 1.0), under("semi-implicit-euler", "before-tick"));
        let run = |lane: &mut dyn regatta::sim::Stepper| {
            (0..100).for_each(|tick| lane.advance(tick as f64 * H, H, 1).unwrap());
        };
        run(&mut *lane);
        // The velocity of a tick is that of its second half: turned, it is that of the first.
        let (y, v) = (lane.q()[0], lane.v()[0]);
        if y < 0.0 {
            continue;
        }
        lane.set(0.0, &[y], &[-v + G * H]);
        run(&mut *lane);
        near(lane.q()[0], start[0], 1e-12, "back");
    }
}

#[test]
fn no_flight_under_locate_is_higher_than_the_true_one() {
    let mut dice = Dice::new(8204);
    for n in 0..2000 {
        let start = [dice.between(0.5, 2.0), dice.between(-1.0, 3.0)];
        let (body, id) = (ball(start, dice.between(0.5, 1.0)), ["velocity-verlet", "rk4"][n % 2]);
        for (after, apex) in (1..).zip(flights(body.clone(), id, "locate", 3.0).0) {
            let [_, wanted] = body.bounce(&body.start(), after).unwrap();
            assert!(apex <= wanted + 1e-12, "{apex} after {after}: {body:?}");
        }
    }
}

fn head(rest: &str) -> String {
    format!("title = 'x'\ntick_hz = 60\nseconds = 5\n{rest}\n")
}

fn scene(lanes: &str) -> Scene {
    Scene::parse("x.toml", &format!("{}[[ball]]\nheight_m = 1\n", head(lanes))).unwrap()
}

#[test]
fn lanes_of_a_ball_have_the_same_bits_alone_and_by_ticks() {
    let all: String = IMPACTS
        .iter()
        .filter(|impact| impact.fits(method("rk4").unwrap()))
        .map(|impact| format!("[[lane]]\nmethod = 'rk4'\nimpact = '{}'\n", impact.id))
        .collect();
    let scene = scene(&all);
    let mut half = Race::of_scene(&scene);
    half.run(130);
    let mut race = half.clone();
    race.run(170);
    for (entrant, spec) in race.entrants().iter().zip(&scene.lanes) {
        let mut alone = Race::new(&scene, [*spec]);
        alone.run(300);
        let state =
            |lane: &Lane| [lane.bodies()[0].stepper.q()[0], lane.bodies()[0].stepper.v()[0]];
        assert_eq!(state(&entrant.lane), state(&alone.entrants()[0].lane), "{:?}", spec.impact);
    }
}

#[test]
fn a_scene_names_its_rules_and_writes_them_again() {
    let both = scene(
        "impact = 'clamp'\n[[lane]]\nmethod = 'rk4'\n[[lane]]\nmethod = 'rk4'\nimpact = 'mirror'\n",
    );
    let rules = |scene: &Scene| scene.lanes.iter().map(|lane| lane.impact.id).collect::<Vec<_>>();
    assert_eq!(rules(&both), ["clamp", "mirror"]);
    let again = Scene::parse("x.toml", &both.to_toml()).unwrap();
    assert_eq!(again.lanes, both.lanes);
    let three = scene("methods = ['rk4']").with_impacts(
        &[method("midpoint").unwrap(), method("rk4").unwrap()],
        &[impact("clamp").unwrap(), impact("locate").unwrap()],
    );
    let names: Vec<_> = three.lanes.iter().map(|lane| (lane.method.id, lane.impact.id)).collect();
    let wanted =
        [("midpoint", "clamp"), ("midpoint", "locate"), ("rk4", "clamp"), ("rk4", "locate")];
    assert_eq!(names, wanted);
    let plain = LaneSpec::plain(method("rk4").unwrap());
    assert_eq!(plain.impact.id, "locate");
    assert!(kind("ball").unwrap().has_walls);
}

#[test]
fn faults_of_a_ball_and_its_rules_are_told() {
    let fault = |lanes: &str, ball: &str| {
        Scene::parse("x.toml", &format!("{}{ball}\n", head(lanes))).unwrap_err().to_string()
    };
    let ball = "[[ball]]\nheight_m = 1\n";
    for (lanes, ball, wanted) in [
        ("", "[[ball]]\nheight_m = 1\nrestitution = 1.2", "`restitution`"),
        ("", "[[ball]]", "missing key `height_m`"),
        ("impact = 'mirrr'", ball, "did you mean \"mirror\"?"),
        ("impact = 'reflct'", ball, "did you mean \"mirror\"?"),
        ("impact = 'clamp'", "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1", "meets a wall"),
        ("", "[[ball]]\nheight_m = 1\ngravity_m_per_s2 = 0", "never comes back"),
        ("", "[[ball]]\nheight_m = 1\nceiling_m = 3", "without gravity only"),
        ("", "[[ball]]\nheight_m = 1\nfloor_amplitude_m = 0.1", "at no frequency"),
        (
            "methods = ['engine-jolt']",
            "[[ball]]\nheight_m = 1\nfloor_amplitude_m = 0.1\nfloor_frequency_hz = 5",
            "a floor at rest",
        ),
    ] {
        let found = fault(lanes, ball);
        assert!(found.contains(wanted), "{wanted} in\n{found}");
    }
}

#[test]
fn a_soft_floor_is_as_deep_as_its_frequency_lets_it() {
    for penalty_hz in [4.77, 10.0] {
        let scene = format!(
            "{}[[ball]]\nheight_m = 1\nrestitution = 1\npenalty_hz = {penalty_hz}\n",
            head("")
        );
        let scene = Scene::parse("x.toml", &scene).unwrap();
        let mut lane = Lane::new(&scene, under("rk4", "penalty"), 1);
        let mut deepest = 0.0_f64;
        for tick in 0..960 {
            lane.tick(tick, tick as f64 / 960.0, 1.0 / 960.0);
            deepest = deepest.min(lane.bodies()[0].stepper.q()[0]);
        }
        // All energy is in the spring there: ω² d²/2 = g (1 + d).
        let stiff = (std::f64::consts::TAU * penalty_hz).powi(2);
        let depth = (G + (G * G + 2.0 * stiff * G).sqrt()) / stiff;
        near(-deepest, depth, 1e-3 * depth, "depth");
    }
}

#[test]
fn a_ball_that_sticks_to_a_swinging_floor_meets_it_no_more() {
    let (floor_amplitude, floor_frequency) = (0.01, 2.0);
    let body = Ball { floor_amplitude, floor_frequency, ..ball([0.3, 0.0], 0.3) };
    let (_, ticks) = flights(body, "rk4", "locate", 10.0);
    assert!(ticks.len() > 3 && *ticks.last().unwrap() < 30, "{ticks:?}");
    // A floor of 1.3 g throws it at each swing, and catches it.
    let thrown = Ball { floor_amplitude: 0.08, floor_frequency, ..ball([0.0, 0.0], 0.0) };
    let (_, ticks) = flights(thrown, "rk4", "locate", 10.0);
    assert!((19..=21).contains(&ticks.len()), "{ticks:?}");
}

#[test]
fn metrics_of_a_ball_count_measure_and_compare_its_bounces() {
    let lanes = "[[lane]]\nmethod = 'velocity-verlet'\nimpact = 'clamp'";
    let mut race = Race::of_scene(&scene(lanes));
    race.run(90);
    let of = |id: &str| {
        let metric = METRICS.iter().find(|metric| metric.id == id).unwrap();
        let lane = &race.entrants()[0].lane.bodies()[0];
        (metric.measure)(lane, &race.truth().bodies()[0])
    };
    assert_eq!(of("impacts"), Some(2.0));
    assert_eq!(of("depth"), Some(0.0));
    let apex = of("apex").unwrap();
    near(of("apex_error").unwrap(), 100.0 * (apex / 0.64 - 1.0), 1e-9, "apex error");
    assert!((0.0..60.0).contains(&of("landing_error").unwrap()));
    let spring = Race::of_scene(&Scene::built_in("spring").unwrap());
    let lane = &spring.entrants()[0].lane.bodies()[0];
    for id in ["impacts", "depth", "apex", "apex_error", "landing_error"] {
        let metric = METRICS.iter().find(|metric| metric.id == id).unwrap();
        assert_eq!((metric.measure)(lane, &spring.truth().bodies()[0]), None, "{id}");
    }
}

#[test]
fn j_changes_the_rule_of_the_selected_lane_in_flight() {
    let mut studio = Studio::new(Scene::built_in("ball").unwrap());
    studio.apply(StageCommand::ToggleRace);
    studio.apply(StageCommand::Pick(1));
    (0..40).for_each(|_| studio.tick());
    let rules = |studio: &Studio| -> Vec<&str> {
        studio.race().entrants().iter().map(|lane| lane.spec.impact.id).collect()
    };
    let before = rules(&studio);
    assert_eq!(before[1], "velocity");
    studio.apply(RunCommand::NextImpact);
    studio.tick();
    let after = rules(&studio);
    assert_eq!((after[1], &after[2..]), ("velocity-blind", &before[2..]));
    assert_eq!(studio.race().entrants()[1].lane.bodies()[0].stepper.bounces().unwrap().impacts, 1);
}

#[test]
fn lines_with_a_floor_of_their_own_are_their_own_rule() {
    let lines = "v += a(x, v) * h; x += v * h; if x < 0 { x = 0; v = -0.8 * v }";
    let own = own_method("mine", lines).unwrap();
    assert!(
        own.has_own_floor
            && !own_method("plain", "v += a(x, v) * h; x += v * h").unwrap().has_own_floor
    );
    assert_eq!(LaneSpec::plain(own).impact.id, "none");
    // The same motion as the rule beside the method, and the same bounces.
    let same = |solver: Solver| {
        let mut lane = stepper(ball([1.0, 0.1], 0.8), solver);
        let at = |tick: u64| lane.advance(tick as f64 * H, H, 1).unwrap();
        (0..120).for_each(at);
        let bounces = *lane.bounces().unwrap();
        (lane.q()[0].to_bits(), lane.v()[0].to_bits(), bounces.impacts, bounces.apex)
    };
    assert_eq!(same(Solver::Method(own)), same(under("semi-implicit-euler", "clamp")));
    let perpetual = Scene::built_in("perpetual").unwrap();
    let lines = "v += a(x, v) * h; x += v * h; if x < 0 { x = 0; v = -v }";
    let own = own_method("elastic", lines).unwrap();
    let found = Judge::new(&perpetual).verdict(LaneSpec::plain(own), perpetual.tick_hz).to_string();
    assert!(found.starts_with("dies away · bounces") && found.contains("too low"), "{found}");
    let refused = scene_fault("[[lane]]\nmethod = 'rk4'\nimpact = 'none'");
    assert!(refused.contains("is not for rk4"), "{refused}");
}

#[test]
fn the_printed_lines_of_a_rule_bounce_a_ball_as_the_rule_does() {
    // Lines of one step have no loops, and p2's lines are of a ball that lands for the first time.
    let is_whole =
        |rule: &&Impact| !rule.code.contains("while") && !["none", "engine-p2"].contains(&rule.id);
    for rule in IMPACTS.iter().filter(is_whole) {
        let (id, step) = match rule.id {
            "engine" => ("engine-jolt", ""),
            "locate-chord" => ("velocity-verlet", ""),
            _ if rule.code.starts_with("# In place of the step") => ("semi-implicit-euler", ""),
            _ => ("semi-implicit-euler", "v -= 9.81 * h\nx += h * v\n"),
        };
        for e in [0.0, 0.3, 0.8, 1.0] {
            let lines = rule.code.replace("let e = 0.8", &format!("let e = {e:?}"));
            let lines = StepText::read_rule(&format!("{step}{lines}"), "").unwrap();
            let mut registers = lines.registers();
            let mut lane = stepper(ball([1.0, 0.1], e), under(id, rule.id));
            for (index, value) in [1.0, 0.1].into_iter().enumerate() {
                lines.set(&mut registers, index, value);
            }
            for tick in 0..1200 {
                lines.step(&mut registers, H, 0.0);
                lane.advance(f64::from(tick) * H, H, 1).unwrap();
                let what = format!("{}, {e}, tick {tick}", rule.id);
                near(lines.value(&registers, 0), lane.q()[0], 1e-9, &what);
            }
        }
    }
}

fn scene_fault(lanes: &str) -> String {
    let text = format!("{}[[ball]]\nheight_m = 1\n", head(lanes));
    Scene::parse("x.toml", &text).unwrap_err().to_string()
}
