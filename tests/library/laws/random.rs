//! Random laws against an independent integrator, and random text against the parser.

use regatta::scene::SceneBody;
use regatta::sim::Solver;
use regatta::sim::law::{CoordinateText, Equations, LawText, Layout, Part};

use super::{body, stepper};
use crate::dice::Dice;

/// A random expression in x, v and t, smooth or with corners, of bounded size.
fn expression(dice: &mut Dice, depth: usize) -> String {
    let mut pick = |n: usize| dice.below(n);
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
fn the_reference_of_random_laws_agrees_with_an_independent_integrator() {
    let mut dice = Dice::new(1);
    let (mut tried, mut smooth) = (0, 0);
    while tried < 25 {
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
    assert!(smooth > 10, "{smooth} of 25 could be compared to 1e-10");
}

#[test]
fn a_hundred_thousand_mutated_expressions_are_read_or_refused_in_place() {
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
    for _ in 0..100_000 {
        let mut text: Vec<char> = SEEDS[dice.below(5)].chars().collect();
        for _ in 0..1 + dice.below(6) {
            let at = dice.below(text.len() + 1);
            match dice.below(3) {
                0 if at < text.len() => drop(text.remove(at)),
                1 if at < text.len() => {
                    let to = (at + dice.below(9)).min(text.len());
                    let copy: Vec<char> = text[at..to].to_vec();
                    text.splice(at..at, copy);
                }
                _ => {
                    let piece = PIECES[dice.below(40)];
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
            at: None,
        };
        let law = LawText {
            events: Vec::new(),
            constants: vec!["k".into()],
            coordinates: vec![coordinate],
            energy: None,
            plane: None,
            layout: Layout::Beads,
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
    assert!(good > 3_000 && bad > 30_000, "{good} read, {bad} refused");
}
