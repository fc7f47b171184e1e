//! The conditions of the pieces of a rule in words.

use super::Rule;
use super::pieces::Group;
use crate::sim::law::{SwitchKind, bracketed};

/// Spellings of the distance to the target.
const DISTANCES: [&str; 4] =
    ["abs(target-x)", "abs(x-target)", "fabs(target-x)", "(target-x).abs()"];
/// A distance at which a rule is at rest.
const REST: f64 = 1e-12;

/// A part of a condition, and whether it holds in each way in which the switches are set.
struct Part {
    words: String,
    holds: Vec<bool>,
    /// The switch of a single comparison.
    switch: Option<usize>,
}

impl Rule {
    /// Returns the condition of each group, which holds there and in no other group.
    pub(super) fn labels(&self, groups: &[Group]) -> Vec<String> {
        let modes: Vec<Vec<i64>> = groups.iter().flat_map(|group| group.modes.clone()).collect();
        let mut begin = 0;
        let mut found: Vec<[String; 2]> = Vec::new();
        for group in groups {
            let end = begin + group.modes.len();
            let is_own = |index: usize| (begin..end).contains(&index);
            found.push(self.label(&modes, &is_own));
            begin = end;
        }
        let without = found.iter().filter(|[label, _]| label.is_empty()).count();
        let rest = match &found[..] {
            [[one, _], [other, _]] => format!("{one}{other}"),
            _ => String::new(),
        };
        let rest = match rest.strip_prefix("within ").filter(|rest| !rest.contains(" and ")) {
            Some(limits) => format!("beyond {limits}"),
            None => "elsewhere".into(),
        };
        let named = |[label, other]: [String; 2]| match label.is_empty() {
            true if without == 1 => rest.clone(),
            true => other,
            false => label,
        };
        found.into_iter().map(named).collect()
    }

    /// Returns the condition of the group of these modes, and one to take if several groups have none.
    fn label(&self, modes: &[Vec<i64>], is_own: &dyn Fn(usize) -> bool) -> [String; 2] {
        let joined = self.joined_parts(modes, is_own);
        let is_exact = |parts: &[&Part]| {
            let holds = |index: usize| parts.iter().all(|part| part.holds[index]);
            !parts.is_empty() && (0..modes.len()).all(|index| is_own(index) || !holds(index))
        };
        let simple = self.parts(modes, is_own);
        let [simple, joined]: [Vec<&Part>; 2] = [simple.iter().collect(), joined.iter().collect()];
        let both = [simple.clone(), joined.clone()].concat();
        let before = self.text.switches_before();
        let of = |parts: &[&Part]| {
            let mut parts = parts.to_vec();
            // Of two conditions of which one holds wherever the other does, the narrower one says all.
            let is_wide =
                |part: &Part| [" <= ", " >= "].iter().any(|sign| part.words.contains(sign));
            let is_before = |part: &Part, other: &&Part| {
                let both = part.switch.zip(other.switch);
                both.is_some_and(|(part, other)| before[other].contains(&part))
            };
            for wide in [true, false] {
                for index in (0..parts.len()).rev() {
                    let (part, without) =
                        (parts[index], [&parts[..index], &parts[index + 1..]].concat());
                    let is_narrow = wide || !without.iter().any(|other| is_wide(other));
                    let is_last = !without.iter().any(|other| is_before(part, other));
                    if is_wide(part) == wide && is_narrow && is_last && is_exact(&without) {
                        parts = without;
                    }
                }
            }
            let mut label = String::new();
            for (index, part) in parts.iter().enumerate() {
                // A number that a branch has changed is compared after it.
                let is_after = part.switch.is_some_and(|switch| {
                    let mut earlier = parts[..index].iter().filter_map(|part| part.switch);
                    earlier.any(|earlier| before[switch].contains(&earlier))
                });
                let and = match (label.is_empty(), is_after) {
                    (true, _) => "",
                    (false, false) => " and ",
                    (false, true) => ", then ",
                };
                let follows = label.starts_with("while ") || label.contains(" and while ");
                let words = part.words.strip_prefix("while ").filter(|_| follows);
                label += &format!("{and}{}", words.unwrap_or(&part.words));
            }
            label
        };
        let is_not = joined.iter().any(|part| part.words.starts_with("while not "));
        if is_exact(&simple) {
            return [of(&simple), String::new()];
        }
        if is_exact(&joined) {
            // The opposite of a long condition is elsewhere, if all other pieces have their own.
            let label = of(&joined);
            return if is_not { [String::new(), label] } else { [label, String::new()] };
        }
        let label = if is_exact(&both) { of(&both) } else { String::new() };
        [label, "in other cases".into()]
    }

