//! The small motions of bodies by themselves: their modes, and what a method makes of them.

use regatta::sim::bodies::kind;
use regatta::sim::integrators::{GENERAL_METHODS, method};
use regatta::sim::stability::{
    NoSmallMotion, NormalMode, PowerIteration, SmallMotion, Stability, Tick, normal_modes, unforced,
};
use regatta::sim::{Solver, Stepper};

fn body(id: &str, values: &[f64]) -> Box<dyn Stepper> {
    (kind(id).unwrap().build)(values, Solver::Truth)
}

#[test]
fn a_pendulum_at_rest_swings_like_a_spring_and_an_orbit_has_no_rest() {
    let pendulum = body("pendulum", &[2.0, 3.0, 9.81, 0.6, 1.2, 0.5, 1.0]);
    let modes = SmallMotion::of(&*pendulum).unwrap().normal_modes().unwrap();
    assert_eq!(modes.len(), 1);
    assert!((modes[0].omega_squared / (9.81 / 2.0) - 1.0).abs() < 1e-6, "{modes:?}");
    // The damping is c / (m l²), with l = 2 m and m = 3 kg.
    assert!((modes[0].damping_per_s / (0.6 / 12.0) - 1.0).abs() < 1e-6, "{modes:?}");
    let orbit = SmallMotion::of(&*body("orbit", &[1000.0, 9.0, 2.0, 1.5, 10.0, 0.3]));
    assert_eq!(orbit.err(), Some(NoSmallMotion::NoRest));
}

#[test]
fn a_whole_chain_is_as_stable_as_its_modes() {
    for damping in [0.0, 0.3] {
        let chain = unforced(&*body("chain", &[4.0, 0.5, 200.0, damping, 2.0, 0.7, 2.0]));
        let small = SmallMotion::of(&*chain).unwrap();
        let modes = small.normal_modes().unwrap();
        let coupled = small.coupled().unwrap();
        assert!(!coupled.grows());
        for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
            for (h, substeps) in [(0.02, 1), (0.04, 2), (0.06, 1)] {
                let tick = Tick { t: 0.0, h, substeps };
                let found = coupled.stability(method, h, substeps).unwrap();
                let (mut growth, mut radius) = (f64::NEG_INFINITY, 0.0_f64);
                for mode in &modes {
                    let alone = mode.stability(&*chain, Solver::Method(method), tick).unwrap();
                    growth = growth.max(alone.growth_per_s);
                    radius = radius.max(alone.spectral_radius);
                }
                let what = format!("{}, c = {damping}, {h} s", method.id);
                let off = (found.growth_per_s - growth).abs();
                assert!(off <= 1e-6 * (1.0 + growth.abs()), "{what}: {found:?}, {growth}");
                let off = (found.spectral_radius / radius - 1.0).abs();
                assert!(off <= 1e-6, "{what}: {found:?}, {radius}");
            }
        }
    }
}

fn mode(omega_squared: f64, damping_per_s: f64) -> NormalMode {
    NormalMode { shape: vec![1.0], omega_squared, damping_per_s }
}

const MASSES: usize = 5;

fn chain(damping: f64) -> Box<dyn Stepper> {
    body("chain", &[MASSES as f64, 0.5, 200.0, damping, 2.0, 0.7, 2.0])
}

#[test]
fn the_modes_of_a_chain_are_its_standing_waves() {
    for damping in [0.0, 0.3] {
        let mut modes = normal_modes(&*chain(damping)).unwrap();
        modes.sort_by(|a, b| a.omega_squared.total_cmp(&b.omega_squared));
        assert_eq!(modes.len(), MASSES);
        for (n, mode) in (1..).zip(&modes) {
            let half = n as f64 * std::f64::consts::PI / 2.0 / (MASSES + 1) as f64;
            let wanted = 4.0 * libm::sin(half) * libm::sin(half);
            assert!((mode.omega_squared / (wanted * 400.0) - 1.0).abs() < 1e-12, "{mode:?}");
            let decay = wanted * damping / 0.5;
            assert!((mode.damping_per_s - decay).abs() < 1e-12, "{mode:?}");
            // `length` is the projection of a wave of amplitude 1 onto a shape of length 1.
            let wave: Vec<f64> = (1..=MASSES).map(|j| libm::sin(2.0 * half * j as f64)).collect();
            let length = ((MASSES + 1) as f64 / 2.0).sqrt();
            for other in &modes {
                let part = if other == mode { length } else { 0.0 };
                assert!((other.part(&wave).abs() - part).abs() < 1e-12, "{n}: {other:?}");
            }
        }
    }
}

