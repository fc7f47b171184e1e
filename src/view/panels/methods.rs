//! The methods that digits select, each with its digit, its name, and the sign of its verdict.

use egui::{FontId, Rect, Response, Sense, Stroke, StrokeKind, Ui, Vec2, pos2, vec2};

use super::verdict::VerdictText;
use super::{breakpoints, keycap, lanes};
use crate::run::MenuIndex;
use crate::studio::{Command, DIGITS, StageCommand, Studio, mark_of};
use crate::theme::{TYPE, palette, strong_font};

/// Height of the first row, and of each further row, in points.
pub(super) const HEIGHT: f32 = 40.0;
const FURTHER: f32 = BUTTON + CLOSE;
/// Maximum share of the window's height for rows in a narrow window.
const ROWS: f32 = 1.0 / 6.0;

/// Height of a method, gap between two methods, gap if room is scarce, and padding of a method's parts, in points.
const BUTTON: f32 = 30.0;
const BETWEEN: f32 = 10.0;
const CLOSE: f32 = 4.0;
const PADDING: f32 = 7.0;
/// Font size of names in two lines, in points.
const SMALL: f32 = 10.5;
/// Width for the sign of the verdict, in points.
const SIGN: f32 = 12.0;

/// How the methods show their names beside their digits.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Naming {
    OneLine,
    TwoLines,
    /// Only the selected method shows its name.
    Chosen,
    None,
}

impl Naming {
    /// All styles from best to worst. The first style in which every method fits is used.
    const ALL: [Self; 4] = [Self::OneLine, Self::TwoLines, Self::Chosen, Self::None];

    /// Returns the name that a method shows beside its digit, and its font, or `None` if it shows no name.
    fn name(self, ui: &Ui, studio: &Studio, entry: MenuIndex) -> Option<(String, FontId)> {
        let is_chosen = entry == studio.active();
        let name = studio.lane_name(entry);
        let font =
            |size: f32| if is_chosen { strong_font(size) } else { FontId::proportional(size) };
        match self {
            Self::OneLine => Some((name, font(TYPE))),
            Self::TwoLines => Some((in_two_lines(ui, &name), font(SMALL))),
            Self::Chosen => is_chosen.then(|| (name, font(TYPE))),
            Self::None => None,
        }
    }
}

/// Breaks a name into two lines, at the blank or the hyphen that makes it narrowest.
fn in_two_lines(ui: &Ui, name: &str) -> String {
    let breaks = name.match_indices([' ', '-']).map(|(at, sign)| {
        let end = if sign == "-" { at + 1 } else { at };
        format!("{}\n{}", &name[..end], &name[at + 1..])
    });
    let wide = |lines: &String| {
        let width = |line: &str| text_width(ui, line, strong_font(SMALL));
        lines.lines().map(width).fold(0.0, f32::max)
    };
    breaks.min_by(|a, b| wide(a).total_cmp(&wide(b))).unwrap_or_else(|| name.to_owned())
}

fn text_width(ui: &Ui, text: &str, font: FontId) -> f32 {
    ui.painter().layout_no_wrap(text.to_owned(), font, palette(ui).text).size().x
}

/// Returns the height of the methods in a panel of width `room`, in a window of this size.
pub(super) fn height(ui: &Ui, studio: &Studio, room: f32, window: Vec2) -> f32 {
    let rows = rows(ui, studio, room);
    let height = HEIGHT + FURTHER * rows.len().saturating_sub(1) as f32;
    let is_narrow = window.x < breakpoints::METHODS_IN_ONE_ROW;
    if is_narrow && height <= ROWS * window.y { height } else { HEIGHT }
}

/// Splits the methods into rows of this width. Each method has its name.
fn rows(ui: &Ui, studio: &Studio, room: f32) -> Vec<Vec<usize>> {
    let (mut rows, mut left) = (Vec::<Vec<usize>>::new(), 0.0);
    for entry in listed(studio) {
        let wide = width(ui, studio, entry, Naming::OneLine);
        match rows.last_mut().filter(|_| wide <= left) {
            Some(row) => row.push(entry),
            None => {
                rows.push(vec![entry]);
                left = room;
            }
        }
        left -= wide + BETWEEN;
    }
    rows
}