    /// Returns the conditions of several comparisons by which the own modes differ from the others.
    fn joined_parts(&self, modes: &[Vec<i64>], is_own: &dyn Fn(usize) -> bool) -> Vec<Part> {
        let mut parts = Vec::new();
        for (source, truths) in self.text.joined(self.step_length(self.fps), modes) {
            let source = source.split_whitespace().collect::<Vec<_>>().join(" ");
            let source = bracketed(&source).map_or(&*source, str::trim);
            let words = |is_true| match is_true {
                true => format!("while {source}"),
                false => format!("while not ({source})"),
            };
            parts.extend(common(&truths, is_own, |is_true| Some(words(is_true))));
        }
        parts
    }

    /// Returns the conditions of one switch each by which the own modes differ from the others.
    fn parts(&self, modes: &[Vec<i64>], is_own: &dyn Fn(usize) -> bool) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        let (text, h) = (&self.text, self.step_length(self.fps));
        let switches: Vec<(SwitchKind, &str)> = text.switches().collect();
        let (free, before) = (text.free_modes(), text.switches_before());
        let at_rest = text.modes(h, &vec![REST; text.carried().len()], 0.0);
        for (index, (kind, source)) in switches.iter().enumerate() {
            // The two limits of a `clamp` are one switch, of mode 1 if both leave its number.
            let twins: Vec<usize> =
                (0..switches.len()).filter(|other| switches[*other] == switches[index]).collect();
            let is_clamp = *kind == SwitchKind::Limit && twins.len() == 2;
            let mode_of = |modes: &Vec<i64>, has_sides: bool| match text.truth(index, modes[index])
            {
                Some(is_true) => i64::from(is_true),
                None if is_clamp => match twins.iter().rposition(|index| modes[*index] != 1) {
                    Some(side) if has_sides => 2 * side as i64,
                    beyond => i64::from(beyond.is_none()),
                },
                None => modes[index],
            };
            let source = source.split_whitespace().collect::<Vec<_>>().join(" ");
            let within = if is_clamp { 1 } else { free[index].unwrap_or(at_rest[index]) };
            let words = |mode, has_sides| {
                Some(match kind {
                    SwitchKind::Condition => condition(&source, mode == 1),
                    SwitchKind::Limit if mode == within => {
                        format!("within the limits of `{source}`")
                    }
                    SwitchKind::Limit if is_clamp && has_sides => {
                        let side = if mode == 0 { "lower" } else { "upper" };
                        format!("at the {side} limit of `{source}`")
                    }
                    SwitchKind::Limit if is_clamp => format!("beyond the limits of `{source}`"),
                    SwitchKind::Limit => format!("at a limit of `{source}`"),
                    SwitchKind::Sign => {
                        let operator = if mode == 1 { ">" } else { "<" };
                        match argument(&source) {
                            Some(argument) => format!("while {argument} {operator} 0"),
                            None => format!("while the number of `{source}` {operator} 0"),
                        }
                    }
                    SwitchKind::Many => return None,
                })
            };
            let part = [true, false].into_iter().find_map(|has_sides| {
                let modes: Vec<i64> = modes.iter().map(|modes| mode_of(modes, has_sides)).collect();
                common(&modes, is_own, |mode| words(mode, has_sides))
            });
            let Some(part) = part.map(|part| Part { switch: Some(index), ..part }) else {
                continue;
            };
            let is_known = |it: &Part| {
                let is_later = it.switch.is_some_and(|earlier| before[index].contains(&earlier));
                it.words == part.words && (is_clamp || !is_later)
            };
            if !parts.iter().any(is_known) {
                parts.push(part);
            }
        }
        parts
    }
}

/// Returns the part of the value that all own modes have, unless all others have it, too.
fn common<T: Copy + PartialEq>(
    values: &[T],
    is_own: &dyn Fn(usize) -> bool,
    words: impl Fn(T) -> Option<String>,
) -> Option<Part> {
    let own = values[(0..values.len()).find(|index| is_own(*index))?];
    let holds: Vec<bool> = values.iter().map(|value| *value == own).collect();
    let is_common = (0..values.len()).all(|index| holds[index] || !is_own(index));
    let differs = is_common && holds.contains(&false);
    Some(Part { words: words(own).filter(|_| differs)?, holds, switch: None })
}

/// Returns the argument of a call with one.
fn argument(call: &str) -> Option<&str> {
    let (_, argument) = call.split_once('(')?;
    let argument = argument.strip_suffix(')')?;
    (!argument.contains(['(', ','])).then_some(argument.trim())
}

