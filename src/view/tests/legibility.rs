//! Tests that no text of a frame is cut off, elided, or covered by another, at any usual size of the window.

use egui::emath::Rot2;
use egui::epaint::text::PlacedRow;
use egui::{Pos2, Rect, Ui, Vec2, vec2};
use rayon::prelude::*;

use super::testing::{ShownText, TestWindow};
use crate::frame::write;
use crate::look::palette::Theme;
use crate::loops::loop_lab::LoopCommand;
use crate::measure::cloud::{CloudChoice, CloudShape, CloudWorker};
use crate::run::race::Mode;
use crate::scene::TickRate;
use crate::scene::{OPENING, SCENES, Scene};
use crate::stage::compose;
use crate::studio::guide::STOPS;
use crate::studio::{
    Arrangement, Command, INSTRUMENTS, Instrument, InstrumentGroup, Motion, RunCommand,
    SCALE_LADDER, StageCommand, Step, Studio, ViewCommand, complete_clouds, run_loops,
    unanswered_request,
};
use crate::{panels, theme};

/// Window sizes in points: the first is the minimum, and the last has four times the usual pixels.
const SIZES: [Vec2; 4] =
    [vec2(800.0, 600.0), vec2(1280.0, 720.0), vec2(1920.0, 1080.0), vec2(3840.0, 2160.0)];

/// A text of a frame.
struct Text {
    rect: Rect,
    /// Corners of the text, in order. The text may be turned, so `rect` only bounds it.
    corners: [Pos2; 4],
    clip: Rect,
    words: String,
    is_elided: bool,
}

/// Every text of a frame of this size, taken from the third frame of a window.
fn texts(studio: &Studio, size: Vec2) -> Vec<Text> {
    let mut window =
        TestWindow::new(size / theme::zoom(size.into(), studio.display().scale_percent));
    theme::show(&window.context, studio.display(), size.into());
    let mut frame = || {
        let layout = |ui: &mut Ui| {
            let (_, stage) = panels::show(ui, studio);
            let painter = ui.painter().with_clip_rect(stage);
            let picture = compose(studio, stage.size().into());
            picture.labels.iter().for_each(|label| write(&painter, stage, label));
        };
        window.show(Vec::new(), layout).1
    };
    (0..2).for_each(|_| drop(frame()));
    frame().texts.iter().flat_map(rows).collect()
}

/// The rows of a text. They are separate because a paragraph may begin in the middle of a line.
fn rows(ShownText { shape, clip }: &ShownText) -> impl Iterator<Item = Text> {
    let row = |row: &PlacedRow| {
        // Bounds of the ink, without the room above and below it.
        let inked = row.visuals.mesh_bounds.translate(row.pos.to_vec2());
        let corners =
            [inked.left_top(), inked.right_top(), inked.right_bottom(), inked.left_bottom()];
        let corners = corners.map(|at| shape.pos + Rot2::from_angle(shape.angle) * at.to_vec2());
        Text {
            rect: Rect::from_points(&corners),
            corners,
            clip: *clip,
            words: row.text(),
            is_elided: shape.galley.elided,
        }
    };
    shape.galley.rows.iter().map(row).filter(|text| !text.words.trim().is_empty())
}

/// Whether two turned texts are apart: along a side of one of them, one ends before the other begins.
fn are_apart(a: &Text, b: &Text) -> bool {
    let ends = |corners: &[Pos2; 4], along: Vec2| {
        let places = corners.map(|at| at.to_vec2().dot(along.normalized()));
        (
            places.into_iter().fold(f32::INFINITY, f32::min),
            places.into_iter().fold(f32::NEG_INFINITY, f32::max),
        )
    };
    let sides = [a, b].into_iter().flat_map(|text| {
        let [first, second, third, _] = text.corners;
        [second - first, third - second]
    });
    sides.into_iter().any(|side| {
        let [a, b] = [a, b].map(|text| ends(&text.corners, side));
        a.1 - 0.75 < b.0 + 0.75 || b.1 - 0.75 < a.0 + 0.75
    })
}

