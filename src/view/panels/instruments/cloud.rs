//! Clouds show the points of each method side by side on the same axes, with the outline of the exact cloud. Below them
//! are the areas of the clouds over time.

use std::sync::Arc;

use egui::epaint::PathShape;
use egui::text::LayoutJob;
use egui::{
    Color32, ColorImage, FontId, Galley, Label, Pos2, Rect, RichText, Sense, Stroke, TextFormat,
    TextureHandle, TextureOptions, Ui, UiBuilder, Vec2, pos2, vec2,
};

use super::super::series_styles::SeriesStyles;
use super::super::tracks::Track;
use super::error::capitalised;
use super::plot_set::{ExactLine, PlotAxis, PlotModel, PlotSet, over_time};
use super::{body_choice, chart, choice};
use crate::chart::{self as charts, AxisScale, LineStyle, PlotArea, Primitive, ScreenCurve};
use crate::look::density_picture;
use crate::look::palette::{Rgba, Theme};
use crate::measure::cloud::{
    CloudChoice, CloudPicture, CloudRequest, CloudShape, Density, LaneCloud, MAX_LINE_PART, POINTS,
    hidden_in_words,
};
use crate::panels::breakpoints;
use crate::run::race::Mode;
use crate::stage::number::{grouped, significant};
use crate::studio::{
    Command, RunCommand, StageCommand, Studio, cloud_refusal, cloud_request, shown_cloud,
};
use crate::theme::{PanelPalette, palette, strong_font};

/// Minimum width of the numbers at the left, gap beside them, height of the numbers below, and height of the names of
/// the axes, in points.
const LEFT: f32 = 32.0;
const BESIDE_NUMBERS: f32 = 8.0;
const NUMBERS: f32 = 17.0;
const NAMES: f32 = 17.0;
/// Minimum distance between two numbers of the velocity, in points.
const UP_APART: f64 = 24.0;
/// Gap between two clouds, in points.
const GAP: f32 = 10.0;
/// Share of the height for the plot of the areas over time, and the plot's minimum height in points.
const AREAS: f32 = 0.3;
const MIN_AREAS: f32 = 110.0;
/// Maximum ratio of a cloud's width to its height.
const MAX_ASPECT: f32 = 1.3;
/// Maximum number of texels on a side of a cloud's image, which is at most two for each cell of the density.
const MAX_TEXELS: usize = 1024;
/// Minimum length of a cloud's shorter side, in points.
const MIN_SIDE: f32 = 30.0;
/// Font size of the words above a cloud, in points, and the minimum size to which it shrinks before a word breaks.
const WORDS: f32 = 12.0;
const MIN_WORDS: f32 = 8.5;
/// Width of the line around the exact cloud, in points.
const OUTLINE: f32 = 1.1;
/// Minimum side of a cloud that has its area below it as a large number, font size of that number, and height for it,
/// in points.
const LARGE: f32 = 230.0;
const AREA: f32 = 26.0;
const AREA_ROOM: f32 = 34.0;
/// Two powers of ten. An area that has grown or shrunk by more than the first does not extend the axis. The axis always
/// shows at least the second on both sides of 1, which is from a half to twice.
const MAX_DECADES: f64 = 3.0;
const MIN_DECADES: f64 = 0.31;
/// Half the width of the mark for points beyond an edge, in points.
const HALF_MARK: f32 = 5.0;
/// Minimum lag of the clouds behind the run that is shown, in seconds.
const BEHIND_S: f64 = 0.25;

