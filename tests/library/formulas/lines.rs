//! Writes the formula of a card as lines of a step, which the reader of all lines reads.

use std::collections::{BTreeMap, BTreeSet};

use regatta::sim::law::StepText;

/// Passes over a formula until its implicit equations hold.
const MAX_PASSES: usize = 200;
/// The name of a line's value for what the two sides of all equations differ by.
pub(crate) const RESIDUAL: &str = "x";

pub(crate) type Values<T = f64> = BTreeMap<String, T>;

/// A step of a method, on which its formula is evaluated.
#[derive(Clone)]
pub(crate) struct Step {
    pub(crate) substeps: u32,
    /// The values known before the formula: times, states, settings.
    pub(crate) known: Values,
    /// The state after the step: the values of `q′` and `v′`.
    pub(crate) end: [f64; 2],
    /// The values of the formula's lines at the end of the step before.
    pub(crate) before: Values,
}

/// A component of a pair of position and velocity. For matrices it is along an eigenvector of `∂f/∂y`, where a matrix
/// is a number.
#[derive(Clone, Copy)]
enum Part {
    Position,
    Velocity,
    Mode(usize),
}

impl Part {
    fn suffix(self) -> &'static str {
        ["q", "v", "0", "1"][match self {
            Part::Position => 0,
            Part::Velocity => 1,
            Part::Mode(mode) => 2 + mode,
        }]
    }
}

pub(crate) fn acceleration(t: f64, q: f64, v: f64) -> f64 {
    2.0 * (1.3 * t).sin() - 4.0 * q.sin() - 0.6 * v - 0.05 * v * v * v
}

/// The same in lines.
fn accelerated(t: &str, q: &str, v: &str) -> String {
    format!("(2*sin(1.3*({t})) - 4*sin({q}) - 0.6*({v}) - 0.05*({v})^3)")
}

/// The eigenvalues of `∂f/∂y`.
fn eigenvalues([q, v]: [f64; 2]) -> [f64; 2] {
    let [by_q, by_v] = [-4.0 * q.cos(), -0.6 - 0.15 * v * v];
    [1.0, -1.0].map(|sign| (by_v + sign * (by_v * by_v + 4.0 * by_q).sqrt()) / 2.0)
}

/// Splits at a separator that is not in parentheses.
fn split<'a>(text: &'a str, separator: &str) -> Vec<&'a str> {
    let (mut depth, mut start, mut parts) = (0, 0, Vec::new());
    for (at, c) in text.char_indices() {
        depth += i32::from(c == '(') - i32::from(c == ')');
        if depth == 0 && text[at..].starts_with(separator) && at >= start {
            parts.push(&text[start..at]);
            start = at + separator.len();
        }
    }
    parts.push(&text[start..]);
    parts
}

/// The name at the start of the text: a word of several letters, or a letter with its marks.
fn name(text: &str) -> &str {
    if let Some(whole) = ["∂f/∂y", "∂a/∂v"].iter().find(|whole| text.starts_with(**whole)) {
        return whole;
    }
    let letters = text.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(text.len());
    if letters > 1 {
        return &text[..letters];
    }
    let is_mark = |c: char| "₀₁₂₃₄₅₆₇₈₉₋ᵢⱼₜ′½".contains(c);
    let Some(first) = text.chars().next().filter(|c| c.is_alphabetic() && !is_mark(*c)) else {
        return "";
    };
    let rest = text[first.len_utf8()..].trim_start_matches(is_mark);
    &text[..text.len() - rest.len()]
}

/// Follower and engine methods write the position differently.
fn canonical(name: &str) -> String {
    name.replace('x', "q")
}

/// The condition of a line and its statements, one for each stage `i` and with sums over all stages `j` written out.
fn statements(line: &str) -> (&str, Vec<String>) {
    let line = line.trim_start_matches("n times: ").trim_start_matches("then ");
    let conditions = ["if ", "else: ", "the first time: "];
    let (condition, line) = match line.split_once(": ") {
        Some(parts) if conditions.iter().any(|word| line.starts_with(word)) => parts,
        _ => ("", line),
    };
    let stages = |text: &str, mark: char, to: u32| -> Vec<String> {
        let stage = |n| char::from_u32(0x2080 + n).unwrap().to_string();
        (1..=to).map(|n| text.replace(mark, &stage(n))).collect()
    };
    let (mut all, parts) = (Vec::new(), split(line, ", "));
    for (n, part) in parts.iter().enumerate().filter(|(_, part)| !part.starts_with("i = 1 … ")) {
        let part = part.trim_end_matches(" if the error is small").split(": ").next().unwrap();
        let last = parts.get(n + 1).and_then(|next| next.strip_prefix("i = 1 … "));
        let each = last.map_or(vec![part.to_owned()], |to| stages(part, 'ᵢ', to.parse().unwrap()));
        all.extend(each.iter().map(|one| match one.split_once("Σ ") {
            None => one.clone(),
            Some((before, sum)) => {
                let length = sum.find([')', '|']).unwrap_or(sum.len());
                let sum = stages(&sum[..length], 'ⱼ', 7).join(" + ") + ")" + &sum[length..];
                format!("{before}({sum}")
            }
        }));
    }
    (condition, all)
}

