use egui::{Modifiers, pos2};

use super::*;
use crate::scene::Scene;
use crate::stage::{Whose, compose};
use crate::studio::{HeldBody, RunCommand, StageCommand, Step, ViewCommand, shown_state};
use crate::tests::testing::TestWindow;

/// A studio with a stage, and the pointer over it.
struct Table {
    studio: Studio,
    touch: Touch,
    window: TestWindow,
}

const STAGE: Rect = Rect { min: pos2(40.0, 30.0), max: pos2(840.0, 530.0) };

impl Table {
    fn new(scene: &str) -> Self {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        (0..9).for_each(|_| studio.tick());
        let window = TestWindow { frame_s: 0.05, ..TestWindow::new([900.0, 600.0]) };
        let mut table = Self { studio, touch: Touch::default(), window };
        // A layer receives the pointer from the second frame on.
        table.frame(Vec::new());
        table
    }

    fn picture(&self) -> Picture {
        compose(&self.studio, STAGE.size().into())
    }

    /// Place of the body in the first cell, in points of the frame.
    fn body(&self) -> Pos2 {
        let picture = self.picture();
        let grip = picture.cells[0].grips(&self.studio).find(|grip| grip.whose != Whose::Truth);
        Pos2::from(grip.unwrap().at) + STAGE.min.to_vec2()
    }

    /// Lays out a frame 50 ms after the last, and applies its commands as the window does.
    fn frame(&mut self, events: Vec<Event>) -> Vec<Command> {
        let (picture, mut commands) = (self.picture(), Vec::new());
        let Self { studio, touch, window } = self;
        window.show(events, |ui| touch.show(ui, STAGE, &picture, studio, &mut commands));
        for command in &commands {
            self.studio.apply(command.clone());
        }
        commands
    }

    fn press(&mut self, at: Pos2) -> Vec<Command> {
        self.frame(vec![Event::PointerMoved(at), button(at, true, false)])
    }

    fn move_to(&mut self, at: Pos2) -> Vec<Command> {
        self.frame(vec![Event::PointerMoved(at)])
    }

    fn release(&mut self, at: Pos2, shift: bool) -> Vec<Command> {
        self.frame(vec![button(at, false, shift)])
    }

    fn held(&self) -> Option<&HeldBody> {
        self.studio.deck.held()
    }
}

fn button(pos: Pos2, pressed: bool, shift: bool) -> Event {
    let modifiers = if shift { Modifiers::SHIFT } else { Modifiers::NONE };
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers }
}

/// The only action among some commands.
fn placed(commands: &[Command]) -> Option<&Action> {
    let mut actions = commands.iter().filter_map(|command| match command {
        Command::Run(RunCommand::Act(action)) => Some(action),
        _ => None,
    });
    let action = actions.next();
    assert_eq!(actions.next(), None);
    action
}

#[test]
fn with_shift_a_drag_places_the_body_once_and_at_rest() {
    let mut table = Table::new("spring");
    let (tick, at) = (table.studio.race().tick(), table.body());
    assert_eq!(placed(&table.press(at)), None);
    assert!(table.held().is_some() && !table.studio.deck.time_runs() && table.studio.running());
    for step in 1..=6 {
        assert_eq!(placed(&table.move_to(at + vec2(-15.0 * step as f32, 4.0))), None);
        assert_eq!(table.studio.advance(50_000_000).ticks, 0);
    }
    let to = at + vec2(-90.0, 4.0);
    let x = table.held().unwrap().q[0];
    let commands = table.release(to, true);
    let action = Action::Place { body: 0, q: [x].into(), v: [0.0].into() };
    assert_eq!(placed(&commands), Some(&action));
    assert!(table.held().is_none() && table.studio.deck.time_runs());
    let row = table.studio.run().session().journal().rows().last().unwrap();
    assert_eq!((row.tick, &row.action), (tick, &action));
    assert!((table.body().x - to.x).abs() < 0.1, "{}", table.body().x);
    for lane in
        table.studio.race().entrants().iter().map(|e| &e.lane).chain([table.studio.race().truth()])
    {
        assert_eq!(lane.bodies()[0].stepper.q(), [x]);
    }
}

#[test]
fn a_drag_throws_the_body_with_the_pointers_velocity_in_simulated_time() {
    let thrown = |speed_percent| {
        let mut table = Table::new("spring");
        table.studio.apply(RunCommand::SpeedPercent(speed_percent));
        let at = table.body();
        table.press(at);
        for step in 1..=8 {
            table.move_to(at + vec2(10.0 * step as f32, 0.0));
        }
        let commands = table.release(at + vec2(90.0, 0.0), false);
        let Some(Action::Place { v, .. }) = placed(&commands) else { panic!() };
        let picture = table.picture();
        let metre = picture.cells[0].metres([1.0, 0.0]).x - picture.cells[0].metres([0.0; 2]).x;
        v[0] / metre
    };
    // 10 points in each frame of 50 ms.
    assert!((thrown(100) - 200.0).abs() < 0.1, "{}", thrown(100));
    assert!((thrown(25) - 800.0).abs() < 0.4, "{}", thrown(25));
}

