//! The names of the files that a driver saves. They say what is in them.

use super::Studio;
use crate::run::race::Mode;

impl Studio {
    /// Of the run as a scene file.
    pub fn recording_file_name(&self) -> String {
        format!("regatta-{}-recording.toml", self.scene().name)
    }

    /// Of a picture of the frame, without its ending.
    pub fn picture_file_name(&self) -> String {
        let scene = &self.scene().name;
        if let Some(loops) = self.loop_lab() {
            let (policy, ms) = (loops.selected_card().id, loops.now_ns() / 1_000_000);
            return format!("regatta-{scene}-loop-{policy}-at-{ms}-ms");
        }
        let method = match self.mode() {
            Mode::Solo => self.entries()[self.active()].method.id,
            Mode::Race => "race",
        };
        format!("regatta-{scene}-{method}-tick-{}", self.race().tick())
    }

    /// Of the instrument's picture and values, without its ending.
    pub fn instrument_file_name(&self) -> String {
        let (scene, instrument) = (&self.scene().name, self.display().instrument.id());
        match self.loop_lab() {
            Some(loops) => {
                let ms = loops.now_ns() / 1_000_000;
                format!("regatta-{scene}-loops-{instrument}-at-{ms}-ms")
            }
            None => format!("regatta-{scene}-{instrument}-tick-{}", self.race().tick()),
        }
    }
}
