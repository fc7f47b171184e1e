//! The truth between ticks: on a grid that no tick rate changes, and at any moment of a frame.

use std::f64::consts::TAU;

use regatta::run::Observations;
use regatta::run::past::TruthSample;
use regatta::run::race::{Interpolation, Race};
use regatta::scene::{Action, Scene};
use regatta::stage::{Grip, Picture, Whose, compose};
use regatta::studio::{RunCommand, StageCommand, Studio, shown_s};

fn open(scene: &str, tick_hz: u32) -> Studio {
    let mut studio = Studio::new(Scene::built_in(scene).unwrap());
    studio.apply(StageCommand::TickHz(tick_hz.into()));
    studio.apply(StageCommand::Restart);
    studio
}

fn samples(studio: &Studio) -> Vec<TruthSample> {
    studio.past().truth_curves()[0].samples().copied().collect()
}

#[test]
fn a_spring_at_5_hz_reaches_both_ends_of_its_swing() {
    let mut studio = open("spring", 5);
    (0..100).for_each(|_| studio.tick());
    let samples = samples(&studio);
    let ends = samples
        .iter()
        .map(|sample| sample.q)
        .fold([0.0, 0.0], |[low, high]: [f64; 2], q| [low.min(q), high.max(q)]);
    assert!((ends[0] + 1.0).abs() < 1e-3 && (ends[1] - 1.0).abs() < 1e-3, "{ends:?}");
    for TruthSample { t, q, v, at, .. } in samples {
        assert!((q - libm::cos(TAU * t)).abs() < 1e-11, "{q} at {t} s");
        assert!((v + TAU * libm::sin(TAU * t)).abs() < 1e-10, "{v} at {t} s");
        assert_eq!(at.x, q);
    }
}

#[test]
fn a_stiff_spring_at_49_hz_keeps_the_width_of_its_exact_curve() {
    let mut studio = open("stiff", 49);
    (0..600).for_each(|_| studio.tick());
    let samples = samples(&studio);
    let period_s = TAU / 100.0;
    let mut swings = 0;
    for swing in samples.chunk_by(|a, b| (a.t / period_s).floor() == (b.t / period_s).floor()) {
        if swing[swing.len() - 1].t - swing[0].t > 0.95 * period_s {
            let reach = |sign: f64| swing.iter().map(|s| sign * s.q).fold(0.0, f64::max);
            assert!(reach(1.0) > 0.995 && reach(-1.0) > 0.995, "at {} s", swing[0].t);
            swings += 1;
        }
    }
    assert!(swings > 70, "{swings} swings");
}

#[test]
fn the_grid_covers_the_scene_length_at_any_tick_rate() {
    for scene in ["spring", "pendulum", "helm", "orbit"] {
        let seconds = Scene::built_in(scene).unwrap().seconds;
        let [coarse, fine] = [5, 240].map(|hz| {
            let mut studio = open(scene, hz);
            (0..hz * 70).for_each(|_| studio.tick());
            let samples = samples(&studio);
            assert!(samples.is_sorted_by(|a, b| a.t < b.t || (a.t == b.t && a.v != b.v)));
            assert!(samples.len() >= 4096, "{}", samples.len());
            assert!(samples[0].t <= studio.race().t() - seconds, "{scene}");
            samples
        });
        for (a, b) in coarse.iter().rev().zip(fine.iter().rev()) {
            assert!((a.t - b.t).abs() < 1e-9, "{scene}: {} and {} s", a.t, b.t);
            assert!((a.q - b.q).abs() < 1e-6, "{scene}: {} and {} at {} s", a.q, b.q, a.t);
        }
    }
}

#[test]
fn a_kick_is_a_jump_of_the_velocity_at_its_tick() {
    let mut studio = open("spring", 10);
    (0..7).for_each(|_| studio.tick());
    let before = studio.race().truth().bodies()[0].stepper.v()[0];
    studio.apply(RunCommand::Act(Action::Kick(1.0)));
    let after = studio.race().truth().bodies()[0].stepper.v()[0];
    (0..5).for_each(|_| studio.tick());
    let samples = samples(&studio);
    let corner = samples.windows(2).find(|pair| pair[0].t == pair[1].t).expect("a jump");
    assert!((corner[0].t - 0.7).abs() < 1e-12);
    assert_eq!((corner[0].v, corner[1].v), (before, after));
    assert_eq!(corner[0].q, corner[1].q);
}

