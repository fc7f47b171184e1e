//! The table of policies, and the policies without a memory.

use super::policy::{Build, Policy, PolicyCard, Snippet, Steps};
use crate::run::race::Interpolation;
use fixed::{Fixed, SlowDown};
use hysteresis::Hysteresis;
use median::Median;
use snapped::Snapped;
use whole_refresh::WholeRefresh;

mod fixed;
mod hysteresis;
pub(super) mod lines;
mod median;
mod snapped;
mod whole_refresh;

/// Lists the snippets of a loop, one per language.
macro_rules! snippets {
    ($id:literal: $($language:literal $ending:literal),+) => {
        &[$(Snippet {
            language: $language,
            source: include_str!(concat!("../../assets/loops/", $id, ".", $ending)),
        }),+]
    };
}

/// One step of the frame's length. The cards of all other loops derive from this one.
pub(super) const VARIABLE: PolicyCard = PolicyCard {
    id: "variable",
    name: "Variable",
    formula: "one step of dt",
    constants: "",
    odd_frames: "no time: no step; 10 s: one step of 10 s",
    users: "LÖVE, and many small games",
    source: "LÖVE's love.run: update(dt)",
    drawing: Interpolation::Raw,
    has_render_tick: false,
    has_fixed_tick: false,
    needs_exact_clock: false,
    has_max_ticks: false,
    is_usual: false,
    snippets: snippets!("variable": "rust" "rs", "c++" "hpp", "c#" "cs"),
    build: Build::Rust(|_, _| Box::new(Variable { longest: None })),
    engine: None,
};

/// A fixed tick whose last state is shown. Policies that draw a fixed tick differently derive their cards from this
/// one.
const FIXED: PolicyCard = PolicyCard {
    id: "fixed",
    name: "Fixed",
    formula: "owed += dt; while owed ≥ H: tick, owed −= H; show the last tick",
    constants: "at most 250 ms of ticks a frame; the rest is dropped",
    odd_frames: "no time: no tick; 10 s: the ticks of 250 ms, the rest dropped",
    users: "Unity (50 Hz, frame at most 1/3 s), Bevy (64 Hz; cuts a frame to 250 ms before it counts), MonoGame (60 Hz, 500 ms), Godot (60 Hz, 8 ticks), Doom 3 BFG (50 ms)",
    source: "G. Fiedler, \"Fix Your Timestep!\", 2004",
    has_fixed_tick: true,
    has_max_ticks: true,
    snippets: snippets!("fixed": "rust" "rs", "c++" "hpp", "c#" "cs"),
    build: Build::Rust(|base, limits| Box::new(Fixed::new(base, limits))),
    ..VARIABLE
};