#[test]
fn a_release_after_a_slow_frame_throws_with_the_velocity_of_the_motion() {
    let mut table = Table::new("spring");
    let at = table.body();
    table.press(at);
    for step in 1..=8 {
        table.move_to(at + vec2(10.0 * step as f32, 0.0));
    }
    table.window.frame_s = 0.4;
    let commands = table.release(at + vec2(80.0, 0.0), false);
    let Some(Action::Place { v, .. }) = placed(&commands) else { panic!() };
    let picture = table.picture();
    let metre = picture.cells[0].metres([1.0, 0.0]).x - picture.cells[0].metres([0.0; 2]).x;
    assert!((v[0] / metre - 200.0).abs() < 0.1, "{}", v[0] / metre);
}

#[test]
fn a_stopped_pointer_does_not_throw() {
    let mut table = Table::new("spring");
    let at = table.body();
    let to = at + vec2(60.0, 0.0);
    table.press(at);
    table.move_to(to);
    (0..3).for_each(|_| _ = table.frame(Vec::new()));
    let commands = table.release(to, false);
    let Some(Action::Place { v, .. }) = placed(&commands) else { panic!() };
    assert_eq!(v[0], 0.0);
}

#[test]
fn a_click_on_the_verdict_opens_the_instruments_and_a_second_keeps_them() {
    let mut table = Table::new("spring");
    table.studio.analyse();
    table.studio.apply(ViewCommand::ToggleMeasure);
    for is_first in [true, false] {
        let chip = table.picture().chip.expect("explicit Euler gains energy");
        let at = Pos2::from(chip.min) + STAGE.min.to_vec2() + vec2(9.0, 9.0);
        assert_eq!(table.studio.display().measure, !is_first);
        let asked = [table.press(at), table.release(at, false)].concat();
        let wanted = is_first.then_some(Command::View(ViewCommand::ToggleMeasure));
        assert_eq!(asked, Vec::from_iter(wanted));
        assert!(table.studio.display().measure);
        // Long enough after the click for no double click.
        table.window.time_s += 1.0;
    }
}

#[test]
fn escape_cancels_a_drag_without_a_trace() {
    let mut table = Table::new("spring");
    let (hash, at) = (table.studio.race().state_hash(), table.body());
    table.press(at);
    table.move_to(at + vec2(50.0, 0.0));
    assert_eq!(table.studio.apply(ViewCommand::Escape), None);
    assert!(table.held().is_none());
    table.move_to(at + vec2(70.0, 0.0));
    assert_eq!(placed(&table.release(at + vec2(70.0, 0.0), false)), None);
    assert!(table.held().is_none());
    assert_eq!(table.studio.race().state_hash(), hash);
    assert!(table.studio.run().session().journal().rows().is_empty());
}

#[test]
fn a_click_changes_only_the_selected_lane() {
    let mut table = Table::new("spring");
    let (hash, at) = (table.studio.race().state_hash(), table.body());
    table.press(at);
    table.move_to(at + vec2(1.0, 1.0));
    table.release(at + vec2(1.0, 1.0), false);
    assert_eq!(table.studio.race().state_hash(), hash);
    assert!(table.held().is_none());
    table.studio.apply(StageCommand::ToggleRace);
    table.studio.apply(StageCommand::ToggleArrangement);
    let third = table.picture().cells[2].clone();
    let at = Pos2::from(third.rect.min) + STAGE.min.to_vec2() + vec2(5.0, 5.0);
    table.press(at);
    table.release(at, false);
    assert_eq!(table.studio.active(), third.entry);
}

#[test]
fn throwing_one_lanes_body_in_a_race_moves_all_lanes() {
    let mut table = Table::new("orbit");
    table.studio.apply(StageCommand::ToggleRace);
    table.studio.apply(StageCommand::ToggleArrangement);
    (0..40).for_each(|_| table.studio.tick());
    let last = table.picture().cells.last().unwrap().clone();
    let grip = last.grips(&table.studio).next().unwrap();
    let at = Pos2::from(grip.at) + STAGE.min.to_vec2();
    table.press(at);
    table.move_to(at + vec2(12.0, 9.0));
    assert_eq!(table.held().unwrap().lane, last.lane);
    table.release(at + vec2(12.0, 9.0), false);
    let race = table.studio.race();
    let place = race.truth().bodies()[0].stepper.q();
    assert!(race.entrants().iter().all(|e| e.lane.bodies()[0].stepper.q() == place));
    let row = table.studio.run().session().journal().rows().last().unwrap();
    assert!(matches!(&row.action, Action::Place { q, .. } if q[..] == *place));
}