/// Descriptions of the unreadable texts in a frame.
fn faults(studio: &Studio, size: Vec2) -> Vec<String> {
    let texts = texts(studio, size);
    assert!(texts.len() > 8, "{}", texts.len());
    let mut faults = Vec::new();
    // Text scrolled out of sight is not in the frame, and a row at the edge is cut on purpose.
    let seen = |text: &&Text| text.clip.intersects(text.rect.shrink(1.0));
    let texts: Vec<&Text> = texts.iter().filter(seen).collect();
    for (i, text) in texts.iter().enumerate() {
        if text.is_elided {
            faults.push(format!("{:?} is elided", text.words));
        }
        let (left, right) = (text.clip.left() - 1.0, text.clip.right() + 1.0);
        if text.rect.left() < left || text.rect.right() > right {
            faults
                .push(format!("{:?} is cut off at {:?} by {:?}", text.words, text.rect, text.clip));
        }
        let mine = text.rect.shrink(0.75).intersect(text.clip);
        for other in &texts[..i] {
            let theirs = other.rect.shrink(0.75).intersect(other.clip);
            let is_halo =
                other.words == text.words && other.rect.center().distance(text.rect.center()) < 4.5;
            let is_seen = mine.is_positive() && theirs.is_positive();
            if is_seen && mine.intersects(theirs) && !is_halo && !are_apart(text, other) {
                faults.push(format!("{:?} is over {:?} at {:?}", text.words, other.words, mine));
            }
        }
    }
    faults
}

/// A studio on the scene of this name, some seconds after its start.
fn run(name: &str, race: bool) -> Studio {
    started(Scene::built_in(name).expect("a built-in scene"), race)
}

/// The same in a race of all methods.
fn race_of_all(name: &str) -> Studio {
    let mut scene = Scene::built_in(name).expect("a built-in scene");
    scene.lanes = Studio::new(scene.clone()).entries().to_vec();
    started(scene, true)
}

/// A studio with verdicts. A net is judged for its first seconds only, because it takes as long as all other scenes
/// together.
fn started(mut scene: Scene, race: bool) -> Studio {
    if has_net(&scene) {
        scene.seconds = scene.seconds.min(2.0);
    }
    let mut studio = moved(scene, race);
    studio.analyse();
    studio
}

/// The same studio without verdicts.
fn moved(scene: Scene, race: bool) -> Studio {
    let mut studio = Studio::new(scene);
    if race {
        studio.apply(StageCommand::ToggleRace);
    }
    move_on(&mut studio);
    studio
}

fn has_net(scene: &Scene) -> bool {
    scene.bodies.iter().any(|body| body.kind.net().is_some())
}

fn move_on(studio: &mut Studio) {
    let seconds = if has_net(studio.scene()) { 1 } else { 4 };
    let ticks = seconds * studio.race().tick_hz().hz() as u32;
    (0..ticks).for_each(|_| studio.tick());
}

#[track_caller]
fn assert_legible(studio: &Studio, what: &str) {
    let mut all = Vec::new();
    for size in SIZES {
        all.extend(
            faults(studio, size).into_iter().map(|fault| format!("{what}, {size}: {fault}")),
        );
    }
    assert!(all.is_empty(), "\n{}", all.join("\n"));
}

#[test]
fn every_text_of_every_scene_is_legible_alone_and_racing() {
    SCENES.par_iter().for_each(|scene| {
        let mut studio = run(scene.name, true);
        assert_legible(&studio, &format!("{}, racing", scene.name));
        // Keeps the verdicts of the race, because those of a net take seconds.
        studio.apply(StageCommand::ToggleRace);
        move_on(&mut studio);
        if unanswered_request(&studio).is_some() {
            assert!(!studio.scene().script.is_empty(), "a kick of the script begins a verdict");
            studio.analyse();
        }
        assert_legible(&studio, &format!("{}, alone", scene.name));
    });
}

/// Every instrument on every scene. Inspector, mode and size vary so that each pair of their values occurs. All
/// combinations would take an hour.
#[test]
fn every_text_is_legible_under_every_instrument_and_the_inspector_on_every_scene() {
    let mut all = Vec::new();
    for (s, scene) in SCENES.iter().enumerate() {
        let mut labs = [false, true].map(|race| moved(Scene::built_in(scene.name).unwrap(), race));
        for (i, instrument) in Instrument::all().enumerate() {
            let [inspector, race, size] = [s + i, s / 2 + i, s + i / 2].map(|n| n % 2);
            let studio = &mut labs[race];
            studio.apply(StageCommand::Instrument(instrument));
            if studio.display().inspector != (inspector == 1) {
                studio.apply(RunCommand::ToggleInspector);
            }
            let faults = faults(studio, SIZES[size]);
            let name = instrument.name();
            let at = format!("{}, {name}, inspector {inspector}, race {race}", scene.name);
            all.extend(faults.into_iter().map(|fault| format!("{at}, {}: {fault}", SIZES[size])));
        }
    }
    assert!(all.is_empty(), "\n{}", all.join("\n"));
}

