//! Stepping never allocates: not a method on any vector, not a race with its truth and its histories. Nor does one
//! thread that draws a window.
#![expect(unsafe_code, reason = "a global allocator that counts can only be written so")]

use std::alloc::{GlobalAlloc, Layout, System as SystemAllocator};
use std::cell::Cell;
#[cfg(feature = "view")]
use std::num::NonZero;

use regatta::loops::{ENGINES, POLICIES, Pacer, RefreshRate, TimeBase};
use regatta::run::{Observations, Race};
use regatta::scene::{Action, Options, SCENES, Scene};
use regatta::sim::bodies::{
    Body as _, Follow, Grid, NetLayout, NetPlan, Pin, Ship, Spring, Tumble, net_kind,
};
use regatta::sim::integrators::{
    BuildIntegrator, GENERAL_METHODS, ImplicitMidpoint, Integrator, METHODS, Method, Rk4,
    StepFailure, custom_integrator, integrator, method,
};
use regatta::sim::{Elementwise, Solver, State, Stepper, System, Vector, own_method, own_rule};
use regatta::studio::{StageCommand, Studio};
#[cfg(feature = "view")]
use regatta::view::{FrameRenderer, KeptFrame, egui};

use super::conformance::systems::{Sparse, fresh, problem, springs};

struct Counting;

