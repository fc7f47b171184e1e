//! Verdicts and advice on random scenes, compared with plain simulation: the library's steppers, and none of the code that
//! judges. The seed is printed; `REGATTA_SEED` sets another.

use crate::dice::Dice;
use regatta::measure::{Adviser, CRITERIA, Judge, Measure, Outcome, Verdict};
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::bodies::{Input, Truth};
use regatta::sim::integrators::GENERAL_METHODS;
use regatta::sim::{Solver, Stepper};

impl Dice {
    /// As likely in every decade.
    fn scaled(&mut self, low: f64, high: f64) -> f64 {
        (self.between(low.ln(), high.ln())).exp()
    }

    fn one_of<T: Copy>(&mut self, things: &[T]) -> T {
        things[self.below(things.len())]
    }
}

const KINDS: [&str; 6] = ["spring", "chain", "pendulum", "orbit", "ship", "helm"];

/// A random legal scene of one body of this kind.
fn scene(dice: &mut Dice, kind: &str) -> String {
    let seconds = dice.between(5.0, 25.0);
    let mut text =
        format!("title = \"random\"\ntick_hz = 60\nseconds = {seconds:.3}\n[[{kind}]]\n");
    let mut set = |key: &str, value: f64| text += &format!("{key} = {value:e}\n");
    match kind {
        "spring" => {
            let (m, k) = (dice.scaled(0.1, 100.0), dice.scaled(1.0, 1e4));
            set("mass_kg", m);
            set("stiffness_n_per_m", k);
            if dice.part() < 0.4 {
                set("damping_n_s_per_m", dice.scaled(0.001, 3.0) * (m * k).sqrt());
            }
            set("x0_m", dice.between(-2.0, 2.0));
            set("v0_m_per_s", dice.between(-2.0, 2.0) * (k / m).sqrt());
        }
        "chain" => {
            let masses = dice.one_of(&[2.0, 3.0, 5.0, 8.0]);
            text += &format!("masses = {masses}\nplucked_mass = {}\n", dice.one_of(&[1, 2]));
            let mut set = |key: &str, value: f64| text += &format!("{key} = {value:e}\n");
            let (m, k) = (dice.scaled(0.1, 10.0), dice.scaled(1.0, 1e3));
            set("mass_kg", m);
            set("stiffness_n_per_m", k);
            if dice.part() < 0.3 {
                set("damping_n_s_per_m", dice.scaled(0.001, 1.0) * (m * k).sqrt());
            }
            set("x0_m", dice.between(0.2, 2.0));
        }
        "pendulum" => {
            set("length_m", dice.scaled(0.2, 5.0));
            set("theta0_rad", dice.between(0.1, 3.0));
            if dice.part() < 0.25 {
                set("damping_n_m_s", dice.scaled(0.01, 1.0));
            }
        }
        "orbit" => {
            let (mu, r): (f64, f64) = (dice.scaled(10.0, 1e4), dice.scaled(3.0, 30.0));
            set("mu_m3_per_s2", mu);
            set("x0_m", r);
            set("vy0_m_per_s", dice.between(0.5, 1.3) * (mu / r).sqrt());
        }
        "ship" => {
            set("thrust_n", dice.scaled(100.0, 1e5));
            set("drag_n_s_per_m", if dice.part() < 0.8 { dice.scaled(10.0, 1e4) } else { 0.0 });
            set("mass_kg", dice.scaled(100.0, 1e5));
            set("v0_m_per_s", dice.between(0.0, 10.0));
        }
        _ => {
            let mass = dice.scaled(1e4, 1e5);
            set("mass_kg", mass);
            set("inertia_kg_m2", 40.0 * mass);
            set("drag_n_s_per_m", dice.scaled(0.01, 0.1) * mass);
            set("side_drag_n_s_per_m", dice.scaled(0.5, 5.0) * mass);
            set("yaw_drag_n_m_s", dice.scaled(10.0, 100.0) * mass);
            set("rudder_n_s", mass);
            set("u0_m_per_s", dice.between(1.0, 8.0));
            text += "thrust_curve = [[0.0, 40000.0], [20.0, 8000.0]]\n";
        }
    }
    text
}

fn stepper(scene: &Scene, solver: Solver) -> Box<dyn Stepper> {
    let body = &scene.bodies[0];
    let mut stepper = (body.kind.build)(&body.values, solver);
    stepper.input(0.0, Input::Throttle(1.0));
    stepper
}

