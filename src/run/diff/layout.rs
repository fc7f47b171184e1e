//! Which columns of two tables say which row it is, and which are compared.

use std::collections::HashMap;

use csv::ByteRecord;

use super::clock::Moves;
use super::number::parsed;
use crate::sim::number::counted;

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
    /// The rows have too many names.
    #[error(
        "the rows have more than {names} names by lane, body and coordinate, too many to keep with {}; compare fewer bodies or columns at a time",
        counted(*columns, "column")
    )]
    TooManyNames {
        /// How many there were.
        names: usize,
        /// The columns of values.
        columns: usize,
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
    /// When it says that something moves.
    pub(super) moves: Moves,
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
        let mut places: [HashMap<&str, usize>; 2] = Default::default();
        for (side, places) in places.iter_mut().enumerate() {
            for (i, name) in names[side].iter().enumerate() {
                if places.insert(name, i).is_some() {
                    let (side, column) = (SIDES[side], name.clone());
                    return Err(NotComparable::Twice { side, column });
                }
            }
        }
        let find = |name: &str| [0, 1].map(|side| places[side].get(name).copied());
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
        let own = names[0].iter().enumerate().filter(|(_, name)| is_value(name));
        let both: Vec<(&String, [usize; 2])> =
            own.filter_map(|(a, name)| Some((name, [a, find(name)[1]?]))).collect();
        let moves = |name: &str| match (has_coordinate, name == COORDINATE) {
            (true, true) => Moves::Always,
            (true, false) => Moves::Never,
            (false, _) => Moves::of_name(name, both.len() == 1),
        };
        let column = |(name, at): &(&String, _)| ValueColumn {
            name: (*name).clone(),
            at: *at,
            moves: moves(name),
        };
        let values: Vec<ValueColumn> = both.iter().map(column).collect();
        if values.is_empty() {
            let [a, b] = [0, 1].map(|side| names[side].join(", "));
            return Err(NotComparable::NoColumn { a, b });
        }
        let alone = [0, 1].map(|side| -> Vec<String> {
            let alone = names[side].iter().filter(|name| find(name)[1 - side].is_none());
            alone.filter(|name| is_value(name)).cloned().collect()
        });
        let first_alone =
            [0, 1].into_iter().find_map(|side| Some((side, find(alone[side].first()?)[side]?)));
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

    /// The tick or the time of a row, or its place, which a clock goes with.
    pub(super) fn place(&self, order: u64, place: u64) -> f64 {
        match self.order {
            Order::By { .. } if order >> 63 == 0 => f64::from_bits(!order),
            Order::By { .. } => f64::from_bits(order & (u64::MAX >> 1)),
            Order::Place => place as f64,
        }
    }

    /// The time of a row of the first side, in seconds.
    pub(super) fn time(&self, row: &ByteRecord) -> Option<f64> {
        parsed(&row[self.t?])
    }
}
