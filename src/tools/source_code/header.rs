//! The comment above a method's function, with the description and the limits of the method, from its card.

use super::dialect::Language;
use super::printer::{rates, shows, takes_function, takes_moments};
use crate::sim::integrators::{Engine, Family, Method};
use crate::sim::law::{LoopText, MethodInput, StepBody, StepText};

/// Width of the comment, in characters.
const WIDTH: usize = 96;

/// Shared functions that divide by slopes. With several coordinates, the slopes are matrices.
const SOLVERS: [&str; 2] = ["slope", "solve"];

/// Returns the lines of the comment above a method's function.
pub(super) fn lines(method: &Method, text: &StepText, language: Language) -> Vec<String> {
    if text.is_spin() {
        return of_spin(method, text, language);
    }
    let claim = |id: &str, general: String| text.claim(id).map_or(general, Into::into);
    let (order, stability) =
        (claim("order", order(method)), claim("stability", stability(method, text)));
    let symplectic = claim("symplectic", symplectic(method).into());
    let mut paragraphs = vec![
        format!("{} ({}): {}.", method.name, method.id, method.about),
        format!("Source: {}.", method.source),
        String::new(),
    ];
    match method.only.filter(|_| method.is_from_outside()) {
        Some(only) => paragraphs.push(format!("Not measured: {}.", only.reason)),
        None => paragraphs.extend([
            format!("Order: {order}. Evaluations per step: {}.", evaluations(method, text)),
            format!("Stability: {stability}."),
            format!("Symplectic: {symplectic}. Reversible: {}.", yes(method.reversible)),
            format!("Memory: {}.", memory(method, text)),
        ]),
    }
    if let Some(tolerance) = method.tolerance {
        let of_x = match tolerance.absolute_q.is_finite() {
            true => "x and v",
            false => "v alone",
        };
        paragraphs.push(format!("Tolerance: the constants in the function, for {of_x}."));
    }
    if !method.keeps_time {
        paragraphs.push("Time: a step may advance by less than h, and does not say so.".into());
    }
    if !method.caveat.is_empty() {
        paragraphs.push(format!("Beware: {}.", method.caveat));
    }
    paragraphs.extend(text.notes().iter().cloned());
    paragraphs.push(String::new());
    let mut functions = text.functions().filter_map(StepBody::function);
    let solves = functions.any(|function| SOLVERS.contains(&function));
    let several = match (takes(text, "force"), solves) {
        // An engine is known only by its inputs, so the header promises nothing about several coordinates.
        (true, _) => String::new(),
        (false, false) => "; for several that feel each other, make them vectors".into(),
        (false, true) => "; for several that feel each other, slopes are matrices and a division is the solution of a \
                          linear system"
            .into(),
    };
    let several = text.claim("several").map_or(several, |own| format!("; {own}"));
    let state = format!("x, v: position and velocity of one coordinate{several}.");
    paragraphs.extend([state, "h: the step, in seconds.".into()]);
    paragraphs.extend(text.method_inputs().iter().map(input));
    if takes(text, "a") {
        let held = "in its middle, t + h / 2; the order is then 2 at most".to_owned();
        paragraphs.push(format!(
            "Forces that depend on time: a is not told it; hold them for the step at their value {}.",
            claim("held", held)
        ));
    }
    paragraphs.push(answer(language, text));
    paragraphs.iter().flat_map(|paragraph| wrapped(paragraph)).collect()
}

/// Returns the lines of the comment above the step of a free spin.
fn of_spin(method: &Method, text: &StepText, language: Language) -> Vec<String> {
    let claims = format!("Order: {}. Reversible: {}.", order(method), yes(method.reversible));
    let mut paragraphs = vec![
        format!("{} ({}): {}.", method.name, method.id, method.about),
        format!("Source: {}.", method.source),
    ];
    let mut add = |lines: &[&str]| paragraphs.extend(lines.iter().map(|line| (*line).to_owned()));
    add(&[""]);
    add(method.formula);
    add(&[
        "",
        &claims,
        "",
        "wx, wy, wz: the angular velocity ω in the frame of the body, in rad/s.",
        "qw, qx, qy, qz: the attitude, a quaternion from that frame to the world.",
    ]);
    if takes_moments(text.body()) {
        add(&[
            "i1, i2, i3: the principal moments I about its axes, in kg m² or any unit; L = I ω.",
        ]);
    }
    add(&[
        "h: the step, in seconds.",
        match language {
            Language::Rust | Language::JavaScript => {
                "Returns the new angular velocity and attitude."
            }
            Language::C => "Replaces w, which is wx, wy, wz, and q, which is qw, qx, qy, qz.",
            Language::CSharp => "Replaces the angular velocity and the attitude.",
            Language::GdScript => "Returns [wx, wy, wz, qw, qx, qy, qz].",
            Language::Lua => "Returns the new wx, wy, wz, qw, qx, qy and qz.",
        },
    ]);
    paragraphs.iter().flat_map(|paragraph| wrapped(paragraph)).collect()
}

