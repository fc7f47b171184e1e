//! The timeline shows the run from its start to its end, with its events. Its handle is the present.
//!
//! A click or a drag seeks to a tick, the wheel zooms about the pointer, scrolling sideways moves the view, and a
//! double click shows everything.

use egui::{
    Align2, Color32, EventFilter, FontId, Key, Painter, Pos2, Rangef, Rect, Response, Sense, Shape,
    Stroke, Ui, Vec2, pos2, vec2,
};

use self::marks::{Context, MarkGroup, Sign, grouped};

pub(super) use self::span::Span;
use super::breakpoints;
use crate::chart::AxisScale;
use crate::run::Event;
use crate::run::race::{Mode, TimeScale};
use crate::studio::{
    Command, DriverRequest, RunCommand, StageCommand, Step, Studio, ViewCommand, shown_s,
};
use crate::theme::{PanelPalette, palette};
use crate::touch::wheel_or_pinch;

mod marks;
mod span;

/// Height of the panel with the times written below the track, and without them, in points.
pub(super) const HEIGHT: f32 = 38.0;
pub(super) const HEIGHT_OF_TRACK: f32 = 19.0;

/// Thickness of the track, and distances of its middle from the panel's top with and without the times, in points.
pub(super) const THICKNESS: f32 = 6.0;
pub(super) const TRACK_Y: f32 = 16.0;
const TRACK_Y_ALONE: f32 = 12.0;
/// Minimum length of the track, in points.
const MIN_LENGTH: f32 = 40.0;
pub(super) const MEMORY: f32 = 104.0;
/// Width at the ends of the track for half a number, and width of the *undo* button if nothing else is beside the
/// track, in points.
pub(super) const MARGIN: f32 = 14.0;
const UNDO: f32 = 52.0;
/// Share of the memory limit from which the used memory is shown.
const NEAR_THE_BOUND: f64 = 0.75;
/// Minimum distance between two numbers along the track, and between two marks, in points.
const NUMBERS_APART: f64 = 120.0;
const MARKS_APART: f32 = 15.0;
/// Height of a check above the middle of the track, clear of the handle, and minimum distance between two passed checks
/// along the track, in points.
const CHECK_HEIGHT: f32 = 11.0;
const CHECKS_APART: f32 = 9.0;
/// Number of ticks in the closest view.
const MIN_TICKS: f64 = 12.0;
/// Maximum number of marks that a tooltip lists.
const MAX_TOLD: usize = 8;