fn components(stepper: &dyn Stepper) -> Vec<f64> {
    [stepper.q(), stepper.v()].concat()
}

/// Half the range of each component over the scene, in dense steps; components of one unit share the largest.
fn amplitudes(scene: &Scene) -> Vec<f64> {
    const STEPS: u32 = 40_000;
    let mut truth = stepper(scene, Solver::Truth);
    let mut ranges: Vec<(f64, f64)> = components(&*truth).iter().map(|&x| (x, x)).collect();
    let h = scene.seconds / f64::from(STEPS);
    for step in 0..STEPS {
        truth.advance(h * f64::from(step), h, 1).unwrap();
        for (range, x) in ranges.iter_mut().zip(components(&*truth)) {
            *range = (range.0.min(x), range.1.max(x));
        }
    }
    let body = &scene.bodies[0];
    let coordinates: Vec<_> = body.kind.coordinates(&body.values).iter().collect();
    let n = coordinates.len();
    let half = |i: usize| {
        let like = (0..n).filter(|&j| coordinates[j].unit == coordinates[i % n].unit);
        let of = |j: usize| ranges[i / n * n + j];
        let half = like.clone().map(|j| (of(j).1 - of(j).0) / 2.0).fold(0.0, f64::max);
        let size = like.map(|j| of(j).0.abs().max(of(j).1.abs())).fold(0.0, f64::max);
        if half > 1e-9 * size {
            half
        } else if size > 0.0 {
            size
        } else {
            1.0
        }
    };
    (0..2 * n).map(half).collect()
}

/// The measurements of a plain run.
struct Plain {
    /// The largest error over the scene, in amplitudes; infinite where the lane failed.
    error: f64,
    /// Each component at every tick of ten scenes, up to the lane's failure.
    failed_at: Option<f64>,
    q: Vec<f64>,
    reach: Vec<f64>,
    energy: Vec<f64>,
}

fn plain(scene: &Scene, spec: LaneSpec, tick_hz: u32, amplitudes: &[f64], scenes: f64) -> Plain {
    let mut lane = stepper(scene, spec.solver());
    let mut truth = stepper(scene, Solver::Truth);
    let hz = f64::from(tick_hz);
    let horizon = (scene.seconds * hz + 1e-6).floor() as u64;
    let n = lane.q().len();
    let farthest = farthest_of_orbit(scene, &*lane);
    let mut plain = Plain { error: 0.0, failed_at: None, q: vec![], reach: vec![], energy: vec![] };
    let end = ((scene.seconds * scenes * hz) as u64).max(horizon);
    for tick in 0..end {
        let t = tick as f64 / hz;
        let done = lane.advance(t, 1.0 / hz, spec.substeps);
        let here = components(&*lane);
        if done.is_err() || !here.iter().all(|x| x.abs() <= 1e38) {
            plain.failed_at = Some(t);
            if tick < horizon {
                plain.error = f64::INFINITY;
            }
            break;
        }
        if tick < horizon {
            truth.advance(t, 1.0 / hz, 1).unwrap();
            let exact = components(&*truth);
            for ((x, exact), amplitude) in here.iter().zip(exact).zip(amplitudes) {
                plain.error = plain.error.max((x - exact).abs() / amplitude);
            }
        }
        plain.q.push(here[0]);
        let parts = here[..n].iter().zip(amplitudes).map(|(x, amplitude)| x.abs() / amplitude);
        plain.reach.push(match farthest {
            Some(farthest) => here[0].hypot(here[1]) / farthest,
            None => parts.fold(0.0, f64::max),
        });
        plain.energy.extend(lane.energy());
    }
    plain
}

/// The farthest distance of an orbit that starts across the way to its centre; `None` of another body.
fn farthest_of_orbit(scene: &Scene, start: &dyn Stepper) -> Option<f64> {
    let body = scene.bodies.first().filter(|body| body.kind.id == "orbit")?;
    let (r, v) = (start.q()[0], start.v()[1]);
    let semi_major = 1.0 / (2.0 / r - v * v / body.values[0]);
    Some(r.max(2.0 * semi_major - r))
}

