//! The verdicts and the advice of a studio: which of them to compute, and which findings to accept.
//!
//! Work on an earlier request may finish late, so that findings name their scene and those on another one are dropped.
//! A capture limits the work of a verdict by a fixed amount, not by time: the same command must draw the same words on
//! every machine.

use std::sync::Arc;

use super::Studio;
use super::instrument::Instrument;
use crate::measure::{AdvisedBodies, AnalysisRequest, AnalysisWorker, Findings, MapRequest};
use crate::run::race::{Entrant, Interventions, Mode};
use crate::scene::SceneBody;
use crate::sim::bodies::{Parameter, Range, TakesEffect};

impl Studio {
    /// Returns the request to an [`AnalysisWorker`] for the verdicts and the advice that the studio needs now. Each
    /// [offered](crate::Deck::offered) method is judged at the present tick rate. In a race the rest of the menu is
    /// judged too. The advice is included while it is shown.
    ///
    /// A verdict is on the motion after the last change of the run, from the state that a lane had then. A method that
    /// a race lacks is judged from the true state. Advice is on the scene from its start, or from where a person last
    /// placed or kicked a body. It includes a person's settings, and the parameters that the script has set by the
    /// present tick.
    pub fn analysis_request(&self) -> AnalysisRequest {
        let flown = self.race().entrants().iter().map(|lane| self.entry(lane) + 1);
        let first = flown.max().unwrap_or_default().max(self.deck.offered());
        let count = match self.mode() {
            Mode::Solo => first,
            Mode::Race => self.entries().len(),
        };
        let checkpoints = self.run().checkpoints();
        let by_hand = Interventions::in_race(self.race(), checkpoints);
        // Alone on the stage, a lane goes on from its state under whichever method is picked.
        let lane = |entry| match self.mode() {
            Mode::Solo => self.race().entrants().first(),
            Mode::Race => self.deck.lane_of(entry),
        };
        let lane = |entry| lane(entry).map(|lane| lane.id).filter(|&id| by_hand.differ_in(id));
        AnalysisRequest {
            scene: Arc::clone(&self.deck.run.next().scene),
            advised: Interventions::for_advice(self.race(), checkpoints),
            entries: (0..count).map(|entry| (self.deck.spec(entry), lane(entry))).collect(),
            by_hand,
            first,
            tick_hz: self.deck.clock.tick_hz(),
            advice: (self.display().instrument == Instrument::Advice).then(|| advised_bodies(self)),
            map: (self.display().instrument == Instrument::StabilityMap)
                .then(|| map_request(self))
                .flatten(),
        }
    }
}

/// Returns the bodies that advice is about.
fn advised_bodies(studio: &Studio) -> AdvisedBodies {
    match studio.display().advises_on_one_body && studio.scene().bodies.len() > 1 {
        true => AdvisedBodies::One(studio.viewer.view.body),
        false => AdvisedBodies::All,
    }
}

/// Returns the request for a map of the scene's lanes, and of the selected method, at the present values.
fn map_request(studio: &Studio) -> Option<MapRequest> {
    let (body, parameter) = (studio.viewer.view.body, mapped_parameter(studio)?);
    let lanes = 0..studio.scene().lanes.len();
    let other = Some(studio.active()).filter(|active| !lanes.contains(active));
    let specs = lanes.chain(other).map(|entry| (entry, studio.entries()[entry])).collect();
    let opened = &studio.deck.scene_as_opened().bodies[body];
    let values = studio.race().values(body);
    Some(MapRequest::new((body, parameter), opened, values, studio.deck.clock.tick_hz(), specs))
}

/// Returns the indices of the displayed body's parameters that a stability map can show. These parameters act at once.
/// They cannot be negative, so that their scale can be logarithmic.
pub fn mappable_parameters(studio: &Studio) -> impl Iterator<Item = usize> {
    let SceneBody { kind, values, .. } = &studio.scene().bodies[studio.viewer.view.body];
    let parameters = kind.parameters.iter();
    let is_mappable = |(index, parameter): &(usize, &Parameter)| {
        // A constant of a law may have any sign.
        let is_constant = kind.law().is_some_and(|law| *index < law.text().constants.len());
        let is_signless = is_constant && values[*index] > 0.0
            || matches!(parameter.range, Range::Positive(_) | Range::NonNegative(_));
        parameter.acts == TakesEffect::AtOnce && is_signless
    };
    parameters.enumerate().filter(is_mappable).map(|(index, _)| index)
}

