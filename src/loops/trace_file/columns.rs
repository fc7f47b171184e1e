//! The columns of a log that say when frames began and were displayed.

use csv::StringRecord;

use super::Fault;
use super::durations::{self, Unit};
use crate::scene::{clip, clip_list};

/// Whether a row says how long it took until its frame, or from its frame on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Span {
    /// Since the frame before: PresentMon 1 and 2, OCAT, CapFrameX, FrameView, MangoHud.
    Before,
    /// Until the frame after: the metrics of PresentMon 2.0, `--v2_metrics`.
    After,
}

/// What tool writes a log, what its rows say, the column of frames and one beside it; each also without its `Ms`.
const FORMATS: [(&str, Span, &str, Beside); 9] = [
    (PRESENTMON, Span::Before, "MsBetweenPresents", Beside::Until("MsUntilDisplayed")),
    (PRESENTMON, Span::Before, "MsBetweenPresents", Beside::Display("MsBetweenDisplayChange")),
    (PRESENTMON, Span::After, "MsFrameTime", Beside::Display("MsDisplayedTime")),
    (PRESENTMON, Span::After, "MsFrameTime", Beside::Other("CPUBusy")),
    ("Unreal", Span::Before, "FrameTime", Beside::Other("GameThreadTime")),
    (FRAPS, Span::Before, "Time (ms)", Beside::Other("Frame")),
    (MANGOHUD, Span::Before, "frametime", Beside::Other("fps")),
    (OLD_MANGOHUD, Span::Before, "elapsed", Beside::Other("fps")),
    (PRESENTMON, Span::Before, "MsBetweenPresents", Beside::Nothing),
];

/// What writes PresentMon's columns, by one of its own: the first that is there.
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

/// The columns of a log's own time, with the nanoseconds of their units, and whether all versions write that unit.
const TIMES: [(&str, f64, bool); 3] =
    [("TimeInSeconds", 1e9, true), ("elapsed", 1.0, true), ("CPUStartTime", 1e6, false)];
/// Columns that MangoHud alone has.
const OF_MANGOHUD: [&str; 3] = ["elapsed", "cpu_load", "gpu_load"];

