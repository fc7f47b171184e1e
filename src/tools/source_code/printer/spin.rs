//! Prints the step of a free spin as a function of its angular velocity, its attitude, its moments and the step.

use super::{File, Printer};
use crate::sim::law::{Line, StepBody};
use crate::source_code::dialect::Language;

const OMEGA: [&str; 3] = ["wx", "wy", "wz"];
const ATTITUDE: [&str; 4] = ["qw", "qx", "qy", "qz"];
const MOMENTS: [&str; 3] = ["i1", "i2", "i3"];

/// Whether the step depends on the moments.
pub(in crate::source_code) fn takes_moments(body: StepBody<'_>) -> bool {
    let name = body.names().iter().position(|name| name == MOMENTS[0]);
    name.is_some_and(|name| body.lines().iter().any(|line| line.mentions(name)))
}

/// Returns the names in a template, with commas between.
fn each(names: &[&str], template: &str) -> String {
    let each = names.iter().map(|name| template.replace("NAME", name));
    each.collect::<Vec<_>>().join(", ")
}

impl Printer {
    pub(super) fn print_spin(&mut self, file: &File<'_>) {
        let (names, number, language) = (file.step(), self.number_type(), self.language);
        let body = names.body;
        let assigns = |wanted: &str| {
            let is_it = |line: &Line| matches!(line, Line::Assign { name, .. } if body.names()[*name] == wanted);
            body.lines().iter().any(is_it)
        };
        let mut groups = vec![("w", &OMEGA[..]), ("q", &ATTITUDE)];
        groups.extend(takes_moments(body).then_some(("i", &MOMENTS[..])));
        let parameter = |(group, all): &(&str, &[&str])| {
            let (size, is_given) = (all.len(), *group == "i");
            match language {
                Language::Rust => {
                    let changed = if assigns(all[0]) { "mut NAME" } else { "NAME" };
                    format!("[{}]: [{number}; {size}]", each(all, changed))
                }
                Language::C if is_given => format!("const {number} {group}[{size}]"),
                Language::C => format!("{number} {group}[{size}]"),
                Language::CSharp if is_given => each(all, &format!("{number} NAME")),
                Language::CSharp => each(all, &format!("ref {number} NAME")),
                Language::GdScript => each(all, "NAME: float"),
                Language::JavaScript => format!("[{}]", each(all, "NAME")),
                Language::Lua => each(all, "NAME"),
            }
        };
        let mut parameters: Vec<String> = groups.iter().map(parameter).collect();
        parameters.push(match language {
            Language::Rust => format!("h: {number}"),
            Language::C | Language::CSharp => format!("{number} h"),
            Language::GdScript => "h: float".into(),
            Language::JavaScript | Language::Lua => "h".into(),
        });
        let name = (self.dialect.spelt)(file.snake);
        let (open, close) = match language {
            Language::Rust => {
                (format!("pub fn {name}("), format!(") -> ([{number}; 3], [{number}; 4]) {{"))
            }
            Language::C => (format!("void {name}("), ") {".into()),
            Language::CSharp => ("public static void Step(".into(), ")\n{".into()),
            Language::GdScript => (format!("static func {name}("), ") -> Array:".into()),
            Language::JavaScript => (format!("function {name}("), ") {".into()),
            Language::Lua => (format!("local function {name}("), ")".into()),
        };
        self.signature(&open, &parameters, &close);
        self.depth += 1;
        let numbered = |(group, all): &(&str, &[&str]), template: &str| {
            let one = |(n, name): (usize, &&str)| {
                template.replace("NAME", name).replace("AT", &format!("{group}[{n}]"))
            };
            all.iter().enumerate().map(one).collect::<Vec<_>>()
        };
        if language == Language::C {
            for group in &groups {
                let constant = if group.0 == "i" { "const " } else { "" };
                let each = numbered(group, "NAME = AT").join(", ");
                self.push_lines(&[&format!("{constant}{number} {each};")]);
            }
        }
        self.print_body(names);
        let [omega, attitude] = [each(&OMEGA, "NAME"), each(&ATTITUDE, "NAME")];
        match language {
            Language::Rust => self.push_lines(&[&format!("([{omega}], [{attitude}])")]),
            Language::C => {
                for group in &groups[..2] {
                    self.push_lines(&[&numbered(group, "AT = NAME;").join(" ")]);
                }
            }
            Language::CSharp => {}
            Language::GdScript => self.push_lines(&[&format!("return [{omega}, {attitude}]")]),
            Language::JavaScript => {
                self.push_lines(&[&format!("return [[{omega}], [{attitude}]];")]);
            }
            Language::Lua => self.push_lines(&[&format!("return {omega}, {attitude}")]),
        }
        self.depth -= 1;
        self.print_end();
    }
}
