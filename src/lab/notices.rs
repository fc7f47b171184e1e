//! Notices about bodies that halt and bodies that resume.

use super::action::Action;
use super::lane::{Halt, Resumed, ResumedFrom};
use super::race::{Observer, Race};
use super::scene::Scene;
use crate::sim::bodies::FalseClaims;

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
    fn after(&mut self, race: &Race, action: &Action, resumed: &[Resumed]) {
        self.tell(of_taken_up(self.scene, resumed));
        self.tell(of_claims(self.scene, race, action));
    }

    fn ticked(&mut self, race: &Race) {
        self.tell(of_halts(self.scene, race));
    }
}

/// A notice about the bodies that halted in the last tick, if any did. Allocates nothing if none did. A reference that
/// was not tried is told of on the stage.
fn of_halts(scene: &Scene, race: &Race) -> Option<String> {
    let halts = || race.just_halted().filter(|(_, halt)| !halt.failure.is_foreseen());
    halts().next()?;
    let told = halts().map(|(place, Halt { tick, body, failure })| {
        let truth = race.truth().bodies()[*body].truth().id();
        let body = &scene.bodies[*body];
        match place {
            Some(place) => {
                let spec = race.list()[race.entrants()[place].entry];
                let name = spec.told_apart(spec.method.name, race.list());
                format!("{name} halted at tick {tick}: {} {failure}", body.name)
            }
            None => {
                let name = &body.name;
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

/// A notice about the claims of a law that do not hold with the constants that an action has set.
fn of_claims(scene: &Scene, race: &Race, action: &Action) -> Option<String> {
    let &Action::Set { body, .. } = action else { return None };
    let FalseClaims { energy, exact } = race.truth().bodies()[body].false_claims();
    let told = [
        energy.then_some("its `energy` is not conserved, and is not shown"),
        exact.then_some("its `exact` does not solve the equation: the truth is the reference"),
    ];
    let told: Vec<&str> = told.into_iter().flatten().collect();
    (!told.is_empty())
        .then(|| format!("{}: with these constants {}", scene.bodies[body].name, told.join("; ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Command, Lab, METRICS};
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

    #[test]
    fn a_constant_with_which_a_claim_fails_is_told_of_and_one_with_which_it_holds_is_not() {
        let text = "title = 'x'\ntick_hz = 60\nseconds = 5\nmethods = ['rk4']\n[[law]]\nname = 'spring'\n\
            constants = { k = 9.0, c = 0.0, a = 1.0 }\nenergy = 'vx^2/2 + k*x^2/2'\n[law.coordinates.x]\nstart = 0.3\n\
            acceleration = '-k*x - c*vx'\nexact = 'a*x0*cos(sqrt(k)*t)'";
        let mut lab = Lab::new(Scene::parse("x.toml", text).unwrap());
        let mut set = |parameter: usize, value: f64| {
            lab.apply(Command::Act(Action::Set { body: 0, parameter, value }));
            let drift = METRICS.iter().find(|metric| metric.id == "energy_drift").unwrap();
            let absent = drift.absent_on(&lab.race().truth().bodies()[0]);
            let told = lab.viewer.notice.take().map(|notice| notice.to_string());
            (told, absent.contains("with these constants"))
        };
        assert_eq!(set(0, 16.0), (None, false));
        let (damped, is_said) = set(1, 0.5);
        assert_eq!(
            damped.unwrap(),
            "spring: with these constants its `energy` is not conserved, and is not shown; its `exact` does not solve \
             the equation: the truth is the reference"
        );
        assert!(is_said);
        assert_eq!(set(1, 0.0), (None, false));
        let (unsolved, is_said) = set(2, 1.1);
        assert!(unsolved.unwrap().starts_with("spring: with these constants its `exact` does not"));
        assert!(!is_said);
    }
}
