//! Finds the known name that a misspelt one probably means.

use crate::sim::integrators::plain;
use crate::sim::law::Remedy;

/// Smallest Jaro-Winkler similarity, from 0 to 1, at which a known name is offered for a misspelt one. The tests below
/// show its effect.
const ALIKE: f64 = 0.8;

/// Longer words are not compared, because no known name is like them, and comparing takes time.
const MAX_CHARS: usize = 64;

/// Returns the only name that contains `written`. If there is none or several, it returns the name with the most
/// similar spelling, if one is similar enough. A name may have several spellings. Case, blanks and the kind of hyphen
/// do not matter.
pub fn nearest<'n>(
    written: &str,
    names: impl Iterator<Item = (&'n str, &'n str)>,
) -> Option<&'n str> {
    if written.chars().nth(MAX_CHARS).is_some() {
        return None;
    }
    let written = plain(written);
    let names: Vec<_> = names.map(|(spelling, name)| (plain(spelling), name)).collect();

    let mut whole = names.iter().filter(|(spelling, _)| spelling.contains(&written));
    if let Some((_, name)) = whole.next()
        && written.len() > 1
        && whole.all(|(_, other)| other == name)
    {
        return Some(name);
    }
    // Typing errors seldom hit the first letter. Without this rule, `planet` would be like `lane`.
    let likely =
        names.iter().filter(|(spelling, _)| spelling.chars().next() == written.chars().next());
    likely
        .map(|(spelling, name)| (strsim::jaro_winkler(&written, spelling), *name))
        .filter(|(likeness, _)| *likeness >= ALIKE)
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, name)| name)
}

/// Returns the remedy for an unknown name.
pub(super) fn offer(nearest: Option<&str>, known: &[impl AsRef<str>], quote: char) -> String {
    match nearest {
        Some(name) => format!("did you mean {}?", listed(&[name], quote, "")),
        None => format!("write one of {}", listed(known, quote, ", ")),
    }
}

/// Returns the remedy for a fault of an expression, in words.
pub(super) fn words(remedy: Remedy) -> String {
    match remedy {
        Remedy::Words(words) => words,
        Remedy::Name { written, known } => {
            offer(nearest(&written, known.iter().map(|name| (&**name, &**name))), &known, '`')
        }
    }
}

/// Puts names in quotes and joins them with `between`. With the quote `[`, a name is written as a table array.
pub(super) fn listed(names: &[impl AsRef<str>], quote: char, between: &str) -> String {
    let quoted = names.iter().map(AsRef::as_ref).map(|name| match quote {
        '[' => format!("`[[{name}]]`"),
        _ => format!("{quote}{name}{quote}"),
    });
    quoted.collect::<Vec<_>>().join(between)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn only_a_slip_or_a_part_finds_the_nearest_name() {
        let names = [
            ("explicit-euler", "explicit-euler"),
            ("semi-implicit-euler", "semi-implicit-euler"),
            ("rk4", "rk4"),
            ("Runge-Kutta 4", "rk4"),
            ("mass_kg", "mass_kg"),
            ("tick_hz", "tick_hz"),
            ("lane", "lane"),
            ("command", "command"),
        ];
        for (written, name) in [
            ("rk5", Some("rk4")),
            ("RK4", Some("rk4")),
            ("runge kutta", Some("rk4")),
            ("explicit_euler", Some("explicit-euler")),
            ("explict-euler", Some("explicit-euler")),
            ("semi-implicit", Some("semi-implicit-euler")),
            ("mass", Some("mass_kg")),
            ("kg", Some("mass_kg")),
            ("tickrate_hz", Some("tick_hz")),
            ("lanes", Some("lane")),
            ("euler", None),
            ("planet", None),
            ("colour", None),
            ("k", None),
            ("", None),
        ] {
            assert_eq!(nearest(written, names.into_iter()), name, "{written:?}");
        }
        assert_eq!(nearest(&"mass_kg".repeat(10), names.into_iter()), None);
    }
}
