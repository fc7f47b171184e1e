//! How each kind of body looks: its outline, and what part of its world the stage shows. One file a kind, one
//! line each in the table below.

use std::any::Any;

use glam::DVec2;

use crate::run::race::LaneBody;
use crate::scene::{Mark, Outline};
use crate::sim::Vector;
use crate::sim::bodies::{
    Body, Chain, Custom, Follow, Helm, Kind, Law, Net, Orbit, Origin, Pendulum, Ship, Spring,
};

mod beads;
mod chain;
mod custom;
mod density;
mod follow;
mod helm;
mod law;
mod net;
mod orbit;
pub mod palette;
mod pendulum;
mod ship;
mod spring;

pub use density::density_picture;

/// What part of a body's world the stage shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Framing {
    /// Afloat: the camera follows the true body over the water, and a wake lies where the body has
    /// been.
    Follow {
        /// The metres shown across, at least; a sixth of that is about a hull.
        width_m: f64,
        /// The metres shown from top to bottom, at least.
        height_m: f64,
        /// How far the wake reaches back, in seconds.
        wake_s: f64,
    },
    /// The camera stays on the origin and shows this many metres to each side, more if the true
    /// body swings further. The body moves along x only, and its trail is drawn as a chart recorder
    /// would.
    Recorder {
        /// Metres from the middle to the edge.
        half_width_m: f64,
    },
    /// The camera stays and shows a rectangle, more if the true body moves further. The trail lies
    /// where the body has been.
    Fixed {
        /// The rectangle's middle.
        centre_m: DVec2,
        /// Metres from there to the edges.
        half_m: DVec2,
        /// How far the trail reaches back, in seconds.
        trail_s: f64,
    },
}

/// A part of a body that a hand can take hold of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// Its middle, in metres.
    pub at: DVec2,
    /// How far it reaches from there, in metres.
    pub radius: f64,
}

/// Where a hand has brought a handle, and how it moves there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// The handle's index among the body's [handles](Look::handles).
    pub handle: usize,
    /// Where it is to be, in metres.
    pub to: DVec2,
    /// How fast it is to move, in metres per second.
    pub velocity: DVec2,
}

/// How a body looks with its present parameters.
trait Drawn {
    /// Draws it at these coordinates, in metres, x right and y up; [`Outline::at`] is where it is and
    /// [`Outline::t`] when.
    fn draw(&self, q: &[f64], outline: &mut Outline);

    /// What part of its world the stage shows.
    fn framing(&self) -> Framing;

    /// The closed course along which it goes from this state, if it does.
    fn course(&self, _q: &[f64], _v: &[f64]) -> Vec<DVec2> {
        Vec::new()
    }

    /// What it does in truth from this state on, in a few words, if that is simple.
    fn promise(&self, _q: &[f64], _v: &[f64]) -> Option<String> {
        None
    }

    /// How far to each side of its rest it swings in truth from this state on, at most, in metres, if that is simple.
    fn swing_m(&self, _q: &[f64], _v: &[f64]) -> Option<f64> {
        None
    }

    /// Whether it is one body over a ground, on which it comes down again.
    fn has_ground(&self) -> bool {
        false
    }

    /// Where a hand can take hold of it at these coordinates.
    fn handles(&self, q: &[f64]) -> Vec<Handle>;

    /// Brings a handle as near to where it is pulled as the body lets it, moving as it is pulled as far as the body
    /// lets it. What the handle does not move keeps its state.
    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull);
}

/// How bodies of one kind look.
struct LookCard {
    /// The kind's id.
    kind: &'static str,
    place: fn(&dyn Any, &[f64]) -> DVec2,
    picture: for<'a> fn(&'a LaneBody) -> Box<dyn Drawn + 'a>,
}

/// The look of every kind in the table, in the order of [`BODIES`](crate::sim::bodies::BODIES).
static LOOKS: &[LookCard] = &[
    LookCard::plain::<Ship>("ship"),
    LookCard::plain::<Spring>("spring"),
    LookCard::plain::<Chain>("chain"),
    LookCard::plain::<Pendulum>("pendulum"),
    LookCard::plain::<Orbit>("orbit"),
    LookCard::plain::<Helm>("helm"),
    LookCard::plain::<Follow>("follow"),
];

