//! What verdicts say, word by word.

use regatta::lab::analysis::{
    Comparison, Finding, LongTerm, NoTruth, NotJudged, Outcome, RunFailure, Severity, TOLERANCE,
    Trend, Verdict,
};
use regatta::lab::studio::KEYS;
use regatta::manual::chapter;
use regatta::sim::integrators::StepFailure;

const COMPARED: Comparison = Comparison {
    error: 0.25,
    error_at_s: 3.0,
    last_error: 0.2,
    truth_error: 0.0,
    change: Trend::None,
    leap: None,
    energy_change: None,
    energy_drift_percent: None,
    frequency_error: None,
};

const SWINGS: LongTerm = LongTerm {
    swings: true,
    doubles_in_s: None,
    halves_in_s: None,
    parasite_doubles_in_s: None,
    is_bounded: Some(true),
};

/// A verdict with nothing in it but this finding.
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

/// The same of one of two bodies.
fn of_two(verdict: Verdict) -> Verdict {
    Verdict { of_bodies: vec![verdict.clone(), verdict.clone()], ..verdict }
}

fn failed(cause: &StepFailure) -> Finding {
    Finding::Failed { failure: RunFailure { t: 4.0, cause: cause.clone() }, by_energy: None }
}

/// The word, the number and the details of a verdict.
pub(crate) fn everything(verdict: &Verdict) -> String {
    [vec![verdict.to_string()], verdict.details()].concat().join("; ")
}

#[test]
fn a_swing_that_is_much_too_wide_is_not_called_stable() {
    let found = Comparison {
        change: Trend::Grows,
        leap: Some(1.8),
        energy_change: Some(0.0),
        frequency_error: Some(0.18),
        error: 2.81,
        ..COMPARED
    };
    let verdict = compared(found);
    assert_eq!(verdict.to_string(), "gains energy · up to ×1.8");
    assert_eq!(verdict.details(), ["18 % fast"]);
    assert_eq!(verdict.outcome().severity(), Severity::Bad);
}

#[test]
fn beside_a_run_that_was_changed_each_wording_tells_of_which_run_it_is() {
    let found = compared(Comparison { energy_change: Some(0.0), ..COMPARED });
    for (starts_at_s, from) in [(0.0, "from the start: "), (3.0, "from 3 s: ")] {
        let verdict = Verdict { starts_at_s, ..found.clone() };
        let wordings = verdict.wordings_of_another_run(true);
        let said = ["stable · 25 % out of phase after 20 s", "stable"];
        assert_eq!(wordings, said.map(|words| format!("{from}{words}")));
    }
}

