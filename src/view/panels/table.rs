//! Tables with as many columns as fit. A click on a head sorts the rows. The mouse and the keyboard can select a row,
//! and a screen reader reads the row's numbers.

use egui::{Align2, Color32, FontId, Id, Rect, Response, ScrollArea, Sense, Ui, Vec2, pos2, vec2};

use super::parts::short;
use super::verdict::VerdictText;
use super::{focus, keycap};
use crate::chart;
use crate::chart::legend::swatch;
use crate::studio::Command;
use crate::theme::{PanelPalette, TYPE, palette, strong_font};

/// Width of the bar at the left of the selected row, and width of the margin around a row, in points.
const BAR: f32 = 4.0;
pub(super) const MARGIN: f32 = 8.0;
/// The room between two columns, in points.
pub(super) const GAP: f32 = 8.0;
/// Minimum font size of a cell, in points.
const MIN_TYPE: f32 = 9.0;
/// Width of a column below which names have the smaller font size, and that font size, both in points.
const NARROW: f32 = 140.0;
const NARROW_TYPE: f32 = 10.5;
/// Gap between the words of a head and the words at its right end, in points.
const BESIDE_HEAD: f32 = 30.0;

/// A row of a table.
pub(super) trait TableRow {
    /// Returns the text that a screen reader reads before the row's numbers.
    fn spoken(&self) -> String;

    /// Whether the keys and the stage refer to this row.
    fn is_selected(&self) -> bool;

    /// Returns the colour and dash of the row's line. A bar of this colour marks the selected row.
    fn style(&self, palette: &PanelPalette) -> (Color32, [f32; 2]);

    /// Whether the row is about something that is neither in the plots nor on the stage.
    fn is_dim(&self) -> bool {
        false
    }

    /// Returns the colour of the row's numbers.
    fn text(&self, ui: &Ui) -> Color32 {
        if self.is_dim() { palette(ui).dim } else { palette(ui).text }
    }

    /// Returns the command that a click on the row issues, or `None` if a click does nothing.
    fn command(&self) -> Option<Command>;

    /// Shows further details of the row.
    fn tooltip(&self, ui: &mut Ui);
}

/// Sort key of a row in a column. Rows without a value come last.
#[derive(Debug, PartialEq, PartialOrd)]
pub(super) enum SortKey {
    Number(f64),
    Words(String),
    Nothing,
}

impl From<Option<f64>> for SortKey {
    fn from(value: Option<f64>) -> Self {
        value.filter(|value| !value.is_nan()).map_or(Self::Nothing, Self::Number)
    }
}

/// The text of a number in a row, or `None` if the row has no value.
type NumberText<R> = Box<dyn Fn(&R) -> Option<String>>;
/// A function that shows a cell of a row in a rectangle, and may issue commands.
type ShowCell<R> = Box<dyn Fn(&mut Ui, &R, Rect, &mut Vec<Command>)>;

/// Contents of a cell.
pub(super) enum CellContent<R> {
    /// A number, right-aligned.
    Number(NumberText<R>),
    Shown(ShowCell<R>),
}

/// A column of a table of rows `R`.
pub(super) struct Column<R> {
    /// Name of the column, unique in the table. A screen reader reads it too.
    pub(super) name: &'static str,
    pub(super) head: String,
    /// Text at the right end of the head, if there is room.
    pub(super) beside_head: Option<String>,
    /// Tooltip of the column's head.
    pub(super) about: String,
    /// Width in points. The column of width 0, of which there is one, takes the remaining width.
    pub(super) width: f32,
    /// Columns are added in the order of their priorities while there is room. Columns with priority 0 are always
    /// shown.
    pub(super) priority: u8,
    pub(super) cell: CellContent<R>,
    pub(super) sort_key: Box<dyn Fn(&R) -> SortKey>,
}

impl<R> Column<R> {
    /// Creates a column that is always shown.
    pub(super) fn shown(
        name: &'static str,
        width: f32,
        about: &str,
        show: impl Fn(&mut Ui, &R, Rect, &mut Vec<Command>) + 'static,
        sort_key: impl Fn(&R) -> SortKey + 'static,
    ) -> Self {
        Self {
            name,
            head: name.into(),
            beside_head: None,
            about: about.into(),
            width,
            priority: 0,
            cell: CellContent::Shown(Box::new(show)),
            sort_key: Box::new(sort_key),
        }
    }