pub(super) fn show(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let room = ui.available_rect_before_wrap();
    let Some(groove) = groove(studio, room) else { return };
    let along = groove.along;
    let events = studio.run().events();
    let times = studio.run().times();
    let response = groove.interact(ui);
    let span = visible_span(ui, studio, &times, &response, along);
    let track = TimelineView { groove, span, times: &times, palette: palette(ui) };

    let present = studio.race().tick();
    let now = (studio.race().t(), format!("timeline, at tick {present}"));
    groove.seek(ui, &response, now, commands, |x| {
        let tick = track.tick(x);
        (studio.running() || tick != present).then_some(Command::Run(RunCommand::Seek(tick)))
    });
    let context = Context {
        events: &events,
        scene: studio.scene(),
        start: studio.run().start(),
        times: &times,
        palette: track.palette,
        compared: studio.deck.compared(),
    };
    let in_view = |x: f32| along.expand(1.0).contains(x);
    let end = studio.run().end();
    let end = studio.run().is_in_past().then(|| context.end(end));
    let mut marks: Vec<_> = context.marks().chain(end).chain(context.first_difference()).collect();
    marks.sort_by_key(|mark| mark.tick);
    let mut groups = grouped(marks.into_iter(), |mark| track.x(mark.tick), MARKS_APART);
    groups.retain(|group| in_view(group.x));

    let painter = ui.painter().clone();
    groove.write(&painter, span, track.palette);
    draw_track(&painter, studio, &events, &track);
    draw_checks(&painter, studio, &track);
    write_failed_check(&painter, studio, &track);
    groups.iter().for_each(|group| draw_group(&painter, &track, group));
    // The handle is at the same moment as the stage and the plots.
    let shown_s = shown_s(studio);
    let present = span.x(shown_s, along);
    if along.expand(1.0).contains(present) {
        groove.handle(&painter, present, response.has_focus(), track.palette);
    }
    show_undo_and_memory(
        ui,
        studio,
        Rect::from_min_max(pos2(along.max + MARGIN, room.top()), room.max),
        commands,
    );
    response.context_menu(|ui| {
        let keys = if studio.viewer.preferences.is_page { "" } else { " (Ctrl L)" };
        if ui.button(format!("Share: copy a link{keys}")).clicked() {
            commands.push(Command::Ask(DriverRequest::CopyLink));
            ui.close();
        }
        if ui.button("Report: a picture with the run (Shift P)").clicked() {
            commands.push(Command::Ask(DriverRequest::Report));
            ui.close();
        }
        if ui.button("Compare with… (Shift O)").clicked() {
            commands.push(Command::View(ViewCommand::AskForRun));
            ui.close();
        }
        let is_compared = studio.deck.compared().is_some();
        if is_compared && ui.button("× End the comparison (Esc)").clicked() {
            commands.push(Command::View(ViewCommand::CloseComparison));
            ui.close();
        }
    });
    tooltip(ui, studio, response, &track, (&context, &groups));
}

fn groove(studio: &Studio, room: Rect) -> Option<Groove> {
    Groove::new(room, if studio.run().undoes().is_some() { UNDO } else { 0.0 })
}

/// The track of a timeline at its place on a panel.
#[derive(Clone, Copy)]
pub(super) struct Groove {
    room: Rect,
    /// The y of the track's middle.
    pub(super) y: f32,
    pub(super) along: Rangef,
}

impl Groove {
    /// Creates a track, or returns `None` if the track would be too short. At the right there is room for words, or
    /// else `beside` points.
    pub(super) fn new(room: Rect, beside: f32) -> Option<Self> {
        let has_words = room.width() >= breakpoints::WORDS_BESIDE_TIMELINE;
        let right = if has_words { MEMORY } else { beside };
        let along = Rangef::new(room.left() + MARGIN, room.right() - right - MARGIN);
        let y = room.top() + if is_tall(room) { TRACK_Y } else { TRACK_Y_ALONE };
        (along.span() >= MIN_LENGTH).then_some(Self { room, y, along })
    }

    pub(super) fn interact(&self, ui: &Ui) -> Response {
        let grab = Rect::from_x_y_ranges(self.along.expand(MARGIN / 2.0), self.room.y_range());
        ui.interact(grab, ui.scope_id().with("track"), Sense::click_and_drag())
    }

    /// Gives the command of `seek` for the pressed place. While the track has the focus, the arrow keys step by ticks
    /// or frames. The name of the present moment (s) is for screen readers.
    pub(super) fn seek(
        &self,
        ui: &Ui,
        response: &Response,
        (now_s, name): (f64, String),
        commands: &mut Vec<Command>,
        seek: impl FnOnce(f32) -> Option<Command>,
    ) {
        response.widget_info(|| egui::WidgetInfo::slider(true, now_s, &name));
        commands.extend(pressed(ui, response, self.along).and_then(seek));
        step(ui, response, commands);
    }

    /// Returns the rectangle of the track between two places, as far as it is visible.
    pub(super) fn piece(&self, from: f32, to: f32) -> Rect {
        let [from, to] = [from, to].map(|x| self.along.clamp(x));
        let half = 0.5 * THICKNESS;
        Rect::from_min_max(pos2(from, self.y - half), pos2(to, self.y + half))
    }

