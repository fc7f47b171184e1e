//! The pixels of a triangle, and values that are linear over it.
//!
//! Corners lie on a grid of 1/256 pixel. A pixel belongs to the triangle that contains its middle. A middle on an
//! edge belongs to the triangle below or on the right of the edge. So triangles with a common edge share no pixel and
//! leave none out.

use std::ops::Range;

use super::spans::Ramp;

/// Grid steps per pixel.
const GRID: i64 = 256;
/// Largest coordinate on the grid: a million pixels. A sum of two products of coordinates must fit 64 bits.
const MAX_GRID: f64 = (1_i64 << 28) as f64;

/// Pixels that may be drawn on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub(super) left: i32,
    pub(super) top: i32,
    /// Beyond the last column.
    pub(super) right: i32,
    /// Beyond the last row.
    pub(super) bottom: i32,
}

/// A triangle of which at least one row is in the window.
#[derive(Debug)]
pub(super) struct Triangle {
    window: Window,
    /// On the grid, relative to the middle of pixel (0, 0).
    corners: [[i64; 2]; 3],
    /// In pixels and not rounded to the grid, as graphics devices interpolate.
    corners_px: [[f32; 2]; 3],
    pub(super) rows: Range<i32>,
    /// Those of all rows.
    pub(super) columns: Range<i32>,
}

impl Triangle {
    /// A triangle with these corners in pixels; `None` if it covers no row of the window.
    pub(super) fn new(corners_px: [[f32; 2]; 3], window: Window) -> Option<Self> {
        let corners = corners_px.map(|corner| corner.map(on_grid));
        let [a, b, c] = corners;
        let rows = first_middle(a[1].min(b[1]).min(c[1]), window.top)
            ..first_middle(a[1].max(b[1]).max(c[1]), window.top).min(window.bottom);
        if rows.is_empty() {
            return None;
        }
        let columns = first_middle(a[0].min(b[0]).min(c[0]), window.left)
            ..first_middle(a[0].max(b[0]).max(c[0]), window.left).min(window.right);
        if columns.is_empty() {
            return None;
        }
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        (twice != 0).then_some(Self { window, corners, corners_px, rows, columns })
    }

    /// Passes each row with the columns of its pixels to `draw`.
    pub(super) fn rows(&self, mut draw: impl FnMut(i32, Range<i32>)) {
        let mut sorted = self.corners;
        sorted.sort_by_key(|corner| corner[1]);
        let [top, middle, bottom] = sorted;
        let bend = (middle[0] - top[0]) * (bottom[1] - top[1])
            - (bottom[0] - top[0]) * (middle[1] - top[1]);
        let turn = first_middle(middle[1], self.rows.start).min(self.rows.end);
        let mut long = None;
        for (rows, ends) in
            [(self.rows.start..turn, [top, middle]), (turn..self.rows.end, [middle, bottom])]
        {
            if rows.is_empty() {
                continue;
            }
            let mut short = Edge::new(ends, &rows);
            let long = long.get_or_insert_with(|| Edge::new([top, bottom], &self.rows));
            for y in rows {
                let [from, to] = if bend > 0 { [long.x, short.x] } else { [short.x, long.x] };
                let from = from.max(i64::from(self.window.left)) as i32;
                let to = to.min(i64::from(self.window.right)) as i32;
                if from < to {
                    draw(y, from..to);
                }
                long.step();
                short.step();
            }
        }
    }

    /// For values that are linear over the triangle.
    pub(super) fn slopes(&self) -> Slopes {
        let [a, b, c] = self.corners_px.map(|corner| corner.map(f64::from));
        let ([bx, by], [cx, cy]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let by_area = 1.0 / (bx * cy - cx * by);
        let [to_b, to_c] = [[cy, -cx], [-by, bx]].map(|slopes| slopes.map(|side| side * by_area));
        Slopes { corner: [a[0] - 0.5, a[1] - 0.5], to_b, to_c }
    }
}

/// Shares of a triangle's second and third corner in the values at a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slopes {
    /// The first corner, relative to the middle of pixel (0, 0).
    corner: [f64; 2],
    /// Change of each share per pixel to the right and down.
    to_b: [f64; 2],
    to_c: [f64; 2],
}

impl Slopes {
    /// A value that is linear over the triangle, from its values at the corners.
    pub(super) fn plane(&self, values: [f32; 3]) -> Plane {
        let [value, at_b, at_c] = values.map(f64::from);
        let [by_b, by_c] = [at_b - value, at_c - value];
        let [dx, dy] = [0, 1].map(|axis| by_b * self.to_b[axis] + by_c * self.to_c[axis]);
        Plane { corner: self.corner, value, dx, dy }
    }
}

fn on_grid(px: f32) -> i64 {
    /// Adding and subtracting it rounds to the nearest whole number, and ties to even.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let grid = (f64::from(px) - 0.5) * GRID as f64;
    let grid = if grid < -MAX_GRID { -MAX_GRID } else { grid };
    let grid = if grid > MAX_GRID { MAX_GRID } else { grid };
    ((grid + ROUND) - ROUND) as i64
}

/// The first pixel from `least` on whose middle is at `grid` or beyond.
fn first_middle(grid: i64, least: i32) -> i32 {
    ((grid + GRID - 1) >> 8).max(i64::from(least)) as i32
}

/// A value at the first corner of a triangle, and its change per pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    corner: [f64; 2],
    value: f64,
    dx: f64,
    dy: f64,
}

impl Plane {
    /// The values in a row, from the middle of pixel (x, y) on.
    pub(super) fn ramp(&self, x: i32, y: i32) -> Ramp {
        let [from_x, from_y] = [f64::from(x) - self.corner[0], f64::from(y) - self.corner[1]];
        let start = self.value + self.dx * from_x + self.dy * from_y;
        Ramp { start: start as f32, step: self.dx as f32 }
    }
}

/// An edge of a triangle in one row. It steps down exactly.
#[derive(Debug)]
struct Edge {
    /// The first pixel whose middle is on the edge or right of it.
    x: i64,
    /// Distance of that middle from the edge, in parts of a pixel. Less than `parts`.
    beyond: i64,
    parts: i64,
    /// Whole pixels per row, rounded down, and the rest in parts.
    step: [i64; 2],
}

impl Edge {
    /// The edge between two grid points, the upper one first, in the first of `rows`.
    fn new([from, to]: [[i64; 2]; 2], rows: &Range<i32>) -> Self {
        let [width, height] = [to[0] - from[0], to[1] - from[1]];
        let parts = GRID * height;
        let at = from[0] * height + (GRID * i64::from(rows.start) - from[1]) * width;
        let [whole, rest] = divide(at, parts);
        let (x, beyond) = if rest == 0 { (whole, 0) } else { (whole + 1, parts - rest) };
        // Most triangles are one row high.
        let step = if rows.len() > 1 { divide(GRID * width, parts) } else { [0, 0] };
        Self { x, beyond, parts, step }
    }

    fn step(&mut self) {
        self.x += self.step[0];
        self.beyond -= self.step[1];
        if self.beyond < 0 {
            self.beyond += self.parts;
            self.x += 1;
        }
    }
}

/// The quotient, rounded down, and the remainder of a division by a positive number.
fn divide(number: i64, by: i64) -> [i64; 2] {
    [number.div_euclid(by), number.rem_euclid(by)]
}
