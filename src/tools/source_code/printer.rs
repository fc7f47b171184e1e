//! Prints a step in a language, line by line.

use super::declarations::{Declaration, declarations};
use super::dialect::{Dialect, Language, Precision, STEP, pascal};
use super::expression::{Names, Spellings, spellings};
use crate::sim::law::{Level, Line, MethodInput, StepBody, StepText};
use crate::sim::text::hides_or_breaks;

mod game_loop;
mod spin;

use game_loop::returns_shown;
pub(super) use game_loop::{print_loop, rates, shows};
pub(super) use spin::takes_moments;

/// Maximum length of a line, in characters. A longer line is broken at its commas.
const LINE_CHARS: usize = 100;

/// Functions that some languages lack, above a line that makes them a text.
const WRITTEN_OUT: &str =
    concat!(include_str!("../../../assets/methods/shared/functions.step"), "\nx += v\n");

/// The names of every step, by their indices.
const X: usize = 0;
const V: usize = 1;
const H: usize = 2;

/// Prints the step of the method `id` below its header.
pub(super) fn print(
    id: &str,
    text: &StepText,
    language: Language,
    precision: Precision,
    header: &[String],
) -> String {
    let dialect = language.dialect();
    let mut snake = id.replace('-', "_");
    if dialect.is_reserved(&(dialect.spelt)(&snake)) {
        snake += "_own";
    }
    let mut printer = Printer { language, dialect, precision, text: String::new(), depth: 0 };
    for line in header {
        printer.print_comment(line);
    }
    printer.print_file(&File::new(text, dialect, precision, &snake));
    printer.text
}

/// Returns the lines of a rule in the language of steps.
///
/// # Errors
/// The reason why they cannot be printed, as a clause.
pub(crate) fn rule_lines(text: &StepText) -> Result<Vec<String>, &'static str> {
    if let Some(reason) = text.unwritable() {
        return Err(reason);
    }
    let (language, precision, dialect) = (Language::Rust, Precision::Double, &STEP);
    let mut printer = Printer { language, dialect, precision, text: String::new(), depth: 0 };
    printer.print_body(File::of_rule(text).step());
    Ok(printer.text.lines().map(str::to_owned).collect())
}

/// Returns the name of each carried number of a rule in [its lines](rule_lines).
pub(crate) fn rule_names(text: &StepText) -> Vec<String> {
    let file = File::of_rule(text);
    text.carried().iter().map(|carried| file.step().name(carried.input())).collect()
}

/// The name of the length of a step in [the lines of a rule](rule_lines).
pub(crate) const RULE_STEP: &str = "step_s";

/// A text with the names that its printed functions share.
struct File<'t> {
    text: &'t StepText,
    dialect: &'static Dialect,
    precision: Precision,
    /// The name of the method, in lower case with underscores.
    snake: &'t str,
    spellings: Spellings<'t>,
    forwarding: Vec<&'t str>,
}

impl<'t> File<'t> {
    fn new(
        text: &'t StepText,
        dialect: &'static Dialect,
        precision: Precision,
        snake: &'t str,
    ) -> Self {
        let forwards = |body: &StepBody<'t>| takes_function(&body.inputs());
        let forwarding = text.functions().filter(forwards).filter_map(StepBody::function).collect();
        let spellings = spellings(text, dialect);
        Self { text, dialect, precision, snake, spellings, forwarding }
    }

    /// Returns a rule in the language of steps.
    fn of_rule(text: &'t StepText) -> Self {
        let mut file = Self::new(text, &STEP, Precision::Double, "");
        file.spellings.insert("h", RULE_STEP.into());
        file
    }

    fn names(&self, body: StepBody<'t>) -> Names<'_> {
        let Self { dialect, precision, snake, spellings, forwarding, .. } = self;
        Names { dialect, precision: *precision, prefix: snake, body, spellings, forwarding }
    }

    /// Returns the names inside the step.
    fn step(&self) -> Names<'_> {
        self.names(self.text.body())
    }
}

