//! The check that is open to everybody's methods holds every card of the table, and sees each claim that is
//! changed.

use regatta::conformance::check;
use regatta::sim::integrators::{
    AdamsBashforth2, BogackiShampine32, BuildIntegrator, Family, GENERAL_METHODS, ImplicitMidpoint,
    METHODS, Method, Rk4, Tolerance, VelocityVerlet, custom_integrator, method,
};

#[test]
fn every_claim_of_every_card_holds() {
    for card in GENERAL_METHODS {
        let found = check(card);
        println!("{found}");
        assert!(found.holds() && found.claims.len() == 11, "{found}");
    }
}

/// The cards that differ from this one in one field, with the field.
fn misprints(card: &Method) -> Vec<(&'static str, Method)> {
    let flipped = |is_so: Option<&'static str>| is_so.is_none().then_some("somehow");
    let mut misprints = vec![
        ("id", Method { id: "unlisted", custom: None, ..*card }),
        ("order", Method { order: card.order + 1, ..*card }),
        ("order", Method { order: card.order - 1, ..*card }),
        ("order_with_drag", Method { order_with_drag: card.order_with_drag + 1, ..*card }),
        ("order_with_drag", Method { order_with_drag: card.order_with_drag - 1, ..*card }),
        ("exact_if_linear", Method { exact_if_linear: !card.exact_if_linear, ..*card }),
        ("symplectic", Method { symplectic: !card.symplectic, ..*card }),
        ("reversible", Method { reversible: !card.reversible, ..*card }),
        ("restart", Method { restart: flipped(card.restart), ..*card }),
        ("keeps_time", Method { keeps_time: !card.keeps_time, ..*card }),
    ];
    misprints.extend(match card.evaluations {
        None => vec![("evaluations", Method { evaluations: Some(7), ..*card })],
        Some(count) => [Some(count + 1), Some(count - 1), None]
            .map(|evaluations| ("evaluations", Method { evaluations, ..*card }))
            .into(),
    });
    misprints.extend(match card.stability_limit {
        None => vec![("stability_limit", Method { stability_limit: Some(2.0), ..*card })],
        Some(limit) => [Some(limit * 0.98), Some(limit * 1.02 + 0.01), None]
            .map(|stability_limit| ("stability_limit", Method { stability_limit, ..*card }))
            .into_iter()
            .filter(|(_, misprint)| misprint.stability_limit != Some(0.0))
            .collect(),
    });
    let tolerance = card.tolerance.is_none().then(|| Tolerance::uniform(1e-4));
    misprints.push(("tolerance", Method { tolerance, ..*card }));
    misprints
}

#[test]
fn exactly_the_changed_claims_are_detected() {
    // One each that is symplectic, has a memory of a slope, is explicit, chooses its steps, solves an equation.
    let ids =
        ["velocity-verlet", "adams-bashforth-2", "rk4", "bogacki-shampine-32", "implicit-midpoint"];
    for card in ids.map(|id| method(id).expect("a method")) {
        for (field, misprint) in misprints(card) {
            let found = check(&misprint);
            let broken: Vec<_> = found.broken().map(|claim| claim.field).collect();
            assert!(broken.contains(&field), "{}: {field} is not seen: {found}", card.id);
            // The first step of a method with a memory owes an evaluation.
            let follows =
                |other: &&str| [field, "restart"] == ["restart", field] && *other == "evaluations";
            assert!(
                broken.iter().all(|other| *other == field || follows(other)),
                "{field}: {found}"
            );
        }
    }
}

#[test]
fn a_custom_method_is_tested_against_its_card() {
    let own = |id: &str, new_id: &'static str, own: &'static dyn BuildIntegrator| {
        let card = method(id).expect("a method");
        Method { id: new_id, custom: Some(own), ..*card }
    };
    let mine = [
        own("rk4", "my-rk4", &custom_integrator::<Rk4<Vec<f64>>>),
        own("velocity-verlet", "my-verlet", &custom_integrator::<VelocityVerlet<Vec<f64>>>),
        own("adams-bashforth-2", "my-ab2", &custom_integrator::<AdamsBashforth2<Vec<f64>>>),
        own("bogacki-shampine-32", "my-bs32", &custom_integrator::<BogackiShampine32<Vec<f64>>>),
        own("implicit-midpoint", "my-midpoint", &custom_integrator::<ImplicitMidpoint<Vec<f64>>>),
    ];
    for card in &mine {
        let found = check(card);
        assert!(found.holds(), "{found}");
    }
    let [rk4, ..] = &mine;
    let taken = check(&Method { id: "midpoint", ..*rk4 });
    assert!(taken.broken().map(|claim| claim.field).eq(["id"]), "{taken}");
    for nameless in
        [Method { id: "My RK4", ..*rk4 }, Method { id: "", ..*rk4 }, Method { name: "", ..*rk4 }]
    {
        let found = check(&nameless);
        assert!(found.broken().map(|claim| claim.field).eq(["id"]), "{found}");
    }
    let wrong =
        check(&Method { custom: Some(&custom_integrator::<VelocityVerlet<Vec<f64>>>), ..*rk4 });
    assert!(wrong.broken().any(|claim| claim.field == "order"), "{wrong}");
}

#[test]
fn a_failing_method_breaks_only_its_claims() {
    /// A method that gives up at its third step.
    #[derive(Clone)]
    struct GivesUp(u32);
    impl<S: regatta::sim::System> regatta::sim::integrators::Integrator<S> for GivesUp {
        fn new(_like: &S::Vector) -> Self {
            Self(0)
        }
        fn step(
            &mut self,
            _system: &S,
            _t: f64,
            _h: f64,
            _state: &mut regatta::sim::State<S::Vector>,
        ) -> Result<(), regatta::sim::integrators::StepFailure> {
            self.0 += 1;
            match self.0 {
                ..3 => Ok(()),
                _ => Err(regatta::sim::integrators::StepFailure::TooManySubsteps { limit: 3 }),
            }
        }
    }
    let card = Method {
        id: "gives-up",
        name: "Gives up",
        order: 1,
        order_with_drag: 1,
        evaluations: Some(1),
        custom: Some(&custom_integrator::<GivesUp>),
        ..Family::Explicit.card()
    };
    let found = check(&card);
    assert!(!found.holds() && found.broken().count() >= 4, "{found}");
    assert!(found.to_string().lines().count() == 12, "{found}");
}

#[test]
fn an_unmeasured_follower_is_reported_as_not_measured() {
    let follower = METHODS.iter().find(|card| card.only.is_some()).expect("a follower");
    let found = check(follower);
    assert!(!found.holds() && found.to_string().contains("not measured"), "{found}");
}
