//! The instrument beside the stage, with tabs in one row and the selected instrument below them.
//!
//! The axes follow the truth and the lanes near it. A lane beyond the axes is cut off at the edge, and an arrow in its
//! colour marks the place.

use egui::{Button, Color32, ComboBox, Rect, Response, RichText, Sense, Stroke, Ui, vec2};

use super::parts::{is_picture, numbered};
use super::series_styles::{SeriesStyle, SeriesStyles};
use super::tracks::Detail;
use super::{advice, breakpoints, cost, loops, one_step, stability_map};
use crate::chart::legend::{self, Entry};
use crate::loops::loop_lab::FRAME_METRICS;
use crate::run::METRICS;
use crate::run::past::Quantity;
use crate::studio::{
    Command, INSTRUMENTS, Instrument, InstrumentCard, InstrumentGroup, StageCommand, Studio,
    ViewCommand, cloud_request,
};
use crate::theme::{TYPE, palette, strong_font};

pub(crate) use export::{csv, svg};
use plot_set::{BeforeLine, PlotSet};

mod by_loop;
mod chart;
mod cloud;
mod energy;
mod error;
mod export;
mod hover;
mod layout;
mod motion;
mod phase;
mod plot_set;
mod polhode;
#[cfg(test)]
mod tests;

/// The gap between two tabs, and the padding of a tab in a narrow panel, in points.
const BETWEEN_TABS: f32 = 2.0;
const TIGHT: f32 = 2.5;
/// The gap between two groups of tabs, in points.
const BETWEEN_GROUPS: f32 = 10.0;
/// Maximum number of lines in a legend. A table below shows the names of more lines, and the plots need the room.
const MAX_IN_LEGEND: usize = 12;
/// Maximum number of lines in a legend that is beside the title.
const BESIDE_TITLE: usize = 2;
/// The height of a line of the title or the legend, in points.
const HEAD: f32 = 22.0;
/// The gap before a legend beside the title, in points.
const BEFORE_LEGEND: f32 = 8.0;

/// Returns the minimum height of an instrument with its tabs, in points. Below this height the plot is unreadable, or
/// words overlap.
pub(super) fn min_height(instrument: Instrument) -> f32 {
    match instrument {
        Instrument::OneStep => 430.0,
        Instrument::StabilityMap | Instrument::Loop => 300.0,
        Instrument::Energy
        | Instrument::Phase
        | Instrument::Polhode
        | Instrument::Cloud
        | Instrument::Advice => 260.0,
        Instrument::Motion | Instrument::Error | Instrument::Cost => 200.0,
    }
}

/// Frees the images of clouds while no clouds are shown.
pub(super) fn free_unshown(ui: &Ui, studio: &Studio) {
    if cloud_request(studio).is_none() {
        cloud::free_images(ui);
    }
}

/// Shows the tabs, which begin `indent` points from the left, and the selected instrument.
pub(super) fn show(ui: &mut Ui, studio: &Studio, indent: f32, commands: &mut Vec<Command>) {
    tabs(ui, studio, indent, commands);
    ui.add_space(2.0);
    show_alone(ui, studio, commands);
}

/// Shows the selected instrument without tabs.
pub(super) fn show_alone(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let room = ui.available_size() - vec2(10.0, 2.0);
    match studio.display().instrument {
        Instrument::Motion
        | Instrument::Error
        | Instrument::Energy
        | Instrument::Phase
        | Instrument::Polhode => {
            if let Some(set) = plot_set_of(studio, detail(ui, studio)) {
                plots(ui, studio, &set, commands);
            }
        }
        Instrument::Cost => cost::show(ui, studio, room, commands),
        Instrument::StabilityMap => stability_map::show(ui, studio, room, commands),
        Instrument::OneStep => one_step::show(ui, studio, room),
        Instrument::Cloud => cloud::show(ui, studio, room, commands),
        Instrument::Loop => loops::show(ui, studio, room, commands),
        Instrument::Advice => advice::show(ui, studio, commands),
    }
}

/// Returns the detail of the plots in the rest of `ui`. The plots have every sample if the user points at them or has
/// zoomed.
fn detail(ui: &Ui, studio: &Studio) -> Detail {
    let room = ui.available_rect_before_wrap();
    match ui.rect_contains_pointer(room) || chart::is_zoomed(studio) {
        true => Detail::Samples,
        false => Detail::Columns(room.width() * ui.pixels_per_point()),
    }
}

