//! The tick rate in the hand of a person: a scale at the left edge of the opening stage, and a number elsewhere. During
//! a drag, time stops and the stage shows the next second under each method.

use egui::{
    Align2, Area, CursorIcon, EventFilter, FontId, Id, Key, Rect, Response, Sense, Stroke, Ui,
    Vec2, WidgetInfo, pos2, vec2,
};

use super::breakpoints;
use super::number_field::NumberField;
use crate::run::race::Mode;
use crate::scene::entered_tick_rate;
use crate::stage::TickRate;
use crate::studio::{Arrangement, Command, StageCommand, Step, Studio, ViewCommand};
use crate::view::theme::{palette, strong_font};

/// Lowest and highest rate of the scale, in Hz.
const ENDS: [f64; 2] = [5.0, 1000.0];
/// Rates of games, films and screens, in Hz.
const MARKS: [u32; 6] = [10, 24, 30, 60, 120, 240];

/// Width of the strip that a hand can grab, maximum height of the scale, and its distances from the stage's left and
/// bottom edges, in points.
const WIDTH: f32 = 52.0;
const MAX_HEIGHT: f32 = 320.0;
const LEFT: f32 = 1.0;
const FOOT: f32 = 44.0;
/// Distance from the left of the strip to the line, in points.
const LINE: f32 = 16.0;
/// Share of the stage's height above the scale, where the first body, its name and its mooring are.
const ABOVE: f32 = 0.22;
/// Height of the handle, and maximum distance from a mark at which the handle snaps to it, in points.
const HANDLE: f32 = 22.0;
const SNAP: f32 = 4.0;

/// Whether a stage of this size shows the scale.
pub(super) fn is_shown(studio: &Studio, stage: Vec2) -> bool {
    let display = studio.display();
    let has_names_there =
        studio.mode() == Mode::Race && display.arrangement == Arrangement::SideBySide;
    !display.measure
        && !display.enlarged
        && studio.loop_lab().is_none()
        && !has_names_there
        && stage.x >= breakpoints::RATE_SCALE[0]
        && stage.y >= breakpoints::RATE_SCALE[1]
}

/// Shows the scale on the stage.
pub(super) fn show(ui: &Ui, studio: &Studio, stage: Rect, commands: &mut Vec<Command>) {
    let top = stage.top() + ABOVE * stage.height();
    let height = (stage.bottom() - FOOT - top).min(MAX_HEIGHT);
    let strip = Rect::from_min_size(pos2(stage.left() + LEFT, top), vec2(WIDTH, height));
    let area = Area::new(Id::unique("tick rate scale")).fixed_pos(strip.min).constrain(false);
    area.show(ui.ctx(), |ui| {
        let (rect, response) = ui.allocate_exact_size(strip.size(), Sense::click_and_drag());
        let line = Rect::from_center_size(rect.center(), rect.size() - vec2(0.0, HANDLE));
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
            let picked = TickRate::from(rate_at(line, at.y));
            // A click on the handle keeps a tick rate that no point of the scale has.
            let is_on_handle = (at.y - y_of(line, tick_hz.into())).abs() <= HANDLE / 2.0;
            if picked != tick_hz && !(response.clicked() && is_on_handle) {
                commands.push(Command::Stage(StageCommand::TickHz(picked)));
            }
        }
        if response.has_focus() {
            let filter = EventFilter { vertical_arrows: true, ..EventFilter::default() };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
            for (key, step) in [(Key::ArrowUp, Step::Next), (Key::ArrowDown, Step::Previous)] {
                if ui.input(|input| input.key_pressed(key)) {
                    commands.push(Command::Stage(StageCommand::TickRate(step)));
                }
            }
        }
        paint(ui, line, tick_hz, &response);
        let is_held = response.dragged() || response.is_pointer_button_down_on();
        if response.hovered() || is_held {
            let icon = if is_held { CursorIcon::Grabbing } else { CursorIcon::Grab };
            ui.ctx().set_cursor_icon(icon);
        }
    });
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

/// Returns the y of a rate on the scale. A rate beyond the scale is at its end.
fn y_of(line: Rect, hz: f64) -> f32 {
    let part = libm::log(hz / ENDS[0]) / libm::log(ENDS[1] / ENDS[0]);
    line.bottom() - line.height() * part.clamp(0.0, 1.0) as f32
}

/// Returns the rate at a height, which is that of a mark nearby, or else a round one.
fn rate_at(line: Rect, y: f32) -> u32 {
    let near = MARKS.into_iter().find(|&mark| (y_of(line, mark.into()) - y).abs() <= SNAP);
    near.unwrap_or_else(|| {
        let part = f64::from((line.bottom() - y) / line.height()).clamp(0.0, 1.0);
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

fn paint(ui: &Ui, line: Rect, tick_hz: TickRate, response: &Response) {
    let (palette, painter) = (palette(ui), ui.painter());
    let is_lit = response.hovered() || response.has_focus() || response.dragged();
    let quiet = if is_lit { palette.text } else { palette.dim };
    let (x, y) = (line.left() + LINE, y_of(line, tick_hz.into()));
    painter.line_segment(
        [pos2(x, line.top()), pos2(x, line.bottom())],
        Stroke::new(2.0, quiet.gamma_multiply(0.6)),
    );
    for mark in MARKS {
        let at = y_of(line, mark.into());
        let ends = [pos2(x - 5.0, at), pos2(x + 5.0, at)];
        painter.line_segment(ends, Stroke::new(1.5, quiet));
        if is_lit && (at - y).abs() > HANDLE / 2.0 + 5.0 {
            let at = pos2(x + 9.0, at);
            painter.text(at, Align2::LEFT_CENTER, mark, FontId::proportional(11.0), palette.text);
        }
    }
    let words = format!("{tick_hz:.2} Hz");
    let words = painter.layout_no_wrap(words, strong_font(12.0), palette.text);
    let size = vec2((words.size().x + 8.0).max(WIDTH - 4.0), HANDLE);
    // A handle with a long number extends over the stage.
    let handle = Rect::from_min_size(pos2(line.left() + 2.0, y - HANDLE / 2.0), size);
    let rim = if is_lit { palette.accent } else { palette.dim };
    painter.rect(
        handle,
        7.0,
        palette.panel,
        Stroke::new(if is_lit { 2.0 } else { 1.2 }, rim),
        egui::StrokeKind::Inside,
    );
    painter.galley(handle.center() - words.size() / 2.0, words, palette.text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_over_the_scale_meets_its_ends_its_marks_and_round_rates() {
        let line = Rect::from_min_size(pos2(0.0, 100.0), vec2(WIDTH, MAX_HEIGHT));
        assert_eq!([rate_at(line, 1e4), rate_at(line, -1e4)], [5, 1000]);
        for mark in MARKS {
            assert_eq!(rate_at(line, y_of(line, mark.into()) + 0.9 * SNAP), mark);
        }
        let rates: Vec<u32> = (0..=320).map(|n| rate_at(line, 420.0 - n as f32)).collect();
        assert!(rates.is_sorted(), "{rates:?}");
        for hz in [6, 15, 50, 100, 144, 500] {
            let error = rates.iter().map(|&rate| rate.abs_diff(hz)).min().unwrap();
            assert!(f64::from(error) <= 0.03 * f64::from(hz), "{hz}: {error} off");
        }
    }
}
