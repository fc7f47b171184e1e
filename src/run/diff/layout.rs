//! Decides which columns of two tables identify a row, and which are compared.

use std::collections::HashMap;

use csv::ByteRecord;

use super::clock::Moves;
use super::number::parsed;
use crate::sim::number::counted;

/// The reason why two tables cannot be compared row by row.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotComparable {
    /// Only one table has this key column.
    #[error("{with} has a column {column:?} and {without} has none; give both, or neither")]
    OtherRows {
        /// Name of the column.
        column: String,
        /// Side that has the column: `a` or `b`.
        with: &'static str,
        /// Side that lacks the column.
        without: &'static str,
    },
    /// The tables share no value column.
    #[error("no column of values is in both; a has {a}, b has {b}")]
    NoColumn {
        /// Columns of `a`.
        a: String,
        /// Columns of `b`.
        b: String,
    },
    /// A requested column is missing.
    #[error("{side} has no column {column:?}; it has {here}")]
    NoSuchColumn {
        /// Side that lacks the column: `a` or `b`.
        side: &'static str,
        /// Name of the column.
        column: String,
        /// Columns that the side has.
        here: String,
    },
    /// Two columns of a table have the same name.
    #[error("{side} has two columns {column:?}; rename one")]
    Twice {
        /// Side of the table: `a` or `b`.
        side: &'static str,
        /// Name of the columns.
        column: String,
    },
    /// The rows have too many distinct keys.
    #[error(
        "the rows have more than {names} names by lane, body and coordinate, too many to keep with {}; compare fewer bodies or columns at a time",
        counted(*columns, "column")
    )]
    TooManyNames {
        /// Number of distinct keys so far.
        names: usize,
        /// Number of value columns.
        columns: usize,
    },
    /// A tick is not a whole number, or a time is not a number.
    #[error("row {row} of {side}: column {column:?} has {cell:?}; write {}", wanted(*is_ticks))]
    NoOrder {
        /// Side of the row: `a` or `b`.
        side: &'static str,
        /// Position of the row after the header, from 1.
        row: u64,
        /// Name of the column.
        column: String,
        /// Whether the column counts ticks.
        is_ticks: bool,
        /// Text of the cell.
        cell: String,
    },
}

fn wanted(is_ticks: bool) -> &'static str {
    if is_ticks { "a whole number of 0 or more" } else { "a number" }
}

/// Roles of columns that their names do not show. Both tables must have every column named here, except that one may
/// lack an ignored column.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Chosen {
    /// Key columns, in place of `tick`, `lane`, `body` and `coordinate`. The first one with the name `tick`, `frame` or
    /// `step` counts ticks.
    pub key: Vec<String>,
    /// The column that counts ticks, in place of `tick`.
    pub tick: Option<String>,
    /// Value columns to compare. If the list is empty, all are compared.
    pub columns: Vec<String>,
    /// Columns to leave out.
    pub ignored: Vec<String>,
}

/// Names of the two sides.
const SIDES: [&str; 2] = ["a", "b"];
/// Largest tick whose number is exact in a double.
const MAX_TICK: f64 = 9_007_199_254_740_992.0;
/// Key columns besides the tick.
pub(super) const NAMES: [&str; 3] = ["lane", "body", "coordinate"];
/// Names of key columns that count ticks.
const TICKS: [&str; 3] = ["tick", "frame", "step"];
/// Name of the column of the coordinate. If it exists, no other column counts as motion.
const COORDINATE: &str = "q";
/// Columns that only a table of impacts has, and those by which its rows are matched: two rules land at other times.
const OF_IMPACTS: [&str; 3] = ["n", "impact", "apex_after"];
const KEY_OF_IMPACTS: [&str; 3] = ["n", "lane", "body"];

/// The order of the rows.
enum Order {
    /// Rows are ordered by this common column of ticks or times.
    By { column: String, is_ticks: bool, at: [usize; 2] },
    /// Rows are ordered by their position in the table.
    Place,
    /// Rows have no order, and form pairs by their keys alone.
    Key,
}

