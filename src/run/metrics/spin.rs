//! The metrics of a body that turns in space.

use super::{Metric, Scale, Unit, if_finite, unless_halted};
use crate::race::LaneBody;
use crate::sim::bodies::Tumble;

/// The angle between two attitudes.
pub(super) const ATTITUDE_ERROR: Metric = Metric {
    id: "attitude_error",
    name: "attitude error",
    absent: "Nothing to compare: this body does not turn in space.",
    unit: Unit::Coordinate,
    scale: Scale::Log,
    is_comparison: true,
    is_of_energy: false,
    about: "angle between the attitudes of a body that turns in space and of its truth, in radians",
    measure: |lane, truth| {
        let [lane, exact] = turning(lane, truth)?.map(|(_, body)| body.stepper.q());
        if_finite(Tumble::angle_between(lane, exact))
    },
};

/// The angle between two momenta, as seen from the bodies.
pub(super) const AXIS_ERROR: Metric = Metric {
    id: "axis_error",
    name: "axis error",
    about: "angle between the directions of the angular momentum as seen from the body and from its truth, in radians",
    measure: |lane, truth| {
        let [lane, exact] = turning(lane, truth)?;
        let of = |(it, body): (&Tumble, &LaneBody)| it.momentum_in_body(body.stepper.v());
        if_finite(Tumble::turn_between(of(lane), of(exact)))
    },
    ..ATTITUDE_ERROR
};

/// The angle between two momenta in space.
pub(super) const MOMENTUM_TURN: Metric = Metric {
    id: "momentum_turn",
    name: "momentum turn",
    scale: Scale::Linear,
    about: "angle in space by which the angular momentum has left that of the truth, which stands still, in radians",
    measure: |lane, truth| {
        let [lane, exact] = turning(lane, truth)?;
        let of = |(it, body): (&Tumble, &LaneBody)| it.momentum(body.stepper.q(), body.stepper.v());
        if_finite(Tumble::turn_between(of(lane), of(exact)))
    },
    ..ATTITUDE_ERROR
};

/// The difference of the lengths of two momenta.
pub(super) const MOMENTUM_LENGTH: Metric = Metric {
    id: "momentum_length",
    name: "momentum length",
    unit: Unit::Percent,
    scale: Scale::Linear,
    about: "length of the angular momentum above that in truth, in percent of it",
    measure: |lane, truth| {
        let [lane, exact] = turning(lane, truth)?;
        let of = |(it, body): (&Tumble, &LaneBody)| it.momentum_in_body(body.stepper.v()).length();
        if_finite(100.0 * (of(lane) / of(exact) - 1.0))
    },
    ..ATTITUDE_ERROR
};

/// Returns the body in a lane and the body in truth, both of which turn in space; `None` for other bodies, and once one
/// of them has halted.
fn turning<'a>(lane: &'a LaneBody, truth: &'a LaneBody) -> Option<[(&'a Tumble, &'a LaneBody); 2]> {
    let [lane, exact] = unless_halted(lane, truth)?;
    let tumble = |body: &'a LaneBody| Some((body.stepper.body().downcast_ref::<Tumble>()?, body));
    Some([tumble(lane)?, tumble(exact)?])
}
