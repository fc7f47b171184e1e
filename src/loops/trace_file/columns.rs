//! Finds the columns of a log that record when frames began and were displayed.

use csv::StringRecord;

use super::Fault;
use super::durations::{self, Unit};
use crate::scene::{clip, clip_list};

/// Whether a row's time ends or starts at its frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Span {
    /// The time counts since the previous frame, as in PresentMon 1 and 2, OCAT, CapFrameX, FrameView and MangoHud.
    Before,
    /// The time counts until the next frame, as in the metrics of PresentMon 2.0, `--v2_metrics`.
    After,
}

/// Known formats: the tool, the span of a row, the column of frame times, and a column that must occur beside it. Each
/// column name also matches without its `Ms`.
const FORMATS: [(&str, Span, &str, CompanionColumn); 9] = [
    (PRESENTMON, Span::Before, "MsBetweenPresents", CompanionColumn::Until("MsUntilDisplayed")),
    (
        PRESENTMON,
        Span::Before,
        "MsBetweenPresents",
        CompanionColumn::Display("MsBetweenDisplayChange"),
    ),
    (PRESENTMON, Span::After, "MsFrameTime", CompanionColumn::Display("MsDisplayedTime")),
    (PRESENTMON, Span::After, "MsFrameTime", CompanionColumn::Other("CPUBusy")),
    ("Unreal", Span::Before, "FrameTime", CompanionColumn::Other("GameThreadTime")),
    (FRAPS, Span::Before, "Time (ms)", CompanionColumn::Other("Frame")),
    (MANGOHUD, Span::Before, "frametime", CompanionColumn::Other("fps")),
    (OLD_MANGOHUD, Span::Before, "elapsed", CompanionColumn::Other("fps")),
    (PRESENTMON, Span::Before, "MsBetweenPresents", CompanionColumn::Nothing),
];

/// Tools that write PresentMon's columns, each with a column by which it is recognized. The first match counts.
const OF_PRESENTMON: [(&str, &str); 9] = [
    ("Motherboard", "OCAT"),
    ("Resolution", "FrameView"),
    ("CPUStartTime", "PresentMon 2"),
    ("CPUStartQPC", "PresentMon 2"),
    ("FrameType", "PresentMon 2"),
    ("AnimationTime", "PresentMon 2"),
    ("MsCPUBusy", "PresentMon 2"),
    ("MsFrameTime", "PresentMon 2"),
    ("Dropped", "PresentMon 1"),
];

/// Columns with a log's own time, the number of nanoseconds in their unit, and whether every version uses that unit.
const TIMES: [(&str, f64, bool); 3] =
    [("TimeInSeconds", 1e9, true), ("elapsed", 1.0, true), ("CPUStartTime", 1e6, false)];
/// Columns that only MangoHud writes.
const OF_MANGOHUD: [&str; 3] = ["elapsed", "cpu_load", "gpu_load"];

/// Columns that several tools write, besides those of the tables above.
#[cfg(feature = "serde")]
const OTHERS: [&str; 6] =
    ["MsUntilDisplayed", "Dropped", "FrameType", "SwapChainAddress", "fps", "MsBetweenPresents"];

/// Returns the name of each column by which a log is read, except those of its program.
#[cfg(feature = "serde")]
pub(super) fn known_names() -> impl Iterator<Item = &'static str> {
    let formats = FORMATS.iter().flat_map(|(_, _, began, beside)| match beside {
        CompanionColumn::Until(name)
        | CompanionColumn::Display(name)
        | CompanionColumn::Other(name) => [*began, *name],
        CompanionColumn::Nothing => [*began; 2],
    });
    let tools = OF_PRESENTMON.iter().map(|(name, _)| *name).chain(OF_MANGOHUD);
    let all = formats.chain(tools).chain(TIMES.iter().map(|(name, ..)| *name)).chain(OTHERS);
    let mut known = Vec::new();
    all.flat_map(|name| [Some(name), name.strip_prefix("Ms")]).flatten().filter(move |name| {
        !known.contains(name) && {
            known.push(*name);
            true
        }
    })
}

