//! The built-in traces and the patterns of their frames.

use super::time_base::RefreshRate;
use super::trace::{Frame, FrameTrace, Pattern};

#[cfg(test)]
mod tests;

/// A built-in trace.
#[derive(Debug)]
pub struct TraceCard {
    /// Name of the trace on the command line, `kebab-case`.
    pub id: &'static str,
    /// Description of the trace in one line.
    pub about: &'static str,
    /// Refresh rate of the trace's display; `None` if any display will do, by default one of 60 Hz.
    pub refresh: Option<RefreshRate>,
    build: fn(&'static str, RefreshRate) -> FrameTrace,
}

impl TraceCard {
    /// Returns the trace on its own display or, if it has none, on a display with this rate.
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
    TraceCard {
        id: "edge",
        about: "every frame begins at a refresh ± at most 0.5 ms (seed 4), the first exactly; displayed at the refresh",
        refresh: None,
        build: |id, refresh| FrameTrace::of_pattern(id, refresh, Edge::new(refresh)),
    },
    TraceCard {
        id: "missed-vsync",
        about: "after every 29 frames of one refresh, one of two: its picture is a refresh late, and so is the next frame",
        refresh: None,
        build: |id, refresh| FrameTrace::of_pattern(id, refresh, LongFrame::new(refresh, 29, 2)),
    },
    TraceCard {
        id: "heartbeat",
        about: "frames last 5/4 and 3/4 of a refresh alternately, and are displayed at every refresh (A. Ladavac)",
        refresh: None,
        build: |id, refresh| FrameTrace::of_pattern(id, refresh, Heartbeat::new(refresh)),
    },
    TraceCard {
        id: "hitch-100ms",
        about: "after every 2 s of frames of one refresh, one of 100 ms",
        refresh: None,
        build: |id, refresh| {
            let pattern = LongFrame::lasting(refresh, 2_000_000_000, 100_000_000);
            FrameTrace::of_pattern(id, refresh, pattern)
        },
    },
    TraceCard {
        id: "alt-tab-5s",
        about: "after every 5 s of frames of one refresh, one of 5 s, as when a person looks at another window",
        refresh: None,
        build: |id, refresh| {
            let pattern = LongFrame::lasting(refresh, 5_000_000_000, 5_000_000_000);
            FrameTrace::of_pattern(id, refresh, pattern)
        },
    },
    TraceCard {
        id: "spiral",
        about: "a step costs 20.8 ms: a frame lasts as long as the steps of the one before, at least a refresh",
        refresh: None,
        build: |id, refresh| FrameTrace::of_pattern(id, refresh, Spiral::new(refresh)),
    },
    TraceCard {
        id: "jitter",
        about: "frames take 0.5 to 1.1 refreshes, one in 64 up to 2 more (seed 9); displayed at the next free refresh",
        refresh: None,
        build: |id, refresh| FrameTrace::of_pattern(id, refresh, Jitter::new(refresh)),
    },
];

/// Returns the built-in trace with this id.
pub fn trace_card(id: &str) -> Option<&'static TraceCard> {
    TRACES.iter().find(|card| card.id == id)
}

/// Returns the trace named `steady-` plus the rate, which is an even display of any rate.
pub fn steady_trace(refresh: RefreshRate) -> FrameTrace {
    // A rate has at most six decimals.
    let hz = (refresh.hz() * 1e6).round() / 1e6;
    FrameTrace::of_pattern(format!("steady-{hz}"), refresh, Steady::new(refresh))
}

/// Returns the trace named `fps-`, the frame rate, `-on-` and the refresh rate, which has even frames at one rate on an
/// even display of another. A frame is displayed at the first refresh after it begins, unless the next frame reaches
/// the same refresh.
pub fn frames_on_display(fps: RefreshRate, refresh: RefreshRate) -> FrameTrace {
    let name = format!("fps-{fps}-on-{refresh}");
    FrameTrace::of_pattern(name, refresh, OtherRate { fps, refresh, next: 0, shown_at: 0 })
}

/// Even frames on an even display of another rate.
#[derive(Clone, Copy)]
struct OtherRate {
    fps: RefreshRate,
    refresh: RefreshRate,
    next: u64,
    /// First refresh that could show the last frame.
    shown_at: u64,
}

impl OtherRate {
    /// Returns the first refresh at or after the start of this frame. The search begins at `from`, which must not be
    /// later than that refresh.
    fn refresh_of(&self, frame: u64, from: u64) -> u64 {
        let began_ns = self.fps.refresh_ns(frame);
        (from..).find(|n| self.refresh.refresh_ns(*n) >= began_ns).expect("refreshes have no end")
    }
}

