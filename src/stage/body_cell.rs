//! Draws one body of the scene in one cell, in four layers: the ground, the lanes behind, the lane in front, and the
//! words.

use std::mem::take;

use glam::DVec2;

use super::body::OutlineView;
use super::flags::{Flag, Lost, badges, clear_number, flags};
use super::framed::BodyView;
use super::futures::End;
use super::ghost::Ghost;
use super::lane::{RaceLane, StageLane};
use super::moment::DrawContext;
use super::sketch::{Camera, LaneStyle};
use super::{
    Cell, Picture, Rect, Whose, apex, captions, chart, futures, hull, scale_marks, universe,
};
use crate::look::palette::{Rgba, fade};
use crate::look::{Framing, Look};
use crate::run::race::{LaneBody, Mode};
use crate::scene::{Mark, Outline};
use crate::studio::{
    DIGITS, HeldBody, ZoomPan, future_of_lane, futures, shown_state, shows_futures, without_futures,
};

/// Most lanes for which each body shows its lane's number.
const MAX_NUMBERED: usize = 9;

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

/// One body of the scene in one cell: its ghost, and the bodies of some lanes.
pub(super) struct BodyCell<'a> {
    pub(super) moment: &'a DrawContext<'a>,
    pub(super) index: usize,
    pub(super) ghost: &'a Ghost,
    /// The view of the camera, shared with the other bodies on the same stage.
    pub(super) view: &'a BodyView,
    pub(super) camera: Camera,
    pub(super) lanes: &'a [RaceLane<'a>],
    pub(super) front: RaceLane<'a>,
}

/// The results of the lower layers for the layers above them.
struct Drawn {
    cell: Cell,
    /// Ends of futures, to be labelled.
    ends: Vec<End>,
    /// Numbers of the bodies behind.
    flagged: Vec<Flag>,
    /// Outlines of the bodies behind, to be drawn over the one in front.
    rivals: Vec<(Outline, LaneStyle)>,
    lost: Vec<Lost>,
    /// Place of the front body, if it has a number.
    numbered: Option<[f32; 2]>,
}

/// A lane's body at the displayed moment.
struct Shown {
    outline: Outline,
    flag: Flag,
    style: LaneStyle,
}

