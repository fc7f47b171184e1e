//! A stepper's other answers about its body: energies, inputs taken and refused, errors, lost time.

use regatta::sim::bodies::{BODIES, ClaimHorizon, Extras, Input, Ship, Spring, custom_kind, kind};
use regatta::sim::integrators::{GENERAL_METHODS, Override, method};
use regatta::sim::{Coupling, Solver, State, Stepper, System, stepper};

fn by(id: &str) -> Solver {
    Solver::Method(method(id).expect("a method"))
}

/// A body of each kind, none of whose parameters is 0 or 1 but its damping, which is `damping`.
fn bodies(solver: Solver, damping: f64) -> impl Iterator<Item = (&'static str, Box<dyn Stepper>)> {
    let values = move |id: &str| match id {
        "ship" => vec![1500.0, damping, 700.0, 3.0, 2.0, 500.0],
        "spring" => vec![2.5, 180.0, damping, 0.7, 1.5, 3.0],
        "chain" => vec![4.0, 0.5, 200.0, damping, 2.0, 0.7, 2.0],
        "pendulum" => vec![1.7, 0.4, 9.81, damping, 0.6, 0.3, 2.0],
        "orbit" => vec![1000.0, 9.0, 2.0, 1.5, 10.0, 0.3],
        "helm" => {
            let card = &kind("helm").unwrap().parameters;
            let plain = card[..card.len() - 1].iter().map(|p| p.default.unwrap_or(1.5));
            plain.chain([0.0, 2.0, 10.0, 1.0]).collect()
        }
        "tumble" => {
            let attitude = [0.5, 0.5, -0.5, 0.5];
            let start = [2.5, 1.5, 3.0, 0.7, 1.3, -0.4];
            start.into_iter().chain(attitude).chain([2.0, 0.3, -0.2, 0.6]).collect()
        }
        "ball" => vec![2.5, 1.5, 0.8, 9.81, damping, 0.0, 9.5, 0.0, 3.0, 4.77],
        "follow" => vec![2.0, 3.0, 1.2, 0.3, 0.4, 0.6, -0.5, 0.8, 0.3],
        id => panic!("{id} has no values here"),
    };
    BODIES.iter().map(move |kind| (kind.id, (kind.build)(&values(kind.id), solver)))
}

fn state(body: &dyn Stepper) -> [Vec<f64>; 2] {
    [body.q().to_vec(), body.v().to_vec()]
}

fn acceleration(body: &dyn Stepper, [q, v]: &[Vec<f64>; 2]) -> Vec<f64> {
    let mut a = vec![0.0; q.len()];
    body.acceleration(0.0, q, v, &mut a);
    a
}

fn near(found: f64, wanted: f64) -> bool {
    (found - wanted).abs() <= 1e-12 * wanted.abs()
}

#[test]
fn a_body_is_declared_linear_exactly_if_its_forces_add_up() {
    let mut linear = Vec::new();
    for (id, body) in bodies(Solver::Truth, 0.9) {
        let some = |from: f64, by: f64| (0..body.q().len()).map(|i| from + by * i as f64).collect();
        let here: [Vec<f64>; 2] = [some(0.3, 0.4), some(1.1, -0.7)];
        let [rest, doubled] = [0.0, 2.0]
            .map(|by: f64| here.clone().map(|half| half.iter().map(|x| by * x).collect()));
        let [still, once, twice] = [&rest, &here, &doubled].map(|at| acceleration(&*body, at));
        let adds_up =
            (0..still.len()).all(|i| near(twice[i] - still[i], 2.0 * (once[i] - still[i])));
        // The impacts of a ball do not.
        let adds_up = adds_up && id != "ball";
        assert_eq!(body.is_linear(), adds_up, "{id}");
        linear.extend(adds_up.then_some(id));
    }
    assert_eq!(linear, ["ship", "spring", "chain", "follow"]);
}

#[test]
fn only_conservative_bodies_have_an_energy() {
    for (damping, conserving) in [
        (0.0, &["ship", "spring", "chain", "pendulum", "orbit", "tumble"][..]),
        (1e-6, &["orbit", "tumble"]),
    ] {
        for (id, body) in bodies(Solver::Truth, damping) {
            assert_eq!(body.energy().is_some(), conserving.contains(&id), "{id}, {damping}");
            assert_eq!(body.kinetic_energy().is_some(), body.energy().is_some(), "{id}");
        }
    }
}

