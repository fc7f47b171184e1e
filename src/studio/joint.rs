//! A spring of a studio's scene, described as the joint of an engine.

use super::Studio;
use super::deck::Deck;
use crate::run::MenuIndex;
use crate::run::race::LaneBody;
use crate::scene::{Action, Swing};
use crate::tools::port::{Setup, setups};

/// The spring of a scene: the indices and the values of its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringJoint {
    /// Index of the spring in the scene.
    pub body: usize,
    /// Indices of the mass, the stiffness and the damping among the spring's parameters.
    indices: [usize; 3],
    /// Mass in kg.
    pub mass_kg: f64,
    /// Stiffness in 1/s² and damping in 1/s, both per unit of mass.
    pub joint: [f64; 2],
}

/// The keys of a spring's mass, stiffness and damping.
const KEYS: [&str; 3] = ["mass_kg", "stiffness_n_per_m", "damping_n_s_per_m"];

impl SpringJoint {
    /// Returns the actions that set one setting of a mode to `value` and keep its other setting.
    pub fn set(&self, setup: Setup, setting: usize, value: f64) -> [Action; 2] {
        let mut values = setup.mode.values(self.joint, self.mass_kg);
        values[setting] = value;
        let joint = setup.mode.joint(values, self.mass_kg);
        [0, 1].map(|i| Action::Set {
            body: self.body,
            parameter: self.indices[i + 1],
            value: joint[i] * self.mass_kg,
        })
    }
}

impl Deck {
    /// Returns the present settings of a body that is a spring, or `None` if an engine's joint cannot represent the
    /// body.
    pub fn spring_joint(&self, body: usize) -> Option<SpringJoint> {
        let LaneBody { kind, stepper, .. } = &self.race().truth().bodies()[body];
        let joint = kind.joint(&**stepper)?;
        let [mass, stiffness, damping] = KEYS.map(|key| Some(kind.parameter(key)?.0));
        let indices = [mass?, stiffness?, damping?];
        Some(SpringJoint { body, indices, mass_kg: self.race().values(body)[indices[0]], joint })
    }

    /// Returns the setups of every mode of every engine, at the race's tick rate.
    pub fn joint_setups(&self) -> Vec<Setup> {
        setups(None, f64::from(self.race().tick_hz()), None)
    }
}

/// Returns the lines of code that set the displayed body's spring in the engine with this menu index. Returns `None` if
/// the entry is not an engine with a joint, or if the body is not a spring.
pub fn joint_code(studio: &Studio, entry: MenuIndex) -> Option<String> {
    let spring = studio.deck.spring_joint(studio.viewer.view.body)?;
    let spec = studio.entries().get(entry)?;
    let tick_hz = f64::from(studio.race().tick_hz());
    let setup = *setups(Some(&[spec.method]), tick_hz, Some(spec.substeps)).first()?;
    let joint = spec.joint.map_or(spring.joint, Swing::per_mass);
    Some(setup.code(setup.mode.values(joint, spring.mass_kg)) + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::{DriverRequest, RunCommand, StageCommand, Studio, ViewCommand};

    #[test]
    fn an_engines_setting_changes_the_spring_and_control_c_copies_it() {
        let mut studio = Studio::new(Scene::built_in("engines").unwrap());
        let spring = studio.deck.spring_joint(0).unwrap();
        let setups = studio.deck.joint_setups();
        let box2d = setups.iter().find(|setup| setup.mode.stiffness.name == "hertz").unwrap();
        for action in spring.set(*box2d, 0, 3.0) {
            studio.apply(RunCommand::Act(action));
        }
        let spring = studio.deck.spring_joint(0).unwrap();
        for action in spring.set(*box2d, 1, 0.25) {
            studio.apply(RunCommand::Act(action));
        }
        let spring = studio.deck.spring_joint(0).unwrap();
        let [hertz, ratio] = box2d.mode.values(spring.joint, spring.mass_kg);
        assert!((hertz - 3.0).abs() < 1e-12 && (ratio - 0.25).abs() < 1e-12, "{hertz} {ratio}");

        let entry = studio.entries().iter().position(|spec| spec.method == box2d.method).unwrap();
        let code = joint_code(&studio, entry).unwrap();
        assert!(code.contains("def.hertz = 3.0;\n"), "{code}");
        assert_eq!(
            studio.apply(DriverRequest::CopyJoint(entry)),
            Some(DriverRequest::CopyJoint(entry))
        );
        studio.apply(ViewCommand::PointAt(Some(entry)));
        assert_eq!(studio.apply(ViewCommand::Copy), Some(DriverRequest::CopyJoint(entry)));
        // The method for any other body is copied as source code, and so is an engine's step by its menu.
        let ship = studio.scene().bodies.iter().position(|body| body.kind.id == "ship").unwrap();
        assert_eq!(studio.deck.spring_joint(ship), None);
        studio.apply(StageCommand::Body(ship));
        studio.apply(ViewCommand::PointAt(Some(entry)));
        assert_eq!(studio.apply(ViewCommand::Copy), Some(DriverRequest::CopyMethod(entry)));
        assert_eq!(studio.apply(DriverRequest::CopyJoint(entry)), None);
        // The copied code of an engine lane with spring settings of its own has these settings.
        let alike = Studio::new(Scene::built_in("alike").unwrap());
        let told = [0, 3].map(|entry| joint_code(&alike, entry).unwrap());
        assert!(told[0].contains("= 1.5;") && told[1].contains("= 1.50169895;"), "{told:?}");
    }
}
