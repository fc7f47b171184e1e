//! The quantity of an instrument on the screen, in a copy, and in a saved file.

use super::*;
use crate::studio::{HeldBody, RunCommand, StageCommand, ViewCommand};

#[test]
fn motion_shows_the_chosen_quantity_and_its_table_follows() {
    // In the guide's run of the ship, the speed under Euler is ahead of the exact speed, and the place behind the exact
    // place.
    let mut studio = Studio::new(Scene::built_in("ship").unwrap());
    let euler = studio.entries().iter().position(|spec| spec.method.id == "explicit-euler");
    studio.apply(StageCommand::Pick(euler.unwrap()));
    studio.apply(StageCommand::TickHz(2.into()));
    studio.apply(StageCommand::Restart);
    (0..17).for_each(|_| studio.tick());
    let at_the_end = |studio: &Studio| {
        let set = plot_set_of(studio, Detail::Samples).unwrap();
        let readouts = set.plots[0].readouts(studio, &set.styles, 8.5);
        [readouts[0].at[1], readouts[1].at[1]]
    };
    studio.apply(ViewCommand::Quantity(Some(Quantity::Position)));
    let [place, exact_place] = at_the_end(&studio);
    assert!(place < exact_place - 1.0, "{place} and {exact_place}");
    // Speed is the usual quantity for a ship, because its place grows without end.
    for quantity in [Some(Quantity::Velocity), None] {
        studio.apply(ViewCommand::Quantity(quantity));
        let [speed, exact_speed] = at_the_end(&studio);
        assert!((speed - 11.64).abs() < 0.01 && (exact_speed - 11.45).abs() < 0.01, "{speed}");
        let table = csv(&studio).unwrap().concat();
        assert!(table.lines().skip(1).all(|line| line.contains(",v,m/s,")), "{table}");
        assert!(svg(&studio).unwrap().contains(">v, m/s<"));
        assert_legible(&studio, "the ship's velocity");
    }
}