thread_local! {
    /// By thread, because the harness allocates on its own.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
    static BYTES: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: everything is passed on unchanged; the count is a plain cell that needs no allocation.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        BYTES.set(BYTES.get() + layout.size());
        unsafe { SystemAllocator.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { SystemAllocator.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { SystemAllocator.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations_in(work: impl FnOnce()) -> u64 {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

/// The result of `work`, with the bytes that it allocates.
fn bytes_in<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let before = BYTES.get();
    let made = work();
    (made, BYTES.get() - before)
}

#[test]
fn the_counter_counts_allocations() {
    let mut kept = Vec::new();
    let count = allocations_in(|| kept = vec![1.0; 100]);
    let grown = allocations_in(|| kept.reserve(1000));
    assert_eq!((count, grown, kept.len()), (1, 1, 100));
}

/// Steps a system by each of these methods, as `make` makes it for vectors like this one.
fn all_step_without_allocating<S: System<Vector: Vector>>(
    methods: &[Method],
    system: &S,
    like: &S::Vector,
    make: fn(&Method, &S::Vector) -> Box<dyn Integrator<S>>,
) {
    for method in methods {
        let mut state = State { q: like.clone(), v: like.clone() };
        let mut integrator = make(method, like);
        let count = allocations_in(|| {
            for step in 0..300 {
                let stepped = integrator.step(system, 0.05 * f64::from(step), 0.05, &mut state);
                assert_eq!(stepped, Ok(()), "{} at step {step}", method.id);
                if step % 100 == 0 {
                    // Not to decay to nothing.
                    state.q.assign(like);
                    state.v.assign(like);
                    integrator.reset();
                }
            }
            let stepped = integrator.steps(system, 0.0, 0.05, 16, &mut state);
            assert_eq!(stepped, Ok(()), "{}", method.id);
        });
        assert_eq!(count, 0, "{}", method.id);
    }
}

#[test]
fn no_method_allocates_in_hundreds_of_steps_on_any_vector() {
    let methods = GENERAL_METHODS;
    all_step_without_allocating(methods, &springs(400.0, 1.0), &1.0, |it, _| fresh(it));
    all_step_without_allocating(methods, &springs(400.0, 1.0), &glam::DVec2::ONE, integrator);
    let many = vec![1.0; 50];
    all_step_without_allocating(methods, &springs(400.0, 1.0), &many, integrator);
    // Solved by iteration, with slopes by differences.
    all_step_without_allocating(methods, &Sparse(springs(400.0, 1.0)), &many, integrator);
}

#[test]
fn custom_methods_and_bodies_do_not_allocate() {
    let card = |own: &'static dyn BuildIntegrator| Method {
        id: "mine",
        custom: Some(own),
        ..*method("rk4").expect("a method")
    };
    let mine = [
        card(&custom_integrator::<Rk4<Vec<f64>>>),
        Method { id: "mine-too", ..card(&custom_integrator::<ImplicitMidpoint<Vec<f64>>>) },
    ];
    all_step_without_allocating(&mine, &springs(400.0, 1.0), &glam::DVec2::ONE, integrator);
    let spring = Spring { mass: 1.0, stiffness: 400.0, damping: 1.0, x0: 1.0, v0: 0.0, kick: 1.0 };
    all_step_without_allocating(&mine, &problem(spring.clone()), &1.0, |it, _| fresh(it));

    let start = State { q: 1.0, v: 0.0 };
    let mut race = Race::of(&spring, start, Options::default());
    race.run(10);
    assert_eq!(allocations_in(|| race.run(1000)), 0);
}

#[test]
fn no_follower_allocates_in_hundreds_of_steps() {
    let special = &METHODS[GENERAL_METHODS.len()..];
    let engines = special.iter().position(Method::is_engine).expect("engines after the followers");
    let (first, second) = special[..engines].split_at(3);
    let rule = own_rule("chase", "x += (target - x) * 20 * dt", 30.into()).unwrap();
    let decay = own_method("decay", method("exponential-decay").unwrap().code).unwrap();
    let own = [rule, decay].map(|own| (1, std::slice::from_ref(own)));
    for (order, methods) in [(1, first), (2, second)].into_iter().chain(own) {
        let camera = Follow { order, rate: 5.0, step: 1.0, ..Follow::default() };
        all_step_without_allocating(methods, &problem(camera), &0.0, |it, _| fresh(it));
    }
}

/// The methods of the table that are so, which follow each other.
fn run_of(is_so: fn(&Method) -> bool) -> &'static [Method] {
    let runs = METHODS.chunk_by(|a, b| is_so(a) == is_so(b));
    runs.into_iter().find(|run| is_so(&run[0])).expect("methods in a row")
}

#[test]
fn no_engine_allocates_in_hundreds_of_steps() {
    let ship = Ship { drag: 1.0, mass: 2.0, thrust: 3.0, ..Ship::BLANK };
    all_step_without_allocating(run_of(Method::is_engine), &problem(ship), &0.0, |it, _| fresh(it));
}

#[test]
fn no_method_of_a_free_spin_allocates_in_hundreds_of_steps() {
    let body = Tumble {
        moments: [1.0, 2.0, 3.0].into(),
        spin: [3.0, 0.5, 0.5].into(),
        attitude: glam::DQuat::IDENTITY,
        mass: 1.0,
        kick: [0.0; 3].into(),
    };
    let like = body.start().q;
    let gyros = run_of(Method::is_for_spin);
    all_step_without_allocating(gyros, &problem(body), &like, integrator);
}

#[test]
fn no_spring_of_an_interface_allocates_in_hundreds_of_steps() {
    let interfaces = run_of(|method| method.is_of_library() && !method.is_engine());
    let spring = Spring { mass: 1.0, stiffness: 400.0, damping: 1.0, x0: 1.0, v0: 0.0, kick: 1.0 };
    all_step_without_allocating(interfaces, &problem(spring), &1.0, |it, _| fresh(it));
}

#[test]
fn no_loop_allocates_in_hundreds_of_frames() {
    let base = TimeBase::new(60, RefreshRate::new(2997, 50));
    for card in POLICIES.iter().chain(ENGINES.iter()) {
        let mut pacer = Pacer::new(card, base);
        let mut ticks = 0;
        let count = allocations_in(|| {
            for n in 0..500 {
                ticks += pacer.frame(16_683_350 + n * n % 9_000_000).count;
            }
        });
        assert!(count == 0 && ticks > 100, "{}: {count} allocations, {ticks} ticks", card.id);
    }
}

/// The built-in scenes of nets, or all others: thousands of ticks of a net take minutes in an unoptimised build.
fn scenes(are_nets: bool) -> impl Iterator<Item = Scene> {
    let scenes = SCENES.iter().map(|it| Scene::built_in(it.name).expect("a built-in scene"));
    scenes.filter(move |scene| scene.bodies.iter().any(|it| it.kind.net().is_some()) == are_nets)
}

/// Performs an action, which allocates nothing but the checkpoint that it leaves: its list of bodies with three of each,
/// and its list of lanes, which grows, with a list of bodies and two of each.
fn perform(race: &mut Race, seen: &mut Observations, action: &Action) {
    let mut unseen = race.clone();
    assert_eq!(allocations_in(|| _ = unseen.perform(action, &mut ())), 0, "{action:?}");
    let (bodies, lanes) = (race.truth().bodies().len(), race.entrants().len());
    let count = allocations_in(|| _ = race.perform(action, seen));
    let most = 2 + 3 * bodies + lanes * (2 + 2 * bodies);
    assert!(count <= most as u64, "{action:?}: {count} for {bodies} bodies in {lanes} lanes");
}

#[test]
fn no_net_allocates_under_the_methods_of_its_scene() {
    for scene in scenes(true) {
        let mut race = Race::new(&scene, scene.lanes.iter().copied());
        let mut seen = Observations::new(&race, scene.seconds);
        for tick in 0..150 {
            assert_eq!(allocations_in(|| race.step(&mut seen)), 0, "{}", scene.name);
            if tick == 50 {
                perform(&mut race, &mut seen, &Action::Kick(1.0));
            }
        }
    }
}

#[test]
fn a_race_does_not_allocate_while_its_histories_fill_and_wrap() {
    for scene in scenes(false) {
        let mut race = Race::new(&scene, scene.lanes.iter().copied());
        let mut seen = Observations::new(&race, scene.seconds);
        // Histories wrap alike for every body, and that takes thousands of ticks.
        let ticks =
            if ["harbour", "helm", "orbit"].contains(&scene.name.as_str()) { 5000 } else { 1500 };
        for tick in 0..ticks {
            assert_eq!(allocations_in(|| race.step(&mut seen)), 0, "{}", scene.name);
            if tick % 500 == 0 {
                for action in [Action::Kick(1.0), Action::Throttle(0.5), Action::Rudder(-0.5)] {
                    perform(&mut race, &mut seen, &action);
                }
            }
        }
    }
}

#[test]
fn the_studio_allocates_only_at_snapshots_and_once_a_second() {
    for scene in scenes(false) {
        let mut studio = Studio::new(scene);
        studio.apply(StageCommand::ToggleRace);
        // A lane that halts is announced in words, which do: let those halt first that will.
        for _ in 0..1500 {
            studio.tick();
        }
        let mut snapshots = 0;
        for _ in 0..500 {
            if allocations_in(|| studio.tick()) > 0 {
                let (tick, hz) =
                    (studio.race().tick(), u64::from(studio.race().tick_hz().whole_hz().unwrap()));
                let is_due = tick.is_multiple_of(32) || tick.is_multiple_of(hz);
                assert!(is_due, "{} at tick {tick}", studio.scene().name);
                snapshots += u32::from(tick.is_multiple_of(32));
            }
        }
        assert!((1..=500_u32.div_ceil(32)).contains(&snapshots), "{snapshots}");
        let count = allocations_in(|| _ = studio.advance(1_000_000));
        assert_eq!(count, 0, "{}", studio.scene().name);
    }
}

#[test]
fn stepper_memory_matches_its_report_within_a_factor_of_three() {
    let solvers = GENERAL_METHODS.iter().map(Solver::Method).chain([Solver::Truth]);
    for solver in solvers {
        for name in ["harbour", "chain", "helm", "orbit", "pendulum"] {
            for body in &Scene::built_in(name).expect("a built-in scene").bodies {
                let stepper = (body.kind.build)(&body.values, solver);
                let (copy, allocated) = bytes_in(|| stepper.clone());
                let said = copy.bytes(solver);
                let place = format!("{}, {solver:?}: {said}, {allocated}", body.kind.id);
                assert!((allocated..=3 * allocated).contains(&said), "{place}");
            }
        }
    }
}

/// A grid of `columns` × `rows` nodes under Runge-Kutta 4.
fn large_net(columns: usize, rows: usize) -> Box<dyn Stepper> {
    net_under(Solver::Method(method("rk4").expect("a method")), columns, rows)
}

/// A grid of `columns` × `rows` nodes.
fn net_under(solver: Solver, columns: usize, rows: usize) -> Box<dyn Stepper> {
    let grid = Grid { columns, rows, spacing: 0.1, shear: true, pin: Some(Pin::Corners) };
    let kind = net_kind(NetPlan { form: NetLayout::Grid(grid), kicked: None }).expect("a net");
    (kind.build)(&[0.02, 200.0, 0.0, 0.0, 9.81, 1.0, 1.0, 0.0], solver)
}

#[test]
fn a_large_net_is_stepped_without_allocating() {
    let mut net = large_net(120, 100);
    let count = allocations_in(|| {
        for tick in 0..20 {
            net.advance(f64::from(tick) / 240.0, 1.0 / 240.0, 1).expect("a gentle motion");
        }
    });
    assert_eq!(count, 0);
}

#[test]
fn a_large_net_uses_two_hundred_bytes_per_node() {
    let (net, bytes) = bytes_in(|| large_net(200, 100));
    let per_node = bytes as f64 / (net.q().len() / 2) as f64;
    // The state, eight vectors of the method, and for a moment two numbers of each node. The lists of the springs, which the
    // lanes share, grow in place, and growth is not counted.
    assert!((150.0..200.0).contains(&per_node), "{per_node} bytes");
}

#[test]
fn truth_memory_matches_its_report() {
    let (mut refused, bytes) = bytes_in(|| net_under(Solver::Truth, 200, 100));
    let nodes = refused.q().len() / 2;
    assert!(bytes / nodes < 150, "{} bytes a node", bytes / nodes);
    let (failed, more) = bytes_in(|| refused.advance(0.0, 1.0 / 60.0, 1).expect_err("too dear"));
    assert!(matches!(failed, StepFailure::ReferenceTooExpensive { .. }), "{failed}");
    assert!(more < 1000, "{more} bytes");
    let (copy, allocated) = bytes_in(|| refused.clone());
    assert!(
        (allocated..=6 * allocated).contains(&copy.bytes(Solver::Truth)),
        "{} {allocated}",
        copy.bytes(Solver::Truth)
    );
    let small = net_under(Solver::Truth, 4, 4);
    let (solved, allocated) = bytes_in(|| small.clone());
    assert!(
        (allocated..=3 * allocated).contains(&solved.bytes(Solver::Truth)),
        "{} {allocated}",
        solved.bytes(Solver::Truth)
    );
}

#[cfg(feature = "view")]
#[test]
fn one_thread_draws_the_frames_of_a_window_without_allocating() {
    let mut studio = Studio::new(Scene::built_in("harbour").expect("a built-in scene"));
    studio.apply(StageCommand::ToggleRace);
    let mut renderer = FrameRenderer::new(4096);
    let mut kept = KeptFrame::new(NonZero::<usize>::MIN);
    let mut frame = |running: bool| {
        if running {
            studio.advance(100_000_000);
        }
        let input = egui::RawInput { time: Some(studio.race().t()), ..Default::default() };
        let (_, output) = renderer.draw([320, 180], 0.5, input, &studio);
        allocations_in(|| kept.draw(&output.drawing))
    };
    // Trails are full by then, and letters are known.
    (0..400).for_each(|_| _ = frame(true));
    let running: u64 = (0..60).map(|_| frame(true)).sum();
    let paused: u64 = (0..60).map(|_| frame(false)).sum();
    // New letters and one more vertex than ever need memory now and then.
    assert!(running < 10, "{running} in 60 frames");
    assert_eq!(paused, 0);
}