#[test]
fn every_text_is_legible_beside_clouds() {
    let scenes = [
        ("liouville", true, CloudShape::default()),
        ("spring", false, CloudShape::default()),
        ("spring", true, CloudShape::default()),
    ];
    for (name, race, shape) in scenes {
        let mut studio = Studio::new(Scene::built_in(name).expect("a built-in scene"));
        if race {
            studio.apply(StageCommand::ToggleRace);
        }
        (0..studio.race().tick_hz().hz() as u32).for_each(|_| studio.tick());
        studio.apply(StageCommand::Instrument(Instrument::Cloud));
        studio.apply(RunCommand::Cloud(CloudChoice { shape, points: 1000 }));
        complete_clouds(&mut studio, &mut CloudWorker::default(), || false);
        assert_legible(&studio, &format!("clouds of {name}, race {race}"));
        studio.apply(ViewCommand::ToggleEnlarged);
        assert_legible(&studio, &format!("large clouds of {name}, race {race}"));
    }
}

#[test]
fn every_text_is_legible_at_every_guide_stop_beside_the_inspector() {
    let mut all = Vec::new();
    let mut studio = run("spring", false);
    studio.apply(ViewCommand::ToggleGuide);
    for (stop, of) in STOPS.iter().enumerate() {
        (0..60).for_each(|_| studio.tick());
        for (i, size) in SIZES[..2].iter().enumerate() {
            if studio.display().inspector != (i == stop % 2) {
                studio.apply(RunCommand::ToggleInspector);
            }
            // Before the prediction, and after it.
            (0..i).for_each(|_| _ = studio.apply(ViewCommand::Predict(0)));
            let faults = faults(&studio, *size);
            let at = format!("stop {stop}, inspector {}, {size}", studio.display().inspector);
            all.extend(faults.into_iter().map(|fault| format!("{at}: {fault}")));
        }
        // The stage has room above the guide, and two lines and more fit below the guide's head.
        let head = texts(&studio, SIZES[0])
            .into_iter()
            .find(|text| text.words.starts_with(&format!("{}. {}", stop + 1, of.title)));
        let above = head.expect("the head of the guide").rect.top();
        assert!((190.0..480.0).contains(&above), "stop {stop}: {above} of {} points", SIZES[0].y);
        studio.apply(ViewCommand::StopBeside(Step::Next));
    }
    assert!(all.is_empty(), "\n{}", all.join("\n"));
}

#[test]
fn every_text_is_legible_with_all_methods_racing_in_both_arrangements() {
    for name in ["harbour", "orbit"] {
        let mut studio = race_of_all(name);
        assert_eq!(studio.display().arrangement, Arrangement::Overlay);
        assert_legible(&studio, &format!("all methods on {name}"));
        studio.apply(StageCommand::ToggleArrangement);
        for size in &SIZES[1..] {
            let faults = faults(&studio, *size);
            assert!(faults.is_empty(), "{name} side by side, {size}:\n{}", faults.join("\n"));
        }
    }
}

#[test]
fn every_text_is_legible_in_bands_of_any_methods_in_both_themes_and_beside_a_fan() {
    let mut all = Vec::new();
    for (theme, motion) in [(Theme::Dark, Motion::Live), (Theme::Light, Motion::Recorded)] {
        let scene = Scene::built_in(OPENING).unwrap();
        let mut studio = Studio::opened(scene, None, Mode::Race);
        studio.viewer.preferences.display.theme = theme;
        studio.viewer.preferences.display.motion = motion;
        studio.analyse();
        for digit in [None, Some(2), Some(3), Some(4), Some(0)] {
            digit.into_iter().for_each(|digit| _ = studio.apply(StageCommand::Pick(digit)));
            for futures in [false, true] {
                if futures {
                    studio.apply(ViewCommand::ToggleFutures);
                }
                for size in SIZES.iter().chain(&[vec2(390.0, 844.0), vec2(640.0, 360.0)]) {
                    let found = faults(&studio, *size).into_iter();
                    all.extend(found.map(|it| format!("{digit:?}, {futures}, {size}: {it}")));
                }
            }
            studio.apply(ViewCommand::ToggleFutures);
            (0..97).for_each(|_| studio.tick());
        }
    }
    assert!(all.is_empty(), "\n{}", all.join("\n"));
}

