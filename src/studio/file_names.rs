//! Names of the files that a driver saves. A name describes the file's contents.

use super::Studio;
use crate::run::race::Mode;

/// Returns the name of the file for a picture of the frame, without an extension.
pub fn picture_file_name(studio: &Studio) -> String {
    let scene = &studio.scene().name;
    if let Some(loops) = studio.loop_lab() {
        let (policy, ms) = (&loops.selected_card().id, loops.now_ns() / 1_000_000);
        return format!("regatta-{scene}-loop-{policy}-at-{ms}-ms");
    }
    let method = match studio.mode() {
        Mode::Solo => studio.entries()[studio.active()].method.id,
        Mode::Race => "race",
    };
    format!("regatta-{scene}-{method}-tick-{}", studio.race().tick())
}

/// Returns the name of the files for the instrument's picture and values, without an extension.
pub fn instrument_file_name(studio: &Studio) -> String {
    let (scene, instrument) = (&studio.scene().name, studio.display().instrument.id());
    match studio.loop_lab() {
        Some(loops) => {
            let ms = loops.now_ns() / 1_000_000;
            format!("regatta-{scene}-loops-{instrument}-at-{ms}-ms")
        }
        None => format!("regatta-{scene}-{instrument}-tick-{}", studio.race().tick()),
    }
}
