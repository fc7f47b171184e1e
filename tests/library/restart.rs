//! A restart returns to the start line; it keeps a person's settings and undoes the script's.

use regatta::scene::{Action, SCENES, Scene};
use regatta::studio::{RunCommand, StageCommand, Studio};

/// The ship, whose script changes method and tick rate.
fn scripted() -> Studio {
    let text = SCENES.iter().find(|scene| scene.name == "ship").unwrap().text;
    let script =
        "[[command]]\nat_s = 1.5\ntick_hz = 100\n[[command]]\nat_s = 1.51\nmethod = \"rk4\"\n";
    Studio::new(Scene::parse("ship.toml", &format!("{text}{script}")).unwrap())
}

fn settings(studio: &Studio) -> (f64, f64, &'static str) {
    let method = studio.entries()[studio.active()].method.id;
    (studio.clock().tick_hz().hz(), studio.race().tick_hz().hz(), method)
}

#[test]
fn a_restart_undoes_the_actions_of_the_script() {
    let mut studio = scripted();
    (0..10).for_each(|_| studio.tick());
    assert_eq!(settings(&studio), (100.0, 100.0, "rk4"));
    studio.apply(StageCommand::Restart);
    assert_eq!(settings(&studio), (2.0, 2.0, "explicit-euler"));
    assert_eq!((studio.race().tick(), studio.race().t()), (0, 0.0));
    (0..10).for_each(|_| studio.tick());
    assert_eq!(settings(&studio), (100.0, 100.0, "rk4"), "the script plays again");
}

#[test]
fn a_restart_keeps_the_chosen_rate_and_method() {
    let mut studio = scripted();
    (0..10).for_each(|_| studio.tick());
    studio.apply(StageCommand::TickHz(7.into()));
    studio.apply(StageCommand::Pick(2));
    studio.apply(StageCommand::Restart);
    assert_eq!(settings(&studio), (7.0, 7.0, "improved-euler"));
}

#[test]
fn a_restart_clears_the_pending_time_and_keeps_the_speed() {
    let mut studio = scripted();
    studio.apply(RunCommand::SpeedPercent(50));
    studio.advance(200_000_000);
    studio.advance(200_000_000);
    assert_eq!((studio.race().tick(), studio.clock().alpha()), (0, 0.4));
    studio.apply(StageCommand::Restart);
    assert_eq!((studio.clock().alpha(), studio.clock().speed_percent()), (0.0, 50));
    studio.advance(0);
    assert_eq!(studio.race().tick(), 0);
    for _ in 0..4 {
        studio.advance(249_000_000);
    }
    assert_eq!(studio.race().tick(), 0, "a tick takes a second of real time at this speed");
    studio.advance(4_000_000);
    assert_eq!(studio.race().tick(), 1);
}

#[test]
fn a_frame_runs_no_further_than_its_limit() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.advance_in_time(7, 100_000_000, &mut || true, &mut ());
    assert_eq!(studio.race().tick(), 6);
    studio.advance_in_time(7, 100_000_000, &mut || true, &mut ());
    assert_eq!((studio.race().tick(), studio.run().end()), (7, 7));
    studio.advance_in_time(7, 100_000_000, &mut || true, &mut ());
    assert_eq!(studio.race().tick(), 7);
}

#[test]
fn undo_brings_back_an_edited_run_after_a_restart() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..40).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Kick(1.0)));
    (0..40).for_each(|_| studio.tick());
    let (hash, journal) = (studio.race().state_hash(), studio.race().journal().clone());
    studio.apply(StageCommand::Restart);
    assert_eq!(studio.viewer.notice, None, "the hint leads on");
    assert!(studio.hint().is_some());
    (0..3).for_each(|_| studio.tick());
    // A second restart is not about the run of three ticks.
    studio.apply(StageCommand::Restart);
    (0..5).for_each(|_| studio.tick());
    studio.apply(RunCommand::Undo);
    assert_eq!((studio.race().tick(), studio.race().state_hash()), (80, hash));
    assert_eq!(studio.race().journal(), &journal);
    let notice = studio.viewer.notice.as_deref().unwrap();
    assert!(notice.starts_with("undid: the restart"), "{notice}");
    studio.apply(RunCommand::Seek(40));
    studio.apply(RunCommand::Seek(80));
    assert_eq!(studio.race().state_hash(), hash, "with its past");
    studio.apply(RunCommand::Redo);
    assert_eq!((studio.race().tick(), studio.race().journal().rows().len()), (5, 0));
}

#[test]
fn a_frame_out_of_time_drops_its_remaining_ticks() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    let mut made = 0;
    let due = studio.advance_in_time(
        u64::MAX,
        100_000_000,
        &mut || {
            made += 1;
            made < 2
        },
        &mut (),
    );
    assert_eq!(
        (due.ticks, due.dropped, studio.deck.dropped_ticks(), studio.race().tick()),
        (2, 4, 4, 2)
    );
    let due = studio.advance_in_time(u64::MAX, 50_000_000, &mut || true, &mut ());
    assert_eq!((due.ticks, due.dropped, studio.race().tick()), (3, 0, 5));
}

#[test]
fn an_action_on_a_body_of_the_previous_scene_changes_nothing() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.tick();
    let before = studio.race().state_hash();
    let place = Action::Place { body: 2, q: [1.0].into(), v: [0.0].into() };
    let set = |parameter| Action::Set { body: 2, parameter, value: 3.0 };
    for action in [place, set(0), set(99)] {
        studio.apply(RunCommand::Act(action));
    }
    studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: 99, value: 3.0 }));
    assert_eq!(studio.race().state_hash(), before);
}
