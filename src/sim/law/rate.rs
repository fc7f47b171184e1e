//! The second-order form of equations of first order, by the chain rule.

use regatta_lines::{MAX_BYTES, Term, derivative, parse};

use super::compile::PartScope;
use super::{At, Equations, FIRST_COORDINATE, LawText, Part, Registers, T};

/// The second-order form of a coordinate of first order.
pub struct SecondOrder {
    /// The acceleration; `None` if a part of the rate has no derivative here.
    pub acceleration: Option<String>,
    /// The velocity at the start.
    pub start_velocity: f64,
}

/// Returns the second-order form of each coordinate of `law`, in which each acceleration is in truth a rate. `values`
/// are those of the law. In its own acceleration a coordinate's rate is its velocity, so that a lag becomes a drag.
///
/// Returns `None` if the rates have a fault.
pub fn second_order(law: &LawText, values: &[f64]) -> Option<Vec<SecondOrder>> {
    let equations = Equations::new(law.clone()).ok()?;
    let n = law.coordinates.len();
    let mut rates = vec![0.0; n];
    let (q, v) = (&values[law.constants.len()..][..n], &vec![0.0; n]);
    let at = At { t: 0.0, steering: [0.0; 2], q, v };
    equations.accelerate(&mut Registers::new(&equations, values), at, &mut rates);
    let form = |(of, start_velocity): (usize, f64)| {
        let text = &law.coordinates[of].acceleration;
        let rate = parse(text, &PartScope { text: law, part: Part::Acceleration(of) }).ok()?;
        let slope = derivative(text, &rate, &|slot| slope_of_input(law, of, slot));
        let acceleration = slope.map(|slope| slope.unwrap_or_else(|| "0".into()));
        let acceleration = acceleration.filter(|text| text.len() <= MAX_BYTES);
        Some(SecondOrder { acceleration, start_velocity })
    };
    rates.into_iter().enumerate().map(form).collect()
}

/// Returns the derivative of an input by time, in the rate of the coordinate with index `of`.
fn slope_of_input(law: &LawText, of: usize, slot: usize) -> Option<Term> {
    let coordinates = &law.coordinates;
    match slot.checked_sub(FIRST_COORDINATE).filter(|index| *index < coordinates.len()) {
        Some(index) if index == of => Some(Some(format!("v{}", coordinates[index].name))),
        Some(index) => Some(Some(coordinates[index].acceleration.clone())),
        None if slot == T => Some(Some("1".into())),
        None => law.slots_of_constants().contains(&slot).then_some(None),
    }
}
