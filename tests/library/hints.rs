//! The built-in scenes open with the method that makes their point, and pressing the keys in their hints keeps the
//! promises.

use regatta::run::race::Mode;
use regatta::scene::{Action, SCENES, Scene};
use regatta::sim::integrators::{GENERAL_METHODS, METHODS};
use regatta::studio::{
    Arrangement, Command, KEYS, Key, RunCommand, StageCommand, Step, Studio, ViewCommand,
    command_for,
};

const C: Key = Key::Sign('c');
const LOWER_RATE: Key = Key::Sign('[');
const HIGHER_RATE: Key = Key::Sign(']');

fn open(name: &str) -> Studio {
    Studio::new(Scene::built_in(name).expect("a built-in scene"))
}

fn press(studio: &mut Studio, keys: &[Key]) {
    for &key in keys {
        let (command, _) = command_for(key).expect("a key of the table");
        studio.apply(command);
    }
}

/// Runs for `seconds` of simulated time, and returns the largest |q| of the first coordinate of a body in the first
/// lane.
fn largest(studio: &mut Studio, body: usize, seconds: f64) -> f64 {
    let end = studio.race().t() + seconds;
    let mut largest = 0.0_f64;
    while studio.race().t() < end {
        studio.tick();
        largest = largest.max(studio.race().entrants()[0].lane.bodies()[body].stepper.q()[0].abs());
    }
    largest
}

/// Runs for `seconds` of simulated time, and returns the largest distance of each lane's first body from the truth.
fn largest_errors(studio: &mut Studio, seconds: f64) -> Vec<f64> {
    let end = studio.race().t() + seconds;
    let mut errors = vec![0.0_f64; studio.race().entrants().len()];
    while studio.race().t() < end {
        studio.tick();
        let truth = studio.race().truth().bodies()[0].stepper.place();
        for (error, entrant) in errors.iter_mut().zip(studio.race().entrants()) {
            *error = error.max((entrant.lane.bodies()[0].stepper.place() - truth).length());
        }
    }
    errors
}

/// Whether the swing of a body keeps its width over the next ten seconds.
fn holds(studio: &mut Studio, body: usize) -> bool {
    let before = largest(studio, body, 2.0);
    (0..5).all(|_| largest(studio, body, 2.0) < 1.1 * before)
}

#[test]
fn every_scene_names_the_lane_that_it_opens_with() {
    for scene in SCENES {
        let parsed = Scene::built_in(scene.name).expect("a built-in scene");
        let opening = parsed.opening_method.expect("every built-in scene names one");
        assert!(parsed.lanes.iter().any(|lane| lane.method == opening), "{}", scene.name);
        let studio = Studio::new(parsed);
        assert_eq!(studio.entries()[studio.active()].method, opening, "{}", scene.name);
        assert_eq!(studio.mode(), Mode::Solo);
    }
}

#[test]
fn a_scene_opens_only_with_one_of_its_own_lanes() {
    for method in GENERAL_METHODS {
        let text = |opening: &str| {
            format!(
                "title = 'x'\ntick_hz = 60\nseconds = 1\nmethods = ['{}', 'rk4-as-printed']\n{opening}\n\
                 [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\n",
                method.id
            )
        };
        let opened = |text: &str| {
            let Ok(scene) = Scene::parse("x.toml", text) else { return None };
            let studio = Studio::new(scene);
            Some(studio.entries()[studio.active()].method.id)
        };
        if method.id != "rk4-as-printed" {
            assert_eq!(opened(&text("")), Some(method.id), "the first lane's");
            assert_eq!(opened(&text("method = 'rk4-as-printed'")), Some("rk4-as-printed"));
        }
    }
}

#[test]
fn the_next_scene_opens_with_its_own_method() {
    let mut studio = open("harbour");
    press(&mut studio, &[Key::Digit(4)]);
    for _ in SCENES {
        press(&mut studio, &[Key::Sign('n')]);
        assert_eq!(Some(studio.entries()[studio.active()].method), studio.scene().opening_method);
    }
}