/// Crossings of zero upwards, in ticks.
fn crossings(q: &[f64]) -> Vec<f64> {
    let ups = (0..q.len().saturating_sub(1)).filter(|&i| q[i] < 0.0 && q[i + 1] >= 0.0);
    ups.map(|i| i as f64 + q[i] / (q[i] - q[i + 1])).collect()
}

/// The claims of a verdict that a plain run contradicts.
fn lies(scene: &Scene, spec: LaneSpec, tick_hz: u32, verdict: &Verdict) -> Vec<String> {
    let amplitudes = amplitudes(scene);
    let kind = &scene.bodies[0].kind;
    let plain = plain(scene, spec, tick_hz, &amplitudes, 10.0);
    let hz = f64::from(tick_hz);
    let mut lies = Vec::new();
    let mut check = |holds: bool, what: String| {
        if !holds {
            lies.push(what);
        }
    };
    let near = |a: f64, b: f64, part: f64| (a - b).abs() <= part * b.abs();
    match verdict.outcome() {
        Outcome::NotJudged | Outcome::NoTruth => return lies,
        Outcome::BlewUp | Outcome::GaveUp => {
            check(plain.error.is_infinite(), "it came through".into());
            return lies;
        }
        _ => {}
    }
    let rounding = if kind.truth == Truth::Exact { 1e-9 } else { 2e-9 };
    let compared = verdict.comparison().expect("there is a truth");
    check(
        near(compared.error, plain.error, 0.01) || (compared.error - plain.error).abs() < rounding,
        format!("error {} not {}", compared.error, plain.error),
    );
    check(
        (verdict.outcome() <= Outcome::Accurate) == (plain.error <= 0.01)
            || near(plain.error, 0.01, 0.01),
        format!("{} with an error of {}", verdict.outcome().id(), plain.error),
    );
    if verdict.long_term.is_bounded == Some(true) {
        check(plain.failed_at.is_none(), format!("bounded, and fails at {:?}", plain.failed_at));
        let tenth = plain.reach.len() / 10;
        let most = |part: &[f64]| part.iter().fold(0.0_f64, |most, x| most.max(*x));
        let (early, late) = (most(&plain.reach[..tenth]), most(&plain.reach[tenth..]));
        let most = if matches!(kind.id, "spring" | "chain") { 1.3 } else { 2.0 };
        let swings = verdict.long_term.measure != Measure::Deviation;
        check(!swings || late <= most * early.max(1.0), format!("bounded: {early} then {late}"));
    }
    if verdict.long_term.is_bounded == Some(false) {
        check(grows(scene, spec, tick_hz, verdict), "not bounded, and nothing grows".into());
    }
    let undamped_spring = kind.id == "spring" && scene.bodies[0].values[2] == 0.0;
    if let Some(doubles) = verdict.long_term.doubles_in_s
        && doubles * hz < 0.9 * plain.reach.len() as f64
        && verdict.long_term.measure != Measure::Deviation
    {
        let at = if undamped_spring {
            let start = stepper(scene, Solver::Truth).energy().unwrap();
            plain.energy.iter().position(|e| *e >= 4.0 * start)
        } else {
            plain.reach.iter().position(|r| *r >= 2.0)
        };
        let undamped_pendulum = kind.id == "pendulum" && scene.bodies[0].values[3] == 0.0;
        if undamped_spring || undamped_pendulum || kind.id == "orbit" {
            let at = at.map_or(f64::INFINITY, |at| (at + 1) as f64 / hz);
            check(
                near(doubles, at, 0.05) || (doubles - at).abs() <= 2.0 / hz,
                format!("×2 in {doubles} s, not {at}"),
            );
        }
    }
    if let Some(halves) = verdict.long_term.halves_in_s
        && halves * hz < 0.9 * plain.reach.len() as f64
        && undamped_spring
    {
        let start = stepper(scene, Solver::Truth).energy().unwrap();
        let at = plain.energy.iter().position(|e| *e <= start / 4.0);
        let at = at.map_or(f64::INFINITY, |at| (at + 1) as f64 / hz);
        // The energy of a swing under a dissipative method comes down in steps, two for each turn.
        let turn =
            std::f64::consts::PI / (scene.bodies[0].values[1] / scene.bodies[0].values[0]).sqrt();
        // A velocity of half a step ago makes the energy wobble within a turn.
        let low = plain.reach.iter().rposition(|reach| *reach >= 0.5);
        let low = low.map_or(0.0, |tick| (tick + 1) as f64 / hz);
        let is_so = |at: f64| near(halves, at, 0.05) || (halves - at).abs() <= turn;
        // A motion that dies within a turn or two has no meaningful halving time.
        check(
            halves < 4.0 * turn || is_so(at) || is_so(low),
            format!("½ in {halves} s, not {at} or {low}"),
        );
    }
    // A swing that changes much from tick to tick does not pass its middle evenly.
    let changes_in =
        verdict.long_term.doubles_in_s.into_iter().chain(verdict.long_term.halves_in_s);
    if let Some(error) = compared.frequency_error
        && changes_in.fold(f64::INFINITY, f64::min) * hz > 20.0
        && (kind.id == "spring" || kind.id == "pendulum")
    {
        let mut truth = stepper(scene, Solver::Truth);
        const FINE: u32 = 40_000;
        let h = scene.seconds / f64::from(FINE);
        let exact: Vec<f64> = (0..FINE)
            .map(|i| {
                truth.advance(h * f64::from(i), h, 1).unwrap();
                truth.q()[0]
            })
            .collect();
        let mut exact = crossings(&exact);
        let within = (scene.seconds * hz) as usize;
        let mut lane = crossings(&plain.q[..within.min(plain.q.len())]);
        let loud = undamped_spring || (kind.id == "pendulum" && scene.bodies[0].values[3] == 0.0);
        let count = exact.len().min(lane.len()).min(if loud { usize::MAX } else { 4 });
        if count >= 4 {
            exact.truncate(count);
            lane.truncate(count);
            let found =
                (exact[count - 1] - exact[0]) * h / ((lane[count - 1] - lane[0]) / hz) - 1.0;
            // Between two ticks a crossing is not known better than this.
            let blur = if loud { 0.1 } else { 0.6 } / (lane[count - 1] - lane[0]);
            check(
                (found - error).abs() <= (0.02 * error.abs()).max(1e-4) + blur,
                format!("frequency error {error}, not {found} ± {blur}"),
            );
        }
    }
    lies
}

