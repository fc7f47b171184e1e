//! Going back and forth in a run, checked by the title.

use image::RgbaImage;

use crate::desk::{Desk, until};

/// The height of the track in a window of 1280 × 720, above the row of the one lane, the methods and the footer.
const TRACK_Y: u32 = 576;

const PAUSED: &str = "Regatta - spring - Explicit Euler - 60 Hz (paused)";

/// The spring, paused at least two seconds after its start, and its tick.
fn paused() -> (Desk, u64) {
    let desk = Desk::open("--scene spring");
    desk.press("space");
    let tick = desk.tick_of(PAUSED);
    desk.press("shift+period shift+period");
    desk.at_tick(tick + 120);
    (desk, tick + 120)
}

pub(crate) fn a_paused_window_steps_ticks_and_seconds_back_and_forth() {
    let (desk, tick) = paused();
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

pub(crate) fn control_z_restores_the_future_discarded_by_an_action_in_the_past() {
    let (desk, tick) = paused();
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

pub(crate) fn a_mark_on_the_timeline_has_a_tooltip_with_a_line_for_each_action() {
    let (desk, tick) = paused();
    // At the start, whose place on the track is known.
    for _ in 0..=tick / 60 {
        desk.press("shift+comma");
    }
    desk.at_tick(0);
    desk.press("2");
    desk.press("bracketleft");
    desk.press("shift+period");
    until("a second", || (!desk.title().contains("tick 0)")).then_some(()));
    // Pixels near the pointer that a tooltip changes, on the stage and the track.
    let told_at = |x: u32| {
        desk.xdotool("mousemove --window WINDOW 600 300");
        desk.still();
        let before = desk.sight();
        desk.xdotool(&format!("mousemove --window WINDOW {x} {TRACK_Y}"));
        until("a tooltip", || (changed(&before, &desk.sight(), x) > 0).then_some(()));
        desk.still();
        changed(&before, &desk.sight(), x)
    };
    // Between marks it is the moment alone.
    let (mark, moment) = (told_at(24), told_at(700));
    assert!(mark > moment * 3 / 2, "{mark} {moment}");
    desk.quit();
}

/// How many pixels differ right of the pointer at `x` and near the height of the timeline.
fn changed(before: &RgbaImage, after: &RgbaImage, x: u32) -> usize {
    let places = (TRACK_Y - 42..TRACK_Y + 128).flat_map(|y| (x + 8..x + 400).map(move |x| (x, y)));
    places.filter(|&(x, y)| before.get_pixel(x, y) != after.get_pixel(x, y)).count()
}

pub(crate) fn a_drag_along_the_timeline_seeks_to_the_tick_under_the_mouse() {
    let (desk, tick) = paused();
    let at = |x: u32| desk.xdotool(&format!("mousemove --window WINDOW {x} {TRACK_Y}"));
    at(32);
    desk.xdotool("mousedown 1");
    let near_the_start = desk.tick_within(0..=30);
    at(85);
    let later = desk.tick_within(near_the_start + 30..=119);
    at(57);
    desk.tick_within(near_the_start + 1..=later - 1);
    at(1200);
    desk.at_tick(tick);
    desk.xdotool("mouseup 1");
    // In one frame with the release the key would come before it.
    desk.still();
    desk.press("comma");
    desk.at_tick(tick - 1);
    desk.quit();
}
