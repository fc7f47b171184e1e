//! The syntax of scene files and its meaning.

use regatta::run::Race;
use regatta::scene::{
    Action, LaneId, LaneSpec, MAX_BODIES, MAX_LANES, MAX_SECONDS, MAX_TICK_HZ, Scene, SceneBody,
    SceneKey, scene_tables,
};
use regatta::sim::TickRate;
use regatta::sim::integrators::{GENERAL_METHODS, method};
use regatta::studio::{StageCommand, Studio};

use crate::scenes::edited;

use super::built_in;

fn parse(text: &str) -> Scene {
    Scene::parse("scenes/mine.toml", text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn parse_body(body: &str) -> Scene {
    parse(&format!("title = 'Mine'\ntick_hz = 60\nseconds = 10\n{body}"))
}

const SPRING: &str = "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";

#[test]
fn a_chain_and_a_helm_are_read_with_their_counts_and_points() {
    let chain = "[[chain]]\nmass_kg = 1\nstiffness_n_per_m = 40\nmasses = 3\nplucked_mass = 3\n";
    let helm = "[[helm]]\nmass_kg = 1\ninertia_kg_m2 = 1\ndrag_n_s_per_m = 1\n\
                side_drag_n_s_per_m = 1\nyaw_drag_n_m_s = 1\nrudder_n_s = 1\n\
                thrust_curve = [[-2, 7.5], [0x10, -1e3], [1e15, 0]]\n";
    let scene = parse_body(&format!("{chain}{helm}"));
    assert_eq!(scene.bodies[0].values, [3.0, 1.0, 40.0, 0.0, 3.0, 1.0, 3.0]);
    assert_eq!(scene.bodies[1].values[11..], [-2.0, 7.5, 16.0, -1e3, 1e15, 0.0]);
    let names = |body: &SceneBody| {
        let coordinates = body.kind.coordinates(&body.values);
        coordinates.iter().map(|c| format!("{} {}", c.name, c.velocity)).collect::<Vec<_>>()
    };
    assert_eq!(names(&scene.bodies[0]), ["x1 v1", "x2 v2", "x3 v3"]);
    assert_eq!(names(&scene.bodies[1]), ["x vx", "y vy", "psi r"]);
}

/// The number of methods for games that step any body.
fn for_games() -> usize {
    GENERAL_METHODS.iter().filter(|method| method.is_for_games()).count()
}

#[test]
fn a_minimal_scene_races_every_game_method_with_default_values() {
    let scene = parse_body(SPRING);
    assert_eq!((scene.name.as_str(), scene.title.as_str()), ("mine", "Mine"));
    assert_eq!((scene.about.as_str(), scene.hint), ("", None));
    assert_eq!((scene.tick_hz, scene.seconds), (60.into(), 10.0));
    assert_eq!(scene.lanes.len(), for_games());
    let spring = &scene.bodies[0];
    let defaults = spring.kind.parameters[2..].iter().map(|parameter| parameter.default.unwrap());
    assert_eq!(spring.values, [1.0, 40.0].into_iter().chain(defaults).collect::<Vec<_>>());
    assert!(scene.script.is_empty());
}

#[test]
fn lanes_keep_their_order_and_differ_by_method_or_substeps() {
    let lane = |id, substeps| LaneSpec { substeps, ..LaneSpec::plain(method(id).unwrap()) };
    let scene = parse_body(&format!("methods = ['rk4', 'explicit-euler']\n{SPRING}"));
    assert_eq!(scene.lanes, [lane("rk4", 1), lane("explicit-euler", 1)]);
    let lanes = "[[lane]]\nmethod = 'rk4'\n[[lane]]\nmethod = 'rk4'\nsubsteps = 1000\n";
    let scene = parse_body(&format!("{lanes}{SPRING}"));
    assert_eq!(scene.lanes, [lane("rk4", 1), lane("rk4", 1000)]);
}

#[test]
fn an_adaptive_lane_uses_its_own_tolerance() {
    let lane = "[[lane]]\nmethod = 'dormand-prince-54'\n";
    let lanes = format!("{lane}{lane}tolerance = 1\n{lane}tolerance = 1e-12\n{lane}substeps = 2\n");
    let mut scene = parse_body(&format!("{lanes}{SPRING}"));
    let given: Vec<_> = scene.lanes.iter().map(|lane| lane.tolerance).collect();
    assert_eq!(given, [None, Some(1.0), Some(1e-12), None]);
    scene.tick_hz = 2.into();

    let mut race = Race::new(&scene, scene.lanes.iter().copied());
    // The last one comes into its tolerance on the way.
    let switch = Action::Lane { lane: LaneId(4), spec: scene.lanes[2] };
    race.perform(&switch, &mut ());
    for _ in 0..20 {
        race.step(&mut ());
    }
    let truth = race.truth().bodies()[0].stepper.q()[0];
    let of_lane = |i: usize| {
        let lane = &race.entrants()[i].lane;
        assert_eq!(lane.solver(), scene.lanes[i.min(2)].solver());
        ((lane.bodies()[0].stepper.q()[0] - truth).abs(), lane.evaluations())
    };
    let [plain, loose, tight, switched] = [0, 1, 2, 3].map(of_lane);
    assert!(loose.0 > 1e-3 && plain.0 < 1e-4 && tight.0 < 1e-9, "{loose:?} {plain:?} {tight:?}");
    assert!(loose.1 < plain.1 && plain.1 < tight.1, "{loose:?} {plain:?} {tight:?}");
    assert_eq!(switched, tight);
}

#[test]
fn bodies_keep_the_order_of_the_file_and_get_unused_names() {
    let named = "name = 'spring-2'\n";
    let ship = "[[ship]]\nthrust_n = 1\ndrag_n_s_per_m = 0\nmass_kg = 1\n";
    let scene = parse_body(&format!("{SPRING}{ship}{SPRING}{named}{SPRING}"));
    let names: Vec<_> = scene.bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["spring-1", "ship", "spring-2", "spring-3"]);
    let kinds: Vec<_> = scene.bodies.iter().map(|body| body.kind.id).collect();
    assert_eq!(kinds, ["spring", "ship", "spring", "spring"]);
}

#[test]
fn a_script_is_sorted_by_time_and_then_by_order_in_the_file() {
    let script = [
        "at_s = 120\nmethod = 'rk4'",
        "at_s = 0.75\nkick = -2",
        "at_s = 120.0\nthrottle = -1.0",
        "at_s = 0\ntick_hz = 10_000",
    ];
    let script: String = script.map(|command| format!("[[command]]\n{command}\n")).concat();
    let ship = "[[ship]]\nthrust_n = 1\ndrag_n_s_per_m = 0\nmass_kg = 1\n";
    let scene = parse_body(&format!("{script}{ship}"));
    let script: Vec<_> = scene.script.iter().map(|each| (each.at_s, each.action.clone())).collect();
    let expected = [
        (0.0, Action::TickHz(10_000.into())),
        (0.75, Action::Kick(-2.0)),
        (120.0, Action::Method(method("rk4").unwrap())),
        (120.0, Action::Throttle(-1.0)),
    ];
    assert_eq!(script, expected);
}

#[test]
fn a_tick_rate_is_a_decimal_a_ratio_or_a_step_and_is_written_back() {
    for (line, rate, written) in [
        ("tick_hz = 66.667", "66.667", "tick_hz = 66.667"),
        ("tick_hz = 60.0", "60", "tick_hz = 60"),
        ("tick_hz = 6e1", "60", "tick_hz = 60"),
        ("tick_hz = 0.5", "0.5", "tick_hz = 0.5"),
        ("tick_hz = '60000/1001'", "60000/1001", "tick_hz = \"60000/1001\""),
        ("tick_hz = '1/0.015'", "200/3", "step_s = 0.015"),
        ("step_s = 0.015", "200/3", "step_s = 0.015"),
        ("step_s = 2", "0.5", "tick_hz = 0.5"),
        ("step_s = '1/66.667'", "66.667", "tick_hz = 66.667"),
    ] {
        let command = format!("[[command]]\nat_s = 1\n{line}\n");
        let scene = parse(&format!("title = 'Mine'\n{line}\nseconds = 10\n{SPRING}{command}"));
        let rate: TickRate = rate.parse().unwrap();
        assert_eq!((scene.tick_hz, &scene.script[0].action), (rate, &Action::TickHz(rate)));
        let text = scene.to_toml();
        assert_eq!(text.matches(&format!("\n{written}\n")).count(), 2, "{line}:\n{text}");
        assert!(text.matches("tick_hz").count() + text.matches("step_s").count() == 2, "{text}");
        assert_eq!((parse(&text).tick_hz, parse(&text).script), (rate, scene.script));
    }
}

#[test]
fn numbers_may_be_whole_signed_grouped_hexadecimal_and_physically_extreme() {
    let scene = parse_body(
        "[[spring]]\nmass_kg = 1e-300\nstiffness_n_per_m = 1_000_000_000_000_000\n\
         damping_n_s_per_m = -0.0\nx0_m = 0x10\nv0_m_per_s = +3\n",
    );
    assert_eq!(scene.bodies[0].values[..5], [1e-300, 1e15, 0.0, 16.0, 3.0]);
}

#[test]
fn each_limit_itself_is_allowed() {
    let lanes: String =
        (1..=MAX_LANES).map(|n| format!("[[lane]]\nmethod = 'rk4'\nsubsteps = {n}\n")).collect();
    let scene = parse(&format!(
        "title = '{}'\ntick_hz = {MAX_TICK_HZ}\nseconds = {MAX_SECONDS}\n{lanes}{}\
         [[command]]\nat_s = {MAX_SECONDS}\nkick = 1\n",
        "é".repeat(80),
        SPRING.repeat(MAX_BODIES),
    ));
    assert_eq!((scene.lanes.len(), scene.bodies.len()), (MAX_LANES, MAX_BODIES));
    assert_eq!((scene.tick_hz, scene.seconds), (TickRate::MAX, MAX_SECONDS));
    assert_eq!(scene.script[0].at_s, MAX_SECONDS);
}

#[test]
fn line_endings_byte_order_mark_and_inline_tables_do_not_matter() {
    let text = format!("title = 'Mine'\ntick_hz = 60\nseconds = 10\n{SPRING}");
    let read = |text: &str| format!("{:?}", edited(&parse(text), |scene| scene.source = None));
    let expected = read(&text);
    let inline = "title = 'Mine'\ntick_hz = 60\nseconds = 10\n\
                  spring = [{ mass_kg = 1, stiffness_n_per_m = 40 }]";
    for variant in [&text.replace('\n', "\r\n"), &format!("\u{feff}{text}"), inline] {
        assert_eq!(read(variant), expected);
    }
}

#[test]
fn a_scene_without_lanes_races_the_methods_that_step_all_its_bodies() {
    let camera = |order: u32| format!("[[follow]]\norder = {order}\nrate_per_s = 5\n");
    let ids = |scene: &Scene| scene.lanes.iter().map(|lane| lane.method.id).collect::<Vec<_>>();
    let others = |scene: &Scene| ids(scene)[for_games()..].to_vec();
    let first = parse_body(&camera(1));
    assert_eq!(others(&first), ["lerp-per-frame", "lerp-dt", "exponential-decay"]);
    let second = parse_body(&camera(2));
    let followers = ["smooth-damp", "critically-damped-spring", "implicit-spring"];
    assert_eq!(others(&second), followers);
    for mixed in [format!("{}{}", camera(1), camera(2)), format!("{SPRING}{}", camera(2))] {
        assert!(others(&parse_body(&mixed)).is_empty());
    }
    // A method that does not race is still on the list of methods if it fits.
    let listed = parse_body(&format!("methods = ['rk4']\n{}", camera(2))).method_list();
    assert_eq!(listed.len(), GENERAL_METHODS.len() + followers.len());
    assert!(!listed.iter().any(|spec| spec.method.id == "lerp-dt"));
}

#[test]
fn an_unsuitable_method_is_refused_with_the_reason() {
    let mut studio = Studio::new(built_in("spring"));
    let before = studio.active();
    studio.apply(StageCommand::Method(method("smooth-damp").unwrap()));
    assert_eq!(studio.active(), before);
    let notice = studio.viewer.notice.as_deref().unwrap_or_default();
    assert!(notice.contains("smooth-damp does not step the body \"spring\""), "{notice}");
}

#[test]
fn the_manual_has_every_key_of_a_scene_file() {
    let mut section = String::new();
    for (name, keys) in scene_tables() {
        let name = if name.starts_with('[') { format!("`{name}`") } else { name };
        section += &format!("\n| {name} | | |\n|---|---|---|\n");
        for SceneKey { key, is_required, about, value } in keys {
            let key = if is_required { format!("**`{key}`**") } else { format!("`{key}`") };
            section += &format!("| {key} | {about} | {value} |\n");
        }
    }
    let manual = regatta::manual::chapter("scenes").expect("a chapter").text;
    assert!(manual.contains(&section), "{section}");
}
