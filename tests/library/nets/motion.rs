//! The motion of a net: its conserved quantities, and its agreement with other bodies.

use regatta::sim::bodies::{Body, Chain, Input, PlannedSpring, net_kind};
use regatta::sim::integrators::{Family, GENERAL_METHODS, StepFailure};
use regatta::sim::{Solver, Stepper};

use super::*;

#[test]
fn velocity_verlet_bounds_a_nets_energy_over_a_hundred_thousand_ticks() {
    let values = Values { gravity: 9.81, ..PLAIN };
    let mut net = build(&grid(8, 6, Some(Pin::Corners)), values, with("velocity-verlet"));
    let start = energy(&*net);
    let (mut early, mut late, mut kinetic) = (0.0_f64, 0.0_f64, 0.0_f64);
    // h ω = 1.1 for the fastest motion.
    run(&mut *net, 250.0, 100_000, |tick, net| {
        let off = (energy(net) - start).abs();
        kinetic = kinetic.max(net.kinetic_energy().unwrap());
        if tick <= 10_000 { early = early.max(off) } else { late = late.max(off) }
    });
    assert!(early > 1e-4 * kinetic && early < 0.05 * kinetic, "{early} J of {kinetic} J");
    assert!(late > 0.5 * early && late < 1.5 * early, "{early} J, then {late} J");
}

#[test]
fn explicit_euler_feeds_energy_into_a_net() {
    let values = Values { gravity: 9.81, ..PLAIN };
    let mut net = build(&grid(8, 6, Some(Pin::Corners)), values, with("explicit-euler"));
    let start = energy(&*net);
    run(&mut *net, 1000.0, 2000, |_, _| {});
    assert!(energy(&*net) > start + 1.0, "{} J", energy(&*net) - start);
}

#[test]
fn momentum_is_kept_to_rounding_without_gravity_and_pins() {
    // Stretched springs and a kick, so that everything moves; damping along a spring is an inner force too.
    let mut plan = grid(5, 4, None);
    plan.kicked = Some(7);
    for damping in [0.0, 0.05] {
        let values = Values { damping, rest_ratio: 0.9, kick: [2.0, -1.0], ..PLAIN };
        for method in GENERAL_METHODS {
            let mut net = build(&plan, values, Solver::Method(method));
            assert!(net.input(0.0, Input::Kick(1.0)));
            let momentum = |net: &dyn Stepper| {
                [0, 1].map(|axis| net.v().iter().skip(axis).step_by(2).sum::<f64>())
            };
            assert_eq!(momentum(&*net), [2.0, -1.0]);
            let hz = if method.family == Family::Implicit { 60.0 } else { 600.0 };
            // Jakobsen's takes a hundredth of every velocity at each step.
            let kept = if method.order == 0 { 0.99 } else { 1.0 };
            let (mut fastest, mut left) = (0.0_f64, 1.0);
            for tick in 0..600 {
                if net.advance(f64::from(tick) / hz, 1.0 / hz, 1).is_err() {
                    break;
                }
                fastest = net.v().iter().fold(fastest, |most, v| most.max(v.abs()));
                left *= kept;
            }
            assert!(fastest.is_finite(), "{}", method.id);
            let [x, y] = momentum(&*net);
            let off = (x - 2.0 * left).abs().max((y + left).abs());
            assert!(off <= 1e-11 * fastest, "{}: off by {off:e} m/s of {fastest}", method.id);
            assert!(fastest > 0.2, "{}: {fastest} m/s", method.id);
        }
    }
}

/// Masses in a row between two fixed nodes a metre apart each, displaced as a chain is at its start.
fn chain_as_net(chain: &Chain) -> NetPlan {
    let displaced = chain.start().q;
    let masses = displaced.len();
    let place =
        |j: usize| j as f64 + if (1..=masses).contains(&j) { displaced[j - 1] } else { 0.0 };
    let nodes: Vec<[f64; 2]> = (0..masses + 2).map(|j| [place(j), 0.0]).collect();
    let spring = |j| PlannedSpring { between: [j, j + 1], rest: Some(1.0), ..Default::default() };
    let springs: Vec<_> = (0..=masses).map(spring).collect();
    // The kicked node comes first, so that the order of the masses is that of the chain.
    NetPlan { kicked: Some(1), ..lists(&nodes, &[0, masses + 1], &springs) }
}

#[test]
fn a_chain_as_a_net_follows_the_chains_exact_solution() {
    for damping in [0.0, 0.4] {
        let chain = Chain::default().with_parameters(&[6.0, 0.5, 90.0, damping, 3.0, 0.4, 1.0]);
        let values = Values { mass: 0.5, stiffness: 90.0, damping, ..PLAIN };
        let mut net = build(&chain_as_net(&chain), values, Solver::Truth);
        let start = chain.start();
        let mut moved = 0.0_f64;
        run(&mut *net, 20.0, 200, |tick, net| {
            let exact = chain.exact(f64::from(tick) / 20.0, &start).unwrap();
            for (j, (x, v)) in exact.q.iter().zip(&exact.v).enumerate() {
                let (q, w) = (net.q()[2 * j] - (j + 1) as f64, net.v()[2 * j]);
                assert!((q - x).abs() < 1e-9, "tick {tick}, mass {j}: {q}, not {x}");
                assert!((w - v).abs() < 1e-8, "tick {tick}, mass {j}: {w}, not {v}");
                assert_eq!([net.q()[2 * j + 1], net.v()[2 * j + 1]], [0.0; 2]);
                moved = moved.max((x - start.q[j]).abs());
            }
        });
        assert!(moved > 0.2, "{moved} m");
    }
}

