//! Numbers, states of one coordinate, and the matrices between them.

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Number(f64),
    /// Position and velocity.
    Pair([f64; 2]),
    Matrix([[f64; 2]; 2]),
}

use Value::{Matrix, Number, Pair};

/// A number is as many times the unit matrix.
fn matrix(value: &Value) -> [[f64; 2]; 2] {
    match value {
        Number(x) => [[*x, 0.0], [0.0, *x]],
        Matrix(m) => *m,
        Pair(_) => panic!("a state is no matrix"),
    }
}

fn pair(value: &Value) -> [f64; 2] {
    match value {
        Number(x) => [*x; 2],
        Pair(y) => *y,
        Matrix(_) => panic!("a matrix is no state"),
    }
}

impl Value {
    pub(crate) fn number(&self) -> f64 {
        match self {
            Number(x) => *x,
            _ => f64::NAN,
        }
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        match (self, other) {
            (Number(a), Number(b)) => Number(a - b),
            (Pair(_), _) | (_, Pair(_)) => {
                let (a, b) = (pair(self), pair(other));
                Pair([a[0] - b[0], a[1] - b[1]])
            }
            _ => {
                let (a, b) = (matrix(self), matrix(other));
                Matrix([0, 1].map(|i| [0, 1].map(|j| a[i][j] - b[i][j])))
            }
        }
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        match (self, other) {
            (Number(a), Number(b)) => Number(a * b),
            (Number(a), Pair(y)) | (Pair(y), Number(a)) => Pair(y.map(|y| a * y)),
            (_, Pair(y)) => Pair(matrix(self).map(|row| row[0] * y[0] + row[1] * y[1])),
            _ => {
                let (a, b) = (matrix(self), matrix(other));
                Matrix([0, 1].map(|i| [0, 1].map(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j])))
            }
        }
    }

    pub(crate) fn over(&self, other: &Self) -> Self {
        match (self, other) {
            (Number(a), Number(b)) => Number(a / b),
            (Pair(y), Number(b)) => Pair(y.map(|y| y / b)),
            _ => {
                let [[a, b], [c, d]] = matrix(other);
                let determinant = a * d - b * c;
                self.times(&Matrix([[d, -b], [-c, a]].map(|row| row.map(|x| x / determinant))))
            }
        }
    }

    pub(crate) fn abs(&self) -> Self {
        match self {
            Number(x) => Number(x.abs()),
            Pair(y) => Pair(y.map(f64::abs)),
            Matrix(_) => panic!("a matrix has no amount here"),
        }
    }

    pub(crate) fn exp(&self) -> Self {
        if let Number(x) = self {
            return Number(x.exp());
        }
        let (mut term, mut sum) = (Number(1.0), Number(0.0));
        for k in 1..40 {
            sum = sum.minus(&Number(-1.0).times(&term));
            term = term.times(self).over(&Number(f64::from(k)));
        }
        sum
    }

    /// The largest component; NaN if one is.
    pub(crate) fn largest(&self) -> f64 {
        let all = match self {
            Number(x) => vec![*x],
            Pair(y) => y.to_vec(),
            Matrix(m) => m.concat(),
        };
        all.into_iter().fold(0.0, |most, x| if x.abs() <= most { most } else { x.abs() })
    }
}
