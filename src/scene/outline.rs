//! The outline of a body: its parts in metres. Their colour comes from the lane.

use glam::DVec2;

/// One part of a body, in metres, x right and y up.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Mark {
    /// A wall that the body hangs on: a line that does not move.
    Wall {
        /// One end.
        from: DVec2,
        /// The other end.
        to: DVec2,
    },
    /// A disc that does not move, such as a pivot or a target.
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
    /// A thin line that does not move, along which a bead slides.
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
    /// A block at [`Outline::at`] on a coil spring moored at the left. The picture decides their size.
    Sprung,
    /// The hull of a ship at [`Outline::at`].
    Hull {
        /// Direction of its bow, of length 1.
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
    /// Whether it belongs to the border. A net in the background shows only its border.
    pub is_border: bool,
}

/// The parts that show a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Parts to draw, from bottom to top.
    pub marks: Vec<Mark>,
    /// Names of rails. Each is written to the left of its point.
    pub names: Vec<(DVec2, String)>,
    /// Threads of a net, drawn below the marks.
    pub threads: Vec<Thread>,
    /// Closed course that the exact body will follow if nothing intervenes.
    pub course: Vec<DVec2>,
    /// Time shown, in seconds.
    pub t: f64,
    /// Position of the body, by its [`place`](crate::sim::bodies::Body::place).
    pub at: DVec2,
}
