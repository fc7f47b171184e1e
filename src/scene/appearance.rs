//! The data that a picture of a body needs besides the body's state: its author's drawing, and the range of its first
//! seconds.

use std::any::Any;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use glam::DVec2;

use super::outline::Mark;
use crate::sim::bodies::{Body, Custom, Kind, Law, Net, NetPlan};
use crate::sim::integrators::{Integrator, SemiImplicitEuler, method};
use crate::sim::{Solver, stepper};
use node_lines::lines;

mod node_lines;

pub(super) use node_lines::NodeLine;

/// Draws a system at these coordinates. The author of the drawing knows the system's type.
pub type Drawing = dyn Fn(&dyn Any, &[f64]) -> Vec<Mark> + Send + Sync;

/// The drawing of a scene's body. By default a body has the usual look of its kind.
#[derive(Default)]
pub struct Appearance {
    /// The drawing by a custom body's author; `None` for the usual look.
    pub drawing: Option<Box<Drawing>>,
    /// The last computed preview, with the parameter values that it belongs to.
    preview: Mutex<Option<(Vec<f64>, Arc<Preview>)>>,
}

impl fmt::Debug for Appearance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Appearance")
    }
}

/// The range of a body's motion in its first seconds, found by a short simulation.
#[derive(Debug)]
pub struct Preview {
    /// Smallest and largest value of each coordinate; empty for a net.
    pub ranges: Vec<(f64, f64)>,
    /// Index of the coordinate that moves farthest.
    pub farthest: usize,
    /// Lower left and upper right corner of the rectangle around the nodes of a net, or around the places of a law.
    pub corners: [DVec2; 2],
    /// The springs of a net; empty for other bodies.
    pub springs: Springs,
}

/// The springs of a net, as drawn.
#[derive(Debug, Default)]
pub struct Springs {
    /// Lines through the nodes.
    pub lines: Vec<NodeLine>,
    /// Places of the fixed nodes.
    pub fixed: Vec<DVec2>,
    /// Length of the shortest spring at the start, in metres.
    pub shortest: f64,
}

/// Relative difference by which a range must be larger to count as wider, because mirrored nodes differ by rounding.
const FARTHER: f64 = 1e-6;

impl Appearance {
    /// Creates the appearance of a custom body, with its author's drawing if there is one.
    pub(crate) fn drawn(drawing: Option<Box<Drawing>>) -> Self {
        Self { drawing, preview: Mutex::default() }
    }

    /// Returns the preview of a body of this `kind` from its start, with its present parameters. A net keeps the
    /// preview of its first parameters, so that the stage stays still while a person edits them.
    ///
    /// # Panics
    /// If the kind is in the table of bodies.
    pub fn preview(&self, kind: &Kind, body: &dyn Any) -> Arc<Preview> {
        let (law, custom) = (body.downcast_ref::<Law>(), body.downcast_ref::<Custom>());
        let values = law.map(Law::values).or(custom.map(Custom::values)).unwrap_or_default();
        // The lock is free during the simulation, because a large net waits for other threads, which may want a preview
        // too.
        let last = || self.preview.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, preview)) = last().as_ref().filter(|(of, _)| of == values) {
            return preview.clone();
        }
        let net = body.downcast_ref::<Net>().zip(kind.net());
        let preview = Arc::new(match (law, custom, net) {
            (Some(law), ..) => Preview::of(law, |q| law.places(q)),
            (_, Some(custom), _) => Preview::of(custom, |_| Vec::new()),
            (.., Some((net, plan))) => Preview::of_net(net, plan),
            _ => panic!("a body of the table is drawn by its parameters alone"),
        });
        *last() = Some((values.to_vec(), preview.clone()));
        preview
    }
}

impl Preview {
    /// Returns the index of the coordinate with the widest range.
    fn widest(&self) -> usize {
        let far = |index: usize| self.ranges[index].1 - self.ranges[index].0;
        let farther =
            |best, next| if far(next) > (1.0 + FARTHER) * far(best) { next } else { best };
        (0..self.ranges.len()).fold(0, farther)
    }

