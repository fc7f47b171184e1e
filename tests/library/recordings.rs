//! A run as a scene file: it is read back unchanged, repeats the run to the bit, and contains its actions.

use regatta::run::race::{Mode, equal_cost, lanes_that_race};
use regatta::run::{Journal, RecordingError, Session, link};
use regatta::scene::{Action, LaneId, LaneSpec, SCENES, Scene, Scripted, Swing};
use regatta::sim::integrators::{GENERAL_METHODS, method};
use regatta::studio::{Command, RunCommand, StageCommand, Studio, open_file};

use crate::scenes::edited;

fn built_in(name: &str) -> Scene {
    Scene::built_in(name).expect("a built-in scene")
}

fn parsed(text: &str) -> Scene {
    Scene::parse("recording.toml", text).unwrap_or_else(|errors| panic!("{errors}\n{text}"))
}

/// The lanes that differ from the checks of a recording, run as `regatta verify` runs it.
pub(crate) fn wrong_lanes(scene: &Scene) -> Vec<LaneId> {
    let mut session = Session::racing(scene.clone().into());
    let mut wrong = Vec::new();
    for check in &scene.checks {
        session.run(check.tick - session.race().tick());
        if session.race().lane_hash(check.lane) != Some(check.hash) {
            wrong.push(check.lane);
        }
    }
    wrong
}

#[test]
fn every_built_in_scene_survives_writing_and_reading() {
    for built_in in SCENES {
        let scene = Scene::built_in(built_in.name).unwrap();
        let mut again = parsed(&scene.to_toml());
        (again.name, again.source) = (scene.name.clone(), scene.source.clone());
        assert_eq!(format!("{again:?}"), format!("{scene:?}"));
    }
}

#[test]
fn difficult_texts_and_numbers_survive_writing_and_reading() {
    let mut scene = built_in("helm");
    scene.title = r#"a "quoted" \ title"#.into();
    scene.bodies[0].name = r"c:\helm".into();
    scene.bodies[0].values[0] = 1.0 / 3.0;
    scene.bodies[0].values[6] = -1e-300;
    scene.bodies[0].values[7] = 1e15;
    scene.lanes = GENERAL_METHODS.iter().map(LaneSpec::plain).collect();
    scene.lanes[2].substeps = 7;
    let adaptive = scene.lanes.iter().position(|spec| spec.method.tolerance.is_some()).unwrap();
    scene.lanes[adaptive].tolerance = Some(1e-14);
    let again = parsed(&scene.to_toml());
    assert_eq!((&again.title, &again.bodies[0].name), (&scene.title, &scene.bodies[0].name));
    let bits = |scene: &Scene| -> Vec<u64> {
        scene.bodies[0].values.iter().map(|value| value.to_bits()).collect()
    };
    assert_eq!((bits(&again), again.lanes), (bits(&scene), scene.lanes));
}

/// A scene as a person writes it, in an order of their own.
const BY_HAND: &str = r#"# Of the harbour's west side.
seconds   = 5   # a short one
title = 'A pair'

# As in the game.
tick_hz = 60
methods = [
  "rk4", # the one to beat
  "semi-implicit-euler",
]

[[command]]   # at half a second
at_s = 0.5
kick = 1

# The heavy one comes first.
[[spring]]
stiffness_n_per_m = 4e1 # soft
mass_kg = 1
name = "heavy"

[[ship]]
thrust_n = 100     # a pull
drag_n_s_per_m = 10
mass_kg = 10

[[spring]]
name = "light"
mass_kg = 0.5
stiffness_n_per_m = 40
"#;

/// The lines that one text has and the other has not.
fn other_lines<'t>(text: &'t str, than: &str) -> Vec<&'t str> {
    text.lines().filter(|line| !than.lines().any(|other| other == *line)).collect()
}