/// Every policy of a game loop, with the simplest first.
pub static POLICIES: &[PolicyCard] = &[
    PolicyCard { is_usual: true, ..VARIABLE },
    PolicyCard {
        id: "lockstep",
        name: "Lockstep",
        formula: "one tick a frame, however long it was",
        odd_frames: "any: one tick",
        users: "the samples of Box2D and Rapier",
        source: "Box2D's sample application",
        has_fixed_tick: true,
        snippets: snippets!("lockstep": "rust" "rs"),
        build: Build::Rust(|base, _| Box::new(Lockstep { tick: base.tick() })),
        ..VARIABLE
    },
    PolicyCard {
        id: "clamped-variable",
        name: "Clamped variable",
        formula: "one step of min(dt, longest)",
        constants: "longest step 1/30 s; the rest of a frame is dropped",
        odd_frames: "no time: no step; 10 s: one step of 1/30 s, the rest dropped",
        users: "bevy_rapier (TimestepMode::Variable), Unreal without substeps (1/30 s)",
        source: "Unreal's MaxPhysicsDeltaTime",
        snippets: snippets!("clamped-variable": "rust" "rs", "c++" "hpp", "c#" "cs"),
        build: Build::Rust(|base, _| {
            Box::new(Variable { longest: Some(base.nanoseconds(1_000_000_000) / 30) })
        }),
        ..VARIABLE
    },
    PolicyCard {
        id: "semi-fixed",
        name: "Semi-fixed",
        formula: "n = min(⌈dt / H⌉, 6) steps of dt / n",
        constants: "at most 6 steps in a frame",
        odd_frames: "no time: no step; 10 s: 6 steps of 10/6 s",
        users: "Unreal with substeps (60 Hz, at most 6), Quake III's player (66 ms)",
        source: "G. Fiedler, \"Fix Your Timestep!\", 2004; Unreal's physics substepping",
        has_max_ticks: true,
        snippets: snippets!("semi-fixed": "rust" "rs", "c++" "hpp", "c#" "cs"),
        build: Build::Rust(|base, limits| {
            let max_steps = limits.max_ticks.unwrap_or(MAX_STEPS);
            Box::new(SemiFixed { tick: base.tick(), rounding: base.nanoseconds(1), max_steps })
        }),
        ..VARIABLE
    },
    PolicyCard { is_usual: true, needs_exact_clock: true, ..FIXED },
    PolicyCard {
        id: "fixed-linear",
        name: "Fixed, linear",
        formula: "fixed; show q₀ + α (q₁ − q₀) of the last two ticks",
        users: "Unity, Godot and Avian as an option; Source shows its 15 ms ticks 0.1 s late",
        drawing: Interpolation::Linear,
        is_usual: true,
        snippets: snippets!("fixed-linear": "rust" "rs", "c++" "hpp", "c#" "cs"),
        ..FIXED
    },
    PolicyCard {
        id: "fixed-hermite",
        name: "Fixed, Hermite",
        formula: "fixed; show the cubic through both last ticks and their velocities",
        users: "Avian as an option; this program's window by default",
        source: "Avian's TransformHermiteEasing",
        drawing: Interpolation::Hermite,
        snippets: snippets!("fixed-hermite": "rust" "rs", "c++" "hpp"),
        ..FIXED
    },
    PolicyCard {
        id: "fixed-extrapolated",
        name: "Fixed, extrapolated",
        formula: "fixed; show q₁ + α H v₁",
        users: "Unity and Avian as an option",
        source: "Unity's Rigidbody.interpolation = Extrapolate",
        drawing: Interpolation::Extrapolated,
        snippets: snippets!("fixed-extrapolated": "rust" "rs", "c++" "hpp", "c#" "cs"),
        ..FIXED
    },
    PolicyCard {
        id: "render-tick",
        name: "Render tick",
        formula: "fixed; show a copy of the last tick after one step more, of α H, and drop it",
        users: "J. Tomsu's games",
        source: "J. Tomsu, \"Fixed timestep without interpolation\", 2024",
        has_render_tick: true,
        is_usual: true,
        snippets: snippets!("render-tick": "rust" "rs", "c++" "hpp", "c#" "cs"),
        ..FIXED
    },
    PolicyCard {
        id: "whole-refresh",
        name: "Whole refreshes",
        formula: "n = max(1, ⌊(dt + debt) / R⌉), debt += dt − n R; fixed with n R; linear",
        constants: "no refresh once dt + debt ≤ −R/2, which happens where frames do not wait for the display; at most 250 ms of ticks a frame",
        odd_frames: "no time: one refresh, then none; 10 s: the ticks of 250 ms, the rest dropped",
        users: "Godot (delta smoothing, 3.4 and 4) and F. Force's engine, each in its own form",
        source: "F. Force, \"Time Delta Smoothing\"; Godot's DeltaSmoother",
        drawing: Interpolation::Linear,
        is_usual: true,
        snippets: snippets!("whole-refresh": "rust" "rs", "c++" "hpp", "c#" "cs"),
        build: Build::Rust(|base, limits| Box::new(WholeRefresh::new(base, limits))),
        ..FIXED
    },
    PolicyCard {
        id: "snapped",
        name: "Snapped",
        formula: "dt near m R becomes m R; fixed with the mean of the last 4; linear",
        constants: "near is within 0.2 ms, m ≤ 8; a frame of more than 8 ticks counts as one; with more than 8 ticks owed all are dropped. What snapping adds or takes is not paid back",
        odd_frames: "no time: the mean runs out in 3 frames; 10 s: counts as one tick, the rest dropped",
        users: "T. Glaiel's games",
        source: "T. Glaiel, \"How to make your game run at 60fps\", 2019",
        drawing: Interpolation::Linear,
        snippets: snippets!("snapped": "rust" "rs"),
        build: Build::Rust(|base, limits| Box::new(Snapped::new(base, limits))),
        ..FIXED
    },
    PolicyCard {
        id: "hysteresis",
        name: "Hysteresis",
        formula: "fixed, but as many ticks as in the last 12 frames while −H/2 ≤ owed < 3H/2",
        constants: "12 frames, half a tick; at most 8 ticks a frame; the rest is dropped",
        odd_frames: "no time: at most one tick early, then none; 10 s: 8 ticks, the rest dropped",
        users: "Godot (physics_jitter_fix = 0.5)",
        source: "Godot's MainTimerSync",
        snippets: snippets!("hysteresis": "rust" "rs"),
        build: Build::Rust(|base, limits| Box::new(Hysteresis::new(base, limits))),
        ..FIXED
    },
    PolicyCard {
        id: "median",
        name: "Median",
        formula: "m = mean of the last 11 dt without the 2 longest and 2 shortest; e += (m − e) / 4; one step of e + debt / 16; debt += dt − step",
        constants: "of 11 frames the 2 longest and the 2 shortest do not count; these numbers, 1/4 and 1/16 are this program's choice",
        odd_frames: "no time: steps run out within 10 frames; 10 s: a sixteenth of what is missing each frame, in long steps",
        users: "BitSquid, now Autodesk Stingray, in its own form",
        source: "BitSquid's blog, \"Time Step Smoothing\", 2010",
        snippets: snippets!("median": "rust" "rs"),
        build: Build::Rust(|base, _| Box::new(Median::new(base))),
        ..VARIABLE
    },
    PolicyCard {
        id: "slow-down",
        name: "Slow down",
        formula: "fixed with at most one tick a frame; time lost is never caught up",
        constants: "one tick a frame, and one more is kept; the rest is dropped",
        odd_frames: "no time: no tick, or the one kept; 10 s: one tick, one kept, the rest dropped",
        users: "Factorio (60 updates a second)",
        source: "Factorio Friday Facts",
        snippets: snippets!("slow-down": "rust" "rs", "c++" "hpp"),
        build: Build::Rust(|base, limits| Box::new(SlowDown::new(base.tick(), limits))),
        ..FIXED
    },
];

