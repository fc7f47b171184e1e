//! Notices about bodies that halt and bodies that resume.

use super::action::Action;
use super::lane::{Halt, Resumed, ResumedFrom};
use super::race::{Observer, Race};
use super::scene::Scene;

/// Collects notices from a race.
pub(super) struct Notices<'s> {
    scene: &'s Scene,
    /// The latest notice.
    pub(super) told: Option<String>,
}

impl<'s> Notices<'s> {
    pub(super) fn new(scene: &'s Scene) -> Self {
        Self { scene, told: None }
    }

    fn tell(&mut self, told: Option<String>) {
        if told.is_some() {
            self.told = told;
        }
    }
}

impl Observer for Notices<'_> {
    fn after(&mut self, _race: &Race, _action: &Action, resumed: &[Resumed]) {
        self.tell(of_taken_up(self.scene, resumed));
    }

    fn ticked(&mut self, race: &Race) {
        self.tell(of_halts(self.scene, race));
    }
}

/// A notice about the bodies that halted in the last tick, if any did. Allocates nothing if none did.
fn of_halts(scene: &Scene, race: &Race) -> Option<String> {
    race.just_halted().next()?;
    let told = race.just_halted().map(|(place, Halt { tick, body, failure })| {
        let body = &scene.bodies[*body];
        match place {
            Some(place) => {
                let method = race.list()[race.entrants()[place].entry].method.name;
                format!("{method} halted at tick {tick}: {} {failure}", body.name)
            }
            None => {
                let (truth, name) = (body.kind.truth.id(), &body.name);
                format!(
                    "the {truth} solution halted at tick {tick}: {name} {failure}; nothing is compared with it any more"
                )
            }
        }
    });
    Some(told.collect::<Vec<_>>().join("; "))
}

/// A notice about the halted bodies that a switch has resumed, if there are any.
fn of_taken_up(scene: &Scene, resumed: &[Resumed]) -> Option<String> {
    let told = resumed.iter().map(|Resumed { halt, from }| {
        let body = &scene.bodies[halt.body];
        let fate = if halt.is_blow_up() { "had blown up" } else { "had halted" };
        let origin = match from {
            ResumedFrom::Truth => format!("the {} solution", body.kind.truth.id()),
            ResumedFrom::LastGood => "its last good state".into(),
        };
        format!("{} {fate}: resumed from {origin}", body.name)
    });
    (!resumed.is_empty()).then(|| told.collect::<Vec<_>>().join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::integrators::StepFailure;

    #[test]
    fn what_goes_on_is_told_with_what_became_of_it_and_where_it_begins() {
        let scene = Scene::built_in("helm").unwrap();
        let failures = [
            StepFailure::NewtonFailed { limit: 9 },
            StepFailure::NotFinite { coordinate: "x", value: f64::NAN },
        ];
        let [gave_up, blew_up] = failures.map(|failure| Halt { tick: 3, body: 0, failure });
        let told = |halt: &Halt, from| of_taken_up(&scene, &[Resumed { halt: halt.clone(), from }]);
        assert_eq!(
            told(&gave_up, ResumedFrom::Truth).unwrap(),
            "helm had halted: resumed from the reference solution"
        );
        assert_eq!(
            told(&blew_up, ResumedFrom::LastGood).unwrap(),
            "helm had blown up: resumed from its last good state"
        );
        assert_eq!(of_taken_up(&scene, &[]), None);
    }
}
