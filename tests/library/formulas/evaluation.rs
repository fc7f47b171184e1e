//! Evaluates the formula of a card on a step of its method.

use std::collections::BTreeMap;

use super::value::Value;

/// Passes over a formula until its implicit equations hold.
const MAX_PASSES: usize = 200;

pub(crate) fn acceleration(t: f64, q: f64, v: f64) -> f64 {
    2.0 * (1.3 * t).sin() - 4.0 * q.sin() - 0.6 * v - 0.3 * v * v.abs()
}

pub(crate) type Values = BTreeMap<String, Value>;

/// A step of a method, on which its formula is evaluated.
#[derive(Clone)]
pub(crate) struct Step {
    pub(crate) substeps: u32,
    /// The values known before the formula: times, states, settings.
    pub(crate) known: Values,
    /// The state after the step: the values of `q′` and `v′`.
    pub(crate) end: [f64; 2],
    /// The values of the formula's names at the end of the step before.
    pub(crate) before: Values,
}

/// An evaluation of a formula on a step.
pub(crate) struct Evaluation<'a> {
    step: &'a Step,
    /// The names of this pass, and of the pass before.
    pub(crate) values: Values,
    last_pass: Values,
    functions: BTreeMap<&'a str, (Vec<&'a str>, &'a str)>,
    /// The sum of the drifts so far.
    drifted: f64,
    /// The largest difference of the two sides of an equation.
    pub(crate) residual: f64,
    /// Whether an equation says where position and velocity end; if not, they end where they are at last.
    says: [bool; 2],
    /// Whether the last condition held.
    held: bool,
    carries_a: bool,
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

fn is_mark(c: char) -> bool {
    "₀₁₂₃₄₅₆₇₈₉₋ᵢⱼₜ′½".contains(c)
}

/// The name at the start of the text: a word of several letters, or a letter with its marks.
fn name(text: &str) -> &str {
    for whole in ["∂f/∂y", "∂a/∂v"] {
        if text.starts_with(whole) {
            return whole;
        }
    }
    let letters = text.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(text.len());
    if letters > 1 {
        return &text[..letters];
    }
    let mut chars = text.char_indices();
    match chars.next() {
        Some((_, c)) if c.is_alphabetic() && !is_mark(c) => {}
        _ => return "",
    }
    let end = chars.find(|(_, c)| !is_mark(*c)).map_or(text.len(), |(at, _)| at);
    &text[..end]
}

/// Follower and general methods write the position differently.
fn canonical(name: &str) -> String {
    name.replace('x', "q")
}

