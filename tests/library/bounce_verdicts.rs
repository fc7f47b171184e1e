//! Verdicts on bounces of a ball.

use regatta::measure::Judge;
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::bodies::{Ball, Body};
use regatta::sim::integrators::method;
use regatta::sim::{State, impact, own_method};
use regatta::studio::{StageCommand, Studio};

use crate::bounce::ball;

fn verdict(scene: &str, method_id: &str, rule: &str) -> String {
    let scene = Scene::built_in(scene).unwrap();
    let spec =
        LaneSpec { impact: impact(rule).unwrap(), ..LaneSpec::plain(method(method_id).unwrap()) };
    Judge::new(&scene).verdict(spec, scene.tick_hz).to_string()
}

#[test]
fn a_verdict_counts_bounces_in_place_of_distances() {
    for (scene, method, rule, wanted) in [
        ("perpetual", "velocity-verlet", "clamp", "grows · bounces 36 % too high after 10"),
        ("perpetual", "velocity-verlet", "mirror", "grows · bounces"),
        ("perpetual", "semi-implicit-euler", "clamp", "dies away · bounces"),
        (
            "perpetual",
            "semi-implicit-euler",
            "before-tick",
            "inaccurate · lands 122 ms late after 11",
        ),
        ("perpetual", "rk4", "locate", "accurate · bounces right"),
        ("ball", "velocity-verlet", "velocity", "dies away · sinks through the floor at"),
        ("ball", "velocity-verlet", "clamp", "grows · bounces"),
        ("ball", "rk4", "locate", "accurate · bounces right"),
        ("pong", "semi-implicit-euler", "mirror", "accurate"),
        ("pong", "semi-implicit-euler", "clamp", "inaccurate · lands"),
        ("landing", "semi-implicit-euler", "clamp", "inaccurate · jumps 6.6 % too low"),
        ("landing", "velocity-verlet", "clamp", "accurate"),
    ] {
        let found = verdict(scene, method, rule);
        assert!(found.starts_with(wanted), "{scene}, {method}, {rule}: {found}, not {wanted}");
    }
}

/// Returns the verdict on a ball of these keys at this rate, for so many seconds.
fn verdict_on(ball: &str, (hz, seconds): (u32, f64), method_id: &str, rule: &str) -> String {
    let head = format!("title = 'x'\ntick_hz = {hz}\nseconds = {seconds:?}\n");
    let head = format!("{head}methods = ['{method_id}']\nimpact = '{rule}'\n");
    let scene = Scene::parse("x.toml", &format!("{head}{ball}")).unwrap();
    Judge::new(&scene).verdict(scene.lanes[0], scene.tick_hz).to_string()
}

#[test]
fn a_verdict_names_thresholds_early_rests_gains_and_falls() {
    let ball = |height: f64| format!("[[ball]]\nheight_m = {height:?}\n");
    let threshold = ", a threshold of 1 m/s: no bounce below 51 mm";
    let mut pairs: Vec<_> = [
        (1.0, 60, "engine-jolt", "engine", threshold),
        (1.0, 60, "engine-box2d", "engine", threshold),
        (0.04, 60, "engine-jolt", "engine", threshold),
        (1.0, 60, "engine-rapier", "engine", " s early"),
        (1.0, 240, "engine-pybullet", "engine", ", rests 3.5 s early"),
        (1.0, 60, "semi-implicit-euler", "clamp", " s early"),
        (1.0, 60, "rk4", "locate", "accurate · bounces right"),
        (1.0, 60, "velocity-verlet", "clamp", "% too high after"),
        (1.0, 15, "velocity-verlet", "clamp", "never rests: 110 mm for ever"),
        (0.3, 60, "explicit-euler", "mirror", ", never rests"),
        (1.0, 60, "velocity-verlet", "penalty", "bounces"),
    ]
    .map(|(height, hz, id, rule, wanted)| (verdict_on(&ball(height), (hz, 8.0), id, rule), wanted))
    .into();
    let lines = "v += a(x, v) * h; x += v * h; if x < 0 && x > -0.05 { x = 0; v = -0.8 * v }";
    let slab = LaneSpec::plain(own_method("slab", lines).unwrap());
    let scene = Scene::built_in("ball").unwrap();
    let falls = Judge::new(&scene).verdict(slab, scene.tick_hz);
    pairs.push((falls.to_string(), "dies away · falls through at 4."));
    pairs.push((verdict("perpetual", "explicit-euler", "clamp"), "grows · gains 14 cm a bounce"));
    // Narrow rows leave out what goes with the words.
    let wordings = falls.wordings(false);
    assert_eq!(wordings.len(), 2, "{wordings:?}");
    pairs.retain(|(found, wanted)| !found.contains(wanted));
    assert!(pairs.is_empty(), "{pairs:#?}");
}

