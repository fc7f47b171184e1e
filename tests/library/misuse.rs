//! Errors on misuse of the lowest layer. A state never silently becomes not a number.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe, UnwindSafe, catch_unwind};
use std::sync::Once;

use regatta::measure::Judge;
use regatta::run::Race;
use regatta::scene::{Options, Scene};
use regatta::sim::batch::{Batch, Ticks};
use regatta::sim::bodies::Ship;
use regatta::sim::integrators::{
    Family, GENERAL_METHODS, METHODS, Needs, StepFailure, integrator, method,
};
use regatta::sim::{Clock, Query, Solver, State, System, stepper};

/// The message that `work` panics with.
fn panic_of<T>(work: impl FnOnce() -> T + UnwindSafe) -> String {
    let payload = catch_unwind(|| drop(work())).expect_err("a panic");
    match payload.downcast::<String>() {
        Ok(message) => *message,
        Err(payload) => payload.downcast_ref::<&str>().expect("a message").to_string(),
    }
}

/// The line of this file at which `work` panics; `None` if it panics elsewhere.
fn line_of_panic<T>(work: impl FnOnce() -> T + UnwindSafe) -> Option<u32> {
    thread_local!(static LINE: Cell<Option<u32>> = const { Cell::new(None) });
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let former = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            let here = panic.location().filter(|at| at.file().ends_with("misuse.rs"));
            LINE.set(here.map(panic::Location::line));
            former(panic);
        }));
    });
    LINE.set(None);
    panic_of(work);
    LINE.get()
}

#[test]
fn a_panic_names_the_line_of_the_game() {
    let start = State { q: 1.0, v: 0.0 };
    let wrong = || Options { tick_hz: 0.into(), ..Options::default() };
    let ship = Scene::built_in("ship").expect("a scene");
    let first = line!() + 2;
    let lines = [
        line_of_panic(|| Clock::new(0)),
        line_of_panic(|| Clock::new(60).set_tick_hz(0)),
        line_of_panic(|| regatta::advise(&Spring, start, wrong())),
        line_of_panic(|| Race::of(&Spring, start, wrong())),
        line_of_panic(|| Ticks::from_start(0, 1, 1)),
        line_of_panic(AssertUnwindSafe(|| Judge::at_throttle(&ship, 2.0))),
    ];
    assert_eq!(lines.to_vec(), (first..first + 6).map(Some).collect::<Vec<_>>());
}

#[test]
fn a_clock_is_constructed_and_changed_by_one_rule() {
    for tick_hz in [0, 10_001, u32::MAX] {
        let told = Clock::try_new(tick_hz).expect_err("no such rate").to_string();
        assert_eq!(told, format!("a clock runs at 0.01 to 10000 Hz; {tick_hz} Hz is outside"));
        assert_eq!(panic_of(|| Clock::new(tick_hz)), told);
        assert_eq!(panic_of(|| Clock::new(60).set_tick_hz(tick_hz)), told);
    }
    for tick_hz in [1_u32, 10_000] {
        assert_eq!(Clock::try_new(tick_hz).map(|clock| clock.tick_hz()), Ok(tick_hz.into()));
    }
}

#[derive(Clone)]
struct Spring;

impl System for Spring {
    type Vector = f64;
    fn acceleration(&self, _t: f64, q: &f64, _v: &f64, a: &mut f64) {
        *a = -40.0 * q;
    }
}

#[test]
fn ticks_of_zero_length_are_refused_on_construction_and_run() {
    for (hz, substeps) in [(0_u32, 1), (60, 0)] {
        let told = panic_of(|| Ticks::from_start(hz, substeps, 10));
        assert!(told.contains("give at least 1 of each"), "{told}");
        let run = move || {
            let start = [State { q: 1.0, v: 0.0 }].into_iter();
            let mut batch = Batch::new(&Spring, &GENERAL_METHODS[0], start).unwrap();
            batch.run(Ticks { origin: 0.0, first: 0, count: 1, hz: hz.into(), substeps });
        };
        assert_eq!(panic_of(run), told);
    }
}

