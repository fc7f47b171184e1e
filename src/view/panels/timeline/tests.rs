use egui::Event as Input;

use super::*;
use crate::panels;
use crate::run::diff::{Comparison, Difference};
use crate::scene::{Action, Scene};
use crate::studio::{RunCommand, StageCommand, Step, show_comparison};
use crate::tests::testing::{TestWindow, button};

const SIZE: Vec2 = vec2(1280.0, 720.0);

/// Returns the y of the track in a frame of `SIZE`. The table, the methods and the footer are below it.
fn track_y(studio: &Studio) -> f32 {
    let below = panels::lanes::height(studio) + panels::methods::HEIGHT + panels::footer::HEIGHT;
    SIZE.y - below - HEIGHT + TRACK_Y
}

#[test]
fn a_press_on_the_track_seeks_and_a_drag_follows() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..600).for_each(|_| studio.tick());
    let mut window = TestWindow::new(SIZE);
    let mut frame = |studio: &Studio, event: Input| window.panels(studio, vec![event]).0;
    let height = track_y(&studio);
    let along = Rangef::new(8.0 + MARGIN, SIZE.x - 8.0 - MEMORY - MARGIN);
    let whole = Span::whole(studio.scene().seconds, 10.0);
    let at = |seconds: f64| pos2(whole.x(seconds, along), height);
    frame(&studio, Input::PointerMoved(at(2.5)));
    let pressed = frame(&studio, button(at(2.5), true));
    assert_eq!(pressed, [Command::Run(RunCommand::Seek(150))]);
    let dragged = frame(&studio, Input::PointerMoved(at(4.0)));
    assert_eq!(dragged, [Command::Run(RunCommand::Seek(240))]);
    // A seek beyond the end of the run stops at the last tick of the run.
    let dragged = frame(&studio, Input::PointerMoved(at(19.0)));
    assert_eq!(dragged, [Command::Run(RunCommand::Seek(1140))]);
    studio.apply(RunCommand::Seek(1140));
    assert_eq!(studio.race().tick(), 600);
    assert_eq!(frame(&studio, button(at(19.0), false)), []);
}

#[test]
fn releasing_the_track_does_not_undo_a_step_by_key() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..600).for_each(|_| studio.tick());
    let mut window = TestWindow::new(SIZE);
    let mut frame = |studio: &Studio, event: Input| window.panels(studio, vec![event]).0;
    let height = track_y(&studio);
    let at = |x: f32| pos2(x, height);
    frame(&studio, Input::PointerMoved(at(300.0)));
    let mut asked = frame(&studio, button(at(300.0), true));
    asked.extend(frame(&studio, Input::PointerMoved(at(340.0))));
    assert!(asked.len() >= 2, "{asked:?}");
    for command in asked {
        studio.apply(command);
    }
    studio.apply(StageCommand::Tick(Step::Next));
    assert_eq!(frame(&studio, button(at(340.0), false)), []);
}

#[test]
fn an_undo_is_offered_once_something_was_changed() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    let room = Rect::from_min_size(Pos2::ZERO, vec2(400.0, HEIGHT));
    let beside = |studio: &Studio| room.right() - groove(studio, room).unwrap().along.max;
    assert_eq!((studio.run().undoes(), beside(&studio)), (None, MARGIN));
    (0..60).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Kick(1.0)));
    studio.apply(StageCommand::Restart);
    assert_eq!(studio.run().undoes(), Some("the restart"));
    assert_eq!(beside(&studio), UNDO + MARGIN);
    (0..60).for_each(|_| studio.tick());
    studio.apply(RunCommand::Seek(30));
    studio.apply(RunCommand::Act(Action::Kick(1.0)));
    assert_eq!(studio.run().undoes(), Some("the kick (tick 30)"));
}

#[test]
fn memory_is_shown_in_megabytes() {
    assert_eq!(memory(13_002_342, 64 << 20), "12.4 of 64 MB");
    assert_eq!(memory(0, 1 << 20), "0.0 of 1 MB");
}

#[test]
fn the_moment_under_the_pointer_is_one_line_above_the_track() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..600).for_each(|_| studio.tick());
    let mut window = TestWindow::new(SIZE);
    let height = track_y(&studio);
    for x in [400.0, SIZE.x - MEMORY - MARGIN - 20.0] {
        window.panels(&studio, vec![Input::PointerMoved(pos2(x, height))]);
        let mut told = None;
        for _ in 0..8 {
            window.time_s += 0.4;
            let shown = window.panels(&studio, Vec::new()).1.all();
            let moment = shown.into_iter().find(|(_, text)| text.starts_with("tick "));
            told = moment.map(|(rect, _)| rect).or(told);
        }
        let rect = told.expect("the moment is told");
        assert!(rect.bottom() < height && rect.height() < 24.0, "{rect} above {height}");
    }
}

