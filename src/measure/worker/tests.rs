//! Tests which results a worker keeps, and which it computes again.

use super::*;
use crate::run::Race;
use crate::run::race::Checkpoints;
use crate::scene::Action;
use crate::sim::integrators::{GENERAL_METHODS, method};

/// Returns the number of methods that advice covers.
fn for_games() -> usize {
    GENERAL_METHODS.iter().filter(|method| method.is_for_games()).count()
}

fn request(name: &str) -> AnalysisRequest {
    let scene = Arc::new(Scene::built_in(name).unwrap());
    let entries: Vec<_> = scene.method_list().into_iter().map(|spec| (spec, None)).collect();
    AnalysisRequest {
        scene,
        first: entries.len(),
        entries,
        tick_hz: 60.into(),
        by_hand: Interventions::default(),
        advised: Interventions::default(),
        advice: None,
        map: None,
    }
}

/// Works to the end. Returns the number of verdicts computed, and their texts.
fn answer(worker: &mut AnalysisWorker, request: &AnalysisRequest) -> (usize, Vec<String>) {
    worker.set_request(request.clone());
    let before = worker.judged;
    while worker.work() {}
    let findings = worker.findings();
    assert!(findings.complete && findings.request == *request);
    let told = |found: &Option<Verdict>| {
        let verdict = found.as_ref().unwrap();
        [vec![verdict.to_string()], verdict.details()].concat().join("; ")
    };
    (findings.verdicts.len() - before, findings.verdicts.iter().map(told).collect())
}

#[test]
fn each_verdict_is_computed_once_until_rate_run_or_scene_changes() {
    let first = request("harbour");
    let mut worker = AnalysisWorker::new(first.clone());
    let (count, fine) = answer(&mut worker, &first);
    assert_eq!(count, GENERAL_METHODS.len());
    assert_eq!(answer(&mut worker, &first), (0, fine.clone()));
    let few = AnalysisRequest { entries: first.entries[..3].to_vec(), ..first.clone() };
    assert_eq!(answer(&mut worker, &few), (0, fine[..3].to_vec()));
    assert_eq!(answer(&mut worker, &first), (GENERAL_METHODS.len() - 3, fine.clone()));
    let (count, coarse) =
        answer(&mut worker, &AnalysisRequest { tick_hz: 20.into(), ..first.clone() });
    assert_eq!(count, GENERAL_METHODS.len());
    assert!(coarse != fine);
    let mut race = Race::of_scene(&first.scene);
    let mut starts = Checkpoints::default();
    race.act(Action::Throttle(0.5), &mut starts);
    let by_hand = Interventions::in_race(&race, &starts);
    let slower = AnalysisRequest { tick_hz: 20.into(), by_hand, ..first.clone() };
    assert_eq!(answer(&mut worker, &slower).0, GENERAL_METHODS.len());
    assert_eq!(answer(&mut worker, &first), (GENERAL_METHODS.len(), fine));
    assert_eq!(answer(&mut worker, &request("spring")).0, GENERAL_METHODS.len());
}

#[test]
fn a_verdict_uses_the_substeps_of_its_lane() {
    let plain = request("stiff");
    let mut worker = AnalysisWorker::new(plain.clone());
    let (_, once) = answer(&mut worker, &plain);
    let mut finer = plain.clone();
    let lane = finer.entries.iter_mut().find(|(spec, _)| spec.method.id == "rk4").unwrap();
    lane.0.substeps = 8;
    let (count, finer) = answer(&mut worker, &finer);
    let changed: Vec<_> = (0..once.len()).filter(|&i| once[i] != finer[i]).collect();
    let rk4 = plain.entries.iter().position(|(spec, _)| spec.method.id == "rk4").unwrap();
    assert_eq!(changed, [rk4]);
    assert_eq!(count, GENERAL_METHODS.len() - rk4, "those before it stand");
    assert!(finer[rk4].starts_with("accurate"), "{}", finer[rk4]);
}

#[test]
fn an_old_verdict_stays_until_its_replacement_is_computed() {
    let first = request("spring");
    let mut worker = AnalysisWorker::new(first.clone());
    answer(&mut worker, &first);
    worker.set_request(AnalysisRequest { tick_hz: 20.into(), ..first });
    assert!(worker.findings().verdicts.iter().all(Option::is_some));
    assert!(!worker.findings().complete);
}

