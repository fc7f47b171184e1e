//! The pointer over the stage. It grabs bodies, and zooms and pans their view. Like the panels, it reads the studio
//! and returns commands.

use std::collections::VecDeque;
use std::time::Duration;

use egui::{Align2, CursorIcon, Event, FontId, PointerButton, Pos2, Rect, Stroke, Ui, Vec2, vec2};

use super::theme::{TYPE, palette};
use crate::run::MenuIndex;
use crate::run::race::Mode;
use crate::scene::Action;
use crate::stage::{Cell, Grasp, Grip, Picture, Whose};
use crate::studio::{Command, RunCommand, StageCommand, Studio, ViewCommand, ZoomPan};

/// Distance from which a press is a drag, in points. A trembling hand stays below it.
const DRAG: f32 = 3.0;
/// The time over which a drag's velocity is measured, in seconds, and after which a hand that stopped is at rest: long
/// enough for several frames.
const MEMORY_S: f64 = 0.1;
/// Time for which a moving body can also be taken where it was, in seconds: as late as people press,
/// and a frame.
const LATE_S: f64 = 0.22;
/// Distance from a body's edge to the ring that marks it as draggable, in points.
const RING: f32 = 3.0;
/// Duration of a body's invitation to drag it, and time from one invitation to the next, in seconds.
const INVITES_S: f64 = 3.0;
const INVITED_S: f64 = 60.0;
/// Maximum radius of that ring. A ring around a whole ship would leave the stage.
const MAX_RING: f32 = 48.0;

/// State of the pointer over a stage, from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Touch {
    press: Option<Press>,
    track: PointerTrail,
    /// Cells of the last pictures of moving bodies with their times (s), the newest first.
    before: VecDeque<(f64, Vec<Cell>)>,
    /// Start of the last invitation to drag a body, in seconds; `None` if there was none.
    invited_s: Option<f64>,
}

/// A button held down.
#[derive(Debug)]
struct Press {
    /// Place of the press, in points of the frame.
    from: Pos2,
    is_drag: bool,
    on: PressTarget,
}

/// Target of the press.
#[derive(Debug)]
enum PressTarget {
    Body {
        grasp: Grasp,
        entry: MenuIndex,
        /// Whether time runs on while the hand pulls.
        pulls: bool,
    },
    /// A cell without a body there, with its zoom at that time.
    Sea { cell: Cell, zoom_pan: ZoomPan },
}

/// The stage of a frame.
struct Stage<'a> {
    studio: &'a Studio,
    picture: &'a Picture,
    /// Place of the stage, in points of the frame.
    rect: Rect,
    /// Cells of the last pictures of moving bodies.
    before: &'a VecDeque<(f64, Vec<Cell>)>,
}

impl Stage<'_> {
    fn point(&self, at: Pos2) -> [f32; 2] {
        (at - self.rect.min).into()
    }

    /// Whether the verdict on the method is there.
    fn is_on_chip(&self, at: Pos2) -> bool {
        self.picture.chip.is_some_and(|chip| chip.contains(self.point(at)))
    }

    fn cell(&self, at: Pos2) -> Option<&Cell> {
        let at = self.point(at);
        self.picture.cells.iter().find(|cell| cell.rect.contains(at))
    }

    /// The handle that a hand takes there.
    fn grip(&self, cell: &Cell, at: Pos2) -> Option<Grip> {
        let is_same = |then: &&Cell| (then.body, then.lane) == (cell.body, cell.lane);
        let before = self.before.iter().filter_map(|(_, cells)| cells.iter().find(is_same));
        cell.moving_grip_at(self.studio, &before.collect::<Vec<_>>(), self.point(at))
    }
}

impl Touch {
    /// Handles the events of the pointer since the last frame over the stage, which fills `rect` with `picture`.
    pub(super) fn show(
        &mut self,
        ui: &Ui,
        rect: Rect,
        picture: &Picture,
        studio: &Studio,
        commands: &mut Vec<Command>,
    ) {
        let (events, time, hover) =
            ui.input(|input| (input.events.clone(), input.time, input.pointer.latest_pos()));
        let mut before = std::mem::take(&mut self.before);
        before.retain(|(then, _)| studio.deck.time_runs() && time - then <= LATE_S);
        let stage = Stage { studio, picture, rect, before: &before };
        let over_stage = |at: Pos2| {
            rect.contains(at) && ui.ctx().layer_id_at(at).is_none_or(|layer| layer == ui.layer_id())
        };
        self.sync_held_body(studio, commands);
        for event in events {
            match event {
                Event::PointerButton {
                    pos,
                    button: PointerButton::Primary,
                    pressed,
                    modifiers,
                } => {
                    if !pressed {
                        self.release(&stage, time, pos, !modifiers.shift, commands);
                    } else if over_stage(pos) {
                        let pulls = modifiers.command && studio.deck.time_runs();
                        self.press(&stage, time, (pos, pulls), commands);
                    }
                }
                Event::PointerMoved(at) => self.drag(&stage, time, at, commands),
                _ => {}
            }
        }
        if let Some(Press { on: PressTarget::Body { grasp, pulls: true, .. }, .. }) =
            &mut self.press
            && let Some(at) = hover
        {
            grasp.follow_camera(&picture.cells);
            self.drag(&stage, time, at, commands);
        }
        if let Some(wait) = self.press.as_ref().and_then(|_| self.track.time_to_rest(time)) {
            ui.ctx().request_repaint_after(wait);
        }
        let hover = hover.filter(|at| over_stage(*at));
        if self.press.is_none()
            && let Some(at) = hover
        {
            zoom(ui, &stage, at, commands);
        }
        self.point_out(ui, &stage, hover, time);
        if studio.deck.time_runs() {
            before.push_front((time, picture.cells.clone()));
        }
        self.before = before;
    }

