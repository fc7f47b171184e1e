use super::*;
use crate::scene::Scene;
use crate::sim::bodies::kind;
use crate::sim::integrators::{GENERAL_METHODS, Method, method};

/// Returns the map of a spring of 1 kg over its stiffness, with this damping.
fn spring(damping: f64, ids: &[&str]) -> StabilityMap {
    let specs = ids.iter().map(|id| LaneSpec::plain(method(id).unwrap()));
    map([1.0, 90.0, damping, 1.0, 0.0, 3.0], 1, specs.collect())
}

fn map(values: [f64; 6], parameter: usize, specs: Vec<LaneSpec>) -> StabilityMap {
    let kind = kind("spring").unwrap();
    let opened = SceneBody::new("spring", kind.clone(), values.to_vec());
    let specs = specs.into_iter().enumerate().collect();
    let request = MapRequest::new((0, parameter), &opened, &values, 20, specs);
    let mut work = MapWork::new(kind.clone(), request);
    while !work.is_done() {
        work.advance(u64::MAX);
    }
    work.map()
}

/// Whether a point at this rate and value is in one of the pieces.
fn holds(region: &Region, hz: f64, value: f64) -> bool {
    region.contains([hz, value].map(libm::log10))
}

/// Asserts that the region matches `is_stable` on both sides of its boundary. Points within a hundredth of the true
/// boundary are skipped.
fn assert_region(region: &Region, what: &str, is_stable: impl Fn(f64, f64) -> bool) {
    let (mut stable, mut unstable) = (0, 0);
    for i in 0..60 {
        for j in 0..60 {
            let hz = libm::pow(10.0, 0.31 + 2.68 * f64::from(i) / 59.0);
            let k = libm::pow(10.0, 0.01 + 4.98 * f64::from(j) / 59.0);
            let wanted = is_stable(hz, k);
            let is_clear = [0.99, 1.01]
                .iter()
                .all(|a| [0.98, 1.02].iter().all(|b| is_stable(hz * a, k * b) == wanted));
            if is_clear {
                assert_eq!(holds(region, hz, k), wanted, "{what} at {hz} Hz, k = {k}");
                *(if wanted { &mut stable } else { &mut unstable }) += 1;
            }
        }
    }
    assert!(stable > 300 && unstable > 300, "{what}: {stable} stable, {unstable} not");
}

#[test]
fn the_regions_of_an_undamped_spring_end_at_the_limits_of_the_cards() {
    let map = spring(0.0, &["semi-implicit-euler", "rk4", "yoshida4", "explicit-euler"]);
    for (region, (_, spec)) in map.regions.iter().zip(&map.request.specs).take(3) {
        let limit = spec.method.stability_limit.unwrap();
        assert_region(region, spec.method.id, |hz, k| k.sqrt() / hz < limit);
        assert_eq!(region.boundary.len(), 1, "{}", spec.method.id);
        for [x, y] in &region.boundary[0] {
            let z = libm::pow(10.0, y / 2.0 - x);
            assert!((z / limit - 1.0).abs() < 1e-3, "{}: ω h = {z}, not {limit}", spec.method.id);
        }
    }
    assert_eq!(map.regions[3].coverage, Coverage::Nowhere);
}

#[test]
fn no_method_is_stable_again_far_beyond_its_limit() {
    // The map reaches up to 5000 rad in a tick.
    let limited = GENERAL_METHODS.iter().filter(|method| {
        method.tolerance.is_none() && method.stability_limit.is_some_and(|limit| limit >= 1.0)
    });
    let specs: Vec<LaneSpec> = limited.map(LaneSpec::plain).collect();
    let map = map([1.0, 1e4, 0.0, 1.0, 0.0, 3.0], 1, specs);
    for (region, (_, spec)) in map.regions.iter().zip(&map.request.specs) {
        let limit = spec.method.stability_limit.unwrap();
        for [x, y] in region.boundary.iter().flatten() {
            let z = libm::pow(10.0, y / 2.0 - x);
            let is_limit = (z / limit - 1.0).abs() < 1e-3;
            // A composition of kicks and drifts may have a narrow window beyond.
            let is_window = spec.method.symplectic && is_end_of_window(spec.method, z);
            assert!(is_limit || is_window, "{}: ω h = {z}, not {limit}", spec.method.id);
        }
    }
}

