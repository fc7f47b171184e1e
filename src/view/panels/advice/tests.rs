use egui::{FontFamily, Pos2, Rect};

use super::*;
use crate::measure::AnalysisWorker;
use crate::panels;
use crate::scene::Scene;
use crate::studio::{Instrument, StageCommand, accept_findings};
use crate::tests::testing::{ShownText, TestWindow};

/// Shows frames of this size. Returns the stage, and every text that is fully visible, with its place.
fn shown(studio: &Studio, size: [f32; 2]) -> (Rect, Vec<(Pos2, String)>) {
    let mut window = TestWindow::new(size);
    let mut frame = || window.show(Vec::new(), |ui| panels::show(ui, studio).1);
    (0..2).for_each(|_| drop(frame()));
    let (stage, mut shown) = frame();
    shown.texts.retain(|text| !text.shape.galley.elided);
    let texts = shown.whole().into_iter().map(|(rect, words)| (rect.left_top(), words));
    (stage, texts.collect())
}

const SIZES: [[f32; 2]; 5] =
    [[800.0, 600.0], [900.0, 600.0], [1024.0, 640.0], [1280.0, 720.0], [1920.0, 1080.0]];

fn asked(scene: &str, is_of_one: bool) -> (Studio, AnalysisWorker) {
    let mut studio = Studio::new(Scene::built_in(scene).unwrap());
    studio.apply(StageCommand::Instrument(Instrument::Advice));
    studio.apply(ViewCommand::AdviseOnOneBody(is_of_one));
    let worker = AnalysisWorker::new(studio.analysis_request());
    (studio, worker)
}

#[test]
fn no_row_of_the_table_covers_the_inspector() {
    let (mut studio, mut worker) = asked("spring", false);
    judge(&mut studio, &mut worker, 4);
    studio.apply(RunCommand::ToggleInspector);
    for size in SIZES {
        let (stage, texts) = shown(&studio, size);
        let beside = |(at, _): &&(Pos2, String)| at.x > stage.right();
        let mut titles = texts.iter().filter(|(at, words)| at.y > 40.0 && words == "Edit");
        let title = titles.next().expect("a title").0.y;
        let is_over = |(at, words): &&(Pos2, String)| {
            (at.y - title).abs() < 9.0 && !["Edit", "↺ Restore all", "×"].contains(&&**words)
        };
        let over: Vec<_> = texts.iter().filter(beside).filter(is_over).collect();
        assert!(over.is_empty(), "{size:?}: {over:?}");
    }
}

/// Works until the recommendation is final.
fn decide(studio: &mut Studio, worker: &mut AnalysisWorker) {
    while studio.viewer.advice().is_none_or(|advice| !advice.is_decided) {
        worker.work();
        accept_findings(studio, worker.findings());
    }
}

/// Works until `count` methods are judged.
fn judge(studio: &mut Studio, worker: &mut AnalysisWorker, count: usize) {
    while studio.viewer.advice().is_none_or(|advice| advice.advised.len() < count) {
        worker.work();
        accept_findings(studio, worker.findings());
    }
}

#[test]
fn every_column_is_fully_visible_and_the_stage_keeps_its_room() {
    let (mut studio, mut worker) = asked("spring", false);
    decide(&mut studio, &mut worker);
    for size in SIZES {
        let (stage, texts) = shown(&studio, size);
        let stage_to = size[0] * (1.0 - panels::INSTRUMENTS);
        assert!((stage.right() - stage_to).abs() < 1.0, "{size:?}: {stage:?}");
        for criterion in &CRITERIA {
            // The name of a criterion may also appear above the table, before the recommendation.
            let at = texts.iter().filter(|(_, text)| text == criterion.name());
            let head = at.map(|(at, _)| *at).max_by(|a, b| a.y.total_cmp(&b.y));
            let head = head.unwrap_or_else(|| panic!("{size:?}: {texts:?}"));
            let is_under = |(at, text): &&(Pos2, String)| {
                text.starts_with('×') && at.y > head.y && (at.x - head.x).abs() < 12.0
            };
            assert!(texts.iter().any(|text| is_under(&text)), "{size:?}: {head:?} {texts:?}");
            let taken = |(at, text): &&(Pos2, String)| text.starts_with('×') && at.y < head.y;
            let taken = texts.iter().filter(taken).count();
            assert_eq!(taken, 1, "substeps of the answer, {size:?}: {texts:?}");
            let best = studio.viewer.advice().and_then(Advice::to_take).expect("it is decided");
            let best = studio.viewer.advice().unwrap().advised[best.0].spec.method.name;
            let is_named = |(at, text): &&(Pos2, String)| text == best && at.y < head.y;
            assert!(texts.iter().any(|text| is_named(&text)), "{size:?}: {texts:?}");
        }
    }
}

#[test]
fn method_names_in_the_table_have_one_type_size() {
    let (mut studio, mut worker) = asked("spring", false);
    judge(&mut studio, &mut worker, 8);
    for size in SIZES {
        let mut window = TestWindow::new(size);
        let mut frame = || window.show(Vec::new(), |ui| panels::show(ui, &studio).1);
        (0..2).for_each(|_| drop(frame()));
        let (stage, shown) = frame();
        // The names in the recommendations are in strong type.
        let size_of_name = |text: &ShownText| {
            let galley = &text.shape.galley;
            let font = &galley.job.sections.first()?.format.font_id;
            let is_name = studio.entries().iter().any(|it| it.method.name == galley.text());
            let is_plain = font.family == FontFamily::Proportional;
            // The methods below the stage appear beside their digits.
            let is_beside = text.shape.pos.x > stage.right() && text.shape.pos.y < stage.bottom();
            (is_name && is_plain && is_beside).then_some(font.size)
        };
        let sizes: Vec<f32> = shown.texts.iter().filter_map(size_of_name).collect();
        let is_one = sizes.iter().all(|other| *other == sizes[0]);
        assert!(sizes.len() > 4 && is_one, "{size:?}: {sizes:?}");
    }
}

