//! The panels around the stage. They read the studio and return commands, but change nothing.

use egui::epaint::PathShape;
use egui::{Align2, FontId, Frame, Key, Margin, Pos2, Rect, Stroke, Ui, Vec2, pos2, vec2};

use super::theme::palette;
use crate::run::race::Mode;
use crate::studio::{Command, Dialog, Pace, Splits, Studio, ViewCommand};

mod advice;
mod annotations;
mod breakpoints;
mod cost;
mod figures;
mod focus;
mod footer;
mod guide;
mod help;
mod inspector;
mod instruments;
mod keycap;
mod lanes;
mod loops;
mod methods;
mod my_lines;
mod my_spring;
mod number_field;
mod one_step;
mod opening;
mod over_stage;
mod parts;
mod ranges;
mod rate_scale;
mod series_styles;
mod stability_map;
mod table;
mod text_field;
mod timeline;
mod top_bar;
mod tracks;
mod verdict;

#[cfg(test)]
pub(super) use focus::RING;
pub(super) use footer::spoken;
pub(super) use inspector::is_sweep_active;
pub(super) use instruments::{csv, svg};

/// Whether a number has an error message, which Escape closes.
pub(super) fn has_faults(context: &egui::Context) -> bool {
    number_field::NumberField::has_faults(context)
}

/// Panels that a frame shows beside the stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Panels {
    /// Every panel that fits.
    #[default]
    Shown,
    /// No panel: the stage fills the frame.
    Off,
    /// Only the instrument, which fills the frame.
    Instrument,
}

/// Default share of the width for the instruments, and maximum default share of the height for the table. Then the
/// width by which the grip of a boundary reaches into its panel, in points.
pub(super) const INSTRUMENTS: f32 = 0.38;
const TABLE: f32 = 0.4;
const GRIP: f32 = 6.0;

/// Size of the handle at the right edge of a stage that has no panels beside it, in points.
const EDGE: Vec2 = vec2(16.0, 80.0);

/// Initial share of the instruments' height for the inspector, if the instruments keep enough, and the inspector's
/// minimum height in points.
const INSPECTOR: f32 = 0.62;
const MIN_INSPECTOR: f32 = 130.0;

/// Returns the frame rate and the time of a frame in words, if a person asks for them and there is real time.
fn frame_rate(studio: &Studio) -> Option<String> {
    let ms = studio.viewer.frame_ms.filter(|_| studio.display().frame_rate)?;
    let rate = match studio.viewer.pace? {
        Pace::Measured { frames_per_second, .. } => format!("{frames_per_second:.0} frames/s · "),
        Pace::Unknown => String::new(),
    };
    Some(format!("{rate}{ms:.1} ms a frame"))
}