#[test]
fn energy_is_constant_along_the_truth_and_splits_off_kinetic_energy() {
    for (id, mut body) in
        bodies(Solver::Truth, 0.0).filter(|(id, _)| !matches!(*id, "helm" | "follow" | "ball"))
    {
        body.input(0.0, Input::Throttle(0.4));
        let start = body.energy().unwrap();
        for tick in 0..30 {
            body.advance(f64::from(tick) / 20.0, 1.0 / 20.0, 1).unwrap();
            let scale = start.abs() + body.kinetic_energy().unwrap();
            let drift = body.energy().unwrap() - start;
            assert!(drift.abs() < 1e-9 * scale, "{id}: {drift} J of {scale}");
        }
        let (energy, moving) = (body.energy().unwrap(), body.kinetic_energy().unwrap());
        let [q, v] = state(&*body);
        body.set(1.5, &q, &vec![0.0; v.len()]);
        assert!((energy - body.energy().unwrap() - moving).abs() < 1e-9 * energy.abs(), "{id}");
        assert!(moving > 0.0, "{id}");
    }
}

#[test]
fn energies_match_the_textbook_formulas() {
    let ship =
        Ship { thrust: 30.0, throttle: 0.5, drag: 0.0, mass: 4.0, s0: 7.0, v0: 3.0, kick: 1.0 };
    let ship = stepper(ship, Solver::Truth);
    assert_eq!((ship.energy(), ship.kinetic_energy()), (Some(18.0 - 105.0), Some(18.0)));
    let spring = |damping| {
        let body = Spring { mass: 4.0, stiffness: 50.0, damping, x0: 0.2, v0: 3.0, kick: 1.0 };
        stepper(body, Solver::Truth)
    };
    assert_eq!(spring(0.0).energy(), Some(19.0));
    assert_eq!(spring(0.0).kinetic_energy(), Some(18.0));
    assert_eq!(spring(0.1).energy(), None);
}

#[test]
fn a_kick_is_an_impulse_for_every_body() {
    // Speed gained by 1.5 kicks: of 500 N s on 700 kg, of 3 N s on 2.5 kg.
    for (id, gained) in [("ship", 750.0 / 700.0), ("spring", 4.5 / 2.5)] {
        let (_, mut body) = bodies(by("rk4"), 0.9).find(|(found, _)| *found == id).unwrap();
        let before = state(&*body);
        assert!(body.input(0.0, Input::Kick(1.5)));
        assert!(near(body.v()[0], before[1][0] + gained), "{id}: {}", body.v()[0]);
        assert_eq!(body.q(), before[0], "{id}");
    }
}

#[test]
fn a_body_takes_the_inputs_on_its_card_and_ignores_others_to_the_bit() {
    let inputs = [
        ("throttle", Input::Throttle(0.3)),
        ("rudder", Input::Rudder(0.3)),
        ("kick", Input::Kick(1.0)),
    ];
    // With a memory, that would be lost.
    for solver in [by("adams-bashforth-2"), by("bdf2"), by("dormand-prince-54"), Solver::Truth] {
        for (name, input) in inputs {
            let both = bodies(solver, 0.9).zip(bodies(solver, 0.9));
            for ((id, mut body), (_, mut untouched)) in both {
                for tick in 0..6 {
                    let t = f64::from(tick) / 60.0;
                    let is_taken = tick == 3 && body.input(t, input);
                    let is_on_card = kind(id).unwrap().inputs.contains(&name);
                    assert!(tick != 3 || is_taken == is_on_card, "{id}: {name}");
                    body.advance(t, 1.0 / 60.0, 1).unwrap();
                    untouched.advance(t, 1.0 / 60.0, 1).unwrap();
                }
                let stayed = state(&*body) == state(&*untouched)
                    && body.evaluations() == untouched.evaluations()
                    && body.truth_error() == untouched.truth_error();
                assert_eq!(stayed, !kind(id).unwrap().inputs.contains(&name), "{id}: {name}");
            }
        }
    }
}

