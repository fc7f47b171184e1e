//! The gestures of the mouse, for the help overlay.

/// A gesture of the mouse, and its effect.
#[derive(Debug)]
pub struct Gesture {
    /// The gesture, as the help names it.
    pub shown: &'static str,
    /// Description of the gesture's effect, for people.
    pub about: &'static str,
}

/// Every gesture.
pub static GESTURES: &[Gesture] = &[
    Gesture {
        shown: "Drag a body",
        about: "move it and throw it at the speed of the drag; with Shift, put it down at rest",
    },
    Gesture { shown: "Ctrl drag a body", about: "pull it by a spring while time runs" },
    Gesture { shown: "Wheel, pinch", about: "zoom the stage, a plot, the timeline" },
    Gesture { shown: "Drag the water", about: "pan, after a zoom; in a plot too" },
    Gesture { shown: "Double click", about: "fit the view; on a number in Edit: type a value" },
    Gesture {
        shown: "Click a lane",
        about: "select it, in the table, on the stage or on its curve; solo: switch to its method",
    },
    Gesture {
        shown: "Right click a lane",
        about: "its menu: \"Copy as Rust\", \"Copy as C#\", C, GDScript, JavaScript, Lua: the method's code; of an engine a spring's settings too",
    },
    Gesture { shown: "Click a heading", about: "sort the table by it" },
    Gesture {
        shown: "Drag the tick rate",
        about: "time waits, and the next second unfolds under each method",
    },
    Gesture {
        shown: "Drag the cross",
        about: "stability map: set the tick rate and the parameter",
    },
    Gesture {
        shown: "Drag a boundary",
        about: "more room for stage, instruments or table; double click: default",
    },
    Gesture { shown: "Drag the timeline", about: "go to any tick of the run" },
    Gesture { shown: "Drop a file", about: "open a scene, or in the loop lab a frame log" },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tools::source_code::Language;

    #[test]
    fn the_help_on_a_lanes_menu_names_every_language() {
        let menu = GESTURES.iter().find(|gesture| gesture.about.contains("Copy as")).unwrap();
        let words: Vec<&str> = menu.about.split([' ', ',', '"', ':']).collect();
        for language in Language::ALL {
            assert!(words.contains(&language.name()), "{language}");
        }
    }
}
