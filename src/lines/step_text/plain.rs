//! Blanks the parts of a text that only its own language needs, such as comments, the `f` of `0.2f`, or the `Mathf.` of
//! `Mathf.Exp`.

use super::paths::{Component, reduce};
use crate::token::{is_name_part, is_name_start};

/// Beginnings of lines of `assets/methods` that describe a method for people.
const HEADINGS: [&str; 6] =
    ["order: ", "stability: ", "symplectic: ", "several: ", "held: ", "refused"];

/// The word that begins the line of an input, whose description follows a colon.
const INPUT: &str = "takes ";

/// The prefix of a carried number, if a name without the prefix means another number.
const MEMORY: &str = "memory";

/// Suffixes of numbers in other languages.
const SUFFIXES: [&str; 8] = ["_f64", "_f32", "f64", "f32", "f", "F", "d", "D"];

/// Returns the text with blanks in place of the parts that have no meaning here, so that all other bytes keep their
/// positions. Also returns the components of vectors.
pub(super) fn plain(text: &str) -> (String, Vec<Component>) {
    let mut plain = text.as_bytes().to_vec();
    if text.starts_with('\u{feff}') {
        plain[..'\u{feff}'.len_utf8()].fill(b' ');
    }
    let (mut at, mut is_line_start) = (0, true);
    while at < text.len() {
        let rest = &text.as_bytes()[at..];
        let begins = std::mem::replace(&mut is_line_start, rest[0] == b'\n');
        let blank = |plain: &mut Vec<u8>, length: usize| {
            let blanks = plain[at..at + length].iter_mut();
            blanks.filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
            length
        };
        let is_heading = |heading: &&str| begins && rest.starts_with(heading.as_bytes());
        at += match rest[0] {
            _ if HEADINGS.iter().any(is_heading) => blank(&mut plain, line_length(rest)),
            _ if begins && rest.starts_with(INPUT.as_bytes()) => {
                let line = &rest[..line_length(rest)];
                let ends = line.windows(2).position(|two| two == b": ");
                let kept = ends.unwrap_or(line.len());
                plain[at + kept..at + line.len()].fill(b' ');
                line.len()
            }
            b'#' => blank(&mut plain, line_length(rest)),
            b'/' if rest.starts_with(b"//") => blank(&mut plain, line_length(rest)),
            b'/' if rest.starts_with(b"/*") => {
                let end = rest.windows(2).skip(2).position(|two| two == b"*/");
                // A remark that is not closed stays, and is refused.
                end.map_or(2, |end| blank(&mut plain, end + 4))
            }
            b'-' if is_remark_of_lua(text.as_bytes(), at) => blank(&mut plain, line_length(rest)),
            b'\r' => blank(&mut plain, 1),
            // Lua's `!=`.
            b'~' if rest.starts_with(b"~=") => {
                plain[at] = b'!';
                2
            }
            // Lua's `x:lerp(target, part)`.
            b':' if is_method_of_lua(&text[..at], &text[at + 1..]) => {
                plain[at] = b'.';
                1
            }
            b'0'..=b'9' | b'.' => {
                let (number, suffix) = number_length(rest);
                plain[at + number..at + number + suffix].fill(b' ');
                number + suffix
            }
            byte if is_name_part(byte) => {
                let length = rest.iter().take_while(|byte| is_name_part(**byte)).count();
                let is_memory =
                    &rest[..length] == MEMORY.as_bytes() && rest.get(length) == Some(&b'.');
                if is_memory {
                    // Joins `memory` and the name after it into one name of the same length.
                    plain[at + length] = b'_';
                }
                length + usize::from(is_memory)
            }
            _ => 1,
        };
    }
    let components = reduce(&mut plain);
    // Only whole characters were blanked, so that the text is still valid UTF-8.
    (String::from_utf8(plain).unwrap_or_default(), components)
}

/// Whether `--` at a byte begins a remark, which blanks part from an operator such as that of `i--`.
fn is_remark_of_lua(text: &[u8], at: usize) -> bool {
    let is_apart = |byte: Option<&u8>| byte.is_none_or(u8::is_ascii_whitespace);
    text[at..].starts_with(b"--")
        && is_apart(at.checked_sub(1).map(|before| &text[before]))
        && (is_apart(text.get(at + 2)) || matches!(text[at + 2], b'-' | b'['))
}

/// Whether a colon between these texts stands before a method, rather than in `c ? a : b`.
fn is_method_of_lua(before: &str, after: &str) -> bool {
    let statement = before.rfind(['\n', ';', '{', '}']).map_or(before, |end| &before[end..]);
    let name = after.bytes().take_while(|byte| is_name_part(*byte)).count();
    before.ends_with(|c: char| c.is_ascii_alphanumeric() || "_)]".contains(c))
        && after.starts_with(is_name_start)
        && after[name..].starts_with('(')
        && !statement.contains('?')
}

fn line_length(rest: &[u8]) -> usize {
    rest.iter().take_while(|byte| **byte != b'\n').count()
}

/// Returns the lengths of a number and of its suffix.
pub(super) fn number_length(rest: &[u8]) -> (usize, usize) {
    let digits = |from: usize| {
        rest[from..].iter().take_while(|byte| byte.is_ascii_digit() || **byte == b'.').count()
    };
    let mut length = digits(0);
    if matches!(rest.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(rest.get(length + 1), Some(b'+' | b'-')));
        let exponent = rest.get(length + 1 + sign..).map_or(0, |_| digits(length + 1 + sign));
        length += if exponent > 0 { 1 + sign + exponent } else { 0 };
    }
    let after = &rest[length..];
    let ends = |suffix: &&&str| {
        after.starts_with(suffix.as_bytes())
            && !after.get(suffix.len()).copied().is_some_and(is_name_part)
    };
    // A number in single precision follows that in double precision.
    if let [b'|', b'0'..=b'9', ..] = after {
        let (single, suffix) = number_length(&after[1..]);
        return (length, 1 + single + suffix);
    }
    let suffix = SUFFIXES.iter().find(ends).filter(|_| rest[0] != b'.' || length > 1);
    (length.max(1), suffix.map_or(0, |suffix| suffix.len()))
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn foreign_syntax_becomes_blanks_and_no_byte_moves() {
        for (written, read) in [
            ("x += 0.2f * v; // drag", "x += 0.2  * v;        "),
            ("x = 1e-3F # £", "x = 1e-3      "),
            ("v *= Mathf.Exp(-k)", "v *=       exp(-k)"),
            ("a = Math.PI / 2.0_f32", "a =      pi / 2.0    "),
            ("x /* a\nb */ = x0f", "x     \n     = x0f"),
            ("\u{feff}x = 1.f;\r\n", "   x = 1. ; \n"),
            ("h = Time.deltaTime", "h =      deltaTime"),
            ("takes a(x, v): it\nx = memory.y", "takes a(x, v)    \nx = memory_y"),
            ("x = 4e-15|2e-6 * v", "x = 4e-15      * v"),
            (".", "."),
            ("1e", "1e"),
            ("/*", "/*"),
            ("-- all\nx = -v -- x\n--", "      \nx = -v     \n  "),
            ("x = x --v", "x = x --v"),
            ("x ~= v", "x != v"),
            ("x = x:Lerp(1) + (v):abs()", "x = x.Lerp(1) + (v).abs()"),
            ("x = v ? x:abs(v) : 1", "x = v ? x:abs(v) : 1"),
        ] {
            assert_eq!(plain(written).0, read, "{written}");
            assert_eq!(plain(written).0.len(), written.len());
        }
    }
}
