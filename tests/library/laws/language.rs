//! The functions and operators of expressions: values, derivatives, corners and jumps.

use regatta::sim::Solver;
use regatta::sim::bodies::Input;

use super::{body, parse, stepper};

/// The value of an expression of x, y and t.
fn value(expression: &str, [x, y]: [f64; 2]) -> f64 {
    let law = body(&format!(
        "[[law]]\n[law.coordinates.x]\nstart = {x:?}\nacceleration = '{expression}'\n\
         [law.coordinates.y]\nstart = {y:?}\nacceleration = '0*t'"
    ));
    let mut a = [0.0; 2];
    stepper(&law, Solver::Truth).acceleration(0.5, &[x, y], &[0.0; 2], &mut a);
    a[0]
}

#[test]
fn functions_and_operators_are_right_at_and_around_their_boundaries() {
    for (expression, at, wanted) in [
        ("atan2(x, y)", [1.0, -1.0], libm::atan2(1.0, -1.0)),
        ("atan2(x, y)", [-1.0, -2.0], libm::atan2(-1.0, -2.0)),
        ("hypot(x, y)", [3.0, 4.0], 5.0),
        ("ln(x) + exp(y)", [2.0, 0.5], libm::log(2.0) + libm::exp(0.5)),
        ("asin(x) - acos(y)", [0.3, 0.4], libm::asin(0.3) - libm::acos(0.4)),
        ("sin(x)*cos(y)/tan(x)", [0.7, 0.2], libm::sin(0.7) * libm::cos(0.2) / libm::tan(0.7)),
        ("tanh(x) + atan(y)", [0.6, 3.0], libm::tanh(0.6) + libm::atan(3.0)),
        ("sqrt(x) - y", [9.0, 1.0], 2.0),
        ("step(x)", [0.0, 0.0], 1.0),
        ("step(x)", [-1e-300, 0.0], 0.0),
        ("sign(x) + 10*sign(y)", [0.0, -3.0], -10.0),
        ("abs(x) + 10*abs(y)", [-2.0, 3.0], 32.0),
        ("floor(x) + 10*floor(y)", [-0.5, 2.0], 19.0),
        ("min(x, y) + 10*max(x, y)", [1.0, 2.0], 21.0),
        ("min(x, y) + 10*max(x, y)", [2.0, 1.0], 21.0),
        ("clamp(x, -1, 2) + 10*clamp(y, -1, 2)", [-3.0, 5.0], 19.0),
        ("clamp(x, -1, 2)", [0.5, 0.0], 0.5),
        ("table(x, [[0, 1], [2, 5], [4, 3]])", [2.0, 0.0], 5.0),
        ("table(x, [[0, 1], [2, 5], [4, 3]])", [3.0, 0.0], 4.0),
        ("table(x, [[0, 1], [2, 5]]) + 10*table(y, [[0, 1], [2, 5]])", [-1.0, 9.0], 51.0),
        ("if(x < y, 1, 2) + 10*if(x <= y, 1, 2)", [1.0, 1.0], 12.0),
        ("if(x > y, 1, 2) + 10*if(x >= y, 1, 2)", [1.0, 1.0], 12.0),
        ("if(x == y, 1, 2) + 10*if(x != y, 1, 2)", [1.0, 1.0], 21.0),
        ("if(x == y, 1, 2) + 10*if(x != y, 1, 2)", [1.0, 2.0], 12.0),
        ("if(x > 0 or y > 0, 1, 2) + 10*if(x > 0 and y > 0, 1, 2)", [1.0, -1.0], 21.0),
        ("if(x > 0 or y > 0, 1, 2) + 10*if(x > 0 and y > 0, 1, 2)", [1.0, 1.0], 11.0),
        ("if(not x > 0 or y > 0, 1, 2)", [1.0, -1.0], 2.0),
        ("if(x > 0 or y > 0 and t > 9, 1, 2)", [1.0, -1.0], 1.0),
        ("2 - 3 - x", [4.0, 0.0], -5.0),
        ("8/4/x", [2.0, 0.0], 1.0),
        ("2 + 3*x^2", [2.0, 0.0], 14.0),
        ("-x^2", [3.0, 0.0], -9.0),
        ("2^x^y", [3.0, 2.0], 512.0),
        ("2^-x*y", [1.0, 4.0], 2.0),
        ("x^0 + x^1 + x^-1", [4.0, 0.0], 5.25),
    ] {
        let found = value(expression, at);
        assert!((found - wanted).abs() <= 1e-15 * wanted.abs(), "{expression} at {at:?}: {found}");
    }
}