#[test]
fn every_text_is_legible_under_every_method_from_the_start() {
    let mut studio = race_of_all("harbour");
    studio.apply(StageCommand::ToggleRace);
    for entry in 0..studio.entries().len() {
        studio.apply(StageCommand::Pick(entry));
        studio.apply(StageCommand::Restart);
        assert_legible(&studio, studio.entries()[entry].method.name);
    }
}

#[test]
fn every_text_is_legible_at_every_size_of_type() {
    let mut labs = [("harbour", race_of_all("harbour")), ("stiff", run("stiff", false))];
    for scale_percent in SCALE_LADDER {
        for (name, studio) in &mut labs {
            studio.viewer.preferences.choose_scale(scale_percent);
            assert_legible(studio, &format!("{name} at {scale_percent} %"));
        }
    }
}

#[test]
fn every_text_is_legible_in_the_light_theme_and_beside_help_and_inspector() {
    for command in [
        Command::View(ViewCommand::ToggleTheme),
        Command::View(ViewCommand::ToggleHelp),
        Command::Run(RunCommand::ToggleInspector),
    ] {
        let mut studio = run("harbour", false);
        studio.apply(command.clone());
        assert_eq!(
            studio.display().theme == Theme::Light,
            command == Command::View(ViewCommand::ToggleTheme)
        );
        if command == Command::View(ViewCommand::ToggleHelp) {
            // The overlay covers the panels on purpose: only elided or cut text is a fault.
            for size in SIZES {
                let faults = faults(&studio, size);
                let cut: Vec<_> =
                    faults.iter().filter(|fault| !fault.contains(" is over ")).collect();
                assert!(cut.is_empty(), "help, {size}: {cut:?}");
            }
        } else {
            assert_legible(&studio, &format!("{command:?}"));
        }
    }
}

#[test]
fn every_text_of_the_loop_lab_is_legible_on_any_stage_display_and_theme() {
    for name in ["spring", "harbour", "orbit"] {
        for theme in [Theme::Dark, Theme::Light] {
            let mut studio = run(name, false);
            studio.viewer.preferences.choose_theme(theme);
            studio.apply(Command::Loop(LoopCommand::ToggleLab));
            run_loops(&mut studio);
            studio.apply(Command::Loop(LoopCommand::Seek(2_264_000_000)));
            assert_legible(&studio, &format!("loop lab on {name}, {theme:?}"));
            studio.apply(StageCommand::ToggleArrangement);
            assert_legible(&studio, &format!("loops over each other on {name}, {theme:?}"));
        }
    }
}

#[test]
fn every_text_is_legible_at_a_rate_of_many_digits() {
    let scene = Scene::built_in("spring").expect("a built-in scene");
    let mut studio = started(scene.at_tick_hz("1234.567".parse::<TickRate>().unwrap()), true);
    assert_legible(&studio, "a race at 1234.567 Hz");
    studio.apply(RunCommand::ToggleInspector);
    for instrument in [Instrument::Advice, Instrument::StabilityMap, Instrument::Cost] {
        studio.apply(StageCommand::Instrument(instrument));
        studio.analyse();
        assert_legible(&studio, &format!("{} at 1234.567 Hz", instrument.name()));
    }
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    run_loops(&mut studio);
    assert_legible(&studio, "the loop lab at 1234.567 Hz");
}

#[test]
fn every_text_of_the_loop_lab_is_legible_with_every_loop_and_display() {
    let mut studio = run("spring", false);
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    run_loops(&mut studio);
    let loops = studio.loop_lab().expect("it is open");
    let (traces, lanes) = (loops.traces().len(), loops.lanes().len());
    for trace in 0..traces {
        studio.apply(Command::Loop(LoopCommand::Trace(trace)));
        run_loops(&mut studio);
        studio.apply(Command::Loop(LoopCommand::Seek(5_000_000_000)));
        assert_legible(&studio, &format!("trace {trace}"));
    }
    for index in 0..lanes {
        studio.apply(Command::Loop(LoopCommand::Select(index)));
        assert_legible(&studio, &format!("loop {index} selected"));
    }
}

