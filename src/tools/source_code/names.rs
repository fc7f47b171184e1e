//! Writes the names and expressions of a source in a language.

use std::collections::BTreeMap;

use super::dialect::{Language, Precision};
use super::program::{Function, MethodInput, Program};

/// The names inside one function.
pub(super) struct Names<'a> {
    /// Id of the method.
    pub(super) id: &'a str,
    pub(super) language: Language,
    pub(super) precision: Precision,
    /// Names of the whole numbers.
    pub(super) whole: Vec<&'a str>,
    /// Inputs of the function.
    pub(super) inputs: &'a [MethodInput<'a>],
    /// Functions that the function can call.
    pub(super) functions: &'a [Function<'a>],
    /// Spellings of the program's names in the language.
    pub(super) spellings: &'a BTreeMap<&'a str, String>,
}

/// Returns the spelling of each name that a program declares. A word of the language gets another, and no two names
/// share one.
pub(super) fn spellings<'a>(
    program: &Program<'a>,
    language: Language,
) -> BTreeMap<&'a str, String> {
    let mut spellings = BTreeMap::<&str, String>::new();
    for name in program.names() {
        let (mut free, mut spelling) = (name.to_owned(), spelt(language, name));
        while is_reserved(language, &spelling) || spellings.values().any(|it| *it == spelling) {
            free += "_own";
            spelling = spelt(language, &free);
        }
        spellings.insert(name, spelling);
    }
    spellings
}

/// Whether a name has a meaning of its own in the language.
pub(super) fn is_reserved(language: Language, name: &str) -> bool {
    let dialect = language.dialect();
    dialect.reserved.split_whitespace().any(|word| word == name)
        || dialect.words.iter().any(|(_, word)| word.trim_end_matches("SUFFIX") == name)
}

/// Returns a name in the case of the language.
fn spelt(language: Language, name: &str) -> String {
    if language != Language::CSharp || name.starts_with('_') {
        return name.to_owned();
    }
    let pascal = pascal(name);
    // Constants are in capitals in the source, but in Pascal case here.
    if name.chars().any(|c| c.is_ascii_lowercase()) {
        let (first, rest) = pascal.split_at(pascal.len().min(1));
        return first.to_lowercase() + rest;
    }
    pascal
}

/// Whether one of the inputs is a function.
pub(super) fn takes_function(inputs: &[MethodInput<'_>]) -> bool {
    inputs.iter().any(|input| !input.arguments.is_empty())
}

/// Converts `adams_bashforth_2` to `AdamsBashforth2`.
pub(super) fn pascal(snake: &str) -> String {
    let capital = |word: &str| {
        let (first, rest) = word.split_at(word.len().min(1));
        first.to_uppercase() + &rest.to_lowercase()
    };
    snake.split('_').map(capital).collect()
}

impl Names<'_> {
    /// Returns the name of a number or an input.
    pub(super) fn name(&self, name: &str) -> String {
        self.spellings.get(name).cloned().unwrap_or_else(|| spelt(self.language, name))
    }

    /// Returns the function's name, prefixed with the method's id so that several methods fit in one file.
    pub(super) fn function(&self, name: &str) -> String {
        match self.language {
            Language::CSharp => pascal(name),
            _ => format!("{}_{name}", self.id.replace('-', "_")),
        }
    }

    /// Writes an expression word by word, with whole numbers converted.
    pub(super) fn expression(&self, text: &str) -> String {
        self.translate(text, true)
    }

    /// Writes a condition, or an expression that changes a whole number.
    pub(super) fn whole_expression(&self, text: &str) -> String {
        self.translate(text, false)
    }

    fn translate(&self, text: &str, converts: bool) -> String {
        let mut written = String::with_capacity(text.len());
        // This stack records for each open parenthesis whether its last argument is C's `user`.
        let mut takes_user = Vec::new();
        let mut calls_with_user = false;
        let mut rest = text;
        while let Some(first) = rest.chars().next() {
            let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
            let end = match is_part(first) {
                _ if first.is_ascii_digit() => number_end(rest),
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
                _ if first.is_ascii_alphabetic() || first == '_' => {
                    let is_call = after.starts_with('(');
                    calls_with_user = is_call && self.takes_user(token);
                    written.push_str(&self.word(token, is_call, converts));
                }
                _ if first.is_ascii_digit() => {
                    let (number, after_number) = self.number(token, after);
                    written.push_str(&number);
                    rest = after_number;
                    continue;
                }
                _ => written.push_str(token),
            }
            rest = after;
        }
        written
    }

    /// Whether C passes `user` to this function.
    fn takes_user(&self, name: &str) -> bool {
        let is_input = self.inputs.iter().any(|input| input.name == name);
        let function = self.functions.iter().find(|function| function.name == name);
        let is_given =
            is_input || function.is_some_and(|function| takes_function(&function.inputs));
        self.language == Language::C && is_given
    }

    /// Returns the number `token` or, in single precision, its alternative at the start of `after`, and the text that
    /// follows.
    fn number<'t>(&self, token: &'t str, after: &'t str) -> (String, &'t str) {
        let (double, (single, after)) = match after.strip_prefix('|') {
            Some(after) => (token, after.split_at(number_end(after))),
            None => (token, (token, after)),
        };
        let is_whole = token.chars().all(|c| c.is_ascii_digit());
        let number = match self.precision {
            Precision::Single if !is_whole => {
                format!("{single}{}", self.language.dialect().single_suffix)
            }
            _ => double.to_owned(),
        };
        (number, after)
    }

    fn word(&self, word: &str, is_call: bool, converts: bool) -> String {
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
        let dialect = self.language.dialect();
        if converts && self.whole.contains(&word) {
            let converted = dialect.fill_precision(dialect.converted, self.precision);
            return converted.replace("NAME", &self.name(word));
        }
        let is_own = !is_call && self.spellings.contains_key(word);
        let written = dialect.words.iter().find(|(source, _)| *source == word && !is_own);
        written.map_or_else(
            || self.name(word),
            |(_, written)| dialect.fill_precision(written, self.precision),
        )
    }
}

