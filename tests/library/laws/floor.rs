//! Events of laws: walls at which velocities turn, with a truth that stays above them.

use regatta::measure::{Judge, Outcome};
use regatta::run::Lane;
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::integrators::method;
use regatta::sim::{IMPACTS, Solver, Stepper, impact, own_method};
use regatta::studio::Studio;

use super::{body, parse, stepper};
use crate::dice::Dice;

fn falling(start: &str, acceleration: &str, e: f64, floor: &str) -> String {
    format!(
        "[[law]]\ndraw = 'vertical'\nconstants = {{ g = 9.81, e = {e} }}\n[law.coordinates.y]\n{start}\n\
         acceleration = '{acceleration}'\n[law.events.floor]\nwhen = '{floor}'\nthen = {{ vy = '-e*vy' }}\n"
    )
}

fn after(text: &str, solver: Solver, seconds: f64, hz: u32) -> Box<dyn Stepper> {
    let mut body = stepper(&body(text), solver);
    let h = 1.0 / f64::from(hz);
    for tick in 0..(seconds * f64::from(hz)).round() as u32 {
        let t = f64::from(tick) * h;
        body.advance(t, h, 1).unwrap_or_else(|end| panic!("{end} at {t} s: {text}"));
    }
    body
}

fn under(id: &str, rule: &str) -> Solver {
    Solver::Bouncing(method(id).unwrap(), None, impact(rule).unwrap())
}

#[test]
fn the_truth_of_a_law_has_the_states_of_sixty_digits() {
    let fall = |height: f64, e| falling(&format!("start = {height:?}"), "-g", e, "y");
    let drag = |height: f64, c, e| {
        falling(&format!("start = {height:?}"), &format!("-g - {c}*vy"), e, "y")
    };
    let spring = |y: f64, v: f64, w2: f64, yc: f64, e| {
        let start = format!("start = {y:?}\nstart_velocity = {v:?}");
        falling(&start, &format!("-{w2}*(y - ({yc:?}))"), e, "y")
    };
    let paddle = |height: f64, a: f64, w: f64, e: f64| {
        format!(
            "[[law]]\nconstants = {{ g = 9.81, e = {e}, a = {a}, w = {w:?} }}\n[law.coordinates.y]\n\
             start = {height:?}\nacceleration = '-g'\n[law.events.floor]\nwhen = 'y - a*sin(w*t)'\n\
             then = {{ vy = 'a*w*cos(w*t) - e*(vy - a*w*cos(w*t))' }}\n"
        )
    };
    for (text, t, [y, v], within) in [
        (fall(1.0, 1.0), 10.0, [0.9783219754044378, -0.6521678024595587], 1e-12),
        (fall(10.0, 0.8), 5.0, [3.4106847818149406, -3.666863043637011], 1e-12),
        (fall(1.0, 0.8), 4.0, [7.767499142784655e-05, 0.050506744527476645], 1e-12),
        (drag(10.0, "0.1", 0.8), 5.0, [1.0198423469751812, -6.203821600789726], 1e-12),
        (drag(1.0, "0.5", 1.0), 10.0, [0.010899401813355422, -0.7029969319846174], 1e-11),
        (spring(1.0, 0.0, 16.0, -0.5, 0.9), 6.0, [0.00705759628652531, -1.5616682372482382], 1e-11),
        (spring(0.2, 2.0, 9.0, 0.5, 0.7), 6.0, [0.9479122343975774, -0.8634541750971654], 1e-11),
        (paddle(0.3, 0.02, 20.0, 0.8), 3.0, [0.14880881022552925, 0.49034552235131185], 1e-11),
        (paddle(1.0, 0.01, 31.4159, 0.9), 5.0, [0.0733436137829591, 2.724057655941789], 1e-11),
    ] {
        let truth = after(&text, Solver::Truth, t, 60);
        let [dy, dv] = [truth.q()[0] - y, truth.v()[0] - v];
        assert!(dy.abs() <= within && dv.abs() <= 10.0 * within, "{text}: {dy:e}, {dv:e}");
        let error = truth.truth_error().unwrap();
        assert!(dy.abs() <= error[0] && error[0] < 1e-9, "{text}: {dy:e}, said {error:?}");
    }
}

