//! Every kind of widget worked by the mouse, in the window and in its twin: both come to the same run, and look alike.

use regatta::scene::Scene;
use regatta::studio::{
    INSTRUMENTS, Instrument, InstrumentGroup, MySpring, StageCommand, Step, Studio, ViewCommand,
};

use crate::desk::{Desk, until};
use crate::twin::Twin;

/// A paused window at the start of a scene, and its twin.
pub(crate) fn paused(scene: &str) -> (Desk, Twin) {
    paused_with(scene, &[], true)
}

/// The same with environment variables set, with or without instruments round the stage.
pub(crate) fn paused_with(scene: &str, variables: &[(&str, &str)], measure: bool) -> (Desk, Twin) {
    let desk = Desk::open_with(&format!("--scene {scene}"), variables);
    let mut twin = Twin::new(Studio::new(Scene::built_in(scene).unwrap()));
    twin.studio.viewer.preferences.display.measure = measure;
    desk.press("space");
    twin.apply(ViewCommand::TogglePause);
    desk.titled(&twin.studio.title());
    // After a tick at least, a restart leaves a run to bring back.
    desk.press("period Home");
    twin.apply(StageCommand::Tick(Step::Next));
    twin.apply(StageCommand::Restart);
    desk.at_tick(0);
    (desk, twin)
}

/// Waits for window and twin to look alike, and compares the ends of their recordings: the last command and the
/// state. Positions between the frames of a drag are not recorded, and frames differ.
#[track_caller]
fn same(desk: &Desk, twin: &mut Twin) {
    twin.looks_alike(desk);
    let [window, twin] = [desk.recording(), twin.studio.deck.recording().unwrap()];
    let end = |text: &str| text.rsplit("[[command]]").next().map(str::to_owned);
    assert_eq!(end(&window), end(&twin));
}

pub(crate) fn the_mouse_works_the_menus_buttons_and_table() {
    let (desk, mut twin) = paused("ship");
    for name in [
        "ship",
        "spring",
        "one tick forward (.)",
        "one tick forward (.)",
        "one tick back (,)",
        "run (Space)",
        "pause (Space)",
        "restart (Home)",
        "simulated seconds per second",
        "2× real time",
        "2 Semi-implicit Euler",
        "sort by error",
        "Race",
        "4 Runge-Kutta 4",
        "Solo",
        "help (H)",
        "Close (Esc)",
    ] {
        twin.click(&desk, name);
    }
    twin.enter(&desk, "tick rate", "120");
    let studio = &twin.studio;
    assert_eq!(
        (studio.clock().speed_percent(), studio.clock().tick_hz(), studio.active()),
        (200, 120.into(), 3)
    );
    assert!(!studio.display().help);
    same(&desk, &mut twin);
    desk.quit();
}

pub(crate) fn the_mouse_works_the_instruments_and_the_inspector() {
    let (desk, mut twin) = paused("spring");
    let spring = Scene::built_in("spring").unwrap();
    for card in INSTRUMENTS.iter().filter(|card| card.instrument.is_of(&spring)) {
        // Where not all tabs fit, another group has its name alone.
        if card.group != twin.studio.display().instrument.card().group {
            twin.click(&desk, card.group.name());
        }
        twin.click(&desk, card.name);
        assert_eq!(twin.studio.display().instrument, card.instrument);
    }
    twin.click(&desk, InstrumentGroup::See.name());
    twin.click(&desk, "Error");
    twin.click(&desk, "position error");
    twin.click(&desk, "velocity error");
    // The title of the plot.
    twin.click(&desk, "Spring");
    twin.click(&desk, "edit parameters, methods and rates (E)");
    let stiffness = twin.slider("stiffness");
    twin.drag(&desk, stiffness.center(), stiffness.lerp_inside(egui::vec2(0.8, 0.5)));
    twin.click(&desk, "restore stiffness");
    twin.enter(&desk, "stiffness", "90");
    assert!(twin.studio.race().values(0).contains(&90.0));
    same(&desk, &mut twin);
    // Escape would close the inspector.
    desk.close();
    desk.ends();
}