#[test]
fn the_springs_gain_energy_until_2_is_pressed() {
    for scene in ["spring", "damped", "harbour"] {
        let mut studio = open(scene);
        assert_eq!(studio.scene().bodies[0].kind.id, "spring");
        assert!(largest(&mut studio, 0, 10.0) > 5.0, "{scene}");
        press(&mut studio, &[Key::Digit(2)]);
        assert!(holds(&mut studio, 0), "{scene}");
    }
}

#[test]
fn the_stiff_spring_blows_up_two_presses_lower_and_recovers_two_higher() {
    let mut studio = open("stiff");
    let seconds = studio.scene().seconds;
    assert!(largest(&mut studio, 0, seconds) < 2.0, "it holds at first");
    press(&mut studio, &[LOWER_RATE, LOWER_RATE]);
    assert_eq!(studio.clock().tick_hz(), 49);
    largest(&mut studio, 0, seconds);
    assert!(studio.race().entrants()[0].lane.halted().is_some_and(|halt| halt.is_blow_up()));
    press(&mut studio, &[HIGHER_RATE, HIGHER_RATE, Key::Home]);
    assert_eq!(studio.clock().tick_hz(), 60);
    assert!(largest(&mut studio, 0, seconds) < 2.0);
}

#[test]
fn the_chain_is_lost_four_presses_lower() {
    let mut studio = open("chain");
    press(&mut studio, &[Key::Sign('k')]);
    assert!(largest(&mut studio, 0, 5.0) < 3.0);
    press(&mut studio, &[LOWER_RATE; 4]);
    assert_eq!(studio.clock().tick_hz(), 20);
    assert!(largest(&mut studio, 0, 5.0) > 1e3);
}

#[test]
fn the_pendulum_goes_over_the_top_and_after_2_and_a_restart_never_does() {
    let mut studio = open("pendulum");
    assert!(largest(&mut studio, 0, 5.0) > std::f64::consts::PI);
    press(&mut studio, &[Key::Digit(2), Key::Home]);
    assert!(largest(&mut studio, 0, 600.0) < std::f64::consts::PI);
}

#[test]
fn ship_and_ellipses_are_more_accurate_at_a_higher_tick_rate() {
    for (scene, seconds) in [("ship", 20.0), ("orbit", 6.0)] {
        let mut studio = open(scene);
        press(&mut studio, &[C]);
        let coarse = largest_errors(&mut studio, seconds);
        press(&mut studio, &[HIGHER_RATE, Key::Home]);
        let fine = largest_errors(&mut studio, seconds);
        for (entrant, (coarse, fine)) in
            studio.race().entrants().iter().zip(coarse.iter().zip(&fine))
        {
            let method = entrant.spec.method;
            // An adaptive method chooses its own steps.
            assert!(fine < coarse || method.tolerance.is_some(), "{scene} {}", method.id);
        }
    }
}

#[test]
fn explicit_euler_is_calm_on_all_three_ships_one_press_higher() {
    let mut studio = open("surge");
    press(&mut studio, &[C]);
    largest(&mut studio, 0, 20.0);
    press(&mut studio, &[HIGHER_RATE]);
    assert_eq!(studio.clock().tick_hz(), 2);
    largest(&mut studio, 0, 10.0);
    let entrant = &studio.race().entrants()[0];
    assert_eq!(entrant.spec.method.id, "explicit-euler");
    for body in entrant.lane.bodies() {
        assert!((body.stepper.v()[0] - 20.0).abs() < 1e-3, "{}", body.stepper.v()[0]);
    }
}

#[test]
fn explicit_eulers_ship_is_faster_than_its_ghost_yet_always_behind() {
    let mut studio = open("ship");
    while studio.race().t() < studio.scene().seconds {
        studio.tick();
        let [ship, ghost] = [&studio.race().entrants()[0].lane, studio.race().truth()]
            .map(|lane| [lane.bodies()[0].stepper.q()[0], lane.bodies()[0].stepper.v()[0]]);
        assert!(ship[1] > ghost[1] && ship[0] < ghost[0], "{ship:?} {ghost:?}");
    }
}