/// Whether something grows within twenty scenes, or on a linear body within a year: a body that follows a curve about a
/// centre by its distance, speed or energy, any other by its coordinates, velocities or energy.
fn grows(scene: &Scene, spec: LaneSpec, tick_hz: u32, verdict: &Verdict) -> bool {
    let (seconds, hz) = (20.0 * scene.seconds, f64::from(tick_hz));
    let method = spec.method;
    let is_linear = matches!(scene.bodies[0].kind.id, "spring" | "chain" | "ship");
    if is_linear && method.tolerance.is_none() {
        return grows_within_a_year(scene, spec, tick_hz)
            || method.restart.is_some()
                && verdict.long_term.doubles_in_s.is_none_or(|doubles| doubles > seconds);
    }
    let about_origin = scene.bodies[0].kind.id == "orbit";
    let sizes = |x: &[f64]| -> Vec<f64> {
        let length = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let n = x.len() / 2;
        let each = || x.iter().map(|x| x.abs()).collect();
        if about_origin { vec![length(&x[..n]), length(&x[n..])] } else { each() }
    };
    let widest = |solver: Solver, steps: u64, h: f64| {
        let mut body = stepper(scene, solver);
        let substeps = if solver == Solver::Truth { 1 } else { spec.substeps };
        let mut most = sizes(&components(&*body));
        let (mut quarters, mut kinetic) = ([(0.0, 0_u64); 4], 0.0_f64);
        for step in 0..steps {
            body.advance(h * step as f64, h, substeps).ok()?;
            for (most, size) in most.iter_mut().zip(sizes(&components(&*body))) {
                *most = most.max(size);
            }
            kinetic = kinetic.max(body.kinetic_energy().unwrap_or(0.0));
            let quarter = &mut quarters[(4 * step / steps) as usize];
            *quarter = (quarter.0 + body.energy().unwrap_or(0.0), quarter.1 + 1);
        }
        Some((most, kinetic, quarters.map(|(sum, count)| sum / count as f64)))
    };
    let (truth, kinetic, _) = widest(Solver::Truth, 40_000, seconds / 40_000.0).unwrap();
    let Some((lane, _, [_, early, _, late])) =
        widest(spec.solver(), (seconds * hz) as u64, 1.0 / hz)
    else {
        return true;
    };
    let is_wider = |lane: &[f64]| lane.iter().zip(&truth).any(|(lane, truth)| *lane >= 1.8 * truth);
    // The swing of a linear body keeps growing at the rate seen here.
    if is_wider(&lane) || late > early + if is_linear { 1e-6 } else { 3e-3 } * kinetic {
        return true;
    }
    // An orbit that falls inward may fail there later.
    let falls = about_origin && late < early;
    falls
        && widest(spec.solver(), 100 * (seconds * hz) as u64, 1.0 / hz)
            .is_none_or(|(lane, ..)| is_wider(&lane))
}