    /// Creates a column of numbers. Each row has a text and a sort key.
    pub(super) fn number(
        name: &'static str,
        (width, priority): (f32, u8),
        about: &str,
        text: impl Fn(&R) -> Option<String> + 'static,
        value: impl Fn(&R) -> Option<f64> + 'static,
    ) -> Self {
        let cell = CellContent::Number(Box::new(text));
        let sort_key = move |row: &R| value(row).into();
        let column = Self::shown(name, width, about, |_, _, _, _| {}, sort_key);
        Self { priority, cell, ..column }
    }

    /// Returns the same column with this head.
    pub(super) fn headed(self, head: impl Into<String>) -> Self {
        Self { head: head.into(), ..self }
    }

    fn is_number(&self) -> bool {
        matches!(self.cell, CellContent::Number(_))
    }
}

impl<R: TableRow> Column<R> {
    /// Creates the column of keys, which select the first ten indices. A row without an index has no key.
    pub(super) fn key(about: &str, index: impl Fn(&R) -> Option<usize> + Copy + 'static) -> Self {
        let show = move |ui: &mut Ui, row: &R, rect: Rect, _: &mut Vec<Command>| {
            let Some(index) = index(row).filter(|index| *index < 10) else { return };
            let colour = match row.is_selected() {
                true => palette(ui).accent,
                false => row.text(ui),
            };
            let (at, key) = (rect.left_center(), format!("{}", (index + 1) % 10));
            keycap::paint(ui, at.x, at.y, &key, colour);
        };
        Self::shown("Key", 26.0, about, show, move |row| by_index(index(row)))
    }

    /// Creates the column of lines, each with the colour and dash of its row in the plots. A row without an index has
    /// no line.
    pub(super) fn line(about: &str, index: impl Fn(&R) -> Option<usize> + Copy + 'static) -> Self {
        let show = move |ui: &mut Ui, row: &R, rect: Rect, _: &mut Vec<Command>| {
            if index(row).is_some() {
                let (colour, dash) = row.style(palette(ui));
                let colour = if row.is_dim() { colour.gamma_multiply(0.7) } else { colour };
                let line = swatch(rect.left_center(), rect.width() - 4.0, dash, colour);
                chart::paint(ui.painter(), &line);
            }
        };
        Self::shown("line", 36.0, about, show, move |row| by_index(index(row))).headed("")
    }

    /// Creates the column of verdicts, which takes the remaining width.
    pub(super) fn verdict(about: &str, text: impl Fn(&R) -> VerdictText + Copy + 'static) -> Self {
        let show = move |ui: &mut Ui, row: &R, rect: Rect, _: &mut Vec<Command>| {
            if ui.is_rect_visible(rect) {
                text(row).show(ui, rect, row.text(ui));
            }
        };
        Self::shown("Verdict", 0.0, about, show, move |row| text(row).rank.into())
    }
}

fn by_index(index: Option<usize>) -> SortKey {
    index.map(|index| index as f64).into()
}

pub(super) struct Table<R> {
    /// Id of the table, unique among all tables.
    pub(super) id: &'static str,
    /// Columns from left to right.
    pub(super) columns: Vec<Column<R>>,
    /// Minimum width, in points, of the column that takes the remaining width, beside columns up to this priority.
    pub(super) min_rest: fn(u8) -> f32,
    /// Height of a row, and font size of the heads, both in points.
    pub(super) row_height: f32,
    pub(super) head_type: f32,
}

/// The column that sorts the rows, and whether the order is reversed. `None` keeps the given order of the rows.
pub(super) type Order = Option<(&'static str, bool)>;

/// Returns the order after a click on the head of a column. Successive clicks sort by the column, then in reverse, then
/// not at all.
fn order_after_click(order: Order, name: &'static str) -> Order {
    match order {
        Some((by, false)) if by == name => Some((name, true)),
        Some((by, true)) if by == name => None,
        _ => Some((name, false)),
    }
}

/// Returns the arrow after the head of a column, which points up if the values rise from row to row.
fn arrow(order: Order, name: &str) -> &'static str {
    match order {
        Some((by, false)) if by == name => " ↑",
        Some((by, true)) if by == name => " ↓",
        _ => "",
    }
}

