use super::*;
use crate::measure::Severity;
use crate::sim::TickRate;
use crate::sim::integrators::method;
use crate::{policy, trace_file};

fn lab() -> LoopLab {
    lab_of(&Scene::built_in("spring").unwrap())
}

fn lab_of(scene: &Scene) -> LoopLab {
    let mut lab = LoopLab::new(scene, 0, method("rk4").unwrap());
    run(&mut lab);
    lab
}

/// Runs every requested loop.
fn run(lab: &mut LoopLab) {
    let mut worker = LoopWorker::default();
    worker.set_request(Some(lab.request().clone()));
    while let Some(found) = worker.work(&|| false) {
        lab.accept(found);
    }
}

#[test]
fn the_loop_lab_opens_where_raw_ticks_judder_and_whole_refreshes_do_not() {
    let lab = lab();
    assert_eq!(lab.traces()[lab.trace()].name(), "edge");
    let error = |id: &str| {
        let lane = lab.lanes().iter().find(|lane| lane.card().id == id).unwrap();
        lane.report().unwrap().animation_error_rms_ms.unwrap()
    };
    assert!((11.0..12.6).contains(&error("fixed")), "{}", error("fixed"));
    assert!(error("whole-refresh") < 1e-6, "{}", error("whole-refresh"));
    assert_eq!(on_stage(&lab), ["fixed", "whole-refresh"]);
    assert_eq!(lab.selected_card(), &**policy("fixed").unwrap());
}

#[test]
fn the_advised_loop_leads_the_list_and_variable_steps_are_never_green() {
    let mut lab = lab();
    assert_eq!(lab.lanes()[lab.listed()[0]].card().id, "whole-refresh");
    let trace = lab.traces().iter().position(|trace| trace.name() == "steady-144").unwrap();
    lab.choose_trace(trace);
    assert_eq!((lab.advised(), lab.listed()[0]), (None, 0), "not run yet");
    run(&mut lab);
    let listed = lab.listed();
    let advised = lab.advised().unwrap();
    assert_eq!(
        (listed[0], lab.lanes()[listed[0]].card().id.as_str()),
        (advised.index, "fixed-linear")
    );
    assert!(advised.why.unwrap().contains("overshoots at each kick"));
    let mut all = listed.clone();
    all.sort_unstable();
    assert!(all.iter().copied().eq(0..lab.lanes().len()) && listed[1..].is_sorted());
    assert!(lab.verdict(listed[0]).to_string().starts_with("recommended, smooth"));
    for (lane, index) in lab.lanes().iter().zip(0..) {
        let verdict = lab.verdict(index);
        let says = verdict.to_string().contains("physics varies with the rate");
        assert_eq!(says, !lane.card().has_fixed_tick, "{}: {verdict}", lane.card().id);
        let is_green = verdict.severity == Severity::Fine;
        assert!(!(says && is_green), "{}: {verdict}", lane.card().id);
    }
}

#[test]
fn a_recommended_loop_has_a_fixed_tick_and_is_green() {
    let mut reasons = Vec::new();
    for (name, tick_hz) in
        [("spring", 60), ("spring", 30), ("stiff", 30), ("ship", 2), ("orbit", 7)]
    {
        let scene = Scene { tick_hz: TickRate::whole(tick_hz), ..Scene::built_in(name).unwrap() };
        let mut lab = lab_of(&scene);
        lab.add_traces(trace_file::read("own.txt", &"7.1\n".repeat(600)).unwrap());
        for trace in 0..lab.traces().len() {
            lab.choose_trace(trace);
            run(&mut lab);
            let words = lab.verdict(lab.listed()[0]).to_string();
            let place =
                format!("{name} at {tick_hz} Hz on {}: {words}", lab.traces()[trace].name());
            assert!(on_stage(&lab).contains(&"fixed"), "{place}");
            let Some(advised) = lab.advised() else {
                let recommended = (0..POLICIES.len())
                    .filter(|&i| lab.verdict(i).to_string().contains("recommended"));
                assert_eq!(recommended.count(), 0, "{place}");
                let (none, told) = lab.none_advised().expect("either one or none");
                assert!(
                    none.nearest().is_none_or(|near| lab.on_stage().contains(&near)),
                    "{place}"
                );
                reasons.push((place, told.join("; ")));
                continue;
            };
            assert_eq!((lab.listed()[0], lab.none_advised()), (advised.index, None), "{place}");
            assert!(words.starts_with("recommended, smooth"), "{place}");
            assert_eq!(lab.verdict(advised.index).severity, Severity::Fine, "{place}");
            assert!(lab.lanes()[advised.index].card().has_fixed_tick, "{place}");
            // The first four policies step by the frame.
            assert!(advised.index > 3, "{place}");
            assert!(lab.on_stage().contains(&advised.index), "{place}");
        }
    }
    let told = |of: &str| {
        let found = reasons.iter().find(|(place, _)| place.starts_with(of));
        found.map(|(_, told)| &**told)
    };
    let lost = Some("in every loop with a fixed tick the motion is lost");
    assert_eq!(told("stiff at 30 Hz on own.txt"), lost);
    assert_eq!(
        told("ship at 2 Hz on edge"),
        Some(
            "no loop with a fixed tick is smooth within 20 ms; Whole refreshes is smooth and 500 ms late; in time \
             Fixed, extrapolated is the smoothest: uneven by 0.41 ms"
        )
    );
    assert!(reasons.len() < 40 && told("spring at 60 Hz on edge").is_none(), "{reasons:?}");
}