#[test]
fn a_nonlinear_body_has_no_modes_and_thrust_does_not_change_modes() {
    assert_eq!(normal_modes(&*body("pendulum", &[1.0, 1.0, 9.81, 0.0, 1.0, 0.0, 1.0])), None);
    assert_eq!(normal_modes(&*body("orbit", &[1000.0, 9.0, 2.0, 1.5, 10.0, 0.3])), None);
    let ship = body("ship", &[2000.0, 300.0, 1000.0, 0.0, 0.0, 1.0]);
    let modes = normal_modes(&*ship).unwrap();
    assert_eq!(modes.len(), 1);
    assert_eq!((modes[0].omega_squared, modes[0].damping_per_s), (0.0, 0.3));
}

#[test]
fn a_chain_mode_is_as_stable_as_a_spring_of_its_frequency_and_damping() {
    for damping in [0.0, 0.3] {
        let chain = unforced(&*chain(damping));
        for mode in normal_modes(&*chain).unwrap() {
            let values = [1.0, mode.omega_squared, mode.damping_per_s, 1.0, 0.0, 1.0];
            let spring = body("spring", &values);
            let alone = NormalMode { shape: vec![1.0], ..mode.clone() };
            for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
                for (h, substeps) in [(0.02, 1), (0.04, 2), (0.06, 1)] {
                    let solver = Solver::Method(method);
                    let tick = Tick { t: 0.0, h, substeps };
                    let found = mode.stability(&*chain, solver, tick).unwrap();
                    let alone = alone.stability(&*spring, solver, tick).unwrap();
                    let all = |s: Stability| {
                        [
                            s.spectral_radius,
                            s.growth_per_s,
                            s.loss_per_s,
                            s.frequency_error.unwrap_or(9.0),
                        ]
                    };
                    for (found, alone) in all(found).into_iter().zip(all(alone)) {
                        let off = (found - alone).abs();
                        assert!(off <= 1e-6, "{}, {mode:?}, {h} s: {found}, {alone}", method.id);
                    }
                }
            }
        }
    }
}

#[test]
fn a_frequency_error_is_known_up_to_half_a_turn_per_tick() {
    let midpoint = Solver::Method(method("implicit-midpoint").unwrap());
    for (turned, told) in [(3.1, true), (3.2, false), (8.0, false), (13.0, false), (30.0, false)] {
        let spring = body("spring", &[1.0, turned * turned, 0.0, 1.0, 0.0, 1.0]);
        let tick = Tick { t: 0.0, h: 1.0, substeps: 1 };
        let found = mode(turned * turned, 0.0).stability(&*spring, midpoint, tick);
        let error = found.unwrap().frequency_error;
        let wanted = 2.0 * libm::atan(turned / 2.0) / turned - 1.0;
        assert_eq!(error.is_some(), told, "{turned} rad");
        let is_near = |error: f64| (error - wanted).abs() <= 1e-9 * wanted.abs();
        assert!(error.is_none_or(is_near), "{turned} rad: {error:?}, not {wanted}");
    }
}

#[test]
fn a_small_motion_has_the_map_of_a_large_one_without_speed_limit() {
    let spring = body("spring", &[1.0, 9e6, 600.0, 1.0, 0.0, 1.0]);
    let of = |id: &str, h: f64| {
        let (mode, solver) = (mode(9e6, 600.0), Solver::Method(method(id).unwrap()));
        let tick = Tick { t: 0.0, h, substeps: 1 };
        let small = mode.stability_of_small(&*spring, solver, tick).unwrap();
        (small, mode.stability(&*spring, solver, tick).unwrap())
    };
    for id in ["rk4", "implicit-midpoint", "adams-bashforth-2"] {
        let (small, large) = of(id, 1e-4);
        assert_eq!(small, large, "{id}");
    }
    // Rapier's limit of 400 m/s is below the 3000 m/s of an amplitude of 1 m.
    let (small, large) = of("engine-rapier", 1e-4);
    assert_ne!(small, large);
}

#[test]
fn a_small_loss_of_a_multistep_method_is_found_over_many_ticks() {
    let h = 0.001;
    let spring = body("spring", &[1.0, 25.0, 0.0, 1.0, 0.0, 1.0]);
    let tick = Tick { t: 0.0, h, substeps: 1 };
    let solver = Solver::Method(method("bdf2").unwrap());
    let found = mode(25.0, 0.0).stability(&*spring, solver, tick).unwrap();
    // BDF2 on y′ = iω y reduces the amplitude by z⁴/4 per step, to first order.
    let wanted = 0.005_f64.powi(4) / 4.0 / h;
    assert!((found.loss_per_s / wanted - 1.0).abs() < 0.01, "{found:?}, not {wanted}");
    assert!((found.growth_per_s / wanted + 1.0).abs() < 0.01, "{found:?}, not {wanted}");
    // Adams-Bashforth gains by the same rate and has no loss.
    let solver = Solver::Method(method("adams-bashforth-2").unwrap());
    let found = mode(25.0, 0.0).stability(&*spring, solver, tick).unwrap();
    assert!((found.growth_per_s / wanted - 1.0).abs() < 0.01, "{found:?}, not {wanted}");
    assert_eq!(found.loss_per_s, 0.0);
}