impl<R: TableRow> Table<R> {
    /// Returns the height of the heads, in points.
    fn head_height(&self) -> f32 {
        self.row_height - 2.0
    }

    /// Shows the rows. The rows of a group stay together. `each` is called with every row and its response.
    pub(super) fn show(
        &self,
        ui: &mut Ui,
        groups: Vec<Vec<R>>,
        commands: &mut Vec<Command>,
        mut each: impl FnMut(&R, &Response, &mut Vec<Command>),
    ) {
        ui.spacing_mut().item_spacing = Vec2::ZERO;
        let width = ui.available_width();
        let columns = self.fitting(width - 2.0 * MARGIN);
        let order = self.show_heads(ui, &columns, width);
        let rows: Vec<R> = self.sorted(groups, order).into_iter().flatten().collect();
        // The last row in sight must not be faded.
        ui.spacing_mut().scroll.fade.strength = 0.0;
        let mut list = ScrollArea::vertical().id_salt(self.id).auto_shrink(false);
        // A panel beside the table may leave no room for a row.
        list = list.min_scrolled_height(0.0);
        let selected = rows.iter().position(R::is_selected).unwrap_or_default();
        if let Some(offset) = self.offset_to_follow(ui, selected, rows.len()) {
            list = list.vertical_scroll_offset(offset);
        }
        list.show(ui, |ui| {
            for row in &rows {
                let response = self.show_row(ui, row, &columns, width, commands);
                each(row, &response, commands);
            }
            focus::follow(ui);
        });
    }

    /// Returns the columns that fit this width, each with its left edge and its width.
    pub(super) fn fitting(&self, width: f32) -> Vec<(&Column<R>, f32, f32)> {
        let taken = |most: u8| self.columns.iter().filter(move |column| column.priority <= most);
        let rest = |most: u8| width - taken(most).map(|column| column.width + GAP).sum::<f32>();
        let last = self.columns.iter().map(|column| column.priority).max().unwrap_or_default();
        let fits = |most: &u8| rest(*most) >= (self.min_rest)(*most);
        let most = (1..=last).take_while(fits).last().unwrap_or(0);
        let mut left = 0.0;
        let placed = taken(most).map(|column| {
            let own = if column.width > 0.0 { column.width } else { rest(most).max(0.0) };
            let here = left;
            left += own + GAP;
            (column, here, own)
        });
        placed.collect()
    }

    /// Shows the heads of the columns. Returns the order that the user has chosen with them.
    fn show_heads(&self, ui: &mut Ui, columns: &[(&Column<R>, f32, f32)], width: f32) -> Order {
        let id = Id::unique(("order of a table", self.id));
        let mut order = ui.data(|data| data.get_temp::<Order>(id)).flatten();
        let (line, _) = ui.allocate_exact_size(vec2(width, self.head_height()), Sense::hover());
        for &(column, left, own) in columns {
            let at = pos2(line.left() + MARGIN + left, line.top());
            let rect = Rect::from_min_size(at, vec2(own, line.height()));
            let head = Id::unique(("head of a table", self.id, column.name));
            let response = ui.interact(rect, head, Sense::click());
            let name = format!("sort by {}", column.name);
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
            let is_lit = response.hovered() || response.has_focus();
            let inked = if is_lit { palette(ui).accent } else { palette(ui).dim };
            let side = if column.is_number() { Align2::RIGHT_CENTER } else { Align2::LEFT_CENTER };
            let words = format!("{}{}", column.head, arrow(order, column.name));
            let font = || FontId::proportional(self.head_type);
            let (text, _) = short(ui, &words, font(), own, inked);
            let room = own - text.size().x;
            let corner = side.align_size_within_rect(text.size(), rect).min;
            ui.painter().galley(corner, text, inked);
            if let Some(words) = &column.beside_head {
                let dim = palette(ui).dim;
                let beside = ui.painter().layout_no_wrap(words.clone(), font(), dim);
                if beside.size().x + BESIDE_HEAD < room {
                    let at = Align2::RIGHT_CENTER.align_size_within_rect(beside.size(), rect).min;
                    ui.painter().galley(at, beside, dim);
                }
            }
            if response.on_hover_text(&column.about).clicked() {
                order = order_after_click(order, column.name);
                ui.data_mut(|data| data.insert_temp(id, order));
            }
        }
        order
    }