#[test]
fn a_lost_motion_is_never_green() {
    let scene = Scene { tick_hz: 30.into(), ..Scene::built_in("stiff").unwrap() };
    let lab = lab_of(&scene);
    let linear = index_of("fixed-linear");
    let verdict = lab.verdict(linear);
    assert_eq!(verdict.to_string(), "the motion is lost, more ticks or another method keep it");
    assert_eq!(verdict.severity, Severity::Bad);
}

fn on_stage(lab: &LoopLab) -> Vec<&str> {
    lab.on_stage().iter().map(|&index| &*lab.lanes()[index].card().id).collect()
}

#[test]
fn the_opening_moves_to_a_fast_display_unless_a_person_acts() {
    let past_the_first = 8 * (OPENING_NS + 1_000_000);
    let mut lab = lab();
    lab.advance(past_the_first);
    assert_eq!(lab.trace(), 0, "not asked for");
    lab.seek(0);
    lab.play_opening();
    lab.advance(past_the_first);
    assert_eq!(lab.traces()[lab.trace()].name(), "steady-144");
    assert_eq!(on_stage(&lab), ["fixed", "fixed-linear"]);
    assert_eq!(lab.now_ns(), 0);
    run(&mut lab);
    lab.advance(past_the_first);
    assert_eq!(lab.traces()[lab.trace()].name(), "steady-144", "it stays there");
    lab.select(0);
    lab.choose_trace(0);
    assert_eq!(on_stage(&lab).len(), 3, "what a person chose stays");
}

#[test]
fn a_script_acts_on_the_body_at_its_times_under_any_tick_rate() {
    let scene = Scene::built_in("helm").unwrap();
    assert!(!scene.script.is_empty());
    let mut lab = lab_of(&scene);
    let ends = |lab: &LoopLab| lab.lanes()[0].frames().last().unwrap().exact[0];
    let at_own_rate = ends(&lab);
    let bare = Scene { script: Vec::new(), ..scene.clone() };
    assert_ne!(at_own_rate, ends(&lab_of(&bare)));
    lab.set_tick_hz(scene.tick_hz.scaled(3, 1));
    run(&mut lab);
    let relative = (ends(&lab) / at_own_rate - 1.0).abs();
    assert!(relative < 1e-12, "{relative}");
}

#[test]
fn a_display_holds_a_frame_until_the_next() {
    let mut lab = lab();
    lab.step(3);
    let lane = &lab.lanes()[lab.selected()];
    let at = lane.frame_at(lab.now_ns()).unwrap();
    assert_eq!(at, 3);
    assert_eq!(lane.frame_at(lane.frames()[4].displayed_ns - 1), Some(3));
    assert_eq!(lane.frame_at(-1), None);
    lab.step(-100);
    assert_eq!(lab.now_ns(), 0);
}

#[test]
fn a_held_frame_falls_further_and_further_behind() {
    let mut lab = lab();
    let index = lab.traces().iter().position(|trace| trace.name() == "alt-tab-5s").unwrap();
    lab.choose_trace(index);
    run(&mut lab);
    let frames = lab.lanes()[lab.selected()].frames();
    let longest = frames.windows(2).max_by_key(|pair| pair[1].displayed_ns - pair[0].displayed_ns);
    let held = longest.unwrap()[0].clone();
    lab.seek(held.displayed_ns + 5_000_000);
    assert_eq!(lab.late_ms(&held), held.latency_ms());
    lab.seek(held.displayed_ns + 1_500_000_000);
    assert!((lab.late_ms(&held) - held.latency_ms() - 1500.0).abs() < 1e-9);
}

