//! The switches of a tape: operations that are smooth only piece by piece, and the mode of each.

use super::jet::{Jet, chain, constant};
use crate::sim::curve::{Curve, above, below};

/// An operation on `a` and `b` that is smooth only piece by piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Switch {
    pub(super) pieces: Pieces,
    pub(super) value: Value,
}

/// The rule for the mode, given the operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Pieces {
    /// 1 if a ≥ 0, else 0.
    NotNegative,
    /// 1 if a < b, else 0.
    Less,
    /// 1 if a ≤ b, else 0.
    LessEqual,
    /// 1 if a > b, else 0.
    Greater,
    /// The sign of a: -1, 0 or 1.
    Sign,
    /// The sign of a - b: -1, 0 or 1.
    Order,
    /// The largest whole number up to a.
    Floor,
    /// The piece of a curve at a.
    Table,
}

/// The value in each mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Value {
    /// The mode as a number.
    Mode,
    /// The mode as true or false.
    Truth,
    /// Whether the mode is 0.
    Equal,
    /// Whether the mode is not 0.
    NotEqual,
    /// a in mode 1, else -a.
    Magnitude,
    /// a in mode 1, else b.
    Choice,
    /// The value of the curve's piece.
    Table,
}

impl Switch {
    /// The switch of `table(x, …)`.
    pub(super) const TABLE: Self = Self { pieces: Pieces::Table, value: Value::Table };

    /// Whether the value is a truth value, rather than a number.
    pub(super) fn is_truth(self) -> bool {
        match self.value {
            Value::Truth | Value::Equal | Value::NotEqual => true,
            Value::Mode | Value::Magnitude | Value::Choice | Value::Table => false,
        }
    }

    /// The mode at these operands.
    #[inline]
    pub(super) fn mode(self, a: f64, b: f64, table: Option<&Curve>) -> i64 {
        match self.pieces {
            Pieces::NotNegative => i64::from(a >= 0.0),
            Pieces::Less => i64::from(a < b),
            Pieces::LessEqual => i64::from(a <= b),
            Pieces::Greater => i64::from(a > b),
            Pieces::Sign => i64::from(a > 0.0) - i64::from(a < 0.0),
            Pieces::Order => i64::from(a > b) - i64::from(a < b),
            // It saturates at magnitudes where no number has a fraction.
            Pieces::Floor => libm::floor(a) as i64,
            Pieces::Table => table.map_or(0, |table| table.piece(a)),
        }
    }

    /// The value at these operands.
    #[inline]
    pub(super) fn value(self, a: f64, b: f64, table: Option<&Curve>) -> f64 {
        match self.pieces {
            Pieces::Floor => libm::floor(a),
            // No mode distinguishes a NaN, which equals nothing.
            Pieces::Order if self.value == Value::Equal => f64::from(u8::from(a == b)),
            Pieces::Order if self.value == Value::NotEqual => f64::from(u8::from(a != b)),
            _ => self.value_on(self.mode(a, b, table), a, b, table),
        }
    }

    /// The value in a mode, continued smoothly beyond the boundaries of the mode.
    #[inline]
    pub(super) fn value_on(self, mode: i64, a: f64, b: f64, table: Option<&Curve>) -> f64 {
        match self.value {
            Value::Mode | Value::Truth => mode as f64,
            Value::Equal => f64::from(u8::from(mode == 0)),
            Value::NotEqual => f64::from(u8::from(mode != 0)),
            // Adding 0 removes the sign of a negative zero.
            Value::Magnitude if mode == 1 => a + 0.0,
            Value::Magnitude => -a,
            Value::Choice if mode == 1 => a,
            Value::Choice => b,
            Value::Table => table.map_or(f64::NAN, |table| table.on(mode, a)),
        }
    }

    /// The value with its derivatives at these operands.
    pub(super) fn jet(self, [a, b]: [Jet; 2], table: Option<&Curve>) -> Jet {
        let mode = self.mode(a[0], b[0], table);
        let value = self.value_on(mode, a[0], b[0], table);
        match self.value {
            Value::Mode | Value::Truth | Value::Equal | Value::NotEqual => constant(value),
            Value::Magnitude if mode == 1 => a,
            Value::Magnitude => a.map(|x| -x),
            Value::Choice if mode == 1 => a,
            Value::Choice => b,
            Value::Table => chain(a, [value, table.map_or(0.0, |table| table.slope(mode)), 0.0]),
        }
    }

    /// Signed distances to the lower and the upper boundary of a mode; negative beyond them.
    pub(super) fn distances(self, mode: i64, a: f64, b: f64, table: Option<&Curve>) -> [f64; 2] {
        let one_boundary = |value: f64, end: f64| match mode {
            1 => [above(value, end), f64::INFINITY],
            _ => [f64::INFINITY, below(value, end)],
        };
        let point = |end: f64| match mode {
            -1 => [f64::INFINITY, below(a, end)],
            1 => [above(a, end), f64::INFINITY],
            _ => [above(a, end), below(a, end)],
        };
        match self.pieces {
            Pieces::NotNegative => one_boundary(a, 0.0),
            Pieces::Less | Pieces::LessEqual => one_boundary(b, a),
            Pieces::Greater => one_boundary(a, b),
            Pieces::Sign => point(0.0),
            Pieces::Order => point(b),
            Pieces::Floor => [above(a, mode as f64), below(a, mode as f64 + 1.0)],
            Pieces::Table => table.map_or([f64::INFINITY; 2], |table| table.distances(mode, a)),
        }
    }

    /// The mode beyond the lower (`side` 0) or the upper (1) boundary of a mode.
    pub(super) fn neighbour(self, mode: i64, side: usize) -> i64 {
        let beyond = 2 * side as i64 - 1;
        match self.pieces {
            // Equality lasts for no time, unless the motion starts in it.
            Pieces::Sign | Pieces::Order => beyond,
            Pieces::NotNegative | Pieces::Less | Pieces::LessEqual | Pieces::Greater => {
                mode + beyond
            }
            Pieces::Floor | Pieces::Table => mode + beyond,
        }
    }
}