    /// Writes round times below the track, if the panel has room.
    pub(super) fn write(&self, painter: &Painter, span: Span, palette: &PanelPalette) {
        if is_tall(self.room) {
            numbers(painter, (span, self.along), self.y, self.room.bottom(), palette);
        }
    }

    /// Writes words at an end of the panel, if the panel has room.
    pub(super) fn write_at(
        &self,
        painter: &Painter,
        end: Align2,
        words: &str,
        palette: &PanelPalette,
    ) {
        if self.room.width() >= breakpoints::WORDS_BESIDE_TIMELINE {
            let at = pos2(end.pos_in_rect(&self.room).x, self.y);
            painter.text(at, end, words, FontId::proportional(11.5), palette.dim);
        }
    }

    /// Draws the handle at the present moment.
    pub(super) fn handle(
        &self,
        painter: &Painter,
        x: f32,
        has_focus: bool,
        palette: &PanelPalette,
    ) {
        let rim = match has_focus {
            true => Stroke::new(2.5, palette.accent),
            false => Stroke::new(2.0, palette.background),
        };
        painter.circle(pos2(x, self.y), 6.0, palette.exact, rim);
    }
}

/// Whether a panel has room for the times below the track.
fn is_tall(room: Rect) -> bool {
    room.height() > 0.5 * (HEIGHT + HEIGHT_OF_TRACK)
}

/// The track on the panel, with the part of the run that it shows.
struct TimelineView<'a> {
    groove: Groove,
    span: Span,
    times: &'a TimeScale,
    palette: &'static PanelPalette,
}

impl TimelineView<'_> {
    fn x(&self, tick: u64) -> f32 {
        self.span.x(self.times.t(tick), self.groove.along)
    }

    fn tick(&self, x: f32) -> u64 {
        self.times.nearest_tick(self.span.t(x, self.groove.along))
    }
}

/// Returns the part of the run in view after this frame's wheel and clicks.
fn visible_span(
    ui: &Ui,
    studio: &Studio,
    times: &TimeScale,
    response: &Response,
    along: Rangef,
) -> Span {
    let id = response.id;
    let whole = Span::whole(studio.scene().seconds, times.t(studio.run().end()));
    if response.double_clicked() {
        ui.data_mut(|data| data.remove::<Span>(id));
    }
    let kept = ui.data(|data| data.get_temp::<Span>(id));
    let mut span = kept.map_or(whole, |span| span.moved(0.0, whole));
    if studio.running() && kept.is_some() {
        span = span.following(studio.race().t(), whole);
    }
    if let Some(pointer) = response.hover_pos() {
        let (times, right) = wheel_or_pinch(ui);
        let min_s = MIN_TICKS / f64::from(studio.race().tick_hz());
        if times != 1.0 {
            span = span.zoomed(span.t(pointer.x, along), times, min_s, whole);
        }
        let by_s = -f64::from(right / along.span()) * span.length_s();
        span = span.moved(by_s, whole);
    }
    if span.length_s() < whole.length_s() {
        ui.data_mut(|data| data.insert_temp(id, span));
    } else {
        ui.data_mut(|data| data.remove::<Span>(id));
    }
    span
}

/// Returns the place at which a track is pressed.
fn pressed(ui: &Ui, response: &Response, along: Rangef) -> Option<f32> {
    // A press that ends before the next frame shows only as a release. A release without new input does not seek,
    // because a key in the same frame may already have moved the present.
    let is_new = ui.input(|i| i.pointer.any_pressed() || i.pointer.delta() != Vec2::ZERO);
    let has_ended = response.clicked() || response.drag_stopped();
    let is_other = ui.input(|i| i.pointer.secondary_down() || i.pointer.secondary_released());
    let is_down = response.is_pointer_button_down_on() && !is_other;
    let is_pressed = is_down || has_ended && is_new;
    let pointer = response.interact_pointer_pos().filter(|_| is_pressed)?;
    Some(along.clamp(pointer.x))
}

