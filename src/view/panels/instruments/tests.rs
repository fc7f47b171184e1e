use std::path::Path;

use egui::{Event, Modifiers, MouseWheelUnit, Pos2, Rect, TouchPhase, Vec2, vec2};
use rayon::prelude::*;

use super::super::tracks::Detail;
use super::error::{NO_ERROR, NOTHING_YET, capitalised};
use super::*;
use crate::chart::PlotArea;
use crate::measure::cloud::{CloudChoice, CloudWorker};
use crate::panels;
use crate::scene::{Action, SCENES, Scene};
use crate::studio::{
    BOOK_FIGURES, RunCommand, StageCommand, ViewCommand, complete_clouds, open_file, reload_file,
    shown_cloud,
};
use crate::tests::testing::{TestWindow, button};

mod shown;

/// Returns every text that is fully visible in a frame of this size, with its place.
fn texts(studio: &Studio, size: Vec2) -> Vec<(Rect, String)> {
    TestWindow::new(size).panels(studio, Vec::new()).1.whole()
}

#[test]
fn a_figure_of_the_book_has_ranges_of_the_axes_that_its_plot_has() {
    for (index, figure) in BOOK_FIGURES.iter().enumerate() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.apply(ViewCommand::OpenFigure(index));
        let set = plot_set_of(&studio, Detail::Samples).expect("plots");
        let names = set.plots[0].axis_names();
        let shown = names.map(|name| studio.view().plot_ranges[&name]);
        assert_eq!((shown, set.plots.len()), (figure.view, 1), "{}", figure.number);
    }
}

fn is_number(text: &str) -> bool {
    let digits = text.trim_start_matches(['\u{2212}', '+']);
    digits.starts_with(|c: char| c.is_ascii_digit()) && !text.contains(' ')
}

fn assert_legible(studio: &Studio, what: &str) {
    const SIZE: Vec2 = vec2(1280.0, 720.0);
    let left = (1.0 - panels::INSTRUMENTS) * SIZE.x;
    let texts = texts(studio, SIZE);
    let here: Vec<_> = texts.iter().filter(|(rect, _)| rect.left() > left).collect();
    let place = |wanted: &str| here.iter().find(|(_, text)| text == wanted).map(|(rect, _)| rect);
    for card in InstrumentGroup::ALL.into_iter().flat_map(|group| cards(studio, group)) {
        // Every group except the selected one has a single tab if there is no room for all tabs.
        let is_chosen = card.group == studio.display().instrument.card().group;
        let group = place(card.group.name()).filter(|_| !is_chosen);
        assert!(place(card.name).or(group).is_some(), "{what}: no tab {}", card.name);
    }
    let Some(set) = plot_set_of(studio, Detail::Samples) else {
        // The instrument lies between the tabs and the timeline.
        let is_of_instrument = |rect: &Rect| rect.top() > 66.0 && rect.bottom() < 540.0;
        let mut said = here.iter().filter(|(rect, _)| is_of_instrument(rect));
        assert!(said.any(|(_, text)| text.len() > 10), "{what}: {here:?}");
        return;
    };
    let numbers: Vec<_> = here.iter().filter(|(_, text)| is_number(text)).collect();
    for plot in &set.plots {
        if let Some(why) = &plot.nothing {
            assert!(place(why).is_some(), "{what}: {why}");
            let is_of_error = [NO_ERROR, NOTHING_YET].contains(&&**why);
            assert!(is_of_error || METRICS.iter().any(|metric| metric.absent == why));
            continue;
        }
        let title = place(&plot.title).unwrap_or_else(|| panic!("{what}: {}", plot.title));
        let up = place(&plot.axes[1].name()).unwrap_or_else(|| panic!("{what}: {here:?}"));
        assert!(!title.intersects(*up), "{what}: {} and {}", plot.title, plot.axes[1].name());
        let below = |top: f32| {
            let others = set.plots.iter().filter_map(|plot| place(&plot.title));
            let tops = others.map(|rect| rect.top()).filter(move |&other| other > top);
            tops.fold(f32::INFINITY, f32::min)
        };
        let band = title.top() - 4.0..below(title.top() + 1.0);
        let marks = numbers
            .iter()
            .filter(|(rect, _)| rect.right() <= title.left() && band.contains(&rect.center().y));
        let marks: Vec<&str> = marks.map(|(_, text)| &**text).collect();
        assert!(marks.len() >= 3, "{what}, {}: {marks:?}", plot.title);
    }
    if let Some(plot) = set.plots.iter().find(|plot| plot.nothing.is_none()) {
        let along = place(&plot.axes[0].name()).unwrap_or_else(|| panic!("{what}: {here:?}"));
        let row = along.top() - 20.0..along.top();
        let marks = numbers.iter().filter(|(rect, _)| row.contains(&rect.center().y)).count();
        assert!(marks >= 3, "{what}: {marks} marks along");
    }
}

