//! The recording of a studio's run repeats it after any sequence of commands. The seed is printed; `REGATTA_SEED`
//! sets another, and `REGATTA_WALKS` the number of walks.

use regatta::run::Session;
use regatta::run::race::Mode;
use regatta::scene::{Action, SCENES, Scene};
use regatta::studio::guide::STOPS;
use regatta::studio::{Command, RunCommand, StageCommand, Studio, ViewCommand, open_file};

use crate::dice::Dice;

const STEPS: usize = 300;
/// The number of steps between two comparisons of the run with its recording.
const HELD: usize = 50;
/// One in `BEGUN` steps starts a new run, which forgets the steps before.
const BEGUN: usize = 8;
/// Those that are stepped in no time.
const LIGHT: [&str; 7] = ["harbour", "spring", "ship", "helm", "stiff", "orbit", "follow"];

fn walks() -> usize {
    let wanted = std::env::var("REGATTA_WALKS").ok().and_then(|walks| walks.parse().ok());
    wanted.unwrap_or(if cfg!(debug_assertions) { 60 } else { 200 })
}

fn action(dice: &mut Dice, studio: &Studio) -> Action {
    let race = studio.race();
    let body = dice.below(race.truth().bodies().len());
    match dice.below(6) {
        0 => Action::Kick(dice.between(-1.0, 1.0)),
        1 => Action::Throttle(dice.between(-1.0, 1.0)),
        2 => Action::Rudder(dice.between(-1.0, 1.0)),
        3 => Action::TickHz([30, 49, 60, 120][dice.below(4)].into()),
        4 => {
            let parameter = dice.below(race.truth().bodies()[body].kind.parameters.len());
            let value = race.values(body)[parameter] * dice.between(0.8, 1.25);
            Action::Set { body, parameter, value }
        }
        _ => {
            let truth = &race.truth().bodies()[body].stepper;
            let factor = dice.between(0.9, 1.1);
            let moved = |values: &[f64]| values.iter().map(|x| factor * x).collect();
            Action::Place { body, q: moved(truth.q()), v: moved(truth.v()) }
        }
    }
}

/// One thing that a person does, by its name.
fn step(dice: &mut Dice, studio: &mut Studio) -> String {
    let chosen = dice.below(40);
    let begins = [33, 34].contains(&chosen) || chosen > 36;
    let command: Command = match if begins && dice.below(BEGUN) > 0 { 0 } else { chosen } {
        0..12 => {
            let ticks = dice.below(40);
            (0..ticks).for_each(|_| studio.tick());
            return format!("{ticks} ticks");
        }
        12..18 => RunCommand::Act(action(dice, studio)).into(),
        18..21 => StageCommand::Pick(dice.below(studio.entries().len())).into(),
        21..25 => RunCommand::Seek(dice.below(studio.run().end() as usize + 1) as u64).into(),
        25..30 => RunCommand::Undo.into(),
        30..33 => RunCommand::Redo.into(),
        33 => StageCommand::Restart.into(),
        34 => StageCommand::ToggleRace.into(),
        35 => RunCommand::ToggleEqualCost.into(),
        36 => RunCommand::Seconds(dice.between(5.0, 30.0)).into(),
        37 => {
            let light = |&at: &usize| LIGHT.contains(&STOPS[at].scene);
            let stops: Vec<usize> = (0..STOPS.len()).filter(light).collect();
            ViewCommand::GoToStop(stops[dice.below(stops.len())]).into()
        }
        38 => {
            let name = LIGHT[dice.below(LIGHT.len())];
            let at = SCENES.iter().position(|scene| scene.name == name).expect("a built-in scene");
            StageCommand::Scene(at).into()
        }
        _ => {
            let recording = studio.deck.recording().expect("a run that can be written");
            let scene = Scene::parse("walk.toml", &recording).expect("a recording is a scene");
            open_file(studio, "walk.toml".as_ref(), scene);
            return "the recording is opened".into();
        }
    };
    let name = format!("{command:?}");
    studio.apply(command);
    // A stop of the guide would refuse every walk in time.
    if studio.viewer.is_asked() {
        studio.apply(ViewCommand::Predict(0));
    }
    name
}

/// Runs the recording of a studio's run from its text, and compares all that was noted and the end.
fn repeats(studio: &mut Studio) -> Result<(), String> {
    let text = studio.deck.recording().map_err(|error| error.to_string())?;
    let scene = Scene::parse("walk.toml", &text).map_err(|errors| errors.to_string())?;
    if scene.to_toml() != studio.deck.recorded().to_toml() {
        return Err("its text is another when it was read".into());
    }
    for tick in [0, u64::MAX] {
        studio.apply(RunCommand::Seek(tick));
    }
    let race = studio.race();
    let lanes: Vec<u64> = race.lane_hashes().collect();
    let mut again = Session::racing(scene.clone().into());
    for check in &scene.checks {
        again.run(check.tick - again.race().tick());
        if again.race().lane_hash(check.lane) != Some(check.hash) {
            return Err(format!("the recording is not repeated: {check:?}"));
        }
    }
    // A solo recording replays the lanes of its menu too, so only its own lane is compared.
    let are_same = match (race.mode(), scene.checks.last()) {
        (Mode::Solo, Some(end)) => again.race().lane_hash(end.lane) == lanes.first().copied(),
        _ => again.race().lane_hashes().eq(lanes) && again.race().mode() == race.mode(),
    };
    let is_same = again.race().tick() == race.tick() && are_same;
    if is_same { Ok(()) } else { Err("the run ends elsewhere".into()) }
}

#[test]
fn the_recording_repeats_a_run_to_the_bit_after_any_walk() {
    let mut dice = Dice::new(0x3a);
    let mut ticks = 0;
    for walk in 0..walks() {
        let scene = LIGHT[walk % LIGHT.len()];
        let mut studio = Studio::new(Scene::built_in(scene).expect("a built-in scene"));
        let mut steps = Vec::new();
        for _ in 0..STEPS / HELD {
            steps.extend((0..HELD).map(|_| step(&mut dice, &mut studio)));
            // This gives the run an end to seek to, before it is edited there.
            studio.apply(RunCommand::Seek(u64::MAX));
            studio.tick();
            if let Err(why) = repeats(&mut studio) {
                panic!("walk {walk}: {why}:\n{}", steps.join("\n"));
            }
        }
        ticks += studio.run().end();
    }
    assert!(ticks > 20 * walks() as u64, "{ticks} ticks at the ends of all walks");
}