#[test]
fn a_compared_recordings_first_difference_is_marked_and_sought() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..200).for_each(|_| studio.tick());
    let mut window = TestWindow::new(SIZE);
    let at = pos2(400.0, track_y(&studio));
    let other = |pressed| Input::PointerButton {
        pos: at,
        button: egui::PointerButton::Secondary,
        pressed,
        modifiers: egui::Modifiers::NONE,
    };
    for event in [Input::PointerMoved(at), other(true), other(false)] {
        assert_eq!(window.panels(&studio, vec![event]).0, [], "a menu goes nowhere");
    }
    studio.apply(ViewCommand::AskForRun);
    assert!(studio.viewer.compares_typed_path());
    let other = Difference {
        tick: 250,
        tick_name: Some("tick".into()),
        key: [("lane", "1"), ("body", "spring"), ("coordinate", "x")]
            .map(|(name, cell)| (name.into(), cell.into()))
            .into(),
        column: "q".into(),
        values: [Some("1.5".into()), Some("1.25".into())],
        ulps: Some(2),
        relative: Some(0.2),
    };
    let found = Comparison { rows: 900, changes: true, first: Some(other), ..Default::default() };
    show_comparison(&mut studio, "clip.toml", &found, Scene::built_in("spring").unwrap());
    // The run had not come this far, so it is continued.
    assert_eq!((studio.race().tick(), studio.run().end()), (250, 250));
    let compared = studio.deck.compared().unwrap();
    let lines = ["differs from 4.167 s on: position of spring, lane 1", "2 ulps apart"];
    assert_eq!((compared.tick(), compared.lines()), (250, lines.map(str::to_owned)));
    assert!(studio.viewer.dialog().is_none());
    studio.tick();
    assert!(studio.deck.compared().is_some());
    studio.apply(StageCommand::Restart);
    assert!(studio.deck.compared().is_none());
}

#[test]
fn a_recording_is_checked_while_it_plays_until_a_person_changes_it() {
    let mut recorded = Studio::new(Scene::built_in("harbour").unwrap());
    (0..150).for_each(|_| recorded.tick());
    let text = recorded.deck.recording().unwrap();
    let play = |text: &str, ticks: u64| {
        let mut studio = Studio::new(Scene::parse("run.toml", text).unwrap());
        (0..ticks).for_each(|_| studio.tick());
        studio
    };
    // On the timeline, or on the stage where that stands alone.
    let said = |studio: &mut Studio| {
        let [on_stage, on_timeline] = [false, true].map(|measures| {
            studio.viewer.preferences.display.measure = measures;
            let labels = crate::stage::compose(studio, [780.0, 440.0]).labels;
            let panels = TestWindow::new(SIZE).panels(studio, Vec::new()).1;
            let words: Vec<String> = labels.into_iter().map(|it| it.text).collect();
            let words = words.into_iter().chain(panels.words());
            words.filter(|it| it.starts_with("not the same run")).collect::<Vec<_>>()
        });
        assert_eq!(on_stage, on_timeline);
        assert!(on_stage.len() < 2, "{on_stage:?}");
        on_stage.into_iter().next()
    };
    let mut same = play(&text, 150);
    let found: Vec<(u64, bool)> = checks(&same).collect();
    assert_eq!(found, [(60, true), (120, true), (150, true)]);
    assert_eq!(said(&mut same), None);
    let hash = format!("{:016x}", same.scene().checks[1].hash);
    let other = format!("{:016x}", same.scene().checks[1].hash ^ 1);
    assert!(text.contains(&hash), "{text}");
    let mut wrong = play(&text.replace(&hash, &other), 130);
    let found: Vec<(u64, bool)> = checks(&wrong).collect();
    assert_eq!(found, [(60, true), (120, false)]);
    assert_eq!(said(&mut wrong).as_deref(), Some("not the same run: tick 120, lane 1"));
    wrong.apply(RunCommand::Seek(100));
    assert_eq!(said(&mut wrong), None, "it is not yet there");
    // A person's kick is meant to change the run.
    wrong.apply(RunCommand::Act(Action::Kick(1.0)));
    (0..60).for_each(|_| wrong.tick());
    assert_eq!(checks(&wrong).collect::<Vec<_>>(), [(60, true)]);
    wrong.apply(RunCommand::Undo);
    assert_eq!(checks(&wrong).count(), 2);
}
