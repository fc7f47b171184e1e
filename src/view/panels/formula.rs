//! A formula as it is printed: quantities in a serif italic, figures and words upright.

use egui::text::LayoutJob;
use egui::{Color32, TextFormat};

use crate::view::theme::{formula_font, quantity_font};

/// A line of a formula in type of this size.
pub(super) fn job(line: &str, size: f32, colour: Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    let letters: Vec<char> = line.chars().collect();
    for run in letters.chunk_by(|a, b| is_letter(*a) == is_letter(*b)) {
        let is_quantity = run.len() == 1 && is_letter(run[0]);
        let font_id = if is_quantity { quantity_font(size) } else { formula_font(size) };
        let text: String = run.iter().collect();
        job.append(&text, 0.0, TextFormat { font_id, color: colour, ..TextFormat::default() });
    }
    job
}

/// Whether it stands for a quantity where it stands alone; indices and the sign of a sum do not.
fn is_letter(sign: char) -> bool {
    sign.is_alphabetic() && !matches!(sign, 'ᵢ' | 'ⱼ' | 'Σ')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prelude::METHODS;

    fn quantities(line: &str) -> Vec<String> {
        let job = job(line, 13.0, Color32::WHITE);
        assert_eq!(job.text, line);
        let italic =
            |section: &&egui::text::LayoutSection| section.format.font_id == quantity_font(13.0);
        let text = |section: &egui::text::LayoutSection| {
            let [start, end] = [section.byte_range.start, section.byte_range.end].map(usize::from);
            job.text[start..end].to_owned()
        };
        job.sections.iter().filter(italic).map(text).collect()
    }

    #[test]
    fn quantities_are_italic_and_words_and_figures_are_not() {
        assert_eq!(quantities("y′ = y + ½h Σ aᵢⱼ kⱼ if small"), ["y", "y", "h", "a", "k"]);
        for line in METHODS.iter().flat_map(|method| method.formula) {
            assert!(quantities(line).iter().all(|text| text.chars().count() == 1), "{line}");
        }
    }
}