#[test]
fn lost_time_stays_lost_under_the_next_method() {
    let printed = GENERAL_METHODS.iter().find(|m| m.tolerance.is_some() && !m.keeps_time).unwrap();
    let (_, mut body) = bodies(Solver::Method(printed), 0.9).nth(1).unwrap();
    assert_eq!(body.lost_time(), 0.0);
    let run = |body: &mut dyn Stepper, from: u32| {
        for tick in from..from + 4 {
            body.advance(0.5 * f64::from(tick), 0.5, 1).unwrap();
        }
        body.lost_time()
    };
    let lost = run(&mut *body, 0);
    assert!(lost > 0.0 && lost < 2.0, "{lost} s of 2");
    for solver in [by("rk4"), Solver::Truth] {
        let mut next = body.with_solver(solver, 2.0);
        assert_eq!(run(&mut *next, 4), lost, "{solver:?}");
        let mut again = next.with_solver(Solver::Method(printed), 4.0);
        assert!(run(&mut *again, 8) > lost, "{solver:?}");
    }
}

/// A ship and a spring at a time, in units that are smaller by these factors of length, time and mass.
fn in_units(length: f64, time: f64, mass: f64, drag: f64, t: f64) -> [Box<dyn Stepper>; 2] {
    let (speed, force) = (length / time, mass * length / time / time);
    let ship = Ship {
        thrust: 3.0 * force,
        throttle: 0.75,
        drag: drag * mass / time,
        mass: 2.5 * mass,
        s0: 1.5 * length,
        v0: -0.7 * speed,
        kick: force * time,
    };
    let spring = Spring {
        mass: 2.5 * mass,
        stiffness: 30.0 * force / length,
        damping: drag * mass / time,
        x0: 0.3 * length,
        v0: 2.0 * speed,
        kick: force * time,
    };
    [stepper(ship, Solver::Truth), stepper(spring, Solver::Truth)].map(|mut body| {
        body.advance(0.0, t * time, 1).expect("a closed form does not fail");
        body
    })
}

#[test]
fn a_change_of_units_only_scales_the_numbers() {
    // The spring swings, nearly creeps, and creeps.
    for (drag, t) in [(0.0, 1.7), (1.0, 1.7), (20.0, 0.1), (20.0, 3.0), (60.0, 3.0)] {
        let plain = in_units(1.0, 1.0, 1.0, drag, t);
        for [length, time, mass] in [[8.0, 1.0, 1.0], [1.0, 8.0, 1.0], [1.0, 1.0, 8.0]] {
            for (body, plain) in in_units(length, time, mass, drag, t).iter().zip(&plain) {
                let shown = format!("{drag}, {t} s; {length} {time} {mass}");
                let (speed, unit) = (length / time, mass * length * length / time / time);
                assert_eq!(body.q()[0], length * plain.q()[0], "{shown}");
                assert_eq!(body.v()[0], speed * plain.v()[0], "{shown}");
                assert_eq!(body.energy(), plain.energy().map(|energy| unit * energy), "{shown}");
                let [q, v] = plain.truth_error().unwrap();
                assert_eq!(body.truth_error(), Some([length * q, speed * v]), "{shown}");
            }
        }
    }
}

#[test]
fn the_error_of_a_motion_at_rest_stops_growing() {
    // After a million time constants, a metre from the start.
    let ship =
        Ship { thrust: 0.0, throttle: 1.0, drag: 2.0, mass: 2.0, s0: 0.0, v0: 1.0, kick: 1.0 };
    let mut ship = stepper(ship, Solver::Truth);
    ship.advance(0.0, 1e6, 1).unwrap();
    let [q, v] = ship.truth_error().unwrap();
    assert_eq!(ship.q(), [1.0]);
    assert!(q < 1e-13 && v < 1e-14, "{q:e} m, {v:e} m/s");
    // At its final speed of a thousandth of the full one it has run a kilometre.
    let ship =
        Ship { thrust: 2.0, throttle: 1e-3, drag: 2.0, mass: 2.0, s0: 0.0, v0: 0.0, kick: 1.0 };
    let mut ship = stepper(ship, Solver::Truth);
    ship.advance(0.0, 1e6, 1).unwrap();
    let [q, v] = ship.truth_error().unwrap();
    assert!(q < 100.0 * f64::EPSILON * 1e3, "{q:e} m");
    assert!(v < 100.0 * f64::EPSILON * 1e-3, "{v:e} m/s");
}