/// Returns the plot of the areas of all clouds over time, or `None` if there are no clouds.
pub(super) fn plot_set(studio: &Studio) -> Option<PlotSet> {
    let picture = shown_cloud(studio)?.picture.as_ref().ok()?;
    let body = studio.view().body;
    let scale = AxisScale::Log;
    let place = |[t, area]: [f64; 2]| (t, [t, scale.place(area)]);
    let track = |lane: &LaneCloud| {
        let places = lane.areas.iter().copied().map(place);
        Track::of_places(lane.entry, lane.entry == studio.active(), places)
    };
    let mut tracks: Vec<Track> = picture.lanes.iter().map(track).collect();
    tracks.sort_by_key(|track| track.is_front);
    let exact = ExactLine::of_places(studio, picture.exact.iter().copied().map(place));
    let values = tracks.iter().flat_map(|track| track.along(1)).chain(exact.values(1));
    let near = values.filter(|place| place.abs() <= MAX_DECADES);
    let (low, high) = near.fold((-MIN_DECADES, MIN_DECADES), |(low, high), place| {
        (f64::min(low, place), f64::max(high, place))
    });
    let pad = 0.08 * (high - low);
    let id = format!("area of the cloud of {body}");
    let title = capitalised(&studio.scene().bodies[body].name);
    let axes = [PlotAxis::time("time t"), PlotAxis::new("area / start", "", scale)];
    let plot = PlotModel::new(body, id, title, axes, over_time(studio, (low - pad, high + pad)));
    let plot = PlotModel { tracks, exact: vec![exact], ..plot };
    Some(PlotSet {
        styles: SeriesStyles::of(studio),
        title: "Area of the cloud".into(),
        plots: vec![plot],
    })
}

/// Shows the clouds, and their areas below them if there is room.
pub(super) fn show(ui: &mut Ui, studio: &Studio, room: Vec2, commands: &mut Vec<Command>) {
    let bottom = ui.cursor().top() + room.y;
    head(ui, studio, commands);
    let say = |ui: &mut Ui, words: String| {
        ui.add(Label::new(RichText::new(words).color(palette(ui).dim)).wrap());
    };
    if let Some(why) = cloud_refusal(studio) {
        return say(ui, capitalised(&format!("{why}.")));
    }
    let picture = match shown_cloud(studio).map(|found| &found.picture) {
        None => return say(ui, "Stepping the points …".into()),
        Some(Err(why)) => return say(ui, capitalised(&format!("{why}."))),
        Some(Ok(picture)) => picture,
    };
    let left = (bottom - ui.cursor().top()).max(MIN_SIDE);
    let has_room = left >= breakpoints::AREAS_OVER_TIME && studio.display().measure;
    let for_areas = if has_room { (AREAS * left).max(MIN_AREAS) } else { 0.0 };
    let (clouds, _) = ui.allocate_exact_size(vec2(room.x, left - for_areas), Sense::hover());
    side_by_side(ui, studio, picture, clouds, commands);
    if for_areas > 0.0
        && let Some(set) = plot_set(studio)
    {
        let below = Rect::from_min_max(pos2(clouds.left(), clouds.bottom() + 4.0), clouds.max)
            .with_max_y(bottom);
        let mut ui = ui.new_child(UiBuilder::new().max_rect(below));
        chart::show(&mut ui, studio, &set, commands);
    }
}

/// Shows the title and the menus.
fn head(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) {
    let chosen = studio.display().cloud;
    let shown = shown_cloud(studio);
    let shown = shown.and_then(|found| Some((&*found.request, found.picture.as_ref().ok()?)));
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Cloud").font(strong_font(15.0)).color(palette(ui).text));
        let shape = |shape: CloudShape| {
            (Command::Run(RunCommand::Cloud(CloudChoice { shape, ..chosen })), shape.id())
        };
        let offered = CloudShape::ALL.into_iter().map(shape);
        choice(ui, "shape of the cloud", offered, shape(chosen.shape), commands);
        let counted = |points: usize| format!("{} points", grouped(points as u64));
        let counts = POINTS.map(counted);
        let command = |points| Command::Run(RunCommand::Cloud(CloudChoice { points, ..chosen }));
        let now = counted(chosen.points);
        let offered = POINTS.into_iter().map(command).zip(counts.iter().map(String::as_str));
        choice(ui, "points of the cloud", offered, (command(chosen.points), &now), commands);
        body_choice(ui, studio, commands);
        if let Some((request, picture)) = shown {
            let words = format!("{}; {}", moment(studio, request, picture), legend(picture));
            ui.label(RichText::new(words).color(palette(ui).dim));
        }
    });
}

