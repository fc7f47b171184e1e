//! The names by which games call the numbers of a step.

use std::collections::HashSet;

use super::{BUILT_IN, H, TARGET, V, X};

/// Other names of the length of a step.
pub(super) const STEP_NAMES: [&str; 13] = [
    "dt",
    "delta",
    "deltaTime",
    "delta_time",
    "delta_seconds",
    "DeltaTime",
    "fixedDeltaTime",
    "deltaSeconds",
    "DeltaSeconds",
    "delta_secs",
    "delta_secs_f64",
    "getDelta",
    "elapsed",
];

/// The place of another body, which the lines draw theirs to. No person writes this name.
pub(super) const OTHER_PLACE: &str = "__";

/// Names that games use for `x`, `v` and `target`, between blanks, also with a capital. One is valid unless the text
/// uses the original, or an earlier one.
const OTHER_NAMES: [(usize, &str); 3] = [
    (X, "pos position global_position translation cFrame value current"),
    (
        V,
        "velocity vel speed vx velX vel_x hsp hspeed vspeed vy velY vel_y vsp angular_velocity angularVelocity \
         xvel x_vel xVel xVelocity x_velocity velocityX velocity_x speedX speed_x velx hspd dx \
         yvel y_vel yVel yVelocity y_velocity velocityY velocity_y speedY speed_y vely vspd dy",
    ),
    (
        TARGET,
        "goal desired targetPos target_pos targetPosition target_position targetX target_x targetY target_y \
         targetAngle target_angle targetRotation target_rotation tx xTo dest destination mouseX mouse_x playerX \
         player_x endX end_x ty yTo mouseY mouse_y playerY player_y endY end_y __",
    ),
];

/// Names of `v` that may also be a distance, which the lines set before they read it.
const DIFFERENCES: [&str; 2] = ["dx", "dy"];

/// Names of `x` in lines that assign them and have no other place.
pub(super) const LONE_PLACES: [&str; 3] = ["rotation", "angle", "y"];

fn names_of(index: usize) -> impl Iterator<Item = &'static str> + Clone {
    let others = OTHER_NAMES.iter().filter(move |(other, _)| *other == index);
    [BUILT_IN[index]].into_iter().chain(others.flat_map(|(_, names)| names.split_whitespace()))
}

/// Whether a name may be one of the numbers of a step.
pub(super) fn is_name_of(index: usize, name: &str) -> bool {
    names_of(index).any(|known| known == name || capital(known) == name)
}

/// Returns the words of a text that mean `x`, `v` and `target`, each with its index.
pub(super) fn meant(text: &str) -> Vec<(usize, String)> {
    let words: HashSet<&str> =
        text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').collect();
    let is_assigned = |name: &str| after_each(text, name).any(assigns);
    let word = |index: usize| {
        let lone = LONE_PLACES.iter().filter(|name| index == X && is_assigned(name));
        let small = names_of(index).chain(lone.copied());
        let is_other = |name: &str| match index {
            X => false,
            _ if BUILT_IN.contains(&name) => false,
            V => is_set(text, name, !DIFFERENCES.contains(&name)),
            _ => is_set(text, name, false),
        };
        let mut all = small.clone().map(str::to_owned).chain(small.map(capital));
        Some((index, all.find(|name| words.contains(&**name) && !is_other(name))?))
    };
    let mut all: Vec<(usize, String)> = [X, V, TARGET].into_iter().filter_map(word).collect();
    let found = |wanted: usize| all.iter().find(|(index, _)| *index == wanted);
    if found(TARGET).is_none()
        && let Some(pair) = of_own_target(text, &words, found(X).map(|(_, place)| &**place))
    {
        all.retain(|(index, _)| *index != X);
        all.extend(pair);
    }
    all
}

/// Returns the first assigned name of a text that has a target by its name, such as `zoom` beside `target_zoom`. If the
/// text has a place, only that can be it.
fn of_own_target(
    text: &str,
    words: &HashSet<&str>,
    place: Option<&str>,
) -> Option<[(usize, String); 2]> {
    let is_place = |word: &&str| !word.is_empty() && place.is_none_or(|place| place == *word);
    let mut places: Vec<&str> = words.iter().copied().filter(is_place).collect();
    places.sort_unstable();
    places.into_iter().find_map(|place| {
        let [small, large] = [place.to_owned(), capital(place)];
        let targets = [
            format!("target_{small}"),
            format!("target{large}"),
            format!("{small}_target"),
            format!("{small}Target"),
        ];
        let is_assigned = || after_each(text, place).any(assigns);
        let found = targets.into_iter().find(|target| words.contains(&**target))?;
        is_assigned().then_some([(X, small), (TARGET, found)])
    })
}

/// Returns the names of the length of a step that the lines take for another number. Only the lines of a rule may take
/// the first.
pub(super) fn other_lengths(text: &str, is_rule: bool) -> Vec<&'static str> {
    let short = Some(BUILT_IN[H]).filter(|_| is_rule);
    short.into_iter().chain(STEP_NAMES).filter(|name| is_set(text, name, false)).collect()
}

/// Whether the lines set a number of this name before they read it: once and to digits, if it `is_constant`.
fn is_set(text: &str, name: &str, is_constant: bool) -> bool {
    let mut after = after_each(text, name);
    let Some(first) = after.next() else { return false };
    let Some(value) = first.trim_start().strip_prefix('=').filter(|it| !it.starts_with('=')) else {
        return false;
    };
    let value = &value[..value.find([';', '\n']).unwrap_or(value.len())];
    let reads = after_each(value, name).next().is_some();
    let is_number = || value.trim().trim_start_matches('-').parse::<f64>().is_ok();
    !reads && (!is_constant || is_number() && !after.any(assigns))
}

/// Returns the text after each place where this word stands.
pub(super) fn after_each<'t>(text: &'t str, word: &str) -> impl Iterator<Item = &'t str> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let around = move |(at, _)| [&text[..at], &text[at + word.len()..]];
    text.match_indices(word)
        .map(around)
        .filter(move |[before, after]| !before.ends_with(is_part) && !after.starts_with(is_part))
        .map(|[_, after]| after)
}

/// Whether a text begins with a sign that assigns the name before it.
pub(super) fn assigns(after: &str) -> bool {
    let after = after.trim_start_matches([' ', '\t']);
    let sign = after.strip_prefix(['+', '-', '*', '/']).unwrap_or(after).strip_prefix('=');
    sign.is_some_and(|rest| !rest.starts_with('='))
}

fn capital(name: &str) -> String {
    name[..1].to_ascii_uppercase() + &name[1..]
}
