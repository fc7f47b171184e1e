//! The cost of a tick by lane: evaluations of the force, which are the same on every machine, and the time that the
//! window measures.

use egui::{FontId, Grid, Label, RichText, ScrollArea, Sense, Ui, Vec2, vec2};

use super::{ink, strong_font};
use crate::lab::number::significant;
use crate::lab::{Entrant, Lab, LaneSpec};
use crate::view::chart::legend::swatch;

/// The width of the longest bar, in points.
const BAR: f32 = 70.0;
/// From these widths on, in points, there is room for bars, and for the share of a frame.
const ROOM_FOR_BARS: f32 = 440.0;
const ROOM_FOR_SHARES: f32 = 380.0;
const ROW: f32 = 20.0;
/// A frame at 60 Hz, in nanoseconds.
const FRAME_NS: f64 = 1e9 / 60.0;
/// Said below the table.
const MEASURED: &str = "Fastest of several timed runs, repeated once per second.";
const NOT_MEASURED: &str = "Time is measured in the window.";

pub(super) fn show(ui: &mut Ui, lab: &Lab, room: Vec2) {
    let lanes: Vec<Row> =
        (0..).zip(lab.race().entrants()).map(|(i, lane)| Row::new(lab, i, lane)).collect();
    let most = lanes.iter().map(|row| row.evaluations).max().unwrap_or(0).max(1);
    let has_times = lanes.iter().any(|row| row.ns.is_some());
    ui.label(RichText::new("Cost of the next tick, all bodies").font(strong_font(13.0)));
    let height = room.y - 66.0;
    let columns = Columns {
        most: (room.x >= ROOM_FOR_BARS).then_some(most),
        has_times,
        has_shares: has_times && room.x >= ROOM_FOR_SHARES,
    };
    let gap = if room.x >= ROOM_FOR_SHARES { 12.0 } else { 8.0 };
    ScrollArea::both().id_salt("cost").max_height(height.max(40.0)).show(ui, |ui| {
        let grid = Grid::new("cost").spacing([gap, 2.0]).min_row_height(ROW);
        grid.show(ui, |ui| {
            let heads = [
                ("", true),
                ("method", true),
                ("evaluations", true),
                ("", columns.most.is_some()),
                ("time", columns.has_times),
                ("60 Hz frame", columns.has_shares),
            ];
            for (head, _) in heads.into_iter().filter(|(_, is_shown)| *is_shown) {
                ui.label(RichText::new(head).size(11.0).color(ink(ui).dim));
            }
            ui.end_row();
            for row in &lanes {
                row.show(ui, lab, &columns);
                ui.end_row();
            }
        });
    });
    let is_window = lab.viewer().pace.is_some();
    let note = match (has_times, is_window) {
        (true, _) => MEASURED,
        (false, true) => "Measuring the time …",
        (false, false) => NOT_MEASURED,
    };
    ui.add(Label::new(RichText::new(note).size(12.0).color(ink(ui).dim)).wrap());
}

/// What is shown of each lane beside its name and its evaluations.
struct Columns {
    /// The evaluations of the longest bar, if there are bars.
    most: Option<u64>,
    has_times: bool,
    has_shares: bool,
}

/// A lane.
struct Row {
    entry: usize,
    spec: LaneSpec,
    evaluations: u64,
    is_halted: bool,
    /// Nanoseconds per tick.
    ns: Option<f64>,
}

impl Row {
    fn new(lab: &Lab, place: usize, lane: &Entrant) -> Self {
        let spec = lane.spec;
        let times = lab.viewer().tick_times.iter();
        Self {
            entry: lab.entry(lane),
            spec,
            evaluations: lab.evaluations_of_next_tick(place),
            is_halted: lane.lane.halted().is_some(),
            ns: times.clone().find(|(of, _)| *of == spec).and_then(|(_, ns)| *ns),
        }
    }

    fn show(&self, ui: &mut Ui, lab: &Lab, columns: &Columns) {
        let (colour, dash) = ink(ui).style(lab.entries(), &self.spec);
        let (line, _) = ui.allocate_exact_size(vec2(30.0, ROW), Sense::hover());
        swatch(ui.painter(), line.left_center(), 28.0, dash, colour);
        let name = RichText::new(self.spec.name_with_substeps(lab.entries())).color(ink(ui).text);
        let name = if self.entry == lab.active() { name.font(strong_font(13.0)) } else { name };
        ui.label(name);
        let evaluations = self.evaluations;
        let text = if self.is_halted { "halted".into() } else { evaluations.to_string() };
        ui.label(RichText::new(text));
        if let Some(most) = columns.most {
            let (bar, response) = ui.allocate_exact_size(vec2(BAR, ROW), Sense::hover());
            let width = BAR * evaluations as f32 / most as f32;
            let size = vec2(width, ROW - 10.0);
            let filled = egui::Rect::from_min_size(bar.min + vec2(0.0, 5.0), size);
            ui.painter().rect_filled(filled, 2.0, colour);
            let about =
                format!("{}: {evaluations} evaluations in the next tick", self.spec.method.name);
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Meter, true, &about));
        }
        if columns.has_times {
            let time = self.ns.map_or_else(|| "-".into(), time);
            ui.label(RichText::new(time).font(FontId::proportional(13.0)));
        }
        if columns.has_shares {
            ui.label(self.ns.map_or_else(|| "-".into(), |ns| share(ns, lab.race().tick_hz())));
        }
    }
}

/// A time in the unit that fits it.
fn time(ns: f64) -> String {
    match ns {
        ns if ns < 1e3 => format!("{} ns", significant(ns, 3)),
        ns if ns < 1e6 => format!("{} µs", significant(ns / 1e3, 3)),
        ns => format!("{} ms", significant(ns / 1e6, 3)),
    }
}

/// The part of a frame that ticks at this rate take, if each frame is 1/60 s.
fn share(ns: f64, tick_hz: u32) -> String {
    let ticks = f64::from(tick_hz) / 60.0;
    let percent = 100.0 * ns * ticks / FRAME_NS;
    if percent < 0.01 { "< 0.01 %".into() } else { format!("{} %", significant(percent, 2)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_of_a_frame_counts_its_ticks() {
        assert_eq!(share(FRAME_NS / 100.0, 60), "1.0 %");
        assert_eq!(share(FRAME_NS / 100.0, 120), "2.0 %");
        assert_eq!(share(50.0, 60), "< 0.01 %");
        assert_eq!([time(12.34), time(4321.0), time(2.5e6)], ["12.3 ns", "4.32 µs", "2.50 ms"]);
    }
}
