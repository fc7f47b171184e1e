//! Editing in the inspector, checked by the title.

use std::thread;
use std::time::Duration;

use crate::desk::Desk;

pub(crate) fn typing_into_the_inspector_edits_and_triggers_no_other_key() {
    let desk = Desk::open("--scene spring");
    desk.press("space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    // High enough for the line to be in sight.
    desk.resize(1280, 900);
    desk.press_and_see("e");
    desk.still();
    let type_in_the_tick_rate = |keys| {
        desk.click(1185, 615);
        desk.still();
        desk.press(keys);
        desk.still();
    };
    type_in_the_tick_rate("9 0 Return");
    desk.titled("Regatta - spring - Explicit Euler - 90 Hz (paused)");
    // None of these is a number, and each is a key elsewhere.
    type_in_the_tick_rate("n space c 2 Return");
    desk.titled("Regatta - spring - Explicit Euler - 90 Hz (paused)");
    // Escape leaves the field, then closes the inspector.
    type_in_the_tick_rate("2 0 Escape");
    desk.titled("Regatta - spring - Explicit Euler - 90 Hz (paused)");
    desk.press_and_see("Escape");
    // All of it was one change.
    desk.press("ctrl+z");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    desk.press("ctrl+shift+z space");
    desk.titled("Regatta - spring - Explicit Euler - 90 Hz");
    desk.quit();
}

pub(crate) fn time_advances_while_a_parameter_is_swept() {
    let desk = Desk::open("--scene spring");
    let paused = "Regatta - spring - Explicit Euler - 60 Hz (paused)";
    desk.press("space");
    desk.titled(paused);
    desk.resize(1280, 900);
    desk.press_and_see("e");
    desk.still();
    let from = desk.tick_of(paused);
    // The button next to the stiffness, which then changes with each frame for eight seconds.
    desk.click(965, 392);
    desk.press("space");
    thread::sleep(Duration::from_secs(3));
    desk.press("space");
    desk.titled(paused);
    let ticks = desk.tick_of(paused) - from;
    assert!((45..=400).contains(&ticks), "{ticks} ticks in three seconds of edits");
    // All of it is one change.
    desk.press("ctrl+z");
    desk.at_tick(from);
    desk.quit();
}