#[test]
fn a_restart_shows_the_next_hint_or_after_the_last_how_to_undo_it() {
    let mut studio = open("spring");
    let restart_later = |studio: &mut Studio| {
        press(studio, &[Key::Digit(2)]);
        (0..10).for_each(|_| studio.tick());
        press(studio, &[Key::Home]);
        (studio.hint(), studio.viewer.notice.as_deref().map(str::to_owned))
    };
    let (hint, notice) = restart_later(&mut studio);
    assert_eq!((hint.unwrap().contains("`[`"), notice), (true, None));
    for command in [
        Command::Stage(StageCommand::ToggleRace),
        Command::Stage(StageCommand::Tick(Step::Previous)),
        Command::Stage(StageCommand::InstrumentBeside(Step::Next)),
        Command::Stage(StageCommand::TickRate(Step::Next)),
        Command::View(ViewCommand::ToggleGuide),
        Command::View(ViewCommand::Escape),
        // Back in the race that was left for the guide.
        Command::Stage(StageCommand::ToggleRace),
    ] {
        studio.apply(command);
    }
    let (hint, notice) = restart_later(&mut studio);
    assert_eq!((hint, notice.is_some_and(|told| told.contains("Ctrl Z"))), (None, true));
}

#[test]
fn the_arrows_steer_the_helm_from_the_first_press_on() {
    let mut studio = open("helm");
    press(&mut studio, &[Key::Right, Key::Right, Key::Up, Key::Down]);
    assert_eq!((studio.race().rudder(), studio.race().throttle()), (-0.2, 0.9));
    for _ in 0..300 {
        studio.tick();
        assert_eq!(studio.race().rudder(), -0.2, "at tick {}", studio.race().tick());
    }
    let heading = studio.race().truth().bodies()[0].stepper.q()[2];
    assert!(heading < -1.0, "to the right: {heading}");
    press(&mut studio, &[C]);
    assert_eq!(studio.mode(), Mode::Race);
}

/// The helm's script with a method and a tick rate in it.
fn scripted() -> Studio {
    let more = "[[command]]\nat_s = 4\nmethod = \"rk4\"\n[[command]]\nat_s = 6\ntick_hz = 10\n\
                [[command]]\nat_s = 7\nthrottle = 0.5\n";
    let text = SCENES.iter().find(|scene| scene.name == "helm").unwrap().text;
    Studio::new(Scene::parse("helm.toml", &format!("{text}{more}")).unwrap())
}

fn run_to(studio: &mut Studio, seconds: f64) {
    while studio.race().t() < seconds {
        studio.tick();
    }
}

fn controls(studio: &Studio) -> (&'static str, u32, f64, f64) {
    let method = studio.entries()[studio.active()].method.id;
    let hz = studio.clock().tick_hz().whole_hz().unwrap();
    (method, hz, studio.race().throttle(), studio.race().rudder())
}

#[test]
fn the_script_leaves_a_persons_control_alone_until_a_restart() {
    for (command, name, expected) in [
        (Command::Run(RunCommand::Act(Action::Rudder(0.3))), "rudder", ("rk4", 10, 0.5, 0.3)),
        (Command::Run(RunCommand::RudderLeft), "rudder", ("rk4", 10, 0.5, 0.1)),
        (Command::Run(RunCommand::ThrottleDown), "throttle", ("rk4", 10, 0.9, 1.0)),
        (Command::Stage(StageCommand::Pick(2)), "method", ("improved-euler", 10, 0.5, 1.0)),
        (
            Command::Stage(StageCommand::MethodBeside(Step::Next)),
            "method",
            ("semi-implicit-euler", 10, 0.5, 1.0),
        ),
        (Command::Stage(StageCommand::TickHz(7.into())), "tick rate", ("rk4", 7, 0.5, 1.0)),
        (Command::Stage(StageCommand::TickRate(Step::Next)), "tick rate", ("rk4", 10, 0.5, 1.0)),
        // A hand on the wheel is one, though it turns nothing.
        (Command::Run(RunCommand::Act(Action::Rudder(0.0))), "rudder", ("rk4", 10, 0.5, 0.0)),
    ] {
        let mut studio = scripted();
        assert_eq!(studio.viewer.notice.as_deref(), None);
        studio.apply(command.clone());
        let said = format!("you have the {name} now: the script leaves it alone until a restart");
        assert_eq!(studio.viewer.notice.as_deref(), Some(&*said), "{command:?}");
        run_to(&mut studio, 8.5);
        assert_eq!(controls(&studio), expected, "{command:?}");

        studio.apply(StageCommand::Restart);
        run_to(&mut studio, 8.5);
        assert_eq!(controls(&studio), ("rk4", 10, 0.5, 1.0), "the script has all in hand again");
    }
}

