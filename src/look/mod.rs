//! Looks: the outline of each kind of body, and the part of its world that the stage shows. Each kind has one file,
//! and one line in the table below.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

use regatta_measure as measure;
use regatta_run as run;
use regatta_scene as scene;
use regatta_sim as sim;

use std::any::Any;

use glam::DVec2;

use crate::run::race::LaneBody;
use crate::scene::{Mark, Outline};
use crate::sim::Vector;
use crate::sim::bodies::{
    Ball, Body, Chain, Custom, Follow, Helm, Kind, Law, Net, Orbit, Origin, Pendulum, Ship, Spring,
    Tumble,
};

mod ball;
mod beads;
mod chain;
mod custom;
mod density;
mod follow;
mod helm;
pub mod landmarks;
mod law;
mod net;
mod orbit;
pub mod palette;
mod pendulum;
mod polhode;
mod ship;
mod spring;
mod tumble;

pub use density::density_picture;
pub use polhode::Polhode;

/// The part of a body's world that the stage shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Framing {
    /// Afloat: the camera follows the true body over the water, and a wake marks the body's way.
    Follow {
        /// Minimum visible width in metres; about six hulls.
        width_m: f64,
        /// Minimum visible height in metres.
        height_m: f64,
        /// Length of the wake in seconds.
        wake_s: f64,
    },
    /// The camera stays on the origin and shows this distance to each side, or more if the true body swings further.
    /// The body moves along x only, and its trail runs over the paper as in a chart recorder.
    Recorder {
        /// Metres from the middle to the edge.
        half_width_m: f64,
    },
    /// The camera stays and shows a rectangle, or more if the true body moves further. A trail marks the body's way.
    Fixed {
        /// Centre of the rectangle.
        centre_m: DVec2,
        /// Metres from the centre to the edges.
        half_m: DVec2,
        /// Length of the trail in seconds.
        trail_s: f64,
    },
}

/// A part of a body that a person can grab.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// Centre of the handle, in metres.
    pub at: DVec2,
    /// Radius of the handle, in metres.
    pub radius: f64,
}

/// Target position of a grabbed handle, and the velocity that the handle has there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// Index of the handle among the body's [handles](Look::handles).
    pub handle: usize,
    /// Target position in metres.
    pub to: DVec2,
    /// Target velocity in metres per second.
    pub velocity: DVec2,
}

/// The picture of one kind of body with its current parameters.
trait BodyPicture {
    /// Draws the body at the coordinates `q`, in metres, x right and y up. [`Outline::at`] is the body's position and
    /// [`Outline::t`] the time.
    fn draw(&self, q: &[f64], outline: &mut Outline);

    fn framing(&self) -> Framing;

    /// Returns the closed course that the body follows from this state; empty if the course is not closed.
    fn course(&self, _q: &[f64], _v: &[f64]) -> Vec<DVec2> {
        Vec::new()
    }

    /// Describes the true motion from this state on in a few words, if the motion is simple.
    fn describe_motion(&self, _q: &[f64], _v: &[f64]) -> Option<String> {
        None
    }

    /// Returns the amplitude of the true motion from this state on, in metres, if the motion is simple.
    fn swing_m(&self, _q: &[f64], _v: &[f64]) -> Option<f64> {
        None
    }

    /// Whether the picture shows a single body above a ground, to which the body falls back.
    fn has_ground(&self) -> bool {
        false
    }

    /// Returns the handles of the body at these coordinates.
    fn handles(&self, q: &[f64]) -> Vec<Handle>;

    /// Brings a handle as close to its target position and velocity as the body allows. Coordinates that the handle
    /// does not move keep their state.
    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull);
}

/// Functions that place and draw bodies of one kind.
struct LookCard {
    /// Id of the kind.
    kind: &'static str,
    place: fn(&dyn Any, &[f64]) -> DVec2,
    picture: for<'a> fn(&'a LaneBody) -> Box<dyn BodyPicture + 'a>,
}

/// The looks of all built-in kinds, in the order of [`BODIES`](crate::sim::bodies::BODIES).
static LOOKS: &[LookCard] = &[
    LookCard::plain::<Ship>("ship"),
    LookCard::plain::<Spring>("spring"),
    LookCard::plain::<Chain>("chain"),
    LookCard::plain::<Pendulum>("pendulum"),
    LookCard::plain::<Orbit>("orbit"),
    LookCard::plain::<Helm>("helm"),
    LookCard::plain::<Follow>("follow"),
    LookCard::plain::<Ball>("ball"),
    LookCard::of::<Tumble>("tumble", tumble::picture),
];

/// The looks of kinds outside the table of built-in kinds.
static LAW_LOOK: LookCard = LookCard::of::<Law>("law", law::picture);
static NET_LOOK: LookCard = LookCard::of::<Net>("net", net::picture);
static CUSTOM_LOOK: LookCard = LookCard::of::<Custom>("custom", custom::picture);

/// Returns the unit of a body's picture, as text for people. It is the unit of the body's plane or, without a plane, of
/// its first coordinate. A pure number has an empty unit.
pub fn drawn_unit(kind: &Kind) -> &'static str {
    let plane = match &kind.origin {
        Origin::Law(law) if !law.has_places() => law.text().plane,
        Origin::Custom(info) => info.plane,
        Origin::Table | Origin::Law(_) | Origin::Net(_) => return "m",
    };
    kind.all_coordinates.at(plane.map_or(0, |[x, _]| x)).shown_unit()
}

impl LookCard {
    const fn plain<B: Body + BodyPicture>(kind: &'static str) -> Self {
        Self::of::<B>(kind, |body| Box::new(typed::<B>(body.stepper.body()).clone()))
    }

