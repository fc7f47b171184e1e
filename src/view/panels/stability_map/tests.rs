use egui::{Event, Modifiers};

use super::*;
use crate::scene::Scene;
use crate::studio::{Instrument, RunCommand, StageCommand, Step};
use crate::tests::testing::{TestWindow, button};

fn studio(scene: &str) -> Studio {
    let mut studio = Studio::new(Scene::built_in(scene).unwrap());
    studio.apply(StageCommand::Instrument(Instrument::StabilityMap));
    studio.analyse();
    studio
}

fn window() -> TestWindow {
    TestWindow::new([1280.0, 720.0])
}

#[test]
fn dragging_the_cross_sets_rate_and_parameter() {
    let mut studio = studio("stiff");
    let mut window = window();
    let (commands, shown) = window.panels(&studio, Vec::new());
    assert_eq!(commands, []);
    let all = shown.all();
    let chip = all.iter().find(|(_, text)| text == "you are here").expect("a chip").0;
    let at = chip.center() + vec2(0.0, 15.0);
    window.panels(&studio, vec![Event::PointerMoved(at), button(at, true)]);
    let to = at + vec2(30.0, -35.0);
    let (commands, _) = window.panels(&studio, vec![Event::PointerMoved(to)]);
    let [
        Command::Stage(StageCommand::TickHz(hz)),
        Command::Run(RunCommand::Act(Action::Set { body: 0, parameter: 1, value })),
    ] = &commands[..]
    else {
        panic!("{commands:?}")
    };
    assert!(*hz > 60 && *hz < 1000 && *value > 1e4, "{hz} Hz, {value} N/m");
    for command in commands {
        studio.apply(command);
    }
    // A press on the cross at its present place changes nothing.
    let (commands, _) = window.panels(&studio, vec![]);
    assert_eq!(commands, []);
    window.panels(&studio, vec![button(to, false)]);
}

#[test]
fn the_sentence_counts_the_stable_methods() {
    let studio = studio("stiff");
    let map = studio.viewer.stability_map().unwrap();
    assert_eq!(
        map.stable_here().split(" Explicit").next().unwrap(),
        // The product ω h is 1.67 at 60 Hz.
        "2 of 5 methods are bounded, 1 chooses its own steps."
    );
    assert!(
        map.not_drawn().contains("Explicit Euler, Improved Euler are bounded nowhere on this map.")
    );
    assert!(map.not_drawn().contains("Adaptive Euler chooses its own steps"));
    assert_eq!(point_in_words(&studio, 1, 20.into(), 90.0), "20 Hz, k = 90 N/m");
}

#[test]
fn a_body_without_a_map_shows_the_reason() {
    let mut window = window();
    let texts = window.panels(&studio("orbit"), Vec::new()).1.words();
    assert!(texts.iter().any(|text| text.starts_with("No stability map")), "{texts:?}");
}

#[test]
fn arrow_keys_step_the_focused_cross_in_rate_and_parameter() {
    let mut studio = studio("stiff");
    let mut window = window();
    window.panels(&studio, Vec::new());
    window.context.memory_mut(|memory| memory.request_focus(Id::unique(CROSS_ID)));
    window.panels(&studio, Vec::new());
    let (commands, _) = window.panels(&studio, vec![press(Key::ArrowUp)]);
    let [Command::Run(RunCommand::Act(Action::Set { value, .. }))] = &commands[..] else {
        panic!("{commands:?}")
    };
    let before = studio.race().values(0)[1];
    assert!((value / before / 1.122 - 1.0).abs() < 5e-3, "{before} to {value}");
    for command in commands {
        studio.apply(command);
    }
    let (commands, _) = window.panels(&studio, vec![press(Key::ArrowRight)]);
    assert_eq!(commands, [Command::Stage(StageCommand::TickRate(Step::Next))]);
}

fn press(key: Key) -> Event {
    Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }
}

#[test]
fn a_boundary_is_labelled_with_its_limit_where_nothing_is_damped() {
    let mut window = window();
    let texts = window.panels(&studio("spring"), Vec::new()).1.words();
    assert!(texts.iter().any(|text| text.ends_with(": ω h < 2")), "{texts:?}");
    let mut damped = Studio::new(Scene::built_in("damped").unwrap());
    damped.apply(StageCommand::Instrument(Instrument::StabilityMap));
    damped.analyse();
    let map = damped.viewer.stability_map().unwrap();
    assert!(map.regions.iter().all(|region| region.limit.is_none()));
}

#[test]
fn a_label_is_nearest_to_its_own_boundary() {
    let rect = Rect::from_min_max(pos2(0.0, 0.0), pos2(400.0, 300.0));
    let line = |y: f32| (0..=100).map(|i| pos2(4.0 * i as f32, y)).collect::<Vec<Pos2>>();
    for (own, other) in [(100.0, 112.0), (112.0, 100.0), (150.0, 158.0)] {
        let places = label_places(&line(own), 60.0, rect, &[]);
        let clear = places.iter().filter(|place| is_clear(place, 60.0, &line(other)));
        let heights: Vec<f32> = clear.map(|(at, _)| at.y).collect();
        assert!(!heights.is_empty(), "{own} beside {other}");
        assert!(heights.iter().all(|y| (y - own).abs() < (y - other).abs()), "{heights:?}");
    }
}

#[test]
fn lines_of_equal_damping_of_the_selected_engine_are_labelled() {
    let mut window = window();
    let mut studio = studio("engines");
    let mut words = |studio: &Studio| window.panels(studio, Vec::new()).1.words().join("\n");
    let shown = words(&studio);
    for part in ["damping 0.05", "damping 0.1", "the damping ratio that a player sees of Box2D"] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
    // An undamped spring of Bullet looks undamped to a player.
    studio.apply(StageCommand::Pick(6));
    assert!(!words(&studio).contains("damping 0."));
}

#[test]
fn every_boundary_has_its_name() {
    for scene in ["harbour", "stiff", "engines", "damped", "quarter-car"] {
        let studio = studio(scene);
        let map = studio.viewer.stability_map().expect("a map");
        for size in [[1280.0, 720.0], [960.0, 600.0]] {
            let words = TestWindow::new(size).panels(&studio, Vec::new()).1.words();
            for (region, (entry, _)) in map.regions.iter().zip(&map.request.specs) {
                let name = numbered(*entry, &studio.lane_name(*entry));
                let is_named = words.iter().any(|text| text.starts_with(&name));
                assert!(is_named || region.boundary.is_empty(), "{scene} {size:?}: {name}");
            }
        }
    }
}

#[test]
fn a_corner_with_only_an_implicit_method_stable_is_labelled() {
    let words = window().panels(&studio("quarter-car"), Vec::new()).1.words();
    assert!(words.contains(&"only 5 Implicit midpoint is bounded here".to_owned()), "{words:?}");
}