impl<'a> Evaluation<'a> {
    fn new(formula: &[&'a str], step: &'a Step) -> Self {
        let carries_a =
            formula.iter().flat_map(|line| split(line, ", ")).any(|s| s.starts_with("a′ ="));
        Self {
            step,
            values: Values::new(),
            last_pass: Values::new(),
            functions: BTreeMap::new(),
            drifted: 0.0,
            residual: 0.0,
            says: [false; 2],
            held: true,
            carries_a,
        }
    }

    /// Evaluates the formula until its values no longer change.
    pub(crate) fn of(formula: &[&'a str], step: &'a Step) -> Self {
        let mut evaluation = Self::new(formula, step);
        for _ in 0..MAX_PASSES {
            evaluation.values = step.known.clone();
            (evaluation.drifted, evaluation.residual, evaluation.says) = (0.0, 0.0, [false; 2]);
            let begins = formula.iter().position(|line| line.starts_with("n times: "));
            let ends = formula.iter().position(|line| line.starts_with("then "));
            let ends = ends.unwrap_or(formula.len());
            let begins = begins.unwrap_or(ends);
            evaluation.lines(&formula[..begins], 0);
            for n in 0..step.substeps {
                evaluation.lines(&formula[begins..ends], n);
            }
            evaluation.lines(&formula[ends..], 0);
            let values = evaluation.values.clone();
            if std::mem::replace(&mut evaluation.last_pass, values.clone()) == values {
                break;
            }
        }
        for (half, name) in ["q", "v"].into_iter().enumerate() {
            if !evaluation.says[half] {
                let end = Value::Number(step.end[half]);
                evaluation.compare(evaluation.values[name].clone(), end);
            }
        }
        evaluation
    }

    fn lines(&mut self, lines: &[&'a str], turn: u32) {
        for line in lines {
            let line = line.trim_start_matches("n times: ").trim_start_matches("then ");
            self.line(line, turn);
        }
    }

    fn line(&mut self, line: &'a str, turn: u32) {
        let is_conditional =
            ["if ", "else: ", "the first time: "].iter().any(|word| line.starts_with(word));
        let (condition, statements) = match line.split_once(": ") {
            Some(parts) if is_conditional => parts,
            _ => ("", line),
        };
        let goes_on = match condition {
            "" => true,
            "the first time" => turn == 0,
            "else" => !self.held,
            condition => {
                self.held = self.holds(condition.trim_start_matches("if "));
                self.held
            }
        };
        if !goes_on {
            return;
        }
        let statements = split(statements, ", ");
        for (i, statement) in statements.iter().enumerate() {
            if let Some(range) = statements.get(i + 1).and_then(|s| s.strip_prefix("i = 1 … ")) {
                for index in 1..=range.parse().expect("a number of stages") {
                    self.values.insert("i".into(), Value::Number(f64::from(index)));
                    self.statement(statement);
                }
                return;
            }
            self.statement(statement);
        }
    }

    fn holds(&mut self, condition: &'a str) -> bool {
        if let [left, right] = split(condition, " = ")[..] {
            let inside = |side: &'a str| side.trim_matches(['(', ')']);
            return self.holds(inside(left)) == self.holds(inside(right));
        }
        match (&split(condition, " > ")[..], &split(condition, " ≠ ")[..]) {
            ([left, right], _) => self.number(left) > self.number(right),
            (_, [left, right]) => self.number(left) != self.number(right),
            _ => panic!("no condition: {condition}"),
        }
    }

    fn number(&mut self, text: &'a str) -> f64 {
        self.expression(text).number()
    }

    fn compare(&mut self, left: Value, right: Value) {
        let size = right.largest().max(1.0);
        let off = left.minus(&right).largest() / size;
        self.residual = if off <= self.residual { self.residual } else { off };
    }

    fn statement(&mut self, statement: &'a str) {
        let statement = statement.trim_end_matches(" if the error is small");
        let statement = statement.split(": ").next().unwrap_or_default();
        if let Some(part) = statement.strip_prefix("drift ") {
            let part = self.number(part);
            self.drifted += part;
            let h = self.value("h").number();
            let q = self.values["q"].number() + part * h * self.values["v"].number();
            self.values.insert("q".into(), Value::Number(q));
        } else if let Some(part) = statement.strip_prefix("kick ") {
            let part = self.number(part);
            let [t, h, q, v] = ["t", "h", "q", "v"].map(|name| self.value(name).number());
            let v = v + part * h * acceleration(t + self.drifted * h, q, v);
            self.values.insert("v".into(), Value::Number(v));
        } else if let Some(most) = statement.strip_prefix("|v| ≤ ") {
            let (v, most) = (self.values["v"].number(), self.number(most));
            self.values.insert("v".into(), Value::Number(v.clamp(-most, most)));
        } else {
            let [left, right] = split(statement, " = ")[..] else {
                panic!("no equation: {statement}")
            };
            let (whole, end) = (name(left), canonical(left));
            let inputs = left[whole.len()..].strip_prefix('(').and_then(|l| l.strip_suffix(')'));
            let is_end = ["q′", "v′", "y′"].contains(&&*end);
            match inputs {
                Some(inputs) if !whole.is_empty() => {
                    self.functions.insert(whole, (inputs.split(", ").collect(), right));
                }
                None if whole == left && !is_end => {
                    let value = self.expression(right);
                    let name = self.indexed(left);
                    self.values.insert(name, value);
                }
                _ => {
                    self.says[0] |= end != "v′";
                    self.says[1] |= end != "q′";
                    let (left, right) = (self.expression(left), self.expression(right));
                    self.compare(left, right);
                }
            }
        }
    }

    /// The name with the number of its stage in place of `ᵢ` and `ⱼ`.
    fn indexed(&self, name: &str) -> String {
        let mut name = canonical(name);
        for (mark, index) in [('ᵢ', "i"), ('ⱼ', "j")] {
            if name.contains(mark) {
                let index = self.values[index].number() as u32;
                name = name.replace(mark, &char::from_u32(0x2080 + index).unwrap().to_string());
            }
        }
        name
    }

    fn value(&self, name: &str) -> Value {
        let step = self.step;
        let name = self.indexed(name);
        if let Some(value) = self.values.get(&name).or(self.last_pass.get(&name)) {
            return value.clone();
        }
        let state = |key: &str, velocity: &str| {
            let part = |name: &str| self.values.get(name).map(Value::number);
            Some(Value::Pair([part(key)?, part(velocity)?]))
        };
        let [t, q, v] = ["t", "q", "v"].map(|name| self.values[name].number());
        let known = match &*name {
            "y" => state("q", "v"),
            "y′" => Some(Value::Pair(step.end)),
            "q′" => Some(Value::Number(step.end[0])),
            "v′" => Some(Value::Number(step.end[1])),
            "y₋₁" => state("q₋₁", "v₋₁"),
            "a" if self.carries_a => {
                step.before.get("a′").cloned().or(Some(Value::Number(acceleration(t, q, v))))
            }
            "a" => Some(Value::Number(acceleration(t, q, v))),
            "I" => Some(Value::Number(1.0)),
            "e" => Some(Value::Number(1.0_f64.exp())),
            "∂f/∂y" => Some(Value::Matrix([[0.0, 1.0], slopes(t, q, v)])),
            "∂a/∂v" => Some(Value::Number(slopes(t, q, v)[1])),
            _ => name
                .strip_suffix("₋₁")
                .map(|name| step.before.get(name).cloned().unwrap_or(Value::Number(0.0))),
        };
        // A stage that a pass has not reached.
        known.unwrap_or(Value::Number(0.0))
    }

    fn call(&mut self, name: &str, inputs: &[Value]) -> Value {
        if let Some((names, text)) = self.functions.get(name).cloned() {
            let kept = self.values.clone();
            for (name, value) in names.into_iter().zip(inputs) {
                self.values.insert(canonical(name), value.clone());
            }
            let value = self.expression(text);
            self.values = kept;
            return value;
        }
        match (name, inputs) {
            ("f", [Value::Number(t), y]) => {
                let Value::Pair([q, v]) = *y else { return Value::Pair([0.0; 2]) };
                Value::Pair([v, acceleration(*t, q, v)])
            }
            ("a", [t, q, v]) => Value::Number(acceleration(t.number(), q.number(), v.number())),
            ("exp", [z]) => z.exp(),
            ("ns", [t]) => Value::Number((t.number() * 1e9 - 0.5).ceil() / 1e9),
            ("min", _) => {
                Value::Number(inputs.iter().map(Value::number).fold(f64::INFINITY, f64::min))
            }
            ("max", _) => {
                Value::Number(inputs.iter().map(Value::number).fold(-f64::INFINITY, f64::max))
            }
            _ => Value::Number(0.0),
        }
    }

    fn expression(&mut self, text: &'a str) -> Value {
        let mut rest = text;
        let value = self.sum(&mut rest, false);
        assert!(rest.trim().is_empty(), "not read: {rest} of {text}");
        value
    }

    fn sum(&mut self, rest: &mut &'a str, in_bars: bool) -> Value {
        let mut total = match take(rest, "−") {
            true => Value::Number(0.0).minus(&self.product(rest, in_bars)),
            false => self.product(rest, in_bars),
        };
        loop {
            if take(rest, " + ") {
                let minus = Value::Number(0.0).minus(&self.product(rest, in_bars));
                total = total.minus(&minus);
            } else if take(rest, " − ") {
                total = total.minus(&self.product(rest, in_bars));
            } else {
                return total;
            }
        }
    }

    fn product(&mut self, rest: &mut &'a str, in_bars: bool) -> Value {
        let mut total = self.power(rest, in_bars);
        loop {
            if take(rest, " / ") {
                total = total.over(&self.power(rest, in_bars));
                continue;
            }
            let next = rest.trim_start_matches(' ');
            let begins = next.starts_with(|c: char| {
                c.is_alphanumeric() || "(√∛Σ∂".contains(c) || (c == '|' && !in_bars)
            });
            if !begins {
                return total;
            }
            *rest = next;
            total = total.times(&self.power(rest, in_bars));
        }
    }

    fn power(&mut self, rest: &mut &'a str, in_bars: bool) -> Value {
        let mut base = self.primary(rest, in_bars);
        if take(rest, "^(") {
            let exponent = self.sum(rest, false);
            assert!(take(rest, ")"));
            return Value::Number(base.number().powf(exponent.number()));
        }
        let end = rest.find(|c: char| !"⁰¹²³⁴⁵⁶⁷⁸⁹".contains(c)).unwrap_or(rest.len());
        let digits = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|d| d == c).unwrap();
        if end > 0 {
            let exponent = rest[..end].chars().fold(0, |n, c| 10 * n + digits(c));
            base = (1..exponent).fold(base.clone(), |power, _| power.times(&base));
            *rest = &rest[end..];
        }
        base
    }

    fn primary(&mut self, rest: &mut &'a str, in_bars: bool) -> Value {
        for (sign, value) in
            [("½", 0.5), ("⅓", 1.0 / 3.0), ("⅔", 2.0 / 3.0), ("¼", 0.25), ("¾", 0.75)]
        {
            if take(rest, sign) {
                return Value::Number(value);
            }
        }
        if take(rest, "√") {
            return Value::Number(self.primary(rest, in_bars).number().sqrt());
        }
        if take(rest, "∛") {
            return Value::Number(self.primary(rest, in_bars).number().cbrt());
        }
        if take(rest, "(") {
            let value = self.sum(rest, false);
            assert!(take(rest, ")"), "no end of {rest}");
            return value;
        }
        if take(rest, "|") {
            let value = self.sum(rest, true);
            assert!(take(rest, "|"), "no end of {rest}");
            return value.abs();
        }
        if take(rest, "Σ ") {
            let (mut total, all) = (Value::Number(0.0), *rest);
            for index in 1..=7 {
                self.values.insert("j".into(), Value::Number(f64::from(index)));
                *rest = all;
                let term = Value::Number(0.0).minus(&self.product(rest, in_bars));
                total = total.minus(&term);
            }
            return total;
        }
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        if end > 0 {
            let number = rest[..end].parse().expect("a number");
            *rest = &rest[end..];
            return Value::Number(number);
        }
        let name = name(rest);
        assert!(!name.is_empty(), "no value: {rest}");
        *rest = &rest[name.len()..];
        if rest.starts_with('(') {
            let end = split(rest, ")")[0].len();
            let inside = &rest[1..end];
            *rest = &rest[end + 1..];
            let inputs: Vec<Value> =
                split(inside, ", ").into_iter().map(|input| self.expression(input)).collect();
            return self.call(name, &inputs);
        }
        self.value(name)
    }
}

fn take(rest: &mut &str, sign: &str) -> bool {
    rest.strip_prefix(sign).map(|after| *rest = after).is_some()
}

/// The derivatives of the acceleration by position and by velocity.
fn slopes(t: f64, q: f64, v: f64) -> [f64; 2] {
    let d = 1e-5;
    [
        (acceleration(t, q + d, v) - acceleration(t, q - d, v)) / (2.0 * d),
        (acceleration(t, q, v + d) - acceleration(t, q, v - d)) / (2.0 * d),
    ]
}
