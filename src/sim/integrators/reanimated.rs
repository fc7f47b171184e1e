//! Reanimated, which takes every overdamped spring for a critically damped one.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "reanimated",
    name: "Reanimated",
    about: "the closed form, which from critical damping on is always the critical one; frames are cut to 64 ms; stands once it \
            has 6e-9 of its energy",
    caveat: "a damping ratio of 2 moves as 1; below 15.6 frames a second it lags; a throw away from the target is lost at the start, \
             and here a kick is a new start",
    exact_if_linear: true,
    restart: Some("with the energy of that moment"),
    source: "runs of react-native-reanimated 4.8.0: spring.ts, springUtils.ts",
    formula: &[
        "g = f / K, x = x − g, ω = √K, t = min(H, 0.064), b = min((c + C) / 2, ω)",
        "the first time: if x v > 0: v = 0; E = x² + v² / K",
        "η = √(ω² − b²), u = v + b x, e = e^(−b t)",
        "x′ = e (x cos η t + u sin η t / η), v′ = e (v cos η t − (b v + K x) sin η t / η), without η: t for sin η t / η",
        "if x′² + v′² / K ≤ 6e-9 E: x′ = 0, v′ = 0",
        "x′ = x′ + g",
    ],
    ..INTERFACE
};

/// Reanimated, whose frame follows the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct Reanimated;

impl Reanimated {
    /// Part of the energy at the start that counts as rest.
    pub const REST: f64 = 6e-9;
    /// Longest frame, in seconds.
    const LONGEST_S: f64 = 0.064;
}

impl EngineRule for Reanimated {
    fn tick<V: Vector>(tick: EngineTick<'_, V>, q: &mut V, v: &mut V) {
        let (t, set) = (tick.length.min(Self::LONGEST_S), tick.settings);
        let omega = set.stiffness.sqrt();
        let b = ((set.damping + set.drag) / 2.0).min(omega);
        let eta = (set.stiffness - b * b).max(0.0).sqrt();
        let cosine = libm::cos(eta * t);
        let sine = if eta > 0.0 { libm::sin(eta * t) / eta } else { t };
        let left = libm::exp(-b * t);
        let energies = tick.carried.expect("its card says how it restarts")[0].components_mut();
        let moved = q.components_mut().iter_mut().zip(v.components_mut());
        for (((q, v), f), energy) in moved.zip(tick.force.components()).zip(energies) {
            let target = f / set.stiffness;
            let x = *q - target;
            if *energy == 0.0 {
                *v = if x * *v > 0.0 { 0.0 } else { *v };
                *energy = x * x + *v * *v / set.stiffness;
            }
            let way = left * (x * cosine + (*v + b * x) * sine);
            *v = left * (*v * cosine - (b * *v + set.stiffness * x) * sine);
            *q = target + way;
            if way * way + *v * *v / set.stiffness <= Self::REST * *energy {
                (*q, *v) = (target, 0.0);
            }
        }
    }
}
