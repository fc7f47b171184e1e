//! What the stage shows, as plain data: the last f64 become f32 here, after the camera is subtracted.
//!
//! Lengths are logical points from the stage's top left corner, y down; colours are straight sRGB with
//! alpha. Everything in a [`Picture`] is finite and within [`FAR`] of the stage, whatever the lanes do.

mod captions;
mod compose;
mod ghost;
mod grasp;
mod layout;
mod look;
mod outline;
pub mod palette;
mod sketch;
mod trails;

pub use compose::compose;
pub use grasp::{Cell, Grasp, Grip, Whose};
pub use look::{Framing, Handle, Look, Pull};
pub use outline::{Mark, Outline};

/// The largest coordinate in a picture, in points: far outside any stage, and exact in an f32.
pub const FAR: f32 = 1e5;

/// A colour: red, green, blue and alpha, sRGB, alpha not multiplied in.
pub type Rgba = [u8; 4];

/// An upright rectangle in points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Left and top.
    pub min: [f32; 2],
    /// Right and bottom.
    pub max: [f32; 2],
}

impl Rect {
    /// Whether a point is in it.
    pub fn contains(&self, at: [f32; 2]) -> bool {
        (0..2).all(|axis| (self.min[axis]..=self.max[axis]).contains(&at[axis]))
    }

    /// Where a point is in it: across and down from its middle, in its widths and heights.
    fn part(&self, at: [f32; 2]) -> [f64; 2] {
        [0, 1].map(|axis| {
            let middle = f64::from(self.min[axis] + self.max[axis]) / 2.0;
            (f64::from(at[axis]) - middle) / self.size()[axis]
        })
    }

    /// Width and height, at least a point.
    fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| f64::from(self.max[axis] - self.min[axis]).max(1.0))
    }
}

/// Everything on the stage, in painting order: seas, then ribbons, then strokes, then labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Backgrounds, one for each body of each lane.
    pub seas: Vec<Sea>,
    /// Trails and wakes.
    pub ribbons: Vec<Ribbon>,
    /// Everything else drawn, the first at the bottom.
    pub strokes: Vec<Stroke>,
    /// Text over it.
    pub labels: Vec<Label>,
    /// What a pointer is over, one for each body of each lane.
    pub cells: Vec<Cell>,
}

/// The background of one body's cell: water or chart paper, with a grid in the body's world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sea {
    /// Where it is.
    pub rect: Rect,
    /// The point of the stage at which the grid has a line in both directions.
    pub grid_origin: [f32; 2],
    /// Distance between grid lines.
    pub grid_step: f32,
    /// How much the water moves: 1 for a ship's sea, 0 for chart paper.
    pub waves: f32,
    /// Phase of the waves in radians, from simulated time.
    pub phase: f32,
}

/// A line through points, with a width and a colour at each.
#[derive(Clone, Debug, PartialEq)]
pub struct Ribbon {
    /// The points, of which many may lie in one pixel.
    pub points: Vec<RibbonPoint>,
    /// Nothing is drawn outside this.
    pub clip: Rect,
}

/// A point of a ribbon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RibbonPoint {
    /// Where.
    pub at: [f32; 2],
    /// Half the width there.
    pub radius: f32,
    /// The colour there.
    pub colour: Rgba,
}

/// The shape of a stroke's ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cap {
    /// A disc at either end: lines, dots, hulls.
    Round,
    /// Cut straight through the end point, for equal radii: with a length equal to its width, a square.
    Butt,
}

/// A line from disc to disc: with equal radii a stroke, with different ones a hull, of no length a dot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// One end.
    pub from: [f32; 2],
    /// The other end.
    pub to: [f32; 2],
    /// Half the width at either end.
    pub radii: [f32; 2],
    /// Its colour.
    pub colour: Rgba,
    /// The shape of the ends.
    pub cap: Cap,
    /// Nothing is drawn outside this.
    pub clip: Rect,
}

/// How a label's text lies to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// The text begins at the point.
    Left,
    /// The text is centred on the point.
    Centre,
    /// The text ends at the point.
    Right,
}

/// A line of text, its point at mid height.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Where.
    pub at: [f32; 2],
    /// How the text lies to it.
    pub align: Align,
    /// Height of the type in points.
    pub size: f32,
    /// Colour.
    pub colour: Rgba,
    /// What it says.
    pub text: String,
}
