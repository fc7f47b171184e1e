//! A person's preferences, which are kept from one run of the program to the next. The driver stores their text.

use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};

use super::{Display, SCALE_LADDER, Splits, Studio};
use crate::look::palette::Theme;

/// The saved preferences.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SavedPreferences {
    /// The scene that was last open: the name of a built-in one, or the path of a file.
    pub scene: Option<PathBuf>,
    /// The chosen theme.
    pub theme: Option<Theme>,
    /// Size of type and panels, in percent of the usual size.
    pub scale_percent: Option<u32>,
    /// Size of the window in points.
    pub size: Option<[u32; 2]>,
    /// Whether the instruments surround the stage. On the first start they do not.
    pub measure: bool,
    /// Chosen boundaries between stage, instruments and table.
    pub splits: Splits,
}

impl SavedPreferences {
    /// Returns the preferences of a studio. The driver adds the scene and the size of the window.
    pub fn of(studio: &Studio) -> Self {
        let &Display { scale_percent, measure, splits, .. } = studio.display();
        let theme = studio.viewer.preferences.chosen_theme();
        let scale_percent = Some(scale_percent);
        Self { scene: None, theme, scale_percent, size: None, measure, splits }
    }

    /// Applies the preferences to a studio.
    pub fn apply(&self, studio: &mut Studio) {
        let preferences = &mut studio.viewer.preferences;
        if let Some(theme) = self.theme {
            preferences.choose_theme(theme);
        }
        if let Some(percent) = self.scale_percent {
            preferences.choose_scale(percent);
        }
        preferences.display.measure = self.measure;
        preferences.display.splits = self.splits;
    }

    /// Parses text from [`to_text`](Self::to_text), which may come from this or a newer release.
    ///
    /// # Errors
    /// If the text is not TOML, or if a known key has an invalid value.
    pub fn parse(text: &str) -> Result<Self, String> {
        let table = DeTable::parse(text).map_err(|error| error.message().to_owned())?;
        let mut preferences = Self::default();
        for (key, value) in table.get_ref() {
            let key: &str = key.get_ref();
            let wrong = || format!("its {key} cannot be understood");
            match (key, value.get_ref()) {
                ("scene", DeValue::String(scene)) => {
                    preferences.scene = Some(PathBuf::from(&**scene));
                }
                ("theme", DeValue::String(theme)) => {
                    preferences.theme = Some(match &**theme {
                        "dark" => Theme::Dark,
                        "light" => Theme::Light,
                        _ => return Err(wrong()),
                    });
                }
                ("scale_percent", DeValue::Integer(percent)) => {
                    let percent: u32 = percent.as_str().parse().map_err(|_| wrong())?;
                    let [least, .., most] = SCALE_LADDER;
                    if !(least..=most).contains(&percent) {
                        return Err(wrong());
                    }
                    preferences.scale_percent = Some(percent);
                }
                ("width" | "height", DeValue::Integer(points)) => {
                    let points: u32 = points.as_str().parse().map_err(|_| wrong())?;
                    if !(100..=20_000).contains(&points) {
                        return Err(wrong());
                    }
                    let size = preferences.size.get_or_insert([1280, 720]);
                    size[usize::from(key == "height")] = points;
                }
                ("measure", DeValue::Boolean(measure)) => preferences.measure = *measure,
                ("instruments_percent" | "table_percent", DeValue::Integer(percent)) => {
                    let percent: u32 = percent.as_str().parse().map_err(|_| wrong())?;
                    let splits = &mut preferences.splits;
                    let is_table = key == "table_percent";
                    *(if is_table { &mut splits.table } else { &mut splits.instruments }) =
                        Some(percent);
                    if splits.clamped() != *splits {
                        return Err(wrong());
                    }
                }
                (
                    "scene"
                    | "theme"
                    | "scale_percent"
                    | "width"
                    | "height"
                    | "measure"
                    | "instruments_percent"
                    | "table_percent",
                    _,
                ) => return Err(wrong()),
                // The key may come from a newer release.
                _ => {}
            }
        }
        Ok(preferences)
    }

    /// Returns the preferences as lines of TOML.
    pub fn to_text(&self) -> String {
        let scene = self.scene.as_deref().and_then(Path::to_str);
        // A path that contains a quotation mark or a line break is not worth the trouble.
        let scene = scene.filter(|scene| !scene.contains(['\'', '\n', '\r']));
        let theme = self.theme.map(|theme| if theme == Theme::Dark { "dark" } else { "light" });
        [
            scene.map(|scene| format!("scene = '{scene}'\n")),
            theme.map(|theme| format!("theme = '{theme}'\n")),
            self.scale_percent.map(|percent| format!("scale_percent = {percent}\n")),
            self.size.map(|[width, height]| format!("width = {width}\nheight = {height}\n")),
            Some(format!("measure = {}\n", self.measure)),
            self.splits.instruments.map(|percent| format!("instruments_percent = {percent}\n")),
            self.splits.table.map(|percent| format!("table_percent = {percent}\n")),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn preferences_survive_writing_and_reading() {
        for preferences in [
            SavedPreferences::default(),
            SavedPreferences { size: Some([800, 600]), ..SavedPreferences::default() },
            SavedPreferences {
                scene: Some("C:\\a \"b\"\\c.toml".into()),
                theme: Some(Theme::Light),
                scale_percent: Some(125),
                size: Some([1920, 1080]),
                measure: true,
                splits: Splits { instruments: Some(55), table: Some(20) },
            },
        ] {
            assert_eq!(SavedPreferences::parse(&preferences.to_text()), Ok(preferences));
        }
    }

    #[test]
    fn a_broken_file_is_refused_but_a_newer_format_is_read() {
        for (text, why) in [
            ("theme = 'blue'", "its theme cannot be understood"),
            ("scene = 5", "its scene cannot be understood"),
            ("width = 99999999999", "its width cannot be understood"),
            ("scale_percent = 0", "its scale_percent cannot be understood"),
            ("scale_percent = 1.5", "its scale_percent cannot be understood"),
            ("height = 0", "its height cannot be understood"),
            ("table_percent = 61", "its table_percent cannot be understood"),
            ("instruments_percent = 19", "its instruments_percent cannot be understood"),
        ] {
            assert_eq!(SavedPreferences::parse(text), Err(why.into()), "{text}");
        }
        assert!(SavedPreferences::parse("scene = ").is_err());
        let known = SavedPreferences { theme: Some(Theme::Dark), ..SavedPreferences::default() };
        assert_eq!(SavedPreferences::parse("theme = 'dark'\nvolume = 2"), Ok(known));
    }
}