/// Returns the lines of the comment above a rule's function.
pub(super) fn of_rule(about: &[String], text: &StepText, language: Language) -> Vec<String> {
    let mut paragraphs = about.to_vec();
    paragraphs.push(String::new());
    paragraphs.push("h: the time since the last call, in seconds.".into());
    paragraphs.extend(text.method_inputs().iter().map(input));
    if !has_no_memory(text) {
        paragraphs.push("Memory: one for each value; make a new one after a jump.".into());
    }
    paragraphs.push(answer(language, text));
    paragraphs.iter().flat_map(|paragraph| wrapped(paragraph)).collect()
}

/// Returns the lines of the comment above a game loop.
pub(super) fn of_loop(id: &str, text: &LoopText, language: Language) -> Vec<String> {
    let claim = |key| LoopText::claim(text.source(), key);
    let sentence = |words: &str| format!("{}.", words.trim_end_matches('.'));
    let name = match [claim("name"), claim("version")] {
        ["", _] => id.to_owned(),
        [name, ""] => format!("{name} ({id})"),
        [name, version] => format!("{name} {version} ({id})"),
    };
    let about = [claim("about"), claim("gives")].into_iter().find(|words| !words.is_empty());
    let mut paragraphs = vec![match about {
        Some(about) => format!("{name}: {}", sentence(about)),
        None => sentence(&name),
    }];
    // A person's remarks above their lines, but for the claims of a card.
    let remarks = text.source().lines().map_while(|line| line.strip_prefix("# "));
    let own = remarks.filter(|remark| about.is_none() && !remark.contains(": "));
    paragraphs.extend(own.map(str::to_owned));
    let known = if claim("version").is_empty() { "Source" } else { "Known by" };
    let more =
        [("Rule", "gives"), ("Constants", "constants"), ("Beware", "caveat"), (known, "known")];
    for (title, key) in more {
        if !claim(key).is_empty() && about != Some(claim(key)) {
            paragraphs.push(format!("{title}: {}", sentence(claim(key))));
        }
    }
    paragraphs.push(String::new());
    let rates = rates(text.text().body());
    if rates.contains(&"tick_hz") {
        let whole =
            if text.is_whole() { ", a whole number, so that no time is rounded" } else { "" };
        paragraphs.push(format!("tick_hz: ticks a second{whole}."));
    }
    if rates.contains(&"refreshes") {
        paragraphs.push(
            "refreshes, seconds: the refreshes of the display in so many seconds: 60 and 1, or 2997 and 50 at 59.94 Hz."
                .into(),
        );
    }
    if rates.contains(&"cost_ms") {
        paragraphs.push("cost_ms: the time that a tick takes the machine, in milliseconds.".into());
    }
    let unit = if text.is_whole() { "nanoseconds" } else { "milliseconds" };
    let (function, handed_on) = match language {
        Language::C => ("game_loop_frame", ", user"),
        Language::CSharp => ("Frame", ""),
        _ => ("frame", ""),
    };
    paragraphs.push(format!(
        "Call {function} once a frame, with the duration of the last one in {unit}. It calls \
         step(seconds{handed_on}) for each tick{}",
        if shows(text.text().body()) {
            ", and returns the moment to draw."
        } else {
            ". Draw the last tick."
        }
    ));
    if shows(text.text().body()) {
        paragraphs.push(drawing(claim("draws")).into());
    }
    paragraphs.iter().flat_map(|paragraph| wrapped(paragraph)).collect()
}

/// Returns how to draw the moment that a loop shows.
fn drawing(drawn: &str) -> &'static str {
    match drawn {
        "Hermite" => {
            "The moment is 0 at the last tick but one and 1 at the last: draw the cubic through the positions and \
             velocities of both."
        }
        "extrapolated" => {
            "The moment is 1 at the last tick and 2 at the next: draw x + v * (moment - 1) * (seconds of a tick)."
        }
        "a copy stepped on" => {
            "The moment is 1 at the last tick and 2 at the next: step a copy on by (moment - 1) * (seconds of a tick), \
             draw it, and drop it."
        }
        _ => {
            "The moment is 0 at the last tick but one and 1 at the last: draw before + (last - before) * moment."
        }
    }
}

