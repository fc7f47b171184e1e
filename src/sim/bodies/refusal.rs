//! Which bodies a method refuses.

use super::kind::Kind;
use crate::sim::integrators::Method;

/// Why `method` does not step a body of `kind` with these parameter values, as the [card of the
/// body](Kind::engine_refusal) says or else that of the [method](crate::sim::integrators::Only); `None` if it does.
pub fn refusal(method: &Method, kind: &Kind, values: &[f64]) -> Option<&'static str> {
    let only = method.only?;
    let has = |(key, wanted): (&str, f64)| {
        kind.parameter(key).is_some_and(|(place, _)| values.get(place) == Some(&wanted))
    };
    let fits = only.kinds.contains(&kind.id) && only.with.is_none_or(has);
    let of_kind = kind.engine_refusal.filter(|_| method.is_engine());
    (!fits).then_some(of_kind.unwrap_or(only.reason))
}
