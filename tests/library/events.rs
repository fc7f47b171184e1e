//! An event happens at its time, at any tick rate and after any change of the rate.

use regatta::measure::Judge;
use regatta::run::Journal;
use regatta::run::race::{Author, Race};
use regatta::scene::{Action, LaneSpec, SCENES, Scene, Scripted};
use regatta::sim::integrators::method;
use regatta::studio::{RunCommand, StageCommand, Studio};

use crate::scenes::edited;

/// The first coordinates and velocities of the truth after each tick of the scene's own rate, run at `times` that rate.
fn truth(scene: &Scene, times: u32, ticks: u64) -> Vec<Vec<f64>> {
    let tick_hz = scene.tick_hz.scaled(times, 1);
    let mut race = Race::of_scene(&edited(scene, |scene| {
        scene.tick_hz = tick_hz;
        scene.lanes.clear();
    }));
    let mut curve = Vec::new();
    for _ in 0..ticks {
        race.run(u64::from(times));
        let here = race.truth().bodies().iter().filter(|body| body.halted().is_none());
        curve.push(here.flat_map(|body| [body.stepper.q()[0], body.stepper.v()[0]]).collect());
    }
    curve
}

#[test]
fn the_truth_of_every_scene_is_one_curve_at_four_tick_rates() {
    for built_in in SCENES {
        let scene = Scene::built_in(built_in.name).unwrap();
        let seconds = scene.script.last().map_or(1.0, |last| last.at_s + 1.0);
        let ticks = ((seconds * f64::from(scene.tick_hz)) as u64).max(1);
        let own = truth(&scene, 1, ticks);
        assert!(!scene.script.is_empty() || own.len() as u64 == ticks);
        for times in [2, 3, 7] {
            let other = truth(&scene, times, ticks);
            for (tick, (own, other)) in own.iter().zip(&other).enumerate() {
                assert_eq!(own.len(), other.len(), "{} after tick {tick}", scene.name);
                for (own, other) in own.iter().zip(other) {
                    let off = (own - other).abs() / (1.0 + own.abs());
                    let what = format!("{} ×{times} after tick {tick}", scene.name);
                    assert!(off < 1e-6, "{what}: {own}, {other}");
                }
            }
        }
    }
}

/// The times of the script's actions that were performed, in seconds.
fn done(studio: &Studio) -> Vec<f64> {
    let (race, times) = (studio.race(), studio.run().times());
    let rows = race.journal().rows().iter();
    let done = rows.filter(|row| row.author == Author::Script && row.tick < race.tick());
    done.map(|row| times.t(row.tick)).collect()
}

fn run_to(studio: &mut Studio, seconds: f64) {
    while studio.race().t() < seconds {
        studio.tick();
    }
}

#[test]
fn a_change_of_rate_in_flight_keeps_the_times_of_later_events() {
    let mut studio = Studio::new(Scene::built_in("lerp").unwrap());
    run_to(&mut studio, 1.0);
    studio.apply(StageCommand::TickHz(240.into()));
    run_to(&mut studio, 3.0);
    studio.apply(StageCommand::TickHz(7.into()));
    run_to(&mut studio, 5.0);
    let [first, second] = done(&studio)[..] else { panic!("{:?}", done(&studio)) };
    assert!((first - 2.0).abs() < 1e-9, "{first}");
    assert!((second - 4.0).abs() <= 0.5 / 7.0, "{second}");
    // Back before both changes, where something else is done, they are no more.
    studio.apply(RunCommand::Seek(10));
    studio.apply(RunCommand::Act(Action::Kick(0.5)));
    run_to(&mut studio, 5.0);
    assert_eq!((done(&studio), studio.race().tick_hz()), (vec![2.0, 4.0], 30.into()));
    studio.apply(RunCommand::Undo);
    run_to(&mut studio, 5.0);
    assert_eq!((done(&studio), studio.race().tick_hz()), (vec![first, second], 7.into()));
    // After a restart, at the rate that was chosen.
    studio.apply(StageCommand::TickHz(240.into()));
    studio.apply(StageCommand::Restart);
    run_to(&mut studio, 5.0);
    assert_eq!((done(&studio), studio.race().tick_hz()), (vec![2.0, 4.0], 240.into()));
}

