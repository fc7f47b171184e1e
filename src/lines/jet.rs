//! A value with its first and second derivative with respect to one variable. This forward differentiation is exact to
//! rounding.

/// A value, its derivative and its second derivative.
pub type Jet = [f64; 3];

pub(super) fn constant(value: f64) -> Jet {
    [value, 0.0, 0.0]
}

pub(super) fn sum(a: Jet, b: Jet) -> Jet {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn difference(a: Jet, b: Jet) -> Jet {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn product(a: Jet, b: Jet) -> Jet {
    [a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[2]]
}

pub(super) fn quotient(a: Jet, b: Jet) -> Jet {
    let value = a[0] / b[0];
    let slope = (a[1] - value * b[1]) / b[0];
    [value, slope, (a[2] - 2.0 * slope * b[1] - value * b[2]) / b[0]]
}

pub(super) fn root(a: Jet) -> Jet {
    let root = a[0].sqrt();
    let slope = a[1] / (2.0 * root);
    [root, slope, (a[2] - 2.0 * slope * slope) / (2.0 * root)]
}

pub(super) fn pow(a: Jet, b: Jet) -> Jet {
    let value = libm::pow(a[0], b[0]);
    if b[1] == 0.0 && b[2] == 0.0 {
        let (n, slope) = (b[0], b[0] * libm::pow(a[0], b[0] - 1.0));
        return chain(a, [value, slope, n * (n - 1.0) * libm::pow(a[0], n - 2.0)]);
    }
    let logarithm = chain(a, [libm::log(a[0]), 1.0 / a[0], -1.0 / (a[0] * a[0])]);
    let exponent = product(b, logarithm);
    chain(exponent, [value; 3])
}

/// Returns the jet of a function of `a`, given the value of the function and its first two derivatives there.
pub(super) fn chain(a: Jet, [value, slope, bend]: [f64; 3]) -> Jet {
    [value, slope * a[1], bend * a[1] * a[1] + slope * a[2]]
}