pub(super) struct ValueColumn {
    pub(super) name: String,
    pub(super) at: [usize; 2],
    pub(super) moves: Moves,
}

/// A key column besides the one that orders rows.
pub(super) struct Key {
    pub(super) name: String,
    pub(super) at: [usize; 2],
}

/// Positions and roles of the columns in both tables.
pub(super) struct ColumnLayout {
    order: Order,
    /// Column of the time (s) on the first side.
    t: Option<usize>,
    pub(super) keys: Vec<Key>,
    pub(super) values: Vec<ValueColumn>,
    /// Columns that only one side has.
    pub(super) alone: [Vec<String>; 2],
    /// Side and position of the first column that only one side has.
    pub(super) first_alone: Option<(usize, usize)>,
}

/// Returns the position of each name on both sides.
fn places(names: &[Vec<String>; 2]) -> Result<[HashMap<&str, usize>; 2], NotComparable> {
    let mut places: [HashMap<&str, usize>; 2] = Default::default();
    for (side, places) in places.iter_mut().enumerate() {
        for (i, name) in names[side].iter().enumerate() {
            if places.insert(name, i).is_some() {
                let (side, column) = (SIDES[side], name.clone());
                return Err(NotComparable::Twice { side, column });
            }
        }
    }
    Ok(places)
}

impl ColumnLayout {
    pub(super) fn of(headers: [&ByteRecord; 2], chosen: &Chosen) -> Result<Self, NotComparable> {
        let names = headers.map(|header| -> Vec<String> {
            header.iter().map(|cell| String::from_utf8_lossy(cell).trim().to_owned()).collect()
        });
        let places = places(&names)?;
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
        let is_of_impacts = OF_IMPACTS.iter().all(|name| matches!(find(name), [Some(_), Some(_)]));
        let key = match key.is_empty() && tick.is_none() && is_of_impacts {
            true => &KEY_OF_IMPACTS.map(str::to_owned).to_vec(),
            false => key,
        };
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

    /// Returns a row's position in the order, as bits that sort alike.
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
        // Bits of numbers with one sign sort like the numbers, and negative ones come first.
        let ordered = bits.map(|bits| if bits >> 63 == 0 { bits | 1 << 63 } else { !bits });
        ordered.ok_or_else(|| NotComparable::NoOrder {
            side: SIDES[side],
            row: place + 1,
            column: column.clone(),
            is_ticks,
            cell: String::from_utf8_lossy(cell).into_owned(),
        })
    }

    /// Returns the tick of a row; if there are no ticks, the row's position.
    pub(super) fn tick(&self, order: u64, place: u64) -> u64 {
        match self.order {
            Order::By { is_ticks: true, .. } => f64::from_bits(order & (u64::MAX >> 1)) as u64,
            _ => place,
        }
    }

    /// Returns the name of the tick, which is that of its column, or `tick` if rows go by position. `None` if rows have
    /// no order.
    pub(super) fn tick_name(&self) -> Option<&str> {
        match &self.order {
            Order::By { column, is_ticks: true, .. } => Some(column),
            Order::Key => None,
            _ => Some("tick"),
        }
    }

    pub(super) fn is_by_place(&self) -> bool {
        matches!(self.order, Order::Place)
    }

    /// Whether rows have an order. Without an order, nothing can move.
    pub(super) fn has_order(&self) -> bool {
        !matches!(self.order, Order::Key)
    }

    /// Returns the tick, time or position of a row, which is the scale along which a clock advances.
    pub(super) fn place(&self, order: u64, place: u64) -> f64 {
        match self.order {
            Order::By { .. } if order >> 63 == 0 => f64::from_bits(!order),
            Order::By { .. } => f64::from_bits(order & (u64::MAX >> 1)),
            Order::Place | Order::Key => place as f64,
        }
    }

    /// Returns the time (s) of a row of the first side.
    pub(super) fn time(&self, row: &ByteRecord) -> Option<f64> {
        parsed(&row[self.t?])
    }
}