    /// Sorts the groups by their first rows.
    pub(super) fn sorted(&self, mut groups: Vec<Vec<R>>, order: Order) -> Vec<Vec<R>> {
        let by = order.and_then(|(name, is_reversed)| {
            Some((self.columns.iter().find(|column| column.name == name)?, is_reversed))
        });
        if let Some((column, is_reversed)) = by {
            let key = |rows: &Vec<R>| rows.first().map_or(SortKey::Nothing, &column.sort_key);
            groups.sort_by(|a, b| {
                let (a, b) = (key(a), key(b));
                let by_key = a.partial_cmp(&b).unwrap_or(std::cmp::Ordering::Equal);
                // Rows without a value stay last.
                let is_last = [&a, &b].contains(&&SortKey::Nothing);
                if is_reversed && !is_last { by_key.reverse() } else { by_key }
            });
        }
        groups
    }

    fn show_row(
        &self,
        ui: &mut Ui,
        row: &R,
        columns: &[(&Column<R>, f32, f32)],
        width: f32,
        commands: &mut Vec<Command>,
    ) -> Response {
        let command = row.command();
        let sense = if command.is_some() { Sense::click() } else { Sense::hover() };
        let (rect, response) = ui.allocate_exact_size(vec2(width, self.row_height), sense);
        let is_selected = row.is_selected();
        response.widget_info(|| {
            let heard = columns.iter().filter_map(|(column, ..)| match &column.cell {
                CellContent::Number(text) => Some(format!(", {} {}", column.name, text(row)?)),
                CellContent::Shown(_) => None,
            });
            let name = row.spoken() + &heard.collect::<String>();
            egui::WidgetInfo::selected(egui::Role::Button, true, is_selected, name)
        });
        let ((own, _), text) = (row.style(palette(ui)), row.text(ui));
        if is_selected || command.is_some() && response.hovered() {
            let fill = palette(ui).raised.gamma_multiply(if is_selected { 1.0 } else { 0.6 });
            ui.painter().rect_filled(rect, 3.0, fill);
        }
        if is_selected {
            let bar = vec2(BAR, self.row_height - 2.0);
            let bar = Rect::from_min_size(rect.min + vec2(0.0, 1.0), bar);
            ui.painter().rect_filled(bar, 2.0, own);
        }
        let response = response.on_hover_ui(|ui| row.tooltip(ui));
        if response.clicked() {
            commands.extend(command);
        }
        let is_in_sight = ui.is_rect_visible(rect);
        // The cells lie over the row, so that their buttons receive the click.
        for &(column, left, own) in columns {
            let from = pos2(rect.left() + MARGIN + left, rect.top());
            let cell = Rect::from_min_size(from, vec2(own, self.row_height));
            match &column.cell {
                CellContent::Shown(show) => show(ui, row, cell, commands),
                // A cell with a number has no buttons, so it can be skipped out of sight.
                CellContent::Number(_) if !is_in_sight => {}
                CellContent::Number(words) => {
                    let (at, font) = (cell.right_center(), FontId::proportional(TYPE));
                    let words = words(row).unwrap_or_default();
                    ui.painter().text(at, Align2::RIGHT_CENTER, words, font, text);
                }
            }
        }
        response
    }

    /// Returns the scroll offset that shows a newly selected row, or `None` if the selection has not changed, because
    /// the user may have scrolled away from the row.
    fn offset_to_follow(&self, ui: &Ui, selected: usize, rows: usize) -> Option<f32> {
        let id = Id::unique(("selected row of a table", self.id));
        let known = ui.data_mut(|data| {
            let known = data.get_temp::<usize>(id);
            data.insert_temp(id, selected);
            known
        });
        let room = ui.available_height();
        let bottom = self.row_height * (selected + 1) as f32;
        let hidden = (self.row_height * rows as f32 - room).max(0.0);
        // The list stays at its top if the row is in sight there, because a race then shows its first lanes.
        let offset = if bottom <= room { 0.0 } else { bottom - (self.row_height + room) / 2.0 };
        (known != Some(selected)).then(|| offset.clamp(0.0, hidden))
    }
}

