//! Copies of a body that turns in space, each from its own direction of L.

use std::any::Any;
use std::ops::Range;

use glam::DVec3;

use super::Tumble;
use crate::batch::{Advance, Batch, Chunks, InstructionSet, NewBatch, Ticks};
use crate::body_stepper::stepper;
use crate::state::State;
use crate::stepper::{Solver, Stepper};

impl Tumble {
    /// Returns the principal axis from which true motions of the body's start stay farther away, of the axes of the
    /// least and of the greatest moment.
    fn polar_axis(&self) -> usize {
        let [least, middle, greatest] = self.axes_by_moment();
        let place = (self.moments * self.spin).normalize_or_zero();
        let inverse = self.moments.recip();
        let slopes = [inverse[least] - inverse[middle], inverse[middle] - inverse[greatest]];
        if slopes == [0.0; 2] {
            return place.abs().min_position();
        }
        let [x, z] = [least, greatest].map(|axis| place[axis] * place[axis]);
        let level = slopes[0] * x - slopes[1] * z;
        if 2.0 * level < slopes[0] - slopes[1] { least } else { greatest }
    }

    /// Returns the direction of L from the body at these velocities, in the coordinates of Serret and Andoyer: its
    /// angle about an axis in radians, and the part of L along that axis. Equal areas are equal parts of the sphere.
    pub fn direction(&self, v: &[f64]) -> [f64; 2] {
        let axis = self.polar_axis();
        let momentum = self.momentum_in_body(v);
        let angle = libm::atan2(momentum[(axis + 2) % 3], momentum[(axis + 1) % 3]);
        [angle, momentum[axis] / momentum.length()]
    }

    /// Returns the vector of this length in a [direction](Self::direction).
    fn along(&self, [angle, part]: [f64; 2], length: f64) -> DVec3 {
        let axis = self.polar_axis();
        let across = (1.0 - part * part).sqrt();
        let (sin, cos) = libm::sincos(angle);
        let mut vector = DVec3::ZERO;
        vector[axis] = part;
        vector[(axis + 1) % 3] = across * cos;
        vector[(axis + 2) % 3] = across * sin;
        vector * length
    }
}

/// Number of copies that a thread handles at a time.
const GRAIN: usize = 16;

/// Returns a batch of copies of a body that turns in space, whose starts are [directions](Tumble::direction) of the L
/// that the body has at its start.
pub(super) fn batch(
    body: &dyn Any,
    _set: InstructionSet,
    solver: Solver,
    starts: Vec<State<f64>>,
) -> Option<NewBatch> {
    let body: &Tumble = body.downcast_ref()?;
    solver.method()?;
    let part = |part: Range<usize>| {
        let copies =
            part.map(|_| Copy { stepper: stepper(body.clone(), solver), at: [f64::NAN; 2] });
        Box::new(Copies { body: body.clone(), copies: copies.collect() }) as _
    };
    let advance = |count, _| Box::new(Chunks::new(GRAIN, count, part)) as _;
    Some(Batch::of(starts.into_iter(), advance))
}

/// A copy, and the direction to which it was stepped.
struct Copy {
    stepper: Box<dyn Stepper>,
    at: [f64; 2],
}

struct Copies {
    body: Tumble,
    copies: Vec<Copy>,
}

impl Copies {
    fn step(body: &Tumble, copy: &mut Copy, ticks: Ticks, to: [f64; 2]) -> Option<[f64; 2]> {
        let stepper = &mut *copy.stepper;
        if copy.at != to {
            let (q, mut v) = (stepper.q().to_vec(), stepper.v().to_vec());
            let length = body.momentum_in_body(&v).length();
            let omega = body.along(to, length) / body.moments;
            v[..3].copy_from_slice(&omega.to_array());
            stepper.set(ticks.t(ticks.first), &q, &v);
        }
        for tick in ticks.first..ticks.first + ticks.count {
            stepper.advance(ticks.t(tick), ticks.h(), ticks.substeps).ok()?;
        }
        let [angle, part] = body.direction(stepper.v());
        // The angle goes on where it was, so that near directions have near angles.
        let turn = std::f64::consts::TAU;
        copy.at = [angle + turn * ((to[0] - angle) / turn).round(), part];
        copy.at.iter().all(|number| number.is_finite()).then_some(copy.at)
    }
}

impl Advance for Copies {
    fn advance(&mut self, ticks: Ticks, q: &mut [f64], v: &mut [f64]) {
        let Self { body, copies } = self;
        for ((q, v), copy) in q.iter_mut().zip(v).zip(copies) {
            if q.is_finite() && v.is_finite() {
                let stepped = Self::step(body, copy, ticks, [*q, *v]);
                [*q, *v] = stepped.unwrap_or([f64::NAN; 2]);
            }
        }
    }

    fn reset(&mut self) {
        for copy in &mut self.copies {
            copy.at = [f64::NAN; 2];
        }
    }
}