    const fn of<B: Body>(
        kind: &'static str,
        picture: for<'a> fn(&'a LaneBody) -> Box<dyn BodyPicture + 'a>,
    ) -> Self {
        let place = |body: &dyn Any, q: &[f64]| {
            let body = typed::<B>(body);
            body.place(&vector(body, q))
        };
        Self { kind, place, picture }
    }

    fn find(kind: &Kind) -> &'static Self {
        match kind.origin {
            Origin::Law(_) => return &LAW_LOOK,
            Origin::Custom(_) => return &CUSTOM_LOOK,
            Origin::Net(_) => return &NET_LOOK,
            Origin::Table => {}
        }
        let look = LOOKS.iter().find(|look| look.kind == kind.id);
        look.expect("the tests below find a look for every kind")
    }
}

/// The look of a body with its current parameters.
pub struct Look<'a> {
    body: &'a LaneBody,
    card: &'static LookCard,
    picture: Box<dyn BodyPicture + 'a>,
}

impl<'a> Look<'a> {
    /// Returns the look of `body`.
    pub fn of(body: &'a LaneBody) -> Self {
        let card = LookCard::find(&body.kind);
        Self { body, card, picture: (card.picture)(body) }
    }

    /// Returns the outline at the coordinates `q` at time `t` (s).
    pub fn outline(&self, t: f64, q: &[f64]) -> Outline {
        let at = (self.card.place)(self.body.stepper.body(), q);
        let mut outline = Outline { t, at, ..Outline::default() };
        self.picture.draw(q, &mut outline);
        outline
    }

    /// Returns the part of the body's world that the stage shows.
    pub fn framing(&self) -> Framing {
        self.picture.framing()
    }

    /// Returns the closed course that the body follows from this state; empty if the course is not closed.
    pub fn course(&self, q: &[f64], v: &[f64]) -> Vec<DVec2> {
        self.picture.course(q, v)
    }

    /// Describes the true motion from this state on in a few words, if the motion is simple.
    pub fn describe_motion(&self, q: &[f64], v: &[f64]) -> Option<String> {
        self.picture.describe_motion(q, v)
    }

    /// Returns the amplitude of the true motion from this state on, in metres, if the motion is simple.
    pub fn swing_m(&self, q: &[f64], v: &[f64]) -> Option<f64> {
        self.picture.swing_m(q, v)
    }

    /// Whether the picture shows a single body above a ground, to which the body falls back.
    pub fn has_ground(&self) -> bool {
        self.picture.has_ground()
    }

    /// Returns the handles of the body at the coordinates `q`.
    pub fn handles(&self, q: &[f64]) -> Vec<Handle> {
        self.picture.handles(q)
    }

    /// Moves coordinates and velocities so that the handle follows the pull.
    pub fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        self.picture.pull(q, v, pull);
    }
}

/// Copies coordinates or velocities into the body's vector type.
fn vector<B: Body>(body: &B, components: &[f64]) -> B::Vector {
    let mut vector = body.start().q;
    vector.components_mut().copy_from_slice(components);
    vector
}

fn typed<B: Body>(body: &dyn Any) -> &B {
    body.downcast_ref().expect("the tests below look at a body of every kind")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Lane;
    use crate::scene::{Action, Scene};
    use crate::sim::Solver;
    use crate::sim::bodies::{BODIES, kind};

    /// Returns a lane of the kind's built-in scene, stepped by the truth.
    fn lane(kind: &Kind) -> Lane {
        Lane::new(&Scene::with_kind(kind.id), Solver::Truth, 1)
    }

    #[test]
    fn every_kind_has_a_look_that_shows_the_bodys_position() {
        assert!(LOOKS.iter().map(|look| look.kind).eq(BODIES.iter().map(|kind| kind.id)));
        for kind in BODIES.iter() {
            let mut lane = lane(kind);
            for tick in 0..30 {
                let body = &lane.bodies()[0];
                let outline = Look::of(body).outline(tick as f64 / 60.0, body.stepper.q());
                let is_there = outline.at == body.stepper.place();
                assert!(is_there && !outline.marks.is_empty(), "{}", kind.id);
                lane.tick(tick, tick as f64 / 60.0, 1.0 / 60.0);
            }
            let (Framing::Follow { width_m: wide, .. }
            | Framing::Recorder { half_width_m: wide }
            | Framing::Fixed { half_m: DVec2 { x: wide, .. }, .. }) =
                Look::of(&lane.bodies()[0]).framing();
            assert!(wide > 0.0 && wide.is_finite(), "{}: {wide} m", kind.id);
        }
    }

    #[test]
    fn a_look_follows_an_edit() {
        let pendulum = kind("pendulum").unwrap();
        let mut lane = lane(pendulum);
        let half_m = |lane: &Lane| match Look::of(&lane.bodies()[0]).framing() {
            Framing::Fixed { half_m, .. } => half_m,
            framing => panic!("{framing:?}"),
        };
        let (before, (parameter, length)) =
            (half_m(&lane), pendulum.parameter("length_m").unwrap());
        assert!(length.range.contains(7.0));
        lane.act(0, 0.0, &Action::Set { body: 0, parameter, value: 7.0 });
        assert_ne!(half_m(&lane), before);
        assert_eq!(half_m(&lane), DVec2::splat(1.2 * 7.0));
        let outline = Look::of(&lane.bodies()[0]).outline(0.0, &[0.0]);
        assert_eq!(outline.at, DVec2::new(0.0, -7.0));
    }
}
