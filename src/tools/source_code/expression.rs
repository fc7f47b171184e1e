//! Writes the names and the expressions of a step in a language.

use std::collections::BTreeMap;

use super::declarations::{Declaration, declarations};
use super::dialect::{Dialect, Precision};
use crate::sim::law::{
    Expression, Level, Line, LoopName, MethodInput, Operation, StepBody, StepText, bracketed,
    is_function,
};

/// The prefix of a number that the memory carries.
const FIELD: &str = "memory_";

/// The key of the acceleration among the [spellings], since a number can have its name.
const ACCELERATION: &str = "a()";

/// Words of the code around the lines of a game loop.
const LOOP_WORDS: &str = "step duration_ns duration_ms durationNs durationMs user loop self game_loop GameLoop Frame Action \
                          setmetatable";

/// The spelling of each name of a text in a language.
pub(super) type Spellings<'t> = BTreeMap<&'t str, String>;

/// An expression in a language, with the level of its outermost operator; `None` for a name, a number or a call.
pub(super) type Written = (String, Option<Level>);

/// Returns the spelling of each name of a text. A word of the language gets another, and no two names share one.
pub(super) fn spellings<'t>(text: &'t StepText, dialect: &Dialect) -> Spellings<'t> {
    let bodies = || [text.body()].into_iter().chain(text.functions());
    let key = |input: &MethodInput<'t>| {
        if input.arguments.is_empty() { input.name } else { ACCELERATION }
    };
    let inputs = || bodies().flat_map(StepBody::inputs);
    let fields = text.body().names().iter().map(|name| field_or_name(name));
    let names = bodies().flat_map(|body| body.names()).map(|name| field_or_name(name));
    let is_loop = text.is_loop();
    let first: &[&str] = if is_loop { &[] } else { &["x", "v", "h", "memory"] };
    let found = declarations(text.body()).lines.into_iter().zip(text.body().lines());
    let constants: Vec<&str> = found
        .filter_map(|(found, line)| match line {
            Line::Assign { name, .. } if is_loop && found == Some(Declaration::Constant) => {
                Some(&*text.body().names()[*name])
            }
            _ => None,
        })
        .collect();
    // A field cannot share the name of the function of a frame.
    let is_frame_field = |name: &str| {
        let carried = text.carried().iter().map(|carried| field_or_name(&carried.name));
        name == "frame" && carried.chain(text.arrays().map(|(name, ..)| name)).any(|it| it == name)
    };
    let is_loop_word = |word: &str| {
        let mut words = LOOP_WORDS.split_whitespace();
        is_loop && (words.any(|it| it == word) || is_frame_field(word))
    };
    let arrays = text.arrays().map(|(name, ..)| name);
    let taken = inputs().map(|input| key(&input));
    let mut spellings = Spellings::new();
    let first = first.iter().copied();
    for name in first.chain(taken).chain(fields).chain(arrays).chain(names) {
        if spellings.contains_key(name) {
            continue;
        }
        let plain = match LoopName::ALL.iter().find(|it| is_loop && it.name() == name) {
            Some(told) => loop_word(*told, text.is_whole_loop()).to_owned(),
            None if constants.contains(&name) => name.to_uppercase(),
            None => name.trim_end_matches("()").to_owned(),
        };
        let is_duration = plain == "duration_ms";
        let (mut free, mut spelling) = (plain.clone(), (dialect.spelt)(&plain));
        while dialect.is_reserved(&spelling)
            || is_function(&free)
            || is_of_printer(&free) && !free.ends_with("_own")
            || is_loop_word(&spelling) && !is_duration
            || spellings.values().any(|it| *it == spelling)
        {
            free += "_own";
            spelling = (dialect.spelt)(&free);
        }
        spellings.insert(name, spelling);
    }
    spellings
}

/// Whether a name may be that of a function which the code of a rule brings along, such as `rule_sign`.
fn is_of_printer(name: &str) -> bool {
    let rest = name.strip_prefix("rule");
    rest.is_some_and(|rest| rest.starts_with(|c: char| c == '_' || c.is_ascii_uppercase()))
}

/// Returns the name in code of a number that a game loop is given.
fn loop_word(name: LoopName, is_whole: bool) -> &'static str {
    match name {
        LoopName::Duration if is_whole => "dt",
        LoopName::Duration => "duration_ms",
        LoopName::Tick => "tick",
        LoopName::Shown => "shown",
        LoopName::Made => "ticks_left",
        LoopName::Refresh | LoopName::Second | LoopName::Cost | LoopName::Now | LoopName::First => {
            name.name()
        }
    }
}

/// Returns a name without the prefix of a field of the memory.
fn field_or_name(name: &str) -> &str {
    name.strip_prefix(FIELD).unwrap_or(name)
}

