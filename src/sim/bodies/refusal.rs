//! Which bodies a method refuses.

use super::kind::Kind;
use crate::sim::integrators::{LAW_ORDER, Method};

/// Why `method` does not step a body of `kind` with these parameter values, as the [card of the
/// body](Kind::engine_refusal) says or else that of the [method](crate::sim::integrators::Only); `None` if it does.
pub fn refusal(method: &Method, kind: &Kind, values: &[f64]) -> Option<&'static str> {
    let only = method.only?;
    let is_of = |order: u32| {
        let parameter = kind.parameter(LAW_ORDER);
        parameter.is_some_and(|(index, _)| values.get(index) == Some(&f64::from(order)))
    };
    let fits = only.kinds.contains(&kind.id) && only.law_order.is_none_or(is_of);
    let of_kind = kind.engine_refusal.filter(|_| method.is_engine());
    (!fits).then_some(of_kind.unwrap_or(only.reason))
}
