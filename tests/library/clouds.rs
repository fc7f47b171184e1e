//! The effect of a method on an area, and the words of a cloud about it.

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::Arc;

use rayon::ThreadPoolBuilder;
use regatta::look::density_picture;
use regatta::look::palette::Theme;
use regatta::measure::cloud::{
    Cloud, CloudBody, CloudBorder, CloudChoice, CloudPicture, CloudShape, CloudStart, CloudWorker,
    Density, NoCloud, PlaneView,
};
use regatta::prelude::Options;
use regatta::scene::{Action, LaneSpec, Scene, Scripted};
use regatta::sim::bodies::{Kind, Tumble};
use regatta::sim::integrators::method;
use regatta::sim::{Solver, State, Stepper, System};
use regatta::studio::{
    Command, Instrument, RunCommand, StageCommand, Studio, ViewCommand, accept_cloud,
    cloud_refusal, cloud_request, complete_clouds, shown_cloud,
};

use crate::scenes::edited;

/// The first body of a scene, with its kind.
struct Built(Arc<Kind>, Box<dyn Stepper>);

impl Built {
    fn of(&self) -> CloudBody<'_> {
        CloudBody { name: "it", kind: &self.0, body: &*self.1 }
    }
}

fn built(scene: &Scene) -> Built {
    let body = &scene.bodies[0];
    let rk4 = Solver::Method(method("rk4").unwrap());
    Built(body.kind.clone(), (body.kind.build)(&body.values, rk4))
}

fn body(scene: &str) -> Built {
    built(&Scene::built_in(scene).unwrap())
}

fn cloud(scene: &str, id: &str, shape: CloudShape, points: usize, hz: u32) -> Cloud {
    let body = body(scene);
    let start = CloudStart::about(body.of(), shape, None).unwrap();
    let spec = LaneSpec::plain(method(id).unwrap());
    Cloud::new(body.of(), &spec, start, points, hz).unwrap()
}

#[test]
fn area_grows_by_the_determinant_and_a_symplectic_method_keeps_it() {
    // (1 + h² ω²) in each tick, of a spring of 1 Hz.
    let mut grown = cloud("spring", "explicit-euler", CloudShape::Disc, 100, 60);
    grown.advance(60);
    let z = TAU / 60.0;
    let ratio = grown.measure().area_ratio.unwrap();
    assert!((ratio / libm::pow(1.0 + z * z, 60.0) - 1.0).abs() < 1e-9, "{ratio}");
    assert!(grown.in_words(grown.area_ratio(), []).starts_with("grows ×2 in"));
    let mut kept = cloud("spring", "semi-implicit-euler", CloudShape::Ring, 100, 60);
    kept.advance(600);
    assert!((kept.measure().area_ratio.unwrap() - 1.0).abs() < 1e-9);
    assert_eq!(kept.in_words(kept.area_ratio(), []), "keeps area");
}

#[test]
fn steps_that_keep_the_brackets_of_l_keep_areas_of_its_sphere() {
    for scene in ["coin", "t-handle", "phone"] {
        for id in ["split-3", "split-5", "gyro-off"] {
            let mut kept = cloud(scene, id, CloudShape::Disc, 200, 60);
            kept.advance(240);
            let ratio = kept.measure().area_ratio.unwrap();
            assert!((ratio - 1.0).abs() < 1e-6, "{id} on {scene}: {ratio}");
        }
        let mut changed = cloud(scene, "linearly-implicit-euler", CloudShape::Disc, 200, 60);
        changed.advance(240);
        let ratio = changed.measure().area_ratio;
        assert!(ratio.is_none_or(|ratio| (ratio - 1.0).abs() > 0.5), "{scene}: {ratio:?}");
    }
}

