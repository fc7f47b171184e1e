//! Lays out the stage and draws every body of every lane, with its ghost, its trail and its captions.

use super::bands::{self, Band, Card};
use super::body_cell::BodyCell;
use super::framed::{on_one_stage, quay_width};
use super::ghost::Ghost;
use super::lane::RaceLane;
use super::layout::{bands, grid, mosaic};
use super::moment::DrawContext;
use super::sketch::Camera;
use super::{Picture, Rect, breakpoints, captions, chart, loop_stage, scale_marks};
use crate::look::Framing;
use crate::look::palette::{Rgba, fade};
use crate::run::race::Mode;
use crate::studio::{Arrangement, Studio};

/// Height (points) of the head of a cell with a lane's name and a possible halt.
const CAPTION: f32 = 32.0;

/// The picture of the studio on a stage of `size` points.
pub fn compose(studio: &Studio, size: [f32; 2]) -> Picture {
    let mut picture = Picture::default();
    let stage = Rect { min: [0.0; 2], max: size };
    chart::sea(&mut picture, stage, studio.display().theme.palette());
    let corner = match studio.loop_lab() {
        Some(loops) => loop_stage::draw(&mut picture, studio, loops, stage),
        None => of_run(&mut picture, studio, stage),
    };
    captions::pause(&mut picture, studio, stage, corner);
    picture
}

/// Draws the lanes of the run. Returns the lower right corner of the last body's cell.
fn of_run(picture: &mut Picture, studio: &Studio, stage: Rect) -> [f32; 2] {
    let moment = &DrawContext::of(studio);
    let bodies = studio.scene().bodies.len();
    let ghosts: Vec<Ghost> = (0..bodies).map(|index| Ghost::new(moment, index)).collect();
    let lanes = studio.race().entrants().iter().map(|entrant| RaceLane { moment, entrant });
    let lanes: Vec<RaceLane<'_>> = lanes.collect();
    match (studio.mode(), studio.display().arrangement) {
        _ if !moment.bands.is_empty() => return in_bands(picture, moment, stage, &ghosts[0]),
        (Mode::Solo, _) | (Mode::Race, Arrangement::Overlay) => {
            overlay(picture, moment, stage, &ghosts, &lanes);
        }
        (Mode::Race, Arrangement::SideBySide) => {
            side_by_side(picture, moment, stage, &ghosts, &lanes);
        }
    }
    stage.max
}

