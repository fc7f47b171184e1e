//! The kind of a law: made once for each text, and kept as long as the program runs.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use super::Law;
use super::claims::{check_start, first_key};
use crate::sim::bodies::kind::{Coordinate, Kind, Truth};
use crate::sim::body_stepper::stepper;
use crate::sim::law::{At, Equations, LawText, Refusal, Registers};
use crate::sim::parameter::{Acts, Fault, Parameter, Range};

/// The kinds of all texts so far. They are never freed: the rest of the program holds a body's kind as
/// `&'static`, and a person writes few laws in the life of a process.
static KINDS: Mutex<Option<HashMap<LawText, &'static Kind>>> = Mutex::new(None);

/// The kind of bodies that move by this law; the same text has the same kind. Its parameters are the
/// constants, then of the coordinates `z.start …`, `z.start_velocity …` and `z.kick …`.
///
/// # Errors
/// All faults of the text.
pub fn law_kind(text: LawText) -> Result<&'static Kind, Vec<Refusal>> {
    let mut kinds = KINDS.lock().unwrap_or_else(PoisonError::into_inner);
    let kinds = kinds.get_or_insert_default();
    if let Some(kind) = kinds.get(&text) {
        return Ok(kind);
    }
    let equations: &'static Equations = Box::leak(Box::new(Equations::new(text.clone())?));
    let kind = Box::leak(Box::new(kind(equations)));
    kinds.insert(text, kind);
    Ok(kind)
}

fn leaked(text: String) -> &'static str {
    String::leak(text)
}

fn kind(equations: &'static Equations) -> Kind {
    let text = equations.text();
    let coordinate = |of: &crate::sim::law::CoordinateText| Coordinate {
        name: leaked(of.name.clone()),
        velocity: leaked(format!("v{}", of.name)),
        unit: of.unit,
    };
    let coordinates: &'static [Coordinate] =
        Vec::leak(text.coordinates.iter().map(coordinate).collect());
    let inputs: &[&str] = match equations.is_steered() {
        [false, false] => &["kick"],
        [true, false] => &["throttle", "kick"],
        [false, true] => &["rudder", "kick"],
        [true, true] => &["throttle", "rudder", "kick"],
    };
    let about: Vec<_> =
        text.coordinates.iter().map(|of| format!("{}″ = {}", of.name, of.acceleration)).collect();
    let first_key = leaked(first_key(&text.coordinates, &text.constants));
    let check = move |values: &[f64]| {
        check_start(equations, values).map_err(|refusal| Fault {
            key: first_key,
            what: refusal.what,
            remedy: "give it another start or other constants".into(),
        })
    };
    Kind {
        id: "law",
        about: leaked(about.join("; ")),
        coordinates: Box::leak(Box::new(move |_: &[f64]| coordinates)),
        parameters: Vec::leak(parameters(equations)),
        inputs,
        leading: leading(equations)
            .map_or(first_key, |place| leaked(text.constants[place].clone())),
        truth: Truth::Reference,
        check: Box::leak(Box::new(check)),
        build: Box::leak(Box::new(move |values: &[f64], solver| {
            stepper(Law::new(equations, values), solver)
        })),
        engine_refusal: None,
        law: Some(equations),
        own: None,
        net: None,
    }
}

fn parameters(equations: &Equations) -> Vec<Parameter> {
    let text = equations.text();
    let constant = |name: &String| Parameter {
        key: leaked(name.clone()),
        about: "a constant of the law",
        unit: "",
        default: None,
        range: Range::ANY,
        acts: Acts::AtOnce,
    };
    let mut parameters: Vec<_> = text.constants.iter().map(constant).collect();
    for (key, about, per_s, acts) in [
        ("start", "where it is at the start", "", Acts::AtStart),
        ("start_velocity", "its velocity at the start", "/s", Acts::AtStart),
        ("kick", "the change of its velocity by one kick", "/s", Acts::AtOnce),
    ] {
        parameters.extend(text.coordinates.iter().enumerate().map(|(place, of)| Parameter {
            key: leaked(format!("{}.{key}", of.name)),
            about,
            unit: leaked(if of.unit == "1" && per_s.is_empty() {
                String::new()
            } else {
                format!("{}{per_s}", of.unit)
            }),
            default: Some(f64::from(u8::from(key == "kick" && place == 0))),
            range: Range::ANY,
            acts,
        }));
    }
    parameters
}

/// The place of the constant that makes the motion stiffest: by which the derivatives of the accelerations
/// by the coordinates grow most, with all constants about 1. `None` if none does.
fn leading(equations: &Equations) -> Option<usize> {
    let text = equations.text();
    let (n, constants) = (text.coordinates.len(), text.constants.len());
    let q: Vec<f64> = (0..n).map(|i| 0.5 + 0.125 * i as f64).collect();
    let v: Vec<f64> = q.iter().map(|q| 0.5 * q).collect();
    let stiffness = |raised: Option<usize>| {
        let mut values = vec![1.0; constants + 2 * n];
        if let Some(place) = raised {
            values[place] = 1.25;
        }
        let mut registers = Registers::new(equations, &values);
        let mut acceleration = |q: &[f64]| {
            let mut a = vec![0.0; n];
            equations.accelerate(
                &mut registers,
                At { t: 0.0, steering: [1.0; 2], q, v: &v },
                &mut a,
            );
            a
        };
        let mut sum = 0.0;
        for i in 0..n {
            let [mut lower, mut upper] = [q.clone(), q.clone()];
            (lower[i], upper[i]) = (q[i] - 0.25, q[i] + 0.25);
            let rows = acceleration(&lower).into_iter().zip(acceleration(&upper));
            sum += rows.map(|(a, b)| (b - a) * (b - a)).sum::<f64>();
        }
        sum
    };
    let plain = stiffness(None);
    let growths = (0..constants).map(|place| (place, stiffness(Some(place)) - plain));
    let growing = growths.filter(|(_, growth)| *growth > 1e-9 * plain && growth.is_finite());
    // The first of those that grow alike.
    growing.reduce(|most, next| if next.1 > most.1 { next } else { most }).map(|(place, _)| place)
}
