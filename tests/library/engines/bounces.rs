//! The bounces of a ball by the rules of engines, against logs of the engines and heights that were read from them.

use regatta::scene::{LaneSpec, Scene};
use regatta::sim::bodies::Ball;
use regatta::sim::integrators::{METHODS, method, method_or_nearest};
use regatta::sim::{Bounces, Impact, Solver, impact, stepper};

const G: f64 = 9.81;

fn ball(height: f64, restitution: f64) -> Ball {
    Ball { height, restitution, gravity: G, ..Ball::default() }
}

/// The states of a ball at every tick under an engine, and the heights of its flights.
fn run(id: &str, ball: Ball, hz: f64, ticks: usize) -> (Vec<[f64; 2]>, Vec<f64>) {
    let (card, h) = (method_or_nearest(id).unwrap(), 1.0 / hz);
    let rule = impact(id).unwrap_or(Impact::of(card));
    let mut lane = stepper(ball, Solver::Bouncing(card, None, rule));
    let (mut states, mut apexes) = (vec![[lane.q()[0], lane.v()[0]]], Vec::new());
    let mut before = Bounces::default();
    for tick in 0..ticks {
        lane.advance(tick as f64 * h, h, card.default_substeps).unwrap();
        states.push([lane.q()[0], lane.v()[0]]);
        let now = *lane.bounces().unwrap();
        if now.apex_after != before.apex_after {
            apexes.push(now.apex.unwrap());
        }
        before = now;
    }
    (states, apexes)
}

fn near(found: f64, wanted: f64, within: f64, what: &str) {
    assert!((found - wanted).abs() <= within, "{what}: {found:?}, not {wanted:?}");
}

/// Engines in single precision are held to its roundings, which add up in a drift of 17 s.
const LOGS: [(&str, f64, &str); 5] = [
    ("engine-chipmunk", 1e-8, include_str!("../../data/bounces/engine-chipmunk.csv")),
    ("engine-jolt", 2e-5, include_str!("../../data/bounces/engine-jolt.csv")),
    ("engine-box2d", 5e-5, include_str!("../../data/bounces/engine-box2d.csv")),
    ("engine-rapier", 5e-5, include_str!("../../data/bounces/engine-rapier.csv")),
    ("engine-pybullet", 1e-6, include_str!("../../data/bounces/engine-pybullet.csv")),
];

#[test]
fn engines_bounce_a_ball_as_their_logs() {
    for (id, within, log) in LOGS {
        let mut of = ([f64::NAN; 2], Vec::new());
        let mut rows = 0;
        for line in log.lines().skip(1) {
            let row: Vec<f64> = line.split(',').map(|word| word.parse().unwrap()).collect();
            let [e, height, tick, y, v] = row[..] else { panic!("{id}: {line}") };
            if of.0 != [e, height] {
                of = ([e, height], run(id, ball(height, e), 60.0, 1029).0);
            }
            let [found_y, found_v] = of.1[tick as usize];
            near(found_y, y, within, &format!("y of {id}: {line}"));
            // A push that is a little later changes the speed by that of the fall in between.
            near(found_v, v, 50.0 * within, &format!("v of {id}: {line}"));
            rows += 1;
        }
        assert!(rows > 400, "{id}: {rows}");
    }
}

/// Ten heights of cannon-es at e = 1, which wander.
const CANNON: [f64; 10] = [0.944, 1.237, 1.572, 1.357, 1.443, 1.296, 1.710, 1.506, 1.242, 1.168];

