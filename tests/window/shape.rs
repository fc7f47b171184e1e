//! The window's size, and what is on it.

use std::collections::HashSet;

use image::RgbaImage;

use crate::desk::{Desk, until};

#[test]
fn the_window_shows_what_a_screenshot_saves() {
    let test = "the_window_shows_what_a_screenshot_saves";
    let Some(desk) = Desk::open(test, "--scene spring") else { return };
    desk.press("space");
    desk.titled("Regatta - spring - Runge-Kutta 4 - 60 Hz (paused)");
    let (_, picture) = desk.screenshot();
    let colours: HashSet<_> = picture.pixels().collect();
    assert!(colours.len() > 100, "{} colours", colours.len());
    // The bar above tells of the frame rate, and the footer, now, of the screenshot.
    let between = |image: &RgbaImage| image.as_raw()[4 * 1280 * 34..4 * 1280 * 690].to_vec();
    until("the same picture in the window", || {
        let (sight, picture) = (between(&desk.sight()), between(&picture));
        let off = sight.iter().zip(&picture).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        // Now and then a letter falls on the other side of a quarter of a pixel.
        (off < 300).then_some(())
    });
    desk.quit();
}

#[test]
fn a_window_of_one_pixel_and_back_goes_on() {
    let test = "a_window_of_one_pixel_and_back_goes_on";
    let Some(desk) = Desk::open(test, "--scene spring") else { return };
    for (key, [width, height], method) in [
        ("1", [1, 1], "Explicit Euler"),
        ("2", [2500, 3], "Semi-implicit Euler"),
        ("3", [640, 360], "Improved Euler"),
    ] {
        desk.xdotool(&format!("windowsize WINDOW {width} {height}"));
        until("the size", || (desk.sight().dimensions() == (width, height)).then_some(()));
        desk.press(key);
        desk.titled(&format!("Regatta - spring - {method} - 60 Hz"));
        assert_eq!(desk.screenshot().1.dimensions(), (width, height));
    }
    desk.quit();
}

#[test]
fn full_screen_and_back_goes_on() {
    let test = "full_screen_and_back_goes_on";
    let Some(desk) = Desk::open(test, "--scene spring") else { return };
    desk.press("F11 1 F11 space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    desk.quit();
}
