//! Nets in scene files.

use regatta::run::Race;
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::bodies::{MAX_NODES, Pin};
use regatta::sim::integrators::method;
use regatta::studio::Studio;

use super::{PLAIN, build, grid, with};
use crate::scenes::edited;

fn parse(net: &str) -> Scene {
    let text = format!("title = 't'\ntick_hz = 60\nseconds = 1\n[[net]]\n{net}\n");
    Scene::parse("t", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

const GRID: &str = "columns = 5\nrows = 3\nspacing_m = 0.25\nshear = true\npin = 'top'\n\
                    mass_kg = 0.1\nstiffness_n_per_m = 90\nkicked_node = 9";
const LISTS: &str = "nodes = [[0, 0], [1, 0.5], [2, -1e-3]]\nfixed = [2]\nmass_kg = 2\n\
                     stiffness_n_per_m = 90\nrest_ratio = 0.9\n\
                     springs = [{ between = [0, 1] }, { between = [2, 1], stiffness_n_per_m = 7, \
                     damping_n_s_per_m = 0.5, rest_m = 0.0 }]";

#[test]
fn a_net_survives_writing_and_reading() {
    for net in [GRID, LISTS] {
        let scene = parse(net);
        let again = Scene::parse("t", &scene.to_toml()).unwrap();
        assert_eq!(again.to_toml(), scene.to_toml());
        assert!(again.bodies[0].kind == scene.bodies[0].kind, "one plan, one kind");
        assert_eq!(again.bodies[0].values, scene.bodies[0].values);
    }
    assert!(parse(GRID).bodies[0].kind != parse(LISTS).bodies[0].kind);
}

#[test]
fn a_grid_has_its_declared_nodes_springs_and_pins() {
    let scene = parse(GRID);
    let plan = scene.bodies[0].kind.net().unwrap();
    let lists = plan.lists();
    assert_eq!((lists.nodes.len(), &lists.fixed[..]), (15, &[0, 1, 2, 3, 4][..]));
    assert_eq!((lists.nodes[0], lists.nodes[14]), ([0.0, 0.0], [1.0, -0.5]));
    // Twelve along the rows, ten down the columns, and two across each of eight squares; those of the top row would
    // join fixed nodes.
    assert_eq!(lists.springs.len(), 12 + 10 + 16 - 4);
    assert_eq!(plan.kicked, Some(9));
}

#[test]
fn a_kick_of_the_script_reaches_the_net() {
    let text = format!(
        "title = 't'\ntick_hz = 60\nseconds = 1\n[[net]]\n{GRID}\ngravity_m_per_s2 = 0\n[[command]]\nat_s = 0.05\nkick = 1\n"
    );
    let mut studio = Studio::new(Scene::parse("t", &text).unwrap());
    let velocity = |studio: &Studio| studio.race().truth().bodies()[0].stepper.v()[0];
    (0..3).for_each(|_| studio.tick());
    assert_eq!(velocity(&studio), 0.0);
    studio.tick();
    assert!(velocity(&studio) > 1.0, "{}", velocity(&studio));
}

/// Whether a method gets through a built-in scene at a rate, without a coordinate running away.
fn holds(name: &str, id: &str, tick_hz: u32) -> bool {
    let scene = edited(&Scene::built_in(name).unwrap(), |scene| scene.tick_hz = tick_hz.into());
    let mut race = Race::new(&scene, [LaneSpec::plain(method(id).unwrap())]);
    race.run(u64::from(tick_hz) * 4);
    let body = &race.entrants()[0].lane.bodies()[0];
    body.halted().is_none() && body.stepper.q().iter().all(|x| x.abs() < 100.0)
}

#[test]
fn the_scenes_keep_the_promises_of_their_hints() {
    for (name, id, tick_hz, wanted) in [
        ("rope", "explicit-euler", 120, false),
        ("rope", "semi-implicit-euler", 120, true),
        ("rope", "semi-implicit-euler", 100, false),
        ("cloth", "semi-implicit-euler", 60, false),
        ("cloth", "semi-implicit-euler", 120, false),
        ("cloth", "semi-implicit-euler", 240, true),
        ("cloth", "implicit-euler", 60, true),
        ("cloth", "implicit-midpoint", 60, true),
        ("bridge", "semi-implicit-euler", 60, false),
        ("bridge", "rk4", 60, false),
        ("bridge", "semi-implicit-euler", 100, false),
        ("bridge", "semi-implicit-euler", 120, true),
        ("bridge", "implicit-euler", 60, true),
    ] {
        assert_eq!(holds(name, id, tick_hz), wanted, "{name}, {id}, {tick_hz} Hz");
    }
}

#[test]
fn a_net_has_at_most_a_hundred_thousand_nodes() {
    let net = build(&grid(400, 250, Some(Pin::Corners)), PLAIN, with("semi-implicit-euler"));
    assert_eq!(net.q().len(), 2 * (MAX_NODES - 2));
    let said = grid(401, 250, None).faults().remove(0);
    assert_eq!(said.what, "the grid has 100250 nodes");
}