/// Whether a deviation doubles within a year, by the map of a tick multiplied with itself.
fn grows_within_a_year(scene: &Scene, spec: LaneSpec, tick_hz: u32) -> bool {
    let n = stepper(scene, Solver::Truth).q().len();
    let after = |state: &[f64]| {
        let mut body = stepper(scene, spec.solver());
        body.set(0.0, &state[..n], &state[n..]);
        body.advance(0.0, 1.0 / f64::from(tick_hz), spec.substeps).unwrap();
        components(&*body)
    };
    let rest = after(&vec![0.0; 2 * n]);
    let unit = |i: usize| (0..2 * n).map(|j| if i == j { 1.0 } else { 0.0 }).collect::<Vec<_>>();
    let columns = (0..2 * n).flat_map(|i| {
        let reached = after(&unit(i)).into_iter().zip(&rest);
        reached.map(|(x, rest)| x - rest).collect::<Vec<_>>()
    });
    let mut map = nalgebra::DMatrix::from_vec(2 * n, 2 * n, columns.collect());
    let (mut ticks, mut early) = (1.0, 0.0);
    while ticks < 365.0 * 86_400.0 * f64::from(tick_hz) {
        map = &map * &map;
        ticks *= 2.0;
        if ticks == 1024.0 {
            early = map.norm();
        }
        if !map.norm().is_finite() {
            return true;
        }
    }
    map.norm() > 1.5 * early
}

#[test]
fn an_ellipse_that_turns_does_not_grow() {
    let orbit = |mu: f64, x0: f64, vy0: f64, seconds: f64| {
        let text = format!(
            "title = \"t\"\ntick_hz = 60\nseconds = {seconds}\n[[orbit]]\nmu_m3_per_s2 = {mu}\nx0_m = {x0}\n\
             vy0_m_per_s = {vy0}\n"
        );
        Scene::parse("t", &text).unwrap()
    };
    let own = Scene::built_in("orbit").unwrap();
    let fast = orbit(31268.8668, 1.4164, 205.1468, 20.0);
    // A third of a turn, and six and a half in the long run.
    let slow = orbit(20.89229, 11.85729, 0.7045205, 8.104);
    for (scene, id, tick_hz) in [
        (&own, "velocity-verlet", 12),
        (&own, "velocity-verlet", 16),
        (&own, "velocity-verlet", 17),
        (&own, "semi-implicit-euler", 15),
        (&own, "semi-implicit-euler", 16),
        (&fast, "implicit-midpoint", 40),
        (&own, "explicit-euler", 60),
        (&own, "rk4", 6),
        (&slow, "stormer-verlet", 2),
        (&slow, "explicit-euler", 2),
    ] {
        let spec = LaneSpec::plain(regatta::sim::integrators::method(id).unwrap());
        let found = Judge::new(scene).verdict(spec, tick_hz);
        let wanted = !grows(scene, spec, tick_hz, &found);
        assert_eq!(found.long_term.is_bounded, Some(wanted), "{id} at {tick_hz} Hz: {found}");
    }
}

#[test]
fn a_spring_followed_for_a_third_of_a_swing_grows_by_its_method_alone() {
    let text = "title = 't'\ntick_hz = 60\nseconds = 6\n[[spring]]\nmass_kg = 39.4\n\
                stiffness_n_per_m = 4.68\nx0_m = 0.843\nv0_m_per_s = -0.374\n";
    let scene = Scene::parse("t", text).unwrap();
    for (id, wanted) in [("bogacki-shampine-32", true), ("rk4", true), ("explicit-euler", false)] {
        let spec = LaneSpec::plain(regatta::sim::integrators::method(id).unwrap());
        let found = Judge::new(&scene).verdict(spec, 60);
        assert_eq!(found.long_term.is_bounded, Some(wanted), "{id}: {found}");
    }
}