#[test]
fn the_truth_of_a_law_rests_and_never_falls_through_its_floor() {
    let text = falling("start = 2.0", "-g", 0.8, "y - 1");
    let mut truth = stepper(&body(&text), Solver::Truth);
    for tick in 0..600 {
        truth.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
        assert!(truth.q()[0] >= 1.0, "{tick}: {}", truth.q()[0]);
        assert_eq!(truth.q()[0] == 1.0 && truth.v()[0] == 0.0, tick >= 243, "{tick}");
    }
    // A push lifts it from its rest.
    let text = falling("start = 0.5", "-g + 20*max(t - 1, 0)", 0.1, "y");
    assert_eq!(after(&text, Solver::Truth, 1.49, 100).q()[0], 0.0);
    let lifted = after(&text, Solver::Truth, 2.0, 60).q()[0];
    let wanted = 20.0 / 6.0 * (2.0_f64 - 1.4905).powi(3);
    assert!((lifted - wanted).abs() < 1e-10, "{lifted}, not {wanted}");
    for it in IMPACTS.iter().filter(|it| it.id.starts_with("locate")) {
        let rests = after(&text, under("rk4", it.id), 1.49, 100);
        assert_eq!(rests.q()[0], 0.0, "{it:?}");
    }
}

#[test]
fn a_law_bounces_as_the_ball_does_to_the_bit() {
    let mut dice = Dice::new(0x82_f100);
    for it in IMPACTS
        .iter()
        .filter(|it| !["none", "penalty"].contains(&it.id) && !it.id.starts_with("engine"))
    {
        for id in ["velocity-verlet", "semi-implicit-euler", "rk4"] {
            let (height, e) = (dice.between(0.5, 2.0), dice.between(0.5, 1.0));
            let start = format!("start = {height:?}\nstart_velocity = 0.1");
            let law = after(&falling(&start, "-g - 0.05*vy", e, "y"), under(id, it.id), 4.0, 60);
            let ball = format!(
                "[[ball]]\nheight_m = {height:?}\nspeed_m_per_s = 0.1\nrestitution = {e:?}\ndrag_per_s = 0.05"
            );
            let ball = after(&ball, under(id, it.id), 4.0, 60);
            let bits = |it: &dyn Stepper| [it.q()[0], it.v()[0]].map(f64::to_bits);
            assert_eq!(bits(&*law), bits(&*ball), "{it:?} under {id}");
            assert_eq!(law.bounces(), ball.bounces());
        }
    }
}

#[test]
fn a_law_knows_its_true_bounces() {
    let text = falling("start = 1.0\nstart_velocity = 0.1", "-g", 0.8, "y");
    let truth = stepper(&body(&text), Solver::Truth);
    let ball = stepper(&body("[[ball]]\nheight_m = 1.0\nspeed_m_per_s = 0.1"), Solver::Truth);
    for n in 0..12 {
        let [own, exact] = [&truth, &ball].map(|of| of.true_bounce(n).unwrap());
        assert!((own[0] - exact[0]).abs() < 1e-12, "{n}: {own:?}, not {exact:?}");
        assert!(
            (own[1] - exact[1]).abs() < 1e-11 || own[1].is_nan(),
            "{n}: {own:?}, not {exact:?}"
        );
    }
}

#[test]
fn the_truth_goes_on_where_an_impact_turns_a_drag_by_the_square_of_the_speed() {
    let (g, k, e) = (9.81_f64, 0.05_f64, 0.8);
    let fastest = (g / k).sqrt();
    // Each flight by hand: the time up, the height, and the time and the speed of the fall.
    let (mut at_s, mut height, mut wanted) = (0.0, 2.0_f64, Vec::new());
    for _ in 0..5 {
        at_s += fastest / g * (k * height).exp().acosh();
        let up = e * fastest * (1.0 - (-2.0 * k * height).exp()).sqrt();
        height = (up * up / (fastest * fastest)).ln_1p() / (2.0 * k);
        wanted.push([at_s, height]);
        at_s += fastest / g * (up / fastest).atan();
    }
    for drag in ["vy*abs(vy)", "vy*max(vy, -vy)", "sign(vy)*vy^2", "if(vy > 0, vy^2, -vy^2)"] {
        let text = falling("start = 2.0", &format!("-g - {k}*{drag}"), e, "y");
        for hz in [30, 240] {
            let truth = after(&text, Solver::Truth, 4.0, hz);
            assert!(truth.truth_error().unwrap()[0] < 1e-9, "{drag} at {hz} Hz");
            for (n, [t, top]) in (1..).zip(&wanted) {
                let [own_t, own_top] = truth.true_bounce(n).unwrap();
                let off = (own_t - t).abs().max((own_top - top).abs());
                assert!(off < 1e-10, "{drag}, impact {n}: {own_t} s, {own_top}, not {t} s, {top}");
            }
        }
    }
}