/// Whether the trace of the step reaches 2 near `z = ω h`. An area-preserving map is stable below a trace of 2 and
/// unstable above it.
fn is_end_of_window(method: &'static Method, z: f64) -> bool {
    let traces = (-40..=40).map(|i| {
        let h = z * (1.0 + 5e-5 * f64::from(i));
        let trace: f64 = (0..2)
            .map(|j| {
                let values = [1.0, 1.0, 0.0, 1.0, 0.0, 1.0];
                let solver = Solver::Method(method);
                let mut spring = (kind("spring").unwrap().build)(&values, solver);
                let unit = [f64::from(1 - j), f64::from(j)];
                spring.set(0.0, &unit[..1], &unit[1..]);
                spring.advance(0.0, h, 1).unwrap();
                if j == 0 { spring.q()[0] } else { spring.v()[0] }
            })
            .sum();
        trace.abs()
    });
    let traces: Vec<f64> = traces.collect();
    traces.iter().any(|&trace| trace < 2.0) && traces.iter().any(|&trace| trace > 2.0)
}

#[test]
fn explicit_euler_is_stable_only_between_two_dampings() {
    for damping in [1.0, 40.0] {
        let map = spring(damping, &["explicit-euler"]);
        // Jury's conditions on the step [[1, h], [-k h, 1 - c h]].
        assert_region(&map.regions[0], "explicit Euler", |hz, k| {
            let h = 1.0 / hz;
            k * h < damping && 4.0 - 2.0 * damping * h + k * h * h > 0.0
        });
    }
}

#[test]
fn implicit_methods_are_stable_everywhere() {
    let ids = ["implicit-euler", "implicit-midpoint", "newmark", "bdf2", "gauss-legendre-4"];
    for damping in [0.0, 1.0] {
        let map = spring(damping, &ids);
        for (region, id) in map.regions.iter().zip(ids) {
            assert_eq!(region.coverage, Coverage::Everywhere, "{id}, c = {damping}");
        }
        assert!(map.here.iter().all(|here| *here == PointStability::Stable), "{:?}", map.here);
    }
}

#[test]
fn a_boundary_across_the_rates_is_found_too() {
    // The vertical axis is the damping, which hardly affects semi-implicit Euler until it is large.
    let specs = vec![LaneSpec::plain(method("semi-implicit-euler").unwrap())];
    let map = map([1.0, 1e4, 0.0, 1.0, 0.0, 3.0], 2, specs);
    let lowest = map.regions[0].boundary.iter().flatten().min_by(|a, b| a[1].total_cmp(&b[1]));
    let hz = libm::pow(10.0, lowest.unwrap()[0]);
    assert!((hz / 50.0 - 1.0).abs() < 0.01, "{hz} Hz, not ω / 2");
}

#[test]
fn substeps_move_the_boundary() {
    let rk4 = method("rk4").unwrap();
    let specs = vec![LaneSpec { substeps: 3, ..LaneSpec::plain(rk4) }];
    let map = map([1.0, 90.0, 0.0, 1.0, 0.0, 3.0], 1, specs);
    for [x, y] in map.regions[0].boundary.iter().flatten() {
        let z = libm::pow(10.0, y / 2.0 - x) / 3.0;
        assert!((z / rk4.stability_limit.unwrap() - 1.0).abs() < 1e-3, "ω h = {z}");
    }
}

#[test]
fn each_method_reports_its_behaviour_at_the_present_point() {
    let map = spring(1.0, &["explicit-euler", "rk4", "adaptive-euler"]);
    // Each step of explicit Euler multiplies the amplitude by √(1 - c h + k h²).
    let h = 1.0 / 20.0;
    let wanted = 2.0_f64.ln() * h / (0.5 * libm::log(1.0 - h + 90.0 * h * h));
    let PointStability::Doubles(seconds) = map.here[0] else { panic!("{:?}", map.here) };
    assert!((seconds / wanted - 1.0).abs() < 1e-9, "{seconds}, not {wanted}");
    assert_eq!(map.here[1..], [PointStability::Stable, PointStability::OwnSteps]);
    assert_eq!(map.regions[2].coverage, Coverage::OwnSteps);
}

