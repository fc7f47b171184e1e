//! The truth on the stage: the ghost's place, its trail, and the range of its swing.

use glam::DVec2;

use super::framed::BodyView;
use super::moment::{DrawContext, has_several_coordinates};
use super::trails::Place;
use crate::look::palette::{Rgba, fade};
use crate::look::{Framing, Look};
use crate::run::past::{TruthCurve, TruthSample};
use crate::scene::Outline;
use crate::studio::shown_truth;

/// The true motion of one body at the moment drawn.
pub(super) struct Ghost {
    /// The part of the body's world that the cell shows.
    pub(super) view: BodyView,
    /// Coordinates at that moment.
    pub(super) q: Vec<f64>,
    /// Outline at that moment.
    pub(super) outline: Outline,
    /// Largest swing (m) to either side since the last change, including the motion ahead; `None` if unknown.
    pub(super) swing_m: Option<f64>,
}

impl Ghost {
    /// The ghost of the body with this index in the scene, on the exact flow at the moment drawn for the lanes.
    pub(super) fn new(moment: &DrawContext<'_>, index: usize) -> Self {
        let race = moment.studio.race();
        let body = &race.truth().bodies()[index];
        let remembered = moment.studio.past();
        let curve = &remembered.truth_curves()[index];
        let look = Look::of(body);
        let framing = look.framing();
        // The truth between ticks takes a copy of the body. If no ghost is drawn, only a view that follows the body
        // needs it.
        let is_needed = moment.studio.display().ghost || matches!(framing, Framing::Follow { .. });
        let (q, v) = match is_needed {
            true => shown_truth(moment.studio, index),
            false => (body.stepper.q().to_vec(), body.stepper.v().to_vec()),
        };
        let course = look.course(&q, &v);
        let outline = Outline { course, ..look.outline(moment.t, &q) };
        let centre_m = match framing {
            Framing::Follow { .. } | Framing::Recorder { .. } => DVec2::ZERO,
            Framing::Fixed { centre_m, .. } => centre_m,
        };
        let since_s = remembered.swing_since_s(race.t());
        let reach_m = curve.reach_m(centre_m, since_s);
        let (followed, turns) = (outline.at, has_several_coordinates(body));
        let view = BodyView { framing, followed, reach_m, turns, zoomed_as: index, grown: 1.0 };
        let swings_since_s = remembered.swings_since_s();
        let has_just_begun = since_s < remembered.changed_s();
        let has_swung_m = curve.reach_m(DVec2::ZERO, swings_since_s).x;
        let swing_m = match look.swing_m(&q, &v) {
            Some(now_m) => Some(now_m.max(has_swung_m)),
            None => (!has_just_begun).then_some(has_swung_m),
        };
        Self { view, q, outline, swing_m }
    }

    /// Its trail of the last `trail_s` seconds, newest first, within this tolerance in metres.
    pub(super) fn past(
        &self,
        moment: &DrawContext<'_>,
        index: usize,
        trail_s: f64,
        tolerance_m: f64,
    ) -> Vec<Place> {
        let curve = &moment.studio.past().truth_curves()[index];
        let colour = fade(moment.palette.exact, 0.55);
        thinned(past(curve, self.outline.at, moment.t, trail_s, colour), tolerance_m)
    }
}

/// The last `trail_s` seconds before the moment `t`, at which the ghost is `at`.
fn past(
    curve: &TruthCurve,
    at: DVec2,
    t: f64,
    trail_s: f64,
    colour: Rgba,
) -> impl Iterator<Item = Place> + Clone {
    let mut newer: Option<&TruthSample> = None;
    let unbroken = curve
        .samples()
        .rev()
        .take_while(move |sample| newer.replace(sample).is_none_or(|newer| !newer.jumped));
    let samples = unbroken.skip_while(move |sample| sample.t >= t);
    let moments = samples.map(move |sample| Place { age: t - sample.t, at: sample.at, colour });
    let now = Place { age: 0.0, at, colour };
    std::iter::once(now).chain(moments.take_while(move |moment| moment.age < trail_s))
}

