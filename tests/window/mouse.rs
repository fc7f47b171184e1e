//! Clicks on the panels.

use crate::desk::{Desk, until};

/// Opens the menu of scenes of a paused window, and waits until its second line is there.
fn open_scene_menu(desk: &Desk, scale: u32) {
    let below = || *desk.sight().get_pixel(scale * 70, scale * 66);
    desk.still();
    let closed = below();
    desk.click(scale * 50, scale * 20);
    until("the menu of scenes", || (below() != closed).then_some(()));
    desk.still();
}

pub(crate) fn the_mouse_works_the_panels_at_every_scale() {
    // In points. Small, since a press that lasts long in slow frames makes no click.
    let (width, height) = (640, 360);
    // The second of the methods above the footer, where there is room for the name of the chosen one alone.
    let second_method = (187, height - 32 - 20);
    for scale in [1, 2] {
        let factor = scale.to_string();
        let variables = [("WINIT_X11_SCALE_FACTOR", factor.as_str())];
        let desk = Desk::open_with("--scene spring", &variables);
        desk.press("space");
        desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
        desk.resize(scale * width, scale * height);
        desk.still();
        let click = |x, y| desk.click(scale * x, scale * y);
        click(second_method.0, second_method.1);
        desk.titled("Regatta - spring - Semi-implicit Euler - 60 Hz (paused)");
        // Run, in the top bar.
        click(153, 20);
        desk.titled("Regatta - spring - Semi-implicit Euler - 60 Hz");
        desk.press("space");
        desk.titled("Regatta - spring - Semi-implicit Euler - 60 Hz (paused)");
        open_scene_menu(&desk, scale);
        // The third scene, below four other lines and the name of its group: so long a list starts at the
        // top of so low a window.
        click(50, 197);
        desk.titled("Regatta - ship - Explicit Euler - 2 Hz (paused)");
        desk.quit();
    }
}

pub(crate) fn escape_closes_an_open_menu_before_it_ends_the_program() {
    let desk = Desk::open("--scene spring");
    desk.press("space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    open_scene_menu(&desk, 1);
    desk.press("Escape space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz");
    desk.quit();
}

pub(crate) fn a_focused_widget_takes_space_until_escape_releases_it() {
    let desk = Desk::open("--scene spring");
    desk.press("space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    // The menu of scenes, my spring, restart, a tick back, run.
    ["Tab"; 5].into_iter().for_each(|key| desk.press_and_see(key));
    desk.press("space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz");
    desk.press("space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz (paused)");
    desk.press_and_see("Escape");
    desk.press("space");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz");
    desk.quit();
}