#[test]
fn a_verdict_says_the_number_that_its_outcome_is_about_and_its_details_the_rest() {
    let is = |verdict: Verdict, shown: &str, details: &[&str]| {
        assert_eq!(verdict.to_string(), shown);
        assert_eq!(verdict.details(), details, "{shown}");
    };
    is(compared(Comparison { error: 3e-12, ..COMPARED }), "within rounding · 10⁻¹¹", &[]);
    is(
        compared(Comparison { error: 0.004, ..COMPARED }),
        "accurate · 0.40 %",
        &["largest error 0.40 % of the amplitude, at 3 s"],
    );

    let phase = Comparison { energy_change: Some(0.0), ..COMPARED };
    is(compared(phase), "stable · 25 % out of phase after 20 s", &[]);
    let unknown = LongTerm { is_bounded: None, ..SWINGS };
    let unbounded = Verdict { long_term: unknown, ..compared(phase) };
    is(unbounded, "out of phase · 25 % after 20 s", &[]);
    let faded = ["off by up to 25 % at 3 s, by 20 % after 20 s"];
    is(compared(COMPARED), "stable · 25 % off at 3 s", &faded);
    let long_term = unknown;
    is(Verdict { long_term, ..compared(COMPARED) }, "inaccurate · 25 % off at 3 s", &faded);
    is(
        compared(Comparison { last_error: 0.25, ..COMPARED }),
        "stable · 25 % off after 20 s",
        &["off by up to 25 % at 3 s, by 25 % after 20 s"],
    );
    is(
        compared(Comparison { last_error: TOLERANCE, ..COMPARED }),
        "stable · 25 % off at 3 s",
        &["off by 25 % at 3 s, settled by 20 s"],
    );
    is(
        compared(Comparison { error: 2.81, last_error: 2.7, ..phase }),
        "inaccurate · 281 % off after 20 s",
        &["off by up to 281 % at 3 s, by 270 % after 20 s"],
    );
    let fast = Comparison { error: 2.17, frequency_error: Some(0.05), ..phase };
    let past_all_phases = ["off by up to 217 % at 3 s, by 20 % after 20 s", "5.0 % fast"];
    is(of_two(compared(fast)), "inaccurate · 5.0 % fast (buoy)", &past_all_phases);
    for (error, way, pitch) in [(-0.02, "late", "2.0 % slow"), (0.02, "early", "2.0 % fast")] {
        let found = compared(Comparison { frequency_error: Some(error), ..phase });
        let shown = format!("stable · 25 % {way} after 20 s");
        is(found.clone(), &shown, &[pitch]);
        is(of_two(found), &format!("{shown} (buoy)"), &[pitch]);
    }
    let doubling = LongTerm { doubles_in_s: Some(90.0), ..SWINGS };
    is(
        Verdict {
            long_term: LongTerm { parasite_doubles_in_s: Some(7.0), ..doubling },
            ..compared(phase)
        },
        "stable · 25 % out of phase after 20 s",
        &["grows slowly: swing ×2 in 90 s", "a faint mode grows: ×2 in 7 s"],
    );

    let gains = Comparison { change: Trend::Grows, ..COMPARED };
    let of_energy = Comparison { energy_change: Some(0.5), ..gains };
    is(compared(gains), "grows · 25 % off in 20 s", &[]);
    is(compared(of_energy), "gains energy · +50 % in 20 s", &[]);
    is(
        Verdict { long_term: LongTerm { swings: false, ..doubling }, ..compared(of_energy) },
        "gains energy · ×2 in 90 s",
        &["its deviation doubles in 90 s"],
    );
    let loses = Comparison { energy_change: Some(-0.5), change: Trend::Dies, ..COMPARED };
    is(compared(loses), "loses energy · −50 % in 20 s", &[]);
    let all = Comparison { energy_change: Some(-0.998), ..loses };
    is(compared(all), "loses energy · all of it in 20 s", &[]);
    let long_term = LongTerm { halves_in_s: Some(5.04), ..SWINGS };
    is(Verdict { long_term, ..compared(loses) }, "loses energy · ½ in 5.0 s", &[]);

    let escaped = StepFailure::NotFinite { coordinate: "x".into(), value: f64::NAN };
    let unsolved = StepFailure::LinearSolveFailed;
    let long_term = LongTerm { parasite_doubles_in_s: Some(7.0), ..doubling };
    let start = "if run from the start";
    is(
        Verdict { long_term, ..of(failed(&escaped)) },
        "blows up · at 4 s",
        &[start, &escaped.to_string()],
    );
    is(
        Verdict { long_term, ..of(failed(&unsolved)) },
        "gives up · at 4 s",
        &[start, &unsolved.to_string(), "its swing doubles in 90 s"],
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

#[test]
fn only_the_two_best_words_are_accurate_and_four_are_bad() {
    for word in Outcome::ALL {
        let is_fine = matches!(word, Outcome::Rounding | Outcome::Accurate);
        assert_eq!(word.severity() == Severity::Fine, is_fine, "{}", word.id());
        // A verdict tells what will be, and an id what was found.
        let said = word.text().replace("gives", "gave").replace("blows", "blew");
        assert_eq!(word.id(), said.replace("within ", "").replace(' ', "-"));
    }
    let bad = Outcome::ALL.iter().filter(|word| word.severity() == Severity::Bad);
    assert_eq!(bad.count(), 4);
}

#[test]
fn the_manual_says_of_escape_what_the_list_of_keys_says() {
    let escape = KEYS.iter().find(|binding| binding.shown == "Esc").unwrap();
    let row = format!("| `Esc` | {} |", escape.about);
    assert!(chapter("keys").unwrap().text.contains(&row), "{row}");
}
