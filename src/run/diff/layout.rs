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
        column: String,
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
    /// A column that was asked for is not there.
    #[error("{side} has no column {column:?}; it has {here}")]
    NoSuchColumn {
        /// `a` or `b`, or both.
        side: &'static str,
        /// The column.
        column: String,
        /// The columns that are there.
        here: String,
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
    #[error("row {row} of {side}: column {column:?} has {cell:?}; write {}", wanted(*is_ticks))]
    NoOrder {
        /// `a` or `b`.
        side: &'static str,
        /// The row's place, from 1, after the header.
        row: u64,
        /// The column.
        column: String,
        /// Whether it counts ticks.
        is_ticks: bool,
        /// What stands there.
        cell: String,
    },
}

fn wanted(is_ticks: bool) -> &'static str {
    if is_ticks { "a whole number of 0 or more" } else { "a number" }
}

/// Which columns say what, where their names do not. A name that is asked for must be in both tables, or in one if it is to be
/// ignored.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Chosen {
    /// The columns by which rows are told apart, in place of `tick`, `lane`, `body` and `coordinate`. The first that is called
    /// `tick`, `frame` or `step` counts ticks.
    pub key: Vec<String>,
    /// The column that counts ticks, in place of `tick`.
    pub tick: Option<String>,
    /// The columns of values that are compared; all, if there are none.
    pub columns: Vec<String>,
    /// Columns that are not compared.
    pub ignored: Vec<String>,
}

/// What sides are called.
const SIDES: [&str; 2] = ["a", "b"];
/// The last tick whose number is sure to the last digit.
const MAX_TICK: f64 = 9_007_199_254_740_992.0;
/// The columns of a row's name, beside its tick.
pub(super) const NAMES: [&str; 3] = ["lane", "body", "coordinate"];
/// What a column of a key is called that counts ticks.
const TICKS: [&str; 3] = ["tick", "frame", "step"];
/// The column of a coordinate beside which others do not say how far it moves.
const COORDINATE: &str = "q";

/// By what rows are in order.
enum Order {
    /// This column of both: of ticks, or of times where there are no ticks.
    By { column: String, is_ticks: bool, at: [usize; 2] },
    /// The place in the table.
    Place,
    /// Nothing: rows belong together by their key alone.
    Key,
}

/// A column of values.
pub(super) struct ValueColumn {
    pub(super) name: String,
    pub(super) at: [usize; 2],
    /// When it says that something moves.
    pub(super) moves: Moves,
}

/// A column by which rows are told apart, beside their order.
pub(super) struct Key {
    pub(super) name: String,
    pub(super) at: [usize; 2],
}

/// Where the columns of both are.
pub(super) struct Layout {
    order: Order,
    /// The time in seconds, on the first side.
    t: Option<usize>,
    pub(super) keys: Vec<Key>,
    pub(super) values: Vec<ValueColumn>,
    /// The columns that only one has.
    pub(super) alone: [Vec<String>; 2],
    /// The side and the place of the first of them.
    pub(super) first_alone: Option<(usize, usize)>,
}

