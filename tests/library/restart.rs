//! A restart goes back to the start line, and keeps what a person chose and nothing of what the script did.

use regatta::lab::{Action, RunCommand, SCENES, Scene, StageCommand, Studio};

/// The ship, whose script changes method and tick rate.
fn scripted() -> Studio {
    let text = SCENES.iter().find(|scene| scene.name == "ship").unwrap().text;
    let script = "[[command]]\ntick = 3\ntick_hz = 100\n[[command]]\ntick = 4\nmethod = \"rk4\"\n";
    Studio::new(Scene::parse("ship.toml", &format!("{text}{script}")).unwrap())
}

fn settings(lab: &Studio) -> (u32, u32, &'static str) {
    let method = lab.entries()[lab.active()].method.id;
    (lab.clock().tick_hz(), lab.race().tick_hz(), method)
}

#[test]
fn a_restart_takes_back_what_the_script_did() {
    let mut lab = scripted();
    (0..10).for_each(|_| lab.tick());
    assert_eq!(settings(&lab), (100, 100, "rk4"));
    lab.apply(StageCommand::Restart);
    assert_eq!(settings(&lab), (2, 2, "explicit-euler"));
    assert_eq!((lab.race().tick(), lab.race().t()), (0, 0.0));
    (0..10).for_each(|_| lab.tick());
    assert_eq!(settings(&lab), (100, 100, "rk4"), "the script plays again");
}

#[test]
fn a_restart_keeps_the_rate_and_the_method_that_a_person_chose() {
    let mut lab = scripted();
    (0..10).for_each(|_| lab.tick());
    lab.apply(StageCommand::TickHz(7));
    lab.apply(StageCommand::Pick(2));
    lab.apply(StageCommand::Restart);
    assert_eq!(settings(&lab), (7, 7, "improved-euler"));
}

#[test]
fn a_restart_owes_no_part_of_a_tick_and_keeps_the_speed() {
    let mut lab = scripted();
    lab.apply(RunCommand::SpeedPercent(50));
    lab.advance(200_000_000);
    lab.advance(200_000_000);
    assert_eq!((lab.race().tick(), lab.clock().alpha()), (0, 0.4));
    lab.apply(StageCommand::Restart);
    assert_eq!((lab.clock().alpha(), lab.clock().speed_percent()), (0.0, 50));
    lab.advance(0);
    assert_eq!(lab.race().tick(), 0);
    for _ in 0..4 {
        lab.advance(249_000_000);
    }
    assert_eq!(lab.race().tick(), 0, "a tick takes a second of real time at this speed");
    lab.advance(4_000_000);
    assert_eq!(lab.race().tick(), 1);
}

#[test]
fn a_frame_goes_no_further_than_it_may() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    lab.advance_in_time(7, 100_000_000, &mut || true);
    assert_eq!(lab.race().tick(), 6);
    lab.advance_in_time(7, 100_000_000, &mut || true);
    assert_eq!((lab.race().tick(), lab.timeline().end()), (7, 7));
    lab.advance_in_time(7, 100_000_000, &mut || true);
    assert_eq!(lab.race().tick(), 7);
}

#[test]
fn a_run_with_actions_by_hand_comes_back_after_a_restart_and_goes_again() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    (0..40).for_each(|_| lab.tick());
    lab.apply(RunCommand::Act(Action::Kick(1.0)));
    (0..40).for_each(|_| lab.tick());
    let (hash, journal) = (lab.race().state_hash(), lab.race().journal().clone());
    lab.apply(StageCommand::Restart);
    assert_eq!(lab.viewer().notice, None, "the hint leads on");
    assert!(lab.hint().is_some());
    (0..3).for_each(|_| lab.tick());
    // A second restart is not about the run of three ticks.
    lab.apply(StageCommand::Restart);
    (0..5).for_each(|_| lab.tick());
    lab.apply(RunCommand::Undo);
    assert_eq!((lab.race().tick(), lab.race().state_hash()), (80, hash));
    assert_eq!(lab.race().journal(), &journal);
    let notice = lab.viewer().notice.as_deref().unwrap();
    assert!(notice.starts_with("undid the restart"), "{notice}");
    lab.apply(RunCommand::Seek(40));
    lab.apply(RunCommand::Seek(80));
    assert_eq!(lab.race().state_hash(), hash, "with its past");
    lab.apply(RunCommand::Redo);
    assert_eq!((lab.race().tick(), lab.race().journal().rows().len()), (5, 0));
}

#[test]
fn a_frame_whose_time_is_up_drops_the_ticks_that_are_left() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    let mut made = 0;
    let due = lab.advance_in_time(u64::MAX, 100_000_000, &mut || {
        made += 1;
        made < 2
    });
    assert_eq!((due.ticks, due.dropped, lab.dropped(), lab.race().tick()), (2, 4, 4, 2));
    let due = lab.advance_in_time(u64::MAX, 50_000_000, &mut || true);
    assert_eq!((due.ticks, due.dropped, lab.race().tick()), (3, 0, 5));
}

#[test]
fn what_a_hand_still_did_to_a_body_of_the_scene_before_changes_nothing() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    lab.tick();
    let before = lab.race().state_hash();
    let place = Action::Place { body: 2, q: [1.0].into(), v: [0.0].into() };
    let set = |parameter| Action::Set { body: 2, parameter, value: 3.0 };
    for action in [place, set(0), set(99)] {
        lab.apply(RunCommand::Act(action));
    }
    lab.apply(RunCommand::Act(Action::Set { body: 0, parameter: 99, value: 3.0 }));
    assert_eq!(lab.race().state_hash(), before);
}