/// The column that is expected beside a column of frame times.
enum CompanionColumn {
    /// The column of the times from each frame to its own display, in a log without a column of dropped frames.
    Until(&'static str),
    /// The column of the times between displays.
    Display(&'static str),
    /// A column of a tool that does not measure the display.
    Other(&'static str),
    /// No particular column.
    Nothing,
}

/// Words in the heading of a list of frame times.
const OF_LIST: [&str; 5] = ["frame", "frametime", "dt", "delta", "deltatime"];
/// Names of a column of frame times in a table.
const OF_TABLE: [&str; 8] = [
    "frametime",
    "frame time",
    "frame_time",
    "frame-time",
    "deltatime",
    "delta time",
    "delta_time",
    "dt",
];
/// Words for the unit in the name of such a column.
const UNITS: [(&str, Unit); 6] = [
    ("s", Unit::Seconds),
    ("sec", Unit::Seconds),
    ("seconds", Unit::Seconds),
    ("ms", Unit::Milliseconds),
    ("us", Unit::Microseconds),
    ("µs", Unit::Microseconds),
];

/// PresentMon's types for frames that the program rendered, or whose origin is unknown. Frames of all other types are
/// generated or repeated.
const RENDERED: [&str; 4] = ["", "Application", "NotSet", "Unspecified"];

/// The columns of a log.
pub(super) struct Columns {
    /// Name of the tool.
    pub(super) format: &'static str,
    /// Unit of all times; `None` if the log does not name it.
    pub(super) unit: Option<Unit>,
    span: Span,
    began: Column,
    displayed: Option<Column>,
    /// Whether display times count from the frame's own beginning.
    is_until: bool,
    /// Column of the frames per second, beside the frame times.
    pub(super) fps: Option<usize>,
    /// Column of the log's own time, the number of nanoseconds in its unit, and whether that unit is certain.
    time: Option<(usize, f64, bool)>,
    /// Column of the times from each frame to its own display, in a log whose times between displays are used.
    until: Option<usize>,
    dropped: Option<Column>,
    frame_type: Option<usize>,
    application: Option<usize>,
    process: Option<usize>,
    swap_chain: Option<usize>,
}

const PRESENTMON: &str = "PresentMon";
/// MangoHud, whose unit of time depends on its version, and the name for a list that no tool wrote.
const MANGOHUD: &str = "MangoHud";
const LIST: &str = "a list";
/// The first versions of MangoHud, which wrote no frame times.
const OLD_MANGOHUD: &str = "MangoHud before 0.6";
/// The tool whose rows record when a frame began instead of the time since the previous frame.
const FRAPS: &str = "FRAPS";

/// Returns the column of frame times in a list with a heading or in a table, and its unit if the name gives one.
fn of_list(header: &StringRecord) -> Option<(Column, Option<Unit>)> {
    let of = |(index, name): (usize, &str)| {
        let name = name.trim();
        let lower = name.to_lowercase();
        let words: Vec<&str> = lower.split(|c: char| !c.is_alphabetic()).collect();
        let is_plain = |sign: char| sign.is_alphanumeric() || "_ ()[].".contains(sign);
        let is_named = match header.len() {
            1 => words.iter().any(|word| OF_LIST.contains(word)) && name.chars().all(is_plain),
            // In a table, the whole name must match.
            _ => OF_TABLE.iter().any(|known| lower.strip_prefix(known).is_some_and(is_unit)),
        };
        let unit =
            UNITS.iter().find(|(known, _)| words[1..].contains(known)).map(|(_, unit)| *unit);
        is_named.then(|| (Column { index, name: name.to_owned() }, unit))
    };
    header.iter().enumerate().find_map(of)
}

/// Whether the rest of a name is empty or a unit.
fn is_unit(rest: &str) -> bool {
    let letters = rest.trim_matches(|c: char| !c.is_alphabetic());
    letters.is_empty() || UNITS.iter().any(|(known, _)| *known == letters)
}

struct Column {
    index: usize,
    name: String,
}

/// The values of a row.
pub(super) struct Cells<'a> {
    /// Names of the program, process and window; empty if the log has no such column.
    pub(super) application: &'a str,
    pub(super) process: &'a str,
    pub(super) swap_chain: &'a str,
    /// Direction in which the two times below count.
    pub(super) span: Span,
    /// Time between the beginnings of two frames, in nanoseconds. A missing time is an error only where it is needed.
    pub(super) began_ns: Result<i64, Fault>,
    /// Time between the displays of two frames, or from the frame's beginning to its display, in nanoseconds; `None` if
    /// the frame was not displayed.
    pub(super) displayed_ns: Option<i64>,
    /// Whether `displayed_ns` counts from the frame's own beginning.
    pub(super) is_until: bool,
    /// Frames per second in the same row.
    pub(super) fps: Option<f64>,
    /// The log's own time in nanoseconds.
    pub(super) time_ns: Option<f64>,
    /// Time from the frame's beginning to its display in nanoseconds, in a log that also has the times between
    /// displays.
    pub(super) until_ns: Option<f64>,
    /// Whether a column confirms that the frame was displayed.
    pub(super) surely_displayed: bool,
    /// Whether a driver generated or repeated the frame, so that the program did not begin it.
    pub(super) is_generated: bool,
}

impl Columns {
    /// Finds the columns by the names in the header, ignoring case.
    pub(super) fn find(header: &StringRecord) -> Result<Self, Fault> {
        let index = |name: &str| header.iter().position(|h| h.trim().eq_ignore_ascii_case(name));
        let column = |name: &str| {
            let index = index(name).or_else(|| index(name.strip_prefix("Ms")?))?;
            Some(Column { index, name: header[index].trim().to_owned() })
        };
        let is_dropped_said = index("Dropped").is_some();
        let times =
            |(format, span, began, beside): &(&'static str, Span, &str, CompanionColumn)| {
                let (displayed, is_until) = match beside {
                    CompanionColumn::Until(_) if is_dropped_said => return None,
                    CompanionColumn::Until(name) => (Some(column(name)?), true),
                    CompanionColumn::Display(name) => (Some(column(name)?), false),
                    CompanionColumn::Other(name) => index(name).map(|_| (None, false))?,
                    CompanionColumn::Nothing => (None, false),
                };
                let unit = match *format {
                    MANGOHUD => None,
                    OLD_MANGOHUD => Some(Unit::Nanoseconds),
                    _ => Some(Unit::Milliseconds),
                };
                Some((*format, unit, *span, column(began)?, (displayed, is_until)))
            };
        let found = FORMATS.iter().find_map(times).or_else(|| {
            let (began, unit) = of_list(header)?;
            Some((LIST, unit, Span::Before, began, (None, false)))
        });
        let Some((format, unit, span, began, (displayed, is_until))) = found else {
            let found = clip_list(header.iter().map(str::trim));
            return Err(Fault::Columns { found });
        };
        let writer = OF_PRESENTMON.iter().find(|(own, _)| column(own).is_some());
        let is_list = OF_MANGOHUD.iter().all(|own| index(own).is_none());
        let format = match writer.filter(|_| format == PRESENTMON) {
            Some((_, writer)) => writer,
            None if format == MANGOHUD && is_list => LIST,
            None => format,
        };
        let time = TIMES.iter().find_map(|&(name, ns, is_sure)| Some((index(name)?, ns, is_sure)));
        let until = index("MsUntilDisplayed").filter(|_| displayed.is_some() && !is_until);
        Ok(Self {
            format,
            unit,
            span,
            time: time.filter(|(index, ..)| *index != began.index),
            began,
            displayed,
            is_until,
            fps: index("fps"),
            until,
            dropped: column("Dropped"),
            frame_type: index("FrameType"),
            application: index("Application"),
            process: index("ProcessID"),
            swap_chain: index("SwapChainAddress"),
        })
    }

    /// Returns the columns of a list of frame times.
    pub(super) fn of_list() -> Self {
        let began = Column { index: 0, name: "1".into() };
        Self {
            format: LIST,
            unit: None,
            span: Span::Before,
            began,
            displayed: None,
            is_until: false,
            fps: None,
            time: None,
            until: None,
            dropped: None,
            frame_type: None,
            application: None,
            process: None,
            swap_chain: None,
        }
    }

    /// Whether frames begin and are displayed by one clock.
    pub(super) fn has_one_clock(&self) -> bool {
        self.is_until
    }

    /// Whether rows record when a frame began instead of the time since the previous frame.
    pub(super) fn is_since_start(&self) -> bool {
        [FRAPS, OLD_MANGOHUD].contains(&self.format)
    }

    /// Whether the unit of the log's own time is certain.
    pub(super) fn is_sure_of_time(&self) -> bool {
        self.time.is_some_and(|(.., is_sure)| is_sure)
    }

    /// Whether the time in the first row is the duration of a logged frame.
    pub(super) fn counts_first(&self) -> bool {
        [LIST, MANGOHUD].contains(&self.format)
    }

    /// Whether the frames end before this row. Unreal repeats the header at the end and describes the build there.
    pub(super) fn end_before(&self, row: &StringRecord) -> bool {
        let is_of_build = row.get(0).is_some_and(|cell| cell.trim_start().starts_with('['));
        is_of_build || row.get(self.began.index).is_some_and(|cell| cell.trim() == self.began.name)
    }

    /// Whether the log has display times.
    pub(super) fn has_display(&self) -> bool {
        self.displayed.is_some()
    }

    /// Returns the minimum number of cells in a row, which is the number up to the last used cell.
    fn needed(&self) -> usize {
        let columns = [Some(&self.began), self.displayed.as_ref(), self.dropped.as_ref()];
        let columns = columns.into_iter().flatten().map(|column| column.index);
        let texts = [self.frame_type, self.application, self.process, self.swap_chain];
        let all = columns.chain(texts.into_iter().flatten());
        all.max().map_or(0, |last| last + 1)
    }

    /// Reads a row whose times are in this unit.
    pub(super) fn read<'a>(&self, row: &'a StringRecord, unit: Unit) -> Result<Cells<'a>, Fault> {
        let (cells, header) = (row.len(), self.needed());
        if cells < header {
            return Err(Fault::FewCells { cells, header });
        }
        let text = |index: Option<usize>| index.map_or("", |index| row[index].trim());
        let dropped = self.dropped.as_ref().map(|column| column.flag(row)).transpose()?;
        let began_ns = self.began.time(row, unit)?;
        let displayed_ns = match &self.displayed {
            Some(column) => column.time(row, unit)?,
            None => began_ns,
        };
        let frame_type = text(self.frame_type);
        let number = |index: Option<usize>| {
            let cell = row.get(index?)?.trim().replace(',', ".");
            cell.parse::<f64>().ok().filter(|number| number.is_finite())
        };
        Ok(Cells {
            application: text(self.application),
            process: text(self.process),
            swap_chain: text(self.swap_chain),
            span: self.span,
            began_ns: began_ns.ok_or_else(|| Fault::NoTime { column: self.began.name.clone() }),
            is_until: self.is_until,
            fps: number(self.fps),
            time_ns: self.time.and_then(|(index, ns, _)| Some(number(Some(index))? * ns)),
            until_ns: number(self.until).map(|ms| 1e6 * ms),
            displayed_ns: displayed_ns.filter(|_| dropped != Some(true)),
            surely_displayed: dropped == Some(false) || self.displayed.is_none(),
            is_generated: !RENDERED.iter().any(|known| known.eq_ignore_ascii_case(frame_type)),
        })
    }
}

impl Column {
    fn time(&self, row: &StringRecord, unit: Unit) -> Result<Option<i64>, Fault> {
        durations::nanoseconds(&row[self.index], unit)
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
