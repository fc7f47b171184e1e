//! Turns what Android prints about frames into a table: `dumpsys gfxinfo PACKAGE framestats`, and `dumpsys
//! SurfaceFlinger --latency`. Lines keep their numbers.

use crate::table::{Decimal, number};

/// Columns of the table, in nanoseconds.
pub(super) const BEGAN: &str = "Began";
pub(super) const DISPLAYED: &str = "Displayed";
/// The line around each table of framestats.
const MARK: &str = "---PROFILEDATA---";
/// Time of a frame that is not displayed yet.
const PENDING: &str = "9223372036854775807";

/// Returns the table, if the text is what Android prints.
pub(super) fn table(bytes: &[u8]) -> Option<String> {
    let text = std::str::from_utf8(bytes).ok()?;
    let first = text.trim_start().lines().next()?;
    let three = |line: &str| {
        let cells: Vec<&str> = line.split_whitespace().collect();
        let are_whole = cells.iter().all(|cell| cell.bytes().all(|byte| byte.is_ascii_digit()));
        (cells.len() == 3 && are_whole).then(|| [cells[0].to_owned(), cells[1].to_owned()])
    };
    let is_number = number(first.as_bytes(), Decimal::Point).is_some();
    let second = text.trim_start().lines().nth(1);
    if is_number && second.is_some_and(|line| three(line).is_some()) {
        let rows = text.lines().map(|line| {
            let row =
                three(line).filter(|row| row[0] != "0" && !row.iter().any(|it| it == PENDING));
            row.map_or(String::new(), |[began, displayed]| format!("{began},{displayed}"))
        });
        let head = format!("{BEGAN},{DISPLAYED}");
        return Some([head].into_iter().chain(rows.skip(1)).collect::<Vec<_>>().join("\n"));
    }
    text.lines().any(|line| line.trim() == MARK).then(|| framestats(text))
}

/// Returns the table of the frames of all windows. A frame with a flag was not a usual one, and is left out.
fn framestats(text: &str) -> String {
    let (mut window, mut is_inside) = (0, false);
    let mut columns: Option<[usize; 3]> = None;
    let mut is_first = true;
    let mut rows = text.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if line.trim() == MARK {
            is_inside = !is_inside;
            window += u32::from(is_inside);
            columns = None;
            return String::new();
        }
        if !is_inside {
            return String::new();
        }
        let Some([flags, began, displayed]) = columns else {
            let at = |name: &str| cells.iter().position(|cell| *cell == name);
            let found = at("Flags").zip(at("IntendedVsync")).zip(at("FrameCompleted"));
            columns = found.map(|((flags, began), displayed)| [flags, began, displayed]);
            let is_head = columns.is_some() && std::mem::take(&mut is_first);
            let head = || format!("SwapChainAddress,{BEGAN},{DISPLAYED}");
            return if is_head { head() } else { String::new() };
        };
        match [cells.get(flags), cells.get(began), cells.get(displayed)] {
            [Some(&"0"), Some(began), Some(displayed)] => format!("{window},{began},{displayed}"),
            _ => String::new(),
        }
    });
    rows.by_ref().collect::<Vec<_>>().join("\n")
}
