//! The hint under the stage. The scene's own hint asks for its first key. After that, further hints present the
//! program. A hint appears only if it is true in the present mode, under the present method, at the present rate.

use super::HintContext;
use crate::Step;
use crate::command::{Command, RunCommand, StageCommand, TICK_LADDER, ViewCommand};
use crate::display::Arrangement;
use crate::instrument::Instrument;
use crate::key::commands_named;
use crate::measure::Outcome;
use crate::run::race::Mode;

/// A hint that follows the scene's own hint.
struct FollowUpHint {
    /// Returns the sentence of the hint, or `None` if it would not be true. Keys stand between backticks.
    text: fn(&HintContext<'_>) -> Option<&'static str>,
    is_done_by: fn(&Command) -> bool,
}

/// Minimum duration (s) of a run that is worth rewinding.
const WORTH_GOING_BACK_S: f64 = 1.0;

/// Index of the hint to restart.
const RESTARTS: usize = 1;

static FOLLOW_UP_HINTS: [FollowUpHint; 8] = [
    FollowUpHint {
        text: |now| {
            let beside = [Step::Previous, Step::Next]
                .map(|step| step.next_rung(&TICK_LADDER, now.race.tick_hz()));
            beside.iter().all(Option::is_some).then_some(match now.is_lost {
                true => "Press `]` for a faster tick, and `Home`: does it hold?",
                false => "Drag the tick rate, or press `[`: the next second unfolds.",
            })
        },
        is_done_by: |command| {
            matches!(command, Command::Stage(StageCommand::TickRate(_) | StageCommand::TickHz(_)))
        },
    },
    FollowUpHint {
        text: |now| (!now.is_from_the_start).then_some("Press `Home` to see it from the start."),
        is_done_by: |command| {
            matches!(command, Command::Stage(StageCommand::Restart | StageCommand::ToggleRace))
        },
    },
    FollowUpHint {
        text: |now| match now.race.mode() {
            Mode::Solo if now.scene.lanes.len() < 2 => None,
            Mode::Solo if now.race.truth().halted().is_some() => {
                Some("Press `C` to race all methods.")
            }
            Mode::Solo => {
                Some("Press `C` to race all methods against the exact solution, in white.")
            }
            Mode::Race => None,
        },
        is_done_by: |command| matches!(command, Command::Stage(StageCommand::ToggleRace)),
    },
    FollowUpHint {
        text: |now| {
            let is_overlaid = now.display.arrangement == Arrangement::Overlay;
            (now.race.mode() == Mode::Race && is_overlaid)
                .then_some("Press `V` to see the lanes side by side. A digit selects one.")
        },
        is_done_by: |command| matches!(command, Command::Stage(StageCommand::ToggleArrangement)),
    },
    FollowUpHint {
        text: |now| {
            (now.race.t() >= WORTH_GOING_BACK_S)
                .then_some("Hold `,` to go back in time, tick by tick. `Space` goes on from there.")
        },
        is_done_by: |command| {
            matches!(
                command,
                Command::Stage(
                    StageCommand::Tick(Step::Previous) | StageCommand::Second(Step::Previous)
                ) | Command::Run(RunCommand::Seek(_))
            )
        },
    },
    FollowUpHint {
        text: |now| {
            (!now.display.measure).then_some("Press `T` to measure: plots, numbers, a timeline.")
        },
        is_done_by: |command| matches!(command, Command::View(ViewCommand::ToggleMeasure)),
    },
    FollowUpHint {
        text: |now| {
            (now.display.instrument != Instrument::StabilityMap)
                .then_some("Press `D` until the stability map is there, and drag its cross.")
        },
        is_done_by: |command| {
            matches!(
                command,
                Command::Stage(StageCommand::InstrumentBeside(_) | StageCommand::Instrument(_))
            )
        },
    },
    FollowUpHint {
        text: |_| Some("Press `F2` for the guide through the chapter, or `N` for the next scene."),
        is_done_by: |command| {
            matches!(
                command,
                Command::View(ViewCommand::ToggleGuide)
                    | Command::Stage(
                        StageCommand::SceneBeside(Step::Next) | StageCommand::Scene(_)
                    )
            )
        },
    },
];

/// The hints that a person has followed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hints {
    /// Whether the person has followed the hint of the open scene.
    scene: bool,
    followed: [bool; FOLLOW_UP_HINTS.len()],
}

impl Hints {
    /// Returns the hints for a scene that has just been opened.
    pub(crate) fn of_next_scene(&self) -> Self {
        Self { scene: false, followed: self.followed }
    }

