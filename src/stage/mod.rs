//! What the stage shows, as plain data: the last f64 become f32 here, after the camera is subtracted.
//!
//! Lengths are logical points from the stage's top left corner, y down; colours are straight sRGB with
//! alpha. Everything in a [`Picture`] is finite and within [`FAR`] of the stage, whatever the lanes do.

mod apex;
mod body;
mod breakpoints;
mod captions;
mod chart;
mod coil;
mod compose;
mod flags;
mod framed;
mod futures;
mod ghost;
mod grasp;
mod hull;
mod layout;
mod loop_stage;
mod loupe;
mod mass;
mod moment;
mod outgrown;
mod sketch;
mod trails;
mod universe;

pub use compose::compose;
pub use grasp::{Cell, Grasp, Grip, Whose};

use crate::look::palette::{Palette, Rgba, faded};

// What the view, which sees nothing of `sim`, names of it.
#[cfg(feature = "view")]
pub(crate) use crate::sim::{
    bodies::{Acts, Coordinate, Parameter, Range},
    number,
};

/// The largest coordinate in a picture, in points: far outside any stage, and exact in an f32.
pub const FAR: f32 = 1e5;

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

/// Everything on the stage, in painting order: the sea, then shapes, then labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// The background.
    pub sea: Option<Sea>,
    /// Everything drawn on it, the first at the bottom.
    pub shapes: Vec<Shape>,
    /// Text over it.
    pub labels: Vec<Label>,
    /// What a pointer is over: one for each body, or where lanes have cells of their own, for each body of each lane.
    pub cells: Vec<Cell>,
    /// Where the verdict on the method is said.
    pub chip: Option<Rect>,
}

impl Picture {
    /// The lines and outlines drawn.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.shapes.iter().filter_map(|shape| match shape {
            Shape::Path(path) => Some(path),
            Shape::Fill(_) => None,
        })
    }
}

/// The background of the stage: water, lighter towards the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sea {
    /// Where it is.
    pub rect: Rect,
    /// Its colours at the top and at the bottom.
    pub colours: [Rgba; 2],
}

/// Something drawn on the sea.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A line, or a dot.
    Path(Path),
    /// A filled outline.
    Fill(Fill),
}

/// A line through points, with a width and a colour at each, and round ends; one that goes nowhere is a disc. One that
/// comes back to its first point has no ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The points, at least two, of which many may lie in one pixel.
    pub points: Vec<PathPoint>,
    /// Drawn length and gap in points; a gap of 0 is solid.
    pub dash: [f32; 2],
    /// Nothing is drawn outside this.
    pub clip: Rect,
}

/// A point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Where.
    pub at: [f32; 2],
    /// Half the width there.
    pub radius: f32,
    /// The colour there.
    pub colour: Rgba,
}

/// A filled outline: one that can be seen whole from the mean of its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Fill {
    /// The corners, each with the colour there, in either direction.
    pub corners: Vec<([f32; 2], Rgba)>,
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
    /// Whether it is semibold.
    pub is_strong: bool,
    /// The colour of the halo that keeps it apart from what lies under it.
    pub halo: Rgba,
    /// What it says.
    pub text: String,
}

impl Label {
    /// Text of a usual weight without a halo.
    fn new(at: [f32; 2], align: Align, size: f32, colour: Rgba, text: String) -> Self {
        Self { at, align, size, colour, is_strong: false, halo: [0; 4], text }
    }

    /// The same, semibold.
    fn strong(self) -> Self {
        Self { is_strong: true, ..self }
    }

    /// The same, kept apart from what lies on the water under it.
    fn on_water(self, palette: &Palette) -> Self {
        Self { halo: faded(palette.sea[1], 0.85), ..self }
    }
}
