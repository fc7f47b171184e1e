//! Equations of motion that a scene writes itself.

use regatta::measure::Judge;
use regatta::scene::{LaneSpec, Scene, SceneBody};
use regatta::sim::bodies::kind;
use regatta::sim::integrators::METHODS;
use regatta::sim::{Solver, Stepper};
use regatta::studio::TICK_LADDER;

mod drawn;
mod floor;
mod language;
mod random;
mod rate;
mod truth;

use crate::dice::Dice;
use crate::words::everything;

fn parse(text: &str) -> Result<Scene, String> {
    let text = format!("title = 'Mine'\ntick_hz = 60\nseconds = 10\n{text}");
    Scene::parse("mine.toml", &text).map_err(|errors| errors.to_string())
}

fn body(text: &str) -> SceneBody {
    parse(text).unwrap_or_else(|errors| panic!("{errors}")).bodies.remove(0)
}

fn stepper(body: &SceneBody, solver: Solver) -> Box<dyn Stepper> {
    (body.kind.build)(&body.values, solver)
}

/// A built-in body and the same as a law, in the same order of operations.
const TWINS: [(&str, &str); 4] = [
    (
        "[[spring]]\nmass_kg = 1.3\nstiffness_n_per_m = 41.7\ndamping_n_s_per_m = 0.3\nx0_m = 0.7\nkick_n_s = 0",
        "[[law]]\nconstants = { m = 1.3, k = 41.7, c = 0.3 }\n[law.coordinates.x]\nstart = 0.7\n\
         acceleration = \"-(k/m)*x - c/m*vx\"",
    ),
    (
        "[[pendulum]]\nlength_m = 0.9\nmass_kg = 1.1\ndamping_n_m_s = 0.05\ntheta0_rad = 2.8",
        "[[law]]\nconstants = { l = 0.9, m = 1.1, g = 9.81, c = 0.05 }\n[law.coordinates.theta]\nunit = \"rad\"\n\
         start = 2.8\nacceleration = \"-(g/l)*sin(theta) - c/(m*l*l)*vtheta\"",
    ),
    (
        "[[ship]]\nthrust_n = 50000\ndrag_n_s_per_m = 2000\nmass_kg = 9000",
        "[[law]]\nconstants = { T = 50000, C = 2000, m = 9000 }\n[law.coordinates.s]\n\
         acceleration = \"T*throttle/m - C/m*vs\"",
    ),
    (
        "[[orbit]]\nmu_m3_per_s2 = 40\nx0_m = 3\nvy0_m_per_s = 3",
        "[[law]]\nplane = [\"x\", \"y\"]\nconstants = { mu = 40 }\nenergy = \"(vx*vx + vy*vy)/2 - mu/sqrt(x*x + y*y)\"\n[law.coordinates.x]\nstart = 3\n\
         acceleration = \"MU_OVER_R3*x\"\n[law.coordinates.y]\nstart_velocity = 3\nacceleration = \"MU_OVER_R3*y\"",
    ),
];

fn twins() -> impl Iterator<Item = (SceneBody, SceneBody)> {
    TWINS.into_iter().map(|(built_in, law)| {
        let law = law.replace("MU_OVER_R3", "-(mu/((x*x + y*y)*sqrt(x*x + y*y)))");
        (body(built_in), body(&law))
    })
}

#[test]
fn the_built_in_bodies_as_laws_have_the_same_bits_under_every_method() {
    for (built_in, law) in twins() {
        // An engine knows the stiffness of a spring but only the force of a law.
        for method in
            METHODS.iter().filter(|method| !method.is_of_library() && !method.is_for_spin())
        {
            let [mut a, mut b] = [&built_in, &law].map(|it| stepper(it, Solver::Method(method)));
            for tick in 0..600 {
                let t = f64::from(tick) / 60.0;
                let place = format!("{} under {} at tick {tick}", built_in.kind.id, method.id);
                let [ended, as_law] =
                    [&mut a, &mut b].map(|it| it.advance(t, 1.0 / 60.0, 1).is_ok());
                assert_eq!(ended, as_law, "{place}");
                let bits = |it: &dyn Stepper| -> Vec<u64> {
                    it.q().iter().chain(it.v()).map(|x| x.to_bits()).collect()
                };
                assert_eq!(bits(&*a), bits(&*b), "{place}");
                if !ended {
                    break;
                }
            }
        }
    }
}