    /// Agrees with the studio, which may have released the body itself (Escape), or may still hold one that this
    /// state forgot.
    fn sync_held_body(&mut self, studio: &Studio, commands: &mut Vec<Command>) {
        let holds = matches!(self.press, Some(Press { on: PressTarget::Body { .. }, .. }));
        match studio.deck.held().is_some() || studio.deck.pulled().is_some() {
            false if holds => self.press = None,
            true if !holds => commands.push(Command::View(ViewCommand::LetGo)),
            _ => {}
        }
    }

    fn press(
        &mut self,
        stage: &Stage<'_>,
        time: f64,
        (at, pulls): (Pos2, bool),
        commands: &mut Vec<Command>,
    ) {
        let point = stage.point(at);
        if stage.is_on_chip(at) {
            if !stage.studio.display().measure {
                commands.push(Command::View(ViewCommand::ToggleMeasure));
            }
            return;
        }
        let Some(cell) = stage.cell(at) else { return };
        let grip = stage.grip(cell, at);
        let on = match grip.and_then(|grip| Grasp::new(stage.studio, cell, &grip, point)) {
            Some(grasp) => {
                commands.push(Command::Run(hold_or_pull(&grasp, pulls)));
                let entry = match grip.map(|grip| grip.whose) {
                    Some(Whose::Lane { entry, .. }) => entry,
                    Some(Whose::Truth) | None => cell.entry,
                };
                PressTarget::Body { grasp, entry, pulls }
            }
            None => PressTarget::Sea { cell: cell.clone(), zoom_pan: cell.zoom_pan() },
        };
        self.press = Some(Press { from: at, is_drag: false, on });
        self.track = PointerTrail::default();
        self.track.add(time, at);
    }

    fn drag(&mut self, stage: &Stage<'_>, time: f64, at: Pos2, commands: &mut Vec<Command>) {
        let Some(press) = &mut self.press else { return };
        self.track.add(time, at);
        press.is_drag |= press.from.distance(at) >= DRAG;
        if !press.is_drag {
            return;
        }
        match &mut press.on {
            PressTarget::Body { grasp, pulls, .. } => {
                grasp.pull(stage.studio, stage.point(at), [0.0; 2]);
                commands.push(Command::Run(hold_or_pull(grasp, *pulls)));
            }
            // The automatic view hides nothing.
            PressTarget::Sea { zoom_pan, .. } if *zoom_pan == ZoomPan::default() => {}
            PressTarget::Sea { cell, zoom_pan } => {
                let [from, to] = [press.from, at].map(|at| cell.part(stage.point(at)));
                let zoom_pan = zoom_pan.panned([to[0] - from[0], to[1] - from[1]]);
                commands
                    .push(Command::View(ViewCommand::ZoomPan { body: cell.zoomed_as, zoom_pan }));
            }
        }
    }

    /// Ends a press. A dragged body moves on from its release: thrown with the drag's velocity, or at rest. A click
    /// does not change the run; in a race it selects the lane.
    fn release(
        &mut self,
        stage: &Stage<'_>,
        time: f64,
        at: Pos2,
        is_thrown: bool,
        commands: &mut Vec<Command>,
    ) {
        self.drag(stage, time, at, commands);
        let Some(Press { is_drag, on, .. }) = self.press.take() else { return };
        let entry = match on {
            PressTarget::Body { mut grasp, entry, pulls } => {
                if is_drag && !pulls {
                    let speed = f64::from(stage.studio.clock().speed_percent()) / 100.0;
                    let velocity = if is_thrown { self.track.velocity() } else { Vec2::ZERO };
                    let velocity = [velocity.x, velocity.y].map(|points| f64::from(points) / speed);
                    grasp.pull(stage.studio, stage.point(at), velocity);
                    let held = grasp.held();
                    let (body, q, v) = (held.body, held.q.clone(), held.v.clone());
                    commands.push(Command::Run(RunCommand::Act(Action::Place { body, q, v })));
                }
                commands.push(Command::View(ViewCommand::LetGo));
                entry
            }
            PressTarget::Sea { cell, .. } => cell.entry,
        };
        if !is_drag && stage.studio.mode() == Mode::Race {
            commands.push(Command::Stage(StageCommand::Pick(entry)));
        }
    }

