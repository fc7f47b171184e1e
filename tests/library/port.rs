//! Settings ported from engine to engine: each is set and stepped, and a fit measures the visible motion of the run.

use std::f64::consts::TAU;

use regatta::conformance::problems::{fresh, problem};
use regatta::sim::bodies::Follow;
use regatta::sim::integrators::{Family, METHODS, method};
use regatta::sim::{State, least_squares};
use regatta::tools::port::{
    Approach, FollowerPort, PortOutcome, Ported, Setup, Wish, WishError, drive_limits, followers,
    port, setups,
};

use crate::dice::Dice;
use crate::engines::Body;

/// How many wishes are tried; `REGATTA_WISHES` sets another number.
fn wishes() -> usize {
    let wishes = std::env::var("REGATTA_WISHES").ok().and_then(|count| count.parse().ok());
    wishes.unwrap_or(24)
}

/// A wish, ticks per second and substeps, which can be seen.
fn draw(dice: &mut Dice) -> (Wish, f64, u32) {
    loop {
        let wish = Wish {
            frequency_hz: 0.2 * (150.0_f64).powf(dice.part()),
            damping_ratio: if dice.below(6) == 0 { 0.0 } else { dice.between(0.0, 2.0) },
            mass_kg: dice.between(0.1, 200.0),
        };
        let tick_hz = dice.between(30.0, 240.0).round();
        let substeps = 1 + dice.below(8) as u32;
        if wish.check(tick_hz).is_ok() {
            return (wish, tick_hz, substeps);
        }
    }
}

/// The states of a run of `ticks` ticks.
pub(crate) fn run(setup: &Setup, joint: [f64; 2], start: [f64; 2], ticks: u32) -> Vec<[f64; 2]> {
    let body = Body { spring: joint, drag: 0.0, push: 0.0, is_held: false }.problem();
    let mut state = State { q: start[0], v: start[1] };
    // A force recomputed in every substep is the right-hand side of an equation under semi-implicit Euler.
    let stepped = match setup.mode.is_explicit {
        true => method("semi-implicit-euler").unwrap(),
        false => setup.method,
    };
    let mut engine = fresh(stepped);
    let mut states = vec![start];
    for tick in 0..ticks {
        let t = f64::from(tick) / setup.tick_hz;
        engine.steps(&body, t, 1.0 / setup.tick_hz, setup.substeps, &mut state).unwrap();
        states.push([state.q, state.v]);
    }
    states
}

/// The frequency and the damping ratio of runs from two starts: y″ = a y′ + b y of coordinates and of velocities, by least
/// squares, with a term more for an engine that has a memory.
fn fitted(setup: &Setup, joint: [f64; 2]) -> Option<[f64; 2]> {
    const TICKS: u32 = 24;
    let terms = if setup.method.restart.is_some() { 3 } else { 2 };
    let (mut columns, mut right) = (vec![Vec::new(); terms], Vec::new());
    for start in [[1e-3, 0.0], [0.0, 1e-3]] {
        for rows in run(setup, joint, start, TICKS).windows(terms + 1) {
            for part in 0..2 {
                // Every row counts alike, however far the motion has died away.
                let size = rows.iter().map(|state| state[part].abs()).fold(0.0, f64::max);
                if size > 1e-30 {
                    for (term, column) in columns.iter_mut().enumerate() {
                        column.push(rows[terms - 1 - term][part] / size);
                    }
                    right.push(rows[terms][part] / size);
                }
            }
        }
    }
    let found = least_squares(&columns, &right)?;
    let (half, product) = match found[..] {
        [a, b] => (a / 2.0, -b),
        [a, b, c] => {
            // The term of the memory decays fastest: its root is the nearest to 0, and it is divided out.
            let mut root = 0.0;
            for _ in 0..30 {
                let value = ((root - a) * root - b) * root - c;
                root -= value / ((3.0 * root - 2.0 * a) * root - b);
            }
            ((a - root) / 2.0, -b - root * (a - root))
        }
        _ => return None,
    };
    let rates = -product.ln() * setup.tick_hz;
    let apart = half * half - product;
    let omega_square = match apart < 0.0 {
        true => {
            let angle = (-apart).sqrt().atan2(half) * setup.tick_hz;
            rates * rates / 4.0 + angle * angle
        }
        false => {
            let [fast, slow] = [-1.0, 1.0].map(|s| -(half + s * apart.sqrt()).ln() * setup.tick_hz);
            fast * slow
        }
    };
    let omega = omega_square.sqrt();
    Some([omega / TAU, rates / 2.0 / omega])
}

