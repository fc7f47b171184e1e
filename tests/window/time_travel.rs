//! Going back and forth in a run, as the title tells.

use crate::desk::Desk;

const PAUSED: &str = "Regatta - spring - Explicit Euler - 60 Hz (paused)";

/// The spring of `test`, paused at least two seconds after its start, and the tick it stands at.
fn paused(test: &str) -> Option<(Desk, u64)> {
    let desk = Desk::open(test, "--scene spring")?;
    desk.press("space");
    let tick = desk.tick_of(PAUSED);
    desk.press("shift+period shift+period");
    desk.at_tick(tick + 120);
    Some((desk, tick + 120))
}

#[test]
fn a_paused_window_goes_ticks_and_seconds_back_and_forth() {
    let test = "a_paused_window_goes_ticks_and_seconds_back_and_forth";
    let Some((desk, tick)) = paused(test) else { return };
    for (key, to) in [
        ("period", tick + 1),
        ("comma", tick),
        ("comma", tick - 1),
        ("shift+comma", tick - 61),
        ("shift+period", tick - 1),
        ("shift+period", tick + 59),
    ] {
        desk.press(key);
        desk.at_tick(to);
    }
    // There is nothing before the start.
    for _ in 0..=tick / 60 + 1 {
        desk.press("shift+comma");
    }
    desk.at_tick(0);
    desk.quit();
}

#[test]
fn control_z_brings_back_the_future_that_an_action_in_the_past_discarded() {
    let test = "control_z_brings_back_the_future_that_an_action_in_the_past_discarded";
    let Some((desk, tick)) = paused(test) else { return };
    desk.press("shift+comma");
    desk.at_tick(tick - 60);
    desk.press("2");
    desk.titled("Regatta - spring - Semi-implicit Euler - 60 Hz (paused)");
    desk.press("ctrl+z");
    desk.titled(PAUSED);
    desk.at_tick(tick - 60);
    desk.press("shift+period");
    desk.at_tick(tick);
    desk.quit();
}

#[test]
fn a_drag_along_the_timeline_goes_to_the_tick_under_the_mouse() {
    let test = "a_drag_along_the_timeline_goes_to_the_tick_under_the_mouse";
    let Some((desk, tick)) = paused(test) else { return };
    // Under the stage of a window of 1280 × 720 with five rows of lanes.
    desk.xdotool("mousemove --window WINDOW 90 545 mousedown 1");
    let near_the_start = desk.tick_within(0..=30);
    desk.xdotool("mousemove --window WINDOW 140 545");
    let later = desk.tick_within(near_the_start + 30..=119);
    desk.xdotool("mousemove --window WINDOW 115 545");
    desk.tick_within(near_the_start + 1..=later - 1);
    desk.xdotool("mousemove --window WINDOW 1200 545");
    desk.at_tick(tick);
    desk.xdotool("mouseup 1");
    desk.press("comma");
    desk.at_tick(tick - 1);
    desk.quit();
}
