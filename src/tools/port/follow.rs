//! The rates with which every follower approaches its target equally fast, at every rate of frames.

use nalgebra::{Matrix2, Vector2};

use crate::sim::State;
use crate::sim::bodies::Follow;
use crate::sim::integrators::{
    FollowerQuantity, FollowerSetting, METHODS, Method, fresh, in_code, problem,
};
use crate::sim::law::Powers;
use crate::sim::numerics::bisect;

/// How fast a value approaches a target that rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// The time in which the distance halves, in seconds: of a value with a velocity of its own, from rest.
    pub half_life_s: f64,
}

/// The setting of a follower for an approach.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowerPort {
    /// The follower.
    pub method: &'static Method,
    /// Frames per second.
    pub fps: f64,
    /// The name of its setting.
    pub setting: &'static str,
    /// Its value.
    pub value: f64,
    /// The line of code that does it.
    pub code: String,
}

/// ω times the time in which a critically damped spring gets half the way from rest: (1 + z) exp(-z) is a half.
const CRITICAL_HALF: f64 = 1.678_346_990_016_660_8;
/// The rates of frames.
pub(super) const FRAME_RATES: [f64; 5] = [30.0, 60.0, 120.0, 144.0, 240.0];
/// The rates per second between which a follower's is sought, and how often the interval of their logarithms is halved.
const RATES: [f64; 2] = [1e-6, 1e9];
const HALVINGS: u32 = 60;
/// Frames after which half of the way is looked for first, and how often they are doubled: to a year at 240 a second.
const FIRST_SPAN: f64 = 1.0 / 64.0;
const DOUBLINGS: u32 = 40;

impl Approach {
    /// Of a value that goes this part of the way in each of `fps` frames per second.
    pub fn of_lerp(part: f64, fps: f64) -> Self {
        Self { half_life_s: -std::f64::consts::LN_2 / libm::log1p(-part) / fps }
    }

    /// Of a critically damped spring with this smoothing time in seconds, which is 2/ω.
    pub fn of_smooth_time(seconds: f64) -> Self {
        Self { half_life_s: CRITICAL_HALF * seconds / 2.0 }
    }

    /// k in x′ = k (g - x), per second.
    pub fn rate(&self) -> f64 {
        std::f64::consts::LN_2 / self.half_life_s
    }
}

/// The map of a frame of a follower with this rate, whose target rests; of the first order its velocity stays.
pub(super) fn map_of_frame(method: &Method, rate: f64, fps: f64) -> Option<Matrix2<f64>> {
    // Its target rests at 0.
    let order = method.law_order()? as usize;
    let system = problem(Follow { order, rate, ..Follow::default() });
    let step = |x: f64, v: f64| {
        let mut state = State { q: x, v };
        fresh(method).steps(&system, 0.0, 1.0 / fps, 1, &mut state).ok()?;
        Some(Vector2::new(state.q, state.v))
    };
    Some(Matrix2::from_columns(&[step(1.0, 0.0)?, step(0.0, 1.0)?]))
}

/// The time in which a follower with this rate halves the distance, in seconds; `None` if it overshoots within a frame.
fn half_life(method: &Method, rate: f64, fps: f64) -> Option<f64> {
    let map = map_of_frame(method, rate, fps)?;
    if method.law_order()? == 1 {
        return (map.m11 > 0.0).then(|| -std::f64::consts::LN_2 / libm::log(map.m11) / fps);
    }
    Some(frames_to_half(&map)? / fps)
}

/// The frames after which half of the distance is left, from rest; between two frames by the map's own powers. `None` if
/// the map changes sides, or does not decay.
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

/// The setting of every follower at 30 to 240 frames per second, and at `fps`, with which it halves the distance in the
/// same time.
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

/// The setting with which a follower is as fast as wished.
fn value(approach: Approach, method: &Method, quantity: FollowerQuantity, fps: f64) -> f64 {
    match quantity {
        FollowerQuantity::Rate => rate(approach, method, fps),
        FollowerQuantity::Part => -libm::expm1(-approach.rate() / fps),
        FollowerQuantity::SmoothTime => 2.0 / rate(approach, method, fps),
    }
}

/// The rate with which a follower is as fast as wished, per second.
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
    // Smooth-damp halves nothing in less than a third of a frame: then a frame leaves as much as an exponential does.
    let left = libm::exp(-approach.rate() / fps);
    search(&|rate| map_of_frame(method, rate, fps).is_some_and(|map| map.m11 > left))
}