impl Pattern for OtherRate {
    fn next(&mut self, _steps: u32) -> Frame {
        self.shown_at = self.refresh_of(self.next, self.shown_at);
        let following = self.refresh_of(self.next + 1, self.shown_at);
        let began_ns = self.fps.refresh_ns(self.next);
        self.next += 1;
        let is_shown = following != self.shown_at;
        Frame { began_ns, displayed_ns: is_shown.then(|| self.refresh.refresh_ns(self.shown_at)) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}

/// An even display and a game that is always ready, so that every frame begins and is displayed at a refresh.
#[derive(Clone, Copy)]
struct Steady {
    refresh: RefreshRate,
    next: u64,
}

impl Steady {
    fn new(refresh: RefreshRate) -> Self {
        Self { refresh, next: 0 }
    }
}

impl Pattern for Steady {
    fn next(&mut self, _steps: u32) -> Frame {
        let at = self.refresh.refresh_ns(self.next);
        self.next += 1;
        Frame { began_ns: at, displayed_ns: Some(at) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}

/// Seed of the noise of [`Edge`]. The mean of this noise is near 0, so that it adds no latency.
const EDGE_SEED: u64 = 4;

/// Largest shift of a frame's beginning, in nanoseconds, as when a sleeping thread wakes early or late. It is below
/// half the shortest refresh, which is 1 ms, so that each frame begins after the one before.
const EDGE_NS: i64 = 499_999;

/// Frames that begin a little before or after the edge of a tick.
///
/// Frame n begins at refresh n plus noise; only the first frame has no noise. It is displayed at refresh n, even if it
/// begins later, so that the mean latency is that of the loop alone.
#[derive(Clone, Copy)]
struct Edge {
    refresh: RefreshRate,
    next: u64,
    noise: Noise,
}

impl Edge {
    fn new(refresh: RefreshRate) -> Self {
        Self { refresh, next: 0, noise: Noise::new(EDGE_SEED) }
    }
}

impl Pattern for Edge {
    fn next(&mut self, _steps: u32) -> Frame {
        let at = self.refresh.refresh_ns(self.next);
        let off = if self.next == 0 { 0 } else { self.noise.up_to(2 * EDGE_NS) - EDGE_NS };
        self.next += 1;
        Frame { began_ns: at + off, displayed_ns: Some(at) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}

/// Frames of one refresh each, and now and then a long frame.
///
/// After every `short` frames of one refresh follows one frame of `long` refreshes. Its picture is displayed at the
/// last of them, and the next frame begins after it. So the display sees the long time one frame before the game does.
#[derive(Clone, Copy)]
struct LongFrame {
    refresh: RefreshRate,
    /// Number of short frames before a long one.
    short: u64,
    /// Duration of a long frame in refreshes, at least 1.
    long: u64,
    /// Refresh at which the next frame begins.
    at: u64,
    /// Number of frames since the last long one.
    since: u64,
}

impl LongFrame {
    /// Creates a pattern with a frame of `long` refreshes after every `short` frames of one refresh.
    fn new(refresh: RefreshRate, short: u64, long: u64) -> Self {
        Self { refresh, short, long, at: 0, since: 0 }
    }

    /// Creates a pattern with a frame of `long_ns` after every `short_ns`, both rounded up to whole refreshes.
    fn lasting(refresh: RefreshRate, short_ns: i64, long_ns: i64) -> Self {
        let refreshes = |ns| (1..).find(|&n| refresh.refresh_ns(n) >= ns).expect("no end");
        Self::new(refresh, refreshes(short_ns), refreshes(long_ns))
    }
}

impl Pattern for LongFrame {
    fn next(&mut self, _steps: u32) -> Frame {
        let lasts = if self.since == self.short { self.long } else { 1 };
        self.since = if self.since == self.short { 0 } else { self.since + 1 };
        let began = self.at;
        self.at += lasts;
        Frame {
            began_ns: self.refresh.refresh_ns(began),
            displayed_ns: Some(self.refresh.refresh_ns(began + lasts - 1)),
        }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}

/// A game that reads its clock unevenly while its pictures are displayed evenly.
///
/// Every second frame begins a quarter of a refresh late, so that durations alternate between 5/4 and 3/4 of a refresh.
/// Frame n is displayed at refresh n, even if it begins later. As with the steady traces, the latency is that of the
/// loop alone.
#[derive(Clone, Copy)]
struct Heartbeat {
    refresh: RefreshRate,
    next: u64,
}

impl Heartbeat {
    fn new(refresh: RefreshRate) -> Self {
        Self { refresh, next: 0 }
    }
}

impl Pattern for Heartbeat {
    fn next(&mut self, _steps: u32) -> Frame {
        let at = self.refresh.refresh_ns(self.next);
        let late = if self.next.is_multiple_of(2) { 0 } else { self.refresh.refresh_ns(1) / 4 };
        self.next += 1;
        Frame { began_ns: at + late, displayed_ns: Some(at) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}

/// Cost of a step in nanoseconds: 5/4 of a tick at 60 Hz.
const STEP_NS: i64 = 20_800_000;

/// Steps that cost more time than they simulate: the spiral of death.
///
/// A frame lasts a refresh, or as long as its steps take if that is longer. It is displayed when it begins, because its
/// cost is not yet known at that time.
#[derive(Clone, Copy)]
struct Spiral {
    refresh: RefreshRate,
    /// End of the last frame that took too long.
    since_ns: i64,
    /// Number of refreshes since `since_ns`.
    refreshes: u64,
    begun: bool,
}

impl Spiral {
    fn new(refresh: RefreshRate) -> Self {
        Self { refresh, since_ns: 0, refreshes: 0, begun: false }
    }

    fn now_ns(&self) -> i64 {
        self.since_ns + self.refresh.refresh_ns(self.refreshes)
    }
}

impl Pattern for Spiral {
    fn next(&mut self, steps: u32) -> Frame {
        let cost = STEP_NS * i64::from(steps);
        if self.begun && cost > self.refresh.refresh_ns(1) {
            (self.since_ns, self.refreshes) = (self.now_ns() + cost, 0);
        } else if self.begun {
            self.refreshes += 1;
        }
        self.begun = true;
        let now = self.now_ns();
        Frame { began_ns: now, displayed_ns: Some(now) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}

/// Seed of the noise of [`Jitter`].
const JITTER_SEED: u64 = 9;

/// Mean number of frames per slow frame.
const SLOW_IN: i64 = 64;

/// A game with uneven frame times whose pictures wait for the display in a queue.
///
/// Frames take 0.5 to 1.1 refreshes, and a slow one up to 2 more. A picture is displayed at the first refresh at which
/// it is ready and no earlier picture waits. The game runs ahead by one waiting picture, so that the latency is two
/// refreshes if no frame is slow.
#[derive(Clone, Copy)]
struct Jitter {
    refresh: RefreshRate,
    began_ns: i64,
    /// Refresh at which the last picture was displayed.
    shown: u64,
    noise: Noise,
}

impl Jitter {
    fn new(refresh: RefreshRate) -> Self {
        Self { refresh, began_ns: 0, shown: 0, noise: Noise::new(JITTER_SEED) }
    }

    fn work_ns(&mut self) -> i64 {
        let period = self.refresh.refresh_ns(1);
        let part = 3 * period / 10;
        let usual = period / 2 + self.noise.up_to(part) + self.noise.up_to(part);
        let slow = self.noise.up_to(SLOW_IN - 1) == 0;
        usual + if slow { self.noise.up_to(2 * period) } else { 0 }
    }
}

impl Pattern for Jitter {
    fn next(&mut self, _steps: u32) -> Frame {
        let began_ns = self.began_ns;
        let ready = began_ns + self.work_ns();
        let before = self.shown;
        self.shown += 1;
        while self.refresh.refresh_ns(self.shown) < ready {
            self.shown += 1;
        }
        // The slot in the queue is free again as soon as the previous picture is displayed.
        self.began_ns = ready.max(self.refresh.refresh_ns(before));
        Frame { began_ns, displayed_ns: Some(self.refresh.refresh_ns(self.shown)) }
    }

    fn boxed_clone(&self) -> Box<dyn Pattern> {
        Box::new(*self)
    }
}

/// Generates whole numbers that are the same on every platform, by Sebastiano Vigna's SplitMix64.
#[derive(Clone, Copy)]
struct Noise(u64);

impl Noise {
    const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns a uniformly distributed number from 0 to `most`, which must not be negative.
    fn up_to(&mut self, most: i64) -> i64 {
        let many = u128::from(most.unsigned_abs()) + 1;
        // The high half of the product lies in 0..many. This needs no division, and its bias is below 2⁻⁶⁴ · many.
        ((u128::from(self.bits()) * many) >> 64) as i64
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }
}
