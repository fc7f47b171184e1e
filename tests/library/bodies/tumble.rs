//! A body that turns freely in space: its exact motion, and the steps of engines and games on it.

use crate::dice::Dice;
use glam::{DQuat, DVec3};
use regatta::sim::bodies::{Body, Tumble};
use regatta::sim::integrators::{Integrator, Problem, integrator, method};
use regatta::sim::{State, System};

/// The states to 17 digits of a Taylor series in quadruple precision, of which two step sizes agree.
const ORACLE: &str = include_str!("../../data/tumble/oracle.csv");

/// Spins near the axis of the least moment, of the largest, and of the middle one, with the moments 1, 2 and 3.
const STARTS: [DVec3; 3] =
    [DVec3::new(3.0, 0.5, 0.5), DVec3::new(0.5, 0.5, 3.0), DVec3::new(0.01, 5.0, 0.01)];

type Rows = State<Vec<f64>>;

fn body(moments: impl Into<DVec3>, spin: DVec3) -> Tumble {
    let moments = moments.into();
    Tumble { moments, spin, attitude: DQuat::IDENTITY, mass: 1.0, kick: DVec3::ZERO }
}

fn plain(spin: DVec3) -> Tumble {
    body([1.0, 2.0, 3.0], spin)
}

fn coin() -> Tumble {
    body([2.725e-7, 2.725e-7, 5.4e-7], DVec3::new(2.0, 0.0, 30.0))
}

fn omega(state: &Rows) -> DVec3 {
    DVec3::new(state.v[0], state.v[1], state.v[2])
}

fn attitude(state: &Rows) -> DQuat {
    DQuat::from_xyzw(state.q[4], state.q[5], state.q[6], state.q[3]).normalize()
}

/// The angle in degrees between two attitudes.
fn apart(a: &Rows, b: &Rows) -> f64 {
    let between = attitude(a).conjugate() * attitude(b);
    2.0 * between.xyz().length().atan2(between.w.abs()).to_degrees()
}

/// L in the frame of the world.
fn momentum(body: &Tumble, state: &Rows) -> DVec3 {
    attitude(state) * (body.moments * omega(state))
}

/// A run of a method at a rate in hertz.
struct Steps {
    body: Tumble,
    problem: Problem<Vec<f64>>,
    integrator: Box<dyn Integrator<Problem<Vec<f64>>>>,
    state: Rows,
    h: f64,
    substeps: u32,
    ticks: u32,
}

impl Steps {
    fn of(body: &Tumble, id: &str, hz: f64, substeps: u32) -> Self {
        let state = body.start();
        let integrator = integrator(method(id).unwrap(), &state.q);
        let problem = regatta::sim::integrators::problem(body.clone());
        Self { body: body.clone(), problem, integrator, state, h: 1.0 / hz, substeps, ticks: 0 }
    }

    fn tick(&mut self) -> &Rows {
        let t = self.h * f64::from(self.ticks);
        self.ticks += 1;
        let Self { integrator, problem, state, h, substeps, .. } = self;
        integrator.steps(problem, t, *h, *substeps, state).expect("a step");
        &self.state
    }

    /// E/E₀ after so many seconds.
    fn energy_after(mut self, seconds: f64) -> f64 {
        while f64::from(self.ticks) * self.h < seconds - 1e-9 {
            self.tick();
        }
        self.energy()
    }

    fn energy(&self) -> f64 {
        self.body.energy(&self.state).unwrap() / self.body.energy(&self.body.start()).unwrap()
    }

    fn exact(&self) -> Rows {
        self.body.exact(self.h * f64::from(self.ticks), &self.body.start()).unwrap()
    }
}

fn energies(id: &str, seconds: f64, substeps: u32) -> [f64; 3] {
    STARTS.map(|start| Steps::of(&plain(start), id, 60.0, substeps).energy_after(seconds))
}

fn assert_near(found: f64, wanted: f64, most: f64) {
    assert!((found - wanted).abs() <= most, "{found}, not {wanted} within {most:e}");
}

