//! How each kind of body looks: its outline, and what part of its world the stage shows. One file a kind, one
//! line each in the table below.

use std::any::Any;

use glam::DVec2;

use super::outline::{Mark, Outline};
use crate::sim::bodies::{
    Body, Chain, Custom, Follow, Helm, Kind, Law, Net, Orbit, Origin, Pendulum, Ship, Spring,
};
use crate::sim::{State, Stepper, Vector};

mod beads;
mod chain;
mod custom;
mod follow;
mod helm;
mod law;
mod net;
mod orbit;
mod pendulum;
mod ship;
mod spring;

pub(in crate::lab) use custom::Drawing;

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
    /// The handle's place among the body's [handles](Look::handles).
    pub handle: usize,
    /// Where it is to be, in metres.
    pub to: DVec2,
    /// How fast it is to move, in metres per second.
    pub velocity: DVec2,
}

/// How bodies of one type look.
trait Drawn: Body {
    /// Draws a body with these coordinates, in metres, x right and y up; [`Outline::at`] is where it is and
    /// [`Outline::t`] when.
    fn draw(&self, q: &Self::Vector, outline: &mut Outline);

    /// What part of its world the stage shows.
    fn framing(&self) -> Framing;

    /// The closed course that a body in this state goes along, if it does.
    fn course(&self, _state: &State<Self::Vector>) -> Vec<DVec2> {
        Vec::new()
    }

    /// Where a hand can take hold of a body with these coordinates.
    fn handles(&self, q: &Self::Vector) -> Vec<Handle>;

    /// Brings a handle as near to where it is pulled as the body lets it, moving as it is pulled as far as the body
    /// lets it. What the handle does not move keeps its state.
    fn pull(&self, state: &mut State<Self::Vector>, pull: Pull);
}

/// How bodies of one kind look.
#[derive(Debug)]
pub struct Look {
    /// The kind's id.
    kind: &'static str,
    outline: fn(&dyn Any, f64, &[f64]) -> Outline,
    framing: fn(&dyn Any) -> Framing,
    course: fn(&dyn Any, &[f64], &[f64]) -> Vec<DVec2>,
    handles: fn(&dyn Any, &[f64]) -> Vec<Handle>,
    pull: fn(&dyn Any, &mut [f64], &mut [f64], Pull),
}

/// Every kind's look, in the order of [`BODIES`](crate::sim::bodies::BODIES).
static LOOKS: &[Look] = &[
    Look::of_type::<Ship>("ship"),
    Look::of_type::<Spring>("spring"),
    Look::of_type::<Chain>("chain"),
    Look::of_type::<Pendulum>("pendulum"),
    Look::of_type::<Orbit>("orbit"),
    Look::of_type::<Helm>("helm"),
    Look::of_type::<Follow>("follow"),
];

/// The looks of laws and of nets, whose kinds are not in that table.
static LAW_LOOK: Look = Look::of_type::<Law>("law");
static NET_LOOK: Look = Look::of_type::<Net>("net");

/// The look of custom bodies, whose kinds are not in it either.
static CUSTOM_LOOK: Look = Look::of_type::<Custom>("own");

/// The unit of what is drawn in its own scale, for people: of the plane, or of the first coordinate. Empty for a pure
/// number.
pub(super) fn drawn_unit(kind: &Kind) -> &'static str {
    let plane = match &kind.origin {
        Origin::Law(law) if !law.has_places() => law.text().plane,
        Origin::Custom(info) => info.plane,
        Origin::Table | Origin::Law(_) | Origin::Net(_) => return "m",
    };
    kind.all_coordinates[plane.map_or(0, |[x, _]| x)].shown_unit()
}

impl Look {
    const fn of_type<B: Drawn>(kind: &'static str) -> Self {
        let outline = |body: &dyn Any, t: f64, q: &[f64]| {
            let body = typed::<B>(body);
            let shown = vector::<B>(body, q);
            let mut outline = Outline { t, at: body.place(&shown), ..Outline::default() };
            body.draw(&shown, &mut outline);
            outline
        };
        let handles = |body: &dyn Any, q: &[f64]| {
            let body = typed::<B>(body);
            body.handles(&vector::<B>(body, q))
        };
        let pull = |body: &dyn Any, q: &mut [f64], v: &mut [f64], pull: Pull| {
            let body = typed::<B>(body);
            let mut state = State { q: vector::<B>(body, q), v: vector::<B>(body, v) };
            body.pull(&mut state, pull);
            q.copy_from_slice(state.q.components());
            v.copy_from_slice(state.v.components());
        };
        let course = |body: &dyn Any, q: &[f64], v: &[f64]| {
            let body = typed::<B>(body);
            body.course(&State { q: vector::<B>(body, q), v: vector::<B>(body, v) })
        };
        let framing = |body: &dyn Any| typed::<B>(body).framing();
        Self { kind, outline, framing, course, handles, pull }
    }