#[test]
fn a_saved_scene_keeps_its_authors_comments_and_order() {
    let scene = parsed(BY_HAND);
    assert_eq!(scene.to_saved_toml(), BY_HAND, "what has not changed");
    assert_eq!(parsed(&BY_HAND.replace('\n', "\r\n")).to_saved_toml(), BY_HAND);

    let mut stiffer = scene.clone();
    stiffer.bodies[0].values[1] = 55.5;
    let saved = stiffer.to_saved_toml();
    let line = "stiffness_n_per_m = 4e1 # soft";
    assert_eq!(saved, BY_HAND.replace(line, "stiffness_n_per_m = 55.5 # soft"));

    // A key that the author omitted is added to the body's table once it is needed.
    let mut damped = scene.clone();
    damped.bodies[2].values[2] = 0.25;
    let saved = damped.to_saved_toml();
    assert_eq!(saved, format!("{BY_HAND}damping_n_s_per_m = 0.25\n"));

    for built_in in SCENES {
        assert_eq!(Scene::built_in(built_in.name).unwrap().to_saved_toml(), built_in.text);
    }
}

#[test]
fn a_recording_of_a_scene_with_comments_keeps_them_and_repeats_its_run() {
    let mut studio = Studio::new(parsed(BY_HAND));
    studio.apply(StageCommand::ToggleRace);
    studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: 1, value: 55.5 }));
    studio.apply(StageCommand::Restart);
    (0..45).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Kick(2.0)));
    (0..45).for_each(|_| studio.tick());
    let text = studio.deck.recording().unwrap();
    assert_eq!(
        other_lines(BY_HAND, &text),
        [
            "seconds   = 5   # a short one",
            "[[command]]   # at half a second",
            "at_s = 0.5",
            "kick = 1",
            "stiffness_n_per_m = 4e1 # soft"
        ]
    );
    let new = other_lines(&text, BY_HAND);
    assert_eq!(new[..3], ["seconds   = 1.5   # a short one", "[[command]]", "tick = 30"], "{text}");
    let scene = parsed(&text);
    assert_eq!((scene.script.len(), scene.bodies[0].values[1]), (2, 55.5));
    assert!(wrong_lanes(&scene).is_empty());
    assert_eq!(scene.to_saved_toml(), text, "and is saved as it is");
}

#[test]
fn a_scene_without_source_text_is_saved_plainly() {
    let text = "title = 'T'\ntick_hz = 60\nlane = [{ method = 'rk4' }]\n\
        ship = [{ thrust_n = 1, drag_n_s_per_m = 1, mass_kg = 1 }] # one\n\
        [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\n";
    let mut scene = parsed(text);
    assert_eq!(scene.to_saved_toml(), text);
    scene.bodies[0].values[0] = 2.0;
    let saved = scene.to_saved_toml();
    assert_eq!(saved, scene.to_toml());
    let rk4 = LaneSpec::plain(method("rk4").unwrap());
    scene.lanes = vec![LaneSpec { substeps: 3, ..rk4 }, rk4];
    assert_eq!(parsed(&scene.to_saved_toml()).lanes, scene.lanes);
}

/// The harbour in solo mode, after an action of every kind.
fn flown() -> Studio {
    let mut studio = Studio::new(built_in("harbour"));
    let rk4 = LaneSpec { substeps: 3, ..LaneSpec::plain(method("rk4").unwrap()) };
    let actions = [
        Action::Set { body: 0, parameter: 1, value: 90.0 },
        Action::Kick(0.5),
        Action::Lane { lane: LaneId(1), spec: rk4 },
        Action::TickHz(50.into()),
        Action::Place { body: 1, q: [0.25].into(), v: [-1.5].into() },
        Action::Throttle(-0.5),
        Action::Substeps { lane: LaneId(1), substeps: 2 },
        Action::Lane {
            lane: LaneId(1),
            spec: LaneSpec::plain(method("dormand-prince-54").unwrap()),
        },
        Action::Tolerance { lane: LaneId(1), tolerance: 1e-7 },
    ];
    for action in actions {
        (0..25).for_each(|_| studio.tick());
        studio.apply(RunCommand::Act(action));
    }
    (0..25).for_each(|_| studio.tick());
    studio
}

/// The ticks of a scene's script.
fn ticks(scene: &Scene) -> Vec<u64> {
    let journal = Journal::of_script(&scene.script, scene.tick_hz);
    journal.rows().iter().map(|row| row.tick).collect()
}