/// The distance from the target, measured as the program does.
fn missed(wish: &Wish, setup: &Setup, joint: [f64; 2]) -> f64 {
    let Some(seen) = setup.visible_motion(joint) else { return f64::INFINITY };
    let ratio = seen.decay / seen.omega - wish.damping_ratio;
    (seen.omega / TAU / wish.frequency_hz).ln().abs() + ratio.abs()
}

/// The least that is missed of a wide search over the settings.
fn best_of_search(wish: &Wish, setup: &Setup, around: [f64; 2]) -> f64 {
    let [stiffness, damping] = wish.joint();
    let omega = stiffness.sqrt();
    let dampings = (0..25).map(|i| omega * (1e-3 * 1.6_f64.powi(i) - 1e-3));
    let wide = dampings.flat_map(|c| (0..60).map(move |i| [stiffness * 1.3_f64.powi(i - 20), c]));
    let near = (-8..=8).flat_map(|i| {
        let k = around[0] * 1.01_f64.powi(i);
        (-8..=8).map(move |j| [k, (around[1] + 0.01 * f64::from(j) * omega).max(0.0)])
    });
    let all = wide.chain(near).chain([[stiffness, damping]]);
    all.map(|joint| missed(wish, setup, joint)).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_reached_target_shows_in_the_run_and_a_missed_one_has_no_nearer_setting() {
    let mut dice = Dice::new(281);
    let mut counts = [0_u32; 3];
    let mut worst = [0.0_f64; 2];
    for _ in 0..wishes() {
        let (wish, tick_hz, substeps) = draw(&mut dice);
        let all = setups(None, tick_hz, Some(substeps));
        // A fit of runs from two starts needs a linear tick.
        for setup in all.into_iter().filter(|setup| setup.mode.is_linear(1.0)) {
            let what = format!("{wish:?} {tick_hz} Hz, {} ×{substeps}", setup.method.id);
            let found = port(&wish, setup).unwrap_or_else(|| panic!("{what}: nothing"));
            let Ported { outcome, values, sees, .. } = &found;
            let joint = setup.mode.joint(*values, wish.mass_kg);
            counts[*outcome as usize] += 1;
            let fit = fitted(&setup, joint);
            let shown = [sees.omega / TAU, sees.decay / sees.omega];
            if *outcome == PortOutcome::Reached {
                let [hz, ratio] = fit.unwrap_or_else(|| panic!("{what}: no fit"));
                let off =
                    [(hz / wish.frequency_hz - 1.0).abs(), (ratio - wish.damping_ratio).abs()];
                assert!(off[0] < 1e-3 && off[1] < 2e-3, "{what}: {values:?} fits {hz} {ratio}");
                assert!((shown[0] / wish.frequency_hz - 1.0).abs() < 2e-8, "{what}: {shown:?}");
                worst = [worst[0].max(off[0]), worst[1].max(off[1])];
                continue;
            }
            let nearest = missed(&wish, &setup, joint);
            let best = best_of_search(&wish, &setup, joint);
            assert!(best > nearest - 2e-3, "{what}: {values:?} miss {nearest}, not {best}");
            let is_below = found.floor.is_some_and(|floor| wish.damping_ratio < floor);
            assert_eq!(*outcome == PortOutcome::Unreachable, is_below, "{what}: {sees:?}");
        }
    }
    println!("reached, nearest, unreachable: {counts:?}; worst fit {worst:?}");
    assert!(counts.iter().all(|count| *count > 0), "{counts:?}");
}

/// The errors of Bullet's older spring after 1 s and in the mean till then, for a stiffness per kg and the speed d k of its
/// motor, by its formula.
fn errors_of_bullet_6dof([k, s]: [f64; 2], (hz, ratio): (f64, f64), tick_hz: f64) -> [f64; 2] {
    let (omega, h) = (TAU * hz, 1.0 / tick_hz);
    let turned = omega * (1.0 - ratio * ratio).sqrt();
    let ([mut x, mut v], mut errors) = ([1.0_f64, 0.0_f64], Vec::new());
    for tick in 1..=tick_hz as u32 {
        let most = h * k * x.abs();
        v += (-s / (10.0 * h) * x - v).clamp(-most, most);
        x += h * v;
        let (sin, cos) = (turned * f64::from(tick) * h).sin_cos();
        let left = (-ratio * omega * f64::from(tick) * h).exp();
        errors.push(x - left * (cos + ratio * omega / turned * sin));
    }
    let square: f64 = errors.iter().map(|error| error * error).sum();
    [errors[errors.len() - 1].abs(), (square / errors.len() as f64).sqrt()]
}

#[test]
fn bullets_older_spring_is_right_after_a_second_and_near_until_then() {
    let setup = |tick_hz| setups(Some(&[method("engine-bullet-6dof").unwrap()]), tick_hz, None)[0];
    // The least rms of a search over 800 000 pairs that are right after a second.
    for (hz, damping_ratio, tick_hz, least) in [
        (1.0, 0.2, 60.0, 0.0436),
        (1.0, 0.2, 30.0, 0.0527),
        (0.5, 0.05, 60.0, 0.0172),
        (2.0, 0.1, 120.0, 0.0460),
        (5.0, 0.4, 60.0, 0.0421),
        (3.0, 0.8, 30.0, 0.0312),
    ] {
        let wish = Wish { frequency_hz: hz, damping_ratio, mass_kg: 2.0 };
        let found = port(&wish, setup(tick_hz)).unwrap();
        assert_eq!(found.outcome, PortOutcome::Nearest, "{found:?}");
        let [k, d] = found.values;
        let motor = [k / wish.mass_kg, k * d];
        let [end, rms] = errors_of_bullet_6dof(motor, (hz, damping_ratio), tick_hz);
        let off = found.first_second.unwrap();
        assert!((off.end.abs() - end).abs() < 1e-7 && (off.rms - rms).abs() < 1e-7, "{found:?}");
        assert!(end < 1e-3 && rms < 1.03 * least, "{wish:?} at {tick_hz} Hz: {end} {rms}");
    }
    // More of its damping damps less; without any it never moves.
    let of = |damping: f64| setup(60.0).mode.joint([40.0, damping], 1.0);
    let ratio = |damping| setup(60.0).visible_motion(of(damping)).unwrap().damping_ratio().unwrap();
    let ratios = [1.0, 0.5, 0.1, 0.05].map(ratio);
    assert!(ratios.is_sorted() && ratios[0] < 5e-4 && ratios[3] > 0.08, "{ratios:?}");
    assert_eq!(run(&setup(60.0), of(0.0), [1.0, 0.0], 60)[60], [1.0, 0.0]);
    let undamped = port(&Wish { frequency_hz: 1.0, damping_ratio: 0.0, mass_kg: 2.0 }, setup(60.0));
    assert_eq!(undamped.unwrap().outcome, PortOutcome::Reached);
}

#[test]
fn settings_round_trip_through_another_engine() {
    let mut dice = Dice::new(282);
    let (mut there_and_back, mut worst) = (0, 0.0_f64);
    for _ in 0..wishes() {
        let (wish, tick_hz, substeps) = draw(&mut dice);
        let all = setups(None, tick_hz, Some(substeps));
        let [from, to] = [(); 2].map(|()| all[dice.below(all.len())]);
        let reached = |wish: &Wish, setup: Setup| {
            port(wish, setup).filter(|ported| ported.outcome == PortOutcome::Reached)
        };
        let Some(first) = reached(&wish, from) else { continue };
        let seen = from.visible_motion(from.mode.joint(first.values, wish.mass_kg)).unwrap();
        let Some(second) = reached(&Wish::of(seen, wish.mass_kg), to) else { continue };
        let seen = to.visible_motion(to.mode.joint(second.values, wish.mass_kg)).unwrap();
        let Some(back) = reached(&Wish::of(seen, wish.mass_kg), from) else {
            // A damping ratio of 0 may come back as less, by rounding.
            assert!(wish.damping_ratio < 1e-9, "{wish:?}");
            continue;
        };
        let critical = Wish { damping_ratio: 1.0, ..wish };
        let scales = from.mode.values(critical.joint(), wish.mass_kg);
        for (i, scale) in scales.into_iter().enumerate() {
            let off = (back.values[i] - first.values[i]).abs() / first.values[i].abs().max(scale);
            worst = worst.max(off);
            assert!(
                off < 1e-9,
                "{wish:?} {tick_hz} ×{substeps} {} {}: {off:e}",
                from.method.id,
                to.method.id
            );
        }
        there_and_back += 1;
    }
    println!("{there_and_back} came back, the worst to {worst:e}");
    assert!(there_and_back > wishes() / 4);
}

#[test]
fn the_damping_floor_of_box2d_matches_its_card_and_drops_with_substeps() {
    let wish = Wish { frequency_hz: 1.0, damping_ratio: 0.0, mass_kg: 1.0 };
    let box2d = method("engine-box2d").unwrap();
    let setup = setups(Some(&[box2d]), 60.0, None)[0];
    let found = port(&wish, setup).unwrap();
    assert_eq!(found.outcome, PortOutcome::Unreachable);
    let claimed = box2d.engine.unwrap().damping_ratio.unwrap();
    assert!((found.floor.unwrap() - claimed).abs() < 1e-4, "{found:?}");
    let relief = found.relief.unwrap();
    assert_eq!(relief.setup.substeps, 8);
    assert!((relief.damping_ratio / 0.01309 - 1.0).abs() < 0.01, "{relief:?}");
    // Over four substeps a custom force gains energy, which its damping takes.
    assert!(found.own_force.is_some_and(|[_, damping]| damping > 0.0), "{found:?}");
    let eased = Wish { damping_ratio: 0.005, ..wish };
    assert_eq!(port(&eased, setup).unwrap().relief.unwrap().enough, Some(32));
}

#[test]
fn a_target_beyond_every_engine_is_refused_with_the_reason() {
    let wish = Wish { frequency_hz: 2.0, damping_ratio: 0.1, mass_kg: 1.0 };
    assert_eq!(wish.check(60.0), Ok(()));
    let out =
        |wish: Wish, tick_hz| matches!(wish.check(tick_hz), Err(WishError::OutOfRange { .. }));
    assert!(out(Wish { mass_kg: -1.0, ..wish }, 60.0) && out(wish, 0.0));
    assert!(out(Wish { frequency_hz: f64::NAN, ..wish }, 60.0));
    assert!(out(Wish { damping_ratio: -0.1, ..wish }, 60.0));
    let fast = Wish { frequency_hz: 30.0, ..wish };
    assert!(matches!(fast.check(60.0), Err(WishError::BeyondNyquist { .. })));
    let slow = Wish { frequency_hz: 0.0019, ..wish };
    assert!(matches!(slow.check(60.0), Err(WishError::TooSlow { .. })));
    let stiff = Wish { damping_ratio: 200.0, ..wish };
    assert!(matches!(stiff.check(60.0), Err(WishError::TooFast { .. })));
}

#[test]
fn a_drive_is_stable_exactly_up_to_its_limits() {
    let euler = |m: &Setup| m.mode.is_explicit;
    let mujoco = setups(Some(&[method("engine-mujoco").unwrap()]), 500.0, None);
    let setup = *mujoco.iter().find(|setup| euler(setup)).unwrap();
    let joint = Wish { frequency_hz: 20.0, damping_ratio: 0.5, mass_kg: 1.0 }.joint();
    let limits = drive_limits(setup, joint, None);
    // h² K < 4 - 2 h c, and h c < 2 - h² K / 2.
    let (h, [stiffness, damping]) = (1.0 / 500.0, joint);
    let most = (4.0 - 2.0 * h * damping) / (h * h);
    assert!((limits.stiffness.most.unwrap() / most - 1.0).abs() < 1e-6, "{limits:?}");
    let most = (2.0 - h * h * stiffness / 2.0) / h;
    assert!((limits.damping.most.unwrap() / most - 1.0).abs() < 1e-6, "{limits:?}");
    assert_eq!(limits.fewest_substeps, Some(1));
    // An implicit drive has no limit; a force that is held through eight ticks has one that is far lower.
    let jolt = setups(Some(&[method("engine-jolt").unwrap()]), 60.0, None)[0];
    assert_eq!(drive_limits(jolt, joint, None).stiffness.most, None);
    let held = |ticks| drive_limits(setup, joint, Some(ticks)).damping.most.unwrap();
    assert!((held(1) / most - 1.0).abs() < 1e-6 && held(8) < 0.2 * held(1), "{}", held(8));
    // Through two ticks: by hand.
    let by_hand = |[k, c]: [f64; 2]| {
        let mut state = [1.0, 0.0];
        for _ in 0..4000 {
            let force = -k * state[0] - c * state[1];
            for _ in 0..2 {
                state[1] += h * force;
                state[0] += h * state[1];
            }
        }
        state[0].abs() < 1.0
    };
    let most = held(2);
    assert!(by_hand([stiffness, 0.99 * most]) && !by_hand([stiffness, 1.01 * most]));
}

#[test]
fn every_ported_follower_has_the_same_half_life_at_every_frame_rate() {
    let mut dice = Dice::new(51_126);
    let exact = Approach::of_lerp(0.1, 60.0);
    assert!((exact.rate() - 6.3216).abs() < 1e-4);
    assert_eq!(followers(exact, Some(60.0)).len(), 6 * 5);
    for method in METHODS.iter().filter(|method| method.family == Family::Follower) {
        let has_setting = |port: &FollowerPort| port.method == method;
        assert!(followers(exact, None).iter().any(has_setting), "{} has no setting", method.id);
    }
    // Half of the way within a sixth of a frame: a frame leaves a 64th.
    let quick = followers(Approach { half_life_s: 1.0 / 180.0 }, None);
    let of = |port: &&FollowerPort| port.method.id == "smooth-damp" && port.fps == 30.0;
    let z = 2.0 / quick.iter().find(of).unwrap().value / 30.0;
    let left = (1.0 + z) / (1.0 + z + 0.48 * z * z + 0.235 * z * z * z);
    assert!((left * 64.0 - 1.0).abs() < 1e-6, "{left}");
    for _ in 0..40 {
        // Half of the way is a whole number of frames, so that own steps end there.
        let fps = [30.0, 50.0, 75.0, 100.0, 165.0, 240.0][dice.below(6)];
        let frames = 1 + dice.below(40) as u32;
        let approach = Approach { half_life_s: f64::from(frames) / fps };
        for port in followers(approach, Some(fps)).iter().filter(|port| port.fps == fps) {
            let rate = match port.setting {
                "part" => -(-port.value).ln_1p() * fps,
                "smooth_time" => 2.0 / port.value,
                _ => port.value,
            };
            let order = port.method.law_order().unwrap_or(1) as usize;
            // Its target rests at 0.
            let system = problem(Follow { order, rate, ..Follow::default() });
            let mut state = State { q: 1.0, v: 0.0 };
            let mut follower = fresh(port.method);
            for _ in 0..frames {
                match port.setting {
                    "part" => state.q -= port.value * state.q,
                    _ => follower.steps(&system, 0.0, 1.0 / fps, 1, &mut state).unwrap(),
                }
            }
            assert!((state.q - 0.5).abs() < 1e-6, "{port:?} after {frames}: {}", state.q);
            if port.method.id == "critically-damped-spring" {
                assert!((rate * approach.half_life_s - 1.678_346_990).abs() < 1e-8, "{port:?}");
            }
        }
    }
}
