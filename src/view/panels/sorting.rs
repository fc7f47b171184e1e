//! The order of a table's rows, which a person chooses by clicks on the heads of its columns.

/// The column by which rows are sorted, and whether in reverse; `None` in the order of the keys.
pub(super) type Order = Option<(usize, bool)>;

/// What stands after the head of the column at this place: an arrow up where values rise from row to row.
pub(super) fn sign(order: Order, place: usize) -> &'static str {
    match order {
        Some((by, false)) if by == place => " ↑",
        Some((by, true)) if by == place => " ↓",
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arrow_points_up_where_the_smallest_is_on_top() {
        let by = clicked(None, 3);
        assert_eq!((by, sign(by, 3), sign(by, 2)), (Some((3, false)), " ↑", ""));
        let reversed = clicked(by, 3);
        assert_eq!((reversed, sign(reversed, 3)), (Some((3, true)), " ↓"));
        assert_eq!(clicked(reversed, 3), None);
    }
}