#[test]
fn every_method_refuses_a_non_finite_step_and_keeps_the_state() {
    let steps = [(0.0, f64::NAN, 1), (0.0, f64::INFINITY, 1), (f64::NAN, 0.1, 1), (0.0, 0.1, 0)];
    for card in GENERAL_METHODS {
        for (t, h, substeps) in steps {
            let mut state = State { q: 1.0, v: 2.0 };
            let mut built = integrator::<Spring>(card, &state.q);
            let failure = built.steps(&Spring, t, h, substeps, &mut state).expect_err(card.id);
            assert!(matches!(failure, StepFailure::InvalidStep { .. }), "{}: {failure}", card.id);
            if substeps > 0 {
                assert!(built.step(&Spring, t, h, &mut state).is_err(), "{}", card.id);
            }
            assert_eq!(state, State { q: 1.0, v: 2.0 }, "{}", card.id);

            let mut body =
                stepper(Ship { mass: 1.0, v0: 1.0, ..Ship::BLANK }, Solver::Method(card));
            let before = body.q().to_vec();
            assert!(body.advance(t, h, substeps).is_err(), "{}", card.id);
            assert_eq!(body.q(), before, "{}", card.id);
        }
        // There and back is a step as good as another.
        let mut state = State { q: 1.0, v: 0.0 };
        assert_eq!(integrator(card, &state.q).step(&Spring, 0.0, -0.001, &mut state), Ok(()));
    }
}

/// A spring that tells an engine its stiffness if `.0`.
#[derive(Clone, Copy)]
struct Told(bool);

impl System for Told {
    type Vector = f64;
    fn acceleration(&self, _t: f64, q: &f64, _v: &f64, a: &mut f64) {
        *a = -400.0 * q;
    }
    fn query(&self, _t: f64, query: Query<'_, f64>) -> bool {
        let Query::Engine { settings, force, .. } = query else { return false };
        (settings.stiffness, *force) = (400.0, 0.0);
        self.0
    }
}

#[test]
fn an_engine_by_its_id_refuses_a_body_that_tells_no_joint() {
    let steps = |card, told| {
        let mut state = State { q: 1.0, v: 0.0 };
        integrator(card, &state.q).step(&Told(told), 0.0, 0.1, &mut state).map(|()| state.q)
    };
    let joints = METHODS.iter().filter(|card| {
        card.family == Family::Engine && card.only.is_some_and(|only| only.needs == Needs::Engine)
    });
    let mut ends = Vec::new();
    for card in joints {
        let failure = steps(card, false).expect_err(card.id).to_string();
        for part in ["asks for the joint", "answer `Query::Engine`", "return true"] {
            assert!(failure.contains(part), "{}: {failure}", card.id);
        }
        ends.push(steps(card, true).expect(card.id).to_bits());
    }
    assert!(ends.len() > 10);
    ends.sort_unstable();
    ends.dedup();
    assert!(ends.len() > 5, "the engines move a joint each in its way: {ends:?}");
}

/// Two masses on springs, whose acceleration is replaced by a vector of `.0` numbers.
#[derive(Clone)]
struct Replaced(usize);

impl System for Replaced {
    type Vector = Vec<f64>;
    fn acceleration(&self, _t: f64, q: &Vec<f64>, _v: &Vec<f64>, a: &mut Vec<f64>) {
        *a = (0..self.0).map(|i| -40.0 * q.get(i).unwrap_or(&0.0)).collect();
    }
}

#[test]
fn an_acceleration_that_resizes_its_vec_is_reported() {
    let start = || State { q: vec![1.0, 2.0], v: vec![0.0, 0.0] };
    for given in [1, 3] {
        for card in GENERAL_METHODS {
            let told = panic_of(|| {
                let mut state = start();
                let mut built = integrator::<Replaced>(card, &state.q);
                (0..3).try_for_each(|_| built.step(&Replaced(given), 0.0, 0.01, &mut state))
            });
            assert!(
                told.contains("`acceleration` must overwrite the numbers of `a`"),
                "{}: {told}",
                card.id
            );
        }
        let error = Scene::of(&Replaced(given), start(), Options::default()).expect_err("refused");
        assert_eq!(error.field, "acceleration");
        assert!(
            error.to_string().contains(&format!("replaces its 2 numbers by {given}")),
            "{error}"
        );
    }
    assert!(Scene::of(&Replaced(2), start(), Options::default()).is_ok());
    let told = panic_of(|| {
        let mut state = State { q: vec![1.0, 2.0], v: vec![0.0] };
        let mut rk4 = integrator::<Replaced>(method("rk4").unwrap(), &state.q);
        rk4.step(&Replaced(2), 0.0, 0.01, &mut state)
    });
    assert!(told.contains("keep the length of its first state"), "{told}");
}