impl Layout {
    pub(super) fn of(headers: [&ByteRecord; 2], chosen: &Chosen) -> Result<Self, NotComparable> {
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
        let absent = |side: usize, column: &str| NotComparable::NoSuchColumn {
            side: SIDES[side],
            column: column.to_owned(),
            here: names[side].join(", "),
        };
        let asked = |column: &String| match find(column) {
            [Some(a), Some(b)] => Ok([a, b]),
            [a, _] => Err(absent(usize::from(a.is_some()), column)),
        };
        let common = |column: &str| match find(column) {
            [Some(a), Some(b)] => Ok(Some([a, b])),
            [None, None] => Ok(None),
            [a, _] => {
                let with = usize::from(a.is_none());
                Err(NotComparable::OtherRows {
                    column: column.to_owned(),
                    with: SIDES[with],
                    without: SIDES[1 - with],
                })
            }
        };
        let Chosen { key, tick, columns, ignored } = chosen;
        if let Some(column) = ignored.iter().find(|name| find(name) == [None, None]) {
            return Err(absent(0, column));
        }
        let t = common("t").ok().flatten();
        let in_key = key.iter().find(|name| TICKS.iter().any(|it| name.eq_ignore_ascii_case(it)));
        let order = match (tick.as_ref().or(in_key), key.is_empty()) {
            (Some(name), _) => Order::By { column: name.clone(), is_ticks: true, at: asked(name)? },
            (None, false) => Order::Key,
            (None, true) => match (common("tick"), t) {
                (Ok(Some(at)), _) => Order::By { column: "tick".into(), is_ticks: true, at },
                (_, Some(at)) => Order::By { column: "t".into(), is_ticks: false, at },
                (Ok(None), None) => Order::Place,
                (Err(error), None) => return Err(error),
            },
        };
        let is_order = |name: &str| matches!(&order, Order::By { column, .. } if column == name);
        let keys: Vec<Key> = match key.is_empty() {
            true => {
                let named = NAMES.into_iter().filter(|name| !is_order(name));
                let keys = named.map(|name| {
                    let at = common(name)?;
                    Ok(at.map(|at| Key { name: name.to_owned(), at }))
                });
                keys.filter_map(Result::transpose).collect::<Result<_, _>>()?
            }
            false => {
                let own = key.iter().filter(|name| !is_order(name));
                own.map(|name| Ok(Key { name: name.clone(), at: asked(name)? }))
                    .collect::<Result<_, _>>()?
            }
        };
        columns.iter().try_for_each(|name| asked(name).map(|_| ()))?;
        let is_value = |name: &str| {
            let says_which = is_order(name) || keys.iter().any(|key| key.name == name);
            let is_told = key.is_empty() && name == "tick" || name == "t" || name == "method";
            let is_asked = |name: &str| columns.iter().any(|asked| asked == name);
            match columns.is_empty() {
                true => !says_which && !is_told && !ignored.iter().any(|it| it == name),
                false => is_asked(name) && !says_which,
            }
        };
        let has_coordinate = matches!(find(COORDINATE), [Some(_), Some(_)]) && is_value(COORDINATE);
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
        let t = t.map(|[a, _]| a);
        Ok(Self { order, t, keys, values, alone, first_alone })
    }

    /// Where a row belongs, as bits that are in order.
    pub(super) fn order(
        &self,
        side: usize,
        row: &ByteRecord,
        place: u64,
    ) -> Result<u64, NotComparable> {
        let (column, is_ticks, at) = match &self.order {
            Order::By { column, is_ticks, at } => (column, *is_ticks, at),
            Order::Place => return Ok(place),
            Order::Key => return Ok(0),
        };
        let cell = &row[at[side]];
        let fits = |x: &f64| match is_ticks {
            true => (0.0..=MAX_TICK).contains(x) && *x == libm::floor(*x),
            false => !x.is_nan(),
        };
        let bits = parsed(cell).filter(fits).map(|x| (x + 0.0).to_bits());
        // The bits of numbers of one sign are in their order, and negative ones before them.
        let ordered = bits.map(|bits| if bits >> 63 == 0 { bits | 1 << 63 } else { !bits });
        ordered.ok_or_else(|| NotComparable::NoOrder {
            side: SIDES[side],
            row: place + 1,
            column: column.clone(),
            is_ticks,
            cell: String::from_utf8_lossy(cell).into_owned(),
        })
    }

    /// The tick of a row, or the row's place in a table without ticks.
    pub(super) fn tick(&self, order: u64, place: u64) -> u64 {
        match self.order {
            Order::By { is_ticks: true, .. } => f64::from_bits(order & (u64::MAX >> 1)) as u64,
            _ => place,
        }
    }

    /// What a tick is called, where rows have some: the column's name, or `tick` for the place of a row.
    pub(super) fn tick_name(&self) -> Option<&str> {
        match &self.order {
            Order::By { column, is_ticks: true, .. } => Some(column),
            Order::Key => None,
            _ => Some("tick"),
        }
    }

    /// Whether rows belong together by their place.
    pub(super) fn is_by_place(&self) -> bool {
        matches!(self.order, Order::Place)
    }

    /// Whether rows have an order, in which something can move.
    pub(super) fn has_order(&self) -> bool {
        !matches!(self.order, Order::Key)
    }

    /// The tick or the time of a row, or its place, which a clock goes with.
    pub(super) fn place(&self, order: u64, place: u64) -> f64 {
        match self.order {
            Order::By { .. } if order >> 63 == 0 => f64::from_bits(!order),
            Order::By { .. } => f64::from_bits(order & (u64::MAX >> 1)),
            Order::Place | Order::Key => place as f64,
        }
    }

    /// The time of a row of the first side, in seconds.
    pub(super) fn time(&self, row: &ByteRecord) -> Option<f64> {
        parsed(&row[self.t?])
    }
}
