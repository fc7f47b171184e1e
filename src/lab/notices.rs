//! What a person is told of bodies that halt and go on.

use super::action::Action;
use super::lane::{Halt, LaneBody, Origin, TakenUp};
use super::race::{Observer, Race};
use super::scene::Scene;

/// Listens for what a person is to be told.
pub(super) struct Notices<'s> {
    scene: &'s Scene,
    /// The latest of it.
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
    fn after(&mut self, _race: &Race, _action: &Action, taken_up: &[TakenUp]) {
        self.tell(of_taken_up(self.scene, taken_up));
    }

    fn ticked(&mut self, race: &Race) {
        self.tell(of_halts(self.scene, race));
    }
}

/// What there is to tell of the bodies that halted in the tick before, if any did. Allocates nothing if none did.
fn of_halts(scene: &Scene, race: &Race) -> Option<String> {
    just_halted(race).next()?;
    let told = just_halted(race).map(|(entry, Halt { tick, body, failure })| {
        let body = &scene.bodies[*body];
        match entry {
            Some(entry) => {
                let method = race.list()[entry].method.name;
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

/// The bodies that halted in the tick before, each with its lane's place on the list; `None` for the truth.
fn just_halted(race: &Race) -> impl Iterator<Item = (Option<usize>, &Halt)> {
    let truth = race.truth().bodies().iter().map(|body| (None, body));
    let lanes = race
        .entrants()
        .iter()
        .flat_map(|entrant| entrant.lane.bodies().iter().map(|body| (Some(entrant.entry), body)));
    let tick = race.tick();
    truth.chain(lanes).filter_map(move |(entry, body): (_, &LaneBody)| {
        let halt = body.halted().filter(|halt| halt.tick + 1 == tick)?;
        Some((entry, halt))
    })
}

/// What there is to tell of bodies that go on after a switch, if any had halted.
fn of_taken_up(scene: &Scene, taken_up: &[TakenUp]) -> Option<String> {
    let told = taken_up.iter().map(|TakenUp { halt, from }| {
        let body = &scene.bodies[halt.body];
        let fate = if halt.is_blow_up() { "had blown up" } else { "had halted" };
        let origin = match from {
            Origin::Truth => format!("the {} solution", body.kind.truth.id()),
            Origin::LastGood => "its last good state".into(),
        };
        format!("{} {fate}: taken up again from {origin}", body.name)
    });
    (!taken_up.is_empty()).then(|| told.collect::<Vec<_>>().join("; "))
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
        let told = |halt: &Halt, from| of_taken_up(&scene, &[TakenUp { halt: halt.clone(), from }]);
        assert_eq!(
            told(&gave_up, Origin::Truth).unwrap(),
            "helm had halted: taken up again from the reference solution"
        );
        assert_eq!(
            told(&blew_up, Origin::LastGood).unwrap(),
            "helm had blown up: taken up again from its last good state"
        );
        assert_eq!(of_taken_up(&scene, &[]), None);
    }
}
