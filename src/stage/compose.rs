//! Lays out the stage and draws every body of every lane, with its ghost, its trail and its captions.

use super::bands::{self, Band, Card};
use super::body_cell::BodyCell;
use super::framed::{on_one_stage, quay_width};
use super::ghost::Ghost;
use super::layout::{bands, grid, mosaic};
use super::moment::DrawContext;
use super::sketch::Camera;
use super::{Picture, Rect, breakpoints, captions, chart, loop_stage, scale_marks, universe};
use crate::look::Framing;
use crate::look::palette::{Rgba, fade};
use crate::run::race::{Entrant, Mode};
use crate::studio::{Arrangement, Studio};

/// Height (points) of the head of a cell with a lane's name and a possible halt.
const CAPTION: f32 = 32.0;

/// The picture of the studio on a stage of `size` points.
pub fn compose(studio: &Studio, size: [f32; 2]) -> Picture {
    if let Some(loops) = studio.loop_lab() {
        return loop_stage::compose(studio, loops, size);
    }
    let moment = DrawContext::of(studio);
    let mut picture = Picture::default();
    let stage = Rect { min: [0.0; 2], max: size };
    chart::sea(&mut picture, stage, moment.palette);
    let bodies = studio.scene().bodies.len();
    let ghosts: Vec<Ghost> = (0..bodies).map(|index| Ghost::new(&moment, index)).collect();
    let entrants: Vec<&Entrant> = studio.race().entrants().iter().collect();
    let mut corner = stage.max;
    match (studio.mode(), studio.display().arrangement) {
        _ if !moment.bands.is_empty() => {
            corner = in_bands(&mut picture, &moment, stage, &ghosts[0]);
        }
        (Mode::Solo, _) | (Mode::Race, Arrangement::Overlay) => {
            overlay(&mut picture, &moment, stage, &ghosts, &entrants);
        }
        (Mode::Race, Arrangement::SideBySide) => {
            side_by_side(&mut picture, &moment, stage, &ghosts, &entrants);
        }
    }
    captions::pause(&mut picture, studio, stage, corner);
    picture
}

/// Draws all lanes of a body on one band of the stage, the selected one in front.
fn overlay(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    stage: Rect,
    ghosts: &[Ghost],
    entrants: &[&Entrant],
) {
    let front = moment.studio.selected();
    let views = on_one_stage(moment, ghosts.iter().map(|ghost| ghost.view).collect(), front);
    // A ship on a straight course has its own marks.
    let has_ruler = stage.max[1] - stage.min[1] >= breakpoints::RULER
        && (!matches!(views[0].framing, Framing::Follow { .. }) || views[0].turns);
    let top = stage.min[1] + if has_ruler { chart::RULER } else { 0.0 };
    let room = Rect { min: [stage.min[0], top], ..stage };
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
        let mut of_body = BodyCell { moment, index, ghost, view, camera, lanes: entrants, front };
        if of_body.has_outgrown() {
            of_body.camera = universe::with_short_paper(&camera);
        }
        of_body.draw(picture);
        captions::name(picture, *cell, moment, index);
        if moment.studio.mode() == Mode::Solo {
            captions::head(picture, *cell, moment, index, front);
            captions::speed(picture, &camera, moment, index, front);
        } else {
            captions::verdicts(picture, *cell, moment, index, (entrants, front));
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
    if has_ruler {
        let strip = Rect { min: stage.min, max: [stage.max[0], top] };
        let camera = moment.camera(cells[0], 0, &views[0]);
        chart::ruler(picture, strip, &camera, moment.palette);
    }
}

/// Draws some lanes in bands, one below the other, each with its own scale and its code. Returns the lower right corner
/// of the last body's cell.
fn in_bands(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    stage: Rect,
    ghost: &Ghost,
) -> [f32; 2] {
    let lanes = moment.bands.iter().filter_map(|&entry| moment.studio.deck.lane_of(entry));
    let lanes: Vec<&Entrant> = lanes.collect();
    let (mut cards, mut corner) = (Vec::new(), stage.max);
    for (entrant, band) in lanes.iter().zip(bands(stage, &vec![1.0; lanes.len()])) {
        let Band { ruler, cell, card } = Band::of(band);
        corner = cell.max;
        let view = &on_one_stage(moment, vec![ghost.view], entrant)[0];
        let camera = moment.camera(cell, 0, view);
        if view.recorded_m().is_some() {
            chart::quay(picture, &camera, moment.palette);
        }
        let lanes = std::slice::from_ref(entrant);
        let mut body = BodyCell { moment, index: 0, ghost, view, camera, lanes, front: entrant };
        if body.has_outgrown() {
            body.camera = universe::with_short_paper(&camera);
        }
        body.draw(picture);
        bands::head(picture, cell, moment, entrant, ghost.swing_m);
        match ruler {
            Some(strip) => chart::ruler(picture, strip, &camera, moment.palette),
            None => scale_marks::scale_bar(picture, &camera, moment.palette),
        }
        if let Some(room) = card {
            cards.extend(Card::of(moment, entrant, room));
        }
    }
    bands::draw(picture, moment, stage, &cards);
    corner
}

/// Draws each lane in its own cells.
fn side_by_side(
    picture: &mut Picture,
    moment: &DrawContext<'_>,
    stage: Rect,
    ghosts: &[Ghost],
    entrants: &[&Entrant],
) {
    let bodies = ghosts.len();
    let draw = |picture: &mut Picture, cell: Rect, index: usize, entrant: &&Entrant| {
        let ghost = &ghosts[index];
        let views = ghosts.iter().map(|ghost| ghost.view).collect();
        let view = &on_one_stage(moment, views, entrant)[index];
        let camera = moment.camera(cell, index, view);
        let lanes = std::slice::from_ref(entrant);
        if view.recorded_m().is_some() {
            chart::quay(picture, &camera, moment.palette);
        }
        BodyCell { moment, index, ghost, view, camera, lanes, front: entrant }.draw(picture);
        frame(picture, cell, fade(moment.palette.chart, 0.3));
        let shared = moment.camera(cell, index, &ghost.view).points_per_metre;
        if entrant.id == entrants[entrants.len() - 1].id || camera.points_per_metre != shared {
            scale_marks::scale_bar(picture, &camera, moment.palette);
        }
    };
    if let Some(shape) = moment.shape(&ghosts[0].view) {
        let cells = mosaic(stage, entrants.len(), shape);
        for (entrant, cell) in entrants.iter().zip(cells) {
            draw(picture, cell, 0, entrant);
            let bottom = (cell.min[1] + CAPTION).min(cell.max[1]);
            let head = Rect { min: cell.min, max: [cell.max[0], bottom] };
            captions::lane(picture, head, moment, entrant);
        }
        return;
    }
    let gutter = captions::lanes_width(moment.studio, entrants, stage.max[0] - stage.min[0]);
    let right = Rect { min: [stage.min[0] + gutter, stage.min[1]], ..stage };
    let cells = grid(right, entrants.len(), bodies);
    for (entrant, row) in entrants.iter().zip(cells.chunks(bodies)) {
        for (index, cell) in row.iter().enumerate() {
            draw(picture, *cell, index, entrant);
        }
        let name = Rect { min: [0.0, row[0].min[1]], max: [gutter, row[0].max[1]] };
        captions::lane(picture, name, moment, entrant);
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
