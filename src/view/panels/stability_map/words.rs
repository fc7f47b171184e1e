//! The words beside the stability map.

use std::sync::Arc;

use egui::text::LayoutJob;
use egui::{Color32, FontId, Galley, TextFormat, Ui};

use crate::lab::analysis::{Coverage, Here, MapRequest, StabilityMap, duration};
use crate::lab::number::round;
use crate::lab::{LaneSpec, NoSmallMotion, Parameter, Studio};
use crate::view::panels::{palette, strong_font};

/// The letter of a parameter in the equation of motion, or else its name.
pub(super) fn letter(parameter: &Parameter) -> String {
    parameter.symbol.map_or_else(|| parameter.quantity(), str::to_owned)
}

/// The name of a parameter with its letter, if it has one: `stiffness k`.
pub(super) fn full_name(parameter: &Parameter) -> String {
    let (quantity, letter) = (parameter.quantity(), letter(parameter));
    if letter == quantity { quantity } else { format!("{quantity} {letter}") }
}

/// A point of the map: `20 Hz, k = 90 N/m`.
pub(super) fn point_in_words(studio: &Studio, place: usize, tick_hz: u32, value: f64) -> String {
    let parameter = super::parameter(studio, place);
    let text =
        format!("{tick_hz} Hz, {} = {} {}", letter(parameter), round(value, 3), parameter.unit);
    text.trim_end().to_owned()
}

/// What the methods do at the present point, and what the map does not draw, wrapped to a width; and the room that is left
/// for that, in points: it does not change while the cross is moved.
pub(super) fn sentence(
    ui: &Ui,
    studio: &Studio,
    map: &StabilityMap,
    width: f32,
) -> (Arc<Galley>, f32) {
    let seen = seen_note(studio, map);
    let notes = " Drag the cross to change both values at once.".to_owned() + &seen + &notes(map);
    wrapped(ui, studio, map, width, (13.0, &notes))
}

/// The same with the thin lines alone of what is drawn and what is not.
pub(super) fn short_sentence(
    ui: &Ui,
    studio: &Studio,
    map: &StabilityMap,
    width: f32,
) -> (Arc<Galley>, f32) {
    wrapped(ui, studio, map, width, (12.0, &seen_note(studio, map)))
}

/// What the methods do at the present point in type of this size, and the notes, wrapped to a width.
fn wrapped(
    ui: &Ui,
    studio: &Studio,
    map: &StabilityMap,
    width: f32,
    (size, notes): (f32, &str),
) -> (Arc<Galley>, f32) {
    let wrapped = |mut job: LayoutJob| {
        append(&mut job, notes, FontId::proportional(12.0), palette(ui).dim);
        job.wrap.max_width = width;
        ui.painter().layout_job(job)
    };
    let words = wrapped(counted_job(ui, studio, map, size));
    let room = wrapped(job(ui, &longest(studio, map), size)).size().y;
    let height = room.max(words.size().y);
    (words, height)
}

fn counted_job(ui: &Ui, studio: &Studio, map: &StabilityMap, size: f32) -> LayoutJob {
    let MapRequest { parameter, tick_hz, .. } = &map.request;
    let here = point_in_words(studio, *parameter, *tick_hz, map.request.value());
    let does = if map.here.is_empty() { "judging …".to_owned() } else { counted(map) };
    job(ui, &[here, does], size)
}

/// A point of the map, and what the methods do there.
fn job(ui: &Ui, [here, does]: &[String; 2], size: f32) -> LayoutJob {
    let mut job = LayoutJob::default();
    append(&mut job, &format!("{here}: "), strong_font(size), palette(ui).text);
    append(&mut job, does, FontId::proportional(size), palette(ui).text);
    job
}

/// The longest that the words about a point of this map become.
fn longest(studio: &Studio, map: &StabilityMap) -> [String; 2] {
    let MapRequest { parameter, rates_hz, range, specs, .. } = &map.request;
    let names = names(map);
    let here = range.map(|value| point_in_words(studio, *parameter, rates_hz[1] as u32, value));
    let name = names.into_iter().max_by_key(|name| name.chars().count()).unwrap_or_default();
    let all = specs.len();
    let does = format!("{all} of {all} methods are stable. {name} {}.", growth(0.001_23));
    [here.into_iter().max_by_key(|here| here.chars().count()).unwrap_or_default(), does]
}

