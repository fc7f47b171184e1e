//! The kind of a law.

use std::sync::Arc;

use super::Law;
use super::claims::{check_start, first_key};
use crate::bodies::kind::{Coordinate, Kind, Origin};
use crate::body::Body;
use crate::law::{CoordinateText, Equations, LawFault, LawText};
use crate::parameter::{Fault, Parameter, Range, TakesEffect, Text};
use crate::state::quotient;
use crate::system::BodyClass;
use crate::system::System;

/// Returns the kind of bodies that move by this law. The parameters of the kind are the constants, then the starts
/// `x.start` of all coordinates, their start velocities `x.start_velocity`, and their kicks `x.kick`.
///
/// # Errors
/// All faults of the text.
pub fn law_kind(text: LawText) -> Result<Arc<Kind>, Vec<LawFault>> {
    let equations = Arc::new(Equations::new(text)?);
    let text = equations.text();
    let coordinate =
        |of: &CoordinateText| Coordinate::new(of.name.clone(), format!("v{}", of.name), of.unit);
    let inputs: &[&str] = match equations.is_steered() {
        [false, false] => Law::INPUTS,
        [true, false] => &["throttle", "kick"],
        [false, true] => &["rudder", "kick"],
        [true, true] => &["throttle", "rudder", "kick"],
    };
    let about: Vec<_> =
        text.coordinates.iter().map(|of| format!("{}″ = {}", of.name, of.acceleration)).collect();
    let first_key: Text = first_key(&text.coordinates, &text.constants).into();
    let parameters = parameters(text);
    let leading = leading(&equations).map(|index| text.constants[index].clone().into());
    // All bodies are clones of this one, so that they share the findings on their claims.
    let template = Law::new(equations.clone(), &vec![1.0; parameters.len()]);
    Ok(Arc::new(Kind {
        id: "law",
        about: about.join("; ").into(),
        all_coordinates: text.coordinates.iter().map(coordinate).collect::<Vec<_>>().into(),
        parameters,
        inputs,
        leading: leading.unwrap_or_else(|| first_key.clone()),
        origin: Origin::Law(equations.clone()),
        batch: super::copies::batch,
        has_walls: equations.events() > 0,
        class: match equations.events() {
            0 => Law::CLASS,
            _ => BodyClass::NoEngine("it meets walls of its own, and engines bounce a ball only"),
        },
        ..Kind::checked(template, move |mut law, values| {
            law.write(values);
            check_start(&law).map_err(|fault| Fault {
                key: first_key.clone(),
                what: fault.what,
                remedy: "give it another start or other constants".into(),
            })
        })
    }))
}

fn parameters(text: &LawText) -> Vec<Parameter> {
    let constant = |name: &String| {
        Parameter::new(
            name.clone().into(),
            "a constant of the law",
            Range::ANY,
            TakesEffect::AtOnce,
        )
    };
    let mut parameters: Vec<_> = text.constants.iter().map(constant).collect();
    for (key, about, per_s, acts) in [
        ("start", "where it is at the start", "", TakesEffect::AtStart),
        ("start_velocity", "its velocity at the start", "/s", TakesEffect::AtStart),
        ("kick", "the change of its velocity by one kick", "/s", TakesEffect::AtOnce),
    ] {
        parameters.extend(text.coordinates.iter().enumerate().map(|(index, of)| Parameter {
            unit: match (of.unit, per_s) {
                ("1", "") => "".into(),
                (unit, per_s) => format!("{unit}{per_s}").into(),
            },
            default: Some(f64::from(u8::from(key == "kick" && index == 0))),
            ..Parameter::new(format!("{}.{key}", of.name).into(), about, Range::ANY, acts)
        }));
    }
    parameters
}

/// Returns the index of the constant with which ∂a/∂q grows most, if all constants are about 1. Returns `None` if ∂a/∂q
/// grows with no constant.
fn leading(equations: &Arc<Equations>) -> Option<usize> {
    let text = equations.text();
    let (n, constants) = (text.coordinates.len(), text.constants.len());
    let q: Vec<f64> = (0..n).map(|i| 0.5 + 0.125 * i as f64).collect();
    let v: Vec<f64> = q.iter().map(|q| 0.5 * q).collect();
    let stiffness = |raised: Option<usize>| {
        let mut values = vec![1.0; constants + 3 * n];
        if let Some(index) = raised {
            values[index] = 1.25;
        }
        let law = Law { steering: [1.0; 2], ..Law::new(equations.clone(), &values) };
        let acceleration = |i: usize, by: f64| {
            let (mut q, mut a) = (q.clone(), q.clone());
            q[i] += by;
            law.acceleration(0.0, &q, &v, &mut a);
            a
        };
        let slope = |i: usize| {
            let mut slope = acceleration(i, 0.25);
            quotient(&mut slope, &acceleration(i, -0.25), 0.5);
            slope.iter().map(|by| by * by).sum::<f64>()
        };
        (0..n).map(slope).sum::<f64>()
    };
    let plain = stiffness(None);
    let growths = (0..constants).map(|index| (index, stiffness(Some(index)) - plain));
    let growing = growths.filter(|(_, growth)| *growth > 1e-9 * plain && growth.is_finite());
    // Of equal growths, the first counts.
    growing.reduce(|most, next| if next.1 > most.1 { next } else { most }).map(|(index, _)| index)
}
