//! Prints a game loop as a type whose function makes the ticks of a frame.

use super::{File, Printer, filled};
use crate::sim::law::{Expression, Level, Line, LoopName, StepBody, StepText};
use crate::source_code::dialect::{Language, Precision};
use crate::source_code::expression::Names;

/// The prefix of the functions of a printed loop.
const PREFIX: &str = "loop";

/// A number or an array that a loop keeps from frame to frame.
struct Kept {
    name: String,
    /// The number before the first frame, as an expression in every language.
    start: String,
    /// Number of elements, if it is an array.
    size: Option<usize>,
    /// Whether the lines name it, rather than the code around them.
    is_of_lines: bool,
}

/// Prints a game loop below its header.
pub(in crate::source_code) fn print_loop(
    text: &StepText,
    language: Language,
    header: &[String],
) -> String {
    let (dialect, precision) = (language.dialect(), Precision::Double);
    let mut printer = Printer { language, dialect, precision, text: String::new(), depth: 0 };
    for line in header {
        printer.print_comment(line);
    }
    printer.print_loop_file(&File::new(text, dialect, precision, PREFIX));
    printer.text
}

/// Returns the names of the numbers that a loop is made for.
pub(in crate::source_code) fn rates(body: StepBody<'_>) -> Vec<&'static str> {
    let rates = [
        (LoopName::Tick, &["tick_hz"][..]),
        (LoopName::Refresh, &["refreshes", "seconds"]),
        (LoopName::Cost, &["cost_ms"]),
    ];
    let used = rates.into_iter().filter(|(name, _)| body.depends_on(*name));
    used.flat_map(|(_, words)| words).copied().collect()
}

/// Whether the last line of a loop is the moment that it shows.
pub(super) fn returns_shown(body: StepBody<'_>) -> bool {
    let lines = body.lines();
    let shown = (0..lines.len()).filter(|n| body.shows(*n)).count();
    let is_said = |line: &&Line| !matches!(line, Line::Remark(_) | Line::Blank);
    let last = lines.iter().rposition(|line| is_said(&line));
    let stops = lines.iter().any(|line| matches!(line, Line::Stop { .. }));
    shown == 1 && !stops && last.is_some_and(|last| body.shows(last))
}

/// Whether a line sets the moment to show.
pub(in crate::source_code) fn shows(body: StepBody<'_>) -> bool {
    (0..body.lines().len()).any(|n| body.shows(n))
}

/// Returns what a loop keeps, of which the numbers that it is given come first.
fn kept(file: &File<'_>) -> Vec<Kept> {
    let (names, text) = (file.step(), file.text);
    let (body, is_whole) = (names.body, text.is_whole_loop());
    let rate = |word: &str| (names.dialect.spelt)(word);
    let has = |name| body.depends_on(name);
    let factor = |(name, word)| match is_whole && has(name) {
        true => format!(" * {}", rate(word)),
        false => String::new(),
    };
    let [hz, times] = [(LoopName::Tick, "tick_hz"), (LoopName::Refresh, "refreshes")].map(factor);
    let [refreshes, seconds] = ["refreshes", "seconds"].map(rate);
    let second = if is_whole { format!("1e9{hz}{times}") } else { "1000.0".into() };
    let told = [
        (
            LoopName::Tick,
            match is_whole {
                true => format!("1e9{times}"),
                false => format!("1000.0 / {}", rate("tick_hz")),
            },
        ),
        (
            LoopName::Refresh,
            match is_whole {
                true => format!("1e9{hz} * {seconds}"),
                false => format!("1000.0 * {seconds} / {refreshes}"),
            },
        ),
        (
            LoopName::Cost,
            match is_whole {
                true => format!("1e6{hz}{times} * {}", rate("cost_ms")),
                false => rate("cost_ms"),
            },
        ),
        (LoopName::Now, second.clone()),
        (LoopName::First, "1.0".into()),
    ];
    let used = told.into_iter().filter(|(name, _)| has(*name));
    let of_told = |(name, start): (LoopName, String)| Kept {
        name: names.spelling(name.name()),
        start,
        size: None,
        is_of_lines: false,
    };
    let fields = text.carried().iter().skip(2).map(|field| Kept {
        name: names.field(&field.name),
        start: names.start(field.start),
        size: None,
        is_of_lines: true,
    });
    let arrays = text.arrays().map(|(name, size, start)| Kept {
        name: names.spelling(name),
        start: names.start(start),
        size: Some(size),
        is_of_lines: true,
    });
    [(LoopName::Second, second)]
        .into_iter()
        .chain(used)
        .map(of_told)
        .chain(fields)
        .chain(arrays)
        .collect()
}

impl Printer {
    fn print_loop_file(&mut self, file: &File<'_>) {
        let body = file.text.body();
        let kept = kept(file);
        self.push_lines(&[""]);
        match self.language {
            Language::C => self.push_lines(&["#include <math.h>", ""]),
            Language::CSharp => {
                self.push_lines(&["using System;", "", "public sealed class GameLoop", "{"]);
                self.depth += 1;
            }
            Language::GdScript => {
                self.push_lines(&["class_name GameLoop", "extends RefCounted", ""])
            }
            Language::Rust | Language::JavaScript | Language::Lua => {}
        }
        let print_functions = |printer: &mut Self| {
            printer.print_written_out(file);
            for body in file.text.functions() {
                for remark in body.remarks() {
                    printer.print_comment(remark);
                }
                printer.print_function(file.names(body));
            }
        };
        print_functions(self);
        let rates: Vec<String> =
            rates(body).into_iter().map(|word| (self.dialect.spelt)(word)).collect();
        self.print_start(&kept, &rates);
        self.print_frame(file);
        match self.language {
            Language::CSharp | Language::Rust | Language::JavaScript => {
                self.depth -= 1;
                self.push_lines(&["}"]);
            }
            Language::C | Language::GdScript | Language::Lua => {}
        }
    }

    /// Prints the type of a loop, and the function that makes one.
    fn print_start(&mut self, kept: &[Kept], rates: &[String]) {
        let typed = |kind: &str| {
            let typed = rates.iter().map(|rate| kind.replace("NAME", rate));
            typed.collect::<Vec<_>>().join(", ")
        };
        let each = |number: &str, array: &str| -> Vec<String> {
            let each = kept.iter().map(|it| {
                let size = it.size.map_or_else(String::new, |size| size.to_string());
                let template = if it.size.is_some() { array } else { number };
                filled(&template.replace("SIZE", &size), &it.name, &it.start)
            });
            each.collect()
        };
        match self.language {
            Language::Rust => {
                self.push_lines(&["pub struct GameLoop {"]);
                for it in kept {
                    let visible = if it.is_of_lines { "pub " } else { "" };
                    let kind = it.size.map_or("f64".to_owned(), |size| format!("[f64; {size}]"));
                    self.push_lines(&[&format!("    {visible}{}: {kind},", it.name)]);
                }
                self.push_lines(&["}", "", "impl GameLoop {"]);
                self.depth += 1;
                self.push_lines(&[&format!("pub fn new({}) -> Self {{", typed("NAME: f64"))]);
                self.push_lines(&["    Self {"]);
                self.push_all("        ", &each("NAME: VALUE,", "NAME: [VALUE; SIZE],"));
                self.push_lines(&["    }", "}", ""]);
            }
            Language::C => {
                self.push_lines(&["typedef struct {"]);
                self.push_all("    ", &each("double NAME;", "double NAME[SIZE];"));
                let inputs = if rates.is_empty() { "void".into() } else { typed("double NAME") };
                self.push_lines(&["} game_loop;", ""]);
                self.push_lines(&[&format!("static inline game_loop game_loop_new({inputs}) {{")]);
                self.push_lines(&["    game_loop loop;"]);
                let array = "for (int i = 0; i < SIZE; i++) loop.NAME[i] = VALUE;";
                self.push_all("    ", &each("loop.NAME = VALUE;", array));
                self.push_lines(&["    return loop;", "}", ""]);
            }
            Language::CSharp => {
                self.push_all(
                    "",
                    &each("double NAME;", "readonly double[] NAME = new double[SIZE];"),
                );
                self.push_lines(&["", &format!("public GameLoop({})", typed("double NAME")), "{"]);
                let array = "for (int i = 0; i < SIZE; i++) this.NAME[i] = VALUE;";
                self.push_all("    ", &each("this.NAME = VALUE;", array));
                self.push_lines(&["}", ""]);
            }
            Language::GdScript => {
                self.push_all("", &each("var NAME: float", "var NAME := PackedFloat64Array()"));
                let inputs = typed("NAME: float");
                self.push_lines(&["", &format!("func _init({inputs}) -> void:")]);
                let array = "NAME.resize(SIZE)\n\tNAME.fill(VALUE)";
                self.push_all("\t", &each("NAME = VALUE", array));
                self.push_lines(&[""]);
            }
            Language::JavaScript => {
                self.push_lines(&["class GameLoop {"]);
                self.depth += 1;
                self.push_lines(&[&format!("constructor({}) {{", rates.join(", "))]);
                let array = "this.NAME = new Array(SIZE).fill(VALUE);";
                self.push_all("  ", &each("this.NAME = VALUE;", array));
                self.push_lines(&["}", ""]);
            }
            Language::Lua => {
                self.push_lines(&["local GameLoop = {}", "GameLoop.__index = GameLoop", ""]);
                self.push_lines(&[&format!("function GameLoop.new({})", rates.join(", "))]);
                self.push_lines(&["    local self = setmetatable({}, GameLoop)"]);
                let array = "self.NAME = {}\n    for i = 1, SIZE do self.NAME[i - 1] = VALUE end";
                self.push_all("    ", &each("self.NAME = VALUE", array));
                self.push_lines(&["    return self", "end", ""]);
            }
        }
    }

    fn push_all(&mut self, indent: &str, lines: &[String]) {
        lines.iter().for_each(|line| self.push_lines(&[&format!("{indent}{line}")]));
    }

    /// Prints the function of a frame.
    fn print_frame(&mut self, file: &File<'_>) {
        let (names, dialect) = (file.step(), self.dialect);
        let (body, is_whole) = (names.body, file.text.is_whole_loop());
        let (counts_now, shows) = (body.depends_on(LoopName::Now), shows(body));
        let reads_duration = counts_now || body.depends_on(LoopName::Duration);
        let duration = (dialect.spelt)(if is_whole { "duration_ns" } else { "duration_ms" });
        let unused = if reads_duration { "" } else { "_" };
        let answer = |number: &'static str, nothing: &'static str| {
            if shows { number } else { nothing }
        };
        let head = match self.language {
            Language::Rust => format!(
                "pub fn frame(&mut self, {unused}{duration}: f64, mut step: impl FnMut(f64)){} {{",
                answer(" -> f64", "")
            ),
            Language::C => format!(
                "static inline {} game_loop_frame(game_loop *loop, double {duration},\n    \
                 void (*step)(double seconds, void *user), void *user) {{",
                answer("double", "void")
            ),
            Language::CSharp => format!(
                "public {} Frame(double {duration}, Action<double> step)\n{{",
                answer("double", "void")
            ),
            Language::GdScript => format!(
                "func frame({unused}{duration}: float, step: Callable) -> {}:",
                answer("float", "void")
            ),
            Language::JavaScript => format!("frame({duration}, step) {{"),
            Language::Lua => format!("function GameLoop:frame({duration}, step)"),
        };
        let has_above = !super::declarations(body).above.is_empty();
        if self.language == Language::Rust && has_above {
            self.push_lines(&["#[allow(unused_assignments)]"]);
        }
        self.push_lines(&[&head]);
        self.depth += 1;
        if self.language == Language::C && !reads_duration {
            self.push_lines(&[&format!("(void){duration};")]);
        }
        let [dt, second] = [LoopName::Duration, LoopName::Second].map(|name| names.told(name));
        if is_whole && reads_duration {
            let is_scaled = body.depends_on(LoopName::Tick) || body.depends_on(LoopName::Refresh);
            let unit = if is_scaled { format!(" * ({second} / 1e9)") } else { String::new() };
            let value = format!("{}({duration}, 0.0){unit}", names.word("max"));
            self.push_filled(dialect.number, &dt, &value);
        }
        if counts_now {
            let now = names.told(LoopName::Now);
            self.push_filled(dialect.assignment, "", &format!("{now} = {now} + {dt}"));
        }
        if body.depends_on(LoopName::First) {
            let first = names.told(LoopName::First);
            // A local has the same name, which hides the field.
            let own = match self.language {
                Language::CSharp => "this.",
                Language::GdScript => "self.",
                _ => dialect.own,
            };
            let kept = format!("{own}{first}");
            self.push_filled(dialect.number, &first, &kept);
            self.push_filled(dialect.assignment, "", &format!("{kept} = 0.0"));
        }
        let shown = names.told(LoopName::Shown);
        let keeps_shown = shows && !returns_shown(body);
        if keeps_shown {
            self.push_filled(dialect.variable, &shown, "1.0");
        }
        self.print_body(names);
        if keeps_shown {
            self.push_filled(dialect.last_value, "", &shown);
        }
        self.depth -= 1;
        self.print_end();
    }

    /// Prints ticks, each of which is a call of the step with its length in seconds.
    pub(super) fn print_ticks<'t>(
        &mut self,
        names: Names<'t>,
        [count, length]: [&'t Expression; 2],
    ) {
        let (length, level) = names.expression(length, false);
        let is_loose = level.is_some_and(|level| level < Level::Product);
        let length = if is_loose { format!("({length})") } else { length };
        let seconds = format!("{length} / {}", names.told(LoopName::Second));
        let call = match self.language {
            Language::C => format!("step({seconds}, user);"),
            Language::GdScript => format!("step.call({seconds})"),
            Language::Lua => format!("step({seconds})"),
            Language::Rust | Language::CSharp | Language::JavaScript => format!("step({seconds});"),
        };
        let (count, level) = names.expression(count, false);
        if count == "1.0" {
            self.push_lines(&[&call]);
            return;
        }
        let left = names.told(LoopName::Made);
        let turns = |kind| format!("for ({kind} {left} = {count}; {left} >= 1.0; {left} -= 1.0)");
        let open = match self.language {
            Language::Rust if level.is_some() => format!("for _ in 0..({count}) as u32 {{"),
            Language::Rust => format!("for _ in 0..{count} as u32 {{"),
            Language::C => turns("double") + " {",
            Language::CSharp => turns("double") + "\n{",
            Language::JavaScript => turns("let") + " {",
            Language::GdScript => format!("for _tick in int({count}):"),
            Language::Lua => format!("for _ = 1, {count} do"),
        };
        self.push_lines(&[&open]);
        self.depth += 1;
        self.push_lines(&[&call]);
        self.depth -= 1;
        self.print_end();
    }

    /// Ends the frame early, with the moment to show so far.
    pub(super) fn end_frame(&mut self, names: Names<'_>, is_block_end: bool) {
        let end = match (shows(names.body), self.dialect.return_value.ends_with(';')) {
            (true, _) => filled(self.dialect.return_value, "", &names.told(LoopName::Shown)),
            (false, true) => "return;".into(),
            (false, false) => "return".into(),
        };
        let is_inner = self.language == Language::Lua && !is_block_end;
        self.push_lines(&[&if is_inner { format!("do {end} end") } else { end }]);
    }
}