/// Returns the index of the parameter on the stability map. It is the one chosen for the displayed body, or else the
/// one that makes the body stiffer. Returns `None` if the body has neither.
pub fn mapped_parameter(studio: &Studio) -> Option<usize> {
    let body = studio.viewer.view.body;
    let chosen = studio.viewer.view.mapped_parameter.filter(|(of, _)| *of == body);
    let kind = &studio.scene().bodies[body].kind;
    let leading = kind.parameter(&kind.leading).map(|(index, _)| index);
    let mut indices = mappable_parameters(studio);
    let wanted = chosen.map(|(_, index)| index).or(leading);
    let first = indices.next()?;
    Some(
        wanted.filter(|&wanted| wanted == first || indices.any(|at| at == wanted)).unwrap_or(first),
    )
}

/// Accepts findings, unless they are about another scene.
pub fn accept_findings(studio: &mut Studio, findings: Findings) {
    if findings.request.is_of(&studio.deck.run.next().scene) {
        studio.viewer.findings = Some(findings);
        select_best(studio);
    }
}

/// Selects the best lane of a race once all lanes are judged, because the first lane may be the first to leave the
/// stage. Does nothing if anybody has selected a lane, or if the scene opens as a race under a method of its own.
pub(super) fn select_best(studio: &mut Studio) {
    let lanes = studio.race().entrants();
    let scene = studio.scene();
    let is_of_scene = scene.opens_as_race && scene.opening_method.is_some();
    if studio.deck.is_selected || is_of_scene || studio.mode() == Mode::Solo {
        return;
    }
    let judged = |lane: &Entrant| {
        let entry = studio.entry(lane);
        Some((studio.viewer.judged(entry)?.badness(), (lane.id, entry)))
    };
    let Some(judged) = lanes.iter().map(judged).collect::<Option<Vec<_>>>() else { return };
    let best = judged.into_iter().reduce(|best, other| if other.0 < best.0 { other } else { best });
    let Some((_, (number, entry))) = best else { return };
    studio.deck.selected = number;
    studio.deck.run.next_mut().entry = entry;
    studio.deck.is_selected = true;
}

/// Computes the findings for the present request, as a capture does before each frame. Verdicts that exceed a fixed
/// amount of work stay unjudged. `finish` runs the worker to its end. If it is interrupted it returns `None`, and this
/// function returns `false`.
pub fn analyse_bounded(
    studio: &mut Studio,
    finish: impl FnOnce(AnalysisWorker) -> Option<Findings>,
) -> bool {
    let Some(request) = unanswered_request(studio) else { return true };
    let found = finish(AnalysisWorker::new(request).bounded());
    found.map(|findings| accept_findings(studio, findings)).is_some()
}

