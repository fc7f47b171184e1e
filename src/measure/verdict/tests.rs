//! The exact wording of verdicts.

use crate::sim::integrators::StepFailure;
use crate::{
    Comparison, Finding, LongTerm, Measure, NoTruth, NotJudged, RunFailure, Severity, SwingWidths,
    TOLERANCE, Trend, Verdict,
};

const COMPARED: Comparison = Comparison {
    error: 0.25,
    error_at_s: 3.0,
    last_error: 0.2,
    truth_error: 0.0,
    change: Trend::None,
    looks_right: Some(false),
    width: Some(1.0),
    widths: None,
    early_s: None,
    energy_change: None,
    energy_drift_percent: None,
    frequency_error: None,
};

const SWINGS: LongTerm = LongTerm {
    measure: Measure::Swing,
    doubles_in_s: None,
    halves_in_s: None,
    parasite_doubles_in_s: None,
    is_bounded: Some(true),
};

/// Returns a verdict with only this finding.
fn of(finding: Finding) -> Verdict {
    Verdict {
        finding,
        long_term: SWINGS,
        chase: None,
        body: 0,
        body_name: "buoy".into(),
        evaluations: 1,
        seconds: 20.0,
        horizon_s: 20.0,
        starts_at_s: 0.0,
        of_bodies: Vec::new(),
    }
}

fn compared(comparison: Comparison) -> Verdict {
    of(Finding::Compared(comparison))
}

/// Returns the same verdict for one of two bodies.
fn of_two(verdict: Verdict) -> Verdict {
    Verdict { of_bodies: vec![verdict.clone(), verdict.clone()], ..verdict }
}

fn failed(cause: &StepFailure) -> Finding {
    Finding::Failed { failure: RunFailure { t: 4.0, cause: cause.clone() }, by_energy: None }
}

#[test]
fn a_wrong_width_of_the_swing_is_named_in_the_verdict() {
    let off = "off by up to 281 % at 3 s, by 20 % after 20 s";
    for (width, shown) in [
        (1.8, "bounded · swings 1.8 × too wide"),
        (1.5, "bounded · swings 1.5 × too wide"),
        (1.499, "bounded · swings 50 % too wide"),
        (1.053, "bounded · swings 5.3 % too wide"),
        (0.7, "bounded · swings 30 % too narrow"),
        (0.5, "bounded · swings 0.50 × as wide"),
        (1.04, "bounded · off by 281 % at 3 s"),
    ] {
        let found = Comparison {
            width: Some(width),
            energy_change: Some(0.0),
            frequency_error: Some(0.18),
            error: 2.81,
            ..COMPARED
        };
        let verdict = compared(found);
        assert_eq!(verdict.to_string(), shown);
        assert_eq!(verdict.details(), [off, "18 % fast"]);
        assert_eq!(verdict.outcome().severity(), Severity::Doubtful);
    }
}

#[test]
fn a_lane_that_begins_off_the_truth_is_named_by_both_widths() {
    let widths = |own, unit| Some(SwingWidths { own, truth: 1.0, unit });
    let of =
        |own: f64, unit| Comparison { width: Some(own), widths: widths(own, unit), ..COMPARED };
    let bounded = compared(of(2.04, "m"));
    assert_eq!(bounded.wordings(true), ["stays ±2.04 m (exact ±1)", "bounded"]);
    assert_eq!(compared(of(0.4, "")).to_string(), "stays ±0.4 (exact ±1)");
    let number = bounded.number().expect("a width");
    assert_eq!((&*number.quantity, number.value, number.unit), ("width", 2.04, "×"));
    let grows = LongTerm { doubles_in_s: Some(2.1), is_bounded: Some(false), ..SWINGS };
    let found = Comparison { change: Trend::Grows, ..of(2.04, "m") };
    let grows = Verdict { long_term: grows, ..compared(found) };
    assert_eq!(grows.to_string(), "grows · swing ×2 in 2.1 s");
    assert_eq!(grows.details()[0], "2.0 × too wide at 0 s");
    let right = Comparison { looks_right: Some(true), early_s: Some(0.02), ..of(1.04, "m") };
    assert_eq!(compared(right).to_string(), "looks right · 20 ms early after 20 s");
}

fn is(verdict: Verdict, shown: &str, details: &[&str]) {
    assert_eq!(verdict.to_string(), shown);
    assert_eq!(verdict.details(), details, "{shown}");
}

const DOUBLING: LongTerm = LongTerm { doubles_in_s: Some(90.0), ..SWINGS };

