//! The numbers on the question pages. The reader's browser computes them.

use regatta::loops::{LoopRun, RefreshRate, policy, trace_card};
use regatta::measure::{Adviser, Criterion, Judge};
use regatta::run::Session;
use regatta::scene::{LaneSpec, SCENES, Scene};
use regatta::sim::integrators::method;
use regatta::sim::number::significant;
use regatta::studio::Studio;
use regatta::tools::port::{Approach, Setup, Wish, port, setups};
use wasm_bindgen::prelude::wasm_bindgen;

/// Computes a number, with as many digits as the text of the page has.
type Number = fn() -> Option<String>;

/// The function for the number of each claim in `assets/web/questions/pages.toml`, in the order of that file.
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
        let seen = setup.visible_motion(setup.mode.joint([1.5, 0.1], 1.0))?;
        Some(significant(seen.damping_ratio()?, 4))
    }),
    ("box2d-told", || {
        let told = port(&wish(1.5, 0.1), engine("engine-box2d")?)?;
        Some(significant(told.values[1], 6))
    }),
    ("held-force-sees", || {
        let setup = Setup { substeps: 8, ..engine("held-force")? };
        Some(significant(setup.visible_motion(wish(1.0, 0.0).joint())?.damping_ratio()?, 3))
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

/// Computes the number of a claim on a question page. Returns `None` if the claim is unknown.
#[wasm_bindgen]
pub fn number(claim: &str) -> Option<String> {
    NUMBERS.iter().find(|(id, _)| *id == claim)?.1()
}

/// Source text of the question pages.
const PAGES: &str = include_str!("../../assets/web/questions/pages.toml");

/// Returns the key and the value of each line in the source of the pages.
fn lines() -> impl Iterator<Item = (&'static str, &'static str)> {
    let pairs = PAGES.lines().filter_map(|line| line.split_once(" = "));
    pairs.map(|(key, value)| (key, value.trim_matches('"')))
}

/// Returns the address of the page that explains a stage. A page with the same method in the same scene is preferred.
/// The next choice is a page with the same scene, and the last one the list of all pages.
pub(crate) fn page_of(studio: &Studio) -> String {
    let title = &studio.scene().title;
    // The scene of a run from a link is recognised by its title.
    let is_it = |name: &&str| Scene::built_in(name).is_some_and(|known| known.title == *title);
    let scene = SCENES.iter().map(|scene| scene.name).find(is_it).unwrap_or_default();
    let method = studio.entries()[studio.active()].method.id;
    let (mut name, mut found) = ("", (0, ""));
    for (key, value) in lines() {
        let rank = match key {
            "name" => {
                name = value;
                continue;
            }
            "stages" => u32::from(value.split(' ').any(|stage| stage == scene)),
            "shows" => rank(value, studio.loop_lab().is_some(), scene, method),
            _ => continue,
        };
        if rank > found.0 {
            found = (rank, name);
        }
    }
    match found {
        (0, _) => "questions/".into(),
        (_, name) => format!("questions/{name}.html"),
    }
}

/// Ranks a page with these settings by how much of a stage it shows: 0 for nothing, 1 for the scene, 2 for the scene
/// and the method, 3 for the loop lab.
fn rank(shows: &str, is_in_loop_lab: bool, scene: &str, method: &str) -> u32 {
    let has = |key, wanted| shows.split('&').any(|it| it.split_once('=') == Some((key, wanted)));
    match shows.contains("loop=") {
        true => 3 * u32::from(is_in_loop_lab),
        false if !has("scene", scene) => 0,
        false => 1 + u32::from(has("method", method)),
    }
}

fn spring() -> Scene {
    Scene::built_in("spring").expect("a built-in scene")
}

fn lane(id: &str) -> Option<LaneSpec> {
    method(id).map(LaneSpec::plain)
}

/// Returns the lowest rate in Hz at which the spring meets a criterion with one step per tick.
fn slowest_hz(method: &str, criterion: Criterion) -> Option<String> {
    let adviser = Adviser::new(&spring(), spring().tick_hz);
    adviser.slowest(lane(method)?, criterion).map(|hz| hz.to_string())
}

/// Returns the setup of the first mode of an engine's spring, at 60 Hz.
fn engine(id: &str) -> Option<Setup> {
    setups(Some(&[method(id)?]), 60.0, None).into_iter().next()
}

/// Returns the lowest damping ratio that an engine can show at 1 Hz.
fn least_damping_ratio(id: &str) -> Option<String> {
    Some(significant(port(&wish(1.0, 0.0), engine(id)?)?.floor?, 3))
}

fn wish(frequency_hz: f64, damping_ratio: f64) -> Wish {
    Wish { frequency_hz, damping_ratio, mass_kg: 1.0 }
}

/// Returns by how much a jump under semi-implicit Euler is lower than the exact one after half a second, in percent.
fn percent_lower(tick_hz: u32) -> Option<f64> {
    let mut jump = Scene::built_in("jump")?;
    (jump.tick_hz, jump.lanes) = (tick_hz.into(), vec![lane("semi-implicit-euler")?]);
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
    use regatta::scene::Action;
    use regatta::studio::RunCommand;

    #[test]
    fn a_page_computes_the_numbers_of_its_section() {
        let manual = chapter("questions").unwrap().text.replace('\n', " ");
        let sections: Vec<&str> = manual.split(" ## ").collect();
        let (mut section, mut claims) = ("", Vec::new());
        for (key, value) in lines() {
            match key {
                "section" => {
                    let is_it = |text: &&&str| text.starts_with(&format!("{value} "));
                    section = sections.iter().find(is_it).expect(value);
                }
                "id" => claims.push(value),
                "says" => {
                    let said = value.replace("{}", &number(claims[claims.len() - 1]).expect(value));
                    assert!(section.contains(&said), "the manual does not say: {said}");
                }
                _ => {}
            }
        }
        let known: Vec<&str> = NUMBERS.iter().map(|(id, _)| *id).collect();
        assert_eq!(claims, known);
    }

    #[test]
    fn every_stage_links_to_its_page_and_every_page_is_linked() {
        let page = |address: &str| {
            page_of(&crate::address::Address::of(address).unwrap().studio().unwrap())
        };
        let named = |name: &str| format!("questions/{name}.html");
        for (address, name) in [
            ("", "why-euler-explodes"),
            ("#scene=spring", "why-euler-explodes"),
            ("#scene=spring&method=rk4", "which-tick-rate"),
            ("#scene=spring&method=engine-box2d", "dies-without-damping"),
            ("#scene=alike", "same-spring-elsewhere"),
            ("#scene=held-force", "gains-with-substeps"),
            ("#scene=lerp", "camera-at-30-fps"),
            ("#scene=spring&loop=edge", "jitter-at-144-hz"),
            ("#scene=jump", "jump-at-144-fps"),
        ] {
            assert_eq!(page(address), named(name), "{address}");
        }
        assert_eq!(page("#scene=quarter-car"), "questions/");
        let mut jump = crate::address::Address::of("#scene=jump").unwrap().studio().unwrap();
        jump.apply(RunCommand::Act(Action::Kick(1.0)));
        let link = jump.deck.link().unwrap();
        assert!(link.starts_with("#v1."), "{link}");
        let run = crate::address::Address::of(&link).unwrap().run.unwrap();
        assert_eq!(page_of(&Studio::new(run)), named("jump-at-144-fps"));
        for (_, scenes) in lines().filter(|(key, _)| *key == "stages") {
            assert!(scenes.split(' ').all(|scene| Scene::built_in(scene).is_some()), "{scenes}");
        }
        let shown = lines().filter(|(key, _)| *key == "shows").map(|(_, shown)| shown);
        shown.for_each(|shown| assert_ne!(page(&format!("#{shown}")), "questions/", "{shown}"));
    }
}