/// Returns the present request for verdicts and advice, or `None` if the findings answer all of it.
pub fn unanswered_request(studio: &Studio) -> Option<AnalysisRequest> {
    let request = studio.analysis_request();
    let known = &studio.viewer.findings;
    (!known.as_ref().is_some_and(|known| known.answer(&request))).then_some(request)
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;
    use crate::measure::{Finding, NotJudged, Outcome, Severity, Verdict};
    use crate::scene::{Action, SCENES, Scene};
    use crate::{Command, RunCommand, StageCommand, Studio};

    /// Seconds before and after a change of the run.
    const BEFORE_S: f64 = 1.5;
    const AFTER_S: f64 = 4.0;

    /// Returns the request for the verdict on the selected lane alone.
    fn asked(studio: &Studio) -> AnalysisRequest {
        let request = studio.analysis_request();
        let entries = vec![request.entries[studio.active()]];
        AnalysisRequest { first: 1, entries, ..request }
    }

    fn answered(request: AnalysisRequest) -> Verdict {
        AnalysisWorker::new(request).bounded().finish().verdicts[0].clone().expect("it is judged")
    }

    fn selected(studio: &Studio) -> Verdict {
        answered(asked(studio))
    }

    /// Returns for each body how wide the selected lane swings from now on, relative to the truth; `None` for a body
    /// that does not swing.
    fn widths(studio: &mut Studio) -> Vec<Option<f64>> {
        let bodies = studio.scene().bodies.len();
        let mut ranges = vec![[[f64::INFINITY, f64::NEG_INFINITY]; 2]; bodies];
        let (mut turns, mut speeds) = (vec![0; bodies], vec![0.0; bodies]);
        let ticks = (AFTER_S * studio.race().tick_hz().hz()) as u32;
        for _ in 0..ticks {
            studio.tick();
            let (race, lane) = (studio.race(), studio.selected());
            for body in 0..bodies {
                let (own, truth) = (&lane.lane.bodies()[body], &race.truth().bodies()[body]);
                for (range, body) in ranges[body].iter_mut().zip([own, truth]) {
                    let q = body.stepper.q()[0];
                    *range = [range[0].min(q), range[1].max(q)];
                }
                let v = truth.stepper.v()[0];
                turns[body] += u32::from(v * speeds[body] < 0.0);
                speeds[body] = v;
            }
        }
        let width = |(ranges, turns): (&[[f64; 2]; 2], &u32)| {
            let [own, truth] = ranges.map(|[least, most]| most - least);
            (*turns >= 4 && truth > 0.0).then_some(own / truth)
        };
        ranges.iter().zip(&turns).map(width).collect()
    }

    #[test]
    fn no_swing_wider_than_exact_by_a_tenth_has_a_green_sign_after_a_change() {
        type Change = (&'static str, fn(&mut Studio));
        let changes: [Change; 4] = [
            ("switch", |studio| {
                studio.apply(StageCommand::Pick(1));
            }),
            ("kick", |studio| {
                studio.apply(RunCommand::Act(Action::Kick(1.0)));
            }),
            ("pull", |studio| {
                let pushes = (0..studio.scene().bodies.len()).map(|body| {
                    let n = studio.race().truth().bodies()[body].stepper.q().len();
                    Action::Push { body, by: vec![0.3; n].into() }
                });
                pushes.collect::<Vec<_>>().into_iter().for_each(|push| {
                    studio.apply(RunCommand::Act(push));
                });
            }),
            ("rate", |studio| {
                let twice = studio.race().tick_hz().scaled(2, 1);
                studio.apply(StageCommand::TickHz(twice));
            }),
        ];
        let check = |scene: &'static str| {
            let (mut wide, mut swings) = (0, 0);
            for (name, change) in changes {
                let mut studio = Studio::new(Scene::built_in(scene).unwrap());
                studio.apply(StageCommand::Pick(0));
                if studio.mode() == Mode::Race {
                    studio.apply(StageCommand::ToggleRace);
                }
                let ticks = (BEFORE_S * studio.race().tick_hz().hz()) as u32;
                (0..ticks).for_each(|_| studio.tick());
                change(&mut studio);
                let request = asked(&studio);
                let widths = widths(&mut studio);
                let widths: Vec<f64> = widths.into_iter().map(|it| it.unwrap_or(0.0)).collect();
                swings += widths.iter().filter(|&&width| width > 0.0).count();
                if !widths.iter().any(|&width| width > 1.1) {
                    continue;
                }
                let verdict = answered(request);
                for (width, found) in widths.into_iter().zip(&verdict.of_bodies) {
                    wide += usize::from(width > 1.1);
                    let is_green =
                        matches!(found.outcome().severity(), Severity::Fine | Severity::Fair);
                    assert!(width <= 1.1 || !is_green, "{scene}, {name}: {width} × under {found}");
                }
            }
            (wide, swings)
        };
        let found = thread::scope(|threads| {
            let checks = SCENES.iter().map(|scene| threads.spawn(move || check(scene.name)));
            let checks: Vec<_> = checks.collect();
            let found = checks.into_iter().map(|check| check.join().expect("it holds"));
            found.fold((0, 0), |all, one| (all.0 + one.0, all.1 + one.1))
        });
        assert!(found.0 >= 20 && found.1 >= 40, "of how many swings it was asked: {found:?}");
    }

    #[test]
    fn a_motion_that_a_clock_drives_is_judged_from_the_start_alone() {
        let mut studio = Studio::new(Scene::built_in("duffing").unwrap());
        assert_ne!(selected(&studio).finding, Finding::NotJudged(NotJudged::Driven));
        let changes: [(u64, Command); 2] =
            [(87, RunCommand::Act(Action::Kick(1.0)).into()), (126, StageCommand::Pick(3).into())];
        for (tick, change) in changes {
            while studio.race().tick() < tick {
                studio.tick();
            }
            studio.apply(change);
            let verdict = selected(&studio);
            assert_eq!(verdict.finding, Finding::NotJudged(NotJudged::Driven), "{tick}: {verdict}");
        }
    }

    #[test]
    fn a_damped_swing_that_is_too_wide_after_a_switch_is_said_so_at_any_tick() {
        let text = "title = 't'\ntick_hz = 30\nseconds = 20\n\
                    methods = ['rk4', 'explicit-euler', 'implicit-midpoint']\n[[spring]]\nmass_kg = 0.5554\n\
                    stiffness_n_per_m = 5.482\ndamping_n_s_per_m = 1.0469\nx0_m = 1.8961\nv0_m_per_s = -1.8731\n";
        for last in [36, 38, 40, 42] {
            let mut studio = Studio::new(Scene::parse("t", text).unwrap());
            for (tick, method) in [(7, 1), (last, 2)] {
                while studio.race().tick() < tick {
                    studio.tick();
                }
                studio.apply(StageCommand::Pick(method));
            }
            let found = selected(&studio);
            // The peaks are 1.19 to 1.22 times as far out as the true ones.
            let width = found.comparison().and_then(|found| found.width).expect("a swing");
            assert!((1.15..1.3).contains(&width), "{last}: {width}");
            assert!(found.outcome() > Outcome::LooksRight, "{last}: {found}");
        }
    }

    #[test]
    fn a_kick_of_the_script_begins_a_verdict_as_one_by_hand_does() {
        let text = "title = 't'\ntick_hz = 60\nseconds = 5\n[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n[[command]]\nat_s = 1.0\nkick = 0.5\n";
        let mut studio = Studio::new(Scene::parse("t", text).unwrap());
        assert_eq!(selected(&studio).starts_at_s, 0.0);
        (0..61).for_each(|_| studio.tick());
        assert_eq!(selected(&studio).starts_at_s, 1.0);
    }

    #[test]
    fn a_verdict_is_of_what_follows_the_last_change_of_the_run() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let said = |studio: &Studio| selected(studio).to_string();
        assert_eq!(said(&studio), "grows · swing ×2 in 2.1 s");
        (0..120).for_each(|_| studio.tick());
        studio.apply(StageCommand::Pick(1));
        // Explicit Euler has multiplied the swing by (1 + h² ω²)^(n / 2), 1.925 in 120 ticks.
        let verdict = selected(&studio);
        assert_eq!(verdict.starts_at_s, 2.0);
        let widths = verdict.comparison().and_then(|found| found.widths).expect("two swings");
        let wanted = libm::pow(1.0 + libm::pow(std::f64::consts::TAU / 60.0, 2.0), 60.0);
        assert!((widths.own / widths.truth / wanted - 1.0).abs() < 0.01, "{widths:?}, {wanted}");
        assert!(verdict.to_string().starts_with("stays ±1.9"), "{verdict}");
        assert_eq!(verdict.outcome().severity(), Severity::Doubtful);
        studio.apply(StageCommand::Pick(0));
        assert_eq!(said(&studio), "grows · swing ×2 in 2.1 s");
        assert_eq!(selected(&studio).details()[0], "1.9 × too wide at 2 s");
        studio.apply(StageCommand::ToggleRace);
        studio.analyse();
        let raced = studio.viewer.verdict(1).expect("it is judged").to_string();
        assert_eq!(raced, "looks right · 17 ms early after 20 s", "a lane from the start");
        studio.apply(StageCommand::ToggleRace);
        studio.apply(StageCommand::Restart);
        assert!(!said(&studio).starts_with("stays"));
    }

    #[test]
    fn an_earlier_verdict_does_not_stand_over_a_changed_run() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.analyse();
        (0..60).for_each(|_| studio.tick());
        let stands = |studio: &Studio| studio.viewer.verdict_from_here(&studio.deck, 1).is_some();
        assert!(stands(&studio) && studio.viewer.is_judged_now(&studio.deck, 1));
        studio.apply(StageCommand::Pick(1));
        assert!(!stands(&studio) && !studio.viewer.is_judged_now(&studio.deck, 1));
        studio.analyse();
        assert!(stands(&studio) && studio.viewer.is_judged_now(&studio.deck, 1));
        // The rate is dragged on from here, so that the verdict stays until the next one.
        studio.apply(StageCommand::TickHz(30.into()));
        assert!(stands(&studio) && !studio.viewer.is_judged_now(&studio.deck, 1));
    }

    #[test]
    fn solo_judges_the_offered_methods_and_a_race_also_the_others() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let wanted = |studio: &Studio| {
            let request = studio.analysis_request();
            (request.first, request.entries.len())
        };
        let (few, all) = (studio.scene().lanes.len(), studio.entries().len());
        assert_eq!(wanted(&studio), (few, few));
        studio.apply(StageCommand::Pick(few + 2));
        assert_eq!(wanted(&studio), (few + 3, few + 3));
        studio.apply(StageCommand::ToggleRace);
        assert_eq!(wanted(&studio), (few + 3, all));
    }

    #[test]
    fn a_race_selects_its_best_lane_unless_a_person_selected_one() {
        for (lanes, picks, is_best) in [(10, false, true), (10, true, false), (5, false, true)] {
            let scene = Scene { seconds: 2.0, ..Scene::built_in("spring").unwrap() };
            let all = Studio::new(scene.clone()).entries()[..lanes].to_vec();
            let mut studio = Studio::new(Scene { lanes: all, ..scene });
            studio.apply(StageCommand::ToggleRace);
            if picks {
                studio.apply(StageCommand::Pick(0));
            }
            let first = studio.active();
            studio.analyse();
            let outcome =
                |entry: usize| studio.viewer.verdict(entry).expect("it is judged").outcome();
            let best = (0..lanes).map(outcome).min().expect("there are lanes");
            assert_eq!(studio.active() != first, is_best, "{lanes} lanes, picked: {picks}");
            assert_eq!(outcome(studio.active()) == best, is_best, "{lanes} lanes, picked: {picks}");
            let selected = studio.active();
            studio.apply(StageCommand::Restart);
            assert_eq!(studio.active(), selected);
        }
    }

    #[test]
    fn race_from_solo_selects_the_best_lane_unless_the_scene_names_one() {
        let brief = |name| Scene { seconds: 2.0, ..Scene::built_in(name).unwrap() };
        let mut studio = Studio::new(brief("spring"));
        studio.analyse();
        assert_eq!(studio.active(), 0, "alone it is what is opened");
        studio.apply(StageCommand::ToggleRace);
        let verdict = studio.viewer.verdict(studio.active()).expect("it is judged");
        assert!(verdict.outcome() <= studio.viewer.verdict(1).unwrap().outcome());
        assert_ne!(studio.active(), 0, "explicit Euler leaves the stage");
        let mut studio = Studio::new(brief("lerp"));
        studio.apply(StageCommand::ToggleRace);
        studio.deck.is_selected = false;
        let named = studio.active();
        studio.analyse();
        assert_eq!(studio.active(), named);
    }

    #[test]
    fn a_map_keeps_its_regions_while_its_cross_is_moved() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(StageCommand::Instrument(Instrument::StabilityMap));
        let mut worker = AnalysisWorker::new(studio.analysis_request());
        while worker.work() {}
        let found = worker.findings().map.expect("a map");
        assert_eq!(found.regions.len(), found.request.specs.len());
        let [damping, stiffness] = ["damping", "stiffness"].map(|name| {
            let parameters = &studio.scene().bodies[0].kind.parameters;
            parameters.iter().position(|parameter| parameter.key.starts_with(name)).unwrap()
        });
        let mut moved = |parameter: usize, value: f64| {
            studio.apply(StageCommand::TickHz(24.into()));
            studio.apply(RunCommand::Act(Action::Set { body: 0, parameter, value }));
            worker.set_request(studio.analysis_request());
            worker.findings().map.map(|map| (map.regions, map.here.len()))
        };
        assert_eq!(moved(stiffness, 580.0), Some((found.regions, 0)));
        assert_eq!(moved(damping, 3.0), Some((Vec::new(), 0)), "another map");
    }
}
