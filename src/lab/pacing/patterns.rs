//! The table of built-in traces.

use super::time_base::RefreshRate;
use super::trace::FrameTrace;
use steady::Steady;

mod steady;

/// A built-in trace.
#[derive(Debug)]
pub struct TraceCard {
    /// Its name on the command line, `kebab-case`.
    pub id: &'static str,
    /// What happens in it, in one line.
    pub about: &'static str,
    /// The rate of its display; `None` where any display will do, 60 Hz unless one is chosen.
    pub refresh: Option<RefreshRate>,
    build: fn(&'static str, RefreshRate) -> FrameTrace,
}

impl TraceCard {
    /// The trace on its own display, or else on one of this rate.
    pub fn trace(&self, refresh: RefreshRate) -> FrameTrace {
        (self.build)(self.id, self.refresh.unwrap_or(refresh))
    }
}

const fn steady(id: &'static str, numerator: u32, denominator: u32) -> TraceCard {
    TraceCard {
        id,
        about: "every frame begins and is displayed at a refresh",
        refresh: Some(RefreshRate::new(numerator, denominator)),
        build: |id, refresh| FrameTrace::of_pattern(id, refresh, Steady::new(refresh)),
    }
}

/// Every built-in trace.
pub static TRACES: &[TraceCard] = &[
    steady("steady-60", 60, 1),
    steady("steady-59.94", 2997, 50),
    steady("steady-75", 75, 1),
    steady("steady-120", 120, 1),
    steady("steady-144", 144, 1),
    steady("steady-240", 240, 1),
];

/// The built-in trace with this id.
pub fn trace_card(id: &str) -> Option<&'static TraceCard> {
    TRACES.iter().find(|card| card.id == id)
}

/// An even display of any rate, by the name `steady-` and the rate.
pub fn steady_trace(refresh: RefreshRate) -> FrameTrace {
    FrameTrace::of_pattern(format!("steady-{refresh}"), refresh, Steady::new(refresh))
}
