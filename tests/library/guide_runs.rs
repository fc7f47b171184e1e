//! The guide and a person's own run: a stop answers nothing before the prediction, and whoever leaves the guide is back where
//! they were.

use crate::guide::{is_done, lab_after_prediction, lab_at, place_of};
use regatta::loops::loop_lab::LoopCommand;
use regatta::run::race::Mode;
use regatta::scene::{Action, SCENES, Scene};
use regatta::stage::compose;
use regatta::studio::guide::{Goal, STOPS};
use regatta::studio::{
    Command, DIGITS, Instrument, Key, RunCommand, StageCommand, Step, Studio, ViewCommand,
    command_for, one_step,
};

/// The words on the stage.
fn said_on_stage(studio: &Studio) -> Vec<String> {
    let picture = compose(studio, [780.0, 440.0]);
    assert!(!studio.viewer.is_asked() || picture.chip.is_none(), "a verdict");
    picture.labels.into_iter().map(|label| label.text).collect()
}

#[test]
fn no_stop_shows_its_answer_before_the_prediction() {
    let (mut promises, mut landings) = (0, 0);
    for (index, stop) in STOPS.iter().enumerate() {
        let mut studio = lab_at(index);
        studio.analyse();
        let entries = studio.entries().len();
        let judged = |studio: &Studio| (0..entries).any(|it| studio.viewer.verdict(it).is_some());
        let lands = |studio: &Studio| one_step(studio).is_some_and(|step| step.landing.is_some());
        studio.advance(1_000_000_000);
        assert_eq!(studio.race().tick(), 0, "{}: time waits", stop.title);
        assert!(studio.viewer.is_asked() && !judged(&studio) && !lands(&studio), "{}", stop.title);
        let hint = studio.hint().expect("what to do");
        assert!(hint.contains("prediction"), "{hint}");
        let before = said_on_stage(&studio);
        for key in [Key::Space, Key::Sign('.'), Key::Home, Key::Sign('f')] {
            studio.apply(command_for(key).unwrap().0);
            studio.advance(500_000_000);
            assert_eq!(
                (studio.race().tick(), studio.running()),
                (0, false),
                "{}: {key}",
                stop.title
            );
            assert!(!studio.display().futures && !is_done(&studio), "{}: {key}", stop.title);
            let told = studio.viewer.notice.as_deref().expect("why time waits");
            assert!(told.contains("predict"), "{told}");
        }
        stop.keys.iter().for_each(|key| _ = studio.apply(command_for(*key).unwrap().0));
        assert!(studio.viewer.is_asked() && !is_done(&studio), "{}: its task", stop.title);
        assert!(!judged(&studio) && !lands(&studio), "{}", stop.title);
        let mut studio = lab_at(index);
        studio.analyse();
        studio.apply(ViewCommand::Predict(stop.right));
        assert!(!studio.viewer.is_asked() && judged(&studio), "{}", stop.title);
        let after = said_on_stage(&studio);
        promises += usize::from(after.iter().any(|label| !before.contains(label)));
        landings += usize::from(lands(&studio));
        let is_stepped = matches!(stop.goal, Goal::SteppedTo(_));
        let due = studio.advance(2_000_000_000);
        assert_eq!(due.ticks > 0, !is_stepped, "{}: time begins", stop.title);
    }
    assert!(promises > 12 && landings > 15, "{promises} {landings}");
}

#[test]
fn a_task_done_before_the_prediction_counts_once_that_is_made() {
    let at = STOPS.iter().position(|stop| stop.goal == Goal::Race).unwrap();
    let mut studio = lab_at(at);
    for key in STOPS[at].keys {
        studio.apply(command_for(*key).unwrap().0);
    }
    assert!(!is_done(&studio) && studio.viewer.is_asked());
    assert_eq!((studio.race().tick(), studio.running()), (0, false));
    studio.apply(ViewCommand::Predict(0));
    assert!(is_done(&studio) && !studio.viewer.is_asked());
    assert_eq!((studio.race().tick(), studio.running()), (0, true));
}

/// A run of a person's own in the middle: kicked, paused, with a plot and a body chosen, the stage alone.
fn own_run(race: bool) -> Studio {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    if race {
        studio.apply(StageCommand::ToggleRace);
        studio.apply(StageCommand::Pick(2));
    }
    studio.apply(StageCommand::TickHz(30.into()));
    (0..70).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Kick(1.0)));
    (0..20).for_each(|_| studio.tick());
    studio.apply(StageCommand::Body(1));
    studio.apply(StageCommand::Instrument(Instrument::Phase));
    studio.apply(StageCommand::Speed(Step::Next));
    studio.viewer.preferences.display.measure = race;
    studio.deck.note_saved();
    studio
}

