//! The identification of a log, in words and as JSON.

use serde_json::{Value, json};

use crate::commands::table_args::taken_object;
use crate::sim::integrators::Method;
use crate::sim::number::significant;
use crate::tools::identify::{
    Candidate, Conclusion, Effective, Fitted, Identification, Log, SpringForm,
};

/// Maximum residual of a method that is named as the nearest.
const FAR: f64 = 0.1;
/// Share of the largest x below which a fitted rest position counts as 0.
const NO_REST: f64 = 1e-5;
/// Hint for a log that no method explains.
const HINT: &str = "give --k, --c, --drag and --mass to their last digit, with the drag that an engine has by default \
(Jolt 0.05, Godot 0.1)";

/// Returns the identification as JSON. `found` is `None` if no method can run on the body.
pub(super) fn object(found: Option<&Identification>, log: &Log, mass: f64) -> Value {
    let best = found.and_then(|found| found.best);
    let rival = found.and_then(|found| found.runner_up);
    let effective = found.and_then(|found| found.effective);
    let exact = found.and_then(|found| found.exact);
    let candidates = |all: fn(&Identification) -> &[Candidate]| -> Vec<Value> {
        let all = found.map(all).unwrap_or_default();
        with_others(all).map(named).collect()
    };
    let also = found.and_then(|found| {
        let also = with_also(&found.best.as_ref()?.candidate, &found.also);
        let others: [&[Candidate]; 2] = match found.conclusion {
            Conclusion::Identified => [&[], &found.unusual],
            Conclusion::CannotTell => [&found.rivals, &found.unusual],
            Conclusion::Unknown => [&[]; 2],
        };
        Some(also.chain(others.into_iter().flat_map(with_others)).map(named).collect())
    });
    let also: Vec<Value> = also.unwrap_or_default();
    let halves = effective.and_then(|seen| seen.energy_halves_s());
    let seen = |(method, effective): &(&Method, Effective)| {
        json!({
            "method": method.id,
            "frequency_hz": effective.frequency_hz(),
            "damping_ratio": effective.damping_ratio(),
        })
    };
    let recommended = found.map(|found| &found.recommended[..]).unwrap_or_default();
    json!({
        "word": found.map_or(Conclusion::Unknown, |found| found.conclusion).id(),
        "best": best.map(|best| best.candidate.method.id),
        "substeps": best.map(|best| best.candidate.substeps),
        "held": best.map(|best| best.candidate.is_held()),
        "mode": best.and_then(|best| mode(&best.candidate)),
        "version": best.and_then(|best| Some(best.candidate.method.engine?.version))
            .filter(|version| !version.is_empty()),
        "logged": best.and_then(|best| best.candidate.method.engine?.logged),
        "residual": best.map(|best| best.residual),
        "also": also,
        "unusual": candidates(|found| &found.unusual),
        "runner_up": rival.map(|other| other.candidate.method.id),
        "runner_up_substeps": rival.map(|other| other.candidate.substeps),
        "runner_up_residual": rival.map(|other| other.residual),
        "rest_m": found.map(|found| found.rest),
        "rows_are_ticks": found.map(|found| found.rows_are_ticks.is_some()),
        "read": taken_object(log.taken()),
        "supposes_start_at_rest": found.map(|found| found.supposes_start_at_rest),
        "from_exact_m": found.and_then(|found| found.from_exact).map(|(far, _)| far),
        "motion": found.and_then(|found| found.simple).map(|motion| motion.in_words()),
        "chase_half_life_s": found.and_then(Identification::chase_half_life_s),
        "unexplained": found.and_then(|found| found.unexplained.as_deref()),
        "swing": found.and_then(|found| found.swing).map(|swing| json!({
            "frequency_hz": swing.seen.frequency_hz(),
            "undamped_hz": swing.seen.undamped_hz(),
            "undamped_hz_error": swing.errors[0],
            "damping_ratio": swing.seen.damping_ratio(),
            "damping_ratio_error": swing.errors[1],
            "residual": swing.residual,
        })),
        "effective_stiffness_n_per_m":
            effective.and_then(|seen| seen.spring_stiffness()).map(|k| k * mass),
        "effective_frequency_hz": effective.and_then(|seen| seen.frequency_hz()),
        "effective_damping_ratio": effective.and_then(|seen| seen.damping_ratio()),
        "energy_halves_s": halves.filter(|seconds| *seconds > 0.0),
        "energy_doubles_s": halves.filter(|seconds| *seconds < 0.0).map(|seconds| -seconds),
        "exact_frequency_hz": exact.and_then(|exact| exact.frequency_hz()),
        "exact_damping_ratio": exact.and_then(|exact| exact.damping_ratio()),
        "recommended": recommended.iter().map(seen).collect::<Vec<_>>(),
    })
}