#[test]
fn playback_is_slow_and_wraps_at_its_end() {
    let mut lab = lab();
    lab.advance(80_000_000);
    assert_eq!(lab.now_ns(), 10_000_000);
    lab.seek(i64::MAX);
    assert_eq!(lab.now_ns(), lab.end_ns());
    lab.advance(80_000_000);
    assert_eq!(lab.now_ns(), 0);
}

#[test]
fn the_stage_holds_one_to_four_lanes_in_the_order_of_the_table() {
    let mut lab = lab();
    for index in [0, 1, 2, 99] {
        lab.select(index);
    }
    assert_eq!(lab.on_stage().len(), MAX_ON_STAGE);
    assert!(lab.on_stage().is_sorted() && lab.on_stage().contains(&lab.selected()));
    for index in 0..POLICIES.len() {
        if lab.on_stage().contains(&index) {
            lab.toggle(index);
        }
    }
    assert_eq!(lab.on_stage().len(), 1);
}

#[test]
fn a_stopped_loop_runs_again() {
    let lab = lab();
    let mut worker = LoopWorker::default();
    worker.set_request(Some(lab.request().clone()));
    assert!(worker.work(&|| true).is_none() && !worker.is_done());
    let index = worker.work(&|| false).map(|found| found.index);
    assert_eq!(index, Some(lab.on_stage()[0]));
}

#[test]
fn an_engine_runs_beside_the_loops_and_is_not_advised() {
    let mut lab = lab();
    let advised = lab.advised();
    for id in ["bevy", "phaser"] {
        let index = ENGINES.iter().position(|card| card.id == id).unwrap();
        lab.choose_engine(index);
        assert!(!lab.is_complete() && lab.lanes().len() == POLICIES.len() + 1);
        run(&mut lab);
        let lane = &lab.lanes()[lab.listed()[0]];
        assert_eq!([&lane.card().id, &lab.selected_card().id], [id, id]);
        assert!(lane.frames().len() > 100 && lab.on_stage().contains(&POLICIES.len()));
        assert_eq!(lab.advised(), advised);
    }
    lab.choose_trace(1);
    run(&mut lab);
    assert_eq!(lab.lanes().last().unwrap().card().id, "phaser");
    lab.choose_engine(1000);
    assert_eq!(lab.engine().unwrap().id, "phaser");
}

#[test]
fn the_raw_loop_in_floats_is_beside_it_where_rounding_decides_on_its_ticks() {
    let mut lab = lab();
    let steady = lab.traces().iter().position(|trace| trace.name() == "steady-60").unwrap();
    lab.choose_trace(steady);
    run(&mut lab);
    let repeated = |index: usize| {
        lab.lanes()[index].report().and_then(|report| report.repeated_percent).unwrap()
    };
    assert_eq!(lab.lanes()[POLICIES.len()].card().name, "Fixed, in floats");
    assert!(repeated(index_of(RAW)) == 0.0 && repeated(POLICIES.len()) > 30.0);
    assert_eq!(lab.listed()[1..3], [index_of(RAW), POLICIES.len()]);
    assert_eq!(on_stage(&lab), ["fixed", "hysteresis", "fixed-in-floats"]);
    lab.select(POLICIES.len());
    lab.set_tick_hz(30);
    assert!(lab.lanes().len() == POLICIES.len() && lab.selected() == index_of(RAW));
    run(&mut lab);
    lab.set_tick_hz(60);
    lab.choose_engine(0);
    assert_eq!(lab.lanes()[POLICIES.len()].card(), &*ENGINES[0]);
}

#[test]
fn game_time_is_kept_around_the_longest_frame() {
    let mut lab = lab();
    let points = |lab: &LoopLab, id: &str| {
        let lane = lab.lanes().iter().find(|lane| lane.card().id == id).unwrap();
        (lane.game_time().has_long(), lane.game_time().points().to_vec())
    };
    let (has_long, even) = points(&lab, "fixed-linear");
    assert!(!has_long && even.len() > 55 && even[0][0] == 0.0);
    let hitch = lab.traces().iter().position(|trace| trace.name() == "alt-tab-5s").unwrap();
    lab.choose_trace(hitch);
    run(&mut lab);
    for (id, jump_ms) in [("variable", 5000.0), ("fixed", 250.0)] {
        let (has_long, points) = points(&lab, id);
        let most = |axis: usize| {
            let gaps = points.windows(2).map(|pair| pair[1][axis] - pair[0][axis]);
            gaps.fold(0.0, f64::max)
        };
        assert!(has_long && (most(0) - 5000.0).abs() < 20.0, "{id}: {}", most(0));
        assert!((most(1) - jump_ms).abs() < 20.0, "{id}: {}", most(1));
        assert!(points.len() > 180, "{} frames", points.len());
    }
}
