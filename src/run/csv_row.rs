//! Writes comma-separated values, one line at a time.

use std::fmt::{Display, Write};

/// Returns a line of comma-separated values with its line end. Values that contain commas, quotes or line ends are
/// quoted.
pub fn csv_row(values: &[&dyn Display]) -> String {
    let mut row = String::new();
    for (column, value) in values.iter().enumerate() {
        let start = row.len() + usize::from(column > 0);
        let comma = if column > 0 { "," } else { "" };
        write!(row, "{comma}{value}").expect("a string takes everything");
        if row[start..].contains([',', '"', '\n', '\r']) {
            let quoted = row[start..].replace('"', "\"\"");
            row.replace_range(start.., &format!("\"{quoted}\""));
        }
    }
    row + "\n"
}

#[cfg(test)]
mod tests {
    use super::csv_row;

    #[test]
    fn cells_with_commas_quotes_or_ends_of_lines_are_quoted() {
        let row = csv_row(&[&"free spring", &"", &"a, b", &"the \"Pride\"", &"a\nb", &-0.5]);
        assert_eq!(row, "free spring,,\"a, b\",\"the \"\"Pride\"\"\",\"a\nb\",-0.5\n");
        assert_eq!(csv_row(&[]), "\n");
    }
}