/// Writes words into a cell. Words that are too long shrink before they are truncated.
pub(super) fn show_words(ui: &Ui, rect: Rect, words: &str, is_strong: bool, colour: Color32) {
    let mut size = TYPE;
    let galley = loop {
        let font = if is_strong { strong_font(size) } else { FontId::proportional(size) };
        let (galley, is_whole) = short(ui, words, font, rect.width(), colour);
        if is_whole || size <= MIN_TYPE {
            break galley;
        }
        size -= 0.5;
    };
    let at = rect.left_center() - vec2(0.0, galley.size().y / 2.0);
    ui.painter().galley(at, galley, colour);
}

/// Writes a name into a cell, and truncates it if it is too long. All names in a column have the same size.
pub(super) fn show_name(ui: &Ui, rect: Rect, name: &str, colour: Color32) {
    let size = if rect.width() < NARROW { NARROW_TYPE } else { TYPE };
    let (galley, _) = short(ui, name, FontId::proportional(size), rect.width(), colour);
    let at = rect.left_center() - vec2(0.0, galley.size().y / 2.0);
    ui.painter().galley(at, galley, colour);
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Number(f64);

    impl TableRow for Number {
        fn spoken(&self) -> String {
            "number".into()
        }

        fn is_selected(&self) -> bool {
            false
        }

        fn style(&self, palette: &PanelPalette) -> (Color32, [f32; 2]) {
            (palette.text, [1.0, 0.0])
        }

        fn command(&self) -> Option<Command> {
            None
        }

        fn tooltip(&self, _: &mut Ui) {}
    }

    fn table() -> Table<Number> {
        let key = |row: &Number| Some(row.0).into();
        let number = |name, priority| {
            Column::number(name, (60.0, priority), "", |_| None, |row: &Number| Some(row.0))
        };
        let rest = Column::shown("rest", 0.0, "", |_, _, _, _| {}, key);
        let columns = vec![rest, number("first", 1), number("third", 3), number("second", 2)];
        Table { id: "numbers", columns, min_rest: |_| 100.0, row_height: 26.0, head_type: TYPE }
    }

    #[test]
    fn a_second_click_reverses_the_order_and_a_third_ends_it() {
        let by = order_after_click(None, "a");
        assert_eq!((by, arrow(by, "a"), arrow(by, "b")), (Some(("a", false)), " ↑", ""));
        let reversed = order_after_click(by, "a");
        assert_eq!((reversed, arrow(reversed, "a")), (Some(("a", true)), " ↓"));
        assert_eq!(order_after_click(reversed, "a"), None);
    }

    #[test]
    fn columns_fill_the_width_and_no_number_squeezes_out_the_others() {
        let table = table();
        let mut before = 0;
        for width in (50..400).map(|width| width as f32) {
            let columns = table.fitting(width);
            assert!(columns.len() >= before, "{width}");
            before = columns.len();
            let (rest, _, own) = columns[0];
            assert!(rest.name == "rest" && (own >= 100.0 || columns.len() == 1), "{width}");
            let (_, left, own) = columns[columns.len() - 1];
            assert!((left + own + GAP - width).abs() < 0.01, "{width}");
        }
        assert_eq!(before, table.columns.len());
        let names: Vec<_> = table.fitting(250.0).iter().map(|(column, ..)| column.name).collect();
        assert_eq!(names, ["rest", "first", "second"]);
    }

    #[test]
    fn rows_without_a_value_stay_last_both_ways() {
        let values = |is_reversed| -> Vec<f64> {
            let groups = [2.0, f64::NAN, 1.0, 3.0].map(|value| vec![Number(value)]).into();
            let rows = table().sorted(groups, Some(("first", is_reversed)));
            rows.into_iter().flatten().map(|row| row.0).take(3).collect()
        };
        assert_eq!(values(false), [1.0, 2.0, 3.0]);
        assert_eq!(values(true), [3.0, 2.0, 1.0]);
    }
}
