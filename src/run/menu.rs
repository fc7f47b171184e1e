//! The menu of methods from which a person picks.
//!
//! An entry never moves, because a person has learned its digit and its colour. In a race a lane keeps its entry when a
//! script switches its method: there a person follows the lane. Alone, the person follows the method, and the lane
//! takes the entry of that method.

use super::race::{Entrant, Mode, PerformedAction, Race, Switch};
use crate::scene::{Action, LaneId, LaneSpec};

/// Index of a method in a [`Menu`].
pub type MenuIndex = usize;

/// The methods to which digits, rows and colours refer by index. First come the scene's lanes, then all other methods
/// that fit the scene's bodies. Each entry has the substeps and tolerance that its lane uses, or used last. The menu
/// follows the switches of a run, without being part of the run. A lane of a race that a script has switched to another
/// method keeps its entry, and so its digit and its colour.
#[derive(Clone, Debug)]
pub struct Menu {
    specs: Vec<LaneSpec>,
    /// Menu index of each lane in the race.
    lane_entries: Vec<(LaneId, MenuIndex)>,
}

impl Menu {
    /// Creates the menu of a race at its start.
    pub fn new(race: &Race) -> Self {
        let mut menu = Self { specs: race.methods().to_vec(), lane_entries: Vec::new() };
        for entrant in race.entrants() {
            // Identical lanes get separate entries while any are free.
            let mut own = 0..menu.specs.len();
            let own = own.find(|&at| menu.specs[at] == entrant.spec && menu.lane(at).is_none());
            let entry = own.unwrap_or_else(|| match menu.specs.contains(&entrant.spec) {
                true => menu.added(entrant.spec),
                false => menu.entry_for(entrant.id, entrant.spec),
            });
            menu.lane_entries.push((entrant.id, entry));
        }
        menu
    }

    /// Returns the methods, in menu order.
    pub fn specs(&self) -> &[LaneSpec] {
        &self.specs
    }

    /// Returns the menu index of a lane in the race.
    ///
    /// # Panics
    /// If the lane is not in the race.
    pub fn entry(&self, lane: LaneId) -> MenuIndex {
        self.known_entry(lane).expect("it is in the race")
    }

    /// Returns the first lane under the method with this index; `None` if no lane uses the method.
    pub fn lane(&self, entry: MenuIndex) -> Option<LaneId> {
        self.lane_entries.iter().find(|(_, known)| *known == entry).map(|(lane, _)| *lane)
    }

    fn known_entry(&self, lane: LaneId) -> Option<MenuIndex> {
        self.lane_entries.iter().find(|(known, _)| *known == lane).map(|(_, entry)| *entry)
    }

    /// Returns the heap memory of the menu in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        size_of_val(&self.specs[..]) + size_of_val(&self.lane_entries[..])
    }

    /// Follows an action. A lane that is switched solo takes another entry. In a race each lane keeps its own, because
    /// two lanes may come under one method. Lanes that left the race release theirs.
    pub(super) fn follow(&mut self, race: &Race, done: &PerformedAction) {
        self.lane_entries.retain(|(lane, _)| race.entrant(*lane).is_some());
        match (race.mode(), done.switch, &done.action) {
            (Mode::Race, Some(Switch { lane, spec, .. }), _) => {
                let own = self.entry(lane);
                // Another version of a person's own lines takes the place of the earlier one.
                if self.specs[own].method.id == spec.method.id {
                    self.specs[own] = spec;
                }
            }
            (Mode::Solo, Some(_), _) | (_, None, Action::Solo { .. }) => {
                for Entrant { id, spec, .. } in race.entrants() {
                    let entry = self.entry_for(*id, *spec);
                    self.lane_entries = vec![(*id, entry)];
                }
            }
            _ => {}
        }
    }

    fn added(&mut self, spec: LaneSpec) -> MenuIndex {
        self.specs.push(spec);
        self.specs.len() - 1
    }

    /// Returns the index for a lane that switches to `spec`, so that the menu lists every lane's method. An entry equal
    /// to `spec` is preferred. Otherwise an entry of the same method that no other lane uses is changed, or an entry is
    /// added.
    fn entry_for(&mut self, lane: LaneId, spec: LaneSpec) -> MenuIndex {
        if let Some(known) = self.specs.iter().position(|known| *known == spec) {
            return known;
        }
        let is_free = |&entry: &MenuIndex| {
            let by_other =
                |known: &(LaneId, MenuIndex)| *known == (known.0, entry) && known.0 != lane;
            self.specs[entry].method.id == spec.method.id && !self.lane_entries.iter().any(by_other)
        };
        let free = self.known_entry(lane).into_iter().chain(0..self.specs.len()).find(is_free);
        let Some(entry) = free else { return self.added(spec) };
        self.specs[entry] = spec;
        entry
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Observations;
    use crate::scene::{Action, Scene};
    use crate::sim::integrators::method;

    #[test]
    fn lanes_of_a_race_keep_their_entries_even_if_several_come_under_one_method() {
        let specs = ["rk4", "explicit-euler"].map(|id| LaneSpec::plain(method(id).unwrap()));
        let scene = Scene { lanes: specs.to_vec(), ..Scene::built_in("spring").unwrap() };
        let mut race = Race::new(&scene, specs);
        let mut seen = Observations::new(&race, scene.seconds);
        let (a, b) = (LaneId(1), LaneId(2));
        let lane = |lane| Action::Lane { lane, spec: specs[0] };
        let substeps = |lane, substeps| Action::Substeps { lane, substeps };
        for action in [lane(b), substeps(b, 3), substeps(a, 3), substeps(a, 2), substeps(b, 4)] {
            race.perform(&action, &mut seen);
            assert_eq!([a, b].map(|lane| seen.menu().entry(lane)), [0, 1], "{action:?}");
            assert_eq!([0, 1].map(|entry| seen.menu().lane(entry)), [Some(a), Some(b)]);
            assert_eq!(seen.menu().specs()[0], race.entrants()[0].spec, "{action:?}");
        }
        assert_eq!(seen.menu().specs()[1], specs[1], "a method stays though no lane flies it");
        // Alone, the lane has the entry of its method.
        race.perform(&Action::Solo { lane: b }, &mut seen);
        assert_eq!(seen.menu().specs()[seen.menu().entry(b)], race.entrants()[0].spec);
        assert_eq!(seen.menu().specs()[1], specs[1]);
    }

    #[test]
    fn identical_lanes_have_separate_entries_from_the_start() {
        let rk4 = LaneSpec::plain(method("rk4").unwrap());
        let scene = Scene { lanes: vec![rk4; 2], ..Scene::built_in("spring").unwrap() };
        let menu = Menu::new(&Race::of_scene(&scene));
        assert_eq!([1, 2].map(|n| menu.entry(LaneId(n))), [0, 1]);
    }
}
