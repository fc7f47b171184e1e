//! Options that cannot be are refused with the field and the remedy.

use glam::DVec2;
use regatta::prelude::{Extras, Options, ParameterOf, Range, Scene, State, System};
use regatta::scene::custom::OptionsError;
use regatta::sim::integrators::{BuildIntegrator, Family, Method, Rk4, custom_integrator, method};

use super::{Orbit, Spring};

const SPRING: Spring = Spring { mass: 1.0, stiffness: 40.0, damping: 0.0 };

fn refused(options: Options<Spring>) -> OptionsError {
    regatta::try_advise(&SPRING, State { q: 1.0, v: 0.0 }, options).expect_err("a fault")
}

fn refused_extras(extras: Extras<Spring>) -> OptionsError {
    refused(Options { extras, ..Options::default() })
}

#[test]
fn each_option_out_of_its_range_is_named() {
    let plain = Options::<Spring>::default;
    let rk4 = method("rk4").unwrap();
    let made = |id: &'static str, custom| {
        &*Box::leak(Box::new(Method { id, name: "mine", custom, ..Family::Explicit.card() }))
    };
    let mine = Some(&custom_integrator::<Rk4<Vec<f64>>> as &dyn BuildIntegrator);
    for (field, says, options) in [
        ("name", "0 characters", Options { name: "", ..plain() }),
        ("tick_hz", "0", Options { tick_hz: 0.into(), ..plain() }),
        ("tick_hz", "10001", Options { tick_hz: 10_001.into(), ..plain() }),
        ("seconds", "NaN", Options { seconds: f64::NAN, ..plain() }),
        ("seconds", "-1", Options { seconds: -1.0, ..plain() }),
        ("methods", "two have", Options { methods: vec![rk4, rk4], ..plain() }),
        (
            "methods",
            "has the id \"rk4\" too",
            Options { methods: vec![made("rk4", mine)], ..plain() },
        ),
        ("methods", "not in the table", Options { methods: vec![made("mine", None)], ..plain() }),
        (
            "methods",
            "moves straight",
            Options { methods: vec![method("lerp-dt").unwrap()], ..plain() },
        ),
    ] {
        let error = refused(options);
        assert_eq!(error.field, field, "{error}");
        assert!(error.to_string().contains(says) && !error.remedy.is_empty(), "{error}");
    }
}

#[test]
fn each_invalid_or_false_extra_is_named() {
    let number = |key| ParameterOf::number(key, Range::POSITIVE, |s: &mut Spring| &mut s.stiffness);
    let damping =
        || ParameterOf::number("damping", Range::POSITIVE, |s: &mut Spring| &mut s.damping);
    let plain = Extras::<Spring>::default;
    for (field, says, extras) in [
        ("coordinates", "names 2", Extras { coordinates: vec![("x", "m"), ("y", "m")], ..plain() }),
        ("coordinates", "no name", Extras { coordinates: vec![("1x", "m")], ..plain() }),
        ("plane", "make no plane", Extras { plane: Some([0, 1]), ..plain() }),
        ("parameters", "no name", Extras { parameters: vec![number("a b")], ..plain() }),
        (
            "parameters",
            "or the second",
            Extras { parameters: vec![number("k"), number("k")], ..plain() },
        ),
        ("parameters", "damping is 0", Extras { parameters: vec![damping()], ..plain() }),
        (
            "energy",
            "not conserved",
            Extras { energy: Some(|_, s| s.v * s.v / 2.0 + 19.0 * s.q * s.q), ..plain() },
        ),
        ("energy", "says nothing", Extras { energy: Some(|_, _| 3.0), ..plain() }),
        ("energy", "NaN", Extras { energy: Some(|_, _| f64::NAN), ..plain() }),
        (
            "exact",
            "`x` begins at 2, and `start.q` is 1",
            Extras { exact: Some(|_, _| State { q: 2.0, v: 0.0 }), ..plain() },
        ),
        (
            "exact",
            "its second derivative is",
            Extras { exact: Some(|_, t| State { q: 1.0 + 0.0 * t, v: 0.0 }), ..plain() },
        ),
        (
            "exact",
            "not its derivative",
            Extras { exact: Some(|_, t| State { q: 1.0 + t, v: 0.0 }), ..plain() },
        ),
    ] {
        let error = refused_extras(extras);
        assert_eq!(error.field, field, "{error}");
        assert!(error.to_string().contains(says) && !error.remedy.is_empty(), "{error}");
    }
}

/// A spring that is pushed for a tenth of a second.
#[derive(Clone, Debug)]
struct Pushed;

impl System for Pushed {
    type Vector = f64;

    fn acceleration(&self, t: f64, q: &f64, _: &f64, a: &mut f64) {
        *a = -4.0 * q + if t > 3.97 && t < 4.07 { 9.81 } else { 0.0 };
    }
}

#[test]
fn a_claim_is_tested_at_every_tick_of_the_motion() {
    let refused = |extras: Extras<Pushed>| {
        let options = Options { extras, ..Options::default() };
        Scene::of(&Pushed, State { q: 1.0, v: 0.0 }, options).expect_err("a fault")
    };
    let exact = |_: &Pushed, t: f64| State { q: libm::cos(2.0 * t), v: -2.0 * libm::sin(2.0 * t) };
    let error = refused(Extras { exact: Some(exact), ..Extras::default() });
    assert!(error.to_string().contains("the motion since the tick before"), "{error}");
    let energy = |_: &Pushed, s: &State<f64>| s.v * s.v / 2.0 + 2.0 * s.q * s.q;
    let error = refused(Extras { energy: Some(energy), ..Extras::default() });
    assert!(error.to_string().contains("the energy is not conserved"), "{error}");
}

#[test]
fn a_false_claim_of_a_linear_force_is_refused() {
    let extras = Extras { is_linear: true, ..Extras::default() };
    let start = State { q: DVec2::new(3.0, 0.0), v: DVec2::new(0.0, 3.0) };
    let options = Options { extras, ..Options::default() };
    let error = Scene::of(&Orbit { mu: 40.0 }, start, options).expect_err("a fault");
    assert_eq!(error.field, "is_linear", "{error}");
}

#[test]
fn a_start_without_a_finite_force_is_refused() {
    let start = State { q: DVec2::ZERO, v: DVec2::ZERO };
    let error = Scene::of(&Orbit { mu: 40.0 }, start, Options::default()).expect_err("a fault");
    assert_eq!(error.field, "start", "{error}");
    let start = State { q: f64::INFINITY, v: 0.0 };
    let error = Scene::of(&SPRING, start, Options::default()).expect_err("a fault");
    assert_eq!(error.field, "start", "{error}");
}

#[test]
#[should_panic(expected = "`tick_hz`: 0; give a rate from 0.01 to 10000 Hz")]
fn the_panicking_shortcuts_have_the_same_messages() {
    let options = Options { tick_hz: 0.into(), ..Options::default() };
    regatta::advise(&SPRING, State { q: 1.0, v: 0.0 }, options);
}