#[test]
fn a_flight_that_a_second_wall_ends_has_no_height() {
    let walls = |g: &str| {
        format!(
            "[[law]]\n[law.coordinates.y]\nstart = 0.7\nstart_velocity = -4.3\nacceleration = '{g}'\n\
             [law.events.floor]\nwhen = 'y'\nthen = {{ vy = '-0.9*vy' }}\n[law.events.top]\nwhen = 'y - 2.5'\n\
             falling = false\nthen = {{ vy = '-0.9*vy' }}\n"
        )
    };
    let free = stepper(&body(&walls("0")), Solver::Truth);
    let (mut at_s, mut speed) = (0.7 / 4.3, 4.3);
    for n in 1..8 {
        let [own_s, height] = free.true_bounce(n).unwrap();
        assert!((own_s - at_s).abs() < 1e-12 && height.is_nan(), "{n}: {own_s} s, {height}");
        speed *= 0.9;
        at_s += 2.5 / speed;
    }
    // Up to 0.76 of the way at first, and none later.
    let heavy = stepper(&body(&walls("-2")), Solver::Truth);
    assert!(heavy.true_bounce(1).unwrap()[1].is_nan());
    let last = (2..20).find_map(|n| heavy.true_bounce(n).filter(|[_, height]| height.is_finite()));
    assert!(last.is_some_and(|[_, height]| (0.5..2.5).contains(&height)), "{last:?}");
}

#[test]
fn a_law_that_starts_beyond_its_wall_is_refused() {
    let floor = |start: &str| parse(&falling(&format!("start = {start}"), "-g", 0.8, "y - 2"));
    let fault = floor("1.3").unwrap_err().to_string();
    assert!(
        fault.contains("starts beyond `floor`") && fault.contains("falling = false"),
        "{fault}"
    );
    assert!(floor("2").is_ok());
}

#[test]
fn the_bounces_on_a_paddle_end_where_the_truth_does_not_know_itself() {
    let text = "[[law]]\nconstants = { g = 9.81, e = 0.9, a = 0.01, w = 60 }\n[law.coordinates.y]\nstart = 0.3\n\
                acceleration = '-g'\n[law.events.paddle]\nwhen = 'y - a*sin(w*t)'\n\
                then = { vy = 'a*w*cos(w*t) - e*(vy - a*w*cos(w*t))' }\n";
    let truth = stepper(&body(text), Solver::Truth);
    let known = (1..200).take_while(|n| truth.true_bounce(*n).is_some()).count() as u64;
    let [last_s, _] = truth.true_bounce(known).unwrap();
    assert!((10..30).contains(&known) && (4.0..12.0).contains(&last_s), "{known}: {last_s} s");
    let errors = [3.0, 12.0].map(|t| after(text, Solver::Truth, t, 60).truth_error().unwrap()[0]);
    assert!(errors[0] < 1e-9 && errors[1] > 1e-3, "{errors:?}");
}

