//! The kind of a net.

use std::sync::{Arc, LazyLock};

use super::frame::{Frame, Layout};
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
    let frame = Arc::new(Frame::new(plan.clone()));
    Ok(Arc::new(Kind {
        id: "net",
        about:
            "m xᵢ″ = Σ (k (ℓ - ℓ₀) + c ℓ′) u - b xᵢ′ + m g: masses joined by springs in the plane"
                .into(),
        all_coordinates: coordinates(&frame),
        leading: "stiffness_n_per_m".into(),
        origin: Origin::Net(plan),
        ..Kind::of(Net::blank(frame))
    }))
}

/// The names of the coordinates: by a rule for a large grid, else in a list, so that halting allocates nothing.
fn coordinates(frame: &Arc<Frame>) -> Coordinates {
    let (of, count) = (frame.clone(), 2 * frame.free);
    let names = move |index: usize| {
        let (axis, node) = (['x', 'y'][index % 2], of.node_at(index / 2));
        [format!("{axis}{node}"), format!("v{axis}{node}")]
    };
    let by_rule = Coordinates::by_rule(count, "m", Arc::new(names));
    match frame.layout {
        Layout::Rows(_) => by_rule,
        Layout::Arrays(_) => by_rule.iter().collect::<Vec<_>>().into(),
    }
}
