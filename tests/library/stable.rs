//! The promises of `regatta help stable` to a program that uses the library.

use std::collections::BTreeSet;

use regatta::measure::{Criteria, CriterionMet, MethodReport, Recommendation};
use regatta::prelude::*;

/// Every name that the prelude brings where all features are on.
const PRELUDE: [&str; 41] = [
    "Adviser",
    "BODIES",
    "Body",
    "CRITERIA",
    "Clock",
    "Due",
    "Elementwise",
    "Extras",
    "Family",
    "Input",
    "Integrator",
    "Judge",
    "Lane",
    "LaneSpec",
    "METHODS",
    "METRICS",
    "Mark",
    "Method",
    "Options",
    "OptionsError",
    "ParameterOf",
    "Race",
    "Range",
    "Report",
    "SCENES",
    "Scene",
    "Session",
    "Solver",
    "State",
    "StepFailure",
    "Stepper",
    "System",
    "UnknownMethod",
    "Vector",
    "Verdict",
    "Window",
    "integrator",
    "method",
    "method_or_nearest",
    "custom_integrator",
    "stepper",
];

/// The names that the `pub use` lines of a file bring.
fn exported(text: &str) -> BTreeSet<&str> {
    let uses = text.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next());
    let names = uses.flat_map(|list| list.rsplit(['{', '}', ',']));
    let names = names.map(|name| name.trim().rsplit("::").next().unwrap_or_default());
    names.filter(|name| !name.is_empty()).collect()
}

#[test]
fn the_prelude_exports_exactly_the_promised_names() {
    // The names beside an engine's prelude are not those of ours.
    let of_sim = include_str!("../../src/sim/prelude.rs");
    let (of_sim, _) = of_sim.split_once("pub mod beside").expect("it");
    let mut names = exported(of_sim);
    names
        .extend(exported(include_str!("../../src/prelude.rs")).iter().filter(|&&name| name != "*"));
    assert_eq!(names, BTreeSet::from(PRELUDE), "a change for everybody who imports the prelude");
}

#[test]
fn a_state_is_a_plain_value() {
    let state = State::from((1.5, -2.0));
    let copy = state;
    assert_eq!((state, State::default()), (copy, State { q: 0.0, v: 0.0 }));
    assert_eq!(Options::<Sprung>::default().max_work, regatta::measure::MAX_WORK);
    assert_eq!(Options::<Sprung>::default().clone().name, "body");
}

/// A state from a save game continues with the same bits.
#[cfg(feature = "cli")]
#[test]
fn a_state_survives_writing_and_reading_to_the_bit() {
    use regatta::glam::DVec2;
    let state = State { q: DVec2::new(0.1, 1e-310), v: DVec2::new(-0.0, 1.0 / 3.0) };
    let text = serde_json::to_string(&state).expect("it is written");
    assert_eq!(text, r#"{"q":[0.1,1e-310],"v":[-0.0,0.3333333333333333]}"#);
    let read: State<DVec2> = serde_json::from_str(&text).expect("it is read");
    let bits = |s: &State<DVec2>| [s.q, s.v].map(|half| half.to_array().map(f64::to_bits));
    assert_eq!(bits(&read), bits(&state));
    let many = State { q: vec![1.0], v: vec![2.0] };
    let text = serde_json::to_string(&many).expect("it is written");
    assert_eq!(serde_json::from_str::<State<Vec<f64>>>(&text).expect("it is read"), many);
}

#[derive(Clone)]
struct Sprung;
impl System for Sprung {
    type Vector = f64;
    fn acceleration(&self, _t: f64, q: &f64, _v: &f64, a: &mut f64) {
        *a = -40.0 * q;
    }
}

/// A field that is renamed or taken away does not compile here.
#[test]
fn a_report_has_the_promised_fields() {
    let Options { name, tick_hz, seconds: _, methods: _, max_work, extras, draw } =
        Options::default();
    let two = ["semi-implicit-euler", "rk4"];
    let methods = two.map(|id| method(id).expect("a method of the table")).to_vec();
    let options = Options { name, tick_hz, seconds: 3.0, methods, max_work, extras, draw };
    let report = regatta::advise(&Sprung, State { q: 1.0, v: 0.0 }, options);

    let Report { name, tick_hz, horizon_s, methods, recommended, not_known, .. } = report;
    assert_eq!((name.as_str(), tick_hz, horizon_s), ("body", 60.into(), 3.0));
    let Criteria { bounded, looks_right, accurate } = recommended;
    for recommendation in [bounded, looks_right, accurate] {
        let Recommendation { method, with, instead_of, .. } =
            recommendation.expect("one of the two does");
        assert!(two.contains(&method));
        assert_eq!(instead_of, None);
        let CriterionMet {
            tick_hz,
            substeps,
            evaluations_per_s,
            cost_per_s,
            are_margins_searched,
            slowest_hz,
            stiffness_factor,
            limited_by,
            ..
        } = with;
        assert!(are_margins_searched);
        assert_eq!((tick_hz, cost_per_s), (60.into(), evaluations_per_s));
        assert_eq!(evaluations_per_s % f64::from(60 * substeps), 0.0);
        assert!(slowest_hz.is_some_and(|hz| (1..=60).contains(&hz)));
        assert!(stiffness_factor.is_some_and(|factor| (1.0..=10.0).contains(&factor)));
        assert_eq!(limited_by.as_deref(), Some("force"));
    }
    for id in [not_known.bounded, not_known.looks_right, not_known.accurate] {
        assert_eq!(id, Vec::<&str>::new());
    }
    let ids: Vec<&str> = methods.iter().map(|row| row.method).collect();
    assert_eq!(ids, two);
    for MethodReport { verdict, criteria, .. } in methods {
        assert!(verdict.error().is_some_and(f64::is_finite));
        assert!(criteria.accurate.is_some());
    }
}
