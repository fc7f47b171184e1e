//! What the window remembers from one run to the next: the scene, the theme, the size of type and that of the window.
//!
//! They are in `window.toml` in the folder that the system has for a program's settings, under `XDG_CONFIG_HOME` on
//! Linux. A file that cannot be understood is ignored, with a line on standard error.

use std::path::{Path, PathBuf};

use directories::ProjectDirs;
use toml::de::{DeTable, DeValue};

use super::terminal::print_status;
use crate::atomic_file::{IfExists, write_file};
use crate::lab::palette::Theme;
use crate::lab::scene::MAX_FILE_BYTES;
use crate::lab::studio::{SCALE_LADDER, Splits, Studio};
use crate::regular_file;

/// The name of the file.
const FILE_NAME: &str = "window.toml";

/// What is remembered.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct SavedPreferences {
    /// The scene that was open last: a built-in one's name, or a file's path.
    pub(super) scene: Option<PathBuf>,
    /// The theme that a person has chosen.
    pub(super) theme: Option<Theme>,
    /// The size of type and panels in percent of the usual one.
    pub(super) scale_percent: Option<u32>,
    /// The size of the window in points.
    pub(super) size: Option<[u32; 2]>,
    /// Whether instruments stood round the stage; on a first start it is alone.
    pub(super) measure: bool,
    /// Where a person has put the boundaries between stage, instruments and table.
    pub(super) splits: Splits,
}

impl SavedPreferences {
    /// What the file says; nothing where there is none.
    pub(super) fn load() -> Self {
        let Some(path) = path() else { return Self::default() };
        Self::read(&path).unwrap_or_else(|why| {
            print_status(&format!("{} is ignored: {why}", path.display()));
            Self::default()
        })
    }

    fn read(path: &Path) -> Result<Self, String> {
        let bytes = match regular_file::read(path, MAX_FILE_BYTES) {
            Err(missing) if missing.is_missing() => return Ok(Self::default()),
            read => read.map_err(|why| why.to_string())?,
        };
        Self::parse(str::from_utf8(&bytes).map_err(|_| "it is not text")?)
    }

    /// Writes the file. Where that is not possible, nothing is remembered.
    pub(super) fn save(&self) {
        let Some(path) = path() else { return };
        let write = |path: &Path| {
            let folder = path.parent().unwrap_or(path);
            std::fs::create_dir_all(folder)?;
            // Whole or not at all, as another window may close at the same time.
            write_file(path, self.to_text().as_bytes(), IfExists::Replace)
        };
        if let Err(error) = write(&path) {
            log::info!("cannot write {}: {error}", path.display());
        }
    }

    fn parse(text: &str) -> Result<Self, String> {
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
                    if splits.within() != *splits {
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
                // Of a newer program.
                _ => {}
            }
        }
        Ok(preferences)
    }

    fn to_text(&self) -> String {
        let scene = self.scene.as_deref().and_then(Path::to_str);
        // A path with a quotation mark or a line break is not worth the trouble.
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

/// The open scene of a studio, as it is remembered: a name, or an absolute path.
pub(super) fn scene_of(studio: &Studio) -> Option<PathBuf> {
    match studio.scene_list().open_path() {
        Some(path) => path.canonicalize().ok(),
        None => Some(studio.scene_name().into()),
    }
}

/// The folder of the program's settings.
pub(super) fn folder() -> Option<PathBuf> {
    Some(ProjectDirs::from("", "", "regatta")?.config_dir().to_owned())
}

fn path() -> Option<PathBuf> {
    Some(folder()?.join(FILE_NAME))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_remembered_is_read_as_it_was_written() {
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
    fn a_file_that_is_not_there_is_nothing_to_remember_and_one_that_is_no_text_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(FILE_NAME);
        assert_eq!(SavedPreferences::read(&path), Ok(SavedPreferences::default()));
        std::fs::write(&path, [0xff, 0xfe, 0x00]).unwrap();
        assert_eq!(SavedPreferences::read(&path), Err("it is not text".into()));
        assert!(SavedPreferences::read(folder.path()).is_err());
    }

    #[test]
    fn a_broken_file_is_refused_and_a_newer_one_is_read() {
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
