//! The numbers of the pages of questions, computed where they are read.

use regatta::loops::{LoopRun, RefreshRate, policy, trace_card};
use regatta::measure::{Adviser, Criterion, Judge};
use regatta::run::Session;
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::integrators::method;
use regatta::sim::number::significant;
use regatta::tools::port::{Approach, Setup, Wish, port, setups};
use wasm_bindgen::prelude::wasm_bindgen;

/// Computes a number, with as many digits as the text has.
type Number = fn() -> Option<String>;

/// The number of each claim in `assets/web/questions/pages.toml`, in its order.
const NUMBERS: &[(&str, Number)] = &[
    ("euler-doubles", || {
        let verdict = Judge::new(&spring()).verdict(lane("explicit-euler")?, 60);
        Some(significant(verdict.long_term.doubles_in_s?, 2))
    }),
    ("semi-implicit-early", || {
        let verdict = Judge::new(&spring()).verdict(lane("semi-implicit-euler")?, 60);
        Some(significant(1e3 * verdict.comparison()?.early_s?, 2))
    }),
    ("bounded-down-to", || slowest_hz("semi-implicit-euler", Criterion::Bounded)),
    ("looks-right-down-to", || slowest_hz("semi-implicit-euler", Criterion::LooksRight)),
    ("rk4-accurate-down-to", || slowest_hz("rk4", Criterion::Accurate)),
    ("box2d-floor", || least_damping_ratio("engine-box2d")),
    ("jolt-floor", || least_damping_ratio("engine-jolt")),
    ("box2d-sees", || {
        let setup = engine("engine-box2d")?;
        let seen = setup.sees(setup.mode.joint([1.5, 0.1], 1.0))?;
        Some(significant(seen.damping_ratio()?, 4))
    }),
    ("box2d-told", || {
        let told = port(&wish(1.5, 0.1), engine("engine-box2d")?)?;
        Some(significant(told.values[1], 6))
    }),
    ("held-force-sees", || {
        let setup = Setup { substeps: 8, ..engine("held-force")? };
        Some(significant(setup.sees(wish(1.0, 0.0).joint())?.damping_ratio()?, 3))
    }),
    ("lerp-at-30", || Some(significant(Approach::of_lerp(0.1, 30.0).half_life_s, 4))),
    ("lerp-at-60", || Some(significant(Approach::of_lerp(0.1, 60.0).half_life_s, 4))),
    ("repeated-at-144", || {
        let trace = trace_card("steady-144")?.trace(RefreshRate::new(60, 1));
        let run = LoopRun::new(&spring(), lane("rk4")?, policy("fixed")?, &trace);
        let report = run.measure(20_000_000_000, &|| false, |_, _| {});
        Some(significant(report.repeated_percent?, 3))
    }),
    ("jump-at-30", || Some(significant(percent_lower(30)?, 1))),
    ("jump-at-144", || Some(significant(percent_lower(144)?, 1))),
];

/// The number of a claim on a page of questions.
#[wasm_bindgen]
pub fn number(claim: &str) -> Option<String> {
    NUMBERS.iter().find(|(id, _)| *id == claim)?.1()
}

fn spring() -> Scene {
    Scene::built_in("spring").expect("a built-in scene")
}

fn lane(id: &str) -> Option<LaneSpec> {
    method(id).map(LaneSpec::plain)
}

/// The slowest rate at which the spring meets a criterion in one step a tick.
fn slowest_hz(method: &str, criterion: Criterion) -> Option<String> {
    let adviser = Adviser::new(&spring(), spring().tick_hz);
    adviser.slowest(lane(method)?, criterion).map(|hz| hz.to_string())
}

/// The spring of an engine as its first mode tells it.
fn engine(id: &str) -> Option<Setup> {
    setups(Some(&[method(id)?]), 60.0, None).into_iter().next()
}

/// The least damping ratio that an engine shows at 1 Hz.
fn least_damping_ratio(id: &str) -> Option<String> {
    Some(significant(port(&wish(1.0, 0.0), engine(id)?)?.floor?, 3))
}

fn wish(frequency_hz: f64, damping_ratio: f64) -> Wish {
    Wish { frequency_hz, damping_ratio, mass_kg: 1.0 }
}

/// By how much of the exact height a jump is lower under semi-implicit Euler at half a second, in percent.
fn percent_lower(tick_hz: u32) -> Option<f64> {
    let jump = Scene { tick_hz, ..Scene::built_in("jump")? };
    let jump = Scene { lanes: vec![lane("semi-implicit-euler")?], ..jump };
    let mut session = Session::racing(jump.into());
    session.run(u64::from(tick_hz / 2));
    let race = session.race();
    let height = |lane: &regatta::run::Lane| lane.bodies()[0].stepper.q()[0];
    Some(100.0 * (1.0 - height(&race.entrants()[0].lane) / height(race.truth())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use regatta::manual::chapter;

    #[test]
    fn a_page_computes_the_numbers_that_its_section_has() {
        let pages = include_str!("../../assets/web/questions/pages.toml");
        let manual = chapter("questions").unwrap().text.replace('\n', " ");
        let sections: Vec<&str> = manual.split(" ## ").collect();
        let (mut section, mut claims) = ("", Vec::new());
        for line in pages.lines() {
            let (key, value) = line.split_once(" = ").unwrap_or_default();
            let value = value.trim_matches('"');
            match key {
                "section" => {
                    let is_it = |text: &&&str| text.starts_with(&format!("{value} "));
                    section = sections.iter().find(is_it).expect(value);
                }
                "id" => claims.push(value),
                "says" => {
                    let said = value.replace("{}", &number(claims[claims.len() - 1]).expect(line));
                    assert!(section.contains(&said), "the manual does not say: {said}");
                }
                _ => {}
            }
        }
        let known: Vec<&str> = NUMBERS.iter().map(|(id, _)| *id).collect();
        assert_eq!(claims, known);
    }
}
