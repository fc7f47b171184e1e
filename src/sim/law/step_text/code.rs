//! Translates the lines of a step to the language of `assets/methods`, which has a printer for other languages.

use super::method::Function;
use super::reader::FIELD;
use super::{BUILT_IN, Carried, H, Line, StepText, V};
use crate::sim::law::expression::Expression;
use crate::sim::law::function::{FUNCTIONS, Meaning, STEP_FUNCTIONS};
use crate::sim::law::op::{INFIXES, Infix, Level, Op};

/// The lines of a step, as code.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepCode {
    /// The inputs of a method, each with its description.
    pub inputs: Vec<String>,
    /// Functions that the lines call, which are their own or those that some languages lack.
    pub functions: Vec<String>,
    /// The fields of `memory`, each with its first value.
    pub memory: Vec<(String, f64)>,
    /// The lines. The carried numbers of the text are fields of `memory`, and the length of a step is called
    /// [`STEP`](Self::STEP).
    pub lines: Vec<String>,
}

impl StepCode {
    /// The name of the step length in a rule.
    pub const STEP: &str = "step_s";

    /// Returns the code of a method in the language of `assets/methods`.
    pub(in crate::sim) fn method(&self) -> String {
        let Self { inputs, functions, memory, lines } = self;
        let mut text: String = inputs.iter().map(|input| format!("takes {input}\n")).collect();
        text.extend(memory.iter().map(|(field, start)| match start.is_nan() {
            true => format!("memory {field} = nan\n"),
            false => format!("memory {field} = {start:?}\n"),
        }));
        text.extend(functions.iter().map(|function| format!("\n{function}")));
        text.extend(lines.iter().map(|line| format!("\n{line}")));
        text + "\n"
    }
}

/// Separates the arguments of a call until the call is written. No name or number contains it.
const ARGUMENTS: &str = "\n";

/// The maximum number of bytes of an expression.
const MAX_CODE_BYTES: usize = 4096;

/// Functions that some languages lack, written out.
const WRITTEN_OUT: [(&str, &str); 4] = [
    (
        "sign",
        "fn sign(x) {\n    if 0.0 < x {\n        return 1.0\n    }\n    if x < 0.0 {\n        return -1.0\n    }\n    return 0.0\n}\n",
    ),
    ("step", "fn step(x) {\n    if x < 0.0 {\n        return 0.0\n    }\n    return 1.0\n}\n"),
    (
        "round",
        "fn round(x) {\n    var whole = floor(abs(x))\n    if not (abs(x) - whole < 0.5) {\n        whole += 1.0\n    }\n    if x < 0.0 {\n        return -whole\n    }\n    return whole\n}\n",
    ),
    ("hypot", "fn hypot(x, y) {\n    return sqrt(x * x + y * y)\n}\n"),
];

/// Words of the language of `assets/methods`, and names of the code around the lines.
const TAKEN: [&str; 22] = [
    "FRAME_S",
    "before",
    "const",
    "count",
    "else",
    "fail",
    "fn",
    "if",
    "is_nan",
    "let",
    "memory",
    "nan",
    "refused",
    "return",
    "shown",
    "stay",
    "takes",
    "unspent",
    "use",
    "var",
    "while",
    StepCode::STEP,
];

/// Code with the level of its outermost operator; `None` for a name, a number or a call.
type LevelledCode = (String, Option<Level>);

impl Carried {
    /// Returns the name of the number in code, which is a field of `memory` unless the number is `x` or `v`.
    pub fn field(&self) -> String {
        unreserved_name(self.name.strip_prefix(FIELD).unwrap_or(&self.name))
    }
}

impl StepText {
    /// Translates the lines to code.
    ///
    /// # Errors
    /// The construct that has no equivalent in other languages, as a clause.
    pub fn code(&self) -> Result<StepCode, String> {
        let memory = self.carried.iter().filter(|carried| carried.input > V);
        let memory = memory.map(|carried| (carried.field(), carried.start)).collect();
        let mut code = StepCode { memory, ..StepCode::default() };
        if self.method_at.is_some() {
            let about = "a(x, v): the acceleration at position x and velocity v".to_owned();
            code.inputs.extend((!self.calls().is_empty()).then_some(about));
            code.inputs.extend(self.takes_rate().then(|| "target: the target of x".to_owned()));
            let own = self.inputs.iter().map(|taken| {
                let line = self.source[taken.span.start..].lines().next().unwrap_or_default();
                let about =
                    line.split_once(": ").map_or("a setting of the body", |(_, about)| about);
                format!("{}: {}", &self.source[taken.span.clone()], about.trim())
            });
            code.inputs.extend(own);
        }
        for function in &self.functions {
            let mut body = StepCode::default();
            let scope = Scope { text: self, function: Some(function) };
            scope.block(&function.lines, &mut body)?;
            code.functions.append(&mut body.functions);
            let mut names = function.names.iter();
            let inputs = function.inputs.iter().map(|is_acceleration| match is_acceleration {
                true => "a(x, v)".to_owned(),
                false => names.next().map_or_else(String::new, |name| unreserved_name(name)),
            });
            let inputs = inputs.collect::<Vec<_>>().join(", ");
            let name = unreserved_name(&function.name);
            let lines: String = body.lines.iter().map(|line| format!("    {line}\n")).collect();
            code.functions.push(format!("fn {name}({inputs}) {{\n{lines}}}\n"));
        }
        Scope { text: self, function: None }.block(&self.lines, &mut code)?;
        Ok(code)
    }