#[test]
fn advice_is_computed_in_small_steps_and_only_on_request() {
    let unasked = request("spring");
    let mut worker = AnalysisWorker::new(unasked.clone());
    answer(&mut worker, &unasked);
    assert!(worker.findings().advice.is_none());
    worker.set_request(AnalysisRequest { advice: Some(AdvisedBodies::All), ..unasked });
    let bits = 1 + (0..).take_while(|_| worker.work()).count();
    assert!((3..2000).contains(&bits), "{bits} times");
    let advice = worker.findings().advice.unwrap();
    assert_eq!([advice.advised.len(), advice.wanted], [for_games(); 2]);
    assert!(worker.findings().complete);
}

#[test]
fn one_body_can_be_advised_on_alone() {
    let harbour = request("harbour");
    let advised = |bodies: AdvisedBodies| {
        let advice = Some(bodies);
        let mut worker = AnalysisWorker::new(AnalysisRequest { advice, ..harbour.clone() });
        while worker.findings().advice.is_none_or(|advice| advice.advised.len() < 2) {
            worker.work();
        }
        let advice = worker.findings().advice.unwrap();
        assert_eq!(advice.bodies, bodies);
        assert_eq!(advice.advised[1].spec.method.id, "semi-implicit-euler");
        let met = advice.advised[1].met[0].met().cloned().expect("it is bounded");
        (worker, met)
    };
    let (mut worker, one) = advised(AdvisedBodies::One(0));
    assert_eq!(one.evaluations_per_s, f64::from(60 * one.substeps), "one evaluation a step");
    let (_, all) = advised(AdvisedBodies::All);
    assert_eq!(all.evaluations_per_s, f64::from(2 * 60 * all.substeps), "of two bodies");
    let bodies = Some(AdvisedBodies::One(0));
    for (advice, is_kept) in [(None, true), (Some(AdvisedBodies::All), false)] {
        worker.set_request(AnalysisRequest { advice, ..harbour.clone() });
        worker.set_request(AnalysisRequest { advice: bodies, ..harbour.clone() });
        assert_eq!(worker.findings().advice.is_some(), is_kept, "{advice:?}");
    }
}

#[test]
fn a_bounded_worker_counts_its_work_and_leaves_the_rest_unjudged() {
    let fast = AnalysisRequest { tick_hz: 1000.into(), ..request("orbit") };
    let judged = |max_work: u64| {
        let worker = AnalysisWorker { max_work, ..AnalysisWorker::new(fast.clone()) };
        let findings = worker.finish();
        assert!(findings.complete);
        let texts = findings.verdicts.iter().map(|found| found.as_ref().unwrap().to_string());
        texts.collect::<Vec<_>>()
    };
    let (none, some) = (judged(0), judged(14_000_000));
    let unjudged = |texts: &[String]| {
        texts.iter().filter(|text| *text == "not judged · too much work").count()
    };
    assert_eq!(unjudged(&none), none.len());
    assert!((1..none.len()).contains(&unjudged(&some)), "{some:?}");
    assert_eq!(some, judged(14_000_000));
}

#[test]
fn a_lane_without_a_truth_makes_no_tick_when_no_work_is_left() {
    let cloth = request("cloth");
    let ticked = |max_work: u64| {
        let worker = AnalysisWorker { max_work, ..AnalysisWorker::new(cloth.clone()) };
        let verdicts = worker.finish().verdicts;
        verdicts.iter().flatten().map(|verdict| verdict.evaluations).sum::<u64>()
    };
    assert_eq!(ticked(0), 0);
    assert!(ticked(1_000_000) > 0);
}

/// Returns the distinct meters of the worker.
fn meters(worker: &AnalysisWorker) -> Vec<Arc<Meter>> {
    let part = worker.part.as_ref().map(Sliced::meter);
    let judge = worker.judge.as_ref().map(|judge| judge.meter());
    let adviser = worker.advising.as_ref().map(|advising| advising.adviser.judge().meter());
    let map = worker.mapping.as_ref().map(MapWork::meter);
    let mut meters: Vec<_> = [part, judge, adviser, map].into_iter().flatten().cloned().collect();
    meters.sort_by_key(Arc::as_ptr);
    meters.dedup_by_key(|meter| Arc::as_ptr(meter));
    meters
}

