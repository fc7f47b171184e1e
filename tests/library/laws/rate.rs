//! A law of first order is refused with its second-order form.

use regatta::scene::Scene;
use regatta::sim::Solver;
use regatta::sim::integrators::method;

use super::{parse, stepper};

/// Names, starts and rates of a law of first order, with its constants `a = 0.3` and `u = 2`.
struct FirstOrder {
    coordinates: &'static [(&'static str, f64, &'static str)],
    rates: fn(t: f64, q: &[f64]) -> Vec<f64>,
}

const LAWS: [FirstOrder; 4] = [
    FirstOrder {
        coordinates: &[("q", 1.0, "p"), ("p", 0.0, "-40*q")],
        rates: |_, q| vec![q[1], -40.0 * q[0]],
    },
    FirstOrder {
        coordinates: &[("x", -1.0, "(u - x)/a"), ("y", 0.5, "(x - y)/0.5")],
        rates: |_, q| vec![(2.0 - q[0]) / 0.3, (q[0] - q[1]) / 0.5],
    },
    FirstOrder {
        coordinates: &[("x", 0.4, "-a*x^3 - -x*y"), ("y", 1.2, "sin(2*t)*x - exp(-y)/(x + u)")],
        rates: |t, q| {
            let [x, y] = [q[0], q[1]];
            vec![-0.3 * x * x * x + x * y, (2.0 * t).sin() * x - (-y).exp() / (x + 2.0)]
        },
    },
    FirstOrder {
        coordinates: &[("x", 1.5, "1"), ("y", 0.2, "cos(x*y)/(1 + y^2) - sqrt(x)*ln(x + u)")],
        rates: |_, q| {
            let [x, y] = [q[0], q[1]];
            vec![1.0, (x * y).cos() / (1.0 + y * y) - x.sqrt() * (x + 2.0).ln()]
        },
    },
];

/// The fault of a law, written with these lines for each coordinate.
fn text(law: &FirstOrder, line: impl Fn(usize) -> String) -> String {
    let head = "[[law]]\nconstants = { a = 0.3, u = 2.0 }\n".to_owned();
    let rows = law.coordinates.iter().enumerate();
    let rows = rows.map(|(i, (name, start, _))| {
        format!("[law.coordinates.{name}]\nstart = {start:?}\n{}\n", line(i))
    });
    rows.fold(head, |text, row| text + &row)
}

#[test]
fn the_offered_form_of_a_law_of_first_order_moves_as_the_law() {
    for law in &LAWS {
        let faults = parse(&text(law, |i| format!("rate = \"{}\"", law.coordinates[i].2)));
        let faults = faults.expect_err("refused");
        let forms: Vec<[&str; 2]> = faults
            .lines()
            .filter(|line| line.contains(" has a rate, and methods here step"))
            .map(|line| {
                let mut quoted = line.rsplit('`').skip(1).step_by(2);
                let [start, acceleration] = [quoted.next().unwrap(), quoted.next().unwrap()];
                [acceleration, start]
            })
            .collect();
        assert_eq!(forms.len(), law.coordinates.len(), "{faults}");
        let second = parse(&text(law, |i| forms[i].join("\n")));
        let scene: Scene = second.unwrap_or_else(|errors| panic!("{errors}\n{forms:?}"));
        let rk4 = Solver::Method(method("rk4").expect("a method"));
        let mut stepper = stepper(&scene.bodies[0], rk4);
        let steps = 4000;
        let h = 1.0 / f64::from(steps);
        for n in 0..steps {
            stepper.advance(f64::from(n) * h, h, 1).expect("a step");
        }
        let mut q: Vec<f64> = law.coordinates.iter().map(|(_, start, _)| *start).collect();
        for n in 0..steps {
            let t = f64::from(n) * h;
            let moved = |k: &[f64], by: f64| -> Vec<f64> {
                q.iter().zip(k).map(|(q, k)| q + by * k).collect()
            };
            let k1 = (law.rates)(t, &q);
            let k2 = (law.rates)(t + h / 2.0, &moved(&k1, h / 2.0));
            let k3 = (law.rates)(t + h / 2.0, &moved(&k2, h / 2.0));
            let k4 = (law.rates)(t + h, &moved(&k3, h));
            for i in 0..q.len() {
                q[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
            }
        }
        for (i, (name, ..)) in law.coordinates.iter().enumerate() {
            let x = stepper.q()[i];
            assert!((x - q[i]).abs() < 1e-9, "{name}: {x} and {} by {forms:?}", q[i]);
        }
    }
}

#[test]
fn a_rate_without_a_written_derivative_is_refused_in_words() {
    let nested = "((x^16)^16)^16 + ((x^16)^16)^16";
    for rate in ["max(x, 0)", "floor(x)", nested] {
        let law = format!("[[law]]\n[law.coordinates.x]\nstart = 0.5\nrate = \"{rate}\"\n");
        let fault = parse(&law).expect_err("refused");
        assert!(fault.contains("as `acceleration` the derivative of its rate by time"), "{fault}");
    }
    let both = "[[law]]\n[law.coordinates.x]\nrate = \"1\"\nacceleration = \"1\"\n";
    let fault = parse(both).expect_err("refused");
    assert!(fault.contains("unknown key `rate`"), "{fault}");
}