/// The looks of kinds that are not in that table.
static LAW_LOOK: LookCard = LookCard::of::<Law>("law", law::picture);
static NET_LOOK: LookCard = LookCard::of::<Net>("net", net::picture);
static CUSTOM_LOOK: LookCard = LookCard::of::<Custom>("custom", custom::picture);

/// The unit of what is drawn in its own scale, for people: of the plane, or of the first coordinate. Empty for a pure
/// number.
pub(crate) fn drawn_unit(kind: &Kind) -> &'static str {
    let plane = match &kind.origin {
        Origin::Law(law) if !law.has_places() => law.text().plane,
        Origin::Custom(info) => info.plane,
        Origin::Table | Origin::Law(_) | Origin::Net(_) => return "m",
    };
    kind.all_coordinates.at(plane.map_or(0, |[x, _]| x)).shown_unit()
}

impl LookCard {
    const fn plain<B: Body + Drawn>(kind: &'static str) -> Self {
        Self::of::<B>(kind, |body| Box::new(typed::<B>(body.stepper.body()).clone()))
    }

    const fn of<B: Body>(
        kind: &'static str,
        picture: for<'a> fn(&'a LaneBody) -> Box<dyn Drawn + 'a>,
    ) -> Self {
        let place = |body: &dyn Any, q: &[f64]| {
            let body = typed::<B>(body);
            body.place(&vector(body, q))
        };
        Self { kind, place, picture }
    }

    /// The look of bodies of this kind.
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

/// How a body looks with its present parameters.
pub struct Look<'a> {
    body: &'a LaneBody,
    card: &'static LookCard,
    picture: Box<dyn Drawn + 'a>,
}

impl<'a> Look<'a> {
    /// How `body` looks.
    pub fn of(body: &'a LaneBody) -> Self {
        let card = LookCard::find(&body.kind);
        Self { body, card, picture: (card.picture)(body) }
    }

    /// The outline at the coordinates `q` at time `t` (s).
    pub fn outline(&self, t: f64, q: &[f64]) -> Outline {
        let at = (self.card.place)(self.body.stepper.body(), q);
        let mut outline = Outline { t, at, ..Outline::default() };
        self.picture.draw(q, &mut outline);
        outline
    }

    /// What part of the body's world the stage shows.
    pub fn framing(&self) -> Framing {
        self.picture.framing()
    }

    /// The closed course that the body goes along in this state, if it does.
    pub fn course(&self, q: &[f64], v: &[f64]) -> Vec<DVec2> {
        self.picture.course(q, v)
    }

    /// What the body does in truth from this state on, in a few words, if that is simple.
    pub fn promise(&self, q: &[f64], v: &[f64]) -> Option<String> {
        self.picture.promise(q, v)
    }

    /// How far to each side of its rest the body swings in truth from this state on, at most, in metres, if that is simple.
    pub fn swing_m(&self, q: &[f64], v: &[f64]) -> Option<f64> {
        self.picture.swing_m(q, v)
    }

    /// Whether it is one body over a ground, on which it comes down again.
    pub fn has_ground(&self) -> bool {
        self.picture.has_ground()
    }

    /// Where a hand can take hold of the body at the coordinates `q`.
    pub fn handles(&self, q: &[f64]) -> Vec<Handle> {
        self.picture.handles(q)
    }

    /// Changes coordinates and velocities as a hand pulls the body.
    pub fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        self.picture.pull(q, v, pull);
    }
}

/// Coordinates or velocities as the body has them.
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

    /// The scene of the kind's name under the truth.
    fn lane(kind: &Kind) -> Lane {
        Lane::new(&Scene::built_in(kind.id).expect("a scene for each kind"), Solver::Truth, 1)
    }

    #[test]
    fn every_kind_has_a_look_that_shows_where_the_body_is() {
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
