//! The outline of a body, as parts in metres. Their colour comes from the lane.

use glam::DVec2;

/// One part of a body, in metres, x right and y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// A wall on which the body hangs, drawn as a line that does not move.
    Wall {
        /// One end of the line.
        from: DVec2,
        /// The other end of the line.
        to: DVec2,
    },
    /// A disc that does not move, such as a pivot or a target.
    Anchor {
        /// Centre of the disc.
        centre: DVec2,
        /// Radius of the disc.
        radius: f64,
    },
    /// A planet, which does not move.
    Planet {
        /// Centre of the planet.
        centre: DVec2,
        /// Radius of the planet.
        radius: f64,
    },
    /// A coil spring.
    Coil {
        /// One end of the spring.
        from: DVec2,
        /// The other end of the spring.
        to: DVec2,
        /// Radius of the spring's turns.
        radius: f64,
    },
    /// A block.
    Block {
        /// Centre of the block.
        centre: DVec2,
        /// Half the width and half the height of the block.
        half: DVec2,
    },
    /// A rod or a thread.
    Rod {
        /// One end of the rod.
        from: DVec2,
        /// The other end of the rod.
        to: DVec2,
    },
    /// A thin line that does not move, along which a bead slides.
    Rail {
        /// One end of the rail.
        from: DVec2,
        /// The other end of the rail.
        to: DVec2,
    },
    /// A disc such as a bead, a bob or a satellite.
    Disc {
        /// Centre of the disc.
        centre: DVec2,
        /// Radius of the disc.
        radius: f64,
    },
    /// A line across a part of the body that is where it cannot be.
    Hatch {
        /// One end of the line.
        from: DVec2,
        /// The other end of the line.
        to: DVec2,
    },
    /// A face of a solid, which is towards the viewer.
    Face {
        /// The corners, in order around the face.
        corners: [DVec2; 4],
        /// How much light falls on the face, from -1 to 1.
        light: f64,
        /// Whether it is a mark on a face, by which half a turn is seen.
        is_mark: bool,
    },
    /// An edge of a solid.
    Edge {
        /// One end of the edge.
        from: DVec2,
        /// The other end of the edge.
        to: DVec2,
        /// Whether the solid hides the edge.
        is_hidden: bool,
    },
    /// A vector.
    Arrow {
        /// The origin.
        from: DVec2,
        /// The point of the arrow.
        to: DVec2,
        /// Whether the vector stands still in truth.
        is_still: bool,
    },
    /// A block at [`Outline::at`] on a coil spring that is fixed at the left. The picture decides the sizes of both.
    Sprung,
    /// The hull of a ship at [`Outline::at`].
    Hull {
        /// Direction of the bow, as a vector of length 1.
        bow: DVec2,
        /// Length of the hull.
        length: f64,
    },
}

/// A thread through nodes of a net.
#[derive(Clone, Debug, PartialEq)]
pub struct Thread {
    /// The nodes, in metres.
    pub points: Vec<DVec2>,
    /// Whether the thread belongs to the border. A net in the background shows only its border.
    pub is_border: bool,
}

/// The parts that show a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Parts to draw, from bottom to top.
    pub marks: Vec<Mark>,
    /// Names of rails, each with its point. A name is written to the left of its point.
    pub names: Vec<(DVec2, String)>,
    /// Threads of a net, drawn below the marks.
    pub threads: Vec<Thread>,
    /// Closed course that the exact body will follow if nothing intervenes.
    pub course: Vec<DVec2>,
    /// Time of the picture, in seconds.
    pub t: f64,
    /// Position of the body, as its [`place`](crate::sim::bodies::Body::place) returns it.
    pub at: DVec2,
}
