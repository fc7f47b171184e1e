//! The switches of a tape: operations that are smooth only piece by piece, and the mode in which each
//! is.

use super::op::Op;
use super::table::Table;

/// Rounding of a value at a boundary, relative to the numbers that are compared.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The mode in which a switch is at these values: 0 or 1; the order of two values, -1, 0 or 1; a whole
/// number for `floor`; the piece of a table.
#[inline]
pub(super) fn mode(op: Op, a: f64, b: f64, table: Option<&Table>) -> i64 {
    match op {
        Op::Abs | Op::Step => i64::from(a >= 0.0),
        Op::Min | Op::Less => i64::from(a < b),
        Op::LessEqual => i64::from(a <= b),
        Op::Max => i64::from(a > b),
        Op::Sign => i64::from(a > 0.0) - i64::from(a < 0.0),
        Op::Equal | Op::NotEqual => i64::from(a > b) - i64::from(a < b),
        // It saturates where no number has a fraction.
        Op::Floor => libm::floor(a) as i64,
        Op::Table => table.map_or(0, |table| table.piece(a)),
        _ => 0,
    }
}

/// The value of a switch in a mode, continued smoothly beyond the boundaries of the mode.
#[inline]
pub(super) fn value(op: Op, mode: i64, a: f64, b: f64, table: Option<&Table>) -> f64 {
    match op {
        // Adding 0 takes the sign of a negative zero.
        Op::Abs if mode == 1 => a + 0.0,
        Op::Abs => -a,
        Op::Min | Op::Max if mode == 1 => a,
        Op::Min | Op::Max => b,
        Op::Equal => f64::from(u8::from(mode == 0)),
        Op::NotEqual => f64::from(u8::from(mode != 0)),
        Op::Table => table.map_or(f64::NAN, |table| table.on(mode, a)),
        _ => mode as f64,
    }
}

/// Signed distances to the lower and the upper boundary of a mode; negative beyond them.
pub(super) fn distances(op: Op, mode: i64, a: f64, b: f64, table: Option<&Table>) -> [f64; 2] {
    let to = |value: f64, end: f64| value - end + ROUNDING * (value.abs() + end.abs());
    let above = |value: f64, end: f64| to(-value, -end);
    let lower_higher = |value: f64, end: f64| match mode {
        1 => [to(value, end), f64::INFINITY],
        _ => [f64::INFINITY, above(value, end)],
    };
    match op {
        Op::Abs | Op::Step => lower_higher(a, 0.0),
        Op::Min | Op::Less | Op::LessEqual => lower_higher(b, a),
        Op::Max => lower_higher(a, b),
        Op::Sign | Op::Equal | Op::NotEqual => {
            let end = if op == Op::Sign { 0.0 } else { b };
            match mode {
                -1 => [f64::INFINITY, above(a, end)],
                1 => [to(a, end), f64::INFINITY],
                _ => [to(a, end), above(a, end)],
            }
        }
        Op::Floor => {
            let low = mode as f64;
            [to(a, low), above(a, low + 1.0)]
        }
        Op::Table => {
            let (low, high) = table.map_or((None, None), |table| table.ends(mode));
            let infinite = f64::INFINITY;
            [low.map_or(infinite, |[x, _]| to(a, x)), high.map_or(infinite, |[x, _]| above(a, x))]
        }
        _ => [f64::INFINITY; 2],
    }
}

/// The mode beyond the lower (`side` 0) or the upper (1) boundary of a mode.
pub(super) fn neighbour(op: Op, mode: i64, side: usize) -> i64 {
    match op {
        // A value is equal to another for no time, unless it starts so.
        Op::Sign | Op::Equal | Op::NotEqual => 2 * side as i64 - 1,
        _ => mode + 2 * side as i64 - 1,
    }
}
