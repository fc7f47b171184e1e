//! Everything on the stage is finite, within the range of an f32, and at the position of its body.

use regatta::look::palette::Theme;
use regatta::loops::loop_lab::LoopCommand;
use regatta::run::race::{ESCAPE, Mode};
use regatta::scene::{Action, SCENES, Scene};
use regatta::stage::{FAR, Picture, Shape, Whose, compose};
use regatta::studio::{
    Command, RunCommand, StageCommand, Studio, ViewCommand, digit_of, run_loops,
};

use crate::scenes::edited;

fn assert_drawable(picture: &Picture, what: &str) {
    let finite = |values: &[f32]| values.iter().all(|x| x.is_finite() && x.abs() <= 2.0 * FAR);
    for shape in &picture.shapes {
        let clip = match shape {
            Shape::Path(path) => {
                for point in &path.points {
                    assert!(finite(&point.at) && finite(&[point.radius]), "{what}: {point:?}");
                }
                path.clip
            }
            Shape::Fill(fill) => {
                for (at, _) in &fill.corners {
                    assert!(finite(at), "{what}: {fill:?}");
                }
                fill.clip
            }
        };
        assert!(finite(&clip.min) && finite(&clip.max), "{what}: {clip:?}");
    }
    for label in &picture.labels {
        assert!(finite(&label.at) && label.size > 0.0, "{what}: {label:?}");
    }
}

#[test]
fn no_vertex_comes_from_a_value_that_blew_up() {
    for scene in SCENES {
        let mut studio = Studio::new(Scene::built_in(scene.name).unwrap());
        studio.apply(StageCommand::ToggleRace);
        for frame in 0..400 {
            studio.advance(16_666_667);
            // A motion that doubles per frame is seen before it is eight times as large.
            if frame % 3 == 0 {
                studio.apply(RunCommand::NextInterpolation);
                let what = format!("{} at frame {frame}", scene.name);
                assert_drawable(&compose(&studio, [780.0, 500.0]), &what);
            }
        }
    }
}

#[test]
fn bodies_at_the_edge_of_the_valid_range_are_drawn() {
    let text = "title = \"far\"\ntick_hz = 10000\nseconds = 1\n\
         [[ship]]\nthrust_n = 0\ndrag_n_s_per_m = 0\nmass_kg = 1e-3\ns0_m = 1e15\nv0_m_per_s = 1e15\n\
         [[spring]]\nmass_kg = 1e15\nstiffness_n_per_m = 1e-3\nx0_m = -1e15\nv0_m_per_s = -1e15\n\
         [[spring]]\nname = \"small\"\nmass_kg = 1\nstiffness_n_per_m = 1\nx0_m = 1e-12\n\
         [[chain]]\nmasses = 64\nmass_kg = 1e15\nstiffness_n_per_m = 1e-3\nx0_m = -1e15\n\
         [[pendulum]]\nlength_m = 1e15\ngravity_m_per_s2 = 0\nomega0_rad_per_s = 1e15\n\
         [[orbit]]\nname = \"far\"\nmu_m3_per_s2 = 1e-9\nx0_m = 1e15\nvy0_m_per_s = 1e15\n\
         [[orbit]]\nname = \"near\"\nmu_m3_per_s2 = 1e15\nx0_m = 1e-9\nvy0_m_per_s = 0\n\
         [[helm]]\nmass_kg = 1\ninertia_kg_m2 = 1\ndrag_n_s_per_m = 0\nside_drag_n_s_per_m = 0\n\
         yaw_drag_n_m_s = 0\nrudder_n_s = 1\nx0_m = 1e15\ny0_m = -1e15\npsi0_rad = 1e15\n\
         u0_m_per_s = 1e15\nthrust_curve = [[0, 0], [1, 0]]\n";
    let scene = Scene::parse("far.toml", text).unwrap();
    // One after the other, so that one that halts stops no other; then all at once.
    let alone = (0..scene.bodies.len())
        .map(|body| edited(&scene, |alone| alone.bodies = vec![scene.bodies[body].clone()]));
    for scene in alone.chain([scene.clone()]) {
        let what = format!("far {}", scene.bodies.last().expect("a body").name);
        let mut studio = Studio::new(scene);
        studio.apply(StageCommand::ToggleRace);
        for _ in 0..20 {
            studio.advance(16_666_667);
            assert_drawable(&compose(&studio, [780.0, 500.0]), &what);
            studio.apply(RunCommand::Act(Action::Kick(1e12)));
            assert!(studio.race().truth().bodies()[0].stepper.v()[0].abs() < ESCAPE);
        }
    }
}

