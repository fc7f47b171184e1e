//! A run is a value: a copy continues identically to the bit, and any past tick can be reached again. On random journals; the
//! seed is printed, and `REGATTA_SEED` sets another.

use std::sync::Arc;

use crate::dice::Dice;
use regatta::run::past::{Past, TruthSample};
use regatta::run::{Event, EventKind, Run, SNAPSHOT_BYTES, Session};
use regatta::scene::{Action, LaneId, LaneSpec, Scene};
use regatta::sim::IMPACTS;
use regatta::sim::bodies::BODIES;
use regatta::sim::integrators::GENERAL_METHODS;
use regatta::studio::{Command, RunCommand, StageCommand, Studio};

use crate::scenes::edited;

impl Dice {
    fn spec(&mut self) -> LaneSpec {
        let method = &GENERAL_METHODS[self.below(GENERAL_METHODS.len())];
        let tolerance = (method.tolerance.is_some() && self.part() < 0.5)
            .then(|| 10.0_f64.powf(self.between(-8.0, -3.0)));
        LaneSpec {
            method,
            substeps: 1 + self.below(3) as u32,
            tolerance,
            ..LaneSpec::plain(method)
        }
    }
}

/// A scene of one or two bodies and up to three lanes. The bodies are drawn from all kinds, kinds without a closed form
/// more rarely, because their truth takes long.
fn scene(dice: &mut Dice, n: usize) -> Scene {
    let kinds = ["spring", "ship", "chain", "orbit", "spring", "ship"];
    let first = if n.is_multiple_of(40) {
        "helm"
    } else if n % 40 == 20 {
        "pendulum"
    } else if n % 40 == 10 {
        "follow"
    } else if n % 20 == 15 {
        "ball"
    } else if n % 40 == 30 {
        "tumble"
    } else {
        kinds[n % 6]
    };
    let names = [
        "harbour", "spring", "chain", "orbit", "ship", "pendulum", "helm", "stiff", "follow",
        "ball", "coin",
    ];
    let built_in = |name: &&str| Scene::built_in(name).expect("a built-in scene");
    let all: Vec<Scene> = names.iter().map(built_in).collect();
    let of = |kind: &str| all.iter().flat_map(|s| &s.bodies).find(|b| b.kind.id == kind).cloned();
    let mut bodies = vec![of(first).expect("a body of each kind")];
    if dice.part() < 0.5 {
        let mut second = of(kinds[dice.below(4)]).expect("a body of each kind");
        second.name = "the second".into();
        bodies.push(second);
    }
    let mut lanes: Vec<LaneSpec> = Vec::new();
    while lanes.len() < 1 + n % 3 {
        let mut spec = dice.spec();
        if first == "ball" {
            spec = spec.with_impact(&IMPACTS[dice.below(IMPACTS.len())]);
        }
        if !lanes.contains(&spec) {
            lanes.push(spec);
        }
    }
    edited(&all[0], |scene| {
        (scene.bodies, scene.lanes, scene.opening_method) = (bodies, lanes, None);
        (scene.tick_hz, scene.seconds) = (60.into(), 20.0);
    })
}

/// A random action that is possible in the session's present.
fn action(dice: &mut Dice, session: &Session) -> Action {
    let race = session.race();
    let lane = race.entrants()[dice.below(race.entrants().len())].id;
    let body = dice.below(race.truth().bodies().len());
    match dice.below(20) {
        0..5 => Action::Lane { lane, spec: dice.spec() },
        5 => Action::Substeps { lane, substeps: 1 + dice.below(4) as u32 },
        6 => Action::Tolerance { lane, tolerance: 10.0_f64.powf(dice.between(-8.0, -3.0)) },
        7..9 => Action::TickHz([30, 49, 60, 120, 240][dice.below(5)].into()),
        9..11 => Action::Throttle(dice.between(-1.0, 1.0)),
        11..13 => Action::Rudder(dice.between(-1.0, 1.0)),
        13..15 => Action::Kick(dice.between(-1.0, 1.0)),
        15..17 => {
            let kind = &race.truth().bodies()[body].kind;
            let parameter = dice.below(kind.parameters.len());
            let value = race.values(body)[parameter] * dice.between(0.8, 1.25);
            Action::Set { body, parameter, value }
        }
        17 => Action::Method(&GENERAL_METHODS[dice.below(GENERAL_METHODS.len())]),
        18 => {
            let truth = &race.truth().bodies()[body].stepper;
            let factor = dice.between(0.9, 1.1);
            let moved = |values: &[f64]| values.iter().map(|x| factor * x).collect();
            Action::Place { body, q: moved(truth.q()), v: moved(truth.v()) }
        }
        _ if dice.part() < 0.1 => Action::Solo { lane },
        _ => Action::Kick(0.1),
    }
}

