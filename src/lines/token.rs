//! The tokens of an expression.

use std::ops::Range;

use super::fault::{Parsed, fault};

/// One token.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token {
    /// A finite number.
    Number(f64),
    /// A name or a word such as `and`; its text is that of the span.
    Name,
    /// An operator, a bracket or a comma.
    Symbol(&'static str),
    /// The end of the text.
    End,
}

/// The operators, brackets and commas. A symbol comes before any other that is a prefix of it.
const SYMBOLS: [&str; 16] =
    ["<=", ">=", "==", "!=", "+", "-", "*", "/", "^", "(", ")", "[", "]", ",", "<", ">"];

/// Returns the symbols that stand between or before values.
pub(super) fn operator_signs() -> impl Iterator<Item = &'static str> {
    SYMBOLS.into_iter().filter(|symbol| !["(", ")", "[", "]", ","].contains(symbol))
}

/// Signs of other notations, each with our sign.
const FOREIGN: [(&str, &str); 14] = [
    (">>", "floor(x / 2^n)"),
    ("<<", "x * 2^n"),
    ("~~", "trunc(x)"),
    ("**", "^"),
    ("&&", "and"),
    ("||", "or"),
    ("&", "and"),
    ("|", "or"),
    ("!", "not"),
    ("=", "=="),
    ("−", "-"),
    ("·", "*"),
    ("×", "*"),
    ("÷", "/"),
];

/// The remedy for a call that reads keys or a stick.
pub(super) const INPUT: &str =
    "lines read no input: write a number for it, such as `1` while a key is held";

/// Python's `//` in lines whose other `//` are remarks.
pub(super) const FLOOR_DIVISION: &str = "/\\";

/// The `%` of Python and Lua in lines of theirs.
pub(super) const FLOOR_REMAINDER: &str = "\u{7f}";

/// Signs of other notations that step lines have too, each with our symbol.
const STEP_SIGNS: [(&str, &str); 18] = [
    (FLOOR_REMAINDER, "%%"),
    ("===", "=="),
    ("!==", "!="),
    ("**", "^"),
    ("&&", "and"),
    ("||", "or"),
    ("|", "|"),
    (FLOOR_DIVISION, "//"),
    ("{", "{"),
    ("}", "}"),
    ("%", "%"),
    ("−", "-"),
    ("·", "*"),
    ("×", "*"),
    ("÷", "/"),
    ("!", "not"),
    ("?", "?"),
    (":", ":"),
];

/// Returns the tokens of `text` with their byte ranges. The last token is [`Token::End`]. Only a step has methods and
/// the signs of other notations.
pub(super) fn tokens(text: &str, is_step: bool) -> Parsed<Vec<(Token, Range<usize>)>> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        if first.is_ascii_whitespace() {
            at += 1;
            continue;
        }
        let mut step_signs = STEP_SIGNS
            .iter()
            .filter(|(sign, _)| is_step && (sign.len() == 3 || !rest.starts_with("!=")));
        let after_value =
            matches!(tokens.last(), Some((Token::Name | Token::Number(_) | Token::Symbol(")"), _)));
        let is_method = is_step
            && after_value
            && rest.strip_prefix('.').is_some_and(|rest| rest.starts_with(is_name_start));
        let (token, length) = if is_method {
            (Token::Symbol("."), 1)
        } else if first.is_ascii_digit() || first == '.' {
            number(rest, at)?
        } else if is_name_start(first) {
            (Token::Name, span_of(rest, |c| is_name_start(c) || c.is_ascii_digit()))
        } else if let Some((sign, symbol)) = step_signs.find(|(sign, _)| rest.starts_with(sign)) {
            (Token::Symbol(symbol), sign.len())
        } else if let Some((sign, meant)) = foreign(rest) {
            let what = format!("`{sign}` has no meaning here");
            return fault(at..at + sign.len(), what, format!("write `{meant}`"));
        } else if let Some(symbol) = SYMBOLS.iter().find(|symbol| rest.starts_with(**symbol)) {
            (Token::Symbol(symbol), symbol.len())
        } else {
            let what = format!("`{}` cannot be in an expression", first.escape_debug());
            let remedy = match first {
                '?' => "write `if(c, a, b)` for `c ? a : b`",
                '"' | '\'' if is_step => INPUT,
                _ => "remove it",
            };
            return fault(at..at + first.len_utf8(), what, remedy);
        };
        tokens.push((token, at..at + length));
        at += length;
    }
    tokens.push((Token::End, text.len()..text.len()));
    Ok(tokens)
}

/// Whether a name can contain this byte.
pub(super) fn is_name_part(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// Whether this can be the first character of a name.
pub(super) fn is_name_start(character: char) -> bool {
    character.is_ascii_alphabetic() || character == '_'
}

fn foreign(rest: &str) -> Option<(&'static str, &'static str)> {
    let is_ours = rest.starts_with("==") || rest.starts_with("!=");
    FOREIGN.into_iter().find(|(sign, _)| !is_ours && rest.starts_with(sign))
}

/// Returns the length in bytes of the longest prefix of `text` with only `wanted` characters.
fn span_of(text: &str, wanted: impl Fn(char) -> bool) -> usize {
    text.find(|c| !wanted(c)).unwrap_or(text.len())
}

/// Reads the number at the beginning of `rest`, which starts at byte `at`. Returns the number with its length in bytes.
fn number(rest: &str, at: usize) -> Parsed<(Token, usize)> {
    let mut length = span_of(rest, |c| c.is_ascii_digit() || c == '.');
    if rest[length..].starts_with(['e', 'E']) {
        let sign = usize::from(rest[length + 1..].starts_with(['+', '-']));
        let digits = span_of(&rest[length + 1 + sign..], |c| c.is_ascii_digit());
        length += if digits > 0 { 1 + sign + digits } else { 0 };
    }
    // The point after `2.0` in `2.0.sqrt()` is that of the method.
    let is_name_next = rest[length..].starts_with(is_name_start);
    length -= usize::from(is_name_next && length > 2 && rest[..length].ends_with('.'));
    let (span, text) = (at..at + length, &rest[..length]);
    let number = match text.parse::<f64>() {
        Ok(number) if number.is_finite() => number,
        Ok(_) => {
            return fault(span, format!("`{text}` is too large"), "write a smaller number");
        }
        Err(_) => {
            let remedy = "write it with one point, such as `0.5`";
            return fault(span, format!("`{text}` is no number"), remedy);
        }
    };
    let after = span_of(&rest[length..], |c| is_name_start(c) || c.is_ascii_digit());
    if after > 0 {
        let unit = &rest[length..length + after];
        let remedy = format!("write `{text}*{unit}`, or a `{text}` alone");
        let what = format!("`{text}{unit}` is neither a number nor a name");
        return fault(at..at + length + after, what, remedy);
    }
    Ok((Token::Number(number), length))
}
