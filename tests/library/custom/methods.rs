//! Custom methods in a race, a verdict and a run that is gone back in.

use regatta::measure::{Adviser, Criterion, Judge};
use regatta::run::{Race, Run, Session};
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::integrators::{
    AdamsBashforth2, BogackiShampine32, BuildIntegrator, Family, ImplicitMidpoint, Integrator,
    Method, Rk4, StepFailure, VelocityVerlet, custom_integrator, method,
};
use regatta::sim::{State, System};

use crate::scenes::edited;

/// Copies of built-in methods under other ids.
fn copies() -> [(&'static Method, Method); 5] {
    let copy = |id: &str, new_id: &'static str, own: &'static dyn BuildIntegrator| {
        let card = method(id).expect("a method");
        (card, Method { id: new_id, name: new_id, custom: Some(own), ..*card })
    };
    [
        copy("rk4", "my-rk4", &custom_integrator::<Rk4<Vec<f64>>>),
        copy("velocity-verlet", "my-verlet", &custom_integrator::<VelocityVerlet<Vec<f64>>>),
        copy("adams-bashforth-2", "my-ab2", &custom_integrator::<AdamsBashforth2<Vec<f64>>>),
        copy("bogacki-shampine-32", "my-bs32", &custom_integrator::<BogackiShampine32<Vec<f64>>>),
        copy("implicit-midpoint", "my-midpoint", &custom_integrator::<ImplicitMidpoint<Vec<f64>>>),
    ]
}

/// The scene with a lane for each original and one for each copy after it.
fn with_copies(scene: &str) -> Scene {
    let pairs = copies().map(|(card, copy)| [card, Box::leak(Box::new(copy))]);
    let lanes = pairs.into_iter().flatten().map(LaneSpec::plain).collect();
    let scene = Scene::built_in(scene).expect("a built-in scene");
    edited(&scene, |scene| {
        (scene.lanes, scene.opening_method, scene.equal_cost) = (lanes, None, false);
    })
}

#[test]
fn a_copy_of_a_built_in_method_has_its_bits_on_every_kind_of_vector() {
    // One coordinate, two in a plane, many, and a law; with scripted kicks in some.
    for name in ["spring", "surge", "helm", "orbit", "chain", "duffing"] {
        let scene = with_copies(name);
        let mut race = Race::of_scene(&scene);
        race.run(300);
        let hashes: Vec<u64> = race.lane_hashes().collect();
        for (pair, lanes) in hashes.chunks(2).zip(scene.lanes.chunks(2)) {
            assert_eq!(pair[0], pair[1], "{} on {name}", lanes[1].method.id);
        }
        assert_ne!(hashes[0], hashes[2], "{name}");
    }
}

#[test]
fn a_copy_is_judged_and_advised_as_its_original() {
    let scene = with_copies("spring");
    let judge = Judge::new(&scene);
    let adviser = Adviser::new(&scene, 60);
    for pair in scene.lanes.chunks(2) {
        let [a, b] = [pair[0], pair[1]].map(|lane| judge.verdict(lane, 60));
        assert_eq!(a, b, "{}", pair[1].method.id);
        let [a, b] = [pair[0], pair[1]].map(|lane| adviser.meets(lane, Criterion::LooksRight));
        assert_eq!(a, b, "{}", pair[1].method.id);
    }
}

#[test]
fn a_run_with_custom_methods_rewinds_and_copies_to_the_bit() {
    let scene = with_copies("surge");
    let mut timeline = Run::new(Session::racing(scene.into()));
    let mut hashes = Vec::new();
    for _ in 0..400 {
        hashes.push(timeline.session().race().state_hash());
        timeline.tick(&mut ());
    }
    for tick in [399, 17, 200, 0, 333] {
        timeline.seek(tick);
        assert_eq!(timeline.session().race().state_hash(), hashes[tick as usize], "tick {tick}");
    }
}

/// A method that forgets to halve: of first order, as its card does not say.
#[derive(Clone)]
struct Hasty<V>(State<V>);

impl<S: System> Integrator<S> for Hasty<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self(State { q: like.clone(), v: like.clone() })
    }

    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        system.derivative(t, state, &mut self.0);
        state.add_scaled(h, &self.0);
        Ok(())
    }
}

#[test]
fn a_wrong_card_is_reported_with_each_broken_claim() {
    let card = Method {
        id: "hasty",
        name: "Hasty",
        order: 2,
        order_with_drag: 1,
        evaluations: Some(1),
        symplectic: true,
        custom: Some(&custom_integrator::<Hasty<Vec<f64>>>),
        ..Family::Explicit.card()
    };
    let found = regatta::conformance::check(&card);
    let broken: Vec<_> = found.broken().map(|claim| claim.field).collect();
    assert_eq!(broken, ["order", "symplectic"], "{found}");
    assert!(found.to_string().contains("1.00 and 1.00 on the undamped spring"), "{found}");
}
