//! Copying in the window and pasting in another program, and the other way round.

use regatta::sim::integrators::method;
use regatta::tools::source_code::{Language, Precision, source_code};

use crate::desk::{Desk, until};
use crate::widgets::paused;

pub(crate) fn control_c_on_a_lane_and_its_menu_copy_the_method() {
    let (desk, mut twin) = paused("spring");
    let holds = |id: &str, language: Language| {
        let code = source_code(method(id).unwrap(), language, Precision::Double).unwrap();
        until("the method on the clipboard", || (desk.clipboard() == code).then_some(()));
    };
    twin.click(&desk, "4 Runge-Kutta 4");
    desk.press("ctrl+c");
    holds("rk4", Language::Rust);

    twin.right_click(&desk, "4 Runge-Kutta 4,");
    twin.click(&desk, "Copy as C#");
    holds("rk4", Language::CSharp);
    twin.click(&desk, "2 Semi-implicit Euler");
    desk.press("ctrl+c");
    holds("semi-implicit-euler", Language::CSharp);

    // Away from the lanes it is the instrument that is copied.
    twin.looks_alike(&desk);
    desk.press("ctrl+c");
    until("the values on the clipboard", || {
        let text = desk.clipboard();
        (!text.is_empty() && !text.contains("Euler (")).then_some(())
    });
    desk.quit();
}

/// The number of pastes of a long text, which every field truncates, and the allowed growth of the program's memory,
/// in MB. Without a bound the fields took 1700 and 900 MB more.
const PASTES: usize = 30;
const LONG: usize = 20_000;
const MAX_GROWTH_MB: [f64; 2] = [20.0, 160.0];

pub(crate) fn pasting_a_long_text_repeatedly_uses_no_memory() {
    let desk = Desk::open("--scene spring");
    desk.copy_elsewhere(&"60,1.0,-0.25\n".repeat(LONG));
    desk.press("space");
    desk.still();
    for (opens, most) in ["s", "o"].into_iter().zip(MAX_GROWTH_MB) {
        let before = desk.program.memory_mb();
        desk.press_and_see(opens);
        let mut largest = before;
        for _ in 0..PASTES {
            desk.press("ctrl+v");
            desk.settles();
            largest = largest.max(desk.program.memory_mb());
            assert!(largest < before + most, "{opens}: {before:.0} to {largest:.0} MB");
        }
        println!("{opens}: {before:.0} to {largest:.0} MB");
        desk.press("Escape");
        desk.still();
    }
    desk.close();
    desk.ends();
}

pub(crate) fn text_is_copied_and_pasted_between_fields_and_other_programs() {
    let desk = Desk::open("--scene spring");
    desk.copy_elsewhere("ship");
    // The path is pasted before a frame has shown its field.
    desk.press("o ctrl+v Return");
    desk.titled("Regatta - ship - Explicit Euler - 2 Hz");
    desk.press("o");
    desk.xdotool("type --delay 1 pendulum");
    desk.press("ctrl+a ctrl+x");
    until("the path on the clipboard", || (desk.clipboard() == "pendulum").then_some(()));
    desk.copy_elsewhere("orbit");
    desk.press("ctrl+v Return");
    desk.titled("Regatta - orbit - Explicit Euler - 30 Hz");
    // The run as a link, which is pasted like a path.
    desk.press("ctrl+l");
    until("the link on the clipboard", || {
        desk.clipboard().starts_with("#scene=orbit").then_some(())
    });
    desk.press("o ctrl+a ctrl+v Return");
    desk.titled("Regatta - a link - Explicit Euler - 30 Hz");
    desk.quit();
}

pub(crate) fn a_short_link_opens_its_scene_paused_at_its_tick() {
    let link = "#scene=spring&method=rk4&tick-hz=30&tick=45";
    let desk = Desk::open(&format!("--scene {link}"));
    desk.titled("Regatta - spring - Runge-Kutta 4 - 30 Hz (paused)");
    // As long as a person looks at it before sending it on.
    std::thread::sleep(std::time::Duration::from_secs(1));
    desk.press("ctrl+l");
    until("the link on the clipboard", || desk.clipboard().starts_with(link).then_some(()));
    desk.quit();
}