/// Whether the step has an input with this name.
fn takes(text: &StepText, name: &str) -> bool {
    text.method_inputs().iter().any(|input| input.name == name)
}

fn has_no_memory(text: &StepText) -> bool {
    text.carried().len() == 2
}

fn order(method: &Method) -> String {
    let Method { order, order_with_drag, .. } = *method;
    match (order, method.family) {
        (0, _) => "0, it does not converge".into(),
        (_, Family::Gyro) => order.to_string(),
        (_, Family::Follower) => format!("{order}, while the target moves evenly"),
        (2.., Family::Engine) => {
            format!("{order} on a joint, with drag too; 1 for a force of yours that changes")
        }
        (_, Family::Engine) if order_with_drag == 0 => {
            format!("{order}; a joint with damping does not converge")
        }
        _ if order == order_with_drag => format!("{order}, with drag too"),
        _ => format!("{order}, with drag {order_with_drag}"),
    }
}

fn evaluations(method: &Method, text: &StepText) -> String {
    match (method.evaluations, method.restart) {
        (Some(count), _) if takes(text, "substeps") => format!("{count}, whatever the substeps"),
        (Some(count), _) if method.is_of_library() => count.to_string(),
        (Some(count), None) => count.to_string(),
        (Some(count), Some(_)) => format!("{count}, and one more at the first"),
        (None, _) => "as many as it needs".into(),
    }
}

fn stability(method: &Method, text: &StepText) -> String {
    let of_substeps = if takes(text, "substeps") { " times the substeps" } else { "" };
    match (method.family, method.stability_limit) {
        (Family::Engine, None) => {
            "an undamped spring, as a joint, stays bounded at any step".into()
        }
        (Family::Engine, Some(limit)) => {
            let limit = (limit * 1000.0).round() / 1000.0;
            format!(
                "an undamped spring of angular frequency ω, as a joint, stays bounded up to h ω = {limit}{of_substeps}"
            )
        }
        (Family::Follower, None) => "stays near a still target at any step".into(),
        (Family::Follower, Some(limit)) => {
            format!("stays near a still target up to h rate = {limit}")
        }
        (Family::Adaptive, _) => "it chooses its own substeps".into(),
        (_, None) => "an undamped spring stays bounded at any step".into(),
        (_, Some(0.0)) => "an undamped spring grows at every step".into(),
        (_, Some(limit)) => {
            let limit = (limit * 1000.0).round() / 1000.0;
            format!("an undamped spring of angular frequency ω stays bounded up to h ω = {limit}")
        }
    }
}

fn symplectic(method: &Method) -> &'static str {
    match (method.symplectic, method.engine) {
        (true, Some(Engine { damping_ratio: Some(_), .. })) => "yes, on a spring as a joint",
        (is, _) => yes(is),
    }
}

fn memory(method: &Method, text: &StepText) -> String {
    if has_no_memory(text) {
        return "none".into();
    }
    if method.is_of_library() {
        return format!(
            "one for each coordinate, 0 at the start: {}. No step restarts it; make a new one after a jump of x or v",
            method.restart.unwrap_or("without memory")
        );
    }
    format!(
        "one for each coordinate. The first step and one of another length restart it {}. Make a new one after a \
         jump of x, v or the forces",
        method.restart.unwrap_or("by a step without memory")
    )
}

fn input(input: &MethodInput<'_>) -> String {
    match input.arguments.is_empty() {
        true => format!("{}: {}.", input.name, input.about),
        false => format!("{}({}): {}.", input.name, input.arguments.join(", "), input.about),
    }
}

/// Returns a sentence on the form of the function's result.
fn answer(language: Language, text: &StepText) -> String {
    match language {
        Language::Rust => "Returns the new x and v.".into(),
        Language::C if takes_function(&text.method_inputs()) => {
            "Replaces position and velocity, and hands `user` on to what it calls.".into()
        }
        Language::C => "Replaces position and velocity.".into(),
        Language::CSharp => "Replaces x and v.".into(),
        Language::GdScript | Language::JavaScript => "Returns [x, v].".into(),
        Language::Lua => "Returns the new x and v.".into(),
    }
}

fn yes(is: bool) -> &'static str {
    if is { "yes" } else { "no" }
}

/// Breaks a paragraph into lines.
pub(super) fn wrapped(paragraph: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in paragraph.split(' ') {
        let last = lines.last_mut().expect("there is a line");
        if last.is_empty() {
            last.push_str(word);
        } else if last.chars().count() + word.chars().count() < WIDTH {
            last.push(' ');
            last.push_str(word);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}