/// The names of the methods of the map, in its order.
fn names(map: &StabilityMap) -> Vec<String> {
    let specs: Vec<LaneSpec> = map.request.specs.iter().map(|(_, spec)| *spec).collect();
    specs.iter().map(|spec| spec.distinct_name(spec.method.name, &specs)).collect()
}

fn append(job: &mut LayoutJob, text: &str, font_id: FontId, color: Color32) {
    job.append(text, 0.0, TextFormat { font_id, color, ..TextFormat::default() });
}

/// What each method does at the present point, line by line.
pub(super) fn each_method(map: &StabilityMap) -> String {
    let lines = names(map).into_iter().zip(&map.here).map(|(name, here)| {
        let does = match here {
            Here::Stable => "stable".into(),
            Here::Doubles(seconds) => growth(*seconds),
            Here::OwnSteps => "chooses its own steps".into(),
        };
        format!("{name}: {does}")
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn growth(seconds: f64) -> String {
    if seconds > 0.0 {
        format!("grows ×2 in {}", duration(seconds))
    } else {
        "fails at once".into()
    }
}

/// How many methods are stable, and which grows fastest.
pub(super) fn counted(map: &StabilityMap) -> String {
    let bounded = map.here.iter().filter(|here| **here != Here::OwnSteps);
    let (all, stable) = (bounded.clone().count(), bounded.filter(|h| **h == Here::Stable).count());
    if stable == all && all > 1 {
        return format!("all {all} methods are stable.");
    }
    let noun = if all == 1 { "method" } else { "methods" };
    let verb = if stable == 1 { "is" } else { "are" };
    let growing = names(map).into_iter().zip(&map.here).filter_map(|(name, here)| match here {
        Here::Doubles(seconds) => Some((name, *seconds)),
        Here::Stable | Here::OwnSteps => None,
    });
    let fastest = growing.min_by(|a, b| a.1.total_cmp(&b.1));
    let fastest = fastest.map(|(name, seconds)| format!(" {name} {}.", growth(seconds)));
    format!("{stable} of {all} {noun} {verb} stable.{}", fastest.unwrap_or_default())
}

/// Why a body has no map.
pub(super) fn no_map(why: NoSmallMotion) -> String {
    let why = match why {
        NoSmallMotion::NoRest => {
            "a map is of small motions about rest, and this body rests neither at its origin nor near its start."
        }
        NoSmallMotion::Corner => {
            "the force has a corner or a jump where this body rests, so that it does not behave as a spring there."
        }
        NoSmallMotion::Unsteady => "the stiffness or the damping of this body changes in time.",
        NoSmallMotion::TooManyCoordinates => "too many coordinates of this body act on each other.",
        NoSmallMotion::NotFinite => {
            "the force or its slope is not a finite number where this body rests."
        }
    };
    format!(
        "No stability map: {why} The lanes below say how each method does on the motion itself."
    )
}

/// What the thin lines are, if there are any.
fn seen_note(studio: &Studio, map: &StabilityMap) -> String {
    let found = map.regions.iter().zip(&map.request.specs);
    let mut selected = found.filter(|(_, (entry, _))| *entry == studio.active());
    match selected.any(|(region, _)| !region.seen.is_empty()) {
        true => format!(
            " Thin lines: the damping ratio that a player sees of {}.",
            studio.lane_name(studio.active())
        ),
        false => String::new(),
    }
}

/// What the map does not draw.
pub(super) fn notes(map: &StabilityMap) -> String {
    let named = |coverage: Coverage| {
        let found = map.regions.iter().zip(names(map));
        let of = found.filter(|(region, _)| region.coverage == coverage);
        of.map(|(_, name)| name).collect::<Vec<_>>()
    };
    let (nowhere, own) = (named(Coverage::Nowhere), named(Coverage::OwnSteps));
    let mut notes = String::new();
    if !nowhere.is_empty() {
        let verb = if nowhere.len() == 1 { "is" } else { "are" };
        notes += &format!(" {} {verb} stable nowhere on this map.", nowhere.join(", "));
    }
    if !own.is_empty() {
        let verb = if own.len() == 1 { "picks its" } else { "pick their" };
        notes += &format!(" {} {verb} own steps.", own.join(", "));
    }
    if !map.is_linear {
        notes += " The map holds for small motions about rest.";
    }
    if map.truth_grows {
        notes += " The true motion grows too; only growth beyond that counts.";
    }
    notes
}
