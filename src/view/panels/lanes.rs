//! The list of methods: key, colour, what the card says, and how each is doing.

use egui::{Align2, Color32, FontId, Id, Pos2, Rect, ScrollArea, Sense, Ui, Vec2, pos2, vec2};

use super::{QUIET, RAISED, TEXT, colour};
use crate::lab::number::significant;
use crate::lab::picture::palette;
use crate::lab::{Command, Entrant, Halt, Lab, LaneSpec, METRICS, Metric, Mode};
use crate::view::plot;

const ROW: f32 = 20.0;
const HEAD: f32 = 16.0;

/// Rows in sight, where the window is high enough: the lanes of a usual race. The rest is scrolled to.
const ROWS: std::ops::RangeInclusive<usize> = 5..=8;

pub(super) fn height(lab: &Lab) -> f32 {
    let rows = lab.scene().lanes.len().clamp(*ROWS.start(), *ROWS.end());
    HEAD + ROW * rows as f32 + 12.0
}

pub(super) fn show(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    ui.spacing_mut().item_spacing = Vec2::ZERO;
    let width = ui.available_width();
    let columns: Vec<&Column> = COLUMNS.iter().filter(|c| width >= c.from_width).collect();
    let lefts = lefts(&columns, width);

    let (head, _) = ui.allocate_exact_size(vec2(width, HEAD), Sense::hover());
    for (column, left) in columns.iter().zip(&lefts) {
        let at = column.align.anchor(head, *left, column.width);
        ui.painter().text(
            at,
            column.align.align(),
            (column.head)(lab),
            FontId::proportional(10.5),
            QUIET,
        );
    }
    let mut list = ScrollArea::vertical().auto_shrink(false);
    if let Some(offset) = offset_to_follow(ui, lab) {
        list = list.vertical_scroll_offset(offset);
    }
    list.show(ui, |ui| {
        for (index, spec) in lab.entries().iter().enumerate() {
            let row = Row::new(lab, index, spec);
            let (rect, response) = ui.allocate_exact_size(vec2(width, ROW), Sense::click());
            let name = format!("{} {}", index + 1, spec.method.name);
            response.widget_info(|| {
                egui::WidgetInfo::selected(egui::Role::Button, true, row.active, &name)
            });
            if row.active || response.hovered() {
                let fill = if row.active { RAISED } else { RAISED.gamma_multiply(0.5) };
                ui.painter().rect_filled(rect, 3.0, fill);
            }
            for (column, left) in columns.iter().zip(&lefts) {
                (column.paint)(ui, &row, rect, *left, column);
            }
            if response.on_hover_text(spec.method.about).clicked() {
                commands.push(Command::Pick(index));
            }
        }
    });
}

/// How far to scroll for the active row to be seen when it becomes so, in this very frame; `None` at all
/// other times: a person may scroll away.
fn offset_to_follow(ui: &Ui, lab: &Lab) -> Option<f32> {
    let id = Id::unique("active lane");
    let active = lab.active();
    let known = ui.data_mut(|data| {
        let known = data.get_temp::<usize>(id);
        data.insert_temp(id, active);
        known
    });
    let room = ui.available_height();
    let bottom = ROW * (active + 1) as f32;
    let hidden = (ROW * lab.entries().len() as f32 - room).max(0.0);
    // From the top, as long as the row is in sight there: a race shows its lanes.
    let offset = if bottom <= room { 0.0 } else { bottom - (ROW + room) / 2.0 };
    (known != Some(active)).then(|| offset.clamp(0.0, hidden))
}

/// One line of the list.
struct Row<'a> {
    index: usize,
    spec: &'a LaneSpec,
    active: bool,
    /// The lane that flies this method now.
    entrant: Option<&'a Entrant>,
    lab: &'a Lab,
}

impl<'a> Row<'a> {
    fn new(lab: &'a Lab, index: usize, spec: &'a LaneSpec) -> Self {
        let entrant = lab.race().entrants().iter().find(|entrant| entrant.entry == index);
        Self { index, spec, active: index == lab.active(), entrant, lab }
    }

