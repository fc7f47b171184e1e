//! `regatta rule`: analyses the lines with which a game moves a value once a frame, at every frame rate.

use std::io::{self, Read};
use std::path::Path;

use clap::Args;
use serde_json::{Map, Value, json};

use super::argument::brief;
use super::error::Error;
use super::help::flowing;
use super::id::CODE_FORM;
use super::output::print;
use super::output::table::{Column, TableFormat, text};
use super::tick_rate::rate_of_a_log;
use crate::regular_file;
use crate::scene::SceneErrors;
use crate::sim::law::MAX_STEP_BYTES;
use crate::sim::number::{round, significant};
use crate::tools::Rule;
use crate::tools::port::{PortOutcome, UI_SPRINGS, Wish, followers};
use crate::tools::rule::{
    BouncesSeen, Course, Piece, ROUNDED_START, ROUNDED_TARGET, RuleBounce, UNITS, VisibleMotion,
    rule_scene,
};
use crate::tools::source_code::{CodeForm, Language};

const ABOUT: &str = "\
RULE is the lines that a game runs once a frame, a file of them, or - for standard input. They assign
the position x and its velocity v; they may read target, the goal of x, and dt (or h), the length of a
frame. `regatta help step` has the grammar.

The answer has the frequency, the damping ratio, the overshoot and the time to the last hundredth of
the way, at the author's frame rate and at others. It has the rates below which the rule rings and
grows, the same spring in the words of user interfaces, and code that moves alike at any frame rate.

A rule that falls onto a floor is a ball: the answer has the heights of its bounces over the true
ones, and two numbers. s is that of the step: -1 for semi-implicit Euler, 0 for an exact fall, 1 for
explicit Euler. kappa is that of the line at the floor: 0 where it keeps the energy, 0.5 where it sets
the place, 1 where it mirrors it. Without loss an impact adds (s + kappa) g h to the speed.

In JSON, hz is the visible frequency, null if nothing swings, and spring.hz the one without damping;
code has all languages.

Examples:
  regatta rule 'v = (v + (target - x) * 0.2) * 0.85; x += v'
  regatta rule 'x += (target - x) * 20 * dt' --fps 30 --as csharp
  regatta rule 'v *= 0.9; x += v * dt' --format json
  regatta rule 'v -= 9.81*dt; x += v*dt; if x < 0 { x = 0; v = -0.8*v }'
  regatta rule camera.step
  regatta rule camera.step --fps 50 --scene > camera.toml";

