//! The chapter's figures, each as a run and as the part of its plot that the book shows.

use super::Studio;
use super::driving::make_tick;
use super::instrument::Instrument;
use super::opening::open_with;
use crate::run::past::Quantity;
use crate::run::race::Mode;
use crate::scene::SCENES;

/// A figure of the chapter, which shows the only body of a scene over time.
#[derive(Debug)]
pub struct BookFigure {
    /// Its number in the book.
    pub number: &'static str,
    /// Its caption, without the number.
    pub title: &'static str,
    /// The built-in scene.
    pub scene: &'static str,
    /// The ids of its methods.
    pub methods: &'static [&'static str],
    /// The quantity that it shows.
    pub quantity: Quantity,
    /// Length of the run, in seconds.
    pub seconds: f64,
    /// Ranges of time (s) and of the quantity that the book shows.
    pub view: [[f64; 2]; 2],
}

const EULER: &[&str] = &["explicit-euler"];
const THREE: &[&str] = &["explicit-euler", "improved-euler", "rk4"];
/// The book's view of Figures 7-3 and 7-7.
const ZOOM: [[f64; 2]; 2] = [[6.46, 8.54], [9.4, 11.8]];

const fn of_ship(
    number: &'static str,
    title: &'static str,
    methods: &'static [&'static str],
    seconds: f64,
    view: [[f64; 2]; 2],
) -> BookFigure {
    let quantity = Quantity::Velocity;
    BookFigure { number, title, scene: "ship", methods, quantity, seconds, view }
}

const fn of_spring(
    number: &'static str,
    title: &'static str,
    methods: &'static [&'static str],
    most_m: f64,
) -> BookFigure {
    let view = [[0.0, 6.1], [-most_m, most_m]];
    let quantity = Quantity::Position;
    BookFigure { number, title, scene: "spring", methods, quantity, seconds: 6.0, view }
}

/// The figures in their order.
pub static BOOK_FIGURES: [BookFigure; 7] = [
    of_ship("7-2", "speed by Euler's method", EULER, 10.0, [[0.0, 10.2], [0.0, 14.4]]),
    of_ship("7-3", "the same, from 6.5 to 8.5 s", EULER, 8.5, ZOOM),
    of_ship("7-4", "in time it converges", EULER, 60.0, [[0.0, 61.0], [0.0, 22.0]]),
    of_spring("7-5", "a spring grows without end under explicit Euler", EULER, 8.4),
    of_ship("7-6", "three methods", THREE, 10.0, [[0.0, 10.2], [0.0, 14.4]]),
    of_ship("7-7", "only Euler's can be told from the exact curve", THREE, 8.5, ZOOM),
    of_spring(
        "7-8",
        "the same spring under improved Euler and Runge-Kutta",
        &["improved-euler", "rk4"],
        1.6,
    ),
];

impl BookFigure {
    /// Returns the key that opens the figure from the list, which is the last digit of its number.
    pub fn digit(&self) -> &'static str {
        &self.number[self.number.len() - 1..]
    }
}

/// Returns the index of the figure that a digit opens.
pub(super) fn figure_of_digit(digit: usize) -> Option<usize> {
    BOOK_FIGURES.iter().position(|figure| figure.digit() == digit.to_string())
}

/// Opens the scene of this figure at its end, in the book's view of it. Time stands still.
pub(super) fn open_figure(studio: &mut Studio, index: usize) {
    let BookFigure { scene, methods, quantity, seconds, view, .. } = &BOOK_FIGURES[index];
    let listed = SCENES.iter().position(|built_in| built_in.name == *scene);
    open_with(studio, listed.expect("a figure names a built-in scene"), |next| {
        next.race_only(methods);
        next.mode = if methods.len() > 1 { Mode::Race } else { Mode::Solo };
    });
    let ticks = (seconds * studio.race().tick_hz().hz()).round() as u64;
    (0..ticks).for_each(|_| make_tick(studio, &mut ()));
    studio.deck.run.show_present();
    studio.deck.running = false;
    let display = &mut studio.viewer.preferences.display;
    (display.measure, display.enlarged) = (true, true);
    (display.instrument, display.quantity) = (Instrument::Motion, Some(*quantity));
    let coordinate = studio.past().coordinate(studio.race(), 0).0;
    let up = format!("{} of 0, up", quantity.symbol(&coordinate));
    let axes = ["time t, along".to_owned(), up];
    studio.viewer.view.plot_ranges = axes.into_iter().zip(*view).collect();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::{StageCommand, Studio, ViewCommand};

    #[test]
    fn a_digit_on_the_list_of_figures_opens_that_figure_at_its_end() {
        let opening = Scene::built_in("two-springs").unwrap();
        for (index, figure) in BOOK_FIGURES.iter().enumerate() {
            let mut studio = Studio::opened(opening.clone(), None, Mode::Race);
            studio.apply(ViewCommand::ToggleFigures);
            studio.apply(StageCommand::Pick(8));
            assert_eq!(studio.bands(), [0, 1], "no figure has this digit");
            let digit: usize = figure.number.trim_start_matches("7-").parse().unwrap();
            studio.apply(StageCommand::Pick(digit - 1));
            assert_eq!(figure_of_digit(digit), Some(index));
            let lanes = studio.race().entrants().iter().map(|lane| lane.spec.method.id);
            assert_eq!(lanes.collect::<Vec<_>>(), figure.methods, "{}", figure.number);
            let name = studio.deck.scene_name();
            assert_eq!((name.as_str(), studio.race().t()), (figure.scene, figure.seconds));
            assert!(!studio.running() && studio.viewer.dialog().is_none());
        }
    }
}
