//! Implicit methods: their conserved quantities, the cost of a step, and equations without a solution.

use glam::DVec2;
use regatta::sim::bodies::{Body, Pendulum};
use regatta::sim::integrators::{Family, GENERAL_METHODS, Method, StepFailure, integrator, method};
use regatta::sim::{State, System};

use super::systems::{Kepler, Timetable, fresh, kepler_orbit, problem, spring};

fn implicit() -> impl Iterator<Item = &'static Method> {
    GENERAL_METHODS.iter().filter(|method| method.family == Family::Implicit)
}

/// Masses of 1 kg in a row, joined to each other and to a wall at each end by springs of increasing
/// stiffness.
struct Row;

impl Row {
    fn stiffness(link: usize) -> f64 {
        1.0 + link as f64
    }

    fn energy(State { q, v }: &State<Vec<f64>>) -> f64 {
        let kinetic: f64 = v.iter().map(|v| v * v / 2.0).sum();
        let ends = |link: usize| (link.checked_sub(1).map_or(0.0, |i| q[i]), q.get(link));
        let stretch = |link| ends(link).1.unwrap_or(&0.0) - ends(link).0;
        let potential = |link| Self::stiffness(link) * stretch(link) * stretch(link) / 2.0;
        kinetic + (0..=q.len()).map(potential).sum::<f64>()
    }
}

impl System for Row {
    type Vector = Vec<f64>;
    fn acceleration(&self, _t: f64, q: &Vec<f64>, _v: &Vec<f64>, a: &mut Vec<f64>) {
        for i in 0..q.len() {
            let left = i.checked_sub(1).map_or(0.0, |left| q[left]);
            let right = q.get(i + 1).unwrap_or(&0.0);
            a[i] = Self::stiffness(i) * (left - q[i]) + Self::stiffness(i + 1) * (right - q[i]);
        }
    }
}

/// The largest error of the energy of a row of `n` masses, relative to the energy.
fn energy_error(method: &Method, n: usize, h: f64, steps: u32) -> f64 {
    let displaced = |i: usize| if i == 0 { 1.0 } else { 0.0 };
    let mut state = State { q: (0..n).map(displaced).collect(), v: vec![0.0; n] };
    let (row, mut integrator) = (problem(Row), integrator(method, &state.q));
    let first = Row::energy(&state);
    let mut most: f64 = 0.0;
    for step in 0..steps {
        integrator.step(&row, h * f64::from(step), h, &mut state).unwrap();
        let error = (Row::energy(&state) / first - 1.0).abs();
        assert!(error.is_finite(), "{}", method.id);
        most = most.max(error);
    }
    most
}

#[test]
fn only_reversible_methods_conserve_quadratic_energy() {
    for method in implicit() {
        let keeps = method.reversible;
        // Slow and stiff: h ω is 0.4, and about 6 for the fastest mode of the row.
        for (n, h, steps) in [(1, 0.3, 100_000), (8, 1.0, 5_000)] {
            let error = energy_error(method, n, h, steps);
            println!("{:22} {n}: {error:.1e}", method.id);
            if keeps {
                // Rounding alone, which grows to 7e-13 over 100 000 steps.
                assert!(error < 3e-12, "{} of {n}: {error:e}", method.id);
            } else {
                assert!(error > 0.5, "{} of {n}: {error:e}", method.id);
            }
        }
    }
}

#[test]
fn a_row_of_64_masses_agrees_with_runge_kutta_at_a_fine_step() {
    let run = |id: &str, steps: u32| {
        let bump = |i: usize| 1.0 / (1.0 + (i as f64 - 20.0) * (i as f64 - 20.0) / 25.0);
        let mut state = State { q: (0..64).map(bump).collect::<Vec<f64>>(), v: vec![0.0; 64] };
        let mut integrator = integrator(method(id).expect("a method"), &state.q);
        integrator.steps(&problem(Row), 0.0, 0.5, steps, &mut state).unwrap();
        state
    };
    let truth = run("rk4", 1_000);
    for method in implicit() {
        let error = |steps| {
            let found = run(method.id, steps);
            let pairs = found.q.iter().zip(&truth.q);
            pairs.map(|(found, truth)| (found - truth).abs()).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(20), error(40));
        let order = (coarse / fine).log2();
        println!("{:22} {fine:.1e}, order {order:.2}", method.id);
        assert!(fine < 0.1, "{}: {fine}", method.id);
        assert!((order - f64::from(method.order)).abs() < 0.35, "{}: {order}", method.id);
    }
}

/// The factor of the squared amplitude of an undamped oscillator in one step, from a phase.
fn growth(id: &str, z: f64, phase: f64) -> f64 {
    let mut state = State { q: libm::cos(phase), v: libm::sin(phase) };
    let method = method(id).expect("a method");
    fresh(method).step(&problem(spring(1.0, 0.0)), 0.0, z, &mut state).unwrap();
    state.q * state.q + state.v * state.v
}