#[test]
fn a_recording_has_all_actions_and_repeats_the_run_to_the_bit() {
    let studio = flown();
    let scene = parsed(&studio.deck.recording().unwrap());
    assert_eq!(ticks(&scene), (1..=9).map(|n| 25 * n).collect::<Vec<_>>());
    assert_eq!(scene.bodies[0].values, built_in("harbour").bodies[0].values, "as at the start");
    assert_eq!((scene.lanes.len(), scene.tick_hz), (5, 60.into()), "with those beside it");
    assert!((scene.seconds - studio.race().t()).abs() < 1e-12);
    let last = scene.checks.last().unwrap();
    assert_eq!((last.tick, last.lane), (250, LaneId(1)));
    assert_eq!(Some(last.hash), studio.race().lane_hashes().next());
    // In every second at its rate, and at the end.
    let checked: Vec<u64> = scene.checks.iter().map(|check| check.tick).collect();
    assert_eq!(checked, [60, 117, 167, 217, 250]);
    assert!(wrong_lanes(&scene).is_empty());

    let mut other = scene.clone();
    other.bodies[0].values[0] *= 1.0 + f64::EPSILON;
    assert_eq!(wrong_lanes(&other).len(), scene.checks.len(), "the last bit of a mass shows");
}

#[test]
fn a_recording_repeats_its_run_in_a_lab() {
    let studio = flown();
    let mut again = Studio::new(parsed(&studio.deck.recording().unwrap()));
    (0..250).for_each(|_| again.tick());
    assert_eq!(again.race().state_hash(), studio.race().state_hash());
    assert_eq!(
        again.deck.recording().unwrap(),
        studio.deck.recording().unwrap(),
        "and is recorded alike"
    );
}

#[test]
fn a_recording_of_a_scripted_race_that_goes_solo_repeats_it_to_the_bit() {
    let mut studio = Studio::new(built_in("helm"));
    studio.apply(StageCommand::ToggleRace);
    (0..200).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Rudder(0.4)));
    (0..200).for_each(|_| studio.tick());
    let recorded = parsed(&studio.deck.recording().unwrap());
    assert!(recorded.checks.iter().any(|check| check.lane.0 == recorded.lanes.len()));
    assert!(wrong_lanes(&recorded).is_empty());

    studio.apply(StageCommand::Pick(2));
    studio.apply(StageCommand::ToggleRace);
    (0..50).for_each(|_| studio.tick());
    let recorded = parsed(&studio.deck.recording().unwrap());
    let last = recorded.checks.last().unwrap();
    assert_eq!((last.tick, last.lane), (450, LaneId(3)), "its number is that of before");
    assert!(recorded.script.iter().any(|row| row.action == Action::Solo { lane: LaneId(3) }));
    assert!(wrong_lanes(&recorded).is_empty());
}

#[test]
fn a_recorded_race_opens_as_a_race_and_a_recorded_solo_run_does_not() {
    let mut studio = flown();
    let solo = parsed(&studio.deck.recording().unwrap());
    assert!(!solo.opens_as_race);
    studio.apply(StageCommand::ToggleRace);
    (0..90).for_each(|_| studio.tick());
    let text = studio.deck.recording().unwrap();
    assert!(text.contains("\n[race]\nopen = true\n"), "{text}");
    let race = parsed(&text);
    assert!(race.opens_as_race && wrong_lanes(&race).is_empty());

    let mut again = Studio::new(solo.clone());
    open_file(&mut again, "solo.toml".as_ref(), solo);
    assert_eq!(again.mode(), Mode::Solo);
    open_file(&mut again, "race.toml".as_ref(), race);
    assert_eq!(again.mode(), Mode::Race);
    (0..90).for_each(|_| again.tick());
    assert_eq!(again.race().state_hash(), studio.race().state_hash());
    assert_eq!(again.deck.recording().unwrap(), text, "and is recorded alike");
}

#[test]
fn a_restart_keeps_a_persons_settings_but_not_a_scripts() {
    let text = format!(
        "{}\n[[command]]\nat_s = 2.5\nset = {{ body = \"ship\", key = \"mass_kg\", value = 5.0 }}\n",
        built_in("ship").to_toml()
    );
    let mut studio = Studio::new(parsed(&text));
    let mass = studio.race().values(0)[2];
    (0..10).for_each(|_| studio.tick());
    assert_eq!(studio.race().values(0)[2], 5.0);
    studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: 0, value: 123.0 }));
    studio.apply(StageCommand::Restart);
    assert_eq!((studio.race().values(0)[2], studio.race().values(0)[0]), (mass, 123.0));
    assert_eq!(studio.scene().bodies[0].values[0], 123.0);
    // A person's value survives the script's setting of the same parameter.
    studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: 2, value: 7.0 }));
    (0..10).for_each(|_| studio.tick());
    assert_eq!(studio.race().values(0)[2], 7.0);
}