pub(crate) fn the_mouse_works_the_guide_and_the_timeline() {
    let (desk, mut twin) = paused("spring");
    desk.press("shift+period shift+period");
    (0..2).for_each(|_| twin.apply(StageCommand::Second(Step::Next)));
    desk.at_tick(120);
    let track = twin.slider("timeline");
    twin.click_at(&desk, track.lerp_inside(egui::vec2(0.05, 0.5)));
    let tick = twin.studio.race().tick();
    assert!((1..119).contains(&tick), "{tick}");
    desk.at_tick(tick);
    twin.click(&desk, "2 Semi-implicit Euler");
    twin.click(&desk, "undo: ");
    assert_eq!((twin.studio.run().end(), twin.studio.active()), (120, 0));
    same(&desk, &mut twin);
    desk.press("F2");
    twin.apply(ViewCommand::ToggleGuide);
    let choice = twin.studio.viewer.tour().unwrap().stop().choices[1];
    twin.click(&desk, choice);
    assert_eq!(twin.studio.viewer.tour().unwrap().guess(), Some(1));
    assert!(twin.studio.running(), "the prediction begins the run");
    twin.click(&desk, "pause (Space)");
    // In the window time ran, so that there is a run to bring back.
    twin.studio.tick();
    twin.click(&desk, "restart (Home)");
    same(&desk, &mut twin);
    twin.click(&desk, "Close");
    assert!(twin.studio.viewer.tour().is_none());
    assert_eq!((twin.studio.scene().name.as_str(), twin.studio.run().end()), ("spring", 120));
    same(&desk, &mut twin);
    desk.quit();
}

pub(crate) fn dragging_the_cross_of_the_stability_map_sets_rate_and_parameter() {
    let (desk, mut twin) = paused("spring");
    let values = twin.studio.race().values(0).to_vec();
    twin.click(&desk, InstrumentGroup::Why.name());
    assert_eq!(twin.studio.display().instrument, Instrument::StabilityMap);
    let map = twin.slider("you are here");
    twin.drag(&desk, map.center(), map.lerp_inside(egui::vec2(0.3, 0.4)));
    let studio = &twin.studio;
    assert!(
        studio.clock().tick_hz() != studio.scene().tick_hz && studio.race().values(0) != values
    );
    desk.titled(&studio.title());
    let recording = desk.recording();
    let set = recording.lines().rfind(|line| line.contains("\"stiffness_n_per_m\""));
    let value = set.and_then(|line| line.rsplit("value = ").next()?.strip_suffix(" }"));
    let value: f64 = value.expect("the last value set").parse().unwrap();
    let expected = studio.race().values(0).iter().copied().find(|value| !values.contains(value));
    assert_eq!(Some(value), expected);
    desk.quit();
}

pub(crate) fn a_typed_spring_is_advised_on_and_remembered() {
    let (desk, mut twin) = paused("ship");
    twin.click(&desk, "a spring of your own");
    twin.enter(&desk, "stiffness", "50");
    twin.enter(&desk, "frequency", "3");
    twin.enter(&desk, "damping ratio", "1");
    twin.click(&desk, "Run it at");
    assert_eq!(
        (twin.studio.deck.scene_name().as_str(), twin.studio.race().tick()),
        ("my spring", 0)
    );
    assert_eq!(twin.studio.display().instrument, Instrument::Advice);
    desk.titled(&twin.studio.title());
    let softer = MySpring { stiffness_n_per_m: 50.0, ..MySpring::default() };
    let faster = MySpring::of_frequency(12.0, 3.0, softer.damping_ratio());
    let spring = MySpring::of_frequency(12.0, faster.frequency_hz(), 1.0);
    let told = desk.recording();
    for line in [
        "mass_kg = 12.0".to_owned(),
        format!("stiffness_n_per_m = {:?}", spring.stiffness_n_per_m),
        format!("damping_n_s_per_m = {:?}", spring.damping_n_s_per_m),
    ] {
        assert!(told.contains(&line), "no {line} in {told}");
    }
    // By keys alone: the first number has the focus, and Enter after the last accepts. The spring of the dialog swings.
    desk.press("space");
    desk.still();
    desk.press("s");
    for key in ["3", "Return", "Return"] {
        desk.settles();
        desk.press(key);
    }
    until("a run", || (!desk.title().contains("paused")).then_some(()));
    assert!(desk.recording().contains("mass_kg = 3.0"), "stiffness and damping stay");
    desk.quit();
}