    fn takes_rate(&self) -> bool {
        self.law_order().is_some()
    }
}

/// The names of the step, or of one of its functions.
#[derive(Clone, Copy)]
struct Scope<'t> {
    text: &'t StepText,
    function: Option<&'t Function>,
}

impl Scope<'_> {
    /// Translates lines, and declares names where they first get a value, or above all lines if that is in a block.
    fn block(self, all: &[Line], code: &mut StepCode) -> Result<(), String> {
        let names = self.function.map_or(&self.text.names, |function| &function.names);
        let mut is_known: Vec<bool> = (0..names.len()).map(|name| self.is_state(name)).collect();
        let mut depth = 0;
        let mut body = Vec::new();
        for line in all {
            body.push(match line {
                Line::If(condition) | Line::While(condition) => {
                    depth += 1;
                    let word = if matches!(line, Line::If(_)) { "if" } else { "while" };
                    format!("{word} {} {{", self.expression(condition, code)?)
                }
                Line::Else => "} else {".into(),
                Line::End => {
                    depth -= 1;
                    "}".into()
                }
                Line::Return(value) => format!("return {}", self.expression(value, code)?),
                Line::Stop { fails: true } => "fail".into(),
                Line::Stop { fails: false } => "stay".into(),
                Line::Assign { name, joins, value } => {
                    let (value, written) = (self.expression(value, code)?, self.name(*name));
                    if is_known[*name] {
                        format!("{written} {joins}= {value}")
                    } else {
                        is_known[*name] = true;
                        let assigns = |line: &&Line| {
                            matches!(line, Line::Assign { name: other, .. } if other == name)
                        };
                        match (depth, all.iter().filter(assigns).count()) {
                            (0, 1) => format!("let {written} = {value}"),
                            (0, _) => format!("var {written} = {value}"),
                            _ => {
                                code.lines.push(format!("var {written} = 0.0"));
                                format!("{written} = {value}")
                            }
                        }
                    }
                }
            });
        }
        code.lines.extend(body);
        Ok(())
    }

    /// Whether a name has a value before the first line.
    fn is_state(self, name: usize) -> bool {
        let text = self.text;
        match self.function {
            Some(function) => name < function.inputs.iter().filter(|is| !**is).count(),
            None => {
                name < BUILT_IN.len()
                    || text.carried.iter().any(|carried| carried.input == name)
                    || text.inputs.iter().any(|taken| taken.name == name)
            }
        }
    }

    /// Whether a name is carried in the memory.
    fn is_carried(self, name: usize) -> bool {
        self.text.carried.iter().any(|carried| carried.input == name)
    }

    fn name(self, index: usize) -> String {
        if let Some(function) = self.function {
            return unreserved_name(&function.names[index]);
        }
        let name = &self.text.names[index];
        match index {
            H if self.text.method_at.is_none() => StepCode::STEP.into(),
            _ if index < BUILT_IN.len() => name.clone(),
            _ if self.is_carried(index) => {
                format!("memory.{}", unreserved_name(name.strip_prefix(FIELD).unwrap_or(name)))
            }
            _ if name == "a" && self.text.method_at.is_some() => "a_own".into(),
            _ => unreserved_name(name),
        }
    }

    fn expression(self, expression: &Expression, code: &mut StepCode) -> Result<String, String> {
        let mut written: Vec<LevelledCode> = Vec::new();
        for node in &expression.nodes {
            let operand = |n: usize| &written[node.arguments()[n]];
            let call = |name: &str| {
                let all: Vec<&str> = node.arguments().iter().map(|n| &*written[*n].0).collect();
                (format!("{name}({})", all.join(", ")), None)
            };
            let infix = INFIXES.iter().find(|infix| infix.op == node.op && !infix.is_swapped);
            let new: LevelledCode = match (node.op, infix) {
                (Op::Number, _) if node.number.is_nan() => ("nan".into(), None),
                (Op::Number, _) => (format!("{:?}", node.number), None),
                // The arguments so far, in order.
                (Op::Argument, _) => {
                    let all: Vec<&str> = node.arguments().iter().map(|n| &*written[*n].0).collect();
                    (all.join(ARGUMENTS), None)
                }
                (Op::Apply, _) => {
                    let function = &self.text.functions[node.index];
                    let given = node.arguments().first().map_or("", |n| &*written[*n].0);
                    let mut given = given.split(ARGUMENTS);
                    let all = function.inputs.iter().map(|is_acceleration| {
                        if *is_acceleration { "a" } else { given.next().unwrap_or_default() }
                    });
                    let all = all.collect::<Vec<_>>().join(", ");
                    (format!("{}({all})", unreserved_name(&function.name)), None)
                }
                (Op::Switch(_), Some(Infix { sign: "!=", .. }))
                    if node.arguments()[0] == node.arguments()[1] =>
                {
                    (format!("is_nan({})", operand(0).0), None)
                }
                (Op::Input, _) => (self.name(node.index), None),
                (Op::Power, _) => call("pow"),
                (Op::Call, _) => {
                    let [x, v] = [operand(0), operand(1)].map(|(text, _)| text);
                    (format!("a({x}, {v})"), None)
                }
                (Op::Negate, _) => {
                    (format!("-{}", bracketed(operand(0), Some(Level::Product))), Some(Level::Sum))
                }
                (Op::Not, _) => {
                    (format!("not {}", bracketed(operand(0), Some(Level::Power))), None)
                }
                (_, Some(infix)) => {
                    let left = match operand(0) {
                        (text, Some(level)) if *level < infix.level => format!("({text})"),
                        (text, _) => text.clone(),
                    };
                    let right = bracketed(operand(1), Some(infix.level));
                    (format!("{left} {} {right}", infix.sign), Some(infix.level))
                }
                (op, None) => {
                    let name = name_of(op).ok_or_else(|| {
                        "`if(…)` and `table(…)` have no words there; write blocks of `if`"
                            .to_owned()
                    })?;
                    let own = WRITTEN_OUT.iter().find(|(function, _)| *function == name);
                    let own = own.map(|(_, text)| (*text).to_owned());
                    let own = own.filter(|text| !code.functions.contains(text));
                    code.functions.extend(own);
                    call(name)
                }
            };
            if new.0.len() > MAX_CODE_BYTES {
                return Err("an expression is too long once its powers are written out".into());
            }
            written.push(new);
        }
        Ok(written.pop().unwrap_or_default().0)
    }
}