#[test]
fn an_action_that_is_out_of_range_or_does_not_fit_is_ignored() {
    let mut session = Session::racing(built_in("spring").into());
    for action in [
        Action::Set { body: 0, parameter: 0, value: -1.0 },
        Action::Set { body: 0, parameter: 0, value: f64::NAN },
        Action::Set { body: 0, parameter: 99, value: 1.0 },
        Action::Place { body: 0, q: [1.0, 2.0].into(), v: [0.0].into() },
        Action::Place { body: 0, q: [f64::INFINITY].into(), v: [0.0].into() },
        Action::Substeps { lane: LaneId(99), substeps: 2 },
        Action::Tolerance { lane: LaneId(1), tolerance: 1e-3 },
        Action::Rudder(1.0),
        Action::Throttle(0.5),
        Action::Kick(0.0),
        Action::Solo { lane: LaneId(99) },
    ] {
        assert!(!session.act(action.clone()), "{action:?}");
    }
    assert!(session.journal().rows().is_empty());
}

#[test]
fn equal_cost_brings_each_lane_as_close_as_possible_to_the_most_expensive() {
    let scene = built_in("harbour");
    let cost = |spec: &LaneSpec| {
        let mut lane = regatta::run::Lane::new(&scene, spec.solver(), spec.substeps);
        (0..60).for_each(|tick| lane.tick(tick, tick as f64 / 60.0, 1.0 / 60.0));
        lane.evaluations() as f64
    };
    let all: Vec<LaneSpec> = GENERAL_METHODS.iter().map(LaneSpec::plain).collect();
    let dearest = all.iter().map(cost).fold(0.0, f64::max);
    for (plain, equal) in all.iter().zip(equal_cost(&scene, &all, 60)) {
        assert_eq!((equal.method, equal.tolerance), (plain.method, plain.tolerance));
        let off = |substeps: u32| (cost(&LaneSpec { substeps, ..equal }) - dearest).abs();
        let here = off(equal.substeps);
        assert!(here <= off(equal.substeps + 1), "{}: {}", equal.method.id, equal.substeps);
        assert!(equal.substeps == 1 || here <= off(equal.substeps - 1), "{}", equal.method.id);
    }
    let euler = equal_cost(&scene, &[all[0], LaneSpec::plain(method("rk4").unwrap())], 60);
    assert_eq!((euler[0].substeps, euler[1].substeps), (4, 1));
}

#[test]
fn equal_cost_includes_the_effect_of_the_script_on_the_cost() {
    let plain = built_in("spring");
    let parameter = plain.bodies[0].kind.parameter("stiffness_n_per_m").unwrap().0;
    let action = Action::Set { body: 0, parameter, value: 1e6 };
    let script = vec![Scripted { at_s: 200.0 / 60.0, action }];
    let stiffened = edited(&plain, |scene| scene.script = script);
    let lanes = ["rk4", "dormand-prince-54"].map(|id| LaneSpec::plain(method(id).unwrap()));
    let substeps = |scene: &Scene| equal_cost(scene, &lanes, 60)[0].substeps;
    let (soft, stiff) = (substeps(&plain), substeps(&stiffened));
    assert!(soft < 10 && stiff > 3 * soft, "{soft} and {stiff} substeps");
}