    /// Creates a preview that covers no moment yet.
    fn new(coordinates: usize) -> Self {
        Self {
            ranges: vec![(f64::INFINITY, f64::NEG_INFINITY); coordinates],
            farthest: 0,
            corners: [DVec2::INFINITY, DVec2::NEG_INFINITY],
            springs: Springs::default(),
        }
    }

    /// Adds the coordinates of a moment, and the places of the nodes or of the law at that moment.
    fn add_moment(&mut self, q: &[f64], places: impl IntoIterator<Item = DVec2>) {
        for ((low, high), &q) in self.ranges.iter_mut().zip(q) {
            (*low, *high) = (low.min(q), high.max(q));
        }
        let hold = |[low, high]: [DVec2; 2], place| [low.min(place), high.max(place)];
        self.corners = places.into_iter().fold(self.corners, hold);
    }

    /// Creates the preview of a net.
    fn of_net(net: &Net, plan: &NetPlan) -> Self {
        let fixed: Vec<DVec2> = plan.fixed_places().map(DVec2::from).collect();
        let mut state = net.start();
        let mut preview = Self::new(state.q.len());
        let h = NET_STEP / net.fastest_rate();
        let steps = (NET_S / h).min(MAX_SPRINGS / net.springs() as f64) as u64;
        let mut solver = <SemiImplicitEuler<Vec<f64>> as Integrator<Net>>::new(&state.q);
        for step in 0..=steps {
            let free = Net::nodes(&state.q).iter().map(|&node| DVec2::from(node));
            preview.add_moment(&state.q, free.chain(fixed.iter().copied()));
            if solver.step(net, step as f64 * h, h, &mut state).is_err() {
                break;
            }
        }
        let springs = Springs { lines: lines(plan), fixed, shortest: net.shortest_spring() };
        Self { springs, farthest: preview.widest(), ranges: Vec::new(), ..preview }
    }

    /// Returns the preview of a body with these `places` for its coordinates. The body is followed until it runs away.
    fn of<B: Body<Vector = Vec<f64>>>(body: &B, places: impl Fn(&[f64]) -> Vec<DVec2>) -> Self {
        let method = method("dormand-prince-54").expect("a method of the table");
        let mut stepper = stepper(body.clone(), Solver::Method(method));
        let mut preview = Self::new(stepper.q().len());
        preview.add_moment(stepper.q(), places(stepper.q()));
        let mut near = vec![f64::INFINITY; stepper.q().len()];
        for tick in 0..TICKS {
            let stepped = stepper.advance(f64::from(tick) * TICK_S, TICK_S, 1);
            let is_near = |(q, most): (&f64, &f64)| q.is_finite() && q.abs() <= *most;
            if stepped.is_err()
                || stepper.evaluations() > MAX_EVALUATIONS
                || !stepper.q().iter().zip(&near).all(is_near)
            {
                break;
            }
            preview.add_moment(stepper.q(), places(stepper.q()));
            if tick == 60 {
                let most = |(low, high): &(f64, f64)| RUNAWAY * low.abs().max(high.abs()).max(1e-9);
                near = preview.ranges.iter().map(most).collect();
            }
        }
        preview.farthest = preview.widest();
        preview
    }
}

/// Length of the simulation of a net, in seconds, which is long enough for a hanging cloth to fall and swing back.
const NET_S: f64 = 4.0;

/// Maximum number of evaluations of a net's springs, which take some tens of milliseconds in an unoptimised build.
const MAX_SPRINGS: f64 = 3e6;

/// Longest step of a net's simulation, multiplied by the net's fastest rate. It is less than half the stability limit
/// of semi-implicit Euler.
const NET_STEP: f64 = 0.5;

/// Length of the simulation of any other body, in ticks, and length of a tick in seconds. People look about as long
/// before they judge.
const TICKS: u32 = 1200;
const TICK_S: f64 = 1.0 / 60.0;

/// Maximum number of evaluations in the simulation of any other body, which take a few milliseconds.
const MAX_EVALUATIONS: u64 = 30_000;

/// A coordinate has run away if it exceeds its largest magnitude in the first second by this factor.
const RUNAWAY: f64 = 1e4;
