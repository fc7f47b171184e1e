//! The moment to draw, which may lie between two ticks.
//!
//! Bodies, ghosts, trails and numbers all belong to one moment. A ghost at the last tick beside a body between two
//! ticks would show an error that the method does not have.

use crate::look::palette::{Palette, Rgba};
use crate::run::MenuIndex;
use crate::run::race::LaneBody;
use crate::studio::{Studio, shown_s};

/// Duration of a chart recorder's paper, relative to the scene: three swings of the harbour's 1 Hz spring. The swings
/// of a faster one would merge on longer paper.
const PAPER: f64 = 0.15;
/// Most seconds on the paper.
const MAX_PAPER_S: f64 = 3.0;

/// The moment to draw, with the studio and its palette.
pub(super) struct DrawContext<'a> {
    pub(super) studio: &'a Studio,
    pub(super) palette: &'static Palette,
    /// Time of the moment (s).
    pub(super) t: f64,
    /// Duration of a chart recorder's trail (s).
    pub(super) paper_s: f64,
    /// Menu indices of the lanes with a band of their own.
    pub(super) bands: Vec<MenuIndex>,
}

impl<'a> DrawContext<'a> {
    pub(super) fn of(studio: &'a Studio) -> Self {
        Self {
            studio,
            palette: studio.display().theme.palette(),
            t: shown_s(studio),
            bands: studio.bands(),
            paper_s: match studio.scene().checks.is_empty() {
                true => (PAPER * studio.scene().seconds).min(MAX_PAPER_S),
                // The length of a recording is arbitrary.
                false => MAX_PAPER_S,
            },
        }
    }

    /// Colour and dash pattern of the lane with this menu index.
    pub(super) fn style(&self, entry: MenuIndex) -> (Rgba, [f32; 2]) {
        let lanes = self.studio.entries();
        self.studio.display().theme.lane_style(lanes, &lanes[entry])
    }
}

/// Whether a body moves in more than one coordinate, and so may leave a line.
pub(super) fn has_several_coordinates(body: &LaneBody) -> bool {
    body.coordinates().len() > 1
}

#[cfg(test)]
mod tests {
    use crate::run::race::Interpolation;
    use crate::scene::Scene;
    use crate::sim::number::significant;
    use crate::studio::{
        RunCommand, StageCommand, Step, Studio, ViewCommand, shown_s, shown_state,
    };
    use crate::{Whose, compose};

    /// A spring and a ship under RK4, at a rate with visible ticks.
    fn studio() -> Studio {
        let scene = Scene { tick_hz: 5.into(), ..Scene::built_in("harbour").unwrap() };
        let mut studio = Studio::new(scene);
        let rk4 = studio.entries().iter().position(|spec| spec.method.id == "rk4");
        studio.apply(StageCommand::Pick(rk4.unwrap()));
        studio
    }

    /// The drawn places (m) of the spring's mass and its ghost, then of the ship and its ghost, and the ship's speed
    /// on the stage.
    fn drawn_places(studio: &Studio) -> ([[f64; 2]; 2], String) {
        let picture = compose(studio, [780.0, 500.0]);
        let places = [0, 1].map(|body| {
            let cell = &picture.cells[body];
            [false, true].map(|truth| {
                let grip = cell.grips(studio).find(|grip| (grip.whose == Whose::Truth) == truth);
                cell.camera.metres(grip.expect("it is on the stage").at).x
            })
        });
        let mut texts = picture.labels.into_iter().map(|label| label.text);
        let is_speed = |text: &String| text.ends_with(" m/s") && !text.contains("to");
        (places, texts.find(is_speed).expect("its speed"))
    }

    fn is_near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-4
    }

    #[test]
    fn a_paused_stage_shows_the_titles_tick_under_every_interpolation() {
        for _ in Interpolation::ALL {
            let mut studio = studio();
            studio.apply(ViewCommand::TogglePause);
            studio.apply(StageCommand::Restart);
            studio.apply(StageCommand::Tick(Step::Next));
            studio.apply(StageCommand::Tick(Step::Next));
            for _ in Interpolation::ALL {
                let lanes = [&studio.race().entrants()[0].lane, studio.race().truth()];
                let wanted =
                    [0, 1].map(|body| lanes.map(|lane| lane.bodies()[body].stepper.q()[0]));
                let speed = lanes[0].bodies()[1].stepper.v()[0];
                let (places, said) = drawn_places(&studio);
                let way = studio.display().interpolation;
                for body in 0..2 {
                    let are_near = (0..2).all(|of| is_near(places[body][of], wanted[body][of]));
                    assert!(are_near, "{way:?}: {places:?}, not {wanted:?}");
                }
                assert_eq!(said, format!("{} m/s", significant(speed, 3)));
                assert_eq!(shown_s(&studio), studio.race().t());
                studio.apply(RunCommand::NextInterpolation);
            }
        }
    }

    #[test]
    fn while_time_runs_bodies_ghost_and_numbers_share_the_moment_drawn() {
        let mut studio = studio();
        for part in [0.35, 0.7, 1.0, 1.3, 1.75] {
            studio.apply(StageCommand::Restart);
            studio.advance((part * 0.2e9) as i64);
            studio.advance(100_000_000);
            for way in Interpolation::ALL {
                let ([[block, ghost], [ship, true_ship]], said) = drawn_places(&studio);
                let t = shown_s(&studio);
                let exact = libm::cos(std::f64::consts::TAU * t);
                assert!(is_near(ghost, exact), "{way:?}: {ghost} at {t} s");
                let exact = 20.0 * (t + 10.0 * libm::expm1(-t / 10.0));
                assert!(is_near(true_ship, exact), "{way:?}: {true_ship} at {t} s");
                let bodies = studio.race().entrants()[0].lane.bodies();
                let [spring, state] = [0, 1].map(|body| shown_state(&studio, &bodies[body]));
                assert!(is_near(block, spring.0[0]) && is_near(ship, state.0[0]), "{way:?}");
                assert_eq!(said, format!("{} m/s", significant(state.1[0], 3)), "{way:?}");
                studio.apply(RunCommand::NextInterpolation);
            }
        }
    }

    #[test]
    fn the_displayed_speed_lies_between_the_speeds_at_the_two_ticks() {
        let mut studio = Studio::new(Scene::built_in("surge").unwrap());
        for _ in 0..70 {
            studio.advance(137_000_000);
            for _ in Interpolation::ALL {
                let body = &studio.race().entrants()[0].lane.bodies()[0];
                let (_, v) = shown_state(&studio, body);
                let ends = [body.previous_v[0], body.stepper.v()[0]];
                let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                let way = studio.display().interpolation;
                assert!((low - 1e-9..=high + 1e-9).contains(&v[0]), "{way:?}: {v:?} of {ends:?}");
                studio.apply(RunCommand::NextInterpolation);
            }
        }
    }

    #[test]
    fn resuming_continues_the_stage_without_a_jump() {
        for ways in 0..Interpolation::ALL.len() {
            let mut studio = studio();
            (0..ways).for_each(|_| _ = studio.apply(RunCommand::NextInterpolation));
            studio.advance(730_000_000);
            studio.apply(ViewCommand::TogglePause);
            let ([rest, _], _) = drawn_places(&studio);
            studio.apply(ViewCommand::TogglePause);
            let ([on, _], _) = drawn_places(&studio);
            let way = studio.display().interpolation;
            assert!(is_near(rest[0], on[0]) && is_near(rest[1], on[1]), "{way:?}: {rest:?} {on:?}");
        }
    }
}