/// The names inside the step or one of its functions.
#[derive(Clone, Copy)]
pub(super) struct Names<'t> {
    pub(super) dialect: &'static Dialect,
    pub(super) precision: Precision,
    /// The prefix of functions, by which several methods fit in one file.
    pub(super) prefix: &'t str,
    pub(super) body: StepBody<'t>,
    pub(super) spellings: &'t Spellings<'t>,
    /// The functions of the text that take the acceleration.
    pub(super) forwarding: &'t [&'t str],
}

impl<'t> Names<'t> {
    /// Returns the spelling of a name of the text.
    pub(super) fn spelling(&self, name: &str) -> String {
        self.spellings.get(name).cloned().unwrap_or_else(|| (self.dialect.spelt)(name))
    }

    /// Returns the name of a field of the memory.
    pub(super) fn field(&self, name: &str) -> String {
        self.spelling(field_or_name(name))
    }

    /// Returns the value of a field before the first step.
    pub(super) fn start(&self, value: f64) -> String {
        if value.is_nan() { self.word("nan") } else { self.number(value, None) }
    }

    /// Returns the spelling of an input.
    pub(super) fn input(&self, input: &MethodInput<'_>) -> String {
        self.spelling(if input.arguments.is_empty() { input.name } else { ACCELERATION })
    }

    /// Returns the number or the field of the memory with this index.
    pub(super) fn name(&self, index: usize) -> String {
        let name = self.spelling(field_or_name(&self.body.names()[index]));
        match self.body.is_field(index) || self.body.is_kept(index) {
            true if self.body.is_loop() => format!("{}{name}", self.dialect.own),
            true => format!("{}{}{name}", self.spelling("memory"), self.dialect.member),
            false => name,
        }
    }

    /// Returns a number that a game loop is given, or the moment that it shows.
    pub(super) fn told(&self, name: LoopName) -> String {
        let index = self.body.names().iter().position(|known| known == name.name());
        index.map_or_else(String::new, |index| self.name(index))
    }

    /// Returns the number of an array at an index.
    pub(super) fn element(&self, array: &str, index: &'t Expression) -> String {
        let (text, level) = self.expression(index, false);
        let number = (index.size() == 1).then(|| self.body.operation(index, 0));
        self.indexed(array, number, &text, level)
    }

    fn indexed(
        &self,
        array: &str,
        operation: Option<Operation<'_>>,
        text: &str,
        level: Option<Level>,
    ) -> String {
        let own = self.dialect.own;
        let index = match operation {
            Some(Operation::Number { value, .. }) => format!("{value:.0}"),
            _ => {
                let is_loose = level.is_some() && !self.dialect.index.contains("(VALUE)");
                let text = if is_loose { format!("({text})") } else { bare(text).to_owned() };
                self.dialect.index.replace("VALUE", &text)
            }
        };
        format!("{own}{}[{index}]", self.spelling(array))
    }

    /// Returns the name of a function of the text.
    pub(super) fn function(&self, name: &str) -> String {
        (self.dialect.function_name)(self.prefix, name)
    }