#[test]
fn a_cloud_of_spins_fits_its_sphere_or_is_refused() {
    let of_t_handle = body("t-handle");
    let start = |reach| CloudStart::about(of_t_handle.of(), CloudShape::Disc, Some(reach));
    let Err(NoCloud::OverThePole { most, .. }) = start(4.0) else { panic!("it has room") };
    assert!((0.3..1.6).contains(&most) && start(most).is_ok() && start(most + 0.01).is_err());
    let mut wide = cloud("t-handle", "split-3", CloudShape::Disc, 500, 60);
    wide.advance(1200);
    // All around the sphere: the points are 1 from its middle, and began half of 0.05 √2 from theirs.
    let spread = wide.measure().spread.unwrap();
    assert!((5.0..1.001 / (0.05 / 2.0_f64.sqrt())).contains(&spread), "{spread}");
    let text =
        Scene::built_in("coin").unwrap().to_toml().replace("[2.0, 0.0, 30.0]", "[0.0, 0.0, 0.0]");
    let at_rest = built(&Scene::parse("coin", &text).unwrap());
    let found = CloudStart::about(at_rest.of(), CloudShape::Disc, None);
    assert!(matches!(found, Err(NoCloud::AtRest { .. })), "{found:?}");
}

#[test]
fn a_copy_of_a_spin_moves_as_the_body_with_that_spin() {
    let body = body("phone");
    let tumble: &Tumble = body.1.body().downcast_ref().unwrap();
    let start = CloudStart::about(body.of(), CloudShape::Disc, Some(0.3)).unwrap();
    let spec = LaneSpec::plain(method("gyro-newton").unwrap());
    let mut cloud = Cloud::new(body.of(), &spec, start, 3, 60).unwrap();
    let [angle, part] = [cloud.q()[2], cloud.v()[2]];
    let mut alone =
        (body.0.build)(&Scene::built_in("phone").unwrap().bodies[0].values, spec.solver());
    let momentum = tumble.momentum_in_body(alone.v());
    // The polar axis is the one that the direction of the middle has its part along.
    let axis = (0..3).find(|&n| momentum[n] / momentum.length() == start.middle[1]).unwrap();
    let across = (1.0 - part * part).sqrt();
    let mut omega = [0.0; 3];
    for (n, of) in
        [(axis, part), (axis + 1, across * libm::cos(angle)), (axis + 2, across * libm::sin(angle))]
    {
        omega[n % 3] = of * momentum.length() / tumble.moments[n % 3];
    }
    let (q, mut v) = (alone.q().to_vec(), alone.v().to_vec());
    v[..3].copy_from_slice(&omega);
    alone.set(0.0, &q, &v);
    (0..120_u32).for_each(|tick| alone.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap());
    cloud.advance(120);
    let [angle, part] = tumble.direction(alone.v());
    assert!((cloud.v()[2] - part).abs() < 1e-9, "{} and {part}", cloud.v()[2]);
    assert!(libm::sin((cloud.q()[2] - angle) / 2.0).abs() < 1e-9, "{} and {angle}", cloud.q()[2]);
}

#[test]
fn area_on_a_spring_follows_the_determinant_even_for_distant_points() {
    // 16 swings a second at 60 Hz.
    let mut thrown = cloud("stiff", "explicit-euler", CloudShape::Disc, 100, 60);
    thrown.advance(60);
    let body = body("stiff");
    let mut a = [0.0];
    body.1.acceleration(0.0, &[1.0], &[0.0], &mut a);
    let exact = libm::pow(1.0 - a[0] / 3600.0, 60.0);
    let ratio = thrown.area_ratio().unwrap();
    assert!(exact > 1e30 && (ratio / exact - 1.0).abs() < 1e-9, "{ratio}, not {exact}");
    let mut kept = cloud("stiff", "semi-implicit-euler", CloudShape::Disc, 100, 40);
    kept.advance(30);
    assert!(kept.measure().spread.unwrap() > 1e15);
    assert!((kept.area_ratio().unwrap() - 1.0).abs() < 1e-9);
}

#[test]
fn a_nonlinear_body_is_measured_about_many_points() {
    let ratio = |id: &str| {
        let mut cloud = cloud("liouville", id, CloudShape::Cat, 8000, 12);
        assert!(cloud.measured_in_words().ends_with("around 256 points"));
        cloud.advance(12);
        cloud.measure().area_ratio.unwrap()
    };
    assert!(ratio("explicit-euler") > 1.4);
    assert!((ratio("semi-implicit-euler") - 1.0).abs() < 1e-5);
    assert!(ratio("implicit-euler") < 0.7);
}