/// Everything that a stepper says of itself that a step may change, to the bit.
fn account(body: &dyn Stepper) -> Vec<u64> {
    let state = body.q().iter().chain(body.v()).copied();
    let error = body.truth_error().into_iter().flatten();
    let numbers = state.chain(error).chain([body.lost_time()]);
    numbers.map(f64::to_bits).chain([body.evaluations()]).collect()
}

#[test]
fn a_copied_stepper_continues_to_the_bit() {
    const H: f64 = 1.0 / 60.0;
    let fly = |body: &mut dyn Stepper, ticks: std::ops::Range<u32>| {
        for tick in ticks {
            let t = f64::from(tick) * H;
            if tick % 16 == 7 {
                body.input(t, Input::Kick(0.5));
            }
            body.advance(t, H, 2).expect("soft bodies at a fine tick");
        }
    };
    let methods = GENERAL_METHODS.iter().map(Solver::Method);
    let adaptive = GENERAL_METHODS.iter().filter(|method| method.tolerance.is_some());
    let tolerant = adaptive.map(|method| Solver::With(method, Override::tolerance(1e-7)));
    for solver in methods.chain(tolerant).chain([Solver::Truth]) {
        for (id, mut body) in bodies(solver, 0.4) {
            // Not at a kick, so that methods with a memory have one.
            fly(&mut *body, 0..20);
            let mut copy = body.clone();
            assert_eq!(account(&*copy), account(&*body), "{id}, {solver:?}");
            fly(&mut *body, 20..45);
            let mut again = copy.clone();
            fly(&mut *copy, 20..45);
            assert_eq!(account(&*copy), account(&*body), "{id}, {solver:?}");
            fly(&mut *again, 20..45);
            assert_eq!(account(&*again), account(&*body), "{id}, {solver:?}");
        }
    }
}

/// Masses of 1 kg in a row, between walls, joined by springs of 900 N/m.
#[derive(Clone)]
struct Row(Coupling);

impl System for Row {
    type Vector = Vec<f64>;
    fn acceleration(&self, _t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        for i in 0..q.len() {
            let left = i.checked_sub(1).map_or(0.0, |left| q[left]);
            let right = q.get(i + 1).unwrap_or(&0.0);
            a[i] = 900.0 * (left - 2.0 * q[i] + right) - 0.3 * v[i];
        }
    }
    fn coupling(&self) -> Coupling {
        self.0
    }
}

#[test]
fn a_custom_chain_of_256_masses_needs_only_its_declared_jacobian_band() {
    let start = State { q: (0..256).map(|i| f64::from(i % 7)).collect(), v: vec![0.0; 256] };
    let horizon = ClaimHorizon { tick_hz: 60.into(), ticks: 1 };
    let of = |coupling| {
        let kind =
            custom_kind(&Row(coupling), &start, &Extras::default(), horizon).expect("a body");
        let mut body = (kind.build)(&[1.0], by("implicit-midpoint"));
        body.advance(0.0, 1.0 / 60.0, 1).expect("a step");
        let landing = state(&*body);
        assert!(landing.iter().flatten().all(|number| number.is_finite()));
        (body.evaluations(), landing)
    };
    let [(band, [near, _]), (whole, [far, _])] = [Coupling::Band(1), Coupling::All].map(of);
    assert!((3..20).contains(&band), "{band}");
    assert!((256..300).contains(&whole), "{whole}");
    let apart = near.iter().zip(&far).map(|(near, far)| (near - far).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-9, "{apart}");
}

#[test]
fn a_recorded_tick_has_the_landing_and_evaluations_of_the_body() {
    for method in GENERAL_METHODS {
        for (id, mut body) in bodies(Solver::Method(method), 0.9) {
            let context = format!("{} of the {id}", method.id);
            for tick in 0..3 {
                let (t, h) = (f64::from(tick) / 30.0, 1.0 / 30.0);
                let recorded = body.recorded(method, t, h, 2).expect(&context);
                let before = body.evaluations();
                body.advance(t, h, 2).expect(&context);
                assert_eq!(recorded.landing.expect(&context), state(&*body), "{context}");
                let evaluated = body.evaluations() - before;
                assert_eq!(recorded.evaluations.len() as u64, evaluated, "{context}");
            }
            let other = GENERAL_METHODS.iter().find(|other| other.id != method.id).unwrap();
            assert_eq!(body.recorded(other, 0.0, 0.1, 1), None, "{context}");
        }
    }
}