#[test]
fn one_step_multiplies_the_amplitude_by_its_formula() {
    type Square = fn(f64) -> f64;
    let formulas: [(&str, Square); 4] = [
        ("implicit-euler", |z| 1.0 / (1.0 + z * z)),
        ("implicit-midpoint", |_| 1.0),
        ("newmark", |_| 1.0),
        ("gauss-legendre-4", |_| 1.0),
    ];
    for (id, square) in formulas {
        for z in [1e-3, 0.1, 0.5, 1.0, 1.7, 2.5, 4.0, 50.0] {
            for phase in [0.0, 0.4, 1.6, 3.0, 5.5] {
                let error = (growth(id, z, phase) / square(z) - 1.0).abs();
                assert!(error < 1e-12, "{id} at h ω = {z}: off by {error:e}");
            }
        }
    }
}

#[test]
fn bdf2_loses_less_energy_than_implicit_euler_for_the_same_work() {
    let left = |id| {
        let system = problem(spring(1.0, 0.0));
        let mut state = State { q: 1.0, v: 0.7 };
        let mut integrator = fresh(method(id).expect("a method"));
        integrator.steps(&system, 0.0, 100.0, 1000, &mut state).unwrap();
        (state.q * state.q + state.v * state.v, system.evaluations())
    };
    let (bdf2, euler) = (left("bdf2"), left("implicit-euler"));
    assert!(bdf2.0 > 0.5 && euler.0 < 1e-3 && euler.0 > 0.0, "{bdf2:?}, {euler:?}");
    // Its first step solves two equations.
    let solution = u64::from(cost(method("bdf2").unwrap(), 1));
    assert!(bdf2.1 <= euler.1 + solution, "{bdf2:?}, {euler:?}");
}

/// Evaluations of a step with two iterations on a system of `components` coordinates. Each iteration evaluates every
/// stage, and so does each column of the Jacobian; there is one column per stage and component. The order determines
/// the number of stages of Gauss's collocation. A formula may also contain the force at the start of the step, where
/// there is no stage.
fn cost(method: &Method, components: u32) -> u32 {
    let stages = method.order.div_ceil(2);
    let (system, timetable) = Timetable::new(0);
    let mut state = State { q: DVec2::ONE, v: DVec2::ZERO };
    integrator(method, &state.q).step(&system, 5.0, 0.1, &mut state).unwrap();
    let at_start = timetable.asked.borrow().iter().filter(|&&t| t == 5.0).count() as u32;
    // TR-BDF2 solves for its two stages one after the other.
    let solutions = if method.id == "tr-bdf2" { 2 } else { 1 };
    at_start + solutions * (2 * stages + stages * stages * components)
}

#[test]
fn a_linear_force_takes_two_iterations_at_any_scale() {
    for method in implicit() {
        let (id, cost) = (method.id, cost(method, 1));
        // A restart may solve two equations.
        let evaluations = 100 * cost..=(100 + u32::from(method.restart.is_some())) * cost;
        for (omega, h) in [(1.0, 0.1), (100.0, 0.1), (0.01, 0.1)] {
            let run = |scale: f64| {
                let system = problem(spring(omega, 0.1));
                let mut state = State { q: scale, v: -0.3 * scale };
                let mut integrator = fresh(method);
                for step in 0..100 {
                    integrator.step(&system, h * f64::from(step), h, &mut state).unwrap();
                }
                let found = system.evaluations() as u32;
                assert!(evaluations.contains(&found), "{id} {omega} {scale:e}: {found}");
                [state.q / scale, state.v / scale].map(f64::to_bits)
            };
            // Powers of two are exact.
            let plain = run(1.0);
            assert_eq!(run(2.0_f64.powi(100)), plain, "{id} at ω = {omega}");
            assert_eq!(run(2.0_f64.powi(-100)), plain, "{id} at ω = {omega}");
        }
    }
}

#[test]
fn a_weakly_nonlinear_force_takes_hardly_more() {
    for method in implicit() {
        let orbit = problem(Kepler);
        let mut state = kepler_orbit(0.3, 0.0);
        let mut integrator = integrator(method, &state.q);
        let h = std::f64::consts::TAU / 1000.0;
        for step in 0..1000 {
            integrator.step(&orbit, h * f64::from(step), h, &mut state).unwrap();
        }
        let found = orbit.evaluations() as f64 / 1000.0;
        println!("{:22} {found}", method.id);
        let least = f64::from(cost(method, 2));
        assert!(found >= least && found < least + 0.5, "{}: {found} per step", method.id);
    }
}

#[test]
fn a_motion_that_decays_to_zero_does_not_fail() {
    for method in implicit() {
        let mut state = State { q: 1.0, v: 0.0 };
        let (spring, mut integrator) = (problem(spring(1.0, 0.5)), fresh(method));
        for step in 0..20_000 {
            let t = 0.3 * f64::from(step);
            integrator.step(&spring, t, 0.3, &mut state).unwrap();
        }
        assert!(state.q.abs() < 1e-300, "{}: {:e}", method.id, state.q);
    }
}

/// Dry friction: the force is discontinuous where the velocity changes sign.
struct DryFriction;

impl System for DryFriction {
    type Vector = f64;
    fn acceleration(&self, _t: f64, _q: &f64, v: &f64, a: &mut f64) {
        *a = if *v > 0.0 { -1.0 } else { 1.0 };
    }
}

