//! Which quantity an instrument shows, and what of it is seen, copied and saved.

use super::*;
use crate::lab::studio::{RunCommand, StageCommand, ViewCommand};

#[test]
fn motion_shows_the_chosen_quantity_and_its_table_follows() {
    // The ship of the guide: Euler's speed is ahead of the exact one, and its place behind.
    let mut studio = Studio::new(Scene::built_in("ship").unwrap());
    let euler = studio.entries().iter().position(|spec| spec.method.id == "explicit-euler");
    studio.apply(StageCommand::Pick(euler.unwrap()));
    studio.apply(StageCommand::TickHz(2));
    studio.apply(StageCommand::Restart);
    (0..17).for_each(|_| studio.tick());
    let at_the_end = |studio: &Studio| {
        let set = plot_set_of(studio, Detail::Samples).unwrap();
        let readouts = set.plots[0].readouts(&set.styles, 8.5);
        [readouts[0].at[1], readouts[1].at[1]]
    };
    let [place, exact_place] = at_the_end(&studio);
    assert!(place < exact_place - 1.0, "{place} and {exact_place}");
    studio.apply(ViewCommand::Quantity(Quantity::Velocity));
    let [speed, exact_speed] = at_the_end(&studio);
    assert!((speed - 11.64).abs() < 0.01 && (exact_speed - 11.45).abs() < 0.01, "{speed}");
    let table = csv(&studio).unwrap().concat();
    assert!(table.lines().skip(1).all(|line| line.contains(",v,m/s,")), "{table}");
    assert!(svg(&studio).unwrap().contains(">v, m/s<"));
    assert_legible(&studio, "the ship's velocity");
}

#[test]
fn a_net_plots_what_moves_far_and_any_other_coordinate_that_is_chosen() {
    let mut studio = Studio::new(Scene::built_in("bridge").unwrap());
    let named = |studio: &Studio| studio.past().coordinate(studio.race(), 0).0.name.to_string();
    assert_eq!(named(&studio), "y4", "the sag in the middle");
    (0..90).for_each(|_| studio.tick());
    let coordinates = studio.race().truth().bodies()[0].coordinates();
    let chosen = coordinates.iter().position(|coordinate| &*coordinate.name == "x7").unwrap();
    studio.apply(ViewCommand::Coordinate { body: 0, coordinate: chosen });
    assert_eq!(studio.race().tick(), 90);
    let table = csv(&studio).unwrap().concat();
    let rows: Vec<&str> = table.lines().filter(|line| line.contains(",x7,m,")).collect();
    assert!(rows.len() > 90 && rows.len() + 1 == table.lines().count(), "from the start: {table}");
    let now = studio.race().entrants()[0].lane.bodies()[0].stepper.q()[chosen];
    let set = plot_set_of(&studio, Detail::Samples).unwrap();
    assert_eq!(set.plots[0].readouts(&set.styles, studio.race().t())[0].at[1], now);
    // To go back repeats the run as it was recorded.
    studio.apply(RunCommand::Seek(40));
    studio.apply(RunCommand::Seek(90));
    assert_eq!(csv(&studio).unwrap().concat(), table);
    studio.apply(StageCommand::Restart);
    assert_eq!(named(&studio), "x7", "the choice stays with the scene");
    studio.apply(StageCommand::Instrument(Instrument::Phase));
    assert_legible(&studio, "the phase portrait of a node");
    assert!(svg(&studio).unwrap().contains(">vx7, m/s<"));
}

#[test]
fn the_values_beside_a_plot_keep_their_places_while_the_curves_cross() {
    let mut studio = race_of_springs();
    let mut orders = Vec::new();
    for _ in 0..5 {
        (0..13).for_each(|_| studio.tick());
        let mut person = Person::new();
        let (seen, _) = person.frame(&studio, Vec::new());
        let is_key = |text: &&String| text.len() == 1 && text.parse::<usize>().is_ok();
        let mut keys: Vec<String> = seen.iter().filter(is_key).cloned().collect();
        // After the marks of the axes.
        let marks = keys.len() - studio.race().entrants().len();
        orders.push(keys.split_off(marks));
    }
    assert!(orders[0].len() >= 3 && orders.windows(2).all(|two| two[0] == two[1]), "{orders:?}");
}

#[test]
fn a_saved_picture_has_no_tabs_and_an_enlarged_instrument_has_the_room_of_the_table() {
    let mut studio = race_of_springs();
    let has_tabs = |texts: &[(Rect, String)]| texts.iter().any(|(_, text)| text == "Explain");
    let mut window = TestWindow::new([960.0, 600.0]);
    let alone = window.show(Vec::new(), |ui| panels::show_instrument(ui, &studio)).1.whole();
    assert!(!has_tabs(&alone) && alone.iter().any(|(_, text)| text == "time t, s"), "{alone:?}");
    let size = vec2(1280.0, 720.0);
    let lowest = |studio: &Studio| {
        let shown = texts(studio, size);
        let place = |wanted: &str| shown.iter().find(|(_, text)| text == wanted).map(|it| it.0);
        (place("time t, s").unwrap().top(), place("Explain").unwrap().left())
    };
    let (before, tabs) = lowest(&studio);
    studio.apply(ViewCommand::ToggleEnlarged);
    let (after, tabs_then) = lowest(&studio);
    assert!(after > before + 100.0, "{before} and {after}");
    assert!((tabs - tabs_then).abs() < 1.0, "the tabs stay: {tabs} and {tabs_then}");
}

#[test]
fn a_pure_number_has_no_unit() {
    let mut studio = Studio::new(Scene::built_in("duffing").unwrap());
    (0..60).for_each(|_| studio.tick());
    let shown = texts(&studio, vec2(1280.0, 720.0));
    let of_one = shown.iter().find(|(_, text)| text.ends_with(" 1") || text.ends_with(", 1"));
    assert!(of_one.is_none(), "{of_one:?}");
}
