//! Finds the step behind a log of a free spin in space: each row gives the next one, under every step for such a body.

use glam::{DQuat, DVec3};

use super::candidates::{Candidate, SpringForm};
use super::{Conclusion, Fitted, Identification};
use crate::sim::bodies::{Body, Tumble};
use crate::sim::integrators::{Family, METHODS, Method, Needs, integrator, problem};
use crate::sim::{BodyClass, State};

/// Largest number of substeps.
const MAX_SUBSTEPS: u32 = 8;
/// Largest residual that fits numbers of single precision, and that of double precision.
const NOISE: f64 = 1e-6;
const EXACT: f64 = 1e-11;
/// A step is named if the next one has a residual larger than its own by the second factor, or by the first if its own
/// is exact.
const APART: [f64; 2] = [4.0, 16.0];
/// Largest difference of steps that are the same on this body, in parts of the fastest spin.
const ALIKE: f64 = 1e-13;

/// Finds the step behind ticks, each with its ω (rad/s) in the frame of the principal axes, with these moments of
/// inertia about them. Of the moments only the ratios count. A residual is the largest difference after one tick, in
/// parts of the fastest spin and of the terms of a step of it.
///
/// Returns `None` if no two rows are a tick apart, or if nothing spins.
pub fn identify_spin(
    rows: &[(u64, DVec3)],
    moments: DVec3,
    tick_hz: f64,
) -> Option<Identification> {
    let moments = moments / moments.max_element();
    let next = |pair: &&[(u64, DVec3)]| pair[1].0 == pair[0].0 + 1;
    let pairs: Vec<_> = rows.windows(2).filter(next).map(|pair| [pair[0].1, pair[1].1]).collect();
    let fastest = pairs.iter().flatten().map(|spin| spin.length()).fold(0.0, f64::max);
    // A step rounds the terms of its sum, which exceed the sum where it explodes.
    let bend = fastest / moments.min_element() / tick_hz;
    let scale = fastest * (1.0 + bend);
    let largest = |differences: &mut dyn Iterator<Item = DVec3>| {
        differences.map(|it| it.abs().max_element() / scale).fold(0.0, f64::max)
    };
    let fit = |candidate: Candidate| {
        let of = |[from, _]: &[DVec3; 2]| after_tick(&candidate, moments, *from, 1.0 / tick_hz);
        let spins = pairs.iter().map(of).collect::<Option<Vec<DVec3>>>()?;
        let residual = largest(&mut spins.iter().zip(&pairs).map(|(found, [_, to])| found - to));
        Some((Fitted { candidate, residual }, spins))
    };
    let mut fits: Vec<(Fitted, Vec<DVec3>)> = candidates().filter_map(fit).collect();
    // Steps that are the same differ by rounding. A rule for a body that spins comes before a general method of the
    // same step, and before the engines that use it.
    let rank = |fitted: &Fitted| {
        let Candidate { method, substeps, .. } = fitted.candidate;
        (method.is_engine(), !is_rule(method), substeps)
    };
    fits.sort_by(|(a, _), (b, _)| {
        (a.residual as f32).total_cmp(&(b.residual as f32)).then(rank(a).cmp(&rank(b)))
    });
    let (least, of_least) = fits.first().filter(|_| fastest > 0.0)?;
    let is_same = |(_, spins): &&(Fitted, Vec<DVec3>)| {
        largest(&mut spins.iter().zip(of_least).map(|(a, b)| a - b)) <= ALIKE
    };
    let mut same: Vec<Fitted> = fits.iter().filter(is_same).map(|(fitted, _)| *fitted).collect();
    same.sort_by_key(rank);
    let rival = fits.iter().find(|fit| !is_same(fit)).map(|(fitted, _)| *fitted);
    let apart = APART[usize::from(least.residual > EXACT)];
    let is_apart = rival.is_some_and(|rival| rival.residual > apart * least.residual);
    let conclusion = match (least.residual <= NOISE, is_apart) {
        (false, _) => Conclusion::Unknown,
        (true, false) => Conclusion::CannotTell,
        (true, true) => Conclusion::Identified,
    };
    Some(Identification {
        conclusion,
        best: same.first().copied(),
        also: same[1..].iter().map(|fitted| fitted.candidate).collect(),
        runner_up: rival,
        ..Identification::default()
    })
}

/// Whether a method is for spins alone.
fn is_rule(method: &Method) -> bool {
    method.only.is_some_and(|only| only.needs == Needs::Spin)
}

/// Returns the steps that a body has for spins alone, those of engines, and the general ones that need no earlier step.
fn candidates() -> impl Iterator<Item = Candidate> {
    let steps = |method: &&Method| {
        let is_whole = method.restart.is_none() && method.family != Family::Adaptive;
        method.incompatibility(BodyClass::Spin).is_none() && (method.is_engine() || is_whole)
    };
    METHODS.iter().filter(steps).flat_map(|method| {
        let spring = SpringForm::Acceleration;
        (1..=MAX_SUBSTEPS).map(move |substeps| Candidate { method, substeps, spring })
    })
}