#[test]
fn only_a_symplectic_method_keeps_the_area_of_a_wound_cloud() {
    let wound = |id: &str| {
        let mut cloud = cloud("pendulum", id, CloudShape::Cat, 2000, 60);
        cloud.advance(600);
        cloud.in_words(cloud.area_ratio(), [])
    };
    assert_eq!(wound("semi-implicit-euler"), "keeps area");
    assert_eq!(wound("rk4"), "keeps area");
    let euler = wound("explicit-euler");
    assert!(euler.contains("×"), "{euler}");
}

#[test]
fn area_is_exact_even_where_the_map_separates_neighbours() {
    let ratio = |scene: &str, id: &str, [hz, ticks]: [u32; 2]| {
        let mut cloud = cloud(scene, id, CloudShape::Cat, 4000, hz);
        cloud.advance(u64::from(ticks));
        cloud.area_ratio().unwrap()
    };
    for id in ["semi-implicit-euler", "velocity-verlet", "stormer-verlet"] {
        let kept = ratio("kicked-rotor", id, [60, 1200]);
        assert!((kept - 1.0).abs() < 1e-4, "{id}: {kept}");
    }
    // Each step takes h c / m of the velocity.
    let shrunk = ratio("duffing", "semi-implicit-euler", [20, 400]);
    let exact = libm::pow(1.0 - 0.25 / 20.0, 400.0);
    assert!((shrunk / exact - 1.0).abs() < 1e-4, "{shrunk}, not {exact}");
    // Far below the rounding of corners that are stepped from the start: 1 - z + z²/2 - z³/6 + z⁴/24 of z = 1.5 each step.
    let tiny = ratio("surge", "rk4", [1, 30]);
    assert!((tiny / libm::pow(0.273_437_5, 30.0) - 1.0).abs() < 1e-9, "{tiny}");
}

#[test]
fn adaptive_area_is_exact_even_across_kinks_of_the_force() {
    for id in ["dormand-prince-54", "bogacki-shampine-32", "adaptive-euler"] {
        for (scene, ticks) in [("bouncing-bungee", 300), ("duffing", 300), ("pendulum", 60)] {
            let body = body(scene);
            let start = CloudStart::about(body.of(), CloudShape::Disc, None).unwrap();
            let mut exact = CloudBorder::exact(body.of(), start, 60).unwrap();
            let mut cloud = cloud(scene, id, CloudShape::Disc, 4000, 60);
            exact.go_to(ticks);
            cloud.advance(ticks);
            let [found, exact] = [cloud.area_ratio(), exact.area_ratio()].map(Option::unwrap);
            assert!((found / exact - 1.0).abs() < 1e-3, "{scene}, {id}: {found}, not {exact}");
        }
    }
}

#[test]
fn an_area_does_not_depend_on_the_path_to_its_tick() {
    for id in ["rk4", "velocity-verlet", "adams-bashforth-2", "dormand-prince-54"] {
        let new = || cloud("pendulum", id, CloudShape::Disc, 400, 60).rewindable();
        let (mut straight, mut back) = (new(), new());
        straight.go_to(77);
        back.go_to(200);
        back.go_to(77);
        let areas = [&straight, &back].map(|cloud| cloud.area_ratio().map(f64::to_bits));
        assert!(areas[0].is_some() && areas[0] == areas[1], "{id}: {areas:?}");
    }
}

#[test]
fn a_view_of_only_lost_points_is_finite() {
    let lost = [[f64::NAN, 1.0], [f64::INFINITY, f64::NAN]];
    let views = [
        PlaneView::around(&[], &[], 0.5, false),
        PlaneView::around(&lost, &lost, 0.5, true),
        PlaneView::around(&lost, &[[1.0, 2.0]], 0.5, false),
    ];
    for view in views {
        let ends = [view.q, view.v].concat();
        assert!(ends.iter().all(|end| end.is_finite()), "{ends:?}");
        assert!(view.q[0] < view.q[1] && view.v[0] < view.v[1], "{ends:?}");
    }
}

#[test]
fn a_start_that_blows_up_is_not_counted() {
    let mut cloud = cloud("stiff", "explicit-euler", CloudShape::Disc, 50, 60);
    cloud.advance(300);
    assert_eq!(cloud.measure().points, 0);
    assert_eq!(cloud.measure().area_ratio, None);
    assert_eq!(cloud.in_words(cloud.area_ratio(), []), "is lost");
}