#[test]
fn an_input_bends_the_curve_from_its_tick_on_and_not_the_tick_before_it() {
    let mut studio = open("ship", 1);
    (0..10).for_each(|_| studio.tick());
    let shown = studio.past().truth_between(studio.race(), 0, 0.5);
    studio.apply(RunCommand::Act(Action::Throttle(-1.0)));
    assert_eq!(studio.past().truth_between(studio.race(), 0, 0.5), shown);
    studio.tick();
    let (_, v) = studio.past().truth_between(studio.race(), 0, 0.0);
    assert!(studio.past().truth_between(studio.race(), 0, 0.5).1 < v, "the engine runs backwards");
}

/// The grips by which a hand can grab the ghost.
fn ghost(studio: &Studio, picture: &Picture) -> Vec<Grip> {
    picture.cells[0].grips(studio).filter(|grip| grip.whose == Whose::Truth).collect()
}

#[test]
fn the_ghost_is_the_exact_motion_at_the_moment_of_the_lanes() {
    let mut studio = open("spring", 5);
    let size = [780.0, 500.0];
    let mut reach = (0.0_f64, 0.0_f64);
    for frame in 0..300 {
        studio.advance(16_666_667);
        let moment_s = (studio.race().tick() as f64 - 1.0 + studio.clock().alpha()) / 5.0;
        if moment_s < 0.0 {
            continue;
        }
        let exact = libm::cos(TAU * moment_s);
        let (q, v) = studio.past().truth_between(studio.race(), 0, studio.clock().alpha());
        assert!((q[0] - exact).abs() < 1e-12, "frame {frame}");
        assert!((v[0] + TAU * libm::sin(TAU * moment_s)).abs() < 1e-11, "frame {frame}");
        for _ in Interpolation::ALL {
            studio.apply(RunCommand::NextInterpolation);
            let picture = compose(&studio, size);
            let x = picture.cells[0].metres(ghost(&studio, &picture)[0].at).x;
            let exact = libm::cos(TAU * shown_s(&studio));
            assert!((x - exact).abs() < 1e-3, "frame {frame}: {x} m, truly {exact} m");
            reach = (reach.0.min(x), reach.1.max(x));
        }
        assert_eq!(studio.display().interpolation, Interpolation::Monotone);
        assert!((shown_s(&studio) - moment_s).abs() < 1e-12, "frame {frame}");
    }
    assert!(reach.0 < -0.99 && reach.1 > 0.99, "{reach:?}");
}

#[test]
fn recording_the_curve_moves_no_bit_of_the_truth() {
    for scene in ["harbour", "pendulum", "helm", "chain", "orbit"] {
        let scene = Scene::built_in(scene).unwrap();
        let mut recorded = Race::new(&scene, []);
        let mut unseen = Race::new(&scene, []);
        let mut seen = Observations::new(&recorded, scene.seconds);
        for tick in 0..400 {
            if tick % 60 == 30 {
                for action in [Action::Kick(0.5), Action::Throttle(0.3), Action::Rudder(-0.7)] {
                    recorded.perform(&action, &mut seen);
                    unseen.perform(&action, &mut ());
                }
            }
            recorded.step(&mut seen);
            seen.past().truth_between(&recorded, 0, 0.3);
            unseen.step(&mut ());
        }
        for (a, b) in recorded.truth().bodies().iter().zip(unseen.truth().bodies()) {
            assert_eq!((a.stepper.q(), a.stepper.v()), (b.stepper.q(), b.stepper.v()));
        }
    }
}

#[test]
fn a_scene_shorter_than_a_tick_has_no_needlessly_fine_curve() {
    let text = "title = \"short\"\ntick_hz = 1\nseconds = 0.01\n\
        [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\nx0_m = 1\n";
    let mut studio = Studio::new(Scene::parse("short.toml", text).unwrap());
    (0..3).for_each(|_| studio.tick());
    let samples = samples(&studio);
    assert!((4096..6000).contains(&samples.len()), "{}", samples.len());
    assert_eq!(samples[samples.len() - 1].t, 3.0);
}