#[test]
fn a_lone_planar_body_has_a_fitting_cell_for_each_lane() {
    for name in ["chain", "pendulum", "orbit", "helm"] {
        let mut studio = Studio::new(Scene::built_in(name).unwrap());
        studio.apply(StageCommand::ToggleRace);
        studio.apply(StageCommand::ToggleArrangement);
        studio.advance(100_000_000);
        let size = [780.0, 500.0];
        let picture = compose(&studio, size);
        let lanes = studio.race().entrants().iter();
        assert_eq!(picture.cells.len(), lanes.len(), "{name}");
        for (i, cell) in picture.cells.iter().enumerate() {
            let ([left, top], [right, bottom]) = (cell.rect.min, cell.rect.max);
            assert!(left >= 0.0 && top >= 0.0 && right <= size[0] && bottom <= size[1], "{name}");
            let aspect = (right - left) / (bottom - top);
            assert!((0.5..4.0).contains(&aspect) && bottom - top > 120.0, "{name}: {cell:?}");
            let others = &picture.cells[..i];
            assert!(others.iter().all(|other| other.rect.min != cell.rect.min), "{name}");
        }
        let names = lanes.map(|lane| lane.spec.method.name);
        for name in names {
            assert!(picture.labels.iter().any(|label| label.text.ends_with(name)), "{name}");
        }
    }
}

#[test]
fn the_trail_of_an_orbit_lies_on_its_ellipse() {
    let mut studio = Studio::new(Scene::built_in("orbit").unwrap());
    for _ in 0..400 {
        studio.advance(16_666_667);
    }
    let curve = &studio.past().truth_curves()[0];
    for sample in curve.samples() {
        // The distances from the two foci of a = 10 m, e = 0.6 add up to 2 a.
        let sum = sample.at.length() + (sample.at + glam::DVec2::new(12.0, 0.0)).length();
        assert!((sum - 20.0).abs() < 1e-9, "{sample:?}");
    }
    assert!(curve.samples().len() > 800);
}

#[test]
fn a_trail_leads_from_the_body_back_in_time_and_fades() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    for _ in 0..100 {
        studio.advance(16_666_667);
    }
    let picture = compose(&studio, [780.0, 500.0]);
    // The trail of the lane in front is 2.4 points wide.
    let mut trails =
        picture.paths().filter(|path| path.points[0].radius == 1.2 && path.points.len() > 2);
    let trail = &trails.next().expect("a spring leaves a trail").points;
    assert!(trail.len() > 50, "{}", trail.len());
    // A chart recorder's paper runs down.
    assert!(trail.is_sorted_by(|new, old| new.at[1] <= old.at[1]));
    assert!(trail.is_sorted_by(|new, old| new.colour[3] >= old.colour[3]));
    assert!(trail[0].colour[3] > 240 && trail[trail.len() - 1].colour[3] < 220);
}

#[test]
fn a_stage_of_zero_size_is_composed() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    for mode in [Mode::Solo, Mode::Race] {
        assert_eq!(studio.mode(), mode);
        for size in [[0.0, 0.0], [1.0, 1.0], [2000.0, 0.0], [0.0, 2000.0], [30.0, 20.0]] {
            assert_drawable(&compose(&studio, size), &format!("{size:?}"));
        }
        studio.apply(StageCommand::ToggleRace);
    }
}

#[test]
fn cells_lie_inside_the_stage_for_every_body_in_both_arrangements() {
    let size = [780.0, 500.0];
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    let assert_apart = |studio: &Studio, count: usize| {
        let picture = compose(studio, size);
        assert_eq!(picture.cells.len(), count);
        for (i, cell) in picture.cells.iter().enumerate() {
            let ([left, top], [right, bottom]) = (cell.rect.min, cell.rect.max);
            assert!(left >= 0.0 && top >= 0.0 && right <= size[0] && bottom <= size[1], "{cell:?}");
            assert!(right - left > 100.0 && bottom - top > 50.0, "{cell:?}");
            for other in &picture.cells[..i] {
                let apart = left >= other.rect.max[0]
                    || top >= other.rect.max[1]
                    || right <= other.rect.min[0]
                    || bottom <= other.rect.min[1];
                assert!(apart, "{cell:?} covers {other:?}");
            }
        }
    };
    studio.advance(100_000_000);
    assert_apart(&studio, 2);
    studio.apply(StageCommand::ToggleRace);
    studio.advance(100_000_000);
    assert_apart(&studio, 2);
    studio.apply(StageCommand::ToggleArrangement);
    assert_apart(&studio, 2 * studio.race().entrants().len());
}