#[test]
fn the_present_point_changes_no_region() {
    let specs = vec![(0, LaneSpec::plain(&GENERAL_METHODS[0]))];
    let scene = Scene::built_in("damped").unwrap();
    let opened = &scene.bodies[0];
    let request = |k: f64, c: f64, tick_hz: u32| {
        let mut values = opened.values.clone();
        (values[1], values[2]) = (k, c);
        MapRequest::new((0, 1), opened, &values, tick_hz, specs.clone())
    };
    let mut work = MapWork::new(opened.kind.clone(), request(90.0, 1.0, 20));
    while !work.is_done() {
        work.advance(u64::MAX);
    }
    work.set_request(request(700.0, 1.0, 60));
    assert_eq!((work.map.regions.len(), work.map.here.len()), (1, 0));
    work.set_request(request(700.0, 2.0, 60));
    assert_eq!(work.map.regions.len(), 0);
    assert_eq!(range(90.0, 90.0), [1.0, 1e5]);
    assert_eq!(range(90.0, 2e5), [1.0, 1e6]);
    assert_eq!(range(0.0, 0.0), FROM_NOTHING);
}

#[test]
fn slicing_and_moving_the_point_leave_the_map_unchanged() {
    const SLICE: u64 = 50_000;
    let scene = quarter_car();
    let body = &scene.bodies[0];
    let (index, _) = body.kind.parameter("k").unwrap();
    let specs = ["rk4", "implicit-midpoint"].map(|id| LaneSpec::plain(method(id).unwrap()));
    let request = |tick_hz| {
        let specs = specs.into_iter().enumerate().collect();
        MapRequest::new((0, index), body, &body.values, tick_hz, specs)
    };
    let found = |slice: u64, moves: bool| {
        let mut work = MapWork::new(body.kind.clone(), request(60));
        let mut slices = Vec::new();
        while !work.is_done() {
            let before = work.meter().passed();
            work.advance(slice);
            slices.push(work.meter().passed() - before);
            if moves && work.part.is_some() && slices.len() % 9 == 0 {
                work.set_request(request(if work.map.request.tick_hz == 60 { 30 } else { 60 }));
                assert!(work.part.is_some() && work.here.is_none() && work.map.here.is_empty());
                // Results for the new point appear although a region is in progress.
                work.advance(u64::MAX);
                assert!(work.map.here.len() == 2 && !work.is_within_a_part());
            }
        }
        work.set_request(request(60));
        while !work.is_done() {
            work.advance(slice);
        }
        ((work.map.regions, work.map.here), slices)
    };
    let ((whole, once), (sliced, slices)) = (found(u64::MAX, false), found(SLICE, false));
    assert!(sliced == whole && once.len() == 4, "{once:?}");
    assert!(slices.len() > 20 && slices.iter().all(|&work| work < 2 * SLICE), "{slices:?}");
    assert!(found(SLICE, true).0 == whole);
}

/// Returns the map of a scene's first body over the parameter with this key.
fn map_of(scene: &Scene, key: &str, tick_hz: u32, ids: &[&str]) -> StabilityMap {
    let body = &scene.bodies[0];
    let (index, _) = body.kind.parameter(key).unwrap();
    let specs = ids.iter().map(|id| LaneSpec::plain(method(id).unwrap())).enumerate().collect();
    let request = MapRequest::new((0, index), body, &body.values, tick_hz, specs);
    let mut work = MapWork::new(body.kind.clone(), request);
    while !work.is_done() {
        work.advance(u64::MAX);
    }
    work.map()
}

