//! Keys drawn as boxes, and sentences with keys between backticks, which are buttons.

use egui::{Align2, Color32, FontId, Painter, Rect, Response, Sense, Stroke, Ui, pos2, vec2};

use super::parts::short;
use crate::studio::{Command, commands_named};
use crate::theme::{TYPE, palette, strong_font};

/// Height of a key's box, minimum padding around its letter, and gap between a box and a word, in points.
pub(super) const HEIGHT: f32 = 22.0;
const PADDING: f32 = 7.0;
const GAP: f32 = 5.0;

/// A piece of a sentence: words or a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Piece<'a> {
    Words(&'a str),
    Key(&'a str),
}

/// Splits a sentence into its words and keys.
fn pieces(sentence: &str) -> impl Iterator<Item = Piece<'_>> {
    let parts = sentence.split('`').enumerate().filter(|(_, part)| !part.trim().is_empty());
    parts.map(|(i, part)| match i % 2 {
        0 => Piece::Words(part.trim()),
        _ => Piece::Key(part),
    })
}

/// Returns the amount by which the gap before these words shrinks. Words that begin with punctuation lie closer to the
/// key before them.
fn gap_reduction(words: &str) -> f32 {
    if words.starts_with(['.', ',', ':', ';']) { GAP - 1.0 } else { 0.0 }
}

/// Returns a sentence that can be read aloud, without the backticks around its keys.
pub(super) fn without_backticks(sentence: &str) -> String {
    sentence.replace('`', "")
}

/// Returns the width of a key's box, in points.
pub(super) fn width(painter: &Painter, key: &str) -> f32 {
    let text = painter.layout_no_wrap(key.to_owned(), strong_font(TYPE), Color32::WHITE);
    (text.size().x + 2.0 * PADDING).max(HEIGHT)
}

/// Draws a key's box with its left edge at `left`, and returns its width.
pub(super) fn paint(ui: &Ui, left: f32, middle: f32, key: &str, colour: Color32) -> f32 {
    let width = width(ui.painter(), key);
    let rect =
        Rect::from_min_size(pos2(left, middle - HEIGHT / 2.0), vec2(width, HEIGHT)).shrink(0.5);
    let stroke = Stroke::new(1.0, colour.gamma_multiply(0.8));
    ui.painter().rect(rect, 5.0, palette(ui).raised, stroke, egui::StrokeKind::Inside);
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, key, strong_font(TYPE), colour);
    width
}

/// Draws a key's box in a sentence, as a button if the key has a command, and returns its width.
fn button(
    ui: &Ui,
    [left, middle]: [f32; 2],
    (index, key): (usize, &str),
    commands: Option<&mut Vec<Command>>,
) -> f32 {
    let palette = palette(ui);
    let pressed = commands.and_then(|commands| Some((commands, commands_named(key).next()?)));
    let Some((commands, command)) = pressed else {
        return paint(ui, left, middle, key, palette.accent);
    };
    let size = vec2(width(ui.painter(), key), HEIGHT);
    let rect = Rect::from_min_size(pos2(left, middle - HEIGHT / 2.0), size);
    // Whoever uses the keyboard has the key itself, so that the focus passes by.
    let response = ui.interact(rect, ui.scope_id().with(("key", index)), Sense::CLICK);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, key));
    if response.clicked() {
        commands.push(command.clone());
    }
    let colour = if response.hovered() { palette.text } else { palette.accent };
    paint(ui, left, middle, key, colour)
}

/// Returns the width of a sentence in one line, in points.
pub(super) fn line_width(ui: &Ui, sentence: &str) -> f32 {
    let of = |piece| match piece {
        Piece::Key(key) => width(ui.painter(), key) + GAP,
        Piece::Words(words) => {
            let font = FontId::proportional(TYPE);
            let size = ui.painter().layout_no_wrap(words.to_owned(), font, Color32::WHITE).size();
            size.x + GAP - gap_reduction(words)
        }
    };
    pieces(sentence).map(of).sum()
}

/// Shows a sentence in one line of this width. If the sentence is too long, an ellipsis replaces its end, and the
/// tooltip has all of it. Without `commands` its keys are no buttons.
pub(super) fn line(
    ui: &mut Ui,
    sentence: &str,
    room: f32,
    colour: Color32,
    mut commands: Option<&mut Vec<Command>>,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(room.max(0.0), HEIGHT), Sense::hover());
    let spoken = without_backticks(sentence);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &spoken));
    let (mut x, middle) = (rect.left(), rect.center().y);
    let mut is_whole = true;
    for (index, piece) in pieces(sentence).enumerate() {
        let left = rect.right() - x;
        match piece {
            Piece::Key(key) if width(ui.painter(), key) <= left => {
                x += button(ui, [x, middle], (index, key), commands.as_deref_mut()) + GAP;
            }
            Piece::Key(_) => is_whole = false,
            Piece::Words(words) => {
                x -= gap_reduction(words);
                let (text, whole) = short(ui, words, FontId::proportional(TYPE), left, colour);
                is_whole &= whole;
                let size = text.size();
                ui.painter().galley(pos2(x, middle - size.y / 2.0), text, colour);
                x += size.x + GAP;
            }
        }
        if !is_whole {
            break;
        }
    }
    if is_whole { response } else { response.on_hover_text(spoken) }
}

/// Shows a sentence in as many lines as necessary.
pub(super) fn paragraph(ui: &mut Ui, sentence: &str, colour: Color32, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 2.0);
        for (index, piece) in pieces(sentence).enumerate() {
            match piece {
                Piece::Key(key) => {
                    let size = vec2(width(ui.painter(), key), HEIGHT - 2.0);
                    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
                    if commands_named(key).next().is_none() {
                        response.widget_info(|| {
                            egui::WidgetInfo::labeled(egui::Role::Label, true, key)
                        });
                    }
                    let at = [rect.left(), rect.center().y];
                    button(ui, at, (index, key), Some(commands));
                }
                Piece::Words(words) => {
                    ui.add_space(-gap_reduction(words));
                    ui.label(egui::RichText::new(words).color(colour));
                }
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::testing::TestWindow;

    #[test]
    fn a_screen_reader_hears_the_keys_of_a_paragraph() {
        let mut window = TestWindow::new([400.0, 300.0]);
        window.context.enable_accesskit();
        let paragraph = |ui: &mut Ui| {
            paragraph(ui, "Press `2` to switch.", Color32::WHITE, &mut Vec::new());
        };
        let (_, shown) = window.show(Vec::new(), paragraph);
        for words in ["Press", "2", "to switch."] {
            assert!(shown.heard.iter().any(|heard| heard == words), "{:?}", shown.heard);
        }
    }

    #[test]
    fn keys_are_written_between_backticks() {
        let found: Vec<Piece<'_>> = pieces("Press `2` to switch, then `Home`.").collect();
        let expected = [
            Piece::Words("Press"),
            Piece::Key("2"),
            Piece::Words("to switch, then"),
            Piece::Key("Home"),
            Piece::Words("."),
        ];
        assert_eq!(found, expected);
        assert_eq!(without_backticks("Press `2`."), "Press 2.");
    }
}