/// Returns the plots of the selected instrument, or `None` if it has no plots.
fn plot_set_of(studio: &Studio, detail: Detail) -> Option<PlotSet> {
    if let Some(loops) = studio.loop_lab() {
        return by_loop::plot_set(studio, loops, studio.display().instrument);
    }
    match studio.display().instrument {
        Instrument::Motion => Some(motion::plot_set(studio, detail)),
        Instrument::Error => Some(error::plot_set(studio)),
        Instrument::Energy => Some(energy::plot_set(studio)),
        Instrument::Phase => Some(phase::plot_set(studio)),
        Instrument::Polhode => Some(polhode::plot_set(studio)),
        Instrument::Cloud => cloud::plot_set(studio),
        Instrument::Cost
        | Instrument::StabilityMap
        | Instrument::OneStep
        | Instrument::Loop
        | Instrument::Advice => None,
    }
}

/// Shows the tabs of the instruments in one row, in groups. If the tabs do not fit, the groups that are not selected
/// shrink to their names. If that does not fit either, a menu replaces the row.
fn tabs(ui: &mut Ui, studio: &Studio, indent: f32, commands: &mut Vec<Command>) {
    let room = ui.available_width() - indent;
    let usual = ui.spacing().button_padding.x;
    let chosen = studio.display().instrument.card().group;
    let is_there = |group: &InstrumentGroup| cards(studio, *group).next().is_some();
    let groups: Vec<_> = InstrumentGroup::ALL.into_iter().filter(is_there).collect();
    let fits = |padding: f32, is_whole: bool| {
        let width = |group: &InstrumentGroup| match is_whole || *group == chosen {
            true => tabs_width(ui, cards(studio, *group).map(|card| card.name), padding),
            false => tabs_width(ui, std::iter::once(group.name()), padding),
        };
        groups.iter().map(width).sum::<f32>() + 2.0 * BETWEEN_GROUPS <= room
    };
    let ways = [(usual, true), (TIGHT, true), (usual, false), (TIGHT, false)];
    let Some((padding, is_whole)) = ways.into_iter().find(|&(padding, whole)| fits(padding, whole))
    else {
        return tabs_menu(ui, studio, indent, commands);
    };
    ui.horizontal(|ui| {
        ui.add_space(indent);
        ui.spacing_mut().item_spacing.x = BETWEEN_TABS;
        ui.spacing_mut().button_padding.x = padding;
        for (place, group) in groups.into_iter().enumerate() {
            if place > 0 {
                let size = vec2(BETWEEN_GROUPS - BETWEEN_TABS, ui.spacing().interact_size.y);
                let (gap, _) = ui.allocate_exact_size(size, Sense::hover());
                let stroke = Stroke::new(1.0, palette(ui).line);
                ui.painter().vline(gap.center().x, gap.shrink2(vec2(0.0, 4.0)).y_range(), stroke);
            }
            let mut open = cards(studio, group).peekable();
            if !is_whole && group != chosen {
                let names: Vec<&str> = cards(studio, group).map(|card| card.name).collect();
                if let Some(first) = open.peek()
                    && tab(ui, group.name(), &names.join(", "), false)
                {
                    commands.push(Command::Stage(StageCommand::Instrument(first.instrument)));
                }
                continue;
            }
            for card in open {
                if tab(ui, card.name, card.about, studio.display().instrument == card.instrument) {
                    commands.push(Command::Stage(StageCommand::Instrument(card.instrument)));
                }
            }
        }
    });
}

/// Returns the available instruments of a group, and the selected one.
fn cards(studio: &Studio, group: InstrumentGroup) -> impl Iterator<Item = &'static InstrumentCard> {
    let is_in_loop_lab = studio.loop_lab().is_some();
    let of_group = INSTRUMENTS.iter().filter(move |card| card.group == group);
    of_group.filter(move |InstrumentCard { instrument, .. }| match is_in_loop_lab {
        true => instrument.is_in_loop_lab(),
        false => *instrument == studio.display().instrument || instrument.is_of(studio.scene()),
    })
}

/// Returns the width of tabs with this padding around their words, in points. The width suffices for any selected tab.
fn tabs_width<'a>(ui: &Ui, names: impl Iterator<Item = &'a str>, padding: f32) -> f32 {
    let tab = |name: &str| {
        let words = ui.painter().layout_no_wrap(name.into(), strong_font(TYPE), palette(ui).text);
        words.size().x + 2.0 * padding + BETWEEN_TABS
    };
    names.map(tab).sum()
}

