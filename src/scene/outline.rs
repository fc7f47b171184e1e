//! The outline of a body: its parts in metres, without colour, which the lane brings.

use glam::DVec2;

/// One part of a body, in metres, x right and y up.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Mark {
    /// What the body hangs on, a line that does not move.
    Wall {
        /// One end.
        from: DVec2,
        /// The other end.
        to: DVec2,
    },
    /// A disc that does not move: a pivot, a planet.
    Anchor {
        /// Its centre.
        centre: DVec2,
        /// Its radius.
        radius: f64,
    },
    /// A planet, which does not move.
    Planet {
        /// Its centre.
        centre: DVec2,
        /// Its radius.
        radius: f64,
    },
    /// A coil spring.
    Coil {
        /// One end.
        from: DVec2,
        /// The other end.
        to: DVec2,
        /// The radius of its turns.
        radius: f64,
    },
    /// A block.
    Block {
        /// Its centre.
        centre: DVec2,
        /// Half its width and half its height.
        half: DVec2,
    },
    /// A rod or a thread.
    Rod {
        /// One end.
        from: DVec2,
        /// The other end.
        to: DVec2,
    },
    /// A thin line that does not move, along which a bead goes.
    Rail {
        /// One end.
        from: DVec2,
        /// The other end.
        to: DVec2,
    },
    /// A bead, a bob, a satellite.
    Disc {
        /// Its centre.
        centre: DVec2,
        /// Its radius.
        radius: f64,
    },
    /// A block at [`Outline::at`] on a coil spring that is moored at the left. How large they are is the picture's
    /// business.
    Sprung,
    /// The hull of a ship at [`Outline::at`].
    Hull {
        /// The direction of its bow, of length 1.
        bow: DVec2,
        /// Its length.
        length: f64,
    },
}

/// A thread through nodes of a net.
#[derive(Clone, Debug, PartialEq)]
pub struct Thread {
    /// The nodes, in metres.
    pub points: Vec<DVec2>,
    /// Whether it is a part of the border, which is all that is drawn of a net behind.
    pub is_border: bool,
}

/// The parts that show a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// What is drawn, the first at the bottom.
    pub marks: Vec<Mark>,
    /// The names of rails, and where each is written: left of this point.
    pub names: Vec<(DVec2, String)>,
    /// The threads of a net, below the marks.
    pub threads: Vec<Thread>,
    /// Where the exact body will go if nothing intervenes: a closed course.
    pub course: Vec<DVec2>,
    /// The moment shown, in seconds.
    pub t: f64,
    /// Where the body is, as its [`place`](crate::sim::bodies::Body::place) says.
    pub at: DVec2,
}
