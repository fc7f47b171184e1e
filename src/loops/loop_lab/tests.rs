use super::*;
use crate::measure::Severity;
use crate::sim::TickRate;
use crate::sim::integrators::method;
use crate::{policy, trace_file};

fn studio() -> LoopLab {
    lab_of(&Scene::built_in("spring").unwrap())
}

fn lab_of(scene: &Scene) -> LoopLab {
    let mut studio = LoopLab::new(scene, 0, method("rk4").unwrap());
    run(&mut studio);
    studio
}

/// Runs every requested loop.
fn run(studio: &mut LoopLab) {
    let mut worker = LoopWorker::default();
    worker.set_request(Some(studio.request().clone()));
    while let Some(found) = worker.work(&|| false) {
        studio.accept(found);
    }
}

#[test]
fn the_loop_lab_opens_where_raw_ticks_judder_and_whole_refreshes_do_not() {
    let studio = studio();
    assert_eq!(studio.traces()[studio.trace()].name(), "edge");
    let error = |id: &str| {
        let lane = studio.lanes().iter().find(|lane| lane.card().id == id).unwrap();
        lane.report().unwrap().animation_error_rms_ms.unwrap()
    };
    assert!((11.0..12.6).contains(&error("fixed")), "{}", error("fixed"));
    assert!(error("whole-refresh") < 1e-6, "{}", error("whole-refresh"));
    assert_eq!(on_stage(&studio), ["fixed", "whole-refresh"]);
    assert_eq!(studio.selected_card(), policy("fixed").unwrap());
}

