use super::*;
use crate::scene::{Action, Scene};
use crate::studio::{RunCommand, StageCommand};
use crate::theme::palette_of;

const STYLE: TrackStyle = TrackStyle { dots: Dots::None, is_over_time: true };

fn colour_of(studio: &Studio, entry: usize) -> egui::Color32 {
    palette_of(studio.display().theme).style(studio.entries(), &studio.entries()[entry]).0
}

fn drawn(studio: &Studio, low: f64, high: f64) -> Drawing {
    let bounds = [[0.0, 20.0], [low, high]];
    drawing(&SeriesStyles::of(studio), &Track::of(studio, 0, |s| [s.t, s.q]), &bounds, STYLE)
}

fn tick(studio: &mut Studio, ticks: u32) {
    (0..ticks).for_each(|_| studio.tick());
}

#[test]
fn the_past_keeps_its_methods_colour_and_each_switch_has_a_mark() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    let flown = [(3, 60), (1, 90), (4, 30)];
    for (entry, ticks) in flown {
        studio.apply(StageCommand::Pick(entry));
        tick(&mut studio, ticks);
    }
    let Drawing { curves, arrows, switches, .. } = drawn(&studio, -2.0, 2.0);
    let colours: Vec<_> = curves.iter().map(|curve| curve.style.colour).collect();
    assert_eq!(colours, flown.map(|(entry, _)| colour_of(&studio, entry)));
    let dashes = flown.map(|(entry, _)| {
        palette_of(studio.display().theme).style(studio.entries(), &studio.entries()[entry]).1
    });
    assert!(curves.iter().map(|curve| curve.style.dash).eq(dashes));
    for (before, after) in curves.iter().zip(&curves[1..]) {
        assert_eq!(before.points.last(), after.points.first(), "one line");
    }
    assert!(arrows.is_empty());
    let marks: Vec<_> = switches.iter().map(|switch| (switch.at[0], switch.colour)).collect();
    assert_eq!(marks, [(1.0, colour_of(&studio, 1)), (2.5, colour_of(&studio, 4))]);
}

#[test]
fn a_switch_after_a_halt_is_marked_where_the_other_method_took_over() {
    let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
    studio.apply(StageCommand::Pick(0));
    while studio.race().entrants()[0].lane.halted().is_none() {
        studio.tick();
        assert!(studio.race().tick() < 1000);
    }
    tick(&mut studio, 30);
    let taken_over = studio.race().t();
    studio.apply(StageCommand::Pick(3));
    tick(&mut studio, 30);
    let marks: Vec<_> =
        drawn(&studio, -2.0, 2.0).switches.iter().map(|switch| switch.at[0]).collect();
    assert_eq!(marks, [taken_over]);
}

#[test]
fn a_lane_that_leaves_the_plot_ends_with_an_arrow() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(StageCommand::Pick(0));
    studio.apply(StageCommand::Restart);
    tick(&mut studio, 900);
    let Drawing { curves, arrows, .. } = drawn(&studio, -1.5, 1.5);
    assert_eq!((curves.len(), arrows.len()), (1, 1));
    let points = &curves[0].points;
    let (last, inside) = points.split_last().unwrap();
    assert!(inside.iter().all(|point| point[1].abs() <= 1.5) && last[1].abs() > 1.5);
    assert_eq!(arrows[0].to, *last);
    assert!(last[0] < 3.0, "it passes the plot at every swing later on");
}

#[test]
fn a_lane_that_returns_for_good_is_drawn_again() {
    let points: Vec<Point> = (0..100)
        .map(|i| {
            let y = if (20..30).contains(&i) || i == 35 { 9.0 } else { 0.0 };
            let at = [f64::from(i), y];
            Point { t: f64::from(i), entry: 0, at, swept: [y; 2], jumped: false }
        })
        .collect();
    let found = stays(&points, |point| point.at[1] < 1.0, 10.0);
    assert_eq!(found, [0..=19, 36..=99]);
}

#[test]
fn no_stroke_leads_to_a_placement() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    tick(&mut studio, 60);
    studio.apply(RunCommand::Act(Action::Place { body: 0, q: [0.5].into(), v: [0.0].into() }));
    tick(&mut studio, 60);
    let Drawing { curves, arrows, switches, .. } = drawn(&studio, -2.0, 2.0);
    assert_eq!((curves.len(), arrows.len(), switches.len()), (2, 0, 0));
    assert_eq!(curves[0].points.last().map(|at| at[0]), Some(1.0));
    assert_eq!(curves[1].points[0], [1.0, 0.5]);
    let since = Track::of(&studio, 0, |s| [s.t, s.q])[0].since(1.0);
    assert_eq!(since.points[0].at, [1.0, 0.5], "where it was before is not of it");
}

#[test]
fn a_method_entirely_outside_has_an_arrow_of_its_own() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(StageCommand::Pick(0));
    tick(&mut studio, 600);
    studio.apply(StageCommand::Pick(1));
    tick(&mut studio, 100);
    let Drawing { arrows, .. } = drawn(&studio, -1.5, 1.5);
    assert!(arrows.iter().any(|arrow| arrow.colour == colour_of(&studio, 0)));
    assert!(arrows.iter().any(|arrow| arrow.colour == colour_of(&studio, 1)));
}
