//! Checks each claim of a method's card against a measurement.
//!
//! A method that does better than its card is as wrong as one that does worse. The measurements run on [problems] with
//! known solutions, and assume nothing about a method from its family.

use std::error::Error;
use std::fmt;

use super::bodies::stepped_kinds;
use super::integrators::{Family, METHODS, Method};

mod cost;
mod geometry;
mod linear;
mod memory;
mod order;
pub mod problems;
mod similarity;
mod stability;
mod tolerance;

pub use order::orders_of;
pub use stability::limits;

/// A claim of a card, and its measurement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// Name of the field of [`Method`] that makes the claim.
    pub field: &'static str,
    /// The claimed value.
    pub claimed: String,
    /// The measured value, in words.
    pub measured: String,
    /// Whether the claimed and the measured value agree.
    pub holds: bool,
}

/// The claims of a card, measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conformance {
    /// The method's id.
    pub method: &'static str,
    /// The claims, in the order of the method's card.
    pub claims: Vec<Claim>,
}

impl Conformance {
    /// Whether all claims hold.
    pub fn holds(&self) -> bool {
        self.claims.iter().all(|claim| claim.holds)
    }

    /// Returns the claims that do not hold.
    pub fn broken(&self) -> impl Iterator<Item = &Claim> {
        self.claims.iter().filter(|claim| !claim.holds)
    }
}

/// Writes a heading, and one line per claim.
impl fmt::Display for Conformance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let broken = self.broken().count();
        match broken {
            0 => writeln!(f, "{}: its card holds", self.method)?,
            1 => writeln!(f, "{}: a claim of its card does not hold", self.method)?,
            _ => writeln!(f, "{}: {broken} claims of its card do not hold", self.method)?,
        }
        for Claim { field, claimed, measured, holds } in &self.claims {
            let word = if *holds { "ok" } else { "NO" };
            writeln!(f, "  {word}  {field:<15} {claimed:<10} {measured}")?;
        }
        Ok(())
    }
}

/// Measures every claim of a method's card: the orders, evaluations, stability limit, tolerance and memory. Also
/// measures whether the method is exact on linear systems, symplectic and reversible, and whether it keeps time. All
/// this takes about a second.
///
/// A method that steps [only](Method::only) some bodies cannot be measured on these problems; the only claim of the
/// result then says so and does not hold.
///
/// ```
/// use regatta_sim::conformance::check;
/// use regatta_sim::prelude::*;
///
/// let found = check(method("midpoint").expect("a built-in method"));
/// assert!(found.holds(), "{found}");
/// ```
pub fn check(method: &Method) -> Conformance {
    let claims = match method.only {
        Some(only) => vec![Claim {
            field: "only",
            claimed: stepped_kinds(method).unwrap_or_default(),
            measured: format!("not measured: {}", only.reason),
            holds: false,
        }],
        // Such a card cannot build an integrator.
        None if !is_listed(method) && !method.is_from_outside() => vec![named(method)],
        None => vec![
            named(method),
            order::without_drag(method),
            order::with_drag(method),
            cost::evaluations(method),
            linear::exact_if_linear(method),
            geometry::symplectic(method),
            geometry::reversible(method),
            stability::limit(method),
            tolerance::tolerance(method),
            memory::restart(method),
            cost::keeps_time(method),
        ],
    };
    Conformance { method: method.id, claims }
}

/// Returns the card of a method with measured values in place of its claims, which are the orders, evaluations,
/// stability limits, exactness on linear systems, symplectic, reversible and memory. Returns beside it the text of
/// [`Method::about`], which states the orders, how the energy of a spring changes, and the nearest built-in method. A
/// claim that cannot be measured is left out, and an order that cannot be measured is 0.
pub fn measured(card: &'static Method) -> (Method, String) {
    let is_so = |found: Measured| found.is_ok_and(|(is_so, _)| is_so);
    let exact_if_linear = is_so(linear::is_exact(card));
    let orders = orders_of(&Method { exact_if_linear, ..*card });
    let [order, order_with_drag] =
        orders.each_ref().map(|found| found.as_ref().map_or(0, |it| order::whole(*it)));
    let counts = cost::counts(card).map(|(_, counts)| counts).unwrap_or_default();
    let count = counts.first().filter(|_| counts.len() == 1);
    let evaluations = count.and_then(|count| u32::try_from(*count).ok());
    let has_memory = is_so(memory::has_memory(card));
    let symplectic = is_so(geometry::keeps_area(card));
    let rounded = |limit: f64| (1e3 * limit).round() / 1e3;
    let limits = limits(card).unwrap_or([Some(0.0); 4]).map(|limit| limit.map(rounded));
    let [undamped, damped @ ..] = limits;
    let about = format!(
        "{}{}; {}; {}",
        if card.default_substeps > 1 { "with 1 substep " } else { "" },
        order::in_words(&orders),
        similarity::energy(card),
        similarity::nearest(card, evaluations)
    );
    let measured = Method {
        family: if symplectic { Family::Symplectic } else { Family::Explicit },
        order,
        order_with_drag,
        evaluations,
        exact_if_linear,
        symplectic,
        reversible: is_so(geometry::is_reversible(card)),
        stability_limit: undamped,
        damped_limits: match damped {
            [Some(slight), Some(medium), Some(critical)] => Some([slight, medium, critical]),
            _ => None,
        },
        restart: has_memory.then_some("by the first values of its memory"),
        ..*card
    };
    (measured, about)
}

/// Whether a method of the table has the id of `method`.
fn is_listed(method: &Method) -> bool {
    METHODS.iter().any(|listed| listed.id == method.id)
}

/// Measures whether the id is well formed and unique, and whether the card has a name.
fn named(method: &Method) -> Claim {
    let Method { id, name, .. } = *method;
    let is_kebab = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    let is_listed = is_listed(method);
    let (measured, holds) = if id.is_empty() || !id.chars().all(is_kebab) {
        ("an id has lower-case letters, digits and hyphens".to_owned(), false)
    } else if name.is_empty() {
        ("it has no name".to_owned(), false)
    } else if is_listed && method.is_from_outside() {
        ("a method of the table has this id".to_owned(), false)
    } else if !is_listed && !method.is_from_outside() {
        ("it is not in the table, and `custom` does not say how it is built".to_owned(), false)
    } else {
        (format!("{name:?}"), true)
    };
    Claim { field: "id", claimed: id.to_owned(), measured, holds }
}

/// Whether a claim is true, with the evidence in words; or the reason why the claim cannot be measured.
type Measured = Result<(bool, String), Box<dyn Error>>;

/// Returns a yes-or-no claim; `found` has the measured answer and the evidence.
fn yes_or_no(field: &'static str, claimed: bool, found: Measured) -> Claim {
    let word = if claimed { "yes" } else { "no" };
    let (measured, holds) = match found {
        Ok((is_so, how)) => (how, is_so == claimed),
        Err(failure) => (failure.to_string(), false),
    };
    Claim { field, claimed: word.to_owned(), measured, holds }
}