/// Shows the menu of instruments.
fn tabs_menu(ui: &mut Ui, studio: &Studio, indent: f32, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.add_space(indent);
        let instrument = studio.display().instrument;
        let open = InstrumentGroup::ALL.into_iter().flat_map(|group| cards(studio, group));
        let offered =
            open.map(|card| (Command::Stage(StageCommand::Instrument(card.instrument)), card.name));
        let chosen = (Command::Stage(StageCommand::Instrument(instrument)), instrument.name());
        choice(ui, "instrument", offered, chosen, commands);
    });
}

/// Shows a tab. Returns whether it was clicked.
fn tab(ui: &mut Ui, name: &str, about: &str, is_chosen: bool) -> bool {
    let palette = palette(ui);
    let text = match is_chosen {
        true => RichText::new(name).color(palette.on_accent).font(strong_font(TYPE)),
        false => RichText::new(name).color(palette.text),
    };
    let fill = if is_chosen { palette.accent } else { Color32::TRANSPARENT };
    let response = ui.add(Button::new(text).fill(fill).stroke(Stroke::NONE));
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Tab, true, is_chosen, name));
    response.on_hover_text(about).clicked()
}

/// Shows an instrument that has plots: its title, its menus, its legend, and the plots.
fn plots(ui: &mut Ui, studio: &Studio, set: &PlotSet, commands: &mut Vec<Command>) {
    let entries = legend_entries(set);
    // If there is only one method, the table and the stage distinguish it from the exact solution.
    let has_before = set.plots.iter().any(|plot| plot.before.is_some());
    let is_needed =
        set.styles.is_race || has_before || entries.len() > BESIDE_TITLE || is_picture(ui);
    let has_legend =
        is_needed && ui.available_height() >= breakpoints::LEGEND && entries.len() <= MAX_IN_LEGEND;
    let may_be_beside = has_legend
        && entries.len() <= BESIDE_TITLE
        && studio.display().instrument == Instrument::Motion;
    let for_plots = ui.available_height() - HEAD * (1.0 + f32::from(u8::from(has_legend)));
    let is_beside = ui.horizontal_wrapped(|ui| {
        // The tab of the instrument is its title, if there is a window.
        if is_picture(ui) {
            ui.label(RichText::new(&set.title).font(strong_font(15.0)).color(palette(ui).text));
        }
        choices(ui, studio, commands);
        if !layout::all_fit(set.plots.len(), for_plots) {
            // All other instruments already have the menu.
            if studio.display().instrument == Instrument::Motion {
                body_choice(ui, studio, commands);
            }
            let hidden = RichText::new("not all plots fit").color(palette(ui).dim);
            ui.label(hidden).on_hover_text("choose a body here, or enlarge the instrument");
        }
        let widths = entries.iter().map(|entry| entry.width(ui));
        let room = BEFORE_LEGEND + legend::BETWEEN * entries.len() as f32 + widths.sum::<f32>();
        let is_beside = may_be_beside && room <= ui.available_width();
        if is_beside {
            ui.add_space(BEFORE_LEGEND);
            let shown = legend::show_here(ui, &entries, 0.0);
            pick_by_legend(set, (&entries, &shown), commands);
        }
        is_beside
    });
    if has_legend && !is_beside.inner {
        let shown = legend::show(ui, &entries);
        pick_by_legend(set, (&entries, &shown), commands);
    }
    chart::show(ui, studio, set, commands);
}

/// Shows the menus of an instrument, such as the metric and the body.
fn choices(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let instrument = studio.display().instrument;
    if instrument == Instrument::Error {
        let (offered, chosen): (Vec<_>, usize) = match studio.loop_lab() {
            Some(loops) => {
                let names = FRAME_METRICS.iter().map(|metric| metric.name);
                (names.enumerate().collect(), loops.metric())
            }
            None => {
                let names = error::choices().map(|place| (place, METRICS[place].name));
                (names.collect(), studio.display().metric)
            }
        };
        let name = offered.iter().find(|(place, _)| *place == chosen).map(|(_, name)| *name);
        let offered = offered
            .into_iter()
            .map(|(place, name)| (Command::Stage(StageCommand::Metric(place)), name));
        let chosen = (Command::Stage(StageCommand::Metric(chosen)), name.unwrap_or_default());
        choice(ui, "metric", offered, chosen, commands);
    }
    let has_all = instrument == Instrument::Motion && studio.loop_lab().is_none();
    // In a picture, the axes name the default quantity.
    let is_said = studio.display().quantity.is_some() || !is_picture(ui);
    if has_all && is_said {
        let named = |quantity: Option<Quantity>| {
            let name = quantity.map_or("default", Quantity::name);
            (Command::View(ViewCommand::Quantity(quantity)), name)
        };
        let offered = [None].into_iter().chain(Quantity::ALL.map(Some)).map(named);
        ui.label(RichText::new("plot:").color(palette(ui).dim));
        choice(ui, "quantity", offered, named(studio.display().quantity), commands);
    }
    if has_all || instrument == Instrument::Phase && studio.loop_lab().is_none() {
        coordinate_choice(ui, studio, commands);
    }
    if !has_all {
        body_choice(ui, studio, commands);
    }
}