    fn text_colour(&self) -> Color32 {
        if self.entrant.is_some() { TEXT } else { QUIET }
    }

    /// A metric of the displayed body, where it flies.
    fn measure(&self, metric: &Metric) -> Option<f64> {
        let body = self.lab.display().body;
        let lane = &self.entrant?.lane.bodies()[body];
        (metric.measure)(lane, &self.lab.race().truth().bodies()[body])
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Side {
    Left,
    Right,
}

impl Side {
    fn align(self) -> Align2 {
        match self {
            Side::Left => Align2::LEFT_CENTER,
            Side::Right => Align2::RIGHT_CENTER,
        }
    }

    fn anchor(self, row: Rect, left: f32, width: f32) -> Pos2 {
        let x = row.left() + left + if self == Side::Left { 0.0 } else { width };
        pos2(x, row.center().y)
    }
}

/// One column of the list, and from which panel width on it is shown.
struct Column {
    head: fn(&Lab) -> String,
    width: f32,
    /// Whether it takes a share of the room that is left over.
    grows: bool,
    from_width: f32,
    align: Side,
    paint: fn(&Ui, &Row<'_>, Rect, f32, &Column),
}

const COLUMNS: &[Column] = &[
    Column {
        head: |_| "key".into(),
        width: 26.0,
        grows: false,
        from_width: 0.0,
        align: Side::Left,
        paint: |ui, row, rect, left, column| {
            let key = if row.index < 10 { format!("{}", (row.index + 1) % 10) } else { "".into() };
            write(ui, row, rect, left + 6.0, column, key, true);
        },
    },
    Column {
        head: |_| String::new(),
        width: 42.0,
        grows: false,
        from_width: 0.0,
        align: Side::Left,
        paint: swatch,
    },
    Column {
        head: |lab| match lab.mode() {
            Mode::Solo => "method".into(),
            Mode::Race => "lane".into(),
        },
        width: 140.0,
        grows: false,
        from_width: 0.0,
        align: Side::Left,
        paint: |ui, row, rect, left, column| {
            let substeps = row.spec.substeps;
            let times = if substeps > 1 { format!(" ×{substeps}") } else { String::new() };
            let within = row.spec.tolerance.map(|tolerance| format!(" {tolerance:e}"));
            let name = format!("{}{times}{}", row.spec.method.name, within.unwrap_or_default());
            write(ui, row, rect, left, column, name, false);
        },
    },
    Column {
        head: |_| "order".into(),
        width: 92.0,
        grows: false,
        from_width: 560.0,
        align: Side::Left,
        paint: |ui, row, rect, left, column| {
            let method = row.spec.method;
            let text = if method.order == method.order_with_drag {
                format!("{}", method.order)
            } else {
                format!("{}, {} with drag", method.order, method.order_with_drag)
            };
            write(ui, row, rect, left, column, text, false);
        },
    },
    Column {
        head: |_| "evaluations a step".into(),
        width: 104.0,
        grows: false,
        from_width: 700.0,
        align: Side::Left,
        paint: |ui, row, rect, left, column| {
            let cost = row.spec.method.evaluations;
            let text = cost.map_or("as needed".into(), |n| format!("{n}"));
            write(ui, row, rect, left, column, text, false);
        },
    },
    Column {
        head: |lab| of_body(lab, "evaluations"),
        width: 110.0,
        grows: false,
        from_width: 886.0,
        align: Side::Right,
        paint: |ui, row, rect, left, column| {
            let body = row.lab.display().body;
            let lane = row.entrant.map(|entrant| &entrant.lane.bodies()[body]);
            let text = lane.map_or(String::new(), |lane| format!("{}", lane.stepper.evaluations()));
            write(ui, row, rect, left, column, text, true);
        },
    },
    Column {
        head: |lab| of_body(lab, "error"),
        width: 110.0,
        grows: false,
        from_width: 0.0,
        align: Side::Right,
        paint: |ui, row, rect, left, column| metric(ui, row, rect, left, column, "position_error"),
    },
    Column {
        head: |_| "energy drift".into(),
        width: 104.0,
        grows: false,
        from_width: 560.0,
        align: Side::Right,
        paint: |ui, row, rect, left, column| metric(ui, row, rect, left, column, "energy_drift"),
    },
    Column {
        head: |lab| format!("  verdict at {} Hz", lab.clock().tick_hz()),
        width: 60.0,
        grows: true,
        from_width: 966.0,
        align: Side::Left,
        paint: fate,
    },
];

/// What a column is about, for the body displayed.
fn of_body(lab: &Lab, what: &str) -> String {
    format!("{} {what}", lab.scene().bodies[lab.display().body].name)
}

fn lefts(columns: &[&Column], width: f32) -> Vec<f32> {
    let fixed: f32 = columns.iter().map(|column| column.width + 8.0).sum();
    let growing = columns.iter().filter(|column| column.grows).count().max(1);
    let spare = (width - fixed).max(0.0) / growing as f32;
    let mut left = 0.0;
    let place = columns.iter().map(|column| {
        let here = left;
        left += column.width + 8.0 + if column.grows { spare } else { 0.0 };
        here
    });
    place.collect()
}

fn write(
    ui: &Ui,
    row: &Row<'_>,
    rect: Rect,
    left: f32,
    column: &Column,
    text: String,
    fixed_width: bool,
) {
    let font = if fixed_width { FontId::monospace(12.0) } else { FontId::proportional(12.5) };
    let at = column.align.anchor(rect, left, column.width);
    ui.painter().text(at, column.align.align(), text, font, row.text_colour());
}

fn metric(ui: &Ui, row: &Row<'_>, rect: Rect, left: f32, column: &Column, id: &str) {
    let metric = METRICS.iter().find(|metric| metric.id == id);
    let truth = &row.lab.race().truth().bodies()[row.lab.display().body];
    let text = metric.zip(row.entrant).and_then(|(metric, _)| match truth.halted() {
        Some(_) => Some("no truth".into()),
        None => {
            let value = row.measure(metric)?;
            Some(format!("{} {}", significant(value, 3), metric.unit.on(&truth.coordinates[0])))
        }
    });
    write(ui, row, rect, left, column, text.unwrap_or_default(), false);
}

/// A piece of the lane's line, as the plots draw it.
fn swatch(ui: &Ui, row: &Row<'_>, rect: Rect, left: f32, _column: &Column) {
    let (rgba, dash) = palette::style(row.spec.method);
    let colour =
        if row.entrant.is_some() { colour(rgba) } else { colour(palette::faded(rgba, 0.6)) };
    let from = pos2(rect.left() + left, rect.center().y);
    plot::swatch(ui.painter(), from, 34.0, dash, colour);
}

/// What became of the lane, or else what is to be said of its method.
fn fate(ui: &Ui, row: &Row<'_>, rect: Rect, left: f32, column: &Column) {
    let at = column.align.anchor(rect, left + 8.0, column.width);
    let mut halts: Vec<&Halt> = row.entrant.iter().flat_map(|e| e.lane.halts()).collect();
    // The displayed body first: of several, not all may fit.
    halts.sort_by_key(|halt| halt.body != row.lab.display().body);
    let halts: Vec<String> = halts
        .into_iter()
        .map(|halt| {
            let body = &row.lab.scene().bodies[halt.body].name;
            format!("{body} halted at tick {}: {}", halt.tick, halt.failure)
        })
        .collect();
    let halts = halts.join("; ");
    let (text, colour) = match halts.is_empty() {
        false => (halts, colour(palette::ALARM)),
        true => match row.lab.viewer().verdict(row.index) {
            Some(verdict) => (verdict.to_string(), super::tone(verdict.word)),
            None => return,
        },
    };
    let font = FontId::proportional(11.5);
    let room = Rect::from_min_max(pos2(at.x, rect.top()), rect.max);
    ui.painter().with_clip_rect(room).text(at, column.align.align(), text, font, colour);
}
