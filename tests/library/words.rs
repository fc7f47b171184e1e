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
    assert_eq!(verdict.to_string(), "gains energy: swing up to ×1.8 (18 % fast)");
    assert_eq!(verdict.outcome().severity(), Severity::Bad);
}

#[test]
fn beside_a_run_that_was_changed_each_wording_tells_of_which_run_it_is() {
    let found = compared(Comparison { energy_change: Some(0.0), ..COMPARED });
    for (starts_at_s, from) in [(0.0, "from the start: "), (3.0, "from 3 s: ")] {
        let verdict = Verdict { starts_at_s, ..found.clone() };
        let wordings = verdict.wordings_of_another_run(true);
        assert!(wordings.len() > 3, "{wordings:?}");
        assert!(wordings.iter().all(|words| words.starts_with(from)), "{wordings:?}");
        assert!(wordings[0].ends_with("stable, out of phase by 25 % after 20 s"), "{wordings:?}");
    }
}

#[test]
fn a_verdict_says_the_number_that_its_outcome_is_about() {
    let is = |verdict: Verdict, shown: &str| assert_eq!(verdict.to_string(), shown);
    is(
        compared(Comparison { error: 3e-12, ..COMPARED }),
        "within rounding: error below 10⁻¹¹ in 20 s",
    );
    is(compared(Comparison { error: 0.004, ..COMPARED }), "accurate: error 0.40 % in 20 s");

    let phase = Comparison { energy_change: Some(0.0), ..COMPARED };
    is(compared(phase), "stable, out of phase by 25 % after 20 s");
    let unknown = LongTerm { is_bounded: None, ..SWINGS };
    is(Verdict { long_term: unknown, ..compared(phase) }, "out of phase by 25 % after 20 s");
    is(compared(COMPARED), "stable, off by 25 % at 3 s, by 20 % after 20 s");
    is(compared(Comparison { last_error: 0.25, ..COMPARED }), "stable, off by 25 % after 20 s");
    is(
        compared(Comparison { last_error: TOLERANCE, ..COMPARED }),
        "stable, off by 25 % at 3 s, settled by 20 s",
    );
    is(
        compared(Comparison { error: 2.81, last_error: 2.7, ..phase }),
        "stable, off by 281 % after 20 s",
    );
    let fast = Comparison { error: 2.17, frequency_error: Some(0.05), ..phase };
    is(of_two(compared(fast)), "stable, 5.0 % fast: off by up to 217 % in 20 s (buoy)");
    let slow = Comparison { frequency_error: Some(-0.02), ..phase };
    is(compared(slow), "stable, out of phase by 25 % after 20 s (2.0 % slow)");
    is(of_two(compared(slow)), "stable, out of phase by 25 % after 20 s (2.0 % slow, buoy)");
    let doubling = LongTerm { doubles_in_s: Some(90.0), ..SWINGS };
    is(
        Verdict {
            long_term: LongTerm { parasite_doubles_in_s: Some(7.0), ..doubling },
            ..compared(phase)
        },
        "stable, out of phase by 25 % after 20 s; grows slowly: swing ×2 in 90 s; a faint mode grows: ×2 in 7 s",
    );

    let gains = Comparison { frequency_error: Some(0.02), change: Trend::Grows, ..COMPARED };
    let of_energy = Comparison { energy_change: Some(0.5), ..gains };
    is(compared(gains), "grows: off by 25 % in 20 s");
    is(compared(of_energy), "gains energy: +50 % in 20 s");
    is(
        Verdict { long_term: LongTerm { swings: false, ..doubling }, ..compared(of_energy) },
        "gains energy: deviation ×2 in 90 s",
    );
    let loses = Comparison { energy_change: Some(-0.5), change: Trend::Dies, ..COMPARED };
    is(compared(loses), "loses energy: −50 % in 20 s");
    let all = Comparison { energy_change: Some(-0.998), ..loses };
    is(compared(all), "loses energy: all of it in 20 s");
    let long_term = LongTerm { halves_in_s: Some(5.0), ..SWINGS };
    is(Verdict { long_term, ..compared(loses) }, "loses energy: swing ½ in 5 s");

    let escaped = StepFailure::NotFinite { coordinate: "x".into(), value: f64::NAN };
    let unsolved = StepFailure::LinearSolveFailed;
    let long_term = LongTerm { parasite_doubles_in_s: Some(7.0), ..doubling };
    is(Verdict { long_term, ..of(failed(&escaped)) }, "will blow up at 4 s");
    is(Verdict { long_term, ..of(failed(&unsolved)) }, &format!("will give up at 4 s: {unsolved}"));

    let without = |why| of(Finding::NoTruth(why));
    is(
        without(NoTruth::Vague(0.05)),
        "no truth: the true motion is known to 5.0 % of the amplitude only",
    );
    is(
        without(NoTruth::Vague(f64::INFINITY)),
        "no truth: the true motion is not known precisely enough",
    );
    is(
        without(NoTruth::Failed(escaped.clone())),
        &format!("no truth: the true motion is not known: it {escaped}"),
    );
    for (why, shown) in [
        (NotJudged::TooMuchWork, "not judged: too much work"),
        (NotJudged::ShorterThanATick, "not judged: the scene is shorter than a tick"),
    ] {
        is(of(Finding::NotJudged(why)), shown);
    }
}

#[test]
fn only_the_two_best_words_are_accurate_and_four_are_bad() {
    for word in Outcome::ALL {
        let is_fine = matches!(word, Outcome::Rounding | Outcome::Accurate);
        assert_eq!(word.severity() == Severity::Fine, is_fine, "{}", word.id());
        // A verdict tells what will be, and an id what was found.
        let said = word.text().replace("will give", "gave").replace("will blow", "blew");
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
