//! The lanes of a scene, with their numbers, methods, substeps, tolerances and joints.

use std::fmt;

use crate::sim::integrators::{Method, Override};
use crate::sim::number::round;
use crate::sim::{Impact, Range, Solver};

/// Number of a lane, from 1 in the order of the scene. The number stays the same when other lanes leave the run or
/// return, and when the lane changes its method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LaneId(pub usize);

impl LaneId {
    /// Returns the lane at this index of a scene's lanes.
    pub const fn of_index(index: usize) -> Self {
        Self(index + 1)
    }

    /// Returns the lane's index among the scene's lanes.
    pub fn index(self) -> usize {
        self.0 - 1
    }
}

/// Writes the lane's number.
impl fmt::Display for LaneId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The method of a lane, with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSpec {
    /// The method of the lane's bodies.
    pub method: &'static Method,
    /// Number of equal steps per tick, 1 to [`MAX_SUBSTEPS`](super::MAX_SUBSTEPS).
    pub substeps: u32,
    /// Absolute and relative tolerance of an adaptive method, within [`TOLERANCES`](super::TOLERANCES), in place of
    /// those of the method's card. `None` keeps the card's tolerances, and is the only value for other methods.
    pub tolerance: Option<f64>,
    /// Joint settings that an engine uses for every spring, in place of the body's own. `None` is the only value for
    /// methods without a joint.
    pub joint: Option<Swing>,
    /// Rule for the impacts of bodies with walls. Other bodies ignore it.
    pub impact: &'static Impact,
}

/// The swing of a spring, independent of the mass on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// Frequency of the swing without damping, in hertz.
    pub frequency_hz: f64,
    /// Damping ratio (1 = critical).
    pub damping_ratio: f64,
}

impl Swing {
    /// Ranges of the frequency and the damping ratio.
    pub const RANGES: [Range; 2] = [Range::POSITIVE, Range::NON_NEGATIVE];

    /// Whether both numbers are in their ranges.
    pub fn is_in_range(self) -> bool {
        let both = [self.frequency_hz, self.damping_ratio];
        Self::RANGES.into_iter().zip(both).all(|(range, value)| range.contains(value))
    }

    /// Returns the stiffness in 1/s² and damping in 1/s, each per unit of mass.
    pub fn per_mass(self) -> [f64; 2] {
        let omega = std::f64::consts::TAU * self.frequency_hz;
        [omega * omega, 2.0 * self.damping_ratio * omega]
    }
}

impl LaneSpec {
    /// Creates a lane under a method with the tolerance and the substeps of the method's card.
    pub fn plain(method: &'static Method) -> Self {
        let (substeps, impact) = (method.default_substeps, Impact::of(method));
        Self { method, substeps, tolerance: None, joint: None, impact }
    }

    /// Returns the lane with this rule for impacts, unless it does not [fit](Impact::fits) the method.
    #[must_use]
    pub fn with_impact(self, impact: &'static Impact) -> Self {
        if impact.fits(self.method) { Self { impact, ..self } } else { self }
    }

    /// Returns the rule for impacts, if it is another than a lane of this method has by itself.
    pub fn own_impact(&self) -> Option<&'static Impact> {
        Some(self.impact).filter(|impact| *impact != Impact::of(self.method))
    }

    /// Returns the method's `name`, followed by each setting in which another of `lanes` with this method differs.
    pub fn distinct_name(&self, name: &str, lanes: &[LaneSpec]) -> String {
        let alike = || lanes.iter().filter(|other| other.method == self.method);
        let has_others = alike().any(|other| other.substeps != self.substeps);
        let times = if has_others { format!(" ×{}", self.substeps) } else { String::new() };
        let within =
            self.tolerance.filter(|_| alike().any(|other| other.tolerance != self.tolerance));
        let within = within.map(|tolerance| format!(" {tolerance:e}")).unwrap_or_default();
        format!("{name}{times}{within}{}{}", self.joint_suffix(lanes), self.impact_suffix(lanes))
    }

    /// Returns the rule for impacts as a suffix, if one of `lanes` has another rule. One that a method has by itself
    /// goes without saying.
    fn impact_suffix(&self, lanes: &[LaneSpec]) -> String {
        let has_choice = |lane: &LaneSpec| <&Impact>::default().fits(lane.method);
        let mut others = lanes.iter().filter(|lane| has_choice(lane));
        let is_told = has_choice(self) && others.any(|lane| lane.impact != self.impact);
        if is_told { format!(", {}", self.impact.id) } else { String::new() }
    }

    /// Returns the joint's frequency as a suffix, if another of `lanes` with this method has another joint.
    fn joint_suffix(&self, lanes: &[LaneSpec]) -> String {
        let mut alike = lanes.iter().filter(|other| other.method == self.method);
        let told = self.joint.filter(|_| alike.any(|other| other.joint != self.joint));
        told.map(|it| format!(", set to {} Hz", round(it.frequency_hz, 3))).unwrap_or_default()
    }

    /// Returns the method's name with the substeps, unless these are 1 and no other of `lanes` with this method has
    /// more.
    pub fn name_with_substeps(&self, lanes: &[LaneSpec]) -> String {
        let mut others = lanes.iter().filter(|other| other.method == self.method);
        let name = self.method.name;
        let told = self.joint_suffix(lanes) + &self.impact_suffix(lanes);
        match self.substeps > 1 || others.any(|other| other.substeps != self.substeps) {
            true => format!("{name} ×{}{told}", self.substeps),
            false => format!("{name}{told}"),
        }
    }

    /// Returns the solver of the lane's bodies.
    pub fn solver(&self) -> Solver {
        let joint = self.joint.map(|joint| Override::Joint(joint.per_mass()));
        let setting = joint.or(self.tolerance.map(Override::tolerance));
        match setting {
            _ if let Some(impact) = self.own_impact() => {
                Solver::Bouncing(self.method, setting, impact)
            }
            Some(setting) => Solver::With(self.method, setting),
            None => Solver::Method(self.method),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::integrators::method;

    #[test]
    fn names_of_lanes_with_one_method_show_the_difference() {
        let lane = |id, substeps, tolerance| LaneSpec {
            substeps,
            tolerance,
            ..LaneSpec::plain(method(id).unwrap())
        };
        let joint = Some(Swing { frequency_hz: 1.0009, damping_ratio: 0.074 });
        let told = LaneSpec { joint, ..lane("engine-box2d", 4, None) };
        let lanes = [
            told,
            lane("held-force", 1, None),
            lane("held-force", 4, None),
            lane("engine-box2d", 4, None),
            lane("adaptive-euler", 1, Some(1e-3)),
            lane("adaptive-euler", 1, Some(1e-6)),
            lane("rk4", 1, None),
        ];
        let names = lanes.map(|lane| lane.distinct_name(lane.method.name, &lanes));
        let expected = [
            "Box2D, set to 1 Hz",
            "Held force ×1",
            "Held force ×4",
            "Box2D",
            "Adaptive Euler 1e-3",
            "Adaptive Euler 1e-6",
            "Runge-Kutta 4",
        ];
        assert_eq!(names, expected);
        let with_substeps = lanes.map(|lane| lane.name_with_substeps(&lanes));
        let expected = ["Box2D ×4, set to 1 Hz", "Held force ×1", "Held force ×4", "Box2D ×4"];
        assert_eq!(with_substeps[..4], expected);
        assert_eq!(with_substeps[6], "Runge-Kutta 4");
    }
}
