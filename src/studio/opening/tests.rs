use super::*;
use crate::loops::loop_lab::LoopCommand;
use crate::run::diff::Difference;
use crate::run::race::Mode;
use crate::scene::{Action, SCENES};
use crate::sim::TickRate;
use crate::tools::source_code::Language;
use crate::{Command, DriverRequest, RunCommand, StageCommand, Step, View, ViewCommand};

fn text(name: &str) -> &'static str {
    SCENES.iter().find(|scene| scene.name == name).unwrap().text
}

fn scene(text: &str) -> Scene {
    Scene::parse("boat/ship.toml", text).unwrap()
}

const PATH: &str = "boat/ship.toml";

/// Returns a studio that runs the scene of a file with this text.
fn studio(text: &str) -> Studio {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    open_file(&mut studio, Path::new(PATH), scene(text));
    studio
}

#[test]
fn an_opened_file_stays_on_the_list_apart_from_built_in_scenes() {
    let mut studio = studio(text("ship"));
    assert!(studio.title().starts_with("Regatta - ship.toml - "), "{}", studio.title());
    assert_eq!(studio.deck.scene_list().open(), Some(SCENES.len()));
    studio.apply(StageCommand::SceneBeside(Step::Next));
    assert!(studio.title().starts_with("Regatta - harbour - "), "{}", studio.title());
    studio.apply(StageCommand::SceneBeside(Step::Previous));
    assert!(studio.title().starts_with("Regatta - ship.toml - "), "{}", studio.title());
    studio.apply(StageCommand::SceneBeside(Step::Previous));
    assert_eq!(studio.deck.scene_list().open(), Some(SCENES.len() - 1));
    for _ in 0..=SCENES.len() {
        studio.apply(StageCommand::SceneBeside(Step::Next));
    }
    assert_eq!(studio.deck.scene_list().open(), Some(SCENES.len() - 1), "round");
}

#[test]
fn a_changed_mass_acts_in_flight_and_each_lane_keeps_its_state() {
    let before = text("spring");
    let after = before.replacen("mass_kg = ", "mass_kg = 1", 1);
    assert_ne!(before, after);
    let kicked = || {
        let mut studio = studio(before);
        studio.apply(StageCommand::ToggleRace);
        studio.apply(StageCommand::Pick(2));
        studio.apply(ViewCommand::ZoomPan {
            body: 0,
            zoom_pan: crate::ZoomPan::default().zoomed(2.0, [0.0; 2]),
        });
        (0..50).for_each(|_| studio.tick());
        studio.apply(RunCommand::Act(Action::Kick(1.0)));
        studio
    };
    let (mut old, mut edited) = (kicked(), kicked());
    let kicked = old.race().state_hash();
    reload_file(&mut old, Path::new(PATH), scene(&after));
    let notice = old.viewer.notice.as_deref().unwrap();
    assert!(notice.starts_with("ship.toml: reloaded, state kept at tick 50: "), "{notice}");
    assert_eq!((old.mode(), old.active(), old.race().state_hash()), (Mode::Race, 2, kicked));
    assert_eq!(old.view().zoom_pan(0).zoom(), 2.0);

    let value = scene(&after).bodies[0].values[0];
    edited.apply(RunCommand::Act(Action::Set { body: 0, parameter: 0, value }));
    (0..50).for_each(|_| [&mut old, &mut edited].into_iter().for_each(Studio::tick));
    assert_eq!(old.race().state_hash(), edited.race().state_hash());
    let recorded = scene(&old.deck.recording().unwrap());
    let mut again = crate::run::Session::racing(recorded.into());
    again.run(100);
    assert_eq!(again.race().state_hash(), old.race().state_hash());
    // From the next start on, the file is the scene.
    old.apply(StageCommand::Restart);
    let mut new = studio(&after);
    new.apply(StageCommand::ToggleRace);
    (0..50).for_each(|_| [&mut old, &mut new].into_iter().for_each(Studio::tick));
    assert_eq!(old.race().state_hash(), new.race().state_hash());
}