#[test]
fn overlaid_lanes_are_numbered_and_the_selected_one_has_the_body() {
    let mut studio = Studio::new(Scene::built_in("orbit").unwrap());
    studio.apply(StageCommand::ToggleRace);
    (0..60).for_each(|_| studio.tick());
    for entry in 0..studio.race().entrants().len() {
        studio.apply(StageCommand::Pick(entry));
        let picture = compose(&studio, [780.0, 500.0]);
        assert_eq!((picture.cells.len(), picture.cells[0].entry), (1, entry));
        for lane in studio.race().entrants() {
            let (lane, number) = (lane.id, (studio.entry(lane) + 1).to_string());
            let is_told = picture.labels.iter().any(|label| label.text == number);
            assert!(is_told || lane == picture.cells[0].lane, "{number} with {entry} in front");
            let is_own = |whose| matches!(whose, Whose::Lane { lane: of, .. } if of == lane);
            assert!(picture.cells[0].grips(&studio).any(|grip| is_own(grip.whose)), "{number}");
        }
    }
}

#[test]
fn bodies_and_words_stay_in_their_cells_however_low() {
    let mut scene = Scene::built_in("harbour").unwrap();
    scene.lanes = Studio::new(scene.clone()).entries().to_vec();
    let mut studio = Studio::new(scene);
    studio.apply(StageCommand::ToggleRace);
    studio.apply(StageCommand::ToggleArrangement);
    (0..240).for_each(|_| studio.tick());
    let picture = compose(&studio, [780.0, 376.0]);
    let (lanes, height) = (studio.race().entrants().len(), 376.0_f32);
    assert!(lanes > 25 && picture.cells.len() == 2 * lanes);
    let is_truth = |whose| matches!(whose, Whose::Truth);
    for cell in &picture.cells {
        let truth = cell.grips(&studio).find(|grip| is_truth(grip.whose)).expect("a ghost");
        assert!(cell.rect.contains(truth.at), "{:?} in {:?}", truth.at, cell.rect);
    }
    for label in &picture.labels {
        let is_low = 1.3 * label.size < height / lanes as f32;
        assert!(is_low || label.at[1] > 366.0, "{} at {} points", label.text, label.size);
    }
}

/// The texts of badges for bodies beyond the stage.
fn badges(picture: &Picture) -> Vec<&str> {
    let texts = picture.labels.iter().map(|label| &*label.text);
    let is_told = |text: &&str| text.starts_with("swings ±") || text.starts_with("out to ");
    texts.filter(is_told).collect()
}

#[test]
fn a_body_swinging_past_the_stage_is_drawn_inside_and_labelled_outside() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    let euler = studio.entries().iter().position(|spec| spec.method.id == "explicit-euler");
    studio.apply(StageCommand::Pick(euler.unwrap()));
    (0..540).for_each(|_| studio.tick());
    let (mut drawn, mut furthest) = (0, 0.0_f64);
    for frame in 0..60 {
        studio.advance(16_666_667);
        let picture = compose(&studio, [780.0, 500.0]);
        let cell = &picture.cells[0];
        let is_lane = |whose| matches!(whose, Whose::Lane { .. });
        let grip = cell.grips(&studio).find(|grip| is_lane(grip.whose)).expect("it can be grabbed");
        let is_inside = grip.at[0] > 70.0 && cell.rect.contains(grip.at);
        // A block has a face in its own colour, and so has a badge: but only a block has a pen.
        let colour = Theme::Dark.style(studio.entries()[euler.unwrap()].method).0;
        let is_pen = |shape: &&Shape| matches!(shape, Shape::Fill(fill) if fill.corners.len() == 3 && fill.corners[0].1 == colour);
        let pens = picture.shapes.iter().filter(is_pen).count();
        assert!(pens == usize::from(is_inside), "{pens} at frame {frame}, {:?}", grip.at);
        drawn += pens;
        let place = studio.race().entrants()[0].lane.bodies()[0].stepper.q()[0];
        furthest = furthest.max(place.abs());
        let told = badges(&picture);
        assert_eq!(told.len(), 1, "{told:?} at frame {frame}");
        let swing: f64 = told[0][9..].trim_end_matches(" m").parse().expect("a number");
        assert!(swing >= 0.85 * furthest && swing < 40.0, "{told:?}, furthest {furthest}");
    }
    assert!(drawn > 3, "it passes");
}

#[test]
fn a_lane_beyond_the_stage_has_a_badge_and_leaves_no_strokes() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.apply(StageCommand::ToggleRace);
    (0..600).for_each(|_| studio.tick());
    let picture = compose(&studio, [780.0, 500.0]);
    let x = studio.race().entrants()[0].lane.bodies()[0].stepper.q()[0];
    let decade = libm::floor(libm::log10(x.abs())) as i32;
    assert!(decade >= 1, "{x}");
    let texts: Vec<&str> = picture.labels.iter().map(|label| &*label.text).collect();
    let is_badge = |text: &&&str| text.starts_with("swings ±") && text.ends_with(" m");
    assert!(texts.iter().any(|text| is_badge(&text)), "{texts:?}");
    let colour = Theme::Dark.style(studio.entries()[0].method).0;
    let trails = picture.paths().filter(|path| path.points[0].colour[..3] == colour[..3]);
    let widest = trails.map(|path| {
        let x = path.points.iter().map(|point| point.at[0]);
        x.clone().fold(f32::MIN, f32::max) - x.fold(f32::MAX, f32::min)
    });
    // The hull of its ship, which is on the stage, and badges.
    assert!(widest.fold(0.0, f32::max) < 260.0);
}

