//! The order of a table's rows, which a person chooses by clicks on the heads of its columns.

/// The column by which rows are sorted, and whether in reverse; `None` in the order of the keys.
pub(super) type Order = Option<(usize, bool)>;

/// What stands after the head of the column at this place.
pub(super) fn sign(order: Order, place: usize) -> &'static str {
    match order {
        Some((by, false)) if by == place => " ↓",
        Some((by, true)) if by == place => " ↑",
        _ => "",
    }
}

/// The order after a click on the head of the column at this place: by it, in reverse, and no more.
pub(super) fn clicked(order: Order, place: usize) -> Order {
    match order {
        Some((by, false)) if by == place => Some((place, true)),
        Some((by, true)) if by == place => None,
        _ => Some((place, false)),
    }
}
