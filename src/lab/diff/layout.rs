//! Which columns of two tables say which row it is, and which are compared.

use csv::ByteRecord;

use super::number::parsed;

/// Why two tables cannot be compared row by row.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotComparable {
    /// One has a column by which rows are told apart.
    #[error("{with} has a column {column:?} and {without} has none; give both, or neither")]
    OtherRows {
        /// The column.
        column: &'static str,
        /// The side that has it: `a` or `b`.
        with: &'static str,
        /// The other side.
        without: &'static str,
    },
    /// No column of values has the same name in both.
    #[error("no column of values is in both; a has {a}, b has {b}")]
    NoColumn {
        /// Those of one.
        a: String,
        /// Those of the other.
        b: String,
    },
    /// Two columns of one have the same name.
    #[error("{side} has two columns {column:?}; rename one")]
    Twice {
        /// `a` or `b`.
        side: &'static str,
        /// The column.
        column: String,
    },
    /// A tick is no whole number, or a time is no number.
    #[error("row {row} of {side}: column {column:?} has {cell:?}; write {}", wanted(column))]
    NoOrder {
        /// `a` or `b`.
        side: &'static str,
        /// The row's place, from 1, after the header.
        row: u64,
        /// The column.
        column: &'static str,
        /// What stands there.
        cell: String,
    },
}

fn wanted(column: &str) -> &'static str {
    if column == "tick" { "a whole number of 0 or more" } else { "a number" }
}

/// What sides are called.
const SIDES: [&str; 2] = ["a", "b"];
/// The last tick whose number is sure to the last digit.
const MAX_TICK: f64 = 9_007_199_254_740_992.0;
/// The columns of a row's name, beside its tick.
const NAMES: [&str; 3] = ["lane", "body", "coordinate"];
/// The column of a coordinate beside which others do not say how far it moves.
const COORDINATE: &str = "q";

/// Columns that count on, in whatever unit, while nothing moves.
const CLOCKS: [&str; 9] =
    ["frame", "frames", "index", "ms", "seconds", "step", "time", "time_s", "timestamp"];

/// By what rows are in order.
pub(super) enum Order {
    /// These columns of both: `tick`, or `t` where there are no ticks.
    By { column: &'static str, at: [usize; 2] },
    /// The place in the table.
    Place,
}

/// A column of values.
pub(super) struct ValueColumn {
    pub(super) name: String,
    pub(super) at: [usize; 2],
    /// Whether it says how far a coordinate has moved.
    pub(super) moves: bool,
}

/// Where the columns of both are.
pub(super) struct Layout {
    order: Order,
    /// The time in seconds, on the first side.
    t: Option<usize>,
    pub(super) keys: Vec<[usize; 2]>,
    /// Where the first side has [`NAMES`].
    pub(super) named: [Option<usize>; 3],
    pub(super) values: Vec<ValueColumn>,
    /// The columns that only one has.
    pub(super) alone: [Vec<String>; 2],
    /// The side and the place of the first of them.
    pub(super) first_alone: Option<(usize, usize)>,
}

impl Layout {
    pub(super) fn of(headers: [&ByteRecord; 2]) -> Result<Self, NotComparable> {
        let names = headers.map(|header| -> Vec<String> {
            header.iter().map(|cell| String::from_utf8_lossy(cell).trim().to_owned()).collect()
        });
        for (side, names) in SIDES.into_iter().zip(&names) {
            let twice = names.iter().enumerate().find(|(i, name)| names[..*i].contains(name));
            if let Some((_, column)) = twice {
                return Err(NotComparable::Twice { side, column: column.clone() });
            }
        }
        let find = |name: &str| [0, 1].map(|side| names[side].iter().position(|it| it == name));
        let common = |column: &'static str| match find(column) {
            [Some(a), Some(b)] => Ok(Some([a, b])),
            [None, None] => Ok(None),
            [a, _] => {
                let with = usize::from(a.is_none());
                Err(NotComparable::OtherRows {
                    column,
                    with: SIDES[with],
                    without: SIDES[1 - with],
                })
            }
        };
        let t = common("t").ok().flatten();
        let order = match (common("tick"), t) {
            (Ok(Some(at)), _) => Order::By { column: "tick", at },
            (_, Some(at)) => Order::By { column: "t", at },
            (Ok(None), None) => Order::Place,
            (Err(error), None) => return Err(error),
        };
        let keys = NAMES.map(common);
        let keys: Vec<_> = keys.into_iter().collect::<Result<Vec<_>, _>>()?;
        let is_value =
            |name: &str| !["tick", "t", "method"].contains(&name) && !NAMES.contains(&name);
        let has_coordinate = matches!(find(COORDINATE), [Some(_), Some(_)]);
        let mut values = Vec::new();
        for (a, name) in names[0].iter().enumerate().filter(|(_, name)| is_value(name)) {
            if let [_, Some(b)] = find(name) {
                let is_clock = CLOCKS.contains(&&*name.to_ascii_lowercase());
                let moves = if has_coordinate { name == COORDINATE } else { !is_clock };
                values.push(ValueColumn { name: name.clone(), at: [a, b], moves });
            }
        }
        if values.is_empty() {
            let [a, b] = [0, 1].map(|side| names[side].join(", "));
            return Err(NotComparable::NoColumn { a, b });
        }
        let alone = [0, 1].map(|side| -> Vec<String> {
            let alone = names[side].iter().filter(|name| !names[1 - side].contains(name));
            alone.filter(|name| is_value(name)).cloned().collect()
        });
        let first_alone = [0, 1].into_iter().find_map(|side| {
            let name = alone[side].first()?;
            Some((side, names[side].iter().position(|it| it == name)?))
        });
        Ok(Self {
            order,
            t: t.map(|[a, _]| a),
            named: [0, 1, 2].map(|i| keys[i].map(|[a, _]| a)),
            keys: keys.into_iter().flatten().collect(),
            values,
            alone,
            first_alone,
        })
    }

    /// Where a row belongs, as bits that are in order.
    pub(super) fn order(
        &self,
        side: usize,
        row: &ByteRecord,
        place: u64,
    ) -> Result<u64, NotComparable> {
        let Order::By { column, at } = self.order else { return Ok(place) };
        let cell = &row[at[side]];
        let fits = |x: &f64| match column {
            "tick" => (0.0..=MAX_TICK).contains(x) && *x == libm::floor(*x),
            _ => !x.is_nan(),
        };
        let bits = parsed(cell).filter(fits).map(|x| (x + 0.0).to_bits());
        // The bits of numbers of one sign are in their order, and negative ones before them.
        let ordered = bits.map(|bits| if bits >> 63 == 0 { bits | 1 << 63 } else { !bits });
        ordered.ok_or_else(|| NotComparable::NoOrder {
            side: SIDES[side],
            row: place + 1,
            column,
            cell: String::from_utf8_lossy(cell).into_owned(),
        })
    }

    /// The tick of a row, or the row's place in a table without ticks.
    pub(super) fn tick(&self, order: u64, place: u64) -> u64 {
        match self.order {
            Order::By { column: "tick", .. } => f64::from_bits(order & (u64::MAX >> 1)) as u64,
            _ => place,
        }
    }

    /// The time of a row of the first side, in seconds.
    pub(super) fn time(&self, row: &ByteRecord) -> Option<f64> {
        parsed(&row[self.t?])
    }
}