#[test]
fn the_ghost_shows_only_on_request() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.advance(100_000_000);
    let drawn = |studio: &Studio| {
        let picture = compose(studio, [780.0, 500.0]);
        let is_ghost = |grip: &regatta::stage::Grip| grip.whose == Whose::Truth;
        let ghosts =
            picture.cells.iter().flat_map(|cell| cell.grips(studio)).filter(is_ghost).count();
        (picture.shapes.len(), ghosts)
    };
    let with = drawn(&studio);
    studio.apply(ViewCommand::ToggleGhost);
    let without = drawn(&studio);
    assert!(without.0 < with.0, "{without:?} shapes without a ghost, {with:?} with");
    assert_eq!((without.1, with.1), (0, 2));
}

#[test]
fn the_stage_marks_halted_bodies_and_missing_truths() {
    let text = "title = 'x'\ntick_hz = 10\nseconds = 60\nmethods = ['explicit-euler', 'rk4']\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 400\nkick_n_s = 0\n\
                [[ship]]\nthrust_n = 20000\ndrag_n_s_per_m = 1000\nmass_kg = 10000\nkick_n_s = 1e15\n";
    let mut studio = Studio::new(Scene::parse("two.toml", text).unwrap());
    studio.apply(StageCommand::ToggleRace);
    let said = |studio: &Studio| {
        let labels = compose(studio, [780.0, 500.0]).labels.into_iter().map(|label| label.text);
        let is_told = |text: &String| text.contains("blew up") || text.contains("from tick");
        labels.filter(is_told).collect::<Vec<_>>()
    };
    assert_eq!(said(&studio), [""; 0]);
    (0..300).for_each(|_| studio.tick());
    let halt = studio.race().entrants()[0].lane.halted().expect("explicit Euler loses the spring");
    let spring = format!("1 {}", halt.fate());
    assert_eq!(said(&studio), std::slice::from_ref(&spring));

    // A kick that neither lanes nor truth survive: the ghost is gone with the truth.
    let ghosts = |studio: &Studio| {
        let cells = compose(studio, [780.0, 500.0]).cells;
        let grips = cells.iter().flat_map(|cell| cell.grips(studio));
        grips.filter(|grip| grip.whose == Whose::Truth).count()
    };
    assert_eq!(ghosts(&studio), 2);
    let ship = studio.scene().bodies.iter().position(|body| body.kind.id == "ship").unwrap();
    let mass = studio.scene().bodies[ship].kind.parameter("mass_kg").unwrap().0;
    studio.apply(RunCommand::Act(Action::Set { body: ship, parameter: mass, value: 1e-300 }));
    studio.apply(RunCommand::Act(Action::Kick(1e15)));
    let ship = ["1 blew up at 30 s · 2 blew up at 30 s", "no exact solution from tick 300 on"];
    assert_eq!(said(&studio), [&*spring, ship[0], ship[1]]);
    assert_eq!(ghosts(&studio), 1);
    studio.apply(StageCommand::ToggleRace);
    let alone = said(&studio);
    assert!(alone.contains(&ship[1].to_owned()), "{alone:?}");
}

#[test]
fn overlaid_loops_are_named_below_and_numbered_above_their_bodies() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    run_loops(&mut studio);
    studio.apply(Command::Loop(LoopCommand::Seek(2_264_000_000)));
    let below = compose(&studio, [780.0, 500.0]);
    studio.apply(StageCommand::ToggleArrangement);
    let over = compose(&studio, [780.0, 500.0]);
    let exact = |picture: &Picture| {
        let colour = studio.display().theme.palette().exact;
        let is_exact = |shape: &&Shape| match shape {
            Shape::Path(path) => path.points.iter().all(|point| point.colour == colour),
            _ => false,
        };
        picture.shapes.iter().filter(is_exact).count()
    };
    let loops = studio.loop_lab().unwrap();
    let count = loops.on_stage().len();
    assert_eq!(exact(&below), count * exact(&over), "one exact body");
    for &place in loops.on_stage() {
        let starts = |words: &str| over.labels.iter().any(|label| label.text.starts_with(words));
        let digit = digit_of(place);
        assert!(starts(&format!("{digit} {} · ", loops.lanes()[place].card().name)));
        assert!(over.labels.iter().any(|label| label.text == digit.to_string()));
    }
}
