//! A histogram of the number of ticks in a frame.

use egui::{Align2, Color32, Rect, Ui, pos2, vec2};

use super::row::Row;
use crate::chart::{self, AxisScale, PlotArea, Primitive, Text};
use crate::panels::breakpoints;
use crate::panels::table::TableRow;
use crate::stage::number::round;
use crate::theme::{PanelPalette, palette};

/// Names of the bins. The last bin includes all higher counts.
const NAMES: [&str; 4] = ["0", "1", "2", "3+"];
/// Height of the title, width of the numbers at the left, height of those below, and height of the axis's name, in
/// points.
pub(super) const TITLE: f32 = 24.0;
pub(super) const LEFT: f32 = 41.0;
pub(super) const BELOW: f32 = 17.0;
pub(super) const NAME: f32 = 15.0;
/// Height for the numbers over the bars, in points.
const ABOVE: f32 = 17.0;
/// Share of a group's width that the bars fill.
const BARS: f32 = 0.78;
/// Minimum height of a bar, in points. A share of zero has this height.
const MIN_HEIGHT: f32 = 1.5;

/// The shares of one loop in the histogram.
pub(super) struct Series {
    colour: Color32,
    shares_percent: [f64; 4],
    /// Whether the loop's numbers appear if there is no room for all numbers.
    is_first: bool,
}

impl Series {
    pub(super) fn new(colour: Color32, ticks: impl Iterator<Item = u32>) -> Self {
        Self { colour, shares_percent: shares_percent(ticks), is_first: true }
    }

    pub(super) fn of_row(row: &Row<'_>, palette: &PanelPalette) -> Self {
        let ticks = row.lane().frames().iter().map(|frame| frame.ticks);
        Self { is_first: row.is_selected(), ..Self::new(row.style(palette).0, ticks) }
    }
}

/// Returns the shares of the frames that have 0, 1, 2, and 3 or more ticks, in percent.
fn shares_percent(ticks: impl Iterator<Item = u32>) -> [f64; 4] {
    let mut counts = [0_u64; 4];
    ticks.for_each(|ticks| counts[(ticks as usize).min(3)] += 1);
    let all = counts.iter().sum::<u64>().max(1) as f64;
    counts.map(|count| 100.0 * count as f64 / all)
}

/// Formats a share with at most four characters.
fn percent(share: f64) -> String {
    match share {
        share if share > 0.0 && share < 0.1 => "<0.1".into(),
        share if share < 10.0 => round(share, 2),
        share => round(share, 3),
    }
}

/// Describes the shares for a screen reader.
fn in_words(series: &[Series]) -> String {
    let of_one = |series: &Series| {
        let shares = NAMES.iter().zip(series.shares_percent);
        let shares = shares.map(|(name, share)| format!("{name}: {} %", percent(share)));
        shares.collect::<Vec<_>>().join(", ")
    };
    format!("Ticks per frame: {}", series.iter().map(of_one).collect::<Vec<_>>().join("; "))
}

/// Shows the shares, with a bar for each loop.
pub(super) fn show(ui: &Ui, room: Rect, series: &[Series]) {
    let bars = ui.interact(room, ui.scope_id().with("ticks per frame"), egui::Sense::hover());
    bars.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, in_words(series)));
    chart::paint(&ui.painter_at(room), &layout(room, series, palette(ui)));
}

/// Lays out the chart of the shares in a room.
pub(super) fn layout(room: Rect, series: &[Series], palette: &PanelPalette) -> Vec<Primitive> {
    let title = Text::new(room.left_top(), Align2::LEFT_TOP, "Ticks per frame", 13.0, palette.text);
    let mut all = vec![title.strong().into()];
    let rect = Rect::from_min_max(room.min + vec2(LEFT, TITLE), room.max - vec2(2.0, BELOW + NAME));
    if !rect.is_positive() || rect.height() < 2.0 * ABOVE {
        return all;
    }
    let highest = series.iter().flat_map(|series| series.shares_percent).fold(0.0, f64::max);
    let top = highest.max(10.0) * f64::from(rect.height() / (rect.height() - ABOVE));
    let area = PlotArea { rect, bounds: [[-0.5, 3.5], [0.0, top]] };
    all.push(Primitive::Area(rect, palette.plot));
    let marks = area.marks(1, AxisScale::Linear, 24.0).into_iter();
    let marks: Vec<_> = marks.map(|(value, text)| (value, format!("{text} %"))).collect();
    all.extend(chart::axes(&area, [Vec::new(), marks], palette, room.right()));
    let group = rect.width() / NAMES.len() as f32;
    let width = group * BARS / series.len().max(1) as f32;
    let has_room = width >= breakpoints::NUMBER_ON_BAR;
    // Only the first series has numbers if there is no room for all, and each number is over its bar.
    let first = series.iter().position(|series| series.is_first);
    for (count, name) in NAMES.iter().enumerate() {
        let middle = rect.left() + group * (count as f32 + 0.5);
        let at = pos2(middle, rect.bottom() + 3.0);
        all.push(Text::new(at, Align2::CENTER_TOP, *name, 11.0, palette.dim).into());
        let mut numbers = Vec::new();
        for (i, series) in series.iter().enumerate() {
            let share = series.shares_percent[count];
            let left = middle - group * BARS / 2.0 + width * i as f32;
            let top = area.height(share).min(rect.bottom() - MIN_HEIGHT);
            let bar = Rect::from_x_y_ranges(left + 0.5..=left + width - 0.5, top..=rect.bottom());
            all.push(Primitive::Area(bar, series.colour));
            if has_room || first == Some(i) {
                // Over a narrow bar, a third digit would lie on the next bar.
                let is_long = !has_room && share >= 10.0;
                let text = if is_long { round(share, 2) } else { percent(share) };
                let at = bar.center_top() - vec2(0.0, 1.0);
                let number = Text::new(at, Align2::CENTER_BOTTOM, text, 11.0, series.colour);
                numbers.push(Text { right: room.right(), ..number.strong() }.into());
            }
        }
        all.append(&mut numbers);
    }
    let [name, _] = chart::names(&area, room.left(), ["ticks in a frame", ""], palette);
    all.push(name.into());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_screen_reader_hears_the_bars_in_words() {
        let series = [Series::new(Color32::WHITE, [0, 1, 1, 2].into_iter())];
        let told = "Ticks per frame: 0: 25 %, 1: 50 %, 2: 25 %, 3+: 0 %";
        assert_eq!(in_words(&series), told);
    }

    #[test]
    fn a_share_is_short() {
        let shares = [0.0, 0.0833, 0.128, 8.333, 24.92, 100.0];
        let written = ["0", "<0.1", "0.13", "8.3", "24.9", "100"];
        assert_eq!(shares.map(percent), written);
    }

    #[test]
    fn shares_are_in_percent_with_three_or_more_ticks_together() {
        assert_eq!(
            shares_percent([0, 1, 1, 2, 3, 250, 0, 1].into_iter()),
            [25.0, 37.5, 12.5, 25.0]
        );
        assert_eq!(shares_percent([].into_iter()), [0.0; 4]);
    }
}
