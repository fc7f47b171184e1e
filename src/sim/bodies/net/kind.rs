//! The kind of a net: made once for each plan, and kept as long as the program runs.

use std::sync::{LazyLock, Mutex, PoisonError};

use super::frame::Frame;
use super::{Net, PARAMETERS};
use crate::sim::bodies::kind::{Coordinate, Kind, Truth};
use crate::sim::body::Body;
use crate::sim::body_stepper::stepper;
use crate::sim::net_plan::{MOST_NODES, NetFault, NetPlan};
use crate::sim::parameter::{self, Parameter};

impl Net {
    /// The parameters of every net.
    pub const DESCRIPTIONS: &'static [Parameter] = &parameter::descriptions(&PARAMETERS);

    /// Why no engine steps a net; see [`Kind::engine_refusal`].
    pub const ENGINE_REFUSAL: &'static str = "an engine solves a net joint by joint in sweeps, and its formula here is of one joint alone";
}

/// The kinds of all plans so far. They are never freed: the rest of the program holds a body's kind as
/// `&'static`, and a person writes few nets in the life of a process.
static KINDS: Mutex<Vec<&'static Kind>> = Mutex::new(Vec::new());

/// x0, y0, x1, y1 … of every node that a net can have.
static COORDINATES: LazyLock<Vec<[Coordinate; 2]>> = LazyLock::new(|| {
    let coordinate = |axis: char, node: usize| Coordinate {
        name: String::leak(format!("{axis}{node}")),
        velocity: String::leak(format!("v{axis}{node}")),
        unit: "m",
    };
    (0..MOST_NODES).map(|node| ['x', 'y'].map(|axis| coordinate(axis, node))).collect()
});

/// The kind of nets of this plan; the same plan has the same kind.
///
/// # Errors
/// All faults of the plan.
pub fn net_kind(plan: NetPlan) -> Result<&'static Kind, Vec<NetFault>> {
    let mut kinds = KINDS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(kind) = kinds.iter().find(|kind| kind.net == Some(&plan)) {
        return Ok(kind);
    }
    let faults = plan.faults();
    if !faults.is_empty() {
        return Err(faults);
    }
    let kind = Box::leak(Box::new(kind(Box::leak(Box::new(plan)))));
    kinds.push(kind);
    Ok(kind)
}

fn kind(plan: &'static NetPlan) -> Kind {
    let frame: &'static Frame = Box::leak(Box::new(Frame::new(plan)));
    let named = frame.free.iter().flat_map(|&node| &COORDINATES[node]);
    let coordinate =
        |&Coordinate { name, velocity, unit }: &Coordinate| Coordinate { name, velocity, unit };
    let coordinates: &'static [Coordinate] = Vec::leak(named.map(coordinate).collect());
    Kind {
        id: "net",
        about: "m xᵢ″ = Σ (k (ℓ - ℓ₀) + c ℓ′) u - b xᵢ′ + m g: masses joined by springs in the plane",
        coordinates: Box::leak(Box::new(move |_: &[f64]| coordinates)),
        parameters: Net::DESCRIPTIONS,
        inputs: &["kick"],
        leading: "stiffness_n_per_m",
        truth: Truth::Reference,
        check: &|_| Ok(()),
        build: Box::leak(Box::new(move |values: &[f64], solver| {
            stepper(Net::blank(frame).with_parameters(values), solver)
        })),
        engine_refusal: Some(Net::ENGINE_REFUSAL),
        law: None,
        own: None,
        net: Some(plan),
    }
}