impl BodyCell<'_> {
    /// Draws four layers: the ground, the lanes behind, the lane in front, and the words.
    pub(super) fn draw(mut self, picture: &mut Picture) {
        if self.has_outgrown() {
            self.camera = universe::with_short_paper(&self.camera);
        }
        let mut drawn = self.draw_ground(picture);
        for lane in self.lanes.iter().filter(|lane| !self.is_front(**lane)) {
            self.draw_behind(picture, *lane, &mut drawn);
        }
        self.draw_front(picture, &mut drawn);
        self.write(picture, &mut drawn);
        picture.cells.push(drawn.cell);
    }

    /// Draws everything below the bodies.
    fn draw_ground(&self, picture: &mut Picture) -> Drawn {
        let Self { moment, index, ref camera, .. } = *self;
        let studio = moment.studio;
        self.ground(picture);
        if self.has_outgrown() {
            universe::landmarks(picture, (camera, self.room()), (index, self.front));
        }
        let mut ends = Vec::new();
        let has_selected = self.lanes.iter().any(StageLane::is_selected);
        if self.shows_futures() && (has_selected || self.is_banded()) {
            let futures = match self.is_banded() {
                true => future_of_lane(&studio.deck, self.front.entrant, index),
                false => futures(&studio.deck, index),
            };
            let on = (camera, self.room());
            ends = futures::draw(picture, moment, on, self.view.framing, futures);
            if without_futures(&studio.deck, index).is_none() {
                captions::futures(picture, camera.rect, studio, moment.palette);
            }
        }
        let cell = Cell {
            rect: camera.rect,
            lane: self.front.id(),
            entry: self.front.entry(),
            body: index,
            zoomed_as: self.view.zoomed_as,
            seen: Vec::new(),
            camera: *camera,
        };
        Drawn { cell, ends, flagged: vec![], rivals: vec![], lost: vec![], numbered: None }
    }

    /// Draws the trail of a lane. Returns its body to draw, with `true` if that is beyond the cell and not held.
    fn draw_trail(
        &self,
        picture: &mut Picture,
        lane: RaceLane<'_>,
        drawn: &mut Drawn,
    ) -> (Shown, bool) {
        let Self { moment, index, ref camera, .. } = *self;
        let body = &lane.bodies()[index];
        let (coordinates, _) = shown_state(moment.studio, body);
        let outline = Look::of(body).outline(moment.t, &coordinates);
        let (entry, (colour, dash)) = (lane.entry(), lane.style());
        let at = camera.points(outline.at);
        let flag = Flag { at, number: entry + 1, colour };
        drawn.cell.seen.push((Whose::Lane { lane: lane.id(), entry }, coordinates));
        let is_held = self.held().is_some();
        let lost = self.trail(picture, lane, outline.at, flag).filter(|_| !is_held);
        drawn.lost.extend(lost);
        let style = LaneStyle { colour, dash, fill: self.fill() };
        (Shown { outline, flag, style }, !is_held && !self.room().contains(at))
    }

    fn draw_behind(&self, picture: &mut Picture, lane: RaceLane<'_>, drawn: &mut Drawn) {
        let (Shown { outline, flag, style }, is_beyond) = self.draw_trail(picture, lane, drawn);
        if is_beyond {
            return;
        }
        let style = LaneStyle { colour: fade(style.colour, BODY_BEHIND), ..style };
        self.seen(&outline).draw_behind(picture, style);
        drawn.flagged.push(flag);
        if self.lanes.len() <= MAX_NUMBERED && outline.threads.is_empty() {
            drawn.rivals.push((outline, LaneStyle { fill: 0.0, ..style }));
        }
    }

    fn draw_front(&self, picture: &mut Picture, drawn: &mut Drawn) {
        let Self { moment, index, front, .. } = *self;
        let (Shown { outline, flag, style }, is_beyond) = self.draw_trail(picture, front, drawn);
        let seen = self.seen(&outline);
        if is_beyond {
            seen.draw_fixed_parts(picture);
            return self.draw_ghost(picture);
        }
        let look = Look::of(&front.bodies()[index]);
        let in_hand = self.held().map(|held| look.outline(moment.t, &held.q));
        let shown = self.seen(in_hand.as_ref().unwrap_or(&outline));
        if in_hand.is_some() {
            let left = LaneStyle { colour: fade(style.colour, LEFT_BEHIND), ..style };
            seen.draw_behind(picture, left);
        }
        let style = LaneStyle { colour: fade(style.colour, 1.0), ..style };
        shown.draw_below_exact(picture, style);
        self.draw_ghost(picture);
        shown.draw_front(picture, style);
        // The body in front would hide those behind.
        for (outline, style) in drawn.rivals.drain(..) {
            self.seen(&outline).draw_behind(picture, style);
        }
        self.draw_hand(picture);
        // With many lanes, flags overlap the bodies.
        if self.lanes.len() <= MAX_NUMBERED {
            let (studio, entry) = (moment.studio, flag.number - 1);
            // In solo mode, a body has a number only if a key picks its method.
            if studio.mode() == Mode::Race || entry < DIGITS {
                let before = studio.deck.switched_from(front.entrant);
                let before = before.filter(|it| *it < DIGITS && *it != entry);
                let before = before.map_or(String::new(), |it| format!("{} → ", it + 1));
                shown.number(picture, format!("{before}{}", entry + 1), flag.colour);
            }
            drawn.numbered = Some(flag.at);
        }
    }

    /// Draws the lines from the pulled or held part of the front body to the hand.
    fn draw_hand(&self, picture: &mut Picture) {
        let Self { moment, index, front, ref camera, .. } = *self;
        let (deck, palette) = (&moment.studio.deck, moment.palette);
        let id = front.id();
        let pulled = deck.pulled().filter(|pulled| pulled.body == index && pulled.lane == id);
        if let Some(pulled) = pulled {
            let body = &front.bodies()[index];
            let handles = Look::of(body).handles(&shown_state(moment.studio, body).0);
            if let Some(handle) = handles.get(pulled.handle) {
                let ends = [handle.at, pulled.hand].map(|at| camera.points(at));
                picture.pen(camera.rect).dashed(ends, 2.0, palette.text, [6.0, 4.0]);
            }
        }
        if let Some(held) = self.held().filter(|held| held.lane == id) {
            let [handle, hand] = [held.handle, held.hand].map(|at| camera.points(at));
            picture.pen(camera.rect).line(handle, hand, 1.0, palette.text);
        }
    }

    /// Writes badges, flags, names and halts.
    fn write(&self, picture: &mut Picture, drawn: &mut Drawn) {
        let Self { moment, index, ghost, view, ref camera, .. } = *self;
        let (studio, palette) = (moment.studio, moment.palette);
        let lift = match view.framing {
            Framing::Recorder { .. } => 0.72 * camera.block,
            Framing::Follow { .. } | Framing::Fixed { .. } => 22.0,
        };
        if self.shows_ghost() {
            drawn.cell.seen.push((Whose::Truth, ghost.q.clone()));
        }
        self.write_flags(picture, lift, drawn);
        if self.shows_ghost() && self.is_wide() && index == 0 {
            self.name_ghost(picture, lift);
        }
        self.draw_compared(picture, lift);
        let is_alone = self.lanes.len() == 1;
        let says_beside =
            is_alone && (studio.mode() == Mode::Solo || self.front.bodies().len() == 1);
        let halted = self.lanes.iter().filter(|_| !says_beside).filter_map(|lane| {
            let halt = lane.bodies()[index].halted()?;
            Some(((!is_alone).then(|| lane.entry() + 1), halt))
        });
        captions::halts(picture, camera.rect, halted, self.truth(), palette);
        if self.has_outgrown() {
            let swing_m = ghost.swing_m.unwrap_or(ghost.view.reach_m.x);
            let (on, of_lane) = ((camera, self.room()), (index, self.front));
            universe::write_distance(picture, on, (view, swing_m), of_lane);
        }
    }

    /// Writes the badges of lost bodies, the numbers of the bodies behind, and the marks of bounces.
    fn write_flags(&self, picture: &mut Picture, lift: f32, drawn: &mut Drawn) {
        let Self { moment, index, ref camera, .. } = *self;
        let (framing, palette) = (self.view.framing, moment.palette);
        // Below the row of a chart recorder's bodies, badges cover none of them.
        let below = match framing {
            Framing::Recorder { .. } => camera.at[1] - camera.rect.min[1] + 0.6 * camera.block,
            Framing::Follow { .. } | Framing::Fixed { .. } => BADGES,
        };
        let mut room = badges(picture, camera, &drawn.lost, [below, BADGES], palette);
        if self.lanes.len() > 1 {
            room.min[1] = room.min[1].max(captions::foot_of_verdicts(camera.rect));
        }
        let name = captions::name_room(camera.rect, moment, index);
        if let Some(front) = drawn.numbered {
            clear_number(&mut drawn.flagged, front, lift);
        }
        futures::label_ends(picture, moment, take(&mut drawn.ends), self.room());
        flags(picture, &drawn.flagged, lift, palette, (room, camera.rect, name));
        if Look::of(self.truth()).has_ground() && self.truth().halted().is_none() {
            apex::draw(picture, camera, !drawn.lost.is_empty(), self.front, index);
            apex::strip(picture, camera, framing, (self.lanes, self.front), index);
        }
    }

    fn name_ghost(&self, picture: &mut Picture, lift: f32) {
        let Self { ghost, view, ref camera, moment: &DrawContext { palette, .. }, .. } = *self;
        let bead = ghost.outline.marks.iter().find_map(|mark| match mark {
            Mark::Disc { radius, .. } => Some(camera.size(*radius)),
            _ => None,
        });
        let is_recorded = matches!(view.framing, Framing::Recorder { .. });
        let beside = bead.filter(|_| is_recorded).unwrap_or(lift);
        let beside = hull::half_height(&ghost.outline, camera).max(beside);
        let exact = ("exact", palette.exact);
        captions::ghost_name(picture, camera, (ghost.outline.at, beside), exact, palette);
    }

    fn truth(&self) -> &LaneBody {
        &self.moment.studio.race().truth().bodies()[self.index]
    }

    fn shows_ghost(&self) -> bool {
        self.moment.studio.display().ghost && self.truth().halted().is_none()
    }

    /// The hand's hold on this body, in any lane.
    fn held(&self) -> Option<&HeldBody> {
        self.moment.studio.deck.held().filter(|held| held.body == self.index)
    }

    fn seen<'s>(&'s self, outline: &'s Outline) -> OutlineView<'s> {
        OutlineView { outline, camera: &self.camera, palette: self.moment.palette }
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

    fn is_front(&self, lane: RaceLane<'_>) -> bool {
        lane.id() == self.front.id()
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
    fn ground(&self, picture: &mut Picture) {
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
        let is_past_shown = self.shows_ghost() && !self.shows_futures();
        if let Some(trail_s) = trail_s(framing, moment).filter(|_| is_past_shown) {
            let tolerance_m = TOLERANCE / camera.points_per_metre;
            let past = ghost.past(moment, index, trail_s, tolerance_m);
            moment.trail(picture, camera, framing, &past, TRAIL_OF_TRUTH);
        }
    }

    fn draw_ghost(&self, picture: &mut Picture) {
        if self.shows_ghost() {
            self.seen(&self.ghost.outline).ghost(picture);
        }
    }

    /// Draws the body of a compared recording, hollow and named, and the answer of the comparison.
    fn draw_compared(&self, picture: &mut Picture, lift: f32) {
        let Self { moment, index, ref camera, front, .. } = *self;
        let (deck, palette) = (&moment.studio.deck, moment.palette);
        // The timeline says it at the check itself.
        if index == 0
            && !moment.studio.display().measure
            && front.is_selected()
            && let Some(failed) = deck.run().first_failed_check()
        {
            captions::write_failed_check(picture, camera.rect, failed, palette);
        }
        if let Some(beside) = deck.run_beside()
            && let Some((body, q)) = beside.body(front.id(), index)
        {
            let name = format!("{:.3} Hz", beside.tick_hz());
            let outline = Look::of(body).outline(moment.t, &q);
            self.draw_beside(picture, lift, (outline, &name, palette.dim));
        }
        let Some(compared) = deck.compared().filter(|_| front.is_selected()) else { return };
        if index == 0 {
            captions::write_comparison(picture, camera.rect, compared.lines(), palette);
        }
        let Some((body, q)) = compared.body(deck.scene(), &front.entrant.spec, index) else {
            return;
        };
        let outline = Look::of(body).outline(moment.t, &q);
        self.draw_beside(picture, lift, (outline, compared.name(), palette.accent));
    }

    /// Draws the body of another run, hollow and named.
    fn draw_beside(&self, picture: &mut Picture, lift: f32, of: (Outline, &str, Rgba)) {
        let ((outline, name, colour), camera, palette) = (of, &self.camera, self.moment.palette);
        self.seen(&outline).draw_behind(picture, LaneStyle::solid(colour, 0.0));
        let beside = hull::half_height(&outline, camera).max(lift);
        captions::ghost_name(picture, camera, (outline.at, beside), (name, colour), palette);
    }

    /// Draws the trail of a lane's body that is now at `from`, unless the trail leaves the cell. Returns the badge
    /// for a body that is, or was, beyond it.
    fn trail(
        &self,
        picture: &mut Picture,
        lane: RaceLane<'_>,
        from: DVec2,
        flag: Flag,
    ) -> Option<Lost> {
        let Self { moment, index, view, ref camera, .. } = *self;
        let (framing, is_front) = (view.framing, self.is_front(lane));
        let history = lane.history(index);
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
