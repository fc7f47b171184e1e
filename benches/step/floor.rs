//! The formulas by hand: one body, one method, local numbers, no interface.

/// The state after `n` steps of `h` from the start that `values`, in the order of the body's keys, say.
pub(crate) type Floor = fn(values: &[f64], h: f64, n: u32) -> [f64; 2];

/// The floor for this body and method, where there is one.
pub(crate) fn of(body: &str, method: &str) -> Option<Floor> {
    Some(match (body, method) {
        ("ship", "explicit-euler") => |values, h, n| explicit_euler(ship(values), values, h, n),
        ("ship", "semi-implicit-euler") => {
            |values, h, n| semi_implicit_euler(ship(values), values, h, n)
        }
        ("ship", "improved-euler") => |values, h, n| improved_euler(ship(values), values, h, n),
        ("ship", "rk4") => |values, h, n| rk4(ship(values), values, h, n),
        ("spring", "explicit-euler") => |values, h, n| explicit_euler(spring(values), values, h, n),
        ("spring", "semi-implicit-euler") => {
            |values, h, n| semi_implicit_euler(spring(values), values, h, n)
        }
        ("spring", "improved-euler") => |values, h, n| improved_euler(spring(values), values, h, n),
        ("spring", "rk4") => |values, h, n| rk4(spring(values), values, h, n),
        _ => return None,
    })
}

fn ship(values: &[f64]) -> impl Fn(f64, f64) -> f64 {
    let (thrust, drag, mass) = (values[0], values[1], values[2]);
    move |_s, v| (thrust - drag * v) / mass
}

fn spring(values: &[f64]) -> impl Fn(f64, f64) -> f64 {
    let (mass, stiffness, damping) = (values[0], values[1], values[2]);
    move |x, v| (-stiffness * x - damping * v) / mass
}

#[inline(always)]
fn explicit_euler(a: impl Fn(f64, f64) -> f64, values: &[f64], h: f64, n: u32) -> [f64; 2] {
    let (mut q, mut v) = (values[3], values[4]);
    for _ in 0..n {
        (q, v) = (q + h * v, v + h * a(q, v));
    }
    [q, v]
}

#[inline(always)]
fn semi_implicit_euler(a: impl Fn(f64, f64) -> f64, values: &[f64], h: f64, n: u32) -> [f64; 2] {
    let (mut q, mut v) = (values[3], values[4]);
    for _ in 0..n {
        v += h * a(q, v);
        q += h * v;
    }
    [q, v]
}

#[inline(always)]
fn improved_euler(a: impl Fn(f64, f64) -> f64, values: &[f64], h: f64, n: u32) -> [f64; 2] {
    let (mut q, mut v) = (values[3], values[4]);
    let half = h / 2.0;
    for _ in 0..n {
        let (q1, a1) = (v, a(q, v));
        let (q2, a2) = (v + h * a1, a(q + h * q1, v + h * a1));
        q = q + half * q1 + half * q2;
        v = v + half * a1 + half * a2;
    }
    [q, v]
}

#[inline(always)]
fn rk4(a: impl Fn(f64, f64) -> f64, values: &[f64], h: f64, n: u32) -> [f64; 2] {
    let (mut q, mut v) = (values[3], values[4]);
    let (half, third, sixth) = (h / 2.0, h / 3.0, h / 6.0);
    for _ in 0..n {
        let (q1, a1) = (v, a(q, v));
        let (q2, a2) = (v + half * a1, a(q + half * q1, v + half * a1));
        let (q3, a3) = (v + half * a2, a(q + half * q2, v + half * a2));
        let (q4, a4) = (v + h * a3, a(q + h * q3, v + h * a3));
        q = q + sixth * q1 + third * q2 + third * q3 + sixth * q4;
        v = v + sixth * a1 + third * a2 + third * a3 + sixth * a4;
    }
    [q, v]
}
