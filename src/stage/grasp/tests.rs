use super::*;
use crate::scene::Scene;
use crate::sim::bodies::BODIES;
use crate::studio::{RunCommand, ViewCommand};
use crate::{Picture, compose};

const SIZE: [f32; 2] = [800.0, 500.0];

/// The built-in scene for this kind, paused a few ticks after its start.
fn studio(kind: &str) -> Studio {
    let mut studio = Studio::new(Scene::with_kind(kind));
    studio.apply(ViewCommand::TogglePause);
    (0..7).for_each(|_| studio.tick());
    studio
}

fn picture(studio: &Studio) -> Picture {
    compose(studio, SIZE)
}

fn off(grip: &Grip, by: [f32; 2]) -> [f32; 2] {
    [grip.at[0] + by[0], grip.at[1] + by[1]]
}

#[test]
fn every_handle_of_every_kind_can_be_grabbed_and_is_at_least_12_points_wide() {
    for kind in BODIES.iter() {
        let studio = studio(kind.id);
        let picture = picture(&studio);
        let cell = &picture.cells[0];
        let own = cell.grips(&studio).filter(|grip| grip.whose != Whose::Truth);
        for grip in own {
            assert_eq!(cell.grip_at(&studio, grip.at), Some(grip), "{}", kind.id);
            assert!(grip.radius >= 12.0);
            // Beads may be closer together.
            let beside = cell.grip_at(&studio, off(&grip, [0.0, 12.0]));
            assert!(beside.is_some_and(|grip| grip.whose != Whose::Truth), "{}", kind.id);
        }
    }
}

#[test]
fn a_hand_finds_the_body_of_a_scene_that_was_just_opened() {
    let open = |scene: &str| Studio::new(Scene::built_in(scene).unwrap());
    // One coordinate, and two.
    let pictures = ["duffing", "quarter-car"].map(|scene| picture(&open(scene)));
    for (now, scene) in ["duffing", "quarter-car"].into_iter().enumerate() {
        let [cell, before] = [now, 1 - now].map(|of| &pictures[of].cells[0]);
        let studio = open(scene);
        for grip in cell.grips(&studio).filter(|grip| grip.whose != Whose::Truth) {
            assert_eq!(cell.moving_grip_at(&studio, &[before], grip.at), Some(grip), "{scene}");
        }
    }
}

#[test]
fn a_held_body_is_drawn_under_the_pointer() {
    for kind in BODIES.iter() {
        let mut studio = studio(kind.id);
        // The same while zoomed and panned.
        let zoom_pan = studio.view().zoom_pan(0).zoomed(1.25, [0.1, 0.05]).panned([0.03, -0.02]);
        studio.apply(ViewCommand::ZoomPan { body: 0, zoom_pan });
        let before = picture(&studio);
        let cell = &before.cells[0];
        let grip = cell.grips(&studio).find(|grip| grip.whose != Whose::Truth).unwrap();
        let mut grasp = Grasp::new(&studio, cell, &grip, off(&grip, [3.0, -2.0])).unwrap();
        assert!(cell.metres(grip.at).distance(grasp.held().handle) < 1e-3, "{}", kind.id);
        grasp.pull(&studio, off(&grip, [43.0, -33.0]), [0.0; 2]);
        let held = grasp.held().clone();
        assert!(held.v.iter().all(|v| *v == 0.0) || kind.id == "chain", "{}", kind.id);
        let (q, v) = (held.q.clone(), held.v.clone());
        studio.apply(RunCommand::Act(crate::scene::Action::Place { body: 0, q, v }));
        // A camera that follows the truth moves with it.
        let body = &studio.race().entrants()[0].lane.bodies()[0];
        assert_eq!(body.stepper.q(), &held.q[..]);
        let handles = Look::of(body).handles(body.stepper.q());
        assert_eq!(handles[grip.handle].at, held.handle);
        // As near to the hand as the body can be.
        let reached = cell.camera.points(held.handle);
        let wanted = match kind.id {
            "ship" | "spring" | "follow" => off(&grip, [40.0, 0.0]),
            "chain" | "ball" => off(&grip, [0.0, -31.0]),
            "pendulum" | "tumble" => reached,
            _ => off(&grip, [40.0, -31.0]),
        };
        for axis in 0..2 {
            assert!((reached[axis] - wanted[axis]).abs() < 0.05, "{}: {reached:?}", kind.id);
        }
    }
}

#[test]
fn a_body_is_thrown_in_simulated_metres_per_second_with_y_up() {
    for (kind, velocity) in
        [("spring", [120.0, 50.0]), ("orbit", [30.0, -60.0]), ("helm", [9.0, 4.0])]
    {
        let studio = studio(kind);
        let picture = picture(&studio);
        let cell = &picture.cells[0];
        let grip = cell.grips(&studio).next().unwrap();
        let mut grasp = Grasp::new(&studio, cell, &grip, grip.at).unwrap();
        grasp.pull(&studio, grip.at, velocity);
        let scale = cell.camera.points_per_metre;
        let v = &grasp.held().v;
        assert!((v[0] - velocity[0] / scale).abs() < 1e-12, "{kind}");
        assert!(v.len() == 1 || (v[1] + velocity[1] / scale).abs() < 1e-12, "{kind}");
        assert!(v.len() < 3 || v[2] == 0.0, "{kind} turns");
    }
}