/// The test covers each pair of an instrument and a body, at the start and later, in solo mode and in a race.
#[test]
fn every_axis_of_every_instrument_is_named_and_has_three_marks() {
    SCENES.par_iter().for_each(|scene| {
        let mut studio = Studio::new(Scene::built_in(scene.name).unwrap());
        let is_net = studio.scene().bodies.iter().any(|body| body.kind.net().is_some());
        for (run, mode) in ["solo", "race"].into_iter().enumerate() {
            for (time, seconds) in [0, if is_net { 1 } else { 3 }].into_iter().enumerate() {
                for _ in 0..60 * seconds {
                    studio.advance(16_666_667);
                }
                for (i, instrument) in Instrument::all().enumerate() {
                    studio.apply(StageCommand::Instrument(instrument));
                    let bodies = 0..studio.scene().bodies.len();
                    for body in bodies.filter(|body| (i + body + run + time) % 2 == 0) {
                        studio.apply(StageCommand::Body(body));
                        let (scene, name) = (scene.name, instrument.name());
                        let what = format!("{scene}, {mode}, {name}, {body}, {seconds} s");
                        assert_legible(&studio, &what);
                    }
                }
            }
            studio.apply(StageCommand::ToggleRace);
        }
    });
}

#[test]
fn a_plot_in_a_low_window_takes_the_room_of_its_legend() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(StageCommand::ToggleRace);
    (0..240).for_each(|_| studio.tick());
    for size in [vec2(800.0, 450.0), vec2(960.0, 540.0)] {
        let texts = texts(&studio, size);
        let beside = |rect: &Rect| rect.left() > (1.0 - panels::INSTRUMENTS) * size.x;
        let is_nought = |(rect, text): &&(Rect, String)| text == "0" && beside(rect);
        // There is a 0 on the axis of time, and another one between 1 m and −1 m.
        assert_eq!(texts.iter().filter(is_nought).count(), 2, "{size}: {texts:?}");
    }
}

/// A solo run of the ship under explicit Euler, with the plot of its error.
fn ship_at(tick_hz: u32) -> Studio {
    let mut studio = Studio::new(Scene::built_in("ship").unwrap());
    studio.apply(StageCommand::Instrument(Instrument::Error));
    studio.apply(StageCommand::TickHz(tick_hz.into()));
    studio.apply(StageCommand::Restart);
    studio
}

#[test]
fn an_error_before_the_first_tick_is_not_called_zero() {
    let mut studio = ship_at(2);
    let nothing =
        |studio: &Studio| plot_set_of(studio, Detail::Samples).unwrap().plots[0].nothing.clone();
    assert_eq!(nothing(&studio).as_deref(), Some(NOTHING_YET));
    (0..4).for_each(|_| studio.tick());
    assert_eq!(nothing(&studio), None);
}