/// Draws all lanes of a body on one band of the stage, the selected one in front.
fn overlay(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    stage: Rect,
    ghosts: &[Ghost],
    lanes: &[RaceLane<'_>],
) {
    let front = RaceLane { moment, entrant: moment.studio.selected() };
    let views = on_one_stage(ghosts.iter().map(|ghost| ghost.view).collect(), front);
    // A ship on a straight course has its own marks.
    let has_ruler = stage.max[1] - stage.min[1] >= breakpoints::RULER
        && (!matches!(views[0].framing, Framing::Follow { .. }) || views[0].turns);
    let (strip, room) = chart::under_ruler(stage, has_ruler);
    let heights = views.iter().map(|view| match view.framing {
        Framing::Follow { .. } if !view.turns => 0.8,
        Framing::Follow { .. } | Framing::Recorder { .. } | Framing::Fixed { .. } => 1.0,
    });
    let mut cells = bands(room, &heights.collect::<Vec<f32>>());
    if let Some(moored) = views.iter().position(|view| view.recorded_m().is_some()) {
        let camera = moment.camera(cells[moored], moored, &views[moored]);
        chart::quay(picture, &Camera { rect: room, ..camera }, moment.palette);
        let afloat = cells.iter_mut().zip(&views).filter(|(_, view)| view.recorded_m().is_none());
        afloat.for_each(|(cell, _)| cell.min[0] += quay_width(room));
    }
    for (index, ((ghost, view), cell)) in ghosts.iter().zip(&views).zip(&cells).enumerate() {
        let camera = moment.camera(*cell, index, view);
        BodyCell { moment, index, ghost, view, camera, lanes, front }.draw(picture);
        captions::name(picture, *cell, moment, index);
        if moment.studio.mode() == Mode::Solo {
            captions::head(picture, *cell, front, index);
            captions::speed(picture, &camera, front, index);
        } else {
            captions::verdicts(picture, *cell, index, (lanes, front));
        }
        let is_measured = match view.framing {
            Framing::Follow { .. } => !view.turns,
            Framing::Recorder { .. } => view.recorded_m() == views[0].recorded_m(),
            Framing::Fixed { .. } => index == 0,
        };
        if !(is_measured
            && (has_ruler
                || !matches!(view.framing, Framing::Recorder { .. } | Framing::Fixed { .. })))
        {
            scale_marks::scale_bar(picture, &camera, moment.palette);
        }
    }
    if let Some(strip) = strip {
        let camera = moment.camera(cells[0], 0, &views[0]);
        chart::ruler(picture, strip, &camera, moment.palette);
    }
}

/// Draws a body of one lane in a cell. Returns its camera.
fn draw_alone(
    picture: &mut Picture,
    cell: Rect,
    (ghosts, index): (&[Ghost], usize),
    lane: &RaceLane<'_>,
) -> Camera {
    let (moment, ghost, lanes) = (lane.moment, &ghosts[index], std::slice::from_ref(lane));
    let view = &on_one_stage(ghosts.iter().map(|ghost| ghost.view).collect(), *lane)[index];
    let camera = moment.camera(cell, index, view);
    if view.recorded_m().is_some() {
        chart::quay(picture, &camera, moment.palette);
    }
    BodyCell { moment, index, ghost, view, camera, lanes, front: *lane }.draw(picture);
    camera
}

/// Draws some lanes in bands, one below the other, each with its own scale and its code. Returns the lower right corner
/// of the last body's cell.
fn in_bands(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    stage: Rect,
    ghost: &Ghost,
) -> [f32; 2] {
    let entrants = moment.bands.iter().filter_map(|&entry| moment.studio.deck.lane_of(entry));
    let lanes: Vec<_> = entrants.map(|entrant| RaceLane { moment, entrant }).collect();
    let (mut cards, mut corner) = (Vec::new(), stage.max);
    for (lane, band) in lanes.iter().zip(bands(stage, &vec![1.0; lanes.len()])) {
        let Band { ruler, cell, card } = Band::of(band);
        corner = cell.max;
        let camera = draw_alone(picture, cell, (std::slice::from_ref(ghost), 0), lane);
        bands::head(picture, cell, *lane, ghost.swing_m);
        match ruler {
            Some(strip) => chart::ruler(picture, strip, &camera, moment.palette),
            None => scale_marks::scale_bar(picture, &camera, moment.palette),
        }
        if let Some(room) = card {
            cards.extend(Card::of(*lane, room));
        }
    }
    bands::draw(picture, moment.palette, stage, &cards);
    corner
}

/// Draws each lane in its own cells.
fn side_by_side(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    stage: Rect,
    ghosts: &[Ghost],
    lanes: &[RaceLane<'_>],
) {
    let bodies = ghosts.len();
    let draw = |picture: &mut Picture, cell: Rect, index: usize, lane: &RaceLane<'_>| {
        let camera = draw_alone(picture, cell, (ghosts, index), lane);
        frame(picture, cell, fade(moment.palette.chart, 0.3));
        let shared = moment.camera(cell, index, &ghosts[index].view).points_per_metre;
        if lane.id() == lanes[lanes.len() - 1].id() || camera.points_per_metre != shared {
            scale_marks::scale_bar(picture, &camera, moment.palette);
        }
    };
    if let Some(shape) = moment.shape(&ghosts[0].view) {
        let cells = mosaic(stage, lanes.len(), shape);
        for (lane, cell) in lanes.iter().zip(cells) {
            draw(picture, cell, 0, lane);
            let bottom = (cell.min[1] + CAPTION).min(cell.max[1]);
            let head = Rect { min: cell.min, max: [cell.max[0], bottom] };
            captions::lane(picture, head, *lane);
        }
        return;
    }
    let gutter = captions::lanes_width(lanes, stage.sides()[0]);
    let right = Rect { min: [stage.min[0] + gutter, stage.min[1]], ..stage };
    let cells = grid(right, lanes.len(), bodies);
    for (lane, row) in lanes.iter().zip(cells.chunks(bodies)) {
        for (index, cell) in row.iter().enumerate() {
            draw(picture, *cell, index, lane);
        }
        let name = Rect { min: [0.0, row[0].min[1]], max: [gutter, row[0].max[1]] };
        captions::lane(picture, name, *lane);
    }
    for (index, cell) in cells.iter().take(bodies).enumerate() {
        captions::name(picture, *cell, moment, index);
    }
}

/// Draws a thin line around a cell.
fn frame(picture: &mut Picture, Rect { min, max }: Rect, colour: Rgba) {
    let corners = [min, [max[0], min[1]], max, [min[0], max[1]], min];
    let everywhere = Rect { min: [min[0] - 1.0, min[1] - 1.0], max: [max[0] + 1.0, max[1] + 1.0] };
    picture.pen(everywhere).path(corners, 1.0, colour);
}
