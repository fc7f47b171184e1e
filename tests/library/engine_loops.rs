//! The loops of engines make the ticks that the engines made, and loops of lines are read or refused.

use std::sync::Arc;

use regatta::loops::{
    ENGINES, FrameLimits, Hitch, POLICIES, Pacer, PolicyCard, RefreshRate, Steps, TimeBase, engine,
    own_loop,
};
use serde_json::Value;

const RECORDINGS: &str = include_str!("../data/engine-loops/recordings.json");
/// Largest difference of a step from a recording of four decimals, in milliseconds.
const NEAR_MS: f64 = 1e-4;

fn base() -> TimeBase {
    TimeBase::new(60, RefreshRate::new(60, 1))
}

/// The moments of the first frames of a trace in ms, which begin at 1000.
fn moments(trace: &str, frames: usize) -> Vec<f64> {
    let odd_ms = match trace {
        "hitch100" => Some(100.0),
        "hitch1s" => Some(1000.0),
        "hitch10s" => Some(10_000.0),
        "back20" => Some(-20.0),
        "zero" => Some(0.0),
        _ => None,
    };
    let rate = trace.trim_start_matches(|c: char| c.is_ascii_alphabetic()).parse();
    let hz: f64 = if odd_ms.is_some() { 60.0 } else { rate.unwrap() };
    let moment = |n: usize| match (odd_ms, n) {
        (Some(odd_ms), 601..) => 11_000.0 + odd_ms + (n - 601) as f64 * 1000.0 / hz,
        _ => 1000.0 + n as f64 * 1000.0 / hz,
    };
    (0..frames).map(moment).collect()
}

/// The steps of a loop in every frame of a trace, the first of which starts the clock.
fn steps(card: &Arc<PolicyCard>, moments: &[f64]) -> Vec<Steps> {
    let mut pacer = Pacer::new(card, base());
    let first = pacer.frame_in_ms(0, 0.0);
    let later = moments.windows(2).map(|pair| {
        let ms = pair[1] - pair[0];
        pacer.frame_in_ms((ms * 1e6).round() as i64, ms)
    });
    [first].into_iter().chain(later).collect()
}

#[test]
fn every_engine_makes_the_ticks_of_its_recording() {
    let recordings: Value = serde_json::from_str(RECORDINGS).unwrap();
    let recordings = recordings.as_object().unwrap();
    let mut compared = 0;
    for (id, traces) in recordings {
        let card = engine(id).unwrap_or_else(|| panic!("{id}"));
        assert!(traces.as_object().unwrap().len() >= 3, "{id}");
        for (trace, runs) in traces.as_object().unwrap() {
            let (from, runs) = runs.as_array().unwrap().split_first().unwrap();
            let from = from.as_u64().unwrap() as usize;
            let wanted: Vec<&Value> = runs
                .iter()
                .flat_map(|run| std::iter::repeat_n(&run[1], run[0].as_u64().unwrap() as usize))
                .collect();
            let made = steps(card, &moments(trace, from + wanted.len()));
            // Entry 0 is the call that starts the clock, in which recorders differ.
            for (n, wanted) in wanted.iter().enumerate().skip(usize::from(from == 0)) {
                let Steps { count, span, returned, .. } = made[from + n];
                let at = format!("{id} on {trace}, frame {}: {count} for {wanted}", from + n);
                match wanted.as_array() {
                    None => assert_eq!(
                        u64::from(returned.unwrap_or(count)),
                        wanted.as_u64().unwrap(),
                        "{at}"
                    ),
                    Some(times) => {
                        assert_eq!(count as usize, times.len(), "{at}");
                        let sum: f64 = times.iter().map(|time| time.as_f64().unwrap()).sum();
                        let step_ms = base().milliseconds(span);
                        assert!((step_ms - sum).abs() <= NEAR_MS, "{at}: {step_ms} ms");
                    }
                }
                compared += 1;
            }
        }
    }
    assert!(recordings.len() == 27 && compared > 5000, "{compared} frames");
}