/// A function of t, its second derivative, and its value and slope at 0.
const DERIVATIVES: [(&str, &str, [f64; 2]); 24] = [
    ("sqrt(1+t)", "-0.25/((1+t)*sqrt(1+t))", [1.0, 0.5]),
    ("exp(-0.3*t)", "0.09*exp(-0.3*t)", [1.0, -0.3]),
    ("ln(2+t) - ln(2)", "-1/(2+t)^2", [0.0, 0.5]),
    ("sin(2*t)", "-4*sin(2*t)", [0.0, 2.0]),
    ("cos(2*t)", "-4*cos(2*t)", [1.0, 0.0]),
    ("sin(0.1*t^2)", "0.2*cos(0.1*t^2) - 0.04*t^2*sin(0.1*t^2)", [0.0, 0.0]),
    ("tan(0.05*t)", "0.005*tan(0.05*t)*(1 + tan(0.05*t)^2)", [0.0, 0.05]),
    ("asin(0.04*t)", "0.000064*t/(1 - 0.0016*t^2)^1.5", [0.0, 0.04]),
    ("acos(0.04*t) - pi/2", "-0.000064*t/(1 - 0.0016*t^2)^1.5", [0.0, -0.04]),
    ("atan(t)", "-2*t/(1+t^2)^2", [0.0, 1.0]),
    ("tanh(0.2*t)", "-0.08*tanh(0.2*t)*(1 - tanh(0.2*t)^2)", [0.0, 0.2]),
    ("atan2(t, 1+0.5*t)", "-(2.5*t + 1)/(t^2 + (1+0.5*t)^2)^2", [0.0, 1.0]),
    ("hypot(t, 3)", "9/hypot(t, 3)^3", [3.0, 0.0]),
    ("t^2*sin(t)", "2*sin(t) + 4*t*cos(t) - t^2*sin(t)", [0.0, 0.0]),
    (
        "sin(t)/(1+t^2)",
        "-sin(t)/(1+t^2) - (4*t*cos(t) + 2*sin(t))/(1+t^2)^2 + 8*t^2*sin(t)/(1+t^2)^3",
        [0.0, 1.0],
    ),
    ("(1+t)^1.5", "0.75/sqrt(1+t)", [1.0, 1.5]),
    ("(1+t)^2.5", "3.75*sqrt(1+t)", [1.0, 2.5]),
    ("2^(0.1*t)", "0.01*ln(2)^2*2^(0.1*t)", [1.0, 0.069_314_718_055_994_53]),
    (
        "(1+t)^(0.1*t)",
        "(1+t)^(0.1*t)*(0.1/(1+t) + 0.1/(1+t)^2 + (0.1*ln(1+t) + 0.1*t/(1+t))^2)",
        [1.0, 0.0],
    ),
    ("table(t, [[-1, -2], [30, 60]])", "0*t", [0.0, 2.0]),
    ("abs(-1-t)*t", "2", [0.0, 1.0]),
    ("max(t*t, -1) - min(9999, t)", "2", [0.0, -1.0]),
    ("if(t < 99, t^3, 0)", "6*t", [0.0, 0.0]),
    ("-(t - 3)*(t + 1)", "-2", [3.0, 2.0]),
];

#[test]
fn exact_solutions_are_tested_by_second_derivative_for_every_function() {
    for (exact, second, [start, slope]) in DERIVATIVES {
        let with = |acceleration: &str, start: f64, slope: f64| {
            parse(&format!(
                "[[law]]\n[law.coordinates.x]\nstart = {start}\nstart_velocity = {slope}\n\
                 acceleration = '{acceleration}'\nexact = '{exact}'"
            ))
        };
        with(second, start, slope).unwrap_or_else(|errors| panic!("{exact}: {errors}"));
        for wrong in [format!("({second})*1.000001 + 1e-7"), format!("({second})*0.999999 - 1e-7")]
        {
            let refused = with(&wrong, start, slope).expect_err(exact);
            assert!(refused.contains("its second derivative is"), "{exact}: {refused}");
        }
        assert!(with(second, start + 1e-5, slope).expect_err(exact).contains("begins at"));
        assert!(with(second, start, slope + 1e-5).expect_err(exact).contains("begins at"));
    }
}

