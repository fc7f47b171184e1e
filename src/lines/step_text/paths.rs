//! Reduces the dotted names of other languages, such as `player.velocity.x` and `Mathf.Exp`, to names of a step.

use std::ops::Range;

use super::names::{LONE_PLACES, OTHER_PLACE, STEP_NAMES, assigns, is_name_of};
use super::statements::Statement;
use super::{TARGET, V, X};
use crate::fault::{ExpressionFault, fault};
use crate::function::Function;
use crate::token::is_name_part;

/// Names before a function or a number that are no value.
const NAMESPACES: [&str; 9] = ["math", "std", "f32", "f64", "glm", "np", "numpy", "this", "self"];
/// Words before an argument that the call changes.
const REFERENCES: [&str; 3] = ["ref", "out", "inout"];
const SEPARATORS: [&str; 3] = [".", "::", "->"];
/// Names of a body's own parts, which are no other body.
const OWN_PARTS: [&str; 9] =
    ["this", "self", "transform", "body", "rb", "rigidbody", "sprite", "node", "instance"];

/// Vectors whose components are no places.
const NO_PLACES: [&str; 12] = [
    "acc",
    "accel",
    "acceleration",
    "dir",
    "direction",
    "input",
    "gravity",
    "force",
    "wind",
    "size",
    "scale",
    "move",
];

/// Functions that differ from ours of the same name, each with its name here. Unity's keep their part between 0 and 1.
const OTHERS: [(&str, &str); 9] = [
    ("Mathf.Lerp", "lerp01"),
    ("Vector2.Lerp", "lerp01"),
    ("Vector3.Lerp", "lerp01"),
    ("Mathf.InverseLerp", "inverseLerp01"),
    ("Math.round", "roundUp"),
    ("Math.Round", "roundEven"),
    ("MathF.Round", "roundEven"),
    ("Mathf.Round", "roundEven"),
    ("Mathf.RoundToInt", "roundEven"),
];

/// A component of a vector that a text reads or assigns, such as the `x` of `velocity.x`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Component {
    pub(super) at: usize,
    pub(super) letter: u8,
}

/// The bodies that a text names, by the names before those of their places and velocities.
#[derive(Debug, Default)]
struct Bodies {
    /// Those that the lines move; the empty name is that of lines that name none.
    own: Vec<String>,
    /// The body to whose place the lines draw theirs, if it is the only other one, and no line names a target.
    goal: Option<String>,
    /// Whether the lines have no place but those of [`LONE_PLACES`].
    is_lone: bool,
}

impl Bodies {
    fn of(text: &[u8], paths: &[Vec<Range<usize>>]) -> Self {
        let whole = std::str::from_utf8(text).unwrap_or_default();
        let all = || paths.iter().flat_map(|parts| names(text, parts));
        let is_lone = !all().any(|name| is_name_of(X, &name));
        let (mut own, mut read) = (Vec::new(), Vec::new());
        let (mut has_target, mut has_place) = (false, false);
        for parts in paths {
            let (names, end) = (names(text, parts), parts[parts.len() - 1].end);
            let after = whole.get(end..).unwrap_or_default();
            let is_call = after.trim_start().starts_with('(');
            let values = &names[..names.len() - usize::from(is_call && names.len() > 1)];
            has_target |= values.iter().any(|name| is_name_of(TARGET, name));
            let (value, _) = meant(values, is_lone);
            let is_place = is_place(&values[value], is_lone);
            if !is_place && !is_name_of(V, &values[value]) {
                continue;
            }
            let owner = owner(&values[..value]);
            if assigns(after) {
                own.push(owner);
                has_place |= is_place;
            } else if is_place {
                read.push(owner);
            }
        }
        let mut others = read.iter().filter(|owner| !own.contains(owner));
        has_place |= read.iter().any(|owner| own.contains(owner));
        let goal = others.next().filter(|first| others.all(|other| other == *first));
        let is_no_place = |goal: &&String| {
            let last = goal.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
            NO_PLACES.contains(&&*last)
        };
        let goal = goal.filter(|_| has_place && !has_target);
        let goal = goal.filter(|goal| !is_no_place(goal)).cloned();
        Self { own, goal, is_lone }
    }

    /// Whether the body of these names is another than those that the lines move.
    fn is_other(&self, owner: &str) -> bool {
        !owner.is_empty() && !self.own.is_empty() && !self.own.iter().any(|own| own == owner)
    }
}

/// Returns the name of a body, without those of its parts.
fn owner(names: &[String]) -> String {
    let is_part = |name: &&String| OWN_PARTS.contains(&&*name.to_ascii_lowercase());
    names.iter().filter(|name| !is_part(name)).map(String::as_str).collect::<Vec<_>>().join(".")
}

