//! The claims of a law about its motion, and the truth for comparing methods.

use regatta::measure::Judge;
use regatta::scene::{LaneSpec, Scene, SceneBody};
use regatta::sim::Solver;
use regatta::sim::bodies::Input;
use regatta::sim::integrators::METHODS;

use super::{body, parse, stepper};

#[test]
fn only_a_false_claim_is_refused() {
    let with = |c: &str, energy: &str, more: &str| {
        let text = format!(
            "[[law]]\nconstants = {{ m = 2, k = 8, c = {c} }}\n{energy}\n[law.coordinates.x]\nstart = 0.5\n\
             acceleration = '-(k*x + c*vx)/m'\n{more}"
        );
        parse(&text).map(|_| ()).unwrap_or_else(|errors| panic!("{errors}"))
    };
    let refused = |c: &str, energy: &str, more: &str| {
        let text = format!(
            "[[law]]\nconstants = {{ m = 2, k = 8, c = {c} }}\n{energy}\n[law.coordinates.x]\nstart = 0.5\n\
             acceleration = '-(k*x + c*vx)/m'\n{more}"
        );
        parse(&text).expect_err(&text)
    };
    let energy = "energy = 'm*vx^2/2 + k*x^2/2'";
    with("0", energy, "exact = 'x0*cos(sqrt(k/m)*t) + vx0*sin(sqrt(k/m)*t)/sqrt(k/m)'");
    with("0.0", energy, "");
    let lossy = refused("0.01", energy, "");
    assert!(lossy.starts_with("mine.toml:6:11: the energy is not conserved"), "{lossy}");
    let half = refused("0", "energy = 'm*vx^2/2 + k*x^2'", "");
    assert!(half.contains("not conserved"), "{half}");
    let slow = refused("0", "", "exact = 'x0*cos(sqrt(k/m)*1.0000001*t)'");
    assert!(slow.contains("its second derivative is"), "{slow}");
    let elsewhere = refused("0", "", "exact = '0.4*cos(sqrt(k/m)*t)'");
    assert!(elsewhere.contains("`x` begins at 0.4, and `start` is 0.5"), "{elsewhere}");
    let moving = refused("0", "", "exact = 'x0*cos(sqrt(k/m)*t) + sin(sqrt(k/m)*t)'");
    assert!(moving.contains("`vx` begins at 2, and `start_velocity` is 0"), "{moving}");
}

/// The error message for a spring of 4 rad/s² in a scene of 10 s at 60 Hz, with additional acceleration and its
/// claims.
fn said(more: &str, energy: &str, exact: &str) -> Option<String> {
    let text = format!(
        "[[law]]\nconstants = {{ k = 4 }}\n{energy}\n[law.coordinates.x]\nstart = 1\n\
         acceleration = '-k*x{more}'\n{exact}"
    );
    parse(&text).err()
}

#[test]
fn a_claim_is_tested_at_every_tick_of_the_scene() {
    let (energy, exact) = ("energy = 'vx*vx/2 + k*x*x/2'", "exact = 'cos(sqrt(k)*t)'");
    assert_eq!(said("", energy, exact), None);
    // Between 12 moments that a quick look takes, for a second, or for less than a tick.
    for pulse in ["t > 3.97 and t < 4.07", "t > 8.001 and t < 8.004"] {
        let more = format!(" + if({pulse}, 9.81, 0)");
        let moved = said(&more, "", exact).expect("it is false");
        assert!(moved.contains("and the motion since the tick before leads to"), "{moved}");
        let leak = said(&more, energy, "").expect("it is false");
        assert!(leak.contains("the energy is not conserved"), "{leak}");
    }
    let braked = said(" - if(t > 7, 0.1*vx, 0)", energy, "").expect("it is false");
    assert!(braked.contains("the energy is not conserved"), "{braked}");
}

#[test]
fn an_exact_solution_is_no_truth_while_a_constant_falsifies_it() {
    let mut law = body(
        "[[law]]\nconstants = { k = 4, g = 0 }\n[law.coordinates.x]\nstart = 1\n\
         acceleration = '-k*x + if(t > 4.3 and t < 5.1, g, 0)'\nexact = 'cos(sqrt(k)*t)'",
    );
    let off_at_6_s = |law: &SceneBody| {
        let mut truth = stepper(law, Solver::Truth);
        truth.advance(0.0, 6.0, 1).unwrap();
        (truth.q()[0] - libm::cos(12.0)).abs()
    };
    assert!(off_at_6_s(&law) < 1e-12);
    law.values[1] = 9.81;
    assert!(off_at_6_s(&law) > 1.0, "{}", off_at_6_s(&law));
}