/// Drops points where the trail is straight within the tolerance.
fn thinned(trail: impl Iterator<Item = Place> + Clone, tolerance_m: f64) -> Vec<Place> {
    let mut moments = trail.clone();
    let mut kept: Vec<Place> = moments.next().into_iter().collect();
    let (mut left_out, mut bend_m) = (0.0, 0.0);
    let mut before = kept.first().copied();
    for (this, next) in moments.zip(trail.skip(2).map(Some).chain([None])) {
        left_out += 1.0;
        if let (Some(before), Some(next)) = (before, next) {
            bend_m += (before.at - 2.0 * this.at + next.at).length();
        }
        // Height of a parabola above its chord, if it passes through evenly spaced moments.
        if next.is_none() || left_out * bend_m / 8.0 > tolerance_m {
            kept.push(this);
            (left_out, bend_m) = (0.0, 0.0);
        }
        before = Some(this);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose;
    use crate::scene::{Action, Scene};
    use crate::studio::{RunCommand, StageCommand, Studio};

    /// Distance (m) of the spring's marks from rest, and the number in its caption.
    fn marked_and_said(studio: &Studio) -> (f64, f64) {
        let marked = Ghost::new(&DrawContext::of(studio), 0).swing_m.expect("a spring has marks");
        let mut labels = compose(studio, [780.0, 460.0]).labels.into_iter();
        let said = labels.find_map(|label| {
            let number = label.text.strip_prefix("should keep to ±")?.strip_suffix(" m")?;
            Some(number.parse().expect("a number"))
        });
        (marked, said.expect("a caption"))
    }

    #[test]
    fn marks_and_caption_agree_after_a_kick_a_throw_an_edit_and_all_along() {
        let spring = Scene::built_in("harbour").unwrap().bodies[0].clone();
        let (stiffness, _) = spring.kind.parameter("stiffness_n_per_m").unwrap();
        let place = |q: f64, v: f64| Action::Place { body: 0, q: [q].into(), v: [v].into() };
        for action in [
            Action::Kick(1.0),
            Action::Kick(-2.0),
            place(0.3, -2.0),
            Action::Set { body: 0, parameter: stiffness, value: 7.0 * spring.values[stiffness] },
            Action::Place { body: 1, q: [30.0].into(), v: [1.0].into() },
        ] {
            let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
            (0..47).for_each(|_| studio.tick());
            studio.apply(RunCommand::Act(action.clone()));
            for tick in 0..240 {
                let (marked, said) = marked_and_said(&studio);
                assert!((marked - said).abs() < 6e-3 * said, "{action:?}, {tick}: {marked} {said}");
                studio.tick();
            }
            studio.apply(StageCommand::Restart);
        }
    }

    #[test]
    fn the_swing_marks_of_a_damped_spring_contain_its_motion_after_a_kick() {
        let mut studio = Studio::new(Scene::built_in("damped").unwrap());
        (0..100).for_each(|_| studio.tick());
        studio.apply(RunCommand::Act(Action::Kick(3.0)));
        let mut widest = 0.0_f64;
        for _ in 0..600 {
            let marked = Ghost::new(&DrawContext::of(&studio), 0).swing_m.unwrap();
            widest = widest.max(studio.race().truth().bodies()[0].stepper.q()[0].abs());
            assert!(marked >= widest * (1.0 - 1e-9), "{marked} {widest}");
            studio.tick();
        }
        let marked = Ghost::new(&DrawContext::of(&studio), 0).swing_m.unwrap();
        assert!(marked < 1.05 * widest, "in the end they are where it turned: {marked} {widest}");
    }

    #[test]
    fn thinning_keeps_a_trail_within_the_tolerance_and_its_ends_exact() {
        let zigzag = |x: f64| (x % 2.0 - 1.0).abs();
        for motion in [|x: f64| libm::sin(3.0 * x), zigzag] {
            let moment = |i: i32| {
                let age = f64::from(i) / 200.0;
                Place { age, at: DVec2::new(motion(age), 0.0), colour: [255; 4] }
            };
            let kept = thinned((0..=800).map(moment), 1e-3);
            assert!((5..250).contains(&kept.len()), "{}", kept.len());
            assert_eq!((kept[0].age, kept[kept.len() - 1].age), (0.0, 4.0));
            for ends in kept.windows(2) {
                for i in 0..=20 {
                    let part = f64::from(i) / 20.0;
                    let age = ends[0].age + part * (ends[1].age - ends[0].age);
                    let drawn = ends[0].at.lerp(ends[1].at, part).x;
                    assert!((drawn - motion(age)).abs() < 1.5e-3, "at {age}: {drawn}");
                }
            }
        }
        assert_eq!(thinned(std::iter::empty(), 1.0).len(), 0);
    }

    #[test]
    fn a_differing_recording_runs_along_as_a_ghost_at_every_tick() {
        use crate::run::diff::{Chosen, NotComparable, Tolerance, diff};
        use crate::run::trace::Made;
        use crate::studio::{Step, show_comparison};
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        (0..90).for_each(|_| studio.tick());
        let text = studio.deck.recording().unwrap() + "\n[[command]]\nat_s = 1.0\nkick = 1.0\n";
        let recording = Scene::parse("clip.toml", &text).unwrap();
        let run = studio.run().recording();
        let [mut a, mut b] = [recording.clone(), run].map(|scene| Made::of_scene(scene, 90));
        let found =
            diff::<_, _, NotComparable>(&mut a, &mut b, Tolerance::default(), &Chosen::default());
        show_comparison(&mut studio, "clip.toml", &found.unwrap(), recording.clone());
        assert_eq!((studio.race().tick(), studio.running()), (61, false));
        let lines = studio.deck.compared().unwrap().lines();
        assert_eq!(lines[0], "differs from 1.017 s on: position of spring, exact solution");
        assert!(lines[1].contains(" m apart, ") && lines[1].ends_with(" %"), "{lines:?}");
        assert!(lines.iter().all(|line| line.chars().count() < 60), "{lines:?}");
        assert_eq!(
            studio.viewer.notice, None,
            "the stage shows it, and the footer does not repeat it"
        );
        // Runs the recording in a separate session.
        let alone = |tick: u64| {
            let mut race = crate::run::Session::racing(recording.clone().into());
            race.run(tick);
            race.race().entrants()[0].lane.bodies()[0].stepper.q()[0]
        };
        let holds = |studio: &mut Studio, tick: u64| {
            assert_eq!(studio.race().tick(), tick);
            let spec = studio.selected().spec;
            let compared = studio.deck.compared().expect("it stays");
            let (_, q) = compared.body(studio.scene(), &spec, 0).expect("a spring too");
            assert_eq!(q[0].to_bits(), alone(tick).to_bits(), "at tick {tick}");
            let said: Vec<_> = compose(studio, [780.0, 440.0])
                .labels
                .into_iter()
                .map(|label| label.text)
                .collect();
            for words in ["clip.toml", &lines[0], &lines[1]] {
                assert!(said.iter().any(|said| said == words), "{words}: {said:?}");
            }
        };
        holds(&mut studio, 61);
        (0..40).for_each(|_| studio.tick());
        holds(&mut studio, 101);
        studio.apply(RunCommand::Seek(20));
        holds(&mut studio, 20);
        studio.apply(StageCommand::Second(Step::Next));
        holds(&mut studio, 80);
        // The recording has no body to show in a scene with other bodies.
        let spec = studio.selected().spec;
        let other = Scene::built_in("ship").unwrap();
        assert!(studio.deck.compared().unwrap().body(&other, &spec, 0).is_none());
        studio.apply(StageCommand::Restart);
        assert!(studio.deck.compared().is_none());
    }
}