fn spectral_radius(body: &dyn Stepper, id: &str, tick: Tick) -> Option<f64> {
    let solver = Solver::Method(method(id).unwrap());
    let mut iteration = PowerIteration::new(body, solver, tick, u64::MAX).unwrap()?;
    while iteration.advance().unwrap() {}
    iteration.radius()
}

/// Returns the spectral radius of a method on a chain of ω² = 800, whose fastest mode has ω² = 3200 sin²(5π/11).
fn radius_on_chain(id: &str, h: f64) -> Option<f64> {
    let chain =
        (kind("chain").unwrap().build)(&[10.0, 1.0, 800.0, 0.0, 3.0, 1.0, 1.0], Solver::Truth);
    spectral_radius(&*chain, id, Tick { t: 0.0, h, substeps: 1 })
}

fn fastest() -> f64 {
    2.0 * 800.0_f64.sqrt() * libm::sin(10.0 * std::f64::consts::PI / 22.0)
}

#[test]
fn the_fastest_mode_determines_the_spectral_radius() {
    for h in [0.01, 0.03, 0.1] {
        let z = h * fastest();
        let wanted = (1.0 + z * z).sqrt();
        let found = radius_on_chain("explicit-euler", h).unwrap();
        assert!((found / wanted - 1.0).abs() < 2e-3, "{h} s: {found}, not {wanted}");
        // Both eigenvalues are real beyond z = 2.
        let trace: f64 = z * z - 2.0;
        let beyond = (trace + (trace * trace - 4.0).max(0.0).sqrt()) / 2.0;
        let wanted = if z > 2.0 { beyond } else { 1.0 };
        for id in ["semi-implicit-euler", "velocity-verlet"] {
            let found = radius_on_chain(id, h).unwrap();
            assert!((found / wanted - 1.0).abs() < 2e-3, "{id}, {h} s: {found}, not {wanted}");
        }
        let found = radius_on_chain("implicit-midpoint", h).unwrap();
        assert!((found - 1.0).abs() < 2e-3, "{h} s: {found}");
    }
}

#[test]
fn implicit_euler_shrinks_by_its_slowest_mode() {
    let slowest = 2.0 * 800.0_f64.sqrt() * libm::sin(std::f64::consts::PI / 22.0);
    let z = 0.05 * slowest;
    let (found, wanted) =
        (radius_on_chain("implicit-euler", 0.05).unwrap(), 1.0 / (1.0 + z * z).sqrt());
    assert!((found / wanted - 1.0).abs() < 2e-3, "{found}, not {wanted}");
}

#[test]
fn the_spectral_radius_of_a_multistep_method_includes_its_memory() {
    // The fastest mode has ω² = 3200 sin²(5π/11) and a damping ratio of 0.2.
    let c = 0.4 * fastest() * 800.0 / (fastest() * fastest());
    let values = [10.0, 1.0, 800.0, c, 3.0, 1.0, 1.0];
    let chain = (kind("chain").unwrap().build)(&values, Solver::Truth);
    for id in ["velocity-verlet", "adams-bashforth-2", "stormer-verlet"] {
        // The limit of velocity Verlet is 1.354 at this damping ratio, and 2 without damping.
        for z in [0.5, 1.2, 1.7, 3.0] {
            let tick = Tick { t: 0.0, h: z / fastest(), substeps: 1 };
            let coupled = SmallMotion::of(&*chain).unwrap().coupled().unwrap();
            let wanted = coupled.stability(method(id).unwrap(), tick.h, 1).unwrap();
            let wanted = wanted.spectral_radius;
            let found = spectral_radius(&*chain, id, tick).unwrap();
            let off = (found / wanted - 1.0).abs();
            assert!(off < 2e-3, "{id}, h ω = {z}: {found}, not {wanted}");
        }
    }
}

#[test]
fn a_drift_is_no_growth_and_a_self_substepping_method_has_no_radius() {
    let ship = (kind("ship").unwrap().build)(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], Solver::Truth);
    let tick = Tick { t: 0.0, h: 0.1, substeps: 1 };
    let of = |id| spectral_radius(&*ship, id, tick);
    for id in ["explicit-euler", "velocity-verlet", "adams-bashforth-2"] {
        let found = of(id).unwrap();
        assert!((found - 1.0).abs() < 2e-3, "{id}: {found}");
    }
    for id in ["bdf2", "dormand-prince-54"] {
        assert_eq!(of(id), None, "{id}");
    }
}