#[test]
fn the_exact_motion_agrees_with_twelve_states_of_a_series_to_17_digits() {
    let mut seen = 0;
    for row in ORACLE.lines().skip(1) {
        // A name in quotes may have commas.
        let numbers = row.rsplit('"').next().unwrap();
        let numbers: Vec<f64> = numbers.split(',').skip(1).map(|x| x.parse().unwrap()).collect();
        let [i1, i2, i3, x, y, z, w, qx, qy, qz, t, rest @ ..] = &numbers[..] else {
            panic!("{row}")
        };
        let mut body = body([*i1, *i2, *i3], DVec3::new(*x, *y, *z));
        body.attitude = DQuat::from_xyzw(*qx, *qy, *qz, *w);
        let found = body.exact(*t, &body.start()).unwrap();
        let (wanted, turned) = (DVec3::from_slice(rest), &rest[3..]);
        let off = (omega(&found) - wanted).length() / wanted.length();
        let sign = if found.q[3] * turned[0] + found.q[4] * turned[1] < 0.0 { -1.0 } else { 1.0 };
        let off_q = (0..4).map(|i| (sign * found.q[3 + i] - turned[i]).abs()).fold(0.0, f64::max);
        assert!(off <= 1e-13 && off_q <= 1e-12, "{row}: {off:e}, {off_q:e}");
        seen += 1;
    }
    assert_eq!(seen, 12);
}

#[test]
fn the_exact_motion_with_equal_moments_is_an_even_turn_whatever_the_spin() {
    let mut dice = Dice::new(8107);
    let next = |moment: f64| f64::from_bits(moment.to_bits() + 1);
    for _ in 0..300 {
        let moment = dice.between(0.1, 9.0);
        let [x, y, z] = [(); 3].map(|()| dice.between(-12.0, 12.0));
        let spin = DVec3::new(x, y, z);
        let across = DVec3::new(x, y, 0.0);
        for (moments, spin) in [
            (DVec3::splat(moment), spin),
            (DVec3::new(moment, moment, 1.7 * moment), across),
            (DVec3::new(moment, moment, 0.4 * moment), across),
            (DVec3::new(moment, next(moment), next(next(moment))), spin),
            (DVec3::new(moment, moment, next(moment)), spin),
        ] {
            let body = body(moments, spin);
            let state = body.exact(3.0, &body.start()).unwrap();
            let told = format!("{moments:?}, {spin:?}");
            assert!((omega(&state) - spin).length() < 1e-11 * spin.length(), "{told}: {state:?}");
            let (sin, cos) = (1.5 * spin.length()).sin_cos();
            let even = sin * spin.normalize();
            let wanted = DQuat::from_xyzw(even.x, even.y, even.z, cos);
            assert!(1.0 - attitude(&state).dot(wanted).abs() < 1e-12, "{told}: {state:?}");
        }
    }
}

#[test]
fn on_the_separatrix_the_exact_motion_holds_for_a_thousand_seconds() {
    // L² = 2 E I₂ but for the rounding of √3, so that ω stays near the middle axis for long. The state is that of a
    // Taylor series of degree 24 with 36 digits.
    let body = plain(DVec3::new(1.7320508075688772, 1.0, 1.0));
    let found = body.exact(1000.0, &body.start()).unwrap();
    let wanted = [-0.3686982521212095, -1.9657216483731272, 0.21286803511192506];
    let turned =
        [-0.24511554299804778, 0.06005487318477288, 0.3394736400756846, -0.9061288156113885];
    let off = (omega(&found) - DVec3::from(wanted)).length();
    let off_q = (0..4).map(|i| (found.q[3 + i] - turned[i]).abs()).fold(0.0, f64::max);
    assert!(off <= 1e-12 && off_q <= 1e-12, "{off:e}, {off_q:e}");
}

