//! The tick rate in the hand of a person: a scale below a stage that has no panels beside it, and a number elsewhere.
//! During a drag, time stops and the stage shows the next second under each method.

use egui::{
    Align2, CursorIcon, EventFilter, FontId, Key, Rect, Response, Sense, Stroke, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};

use super::breakpoints;
use super::number_field::NumberField;
use crate::scene::entered_tick_rate;
use crate::stage::TickRate;
use crate::studio::{Command, StageCommand, Step, Studio, ViewCommand};
use crate::theme::{palette, strong_font};

/// Lowest and highest rate of the scale, in Hz.
const ENDS: [f64; 2] = [5.0, 1000.0];
/// Rates of games and screens and the ends, in Hz. A scale with more than six names would be a crowd.
const MARKS: [u32; 7] = [5, 10, 30, 60, 120, 240, 1000];
const UNNAMED: u32 = 240;

/// Height of the panel, and of a low one without numbers, in points.
const HEIGHT: f32 = 62.0;
const LOW: f32 = 34.0;
/// Distances of the line from the sides of the panel and from its foot, and from the foot of a low one, in points.
const SIDES: f32 = 46.0;
const FOOT: f32 = 30.0;
const LOW_FOOT: f32 = 17.0;
/// Height of the handle, and maximum distance from a mark at which the handle snaps to it, in points.
const HANDLE: f32 = 24.0;
const SNAP: f32 = 4.0;
/// Time in seconds at which the handle pulses in the opening, and the width of its pulse in points.
const PULSES_AT_S: f64 = 3.0;
const PULSE: f32 = 16.0;

/// Returns the height of the scale below the stage of a window of this size, or `None` if it does not show it.
pub(super) fn height(studio: &Studio, window: Vec2) -> Option<f32> {
    let display = studio.display();
    let is_shown = !display.measure
        && !display.enlarged
        && studio.loop_lab().is_none()
        && window.x >= breakpoints::RATE_SCALE[0]
        && window.y >= breakpoints::RATE_SCALE[1];
    let is_low = window.y < breakpoints::NUMBERS_OF_RATE_SCALE;
    is_shown.then_some(if is_low { LOW } else { HEIGHT })
}

/// Shows the scale in its panel.
pub(super) fn show(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let room = ui.available_rect_before_wrap();
    let has_numbers = room.height() > LOW;
    let y = room.bottom() - if has_numbers { FOOT } else { LOW_FOOT };
    let x = room.shrink2(vec2(SIDES, 0.0)).x_range();
    let line = Rect::from_x_y_ranges(x, y..=y);
    let response = ui.allocate_rect(room, Sense::click_and_drag());
    let tick_hz = studio.race().tick_hz();
    let words = format!("tick rate {tick_hz:.3} Hz: drag it, arrow keys change it");
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Slider, true, &words));
    // Escape takes the rate out of the hand, until the next press.
    let is_pressed = ui.input(|input| input.pointer.any_pressed());
    if response.is_pointer_button_down_on() && is_pressed {
        commands.push(Command::View(ViewCommand::HoldTickRate));
    }
    // The release may be the only event of a drag.
    let is_moved = response.dragged() || response.drag_stopped() || response.clicked();
    let is_moved = is_moved && (is_pressed || studio.deck.is_tick_rate_held());
    if let Some(at) = response.interact_pointer_pos().filter(|_| is_moved) {
        let picked = TickRate::from(rate_at(line, at.x));
        // A click on the handle keeps a tick rate that no point of the scale has.
        let is_on_handle = (at.x - x_of(line, tick_hz.into())).abs() <= HANDLE;
        if picked != tick_hz && !(response.clicked() && is_on_handle) {
            commands.push(Command::Stage(StageCommand::TickHz(picked)));
        }
    }
    if response.has_focus() {
        let filter = EventFilter {
            vertical_arrows: true,
            horizontal_arrows: true,
            ..EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        let arrows = [
            (Key::ArrowUp, Step::Next),
            (Key::ArrowRight, Step::Next),
            (Key::ArrowDown, Step::Previous),
            (Key::ArrowLeft, Step::Previous),
        ];
        for (key, step) in arrows {
            if ui.input(|input| input.key_pressed(key)) {
                commands.push(Command::Stage(StageCommand::TickRate(step)));
            }
        }
    }
    paint(ui, (room, line), (tick_hz, pulse(studio)), &response);
    let is_held = response.dragged() || response.is_pointer_button_down_on();
    if response.hovered() || is_held {
        let icon = if is_held { CursorIcon::Grabbing } else { CursorIcon::Grab };
        ui.ctx().set_cursor_icon(icon);
    }
}

