//! The table of lanes: its rows, their order, and their texts.

use super::*;
use crate::panels::table::{Order, SortKey};
use crate::scene::Scene;
use crate::studio::{RunCommand, StageCommand};
use crate::tests::testing::TestWindow;

fn race() -> Studio {
    judged_race(Scene::built_in("harbour").unwrap())
}

fn judged_race(scene: Scene) -> Studio {
    let mut studio = Studio::new(scene);
    studio.apply(StageCommand::ToggleRace);
    (0..60).for_each(|_| studio.tick());
    studio.analyse();
    studio
}

fn sorted(studio: &Studio, order: Order) -> Vec<Row<'_>> {
    table(studio).sorted(groups(studio), order).into_iter().flatten().collect()
}

fn entries(studio: &Studio, order: Order) -> Vec<usize> {
    sorted(studio, order).iter().map(|row| row.entry).collect()
}

#[test]
fn unsorted_rows_follow_the_order_of_the_keys() {
    let studio = race();
    assert!(entries(&studio, None).into_iter().eq(0..studio.entries().len()));
}

#[test]
fn every_column_sorts_both_ways_with_missing_values_last() {
    let studio = race();
    let all: Vec<usize> = (0..studio.entries().len()).collect();
    for column in &table(&studio).columns {
        for is_reversed in [false, true] {
            let rows = sorted(&studio, Some((column.name, is_reversed)));
            let mut found: Vec<usize> = rows.iter().map(|row| row.entry).collect();
            found.sort_unstable();
            assert_eq!(found, all, "{}", column.name);
            let ranks: Vec<SortKey> = rows.iter().map(&column.sort_key).collect();
            let nothing = ranks.iter().position(|rank| *rank == SortKey::Nothing);
            let (ranked, rest) = ranks.split_at(nothing.unwrap_or(ranks.len()));
            assert!(rest.iter().all(|rank| *rank == SortKey::Nothing), "{}", column.name);
            let is_in_order = |pair: &[SortKey]| match is_reversed {
                true => pair[0] >= pair[1],
                false => pair[0] <= pair[1],
            };
            assert!(ranked.windows(2).all(is_in_order), "{}: {ranked:?}", column.name);
        }
    }
    let by_error = entries(&studio, Some(("error", false)));
    assert_ne!(by_error, entries(&studio, None), "some lane is worse than the next");
}

#[test]
fn in_solo_the_bodies_of_the_lane_stay_together_under_every_order() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.apply(StageCommand::Pick(1));
    studio.tick();
    let bodies = studio.scene().bodies.len();
    for column in &table(&studio).columns {
        let rows = sorted(&studio, Some((column.name, true)));
        let first = rows.iter().position(|row| row.is_of_body).expect("the flown lane");
        let of_lane = rows[first..first + bodies].iter();
        assert!(of_lane.map(|row| row.body).eq(0..bodies), "{}", column.name);
    }
}

fn verdict_texts(studio: &Studio) -> Vec<String> {
    sorted(studio, None).iter().map(|row| row.verdict_text().whole().to_owned()).collect()
}

#[test]
fn the_tooltip_of_an_engine_names_its_tested_version() {
    let mut studio = Studio::new(Scene::built_in("engines").unwrap());
    studio.apply(StageCommand::ToggleRace);
    let mut versions = 0;
    for row in sorted(&studio, None) {
        let ((), shown) = TestWindow::new([800.0, 600.0]).show(Vec::new(), |ui| row.tooltip(ui));
        let words = shown.words().join("\n");
        let version = row.spec.method.engine.map_or("", |engine| engine.version);
        let is_told = words.contains(" version ");
        assert!(is_told != version.is_empty() && words.contains(version), "{words}");
        versions += usize::from(is_told);
    }
    assert!((9..40).contains(&versions), "{versions}");
}