#[test]
fn a_restart_at_another_tick_rate_keeps_the_run_before_as_a_curve() {
    let mut studio = ship_at(2);
    let before = |studio: &Studio| {
        let set = plot_set_of(studio, Detail::Samples).unwrap();
        let legend: Vec<String> = legend_entries(&set).into_iter().map(|it| it.name).collect();
        let plot = &set.plots[0];
        plot.before.as_ref().map(|before| {
            let [low, high] = plot.fit[1];
            let fits = |y: f64| (low..=high).contains(&y);
            assert!(before.track.along(1).all(fits), "it is within the axis");
            assert!(plot.tracks[0].along(1).all(fits), "so is the present run");
            assert!(legend.contains(&format!("before: {}", before.name)), "{legend:?}");
            (before.name.clone(), before.track.times().unwrap().1)
        })
    };
    assert_eq!(before(&studio), None);
    (0..8).for_each(|_| studio.tick());
    studio.apply(StageCommand::TickHz(5.into()));
    assert_eq!(before(&studio), None, "the run goes on");
    (0..5).for_each(|_| studio.tick());
    studio.apply(StageCommand::Restart);
    assert_eq!(before(&studio), Some(("2 Hz".into(), 4.0)), "up to the change");
    for instrument in [Instrument::Error, Instrument::Motion] {
        studio.apply(StageCommand::Instrument(instrument));
        (0..20).for_each(|_| studio.tick());
        assert_eq!(before(&studio), Some(("2 Hz".into(), 4.0)));
    }
    studio.apply(StageCommand::Restart);
    assert_eq!(before(&studio), Some(("2 Hz".into(), 4.0)), "an equal run replaces nothing");
    (0..20).for_each(|_| studio.tick());
    studio.apply(StageCommand::Pick(2));
    studio.apply(StageCommand::Restart);
    assert_eq!(before(&studio), Some(("Explicit Euler".into(), 4.0)));
    studio.apply(StageCommand::Scene(0));
    assert_eq!(before(&studio), None);
}

#[test]
fn a_changed_law_goes_on_in_the_plot_from_the_curve_before_it() {
    let law = |force: &str| {
        let text = format!(
            "title = \"Swing\"\ntick_hz = 60\nseconds = 5\nmethods = [\"rk4\"]\n\n[[law]]\nname = \"swing\"\n\
             [law.coordinates.x]\nacceleration = \"{force}\"\nstart = 1.0\n"
        );
        Scene::parse("a.toml", &text).unwrap()
    };
    let mut studio = Studio::new(law("-9 * x"));
    open_file(&mut studio, Path::new("a.toml"), law("-9 * x"));
    studio.apply(StageCommand::Instrument(Instrument::Motion));
    (0..50).for_each(|_| studio.tick());
    let at = studio.selected().lane.bodies()[0].stepper.q()[0];
    reload_file(&mut studio, Path::new("a.toml"), law("-16 * x"));
    (0..30).for_each(|_| studio.tick());
    let set = plot_set_of(&studio, Detail::Samples).unwrap();
    let (plot, t) = (&set.plots[0], 50.0 / 60.0);
    let before = plot.before.as_ref().unwrap();
    let (first, last) = (plot.tracks[0].places().next(), before.track.places().last());
    assert_eq!(first.map(|place| place.2), Some([t, at]));
    assert_eq!(last.map(|place| place.2), Some([t, at]));
    assert_eq!(plot.exact[0].times[0], t);
    // After another change, from the first to the second.
    reload_file(&mut studio, Path::new("a.toml"), law("-25 * x"));
    let set = plot_set_of(&studio, Detail::Samples).unwrap();
    let before = set.plots[0].before.as_ref().unwrap();
    assert_eq!(before.track.times(), Some((t, 80.0 / 60.0)));
    // In the past are the motion and the truth of the present law alone.
    studio.apply(RunCommand::Seek(20));
    let set = plot_set_of(&studio, Detail::Samples).unwrap();
    assert_eq!(set.plots[0].tracks[0].times(), Some((0.0, 20.0 / 60.0)));
}

#[test]
fn the_energies_beside_the_plot_are_those_of_the_table() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.apply(StageCommand::ToggleRace);
    studio.apply(StageCommand::Instrument(Instrument::Energy));
    let mut compared = 0;
    for _ in 0..25 {
        (0..4).for_each(|_| _ = studio.advance(123_456_789));
        let texts = texts(&studio, vec2(1904.0, 1000.0));
        let gains = texts.iter().filter(|(_, it)| it.starts_with('+') && it.ends_with(" %"));
        for (_, gain) in gains {
            let is_beside = |(_, text): &(Rect, String)| text == gain.trim_start_matches('+');
            assert!(texts.iter().any(is_beside), "{gain}");
            compared += 1;
        }
    }
    assert!(compared > 50, "{compared}");
}

#[test]
fn every_metric_can_be_plotted() {
    let offered = error::choices().count();
    assert_eq!(offered + 1, METRICS.len(), "and the energy drift");
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.apply(StageCommand::ToggleRace);
    (0..60).for_each(|_| studio.tick());
    studio.apply(StageCommand::Instrument(Instrument::Error));
    for place in error::choices() {
        studio.apply(StageCommand::Metric(place));
        assert_legible(&studio, METRICS[place].name);
    }
}

