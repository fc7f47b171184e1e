use egui::{Context, Event as Input, Modifiers, PointerButton, RawInput};

use super::*;
use crate::lab::{Action, RunCommand, Scene, StageCommand, Step};
use crate::view::panels;
use crate::view::theme;

const SIZE: Vec2 = vec2(1280.0, 720.0);

/// What a frame of [`SIZE`] with these events asks for.
fn frame(context: &Context, lab: &Lab, events: Vec<Input>) -> Vec<Command> {
    let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, SIZE));
    let input = RawInput { screen_rect, events, ..RawInput::default() };
    let mut commands = Vec::new();
    let mut output = context.run_ui(input, |ui| commands.extend(panels::show(ui, lab).0));
    output.textures_delta.clear();
    commands
}

fn press(pos: Pos2, pressed: bool) -> Input {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    Input::PointerButton { pos, button, pressed, modifiers }
}

#[test]
fn a_press_on_the_track_goes_to_the_tick_there_and_a_drag_follows() {
    let mut lab = Lab::new(Scene::built_in("spring").unwrap());
    (0..600).for_each(|_| lab.tick());
    let context = Context::default();
    theme::dress(&context);
    let height = SIZE.y - panels::footer::HEIGHT - panels::lanes::height(&lab) - HEIGHT + TRACK_Y;
    let along = Rangef::new(8.0 + NAME, SIZE.x - 8.0 - MEMORY - MARGIN);
    let whole = Span::whole(lab.scene().seconds, 10.0);
    let at = |seconds: f64| pos2(whole.x(seconds, along), height);
    frame(&context, &lab, vec![Input::PointerMoved(at(2.5))]);
    let pressed = frame(&context, &lab, vec![press(at(2.5), true)]);
    assert_eq!(pressed, [Command::Run(RunCommand::Seek(150))]);
    let dragged = frame(&context, &lab, vec![Input::PointerMoved(at(4.0))]);
    assert_eq!(dragged, [Command::Run(RunCommand::Seek(240))]);
    // Nothing was run beyond its end.
    let dragged = frame(&context, &lab, vec![Input::PointerMoved(at(19.0))]);
    assert_eq!(dragged, [Command::Run(RunCommand::Seek(600))]);
    lab.apply(RunCommand::Seek(600));
    assert_eq!(frame(&context, &lab, vec![press(at(19.0), false)]), []);
}

#[test]
fn letting_go_of_the_track_does_not_undo_the_step_of_a_key() {
    let mut lab = Lab::new(Scene::built_in("spring").unwrap());
    (0..600).for_each(|_| lab.tick());
    let context = Context::default();
    theme::dress(&context);
    let height = SIZE.y - panels::footer::HEIGHT - panels::lanes::height(&lab) - HEIGHT + TRACK_Y;
    let at = |x: f32| pos2(x, height);
    frame(&context, &lab, vec![Input::PointerMoved(at(300.0))]);
    let mut asked = frame(&context, &lab, vec![press(at(300.0), true)]);
    asked.extend(frame(&context, &lab, vec![Input::PointerMoved(at(340.0))]));
    assert!(asked.len() >= 2, "{asked:?}");
    for command in asked {
        lab.apply(command);
    }
    lab.apply(StageCommand::Tick(Step::Next));
    assert_eq!(frame(&context, &lab, vec![press(at(340.0), false)]), []);
}

#[test]
fn an_undo_is_offered_once_something_was_changed() {
    let mut lab = Lab::new(Scene::built_in("spring").unwrap());
    let room = Rect::from_min_size(Pos2::ZERO, vec2(400.0, HEIGHT));
    let beside = |lab: &Lab| room.right() - groove(lab, room).unwrap().along.max;
    assert_eq!((lab.timeline().undoes(), beside(&lab)), (None, MARGIN));
    (0..60).for_each(|_| lab.tick());
    lab.apply(RunCommand::Act(Action::Kick(1.0)));
    lab.apply(StageCommand::Restart);
    assert_eq!(lab.timeline().undoes(), Some("the restart"));
    assert_eq!(beside(&lab), UNDO + MARGIN);
    (0..60).for_each(|_| lab.tick());
    lab.apply(RunCommand::Seek(30));
    lab.apply(RunCommand::Act(Action::Kick(1.0)));
    assert_eq!(lab.timeline().undoes(), Some("the kick at tick 30"));
}

#[test]
fn memory_is_told_in_megabytes() {
    assert_eq!(memory(13_002_342, 64 << 20), "12.4 of 64 MB");
    assert_eq!(memory(0, 1 << 20), "0.0 of 1 MB");
}
