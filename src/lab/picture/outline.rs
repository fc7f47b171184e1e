//! The outline of a body: marks in metres, without colour, which the lane brings.

use glam::DVec2;

/// One mark of an outline, in metres, x right and y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// A line with round ends, `weight` times the lane's line width.
    Line {
        /// One end.
        from: DVec2,
        /// The other end.
        to: DVec2,
        /// Times the lane's line width.
        weight: f64,
    },
    /// A filled shape that tapers from a disc of one radius to a disc of another.
    Taper {
        /// The first disc's centre.
        from: DVec2,
        /// The second disc's centre.
        to: DVec2,
        /// The first disc's radius.
        from_radius: f64,
        /// The second disc's radius.
        to_radius: f64,
    },
    /// A filled square.
    Block {
        /// Its centre.
        centre: DVec2,
        /// The direction of two of its sides, of length 1.
        along: DVec2,
        /// Half its side.
        half: f64,
    },
}

/// The marks that show a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// What is drawn, the first at the bottom.
    pub marks: Vec<Mark>,
    /// Where the body is, as its [`place`](crate::sim::bodies::Body::place) says.
    pub at: DVec2,
}

impl Outline {
    /// Draws a line.
    pub fn line(&mut self, from: DVec2, to: DVec2, weight: f64) {
        self.marks.push(Mark::Line { from, to, weight });
    }

    /// Draws a filled taper.
    pub fn taper(&mut self, from: DVec2, from_radius: f64, to: DVec2, to_radius: f64) {
        self.marks.push(Mark::Taper { from, to, from_radius, to_radius });
    }

    /// Draws a filled square, two of its sides in the direction `along`.
    pub fn block(&mut self, centre: DVec2, along: DVec2, half: f64) {
        self.marks.push(Mark::Block { centre, along, half });
    }

    /// Draws the hull of a ship `length` metres long at [`Outline::at`], its bow in the direction `bow`.
    pub fn hull(&mut self, bow: DVec2, length: f64) {
        let unit = length / 9.0;
        let at = self.at;
        let along = |x: f64| at + bow * (x * unit);
        let (stern, waist) = (along(-4.0), along(0.5));
        self.taper(stern, 1.3 * unit, waist, 1.7 * unit);
        self.taper(waist, 1.7 * unit, along(5.0), 0.2 * unit);
        self.block(along(-2.2), bow, 0.9 * unit);
    }

    /// Draws a coil spring of `turns` turns and radius `radius`, with straight ends.
    pub fn coil(&mut self, from: DVec2, to: DVec2, turns: u32, radius: f64) {
        let along = to - from;
        let across = along.perp().normalize_or(DVec2::Y) * radius;
        let lead = 0.08;
        let mut last = from + along * lead;
        self.line(from, last, 1.0);
        for half_turn in 0..2 * turns {
            let part = (f64::from(half_turn) + 0.5) / f64::from(2 * turns);
            let side = if half_turn % 2 == 0 { across } else { -across };
            let next = from + along * (lead + (1.0 - 2.0 * lead) * part) + side;
            self.line(last, next, 1.0);
            last = next;
        }
        let end = from + along * (1.0 - lead);
        self.line(last, end, 1.0);
        self.line(end, to, 1.0);
    }
}