#[test]
fn no_step_does_twice_its_work_and_a_new_request_drops_the_part_in_progress() {
    let text = "title = 't'\ntick_hz = 60\nseconds = 60\n[[pendulum]]\nlength_m = 1\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 100\n";
    let spec = LaneSpec { substeps: 16, ..LaneSpec::plain(method("rk4").unwrap()) };
    let scene = Arc::new(Scene::parse("t", text).unwrap());
    let whole = |tick_hz: u32| Judge::new(&scene).verdict(spec, tick_hz);
    let fine =
        AnalysisRequest { scene: scene.clone(), entries: vec![(spec, None)], ..request("spring") };
    let advised = AnalysisRequest { advice: Some(AdvisedBodies::All), ..fine.clone() };
    let mut worker = AnalysisWorker::new(advised);
    let mut steps = Vec::new();
    let passed = |meters: &[Arc<Meter>]| meters.iter().map(|meter| meter.passed()).sum::<u64>();
    while worker.findings().advice.is_none_or(|advice| advice.advised.is_empty()) {
        let before = passed(&meters(&worker));
        worker.work();
        assert!(!worker.findings().complete);
        steps.push(passed(&meters(&worker)) - before);
    }
    assert!(steps.len() > 10 && steps.iter().all(|&work| work < 2 * WORK_OF_STEP), "{steps:?}");
    assert_eq!(worker.findings().verdicts, [Some(whole(60))]);
    worker.set_request(AnalysisRequest { tick_hz: 30.into(), ..fine.clone() });
    worker.work();
    assert!(worker.is_within_a_part());
    let coarse = AnalysisRequest { tick_hz: 20.into(), ..fine };
    worker.set_request(coarse.clone());
    assert!(!worker.is_within_a_part());
    answer(&mut worker, &coarse);
    assert_eq!(worker.findings().verdicts, [Some(whole(20))]);
}

/// Returns all results for a method on a scene, which are the truths, a verdict and, unless this takes long, advice
/// with its margins.
async fn all_of(scene: Scene, spec: LaneSpec, tick_hz: u32, meter: Arc<Meter>) -> String {
    let tick_hz = tick_hz.into();
    let adviser = Adviser::find(scene, 1.0, tick_hz, meter).await;
    let verdict = adviser.judge().verdict_within(300_000, Pace { spec, tick_hz }).await;
    // The results are compared as text, because NaN may occur.
    if adviser.scene().bodies.iter().any(|body| body.kind.net().is_some()) {
        return format!("{verdict:?}");
    }
    let mut advice = adviser.advice_on(spec).await;
    for criterion in 0..advice.met.len() {
        adviser.search_margins(&mut advice, criterion).await;
    }
    format!("{verdict:?}, {advice:?}")
}

const SLICE: u64 = WORK_OF_STEP / 20;

#[test]
fn slicing_changes_neither_result_nor_work() {
    for (name, id, tick_hz) in [
        ("spring", "velocity-verlet", 60),
        ("spring", "implicit-midpoint", 60),
        ("chain", "implicit-euler", 60),
        ("orbit", "rk4", 20),
        ("pendulum", "rk4", 5),
        ("cloth", "semi-implicit-euler", 60),
    ] {
        let spec = LaneSpec::plain(method(id).unwrap());
        let found = |slice: u64| {
            let meter = Arc::<Meter>::default();
            let scene = Scene { seconds: 2.0, ..Scene::built_in(name).unwrap() };
            let work = all_of(scene, spec, tick_hz, meter.clone());
            let mut sliced = Sliced::new(meter.clone(), work);
            let mut slices = Vec::new();
            loop {
                let before = meter.passed();
                let found = sliced.resume(slice);
                slices.push(meter.passed() - before);
                if let Some(found) = found {
                    return ((found, meter.counted()), slices);
                }
            }
        };
        let ((whole, once), (sliced, slices)) = (found(u64::MAX), found(SLICE));
        assert_eq!(sliced, whole, "{name}, {id}");
        assert!(once.len() == 1 && slices.len() > 2, "{name}, {id}: {} slices", slices.len());
        assert!(slices.iter().all(|&work| work < 2 * SLICE), "{name}, {id}: {slices:?}");
    }
}