#[test]
fn built_in_bodies_as_laws_have_the_same_verdicts() {
    let judged = |body: &SceneBody| -> Vec<String> {
        let mut scene = parse(TWINS[0].0).unwrap();
        scene.bodies = vec![body.clone()];
        scene.bodies[0].name = "twin".to_owned();
        let judge = Judge::new(&scene);
        let methods =
            METHODS.iter().filter(|method| !method.is_of_library() && !method.is_for_spin());
        let verdicts = methods.map(|method| judge.verdict(LaneSpec::plain(method), 60));
        verdicts.map(|verdict| everything(&verdict)).collect()
    };
    for (built_in, law) in twins() {
        let methods =
            METHODS.iter().filter(|method| !method.is_of_library() && !method.is_for_spin());
        for ((method, a), b) in methods.zip(judged(&built_in)).zip(judged(&law)) {
            assert_eq!(a, b, "{} under {}", built_in.kind.id, method.id);
        }
    }
}

#[test]
fn a_law_survives_writing_and_reading_to_the_bit() {
    let text = "title = 'Mine'\ntick_hz = 60\nseconds = 10\n[[law]]\nname = 'one \"two\"'\nplane = ['y', 'x']\n\
                energy = 'm*(vx^2 + vy^2)/2 + m*g*y'\nconstants = { m = 0.1, g = 9.81 }\n\
                [law.coordinates.x]\nstart = 0.3\nunit = 'km'\nstart_velocity = -1e-7\nacceleration = '0*x'\n\
                exact = 'x0 + vx0*t'\n[law.coordinates.y]\nkick = 2\nacceleration = '-g'\n\
                exact = 'y0 + vy0*t - g*t^2/2'\n\
                [[command]]\nat_s = 0.05\nset = { body = 'one \"two\"', key = 'g', value = 1.62 }\n";
    let scene = Scene::parse("mine.toml", text).unwrap();
    let written = scene.to_toml();
    let again =
        Scene::parse("mine.toml", &written).unwrap_or_else(|errors| panic!("{errors}\n{written}"));
    assert_eq!(again.to_toml(), written);
    let [a, b] = [&scene, &again].map(|scene| &scene.bodies[0]);
    assert_eq!(
        a.values.iter().map(|x| x.to_bits()).collect::<Vec<_>>(),
        b.values.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
    );
    assert!(a.kind == b.kind, "the same text has the same kind");
    assert_eq!(scene.script, again.script);
}

/// The error message for a law `x` with this acceleration, and for the whole file.
fn refusal(acceleration: &str) -> String {
    let text = format!(
        "[[law]]\nconstants = {{ k = 2, zero = 0 }}\n[law.coordinates.x]\nacceleration = \"{acceleration}\""
    );
    parse(&text).map(|_| String::from("none")).unwrap_or_else(|errors| errors)
}

#[test]
fn a_mistake_in_an_expression_is_found_at_its_column_with_a_remedy() {
    // The expression begins in column 17 of line 7.
    for (acceleration, column, wanted) in [
        (
            "-k*y",
            20,
            "unknown name `y`; write one of `t`, `throttle`, `rudder`, `x`, `vx`, `k`, `zero`, `pi`",
        ),
        ("-k*zer", 20, "unknown name `zer`; did you mean `zero`?"),
        ("sqr(x)", 17, "unknown function `sqr`; did you mean `sqrt`?"),
        ("2x", 17, "`2x` is neither a number nor a name; write `2*x`, or a `2` alone"),
        ("k x", 19, "`x` follows a complete expression; write an operator before it, such as `*`"),
        ("k*(x", 20, "the text ends where `)` is missing; write `)` after the part in brackets"),
        ("x)", 18, "`)` closes nothing; remove it, or open it before"),
        ("x**2", 18, "`**` has no meaning here; write `^`"),
        ("if(x, 1, 2)", 20, "`x` is a number, not a condition; compare it, such as `x > 0`"),
        (
            "x > 0",
            17,
            "`x > 0` is true or false, not a number; write `if(condition, 1, 0)` for a number",
        ),
        ("if(0 < x < 1, 1, 2)", 26, "`<` follows another comparison; write `a < b and b < c`"),
        ("atan2(x)", 17, "`atan2` does not take these arguments; write `atan2(y, x)`"),
        ("1e999", 17, "`1e999` is too large; write a smaller number"),
        ("table(x, [[1, 2], [1, 3]])", 35, "the points go from x = 1 to 1; order them by rising x"),
        (
            "k/x",
            17,
            "`k/x` divides by zero at the start; give another start or other constants, or guard it with `if` or `max`",
        ),
        (
            "k/(zero*x) + 1",
            17,
            "`k/(zero*x)` divides by zero at the start; give another start or other constants, or guard it with `if` or `max`",
        ),
        (
            "1 + ln(x)",
            21,
            "`ln(x)` is not finite at the start; give another start or other constants, or guard it with `if` or `max`",
        ),
        ("x0", 17, "`x0` is the start of a coordinate, which only `exact` knows; remove it"),
        ("", 16, "the expression is empty; write one"),
    ] {
        assert_eq!(
            refusal(acceleration),
            format!("mine.toml:7:{column}: {wanted}"),
            "{acceleration}"
        );
    }
    let deep = format!("{}x{}", "(".repeat(100), ")".repeat(100));
    assert!(
        refusal(&deep).starts_with("mine.toml:7:82: the expression is nested more than 64 deep")
    );
    assert_eq!(
        refusal("if(x > 0, k/x, 1)"),
        "none",
        "the branch that is not taken may be undefined"
    );
}

