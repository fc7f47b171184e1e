//! Every change by a person can be undone and redone, in one order.

use regatta::scene::{Action, Scene};
use regatta::sim::TickRate;
use regatta::studio::{Command, RunCommand, StageCommand, Studio, ViewCommand};

use crate::dice::Dice;

fn studio(scene: &str) -> Studio {
    Studio::new(Scene::built_in(scene).unwrap())
}

fn method(studio: &Studio) -> &'static str {
    studio.race().entrants()[0].lane.solver().method().unwrap().id
}

/// The state of a run up to its end, from any present tick, and the scene of its next start.
#[derive(Debug, PartialEq)]
struct Whole {
    rows: usize,
    end: u64,
    state: u64,
    tick_hz: TickRate,
    methods: Vec<(&'static str, u32)>,
    scene: String,
}

fn whole(studio: &mut Studio) -> Whole {
    let tick = studio.race().tick();
    // From elsewhere, so that no action at the end itself is done yet.
    studio.apply(RunCommand::Seek(0));
    studio.apply(RunCommand::Seek(u64::MAX));
    let race = studio.race();
    let lanes = race.entrants().iter();
    let whole = Whole {
        rows: race.journal().rows().len(),
        end: studio.run().end(),
        state: race.state_hash(),
        tick_hz: race.tick_hz(),
        methods: lanes.map(|e| (e.lane.solver().method().unwrap().id, e.lane.substeps())).collect(),
        scene: studio.scene().to_toml(),
    };
    studio.apply(RunCommand::Seek(tick));
    whole
}

#[test]
fn an_undone_switch_in_the_past_is_not_in_the_next_start() {
    let mut studio = studio("spring");
    (0..200).for_each(|_| studio.tick());
    studio.apply(RunCommand::Seek(100));
    studio.apply(StageCommand::Pick(1));
    assert_eq!(method(&studio), "semi-implicit-euler");
    studio.apply(RunCommand::Undo);
    assert_eq!((method(&studio), studio.run().end()), ("explicit-euler", 200));
    studio.apply(StageCommand::Restart);
    assert_eq!(method(&studio), "explicit-euler");
}

#[test]
fn every_kind_of_change_is_undone_and_redone_one_by_one() {
    let mut studio = studio("harbour");
    let place = Action::Place { body: 0, q: [0.5].into(), v: [0.0].into() };
    let mut sides = Vec::new();
    for command in [
        Command::Stage(StageCommand::Pick(1)),
        Command::Run(RunCommand::Act(Action::Set { body: 0, parameter: 1, value: 80.0 })),
        Command::Run(RunCommand::Act(Action::Set { body: 0, parameter: 3, value: 0.25 })),
        Command::Run(RunCommand::Act(place)),
        Command::Run(RunCommand::Act(Action::Kick(1.0))),
        Command::Stage(StageCommand::TickHz(30.into())),
        Command::Stage(StageCommand::ToggleRace),
        Command::Run(RunCommand::ToggleEqualCost),
        Command::Run(RunCommand::Seconds(12.0)),
        Command::Stage(StageCommand::Restart),
        Command::Run(RunCommand::Act(Action::Throttle(0.5))),
    ] {
        (0..50).for_each(|_| studio.tick());
        let before = whole(&mut studio);
        studio.apply(command);
        let after = whole(&mut studio);
        assert_ne!(before, after);
        sides.push((before, after));
    }
    for (before, after) in sides.iter().rev() {
        studio.apply(RunCommand::Undo);
        let now = whole(&mut studio);
        match before.state == after.state {
            // The change was one of the next start: the run continues.
            true => assert_eq!(now.scene, before.scene),
            false => assert_eq!(now, *before),
        }
    }
    assert_eq!((studio.run().undoes(), studio.race().tick()), (None, 50));
    for (_, after) in &sides {
        studio.apply(RunCommand::Redo);
        let again = whole(&mut studio);
        assert_eq!((again.rows, &again.scene), (after.rows, &after.scene));
    }
    assert_eq!(studio.run().redoes(), None);
    studio.apply(RunCommand::Undo);
    studio.apply(RunCommand::Act(Action::Kick(1.0)));
    assert_eq!(studio.run().redoes(), None, "another change was made");
}

#[test]
fn each_drag_of_a_slider_is_one_change() {
    let mut studio = studio("spring");
    let stiffness = |studio: &Studio| studio.race().values(0)[1];
    let drag = |studio: &mut Studio, to: f64| {
        studio.apply(ViewCommand::PointerDown(true));
        for part in 1..=10 {
            let value = to * (1.0 + f64::from(part) / 10.0);
            studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: 1, value }));
            // The cross of the stability map sets the rate too.
            studio.apply(StageCommand::TickHz((60 + part).into()));
            (0..3).for_each(|_| studio.tick());
        }
        studio.apply(ViewCommand::PointerDown(false));
    };
    (0..50).for_each(|_| studio.tick());
    let first = stiffness(&studio);
    drag(&mut studio, 20.0);
    let second = stiffness(&studio);
    drag(&mut studio, 30.0);
    assert_ne!(stiffness(&studio), second);
    studio.apply(RunCommand::Undo);
    assert_eq!(
        (stiffness(&studio), studio.race().tick(), studio.race().tick_hz()),
        (second, 80, 70.into())
    );
    studio.apply(RunCommand::Undo);
    assert_eq!(
        (stiffness(&studio), studio.race().tick(), studio.race().tick_hz()),
        (first, 50, 60.into())
    );
    assert_eq!((studio.run().undoes(), studio.scene().bodies[0].values[1]), (None, first));
    studio.apply(RunCommand::Redo);
    assert_eq!((studio.run().end(), studio.run().redoes().is_some()), (80, true));
    studio.apply(RunCommand::Seek(80));
    assert_eq!(stiffness(&studio), second);
}

