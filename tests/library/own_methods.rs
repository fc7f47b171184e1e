//! Methods written as lines by a user: their motion, cards and messages.

use glam::DVec2;
use regatta::conformance::check;
use regatta::conformance::problems::{Kepler, Problem, kepler_orbit, problem, spring};
use regatta::run::{Session, link};
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::integrators::{Family, GENERAL_METHODS, METHODS, Method, integrator};
use regatta::sim::law::StepText;
use regatta::sim::{
    BodyClass, OwnLines, Query, State, System, Vector, check_own_id, own_method, own_method_id,
};

use regatta::tools::source_code::{Language, Precision, source_code, step_lines};

use crate::source_code::known::{CASES, steps_as};

/// The methods of the table whose sources are lines of one step.
const TAKEN: [&str; 15] = [
    "explicit-euler",
    "midpoint",
    "improved-euler",
    "ssp-rk3",
    "rk4",
    "adams-bashforth-2",
    "semi-implicit-euler",
    "velocity-verlet",
    "position-verlet",
    "yoshida4",
    "pefrl",
    "improved-euler-as-printed",
    "rk4-as-printed",
    "adaptive-euler-as-printed",
    "jakobsen-verlet",
];

fn own(method: &Method) -> &'static Method {
    own_method(&format!("own-{}", method.id), method.code)
        .unwrap_or_else(|fault| panic!("{}: {fault:?}", method.id))
}

/// The states of a run.
fn run<V: Vector>(method: &Method, system: &Problem<V>, start: &State<V>) -> Vec<State<V>> {
    let (mut state, mut stepper) = (start.clone(), integrator(method, &start.q));
    let step = |i: u32| {
        // A step of another length in the middle.
        let h = if i < 60 { 0.02 } else { 0.013 };
        stepper.step(system, 0.02 * f64::from(i), h, &mut state).unwrap();
        state.clone()
    };
    (0..100).map(step).collect()
}

/// The methods whose sources have other operations. They write `1 - exp(-k h)` without `expm1`, or solve two stages of
/// one coordinate.
const OTHER_OPERATIONS: [&str; 2] = ["exponential-decay", "gauss-legendre-4"];

/// The largest difference of those, relative to the largest coordinate or velocity of the run.
const ROUNDING: f64 = 1e-14;

/// The method of the printed lines of a method.
fn given_back(method: &Method) -> Method {
    let lines = step_lines(method).unwrap();
    let text = StepText::read(&lines).unwrap_or_else(|fault| panic!("{}: {fault:?}", method.id));
    let own = Box::leak(Box::new(OwnLines::Method(text.into())));
    // Measuring every card would take minutes.
    Method { id: "given-back", custom: Some(own), ..Family::Explicit.card() }
}

