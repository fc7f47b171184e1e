//! A custom method, held to its card, and raced on a built-in scene.

use regatta::prelude::*;

/// Ralston's method of second order, which has the least bound on its error.
#[derive(Clone)]
struct Ralston<V> {
    slopes: [State<V>; 2],
    middle: State<V>,
}

impl<S: System> Integrator<S> for Ralston<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        Self { slopes: [zero.clone(), zero.clone()], middle: zero }
    }

    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        let [first, second] = &mut self.slopes;
        system.derivative(t, state, first);
        self.middle.assign_sum(state, 2.0 / 3.0 * h, first);
        system.derivative(t + 2.0 / 3.0 * h, &self.middle, second);
        state.add_terms([(h / 4.0, first), (3.0 / 4.0 * h, second)]);
        Ok(())
    }
}

static RALSTON: Method = Method {
    id: "ralston",
    name: "Ralston",
    about: "second order with the least bound on its error",
    order: 2,
    order_with_drag: 2,
    evaluations: Some(2),
    source: "Ralston 1962",
    custom: Some(&custom_integrator::<Ralston<Vec<f64>>>),
    ..Family::Explicit.card()
};

fn main() {
    // Order, evaluations, stability limit, area, reversibility: each claim is measured, both ways.
    let found = regatta::conformance::check(&RALSTON);
    print!("{found}");
    assert!(found.holds());

    let mut scene = Scene::built_in("spring").expect("a built-in scene");
    scene.lanes = vec![LaneSpec::plain(&RALSTON), LaneSpec::plain(method("midpoint").unwrap())];
    scene.opening_method = None;
    let judge = Judge::new(&scene);
    for lane in &scene.lanes {
        println!("{}: {}", lane.method.name, judge.verdict(*lane, scene.tick_hz));
    }

    let mut race = Race::of_scene(&scene);
    race.run(60);
    assert!(race.hashes_by_method().any(|(method, _)| method == "ralston"));
}