#[test]
fn every_text_of_every_instrument_of_the_loop_lab_is_legible() {
    for name in ["spring", "harbour"] {
        let mut studio = run(name, false);
        studio.apply(Command::Loop(LoopCommand::ToggleLab));
        run_loops(&mut studio);
        studio.apply(Command::Loop(LoopCommand::Seek(2_264_000_000)));
        for instrument in Instrument::all().filter(|one| one.is_in_loop_lab()) {
            studio.apply(StageCommand::Instrument(instrument));
            assert_legible(&studio, &format!("{} by loop on {name}", instrument.name()));
        }
    }
}

/// The texts beside the stage in a frame of this size.
fn beside_the_stage(studio: &Studio, size: Vec2) -> Vec<Text> {
    let left = (1.0 - panels::INSTRUMENTS) * size.x / theme::zoom(size.into(), 100);
    texts(studio, size).into_iter().filter(|text| text.rect.left() > left).collect()
}

#[test]
fn instruments_have_one_row_of_tabs_and_a_menu_in_a_small_window() {
    let mut studio = moved(Scene::built_in("spring").unwrap(), true);
    for instrument in Instrument::all() {
        studio.apply(StageCommand::Instrument(instrument));
        let of_group = |group: InstrumentGroup, is_whole: bool| {
            let is_there = |it: Instrument| it == instrument || it.is_of(studio.scene());
            let cards =
                INSTRUMENTS.iter().filter(|card| card.group == group && is_there(card.instrument));
            let names: Vec<&str> = match is_whole || group == instrument.card().group {
                true => cards.map(|card| card.name).collect(),
                false => vec![group.name()],
            };
            names
        };
        let tabs = |is_whole| InstrumentGroup::ALL.map(|group| of_group(group, is_whole)).concat();
        // One more tab has less room.
        let is_narrow = instrument == Instrument::Polhode;
        let narrow = if is_narrow { vec![instrument.name()] } else { tabs(false) };
        for (size, wanted) in [
            (vec2(440.0, 400.0), vec![instrument.name()]),
            (SIZES[0], narrow),
            (SIZES[1], tabs(false)),
            (SIZES[2], tabs(!is_narrow)),
        ] {
            let is_name = |text: &Text| {
                tabs(true).contains(&&*text.words)
                    || InstrumentGroup::ALL.iter().any(|group| group.name() == text.words)
            };
            let mut shown = beside_the_stage(&studio, size);
            let head = shown.iter().find(|text| is_name(text)).expect("a tab").rect.center().y;
            // The title of the instrument, below the tabs, may repeat a name.
            shown.retain(|text| is_name(text) && (text.rect.center().y - head).abs() < 12.0);
            shown.sort_by(|a, b| a.rect.left().total_cmp(&b.rect.left()));
            assert!(shown.iter().all(|text| !text.is_elided && text.clip.contains_rect(text.rect)));
            let names: Vec<&str> = shown.iter().map(|text| &*text.words).collect();
            assert_eq!(names, wanted, "{size}, {}", instrument.name());
        }
    }
}

#[test]
fn the_effect_of_one_step_is_fully_visible_under_any_method() {
    let mut studio = race_of_all("spring");
    studio.apply(StageCommand::Instrument(Instrument::OneStep));
    for entry in [0, 3, 11] {
        studio.apply(StageCommand::Pick(entry));
        for size in [vec2(960.0, 540.0)].into_iter().chain(SIZES) {
            let texts = beside_the_stage(&studio, size);
            let begins = |words: &str| texts.iter().position(|text| text.words.starts_with(words));
            let said = &texts[begins("One tick").expect("what the tick does")..];
            let plot = &texts[begins("velocity").expect("the name of an axis")];
            // With the words below the plot, the plot must still be high enough.
            if size.x < SIZES[2].x {
                let height = said[0].rect.top() - plot.rect.top();
                assert!((80.0..size.y / 2.0).contains(&height), "{entry}, {size}: {height}");
            }
            let last = said.iter().position(|text| text.words.trim_end().ends_with("m/s."));
            for text in &said[..=last.expect("how far it misses")] {
                let is_whole = text.clip.contains_rect(text.rect);
                assert!(is_whole, "{entry}, {size}: {:?} by {:?}", text.words, text.clip);
            }
        }
    }
}

#[test]
fn the_one_step_plot_stability_map_and_tick_times_are_legible() {
    let mut studio = run("spring", true);
    studio.apply(StageCommand::Instrument(Instrument::StabilityMap));
    studio.analyse();
    assert_legible(&studio, "the map");
    let times = studio.entries().iter().map(|spec| (*spec, Some(987.6))).collect();
    studio.viewer.tick_times = times;
    studio.apply(StageCommand::Instrument(Instrument::Cost));
    assert_legible(&studio, "the times");
    studio.apply(StageCommand::Instrument(Instrument::OneStep));
    (0..1800).for_each(|_| studio.tick());
    assert_legible(&studio, "a step far out");
}