#[test]
fn every_engine_has_a_version_a_caveat_and_advice() {
    for card in ENGINES.iter() {
        let engine = card.engine.as_ref().unwrap();
        let all = [
            &card.name,
            &card.formula,
            &card.source,
            &engine.version,
            &engine.caveat,
            &engine.advice,
        ];
        assert!(all.iter().all(|text| !text.is_empty()), "{}: {all:?}", card.id);
        assert!(
            ["run", "read", "run and read", "documented"].contains(&&*card.source),
            "{}",
            card.id
        );
        let is_id = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        assert!(card.id.chars().all(is_id), "{}", card.id);
        assert_eq!(ENGINES.iter().filter(|other| other.id == card.id).count(), 1, "{}", card.id);
        assert!(regatta::loops::policy(&card.id).is_none(), "{}", card.id);
    }
}

/// The ticks of frames of these durations in ms under a loop of lines.
fn ticks(text: &str, durations: &[f64]) -> Vec<u32> {
    let card = own_loop("mine", text).unwrap_or_else(|fault| panic!("{text}: {fault:?}"));
    let mut moments = vec![1000.0];
    durations.iter().for_each(|ms| moments.push(moments[moments.len() - 1] + ms));
    steps(&card, &moments)[1..].iter().map(|steps| steps.count).collect()
}

#[test]
fn lines_make_ticks_in_loops_and_remember_in_arrays() {
    let fixed = "memory owed = 0\nowed += dt\nwhile owed >= H { tick 1; owed -= H }\nshow owed / H";
    assert_eq!(ticks(fixed, &[20.0, 20.0, 20.0, 100.0]), [1, 1, 1, 6]);
    let median = "memory past[3] = 10\nmemory at = 0\npast[at] = dt\nat = (at + 1) % 3\nlet least = min(past[0], past[1], past[2])\ntick 1 of least\ntick 2 of past[9 - 9]";
    assert_eq!(ticks(median, &[20.0, 30.0]), [3, 3]);
    let by_refresh = "if first > 0 { tick 5 } else { tick floor(dt / refresh + 0.5) }";
    assert_eq!(ticks(by_refresh, &[16.0, 33.0, 1.0]), [1, 2, 0]);
    let card = own_loop("mine", "tick 2 of dt / 2").unwrap();
    assert!(!card.has_fixed_tick && own_loop("mine", fixed).unwrap().has_fixed_tick);
    let made = steps(&card, &[1000.0, 1020.0, 1010.0]);
    assert_eq!(
        made.iter().map(|it| base().milliseconds(it.span)).collect::<Vec<_>>(),
        [0.0, 20.0, -10.0]
    );
    // A loop that asks for endless ticks is stopped, and one without a number makes none.
    assert_eq!(ticks("tick 1 / 0.0000000000001", &[16.0]), [100_000]);
    assert_eq!(ticks("tick nan", &[16.0]), [0]);
    assert!(ticks("while dt > 0 { tick 1 }", &[16.0])[0] <= 100_000);
}

#[test]
fn the_lines_of_every_ideal_loop_can_be_given_back() {
    for card in POLICIES.iter() {
        let own = own_loop(&card.id, card.lines().unwrap()).unwrap();
        assert_eq!(own.drawing_name(), card.drawing_name());
        assert_eq!(own.has_fixed_tick, card.has_fixed_tick, "{}", card.id);
        assert_eq!(own.needs_exact_clock, card.needs_exact_clock, "{}", card.id);
        let base = TimeBase::new(64, RefreshRate::new(2997, 50));
        let [mut known, mut found] = [card, &own].map(|card| Pacer::new(card, base));
        for n in 0..3000_i64 {
            let ns = match n % 97 {
                5 => 900_000_000,
                17..20 => 0,
                _ => 16_683_350 + n * n % 400_000 - 200_000,
            };
            assert_eq!(known.frame(ns), found.frame(ns), "{} frame {n}", card.id);
            assert_eq!(known.drawn_moment(), found.drawn_moment(), "{} frame {n}", card.id);
        }
    }
    // A constant can be set where the lines are a person's own.
    let fixed = own_loop("mine", POLICIES[4].lines().unwrap()).unwrap();
    let two = fixed.with_settings(&[("max_ticks".into(), 2.0)]).unwrap();
    assert_eq!(Pacer::new(&two, base()).frame(100_000_000).count, 2);
}

