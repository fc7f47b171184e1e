//! Finds the settings with which every follower approaches its target equally fast, at every frame rate.

use nalgebra::{Matrix2, Vector2};

use crate::sim::State;
use crate::sim::bodies::Follow;
use crate::sim::integrators::{
    FollowerQuantity, FollowerSetting, METHODS, Method, fresh, in_code, problem,
};
use crate::sim::law::Powers;
use crate::sim::numerics::bisect;

/// The speed at which a value approaches a resting target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// Time in which the distance halves, in seconds. A value that has a velocity of its own starts at rest.
    pub half_life_s: f64,
}

/// A follower's setting for an approach.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowerPort {
    /// The follower.
    pub method: &'static Method,
    /// Frames per second.
    pub fps: f64,
    /// Name of the setting.
    pub setting: &'static str,
    /// Value of the setting.
    pub value: f64,
    /// The line of code with this value.
    pub code: String,
}

/// Solution z of (1 + z) exp(-z) = ½: ω times the half-life of a critically damped spring that starts at rest.
const CRITICAL_HALF: f64 = 1.678_346_990_016_660_8;
/// Frames per second for which settings are listed.
pub(super) const FRAME_RATES: [f64; 5] = [30.0, 60.0, 120.0, 144.0, 240.0];
/// Lowest and highest rate per second in the search for a follower's rate, and number of times that the interval of
/// their logarithms is halved.
const RATES: [f64; 2] = [1e-6, 1e9];
const HALVINGS: u32 = 60;
/// First number of frames that is tried for half of the way, and number of times that it doubles, up to a year at 240
/// frames per second.
const FIRST_SPAN: f64 = 1.0 / 64.0;
const DOUBLINGS: u32 = 40;

impl Approach {
    /// Returns the approach of a value that covers this fraction of the distance in each of `fps` frames per second.
    pub fn of_lerp(part: f64, fps: f64) -> Self {
        Self { half_life_s: -std::f64::consts::LN_2 / libm::log1p(-part) / fps }
    }

    /// Returns the approach of a critically damped spring with this smoothing time in seconds, which is 2/ω.
    pub fn of_smooth_time(seconds: f64) -> Self {
        Self { half_life_s: CRITICAL_HALF * seconds / 2.0 }
    }

    /// Returns the rate k of x′ = k (g - x), per second.
    pub fn rate(&self) -> f64 {
        std::f64::consts::LN_2 / self.half_life_s
    }
}

/// Returns the map of a frame of a follower with this rate and a resting target. A follower of the first order keeps
/// its velocity.
pub(super) fn map_of_frame(method: &Method, rate: f64, fps: f64) -> Option<Matrix2<f64>> {
    // The target rests at 0.
    let order = method.law_order()? as usize;
    let system = problem(Follow { order, rate, ..Follow::default() });
    let step = |x: f64, v: f64| {
        let mut state = State { q: x, v };
        fresh(method).steps(&system, 0.0, 1.0 / fps, 1, &mut state).ok()?;
        Some(Vector2::new(state.q, state.v))
    };
    Some(Matrix2::from_columns(&[step(1.0, 0.0)?, step(0.0, 1.0)?]))
}

/// Returns the time in which a follower with this rate halves the distance, in seconds; `None` if the follower
/// overshoots within a frame.
fn half_life(method: &Method, rate: f64, fps: f64) -> Option<f64> {
    let map = map_of_frame(method, rate, fps)?;
    if method.law_order()? == 1 {
        return (map.m11 > 0.0).then(|| -std::f64::consts::LN_2 / libm::log(map.m11) / fps);
    }
    Some(frames_to_half(&map)? / fps)
}

/// Returns the number of frames until half of the distance is left, from rest. Powers of the map interpolate between
/// frames. `None` if the map changes sides or does not decay.
fn frames_to_half(map: &Matrix2<f64>) -> Option<f64> {
    let (half, determinant) = (map.trace() / 2.0, map.determinant());
    let powers = Powers::of(map.trace(), determinant)?;
    let beside = (map.m11 - half) / libm::sqrt(determinant);
    let left = |frames: f64| {
        let [even, odd] = powers.at(frames);
        even + beside * odd
    };
    let spans = (0..DOUBLINGS).map(|i| FIRST_SPAN * libm::exp2(f64::from(i)));
    let high = spans.into_iter().find(|frames| left(*frames) <= 0.5)?;
    let [_, high] = bisect([0.0, high], HALVINGS, |frames| left(frames) > 0.5);
    Some(high)
}

/// Returns the settings with which every follower halves the distance in the same time, at 30 to 240 frames per second
/// and at `fps`.
pub fn followers(approach: Approach, fps: Option<f64>) -> Vec<FollowerPort> {
    let mut rates: Vec<f64> = FRAME_RATES.into_iter().chain(fps).collect();
    rates.sort_by(f64::total_cmp);
    rates.dedup();
    let of_follower = |(method, setting): (&'static Method, FollowerSetting)| {
        let at = move |&fps: &f64| {
            let value = value(approach, method, setting.quantity, fps);
            let code = setting.code.replace("{}", &in_code(value));
            FollowerPort { method, fps, setting: setting.name, value, code }
        };
        rates.iter().map(at)
    };
    let all = METHODS.iter().filter_map(|method| Some((method, method.follower?)));
    all.flat_map(of_follower).collect()
}

/// Returns the value of a follower's setting for an approach.
fn value(approach: Approach, method: &Method, quantity: FollowerQuantity, fps: f64) -> f64 {
    match quantity {
        FollowerQuantity::Rate => rate(approach, method, fps),
        FollowerQuantity::Part => -libm::expm1(-approach.rate() / fps),
        FollowerQuantity::SmoothTime => 2.0 / rate(approach, method, fps),
    }
}

/// Returns a follower's rate for an approach, per second.
fn rate(approach: Approach, method: &Method, fps: f64) -> f64 {
    let is_slow = |rate| half_life(method, rate, fps).is_some_and(|s| s > approach.half_life_s);
    let search = |is_low: &dyn Fn(f64) -> bool| {
        let [_, high] = bisect(RATES.map(libm::log), HALVINGS, |log| is_low(libm::exp(log)));
        libm::exp(high)
    };
    let found = search(&is_slow);
    if !is_slow(found) {
        return found;
    }
    // Smooth-damp needs at least a third of a frame to halve a distance. For a faster approach, a frame leaves as
    // much as an exponential does.
    let left = libm::exp(-approach.rate() / fps);
    search(&|rate| map_of_frame(method, rate, fps).is_some_and(|map| map.m11 > left))
}
