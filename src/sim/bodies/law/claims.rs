//! What a law claims, for the [checker](crate::sim::bodies::claims), and the messages about false claims.

use std::sync::Arc;

use super::Law;
use crate::sim::bodies::claims::{
    Checked, ClaimHorizon, Claimant, EnergyDefect, NotSolved, find_departure, find_energy_defect,
    find_later_energy_defect, find_unsolved,
};
use crate::sim::body::Body;
use crate::sim::law::{CoordinateText, Equations, Part, Refusal, Remedy};
use crate::sim::state::State;
use crate::sim::system::System;

impl Claimant for Law {
    // Rounding, with room for terms that cancel.
    const TOLERANCE: f64 = 1e-9;

    fn claimed(&self, t: f64, to: &mut State<Vec<f64>>) -> bool {
        self.equations.solve(&mut self.registers.borrow_mut(), t, |i, [q, v, _]| {
            (to.q[i], to.v[i]) = (q, v);
        })
    }

    fn claimed_slope(&self, t: f64, wanted: &State<Vec<f64>>) -> State<Vec<f64>> {
        let mut slope = wanted.clone();
        self.equations.solve(&mut self.registers.borrow_mut(), t, |i, [_, v, a]| {
            (slope.q[i], slope.v[i]) = (v, a);
        });
        slope
    }

    fn claimed_energy(&self, State { q, v }: &State<Vec<f64>>) -> Option<f64> {
        self.equations.energy(&mut self.registers.borrow_mut(), q, Some(v))
    }

    fn power(&self, t: f64, State { q, v }: &State<Vec<f64>>) -> Option<[f64; 2]> {
        let mut a = v.clone();
        self.acceleration(t, q, v, &mut a);
        let [moved, turned] = self.equations.power(&self.registers.borrow(), [q, v, &a])?;
        let power = [(moved + turned).abs(), moved.abs() + turned.abs()];
        power.iter().all(|power| power.is_finite()).then_some(power)
    }

    fn without_claims(&self) -> Self {
        Self { steering: [1.0, 0.0], checked: Checked::without_claims(), ..self.clone() }
    }
}

/// Checks these values of a law's parameters: the accelerations are finite at the start, an exact solution
/// begins at the start, satisfies the equation and agrees with the reference at every tick of the horizon, and an energy
/// is conserved at every tick.
///
/// # Errors
/// The first of these that does not hold, with its position in the text.
pub fn check_law(
    equations: &Arc<Equations>,
    values: &[f64],
    horizon: ClaimHorizon,
) -> Result<(), Refusal> {
    check_start(equations, values)?;
    let law = Law::new(equations.clone(), values);
    if let Some(fault) = find_unsolved(&law).or_else(|| find_departure(&law, horizon)) {
        return Err(unsolved(&law, fault));
    }
    match find_energy_defect(&law).or_else(|| find_later_energy_defect(&law, horizon)) {
        Some(defect) => Err(energy_defect(&law, defect)),
        None => Ok(()),
    }
}

/// Checks that the accelerations are finite at the start.
pub(super) fn check_start(equations: &Arc<Equations>, values: &[f64]) -> Result<(), Refusal> {
    let law = Law::new(equations.clone(), values);
    let State { q, v } = law.start();
    let mut a = v.clone();
    law.acceleration(0.0, &q, &v, &mut a);
    match equations.not_finite(&law.registers.borrow()) {
        Some(refusal) => Err(refusal),
        None => Ok(()),
    }
}

fn refusal(law: &Law, part: Part, what: String, remedy: &str) -> Refusal {
    let span = 0..law.equations.part(part).len();
    Refusal { part, span, what, remedy: Remedy::Words(remedy.into()) }
}

fn unsolved(law: &Law, fault: NotSolved) -> Refusal {
    let name = |i: usize| &law.equations.text().coordinates[i].name;
    let prefix = |is_velocity| if is_velocity { "v" } else { "" };
    let correct = "correct one of them, or remove `exact`";
    let (coordinate, what, remedy) = match fault {
        NotSolved::Start { coordinate, is_velocity, found, start } => {
            let key = if is_velocity { "start_velocity" } else { "start" };
            let (v, name) = (prefix(is_velocity), name(coordinate));
            let what = format!("`{v}{name}` begins at {found}, and `{key}` is {start}");
            (coordinate, what, "let the two agree; `t` is 0 at the start")
        }
        NotSolved::Velocity { coordinate, t } => {
            let name = name(coordinate);
            let what = format!("at t = {t} the velocity of `{name}` is not its derivative");
            (coordinate, what, correct)
        }
        NotSolved::Equation { coordinate, t, found, wanted } => {
            let name = name(coordinate);
            let what = format!(
                "at t = {t} its second derivative is {found:.9}, and the acceleration of `{name}` there is {wanted:.9}"
            );
            (coordinate, what, correct)
        }
        NotSolved::Motion { coordinate, is_velocity, t, found, wanted } => {
            let (v, name) = (prefix(is_velocity), name(coordinate));
            let what = format!(
                "at t = {t:.4} `{v}{name}` is {found:.9}, and the motion since the tick before leads to {wanted:.9}"
            );
            (coordinate, what, correct)
        }
    };
    refusal(law, Part::Exact(coordinate), what, remedy)
}

fn energy_defect(law: &Law, defect: EnergyDefect) -> Refusal {
    let what = match defect {
        EnergyDefect::NotFinite(energy) => format!("the energy is {energy} at the start"),
        EnergyDefect::Constant(energy) => {
            let what =
                format!("the energy is {energy} in every state, which says nothing of the motion");
            let remedy = "write the kinetic and the potential energy, or remove `energy`";
            return refusal(law, Part::Energy, what, remedy);
        }
        EnergyDefect::Power { t, leaks, exchanged } => format!(
            "the energy is not conserved: near t = {t:.2} it changes by {leaks:.3e} J/s, where {exchanged:.3e} J/s are exchanged"
        ),
        EnergyDefect::Change { t, first, now } => format!(
            "the energy is not conserved: it is {first:.9} J at the start and {now:.9} J at t = {t:.2}"
        ),
    };
    let remedy = "correct it, remove what drives or damps the motion, or remove `energy`";
    refusal(law, Part::Energy, what, remedy)
}

/// The key of a parameter for a fault of the text as a whole: the first.
pub(super) fn first_key(text: &[CoordinateText], constants: &[String]) -> String {
    constants.first().cloned().unwrap_or_else(|| format!("{}.start", text[0].name))
}
