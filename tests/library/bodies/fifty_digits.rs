//! Truths compared with `fifty_digits.txt`, a table of motions that another program computed to 50
//! digits or more: closed forms without their cancellations, and for bodies without a closed form
//! Taylor series of order 36 from corner to corner. The error that a truth reports must cover the
//! difference, and not by too much.
//!
//! Each line has the kind of body, the tick rate in Hz, the seconds, throttle, rudder and the
//! parameters of the kind, and after the bar the coordinates and velocities at the end.

use regatta::sim::bodies::{Input, Kind, Truth, kind};
use regatta::sim::integrators::StepFailure;
use regatta::sim::{Solver, Stepper};

/// The table, or another one from the environment.
fn table() -> String {
    match std::env::var("REGATTA_TABLE") {
        Ok(file) => std::fs::read_to_string(file).expect("a table"),
        Err(_) => include_str!("fifty_digits.txt").into(),
    }
}

struct Row {
    line: String,
    kind: &'static Kind,
    tick_hz: f64,
    seconds: f64,
    inputs: [Input; 2],
    values: Vec<f64>,
    /// Coordinates, then velocities.
    there: [Vec<f64>; 2],
}

fn rows() -> Vec<Row> {
    let numbers = |text: &str| -> Vec<f64> {
        text.split_whitespace().map(|number| number.parse().expect("a number")).collect()
    };
    let row = |line: &str| {
        let (given, there) = line.split_once('|').expect("a bar");
        let (id, given) = given.split_once(' ').expect("a kind");
        let [tick_hz, seconds, throttle, rudder, ref values @ ..] = numbers(given)[..] else {
            panic!("{line}")
        };
        let there = numbers(there);
        let (q, v) = there.split_at(there.len() / 2);
        Row {
            line: line.into(),
            kind: kind(id).expect("a kind"),
            tick_hz,
            seconds,
            inputs: [Input::Throttle(throttle), Input::Rudder(rudder)],
            values: values.to_vec(),
            there: [q.to_vec(), v.to_vec()],
        }
    };
    table().lines().map(row).collect()
}

impl Row {
    /// Runs the body to the end.
    fn run(&self) -> Result<Box<dyn Stepper>, StepFailure> {
        let mut body = (self.kind.build)(&self.values, Solver::Truth);
        for input in self.inputs {
            body.input(0.0, input);
        }
        if self.kind.truth == Truth::Exact {
            body.advance(0.0, self.seconds, 1)?;
            return Ok(body);
        }
        for tick in 0..(self.seconds * self.tick_hz).round() as u64 {
            body.advance(tick as f64 / self.tick_hz, 1.0 / self.tick_hz, 1)?;
        }
        Ok(body)
    }

    /// The largest error of a coordinate and of a velocity, the reported errors, and the magnitudes.
    fn errors(&self) -> [[f64; 2]; 3] {
        let body = self.run().unwrap_or_else(|failure| panic!("{failure}: {}", self.line));
        let off = |found: &[f64], there: &[f64]| {
            assert_eq!(found.len(), there.len(), "{}", self.line);
            // A NaN is no small error.
            let off = found.iter().zip(there).map(|(found, there)| (found - there).abs());
            off.map(|off| if off.is_nan() { f64::INFINITY } else { off }).fold(0.0, f64::max)
        };
        let size = |there: &[f64]| there.iter().fold(0.0, |most: f64, x| x.abs().max(most));
        let [q, v] = &self.there;
        [
            [off(body.q(), q), off(body.v(), v)],
            body.truth_error().expect("of a truth"),
            [size(q), size(v)],
        ]
    }
}

/// The reported errors of truths of this kind, divided by the true ones, in rising order. A true error
/// below the rounding of the result counts as that rounding.
fn ratios(id: &str) -> Vec<f64> {
    let mut ratios = Vec::new();
    for row in rows().iter().filter(|row| row.kind.id == id) {
        let [found, said, size] = row.errors();
        for i in 0..2 {
            // An error below the smallest number counts as that number.
            let least = (f64::EPSILON / 2.0 * size[i]).max(f64::MIN_POSITIVE);
            let ratio = (said[i] + f64::MIN_POSITIVE) / found[i].max(least);
            if !(1.0..1e4).contains(&ratio) {
                println!("{ratio:.1e}: {:.1e} of {:.1e}, {}", found[i], size[i], row.line);
            }
            ratios.push(ratio);
        }
    }
    ratios.sort_by(f64::total_cmp);
    let below = ratios.iter().filter(|&&ratio| ratio < 1.0).count();
    println!(
        "{id}: {below} of {} below 1, {:.1} {:.1} {:.1} {:.1}",
        ratios.len(),
        at(&ratios, 0.0),
        at(&ratios, 0.5),
        at(&ratios, 0.9),
        at(&ratios, 1.0)
    );
    ratios
}

/// The quantile of `ratios` at `part`.
fn at(ratios: &[f64], part: f64) -> f64 {
    ratios[((ratios.len() - 1) as f64 * part).round() as usize]
}

#[test]
fn the_error_bound_of_a_closed_form_holds_and_is_tight() {
    // Three times the measured median and ninth decile. The largest ratios are errors that happen to be
    // 0.
    for (id, median, most) in [
        ("ship", 12.0, 200.0),
        ("spring", 70.0, 600.0),
        ("chain", 90.0, 600.0),
        ("orbit", 12.0, 2e3),
    ] {
        let ratios = ratios(id);
        assert!(ratios.len() >= 20, "{id}");
        assert!(ratios[0] >= 1.0, "{id}: {}", ratios[0]);
        for (part, allowed) in [(0.5, median), (0.9, most)] {
            let found = at(&ratios, part);
            assert!(found < allowed, "{id}: {found} at {part}");
        }
    }
}

#[test]
fn a_reference_estimates_its_error_on_each_run() {
    for id in ["pendulum", "helm"] {
        let ratios = ratios(id);
        assert!(ratios.len() >= 90, "{id}");
        let hundredth = at(&ratios, 0.01);
        assert!(hundredth >= 1.0, "{id}: {hundredth}");
        // Three times the measured median, which includes the margin and common errors of the two
        // solutions.
        let median = at(&ratios, 0.5);
        assert!(median < 50.0, "{id}: {median}");
    }
}