/// Shows the scene's methods, or else those with a digit. All have their names if there is room, if necessary in
/// several rows or in two lines each. Returns the index of the method that has the pointer or the keyboard focus.
pub(super) fn show(ui: &mut Ui, studio: &Studio, commands: &mut Vec<Command>) -> Option<usize> {
    let listed = listed(studio);
    let room = ui.available_width();
    let mut pointed = None;
    let mut show = |ui: &mut Ui, entry: MenuIndex, naming: Naming| {
        let response = method(ui, studio, entry, naming, commands);
        response.context_menu(|ui| lanes::menu(ui, studio, entry, commands));
        if response.hovered() || response.has_focus() {
            pointed = Some(entry);
        }
    };
    let rows = rows(ui, studio, room);
    if rows.len() > 1 && ui.available_height() > HEIGHT {
        ui.spacing_mut().item_spacing = vec2(BETWEEN, CLOSE);
        for row in rows {
            ui.horizontal(|ui| row.into_iter().for_each(|entry| show(ui, entry, Naming::OneLine)));
        }
        return pointed;
    }
    let all = |naming: &Naming| {
        let widths = listed.iter().map(|&entry| width(ui, studio, entry, *naming) + BETWEEN);
        widths.sum::<f32>() - BETWEEN
    };
    let naming = Naming::ALL.into_iter().find(|naming| all(naming) <= room);
    let between = if naming.is_some() { BETWEEN } else { CLOSE };
    let naming = naming.unwrap_or(Naming::None);
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = between;
        for &entry in &listed {
            if width(ui, studio, entry, naming) > ui.available_width() {
                break;
            }
            show(ui, entry, naming);
        }
    });
    pointed
}

/// Returns the methods with a digit, and the active one if it has none.
fn listed(studio: &Studio) -> Vec<MenuIndex> {
    let further = Some(studio.active()).filter(|active| *active >= DIGITS);
    (0..studio.deck.offered().min(DIGITS)).chain(further).collect()
}

fn width(ui: &Ui, studio: &Studio, entry: MenuIndex, naming: Naming) -> f32 {
    // The name is measured in strong type, so that a selection moves no other method.
    let name = naming.name(ui, studio, entry);
    let named = name.map(|(name, font)| text_width(ui, &name, strong_font(font.size)) + PADDING);
    let digit = keycap::width(ui.painter(), &mark_of(entry));
    3.0 * PADDING + digit + named.unwrap_or_default() + SIGN
}

/// Shows a method. A click on the method has the same effect as its digit.
fn method(
    ui: &mut Ui,
    studio: &Studio,
    entry: MenuIndex,
    naming: Naming,
    commands: &mut Vec<Command>,
) -> Response {
    let size = vec2(width(ui, studio, entry, naming), BUTTON);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let (name, is_chosen) = (studio.lane_name(entry), entry == studio.active());
    let verdict = lanes::verdict_on(studio, entry);
    let spoken = format!("{} {name}, {}", mark_of(entry), verdict.whole());
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::RadioButton, true, is_chosen, &spoken)
    });
    let (colour, _) = palette(ui).style(studio.entries(), &studio.entries()[entry]);
    let shown = naming.name(ui, studio, entry);
    paint(ui, rect, (&mark_of(entry), colour), shown, is_chosen, &verdict);
    if response.hovered() || response.has_focus() {
        let stroke = Stroke::new(1.0, palette(ui).accent);
        ui.painter().rect_stroke(rect, 7.0, stroke, StrokeKind::Inside);
    }
    let response = response.on_hover_ui(|ui| lanes::tooltip(ui, studio, entry));
    if response.clicked() {
        commands.push(Command::Stage(StageCommand::Pick(entry)));
    }
    response
}

