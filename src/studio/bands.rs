//! The lanes of a race in bands, one below the other, each with its lines of code. A scene asks for them, as that of
//! the opening does. Digits show a lane and take it away.

use super::Studio;
use super::display::Arrangement;
use crate::run::MenuIndex;
use crate::run::race::Mode;

/// Number of bands at first.
const AT_FIRST: usize = 2;

impl Studio {
    /// Returns the menu indices of the lanes that have a band on the stage, from top to bottom. There are none unless
    /// the scene opens in bands, and the stage alone shows a race.
    pub fn bands(&self) -> Vec<MenuIndex> {
        let (scene, display) = (self.scene(), self.display());
        let are_shown = self.loops.is_none()
            && scene.opens_in_bands
            && scene.bodies.len() == 1
            && self.mode() == Mode::Race
            && display.arrangement == Arrangement::Overlay
            && !display.measure
            && !display.enlarged
            && self.viewer.tour.is_none();
        let has_lane = |entry: &MenuIndex| are_shown && self.deck.lane_of(*entry).is_some();
        match &self.viewer.view.bands {
            Some(chosen) => chosen.iter().copied().filter(has_lane).collect(),
            None => (0..self.deck.entries().len()).filter(has_lane).take(AT_FIRST).collect(),
        }
    }

    /// Whether a person has chosen the bands.
    pub fn has_chosen_bands(&self) -> bool {
        self.view().bands.is_some()
    }
}

/// Shows the band of a lane in the order of the digits, or takes it away. The last band stays. Returns the entry to
/// select, which has a band.
pub(super) fn toggle_band(studio: &mut Studio, entry: MenuIndex) -> MenuIndex {
    let mut shown = studio.bands();
    match shown.iter().position(|&band| band == entry) {
        Some(index) if shown.len() > 1 => _ = shown.remove(index),
        Some(_) => {}
        None if studio.deck.lane_of(entry).is_none() => return studio.active(),
        None => {
            shown.push(entry);
            shown.sort_unstable();
        }
    }
    let is_there = |entry: MenuIndex| shown.contains(&entry).then_some(entry);
    let selected = is_there(entry).or_else(|| is_there(studio.active())).unwrap_or(shown[0]);
    studio.viewer.view.bands = Some(shown);
    selected
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use crate::{StageCommand, Studio, ViewCommand};

    fn opening() -> Studio {
        let scene = Scene::built_in("two-springs").unwrap();
        Studio::opened(scene, None, crate::run::race::Mode::Race)
    }

    #[test]
    fn digits_show_bands_in_their_order_and_take_them_away_until_the_last() {
        let mut studio = opening();
        assert_eq!((studio.bands(), studio.has_chosen_bands()), (vec![0, 1], false));
        for (digit, bands, active) in [
            (4, vec![0, 1, 3], 3),
            (3, vec![0, 1, 2, 3], 2),
            (3, vec![0, 1, 3], 0),
            (1, vec![1, 3], 1),
            (2, vec![3], 3),
            (4, vec![3], 3),
            (9, vec![3], 3),
        ] {
            studio.apply(StageCommand::Pick(digit - 1));
            assert_eq!((studio.bands(), studio.active()), (bands, active), "{digit}");
        }
        studio.tick();
        studio.apply(StageCommand::Restart);
        assert_eq!((studio.bands(), studio.has_chosen_bands()), (vec![0, 1], false));
    }

    #[test]
    fn only_the_stage_of_a_race_alone_has_bands() {
        let mut studio = opening();
        for (command, has_bands) in [
            (ViewCommand::ToggleMeasure, false),
            (ViewCommand::ToggleMeasure, true),
            (ViewCommand::ToggleGuide, false),
            (ViewCommand::ToggleGuide, true),
        ] {
            studio.apply(command);
            assert_eq!(!studio.bands().is_empty(), has_bands, "{:?}", studio.display());
            let hint = studio.hint().unwrap_or_default();
            assert_eq!(hint.contains("`4`: more methods"), has_bands, "{hint}");
        }
        studio.apply(StageCommand::ToggleArrangement);
        assert!(studio.bands().is_empty());
        let race = Studio::opened(Scene::built_in("engines").unwrap(), None, studio.mode());
        assert!(race.bands().is_empty());
    }
}