    /// Writes the value of a line. If `is_whole`, it is a whole number.
    pub(super) fn expression(&self, expression: &'t Expression, is_whole: bool) -> Written {
        let whole = self.body.whole(expression, is_whole);
        let mut written: Vec<Written> = Vec::with_capacity(expression.size());
        for (index, &is_counted) in whole.iter().enumerate() {
            // Brackets around the whole expression are those of the statement.
            let is_last = index + 1 == expression.size();
            let operand = |at: usize, outside: Option<Level>, is_right: bool| {
                let (text, level) = &written[at];
                let is_loose = level.is_some_and(|level| match is_right {
                    true => Some(level) <= outside,
                    false => Some(level) < outside,
                });
                if is_loose { format!("({text})") } else { text.clone() }
            };
            let arguments = |all: &[usize]| {
                all.iter().map(|at| bare(&written[*at].0).to_owned()).collect::<Vec<_>>()
            };
            let dialect = self.dialect;
            let (mut text, mut level) = match self.body.operation(expression, index) {
                Operation::Number { value, .. } if value.is_nan() => (self.word("nan"), None),
                Operation::Number { value, .. } if is_counted => (format!("{value:.0}"), None),
                Operation::Number { value, written } => (self.number(value, written), None),
                Operation::Name(name) if self.body.is_whole(name) && !is_counted => {
                    let converted = dialect.fill_precision(dialect.converted, self.precision);
                    (converted.replace("NAME", &self.name(name)), None)
                }
                Operation::Name(name) => (self.name(name), None),
                Operation::Element { array, index: at } => {
                    let (text, level) = &written[at];
                    let number = self.body.operation(expression, at);
                    (self.indexed(array, Some(number), text, *level), None)
                }
                Operation::Infix { sign, level, operands: [left, right], breaks } => {
                    let space = if breaks { dialect.broken_line() } else { " ".into() };
                    let [mut left, right] =
                        [operand(left, Some(level), false), operand(right, Some(level), true)];
                    // Rust takes `n as f64 < m` for generic arguments.
                    if sign == "<" && [" as f64", " as f32"].iter().any(|it| left.ends_with(it)) {
                        left = format!("({left})");
                    }
                    (format!("{left}{space}{} {right}", self.word(sign)), Some(level))
                }
                Operation::Negate(at) => {
                    let level = match self.body.operation(expression, at) {
                        Operation::Number { .. } => None,
                        _ => Some(Level::Product),
                    };
                    let of = operand(at, Some(Level::Product), true);
                    let of = if of.starts_with('-') { format!("({of})") } else { of };
                    (format!("-{of}"), level)
                }
                Operation::Not(at) => {
                    let space = if self.word("not") == "!" { "" } else { " " };
                    let of = operand(at, Some(Level::Power), true);
                    (format!("{}{space}{of}", self.word("not")), None)
                }
                Operation::Call { function, arguments: all } => {
                    let word = self.word(function);
                    let text = if word.contains("{a}") {
                        let of = |n: usize| match all.get(n) {
                            // A choice has brackets of its own.
                            Some(at) if function == "if" => operand(*at, None, false),
                            Some(at) if written[*at].0.starts_with('-') => {
                                format!("({})", written[*at].0)
                            }
                            Some(at) => operand(*at, Some(Level::Power), true),
                            None => String::new(),
                        };
                        word.replace("{a}", &of(0)).replace("{b}", &of(1)).replace("{c}", &of(2))
                    } else {
                        let is_own = dialect.writes_out(function);
                        let name = if is_own { self.function(function) } else { word };
                        format!("{name}({})", arguments(all).join(", "))
                    };
                    (text, None)
                }
                Operation::Acceleration(at) => {
                    let name = self.spelling(ACCELERATION);
                    let all = arguments(&at).join(", ");
                    let [call, more] = [dialect.call, dialect.user];
                    (format!("{name}{call}({all}{more})"), None)
                }
                Operation::Own { function, arguments: all } => {
                    let each = |argument: &Option<usize>| match argument {
                        Some(at) => bare(&written[*at].0).to_owned(),
                        None => format!("{}{}", dialect.reference, self.spelling(ACCELERATION)),
                    };
                    let all: Vec<String> = all.iter().map(each).collect();
                    let more = if self.forwarding.contains(&function) { dialect.user } else { "" };
                    (format!("{}({}{more})", self.function(function), all.join(", ")), None)
                }
            };
            let has_operator = level.is_some() || text.starts_with('-');
            if has_operator && !is_last && self.body.is_bracketed(expression, index) {
                (text, level) = (format!("({text})"), None);
            }
            written.push((text, level));
        }
        let (text, level) = written.pop().unwrap_or_default();
        // What had brackets of its own is loose without them.
        match bare(&text) {
            inner if inner.len() < text.len() => (inner.to_owned(), level.or(Some(Level::Or))),
            whole => (whole.to_owned(), level),
        }
    }

    fn number(&self, value: f64, written: Option<[&str; 2]>) -> String {
        match (written, self.precision) {
            (Some([double, _]), Precision::Double) => double.to_owned(),
            (Some([_, single]), Precision::Single) => {
                format!("{single}{}", self.dialect.single_suffix)
            }
            (None, Precision::Double) => format!("{value:?}"),
            (None, Precision::Single) => format!("{value:?}{}", self.dialect.single_suffix),
        }
    }

    /// Returns the spelling of a word or a sign of the language of steps.
    pub(super) fn word(&self, word: &'static str) -> String {
        self.dialect.fill_precision(self.dialect.word(word), self.precision)
    }

    /// Returns the functions of the language of steps that this language has only if they are written out.
    pub(super) fn written_out(&self, line: &'t Line) -> Vec<&'static str> {
        let called = |(expression, index)| match self.body.operation(expression, index) {
            Operation::Call { function, .. } => Some(function),
            _ => None,
        };
        let all = line.values().flat_map(|value| (0..value.size()).map(move |at| (value, at)));
        all.filter_map(called).filter(|function| self.dialect.writes_out(function)).collect()
    }
}

/// Returns an expression without brackets around all of it.
fn bare(text: &str) -> &str {
    bracketed(text).unwrap_or(text)
}