/// Describes the time of the clouds, and their lag behind the run if it is noticeable.
fn moment(studio: &Studio, request: &CloudRequest, picture: &CloudPicture) -> String {
    let Some(now) = cloud_request(studio) else { return String::new() };
    let mut words = format!("t = {:.2} s", request.t_s(picture));
    let behind = request.behind_s(picture, &now);
    if behind > BEHIND_S {
        words += &format!(", {} s behind", significant(behind, 2));
    }
    words
}

/// Explains the points and the white outline.
fn legend(picture: &CloudPicture) -> String {
    let points = grouped(picture.points as u64);
    let area = picture.exact.last().map(|[_, area]| format!(", area ×{area:.2}"));
    let area = area.unwrap_or_default();
    format!("{points} starts; white: where exact motion takes them{area}")
}

/// Detail of the caption above each cloud. The tooltip has the rest.
#[derive(Clone, Copy, PartialEq)]
enum CaptionDetail {
    Words,
    Numbers,
    /// The beginning of the method's name.
    Name,
}

/// Details of a caption from the longest to the shortest, each with the minimum side of its cloud, in points.
const CAPTION_DETAILS: [(CaptionDetail, f32); 3] =
    [(CaptionDetail::Words, 60.0), (CaptionDetail::Numbers, 40.0), (CaptionDetail::Name, MIN_SIDE)];

/// Captions of the clouds. They are laid out again for each width.
struct Captions<'p> {
    told: CaptionDetail,
    lanes: &'p [LaneCloud],
    /// The method's name and the caption's text for each cloud.
    texts: Vec<[String; 2]>,
    /// Width of the longest word, in points.
    longest: f32,
}

impl<'p> Captions<'p> {
    fn new(ui: &Ui, studio: &Studio, picture: &'p CloudPicture, told: CaptionDetail) -> Self {
        let CloudPicture { lanes, points, .. } = picture;
        let text = |lane: &LaneCloud| {
            let words = match (told, lane.area_ratio) {
                (CaptionDetail::Name, _) => String::new(),
                (CaptionDetail::Numbers, Some(_)) => {
                    format!("\n{}", parts(*points, lane, told).join("\n"))
                }
                _ => format!("\n{}", words(*points, lane)),
            };
            [studio.lane_name(lane.entry), words]
        };
        let texts: Vec<[String; 2]> = lanes.iter().map(text).collect();
        let colour = palette(ui).text;
        let wide = |word: &str| {
            ui.painter().layout_no_wrap(word.into(), strong_font(WORDS), colour).size().x
        };
        let all = texts.iter().flatten().flat_map(|text| text.split([' ', '\n']));
        let longest = all.flat_map(|word| word.split_inclusive('-')).map(wide).fold(0.0, f32::max);
        Self { told, lanes, texts, longest }
    }

    /// Lays out all captions in this width and with one font size. Returns `None` if a word would break.
    fn laid_out(&self, ui: &Ui, studio: &Studio, width: f32) -> Option<Vec<Arc<Galley>>> {
        let longest = self.longest.max(width);
        let size = (WORDS * width / longest).max(MIN_WORDS);
        let is_name = self.told == CaptionDetail::Name;
        if !is_name && longest * MIN_WORDS > width * WORDS {
            return None;
        }
        let palette = palette(ui);
        let caption = |(lane, [name, words]): (&LaneCloud, &[String; 2])| {
            let (colour, _) = palette.style(studio.entries(), &studio.entries()[lane.entry]);
            let is_front = lane.entry == studio.active();
            let font = if is_front { strong_font(size) } else { FontId::proportional(size) };
            let mut job = LayoutJob::default();
            job.wrap.max_width = width;
            if is_name {
                job.wrap.max_rows = 1;
                job.wrap.break_anywhere = true;
            }
            job.append(name, 0.0, TextFormat::simple(font.clone(), colour));
            let colour = if is_front { palette.text } else { palette.dim };
            job.append(words, 0.0, TextFormat::simple(font, colour));
            ui.painter().layout_job(job)
        };
        Some(self.lanes.iter().zip(&self.texts).map(caption).collect())
    }
}