    /// Marks a body that the pointer can grab, by the pointer's shape and a ring.
    fn point_out(&mut self, ui: &Ui, stage: &Stage<'_>, hover: Option<Pos2>, time: f64) {
        let cursor = match &self.press {
            Some(Press { on: PressTarget::Body { .. }, .. }) => CursorIcon::Grabbing,
            Some(Press { is_drag: true, on: PressTarget::Sea { zoom_pan, .. }, .. })
                if *zoom_pan != ZoomPan::default() =>
            {
                CursorIcon::Move
            }
            Some(_) => return,
            None => {
                let Some(at) = hover else { return };
                if stage.is_on_chip(at) && !stage.studio.display().measure {
                    return ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
                }
                let Some(cell) = stage.cell(at) else { return };
                let Some(grip) = stage.grip(cell, at) else { return };
                let origin = stage.rect.min.to_vec2();
                let [low, high] = [cell.rect.min, cell.rect.max].map(|at| Pos2::from(at) + origin);
                let painter = ui.painter().with_clip_rect(Rect::from_min_max(low, high));
                let middle = Pos2::from(grip.at) + origin;
                let radius = (grip.radius + RING).min(MAX_RING);
                painter.circle_stroke(middle, radius, Stroke::new(1.5, palette(ui).accent));
                let soft = Stroke::new(5.0, palette(ui).accent.gamma_multiply(0.2));
                painter.circle_stroke(middle, radius + 2.5, soft);
                let since = *self.invited_s.get_or_insert(time);
                if time - since >= INVITED_S {
                    self.invited_s = Some(time);
                } else if time - since < INVITES_S {
                    // The name of the ghost is to the right.
                    let at = middle + vec2(-8.0, radius + 12.0);
                    let font = FontId::proportional(TYPE);
                    let colour = palette(ui).accent;
                    painter.text(at, Align2::RIGHT_CENTER, "drag me", font, colour);
                }
                CursorIcon::Grab
            }
        };
        ui.ctx().set_cursor_icon(cursor);
    }
}

fn hold_or_pull(grasp: &Grasp, pulls: bool) -> RunCommand {
    match pulls {
        true => RunCommand::Pull(grasp.pulled()),
        false => RunCommand::Hold(grasp.held().clone()),
    }
}

/// Zooms about the pointer by the wheel or a pinch, and resets the view after a double click.
fn zoom(ui: &Ui, stage: &Stage<'_>, at: Pos2, commands: &mut Vec<Command>) {
    let Some(cell) = stage.cell(at) else { return };
    let (times, _) = wheel_or_pinch(ui);
    let body = cell.zoomed_as;
    if ui.input(|input| input.pointer.button_double_clicked(PointerButton::Primary)) {
        commands.push(Command::View(ViewCommand::ZoomPan { body, zoom_pan: ZoomPan::default() }));
    } else if times != 1.0 {
        let about = cell.part(stage.point(at));
        let times = times.min(cell.max_zoom_in(stage.studio));
        let zoom_pan = cell.zoom_pan().zoomed(times, about);
        commands.push(Command::View(ViewCommand::ZoomPan { body, zoom_pan }));
    }
}

/// Recent places of the pointer, each with its time in seconds.
#[derive(Debug, Default)]
struct PointerTrail(VecDeque<(f64, Pos2)>);

impl PointerTrail {
    /// Adds a place at a time in seconds. One without a motion tells nothing: after a slow frame, a release comes late.
    fn add(&mut self, time: f64, at: Pos2) {
        if self.0.back().is_some_and(|(_, last)| *last == at) {
            return;
        }
        self.0.push_back((time, at));
        while self.0.get(1).is_some_and(|(second, _)| time - second >= MEMORY_S) {
            self.0.pop_front();
        }
    }

    /// Time until the pointer is at rest if it does not move until then; `None` if it is. To be asked in each frame,
    /// after its motions: only a frame without any shows that the pointer stands still.
    fn time_to_rest(&mut self, time: f64) -> Option<Duration> {
        let (last, at) = *self.0.back()?;
        let left = last + MEMORY_S - time;
        if left > 0.0 {
            return Some(Duration::from_secs_f64(left));
        }
        self.0.clear();
        self.0.push_back((time, at));
        None
    }

    /// In points per second.
    fn velocity(&self) -> Vec2 {
        let (Some((first, from)), Some((last, to))) = (self.0.front(), self.0.back()) else {
            return Vec2::ZERO;
        };
        let span = (last - first) as f32;
        if span > 0.0 { (*to - *from) / span } else { vec2(0.0, 0.0) }
    }
}

#[cfg(test)]
mod tests;

/// Turn of the wheel that enlarges by the factor e, in points. A notch is some 40.
const WHEEL: f64 = 200.0;

/// Factor of the zoom, and distance to the right in points, by which the wheel and a pinch move the view.
pub(super) fn wheel_or_pinch(ui: &Ui) -> (f64, f32) {
    let (scrolled, pinched) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
    (libm::exp(f64::from(scrolled.y) / WHEEL) * f64::from(pinched), scrolled.x)
}
