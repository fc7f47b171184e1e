//! The truth of one body at the ticks of one rate, and the inputs that come at its ticks.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};

use super::BodyTruth;
use crate::lab::analysis::survey::TimedInput;
use crate::lab::lane::check;
use crate::sim::integrators::StepFailure;
use crate::sim::{Solver, Stepper};

/// Products that the exact flow takes at the ticks of a course, at most: less than a second's work, and memory for it.
const MOST_COURSE_PRODUCTS: u64 = 500_000_000;

/// Values of true courses that are kept, some ten megabytes: those of the rates last asked about.
const MOST_KEPT: usize = 1 << 20;

/// The courses that are kept, by their tick rate in Hz.
pub(in crate::lab::analysis) type Courses = Mutex<HashMap<u32, Arc<Course>>>;

/// The truth at the ticks of one rate.
pub(in crate::lab::analysis) struct Course {
    /// The components after each tick, tick after tick.
    values: Vec<f64>,
    components: usize,
    /// The most by which the truth may be off up to each tick, in amplitudes.
    gaps: Vec<f64>,
    pub(in crate::lab::analysis) failure: Option<StepFailure>,
    /// Whether it was not followed for the work that it would take.
    pub(in crate::lab::analysis) is_too_much: bool,
}

impl Course {
    /// The components after `tick` ticks, from 1; `None` where the truth is not known any more.
    pub(in crate::lab::analysis) fn at(&self, tick: u64) -> Option<&[f64]> {
        let from = (tick as usize - 1) * self.components;
        self.values.get(from..from + self.components)
    }

    /// The most by which the truth may be off up to `tick` ticks, in amplitudes.
    pub(in crate::lab::analysis) fn gap(&self, tick: u64) -> f64 {
        self.gaps.get(tick as usize - 1).copied().unwrap_or(f64::INFINITY)
    }
}

impl BodyTruth {
    /// Gives `stepper`, which stands after `tick` ticks of this rate, the inputs that come then.
    pub(in crate::lab::analysis) fn give_inputs(
        &self,
        stepper: &mut dyn Stepper,
        tick: u64,
        tick_hz: u32,
    ) {
        let hz = f64::from(tick_hz);
        let due = |input: &&TimedInput| (input.t * hz - ON_TIME).ceil().max(0.0) as u64 == tick;
        for TimedInput { given, .. } in self.inputs.iter().filter(due) {
            given.to(stepper, tick as f64 / hz);
        }
    }

    /// The most by which the truth may be off up to this moment, in amplitudes, as seen at the ticks of this rate.
    pub(in crate::lab::analysis) fn gap(&self, seconds: f64, tick_hz: u32) -> f64 {
        self.course(tick_hz).gap(ticks(seconds, tick_hz).max(1))
    }

    /// The truth at the ticks of this rate, up to the horizon.
    pub(in crate::lab::analysis) fn course(&self, tick_hz: u32) -> Arc<Course> {
        let kept = |courses: &HashMap<u32, Arc<Course>>| courses.get(&tick_hz).map(Arc::clone);
        if let Some(course) = kept(&self.courses.lock().expect("no thread panics with it")) {
            return course;
        }
        let course = Arc::new(self.follow(tick_hz));
        let mut courses = self.courses.lock().expect("no thread panics with it");
        let held: usize = courses.values().map(|course| course.values.len()).sum();
        if held + course.values.len() > MOST_KEPT {
            courses.clear();
        }
        courses.insert(tick_hz, Arc::clone(&course));
        course
    }

    fn follow(&self, tick_hz: u32) -> Course {
        let mut body = self.start(Solver::Truth);
        let (n, hz) = (body.q().len(), f64::from(tick_hz));
        let mut course = Course {
            values: Vec::new(),
            components: 2 * n,
            gaps: Vec::new(),
            failure: None,
            is_too_much: false,
        };
        let mut gap: f64 = 0.0;
        let ticks = ticks(self.horizon_s, tick_hz);
        if ticks.saturating_mul((n * n) as u64) > MOST_COURSE_PRODUCTS {
            course.is_too_much = true;
            return course;
        }
        for tick in 0..ticks {
            self.give_inputs(&mut *body, tick, tick_hz);
            let advanced = body.advance(tick as f64 / hz, 1.0 / hz, 1);
            if let Err(failure) = advanced.and_then(|()| check(&*body, self.coordinates())) {
                course.failure = Some(failure);
                break;
            }
            course.values.extend(body.q().iter().chain(body.v()));
            let off = body.truth_error().unwrap_or([0.0; 2]);
            for (i, amplitude) in self.amplitudes.iter().enumerate() {
                let part = off[i / n] / amplitude;
                gap = if part <= gap { gap } else { part };
            }
            course.gaps.push(gap);
        }
        course
    }
}

/// An input that comes less than this part of a tick after it is on time: the rounding of its moment.
const ON_TIME: f64 = 1e-6;

/// Whole ticks of this rate in a stretch: none ends beyond it.
pub(in crate::lab::analysis) fn ticks(seconds: f64, tick_hz: u32) -> u64 {
    (seconds * f64::from(tick_hz) + ON_TIME).floor() as u64
}