/// Whether one of the inputs is a function.
pub(super) fn takes_function(inputs: &[MethodInput<'_>]) -> bool {
    inputs.iter().any(|input| !input.arguments.is_empty())
}

struct Printer {
    language: Language,
    dialect: &'static Dialect,
    precision: Precision,
    text: String,
    depth: usize,
}

impl Printer {
    fn number_type(&self) -> &'static str {
        self.dialect.type_in(self.precision)
    }

    fn print_file(&mut self, file: &File<'_>) {
        let pascal = pascal(file.snake);
        self.push_lines(&[""]);
        match self.language {
            Language::C => self.push_lines(&["#include <math.h>", ""]),
            Language::CSharp => {
                self.push_lines(&[
                    "using System;",
                    "",
                    &format!("public static class {pascal}"),
                    "{",
                ]);
                self.depth += 1;
            }
            Language::Rust | Language::GdScript | Language::JavaScript | Language::Lua => {}
        }
        self.print_memory(file, &pascal);
        self.print_written_out(file);
        for body in file.text.functions() {
            for remark in body.remarks() {
                self.print_comment(remark);
            }
            self.print_function(file.names(body));
        }
        if file.text.is_spin() {
            self.print_spin(file);
        } else {
            self.print_step(file, &pascal);
        }
        if self.language == Language::CSharp {
            self.depth -= 1;
            self.push_lines(&["}"]);
        }
    }

    /// Prints the functions that the lines call and the language lacks.
    fn print_written_out(&mut self, file: &File<'_>) {
        let bodies = file.text.functions().chain([file.text.body()]);
        let called = bodies.flat_map(|body| {
            let names = file.names(body);
            body.lines().iter().flat_map(move |line| names.written_out(line)).collect::<Vec<_>>()
        });
        let mut called: Vec<&str> = called.collect();
        if called.is_empty() {
            return;
        }
        if called.contains(&"tanh") {
            called.extend(["sinh", "cosh"]);
        }
        let text = StepText::read_generated(WRITTEN_OUT).expect("a source of the package");
        let functions = File::new(&text, self.dialect, self.precision, file.snake);
        let is_called =
            |body: &StepBody<'_>| body.function().is_some_and(|it| called.contains(&it));
        for body in text.functions().filter(is_called) {
            self.print_function(functions.names(body));
        }
    }

    /// Prints the type of the memory, with its values before the first step.
    fn print_memory(&mut self, file: &File<'_>, pascal: &str) {
        let (names, number, snake) = (file.step(), self.number_type(), file.snake);
        let carried = file.text.carried().iter().skip(2);
        let starts: Vec<(String, String)> =
            carried.map(|field| (names.field(&field.name), names.start(field.start))).collect();
        if starts.is_empty() {
            return;
        }
        let each = |template: &str| -> Vec<String> {
            starts.iter().map(|(name, start)| filled(template, name, start)).collect()
        };
        let (open, each, close) = match self.language {
            Language::Rust => {
                let (open, values) = (format!("pub struct {pascal}Memory {{"), each("NAME: VALUE"));
                let start =
                    format!("fn default() -> Self {{\n        Self {{ {} }}", values.join(", "));
                let close =
                    format!("}}\n\nimpl Default for {pascal}Memory {{\n    {start}\n    }}\n}}");
                (open, each(&format!("    pub NAME: {number},")), close)
            }
            Language::C => {
                let values: Vec<&str> = starts.iter().map(|(_, start)| &**start).collect();
                let (upper, values) = (snake.to_uppercase(), values.join(", "));
                let close = format!("}} {snake}_memory;\n\n#define {upper}_START {{ {values} }}");
                ("typedef struct {".into(), each(&format!("    {number} NAME;")), close)
            }
            Language::CSharp => {
                let open = "public sealed class Memory\n{".to_owned();
                (open, each(&format!("    public {number} NAME = VALUE;")), "}".into())
            }
            Language::GdScript => {
                (format!("class {pascal}Memory:"), each("\tvar NAME: float = VALUE"), String::new())
            }
            Language::JavaScript => {
                let name = names.function("memory");
                let fields = each("NAME: VALUE").join(", ");
                (
                    format!("function {name}() {{"),
                    vec![format!("  return {{ {fields} }};")],
                    "}".into(),
                )
            }
            Language::Lua => {
                let name = names.function("memory");
                let fields = each("NAME = VALUE").join(", ");
                let line = format!("    return {{ {fields} }}");
                (format!("local function {name}()"), vec![line], "end".into())
            }
        };
        self.push_lines(&[&open]);
        each.iter().for_each(|line| self.push_lines(&[line]));
        match close.is_empty() {
            true => self.push_lines(&[""]),
            false => self.push_lines(&[&close, ""]),
        }
    }

    /// Prints a function that returns a number, and an empty line.
    fn print_function(&mut self, names: Names<'_>) {
        let function = names.body.function().unwrap_or_default();
        let (name, number) = (names.function(function), self.number_type());
        let (open, close) = match self.language {
            Language::Rust => (format!("fn {name}("), format!(") -> {number} {{")),
            Language::C => (format!("static {number} {name}("), ") {".into()),
            Language::CSharp => (format!("static {number} {name}("), ")\n{".into()),
            Language::GdScript => (format!("static func {name}("), ") -> float:".into()),
            Language::JavaScript => (format!("function {name}("), ") {".into()),
            Language::Lua => (format!("local function {name}("), ")".into()),
        };
        let inputs = self.parameters(&names);
        self.signature(&open, &inputs, &close);
        self.depth += 1;
        self.print_body(names);
        self.depth -= 1;
        self.print_end();
        self.push_lines(&[""]);
    }

    /// Prints the function of the step.
    fn print_step(&mut self, file: &File<'_>, pascal: &str) {
        let (names, snake) = (file.step(), file.snake);
        let lines = names.body.lines();
        let reads = |name: usize| {
            let is_compound = |line: &Line| matches!(line, Line::Assign { name: it, joins, .. } if *it == name && !joins.is_empty());
            lines.iter().any(|line| {
                is_compound(line) || line.value().is_some_and(|value| value.reads(name))
            })
        };
        let is_assigned = |name: usize| move |line: &Line| matches!(line, Line::Assign { name: it, .. } if *it == name);
        let assigns = |name: usize| lines.iter().any(is_assigned(name));
        let replaces = |name: usize| {
            let mut depth = 0;
            lines.iter().any(|line| {
                depth += line.depth();
                depth == 0 && is_assigned(name)(line)
            })
        };
        // Unused parameters are marked, so that compilers do not warn of them.
        let v = if reads(V) || !replaces(V) { "" } else { "_" };
        let h = if reads(H) { "" } else { "_" };
        let number = self.number_type();
        let name = (self.dialect.spelt)(snake);
        let (open, memory, state, close) = match self.language {
            Language::Rust => {
                let changed = |name: usize| if assigns(name) { "mut " } else { "" };
                let v = if v.is_empty() { format!("{}v", changed(V)) } else { "_v".into() };
                let state = [format!("{}x", changed(X)), v, format!("{h}h")]
                    .map(|name| format!("{name}: {number}"));
                let memory = format!("memory: &mut {pascal}Memory");
                let close = format!(") -> ({number}, {number}) {{");
                (format!("pub fn {name}("), memory, state, close)
            }
            Language::C => {
                let state = ["*position", "*velocity", "h"].map(|name| format!("{number} {name}"));
                let memory = format!("{snake}_memory *memory");
                (format!("void {name}("), memory, state, ") {".into())
            }
            Language::CSharp => {
                let state = ["x", "v"].map(|name| format!("ref {number} {name}"));
                let [x, v] = state;
                let state = [x, v, format!("{number} h")];
                ("public static void Step(".into(), "Memory memory".into(), state, ")\n{".into())
            }
            Language::GdScript => {
                let state = ["x: float".into(), format!("{v}v: float"), format!("{h}h: float")];
                let memory = format!("memory: {pascal}Memory");
                (format!("static func {name}("), memory, state, ") -> Array:".into())
            }
            Language::JavaScript | Language::Lua => {
                let state = ["x", "v", "h"].map(String::from);
                let [open, close] = match self.language {
                    Language::Lua => [format!("local function {name}("), ")".into()],
                    _ => [format!("function {name}("), ") {".into()],
                };
                (open, "memory".into(), state, close)
            }
        };
        let has_memory = file.text.carried().len() > 2;
        let mut parameters: Vec<String> = has_memory.then_some(memory).into_iter().collect();
        parameters.extend(state);
        parameters.extend(self.parameters(&names));
        self.signature(&open, &parameters, &close);
        self.depth += 1;
        match (self.language, v.is_empty()) {
            (Language::C, is_read) => {
                let v = if is_read { "v = *velocity" } else { "v" };
                self.push_lines(&[&format!("{number} x = *position;"), &format!("{number} {v};")]);
            }
            (Language::Rust, false) => self.push_lines(&["let v;"]),
            (Language::GdScript, false) => self.push_lines(&["var v: float"]),
            _ => {}
        }
        if self.language == Language::C && !h.is_empty() {
            self.push_lines(&["(void)h;"]);
        }
        self.print_body(names);
        match self.language {
            Language::Rust => self.push_lines(&["(x, v)"]),
            Language::C => self.push_lines(&["*position = x;", "*velocity = v;"]),
            Language::CSharp => {}
            Language::GdScript => self.push_lines(&["return [x, v]"]),
            Language::JavaScript => self.push_lines(&["return [x, v];"]),
            Language::Lua => self.push_lines(&["return x, v"]),
        }
        self.depth -= 1;
        self.print_end();
    }

    /// Returns the parameters for the inputs of a function.
    fn parameters(&self, names: &Names<'_>) -> Vec<String> {
        let number = self.number_type();
        let inputs = names.body.inputs();
        let each = |input: &MethodInput<'_>| {
            let name = names.input(input);
            let arguments = &input.arguments;
            let times = || vec![number; arguments.len()].join(", ");
            let own = if input.is_whole { self.dialect.whole } else { number };
            match (self.language, arguments.is_empty()) {
                (Language::Rust | Language::GdScript, true) => format!("{name}: {own}"),
                (Language::Rust, false) => format!("{name}: impl Fn({}) -> {number}", times()),
                (Language::C | Language::CSharp, true) => format!("{own} {name}"),
                (Language::C, false) => {
                    let arguments: Vec<String> =
                        arguments.iter().map(|argument| format!("{number} {argument}, ")).collect();
                    format!("{number} (*{name})({}void *user)", arguments.concat())
                }
                (Language::CSharp, false) => format!("Func<{}, {number}> {name}", times()),
                (Language::GdScript, false) => format!("{name}: Callable"),
                (Language::JavaScript | Language::Lua, _) => name,
            }
        };
        let mut parameters: Vec<String> = inputs.iter().map(each).collect();
        if self.language == Language::C && takes_function(&inputs) {
            parameters.push("void *user".into());
        }
        parameters
    }

    /// Prints the head of a function. If the parameters are too long for one line, each has a line of its own.
    fn signature(&mut self, open: &str, parameters: &[String], close: &str) {
        let whole = format!("{open}{}{close}", parameters.join(", "));
        if whole.len() + self.depth * self.dialect.indent.len() <= LINE_CHARS {
            self.push_lines(&[&whole]);
        } else {
            self.push_lines(&[open]);
            self.depth += 1;
            for (n, parameter) in parameters.iter().enumerate() {
                let is_last = n + 1 == parameters.len();
                // Only Rust allows a comma after the last parameter.
                let comma = if is_last && self.language != Language::Rust { "" } else { "," };
                self.push_lines(&[&format!("{parameter}{comma}")]);
            }
            self.depth -= 1;
            self.push_lines(&[close]);
        }
    }

    fn print_end(&mut self) {
        match self.dialect.end {
            "" => {}
            end => self.push_lines(&[end]),
        }
    }

    fn print_body(&mut self, names: Names<'_>) {
        let (dialect, lines) = (self.dialect, names.body.lines());
        let found = declarations(names.body);
        let declaration = |kind: Declaration| match kind {
            Declaration::Constant => dialect.constant,
            Declaration::Number => dialect.number,
            Declaration::Variable => dialect.variable,
            Declaration::Counter => dialect.counter,
        };
        for (name, kind) in &found.above {
            let start = if *kind == Declaration::Counter { "0" } else { "0.0" };
            self.push_filled(declaration(*kind), &names.name(*name), start);
        }
        let left_out = names.body.left_out();
        let is_said =
            |n: &usize| !left_out[*n] && !matches!(lines[*n], Line::Remark(_) | Line::Blank);
        let last = (0..lines.len()).rev().find(is_said);
        // Whether each open block is still empty, for which some languages need a word.
        let mut is_empty = vec![true];
        let start = self.text.len();
        for (n, line) in lines.iter().enumerate() {
            if left_out[n] {
                continue;
            }
            let is_block_end = matches!(lines.get(n + 1), Some(Line::End | Line::Else));
            match line {
                Line::End | Line::Else if is_empty.pop() == Some(true) => {
                    self.push_lines(dialect.nothing)
                }
                _ => {}
            }
            match line {
                Line::Blank | Line::Remark(_) => {}
                Line::Else => is_empty.push(true),
                _ => is_empty.iter_mut().for_each(|is| *is = false),
            }
            match line {
                Line::Store { array, index, value } => {
                    let at = names.element(names.body.array(*array), index);
                    let assignment = format!("{at} = {}", names.expression(value, false).0);
                    self.push_filled(dialect.assignment, "", &assignment);
                }
                Line::Blank if names.body.is_loop() && self.text.ends_with("\n\n") => {}
                Line::Blank if names.body.is_loop() && self.text.len() == start => {}
                Line::Blank => self.push_lines(&[""]),
                Line::Remark(text) => self.print_comment(text),
                Line::Assign { .. } if let Some(ticks) = names.body.ticks(n) => {
                    self.print_ticks(names, ticks);
                }
                Line::Assign { value, .. } if names.body.shows(n) && returns_shown(names.body) => {
                    self.push_filled(dialect.last_value, "", &names.expression(value, false).0);
                }
                Line::Assign { name, joins, value, .. } => {
                    let (value, level) = names.expression(value, names.body.is_whole(*name));
                    let name = names.name(*name);
                    match found.lines[n] {
                        Some(kind) => self.push_filled(declaration(kind), &name, &value),
                        None => {
                            let assignment = assignment(dialect, &name, joins, value, level);
                            self.push_filled(dialect.assignment, "", &assignment);
                        }
                    }
                }
                Line::If(value) | Line::While(value) => {
                    let is_if = matches!(line, Line::If(_));
                    let template = if is_if { dialect.if_block } else { dialect.while_block };
                    self.push_filled(template, "", &names.expression(value, false).0);
                    self.depth += 1;
                    is_empty.push(true);
                }
                Line::Return(value) => {
                    let is_last = Some(n) == last;
                    let template = if is_last { dialect.last_value } else { dialect.return_value };
                    self.push_filled(template, "", &names.expression(value, false).0);
                }
                Line::Stop { .. } if names.body.is_loop() => self.end_frame(names, is_block_end),
                Line::Stop { fails } => {
                    let moves = |line: &Line| matches!(line, Line::Assign { name: X | V, .. });
                    self.end_early(*fails, lines[..n].iter().any(moves), is_block_end);
                }
                Line::Else => {
                    self.depth -= 1;
                    self.push_lines(&[dialect.else_block]);
                    self.depth += 1;
                }
                Line::End => {
                    self.depth -= 1;
                    self.print_end();
                }
            }
        }
    }

    /// Prints a template with its placeholders filled.
    fn push_filled(&mut self, template: &str, name: &str, value: &str) {
        let template = self.dialect.fill_precision(template, self.precision);
        self.push_lines(&[&filled(&template, name, value)]);
    }

    /// Ends the step early, without a result if it fails, and otherwise with the present x and v.
    fn end_early(&mut self, fails: bool, has_moved: bool, is_block_end: bool) {
        let number = self.number_type();
        let lines: &[&str] = match (self.language, fails) {
            (Language::Rust, true) => &[&format!("return ({number}::NAN, {number}::NAN);")],
            (Language::Rust, false) => &["return (x, v);"],
            (Language::C, true) => &["*position = NAN;", "*velocity = NAN;", "return;"],
            (Language::C, false) if has_moved => &["*position = x;", "*velocity = v;", "return;"],
            (Language::C | Language::CSharp, false) => &["return;"],
            (Language::CSharp, true) => {
                &[&format!("x = {number}.NaN;"), &format!("v = {number}.NaN;"), "return;"]
            }
            (Language::GdScript, true) => &["return [NAN, NAN]"],
            (Language::GdScript, false) => &["return [x, v]"],
            (Language::JavaScript, true) => &["return [NaN, NaN];"],
            (Language::JavaScript, false) => &["return [x, v];"],
            // In Lua a block ends with its `return`.
            (Language::Lua, true) if is_block_end => &["return 0 / 0, 0 / 0"],
            (Language::Lua, true) => &["do return 0 / 0, 0 / 0 end"],
            (Language::Lua, false) if is_block_end => &["return x, v"],
            (Language::Lua, false) => &["do return x, v end"],
        };
        self.push_lines(lines);
    }

    /// Prints a comment of one line. Of a person's remark, it leaves out signs that end a line or reorder it in some
    /// language, and a backslash by which C would continue it.
    fn print_comment(&mut self, text: &str) {
        let text = text.replace(hides_or_breaks, " ");
        let line = format!("{} {text}", self.dialect.comment);
        self.push_lines(&[line.trim_end_matches(['\\', ' '])]);
    }

    /// Adds lines at the present depth.
    fn push_lines(&mut self, lines: &[&str]) {
        for line in lines.iter().flat_map(|lines| lines.split('\n').collect::<Vec<_>>()) {
            if !line.is_empty() {
                self.text.push_str(&self.indent(self.depth));
                self.text.push_str(line);
            }
            self.text.push('\n');
        }
    }

    fn indent(&self, depth: usize) -> String {
        self.dialect.indent.repeat(depth)
    }
}

/// Fills in the placeholders of a template.
fn filled(template: &str, name: &str, value: &str) -> String {
    template.replace("NAME", name).replace("VALUE", value)
}

/// Writes an assignment whose operator is `joins` with `=`.
fn assignment(
    dialect: &Dialect,
    name: &str,
    joins: &str,
    value: String,
    level: Option<Level>,
) -> String {
    match joins {
        "" => format!("{name} = {value}"),
        _ if dialect.is_compound => format!("{name} {joins}= {value}"),
        "+" | "-" if level > Some(Level::Sum) || level.is_none() => {
            format!("{name} = {name} {joins} {value}")
        }
        _ if level.is_none() => format!("{name} = {name} {joins} {value}"),
        _ => format!("{name} = {name} {joins} ({value})"),
    }
}
