//! Notices about bodies that halt and bodies that resume.

use crate::run::race::{Halt, Observer, PerformedAction, Race, Resumed, ResumedFrom};
use crate::scene::{Action, LaneSpec, Scene};
use crate::sim::bodies::FalseClaims;

/// An observer that collects notices from a race.
pub(super) struct Notices<'s> {
    scene: &'s Scene,
    /// Parts of the latest notice, or none if there was no notice.
    pub(super) parts: Vec<String>,
}

impl<'s> Notices<'s> {
    pub(super) fn new(scene: &'s Scene) -> Self {
        Self { scene, parts: Vec::new() }
    }

    fn set_parts(&mut self, told: Vec<String>) {
        if !told.is_empty() {
            self.parts = told;
        }
    }
}

impl Observer for Notices<'_> {
    fn after(&mut self, race: &Race, done: &PerformedAction) {
        self.set_parts(resumed_notice(self.scene, &done.resumed));
        self.set_parts(of_claims(self.scene, race, &done.action).into_iter().collect());
    }

    fn ticked(&mut self, race: &Race) {
        self.set_parts(of_halts(self.scene, race));
    }
}

/// Returns the notice about bodies that halted in the last tick, without an allocation if none did. It omits a
/// reference that would take too much work, because the stage reports that.
fn of_halts(scene: &Scene, race: &Race) -> Vec<String> {
    let halts = race.just_halted().filter(|(_, halt)| !halt.failure.is_foreseen());
    let told = halts.flat_map(|(entrant, halt)| {
        let Halt { tick, body: index, failure, .. } = halt;
        let truth = race.truth().bodies()[*index].truth().id();
        let body = &scene.bodies[*index];
        let Some(entrant) = entrant else {
            let halted =
                format!("the {truth} solution halted at tick {tick}: {} {failure}", body.name);
            return vec![halted, "comparisons with it have ended".into()];
        };
        let lanes: Vec<LaneSpec> = race.entrants().iter().map(|lane| lane.spec).collect();
        let name = entrant.spec.distinct_name(entrant.spec.method.name, &lanes);
        match halt.is_blow_up() {
            true => {
                let fate = entrant.lane.bodies()[*index].fate().unwrap_or_default();
                vec![format!("{name}: {} {fate}", body.name)]
            }
            // The reason that the solver gave has its own line.
            false => vec![format!("{name}: {} {}", body.name, halt.fate()), failure.to_string()],
        }
    });
    told.collect()
}

/// Returns the notice about halted bodies that a switch has resumed.
fn resumed_notice(scene: &Scene, resumed: &[Resumed]) -> Vec<String> {
    let told = resumed.iter().map(|Resumed { halt, from }| {
        let body = &scene.bodies[halt.body];
        let fate = if halt.is_blow_up() { "had blown up" } else { "had halted" };
        let origin = match from {
            ResumedFrom::Truth => format!("the {} solution", body.kind.truth_of(&body.values).id()),
            ResumedFrom::LastGood => "its last good state".into(),
        };
        format!("{} {fate}: resumed from {origin}", body.name)
    });
    told.collect()
}

/// Returns the notice about claims of a law that fail with the constants that an action set.
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
    use crate::run::{METRICS, Metric};
    use crate::sim::integrators::StepFailure;
    use crate::sim::number::duration;
    use crate::{RunCommand, StageCommand, Studio};

    #[test]
    fn a_resumed_body_is_reported_with_its_halt_and_new_start() {
        let scene = Scene::built_in("helm").unwrap();
        let failures = [
            StepFailure::NewtonFailed { limit: 9 },
            StepFailure::NotFinite { coordinate: "x".into(), value: f64::NAN },
        ];
        let [gave_up, blew_up] =
            failures.map(|failure| Halt { tick: 3, t: 0.05, body: 0, failure });
        let told =
            |halt: &Halt, from| resumed_notice(&scene, &[Resumed { halt: halt.clone(), from }]);
        assert_eq!(
            told(&gave_up, ResumedFrom::Truth),
            ["helm had halted: resumed from the reference solution"]
        );
        assert_eq!(
            told(&blew_up, ResumedFrom::LastGood),
            ["helm had blown up: resumed from its last good state"]
        );
        assert!(resumed_notice(&scene, &[]).is_empty());
    }

    #[test]
    fn a_blow_up_is_reported_with_its_time_and_its_value_in_units() {
        let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
        studio.apply(StageCommand::Method(
            crate::sim::integrators::method("explicit-euler").unwrap(),
        ));
        studio.apply(StageCommand::TickHz(10.into()));
        while studio.selected().lane.halted().is_none() {
            studio.tick();
        }
        let halt = studio.selected().lane.halted().unwrap().clone();
        assert_eq!(halt.t, halt.tick as f64 / 10.0);
        let when = format!("blew up at {}", duration(halt.t));
        assert_eq!(halt.fate(), when);
        let fate = studio.selected().lane.bodies()[halt.body].fate().unwrap();
        assert_eq!(fate, format!("{when} (speed reached 10³⁹ m/s)"));
        let notice = studio.viewer.notice.take().unwrap().to_string();
        assert_eq!(notice, format!("Explicit Euler: stiff spring {fate}"));
    }

    #[test]
    fn a_blow_up_of_a_net_names_the_node_by_its_number() {
        let mut studio = Studio::new(Scene::built_in("bridge").unwrap());
        let method = crate::sim::integrators::method("explicit-euler").unwrap();
        studio.apply(StageCommand::Method(method));
        studio.apply(StageCommand::TickHz(20.into()));
        for _ in 0..2000 {
            studio.tick();
            if let Some(halt) = studio.selected().lane.halted() {
                let fate = studio.selected().lane.bodies()[halt.body].fate().unwrap();
                let (_, node) = fate.split_once("(node ").unwrap_or_else(|| panic!("{fate}"));
                let number = node.split(' ').next().unwrap();
                assert!(number.parse::<u32>().is_ok(), "{fate}");
                return;
            }
        }
        panic!("it did not blow up");
    }

    #[test]
    fn a_constant_is_reported_only_if_it_breaks_a_claim() {
        let text = "title = 'x'\ntick_hz = 60\nseconds = 5\nmethods = ['rk4']\n[[law]]\nname = 'spring'\n\
            constants = { k = 9.0, c = 0.0, a = 1.0 }\nenergy = 'vx^2/2 + k*x^2/2'\n[law.coordinates.x]\nstart = 0.3\n\
            acceleration = '-k*x - c*vx'\nexact = 'a*x0*cos(sqrt(k)*t)'";
        let mut studio = Studio::new(Scene::parse("x.toml", text).unwrap());
        let mut set = |parameter: usize, value: f64| {
            studio.apply(RunCommand::Act(Action::Set { body: 0, parameter, value }));
            let drift = &METRICS[Metric::ENERGY_DRIFT];
            let absent = drift.absent_on(&studio.race().truth().bodies()[0]);
            let told = studio.viewer.notice.take().map(|notice| notice.to_string());
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
