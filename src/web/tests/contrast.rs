//! Tests that the colours of the pages have enough contrast for everybody.

const SHEETS: [&str; 2] = [
    include_str!("../../../assets/web/page.css"),
    include_str!("../../../assets/web/questions/questions.css"),
];

/// Minimum contrast between text and its background, by the guidelines for the accessibility of pages (level AA).
const LEAST: f64 = 4.5;

/// Colours that lie behind text, and colours that text never has.
const BEHIND: [&str; 2] = ["water", "sunk"];
const LINES: [&str; 1] = ["line"];

/// Returns the relative luminance of a colour of six hexadecimal digits.
fn luminance(hex: &str) -> f64 {
    let channel = |at: usize| {
        let value = f64::from(u8::from_str_radix(&hex[at..at + 2], 16).unwrap()) / 255.0;
        match value <= 0.04045 {
            true => value / 12.92,
            false => ((value + 0.055) / 1.055).powf(2.4),
        }
    };
    0.2126 * channel(0) + 0.7152 * channel(2) + 0.0722 * channel(4)
}

fn contrast(a: &str, b: &str) -> f64 {
    let [a, b] = [a, b].map(|colour| luminance(colour) + 0.05);
    a.max(b) / a.min(b)
}

/// Returns the named colours of each theme of a style sheet.
fn themes(sheet: &str) -> Vec<Vec<(&str, &str)>> {
    let roots = sheet.split(":root {").skip(1).map(|rest| rest.split('}').next().unwrap());
    let roots = roots.filter(|root| root.contains(": #"));
    roots
        .map(|root| {
            let pairs = root.split(';').filter_map(|pair| pair.trim().split_once(": #"));
            pairs.map(|(name, hex)| (name.trim_start_matches("--"), hex)).collect()
        })
        .collect()
}

#[test]
fn every_text_of_the_pages_has_a_legible_contrast() {
    assert!((contrast("000000", "ffffff") - 21.0).abs() < 1e-9);
    assert!((contrast("b35c00", "e9f0f4") - 4.10).abs() < 0.01);
    for sheet in SHEETS {
        let themes = themes(sheet);
        assert_eq!(themes.len(), 2);
        for theme in themes {
            let behind = theme.iter().filter(|(name, _)| BEHIND.contains(name));
            let texts =
                theme.iter().filter(|(name, _)| !BEHIND.contains(name) && !LINES.contains(name));
            assert!(texts.clone().count() >= 2 && behind.clone().count() >= 1, "{theme:?}");
            for (name, text) in texts {
                for (on, ground) in behind.clone() {
                    let found = contrast(text, ground);
                    assert!((LEAST..=21.0).contains(&found), "{name} on {on}: {found:.2} : 1");
                }
            }
        }
    }
}