fn paint(
    ui: &Ui,
    rect: Rect,
    (digit, colour): (&str, egui::Color32),
    name: Option<(String, FontId)>,
    is_chosen: bool,
    verdict: &VerdictText,
) {
    let stroke =
        if is_chosen { Stroke::new(1.6, colour) } else { Stroke::new(1.0, palette(ui).line) };
    let fill = if is_chosen { palette(ui).raised } else { palette(ui).panel };
    ui.painter().rect(rect, 7.0, fill, stroke, StrokeKind::Inside);
    let (mut x, middle) = (rect.left() + PADDING, rect.center().y);
    x += keycap::paint(ui, x, middle, digit, colour) + PADDING;
    if let Some((name, font)) = name {
        let colour = if is_chosen { palette(ui).text } else { palette(ui).dim };
        let text = ui.painter().layout_no_wrap(name, font, colour);
        ui.painter().galley(pos2(x, middle - text.size().y / 2.0), text, colour);
    }
    verdict.paint_sign(ui, pos2(rect.right() - PADDING - SIGN / 2.0, middle));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::panels;
    use crate::scene::Scene;
    use crate::studio::StageCommand;
    use crate::tests::testing::TestWindow;

    /// Returns the words of the row in a window of this width. The two lines of a name are joined with a blank.
    fn words(studio: &Studio, width: f32) -> Vec<String> {
        let mut window = TestWindow::new([width, 100.0]);
        let ((), shown) = window.show(Vec::new(), |ui| {
            ui.set_max_size(vec2(width, HEIGHT));
            show(ui, studio, &mut Vec::new());
        });
        let joined = |word: &str| word.replace("-\n", "-").replace('\n', " ");
        shown.words().iter().map(|word| joined(word)).collect()
    }

    #[test]
    fn an_active_method_without_a_digit_is_listed_too() {
        let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
        let active = (0..studio.entries().len()).find(|&entry| {
            studio.apply(StageCommand::Pick(entry));
            studio.active() >= DIGITS
        });
        let name = studio.lane_name(active.expect("the menu is longer"));
        assert!(words(&studio, 1900.0).contains(&name));
        assert!(words(&studio, 800.0).contains(&"•".to_owned()));
    }

    #[test]
    fn ten_default_methods_show_their_names_in_a_usual_window() {
        let text = "title = 'mine'\ntick_hz = 60\nseconds = 9\n\
             [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 9\nx0_m = 1\n";
        let studio = Studio::new(Scene::parse("mine.toml", text).unwrap());
        assert!(studio.deck.offered() >= DIGITS);
        let shown = words(&studio, 1264.0);
        for entry in 0..DIGITS {
            let name = studio.lane_name(entry);
            assert!(shown.contains(&name), "{name}: {shown:?}");
        }
        let narrow = words(&studio, 800.0);
        assert!(narrow.contains(&studio.lane_name(studio.active())), "{narrow:?}");
        assert!((0..DIGITS).all(|entry| narrow.contains(&mark_of(entry))), "{narrow:?}");
    }

    #[test]
    fn a_tall_window_names_every_method_and_a_low_one_only_the_chosen() {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.viewer.preferences.display.measure = false;
        let names: Vec<String> = (0..5).map(|entry| studio.lane_name(entry)).collect();
        for (size, count) in [([390.0, 844.0], 5), ([375.0, 667.0], 5), ([480.0, 242.0], 1)] {
            let mut window = TestWindow::new(size);
            let mut frame = || window.show(Vec::new(), |ui| panels::show(ui, &studio)).1;
            drop(frame());
            let texts = frame().texts;
            let shown = names.iter().filter(|name| {
                let is_it = |text: &&crate::tests::testing::ShownText| {
                    text.shape.galley.text() == **name && text.shape.pos.y > size[1] - 200.0
                };
                texts.iter().filter(is_it).all(|text| text.clip.contains(text.shape.pos))
                    && texts.iter().any(|text| is_it(&text))
            });
            assert_eq!(shown.count(), count, "{size:?}");
        }
    }
}