/// A formula on a step.
struct Formula<'a> {
    step: &'a Step,
    lines: Vec<(&'a str, Vec<String>)>,
    parts: [Part; 2],
    functions: BTreeMap<String, (Vec<String>, String)>,
    /// The names to which the formula gives values, and those of pairs and matrices.
    assigned: BTreeSet<String>,
    pairs: BTreeSet<String>,
}

impl<'a> Formula<'a> {
    fn new(formula: &[&'a str], step: &'a Step) -> Self {
        let is_coupled = formula.concat().contains("∂f/∂y");
        let mut this = Self {
            step,
            lines: formula.iter().map(|line| statements(line)).collect(),
            parts: match is_coupled {
                true => [Part::Mode(0), Part::Mode(1)],
                false => [Part::Position, Part::Velocity],
            },
            functions: BTreeMap::new(),
            assigned: BTreeSet::new(),
            pairs: ["y", "y′", "y₋₁", "∂f/∂y"].map(String::from).into(),
        };
        let all: Vec<String> = this.lines.iter().flat_map(|(_, all)| all.clone()).collect();
        let equations: Vec<_> = all.iter().filter_map(|one| one.split_once(" = ")).collect();
        // A name may be used before it is given a value.
        for (left, right) in equations.iter().chain(&equations) {
            let whole = name(left);
            let inputs = left[whole.len()..].strip_prefix('(').and_then(|l| l.strip_suffix(')'));
            if whole == *left && !["q′", "v′", "y′"].contains(&&*canonical(left)) {
                this.assigned.insert(canonical(left));
                if this.is_pair(right) {
                    this.pairs.insert(canonical(left));
                }
            } else if let Some(inputs) = inputs.filter(|_| !whole.is_empty()) {
                let inputs = inputs.split(", ").map(canonical).collect();
                this.functions.insert(whole.to_owned(), (inputs, (*right).to_owned()));
            }
        }
        this
    }

    fn is_pair(&self, text: &str) -> bool {
        let names = text.char_indices().map(|(at, _)| canonical(name(&text[at..])));
        names.into_iter().any(|name| self.pairs.contains(&name))
    }

    fn parts_of(&self, is_pair: bool) -> &[Part] {
        &self.parts[..if is_pair { 2 } else { 1 }]
    }

    /// The name in lines.
    fn word(&self, name: &str, part: Part) -> String {
        let letter = |c: char| match c.is_ascii() {
            true => c.to_string(),
            false => format!("u{:x}", c as u32),
        };
        let word = format!("n_{}", name.chars().map(letter).collect::<String>());
        let is_pair = self.pairs.contains(name);
        if is_pair { format!("{word}_{}", part.suffix()) } else { word }
    }

    fn pair(&self, [q, v]: [String; 2], part: Part) -> String {
        match part {
            Part::Position => q,
            Part::Velocity => v,
            Part::Mode(mode) => {
                let start = ["q", "v"].map(|name| self.step.known[name]);
                let along = eigenvalues(start)[mode] + 0.6 + 0.15 * start[1] * start[1];
                format!("(({along:?})*({q}) + {v})")
            }
        }
    }

    fn value(&self, name: &str, part: Part) -> String {
        let Step { known, end, before, .. } = self.step;
        let of = |name: &str| self.value(name, part);
        let number = |value: f64| format!("({value:?})");
        let is_assigned = |name: &str| self.assigned.contains(name);
        match name {
            "y" => self.pair(["q", "v"].map(of), part),
            "y′" => self.pair(end.map(number), part),
            "y₋₁" => self.pair(["q₋₁", "v₋₁"].map(of), part),
            "q′" => number(end[0]),
            "v′" => number(end[1]),
            "I" => "1".to_owned(),
            "∂f/∂y" => {
                let Part::Mode(mode) = part else { unreachable!("the parts of matrices") };
                number(eigenvalues(["q", "v"].map(|name| known[name]))[mode])
            }
            "∂a/∂v" => format!("(-0.6 - 0.15*{}^2)", of("v")),
            "a" if !is_assigned("a") => {
                let now = accelerated(&of("t"), &of("q"), &of("v"));
                let carried = before.get(&self.word("a′", part)).filter(|_| is_assigned("a′"));
                carried.map_or(now, |carried| number(*carried))
            }
            _ if is_assigned(name) || ["q", "v"].contains(&name) => self.word(name, part),
            _ if let Some(known) = known.get(name) => number(*known),
            _ => {
                let before =
                    name.strip_suffix("₋₁").and_then(|it| before.get(&self.word(it, part)));
                number(before.copied().unwrap_or(0.0))
            }
        }
    }

    fn call(&self, name: &str, given: &[&str], part: Part, inputs: &Values<String>) -> String {
        let given_in = |n: usize, part| self.expression(given[n], part, inputs);
        let all = || (0..given.len()).map(|n| given_in(n, part));
        if let Some((names, text)) = self.functions.get(name) {
            let inputs = names.iter().cloned().zip(all()).collect();
            return format!("({})", self.expression(text, part, &inputs));
        }
        match (name, &all().collect::<Vec<_>>()[..]) {
            ("f", [t, _]) => {
                let [q, v] = [Part::Position, Part::Velocity].map(|part| given_in(1, part));
                self.pair([format!("({v})"), accelerated(t, &q, &v)], part)
            }
            ("a", [t, q, v]) => accelerated(t, q, v),
            ("ns", [t]) => format!("(ceil(({t})*1e9 - 0.5)/1e9)"),
            (_, all) => format!("{name}({})", all.join(", ")),
        }
    }

    fn expression(&self, text: &str, part: Part, inputs: &Values<String>) -> String {
        let (mut out, mut rest, mut open, mut is_value) = (String::new(), text, Vec::new(), false);
        let number_of = |text: &str| {
            let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
            text[..end].to_owned()
        };
        while let Some(sign) = rest.chars().next() {
            let (number, name) = (number_of(rest), name(rest));
            let power = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|digit| digit == c);
            let powers: Vec<usize> = rest.chars().map_while(power).collect();
            let closes = sign == ')' || sign == '|' && open.last() == Some(&'|');
            let begins = sign.is_alphanumeric() || "√∛∂(|".contains(sign);
            if is_value && powers.is_empty() && begins && !closes {
                out.push('*');
            }
            is_value = (is_value || sign != ' ') && !"+−/,>≠".contains(sign);
            let mut length = sign.len_utf8();
            match sign {
                '−' => out.push('-'),
                '≠' => out.push_str("!="),
                '½' => out.push_str("0.5"),
                '⅓' => out.push_str("(1/3)"),
                '⅔' => out.push_str("(2/3)"),
                '¼' => out.push_str("0.25"),
                '¾' => out.push_str("0.75"),
                '√' if rest[length..].starts_with('(') => {
                    (length, is_value) = (length + 1, false);
                    out.push_str("sqrt(");
                    open.push('(');
                }
                '√' | '∛' => {
                    let number = number_of(&rest[length..]);
                    length += number.len();
                    out += &format!("{number}^(1/{})", if sign == '√' { 2 } else { 3 });
                }
                '(' | '|' if !closes => {
                    out.push_str(if sign == '|' { "abs(" } else { "(" });
                    (open, is_value) = ([open, vec![sign]].concat(), false);
                }
                ')' | '|' => {
                    out.push(')');
                    open.pop();
                }
                _ if !powers.is_empty() => {
                    length = rest.chars().take(powers.len()).map(char::len_utf8).sum();
                    out.push('^');
                    out.extend(powers.iter().map(ToString::to_string));
                }
                _ if !number.is_empty() => {
                    length = number.len();
                    out.push_str(&number);
                }
                _ if rest.starts_with("e^(") => {
                    (length, is_value) = ("e^(".len(), false);
                    out.push_str("exp(");
                    open.push('(');
                }
                _ if !name.is_empty() && rest[name.len()..].starts_with('(') => {
                    let inside = split(&rest[name.len()..], ")")[0];
                    length = name.len() + inside.len() + 1;
                    out.push_str(&self.call(name, &split(&inside[1..], ", "), part, inputs));
                }
                _ if !name.is_empty() => {
                    length = name.len();
                    let name = canonical(name);
                    let input = inputs.get(&name).map(|input| format!("({input})"));
                    out.push_str(&input.unwrap_or_else(|| self.value(&name, part)));
                }
                _ => out.push(sign),
            }
            rest = &rest[length..];
        }
        out
    }