#[test]
fn an_energy_that_jumps_is_not_conserved() {
    let law = |energy: &str| {
        parse(&format!(
            "[[law]]\nenergy = '{energy}'\n[law.coordinates.x]\nstart = -1\nstart_velocity = 1\nacceleration = '0*t'"
        ))
    };
    assert!(law("vx^2/2").is_ok());
    let refused = law("vx^2/2 + step(x - 1.5)").expect_err("a jump");
    assert!(refused.contains("is not conserved: it is 0.5"), "{refused}");
}

#[test]
fn the_reference_meets_the_jumps_of_floor_and_the_corners_of_tables() {
    for (acceleration, wanted) in [
        // The area of a stair of three steps a second, upwards and downwards.
        ("floor(3*t)", 1.0),
        ("floor(-3*t)", -2.0),
        ("table(t, [[0.1, 0], [0.3, 4], [0.35, -2]])", 0.4 + 0.05 - 1.3),
        ("abs(t - 0.4)", 0.08 + 0.18),
        ("min(t, 0.3) + max(t, 0.3)", 0.5 + 0.3),
        ("step(t - 0.3) - step(0.45 - t)", 0.7 - 0.45),
    ] {
        let law = body(&format!("[[law]]\n[law.coordinates.x]\nacceleration = '{acceleration}'"));
        let mut truth = stepper(&law, Solver::Truth);
        for tick in 0..10 {
            truth.advance(f64::from(tick) / 10.0, 0.1, 1).unwrap();
        }
        assert!((truth.v()[0] - wanted).abs() < 1e-12, "{acceleration}: {}", truth.v()[0]);
    }
}

#[test]
fn linearity_and_angles_are_recognised_from_the_text() {
    for (acceleration, is_linear, is_angle) in [
        ("-k*x - vx/k + sin(k)", true, false),
        ("-k*x + cos(t)", false, false),
        ("-k*x*t", false, false),
        ("k/x", false, false),
        ("x*vx", false, false),
        ("max(x, 0)", false, false),
        ("-k*sin(x) - vx", false, true),
        ("-k*sin(x) - x", false, false),
        ("-k*sin(2*x)", false, false),
    ] {
        let law = body(&format!(
            "[[law]]\nconstants = {{ k = 2 }}\n[law.coordinates.x]\nstart = 1\nacceleration = '{acceleration}'"
        ));
        let equations = law.kind.law().unwrap();
        assert_eq!(equations.is_linear(), is_linear, "{acceleration}");
        assert_eq!(equations.is_angle(0), is_angle, "{acceleration}");
    }
}

#[test]
fn kicks_and_constants_act_at_once_and_starts_do_not() {
    let text = "[[law]]\nconstants = { k = 4 }\n[law.coordinates.x]\nstart = 1\nkick = 1.5\n\
                acceleration = '-k*k*x'\nexact = 'x0*cos(k*t)'\n[law.coordinates.y]\nacceleration = '0*t'\nexact = '0*t'";
    let law = body(text);
    let mut it = stepper(&law, Solver::Truth);
    it.input(0.0, Input::Kick(2.0));
    // Without further settings a kick acts on the first coordinate only.
    assert_eq!(it.v(), [3.0, 0.0]);
    let place = |key: &str| law.kind.parameter(key).unwrap().0;
    let mut a = [0.0; 2];
    for (key, acts) in [("k", true), ("x.start", false), ("y.start_velocity", false)] {
        assert_eq!(it.set_parameter(0.0, place(key), 3.0), acts, "{key}");
    }
    it.acceleration(0.0, &[1.0, 0.0], &[0.0; 2], &mut a);
    assert_eq!(a, [-9.0, 0.0]);
    assert!(it.set_parameter(0.0, place("x.kick"), -1.0));
    it.input(0.0, Input::Kick(1.0));
    assert_eq!(it.v(), [2.0, 0.0]);
    let whole = body(
        "[[law]]\n[law.coordinates.x]\nacceleration = '0*t'\n[law.coordinates.y]\nacceleration = '0*t'",
    );
    assert_eq!(whole.values, [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let defaults =
        ["x.kick", "y.kick", "y.start"].map(|key| whole.kind.parameter(key).unwrap().1.default);
    assert_eq!(defaults, [Some(1.0), Some(0.0), Some(0.0)]);
}