#[test]
fn the_plot_of_a_halted_truth_says_that_there_is_none() {
    let text = "title = 'x'\ntick_hz = 60\nseconds = 1\nmethods = ['rk4']\n\
                [[spring]]\nmass_kg = 1e-10\nstiffness_n_per_m = 1e-10\nkick_n_s = 1e15\n";
    let mut studio = Studio::new(Scene::parse("kicked.toml", text).unwrap());
    let says = |studio: &Studio, words: &str| {
        texts(studio, vec2(1280.0, 720.0)).iter().any(|(_, text)| text.contains(words))
    };
    assert!(!says(&studio, "no exact solution"));
    studio.apply(RunCommand::Act(Action::Kick(1e15)));
    assert!(says(&studio, "no exact solution"));
}

/// A user of an instrument's plots, which fill the frame.
struct Person(TestWindow);

const FRAME: Vec2 = vec2(500.0, 420.0);

impl Person {
    fn new() -> Self {
        Self(TestWindow::new(FRAME))
    }

    /// Shows a frame after these events. Returns every text in it and the commands.
    fn frame(&mut self, studio: &Studio, events: Vec<Event>) -> (Vec<String>, Vec<Command>) {
        let set = plot_set_of(studio, Detail::Samples).unwrap();
        let mut commands = Vec::new();
        let (_, shown) = self.0.show(events, |ui| chart::show(ui, studio, &set, &mut commands));
        (shown.whole().into_iter().map(|(_, text)| text).collect(), commands)
    }

    /// Shows a frame after these events, and applies the commands. Returns every number in the frame.
    fn numbers(&mut self, studio: &mut Studio, events: Vec<Event>) -> Vec<String> {
        let (texts, commands) = self.frame(studio, events);
        for command in commands {
            studio.apply(command);
        }
        texts.into_iter().filter(|text| is_number(text)).collect()
    }

    fn click(&mut self, studio: &Studio, at: Pos2) -> Vec<Command> {
        self.frame(studio, vec![Event::PointerMoved(at)]);
        let mut commands = self.frame(studio, vec![button(at, true)]).1;
        commands.extend(self.frame(studio, vec![button(at, false)]).1);
        commands
    }
}

fn race_of_springs() -> Studio {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(StageCommand::ToggleRace);
    (0..240).for_each(|_| studio.tick());
    studio
}

#[test]
fn the_pointer_reads_every_curve_at_its_time() {
    let (studio, mut person) = (race_of_springs(), Person::new());
    let (before, _) = person.frame(&studio, Vec::new());
    assert!(!before.iter().any(|text| text.starts_with("t = ")), "{before:?}");
    person.frame(&studio, vec![Event::PointerMoved(FRAME.to_pos2() / 2.0)]);
    let (over, _) = person.frame(&studio, Vec::new());
    assert!(over.iter().any(|text| text.starts_with("t = ")), "{over:?}");
    let values = over.iter().filter(|text| text.ends_with(" m") && !text.contains(',')).count();
    assert_eq!(values, studio.race().entrants().len() + 1, "{over:?}");
}

#[test]
fn a_wheel_zooms_a_drag_pans_and_a_double_click_fits() {
    let (mut studio, mut person) = (race_of_springs(), Person::new());
    let at = FRAME.to_pos2() / 2.0;
    person.numbers(&mut studio, vec![Event::PointerMoved(at)]);
    let fitted = person.numbers(&mut studio, Vec::new());
    let wheel = Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        source: egui::MouseWheelSource::Unknown,
        delta: vec2(0.0, 200.0),
        phase: TouchPhase::Move,
        modifiers: Modifiers::NONE,
    };
    let drawn_whole = svg(&studio).unwrap();
    person.numbers(&mut studio, vec![wheel]);
    (0..40).for_each(|_| drop(person.numbers(&mut studio, Vec::new())));
    let zoomed = person.numbers(&mut studio, Vec::new());
    assert_ne!(zoomed, fitted);
    assert_ne!(svg(&studio).unwrap(), drawn_whole, "what is saved is what is seen");
    let to = at + vec2(-150.0, 0.0);
    person.numbers(&mut studio, vec![button(at, true)]);
    person.numbers(&mut studio, vec![Event::PointerMoved(to)]);
    person.numbers(&mut studio, vec![button(to, false)]);
    let panned = person.numbers(&mut studio, Vec::new());
    assert_ne!(panned, zoomed);
    person.0.time_s += 1.0;
    for _ in 0..2 {
        let asked = person.click(&studio, to);
        for command in asked {
            studio.apply(command);
        }
    }
    person.numbers(&mut studio, vec![Event::PointerMoved(at)]);
    assert_eq!(person.numbers(&mut studio, Vec::new()), fitted);
    assert_eq!(svg(&studio).unwrap(), drawn_whole);
}