#[test]
fn a_floor_that_sinks_is_not_sunk_through_and_one_that_swings_has_true_apexes() {
    let lift = "[[law]]\n[law.coordinates.y]\nstart = 0.1\nacceleration = '-9.81'\n[law.events.lift]\n\
                when = 'y + 0.5*t'\nthen = { vy = '-0.5 - 0.5*(vy + 0.5)' }\n";
    let scene = parse(lift).unwrap_or_else(|errors| panic!("{errors}"));
    let lane = LaneSpec::plain(method("velocity-verlet").unwrap());
    let verdict = Judge::over(&scene, 10.0).verdict(lane, 60);
    assert_eq!(verdict.outcome(), Outcome::Accurate, "{verdict}");
    let end = after(lift, under("velocity-verlet", "locate"), 8.0, 60);
    assert!((end.q()[0] + 4.0).abs() < 1e-9 && end.bounces().unwrap().distance.abs() < 1e-9);

    // A flight of 0.29 s between the impacts of the truth: its top by hand.
    let paddle = "[[law]]\n[law.coordinates.y]\nstart = 0.3\nacceleration = '-9.81'\n[law.events.paddle]\n\
                  when = 'y - 0.01*sin(60*t)'\nthen = { vy = '0.6*cos(60*t) - 0.8*(vy - 0.6*cos(60*t))' }\n";
    let truth = after(paddle, Solver::Truth, 0.5, 60);
    let [[t0, apex], [t1, _]] = [1, 2].map(|impact| truth.true_bounce(impact).unwrap());
    let [y0, y1] = [t0, t1].map(|t| 0.01 * (60.0 * t).sin());
    let up = (y1 - y0) / (t1 - t0) + 9.81 / 2.0 * (t1 - t0);
    let top = y0 + up * up / (2.0 * 9.81);
    assert!((apex - top).abs() < 1e-9, "{apex}, not {top}");
    let lane = after(paddle, under("velocity-verlet", "locate"), 0.5, 60);
    let own = lane.bounces().unwrap();
    assert_eq!(own.apex_after, 1);
    assert!((own.apex.unwrap() - top).abs() < 1e-9, "{own:?}, not {top}");
}

#[test]
fn a_floor_that_throws_a_ball_at_each_swing_has_true_impacts_and_apexes() {
    let ball = |keys: &str| {
        format!("[[ball]]\nheight_m = 0.3\nspeed_m_per_s = 0.0\nfloor_amplitude_m = 0.03\n{keys}\n")
    };
    let truth = after(&ball("restitution = 0.0\nfloor_frequency_hz = 4.0"), Solver::Truth, 3.0, 60);
    // By hand: the floor lets the ball go where it falls faster than the ball.
    let (a, w, g) = (0.03_f64, 4.0 * std::f64::consts::TAU, 9.81);
    let start = (g / (a * w * w)).asin() / w;
    let (y0, v0) = (a * (w * start).sin(), a * w * (w * start).cos());
    let above = |s: f64| y0 + v0 * s - g / 2.0 * s * s - a * (w * (start + s)).sin();
    let (mut low, mut high) = (0.1, 0.25);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if above(middle) > 0.0 { low = middle } else { high = middle }
    }
    for n in 2..8 {
        let [at_s, apex] = truth.true_bounce(n).unwrap();
        let wanted = start + low + 0.25 * (n - 1) as f64;
        assert!((at_s - wanted).abs() < 1e-9, "{n}: {at_s} s, not {wanted}");
        assert!((apex - (y0 + v0 * v0 / (2.0 * g))).abs() < 1e-9, "{n}: {apex} m");
    }
    // Flights as low as the rounding of the time are none.
    let kick = format!(
        "{}[[command]]\nat_s = 4.0\nkick = 1.2\n",
        ball("restitution = 0.3\nfloor_frequency_hz = 2.0")
    );
    let mut studio = Studio::new(parse(&kick).unwrap());
    (0..480).for_each(|_| studio.tick());
    assert!(studio.race().t() > 7.9 && studio.race().truth().halted().is_none());
}

#[test]
fn a_body_that_sticks_to_a_second_wall_that_swings_meets_it_no_more() {
    let law = "[[law]]\n[law.coordinates.y]\nstart = 0.3\nacceleration = '-9.81'\n\
               [law.events.far]\nwhen = 'y + 5'\nthen = { vy = '-0.3*vy' }\n\
               [law.events.near]\nwhen = 'y - 0.01*sin(12*t)'\n\
               then = { vy = '0.12*cos(12*t) - 0.3*(vy - 0.12*cos(12*t))' }\n";
    let end = after(law, under("rk4", "locate"), 10.0, 60);
    let impacts = end.bounces().unwrap().impacts;
    assert!((4..30).contains(&impacts), "{impacts}");
}

#[test]
fn a_law_with_a_floor_is_framed_by_its_bounces() {
    let scene = parse(&falling("start = 1", "-g", 0.8, "y")).unwrap();
    let lane = Lane::new(&scene, under("velocity-verlet", "locate"), 1);
    let [(low, high)] = lane.bodies()[0].preview().ranges[..] else { panic!("one coordinate") };
    assert!((-1e-9..0.1).contains(&low) && high == 1.0, "{low} to {high}");
}