#[test]
fn whole_exponents_have_the_bits_of_products() {
    let value = |acceleration: &str, x: f64| {
        let law = body(&format!(
            "[[law]]\n[law.coordinates.x]\nstart = 1\nacceleration = '{acceleration}'"
        ));
        let mut a = [0.0];
        stepper(&law, Solver::Truth).acceleration(0.0, &[x], &[0.0], &mut a);
        a[0].to_bits()
    };
    let mut dice = Dice::new(3);
    for _ in 0..200 {
        let x = dice.between(-3.0, 3.0);
        assert_eq!(value("x^2", x), (x * x).to_bits());
        assert_eq!(value("-x^3", x), (-(x * x * x)).to_bits());
        assert_eq!(value("x^-2", x), (1.0 / (x * x)).to_bits());
        assert_eq!(value("abs(x)^0.5", x), libm::pow(x.abs(), 0.5).to_bits());
        assert_eq!(value("2 - x - 1 + 3*x/7", x), (2.0 - x - 1.0 + 3.0 * x / 7.0).to_bits());
    }
}

#[test]
fn laws_share_one_kind_outside_the_table_of_bodies() {
    assert!(kind("law").is_none());
    let [a, b] = ["1", "2"].map(|k| {
        body(&format!(
            "[[law]]\nconstants = {{ k = {k} }}\n[law.coordinates.x]\nacceleration = '-k*x'"
        ))
    });
    assert!(a.kind == b.kind && a.values != b.values);
    assert_eq!(a.kind.leading, "k");
    let keys: Vec<_> = a.kind.parameters.iter().map(|parameter| &*parameter.key).collect();
    assert_eq!(keys, ["k", "x.start", "x.start_velocity", "x.kick"]);
    let mut steppers = [a, b].map(|body| stepper(&body, Solver::Truth));
    assert!(steppers[0].set_parameter(0.0, 0, 2.0) && !steppers[0].set_parameter(0.0, 1, 3.0));
    let accelerations = steppers.each_mut().map(|stepper| {
        let mut a = [0.0];
        stepper.acceleration(0.0, &[1.0], &[0.0], &mut a);
        a[0]
    });
    assert_eq!(accelerations, [-2.0, -2.0]);
}

#[test]
fn the_drone_is_lost_or_hovers_as_its_hint_states() {
    let scene = Scene::built_in("lift").unwrap();
    let place = TICK_LADDER.iter().position(|hz| scene.tick_hz == *hz).unwrap();
    assert_eq!(scene.tick_hz, 30);
    // How far the altitude still moves in the last three seconds.
    let moves = |id: &str, hz: u32| {
        let method = METHODS.iter().find(|method| method.id == id).unwrap();
        let mut drone = stepper(&scene.bodies[0], Solver::Method(method));
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for tick in 0..15 * hz {
            let h = 1.0 / f64::from(hz);
            if drone.advance(f64::from(tick) * h, h, 1).is_err() || drone.q()[0].abs() > 1e6 {
                return f64::INFINITY;
            }
            if tick >= 12 * hz {
                (least, most) = (least.min(drone.q()[0]), most.max(drone.q()[0]));
            }
        }
        most - least
    };
    let ids = ["semi-implicit-euler", "velocity-verlet", "rk4"];
    assert_eq!([1, 2, 3].map(|lane| scene.lanes[lane].method.id), ids);
    let hovers = |hz: u32| ids.map(|id| moves(id, hz) < 0.01);
    assert_eq!(hovers(30), [true, false, true]);
    assert_eq!(hovers(TICK_LADDER[place - 1]), [false, false, true]);
    assert_eq!(moves("velocity-verlet", 30), f64::INFINITY);
}