#[test]
fn a_ball_of_short_flights_is_judged_by_heights_and_a_kicked_one_not_at_all() {
    let perpetual = "[[ball]]\nheight_m = 1.0\nrestitution = 1.0\n";
    let kicked = format!("{perpetual}[[command]]\nat_s = 0.3\nkick = 1.0\n");
    let thrown = "[[ball]]\nheight_m = 2.0\nrestitution = 0.0\n";
    let rests = "[[ball]]\nheight_m = 0.0\nrestitution = 0.0\n";
    for (ball, rate, method, rule, wanted) in [
        (perpetual, (10, 10.0), "explicit-euler", "clamp", "grows · climbs to 8.9 m"),
        (perpetual, (5, 10.0), "rk4", "clamp", "grows · climbs to 4.9 m"),
        (perpetual, (5, 10.0), "semi-implicit-euler", "clamp", "inaccurate · off by"),
        (&*kicked, (60, 10.0), "explicit-euler", "clamp", "not judged · no flight before"),
        (rests, (60, 5.0), "rk4", "clamp", "accurate"),
        (thrown, (30, 1.5), "velocity-verlet", "clamp", "accurate"),
    ] {
        let found = verdict_on(ball, rate, method, rule);
        assert!(found.starts_with(wanted), "{ball} {rate:?} {method} {rule}: {found}");
    }
    let dropped = "[[ball]]\nheight_m = 3.072\nrestitution = 0.0\n";
    let lies = verdict_on(dropped, (75, 8.0), "rk4", "before-tick");
    assert!(lies.starts_with("looks right · sinks 67 mm into the floor"), "{lies}");
    let hops = "[[ball]]\nheight_m = 0.225\nspeed_m_per_s = 2.84\nrestitution = 0.5\n";
    let hops = verdict_on(hops, (75, 20.0), "semi-implicit-euler", "mirror");
    assert_eq!(hops, "inaccurate · bounces 7.1 % too low, never rests");
    // On a straight line to the end of the tick, a swept ball moves as a mirrored one.
    let thrown = "[[ball]]\nheight_m = 1.0\nspeed_m_per_s = 0.1\nrestitution = 1.0\n";
    let [mirror, swept] = ["mirror", "swept"]
        .map(|rule| verdict_on(thrown, (240, 10.0), "semi-implicit-euler", rule));
    assert_eq!((&*mirror, &mirror), ("looks right · bounces 2.3 % too low after 5", &swept));
    for rule in ["penalty", "velocity"] {
        let found = verdict("landing", "velocity-verlet", rule);
        let thirty = Scene::built_in("landing").unwrap().at_tick_hz(30);
        let spec = LaneSpec {
            impact: impact(rule).unwrap(),
            ..LaneSpec::plain(method("velocity-verlet").unwrap())
        };
        let at_30 = Judge::new(&thirty).verdict(spec, thirty.tick_hz).to_string();
        assert!(!at_30.starts_with("accurate"), "{rule}: {found}, {at_30}");
    }
}

#[test]
fn a_ball_with_drag_is_judged_without_walking_from_its_first_flight() {
    let dragged = "[[ball]]\nheight_m = 1.0\ndrag_per_s = 0.1\n";
    let found = verdict_on(dragged, (1000, 20.0), "rk4", "locate");
    assert!(found.starts_with("accurate"), "{found}");
    // Every order of moments and impacts gives the same bits.
    for restitution in [0.7, 1.0] {
        let body = || Ball { drag: 0.3, ..ball([1.0, 2.0], restitution) };
        let (walked, from) = (body(), State { q: 1.0, v: 2.0 });
        for t in [0.3, 4.0, 1.1, 9.0, 0.2, 2.5, 2.6, 60.0, 0.9] {
            let bits = |body: &Ball| {
                let State { q, v } = body.exact(t, &from).unwrap();
                let [landed, apex] = body.bounce(&from, (10.0 * t) as u64).unwrap_or([f64::NAN; 2]);
                [q, v, landed, apex].map(f64::to_bits)
            };
            assert_eq!(bits(&walked), bits(&body()), "{t}, {restitution}");
        }
    }
    // Flights that grow ever shorter are followed so far, and no further.
    let tiny = Ball { drag: 0.5, ..ball([1e-6, 0.0], 1.0) };
    let at = |t: f64| tiny.exact_error(0.0, t, &tiny.start(), &tiny.start())[0];
    assert!(at(30.0).is_infinite() && at(3.0) < 1e-13 && at(3.1) < 1e-13);
}

#[test]
fn a_ball_switched_in_flight_is_judged_beside_the_truth() {
    let scene = Scene::built_in("perpetual")
        .unwrap()
        .with_methods(&[method("explicit-euler").unwrap(), method("rk4").unwrap()]);
    let scene = scene.with_impacts(&[], &[impact("locate").unwrap()]);
    let mut studio = Studio::new(scene);
    (0..240).for_each(|_| studio.tick());
    studio.apply(StageCommand::Pick(1));
    studio.analyse();
    let found = studio.viewer.verdict(studio.active()).expect("a verdict").to_string();
    assert!(found.contains("% too high"), "{found}");
}