/// Blanks all but one name of each dotted name, so that no byte moves. Keeps the point before a method of a value.
/// Returns the components of vectors.
pub(super) fn reduce(text: &mut [u8]) -> Vec<Component> {
    let paths = paths(text);
    let bodies = Bodies::of(text, &paths);
    let (mut at, mut paths, mut components) = (0, paths.iter().peekable(), Vec::new());
    while at < text.len() {
        let before = text[..at].iter().rfind(|byte| !byte.is_ascii_whitespace());
        let is_argument = matches!(before, Some(b'(' | b','));
        let path = paths.next_if(|parts| parts[0].start == at);
        let end = path.map_or(at + 1, |parts| parts[parts.len() - 1].end);
        match path.map(Vec::as_slice) {
            Some([word]) => {
                let is_reference = REFERENCES.iter().any(|it| it.as_bytes() == &text[word.clone()]);
                if is_argument && is_reference && text.get(end) == Some(&b' ') {
                    text[word.clone()].fill(b' ');
                }
            }
            Some(parts) => components.extend(reduce_path(text, parts, &bodies)),
            None if text[at] == b'&' && is_argument => text[at] = b' ',
            None => {}
        }
        at = end;
    }
    merge_copies(text);
    components
}

/// Gives a place or a velocity and its copy one name, as in `pos = position`, the shorter one.
fn merge_copies(text: &mut [u8]) {
    let whole = String::from_utf8_lossy(text).into_owned();
    for statement in whole.split([';', '\n', '{', '}']) {
        let Some((left, right)) = statement.split_once('=') else { continue };
        let (left, right) = (left.split_whitespace().next_back(), right.trim());
        let is =
            |index| left.is_some_and(|left| is_name_of(index, left)) && is_name_of(index, right);
        let Some(left) = left.filter(|left| *left != right && (is(X) || is(V))) else { continue };
        let (short, long) = if left.len() < right.len() { (left, right) } else { (right, left) };
        let mut at = 0;
        while at < text.len() {
            let length = text[at..].iter().take_while(|byte| is_name_part(**byte)).count();
            if text[at..at + length] == *long.as_bytes() {
                text[at..at + length].fill(b' ');
                text[at..at + short.len()].copy_from_slice(short.as_bytes());
            }
            at += length.max(1);
        }
    }
}

/// Returns the parts of each name of a text, dotted or not.
fn paths(text: &[u8]) -> Vec<Vec<Range<usize>>> {
    let (mut at, mut paths) = (0, Vec::new());
    while at < text.len() {
        match text[at] {
            // A number, or a method after a value in brackets.
            byte if byte.is_ascii_digit() || byte == b'.' => {
                at += 1;
                at += text[at..].iter().take_while(|byte| is_name_part(**byte)).count();
            }
            byte if is_name_part(byte) => {
                paths.push(parts(text, at));
                at = paths[paths.len() - 1].last().map_or(at + 1, |part| part.end);
            }
            _ => at += 1,
        }
    }
    paths
}

fn names(text: &[u8], parts: &[Range<usize>]) -> Vec<String> {
    parts.iter().map(|part| String::from_utf8_lossy(&text[part.clone()]).into_owned()).collect()
}

/// Returns the names of the dotted name at a byte.
fn parts(text: &[u8], mut at: usize) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    loop {
        let length = text[at..].iter().take_while(|byte| is_name_part(**byte)).count();
        parts.push(at..at + length);
        let rest = &text[at + length..];
        let separator = SEPARATORS.iter().find(|separator| rest.starts_with(separator.as_bytes()));
        let begins_name = |byte: &u8| byte.is_ascii_alphabetic() || *byte == b'_';
        match separator {
            Some(separator) if rest.get(separator.len()).is_some_and(begins_name) => {
                at += length + separator.len();
            }
            _ => return parts,
        }
    }
}