/// What is beside a column of frames.
enum Beside {
    /// The column of this name, with the times from a frame to its own display, where no other says which were dropped.
    Until(&'static str),
    /// The column of this name, with the times between displays.
    Display(&'static str),
    /// The column of this name, of a tool that knows nothing of the display.
    Other(&'static str),
    /// Any columns.
    Nothing,
}

/// Words in the heading of a list of frame times.
const OF_LIST: [&str; 5] = ["frame", "frametime", "dt", "delta", "deltatime"];
/// What a column of frame times is called beside other columns.
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
/// Words that say the unit of such a list.
const UNITS: [(&str, Unit); 6] = [
    ("s", Unit::Seconds),
    ("sec", Unit::Seconds),
    ("seconds", Unit::Seconds),
    ("ms", Unit::Milliseconds),
    ("us", Unit::Microseconds),
    ("µs", Unit::Microseconds),
];

/// What PresentMon calls a frame of the program, or one of which it does not know. Any other was generated or repeated.
const RENDERED: [&str; 4] = ["", "Application", "NotSet", "Unspecified"];

/// Where the columns are.
pub(super) struct Columns {
    /// The tool.
    pub(super) format: &'static str,
    /// The unit of all times; `None` where the log does not say.
    pub(super) unit: Option<Unit>,
    span: Span,
    began: Column,
    displayed: Option<Column>,
    /// Whether the times of display are from a frame's own beginning.
    is_until: bool,
    /// The frames a second that stand beside a frame's time.
    pub(super) fps: Option<usize>,
    /// The log's own time, the nanoseconds of its unit, and whether that is sure.
    time: Option<(usize, f64, bool)>,
    /// The times from a frame to its own display, where those between displays are read.
    until: Option<usize>,
    dropped: Option<Column>,
    frame_type: Option<usize>,
    application: Option<usize>,
    process: Option<usize>,
    swap_chain: Option<usize>,
}

const PRESENTMON: &str = "PresentMon";
/// The tool whose times are in a unit that depends on its version, and a list that no tool wrote.
const MANGOHUD: &str = "MangoHud";
const LIST: &str = "a list";
/// Its first versions, which wrote no times of frames.
const OLD_MANGOHUD: &str = "MangoHud before 0.6";
/// The tool whose rows say when a frame began, and not how long after the one before.
const FRAPS: &str = "FRAPS";

/// The column of a list of frame times under a heading, or of the frame times of a table, and its unit where the name says so.
fn of_list(header: &StringRecord) -> Option<(Column, Option<Unit>)> {
    let of = |(index, name): (usize, &str)| {
        let name = name.trim();
        let lower = name.to_lowercase();
        let words: Vec<&str> = lower.split(|c: char| !c.is_alphabetic()).collect();
        let is_plain = |sign: char| sign.is_alphanumeric() || "_ ()[].".contains(sign);
        let is_named = match header.len() {
            1 => words.iter().any(|word| OF_LIST.contains(word)) && name.chars().all(is_plain),
            // Beside others it must be called so whole.
            _ => OF_TABLE.iter().any(|known| lower.strip_prefix(known).is_some_and(is_unit)),
        };
        let unit =
            UNITS.iter().find(|(known, _)| words[1..].contains(known)).map(|(_, unit)| *unit);
        is_named.then(|| (Column { index, name: name.to_owned() }, unit))
    };
    header.iter().enumerate().find_map(of)
}

/// Whether this is nothing, or a unit behind a name.
fn is_unit(rest: &str) -> bool {
    let letters = rest.trim_matches(|c: char| !c.is_alphabetic());
    letters.is_empty() || UNITS.iter().any(|(known, _)| *known == letters)
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
    /// From one frame's display to the other's, or from its own beginning; `None` if it was never displayed.
    pub(super) displayed_ns: Option<i64>,
    /// Whether that is from its own beginning.
    pub(super) is_until: bool,
    /// The frames a second that stand beside it.
    pub(super) fps: Option<f64>,
    /// The log's own time, in nanoseconds.
    pub(super) time_ns: Option<f64>,
    /// The time from its beginning to its display, in nanoseconds, beside those between displays.
    pub(super) until_ns: Option<f64>,
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
        let is_dropped_said = index("Dropped").is_some();
        let times = |(format, span, began, beside): &(&'static str, Span, &str, Beside)| {
            let (displayed, is_until) = match beside {
                Beside::Until(_) if is_dropped_said => return None,
                Beside::Until(name) => (Some(column(name)?), true),
                Beside::Display(name) => (Some(column(name)?), false),
                Beside::Other(name) => index(name).map(|_| (None, false))?,
                Beside::Nothing => (None, false),
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

    /// Those of a list of frame times.
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

    /// Whether a row says when its frame began, and not how long after the one before.
    pub(super) fn is_since_start(&self) -> bool {
        [FRAPS, OLD_MANGOHUD].contains(&self.format)
    }

    /// Whether the unit of the log's own time is sure.
    pub(super) fn is_sure_of_time(&self) -> bool {
        self.time.is_some_and(|(.., is_sure)| is_sure)
    }

    /// Whether the first row says how long a frame of the log took.
    pub(super) fn counts_first(&self) -> bool {
        [LIST, MANGOHUD].contains(&self.format)
    }

    /// Whether the frames end before this row: Unreal writes the header again, and what it knows of the build.
    pub(super) fn end_before(&self, row: &StringRecord) -> bool {
        let is_of_build = row.get(0).is_some_and(|cell| cell.trim_start().starts_with('['));
        is_of_build || row.get(self.began.index).is_some_and(|cell| cell.trim() == self.began.name)
    }

    /// Whether the log says when frames are displayed.
    pub(super) fn has_display(&self) -> bool {
        self.displayed.is_some()
    }

    /// How many cells a row must have at least: up to the last that is read.
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