#[test]
fn a_changed_start_waits_for_the_restart_and_is_told() {
    let before = text("spring");
    let after = before.replacen("x0_m = ", "x0_m = 1", 1);
    assert_ne!(before, after);
    let mut studio = studio(before);
    (0..50).for_each(|_| studio.tick());
    let hash = studio.race().state_hash();
    reload_file(&mut studio, Path::new(PATH), scene(&after));
    let notice = studio.viewer.notice.as_deref().unwrap();
    assert!(notice.contains("state kept at tick 50; from the next restart (Home): "), "{notice}");
    assert_eq!(studio.race().state_hash(), hash);
    studio.apply(StageCommand::Restart);
    assert_eq!(studio.race().truth().bodies()[0].stepper.q(), [scene(&after).bodies[0].values[3]]);
}

#[test]
fn a_changed_law_goes_on_from_the_state_and_the_time() {
    let law = |force: &str| {
        format!(
            "title = \"Swing\"\ntick_hz = 60\nseconds = 5\nmethods = [\"rk4\", \"explicit-euler\"]\n\n\
             [[law]]\nname = \"swing\"\n[law.coordinates.x]\nacceleration = \"{force}\"\nstart = 1.0\n"
        )
    };
    let mut studio = studio(&law("-9 * x"));
    (0..50).for_each(|_| studio.tick());
    let state = |studio: &Studio| {
        let at = &studio.selected().lane.bodies()[0].stepper;
        (at.q().to_vec(), at.v().to_vec())
    };
    let before = state(&studio);
    reload_file(&mut studio, Path::new(PATH), scene(&law("-16 * x")));
    let notice = studio.viewer.notice.as_deref();
    assert_eq!(notice, Some("ship.toml: reloaded, state kept at tick 50"));
    assert_eq!((state(&studio), studio.race().tick()), (before, 50));
    // Plots have the past as it was, up to where the present run goes on.
    let (t, run_before) = (studio.race().t(), studio.deck.run_before().unwrap());
    let last = run_before.histories[0].samples().next_back().unwrap();
    assert_eq!(
        (last.t, last.q, studio.deck.drawn_from_s()),
        (t, studio.selected().lane.bodies()[0].stepper.q()[0], t)
    );
    studio.tick();
    let recorded = scene(&studio.deck.recording().unwrap());
    assert!(recorded.to_toml().contains("-16 * x"));
    let mut replay = crate::run::Replay::new(recorded.clone().into());
    while let Some(reached) = replay.run_to_next_check(u64::MAX, &mut ()) {
        assert_eq!(reached.hash, Some(recorded.checks[reached.row].hash));
    }
    // In a race each lane goes on from the state that is watched.
    studio.apply(StageCommand::ToggleRace);
    (0..50).for_each(|_| studio.tick());
    let before = state(&studio);
    reload_file(&mut studio, Path::new(PATH), scene(&law("-25 * x")));
    let notice = studio.viewer.notice.as_deref().unwrap();
    assert!(notice.contains(", every lane in that of "), "{notice}");
    assert!(
        studio.race().entrants().iter().all(|lane| lane.lane.bodies()[0].stepper.q() == before.0)
    );
}

#[test]
fn changed_lines_of_a_method_go_on_from_the_state_of_their_lane() {
    let lane = |lines: &str| LaneSpec::from_step("mine.step", lines.as_bytes()).unwrap();
    let mut studio = studio(text("spring"));
    race_own_method(&mut studio, lane("v += h * a(x, v); x += h * v"));
    (0..30).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Kick(1.0)));
    (0..30).for_each(|_| studio.tick());
    let (hash, samples) = (studio.race().state_hash(), drawn(&studio).len());
    for (lines, about) in [
        ("x += h * v; v += h * a(x, v)", "order 1.00"),
        ("v += h/2 * a(x, v); x += h * v; v += h/2 * a(x, v)", "order 2.00"),
    ] {
        reload_own_method(&mut studio, lane(lines));
        let notice = studio.viewer.notice.as_deref().unwrap();
        let told = format!("mine: reloaded, state kept at tick 60; {about}");
        assert!(notice.starts_with(&told), "{notice}");
        assert_eq!(studio.race().state_hash(), hash);
        assert_eq!(studio.deck.lane_name(studio.active()), "mine");
    }
    assert_eq!(drawn(&studio).len(), samples, "the past stays drawn, without a jump");
    (0..30).for_each(|_| studio.tick());
    // Each version has a name in the file of the run, which repeats it to the bit.
    let recorded = studio.deck.recording().unwrap();
    assert!(
        recorded.contains("id = \"mine-2\"") && recorded.contains("method = \"mine-3\""),
        "{recorded}"
    );
    let mut again = crate::run::Session::racing(scene(&recorded).into());
    again.run(90);
    assert_eq!(again.race().state_hash(), studio.race().state_hash());
    // From the next start on, the lines of the file are the method.
    studio.apply(StageCommand::Restart);
    let recorded = studio.deck.recording().unwrap();
    assert!(recorded.contains("h/2") && !recorded.contains("mine-2"), "{recorded}");
}