/// Steps back and forth by the arrow keys while the track has the focus.
fn step(ui: &Ui, response: &Response, commands: &mut Vec<Command>) {
    if response.has_focus() {
        let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        let pressed = |key| ui.input(|input| input.num_presses(key));
        commands.extend(
            (0..pressed(Key::ArrowLeft))
                .map(|_| Command::Stage(StageCommand::Tick(Step::Previous))),
        );
        commands.extend(
            (0..pressed(Key::ArrowRight)).map(|_| Command::Stage(StageCommand::Tick(Step::Next))),
        );
    }
}

/// Writes the times at round steps below a track. The track's middle is at `y`.
fn numbers(
    painter: &Painter,
    (span, along): (Span, Rangef),
    y: f32,
    bottom: f32,
    palette: &PanelPalette,
) {
    let Span { from_s, to_s } = span;
    let mut marks = AxisScale::Linear.marks([from_s, to_s], along.span(), NUMBERS_APART);
    if let Some((_, text)) = marks.last_mut() {
        text.push_str(" s");
    }
    for (t, text) in marks {
        let x = span.x(t, along);
        let top = y + 0.5 * THICKNESS;
        painter.vline(x, Rangef::new(top + 1.0, top + 4.0), Stroke::new(1.0, palette.dim));
        let at = pos2(x, bottom);
        painter.text(at, Align2::CENTER_BOTTOM, text, FontId::proportional(10.5), palette.dim);
    }
}

/// Draws the track. The run up to the present has the colours of the methods, and the rest of the run is grey.
fn draw_track(painter: &Painter, studio: &Studio, events: &[Event], track: &TimelineView<'_>) {
    let round = 0.5 * THICKNESS;
    let (groove, along) = (track.groove, track.groove.along);
    painter.rect_filled(groove.piece(along.min, along.max), round, track.palette.raised);
    let [present, end] = [studio.race().tick(), studio.run().end()].map(|tick| track.x(tick));
    painter.rect_filled(
        groove.piece(along.min, end),
        round,
        track.palette.dim.gamma_multiply(0.45),
    );
    let lane = studio.selected().id;
    let colours = marks::colours(lane, events, studio.run().start(), track.palette);
    for (i, (from, colour)) in colours.iter().enumerate() {
        let to = colours.get(i + 1).map_or(present, |(tick, _)| track.x(*tick)).min(present);
        let piece = groove.piece(track.x(*from), to);
        if piece.width() > 0.0 {
            let corners = if i == 0 { round } else { 0.0 };
            painter.rect_filled(piece, corners, strength(*colour, studio.mode(), track.palette));
        }
    }
}

/// Draws ✓ or ✗ above the track at each check that the run has reached. A ✓ too close to the last one is left out.
fn draw_checks(painter: &Painter, studio: &Studio, track: &TimelineView<'_>) {
    let mut free = f32::NEG_INFINITY;
    for (tick, is_same) in checks(studio) {
        let x = track.x(tick);
        if !track.groove.along.contains(x) || is_same && x < free {
            continue;
        }
        free = x + CHECKS_APART;
        let at = |points: &[[f32; 2]]| {
            points
                .iter()
                .map(|&[dx, dy]| pos2(x + dx, track.groove.y - CHECK_HEIGHT + dy))
                .collect()
        };
        let (signs, colour): (&[&[[f32; 2]]], _) = match is_same {
            true => (&[&[[-3.0, 0.0], [-1.0, 2.5], [3.0, -3.0]]], track.palette.good),
            false => {
                (&[&[[-3.0, -3.0], [3.0, 3.0]], &[[-3.0, 3.0], [3.0, -3.0]]], track.palette.bad)
            }
        };
        for sign in signs {
            painter.add(Shape::line(at(sign), Stroke::new(1.6, colour)));
        }
    }
}