/// Summarizes a cloud.
fn words(points: usize, lane: &LaneCloud) -> String {
    parts(points, lane, CaptionDetail::Words).join(", ")
}

/// Returns the parts of a cloud's summary: its area, its finding in words if requested, the number of points that blew
/// up, and the number of hidden points.
fn parts(points: usize, lane: &LaneCloud, told: CaptionDetail) -> Vec<String> {
    let name = if told == CaptionDetail::Words { "area " } else { "" };
    let area = lane.area_ratio.map(|ratio| format!("{name}×{}", significant(ratio, 3)));
    let words = (told == CaptionDetail::Words).then(|| lane.words.clone());
    let lost = (lane.lost > 0).then(|| format!("{} blew up", grouped(lane.lost as u64)));
    let hidden = hidden_in_words(lane.hidden, points);
    [area, words, lost, hidden].into_iter().flatten().collect()
}

/// Shows the clouds in the number of columns that makes the clouds largest.
fn side_by_side(
    ui: &Ui,
    studio: &Studio,
    picture: &CloudPicture,
    room: Rect,
    commands: &mut Vec<Command>,
) {
    let lanes = &picture.lanes;
    let numbers = AxisScale::Linear.marks(picture.view.v, room.height(), UP_APART);
    let widest = numbers
        .iter()
        .map(|(_, text)| charts::text_width(text, charts::NUMBER))
        .fold(0.0, f32::max);
    let inner = Rect::from_min_max(
        pos2(room.left() + LEFT.max(widest + BESIDE_NUMBERS), room.top()),
        pos2(room.right(), room.bottom() - NUMBERS - NAMES),
    );
    // Large clouds in one row have their areas as numbers below them.
    let is_large =
        inner.width() / lanes.len() as f32 >= LARGE && inner.height() >= LARGE + AREA_ROOM;
    let below = if is_large { AREA_ROOM } else { 0.0 };
    let layout = |columns: usize, captions: &Captions<'_>, least: f32| {
        let rows = lanes.len().div_ceil(columns);
        let gaps = GAP * (columns - 1) as f32;
        let width = (inner.width() - gaps) / columns as f32;
        let captions = captions.laid_out(ui, studio, width)?;
        let above = captions.iter().map(|words| words.size().y).fold(0.0, f32::max) + 5.0;
        let height = inner.height() / rows as f32 - above - below - GAP / 2.0;
        // A single cloud fills the room.
        let most = if lanes.len() == 1 { f32::INFINITY } else { MAX_ASPECT * height };
        let size = vec2(width.min(most), height);
        (size.min_elem() >= least).then_some((columns, size, captions, above))
    };
    let area = |size: Vec2| size.x * size.y;
    let largest = |(told, least): (CaptionDetail, f32)| {
        let captions = Captions::new(ui, studio, picture, told);
        let least_columns = if is_large { lanes.len() } else { 1 };
        let layouts =
            (least_columns..=lanes.len()).filter_map(|columns| layout(columns, &captions, least));
        layouts.max_by(|a, b| area(a.1).total_cmp(&area(b.1)))
    };
    let found = CAPTION_DETAILS.into_iter().find_map(largest);
    let Some((columns, size, captions, above)) = found else { return };
    let rows = lanes.len().div_ceil(columns);
    // The caption of a cloud may be wider than the cloud.
    let wide = captions.iter().map(|words| words.size().x).fold(size.x, f32::max);
    for (place, (lane, words)) in lanes.iter().zip(captions).enumerate() {
        let (column, row) = (place % columns, place / columns);
        let is_lowest = row + 1 == rows || place + columns >= lanes.len();
        let top = inner.top() + row as f32 * (size.y + above + below + GAP / 2.0);
        let corner = pos2(inner.left() + column as f32 * (wide + GAP), top);
        ui.painter().galley(corner, words, palette(ui).text);
        let rect = Rect::from_min_size(corner + vec2(0.0, above), size);
        let has = [column == 0, is_lowest];
        cloud(ui, studio, picture, lane, (rect, below, place), has, commands);
        if let Some(ratio) = lane.area_ratio.filter(|_| is_large) {
            let at = pos2(rect.center().x, rect.bottom() + NUMBERS + AREA_ROOM / 2.0);
            let number = format!("×{}", significant(ratio, 3));
            let colour = palette(ui).text;
            ui.painter().text(at, egui::Align2::CENTER_CENTER, number, strong_font(AREA), colour);
        }
    }
    let coordinate = &studio.race().truth().bodies()[studio.view().body].coordinates().at(0);
    let names = PlotAxis::of_phase(coordinate).map(|axis| axis.name());
    let at = pos2(room.left(), room.bottom());
    let names = format!("across: {}; up: {}", names[0], names[1]);
    let small = FontId::proportional(11.5);
    ui.painter().text(at, egui::Align2::LEFT_BOTTOM, names, small, palette(ui).dim);
}

