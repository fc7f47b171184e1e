//! Lays out the stage and draws every body of every lane, with its ghost, its trail and its captions.

use glam::DVec2;

use super::bands::{self, Band, Card};
use super::body::OutlineView;
use super::flags::{Flag, Lost, badges, clear_number, flags};
use super::framed::{BodyView, on_one_stage, quay_width};
use super::ghost::Ghost;
use super::layout::{bands, grid, mosaic};
use super::moment::DrawContext;
use super::sketch::{Camera, LaneStyle, SOLID};
use super::{
    Cell, Picture, Rect, Whose, apex, breakpoints, captions, chart, futures, hull, loop_stage,
    scale_marks, universe,
};
use crate::look::palette::{Rgba, fade};
use crate::look::{Framing, Look};
use crate::run::race::{Entrant, Mode};
use crate::scene::{Mark, Outline};
use crate::studio::{Arrangement, Studio, ZoomPan};
use crate::studio::{DIGITS, future_of_lane, futures, shown_state, shows_futures, without_futures};

/// Most lanes for which each body shows its lane's number.
const MAX_NUMBERED: usize = 9;

/// Height (points) of the head of a cell with a lane's name and a possible halt.
const CAPTION: f32 = 32.0;
/// Highest start of badges, in points below the top of a cell.
const BADGES: f32 = 30.0;
/// Opacity of a held body at the place from which it was taken.
const LEFT_BEHIND: f32 = 0.35;
/// Widths of trails in points.
const TRAIL_IN_FRONT: f32 = 2.4;
const TRAIL_BEHIND: f32 = 1.3;
const TRAIL_OF_TRUTH: f32 = 1.5;
/// Opacity of the fill of a lane behind, when there are few.
const FILL: f32 = 0.2;
/// Opacity of a body in a lane behind.
const BODY_BEHIND: f32 = 0.9;
/// Opacity of the trail of a lane behind.
const FAINT: f32 = 0.45;
/// Largest deviation of a drawn trail from the true one, in points: less than anybody sees.
const TOLERANCE: f64 = 0.15;

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

/// One body of the scene in one cell: its ghost, and the bodies of some lanes.
struct BodyCell<'a> {
    moment: &'a DrawContext<'a>,
    index: usize,
    ghost: &'a Ghost,
    /// The view of the camera, shared with the other bodies on the same stage.
    view: &'a BodyView,
    camera: Camera,
    lanes: &'a [&'a Entrant],
    front: &'a Entrant,
}