#[test]
fn a_body_of_two_coordinates_has_no_cloud() {
    let found = CloudStart::about(body("orbit").of(), CloudShape::Disc, None);
    let expected = NoCloud::SeveralCoordinates { body: "it".into(), coordinates: 2 };
    assert_eq!(found.unwrap_err(), expected);
}

#[test]
fn an_accurate_cloud_fills_the_exact_border_and_shows_every_point() {
    let body = body("pendulum");
    let start = CloudStart::about(body.of(), CloudShape::Disc, Some(0.2)).unwrap();
    let mut border = CloudBorder::exact(body.of(), start, 60).unwrap();
    let mut cloud = cloud("pendulum", "pefrl", CloudShape::Disc, 900, 60);
    border.go_to(30);
    cloud.advance(0);
    let exact = border.lines().concat();
    let view = PlaneView::around(&exact, &[[f64::NAN, 0.0]], 1.0, true);
    let mut density =
        Density::new([40, 30], PlaneView { q: [-99.0, 99.0], v: [-99.0, 99.0], ..view });
    density.add(cloud.q(), cloud.v());
    assert_eq!(density.counts().iter().sum::<u32>(), 900);
    let colour = [10, 200, 100, 255];
    let picture = density_picture(&density, [40, 30], Theme::Dark, colour);
    assert!((0..picture.len()).all(|n| (picture[n][3] > 0) == (density.counts()[n] > 0)));
}

#[test]
fn the_number_of_threads_changes_no_count_of_a_picture() {
    let view = PlaneView { q: [0.0, 1.0], v: [0.0, 1.0], wraps: false };
    let part = |by: f64| (0..300_001).map(|n| (f64::from(n) * by).fract() * 1.1).collect();
    let [q, v]: [Vec<f64>; 2] = [part(0.754_877_666), part(0.569_840_29)];
    let counts = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut density = Density::new([64, 48], view);
        pool.install(|| density.add(&q, &v));
        density.counts().to_vec()
    };
    let one = counts(1);
    let shown = q.iter().zip(&v).filter(|(q, v)| **q < 1.0 && **v < 1.0).count();
    assert_eq!(one.iter().map(|count| *count as usize).sum::<usize>(), shown);
    assert!(one == counts(2) && one == counts(7));
}

/// A race that shows the clouds of its lanes.
fn race_of(scene: &str, methods: &[&str], shape: CloudShape) -> Studio {
    let plain = |id: &&str| LaneSpec::plain(method(id).unwrap());
    let lanes = methods.iter().map(plain).collect();
    let mut studio =
        Studio::new(edited(&Scene::built_in(scene).unwrap(), |scene| scene.lanes = lanes));
    studio.apply(StageCommand::ToggleRace);
    studio.apply(StageCommand::Instrument(Instrument::Cloud));
    studio.apply(RunCommand::Cloud(CloudChoice { shape, points: 1500 }));
    studio
}

fn picture<'l>(studio: &'l mut Studio, worker: &mut CloudWorker) -> &'l CloudPicture {
    complete_clouds(studio, worker, || false);
    shown_cloud(studio).expect("it was stepped").picture.as_ref().unwrap()
}

/// All that a picture shows.
fn shown(picture: &CloudPicture) -> String {
    let lanes = picture.lanes.iter().map(|lane| (lane.density.counts(), &lane.areas, &lane.words));
    let lanes: Vec<_> = lanes.collect();
    format!("{:?} {:?} {:?} {lanes:?}", picture.view, picture.border, picture.exact)
}

#[test]
fn a_cloud_does_not_depend_on_the_path_to_its_tick() {
    // The second has a memory; the third has one too and steps its points one by one.
    let methods = ["rk4", "adams-bashforth-2", "dormand-prince-54", "implicit-euler"];
    let new = || race_of("liouville", &methods, CloudShape::default());
    let at = |ticks: u64| {
        let mut studio = new();
        (0..ticks).for_each(|_| studio.tick());
        shown(picture(&mut studio, &mut CloudWorker::default()))
    };
    let (early, late) = (at(37), at(70));
    assert_ne!(early, late);
    let (mut studio, mut worker) = (new(), CloudWorker::default());
    for tick in 0..70 {
        studio.tick();
        if tick % 3 == 0 {
            picture(&mut studio, &mut worker);
        }
    }
    assert!(shown(picture(&mut studio, &mut worker)) == late);
    studio.apply(RunCommand::Seek(37));
    assert!(shown(picture(&mut studio, &mut worker)) == early, "back");
    studio.apply(RunCommand::Seek(70));
    assert!(shown(picture(&mut studio, &mut worker)) == late, "and forth");
}