#[test]
fn the_exact_motion_obeys_its_equation_and_keeps_the_sign_of_its_quaternion() {
    let third = DVec3::new(-0.3, 1.1, 2.0);
    let on_plate = body([1.0, 2.0, 3.0], DVec3::new(1.5, 2.0, 0.75_f64.sqrt()));
    let bodies = STARTS.map(plain).into_iter().chain([
        body([3.0, 1.0, 2.5], third),
        body([2.0, 2.0, 0.5], third),
        body([1.0, 1.5, 1.5], third),
        body([2.0; 3], third),
        on_plate,
        coin(),
    ]);
    for body in bodies {
        let at = |t: f64| body.exact(t, &body.start()).unwrap();
        let d = 1e-3 / body.spin.length();
        for step in 0..400 {
            let t = 0.17 * f64::from(step);
            let [before, now, after] = [at(t - d), at(t), at(t + d)];
            let mut a = now.v.clone();
            body.acceleration(t, &now.q, &now.v, &mut a);
            let fast = body.spin.length()
                * (1.0 + body.moments.max_element() / body.moments.min_element());
            for (i, a) in a.iter().enumerate() {
                let rate = (after.q[i] - before.q[i]) / (2.0 * d);
                let near = (rate - now.v[i]).abs() < 1e-5 * fast * (1.0 + now.v[i].abs());
                assert!(near, "{body:?}, {t} s, {i}: {rate}, {}", now.v[i]);
                let rate = (after.v[i] - before.v[i]) / (2.0 * d);
                assert!((rate - a).abs() < 1e-4 * fast * fast, "{body:?}, {t} s, {i}: {rate}, {a}");
            }
        }
    }
}

#[test]
fn a_kick_and_a_placement_keep_both_velocities_in_agreement() {
    use regatta::sim::{Input, Solver, stepper};
    let body = Tumble { kick: DVec3::new(0.0, 0.0, 2.0), ..plain(STARTS[0]) };
    for solver in [Solver::Truth, Solver::Method(method("rk4").unwrap())] {
        let mut stepper = stepper(body.clone(), solver);
        let agree = |q: &[f64], v: &[f64]| {
            let rate =
                DQuat::from_xyzw(q[4], q[5], q[6], q[3]) * DQuat::from_xyzw(v[0], v[1], v[2], 0.0);
            (rate * 0.5 - DQuat::from_xyzw(v[4], v[5], v[6], v[3])).length()
        };
        for _ in 0..30 {
            stepper.advance(0.0, 1.0 / 60.0, 1).unwrap();
        }
        let state = || State { q: stepper.q().to_vec(), v: stepper.v().to_vec() };
        let before = momentum(&body, &state());
        assert!(stepper.input(0.5, Input::Kick(1.0)));
        let state = State { q: stepper.q().to_vec(), v: stepper.v().to_vec() };
        let after = momentum(&body, &state);
        assert!((after - before - body.kick).length() < 1e-9, "{before}, {after}");
        assert!(agree(stepper.q(), stepper.v()) < 1e-15);
        stepper.set(
            0.5,
            &[0.0, 0.0, 0.0, 2.0, 0.0, 2.0, 0.0],
            &[1.0, 2.0, 3.0, 9.0, 9.0, 9.0, 9.0],
        );
        assert!(agree(stepper.q(), stepper.v()) < 1e-15);
        let length: f64 = stepper.q()[3..].iter().map(|x| x * x).sum();
        assert!((length - 1.0).abs() < 1e-15, "{length}");
        let (q, v) = (stepper.q().to_vec(), stepper.v().to_vec());
        stepper.set(0.5, &q, &v);
        assert_eq!((stepper.q(), stepper.v()), (&q[..], &v[..]));
    }
}