    /// Marks the hints that this command follows. `hint` is the scene's own hint.
    pub(crate) fn mark_followed(&mut self, command: &Command, hint: Option<&str>) {
        self.scene |=
            hint.and_then(first_key_commands).is_some_and(|asked| asked.contains(&command));
        for (done, hint) in self.followed.iter_mut().zip(&FOLLOW_UP_HINTS) {
            *done |= (hint.is_done_by)(command);
        }
    }

    /// Returns the present hint. It is the scene's own hint, or else the first true hint that the person has not
    /// followed. `outcome` is the verdict on the selected lane.
    pub(crate) fn text(&self, now: &HintContext<'_>, outcome: Option<Outcome>) -> Option<String> {
        let hint = now.scene.hint.as_deref().filter(|hint| applies(hint, now));
        if let Some(hint) = hint.filter(|_| !self.scene) {
            return Some(hint.to_owned());
        }
        let mut left =
            FOLLOW_UP_HINTS.iter().enumerate().filter(|(index, _)| !self.followed[*index]);
        let (index, text) = left.find_map(|(index, hint)| Some((index, (hint.text)(now)?)))?;
        let is_asked_to_restart = self.scene && index == RESTARTS;
        // The verdict is about a run from the start, which may differ from the run on the stage.
        Some(match reaction(outcome).filter(|_| is_asked_to_restart) {
            Some(reaction) => format!("{} {reaction}. {text}", now.method().name),
            None => text.to_owned(),
        })
    }
}

/// Whether the scene's hint applies now. It does at the scene's own tick rate and values. A hint about the mode or its
/// lanes also needs the mode in which the scene opens, and in solo mode a hint about a method needs the opening method.
/// The digits that a hint names must be those of the scene's own lanes.
fn applies(hint: &str, now: &HintContext<'_>) -> bool {
    use StageCommand::{Method, MethodBeside, Pick, ToggleArrangement, ToggleRace};
    let asked: Vec<&StageCommand> = keys(hint)
        .flat_map(commands_named)
        .filter_map(|command| match command {
            Command::Stage(asked) => Some(asked),
            _ => None,
        })
        .collect();
    let asks = |is: fn(&StageCommand) -> bool| asked.iter().any(|asked| is(asked));
    let opens_in = Mode::opening(now.scene);
    let is_of_mode = asks(|asked| {
        matches!(asked, Pick(_) | Method(_) | MethodBeside(_) | ToggleRace | ToggleArrangement)
    });
    let is_of_bands = now.scene.opens_in_bands && asks(|asked| matches!(asked, Pick(_)));
    let lanes = &now.scene.lanes;
    let hint = hint.to_lowercase();
    let is_of_method = asks(|asked| matches!(asked, Pick(_) | Method(_) | MethodBeside(_)))
        || now.menu.iter().any(|spec| hint.contains(&spec.method.name.to_lowercase()));
    let opening = now.scene.opening_method.or(lanes.first().map(|spec| spec.method));
    let is_beyond = |asked: &&StageCommand| matches!(asked, Pick(entry) if *entry >= lanes.len());
    let is_done = |asked: &&StageCommand| matches!(asked, Pick(entry) if *entry == now.active);
    now.has_own_values
        && now.race.tick_hz() == now.scene.tick_hz
        && (!is_of_mode || now.race.mode() == opens_in)
        && (!is_of_method || now.race.mode() == Mode::Race || Some(now.method()) == opening)
        && (!is_of_bands || now.has_bands)
        && !asked.iter().any(is_beyond)
        && (now.race.mode() == Mode::Race || !asked.iter().any(is_done))
}

/// Describes how a method would have done, in words that follow the method's name, or returns `None` if that is
/// unknown.
fn reaction(outcome: Option<Outcome>) -> Option<&'static str> {
    match outcome? {
        Outcome::Rounding | Outcome::Accurate => Some("would have kept to the exact motion"),
        Outcome::LooksRight => Some("would have looked right"),
        Outcome::Bounded => Some("would have stayed bounded"),
        Outcome::DiesAway => Some("would have died away"),
        Outcome::Grows => Some("would have grown"),
        Outcome::GaveUp | Outcome::BlewUp => Some("would have been lost"),
        Outcome::NotJudged | Outcome::NoTruth => None,
    }
}

/// Returns the commands of the first key that a hint names.
fn first_key_commands(hint: &str) -> Option<Vec<&'static Command>> {
    let commands: Vec<_> = commands_named(keys(hint).next()?).collect();
    (!commands.is_empty()).then_some(commands)
}