/// A person's run, its view and its undo, to be compared.
fn identity(studio: &Studio) -> impl PartialEq + std::fmt::Debug + use<> {
    let display = studio.display();
    (
        (studio.title(), studio.race().state_hash(), studio.run().end(), studio.running()),
        (studio.mode(), studio.active(), studio.clock().speed_percent(), studio.view().clone()),
        (display.instrument, display.measure, display.enlarged, display.quantity),
        (studio.run().undoes().map(str::to_owned), studio.deck.scene_list().open()),
    )
}

#[test]
fn leaving_the_guide_returns_to_the_earlier_run() {
    let escape = || Command::View(ViewCommand::Escape);
    let lab = || Command::Loop(LoopCommand::ToggleLab);
    let last = STOPS.len() - 1;
    let loops = place_of(Goal::LoopLab);
    for race in [false, true] {
        for (stops, back) in [
            (vec![0], vec![escape()]),
            (vec![0, 5, last], vec![ViewCommand::ToggleGuide.into()]),
            (vec![5], vec![lab(), escape()]),
            (vec![5], vec![lab(), lab()]),
            (vec![loops], vec![lab(), escape()]),
            (vec![loops], vec![lab(), lab(), escape()]),
            (vec![5], vec![lab(), ViewCommand::ToggleGuide.into(), escape()]),
        ] {
            let mut studio = own_run(race);
            let before = identity(&studio);
            stops.iter().for_each(|stop| _ = studio.apply(ViewCommand::GoToStop(*stop)));
            studio.apply(ViewCommand::Predict(0));
            studio.advance(700_000_000);
            assert_ne!(identity(&studio), before);
            back.iter().for_each(|command| _ = studio.apply(command.clone()));
            assert!(studio.viewer.tour().is_none() && studio.loop_lab().is_none(), "{back:?}");
            assert_eq!(identity(&studio), before, "{back:?}");
            let kicked = studio.race().state_hash();
            studio.apply(RunCommand::Undo);
            assert_ne!(studio.race().state_hash(), kicked, "the kick can be undone");
        }
    }
    // A scene opened from the guide stays.
    let mut studio = own_run(false);
    studio.apply(ViewCommand::ToggleGuide);
    studio.apply(StageCommand::SceneBeside(Step::Next));
    let scene = studio.deck.scene_name();
    studio.apply(ViewCommand::Escape);
    assert_eq!(studio.deck.scene_name(), scene);
}

#[test]
fn scenes_open_in_their_own_mode_unless_a_person_chose_one() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    let round = |studio: &mut Studio, chosen: Option<Mode>| {
        let (mut solo, mut races) = (0, 0);
        for _ in SCENES {
            studio.apply(StageCommand::SceneBeside(Step::Next));
            let wanted = chosen.unwrap_or(Mode::opening(studio.scene()));
            assert_eq!(studio.mode(), wanted, "{}", studio.scene().name);
            *(if wanted == Mode::Solo { &mut solo } else { &mut races }) += 1;
        }
        (solo, races)
    };
    let (solo, races) = round(&mut studio, None);
    assert!(solo > 10 && races > 3, "{solo} {races}");
    studio.apply(StageCommand::ToggleRace);
    round(&mut studio, Some(Mode::Race));
    studio.apply(StageCommand::ToggleRace);
    round(&mut studio, None);
    // A task of the guide is no choice.
    studio.apply(ViewCommand::GoToStop(place_of(Goal::Race)));
    studio.apply(StageCommand::ToggleRace);
    round(&mut studio, None);
    // Solo where a scene opens as a race is one.
    while Mode::opening(studio.scene()) == Mode::Solo {
        studio.apply(StageCommand::SceneBeside(Step::Next));
    }
    studio.apply(StageCommand::ToggleRace);
    round(&mut studio, Some(Mode::Solo));
}

#[test]
fn a_lone_body_has_a_number_only_if_a_key_picks_its_method() {
    let bears = |studio: &Studio| {
        let number = (studio.active() + 1).to_string();
        said_on_stage(studio).contains(&number)
    };
    let at = STOPS.iter().position(|stop| stop.title == "Implicit methods").unwrap();
    let mut studio = lab_after_prediction(at);
    assert!(studio.active() >= DIGITS && !bears(&studio), "{}", studio.active() + 1);
    studio.apply(StageCommand::Pick(1));
    assert!(bears(&studio));
}
