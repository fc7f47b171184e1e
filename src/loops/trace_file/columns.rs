//! Finds the columns of a log that record when frames began and were displayed.

use csv::StringRecord;

use super::Fault;
use super::android;
use super::durations::{self, Unreadable};
use super::survey::Survey;
use crate::scene::{clip, clip_list};
use crate::table::{Decimal, Heading, Moment, TableOptions, Unit};

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
const FORMATS: [(&str, Span, &str, CompanionColumn); 10] = [
    (ANDROID, Span::Before, android::BEGAN, CompanionColumn::Display(android::DISPLAYED)),
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
const OTHERS: [&str; 6] =
    ["MsUntilDisplayed", "Dropped", "FrameType", "SwapChainAddress", "fps", "MsBetweenPresents"];

/// Returns the name of each column by which a log is read, except those of its program.
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
const OF_LIST: [&str; 7] =
    ["frame", "frametime", "dt", "delta", "deltatime", "interval", "duration"];
/// Names of a column of frame times in a table, without its unit.
const OF_TABLE: [&str; 13] = [
    "frametime",
    "frame time",
    "deltatime",
    "delta time",
    "dt",
    "frame duration",
    "frame interval",
    "frame delta",
    "present interval",
    "frame",
    "delta",
    "interval",
    "duration",
];
/// The names among them that say something else without a unit.
const WITH_UNIT: [&str; 4] = ["frame", "delta", "interval", "duration"];
/// Names of a running clock, without its unit. A unit alone may also name frame times.
const CLOCKS: [&str; 12] = [
    "time",
    "t",
    "timestamp",
    "clock",
    "elapsed",
    "time stamp",
    "elapsed time",
    "game time",
    "sim time",
    "seconds",
    "ms",
    "now",
];

/// Number of rising frame times that are those of a clock. Fewer may rise by chance.
const MIN_RISING: u64 = 10;

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
    /// Whether rows record when a frame began instead of the time since the previous frame.
    is_clock: bool,
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
    /// The moment that a frame shows.
    shown: Option<Column>,
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
/// Android's own records of frames, whose begin and display are moments of one clock.
const ANDROID: &str = "Android";

/// Returns the column of frame times in a list with a heading or in a table, and its unit if the name gives one.
fn of_list(header: &StringRecord) -> Option<Result<(Column, Option<Unit>), Fault>> {
    let of = |(index, name): (usize, &str)| {
        let name = name.trim();
        let heading = Heading::of(name);
        let is_plain = |sign: char| sign.is_alphanumeric() || "_ ()[].".contains(sign);
        let is_named = match header.len() {
            1 => {
                heading.base.split(' ').any(|word| OF_LIST.contains(&word))
                    && name.chars().all(is_plain)
            }
            // In a table, the whole name must match.
            _ => {
                OF_TABLE.contains(&&*heading.base)
                    && (heading.unit.is_some() || !WITH_UNIT.contains(&&*heading.base))
            }
        };
        let column = Column { index, name: name.to_owned() };
        is_named.then(|| unit_of(heading, name).map(|unit| (column, unit)))
    };
    header.iter().enumerate().find_map(of)
}

/// Returns the unit of a heading, or a fault if the heading gives one that is not known.
fn unit_of(heading: Heading, name: &str) -> Result<Option<Unit>, Fault> {
    match heading.unknown {
        Some(unit) => Err(Fault::UnknownUnit { column: clip(name), unit: clip(&unit) }),
        None => Ok(heading.unit),
    }
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
    /// The moment that the frame shows, as printed.
    pub(super) shown_as: Option<f64>,
    /// The same time in milliseconds, never rounded.
    pub(super) began_ms: Option<f64>,
    /// Time between the beginnings of two frames, in nanoseconds. A missing time is an error only where it is needed.
    pub(super) began_ns: Result<i64, Fault>,
    /// Time between the displays of two frames, or from the frame's beginning to its display, in nanoseconds; `None` if
    /// the frame was not displayed.
    pub(super) displayed_ns: Option<i64>,
    /// Whether `displayed_ns` counts from the frame's own beginning.
    pub(super) is_until: bool,
    /// Frames per second in the same row.
    pub(super) fps: Option<f64>,
    /// When the frame began, in a log of a clock.
    pub(super) moment: Option<Moment>,
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
                    OLD_MANGOHUD | ANDROID => Some(Unit::Nanoseconds),
                    _ => Some(Unit::Milliseconds),
                };
                Some((*format, unit, *span, column(began)?, (displayed, is_until)))
            };
        let mut found = FORMATS.iter().find_map(times);
        if found.is_none() {
            let list = of_list(header).transpose()?;
            found = list.map(|(began, unit)| (LIST, unit, Span::Before, began, (None, false)));
        }
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
            is_clock: [FRAPS, OLD_MANGOHUD, ANDROID].contains(&format),
            is_until: is_until || format == ANDROID,
            began,
            displayed,
            fps: index("fps"),
            until,
            dropped: column("Dropped"),
            frame_type: index("FrameType"),
            application: index("Application"),
            process: index("ProcessID"),
            swap_chain: index("SwapChainAddress"),
            shown: None,
        })
    }

    /// Returns the columns of a list of frame times or of a clock, in this column.
    pub(super) fn of_list(index: usize, name: &str, unit: Option<Unit>, is_clock: bool) -> Self {
        Self {
            format: LIST,
            unit,
            span: Span::Before,
            began: Column { index, name: name.trim().to_owned() },
            is_clock,
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
            shown: None,
        }
    }

    /// Chooses the columns by what the caller says, by the names in the header, and by how the numbers go.
    pub(super) fn choose(
        header: &StringRecord,
        survey: &Survey,
        options: &TableOptions,
    ) -> Result<Self, Fault> {
        let names = header.as_byte_record();
        let named = [(options.frame.as_deref(), false), (options.time(), true)];
        for (name, is_clock) in named {
            let Some(name) = name else { continue };
            let absent = || {
                let found = clip_list(header.iter().map(str::trim));
                Fault::NoColumn { name: clip(name), found }
            };
            let index = crate::table::column(names, name).ok_or_else(absent)?;
            let unit = unit_of(Heading::of(&header[index]), &header[index])?;
            return Ok(Self::of_list(index, &header[index], unit, is_clock));
        }
        let courses = &survey.courses;
        let rises = |index: usize| courses.get(index).is_some_and(|it| it.rises() && !it.counts());
        if survey.is_headless {
            let clock = (0..header.len()).find(|index| rises(*index));
            let counts = |index: &usize| courses.get(*index).is_some_and(|it| it.counts());
            let frames = || (0..header.len()).find(|index| !counts(index));
            let index = clock.or_else(frames).unwrap_or(0);
            return Ok(Self::of_list(index, &format!("{}", index + 1), None, clock.is_some()));
        }
        let is_there = |(index, name): (usize, _)| {
            let is_untracked =
                survey.is_missing(index) && str::to_lowercase(name).contains("display");
            if is_untracked { "" } else { name }
        };
        let known: StringRecord = header.iter().enumerate().map(is_there).collect();
        let found = match Self::find(&known) {
            // A time of frames that rises through all rows is that of a clock.
            Ok(list) if list.is_list() && rises(list.began.index) => {
                let is_long = courses[list.began.index].count >= MIN_RISING;
                return Ok(Self { is_clock: is_long, fps: None, ..list });
            }
            Err(fault @ Fault::Columns { .. }) => Err(fault),
            found => return found,
        };
        let clock = |(index, name): (usize, &str)| {
            let heading = Heading::of(name);
            let is_named = CLOCKS.contains(&&*heading.base)
                || heading.unit.is_some() && !heading.base.contains(' ');
            let is_alone = Unit::of_word(&heading.base).is_some() || header.len() == 1;
            (is_named && (rises(index) || is_alone)).then_some((index, heading))
        };
        match header.iter().enumerate().find_map(clock) {
            Some((index, heading)) => {
                let unit = unit_of(heading, &header[index])?;
                Ok(Self::of_list(index, &header[index], unit, rises(index)))
            }
            None => found,
        }
    }

    /// Returns the same columns with that of the moment which a frame shows, if the options name one.
    pub(super) fn showing(
        self,
        header: &StringRecord,
        options: &TableOptions,
    ) -> Result<Self, Fault> {
        let Some(name) = options.shown.as_deref() else { return Ok(self) };
        let found = crate::table::column(header.as_byte_record(), name);
        let index = found.ok_or_else(|| Fault::NoColumn {
            name: clip(name),
            found: clip_list(header.iter().map(str::trim)),
        })?;
        Ok(Self { shown: Some(Column { index, name: name.trim().to_owned() }), ..self })
    }

    /// Whether the columns may be those of a header, so that it is the one of the table.
    pub(super) fn may_be_of(header: &StringRecord, options: &TableOptions) -> bool {
        let named = [options.frame.as_deref(), options.time()].into_iter().flatten().next();
        match named {
            Some(name) => header.iter().any(|cell| cell.trim() == name.trim()),
            None => !matches!(Self::find(header), Err(Fault::Columns { .. })),
        }
    }

    /// Returns the columns that are read, by their index.
    pub(super) fn used(&self) -> Vec<usize> {
        let columns = [Some(&self.began), self.displayed.as_ref(), self.dropped.as_ref()];
        let columns = columns.into_iter().chain([self.shown.as_ref()]);
        let columns = columns.flatten().map(|column| column.index);
        let texts = [self.frame_type, self.application, self.process, self.swap_chain, self.until];
        let times = [self.fps, self.time.map(|(index, ..)| index)];
        columns.chain(texts.into_iter().chain(times).flatten()).collect()
    }

    /// Returns the index of the column of frame times or of the clock.
    pub(super) fn began_at(&self) -> usize {
        self.began.index
    }

    /// Whether no tool that is known wrote the log.
    pub(super) fn is_list(&self) -> bool {
        self.format == LIST
    }

    /// Whether the log has MangoHud's rows, whose first may count from the machine's start.
    pub(super) fn is_of_mangohud(&self) -> bool {
        self.format == MANGOHUD
    }

    /// Whether frames begin and are displayed by one clock.
    pub(super) fn has_one_clock(&self) -> bool {
        self.is_until
    }

    /// Whether rows record when a frame began instead of the time since the previous frame.
    pub(super) fn is_since_start(&self) -> bool {
        self.is_clock
    }

    /// Whether the unit of the log's own time is certain.
    pub(super) fn is_sure_of_time(&self) -> bool {
        self.time.is_some_and(|(.., is_sure)| is_sure)
    }

    /// Whether the time in the first row is the duration of a logged frame.
    pub(super) fn counts_first(&self) -> bool {
        [LIST, MANGOHUD].contains(&self.format) && !self.is_clock
    }

    /// Whether the frames end before this row. Unreal repeats the header at the end and describes the build there.
    pub(super) fn end_before(&self, row: &StringRecord) -> bool {
        let is_of_build = row.get(0).is_some_and(|cell| cell.trim_start().starts_with('['));
        let is_name = self.began.name.parse::<f64>().is_err();
        let is_header = |cell: &str| is_name && cell.trim() == self.began.name;
        is_of_build || row.get(self.began.index).is_some_and(is_header)
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
    pub(super) fn read<'a>(
        &self,
        row: &'a StringRecord,
        unit: Unit,
        is_signed: bool,
    ) -> Result<Cells<'a>, Fault> {
        let (cells, header) = (row.len(), self.needed());
        if cells < header {
            return Err(Fault::FewCells { cells, header });
        }
        let text = |index: Option<usize>| index.map_or("", |index| row[index].trim());
        let dropped = self.dropped.as_ref().map(|column| column.flag(row)).transpose()?;
        let moment = if self.is_clock { self.began.moment(row)? } else { None };
        let began_ns = match self.is_clock {
            true => moment.map(|_| 0),
            false => self.began.time(row, unit, is_signed)?,
        };
        let displayed_ns = match &self.displayed {
            Some(column) if self.is_clock => {
                let until =
                    column.moment(row)?.zip(moment).map(|(shown, began)| shown.since(began));
                until.map(|until| (until * unit.ns()).round() as i64).filter(|until| *until >= 0)
            }
            Some(column) => column.time(row, unit, false)?,
            None => began_ns,
        };
        let frame_type = text(self.frame_type);
        let number = |index: Option<usize>| {
            let cell = row.get(index?)?.trim().replace(',', ".");
            cell.parse::<f64>().ok().filter(|number| number.is_finite())
        };
        let shown_as = match &self.shown {
            Some(Column { index, name }) => Some(number(Some(*index)).ok_or_else(|| {
                let cell = clip(row.get(*index).unwrap_or_default());
                Fault::Cell { column: name.clone(), fault: Unreadable::NotANumber(cell) }
            })?),
            None => None,
        };
        Ok(Cells {
            shown_as,
            application: text(self.application),
            process: text(self.process),
            swap_chain: text(self.swap_chain),
            span: self.span,
            began_ms: number(Some(self.began.index)).filter(|_| !self.is_clock).map(|time| {
                match unit {
                    Unit::Milliseconds => time,
                    _ => time * unit.ns() / Unit::Milliseconds.ns(),
                }
            }),
            began_ns: began_ns.ok_or_else(|| Fault::NoTime { column: self.began.name.clone() }),
            is_until: self.is_until,
            fps: number(self.fps),
            moment,
            time_ns: self.time.and_then(|(index, ns, _)| Some(number(Some(index))? * ns)),
            until_ns: number(self.until).map(|ms| 1e6 * ms),
            displayed_ns: displayed_ns.filter(|_| dropped != Some(true)),
            surely_displayed: dropped == Some(false) || self.displayed.is_none(),
            is_generated: !RENDERED.iter().any(|known| known.eq_ignore_ascii_case(frame_type)),
        })
    }
}

impl Column {
    fn time(&self, row: &StringRecord, unit: Unit, is_signed: bool) -> Result<Option<i64>, Fault> {
        durations::nanoseconds(&row[self.index], unit, is_signed)
            .map_err(|fault| Fault::Cell { column: self.name.clone(), fault })
    }

    fn moment(&self, row: &StringRecord) -> Result<Option<Moment>, Fault> {
        let cell = row[self.index].trim();
        if durations::is_missing(cell) {
            return Ok(None);
        }
        let fault =
            || Fault::Cell { column: self.name.clone(), fault: Unreadable::NotANumber(clip(cell)) };
        Moment::read(cell.as_bytes(), Decimal::PointOrComma).map(Some).ok_or_else(fault)
    }

    fn flag(&self, row: &StringRecord) -> Result<bool, Fault> {
        match row[self.index].trim() {
            "1" => Ok(true),
            "0" => Ok(false),
            cell => Err(Fault::NotAFlag { column: self.name.clone(), cell: clip(cell) }),
        }
    }
}