/// Returns the names of the keys in a text, which stand between backticks.
fn keys(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{SCENES, Scene};

    #[test]
    fn the_hint_of_every_scene_asks_for_a_key_of_the_table() {
        for scene in SCENES {
            let hint = Scene::built_in(scene.name).unwrap().hint.expect("a hint");
            assert!(first_key_commands(&hint).is_some(), "{}: {hint}", scene.name);
            assert_eq!(hint.matches('`').count() % 2, 0, "{hint}");
        }
    }

    #[test]
    fn no_hint_asks_to_restart_a_fresh_run() {
        use crate::Studio;
        let text = "title = 'mine'\ntick_hz = 60\nseconds = 9\nmethods = ['rk4', 'implicit-euler']\n\
             [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 9\nx0_m = 1\n";
        let mut studio = Studio::new(Scene::parse("mine.toml", text).unwrap());
        let asks_for = |studio: &Studio, key: &str| studio.hint().expect("a lead").contains(key);
        assert!(asks_for(&studio, "`[`"), "it was just opened");
        studio.apply(StageCommand::TickHz(60.into()));
        assert!(asks_for(&studio, "`C`"));
        studio.apply(StageCommand::Pick(1));
        assert!(asks_for(&studio, "`C`"), "it starts under the other method");
        studio.tick();
        studio.apply(StageCommand::Pick(0));
        assert!(asks_for(&studio, "`Home`"), "it did not start under this one");
        studio.apply(StageCommand::Restart);
        assert!(asks_for(&studio, "`C`"));
    }

    #[test]
    fn a_lost_run_is_told_to_tick_faster_and_not_slower() {
        use crate::Studio;
        let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
        studio.apply(StageCommand::TickHz(30.into()));
        (0..60).for_each(|_| studio.tick());
        assert!(studio.deck.lost_at().is_some());
        studio.apply(StageCommand::Restart);
        (0..60).for_each(|_| studio.tick());
        studio.viewer.hints = Hints { scene: true, ..Hints::default() };
        let hint = studio.hint().unwrap();
        assert!(hint.contains("`]`") && !hint.contains("`[`"), "{hint}");
    }

    #[test]
    fn a_method_that_is_selected_already_is_not_asked_for() {
        use crate::Studio;
        for name in ["spring", "damped", "pendulum", "harbour"] {
            let mut scene = Scene::built_in(name).unwrap();
            let asks_for_it =
                |scene: &Scene| Studio::new(scene.clone()).hint().unwrap().contains("`2`");
            assert!(asks_for_it(&scene), "{name}");
            scene.opening_method = Some(scene.lanes[1].method);
            assert!(!asks_for_it(&scene), "{name}");
        }
    }

    #[test]
    fn following_hints_in_any_order_leads_to_the_next() {
        use crate::Studio;
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let text = |studio: &Studio| studio.hint().unwrap_or_default();
        let own = text(&studio);
        assert!(own.contains("`2`"), "{own}");
        (0..90).for_each(|_| studio.tick());
        studio.apply(StageCommand::Tick(Step::Previous));
        assert_eq!(text(&studio), own);
        studio.apply(StageCommand::Pick(1));
        assert!(text(&studio).starts_with("Drag the tick rate"));
        studio.apply(StageCommand::TickHz(60.into()));
        assert!(text(&studio).contains("`Home`"));
        studio.apply(StageCommand::Restart);
        assert!(text(&studio).contains("`C`"));
        studio.apply(StageCommand::ToggleRace);
        assert!(text(&studio).contains("`V`"));
        studio.apply(StageCommand::ToggleArrangement);
        (0..90).for_each(|_| studio.tick());
        assert!(text(&studio).contains("`D`"), "going back was done before");
        studio.apply(StageCommand::InstrumentBeside(Step::Next));
        assert!(text(&studio).contains("`F2`"));
        let open = |studio: &mut Studio, name: &str| {
            let place = SCENES.iter().position(|scene| scene.name == name);
            studio.apply(StageCommand::Scene(place.unwrap()));
        };
        open(&mut studio, "damped");
        assert_eq!(studio.hint(), None, "a method in flight is not a race's");
        open(&mut studio, "stiff");
        assert_eq!(studio.hint(), studio.scene().hint, "a rate is a race's too");
        studio.apply(StageCommand::ToggleRace);
        assert_eq!(studio.hint(), studio.scene().hint);
    }
}
