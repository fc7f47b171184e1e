//! Gives the claims of a custom body to the [checker](crate::bodies::claims).

use super::Custom;
use crate::bodies::claims::{self, Checked, ClaimFault, ClaimHorizon, Claimant, TIMES};
use crate::body::Body;
use crate::numerics::{OFFSETS, XorShift, fourth_order};
use crate::state::State;
use crate::system::System;

/// A false claim about a custom body. Messages are in lower case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CustomFault {
    /// The name of a field of [`Extras`](super::Extras), or `start` or `acceleration`.
    pub field: &'static str,
    /// The error message.
    pub what: String,
    /// How to mend the fault.
    pub remedy: &'static str,
}

/// The relative tolerance of a claim, which allows for the error of differences.
const TOLERANCE: f64 = 1e-6;

/// Steps of finite differences, in seconds. For a motion of any pace, one of these steps is so short that the motion
/// over it is smooth, but so long that rounding is small.
const STEPS: [f64; 6] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

impl Claimant for Custom {
    const TOLERANCE: f64 = TOLERANCE;
    const START_KEYS: [&'static str; 2] = ["start.q", "start.v"];

    fn name(&self, coordinate: usize) -> &str {
        &self.info.coordinates[coordinate].name
    }

    fn claimed(&self, t: f64, to: &mut State<Vec<f64>>) -> bool {
        self.motion.exact(t, to)
    }

    fn claimed_slope(&self, t: f64, wanted: &State<Vec<f64>>) -> State<Vec<f64>> {
        let at = |t: f64| {
            let mut to = wanted.clone();
            self.motion.exact(t, &mut to);
            [to.q, to.v].concat()
        };
        let wanted = [&wanted.q[..], &wanted.v[..]].concat();
        let mut nearest = vec![f64::NAN; wanted.len()];
        for h in STEPS {
            let states = OFFSETS.map(|times| at(t + times * h));
            for (i, nearest) in nearest.iter_mut().enumerate() {
                let slope = fourth_order(states.each_ref().map(|state| state[i]), h);
                let is_nearer = (slope - wanted[i]).abs() < (*nearest - wanted[i]).abs();
                if is_nearer || nearest.is_nan() {
                    *nearest = slope;
                }
            }
        }
        let v = nearest.split_off(wanted.len() / 2);
        State { q: nearest, v }
    }

    fn claimed_energy(&self, State { q, v }: &State<Vec<f64>>) -> Option<f64> {
        self.motion.energy(q, Some(v))
    }

    fn power(&self, t: f64, State { q, v }: &State<Vec<f64>>) -> Option<[f64; 2]> {
        let mut a = v.clone();
        self.acceleration(t, q, v, &mut a);
        // Computes the energy some seconds later, if only the place changes, only the velocity, or both.
        let energy = |moved: f64, turned: f64| {
            let q: Vec<f64> = q.iter().zip(v).map(|(q, v)| q + moved * v).collect();
            let v: Vec<f64> = v.iter().zip(&a).map(|(v, a)| v + turned * a).collect();
            self.motion.energy(&q, Some(&v)).unwrap_or(f64::NAN)
        };
        // A state off the motion need not have an energy or a force.
        let here = energy(0.0, 0.0);
        if !here.is_finite() || a.iter().any(|a| !a.is_finite()) {
            return None;
        }
        let power = |h: f64| {
            let rate = |moved: f64, turned: f64| {
                let energies = OFFSETS.map(|times| energy(moved * times * h, turned * times * h));
                fourth_order(energies, h).abs()
            };
            [rate(1.0, 1.0), rate(1.0, 0.0) + rate(0.0, 1.0)]
        };
        let is_kept = |h: f64| {
            let [leaks, exchanged] = power(h);
            leaks <= TOLERANCE * exchanged + 4.0 * f64::EPSILON * here.abs() / h
        };
        Some(if STEPS.into_iter().any(is_kept) { [0.0, power(1e-4)[1]] } else { power(1e-4) })
    }

    fn without_claims(&self) -> Self {
        Self { checked: Checked::without_claims(), ..self.clone() }
    }
}

impl From<ClaimFault> for CustomFault {
    fn from(ClaimFault { coordinate, what, remedy }: ClaimFault) -> Self {
        Self { field: coordinate.map_or("energy", |_| "exact"), what, remedy }
    }
}

/// Returns the first nonlinearity of a body that is declared linear; `None` if there is none, or if the body is not
/// declared linear.
fn find_nonlinearity(body: &Custom) -> Option<CustomFault> {
    if !body.is_linear {
        return None;
    }
    let n = body.start.q.len();
    let acceleration = |t: f64, state: &[f64]| {
        let [q, v] = [&state[..n], &state[n..]].map(<[f64]>::to_vec);
        let mut a = vec![0.0; n];
        body.acceleration(t, &q, &v, &mut a);
        a
    };
    let mut random = XorShift::new(0x2545_F491_4F6C_DD1D);
    let still = vec![0.0; 2 * n];
    for t in TIMES {
        // The states are from far inside to far outside the motion, beyond any corners of the force.
        for reach in [1e-3, 0.03, 1.0, 30.0, 1e3] {
            let mut state = || (0..2 * n).map(|_| reach * random.next()).collect::<Vec<_>>();
            let [one, other] = [state(), state()];
            let sum: Vec<f64> = one.iter().zip(&other).map(|(a, b)| a + b).collect();
            let at = [&still, &one, &other, &sum].map(|state| acceleration(t, state));
            let [none, one, other, sum] = at;
            for i in 0..n {
                let parts = [one[i] - none[i], other[i] - none[i], acceleration(0.0, &still)[i]];
                let size = parts.iter().fold(sum[i].abs(), |size, part| size.max(part.abs()));
                let off = [sum[i] - none[i] - parts[0] - parts[1], none[i] - parts[2]];
                if off.iter().any(|off| off.is_nan() || off.abs() > 1e-9 * size) {
                    let name = &body.info.coordinates[i].name;
                    let what =
                        format!("the acceleration of {name} is not linear at {reach} from 0");
                    let remedy = "leave it out: the default is no";
                    return Some(CustomFault { field: "is_linear", what, remedy });
                }
            }
        }
    }
    None
}

/// Checks that a custom body starts with finite numbers.
pub(super) fn check_start(body: &Custom) -> Result<(), CustomFault> {
    let State { q, v } = body.start();
    let mut a = v.clone();
    body.acceleration(0.0, &q, &v, &mut a);
    for (values, what) in [(&q, "coordinate"), (&v, "velocity"), (&a, "acceleration")] {
        if let Some(i) = values.iter().position(|value| !value.is_finite()) {
            let name = &body.info.coordinates[i].name;
            let what = format!("the {what} of {name} is {} at the start", values[i]);
            return Err(CustomFault { field: "start", what, remedy: "begin with finite numbers" });
        }
    }
    Ok(())
}

/// Checks the start and the claims of a custom body. The claims are checked at the ticks of the horizon too.
pub(super) fn check(body: &Custom, horizon: ClaimHorizon) -> Result<(), CustomFault> {
    check_start(body)?;
    claims::check(body, horizon)?;
    find_nonlinearity(body).map_or(Ok(()), Err)
}
