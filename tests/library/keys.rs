//! The effect of keys on a run, read from the title. A separate test covers the keys in a real window.

use regatta::scene::{SCENES, Scene};
use regatta::studio::{Instrument, KEYS, Key, StageCommand, Studio, TICK_LADDER};

/// Performs the command of a key.
fn press(studio: &mut Studio, key: Key) {
    let mut all = KEYS.iter().flat_map(|binding| binding.keys);
    let (_, command) = all.find(|(other, _)| *other == key).expect("a key of the table");
    assert_eq!(studio.apply(command.clone()), None);
}

fn studio(scene: &str) -> Studio {
    Studio::new(Scene::built_in(scene).unwrap())
}

#[test]
fn a_race_is_titled_by_its_selected_lane() {
    let mut studio = studio("stiff");
    let mut title_after = |keys: &[Key]| {
        keys.iter().for_each(|key| press(&mut studio, *key));
        studio.title()
    };
    assert_eq!(title_after(&[]), "Regatta - stiff - Semi-implicit Euler - 60 Hz");
    let race = title_after(&[Key::Sign('c')]);
    assert_eq!(race, "Regatta - stiff - race: Semi-implicit Euler - 60 Hz");
    let paused = title_after(&[Key::Digit(1), Key::Space]);
    assert_eq!(paused, "Regatta - stiff - race: Explicit Euler - 60 Hz (paused, tick 0)");
    let solo = title_after(&[Key::Sign('c')]);
    assert_eq!(solo, "Regatta - stiff - Explicit Euler - 60 Hz (paused, tick 0)");
}

#[test]
fn brackets_walk_the_tick_rates_and_n_and_b_the_scenes() {
    let mut studio = studio("spring");
    studio.apply(StageCommand::TickHz(2.into()));
    let start = "Regatta - spring - Explicit Euler - 2 Hz";
    let up = TICK_LADDER.into_iter().map(|hz| (hz, ']'));
    let down = TICK_LADDER.into_iter().rev().map(|hz| (hz, '['));
    for (hz, key) in up.chain(down) {
        assert_eq!(studio.title(), format!("Regatta - spring - Explicit Euler - {hz} Hz"));
        press(&mut studio, Key::Sign(key));
    }
    assert_eq!(studio.title(), start);
    let mut walk = |key: char| -> Vec<String> {
        let mut title_of = |_| {
            press(&mut studio, Key::Sign(key));
            studio.deck.scene_name()
        };
        SCENES.iter().map(&mut title_of).collect()
    };
    let (there, mut back) = (walk('n'), walk('b'));
    back.reverse();
    back.rotate_left(1);
    assert_eq!(there, back);
    assert_eq!(there.last().map(String::as_str), Some("spring"));
}

#[test]
fn the_first_press_of_an_instrument_key_opens_the_instruments() {
    let alone = || {
        let mut studio = studio("harbour");
        studio.viewer.preferences.display.measure = false;
        studio
    };
    for (key, shows) in [
        (Key::Sign('t'), true),
        (Key::Sign('d'), true),
        (Key::ShiftSign('d'), true),
        (Key::Sign('c'), true),
        (Key::Sign('e'), true),
        (Key::Sign('l'), true),
        (Key::Enter, true),
        (Key::Function(2), true),
        (Key::Digit(2), false),
        (Key::Space, false),
        (Key::Sign('k'), false),
        (Key::Sign('g'), false),
        (Key::Home, false),
        (Key::Sign('n'), false),
        // A dialog lies over the stage.
        (Key::Sign('s'), false),
    ] {
        let mut studio = alone();
        press(&mut studio, key);
        assert_eq!(studio.display().measure, shows, "{key}");
    }
    let mut studio = alone();
    studio.apply(StageCommand::Instrument(Instrument::Energy));
    assert!(studio.display().measure, "a tab");
    press(&mut studio, Key::Sign('t'));
    assert!(!studio.display().measure);
    press(&mut studio, Key::Sign('n'));
    assert!(!studio.display().measure, "the next scene has the stage alone too");
    press(&mut studio, Key::Sign('t'));
    assert_eq!(studio.display().instrument, Instrument::Energy);
}

#[test]
fn the_loop_lab_always_shows_its_instruments() {
    let mut studio = studio("spring");
    studio.viewer.preferences.display.measure = false;
    press(&mut studio, Key::Sign('l'));
    for _ in 0..2 {
        assert!(studio.loop_lab().is_some() && studio.display().measure);
        studio.viewer.notice = None;
        press(&mut studio, Key::Sign('t'));
        let said = studio.viewer.notice.as_deref().expect("why nothing happens");
        assert!(said.contains("instruments") && said.contains("L leaves"), "{said}");
    }
    press(&mut studio, Key::Sign('l'));
    assert!(studio.loop_lab().is_none() && !studio.display().measure, "it is as it was");
    press(&mut studio, Key::Sign('l'));
    studio.apply(StageCommand::ToggleRace);
    assert!(studio.loop_lab().is_none() && studio.display().measure, "a race has a table");
}
