//! The formulas by hand: one body, one method, local numbers, no interface.

use std::hint::black_box;

use crate::rows;

/// Carries `state`, the coordinates and then their velocities, through `[ticks, substeps]` steps of `h`
/// of a body whose keys have these `values`.
pub(crate) type Loop = fn(values: &[f64], h: f64, steps: [u32; 2], state: &mut [f64]);

/// One body and method by hand, in three ways.
#[derive(Clone, Copy)]
pub(crate) struct ByHand {
    /// The force divided by the mass at every stage, as the equation is printed.
    pub(crate) textbook: Loop,
    /// Every division before the loop: the same bits as ours.
    pub(crate) bare: Loop,
    /// The bare loop with its state in memory after each tick, where whoever draws it finds it.
    pub(crate) shown: Loop,
}

/// The loops for this body and method, where they are written.
pub(crate) fn by_hand(body: &str, method: &str) -> Option<ByHand> {
    macro_rules! of {
        ($method:ident, $textbook:ident, $bare:ident) => {
            ByHand {
                textbook: |values, h, steps, state| {
                    $method($textbook(values), h, steps, state, kept)
                },
                bare: |values, h, steps, state| $method($bare(values), h, steps, state, kept),
                shown: |values, h, steps, state| $method($bare(values), h, steps, state, black_box),
            }
        };
    }
    Some(match (body, method) {
        ("ship", "explicit-euler") => of!(explicit_euler, textbook_ship, bare_ship),
        ("ship", "semi-implicit-euler") => of!(semi_implicit_euler, textbook_ship, bare_ship),
        ("ship", "improved-euler") => of!(improved_euler, textbook_ship, bare_ship),
        ("ship", "velocity-verlet") => of!(velocity_verlet, textbook_ship, bare_ship),
        ("ship", "rk4") => of!(rk4, textbook_ship, bare_ship),
        ("spring", "explicit-euler") => of!(explicit_euler, textbook_spring, bare_spring),
        ("spring", "semi-implicit-euler") => of!(semi_implicit_euler, textbook_spring, bare_spring),
        ("spring", "improved-euler") => of!(improved_euler, textbook_spring, bare_spring),
        ("spring", "velocity-verlet") => of!(velocity_verlet, textbook_spring, bare_spring),
        ("spring", "rk4") => of!(rk4, textbook_spring, bare_spring),
        ("chain", "semi-implicit-euler") => rows::SEMI_IMPLICIT_EULER,
        ("chain", "velocity-verlet") => rows::VELOCITY_VERLET,
        ("chain", "rk4") => rows::RK4,
        _ => return None,
    })
}

/// Leaves the state where it is: in registers.
fn kept(state: [f64; 2]) -> [f64; 2] {
    state
}

fn textbook_ship(values: &[f64]) -> impl Fn(f64, f64) -> f64 {
    let (thrust, drag, mass) = (values[0], values[1], values[2]);
    move |_s, v| (thrust - drag * v) / mass
}

fn bare_ship(values: &[f64]) -> impl Fn(f64, f64) -> f64 {
    let (push, rate) = (values[0] / values[2], values[1] / values[2]);
    move |_s, v| push - rate * v
}

fn textbook_spring(values: &[f64]) -> impl Fn(f64, f64) -> f64 {
    let (mass, stiffness, damping) = (values[0], values[1], values[2]);
    move |x, v| (-stiffness * x - damping * v) / mass
}

fn bare_spring(values: &[f64]) -> impl Fn(f64, f64) -> f64 {
    let (k, c) = (values[1] / values[0], values[2] / values[0]);
    move |x, v| -k * x - c * v
}

#[inline(always)]
fn explicit_euler(
    a: impl Fn(f64, f64) -> f64,
    h: f64,
    [ticks, substeps]: [u32; 2],
    state: &mut [f64],
    show: impl Fn([f64; 2]) -> [f64; 2],
) {
    let (mut q, mut v) = (state[0], state[1]);
    for _ in 0..ticks {
        for _ in 0..substeps {
            (q, v) = (q + h * v, v + h * a(q, v));
        }
        [q, v] = show([q, v]);
    }
    state.copy_from_slice(&[q, v]);
}

#[inline(always)]
fn semi_implicit_euler(
    a: impl Fn(f64, f64) -> f64,
    h: f64,
    [ticks, substeps]: [u32; 2],
    state: &mut [f64],
    show: impl Fn([f64; 2]) -> [f64; 2],
) {
    let (mut q, mut v) = (state[0], state[1]);
    for _ in 0..ticks {
        for _ in 0..substeps {
            v += h * a(q, v);
            q += h * v;
        }
        [q, v] = show([q, v]);
    }
    state.copy_from_slice(&[q, v]);
}

#[inline(always)]
fn velocity_verlet(
    a: impl Fn(f64, f64) -> f64,
    h: f64,
    [ticks, substeps]: [u32; 2],
    state: &mut [f64],
    show: impl Fn([f64; 2]) -> [f64; 2],
) {
    let (mut q, mut v) = (state[0], state[1]);
    let (mut force, half) = (a(q, v), h / 2.0);
    for _ in 0..ticks {
        for _ in 0..substeps {
            v += half * force;
            q += h * v;
            force = a(q, v + half * force);
            v += half * force;
        }
        [q, v] = show([q, v]);
    }
    state.copy_from_slice(&[q, v]);
}

#[inline(always)]
fn improved_euler(
    a: impl Fn(f64, f64) -> f64,
    h: f64,
    [ticks, substeps]: [u32; 2],
    state: &mut [f64],
    show: impl Fn([f64; 2]) -> [f64; 2],
) {
    let (mut q, mut v) = (state[0], state[1]);
    let half = h / 2.0;
    for _ in 0..ticks {
        for _ in 0..substeps {
            let (q1, a1) = (v, a(q, v));
            let (q2, a2) = (v + h * a1, a(q + h * q1, v + h * a1));
            q = q + half * q1 + half * q2;
            v = v + half * a1 + half * a2;
        }
        [q, v] = show([q, v]);
    }
    state.copy_from_slice(&[q, v]);
}

#[inline(always)]
fn rk4(
    a: impl Fn(f64, f64) -> f64,
    h: f64,
    [ticks, substeps]: [u32; 2],
    state: &mut [f64],
    show: impl Fn([f64; 2]) -> [f64; 2],
) {
    let (mut q, mut v) = (state[0], state[1]);
    let (half, third, sixth) = (h / 2.0, h / 3.0, h / 6.0);
    for _ in 0..ticks {
        for _ in 0..substeps {
            let (q1, a1) = (v, a(q, v));
            let (q2, a2) = (v + half * a1, a(q + half * q1, v + half * a1));
            let (q3, a3) = (v + half * a2, a(q + half * q2, v + half * a2));
            let (q4, a4) = (v + h * a3, a(q + h * q3, v + h * a3));
            q = q + sixth * q1 + third * q2 + third * q3 + sixth * q4;
            v = v + sixth * a1 + third * a2 + third * a3 + sixth * a4;
        }
        [q, v] = show([q, v]);
    }
    state.copy_from_slice(&[q, v]);
}
