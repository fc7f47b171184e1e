//! The bodies: one file each, one line each in the table below.
//!
//! A body is a closed system with natural coordinates, and with an exact flow if it has a closed form.
//! Its [`Kind`] card says how a scene describes it; [`Look`](crate::look::Look) says how it is
//! drawn. To add one, copy `pendulum.rs`, declare it, and name it in [`BODIES`].

use std::sync::{Arc, LazyLock};

mod chain;
mod claims;
mod custom;
mod follow;
mod helm;
mod incompatibility;
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

pub use chain::Chain;
pub use claims::{ClaimHorizon, FalseClaims};
pub use custom::{Custom, CustomFault, Energy, Exact, Extras, custom_kind};
pub use follow::Follow;
pub use helm::Helm;
pub use incompatibility::{incompatibility, stepped_kinds};
pub use kind::{BatchFn, Build, Check, Coordinate, Coordinates, CustomInfo, Kind, Origin, Truth};
pub use law::{Law, check_law, law_kind};
pub use net::{Net, net_kind};
pub use orbit::{Ellipse, Orbit};
pub use pendulum::Pendulum;
pub use ship::Ship;
pub use spring::Spring;

pub use super::body::{Body, Input};
pub use super::curve::Curve;
pub use super::net_plan::{
    Form, Grid, Lists, MAX_NODES, MAX_SPRINGS, NetFault, NetPart, NetPlan, Pin, PlannedSpring,
};
pub use super::parameter::{
    Acts, Fault, MAX_POINTS, MAX_VALUE, Parameter, ParameterOf, Range, Text,
};
pub use super::piece::{Distances, MAX_SWITCHES, NO_BOUNDARIES, Piece};

/// Every kind of body, in menu order.
pub static BODIES: LazyLock<Vec<Arc<Kind>>> = LazyLock::new(|| {
    let kinds = [
        ship::kind(),
        spring::kind(),
        chain::kind(),
        pendulum::kind(),
        orbit::kind(),
        helm::kind(),
        follow::kind(),
    ];
    kinds.map(Arc::new).into()
});

/// The kind with this id. A [law](law_kind), a [net](net_kind) and a [custom body](custom_kind) have kinds of their own,
/// which are not in the table.
pub fn kind(id: &str) -> Option<&'static Arc<Kind>> {
    BODIES.iter().find(|kind| kind.id == id)
}
