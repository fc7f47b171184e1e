//! Where Newton's iteration does not find the accelerations of a step: they are followed there from a step
//! of which they are known.
//!
//! With the weights α and β multiplied by λ, the equations are solved at λ = 0 by the force at what is known
//! before, and at λ = 1 they are those of the step. The solutions between are a curve, which turns back
//! where two of them meet; counted by its length (Keller, *Numerical solution of bifurcation and nonlinear
//! eigenvalue problems*, 1977), it is followed round such folds. If the force is bounded and smooth, the
//! curve cannot end before it reaches λ = 1.

use super::curve::Curve;
use super::iteration::{Newton, Stages, components, largest};
use crate::sim::system::{System, Vector};

/// The longest stretches of three attempts: with longer ones the curve is left for another nearby, which may
/// lead nowhere, with shorter ones it takes longer.
const LONGEST: [f64; 3] = [0.25, 0.05, 0.01];
/// The shortest stretch: a force that is no smooth function of the state at this scale is given up.
const SHORTEST: f64 = 1e-7;
/// How a stretch grows after it has been corrected onto the curve, and shrinks where it cannot be.
const FACTORS: (f64, f64) = (1.5, 0.3);
/// The most stretches of an attempt: a curve of ten folds takes some hundred.
const MOST_STRETCHES: u32 = 1000;
/// The most corrections of one.
const MOST_CORRECTIONS: u32 = 6;
/// The last correction: the curve need only be followed, and its end is solved to round-off.
const CORRECTED: f64 = 1e-6;
/// The part of λ by which the slope along it is taken.
const NUDGE: f64 = 1e-6;

impl<V: Vector, const S: usize> Newton<V, S> {
    /// Solves the equations, and returns whether it did.
    #[cold]
    pub(super) fn follow(&mut self, system: &impl System<Vector = V>, stages: &Stages<S>) -> bool {
        LONGEST.iter().any(|&longest| self.follow_by(system, stages, longest))
    }

    /// The same by stretches of no more than `longest`, in units of λ, and of the force for accelerations.
    fn follow_by(
        &mut self,
        system: &impl System<Vector = V>,
        stages: &Stages<S>,
        longest: f64,
    ) -> bool {
        // Where the weights are 0, the force is what it is at any accelerations.
        self.a.iter_mut().for_each(|a| a.components_mut().fill(0.0));
        let Self { known, a, found, stage, curve, .. } = self;
        stages.scaled(0.0).evaluate(system, known, a, stage, found);
        let force = largest(components(found));
        if !force.is_finite() {
            return false;
        }
        for (a, found) in a.iter_mut().zip(found.iter()) {
            a.assign(found);
        }
        curve.scale = force.max(f64::MIN_POSITIVE);
        curve.lambda = 0.0;
        curve.tangent.fill(0.0);
        curve.tangent_lambda = 1.0;

        let mut reach = longest;
        for _ in 0..MOST_STRETCHES {
            self.aim(system, stages);
            let Self { a, curve, .. } = self;
            for (from, a) in curve.from.iter_mut().zip(components(a)) {
                *from = *a;
            }
            let begun = curve.lambda;
            if self.stretch(system, stages, reach) {
                // Its only place at λ = 0 is the first: below that, it is another curve.
                if self.curve.lambda < 0.0 {
                    return false;
                }
                if self.curve.lambda < 1.0 {
                    reach = (FACTORS.0 * reach).min(longest);
                    continue;
                }
                // Where the chord passes λ = 1 the end is near.
                let part = (1.0 - begun) / (self.curve.lambda - begun);
                let rows = self.a.iter_mut().flat_map(V::components_mut);
                for (a, from) in rows.zip(&self.curve.from) {
                    *a = from + part * (*a - from);
                }
                if self.iterate(system, stages) {
                    return true;
                }
            }
            let rows = self.a.iter_mut().flat_map(V::components_mut);
            for (a, from) in rows.zip(&self.curve.from) {
                *a = *from;
            }
            self.curve.lambda = begun;
            reach *= FACTORS.1;
            if reach < SHORTEST {
                return false;
            }
        }
        false
    }

    /// Turns the tangent to the curve at the present place, onwards.
    fn aim(&mut self, system: &impl System<Vector = V>, stages: &Stages<S>) {
        self.look(system, stages);
        let Curve { scale, side, tangent, tangent_lambda, .. } = &mut self.curve;
        let along = dot(side, tangent) / (*scale * *scale) + *tangent_lambda;
        let length = (dot(side, side) / (*scale * *scale) + 1.0).sqrt().copysign(along);
        for (tangent, side) in tangent.iter_mut().zip(side) {
            *tangent = *side / length;
        }
        *tangent_lambda = 1.0 / length;
    }

    /// Goes on by `reach` along the tangent and from there across it back to the curve; returns whether it
    /// got there.
    fn stretch(
        &mut self,
        system: &impl System<Vector = V>,
        stages: &Stages<S>,
        reach: f64,
    ) -> bool {
        let Self { a, curve, .. } = self;
        let rows = a.iter_mut().flat_map(V::components_mut);
        for (a, tangent) in rows.zip(&curve.tangent) {
            *a += reach * tangent;
        }
        curve.lambda += reach * curve.tangent_lambda;
        let mut last = f64::INFINITY;
        for _ in 0..MOST_CORRECTIONS {
            self.look(system, stages);
            self.subtract();
            self.matrix.solve(&mut self.missing);
            let Self { a, missing, curve, .. } = self;
            let Curve { lambda, scale, side, tangent, tangent_lambda, .. } = curve;
            let unit = *scale * *scale;
            let across = dot(tangent, side) / unit + *tangent_lambda;
            let more = -dot(tangent, missing) / unit / across;
            let mut size = more.abs();
            let rows = a.iter_mut().flat_map(V::components_mut).zip(missing.iter()).zip(side);
            for ((a, missing), side) in rows {
                let correction = missing + more * *side;
                *a += correction;
                size = size.max(correction.abs() / *scale);
            }
            *lambda += more;
            // Written so that a NaN is no way on. Longer than the stretch, it leads to another curve.
            if !(size < last && size <= reach) {
                return false;
            }
            if size <= CORRECTED {
                return true;
            }
            last = size;
        }
        false
    }

    /// Writes the force and the matrix at the present place, and how the solution moves with λ.
    fn look(&mut self, system: &impl System<Vector = V>, stages: &Stages<S>) {
        let lambda = self.curve.lambda;
        let here = stages.scaled(lambda);
        {
            let Self { known, a, found, stage, .. } = self;
            here.evaluate(system, known, a, stage, found);
        }
        self.linearise(system, &here, stages);
        let Self { known, a, found, nudged, stage, curve, matrix, .. } = self;
        curve.scale = curve.scale.max(largest(components(found)));
        stages.scaled(lambda + NUDGE).evaluate(system, known, a, stage, nudged);
        let rows = components(nudged).zip(components(found));
        for (side, (nudged, found)) in curve.side.iter_mut().zip(rows) {
            *side = (nudged - found) / NUDGE;
        }
        matrix.solve(&mut curve.side);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
