//! A scene says how a law is drawn, and the picture is so.

use glam::DVec2;
use regatta::look::{Framing, Look, Pull};
use regatta::run::Lane;
use regatta::scene::{Mark, Outline, Scene};
use regatta::sim::Solver;

const HEAD: &str = "title = 'Mine'\ntick_hz = 60\nseconds = 10\n[[law]]\n";
const TWO: &str =
    "[law.coordinates.z]\nacceleration = '-z'\n[law.coordinates.u]\nacceleration = 'z - 9*u'\n";

fn read(keys: &str, coordinates: &str) -> Result<Scene, String> {
    Scene::parse("mine.toml", &format!("{HEAD}{keys}{coordinates}")).map_err(|it| it.to_string())
}

fn truth(scene: &Scene) -> Lane {
    Lane::new(scene, Solver::Truth, 1)
}

/// The body of a built-in scene, with its picture at these coordinates.
fn drawn(scene: &str, q: &[f64]) -> (Outline, Framing, Vec<DVec2>) {
    let lane = truth(&Scene::built_in(scene).unwrap());
    let look = Look::of(&lane.bodies()[0]);
    let handles = look.handles(q).iter().map(|handle| handle.at).collect();
    (look.outline(0.0, q), look.framing(), handles)
}

#[test]
fn the_picture_of_a_law_survives_writing_and_reading() {
    for draw in ["beads", "vertical", "carriage", "follower"] {
        let scene = read(&format!("draw = '{draw}'\n"), TWO).unwrap();
        let written = scene.to_toml();
        assert_eq!(written.contains(&format!("draw = \"{draw}\"")), draw != "beads", "{written}");
        let again = Scene::parse("mine.toml", &written).unwrap();
        assert!(again.bodies[0].kind == scene.bodies[0].kind);
    }
}

#[test]
fn an_invalid_picture_is_refused_with_its_place_and_a_remedy() {
    let one = "[law.coordinates.z]\nacceleration = '-z'\n";
    let newton = "[law.coordinates.f]\nunit = 'N'\nacceleration = '-f'\n";
    for (keys, coordinates, wanted) in [
        (
            "draw = 'vertcal'\n",
            one,
            "mine.toml:5:8: unknown picture \"vertcal\"; did you mean `vertical`?",
        ),
        ("draw = 3\n", one, "mine.toml:5:8: `draw` is the integer 3, not a string"),
        (
            "plane = ['z', 'u']\ndraw = 'vertical'\n",
            TWO,
            "mine.toml:6:8: the law has a `plane` and a `draw`; leave one of them out",
        ),
        ("draw = 'carriage'\n", one, "a carriage needs two coordinates of one unit"),
        ("draw = 'carriage'\n", &format!("{one}{newton}"), "write another `draw`"),
    ] {
        let told = read(keys, coordinates).map(|_| ()).unwrap_err();
        assert!(told.contains(wanted), "{told}");
    }
    let told = read("draw = 3\n", one).map(|_| ()).unwrap_err();
    assert!(told.contains("\"beads\" or \"vertical\" or \"carriage\" or \"follower\""), "{told}");
}

#[test]
fn the_jumper_falls_down_the_drone_climbs_and_the_car_stands_on_its_wheel() {
    let (jumper, framing, handles) = drawn("bouncing-bungee", &[-20.0]);
    assert_eq!((jumper.at, &handles[..]), (DVec2::new(0.0, -20.0), &[DVec2::new(0.0, -20.0)][..]));
    let cord = Mark::Rod { from: DVec2::ZERO, to: jumper.at };
    assert!(jumper.marks.contains(&cord), "{:?}", jumper.marks);
    let Framing::Fixed { centre_m, half_m, .. } = framing else { panic!("{framing:?}") };
    assert!(centre_m.y + half_m.y > 0.0 && half_m.y > 15.0, "{centre_m} {half_m}");

    // The force of the rotors is no place.
    let (drone, _, handles) = drawn("lift", &[8.0, 11.0]);
    assert_eq!((drone.at, handles.len()), (DVec2::new(0.0, 8.0), 1));
    assert!(!drone.marks.iter().any(|mark| matches!(mark, Mark::Rod { .. })));

    let (car, _, handles) = drawn("quarter-car", &[0.02, -0.01]);
    let parts = |outline: &Outline| {
        let mut parts = [f64::NAN; 2];
        for mark in &outline.marks {
            match *mark {
                Mark::Block { centre, half } => parts[0] = centre.y - half.y,
                Mark::Disc { centre, radius } => parts[1] = centre.y + radius,
                _ => {}
            }
        }
        parts
    };
    let [floor, tyre] = parts(&car);
    assert!(floor > tyre, "the body is over the wheel: {floor} {tyre}");
    let [_, higher] = parts(&drawn("quarter-car", &[0.02, 0.09]).0);
    assert!((higher - tyre - 0.1).abs() < 1e-12, "the kerb lifts the wheel");
    assert!(handles[0].y > handles[1].y);

    assert!(matches!(drawn("duffing", &[1.0]).1, Framing::Recorder { .. }));
}

