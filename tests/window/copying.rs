//! What another program can paste after something was copied in the window.

use regatta::lab::{Language, source_code};
use regatta::sim::integrators::method;

use crate::desk::until;
use crate::widgets::paused;

#[test]
fn control_c_on_a_lane_copies_its_method_and_the_menu_of_the_lane_has_the_languages() {
    let test = "control_c_on_a_lane_copies_its_method_and_the_menu_of_the_lane_has_the_languages";
    let Some((desk, mut twin)) = paused(test, "spring") else { return };
    let holds = |id: &str, language: Language| {
        let code = source_code(method(id).unwrap(), language).unwrap();
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