#[test]
fn a_fault_in_a_loop_has_its_place() {
    for (text, at, what) in [
        ("owed = dtt", 7..10, "unknown name `dtt`"),
        ("memory owed = 0", 0..15, "no line makes a tick"),
        ("tick 1; dt = 3", 8..10, "`dt` is told to the loop"),
        ("tick past[0]", 5..9, "unknown name `past`"),
        ("past[0] = 1; tick 1", 0..4, "`past` is no array"),
        ("memory past[0] = 1; tick 1", 12..13, "an array has 1 to 1024 numbers"),
        ("tick a(1, 2)", 5..6, "unknown function `a`"),
        ("takes whole cost\ntick 1", 5..16, "a loop takes no `whole cost`"),
        ("second = 1; tick 1", 0..6, "`second` is told to the loop"),
    ] {
        let fault = own_loop("mine", text).expect_err(text);
        assert_eq!(fault.span, at, "{text}: {fault:?}");
        assert!(fault.what.starts_with(what), "{text}: {fault:?}");
    }
    for method in ["tick 1; x = 1", "show 1; x = 1", "memory past[3] = 0; x = 1"] {
        assert!(regatta::sim::own_method("mine", method).is_err(), "{method}");
    }
}

#[test]
fn a_hitch_is_a_jump_a_loss_or_fast_forward() {
    let of = |id: &str, ms| Hitch::of(engine(id).unwrap(), base(), FrameLimits::default(), ms);
    let words = |id: &str, ms| of(id, ms).to_string();
    assert_eq!(words("three-timer", 1000.0), "a jump of 1000 ms");
    assert_eq!(words("excalibur", 1000.0), "nothing, 999 ms are lost");
    assert_eq!(words("p2-es", 10_000.0), "a jump of 166.7 ms, fast-forward for 66 frames");
    assert_eq!(of("babylon-lockstep", 1000.0).fast_frames, 19);
    assert_eq!(of("bevy", 1000.0).fast_frames, 0);
    assert!(words("kontra", 10_000.0).starts_with("nothing"), "{}", words("kontra", 10_000.0));
}

#[test]
fn a_constant_of_an_engine_can_be_set() {
    let babylon = engine("babylon-lockstep").unwrap();
    let wide = babylon.with_settings(&[("max_ticks".into(), 15.0)]).unwrap();
    let count = |card: &_| steps(card, &[1000.0, 1200.0])[1].count;
    assert_eq!((count(babylon), count(&wide)), (4, 12));
    let (name, known) = babylon.with_settings(&[("most".into(), 1.0)]).unwrap_err();
    assert!(name == "most" && known.contains(&"max_ticks".to_owned()), "{known:?}");
}

#[test]
fn the_manual_lists_every_engine_and_its_own_loop_runs() {
    let manual = |id: &str| regatta::manual::chapter(id).unwrap().text;
    let mut gives: Vec<&str> = Vec::new();
    for card in ENGINES.iter() {
        if !gives.contains(&&*card.formula) {
            gives.push(&card.formula);
        }
    }
    let mut rows = String::new();
    for formula in gives {
        let of = ENGINES.iter().filter(|card| card.formula == formula);
        let of = of.map(|card| format!("`{}` {}", card.id, card.engine.as_ref().unwrap().version));
        rows += &format!("| {formula} | {} |\n", of.collect::<Vec<_>>().join(", "));
    }
    assert!(
        manual("loops").ends_with(&format!("|---|---|\n{rows}")),
        "end src/manual/loops.md with\n{rows}"
    );
    let lines = manual("step").lines().filter_map(|line| line.strip_prefix("    "));
    let lines = lines.skip_while(|line| !line.starts_with("const most"));
    let text = lines.collect::<Vec<_>>().join("\n");
    assert_eq!(ticks(&text, &[20.0, 20.0, 500.0, 1.0, 1.0]), [1, 1, 8, 1, 0]);
}