/// A pendulum of two rods, and a third coordinate that is not drawn.
const RODS: &str = "constants = { l = 2 }\n\
    [law.coordinates.a]\nunit = 'rad'\nstart = 1\nacceleration = '-sin(a)'\n\
    at = ['l*sin(a)', '-l*cos(a)']\n\
    [law.coordinates.b]\nunit = 'rad'\nacceleration = '-4*b'\n\
    at = ['l*sin(a) + sin(b)', '-l*cos(a) - cos(b)']\n\
    [law.coordinates.f]\nunit = 'N'\nstart = 7\nacceleration = '-f'\n";

#[test]
fn a_law_is_drawn_and_grabbed_at_the_positions_of_its_scene() {
    let scene = read("", RODS).unwrap();
    let again = Scene::parse("mine.toml", &scene.to_toml()).unwrap();
    assert!(again.bodies[0].kind == scene.bodies[0].kind, "{}", scene.to_toml());

    let lane = truth(&scene);
    let (look, q) = (Look::of(&lane.bodies()[0]), [1.0, -0.5, 7.0]);
    let upper = 2.0 * DVec2::new(1.0_f64.sin(), -1.0_f64.cos());
    let lower = upper + DVec2::new((-0.5_f64).sin(), -(-0.5_f64).cos());
    let outline = look.outline(0.0, &q);
    let discs = outline.marks.iter().filter_map(|mark| match *mark {
        Mark::Disc { centre, .. } => Some(centre),
        _ => None,
    });
    let discs: Vec<DVec2> = discs.collect();
    assert_eq!((outline.at, discs.len()), (upper, 2));
    assert!(discs[0].distance(upper) < 1e-12 && discs[1].distance(lower) < 1e-12, "{discs:?}");
    let Framing::Fixed { centre_m, half_m, .. } = look.framing() else { panic!() };
    // It swings from 1 rad to the other side, with the lower rod straight down.
    for corner in [upper - DVec2::Y, DVec2::new(-upper.x, upper.y - 1.0), DVec2::new(0.0, -3.0)] {
        assert!((corner - centre_m).abs().cmple(half_m).all(), "{corner} {centre_m} {half_m}");
    }

    let to = DVec2::new(1.5, -2.0);
    let (mut q, mut v) = (q, [0.0, 0.0, 3.0]);
    let pull = Pull { handle: 1, to, velocity: DVec2::new(0.25, 0.5) };
    look.pull(&mut q, &mut v, pull);
    assert!(look.handles(&q)[1].at.distance(to) < 1e-6, "{q:?}");
    assert_eq!((q[2], v[2]), (7.0, 3.0), "what moves no disc keeps its state");
    let moved = [0, 1].map(|i| q[i] + 1e-6 * v[i]);
    let there = look.handles(&[moved[0], moved[1], 7.0])[1].at;
    assert!(((there - to) / 1e-6).distance(pull.velocity) < 1e-3, "{there}");
}

#[test]
fn invalid_positions_are_refused_with_their_place_and_a_remedy() {
    let with = |keys: &str, at: &str| {
        let one = format!("[law.coordinates.z]\nacceleration = '-z'\nat = {at}\n");
        read(keys, &one).map(|_| ()).unwrap_err()
    };
    for (keys, at, wanted) in [
        ("", "['z', 'zz']", "mine.toml:7:12: unknown name `zz`"),
        ("", "['vz', '0']", "a place depends on coordinates and constants alone, not on `vz`"),
        ("", "['z']", "`at` is not an x and a y; write two expressions for x and y"),
        ("", "'z'", "mine.toml:7:6: `at` is the string"),
        (
            "draw = 'vertical'\n",
            "['z', '0']",
            "mine.toml:5:8: the law has a `draw`, and a coordinate",
        ),
    ] {
        let told = with(keys, at);
        assert!(told.contains(wanted), "{told}");
    }
}

#[test]
fn the_drawn_orbit_passes_through_present_and_future_positions() {
    let mut lane = truth(&Scene::built_in("orbit").unwrap());
    let body = &lane.bodies()[0];
    let course = Look::of(body).course(body.stepper.q(), body.stepper.v());
    assert!(course.len() > 100 && course[0].distance(*course.last().unwrap()) < 1e-9);
    for tick in 0..300 {
        let place = lane.bodies()[0].stepper.place();
        let near = course.windows(2).map(|ends| {
            let along = ends[1] - ends[0];
            let part = ((place - ends[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            place.distance(ends[0] + part * along)
        });
        let near = near.fold(f64::INFINITY, f64::min);
        assert!(near < 2e-3 * course[0].length(), "tick {tick}: {near} m");
        lane.tick(tick, tick as f64 / 10.0, 0.1);
    }
}
