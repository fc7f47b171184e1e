//! A table is read whatever stands above it and between its rows.

use super::*;

/// Returns the header, its line, and the rows with their lines.
fn read(text: &str, reading: Reading, known: &str) -> (Vec<String>, u64, Vec<(u64, String)>) {
    let of = |record: &ByteRecord| -> Vec<String> {
        record.iter().map(|cell| String::from_utf8_lossy(cell).into_owned()).collect()
    };
    let is_header = |row: &ByteRecord| row.iter().any(|cell| cell == known.as_bytes());
    let mut table = TableReader::begin(text.as_bytes(), reading, is_header).unwrap();
    let (header, line) = (of(table.header()), table.header_line());
    let (mut rows, mut row) = (Vec::new(), ByteRecord::new());
    while let Some(line) = table.next(&mut row).unwrap() {
        rows.push((line, of(&row).join("|")));
    }
    (header, line, rows)
}

#[test]
fn a_header_is_found_below_remarks_and_headings_with_any_separator() {
    for separator in [",", ";", "\t"] {
        let text = "# made by x\n\n// and y\nMachine:A\nos,cpu\nt,x\n0,1.5\n# later\n1,2\n"
            .replace(',', separator);
        let remarks = Reading { remarks: true, ..Reading::default() };
        let (header, line, rows) = read(&text, remarks, "x");
        assert_eq!((header.join("|").as_str(), line), ("t|x", 6), "{separator:?}");
        assert_eq!(rows, [(7, "0|1.5".to_owned()), (9, "1|2".to_owned())]);
    }
}

#[test]
fn quotes_short_rows_and_lists_are_read_on_request() {
    let short = Reading { short_rows: true, ..Reading::default() };
    let (.., rows) = read("x,name\n1,\"a, b\"\n2\n", short, "x");
    assert_eq!(rows, [(2, "1|a, b".to_owned()), (3, "2".to_owned())]);
    let lists = Reading { lists: true, ..Reading::default() };
    let (header, line, rows) = read("# times\n16,7\n16.6\n", lists, "x");
    assert_eq!((header, line), (vec![String::new()], 2));
    assert_eq!(rows, [(2, "16,7".to_owned()), (3, "16.6".to_owned())]);
    let begun = TableReader::begin("a,b\n1\n".as_bytes(), Reading::default(), |_| true);
    let error = begun.unwrap().next(&mut ByteRecord::new()).unwrap_err();
    assert!(error.line == 2 && error.to_string().contains("1 of the header's 2"), "{error}");
}

#[test]
fn an_empty_file_is_a_fault_and_an_unknown_header_is_the_first_line() {
    for text in ["", "\n\n", "# only a remark\n"] {
        let begun = TableReader::begin(text.as_bytes(), Reading::default(), |_| true);
        assert!(matches!(begun.map(|_| ()).unwrap_err().fault, TableFault::Empty), "{text:?}");
    }
    let (header, line, rows) = read("a,b\n1,2\n", Reading::default(), "x");
    assert_eq!((header.join("|").as_str(), line, rows.len()), ("a|b", 1, 1));
}
