//! The switches of a tape, which are operations that are smooth only piece by piece, and the mode of each.

use super::jet::{Jet, chain, constant};
use crate::curve::{Curve, above, below};

/// An operation on `a` and `b` that is smooth only piece by piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Switch {
    pub(super) pieces: ModeRule,
    pub(super) value: SwitchValue,
}

/// The rule for the mode, given the operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ModeRule {
    /// 1 if a ≥ 0, else 0.
    NotNegative,
    /// 1 if a < b, else 0.
    Less,
    /// 1 if a ≤ b, else 0.
    LessEqual,
    /// 1 if a > b, else 0.
    Greater,
    /// The sign of a, which is -1, 0 or 1.
    Sign,
    /// The sign of a - b, which is -1, 0 or 1.
    Order,
    /// The largest whole number up to a.
    Floor,
    /// The piece of a curve at a.
    Table,
}

/// The value in each mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum SwitchValue {
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
    pub(super) const TABLE: Self = Self { pieces: ModeRule::Table, value: SwitchValue::Table };

    /// Whether the value is a truth value, rather than a number.
    pub(super) fn is_truth(self) -> bool {
        match self.value {
            SwitchValue::Truth | SwitchValue::Equal | SwitchValue::NotEqual => true,
            SwitchValue::Mode
            | SwitchValue::Magnitude
            | SwitchValue::Choice
            | SwitchValue::Table => false,
        }
    }

    /// Returns the mode at these operands.
    #[inline]
    pub(super) fn mode(self, a: f64, b: f64, table: Option<&Curve>) -> i64 {
        match self.pieces {
            ModeRule::NotNegative => i64::from(a >= 0.0),
            ModeRule::Less => i64::from(a < b),
            ModeRule::LessEqual => i64::from(a <= b),
            ModeRule::Greater => i64::from(a > b),
            ModeRule::Sign => i64::from(a > 0.0) - i64::from(a < 0.0),
            ModeRule::Order => i64::from(a > b) - i64::from(a < b),
            // The conversion saturates at magnitudes where no number has a fraction.
            ModeRule::Floor => libm::floor(a) as i64,
            ModeRule::Table => table.map_or(0, |table| table.piece(a)),
        }
    }

    /// Returns the value at these operands.
    #[inline]
    pub(super) fn value(self, a: f64, b: f64, table: Option<&Curve>) -> f64 {
        match self.pieces {
            ModeRule::Floor => libm::floor(a),
            // The mode does not show a NaN, which equals nothing.
            ModeRule::Order if self.value == SwitchValue::Equal => f64::from(u8::from(a == b)),
            ModeRule::Order if self.value == SwitchValue::NotEqual => f64::from(u8::from(a != b)),
            _ => self.value_on(self.mode(a, b, table), a, b, table),
        }
    }

    /// Returns the value in a mode, continued smoothly beyond the boundaries of the mode.
    #[inline]
    pub(super) fn value_on(self, mode: i64, a: f64, b: f64, table: Option<&Curve>) -> f64 {
        match self.value {
            SwitchValue::Mode | SwitchValue::Truth => mode as f64,
            SwitchValue::Equal => f64::from(u8::from(mode == 0)),
            SwitchValue::NotEqual => f64::from(u8::from(mode != 0)),
            // Adding 0 removes the sign of a negative zero.
            SwitchValue::Magnitude if mode == 1 => a + 0.0,
            SwitchValue::Magnitude => -a,
            SwitchValue::Choice if mode == 1 => a,
            SwitchValue::Choice => b,
            SwitchValue::Table => table.map_or(f64::NAN, |table| table.on(mode, a)),
        }
    }

    /// Returns the value with its derivatives at these operands.
    pub(super) fn jet(self, [a, b]: [Jet; 2], table: Option<&Curve>) -> Jet {
        self.jet_on(self.mode(a[0], b[0], table), [a, b], table)
    }

    /// Returns the value with its derivatives in a mode.
    pub(super) fn jet_on(self, mode: i64, [a, b]: [Jet; 2], table: Option<&Curve>) -> Jet {
        let value = self.value_on(mode, a[0], b[0], table);
        match self.value {
            SwitchValue::Mode | SwitchValue::Truth | SwitchValue::Equal | SwitchValue::NotEqual => {
                constant(value)
            }
            SwitchValue::Magnitude if mode == 1 => a,
            SwitchValue::Magnitude => a.map(|x| -x),
            SwitchValue::Choice if mode == 1 => a,
            SwitchValue::Choice => b,
            SwitchValue::Table => {
                chain(a, [value, table.map_or(0.0, |table| table.slope(mode)), 0.0])
            }
        }
    }

    /// Returns the signed distances to the lower and the upper boundary of a mode. A distance is negative beyond its
    /// boundary.
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
            ModeRule::NotNegative => one_boundary(a, 0.0),
            ModeRule::Less | ModeRule::LessEqual => one_boundary(b, a),
            ModeRule::Greater => one_boundary(a, b),
            ModeRule::Sign => point(0.0),
            ModeRule::Order => point(b),
            ModeRule::Floor => [above(a, mode as f64), below(a, mode as f64 + 1.0)],
            ModeRule::Table => table.map_or([f64::INFINITY; 2], |table| table.distances(mode, a)),
        }
    }

    /// Returns the mode beyond the lower boundary (`side` 0) or the upper boundary (`side` 1) of a mode.
    pub(super) fn neighbour(self, mode: i64, side: usize) -> i64 {
        let beyond = 2 * side as i64 - 1;
        match self.pieces {
            // Equality lasts for no time, unless the motion starts with it.
            ModeRule::Sign | ModeRule::Order => beyond,
            ModeRule::NotNegative | ModeRule::Less | ModeRule::LessEqual | ModeRule::Greater => {
                mode + beyond
            }
            ModeRule::Floor | ModeRule::Table => mode + beyond,
        }
    }
}