#[test]
fn taking_the_same_control_again_gives_no_second_notice() {
    let mut studio = scripted();
    studio.apply(RunCommand::Act(Action::Rudder(0.3)));
    studio.viewer.set_notice("something else");
    studio.apply(RunCommand::RudderRight);
    assert_eq!(studio.viewer.notice.as_deref(), Some("something else"));
    studio.apply(RunCommand::Act(Action::Throttle(0.1)));
    assert_eq!(
        studio.viewer.notice.as_deref(),
        Some("you have the throttle now: the script leaves it alone until a restart")
    );
}

#[test]
fn taking_a_control_gives_no_notice_without_a_remaining_script() {
    let mut studio = open("spring");
    for command in [
        Command::Stage(StageCommand::Pick(3)),
        Command::Stage(StageCommand::TickRate(Step::Next)),
        Command::Run(RunCommand::Act(Action::Throttle(0.3))),
    ] {
        studio.apply(command.clone());
        assert_eq!(studio.viewer.notice.as_deref(), None, "{command:?}");
    }
    let mut studio = open("helm");
    (0..200).for_each(|_| studio.tick());
    studio.apply(RunCommand::Act(Action::Rudder(0.5)));
    assert_eq!(studio.viewer.notice.as_deref(), None, "the script is over");
}

#[test]
fn only_a_throttle_by_hand_changes_the_analysis_request() {
    let text = SCENES.iter().find(|scene| scene.name == "ship").unwrap().text;
    let script = "[[command]]\nat_s = 1.5\nthrottle = 0.5\n";
    let mut studio = Studio::new(Scene::parse("ship.toml", &format!("{text}{script}")).unwrap());
    let asked = studio.analysis_request();
    (0..10).for_each(|_| studio.tick());
    assert_eq!(studio.race().throttle(), 0.5);
    assert!(studio.analysis_request() == asked, "nothing is asked that was not asked at the start");
    studio.apply(RunCommand::Act(Action::Throttle(0.2)));
    let by_hand = studio.analysis_request();
    assert!(by_hand != asked);
    (0..10).for_each(|_| studio.tick());
    assert!(studio.analysis_request() == by_hand);
    studio.apply(StageCommand::Restart);
    assert!(studio.analysis_request() == asked);
}

#[test]
fn a_jump_is_higher_at_a_higher_rate() {
    let (mut slow, mut fast) = (open("jump"), open("jump"));
    press(&mut fast, &[HIGHER_RATE]);
    let [low, high] = [&mut slow, &mut fast].map(|studio| largest(studio, 0, 0.8));
    assert!((low - 1.1445).abs() < 1e-9 && high > low + 0.01, "{low} {high}");
}

/// The text around a key in a hint: before it, and after it up to the next digit.
pub(crate) struct Told<'a> {
    before: &'a str,
    pub(crate) after: &'a str,
}

/// The keys in a hint, in order, with the text around each.
pub(crate) fn told_keys(hint: &str) -> Vec<(Command, Told<'_>)> {
    let parts: Vec<&str> = hint.split('`').collect();
    let named = (1..parts.len()).step_by(2).map(|at| {
        let all = KEYS.iter().flat_map(|binding| binding.keys);
        let bound = all.clone().find(|(key, _)| key.to_string() == parts[at]);
        let (_, command) = bound.unwrap_or_else(|| panic!("no key {} in {hint}", parts[at]));
        let from: usize = parts[..=at].iter().map(|part| part.len() + 1).sum();
        let rest = &hint[from..];
        let next =
            rest.find('`').filter(|at| rest[at + 1..].starts_with(|c: char| c.is_ascii_digit()));
        let after = &rest[..next.unwrap_or(rest.len())];
        (command.clone(), Told { before: &hint[..from], after })
    });
    named.collect()
}