#[test]
fn equal_cost_is_switched_on_and_off_by_a_key_and_on_by_a_scene() {
    let mut studio = Studio::new(built_in("spring"));
    studio.apply(StageCommand::ToggleRace);
    let substeps = |studio: &Studio| -> Vec<u32> {
        studio.race().entrants().iter().map(|entrant| entrant.lane.substeps()).collect()
    };
    let before = substeps(&studio);
    (0..10).for_each(|_| studio.tick());
    studio.apply(RunCommand::ToggleEqualCost);
    let equal = substeps(&studio);
    assert!(equal.iter().any(|n| *n > 1), "{equal:?}");
    assert_eq!(studio.race().tick(), 10, "the race goes on");
    studio.apply(RunCommand::ToggleEqualCost);
    assert_eq!(substeps(&studio), before);

    let text = built_in("spring").to_toml();
    let (top, tables) = text.split_once("\n[[").expect("a body");
    let asked = parsed(&format!("{top}\n[race]\nequal_cost = true\n\n[[{tables}"));
    let lanes: Vec<u32> = lanes_that_race(&asked).iter().map(|spec| spec.substeps).collect();
    assert_eq!(lanes, equal);
    let race = Session::racing(asked.clone().into());
    let raced: Vec<u32> =
        race.race().entrants().iter().map(|entrant| entrant.lane.substeps()).collect();
    assert_eq!(raced, equal);
    assert!(parsed(&asked.to_toml()).equal_cost);
}

#[test]
fn lanes_of_one_method_get_their_own_substeps_back_after_equal_cost() {
    let lanes = [1, 4].map(|n| format!("[[lane]]\nmethod = \"rk4\"\nsubsteps = {n}\n"));
    let dearest = "[[lane]]\nmethod = \"implicit-euler\"\n";
    let spring = "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";
    let head = "title = \"t\"\ntick_hz = 60\nseconds = 9\n";
    let mut studio = Studio::new(parsed(&format!("{head}{}{dearest}{spring}", lanes.concat())));
    studio.apply(StageCommand::ToggleRace);
    let substeps = |studio: &Studio| -> Vec<u32> {
        studio.race().entrants().iter().map(|entrant| entrant.lane.substeps()).collect()
    };
    let before = substeps(&studio);
    assert_eq!(before, [1, 4, 1]);
    studio.apply(RunCommand::ToggleEqualCost);
    let equal = substeps(&studio);
    assert_ne!(equal, before);
    studio.apply(RunCommand::ToggleEqualCost);
    assert_eq!(substeps(&studio), before);
}

#[test]
fn a_recording_is_refused_for_too_many_actions_but_not_for_its_length() {
    let mut session = Session::racing(built_in("spring").into());
    (0..40_000).for_each(|n| _ = session.act(Action::Kick(1e-9 * f64::from(n + 1))));
    let error = session.recording_text(10).unwrap_err();
    assert!(matches!(error, RecordingError::TooLong { bytes } if bytes > 1 << 20));
    assert!(error.to_string().contains("record a shorter run"));

    let mut long = Session::racing(built_in("spring").into());
    long.run(3 * 3600 * 60);
    let text = long.recording_text(3 * 3600 * 60).expect("fewer checks than seconds");
    let lanes = long.race().entrants().len();
    let checks = parsed(&text).checks.len();
    assert!((4_000..=8_000 + lanes).contains(&checks), "{checks}");
}

#[test]
fn new_hashes_are_written_into_a_file_without_other_changes() {
    let text = "# mine\ntitle = 'x'\n[[check]] # one\ntick=1\nlane = 1\nhash = '0000000000000000' # a\n\n\
                [[check]]\nhash = \"00000000000000ff\"\ntick = 2\nlane = 1\n";
    let blessed = Scene::with_hashes(text, &[0x12, 0xabc]);
    let wanted = text
        .replace("'0000000000000000'", "\"0000000000000012\"")
        .replace("00000000000000ff", "0000000000000abc");
    assert_eq!(blessed, wanted);
}

#[test]
fn an_action_at_the_last_tick_is_in_the_recording() {
    let mut studio = Studio::new(built_in("spring"));
    studio.apply(RunCommand::Act(Action::Place { body: 0, q: [2.5].into(), v: [0.0].into() }));
    let at_start = parsed(&studio.deck.recording().unwrap());
    assert_eq!(at_start.script.len(), 1);
    (0..10).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Kick(1.0)));
    let recorded = parsed(&studio.deck.recording().unwrap());
    assert_eq!(ticks(&recorded), [0, 10]);
    assert!(wrong_lanes(&recorded).is_empty());
}

#[test]
fn a_recording_keeps_the_hint_and_one_without_a_tick_keeps_the_length() {
    let mut scene = Scene::built_in("spring").unwrap();
    scene.hint = Some("Press `K`.".into());
    let session = Session::racing(scene.clone().into());
    let recorded = session.recording(0);
    assert_eq!((recorded.hint, recorded.seconds), (scene.hint, scene.seconds));
}