/// Shows a cloud, with numbers at the left and below it where `has` is set, and with room for its area below the
/// numbers.
fn cloud(
    ui: &Ui,
    studio: &Studio,
    picture: &CloudPicture,
    lane: &LaneCloud,
    (rect, below, place): (Rect, f32, usize),
    has: [bool; 2],
    commands: &mut Vec<Command>,
) {
    let palette = palette(ui);
    let px_per_point = ui.pixels_per_point();
    // The rectangle lies on whole pixels, so that each texel is one pixel.
    let whole = |at: f32| (at * px_per_point).round() / px_per_point;
    let rect = Rect::from_min_max(
        pos2(whole(rect.left()), whole(rect.top())),
        pos2(whole(rect.right()), whole(rect.bottom())),
    );
    let pixels = |side: f32| {
        let pixels = ((side * px_per_point).round() as usize).max(1);
        pixels.div_ceil(pixels.div_ceil(MAX_TEXELS))
    };
    let size_px = [pixels(rect.width()), pixels(rect.height())];
    let (colour, _) = palette.theme.lane_style(studio.entries(), &studio.entries()[lane.entry]);
    let texture = cached_image(ui, place, &lane.density, (size_px, palette.theme, colour));
    let all = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    let view = picture.view;
    let area = PlotArea { rect, bounds: [view.q, view.v] };
    // A number that extends far beyond its cloud would overlap a number of the next cloud.
    let fits = |at: f64, text: &str| {
        let off_centre = (area.at([at, view.v[0]]).x - rect.center().x).abs();
        off_centre + charts::text_width(text, charts::NUMBER) / 2.0 <= (rect.width() + GAP) / 2.0
    };
    let marks = |axis: usize, apart: f64| {
        let mut marks = area.marks(axis, AxisScale::Linear, apart);
        let is_shown = |at: f64, text: &str| has[1 - axis] && (axis == 1 || fits(at, text));
        marks
            .iter_mut()
            .filter(|(at, text)| !is_shown(*at, text))
            .for_each(|(_, text)| text.clear());
        marks
    };
    let axes = charts::axes(&area, [marks(0, 56.0), marks(1, UP_APART)], palette, f32::INFINITY);
    charts::paint(ui.painter(), &axes);
    ui.painter().image(texture.id(), rect, all, Color32::WHITE);
    let mut over =
        vec![Primitive::Clip(rect, vec![Primitive::Curves(outline(picture, rect, palette))])];
    mark_beyond(ui, lane.beyond, rect);
    // The tooltip also appears over the numbers below the cloud.
    let whole = rect.with_max_y(rect.bottom() + NUMBERS + below);
    let response = ui.interact(whole, ui.scope_id().with(("cloud", place)), Sense::click());
    if studio.mode() == Mode::Race && lane.entry == studio.active() {
        let rim = Stroke::new(1.6, Color32::from_rgb(colour[0], colour[1], colour[2]));
        over.push(Primitive::Edge(rect, rim));
    }
    charts::paint(ui.painter(), &over);
    let about =
        format!("cloud of {}: {}", studio.lane_name(lane.entry), words(picture.points, lane));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &about));
    let told = format!("{about} ({})", lane.measured);
    if response.on_hover_text(told).clicked() && studio.mode() == Mode::Race {
        commands.push(Command::Stage(StageCommand::Pick(lane.entry)));
    }
}