/// Show how your own lines move at every frame rate
///
/// And print code that does not depend on it.
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct RuleArgs {
    /// The lines, a file of them, or - for standard input
    #[arg(value_name = "RULE|FILE|-", allow_hyphen_values = true)]
    rule: String,

    /// The frames per second for which they were written
    #[arg(long, value_name = "N", default_value = "60", value_parser = rate_of_a_log)]
    #[arg(allow_negative_numbers = true)]
    fps: f64,

    /// The unit of dt in the lines: s, ms or us
    ///
    /// Seconds, if left out. The `delta` of Phaser is in milliseconds, the `delta_time` of GameMaker in microseconds.
    #[arg(long, value_name = "UNIT", conflicts_with = "scene", hide_possible_values = true)]
    #[arg(value_parser = UNITS.map(|(unit, _)| unit))]
    dt: Option<String>,

    /// The fraction of the way, or of the speed, within which it has settled: 0.01 if left out
    #[arg(long, value_name = "PART", conflicts_with = "scene", value_parser = part)]
    within: Option<f64>,

    /// The language of the code: rust, c, cpp, csharp, gdscript, javascript, lua or step
    ///
    /// `step` is the language of these lines and of a method of your own, to change and give back.
    #[arg(long = "as", value_name = "LANGUAGE", default_value = Language::Rust.id())]
    #[arg(value_parser = CODE_FORM, hide_possible_values = true)]
    form: CodeForm,

    /// Print a scene instead, which races the lines at half, once and twice that rate
    ///
    /// Its exact motion is theirs at --fps. `regatta RULE.step` opens that scene in the window, for 60 frames per
    /// second.
    #[arg(long, conflicts_with_all = ["format", "form"])]
    scene: bool,

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

fn part(written: &str) -> Result<f64, String> {
    let part = written.parse().ok().filter(|part: &f64| *part > 0.0 && *part < 1.0);
    part.ok_or_else(|| "a part is between 0 and 1; write one, such as `0.02`".into())
}

/// Returns the name that the rule has in messages, and the text of the rule.
pub(super) fn read(written: &str) -> Result<(String, String), Error> {
    let path = Path::new(written);
    let (name, bytes) = if written == "-" {
        let mut bytes = Vec::new();
        let most = MAX_STEP_BYTES as u64 + 1;
        io::stdin().take(most).read_to_end(&mut bytes).map_err(|error| {
            Error::mistake(format!("cannot read standard input: {error}; give a file"))
        })?;
        ("standard input".to_owned(), bytes)
    } else if written.contains(['=', '(']) && !path.exists() {
        return Ok(("rule".into(), written.to_owned()));
    } else {
        let name = brief(path);
        let bytes = regular_file::read(path, MAX_STEP_BYTES).map_err(|error| match error {
            error if error.is_missing() => Error::mistake(format!(
                "\"{name}\" is no rule and no file; write an assignment, such as 'x += v * dt'"
            )),
            error => Error::mistake(format!("cannot read {name}: {error}")),
        })?;
        (name, bytes)
    };
    let text = String::from_utf8(bytes)
        .map_err(|_| Error::mistake(format!("{name} is not text; save it as UTF-8")))?;
    Ok((name, text))
}

pub(super) fn run(args: &RuleArgs) -> Result<(), Error> {
    let (name, written) = read(&args.rule)?;
    if args.scene {
        let fps = args.fps.to_string().parse().map_err(|wanted| {
            Error::mistake(format!("--fps {} is no tick rate: {wanted}", args.fps))
        })?;
        return print(rule_scene(&name, &written, fps)?.to_toml());
    }
    let rule = Rule::read(&written, args.fps)
        .map_err(|fault| Error::from(SceneErrors::of_step(&name, &written, fault)))?;
    let units = UNITS.iter().find(|(unit, _)| args.dt.as_deref() == Some(unit));
    let rule = rule.in_units(units.map_or(1.0, |(_, units)| *units));
    let rule = match args.within {
        Some(within) => rule.within(within),
        None => rule,
    };
    args.format.print(&match args.format {
        TableFormat::Json => format!("{:#}\n", object(&rule, &written)),
        TableFormat::Text => report_text(&rule, &written, args.form),
    })
}

fn object(rule: &Rule, written: &str) -> Value {
    let seen = |seen: VisibleMotion| {
        json!({
            "fps": seen.fps,
            "hz": seen.hz,
            "damping_ratio": seen.spring.and_then(|spring| spring.damping_ratio()),
            "settles_s": seen.settles_s,
            "grows": seen.grows,
            "top_speed": seen.top_speed,
            "accelerates": seen.accelerates,
            "jump_height": seen.jump.map(|[height, _]| height),
            "jump_s": seen.jump.map(|[_, seconds]| seconds),
        })
    };
    let pieces = rule.pieces();
    let piece = |piece: &Piece| {
        json!({
            "condition": piece.condition,
            "course": outcome(piece, rule),
            "seen": piece.motions().into_iter().map(seen).collect::<Vec<_>>(),
        })
    };
    let spring =
        |spring: Wish| json!({ "hz": spring.frequency_hz, "damping_ratio": spring.damping_ratio });
    let code = (CODE_FORM.all)().into_iter().map(|(id, form)| {
        let code = rule.code(written, form).ok();
        (id, Value::from(code.map(|code| code.text)))
    });
    json!({
        "rule": written,
        "fps": rule.fps(),
        "linear": rule.is_linear(),
        "seen": rule.motions().into_iter().map(seen).collect::<Vec<_>>(),
        "pieces": pieces.iter().map(piece).collect::<Vec<_>>(),
        "bounce": rule.bounce().map(|bounce| json!({
            "gravity": bounce.gravity,
            "restitution": bounce.restitution,
            "floor": bounce.floor,
            "s": bounce.s,
            "kappa": bounce.kappa,
            "seen": bounce.seen.iter().map(|seen| {
                let [after_1, after_5, after_10] = seen.heights;
                json!({
                    "fps": seen.fps, "after_1": after_1, "after_5": after_5, "after_10": after_10,
                })
            }).collect::<Vec<_>>(),
        })),
        "within": rule.settles_within(),
        "jump_speed": rule.jump_speed(),
        "jitter": rule.jitter(rule.fps()),
        "hint": hint(rule, written),
        "rings_below_fps": rule.rings_below_fps(),
        "explodes_below_fps": rule.explodes_below_fps(),
        "spring": rule.spring().map(spring),
        "code": code.collect::<Map<_, _>>(),
    })
}

/// Returns a number with this many digits, or null if there is no number.
fn digits(value: Option<f64>, digits: usize) -> Value {
    value.map(|value| significant(value, digits)).into()
}

/// Returns the undamped frequency, if it differs by more than a hundredth from the visible one.
fn undamped(seen: &VisibleMotion) -> Option<f64> {
    let undamped = seen.spring?.undamped_hz();
    seen.hz.is_none_or(|hz| (hz / undamped - 1.0).abs() > 0.01).then_some(undamped)
}

const COLUMNS: &[Column<VisibleMotion>] = &[
    Column::shown("fps", "FPS", |seen| seen.fps.to_string().into()),
    Column::shown("hz", "SWINGS Hz", |seen| digits(seen.hz, 4)),
    Column::shown("undamped", "UNDAMPED Hz", |seen| digits(undamped(seen), 4)),
    Column::shown("ratio", "DAMPING RATIO", |seen| {
        digits(seen.spring.and_then(|spring| spring.damping_ratio()), 4)
    }),
    Column::shown("overshoot", "OVERSHOOT %", |seen| digits(seen.overshoot.map(|x| 100.0 * x), 3)),
    Column::shown("halves", "HALVES s", |seen| digits(seen.halves_s, 4)),
    Column::shown("settles", "1 % AFTER s", |seen| digits(seen.settles_s, 4)),
    Column::shown("grows", "GROWS", |seen| seen.grows.into()),
];
/// Columns of a driven rule, the last of which a jump alone has.
const DRIVEN: &[Column<VisibleMotion>] = &[
    Column::shown("fps", "FPS", |seen| seen.fps.to_string().into()),
    Column::shown("top", "TOP SPEED", |seen| digits(seen.top_speed, 4)),
    Column::shown("accelerates", "ACCELERATES /s", |seen| digits(seen.accelerates, 4)),
    Column::shown("height", "JUMPS", |seen| digits(seen.jump.map(|[height, _]| height), 4)),
    Column::shown("lasts", "LASTS s", |seen| digits(seen.jump.map(|[_, seconds]| seconds), 4)),
];
/// Number of columns without a jump.
const WITHOUT_JUMP: usize = 3;

/// Part by which a drive may differ between frame rates before a line says so.
const SAME_DRIVE: f64 = 0.01;

/// Says that the top speed or the acceleration of a driven rule depends on the frame rate, if it does.
fn uneven_drive(motions: &[VisibleMotion]) -> Option<String> {
    let [first, .., last] = motions else { return None };
    let of = |drive: fn(&VisibleMotion) -> Option<f64>| drive(first).zip(drive(last));
    let (name, (slow, fast)) = (of(|seen| seen.top_speed).map(|both| ("top speed", both)))
        .or_else(|| of(|seen| seen.accelerates).map(|both| ("acceleration", both)))?;
    let is_uneven = (slow - fast).abs() > SAME_DRIVE * slow.abs().max(fast.abs());
    let [slow, fast] = [slow, fast].map(|drive| significant(drive, 4));
    is_uneven.then(|| {
        format!(
            "the {name} depends on the frame rate: {slow} at {}, {fast} at {}\n",
            first.fps, last.fps
        )
    })
}

/// Whether the motion by itself has a number to show.
fn is_visible(seen: &VisibleMotion) -> bool {
    seen.grows
        || [seen.hz, seen.overshoot, seen.halves_s, seen.settles_s].iter().any(Option::is_some)
}

/// Whether the drive has a number to show.
fn is_driven(seen: &VisibleMotion) -> bool {
    seen.top_speed.or(seen.accelerates).is_some()
}

/// Returns the tables of a rule. That of a motion without numbers is left out beside a drive.
fn tables(rule: &Rule) -> String {
    let motions = rule.motions();
    let mut said = match motions.iter().any(is_visible) || !motions.iter().any(is_driven) {
        true => text(COLUMNS, &motions, "  "),
        false => String::new(),
    };
    if rule.settles_within() != 0.01 {
        let percent = (1e8 * rule.settles_within()).round() / 1e6;
        said = said.replacen("1 % AFTER s", &format!("{percent} % AFTER s"), 1);
    }
    let drive = drive(rule, &motions);
    let space = if said.is_empty() || drive.is_empty() { "" } else { "\n" };
    said + space + &drive
}

/// Returns the table of a driven rule; empty for another.
fn drive(rule: &Rule, motions: &[VisibleMotion]) -> String {
    let mut said = String::new();
    if motions.iter().any(is_driven) {
        let jumps = motions.iter().any(|seen| seen.jump.is_some());
        let columns = if jumps { DRIVEN } else { &DRIVEN[..WITHOUT_JUMP] };
        said += &text(columns, motions, "  ");
        said += match rule.has_speeds_of_v() {
            true => "speeds are in the units of v\n",
            false if rule.units() != 1.0 => "speeds are per second\n",
            false => "",
        };
        said += &uneven_drive(motions).unwrap_or_default();
    }
    if let Some(speed) = rule.jump_speed() {
        said += &format!("a jump starts with v = {}\n", significant(speed, 4));
    }
    said
}

/// Columns of a rule that turns a ball at a floor.
const BOUNCES: &[Column<BouncesSeen>] = &[
    Column::shown("fps", "FPS", |seen| seen.fps.to_string().into()),
    Column::shown("after_1", "AFTER 1", |seen| digits(seen.heights[0], 3)),
    Column::shown("after_5", "AFTER 5", |seen| digits(seen.heights[1], 3)),
    Column::shown("after_10", "AFTER 10", |seen| digits(seen.heights[2], 3)),
];

/// Returns what a rule does to the bounces of a ball.
fn bounces(bounce: &RuleBounce, fps: f64) -> String {
    let number = |value: f64| round((1e3 * value).round() / 1e3, 3);
    let gain = number(bounce.s + bounce.kappa);
    let here = bounce.seen.iter().find(|seen| seen.fps == fps);
    let course = match here.and_then(|seen| seen.heights.into_iter().flatten().next_back()) {
        Some(_) if bounce.restitution > 1.0 + 1e-6 => {
            "it grows, for it leaves faster than it lands"
        }
        None => "no impact is seen",
        Some(height) if height < 0.0 => "it sinks through the floor",
        Some(height) if height > 1.02 => "it bounces too high",
        Some(height) if height < 0.98 => "it bounces too low",
        Some(_) => "its mean height is right within 2 %",
    };
    format!(
        "a ball that falls by {} a second per second and keeps {} of its speed at the floor{}:\n\
         s = {} by the step, kappa = {} by the line at the floor\n\
         without loss an impact adds (s + kappa) g h = {gain} g h to the speed\n\
         at {fps} frames per second {course}\n\
         \nheight after impacts over the true one, mean of 64 falls of 0.45 s, as from 1 m on Earth:\n{}",
        number(bounce.gravity),
        number(bounce.restitution),
        if bounce.floor == 0.0 { String::new() } else { format!(" at {}", bounce.floor) },
        number(bounce.s),
        number(bounce.kappa),
        text(BOUNCES, &bounce.seen, "  "),
    )
}

/// Describes the motion of a piece at the author's rate.
fn outcome(piece: &Piece, whole: &Rule) -> String {
    let seen = piece.rule.motion_at(piece.rule.fps());
    let number = |value| significant(value, 4);
    match (piece.course(), seen) {
        (Some(Course::Stops), _) => {
            let reached = piece.reached_s(whole).map(number);
            let from = if piece.coasts() { "a speed of 1" } else { "1" };
            let reached = reached.map(|s| format!("; from {from} it is there after {s} s"));
            format!("it stops at once{}", reached.unwrap_or_default())
        }
        (Some(Course::Stays), _) => "it stays where it is".into(),
        (Some(Course::Once), _) => format!("once, {}", frame(piece)),
        (Some(Course::Sets), _) => frame(piece),
        (Some(Course::Brakes(gain)), _) => format!("it brakes by {} a second", number(gain)),
        (Some(Course::Rounded), _) => rounded(piece),
        (Some(Course::ByTarget), _) => "it moves at a speed that the target decides".into(),
        (Some(Course::Moves(speed)), _) => {
            let other = piece.rule.motion_at(2.0 * piece.rule.fps());
            let is_alike =
                other.top_speed.is_some_and(|top| (top.abs() / speed - 1.0).abs() < 1e-9);
            let rate = if is_alike { ", at every frame rate" } else { "" };
            format!("it moves at a constant {} a second{rate}", number(speed))
        }
        (None, VisibleMotion { hz, spring: Some(spring), settles_s, .. })
            if hz.or(settles_s).is_some() =>
        {
            let ratio = spring.damping_ratio().map(number);
            let ratio = ratio.map_or(String::new(), |ratio| format!(", damping ratio {ratio}"));
            let rest = match hz {
                None if piece.rests_at_target() => "it comes to rest at the target: ",
                None => "it comes to rest: ",
                Some(_) => "",
            };
            format!("{rest}a spring of {} Hz{ratio}", number(spring.undamped_hz()))
        }
        (None, VisibleMotion { accelerates: Some(gain), top_speed: None, halves_s, .. }) => {
            let gain = number(gain.abs());
            match halves_s {
                None => format!("the speed changes by {gain} a second"),
                Some(s) => format!(
                    "from rest the speed changes by {gain} a second; what its last speed lacks halves in {} s",
                    number(s)
                ),
            }
        }
        (None, VisibleMotion { halves_s: Some(s), .. }) => format!("halves in {} s", number(s)),
        (None, seen) if seen.grows => "it grows".into(),
        (None, _) => "it moves on".into(),
    }
}

/// Describes the numbers that a frame of a piece sets.
fn frame(piece: &Piece) -> String {
    let (mut said, all) = (String::from("it "), piece.sets());
    for (index, (name, value)) in all.iter().enumerate() {
        let and = if index == 0 { "" } else { " and " };
        let verb = match value {
            Some(_) if index > 0 && all[index - 1].1.is_some() => "",
            Some(_) => "sets ",
            None => "changes ",
        };
        let to = value.as_ref().map_or(String::new(), |value| format!(" to {value}"));
        said += &format!("{and}{verb}{name}{to}");
    }
    said
}

/// Describes where runs with rounded steps end.
fn rounded(piece: &Piece) -> String {
    let target = match piece.rule.ends_by_target() {
        true => format!("a target of {ROUNDED_TARGET}"),
        false => "the target".to_owned(),
    };
    let run = |(side, from): (f64, &str)| {
        let [above, s] = piece.rule.run_ends(side)?;
        let [distance, s] = [above.abs(), s].map(|number| round(number, 4));
        let place = match above {
            0.0 => "at the target".into(),
            above if above > 0.0 => format!("{distance} above"),
            _ => format!("{distance} below"),
        };
        Some(format!("from {ROUNDED_START} {from} it stops {place} after {s} s"))
    };
    let runs: Vec<String> =
        [(1.0, &*format!("above {target}")), (-1.0, "below")].into_iter().filter_map(run).collect();
    let measured = if runs.is_empty() { String::new() } else { format!("; {}", runs.join(", ")) };
    format!("its steps are rounded, and have no rate{measured}")
}

/// Asks whether the length of a frame has another unit, if the rule is too slow in seconds.
fn hint(rule: &Rule, written: &str) -> Option<String> {
    let (unit, halves_s) = rule.other_unit()?;
    let has = |name: &&&str| written.contains(**name);
    let name =
        ["delta_time", "deltaTime", "delta", "elapsed", "dt"].iter().find(has).unwrap_or(&"h");
    let unit_name = if unit == "ms" { "milliseconds" } else { "microseconds" };
    let halves = significant(halves_s, 4);
    Some(format!(
        "nothing halves within 30 s: is {name} in {unit_name}? With --dt {unit} it halves in {halves} s"
    ))
}

fn report_text(rule: &Rule, written: &str, form: CodeForm) -> String {
    let fps = rule.fps();
    let kind = match rule.is_linear() {
        true => "linear",
        false => "not linear: below are small motions about a rest at 0, where it has one",
    };
    let mut said = format!("{kind}; of {}\n\n", rule.state().collect::<Vec<_>>().join(" and "));
    let pieces = rule.pieces();
    if let Some(bounce) = rule.bounce() {
        said = bounces(&bounce, fps);
    } else if pieces.is_empty() {
        said += &tables(rule);
    } else {
        let state = rule.state().collect::<Vec<_>>().join(" and ");
        said = format!("not linear, but in pieces; of {state}\n");
        let driven = drive(rule, &rule.motions());
        if !driven.is_empty() {
            said += &format!("\nfrom rest, through all pieces:\n{driven}");
        }
        for piece in &pieces {
            said += &format!("\n{}: {}\n", piece.condition, outcome(piece, rule));
            let motions = piece.motions();
            match piece.course() {
                Some(Course::Stops | Course::Stays) => {}
                Some(Course::Once | Course::Sets | Course::Rounded) => {}
                Some(Course::Moves(_) | Course::ByTarget | Course::Brakes(_)) => {
                    said += &drive(&piece.rule, &motions)
                }
                None if motions.iter().any(|seen| is_visible(seen) || is_driven(seen)) => {
                    said += &tables(&piece.rule);
                }
                None => {}
            }
        }
    }
    let beside = rule.beside();
    if !beside.is_empty() {
        let names = beside.join(", ");
        said += &format!("\nleft out, as nothing above depends on it: {names}\n");
    }
    if let Some([kept, other]) = rule.left_out() {
        said += &format!("\nof the component {kept} alone; the lines of {other} are left out\n");
    }
    said += "\n";
    said += &hint(rule, written).map(|hint| hint + "\n").unwrap_or_default();
    if !rule.takes_step() {
        said +=
            "without dt: every frame moves it alike, so it is twice as fast at twice the rate\n";
    }
    if let Some(width) = rule.jitter(fps) {
        let width = significant(width, 4);
        said += &format!("at {fps} frames per second it ends in a jitter {width} wide\n");
    }
    let explodes_below = rule.explodes_below_fps();
    for (verb, below) in [("rings", rule.rings_below_fps()), ("grows", explodes_below)] {
        let line = |below| format!("{verb} below {} frames per second\n", significant(below, 4));
        said += &below.map(line).unwrap_or_default();
    }
    let grows = rule.takes_step() && explodes_below.is_none() && rule.grows();
    said += if grows { "grows at every frame rate\n" } else { "" };
    if let Some(coasts) = rule.coasts_s().filter(|_| pieces.is_empty()) {
        let seconds: Vec<String> = coasts.iter().map(|seconds| significant(*seconds, 4)).collect();
        said += &match &seconds[..] {
            [after, before] => format!(
                "coasts {after} s times its speed where it moves after the friction, {before} s where before\n"
            ),
            seconds => format!("coasts {} s times its speed\n", seconds.concat()),
        };
    }
    if let Some(wish) = rule.spring() {
        let [hz, ratio] = [wish.frequency_hz, wish.damping_ratio].map(|x| significant(x, 4));
        said += &format!(
            "\nat {fps} frames per second it is a spring of {hz} Hz, damping ratio {ratio}:\n"
        );
        let ports = UI_SPRINGS.iter().map(|dialect| (dialect.id, dialect.port(&wish, fps)));
        let told = ports.filter(|(_, port)| {
            port.outcome != PortOutcome::Unreachable && wish.damping_ratio >= 0.0
        });
        for (id, port) in told.filter(|(_, port)| port.error.is_none()) {
            said += &format!("  {id:24}  {}\n", port.code);
        }
    }
    if let Some(approach) = rule.approach() {
        let [half, rate] = [approach.half_life_s, approach.rate()].map(|x| significant(x, 4));
        let of_v = if rule.approaches_by_v() { "; x below is your v" } else { "" };
        said += &format!(
            "\nat {fps} frames per second it halves in {half} s: 1 - exp(-{rate} dt){of_v}\n"
        );
        for port in followers(approach, Some(fps)).iter().filter(|port| port.fps == fps) {
            said += &format!("  {:26}  {}\n", port.method.id, port.code);
        }
    }
    said += &match rule.code(written, form) {
        Ok(code) => format!("\n{}", code.text),
        Err(reason) => format!("\nno code for other frame rates: {reason}\n"),
    };
    said
}
