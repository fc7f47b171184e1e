//! Equations of motion that a scene writes itself.

use regatta::lab::{Judge, LaneSpec, Scene, SceneBody};
use regatta::sim::bodies::kind;
use regatta::sim::integrators::METHODS;
use regatta::sim::{Solver, Stepper};

#[path = "dice/mod.rs"]
mod dice;

use dice::Dice;

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
        for method in METHODS {
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
fn verdicts_on_the_built_in_bodies_as_laws_are_equal_to_the_last_printed_digit() {
    let judged = |body: &SceneBody| -> Vec<String> {
        let mut scene = parse(TWINS[0].0).unwrap();
        let name = "twin".to_owned();
        scene.bodies = vec![SceneBody { name, ..body.clone() }];
        let judge = Judge::new(&scene, 1.0);
        let verdicts = METHODS.iter().map(|method| judge.verdict(LaneSpec::plain(method), 60));
        verdicts.map(|verdict| verdict.to_string()).collect()
    };
    for (built_in, law) in twins() {
        for ((method, a), b) in METHODS.iter().zip(judged(&built_in)).zip(judged(&law)) {
            assert_eq!(a, b, "{} under {}", built_in.kind.id, method.id);
        }
    }
}

#[test]
fn a_law_is_written_and_read_again_to_the_bit() {
    let text = "title = 'Mine'\ntick_hz = 60\nseconds = 10\n[[law]]\nname = 'one \"two\"'\nplane = ['y', 'x']\n\
                energy = 'm*(vx^2 + vy^2)/2 + m*g*y'\nconstants = { m = 0.1, g = 9.81 }\n\
                [law.coordinates.x]\nstart = 0.3\nunit = 'km'\nstart_velocity = -1e-7\nacceleration = '0*x'\n\
                exact = 'x0 + vx0*t'\n[law.coordinates.y]\nkick = 2\nacceleration = '-g'\n\
                exact = 'y0 + vy0*t - g*t^2/2'\n\
                [[command]]\ntick = 3\nset = { body = 'one \"two\"', key = 'g', value = 1.62 }\n";
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
    assert!(std::ptr::eq(a.kind, b.kind), "the same text has the same kind");
    assert_eq!(scene.script, again.script);
}

/// What is said of a law `x` with this acceleration, and of the whole file.
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
fn a_claim_that_is_false_is_refused_and_a_true_one_is_not() {
    let with = |c: &str, energy: &str, more: &str| {
        let text = format!(
            "[[law]]\nconstants = {{ m = 2, k = 8, c = {c} }}\n{energy}\n[law.coordinates.x]\nstart = 0.5\n\
             acceleration = '-(k*x + c*vx)/m'\n{more}"
        );
        parse(&text).map(|_| ()).unwrap_or_else(|errors| panic!("{errors}"))
    };
    let refused = |c: &str, energy: &str, more: &str| {
        let text = format!(
            "[[law]]\nconstants = {{ m = 2, k = 8, c = {c} }}\n{energy}\n[law.coordinates.x]\nstart = 0.5\n\
             acceleration = '-(k*x + c*vx)/m'\n{more}"
        );
        parse(&text).expect_err(&text)
    };
    let energy = "energy = 'm*vx^2/2 + k*x^2/2'";
    with("0", energy, "exact = 'x0*cos(sqrt(k/m)*t) + vx0*sin(sqrt(k/m)*t)/sqrt(k/m)'");
    with("0.0", energy, "");
    let lossy = refused("0.01", energy, "");
    assert!(lossy.starts_with("mine.toml:6:11: the energy is not conserved"), "{lossy}");
    let half = refused("0", "energy = 'm*vx^2/2 + k*x^2'", "");
    assert!(half.contains("not conserved"), "{half}");
    let slow = refused("0", "", "exact = 'x0*cos(sqrt(k/m)*1.0000001*t)'");
    assert!(slow.contains("its second derivative is"), "{slow}");
    let elsewhere = refused("0", "", "exact = '0.4*cos(sqrt(k/m)*t)'");
    assert!(elsewhere.contains("`x` begins at 0.4, and `start` is 0.5"), "{elsewhere}");
    let moving = refused("0", "", "exact = 'x0*cos(sqrt(k/m)*t) + sin(sqrt(k/m)*t)'");
    assert!(moving.contains("`vx` begins at 2, and `start_velocity` is 0"), "{moving}");
}

#[test]
fn an_exact_solution_is_the_truth_until_somebody_intervenes() {
    let law = body(
        "[[law]]\nconstants = { w = 3 }\n[law.coordinates.x]\nstart = 0.5\nacceleration = '-w*w*x'\n\
         exact = 'x0*cos(w*t) + vx0*sin(w*t)/w'",
    );
    let mut truth = stepper(&law, Solver::Truth);
    for tick in 0..600 {
        truth.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    let exact = 0.5 * libm::cos(3.0 * (599.0 / 60.0 + 1.0 / 60.0));
    assert_eq!(truth.q()[0], exact);
    let before = truth.truth_error().unwrap();
    assert!(before[0] > 0.0 && before[0] < 1e-13);
    // After a kick the reference goes on from the same state.
    truth.input(10.0, regatta::sim::bodies::Input::Kick(1.0));
    let (q, v) = (truth.q()[0], truth.v()[0]);
    truth.advance(10.0, 1.0, 1).unwrap();
    let after = q * libm::cos(3.0) + v * libm::sin(3.0) / 3.0;
    assert!((truth.q()[0] - after).abs() < 1e-12, "{} and {after}", truth.q()[0]);
    assert!(truth.truth_error().unwrap()[0] < 1e-10);
}

#[test]
fn the_reference_meets_corners_and_jumps() {
    // A ball on a floor of stiff springs, against the closed form: parabolas and halves of sines.
    let law = body(
        "[[law]]\nconstants = { g = 9.81, w2 = 400 }\n[law.coordinates.y]\nstart = 1\n\
         acceleration = 'if(y < 0, -w2*y, 0) - g'",
    );
    let mut truth = stepper(&law, Solver::Truth);
    let (g, w2) = (9.81_f64, 400.0_f64);
    let fall = (2.0 / g).sqrt();
    let speed = (2.0 * g).sqrt();
    // About its rest -g/w2 it swings from 0 downwards and back to 0.
    let rest = g / w2;
    let w = w2.sqrt();
    let contact = 2.0 * (std::f64::consts::PI - libm::atan2(speed / w, rest)) / w;
    let contact = if contact > 0.0 { contact } else { f64::NAN };
    let period = 2.0 * fall + contact;
    let mut t = 0.0;
    let mut worst = 0.0_f64;
    for tick in 0..1200 {
        truth.advance(t, 1.0 / 60.0, 1).unwrap();
        t = f64::from(tick + 1) / 60.0;
        let phase = t % period;
        let expected = if phase <= fall {
            1.0 - g * phase * phase / 2.0
        } else if phase >= fall + contact {
            let back = period - phase;
            1.0 - g * back * back / 2.0
        } else {
            let s = phase - fall;
            -rest + rest * libm::cos(w * s) - speed / w * libm::sin(w * s)
        };
        worst = worst.max((truth.q()[0] - expected).abs());
    }
    let said = truth.truth_error().unwrap()[0];
    assert!(worst < 1e-9, "{worst:e} m, {said:e} m said");
    assert!(said < 1e-8, "{said:e} m said");
    // A force that jumps: y″ = -sign(y), whose period from y = 1/2 is 4.
    let law = body("[[law]]\n[law.coordinates.y]\nstart = 0.5\nacceleration = '-sign(y)'");
    let mut truth = stepper(&law, Solver::Truth);
    for tick in 0..480 {
        truth.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    assert!((truth.q()[0] - 0.5).abs() < 1e-11, "{}", truth.q()[0]);
    // A pulse that begins and ends between two ticks.
    let law =
        body("[[law]]\n[law.coordinates.y]\nacceleration = 'if(t > 0.105 and t < 0.112, 1000, 0)'");
    let mut truth = stepper(&law, Solver::Truth);
    for tick in 0..60 {
        truth.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    assert!((truth.v()[0] - 7.0).abs() < 1e-10, "{}", truth.v()[0]);
}

#[test]
fn a_jump_lowers_the_measured_order_and_the_verdict_claims_no_more() {
    // RK4 has order 4 on the smooth law, and about 1 with a jump that it meets at any part of a step.
    let error = |acceleration: &str, hz: u32| {
        let law = body(&format!(
            "[[law]]\n[law.coordinates.x]\nstart = 0.7\nacceleration = '{acceleration}'"
        ));
        let method = METHODS.iter().find(|method| method.id == "rk4").unwrap();
        let [mut lane, mut truth] =
            [Solver::Method(method), Solver::Truth].map(|solver| stepper(&law, solver));
        let mut worst = 0.0_f64;
        for tick in 0..10 * hz {
            let (t, h) = (f64::from(tick) / f64::from(hz), 1.0 / f64::from(hz));
            [&mut lane, &mut truth].into_iter().for_each(|it| it.advance(t, h, 1).unwrap());
            worst = worst.max((lane.q()[0] - truth.q()[0]).abs());
        }
        assert!(truth.truth_error().unwrap()[0] < 1e-9);
        worst
    };
    let order =
        |acceleration: &str| (error(acceleration, 25) / error(acceleration, 400)).log2() / 4.0;
    let (smooth, jumping) = (order("-x - 2*tanh(x)"), order("-x - 2*sign(x)"));
    assert!((3.7..4.5).contains(&smooth), "{smooth}");
    assert!((0.5..2.2).contains(&jumping), "{jumping}");
    let scene = parse("[[law]]\n[law.coordinates.x]\nstart = 0.7\nacceleration = '-x - 2*sign(x)'")
        .unwrap();
    let rk4 = METHODS.iter().find(|method| method.id == "rk4").unwrap();
    let verdict = Judge::new(&scene, 1.0).verdict(LaneSpec::plain(rk4), 25);
    assert!(verdict.error > 1e-4, "{verdict}");
}

#[test]
fn under_dry_friction_at_rest_there_is_no_truth_and_the_verdict_says_so() {
    let scene =
        parse("[[law]]\n[law.coordinates.x]\nstart = 1\nacceleration = '-x - 0.3*sign(vx)'")
            .unwrap();
    let rk4 = METHODS.iter().find(|method| method.id == "rk4").unwrap();
    let verdict = Judge::new(&scene, 1.0).verdict(LaneSpec::plain(rk4), 60);
    assert!(verdict.to_string().starts_with("no truth"), "{verdict}");
}

/// A random expression in x, v and t, smooth or with corners, of bounded size.
fn expression(dice: &mut Dice, depth: usize) -> String {
    let mut pick = |n: usize| (dice.part() * n as f64) as usize;
    if depth == 0 {
        return match pick(6) {
            0 => "x".into(),
            1 => "y".into(),
            2 => "vx".into(),
            3 => "k".into(),
            4 => "cos(2*t)".into(),
            _ => format!("{:.3}", dice.between(-2.0, 2.0)),
        };
    }
    let kind = pick(9);
    let a = expression(dice, depth - 1);
    let b = expression(dice, depth - 1);
    match kind {
        0 => format!("({a} + {b})"),
        1 => format!("({a} - {b})"),
        2 => format!("tanh({a})*sin({b})"),
        3 => format!("{a}/(1 + ({b})^2)"),
        4 => format!("sqrt(1 + ({a})^2)"),
        5 => format!("hypot({a}, 1 + abs(sin({b})))"),
        6 => format!("max({a}, {b})"),
        7 => format!("atan({a})"),
        _ => format!("table({a}, [[-1, 0.5], [0, -0.25], [1, 0.75]])"),
    }
}

/// A classical Runge-Kutta solution at a fine step: independent of the reference.
fn by_runge_kutta(body: &SceneBody, seconds: f64, steps: u32) -> Vec<f64> {
    let field = stepper(body, Solver::Truth);
    let mut y: Vec<f64> = field.q().iter().chain(field.v()).copied().collect();
    let n = y.len() / 2;
    let h = seconds / f64::from(steps);
    let slope = |t: f64, y: &[f64]| {
        let mut d = y[n..].to_vec();
        let mut a = vec![0.0; n];
        field.acceleration(t, &y[..n], &y[n..], &mut a);
        d.extend(a);
        d
    };
    for step in 0..steps {
        let t = f64::from(step) * h;
        let moved =
            |k: &[f64], h: f64| -> Vec<f64> { y.iter().zip(k).map(|(y, k)| y + h * k).collect() };
        let k1 = slope(t, &y);
        let k2 = slope(t + h / 2.0, &moved(&k1, h / 2.0));
        let k3 = slope(t + h / 2.0, &moved(&k2, h / 2.0));
        let k4 = slope(t + h, &moved(&k3, h));
        for (i, y) in y.iter_mut().enumerate() {
            *y += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
    }
    y
}

#[test]
fn the_reference_of_fifty_random_laws_agrees_with_an_independent_integrator() {
    let mut dice = Dice::new(1);
    let (mut tried, mut smooth) = (0, 0);
    while tried < 50 {
        let [f, g] = [(); 2].map(|()| expression(&mut dice, 3));
        let text = format!(
            "[[law]]\nconstants = {{ k = 1.5 }}\n[law.coordinates.x]\nstart = 0.4\nacceleration = \"-3*x - 0.4*vx + {f}\"\n\
             [law.coordinates.y]\nstart = -0.3\nacceleration = \"-2*y - 0.5*vy + {g}\""
        );
        let law = body(&text);
        let mut truth = stepper(&law, Solver::Truth);
        for tick in 0..120 {
            truth
                .advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1)
                .unwrap_or_else(|error| panic!("{error}\n{text}"));
        }
        let found: Vec<f64> = truth.q().iter().chain(truth.v()).copied().collect();
        let size = found.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        let [fine, finer] = [20_000, 40_000].map(|steps| by_runge_kutta(&law, 2.0, steps));
        let far =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Richardson's estimate of the error of Runge-Kutta, which corners make large.
        let own = far(&fine, &finer) + 1e-12 * size;
        let error = far(&found, &finer);
        let said = truth.truth_error().unwrap().into_iter().fold(0.0, f64::max);
        assert!(error <= 4.0 * own + 1e-10 * size, "{error:e}, {own:e} by Runge-Kutta\n{text}");
        assert!(said < 1e-10 * size, "{said:e} said\n{text}");
        smooth += u32::from(own < 1e-10 * size);
        tried += 1;
    }
    assert!(smooth > 20, "{smooth} of 50 could be compared to 1e-10");
}

#[test]
fn three_hundred_thousand_mutated_expressions_are_read_or_refused_in_place() {
    use regatta::sim::law::{CoordinateText, Equations, LawText, Part};
    const PIECES: [&str; 40] = [
        "x",
        "vx",
        "k",
        "t",
        "pi",
        "1",
        "2.5",
        "1e3",
        "0",
        "+",
        "-",
        "*",
        "/",
        "^",
        "(",
        ")",
        "[",
        "]",
        ",",
        " ",
        "sin(",
        "if(",
        "table(x,[[0,1],[1,2]])",
        "max(",
        "<",
        ">=",
        "==",
        "and ",
        "not ",
        "or ",
        "é",
        "\u{0}",
        "=",
        ".",
        "e",
        "hypot(",
        "((((((((",
        "--------",
        "x^9^9",
        "\u{1F600}",
    ];
    const SEEDS: [&str; 5] = [
        "-k*x - vx",
        "if(x > 0 and t < 3, table(x, [[0,1],[1,2]]), clamp(x, -1, 1))",
        "k*sin(x)^2/(1 + hypot(x, vx))",
        "max(min(x, k), -k)*step(t - 1)^3",
        "2^-2*x^3 - not_a_name(3) + floor(x)",
    ];
    let mut dice = Dice::new(2);
    let (mut good, mut bad) = (0, 0);
    for _ in 0..300_000 {
        let mut text: Vec<char> = SEEDS[(dice.part() * 5.0) as usize].chars().collect();
        for _ in 0..1 + (dice.part() * 6.0) as usize {
            let at = (dice.part() * (text.len() + 1) as f64) as usize;
            match (dice.part() * 3.0) as usize {
                0 if at < text.len() => drop(text.remove(at)),
                1 if at < text.len() => {
                    let to = (at + (dice.part() * 9.0) as usize).min(text.len());
                    let copy: Vec<char> = text[at..to].to_vec();
                    text.splice(at..at, copy);
                }
                _ => {
                    let piece = PIECES[(dice.part() * 40.0) as usize];
                    text.splice(at..at, piece.chars());
                }
            }
        }
        let acceleration: String = text.into_iter().collect();
        let coordinate = CoordinateText {
            name: "x".into(),
            unit: "m",
            acceleration: acceleration.clone(),
            exact: None,
        };
        let law = LawText {
            constants: vec!["k".into()],
            coordinates: vec![coordinate],
            energy: None,
            plane: None,
        };
        match Equations::new(law) {
            Ok(_) => good += 1,
            Err(refusals) => {
                bad += 1;
                for refusal in refusals {
                    assert_eq!(refusal.part, Part::Acceleration(0));
                    assert!(
                        acceleration.get(refusal.span.clone()).is_some(),
                        "{acceleration:?}: {refusal:?}"
                    );
                    assert!(
                        !refusal.span.is_empty() || acceleration.trim().is_empty(),
                        "{acceleration:?}: {refusal:?}"
                    );
                }
            }
        }
    }
    assert!(good > 10_000 && bad > 100_000, "{good} read, {bad} refused");
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
fn a_law_of_any_text_has_one_kind_and_the_table_of_bodies_has_none() {
    assert!(kind("law").is_none());
    let [a, b] = ["1", "2"].map(|k| {
        body(&format!(
            "[[law]]\nconstants = {{ k = {k} }}\n[law.coordinates.x]\nacceleration = '-k*x'"
        ))
    });
    assert!(std::ptr::eq(a.kind, b.kind) && a.values != b.values);
    assert_eq!(a.kind.leading, "k");
    let keys: Vec<_> = a.kind.parameters.iter().map(|parameter| parameter.key).collect();
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