#[test]
fn a_net_plots_its_widest_motion_or_the_chosen_coordinate() {
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
    assert_eq!(set.plots[0].readouts(&studio, &set.styles, studio.race().t())[0].at[1], now);
    // After a seek back, the run repeats as recorded.
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
fn readouts_of_a_plot_keep_their_order_when_curves_cross() {
    let mut studio = race_of_springs();
    let mut orders = Vec::new();
    for _ in 0..5 {
        (0..13).for_each(|_| studio.tick());
        let mut person = Person::new();
        let (seen, _) = person.frame(&studio, Vec::new());
        let is_key = |text: &&String| text.len() == 1 && text.parse::<usize>().is_ok();
        let mut keys: Vec<String> = seen.iter().filter(is_key).cloned().collect();
        // The keys of the readouts come after the marks of the axes.
        let marks = keys.len() - studio.race().entrants().len();
        orders.push(keys.split_off(marks));
    }
    assert!(orders[0].len() >= 3 && orders.windows(2).all(|two| two[0] == two[1]), "{orders:?}");
}

#[test]
fn plot_and_stage_agree_on_a_held_and_on_a_released_body() {
    let mut studio = race_of_springs();
    let front = |studio: &Studio| {
        let set = plot_set_of(studio, Detail::Samples).unwrap();
        let readouts = set.plots[0].readouts(studio, &set.styles, studio.race().t());
        let of = |entry: Option<usize>| readouts.iter().find(|it| it.entry == entry).unwrap().at[1];
        [of(Some(studio.active())), of(None)]
    };
    let before = front(&studio);
    let lane = studio.selected().id;
    let at = glam::DVec2::new(1.648, 0.0);
    let (q, v) = ([1.648].into(), [0.0].into());
    studio.apply(RunCommand::Hold(HeldBody { lane, body: 0, q, v, hand: at, handle: at }));
    assert_eq!(front(&studio), [1.648, before[1]]);
    studio.apply(ViewCommand::LetGo);
    let place = Action::Place { body: 0, q: [-0.13].into(), v: [0.0].into() };
    studio.apply(RunCommand::Act(place));
    assert_eq!(front(&studio), [-0.13; 2]);
    studio.apply(StageCommand::Restart);
    let place = Action::Place { body: 0, q: [0.7].into(), v: [0.0].into() };
    studio.apply(RunCommand::Act(place));
    assert_eq!(front(&studio), [0.7; 2], "at the first tick");
}

#[test]
fn the_number_of_a_lane_and_its_value_are_apart() {
    let mut studio = race_of_springs();
    for q in [0.001_92, -0.000_192, -123.4, 1.92e-7, -1.92e-7, 8.5e30] {
        let place = Action::Place { body: 0, q: [q].into(), v: [q].into() };
        studio.apply(RunCommand::Act(place));
        for quantity in Quantity::ALL {
            studio.apply(ViewCommand::Quantity(Some(quantity)));
            for size in [vec2(1280.0, 720.0), vec2(1000.0, 640.0)] {
                let shown = texts(&studio, size);
                let keys = shown.iter().filter(|(rect, text)| {
                    text.len() == 1 && is_number(text) && rect.left() > 0.7 * size.x
                });
                for (key, number) in keys {
                    let beside = |(rect, _): &&(Rect, String)| {
                        rect.left() > key.left() && (rect.center().y - key.center().y).abs() < 3.0
                    };
                    for (rect, text) in shown.iter().filter(beside) {
                        assert!(rect.left() > key.right() + 2.0, "{size}: {number}, {text}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_saved_picture_has_nothing_to_click() {
    let mut studio = race_of_springs();
    studio.apply(ViewCommand::Quantity(Some(Quantity::Position)));
    for is_picture in [true, false] {
        let mut window = TestWindow::new([960.0, 600.0]);
        let mut after = |events: Vec<Event>| {
            let shown = window.show(events, |ui| match is_picture {
                true => panels::show_instrument(ui, &studio),
                false => show_alone(ui, &studio, &mut Vec::new()),
            });
            shown.1.whole()
        };
        after(Vec::new());
        let before = after(Vec::new());
        let chosen = before.iter().find(|(_, text)| text == Quantity::Position.name());
        let at = chosen.expect("what is plotted is said").0.center();
        after(vec![Event::PointerMoved(at)]);
        after(vec![button(at, true)]);
        after(vec![button(at, false)]);
        let offers = |texts: &[(Rect, String)]| {
            texts.iter().filter(|(_, text)| text == Quantity::Velocity.name()).count()
        };
        let opened = offers(&after(Vec::new())) > offers(&before);
        assert_eq!(opened, !is_picture);
    }
}

#[test]
fn a_saved_picture_has_no_tabs_and_an_enlarged_instrument_covers_the_table() {
    let mut studio = race_of_springs();
    let has_tabs = |texts: &[(Rect, String)]| texts.iter().any(|(_, text)| text == "Error");
    let mut window = TestWindow::new([960.0, 600.0]);
    let alone = window.show(Vec::new(), |ui| panels::show_instrument(ui, &studio)).1.whole();
    // The axes name the usual quantity.
    assert!(alone.iter().all(|(_, text)| text != "default"), "{alone:?}");
    assert!(!has_tabs(&alone) && alone.iter().any(|(_, text)| text == "time t, s"), "{alone:?}");
    let size = vec2(1280.0, 720.0);
    let lowest = |studio: &Studio| {
        let shown = texts(studio, size);
        let place = |wanted: &str| shown.iter().find(|(_, text)| text == wanted).map(|it| it.0);
        (place("time t, s").unwrap().top(), place("Error").unwrap().left())
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

#[test]
fn motion_fits_the_whole_selected_lane_and_the_truth() {
    let scenes = ["harbour", "stiff", "held-force", "orbit"];
    for (scene, is_race) in scenes.into_iter().flat_map(|scene| [(scene, false), (scene, true)]) {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        if is_race {
            studio.apply(StageCommand::ToggleRace);
        }
        let mut widest = 0.0_f64;
        for seconds in [0, 3, 9, 12] {
            (0..seconds * studio.race().tick_hz().hz() as u32).for_each(|_| studio.tick());
            let lanes = if is_race { studio.race().entrants().len() } else { 1 };
            for lane in 0..lanes {
                studio.apply(StageCommand::Pick(lane));
                let set = plot_set_of(&studio, Detail::Samples).unwrap();
                for plot in &set.plots {
                    let what = format!("{scene}, lane {lane} at {} s", studio.race().t());
                    let [[from, to], [low, high]] = plot.fit;
                    assert!(low.is_finite() && high.is_finite() && low < high, "{what}");
                    let track = plot.tracks.iter().find(|track| track.is_front).unwrap();
                    let places = track.places().map(|(t, _, [_, y])| (t, y));
                    let truth = plot.exact[0].times.iter().copied().zip(plot.exact[0].values(1));
                    let seen = places.chain(truth).filter(|(t, _)| (from..=to).contains(t));
                    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
                    for (t, y) in seen {
                        assert!(low < y && y < high, "{what}: {y} at {t} s, {low} to {high}");
                        (least, most) = (least.min(y), most.max(y));
                    }
                    let zero = if studio.race().t() < from + 5.0 { 0.0 } else { least };
                    let room = (most.max(zero) - least.min(zero)).max(0.02 * most.abs());
                    let is_close = (high - low) < 4.0 * room || lanes > 1 || room == 0.0;
                    assert!(is_close, "{what}: {low} to {high} for {least} to {most}");
                    widest = widest.max(high - low);
                }
                if !is_race {
                    break;
                }
            }
        }
        assert!(widest > 6.0 || scene != "harbour", "{scene}: {widest}");
    }
}

#[test]
fn the_plot_of_a_resting_body_is_not_magnified() {
    for scene in ["harbour", "spring", "pendulum", "orbit"] {
        let mut studio = Studio::new(Scene::built_in(scene).unwrap());
        for instrument in [Instrument::Motion, Instrument::Phase] {
            studio.apply(StageCommand::Instrument(instrument));
            for _ in 0..2 {
                for plot in plot_set_of(&studio, Detail::Samples).unwrap().plots {
                    let [low, high] = plot.fit[1];
                    assert!(
                        low <= 0.0 && high >= 0.0 && high - low > 0.0,
                        "{scene}: {low}, {high}"
                    );
                }
                (0..5).for_each(|_| studio.tick());
            }
        }
    }
}

#[test]
fn the_helm_plots_its_track() {
    let mut studio = Studio::new(Scene::built_in("helm").unwrap());
    (0..150).for_each(|_| studio.tick());
    let set = plot_set_of(&studio, Detail::Samples).unwrap();
    let track = &set.plots[0];
    assert!(!track.is_over_time() && set.plots[1].is_over_time() && set.plots.len() == 2);
    let here = studio.selected().lane.bodies()[0].stepper.place();
    let front = track.tracks.iter().find(|track| track.is_front).unwrap();
    assert_eq!(front.places().last().unwrap().2, [here.x, here.y]);
    for (_, _, at) in front.places() {
        let [[left, right], [low, high]] = track.fit;
        assert!((left..right).contains(&at[0]) && (low..high).contains(&at[1]), "{at:?}");
    }
    for size in [vec2(1280.0, 720.0), vec2(800.0, 600.0)] {
        let shown = texts(&studio, size);
        assert!(shown.iter().any(|(_, text)| text == "Helm, track"), "{size}");
        assert!(shown.iter().any(|(_, text)| text == "y, m"), "{size}");
    }
    assert_legible(&studio, "the track of the helm");
}

#[test]
fn a_lone_lane_has_a_legend_number_only_if_a_key_picks_it() {
    let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
    for (id, told) in
        [("semi-implicit-euler", "2 Semi-implicit Euler"), ("implicit-euler", "Implicit Euler")]
    {
        let entry = studio.entries().iter().position(|spec| spec.method.id == id);
        studio.apply(StageCommand::Pick(entry.unwrap()));
        studio.tick();
        let set = plot_set_of(&studio, Detail::Samples).unwrap();
        let names: Vec<_> = legend_entries(&set).into_iter().map(|entry| entry.name).collect();
        assert!(names.iter().any(|name| name == told), "{names:?}");
    }
}

#[test]
fn the_selected_lane_never_leaves_a_plot() {
    for (scene, seconds) in [("harbour", 13), ("spring", 9), ("orbit", 5)] {
        for is_race in [false, true] {
            let mut studio = Studio::new(Scene::built_in(scene).unwrap());
            if is_race {
                studio.apply(StageCommand::ToggleRace);
                studio.apply(StageCommand::Pick(0));
            }
            assert_eq!(studio.entries()[studio.active()].method.id, "explicit-euler");
            (0..seconds * studio.race().tick_hz().hz() as u32).for_each(|_| studio.tick());
            for instrument in [Instrument::Motion, Instrument::Phase, Instrument::Energy] {
                studio.apply(StageCommand::Instrument(instrument));
                let set = plot_set_of(&studio, Detail::Samples).unwrap();
                let plot = &set.plots[0];
                let tracks = plot.tracks.iter().filter(|track| track.is_front);
                let mut points = 0;
                for (t, _, at) in tracks.flat_map(|track| track.places()) {
                    let [[from, to], [low, high]] = plot.fit;
                    let is_in_time = !plot.is_over_time() || (from..=to).contains(&t);
                    let is_in = (from..=to).contains(&at[0]) && (low..=high).contains(&at[1]);
                    assert!(is_in || !is_in_time, "{scene}, {instrument:?} at {t} s: {at:?}");
                    points += 1;
                }
                assert!(points > 100, "{scene}, {instrument:?}");
            }
        }
    }
}

#[test]
fn stage_and_plot_show_the_same_speed_at_the_same_time() {
    let mut studio = Studio::new(Scene::built_in("surge").unwrap());
    studio.apply(ViewCommand::Quantity(Some(Quantity::Velocity)));
    for _ in 0..60 {
        studio.advance(173_000_000);
        let body = &studio.race().entrants()[0].lane.bodies()[0];
        let on_stage = crate::studio::shown_state(&studio, body).1[0];
        let exact = crate::studio::shown_truth(&studio, 0).1[0];
        let set = plot_set_of(&studio, Detail::Samples).unwrap();
        let now_s = crate::studio::shown_s(&studio);
        assert_eq!(set.styles.now_s, now_s);
        let readouts = set.plots[0].readouts(&studio, &set.styles, now_s);
        let near = |found: f64, wanted: f64| (found - wanted).abs() < 1e-6 * wanted.abs().max(1.0);
        for readout in &readouts {
            let wanted = if readout.entry.is_some() { on_stage } else { exact };
            assert!(near(readout.at[1], wanted), "{now_s} s: {} and {wanted}", readout.at[1]);
        }
        assert_eq!(readouts.len(), 2);
    }
}