/// Shows all panels. Returns the commands and the rectangle left for the stage, in points.
pub(super) fn show(ui: &mut Ui, studio: &Studio) -> (Vec<Command>, Rect) {
    instruments::free_unshown(ui, studio);
    let mut commands = Vec::new();
    let whole = ui.max_rect();
    let size = whole.size();
    if size.x < breakpoints::PANELS[0] || size.y < breakpoints::PANELS[1] {
        over_stage::quit_question(ui, studio, whole);
        return (commands, whole);
    }
    if studio.display().measure && size.y >= breakpoints::TOP_BAR {
        let panel = egui::Panel::top("top bar")
            .exact_size(top_bar::HEIGHT)
            .frame(parts::frame(palette(ui).panel));
        panel.show(ui, |ui| top_bar::show(ui, studio, &mut commands));
    }
    // The Tab key reaches the stage before the methods, and the footer last.
    let mut footer = None;
    if size.y >= breakpoints::FOOTER {
        let panel = egui::Panel::bottom("footer")
            .exact_size(footer::HEIGHT)
            .frame(parts::frame(palette(ui).panel));
        footer = Some(panel.show(ui, reserve).inner);
    }
    let mut pointed = None;
    // The table of a race already has all the methods.
    let has_methods = studio.loop_lab().is_none()
        && (studio.mode() == Mode::Solo || !studio.display().measure)
        && size.y >= breakpoints::LANES
        && studio.bands().is_empty()
        && !(studio.display().measure && studio.display().enlarged);
    let mut methods = None;
    if has_methods {
        let frame = parts::frame(palette(ui).panel);
        let room = ui.available_width() - frame.inner_margin.sum().x;
        let height = methods::height(ui, studio, room, size);
        let panel = egui::Panel::bottom("methods").exact_size(height).frame(frame);
        methods = Some(panel.show(ui, reserve).inner);
    }
    if let Some(height) = rate_scale::height(studio, size) {
        let frame = Frame::new().fill(palette(ui).panel);
        let panel = egui::Panel::bottom("tick rate").exact_size(height).frame(frame);
        panel.show(ui, |ui| rate_scale::show(ui, studio, &mut commands));
    }
    if studio.display().measure {
        pointed = round_the_stage(ui, studio, size, &mut commands);
    }
    if let Some(tour) = studio.viewer.tour() {
        let height = guide::height(ui.available_height());
        let frame = Frame::new().fill(palette(ui).panel).inner_margin(Margin::symmetric(14, 8));
        let panel = egui::Panel::bottom("guide").exact_size(height).frame(frame);
        panel.show(ui, |ui| guide::show(ui, tour, &mut commands));
    }
    let mut stage = ui.available_rect_before_wrap();
    if !studio.display().measure {
        if studio.display().enlarged {
            // The instrument takes the place of the stage.
            let frame = parts::frame(palette(ui).background);
            egui::CentralPanel::default_margins()
                .frame(frame)
                .show(ui, |ui| instruments::show_alone(ui, studio, &mut commands));
        }
        edge(ui, stage, &mut commands);
        if studio.display().enlarged {
            stage.min.x = stage.max.x;
        }
    }
    if let Some(words) = frame_rate(studio) {
        let (at, font) = (stage.right_bottom() - vec2(8.0, 5.0), FontId::proportional(11.0));
        ui.painter().text(at, Align2::RIGHT_BOTTOM, words, font, palette(ui).text);
    }
    over_stage::fit(ui, studio, stage, &mut commands);
    if let Some(mut ui) = methods.map(|room| within(ui, room)) {
        pointed = methods::show(&mut ui, studio, &mut commands).or(pointed);
    }
    if pointed != studio.viewer.pointed_lane() {
        commands.push(Command::View(ViewCommand::PointAt(pointed)));
    }
    if let Some(mut ui) = footer.map(|room| within(ui, room)) {
        footer::show(&mut ui, studio, &mut commands);
    }
    over_stage::quit_question(ui, studio, stage);
    if studio.display().help {
        help::show(ui, studio.viewer.preferences.is_page, &mut commands);
    }
    if let Some(dialog) = studio.viewer.dialog() {
        show_dialog(ui, studio, dialog, [stage, whole], &mut commands);
    }
    focus::show(ui);
    (commands, stage)
}

fn show_dialog(
    ui: &mut Ui,
    studio: &Studio,
    dialog: &Dialog,
    [stage, whole]: [Rect; 2],
    commands: &mut Vec<Command>,
) {
    // Keeps a dialog off the instruments, because it would cut through their letters.
    let is_wide = stage.width() >= breakpoints::DIALOG_ON_STAGE;
    let along = if is_wide { stage } else { whole };
    let over = Rect::from_x_y_ranges(along.x_range(), whole.y_range());
    match dialog {
        Dialog::Spring { tick_hz } => my_spring::show(ui, studio, *tick_hz, over, commands),
        Dialog::Lines(read) => my_lines::show(ui, studio, read, over, commands),
        Dialog::Figures => figures::show(ui, over, commands),
        Dialog::Path { refused, .. } => {
            opening::path(ui, studio, refused.as_deref(), over, commands)
        }
        Dialog::Mistakes { file, report } => opening::mistakes(ui, file, report, over, commands),
    }
    if ui.input(|input| input.key_pressed(Key::Escape)) {
        commands.push(Command::View(ViewCommand::CloseDialog));
    }
}

/// Takes the room of a panel for a later [`within`], and returns it.
fn reserve(ui: &mut Ui) -> Rect {
    let room = ui.available_rect_before_wrap();
    ui.allocate_rect(room, egui::Sense::hover());
    room
}

/// Returns the inside of a panel whose room was reserved.
fn within(ui: &mut Ui, room: Rect) -> Ui {
    let mut inside = ui.new_child(egui::UiBuilder::new().max_rect(room));
    inside.shrink_clip_rect(room.expand(4.0));
    inside
}

