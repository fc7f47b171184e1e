//! The hint under the stage. The scene's own asks for its first key; when that is pressed, the hints lead on through
//! what the program can do.

use crate::lab::analysis::Outcome;
use crate::lab::studio::command::{Command, RunCommand, StageCommand, ViewCommand};
use crate::lab::studio::key::KEYS;
use crate::lab::studio::step::Step;

/// What a hint after the scene's own asks for.
struct Lead {
    /// The sentence. Keys stand between backticks.
    text: &'static str,
    is_done_by: fn(&Command) -> bool,
}

static LEADS: [Lead; 6] = [
    Lead {
        text: "Press `Home` to see it from the start.",
        is_done_by: |command| {
            matches!(command, Command::Stage(StageCommand::Restart | StageCommand::ToggleRace))
        },
    },
    Lead {
        text: "Press `C` to race all methods against the exact solution, in white.",
        is_done_by: |command| matches!(command, Command::Stage(StageCommand::ToggleRace)),
    },
    Lead {
        text: "Hold `,` to go back in time, tick by tick. `Space` goes on from there.",
        is_done_by: |command| {
            matches!(
                command,
                Command::Stage(
                    StageCommand::Tick(Step::Previous) | StageCommand::Second(Step::Previous)
                ) | Command::Run(RunCommand::Seek(_))
            )
        },
    },
    Lead {
        text: "Press `T` until the stability map is there, and drag its cross.",
        is_done_by: |command| {
            matches!(
                command,
                Command::Stage(StageCommand::InstrumentBeside(_) | StageCommand::Instrument(_))
            )
        },
    },
    Lead {
        text: "Press `[` and `]` to change the tick rate: who survives a coarse one?",
        is_done_by: |command| {
            matches!(command, Command::Stage(StageCommand::TickRate(_) | StageCommand::TickHz(_)))
        },
    },
    Lead {
        text: "Press `F2` for the guide through the chapter, or `N` for the next scene.",
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

/// Which hints a person has followed.
#[derive(Clone, Debug, Default)]
pub(in crate::lab::studio) struct Hints {
    /// That of the open scene.
    scene: bool,
    leads: [bool; LEADS.len()],
}

impl Hints {
    /// For a scene that has just been opened.
    pub(in crate::lab::studio) fn of_next_scene(&self) -> Self {
        Self { scene: false, leads: self.leads }
    }

    /// Marks the hints that this command fulfils. `hint` is the scene's.
    pub(in crate::lab::studio) fn see(&mut self, command: &Command, hint: Option<&str>) {
        self.scene |= hint.and_then(asked).is_some_and(|asked| asked.contains(&command));
        for (done, lead) in self.leads.iter_mut().zip(&LEADS) {
            *done |= (lead.is_done_by)(command);
        }
    }

    /// The present hint: the scene's, or else the first that was not followed. `flown` is the name of the method and the
    /// outcome of its verdict. Only a run that was changed on its way is worth another look from the start.
    pub(in crate::lab::studio) fn text(
        &self,
        hint: Option<&str>,
        (method, outcome): (&str, Option<Outcome>),
        was_changed: bool,
    ) -> Option<String> {
        if let Some(hint) = hint.filter(|_| !self.scene) {
            return Some(hint.to_owned());
        }
        let first = usize::from(!was_changed);
        let next = (first..LEADS.len()).find(|&lead| !self.leads[lead])?;
        if next == 0 && hint.is_some() {
            return Some(format!("{method} {}. {}", reaction(outcome), LEADS[0].text));
        }
        Some(LEADS[next].text.to_owned())
    }
}

/// Whether what a hint asks for makes sense in a race: there a digit switches nothing, and `C` has been pressed.
pub(in crate::lab::studio) fn suits_race(hint: &str) -> bool {
    let is_of_solo = |command: &&Command| {
        use StageCommand::{Method, MethodBeside, Pick, ToggleRace};
        matches!(command, Command::Stage(Pick(_) | Method(_) | MethodBeside(_) | ToggleRace))
    };
    !keys(hint).flat_map(bound_to).any(|command| is_of_solo(&command))
}

/// What a method does, in words that follow its name.
fn reaction(outcome: Option<Outcome>) -> &'static str {
    match outcome {
        Some(Outcome::Rounding | Outcome::Accurate) => "keeps to the exact motion",
        Some(Outcome::OutOfPhase) => "stays bounded, a little out of step",
        Some(Outcome::LosesEnergy) => "loses energy",
        Some(Outcome::GainsEnergy) => "gains energy",
        Some(Outcome::GaveUp | Outcome::BlewUp) => "is lost",
        Some(Outcome::NotJudged | Outcome::NoTruth) | None => "has taken over",
    }
}

/// The commands of the first key that a hint names.
fn asked(hint: &str) -> Option<Vec<&'static Command>> {
    let commands: Vec<_> = bound_to(keys(hint).next()?).collect();
    (!commands.is_empty()).then_some(commands)
}