/// Writes beside the first ✗ that the run is not the recorded one, over the checks that follow it.
fn write_failed_check(painter: &Painter, studio: &Studio, track: &TimelineView<'_>) {
    let Some(failed) = studio.run().first_failed_check() else { return };
    let (x, along) = (track.x(failed.tick), track.groove.along);
    if !along.contains(x) {
        return;
    }
    let font = FontId::proportional(10.5);
    let text = painter.layout_no_wrap(failed.fault(), font, track.palette.bad);
    let fits = x + CHECKS_APART + text.size().x <= track.groove.room.right();
    let align = if fits { Align2::LEFT_CENTER } else { Align2::RIGHT_CENTER };
    let beside = if fits { CHECKS_APART } else { -CHECKS_APART };
    let at = pos2(x + beside, track.groove.y - CHECK_HEIGHT);
    let plate = align.anchor_size(at, text.size());
    painter.rect_filled(plate.expand2(vec2(2.0, 0.0)), 2.0, track.palette.background);
    painter.galley(plate.min, text, track.palette.bad);
}

/// Returns each tick with checks that the run has reached, and whether all of its lanes had the recorded state.
fn checks(studio: &Studio) -> impl Iterator<Item = (u64, bool)> {
    let ticks = studio.run().checked().chunk_by(|one, next| one.tick == next.tick);
    ticks.map(|checks| (checks[0].tick, checks.iter().all(|check| check.is_same)))
}

/// Returns the colour of the selected lane on the track. It is dimmed in a race, because the lanes of a race have many
/// colours.
fn strength(colour: Color32, mode: Mode, palette: &PanelPalette) -> Color32 {
    match mode {
        Mode::Solo => colour,
        Mode::Race => palette.background.lerp_to_gamma(colour, 0.8),
    }
}

/// Draws the sign of a group above the track, with the number of marks in the group.
fn draw_group(painter: &Painter, track: &TimelineView<'_>, group: &MarkGroup) {
    let (x, foot) = (group.x, track.groove.y - 0.5 * THICKNESS);
    let mark = group.drawn_mark();
    let colour = mark.colour;
    let centre = pos2(x, foot - 6.0);
    let rim = Stroke::new(1.0, track.palette.background);
    let polygon = |points: &[[f32; 2]]| {
        let points = points.iter().map(|&[dx, dy]| centre + vec2(dx, dy)).collect();
        painter.add(Shape::convex_polygon(points, colour, rim));
    };
    let top = if mark.sign == Sign::Halt { foot - 12.0 } else { foot - 4.0 };
    painter.vline(x, Rangef::new(top, track.groove.y + 0.5 * THICKNESS), Stroke::new(1.5, colour));
    match mark.sign {
        Sign::End => {
            let reach = Rangef::point(track.groove.y).expand(0.5 * THICKNESS + 3.0);
            painter.vline(x, reach, Stroke::new(1.5, colour));
        }
        Sign::Input => {
            painter.vline(x, Rangef::new(foot - 8.0, foot), Stroke::new(2.0, colour));
        }
        Sign::Edit => {
            let square = Rect::from_center_size(centre, Vec2::splat(7.0));
            painter.rect(square, 1.5, colour, rim, egui::StrokeKind::Outside);
        }
        Sign::Rate => polygon(&[[-4.5, 3.5], [0.0, -4.5], [4.5, 3.5]]),
        Sign::Place => {
            painter.circle(centre, 3.6, track.palette.background, Stroke::new(1.8, colour));
        }
        Sign::Kick => polygon(&[[0.0, -5.2], [4.4, 0.0], [0.0, 5.2], [-4.4, 0.0]]),
        Sign::Switch => {
            painter.circle(centre, 4.2, colour, rim);
        }
        Sign::Parting => {
            for dx in [-4.0, 4.0] {
                let ends = [centre + vec2(-dx, -7.0), centre + vec2(dx, 1.0)];
                painter.line_segment(ends, Stroke::new(2.0, colour));
            }
        }
        Sign::Halt => polygon(&[[-0.7, -6.0], [8.0, -2.5], [-0.7, 1.0]]),
    }
    if group.marks.len() > 1 {
        let at = centre + vec2(if mark.sign == Sign::Halt { 8.5 } else { 5.5 }, -1.0);
        let count = format!("×{}", group.marks.len());
        painter.text(at, Align2::LEFT_CENTER, count, FontId::proportional(9.0), track.palette.text);
    }
}