/// Returns the policy with this id.
pub fn policy(id: &str) -> Option<&'static PolicyCard> {
    POLICIES.iter().find(|card| card.id == id)
}

/// Makes one step per frame, as long as the frame.
#[derive(Clone, Copy)]
struct Variable {
    /// Longest step. The rest of a longer frame is dropped.
    longest: Option<i128>,
}

impl Policy for Variable {
    fn frame(&mut self, duration: i128) -> Steps {
        let step = self.longest.map_or(duration, |longest| duration.min(longest));
        Steps { dropped: duration - step, ..Steps::one(step) }
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}

/// Makes one tick per frame, so that the game is as fast as the display.
#[derive(Clone, Copy)]
struct Lockstep {
    tick: i128,
}

impl Policy for Lockstep {
    fn frame(&mut self, _duration: i128) -> Steps {
        Steps::one(self.tick)
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}

/// Maximum number of steps in a frame. In frames that need more steps, the steps are longer than a tick.
const MAX_STEPS: u32 = 6;

/// Makes the fewest equal steps that are not longer than a tick.
#[derive(Clone, Copy)]
struct SemiFixed {
    tick: i128,
    /// Rounding of a clock in whole nanoseconds, which lengthens a frame of one tick.
    rounding: i128,
    max_steps: u32,
}

impl Policy for SemiFixed {
    fn frame(&mut self, duration: i128) -> Steps {
        let fewest = -(self.rounding - duration).div_euclid(self.tick);
        let fewest = fewest.max(i128::from(duration > 0));
        Steps {
            count: fewest.min(self.max_steps.into()) as u32,
            span: duration,
            ..Steps::default()
        }
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(*self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_and_opening_loops_have_a_digit_key() {
        let digits = 10;
        let usual = POLICIES.iter().enumerate().filter(|(_, card)| card.is_usual);
        let count = usual.clone().filter(|(index, _)| *index < digits).count();
        assert_eq!(count, usual.count());
        assert!(POLICIES.len() > digits && count >= 5, "{count}");
    }
}