#[test]
fn the_tooltip_of_a_method_says_nothing_twice() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..120).for_each(|_| studio.tick());
    studio.apply(StageCommand::Pick(1));
    studio.apply(StageCommand::Pick(0));
    studio.analyse();
    let mut told = 0;
    for row in sorted(&studio, None) {
        let whole = row.verdict_text().whole().to_owned();
        let ((), shown) = TestWindow::new([800.0, 600.0]).show(Vec::new(), |ui| row.tooltip(ui));
        let words = shown.words();
        let Some((already, _)) =
            whole.split_once(" · ").filter(|(it, _)| it.contains(" too wide at "))
        else {
            continue;
        };
        assert_eq!(words.iter().filter(|it| it.contains(already)).count(), 1, "{words:?}");
        told += 1;
    }
    assert!(told > 0, "a method that grows begins off the truth here");
}

#[test]
fn an_unjudged_method_is_marked_as_being_judged() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    assert!(
        verdict_texts(&studio).iter().all(|said| said == "judging…"),
        "{:?}",
        verdict_texts(&studio)
    );
    studio.analyse();
    assert!(
        verdict_texts(&studio).iter().all(|said| said != "judging…"),
        "{:?}",
        verdict_texts(&studio)
    );
}

#[test]
fn a_verdict_predicts_a_blow_up_and_a_halt_reports_it() {
    let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
    studio.apply(StageCommand::ToggleRace);
    studio.apply(StageCommand::TickHz(49.into()));
    studio.analyse();
    let euler = studio.entries().iter().position(|spec| spec.method.id == "semi-implicit-euler");
    let euler = euler.unwrap();
    assert_eq!(verdict_texts(&studio)[euler], "blows up · at 4.14 s");
    let details = sorted(&studio, None)[euler].details();
    assert!(details[0].contains(" reached "), "{details:?}");
    while !studio
        .race()
        .entrants()
        .iter()
        .any(|lane| studio.entry(lane) == euler && lane.lane.halted().is_some())
    {
        studio.tick();
    }
    assert!(
        verdict_texts(&studio)[euler].contains(" blew up at 4.1"),
        "{:?}",
        verdict_texts(&studio)
    );
}

#[test]
fn the_common_body_of_all_verdicts_is_named_once() {
    let mut studio = judged_race(Scene::with_two_springs());
    let flown: Vec<usize> =
        studio.race().entrants().iter().map(|lane| studio.entry(lane)).collect();
    let names = |studio: &Studio| {
        let said = verdict_texts(studio);
        flown.iter().filter(|&&entry| said[entry].contains("(spring)")).count()
    };
    assert_eq!(
        row::judged_body(&studio).map(|body| &*studio.scene().bodies[body].name),
        Some("spring")
    );
    assert_eq!(names(&studio), 0, "{:?}", verdict_texts(&studio));
    // Some lanes have another stiffest body at a low rate.
    studio.apply(StageCommand::TickHz(2.into()));
    studio.analyse();
    assert_eq!(row::judged_body(&studio), None, "{:?}", verdict_texts(&studio));
    assert!(names(&studio) > 0, "{:?}", verdict_texts(&studio));
}

#[test]
fn the_cost_column_follows_the_present_substeps() {
    let mut studio = race();
    let costs = |studio: &Studio| -> Vec<Option<f64>> {
        let flown = studio.race().entrants().iter().map(|lane| studio.entry(lane));
        let exact = vec![None; studio.scene().bodies.len()];
        let rows = |entry: usize| {
            Row::of_method(
                studio,
                (entry, &studio.entries()[entry]),
                &exact,
                row::judged_body(studio),
            )
        };
        flown.map(|entry| rows(entry)[0].cost()).collect()
    };
    let before = costs(&studio);
    assert_eq!(before[..4], [1.0, 1.0, 2.0, 4.0].map(Some), "{before:?}");
    studio.apply(RunCommand::ToggleEqualCost);
    for _ in 0..3 {
        let now = costs(&studio);
        let dearest = now.iter().flatten().fold(0.0, |most: f64, &cost| most.max(cost));
        assert!(now[..4].iter().all(|cost| *cost > Some(0.75 * dearest)), "{now:?}");
        studio.tick();
    }
}

#[test]
fn a_screen_reader_reads_the_numbers_of_a_row() {
    let mut window = TestWindow::new([1600.0, 600.0]);
    window.context.enable_accesskit();
    let studio = race();
    let (_, shown) = window.show(Vec::new(), |ui| show(ui, &studio, &mut Vec::new()));
    let row =
        shown.heard.iter().find(|name| name.starts_with("4 Runge-Kutta 4, ")).expect("its row");
    for head in ["error ", "energy ", "cost 4 ×"] {
        assert!(row.contains(&format!(", {head}")), "{row}");
    }
}