#[test]
fn a_constant_is_no_energy() {
    for constant in ["3", "k", "0*vx + 0*x"] {
        let said = said("", &format!("energy = '{constant}'"), "").expect("it says nothing");
        assert!(said.contains("which says nothing about the motion"), "{said}");
    }
}

#[test]
fn a_true_claim_is_accepted_even_without_exchange_or_in_a_long_scene() {
    // On a circle the potential and the kinetic energy stay, up to rounding.
    let circle = "energy = '(vx*vx + vy*vy)/2 - 1/sqrt(x*x + y*y)'\n\
                  [law.coordinates.x]\nstart = 1\nexact = 'cos(t)'\n\
                  acceleration = '-x/(x*x + y*y)^1.5'\n\
                  [law.coordinates.y]\nstart_velocity = 1\nexact = 'sin(t)'\n\
                  acceleration = '-y/(x*x + y*y)^1.5'";
    assert_eq!(parse(&format!("[[law]]\n{circle}")).err(), None);
    // Two years of work, if each tick were looked at.
    let stiff = "energy = 'vx*vx/2 + 1e8*x*x/2'\n[law.coordinates.x]\nstart = 1\n\
                 acceleration = '-1e8*x'\nexact = 'cos(1e4*t)'";
    let year = format!("title = 'A year'\ntick_hz = 60\nseconds = 3e7\n[[law]]\n{stiff}");
    assert!(Scene::parse("year.toml", &year).is_ok());
}

#[test]
fn an_exact_solution_may_include_a_push_of_a_second() {
    let push = "[[law]]\n[law.coordinates.x]\nacceleration = 'if(t > 4 and t < 5, 8, 0)'\n";
    let exact = "exact = 'if(t < 4, 0, if(t < 5, 4*(t - 4)^2, 4 + 8*(t - 5)))'";
    assert_eq!(parse(&format!("{push}{exact}")).err(), None);
}

#[test]
fn an_exact_solution_may_be_an_unstable_motion() {
    let text = "[[law]]\n[law.coordinates.x]\nstart = 1\nstart_velocity = -1\n\
                acceleration = 'x'\nexact = 'exp(-t)'";
    assert_eq!(parse(text).err(), None);
}

