//! The rates with which every follower approaches its target equally fast, at every rate of frames.

use super::seen::seen;
use crate::sim::integrators::{Method, in_code, integrator, method};
use crate::sim::{Pursuit, Question, State, System};

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
const FRAME_RATES: [f64; 5] = [30.0, 60.0, 120.0, 144.0, 240.0];
/// The rates per second between which a follower's is sought, and how often the interval is halved.
const RATES: [f64; 2] = [1e-6, 1e9];
const HALVINGS: u32 = 200;

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

/// What a follower's rate is called, and what it is.
struct Setting {
    id: &'static str,
    name: &'static str,
    /// Of the rate that it steps with, per second, and frames per second.
    value: fn(f64, f64) -> f64,
    /// A line of code; braces stand for the value.
    code: &'static str,
    /// The follower whose rate it is, if not its own.
    stepped_as: Option<&'static str>,
}

const fn rate_of(id: &'static str, code: &'static str) -> Setting {
    Setting { id, name: "rate", value: |rate, _| rate, code, stepped_as: None }
}

/// The setting of each follower. The part of a lerp per frame is what one by the frame's duration has in that frame.
static SETTINGS: [Setting; 6] = [
    rate_of("exponential-decay", "x += (target - x) * (1.0 - exp(-{} * dt));"),
    Setting {
        name: "part",
        value: |rate, fps| rate / fps,
        stepped_as: Some("lerp-dt"),
        ..rate_of("lerp-per-frame", "x += (target - x) * {};")
    },
    rate_of("lerp-dt", "x += (target - x) * {} * dt;"),
    rate_of("critically-damped-spring", "(x, v) = critically_damped_spring(x, v, dt, target, {});"),
    Setting {
        name: "smooth_time",
        value: |rate, _| 2.0 / rate,
        ..rate_of("smooth-damp", "x = Mathf.SmoothDamp(x, target, ref velocity, {}f);")
    },
    rate_of("implicit-spring", "(x, v) = implicit_spring(x, v, dt, target, {});"),
];

/// A value whose target rests at 0.
struct Chaser {
    rate: f64,
    order: u32,
}

impl System for Chaser {
    type Vector = f64;

    fn acceleration(&self, _t: f64, x: &f64, v: &f64, a: &mut f64) {
        *a = -self.rate * self.rate * x - 2.0 * self.rate * v;
    }

    fn answer(&self, _t: f64, question: Question<'_, f64>) -> bool {
        let Question::Target(pursuit) = question else { return false };
        let (rate, order) = (self.rate, self.order);
        *pursuit = Some(Pursuit { target: 0.0, rate, order, is_still: true });
        true
    }
}

/// The time in which a follower with this rate halves the distance, in seconds; `None` if it overshoots within a frame.
fn half_life(method: &Method, rate: f64, fps: f64) -> Option<f64> {
    let order = method.law_order()?;
    let system = Chaser { rate, order };
    let step = |x: f64, v: f64| {
        let mut state = State { q: x, v };
        integrator::<Chaser>(method, &x).steps(&system, 0.0, 1.0 / fps, 1, &mut state).ok()?;
        Some([state.q, state.v])
    };
    let first = step(1.0, 0.0)?;
    if order == 1 {
        return (first[0] > 0.0).then(|| -std::f64::consts::LN_2 / libm::log(first[0]) / fps);
    }
    let second = step(0.0, 1.0)?;
    let determinant = first[0] * second[1] - second[0] * first[1];
    Some(CRITICAL_HALF / seen(first[0] + second[1], determinant, 1.0 / fps)?.omega)
}

/// The setting of every follower at 30 to 240 frames per second, and at `fps`, with which it halves the distance in the
/// same time.
pub fn followers(approach: Approach, fps: Option<f64>) -> Vec<FollowerPort> {
    let mut rates: Vec<f64> = FRAME_RATES.into_iter().chain(fps).collect();
    rates.sort_by(f64::total_cmp);
    rates.dedup();
    let of_setting = |setting: &'static Setting| {
        let of = |id| method(id).expect("a method of the table");
        let (named, stepped) = (of(setting.id), of(setting.stepped_as.unwrap_or(setting.id)));
        let at = move |&fps: &f64| {
            let value = (setting.value)(rate(approach, stepped, fps), fps);
            let code = setting.code.replace("{}", &in_code(value));
            FollowerPort { method: named, fps, setting: setting.name, value, code }
        };
        rates.iter().map(at)
    };
    SETTINGS.iter().flat_map(of_setting).collect()
}

/// The rate with which a follower is as fast as wished, per second.
fn rate(approach: Approach, method: &Method, fps: f64) -> f64 {
    let is_slow = |rate| half_life(method, rate, fps).is_some_and(|s| s > approach.half_life_s);
    let [mut low, mut high] = RATES;
    for _ in 0..HALVINGS {
        let middle = libm::sqrt(low * high);
        match is_slow(middle) {
            true => low = middle,
            false => high = middle,
        }
    }
    high
}