#[test]
fn an_action_no_file_could_hold_is_refused_at_once() {
    let lane = LaneId(1);
    let [rk4, adaptive] =
        ["rk4", "dormand-prince-54"].map(|id| LaneSpec::plain(method(id).unwrap()));
    let of_lane = |spec| Action::Lane { lane, spec };
    let set = |value| Action::Set { body: 0, parameter: 1, value };
    let place = |q: f64| Action::Place { body: 0, q: [q].into(), v: [0.0].into() };
    for action in [
        Action::TickHz(0.into()),
        Action::TickHz(10_897.into()),
        Action::Substeps { lane, substeps: 0 },
        Action::Substeps { lane, substeps: 1001 },
        Action::Tolerance { lane, tolerance: 0.0 },
        Action::Tolerance { lane, tolerance: f64::NAN },
        of_lane(LaneSpec { substeps: 0, ..rk4 }),
        of_lane(LaneSpec { tolerance: Some(1e-6), ..rk4 }),
        of_lane(LaneSpec { tolerance: Some(2.0), ..adaptive }),
        of_lane(LaneSpec { joint: Some(Swing { frequency_hz: 1.0, damping_ratio: 0.0 }), ..rk4 }),
        Action::Throttle(f64::NAN),
        Action::Kick(f64::NAN),
        Action::Kick(1e16),
        set(f64::NAN),
        set(f64::INFINITY),
        place(1e39),
        place(f64::NAN),
    ] {
        // The script controls everything that the refused action would take over.
        let more = "[[command]]\nat_s = 0.5\ntick_hz = 30\n[[command]]\nat_s = 0.5\nthrottle = 0.5\n\
                    [[command]]\nat_s = 0.5\nlane = 1\nmethod = 'midpoint'\n\
                    [[command]]\nat_s = 0.5\nset = { body = 'port buoy', key = 'stiffness_n_per_m', value = 9.0 }\n";
        let text = SCENES.iter().find(|scene| scene.name == "harbour").unwrap().text;
        let name = &built_in("harbour").bodies[0].name;
        let text = format!("{text}\n{}", more.replace("port buoy", name));
        let mut studio = Studio::new(parsed(&text));
        let journal = studio.race().journal().clone();
        studio.apply(RunCommand::Act(action.clone()));
        let told = studio.viewer.notice.as_deref().unwrap_or_default().to_owned();
        assert!(told.starts_with("out of range"), "{action:?}: {told}");
        assert!(*studio.race().journal() == journal, "{action:?}");
        let mut session = Session::racing(parsed(&text).into());
        assert!(!session.act(action.clone()) && *session.journal() == journal, "{action:?}");
        (0..40).for_each(|_| studio.tick());
        assert_eq!(studio.race().tick_hz(), 30, "{action:?}: the script goes on");
        parsed(&studio.deck.recording().unwrap());
    }
    // A mass that is below zero is refused with its range, and a throttle is clamped.
    let mut studio = Studio::new(built_in("ship"));
    let mass = studio.scene().bodies[0].kind.parameter("mass_kg").unwrap().0;
    studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: mass, value: -1.0 }));
    studio.apply(RunCommand::Act(Action::Throttle(-5.0)));
    studio.tick();
    let recorded = parsed(&studio.deck.recording().unwrap());
    assert_eq!(recorded.script[0].action, Action::Throttle(-1.0));
    assert_eq!(recorded.script.len(), 1);
}

#[test]
fn a_method_not_on_the_list_is_refused_with_a_notice() {
    for (scene, id, why) in [
        ("spring", "engine-box2d", "is not on this scene's list"),
        ("spring", "lerp-dt", "does not step the body"),
        ("lift", "exponential-decay", "does not step the body"),
    ] {
        for is_race in [false, true] {
            let spec = LaneSpec::plain(method(id).unwrap());
            let mut studio = Studio::new(built_in(scene));
            if is_race {
                studio.apply(StageCommand::ToggleRace);
            }
            let hash = studio.race().state_hash();
            for command in [
                Command::Stage(StageCommand::Method(spec.method)),
                Command::Run(RunCommand::SetLane(spec)),
            ] {
                studio.viewer.set_notice("nothing");
                studio.apply(command);
                let told = studio.viewer.notice.as_deref().unwrap();
                assert!(told.contains(why), "{id} on {scene}: {told}");
            }
            assert_eq!(studio.race().state_hash(), hash);
            studio.apply(RunCommand::SetLane(LaneSpec { substeps: 0, ..studio.entries()[0] }));
            assert!(studio.viewer.notice.as_deref().unwrap().starts_with("out of range"));
        }
    }
    // An action that names one steps nothing by it, if it cannot.
    let mut session = Session::racing(built_in("spring").into());
    let spec = LaneSpec::plain(method("lerp-dt").unwrap());
    assert!(!session.act(Action::Lane { lane: LaneId(1), spec }));
}