#[test]
fn a_rescaled_momentum_has_the_energy_of_rapiers_own_log_after_a_minute() {
    for (id, substeps, wanted) in [
        ("gyro-rescaled", 1, [0.708405, 1.474344, 1.000002]),
        ("engine-rapier", 4, [0.899085, 1.081465, 1.000002]),
        ("gyro-rescaled", 4, [0.899085, 1.081465, 1.000002]),
    ] {
        let found = energies(id, 60.0, substeps);
        (0..3).for_each(|i| assert_near(found[i], wanted[i], 1e-6));
    }
    // L² / (2 I₂ E₀), the energy of a spin about the middle axis.
    let found = energies("gyro-rescaled", 600.0, 1);
    assert_near(found[0], 0.597_561, 2e-5);
    assert_near(found[1], 1.481_982, 2e-5);
}

#[test]
fn a_newton_step_is_linearly_implicit_euler_and_the_step_of_bullet_and_box3d() {
    for id in ["gyro-newton", "engine-bullet", "engine-box3d"] {
        let found = energies(id, 60.0, 1);
        for (found, wanted) in found.into_iter().zip([0.861181, 0.973171, 0.402005]) {
            assert_near(found, wanted, 1e-6);
        }
    }
    for start in STARTS {
        let mut own = Steps::of(&plain(start), "gyro-newton", 60.0, 1);
        for _ in 0..600 {
            let mut general = Steps::of(&plain(start), "linearly-implicit-euler", 60.0, 1);
            general.state = own.state.clone();
            let general = omega(general.tick());
            let off = (omega(own.tick()) - general).length();
            assert!(off <= 1e-12 * start.length(), "{off:e}");
        }
    }
}

#[test]
fn an_explicit_step_gains_energy_as_mujoco_logged_and_blows_up_in_45_s() {
    for id in ["gyro-explicit", "explicit-euler", "semi-implicit-euler", "engine-mujoco"] {
        let after = |start| Steps::of(&plain(start), id, 60.0, 1).energy_after(60.0);
        assert_near(after(STARTS[0]), 4.024905, 1e-6);
        assert_near(after(STARTS[2]), 5.584288, 1e-6);
        let mut lost = Steps::of(&plain(STARTS[1]), id, 60.0, 1);
        let end = (0..2700).find(|_| {
            let fast = omega(lost.tick()).length();
            fast.is_nan() || fast >= 1e10
        });
        assert!(end.is_some_and(|tick| tick > 2670), "{id}: {end:?}");
    }
}

/// The largest |E/E₀ - 1| in ten minutes at 60 Hz.
fn worst_energy(body: &Tumble, id: &str) -> f64 {
    let mut run = Steps::of(body, id, 60.0, 1);
    (0..36_000).fold(0.0, |worst: f64, _| {
        run.tick();
        worst.max((run.energy() - 1.0).abs())
    })
}

#[test]
fn a_rotated_momentum_nearly_keeps_the_energy_and_is_exact_for_a_symmetric_top() {
    let worst = STARTS.map(|start| worst_energy(&plain(start), "gyro-rotated"));
    let most = [4e-5, 4e-4, 3e-7];
    assert!((0..3).all(|i| worst[i] <= most[i]) && worst[0] > 1e-5, "{worst:?}");
    let top = body([1.0, 1.0, 2.0], DVec3::new(0.25, 0.5, 4.0));
    for id in ["gyro-rotated", "split-3"] {
        let mut run = Steps::of(&top, id, 60.0, 1);
        (0..3600).for_each(|_| _ = run.tick());
        let (exact, found) = (run.exact(), &run.state);
        assert!((omega(&exact) - omega(found)).length() < 1e-12, "{id}: {:?}", omega(found));
        assert!(apart(&exact, found) < 1e-9, "{id}: {}", apart(&exact, found));
    }
    let mut engine = Steps::of(&plain(STARTS[0]), "gyro-rotated-engine", 60.0, 1);
    (0..3600).for_each(|_| _ = engine.tick());
    assert_near(apart(&engine.exact(), &engine.state), 0.44, 0.01);
}