#[test]
fn an_exact_solution_is_the_truth_until_an_intervention() {
    let law = body(
        "[[law]]\nconstants = { w = 3 }\n[law.coordinates.x]\nstart = 0.5\nacceleration = '-w*w*x'\n\
         exact = 'x0*cos(w*t) + vx0*sin(w*t)/w'",
    );
    let mut truth = stepper(&law, Solver::Truth);
    for tick in 0..600 {
        truth.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    let exact = 0.5 * libm::cos(3.0 * (599.0 / 60.0 + 1.0 / 60.0));
    assert_eq!(truth.q()[0], exact);
    let before = truth.truth_error().unwrap();
    assert!(before[0] > 0.0 && before[0] < 1e-13);
    // After a kick the reference continues from the same state.
    truth.input(10.0, Input::Kick(1.0));
    let (q, v) = (truth.q()[0], truth.v()[0]);
    truth.advance(10.0, 1.0, 1).unwrap();
    let after = q * libm::cos(3.0) + v * libm::sin(3.0) / 3.0;
    assert!((truth.q()[0] - after).abs() < 1e-12, "{} and {after}", truth.q()[0]);
    assert!(truth.truth_error().unwrap()[0] < 1e-10);
}

#[test]
fn the_reference_meets_corners_and_jumps() {
    // A ball on a floor of stiff springs, against the closed form: parabolas and halves of sines.
    let law = body(
        "[[law]]\nconstants = { g = 9.81, w2 = 400 }\n[law.coordinates.y]\nstart = 1\n\
         acceleration = 'if(y < 0, -w2*y, 0) - g'",
    );
    let mut truth = stepper(&law, Solver::Truth);
    let (g, w2) = (9.81_f64, 400.0_f64);
    let fall = (2.0 / g).sqrt();
    let speed = (2.0 * g).sqrt();
    // About its rest -g/w2 it swings from 0 downwards and back to 0.
    let rest = g / w2;
    let w = w2.sqrt();
    let contact = 2.0 * (std::f64::consts::PI - libm::atan2(speed / w, rest)) / w;
    let contact = if contact > 0.0 { contact } else { f64::NAN };
    let period = 2.0 * fall + contact;
    let mut t = 0.0;
    let mut worst = 0.0_f64;
    for tick in 0..1200 {
        truth.advance(t, 1.0 / 60.0, 1).unwrap();
        t = f64::from(tick + 1) / 60.0;
        let phase = t % period;
        let expected = if phase <= fall {
            1.0 - g * phase * phase / 2.0
        } else if phase >= fall + contact {
            let back = period - phase;
            1.0 - g * back * back / 2.0
        } else {
            let s = phase - fall;
            -rest + rest * libm::cos(w * s) - speed / w * libm::sin(w * s)
        };
        worst = worst.max((truth.q()[0] - expected).abs());
    }
    let said = truth.truth_error().unwrap()[0];
    assert!(worst < 1e-9, "{worst:e} m, {said:e} m said");
    assert!(said < 1e-8, "{said:e} m said");
    // A force that jumps: y″ = -sign(y), whose period from y = 1/2 is 4.
    let law = body("[[law]]\n[law.coordinates.y]\nstart = 0.5\nacceleration = '-sign(y)'");
    let mut truth = stepper(&law, Solver::Truth);
    for tick in 0..480 {
        truth.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    assert!((truth.q()[0] - 0.5).abs() < 1e-11, "{}", truth.q()[0]);
    // A pulse that begins and ends between two ticks.
    let law =
        body("[[law]]\n[law.coordinates.y]\nacceleration = 'if(t > 0.105 and t < 0.112, 1000, 0)'");
    let mut truth = stepper(&law, Solver::Truth);
    for tick in 0..60 {
        truth.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    assert!((truth.v()[0] - 7.0).abs() < 1e-10, "{}", truth.v()[0]);
}

#[test]
fn a_jump_lowers_the_measured_order_and_the_verdict_claims_no_more() {
    // RK4 has order 4 on the smooth law, and about 1 with a jump that it meets at any part of a step.
    let error = |acceleration: &str, hz: u32| {
        let law = body(&format!(
            "[[law]]\n[law.coordinates.x]\nstart = 0.7\nacceleration = '{acceleration}'"
        ));
        let method = METHODS.iter().find(|method| method.id == "rk4").unwrap();
        let [mut lane, mut truth] =
            [Solver::Method(method), Solver::Truth].map(|solver| stepper(&law, solver));
        let mut worst = 0.0_f64;
        for tick in 0..10 * hz {
            let (t, h) = (f64::from(tick) / f64::from(hz), 1.0 / f64::from(hz));
            [&mut lane, &mut truth].into_iter().for_each(|it| it.advance(t, h, 1).unwrap());
            worst = worst.max((lane.q()[0] - truth.q()[0]).abs());
        }
        assert!(truth.truth_error().unwrap()[0] < 1e-9);
        worst
    };
    let order =
        |acceleration: &str| (error(acceleration, 25) / error(acceleration, 400)).log2() / 4.0;
    let (smooth, jumping) = (order("-x - 2*tanh(x)"), order("-x - 2*sign(x)"));
    assert!((3.7..4.5).contains(&smooth), "{smooth}");
    assert!((0.5..2.2).contains(&jumping), "{jumping}");
    let scene = parse("[[law]]\n[law.coordinates.x]\nstart = 0.7\nacceleration = '-x - 2*sign(x)'")
        .unwrap();
    let rk4 = METHODS.iter().find(|method| method.id == "rk4").unwrap();
    let verdict = Judge::new(&scene).verdict(LaneSpec::plain(rk4), 25);
    assert!(verdict.error().unwrap() > 1e-4, "{verdict}");
}

#[test]
fn the_verdict_reports_a_missing_truth_under_dry_friction_at_rest() {
    let scene =
        parse("[[law]]\n[law.coordinates.x]\nstart = 1\nacceleration = '-x - 0.3*sign(vx)'")
            .unwrap();
    let rk4 = METHODS.iter().find(|method| method.id == "rk4").unwrap();
    let verdict = Judge::new(&scene).verdict(LaneSpec::plain(rk4), 60);
    assert_eq!(verdict.to_string(), "no truth");
    let details = verdict.details();
    let said = details.last().expect("why there is none");
    assert!(said.starts_with("the true motion is not known: it sticks where"), "{said}");
    assert!(said.contains("dry friction") && said.contains("tanh(v/0.01)"), "{said}");
}

#[test]
fn a_motion_that_settles_at_a_difference_of_large_terms_keeps_its_truth() {
    let law = body(
        "[[law]]\n[law.coordinates.x]\nacceleration = '625*(2*9.81*1.2 - 1.2*9.81 - x) - 35*vx - 0.1*vx*abs(vx)'",
    );
    let mut truth = stepper(&law, Solver::Truth);
    for tick in 0..3600 {
        truth.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    assert!((truth.q()[0] - 11.772).abs() < 1e-12, "{}", truth.q()[0]);
    assert!(truth.truth_error().unwrap()[0] < 1e-10);
}