#[test]
fn a_link_to_a_solo_run_keeps_its_menu_of_methods() {
    let mut studio = Studio::new(built_in("harbour"));
    let ids = |studio: &Studio| -> Vec<&str> {
        studio.scene().lanes.iter().map(|lane| lane.method.id).collect()
    };
    let menu = ids(&studio);
    studio.apply(StageCommand::Pick(2));
    studio.apply(StageCommand::Restart);
    (0..50).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Kick(0.5)));
    studio.apply(StageCommand::Pick(1));
    (0..70).for_each(|_| studio.tick());

    let text = link::text(&studio.deck.link().unwrap()).unwrap();
    let scene = parsed(&text);
    let mut opened = Studio::new(scene.clone());
    assert_eq!((ids(&opened), opened.active()), (menu, 2));
    (0..120).for_each(|_| opened.tick());
    assert_eq!(opened.active(), 1);
    assert_eq!(opened.race().state_hash(), studio.race().state_hash());
    assert!(!scene.checks.is_empty());
    assert_eq!(wrong_lanes(&scene), []);
    // Of two lanes with one method, the link of the plain one needs no other lane.
    let plain = LaneSpec::plain(method("rk4").unwrap());
    let lanes = vec![LaneSpec { substeps: 4, ..plain }, plain];
    let mut studio = Studio::new(edited(&built_in("spring"), |scene| scene.lanes = lanes));
    for (entry, count) in [(0, 2), (1, 1)] {
        studio.apply(StageCommand::Pick(entry));
        studio.apply(StageCommand::Restart);
        let text = link::text(&studio.deck.link().unwrap()).unwrap();
        assert_eq!(parsed(&text).lanes.len(), count);
    }
}

#[test]
fn a_recording_keeps_the_digit_keys_lanes_and_verdict_of_its_run() {
    for (scene, entry) in [("spring", 1), ("harbour", 1), ("harbour", 11), ("orbit", 3)] {
        // A verdict is over the length of its scene, and the recording has that of the run.
        let length = |scene: &mut Scene| scene.seconds = scene.tick_hz.seconds(180);
        let mut studio = Studio::new(edited(&built_in(scene), length));
        let ids = |studio: &Studio| studio.entries()[..studio.deck.offered()].to_vec();
        (0..90).for_each(|_| studio.tick());
        studio.apply(StageCommand::Pick(entry));
        (0..90).for_each(|_| studio.tick());
        let mut recorded = Studio::new(parsed(&studio.deck.recording().unwrap()));
        (0..180).for_each(|_| recorded.tick());
        assert_eq!(recorded.race().state_hash(), studio.race().state_hash(), "{scene}");
        assert_eq!((ids(&recorded), recorded.active()), (ids(&studio), entry), "{scene}");
        let verdict = |studio: &mut Studio, entry: usize| {
            studio.analyse();
            studio.viewer.verdict(entry).cloned().expect("it is judged")
        };
        let judged = verdict(&mut recorded, entry);
        assert_eq!(judged, verdict(&mut studio, entry), "{scene}");
        assert_eq!(judged.starts_at_s, studio.race().tick_hz().seconds(90), "from the switch on");
        recorded.apply(StageCommand::Pick(0));
        assert_eq!(ids(&recorded), ids(&studio), "no digit vanishes");
        recorded.apply(StageCommand::ToggleRace);
        assert_eq!(recorded.race().entrants().len(), studio.scene().lanes.len(), "{scene}");
        assert_eq!(verdict(&mut recorded, 0).starts_at_s, 0.0);
    }
}