#[test]
fn the_table_shows_the_largest_error_so_far_even_after_a_throw_and_a_seek() {
    let mut studio = Studio::new(Scene { seconds: 200.0, ..Scene::built_in("spring").unwrap() });
    studio.apply(StageCommand::Pick(2));
    let error = |studio: &Studio| groups(studio)[0][0].largest_error().expect("there is a truth");
    let now = |studio: &Studio| {
        let lanes = [&studio.race().entrants()[0].lane, studio.race().truth()];
        let [q, exact] = lanes.map(|lane| lane.bodies()[0].stepper.q()[0]);
        (q - exact).abs()
    };
    let mut largest = Vec::from([0.0]);
    for _ in 0..1500 {
        studio.tick();
        largest.push(f64::max(largest[largest.len() - 1], now(&studio)));
        assert_eq!(error(&studio), largest[largest.len() - 1]);
    }
    assert!(largest[1500] > 1e-3);
    for tick in [900, 200, 1400] {
        studio.apply(RunCommand::Seek(tick));
        assert_eq!(error(&studio), largest[tick as usize], "at tick {tick}");
    }
    let place = crate::scene::Action::Place { body: 0, q: [0.3].into(), v: [0.0].into() };
    studio.apply(RunCommand::Act(place));
    assert_eq!(error(&studio), largest[1400], "a throw makes no run good");
    studio.apply(RunCommand::Undo);
    assert_eq!(error(&studio), largest[1400]);
}

#[test]
fn every_known_energy_has_a_number_and_rounding_counts_as_zero() {
    for scene in crate::scene::SCENES {
        let mut studio = Studio::new(Scene::built_in(scene.name).unwrap());
        (0..30).for_each(|_| studio.tick());
        let body = &studio.race().entrants()[0].lane.bodies()[studio.view().body];
        let is_known = body.stepper.energy().or(body.stepper.mechanical_energy().map(|_| 0.0));
        let row = &groups(&studio)[0][0];
        assert_eq!(row.energy().is_some(), is_known.is_some(), "{}", scene.name);
    }
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..30).for_each(|_| studio.tick());
    let in_unit = |value: f64| groups(&studio)[0][0].in_unit(value).unwrap();
    assert_eq!([in_unit(-7.62e-24), in_unit(1e-9)], ["0 m", "1.00·10⁻⁹ m"]);
}

#[test]
fn the_cost_has_a_column_in_a_race_only() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    let has_cost = |studio: &Studio| table(studio).columns.iter().any(|it| it.name == "cost");
    assert!(!has_cost(&studio));
    studio.apply(StageCommand::ToggleRace);
    assert!(has_cost(&studio));
}

#[test]
fn in_the_race_of_a_recording_each_key_and_row_has_its_own_lane() {
    let mut recorded = Studio::new(Scene::built_in("harbour").unwrap());
    (0..121).for_each(|_| recorded.tick());
    recorded.apply(StageCommand::Pick(1));
    (0..90).for_each(|_| recorded.tick());
    let text = recorded.deck.recording().unwrap();
    let mut studio = Studio::new(Scene::parse("run.toml", &text).unwrap());
    studio.apply(StageCommand::ToggleRace);
    (0..200).for_each(|_| studio.tick());
    let lanes = studio.race().entrants().len();
    let mut numbers = Vec::new();
    for entry in 0..lanes {
        studio.apply(StageCommand::Pick(entry));
        assert_eq!((studio.active(), studio.selected().id.index()), (entry, entry));
        let rows = groups(&studio);
        numbers.push(rows[entry][0].largest_error().expect("it runs"));
    }
    assert!(numbers[0] > 5.0 * numbers[1] && numbers[1] > 0.0, "{numbers:?}");
    let rows = groups(&studio);
    assert_eq!(rows[0][0].head(), "1 → 2 (switched at 2.02 s)");
    assert_eq!(rows[1][0].head(), "Semi-implicit Euler");
    let verdicts = studio.analysis_request().entries;
    assert_eq!(verdicts[0].0.method, verdicts[1].0.method, "judged as it runs now");
}