/// Returns code as an operand of an operator of level `outside`, in brackets if needed.
fn bracketed((text, level): &LevelledCode, outside: Option<Level>) -> String {
    match level {
        Some(level) if Some(*level) <= outside => format!("({text})"),
        _ => text.clone(),
    }
}

/// Returns the name of the function that an operation calls.
fn name_of(op: Op) -> Option<&'static str> {
    let is_it = |meaning: &Meaning| match (op, meaning) {
        (Op::Smooth(called), Meaning::Smooth(smooth)) => called == smooth,
        (Op::Switch(called), Meaning::Switch(switch)) => called == *switch,
        _ => false,
    };
    let mut functions = FUNCTIONS.iter().chain(&STEP_FUNCTIONS);
    functions.find(|function| is_it(&function.meaning)).map(|function| function.name)
}

/// Returns a name of the text. The name is changed if it is a word there.
fn unreserved_name(name: &str) -> String {
    if TAKEN.contains(&name) { format!("{name}_own") } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use crate::sim::law::StepText;

    fn code(text: &str) -> Vec<String> {
        StepText::read(text).unwrap().code().unwrap().lines
    }

    #[test]
    fn generated_lines_keep_the_necessary_brackets() {
        let text = "v = (v + (target - x) * 0.2) * -0.85; x += v * dt - (1 - (x - 3)) / (2 * 3)";
        let lines = [
            "v = (v + (target - x) * 0.2) * (-0.85)",
            "x += v * step_s - (1.0 - (x - 3.0)) / (2.0 * 3.0)",
        ];
        assert_eq!(code(text), lines);
        let text = "old = x; use = x - prev; if use > 1 or not use == 0 { use = 1; y = 2 } else { y = 3 }; x += use * y^2; prev = old";
        let lines = [
            "var y = 0.0",
            "let old = x",
            "var use_own = x - memory.prev",
            "if 1.0 < use_own or not (use_own == 0.0) {",
            "use_own = 1.0",
            "y = 2.0",
            "} else {",
            "y = 3.0",
            "}",
            "x += use_own * (y * y)",
            "memory.prev = old",
        ];
        assert_eq!(code(text), lines);
        assert_eq!(
            code("x = lerp(x, clamp(target, 0, 1), 0.1)"),
            ["x = x + (min(max(target, 0.0), 1.0) - x) * 0.1"]
        );
        let found =
            StepText::read("v -= sign(v) * hypot(v, sin(x)); v = -v").unwrap().code().unwrap();
        assert_eq!(found.functions.len(), 2);
        assert!(StepText::read("x = if(x < 1, 0, v)").unwrap().code().is_err());
        assert!(StepText::read("x = ((((x^9)^9)^9)^9)^9").unwrap().code().is_err());
    }
}