/// Returns each candidate with the id of its method, then with those of the other engines that have the same map.
fn with_others(all: &[Candidate]) -> impl Iterator<Item = (&'static str, &Candidate)> {
    all.iter().flat_map(|candidate| {
        let method = candidate.method;
        let others = method.is_engine().then_some(method.also).into_iter().flatten().copied();
        [method.id].into_iter().chain(others).map(move |id| (id, candidate))
    })
}

/// Returns the names beside that of the best candidate, as [`with_others`] does.
fn with_also<'a>(
    best: &'a Candidate,
    also: &'a [Candidate],
) -> impl Iterator<Item = (&'static str, &'a Candidate)> {
    with_others(std::slice::from_ref(best)).skip(1).chain(with_others(also))
}

fn named((id, candidate): (&str, &Candidate)) -> Value {
    json!({
        "method": id,
        "substeps": candidate.substeps,
        "held": candidate.is_held(),
        "mode": mode(candidate),
    })
}

/// Returns the id of the joint's mode, if the candidate's spring is a joint.
fn mode(candidate: &Candidate) -> Option<&'static str> {
    match candidate.spring {
        SpringForm::Joint(mode) => Some(mode.id),
        _ => None,
    }
}

/// Lists the methods, each of them once, with its substeps.
fn names<'a>(candidates: impl Iterator<Item = (&'static str, &'a Candidate)>) -> String {
    let mut all: Vec<(&str, Option<&str>, Vec<u32>)> = Vec::new();
    for (id, candidate) in candidates {
        let told = candidate.spring_label();
        match all.iter_mut().find(|(known, of, _)| *known == id && *of == told) {
            Some((.., counts)) => counts.push(candidate.substeps),
            None => all.push((id, told, vec![candidate.substeps])),
        }
    }
    let named = all.iter_mut().map(|(id, told, counts)| {
        counts.sort_unstable();
        let counts: Vec<String> = counts
            .chunk_by(|a, b| a + 1 == *b)
            .map(|run| match run {
                [first, _, .., last] => format!("×{first} to ×{last}"),
                few => few.iter().map(|n| format!("×{n}")).collect::<Vec<_>>().join(" "),
            })
            .collect();
        let told = told.map_or(String::new(), |told| format!(", {told}"));
        format!("{id} {}{told}", counts.join(" "))
    });
    named.collect::<Vec<_>>().join("; ")
}

/// Formats a length with its sign.
fn signed(number: f64) -> String {
    format!("{}{}", if number < 0.0 { "" } else { "+" }, significant(number, 4))
}