#[test]
fn changed_lines_of_a_method_that_no_lane_has_wait_until_it_is_picked() {
    let lane = |lines: &str| LaneSpec::from_step("mine.step", lines.as_bytes()).unwrap();
    let mut studio = studio(text("spring"));
    race_own_method(&mut studio, lane("v += h * a(x, v); x += h * v"));
    let own = studio.active();
    studio.apply(StageCommand::ToggleRace);
    studio.apply(StageCommand::Pick(0));
    (0..30).for_each(|_| studio.tick());
    let hash = studio.race().state_hash();
    let changed = lane("x += h * v; v += h * a(x, v)");
    reload_own_method(&mut studio, changed);
    assert_eq!((studio.race().tick(), studio.race().state_hash()), (30, hash));
    studio.apply(StageCommand::Pick(own));
    assert_eq!(studio.selected().spec.method, changed.method);
}

/// The times and places that the selected lane has drawn, with the jumps among them.
fn drawn(studio: &Studio) -> Vec<(f64, f64, bool)> {
    let samples = studio.past().histories(studio.selected().id)[0].samples();
    samples.map(|sample| (sample.t, sample.q, sample.jumped)).collect()
}

#[test]
fn a_change_of_comments_alone_keeps_the_run_and_its_journal() {
    let mut studio = studio(text("spring"));
    (0..50).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Kick(1.0)));
    let (hash, rows) = (studio.race().state_hash(), studio.race().journal().rows().len());
    reload_file(&mut studio, Path::new(PATH), scene(&format!("# A remark.\n{}", text("spring"))));
    let notice = "ship.toml saved; nothing that matters changed";
    assert_eq!(studio.viewer.notice.as_deref(), Some(notice));
    assert_eq!(studio.race().state_hash(), hash);
    assert_eq!((studio.race().tick(), studio.race().journal().rows().len()), (50, rows));
}

#[test]
fn a_changed_file_with_other_bodies_or_lanes_restarts() {
    let before = text("spring");
    let with_other = "reloaded from the start, with other lanes or bodies";
    for after in
        [text("harbour").to_owned(), before.replacen("\"rk4\", ", "", 1), text("ship").to_owned()]
    {
        assert_ne!(before, after);
        let mut studio = studio(before);
        (0..50).for_each(|_| studio.tick());
        // An edit of the file is none by hand, which the restart would leave out.
        let heavier = before.replacen("mass_kg = ", "mass_kg = 1", 1);
        reload_file(&mut studio, Path::new(PATH), scene(&heavier));
        (0..50).for_each(|_| studio.tick());
        reload_file(&mut studio, Path::new(PATH), scene(&after));
        assert_eq!(studio.race().tick(), 0);
        assert!(studio.viewer.notice.as_deref().unwrap().ends_with(with_other));
    }
}

#[test]
fn a_changed_file_sets_the_rate_unless_a_person_chose_one() {
    let before = text("spring");
    let after = before.replacen("tick_hz = 60", "tick_hz = 50", 1);
    assert_ne!(before, after);
    for (chosen, rate) in [(None, 50_u32), (Some(120_u32), 120)] {
        let mut studio = studio(before);
        if let Some(hz) = chosen {
            studio.apply(StageCommand::TickHz(hz.into()));
        }
        reload_file(&mut studio, Path::new(PATH), scene(&after));
        assert_eq!(studio.race().tick_hz(), rate);
    }
}

