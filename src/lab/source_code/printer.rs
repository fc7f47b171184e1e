//! Prints a program in a language, line by line.

use super::dialect::{Dialect, Language};
use super::names::{Names, pascal, takes_function};
use super::program::{Function, Line, MethodInput, Program};

/// The longest line that is not broken at its commas.
const LINE_CHARS: usize = 100;

/// Prints the program of the method `id` below the lines of its header.
pub(super) fn print(
    id: &str,
    program: &Program<'_>,
    language: Language,
    header: &[String],
) -> String {
    let mut printer = Printer { id, program, language, text: String::new(), depth: 0 };
    for line in header {
        printer.comment(line);
    }
    printer.whole();
    printer.text
}

struct Printer<'a> {
    id: &'a str,
    program: &'a Program<'a>,
    language: Language,
    text: String,
    depth: usize,
}

impl Printer<'_> {
    fn dialect(&self) -> &'static Dialect {
        self.language.dialect()
    }

    /// The names inside a function that takes `inputs`.
    fn names<'a>(&'a self, inputs: &'a [MethodInput<'a>]) -> Names<'a> {
        Names { id: self.id, language: self.language, inputs, functions: &self.program.functions }
    }

    fn whole(&mut self) {
        let snake = self.id.replace('-', "_");
        let pascal = pascal(&snake);
        self.lines(&[""]);
        match self.language {
            Language::C => self.lines(&["#include <math.h>", ""]),
            Language::CSharp => {
                self.lines(&["using System;", "", &format!("public static class {pascal}"), "{"]);
                self.depth += 1;
            }
            Language::Rust | Language::GdScript => {}
        }
        self.memory(&snake, &pascal);
        let program = self.program;
        for function in &program.functions {
            for comment in &function.comments {
                self.comment(comment);
            }
            self.function(function);
            self.lines(&[""]);
        }
        self.step(&snake, &pascal);
        if self.language == Language::CSharp {
            self.depth -= 1;
            self.lines(&["}"]);
        }
    }

    /// The type of the memory, with its values before the first step.
    fn memory(&mut self, snake: &str, pascal: &str) {
        let fields = &self.program.memory;
        if fields.is_empty() {
            return;
        }
        let names = self.names(&[]);
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
                (open, each("    NAME: f64,"), close)
            }
            Language::C => {
                let values: Vec<&str> = starts.iter().map(|(_, start)| &**start).collect();
                let (upper, values) = (snake.to_uppercase(), values.join(", "));
                let close = format!("}} {snake}_memory;\n\n#define {upper}_START {{ {values} }}");
                ("typedef struct {".into(), each("    double NAME;"), close)
            }
            Language::CSharp => {
                let open = "public sealed class Memory\n{".to_owned();
                (open, each("    public double NAME = VALUE;"), "}".into())
            }
            Language::GdScript => {
                (format!("class {pascal}Memory:"), each("\tvar NAME: float = VALUE"), String::new())
            }
        };
        self.lines(&[&open]);
        each.iter().for_each(|line| self.lines(&[line]));
        match close.is_empty() {
            true => self.lines(&[""]),
            false => self.lines(&[&close, ""]),
        }
    }

    /// A function that returns a number.
    fn function(&mut self, function: &Function<'_>) {
        let name = self.names(&[]).function(function.name);
        let (open, close) = match self.language {
            Language::Rust => (format!("fn {name}("), ") -> f64 {"),
            Language::C | Language::CSharp => (format!("static double {name}("), ")"),
            Language::GdScript => (format!("static func {name}("), ") -> float:"),
        };
        let inputs = self.parameters(&function.inputs);
        self.signature(&open, &inputs, close);
        self.depth += 1;
        self.body(&function.body, &function.inputs);
        self.depth -= 1;
        self.end();
    }

    /// The function of the step itself.
    fn step(&mut self, snake: &str, pascal: &str) {
        let program = self.program;
        // What is not read is marked, or compilers warn of it.
        let mark = |name| if program.reads(name) { "" } else { "_" };
        let (v, h) = (mark("v"), mark("h"));
        let (open, memory, state, close) = match self.language {
            Language::Rust => {
                let v = if v.is_empty() { "mut v: f64" } else { "_v: f64" };
                let state = ["mut x: f64".into(), v.into(), format!("{h}h: f64")];
                let memory = format!("memory: &mut {pascal}Memory");
                (format!("pub fn {snake}("), memory, state, ") -> (f64, f64) {")
            }
            Language::C => {
                let state = ["double *position", "double *velocity", "double h"];
                let memory = format!("{snake}_memory *memory");
                (format!("void {snake}("), memory, state.map(String::from), ")")
            }
            Language::CSharp => {
                let state = ["ref double x", "ref double v", "double h"].map(String::from);
                ("public static void Step(".into(), "Memory memory".into(), state, ")")
            }
            Language::GdScript => {
                let state = ["x: float".into(), format!("{v}v: float"), format!("{h}h: float")];
                let memory = format!("memory: {pascal}Memory");
                (format!("static func {snake}("), memory, state, ") -> Array:")
            }
        };
        let has_memory = !program.memory.is_empty();
        let mut parameters: Vec<String> = has_memory.then_some(memory).into_iter().collect();
        parameters.extend(state);
        parameters.extend(self.parameters(&program.inputs));
        self.signature(&open, &parameters, close);
        self.depth += 1;
        match (self.language, v.is_empty()) {
            (Language::C, true) => self.lines(&["double x = *position;", "double v = *velocity;"]),
            (Language::C, false) => self.lines(&["double x = *position;", "double v;"]),
            (Language::Rust, false) => self.lines(&["let v;"]),
            (Language::GdScript, false) => self.lines(&["var v: float"]),
            (Language::Rust | Language::CSharp | Language::GdScript, _) => {}
        }
        if self.language == Language::C && !h.is_empty() {
            self.lines(&["(void)h;"]);
        }
        self.body(&program.body, &program.inputs);
        match self.language {
            Language::Rust => self.lines(&["(x, v)"]),
            Language::C => self.lines(&["*position = x;", "*velocity = v;"]),
            Language::CSharp => {}
            Language::GdScript => self.lines(&["return [x, v]"]),
        }
        self.depth -= 1;
        self.end();
    }

    /// The parameters of a function for these inputs.
    fn parameters(&self, inputs: &[MethodInput<'_>]) -> Vec<String> {
        let names = self.names(inputs);
        let each = |input: &MethodInput<'_>| {
            let name = names.name(input.name);
            let arguments = &input.arguments;
            let times = |word: &str| vec![word; arguments.len()].join(", ");
            match (self.language, arguments.is_empty()) {
                (Language::Rust, true) => format!("{name}: f64"),
                (Language::Rust, false) => format!("{name}: impl Fn({}) -> f64", times("f64")),
                (Language::C | Language::CSharp, true) => format!("double {name}"),
                (Language::C, false) => {
                    let arguments: Vec<String> =
                        arguments.iter().map(|argument| format!("double {argument}, ")).collect();
                    format!("double (*{name})({}void *user)", arguments.concat())
                }
                (Language::CSharp, false) => format!("Func<{}, double> {name}", times("double")),
                (Language::GdScript, true) => format!("{name}: float"),
                (Language::GdScript, false) => format!("{name}: Callable"),
            }
        };
        let mut parameters: Vec<String> = inputs.iter().map(each).collect();
        if self.language == Language::C && takes_function(inputs) {
            parameters.push("void *user".into());
        }
        parameters
    }

    /// The head of a function, with each parameter on a line if they are too long for one.
    fn signature(&mut self, open: &str, parameters: &[String], close: &str) {
        let whole = format!("{open}{}{close}", parameters.join(", "));
        let dialect = self.dialect();
        if whole.len() + self.depth * dialect.indent.len() <= LINE_CHARS {
            self.lines(&[&whole]);
        } else {
            self.lines(&[open]);
            self.depth += 1;
            for (n, parameter) in parameters.iter().enumerate() {
                let is_last = n + 1 == parameters.len();
                // Only Rust takes a comma after the last.
                let comma = if is_last && self.language != Language::Rust { "" } else { "," };
                self.lines(&[&format!("{parameter}{comma}")]);
            }
            self.depth -= 1;
            self.lines(&[close]);
        }
        if matches!(self.language, Language::C | Language::CSharp) {
            self.lines(&["{"]);
        }
    }

    fn end(&mut self) {
        match self.dialect().end {
            "" => {}
            end => self.lines(&[end]),
        }
    }

    fn body(&mut self, lines: &[Line<'_>], inputs: &[MethodInput<'_>]) {
        let dialect = self.dialect();
        for line in lines {
            let (template, name, value) = match line {
                Line::Blank => ("", "", ""),
                Line::Comment(text) => {
                    self.comment(text);
                    continue;
                }
                Line::Constant { name, value } => (dialect.constant, *name, &**value),
                Line::Let { name, value } => (dialect.number, *name, &**value),
                Line::Var { name, value } => (dialect.variable, *name, &**value),
                Line::Assignment(text) => (dialect.assignment, "", &**text),
                Line::If(condition) => (dialect.if_block, "", &**condition),
                Line::While(condition) => (dialect.while_block, "", &**condition),
                Line::Return(value) => (dialect.return_value, "", &**value),
                Line::Fail => {
                    self.fail();
                    continue;
                }
                Line::Else | Line::End => {
                    self.depth -= 1;
                    if *line == Line::Else {
                        self.lines(&[dialect.else_block]);
                        self.depth += 1;
                    } else {
                        self.end();
                    }
                    continue;
                }
            };
            let names = self.names(inputs);
            let line_break = format!("{}\n{}", dialect.line_break, dialect.indent);
            let value = names.expression(value).replace('\n', &line_break);
            self.lines(&[&filled(template, &names.name(name), &value)]);
            if [dialect.if_block, dialect.while_block].contains(&template) {
                self.depth += 1;
            }
        }
    }

    /// Ends the step without a result.
    fn fail(&mut self) {
        match self.language {
            Language::Rust => self.lines(&["return (f64::NAN, f64::NAN);"]),
            Language::C => self.lines(&["*position = NAN;", "*velocity = NAN;", "return;"]),
            Language::CSharp => self.lines(&["x = double.NaN;", "v = double.NaN;", "return;"]),
            Language::GdScript => self.lines(&["return [NAN, NAN]"]),
        }
    }

    fn comment(&mut self, text: &str) {
        let line = format!("{} {text}", self.dialect().comment);
        self.lines(&[line.trim_end()]);
    }

    /// Adds lines at the present depth.
    fn lines(&mut self, lines: &[&str]) {
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

/// A template with its places filled in.
fn filled(template: &str, name: &str, value: &str) -> String {
    template.replace("NAME", name).replace("VALUE", value)
}