#[test]
fn a_click_on_an_overlaid_body_brings_its_lane_to_the_front() {
    let mut table = Table::new("orbit");
    table.studio.apply(StageCommand::ToggleRace);
    (0..40).for_each(|_| table.studio.tick());
    let cell = table.picture().cells[0].clone();
    assert_eq!((table.picture().cells.len(), cell.entry), (1, table.studio.active()));
    let other = cell.grips(&table.studio).find_map(|grip| match grip.whose {
        Whose::Lane { entry, .. } if entry != cell.entry => {
            let found = cell.grip_at(&table.studio, grip.at);
            (found == Some(grip)).then_some((entry, grip.at))
        }
        _ => None,
    });
    let (entry, at) = other.expect("lanes part on an orbit");
    let at = Pos2::from(at) + STAGE.min.to_vec2();
    table.press(at);
    table.release(at, false);
    assert_eq!(table.studio.active(), entry);
    assert_eq!(table.picture().cells[0].entry, entry);
    // A click on the empty sea changes nothing.
    let sea = STAGE.max - vec2(8.0, 8.0);
    table.press(sea);
    table.release(sea, false);
    assert_eq!(table.studio.active(), entry);
}

#[test]
fn the_wheel_zooms_a_drag_of_the_sea_pans_and_a_double_click_fits() {
    let mut table = Table::new("pendulum");
    table.studio.apply(ViewCommand::TogglePause);
    let at = table.body() + vec2(-60.0, -40.0);
    let under = |table: &Table, at: Pos2| table.picture().cells[0].metres((at - STAGE.min).into());
    let before = under(&table, at);
    table.frame(vec![
        Event::PointerMoved(at),
        Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta: vec2(0.0, 60.0),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Unknown,
            modifiers: Modifiers::NONE,
        },
    ]);
    // The wheel turns smoothly, over some frames.
    (0..40).for_each(|_| _ = table.frame(Vec::new()));
    let zoom = table.studio.view().zoom_pan(0).zoom();
    assert!((1.1..2.0).contains(&zoom), "{zoom}");
    assert!(under(&table, at).distance(before) < 1e-4);

    let to = at + vec2(40.0, -25.0);
    table.press(at);
    table.move_to(to);
    table.release(to, false);
    assert!(under(&table, to).distance(before) < 1e-4);
    assert!(table.studio.run().session().journal().rows().is_empty());

    for _ in 0..2 {
        table.press(to);
        table.release(to, false);
    }
    assert_eq!(table.studio.view().zoom_pan(0), ZoomPan::default());
    for command in [StageCommand::Restart, StageCommand::SceneBeside(Step::Next)] {
        let zoom_pan = ZoomPan::default().zoomed(2.0, [0.0; 2]);
        table.studio.apply(ViewCommand::ZoomPan { body: 0, zoom_pan });
        table.studio.apply(StageCommand::Tick(Step::Next));
        assert_eq!(table.studio.view().zoom_pan(0).zoom(), 2.0);
        table.studio.apply(command);
        assert_eq!(table.studio.view().zoom_pan(0), ZoomPan::default());
    }
}

#[test]
fn the_wheel_zooms_in_until_a_body_fills_half_the_stage_and_no_further() {
    for scene in ["ship", "harbour", "pendulum", "spring", "helm"] {
        let mut table = Table::new(scene);
        table.studio.apply(ViewCommand::TogglePause);
        let delta = vec2(0.0, 60.0);
        for _ in 0..40 {
            let at = table.body();
            table.frame(vec![
                Event::PointerMoved(at),
                Event::MouseWheel {
                    unit: egui::MouseWheelUnit::Point,
                    delta,
                    phase: egui::TouchPhase::Move,
                    source: egui::MouseWheelSource::Unknown,
                    modifiers: Modifiers::NONE,
                },
            ]);
            (0..6).for_each(|_| _ = table.frame(Vec::new()));
        }
        let picture = table.picture();
        let cell = &picture.cells[0];
        let zoom = cell.zoom_pan().zoom();
        assert!((1.2..20.0).contains(&zoom), "{scene}: {zoom}");
        assert!(cell.max_zoom_in(&table.studio) < 1.1, "{scene}: it could be zoomed on");
        if scene != "ship" && scene != "helm" {
            let grips = cell.grips(&table.studio).filter(|grip| grip.whose != Whose::Truth);
            let widest = 2.0 * grips.map(|grip| grip.radius).fold(0.0, f32::max);
            let room = Rect::from_min_max(cell.rect.min.into(), cell.rect.max.into()).size();
            let part = widest / room.min_elem();
            assert!((0.3..0.6).contains(&part), "{scene}: {part} of the stage");
        }
    }
}

