//! Setting a parameter of a moving body: it continues from its state as if it had been built with the value.

use regatta::scene::Scene;
use regatta::sim::bodies::{BODIES, Input, Kind, MAX_VALUE, Range, TakesEffect, kind};
use regatta::sim::integrators::GENERAL_METHODS;
use regatta::sim::{BodyClass, Solver, Stepper};

const HZ: f64 = 60.0;

fn solvers() -> impl Iterator<Item = Solver> {
    GENERAL_METHODS.iter().map(Solver::Method).chain([Solver::Truth])
}

/// The parameter values of the first body of this kind in the scene of the kind's name.
fn values(kind: &Kind) -> Vec<f64> {
    if kind.class == BodyClass::Spin {
        // Those of the scenes are too light for another kick.
        return vec![2.5, 1.5, 3.0, 0.7, 1.3, -0.4, 0.5, 0.5, -0.5, 0.5, 2.0, 0.3, -0.2, 0.6];
    }
    let scene = Scene::built_in(kind.id).expect("a scene for each kind");
    let body = scene.bodies.into_iter().find(|body| body.kind.id == kind.id);
    body.expect("the scene shows the kind").values
}

/// A value that is set in none of the scenes, but fits the range.
fn another(value: f64) -> f64 {
    if value == 0.0 { 0.3 } else { 1.25 * value }
}

fn acting(kind: &Kind, acts: TakesEffect) -> impl Iterator<Item = usize> {
    (0..kind.parameters.len()).filter(move |&place| kind.parameters[place].acts == acts)
}

/// A body at its start, with every input that it takes other than at the start.
fn begun(kind: &Kind, values: &[f64], solver: Solver) -> Box<dyn Stepper> {
    let mut body = (kind.build)(values, solver);
    body.input(0.0, Input::Throttle(0.6));
    body.input(0.0, Input::Rudder(-0.4));
    body
}

/// Runs from one tick to another, with a kick on the way.
fn run(body: &mut dyn Stepper, from: u32, to: u32) {
    for tick in from..to {
        let t = f64::from(tick) / HZ;
        if tick == (from + to) / 2 {
            body.input(t, Input::Kick(0.5));
        }
        body.advance(t, 1.0 / HZ, 2).expect("a scene's body does not fail");
    }
}

fn bits(body: &dyn Stepper) -> Vec<u64> {
    body.q().iter().chain(body.v()).map(|value| value.to_bits()).collect()
}

#[test]
fn an_edited_body_continues_as_if_built_with_the_value() {
    for kind in BODIES.iter() {
        let values = values(kind);
        for place in acting(kind, TakesEffect::AtOnce) {
            let mut edited = values.clone();
            edited[place] = another(values[place]);
            for solver in solvers() {
                let shown = format!("{} {}, {solver:?}", kind.id, kind.parameters[place].key);
                let t = 40.0 / HZ;
                let mut body = begun(kind, &values, solver);
                run(&mut *body, 0, 40);
                if kind.class == BodyClass::Spin {
                    // A placement makes the attitude agree with its rate.
                    let (q, v) = (body.q().to_vec(), body.v().to_vec());
                    body.set(t, &q, &v);
                }
                let before = bits(&*body);
                let mut unedited = begun(kind, &values, solver);
                unedited.set(t, body.q(), body.v());
                let mut built = begun(kind, &edited, solver);
                built.set(t, body.q(), body.v());

                assert!(body.set_parameter(t, place, edited[place]), "{shown}");
                assert_eq!(bits(&*body), before, "{shown}");
                // A ball shows its restitution after its next impact.
                let end = if kind.has_walls { 110 } else { 70 };
                for body in [&mut body, &mut built, &mut unedited] {
                    run(&mut **body, 40, end);
                }
                assert_eq!(bits(&*body), bits(&*built), "{shown}");
                // Walls are springs under the rule `penalty` only.
                if kind.parameters[place].key != "penalty_hz" {
                    assert_ne!(bits(&*body), bits(&*unedited), "{shown}");
                }
                assert_eq!(body.energy(), built.energy(), "{shown}");
            }
        }
    }
}

#[test]
fn a_refused_edit_changes_no_bit_and_no_memory() {
    for kind in BODIES.iter() {
        let values = values(kind);
        for solver in solvers() {
            let ended = |set: &dyn Fn(&mut dyn Stepper)| {
                let mut body = begun(kind, &values, solver);
                run(&mut *body, 0, 40);
                set(&mut *body);
                run(&mut *body, 40, 60);
                (bits(&*body), body.evaluations(), body.truth_error())
            };
            let untouched = ended(&|_| ());
            let refused = ended(&|body| {
                for place in acting(kind, TakesEffect::AtOnce) {
                    assert!(!body.set_parameter(40.0 / HZ, place, values[place]));
                }
                for place in acting(kind, TakesEffect::AtStart) {
                    assert!(!body.set_parameter(40.0 / HZ, place, another(values[place])));
                }
                assert!(!body.set_parameter(40.0 / HZ, kind.parameters.len(), 1.0));
            });
            assert_eq!(refused, untouched, "{}, {solver:?}", kind.id);
        }
    }
}

