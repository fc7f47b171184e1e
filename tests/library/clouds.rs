//! What a method does to an area, and what a cloud says of it.

use regatta::lab::palette::Theme;
use regatta::lab::{
    Cloud, CloudShape, CloudStart, Density, ExactBorder, LaneSpec, NoCloud, PlaneView, Scene,
};
use regatta::sim::integrators::method;
use regatta::sim::{Solver, Stepper};

fn body(scene: &str) -> Box<dyn Stepper> {
    let scene = Scene::built_in(scene).unwrap();
    let rk4 = Solver::Method(method("rk4").unwrap());
    (scene.bodies[0].kind.build)(&scene.bodies[0].values, rk4)
}

fn cloud(scene: &str, id: &str, shape: CloudShape, points: usize, hz: u32) -> Cloud {
    let body = body(scene);
    let start = CloudStart::about("it", &*body, shape, None).unwrap();
    let spec = LaneSpec::plain(method(id).unwrap());
    Cloud::new("it", &*body, &spec, start, points, hz).unwrap()
}

#[test]
fn explicit_euler_grows_the_area_of_a_spring_by_its_determinant_and_a_symplectic_method_keeps_it() {
    // (1 + h² ω²) in each tick, of a spring of 1 Hz.
    let mut grown = cloud("spring", "explicit-euler", CloudShape::Disc, 100, 60);
    grown.advance(60);
    let z = std::f64::consts::TAU / 60.0;
    let ratio = grown.measure().area_ratio.unwrap();
    assert!((ratio / libm::pow(1.0 + z * z, 60.0) - 1.0).abs() < 1e-9, "{ratio}");
    assert!(grown.in_words(&grown.measure()).starts_with("grows ×2 in"));
    let mut kept = cloud("spring", "semi-implicit-euler", CloudShape::Ring, 100, 60);
    kept.advance(600);
    assert!((kept.measure().area_ratio.unwrap() - 1.0).abs() < 1e-9);
    assert_eq!(kept.in_words(&kept.measure()), "keeps area");
}

#[test]
fn a_body_that_is_not_linear_is_measured_by_cells() {
    let ratio = |id: &str| {
        let mut cloud = cloud("liouville", id, CloudShape::Cat, 8000, 12);
        assert!(!cloud.is_by_determinant());
        cloud.advance(12);
        cloud.measure().area_ratio.unwrap()
    };
    assert!(ratio("explicit-euler") > 1.4);
    assert!((0.9..1.1).contains(&ratio("semi-implicit-euler")));
    assert!(ratio("implicit-euler") < 0.7);
}

#[test]
fn a_start_that_blows_up_drops_out_of_the_count() {
    let mut cloud = cloud("stiff", "explicit-euler", CloudShape::Disc, 50, 60);
    cloud.advance(300);
    assert_eq!(cloud.measure().points, 0);
    assert_eq!(cloud.measure().area_ratio, None);
    assert_eq!(cloud.in_words(&cloud.measure()), "is lost");
}

#[test]
fn a_body_of_two_coordinates_has_no_cloud() {
    let found = CloudStart::about("satellite", &*body("orbit"), CloudShape::Disc, None);
    let expected = NoCloud::SeveralCoordinates { body: "satellite".into(), coordinates: 2 };
    assert_eq!(found.unwrap_err(), expected);
}

#[test]
fn an_accurate_method_fills_the_exact_border_and_a_picture_shows_every_point() {
    let body = body("pendulum");
    let start = CloudStart::about("it", &*body, CloudShape::Disc, Some(0.2)).unwrap();
    let mut border = ExactBorder::new("it", &*body, start, 60).unwrap();
    let mut cloud = cloud("pendulum", "pefrl", CloudShape::Disc, 900, 60);
    border.advance(30);
    cloud.advance(0);
    let exact = border.lines().concat();
    let view = PlaneView::around(&exact, &[[f64::NAN, 0.0]], true);
    let mut density =
        Density::new([40, 30], PlaneView { q: [-99.0, 99.0], v: [-99.0, 99.0], ..view });
    density.add(cloud.q(), cloud.v());
    assert_eq!(density.counts().iter().sum::<u32>(), 900);
    let colour = [10, 200, 100, 255];
    let picture = density.picture(Theme::Dark, colour, &[]);
    let lit = |n: &usize| picture[*n] != Theme::Dark.palette().plot;
    assert!((0..picture.len()).all(|n| lit(&n) == (density.counts()[n] > 0)));
}
