//! The effect of keys, read from the title and compared with a studio under the same commands.

use std::time::{Duration, Instant};

use regatta::loops::loop_lab::LoopCommand;
use regatta::scene::Scene;
use regatta::studio::{Command, DriverRequest, KEYS, Key, StageCommand, Step, Studio, ViewCommand};

use crate::desk::Desk;

fn studio(scene: &str) -> Studio {
    Studio::new(Scene::built_in(scene).unwrap())
}

/// The key's name in X, with its modifier.
fn x_name(key: Key) -> String {
    match key {
        Key::Digit(digit) => digit.to_string(),
        Key::Sign('.') => "period".into(),
        Key::Sign('[') => "bracketleft".into(),
        Key::Sign(']') => "bracketright".into(),
        Key::Sign('-') => "minus".into(),
        Key::Sign('=') => "equal".into(),
        Key::Sign('?') => "question".into(),
        Key::Sign(',') => "comma".into(),
        Key::Sign(letter) => letter.to_string(),
        Key::ShiftSign(',') => "shift+comma".into(),
        Key::ShiftSign('.') => "shift+period".into(),
        Key::ControlSign('+') => "ctrl+plus".into(),
        Key::ControlSign('-') => "ctrl+minus".into(),
        Key::ControlSign('=') => "ctrl+equal".into(),
        Key::ControlSign(letter) => format!("ctrl+{letter}"),
        Key::ControlShiftSign(letter) => format!("ctrl+shift+{letter}"),
        Key::ShiftSign(letter) => format!("shift+{letter}"),
        Key::Space => "space".into(),
        Key::Up => "Up".into(),
        Key::Left => "Left".into(),
        Key::Right => "Right".into(),
        Key::Down => "Down".into(),
        Key::Home => "Home".into(),
        Key::PageUp => "Page_Up".into(),
        Key::PageDown => "Page_Down".into(),
        Key::Enter => "Return".into(),
        Key::Escape => "Escape".into(),
        Key::Function(number) => format!("F{number}"),
    }
}

pub(crate) fn every_key_performs_its_command_from_the_table() {
    let desk = Desk::open("--scene spring");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz");
    let mut studio = studio("spring");
    for (key, command) in KEYS.iter().flat_map(|binding| binding.keys) {
        // Where a path or a number is typed, keys are text.
        let others = [
            Command::Ask(DriverRequest::Screenshot),
            Command::Ask(DriverRequest::Record),
            Command::Ask(DriverRequest::Report),
            Command::Ask(DriverRequest::CopyLink),
            Command::View(ViewCommand::Copy),
            Command::Ask(DriverRequest::ExportInstrument),
            Command::Ask(DriverRequest::ToggleFullScreen),
            Command::View(ViewCommand::AskForPath),
            Command::View(ViewCommand::AskForRun),
            Command::View(ViewCommand::AskForSpring),
            Command::View(ViewCommand::AskForLines),
            // Digits open figures from its list.
            Command::View(ViewCommand::ToggleFigures),
            // It opens a scene, and lets time run.
            Command::View(ViewCommand::ToggleGuide),
            Command::View(ViewCommand::Escape),
        ];
        if *command == Command::Loop(LoopCommand::ToggleLab) {
            // The other keys do other things in the loop lab.
            for _ in 0..2 {
                desk.press(&x_name(*key));
                assert_eq!(studio.apply(command.clone()), None);
                desk.titled(&studio.title());
            }
        } else if !others.contains(command) {
            desk.press(&x_name(*key));
            assert_eq!(studio.apply(command.clone()), None);
            // A race selects the lane with the best verdict, once the verdicts are known.
            studio.analyse();
            desk.titled(&studio.title());
        }
    }
    // Three keys opened, closed and opened the help.
    assert!(studio.display().help && studio.display().inspector && studio.display().enlarged);
    assert!(!studio.running());
    desk.press_and_see("Escape");
    desk.press_and_see("Escape");
    desk.press_and_see("Escape");
    desk.press("space");
    studio.apply(ViewCommand::TogglePause);
    desk.titled(&studio.title());
    desk.quit();
}