#[test]
fn a_refused_path_stays_in_its_field_with_the_reason_until_edited() {
    let mut studio = studio(text("spring"));
    let refused = |studio: &Studio| match studio.viewer.dialog() {
        Some(Dialog::Path { refused, .. }) => refused.clone(),
        other => panic!("{other:?}"),
    };
    studio.apply(ViewCommand::AskForPath);
    studio.apply(ViewCommand::TypePath("boat/none.toml".into()));
    assert_eq!(studio.apply(DriverRequest::OpenTypedPath), Some(DriverRequest::OpenTypedPath));
    refuse_typed_path(&mut studio, Path::new("boat/none.toml"), vec!["no such file".into()]);
    assert_eq!(studio.viewer.typed_path(), "boat/none.toml");
    assert_eq!(refused(&studio), Some(vec!["no such file".into()]));
    studio.apply(ViewCommand::TypePath("boat/none.toml".into()));
    assert!(refused(&studio).is_some());
    studio.apply(ViewCommand::TypePath("boat/non.toml".into()));
    assert_eq!(refused(&studio), None);
    open_file(&mut studio, Path::new(PATH), scene(text("ship")));
    assert_eq!(studio.viewer.dialog(), None);
}

#[test]
fn a_deleted_or_restored_file_is_reported_by_name() {
    let mut studio = studio(text("spring"));
    file_is_gone(&mut studio, Path::new(PATH));
    assert!(studio.viewer.notice.as_deref().unwrap().starts_with("ship.toml is gone: "));
    file_is_back(&mut studio, Path::new(PATH));
    assert_eq!(studio.viewer.notice.as_deref(), Some("ship.toml is back, unchanged"));
}

#[test]
fn a_broken_file_shows_its_mistakes_and_keeps_the_run() {
    let mut studio = studio(text("spring"));
    (0..50).for_each(|_| studio.tick());
    let hash = studio.race().state_hash();
    reload_failed(&mut studio, Path::new(PATH), vec!["boat/ship.toml:1:1: no".into()]);
    let shown = |studio: &Studio| matches!(studio.viewer.dialog(), Some(Dialog::Mistakes { .. }));
    assert!(shown(&studio) && studio.race().state_hash() == hash);
    assert_eq!(studio.apply(ViewCommand::Escape), None);
    assert!(!shown(&studio));
    // A return to the scene shows its mistakes again.
    studio.apply(StageCommand::SceneBeside(Step::Next));
    assert!(!shown(&studio));
    studio.apply(StageCommand::SceneBeside(Step::Previous));
    assert!(shown(&studio));
    reload_file(&mut studio, Path::new(PATH), scene(text("spring")));
    assert!(!shown(&studio));
    // The mistakes of a file that is not open are not shown yet.
    studio.apply(StageCommand::SceneBeside(Step::Next));
    reload_failed(&mut studio, Path::new(PATH), vec!["boat/ship.toml:1:1: no".into()]);
    assert!(!shown(&studio));
}

#[test]
fn the_rewind_limit_stays_the_same_for_every_opened_scene() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.deck.set_rewind_bytes(1 << 20);
    studio.apply(StageCommand::SceneBeside(Step::Next));
    assert_eq!(studio.run().limit(), 1 << 20);
    open_file(&mut studio, Path::new(PATH), scene(text("stiff")));
    assert_eq!(studio.run().limit(), 1 << 20);
    for _ in 0..20_000 {
        studio.tick();
        assert!(studio.run().bytes() <= 1 << 20, "{}", studio.run().bytes());
    }
}

#[test]
fn preferences_survive_a_change_of_scene_and_the_view_does_not() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    let chosen = studio.viewer.preferences.clone();
    for command in [
        Command::Stage(StageCommand::Body(1)),
        Command::Run(RunCommand::MapParameter(0)),
        Command::View(ViewCommand::CopyMethod { entry: 0, language: Language::GdScript }),
        Command::View(ViewCommand::ToggleTheme),
        Command::View(ViewCommand::ToggleGhost),
        Command::View(ViewCommand::Scale(Step::Next)),
        Command::View(ViewCommand::TypePath("boat.toml".into())),
    ] {
        studio.apply(command);
    }
    let (preferences, view) = (format!("{:?}", studio.viewer.preferences), studio.view().clone());
    assert!(preferences != format!("{chosen:?}") && view != View::default());
    studio.apply(StageCommand::SceneBeside(Step::Next));
    assert_eq!(format!("{:?}", studio.viewer.preferences), preferences);
    assert_eq!(studio.viewer.language(), Language::GdScript);
    assert_eq!(*studio.view(), View::default());
}

