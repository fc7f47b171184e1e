//! The samples behind trails and plots: every sample knows its method, a switch leaves a mark, and the newest sample
//! is the present.

use regatta::run::past::History;
use regatta::scene::{LaneId, Scene};
use regatta::studio::{StageCommand, Step, Studio};

use crate::scenes::edited;

fn studio(seconds: f64, tick_hz: u32) -> Studio {
    let scene = edited(&Scene::built_in("spring").unwrap(), |scene| {
        (scene.seconds, scene.tick_hz) = (seconds, tick_hz.into());
    });
    Studio::new(scene)
}

fn history(studio: &Studio) -> &History {
    &studio.past().histories(LaneId(1))[0]
}

const FRAME_NS: i64 = 16_666_667;

#[test]
fn after_every_frame_the_newest_sample_is_the_present() {
    // A sample at every 49th tick.
    let mut studio = studio(100.0, 1000);
    for frame in 0..300 {
        studio.advance(FRAME_NS);
        let newest = history(&studio).samples().last().unwrap();
        assert_eq!(newest.t, studio.race().t(), "after frame {frame}");
        let stepper = &studio.race().entrants()[0].lane.bodies()[0].stepper;
        assert_eq!((newest.q, newest.v), (stepper.q()[0], stepper.v()[0]));
    }
    let count = history(&studio).samples().count();
    assert!((100..=104).contains(&count), "{count} samples of 5 s");
    studio.apply(StageCommand::Tick(Step::Next));
    assert_eq!(history(&studio).samples().last().unwrap().t, studio.race().t());
}

#[test]
fn a_swing_faster_than_the_samples_shows_in_their_swept_range() {
    // 158 swings per second, and a sample at every 30th tick: at nearly the same place of every fifth swing.
    let text = "title = 'fast'\ntick_hz = 1000\nseconds = 60\nmethods = ['velocity-verlet']\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1e6\nx0_m = 1\n";
    let mut studio = Studio::new(Scene::parse("fast.toml", text).unwrap());
    (0..3000).for_each(|_| studio.tick());
    let least =
        |q: f64| move |least: f64, sample: &regatta::run::past::Sample| least.min(q * sample.q);
    assert!(history(&studio).samples().fold(0.0, least(1.0)) > -1.0, "no sample is at the far end");
    let samples: Vec<[f64; 2]> = history(&studio).samples().map(|s| s.swept.ends()).collect();
    assert!(samples[1..].iter().all(|&[low, high]| low < -0.8 && high > 0.8), "{samples:?}");
    let truth = studio.past().truth_curves()[0].samples();
    let truth: Vec<[f64; 2]> = truth.map(|sample| sample.swept.ends()).collect();
    assert!(truth[1..].iter().all(|&[low, high]| low < -0.8 && high > 0.8), "{truth:?}");
}

#[test]
fn a_switch_in_flight_keeps_the_method_of_the_past_and_marks_its_moment() {
    for (tick_hz, seconds) in [(60, 20.0), (1000, 100.0)] {
        let mut studio = studio(seconds, tick_hz);
        let mut switched_at = Vec::new();
        for pick in [1, 3, 0] {
            for _ in 0..50 {
                studio.advance(FRAME_NS);
            }
            switched_at.push(studio.race().t());
            studio.apply(StageCommand::Pick(pick));
        }
        studio.advance(FRAME_NS);
        let flown: Vec<(usize, f64)> = history(&studio).samples().map(|s| (s.entry, s.t)).collect();
        let runs: Vec<(usize, f64, f64)> = flown
            .chunk_by(|one, next| one.0 == next.0)
            .map(|run| (run[0].0, run[0].1, run[run.len() - 1].1))
            .collect();
        let [a, b, c] = switched_at[..] else { panic!() };
        assert_eq!(runs, [(0, 0.0, a), (1, a, b), (3, b, c), (0, c, studio.race().t())]);
        let samples = history(&studio).samples();
        assert!(samples.clone().zip(samples.skip(1)).all(|(one, next)| one.t <= next.t));
    }
}

#[test]
fn a_method_switched_to_itself_leaves_no_mark() {
    let flown = |picks: bool| {
        // A sample at every 49th tick.
        let mut studio = studio(100.0, 1000);
        for _ in 0..100 {
            studio.advance(FRAME_NS);
            if picks {
                studio.apply(StageCommand::Pick(studio.active()));
            }
        }
        history(&studio).samples().map(|sample| sample.t).collect::<Vec<_>>()
    };
    assert_eq!(flown(true), flown(false));
}