#[test]
fn no_method_is_named_or_copied_before_the_search_has_ended() {
    let (mut studio, mut worker) = asked("spring", false);
    let wanted = studio.scene().methods_for_games().count();
    let above = |studio: &Studio| -> Vec<String> {
        let (stage, texts) = shown(studio, [1280.0, 800.0]);
        let head = texts.iter().find(|(_, text)| text == "method").expect("a table").0;
        let is_above = |(at, _): &(Pos2, String)| at.y < head.y && at.x > stage.right();
        texts.into_iter().filter(is_above).map(|(_, text)| text).collect()
    };
    let names = |texts: &[String]| {
        let is_name = |text: &&String| studio_names().contains(&&***text);
        texts.iter().filter(is_name).count()
    };
    judge(&mut studio, &mut worker, 1);
    loop {
        let texts = above(&studio);
        let is_decided = studio.viewer.advice().is_some_and(|advice| advice.is_decided);
        assert_eq!(names(&texts), usize::from(is_decided), "{texts:?}");
        let copies = texts.iter().filter(|text| text.starts_with("Copy")).count();
        assert_eq!(copies, usize::from(is_decided), "{texts:?}");
        if is_decided {
            break;
        }
        let judged = studio.viewer.advice().expect("it is asked for").advised.len();
        let told = format!("At 60 Hz: {judged} of {wanted} methods judged …");
        let searches = judged == wanted && texts.contains(&"At 60 Hz: searching reserves …".into());
        assert!(texts.contains(&told) || searches, "{texts:?}");
        for _ in 0..30 {
            worker.work();
        }
        accept_findings(&mut studio, worker.findings());
    }
}

fn studio_names() -> Vec<&'static str> {
    Scene::built_in("spring").unwrap().methods_for_games().map(|it| it.name).collect()
}

#[test]
fn advice_can_be_limited_to_the_selected_body() {
    let counts = |is_of_one: bool| {
        let (mut studio, mut worker) = asked("harbour", is_of_one);
        judge(&mut studio, &mut worker, 2);
        let (_, texts) = shown(&studio, [1280.0, 720.0]);
        assert!(texts.iter().any(|(_, text)| text == "spring alone"), "{texts:?}");
        let whose = texts.iter().any(|(_, text)| text.ends_with(", all bodies"));
        assert_eq!(whose, !is_of_one, "{texts:?}");
        let euler = &studio.viewer.advice().unwrap().advised[1];
        assert_eq!(euler.spec.method.id, "semi-implicit-euler");
        euler.met[0].met().unwrap().evaluations_per_s
    };
    assert_eq!([counts(true), counts(false)], [60.0, 120.0]);
    // A lane's verdict is about one body, and the advice is too, until the user asks for all bodies.
    let studio = Studio::new(Scene::built_in("harbour").unwrap());
    assert!(studio.display().advises_on_one_body);
}

#[test]
fn the_code_of_the_recommended_method_is_shown_with_a_copy_button() {
    let (mut studio, mut worker) = asked("spring", false);
    decide(&mut studio, &mut worker);
    studio.apply(RunCommand::SetLane(LaneSpec { substeps: 2, ..studio.entries()[0] }));
    let beside = |studio: &Studio| -> Vec<String> {
        let mut window = TestWindow::new([1280.0, 800.0]);
        (0..2).for_each(|_| drop(window.panels(studio, Vec::new())));
        window.panels(studio, Vec::new()).1.words()
    };
    let words = beside(&studio);
    let has = |words: &[String], of: &str| words.iter().any(|text| text.contains(of));
    assert!(has(&words, "Semi-implicit Euler: 1 call a tick, h = 1/60 s"), "{words:?}");
    assert!(has(&words, "pub fn semi_implicit_euler"), "not that on the stage: {words:?}");
    studio.apply(ViewCommand::Language(Language::CSharp));
    let words = beside(&studio);
    assert!(has(&words, "public static void Step") && has(&words, "Copy C#"), "{words:?}");
}

#[test]
fn a_missing_reserve_is_marked_in_the_answer_and_its_tooltip() {
    for (slowest_hz, factor, marks) in [(20, 1.0, 1), (60, 1.4, 1), (20, 1.4, 0)] {
        let met = CriterionMet {
            tick_hz: 60.into(),
            substeps: 1,
            evaluations_per_s: 60.0,
            cost_per_s: 60.0,
            are_margins_searched: true,
            slowest_hz: Some(slowest_hz),
            stiffness_factor: Some(factor),
            limited_by: Some("stiffness".into()),
        };
        let tooltip = cell_tooltip(&met);
        assert_eq!(tooltip.matches("no reserve").count(), marks, "{tooltip}");
        let mut window = TestWindow::new([1280.0, 720.0]);
        let mut frame = || {
            window.show(Vec::new(), |ui| taken_line(ui, ("Euler", Color32::WHITE), &met, None)).1
        };
        drop(frame());
        let shown = frame().whole().into_iter().filter(|(_, text)| text.contains("(only just)"));
        assert_eq!(shown.count(), marks, "{slowest_hz} Hz, {factor}");
    }
}