#[test]
fn late_clouds_drop_points_and_regain_them_when_paused() {
    let mut studio = race_of("liouville", &["rk4", "midpoint"], CloudShape::default());
    studio.apply(RunCommand::Cloud(CloudChoice { points: 10_000, ..CloudChoice::default() }));
    let mut worker = CloudWorker::default();
    let mut points = BTreeSet::new();
    // Two ticks go by for each that is stepped.
    for _ in 0..20 {
        worker.set_request(cloud_request(&studio).map(Arc::new));
        worker.work().into_iter().for_each(|found| accept_cloud(&mut studio, found));
        points.insert(shown_cloud(&studio).unwrap().picture.as_ref().unwrap().points);
        (0..2).for_each(|_| studio.tick());
    }
    assert_eq!(Vec::from_iter(points), [1_000, 10_000], "and no fewer");
    studio.apply(ViewCommand::TogglePause);
    let whole = shown(picture(&mut studio, &mut worker));
    assert_eq!(shown_cloud(&studio).unwrap().picture.as_ref().unwrap().points, 10_000);
    assert!(whole == shown(picture(&mut studio, &mut CloudWorker::default())));
    // Those that are asked for late have fewer from their first picture on.
    studio.apply(ViewCommand::TogglePause);
    (0..600).for_each(|_| studio.tick());
    let mut late = CloudWorker::default();
    late.set_request(cloud_request(&studio).map(Arc::new));
    let first = std::iter::repeat_with(|| late.work()).find_map(|found| found);
    assert_eq!(first.unwrap().picture.unwrap().points, 1_000);
}

#[test]
fn the_axes_of_a_picture_fit_its_clouds() {
    let mut studio = race_of("liouville", &["rk4"], CloudShape::default());
    let picture = picture(&mut studio, &mut CloudWorker::default());
    let border = picture.border.concat();
    let reach = [0, 1].map(|axis| {
        let at = border.iter().map(|&[q, v]| picture.view.place(q, v)[axis]);
        at.fold([1.0_f64, 0.0_f64], |[low, high], at| [low.min(at), high.max(at)])
    });
    for [low, high] in reach {
        assert!(low > 0.0 && high < 1.0 && high - low > 0.6, "{reach:?}");
    }
}

#[test]
fn clouds_restart_after_a_change_and_those_of_the_same_lanes_stay_until_then() {
    let mut studio = race_of("liouville", &["rk4", "explicit-euler"], CloudShape::default());
    studio.apply(StageCommand::ToggleRace);
    let mut worker = CloudWorker::default();
    (0..6).for_each(|_| studio.tick());
    picture(&mut studio, &mut worker);
    let set = Action::Set { body: 0, parameter: 0, value: 2.0 };
    for (command, stays) in [
        (Command::Stage(StageCommand::TickHz(24.into())), true),
        (Command::Stage(StageCommand::Pick(1)), false),
        (Command::Run(RunCommand::Act(set)), false),
    ] {
        studio.apply(command.clone());
        assert_eq!(shown_cloud(&studio).is_some(), stays, "{command:?}");
        (0..6).for_each(|_| studio.tick());
        let now = picture(&mut studio, &mut worker);
        assert!(now.tick > 0 && now.lanes[0].areas.len() > 3);
    }
    studio.apply(StageCommand::Instrument(Instrument::Motion));
    assert!(cloud_request(&studio).is_none() && shown_cloud(&studio).is_none());
}

/// The clouds of a law of one coordinate `x`, starting at 1, under Runge-Kutta after `ticks` ticks.
fn of_law(acceleration: &str, ticks: u64) -> CloudPicture {
    let text = format!(
        "title = \"it\"\nabout = \"it\"\ntick_hz = 100\nseconds = 10\nmethods = [\"rk4\"]\n\
         [[law]]\ncoordinates = {{ x = {{ start = 1.0, acceleration = \"{acceleration}\" }} }}\n"
    );
    let mut studio = Studio::new(Scene::parse("it.toml", &text).unwrap());
    studio.apply(StageCommand::Instrument(Instrument::Cloud));
    studio.apply(RunCommand::Cloud(CloudChoice { points: 2000, ..CloudChoice::default() }));
    (0..ticks).for_each(|_| studio.tick());
    picture(&mut studio, &mut CloudWorker::default()).clone()
}