#[test]
fn the_printed_lines_of_every_method_step_with_its_bits() {
    let mut wrong = Vec::new();
    for method in METHODS.iter().filter(|method| !method.is_for_spin()) {
        let own = &given_back(method);
        for case in CASES.iter().filter(|case| !case.is_paused()) {
            let [found, wanted] = [own, method].map(|stepped| steps_as(stepped, method, case));
            let size = wanted.iter().flatten().fold(0.0_f64, |size, part| size.max(part.abs()));
            let off = found.iter().flatten().zip(wanted.iter().flatten());
            let off = off
                .map(|(a, b)| if a.to_bits() == b.to_bits() { 0.0 } else { (a - b).abs() / size });
            let off = off.fold(0.0_f64, |worst, off| if off <= worst { worst } else { off });
            let allowed = if OTHER_OPERATIONS.contains(&method.id) { ROUNDING } else { 0.0 };
            if off.is_nan() || off > allowed {
                wrong.push(format!("{}: {off:e}", method.id));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Two bodies on stiffening springs that pull each other, with the formula of their slope.
struct Pair;

impl System for Pair {
    type Vector = [f64; 2];
    fn acceleration(&self, _t: f64, q: &[f64; 2], v: &[f64; 2], a: &mut [f64; 2]) {
        *a = [0, 1].map(|i| 3.0 * (q[1 - i] - q[i]) - 20.0 * q[i] * q[i] * q[i] - 0.2 * v[i]);
    }
    fn query(&self, _t: f64, query: Query<'_, [f64; 2]>) -> bool {
        let Query::Slope { state, along, slope } = query else { return false };
        let [q, v] = [along.q, along.v];
        *slope = [0, 1].map(|i| {
            let cubic = 60.0 * state.q[i] * state.q[i];
            3.0 * (q[1 - i] - q[i]) - cubic * q[i] - 0.2 * v[i]
        });
        true
    }
}

/// One stiffening spring, with the formula of its slope.
struct Cubic;

impl System for Cubic {
    type Vector = f64;
    fn acceleration(&self, _t: f64, q: &f64, v: &f64, a: &mut f64) {
        *a = -20.0 * q * q * q - 3.0 * v;
    }
    fn query(&self, _t: f64, query: Query<'_, f64>) -> bool {
        let Query::Slope { state, along, slope } = query else { return false };
        *slope = -60.0 * state.q * state.q * along.q - 3.0 * along.v;
        true
    }
}

#[test]
fn lines_that_solve_make_the_bits_of_their_method_on_bodies_that_know_slopes() {
    let of = |id: &str| METHODS.iter().find(|method| method.id == id).unwrap();
    for id in ["implicit-euler", "implicit-midpoint", "newmark", "tr-bdf2"] {
        let start = State { q: [1.0, -0.5], v: [0.0, 2.0] };
        let [found, wanted] =
            [&given_back(of(id)), of(id)].map(|method| run(method, &problem(Pair), &start));
        assert!(wanted[99].q[0].is_finite() && wanted[99] != wanted[98]);
        assert_eq!(found, wanted, "{id}");
    }
    let ids = ["linearly-implicit-euler", "semi-implicit-euler-implicit-drag", "verlet-exact-drag"];
    for id in ids {
        let start = State { q: 1.0, v: 0.5 };
        let [found, wanted] =
            [&given_back(of(id)), of(id)].map(|method| run(method, &problem(Cubic), &start));
        assert_eq!(found, wanted, "{id}");
    }
}

#[test]
fn a_source_read_as_own_lines_moves_like_its_method() {
    for method in GENERAL_METHODS.iter().filter(|method| TAKEN.contains(&method.id)) {
        let own = own(method);
        let swing = State { q: 1.0, v: 0.5 };
        let [found, wanted] =
            [own, method].map(|method| run(method, &problem(spring(3.0, 0.1)), &swing));
        let off = found.iter().zip(&wanted).map(|(a, b)| (a.q - b.q).abs().max((a.v - b.v).abs()));
        let off = off.fold(0.0, f64::max);
        println!("{:30} {off:e}", method.id);
        assert!(off < 1e-13, "{}: {off}", method.id);
        let orbit = kepler_orbit(0.3, 0.0);
        let [found, wanted] = [own, method].map(|method| run(method, &problem(Kepler), &orbit));
        let off = found.iter().zip(&wanted).map(|(a, b): (&State<DVec2>, &State<DVec2>)| {
            (a.q - b.q).length().max((a.v - b.v).length())
        });
        assert!(off.fold(0.0, f64::max) < 1e-12, "{}", method.id);
    }
}

#[test]
fn the_measured_card_of_own_lines_is_right() {
    for method in GENERAL_METHODS
        .iter()
        .filter(|method| TAKEN.contains(&method.id) && method.tolerance.is_none())
    {
        let own = own(method);
        let of = |card: &Method| {
            (
                [card.order, card.order_with_drag],
                card.evaluations,
                [card.symplectic, card.reversible, card.restart.is_some()],
            )
        };
        assert_eq!(of(own), of(method), "{}", method.id);
        let limits = |card: &Method| {
            let damped = card.damped_limits.unwrap();
            [card.stability_limit.unwrap(), damped[0], damped[1], damped[2]]
        };
        let off = limits(own).into_iter().zip(limits(method)).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 2e-3, "{}: {:?}", method.id, limits(own));
        // A listing as printed may be better in its velocity; own lines are no listing.
        let found = check(own);
        assert!(found.holds() || method.is_as_printed(), "{found}");
    }
}

#[test]
fn the_measured_card_of_lines_for_one_coordinate_has_their_order() {
    for (id, exact_if_linear) in [
        ("gauss-legendre-4", false),
        ("semi-implicit-euler-implicit-drag", false),
        ("verlet-exact-drag", false),
        ("linearly-implicit-euler", false),
        ("dormand-prince-54", false),
        ("exponential-rosenbrock-euler", true),
    ] {
        let method = METHODS.iter().find(|method| method.id == id).unwrap();
        let own = own(method);
        let orders = |card: &Method| [card.order, card.order_with_drag];
        assert_eq!((orders(own), own.exact_if_linear), (orders(method), exact_if_linear), "{id}");
        assert!(own.about.starts_with("order "), "{}", own.about);
    }
}

#[test]
fn the_printed_lines_of_an_engine_keep_its_usual_substeps() {
    for method in METHODS.iter().filter(|method| method.code.contains("takes whole substeps")) {
        let lines = step_lines(method).unwrap();
        let own = own_method(&format!("engine-{}", method.id), &lines).unwrap();
        assert_eq!(own.default_substeps, method.default_substeps, "{}", method.id);
        let shown = source_code(own, Language::Rust, Precision::Double).unwrap();
        let is_of_an_engine = method.code.contains("takes force");
        let no_spin = is_of_an_engine.then_some("its lines move a place, and a free spin turns");
        assert_eq!(own.incompatibility(BodyClass::Spin), no_spin, "{}", method.id);
        assert_eq!(shown.contains("Not measured: its lines take"), is_of_an_engine, "{shown}");
    }
    for number in ["0", "1001", "many", "2.5", ""] {
        let text =
            format!("takes force\ntakes whole substeps = {number}: how many\nv += h * force");
        let fault = own_method("bad", &text).unwrap_err();
        assert_eq!(fault.what, format!("`{number}` is no number of substeps"));
        assert!(text[fault.span].starts_with("substeps ="));
    }
    assert!(own_method("bad", "takes force = 4\nv += h * force").is_err());
}

/// Butcher's Runge-Kutta 5 in six stages.
const BUTCHER_5: &str = "let a1 = a(x, v)
let v2 = v + h / 4 * a1
let a2 = a(x + h / 4 * v, v2)
let v3 = v + h * (a1 / 8 + a2 / 8)
let a3 = a(x + h * (v / 8 + v2 / 8), v3)
let v4 = v + h * (-a2 / 2 + a3)
let a4 = a(x + h * (-v2 / 2 + v3), v4)
let v5 = v + h * (3 / 16 * a1 + 9 / 16 * a4)
let a5 = a(x + h * (3 / 16 * v + 9 / 16 * v4), v5)
let v6 = v + h * (-3 / 7 * a1 + 2 / 7 * a2 + 12 / 7 * a3 - 12 / 7 * a4 + 8 / 7 * a5)
let a6 = a(x + h * (-3 / 7 * v + 2 / 7 * v2 + 12 / 7 * v3 - 12 / 7 * v4 + 8 / 7 * v5), v6)
x += h / 90 * (7 * v + 32 * v3 + 12 * v4 + 32 * v5 + 7 * v6)
v += h / 90 * (7 * a1 + 32 * a3 + 12 * a4 + 32 * a5 + 7 * a6)
";

#[test]
fn a_runge_kutta_method_of_order_5_has_that_order_with_drag_too() {
    let card = own_method("butcher", BUTCHER_5).unwrap();
    assert_eq!([card.order, card.order_with_drag], [5, 5], "{}", card.about);
    // A weight of the sum is wrong.
    let slipped = own_method("slipped-butcher", &BUTCHER_5.replace("12 * v4 + 32", "12 * v4 + 31"));
    assert!(slipped.unwrap().order < 2);
}

/// Runge-Kutta 4 with a slip.
fn slipped(right: &str, wrong: &str) -> &'static Method {
    let rk4 = METHODS.iter().find(|method| method.id == "rk4").unwrap().code;
    assert!(rk4.contains(right));
    own_method("slipped", &rk4.replacen(right, wrong, 1)).unwrap()
}

#[test]
fn a_slip_in_rk4_is_reported_with_its_order_and_wrong_coefficient() {
    let sign = slipped("let k2_x = v +", "let k2_x = v -").about;
    assert!(sign.starts_with("order 1.00; a spring of 1 Hz at 60 Hz gains "), "{sign}");
    // By hand: a third of the second stage goes to x, with half a step of the first the wrong way round.
    let end = "nearest: rk4 (order 4), from which, under a = -k x - c v, the coefficient of h² k x in x differs: -1/6 for -1/2";
    assert!(sign.ends_with(end), "{sign}");
    let stage = slipped("let k4_v = a(x + h * k3_x", "let k4_v = a(x + h * k2_x").about;
    assert!(stage.contains("order 3.") || stage.contains("order 2."), "{stage}");
    assert!(stage.contains("nearest: rk4 "), "{stage}");
    for (lines, told) in [
        ("v += a(x, v) * h; x += v * h", "the same as semi-implicit-euler"),
        // Heun's method is the midpoint method on linear forces.
        (
            "let k = a(x, v); let w = v + h * k; let l = a(x + h * v, w); x += h * (v + w) / 2; v += h * (k + l) / 2",
            "the same as improved-euler",
        ),
        (
            "x = 3 * x + 20 * h * h * a(x, v); v = 7 * v - 5 * x",
            "near none of the built-in methods",
        ),
    ] {
        let about = own_method("told", lines).unwrap().about;
        assert!(about.ends_with(told), "{about}");
    }
}

#[test]
fn a_force_held_over_substeps_has_the_order_of_a_step_with_one() {
    let held = METHODS.iter().find(|method| method.id == "held-force").unwrap();
    let card = own_method("held-lines", held.code).unwrap();
    assert_eq!([card.order, card.order_with_drag, card.default_substeps], [1, 1, 4]);
    assert!(card.about.starts_with("with 1 substep order 1.00; "), "{}", card.about);
}

#[test]
fn the_time_of_a_call_follows_from_its_place_in_the_step() {
    let parts = |text: &str| -> Vec<f64> {
        StepText::read(text).unwrap().calls().iter().map(|call| call.part).collect()
    };
    let code = |id: &str| METHODS.iter().find(|method| method.id == id).unwrap().code;
    assert_eq!(parts(code("rk4")), [0.0, 0.5, 0.5, 1.0]);
    assert_eq!(parts(code("position-verlet")), [0.5]);
    assert_eq!(parts(code("velocity-verlet")), [0.0, 1.0]);
    assert_eq!(parts("v += h * a(x, v, h / 4); x += h * v"), [0.25]);
    // A ramp that only time makes, from rest: after a second v is its integral, which the middle has exactly.
    struct Ramp;
    impl System for Ramp {
        type Vector = f64;
        fn acceleration(&self, t: f64, _q: &f64, _v: &f64, a: &mut f64) {
            *a = t;
        }
    }
    let rk4 = own_method("ramp", code("rk4")).unwrap();
    let mut state = State { q: 0.0, v: 0.0 };
    integrator(rk4, &0.0).step(&problem(Ramp), 3.0, 1.0, &mut state).unwrap();
    assert!(
        (state.v - 3.5).abs() < 1e-15 && (state.q - (1.5 + 1.0 / 6.0)).abs() < 1e-15,
        "{state:?}"
    );
}

#[test]
fn a_call_in_a_block_is_made_only_if_the_block_runs() {
    let text = "memory n = 0\nlet k = a(x, v)\nif n < 2 {\n  v += h * a(x, v)\n} else {\n  v += h * k\n}\nx += h * v\nn = n + 1";
    let method = own_method("sometimes", text).unwrap();
    let system = problem(spring(2.0, 0.0));
    let mut state = State { q: 1.0, v: 0.0 };
    let mut stepper = integrator(method, &0.0);
    let counts = [(); 4].map(|()| {
        let before = system.evaluations();
        stepper.step(&system, 0.0, 0.01, &mut state).unwrap();
        system.evaluations() - before
    });
    assert_eq!(counts, [2, 2, 1, 1]);
    stepper.reset();
    let before = system.evaluations();
    stepper.step(&system, 0.0, 0.01, &mut state).unwrap();
    assert_eq!(system.evaluations() - before, 2, "a reset gives the memory its first value");
}

#[test]
fn ids_come_from_file_names_and_never_shadow_built_in_methods() {
    for (stem, id) in
        [("my_RK4", "my-rk4"), ("Game.Verlet", "game-verlet"), ("é", ""), ("-a--b-", "a-b")]
    {
        assert_eq!(own_method_id(stem), id);
    }
    assert!(check_own_id("my-rk4").is_ok());
    for id in ["", "rk4", "My", "a--b", "a_b"] {
        assert!(check_own_id(id).is_err(), "{id}");
    }
    let [one, other] = ["x += h * v; v += h * a(x, v)", "v += h * a(x, v); x += h * v"]
        .map(|text| own_method("twin", text).unwrap());
    assert!(
        one != other
            && std::ptr::eq(one, own_method("twin", "x += h * v; v += h * a(x, v)").unwrap())
    );
}

#[test]
fn threads_that_read_the_same_lines_share_one_method() {
    let read = || own_method("shared", "x += h * v; v += h * a(x, v) * 1").unwrap();
    let methods = std::thread::scope(|scope| {
        [(); 4].map(|()| scope.spawn(read)).map(|thread| thread.join().unwrap())
    });
    assert!(methods.iter().all(|method| std::ptr::eq(*method, methods[0])));
}

#[test]
fn scene_recording_and_link_carry_the_lines() {
    let lines = "// \"mine\" \\ é\r\nv += h * a(x, v)\n\tx += h * v\n";
    let lane = LaneSpec::from_step("dir/My_Euler.step", lines.as_bytes()).unwrap();
    assert_eq!(lane.method.id, "my-euler");
    let rk4 = METHODS.iter().find(|method| method.id == "rk4").unwrap();
    let mut scene = Scene::built_in("spring").unwrap().with_methods(&[lane.method, rk4]);
    scene.opening_method = Some(lane.method);
    let again = Scene::parse("again.toml", &scene.to_toml()).unwrap();
    assert_eq!(again.lanes, scene.lanes);
    assert!(std::ptr::eq(again.lanes[0].method, lane.method));
    assert!(again.methods_for_games().any(|method| method == lane.method));
    carries_its_lines(scene);
}

/// Runs a recording of the scene and a link to it, and holds both to the recorded hashes.
fn carries_its_lines(scene: Scene) {
    let mut session = Session::racing(scene.into());
    session.run(90);
    let text = session.recording_text(90).unwrap();
    let recorded = Scene::parse("recorded.toml", &text).unwrap();
    let packed = link::text(&link::link_to_run(&recorded).unwrap()).unwrap();
    for scene in [recorded, Scene::parse("link", &packed).unwrap()] {
        let checks = scene.checks.clone();
        let mut replay = Session::racing(scene.into());
        replay.run(90);
        let last = checks.iter().filter(|check| check.tick == 90);
        for check in last {
            assert_eq!(replay.race().lane_hash(check.lane), Some(check.hash));
        }
        assert!(checks.iter().any(|check| check.tick == 90));
    }
}

/// Linear rules, the frame rates of their authors, and the kinds of their bodies.
const RULES: [(&str, &str, &str); 7] = [
    ("v = (v + (target - x) * 0.2) * 0.85; x += v", "60", "spring"),
    ("v += ((target - x) * 100 - v * 5 - 9.8) * dt; x += v * dt", "59.94", "spring"),
    ("v += (target - x) * 40 * dt; v *= 0.5; x += v * dt", "50", "spring"),
    ("old = x; x += (x - prev) * 0.98 - x * 0.01; prev = old", "30", "spring"),
    ("x += (target - x) * 20 * dt", "1/0.015", "follow"),
    ("x = x * 0.8 + target * 0.1 + 0.3", "144", "follow"),
    ("v *= 0.9; x += v * dt", "60", "law"),
];

#[test]
fn a_rule_is_exact_only_at_its_authors_rate() {
    use regatta::run::race::Race;
    use regatta::tools::rule::rule_scene;

    for (text, fps, kind) in RULES {
        let scene = rule_scene("a/my rule.step", text, fps.parse().unwrap()).unwrap();
        assert_eq!((scene.bodies[0].kind.id, scene.name.as_str()), (kind, "my-rule"));
        let mut race = Race::of_scene(&scene);
        let mut farthest = [0.0_f64; 3];
        // Through both kicks.
        for _ in 0..race.nearest_tick(scene.seconds) {
            race.run(1);
            let truth = &race.truth().bodies()[0].stepper;
            for (farthest, entrant) in farthest.iter_mut().zip(race.entrants()) {
                let lane = &entrant.lane.bodies()[0].stepper;
                assert!(lane.q()[0].is_finite() && lane.v()[0].is_finite(), "{text}");
                *farthest = farthest.max((truth.q()[0] - lane.q()[0]).abs());
            }
        }
        let [half, own, twice] = farthest;
        assert!(own < 1e-9, "{text}: {own}");
        assert!(half > 1e-3 && twice > 1e-3, "{text}: {farthest:?}");
        let again = Scene::parse("again", &scene.to_toml()).unwrap();
        assert!(std::ptr::eq(again.own_methods[0], scene.own_methods[0]), "{text}");
        assert!(scene.methods_for_games().all(|method| method.rule_fps().is_none()));
        carries_its_lines(scene);
    }
}