/// Writes a comparison of the lines that is true or false.
fn condition(source: &str, is_true: bool) -> String {
    const OPPOSITES: [(&str, &str); 8] = [
        ("<=", ">"),
        (">=", "<"),
        ("===", "!=="),
        ("!==", "==="),
        ("==", "!="),
        ("!=", "=="),
        ("<", ">="),
        (">", "<="),
    ];
    if let Some(inside) = bracketed(source) {
        return condition(inside.trim(), is_true);
    }
    let (mut depth, mut found) = (0, None);
    for (at, sign) in source.char_indices() {
        depth += i32::from(sign == '(') - i32::from(sign == ')');
        let operator = OPPOSITES.iter().find(|(operator, _)| source[at..].starts_with(operator));
        if depth == 0 && found.is_none() {
            found = operator.map(|(operator, opposite)| (at, *operator, *opposite));
        }
    }
    let Some((at, operator, opposite)) = found else {
        return format!("{} {source}", if is_true { "while" } else { "while not" });
    };
    let sign = if is_true { operator } else { opposite };
    let [left, right] = [&source[..at], &source[at + operator.len()..]].map(str::trim);
    let is_distance = |side: &str| DISTANCES.contains(&&*side.replace(' ', ""));
    match (is_distance(left), is_distance(right), sign.as_bytes()[0]) {
        (true, false, b'<') => format!("within {right} of the target"),
        (true, false, b'>') => format!("beyond {right} of the target"),
        (false, true, b'<') => format!("beyond {left} of the target"),
        (false, true, b'>') => format!("within {left} of the target"),
        _ => format!("while {left} {sign} {right}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_condition_holds_in_its_piece_and_in_no_other() {
        let rest = "{ v *= 0.9 } else { v *= 0.5 } x += v*dt";
        let labels = |lines: &str| -> Vec<String> {
            let pieces = Rule::read(lines, 60.0).unwrap().pieces().into_iter();
            pieces.map(|piece| piece.condition).collect()
        };
        for (condition, found) in [
            ("x > 10 or x < 0 and v > 0", ["while x > 10 or x < 0 and v > 0", "elsewhere"]),
            ("(x > 10 || v > 5) && x < 90", ["while (x > 10 || v > 5) && x < 90", "elsewhere"]),
            ("not (x > 10 and v > 0)", ["while x > 10 and v > 0", "elsewhere"]),
            ("x > 1 and x < 9", ["while x > 1 and x < 9", "elsewhere"]),
            ("x > 10 or v > 5", ["while x > 10 or v > 5", "while x <= 10 and v <= 5"]),
        ] {
            let mut all = labels(&format!("if {condition} {rest}"));
            all.sort_by_key(|label| label == "elsewhere");
            let mut found = found.map(str::to_owned).to_vec();
            all.sort();
            found.sort();
            assert_eq!(all, found, "{condition}");
        }
        // No label for two of three pieces, by single comparisons or by all.
        let lines = "if x > 10 or v > 5 and x < 3 { v *= 0.9 } if v > 7 or x < -10 and v > 2 { v *= 0.5 }\nx += v*dt";
        let all = labels(lines);
        let bare = all.iter().filter(|label| *label == "elsewhere").count();
        assert!(all.len() == 4 && bare < 2, "{all:?}");
    }

    #[test]
    fn a_number_that_a_branch_has_changed_is_compared_after_it() {
        for (lines, wanted) in [
            (
                "if x < target { x += 3*dt } if x > target { x -= 3*dt }",
                &[
                    "while x < target, then x <= target",
                    "while x >= target, then x > target",
                    "while x < target, then x > target",
                ][..],
            ),
            (
                "x += v*dt; x = clamp(x, 0, 100)",
                &[
                    "within the limits of `clamp(x, 0, 100)`",
                    "at the lower limit of `clamp(x, 0, 100)`",
                    "at the upper limit of `clamp(x, 0, 100)`",
                ],
            ),
            (
                "v = clamp(v, -3, 3); x += v*dt",
                &[
                    "within the limits of `clamp(v, -3, 3)`",
                    "beyond the limits of `clamp(v, -3, 3)`",
                ],
            ),
            ("v -= sign(v)*3*dt; x += v*dt", &["while v > 0", "while v < 0"]),
            (
                "v += 6*dt; if v > 3 { v = 3 } if v < -3 { v = -3 } x += v*dt",
                &["while v > 3", "while v <= 3, then v >= -3", "when v <= 3, then v < -3"],
            ),
            (
                "if target > x { x += 9*dt } else if target < x { x -= 5*dt }",
                &["while target > x", "while target < x"],
            ),
        ] {
            let pieces = Rule::read(lines, 60.0).unwrap().pieces();
            let mut found: Vec<&str> = pieces.iter().map(|piece| &*piece.condition).collect();
            let mut wanted = wanted.to_vec();
            found.sort_unstable();
            wanted.sort_unstable();
            assert_eq!(found, wanted, "{lines}");
        }
    }
}