#[test]
fn values_at_the_ends_of_their_ranges_never_panic() {
    for kind in BODIES.iter() {
        let values = values(kind);
        for place in acting(kind, TakesEffect::AtOnce) {
            let range = kind.parameters[place].range;
            for value in [-MAX_VALUE, 0.0, f64::MIN_POSITIVE, MAX_VALUE] {
                if !range.contains(value) {
                    continue;
                }
                for solver in solvers() {
                    let mut body = begun(kind, &values, solver);
                    run(&mut *body, 0, 4);
                    body.set_parameter(4.0 / HZ, place, value);
                    body.input(4.0 / HZ, Input::Kick(1.0));
                    // The lane judges the outcome.
                    let _ =
                        (4..8).try_for_each(|tick| body.advance(f64::from(tick) / HZ, 1.0 / HZ, 1));
                }
            }
        }
    }
}

#[test]
fn the_errors_of_the_truth_outlast_an_edit() {
    for id in ["spring", "pendulum"] {
        let kind = kind(id).unwrap();
        let mut truth = begun(kind, &values(kind), Solver::Truth);
        run(&mut *truth, 0, 600);
        let before = truth.truth_error().unwrap();
        assert!(truth.set_parameter(10.0, 0, another(values(kind)[0])));
        let after = truth.truth_error().unwrap();
        assert!(before[0] > 0.0 && after[0] >= before[0] / 2.0, "{id}: {before:?} to {after:?}");
    }
}

#[test]
fn counts_curves_and_start_values_act_only_at_the_start() {
    let at_start = |id: &str| {
        let kind = kind(id).unwrap();
        acting(kind, TakesEffect::AtStart)
            .map(|place| &kind.parameters[place].key)
            .collect::<Vec<_>>()
    };
    assert_eq!(at_start("ship"), ["s0_m", "v0_m_per_s"]);
    assert_eq!(at_start("chain"), ["masses", "plucked_mass", "x0_m"]);
    assert_eq!(at_start("orbit"), ["x0_m", "y0_m", "vx0_m_per_s", "vy0_m_per_s"]);
    assert_eq!(at_start("helm"), ["x0_m", "y0_m", "psi0_rad", "u0_m_per_s", "thrust_curve"]);
}

/// The symbol of the unit that ends a key: `per` divides, a figure is a power, and a letter after the first
/// underscore is a unit.
fn unit_of_key(key: &str) -> String {
    let units = ["n", "m", "s", "kg", "rad", "hz", "m2", "m3", "s2"];
    let words: Vec<&str> = key.split('_').collect();
    let is_unit = |word: &&&str| units.contains(*word) || **word == "per";
    let count = words[1..].iter().rev().take_while(is_unit).count();
    let symbol = |word: &str| match word {
        "n" => "N".to_owned(),
        "hz" => "Hz".to_owned(),
        word => word.replace('2', "²").replace('3', "³"),
    };
    let mut written = String::new();
    for word in &words[words.len() - count..] {
        match *word {
            "per" if written.is_empty() => written += "1/",
            "per" => written += "/",
            word => {
                let is_first = written.is_empty() || written.ends_with('/');
                written += if is_first { "" } else { "·" };
                written += &symbol(word);
            }
        }
    }
    written
}

#[test]
fn every_parameter_is_described_and_has_the_unit_of_its_key() {
    assert_eq!(unit_of_key("damping_n_s_per_m"), "N·s/m");
    assert_eq!(unit_of_key("mu_m3_per_s2"), "m³/s²");
    assert_eq!(unit_of_key("plucked_mass"), "");
    assert_eq!(unit_of_key("rate_per_s"), "1/s");
    for kind in BODIES.iter() {
        for parameter in &kind.parameters {
            assert_eq!(parameter.unit, unit_of_key(&parameter.key), "{}", parameter.key);
            let is_number = !matches!(parameter.range, Range::Count(_) | Range::Curve { .. });
            // The restitution is a ratio, and an attitude has length 1.
            let is_ratio = parameter.key == "restitution" || parameter.list == Some("attitude");
            let is_number = is_number && !is_ratio;
            assert_eq!(parameter.unit.is_empty(), !is_number, "{}", parameter.key);
            assert!(!parameter.about.is_empty(), "{} {}", kind.id, parameter.key);
        }
    }
}

#[test]
fn a_parameter_is_named_by_its_key_or_its_start_quantity() {
    let called = |id: &str| {
        let parameters = kind(id).unwrap().parameters.iter();
        parameters.map(|parameter| parameter.quantity()).collect::<Vec<_>>()
    };
    let names = ["length", "mass", "gravity", "damping", "angle at start", "spin at start", "kick"];
    assert_eq!(called("pendulum"), names);
    assert_eq!(called("chain")[4], "plucked mass");
    assert_eq!(called("helm")[3], "side drag");
    for kind in BODIES.iter() {
        for parameter in kind.parameters.iter().filter(|it| it.acts == TakesEffect::AtStart) {
            let quantity = parameter.quantity();
            assert!(!quantity.contains('0'), "{} of {}", quantity, kind.id);
        }
        // A free body is made faster by its start alone.
        let acts = kind.parameter(&kind.leading).map(|(_, leading)| leading.acts);
        let is_free = kind.class == BodyClass::Spin;
        assert_eq!(acts == Some(TakesEffect::AtOnce), !is_free, "{}", kind.id);
    }
}