#[test]
fn a_recovering_area_is_neither_growing_nor_kept() {
    // The area is exp(-sin t) of that at the start: the least of it a quarter of a turn after the start.
    let [turning, back] = [150, 314].map(|ticks| of_law("-x - cos(t)*vx", ticks));
    assert!(turning.lanes[0].words.starts_with("shrinks"), "{}", turning.lanes[0].words);
    assert!((back.lanes[0].area_ratio.unwrap() - 1.0).abs() < 0.01);
    assert_eq!(back.lanes[0].words, "was ×0.368 before");
}

#[test]
fn escaping_points_are_counted_and_do_not_dominate_the_area() {
    let points = |picture: &CloudPicture| {
        let [lane] = &picture.lanes[..] else { panic!("one lane") };
        let shown: u32 = lane.density.counts().iter().sum();
        [shown as usize, lane.hidden, lane.lost]
    };
    for ticks in (0..600).step_by(150) {
        let picture = of_law("-x + x^3", ticks);
        let [shown, hidden, lost] = points(&picture);
        assert_eq!(shown + hidden + lost, 2000, "after {ticks} ticks");
        assert!(ticks > 0 || shown == 2000, "after {ticks} ticks: {shown}");
        assert!(ticks < 400 || shown > 200 && lost > 200, "after {ticks} ticks: {shown}, {lost}");
        let area = picture.lanes[0].area_ratio;
        assert!(area.is_none_or(|area| (area - 1.0).abs() < 0.2), "after {ticks} ticks: {area:?}");
    }
}

#[test]
fn a_cloud_is_drawn_without_its_points_that_blow_up_after_a_restart() {
    let law = "title = \"it\"\nabout = \"it\"\ntick_hz = 60\nseconds = 9\nmethods = [\"explicit-euler\"]\n\
         [[law]]\ncoordinates = { x = { start = 1.0, acceleration = \"-x*x*x\" } }\n";
    let place = Action::Place { body: 0, q: [1e9].into(), v: [0.0].into() };
    let script = vec![Scripted { at_s: 0.05, action: place }];
    let mut studio =
        Studio::new(edited(&Scene::parse("it.toml", law).unwrap(), |scene| scene.script = script));
    studio.apply(StageCommand::Instrument(Instrument::Cloud));
    studio.apply(RunCommand::Cloud(CloudChoice { points: 500, ..CloudChoice::default() }));
    let mut worker = CloudWorker::default();
    for tick in 1..16 {
        studio.tick();
        let lane = &picture(&mut studio, &mut worker).lanes[0];
        assert!(lane.hidden + lane.lost <= 500, "at tick {tick}");
        assert!(tick < 12 || lane.lost == 500, "at tick {tick}: {}", lane.lost);
    }
}

#[test]
fn the_exact_cloud_follows_the_exact_body_through_kicks_and_edits() {
    let scene = Scene::built_in("pendulum").unwrap();
    let length =
        scene.bodies[0].kind.parameters.iter().position(|it| it.key == "length_m").unwrap();
    let set = |value: f64| Action::Set { body: 0, parameter: length, value };
    let script = Scripted::of_ticks(scene.tick_hz, [(10, Action::Kick(1.0)), (20, set(2.0))]);
    let mut studio = Studio::new(edited(&scene, |scene| scene.script = script));
    studio.apply(StageCommand::Instrument(Instrument::Cloud));
    let disc = CloudShape::Disc;
    studio.apply(RunCommand::Cloud(CloudChoice { shape: disc, points: 100 }));
    let mut worker = CloudWorker::default();
    (0..30).for_each(|_| studio.tick());
    for (tick, started) in [(6, 0), (16, 10), (26, 20), (36, 30), (26, 20)] {
        studio.apply(RunCommand::Seek(tick.min(30)));
        if tick == 36 {
            studio.apply(RunCommand::Act(set(0.5)));
            (0..6).for_each(|_| studio.tick());
        }
        let now = picture(&mut studio, &mut worker).clone();
        assert_eq!(now.tick, tick - started, "at tick {tick}");
        let body = &studio.race().truth().bodies()[0].stepper;
        let [line] = &now.border[..] else { panic!("a disc has one border") };
        // The border turns once about the body.
        let angle = |[q, v]: &[f64; 2]| (v - body.v()[0]).atan2(q - body.q()[0]);
        let ends = line.windows(2).map(|ends| angle(&ends[1]) - angle(&ends[0]));
        let turns = ends.map(|by| by.sin().atan2(by.cos())).sum::<f64>() / TAU;
        assert!((turns.abs() - 1.0).abs() < 0.02, "at tick {tick}: {turns}");
    }
}

