//! Cost of a tick by lane: the number of force evaluations, which is the same on every machine, and the time measured
//! in the window.

use egui::{Color32, Label, Rect, RichText, Ui, Vec2, vec2};

use super::table::{Column, SortKey, Table, TableRow, show_words};
use crate::run::MenuIndex;
use crate::run::race::Mode;
use crate::scene::LaneSpec;
use crate::scene::TickRate;
use crate::stage::number::significant;
use crate::studio::{Command, StageCommand, Studio};
use crate::theme::{PanelPalette, palette, strong_font};

/// Height of a row and font size of the heads, in points.
const ROW: f32 = 22.0;
const HEAD_TYPE: f32 = 11.0;
/// Minimum width of a method's name, in points.
const MIN_NAME: f32 = 104.0;
/// Duration of a frame at 60 Hz, in nanoseconds.
const FRAME_NS: f64 = 1e9 / 60.0;
/// Notes below the table.
const MEASURED: &str = "Fastest of several timed runs, repeated once per second.";
const NOT_MEASURED: &str = "Time is measured in the window.";

pub(super) fn show(ui: &mut Ui, studio: &Studio, room: Vec2, commands: &mut Vec<Command>) {
    // In solo mode, the table compares the methods that a digit selects.
    let is_shown = |entry: &usize| match studio.mode() {
        Mode::Solo if studio.viewer.is_asked() => *entry == studio.active(),
        Mode::Solo => *entry < studio.deck.offered(),
        Mode::Race => studio.deck.lane_of(*entry).is_some(),
    };
    let entries = (0..studio.entries().len()).filter(is_shown);
    let rows: Vec<Row<'_>> = entries.map(|entry| Row::new(studio, entry)).collect();
    let most = rows.iter().map(|row| row.evaluations).max().unwrap_or(0).max(1);
    let has_times = rows.iter().any(|row| row.ns.is_some());
    ui.label(RichText::new("Cost of the next tick, all bodies").font(strong_font(13.0)));
    let columns = columns(most, has_times);
    let table = Table {
        id: "cost",
        columns,
        min_rest: |_| MIN_NAME,
        row_height: ROW,
        head_type: HEAD_TYPE,
    };
    let height = (ROW * (rows.len() + 1) as f32).min(room.y - 66.0).max(60.0);
    let groups = rows.into_iter().map(|row| vec![row]).collect();
    ui.allocate_ui(vec2(room.x, height), |ui| table.show(ui, groups, commands, |_, _, _| {}));
    let is_window = studio.viewer.pace.is_some();
    let note = match (has_times, is_window) {
        (true, _) => MEASURED,
        (false, true) => "Measuring the time …",
        (false, false) => NOT_MEASURED,
    };
    ui.add(Label::new(RichText::new(note).size(12.0).color(palette(ui).dim)).wrap());
}

/// Returns the columns of the table. The longest bar shows `most` evaluations.
fn columns<'a>(most: u64, has_times: bool) -> Vec<Column<Row<'a>>> {
    let about = "the line of this method in the plots and on the stage";
    let line = Column::line(about, |row: &Row<'a>| Some(row.entry));
    let method = Column::shown(
        "method",
        0.0,
        "the integrator of this lane; × is its substeps",
        |ui, row: &Row<'a>, rect, _| {
            let name = row.spec.name_with_substeps(row.studio.entries());
            show_words(ui, rect, &name, row.is_selected(), palette(ui).text);
        },
        |row| SortKey::Words(row.spec.method.name.into()),
    );
    let evaluations = Column::number(
        "evaluations",
        (68.0, 0),
        "evaluations of the force in the next tick, the same on every machine",
        |row: &Row<'a>| {
            Some(if row.is_halted { "halted".into() } else { row.evaluations.to_string() })
        },
        |row| Some(row.evaluations as f64),
    );
    let bar = Column::shown(
        "bar",
        50.0,
        "the same as a bar",
        move |ui, row: &Row<'a>, rect, _| {
            let part = row.evaluations as f32 / most as f32;
            let size = vec2(part * rect.width(), rect.height() - 12.0);
            let bar = Rect::from_min_size(rect.min + vec2(0.0, 6.0), size);
            ui.painter().rect_filled(bar, 2.0, row.style(palette(ui)).0);
        },
        |row| SortKey::Number(row.evaluations as f64),
    );
    let bar = Column { priority: 3, ..bar.headed("") };
    let mut all = vec![line, method, evaluations, bar];
    if has_times {
        let dash = || "-".to_owned();
        let time_of = move |row: &Row<'a>| Some(row.ns.map_or_else(dash, time));
        let share_of = move |row: &Row<'a>| {
            Some(row.ns.map_or_else(dash, |ns| share(ns, row.studio.race().tick_hz())))
        };
        let ns = |row: &Row<'a>| row.ns;
        all.push(Column::number(
            "time",
            (58.0, 1),
            "time of the next tick on this machine",
            time_of,
            ns,
        ));
        let about = "the share of a frame at 60 Hz that its ticks take";
        all.push(Column::number("60 Hz frame", (70.0, 2), about, share_of, ns));
    }
    all
}