/// Marks each side of a cloud that has points beyond it, with their number.
fn mark_beyond(ui: &Ui, beyond: [usize; 4], rect: Rect) {
    let (palette, painter) = (palette(ui), ui.painter());
    let sides = [
        (rect.left_center(), vec2(1.0, 0.0)),
        (rect.right_center(), vec2(-1.0, 0.0)),
        (rect.center_bottom(), vec2(0.0, -1.0)),
        (rect.center_top(), vec2(0.0, 1.0)),
    ];
    for ((edge, inward), points) in sides.into_iter().zip(beyond).filter(|(_, points)| *points > 0)
    {
        let side = inward.rot90() * HALF_MARK;
        let tip = edge + inward * 2.0;
        let base = tip + inward * HALF_MARK;
        let corners = vec![tip, base + side, base - side];
        painter.add(PathShape::convex_polygon(corners, palette.text, Stroke::NONE));
        let text = grouped(points as u64);
        let text = painter.layout_no_wrap(text, FontId::proportional(11.0), palette.text);
        let room = text.size() / 2.0;
        let middle = base + vec2(inward.x * (room.x + 3.0), inward.y * room.y);
        let plate = Rect::from_center_size(middle, text.size()).expand(1.0);
        painter.rect_filled(plate, 2.0, palette.plot.gamma_multiply(0.8));
        painter.galley(middle - room, text, palette.text);
    }
}

/// Returns the border of the exact cloud.
fn outline(picture: &CloudPicture, rect: Rect, palette: &PanelPalette) -> Vec<ScreenCurve> {
    let area = PlotArea { rect, bounds: [[0.0, 1.0]; 2] };
    let style = LineStyle::solid(palette.exact, OUTLINE);
    // The border is not drawn between points that are far apart. An angle continues at the other side there, or the
    // border is unknown.
    let longest = MAX_LINE_PART as f32 * rect.size().max_elem();
    let goes_on = |a: &Pos2, b: &Pos2| a.distance(*b) <= longest;
    let mut curves = Vec::new();
    for line in &picture.border {
        let points = line.iter().map(|&[q, v]| area.at(picture.view.place(q, v)));
        let points: Vec<Pos2> = points.filter(|at| at.is_finite()).collect();
        let pieces = points.chunk_by(goes_on);
        curves.extend(pieces.map(|piece| ScreenCurve::new(style, piece.to_vec())));
    }
    curves
}

/// Size in pixels, theme and colour of an image.
type Style = ([usize; 2], Theme, Rgba);

/// A cached image, with the density that it shows.
#[derive(Clone)]
struct CachedImage {
    of: Arc<Density>,
    style: Style,
    texture: TextureHandle,
}

/// Frees all images.
pub(super) fn free_images(ui: &Ui) {
    ui.data_mut(|data| data.remove_by_type::<CachedImage>());
}

/// Returns the image of a density. The cached image is replaced if the density or its style has changed.
fn cached_image(ui: &Ui, place: usize, density: &Arc<Density>, style: Style) -> TextureHandle {
    let id = egui::Id::unique(("image of a cloud", place));
    let made = ui.data(|data| data.get_temp::<CachedImage>(id));
    let old = match made {
        Some(made) if Arc::ptr_eq(&made.of, density) && made.style == style => return made.texture,
        made => made,
    };
    let (size, theme, colour) = style;
    let rgba = density_picture(density, size, theme, colour).concat();
    let image = ColorImage::from_rgba_unmultiplied(size, &rgba);
    let texture = match old {
        Some(mut old) if old.style.0 == size => {
            old.texture.set_partial([0, 0], image, TextureOptions::NEAREST);
            old.texture
        }
        _ => ui.ctx().load_texture("cloud", image, TextureOptions::NEAREST),
    };
    let made = CachedImage { of: Arc::clone(density), style, texture: texture.clone() };
    ui.data_mut(|data| data.insert_temp(id, made));
    texture
}