/// Offers the bodies of the scene, if there are several.
fn body_choice(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    if studio.scene().bodies.len() > 1 {
        let names = studio.scene().bodies.iter().map(|body| body.name.as_str());
        let body = studio.view().body;
        let chosen =
            (Command::Stage(StageCommand::Body(body)), studio.scene().bodies[body].name.as_str());
        ui.label(RichText::new("of").color(palette(ui).dim));
        choice(
            ui,
            "body",
            (0..).map(|it| Command::Stage(StageCommand::Body(it))).zip(names),
            chosen,
            commands,
        );
    }
}

/// Offers the coordinates of the displayed body, if there are several.
fn coordinate_choice(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let body = studio.view().body;
    let coordinates = studio.race().truth().bodies()[body].coordinates();
    if coordinates.len() > 1 {
        let command = |index| Command::View(ViewCommand::Coordinate { body, coordinate: index });
        let (chosen, index) = studio.past().coordinate(studio.race(), body);
        ui.label(RichText::new("of").color(palette(ui).dim));
        let offered = (0..).map(command).zip(coordinates.iter().map(|of| of.name));
        choice(ui, "coordinate", offered, (command(index), &*chosen.name), commands);
    }
}

/// Shows a menu of commands by their names.
fn choice<N: AsRef<str>>(
    ui: &mut Ui,
    id: &str,
    offered: impl Iterator<Item = (Command, N)>,
    chosen: (Command, &str),
    commands: &mut Vec<Command>,
) {
    if is_picture(ui) {
        ui.label(chosen.1);
        return;
    }
    let menu = ComboBox::from_id_salt(id).selected_text(chosen.1).width(0.0).show_ui(ui, |ui| {
        let mut height = None;
        for (command, name) in offered {
            // A net has thousands of coordinates, of which only a few are visible.
            let place = Rect::from_min_size(ui.cursor().min, vec2(1.0, height.unwrap_or_default()));
            if height.is_some() && !ui.is_rect_visible(place) {
                ui.allocate_space(place.size());
                continue;
            }
            let label = ui.selectable_label(command == chosen.0, name.as_ref());
            height = Some(label.rect.height());
            if label.clicked() {
                commands.push(command);
            }
        }
    });
    menu.response.on_hover_text(id);
}

/// Returns the legend entries of all visible curves, in the order of [`PlotSet::visible_styles`], and that of the exact
/// solution.
fn legend_entries(set: &PlotSet) -> Vec<Entry> {
    let series = set.visible_styles().map(|(place, SeriesStyle { name, colour, dash, .. })| {
        // In solo mode, a lane has a number only if a digit selects its method.
        let name = match set.styles.is_race {
            true => format!("{} {name}", set.styles.number(place)),
            false => numbered(place, name),
        };
        let is_front = place == set.styles.front;
        Entry { name, colour: *colour, dash: *dash, is_front }
    });
    let SeriesStyles { exact, exact_colour: colour, .. } = &set.styles;
    let has_exact = !exact.is_empty() && set.plots.iter().any(|plot| !plot.exact.is_empty());
    let exact = has_exact.then(|| {
        let (name, dash) = (exact.clone(), [1.0, 0.0]);
        Entry { name, colour: *colour, dash, is_front: false }
    });
    let before = set.plots.iter().find_map(|plot| plot.before.as_ref());
    let before = before.map(|BeforeLine { name, colour, .. }| {
        let (name, dash) = (format!("before: {name}"), [1.0, 0.0]);
        Entry { name, colour: *colour, dash, is_front: false }
    });
    series.chain(exact).chain(before).collect()
}

/// Selects a lane of a race after a click on the lane's legend entry.
fn pick_by_legend(
    set: &PlotSet,
    (entries, shown): (&[Entry], &[Response]),
    commands: &mut Vec<Command>,
) {
    for (Entry { name, .. }, response) in entries.iter().zip(shown) {
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    }
    let clicked = set.visible_styles().zip(shown).filter(|(_, entry)| entry.clicked());
    let picks = clicked.map(|((place, _), _)| Command::Stage(StageCommand::Pick(place)));
    commands.extend(picks.filter(|_| set.styles.is_race));
}