#[test]
fn a_click_on_a_curve_selects_its_lane_and_a_click_elsewhere_seeks() {
    let (studio, mut person) = (race_of_springs(), Person::new());
    let set = plot_set_of(&studio, Detail::Samples).unwrap();
    let room = Rect::from_min_size(Pos2::ZERO, FRAME);
    let cell = &layout::cells(&set, room, 40.0, 0)[0];
    // Explicit Euler swings wider than all others.
    let widest = 0;
    let track = set.plots[0].tracks.iter().find(|track| track.entry == widest).unwrap();
    let (_, _, at) = track.places().find(|(t, _, [_, y])| *t > 0.9 && *y > 1.2).unwrap();
    let at = PlotArea { rect: cell.frame, bounds: cell.plot.fit }.at(at);
    let is_pick = |command: &Command| *command == Command::Stage(StageCommand::Pick(widest));
    assert!(person.click(&studio, at).iter().any(is_pick));
    let asked = person.click(&studio, cell.frame.left_bottom() + vec2(9.0, -9.0));
    let t = cell.plot.fit[0][0] + 9.0 / f64::from(cell.frame.width()) * 5.0;
    let tick = studio.run().times().nearest_tick(t.max(0.0));
    assert_eq!(asked, [Command::Run(RunCommand::Seek(tick))]);
}

#[test]
fn a_placement_refits_the_axis_and_breaks_the_exact_line() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(StageCommand::Pick(3));
    (0..120).for_each(|_| studio.tick());
    let place = |q: f64| {
        Command::Run(RunCommand::Act(Action::Place { body: 0, q: [q].into(), v: [0.0].into() }))
    };
    studio.apply(place(8.0));
    (0..300).for_each(|_| studio.tick());
    let top = |studio: &Studio| plot_set_of(studio, Detail::Samples).unwrap().plots[0].fit[1][1];
    assert!((8.0..12.0).contains(&top(&studio)), "{}", top(&studio));
    studio.apply(place(0.5));
    (0..10).for_each(|_| studio.tick());
    assert!(top(&studio) > 8.0, "the new swing has only begun");
    (0..120).for_each(|_| studio.tick());
    assert!((0.5..1.0).contains(&top(&studio)), "{}", top(&studio));
    let set = plot_set_of(&studio, Detail::Samples).unwrap();
    let plot = &set.plots[0];
    let pieces = plot.drawing(&studio, &set.styles, &plot.fit, 400.0).truth;
    let starts: Vec<[f64; 2]> = pieces.iter().map(|curve| curve.points[0]).collect();
    assert_eq!(starts, [[0.0, 1.0], [2.0, 8.0], [7.0, 0.5]]);
    // Arrows mark the places where the exact line leaves the view.
    let white = set.styles.exact_colour;
    let arrows = plot.drawing(&studio, &set.styles, &plot.fit, 400.0).arrows;
    assert!(arrows.iter().any(|arrow| arrow.colour == white && arrow.from[0] < 7.0));
    // A changed parameter also begins a new swing, but without a jump.
    studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: 1, value: 4.0 }));
    let before = studio.past().changed_s();
    assert_eq!(before, studio.race().t());
    studio.apply(RunCommand::Seek(60));
    assert_eq!(studio.past().changed_s(), f64::NEG_INFINITY, "not done yet");
}

#[test]
fn a_reference_shows_its_error_only_once_it_has_one() {
    for scene in ["helm", "pendulum"] {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        let words = |studio: &Studio| studio.race().truth().bodies()[0].truth_in_words();
        let at_start = words(&studio);
        assert!(at_start == "reference" || at_start.contains("10⁻¹"), "{scene}: {at_start}");
        (0..60).for_each(|_| studio.tick());
        assert!(words(&studio).starts_with("reference to 10⁻¹"), "{scene}: {}", words(&studio));
    }
}