/// Returns the spin (rad/s) after a tick (s); `None` if the step fails.
fn after_tick(of: &Candidate, moments: DVec3, spin: DVec3, tick_s: f64) -> Option<DVec3> {
    let body = Tumble { moments, spin, attitude: DQuat::IDENTITY, ..Tumble::default() };
    let mut state: State<Vec<f64>> = body.start();
    let mut stepper = integrator(of.method, &state.q);
    stepper.steps(&problem(body), 0.0, tick_s, of.substeps, &mut state).ok()?;
    let spin = Tumble::spin_of(&state.v);
    spin.is_finite().then_some(spin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::Log;
    use crate::table::TableOptions;

    /// Identifies a log of the tests as the command does.
    fn identified(name: &str, moments: DVec3) -> Identification {
        let path = format!("{}/../../tests/data/engines/{name}.csv", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap();
        let of = |x: &str| {
            let [x, v] = [x, "wy"].map(|name| Some(name.to_owned()));
            Log::parse(name, &text, &TableOptions { x, v, ..TableOptions::default() }, 60.0)
                .unwrap()
        };
        let [x, z] = [of("wx"), of("wz")];
        let rows = x.rows().iter().zip(z.rows());
        let rows: Vec<_> =
            rows.map(|(x, z)| (x.tick, DVec3::new(x.x, x.v.unwrap(), z.x))).collect();
        identify_spin(&rows, moments, 60.0).unwrap()
    }

    /// Identifies ticks of a method of the table, kept in single precision.
    fn of_single_precision(id: &str, moments: DVec3, spin: DVec3, hz: f64) -> Identification {
        let method = crate::sim::integrators::method(id).unwrap();
        let step = Candidate { method, substeps: 1, spring: SpringForm::Acceleration };
        let next = |spin: &DVec3| {
            let next = after_tick(&step, moments, *spin, 1.0 / hz)?.as_vec3().as_dvec3();
            (next.length() < 1e6).then_some(next)
        };
        let spins = std::iter::successors(Some(spin), next).take(200);
        identify_spin(&Vec::from_iter((0..).zip(spins)), moments, hz).unwrap()
    }

    #[test]
    fn a_step_in_single_precision_is_never_given_the_name_of_another() {
        let moments = DVec3::new(1.0, 2.0, 3.0);
        let newton = of_single_precision("gyro-newton", moments, DVec3::new(0.3, 2.0, 0.2), 60.0);
        assert_eq!(newton.best.unwrap().candidate.method.id, "gyro-newton");
        assert_eq!(newton.conclusion, Conclusion::Identified);
        for near in [1e-3, 1e-2, 0.1] {
            let moments = DVec3::new(1.0, 2.0, 2.0 + near);
            let found =
                of_single_precision("implicit-euler", moments, DVec3::new(0.3, 1.0, 0.8), 60.0);
            let is_right = found.conclusion == Conclusion::CannotTell
                || found.best.unwrap().candidate.method.id == "implicit-euler";
            assert!(is_right, "{near}: {:?}", found.best);
        }
        let spin = DVec3::new(3.0, 12.0, 2.0);
        let exploding = of_single_precision("gyro-explicit", moments, spin, 10.0);
        assert_eq!(exploding.conclusion, Conclusion::Identified, "{:?}", exploding.best);
        assert_eq!(exploding.best.unwrap().candidate.method.id, "gyro-explicit");
    }

    #[test]
    fn the_step_behind_each_log_of_an_engine_is_named_or_cannot_be_told() {
        let of_engines = [
            ("bullet", "gyro-newton"),
            ("mujoco-implicit", "gyro-newton"),
            ("mujoco-implicitfast", "gyro-newton"),
            ("mujoco-Euler", "gyro-explicit"),
            ("mujoco-RK4", "gyro-rk4"),
            ("jolt-gyro", "gyro-rescaled"),
            ("physx-pgs-gyro", "gyro-rescaled"),
        ];
        let moments = DVec3::new(1.0, 2.0, 3.0);
        for (engine, id) in of_engines {
            for start in ["a", "b", "c"] {
                let name = format!("{engine}__tumble_{start}_60hz");
                let found = identified(&name, moments);
                // Near the middle axis in single precision.
                if start == "c" && id == "gyro-rescaled" {
                    assert_eq!(found.conclusion, Conclusion::CannotTell, "{name}");
                    continue;
                }
                let best = found.best.unwrap();
                assert_eq!(found.conclusion, Conclusion::Identified, "{name}: {best:?}");
                assert_eq!((best.candidate.method.id, best.candidate.substeps), (id, 1), "{name}");
            }
        }
        let rapier = identified("rapier3d__tumble_a_60hz_n4", 7.0 * moments);
        let best = rapier.best.unwrap().candidate;
        assert_eq!((best.method.id, best.substeps), ("gyro-rescaled", 4), "only ratios count");
        let is_rapier = |it: &Candidate| it.method.id == "engine-rapier" && it.substeps == 4;
        assert!(rapier.also.iter().any(is_rapier));
        let wrong = identified("rapier3d__tumble_a_60hz_n4", DVec3::new(1.0, 2.0, 2.5));
        assert_eq!(wrong.conclusion, Conclusion::Unknown);
    }
}
