//! The same by hand for a chain: rows of numbers of a length known at run time, each formula in as few
//! passes over them as it takes.

use std::hint::black_box;

use crate::floor::ByHand;

macro_rules! by_hand {
    ($method:ident) => {
        ByHand {
            textbook: |values, h, steps, state| $method(textbook(values), h, steps, state, |_| ()),
            bare: |values, h, steps, state| $method(bare(values), h, steps, state, |_| ()),
            shown: |values, h, steps, state| $method(bare(values), h, steps, state, show),
        }
    };
}

pub(crate) const SEMI_IMPLICIT_EULER: ByHand = by_hand!(semi_implicit_euler);
pub(crate) const VELOCITY_VERLET: ByHand = by_hand!(velocity_verlet);
pub(crate) const RK4: ByHand = by_hand!(rk4);

fn show(row: &mut [f64]) {
    black_box(row);
}

/// Each spring as the book has it: what it pulls for its stretch and its stretching.
fn textbook(values: &[f64]) -> impl Fn(&[f64], &[f64], &mut [f64]) {
    let (mass, stiffness, damping) = (values[1], values[2], values[3]);
    move |q, v, a| {
        let last = q.len() - 1;
        let pull = |dq: f64, dv: f64| stiffness * dq + damping * dv;
        for i in 1..last {
            let left = pull(q[i - 1] - q[i], v[i - 1] - v[i]);
            let right = pull(q[i + 1] - q[i], v[i + 1] - v[i]);
            a[i] = (left + right) / mass;
        }
        a[0] = (pull(-q[0], -v[0]) + pull(q[1] - q[0], v[1] - v[0])) / mass;
        let inner = pull(q[last - 1] - q[last], v[last - 1] - v[last]);
        a[last] = (inner + pull(-q[last], -v[last])) / mass;
    }
}

/// What a mass gives to either side, computed once for both.
fn bare(values: &[f64]) -> impl Fn(&[f64], &[f64], &mut [f64]) {
    let (k, c) = (values[2] / values[1], values[3] / values[1]);
    move |q, v, a| {
        let last = q.len() - 1;
        let mut left = 0.0;
        let mut here = k * q[0] + c * v[0];
        for ((a, q), v) in a.iter_mut().zip(&q[1..]).zip(&v[1..]) {
            let right = k * q + c * v;
            *a = left - 2.0 * here + right;
            (left, here) = (here, right);
        }
        a[last] = left - 2.0 * here;
    }
}

#[inline(always)]
fn semi_implicit_euler(
    acceleration: impl Fn(&[f64], &[f64], &mut [f64]),
    h: f64,
    [ticks, substeps]: [u32; 2],
    state: &mut [f64],
    show: impl Fn(&mut [f64]),
) {
    let (q, v) = state.split_at_mut(state.len() / 2);
    let mut a = vec![0.0; q.len()];
    for _ in 0..ticks {
        for _ in 0..substeps {
            acceleration(q, v, &mut a);
            for ((q, v), a) in q.iter_mut().zip(&mut *v).zip(&a) {
                *v += h * a;
                *q += h * *v;
            }
        }
        show(q);
    }
}

#[inline(always)]
fn velocity_verlet(
    acceleration: impl Fn(&[f64], &[f64], &mut [f64]),
    h: f64,
    [ticks, substeps]: [u32; 2],
    state: &mut [f64],
    show: impl Fn(&mut [f64]),
) {
    let (q, v) = state.split_at_mut(state.len() / 2);
    let (mut a, mut v_end) = (vec![0.0; q.len()], vec![0.0; q.len()]);
    acceleration(q, v, &mut a);
    let half = h / 2.0;
    for _ in 0..ticks {
        for _ in 0..substeps {
            for (((q, v), v_end), a) in q.iter_mut().zip(&mut *v).zip(&mut v_end).zip(&a) {
                *v += half * a;
                *q += h * *v;
                *v_end = *v + half * a;
            }
            acceleration(q, &v_end, &mut a);
            for (v, a) in v.iter_mut().zip(&a) {
                *v += half * a;
            }
        }
        show(q);
    }
}

#[inline(always)]
fn rk4(
    acceleration: impl Fn(&[f64], &[f64], &mut [f64]),
    h: f64,
    [ticks, substeps]: [u32; 2],
    state: &mut [f64],
    show: impl Fn(&mut [f64]),
) {
    let n = state.len() / 2;
    let (q, v) = state.split_at_mut(n);
    let [mut a1, mut a2, mut a3, mut a4] = [(); 4].map(|()| vec![0.0; n]);
    let [mut v2, mut v3, mut v4, mut at] = [(); 4].map(|()| vec![0.0; n]);
    let (half, third, sixth) = (h / 2.0, h / 3.0, h / 6.0);
    let reach = |from: &[f64], h: f64, slope: &[f64], to: &mut [f64]| {
        for ((to, from), slope) in to.iter_mut().zip(from).zip(slope) {
            *to = from + h * slope;
        }
    };
    let sum = |y: &mut [f64], k1: &[f64], k2: &[f64], k3: &[f64], k4: &[f64]| {
        for ((((y, k1), k2), k3), k4) in y.iter_mut().zip(k1).zip(k2).zip(k3).zip(k4) {
            *y = *y + sixth * k1 + third * k2 + third * k3 + sixth * k4;
        }
    };
    for _ in 0..ticks {
        for _ in 0..substeps {
            acceleration(q, v, &mut a1);

            reach(q, half, v, &mut at);
            reach(v, half, &a1, &mut v2);
            acceleration(&at, &v2, &mut a2);

            reach(q, half, &v2, &mut at);
            reach(v, half, &a2, &mut v3);
            acceleration(&at, &v3, &mut a3);

            reach(q, h, &v3, &mut at);
            reach(v, h, &a3, &mut v4);
            acceleration(&at, &v4, &mut a4);

            sum(q, v, &v2, &v3, &v4);
            sum(v, &a1, &a2, &a3, &a4);
        }
        show(q);
    }
}