impl BodyCell<'_> {
    fn draw(&self, picture: &mut Picture) {
        let Self { moment, index, ghost, view, ref camera, .. } = *self;
        let (studio, framing, palette) = (moment.studio, view.framing, moment.palette);
        let truth = &studio.race().truth().bodies()[index];
        let shows_ghost = studio.display().ghost && truth.halted().is_none();
        self.ground(picture, shows_ghost);
        let has_outgrown = self.has_outgrown();
        if has_outgrown {
            universe::landmarks(picture, (camera, self.room()), moment, (index, self.front));
        }
        let mut ends = Vec::new();
        let has_selected = self.lanes.iter().any(|lane| lane.id == studio.selected().id);
        if self.shows_futures() && (has_selected || self.is_banded()) {
            let futures = match self.is_banded() {
                true => future_of_lane(&studio.deck, self.front, index),
                false => futures(&studio.deck, index),
            };
            ends = futures::draw(picture, moment, (camera, self.room()), framing, futures);
            if without_futures(&studio.deck, index).is_none() {
                captions::futures(picture, camera.rect, studio, palette);
            }
        }

        let behind = self.lanes.iter().filter(|lane| !self.is_front(lane));
        let mut flagged: Vec<Flag> = Vec::new();
        let mut numbered = None;
        let mut rivals: Vec<(Outline, LaneStyle)> = Vec::new();
        let mut lost: Vec<Lost> = Vec::new();
        let mut cell = Cell {
            rect: camera.rect,
            lane: self.front.id,
            entry: studio.entry(self.front),
            body: index,
            zoomed_as: view.zoomed_as,
            seen: Vec::new(),
            camera: *camera,
        };
        for lane in behind.chain([&self.front]) {
            let body = &lane.lane.bodies()[index];
            let (look, coordinates) = (Look::of(body), shown_state(studio, body).0);
            let outline = look.outline(moment.t, &coordinates);
            let entry = studio.entry(lane);
            let (colour, dash) = moment.style(entry);
            let at = camera.points(outline.at);
            let flag = Flag { at, number: entry + 1, colour };
            let is_front = self.is_front(lane);
            let colour_of_body = fade(colour, if is_front { 1.0 } else { BODY_BEHIND });
            let style = LaneStyle { colour: colour_of_body, dash, fill: self.fill() };
            let seen = OutlineView { outline: &outline, camera, palette };
            let whose = Whose::Lane { lane: lane.id, entry };
            cell.seen.push((whose, coordinates));
            let held = studio.deck.held().filter(|held| held.body == index);
            let away = self.trail(picture, lane, outline.at, flag).filter(|_| held.is_none());
            lost.extend(away);
            if held.is_none() && !self.room().contains(at) {
                if is_front {
                    seen.draw_fixed_parts(picture);
                    self.draw_ghost(picture, shows_ghost);
                }
                continue;
            }
            if !is_front {
                seen.draw_behind(picture, style);
                flagged.push(flag);
                if self.lanes.len() <= MAX_NUMBERED && outline.threads.is_empty() {
                    rivals.push((outline, LaneStyle { fill: 0.0, ..style }));
                }
                continue;
            }
            let in_hand = held.map(|held| look.outline(moment.t, &held.q));
            let shown = OutlineView { outline: in_hand.as_ref().unwrap_or(&outline), ..seen };
            if held.is_some() {
                let left = LaneStyle { colour: fade(colour, LEFT_BEHIND), dash, fill: self.fill() };
                seen.draw_behind(picture, left);
            }
            shown.draw_below_exact(picture, style);
            self.draw_ghost(picture, shows_ghost);
            shown.draw_front(picture, style);
            // The body in front would hide those behind.
            for (outline, style) in rivals.drain(..) {
                OutlineView { outline: &outline, ..shown }.draw_behind(picture, style);
            }
            let pulled = studio.deck.pulled().filter(|pulled| pulled.body == index);
            if let Some(pulled) = pulled.filter(|pulled| pulled.lane == lane.id) {
                let handles = look.handles(&shown_state(studio, body).0);
                let ends = handles.get(pulled.handle).map(|handle| [handle.at, pulled.hand]);
                for [handle, hand] in ends.into_iter().map(|ends| ends.map(|at| camera.points(at)))
                {
                    picture.pen(camera.rect).dashed([handle, hand], 2.0, palette.text, [6.0, 4.0]);
                }
            }
            if let Some(held) = held.filter(|held| held.lane == lane.id) {
                let [handle, hand] = [held.handle, held.hand].map(|at| camera.points(at));
                picture.pen(camera.rect).line(handle, hand, 1.0, palette.text);
            }
            // With many lanes, flags overlap the bodies.
            if self.lanes.len() <= MAX_NUMBERED {
                // In solo mode, a body has a number only if a key picks its method.
                if studio.mode() == Mode::Race || entry < DIGITS {
                    let before = studio.deck.switched_from(lane).filter(|it| *it < DIGITS);
                    let before = before.map_or(String::new(), |it| format!("{} → ", it + 1));
                    shown.number(picture, format!("{before}{}", entry + 1), colour);
                }
                numbered = Some(at);
            }
        }
        if shows_ghost {
            cell.seen.push((Whose::Truth, ghost.q.clone()));
        }
        let lift = match framing {
            Framing::Recorder { .. } => 0.72 * camera.block,
            Framing::Follow { .. } | Framing::Fixed { .. } => 22.0,
        };
        // Below the row of a chart recorder's bodies, badges cover none of them.
        let below = match framing {
            Framing::Recorder { .. } => camera.at[1] - camera.rect.min[1] + 0.6 * camera.block,
            Framing::Follow { .. } | Framing::Fixed { .. } => BADGES,
        };
        let mut room = badges(picture, camera, &lost, [below, BADGES], palette);
        if self.lanes.len() > 1 {
            room.min[1] = room.min[1].max(captions::foot_of_verdicts(camera.rect));
        }
        let name = captions::name_room(camera.rect, moment, index);
        if let Some(front) = numbered {
            clear_number(&mut flagged, front, lift);
        }
        futures::label_ends(picture, moment, ends, self.room());
        flags(picture, &flagged, lift, palette, (room, camera.rect, name));
        if Look::of(truth).has_ground() && truth.halted().is_none() {
            apex::draw(picture, camera, (moment, !lost.is_empty()), self.front, index);
            let lanes = (self.lanes, self.front);
            apex::strip(picture, camera, (moment, framing), lanes, index);
        }
        if shows_ghost && self.is_wide() && index == 0 {
            let bead = ghost.outline.marks.iter().find_map(|mark| match mark {
                Mark::Disc { radius, .. } => Some(camera.size(*radius)),
                _ => None,
            });
            let is_recorded = matches!(framing, Framing::Recorder { .. });
            let beside = bead.filter(|_| is_recorded).unwrap_or(lift);
            let beside = hull::half_height(&ghost.outline, camera).max(beside);
            let exact = ("exact", palette.exact);
            captions::ghost_name(picture, camera, (ghost.outline.at, beside), exact, palette);
        }
        self.draw_compared(picture, lift);
        let is_alone = self.lanes.len() == 1;
        let says_beside =
            is_alone && (studio.mode() == Mode::Solo || self.front.lane.bodies().len() == 1);
        let halted = self.lanes.iter().filter(|_| !says_beside).filter_map(|lane| {
            let halt = lane.lane.bodies()[index].halted()?;
            Some(((!is_alone).then(|| studio.entry(lane) + 1), halt))
        });
        captions::halts(picture, camera.rect, halted, truth, palette);
        if has_outgrown {
            let of_lane = (index, self.front);
            let swing_m = ghost.swing_m.unwrap_or(ghost.view.reach_m.x);
            let on = (camera, self.room());
            universe::write_distance(picture, on, moment, (view, swing_m), of_lane);
        }
        picture.cells.push(cell);
    }

    /// Opacity of the fill of a lane behind. It is lower with more lanes, since they may overlap.
    fn fill(&self) -> f32 {
        const FEW: f32 = 4.0;
        FILL * (FEW / self.lanes.len() as f32).min(1.0)
    }

    /// The part of the cell in which a body is visible: all except the quay.
    fn room(&self) -> Rect {
        let mut room = self.camera.rect;
        if let Framing::Recorder { .. } = self.view.framing {
            let quay = self.camera.points(DVec2::new(self.camera.quay_m, 0.0))[0];
            room.min[0] = room.min[0].max(quay);
        }
        room
    }

    fn is_front(&self, lane: &Entrant) -> bool {
        lane.id == self.front.id
    }

    /// Whether each lane has a band of its own.
    fn is_banded(&self) -> bool {
        !self.moment.bands.is_empty()
    }

    /// Whether the stage of the cell is as wide as that of a lane alone: in solo mode, and in a band.
    fn is_wide(&self) -> bool {
        self.moment.studio.mode() == Mode::Solo || self.is_banded()
    }

    /// Whether the body has outgrown the stage, so that landmarks show its scale.
    fn has_outgrown(&self) -> bool {
        self.is_wide()
            && self.view.zoomed_as == self.index
            && !self.shows_futures()
            && universe::is_shown(self.moment, self.view, &self.camera)
    }

    /// Whether the cell shows the body's futures instead of its trail.
    fn shows_futures(&self) -> bool {
        let is_afloat = matches!(self.view.framing, Framing::Follow { .. });
        shows_futures(self.moment.studio) && !is_afloat
    }

    /// Draws everything below the bodies: the mooring, a course, the exact trail, and the range of the exact swing.
    fn ground(&self, picture: &mut Picture, shows_ghost: bool) {
        let Self { moment, index, ghost, view, ref camera, .. } = *self;
        let framing = view.framing;
        match framing {
            Framing::Follow { .. } if !view.turns => {
                let hull_m = ghost.outline.marks.iter().find_map(|mark| match mark {
                    Mark::Hull { length, .. } => Some(*length),
                    _ => None,
                });
                let beam = hull::BEAM * camera.length(hull_m.unwrap_or_default());
                scale_marks::course(picture, camera, beam, moment.palette);
            }
            Framing::Recorder { .. } => {
                chart::mooring(picture, camera, moment.palette);
                if let Some(swing_m) = ghost.swing_m {
                    let bottom = match self.has_outgrown() {
                        true => camera.at[1] + camera.paper as f32,
                        false => camera.rect.max[1] - 4.0,
                    };
                    let ends = [captions::foot_of_head(camera.rect), bottom];
                    envelope(picture, camera, (swing_m, ends), fade(moment.palette.exact, 0.6));
                }
            }
            Framing::Follow { .. } | Framing::Fixed { .. } => {}
        }
        let is_past_shown = shows_ghost && !self.shows_futures();
        if let Some(trail_s) = trail_s(framing, moment).filter(|_| is_past_shown) {
            let tolerance_m = TOLERANCE / camera.points_per_metre;
            let past = ghost.past(moment, index, trail_s, tolerance_m);
            moment.trail(picture, camera, framing, &past, TRAIL_OF_TRUTH);
        }
    }

    fn draw_ghost(&self, picture: &mut Picture, shows_ghost: bool) {
        if shows_ghost {
            let outline = &self.ghost.outline;
            let seen = OutlineView { outline, camera: &self.camera, palette: self.moment.palette };
            seen.ghost(picture);
        }
    }

    /// Draws the body of a compared recording, hollow and named, and the answer of the comparison.
    fn draw_compared(&self, picture: &mut Picture, lift: f32) {
        let Self { moment, index, ref camera, front, .. } = *self;
        let (deck, palette) = (&moment.studio.deck, moment.palette);
        // The timeline says it at the check itself.
        if index == 0
            && !moment.studio.display().measure
            && front.id == deck.selected().id
            && let Some(failed) = deck.run().first_failed_check()
        {
            captions::write_failed_check(picture, camera.rect, failed, palette);
        }
        if let Some(beside) = deck.run_beside()
            && let Some((body, q)) = beside.body(front.id, index)
        {
            let name = format!("{:.3} Hz", beside.tick_hz());
            let outline = Look::of(body).outline(moment.t, &q);
            self.draw_beside(picture, lift, (outline, &name, palette.dim));
        }
        let Some(compared) = deck.compared().filter(|_| front.id == deck.selected().id) else {
            return;
        };
        if index == 0 {
            captions::write_comparison(picture, camera.rect, compared.lines(), palette);
        }
        let Some((body, q)) = compared.body(deck.scene(), &front.spec, index) else { return };
        let outline = Look::of(body).outline(moment.t, &q);
        self.draw_beside(picture, lift, (outline, compared.name(), palette.accent));
    }

    /// Draws the body of another run, hollow and named.
    fn draw_beside(&self, picture: &mut Picture, lift: f32, of: (Outline, &str, Rgba)) {
        let ((outline, name, colour), camera, palette) = (of, &self.camera, self.moment.palette);
        let style = LaneStyle { colour, dash: SOLID, fill: 0.0 };
        OutlineView { outline: &outline, camera, palette }.draw_behind(picture, style);
        let beside = hull::half_height(&outline, camera).max(lift);
        captions::ghost_name(picture, camera, (outline.at, beside), (name, colour), palette);
    }

    /// Draws the trail of a lane's body that is now at `from`, unless the trail leaves the cell. Returns the badge
    /// for a body that is, or was, beyond it.
    fn trail(
        &self,
        picture: &mut Picture,
        lane: &Entrant,
        from: DVec2,
        flag: Flag,
    ) -> Option<Lost> {
        let Self { moment, index, view, ref camera, .. } = *self;
        let (framing, is_front) = (view.framing, self.is_front(lane));
        let history = moment.history(lane, index);
        let now = Lost::of(flag, camera, self.room(), std::iter::once(from));
        if let Framing::Follow { width_m, wake_s, .. } = framing {
            if is_front {
                moment.wake(picture, camera, from, history, (width_m, wake_s));
            }
            return now;
        }
        let Some(trail_s) = trail_s(framing, moment) else { return now };
        if self.shows_futures() {
            return now;
        }
        let mut legs = moment.legs(from, history, trail_s);
        let places = legs.iter().flatten().map(|place| place.at);
        let away = Lost::of(flag, camera, self.room(), std::iter::once(from).chain(places));
        // A person who zooms in has chosen the view, so the trail stays.
        let is_fitted = moment.studio.view().zoom_pan(view.zoomed_as) == ZoomPan::default();
        if is_fitted && away.is_some() {
            return away;
        }
        for leg in &mut legs {
            if !is_front {
                leg.iter_mut().for_each(|place| place.colour = fade(place.colour, FAINT));
            }
            moment.trail(
                picture,
                camera,
                framing,
                leg,
                if is_front { TRAIL_IN_FRONT } else { TRAIL_BEHIND },
            );
            if is_front {
                moment.dots(picture, camera, framing, leg);
            }
        }
        now
    }
}

/// Duration (s) of a body's trail in this framing; `None` for ships, which leave a wake.
fn trail_s(framing: Framing, moment: &DrawContext<'_>) -> Option<f64> {
    match framing {
        Framing::Follow { .. } => None,
        Framing::Recorder { .. } => Some(moment.paper_s),
        Framing::Fixed { trail_s, .. } => Some(trail_s),
    }
}

/// Draws dotted lines between two heights at the largest swing of the truth. A mass beyond them has gained energy.
fn envelope(
    picture: &mut Picture,
    camera: &Camera,
    (swing_m, [top, bottom]): (f64, [f32; 2]),
    colour: Rgba,
) {
    for x in [-swing_m, swing_m] {
        let [x, _] = camera.points(DVec2::new(x, 0.0));
        picture.pen(camera.rect).dashed([[x, top], [x, bottom.max(top)]], 1.3, colour, [2.5, 4.0]);
    }
}
