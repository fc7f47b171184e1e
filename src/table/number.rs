//! Parses numbers as many tools write them.

/// Decimal signs that a number may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decimal {
    /// A point.
    Point,
    /// A point, or a comma if the number has no other comma or point.
    PointOrComma,
}

/// Parses the number in a cell, which may be infinite or NaN; returns `None` if the cell has no number.
pub fn number(cell: &[u8], decimal: Decimal) -> Option<f64> {
    let cell = std::str::from_utf8(cell).ok()?.trim();
    let plain = cell.parse().ok();
    if plain.is_some() || decimal == Decimal::Point {
        return plain;
    }
    let (whole, fraction) = cell.split_once(',')?;
    let is_one = !cell.contains('.') && !fraction.contains(',');
    is_one.then(|| format!("{whole}.{fraction}").parse().ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_comma_is_read_unless_commas_separate_cells() {
        for (cell, decimal, wanted) in [
            ("1.5", Decimal::Point, Some(1.5)),
            (" 1,5 ", Decimal::PointOrComma, Some(1.5)),
            ("-0,25e3", Decimal::PointOrComma, Some(-250.0)),
            ("1,5", Decimal::Point, None),
            ("1,234.5", Decimal::PointOrComma, None),
            ("1,2,3", Decimal::PointOrComma, None),
            ("", Decimal::PointOrComma, None),
            ("0000E012", Decimal::Point, Some(0.0)),
        ] {
            assert_eq!(number(cell.as_bytes(), decimal), wanted, "{cell:?}");
        }
        assert!(number(b"nan", Decimal::Point).is_some_and(f64::is_nan));
    }
}