/// Describes a motion by its frequency and damping.
fn motion_text(effective: &Effective) -> String {
    let ratio = effective.damping_ratio().map(|ratio| {
        let ratio = if ratio.abs() < 5e-7 { 0.0 } else { ratio };
        format!("damping ratio {}", significant(ratio, 3))
    });
    let swing = match effective.frequency_hz() {
        Some(hz) if (hz / effective.undamped_hz() - 1.0).abs() > 0.01 => {
            let undamped = significant(effective.undamped_hz(), 4);
            Some(format!("{} Hz ({undamped} Hz undamped)", significant(hz, 4)))
        }
        Some(hz) => Some(format!("{} Hz", significant(hz, 4))),
        None => ratio.is_some().then(|| "no swing".to_owned()),
    };
    let (thing, halves) = match ratio {
        Some(_) => ("the energy", effective.energy_halves_s()),
        None => ("the gap to its terminal speed", effective.speed_halves_s()),
    };
    let lasting = halves.filter(|seconds| seconds.abs() < 1e5);
    let lasting = lasting.map(|seconds| {
        let word = if seconds > 0.0 { "halves" } else { "doubles" };
        format!("{thing} {word} in {} s", significant(seconds.abs(), 3))
    });
    let lasting = lasting.or_else(|| Some(format!("{thing} stays")));
    [swing, ratio, lasting].into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// Maximum number of methods in the first line.
const MAX_MAKERS: usize = 3;

/// Returns the best candidate of an identified log, then the others that have the same map on this body. Each method
/// appears once for each form of its spring. If the best candidate holds its force, joints come first.
fn makers<'a>(best: &'a Candidate, also: &'a [Candidate]) -> Vec<&'a Candidate> {
    let mut all: Vec<&Candidate> = Vec::new();
    for candidate in [best].into_iter().chain(also) {
        let is_alike = |known: &&Candidate| {
            known.method == candidate.method && known.spring == candidate.spring
        };
        if !all.iter().any(is_alike) {
            all.push(candidate);
        }
    }
    if best.is_held() {
        all.sort_by_key(|candidate| candidate.is_held());
    }
    all
}

/// Lists the candidates in one phrase, which says that they are equal.
fn listed(all: &[&Candidate]) -> String {
    let equal = if all.len() > 1 { " (the same on this body)" } else { "" };
    phrase(all) + equal
}

/// Lists the first candidates, and the number of the others.
fn phrase(all: &[&Candidate]) -> String {
    let named: Vec<String> = all.iter().take(MAX_MAKERS).map(ToString::to_string).collect();
    let more = match all.len() - named.len() {
        0 => String::new(),
        more => format!(" or {more} more"),
    };
    named.join(" or ") + &more
}

/// Says how a log moves: as a method, and as engines do. A name is a claim over the methods of the table, so that user
/// code with the same step always stands beside an engine.
fn moves_as(best: &Candidate, also: &[Candidate]) -> String {
    let (engines, own): (Vec<&Candidate>, _) =
        makers(best, also).into_iter().partition(|candidate| candidate.method.is_engine());
    if engines.is_empty() {
        return format!("moves as {}", listed(&own));
    }
    let own = if own.is_empty() { String::new() } else { format!("{}: as ", phrase(&own)) };
    let verb = if engines.len() == 1 { "does" } else { "do" };
    format!("moves as {own}{} {verb}, or code with the same step", phrase(&engines))
}

/// Returns the first line, which is the method and its residual.
fn verdict(found: &Identification, log: &Log) -> String {
    let residual = |fitted: &Fitted| format!("residual {:.1e}", fitted.residual);
    if let Some(motion) = found.simple {
        return motion.in_words();
    }
    let Some(best) = &found.best else {
        return match log.is_uneven() {
            true => "unknown: the rows are at uneven times, and a method makes even ticks".into(),
            false => "unknown: no method comes near".into(),
        };
    };
    match (found.conclusion, &found.runner_up) {
        (Conclusion::Identified, _) => {
            let supposed = match found.supposes_start_at_rest {
                true => ", if it starts at rest (--v0 0)",
                false => "",
            };
            let moves = moves_as(&best.candidate, &found.also);
            format!("{moves}, {}{supposed}", residual(best))
        }
        (Conclusion::CannotTell, Some(rival)) => format!(
            "cannot tell {} from {}{}: {} and {:.1e}; {}",
            best.candidate,
            rival.candidate,
            match best.candidate.method.is_engine() || rival.candidate.method.is_engine() {
                true => ", or code with the same step",
                false => "",
            },
            residual(best),
            rival.residual,
            match (log.has_velocities(), found.is_spring_fitted) {
                (_, true) => "give the spring with --k",
                (false, false) => "log v too, give it at the start with --v0, or log for longer",
                (true, false) => "log for longer",
            }
        ),
        _ if best.residual > FAR => "unknown: no method comes near".to_owned(),
        _ => format!("unknown: the nearest is {}, {}", best.candidate, residual(best)),
    }
}

/// Says which step a log of a free spin in space is of.
pub(super) fn spin_text(found: Option<&Identification>) -> String {
    let residual =
        |fitted: &Fitted| format!("{}, residual {:.1e}", fitted.candidate, fitted.residual);
    let Some((found, best)) = found.and_then(|found| Some((found, found.best?))) else {
        return "unknown: no two rows in a row are a tick apart, or nothing spins\n".into();
    };
    let lines = match (found.conclusion, &found.runner_up) {
        (Conclusion::Identified, Some(rival)) => vec![
            format!("{}, residual {:.1e}", moves_as(&best.candidate, &found.also), best.residual),
            format!("the same on this body: {}", names(with_also(&best.candidate, &found.also))),
            format!("runner-up: {}", residual(rival)),
        ],
        (Conclusion::Unknown, _) => vec![
            format!("unknown: the nearest is {}", residual(&best)),
            "wx, wy, wz must be about the principal axes, in the order of --moments, and at even ticks".into(),
        ],
        (_, rival) => {
            let rival = rival.as_ref().map_or("any other".into(), residual);
            vec![
                format!("cannot tell {}, from {rival}", residual(&best)),
                "log a spin that is farther from an axis, or in double precision".into(),
            ]
        }
    };
    lines.join("\n") + "\n"
}

pub(super) fn report_text(found: &Identification, log: &Log, mass: f64) -> String {
    let Identification { conclusion, runner_up, effective, exact, recommended, .. } = found;
    let residual = |fitted: &Fitted| format!("residual {:.1e}", fitted.residual);
    let rival = runner_up.as_ref();
    let best = found.best.as_ref().map(|best| &best.candidate);
    let makers = best.map(|best| makers(best, &found.also)).unwrap_or_default();
    let mut lines = vec![verdict(found, log)];
    if let Some(late) = &found.rows_are_ticks {
        let late = if late.is_empty() { String::new() } else { format!(" ({late})") };
        lines.push(format!("the rows step alike whatever their times{late}, so they are ticks"));
    }
    if let Some(half_life_s) = found.chase_half_life_s() {
        let part = -libm::expm1(-std::f64::consts::LN_2 / half_life_s / log.tick_hz());
        let (part, fps) = (significant(part, 4), significant(log.tick_hz(), 4));
        lines.push(format!("as a lerp by {part} at {fps} frames per second"));
    }
    match &found.unexplained {
        Some(why) => lines.push(format!("no motion that is known: {why}")),
        None if *conclusion == Conclusion::Unknown
            && !log.is_uneven()
            && found.simple.is_none() =>
        {
            lines.push(HINT.to_owned());
        }
        None => {}
    }
    if let Some(swing) = &found.swing {
        let [hz, ratio] = swing.errors.map(|error| significant(error, 1));
        lines.push(format!(
            "the best fit of a damped swing: {} Hz ± {hz} undamped, damping ratio {} ± {ratio}, off by {} % of its amplitude",
            significant(swing.seen.undamped_hz(), 4),
            significant(swing.seen.damping_ratio().unwrap_or(0.0), 3),
            significant(100.0 * swing.residual, 2),
        ));
    }
    let size = log.rows().iter().map(|row| row.x.abs()).fold(0.0, f64::max);
    if found.is_rest_fitted && found.rest.abs() > NO_REST * size {
        lines.push(format!("it rests at {} m", significant(found.rest, 5)));
    }
    let told = best.filter(|_| *conclusion != Conclusion::Unknown);
    let also = told.map_or(String::new(), |best| names(with_also(best, &found.also)));
    if !also.is_empty() {
        lines.push(format!("the same on this body: {also}"));
    }
    if *conclusion == Conclusion::CannotTell && found.rivals.len() > 1 {
        lines.push(format!("as near in another way: {}", names(with_others(&found.rivals))));
    }
    if told.is_some() && !found.unusual.is_empty() {
        lines.push(format!(
            "would fit too, but few set them: {}",
            names(with_others(&found.unusual))
        ));
    }
    if let (Conclusion::Identified, Some(rival)) = (conclusion, rival) {
        lines.push(format!("runner-up: {}, {}", rival.candidate, residual(rival)));
    }
    if let Some((far, t_s)) = found.from_exact.filter(|(far, _)| far.abs() > 0.0) {
        lines.push(format!(
            "after {} s it is {} m from the exact motion",
            significant(t_s, 4),
            signed(far)
        ));
    }
    if let Some(effective) = effective {
        lines.push(format!("a player sees: {}", motion_text(effective)));
        if let Some(stiffness) = effective.spring_stiffness() {
            lines.push(format!("as stiff as {} N/m", significant(stiffness * mass, 4)));
        }
    }
    // Where no method fits a spring, it would be that of the swing above.
    let is_swing = *conclusion == Conclusion::Unknown && found.is_spring_fitted;
    if let Some(exact) = exact.as_ref().filter(|_| !is_swing) {
        let fitted =
            if found.is_spring_fitted { "by the spring that fits" } else { "the equation says" };
        lines.push(format!("{fitted}: {}", motion_text(exact)));
    }
    for (method, effective) in recommended {
        lines.push(format!("under {}: {}", method.id, motion_text(effective)));
    }
    let named: Vec<&Candidate> = match (conclusion, rival) {
        (Conclusion::Identified, _) => makers.into_iter().take(MAX_MAKERS).collect(),
        (Conclusion::CannotTell, Some(rival)) => {
            best.into_iter().chain([&rival.candidate]).collect()
        }
        // One that comes nowhere near is not named above.
        _ => best
            .filter(|_| found.best.as_ref().is_some_and(|it| it.residual <= FAR))
            .into_iter()
            .collect(),
    };
    let mut methods: Vec<&Method> = named.iter().map(|candidate| candidate.method).collect();
    methods.dedup();
    lines.extend(methods.into_iter().filter_map(|method| {
        let about = match method.own_text() {
            Some(_) => own_lines(method),
            None => method.engine?.checked_against()?,
        };
        Some(format!("{}: {about}", method.id))
    }));
    lines.push(String::new());
    lines.join("\n")
}

/// Returns the lines of a form, without the numbers that it takes.
fn own_lines(method: &Method) -> String {
    let lines = method.formula.iter().filter(|line| !line.starts_with("takes "));
    lines.copied().collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::integrators::METHODS;

    #[test]
    fn the_first_line_puts_joints_before_held_forces_and_names_equal_maps() {
        let candidate = |id: &str, substeps, is_held| {
            let method = METHODS.iter().find(|method| method.id == id).expect("a method");
            let spring = if is_held { SpringForm::HeldForce } else { SpringForm::Acceleration };
            Candidate { method, substeps, spring }
        };
        let held = candidate("engine-jolt", 1, true);
        let joint = candidate("engine-bullet", 1, false);
        let own = candidate("semi-implicit-euler", 1, false);
        let more = candidate("engine-mujoco", 1, false);
        let both = "engine-bullet ×1 or engine-jolt ×1, force held (the same on this body)";
        for (best, also, named) in [
            (joint, vec![], "engine-bullet ×1"),
            (joint, vec![candidate("engine-bullet", 2, false)], "engine-bullet ×1"),
            (held, vec![joint], both),
            (joint, vec![held], both),
            (
                held,
                vec![joint, own, more],
                "engine-bullet ×1 or semi-implicit-euler ×1 or engine-mujoco ×1 or 1 more (the same on this body)",
            ),
        ] {
            assert_eq!(listed(&makers(&best, &also)), named);
        }
    }
}