#[test]
fn a_losing_swing_of_a_spring_is_known_to_come_to_rest() {
    let text = "title = 't'\ntick_hz = 200\nseconds = 3\n[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 300\n";
    let scene = Scene::parse("t", text).unwrap();
    let spec = LaneSpec::plain(regatta::sim::integrators::method("bogacki-shampine-32").unwrap());
    let found = Judge::new(&scene).verdict(spec, 200).long_term;
    assert_eq!(found.is_bounded, Some(true));
    let mut lane = stepper(&scene, spec.solver());
    let start = lane.energy().unwrap();
    let is_low = |tick: &u32| {
        lane.advance(f64::from(*tick) / 200.0, 1.0 / 200.0, 1).unwrap();
        lane.energy().unwrap() <= start / 4.0
    };
    let wanted = f64::from((0..400_000).find(is_low).unwrap()) / 200.0;
    let halves = found.halves_in_s.unwrap();
    assert!((halves / wanted - 1.0).abs() < 0.01, "{halves} s, not {wanted}");
}

#[test]
fn verdicts_on_random_scenes_are_true() {
    let mut dice = Dice::new(0);
    let (mut unknown, mut false_ones, total) = (Vec::new(), Vec::new(), 100);
    for round in 0..total {
        let kind = KINDS[round % KINDS.len()];
        let text = scene(&mut dice, kind);
        let scene = Scene::parse("random", &text).unwrap();
        let spec = LaneSpec::plain(dice.one_of(&GENERAL_METHODS.iter().collect::<Vec<_>>()));
        let tick_hz = dice.scaled(2.0, 500.0).round() as u32;
        let verdict = Judge::new(&scene).verdict(spec, tick_hz);
        let what = format!("{} at {tick_hz} Hz on\n{text}  says: {verdict}", spec.method.id);
        match verdict.outcome() {
            Outcome::NotJudged => unknown.push(what),
            Outcome::NoTruth => unknown.push(what),
            _ => {
                let lies = lies(&scene, spec, tick_hz, &verdict);
                if !lies.is_empty() {
                    false_ones.push(format!("{what}\n  but: {}", lies.join("; ")));
                }
            }
        }
    }
    assert!(false_ones.is_empty(), "{} false:\n{}", false_ones.len(), false_ones.join("\n\n"));
    assert!(20 * unknown.len() <= total, "{} not judged:\n{}", unknown.len(), unknown.join("\n"));
}

#[test]
fn advised_substeps_and_rates_meet_their_criterion_and_one_fewer_does_not() {
    let mut dice = Dice::new(0);
    let accurate = 2;
    let mut false_ones = Vec::new();
    for round in 0..24 {
        let text = scene(&mut dice, KINDS[round % KINDS.len()]);
        let scene = Scene::parse("random", &text).unwrap();
        let amplitudes = amplitudes(&scene);
        let tick_hz = dice.one_of(&[20, 30, 60, 120]);
        let adviser = Adviser::new(&scene, tick_hz);
        for _ in 0..3 {
            let spec = LaneSpec::plain(dice.one_of(&GENERAL_METHODS.iter().collect::<Vec<_>>()));
            let meets = adviser.meets(spec, CRITERIA[accurate]);
            let Some(met) = meets.met() else { continue };
            let error = |substeps: u32, tick_hz: u32| {
                plain(&scene, LaneSpec { substeps, ..spec }, tick_hz, &amplitudes, 1.0).error
            };
            let mut check = |holds: bool, substeps: u32, tick_hz: u32| {
                let error = error(substeps, tick_hz);
                if (error <= 0.01) != holds && (error - 0.01).abs() > 1e-4 {
                    false_ones.push(format!(
                        "{} ×{substeps} at {tick_hz} Hz: {error}\n{text}",
                        spec.method.id
                    ));
                }
            };
            check(true, met.substeps, tick_hz);
            if let Some(slowest_hz) = met.slowest_hz {
                check(true, met.substeps, slowest_hz);
                if slowest_hz > 1 {
                    check(false, met.substeps, slowest_hz - 1);
                }
            }
            if met.substeps > 1 {
                check(false, met.substeps - 1, tick_hz);
            }
        }
    }
    assert!(false_ones.is_empty(), "{} false:\n{}", false_ones.len(), false_ones.join("\n\n"));
}