#[test]
fn a_ball_that_lands_on_ticks_is_called_lucky() {
    let head = "title = 'x'\ntick_hz = 60\nseconds = 10\nmethods = ['velocity-verlet']";
    let text = format!("{head}\nimpact = 'clamp'\n[[ball]]\nheight_m = 10\nrestitution = 1\n");
    let scene = Scene::parse("x.toml", &text).unwrap();
    let found = Judge::new(&scene).verdict(scene.lanes[0], scene.tick_hz).to_string();
    assert!(found.contains("luck: lands on ticks"), "{found}");
}

#[test]
fn a_soft_floor_off_the_lattice_is_no_luck() {
    let soft =
        verdict_on("[[ball]]\nheight_m = 1.03\nrestitution = 0.95", (60, 6.0), "rk4", "penalty");
    assert!(!soft.contains("luck"), "{soft}");
}

#[test]
fn a_ball_that_sticks_to_a_swinging_floor_rests_neither_early_nor_late() {
    let floor = "floor_amplitude_m = 0.01\nfloor_frequency_hz = 2.0";
    let stuck = format!("[[ball]]\nheight_m = 0.3\nrestitution = 0.3\n{floor}");
    let found = verdict_on(&stuck, (60, 10.0), "rk4", "locate");
    assert!(found.contains("bounces right"), "{found}");
}

#[test]
fn a_ball_that_keeps_its_height_and_lands_late_does_not_grow() {
    let ball = |height: f64| format!("[[ball]]\nheight_m = {height:?}\nrestitution = 1.0\n");
    for (height, method, rule) in [
        (0.95, "velocity-verlet", "energy"),
        (0.98, "velocity-verlet", "energy"),
        (1.0, "rk4", "energy"),
        (1.1, "velocity-verlet", "energy"),
        (0.98, "semi-implicit-euler", "before-tick"),
    ] {
        for seconds in [10.0, 20.0, 40.0] {
            let found = verdict_on(&ball(height), (60, seconds), method, rule);
            let is_late =
                ["looks right · lands", "inaccurate · lands"].map(|it| found.starts_with(it));
            assert!(is_late.contains(&true), "{height}, {method}, {rule}, {seconds} s: {found}");
        }
    }
}

#[test]
fn a_ball_that_flies_twice_as_high_as_the_truth_grows() {
    let ball = |keys: &str| format!("[[ball]]\n{keys}\n");
    let thrown = ball("height_m = 1.0\nspeed_m_per_s = 0.1\nrestitution = 0.0\npenalty_hz = 10");
    for (ball, rate, method, rule, wanted) in [
        (&thrown, (60, 10.0), "velocity-verlet", "penalty", "grows · climbs to 18 m"),
        (
            &ball("height_m = 0.2\nspeed_m_per_s = 0.3\nrestitution = 0.95"),
            (15, 10.0),
            "velocity-verlet",
            "mirror",
            "grows · climbs to 1.3 m",
        ),
        (
            &ball("height_m = 1.0\nspeed_m_per_s = 0.1\nrestitution = 1.0\npenalty_hz = 30"),
            (60, 10.0),
            "velocity-verlet",
            "penalty",
            "grows · gains",
        ),
    ] {
        let found = verdict_on(ball, rate, method, rule);
        assert!(found.starts_with(wanted), "{ball} {method} {rule}: {found}, not {wanted}");
    }
}

#[test]
fn a_ball_that_should_rest_is_judged_by_what_it_does_after_that() {
    let ball = |keys: &str| format!("[[ball]]\nspeed_m_per_s = 0.1\n{keys}\n");
    for (ball, rate, method, rule, wanted) in [
        (
            ball("restitution = 0.0\nheight_m = 1.0\npenalty_hz = 30"),
            (240, 10.0),
            "velocity-verlet",
            "penalty",
            "hops",
        ),
        (
            ball("restitution = 0.5\nheight_m = 1.0\npenalty_hz = 1"),
            (60, 10.0),
            "rk4",
            "penalty",
            " late",
        ),
        (
            ball("restitution = 0.8\nheight_m = 1.0"),
            (15, 10.0),
            "velocity-verlet",
            "clamp",
            "never rests: 15",
        ),
    ] {
        let found = verdict_on(&ball, rate, method, rule);
        let is_right = found.contains(wanted) && !found.contains("early");
        assert!(is_right && !found.contains("looks right"), "{ball} {rate:?} {method}: {found}");
    }
}

#[test]
fn a_soft_floor_without_a_bounce_is_judged_by_its_depth() {
    for (hz, restitution, wanted) in [
        (60, 0.0, "sinks 61 mm into the floor"),
        (15, 0.0, "hops 182 mm high"),
        (60, 0.8, "bounces"),
    ] {
        let ball = format!("[[ball]]\nheight_m = 1.0\nrestitution = {restitution:?}\n");
        let found = verdict_on(&ball, (hz, 6.0), "rk4", "penalty");
        assert!(!found.starts_with("accurate") && found.contains(wanted), "{hz}: {found}");
    }
}