#[test]
fn a_split_in_three_bounds_the_energy_and_has_the_best_attitude_of_order_2() {
    for (i, (energy, angle)) in
        [(5.3e-6, 0.017), (3.1e-6, 0.051), (6.0e-5, 0.030)].into_iter().enumerate()
    {
        let body = plain(STARTS[i]);
        assert_near(worst_energy(&body, "split-3"), energy, 0.2 * energy);
        let mut run = Steps::of(&body, "split-3", 60.0, 1);
        (0..3600).for_each(|_| _ = run.tick());
        assert_near(apart(&run.exact(), &run.state), angle, 0.05 * angle);
        let start = momentum(&body, &body.start());
        let off = (momentum(&body, &run.state) - start).length() / start.length();
        assert!(off < 1e-13, "{off:e}");
    }
}

#[test]
fn the_midpoint_and_the_discrete_top_keep_the_energy_and_lag_in_phase() {
    for (id, angle) in [("gyro-midpoint", 2.4), ("moser-veselov", 4.6)] {
        let body = plain(STARTS[0]);
        assert!(worst_energy(&body, id) <= 1e-11, "{id}");
        let mut run = Steps::of(&body, id, 60.0, 1);
        (0..3600).for_each(|_| _ = run.tick());
        assert_near(apart(&run.exact(), &run.state), angle, 0.05);
    }
}

#[test]
fn a_coin_that_spins_upright_lies_end_over_end_under_a_rescaled_momentum() {
    let start = momentum(&coin(), &coin().start()).normalize();
    // The tick of the first moment at which the axis is more than 45° from L.
    let tips = |id: &str, substeps: u32| {
        let mut run = Steps::of(&coin(), id, 60.0, substeps);
        (1..=300)
            .find(|_| (attitude(run.tick()) * DVec3::Z).angle_between(start).to_degrees() > 45.0)
    };
    for (id, substeps, energy, at) in [
        ("gyro-rescaled", 1, 1.9636, Some(35)),
        ("engine-rapier", 4, 1.8819, Some(130)),
        ("gyro-newton", 1, 0.9978, None),
        ("gyro-rotated", 1, 1.0, None),
        ("split-3", 1, 1.0, None),
    ] {
        assert_near(Steps::of(&coin(), id, 60.0, substeps).energy_after(5.0), energy, 1e-4);
        assert_eq!(tips(id, substeps), at, "{id}");
    }
    let tilt = (0..500).map(|i| {
        let exact = coin().exact(0.11 * f64::from(i), &coin().start()).unwrap();
        (attitude(&exact) * DVec3::Z).angle_between(start).to_degrees()
    });
    assert_near(tilt.fold(0.0, f64::max), 1.93, 0.05);
}

/// The gyroscopic methods, each with its order and whether it keeps L in space.
const METHODS: [(&str, f64, bool); 17] = [
    ("gyro-off", 0.0, false),
    ("gyro-explicit", 1.0, false),
    ("gyro-newton", 1.0, false),
    ("gyro-rescaled", 1.0, false),
    ("gyro-rotated", 1.0, true),
    ("gyro-rotated-engine", 1.0, false),
    ("momentum-euler", 1.0, true),
    ("buss-2", 2.0, true),
    ("buss-enhanced", 2.0, true),
    ("buss-3", 3.0, true),
    ("gyro-midpoint", 2.0, true),
    ("lie-midpoint", 2.0, true),
    ("split-3", 2.0, true),
    ("split-5", 2.0, true),
    ("moser-veselov", 2.0, true),
    ("lie-rk4", 4.0, true),
    ("gyro-rk4", 4.0, false),
];