#[test]
fn lines_with_a_floor_of_their_own_need_a_law_with_one() {
    let lines = "v += a(x, v)*h; x += v*h; if x < 0 { x = 0; v = -0.8*v }";
    let method = own_method("floored", lines).unwrap();
    let scene = |events: bool| -> Scene {
        let text = falling("start = 1.0", "-g", 0.8, "y");
        parse(if events { &text } else { text.split("[law.events").next().unwrap() }).unwrap()
    };
    assert!(method.has_own_floor);
    assert_eq!(LaneSpec::plain(method).impact.id, "none");
    let incompatible = |scene: &Scene| {
        let body = &scene.bodies[0];
        regatta::sim::bodies::incompatibility(method, &body.kind, &body.values)
    };
    assert_eq!(incompatible(&scene(true)), None);
    assert!(incompatible(&scene(false)).unwrap().contains("[law.events.floor]"));
}

#[test]
fn events_that_are_no_walls_are_refused_with_a_remedy() {
    let event = |lines: &str| {
        format!(
            "[[law]]\nconstants = {{ g = 9.81 }}\n[law.coordinates.y]\nstart = 1\nacceleration = '-g'\n{lines}\n"
        )
    };
    let floor = |lines: &str| event(&format!("[law.events.floor]\n{lines}"));
    let then = "then = { vy = '-0.8*vy' }";
    let many: String =
        (0..9).map(|n| format!("[law.events.e{n}]\nwhen = 'y + {n}'\n{then}\n")).collect();
    for (text, words) in [
        (floor("when = 'y'"), "`then`"),
        (floor(&format!("when = 'g'\n{then}")), "depends on no coordinate"),
        (floor(&format!("when = 'y^2 - 1'\n{then}")), "no wall"),
        (floor(&format!("when = 'vy'\n{then}")), "does not depend on `vy`"),
        (floor(&format!("when = 't*y'\n{then}")), "evenly"),
        (
            floor("when = 'y'\nthen = { vz = '-vy' }"),
            "no velocity is called `vz`; write one of `vy`",
        ),
        (floor("when = 'y'\nthen = { vy = '0.8*vy' }"), "still falling; write `vy = \"-e*vy\"`"),
        (floor("when = 'y'\nthen = {}"), "empty"),
        (floor("when = 'y'\nthen = { vy = '-e*vy' }"), "`e`"),
        (event(&many), "keep at most 8"),
        (
            floor(&format!("when = 'y'\n{then}"))
                .replace("start = 1", "start = 1\nexact = '1 - g*t^2/2'"),
            "would pass through",
        ),
    ] {
        let errors = parse(&text).err().unwrap_or_else(|| panic!("not refused: {text}"));
        assert!(errors.contains(words), "{words}: {errors}");
    }
    let energy = |energy: &str| {
        let text = falling("start = 1", "-g", 1.0, "y")
            .replace("[law.coord", &format!("{energy}\n[law.coord"));
        parse(&format!("method = 'rk4'\n[[lane]]\nmethod = 'rk4'\nimpact = 'energy'\n{text}"))
    };
    assert!(energy("").unwrap_err().contains("needs the `energy`"));
    assert!(energy("energy = 'vy^2/2 + g*y'").is_ok());
    let for_all = format!("impact = 'energy'\n{}", falling("start = 1", "-g", 1.0, "y"));
    assert!(parse(&for_all).unwrap_err().contains("needs the `energy`"));
    // A law that never reaches its wall is a law.
    assert!(parse(&floor(&format!("when = 'y + 9000'\n{then}"))).is_ok());
}

#[test]
fn a_scene_with_events_is_written_as_it_was_read() {
    let text = falling("start = 3.0", "-g", 0.8, "y")
        .replace("then", "falling = false\nthen")
        .replace("when = 'y'", "when = '1 - y/2'");
    let scene = parse(&text).unwrap_or_else(|errors| panic!("{errors}"));
    let written = scene.to_toml();
    let again = Scene::parse("again.toml", &written).unwrap();
    assert_eq!((again.to_toml(), &again.bodies[0].kind), (written.clone(), &scene.bodies[0].kind));
    assert!(written.contains("[law.events.floor]") && written.contains("falling = false"));
}