/// Shows the table, the timeline and the instruments in a window of this size. Returns the index of the lane that has
/// the pointer or the keyboard focus in the table.
fn round_the_stage(
    ui: &mut Ui,
    studio: &Studio,
    size: Vec2,
    commands: &mut Vec<Command>,
) -> Option<usize> {
    let mut pointed = None;
    // An enlarged instrument also takes the room of the table.
    if size.y >= breakpoints::LANES && !studio.display().enlarged {
        let height = studio.loop_lab().map_or_else(|| lanes::height(studio), loops::table::height);
        let height = match studio.display().splits.table {
            Some(percent) => size.y * percent as f32 / 100.0,
            None => height.min(size.y * TABLE),
        };
        // The frame has no margin, because a row reaches from edge to edge.
        let frame = Frame::new().fill(palette(ui).panel);
        let panel = egui::Panel::bottom("lanes").exact_size(height).frame(frame);
        let shown = panel.show(ui, |ui| match studio.loop_lab() {
            Some(loops) => loops::table::show(ui, loops, commands),
            None => pointed = lanes::show(ui, studio, commands),
        });
        let rect = shown.response.rect;
        let edge = Rect::from_x_y_ranges(rect.x_range(), rect.top()..=rect.top());
        split(ui, edge, studio, commands, |splits, at| {
            splits.table = at.map(|at| (100.0 * (rect.bottom() - at.y) / size.y).round() as u32);
        });
    }
    if size.y >= breakpoints::TIMELINE {
        let height = match size.y >= breakpoints::TIMES_OF_TIMELINE {
            true => timeline::HEIGHT,
            false => timeline::HEIGHT_OF_TRACK,
        };
        let frame = parts::frame(palette(ui).panel).inner_margin(Margin::symmetric(8, 1));
        let panel = egui::Panel::bottom("timeline").exact_size(height).frame(frame);
        panel.show(ui, |ui| match studio.loop_lab() {
            Some(loops) => loops::slider::show(ui, loops, commands),
            None => timeline::show(ui, studio, commands),
        });
    }
    if size.x >= breakpoints::INSTRUMENTS {
        let part = studio.display().splits.instruments;
        let beside = size.x * part.map_or(INSTRUMENTS, |percent| percent as f32 / 100.0);
        let (width, indent) = match studio.display().enlarged {
            // The tabs stay under the pointer.
            true => (size.x, size.x - beside),
            false => (beside, 0.0),
        };
        let panel = egui::Panel::right("instruments")
            .exact_size(width)
            .frame(parts::frame(palette(ui).background));
        let shown = panel.show(ui, |ui| {
            // Contents that are wider than the panel must not move the panel's edge.
            let room = ui.available_rect_before_wrap();
            ui.allocate_rect(room, egui::Sense::hover());
            let mut inside = ui.new_child(egui::UiBuilder::new().max_rect(room));
            beside_the_stage(&mut inside, studio, indent, commands);
        });
        if !studio.display().enlarged {
            let rect = shown.response.rect;
            let edge = Rect::from_x_y_ranges(rect.left()..=rect.left(), rect.y_range());
            split(ui, edge, studio, commands, |splits, at| {
                let percent = |at: Pos2| (100.0 * (rect.right() - at.x) / size.x).round() as u32;
                splits.instruments = at.map(percent);
            });
        }
    }
    pointed
}

/// Shows the boundary of a panel along `edge`. A drag moves the boundary through `put`, and a double click resets it.
fn split(
    ui: &Ui,
    edge: Rect,
    studio: &Studio,
    commands: &mut Vec<Command>,
    put: impl Fn(&mut Splits, Option<Pos2>),
) {
    let is_upright = edge.height() > edge.width();
    let sense = egui::Sense::CLICK | egui::Sense::DRAG;
    let id = egui::Id::unique(("split", is_upright));
    // The grip lies only on the panel, because a press on the stage grabs bodies.
    let grip = edge.with_max_x(edge.right().max(edge.left() + GRIP));
    let grip = grip.with_max_y(edge.bottom().max(edge.top() + GRIP));
    let response = ui.interact(grip, id, sense);
    let mut splits = studio.display().splits;
    if response.double_clicked() {
        put(&mut splits, None);
    } else if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        put(&mut splits, Some(at));
    }
    let splits = splits.clamped();
    if splits != studio.display().splits {
        commands.push(Command::View(ViewCommand::Split(splits)));
    }
    if response.hovered() || response.dragged() {
        ui.painter().rect_filled(edge.expand(1.0), 0.0, palette(ui).accent);
        ui.ctx().set_cursor_icon(match is_upright {
            true => egui::CursorIcon::ResizeHorizontal,
            false => egui::CursorIcon::ResizeVertical,
        });
    }
}

/// Shows a handle at the right edge of a stage that has no panels beside it. The handle slides the instruments in.
fn edge(ui: &Ui, stage: Rect, commands: &mut Vec<Command>) {
    let rect = Rect::from_center_size(stage.right_center() - EDGE / 2.0 * Vec2::X, EDGE);
    let area = egui::Area::new(egui::Id::unique("edge")).fixed_pos(rect.min).constrain(false);
    area.show(ui.ctx(), |ui| {
        let (rect, response) = ui.allocate_exact_size(EDGE, egui::Sense::click());
        let about = "measure: plots, a table and the timeline (T)";
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, about));
        let is_lit = response.hovered() || response.has_focus();
        let colour = if is_lit { palette(ui).accent } else { palette(ui).dim };
        ui.painter().rect_filled(rect, 4.0, palette(ui).panel);
        let [x, y] = [rect.center().x, rect.center().y];
        let arrow = [[3.0, -6.0], [3.0, 6.0], [-4.0, 0.0]].map(|[dx, dy]| pos2(x + dx, y + dy));
        let arrow = PathShape::convex_polygon(arrow.to_vec(), colour, Stroke::NONE);
        ui.painter().add(arrow);
        if response.on_hover_text(about).clicked() {
            commands.push(Command::View(ViewCommand::ToggleMeasure));
        }
    });
}