    /// The lines of a statement.
    fn statement(&self, text: &str) -> Vec<String> {
        let plain = |text: &str| self.expression(text, self.parts[0], &Values::new());
        if let Some(part) = text.strip_prefix("drift ").map(plain) {
            let moved = format!("n_q = n_q + ({part})*{}*n_v", plain("h"));
            return vec![format!("n_drifted = n_drifted + {part}"), moved];
        }
        if let Some(part) = text.strip_prefix("kick ").map(plain) {
            let at = format!("{} + n_drifted*{}", plain("t"), plain("h"));
            let pushed = accelerated(&at, "n_q", "n_v");
            return vec![format!("n_v = n_v + ({part})*{}*{pushed}", plain("h"))];
        }
        if let Some(most) = text.strip_prefix("|v| ≤ ").map(plain) {
            return vec![format!("n_v = max(min(n_v, {most}), -({most}))")];
        }
        let Some((left, right)) = text.split_once(" = ") else { panic!("no equation: {text}") };
        if self.functions.contains_key(name(left)) && name(left) != left {
            return Vec::new();
        }
        let is_pair = self.is_pair(left) || self.is_pair(right);
        let line = |part: &Part| {
            let [to, value] = [left, right].map(|it| self.expression(it, *part, &Values::new()));
            match self.assigned.contains(&canonical(left)) {
                true => format!("{to} = {value}"),
                false => differs(&to, &value),
            }
        };
        self.parts_of(is_pair).iter().map(line).collect()
    }

