//! The chain: its modes, its flow, its energy.

use regatta::sim::bodies::{Body, Chain, Input, Spring};
use regatta::sim::{State, System};

use super::flow::{apart, flow, satisfies_its_equation, size};

const MASS: f64 = 0.5;
const STIFFNESS: f64 = 200.0;

fn chain(masses: usize, damping: f64) -> Chain {
    let [masses, plucked] = [masses, masses.div_ceil(3)].map(|count| count as f64);
    Chain::default().with_parameters(&[masses, MASS, STIFFNESS, damping, plucked, 0.7, 2.0])
}

/// The damping at which mode `n` is critical: c ω² / k = 2 ω.
fn critical(chain: &Chain, n: usize) -> f64 {
    2.0 * STIFFNESS / chain.angular_frequency(n)
}

/// A state in which every mode is excited.
fn excited(masses: usize) -> State<Vec<f64>> {
    let wave = |j: usize, a: f64, b: f64| libm::sin(a * j as f64 + b) + 0.2;
    State {
        q: (1..=masses).map(|j| wave(j, 2.3, 0.4)).collect(),
        v: (1..=masses).map(|j| 9.0 * wave(j, 1.1, 2.0)).collect(),
    }
}

#[test]
fn the_flow_satisfies_its_equation_underdamped_critical_and_overdamped() {
    for masses in [1, 2, 3, 8, 33] {
        let free = chain(masses, 0.0);
        let middle = masses.div_ceil(2);
        // At the last damping all modes are overdamped; at that of the middle mode, some are.
        let dampings =
            [0.0, 1e-9, 0.3, critical(&free, middle), critical(&free, 1), 3.0 * critical(&free, 1)];
        for damping in dampings {
            let body = chain(masses, damping);
            let fastest = body.angular_frequency(masses);
            let rate = fastest.max(damping / STIFFNESS * fastest * fastest);
            for dt in [0.0, 0.01, 0.3, 2.0, 40.0] {
                satisfies_its_equation(&body, &body.start(), dt, 1.0 / rate, 1e-11);
                satisfies_its_equation(&body, &excited(masses), dt, 1.0 / rate, 1e-11);
            }
        }
    }
}

#[test]
fn a_mode_keeps_its_shape_and_oscillates_at_its_frequency() {
    let masses = 7;
    let body = chain(masses, 0.0);
    for n in 1..=masses {
        let shape = |j: usize| libm::sin(std::f64::consts::PI * (j * n) as f64 / 8.0);
        let mode: Vec<f64> = (1..=masses).map(shape).collect();
        // The equation says ω² x = (2 xⱼ - xⱼ₋₁ - xⱼ₊₁) k/m.
        let omega = body.angular_frequency(n);
        let mut a = vec![0.0; masses];
        body.acceleration(0.0, &mode, &vec![0.0; masses], &mut a);
        for (a, x) in a.iter().zip(&mode) {
            assert!((a + omega * omega * x).abs() < 1e-10, "mode {n}: {a}, {x}");
        }
        let later = flow(&body, 1.7, &State { q: mode.clone(), v: vec![0.0; masses] });
        for (later, x) in later.q.iter().zip(&mode) {
            assert!((later - x * libm::cos(omega * 1.7)).abs() < 1e-13, "mode {n}");
        }
    }
}

#[test]
fn each_mode_decays_at_its_own_rate() {
    let (masses, damping) = (5, 0.8);
    let body = chain(masses, damping);
    let energy = |state: &State<Vec<f64>>| chain(masses, 0.0).energy(state).unwrap();
    for n in 1..=masses {
        let shape = |j: usize| libm::sin(std::f64::consts::PI * (j * n) as f64 / 6.0);
        let start = State { q: (1..=masses).map(shape).collect(), v: vec![0.0; masses] };
        let omega = body.angular_frequency(n);
        let rate = damping / STIFFNESS * omega * omega;
        let periods = std::f64::consts::TAU * 4.0 / (omega * omega - rate * rate / 4.0).sqrt();
        let left = energy(&flow(&body, periods, &start)) / energy(&start);
        assert!((left / libm::exp(-rate * periods) - 1.0).abs() < 1e-10, "mode {n}: {left}");
    }
}

#[test]
fn a_chain_of_one_is_a_spring_of_twice_the_stiffness() {
    let damping = 3.0;
    let one = chain(1, damping);
    let spring = Spring {
        mass: MASS,
        stiffness: 2.0 * STIFFNESS,
        damping: 2.0 * damping,
        x0: 0.7,
        v0: 0.0,
        kick: 2.0,
    };
    for dt in [0.01, 0.2, 3.0] {
        let (chain, spring) = (flow(&one, dt, &one.start()), flow(&spring, dt, &spring.start()));
        assert!((chain.q[0] - spring.q).abs() < 1e-14 && (chain.v[0] - spring.v).abs() < 1e-13);
    }
}

#[test]
fn the_flow_conserves_energy_and_composes() {
    for masses in [1, 6, 64, 256] {
        let body = chain(masses, 0.0);
        let start = excited(masses);
        let before = body.energy(&start).unwrap();
        let first = flow(&body, 3.3, &start);
        assert!((body.energy(&first).unwrap() / before - 1.0).abs() < 1e-12, "{masses} masses");
        let (twice, once) = (flow(&body, 8.1, &first), flow(&body, 3.3 + 8.1, &start));
        assert!(apart(&twice.q, &once.q) < 1e-11 * size(&start.q), "{masses} masses");
        assert!(apart(&twice.v, &once.v) < 1e-11 * size(&start.v), "{masses} masses");
        let still = flow(&body, 0.0, &start);
        assert!(apart(&still.q, &start.q) < 1e-13 * size(&start.q), "{masses} masses");
    }
}

#[test]
fn a_damped_chain_conserves_no_energy_and_a_kick_hits_the_plucked_mass() {
    assert_eq!(chain(4, 0.1).energy(&excited(4)), None);
    let mut body = chain(4, 0.0);
    let mut state = body.start();
    assert!(body.input(Input::Kick(3.0), &mut state));
    assert_eq!(state.v, [0.0, 3.0 * 2.0 / MASS, 0.0, 0.0]);
    assert!(!body.input(Input::Throttle(1.0), &mut state));
    // Plucked at the second of four: straight lines to the walls.
    let straight = vec![0.35, 0.7, 0.7 * 2.0 / 3.0, 0.7 / 3.0];
    assert!(apart(&state.q, &straight) < 1e-15, "{:?}", state.q);
}
