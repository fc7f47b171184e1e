use egui::{Context, Event, Modifiers, PointerButton, RawInput, Shape};

use super::words::{counted, notes};
use super::*;
use crate::lab::{Instrument, RunCommand, Scene, StageCommand, Step};
use crate::view::panels;
use crate::view::theme;

fn lab(scene: &str) -> Lab {
    let mut lab = Lab::new(Scene::built_in(scene).unwrap());
    lab.apply(StageCommand::Instrument(Instrument::StabilityMap));
    lab.analyse();
    lab
}

/// Shows a frame. Returns the commands and every text.
fn frame(context: &Context, lab: &Lab, events: Vec<Event>) -> (Vec<Command>, Vec<(Rect, String)>) {
    let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0)));
    let input = RawInput { screen_rect, events, ..RawInput::default() };
    let mut commands = Vec::new();
    let mut output = context.run_ui(input, |ui| commands = panels::show(ui, lab).0);
    output.textures_delta.clear();
    let texts = output.shapes.iter().filter_map(|shape| match &shape.shape {
        Shape::Text(text) => Some((text.visual_bounding_rect(), text.galley.text().to_owned())),
        _ => None,
    });
    (commands, texts.collect())
}

#[test]
fn the_cross_sets_rate_and_parameter_where_it_is_dragged_to() {
    let mut lab = lab("stiff");
    let context = Context::default();
    theme::dress(&context);
    let (commands, texts) = frame(&context, &lab, Vec::new());
    assert_eq!(commands, []);
    let chip = texts.iter().find(|(_, text)| text == "you are here").expect("a chip").0;
    let at = chip.center() + vec2(0.0, 15.0);
    let button = |pressed: bool, pos: Pos2| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    frame(&context, &lab, vec![Event::PointerMoved(at), button(true, at)]);
    let to = at + vec2(30.0, -35.0);
    let (commands, _) = frame(&context, &lab, vec![Event::PointerMoved(to)]);
    let [
        Command::Stage(StageCommand::TickHz(hz)),
        Command::Run(RunCommand::Act(Action::Set { body: 0, parameter: 1, value })),
    ] = &commands[..]
    else {
        panic!("{commands:?}")
    };
    assert!((61..1000).contains(hz) && *value > 1e4, "{hz} Hz, {value} N/m");
    for command in commands {
        lab.apply(command);
    }
    // Where it is now, nothing changes.
    let (commands, _) = frame(&context, &lab, vec![]);
    assert_eq!(commands, []);
    frame(&context, &lab, vec![button(false, to)]);
}

#[test]
fn the_sentence_counts_the_stable_methods() {
    let lab = lab("stiff");
    let map = lab.viewer().stability_map().unwrap();
    assert_eq!(
        counted(map).split(" Explicit").next().unwrap(),
        // At 60 Hz ω h is 1.67.
        "2 of 4 methods are stable."
    );
    assert!(notes(map).contains("Explicit Euler, Improved Euler are stable nowhere on this map."));
    assert!(notes(map).contains("Adaptive Euler picks its own steps"));
    assert_eq!(point_in_words(&lab, 1, 20, 90.0), "20 Hz, k = 90 N/m");
}

#[test]
fn a_body_without_a_map_says_why() {
    let context = Context::default();
    theme::dress(&context);
    let (_, texts) = frame(&context, &lab("orbit"), Vec::new());
    assert!(texts.iter().any(|(_, text)| text.starts_with("No stability map")), "{texts:?}");
}

#[test]
fn arrow_keys_move_the_focused_cross_by_rates_and_by_factors_of_the_parameter() {
    let mut lab = lab("stiff");
    let context = Context::default();
    theme::dress(&context);
    frame(&context, &lab, Vec::new());
    context.memory_mut(|memory| memory.request_focus(Id::unique(CROSS_ID)));
    frame(&context, &lab, Vec::new());
    let (commands, _) = frame(&context, &lab, vec![press(Key::ArrowUp)]);
    let [Command::Run(RunCommand::Act(Action::Set { value, .. }))] = &commands[..] else {
        panic!("{commands:?}")
    };
    let before = lab.race().values(0)[1];
    assert!((value / before / 1.122 - 1.0).abs() < 5e-3, "{before} to {value}");
    for command in commands {
        lab.apply(command);
    }
    let (commands, _) = frame(&context, &lab, vec![press(Key::ArrowRight)]);
    assert_eq!(commands, [Command::Stage(StageCommand::TickRate(Step::Next))]);
}

fn press(key: Key) -> Event {
    Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }
}

#[test]
fn a_boundary_is_labelled_with_its_limit_where_nothing_is_damped() {
    let context = Context::default();
    theme::dress(&context);
    let (_, texts) = frame(&context, &lab("spring"), Vec::new());
    assert!(texts.iter().any(|(_, text)| text.ends_with(": ω h < 2")), "{texts:?}");
    let mut damped = Lab::new(Scene::built_in("harbour").unwrap());
    damped.apply(StageCommand::Instrument(Instrument::StabilityMap));
    damped.apply(StageCommand::Body(1));
    damped.analyse();
    let map = damped.viewer().stability_map().unwrap();
    assert!(map.regions.iter().all(|region| region.limit.is_none()));
}

#[test]
fn the_lines_of_equal_damping_of_the_selected_engine_are_labelled_and_explained() {
    let context = Context::default();
    theme::dress(&context);
    let mut lab = lab("engines");
    let words = |lab: &Lab| {
        let (_, texts) = frame(&context, lab, Vec::new());
        texts.into_iter().map(|(_, text)| text).collect::<Vec<_>>().join("\n")
    };
    let shown = words(&lab);
    for part in ["damping 0.05", "damping 0.1", "the damping ratio that a player sees of Box2D"] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
    // An undamped spring of Bullet is seen undamped.
    lab.apply(StageCommand::Pick(6));
    assert!(!words(&lab).contains("damping 0."));
}