/// Shows the tick rate as a number to drag or to type.
pub(super) fn number(
    ui: &mut Ui,
    studio: &Studio,
    size: Vec2,
    commands: &mut Vec<Command>,
) -> Response {
    let loops = studio.loop_lab();
    let tick_hz = loops.map_or(studio.race().tick_hz(), |loops| loops.scene().tick_hz);
    let rate = NumberField {
        id: ui.scope_id().with("tick rate"),
        value: f64::from(tick_hz),
        unit: "Hz",
        name: "tick rate",
        is_whole: true,
    };
    let (response, entered) = rate.show(ui, size, |value| entered_tick_rate(value).map(drop));
    if response.drag_started() {
        commands.push(Command::View(ViewCommand::HoldTickRate));
    }
    // Escape has taken the rate out of the hand.
    let is_over = response.dragged() && !response.drag_started() && loops.is_none();
    let is_over = is_over && !studio.deck.is_tick_rate_held();
    let entered = entered.filter(|_| !is_over).and_then(|value| entered_tick_rate(value).ok());
    commands.extend(entered.map(|tick_hz| Command::Stage(StageCommand::TickHz(tick_hz))));
    response
}

/// Returns the x of a rate on the scale. A rate beyond the scale is at its end.
fn x_of(line: Rect, hz: f64) -> f32 {
    let part = libm::log(hz / ENDS[0]) / libm::log(ENDS[1] / ENDS[0]);
    line.left() + line.width() * part.clamp(0.0, 1.0) as f32
}

/// Returns the rate at an x, which is that of a mark nearby, or else a round one.
fn rate_at(line: Rect, x: f32) -> u32 {
    let near = MARKS.into_iter().find(|&mark| (x_of(line, mark.into()) - x).abs() <= SNAP);
    near.unwrap_or_else(|| {
        let part = f64::from((x - line.left()) / line.width()).clamp(0.0, 1.0);
        let hz = ENDS[0] * libm::pow(ENDS[1] / ENDS[0], part);
        let step = if hz < 100.0 {
            1.0
        } else if hz < 300.0 {
            5.0
        } else {
            10.0
        };
        (libm::round(hz / step) * step) as u32
    })
}

/// Returns how far the one pulse of the handle has come, from 0 to 1, with which the opening invites to a drag.
fn pulse(studio: &Studio) -> Option<f32> {
    let part = (studio.race().t() - PULSES_AT_S) as f32;
    (!studio.bands().is_empty() && (0.0..1.0).contains(&part)).then_some(part)
}

fn paint(
    ui: &Ui,
    (room, line): (Rect, Rect),
    (tick_hz, pulse): (TickRate, Option<f32>),
    response: &Response,
) {
    let (palette, painter) = (palette(ui), ui.painter());
    let is_lit = response.hovered() || response.has_focus() || response.dragged();
    let quiet = if is_lit { palette.text } else { palette.dim };
    let (x, y) = (x_of(line, tick_hz.into()), line.center().y);
    painter.line_segment([line.left_center(), line.right_center()], Stroke::new(2.0, quiet));
    let words = format!("{tick_hz:.2} Hz");
    let words = painter.layout_no_wrap(words, strong_font(14.0), palette.background);
    let size = vec2(words.size().x + 18.0, HANDLE);
    let middle = x.clamp(room.left() + size.x / 2.0, room.right() - size.x / 2.0);
    let handle = Rect::from_center_size(pos2(middle, y), size);
    let has_numbers = room.height() > LOW;
    for mark in MARKS {
        let at = x_of(line, mark.into());
        painter.line_segment([pos2(at, y - 6.0), pos2(at, y + 6.0)], Stroke::new(1.5, quiet));
        let is_free = (at - middle).abs() > size.x / 2.0 + 6.0;
        if has_numbers && mark != UNNAMED && is_free {
            let font = FontId::proportional(12.0);
            painter.text(pos2(at, y + 9.0), Align2::CENTER_TOP, mark, font, palette.dim);
        }
    }
    if has_numbers {
        let (at, font) = (pos2(line.left(), room.top() + 1.0), FontId::proportional(12.5));
        painter.text(at, Align2::LEFT_TOP, "tick rate", font, palette.text);
    }
    if let Some(part) = pulse {
        let stroke = Stroke::new(2.0, palette.accent.gamma_multiply(1.0 - part));
        painter.rect_stroke(
            handle.expand(PULSE * part),
            7.0 + PULSE * part,
            stroke,
            egui::StrokeKind::Inside,
        );
    }
    let rim = if is_lit { palette.text } else { palette.accent };
    let stroke = Stroke::new(2.0, rim);
    painter.rect(handle, 7.0, palette.accent, stroke, egui::StrokeKind::Inside);
    painter.galley(handle.center() - words.size() / 2.0, words, palette.background);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_over_the_scale_meets_its_ends_its_marks_and_round_rates() {
        let line = Rect::from_min_size(pos2(100.0, 0.0), vec2(320.0, 0.0));
        assert_eq!([rate_at(line, -1e4), rate_at(line, 1e4)], [5, 1000]);
        for mark in MARKS {
            assert_eq!(rate_at(line, x_of(line, mark.into()) + 0.9 * SNAP), mark);
        }
        let rates: Vec<u32> = (0..=320).map(|n| rate_at(line, 100.0 + n as f32)).collect();
        assert!(rates.is_sorted(), "{rates:?}");
        for hz in [6, 15, 24, 50, 100, 144, 500] {
            let error = rates.iter().map(|&rate| rate.abs_diff(hz)).min().unwrap();
            assert!(f64::from(error) <= 0.03 * f64::from(hz), "{hz}: {error} off");
        }
    }
}