#[test]
fn a_bounded_force_is_solved_at_any_step() {
    // A bounded force always has a solution.
    let mut random = 0x2545_f491_4f6c_dd1d_u64;
    let mut between = |low: f64, high: f64| {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        low + (high - low) * (random >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut given_up = Vec::new();
    for method in implicit() {
        for round in 0..400 {
            let (length, theta0, omega0, hz) = if round < 3 {
                (0.5, 2.5, 0.0, f64::from(round + 1))
            } else {
                (between(0.05, 2.0), between(-3.1, 3.1), between(-9.0, 9.0), between(0.3, 6.0))
            };
            let (mass, gravity, kick) = (1.0, 9.81, 1.0);
            let damping = if round % 3 == 1 { between(0.0, 2.0) * length * length } else { 0.0 };
            let body = Pendulum { length, mass, gravity, damping, theta0, omega0, kick };
            let mut state = body.start();
            let (system, mut integrator) = (problem(body.clone()), fresh(method));
            for step in 0..40 {
                let (t, h) = (f64::from(step) / hz, 1.0 / hz);
                if integrator.step(&system, t, h, &mut state).is_err() {
                    given_up.push((method.id, step, hz, body.clone()));
                    break;
                }
                assert!(state.q.is_finite() && state.v.is_finite(), "{}", method.id);
            }
        }
    }
    assert_eq!(given_up, []);
}

/// A force whose second component is NaN or infinite.
struct Broken(f64);

impl System for Broken {
    type Vector = DVec2;
    fn acceleration(&self, _t: f64, q: &DVec2, _v: &DVec2, a: &mut DVec2) {
        *a = DVec2::new(-q.x, self.0);
    }
}

/// A force with a pole at 1.
struct Pole;

impl System for Pole {
    type Vector = f64;
    fn acceleration(&self, _t: f64, q: &f64, _v: &f64, a: &mut f64) {
        *a = 1.0 / (q - 1.0);
    }
}

#[test]
fn an_equation_without_a_solution_is_reported() {
    for method in implicit() {
        let mut state = State { q: 0.0, v: 0.01 };
        let stepped = fresh(method).step(&problem(DryFriction), 0.0, 0.1, &mut state);
        let Err(failure @ StepFailure::NewtonFailed { limit }) = stepped else {
            panic!("{}: {stepped:?}", method.id)
        };
        assert!(limit >= 10);
        let said = failure.to_string();
        assert!(
            said.contains(&limit.to_string()) && said.contains("raise the tick rate"),
            "{said}"
        );
    }
}

#[test]
fn a_force_or_a_state_that_is_not_finite_is_reported() {
    for method in implicit() {
        for broken in [f64::NAN, f64::INFINITY] {
            let mut state = State { q: DVec2::ONE, v: DVec2::ZERO };
            let mut integrator = integrator(method, &state.q);
            let stepped = integrator.step(&problem(Broken(broken)), 0.0, 0.1, &mut state);
            assert!(matches!(stepped, Err(StepFailure::NewtonFailed { .. })), "{}", method.id);

            let mut state = State { q: broken, v: 0.0 };
            let stepped = fresh(method).step(&problem(spring(1.0, 0.0)), 0.0, 0.1, &mut state);
            assert!(matches!(stepped, Err(StepFailure::NewtonFailed { .. })), "{}", method.id);
        }
    }
}

#[test]
fn a_pole_is_no_solution() {
    for method in implicit() {
        let mut state = State { q: 1.0, v: 0.0 };
        let stepped = fresh(method).step(&problem(Pole), 0.0, 0.1, &mut state);
        if ["newmark", "tr-bdf2"].contains(&method.id) {
            // They use the force at the start, which the caller must check.
            assert!(!state.q.is_finite(), "{stepped:?} at {state:?}");
        } else {
            assert!(matches!(stepped, Err(StepFailure::NewtonFailed { .. })), "{}", method.id);
        }
    }
}

#[test]
fn a_coordinate_far_away_does_not_degrade_the_others() {
    // A free point a million metres away, together with a spring: each moves as if alone.
    struct Apart;
    impl System for Apart {
        type Vector = DVec2;
        fn acceleration(&self, _t: f64, q: &DVec2, v: &DVec2, a: &mut DVec2) {
            *a = DVec2::new(-0.1 * v.x * v.x.abs(), -q.y);
        }
    }
    for method in implicit() {
        let run = |far: f64| {
            let mut state = State { q: DVec2::new(far, 1.0), v: DVec2::new(20.0, 0.0) };
            let (apart, mut integrator) = (problem(Apart), integrator(method, &state.q));
            for step in 0..1000 {
                integrator.step(&apart, 0.01 * f64::from(step), 0.01, &mut state).unwrap();
            }
            [state.q.y, state.v.y, state.v.x]
        };
        for (near, far) in run(0.0).into_iter().zip(run(1e6)) {
            assert!((near / far - 1.0).abs() < 1e-13, "{}: {near}, {far}", method.id);
        }
    }
}
