//! The columns of a log that say when frames began and were displayed.

use csv::StringRecord;

use super::{Fault, milliseconds};
use crate::scene::{clip, clip_list};

/// Whether a row says how long it took until its frame, or from its frame on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Span {
    /// Since the frame before: PresentMon 1 and 2, OCAT, CapFrameX, FrameView, MangoHud.
    Before,
    /// Until the frame after: the metrics of PresentMon 2.0, `--v2_metrics`.
    After,
}

/// The names of the column of frames and of one beside it; each also without its `Ms`. The one beside has the times of
/// display, unless it is MangoHud's: that knows nothing of the display, and nor does a log of the first column alone.
const TIMES: [(Span, &str, Beside); 4] = [
    (Span::Before, "MsBetweenPresents", Beside::Display("MsBetweenDisplayChange")),
    (Span::After, "MsFrameTime", Beside::Display("MsDisplayedTime")),
    (Span::Before, "frametime", Beside::Other("fps")),
    (Span::Before, "MsBetweenPresents", Beside::Nothing),
];

/// What is beside a column of frames.
enum Beside {
    /// The column of this name, with the times of display.
    Display(&'static str),
    /// The column of this name: another tool's log with the same column of frames lacks the display.
    Other(&'static str),
    /// Any columns.
    Nothing,
}

/// What PresentMon calls a frame of the program, or one of which it does not know. Any other was generated or repeated.
const RENDERED: [&str; 4] = ["", "Application", "NotSet", "Unspecified"];

/// Where the columns are.
pub(super) struct Columns {
    span: Span,
    began: Column,
    displayed: Option<Column>,
    dropped: Option<Column>,
    frame_type: Option<usize>,
    application: Option<usize>,
    process: Option<usize>,
    swap_chain: Option<usize>,
    count: usize,
}

struct Column {
    index: usize,
    name: String,
}

/// What a row says.
pub(super) struct Cells<'a> {
    /// The program, the process and the window; empty where there is no such column.
    pub(super) application: &'a str,
    pub(super) process: &'a str,
    pub(super) swap_chain: &'a str,
    /// What the two times span.
    pub(super) span: Span,
    /// From one frame's beginning to the other's, in nanoseconds; the error where it is needed and missing.
    pub(super) began_ns: Result<i64, Fault>,
    /// From one frame's display to the other's; `None` if it was never displayed.
    pub(super) displayed_ns: Option<i64>,
    /// Whether a column says that it was displayed.
    pub(super) surely_displayed: bool,
    /// Whether a driver generated it, or repeated it, so that the program did not begin a frame.
    pub(super) is_generated: bool,
}

impl Columns {
    /// Finds the columns by the header, whatever the case of its letters.
    pub(super) fn find(header: &StringRecord) -> Result<Self, Fault> {
        let index = |name: &str| header.iter().position(|h| h.trim().eq_ignore_ascii_case(name));
        let column = |name: &str| {
            let index = index(name).or_else(|| index(name.strip_prefix("Ms")?))?;
            Some(Column { index, name: header[index].trim().to_owned() })
        };
        let times = |(span, began, beside): &(Span, &str, Beside)| {
            let displayed = match beside {
                Beside::Display(name) => Some(column(name)?),
                Beside::Other(name) => index(name).map(|_| None)?,
                Beside::Nothing => None,
            };
            Some((*span, column(began)?, displayed))
        };
        let Some((span, began, displayed)) = TIMES.iter().find_map(times) else {
            let found = clip_list(header.iter().map(str::trim));
            return Err(Fault::Columns { found });
        };
        Ok(Self {
            span,
            began,
            displayed,
            dropped: column("Dropped"),
            frame_type: index("FrameType"),
            application: index("Application"),
            process: index("ProcessID"),
            swap_chain: index("SwapChainAddress"),
            count: header.len(),
        })
    }

    /// Those of a list of frame times.
    pub(super) fn of_list() -> Self {
        let began = Column { index: 0, name: "1".into() };
        Self {
            span: Span::Before,
            began,
            displayed: None,
            dropped: None,
            frame_type: None,
            application: None,
            process: None,
            swap_chain: None,
            count: 1,
        }
    }

    /// Whether the log says when frames are displayed.
    pub(super) fn has_display(&self) -> bool {
        self.displayed.is_some()
    }

    /// Reads a row.
    pub(super) fn read<'a>(&self, row: &'a StringRecord) -> Result<Cells<'a>, Fault> {
        let (cells, header) = (row.len(), self.count);
        if cells < header {
            return Err(Fault::FewCells { cells, header });
        } else if cells > header {
            return Err(Fault::ManyCells { cells, header });
        }
        let text = |index: Option<usize>| index.map_or("", |index| row[index].trim());
        let dropped = self.dropped.as_ref().map(|column| column.flag(row)).transpose()?;
        let began_ns = self.began.time(row)?;
        let displayed_ns = match &self.displayed {
            Some(column) => column.time(row)?,
            None => began_ns,
        };
        let frame_type = text(self.frame_type);
        Ok(Cells {
            application: text(self.application),
            process: text(self.process),
            swap_chain: text(self.swap_chain),
            span: self.span,
            began_ns: began_ns.ok_or_else(|| Fault::NoTime { column: self.began.name.clone() }),
            displayed_ns: displayed_ns.filter(|_| dropped != Some(true)),
            surely_displayed: dropped == Some(false) || self.displayed.is_none(),
            is_generated: !RENDERED.iter().any(|known| known.eq_ignore_ascii_case(frame_type)),
        })
    }
}

impl Column {
    fn time(&self, row: &StringRecord) -> Result<Option<i64>, Fault> {
        milliseconds::nanoseconds(&row[self.index])
            .map_err(|fault| Fault::Cell { column: self.name.clone(), fault })
    }

    fn flag(&self, row: &StringRecord) -> Result<bool, Fault> {
        match row[self.index].trim() {
            "1" => Ok(true),
            "0" => Ok(false),
            cell => Err(Fault::NotAFlag { column: self.name.clone(), cell: clip(cell) }),
        }
    }
}