#[test]
fn engines_reach_the_heights_of_their_releases() {
    for (id, [height, e, hz], wanted, within) in [
        (
            "engine-jolt",
            [1.0, 0.8, 60.0],
            &[0.6354, 0.4049, 0.2606, 0.1676, 0.1137, 0.0815, 0.0574, 0.0404][..],
            1e-4,
        ),
        ("engine-jolt", [1.0, 0.8, 30.0], &[0.6556], 1e-4),
        ("engine-jolt", [1.0, 0.8, 240.0], &[0.6472], 1e-4),
        (
            "engine-chipmunk",
            [1.0, 0.8, 60.0],
            &[0.6354, 0.4049, 0.2606, 0.1676, 0.1030, 0.0604],
            1e-4,
        ),
        ("engine-chipmunk", [10.0, 1.0, 60.0], &[10.0098, 10.0182, 10.0259], 1e-4),
        ("engine-box2d", [1.0, 0.8, 60.0], &[0.6261, 0.3893, 0.2401, 0.1455, 0.0880, 0.0514], 1e-4),
        ("engine-box2d", [1.0, 0.8, 30.0], &[0.6024], 1e-4),
        (
            "engine-rapier",
            [1.0, 0.8, 60.0],
            &[0.6261, 0.3893, 0.2401, 0.1455, 0.0880, 0.0514, 0.0271, 0.0093, 0.0025],
            1e-4,
        ),
        ("engine-rapier", [1.0, 0.8, 30.0], &[0.6190], 1e-4),
        ("engine-pybullet", [1.0, 1.0, 240.0], &[0.0348], 1e-4),
        ("engine-pybullet", [1.0, 1.0, 60.0], &[1.1462, 1.3512, 1.5442], 1e-4),
        ("engine-mujoco", [1.0, 0.8, 60.0], &[0.6186, 0.4706, 0.2783, 0.1797, 0.1228], 1e-4),
        ("engine-mujoco", [10.0, 1.0, 60.0], &[9.94, 9.99], 1e-2),
        ("engine-cannon", [1.0, 1.0, 60.0], &CANNON, 1e-3),
        ("engine-cannon", [10.0, 1.0, 60.0], &[12.15, 11.36], 1e-2),
        (
            "engine-cannon",
            [1.0, 0.8, 60.0],
            &[0.6144, 0.2785, 0.1676, 0.0968, 0.0736, 0.0472],
            1e-4,
        ),
        ("engine-cannon", [1.0, 0.8, 30.0], &[0.8994], 1e-4),
        ("engine-cannon", [1.0, 0.8, 240.0], &[0.4902], 1e-4),
        ("engine-p2", [1.0, 1.0, 60.0], &[0.9969, 0.9934, 0.9899], 1e-4),
        (
            "engine-p2",
            [1.0, 0.8, 60.0],
            &[0.6329, 0.3999, 0.2545, 0.1605, 0.0954, 0.0612, 0.0380, 0.0201],
            1e-4,
        ),
        ("engine-p2", [1.0, 0.8, 30.0], &[0.6008], 1e-4),
        ("engine-p2", [1.0, 0.8, 240.0], &[0.6025], 1e-4),
    ] {
        let (states, found) = run(id, ball(height, e), hz, (12.0 * hz) as usize);
        for (n, wanted) in wanted.iter().enumerate() {
            near(found[n], *wanted, within, &format!("apex {} of {id} at {hz} Hz", n + 1));
        }
        // With a threshold, nothing bounces any more after these.
        if ["engine-jolt", "engine-box2d"].contains(&id) && hz == 60.0 {
            assert_eq!(found.len(), wanted.len(), "{id}: {found:?}");
            assert!(states.last().unwrap()[1].abs() < 1e-9, "{id}");
        }
    }
    let (_, kept) = run("engine-jolt", ball(1.0, 1.0), 60.0, 5500);
    assert!(kept.len() > 90 && kept.iter().all(|apex| (apex - 1.0003).abs() < 1e-4), "{kept:?}");
    let (_, kept) = run("engine-chipmunk", ball(10.0, 1.0), 60.0, 17_400);
    near(kept[99], 10.0946, 1e-4, "apex 100 of Chipmunk");
    let (states, kept) = run("engine-p2", ball(1.0, 1.0), 60.0, 6000);
    near(kept[99], 0.7027, 1e-4, "apex 100 of p2-es");
    assert!(states.iter().all(|[y, _]| *y > -0.3));
    let (states, _) = run("engine-p2", ball(1.0, 0.8), 60.0, 600);
    near(states[600][0], -0.005, 2e-5, "p2-es at rest");
    let (states, _) = run("engine-pybullet", ball(1.0, 1.0), 240.0, 480);
    let rests = states.iter().rposition(|[_, v]| v.abs() > 1e-9).unwrap() + 1;
    near(rests as f64 / 240.0, 0.621, 1.0 / 240.0, "the rest of pybullet");
    for (id, y, v, within) in [
        ("engine-jolt", -0.006741, 11.248793, 1e-5),
        ("engine-box2d", -0.080677, 11.248846, 5e-5),
        ("engine-rapier", -0.080677, 11.248846, 5e-5),
    ] {
        let [found_y, found_v] = run(id, ball(10.0, 0.8), 60.0, 87).0[87];
        near(found_y, y, within, id);
        near(found_v, v, within, id);
    }
}

#[test]
fn an_engine_has_its_own_rule_for_impacts_and_no_other() {
    let fault = |lanes: &str| {
        let text =
            format!("title = 'x'\ntick_hz = 60\nseconds = 5\n{lanes}\n[[ball]]\nheight_m = 1\n");
        Scene::parse("x.toml", &text).map_err(|error| error.to_string())
    };
    for (lanes, wanted) in [
        ("methods = ['engine-bullet']", "is not reproduced"),
        ("impact = 'engine'\nmethods = ['rk4']", "is not for rk4"),
        ("[[lane]]\nmethod = 'rk4'\nimpact = 'engine'", "is not for rk4"),
        ("[[lane]]\nmethod = 'engine-jolt'\nimpact = 'clamp'", "has one of its own"),
    ] {
        let found = fault(lanes).unwrap_err();
        assert!(found.contains(wanted), "{wanted} in\n{found}");
    }
    let both = fault("impact = 'clamp'\nmethods = ['engine-jolt', 'rk4']").unwrap();
    let rules: Vec<_> = both.lanes.iter().map(|lane| lane.impact.id).collect();
    assert_eq!(rules, ["engine", "clamp"]);
    assert_eq!(Scene::parse("x.toml", &both.to_toml()).unwrap().lanes, both.lanes);
    assert_eq!(
        fault("[[lane]]\nmethod = 'engine-jolt'\nimpact = 'engine'").unwrap().lanes.len(),
        1
    );
    // The names of lanes on a spring say nothing of bounces.
    let lanes = ["engine-jolt", "rk4"].map(|id| LaneSpec::plain(method(id).unwrap()));
    assert_eq!(lanes[0].distinct_name("Jolt", &lanes), "Jolt");
    assert_eq!(lanes[1].distinct_name("RK4", &lanes), "RK4");
    for card in METHODS {
        let (own, clamp) = (Impact::of(card), impact("clamp").unwrap());
        assert_eq!(own.id == "engine", card.bounce().is_some(), "{}", card.id);
        assert!(own.fits(card) && clamp.fits(card) == card.bounce().is_none(), "{}", card.id);
        let is_p2 = card.spellings().any(|(spelling, _)| spelling == "engine-p2");
        assert_eq!(impact("engine-p2").unwrap().fits(card), is_p2, "{}", card.id);
    }
}