#[test]
fn large_energies_are_legible_beside_their_names() {
    let mut studio = run("stiff", true);
    studio.apply(RunCommand::ToggleEqualCost);
    studio.apply(StageCommand::Pick(1));
    studio.apply(StageCommand::Instrument(Instrument::Energy));
    (0..8 * 60).for_each(|_| studio.tick());
    assert_legible(&studio, "the energies");
    let mut longest = 0;
    for _ in 0..60 {
        studio.tick();
        let texts = texts(&studio, SIZES[1]);
        let name = texts.iter().find(|text| text.words == "2 potential").expect("it has a value");
        let is_value =
            |text: &&Text| text.words.ends_with(" J") && text.rect.left() > name.rect.left();
        let row = name.rect.center().y;
        let value = texts.iter().filter(is_value).find(|text| text.rect.y_range().contains(row));
        let value = value.expect("beside it");
        longest = longest.max(value.words.len());
        let gap = value.rect.left() - name.rect.right();
        assert!(gap > 6.0, "{:?} is {gap} points from its name", value.words);
    }
    assert!(longest > 6, "{longest}");
}

#[test]
fn every_text_of_this_windows_own_loop_is_legible() {
    let mut studio = run("spring", false);
    studio.apply(StageCommand::Instrument(Instrument::Loop));
    assert_legible(&studio, "no frame yet");
    for frame in 0..600 {
        studio.advance(if frame % 50 == 7 { 41_000_000 } else { 16_600_000 });
    }
    assert_legible(&studio, "ten seconds of frames");
}

/// Words and numbers of a frame. A token with a digit is a number, any other token with a letter a word.
fn counted(studio: &Studio, size: Vec2) -> [Vec<String>; 2] {
    let mut texts = texts(studio, size);
    // A halo repeats the same text.
    let place = |text: &Text| text.rect.center();
    let mut kept: Vec<Text> = Vec::new();
    for text in texts.drain(..) {
        let is_halo =
            |other: &Text| other.words == text.words && place(other).distance(place(&text)) < 4.5;
        let is_code = text.words.contains("+= h");
        if !is_code && text.clip.intersects(text.rect) && !kept.iter().any(is_halo) {
            kept.push(text);
        }
    }
    let tokens = kept.iter().flat_map(|text| text.words.split_whitespace()).map(str::to_owned);
    let (numbers, others) =
        tokens.partition(|token: &String| token.contains(|c: char| c.is_numeric()));
    let words = |token: &String| token.contains(char::is_alphabetic);
    [Vec::into_iter(others).filter(words).collect(), numbers]
}

#[test]
fn the_opening_shows_few_words_and_numbers_and_no_tabs() {
    for (scene, measure, most) in
        [(OPENING, false, [30, 20]), ("harbour", false, [42, 26]), ("harbour", true, [90, 60])]
    {
        // Once the stage zooms out after the spring, a sentence on it states how far the spring is.
        let sentence = [20, 6];
        let scene = Scene::built_in(scene).unwrap();
        let mode = Mode::opening(&scene);
        let mut studio = Studio::opened(scene, None, mode);
        studio.viewer.preferences.display.measure = measure;
        studio.viewer.preferences.display.motion = Motion::Live;
        studio.analyse();
        for seconds in [0, 2, 7, 15] {
            while studio.race().tick() < 60 * seconds {
                studio.tick();
            }
            let counted = counted(&studio, SIZES[1]);
            let [words, numbers] = [0, 1].map(|of| counted[of].len());
            // A stage that zooms out may have one more mark on its ruler.
            let more = if seconds > 2 { sentence } else { [0, usize::from(seconds > 0)] };
            let most = [0, 1].map(|of| most[of] + more[of]);
            assert!(words > 20 && words <= most[0], "{words} at {seconds} s: {:?}", counted[0]);
            let told = &counted[1];
            assert!(numbers > 8 && numbers <= most[1], "{numbers} at {seconds} s: {told:?}");
            for card in INSTRUMENTS {
                let is_of = |word: &String| card.name.starts_with(word) && word.len() > 3;
                let is_there = counted[0].iter().any(is_of);
                assert!(measure || !is_there, "{} at {seconds} s", card.name);
            }
        }
    }
}