#[test]
fn a_verdict_shows_the_number_of_its_outcome_and_details_show_the_rest() {
    is(compared(Comparison { error: 3e-12, ..COMPARED }), "accurate · within 10⁻⁹ %", &[]);
    is(
        compared(Comparison { error: 0.004, ..COMPARED }),
        "accurate · within 0.40 %",
        &["largest error 0.40 % of the amplitude, at 3 s"],
    );

    let faded = "off by up to 25 % at 3 s, by 20 % after 20 s";
    is(compared(COMPARED), "bounded · off by 25 % at 3 s", &[faded]);
    let right = Comparison { looks_right: Some(true), ..COMPARED };
    is(compared(right), "looks right · off by 25 % at 3 s", &[faded]);
    for (error, off) in [(9.99, "999 %"), (10.0, "10 amplitudes"), (27.32, "27 amplitudes")] {
        let tipped = Comparison { error, last_error: error, ..COMPARED };
        let details = format!("off by up to {off} at 3 s, by {off} after 20 s");
        is(compared(tipped), &format!("bounded · off by {off}"), &[&details]);
    }
    let unknown = LongTerm { is_bounded: None, ..SWINGS };
    let open = Verdict { long_term: unknown, ..compared(COMPARED) };
    is(open, "inaccurate · off by 25 % at 3 s", &[faded]);
    is(
        compared(Comparison { last_error: 0.25, ..COMPARED }),
        "bounded · off by 25 %",
        &["off by up to 25 % at 3 s, by 25 % after 20 s"],
    );
    is(
        compared(Comparison { last_error: TOLERANCE, ..COMPARED }),
        "bounded · off by 25 % at 3 s",
        &["off by 25 % at 3 s, settled by 20 s"],
    );
    for (early_s, time) in [
        (0.0174, "17 ms early"),
        (-0.0174, "17 ms late"),
        (0.9994, "999 ms early"),
        (-1.25, "1.2 s late"),
        (2.0, "2.0 s early"),
    ] {
        let found = Comparison { early_s: Some(early_s), ..right };
        let shown = format!("looks right · {time} after 20 s");
        is(compared(found), &shown, &[faded]);
        is(of_two(compared(found)), &format!("{shown} (buoy)"), &[faded]);
    }
    for (error, pitch) in [(-0.02, "2.0 % slow"), (0.02, "2.0 % fast")] {
        let found = Comparison { frequency_error: Some(error), ..COMPARED };
        for (measure, shown) in [
            (Measure::Modes, format!("bounded · main mode {pitch}")),
            (Measure::Reach, format!("bounded · {pitch}")),
            (Measure::Swing, "bounded · off by 25 % at 3 s".to_owned()),
        ] {
            let long_term = LongTerm { measure, ..SWINGS };
            is(Verdict { long_term, ..compared(found) }, &shown, &[faded, pitch]);
        }
    }
    is(
        Verdict {
            long_term: LongTerm { parasite_doubles_in_s: Some(7.0), ..DOUBLING },
            ..compared(right)
        },
        "looks right · off by 25 % at 3 s",
        &[faded, "grows slowly: swing ×2 in 90 s", "a faint mode grows: ×2 in 7 s"],
    );
}

#[test]
fn a_verdict_on_growth_or_decay_shows_its_time_or_its_energy() {
    let grows = Comparison { change: Trend::Grows, ..COMPARED };
    let of_energy = Comparison { energy_change: Some(0.5), ..grows };
    is(compared(grows), "grows · off by 25 %", &[]);
    is(compared(of_energy), "grows · energy +50 % in 20 s", &[]);
    for (measure, name) in [
        (Measure::Swing, "swing"),
        (Measure::Modes, "swing"),
        (Measure::Reach, "reach"),
        (Measure::Deviation, "deviation"),
    ] {
        is(
            Verdict { long_term: LongTerm { measure, ..DOUBLING }, ..compared(of_energy) },
            &format!("grows · {name} ×2 in 90 s"),
            &[&format!("its {name} doubles in 90 s")],
        );
    }
    let faint = LongTerm { parasite_doubles_in_s: Some(7.0), is_bounded: Some(false), ..SWINGS };
    is(
        Verdict { long_term: faint, ..compared(grows) },
        "grows · a faint mode ×2 in 7.0 s",
        &["a faint mode grows: ×2 in 7 s"],
    );
    let loses = Comparison { energy_change: Some(-0.5), change: Trend::Dies, ..COMPARED };
    is(compared(loses), "dies away · energy −50 % in 20 s", &[]);
    let all = Comparison { energy_change: Some(-0.998), ..loses };
    is(compared(all), "dies away · all its energy in 20 s", &[]);
    let more = Comparison { energy_change: Some(-1.08), ..loses };
    is(compared(more), "dies away · all its energy in 20 s", &[]);
    for (halves_in_s, shown) in
        [(5.04, "swing ½ in 5.0 s"), (400.0, "swing ½ in 400 s"), (401.0, "energy −50 % in 20 s")]
    {
        let long_term = LongTerm { halves_in_s: Some(halves_in_s), ..SWINGS };
        is(Verdict { long_term, ..compared(loses) }, &format!("dies away · {shown}"), &[]);
    }
}

#[test]
fn a_verdict_without_a_motion_or_a_truth_shows_the_reason() {
    let escaped = StepFailure::NotFinite { coordinate: "x".into(), value: f64::NAN };
    let unsolved = StepFailure::LinearSolveFailed;
    let long_term = LongTerm { parasite_doubles_in_s: Some(7.0), ..DOUBLING };
    is(Verdict { long_term, ..of(failed(&escaped)) }, "blows up · at 4 s", &[&escaped.to_string()]);
    is(
        Verdict { long_term, ..of(failed(&unsolved)) },
        "gives up · at 4 s",
        &[&unsolved.to_string(), "its swing doubles in 90 s"],
    );

    let without = |why| of(Finding::NoTruth(why));
    is(
        without(NoTruth::Vague(0.05)),
        "no truth · known to 5.0 %",
        &["the true motion is known to 5.0 % of the amplitude only"],
    );
    is(
        without(NoTruth::Vague(f64::INFINITY)),
        "no truth",
        &["the true motion is not known precisely enough"],
    );
    is(
        without(NoTruth::Failed(escaped.clone())),
        "no truth",
        &[&format!("the true motion is not known: it {escaped}")],
    );
    for (why, shown) in [
        (NotJudged::TooMuchWork, "not judged · too much work"),
        (NotJudged::ShorterThanATick, "not judged · the scene is shorter than a tick"),
    ] {
        is(of(Finding::NotJudged(why)), shown, &[]);
    }
}