#[test]
fn a_run_judged_from_an_edit_keeps_the_times_of_its_script() {
    // At 30 Hz, after 1.5 s, 2 s are half a second on, however the rate was before.
    let mut studio = Studio::new(Scene::built_in("lerp").unwrap());
    run_to(&mut studio, 1.5);
    studio.apply(StageCommand::TickHz(60.into()));
    studio.apply(RunCommand::Act(Action::Place { body: 0, q: [0.3].into(), v: [0.0].into() }));
    let mut rest = Scene::built_in("lerp").unwrap();
    rest.script.iter_mut().for_each(|row| row.at_s -= 1.5);
    let place = Action::Place { body: 0, q: [0.3].into(), v: [0.0].into() };
    rest.script.insert(0, Scripted { at_s: 0.0, action: place });
    let entry = studio.active();
    studio.analyse();
    let found = studio.viewer.verdict(entry).expect("it is judged").error();
    let wanted = Judge::new(&rest).verdict(studio.entries()[entry], 60).error();
    let (found, wanted) = (found.unwrap(), wanted.unwrap());
    assert!(wanted > 0.01 && (found / wanted - 1.0).abs() < 1e-9, "{found}, {wanted}");
}

#[test]
fn verdict_and_run_put_an_event_on_the_same_tick() {
    let spec = LaneSpec::plain(method("lerp-per-frame").unwrap());
    let mut scene = Scene::built_in("lerp").unwrap();
    for (at_s, tick_hz) in [(2.03, 7), (1.96, 7), (2.49, 2), (2.497, 240)] {
        scene.script[0].at_s = at_s;
        let tick = Journal::of_script(&scene.script, tick_hz).rows()[0].tick;
        let mut on_tick = scene.clone();
        on_tick.script[0].at_s = tick as f64 / f64::from(tick_hz);
        let [between, on] = [&scene, &on_tick].map(|scene| error(scene, spec, tick_hz));
        let what = format!("{at_s} s at {tick_hz} Hz: {between}, and {on} on tick {tick}");
        assert!(on > 0.1 && (between / on - 1.0).abs() < 1e-3, "{what}");
    }
}

fn error(scene: &Scene, spec: LaneSpec, tick_hz: u32) -> f64 {
    Judge::new(scene).verdict(spec, tick_hz).error().expect("it comes to the end")
}

/// A spring that is kicked after 90 ticks, after 120, and after half a second more at another rate.
const IN_TICKS: &str = "title = 'x'\ntick_hz = 60\nseconds = 9\nmethods = ['rk4']\n\
    [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\n\
    # Twice.\n[[command]]\ntick = 90\nkick = 1\n[[command]]\ntick = 120\ntick_hz = 10\n\
    [[command]]\ntick = 125\nkick = 1\n";

#[test]
fn the_tick_key_is_refused_in_a_scene_with_the_seconds_to_write() {
    let said = Scene::parse("old.toml", IN_TICKS).unwrap_err().to_string();
    assert_eq!(said.lines().count(), 3);
    assert_eq!(
        said.lines().last().unwrap(),
        "old.toml:16:8: `tick` is for recordings: at another tick rate the motion would change; \
         write `at_s = 2.5` in its place"
    );
    let text = ["1.5", "2", "2.5"]
        .iter()
        .zip(["90", "120", "125"])
        .fold(IN_TICKS.to_owned(), |text, (at_s, tick)| {
            text.replace(&format!("\ntick = {tick}"), &format!("\nat_s = {at_s}"))
        });
    let scene = Scene::parse("new.toml", &text).unwrap();
    let at_s = |scene: &Scene| scene.script.iter().map(|row| row.at_s).collect::<Vec<_>>();
    // At another rate, at the same times.
    let journal = Journal::of_script(&scene.script, 20);
    assert_eq!(journal.rows().iter().map(|row| row.tick).collect::<Vec<_>>(), [30, 40, 45]);
    let faster = edited(&scene, |scene| scene.tick_hz = 120.into());
    for text in [faster.to_toml(), faster.to_saved_toml()] {
        let again = Scene::parse("new.toml", &text).unwrap();
        assert!(text.contains("at_s = 2.5"), "{text}");
        assert_eq!(at_s(&again), at_s(&faster));
    }
}

#[test]
fn a_recording_uses_ticks_and_a_scene_without_checks_may_not() {
    let mut studio = Studio::new(Scene::built_in("helm").unwrap());
    (0..12).for_each(|_| studio.tick());
    studio.apply(StageCommand::TickHz(60.into()));
    (0..260).for_each(|_| studio.tick());
    let text = studio.deck.recording().unwrap();
    assert!(!text.contains("at_s"), "{text}");
    let ticks: Vec<_> = text.lines().filter(|line| line.starts_with("tick = ")).collect();
    // The rate, and 0.6 s later, at 60 Hz, the rudder.
    assert_eq!(ticks[..2], ["tick = 12", "tick = 48"], "{text}");
    let scene = Scene::parse("run.toml", &text).unwrap();
    assert_eq!(scene.to_saved_toml(), text);
    let bare = text.split_once("\n[[check]]").unwrap().0;
    assert!(Scene::parse("run.toml", bare).is_err(), "nothing repeats it");
}
