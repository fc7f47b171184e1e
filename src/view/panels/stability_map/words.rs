//! Texts beside the stability map, laid out.

use std::sync::Arc;

use egui::text::LayoutJob;
use egui::{Color32, FontId, Galley, TextFormat, Ui};

use crate::measure::{MapRequest, PointStability, StabilityMap};
use crate::scene::TickRate;
use crate::stage::Parameter;
use crate::stage::number::round;
use crate::studio::Studio;
use crate::theme::{palette, strong_font};

/// Returns the letter of a parameter in the equation of motion, or else the parameter's name.
pub(super) fn letter(parameter: &Parameter) -> String {
    parameter.symbol.map_or_else(|| parameter.quantity(), str::to_owned)
}

/// Returns the name of a parameter, with its letter if it has one: `stiffness k`.
pub(super) fn full_name(parameter: &Parameter) -> String {
    let (quantity, letter) = (parameter.quantity(), letter(parameter));
    if letter == quantity { quantity } else { format!("{quantity} {letter}") }
}

/// Describes a point of the map: `20 Hz, k = 90 N/m`.
pub(super) fn point_in_words(
    studio: &Studio,
    index: usize,
    tick_hz: TickRate,
    value: f64,
) -> String {
    let parameter = super::parameter(studio, index);
    let text =
        format!("{tick_hz:.3} Hz, {} = {} {}", letter(parameter), round(value, 3), parameter.unit);
    text.trim_end().to_owned()
}

/// Describes the methods at the present point, and everything that the map does not draw, wrapped to a width. Also
/// returns a height for the text in points, which does not change when the cross moves.
pub(super) fn sentence(
    ui: &Ui,
    studio: &Studio,
    map: &StabilityMap,
    width: f32,
) -> (Arc<Galley>, f32) {
    let seen = seen_note(studio, map);
    let notes =
        " Drag the cross to change both values at once.".to_owned() + &seen + &map.not_drawn();
    wrapped(ui, studio, map, width, (13.0, &notes))
}

/// Returns a shorter form of [`sentence`], in which the only note is about the thin lines.
pub(super) fn short_sentence(
    ui: &Ui,
    studio: &Studio,
    map: &StabilityMap,
    width: f32,
) -> (Arc<Galley>, f32) {
    wrapped(ui, studio, map, width, (12.0, &seen_note(studio, map)))
}

/// Describes the methods at the present point in this font size, with the notes, wrapped to a width. Also returns a
/// height for the text, as [`sentence`] does.
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
    let does = if map.here.is_empty() { "judging …".to_owned() } else { map.stable_here() };
    job(ui, &[here, does], size)
}

/// Lays out a point of the map and the behaviour of the methods there.
fn job(ui: &Ui, [here, does]: &[String; 2], size: f32) -> LayoutJob {
    let mut job = LayoutJob::default();
    append(&mut job, &format!("{here}: "), strong_font(size), palette(ui).text);
    append(&mut job, does, FontId::proportional(size), palette(ui).text);
    job
}

/// Returns the longest text that can describe any point of this map.
fn longest(studio: &Studio, map: &StabilityMap) -> [String; 2] {
    let MapRequest { parameter, tick_hz, rates_hz, range, specs, .. } = &map.request;
    let names = map.method_names();
    let rates = [*tick_hz, TickRate::whole(rates_hz[1] as u32)];
    let here = rates.map(|hz| range.map(|value| point_in_words(studio, *parameter, hz, value)));
    let name = names.into_iter().max_by_key(|name| name.chars().count()).unwrap_or_default();
    let all = specs.len();
    let does = format!(
        "{all} of {all} methods are bounded, {all} pick their own steps. {name} {}.",
        PointStability::Doubles(0.001_23)
    );
    [here.into_iter().flatten().max_by_key(|here| here.chars().count()).unwrap_or_default(), does]
}

fn append(job: &mut LayoutJob, text: &str, font_id: FontId, color: Color32) {
    job.append(text, 0.0, TextFormat { font_id, color, ..TextFormat::default() });
}

/// Explains the thin lines, if there are any.
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
