//! The bodies, each with a file of its own and a line in the table below. This file also finds the bodies that a method
//! steps.
//!
//! A body is a closed system with natural coordinates, and with an exact flow if it has a closed form. The [`Kind`]
//! card of a body explains how a scene describes the body, and `Look` how the body is drawn. To
//! add a body, copy `pendulum.rs`, declare the copy, and name it in [`BODIES`].

use std::sync::{Arc, LazyLock};

use super::integrators::Method;
use follow::LAW_ORDER;

mod ball;
mod chain;
mod claims;
mod custom;
mod euler_top;
mod follow;
mod helm;
mod kepler;
mod kind;
mod law;
mod net;
mod orbit;
mod oscillator;
mod pendulum;
mod prelude;
mod ship;
mod spring;
mod tumble;

pub use ball::Ball;
pub use chain::Chain;
pub use claims::{ClaimHorizon, FalseClaims};
pub use custom::{Custom, CustomFault, Energy, Exact, Extras, custom_kind};
pub use follow::Follow;
pub use helm::Helm;
pub use kind::{BatchFn, Build, Check, Coordinate, Coordinates, CustomInfo, Kind, Origin, Truth};
pub use law::{Law, check_law, law_kind};
pub use net::{Net, net_kind};
pub use orbit::{Ellipse, Orbit};
pub use pendulum::Pendulum;
pub use ship::Ship;
pub use spring::Spring;
pub use tumble::Tumble;

pub use super::body::{Body, Distances, Input, MAX_SWITCHES, NO_BOUNDARIES, Piece};
pub use super::net_plan::{
    Grid, Lists, MAX_NODES, MAX_SPRINGS, NetFault, NetLayout, NetPart, NetPlan, Pin, PlannedSpring,
};
pub use super::parameter::{
    Fault, MAX_POINTS, MAX_VALUE, Parameter, ParameterOf, Range, TakesEffect, Text,
};
pub use regatta_lines::Curve;

/// Every kind of body, in menu order.
pub static BODIES: LazyLock<Vec<Arc<Kind>>> = LazyLock::new(|| {
    // What a static names is compiled with every program: each body under each method, also for tests without any.
    // Those of this room have no kinds; a test that wants one is in `tests/library`.
    if cfg!(test) {
        return Vec::new();
    }
    let kinds = [
        ship::kind(),
        spring::kind(),
        chain::kind(),
        pendulum::kind(),
        orbit::kind(),
        helm::kind(),
        follow::kind(),
        ball::kind(),
        tumble::kind(),
    ];
    kinds.map(Arc::new).into()
});

/// Returns the kind with this id. The kinds of a [law](law_kind), a [net](net_kind) and a [custom body](custom_kind)
/// are not in the table.
pub fn kind(id: &str) -> Option<&'static Arc<Kind>> {
    BODIES.iter().find(|kind| kind.id == id)
}

/// Returns the parameters in the groups of a scene's keys: the numbers of a list together, and each other by itself.
pub fn by_key(parameters: &[Parameter]) -> impl Iterator<Item = &[Parameter]> {
    parameters.chunk_by(|a, b| a.list.is_some() && a.list == b.list)
}

/// Returns the reason why `method` does not step a body of `kind` with these parameter values; `None` if it does. The
/// method's [card](crate::integrators::Only) or the body's [class](Kind::class) gives the reason.
pub fn incompatibility(method: &Method, kind: &Kind, values: &[f64]) -> Option<&'static str> {
    if method.has_own_floor && kind.law().is_some() && !kind.has_walls {
        return Some(
            "its lines have a floor at 0, and the law has none; give it `[law.events.floor]`",
        );
    }
    let amplitude = kind.parameter(ball::FLOOR_AMPLITUDE).and_then(|(index, _)| values.get(index));
    if (method.is_engine() || method.has_own_floor) && amplitude.is_some_and(|size| *size > 0.0) {
        return Some("it bounces on a floor at rest, and that of the ball moves");
    }
    let only = method.only?;
    let is_of = |order: u32| {
        let parameter = kind.parameter(LAW_ORDER);
        parameter.is_some_and(|(index, _)| values.get(index) == Some(&f64::from(order)))
    };
    let other_law = method.law_order().is_some_and(|order| !is_of(order));
    other_law.then_some(only.reason).or_else(|| method.incompatibility(kind.class))
}

/// Lists the kinds of bodies that `method` steps, for people; `None` if it steps all kinds.
pub fn stepped_kinds(method: &Method) -> Option<String> {
    method.only?;
    let others = [("law", Law::CLASS), ("custom", Custom::CLASS), ("net", Net::CLASS)];
    let kinds = BODIES.iter().map(|kind| (kind.id, kind.class)).chain(others);
    let stepped = kinds.filter(|(_, class)| method.incompatibility(*class).is_none());
    let ids = stepped.map(|(id, _)| id).collect::<Vec<_>>().join(", ");
    Some(
        method.law_order().map_or(ids.clone(), |order| format!("{ids} with {LAW_ORDER} = {order}")),
    )
}
