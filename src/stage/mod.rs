//! The contents of the stage as plain data. The last f64 become f32 here, after subtracting the camera.
//!
//! Lengths are logical points from the stage's top left corner, y down; colours are straight sRGB with alpha.
//! Everything in a [`Picture`] is finite and within [`FAR`] of the stage, for any state of the lanes.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

use regatta_look as look;
use regatta_loops as loops;
use regatta_measure as measure;
use regatta_run as run;
use regatta_scene as scene;
use regatta_sim as sim;
use regatta_studio as studio;

mod apex;
mod bands;
mod body;
mod body_cell;
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
mod lane;
mod layout;
mod letters;
mod loop_stage;
mod mass;
mod moment;
mod outgrown;
mod scale_marks;
mod sketch;
mod trails;
mod universe;

pub use compose::compose;
pub use grasp::{Cell, Grasp, Grip, Whose};

use crate::look::palette::{Palette, Rgba, fade};

// The items of `sim` that the view names; it has no other access to `sim`.
pub use crate::sim::{
    TickRate,
    bodies::{Coordinate, Parameter, Range, TakesEffect},
    number,
};

/// Largest coordinate in a picture, in points: far outside any stage, and exact in an f32.
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
    /// Whether a point is inside.
    pub fn contains(&self, at: [f32; 2]) -> bool {
        (0..2).all(|axis| (self.min[axis]..=self.max[axis]).contains(&at[axis]))
    }

    /// A point relative to the middle: across and down, in widths and heights.
    fn part(&self, at: [f32; 2]) -> [f64; 2] {
        [0, 1].map(|axis| {
            let middle = f64::from(self.min[axis] + self.max[axis]) / 2.0;
            (f64::from(at[axis]) - middle) / self.size()[axis]
        })
    }

    fn sides(&self) -> [f32; 2] {
        [0, 1].map(|axis| self.max[axis] - self.min[axis])
    }

    /// Width and height, each at least 1.
    fn size(&self) -> [f64; 2] {
        self.sides().map(|side| f64::from(side).max(1.0))
    }
}

/// Everything on the stage, in painting order: the sea, then shapes, then labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// The background.
    pub sea: Option<Sea>,
    /// Shapes on it, the first at the bottom.
    pub shapes: Vec<Shape>,
    /// Text over it.
    pub labels: Vec<Label>,
    /// Cells for the pointer: one for each body, or one for each body of each lane if lanes have their own cells.
    pub cells: Vec<Cell>,
    /// The verdict on the method.
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
    /// Area on the stage.
    pub rect: Rect,
    /// Colours at the top and at the bottom.
    pub colours: [Rgba; 2],
}

/// A shape on the sea.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A line, or a dot.
    Path(Path),
    /// A filled outline.
    Fill(Fill),
}

/// A line through points, with a width and a colour at each, and round ends. A line without length is a disc. A line
/// that returns to its first point has no ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// At least two points; many may lie in one pixel.
    pub points: Vec<PathPoint>,
    /// Drawn length and gap in points; a gap of 0 is solid.
    pub dash: [f32; 2],
    /// Limits of the drawing.
    pub clip: Rect,
}

/// A point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Place on the stage.
    pub at: [f32; 2],
    /// Half the width there.
    pub radius: f32,
    /// Colour there.
    pub colour: Rgba,
}

/// A filled outline that is visible as a whole from the mean of its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Fill {
    /// The corners with their colours, in either direction.
    pub corners: Vec<([f32; 2], Rgba)>,
    /// Limits of the drawing.
    pub clip: Rect,
}

/// Alignment of a label's text to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// The text begins at the point.
    Left,
    /// The text is centred on the point.
    Centre,
    /// The text ends at the point.
    Right,
}

/// A line of text whose point is at mid height.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The point.
    pub at: [f32; 2],
    /// Alignment of the text to the point.
    pub align: Align,
    /// Height of the type in points.
    pub size: f32,
    /// Colour of the type.
    pub colour: Rgba,
    /// Whether it is semibold.
    pub is_strong: bool,
    /// Whether all letters are equally wide, as in code.
    pub is_code: bool,
    /// Colour of the halo that separates it from the shapes below.
    pub halo: Rgba,
    /// The text.
    pub text: String,
}

impl Label {
    /// Text of normal weight without a halo.
    fn new(at: [f32; 2], align: Align, size: f32, colour: Rgba, text: String) -> Self {
        Self { at, align, size, colour, is_strong: false, is_code: false, halo: [0; 4], text }
    }

    /// The same label in semibold.
    fn strong(self) -> Self {
        Self { is_strong: true, ..self }
    }

    /// The same label with a halo that separates it from the water.
    fn on_water(self, palette: &Palette) -> Self {
        Self { halo: fade(palette.sea[1], 0.85), ..self }
    }
}