#[test]
fn every_method_moves_a_chain_and_its_net_alike() {
    let values = Values { mass: 0.5, stiffness: 90.0, damping: 0.4, ..PLAIN };
    let chain = Chain::default().with_parameters(&[6.0, 0.5, 90.0, 0.4, 3.0, 0.1, 1.0]);
    for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
        let mut net = build(&chain_as_net(&chain), values, Solver::Method(method));
        let kind = regatta::sim::bodies::kind("chain").unwrap();
        let mut whole = (kind.build)(&[6.0, 0.5, 90.0, 0.4, 3.0, 0.1, 1.0], Solver::Method(method));
        for tick in 0..100 {
            let t = f64::from(tick) / 240.0;
            whole.advance(t, 1.0 / 240.0, 1).unwrap();
            net.advance(t, 1.0 / 240.0, 1).unwrap();
            for (j, x) in whole.q().iter().enumerate() {
                let q = net.q()[2 * j] - (j + 1) as f64;
                assert!((q - x).abs() < 1e-10, "{}, tick {tick}: {q}, not {x}", method.id);
            }
        }
    }
}

#[test]
fn a_kick_hits_one_node_or_all_and_drag_slows_them() {
    let mut plan = grid(4, 3, None);
    let kicked = |plan: &NetPlan| {
        let mut net = build(plan, PLAIN, with("rk4"));
        assert!(net.input(0.0, Input::Kick(2.0)) && !net.input(0.0, Input::Throttle(1.0)));
        net.v().to_vec()
    };
    assert!(kicked(&plan).as_chunks().0.iter().all(|v| *v == [6.0, 0.0]));
    plan.kicked = Some(5);
    let velocities = kicked(&plan);
    assert!(velocities[..2] == [6.0, 0.0] && velocities[2..].iter().all(|v| *v == 0.0));
    let kind = net_kind(plan.clone()).unwrap();
    let names: Vec<_> = kind.coordinates(&[]).iter().map(|it| it.name).collect();
    assert_eq!(
        names.iter().map(|it| &**it).take(6).collect::<Vec<_>>(),
        ["x5", "y5", "x0", "y0", "x1", "y1"]
    );

    // All nodes move as one: v′ = -b v / m.
    let plan = grid(4, 3, None);
    let mut net = build(&plan, Values { drag: 0.04, ..PLAIN }, Solver::Truth);
    net.input(0.0, Input::Kick(1.0));
    run(&mut *net, 10.0, 10, |_, _| {});
    let wanted = 3.0 * libm::exp(-0.04 / 0.02);
    assert!(net.v().iter().step_by(2).all(|v| (v - wanted).abs() < 1e-9), "{:?}", net.v());
}

#[test]
fn a_spring_keeps_its_own_values_when_the_net_is_edited() {
    let nodes = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let own = PlannedSpring {
        between: [0, 2],
        stiffness: Some(50.0),
        damping: Some(0.0),
        rest: Some(0.5),
    };
    let plain = PlannedSpring { between: [0, 1], ..Default::default() };
    let mut net = build(&lists(&nodes, &[0], &[plain, own]), PLAIN, with("rk4"));
    let pulls = |net: &dyn Stepper| {
        let mut a = [0.0; 4];
        net.acceleration(0.0, net.q(), net.v(), &mut a);
        a
    };
    // Node 2 comes first. Its spring is stretched by half a metre; the other is at rest.
    assert_eq!(pulls(&*net), [0.0, -0.5 * 50.0 / 0.02, 0.0, 0.0]);
    for (index, value) in [(1, 400.0), (5, 0.75)] {
        assert!(net.set_parameter(0.0, index, value));
    }
    assert_eq!(pulls(&*net), [0.0, -0.5 * 50.0 / 0.02, -0.25 * 400.0 / 0.02, 0.0]);
    assert!(net.set_parameter(0.0, 0, 0.04));
    assert_eq!(pulls(&*net), [0.0, -0.5 * 50.0 / 0.04, -0.25 * 400.0 / 0.04, 0.0]);
}

#[test]
fn a_net_has_a_reference_only_up_to_the_stated_work() {
    let plan = grid(8, 6, Some(Pin::Top));
    let mut has_truth = Vec::new();
    for stiffness in [20.0, 200.0, 2000.0, 20_000.0] {
        let mut net = build(&plan, Values { stiffness, ..PLAIN }, Solver::Truth);
        net.input(0.0, Input::Kick(1.0));
        let advanced = net.advance(0.0, 1.0 / 240.0, 1);
        assert_eq!(advanced.is_err(), net.is_beyond_reference(), "{stiffness} N/m");
        match advanced {
            Ok(()) => assert!(net.truth_error().unwrap()[0] < 1e-9),
            Err(failure) => {
                assert!(matches!(failure, StepFailure::ReferenceTooExpensive { .. }), "{failure}");
                assert_eq!(net.truth_error(), Some([f64::INFINITY; 2]));
                assert!(failure.to_string().starts_with("has no reference solution"), "{failure}");
            }
        }
        has_truth.push(!net.is_beyond_reference());
    }
    assert_eq!(has_truth, [true, true, false, false]);
}