fn start(dice: &mut Dice, n: usize) -> Session {
    let scene = Arc::new(scene(dice, n));
    match n % 4 {
        0 => Session::solo(scene, 0),
        _ => Session::racing(scene),
    }
}

fn hashes(session: &Session) -> Vec<u64> {
    session.race().lane_hashes().collect()
}

/// The ticks of the actions, in order.
fn ticks_of_actions(dice: &mut Dice, ticks: u64) -> Vec<u64> {
    let mut at: Vec<u64> = (0..40).map(|_| dice.below(ticks as usize) as u64).collect();
    at.sort_unstable();
    at
}

const TICKS: u64 = 5_000;
/// An unoptimised build would take a quarter of an hour for all.
const JOURNALS: usize = if cfg!(debug_assertions) { 40 } else { 200 };

/// Runs journals `from`, `from + 2` and so on: whole, from copies made on the way, and again from the journal.
fn journals(from: usize) {
    let mut dice = Dice::new(from as u64);
    for n in (from..JOURNALS).step_by(2) {
        let begun = start(&mut dice, n);
        let mut whole = begun.clone();
        let mut at = ticks_of_actions(&mut dice, TICKS).into_iter().peekable();
        let mut cuts: Vec<u64> = (0..20).map(|_| dice.below(TICKS as usize) as u64).collect();
        cuts.sort_unstable();
        cuts.push(TICKS);
        let mut copies: Vec<Session> = Vec::new();
        let mut marks: Vec<(u64, Vec<u64>)> = Vec::new();
        for tick in 0..TICKS {
            // As the tick is reached, before anything is done there.
            if cuts.contains(&tick) {
                copies.push(whole.clone());
                marks.push((tick, hashes(&whole)));
            }
            while at.next_if_eq(&tick).is_some() {
                let action = action(&mut dice, &whole);
                whole.act(action);
            }
            whole.tick(&mut ());
        }
        marks.push((TICKS, hashes(&whole)));
        let journal = whole.journal().clone();
        assert!(journal.rows().len() > 10, "journal {n}");

        // From each cut to the next but two, the last ones to the end, by the journal of the whole.
        for (i, mut copy) in copies.into_iter().enumerate() {
            copy.follow(journal.clone());
            for (tick, hashes_then) in marks.iter().skip(i).take(4) {
                copy.run(tick - copy.race().tick());
                assert_eq!(&hashes(&copy), hashes_then, "journal {n} from cut {i} to {tick}");
            }
        }

        let mut again = begun;
        again.follow(journal);
        for (tick, hashes_then) in &marks {
            again.run(tick - again.race().tick());
            assert_eq!(&hashes(&again), hashes_then, "journal {n} again, to {tick}");
        }
        written_and_read(n, &whole);
    }
}

/// Runs the scene in the text of a recording, and compares all its checks.
fn written_and_read(n: usize, whole: &Session) {
    let text = whole.recording(TICKS).to_toml();
    let read = Scene::parse("recording.toml", &text);
    let read = read.unwrap_or_else(|errors| panic!("journal {n}: {errors}"));
    assert_eq!(read.to_toml(), text, "journal {n}");
    let last = read.checks.last().expect("a check at the end");
    assert_eq!((last.tick, hashes(whole).last()), (TICKS, Some(&last.hash)), "journal {n}");
    let mut session = Session::racing(read.clone().into());
    for check in &read.checks {
        session.run(check.tick - session.race().tick());
        let hash = session.race().lane_hash(check.lane);
        assert_eq!(hash, Some(check.hash), "journal {n}: {check:?}");
    }
}

#[test]
fn random_journals_replay_to_the_bit_from_copies_and_recordings() {
    journals(0);
}

#[test]
fn more_random_journals_replay_to_the_bit_from_copies_and_recordings() {
    journals(1);
}

/// The bits of everything that is drawn of a run.
#[derive(Debug, PartialEq)]
struct Shown {
    tick: u64,
    hashes: Vec<u64>,
    evaluations: Vec<u64>,
    histories: Vec<Vec<String>>,
    truth: Vec<Vec<TruthSample>>,
}

fn shown(timeline: &Run) -> Shown {
    let race = timeline.session().race();
    let past: &Past = timeline.past();
    let samples = |index: usize| {
        let histories = past.histories(race.entrants()[index].id).iter();
        histories.map(|history| format!("{:?}", history.samples().collect::<Vec<_>>())).collect()
    };
    Shown {
        tick: race.tick(),
        hashes: race.lane_hashes().collect(),
        evaluations: race.entrants().iter().map(|entrant| entrant.lane.evaluations()).collect(),
        histories: (0..race.entrants().len()).map(samples).collect(),
        truth: past.truth_curves().iter().map(|curve| curve.samples().copied().collect()).collect(),
    }
}

