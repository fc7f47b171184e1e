//! The maps of a free spin against rigid-body mechanics.

use glam::DVec3;
use regatta::sim::integrators::SpinMap;

/// Three moments of inertia, in kg m².
const INERTIA: DVec3 = DVec3::new(1.0, 2.0, 3.0);

/// The length of the angular momentum.
fn momentum(inertia: DVec3, omega: DVec3) -> f64 {
    (inertia * omega).length()
}

/// The angular velocity after `n` steps of `h`.
fn after(map: SpinMap, inertia: DVec3, start: DVec3, h: f64, n: u32) -> DVec3 {
    let omega = (0..n).fold(start, |omega, _| map.step(inertia, omega, h));
    assert!(omega.is_finite(), "{map:?}: {omega}");
    omega
}

/// The largest change of |L| over 3600 steps, relative to it.
fn change_of_momentum(map: SpinMap) -> f64 {
    let start = DVec3::new(3.0, 0.5, 0.5);
    let wanted = momentum(INERTIA, start);
    let (mut omega, mut worst) = (start, 0.0_f64);
    for _ in 0..3600 {
        omega = after(map, INERTIA, omega, 1.0 / 60.0, 1);
        worst = worst.max((momentum(INERTIA, omega) / wanted - 1.0).abs());
    }
    worst
}

#[test]
fn only_scaling_keeps_the_momentum_to_rounding_while_the_axis_turns() {
    for (_, map) in SpinMap::ALL {
        let change = change_of_momentum(map);
        match map {
            SpinMap::Constant => assert_eq!(change, 0.0),
            SpinMap::ScaledMomentum => assert!(change < 3e-14, "{change:e}"),
            SpinMap::RungeKutta => assert!((1e-10..1e-6).contains(&change), "{change:e}"),
            SpinMap::NewtonStep | SpinMap::Explicit => {
                assert!(change > 1e-2, "{map:?}: {change:e}")
            }
        }
    }
}

/// The error after 1 s of a body with two equal moments, whose spin is known: the part across its axis turns evenly.
fn error(map: SpinMap, steps: u32) -> f64 {
    let (across, along) = (1.5, 4.0);
    let inertia = DVec3::new(across, across, along);
    let start = DVec3::new(0.8, 0.0, 1.2);
    let (sin, cos) = (start.z * (along - across) / across).sin_cos();
    let exact = DVec3::new(start.x * cos, start.x * sin, start.z);
    (after(map, inertia, start, 1.0 / f64::from(steps), steps) - exact).length()
}

#[test]
fn runge_kutta_has_order_4_the_constant_map_order_0_and_others_order_1() {
    for (_, map) in SpinMap::ALL {
        let order = match map {
            SpinMap::Constant => 0.0,
            SpinMap::RungeKutta => 4.0,
            SpinMap::ScaledMomentum | SpinMap::NewtonStep | SpinMap::Explicit => 1.0,
        };
        let found = (error(map, 256) / error(map, 512)).log2();
        assert!((found - order).abs() < 0.05, "{map:?}: {found}, not {order}");
    }
}

#[test]
fn the_constant_map_keeps_the_angular_velocity() {
    let start = DVec3::new(3.0, -0.5, 0.1);
    assert_eq!(after(SpinMap::Constant, INERTIA, start, 1.0 / 60.0, 1000), start);
}

#[test]
fn a_body_with_equal_moments_spins_evenly_under_every_map() {
    let start = DVec3::new(3.0, -0.5, 0.1);
    for (_, map) in SpinMap::ALL {
        let found = after(map, DVec3::splat(0.7), start, 1.0 / 60.0, 1000);
        assert!((found - start).length() < 1e-14, "{map:?}: {found}");
    }
}

#[test]
fn a_body_at_rest_stays_at_rest_under_every_map() {
    for (_, map) in SpinMap::ALL {
        assert_eq!(after(map, INERTIA, DVec3::ZERO, 1.0 / 60.0, 10), DVec3::ZERO, "{map:?}");
    }
}

#[test]
fn a_spin_about_a_principal_axis_stays_there_under_every_map() {
    for (_, map) in SpinMap::ALL {
        for axis in DVec3::AXES {
            let start = 5.0 * axis;
            let found = after(map, INERTIA, start, 1.0 / 60.0, 1000);
            assert!((found - start).length() < 1e-14, "{map:?}: {found}");
        }
    }
}

#[test]
fn the_newton_step_leaves_the_quadratic_part_of_implicit_euler() {
    // Newton's method on a quadratic equation leaves the quadratic term of its own step.
    let (start, h) = (DVec3::new(3.0, 0.5, -1.5), 0.1);
    let found = after(SpinMap::NewtonStep, INERTIA, start, h, 1);
    let residual = INERTIA * (found - start) + h * found.cross(INERTIA * found);
    let change = found - start;
    let left = h * change.cross(INERTIA * change);
    assert!((residual - left).length() < 1e-14, "{residual}, {left}");
    assert!((1e-4..1e-3).contains(&left.length()), "{left}");
}

#[test]
fn the_newton_step_is_not_finite_where_its_matrix_has_no_inverse() {
    let inertia = DVec3::new(3.0, 5.0, 8.0);
    for (omega, is_finite) in [(2.0, false), (1.9, true), (2.1, true)] {
        let found = SpinMap::NewtonStep.step(inertia, DVec3::new(0.0, omega, 0.0), 1.0);
        assert_eq!(found.is_finite(), is_finite, "{omega}: {found}");
    }
}