fn reduce_path(text: &mut [u8], parts: &[Range<usize>], bodies: &Bodies) -> Option<Component> {
    let names = names(text, parts);
    let (first, last, end) = (&names[0], parts.len() - 1, parts[parts.len() - 1].end);
    let blanks = text[end..].iter().take_while(|byte| **byte == b' ').count();
    let is_call = text.get(end + blanks) == Some(&b'(');
    let is_namespace = first.starts_with(|c: char| c.is_ascii_uppercase())
        || text[parts[0].end] == b':'
        || NAMESPACES.contains(&&**first) && (parts.len() == 2 || !is_call);
    let is_step_call = STEP_NAMES.contains(&&*names[last])
        && names[last] != "elapsed"
        && text[end + blanks..].starts_with(b"()");
    let mut component = None;
    let mut kept = vec![last];
    let mut goal_at = None;
    if is_step_call {
        text[end + blanks..end + blanks + 2].fill(b' ');
    } else if !(is_namespace && is_call) {
        let values = &names[..parts.len() - usize::from(is_call)];
        let (mut value, letter) = meant(values, bodies.is_lone);
        let of_body = owner(&values[..value]);
        if is_place(&values[value], bodies.is_lone) && bodies.is_other(&of_body) {
            // Without a place of their own the lines are not drawn to this one: it is a name without a value.
            value -= 1;
            goal_at = (bodies.goal.as_ref() == Some(&of_body)).then_some(value);
        }
        component = letter.map(|letter| Component { at: parts[value].start, letter });
        kept = if is_call { vec![value, last] } else { vec![value] };
        if is_call {
            text[parts[last].start - 1] = b'.';
        }
    }
    let path = parts[0].start..end;
    let is_kept = |at: usize| {
        kept.iter().any(|part| parts[*part].contains(&at))
            || kept.len() > 1 && at + 1 == parts[last].start
    };
    path.filter(|at| !is_kept(*at)).for_each(|at| text[at] = b' ');
    if let Some(body) = goal_at.map(|value| parts[value].clone()) {
        text[body.clone()].fill(b' ');
        text[body.start..body.start + OTHER_PLACE.len()].copy_from_slice(OTHER_PLACE.as_bytes());
    }
    let written = names.join(".");
    if let Some((_, name)) = OTHERS.iter().find(|(path, _)| is_call && *path == written) {
        text[parts[0].start..end].fill(b' ');
        text[parts[0].start..parts[0].start + name.len()].copy_from_slice(name.as_bytes());
    } else if is_namespace {
        lower_name(&mut text[parts[kept[0]].start..]);
    }
    component
}

/// Lower-cases the name at the start to the spelling of names here, for example `Lerp` to `lerp`, and `PI` to `pi`.
fn lower_name(plain: &mut [u8]) {
    let length = plain.iter().take_while(|byte| is_name_part(**byte)).count();
    let name = &mut plain[..length];
    let is_shouted = name.iter().all(|byte| !byte.is_ascii_lowercase());
    let count = if is_shouted { length } else { length.min(1) };
    name[..count].make_ascii_lowercase();
}

fn is_place(name: &str, is_lone: bool) -> bool {
    is_name_of(X, name) || is_lone && LONE_PLACES.contains(&name)
}

/// Returns the index of the name that is a number of a step, and the letter of its component.
fn meant(names: &[String], is_lone: bool) -> (usize, Option<u8>) {
    let last = names.len() - 1;
    let letter = match &*names[last].to_ascii_lowercase() {
        "x" => Some(b'x'),
        "y" => Some(b'y'),
        "z" => Some(b'z'),
        _ => None,
    };
    let letter_of = |value: usize| letter.filter(|_| value != last);
    if let Some(target) = names.iter().position(|name| is_name_of(TARGET, name)) {
        return (target, letter_of(target));
    }
    let owner = last.checked_sub(1).filter(|_| letter.is_some());
    let is_vector = |name: &str| is_place(name, is_lone) || is_name_of(V, name);
    match owner.filter(|owner| is_vector(&names[*owner])) {
        Some(owner) => (owner, letter),
        None => (last, letter.filter(|_| last > 0)),
    }
}

/// Returns the byte range of the velocity that a value changes, if it is a call of Unity's `SmoothDamp`.
pub(super) fn damped_velocity(text: &str, value: &Range<usize>) -> Option<Range<usize>> {
    let call = &text[value.clone()];
    let open = call.find('(')?;
    let function = Function::named_in_steps(call[..open].trim())?;
    let (mut depth, mut commas) = (0, Vec::new());
    for (at, sign) in call.char_indices() {
        depth += i32::from(sign == '(') - i32::from(sign == ')');
        commas.extend((sign == ',' && depth == 1).then_some(at));
    }
    let argument = &call[commas.get(1)? + 1..*commas.get(2)?];
    let name = argument.trim();
    let start = value.start + commas[1] + 1 + argument.find(name)?;
    let is_name = name.bytes().all(is_name_part) && !name.is_empty();
    (function.name == SMOOTH_DAMP && is_name).then_some(start..start + name.len())
}

/// Unity's spring, which also assigns its velocity.
pub(super) const SMOOTH_DAMP: &str = "smoothDamp";

