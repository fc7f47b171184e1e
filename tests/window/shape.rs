//! The window's size, and its content.

use std::collections::HashSet;

use crate::desk::Desk;

pub(crate) fn window_and_screenshot_agree_at_every_scale() {
    // The screen of 1500 pixels has no room for 1440 and the bars of a desktop.
    for (scale, height) in [(1, 720), (2, 1340)] {
        let factor = scale.to_string();
        let variables = [("WINIT_X11_SCALE_FACTOR", factor.as_str())];
        let desk = Desk::open_with("--scene spring", &variables);
        desk.press("space");
        desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
        let (_, picture) = desk.screenshot();
        assert_eq!(picture.dimensions(), (1280 * scale, height));
        let colours: HashSet<_> = picture.pixels().collect();
        assert!(colours.len() > 100, "{} colours", colours.len());
        desk.shows(&picture, scale);
        desk.quit();
    }
}

pub(crate) fn the_window_survives_shrinking_to_one_pixel_and_back() {
    let desk = Desk::open("--scene spring");
    for (key, [width, height], method) in [
        ("1", [1, 1], "Explicit Euler"),
        ("2", [2500, 3], "Semi-implicit Euler"),
        ("3", [640, 360], "Improved Euler"),
    ] {
        desk.resize(width, height);
        desk.press(key);
        desk.titled(&format!("Regatta - spring - {method} - 60 Hz"));
        assert_eq!(desk.screenshot().1.dimensions(), (width, height));
    }
    desk.press("space");
    desk.titled("Regatta - spring - Improved Euler - 60 Hz (paused)");
    desk.shows(&desk.screenshot().1, 1);
    desk.quit();
}

pub(crate) fn the_window_survives_full_screen_and_back() {
    let desk = Desk::open("--scene spring");
    desk.press("F11 1 F11 space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    desk.quit();
}

pub(crate) fn escape_leaves_full_screen_and_then_asks_before_it_ends_the_program() {
    let mut desk = Desk::open("--scene spring");
    desk.press("space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    desk.press("F11");
    // Without a window manager the size stays, but the program knows.
    desk.press_and_see("f");
    desk.press_and_see("Escape");
    desk.press("Escape");
    desk.still();
    let before = desk.sight();
    desk.press_and_see("Escape");
    assert!(desk.sight() != before && desk.program.ended().is_none(), "it asks");
    desk.press_and_see("Escape");
    desk.press_and_see("Escape");
    desk.press("Return");
    desk.ends();
}