#[test]
fn every_gyroscopic_method_has_the_order_on_its_card_in_spin_and_attitude() {
    use regatta::sim::integrators::METHODS as ALL;
    let listed: Vec<&str> = ALL.iter().filter(|it| it.is_for_spin()).map(|it| it.id).collect();
    assert_eq!(listed, METHODS.map(|(id, ..)| id));
    for (id, order, keeps_momentum) in METHODS {
        let card = method(id).unwrap();
        assert_eq!((f64::from(card.order), card.order), (order, card.order_with_drag), "{id}");
        let body = plain(STARTS[0]);
        let error = |hz: f64| {
            let mut run = Steps::of(&body, id, hz, 1);
            (0..(2.0 * hz) as u32).for_each(|_| _ = run.tick());
            let exact = run.exact();
            let turn = (momentum(&body, &run.state) - momentum(&body, &body.start())).length();
            assert_eq!(turn < 1e-12, keeps_momentum, "{id}: {turn:e}");
            [(omega(&exact) - omega(&run.state)).length(), apart(&exact, &run.state)]
        };
        let [coarse, fine] = [error(240.0), error(480.0)];
        for part in 0..2 {
            let found = (coarse[part] / fine[part]).log2();
            assert!((found - order).abs() < 0.08, "{id}, {part}: {found}, not {order}");
        }
    }
}

#[test]
fn a_step_and_a_step_back_cancel_under_exactly_the_reversible_methods() {
    for (id, ..) in METHODS {
        let mut run = Steps::of(&plain(STARTS[0]), id, 30.0, 1);
        let before = run.state.clone();
        run.tick();
        run.h = -run.h;
        run.tick();
        let off = (omega(&before) - omega(&run.state)).length();
        let is_reversible = method(id).unwrap().reversible || id == "gyro-off";
        assert_eq!(off < 1e-13, is_reversible, "{id}: {off:e}");
    }
}

#[test]
fn a_gyroscopic_method_refuses_other_bodies_and_an_engine_without_a_map_this_one() {
    use regatta::sim::bodies::{Spring, incompatibility, kind};
    use regatta::sim::integrators::{METHODS as ALL, StepFailure};
    let spring = Spring { mass: 1.0, stiffness: 40.0, damping: 0.0, x0: 1.0, v0: 0.0, kick: 1.0 };
    for (id, ..) in METHODS {
        let card = method(id).unwrap();
        let reason = incompatibility(card, kind("spring").unwrap(), &[1.0; 6]).unwrap();
        let mut refusing = integrator(card, &0.0);
        let step = refusing.step(&spring, 0.0, 0.1, &mut State { q: 1.0, v: 0.0 });
        assert_eq!(step, Err(StepFailure::Refused { reason }));
    }
    let tumble = kind("tumble").unwrap();
    for card in ALL.iter().filter(|card| card.is_engine() || card.follower.is_some()) {
        let refused = incompatibility(card, tumble, &tumble.plain_values());
        let has_map = card.engine.is_some_and(|engine| engine.free_spin.is_some());
        assert_eq!(refused.is_none(), has_map, "{}", card.id);
    }
}

#[test]
fn a_law_of_three_turns_has_the_spin_of_the_body_and_a_kinetic_energy() {
    use regatta::scene::Scene;
    let turn = |name: &str, a: &str, start: f64| {
        format!(
            "[law.coordinates.{name}]\nunit = 'rad'\nacceleration = '{a}'\nstart_velocity = {start}\n"
        )
    };
    let text = "title = 'a rotor'\ntick_hz = 60\nseconds = 5\nmethods = ['rk4']\n[[law]]\n\
                constants = { A = 1.0, B = 2.0, C = 3.0 }\n\
                energy = '(A*va*va + B*vb*vb + C*vc*vc)/2'\n"
        .to_owned()
        + &turn("a", "(B - C)/A*vb*vc", 3.0)
        + &turn("b", "(C - A)/B*vc*va", 0.5)
        + &turn("c", "(A - B)/C*va*vb", 0.5);
    let scene = Scene::parse("rotor.toml", &text).unwrap_or_else(|errors| panic!("{errors}"));
    let law = &scene.bodies[0];
    for id in ["explicit-euler", "rk4", "linearly-implicit-euler"] {
        let solver = regatta::sim::Solver::Method(method(id).unwrap());
        let mut rotor = (law.kind.build)(&law.values, solver);
        let mut run = Steps::of(&plain(STARTS[0]), id, 60.0, 1);
        for tick in 0..300 {
            rotor.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
            let off = (DVec3::from_slice(rotor.v()) - omega(run.tick())).length();
            assert!(off < 1e-9, "{id} at tick {tick}: {off:e}");
        }
    }
}