    /// The look of bodies of this kind.
    pub fn of(kind: &Kind) -> &'static Look {
        match kind.origin {
            Origin::Law(_) => return &LAW_LOOK,
            Origin::Custom(_) => return &CUSTOM_LOOK,
            Origin::Net(_) => return &NET_LOOK,
            Origin::Table => {}
        }
        let look = LOOKS.iter().find(|look| look.kind == kind.id);
        look.expect("the tests below find a look for every kind")
    }

    /// The outline of `body`, which is of this kind, at the coordinates `q` at time `t` (s).
    pub fn outline(&self, body: &dyn Stepper, t: f64, q: &[f64]) -> Outline {
        (self.outline)(body.body(), t, q)
    }

    /// What part of the world of `body`, which is of this kind, the stage shows.
    pub fn framing(&self, body: &dyn Stepper) -> Framing {
        (self.framing)(body.body())
    }

    /// The closed course that `body`, which is of this kind, goes along in this state, if it does.
    pub fn course(&self, body: &dyn Stepper, q: &[f64], v: &[f64]) -> Vec<DVec2> {
        (self.course)(body.body(), q, v)
    }

    /// Where a hand can take hold of `body`, which is of this kind, at the coordinates `q`.
    pub fn handles(&self, body: &dyn Stepper, q: &[f64]) -> Vec<Handle> {
        (self.handles)(body.body(), q)
    }

    /// Changes the coordinates and velocities of `body`, which is of this kind, as a hand pulls it.
    pub fn pull(&self, body: &dyn Stepper, q: &mut [f64], v: &mut [f64], pull: Pull) {
        (self.pull)(body.body(), q, v, pull);
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
    use crate::lab::Scene;
    use crate::sim::Solver;
    use crate::sim::bodies::BODIES;

    /// The body of the scene of the kind's name.
    fn body(kind: &Kind) -> Box<dyn Stepper> {
        let scene = Scene::built_in(kind.id).expect("a scene for each kind");
        (kind.build)(&scene.bodies[0].values, Solver::Truth)
    }

    #[test]
    fn every_kind_has_a_look_that_shows_where_the_body_is() {
        assert!(LOOKS.iter().map(|look| look.kind).eq(BODIES.iter().map(|kind| kind.id)));
        for kind in BODIES.iter() {
            let (look, mut body) = (Look::of(kind), body(kind));
            for tick in 0..30 {
                let outline = look.outline(&*body, f64::from(tick) / 60.0, body.q());
                assert!(outline.at == body.place() && !outline.marks.is_empty(), "{}", kind.id);
                body.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
            }
            let (Framing::Follow { width_m: wide, .. }
            | Framing::Recorder { half_width_m: wide }
            | Framing::Fixed { half_m: DVec2 { x: wide, .. }, .. }) = look.framing(&*body);
            assert!(wide > 0.0 && wide.is_finite(), "{}: {wide} m", kind.id);
        }
    }

    #[test]
    fn a_look_follows_an_edit() {
        let pendulum = BODIES.iter().find(|kind| kind.id == "pendulum").unwrap();
        let mut body = body(pendulum);
        let half_m = |body: &dyn Stepper| match Look::of(pendulum).framing(body) {
            Framing::Fixed { half_m, .. } => half_m,
            framing => panic!("{framing:?}"),
        };
        let (before, (place, length)) = (half_m(&*body), pendulum.parameter("length_m").unwrap());
        assert!(length.range.contains(7.0) && body.set_parameter(0.0, place, 7.0));
        assert_ne!(half_m(&*body), before);
        assert_eq!(half_m(&*body), DVec2::splat(1.2 * 7.0));
        let outline = Look::of(pendulum).outline(&*body, 0.0, &[0.0]);
        assert_eq!(outline.at, DVec2::new(0.0, -7.0));
    }
}