    /// Writes a line of the formula, in this turn of its loop.
    fn write(&self, (condition, all): &(&str, Vec<String>), turn: u32, out: &mut String) {
        let lines = all.iter().flat_map(|one| self.statement(one)).collect::<Vec<_>>().join("\n");
        let holds = |text: &str| self.expression(text, self.parts[0], &Values::new());
        match (*condition, &split(condition.trim_start_matches("if "), " = ")[..]) {
            ("the first time", _) if turn > 0 => {}
            ("" | "the first time", _) => *out += &format!("\n{lines}"),
            ("else", _) => *out += &format!(" else {{\n{lines}\n}}"),
            (_, [left, right]) => {
                let [left, right] = [left, right].map(|side| holds(side));
                *out +=
                    &format!("\nif {left} and {right} or not ({left} or {right}) {{\n{lines}\n}}");
            }
            (condition, _) => {
                *out += &format!("\nif {} {{\n{lines}\n}}", holds(&condition["if ".len()..]));
            }
        }
    }

    fn text(&self, formula: &[&str]) -> String {
        let Step { known, end, substeps, .. } = self.step;
        let mut out = "x = 0\nn_drifted = 0".to_owned();
        for name in self.assigned.iter().map(String::as_str).chain(["q", "v"]) {
            for word in
                self.parts_of(self.pairs.contains(name)).iter().map(|it| self.word(name, *it))
            {
                // A name that is read first has its value of the pass before.
                let carried = || format!("\nn_seen = {word}");
                out += &known.get(name).map_or_else(carried, |it| format!("\n{word} = ({it:?})"));
            }
        }
        let begins = |word: &str| formula.iter().position(|line| line.starts_with(word));
        let then = begins("then ").unwrap_or(formula.len());
        let (before, rest) = self.lines.split_at(begins("n times: ").unwrap_or(then));
        let (turns, after) = rest.split_at(then - before.len());
        let turns = (0..*substeps).flat_map(|turn| turns.iter().map(move |line| (line, turn)));
        for (line, turn) in before
            .iter()
            .map(|line| (line, 0))
            .chain(turns)
            .chain(after.iter().map(|line| (line, 0)))
        {
            self.write(line, turn, &mut out);
        }
        let all = self.lines.iter().flat_map(|(_, all)| all);
        let ends: Vec<&str> = all.filter_map(|one| Some(one.split_once(" = ")?.0)).collect();
        let halves = [("n_q", &["x′", "q′", "y′"][..]), ("n_v", &["v′", "y′"])];
        for ((word, names), end) in halves.into_iter().zip(end) {
            if !ends.iter().any(|left| names.iter().any(|name| left.contains(name))) {
                out += &format!("\n{}", differs(word, &format!("{end:?}")));
            }
        }
        out
    }
}

/// The line that adds what two sides differ by, relative to the right one or to 1.
fn differs(left: &str, right: &str) -> String {
    format!("x = x + abs({left} - ({right})) / max(1, abs({right}))")
}

/// The values of the lines of a formula on a step, when they no longer change.
pub(crate) fn evaluated(formula: &[&str], step: &Step) -> Values {
    let text = Formula::new(formula, step).text(formula);
    let read = StepText::read(&text).unwrap_or_else(|fault| panic!("{fault:?} of {text}"));
    let (mut registers, mut last) = (read.registers(), Values::new());
    for _ in 0..MAX_PASSES {
        read.step(&mut registers, 1.0, 0.0);
        let carried = read.carried().iter().enumerate();
        let values = carried.map(|(n, it)| (it.name.clone(), read.value(&registers, n))).collect();
        if std::mem::replace(&mut last, values) == last {
            break;
        }
    }
    last
}