#[test]
fn a_bob_dragged_round_counts_its_turns_and_flies_along_its_circle() {
    let studio = studio("pendulum");
    let picture = picture(&studio);
    let cell = &picture.cells[0];
    let pivot = cell.camera.points(DVec2::ZERO);
    let grip = cell.grips(&studio).next().unwrap();
    let length = cell.metres(grip.at).length() * cell.camera.points_per_metre;
    let at = |angle: f64| {
        let (x, y) = (length * libm::sin(angle), length * libm::cos(angle));
        [pivot[0] + x as f32, pivot[1] + y as f32]
    };
    let mut grasp = Grasp::new(&studio, cell, &grip, grip.at).unwrap();
    let start = grasp.held().q[0];
    for step in 0..=100 {
        let angle = start + f64::from(step) * 0.15;
        // Anywhere on the ray from the pivot.
        grasp.pull(&studio, at(angle), [0.0; 2]);
        assert!((grasp.held().q[0] - angle).abs() < 1e-4, "{} at {angle}", grasp.held().q[0]);
    }
    grasp.pull(&studio, pivot, [0.0; 2]);
    assert!((grasp.held().q[0] - start - 15.0).abs() < 1e-4, "at the pivot it stays");
    // Below the pivot, along the circle is to the right.
    grasp.pull(&studio, at(0.0), [length, length]);
    assert!((grasp.held().v[0] - 1.0).abs() < 1e-3, "{}", grasp.held().v[0]);
}

#[test]
fn dragging_a_bead_moves_no_other_bead_of_the_chain() {
    let studio = studio("chain");
    let picture = picture(&studio);
    let cell = &picture.cells[0];
    let grip = cell.grips(&studio).nth(2).unwrap();
    let stepper = &studio.race().entrants()[0].lane.bodies()[0].stepper;
    let mut grasp = Grasp::new(&studio, cell, &grip, grip.at).unwrap();
    grasp.pull(&studio, off(&grip, [5.0, -20.0]), [0.0, -7.0]);
    let held = grasp.held();
    for bead in 0..stepper.q().len() {
        let moved = held.q[bead] != stepper.q()[bead] && held.v[bead] != stepper.v()[bead];
        let kept = held.q[bead] == stepper.q()[bead] && held.v[bead] == stepper.v()[bead];
        assert!(if bead == 2 { moved } else { kept }, "bead {bead}");
    }
}

#[test]
fn a_ghost_is_grabbed_where_its_lane_is_out_of_reach() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(ViewCommand::TogglePause);
    let own_and_ghost = |studio: &Studio| {
        [false, true].map(|is_ghost| {
            let of = |grip: &Grip| (grip.whose == Whose::Truth) == is_ghost;
            picture(studio).cells[0].grips(studio).find(of).unwrap()
        })
    };
    let apart = |[own, ghost]: [Grip; 2]| (own.at[0] - ghost.at[0]).abs() > own.radius + 1.0;
    while !apart(own_and_ghost(&studio)) {
        assert!(studio.race().tick() < 600);
        studio.tick();
    }
    let picture = picture(&studio);
    let (cell, [_, ghost]) = (&picture.cells[0], own_and_ghost(&studio));
    assert_eq!(cell.grip_at(&studio, ghost.at), Some(ghost));
    let grasp = Grasp::new(&studio, cell, &ghost, ghost.at).unwrap();
    assert!((grasp.held().q[0] - cell.metres(ghost.at).x).abs() < 1e-6);
    assert_eq!(cell.grip_at(&studio, [cell.rect.min[0] + 2.0, cell.rect.max[1] - 2.0]), None);
}

#[test]
fn stage_points_convert_to_metres_and_back() {
    let mut studio = studio("harbour");
    for body in 0..studio.scene().bodies.len() {
        let zoom_pan = studio.view().zoom_pan(body).zoomed(3.0, [0.3, -0.2]);
        studio.apply(ViewCommand::ZoomPan { body, zoom_pan });
    }
    for cell in picture(&studio).cells {
        for at in [[10.0, 20.0], [300.5, 77.25], [799.0, 499.0]] {
            let back = cell.camera.points(cell.metres(at));
            assert!((0..2).all(|axis| (back[axis] - at[axis]).abs() < 1e-2), "{at:?}: {back:?}");
        }
    }
}

#[test]
fn no_trail_leads_to_a_placement() {
    for kind in ["spring", "orbit", "pendulum"] {
        let mut studio = studio(kind);
        (0..20).for_each(|_| studio.tick());
        let before = picture(&studio);
        let cell = &before.cells[0];
        let grip = cell.grips(&studio).next().unwrap();
        let mut grasp = Grasp::new(&studio, cell, &grip, grip.at).unwrap();
        let to = off(&grip, [90.0, 60.0]);
        grasp.pull(&studio, to, [0.0; 2]);
        let (q, v) = (grasp.held().q.clone(), grasp.held().v.clone());
        studio.apply(RunCommand::Act(crate::scene::Action::Place { body: 0, q, v }));
        for _ in 0..3 {
            studio.tick();
            // The width identifies a trail.
            let picture = picture(&studio);
            let trails = picture.paths().filter(|path| path.points[0].radius == 1.2);
            for trail in trails {
                for ends in trail.points.windows(2) {
                    let [a, b] = [ends[0].at, ends[1].at];
                    let length = (a[0] - b[0]).hypot(a[1] - b[1]);
                    assert!(length < 30.0, "{kind}: {a:?} to {b:?}");
                }
            }
        }
    }
}