/// Lets time run for a frame of 50 ms, and lays it out.
fn run_frame(table: &mut Table, events: Vec<Event>) -> Vec<Command> {
    table.studio.advance(50_000_000);
    table.frame(events)
}

#[test]
fn a_press_where_the_mass_was_up_to_a_fifth_of_a_second_ago_takes_it() {
    for scene in ["harbour", "pendulum", "orbit"] {
        for late in 0..6 {
            let mut table = Table::new(scene);
            (0..12).for_each(|_| _ = run_frame(&mut table, Vec::new()));
            let aimed = table.body();
            for frame in 0..late {
                let events =
                    if frame + 1 < late { Vec::new() } else { vec![Event::PointerMoved(aimed)] };
                run_frame(&mut table, events);
            }
            let body = &table.studio.race().entrants()[0].lane.bodies()[0];
            let q = shown_state(&table.studio, body).0;
            let view = table.studio.view().clone();
            table.press(aimed);
            let is_far = table.body().distance(aimed) > 80.0;
            if late <= 3 {
                let held = table.held().unwrap_or_else(|| panic!("{scene}, {late} frames"));
                let is_near = held.q.iter().zip(&q).all(|(held, q)| (held - q).abs() < 1e-4);
                assert!(is_near, "{scene}, {late} frames: {:?}, {q:?}", held.q);
            } else {
                assert!(table.held().is_none() || !is_far, "{scene}: it is too late");
            }
            table.release(aimed, false);
            assert_eq!(*table.studio.view(), view);
        }
    }
}

#[test]
fn a_drag_of_the_water_pans_only_a_zoomed_view() {
    for scene in ["harbour", "pendulum", "ship"] {
        for times in [1.0, 1.5, 0.5] {
            let mut table = Table::new(scene);
            table.studio.apply(ViewCommand::TogglePause);
            let zoom_pan = ZoomPan::default().zoomed(times, [0.0; 2]);
            table.studio.apply(ViewCommand::ZoomPan { body: 0, zoom_pan });
            let sea = STAGE.min + vec2(300.0, 470.0);
            let zoomed_as = table
                .picture()
                .cells
                .iter()
                .find(|cell| cell.rect.contains((sea - STAGE.min).into()))
                .unwrap()
                .zoomed_as;
            if zoomed_as != 0 {
                table.studio.apply(ViewCommand::ZoomPan { body: zoomed_as, zoom_pan });
            }
            let before = table.studio.view().zoom_pan(zoomed_as);
            table.press(sea);
            table.move_to(sea + vec2(30.0, -20.0));
            table.release(sea + vec2(30.0, -20.0), false);
            let is_panned = table.studio.view().zoom_pan(zoomed_as) != before;
            assert_eq!(is_panned, times != 1.0, "{scene} at {times}");
        }
    }
}

#[test]
fn turns_of_the_wheel_anywhere_keep_the_body_in_view() {
    for (scene, is_race) in
        [("harbour", false), ("ship", true), ("pendulum", false), ("orbit", false)]
    {
        for (turn, at) in [(60.0, [0.05, 0.9]), (60.0, [0.95, 0.1]), (-60.0, [0.9, 0.9])] {
            let mut table = Table::new(scene);
            if is_race {
                table.studio.apply(StageCommand::ToggleRace);
            }
            (0..20).for_each(|_| table.studio.tick());
            let at = STAGE.min + vec2(at[0], at[1]) * STAGE.size();
            for notch in 0..12 {
                table.frame(vec![
                    Event::PointerMoved(at),
                    Event::MouseWheel {
                        unit: egui::MouseWheelUnit::Point,
                        delta: vec2(0.0, turn),
                        phase: egui::TouchPhase::Move,
                        source: egui::MouseWheelSource::Unknown,
                        modifiers: Modifiers::NONE,
                    },
                ]);
                for _ in 0..8 {
                    run_frame(&mut table, Vec::new());
                    for cell in table.picture().cells {
                        let lane = cell.lane;
                        let own = |grip: &Grip| matches!(grip.whose, Whose::Lane { lane: of, .. } if of == lane);
                        let grips: Vec<_> = cell.grips(&table.studio).filter(own).collect();
                        let is_seen = grips.iter().any(|grip| cell.rect.contains(grip.at));
                        assert!(is_seen, "{scene}, notch {notch} of {turn}: {grips:?}");
                    }
                }
            }
        }
    }
}