#[test]
fn the_advised_loop_leads_the_list_and_variable_steps_are_never_green() {
    let mut studio = studio();
    assert_eq!(studio.lanes()[studio.listed()[0]].card().id, "whole-refresh");
    let trace = studio.traces().iter().position(|trace| trace.name() == "steady-144").unwrap();
    studio.choose_trace(trace);
    assert_eq!((studio.advised(), studio.listed()[0]), (None, 0), "not run yet");
    run(&mut studio);
    let listed = studio.listed();
    let advised = studio.advised().unwrap();
    assert_eq!((listed[0], studio.lanes()[listed[0]].card().id), (advised.index, "fixed-linear"));
    assert!(advised.why.unwrap().contains("overshoots at each kick"));
    let mut all = listed.clone();
    all.sort_unstable();
    assert!(all.iter().copied().eq(0..studio.lanes().len()) && listed[1..].is_sorted());
    assert!(studio.verdict(listed[0]).to_string().starts_with("recommended, smooth"));
    for (lane, index) in studio.lanes().iter().zip(0..) {
        let verdict = studio.verdict(index);
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
        let mut studio = lab_of(&scene);
        studio.add_traces(trace_file::read("own.txt", &"7.1\n".repeat(600)).unwrap());
        for trace in 0..studio.traces().len() {
            studio.choose_trace(trace);
            run(&mut studio);
            let words = studio.verdict(studio.listed()[0]).to_string();
            let place =
                format!("{name} at {tick_hz} Hz on {}: {words}", studio.traces()[trace].name());
            assert!(on_stage(&studio).contains(&"fixed"), "{place}");
            let Some(advised) = studio.advised() else {
                let recommended = (0..POLICIES.len())
                    .filter(|&i| studio.verdict(i).to_string().contains("recommended"));
                assert_eq!(recommended.count(), 0, "{place}");
                let (none, told) = studio.none_advised().expect("either one or none");
                assert!(
                    none.nearest().is_none_or(|near| studio.on_stage().contains(&near)),
                    "{place}"
                );
                reasons.push((place, told.join("; ")));
                continue;
            };
            assert_eq!(
                (studio.listed()[0], studio.none_advised()),
                (advised.index, None),
                "{place}"
            );
            assert!(words.starts_with("recommended, smooth"), "{place}");
            assert_eq!(studio.verdict(advised.index).severity, Severity::Fine, "{place}");
            assert!(studio.lanes()[advised.index].card().has_fixed_tick, "{place}");
            // The first four policies step by the frame.
            assert!(advised.index > 3, "{place}");
            assert!(studio.on_stage().contains(&advised.index), "{place}");
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
    let studio = lab_of(&scene);
    let linear = index_of("fixed-linear");
    let verdict = studio.verdict(linear);
    assert_eq!(verdict.to_string(), "the motion is lost, more ticks or another method keep it");
    assert_eq!(verdict.severity, Severity::Bad);
}

fn on_stage(studio: &LoopLab) -> Vec<&'static str> {
    studio.on_stage().iter().map(|&index| studio.lanes()[index].card().id).collect()
}

#[test]
fn the_opening_moves_to_a_fast_display_unless_a_person_acts() {
    let past_the_first = 8 * (OPENING_NS + 1_000_000);
    let mut studio = studio();
    studio.advance(past_the_first);
    assert_eq!(studio.trace(), 0, "not asked for");
    studio.seek(0);
    studio.play_opening();
    studio.advance(past_the_first);
    assert_eq!(studio.traces()[studio.trace()].name(), "steady-144");
    assert_eq!(on_stage(&studio), ["fixed", "fixed-linear"]);
    assert_eq!(studio.now_ns(), 0);
    run(&mut studio);
    studio.advance(past_the_first);
    assert_eq!(studio.traces()[studio.trace()].name(), "steady-144", "it stays there");
    studio.select(0);
    studio.choose_trace(0);
    assert_eq!(on_stage(&studio).len(), 3, "what a person chose stays");
}

#[test]
fn a_script_acts_on_the_body_at_its_times_under_any_tick_rate() {
    let scene = Scene::built_in("helm").unwrap();
    assert!(!scene.script.is_empty());
    let mut studio = lab_of(&scene);
    let ends = |studio: &LoopLab| studio.lanes()[0].frames().last().unwrap().exact[0];
    let at_own_rate = ends(&studio);
    let bare = Scene { script: Vec::new(), ..scene.clone() };
    assert_ne!(at_own_rate, ends(&lab_of(&bare)));
    studio.set_tick_hz(scene.tick_hz.scaled(3, 1));
    run(&mut studio);
    let relative = (ends(&studio) / at_own_rate - 1.0).abs();
    assert!(relative < 1e-12, "{relative}");
}

#[test]
fn a_display_holds_a_frame_until_the_next() {
    let mut studio = studio();
    studio.step(3);
    let lane = &studio.lanes()[studio.selected()];
    let at = lane.frame_at(studio.now_ns()).unwrap();
    assert_eq!(at, 3);
    assert_eq!(lane.frame_at(lane.frames()[4].displayed_ns - 1), Some(3));
    assert_eq!(lane.frame_at(-1), None);
    studio.step(-100);
    assert_eq!(studio.now_ns(), 0);
}

#[test]
fn a_held_frame_falls_further_and_further_behind() {
    let mut studio = studio();
    let index = studio.traces().iter().position(|trace| trace.name() == "alt-tab-5s").unwrap();
    studio.choose_trace(index);
    run(&mut studio);
    let frames = studio.lanes()[studio.selected()].frames();
    let longest = frames.windows(2).max_by_key(|pair| pair[1].displayed_ns - pair[0].displayed_ns);
    let held = longest.unwrap()[0].clone();
    studio.seek(held.displayed_ns + 5_000_000);
    assert_eq!(studio.late_ms(&held), held.latency_ms());
    studio.seek(held.displayed_ns + 1_500_000_000);
    assert!((studio.late_ms(&held) - held.latency_ms() - 1500.0).abs() < 1e-9);
}

#[test]
fn playback_is_slow_and_wraps_at_its_end() {
    let mut studio = studio();
    studio.advance(80_000_000);
    assert_eq!(studio.now_ns(), 10_000_000);
    studio.seek(i64::MAX);
    assert_eq!(studio.now_ns(), studio.end_ns());
    studio.advance(80_000_000);
    assert_eq!(studio.now_ns(), 0);
}

#[test]
fn the_stage_holds_one_to_four_lanes_in_the_order_of_the_table() {
    let mut studio = studio();
    for index in [0, 1, 2, 99] {
        studio.select(index);
    }
    assert_eq!(studio.on_stage().len(), MAX_ON_STAGE);
    assert!(studio.on_stage().is_sorted() && studio.on_stage().contains(&studio.selected()));
    for index in 0..POLICIES.len() {
        if studio.on_stage().contains(&index) {
            studio.toggle(index);
        }
    }
    assert_eq!(studio.on_stage().len(), 1);
}

#[test]
fn a_stopped_loop_runs_again() {
    let studio = studio();
    let mut worker = LoopWorker::default();
    worker.set_request(Some(studio.request().clone()));
    assert!(worker.work(&|| true).is_none() && !worker.is_done());
    let index = worker.work(&|| false).map(|found| found.index);
    assert_eq!(index, Some(studio.on_stage()[0]));
}

#[test]
fn an_engine_runs_beside_the_loops_and_is_not_advised() {
    let mut studio = studio();
    let advised = studio.advised();
    for id in ["bevy", "phaser"] {
        let index = ENGINES.iter().position(|card| card.id == id).unwrap();
        studio.choose_engine(index);
        assert!(!studio.is_complete() && studio.lanes().len() == POLICIES.len() + 1);
        run(&mut studio);
        let lane = &studio.lanes()[studio.listed()[0]];
        assert_eq!((lane.card().id, studio.selected_card().id), (id, id));
        assert!(lane.frames().len() > 100 && studio.on_stage().contains(&POLICIES.len()));
        assert_eq!(studio.advised(), advised);
    }
    studio.choose_trace(1);
    run(&mut studio);
    assert_eq!(studio.lanes().last().unwrap().card().id, "phaser");
    studio.choose_engine(1000);
    assert_eq!(studio.engine().unwrap().id, "phaser");
}

#[test]
fn the_raw_loop_in_floats_is_beside_it_where_rounding_decides_on_its_ticks() {
    let mut studio = studio();
    let steady = studio.traces().iter().position(|trace| trace.name() == "steady-60").unwrap();
    studio.choose_trace(steady);
    run(&mut studio);
    let repeated = |index: usize| {
        studio.lanes()[index].report().and_then(|report| report.repeated_percent).unwrap()
    };
    assert_eq!(studio.lanes()[POLICIES.len()].card().name, "Fixed, in floats");
    assert!(repeated(index_of(RAW)) == 0.0 && repeated(POLICIES.len()) > 30.0);
    assert_eq!(studio.listed()[1..3], [index_of(RAW), POLICIES.len()]);
    assert_eq!(on_stage(&studio), ["fixed", "hysteresis", "fixed-in-floats"]);
    studio.select(POLICIES.len());
    studio.set_tick_hz(30);
    assert!(studio.lanes().len() == POLICIES.len() && studio.selected() == index_of(RAW));
    run(&mut studio);
    studio.set_tick_hz(60);
    studio.choose_engine(0);
    assert_eq!(studio.lanes()[POLICIES.len()].card(), &ENGINES[0]);
}

#[test]
fn game_time_is_kept_around_the_longest_frame() {
    let mut studio = studio();
    let points = |studio: &LoopLab, id: &str| {
        let lane = studio.lanes().iter().find(|lane| lane.card().id == id).unwrap();
        (lane.game_time().has_long(), lane.game_time().points().to_vec())
    };
    let (has_long, even) = points(&studio, "fixed-linear");
    assert!(!has_long && even.len() > 55 && even[0][0] == 0.0);
    let hitch = studio.traces().iter().position(|trace| trace.name() == "alt-tab-5s").unwrap();
    studio.choose_trace(hitch);
    run(&mut studio);
    for (id, jump_ms) in [("variable", 5000.0), ("fixed", 250.0)] {
        let (has_long, points) = points(&studio, id);
        let most = |axis: usize| {
            let gaps = points.windows(2).map(|pair| pair[1][axis] - pair[0][axis]);
            gaps.fold(0.0, f64::max)
        };
        assert!(has_long && (most(0) - 5000.0).abs() < 20.0, "{id}: {}", most(0));
        assert!((most(1) - jump_ms).abs() < 20.0, "{id}: {}", most(1));
        assert!(points.len() > 180, "{} frames", points.len());
    }
}
