//! A scene says how a law is drawn, and the picture is so.

use glam::DVec2;
use regatta::lab::picture::{Framing, Look, Mark, Outline};
use regatta::lab::{Scene, SceneBody};
use regatta::sim::{Solver, Stepper};

const HEAD: &str = "title = 'Mine'\ntick_hz = 60\nseconds = 10\n[[law]]\n";
const TWO: &str =
    "[law.coordinates.z]\nacceleration = '-z'\n[law.coordinates.u]\nacceleration = 'z - 9*u'\n";

fn read(keys: &str, coordinates: &str) -> Result<Scene, String> {
    Scene::parse("mine.toml", &format!("{HEAD}{keys}{coordinates}")).map_err(|it| it.to_string())
}

/// The body of a built-in scene, with what shows it at these coordinates.
fn drawn(scene: &str, q: &[f64]) -> (Outline, Framing, Vec<DVec2>) {
    let SceneBody { kind, values, .. } = Scene::built_in(scene).unwrap().bodies.remove(0);
    let body: Box<dyn Stepper> = (kind.build)(&values, Solver::Truth);
    let look = Look::of(kind);
    let handles = look.handles(&*body, q).iter().map(|handle| handle.at).collect();
    (look.outline(&*body, 0.0, q), look.framing(&*body), handles)
}

#[test]
fn a_law_keeps_its_picture_when_it_is_written_and_read_again() {
    for draw in ["beads", "vertical", "carriage", "follower"] {
        let scene = read(&format!("draw = '{draw}'\n"), TWO).unwrap();
        let written = scene.to_toml();
        assert_eq!(written.contains(&format!("draw = \"{draw}\"")), draw != "beads", "{written}");
        let again = Scene::parse("mine.toml", &written).unwrap();
        assert!(std::ptr::eq(again.bodies[0].kind, scene.bodies[0].kind));
    }
}

#[test]
fn a_picture_that_cannot_be_is_refused_with_its_place_and_a_remedy() {
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

#[test]
fn the_course_of_an_orbit_goes_through_its_body_and_through_where_it_will_be() {
    let SceneBody { kind, values, .. } = Scene::built_in("orbit").unwrap().bodies.remove(0);
    let mut body = (kind.build)(&values, Solver::Truth);
    let course = Look::of(kind).course(&*body, body.q(), body.v());
    assert!(course.len() > 100 && course[0].distance(*course.last().unwrap()) < 1e-9);
    for tick in 0..300 {
        let place = body.place();
        let near = course.windows(2).map(|ends| {
            let along = ends[1] - ends[0];
            let part = ((place - ends[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            place.distance(ends[0] + part * along)
        });
        let near = near.fold(f64::INFINITY, f64::min);
        assert!(near < 2e-3 * course[0].length(), "tick {tick}: {near} m");
        body.advance(f64::from(tick) / 10.0, 0.1, 1).unwrap();
    }
}