/// The id of the first method that is named in words, where the name begins.
fn first_named(words: &str) -> Option<(usize, &'static str)> {
    let words = words.to_lowercase();
    let found = METHODS.iter().filter_map(|method| {
        let at = words.find(&method.name.to_lowercase())?;
        Some((at, std::cmp::Reverse(method.name.len()), method.id))
    });
    found.min().map(|(at, _, id)| (at, id))
}

/// The number of key presses in the words after a key, and the resulting tick rate.
pub(crate) fn presses(after: &str) -> (usize, Option<u32>) {
    let times = [("twice", 2), ("three times", 3), ("four times", 4)];
    let word = after.trim_start();
    let count = times.iter().find(|(words, _)| word.starts_with(words)).map_or(1, |it| it.1);
    let rate = word.split_once("for ").filter(|(before, _)| before.len() < 14);
    let rate = rate.and_then(|(_, rest)| rest.split_once(" Hz")?.0.parse().ok());
    (count, rate)
}

/// Presses the keys of a hint and compares the outcome with the hint.
fn hold(studio: &mut Studio, hint: &str, command: &Command, told: &Told<'_>) {
    let (tick, hz, mode) = (studio.race().tick(), studio.clock().tick_hz(), studio.mode());
    let scene = studio.deck.scene_name();
    let helm = (studio.race().throttle(), studio.race().rudder());
    let rows = studio.race().journal().rows().len();
    let asked = studio.apply(command.clone());
    match command {
        Command::Stage(StageCommand::Pick(entry)) => {
            assert_eq!(studio.active(), *entry, "{hint}");
            if let Some((_, id)) = first_named(told.after) {
                assert_eq!(studio.entries()[*entry].method.id, id, "{hint}");
            }
        }
        Command::Stage(StageCommand::ToggleRace) => {
            assert_eq!((mode, studio.mode()), (Mode::Solo, Mode::Race), "{hint}");
            let has_truth = studio.race().truth().halted().is_none();
            assert!(has_truth || !hint.contains("exact"), "{hint}");
            assert!(studio.race().entrants().len() > 1, "{hint}");
        }
        Command::Stage(StageCommand::TickRate(step)) => {
            let (count, wanted) = presses(told.after);
            (1..count).for_each(|_| _ = studio.apply(command.clone()));
            let now = studio.clock().tick_hz();
            assert!((now > hz) == (*step == Step::Next) && now != hz, "{hint}: {hz} to {now} Hz");
            assert!(wanted.is_none_or(|wanted| now == wanted), "{hint}: {hz} to {now} Hz");
        }
        Command::Stage(StageCommand::Tick(Step::Previous)) => {
            assert_eq!(studio.race().tick() + 1, tick, "{hint}");
        }
        Command::Stage(StageCommand::Restart) => assert_eq!(studio.race().tick(), 0, "{hint}"),
        Command::Stage(StageCommand::InstrumentBeside(_)) => {
            let seen = (0..20).any(|_| {
                studio.apply(command.clone());
                hint.contains(&studio.display().instrument.name().to_lowercase())
            });
            assert!(seen, "{hint}");
        }
        Command::Stage(StageCommand::ToggleArrangement) => {
            assert_eq!(studio.display().arrangement, Arrangement::SideBySide, "{hint}");
            assert_eq!(mode, Mode::Race, "{hint}");
        }
        Command::Stage(StageCommand::SceneBeside(_)) => {
            assert_ne!(studio.deck.scene_name(), scene, "{hint}");
        }
        Command::View(ViewCommand::TogglePause) => assert!(studio.running(), "{hint}"),
        Command::View(ViewCommand::ToggleGuide) => assert!(studio.viewer.tour().is_some()),
        Command::View(ViewCommand::Copy) => assert!(asked.is_some(), "{hint}"),
        Command::Run(RunCommand::NextImpact) => {
            assert_eq!(studio.race().journal().rows().len(), rows + 1, "{hint}");
        }
        Command::Run(RunCommand::ToggleInspector) => assert!(studio.display().inspector, "{hint}"),
        Command::Run(RunCommand::Act(Action::Kick(_))) => {
            assert_eq!(studio.race().journal().rows().len(), rows + 1, "{hint}");
        }
        Command::Run(
            RunCommand::ThrottleUp
            | RunCommand::ThrottleDown
            | RunCommand::RudderLeft
            | RunCommand::RudderRight,
        ) => {
            let now = (studio.race().throttle(), studio.race().rudder());
            assert!(now != helm || told.before.contains('↑'), "{hint}: {helm:?}");
        }
        other => panic!("no rule for {other:?}, which {hint} asks for"),
    }
}