/// The names of the keys in a text, which stand between backticks.
fn keys(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// The commands of the key that people call so.
fn bound_to(name: &str) -> impl Iterator<Item = &'static Command> {
    let bound = KEYS.iter().flat_map(|binding| binding.keys);
    bound.filter(move |(key, _)| key.to_string() == name).map(|(_, command)| command)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{SCENES, Scene};

    #[test]
    fn the_hint_of_every_scene_asks_for_a_key_of_the_table() {
        for scene in SCENES {
            let hint = Scene::built_in(scene.name).unwrap().hint.expect("a hint");
            assert!(asked(&hint).is_some(), "{}: {hint}", scene.name);
            assert_eq!(hint.matches('`').count() % 2, 0, "{hint}");
        }
        for lead in &LEADS {
            let commands = asked(lead.text).expect("a key of the table");
            assert!(commands.iter().any(|command| (lead.is_done_by)(command)), "{}", lead.text);
        }
    }

    #[test]
    fn in_a_race_no_hint_asks_for_what_only_solo_does() {
        use crate::lab::Studio;
        for scene in SCENES {
            let mut studio = Studio::new(Scene::built_in(scene.name).unwrap());
            let solo = studio.hint().expect("a hint");
            studio.apply(StageCommand::ToggleRace);
            studio.begin_hints();
            let hint = studio.hint().expect("a lead");
            assert!(suits_race(&hint), "{}: {hint}", scene.name);
            studio.apply(StageCommand::ToggleRace);
            assert!(studio.hint().is_some(), "{}: {solo}", scene.name);
        }
        assert!(suits_race("Press `[`.") && !suits_race("Press `2`."));
        assert!(!suits_race("Steer with `←`. `C` races all methods."), "its last key counts too");
    }

    #[test]
    fn nobody_is_asked_to_start_again_what_has_only_just_begun() {
        use crate::lab::Studio;
        let text = "title = 'mine'\ntick_hz = 60\nseconds = 9\nmethods = ['rk4', 'implicit-euler']\n\
             [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 9\nx0_m = 1\n";
        let mut studio = Studio::new(Scene::parse("mine.toml", text).unwrap());
        let asks_for = |studio: &Studio, key: &str| studio.hint().expect("a lead").contains(key);
        assert!(asks_for(&studio, "`C`"), "it was just opened");
        studio.apply(StageCommand::Pick(1));
        assert!(asks_for(&studio, "`C`"), "it starts under the other method");
        studio.tick();
        studio.apply(StageCommand::Pick(0));
        assert!(asks_for(&studio, "`Home`"), "it did not start under this one");
        studio.apply(StageCommand::Restart);
        assert!(asks_for(&studio, "`C`"));
    }

    #[test]
    fn hints_lead_on_when_they_are_followed_and_in_any_order() {
        let hint = Some("It grows. Press `2`.");
        let mut hints = Hints::default();
        let flown = ("Semi-implicit Euler", Some(Outcome::OutOfPhase));
        let text = |hints: &Hints| hints.text(hint, flown, true).unwrap_or_default();
        assert_eq!(text(&hints), "It grows. Press `2`.");
        hints.see(&Command::Stage(StageCommand::Tick(Step::Previous)), hint);
        assert_eq!(text(&hints), "It grows. Press `2`.");
        hints.see(&Command::Stage(StageCommand::Pick(1)), hint);
        assert!(text(&hints).starts_with("Semi-implicit Euler stays bounded"), "{}", text(&hints));
        assert!(text(&hints).contains("`Home`"));
        hints.see(&Command::Stage(StageCommand::Restart), hint);
        assert!(text(&hints).contains("`C`"));
        hints.see(&Command::Stage(StageCommand::ToggleRace), hint);
        assert!(text(&hints).contains("`T`"), "going back was done before");
        let next = hints.of_next_scene();
        assert_eq!(text(&next), "It grows. Press `2`.");
        hints.see(&Command::Stage(StageCommand::InstrumentBeside(Step::Next)), hint);
        hints.see(&Command::Stage(StageCommand::TickRate(Step::Next)), hint);
        hints.see(&Command::Stage(StageCommand::SceneBeside(Step::Next)), hint);
        assert_eq!(hints.text(hint, flown, true), None);
    }
}
