//! The kind of a net.

use std::sync::{Arc, LazyLock};

use super::topology::{Storage, Topology};
use super::{Net, PARAMETERS};
use crate::sim::bodies::kind::{Coordinates, Kind, Origin};
use crate::sim::net_plan::{NetFault, NetPlan};
use crate::sim::parameter::{Parameter, ParameterOf};

impl Net {
    /// The parameters of every net.
    pub fn descriptions() -> &'static [Parameter] {
        static DESCRIPTIONS: LazyLock<Vec<Parameter>> =
            LazyLock::new(|| PARAMETERS.iter().map(ParameterOf::parameter).collect());
        &DESCRIPTIONS
    }
}

/// The kind of nets of this plan.
///
/// # Errors
/// All faults of the plan.
pub fn net_kind(plan: NetPlan) -> Result<Arc<Kind>, Vec<NetFault>> {
    let faults = plan.faults();
    if !faults.is_empty() {
        return Err(faults);
    }
    let plan = Arc::new(plan);
    let topology = Arc::new(Topology::new(plan.clone()));
    Ok(Arc::new(Kind {
        id: "net",
        about:
            "m xᵢ″ = Σ (k (ℓ - ℓ₀) + c ℓ′) u - b xᵢ′ + m g: masses joined by springs in the plane"
                .into(),
        all_coordinates: coordinates(&topology),
        leading: "stiffness_n_per_m".into(),
        origin: Origin::Net(plan),
        ..Kind::of(Net::blank(topology))
    }))
}

/// The names of the coordinates: by a rule for a large grid, else in a list, so that halting allocates nothing.
fn coordinates(topology: &Arc<Topology>) -> Coordinates {
    let (of, count) = (topology.clone(), 2 * topology.free);
    let names = move |index: usize| {
        let (axis, node) = (['x', 'y'][index % 2], of.node_at(index / 2));
        [format!("{axis}{node}"), format!("v{axis}{node}")]
    };
    let by_rule = Coordinates::by_rule(count, "m", Arc::new(names));
    match topology.storage {
        Storage::Rows(_) => by_rule,
        Storage::Arrays(_) => by_rule.iter().collect::<Vec<_>>().into(),
    }
}
