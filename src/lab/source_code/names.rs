//! How the names of a source, and the expressions made of them, are written in a language.

use super::dialect::Language;
use super::program::{Function, MethodInput};

/// The names inside one function.
pub(super) struct Names<'a> {
    /// The id of the method.
    pub(super) id: &'a str,
    pub(super) language: Language,
    /// What the function takes.
    pub(super) inputs: &'a [MethodInput<'a>],
    /// The functions that it can call.
    pub(super) functions: &'a [Function<'a>],
}

/// Whether one of these is a function.
pub(super) fn takes_function(inputs: &[MethodInput<'_>]) -> bool {
    inputs.iter().any(|input| !input.arguments.is_empty())
}

/// `adams_bashforth_2` as `AdamsBashforth2`.
pub(super) fn pascal(snake: &str) -> String {
    let capital = |word: &str| {
        let (first, rest) = word.split_at(word.len().min(1));
        first.to_uppercase() + &rest.to_lowercase()
    };
    snake.split('_').map(capital).collect()
}

impl Names<'_> {
    /// The name of a number, or of an input.
    pub(super) fn name(&self, name: &str) -> String {
        if self.language != Language::CSharp {
            return name.to_owned();
        }
        let pascal = pascal(name);
        // A constant is in capitals.
        if name.chars().any(|c| c.is_ascii_lowercase()) {
            let (first, rest) = pascal.split_at(pascal.len().min(1));
            return first.to_lowercase() + rest;
        }
        pascal
    }

    /// The function's name, prefixed with the method's id so that several fit in one file.
    pub(super) fn function(&self, name: &str) -> String {
        match self.language {
            Language::CSharp => pascal(name),
            _ => format!("{}_{name}", self.id.replace('-', "_")),
        }
    }

    /// An expression, word by word.
    pub(super) fn expression(&self, text: &str) -> String {
        let mut written = String::with_capacity(text.len());
        // For each open parenthesis, whether C's `user` is the last argument in it.
        let mut takes_user = Vec::new();
        let mut calls_with_user = false;
        let mut rest = text;
        while let Some(first) = rest.chars().next() {
            let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
            let end = match is_part(first) {
                true => rest.find(|c| !is_part(c)).unwrap_or(rest.len()),
                false => first.len_utf8(),
            };
            let (token, after) = rest.split_at(end);
            match token {
                "(" => takes_user.push(std::mem::take(&mut calls_with_user)),
                ")" if takes_user.pop() == Some(true) => written.push_str(", user"),
                _ => {}
            }
            match token {
                "." if self.language == Language::C && written.ends_with("memory") => {
                    written.push_str("->");
                }
                _ if first.is_ascii_alphabetic() => {
                    let is_call = after.starts_with('(');
                    calls_with_user = is_call && self.takes_user(token);
                    written.push_str(&self.word(token, is_call));
                }
                _ => written.push_str(token),
            }
            rest = after;
        }
        written
    }

    /// Whether C's `user` is handed to this function.
    fn takes_user(&self, name: &str) -> bool {
        let is_input = self.inputs.iter().any(|input| input.name == name);
        let function = self.functions.iter().find(|function| function.name == name);
        let is_given =
            is_input || function.is_some_and(|function| takes_function(&function.inputs));
        self.language == Language::C && is_given
    }

    fn word(&self, word: &str, is_call: bool) -> String {
        let input = self.inputs.iter().find(|input| input.name == word);
        if input.is_some_and(|input| !input.arguments.is_empty()) {
            let name = self.name(word);
            return match (self.language, is_call) {
                (Language::Rust, false) => format!("&{name}"),
                (Language::GdScript, true) => format!("{name}.call"),
                _ => name,
            };
        }
        if is_call && self.functions.iter().any(|function| function.name == word) {
            return self.function(word);
        }
        let words = self.language.dialect().words;
        let written = words.iter().find(|(source, _)| *source == word);
        written.map_or_else(|| self.name(word), |(_, written)| (*written).to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(language: Language, text: &str) -> String {
        let a = MethodInput { name: "a", arguments: vec!["x", "v"], about: "" };
        let k = MethodInput { name: "k", arguments: Vec::new(), about: "" };
        let solve = Function {
            name: "solve",
            inputs: vec![a.clone()],
            comments: Vec::new(),
            body: Vec::new(),
        };
        let (inputs, functions) = ([a, k], [solve]);
        Names { id: "my-method", language, inputs: &inputs, functions: &functions }.expression(text)
    }

    #[test]
    fn a_call_of_a_given_function_is_written_as_each_language_has_it() {
        let text = "k * a(x + abs(v_end), v)";
        let expected = [
            "k * a(x + f64::abs(v_end), v)",
            "k * a(x + fabs(v_end), v, user)",
            "k * a(x + Math.Abs(vEnd), v)",
            "k * a.call(x + absf(v_end), v)",
        ];
        assert_eq!(Language::ALL.map(|language| written(language, text)), expected);
    }

    #[test]
    fn a_function_that_is_handed_on_keeps_what_it_needs() {
        let text = "solve(a, (x), 1.5e-3)";
        let expected = [
            "my_method_solve(&a, (x), 1.5e-3)",
            "my_method_solve(a, (x), 1.5e-3, user)",
            "Solve(a, (x), 1.5e-3)",
            "my_method_solve(a, (x), 1.5e-3)",
        ];
        assert_eq!(Language::ALL.map(|language| written(language, text)), expected);
    }

    #[test]
    fn fields_conditions_and_constants_are_written_as_each_language_has_them() {
        let text = "memory.last_h == h and is_nan(LEAST_H) or x < nan";
        let expected = [
            "memory.last_h == h && f64::is_nan(LEAST_H) || x < f64::NAN",
            "memory->last_h == h && isnan(LEAST_H) || x < NAN",
            "memory.lastH == h && double.IsNaN(LeastH) || x < double.NaN",
            "memory.last_h == h and is_nan(LEAST_H) or x < NAN",
        ];
        assert_eq!(Language::ALL.map(|language| written(language, text)), expected);
    }
}
