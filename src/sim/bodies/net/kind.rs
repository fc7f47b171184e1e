//! The kind of a net.

use std::sync::{Arc, LazyLock};

use super::frame::Frame;
use super::{Net, PARAMETERS};
use crate::sim::bodies::kind::{Coordinate, Kind, Origin};
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
    let frame = Frame::new(&plan);
    let axes = |node: &usize| {
        ['x', 'y']
            .map(|axis| Coordinate::new(format!("{axis}{node}"), format!("v{axis}{node}"), "m"))
    };
    Ok(Arc::new(Kind {
        id: "net",
        about:
            "m xᵢ″ = Σ (k (ℓ - ℓ₀) + c ℓ′) u - b xᵢ′ + m g: masses joined by springs in the plane"
                .into(),
        all_coordinates: frame.free.iter().flat_map(axes).collect(),
        leading: "stiffness_n_per_m".into(),
        origin: Origin::Net(Arc::new(plan)),
        ..Kind::of(Net::blank(Arc::new(frame)))
    }))
}