#[test]
fn a_seek_reaches_the_state_of_a_plain_run_from_any_tick() {
    let mut dice = Dice::new(2);
    for n in 0..16 {
        let mut timeline = Run::new(start(&mut dice, n));
        let mut at = ticks_of_actions(&mut dice, 2000).into_iter().peekable();
        let wanted: Vec<u64> = (0..12).map(|_| dice.below(2000) as u64).collect();
        let mut ran = Vec::new();
        for tick in 0..2000 {
            if wanted.contains(&tick) {
                ran.push(shown(&timeline));
            }
            while at.next_if_eq(&tick).is_some() {
                let action = action(&mut dice, timeline.session());
                timeline.act(action);
            }
            timeline.tick(&mut ());
        }
        ran.push(shown(&timeline));
        for _ in 0..15 {
            let then = &ran[dice.below(ran.len())];
            timeline.seek(then.tick);
            let now = shown(&timeline);
            assert!(now == *then, "scene {n}, tick {}: {}", then.tick, difference(&now, then));
        }
    }
}

fn difference(found: &Shown, wanted: &Shown) -> String {
    let lengths = |s: &Shown| s.truth.iter().map(Vec::len).collect::<Vec<_>>();
    let same_histories: Vec<bool> = found
        .histories
        .iter()
        .flatten()
        .zip(wanted.histories.iter().flatten())
        .map(|(a, b)| a == b)
        .collect();
    format!(
        "ticks {} and {}, hashes {}, evaluations {}, histories {same_histories:?}, truth {:?} and {:?}: {}",
        found.tick,
        wanted.tick,
        found.hashes == wanted.hashes,
        found.evaluations == wanted.evaluations,
        lengths(found),
        lengths(wanted),
        found.truth == wanted.truth,
    )
}

#[test]
fn an_action_in_the_past_begins_a_new_future_and_undo_restores_the_old_one() {
    let mut dice = Dice::new(3);
    for n in 0..8 {
        let mut studio = Studio::new(scene(&mut dice, n));
        (0..700).for_each(|_| studio.tick());
        studio.apply(RunCommand::Act(Action::Kick(0.3)));
        (0..300).for_each(|_| studio.tick());
        let end = shown(studio.run());
        studio.apply(RunCommand::Seek(400));
        assert_eq!((studio.run().end(), studio.run().is_in_past()), (1000, true));
        // An action without effect keeps the future.
        let throttle = studio.race().throttle();
        studio.apply(RunCommand::Act(Action::Throttle(throttle)));
        assert_eq!(
            (studio.run().end(), studio.run().undoes()),
            (1000, Some("the kick (tick 700)"))
        );

        let rows = studio.run().session().journal().rows().len();
        studio.apply(RunCommand::Act(Action::Kick(-0.4)));
        assert_eq!((studio.run().end(), studio.run().is_in_past()), (400, false));
        assert_eq!(studio.run().session().journal().rows().len(), rows, "one came, one went");
        let notice = studio.viewer.notice.as_deref().expect("it says so");
        assert!(notice.contains("Ctrl Z"), "{notice}");
        (0..900).for_each(|_| studio.tick());
        assert_ne!(shown(studio.run()).hashes, end.hashes);

        studio.apply(RunCommand::Undo);
        assert_eq!((studio.race().tick(), studio.run().end()), (400, 1000));
        studio.apply(RunCommand::Seek(1000));
        let found = shown(studio.run());
        assert!(found == end, "scene {n}: {}", difference(&found, &end));
        studio.apply(RunCommand::Undo);
        assert_eq!((studio.race().tick(), studio.run().end()), (700, 700), "before the first kick");
        assert_eq!(studio.run().undoes(), None);
        studio.apply(RunCommand::Undo);
        assert_eq!(studio.run().end(), 700, "there is no more to undo");
        studio.apply(RunCommand::Redo);
        studio.apply(RunCommand::Seek(1000));
        let found = shown(studio.run());
        assert!(found == end, "scene {n}: {}", difference(&found, &end));
        assert_eq!(studio.run().redoes(), Some("the kick (tick 400)"));
    }
}

#[test]
fn snapshots_of_ten_hours_stay_within_their_memory_limit() {
    // At 30 Hz, ten hours are a million ticks.
    let scene = edited(&Scene::built_in("spring").unwrap(), |scene| scene.tick_hz = 30.into());
    let limit = 1 << 20;
    let mut timeline = Run::with_limit(Session::racing(scene.into()), limit);
    let mut most = 0;
    for _ in 0..10 * 3600 * 30 {
        timeline.tick(&mut ());
        most = most.max(timeline.bytes());
    }
    assert!((limit / 4..=limit).contains(&most), "{most} of {limit} bytes");
    let end = timeline.session().race().state_hash();
    timeline.seek(12_345);
    assert!(timeline.bytes() <= limit);
    timeline.seek(u64::MAX);
    assert_eq!(timeline.session().race().state_hash(), end);
    assert!(SNAPSHOT_BYTES == 64 << 20 && timeline.limit() == limit);
}

