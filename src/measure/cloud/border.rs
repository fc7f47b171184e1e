//! The border of a cloud, which is closed lines of points, and the area inside.

use super::course::{Course, Memory, Subject, copies_of};
use super::{CloudBody, CloudStart, NoCloud};
use crate::sim::batch::Ticks;
use crate::sim::integrators::{Override, method};
use crate::sim::{Solver, TickRate};

/// Number of points of a border, and the minimum for a cloud with few points.
const POINTS: usize = 1200;
const MIN_POINTS: usize = 90;

/// Tolerance of the exact border, far below a pixel.
const TOLERANCE: f64 = 1e-9;

/// The area is unknown if every other point encloses an area that differs by more than this fraction. In this case, the
/// shape is finer than the points or the method's tolerance can resolve. The error is about a third of the difference.
const ROUGH: f64 = 5e-3;

/// The border of a cloud, and the area inside.
pub struct CloudBorder {
    course: Course,
    /// Number of points in each line.
    lengths: Vec<usize>,
    start: CloudStart,
    areas_at_start: [f64; 2],
}

impl CloudBorder {
    /// Creates the border of an exactly moving cloud, at the start. A method of high order steps the border with a
    /// tolerance below any picture's resolution.
    ///
    /// # Errors
    /// Fails as [`Cloud::new`](super::Cloud::new) does.
    pub fn exact(
        of: CloudBody<'_>,
        start: CloudStart,
        tick_hz: impl Into<TickRate>,
    ) -> Result<Self, NoCloud> {
        Self::exact_of_points(POINTS, of, start, tick_hz.into())
    }

    pub(super) fn exact_of_points(
        points: usize,
        of: CloudBody<'_>,
        start: CloudStart,
        tick_hz: TickRate,
    ) -> Result<Self, NoCloud> {
        let method = method("dormand-prince-54").expect("a method of the table");
        let solver = (Solver::With(method, Override::tolerance(TOLERANCE)), Memory::Dropped);
        let copies = copies_of(of);
        Self::new(Subject::new(of.name, &copies), solver, start.ticks(tick_hz, 1), start, points)
    }

    /// Creates the border of a cloud under a solver, at the start, with about `points` points.
    pub(super) fn new(
        subject: Subject<'_>,
        solver: (Solver, Memory),
        ticks: Ticks,
        start: CloudStart,
        points: usize,
    ) -> Result<Self, NoCloud> {
        let points = points.clamp(MIN_POINTS, POINTS);
        let borders = start.shape.borders(points);
        let lengths = borders.iter().map(Vec::len).collect();
        let starts = || borders.concat().into_iter().map(|point| start.state(point)).collect();
        let course = Course::new(subject, solver, ticks, points, starts)?;
        let mut border = Self { course, lengths, start, areas_at_start: [1.0; 2] };
        border.areas_at_start = border.areas();
        Ok(border)
    }

    /// Returns the same border, which from now on stores states so that it can go back.
    pub fn rewindable(self) -> Self {
        Self { course: self.course.rewindable(), ..self }
    }

    /// Steps to a tick, like [`Cloud::go_to`](super::Cloud::go_to).
    pub fn go_to(&mut self, tick: u64) {
        self.course.go_to(tick);
    }

    /// Returns the area relative to the start; `None` if unknown.
    pub fn area_ratio(&self) -> Option<f64> {
        let (now, at_start) = (self.areas(), self.areas_at_start);
        let [ratio, of_half] = [0, 1].map(|i| now[i] / at_start[i]);
        ((ratio - of_half).abs() <= ROUGH * ratio).then_some(ratio)
    }

    /// Returns the lines, as coordinates and velocities. The first line surrounds the cloud, and the others surround
    /// the cloud's holes.
    pub fn lines(&self) -> Vec<Vec<[f64; 2]>> {
        let mut states = self.course.q().iter().zip(self.course.v()).map(|(&q, &v)| [q, v]);
        self.lengths.iter().map(|&length| states.by_ref().take(length).collect()).collect()
    }

    /// Returns the area inside all points, and the area inside every other point.
    fn areas(&self) -> [f64; 2] {
        [1, 2].map(|every| self.area(every))
    }

    fn area(&self, every: usize) -> f64 {
        let reach = self.start.reach;
        let around = |line: Vec<[f64; 2]>| {
            // Points are taken relative to the first one, so that a small area far from the origin keeps its digits.
            let from_first = |to: &[f64; 2]| [0, 1].map(|i| (to[i] - line[0][i]) / reach[i]);
            let points: Vec<_> = line.iter().step_by(every).map(from_first).collect();
            let twice =
                points.windows(2).map(|ends| ends[0][0] * ends[1][1] - ends[1][0] * ends[0][1]);
            twice.sum::<f64>().abs() / 2.0
        };
        let mut areas = self.lines().into_iter().map(around);
        let whole = areas.next().unwrap_or(0.0);
        areas.fold(whole, |area, hole| area - hole)
    }
}
