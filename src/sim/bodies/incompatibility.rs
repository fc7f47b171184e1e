//! Which bodies a method refuses.

use super::follow::LAW_ORDER;
use super::kind::Kind;
use super::{BODIES, Custom, Law, Net};
use crate::sim::body::Body;
use crate::sim::integrators::Method;

/// Why `method` does not step a body of `kind` with these parameter values, as its [card](crate::sim::integrators::Only)
/// or the [class](Kind::class) of the body says; `None` if it does.
pub fn incompatibility(method: &Method, kind: &Kind, values: &[f64]) -> Option<&'static str> {
    let only = method.only?;
    let is_of = |order: u32| {
        let parameter = kind.parameter(LAW_ORDER);
        parameter.is_some_and(|(index, _)| values.get(index) == Some(&f64::from(order)))
    };
    let other_law = method.law_order().is_some_and(|order| !is_of(order));
    other_law.then_some(only.reason).or_else(|| only.incompatibility(kind.class))
}

/// The kinds of bodies that `method` steps, for people; `None` if it steps all.
pub fn stepped_kinds(method: &Method) -> Option<String> {
    let only = method.only?;
    let others = [("law", Law::CLASS), ("custom", Custom::CLASS), ("net", Net::CLASS)];
    let kinds = BODIES.iter().map(|kind| (kind.id, kind.class)).chain(others);
    let stepped = kinds.filter(|(_, class)| only.incompatibility(*class).is_none());
    let ids = stepped.map(|(id, _)| id).collect::<Vec<_>>().join(", ");
    Some(
        method.law_order().map_or(ids.clone(), |order| format!("{ids} with {LAW_ORDER} = {order}")),
    )
}