#[test]
fn every_kind_of_body_is_among_the_random_scenes() {
    let mut dice = Dice::new(4);
    let scenes: Vec<Scene> = (0..200).map(|n| scene(&mut dice, n)).collect();
    for kind in BODIES.iter() {
        assert!(
            scenes.iter().any(|s| s.bodies.iter().any(|b| b.kind.id == kind.id)),
            "{}",
            kind.id
        );
    }
}

#[test]
fn events_are_sorted_by_tick_and_come_and_go_with_their_future() {
    let scene = Scene::built_in("stiff").unwrap();
    let mut timeline = Run::new(Session::racing(scene.into()));
    (0..50).for_each(|_| timeline.tick(&mut ()));
    assert!(timeline.act(Action::Kick(1.0)));
    (0..250).for_each(|_| timeline.tick(&mut ()));
    let events = timeline.events();
    let done = |event: &Event| matches!(event.kind, EventKind::Done { .. });
    assert_eq!(events.iter().filter(|event| done(event)).map(|e| e.tick).collect::<Vec<_>>(), [50]);
    let race = timeline.session().race();
    let halts = race.entrants().iter().filter_map(|e| Some((e.id, e.lane.halted()?)));
    let halts: Vec<(u64, LaneId)> = halts.map(|(lane, halt)| (halt.tick, lane)).collect();
    assert!(halts.len() >= 2, "explicit and improved Euler are lost: {halts:?}");
    let mut told: Vec<(u64, LaneId)> = Vec::new();
    for event in &events {
        if let EventKind::Halted { lane: Some(lane), body: 0, is_blow_up: true } = event.kind {
            told.push((event.tick, lane));
        }
    }
    told.sort_unstable_by_key(|&(_, lane)| lane);
    assert_eq!(told, halts);
    assert!(events.is_sorted_by_key(|event| event.tick));

    timeline.seek(100);
    assert_eq!(timeline.events(), events, "to look at the past changes none of it");
    timeline.act(Action::Kick(0.1));
    let ticks: Vec<u64> = timeline.events().iter().map(|event| event.tick).collect();
    assert_eq!(ticks, [50, 100]);
    assert!(timeline.undo());
    assert_eq!((timeline.events(), timeline.end()), (events, 300));
}

#[test]
fn undo_also_restores_the_settings_of_the_next_start() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.apply(StageCommand::ToggleRace);
    (0..200).for_each(|_| studio.tick());
    let substeps = |studio: &Studio| -> Vec<u32> {
        studio.race().entrants().iter().map(|entrant| entrant.lane.substeps()).collect()
    };
    let (mass, plain, asked) =
        (studio.race().values(0)[0], substeps(&studio), studio.analysis_request());
    for command in [
        Command::Run(RunCommand::Act(Action::Set { body: 0, parameter: 0, value: 2.5 })),
        Command::Stage(StageCommand::TickHz(50.into())),
        Command::Run(RunCommand::ToggleEqualCost),
    ] {
        studio.apply(RunCommand::Seek(100));
        studio.apply(command);
        studio.apply(RunCommand::Undo);
        assert_eq!((studio.race().values(0)[0], studio.scene().bodies[0].values[0]), (mass, mass));
        assert!(studio.analysis_request() == asked);
    }
    studio.apply(RunCommand::ToggleEqualCost);
    assert_ne!(substeps(&studio), plain, "what was undone is not taken back, but done");
    studio.apply(RunCommand::Undo);
    studio.apply(StageCommand::Restart);
    assert_eq!((studio.race().tick_hz(), substeps(&studio)), (60.into(), plain));
}

#[test]
fn a_parameter_that_acts_at_the_start_does_not_change_the_run_or_its_future() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..200).for_each(|_| studio.tick());
    studio.apply(RunCommand::Seek(100));
    studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: 3, value: 0.25 }));
    assert_eq!((studio.run().end(), studio.run().undoes()), (200, Some("the start value")));
    assert!(studio.run().session().journal().rows().is_empty());
    studio.apply(StageCommand::Restart);
    assert_eq!(studio.race().truth().bodies()[0].stepper.q(), [0.25]);
    studio.apply(RunCommand::Undo);
    assert_eq!((studio.race().tick(), studio.run().end()), (100, 200));
    studio.apply(RunCommand::Undo);
    assert_ne!(studio.scene().bodies[0].values[3], 0.25);
}
