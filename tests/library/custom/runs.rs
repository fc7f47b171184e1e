//! Reports, recordings, pictures and the studio on a custom body.

use glam::DVec2;
use regatta::look::Look;
use regatta::measure::{Adviser, CRITERIA, Criterion, Report};
use regatta::prelude::{Options, Scene, Session, State};
use regatta::run::RecordingError;
use regatta::run::race::{Lane, Mode};
use regatta::scene::{LaneSpec, Mark, Outline};
use regatta::sim::Solver;
use regatta::sim::integrators::method;
use regatta::studio::Studio;

use super::{Orbit, Spring};

const SPRING: Spring = Spring { mass: 1.0, stiffness: 40.0, damping: 0.4 };

fn scene() -> Scene {
    let ids = ["explicit-euler", "semi-implicit-euler", "rk4"];
    let methods = ids.map(|id| method(id).unwrap()).into();
    let options = Options { methods, tick_hz: 30.into(), ..Options::default() };
    Scene::of(&SPRING, State { q: 1.0, v: 0.0 }, options).unwrap()
}

#[test]
fn a_report_has_the_findings_of_the_adviser() {
    let scene = scene();
    let report = Report::of_scene(&scene);
    let adviser = Adviser::new(&scene, 30);
    assert_eq!((report.tick_hz, report.horizon_s, report.methods.len()), (30.into(), 20.0, 3));
    for (lane, row) in scene.lanes.iter().zip(&report.methods) {
        assert_eq!(row.method, lane.method.id);
        assert_eq!(row.verdict, adviser.verdict(*lane));
        for criterion in CRITERIA {
            let found = adviser.meets(LaneSpec::plain(lane.method), criterion);
            assert_eq!(row.criteria.get(criterion).as_ref(), found.met(), "{}", row.method);
        }
    }
    for criterion in CRITERIA {
        let best = report.recommended.get(criterion).as_ref().expect("one meets it");
        let costs = report.methods.iter().filter_map(|row| row.criteria.get(criterion).as_ref());
        let least = costs.map(|met| met.evaluations_per_s).fold(f64::INFINITY, f64::min);
        assert_eq!(best.with.evaluations_per_s, least);
        let line = format!("body at 30 Hz: {}: {best}\n", criterion.id());
        let is_answer = criterion == Criterion::LooksRight;
        assert_eq!(report.to_string().contains(&line), is_answer, "{report}");
    }
}

#[test]
fn a_work_budget_only_turns_findings_into_unknown() {
    let whole = Report::of_scene(&scene());
    let told = |max_work: u64| {
        let report = Report::within(max_work, &scene());
        assert_eq!(report, Report::within(max_work, &scene()), "the same work, the same report");
        let mut margins = 0;
        for (found, all) in report.methods.iter().zip(&whole.methods) {
            for criterion in CRITERIA {
                let [found, all] = [found, all].map(|row| row.criteria.get(criterion));
                let Some(found) = found else { continue };
                let all = all.as_ref().expect("it was met without a budget");
                assert_eq!(found.substeps, all.substeps, "{criterion:?}");
                margins += u32::from(found.are_margins_searched);
            }
        }
        let open = CRITERIA.map(|criterion| report.not_known.get(criterion).len());
        (open.iter().sum::<usize>(), margins)
    };
    assert_eq!(told(0), (9, 0));
    let some = told(u64::MAX);
    assert!(some.0 == 0 && some.1 > 4, "{some:?}");
    let more = (0..10).map(|n| told(40_000 << n)).find(|found| found.0 < 9);
    let few = more.expect("a budget that reaches something");
    assert!(few.0 > 0 && few.1 < some.1, "{few:?}");
}

#[cfg(feature = "desktop")]
#[test]
fn a_report_is_written_as_json_with_the_keys_of_the_command() {
    let value = serde_json::to_value(Report::of_scene(&scene())).unwrap();
    assert_eq!(value["tick_hz"], 30);
    assert_eq!(value["methods"][2]["method"], "rk4");
    let verdict = &value["methods"][2]["verdict"];
    assert_eq!((&verdict["word"], &verdict["body"]), (&"accurate".into(), &"body".into()));
    assert!(verdict["error"].is_f64() && verdict["failed_at_s"].is_null(), "{verdict}");
    let criteria = &value["methods"][2]["criteria"]["looks-right"];
    for key in ["substeps", "evaluations_per_s", "slowest_hz", "stiffness_factor", "limited_by"] {
        assert!(!criteria[key].is_null(), "{key}: {criteria}");
    }
    assert!(value["recommended"]["accurate"]["method"].is_string(), "{value}");
}

#[test]
fn recording_a_custom_body_is_refused_with_the_reason() {
    let mut session = Session::racing(scene().into());
    session.run(30);
    let error = session.recording_text(30).expect_err("no file can hold it");
    assert_eq!(error, RecordingError::InRust { what: "body".into() });
    assert!(error.to_string().contains("written in Rust"), "{error}");
}

#[test]
fn the_studio_continues_a_session_at_its_tick() {
    let mut session = Session::racing(scene().into());
    session.act(regatta::scene::Action::Kick(2.0));
    session.run(100);
    let mut studio = Studio::of_session(session.clone());
    assert_eq!((studio.mode(), studio.race().tick()), (Mode::Race, 100));
    assert_eq!(studio.race().state_hash(), session.race().state_hash());
    studio.tick();
    session.tick(&mut ());
    assert_eq!(studio.race().state_hash(), session.race().state_hash());
    assert_eq!(studio.deck.scene_list().open(), None, "it is in no list");
}

#[test]
fn a_custom_body_has_its_authors_picture_or_beads() {
    let outline = |draw| {
        let start = State { q: DVec2::new(3.0, 0.0), v: DVec2::new(0.0, 3.0) };
        let options = Options { draw, ..Options::default() };
        let scene = Scene::of(&Orbit { mu: 40.0 }, start, options).unwrap();
        let lane = Lane::new(&scene, Solver::Truth, 1);
        let body = &lane.bodies()[0];
        Look::of(body).outline(0.0, body.stepper.q())
    };
    let Outline { marks, at, .. } = outline(None);
    assert_eq!(at, DVec2::new(3.0, 0.0));
    assert!(matches!(marks[..], [Mark::Disc { centre, .. }] if centre == at), "{marks:?}");
    let Outline { marks, .. } = outline(Some(|orbit: &Orbit, q: &DVec2| {
        vec![
            Mark::Rod { from: DVec2::ZERO, to: *q },
            Mark::Anchor { centre: DVec2::ZERO, radius: orbit.mu },
        ]
    }));
    let wanted = [
        Mark::Rod { from: DVec2::ZERO, to: DVec2::new(3.0, 0.0) },
        Mark::Anchor { centre: DVec2::ZERO, radius: 40.0 },
    ];
    assert_eq!(marks, wanted);
}