/// Whether a hint starts with a method only if some lane flies it.
fn names_the_selected_method(studio: &Studio, hint: &str) -> bool {
    let before = hint.split('`').next().unwrap_or_default();
    first_named(before).is_none_or(|(at, id)| {
        at > 0 || studio.race().entrants().iter().any(|lane| lane.spec.method.id == id)
    })
}

#[test]
fn every_key_in_every_hint_does_as_promised() {
    let mut held = 0;
    for scene in SCENES {
        let parsed = Scene::built_in(scene.name).unwrap();
        let is_net = parsed.bodies.iter().any(|body| body.kind.net().is_some());
        let count = if is_net { 1 } else { parsed.lanes.len().min(5) };
        let seconds = if is_net { 0 } else { 1 };
        for (race, paused, entry) in (0..4 * count).map(|i| (i & 1 > 0, i & 2 > 0, i / 4)) {
            // The hints of a race or a pause do not depend on the method.
            if entry > 0 && (race || paused) {
                continue;
            }
            let begin = || {
                let mut studio = Studio::new(parsed.clone());
                if entry > 0 {
                    studio.apply(StageCommand::Pick(entry));
                }
                if race {
                    studio.apply(StageCommand::ToggleRace);
                }
                studio.viewer.begin_hints();
                while studio.race().t() < f64::from(seconds) {
                    studio.tick();
                }
                if paused {
                    studio.apply(ViewCommand::TogglePause);
                }
                studio
            };
            let mut done: Vec<Command> = Vec::new();
            let again = |done: &[Command]| {
                let mut studio = begin();
                done.iter().for_each(|command| _ = studio.apply(command.clone()));
                studio
            };
            loop {
                let reached = again(&done);
                let hint = reached.hint().filter(|_| reached.viewer.tour().is_none());
                let Some(hint) = hint else { break };
                assert!(done.len() < 20, "{}: {hint} stays", scene.name);
                assert!(names_the_selected_method(&reached, &hint), "{}: {hint}", scene.name);
                let keys = told_keys(&hint);
                assert!(!keys.is_empty(), "{hint} asks for no key");
                for (index, (command, told)) in keys.iter().enumerate() {
                    let mut studio = again(&done);
                    // A pause in a hint follows the keys before it.
                    if matches!(command, Command::View(ViewCommand::TogglePause)) {
                        keys[..index].iter().for_each(|(key, _)| _ = studio.apply(key.clone()));
                    }
                    hold(&mut studio, &hint, command, told);
                    held += 1;
                }
                done.push(keys[0].0.clone());
            }
        }
    }
    assert!(held > 1000, "{held}");
}

#[test]
fn no_hint_asks_for_a_race_during_a_race() {
    let mut studio = open("spring");
    studio.apply(StageCommand::ToggleRace);
    studio.viewer.begin_hints();
    for _ in SCENES {
        assert_eq!(studio.mode(), Mode::Race);
        let hint = studio.hint().unwrap_or_default();
        assert!(!hint.contains("to race"), "{}: {hint}", studio.scene().name);
        studio.apply(StageCommand::SceneBeside(Step::Next));
    }
}
