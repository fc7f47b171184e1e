//! What verdicts say, word by word.

use regatta::lab::{KEYS, NoTruth, NotJudged, Outcome, RunFailure, Severity, TOLERANCE, Verdict};
use regatta::manual::chapter;
use regatta::sim::integrators::StepFailure;

/// A verdict with nothing in it but this word.
fn plain(word: Outcome) -> Verdict {
    Verdict {
        outcome: word,
        body: 0,
        body_name: None,
        error: 0.25,
        error_at_s: 3.0,
        last_error: 0.2,
        swings: true,
        doubles_in_s: None,
        halves_in_s: None,
        parasite_doubles_in_s: None,
        energy_change: None,
        frequency_error: None,
        is_bounded: Some(true),
        energy_drift: None,
        chase: None,
        failure: None,
        by_energy: None,
        no_truth: None,
        not_judged: None,
        evaluations: 1,
        seconds: 20.0,
        horizon_s: 20.0,
        starts_at_s: 0.0,
        of_bodies: Vec::new(),
    }
}

#[test]
fn a_verdict_says_the_number_that_its_word_is_about() {
    let is = |verdict: Verdict, shown: &str| assert_eq!(verdict.to_string(), shown);
    is(
        Verdict { error: 3e-12, ..plain(Outcome::Rounding) },
        "within rounding: error below 10⁻¹¹ in 20 s",
    );
    is(Verdict { error: 0.004, ..plain(Outcome::Accurate) }, "accurate: error 0.40 % in 20 s");

    let phase = Verdict { energy_change: Some(0.0), ..plain(Outcome::OutOfPhase) };
    is(phase.clone(), "stable, out of phase by 25 % after 20 s");
    is(Verdict { is_bounded: None, ..phase.clone() }, "out of phase by 25 % after 20 s");
    let off = Verdict { energy_change: None, ..phase.clone() };
    is(off.clone(), "stable, off by 25 % at 3 s, by 20 % after 20 s");
    is(Verdict { last_error: 0.25, ..off.clone() }, "stable, off by 25 % after 20 s");
    is(Verdict { last_error: TOLERANCE, ..off }, "stable, off by 25 % at 3 s, settled by 20 s");
    is(
        Verdict { error: 2.81, last_error: 2.7, ..phase.clone() },
        "stable, off by 281 % after 20 s",
    );
    let fast = Verdict { error: 2.17, frequency_error: Some(0.05), ..phase.clone() };
    is(
        Verdict { body_name: Some("buoy".into()), ..fast },
        "stable, 5.0 % fast: off by up to 217 % in 20 s (buoy)",
    );
    let slow = Verdict { frequency_error: Some(-0.02), ..phase.clone() };
    is(slow.clone(), "stable, out of phase by 25 % after 20 s (2.0 % slow)");
    is(
        Verdict { body_name: Some("buoy".into()), ..slow },
        "stable, out of phase by 25 % after 20 s (2.0 % slow, buoy)",
    );
    is(
        Verdict { doubles_in_s: Some(90.0), parasite_doubles_in_s: Some(7.0), ..phase },
        "stable, out of phase by 25 % after 20 s; grows slowly: swing ×2 in 90 s; a faint mode grows: ×2 in 7 s",
    );

    let gains = Verdict { frequency_error: Some(0.02), ..plain(Outcome::GainsEnergy) };
    let of_energy = Verdict { energy_change: Some(0.5), ..gains.clone() };
    is(gains, "grows: off by 25 % in 20 s");
    is(of_energy.clone(), "gains energy: +50 % in 20 s");
    is(
        Verdict { doubles_in_s: Some(90.0), swings: false, ..of_energy },
        "gains energy: deviation ×2 in 90 s",
    );
    let loses = Verdict { energy_change: Some(-0.5), ..plain(Outcome::LosesEnergy) };
    is(loses.clone(), "loses energy: −50 % in 20 s");
    is(Verdict { energy_change: Some(-0.998), ..loses.clone() }, "loses energy: all of it in 20 s");
    is(Verdict { halves_in_s: Some(5.0), ..loses }, "loses energy: swing ½ in 5 s");

    let failure = StepFailure::NotFinite { coordinate: "x".into(), value: f64::NAN };
    let ended = Verdict {
        failure: Some(RunFailure { t: 4.0, cause: failure.clone() }),
        parasite_doubles_in_s: Some(7.0),
        doubles_in_s: Some(1.0),
        ..plain(Outcome::BlewUp)
    };
    is(ended.clone(), "will blow up at 4 s");
    is(Verdict { outcome: Outcome::GaveUp, ..ended }, &format!("will give up at 4 s: {failure}"));

    let without = |why| Verdict { no_truth: Some(why), ..plain(Outcome::NoTruth) };
    is(
        without(NoTruth::Vague(0.05)),
        "no truth: the true motion is known to 5.0 % of the amplitude only",
    );
    is(
        without(NoTruth::Vague(f64::INFINITY)),
        "no truth: the true motion is not known precisely enough",
    );
    is(
        without(NoTruth::Failed(failure.clone())),
        &format!("no truth: the true motion is not known: it {failure}"),
    );
    for (why, shown) in [
        (NotJudged::TooMuchWork, "not judged: too much work"),
        (NotJudged::ShorterThanATick, "not judged: the scene is shorter than a tick"),
    ] {
        is(Verdict { not_judged: Some(why), ..plain(Outcome::NotJudged) }, shown);
    }
}

#[test]
fn only_the_two_best_words_are_accurate_and_four_are_bad() {
    for word in Outcome::ALL {
        let is_fine = matches!(word, Outcome::Rounding | Outcome::Accurate);
        assert_eq!(plain(word).is_accurate(), is_fine, "{}", word.id());
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