/// Shows only the instrument, for a picture without anything to click.
pub(super) fn show_instrument(ui: &mut Ui, studio: &Studio) {
    let frame = Frame::new().fill(palette(ui).background).inner_margin(Margin::symmetric(8, 4));
    let panel = egui::CentralPanel::default_margins().frame(frame);
    panel.show(ui, |ui| {
        let mark = egui::UiStackInfo::default().with_tag(parts::PICTURE);
        ui.scope_builder(egui::UiBuilder::new().ui_stack_info(mark), |ui| {
            ui.visuals_mut().button_frame = false;
            instruments::show_alone(ui, studio, &mut Vec::new());
        });
    });
}

/// Shows the instruments. An open inspector takes their lower part, or all of the room if there is not enough for both.
fn beside_the_stage(ui: &mut Ui, studio: &Studio, indent: f32, commands: &mut Vec<Command>) {
    let most = ui.available_height() - instruments::min_height(studio.display().instrument);
    if !studio.display().inspector || studio.display().enlarged {
        instruments::show(ui, studio, indent, commands);
    } else if most < MIN_INSPECTOR {
        inspector::show(ui, studio, commands);
    } else {
        let usual = (ui.available_height() * INSPECTOR).min(most);
        let panel = egui::Panel::bottom("inspector").default_size(usual);
        let panel = panel.size_range(MIN_INSPECTOR..=most).resizable(true);
        let frame = Frame::new().inner_margin(Margin { top: 6, ..Margin::ZERO });
        panel.frame(frame).show(ui, |ui| inspector::show(ui, studio, commands));
        instruments::show(ui, studio, indent, commands);
    }
}

#[cfg(test)]
mod tests {
    use egui::Event;

    use super::*;
    use crate::scene::Scene;
    use crate::studio::{StageCommand, Studio};
    use crate::tests::testing::{TestWindow, button};

    #[test]
    fn a_panel_boundary_follows_a_drag_and_a_double_click_resets_it() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        let mut window = TestWindow::new([1280.0, 720.0]);
        let mut drag = |studio: &mut Studio, from: Pos2, to: Pos2, clicks: u32| {
            window.time_s += 1.0;
            for (at, is_down) in (0..clicks).flat_map(|_| [(from, true), (to, false)]) {
                let moved = vec![Event::PointerMoved(at)];
                let pressed = vec![button(at, is_down)];
                let commands = [moved, pressed].map(|events| window.panels(studio, events).0);
                for command in commands.into_iter().flatten() {
                    studio.apply(command);
                }
            }
        };
        let edge = pos2((1280.0 * (1.0 - INSTRUMENTS)).ceil(), 300.0);
        drag(&mut studio, edge, pos2(640.0, 300.0), 1);
        assert_eq!(studio.display().splits.instruments, Some(50));
        drag(&mut studio, pos2(640.0, 300.0), pos2(2.0, 300.0), 1);
        assert_eq!(studio.display().splits, Splits { instruments: Some(70), table: None });
        let at = pos2((1280.0_f32 * 0.3).ceil() + 1.0, 300.0);
        drag(&mut studio, at, at, 2);
        assert_eq!(studio.display().splits, Splits::default());
    }

    #[test]
    fn a_stage_without_instruments_fills_the_window_and_has_a_handle() {
        const SIZE: Vec2 = vec2(1280.0, 720.0);
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        for is_race in [false, true] {
            for measure in [false, true] {
                studio.viewer.preferences.display.measure = measure;
                let mut window = TestWindow::new(SIZE);
                window.context.enable_accesskit();
                let mut frame = || window.show(Vec::new(), |ui| show(ui, &studio));
                // Parts over the stage appear only from the second frame on.
                drop(frame());
                let ((_, stage), shown) = frame();
                assert_eq!(stage.width() == SIZE.x, !measure, "{stage}");
                let is_handle = |heard: &String| heard.starts_with("measure: ");
                assert_eq!(shown.heard.iter().any(is_handle), !measure);
                let at = pos2(SIZE.x - 6.0, stage.center().y);
                let asked = window.click(&studio, at);
                let toggle = Command::View(ViewCommand::ToggleMeasure);
                assert_eq!(asked.contains(&toggle), !measure, "{asked:?}");
            }
            if !is_race {
                studio.apply(StageCommand::ToggleRace);
            }
        }
    }
}