#[test]
fn lanes_share_the_axes_of_their_clouds_and_lost_points_are_counted() {
    let methods = ["explicit-euler", "semi-implicit-euler", "velocity-verlet"];
    let mut studio = race_of("stiff", &methods, CloudShape::default());
    (0..240).for_each(|_| studio.tick());
    let picture = picture(&mut studio, &mut CloudWorker::default());
    assert_eq!(picture.lanes.iter().map(|lane| lane.entry).collect::<Vec<_>>(), [0, 1, 2]);
    let [euler, symplectic, verlet] = &picture.lanes[..] else { panic!("three lanes") };
    assert_eq!((euler.lost, &*euler.words), (1500, "is lost"));
    for lane in [symplectic, verlet] {
        assert_eq!((lane.lost, &*lane.words), (0, "keeps area"));
        assert!(lane.density.counts().iter().sum::<u32>() > 750, "it is in sight");
    }
}

#[test]
fn a_body_of_several_coordinates_has_no_cloud_with_the_reason() {
    let studio = race_of("orbit", &["rk4"], CloudShape::default());
    assert!(cloud_request(&studio).is_none());
    let why = cloud_refusal(&studio).unwrap().to_string();
    assert!(why.contains("satellite has 2"), "{why}");
    let studio = race_of("spring", &["rk4"], CloudShape::default());
    assert!(cloud_refusal(&studio).is_none());
}

#[test]
fn an_area_is_kept_within_a_millionth_and_larger_losses_are_reported() {
    for id in ["semi-implicit-euler", "velocity-verlet"] {
        let mut kept = cloud("liouville", id, CloudShape::default(), 4000, 12);
        kept.advance(720);
        assert_eq!(kept.in_words(kept.area_ratio(), []), "keeps area", "{id}");
    }
    let mut lost = cloud("liouville", "rk4", CloudShape::default(), 4000, 12);
    lost.advance(720);
    let ratio = lost.area_ratio().unwrap();
    assert!((0.9975..0.999).contains(&ratio), "{ratio}");
    let said = lost.in_words(Some(ratio), []);
    assert!(said.starts_with("loses 0.1") && said.ends_with(" %"), "{said}");
}

/// A spring of 1 Hz, which answers for its slope.
#[derive(Clone)]
struct Hertz;

impl System for Hertz {
    type Vector = f64;
    fn acceleration(&self, _t: f64, x: &f64, _v: &f64, a: &mut f64) {
        *a = -TAU * TAU * x;
    }
}

#[test]
fn a_custom_body_of_one_coordinate_has_a_bit_exact_cloud() {
    let start = State { q: 0.8, v: 0.1 };
    let scene = Scene::of(&Hertz, start, Options::default()).unwrap();
    let body = built(&scene);
    for id in ["rk4", "implicit-midpoint", "adams-bashforth-2"] {
        let spec = LaneSpec::plain(method(id).unwrap());
        let about = CloudStart::about(body.of(), CloudShape::Cat, None).unwrap();
        let mut cloud = Cloud::new(body.of(), &spec, about, 300, 60).unwrap();
        let mut twin = Cloud::of(&Hertz, start, CloudShape::Cat, 300, &spec, 60).unwrap();
        for cloud in [&mut cloud, &mut twin] {
            cloud.advance(90);
        }
        assert!(cloud.q().iter().chain(cloud.v()).all(|x| x.is_finite()), "{id}");
        assert_eq!([cloud.q(), cloud.v()], [twin.q(), twin.v()], "{id}");
        assert_eq!(cloud.area_ratio(), twin.area_ratio(), "{id}");
    }
}