/// A row of the table, which is about one method.
struct Row<'a> {
    studio: &'a Studio,
    entry: MenuIndex,
    spec: LaneSpec,
    evaluations: u64,
    is_halted: bool,
    /// Measured time of a tick, in nanoseconds.
    ns: Option<f64>,
}

impl<'a> Row<'a> {
    fn new(studio: &'a Studio, entry: MenuIndex) -> Self {
        let flown = studio.deck.lane_of(entry);
        let spec = flown.map_or(studio.entries()[entry], |lane| lane.spec);
        let mut times = studio.viewer.tick_times.iter();
        Self {
            studio,
            entry,
            spec,
            evaluations: studio.deck.evaluations_of_next_tick(entry),
            is_halted: flown.is_some_and(|lane| lane.lane.halted().is_some()),
            ns: times.find(|(of, _)| *of == spec).and_then(|(_, ns)| *ns),
        }
    }
}

impl TableRow for Row<'_> {
    fn spoken(&self) -> String {
        format!("{} {}", self.entry + 1, self.spec.name_with_substeps(self.studio.entries()))
    }

    fn is_selected(&self) -> bool {
        self.entry == self.studio.active()
    }

    fn style(&self, palette: &PanelPalette) -> (Color32, [f32; 2]) {
        palette.style(self.studio.entries(), &self.spec)
    }

    fn command(&self) -> Option<Command> {
        Some(Command::Stage(StageCommand::Pick(self.entry)))
    }

    fn tooltip(&self, ui: &mut Ui) {
        ui.label(self.spec.method.about);
    }
}

/// Formats a time in the unit that fits it.
fn time(ns: f64) -> String {
    match ns {
        ns if ns < 1e3 => format!("{} ns", significant(ns, 3)),
        ns if ns < 1e6 => format!("{} µs", significant(ns / 1e3, 3)),
        ns => format!("{} ms", significant(ns / 1e6, 3)),
    }
}

/// Returns the share of a frame of 1/60 s that ticks of `ns` nanoseconds take at this rate.
fn share(ns: f64, tick_hz: TickRate) -> String {
    let ticks = f64::from(tick_hz) / 60.0;
    let percent = 100.0 * ns * ticks / FRAME_NS;
    if percent < 0.01 { "< 0.01 %".into() } else { format!("{} %", significant(percent, 2)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::studio::guide::STOPS;
    use crate::studio::{Instrument, ViewCommand};
    use crate::tests::testing::TestWindow;

    #[test]
    fn solo_compares_the_costs_of_offered_methods_after_the_prediction() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        let stop = STOPS.iter().position(|stop| stop.instrument == Instrument::Cost).unwrap();
        studio.apply(ViewCommand::GoToStop(stop));
        let count = |studio: &Studio, name: &str| {
            let mut window = TestWindow::new([1280.0, 800.0]);
            let shown = |window: &mut TestWindow| {
                window.show(Vec::new(), |ui| show(ui, studio, vec2(480.0, 400.0), &mut vec![])).1
            };
            drop(shown(&mut window));
            shown(&mut window).words().iter().filter(|words| *words == name).count()
        };
        let both =
            |studio: &Studio| ["Explicit Euler", "Adaptive Euler"].map(|name| count(studio, name));
        assert_eq!(both(&studio), [1, 0], "it would answer");
        studio.apply(ViewCommand::Predict(0));
        assert_eq!(both(&studio), [1, 1]);
        let entry = |id| studio.entries().iter().position(|it| it.method.id == id).unwrap();
        let [plain, halved] = ["explicit-euler", "adaptive-euler"]
            .map(|id| studio.deck.evaluations_of_next_tick(entry(id)));
        assert!(plain == 1 && (3..100).contains(&halved), "{plain} {halved}");
        // A lane that flies the method takes the same number of evaluations.
        studio.apply(StageCommand::Pick(entry("adaptive-euler")));
        let flown = studio.deck.evaluations_of_next_tick(studio.active());
        assert_eq!(flown, halved);
    }

    #[test]
    fn the_share_of_a_frame_counts_its_ticks() {
        assert_eq!(share(FRAME_NS / 100.0, 60.into()), "1.0 %");
        assert_eq!(share(FRAME_NS / 100.0, 120.into()), "2.0 %");
        assert_eq!(share(50.0, 60.into()), "< 0.01 %");
        assert_eq!([time(12.34), time(4321.0), time(2.5e6)], ["12.3 ns", "4.32 µs", "2.50 ms"]);
    }
}