#[test]
fn the_cloud_reports_its_area_or_why_there_is_no_cloud() {
    const SIZE: Vec2 = vec2(1280.0, 720.0);
    let said = |studio: &Studio, wanted: &str| {
        texts(studio, SIZE).iter().any(|(_, text)| text.contains(wanted))
    };
    let lab_of = |scene: &str| {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        studio.apply(StageCommand::ToggleRace);
        studio.apply(StageCommand::Instrument(Instrument::Cloud));
        studio.apply(RunCommand::Cloud(CloudChoice { points: 1200, ..CloudChoice::default() }));
        (0..12).for_each(|_| studio.tick());
        studio
    };
    let mut studio = lab_of("liouville");
    assert!(said(&studio, "Stepping the points") && csv(&studio).is_none());
    complete_clouds(&mut studio, &mut CloudWorker::default(), || false);
    for wanted in
        ["Explicit Euler\narea ×1.", "grows ×2 in", "keeps area", "shrinks ×½ in", "t = 1.00 s"]
    {
        assert!(said(&studio, wanted), "{wanted}");
    }
    let table = csv(&studio).unwrap().concat();
    assert!(table.contains(",area / start,,implicit-euler,1,0.") && table.contains(",exact,1,"));
    assert!(svg(&studio).unwrap().contains("<polyline"));
    assert!(said(&lab_of("orbit"), "satellite has 2"));
}

#[test]
fn clouds_and_their_images_are_freed_with_their_instrument() {
    let mut studio = Studio::new(Scene::built_in("liouville").unwrap());
    let mut window = TestWindow::new(vec2(1280.0, 720.0));
    let mut images_under = |studio: &mut Studio, instrument| {
        studio.apply(StageCommand::Instrument(instrument));
        studio.advance(0);
        let is_there = shown_cloud(studio).is_some();
        complete_clouds(studio, &mut CloudWorker::default(), || false);
        window.panels(studio, Vec::new());
        (window.context.tex_manager().read().num_allocated(), is_there)
    };
    let [before, with, after, again] =
        [Instrument::Motion, Instrument::Cloud, Instrument::Motion, Instrument::Cloud]
            .map(|instrument| images_under(&mut studio, instrument));
    assert!(with.0 > before.0 && again.0 == with.0 && !again.1, "{before:?}, {with:?}, {again:?}");
    assert_eq!(after, before);
}

#[test]
fn curves_outside_the_scale_are_reported() {
    let mut studio = Studio::new(Scene::with_two_springs());
    (0..60).for_each(|_| studio.tick());
    // The sizes are a window of 1280 × 720 at 125 and 175 %, one of 2560 × 1440 at 175 %, and a small one.
    for (size, all, spring) in [
        ([1024.0, 576.0], true, "My spring"),
        ([731.0, 411.0], false, "Spring"),
        ([1462.0, 822.0], true, "My spring"),
        ([800.0, 600.0], true, "My spring"),
    ] {
        let texts = texts(&studio, size.into());
        let is_there = |wanted: &str, left: f32| {
            texts.iter().any(|(rect, text)| text == wanted && rect.left() >= left)
        };
        let left = (1.0 - panels::INSTRUMENTS) * size[0];
        let plots =
            studio.scene().bodies.iter().filter(|body| is_there(&capitalised(&body.name), left));
        let plots = plots.count();
        let has_all = plots == studio.scene().bodies.len();
        assert_eq!(has_all, all, "{size:?}: {plots}");
        assert_eq!(is_there("not all plots fit", left), !all, "{size:?}");
        let top: Vec<_> = texts.iter().filter(|(rect, _)| rect.bottom() < 40.0).collect();
        assert!(top.iter().any(|(_, text)| text == spring), "{size:?}: {top:?}");
        // No two texts of the top bar overlap.
        for (at, (rect, text)) in top.iter().enumerate() {
            let over = top[at + 1..].iter().find(|(other, _)| other.shrink(1.0).intersects(*rect));
            assert!(over.is_none(), "{size:?}: {text} and {over:?}");
        }
    }
}
