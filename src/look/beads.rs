//! Draws a custom body or a law as beads: one bead per coordinate, each on a rail of its own, or one bead in a plane.

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};

/// Radius of a bead, on a rail and in a plane, in halves of the picture's width.
const BEAD: f64 = 0.055;
const BEAD_IN_PLANE: f64 = 0.045;

/// Distance between two rails, and the margin above and below them, in halves of the width.
const RAILS_APART: f64 = 0.3;
const MARGIN: f64 = 0.2;

/// Half the length of a rail, as a multiple of half the coordinate's range.
const BEYOND: f64 = 1.25;

/// Length of the trail in a plane, in seconds.
const TRAIL_S: f64 = 4.0;

/// The rail of one coordinate: its position and its scale in the picture.
#[derive(Clone, Copy)]
struct Rail {
    /// Middle of the coordinate's range.
    middle: f64,
    /// Half of the coordinate's range.
    half: f64,
    /// Position of the middle in the picture.
    at: DVec2,
    /// Metres of the picture per unit of the coordinate.
    scale: f64,
}

impl Rail {
    fn place(&self, q: f64) -> DVec2 {
        DVec2::new(self.at.x + (q - self.middle) * self.scale, self.at.y)
    }

    fn coordinate(&self, x: f64) -> f64 {
        self.middle + (x - self.at.x) / self.scale
    }

    /// Returns the left and right end of the rail in the picture.
    fn ends(&self) -> [DVec2; 2] {
        [-1.0, 1.0].map(|side| self.place(self.middle + side * BEYOND * self.half))
    }
}

/// Returns the middle and the half-width of a range. For an empty range, the half-width is the magnitude of its value;
/// for a range of zeros it is 1.
fn middle_and_half(&(low, high): &(f64, f64)) -> [f64; 2] {
    let (middle, half) = (low + (high - low) / 2.0, (high - low) / 2.0);
    let half = if half > 1e-9 * middle.abs() { half } else { middle.abs() };
    [middle, if half > 0.0 { half } else { 1.0 }]
}

pub(super) struct Beads<'a> {
    /// Name and unit of each coordinate.
    pub(super) coordinates: Vec<[&'a str; 2]>,
    /// Minimum and maximum of each coordinate.
    pub(super) ranges: Vec<(f64, f64)>,
    /// Indices of the coordinates that are x and y, if the body moves in a plane.
    pub(super) plane: Option<[usize; 2]>,
}

impl Beads<'_> {
    /// Returns the rails from the top down. Coordinates with the unit of the first one share its scale and zero, so
    /// that they can be compared. Every other coordinate has a scale of its own, at which its range is as long as the
    /// others'.
    fn rails(&self) -> Vec<Rail> {
        let [_, unit] = self.coordinates[0];
        let pairs = || self.ranges.iter().zip(&self.coordinates);
        let alike = pairs().filter(|(_, [_, own])| *own == unit).map(|(range, _)| *range);
        let shared = alike.reduce(|all, next| (all.0.min(next.0), all.1.max(next.1)));
        let [middle, half] = middle_and_half(&shared.unwrap_or((0.0, 0.0)));
        let rail = |(n, (range, [_, own])): (usize, (&(f64, f64), &[&str; 2]))| {
            let at = DVec2::new(middle, -RAILS_APART * half * n as f64);
            if *own == unit {
                return Rail { middle, half, at, scale: 1.0 };
            }
            let [own_middle, own_half] = middle_and_half(range);
            Rail { middle: own_middle, half: own_half, at, scale: half / own_half }
        };
        pairs().enumerate().map(rail).collect()
    }

    /// Returns the centre of the plane's picture, and half the picture's width and height.
    fn plane_room(&self, plane: [usize; 2]) -> [DVec2; 2] {
        let [x, y] = plane.map(|place| middle_and_half(&self.ranges[place]));
        let half = x[1].max(y[1]);
        let near = |own: f64| own.max(0.4 * half);
        [DVec2::new(x[0], y[0]), BEYOND * DVec2::new(near(x[1]), near(y[1]))]
    }
}

impl BodyPicture for Beads<'_> {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        if let Some(plane) = self.plane {
            let [_, half] = self.plane_room(plane);
            let radius = BEAD_IN_PLANE * half.max_element();
            outline.marks.push(Mark::Disc { centre: outline.at, radius });
            return;
        }
        let rails = self.rails();
        let radius = BEAD * BEYOND * rails[0].half;
        for (rail, &[text, _]) in rails.iter().zip(&self.coordinates) {
            let [from, to] = rail.ends();
            outline.marks.push(Mark::Rail { from, to });
            outline.names.push((from, text.to_owned()));
            if rail.ends()[0].x <= rail.place(0.0).x && rail.place(0.0).x <= rail.ends()[1].x {
                let tick = DVec2::new(0.0, 0.9 * radius);
                let zero = rail.place(0.0);
                outline.marks.push(Mark::Rail { from: zero - tick, to: zero + tick });
            }
        }
        for (rail, &q) in rails.iter().zip(q) {
            outline.marks.push(Mark::Disc { centre: rail.place(q), radius });
        }
    }

    fn framing(&self) -> Framing {
        if let Some(plane) = self.plane {
            let [centre_m, half_m] = self.plane_room(plane);
            return Framing::Fixed { centre_m, half_m, trail_s: TRAIL_S };
        }
        let rails = self.rails();
        let half = rails[0].half;
        let [first, last] = [rails[0].at, rails[rails.len() - 1].at];
        let height = (first.y - last.y) / 2.0 + MARGIN * half;
        Framing::Fixed {
            centre_m: (first + last) / 2.0,
            half_m: DVec2::new(1.12 * BEYOND * half, height),
            trail_s: 0.0,
        }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        if let Some(plane) = self.plane {
            let [_, half] = self.plane_room(plane);
            let at = DVec2::new(q[plane[0]], q[plane[1]]);
            return vec![Handle { at, radius: BEAD_IN_PLANE * half.max_element() }];
        }
        let rails = self.rails();
        let radius = BEAD * BEYOND * rails[0].half;
        rails.iter().zip(q).map(|(rail, &q)| Handle { at: rail.place(q), radius }).collect()
    }

    /// Moves the pulled coordinates only. All others keep their values and velocities.
    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        match self.plane {
            Some([x, y]) => {
                (q[x], q[y]) = (pull.to.x, pull.to.y);
                (v[x], v[y]) = (pull.velocity.x, pull.velocity.y);
            }
            None => {
                let rail = self.rails()[pull.handle];
                q[pull.handle] = rail.coordinate(pull.to.x);
                v[pull.handle] = pull.velocity.x / rail.scale;
            }
        }
    }
}
