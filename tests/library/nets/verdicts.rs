//! Verdicts on a net without a reference solution.

use regatta::measure::{Adviser, Criterion, CriterionResult, Judge, Outcome, Severity, Verdict};
use regatta::run::Race;
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::integrators::{StepFailure, method};
use regatta::sim::number::round;

use crate::scenes::edited;

fn scene(stiffness: f64, more: &str) -> Scene {
    let text = format!(
        "title = 't'\ntick_hz = 60\nseconds = 4\nmethods = ['rk4', 'implicit-euler']\n\
         [[net]]\ncolumns = 10\nrows = 8\nspacing_m = 0.1\nshear = true\npin = 'corners'\n\
         mass_kg = 0.02\nstiffness_n_per_m = {stiffness}\n{more}"
    );
    Scene::parse("t", &text).unwrap()
}

fn verdict(scene: &Scene, id: &str) -> Verdict {
    Judge::new(scene).verdict(LaneSpec::plain(method(id).unwrap()), 60)
}

#[test]
fn a_net_without_a_reference_is_judged_by_energy_and_spectral_radius() {
    let scene = scene(1000.0, "");
    for (id, outcome, radius) in [
        ("explicit-euler", Outcome::BlewUp, 5.0..15.0),
        ("semi-implicit-euler", Outcome::BlewUp, 50.0..200.0),
        ("implicit-euler", Outcome::DiesAway, 0.8..1.005),
        ("implicit-midpoint", Outcome::NoTruth, 0.99..1.01),
    ] {
        let verdict = verdict(&scene, id);
        let said = verdict.to_string();
        assert_eq!(verdict.outcome(), outcome, "{id}: {said}");
        let found = verdict.by_energy().expect("no truth tells");
        let found_radius = found.spectral_radius.unwrap_or_else(|| panic!("{id} has one"));
        assert!(radius.contains(&found_radius), "{id}: {found_radius}");
        assert!(said.ends_with(" (no reference)"), "{id}: {said}");
        let by = format!("no reference: by energy and spectral radius {}", round(found_radius, 4));
        assert!(verdict.details().contains(&by), "{id}: {:?}", verdict.details());
        assert!(found.is_conserved, "{id}");
        let is_known = outcome != Outcome::NoTruth;
        assert_eq!(verdict.outcome().severity() == Severity::Bad, is_known, "{id}");
    }
    let kept = verdict(&scene, "implicit-midpoint").to_string();
    assert!(kept.starts_with("keeps energy · within "), "{kept}");
    // An implicit method with memory: its map is not one of the state alone.
    let alone = verdict(&scene, "bdf2");
    assert_eq!(alone.by_energy().unwrap().spectral_radius, None);
    assert!(alone.to_string().ends_with(" (no reference)"), "{alone}");
    assert_eq!(alone.details().last().unwrap(), "no reference: by energy alone");
}

#[test]
fn velocity_verlet_on_a_damped_net_has_no_stable_radius() {
    let scene = |tick_hz: u32| {
        let net = scene(1000.0, "damping_n_s_per_m = 0.635");
        Scene::parse("t", &net.to_toml().replace("tick_hz = 60", &format!("tick_hz = {tick_hz}")))
            .unwrap()
    };
    let velocity_verlet = LaneSpec::plain(method("velocity-verlet").unwrap());
    let radius = |tick_hz: u32| {
        let verdict = Judge::new(&scene(tick_hz)).verdict(velocity_verlet, tick_hz);
        let found = verdict.by_energy().expect("no truth tells").spectral_radius;
        (verdict.outcome(), found.expect("it is explicit"))
    };
    let (outcome, found) = radius(360);
    assert_eq!(outcome, Outcome::BlewUp);
    assert!(found > 1.02, "{found}");
    let (outcome, found) = radius(500);
    assert_ne!(outcome, Outcome::BlewUp);
    assert!((0.99..1.001).contains(&found), "{found}");
}

#[test]
fn the_drift_of_a_conserved_energy_needs_no_reference() {
    let elastic = scene(1000.0, "");
    let drift = |scene: &Scene, id: &str| verdict(scene, id).energy_drift_percent();
    let lost = drift(&elastic, "implicit-euler").expect("it conserves its energy");
    assert!((-101.0..-50.0).contains(&lost), "{lost} %");
    let kept = drift(&elastic, "implicit-midpoint").expect("it conserves its energy");
    assert!(kept != 0.0 && kept.abs() < 5.0, "{kept} %");
    assert_eq!(drift(&elastic, "explicit-euler"), None, "it blew up");
    assert_eq!(drift(&scene(1000.0, "damping_n_s_per_m = 0.1\n"), "implicit-midpoint"), None);
}

#[test]
fn a_damped_net_may_lose_energy_and_a_kick_may_bring_it() {
    let scripted = "damping_n_s_per_m = 0.1\n[[command]]\nat_s = 1\nkick = 0.3\n";
    let scene = scene(1000.0, scripted);
    for id in ["implicit-midpoint", "implicit-euler"] {
        let verdict = verdict(&scene, id);
        assert_eq!(verdict.outcome(), Outcome::NoTruth, "{verdict}");
        assert_eq!(verdict.to_string(), "gains no energy (no reference)");
        let found = verdict.by_energy().unwrap();
        assert!(!found.is_conserved && found.change < -0.01, "{found:?}");
    }
    assert_eq!(verdict(&scene, "rk4").outcome(), Outcome::BlewUp);
}

#[test]
fn methods_on_a_soft_net_are_compared_with_a_reference() {
    let scene = scene(10.0, "");
    let verdict = verdict(&scene, "velocity-verlet");
    assert!(verdict.by_energy().is_none(), "{verdict}");
    assert!(verdict.error().is_some_and(|error| error > 0.0), "{verdict}");
}

#[test]
fn a_race_runs_without_a_truth() {
    let scene = scene(1000.0, "");
    let mut race = Race::of_scene(&scene);
    race.run(30);
    let truth = race.truth().halted().expect("it has none");
    assert!(matches!(truth.failure, StepFailure::ReferenceTooExpensive { .. }) && truth.tick == 0);
    assert_eq!(race.truth().bodies()[0].truth_in_words(), "no reference");
    let implicit = &race.entrants()[1].lane;
    assert!(implicit.halted().is_none());
    let fallen = implicit.bodies()[0].stepper.q()[1] + 0.7;
    assert!(fallen < -0.01, "{fallen} m");
}

#[test]
fn advice_without_a_truth_covers_stability_only() {
    let scene = edited(&scene(1000.0, ""), |scene| scene.seconds = 1.0);
    let adviser = Adviser::new(&scene, 60);
    let plain = |id: &str| LaneSpec::plain(method(id).unwrap());
    for id in ["semi-implicit-euler", "implicit-euler"] {
        for criterion in [Criterion::Accurate, Criterion::LooksRight] {
            assert_eq!(adviser.meets(plain(id), criterion), CriterionResult::Unknown, "{id}");
        }
    }
    let substeps = |id: &str| {
        let result = adviser.meets(plain(id), Criterion::Bounded);
        result.met().unwrap_or_else(|| panic!("{id}: {result:?}")).substeps
    };
    assert_eq!(substeps("implicit-euler"), 1);
    // The fastest springs turn by h ω = 10.5 in a tick, and the method bears 2.
    assert!((5..=6).contains(&substeps("semi-implicit-euler")));
}