fn law(text: &str) -> Scene {
    let text =
        format!("title = 'x'\ntick_hz = 60\nseconds = 5\nmethods = ['rk4']\n[[law]]\n{text}");
    Scene::parse("x.toml", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Returns a quarter of a car, whose damper couples its modes.
fn quarter_car() -> Scene {
    law("constants = { m = 250.0, w = 40.0, k = 18000.0, kt = 160000.0, c = 1200.0 }\n\
         [law.coordinates.z]\nstart = 0.1\nacceleration = '(-k*(z-u) - c*(vz-vu))/m'\n\
         [law.coordinates.u]\nacceleration = '(k*(z-u) + c*(vz-vu) - kt*u)/w'")
}

/// Returns the swing of a quarter of a car under a method after many steps, relative to the swing after half of them.
fn growth(scene: &Scene, key: &str, value: f64, hz: f64, id: &str) -> f64 {
    let body = &scene.bodies[0];
    let mut values = body.values.clone();
    values[body.kind.parameter(key).unwrap().0] = value;
    let mut stepper = (body.kind.build)(&values, Solver::Method(method(id).unwrap()));
    let mut most = [1e-300_f64; 2];
    let (few, many) = (200, 30_000);
    for tick in 0..many {
        if stepper.advance(f64::from(tick) / hz, 1.0 / hz, 1).is_err() {
            return f64::INFINITY;
        }
        let size = stepper.q().iter().fold(0.0_f64, |most, q| most.max(q.abs()));
        if size > 1e100 {
            return f64::INFINITY;
        }
        for (most, end) in most.iter_mut().zip([many / 2, many]) {
            if (end - few..end).contains(&tick) {
                *most = most.max(size);
            }
        }
    }
    most[1] / most[0]
}

#[test]
fn the_boundary_of_a_law_with_coupled_modes_is_where_its_swing_starts_to_grow() {
    let scene = quarter_car();
    let ids = ["explicit-euler", "semi-implicit-euler", "rk4", "implicit-midpoint", "bdf2"];
    for key in ["kt", "c", "w"] {
        let map = map_of(&scene, key, 60, &ids);
        assert!(map.is_linear && map.refused.is_none() && !map.truth_grows);
        for (region, id) in map.regions.iter().zip(ids) {
            if ["implicit-midpoint", "bdf2"].contains(&id) {
                assert_eq!(region.coverage, Coverage::Everywhere, "{id} over {key}");
                continue;
            }
            assert_eq!((region.coverage, region.limit), (Coverage::Part, None), "{id} over {key}");
            let points: Vec<[f64; 2]> = region.boundary.iter().flatten().copied().collect();
            let (mut inside, mut outside) = (0, 0);
            for [x, y] in points.iter().step_by(points.len() / 9) {
                let [hz, value] = [x, y].map(|x| libm::pow(10.0, *x));
                for factor in [0.97, 1.03] {
                    let is_stable = holds(region, hz * factor, value);
                    // Near a tangent, both points may be on the same side.
                    if !(5.0..990.0).contains(&hz) || is_stable != (factor > 1.0) {
                        continue;
                    }
                    let growth = growth(&scene, key, value, hz * factor, id);
                    assert_eq!(
                        growth <= 1.0,
                        is_stable,
                        "{id} over {key} at {hz} Hz, {value}: {growth:e}"
                    );
                    *(if is_stable { &mut inside } else { &mut outside }) += 1;
                }
            }
            assert!(inside > 3 && outside > 3, "{id} over {key}: {inside}, {outside}");
        }
    }
}

#[test]
fn freely_drifting_masses_are_stable_under_damping_methods() {
    // These are two cars with a spring and a damper between them, so that their common drift has no force.
    let scene = law("constants = { k = 30.0, c = 2.0, m = 3.0 }\n\
        [law.coordinates.x]\nstart = 0.3\nacceleration = 'k*(y-x) + c*(vy-vx)'\n\
        [law.coordinates.y]\nacceleration = '(k*(x-y) + c*(vx-vy))/m'");
    let ids = ["semi-implicit-euler", "velocity-verlet", "rk4", "implicit-euler", "bdf2"];
    let map = map_of(&scene, "k", 60, &ids);
    for (here, id) in map.here.iter().zip(ids) {
        assert_eq!(*here, PointStability::Stable, "{id}");
    }
    assert_eq!(map.regions[3].coverage, Coverage::Everywhere);
    assert!(holds(&map.regions[0], 60.0, 30.0) && !holds(&map.regions[0], 3.0, 1e3));
}

#[test]
fn a_nonlinearisable_law_has_a_reason_and_true_growth_does_not_count() {
    let single = |acceleration: &str| {
        law(&format!(
            "constants = {{ k = 9.0, b = 1.0 }}\n[law.coordinates.x]\nstart = 0.3\nacceleration = '{acceleration}'"
        ))
    };
    for (acceleration, refused) in [
        ("-k*x - b*sign(vx)", Some(NoSmallMotion::Corner)),
        ("-k*max(x, 0)", Some(NoSmallMotion::Corner)),
        ("-k*x*sqrt(abs(x))", None),
        ("-k*x^3", None),
        ("-k*sqrt(abs(x))*sign(x)", Some(NoSmallMotion::Corner)),
        ("-k*x - b*vx*abs(vx)", None),
        ("-k*x^3 - b*vx", None),
        ("-k*sin(x) + b*cos(2*t)", Some(NoSmallMotion::NoRest)),
        ("-k*sin(x) + b*cos(x)", None),
        ("-k*(1 + 0.3*cos(t))*x", Some(NoSmallMotion::Unsteady)),
        ("b + k*x^2", Some(NoSmallMotion::NoRest)),
        ("-k*x + b*vx - vx^3", None),
    ] {
        let map = map_of(&single(acceleration), "k", 60, &["rk4"]);
        assert_eq!(map.refused, refused, "{acceleration}");
    }
    // An upright pendulum falls in truth, so its fall under semi-implicit Euler at a high rate does not count.
    let map = map_of(&single("k*sin(x)"), "k", 60, &["semi-implicit-euler"]);
    assert!(map.truth_grows);
    assert_eq!(map.here[0], PointStability::Stable);
    assert!(!map_of(&single("-k*sin(x)"), "k", 60, &["rk4"]).truth_grows);
}

#[test]
fn a_law_is_mapped_about_its_rest() {
    // A controlled drone hovers at a nonzero force.
    let map =
        map_of(&Scene::built_in("lift").unwrap(), "rotor", 30, &["semi-implicit-euler", "rk4"]);
    assert_eq!((map.refused, map.is_linear), (None, false));
    assert!(map.here.contains(&PointStability::Stable), "{:?}", map.here);
    let scene = Scene::built_in("quarter-car").unwrap();
    assert_eq!(map_of(&scene, "kt", 100, &["rk4"]).refused, None);
}

#[test]
fn a_body_without_rest_has_no_map_and_a_pendulum_is_mapped_by_small_swings() {
    for (name, is_possible) in [("orbit", false), ("pendulum", true), ("chain", true)] {
        let scene = Scene::built_in(name).unwrap();
        let body = &scene.bodies[0];
        let (index, _) = body.kind.parameter(&body.kind.leading).unwrap();
        let specs = vec![(0, LaneSpec::plain(method("semi-implicit-euler").unwrap()))];
        let request = MapRequest::new((0, index), body, &body.values, 60, specs);
        let mut work = MapWork::new(body.kind.clone(), request);
        while !work.is_done() {
            work.advance(u64::MAX);
        }
        assert_eq!(work.map.refused.is_none(), is_possible, "{name}");
        assert_eq!(work.map.regions.len(), usize::from(is_possible), "{name}");
    }
}

#[test]
fn a_follower_is_mapped_on_a_body_of_its_rate() {
    let scene = Scene::built_in("lerp").unwrap();
    let (body, specs) = (&scene.bodies[0], scene.lanes.clone());
    for (tick_hz, is_stable) in [(6, true), (4, false)] {
        let specs = specs.iter().copied().enumerate().collect();
        let request = MapRequest::new((0, 1), body, &body.values, tick_hz, specs);
        let mut work = MapWork::new(body.kind.clone(), request);
        while !work.is_done() {
            work.advance(u64::MAX);
        }
        let map = work.map();
        let [per_frame, by_dt, exact, euler] = map.here[..] else { panic!("{:?}", map.here) };
        assert_eq!([per_frame, exact], [PointStability::Stable; 2]);
        for here in [by_dt, euler] {
            assert_eq!(here == PointStability::Stable, is_stable, "{here:?} at {tick_hz} Hz");
        }
        assert_eq!(map.regions[0].coverage, Coverage::Everywhere);
        assert!(holds(&map.regions[1], 12.0, 20.0) && !holds(&map.regions[1], 8.0, 20.0));
    }
}

#[test]
fn visible_damping_is_constant_along_an_engines_line() {
    let map = spring(0.0, &["engine-rapier", "engine-mujoco", "implicit-euler"]);
    let [rapier, mujoco, own] = &map.regions[..] else { panic!() };
    assert!(mujoco.seen.is_empty() && own.seen.is_empty(), "{mujoco:?}");
    let mut ratios: Vec<f64> = rapier.seen.iter().map(|line| line.damping_ratio).collect();
    ratios.dedup();
    assert_eq!(ratios, [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5]);
    for DampingLine { damping_ratio, points } in &rapier.seen {
        for [x, y] in points {
            // Implicit Euler with four substeps per tick.
            let [hz, stiffness] = [x, y].map(|log| libm::pow(10.0, *log));
            let z = stiffness.sqrt() / hz / 4.0;
            let [decay, turned] = [(1.0 + z * z).ln() / 2.0, z.atan()];
            let ratio = decay / decay.hypot(turned);
            // With more than half a turn per tick, a player sees another swing.
            let is_seen = 4.0 * turned < std::f64::consts::PI;
            let is_near = (ratio / damping_ratio - 1.0).abs() < 0.02;
            assert!(is_near || !is_seen, "{hz} Hz, {stiffness}: {ratio}");
        }
    }
}
