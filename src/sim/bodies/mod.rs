//! The bodies: one file each, one line each in the table below.
//!
//! A body is a closed system with natural coordinates, and with an exact flow if it has a closed form.
//! Its [`Kind`] card says how a scene describes it; [`Look`](crate::lab::picture::Look) says how it is
//! drawn. To add one, copy `spring.rs`, declare it, and name it in [`BODIES`].

mod chain;
mod claims;
mod false_claims;
mod follow;
mod helm;
mod kepler;
mod kind;
mod law;
mod net;
mod orbit;
mod oscillator;
mod own;
mod own_sheet;
mod pendulum;
mod refusal;
mod ship;
mod spring;
mod survey;

pub use chain::Chain;
pub use claims::ClaimHorizon;
pub use false_claims::FalseClaims;
pub use follow::Follow;
pub use helm::Helm;
pub use kind::{Build, Coordinate, Kind, Truth};
pub use law::{Law, check_law, law_kind};
pub use net::{Net, net_kind};
pub use orbit::{Ellipse, Orbit};
pub use own::{Energy, Exact, Extras, Own, OwnFault, own_kind};
pub use own_sheet::OwnSheet;
pub use pendulum::Pendulum;
pub use refusal::refusal;
pub use ship::Ship;
pub use spring::Spring;

pub use super::body::{Body, Input};
pub use super::curve::Curve;
pub use super::net_plan::{
    Form, Grid, Lists, MOST_NODES, MOST_SPRINGS, NetFault, NetPart, NetPlan, Pin, PlannedSpring,
};
pub use super::parameter::{Acts, Fault, LARGEST, MOST_POINTS, Parameter, ParameterOf, Range};
pub use super::piece::{Distances, MOST_SWITCHES, NO_BOUNDARIES, Piece};

/// Every kind of body, in menu order.
pub static BODIES: &[Kind] =
    &[ship::KIND, spring::KIND, chain::KIND, pendulum::KIND, orbit::KIND, helm::KIND, follow::KIND];

/// The kind with this id. A [law](law_kind) and a [body of one's own](own_kind) have kinds of their own, which are
/// not in the table.
pub fn kind(id: &str) -> Option<&'static Kind> {
    BODIES.iter().find(|kind| kind.id == id)
}
