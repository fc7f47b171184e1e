//! Clicks on the panels.

use crate::desk::{Desk, until};

/// Opens the menu of scenes of a paused window, and waits until its second line is there.
fn open_scene_menu(desk: &Desk, scale: u32) {
    let below = || *desk.sight().get_pixel(scale * 70, scale * 66);
    let closed = below();
    desk.click(scale * 50, scale * 17);
    until("the menu of scenes", || (below() != closed).then_some(()));
}

#[test]
fn panels_are_worked_by_the_mouse_at_every_scale() {
    let test = "panels_are_worked_by_the_mouse_at_every_scale";
    for scale in [1, 2] {
        let factor = scale.to_string();
        let variables = [("WINIT_X11_SCALE_FACTOR", factor.as_str())];
        let Some(desk) = Desk::open_with(test, "--scene spring", &variables) else { return };
        let click = |x, y| desk.click(scale * x, scale * y);
        // The second line of the list of methods.
        click(140, 617);
        desk.titled("Regatta - spring - Semi-implicit Euler - 60 Hz");
        // Pause, in the top bar.
        click(140, 17);
        desk.titled("Regatta - spring - Semi-implicit Euler - 60 Hz (paused)");
        open_scene_menu(&desk, scale);
        click(50, 66);
        desk.titled("Regatta - ship - Semi-implicit Euler - 2 Hz (paused)");
        let size = [1280, 720].map(|side| scale * side);
        assert_eq!(desk.screenshot().1.dimensions(), size.into());
        desk.quit();
    }
}

#[test]
fn escape_closes_an_open_menu_before_it_ends_the_program() {
    let test = "escape_closes_an_open_menu_before_it_ends_the_program";
    let Some(desk) = Desk::open(test, "--scene spring") else { return };
    desk.press("space");
    desk.titled("Regatta - spring - Runge-Kutta 4 - 60 Hz (paused)");
    open_scene_menu(&desk, 1);
    desk.press("Escape space");
    desk.titled("Regatta - spring - Runge-Kutta 4 - 60 Hz");
    desk.quit();
}

#[test]
fn a_widget_with_the_focus_takes_space_and_escape_gives_it_back() {
    let test = "a_widget_with_the_focus_takes_space_and_escape_gives_it_back";
    let Some(desk) = Desk::open(test, "--scene spring") else { return };
    desk.press("space");
    desk.titled("Regatta - spring - Runge-Kutta 4 - 60 Hz (paused)");
    // The menu of scenes, restart, run.
    ["Tab", "Tab", "Tab"].into_iter().for_each(|key| desk.press_and_see(key));
    desk.press("space");
    desk.titled("Regatta - spring - Runge-Kutta 4 - 60 Hz");
    desk.press("space");
    desk.titled("Regatta - spring - Runge-Kutta 4 - 60 Hz (paused)");
    desk.press_and_see("Escape");
    desk.press("space");
    desk.titled("Regatta - spring - Runge-Kutta 4 - 60 Hz");
    desk.quit();
}