/// The verdict on a method on a built-in scene, at 60 Hz.
fn verdict(scene: &str, id: &str) -> String {
    use regatta::measure::Judge;
    use regatta::scene::{LaneSpec, Scene};
    let judge = Judge::new(&Scene::built_in(scene).unwrap());
    judge.verdict(LaneSpec::plain(method(id).unwrap()), 60).to_string()
}

#[test]
fn a_verdict_tells_whether_a_body_tips_over_flips_and_keeps_its_energy() {
    let wanted = [
        ("coin", "gyro-off", "inaccurate · its L turns 3.8° in space"),
        ("coin", "gyro-rescaled", "grows · tips over at 0.6 s, energy ×1.96 in 5 s"),
        ("coin", "engine-rapier", "grows · tips over at 2.17 s, energy ×1.88 in 5 s"),
        ("long-box", "engine-rapier", "dies away · tips over at 2.95 s, energy ×0.259 in 5 s"),
        ("long-box", "gyro-rotated-engine", "looks right · its L turns 8.2° in space"),
        ("phone", "gyro-off", "inaccurate · never flips"),
        ("phone", "engine-bullet", "dies away · loses 76 % of its energy in 10 s"),
        ("phone", "gyro-rescaled", "inaccurate · flips 4 times instead of 6"),
        ("t-handle", "split-3", "looks right · flips up to 5.5 ms too late"),
        ("gyro", "gyro-rescaled", "grows · tips over at 1.97 s, energy ×1.77 in 10 s"),
        ("gyro", "gyro-off", "looks right · off by 8.3° at 9.6 s"),
    ];
    let found = wanted.map(|(scene, id, _)| (scene, id, verdict(scene, id)));
    let found = found.each_ref().map(|(scene, id, said)| (*scene, *id, &**said));
    assert_eq!(found, wanted, "{found:#?}");
    for scene in ["coin", "long-box", "gyro"] {
        assert!(verdict(scene, "split-3").starts_with("accurate · within "), "{scene}");
    }
}

#[test]
fn metrics_compare_the_attitude_and_the_momentum_of_a_lane_with_the_truth() {
    use regatta::run::{METRICS, Race};
    use regatta::scene::Scene;
    let measured = |scene: &str, id: &str, metric: &str| {
        let mut scene = Scene::built_in(scene).unwrap();
        scene.lanes = vec![regatta::scene::LaneSpec::plain(method(id).unwrap())];
        let mut race = Race::of_scene(&scene);
        race.run(60);
        let [lane, truth] = [&race.entrants()[0].lane, race.truth()].map(|lane| &lane.bodies()[0]);
        let metric = METRICS.iter().find(|it| it.id == metric).unwrap();
        (metric.measure)(lane, truth)
    };
    let near = |id: &str, metric: &str, wanted: f64, most: f64| {
        assert_near(measured("coin", id, metric).unwrap(), wanted, most);
    };
    // The energy of a body whose energy is all kinetic is compared with the whole.
    near("gyro-rescaled", "energy_drift", 82.26, 0.01);
    near("gyro-rescaled", "momentum_length", 0.0, 1e-9);
    near("split-3", "attitude_error", 0.0, 1e-9);
    near("split-3", "axis_error", 0.0, 1e-9);
    near("split-3", "momentum_turn", 0.0, 1e-9);
    near("gyro-newton", "momentum_length", -0.1, 0.1);
    assert!(measured("coin", "gyro-rescaled", "attitude_error").unwrap() > 0.5);
    assert!(measured("coin", "gyro-off", "momentum_turn").unwrap() > 0.01);
    assert_eq!(measured("spring", "rk4", "attitude_error"), None);
}