#[test]
fn random_changes_are_undone_and_redone_to_the_bit() {
    let mut dice = Dice::new(7);
    for _ in 0..8 {
        let mut studio = studio("harbour");
        let mut befores = Vec::new();
        let mut below = |limit: u64| dice.below(limit as usize) as u64;
        for _ in 0..12 {
            (0..below(90)).for_each(|_| studio.tick());
            if below(2) == 0 {
                studio.apply(RunCommand::Seek(below(studio.run().end() + 1)));
            }
            let (tick, before) = (studio.race().tick(), whole(&mut studio));
            let command = match below(6) {
                0 => Command::Run(RunCommand::Act(Action::Kick(0.5))),
                1 => Command::Stage(StageCommand::Pick(below(5) as usize)),
                2 => Command::Stage(StageCommand::TickHz((20 + below(60) as u32).into())),
                3 => Command::Stage(StageCommand::ToggleRace),
                4 => Command::Stage(StageCommand::Restart),
                _ => {
                    let value = 20.0 + below(90) as f64;
                    Command::Run(RunCommand::Act(Action::Set { body: 0, parameter: 1, value }))
                }
            };
            let undoes = studio.run().undoes().map(str::to_owned);
            studio.apply(command.clone());
            let is_kept = studio.run().undoes() != undoes.as_deref();
            // A restart of a run in which nothing was done is no change.
            if if command == Command::Stage(StageCommand::Restart) {
                is_kept
            } else {
                whole(&mut studio) != before
            } {
                befores.push((tick, before));
            }
        }
        let last = whole(&mut studio);
        let mut undone = 0;
        while studio.run().undoes().is_some() {
            studio.apply(RunCommand::Undo);
            let (tick, before) = befores.pop().expect("as many as were made");
            assert_eq!((studio.race().tick(), whole(&mut studio)), (tick, before));
            undone += 1;
        }
        assert!(undone >= 2, "{undone}");
        (0..undone).for_each(|_| _ = studio.apply(RunCommand::Redo));
        assert_eq!(whole(&mut studio), last);
    }
}

#[test]
fn undo_entries_stay_within_the_rewind_memory() {
    let mut studio = studio("harbour");
    studio.deck.set_rewind_bytes(1 << 20);
    for n in 0..60_u32 {
        (0..120).for_each(|_| studio.tick());
        studio.apply(RunCommand::Act(Action::Kick(1.0)));
        if n % 7 == 0 {
            studio.apply(StageCommand::Restart);
        }
        assert!(studio.run().bytes() <= 1 << 20, "{}", studio.run().bytes());
    }
    assert_eq!(studio.run().undoes(), Some("the kick (tick 360)"));
    for (limit, is_kept) in [(64 << 20, true), (1 << 20, false)] {
        studio.deck.set_rewind_bytes(limit);
        studio.apply(RunCommand::Act(Action::Kick(2.0)));
        let before = studio.run().bytes();
        studio.apply(StageCommand::Restart);
        assert_eq!(studio.run().undoes().is_some(), is_kept, "{limit}");
        let is_counted = studio.run().bytes() > before + (1 << 20);
        assert_eq!(is_counted, is_kept, "the drawn past of a run that is kept counts: {limit}");
    }
}
