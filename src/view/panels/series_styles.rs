//! Styles of the curves in plots, which are those of a run's methods or of the loop lab's loops.

use egui::Color32;

use crate::loops::loop_lab::LoopLab;
use crate::run::race::Mode;
use crate::studio::{Studio, digit_of, shown_s};
use crate::theme::palette_of;

/// Styles of the curves in a plot.
pub(super) struct SeriesStyles {
    /// Styles of the curves. A track has an index into this list.
    pub(super) series: Vec<SeriesStyle>,
    /// Index of the curve in front.
    pub(super) front: usize,
    /// Whether several methods or loops run at a time, which their digits then distinguish.
    pub(super) is_race: bool,
    /// Whether the curves are those of loops, whose numbers are the digits of their keys.
    pub(super) are_loops: bool,
    /// Name of the exact curve in the legend; empty if there is none.
    pub(super) exact: String,
    pub(super) exact_colour: Color32,
    /// The displayed moment, and the length of the run, in seconds.
    pub(super) now_s: f64,
    pub(super) length_s: f64,
}

/// Style of one method or loop.
pub(super) struct SeriesStyle {
    pub(super) id: String,
    pub(super) name: String,
    pub(super) colour: Color32,
    /// Length of a dash and of the gap after it, in points.
    pub(super) dash: [f32; 2],
}

impl SeriesStyles {
    /// Returns the number of the curve with this index.
    pub(super) fn number(&self, index: usize) -> usize {
        if self.are_loops { digit_of(index) } else { index + 1 }
    }

    /// Creates the styles of the run's methods, or those of the loops if the loop lab is open.
    pub(super) fn of(studio: &Studio) -> Self {
        match studio.loop_lab() {
            Some(loops) => Self::of_loops(studio, loops),
            None => Self::of_methods(studio),
        }
    }

    fn of_methods(studio: &Studio) -> Self {
        let palette = palette_of(studio.display().theme);
        let truth = &studio.race().truth().bodies()[studio.view().body];
        let series = studio.entries().iter().map(|spec| {
            let (colour, dash) = palette.style(studio.entries(), spec);
            let [id, name] = [spec.method.id, spec.method.name];
            let [id, name] = [id, name].map(|name| spec.distinct_name(name, studio.entries()));
            SeriesStyle { id, name, colour, dash }
        });
        Self {
            series: series.collect(),
            front: studio.active(),
            is_race: studio.mode() == Mode::Race,
            are_loops: false,
            exact: match truth.halted() {
                Some(halt) if halt.failure.is_foreseen() => String::new(),
                _ => truth.truth_in_words(),
            },
            exact_colour: palette.exact,
            now_s: shown_s(studio),
            length_s: studio.scene().seconds,
        }
    }

    fn of_loops(studio: &Studio, loops: &LoopLab) -> Self {
        let palette = palette_of(studio.display().theme);
        let series = loops.lanes().iter().enumerate().map(|(index, lane)| {
            let card = lane.card();
            let (colour, dash) = palette.loop_style(index);
            SeriesStyle { id: card.id.clone(), name: card.name.clone(), colour, dash }
        });
        Self {
            series: series.collect(),
            front: loops.selected(),
            is_race: true,
            are_loops: true,
            exact: loops.body().truth().id().into(),
            exact_colour: palette.exact,
            now_s: loops.now_ns() as f64 / 1e9,
            length_s: loops.end_ns() as f64 / 1e9,
        }
    }
}