/// Shows the *undo* button, and the memory that the recorded run takes.
fn show_undo_and_memory(ui: &mut Ui, studio: &Studio, room: Rect, commands: &mut Vec<Command>) {
    let timeline = studio.run();
    let is_near = timeline.bytes() as f64 >= NEAR_THE_BOUND * timeline.limit() as f64;
    // A recorded picture must not depend on the machine that makes it.
    let is_told = studio.viewer.pace.is_some() && room.width() >= MEMORY - 1.0;
    if is_told && is_near && room.height() > HEIGHT_OF_TRACK {
        let text = memory(timeline.bytes(), timeline.limit());
        let at = room.right_bottom();
        ui.painter().text(
            at,
            Align2::RIGHT_BOTTOM,
            text,
            FontId::proportional(10.5),
            palette(ui).dim,
        );
    }
    if let Some(what) = studio.run().undoes() {
        let size = vec2(UNDO - 6.0, 18.0).min(room.size());
        let rect = Rect::from_min_size(pos2(room.right() - size.x, room.top() + 1.0), size);
        let button =
            ui.put(rect, egui::Button::new(egui::RichText::new("Undo").size(11.0)).small());
        let about = format!("undo: {what}, Ctrl Z");
        button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &about));
        if button.on_hover_text(about).clicked() {
            commands.push(Command::Run(RunCommand::Undo));
        }
    }
}

/// Formats the used memory and its limit.
fn memory(bytes: usize, limit: usize) -> String {
    let megabytes = |bytes: usize| bytes as f64 / f64::from(1 << 20);
    format!("{:.1} of {:.0} MB", megabytes(bytes), megabytes(limit))
}

/// Shows the events under the pointer, or the moment if there are no events.
fn tooltip(
    ui: &Ui,
    studio: &Studio,
    response: Response,
    track: &TimelineView<'_>,
    (context, groups): (&Context<'_>, &[MarkGroup]),
) {
    let Some(Pos2 { x, .. }) = response.hover_pos() else { return };
    let x = track.groove.along.clamp(x);
    let line = Stroke::new(1.0, palette(ui).text.gamma_multiply(0.5));
    ui.painter().vline(x, Rangef::new(track.groove.y - 12.0, track.groove.y + 4.0), line);
    // The tooltip is above the pointer, because the heads of the table are below.
    let mut above = egui::Tooltip::for_enabled(&response).at_pointer().gap(12.0);
    above.popup = above.popup.align(egui::RectAlign::TOP);
    above.show(|ui| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        let near = |group: &&MarkGroup| (-6.0..=MARKS_APART - 6.0).contains(&(x - group.x));
        let Some(group) = groups.iter().rfind(near) else {
            let near = |(tick, _): &(u64, bool)| (track.x(*tick) - x).abs() < 0.5 * CHECKS_APART;
            ui.label(match checks(studio).find(near) {
                Some((tick, true)) => format!("{}: as recorded", track.times.moment(tick)),
                Some((tick, false)) => format!("{}: not the same run", track.times.moment(tick)),
                None => track.times.moment(track.tick(x)),
            });
            return;
        };
        group.marks.iter().take(MAX_TOLD).for_each(|mark| drop(ui.label(context.text(mark))));
        if group.marks.len() > MAX_TOLD {
            ui.label(format!("and {} more", group.marks.len() - MAX_TOLD));
        }
    });
}

#[cfg(test)]
mod tests;
