//! Prints a program in a language, line by line.

use std::collections::BTreeMap;

use super::dialect::{Dialect, Language, Precision};
use super::names::{Names, is_reserved, pascal, spellings, takes_function};
use super::program::{Function, Line, MethodInput, Program, whole_numbers};
use crate::sim::text::hides_or_breaks;

/// Maximum length of a line, in characters. A longer line is broken at its commas.
const LINE_CHARS: usize = 100;

/// Prints the program of the method `id` below its header.
pub(super) fn print(
    id: &str,
    program: &Program<'_>,
    language: Language,
    precision: Precision,
    header: &[String],
) -> String {
    let spellings = spellings(program, language);
    let text = String::new();
    let mut printer = Printer { id, program, language, precision, spellings, text, depth: 0 };
    for line in header {
        printer.print_comment(line);
    }
    printer.print_file();
    printer.text
}

struct Printer<'a> {
    id: &'a str,
    program: &'a Program<'a>,
    language: Language,
    precision: Precision,
    spellings: BTreeMap<&'a str, String>,
    text: String,
    depth: usize,
}

impl Printer<'_> {
    fn dialect(&self) -> &'static Dialect {
        self.language.dialect()
    }

    fn number_type(&self) -> &'static str {
        self.dialect().type_in(self.precision)
    }

    /// Returns the names inside a function with these inputs.
    fn names<'a>(&'a self, inputs: &'a [MethodInput<'a>], body: &'a [Line<'a>]) -> Names<'a> {
        let Self { id, language, precision, .. } = *self;
        let (whole, spellings) = (whole_numbers(inputs, body), &self.spellings);
        let functions = &self.program.functions;
        Names { id, language, precision, whole, inputs, functions, spellings }
    }

    fn print_file(&mut self) {
        let mut snake = self.id.replace('-', "_");
        if is_reserved(self.language, &snake) {
            snake += "_own";
        }
        let pascal = pascal(&snake);
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
            Language::Rust | Language::GdScript => {}
        }
        self.print_memory(&snake, &pascal);
        let program = self.program;
        for function in &program.functions {
            for comment in &function.comments {
                self.print_comment(comment);
            }
            self.print_function(function);
            self.push_lines(&[""]);
        }
        self.print_step(&snake, &pascal);
        if self.language == Language::CSharp {
            self.depth -= 1;
            self.push_lines(&["}"]);
        }
    }

    /// Prints the type of the memory, with its values before the first step.
    fn print_memory(&mut self, snake: &str, pascal: &str) {
        let fields = &self.program.memory;
        if fields.is_empty() {
            return;
        }
        let (names, number) = (self.names(&[], &[]), self.number_type());
        let starts: Vec<(String, String)> = fields
            .iter()
            .map(|field| (names.name(field.name), names.expression(field.start)))
            .collect();
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
        };
        self.push_lines(&[&open]);
        each.iter().for_each(|line| self.push_lines(&[line]));
        match close.is_empty() {
            true => self.push_lines(&[""]),
            false => self.push_lines(&[&close, ""]),
        }
    }

    /// Prints a function that returns a number.
    fn print_function(&mut self, function: &Function<'_>) {
        let (name, number) = (self.names(&[], &[]).function(function.name), self.number_type());
        let (open, close) = match self.language {
            Language::Rust => (format!("fn {name}("), format!(") -> {number} {{")),
            Language::C => (format!("static {number} {name}("), ") {".into()),
            Language::CSharp => (format!("static {number} {name}("), ")\n{".into()),
            Language::GdScript => (format!("static func {name}("), ") -> float:".into()),
        };
        let inputs = self.parameters(&function.inputs);
        self.signature(&open, &inputs, &close);
        self.depth += 1;
        self.print_body(&function.body, &function.inputs);
        self.depth -= 1;
        self.print_end();
    }

    /// Prints the function of the step.
    fn print_step(&mut self, snake: &str, pascal: &str) {
        let program = self.program;
        // Unused parameters are marked, so that compilers do not warn of them.
        let v = if program.reads("v") || !program.replaces("v") { "" } else { "_" };
        let h = if program.reads("h") { "" } else { "_" };
        let number = self.number_type();
        let (open, memory, state, close) = match self.language {
            Language::Rust => {
                let changed = |name: &str| if program.assigns(name) { "mut " } else { "" };
                let v = if v.is_empty() { format!("{}v", changed("v")) } else { "_v".into() };
                let state = [format!("{}x", changed("x")), v, format!("{h}h")]
                    .map(|name| format!("{name}: {number}"));
                let memory = format!("memory: &mut {pascal}Memory");
                let close = format!(") -> ({number}, {number}) {{");
                (format!("pub fn {snake}("), memory, state, close)
            }
            Language::C => {
                let state = ["*position", "*velocity", "h"].map(|name| format!("{number} {name}"));
                let memory = format!("{snake}_memory *memory");
                (format!("void {snake}("), memory, state, ") {".into())
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
                (format!("static func {snake}("), memory, state, ") -> Array:".into())
            }
        };
        let has_memory = !program.memory.is_empty();
        let mut parameters: Vec<String> = has_memory.then_some(memory).into_iter().collect();
        parameters.extend(state);
        parameters.extend(self.parameters(&program.inputs));
        self.signature(&open, &parameters, &close);
        self.depth += 1;
        match (self.language, v.is_empty()) {
            (Language::C, is_read) => {
                let v = if is_read { "v = *velocity" } else { "v" };
                self.push_lines(&[&format!("{number} x = *position;"), &format!("{number} {v};")]);
            }
            (Language::Rust, false) => self.push_lines(&["let v;"]),
            (Language::GdScript, false) => self.push_lines(&["var v: float"]),
            (Language::Rust | Language::CSharp | Language::GdScript, _) => {}
        }
        if self.language == Language::C && !h.is_empty() {
            self.push_lines(&["(void)h;"]);
        }
        self.print_body(&program.body, &program.inputs);
        match self.language {
            Language::Rust => self.push_lines(&["(x, v)"]),
            Language::C => self.push_lines(&["*position = x;", "*velocity = v;"]),
            Language::CSharp => {}
            Language::GdScript => self.push_lines(&["return [x, v]"]),
        }
        self.depth -= 1;
        self.print_end();
    }

    /// Returns the parameters of a function with these inputs.
    fn parameters(&self, inputs: &[MethodInput<'_>]) -> Vec<String> {
        let names = self.names(inputs, &[]);
        let number = self.number_type();
        let each = |input: &MethodInput<'_>| {
            let name = names.name(input.name);
            let arguments = &input.arguments;
            let times = || vec![number; arguments.len()].join(", ");
            let own = if input.is_whole { self.dialect().whole } else { number };
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
            }
        };
        let mut parameters: Vec<String> = inputs.iter().map(each).collect();
        if self.language == Language::C && takes_function(inputs) {
            parameters.push("void *user".into());
        }
        parameters
    }

    /// Prints the head of a function. If the parameters are too long for one line, each has a line of its own.
    fn signature(&mut self, open: &str, parameters: &[String], close: &str) {
        let whole = format!("{open}{}{close}", parameters.join(", "));
        let dialect = self.dialect();
        if whole.len() + self.depth * dialect.indent.len() <= LINE_CHARS {
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
        match self.dialect().end {
            "" => {}
            end => self.push_lines(&[end]),
        }
    }

    fn print_body(&mut self, lines: &[Line<'_>], inputs: &[MethodInput<'_>]) {
        let dialect = self.dialect();
        let whole = whole_numbers(inputs, lines);
        for (n, line) in lines.iter().enumerate() {
            let is_last = n + 1 == lines.len();
            let (template, name, value) = match line {
                Line::Blank => ("", "", ""),
                Line::Comment(text) => {
                    self.print_comment(text);
                    continue;
                }
                Line::Constant { name, value } => (dialect.constant, *name, &**value),
                Line::Let { name, value } => (dialect.number, *name, &**value),
                Line::Var { name, value } => (dialect.variable, *name, &**value),
                Line::Counter { name, value } => (dialect.counter, *name, &**value),
                Line::Assignment(text) => (dialect.assignment, "", &**text),
                Line::If(condition) => (dialect.if_block, "", &**condition),
                Line::While(condition) => (dialect.while_block, "", &**condition),
                Line::Return(value) if is_last => (dialect.last_value, "", &**value),
                Line::Return(value) => (dialect.return_value, "", &**value),
                Line::Fail | Line::Stay => {
                    self.end_early(*line == Line::Fail);
                    continue;
                }
                Line::Else | Line::End => {
                    self.depth -= 1;
                    if *line == Line::Else {
                        self.push_lines(&[dialect.else_block]);
                        self.depth += 1;
                    } else {
                        self.print_end();
                    }
                    continue;
                }
            };
            let names = self.names(inputs, lines);
            let line_break = format!("{}\n{}", dialect.line_break, dialect.indent);
            let counts = match line {
                Line::If(_) | Line::While(_) | Line::Counter { .. } => true,
                Line::Assignment(text) => {
                    text.split(' ').next().is_some_and(|name| whole.contains(&name))
                }
                _ => false,
            };
            let value =
                if counts { names.whole_expression(value) } else { names.expression(value) };
            let value = value.replace('\n', &line_break);
            let template_here = dialect.fill_precision(template, self.precision);
            self.push_lines(&[&filled(&template_here, &names.name(name), &value)]);
            if [dialect.if_block, dialect.while_block].contains(&template) {
                self.depth += 1;
            }
        }
    }

    /// Ends the step early, without a result if it fails, and otherwise with the present x and v.
    fn end_early(&mut self, fails: bool) {
        let number = self.number_type();
        let lines: &[&str] = match (self.language, fails) {
            (Language::Rust, true) => &[&format!("return ({number}::NAN, {number}::NAN);")],
            (Language::Rust, false) => &["return (x, v);"],
            (Language::C, true) => &["*position = NAN;", "*velocity = NAN;", "return;"],
            (Language::C | Language::CSharp, false) => &["return;"],
            (Language::CSharp, true) => {
                &[&format!("x = {number}.NaN;"), &format!("v = {number}.NaN;"), "return;"]
            }
            (Language::GdScript, true) => &["return [NAN, NAN]"],
            (Language::GdScript, false) => &["return [x, v]"],
        };
        self.push_lines(lines);
    }

    /// Prints a comment of one line. Of a person's remark, it leaves out signs that end a line or reorder it in some
    /// language, and a backslash by which C would continue it.
    fn print_comment(&mut self, text: &str) {
        let text = text.replace(hides_or_breaks, " ");
        let line = format!("{} {text}", self.dialect().comment);
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
        self.dialect().indent.repeat(depth)
    }
}

/// Fills in the placeholders of a template.
fn filled(template: &str, name: &str, value: &str) -> String {
    template.replace("NAME", name).replace("VALUE", value)
}