#[test]
fn a_comparison_ending_in_the_loop_lab_marks_the_run_without_moving_it() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..200).for_each(|_| studio.tick());
    studio.apply(LoopCommand::ToggleLab);
    let first = Some(Difference {
        tick: 50,
        tick_name: Some("tick".into()),
        key: [("lane", "1"), ("body", "spring"), ("coordinate", "x")]
            .map(|(name, cell)| (name.into(), cell.into()))
            .into(),
        column: "q".into(),
        values: [Some("1.5".into()), Some("1.25".into())],
        ulps: None,
        relative: Some(0.2),
    });
    let found = Comparison { rows: 900, changes: true, first, ..Comparison::default() };
    show_comparison(&mut studio, "clip.toml", &found, Scene::built_in("spring").unwrap());
    assert!(studio.loop_lab().is_some() && studio.running());
    assert_eq!(studio.deck.compared().map(Compared::tick), Some(50));
    studio.apply(LoopCommand::ToggleLab);
    assert_eq!((studio.race().tick(), studio.running()), (200, true));
}

#[test]
fn a_recording_at_another_tick_rate_is_compared_at_the_same_moment() {
    let mut recorded = Studio::new(Scene::built_in("spring").unwrap());
    recorded.apply(StageCommand::Pick(3));
    recorded.apply(StageCommand::TickHz(25.into()));
    (0..100).for_each(|_| recorded.tick());
    let recording = Scene::parse("clip.toml", &recorded.deck.recording().unwrap()).unwrap();
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(StageCommand::Pick(3));
    (0..200).for_each(|_| studio.tick());
    let found = Comparison { rows: 900, changes: true, ..Comparison::default() };
    show_comparison(&mut studio, "clip.toml", &found, recording);
    let lines = studio.deck.compared().unwrap().lines();
    assert_eq!(lines[0], "other tick rate: 25 Hz there, 60 Hz here");
    let apart = |studio: &Studio| {
        let (spec, compared) = (studio.selected().spec, studio.deck.compared().unwrap());
        let (_, there) = compared.body(studio.scene(), &spec, 0).unwrap();
        let body = &studio.selected().lane.bodies()[0];
        let (here, _) = crate::shown_state(studio, body);
        (there[0] - here[0]).abs()
    };
    for tick in [1, 7, 60, 61, 150] {
        studio.apply(RunCommand::Seek(tick));
        assert!(
            apart(&studio) < 0.01,
            "Runge-Kutta 4 at both rates, tick {tick}: {}",
            apart(&studio)
        );
    }
    studio.apply(ViewCommand::TogglePause);
    for frame in 0..30 {
        studio.advance(7_000_000);
        assert!(apart(&studio) < 0.01, "frame {frame}: {}", apart(&studio));
    }
    assert_eq!(studio.apply(ViewCommand::Escape), None);
    assert!(studio.deck.compared().is_none(), "Esc ends the comparison");
}

#[test]
fn my_spring_runs_at_the_tick_rate_of_its_dialog_and_opens_the_advice() {
    let mut studio = Studio::new(Scene::built_in("ship").unwrap());
    studio.viewer.preferences.display.measure = false;
    studio.apply(ViewCommand::AskForSpring);
    let asked = |studio: &Studio| described_spring(studio).1;
    assert_eq!(asked(&studio), studio.clock().tick_hz(), "the present one at first");
    let rate = crate::SpringField::tick_rate(asked(&studio));
    assert!(rate.is_whole && rate.value == f64::from(asked(&studio)));
    for wrong in [0.0, 0.005, -60.0, 1e6] {
        assert!((rate.set)(wrong).unwrap_err().contains("tick rate would be"), "{wrong}");
    }
    studio.apply((rate.set)(59.94).unwrap());
    assert_eq!(asked(&studio), "59.94".parse::<TickRate>().unwrap());
    studio.apply((rate.set)(144.0).unwrap());
    assert_eq!(asked(&studio), 144);
    let scene = studio.viewer.my_spring().advised_scene(144);
    open_advised_spring(&mut studio, scene);
    assert_eq!((studio.race().tick_hz(), studio.scene().tick_hz), (144.into(), 144.into()));
    assert!(studio.running() && studio.viewer.dialog().is_none());
    let display = studio.display();
    assert!(display.measure && display.instrument == Instrument::Advice);
}
