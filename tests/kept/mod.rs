//! Texts that are kept in files, and compared row by row.

use std::collections::BTreeMap;

/// The differing rows of two texts, in their order: new rows with `+`, missing rows with `-`. If rows only moved, the
/// first of them is named.
fn difference(found: &str, kept: &str) -> Option<String> {
    if found == kept {
        return None;
    }
    let mut counts = BTreeMap::new();
    found.lines().for_each(|row| *counts.entry(row).or_insert(0) += 1);
    kept.lines().for_each(|row| *counts.entry(row).or_insert(0) -= 1);
    let mut one_sided = |text: &str, sign: char, step: i32| -> String {
        let mut rows = String::new();
        for row in text.lines() {
            let count = counts.get_mut(row).expect("counted above");
            if *count * step > 0 {
                *count -= step;
                rows += &format!("{sign} {row}\n");
            }
        }
        rows
    };
    let rows = one_sided(kept, '-', -1) + &one_sided(found, '+', 1);
    if !rows.is_empty() {
        return Some(rows);
    }
    let moved = found.lines().zip(kept.lines()).find(|(found, kept)| found != kept);
    Some(
        moved.map_or("the ends of lines\n".into(), |(row, _)| {
            format!("in another order from: {row}\n")
        }),
    )
}

/// Asserts that `file` holds `found`. A failure shows the differing rows and the remedy.
#[track_caller]
pub(crate) fn hold_text(file: &str, found: &str, kept: &str, remedy: &str) {
    if let Some(rows) = difference(found, kept) {
        panic!("{file} keeps other rows (- kept, + found):\n{rows}{remedy}");
    }
}

#[test]
fn only_differing_rows_are_shown() {
    let shown = |found: &str, kept: &str| difference(found, kept).unwrap_or_default();
    assert_eq!(shown("a\nb\n", "a\nb\n"), "");
    assert_eq!(shown("a\nB\nc\nc\n", "a\nb\nc\n"), "- b\n+ B\n+ c\n");
    assert_eq!(shown("a\nc\nb\n", "a\nb\nc\n"), "in another order from: c\n");
    assert_eq!(shown("a", "a\n"), "the ends of lines\n");
}