/// Returns the number of statements of the first one with its blocks, and its byte range if it is an assignment or an
/// `if`.
fn whole(statements: &[Statement]) -> (usize, Range<usize>) {
    match &statements[0] {
        Statement::Assign { name, value, .. } => (1, name.start..value.end),
        Statement::If(condition) => {
            let mut depth = 0;
            let ends = statements.iter().position(|statement| {
                depth += statement.depth();
                depth == 0
            });
            let last = ends.unwrap_or(statements.len() - 1);
            let end = match &statements[last] {
                Statement::End(end) => end.end,
                _ => condition.end,
            };
            (last + 1, condition.start..end)
        }
        _ => (1, 0..0),
    }
}

/// Returns the statements of the first assigned component of the vectors of a text, and it with the first other.
/// Blanks the others in the text.
pub(super) fn of_one_component(
    text: &mut String,
    mut statements: Vec<Statement>,
    components: &[Component],
) -> Result<(Vec<Statement>, Option<[char; 2]>), ExpressionFault> {
    let is_assigned = |component: &&Component| {
        let begins = |it: &Statement| matches!(it, Statement::Assign { name, .. } if name.start == component.at);
        statements.iter().any(begins)
    };
    let first = components.iter().find(is_assigned).or(components.first());
    let Some(first) = first else { return Ok((statements, None)) };
    let is_other = |component: &&Component| component.letter != first.letter;
    let Some(other) = components.iter().find(is_other) else { return Ok((statements, None)) };
    let mut left = components.iter().filter(is_other).collect::<Vec<_>>();
    let mut at = 0;
    while at < statements.len() {
        let (count, range) = whole(&statements[at..]);
        let within = |component: &&Component| range.contains(&component.at);
        let mut inside = components.iter().filter(within).peekable();
        if inside.peek().is_none() || inside.any(|it| it.letter == first.letter) {
            at += 1;
            continue;
        }
        left.retain(|component| !within(component));
        text.replace_range(range.clone(), &" ".repeat(range.len()));
        statements.drain(at..at + count);
    }
    let letters = [first, other].map(|component| char::from(component.letter));
    match left.first() {
        Some(mixed) => fault(
            mixed.at..mixed.at + 1,
            format!("a line mixes the components {} and {} of vectors", letters[0], letters[1]),
            "a step moves one number: write the lines of one component",
        ),
        None => Ok((statements, Some(letters))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dotted_name_becomes_one_name_and_no_byte_moves() {
        for (written, read, letters) in [
            ("v *= Mathf.Exp(-k)", "v *=       exp(-k)", ""),
            ("player.velocity.x *= 0.9", "       velocity   *= 0.9", "x"),
            ("position.lerp(target.position, 1)", "position.lerp(target         , 1)", ""),
            ("this.pos->lerp(goal.y, 1)", "     pos .lerp(goal  , 1)", "y"),
            ("this.x += rb.speed", "     x +=    speed", "x"),
            ("x = Math.round(x)", "x = roundUp   (x)", ""),
            ("x = Mathf.RoundToInt(x)", "x = roundEven       (x)", ""),
            (
                "var pos = transform.position; pos.x += 1",
                "var pos =           pos     ; pos   += 1",
                "x",
            ),
            (
                "Vector3 vel = rb.velocity; rb.velocity = vel;",
                "Vector3 vel =    vel     ;    vel      = vel;",
                "",
            ),
            ("std::f64::consts::PI", "                  pi", ""),
            ("time.delta_secs()", "     delta_secs  ", ""),
            ("f(x, ref vel, &v) & 0.5.abs()", "f(x,     vel,  v) & 0.5.abs()", ""),
            ("FMath::FInterpTo(x)", "       fInterpTo(x)", ""),
            ("cam.x += (p.x - cam.x) * k", "    x += (__  -     x) * k", "xxx"),
            ("this.x += mouse.x - this.x", "     x += __      -      x", "xxx"),
            ("pos = pos.lerp(player.pos, k)", "pos = pos.lerp(__        , k)", ""),
            ("x += a.x - b.x", "x += a   - b  ", "xx"),
            ("x += a.x - target", "x += a   - target", "x"),
            ("velocity.x += input.x", "velocity   += input  ", "xx"),
            ("a.x += a.y * b.vel.x", "  x +=   y *   vel  ", "xyx"),
        ] {
            let mut text = written.as_bytes().to_vec();
            let found = reduce(&mut text);
            assert_eq!(String::from_utf8(text).unwrap(), read, "{written}");
            let found: String = found.iter().map(|of| char::from(of.letter)).collect();
            assert_eq!(found, letters, "{written}");
        }
    }
}