/// Returns the index of the end of the number that begins `text`.
fn number_end(text: &str) -> usize {
    let mut before = '0';
    let is_end = |c: char| {
        let is_sign_of_exponent = before == 'e' && (c == '-' || c == '+');
        before = c;
        !(c.is_ascii_digit() || c == '.' || c == 'e' || is_sign_of_exponent)
    };
    text.find(is_end).unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(language: Language, text: &str) -> String {
        written_in(language, Precision::Double, text)
    }

    fn written_in(language: Language, precision: Precision, text: &str) -> String {
        let input = |name, arguments| MethodInput { name, arguments, is_whole: false, about: "" };
        let (a, k) = (input("a", vec!["x", "v"]), input("k", Vec::new()));
        let solve = Function {
            name: "solve",
            inputs: vec![a.clone()],
            comments: Vec::new(),
            body: Vec::new(),
        };
        let (inputs, functions) = ([a, k], [solve]);
        let (inputs, functions) = (&inputs[..], &functions[..]);
        let (whole, spellings) = (vec!["n"], &BTreeMap::new());
        Names { id: "my-method", language, precision, whole, inputs, functions, spellings }
            .expression(text)
    }

    #[test]
    fn a_number_has_the_requested_precision() {
        let text = "sqrt(1.5e-8|4e-4 * k) / n - 2.0 * max(k, nan)";
        let double = [
            "f64::sqrt(1.5e-8 * k) / n as f64 - 2.0 * f64::max(k, f64::NAN)",
            "sqrt(1.5e-8 * k) / (double)n - 2.0 * fmax(k, NAN)",
            "Math.Sqrt(1.5e-8 * k) / n - 2.0 * Math.Max(k, double.NaN)",
            "sqrt(1.5e-8 * k) / n - 2.0 * maxf(k, NAN)",
        ];
        let single = [
            "f32::sqrt(4e-4 * k) / n as f32 - 2.0 * f32::max(k, f32::NAN)",
            "sqrtf(4e-4f * k) / (float)n - 2.0f * fmaxf(k, NAN)",
            "(float)Math.Sqrt(4e-4f * k) / n - 2.0f * Math.Max(k, float.NaN)",
        ];
        assert_eq!(Language::ALL.map(|language| written(language, text)), double);
        let languages = [Language::Rust, Language::C, Language::CSharp];
        let found = languages.map(|language| written_in(language, Precision::Single, text));
        assert_eq!(found, single);
    }

    #[test]
    fn a_call_of_the_users_function_follows_each_language() {
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
    fn a_forwarded_function_keeps_its_user_argument() {
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
    fn fields_conditions_and_constants_follow_each_language() {
        let text = "memory.last_h == h and is_nan(MIN_H) or x < nan";
        let expected = [
            "memory.last_h == h && f64::is_nan(MIN_H) || x < f64::NAN",
            "memory->last_h == h && isnan(MIN_H) || x < NAN",
            "memory.lastH == h && double.IsNaN(MinH) || x < double.NaN",
            "memory.last_h == h and is_nan(MIN_H) or x < NAN",
        ];
        assert_eq!(Language::ALL.map(|language| written(language, text)), expected);
    }
}
