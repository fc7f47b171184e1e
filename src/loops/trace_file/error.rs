//! What can be wrong with a log of frames.

use super::milliseconds::Unreadable;

/// Why a log cannot be read, with its place and a remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}:{line}: {fault}")]
pub struct TraceFileError {
    /// What the caller calls the log.
    pub name: String,
    /// The line of the fault, from 1.
    pub line: u64,
    pub(super) fault: Fault,
}

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum Fault {
    #[error(
        "there is nothing here; capture some frames with PresentMon, OCAT, CapFrameX, FrameView or MangoHud"
    )]
    Empty,
    #[error("the text is in UTF-16, as PowerShell writes it; save it as UTF-8")]
    Utf16,
    #[error("there is a header and no frame of a program below it; capture some frames")]
    NoRows,
    #[error(
        "the columns MsBetweenPresents, alone or with MsBetweenDisplayChange, FrameTime and DisplayedTime, or MangoHud's fps and frametime, are needed, and here are {found}; write a row for each frame under a header, or frame times in milliseconds alone, one a line"
    )]
    Columns { found: String },
    #[error("the row has {cells} of the header's {header} cells; take it out if it was cut off")]
    FewCells { cells: usize, header: usize },
    #[error(
        "the row has {cells} cells and the header {header}; if its numbers have decimal commas, write points, or separate the cells with semicolons"
    )]
    ManyCells { cells: usize, header: usize },
    #[error("column {column}: {fault}")]
    Cell { column: String, fault: Unreadable },
    #[error("column {column}: the time of this frame is missing; take the row out")]
    NoTime { column: String },
    #[error(
        "column {column}: expected 0 or 1, found \"{cell}\"; write 1 for a frame that was not displayed"
    )]
    NotAFlag { column: String, cell: String },
    #[error("no time passes from here to the last of these {frames} frames; capture them again")]
    NoTimePasses { frames: usize },
    #[error("from here on the frames last more than a year in all; split the log")]
    TooLong,
}