pub(crate) fn keys_work_in_the_loop_lab_and_leaving_it_restores_the_run() {
    let desk = Desk::open("--scene spring --loop");
    let mut studio = studio("spring");
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    desk.titled("Regatta - spring - loop lab: Fixed - edge - 60 Hz");
    for (keys, commands) in [
        ("space", vec![Command::View(ViewCommand::TogglePause)]),
        ("6", vec![Command::Stage(StageCommand::Pick(5))]),
        ("d", vec![Command::Stage(StageCommand::InstrumentBeside(Step::Next))]),
        (
            "v shift+d d",
            vec![
                Command::Stage(StageCommand::ToggleArrangement),
                Command::Stage(StageCommand::InstrumentBeside(Step::Previous)),
                Command::Stage(StageCommand::InstrumentBeside(Step::Next)),
            ],
        ),
        ("bracketright", vec![Command::Stage(StageCommand::TickRate(Step::Next))]),
        (
            "m n period",
            vec![
                Command::Stage(StageCommand::MethodBeside(Step::Next)),
                Command::Stage(StageCommand::SceneBeside(Step::Next)),
                Command::Stage(StageCommand::Tick(Step::Next)),
            ],
        ),
        ("l", vec![Command::Loop(LoopCommand::ToggleLab)]),
    ] {
        desk.press(keys);
        commands.into_iter().for_each(|command| _ = studio.apply(command));
        desk.titled(&studio.title());
    }
    assert!(!studio.title().contains("loop lab") && studio.running());
    desk.quit();
}

pub(crate) fn a_tick_forward_is_one_tick() {
    let desk = Desk::open("--scene spring");
    desk.press("period");
    let first = desk.tick_of("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    desk.press("period period period");
    desk.at_tick(first + 3);
    assert_eq!(desk.screenshot().0, first + 3);
    desk.quit();
}

pub(crate) fn a_held_key_repeats_where_useful_but_never_a_toggle() {
    let desk = Desk::open("--scene spring --tick-hz 1000");
    desk.xdotool("keydown bracketleft");
    desk.titled("Regatta - spring - Explicit Euler - 2 Hz");
    desk.xdotool("keyup bracketleft keydown space");
    let paused = "Regatta - spring - Explicit Euler - 2 Hz (paused)";
    desk.titled(paused);
    let held = desk.title();
    // The server repeats a key after two thirds of a second, then 25 times a second.
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(1) {
        assert_eq!(desk.title(), held);
    }
    desk.quit();
}

pub(crate) fn unbound_chords_with_control_or_alt_are_ignored() {
    let desk = Desk::open("--scene spring");
    desk.press("ctrl+n alt+1 ctrl+space super+c Caps_Lock m");
    // With capitals locked, M is still the next method.
    desk.titled("Regatta - spring - Semi-implicit Euler - 60 Hz");
    desk.quit();
}

pub(crate) fn the_guide_opens_a_waiting_stop_and_escape_returns_to_the_run() {
    let desk = Desk::open("--scene spring");
    desk.press("F2");
    // Time waits for the prediction.
    desk.titled("Regatta - ship - Runge-Kutta 4 - 10 Hz (paused)");
    desk.press_and_see("Escape");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz");
    desk.quit();
}

pub(crate) fn slow_loops_do_not_block_the_window() {
    let folder = tempfile::TempDir::new().unwrap();
    let scene = folder.path().join("long.toml");
    let chain = std::fs::read_to_string("assets/scenes/chain.toml").unwrap();
    let text = chain
        .replace("tick_hz = 60", "tick_hz = 10000")
        .replace("masses = 16", "masses = 256")
        .replace("stiffness_n_per_m = 800", "stiffness_n_per_m = 2000");
    std::fs::write(&scene, text).unwrap();
    let desk = Desk::open(&format!("--scene {}", scene.display()));
    desk.press("space");
    let loops = |hz: u32| format!("Regatta - long.toml - loop lab: Fixed - edge - {hz} Hz");
    for (key, title) in [("l", loops(10_000)), ("bracketleft", loops(1000))] {
        desk.press(key);
        desk.titled(&title);
        // Millions of steps of a chain, long after the title.
        let load = desk.load_over(Duration::from_millis(500));
        assert!(load > 0.1, "{key}: {load} of a core");
    }
    desk.quit();
}
